"""What all tests share: a cache of their own, so that no test reads or fills the user's, and compiled manifolds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest

from rsrm_gen.compiler.driver import Compiled, compile_manifold

MANIFOLDS = Path(__file__).parent.parent / "manifolds"


@pytest.fixture(scope="session", autouse=True)
def cache_folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A cache that lives as long as the test run."""
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RSRM_GEN_CACHE", str(folder))
        yield folder


@pytest.fixture(scope="session")
def built(cache_folder: Path) -> Callable[[str], Compiled]:
    """Compiles a bundled manifold, once a session."""
    return cache(lambda name: compile_manifold(MANIFOLDS / f"{name}.yaml"))
