"""The laws of a product: those of every factor, and of what weights and sums make of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import mpmath as mp

from rsrm_gen.compiler.audit.given import transport_checks
from rsrm_gen.compiler.audit.laws import DIGITS, Laws
from rsrm_gen.compiler.audit.readings import check_readings
from rsrm_gen.compiler.audit.report import Check
from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.lower import Program, lower

PAIRS = 6  # the factors are tried at many; here only how they are put together


def check_formulas(geometry: Geometry, program: Program) -> list[Check]:
    """The laws of geometry and the two readings, factor by factor and of the whole; readings only of lawful formulas."""
    checks = []
    for name, factor in geometry.factors:
        checks += [replace(check, name=f"{name}: {check.name}") for check in check_formulas(factor, lower(factor))]
    if all(check.passed for check in checks):
        laws = (ProductLaws if geometry.factors else Laws)(geometry, program)
        checks += laws.checks()
        with mp.workdps(DIGITS):
            checks += [] if geometry.factors else transport_checks(laws)  # of a product, its factors' is enough
    if all(check.passed for check in checks):
        checks += check_readings(geometry, program)
    return checks


class ProductLaws(Laws):
    """The laws that ask for functions alone, not for formulas of the file."""

    def __init__(self, geometry: Geometry, program: Program) -> None:
        super().__init__(geometry, program)
        self.pairs = self.pairs[:: len(self.pairs) // PAIRS]

    def checks(self) -> list[Check]:
        """Every law that holds for all products, and those of geodesics where the factors' maps are geodesic."""
        laws: list[Callable[[], Check | None]] = [self.metric_is_an_inner_product, self.distance_is_the_length_of_log]
        if self.geometry.spec.maps == "geodesic":
            laws += [self.distance_is_symmetric, self.distance_has_gradient_one]
            laws += [self.log_is_the_gradient_of_half_squared_distance]
        laws += [self.log_det_is_the_determinant, self.splat_gradient_is_its_derivative]
        return [check for check in map(self.tried, laws) if check is not None]
