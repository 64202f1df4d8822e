"""Functions of symmetric matrices in generated C: static functions, written only for the sizes and orders that are used.

A matrix comes as its entries on and above the diagonal ("packed"). An eigen-decomposition is n eigenvalues, ascending,
and n x n numbers whose columns are the eigenvectors.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Sequence

from rsrm_gen.compiler.derive.matrix_numeric import places
from rsrm_gen.compiler.emit.c_precision import Precision
from rsrm_gen.compiler.lower import Node, Routine

SWEEPS = {1: 0, 2: 1, 3: 8, 4: 10, 5: 12, 6: 12, 7: 14, 8: 14}  # twice what random matrices take
TERMS = 20  # of Taylor's series: at most an eighth of the scale from the middle


def support(routines: Iterable[Routine], precision: Precision) -> list[str]:
    """The static functions that some routines call."""
    nodes = [node for routine in routines for node in routine.nodes]
    sizes = sorted({node.rows for node in nodes if node.op == "eigh"})
    uses = sorted({_use(node) for node in nodes if node.op == "spectral"})
    turned = sorted({n for _, n, order in uses if order})
    differences = sorted({name for name, _, order in uses if order})
    parts = [_eigh(n, precision) for n in sizes]
    parts += [_scalar(name, precision, name in differences) for name in sorted({name for name, _, _ in uses})]
    parts += [_into_eigenbasis(n, precision) for n in turned]
    parts += [_out_of_eigenbasis(n, precision) for n in sorted({n for _, n, _ in uses})]
    parts += [_spectral(name, n, order, precision) for name, n, order in uses]
    return [_spelled(part, precision) for part in parts]


def call(name: str, node: Node, arguments: Sequence[str], precision: Precision) -> str:
    """The statements that compute a node of several values into an array of that name."""
    t, tag, n = precision.type, precision.tag, node.rows
    if node.op == "eigh":
        packed = f"const {t} in_0[{len(arguments)}] = {{{', '.join(arguments)}}};"
        return f"{t} {name}[{n + n * n}];\n{{\n    {packed}\n    symmetric_eigh_{n}{tag}(in_0, {name});\n}}"
    function, _, order = _use(node)
    eigh, entries, size = arguments[0], arguments[1:], len(places(n))
    blocks = [entries[k : k + size] for k in range(0, len(entries), size)]
    lines = [f"const {t} in_{k}[{size}] = {{{', '.join(block)}}};" for k, block in enumerate(blocks)]
    if order == 0:
        return f"{t} {name}[{size}];\n{_function(function, n, order)}{tag}({eigh}, {name});"
    names = ", ".join([eigh, *(f"in_{k}" for k in range(order)), name])
    statements = "\n    ".join([*lines, f"{_function(function, n, order)}{tag}({names});"])
    return f"{t} {name}[{size}];\n{{\n    {statements}\n}}"


def _use(node: Node) -> tuple[str, int, int]:
    name, order = node.function
    return name, node.rows, order


def _function(name: str, n: int, order: int) -> str:
    return f"symmetric_{name}_{n}" + (f"_derivative{order}" if order else "")


def _spelled(text: str, precision: Precision) -> str:
    """The text in a precision: T is the type, @ ends the names of functions, numbers end in %."""
    text = re.sub(r"\bT_", precision.type + " ", text).replace("@", precision.tag)
    return text.replace("%", precision.suffix).strip("\n")


def _eigh(n: int, precision: Precision) -> str:
    del precision
    at = {place: k for k, place in enumerate(places(n))}
    rows = ", ".join("{" + ", ".join(f"in[{at[min(i, j), max(i, j)]}]" for j in range(n)) + "}" for i in range(n))
    return f"""
/* Eigenvalues, ascending, and eigenvectors of a symmetric {n} x {n} matrix, by Jacobi's rotations. */
static void symmetric_eigh_{n}@(const T_*in, T_*out) {{
    T_a[{n}][{n}] = {{{rows}}}, v[{n}][{n}] = {{{{0}}}}, poison = 0;
    for (int i = 0; i < {n}; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < {SWEEPS[n]}; ++sweep) {{
        for (int p = 0; p < {n}; ++p) {{
            for (int q = p + 1; q < {n}; ++q) {{
                const T_twice = 2 * a[p][q], gap = a[q][q] - a[p][p];
                if (twice == 0) continue;
                const T_theta = gap / twice;
                const T_t = (theta < 0 ? -1 : 1) / (fabs%(theta) + sqrt%(theta * theta + 1));
                const T_c = 1 / sqrt%(t * t + 1), s = t * c, part = s / (1 + c);
                a[p][p] -= t * a[p][q];
                a[q][q] += t * a[p][q];
                a[p][q] = a[q][p] = 0;
                for (int k = 0; k < {n}; ++k) {{
                    const T_x = v[k][p], y = v[k][q];
                    v[k][p] = x - s * (y + part * x);
                    v[k][q] = y + s * (x - part * y);
                    if (k == p || k == q) continue;
                    const T_ap = a[k][p], aq = a[k][q];
                    a[k][p] = a[p][k] = ap - s * (aq + part * ap);
                    a[k][q] = a[q][k] = aq + s * (ap - part * aq);
                }}
            }}
        }}
    }}
    for (int i = 0; i < {n}; ++i)
        for (int j = 0; j < {n}; ++j) poison += 0 * a[i][j] + 0 * v[i][j]; /* NaN when one of them is not finite */
    for (int i = 0; i < {n}; ++i) a[i][i] += poison;
    for (int i = 0; i < {n}; ++i) {{
        int rank = 0; /* how many come before: equal ones in their order */
        for (int j = 0; j < {n}; ++j) rank += a[j][j] < a[i][i] || (j < i && !(a[j][j] > a[i][i]));
        out[rank] = a[i][i];
        for (int k = 0; k < {n}; ++k) out[{n} + {n} * k + rank] = v[k][i];
    }}
}}"""


def _into_eigenbasis(n: int, precision: Precision) -> str:
    del precision
    at = {place: k for k, place in enumerate(places(n))}
    rows = ", ".join("{" + ", ".join(f"in[{at[min(i, j), max(i, j)]}]" for j in range(n)) + "}" for i in range(n))
    return f"""
/* V^T E V of a packed matrix E. */
static void into_eigenbasis_{n}@(const T_*eigh, const T_*in, T_(*out)[{n}]) {{
    const T_e[{n}][{n}] = {{{rows}}}, *v = eigh + {n};
    T_half[{n}][{n}] = {{{{0}}}};
    for (int i = 0; i < {n}; ++i)
        for (int k = 0; k < {n}; ++k)
            for (int j = 0; j < {n}; ++j) half[i][j] += e[i][k] * v[{n} * k + j];
    for (int i = 0; i < {n}; ++i) {{
        for (int j = 0; j < {n}; ++j) {{
            out[i][j] = 0;
            for (int k = 0; k < {n}; ++k) out[i][j] += v[{n} * k + i] * half[k][j];
        }}
    }}
}}"""


def _out_of_eigenbasis(n: int, precision: Precision) -> str:
    del precision
    return f"""
/* V A V^T, packed. */
static void out_of_eigenbasis_{n}@(const T_*eigh, const T_(*in)[{n}], T_*out) {{
    const T_*v = eigh + {n};
    for (int i = 0; i < {n}; ++i) {{
        T_half[{n}] = {{0}};
        for (int k = 0; k < {n}; ++k)
            for (int j = 0; j < {n}; ++j) half[j] += v[{n} * i + k] * in[k][j];
        for (int j = i; j < {n}; ++j) {{
            T_sum = 0;
            for (int k = 0; k < {n}; ++k) sum += half[k] * v[{n} * j + k];
            *out++ = sum;
        }}
    }}
}}"""


SCALARS = {
    "exp": ("exp%(x)", "(exp%(b) - exp%(a)) / (b - a)", "(void)c;\n    return 1;"),
    "log": ("log%(x)", "log%(b / a) / (b - a)", "return c;"),
    "sqrt": ("sqrt%(x)", "1 / (sqrt%(a) + sqrt%(b))", "return c;"),
    "invsqrt": (
        "1 / sqrt%(x)",
        "-1 / (sqrt%(a) * sqrt%(b) * (sqrt%(a) + sqrt%(b)))",
        "return c;",
    ),
    "log_sinhc_sqrt": (
        "x < 4 ? log1p%(x * scalar_sinhc_rest@(x)) : sqrt%(x) - log%(2 * sqrt%(x)) + log1p%(-exp%(-2 * sqrt%(x)))",
        "(scalar_log_sinhc_sqrt@(b) - scalar_log_sinhc_sqrt@(a)) / (b - a)",
        "return c + 9.8696044010893586%;",
    ),
}

TAYLOR = {
    "exp": """
    out[0] = exp%(c);
    for (int k = 1; k < count; ++k) out[k] = out[k - 1] / (T)k;""",
    "log": """
    out[0] = log%(c);
    for (int k = 1; k < count; ++k) out[k] = (k % 2 ? 1 : -1) / (T)k;""",
    "sqrt": """
    out[0] = sqrt%(c);
    for (int k = 1; k < count; ++k) out[k] = out[k - 1] * (1.5% - (T)k) / (T)k;""",
    "invsqrt": """
    out[0] = 1 / sqrt%(c);
    for (int k = 1; k < count; ++k) out[k] = out[k - 1] * (0.5% - (T)k) / (T)k;""",
    # log g of g = sinh(sqrt x) / sqrt x; 4 x g'' + 6 g' = g gives the ratios of the coefficients of g from the last on.
    "log_sinhc_sqrt": """
    const T_scale = scale_log_sinhc_sqrt@(c), large = c > 400, x = large ? 400 : c;
    T_ratio[64], g[64], power = sqrt%(c), log = 1;
    ratio[count + 24] = 0;
    for (int k = count + 23; k >= 0; --k)
        ratio[k] = 1 / ((T)(k + 1) * ((T)(4 * k + 6) / scale + (T)(4 * k + 8) * x / (scale * scale) * ratio[k + 1]));
    g[0] = 1;
    out[0] = scalar_log_sinhc_sqrt@(c);
    for (int k = 1; k < count; ++k) {
        T_sum = 0;
        g[k] = g[k - 1] * ratio[k - 1];
        for (int j = 1; j < k; ++j) sum += (T)j * out[j] * g[k - j];
        power *= (1.5% - (T)k) / (T)k * scale / c;
        log *= -scale / c;
        out[k] = large ? power + log / (T)(2 * k) : g[k] - sum / (T)k;
    }""",
}

SINHC_REST = """
/* sinh(sqrt x) / sqrt x = 1 + x times this, for x < 4. */
static T_scalar_sinhc_rest@(T_x) {
    T_sum = 0;
    for (int k = 11; k >= 0; --k) sum = (1 + x * sum) / (T)((2 * k + 2) * (2 * k + 3));
    return sum;
}
"""


def _scalar(name: str, precision: Precision, differences: bool) -> str:
    """A function of a number, and what its divided differences need."""
    value, slope, scale = SCALARS[name]
    text = SINHC_REST if name == "log_sinhc_sqrt" else ""
    text += f"\nstatic T_scalar_{name}@(T_x) {{ return {value}; }}\n"
    if differences:
        text += f"""
static T_slope_{name}@(T_a, T_b) {{ return {slope}; }}

static T_scale_{name}@(T_c) {{
    {scale}
}}

/* The coefficients in t of {name}(c + scale(c) t). */
static void taylor_{name}@(T_c, int count, T_*out) {{{TAYLOR[name]}
}}

/* The divided difference of `order` + 1 points within a quarter of the scale of their middle. */
static T_near_{name}@(const T_*x, int order, T_middle) {{
    const T_scale = scale_{name}@(middle);
    T_coefficients[{TERMS} + 8], symmetric[{TERMS}] = {{1}}, sum = 0;
    const int terms = x[order] == x[0] ? 1 : {TERMS};
    taylor_{name}@(middle, terms + order, coefficients);
    for (int i = 0; i <= order; ++i)
        for (int k = 1; k < terms; ++k) symmetric[k] += (x[i] - middle) / scale * symmetric[k - 1];
    for (int k = 0; k < terms; ++k) sum += coefficients[order + k] * symmetric[k];
    for (int i = 0; i < order; ++i) sum /= scale;
    return sum;
}}
"""
    return text.replace("(T)", f"({precision.type})").replace(" % 2 ", " & 1 ")


def _spectral(name: str, n: int, order: int, precision: Precision) -> str:
    """D^m f(A)[E_0, ..., E_(m-1)]."""
    del precision
    inputs = "".join(f", const T_*in_{k}" for k in range(order))
    tables = ", ".join(f"w{m}" + f"[{n}]" * (m + 1) for m in range(min(order, 1), order + 1))
    lines = [f"T_{tables}, total[{n}][{n}] = {{{{0}}}};"]
    if order:
        lines.append("T_" + ", ".join(f"e{k}[{n}][{n}]" for k in range(order)) + ";")
    lines += [f"into_eigenbasis_{n}@(eigh, in_{k}, e{k});" for k in range(order)]
    for m in range(min(order, 1), order + 1):
        lines += _table(name, n, m)
    lines += _paths(n, order)
    lines.append(f"out_of_eigenbasis_{n}@(eigh, (const T_(*)[{n}])total, out);")
    body = "\n".join("    " + line for line in lines)
    meaning = f"D^{order} {name}(A)[E" + ", E" * (order - 1) + "]" if order else f"{name}(A)"
    title = f"/* {meaning} of the eigen-decomposition of A, packed. */"
    return f"{title}\nstatic void {_function(name, n, order)}@(const T_*eigh{inputs}, T_*out) {{\n{body}\n}}"


def _table(name: str, n: int, order: int) -> list[str]:
    """The divided differences of `order` + 1 eigenvalues, in every order of their indices."""
    indices = [f"i{k}" for k in range(order + 1)]
    if order == 0:
        return [f"for (int i0 = 0; i0 < {n}; ++i0) w0[i0] = scalar_{name}@(eigh[i0]);"]
    lines, starts = [], ["0", *indices]
    for k, index in enumerate(indices):
        lines.append("    " * k + f"for (int {index} = {starts[k]}; {index} < {n}; ++{index})" + " {" * (k == order))
    last = indices[-1]
    points = ", ".join(f"eigh[{i}]" for i in indices)
    lower = [f"w{order - 1}" + "".join(f"[{i}]" for i in part) for part in (indices[1:], indices[:-1])]
    far = f"slope_{name}@(eigh[i0], eigh[i1])" if order == 1 else f"({lower[0]} - {lower[1]}) / gap"
    targets = dict.fromkeys(f"w{order}" + "".join(f"[{i}]" for i in p) for p in itertools.permutations(indices))
    inner = [
        f"const T_x[{order + 1}] = {{{points}}}, gap = eigh[{last}] - eigh[i0], middle = (eigh[i0] + eigh[{last}]) / 2;",
        f"const T_w = 4 * gap <= scale_{name}@(middle) || !(gap > 0) ? near_{name}@(x, {order}, middle)",
        f"    : {far};",
        " = ".join(targets) + " = w;",
    ]
    pad = "    " * (order + 1)
    return [*lines, *(pad + line for line in inner), "    " * order + "}"]


def _paths(n: int, order: int) -> list[str]:
    """The sum over all indices and over the orders of the directions."""
    indices = [f"i{k}" for k in range(order + 1)]
    weight = f"w{order}" + "".join(f"[{i}]" for i in indices)
    terms = [
        " * ".join(f"e{e}[i{k}][i{k + 1}]" for k, e in enumerate(permutation))
        for permutation in itertools.permutations(range(order))
    ]
    factor = "" if not order else f" * {terms[0]}" if len(terms) == 1 else f" * ({' + '.join(terms)})"
    loops = " ".join(f"for (int {i} = 0; {i} < {n}; ++{i})" for i in indices)
    return [loops, f"    total[i0][{indices[-1]}] += {weight}{factor};"]
