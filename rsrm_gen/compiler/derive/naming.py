"""Names for quantities, made of the author's formulas, that a reader of the generated code recognises."""

from __future__ import annotations

import re

import sympy as sp

from rsrm_gen.compiler.spec import formula as f


def call_name(tree: f.Call) -> str:
    """A name for a call that a reader recognises: norm_w, dot_p_d, sinh_r."""
    words = tree_name(tree)
    return words if len(words) <= 20 and words.isidentifier() else f"{tree.function}_value"


def tree_name(tree: f.Tree) -> str:
    """A formula in words joined by underscores: dot_p_d."""
    match tree:
        case f.Name():
            return tree.name
        case f.Number():
            return str(tree.value).replace("/", "_over_")
        case f.Negate():
            return "minus_" + tree_name(tree.operand)
        case f.Binary():
            word = {"+": "plus", "-": "minus", "*": "times", "/": "over", "^": "to"}[tree.operator]
            return f"{tree_name(tree.left)}_{word}_{tree_name(tree.right)}"
        case f.Index():
            return tree_name(tree.base) + ("s" if tree.slice else f"{tree_name(tree.start)}" if tree.start else "")
        case f.Call():
            return "_".join([tree.function, *(tree_name(argument) for argument in tree.arguments)])
    return "of"


def symbol_name(expression: sp.Expr) -> str:
    """A short symbol or number as it is written; empty for all else."""
    text = str(expression) if expression.is_Symbol or expression.is_number else ""
    return text if re.fullmatch(r"\w{1,12}", text) else ""
