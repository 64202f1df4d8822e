"""How far a splat can be seen, proved: what a sum loses when splats too far from a point are left out.

With W = A^-1 E and sigma the largest singular value of A, |W Log_mu(x)| >= d(x, mu) / sigma, because Log is as long as the
distance. So a splat whose determinant is at most D is at most |amplitude| D exp(-r^2 / 2) from the distance r sigma on, and
with r^2 = cut + 2 log D at most |amplitude| exp(-cut / 2). In units of |amplitude| exp(-cut / 2) its gradient is at most
r L / s + G, with s the smallest singular value of A, L the largest stretch of D Log and G the largest gradient of log D.

    what a factor of the manifold is           D                            L               G
    flat: the determinant is constant          itself                       1               0
    hyperboloid                                1                            1               power
    quadric where x and -x are one point       (pi / 2)^power               pi / 2          power 2 / pi
    sphere, closer than REACH of its radius    (pi REACH / sin)^power       pi REACH / sin  power (1 / tan - 1 / (pi REACH))

(of the radius 1; sin and tan of pi (1 - REACH)). On the cut locus of a sphere nothing bounds the determinant, however narrow
the splat is: near it no pair may be left out. Of other determinants no bound is known, and retractions have a Log that is no
distance: there nothing is.
"""

from __future__ import annotations

import math

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.lower.ir import Culling
from rsrm_gen.compiler.lower.reduced import parts

REACH = 31 / 32  # of a sphere's injectivity radius: beyond it, the determinant is larger than is worth a bound


def culling(geometry: Geometry) -> Culling | None:
    """The bound of the determinant and where it holds; None where none is known."""
    if geometry.spec.maps != "geodesic":
        return None
    log_bound, has_sphere = 0.0, False
    for part in parts(geometry):
        found = _log_bound(part.geometry)
        if found is None:
            return None
        log_bound += found
        has_sphere |= _is_sphere(part.geometry)
    # no factor's distance is longer than the whole, and the whole's radius is the smallest of all
    radius = REACH * float(geometry.injectivity_radius) if has_sphere else math.inf
    return Culling(log_bound, radius)


def _is_sphere(geometry: Geometry) -> bool:
    """Whether the determinant has no bound at the cut locus."""
    radial = geometry.radial
    return radial is not None and not radial.unbounded and not radial.folded and radial.power > 0


def _log_bound(geometry: Geometry) -> float | None:
    """The logarithm of the largest determinant of a manifold that is no product."""
    (log_det,) = geometry["log_abs_det"].results
    if log_det.is_number:
        return float(log_det)
    radial = geometry.radial
    if radial is None or radial.power < 0:
        return None
    if radial.unbounded:
        return 0.0
    angle = math.pi / 2 if radial.folded else math.pi * REACH
    return radial.power * math.log(angle / math.sin(angle))
