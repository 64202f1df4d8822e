"""The loops over points and splats in generated C, as templates.

$name stands for a part that differs between manifolds: $nx, $nX, $nG, $nB numbers of a point (x, its features X, its
gradient, all that backward reads), $nmu, $nW, $nS, $nP of a splat (mu, W, its constants S, all its parameters), $nU the
sums over the points for a splat, $nF the factors of a pair. T_ is the type of numbers, @ ends the names of a precision.
"""

# Far splats are denormal numbers, on which processors are ten times slower; here they are zero.
FLUSH = """/* Denormal numbers count as zero while the sums run: far splats are many, and slow. */
#if defined(__SSE2__)
#include <xmmintrin.h>
INLINE uint64_t flush_denormals(void) {
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040u);
    return mode;
}
INLINE void restore_denormals(uint64_t mode) { _mm_setcsr((unsigned)mode); }
#elif defined(__aarch64__) && defined(__GNUC__)
INLINE uint64_t flush_denormals(void) {
    uint64_t mode;
    __asm__ __volatile__("mrs %0, fpcr" : "=r"(mode));
    __asm__ __volatile__("msr fpcr, %0" : : "r"(mode | (UINT64_C(1) << 24)));
    return mode;
}
INLINE void restore_denormals(uint64_t mode) { __asm__ __volatile__("msr fpcr, %0" : : "r"(mode)); }
#else
INLINE uint64_t flush_denormals(void) { return 0; }
INLINE void restore_denormals(uint64_t mode) { (void)mode; }
#endif"""

OMP = """/* Threads, where the compiler has OpenMP. */
#if defined(_OPENMP)
#define OMP(directive) _Pragma(#directive)
#else
#define OMP(directive)
#endif"""

ROWS = """
/* The numbers of LANES rows from `start` on, transposed; past the end, the last row again. */
OUTLINE void vector_rows@(const T_*rows, size_t count, size_t start, size_t size, vector@ *columns) {
    for (size_t i = 0; i < size; ++i) {
        T_column[LANES@];
        for (size_t lane = 0; lane < LANES@; ++lane)
            column[lane] = rows[size * (start + lane < count ? start + lane : count - 1) + i];
        columns[i] = vector_load@(column);
    }
}

/* Back to rows that are `stride` apart; nothing past the end. */
OUTLINE void vector_to_rows@(
    const vector@ *columns, T_*rows, size_t count, size_t start, size_t size, size_t stride) {
    const size_t lanes = start >= count ? 0 : count - start < LANES@ ? count - start : LANES@;
    for (size_t lane = 0; lane < lanes; ++lane)
        for (size_t i = 0; i < size; ++i) rows[stride * (start + lane) + i] = LANE(columns[i], lane);
}

/* Zero in the lanes past the end. */
OUTLINE void vector_end@(size_t count, size_t start, size_t size, vector@ *columns) {
    for (size_t lane = start >= count ? 0 : count - start; lane < LANES@; ++lane)
        for (size_t i = 0; i < size; ++i) LANE(columns[i], lane) = 0;
}"""

WORK = """
/* Scratch memory: $nB vectors for LANES points, where splats and blocks of points are, the constants of the splats. */
$SIGNATURE_splats_work$ {
    (void)threads;
    const size_t points = (count + LANES@ - 1) / LANES@, blocks = (points + $BLOCK - 1) / $BLOCK;
    const size_t places = $nNEAR * ((splat_count + LANES@ - 1) / LANES@ + (blocks + LANES@ - 1) / LANES@);
    return (points * $nB + places + 1) * LANES@ + $nS * splat_count;
}

static vector@ *work_points@(T_*work) {
    const uintptr_t size = sizeof(vector@), start = (uintptr_t)work;
    return (vector@ *)((char *)work + ((0 - start) & (size - 1)));
}

/* Where a splat is: numbers that are LANES apart. */
INLINE const T_*splat_at@(const vector@ *splats, size_t k) {
    const size_t row = k / LANES@;
    return (const T_*)(splats + $nNEAR * row) + (k - row * LANES@);
}

static vector@ *work_reaches@(T_*work, size_t count) {
    return work_points@(work) + (count + LANES@ - 1) / LANES@ * $nB;
}

static vector@ *work_blocks@(T_*work, size_t count, size_t splat_count) {
    return work_reaches@(work, count) + $nNEAR * ((splat_count + LANES@ - 1) / LANES@);
}

static T_*work_constants@(T_*work, size_t count, size_t splat_count) {
    const size_t size = $BLOCK * LANES@, blocks = (count + size - 1) / size;
    return (T_*)(work_blocks@(work, count, splat_count) + $nNEAR * ((blocks + LANES@ - 1) / LANES@));
}"""

CONSTANTS = """
/* The constants of LANES splats, as rows; with `width`, how far they reach. */
OUTLINE void splat_constants@(
    size_t splat_count, size_t start, const T_*mu, const T_*W, const T_*amplitude, const T_*width, T_*constants,
    vector@ *splats) {
    vector@ own_mu[$nmu], own_W[$nW], own_amplitude[1], S[$nS];
    vector_rows@(mu, splat_count, start, $nmu, own_mu);
    vector_rows@(W, splat_count, start, $nW, own_W);
    vector_rows@(amplitude, splat_count, start, 1, own_amplitude);
    if (width) splat_reach@(own_mu, own_amplitude, width, splat_count, start, splats);
    pair_constants@(own_mu, own_W, own_amplitude, S);
    vector_to_rows@(S, constants, splat_count, start, $nS, $nS);
}"""

FORWARD = """
/* $BLOCK vectors of points at a time while all splats pass, some at a time. */
$SIGNATURE_splats$ {
    (void)threads;
    T_*constants = work_constants@(work, 0, splat_count);
    vector@ *splats = work_reaches@(work, 0);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES@)
            splat_constants@(splat_count, start, mu, W, amplitude, width, constants, splats);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < count; start += $BLOCK * LANES@) {
            vector@ at[$BLOCK][$nx], X[$BLOCK * $nX], grad[$nG];
            vector@ value_sum[$BLOCK] = {ZERO}, slope_sum[$BLOCK * $nX] = {ZERO};
            T_place[$nx + 1];
            uint32_t near[$PART];
            for (size_t b = 0; b < $BLOCK; ++b) {
                vector_rows@(x, count, start + b * LANES@, $nx, at[b]);
                pair_features@(at[b], X + $nX * b);
            }
            if (width) block_place@(x, count, start, place);
            for (size_t first = 0; first < splat_count; first += $PART) {
                const size_t end = splat_count - first < $PART ? splat_count : first + $PART;
                const size_t size = splats_near@(width ? place : NULL, splats, first, end, near);
                for (size_t i = 0; i < size; i += $SPLATS) {
                    const size_t some = size - i < $SPLATS ? size - i : $SPLATS;
                    pair_forward@(some, X, constants, near + i, value_sum, slope_sum);
                }
            }
            for (size_t b = 0; b < $BLOCK; ++b) {
                pair_gradient@(at[b], slope_sum + $nX * b, grad);
                vector_to_rows@(value_sum + b, value, count, start + b * LANES@, 1, 1);
                vector_to_rows@(grad, gradient, count, start + b * LANES@, $nG, $nG);
            }
        }
        restore_denormals(mode);
    }
}"""

VALUE = """
$SIGNATURE_splats_value$ {
    (void)threads;
    T_*constants = work_constants@(work, 0, splat_count);
    vector@ *splats = work_reaches@(work, 0);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES@)
            splat_constants@(splat_count, start, mu, W, amplitude, width, constants, splats);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < count; start += $BLOCK * LANES@) {
            vector@ at[$nx], X[$BLOCK * $nX], value_sum[$BLOCK] = {ZERO};
            T_place[$nx + 1];
            uint32_t near[$PART];
            for (size_t b = 0; b < $BLOCK; ++b) {
                vector_rows@(x, count, start + b * LANES@, $nx, at);
                pair_features@(at, X + $nX * b);
            }
            if (width) block_place@(x, count, start, place);
            for (size_t first = 0; first < splat_count; first += $PART) {
                const size_t end = splat_count - first < $PART ? splat_count : first + $PART;
                const size_t size = splats_near@(width ? place : NULL, splats, first, end, near);
                for (size_t i = 0; i < size; i += $SPLATS) {
                    const size_t some = size - i < $SPLATS ? size - i : $SPLATS;
                    pair_value@(some, X, constants, near + i, value_sum);
                }
            }
            for (size_t b = 0; b < $BLOCK; ++b)
                vector_to_rows@(value_sum + b, value, count, start + b * LANES@, 1, 1);
        }
        restore_denormals(mode);
    }
}"""

POINTS = """
/* What backward reads of LANES points: X, value_bar, slope_bar; the adjoints past the end are zero. */
OUTLINE void splat_points@(
    size_t count, size_t start, const T_*x, const T_*value_bar, const T_*gradient_bar, vector@ *point) {
    vector@ at[$nx], grad_bar[$nG], slope_bar[$nX];
    vector_rows@(x, count, start, $nx, at);
    vector_rows@(gradient_bar, count, start, $nG, grad_bar);
    vector_rows@(value_bar, count, start, 1, point + $nX);
    pair_features@(at, point);
    pair_gradient_vjp@(at, grad_bar, slope_bar);
    for (int i = 0; i < $nX; ++i) point[$nX + 1 + i] = slope_bar[i];
    vector_end@(count, start, $nX + 1, point + $nX);
}"""

PRODUCTS = """
/* Adds what makes the derivatives, of a splat at some vectors of points: their factors, then the products of these. */
INLINE void pair_backward@(
    size_t count, const vector@ *points, const uint32_t *near, const T_*S, vector@ *sums) {
    vector@ factor[$PAIRS * $nF];
    pair_factors@(count, points, near, S, factor);
    $GROUPS$
}"""

SUMS = """
/* Adds to sums what some vectors of points add to them, those in the list. */
OUTLINE void splat_sums@(const vector@ *points, const uint32_t *near, size_t size, const T_*S, T_*sums) {
    vector@ sum[$nU] = {ZERO};
    for (size_t b = 0; b < size; b += $PAIRS)
        pair_backward@(size - b < $PAIRS ? size - b : $PAIRS, points, near + b, S, sum);
    $SUMS$
}"""

BACKWARD = """
/*
 * Some splats at a time; the points pass over each of them, a chunk at a time, while its sums stay in registers. How many
 * splats depends on the threads, what is summed in which order does not.
 */
$SIGNATURE_splats_vjp$ {
    const size_t blocks = (count + LANES@ - 1) / LANES@;
    const size_t chunk = $CHUNK / ($nB * sizeof(vector@)) + 1;
    const size_t rows = ((blocks + $BLOCK - 1) / $BLOCK + LANES@ - 1) / LANES@ * LANES@;
    const size_t part = splat_count / (4 * (size_t)(threads > 1 ? threads : 1)) + 1;
    const size_t share = part < LANES@ ? part : LANES@;
    vector@ *points = work_points@(work);
    vector@ *splats = work_reaches@(work, count), *places = work_blocks@(work, count, splat_count);
    T_*constants = work_constants@(work, count, splat_count);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic) nowait)
        for (size_t start = 0; start < splat_count; start += LANES@)
            splat_constants@(splat_count, start, mu, W, amplitude, width, constants, splats);
        if (width) {
            OMP(omp for schedule(dynamic, 8) nowait)
            for (size_t block = 0; block < rows; ++block) {
                T_place[$nx + 1];
                const size_t last = (blocks - 1) / $BLOCK, start = (block < last ? block : last) * $BLOCK;
                block_place@(x, count, start * LANES@, place);
                for (int i = 0; i < $nNEAR; ++i) {
                    T_*row = (T_*)(places + block / LANES@ * $nNEAR + i);
                    row[block - block / LANES@ * LANES@] = place[i];
                }
            }
        }
        OMP(omp for schedule(dynamic, 8))
        for (size_t block = 0; block < blocks; ++block)
            splat_points@(count, block * LANES@, x, value_bar, gradient_bar, points + $nB * block);
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += share) {
            const size_t end = start + share < splat_count ? start + share : splat_count;
            T_sums[LANES@][$nU] = {{0}};
            uint32_t near[$CHUNK / ($nB * sizeof(vector@)) + 2];
            vector@ own_mu[$nmu], own_W[$nW], own_amplitude[1], own_sums[$nU], bars[$nP];
            for (size_t first = 0; first < blocks; first += chunk) {
                const size_t size = first + chunk < blocks ? chunk : blocks - first;
                for (size_t k = start; k < end; ++k) {
                    const T_*reach = width ? splat_at@(splats, k) + $nmu * LANES@ : NULL;
                    const size_t some = blocks_near@(mu + $nmu * k, reach, places, first, first + size, near);
                    splat_sums@(points + $nB * first, near, some, constants + $nS * k, sums[k - start]);
                }
            }
            vector_rows@(mu, end, start, $nmu, own_mu);
            vector_rows@(W, end, start, $nW, own_W);
            vector_rows@(amplitude, end, start, 1, own_amplitude);
            vector_rows@(sums[0], LANES@, 0, $nU, own_sums);
            pair_constants_vjp@(own_mu, own_W, own_amplitude, own_sums, bars, bars + $nmu, bars + $nmu + $nW);
            vector_to_rows@(bars, mu_bar, end, start, $nmu, $nmu);
            vector_to_rows@(bars + $nmu, W_bar, end, start, $nW, $nW);
            vector_to_rows@(bars + $nmu + $nW, amplitude_bar, end, start, 1, 1);
        }
        restore_denormals(mode);
    }
}"""

ROWWISE = """
/* Nothing is summed: the adjoints of a splat's constants go on to its parameters for every point. */
$SIGNATURE_splats_rows$ {
    (void)threads;
    const size_t blocks = (count + LANES@ - 1) / LANES@;
    const uint32_t only = 0;
    T_*constants = work_constants@(work, 0, splat_count);
    OMP(omp parallel num_threads(threads) if(threads > 1))
    {
        const uint64_t mode = flush_denormals();
        OMP(omp for schedule(dynamic))
        for (size_t start = 0; start < splat_count; start += LANES@)
            splat_constants@(splat_count, start, mu, W, amplitude, NULL, constants, NULL);
        OMP(omp for schedule(dynamic))
        for (size_t block = 0; block < blocks; ++block) {
            vector@ point[$nB];
            splat_points@(count, block * LANES@, x, value_bar, gradient_bar, point);
            for (size_t k = 0; k < splat_count; ++k) {
                vector@ own_mu[$nmu], own_W[$nW], own_amplitude[1], own_sums[$nU] = {ZERO}, bars[$nP];
                for (int i = 0; i < $nmu; ++i) own_mu[i] = vector_of@(mu[$nmu * k + i]);
                for (int i = 0; i < $nW; ++i) own_W[i] = vector_of@(W[$nW * k + i]);
                own_amplitude[0] = vector_of@(amplitude[k]);
                pair_backward@(1, point, &only, constants + $nS * k, own_sums);
                pair_constants_vjp@(own_mu, own_W, own_amplitude, own_sums, bars, bars + $nmu, bars + $nmu + $nW);
                vector_to_rows@(bars, rows + $nP * k, count, block * LANES@, $nP, $nP * splat_count);
            }
        }
        restore_denormals(mode);
    }
}"""
