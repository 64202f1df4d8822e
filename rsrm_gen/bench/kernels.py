"""The seconds of one step of training, written in several ways, on the same points and splats, in one run.

For every number of threads, manifold and precision the contenders (`steps/`) are first compared with plain formulas that
torch differentiates twice, in a case of their own; who disagrees is not timed. Then each, in its own process, takes steps
in turns with the others, round by round, and the medians of the rounds are compared. The limit is how fast this machine
multiplies and adds (`peak.py`), measured at the beginning and at the end of the run.
"""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

from rsrm_gen.bench.operations import pair_operations
from rsrm_gen.bench.peak import fma_peak
from rsrm_gen.bench.peers import bundled_name
from rsrm_gen.bench.quiet import busy_cores
from rsrm_gen.bench.steps import CONTENDERS, FORMULAS, Contender
from rsrm_gen.bench.steps.crew import Crew, FailedError
from rsrm_gen.bench.steps.problem import Problem, problem, read_problem
from rsrm_gen.bench.table import machine
from rsrm_gen.compiler.derive import derive
from rsrm_gen.compiler.lower import lower
from rsrm_gen.compiler.native import compiler
from rsrm_gen.compiler.spec import Spec, read_spec
from rsrm_gen.load import load
from rsrm_gen.manifold import Manifold

Case = tuple[Path, Mapping[str, int | float | str]]  # a manifold file and its parameters
Size = tuple[int, int]  # points and splats

COMPARED: Size = (384, 96)  # points and splats on which contenders are compared
TOLERANCE = {"float64": 1e-8, "float32": 1e-2}  # relative, of the loss and of the norm of each gradient
LOSS_TOLERANCE = {"float64": 1e-8, "float32": 1e-2}  # of the loss of the step that is timed, from our own
SAMPLE = 0.02  # seconds that one sample should take: a short step is repeated
PATIENCE = 900.0  # seconds that a contender may take to prepare, and to take its steps
FEWEST = 3  # rounds, however long they take


@dataclass(frozen=True)
class Plan:
    """What is timed, and how often: `rounds` samples, fewer where all of a size together take more than `limit` seconds."""

    cases: tuple[Case, ...]
    sizes: tuple[Size, ...]
    threads: tuple[int, ...] = (1, 2)
    precisions: tuple[str, ...] = ("float32", "float64")
    contenders: tuple[Contender, ...] = CONTENDERS
    rounds: int = 7
    limit: float = 90.0
    compile_budget: float = 120.0  # seconds that torch.compile may take for one size
    sigma: float | None = None  # the width of the splats, where it is not that of the manifold


@dataclass(frozen=True)
class Entry:
    """The seconds of each sample of one contender, or why there are none."""

    manifold: str
    precision: str
    threads: int
    points: int
    splats: int
    contender: str
    error: float | None = None  # of loss and gradients in the case of `COMPARED`, the worst, relative
    seconds: tuple[float, ...] = ()
    first: float | None = None  # seconds of the first step, compilation included
    chunk: int | None = None  # points a chunk
    others: float | None = None  # cores that other programs used between the samples, the mean
    note: str = ""  # why it is not timed

    @property
    def median(self) -> float | None:
        """Of the seconds."""
        return statistics.median(self.seconds) if self.seconds else None

    @property
    def what(self) -> tuple[str, str, int, Size]:
        """All but the contender: what entries are compared on."""
        return self.manifold, self.precision, self.threads, (self.points, self.splats)


@dataclass(frozen=True)
class Kernels:
    """All that was measured in one run."""

    entries: tuple[Entry, ...]
    peaks: Mapping[tuple[str, int], float]  # of a precision and a number of threads, operations in a second
    operations: Mapping[tuple[str, str], int]  # of a manifold and a precision, for one pair
    contenders: tuple[Contender, ...]
    missing: tuple[str, ...]
    rounds: int
    versions: Mapping[str, str] = field(default_factory=dict)

    def entry(self, what: tuple[str, str, int, Size], contender: str) -> Entry | None:
        """The entry of a contender there."""
        return next((e for e in self.entries if e.what == what and e.contender == contender), None)

    def median(self, what: tuple[str, str, int, Size], contender: str) -> float | None:
        """Its median, None where it was not timed."""
        found = self.entry(what, contender)
        return found.median if found else None

    def ratio(self, what: tuple[str, str, int, Size], contender: str) -> float | None:
        """How many times longer than ours it takes."""
        theirs, ours = self.median(what, contender), self.median(what, "ours")
        return theirs / ours if theirs and ours else None

    def rate(self, what: tuple[str, str, int, Size]) -> float | None:
        """Operations in a second of the kernel alone."""
        manifold, precision, _, (points, splats) = what
        seconds, operations = self.median(what, "kernel"), self.operations.get((manifold, precision))
        return operations * points * splats / seconds if seconds and operations else None

    def share(self, what: tuple[str, str, int, Size]) -> float | None:
        """That rate as a part of the peak."""
        rate, peak = self.rate(what), self.peaks.get((what[1], what[2]))
        return rate / peak if rate and peak else None

    def at_peak(self, what: tuple[str, str, int, Size]) -> float | None:
        """The seconds that the kernel's operations would take at the peak."""
        manifold, precision, threads, (points, splats) = what
        operations, peak = self.operations.get((manifold, precision)), self.peaks.get((precision, threads))
        return operations * points * splats / peak if operations and peak else None

    @property
    def others(self) -> float | None:
        """Cores that other programs used, the worst of all sizes; None where nobody knows."""
        return max((e.others for e in self.entries if e.others is not None), default=None)

    @property
    def timed(self) -> list[tuple[str, str, int, Size]]:
        """What entries are compared on, in the order of the run."""
        return list(dict.fromkeys(entry.what for entry in self.entries))

    def document(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "machine": machine(),
            "others": self.others,
            "versions": dict(self.versions),
            "missing": list(self.missing),
            "peaks": [{"precision": p, "threads": t, "per_second": rate} for (p, t), rate in self.peaks.items()],
            "pair_operations": [
                {"manifold": m, "precision": p, "operations": n} for (m, p), n in self.operations.items()
            ],
            "entries": [
                {**asdict(e), "median": e.median, "ratio": self.ratio(e.what, e.contender)} for e in self.entries
            ],
        }


def kernels(plan: Plan, say: Callable[[str], None] = lambda words: None) -> Kernels:
    """Compare and time all of a plan."""
    missing = [f"{c.name}: {c.missing}" for c in plan.contenders if c.missing]
    contenders = tuple(c for c in plan.contenders if not c.missing)
    specs = [read_spec(file, parameters) for file, parameters in plan.cases]
    programs = {spec.identifier: lower(derive(spec)) for spec in specs}
    peaks = _peaks(plan)
    entries: list[Entry] = []
    with tempfile.TemporaryDirectory() as folder:
        scenes = [
            _Scene(spec, *case, max(plan.sizes), Path(folder), plan.sigma)
            for spec, case in zip(specs, plan.cases, strict=True)
        ]
        try:
            for threads in plan.threads:
                with Crew(threads) as crew:
                    for scene in scenes:
                        for precision in plan.precisions:
                            entries.extend(_Run(plan, crew, scene, precision, contenders, say).entries())
        except KeyboardInterrupt:
            missing.append("what was not measured yet when the run was interrupted")
    for key, rate in _peaks(plan).items():
        peaks[key] = max(peaks[key], rate)
    return Kernels(
        entries=tuple(entries),
        peaks=peaks,
        operations={
            (name, p): pair_operations(program, p) for name, program in programs.items() for p in plan.precisions
        },
        contenders=contenders,
        missing=tuple(missing),
        rounds=plan.rounds,
        versions=_versions("torch", "jax", "jaxlib", "numpy"),
    )


class _Scene:
    """The points and splats of one manifold, in files for the workers, and what is right on those compared."""

    def __init__(
        self, spec: Spec, file: Path, parameters: Mapping[str, Any], largest: Size, folder: Path, sigma: float | None
    ) -> None:
        self.identifier = spec.identifier
        known = bundled_name(spec)
        self.formulas = known in FORMULAS
        self.name = spec.name
        self.manifold: Manifold = load(file, **parameters)
        self.folder = folder
        points, splats = (max(a, b) for a, b in zip(largest, COMPARED, strict=True))
        self.problem = problem(self.manifold, self.name, points, splats, sigma)
        self.request = {"manifold": str(file.resolve()), "name": self.name, "parameters": dict(parameters)}
        self.truth = self._truth() if self.formulas else None

    def file(self, size: Size) -> str:
        """Where the first points and splats are."""
        path = self.folder / f"{self.identifier}-{size[0]}-{size[1]}.npz"
        if not path.exists():
            self.problem.part(*size).save(path)
        return str(path)

    def error(self, found: Mapping[str, Any]) -> float | None:
        """The worst of the relative errors of the loss and the gradients; None where the truth is not known."""
        if self.truth is None:
            return None
        mine = self._comparable(self.problem.part(*COMPARED), found["loss"], found["v"], found["mu"], found["A"])
        pairs = zip(mine, self.truth, strict=True)
        return float(max(np.linalg.norm(a - b) / np.linalg.norm(b) for a, b in pairs))

    def _truth(self) -> tuple[Any, ...]:
        from rsrm_gen.bench.steps.in_torch import eager

        part = read_problem(Path(self.file(COMPARED)), "float64")
        loss, gradients = eager(self.name, part, COMPARED[0])()
        return self._comparable(part, loss, *gradients)

    def _comparable(self, part: Problem, loss: Any, v: Any, mu: Any, A: Any) -> tuple[Any, ...]:
        """The gradient in the centres made Riemannian: formulas differ in what is normal to the manifold."""
        import torch

        at, partials = (torch.from_numpy(np.asarray(a, dtype="float64").copy()) for a in (part.mu, mu))
        riemannian = self.manifold.riemannian_gradient(at, partials).numpy()
        return np.asarray(loss, "float64").reshape(1), np.asarray(v, "float64"), riemannian, np.asarray(A, "float64")


@dataclass(frozen=True)
class _Run:
    """One manifold, precision and number of threads."""

    plan: Plan
    crew: Crew
    scene: _Scene
    precision: str
    contenders: tuple[Contender, ...]
    say: Callable[[str], None]

    def entries(self) -> Iterator[Entry]:
        """Of all sizes and contenders."""
        errors: dict[str, float | None] = {}
        notes: dict[str, str] = {}
        for contender in self.contenders:
            self.say(f"{self._title}: {contender.name} is compared")
            try:
                errors[contender.key] = self._error(contender)
            except FailedError as failure:
                notes[contender.key] = str(failure)
            error = errors.get(contender.key)
            if error is not None and not error <= TOLERANCE[self.precision]:
                notes[contender.key] = f"wrong by {error:.1e}"
        for size in self.plan.sizes:
            yield from self._timed(size, errors, notes)

    @property
    def _title(self) -> str:
        return f"{self.scene.identifier}, {self.precision}, {self.crew.threads} thread{'s' * (self.crew.threads > 1)}"

    def _error(self, contender: Contender) -> float | None:
        if contender.needs_formulas and not self.scene.formulas:
            raise FailedError("no formulas for it")
        if not contender.whole:
            return None
        self._prepare(contender, COMPARED, COMPARED[0])
        path = self.scene.folder / "found.npz"
        self.crew.ask(contender, PATIENCE, do="save", file=str(path))
        with np.load(path, allow_pickle=False) as found:
            return self.scene.error(found)

    def _timed(self, size: Size, errors: Mapping[str, float | None], notes: Mapping[str, str]) -> Iterator[Entry]:
        ready: dict[Contender, dict[str, Any]] = {}
        failures = dict(notes)
        for contender in self.contenders:
            if contender.key in failures:
                continue
            self.say(f"{self._title}, {size[0]} x {size[1]}: {contender.name} is prepared")
            try:
                ready[contender] = self._prepare(contender, size, self._chunk(contender, ready))
            except FailedError as failure:
                failures[contender.key] = str(failure)
        for contender, words in self._wrong_losses(ready):
            failures[contender.key] = words
            del ready[contender]
        samples, others = self._rounds(size, ready, failures)
        for c in self.contenders:
            prepared = ready.get(c, {})
            yield Entry(
                self.scene.identifier,
                self.precision,
                self.crew.threads,
                *size,
                c.key,
                error=errors.get(c.key),
                seconds=tuple(samples.get(c.key, ())) if c.key not in failures else (),
                first=prepared.get("first"),
                chunk=prepared.get("chunk") if c.chunked else None,
                others=others,
                note=failures.get(c.key, ""),
            )

    def _prepare(self, contender: Contender, size: Size, chunk: int | None) -> dict[str, Any]:
        seconds = self.plan.compile_budget if contender.key == "compiled" else PATIENCE
        request = {**self.scene.request, "problem": self.scene.file(size), "precision": self.precision}
        return self.crew.ask(contender, seconds, do="prepare", chunk=chunk, **request)

    @staticmethod
    def _chunk(contender: Contender, ready: Mapping[Contender, Mapping[str, Any]]) -> int | None:
        """torch.compile takes long to try sizes: it takes the one that was best without it."""
        chosen = {c.key: prepared["chunk"] for c, prepared in ready.items()}
        return chosen.get("analytic") if contender.key == "compiled" else None

    def _wrong_losses(self, ready: Mapping[Contender, Mapping[str, Any]]) -> list[tuple[Contender, str]]:
        """Who finds another loss on the very points that are timed than ours, which was compared before."""
        losses = {c: prepared["loss"] for c, prepared in ready.items() if c.whole}
        ours = next((loss for c, loss in losses.items() if c.key == "ours"), None)
        if ours is None:
            return []
        off = {c: abs(loss - ours) / abs(ours) for c, loss in losses.items()}
        return [(c, f"loss wrong by {e:.1e}") for c, e in off.items() if not e <= LOSS_TOLERANCE[self.precision]]

    def _rounds(
        self, size: Size, ready: Mapping[Contender, Mapping[str, Any]], failures: dict[str, str]
    ) -> tuple[dict[str, list[float]], float | None]:
        """Samples of each contender, one after the other in every round; and the cores that others used between rounds."""
        busy: list[float] = []
        samples: dict[str, list[float]] = {c.key: [] for c in ready}
        steps = {c: max(1, round(SAMPLE / prepared["seconds"])) for c, prepared in ready.items()}
        one = sum(prepared["seconds"] * steps[c] for c, prepared in ready.items())
        rounds = min(self.plan.rounds, max(FEWEST, int(self.plan.limit / one) if one else 0))
        for number in range(rounds):
            self.say(f"{self._title}, {size[0]} x {size[1]}: round {number + 1} of {rounds}")
            now = busy_cores()
            busy += [] if now is None else [now]
            for contender in ready:
                if contender.key in failures:
                    continue
                try:
                    answer = self.crew.ask(contender, PATIENCE, do="time", steps=steps[contender])
                    samples[contender.key].append(answer["seconds"])
                except FailedError as failure:
                    failures[contender.key] = str(failure)
        return samples, statistics.mean(busy) if busy else None


def _peaks(plan: Plan) -> dict[tuple[str, int], float]:
    """Empty where there is no C compiler."""
    if compiler() is None:
        return {}
    return {(p, threads): fma_peak(p, threads) for p in plan.precisions for threads in plan.threads}


def _versions(*packages: str) -> dict[str, str]:
    found = {}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
