"""A manifold file with one thing wrong is refused, by the promise that it breaks, at the line to blame.

python tests/test_mutants.py        prints the table of mutants: refused / total
"""

from __future__ import annotations

import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import pytest
from compiled import MANIFOLDS

from rsrm_gen.compiler.audit.product import check_formulas
from rsrm_gen.compiler.audit.report import AuditReport
from rsrm_gen.compiler.driver import compile_manifold, derived
from rsrm_gen.compiler.lower import lower
from rsrm_gen.compiler.spec import read_spec
from rsrm_gen.errors import UserError

Edits = tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Mutant:
    """A manifold file with some text replaced: what must be said, and a piece of the line to blame."""

    manifold: str
    edits: Edits
    says: str  # a pattern in the message
    blames: str  # in the line of the file to which the error points
    hints: str = ""  # a pattern in the hint
    code: bool = False  # whether only the numbers of the generated code show it

    def text(self) -> str:
        text = FILES.get(self.manifold) or (MANIFOLDS / f"{self.manifold}.yaml").read_text()
        for old, new in self.edits:
            assert old in text, f"the file no longer says `{old}`"
            text = text.replace(old, new)
        return text


# Manifolds that no bundled file stands for: a chart whose metric and distance weigh the coordinates, a curved chart.
FILES = {
    "weighted": """
manifold: weighted
doc: A plane and an angle; a radian counts as much as w units of length.
parameters: {w: 3}
chart:
  space: R^3
  period: [null, null, 2 * pi]
metric: u[0] * v[0] + u[1] * v[1] + w^2 * u[2] * v[2]
exp: "[p[:2] + v[:2], wrap(p[2] + v[2])]"
log: "[q[:2] - p[:2], wrap(q[2] - p[2])]"
distance: sqrt((q[0] - p[0])^2 + (q[1] - p[1])^2 + (w * wrap(q[2] - p[2]))^2)
injectivity_radius: w * pi
""",
    "half_line": """
manifold: half_line
doc: The positive numbers by their logarithms.
chart:
  space: R^1
  domain: p[0] > 0
metric: u[0] * v[0] / p[0]^2
exp: "[p[0] * exp(v[0] / p[0])]"
log: "[p[0] * log(q[0] / p[0])]"
distance: abs(log(q[0] / p[0]))
injectivity_radius: infinity
""",
}

SPHERE_EXP, SPHERE_LOG = "exp: cos(norm(v)) * p + sinc(norm(v)) * v", "value: t * w / norm(w)"
RETRACTION = (
    (SPHERE_EXP, "exp: (p + v) / norm(p + v)"),
    (SPHERE_LOG, "value: q / dot(p, q) - p"),
    ("distance: t\n", ""),
    ("injectivity_radius: pi", "injectivity_radius: pi / 2"),
    ("diameter: pi\n", ""),
    ("sample: normal / norm(normal)\n", ""),
)
NO_CUT = (("cut_locus:                                # every direction leads to the antipode; one is returned\n", ""),
          ("  where: norm(q + p) <= 4 * eps\n", ""), ("  log: pi * orthogonal(p)\n", ""),
          ("  log_det: (n - 1) * log(pi / (4 * eps))\n", ""))  # fmt: skip
WIDE = (("{radius: 1}", "{radius: 2}"),)
INVERSE = r"Exp_p\(Log_p\(q\)\) = q"

MUTANTS = {
    # Exp
    "a sign in Exp": Mutant("sphere", (("p + sinc", "p - sinc"),), "with the velocity v", "exp: cos", "-1.0 times v"),
    "Exp too fast": Mutant("torus", (("wrap(p + v)", "wrap(p + 2 * v)"),), "with the velocity v", "exp:", "2.0 times"),
    "Exp in half angles": Mutant(
        "so3", (("cos(norm(v) / 2), sinc(norm(v) / 2) / 2", "cos(norm(v)), sinc(norm(v))"),), "velocity", "exp:", "2.0"
    ),
    "Exp that leaves the manifold": Mutant(
        "sphere", (("sinc(norm(v)) * v", "1.1 * sinc(norm(v)) * v"),), "satisfies the constraint", "exp: cos"
    ),
    "a hyperbolic Exp on a sphere": Mutant(
        "sphere", ((SPHERE_EXP, "exp: cosh(norm(v)) * p + sinhc(norm(v)) * v"),), "satisfies the constraint", "exp: cosh"
    ),
    "Exp of another frame": Mutant("so3", (("exp: qmul(p, [", "exp: qmul(conj(p), ["),), "velocity v", "exp:"),
    "Exp from the left": Mutant(
        "so3",
        (("exp: qmul(p, [cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v])",
          "exp: qmul([cos(norm(v) / 2), sinc(norm(v) / 2) / 2 * v], p)"),),
        "velocity v", "exp:",
    ),
    "a swapped coordinate in Exp": Mutant(
        "torus", (("wrap(p + v)", "'[wrap(p[0] + v[1]), wrap(p[1] + v[0])]'"),), "velocity v", "exp:"
    ),
    "a retraction claimed to be geodesic": Mutant(
        "sphere", RETRACTION + NO_CUT, "constant speed", "exp: (p + v)", "maps: retraction"
    ),
    "formulas that change far away": Mutant(
        "euclidean",
        (
            ("exp: p + v", "exp: where(dot(v, v) > 5, p + 3 * v, p + v)"),
            ("log: q - p", "log: where(dot(q - p, q - p) > 5, 2 * (q - p), q - p)"),
        ),
        "velocity|constant speed", "exp:",
    ),
    # the metric
    "one entry of the metric": Mutant(
        "sphere", (("dot(u, v)", "dot(u, v) + u[0] * v[0]"),), "constant speed", "metric:", "not of this metric"
    ),
    "a metric off by a factor": Mutant("sphere", (("dot(u, v)", "4 * dot(u, v)"),), "", "metric:", "0.5 times"),
    "a metric off by a factor, no distance given": Mutant(
        "torus", (("metric: dot(u, v)", "metric: 4 * dot(u, v)"),), "diameter", "diameter:", "(1.99|2.0).*scale of"
    ),
    "a metric that is too small": Mutant(
        "so3", (("metric: dot(u, v)", "metric: dot(u, v) / 4"),), "inside the injectivity", "metric:", "2.0 times"
    ),
    "a metric with a swapped entry": Mutant(
        "weighted", (("u[1] * v[1] +", "u[1] * v[2] +"),), "not symmetric|no inverse", "metric:"
    ),
    "two weights of the metric swapped": Mutant(
        "weighted", (("u[1] * v[1] + w^2 * u[2]", "w^2 * u[1] * v[1] + u[2]"),), "inside the injectivity radius", "metric:"
    ),
    "a metric that varies under a constant Exp": Mutant(
        "torus", (("dot(u, v)", "(1 + sin(p[0])^2) * dot(u, v)"),), "constant speed", "metric:", "not of this metric"
    ),
    "an asymmetric metric": Mutant(
        "torus", (("metric: dot(u, v)", "metric: [[1, 1/2], [0, 1]]"),), "not symmetric", "metric:"
    ),
    "a negative metric": Mutant("euclidean", (("dot(u, v)", "-dot(u, v)"),), "not positive", "metric:"),
    "a quadratic metric": Mutant("euclidean", (("dot(u, v)", "dot(u, v)^2"),), "not linear", "metric:"),
    "the metric of another signature": Mutant(
        "hyperbolic", (("- u[0] * v[0]", "+ u[0] * v[0]"),), "`norm` is the length|metric", "metric:"
    ),
    "a skewed torus whose Log is not the shortest way": Mutant(
        "torus",
        (("metric: dot(u, v)", "metric: [[1, 9/10], [9/10, 1]]"), ("diameter: pi * sqrt(n)", ""), ("radius: pi", "radius: 1"),
         ("sample: wrap(2 * pi * uniform)", ""),
         ("cut_locus: {where: max(abs(wrap(q - p))) = pi, policy: tie}", "")),
        "shorter than the distance", "log:",
    ),
    # Log
    "Log of the other side": Mutant("so3", (("qmul(conj(p), q)", "qmul(conj(q), p)"),), INVERSE, SPHERE_LOG[:0] + "value: sign"),
    "Log in another tangent space": Mutant(
        "sphere", (("e - dot(p, e) * p", "e - dot(q, e) * q"),), "tangent to the manifold at p", SPHERE_LOG
    ),
    "Log of twice the length": Mutant("sphere", ((SPHERE_LOG, "value: 2 * t * w / norm(w)"),), INVERSE, "value: 2"),
    "Log that takes the long way": Mutant(
        "torus", (("log: wrap(q - p)", "log: q - p"),), "inside the injectivity radius|through its period", "log: q - p"
    ),
    "a Log of half angles": Mutant("so3", (("t: 2 * atan2", "t: atan2"),), INVERSE, "value: sign"),
    # what is stored
    "a projection that is none": Mutant(
        "sphere", (("project: p / norm(p)", "project: p / dot(p, p)"),), "onto the manifold", "project:"
    ),
    "a projection that moves the manifold": Mutant(
        "sphere", (("project: p / norm(p)", "project: -p / norm(p)"),), "leaves its points alone", "project:"
    ),
    "a constraint of another radius": Mutant(
        "sphere", (("dot(p, p) - 1", "dot(p, p) - 4"),), "onto the manifold", "constraint:"
    ),
    "a constraint of the wrong sign": Mutant(
        "sphere", (("dot(p, p) - 1", "dot(p, p) + 1"),), "onto the manifold", "constraint:"
    ),
    "a constraint of another signature": Mutant(
        "hyperbolic", (("p[0]^2 - dot", "p[0]^2 + dot"),), "onto the manifold", "constraint:"
    ),
    "a frame twice as long": Mutant(
        "so3", (("1/2,", "1,"), ("1/2]", "1]")), "velocity v", "frame:|qmul(p, [0, 1", "look at `frame`.*0.5 times"
    ),
    "a frame from the left": Mutant(
        "so3", (("qmul(p, [0, 1/2, 0, 0])", "qmul([0, 1/2, 0, 0], p)"), ("qmul(p, [0, 0, 1/2, 0])", "qmul([0, 0, 1/2, 0], p)"),
                ("qmul(p, [0, 0, 0, 1/2])", "qmul([0, 0, 0, 1/2], p)")), "velocity v", "qmul([0, 1", "look at `frame`",
    ),
    "a frame with one vector too long": Mutant(
        "so3", (("[0, 0, 1/2, 0]", "[0, 0, 3/2, 0]"),), "velocity v", "qmul(p, [0, 1", "look at `frame`"
    ),
    "a frame that is not tangent": Mutant(
        "so3", (("qmul(p, [0, 1/2, 0, 0])", "qmul(p, [1/10, 1/2, 0, 0])"),), "`frame` are tangent", "[1/10"
    ),
    "a quotient forgotten": Mutant("so3", (("  equivalent: -p\n", ""),), INVERSE, "value: sign", "equivalent: -p"),
    "a quotient that Log forgets": Mutant(
        "so3", (("sign(g[0]) * ", ""), ("abs(g[0])", "g[0]")), "same for every name of q|not before it", "value: t"
    ),
    "another name that is another point": Mutant(
        "so3", (("equivalent: -p", "equivalent: conj(p)"),), "same for every name of q", "equivalent:"
    ),
    "another period than that of Exp": Mutant("torus", (("period: 2 * pi", "period: 2"),), "period", "period:"),
    # lengths
    "a diameter that is too small": Mutant("torus", (("pi * sqrt(n)", "pi"),), "diameter", "diameter:", "1.4"),
    "a diameter that is too large": Mutant("sphere", (("diameter: pi", "diameter: 2 * pi"),), "diameter", "diameter:", "0.5"),
    "too large an injectivity radius": Mutant(
        "torus", (("radius: pi", "radius: 1.2 * pi"),), "inside the injectivity radius", "injectivity_radius:"
    ),
    "a cut locus declared too near": Mutant(
        "sphere", (("<= 4 * eps", "<= 1/4"),), "not before it", "where: norm"
    ),
    "a cut locus declared too far": Mutant(
        "torus", (("max(abs(wrap(q - p))) = pi", "max(abs(wrap(q - p))) = 2 * pi"),), "on the cut locus", "cut_locus:"
    ),
    "a Log on the cut locus of another length": Mutant(
        "sphere", (("log: pi * orthogonal", "log: 2 * orthogonal"),), "Log on the cut locus", "log: 2"
    ),
    "a sign in the determinant on the cut locus": Mutant(
        "sphere", (("(n - 1) * log(pi / (4 * eps))", "(1 - n) * log(pi / (4 * eps))"),), "log det on the cut", "log_det: (1"
    ),
    # closed forms
    "another determinant": Mutant(
        "sphere", (("distance: t\n", "distance: t\nlog_det: n * log(t / sin(t))\n"),), "determinant", "log_det: n"
    ),
    "the determinant of another curvature": Mutant(
        "hyperbolic", (("distance: r\n", "distance: r\nlog_det: (n - 1) * log(sinh_r / r)\n"),), "determinant", "log_det: (n"
    ),
    "another distance": Mutant(
        "sphere", (("distance: t\n", "distance: 2 * t\n"),), "length of Log", "distance: 2", "2.0 times"
    ),
    "the chord for the distance": Mutant(
        "sphere", (("distance: t\n", "distance: norm(d)\n"),), "length of Log", "distance: norm"
    ),
    "a weight forgotten in the distance": Mutant(
        "weighted", (("(w * wrap(q[2] - p[2]))^2", "wrap(q[2] - p[2])^2"),), "length of Log", "distance:"
    ),
    "another norm": Mutant("hyperbolic", (("norm: r ", "norm: 2 * r "),), "`norm` is the length", "norm: 2", "2.0 times"),
    "a power of the metric of a chart": Mutant(
        "half_line", (("u[0] * v[0] / p[0]^2", "u[0] * v[0] / p[0]"),), "constant speed", "metric:", "not of this metric"
    ),
    # what an expert may get wrong: factors, halves, sides
    "a conformal factor without its 4": Mutant(
        "poincare", (("metric: 4 * dot", "metric: dot"),), "length of Log", "distance: t", "2.0 times"
    ),
    "a conformal factor of 2": Mutant(
        "poincare", (("metric: 4 * dot", "metric: 2 * dot"),), "length of Log", "distance: t", "1.41421 times"
    ),
    "a conformal factor that is not squared": Mutant(
        "poincare", (("dot(p, p))^2", "dot(p, p))"),), "constant speed", "metric: 4", "not of this metric"
    ),
    "a velocity twice as long on the ball": Mutant(
        "poincare", (("w: v / a", "w: 2 * v / a"),), "velocity v", "value: (ss", "2.0 times"
    ),
    "a Log scaled at the wrong point of the ball": Mutant(
        "poincare", (("sinh_t / b", "sinh_t / a"),), INVERSE, "value: t / sinh_t"
    ),
    "a power of the determinant": Mutant(
        "poincare", (("distance: t\n", "distance: t\nlog_det: n * log(t / sinh_t)\n"),), "determinant", "log_det: n", "`log_det`"
    ),
    "a determinant in coordinates": Mutant(
        "poincare", (("distance: t\n", "distance: t\nlog_det: (n - 1) * log(t / sinh_t) + n * log(a / b)\n"),),
        "log .det D Log.", "log_det: (n",
    ),
    "a half space's metric not squared": Mutant(
        "half_space", (("dot(u, v) / p[n-1]^2", "dot(u, v) / p[n-1]"),), "constant speed", "metric:", "not of this metric"
    ),
    "sinh of another part of the distance": Mutant("half_space", (("4 * y * z", "2 * y * z"),), INVERSE, 'value: "t / sinh_t'),
    "a radius forgotten in the metric": Mutant(
        "cylinder", (*WIDE, ("radius^2 * u[0]", "u[0]")), "inside the injectivity radius", "injectivity_radius:"
    ),
    "a radius forgotten in the distance": Mutant(
        "cylinder", (*WIDE, ("injectivity", "distance: sqrt(wrap(q[0] - p[0])^2 + (q[1] - p[1])^2)\ninjectivity")),
        "length of Log", "distance:", "look at `distance`",
    ),
    "a radius in the determinant": Mutant(
        "cylinder", (*WIDE, ("injectivity", "log_det: log(radius)\ninjectivity")), "determinant", "log_det:"
    ),
    "a radius forgotten in the injectivity radius": Mutant(
        "cylinder", (("{radius: 1}", "{radius: 1/2}"), ("pi * radius", "pi")), "inside the injectivity", "injectivity_radius: pi"
    ),
    "a Log without the congruence": Mutant(
        "spd", (("L: logm(r * q * r)", "L: logm(q) - logm(p)"),), INVERSE, "value: svec(L)", "look at `log`"
    ),
    "half the metric of covariances": Mutant(
        "spd", (("metric: dot(u, v)", "metric: dot(u, v) / 2"),), "length of Log", "distance: norm(L)", "1.41421 times"
    ),
    "a frame without its square roots": Mutant(
        "spd", (("frame: sqrtm(p) * smat(v) * sqrtm(p)", "frame: p * smat(v) * p"),), "velocity v", "frame:", "look at `frame`"
    ),
    "a factor in ad squared": Mutant("spd", (("ad_squared(L) / 4", "ad_squared(L)"),), "determinant", "log_det:"),
    "a transport by the whole way": Mutant("spd", (("expm(L / 2)}", "expm(L)}"),), "in parallel", "value: svec(O"),
    "a transport with its half on the other side": Mutant(
        "spd", (("sqrtm(p) * expm(L / 2)}", "expm(L / 2) * sqrtm(p)}"),), "in parallel", "value: svec(O"
    ),
    "a transport that does not turn": Mutant(
        "spd", (("{O: invsqrtm(q) * sqrtm(p) * expm(L / 2)}", "{O: eye(n)}"),), "in parallel", "value: svec(O"
    ),
    "a frame of matrices from the left": Mutant(
        "so3_matrix", (("frame: p * hat(v)", "frame: hat(v) * p"),), "velocity v", "frame:", "look at `frame`"
    ),
    "a Log of matrices from the left": Mutant(
        "so3_matrix", (("transpose(p) * q)", "q * transpose(p))"),), INVERSE, "value: sign", "look at `log`"
    ),
    "a transport of matrices that turns forth": Mutant(
        "so3_matrix", (("-sign(g[0]) * s]", "sign(g[0]) * s]"),), "in parallel", "value: rotation(h"
    ),
    "the metric of matrices with the distance of angles": Mutant(
        "so3_matrix", (("metric: dot(u, v)", "metric: 2 * dot(u, v)"),), "length of Log", "metric:", "0.7071"
    ),
    "a domain without the samples": Mutant(
        "so3_matrix", (("det(p) > 0", "det(p) < 0"),), "inside its `domain`", "value: rotation(a", code=True
    ),
    "straight lines claimed to be geodesics": Mutant(
        "arm2", (("maps: retraction\n", ""),), "constant speed", "metric:", "maps: retraction"
    ),
    "an inertia dropped from one entry": Mutant(
        "arm2", (("[d + b * cos(p[1]), d]]", "[d, d]]"),), "not symmetric", "metric:"
    ),
    "an inertia halved on the diagonal": Mutant("arm2", (("a + 2 * b", "a + b"),), "determinant", "value: atanh"),
    "a weight on the other factor of the distance": Mutant(
        "weighted",
        (("(q[0] - p[0])^2 + (q[1] - p[1])^2 + (w * wrap", "(w * (q[0] - p[0]))^2 + (w * (q[1] - p[1]))^2 + (wrap"),),
        "length of Log", "distance:", "look at `distance`",
    ),
    "a weight on the other factor of the metric": Mutant(
        "weighted", (("u[0] * v[0] + u[1] * v[1] + w^2 * u[2] * v[2]", "w^2 * (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2]"),),
        "inside the injectivity radius", "metric:", "look at `metric`",
    ),
    "a weight not squared in the metric": Mutant(
        "weighted", (("w^2 * u[2]", "w * u[2]"),), "inside the injectivity radius", "metric:", "look at `metric`"
    ),
    # digits
    "a distance that loses its digits": Mutant(
        "sphere", (("distance: t\n", "distance: acos(dot(p, q))\n"),), "distance of the .* code .* exact", "distance: acos",
        "loses [789] of 16 digits.*atan2", code=True,
    ),
    "an angle that loses its digits": Mutant(
        "sphere", (("t: 2 * atan2(norm(d), norm(q + p))", "t: acos(dot(p, q))"),), "0/0", "acos",
        "loses [789] of 16 digits.*atan2",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MUTANTS)
def test_a_wrong_formula_is_refused_where_it_stands(name: str, tmp_path: Path) -> None:
    mutant = MUTANTS[name]
    error = refusal(mutant, tmp_path)
    assert error is not None, "the mutant passes"
    assert re.search(mutant.says, error.message), error
    assert re.search(mutant.hints, error.hint or ""), error
    assert error.span is not None
    line = error.span.source.line(error.span.line)
    assert any(piece in line for piece in mutant.blames.split("|")), error
    assert 1 <= error.span.column <= len(line)


RIGHT: dict[str, tuple[str, Edits]] = {
    "a plane and an angle": ("weighted", ()),
    "a half line": ("half_line", ()),
    "a wide cylinder": ("cylinder", WIDE),
    "curvature -4": ("poincare", (("metric: 4 * dot", "metric: dot"), ("distance: t\n", "distance: t / 2\n"))),
    "curvature -9": ("poincare", (("metric: 4 * dot", "metric: 4/9 * dot"), ("distance: t\n", "distance: t / 3\n"))),
    "a half space of curvature -4": (
        "half_space", (("dot(u, v) / p", "dot(u, v) / 4 / p"), ("distance: t\n", "distance: t / 2\n"))
    ),
    "Fisher's metric of centred Gaussians": (
        "spd", (("metric: dot(u, v)", "metric: dot(u, v) / 2"), ("norm(L)\n", "norm(L) / sqrt(2)\n"))
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", RIGHT)
def test_what_is_right_is_not_refused(name: str, tmp_path: Path) -> None:
    manifold, edits = RIGHT[name]
    assert refusal(Mutant(manifold, edits, "", ""), tmp_path) is None


def test_there_are_mutants_enough() -> None:
    assert len(MUTANTS) >= 30


def refusal(mutant: Mutant, folder: Path) -> UserError | None:
    """How the mutant is refused: by the file's formulas alone, or where need be by its code; None if it is not."""
    file = folder / f"{mutant.manifold}.yaml"
    file.write_text(mutant.text())
    try:
        if mutant.code:
            compile_manifold(file)
            return None
        geometry = derived(read_spec(file))
        program = lower(geometry)
        AuditReport(mutant.manifold, "", tuple(check_formulas(geometry, program)), ()).require()
    except UserError as error:
        return error
    return None


def main() -> int:
    """Print the table: each mutant with the line to blame and what is said."""
    refused = 0
    for name, mutant in MUTANTS.items():
        with tempfile.TemporaryDirectory() as folder:
            error = refusal(mutant, Path(folder))
        refused += error is not None
        at = (
            f"line {error.span.line}: {error.span.source.line(error.span.line).strip()}"
            if error and error.span
            else "?"
        )
        print(f"{name} ({mutant.manifold})\n    {at if error else 'PASSES'}")
        print(f"    {error.message}\n    {error.hint}" if error else "")
    print(f"refused / total: {refused} / {len(MUTANTS)}")
    return 0 if refused == len(MUTANTS) else 1


if __name__ == "__main__":
    sys.exit(main())
