"""Code for Riemannian manifolds, derived and audited from a few lines of YAML; arrival-time fields trained on it."""

from rsrm_gen.errors import UserError
from rsrm_gen.load import load
from rsrm_gen.manifold import Manifold
from rsrm_gen.version import __version__

__all__ = ["Manifold", "UserError", "__version__", "load"]
