"""Functions of symmetric matrices in a generated torch module, as text: written there only when they are used."""

from __future__ import annotations

from collections.abc import Sequence

from rsrm_gen.compiler.lower import Routine

CORE = '''
class _Eigen(NamedTuple):
    """A symmetric matrix, its entries on and above the diagonal in one dimension ("packed"), and its eigen-decomposition.

    matrix (..., n (n + 1) / 2), values (..., n) ascending, vectors (..., n, n) as columns; only the matrix has a gradient.
    """

    matrix: Tensor
    values: Tensor
    vectors: Tensor


class _Scalar(NamedTuple):
    """A function f, to be applied to matrices.

    `slope` is (f(b) - f(a)) / (b - a) for a and b far apart; `taylor` has the coefficients in t of f(c + scale(c) t).
    """

    value: Callable[[Tensor], Tensor]
    slope: Callable[[Tensor, Tensor], Tensor]
    scale: Callable[[Tensor], Tensor]
    taylor: Callable[[Tensor, int], list[Tensor]]


def _places(n: int) -> list[tuple[int, int]]:
    """Row and column of every packed entry."""
    return [(i, j) for i in range(n) for j in range(i, n)]


def _pack(entries: Sequence[Tensor | float], like: Tensor) -> Tensor:
    """Packed entries to one tensor."""
    return _stack([e if isinstance(e, Tensor) else like.new_full((), e) for e in entries])


def _square(packed: Tensor, n: int) -> Tensor:
    """The symmetric matrix (..., n, n) of packed entries."""
    entries = dict(zip(_places(n), packed.unbind(-1), strict=True))
    rows = [torch.stack([entries[min(i, j), max(i, j)] for j in range(n)], -1) for i in range(n)]
    return torch.stack(rows, -2)


def _eigh(*entries: Tensor | float) -> _Eigen:
    """The eigen-decomposition of a symmetric matrix; NaN where an entry is not finite, whatever the other rows are."""
    matrix = _pack(entries, next(e for e in entries if isinstance(e, Tensor)))
    n = (math.isqrt(8 * len(entries) + 1) - 1) // 2
    with torch.no_grad():
        finite = torch.isfinite(matrix).all(-1)[..., None]
        unit = torch.eye(n, dtype=matrix.dtype, device=matrix.device)
        values, vectors = _jacobi(torch.where(finite[..., None], _square(matrix, n), unit))
        return _Eigen(matrix, torch.where(finite, values, math.nan), vectors)


def _jacobi(a: Tensor) -> tuple[Tensor, Tensor]:
    """Eigenvalues, ascending, and eigenvectors, by Jacobi's rotations.

    More exact than torch.linalg.eigh where eigenvalues are of very different size, and it never raises.
    """
    n = a.shape[-1]
    a, v = a.clone(), torch.eye(n, dtype=a.dtype, device=a.device).expand_as(a).clone()
    pairs = list(itertools.combinations(range(n), 2))
    for _ in range(2 * n + 2):
        for p, q in pairs:
            _rotate(a, v, p, q)
        root = torch.sqrt(a.diagonal(dim1=-2, dim2=-1).abs())
        small = torch.finfo(a.dtype).eps / 8 * root[..., :, None] * root[..., None, :]
        if not torch.compiler.is_compiling() and bool((a.abs().tril(-1) <= small).all()):
            break
    values, order = a.diagonal(dim1=-2, dim2=-1).sort(-1)
    return values, v.gather(-1, order[..., None, :].expand_as(v))


def _rotate(a: Tensor, v: Tensor, p: int, q: int) -> None:
    """The rotation in the plane of two axes that makes a[p, q] zero, in place."""
    twice, gap = 2 * a[..., p, q], a[..., q, q] - a[..., p, p]
    zero = twice == 0
    theta = gap / torch.where(zero, 1.0, twice)
    t = torch.where(zero, 0.0, torch.copysign(1 / (theta.abs() + torch.sqrt(theta * theta + 1)), theta))
    change, c = t * twice / 2, 1 / torch.sqrt(t * t + 1)
    diagonal = a[..., p, p] - change, a[..., q, q] + change
    s, part = (t * c)[..., None], (t * c / (1 + c))[..., None]
    for m in (a, v):
        x, y = m[..., p].clone(), m[..., q].clone()
        m[..., p], m[..., q] = x - s * (y + part * x), y + s * (x - part * y)
    a[..., p, :], a[..., q, :] = a[..., p].clone(), a[..., q].clone()
    a[..., p, p], a[..., q, q] = diagonal
    a[..., p, q] = a[..., q, p] = 0


def _spectral(name: str, eigen: _Eigen, *directions: Sequence[Tensor | float]) -> Tensor:
    """D^m f(A)[E1, ..., Em], packed; f(A) without directions."""
    result: Tensor = _Spectral.apply(name, *_alike(eigen, directions))  # type: ignore[no-untyped-call]
    return result


def _spectral_alone(name: str, eigen: _Eigen, *directions: Sequence[Tensor | float]) -> Tensor:
    """The same without autograd."""
    values, vectors, _, *stacked = _alike(eigen, directions)
    return _derivative(name, values, vectors, stacked)


def _alike(eigen: _Eigen, directions: Sequence[Sequence[Tensor | float]]) -> list[Tensor]:
    """Eigenvalues, eigenvectors, the matrix and the directions, packed, of the same leading dimensions."""
    stacked = [_pack(entries, eigen.matrix) for entries in directions]
    matrix, *stacked = torch.broadcast_tensors(eigen.matrix, *stacked)
    values = eigen.values.expand(*matrix.shape[:-1], -1)
    vectors = eigen.vectors.expand(*matrix.shape[:-1], -1, -1)
    return [values, vectors, matrix, *stacked]


class _Spectral(torch.autograd.Function):
    """D^m f(A)[E1, ..., Em] under autograd: its derivative is D^(m+1) f(A), with the adjoint for one more direction."""

    @staticmethod
    def forward(ctx: Any, name: str, values: Tensor, vectors: Tensor, matrix: Tensor, *directions: Tensor) -> Tensor:
        """The value."""
        ctx.name = name
        ctx.save_for_backward(values, vectors, matrix, *directions)
        return _derivative(name, values, vectors, directions)

    @staticmethod
    def backward(ctx: Any, bar: Tensor) -> tuple[Tensor | None, ...]:
        """The adjoints of A and the E; an entry off the diagonal stands for two of the matrix."""
        values, vectors, matrix, *directions = ctx.saved_tensors
        diagonal = [i == j for i, j in _places(values.shape[-1])]

        def shared(x: Tensor, share: float) -> Tensor:
            return torch.stack([e if on else share * e for e, on in zip(x.unbind(-1), diagonal, strict=True)], -1)

        def by(others: list[Tensor]) -> Tensor:
            arguments = ctx.name, values, vectors, matrix, *others, shared(bar, 0.5)
            return shared(_Spectral.apply(*arguments), 2.0)  # type: ignore[no-untyped-call]

        needed = ctx.needs_input_grad[3:]
        adjoints = [by(directions) if needed[0] else None]
        for k in range(len(directions)):
            adjoints.append(by(directions[:k] + directions[k + 1 :]) if needed[k + 1] else None)
        return None, None, None, *adjoints


def _derivative(name: str, values: Tensor, vectors: Tensor, directions: Sequence[Tensor]) -> Tensor:
    """By Daleckii and Krein: V (sum of f[l_i, ..., l_j] E_ik ... E_lj) V^T, E in the basis of the eigenvectors."""
    n, order = values.shape[-1], len(directions)
    weights = _divided_differences(_SCALARS[name], values.unbind(-1), order)
    turned = [vectors.mT @ _square(e, n) @ vectors for e in directions]
    total = torch.zeros_like(vectors)
    for es in itertools.permutations(turned):
        for path in itertools.product(range(n), repeat=order + 1):
            term = weights[tuple(sorted(path))]
            for e, (i, j) in zip(es, itertools.pairwise(path), strict=True):
                term = term * e[..., i, j]
            total[..., path[0], path[-1]] += term
    result = vectors @ total @ vectors.mT
    return torch.stack([result[..., i, j] for i, j in _places(n)], -1)


def _divided_differences(f: _Scalar, values: Sequence[Tensor], order: int) -> dict[tuple[int, ...], Tensor]:
    """f[l_i, ..., l_j] for ascending indices of order + 1 eigenvalues, finite where they meet.

    By Taylor's series about the middle where they are within a quarter of its scale, to a rounding error; else from two
    differences of lower order, which costs a few more.
    """
    found = {(i,): f.value(x) for i, x in enumerate(values)}
    for degree in range(1, order + 1):
        lower, found = found, {}
        for indices in itertools.product(range(len(values)), repeat=degree + 1):
            if list(indices) != sorted(indices):
                continue
            points = [values[i] for i in indices]
            gap, middle = points[-1] - points[0], (points[0] + points[-1]) / 2
            if indices[0] == indices[-1]:
                found[indices] = _near(f, points, middle)
                continue
            low, high = lower[indices[:-1]], lower[indices[1:]]
            far = f.slope(points[0], points[-1]) if degree == 1 else (high - low) / gap
            found[indices] = torch.where(4 * gap <= f.scale(middle), _near(f, points, middle), far)
    return found


def _near(f: _Scalar, points: Sequence[Tensor], middle: Tensor) -> Tensor:
    """A divided difference by Taylor's series: coefficients times complete symmetric polynomials of the offsets."""
    order, scale = len(points) - 1, f.scale(middle)
    first, *others = [(x - middle) / scale for x in points]
    terms = 1 if all(x is points[0] for x in points) else TERMS
    symmetric = [torch.ones_like(first)]
    for _ in range(1, terms):
        symmetric.append(symmetric[-1] * first)
    for offset in others:
        for k in range(1, terms):
            symmetric[k] = symmetric[k] + offset * symmetric[k - 1]
    coefficients = f.taylor(middle, order + terms)[order:]
    return sum((c * h for c, h in zip(coefficients, symmetric, strict=True)), 0 * first) / scale**order
'''.replace("TERMS", "20")

SCALARS = {
    "exp": '''
def _exp_taylor(c: Tensor, count: int) -> list[Tensor]:
    """exp(c + t)."""
    return [torch.exp(c) / float(math.factorial(j)) for j in range(count)]


_SCALARS["exp"] = _Scalar(
    torch.exp, lambda a, b: (torch.exp(b) - torch.exp(a)) / (b - a), torch.ones_like, _exp_taylor
)
''',
    "log": '''
def _log_taylor(c: Tensor, count: int) -> list[Tensor]:
    """log(c (1 + t))."""
    return [torch.log(c), *(torch.full_like(c, -((-1.0) ** j) / j) for j in range(1, count))]


_SCALARS["log"] = _Scalar(torch.log, lambda a, b: torch.log(b / a) / (b - a), lambda c: c, _log_taylor)
''',
    "sqrt": '''
def _sqrt_taylor(c: Tensor, count: int) -> list[Tensor]:
    """sqrt(c (1 + t))."""
    coefficients = [torch.sqrt(c)]
    for j in range(1, count):
        coefficients.append(coefficients[-1] * ((1.5 - j) / j))
    return coefficients


_SCALARS["sqrt"] = _Scalar(torch.sqrt, lambda a, b: 1 / (torch.sqrt(a) + torch.sqrt(b)), lambda c: c, _sqrt_taylor)
''',
    "invsqrt": '''
def _invsqrt_taylor(c: Tensor, count: int) -> list[Tensor]:
    """1 / sqrt(c (1 + t))."""
    coefficients = [torch.rsqrt(c)]
    for j in range(1, count):
        coefficients.append(coefficients[-1] * ((0.5 - j) / j))
    return coefficients


def _invsqrt_slope(a: Tensor, b: Tensor) -> Tensor:
    x, y = torch.sqrt(a), torch.sqrt(b)
    return -1 / (x * y * (x + y))


_SCALARS["invsqrt"] = _Scalar(torch.rsqrt, _invsqrt_slope, lambda c: c, _invsqrt_taylor)
''',
    "log_sinhc_sqrt": '''
def _log_sinhc_sqrt(x: Tensor) -> Tensor:
    """log(sinh(sqrt x) / sqrt x): by its series where x is small, for its relative error."""
    small = x < 4
    y = torch.where(small, x, 0.0)
    series = torch.zeros_like(x)
    for k in reversed(range(12)):
        series = series * y + 1 / math.factorial(2 * k + 3)
    root = torch.sqrt(torch.where(small, 4.0, x))
    return torch.where(small, torch.log1p(y * series), root - torch.log(2 * root) + torch.log1p(-torch.exp(-2 * root)))


def _log_sinhc_sqrt_taylor(c: Tensor, count: int) -> list[Tensor]:
    """log g of g = sinh(sqrt x) / sqrt x, whose coefficients obey 4 x g'' + 6 g' = g and are found from the last to the first.

    For large x, sqrt x - log(4 x) / 2.
    """
    large, scale = c > 400, c + math.pi**2
    x, ratio, ratios = torch.where(large, 400.0, c), torch.zeros_like(c), []
    for k in reversed(range(count + 24)):
        ratio = 1 / ((k + 1) * ((4 * k + 6) / scale + 4 * (k + 2) * x / scale**2 * ratio))
        ratios.append(ratio)
    g, coefficients = [torch.ones_like(c)], [_log_sinhc_sqrt(c)]
    power, log = torch.sqrt(c), torch.ones_like(c)
    for k in range(1, count):
        g.append(g[-1] * ratios[-k])
        convolution = sum((j * coefficients[j] * g[k - j] for j in range(1, k)), torch.zeros_like(c))
        power, log = power * (1.5 - k) / k * scale / c, -log * scale / c
        coefficients.append(torch.where(large, power + log / (2 * k), g[k] - convolution / k))
    return coefficients


_SCALARS["log_sinhc_sqrt"] = _Scalar(
    _log_sinhc_sqrt,
    lambda a, b: (_log_sinhc_sqrt(b) - _log_sinhc_sqrt(a)) / (b - a),
    lambda c: c + math.pi**2,
    _log_sinhc_sqrt_taylor,
)
''',
}


def functions(routines: Sequence[Routine]) -> list[str]:
    """The names of the functions of matrices that routines take, in the order of their first use."""
    nodes = (node for routine in routines for node in routine.nodes if node.op == "spectral")
    return list(dict.fromkeys(node.function[0] for node in nodes))


def runtime(routines: Sequence[Routine]) -> list[str]:
    """The helpers that routines need: none where they take no functions of matrices."""
    names = functions(routines)
    if not any(node.op == "eigh" for routine in routines for node in routine.nodes):
        return []
    table = "_SCALARS: dict[str, _Scalar] = {}"
    return [part.strip("\n") for part in (CORE, table, *(SCALARS[name] for name in names))]
