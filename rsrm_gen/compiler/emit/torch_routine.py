"""A routine as the statements of a torch function."""

from __future__ import annotations

import keyword
import textwrap
from collections.abc import Collection

from rsrm_gen.compiler.emit.expression import SUM, Printer, Spelling
from rsrm_gen.compiler.emit.series import Coefficients
from rsrm_gen.compiler.lower import Node, Parameter, Routine
from rsrm_gen.compiler.lower.ir import SEVERAL

WIDTH = 120
RESERVED = {"self", "torch", "math", "eps"}

SPELLING = Spelling(
    function={
        "sqrt": "torch.sqrt({})", "root": "_root({})", "exp": "torch.exp({})", "log": "torch.log({})", "sin": "torch.sin({})",
        "cos": "torch.cos({})", "tan": "torch.tan({})", "sinh": "torch.sinh({})", "cosh": "torch.cosh({})",
        "tanh": "torch.tanh({})", "asinh": "torch.asinh({})", "acosh": "torch.acosh({})", "acos": "torch.acos({})",
        "atanh": "torch.atanh({})", "atan2": "torch.atan2({}, {})", "abs": "torch.abs({})", "round": "torch.round({})",
    },
    select="torch.where({condition}, {x}, {y})",
    pick="_pick({condition}, {x}, {y}, {like})",
    polynomial="_polynomial({x}, {coefficients})",
    entry="{whole}[..., {index}]",
    eigenvalue="{whole}.values[..., {index}]",
    eps="eps",
    suffix="",
    compare_binds=SUM,
)  # fmt: skip


def body(routine: Routine, series: dict[Coefficients, str], apart: Collection[str] = ()) -> tuple[list[str], list[str]]:
    """The statements of a routine and the expressions of its results.

    An argument that is one tensor has its entries along the last dimension; those in `apart` are sequences of entries,
    in routines that autograd does not see.
    """
    names = _input_names(routine)
    printer = Printer(SPELLING, names, {k: f"_{name}" for k, name in series.items()})
    lines = [line for p in routine.parameters for line in _unpacked(p, routine.inputs, names, p.name in apart)]
    if routine.reads_eps:
        read = next(names[n] for p in routine.parameters for n in p.nodes if str(n.value) in routine.inputs)
        lines.append(f"eps = torch.full_like({read}, torch.finfo({read}.dtype).eps)")
    for name, node in routine.body:
        text = _matrix_call(printer, node, bool(apart)) if node.op in SEVERAL else printer.definition(node)[0]
        lines.append(_assignment(name, text))
        names[node] = name
    return lines, [printer.text(node) for result in routine.results for node in result.nodes]


def _input_names(routine: Routine) -> dict[Node, str]:
    """The names of the scalars that are read: those of the graph, where Python lets them stand."""
    taken = RESERVED | {name for name, _ in routine.body}
    taken |= {p.name for p in routine.parameters if not _is_one(p)}
    names: dict[Node, str] = {}
    for node in (node for p in routine.parameters for node in p.nodes):
        name = str(node.value)
        while name in taken or keyword.iskeyword(name):
            name += "_"
        taken.add(name)
        names[node] = name
    return names


def _is_one(parameter: Parameter) -> bool:
    """Whether an argument and its only entry are the same."""
    return [str(node.value) for node in parameter.nodes] == [parameter.name]


def _matrix_call(printer: Printer, node: Node, alone: bool) -> str:
    """The call of a helper for functions of matrices."""
    if node.op == "eigh":
        return f"_eigh({', '.join(printer.text(a) for a in node.arguments)})"
    name = node.function[0]
    directions = ["(" + "".join(f"{printer.text(e)}, " for e in packed).strip() + ")" for packed in node.directions]
    function = "_spectral_alone" if alone else "_spectral"
    return f'{function}("{name}", {", ".join([printer.text(node.arguments[0]), *directions])})'


def _assignment(name: str, text: str) -> str:
    """A statement; a long one with what stands in its brackets on lines of its own."""
    line = f"{name} = {text}"
    if len(line) <= WIDTH - 8:
        return line
    head, inner = _call(text)
    lines = textwrap.wrap(inner, WIDTH - 12, break_long_words=False, break_on_hyphens=False)
    body = textwrap.indent("\n".join(lines), "    ")
    return f"{name} = {head}(\n{body}\n)"


def _call(text: str) -> tuple[str, str]:
    """A call as what is called and its arguments; any other expression as nothing called and itself."""
    head, _, rest = text.partition("(")
    depth = 1
    for at, character in enumerate(rest):
        depth += {"(": 1, ")": -1}.get(character, 0)
        if depth == 0:
            is_call = at == len(rest) - 1 and head.replace(".", "").isidentifier()
            return (head, rest[:-1]) if is_call else ("", text)
    return "", text


def _unpacked(parameter: Parameter, used: set[str], names: dict[Node, str], apart: bool) -> list[str]:
    """The entries of an argument as scalars (in truth: tensors of the leading shape)."""
    read = [str(node.value) in used for node in parameter.nodes]
    if _is_one(parameter) or not any(read):
        return []
    targets = [names[node] if is_read else "_" for node, is_read in zip(parameter.nodes, read, strict=True)]
    flat = f"{parameter.name}.flatten(-2)" if len(parameter.shape) == 2 else parameter.name
    source = flat if apart else f"{flat}.unbind(-1)"
    line = f"{', '.join(targets)}{',' if len(targets) == 1 else ''} = {source}"
    if len(line) <= WIDTH - 8:
        return [line]
    inner = textwrap.fill(", ".join(targets) + ",", WIDTH - 12)
    return [f"(\n{textwrap.indent(inner, '    ')}\n) = {source}"]


def listed(head: str, texts: list[str], tail: str) -> str:
    """A tuple of texts in one line where it fits, else one a line."""
    line = f"{head}{', '.join(texts)}{',' if len(texts) == 1 else ''}{tail}"
    if len(line) <= WIDTH - 8:
        return line
    inner = "".join(f"    {text},\n" for text in texts)
    return f"{head}\n{inner}{tail}"
