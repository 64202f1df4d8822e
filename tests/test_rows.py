"""Functions of points by the generated C: the same numbers as torch's, whatever the shapes, and torch where C cannot."""

from __future__ import annotations

import pytest
import torch
from scenes import seeded

from rsrm_gen.load import load, load_in_rows
from rsrm_gen.rows import SIGNATURES

CENTERS = {"sphere": [0.0, 0.6, 0.8], "so3": [0.8, 0.0, 0.6, 0.0], "torus": [3.0, -3.0], "poincare": [0.3, -0.4]}


@pytest.mark.parametrize("dtype", [torch.float64, torch.float32])
@pytest.mark.parametrize("function", SIGNATURES)
@pytest.mark.parametrize("name", CENTERS)
def test_c_gives_what_torch_gives(name: str, function: str, dtype: torch.dtype) -> None:
    M, plain = load_in_rows(name), load(name)
    p = M.sample_ball(torch.tensor(CENTERS[name], dtype=dtype), 0.5, 15, seeded()).view(5, 3, -1)
    sizes = {"point": M.point_size, "tangent": M.tangent_size}
    arguments = [p]
    for kind in SIGNATURES[function][1:-1]:
        other = torch.randn(3, sizes[kind], generator=seeded(1), dtype=dtype)
        arguments.append(p[:1] if function in ("log", "distance") else other)
    ours, theirs = getattr(M, function)(*arguments), getattr(plain, function)(*arguments)
    assert ours.shape == theirs.shape
    assert ours.dtype == dtype
    eps = torch.finfo(dtype).eps
    assert torch.allclose(ours, theirs, rtol=64 * eps, atol=64 * eps)


def test_where_a_gradient_is_wanted_it_is_there() -> None:
    M = load_in_rows("sphere")
    p, q = M.sample(2, seeded(), like=torch.zeros((), dtype=torch.float64)).requires_grad_().unbind(0)
    (gradient,) = torch.autograd.grad(M.distance(p, q), q)
    assert torch.allclose(gradient, -M.log(q, p) / M.distance(p, q), atol=1e-12)


def test_other_dtypes_and_no_rows_at_all_are_fine() -> None:
    M = load_in_rows("sphere")
    p = M.sample(4, seeded())
    assert M.distance(p.half(), p.half()).dtype == torch.float16
    assert M.log(p[:0], p[:0]).shape == (0, 3)
    with pytest.raises((RuntimeError, ValueError)):
        M.log(p, p[:, :2])
