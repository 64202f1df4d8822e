"""`rsrm-gen explain SPEC`: what was derived, for a person to read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from rsrm_gen.compiler.cli.options import ParameterOption, assignments
from rsrm_gen.files import manifold_file

if TYPE_CHECKING:
    from rsrm_gen.compiler.cli.account import Chapter, Fact
    from rsrm_gen.compiler.spec import Spec

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
    steps: Annotated[bool, typer.Option("--steps", help="Every scalar step of every derived function too.")] = False,
) -> None:
    """Explain what is derived from a manifold file: storage, maps, determinant, gradient, singularities, cut locus."""
    from rsrm_gen.compiler.cli.account import account
    from rsrm_gen.compiler.derive import derive
    from rsrm_gen.compiler.spec import read_spec

    read = read_spec(manifold_file(spec), assignments(parameter))
    chapters = account(derive(read), steps)
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
    if fact.plain is None:
        return [fact.words]
    formula = _joined(*fact.plain, relations=(" in", " of", "<", "~"))
    if fact.words == "where":
        return [f"    where {formula}"]
    return [formula, f"    {fact.words}"] if fact.words else [formula]


def _joined(left: str, right: str, relations: tuple[str, ...]) -> str:
    """`left = right`, or with the relation that the left side ends in, or one side alone."""
    return (
        left + right if not (left and right) else f"{left} {right}" if left.endswith(relations) else f"{left} = {right}"
    )


def _latex(spec: Spec, chapters: Sequence[Chapter]) -> str:
    lines = [PREAMBLE + rf"\section*{{{escaped(spec.identifier)}}}", escaped(spec.doc)]
    for chapter in chapters:
        lines += [rf"\subsection*{{{escaped(chapter.title)}}}", *map(_latex_fact, chapter.facts)]
    return "\n".join([*lines, r"\end{document}"])


def _latex_fact(fact: Fact) -> str:
    words = escaped(fact.words)
    if fact.latex is None:
        return words + "\n"
    formula = _joined(*fact.latex, relations=(r"\in", "<", r"\sim", "of}"))
    return f"{words}\n\\[ {formula} \\]"


def escaped(text: str) -> str:
    """Words in LaTeX."""
    return "".join(SPECIAL.get(character, character) for character in text)
