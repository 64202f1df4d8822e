"""What is emitted: every operation through both back ends, literals, headings, and the same bytes in every run."""

from __future__ import annotations

import ast
import hashlib
import math
import os
import random
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
import torch
from compiled import (
    CC,
    MANIFOLDS,
    NAMES,
    call_batch,
    files,
    geometry,
    needs_compiler,
    program,
    shared_library,
    spec_of,
    torch_module,
)

from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.emit import Measurement, emit
from rsrm_gen.compiler.lower import Node, Parameter, Routine, interpret, lower
from rsrm_gen.compiler.lower.ir import CONDITIONS, FUNCTIONS, Graph, Result, reachable
from rsrm_gen.compiler.lower.schedule import schedule
from rsrm_gen.compiler.native import TRIED, compiled
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.manifold import Manifold
from rsrm_gen.version import __version__

BASIC = {"input", "constant", "eps", "neg", "add", "sub", "mul", "div", "polynomial", "select"}


def with_routine(build: str) -> tuple[Mapping[str, str], Routine]:
    """A manifold's files in which `distance` is another function of p and q, that of a builder in this module."""
    graph = Graph()
    p, q = (tuple(graph.input(f"{name}{i}") for i in range(3)) for name in "pq")
    nodes = BUILDERS[build](graph, *p, *q)
    parameters = Parameter("p", (3,), p), Parameter("q", (3,), q)
    routine = schedule(graph, "distance", parameters, (Result("distance", (len(nodes),), tuple(nodes)),), "a test")
    plain = program("euclidean")
    routines = tuple(routine if r.name == "distance" else r for r in plain)
    return emit(geometry("euclidean"), replace(plain, routines=routines)), routine


def every_operation(g: Graph, *inputs: Node) -> list[Node]:
    a, b, c, x, y, z = inputs  # p in (1, 2), q in (0, 1)
    nodes = [g.function(name, x) for name in FUNCTIONS if name not in ("acosh", "atan2")]
    nodes += [g.function("acosh", a), g.function("atan2", y, g.neg(a)), g.function("atan2", g.neg(x), b)]
    nodes += [g.neg(a), g.add(a, b), g.sub(a, y), g.mul(a, z), g.div(a, y)]
    nodes += [g.function("round", g.mul(g.constant(sp.Rational(7, 2)), node)) for node in (a, g.neg(b), x)]
    nodes += [g.function("abs", g.sub(x, a)), g.mul(g.node("eps"), a), g.constant(sp.Rational(22, 7))]
    polynomial = g.polynomial(y, (sp.Integer(1), sp.Rational(-1, 3), sp.Rational(1, 7), sp.Integer(-2)))
    nodes += [polynomial, g.polynomial(x, (sp.Integer(3), sp.Rational(22, 7)))]
    nodes.append(g.select(g.node("less", a, x), g.constant(sp.Rational(1, 3)), g.constant(sp.pi)))
    for condition in CONDITIONS:
        nodes += [g.select(g.node(condition, s, t), g.add(a, b), g.neg(c)) for s, t in ((a, x), (x, a), (a, a))]
    return nodes


def random_trees(g: Graph, *inputs: Node) -> list[Node]:
    """Expressions nested every way, so that a parenthesis too few changes a value."""
    rng = random.Random(5)

    def alive(node: Node) -> Node:
        """Not a number alone: those are computed by sympy and never reach a function or a comparison."""
        return node if any(n.op == "input" for n in reachable([node])) else g.add(node, inputs[0])

    def tree(depth: int) -> Node:
        if depth == 0:
            return rng.choice([*inputs, g.constant(sp.Rational(-3, 4)), g.constant(2)])
        x, y = tree(depth - 1), tree(rng.randrange(depth))
        kind = rng.choice(["add", "sub", "mul", "div", "neg", "select", "sub", "div", "function"])
        if kind == "neg":
            return g.node("neg", x)
        if kind == "select":
            return g.select(g.node(rng.choice(CONDITIONS), alive(x), y), tree(depth - 1), alive(y))
        if kind == "function":
            return g.function(rng.choice(["sin", "cos", "tanh", "asinh", "abs"]), alive(x))
        if kind == "div":
            return g.node("div", x, g.add(g.constant(3), g.function("cos", alive(y))))
        return g.node(kind, x, y)

    return [tree(depth) for depth in (1, 2, 3, 4, 5) for _ in range(24)]


LITERALS = [
    sp.Rational(1, 3), sp.Rational(-1, 10), sp.pi, sp.exp(1), sp.sqrt(2), sp.Integer(10) ** 15, sp.Integer(10) ** 16,
    sp.Integer(10) ** 16 + 2, sp.Integer(2) ** 53 + 1, sp.Integer(10) ** 22, sp.Integer(123456789012345678),
    sp.Rational(1, 10**7), sp.Rational(1, 10**30), -sp.Integer(3) * 10**30, sp.Rational(1, 2**100), sp.Integer(1),
    sp.Float("0.1234567890123456789012345", 25),
]  # fmt: skip


def literals(g: Graph, *inputs: Node) -> list[Node]:
    # Not folded: each is added to an input that will be zero.
    return [g.node("add", g.constant(value), inputs[0]) for value in LITERALS]


BUILDERS = {"operations": every_operation, "trees": random_trees, "literals": literals}


def points(count: int = 7) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(1)
    return 1 + rng.random((count, 3)), rng.random((count, 3))


def truth(routine: Routine, p: np.ndarray, q: np.ndarray) -> np.ndarray:
    return np.array([[float(x) for x in interpret(routine, *row)[0]] for row in zip(p, q, strict=True)])


def test_the_function_of_every_operation_has_every_operation() -> None:
    _, routine = with_routine("operations")
    assert {node.op for node in routine.nodes} == BASIC | {*FUNCTIONS, *CONDITIONS}


@pytest.mark.parametrize("build", ["operations", "trees"])
def test_torch_computes_what_the_graph_says(build: str, tmp_path: Path) -> None:
    texts, routine = with_routine(build)
    p, q = points()
    module = torch_module(texts, "euclidean", tmp_path)
    found = module.manifold.distance(torch.from_numpy(p), torch.from_numpy(q)).numpy()
    np.testing.assert_allclose(found, truth(routine, p, q), rtol=1e-12, atol=1e-13)


@needs_compiler
@pytest.mark.parametrize("build", ["operations", "trees"])
def test_c_computes_what_the_graph_says(build: str, tmp_path: Path) -> None:
    texts, routine = with_routine(build)
    p, q = points()
    library = shared_library(texts, "euclidean", tmp_path)
    (found,) = call_batch(library, "euclidean", routine, p, q)
    np.testing.assert_allclose(found, truth(routine, p, q), rtol=1e-12, atol=1e-13)
    p, q = (x.astype(np.float32).astype(np.float64) for x in (p, q))
    (single,) = call_batch(library, "euclidean", routine, p, q, dtype=np.float32)
    expected = truth(routine, p, q)
    expected[expected == 2.0**-52 * p[:, :1]] *= 2.0**29  # the rounding unit is that of the precision
    np.testing.assert_allclose(single, expected, rtol=2e-4, atol=2e-5)


def exact(value: sp.Expr) -> float:
    with mp.workdps(40):
        return float(mp.mpf(value._to_mpmath(140)))


def test_literals_in_torch_read_back_as_the_nearest_number(tmp_path: Path) -> None:
    texts, _ = with_routine("literals")
    zero = torch.zeros(1, 3, dtype=torch.float64)
    found = torch_module(texts, "euclidean", tmp_path).manifold.distance(zero, zero)[0]
    assert found.tolist() == [exact(value) for value in LITERALS]


@needs_compiler
def test_literals_in_c_read_back_as_the_nearest_number(tmp_path: Path) -> None:
    texts, routine = with_routine("literals")
    library = shared_library(texts, "euclidean", tmp_path)
    zero = np.zeros((1, 3))
    (double,) = call_batch(library, "euclidean", routine, zero, zero)
    (single,) = call_batch(library, "euclidean", routine, zero, zero, dtype=np.float32)
    assert double[0].tolist() == [exact(value) for value in LITERALS]
    assert single[0].tolist() == [float(np.float32(exact(value))) for value in LITERALS]


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("norm(q - p) * where(n < 4, 2, 3)", 10.0),
        ("norm(q - p) + where(q[0] < 0, 1, pi)", 5 + math.pi),
        ("where(q[0] < 0, 1, 1/3)", 1 / 3),
        ("max([n, 2 * n, 1])", 6.0),
        ("7 / 3", 7 / 3),
    ],
)
def test_numbers_and_parameters_may_stand_anywhere(formula: str, expected: float, tmp_path: Path) -> None:
    text = (MANIFOLDS / "euclidean.yaml").read_text().replace("log: q - p\n", f"log: q - p\ndistance: {formula}\n")
    made = derive(spec_of(text))
    texts = emit(made, lower(made))
    p, q = torch.zeros(2, 3, dtype=torch.float64), torch.tensor([[3.0, 4.0, 0.0]] * 2, dtype=torch.float64)
    found = torch_module(texts, "euclidean", tmp_path).manifold.distance(p, q)
    assert found.tolist() == pytest.approx([expected] * 2, rel=1e-15)
    assert found.dtype == torch.float64
    if CC:
        library = shared_library(texts, "euclidean", tmp_path)
        (found_in_c,) = call_batch(library, "euclidean", lower(made)["distance"], p.numpy(), q.numpy())
        assert found_in_c.tolist() == pytest.approx([expected] * 2, rel=1e-15)


# Whole files.


@pytest.mark.parametrize("name", NAMES)
def test_files_say_what_they_are(name: str) -> None:
    spec = geometry(name).spec
    for file, text in files(name).items():
        head = text[:4000]
        assert f"{name}: {spec.doc[:30]}" in head, file
        if not file.endswith(".c"):
            assert spec.content_hash[:16] in head
            assert f"rsrm-gen {__version__}" in head
            assert "Do not edit" in head
            for routine in program(name):
                assert re.search(rf"{routine.name} +{routine.operations}\b", head), routine.name


@pytest.mark.parametrize("name", NAMES)
def test_files_hold_no_path_and_no_date(name: str) -> None:
    for text in files(name).values():
        assert str(MANIFOLDS.parent) not in text
        assert not re.search(r"/(home|tmp|usr|root|var)/|\.yaml", text)
        assert not re.search(r"\b20[2-9]\d-\d\d|\b\d\d:\d\d\b", text)


def test_measured_accuracy_is_in_the_heading() -> None:
    measured = (Measurement("log", "float64", 8, 1234), Measurement("log", "float32", 16, 1234))
    for file, text in emit(geometry("torus"), program("torus"), measured).items():
        if not file.endswith(".c"):
            assert re.search(r"log +\d+ +<= 8 +<= 16\n", text), file
            assert "1234 points" in text


HASHES = """
import hashlib
from pathlib import Path
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import lower
from rsrm_gen.compiler.spec import read_spec
geometry = derive(read_spec(Path("so3.yaml")))
print(hashlib.sha256("".join(emit(geometry, lower(geometry)).values()).encode()).hexdigest())
"""


def test_the_same_input_gives_the_same_bytes_in_every_process(tmp_path: Path) -> None:
    (tmp_path / "so3.yaml").write_text((MANIFOLDS / "so3.yaml").read_text())
    path = os.pathsep.join([str(MANIFOLDS.parent), os.environ.get("PYTHONPATH", "")])
    environment = {**os.environ, "PYTHONHASHSEED": "7", "PYTHONPATH": path}
    ran = subprocess.run(
        [sys.executable, "-c", HASHES], cwd=tmp_path, env=environment, capture_output=True, text=True, check=True
    )
    here = hashlib.sha256("".join(files("so3").values()).encode()).hexdigest()
    assert ran.stdout.strip() == here


@pytest.mark.parametrize("name", NAMES)
def test_torch_modules_need_torch_alone(name: str) -> None:
    tree = ast.parse(files(name)[f"{name}.py"])
    modules = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            modules |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            modules.add(str(node.module).split(".")[0])
    assert modules <= {"__future__", "math", "torch", "collections", "typing", "itertools"}


@pytest.mark.parametrize("name", NAMES)
def test_torch_modules_keep_the_protocol(name: str, tmp_path: Path) -> None:
    manifold = torch_module(files(name), name, tmp_path).manifold
    spec = geometry(name).spec
    assert isinstance(manifold, Manifold)
    assert manifold.name == name
    assert (manifold.dim, manifold.point_size, manifold.tangent_size) == (spec.dim, spec.point_size, spec.tangent_size)


@pytest.mark.parametrize("name", NAMES)
def test_results_have_the_shapes_that_are_promised(name: str, tmp_path: Path) -> None:
    m = torch_module(files(name), name, tmp_path).manifold
    D, T, d = m.point_size, m.tangent_size, m.dim
    p, q = m.project(torch.randn(4, 1, D)), m.project(torch.randn(5, D))
    v = m.to_tangent(q, torch.randn(5, D))
    W, amplitude = torch.randn(5, d, T), torch.ones(5)
    shapes = {
        "log": (m.log(p, q), (4, 5, T)), "distance": (m.distance(p, q), (4, 5)), "exp": (m.exp(q, v), (5, D)),
        "log_abs_det": (m.log_abs_det(p, q), (4, 5)), "inner": (m.inner(q, v, v), (5,)), "norm": (m.norm(q, v), (5,)),
        "flat": (m.flat(q, v), (5, T)), "frame": (m.frame(q), (5, d, T)), "project": (m.project(p), (4, 1, D)),
        "gradient": (m.riemannian_gradient(p, torch.randn(5, D)), (4, 5, T)),
        "gradient_norm": (m.gradient_norm(p, torch.randn(5, D)), (4, 5)),
        "splat": (m.splat(p, q, W, amplitude)[0], (4, 5)), "slope": (m.splat(p, q, W, amplitude)[1], (4, 5, T)),
        "splats": (m.splats(p[:, 0], q, W, amplitude)[0], (4,)),
        "slopes": (m.splats(p[:, 0], q, W, amplitude)[1], (4, T)),
        "sample_ball": (m.sample_ball(q[0], 0.5, 6), (6, D)), "one point": (m.log(q[0], q[1]), (T,)),
        "no points": (m.log(q[:0], q[:0]), (0, T)),
    }  # fmt: skip
    for key, (result, shape) in shapes.items():
        assert result.shape == shape, key
        assert result.dtype == torch.float32, key


@needs_compiler
@pytest.mark.parametrize(
    ("name", "n"), [("euclidean", 1), ("torus", 1), ("sphere", 1), ("sphere", 4), ("hyperbolic", 3)]
)
def test_c_of_other_dimensions_compiles_without_a_warning(name: str, n: int, tmp_path: Path) -> None:
    spec = geometry(name, n=n).spec
    library = shared_library(files(name, n=n), spec.identifier, tmp_path)
    assert getattr(library, f"{spec.identifier}_splat")


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
def test_c_needs_nothing_but_mathematics(name: str, tmp_path: Path) -> None:
    source = files(name)[f"{name}.c"] + files(name)[f"{name}.h"]
    included = set(re.findall(r"#include [<\"]([^>\"]+)", source))
    assert included <= {"math.h", "float.h", "stddef.h", f"{name}.h"}
    assert not re.search(r"\b(malloc|calloc|printf|errno|goto|while)\b", re.sub(r"/\*.*?\*/", "", source, flags=re.S))
    shared_library(files(name), name, tmp_path)


@needs_compiler
@pytest.mark.parametrize("name", NAMES)
def test_c_frames_are_orthonormal(name: str, tmp_path: Path) -> None:
    spec = geometry(name).spec
    library = shared_library(files(name), name, tmp_path)
    manifold = torch_module(files(name), name, tmp_path).manifold
    p = manifold.project(torch.randn(spec.point_size, dtype=torch.float64, generator=torch.Generator().manual_seed(2)))
    frame = np.empty((spec.dim, spec.tangent_size))
    point = p.numpy().copy()
    getattr(library, f"{name}_frame")(ctypes_pointer(point), ctypes_pointer(frame))
    e = torch.from_numpy(frame)
    gram = manifold.inner(p, e[:, None], e[None, :])
    torch.testing.assert_close(gram, torch.eye(spec.dim, dtype=torch.float64), rtol=0, atol=1e-13)


def ctypes_pointer(array: np.ndarray) -> object:
    return np.ctypeslib.as_ctypes(array)


DOCS: Sequence[str] = [
    "a */ b",
    "a /* b",
    'says """ so',
    'ends with "',
    "a back\\slash \\N \\x",
    "{braces} %s ??/",
    "R\u00b2 \u2192 R",
]


@pytest.mark.parametrize("doc", DOCS)
def test_whatever_a_doc_says_stays_in_its_comment(doc: str, tmp_path: Path) -> None:
    text = (MANIFOLDS / "euclidean.yaml").read_text()
    text = re.sub(r"(?m)^doc: .*$", lambda _: f"doc: '{doc}'", text)
    made = derive(spec_of(text))
    texts = emit(made, lower(made))
    module = torch_module(texts, "euclidean", tmp_path)
    assert float(module.manifold.distance(torch.zeros(3), torch.tensor([3.0, 4.0, 0.0]))) == 5
    if CC:
        shared_library(texts, "euclidean", tmp_path)


@needs_compiler
@pytest.mark.parametrize("name", ["vector", "work", "pair", "splat", "splats", "block", "exp", "gaussian", "order"])
def test_no_name_of_a_manifold_is_in_the_way_of_what_the_sums_are_made_of(name: str, tmp_path: Path) -> None:
    text = (MANIFOLDS / "torus.yaml").read_text(encoding="utf-8").replace("manifold: torus", f"manifold: {name}")
    (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    geometry = derive(read_spec(tmp_path / f"{name}.yaml"))
    for file, content in emit(geometry, lower(geometry)).items():
        (tmp_path / file).write_text(content, encoding="utf-8")
    command = [str(CC), "-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"{name}_splats.c"]
    subprocess.run(command, cwd=tmp_path, check=True)


@needs_compiler
def test_names_of_a_file_do_not_meet_those_of_the_loops_around_a_pair() -> None:
    """A formula's own names become variables of functions that have arguments and loops of their own."""
    text = (MANIFOLDS / "poincare.yaml").read_text()
    formulas = text.index("log:")
    ours = {"a": "b", "b": "kept", "d": "near", "dd": "points", "h": "splats", "t": "values", "sinh_t": "slopes"}
    renamed = re.sub(r"\b[a-z_]+\b", lambda name: ours.get(name[0], name[0]), text[formulas:])
    geometry = derive(spec_of(text[:formulas] + renamed))
    texts = emit(geometry, lower(geometry))
    assert all(f"its_{name} =" in texts["poincare_splats.c"] for name in ("kept", "near", "points"))
    compiled(texts, "poincare_splats.c", TRIED)
