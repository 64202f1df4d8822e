"""|R v|^2 / 2 with its derivatives by the matrix M = R^T R, of which it is a function.

Summed over many points, the derivatives in the n (n + 1) / 2 entries of M are fewer and cheaper than those in the d n of
R, and those of R follow once a splat. Its value is computed from R all the same, because M has the square of R's
condition, and loses digits.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from rsrm_gen.compiler.lower.ir import Graph, Node, Packed, dot

HALF = sp.Rational(1, 2)
LARGEST = 8  # columns of R, beyond which what is done once a splat, d n^2 products, takes the C compiler seconds


def pays(rows: int, columns: int) -> bool:
    """Whether M has fewer entries than R, and is no large matrix."""
    return columns + 1 < 2 * rows and columns <= LARGEST


def half_square(graph: Graph, z: Sequence[Node]) -> Node:
    """|z|^2 / 2, whose derivatives are z: no factor 2 to cancel the half."""
    square = graph.declared(graph.mul(graph.constant(HALF), dot(graph, z, z)), *z)
    graph.slopes[square] = tuple(z)
    return square


def quadratic(graph: Graph, R: Sequence[Packed], v: Packed) -> Node:
    """|R v|^2 / 2 as a function of v and M; the linear forms of M v are noted in `graph.forms`.

    u = M v = R^T (R v) is known to be M v, with a derivative by M (t) and one by v: d (v . u) / 2 = v . dt / 2 + u . dv.
    """
    columns = list(zip(*R, strict=True))
    size = len(columns)
    M = [
        [graph.named(f"M{min(j, k)}_{max(j, k)}", dot(graph, columns[j], columns[k])) for k in range(size)]
        for j in range(size)
    ]
    z = [dot(graph, row, v) for row in R]
    u = []
    by_M = []
    for column, row in zip(columns, M, strict=True):
        value = dot(graph, column, z)
        t = graph.declared(value, *row)
        graph.slopes[t] = v
        both = graph.declared(value, t, *v)
        graph.slopes[both] = (graph.constant(1), *row)
        by_M.append(t)
        u.append(both)
        graph.forms[both] = dot(graph, row, v)
    square = graph.declared(dot(graph, z, z), *by_M)
    graph.slopes[square] = v
    half = graph.declared(graph.mul(graph.constant(HALF), square.arguments[0]), square, *v)
    graph.slopes[half] = (graph.constant(HALF), *u)
    return half
