"""The two links: what T is, and that their derivatives are those of their values."""

from __future__ import annotations

import math

import pytest
import torch

from rsrm_gen.trainer.link import Exponential, Link, Quotient, make_link
from rsrm_gen.trainer.settings import LinkChoice

LINKS = {"exponential": Exponential(), "quotient": Quotient(), "with floor": Quotient(offset=1.5, floor=0.25)}


@pytest.mark.parametrize("name", LINKS)
def test_partials_are_the_derivatives_of_the_value(name: str) -> None:
    link: Link = LINKS[name]
    d = torch.linspace(0, 5, 11, dtype=torch.float64).requires_grad_()
    f = torch.linspace(-6, 6, 11, dtype=torch.float64).requires_grad_()
    expected = torch.autograd.grad(link.value(d, f).sum(), (d, f))
    for partial, truth in zip(link.partials(d, f), expected, strict=True):
        assert torch.allclose(partial, truth, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("name", LINKS)
def test_second_partials_are_the_derivatives_of_the_first(name: str) -> None:
    link: Link = LINKS[name]
    d = torch.linspace(0, 5, 11, dtype=torch.float64)
    f = torch.linspace(-6, 6, 11, dtype=torch.float64).requires_grad_()
    for first, second in zip(link.partials(d, f), link.derivatives(d, f)[2:], strict=True):
        (truth,) = torch.autograd.grad(first.sum(), f, retain_graph=True)
        assert torch.allclose(second, truth, rtol=1e-12, atol=1e-14)


def test_free_space_is_exact_without_a_field() -> None:
    d = torch.linspace(0, 5, 11)
    assert torch.equal(Exponential().value(d, torch.zeros(11)), d)


def test_a_floor_bounds_the_slowest_mean_speed() -> None:
    value = Quotient(offset=4.0, floor=0.25).value(torch.ones(2), torch.tensor([-200.0, 200.0]))
    assert value.tolist() == pytest.approx([4.0, 1.0])
    no_floor = Quotient(offset=4.0).value(torch.ones(1), torch.zeros(1))
    assert float(no_floor) == pytest.approx(1 + math.exp(-4))


def test_the_settings_name_the_link() -> None:
    assert make_link(LinkChoice()) == Exponential()
    assert make_link(LinkChoice(kind="quotient", offset=2.0, floor=0.1)) == Quotient(2.0, 0.1)
