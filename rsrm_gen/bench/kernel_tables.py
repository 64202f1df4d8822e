"""The tables of `rsrm bench kernels`, and what is said below them."""

from __future__ import annotations

from rsrm_gen.bench.kernels import COMPARED, TOLERANCE, Kernels, Size
from rsrm_gen.bench.quiet import LOUD
from rsrm_gen.bench.table import Table, machine

# What is aimed at with two threads in float32, 4096 points and 512 splats: times faster than eager torch, and than JAX.
AIMED_AT: tuple[str, int, Size] = ("float32", 2, (4096, 512))
TIMES = {
    "torus": (70, 40),
    "sphere": (90, 55),
    "hyperbolic": (65, 48),
    "so3": (75, 70),
    "torus_n6": (32, 18),
    "sphere_n5": (50, 48),
}
SHARE, SCALING = 0.55, 1.8  # of the peak, on the sphere; one thread's time through that of two


def tables(result: Kernels) -> list[Table]:
    """The medians, how many times longer than ours, the kernel's share of the peak, and what is aimed at."""
    keys = dict.fromkeys((precision, threads) for _, precision, threads, _ in result.timed)
    found = [make(result, *key) for key in keys for make in (_medians, _ratios)]
    return [*found, _kernel(result), *_scaling(result), *_goals(result)]


def foot(result: Kernels) -> str:
    """What is needed to read the tables and to repeat them."""
    peaks = ", ".join(f"{rate / 1e9:.1f} ({p}, {_threads(t)})" for (p, t), rate in result.peaks.items())
    operations = ", ".join(f"{m} {n}" for (m, p), n in result.operations.items() if p == "float32")
    notes = dict.fromkeys(f"{e.contender} on {e.manifold}, {e.precision}: {e.note}" for e in result.entries if e.note)
    versions = ", ".join(f"{name} {number}" for name, number in result.versions.items())
    points, splats = COMPARED
    return "\n\n".join(
        [
            f"Medians of at most {result.rounds} rounds, in each of which every contender, in its own process, takes its "
            "steps. A step is the loss and its gradient in v, mu and A; `its kernel alone` is the sum of splats, forward "
            "and backward. Chunks of points: the best of three sizes.",
            f"Before, all are compared with plain formulas in float64 on {points} points and {splats} splats: `wrong` is "
            f"who differs by more than {TOLERANCE['float64']:g} in float64, {TOLERANCE['float32']:g} in float32, relative "
            "to the norm of the loss or a gradient (in the centres the Riemannian one).",
            "Operations of the kernel for a pair, forward and backward, counted from the generated routines: 1 for an "
            "addition, multiplication, division or root, so 2 for a multiply-add; 2 for a step of a polynomial; 27 for exp "
            "and other functions (15 in float32); 1 for adding a result to its sum; 0 for what compares, chooses or "
            "changes a sign. "
            + (f"In float32: {operations}. " if operations else "")
            + (f"Measured peak of multiply-adds, 10^9 operations in a second: {peaks}." if peaks else ""),
            *(["Not timed: " + "; ".join(notes) + "."] if notes else []),
            *([f"Left out: {'; '.join(result.missing)}."] if result.missing else []),
            f"Measured with {versions}. {machine()}.{_disturbed(result)}",
        ]
    )


def _disturbed(result: Kernels) -> str:
    if result.others is None:
        return ""
    used = f" Between the rounds other programs used {result.others:.1f} cores, at worst."
    loud = " DISTURBED: these are not the figures of a quiet machine, and ratios say little, above all with several threads."
    return used + (loud if result.others > LOUD else "")


def _medians(result: Kernels, precision: str, threads: int) -> Table:
    """Milliseconds a step."""
    rows = [
        (what[0], _size(what[3]), *(_cell(result, what, c.key) for c in result.contenders))
        for what in result.timed
        if what[1:3] == (precision, threads)
    ]
    headings = ("manifold", "points x splats", *(c.name for c in result.contenders))
    return Table(f"Milliseconds a step, {precision}, {_threads(threads)}", headings, tuple(rows), 2)


def _ratios(result: Kernels, precision: str, threads: int) -> Table:
    """How many times longer than ours."""
    others = [c for c in result.contenders if c.whole and c.key != "ours"]
    compiled = [c for c in others if c.key == "compiled"]
    rows = [
        (
            what[0],
            _size(what[3]),
            *(_times(result.ratio(what, c.key)) for c in others),
            *(_compile_seconds(result, what, c.key) for c in compiled),
        )
        for what in result.timed
        if what[1:3] == (precision, threads)
    ]
    headings = ("manifold", "points x splats", *(c.name for c in others), *("compile, s" for _ in compiled))
    return Table(f"Times longer than rsrm-gen, {precision}, {_threads(threads)}", headings, tuple(rows), 2)


def _kernel(result: Kernels) -> Table:
    """The kernel beside the peak."""
    rows = [
        (
            manifold,
            precision,
            _size(size),
            str(threads),
            _milliseconds(result.median(what, "kernel")),
            _number(result.rate(what), 1e9),
            _percent(result.share(what)),
        )
        for what in result.timed
        for manifold, precision, threads, size in [what]
    ]
    headings = ("manifold", "precision", "points x splats", "threads", "ms", "10^9 operations/s", "of the peak")
    return Table("The kernel alone, forward and backward", headings, tuple(rows), 3)


def _scaling(result: Kernels) -> list[Table]:
    """One thread's time through that of more; no table where there was one number of threads."""
    counts = sorted({threads for _, _, threads, _ in result.timed})
    if len(counts) < 2:
        return []
    keys = dict.fromkeys((m, p, s) for m, p, _, s in result.timed)
    rows = [
        (m, p, _size(s), *(_times(_speedup(result, m, p, s, c, counts[0], counts[-1])) for c in ("ours", "kernel")))
        for m, p, s in keys
    ]
    title = f"Times faster with {counts[-1]} threads than with {counts[0]}"
    headings = ("manifold", "precision", "points x splats", "rsrm-gen", "its kernel alone")
    return [Table(title, headings, tuple(rows), 3)]


def _goals(result: Kernels) -> list[Table]:
    """What was reached beside what is aimed at; no table where that was not measured."""
    precision, threads, size = AIMED_AT
    rows = []
    for what in result.timed:
        if what[1:] != AIMED_AT:
            continue
        eager, jax = TIMES.get(what[0], (None, None))
        for name, key, aim in (("than eager torch", "eager", eager), ("than JAX jit", "jax", jax)):
            if aim is not None:
                rows.append((what[0], f"times faster {name}", _times(result.ratio(what, key)), str(aim)))
        if what[0] == "sphere":
            rows.append((what[0], "kernel, of the peak", _percent(result.share(what)), _percent(SHARE)))
        speedup = _speedup(result, what[0], precision, size, "ours", 1, threads)
        if speedup:
            rows.append((what[0], f"times faster with {threads} threads", _times(speedup), f"{SCALING:g}"))
    title = f"Aimed at, {precision}, {_threads(threads)}, {_size(size)}"
    return [Table(title, ("manifold", "what", "reached", "aimed at"), tuple(rows), 2)] if rows else []


def _speedup(result: Kernels, m: str, p: str, s: Size, contender: str, few: int, many: int) -> float | None:
    slow, fast = (result.median((m, p, threads, s), contender) for threads in (few, many))
    return slow / fast if slow and fast else None


def _cell(result: Kernels, what: tuple[str, str, int, Size], contender: str) -> str:
    entry = result.entry(what, contender)
    if entry is None or not entry.note:
        return _milliseconds(entry.median if entry else None)
    return "wrong" if "wrong" in entry.note else "-"


def _compile_seconds(result: Kernels, what: tuple[str, str, int, Size], contender: str) -> str:
    entry = result.entry(what, contender)
    return f"{entry.first - entry.median:.1f}" if entry and entry.first and entry.median else "-"


def _milliseconds(seconds: float | None) -> str:
    return "-" if seconds is None else f"{1e3 * seconds:.3g}" if seconds < 1 else f"{1e3 * seconds:.0f}"


def _times(ratio: float | None) -> str:
    return "-" if ratio is None else f"{ratio:.0f}" if ratio >= 20 else f"{ratio:.2g}"


def _percent(share: float | None) -> str:
    return "-" if share is None else f"{100 * share:.0f} %"


def _number(value: float | None, unit: float) -> str:
    return "-" if value is None else f"{value / unit:.3g}"


def _size(size: Size) -> str:
    return f"{size[0]} x {size[1]}"


def _threads(count: int) -> str:
    return "one thread" if count == 1 else f"{count} threads"
