"""Samples of a function on a manifold, read from a file: points, values, and how much each counts.

A .csv has a header; its column `value` is the function's, `weight`, which may be missing, says how much a row counts, and all
others, in their order, are the numbers of a point. A .npz has the arrays x (N, D), value (N) and perhaps weight (N).
"""

from __future__ import annotations

import csv
import math
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from rsrm_gen.errors import Source, Span, UserError
from rsrm_gen.manifold import Manifold

ON_MANIFOLD = (
    1e-5  # how far from the manifold the numbers of a point may lie: they were measured, and written in few digits
)
VALUE, WEIGHT = "value", "weight"


@dataclass(frozen=True)
class Samples:
    """N points and what a function is there, in float64, the points put back exactly onto the manifold."""

    x: Tensor  # (N, D)
    value: Tensor | None  # (N,); None where only points were asked for
    weight: Tensor | None  # (N,), not negative


def read_samples(path: Path, manifold: Manifold, points_only: bool = False) -> Samples:
    """Read a file; what is wrong in it is a `UserError` with its line. `points_only` needs no values."""
    try:
        if path.suffix == ".npz":
            return _from_arrays(path, manifold, points_only)
        if path.suffix == ".csv":
            return _from_table(path, manifold, points_only)
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror}") from None
    raise UserError(
        f"{path} is neither a .csv nor a .npz", hint="a .csv has a header: the point's numbers, then `value`"
    )


def _from_arrays(path: Path, manifold: Manifold, points_only: bool) -> Samples:
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: np.asarray(file[name], dtype=np.float64) for name in ("x", VALUE, WEIGHT) if name in file}
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise UserError(f"{path} cannot be read as arrays of numbers: {error}") from None
    for name in ("x",) if points_only else ("x", VALUE):
        if name not in arrays:
            raise UserError(f"{path} has no array `{name}`", hint="np.savez(file, x=points, value=values)")
    x = arrays["x"]
    if x.ndim != 2 or x.shape[1] != manifold.point_size:
        wanted = f"(N, {manifold.point_size})"
        raise UserError(f"{path}: `x` has the shape {x.shape}; points of {manifold.name} make it {wanted}")
    for name in (VALUE, WEIGHT):
        if name in arrays and arrays[name].shape != x.shape[:1]:
            raise UserError(
                f"{path}: `{name}` has the shape {arrays[name].shape}; with {len(x)} points it is {x.shape[:1]}"
            )
    columns = {name: torch.from_numpy(array) for name, array in arrays.items() if name != "x"}
    return _checked(torch.from_numpy(x), columns, manifold, points_only, _ArrayPlaces(path))


def _from_table(path: Path, manifold: Manifold, points_only: bool) -> Samples:
    try:
        source = Source(str(path), path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise UserError(f"{path} is not a text in UTF-8") from None
    names = [name.strip() for name in next(csv.reader(source.lines[:1]), [])]
    places = _TablePlaces(source)
    coordinates = _check_header(names, manifold, points_only, Span(source, 1, 1, max(len(source.line(1)), 1)))
    rows, lines = [], []
    for number, line in enumerate(source.lines[1:], 2):
        if line.strip():
            rows.append(_numbers(source, number, line, len(names)))
            lines.append(number)
    places.lines = lines
    numbers = torch.tensor(rows, dtype=torch.float64).reshape(len(rows), len(names))
    columns = {name: numbers[:, names.index(name)] for name in (VALUE, WEIGHT) if name in names}
    return _checked(numbers[:, coordinates].contiguous(), columns, manifold, points_only, places)


def _check_header(names: list[str], manifold: Manifold, points_only: bool, span: Span) -> list[int]:
    """Which columns are the numbers of a point."""
    hint = (
        f"{manifold.point_size} columns for a point of {manifold.name}, then `value`, and `weight` if rows differ in it"
    )
    if any(_is_number(name) for name in names):
        raise UserError("the first line must name the columns", span, hint)
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise UserError(f"the column `{doubled[0]}` is there twice", span)
    if VALUE not in names and not points_only:
        raise UserError("there is no column `value`", span, hint)
    coordinates = [i for i, name in enumerate(names) if name not in (VALUE, WEIGHT)]
    if len(coordinates) != manifold.point_size:
        wanted = f"a point of {manifold.name} has {manifold.point_size} numbers"
        raise UserError(f"{len(coordinates)} columns beside `value` and `weight`; {wanted}", span, hint)
    return coordinates


def _numbers(source: Source, number: int, line: str, count: int) -> list[float]:
    cells = line.split(",")
    if len(cells) != count:
        raise UserError(f"{len(cells)} numbers; the header names {count}", Span(source, number, 1, len(line)))
    column = 1
    numbers = []
    for cell in cells:
        if not _is_number(cell):
            span = Span(source, number, column, max(len(cell), 1))
            raise UserError(f"`{cell.strip()}` is not a number", span)
        numbers.append(float(cell))
        column += len(cell) + 1
    return numbers


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


class _ArrayPlaces:
    """Rows of arrays."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def error(self, row: int, message: str, hint: str | None = None) -> UserError:
        """What is wrong with a row."""
        return UserError(f"{self.path}: row {row}: {message}", hint=hint)


class _TablePlaces:
    """Lines of a table."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.lines: list[int] = []

    def error(self, row: int, message: str, hint: str | None = None) -> UserError:
        """What is wrong with a row."""
        line = self.lines[row]
        return UserError(message, Span(self.source, line, 1, max(len(self.source.line(line)), 1)), hint)


def _checked(
    x: Tensor, columns: dict[str, Tensor], manifold: Manifold, points_only: bool, places: _ArrayPlaces | _TablePlaces
) -> Samples:
    """The samples, or the first row that is none."""
    if points_only:
        columns = {}
    for name, numbers in (("the point", x), *columns.items()):
        row = _first(~numbers.isfinite().reshape(len(x), -1).all(1))
        if row is not None:
            raise places.error(row, f"{name} is not finite")
    if WEIGHT in columns:
        row = _first(columns[WEIGHT] < 0)
        if row is not None:
            raise places.error(row, f"the weight {float(columns[WEIGHT][row]):g} is negative")
    exact = manifold.project(x)
    row = _first(~(_moved(manifold, x, exact) <= ON_MANIFOLD))
    if row is not None:
        nearest = ", ".join(f"{number:.9g}" for number in exact[row].tolist())
        hint = f"the point it projects to is [{nearest}]" if bool(exact[row].isfinite().all()) else None
        raise places.error(row, f"the point is not on {manifold.name}", hint)
    return Samples(exact, columns.get(VALUE), columns.get(WEIGHT))


def _moved(manifold: Manifold, x: Tensor, exact: Tensor) -> Tensor:
    """By how much the largest change of a number is when points (N, D) are put onto the manifold: (N,)."""
    moved = (x - exact).abs()
    for i, period in enumerate(manifold.periods or ()):
        if period is not None:  # an angle means the same after a full turn
            turn = moved[:, i] % period
            moved[:, i] = torch.minimum(turn, period - turn)
    return moved.amax(1) if len(x) else x.new_zeros(0)


def _first(wrong: Tensor) -> int | None:
    return int(wrong.int().argmax()) if bool(wrong.any()) else None


def spread(value: Tensor, weight: Tensor) -> tuple[float, float]:
    """The weighted mean of values (N,) and their standard deviation, 1 where all are the same."""
    mean = float((weight * value).sum() / weight.sum())
    deviation = math.sqrt(float((weight * (value - mean) ** 2).sum() / weight.sum()))
    return mean, deviation or 1.0
