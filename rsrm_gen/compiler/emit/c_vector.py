"""Vectors in generated C: their types, and routines written on them.

A vector holds as many numbers as a register of the machine; where the compiler has no vectors it is one number, and the
same text is plain C99. What is read for a whole vector at once (the constants of a splat beside a vector of points) stays
a number: only what depends on a vector is one.
"""

from __future__ import annotations

import itertools
import re
import textwrap
from collections.abc import Iterable, Mapping, Sequence

import sympy as sp

from rsrm_gen.compiler.emit import c_matrix
from rsrm_gen.compiler.emit.c_language import WIDTH, series_body, spelling, wrapped
from rsrm_gen.compiler.emit.c_precision import Precision
from rsrm_gen.compiler.emit.expression import ATOM, COMPARISONS, PRODUCT, SUM, UNARY, Printer
from rsrm_gen.compiler.emit.series import Coefficients
from rsrm_gen.compiler.emit.steps import Step, expression, steps
from rsrm_gen.compiler.lower import Node, Routine
from rsrm_gen.compiler.lower.ir import CONDITIONS, FUNCTIONS, SEVERAL
from rsrm_gen.compiler.lower.protect import arguments_first, never_negative

TYPES = """/*
 * A vector is as wide as the machine's registers, or one number where the compiler has no vectors (or is asked for none
 * by -DRSRM_NO_VECTORS). Comparisons of vectors are masks; `vector_select` is the ?: of vectors.
 */
#if defined(__GNUC__) && !defined(RSRM_NO_VECTORS)
#if defined(__AVX512F__)
#define VECTOR_BYTES 64
#elif defined(__AVX__)
#define VECTOR_BYTES 32
#else
#define VECTOR_BYTES 16
#endif
#define LANE(vector, i) (vector)[i]
#define ZERO {0}
typedef double vector __attribute__((vector_size(VECTOR_BYTES)));
typedef float vector_f __attribute__((vector_size(VECTOR_BYTES)));
typedef int64_t vector_mask __attribute__((vector_size(VECTOR_BYTES)));
typedef int32_t vector_mask_f __attribute__((vector_size(VECTOR_BYTES)));
typedef uint64_t vector_bits __attribute__((vector_size(VECTOR_BYTES)));
typedef uint32_t vector_bits_f __attribute__((vector_size(VECTOR_BYTES)));
#else
#define LANE(vector, i) (vector)
#define ZERO 0
typedef double vector;
typedef float vector_f;
typedef int64_t vector_mask;
typedef int32_t vector_mask_f;
typedef uint64_t vector_bits;
typedef uint32_t vector_bits_f;
#endif
#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline, unused))
#else
#define INLINE static inline
#endif
/* `used` keeps signatures: clang 14 at -O3 passes vectors of AVX-512 by value where caller and callee disagree how. */
#if defined(__clang__)
#define OUTLINE static __attribute__((noinline, used))
#elif defined(__GNUC__)
#define OUTLINE static __attribute__((noinline, noclone, used))
#else
#define OUTLINE static
#endif
/* UNROLLED: the few turns of a loop, one after another. EACH_LANE: what gcc makes one instruction as long as it is a loop. */
#if defined(__clang__)
#define UNROLLED _Pragma("clang loop unroll(full)")
#define EACH_LANE
#elif defined(__GNUC__) && __GNUC__ >= 8
#define UNROLLED _Pragma("GCC unroll 8")
#define EACH_LANE _Pragma("GCC unroll 1")
#else
#define UNROLLED
#define EACH_LANE
#endif
#define LANES (sizeof(vector) / sizeof(double))
#define LANES_f (sizeof(vector_f) / sizeof(float))"""

BASICS = """
/* The same number in all lanes. */
INLINE vector@ vector_of@(T_x) {
    const vector@ zero = ZERO;
    return x - zero;
}

/* x in the lanes of the mask, y in the others; clang knows this by its bits, gcc as a loop. */
INLINE vector@ vector_select@(vector_mask@ mask, vector@ x, vector@ y) {
#if defined(__clang__) && !defined(RSRM_NO_VECTORS)
    return (vector@)((mask & (vector_mask@)x) | (~mask & (vector_mask@)y));
#else
    EACH_LANE for (size_t i = 0; i < LANES@; ++i) LANE(x, i) = LANE(mask, i) ? LANE(x, i) : LANE(y, i);
    return x;
#endif
}

/* Numbers in memory to a vector, and back. */
INLINE vector@ vector_load@(const T_*from) {
    vector@ x;
    memcpy(&x, from, sizeof x);
    return x;
}
INLINE void vector_store@(T_*to, vector@ x) { memcpy(to, &x, sizeof x); }

/* The sum over the lanes, by halves. */
INLINE T_vector_sum@(vector@ x) {
    T_lanes[LANES@];
    vector_store@(lanes, x);
    for (size_t half = LANES@ / 2; half > 0; half /= 2)
        for (size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
    return lanes[0];
}"""

# Names that the text around a routine uses, or the compiler.
TAKEN = {"LANES", "LANES_f", "LANE", "INLINE", "OUTLINE", "UNROLLED", "EACH_LANE",
         "OMP", "ZERO", "memcpy", "vector", "vector_f", "vector_mask",
         "vector_mask_f", "lane", "whole", "given", "found",
         "b", "points", "splats", "near", "values", "slopes", "factors", "kept"}  # fmt: skip


def spelled(text: str, precision: Precision) -> str:
    """The text in a precision: T is the type, @ ends the names of functions, numbers end in %."""
    text = re.sub(r"\bT_", precision.type + " ", text).replace("@", precision.tag)
    return text.replace("%", precision.suffix).strip("\n")


def polynomial_name(table: str, precision: Precision) -> str:
    """The function of a table of coefficients."""
    return f"vector_polynomial_{table.lower()}{precision.tag}"


def polynomial_function(name: str, coefficients: Coefficients, precision: Precision) -> str:
    """A polynomial by Estrin's scheme: a chain of log n multiply-adds, where Horner's rule is one of n."""
    v = f"vector{precision.tag}"
    title, body = series_body(name, coefficients, precision, lambda texts: _estrin_body(texts, v))
    return f"/* {title} */\nINLINE {v} {polynomial_name(name, precision)}({v} x) {{\n{body}\n}}"


def _estrin_body(coefficients: list[str], vector: str) -> str:
    powers = [2**k for k in range(1, len(coefficients).bit_length()) if 2**k < len(coefficients)]
    names = ["x", *(f"x{power}" for power in powers)]
    squares = ", ".join(f"{new} = {old} * {old}" for old, new in itertools.pairwise(names))
    lines = [wrapped(f"const {vector} {squares};")] if squares else []
    return "\n".join([*lines, wrapped(f"return {_estrin(coefficients)};")])


def _estrin(coefficients: list[str]) -> str:
    """(c0 + c1 x) + x2 (c2 + c3 x) + x4 (...)."""
    if len(coefficients) == 1:
        return coefficients[0]
    half = 1 << ((len(coefficients) - 1).bit_length() - 1)
    low, high = _estrin(coefficients[:half]), _estrin(coefficients[half:])
    x = "x" if half == 1 else f"x{half}"
    return f"{low} + {x} * ({high})" if len(coefficients) - half > 1 else f"{low} + {x} * {high}"


def functions_of(routines: Iterable[Routine]) -> set[str]:
    """The functions of vectors that some routines call."""
    return {function_of(node)[0] for routine in routines for node in routine.nodes if node.op in FUNCTIONS}


def function_of(node: Node) -> tuple[str, Sequence[Node]]:
    """Which function of vectors computes a node, of what; that of e to minus half a sum of squares is simpler than exp."""
    if node.op == "exp" and (square := _negative_half(node.arguments[0])) is not None and never_negative(square):
        return "gaussian", (square,)
    return {"root": "sqrt"}.get(node.op, node.op), node.arguments


def reads(node: Node) -> Sequence[Node]:
    """What the function or the operation of a node reads."""
    return function_of(node)[1] if node.op in FUNCTIONS else node.arguments


def _negative_half(node: Node) -> Node | None:
    """s of -s / 2."""
    if node.op == "neg":
        node, half = node.arguments[0], sp.Rational(1, 2)
    else:
        half = sp.Rational(-1, 2)
    return node.arguments[1] if node.op == "mul" and node.arguments[0].value == half else None


class VectorPrinter(Printer):
    """Prints expressions of which some parts are vectors and others numbers."""

    def __init__(self, precision: Precision, names: dict[Node, str], series: Mapping[Coefficients, str]) -> None:
        tables = {k: polynomial_name(name, precision) for k, name in series.items()}
        super().__init__(spelling(precision), names, tables)
        self.tag = precision.tag
        self.vectors: set[Node] = set()

    def vector(self, node: Node, binding: int = 0) -> str:
        """The node as a vector, whatever it is."""
        return self.text(node, binding) if node in self.vectors else f"vector_of{self.tag}({self.text(node)})"

    def definition(self, node: Node) -> tuple[str, int]:
        """The expression of a node, and how tightly it binds."""
        a = node.arguments
        if node.op == "neg" and a[0] not in self.names and a[0].op == "mul" and a[0].arguments[0].is_constant:
            number, rest = a[0].arguments  # compilers do not move the sign into the number
            return f"-{self.number(number)[0]} * {self.text(rest, UNARY)}".replace("--", ""), PRODUCT
        if node.op == "polynomial":
            return f"{self.coefficients[node.value]}({self.vector(a[0])})", ATOM
        if node.op == "select":
            if a[0] in self.vectors:
                x, y = self.vector(a[1]), self.vector(a[2])
                return f"vector_select{self.tag}({self.text(a[0])}, {x}, {y})", ATOM
            x, y = (self.vector(x, SUM) for x in a[1:])
            return f"({self.text(a[0], SUM)} ? {x} : {y})", ATOM
        if node.op in CONDITIONS and node in self.vectors:
            # a number is the left side of no comparison: the compilers know the others
            sign = COMPARISONS[node.op]
            if a[0] not in self.vectors:
                return f"{self.vector(a[0])} {sign} {self.text(a[1], SUM)}", self.spelling.compare_binds
            return f"{self.text(a[0], SUM)} {sign} {self.text(a[1], SUM)}", self.spelling.compare_binds
        if node.op in FUNCTIONS:
            name, arguments = function_of(node)
            return f"{name}_each{self.tag}({', '.join(self.vector(x) for x in arguments)})", ATOM
        return super().definition(node)


class Body:
    """The statements of a routine on vectors, and its results as expressions."""

    def __init__(
        self, routine: Routine, inputs: Mapping[Node, str], vectors: set[Node], precision: Precision,
        series: Mapping[Coefficients, str],
    ) -> None:  # fmt: skip
        self.precision = precision
        self.taken = TAKEN | {p.name for p in routine.parameters} | {r.name for r in routine.results}
        self.printer = VectorPrinter(precision, {}, series)
        self.printer.vectors = self._depends(routine, vectors)
        read = {node for node in routine.nodes if node.op == "input"}
        self.inputs = {node: text for node, text in inputs.items() if node in read}
        needed: dict[Node, None] = {}
        for root in (node for result in routine.results for node in result.nodes):
            for node in arguments_first(root, reads, needed):
                needed[node] = None
        self.named = [(name, node) for name, node in routine.body if node in needed]
        for name, node in (*((str(node.value), node) for node in self.inputs), *self.named):
            self.printer.names[node] = self._fresh(name)

    def lines(self) -> list[str]:
        """All statements."""
        return self.statements([node for _, node in self.named], self.inputs)

    def steps(self, results: Sequence[Node]) -> list[Step]:
        """The statements in steps."""
        return steps([node for _, node in self.named], results, reads, self.printer.vectors)

    def statements(self, nodes: Iterable[Node], inputs: Iterable[Node]) -> list[str]:
        """Some of the statements, after those that load what they read."""
        lines = [f"const {self.kind(node)} {self.printer.names[node]} = {self.inputs[node]};" for node in inputs]
        for node in nodes:
            lines += self._statement(node)
        return lines

    def read_by(self, nodes: Iterable[Node], results: Iterable[Node]) -> list[Node]:
        """The inputs that some statements read, and some results."""
        roots = [*(argument for node in nodes for argument in reads(node)), *results]
        found = set(expression(roots, reads, self.printer.names))
        return [node for node in self.inputs if node in found]

    def result(self, node: Node) -> str:
        """A result as a vector."""
        return self.printer.vector(node)

    def sum_of(self, terms: Sequence[tuple[int, tuple[Node, ...]]]) -> str:
        """The terms of a sum that follow another."""
        texts = ((sign, " * ".join(self.printer.text(f, UNARY) for f in factors)) for sign, factors in terms)
        return "".join(f" {'+' if sign > 0 else '-'} {text}" for sign, text in texts)

    def _depends(self, routine: Routine, vectors: set[Node]) -> set[Node]:
        found = set(vectors)
        for node in routine.nodes:
            # there are functions of vectors only; the matrix of numbers stays one
            is_function = node.op in (*FUNCTIONS, "polynomial", "select")
            if is_function or any(a in found for a in node.arguments):
                found.add(node)
        return found

    def kind(self, node: Node) -> str:
        """The type of a node."""
        if node not in self.printer.vectors:
            return "int" if node.op in CONDITIONS else self.precision.type
        return f"vector_mask{self.precision.tag}" if node.op in CONDITIONS else f"vector{self.precision.tag}"

    def _statement(self, node: Node) -> list[str]:
        name = self.printer.names[node]
        if node.op in SEVERAL:
            return self._matrix(name, node).splitlines()
        text = f"const {self.kind(node)} {name} = {self.printer.definition(node)[0]};"
        folded = textwrap.fill(
            text, WIDTH - 4, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False
        )
        return [folded]

    def _matrix(self, name: str, node: Node) -> str:
        """A function of a matrix, one lane after another."""
        texts = [self.printer.text(a) for a in node.arguments]
        if node not in self.printer.vectors:
            return c_matrix.call(name, node, texts, self.precision)
        t, v = self.precision.type, f"vector{self.precision.tag}"
        n = node.rows
        size = n + n * n if node.op == "eigh" else len(node.arguments[0].arguments)
        lines = [f"{v} {name}[{size}];"]
        numbers = list(node.arguments if node.op == "eigh" else node.arguments[1:])
        given = ", ".join(self.printer.vector(a) for a in numbers)
        inner = []
        call = [f"given[{i}]" for i in range(len(numbers))]
        if numbers:
            inner.append(f"const {v} given_lanes[{len(numbers)}] = {{{given}}};")
        loop = [f"{t} given[{len(numbers)}];"] if numbers else []
        if numbers:
            loop.append(f"for (int i = 0; i < {len(numbers)}; ++i) given[i] = LANE(given_lanes[i], lane);")
        if node.op != "eigh":
            eigh = texts[0]
            if node.arguments[0] in self.printer.vectors:
                loop.append(f"{t} whole[{n + n * n}];")
                loop.append(f"for (int i = 0; i < {n + n * n}; ++i) whole[i] = LANE({eigh}[i], lane);")
                eigh = "whole"
            call = [eigh, *call]
        loop += c_matrix.call("found", node, call, self.precision).splitlines()
        loop.append(f"for (int i = 0; i < {size}; ++i) LANE({name}[i], lane) = found[i];")
        inner.append(f"for (size_t lane = 0; lane < LANES{self.precision.tag}; ++lane) {{")
        inner += ["    " + line for line in loop]
        inner.append("}")
        return "\n".join([*lines, "{", *("    " + line for line in inner), "}"])

    def _fresh(self, hint: str) -> str:
        name, count = hint, 1
        while name in self.taken or name.startswith("vector_") or "_each" in name:
            count += 1
            name = f"its_{hint}" if count == 2 else f"its_{hint}_{count}"
        self.taken.add(name)
        return name


def indented(lines: Sequence[str], width: int) -> str:
    """Lines as an indented block."""
    return textwrap.indent("\n".join(lines), " " * width)
