"""Formulas as people write them: the author's syntax trees in LaTeX, derived expressions in LaTeX and in plain text."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import singledispatch

import sympy as sp
from sympy.printing.latex import LatexPrinter
from sympy.printing.str import StrPrinter

from rsrm_gen.compiler.spec import formula as f

GREEK = {"alpha", "beta", "gamma", "delta", "epsilon", "theta", "kappa", "lambda", "mu", "omega", "phi", "pi", "rho",
         "sigma", "tau", "psi", "xi", "eta", "zeta", "nu"}  # fmt: skip
COMPARISONS = {"<=": r"\leq", ">=": r"\geq"}
KINDS = ("<", "<=", "=")  # by the number in Choose
LOOSE, SUM, PRODUCT, SIGN, POWER = range(5)  # how tightly a form binds

Words = dict[str, Callable[..., str]]
WORDS: Words = {
    "dot": lambda a, b: rf"\langle {a}, {b} \rangle",
    "norm": lambda a: rf"\lVert {a} \rVert",
    "abs": lambda a: rf"\lvert {a} \rvert",
    "sqrt": lambda a: rf"\sqrt{{{a}}}",
    "cross": lambda a, b: rf"\left({a}\right) \times \left({b}\right)",
    "outer": lambda a, b: rf"\left({a}\right) \left({b}\right)^\top",
    "qmul": lambda a, b: rf"\left({a}\right) \odot \left({b}\right)",
    "conj": lambda a: rf"\overline{{{a}}}",
    "transpose": lambda a: rf"\left({a}\right)^\top",
    "inv": lambda a: rf"\left({a}\right)^{{-1}}",
    "where": lambda c, x, y: rf"\begin{{cases}} {x} & {c} \\ {y} & \text{{otherwise}} \end{{cases}}",
}
FUNCTIONS = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "det", "max", "min"}


def latex(tree: f.Tree) -> str:
    """A formula of the author's in LaTeX."""
    return _latex(tree)[0]


def _inside(tree: f.Tree, strength: int) -> str:
    """A part of a formula, in parentheses where it binds less tightly than its surroundings."""
    text, own = _latex(tree)
    return text if own >= strength else rf"\left({text}\right)"


@singledispatch
def _latex(tree: f.Tree) -> tuple[str, int]:
    raise TypeError(f"{tree} is no formula")


@_latex.register
def _(tree: f.Number) -> tuple[str, int]:
    value = tree.value
    return (str(value.numerator), POWER) if value.denominator == 1 else (f"{float(value):.12g}", POWER)


@_latex.register
def _(tree: f.Name) -> tuple[str, int]:
    return latex_name(tree.name), POWER


@_latex.register
def _(tree: f.Call) -> tuple[str, int]:
    arguments = [latex(a) for a in tree.arguments]
    if tree.function in WORDS and tree.function != "wrap":
        return WORDS[tree.function](*arguments), LOOSE if tree.function in (
            "where",
            "cross",
            "qmul",
            "outer",
        ) else POWER
    head = rf"\{tree.function}" if tree.function in FUNCTIONS else rf"\operatorname{{{_escaped(tree.function)}}}"
    return rf"{head}\left({', '.join(arguments)}\right)", POWER


@_latex.register
def _(tree: f.Negate) -> tuple[str, int]:
    return f"-{_inside(tree.operand, PRODUCT)}", SIGN - 1


@_latex.register
def _(tree: f.Binary) -> tuple[str, int]:
    match tree.operator:
        case "+":
            return f"{_inside(tree.left, SUM)} + {_inside(tree.right, SUM)}", SUM
        case "-":
            return f"{_inside(tree.left, SUM)} - {_inside(tree.right, PRODUCT)}", SUM
        case "*":
            return rf"{_inside(tree.left, PRODUCT)} \, {_inside(tree.right, SIGN)}", PRODUCT
        case "/":
            return rf"\frac{{{latex(tree.left)}}}{{{latex(tree.right)}}}", SIGN
    return f"{{{_inside(tree.left, POWER)}}}^{{{latex(tree.right)}}}", SIGN


@_latex.register
def _(tree: f.Compare) -> tuple[str, int]:
    return f"{latex(tree.left)} {COMPARISONS.get(tree.operator, tree.operator)} {latex(tree.right)}", LOOSE


@_latex.register
def _(tree: f.Stack) -> tuple[str, int]:
    return rf"\left({', '.join(latex(item) for item in tree.items)}\right)", POWER


@_latex.register
def _(tree: f.Rows) -> tuple[str, int]:
    rows = [" & ".join(latex(item) for item in row.items) if isinstance(row, f.Stack) else rf"{latex(row)}^\top"
            for row in tree.items]  # fmt: skip
    return _matrix(rows), POWER


@_latex.register
def _(tree: f.Index) -> tuple[str, int]:
    start = latex(tree.start) if tree.start else ""
    stop = latex(tree.stop) if tree.stop else ""
    return f"{{{_inside(tree.base, POWER)}}}_{{{start + ':' + stop if tree.slice else start}}}", POWER


def _matrix(rows: Sequence[str]) -> str:
    return r"\begin{pmatrix} " + r" \\ ".join(rows) + r" \end{pmatrix}"


def latex_name(name: str) -> str:
    """A name in LaTeX: `t`, `\\theta`, `x_{1}`, `\\mathit{rest}`; what the compiler named after a norm or quotient as that."""
    if "_over_" in name:
        top, bottom = name.split("_over_", 1)
        return rf"\frac{{{latex_name(top)}}}{{{latex_name(bottom)}}}"
    if name.startswith("norm_"):
        square = name.endswith("_squared")
        return rf"\lVert {latex_name(name[5:].removesuffix('_squared'))} \rVert" + ("^2" if square else "")
    letters, digits = re.fullmatch(r"(.*?)_?(\d*)", name).groups()  # type: ignore[union-attr]
    body = rf"\{letters}" if letters in GREEK else letters if len(letters) == 1 else rf"\mathit{{{_escaped(letters)}}}"
    return f"{body}_{{{digits}}}" if digits else body


def _escaped(text: str) -> str:
    return text.replace("_", r"\_")


class _Latex(LatexPrinter):  # type: ignore[misc]
    def _print_Symbol(self, symbol: sp.Symbol, style: str = "plain") -> str:  # noqa: N802
        return latex_name(str(symbol))

    def _print_Choose(self, e: sp.Expr) -> str:  # noqa: N802
        kind, a, b, x, y = e.args
        comparison = COMPARISONS.get(KINDS[int(kind)], KINDS[int(kind)])
        return WORDS["where"](f"{self._print(a)} {comparison} {self._print(b)}", self._print(x), self._print(y))

    _print_ChooseSafe = _print_Choose  # noqa: N815

    def _print_Wrap(self, e: sp.Expr) -> str:  # noqa: N802
        return rf"\operatorname{{wrap}}\left({self._print(e.args[0])}, {self._print(e.args[1])}\right)"


class _Plain(StrPrinter):  # type: ignore[misc]
    def _print_Choose(self, e: sp.Expr) -> str:  # noqa: N802
        kind, a, b, x, y = e.args
        return f"where({self._print(a)} {KINDS[int(kind)]} {self._print(b)}, {self._print(x)}, {self._print(y)})"

    _print_ChooseSafe = _print_Choose  # noqa: N815

    def _print_Wrap(self, e: sp.Expr) -> str:  # noqa: N802
        return f"wrap({self._print(e.args[0])}, {self._print(e.args[1])})"

    def _print_Abs(self, e: sp.Expr) -> str:  # noqa: N802
        return f"abs({self._print(e.args[0])})"


def latex_of(expression: sp.Expr) -> str:
    """A derived expression in LaTeX."""
    return str(_Latex().doprint(expression))


def plain_of(expression: sp.Expr) -> str:
    """A derived expression as in a manifold file."""
    return str(_Plain().doprint(expression)).replace("**", "^")
