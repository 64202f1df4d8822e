"""`rsrm-gen explain SPEC`: what was derived, for a person to read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from rsrm_gen.compiler.budget import SECONDS, limited
from rsrm_gen.compiler.cli.options import BudgetOption, ParameterOption
from rsrm_gen.files import assignments, manifold_file

if TYPE_CHECKING:
    from rsrm_gen.compiler.cli.account import Chapter, Fact
    from rsrm_gen.compiler.spec import Spec

WIDTH = 110
PREAMBLE = r"""\documentclass{article}
\usepackage{amsmath,amssymb}
\allowdisplaybreaks
\begin{document}
"""
SPECIAL = {"\\": r"\textbackslash{}", "^": r"\^{}", "~": r"\~{}", "<": r"\textless{}", ">": r"\textgreater{}",
           **{c: f"\\{c}" for c in "_#$%&{}"}}  # fmt: skip


def explain_command(
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="A manifold file or a bundled name.", show_default=False)],
    parameter: ParameterOption = [],  # noqa: B006
    plain: Annotated[bool, typer.Option("--plain", help="In plain text: what you get by default.")] = False,
    latex: Annotated[bool, typer.Option("--latex", help="As a LaTeX document; with --plain, both.")] = False,
    budget: BudgetOption = SECONDS,
    steps: Annotated[bool, typer.Option("--steps", help="Every scalar step of every derived function too.")] = False,
) -> None:
    """Explain what is derived from a manifold file.

    How points are stored, the maps, the determinant and how it was found, the gradient, the splat, where 0/0 was
    removed and by what polynomial, and what happens on the cut locus.
    """
    from rsrm_gen.compiler.cli.account import account
    from rsrm_gen.compiler.derive import derive
    from rsrm_gen.compiler.spec import read_spec

    read = read_spec(manifold_file(spec), assignments(parameter))
    with limited("derive", budget):
        geometry = derive(read)
    chapters = account(geometry, steps)
    if plain or not latex:
        print(_plain(read, chapters))
    if latex:
        print(_latex(read, chapters))


def _plain(spec: Spec, chapters: Sequence[Chapter]) -> str:
    lines = [spec.identifier, spec.doc]
    for chapter in chapters:
        lines += ["", chapter.title, *(f"  {line}" for fact in chapter.facts for line in _plain_lines(fact))]
    return "\n".join(lines)


def _plain_lines(fact: Fact) -> list[str]:
    if not fact.plain:
        return [fact.words]
    if fact.words == "where":
        return [f"    where {fact.plain}"]
    line = f"{fact.plain}    ({fact.words})" if fact.words else fact.plain
    return [line] if len(line) <= WIDTH else [fact.plain, f"    ({fact.words})"]


def _latex(spec: Spec, chapters: Sequence[Chapter]) -> str:
    lines = [PREAMBLE + rf"\section*{{{escaped(spec.identifier)}}}", escaped(spec.doc)]
    for chapter in chapters:
        lines += [rf"\subsection*{{{escaped(chapter.title)}}}", *map(_latex_fact, chapter.facts)]
    return "\n".join([*lines, r"\end{document}"])


def _latex_fact(fact: Fact) -> str:
    words = escaped(fact.words)
    return f"{words}\n\\[ {fact.latex} \\]".lstrip() if fact.latex else f"{words}\n"


def escaped(text: str) -> str:
    """Words in LaTeX."""
    return "".join(SPECIAL.get(character, character) for character in text)
