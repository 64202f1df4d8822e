"""The command line of the compiler, `rsrm-gen`: one file a command, and what they share.

    compile   manifold files to code, or what changed since      audit     code as it lies on disk, every check again
    new       a manifold file to begin with                      explain   what is derived, for a person to read
    list      the bundled manifolds                              schema    the keys of a manifold file, for editors

Commands import what takes long when they run: a command that finds nothing to do takes a tenth of a second.
"""

from __future__ import annotations

import atexit
import gc
import sys
from pathlib import Path

from rsrm_gen.compiler.output import unchanged
from rsrm_gen.errors import UserError

__all__ = ["main"]


def main() -> None:
    """The entry point. Exits with 0, with 1 when a check failed, with 2 for a user's mistake, which is printed."""
    gc.disable()  # a second of looking for cycles among what torch and sympy import, in a process of a few
    atexit.register(gc.freeze)  # and again at the end
    try:
        if _nothing_to_do(sys.argv[1:]):
            sys.exit(0)
        from rsrm_gen.compiler.cli.app import app

        app(prog_name="rsrm-gen")
    except UserError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
    finally:
        gc.enable()


def _nothing_to_do(arguments: list[str]) -> bool:
    """Whether this is a call to compile files, none of which changed since it was compiled; then this is said.

    The commonest call of all, answered before the libraries of the command line are imported. What is not understood
    here is left to them.
    """
    files, parameters, output = [], {}, Path("generated")
    waiting = iter(arguments)
    for argument in waiting:
        if argument == "-o":
            output = Path(next(waiting, ""))
        elif argument == "-p":
            name, _, parameters[name] = next(waiting, "").partition("=")
        else:
            files.append(Path(argument))
    if not files or not all(file.suffix in (".yaml", ".yml") for file in files):
        return False
    folders = [unchanged(file, parameters, output) for file in files]
    if len(set(folders)) < len(files) or None in folders:
        return False
    for folder in folders:
        print(f"{folder}: up to date")
    return True
