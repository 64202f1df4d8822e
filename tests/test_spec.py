"""Manifold files: what a mistake in one says and where, and what a good one means."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

import pytest

from rsrm_gen.compiler.spec import ManifoldSpec, read_spec
from rsrm_gen.document import parse_document
from rsrm_gen.errors import UserError

MANIFOLDS = Path(__file__).parent.parent / "manifolds"


def text_of(name: str) -> str:
    return (MANIFOLDS / f"{name}.yaml").read_text(encoding="utf-8")


def edited(name: str, old: str, new: str) -> str:
    text = text_of(name)
    assert text.count(old) >= 1, f"{old!r} is not in {name}.yaml any more"
    return text.replace(old, new, 1)


def read(text: str, **overrides: int | float | str) -> ManifoldSpec:
    return read_spec(parse_document(text, "file.yaml"), overrides)


class Mistake(NamedTuple):
    """One edit of a bundled file; the mark `@` in `new` is where the error must stand (and is taken out)."""

    manifold: str
    old: str
    new: str
    message: str
    hint: str = ""


EXP, LOG, METRIC = "exp: p + v\n", "log: q - p\n", "metric: dot(u, v)\n"
SPACE = "  space: R^n\n"
CONSTRAINT = "  constraint: dot(p, p) - 1\n"

MISTAKES = {
    # names
    "a misspelt function": Mistake("sphere", "norm(w)\n", "@nrom(w)\n", "unknown function `nrom`", "`norm`"),
    "a misspelt symbol": Mistake("sphere", "w / norm(w)", "w / norm(@ww)", "unknown symbol `ww`", "`w`"),
    "a name used before it is defined": Mistake("sphere", "dot(p, e) * p", "dot(p, @t) * p", "unknown symbol `t`"),
    "q in exp": Mistake("euclidean", EXP, "exp: p + @q\n", "unknown symbol `q`", "known here"),
    "q in the metric": Mistake("euclidean", METRIC, "metric: dot(u, @q)\n", "unknown symbol `q`"),
    "p in a period": Mistake("torus", "period: 2 * pi", "period: @p", "unknown symbol `p`"),
    "p in a radius": Mistake("euclidean", "radius: infinity", "radius: norm(@p)", "unknown symbol `p`"),
    "a misspelt infinity": Mistake(
        "euclidean", "radius: infinity", "radius: @infinite", "unknown symbol", "`infinity`"
    ),
    "a function without arguments": Mistake("euclidean", EXP, "exp: p + @norm\n", "`norm` is a function", "norm(a)"),
    "a let called like an argument": Mistake("sphere", "    d: q - p", "    @v: q - p", "meaning of its own", "other"),
    "a let called like a function": Mistake("sphere", "    d: q - p", "    @norm: q - p", "meaning of its own"),
    "a let called like a parameter": Mistake("sphere", "    d: q - p", "    @n: q - p", "meaning of its own"),
    "a parameter called like a function": Mistake("torus", "{n: 2}", "{n: 2, @exp: 2}", "meaning of its own"),
    "a name with a space": Mistake("euclidean", "manifold: euclidean", "manifold: @my space", "`manifold`"),
    "a name with a digit first": Mistake("euclidean", "manifold: euclidean", "manifold: @2d", "`manifold`"),
    # shapes
    "log as a scalar": Mistake(
        "sphere", "value: t * w / norm(w)", "value: @t / norm(w)", "must be a vector of 3, this is a scalar"
    ),
    "distance as a vector": Mistake(
        "sphere", "distance: t\n", "distance: @d\n", "must be a scalar, this is a vector of 3"
    ),
    "distance as a comparison": Mistake(
        "sphere", "distance: t\n", "distance: @t < pi\n", "must be a scalar, this is a comparison"
    ),
    "a comparison as a value": Mistake(
        "sphere", "    d: q - p", "    c: @pi < 4\n    d: q - p", "a comparison has no value here", "where"
    ),
    "a scalar as a domain": Mistake("hyperbolic", "domain: p[0] > 0", "domain: @p[0]", "must be a comparison"),
    "a product of vectors": Mistake(
        "euclidean", EXP, "exp: p @* v\n", "`*` of a vector of 3 and a vector of 3", "dot(a, b)"
    ),
    "a vector plus a scalar": Mistake("euclidean", EXP, "exp: p @+ 1\n", "`+` of a vector of 3 and a scalar"),
    "an entry too far": Mistake("euclidean", EXP, "exp: p@[3] * v\n", "entries 0 to 2"),
    "a slice too long": Mistake("euclidean", EXP, "exp: p + v@[0:n+1]\n", "entries 0 to 2"),
    "too few arguments": Mistake(
        "euclidean", EXP, "exp: p + @cross(v)\n", "`cross` is written cross(a, b)", "vector product"
    ),
    "no comparison in where": Mistake(
        "euclidean", EXP, "exp: @where(p[0], p, v)\n", "where(c, x, y) does not take a scalar"
    ),
    "a quaternion of three": Mistake(
        "so3", "[0, 0, 0, 1/2]", "[0, 0, 1/2]", "qmul(a, b) does not take a vector of 4, a vector of 3"
    ),
    "a metric of the wrong shape": Mistake(
        "euclidean", METRIC, "metric: @u + v\n", "a metric is a scalar in p, u, v or a 3 x 3 matrix"
    ),
    "a matrix metric in u and v": Mistake("euclidean", METRIC, "metric: outer(@u, v)\n", "`u`"),
    "rows of two lengths": Mistake("euclidean", METRIC, 'metric: "@[[1, 0, 0], [0, 1], [0, 0, 1]]"\n', "one length"),
    "a frame that is too small": Mistake("so3", "  - qmul(p, [0, 0, 0, 1/2])\n", "", "3"),
    "a frame in a chart": Mistake("euclidean", METRIC, METRIC + "@frame: [p]\n", "a chart needs no frame"),
    "too few periods": Mistake("torus", "period: 2 * pi", "period: @[2 * pi]", "1 periods for 2 coordinates"),
    # numbers
    "an exponent that varies": Mistake("euclidean", EXP, "exp: p + v * 2^p@[0]\n", "a number is expected here"),
    "an exponent too large": Mistake("euclidean", EXP, "exp: p + v * 2^@65\n", "the exponent 65 is out of range"),
    "an exponent in fifths": Mistake("euclidean", EXP, "exp: p + v * 2^(1@/5)\n", "in quarters"),
    "a parameter that is a word": Mistake("torus", "{n: 2}", "{n: @two}", "must be a number, this is 'two'"),
    "a parameter that is infinite": Mistake("torus", "{n: 2}", "{n: @.inf}", "must be a number"),
    "a parameter out of range": Mistake("torus", "{n: 2}", '{n: "@1e999999999"}', "`n`"),
    "half a dimension": Mistake(
        "euclidean", SPACE, "  space: R^(n@/2)\n", "a whole number is expected here, this is 3/2"
    ),
    "no dimension": Mistake("euclidean", SPACE, "  space: @R^(n-3)\n", "a space of 0 dimensions"),
    "a negative space": Mistake("euclidean", SPACE, "  space: @R^-3\n", "a space of -3 dimensions"),
    "a space beyond numbers": Mistake("euclidean", SPACE, "  space: R^(((((2^64)^64)^64)^64)^64)\n", ""),
    "too many dimensions": Mistake("euclidean", SPACE, "  space: @R^17\n", "17 dimensions; 1 to 16"),
    "an unknown parameter in the space": Mistake(
        "euclidean", SPACE, "  space: R^@m\n", "a number is expected", "known here: n"
    ),
    "a space that is none": Mistake("euclidean", SPACE, "  space: @S^2\n", "`S^2` is not a space", "R^(n+1)"),
    # keys
    "a missing metric": Mistake("sphere", METRIC, "", "`metric` is missing", "metric: ..."),
    "a missing constraint": Mistake("sphere", CONSTRAINT, "", "`embedded.constraint` is missing", "constraint: ..."),
    "an unknown key": Mistake("sphere", METRIC, METRIC + "@metrics: 1\n", "unknown key `metrics`", "`metric`"),
    "a misspelt key": Mistake("sphere", "doc: The", "@dco: The", "unknown key `dco`", "`doc`"),
    "a misspelt key of a section": Mistake(
        "sphere", "  project: p", "  @projct: p", "unknown key `projct`", "`project`"
    ),
    "a misspelt let": Mistake("sphere", "log:\n  let:", "log:\n  @lets:", "unknown key `lets`", "`let`"),
    "a let without a value": Mistake("euclidean", EXP, "@exp: {let: {a: p + v}}\n", "`exp.value` is missing"),
    "a list as a formula": Mistake("euclidean", EXP, "exp: @[p, v]\n", "`exp`"),
    "an empty formula": Mistake("euclidean", EXP, 'exp: "@"\n', "`exp`"),
    "a key without a value": Mistake("euclidean", EXP, "@exp:\n", "exp"),
    "a key given twice": Mistake(
        "sphere", "distance: t\n", "distance: t\n@distance: t\n", "`distance` is given twice", "keep one"
    ),
    "both embedded and a chart": Mistake(
        "sphere", METRIC, METRIC + "chart: {space: R^2}\n", "either `embedded:` or `chart:`"
    ),
    "neither embedded nor a chart": Mistake(
        "euclidean", "chart:\n  space: R^n\n", "", "either `embedded:` or `chart:`"
    ),
    "no policy at the cut locus": Mistake("torus", ", policy: tie", "", "say what Log returns there"),
    "two policies at the cut locus": Mistake(
        "sphere", "  log: pi * o", "  policy: tie\n  log: pi * o", "say what Log returns there"
    ),
    "an unknown policy": Mistake("torus", "policy: tie", "policy: @coin", "policy"),
    "half a declared value": Mistake("torus", "policy: tie", "log: wrap(q - p)", "give both or neither"),
    "a cut locus that is a number": Mistake("sphere", "norm(q + p) <= 4 * eps", "@norm(q + p)", "must be a comparison"),
    # what later versions will read
    "maps of another kind": Mistake(
        "euclidean", METRIC, METRIC + "maps: @cubic\n", "`maps` cannot be `cubic`", "`retraction`"
    ),
    "a negative scale": Mistake("euclidean", METRIC, METRIC + "scale: @-2\n", "`scale` must be positive"),
    "a symbol that is not there": Mistake("euclidean", METRIC, METRIC + "symbols: {@z: height}\n", "no symbol `z`"),
    "a constant of a point": Mistake("euclidean", METRIC, METRIC + "let: {a: @p}\n", "unknown symbol `p`"),
    "a constant named like a parameter": Mistake("euclidean", METRIC, METRIC + "let: {@n: 2}\n", "meaning of its own"),
    "a metric without exp": Mistake("euclidean", EXP, "", "a metric without `exp:`", "exp: ..."),
    "a metric without log": Mistake("euclidean", LOG, "", "a metric without `log:`", "log: ..."),
    # YAML
    "an alias": Mistake("sphere", METRIC, "metric: &m dot(u, v)\nlog_det: *m\n", "aliases", "write the value out"),
    "a tag": Mistake("euclidean", EXP, "exp: @!!python/name:os.system p\n", "is not read here"),
    "a tab": Mistake("euclidean", EXP, "exp:\n@\tp + v\n", "not valid YAML", "spaces, not tabs"),
    "an open brace": Mistake("euclidean", EXP, "exp: {p: v\n", "not valid YAML", "double quotes"),
    "two factors without a star": Mistake("euclidean", EXP, "exp: 2 @p + v\n", "`p` is not expected here", "`*`"),
}


@pytest.fixture(autouse=True)
def _answers_within_seconds() -> Iterator[None]:
    """What makes the reader compute for hours fails here instead of hanging."""

    def stop(*_: object) -> None:
        raise TimeoutError("reading a manifold file took longer than two seconds")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 2)
    yield
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_named_where_it_stands(mistake: Mistake) -> None:
    marked = edited(mistake.manifold, mistake.old, mistake.new)
    before, mark, _ = marked.partition("@")
    with pytest.raises(UserError) as error:
        read(marked.replace("@", "", 1))
    span = error.value.span
    assert span is not None
    assert span.source.name == "file.yaml"
    assert mistake.message in error.value.message
    assert mistake.hint in (error.value.hint or "")
    if mark:
        assert (span.line, span.column) == (before.count("\n") + 1, len(before.rpartition("\n")[2]) + 1)


@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_errors_speak_of_the_file_and_not_of_python(mistake: Mistake) -> None:
    with pytest.raises(UserError) as error:
        read(edited(mistake.manifold, mistake.old, mistake.new).replace("@", "", 1))
    said = str(error.value)
    assert not any(word in said for word in ("function-", "functools", "NoneType", "``", "pydantic", "Traceback", "'^"))
    assert all(len(line) < 200 for line in said.splitlines())


@pytest.mark.parametrize("override", [{"m": 3}, {"n": "abc"}, {"n": 2.5}, {"n": -1}, {"n": "nan"}])
def test_an_impossible_override_is_refused(override: dict[str, int | float | str]) -> None:
    with pytest.raises(UserError, match=next(iter(override)) if "m" in override else "number|dimensions"):
        read(text_of("euclidean"), **override)


def test_an_override_of_a_parameter_that_is_not_there_names_the_closest() -> None:
    text = edited("euclidean", "{n: 3}", "{n: 3, radius: 1}")
    with pytest.raises(UserError) as error:
        read(text, raduis=2)
    assert "`raduis`" in error.value.message
    assert "`radius`" in str(error.value.hint)


def test_a_missing_file_is_named_with_its_neighbour(tmp_path: Path) -> None:
    (tmp_path / "sphere.yaml").write_text(text_of("sphere"))
    with pytest.raises(UserError, match=r"there is no file.*sphree\.yaml") as error:
        read_spec(tmp_path / "sphree.yaml")
    assert error.value.hint == "did you mean `sphere.yaml`?"


def test_a_folder_or_binary_instead_of_a_file_is_said(tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(UserError, match="not UTF-8"):
        read_spec(tmp_path / "m.yaml")
    with pytest.raises(UserError, match="cannot read"):
        read_spec(tmp_path)


SIZES = {"euclidean": (3, 3, 3), "torus": (2, 2, 2), "sphere": (3, 3, 2), "hyperbolic": (3, 3, 2), "so3": (4, 3, 3)}


@pytest.mark.parametrize("name", SIZES)
def test_bundled_files_have_their_sizes(name: str) -> None:
    spec = read_spec(MANIFOLDS / f"{name}.yaml")
    assert (spec.point_size, spec.tangent_size, spec.dim) == SIZES[name]
    assert spec.name == spec.identifier == name
    assert spec.embedded == (name in ("sphere", "hyperbolic", "so3"))
    assert spec.ambient_tangents == (name in ("sphere", "hyperbolic"))


def test_parameters_change_sizes_and_name() -> None:
    spec = read(text_of("sphere"), n=5)
    assert (spec.point_size, spec.dim, spec.identifier) == (6, 5, "sphere_n5")
    assert dict(spec.parameters) == {"n": Fraction(5), "radius": Fraction(1)}
    assert read(text_of("sphere"), n="5") == spec


def test_a_parameter_with_its_own_value_is_no_other_manifold() -> None:
    assert read(text_of("sphere"), n=2).identifier == "sphere"
    assert read(text_of("sphere"), n=2.0).content_hash == read(text_of("sphere")).content_hash


@pytest.mark.parametrize(
    ("value", "identifier"),
    [(2, "m_R2"), (0.5, "m_R0p5"), ("1/4", "m_R0p25"), (-1, "m_Rm1"), (0.1, "m_R0p1"), (1e-7, "m_R1em07")],
)
def test_names_of_parameters_are_names_in_c(value: int | float | str, identifier: str) -> None:
    text = edited("euclidean", "{n: 3}", "{n: 3, R: 1}").replace("manifold: euclidean", "manifold: m")
    spec = read(text, R=value)
    assert spec.identifier == identifier
    assert spec.identifier.isidentifier()


def test_decimals_are_kept_as_they_are_written() -> None:
    spec = read(edited("euclidean", "{n: 3}", "{n: 3, R: 0.1}"))
    assert dict(spec.parameters)["R"] == Fraction(1, 10)
    assert dict(read(edited("euclidean", "{n: 3}", "{n: 3, R: 1}"), R=0.3).parameters)["R"] == Fraction(3, 10)


def test_the_content_hash_changes_with_text_and_parameters_only(tmp_path: Path) -> None:
    text = text_of("sphere")
    original = read(text).content_hash
    assert len({original, read(text + "# more\n").content_hash, read(text, n=3).content_hash}) == 3
    for folder, name in (("a", "sphere.yaml"), ("b", "other.yaml")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / name).write_text(text)
        assert read_spec(tmp_path / folder / name).content_hash == original
    assert read(text.replace("\n", "\r\n")).content_hash == original


def test_block_scalars_and_bare_numbers_are_formulas() -> None:
    text = edited("euclidean", EXP, "exp: >\n  p\n  + v\n").replace("radius: infinity", "radius: 1.5")
    spec, plain = read(text), read(text_of("euclidean"))
    assert spec.exp.value.shape == plain.exp.value.shape == (3,)
    assert spec.injectivity_radius is not None
    assert spec.injectivity_radius.value.text == "1.5"


def test_an_error_in_a_block_scalar_stands_in_its_line() -> None:
    with pytest.raises(UserError) as error:
        read(edited("euclidean", EXP, "exp: |\n  p +\n  w\n"))
    assert error.value.span is not None
    assert 7 <= error.value.span.line <= 9
    assert "`w`" in error.value.message


def test_a_spec_is_frozen() -> None:
    spec = read(text_of("torus"))
    with pytest.raises(AttributeError):
        spec.dim = 3  # type: ignore[misc]
    assert replace(spec, dim=3).dim == 3
