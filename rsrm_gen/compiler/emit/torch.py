"""The torch back end: one class behind the `Manifold` protocol, in a module that needs nothing but torch."""

from __future__ import annotations

import textwrap

import sympy as sp

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.emit import torch_matrix, torch_splats
from rsrm_gen.compiler.emit.promises import promise, public
from rsrm_gen.compiler.emit.series import Coefficients, described, in_double, in_single, spelled, tables
from rsrm_gen.compiler.emit.torch_routine import WIDTH, body, listed
from rsrm_gen.compiler.emit.torch_runtime import (
    FRAME,
    HELPERS,
    SAMPLE_BALL,
    SAMPLE_BOX,
    SAMPLE_FORMULA,
    SAMPLE_NONE,
    SAMPLE_WHOLE,
    TRANSPORT_NONE,
)
from rsrm_gen.compiler.lower import Program, Routine
from rsrm_gen.compiler.spec import ManifoldSpec, ProductSpec


def module(geometry: Geometry, program: Program, heading: list[str]) -> str:
    """The text of the module."""
    program = public(program)  # sums have the adjoint of a pair; that of a single splat is autograd's
    series = tables([*program, *program.pairs])
    fixed = [textwrap.indent(text.strip("\n"), "    ") for text in _fixed(geometry)]
    matrices = torch_matrix.runtime([*program, *program.pairs])
    imports = ["import math", "from collections.abc import Callable, Sequence", "from typing import Any"]
    if matrices:
        imports = ["import itertools", *imports[:-1], "from typing import Any, NamedTuple"]
    top = [
        f'"""{_python_text(heading)}\n"""',
        "from __future__ import annotations\n\n"
        + "\n".join(imports)
        + "\n\nimport torch\nfrom torch import Generator, Tensor",
        *(_table(name, coefficients) for coefficients, name in series.items()),
    ]
    methods = [
        _class_head(geometry, program),
        *(_method(geometry, routine, series) for routine in program),
        *fixed,
        *torch_splats.methods(geometry, program.pairs, series),
    ]
    parts = [
        "\n\n".join(top),
        HELPERS.strip("\n"),
        *matrices,
        torch_splats.HELPERS.strip("\n"),
        "\n\n".join(methods),
        f"manifold = {class_name(program)}()",
    ]
    return "\n\n\n".join(parts) + "\n"


def _fixed(geometry: Geometry) -> list[str]:
    """The methods that are text."""
    spec = geometry.spec
    frame = FRAME.format(dim=spec.dim, size=spec.point_size, tangent=spec.tangent_size)
    return [*([] if "transport" in geometry else [TRANSPORT_NONE]), frame, _sample(geometry), SAMPLE_BALL]


def _python_text(lines: list[str]) -> str:
    """Lines that an author wrote, inside a docstring."""
    return "\n".join(lines).rstrip().replace("\\", "\\\\").replace('"""', '\\"\\"\\"')


def class_name(program: Program) -> str:
    """The class in the module of a program."""
    name = "".join(word.capitalize() for word in program.name.split("_"))
    return f"{name}Manifold" if name in ("Tensor", "Generator", "Callable", "Sequence") else name


def _table(name: str, coefficients: Coefficients) -> str:
    """The coefficients for double precision, then the fewer for single."""
    numbers, single = in_double(coefficients), in_single(coefficients)
    note = described(name, coefficients)
    if single.degree < len(numbers) - 1:
        note += f"; for float32 of degree {single.degree}, within {single.bits} of that"
    rows = [textwrap.fill(", ".join(spelled(c)) + ",", WIDTH - 8) for c in (numbers, single.coefficients)]
    tuples = "".join(f"    (\n{textwrap.indent(row, ' ' * 8)}\n    ),\n" for row in rows)
    return f"# {note[0].upper()}{note[1:]}.\n_{name} = (\n{tuples})"


def _class_head(geometry: Geometry, program: Program) -> str:
    spec = geometry.spec
    periods = "None" if geometry.periods is None else "(" + ", ".join(_float(p) for p in geometry.periods) + ",)"
    doc = _python_text([textwrap.fill(spec.doc, WIDTH - 8, subsequent_indent="    ")])
    return f'''class {class_name(program)}:
    """{doc}
{_symbols(geometry)}
    Points have shape (..., {spec.point_size}), tangent vectors (..., {spec.tangent_size}){_tangent_words(geometry)};
    leading dimensions broadcast.
    """

    name = "{program.name}"
    content_hash = "{spec.content_hash[:32]}"
    dim = {spec.dim}
    point_size = {spec.point_size}
    tangent_size = {spec.tangent_size}
    injectivity_radius = {_float(geometry.injectivity_radius)}
    diameter = {_float(geometry.diameter)}
    periods = {periods}
    maps = "{spec.maps}"'''


def _symbols(geometry: Geometry) -> str:
    """What the author said of the letters."""
    lines = [f"        {name}: {text}" for name, text in geometry.spec.symbols]
    return "\n    Symbols:\n" + _python_text(lines) + "\n" if lines else ""


def _tangent_words(geometry: Geometry) -> str:
    if isinstance(geometry.spec, ProductSpec):
        return ", those of the factors one after the other"
    if geometry.spec.frame is not None:
        return ", components in the frame of the manifold file"
    return ", ambient" if geometry.spec.embedded else ", components in the chart"


def _float(value: sp.Expr | None) -> str:
    return "None" if value is None else "math.inf" if value == sp.oo else repr(float(value))


def _method(geometry: Geometry, routine: Routine, series: dict[Coefficients, str]) -> str:
    """One routine as a method."""
    lines, texts = body(routine, series)
    if len(routine.results) > 1:
        return textwrap.indent("\n\n".join(_public_and_private(geometry, routine, lines, texts)), "    ")
    names = ", ".join(p.name for p in routine.parameters)
    unread = any(not routine.inputs & {str(n.value) for n in p.nodes} for p in routine.parameters)
    for i, node in enumerate(routine.results[0].nodes):
        if node.is_constant or (i == 0 and unread):
            texts[i] = f"_rows({texts[i]}, {names})"
    final = listed("return _stack((", texts, "))") if routine.results[0].shape else f"return {texts[0]}"
    name = "_sample" if routine.name == "sample" else routine.name  # the public one draws the random numbers
    return textwrap.indent(_definition(name, routine, "Tensor", _docstring(geometry, routine), [*lines, final]), "    ")


def _public_and_private(geometry: Geometry, routine: Routine, lines: list[str], texts: list[str]) -> tuple[str, str]:
    """A splat has a private form that returns its entries, to be summed before they are stacked."""
    call = f"value, *gradient = self._{routine.name}({', '.join(p.name for p in routine.parameters)})"
    public = [call, "return value, _stack(gradient)"]
    private = [*lines, listed("return (", texts, ")")]
    explained = '"""The value and the entries of the gradient, not stacked."""'
    return (
        _definition(routine.name, routine, "tuple[Tensor, Tensor]", _docstring(geometry, routine), public),
        _definition(f"_{routine.name}", routine, "tuple[Tensor, ...]", explained, private),
    )


def _definition(name: str, routine: Routine, returns: str, doc: str, statements: list[str]) -> str:
    signature = ", ".join(f"{p.name}: Tensor" for p in routine.parameters)
    body = textwrap.indent("\n".join([doc, *statements]), "    ")
    return f"def {name}(self, {signature}) -> {returns}:\n{body}"


def _docstring(geometry: Geometry, routine: Routine) -> str:
    return f'"""{promise(geometry, routine.name)}\n\n{_documented(routine)}\n"""'


def _documented(routine: Routine) -> str:
    """Formula and shapes."""
    shapes = ", ".join(f"{p.name} {_shape(p.shape)}" for p in routine.parameters)
    results = ", ".join(_shape(r.shape) for r in routine.results)
    formula = textwrap.fill(f"Formula: {routine.formula}.", WIDTH - 8)
    return f"{formula}\nShapes: {shapes} to {results}."


def _shape(shape: tuple[int, ...]) -> str:
    return "(..." + "".join(f", {n}" for n in shape) + ")"


def _start(geometry: Geometry) -> str:
    """Numbers that `project` is sure to take: the first axis, or the unit matrix."""
    spec = geometry.spec
    options = "dtype=None if like is None else like.dtype, device=None if like is None else like.device"
    if isinstance(spec, ManifoldSpec) and len(spec.point_shape) == 2:
        return f"torch.eye({spec.point_shape[0]}, {spec.point_shape[1]}, {options}).flatten()"
    return f"torch.eye({spec.point_size}, {options})[0]"


def _sample(geometry: Geometry) -> str:
    spec = geometry.spec
    if "sample" in geometry:
        return SAMPLE_FORMULA.format(size=spec.point_size)
    if geometry.periods and all(geometry.periods):
        return SAMPLE_BOX
    if geometry.diameter != sp.oo and geometry.diameter == geometry.injectivity_radius:
        return SAMPLE_WHOLE.format(size=spec.point_size, start=_start(geometry))
    return SAMPLE_NONE
