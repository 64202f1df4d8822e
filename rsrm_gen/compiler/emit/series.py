"""The coefficient tables of a program: every polynomial once, under the name of what it approximates."""

from __future__ import annotations

from rsrm_gen.compiler.lower import Program

Coefficients = tuple[object, ...]


def tables(program: Program) -> dict[Coefficients, str]:
    """Coefficients of polynomials to the names of their tables, in the order of their first use."""
    found: dict[Coefficients, str] = {}
    for routine in program:
        names = {node: name for name, node in routine.body}
        for node in routine.nodes:
            if node.op == "polynomial" and node.value not in found:
                found[node.value] = _fresh(names.get(node, "series").upper(), found)  # type: ignore[index]
    return found


def _fresh(hint: str, found: dict[Coefficients, str]) -> str:
    name, count = hint, 1
    while name in found.values():
        count += 1
        name = f"{hint}_{count}"
    return name


def spelled(coefficients: Coefficients, suffix: str = "") -> list[str]:
    """The coefficients, lowest first, as literals that read back as the nearest doubles."""
    return [repr(float(c.evalf(25))) + suffix for c in coefficients]  # type: ignore[attr-defined]
