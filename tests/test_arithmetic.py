"""The arithmetic of a step in C against the same in torch."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import torch
from compiled import needs_compiler
from scenes import seeded
from torch import Tensor

from rsrm_gen.trainer.arithmetic import Arithmetic, InC, InTorch, Loss, Points, Slope, Splats
from rsrm_gen.trainer.link import Exponential, Link, Quotient

SIZES = [(1, 1), (2, 2), (2, 3), (3, 3), (3, 4), (4, 4), (6, 6)]  # d and T
K, C, N = 37, 41, 53
LINKS: dict[str, Link] = {"exponential": Exponential(), "quotient": Quotient(1.5, 0.25)}

Given = Callable[..., Tensor]


def numbers() -> Given:
    """Random numbers of a shape."""
    generator = seeded()
    return lambda *shape: torch.randn(*shape, generator=generator, dtype=torch.float64)


def parts(result: Any) -> list[Any]:
    """The tensors and numbers of a result."""
    if isinstance(result, Points | Splats | Slope | Loss):
        return list(vars(result).values())
    return [part for item in result for part in parts(item)] if isinstance(result, list) else [result]


def compare(d: int, T: int, does: Callable[[Arithmetic], Any]) -> None:
    """Both do the same, whatever `does` makes of its own tensors."""
    truth, ours = parts(does(InTorch(d))), parts(does(InC(d, T, torch.float64)))
    assert len(truth) == len(ours) > 0
    for expected, found in zip(truth, ours, strict=True):
        expected, found = torch.as_tensor(expected), torch.as_tensor(found)
        assert expected.shape == found.shape
        scale = max([1.0, *expected.abs().flatten().tolist()])
        assert torch.allclose(expected, found, rtol=0, atol=1e-12 * scale)


def shapes(given: Given, d: int) -> Tensor:
    """v and A in columns, no A nearly singular."""
    A = 0.3 * given(C, d, d) + 2 * torch.eye(d, dtype=torch.float64)
    return torch.cat((given(1, C), A.flatten(1).T.contiguous()))


def points(given: Given, T: int) -> Points:
    return Points(given(N, T), given(N).abs(), given(N, T), 1 + given(N).abs())


@needs_compiler
@pytest.mark.parametrize(("d", "T"), SIZES)
def test_splats_and_their_adjoints_agree(d: int, T: int) -> None:
    given = numbers()
    columns, mu, F, gradient, W_bar, amplitude_bar = (
        shapes(given, d), given(K, T), given(K, d, T), given(K, T), given(K, d, T), given(K)
    )  # fmt: skip
    compare(d, T, lambda a: a.splats(mu, F, columns))
    splats = InTorch(d).splats(mu, F, columns)
    compare(d, T, lambda a: a.splats_adjoint(splats, gradient, W_bar, amplitude_bar))


@needs_compiler
@pytest.mark.parametrize("squared", [False, True])
@pytest.mark.parametrize("link", LINKS)
@pytest.mark.parametrize(("d", "T"), SIZES)
def test_slopes_and_losses_agree(d: int, T: int, link: str, squared: bool) -> None:
    given = numbers()
    there, f, df, metric = points(given, T), given(N), given(N, T), 1 + given(N, 1) ** 2
    compare(d, T, lambda a: a.slope(LINKS[link], there, f, df))
    slope = InTorch(d).slope(LINKS[link], there, f, df)
    slope.gradient[3] = 0  # a ratio too small to have a slope
    compare(d, T, lambda a: a.eikonal(squared, there, slope, slope.gradient * metric, df))


@needs_compiler
def test_points_near_the_goal_are_left_out_of_their_part() -> None:
    given = numbers()
    there, distance = Points(given(60, 3), given(60), given(60, 2), given(60)), given(60).abs()
    distance[7], distance[0], distance[40:60] = 0, 9, 0.1  # one part without a point
    for least in (0.3, -1.0, 100.0):
        compare(2, 2, lambda a, least=least: a.far(3, least, distance, there))


@needs_compiler
@pytest.mark.parametrize("balls", [0, 1, 4])
def test_slownesses_agree_and_show_what_is_no_number(balls: int) -> None:
    given = numbers()
    distances, radii = given(balls, N).abs(), given(balls).abs()
    compare(2, 2, lambda a: a.slowness(distances, radii, 1.0, 10.0, 0.15))
    if balls:
        distances[0, 5] = torch.nan
        found = InC(2, 2, torch.float64).slowness(distances, radii, 1.0, 10.0, 0.15)
        assert found.isnan().nonzero().tolist() == [[5]]


@needs_compiler
@pytest.mark.parametrize("clip", [0.1, 1e9])
@pytest.mark.parametrize(("d", "T"), SIZES)
def test_steps_of_adamw_agree(d: int, T: int, clip: float) -> None:
    given = numbers()
    gradients, columns = [given(1 + d * d + d, K) for _ in range(3)], shapes(given, d)

    def steps(a: Arithmetic) -> list[Tensor]:
        first, second = columns.new_zeros(2, 2 + d * d + d, C)
        moved = columns.clone()
        made = [a.adam(g, clip, 0.01, 0.1, first, second, moved) for g in gradients]
        return [*made, first, second, moved]

    compare(d, T, steps)


@needs_compiler
@pytest.mark.parametrize(("d", "T"), SIZES)
def test_moves_and_frames_agree(d: int, T: int) -> None:
    given = numbers()
    E, G, columns = given(K, d, T), given(T, T), given(d, K)
    compare(d, T, lambda a: a.tangents(columns, E))
    compare(d, T, lambda a: a.orthonormal(E, E @ (G @ G.T + torch.eye(T, dtype=torch.float64))))


@needs_compiler
@pytest.mark.parametrize(("d", "T"), SIZES)
def test_clamped_shapes_agree(d: int, T: int) -> None:
    columns = torch.cat((torch.zeros(1, C, dtype=torch.float64), 0.2 * numbers()(d * d, C)))

    def clamped(a: Arithmetic) -> Tensor:
        moved = columns.clone()
        a.clamp_shapes(K, 0.1, moved)
        return moved

    compare(d, T, clamped)


@needs_compiler
@pytest.mark.parametrize("d", [1, 2, 3, 6])
@pytest.mark.parametrize("dtype", [torch.float32, torch.float64])
@pytest.mark.parametrize("rank", [0, 1, 2])
def test_shapes_of_low_rank_are_clamped_to_invertible_ones(d: int, dtype: torch.dtype, rank: int) -> None:
    given = numbers()
    A = (given(C, d, rank) @ given(C, rank, d)).to(dtype)
    columns = torch.cat((torch.zeros(1, C, dtype=dtype), A.flatten(1).T))
    InC(d, d, dtype).clamp_shapes(C, 0.1, columns)
    S = torch.linalg.svdvals(columns[1:].T.unflatten(1, (d, d)))
    noise = 20 * torch.finfo(dtype).eps
    assert float(((S - torch.linalg.svdvals(A).clamp_min(0.1)).abs() / S[:, :1]).max()) < noise
