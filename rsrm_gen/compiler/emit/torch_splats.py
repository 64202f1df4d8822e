"""Sums of splats in a generated torch module: the routines of `Pairs` as methods, and the loop over chunks of points.

A pair of a point and a splat is one entry of an (n, K) tensor, made by broadcasting entries of points (n, 1) against those
of splats (K); n points at a time, so that what is held of pairs is bounded. Nothing of them is kept for the backward pass,
which makes its own.
"""

from __future__ import annotations

import textwrap

from rsrm_gen.compiler.derive import Geometry
from rsrm_gen.compiler.emit.series import Coefficients
from rsrm_gen.compiler.emit.torch_routine import WIDTH, body, listed
from rsrm_gen.compiler.lower import Routine
from rsrm_gen.compiler.lower.ir import Pairs, Parameter

HELPERS = '''
def _chunks(x: Tensor, splats: int) -> Sequence[Tensor]:
    """Points by chunks whose pairs with all splats are a bounded number; all at once where a compiler fuses the sums."""
    if torch.compiler.is_compiling():
        return (x,)
    pairs = 2**15 if x.device.type == "cpu" else 2**21  # CPU: what fits in a cache
    return x.split(max(1, pairs // max(1, splats)))


def _sums(entries: Sequence[Tensor], points: int, splats: int, dim: int) -> list[Tensor]:
    """Entries of pairs, summed over the points (dim 0) or over the splats (dim 1)."""
    return [entry.expand(points, splats).sum(dim) for entry in entries]


def _checked(
    manifold: Any, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor
) -> tuple[tuple[Tensor, Tensor, Tensor, Tensor], torch.dtype]:
    """The four in one precision, single for what is less, and the precision of the results; their shapes must fit."""
    K, D = len(mu) if mu.dim() else 0, manifold.point_size
    N = len(x) if x.dim() else 0
    shapes = {"x": (N, D), "mu": (K, D), "W": (K, manifold.dim, manifold.tangent_size), "amplitude": (K,)}
    dtype = x.dtype
    for (name, shape), tensor in zip(shapes.items(), (x, mu, W, amplitude), strict=True):
        if tensor.shape != shape:
            raise ValueError(f"{name} has shape {tuple(tensor.shape)}; with {N} points and {K} splats it is {shape}")
        if not tensor.is_floating_point():
            raise TypeError(f"{name} is {tensor.dtype}: splats take floating-point numbers")
        dtype = torch.promote_types(dtype, tensor.dtype)
    inside = torch.promote_types(dtype, torch.float32)
    return (x.to(inside), mu.to(inside), W.to(inside), amplitude.to(inside)), dtype


class _Splats(torch.autograd.Function):
    """The sums under autograd: the backward pass is one sweep over all pairs."""

    @staticmethod
    def forward(ctx: Any, manifold: Any, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, Tensor]:
        """Values and gradients."""
        ctx.manifold = manifold
        ctx.save_for_backward(x, mu, W, amplitude)
        value, gradient = manifold._splats(x, mu, W, amplitude)
        return value, gradient

    @staticmethod
    def backward(ctx: Any, value_bar: Tensor, gradient_bar: Tensor) -> tuple[Tensor | None, ...]:
        """The derivatives in mu, W and amplitude."""
        tensors = *ctx.saved_tensors, value_bar, gradient_bar
        if torch.is_grad_enabled() and not torch.compiler.is_compiling():
            return None, None, *_SplatsBackward.apply(ctx.manifold, *tensors)  # type: ignore[no-untyped-call]
        return None, None, *ctx.manifold._splats_vjp(*tensors)


class _SplatsBackward(torch.autograd.Function):
    """The backward pass where somebody might differentiate it again, which is an error."""

    @staticmethod
    def forward(ctx: Any, manifold: Any, *tensors: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """The derivatives in mu, W and amplitude."""
        by_mu, by_W, by_amplitude = manifold._splats_vjp(*tensors)
        return by_mu, by_W, by_amplitude

    @staticmethod
    def backward(ctx: Any, *bars: Tensor) -> Any:
        """None."""
        raise RuntimeError("`splats` has first derivatives only; of `splat`, autograd knows all")
'''

METHODS = '''
def splats(
    self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, width: Tensor | None = None
) -> tuple[Tensor, Tensor]:
    """The sum of K splats at N points, and its Riemannian gradient (RSRM eq. 4).

    Shapes: x (N, D), mu (K, D), W (K, d, T), amplitude (K) to (N), (N, T). `width` (K) is for kernels that leave far
    pairs out; here all are summed.
    Differentiable once in mu, W and amplitude, with nothing of size N x K kept. Where x requires a gradient too, autograd
    differentiates the formula of every pair, as often as is wanted, and keeps all of them.
    """
    tensors, dtype = _checked(self, x, mu, W, amplitude)
    if x.requires_grad and torch.is_grad_enabled():
        value, *entries = self._splat(tensors[0].unsqueeze(-2), *tensors[1:])
        value, gradient = value.sum(-1), _stack([entry.sum(-1) for entry in entries])
    else:
        value, gradient = _Splats.apply(self, *tensors)  # type: ignore[no-untyped-call]
    return value.to(dtype), gradient.to(dtype)

def splats_value(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
    """The value of `splats` alone: (N), differentiable as there."""
    tensors, dtype = _checked(self, x, mu, W, amplitude)
    if torch.is_grad_enabled() and any(tensor.requires_grad for tensor in tensors):
        return self.splats(x, mu, W, amplitude)[0]
    return self._splats_value(*tensors).to(dtype)

def splats_rows(
    self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, value_bar: Tensor, gradient_bar: Tensor
) -> Tensor:
    """The derivatives of value_bar_n value_n + gradient_bar_n . gradient_n of `splats`, each point's by itself.

    Shapes: as in `splats`, value_bar (N), gradient_bar (N, T) to (N, K, D + d T + 1), the derivatives in mu, W (row by
    row) and amplitude of every splat; not differentiable. Their sum over N is what the backward pass of `splats` gives.
    """
    tensors, dtype = _checked(self, x, mu, W, amplitude)
    with torch.no_grad():
        return self._splats_rows(*tensors, value_bar.to(tensors[0]), gradient_bar.to(tensors[0])).to(dtype)

def kernels(self, like: Tensor) -> str:
    """What computes `splats` for tensors like this one."""
    return f"torch, {like.device.type}"

def _splats(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> tuple[Tensor, Tensor]:
    """Values (N) and gradients (N, T)."""
    S = [entry.contiguous() for entry in self._splat_constants(mu, W, amplitude)]
    values, gradients = [], []
    for part in _chunks(x, len(mu)):
        X = [entry.unsqueeze(-1) for entry in self._point_features(part)]
        value, *slope = _sums(self._pair(X, S), len(part), len(mu), 1)
        values.append(value)
        gradients.append(self._point_gradient(part, slope))
    return torch.cat(values), torch.cat(gradients)

def _splats_value(self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor) -> Tensor:
    """Values (N) alone."""
    S = [entry.contiguous() for entry in self._splat_constants(mu, W, amplitude)]
    values = []
    for part in _chunks(x, len(mu)):
        X = [entry.unsqueeze(-1) for entry in self._point_features(part)]
        values += _sums(self._pair_value(X, S), len(part), len(mu), 1)
    return torch.cat(values)

def _splats_vjp(
    self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, value_bar: Tensor, gradient_bar: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """The derivatives of <value, value_bar> + <gradient, gradient_bar> in mu (K, D), W (K, d, T) and amplitude (K)."""
    S = [entry.contiguous() for entry in self._splat_constants(mu, W, amplitude)]
    total = torch.zeros((), dtype=x.dtype, device=x.device)
    parts = (_chunks(tensor, len(mu)) for tensor in (x, value_bar, gradient_bar))
    for part, *bars in zip(*parts, strict=True):
        total = total + torch.stack(_sums(self._pair_bars(part, S, *bars), len(part), len(mu), 0))
    return self._splat_constants_vjp(mu, W, amplitude, total.unbind(0))

def _splats_rows(
    self, x: Tensor, mu: Tensor, W: Tensor, amplitude: Tensor, value_bar: Tensor, gradient_bar: Tensor
) -> Tensor:
    """The rows (N, K, D + d T + 1) of the derivatives that `_splats_vjp` sums over N."""
    S = [entry.contiguous() for entry in self._splat_constants(mu, W, amplitude)]
    parts = (_chunks(tensor, len(mu)) for tensor in (x, value_bar, gradient_bar))
    rows = []
    for part, *bars in zip(*parts, strict=True):
        sums = [entry.expand(len(part), len(mu)) for entry in self._pair_bars(part, S, *bars)]
        by_mu, by_W, by_amplitude = self._splat_constants_vjp(mu, W, amplitude, sums)
        rows.append(torch.cat([by_mu, by_W.flatten(-2), by_amplitude.unsqueeze(-1)], -1))
    return torch.cat(rows)

def _pair_bars(
    self, x: Tensor, S: Sequence[Tensor], value_bar: Tensor, gradient_bar: Tensor
) -> tuple[Tensor, ...]:
    """What every pair adds to the sums of its splat, from the derivatives in values and gradients."""
    X = [entry.unsqueeze(-1) for entry in self._point_features(x)]
    slope_bar = [entry.unsqueeze(-1) for entry in self._point_gradient_vjp(x, gradient_bar)]
    return self._pair_vjp(X, S, value_bar.unsqueeze(-1), slope_bar)
'''

# A routine of `Pairs`: its method, and what that gives.
PROMISES = {
    "features": ("_point_features", "X, what the pairs need of a point alone."),
    "constants": ("_splat_constants", "S, what the pairs need of a splat alone."),
    "value": ("_pair_value", "The value of a splat at a point."),
    "forward": ("_pair", "The value of a splat at a point, and the slope, its derivatives in X."),
    "gradient": ("_point_gradient", "The Riemannian gradient of a function whose derivatives in X are `slope`."),
    "gradient_vjp": ("_point_gradient_vjp", "The derivatives of gradient . gradient_bar in `slope`."),
    "backward": (
        "_pair_vjp",
        "What, summed over the points, makes the derivatives of value value_bar + slope . slope_bar.",
    ),
    "constants_vjp": ("_splat_constants_vjp", "The derivatives in mu, W and amplitude from those sums."),
}
APART = {"X", "S", "slope", "slope_bar", "sums"}  # sequences of tensors, one an entry


def methods(geometry: Geometry, pairs: Pairs, series: dict[Coefficients, str]) -> list[str]:
    """The methods of the class that sum splats."""
    texts = [METHODS.strip("\n")]
    texts += [_method(geometry, routine, series) for routine in pairs]
    return [textwrap.indent(text, "    ") for text in texts]


def _method(geometry: Geometry, routine: Routine, series: dict[Coefficients, str]) -> str:
    name, promise = PROMISES[routine.name]
    lines, texts = body(routine, series, APART)
    parameters = ", ".join(f"{p.name}: {_type(p)}" for p in routine.parameters)
    texts = [
        f"torch.full_like({_like(routine.parameters[-1])}, {text})" if node.is_constant else text
        for node, text in zip((n for r in routine.results for n in r.nodes), texts, strict=True)
    ]
    returns, final = _results(geometry, routine, texts)
    content = "\n".join([f'"""{promise}"""', *lines, *final])
    return f"{_signature(name, parameters, returns)}\n{textwrap.indent(content, '    ')}"


def _signature(name: str, parameters: str, returns: str) -> str:
    line = f"def {name}(self, {parameters}) -> {returns}:"
    return line if len(line) <= WIDTH - 4 else f"def {name}(\n    self, {parameters}\n) -> {returns}:"


def _type(parameter: Parameter) -> str:
    return "Sequence[Tensor]" if parameter.name in APART else "Tensor"


def _like(parameter: Parameter) -> str:
    """A tensor of the leading shape of an argument."""
    return f"{parameter.name}[0]" if parameter.name in APART else f"{parameter.name}[..., 0]"


def _results(geometry: Geometry, routine: Routine, texts: list[str]) -> tuple[str, list[str]]:
    """The type of what a routine returns, and the statements that do so."""
    if routine.name == "gradient":
        return "Tensor", [listed("return _stack((", texts, "))")]
    if routine.name != "constants_vjp":
        return "tuple[Tensor, ...]", [listed("return (", texts, ")")]
    spec = geometry.spec
    mu, W = texts[: spec.point_size], texts[spec.point_size : -1]
    return "tuple[Tensor, Tensor, Tensor]", [
        listed("mu_bar = _stack((", mu, "))"),
        listed("W_bar = _stack((", W, "))"),
        f"return mu_bar, W_bar.unflatten(-1, ({spec.dim}, {spec.tangent_size})), {texts[-1]}",
    ]
