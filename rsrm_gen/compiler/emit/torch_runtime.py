"""The parts of a generated torch module that are the same for every manifold, as text."""

HELPERS = '''
def _root(x: Tensor) -> Tensor:
    """sqrt(x) with the derivative 0 at x = 0, where autograd would make 0 * inf = NaN of it."""
    zero = x == 0
    return torch.where(zero, 0.0, torch.sqrt(torch.where(zero, 1.0, x)))


def _polynomial(x: Tensor, table: tuple[tuple[float, ...], tuple[float, ...]]) -> Tensor:
    """c0 + c1 x + c2 x^2 + ... by Horner's rule; `table` has coefficients for float64, then for lower precisions."""
    coefficients = table[0] if x.dtype == torch.float64 else table[1]
    result = x * coefficients[-1] + coefficients[-2]
    for coefficient in coefficients[-3::-1]:
        result = result * x + coefficient
    return result


def _pick(condition: Tensor, x: float, y: float, like: Tensor) -> Tensor:
    """x where the condition holds, else y, in the precision of `like` (torch.where of two numbers is float32)."""
    return torch.where(condition, like.new_tensor(x), like.new_tensor(y))


def _stack(entries: Sequence[Tensor]) -> Tensor:
    """Entries to one tensor, along a new last dimension."""
    return torch.stack(torch.broadcast_tensors(*entries), -1)


def _rows(entry: Tensor | float, *arguments: Tensor) -> Tensor:
    """A result that does not depend on all arguments, for every row to which their leading dimensions broadcast."""
    shape = torch.broadcast_shapes(*(a.shape[:-1] for a in arguments))
    return entry.expand(shape) if isinstance(entry, Tensor) else arguments[0].new_full(shape, entry)


def _rejection(
    propose: Callable[[int], tuple[Tensor, Tensor]], count: int, generator: Generator | None, like: Tensor
) -> Tensor:
    """`count` points with a density proportional to what `propose` returns beside its points.

    A density above the largest seen so far starts the sampling over.
    """
    kept: list[Tensor] = []
    bound = 0.0
    while sum(map(len, kept)) < count:
        points, density = propose(2 * count + 16)
        largest = float(density.max())
        if not 0 < largest < math.inf:
            raise ValueError(f"the volume of Exp is not finite where points are sampled: {largest}")
        if largest > bound:
            bound, kept = 1.05 * largest, []
        uniform = torch.rand(len(points), generator=generator, dtype=like.dtype, device=like.device)
        kept.append(points[uniform * bound < density])
    return torch.cat(kept)[:count]
'''

FRAME = '''
def frame(self, p: Tensor) -> Tensor:
    """An orthonormal basis of the tangent space at p, one vector a row; not continuous in p where none is.

    Gram-Schmidt in the metric, always on the longest of what is left. Shapes: p (..., {size}) to (..., {dim}, {tangent}).
    """
    base = p.unsqueeze(-2)
    left = self.to_tangent(base, torch.eye({size}, dtype=p.dtype, device=p.device))
    left = left.expand(*p.shape[:-1], {size}, {tangent})
    rows = []
    for _ in range({dim}):
        longest = self.norm(base, left).argmax(-1)[..., None, None].expand(*p.shape[:-1], 1, {tangent})
        row = left.gather(-2, longest)
        row = row / self.norm(base, row).unsqueeze(-1)
        rows.append(row)
        for _ in range(2):  # what rounding leaves of the first subtraction, the second takes away
            left = left - self.inner(base, row, left).unsqueeze(-1) * row
    return torch.cat(rows, -2)
'''

SAMPLE_BALL = '''
def sample_ball(self, center: Tensor, radius: float, count: int, generator: Generator | None = None) -> Tensor:
    """Points uniform in volume in the geodesic ball around `center`: center (D) to (count, D).

    Uniform in the tangent ball, then thinned by the volume that Exp gives it, |det D Exp| = 1 / |det D Log|.
    """
    if not 0 < radius <= self.injectivity_radius:
        raise ValueError(f"the radius must be in (0, {self.injectivity_radius}], the injectivity radius; it is {radius}")
    frame = self.frame(center)

    def propose(n: int) -> tuple[Tensor, Tensor]:
        ray = torch.randn(n, self.dim, generator=generator, dtype=center.dtype, device=center.device)
        reach = torch.rand(n, 1, generator=generator, dtype=center.dtype, device=center.device) ** (1 / self.dim)
        v = radius * reach * ray / torch.linalg.vector_norm(ray, dim=-1, keepdim=True)
        points = self.exp(center, v @ frame)
        return points, torch.exp(-self.log_abs_det(center, points))

    return _rejection(propose, count, generator, center)
'''

SAMPLE_WHOLE = '''
def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
    """Points uniform in volume on the whole manifold: (count, {size}), with the dtype and device of `like`."""
    start = {start}
    return self.sample_ball(self.project(start), self.diameter, count, generator)
'''

SAMPLE_BOX = '''
def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
    """Points uniform in volume on the whole manifold: (count, D), with the dtype and device of `like`."""
    like = torch.zeros(()) if like is None else like
    periods = torch.tensor(self.periods, dtype=like.dtype, device=like.device)

    def propose(n: int) -> tuple[Tensor, Tensor]:
        uniform = torch.rand(n, self.dim, generator=generator, dtype=like.dtype, device=like.device)
        points = (uniform - 0.5) * periods
        return points, 1 / torch.linalg.det(self.frame(points)).abs()

    return _rejection(propose, count, generator, like)
'''

SAMPLE_FORMULA = '''
def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
    """Points uniform in volume on the whole manifold: (count, {size}), with the dtype and device of `like`."""
    like = torch.zeros(()) if like is None else like
    normal = torch.randn(count, {size}, generator=generator, dtype=like.dtype, device=like.device)
    uniform = torch.rand(count, {size}, generator=generator, dtype=like.dtype, device=like.device)
    return self._sample(normal, uniform)
'''

TRANSPORT_NONE = '''
def transport(self, p: Tensor, q: Tensor, v: Tensor) -> Tensor:
    """Not known for this manifold: its file gives no `transport:`."""
    raise ValueError("parallel transport is not known here: give its closed form as `transport:` in the manifold file")
'''

SAMPLE_NONE = '''
def sample(self, count: int, generator: Generator | None = None, like: Tensor | None = None) -> Tensor:
    """Not known for this manifold: it is not compact, or no ball in which Exp is one-to-one covers it."""
    raise ValueError("there is no uniform distribution on the whole of this manifold; use sample_ball")
'''
