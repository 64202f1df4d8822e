/* The arithmetic of a training step around the sum of splats: what `InTorch` in arithmetic.py does, in one pass each.
 *
 * Compiled for REAL (float or double), DIM = d and TANGENT = T. N points and K splats are rows: x (N, D), W (K, d, T).
 * What the optimiser moves are columns, so that its loops run over splats: numbers (1 + d^2, C), first and second
 * (1 + d^2 + d + 1, C), gradient (1 + d^2 + d, K), with C the capacity.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <tgmath.h>

#define EPS ((REAL)(sizeof(REAL) == sizeof(float) ? FLT_EPSILON : DBL_EPSILON))
#define NUMBERS (1 + DIM * DIM)
#define SUMS 8 /* partial sums, which run side by side */

static inline REAL larger(REAL a, REAL b) { /* NaN where a is NaN */
    return a < b ? b : a;
}

/* s: free in the open, obstacle inside, from the distances (m, N) to the centres of m balls. */
void slowness(size_t count, size_t balls, const REAL *restrict distances, const REAL *restrict radii, double free,
              double obstacle, double width, REAL *restrict s) {
    const REAL outside = (REAL)free, rise = (REAL)(obstacle - free), per_width = (REAL)(1 / width);
    for (size_t n = 0; n < count; ++n) s[n] = (REAL)INFINITY;
    for (size_t m = 0; m < balls; ++m) {
        const REAL *restrict distance = distances + m * count;
        const REAL radius = radii[m];
        for (size_t n = 0; n < count; ++n) {
            const REAL outside_by = distance[n] - radius;
            s[n] = outside_by < s[n] || outside_by != outside_by ? outside_by : s[n]; /* NaN is to be seen */
        }
    }
    for (size_t n = 0; n < count; ++n) s[n] = outside + rise / (1 + exp(s[n] * per_width));
}

/* Points nearer than `least` are left out, the others stay in their order: how many of each part of `count` points. */
void far_points(size_t parts, size_t count, size_t size, double least, const REAL *restrict distance,
                const REAL *restrict x, const REAL *restrict base, const REAL *restrict away, const REAL *restrict s,
                REAL *restrict far_x, REAL *restrict far_base, REAL *restrict far_away, REAL *restrict far_s,
                size_t *restrict counts) {
    size_t kept = 0;
    for (size_t part = 0; part < parts; ++part) {
        const size_t before = kept, end = (part + 1) * count;
        for (size_t n = part * count, next; n < end; n = next + 1) { /* a run of far points, and a near one behind it */
            for (next = n; next < end && distance[next] > (REAL)least; ++next);
            const size_t run = next - n;
            memcpy(far_x + kept * size, x + n * size, run * size * sizeof(REAL));
            memcpy(far_base + kept, base + n, run * sizeof(REAL));
            memcpy(far_away + kept * TANGENT, away + n * TANGENT, run * TANGENT * sizeof(REAL));
            memcpy(far_s + kept, s + n, run * sizeof(REAL));
            kept += run;
        }
        counts[part] = kept - before;
    }
}

/* B = A^-1; det A. By cofactors up to d = 3, else by elimination with pivots. */
static inline REAL invert(const REAL A[DIM][DIM], REAL B[DIM][DIM]) {
#if DIM == 1
    B[0][0] = 1 / A[0][0];
    return A[0][0];
#elif DIM == 2
    const REAL det = A[0][0] * A[1][1] - A[0][1] * A[1][0], r = 1 / det;
    B[0][0] = A[1][1] * r, B[0][1] = -A[0][1] * r;
    B[1][0] = -A[1][0] * r, B[1][1] = A[0][0] * r;
    return det;
#elif DIM == 3
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int k = (j + 1) % 3, l = (j + 2) % 3, m = (i + 1) % 3, n = (i + 2) % 3;
            B[i][j] = A[k][m] * A[l][n] - A[k][n] * A[l][m];
        }
    const REAL det = A[0][0] * B[0][0] + A[0][1] * B[1][0] + A[0][2] * B[2][0], r = 1 / det;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) B[i][j] *= r;
    return det;
#else
    REAL left[DIM][DIM], det = 1;
    memcpy(left, A, sizeof left);
    memset(B, 0, sizeof left);
    for (int i = 0; i < DIM; ++i) B[i][i] = 1;
    for (int c = 0; c < DIM; ++c) {
        int p = c;
        for (int i = c + 1; i < DIM; ++i)
            if (fabs(left[i][c]) > fabs(left[p][c])) p = i;
        for (int j = 0; j < DIM && p != c; ++j) {
            const REAL a = left[c][j], b = B[c][j];
            left[c][j] = left[p][j], left[p][j] = a;
            B[c][j] = B[p][j], B[p][j] = b;
        }
        const REAL pivot = left[c][c], r = 1 / pivot;
        det *= p == c ? pivot : -pivot;
        for (int j = 0; j < DIM; ++j) left[c][j] *= r, B[c][j] *= r;
        for (int i = 0; i < DIM; ++i) {
            const REAL factor = left[i][c];
            for (int j = 0; j < DIM && i != c; ++j) {
                left[i][j] -= factor * left[c][j];
                B[i][j] -= factor * B[c][j];
            }
        }
    }
    return det;
#endif
}

static inline void read_shape(const REAL *numbers, size_t capacity, size_t k, REAL A[DIM][DIM]) {
    for (size_t i = 0; i < DIM; ++i)
        for (size_t j = 0; j < DIM; ++j) A[i][j] = numbers[(1 + i * DIM + j) * capacity + k];
}

/* W = B F and amplitude = v per_weight, with B = A^-1 and per_weight = constant |det B|. */
void map_splats(size_t count, size_t capacity, double constant, const REAL *restrict numbers,
                const REAL (*restrict F)[DIM][TANGENT], REAL (*restrict B)[DIM][DIM], REAL (*restrict W)[DIM][TANGENT],
                REAL *restrict per_weight, REAL *restrict amplitude) {
    for (size_t k = 0; k < count; ++k) {
        REAL A[DIM][DIM];
        read_shape(numbers, capacity, k, A);
        per_weight[k] = (REAL)constant / fabs(invert(A, B[k]));
        amplitude[k] = numbers[k] * per_weight[k];
        for (int i = 0; i < DIM; ++i)
            for (int t = 0; t < TANGENT; ++t) {
                REAL sum = 0;
                for (int j = 0; j < DIM; ++j) sum += B[k][i][j] * F[k][j][t];
                W[k][i][t] = sum;
            }
    }
}

/* The columns of v, A and the centre from W_bar, amplitude_bar and the gradient (K, T) in the centre:
 * A_bar = -B^T (W_bar W^T + amplitude amplitude_bar I), because dB = -B dA B and d log |det B| = -tr(B dA). */
void map_splats_adjoint(size_t count, const REAL (*restrict F)[DIM][TANGENT], const REAL (*restrict B)[DIM][DIM],
                        const REAL (*restrict W)[DIM][TANGENT], const REAL *restrict per_weight,
                        const REAL *restrict amplitude, const REAL (*restrict gradient)[TANGENT],
                        const REAL (*restrict W_bar)[DIM][TANGENT], const REAL *restrict amplitude_bar,
                        REAL *restrict columns) {
    for (size_t k = 0; k < count; ++k) {
        REAL S[DIM][DIM];
        for (int i = 0; i < DIM; ++i)
            for (int j = 0; j < DIM; ++j) {
                S[i][j] = i == j ? amplitude[k] * amplitude_bar[k] : 0;
                for (int t = 0; t < TANGENT; ++t) S[i][j] += W_bar[k][i][t] * W[k][j][t];
            }
        columns[k] = amplitude_bar[k] * per_weight[k];
        for (size_t i = 0; i < DIM; ++i)
            for (size_t j = 0; j < DIM; ++j) {
                REAL sum = 0;
                for (int l = 0; l < DIM; ++l) sum -= B[k][l][i] * S[l][j];
                columns[(1 + i * DIM + j) * count + k] = sum;
            }
        for (size_t i = 0; i < DIM; ++i) {
            REAL sum = 0;
            for (int t = 0; t < TANGENT; ++t) sum += F[k][i][t] * gradient[k][t];
            columns[(NUMBERS + i) * count + k] = sum;
        }
    }
}

/* grad T = dT/dd away + dT/df df, and the partial derivatives of T (4, N): dT/dd, dT/df, d^2T/dd df, d^2T/df^2.
 * T = d / (floor + (1 - floor) sigmoid(f + offset)), or T = d exp(f) where not `quotient`. */
void arrival_gradient(size_t count, int quotient, double offset, double floor, const REAL *restrict d,
                      const REAL (*restrict away)[TANGENT], const REAL *restrict f, const REAL (*restrict df)[TANGENT],
                      REAL *restrict partials, REAL (*restrict gradient)[TANGENT]) {
    REAL *restrict by_d = partials, *restrict by_f = partials + count;
    REAL *restrict by_df = partials + 2 * count, *restrict by_ff = partials + 3 * count;
    const REAL least = (REAL)floor, shift = (REAL)offset, sign = quotient ? -1 : 1;
    for (size_t n = 0; n < count; ++n) by_d[n] = exp(sign * f[n] + sign * shift);
    for (size_t n = 0; n < count; ++n) {
        const REAL sigmoid = 1 / (1 + by_d[n]), tau = least + (1 - least) * sigmoid, per_tau = 1 / tau;
        const REAL relative = (tau - least) * (1 - sigmoid) * per_tau; /* (d tau / df) / tau */
        by_d[n] = quotient ? per_tau : by_d[n];
        by_df[n] = quotient ? -relative * per_tau : by_d[n];
        by_f[n] = d[n] * by_df[n];
        by_ff[n] = quotient ? by_f[n] * (1 - 2 * (sigmoid + relative)) : by_f[n];
    }
    for (size_t n = 0; n < count; ++n)
        for (int t = 0; t < TANGENT; ++t) gradient[n][t] = by_d[n] * away[n][t] + by_f[n] * df[n][t];
}

/* The residual of each point, the derivatives of their mean in f and df, and that mean. `least` is the smallest ratio
 * of slope and slowness with a slope of its own. */
double eikonal(size_t count, int squared, double least, const REAL (*restrict gradient)[TANGENT],
               const REAL (*restrict covector)[TANGENT], const REAL *restrict partials,
               const REAL (*restrict away)[TANGENT], const REAL (*restrict df)[TANGENT], const REAL *restrict s,
               REAL *restrict residual, REAL *restrict f_bar, REAL (*restrict df_bar)[TANGENT]) {
    const REAL *restrict by_f = partials + count;
    const REAL *restrict by_df = partials + 2 * count, *restrict by_ff = partials + 3 * count;
    const REAL smallest = (REAL)least, share = 1 / (REAL)count;
    for (size_t n = 0; n < count; ++n) {
        REAL square = 0;
        for (int t = 0; t < TANGENT; ++t) square += covector[n][t] * gradient[n][t];
        const REAL slope = sqrt(larger(square, 0)), q = slope / s[n];
        const REAL root = sqrt(larger(q, smallest)), inverse = 1 / root;
        /* Both terms of the ratio's residual have one sign: |1 - r| + |1 - 1 / r| = |r - 1 / r|. */
        const REAL difference = squared ? slope - s[n] : root - inverse;
        const REAL sign = difference > 0 ? 1 : difference < 0 ? -1 : 0;
        const REAL by_ratio = q > smallest ? sign * (1 + inverse * inverse) * inverse / (2 * s[n]) : 0;
        residual[n] = squared ? difference * difference : fabs(difference);
        const REAL factor = (squared ? 2 * difference : by_ratio) * share / larger(slope, (REAL)1e-30);
        REAL sum = 0;
        for (int t = 0; t < TANGENT; ++t) {
            const REAL by_gradient = factor * covector[n][t];
            sum += by_gradient * (by_df[n] * away[n][t] + by_ff[n] * df[n][t]);
            df_bar[n][t] = by_f[n] * by_gradient;
        }
        f_bar[n] = sum;
    }
    double sums[SUMS] = {0}, total = 0;
    for (size_t n = 0; n < count; ++n) sums[n % SUMS] += residual[n];
    for (int i = 0; i < SUMS; ++i) total += sums[i];
    return total / (double)count;
}

/* One step of AdamW along the gradient, which is made not longer than `clip`: v and A move, the steps (d, K) of the
 * centres are returned. The last rows of the moments are those of a gradient that is always 1. Returns the gradient's
 * length; nothing moves where that is not finite. */
double adam(size_t count, size_t capacity, double clip, double learning_rate, double decay, double beta1, double beta2,
            double epsilon, const REAL *restrict gradient, REAL *restrict first, REAL *restrict second,
            REAL *restrict numbers, REAL *restrict steps) {
    double sums[SUMS] = {0}, square = 0;
    for (size_t n = 0; n < (NUMBERS + DIM) * count; ++n) sums[n % SUMS] += (double)gradient[n] * gradient[n];
    for (int i = 0; i < SUMS; ++i) square += sums[i];
    const double length = sqrt(square);
    if (!isfinite(length)) return length;
    const REAL scale = (REAL)(length > clip ? clip / length : 1);
    const REAL b1 = (REAL)(1 - beta1), b2 = (REAL)beta2, c2 = (REAL)(1 - beta2), tiny = (REAL)epsilon;
    const REAL rate = (REAL)learning_rate, keep = (REAL)(1 - learning_rate * decay);
    REAL *restrict first_one = first + (NUMBERS + DIM) * capacity;
    REAL *restrict second_one = second + (NUMBERS + DIM) * capacity;
    for (size_t k = 0; k < count; ++k) {
        first_one[k] += b1 * (1 - first_one[k]);
        second_one[k] = b2 * second_one[k] + c2;
    }
    for (size_t row = 0; row < NUMBERS + DIM; ++row) {
        const REAL *restrict g = gradient + row * count;
        REAL *restrict m = first + row * capacity, *restrict s = second + row * capacity;
        REAL *restrict moved = row < NUMBERS ? numbers + row * capacity : steps + (row - NUMBERS) * count;
        for (size_t k = 0; k < count && row >= NUMBERS; ++k) moved[k] = 0;
        for (size_t k = 0; k < count; ++k) {
            const REAL clipped = g[k] * scale;
            m[k] += b1 * (clipped - m[k]);
            s[k] = b2 * s[k] + c2 * clipped * clipped;
            const REAL move = m[k] / first_one[k] / (sqrt(s[k] / second_one[k]) + tiny);
            moved[k] = keep * moved[k] - rate * move;
        }
    }
    return length;
}

/* Tangent vectors (K, T) from components (d, K) in the frames. */
void tangents(size_t count, const REAL *restrict steps, const REAL (*restrict E)[DIM][TANGENT],
              REAL (*restrict moves)[TANGENT]) {
    for (size_t k = 0; k < count; ++k)
        for (int t = 0; t < TANGENT; ++t) {
            REAL sum = 0;
            for (size_t i = 0; i < DIM; ++i) sum += steps[i * count + k] * E[k][i][t];
            moves[k][t] = sum;
        }
}

/* Gram-Schmidt on frames E with the covectors F. */
void orthonormalise(size_t count, const REAL (*restrict E)[DIM][TANGENT], const REAL (*restrict F)[DIM][TANGENT],
                    REAL (*restrict orthonormal)[DIM][TANGENT]) {
    for (size_t k = 0; k < count; ++k) {
        REAL e[DIM][TANGENT], covector[DIM][TANGENT];
        memcpy(e, E[k], sizeof e);
        memcpy(covector, F[k], sizeof e);
        for (int i = 0; i < DIM; ++i) {
            for (int j = 0; j < i; ++j) {
                REAL dot = 0;
                for (int t = 0; t < TANGENT; ++t) dot += covector[j][t] * e[i][t];
                for (int t = 0; t < TANGENT; ++t) e[i][t] -= dot * e[j][t], covector[i][t] -= dot * covector[j][t];
            }
            REAL square = 0;
            for (int t = 0; t < TANGENT; ++t) square += covector[i][t] * e[i][t];
            const REAL scale = 1 / sqrt(square);
            for (int t = 0; t < TANGENT; ++t) e[i][t] *= scale, covector[i][t] *= scale;
        }
        memcpy(orthonormal[k], e, sizeof e);
    }
}

/* U = A V with orthogonal columns, by Jacobi's rotations of pairs of columns (Hestenes); A becomes U. */
static void rotate_columns(REAL A[DIM][DIM], REAL V[DIM][DIM]) {
    for (int i = 0; i < DIM; ++i)
        for (int j = 0; j < DIM; ++j) V[i][j] = i == j;
    int rotated = 1;
    for (int sweep = 0; sweep < 30 && rotated; ++sweep) {
        rotated = 0;
        for (int i = 0; i < DIM; ++i)
            for (int j = i + 1; j < DIM; ++j) {
                REAL a = 0, b = 0, c = 0;
                for (int r = 0; r < DIM; ++r) a += A[r][i] * A[r][i], b += A[r][j] * A[r][j], c += A[r][i] * A[r][j];
                if (!(fabs(c) > EPS * sqrt(a) * sqrt(b))) continue;
                const REAL zeta = (b - a) / (2 * c);
                const REAL tangent = (zeta < 0 ? -1 : 1) / (fabs(zeta) + sqrt(1 + zeta * zeta));
                const REAL cosine = 1 / sqrt(1 + tangent * tangent), sine = cosine * tangent;
                for (int r = 0; r < DIM; ++r) {
                    const REAL x = A[r][i], y = A[r][j], v = V[r][i], w = V[r][j];
                    A[r][i] = cosine * x - sine * y, A[r][j] = sine * x + cosine * y;
                    V[r][i] = cosine * v - sine * w, V[r][j] = sine * v + cosine * w;
                }
                rotated = 1;
            }
    }
}

/* A unit vector q orthogonal to `known` rows of Q, along q if that leaves more than rounding, else any. */
static void complete(REAL Q[DIM][DIM], int known, REAL noise) {
    REAL *q = Q[known];
    for (int axis = -1; axis < DIM; ++axis) {
        for (int r = 0; r < DIM && axis >= 0; ++r) q[r] = r == axis;
        for (int repeat = 0; repeat < 2; ++repeat)
            for (int i = 0; i < known; ++i) {
                REAL dot = 0;
                for (int r = 0; r < DIM; ++r) dot += q[r] * Q[i][r];
                for (int r = 0; r < DIM; ++r) q[r] -= dot * Q[i][r];
            }
        REAL square = 0;
        for (int r = 0; r < DIM; ++r) square += q[r] * q[r];
        const REAL size = sqrt(square);
        if (!(size > (axis < 0 ? noise : (REAL)0.5 / DIM))) continue;
        for (int r = 0; r < DIM; ++r) q[r] /= size;
        return;
    }
}

/* The singular values of A below `least` raised to it; whether there were any. */
static int raise_singular(REAL A[DIM][DIM], REAL least) {
    REAL V[DIM][DIM], U[DIM][DIM], Q[DIM][DIM], size[DIM];
    int order[DIM];
    memcpy(U, A, sizeof U);
    rotate_columns(U, V);
    for (int j = 0; j < DIM; ++j) {
        REAL square = 0;
        for (int r = 0; r < DIM; ++r) square += U[r][j] * U[r][j];
        size[j] = sqrt(square);
        int place = j;
        for (; place > 0 && size[order[place - 1]] < size[j]; --place) order[place] = order[place - 1];
        order[place] = j;
    }
    if (size[order[DIM - 1]] >= least) return 0;
    memset(A, 0, sizeof U);
    for (int n = 0; n < DIM; ++n) { /* the longest first: from it the directions of the shorter ones are known */
        const int j = order[n];
        for (int r = 0; r < DIM; ++r) Q[n][r] = U[r][j];
        complete(Q, n, DIM * EPS * size[order[0]]);
        for (int r = 0; r < DIM; ++r)
            for (int c = 0; c < DIM; ++c) A[r][c] += larger(size[j], least) * Q[n][r] * V[c][j];
    }
    return 1;
}

/* Every singular value of A below `least` raised to it. The smallest is at least 1 / |A^-1|_F: most splats need no
 * decomposition. Where det A is as small as its own rounding, that inverse says nothing. */
void clamp_shapes(size_t count, size_t capacity, double least, REAL *restrict numbers) {
    for (size_t k = 0; k < count; ++k) {
        REAL A[DIM][DIM], B[DIM][DIM], square = 0, square_of_inverse = 0, noise = 16 * EPS;
        read_shape(numbers, capacity, k, A);
        const REAL det = invert(A, B);
        for (int i = 0; i < DIM; ++i)
            for (int j = 0; j < DIM; ++j) square += A[i][j] * A[i][j], square_of_inverse += B[i][j] * B[i][j];
        for (int i = 0; i < DIM; ++i) noise *= sqrt(square);
        if (square_of_inverse * (REAL)(least * least) <= 1 && fabs(det) > noise) continue;
        if (!raise_singular(A, (REAL)least)) continue;
        for (size_t i = 0; i < DIM; ++i)
            for (size_t j = 0; j < DIM; ++j) numbers[(1 + i * DIM + j) * capacity + k] = A[i][j];
    }
}
