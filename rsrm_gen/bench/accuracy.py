"""Exp, Log, distance and determinant of the generated code and of other tools, on the same pairs of points.

Everything is measured in one run: the pairs (`rows.py`), the truth at them in 60 digits, and every code's error in units
of what rounding the inputs and the output alone costs (`measure.py`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rsrm_gen.bench.measure import DETERMINANT, FUNCTIONS, LOST, Score, measure
from rsrm_gen.bench.peers import PEERS, Evaluate, Peer
from rsrm_gen.bench.rows import Band, bands
from rsrm_gen.bench.table import Table, figure, machine
from rsrm_gen.compiler.audit.numbers import PRECISIONS, ROUTINES, Batch, Code
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.emit import emit
from rsrm_gen.compiler.lower import lower
from rsrm_gen.compiler.spec import Spec, read_spec

Case = tuple[Path, Mapping[str, int | float | str]]  # a manifold file and its parameters

OURS = ("rsrm-gen torch", "rsrm-gen C")
WORDS = {
    "exp": "Exp",
    "log": "Log",
    "distance": "distance",
    "log_abs_det": "log|det D Log|",
    DETERMINANT: "|det D Log|",
}
LEGEND = (
    "Median / worst error, in units of what rounding the inputs and the output alone costs; (n) rows of a band are worse "
    "than 2^20 units, not finite, or raise; NaN: a result that is not finite; †: one row makes the whole batch raise, and "
    "the others were measured one by one; -: there is no such function; left out: pairs, for every code, of which a point "
    "is within 64 roundings of the border of the domain. The unit of log|det D Log| is relative to the logarithm, which "
    "vanishes where points are close; that of |det D Log| is relative to the determinant, and fair to a code that computes "
    "the determinant first."
)


@dataclass(frozen=True)
class Entry:
    """One score, or None where the code has no such function, and what it is the score of."""

    manifold: str
    precision: str
    function: str
    band: str
    code: str
    score: Score | None
    left_out: int = 0  # pairs of the band, for every code


@dataclass(frozen=True)
class Accuracy:
    """All that was measured in one run; `versions` of the peers, and those `missing`, each with the reason."""

    entries: tuple[Entry, ...]
    versions: Mapping[str, str]
    missing: tuple[str, ...]

    @property
    def codes(self) -> list[str]:
        """The codes in the order of the tables."""
        return list(dict.fromkeys(entry.code for entry in self.entries))

    def worst(self) -> list[Table]:
        """One table a precision: of every function the worst error of all bands."""
        return [self._worst(precision) for precision in PRECISIONS]

    def counts(self) -> Table:
        """Of every code how many results are lost; log|det| counts by the determinant's error."""
        headings = (
            "code",
            "precision",
            "results",
            "worse than 2^20 units",
            "not finite",
            "raise alone",
            "batches that raise",
        )
        rows = [(code, p, *map(str, self._counts(code, p))) for code in self.codes for p in PRECISIONS]
        return Table("Results lost, over all manifolds and bands", headings, tuple(r for r in rows if r[2] != "0"), 2)

    def bands(self) -> list[Table]:
        """One table a manifold and precision: every function on every band."""
        manifolds = dict.fromkeys(entry.manifold for entry in self.entries)
        return [self._bands(manifold, precision) for manifold in manifolds for precision in PRECISIONS]

    def document(self) -> dict[str, Any]:
        """Plain data for JSON; an error that is infinite is null there, beside the counts that say why."""
        entries = [{**asdict(e), "score": e.score and _finite(asdict(e.score))} for e in self.entries]
        return {"machine": machine(), "versions": dict(self.versions), "lost": LOST, "entries": entries}

    def foot(self) -> str:
        """What is needed to read the tables and to repeat them."""
        versions = ", ".join(f"{name} {version}" for name, version in self.versions.items())
        missing = f" Left out: {'; '.join(self.missing)}." if self.missing else ""
        return f"{LEGEND}\n\nMeasured with {versions}.{missing} {machine()}."

    def _worst(self, precision: str) -> Table:
        chosen = [e for e in self.entries if e.precision == precision]
        keys = dict.fromkeys((e.manifold, e.function) for e in chosen)
        rows = [
            (manifold, WORDS[f], *(_worst_cell(_of(chosen, code, manifold, f)) for code in self.codes))
            for manifold, f in keys
        ]
        title = f"Worst error of all pairs, {precision}"
        return Table(title, ("manifold", "function", *self.codes), tuple(rows), 2)

    def _bands(self, manifold: str, precision: str) -> Table:
        chosen = [e for e in self.entries if (e.manifold, e.precision) == (manifold, precision)]
        keys = dict.fromkeys((f, e.band, e.left_out) for f in FUNCTIONS for e in chosen if e.function == f)
        rows = [
            (
                WORDS[f],
                band + (f" ({left_out} left out)" if left_out else ""),
                *(_cell(score) for c in self.codes for score in _of(chosen, c, manifold, f, band)),
            )
            for f, band, left_out in keys
        ]
        return Table(f"{manifold}, {precision}", ("function", "pairs", *self.codes), tuple(rows), 2)

    def _counts(self, code: str, precision: str) -> tuple[int, ...]:
        scores = [
            e.score
            for e in self.entries
            if (e.code, e.precision) == (code, precision) and e.function != "log_abs_det" and e.score is not None
        ]
        return (
            sum(s.rows for s in scores),
            sum(s.lost for s in scores),
            sum(s.not_finite for s in scores),
            sum(s.raised for s in scores),
            sum(s.batch_raised for s in scores),
        )


def accuracy(
    cases: Sequence[Case],
    count: int,
    peers: Sequence[Peer] = PEERS,
    say: Callable[[str], None] = lambda words: None,
) -> Accuracy:
    """Measure every code on every manifold, on `count` pairs a band; `say` is told what is going on.

    Peers that are not installed, or do not import, are left out and named in the result.
    """
    entries: list[Entry] = []
    unusable: dict[str, str] = {}
    for file, parameters in cases:
        spec = read_spec(file, parameters)
        unusable |= {peer.name: why for peer in peers if (why := peer.unusable(spec)) is not None}
        entries += _of_manifold(spec, count, [peer for peer in peers if peer.name not in unusable], say)
    versions = {peer.name: peer.version for peer in peers if peer.name not in unusable}
    return Accuracy(tuple(entries), versions, tuple(f"{name}: {why}" for name, why in unusable.items()))


def _of_manifold(spec: Spec, count: int, peers: Sequence[Peer], say: Callable[[str], None]) -> Iterator[Entry]:
    name = spec.identifier
    say(f"{name}: generating")
    geometry = derive(spec)
    program = lower(geometry)
    files = emit(geometry, program)
    ours = dict(zip(OURS, Code(geometry, program, files).backends.values(), strict=False))  # without C, torch alone
    for precision in PRECISIONS:
        say(f"{name}, {precision}: the truth in 60 digits")
        places = list(bands(geometry, program, precision, count))
        codes: dict[str, Mapping[str, Evaluate]] = {code: _ours(batch, precision) for code, batch in ours.items()}
        codes |= {peer.name: peer.functions(spec, precision) for peer in peers}
        for code, functions in codes.items():
            say(f"{name}, {precision}: {code}")
            yield from _entries(name, precision, code, functions, places)


def _ours(batch: Batch, precision: str) -> dict[str, Evaluate]:
    def function(name: str) -> Evaluate:
        return lambda a, b: batch(name, (a, b), precision)

    return {name: function(name) for name in ROUTINES}


def _entries(
    manifold: str, precision: str, code: str, functions: Mapping[str, Evaluate], places: Iterable[Band]
) -> Iterator[Entry]:
    for band in places:
        for function, score in measure(functions, band).items():
            yield Entry(manifold, precision, function, band.name, code, score, band.left_out)


def _of(
    entries: Iterable[Entry], code: str, manifold: str, function: str, band: str | None = None
) -> list[Score | None]:
    """The scores of one code and function, on one band or on all."""
    return [
        e.score
        for e in entries
        if (e.code, e.manifold, e.function) == (code, manifold, function) and band in (None, e.band)
    ]


def _worst_cell(scores: Sequence[Score | None]) -> str:
    known = [score for score in scores if score is not None]
    if not known:
        return "-"
    return _error(max(score.worst for score in known), sum(score.not_finite for score in known))


def _cell(score: Score | None) -> str:
    if score is None:
        return "-"
    bad = score.lost + score.not_finite + score.raised
    text = f"{_error(score.median, score.not_finite)} / {_error(score.worst, score.not_finite)}"
    return text + (f" ({bad})" if bad else "") + ("†" if score.batch_raised else "")


def _error(error: float, not_finite: int) -> str:
    if math.isfinite(error):
        return figure(error)
    return "NaN" if not_finite else "raises"


def _finite(score: dict[str, Any]) -> dict[str, Any]:
    return {key: None if isinstance(x, float) and not math.isfinite(x) else x for key, x in score.items()}
