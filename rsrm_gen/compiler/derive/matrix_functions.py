"""Functions of symmetric matrices as sympy knows them: one expression for each entry of the value.

The matrix is its entries on and above the diagonal ("packed"). The derivative of an entry is an entry of the next
derivative of the matrix function in the direction of a unit matrix; nothing is ever said of eigenvectors.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mpmath as mp
import sympy as sp
from sympy.core.function import ArgumentIndexError

from rsrm_gen.compiler.derive.matrix_numeric import NAMES, Packed, derivative, eigenvalues, size_of


class MatrixFunction(sp.Function):  # type: ignore[misc]
    """MatrixFunction(k, m, i, A..., E1..., ..., Em...): the packed entry i of D^m f(A)[E1, ..., Em], f the k-th of `NAMES`."""

    is_real = True
    HEAD, INDEX = 3, 2  # how many arguments come before the matrices, and which of them is i

    @classmethod
    def entry(cls, word: str, index: int, matrix: Sequence[sp.Expr]) -> sp.Expr:
        """A packed entry of the function that is called `word` in a formula: expm, logm, ..."""
        return cls(sp.Integer(NAMES.index(word[:-1])), sp.Integer(0), sp.Integer(index), *matrix)

    @property
    def name_of_function(self) -> str:
        """Which function: a member of `NAMES`."""
        return NAMES[int(self.args[0])]

    @property
    def order(self) -> int:
        """How many directions there are."""
        return int(self.args[1])

    @property
    def index(self) -> int:
        """Which packed entry of the value this is."""
        return int(self.args[2])

    @property
    def matrices(self) -> list[tuple[sp.Expr, ...]]:
        """A and the directions, packed."""
        packed = self.args[3:]
        size = len(packed) // (self.order + 1)
        return [packed[k : k + size] for k in range(0, len(packed), size)]

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """In an entry of A: one more direction. In an entry of a direction: that direction a unit matrix."""
        if argindex <= 3:
            raise ArgumentIndexError(self, argindex)
        matrices = self.matrices
        which, k = divmod(argindex - 4, len(matrices[0]))
        unit = tuple(sp.Integer(int(i == k)) for i in range(len(matrices[0])))
        if which == 0:
            return self.rebuilt(self.order + 1, [*matrices, unit])
        return self.rebuilt(self.order, [*matrices[:which], unit, *matrices[which + 1 :]])

    def rebuilt(self, order: int, matrices: Sequence[Sequence[sp.Expr]]) -> sp.Expr:
        """The same entry of the same function for other matrices."""
        head = self.args[0], sp.Integer(order), self.args[2]
        return self.func(*head, *(e for matrix in matrices for e in matrix))

    def value(self, packed: Sequence[Any]) -> Any:
        """Its value from those of the entries of all matrices, in the working precision of mpmath."""
        return self.values(packed)[self.index]

    def values(self, packed: Sequence[Any]) -> Packed:
        """The same of all entries of the value."""
        size = len(packed) // (self.order + 1)
        matrix, *directions = (tuple(packed[k : k + size]) for k in range(0, len(packed), size))
        return derivative(self.name_of_function, matrix, tuple(directions))

    def _eval_evalf(self, prec: int) -> sp.Expr:
        return _evaluated(self, self.args[3:], prec)

    def _sympystr(self, printer: Any) -> str:
        matrices = ", ".join(f"[{', '.join(printer.doprint(e) for e in m)}]" for m in self.matrices)
        return f"{'D' * self.order}{self.name_of_function}m({matrices})[{self.index}]"


class Eigenvalue(sp.Function):  # type: ignore[misc]
    """Eigenvalue(n, i, A...): the i-th eigenvalue of an n x n matrix, ascending. It has no derivative where two meet."""

    is_real = True
    HEAD, INDEX = 2, 1  # how many arguments come before the matrix, and which of them is i

    def value(self, packed: Packed) -> Any:
        """Its value from those of the entries of A, in the working precision of mpmath."""
        return self.values(packed)[int(self.args[1])]

    def values(self, packed: Packed) -> Packed:
        """The same of all eigenvalues."""
        return eigenvalues(tuple(packed))

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Refused: eigenvalues are only compared."""
        raise ArgumentIndexError(self, argindex)

    def _eval_evalf(self, prec: int) -> sp.Expr:
        return _evaluated(self, self.args[2:], prec)

    def _sympystr(self, printer: Any) -> str:
        n = size_of(len(self.args) - 2)
        return f"eigh([{', '.join(map(printer.doprint, self.args[2:]))}])[{self.args[1]} of {n}]"


def _evaluated(expression: Any, entries: Sequence[sp.Expr], prec: int) -> sp.Expr:
    """Its value as a sympy number when its entries are numbers."""
    if not all(e.is_number for e in entries):
        return expression
    with mp.workprec(prec):
        packed = [mp.mpf(e._to_mpmath(prec)) for e in entries]
        return sp.Float(expression.value(packed), precision=prec)
