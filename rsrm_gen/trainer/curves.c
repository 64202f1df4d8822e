/* Curves on a manifold and what they cost: segments by quadrature, equal spacing, relaxation to least cost.
 *
 * Compiled for DIM = d, POINT = D and TANGENT = T. The manifold is the caller's: functions of rows, as its generated C
 * has them. A curve is a row of nodes; a segment between two of them is t -> Exp_p(t Log_p q), 0 <= t <= 1.
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK 64                          /* rows that are worked on together, on the stack */
#define NORMALS (DIM > 1 ? DIM - 1 : 1)   /* directions across a curve */
#define VARIANTS (NORMALS * (NORMALS + 1)) /* of a node: both ways along each direction and along each pair of them */
#define HALVINGS 6                        /* of a step that does not make the curve cheaper */
#define ROUGHLY 10                         /* times the tolerance do for all steps of differences but the last */
#define STEEP 0.2                         /* the part of a carried vector that must be across the curve */

typedef void (*rows)(size_t, const double *, const double *, double *);

struct geometry {
    rows exp, log, norm, distance;
    double (*inner)(const double *, const double *, const double *);
    void (*frame)(const double *, double *);
    int geodesic; /* whether Exp runs along geodesics at constant speed */
};

struct medium { /* s(x) = free + (obstacle - free) sigmoid(-min_i (d(x, c_i) - r_i) / width) */
    size_t balls;
    const double *centers; /* (m, BLOCK, D): each repeated */
    const double *radii;
    double free, obstacle, width;
};

struct settings {
    size_t iterations, resample_every;
    double tolerance; /* a decrease, relative to the cost, that is not worth another iteration */
    double reach;     /* the longest step of a node */
};

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

static void slowness(const struct geometry *g, const struct medium *m, size_t count, const double *x, double *s) {
    const double rise = m->obstacle - m->free, per_width = 1 / m->width;
    for (size_t at = 0; at < count; at += BLOCK) {
        const size_t n = smaller(BLOCK, count - at);
        double outside[BLOCK], d[BLOCK];
        for (size_t i = 0; i < n; ++i) outside[i] = INFINITY;
        for (size_t ball = 0; ball < m->balls; ++ball) {
            g->distance(n, x + at * POINT, m->centers + ball * BLOCK * POINT, d);
            for (size_t i = 0; i < n; ++i) {
                const double by = d[i] - m->radii[ball];
                outside[i] = by < outside[i] || by != by ? by : outside[i]; /* NaN is to be seen */
            }
        }
        for (size_t i = 0; i < n; ++i) s[at + i] = m->free + rise / (1 + exp(outside[i] * per_width));
    }
}

/* At most BLOCK segments: v = Log_p q, the middles Exp_p(v / 2) and the lengths. Where Exp is no geodesic, a length is
 * |Log_m q - Log_m p| at the middle m, wrong by the third order of it. */
static void halves(const struct geometry *g, size_t n, const double *p, const double *q, double *v, double *middle,
                   double *length) {
    double a[BLOCK * TANGENT], b[BLOCK * TANGENT];
    g->log(n, p, q, v);
    for (size_t i = 0; i < n * TANGENT; ++i) a[i] = v[i] / 2;
    g->exp(n, p, a, middle);
    if (g->geodesic) {
        g->norm(n, p, v, length);
        return;
    }
    g->log(n, middle, q, a);
    g->log(n, middle, p, b);
    for (size_t i = 0; i < n * TANGENT; ++i) a[i] -= b[i];
    g->norm(n, middle, a, length);
}

/* The costs of segments by Simpson's rule, from the slowness at both ends. */
static void simpson(const struct geometry *g, const struct medium *m, size_t count, const double *p, const double *q,
                    const double *at_p, const double *at_q, double *cost) {
    for (size_t at = 0; at < count; at += BLOCK) {
        const size_t n = smaller(BLOCK, count - at);
        double v[BLOCK * TANGENT], middle[BLOCK * POINT], length[BLOCK], s[BLOCK];
        halves(g, n, p + at * POINT, q + at * POINT, v, middle, length);
        slowness(g, m, n, middle, s);
        for (size_t i = 0; i < n; ++i) cost[at + i] = length[i] * (at_p[at + i] + 4 * s[i] + at_q[at + i]) / 6;
    }
}

/* The speed of t -> Exp_p(t v) at x = Exp_p(t v), for at most BLOCK segments: a difference over 2e-3 of the segment. */
static void speeds(const struct geometry *g, size_t n, const double *p, const double *v, double t, const double *x,
                   double *speed) {
    const double step = 1e-3;
    double w[BLOCK * TANGENT], to[BLOCK * POINT], ahead[BLOCK * TANGENT], behind[BLOCK * TANGENT];
    if (g->geodesic) {
        g->norm(n, p, v, speed);
        return;
    }
    for (size_t i = 0; i < n * TANGENT; ++i) w[i] = (t + step) * v[i];
    g->exp(n, p, w, to);
    g->log(n, x, to, ahead);
    for (size_t i = 0; i < n * TANGENT; ++i) w[i] = (t - step) * v[i];
    g->exp(n, p, w, to);
    g->log(n, x, to, behind);
    for (size_t i = 0; i < n * TANGENT; ++i) ahead[i] = (ahead[i] - behind[i]) / (2 * step);
    g->norm(n, x, ahead, speed);
}

/* Costs and lengths of segments p -> q by Gauss's rule of `order` points, (node, weight) on [0, 1], on panels that are
 * not longer than `panel`. */
void segments(size_t count, const double *p, const double *q, const struct geometry *g, const struct medium *m,
              size_t order, const double *node, const double *weight, double panel, int threads, double *cost,
              double *length) {
    (void)threads;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (size_t at = 0; at < count; at += BLOCK) {
        const size_t n = smaller(BLOCK, count - at);
        const double *from = p + at * POINT;
        double v[BLOCK * TANGENT], w[BLOCK * TANGENT], x[BLOCK * POINT], speed[BLOCK], s[BLOCK], longest = 0;
        g->log(n, from, q + at * POINT, v);
        g->norm(n, from, v, speed);
        for (size_t i = 0; i < n; ++i) {
            longest = speed[i] > longest ? speed[i] : longest;
            cost[at + i] = length[at + i] = 0;
        }
        const double wanted = ceil(longest / panel);
        const size_t panels = wanted >= 1 && wanted < 1e4 ? (size_t)wanted : 1;
        for (size_t k = 0; k < panels * order; ++k) {
            const double t = ((double)(k / order) + node[k % order]) / (double)panels;
            const double part = weight[k % order] / (double)panels;
            for (size_t i = 0; i < n * TANGENT; ++i) w[i] = t * v[i];
            g->exp(n, from, w, x);
            speeds(g, n, from, v, t, x, speed);
            slowness(g, m, n, x, s);
            for (size_t i = 0; i < n; ++i) {
                length[at + i] += part * speed[i];
                cost[at + i] += part * speed[i] * s[i];
            }
        }
    }
}

/* The cost of one segment as `segments` has it, for who asks for one at a time: here the rule's points are what is worked
 * on together. */
double segment(const double *p, const double *q, const struct geometry *g, const struct medium *m, size_t order,
               const double *node, const double *weight, double panel) {
    double v[TANGENT], length, cost = 0;
    if (!g->geodesic) { /* its speed changes on the way */
        segments(1, p, q, g, m, order, node, weight, panel, 1, &cost, &length);
        return cost;
    }
    g->log(1, p, q, v);
    g->norm(1, p, v, &length);
    const double wanted = ceil(length / panel);
    const size_t panels = wanted >= 1 && wanted < 1e4 ? (size_t)wanted : 1, count = panels * order;
    for (size_t at = 0; at < count; at += BLOCK) {
        const size_t n = smaller(BLOCK, count - at);
        double from[BLOCK * POINT], w[BLOCK * TANGENT], x[BLOCK * POINT], s[BLOCK];
        for (size_t i = 0; i < n; ++i) {
            const double t = ((double)((at + i) / order) + node[(at + i) % order]) / (double)panels;
            memcpy(from + i * POINT, p, POINT * sizeof(double));
            for (size_t c = 0; c < TANGENT; ++c) w[i * TANGENT + c] = t * v[c];
        }
        g->exp(n, from, w, x);
        slowness(g, m, n, x, s);
        for (size_t i = 0; i < n; ++i) cost += weight[(at + i) % order] * s[i];
    }
    return cost * length / (double)panels;
}

/* What one thread needs for a curve of up to `most` nodes. */
struct work {
    double *all, *spaced, *trial, *best, *along, *basis, *slope, *curvature, *factor, *step, *move, *at_node, *cost;
    double *arc, *before, *here, *after, *moved, *shift, *at_before, *at_moved, *at_after, *first, *second;
};

static double *carve(double **free, size_t count) {
    double *part = *free;
    *free += count;
    return part;
}

static int prepare(struct work *w, size_t most) {
    const size_t many = most * VARIANTS;
    const size_t a_node = 3 * POINT + 2 * TANGENT + NORMALS * (TANGENT + 2 * NORMALS + 2) + 3;
    double *next = malloc(sizeof(double) * (most * a_node + many * (4 * POINT + TANGENT + 5)));
    if (next == NULL) return 0;
    w->all = next;
    w->spaced = carve(&next, most * POINT), w->trial = carve(&next, most * POINT), w->best = carve(&next, most * POINT);
    w->along = carve(&next, most * TANGENT), w->move = carve(&next, most * TANGENT);
    w->basis = carve(&next, most * NORMALS * TANGENT);
    w->curvature = carve(&next, most * NORMALS * NORMALS), w->factor = carve(&next, most * NORMALS * NORMALS);
    w->slope = carve(&next, most * NORMALS), w->step = carve(&next, most * NORMALS);
    w->at_node = carve(&next, most), w->cost = carve(&next, most), w->arc = carve(&next, most);
    w->before = carve(&next, many * POINT), w->here = carve(&next, many * POINT);
    w->after = carve(&next, many * POINT), w->moved = carve(&next, many * POINT);
    w->shift = carve(&next, many * TANGENT);
    w->at_before = carve(&next, many), w->at_moved = carve(&next, many), w->at_after = carve(&next, many);
    w->first = carve(&next, many), w->second = carve(&next, many);
    return 1;
}

/* arc[i]: the length of the curve x of n nodes up to its node i; its length. */
static double arc_lengths(const struct geometry *g, size_t n, const double *x, double *arc) {
    arc[0] = 0;
    for (size_t at = 0; at + 1 < n; at += BLOCK) {
        const size_t count = smaller(BLOCK, n - 1 - at);
        double v[BLOCK * TANGENT], middle[BLOCK * POINT], length[BLOCK];
        halves(g, count, x + at * POINT, x + (at + 1) * POINT, v, middle, length);
        for (size_t i = 0; i < count; ++i) arc[at + i + 1] = arc[at + i] + length[i];
    }
    return arc[n - 1];
}

/* `count` nodes at equal distances along the curve x of n nodes; its first and last node stay. */
static void space(const struct geometry *g, size_t n, const double *x, double *arc, size_t count, double *out) {
    const double length = arc_lengths(g, n, x, arc);
    size_t i = 0;
    memcpy(out, x, POINT * sizeof(double));
    for (size_t k = 1; k + 1 < count; ++k) {
        const double at = length * (double)k / (double)(count - 1);
        double v[TANGENT];
        while (i + 2 < n && arc[i + 1] < at) ++i;
        const double part = arc[i + 1] > arc[i] ? (at - arc[i]) / (arc[i + 1] - arc[i]) : 0;
        g->log(1, x + i * POINT, x + (i + 1) * POINT, v);
        for (size_t t = 0; t < TANGENT; ++t) v[t] *= part;
        g->exp(1, x + i * POINT, v, out + k * POINT);
    }
    memcpy(out + (count - 1) * POINT, x + (n - 1) * POINT, POINT * sizeof(double));
}

/* The curves given by `offsets` and `nodes` at equal distances, with as many nodes as `new_offsets` leave room for. */
int resample(size_t curves, const size_t *offsets, const double *nodes, const size_t *new_offsets, double *new_nodes,
             size_t most, const struct geometry *g, int threads) {
    int complete = 1;
    (void)threads;
#pragma omp parallel num_threads(threads)
    {
        double *arc = malloc(most * sizeof(double));
        if (arc == NULL) {
#pragma omp atomic write
            complete = 0;
        }
#pragma omp for schedule(static)
        for (size_t b = 0; b < curves; ++b) {
            if (arc == NULL) continue;
            const size_t n = offsets[b + 1] - offsets[b], count = new_offsets[b + 1] - new_offsets[b];
            space(g, n, nodes + offsets[b] * POINT, arc, count, new_nodes + new_offsets[b] * POINT);
        }
        free(arc);
    }
    return complete;
}

/* The cost of a curve of n nodes; w->at_node and w->cost hold those of its nodes and segments. */
static double curve_cost(const struct geometry *g, const struct medium *m, struct work *w, size_t n, const double *x) {
    double total = 0;
    slowness(g, m, n, x, w->at_node);
    simpson(g, m, n - 1, x, x + POINT, w->at_node, w->at_node + 1, w->cost);
    for (size_t i = 0; i + 1 < n; ++i) total += w->cost[i];
    return total;
}

/* Take from u at x its components along unit vectors, and make what is left one: how much that was, of 1. */
static double cleared(const struct geometry *g, const double *x, const double *tangent, const double *others,
                      size_t count, double *u) {
    const double whole = sqrt(g->inner(x, u, u));
    for (size_t j = 0; j <= count; ++j) {
        const double *e = j ? others + (j - 1) * TANGENT : tangent;
        const double along = g->inner(x, e, u);
        for (size_t t = 0; t < TANGENT; ++t) u[t] -= along * e[t];
    }
    const double left = sqrt(g->inner(x, u, u));
    for (size_t t = 0; t < TANGENT; ++t) u[t] /= left;
    return left / whole;
}

/* The vector of the manifold's frame at x that is least along the tangent and the `count` vectors of `others`. */
static void from_frame(const struct geometry *g, const double *x, const double *tangent, const double *others,
                       size_t count, double *u) {
    double frame[DIM * TANGENT], most = -1;
    g->frame(x, frame);
    for (size_t j = 0; j < DIM; ++j) {
        const double left = cleared(g, x, tangent, others, count, frame + j * TANGENT);
        if (left > most) most = left, memcpy(u, frame + j * TANGENT, TANGENT * sizeof(double));
    }
}

/* Orthonormal directions across the curve at its inner nodes, carried from node to node: e at p becomes Log_q(Exp_p(e)),
 * a short way along, without its part along the curve. That is parallel up to the second order, on every manifold. */
static void normals(const struct geometry *g, struct work *w, size_t n, const double *x, double spacing) {
    double back[BLOCK * TANGENT];
    for (size_t at = 1; at + 1 < n; at += BLOCK) {
        const size_t count = smaller(BLOCK, n - 1 - at);
        double *ahead = w->along + at * TANGENT;
        g->log(count, x + at * POINT, x + (at + 1) * POINT, ahead);
        g->log(count, x + at * POINT, x + (at - 1) * POINT, back);
        for (size_t i = 0; i < count * TANGENT; ++i) ahead[i] -= back[i];
    }
    for (size_t i = 1; i + 1 < n; ++i) {
        const double *here = x + i * POINT;
        double *tangent = w->along + i * TANGENT, *basis = w->basis + i * NORMALS * TANGENT;
        const double length = sqrt(g->inner(here, tangent, tangent));
        for (size_t t = 0; t < TANGENT; ++t) tangent[t] = length > 0 ? tangent[t] / length : 0;
        for (size_t j = 0; j < NORMALS; ++j) {
            double *e = basis + j * TANGENT, left = 0;
            if (i > 1) {
                double y[POINT], u[TANGENT];
                for (size_t t = 0; t < TANGENT; ++t) u[t] = spacing * e[t - NORMALS * TANGENT];
                g->exp(1, here - POINT, u, y);
                g->log(1, here, y, e);
                left = cleared(g, here, tangent, basis, j, e);
            }
            if (!(left > STEEP)) from_frame(g, here, tangent, basis, j, e);
        }
    }
}

/* The change of a node in variant k, in units of the difference step: +e_a, -e_a, and e_a + e_b, -(e_a + e_b). */
static void variant(size_t k, const double *basis, double step, double *shift) {
    size_t a = k / 2, b = NORMALS;
    if (a >= NORMALS) {
        size_t pair = a - NORMALS;
        for (a = 0; pair >= NORMALS - 1 - a; ++a) pair -= NORMALS - 1 - a;
        b = a + 1 + pair;
    }
    const double signed_step = k % 2 ? -step : step;
    for (size_t t = 0; t < TANGENT; ++t) {
        const double second = b < NORMALS ? basis[b * TANGENT + t] : 0;
        shift[t] = signed_step * (basis[a * TANGENT + t] + second);
    }
}

/* First and second derivatives, by central differences, of the cost in the displacements of each inner node alone. */
static void differentiate(const struct geometry *g, const struct medium *m, struct work *w, size_t n, const double *x,
                          double h) {
    const size_t inner = n - 2, count = inner * VARIANTS;
    for (size_t r = 0; r < count; ++r) {
        const size_t i = 1 + r / VARIANTS;
        memcpy(w->before + r * POINT, x + (i - 1) * POINT, POINT * sizeof(double));
        memcpy(w->here + r * POINT, x + i * POINT, POINT * sizeof(double));
        memcpy(w->after + r * POINT, x + (i + 1) * POINT, POINT * sizeof(double));
        w->at_before[r] = w->at_node[i - 1], w->at_after[r] = w->at_node[i + 1];
        variant(r % VARIANTS, w->basis + i * NORMALS * TANGENT, h, w->shift + r * TANGENT);
    }
    g->exp(count, w->here, w->shift, w->moved);
    slowness(g, m, count, w->moved, w->at_moved);
    simpson(g, m, count, w->before, w->moved, w->at_before, w->at_moved, w->first);
    simpson(g, m, count, w->moved, w->after, w->at_moved, w->at_after, w->second);
    for (size_t r = 0; r < count; ++r) w->first[r] += w->second[r];
    for (size_t i = 1; i <= inner; ++i) {
        const double middle = w->cost[i - 1] + w->cost[i], *f = w->first + (i - 1) * VARIANTS;
        double *slope = w->slope + i * NORMALS, *H = w->curvature + i * NORMALS * NORMALS;
        for (size_t a = 0; a < NORMALS; ++a) {
            slope[a] = (f[2 * a] - f[2 * a + 1]) / (2 * h);
            H[a * NORMALS + a] = (f[2 * a] + f[2 * a + 1] - 2 * middle) / (h * h);
        }
        for (size_t a = 0, k = 2 * NORMALS; a < NORMALS; ++a) {
            for (size_t b = a + 1; b < NORMALS; ++b, k += 2) {
                const double one = f[2 * a] + f[2 * a + 1], other = f[2 * b] + f[2 * b + 1];
                const double mixed = (f[k] + f[k + 1] - one - other + 2 * middle) / (2 * h * h);
                H[a * NORMALS + b] = mixed;
                H[b * NORMALS + a] = mixed;
            }
        }
    }
}

/* The coupling of two neighbours' displacements: the second derivative of a segment's length, times its slowness. */
static double coupling(const struct work *w, size_t segment) {
    const double length = w->arc[segment + 1] - w->arc[segment];
    return w->cost[segment] / (length * length);
}

/* L L^T = A, in place below the diagonal; whether A is positive definite. */
static int cholesky(double *A) {
    for (size_t a = 0; a < NORMALS; ++a) {
        for (size_t b = 0; b <= a; ++b) {
            double sum = A[a * NORMALS + b];
            for (size_t c = 0; c < b; ++c) sum -= A[a * NORMALS + c] * A[b * NORMALS + c];
            if (a == b && !(sum > 0)) return 0;
            A[a * NORMALS + b] = a == b ? sqrt(sum) : sum / A[b * NORMALS + b];
        }
    }
    return 1;
}

/* x := (L L^T)^-1 x */
static void substitute(const double *L, double *x) {
    for (size_t a = 0; a < NORMALS; ++a) {
        for (size_t b = 0; b < a; ++b) x[a] -= L[a * NORMALS + b] * x[b];
        x[a] /= L[a * NORMALS + a];
    }
    for (size_t a = NORMALS; a-- > 0;) {
        for (size_t b = a + 1; b < NORMALS; ++b) x[a] -= L[b * NORMALS + a] * x[b];
        x[a] /= L[a * NORMALS + a];
    }
}

/* Node i's block of the Hessian. Forced: what the slowness adds to that of a taut string made diagonally dominant. */
static void block(const struct work *w, size_t i, int forced, double *A) {
    const double string = coupling(w, i - 1) + coupling(w, i);
    memcpy(A, w->curvature + i * NORMALS * NORMALS, NORMALS * NORMALS * sizeof(double));
    if (!forced) return;
    for (size_t a = 0; a < NORMALS; ++a) {
        double others = 0;
        for (size_t b = 0; b < NORMALS; ++b) others += b == a ? 0 : fabs(A[a * NORMALS + b]);
        const double least = (1 + 1e-6) * string + others;
        if (!(A[a * NORMALS + a] > least)) A[a * NORMALS + a] = least;
    }
}

/* Newton's step: the block-tridiagonal system, eliminated from the start; whether its matrix is positive definite. */
static int solve(struct work *w, size_t n, int forced) {
    for (size_t i = 1; i + 1 < n; ++i) {
        double *A = w->factor + i * NORMALS * NORMALS, *step = w->step + i * NORMALS;
        block(w, i, forced, A);
        for (size_t a = 0; a < NORMALS; ++a) step[a] = -w->slope[i * NORMALS + a];
        if (i > 1) {
            const double c = coupling(w, i - 1), *L = A - NORMALS * NORMALS;
            double column[NORMALS];
            memcpy(column, step - NORMALS, sizeof column);
            substitute(L, column);
            for (size_t a = 0; a < NORMALS; ++a) step[a] += c * column[a];
            for (size_t b = 0; b < NORMALS; ++b) {
                for (size_t a = 0; a < NORMALS; ++a) column[a] = a == b ? c * c : 0;
                substitute(L, column);
                for (size_t a = 0; a < NORMALS; ++a) A[a * NORMALS + b] -= column[a];
            }
        }
        if (!cholesky(A)) return 0;
    }
    for (size_t i = n - 2; i > 0; --i) {
        double *step = w->step + i * NORMALS;
        if (i + 2 < n) {
            const double c = coupling(w, i);
            for (size_t a = 0; a < NORMALS; ++a) step[a] += c * step[NORMALS + a];
        }
        substitute(w->factor + i * NORMALS * NORMALS, step);
    }
    return 1;
}

/* w->trial: the curve x with its inner nodes moved by `part` of the step. */
static void displace(const struct geometry *g, struct work *w, size_t n, const double *x, double part) {
    for (size_t i = 1; i + 1 < n; ++i) {
        double *move = w->move + i * TANGENT;
        for (size_t t = 0; t < TANGENT; ++t) move[t] = 0;
        for (size_t a = 0; a < NORMALS; ++a) {
            const double by = part * w->step[i * NORMALS + a], *e = w->basis + (i * NORMALS + a) * TANGENT;
            for (size_t t = 0; t < TANGENT; ++t) move[t] += by * e[t];
        }
    }
    memcpy(w->trial, x, n * POINT * sizeof(double));
    g->exp(n - 2, x + POINT, w->move + TANGENT, w->trial + POINT);
}

/* The longest displacement of a node in the step. */
static double longest(const struct work *w, size_t n) {
    double most = 0;
    for (size_t i = 1; i + 1 < n; ++i) {
        double square = 0;
        for (size_t a = 0; a < NORMALS; ++a) square += w->step[i * NORMALS + a] * w->step[i * NORMALS + a];
        most = square > most ? square : most;
    }
    return sqrt(most);
}

/* One step of Newton's method on the curve x of cost `cost`, made shorter until it is cheaper: the cost, in the end. */
static double newton(const struct geometry *g, const struct medium *m, const struct settings *settings, struct work *w,
                     size_t n, double *x, double cost, double h) {
    const double length = arc_lengths(g, n, x, w->arc);
    normals(g, w, n, x, length / (double)(n - 1));
    differentiate(g, m, w, n, x, h);
    double couplings = 0;
    for (size_t i = 0; i + 1 < n; ++i) couplings += coupling(w, i);
    if (!isfinite(couplings)) return cost;
    for (int forced = 0; forced < 2; ++forced) {
        if (!solve(w, n, forced)) continue;
        const double far = longest(w, n);
        double part = far > settings->reach ? settings->reach / far : 1;
        for (int k = 0; k < HALVINGS; ++k, part /= 2) {
            displace(g, w, n, x, part);
            const double trial = curve_cost(g, m, w, n, w->trial);
            if (trial < cost) {
                memcpy(x, w->trial, n * POINT * sizeof(double));
                return trial;
            }
        }
        /* The costs of the segments are the trial's now, and `coupling` wants those of x. */
        curve_cost(g, m, w, n, x);
    }
    return cost;
}

/* Relax one curve with one difference step, until a step gains less than the tolerance; x never becomes dearer. */
static void stage(const struct geometry *g, const struct medium *m, const struct settings *settings, struct work *w,
                  size_t n, double *x, double h, double tolerance) {
    double cost = curve_cost(g, m, w, n, x), least = cost;
    if (!isfinite(cost)) return;
    memcpy(w->best, x, n * POINT * sizeof(double));
    for (size_t k = 0; k < settings->iterations; ++k) {
        const double before = cost;
        if (k % settings->resample_every == 0) { /* equal spacing may cost a little, where it cuts no corner */
            space(g, n, x, w->arc, n, w->spaced);
            memcpy(x, w->spaced, n * POINT * sizeof(double));
            cost = curve_cost(g, m, w, n, x);
            if (!isfinite(cost)) break;
        }
        const double spaced = cost;
        cost = newton(g, m, settings, w, n, x, cost, h);
        if (cost < least) {
            least = cost;
            memcpy(w->best, x, n * POINT * sizeof(double));
        }
        if (!(spaced - cost > tolerance * before)) break;
    }
    memcpy(x, w->best, n * POINT * sizeof(double));
}

/* Move the inner nodes of curves, in place, to where the curves cost least: by Newton's method with each of the
 * difference steps in turn. A curve with anything that is not finite stays as it is. */
int relax(size_t curves, const size_t *offsets, double *nodes, size_t most, const struct geometry *g,
          const struct medium *m, size_t steps, const double *differences, const struct settings *settings,
          int threads) {
    int complete = 1;
    (void)threads;
#pragma omp parallel num_threads(threads)
    {
        struct work w = {0};
        const int ready = prepare(&w, most);
        if (!ready) {
#pragma omp atomic write
            complete = 0;
        }
#pragma omp for schedule(dynamic, 16)
        for (size_t b = 0; b < curves; ++b) {
            const size_t n = offsets[b + 1] - offsets[b];
            if (!ready || DIM < 2 || n < 3) continue;
            double *x = nodes + offsets[b] * POINT;
            if (!(arc_lengths(g, n, x, w.arc) > 0)) continue;
            for (size_t k = 0; k < steps; ++k) { /* the earlier steps only lead to where the last one begins */
                const double tolerance = settings->tolerance * (k + 1 < steps ? ROUGHLY : 1);
                stage(g, m, settings, &w, n, x, differences[k], tolerance);
            }
        }
        if (ready) free(w.all);
    }
    return complete;
}
