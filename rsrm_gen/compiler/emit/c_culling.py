"""Which splats are near enough to a block of points to be summed, in generated C, as templates (see `c_splats_loops.py`).

A block is $BLOCK vectors of points, with one of its points as its middle and the largest distance from there as its radius.
By the triangle inequality no point of the block is closer to a splat than the distance of the middle less the radius; and
`lower/culling.py` proves how little a splat is beyond its reach. Forward, one vector is the distances of a middle from some
splats; backward, those of a splat from some middles.
"""

from __future__ import annotations

import math

from rsrm_gen.compiler.emit.c_precision import Precision
from rsrm_gen.compiler.lower import Culling

CUT = {
    "": 80.0,
    "_f": 40.0,
}  # of |z|^2: exp(-CUT / 2) is below a rounding unit of the precision, with room for the slopes
MARGIN = 1 + 1 / 128  # on reach and radius, for the rounding of distances
PART = 256  # splats whose numbers are listed at once
PLACES = 16  # blocks from which the part of pairs that is summed is estimated


def numbers(culling: Culling | None, precision: Precision) -> dict[str, object]:
    """The parts of the templates: $REACH, reach by the width of a splat; $FAR, until where the bound holds."""
    found: dict[str, object] = {"PART": PART, "PLACES": PLACES, "MARGIN": f"{MARGIN!r}%"}
    if culling is not None:
        found["REACH"] = f"{MARGIN * reach(culling, precision)!r}%"
        within = f" & (distance + radius <= {culling.radius!r}%)"
        found["WITHIN"] = within if math.isfinite(culling.radius) else ""
    return found


def reach(culling: Culling, precision: Precision) -> float:
    """How many times its width a splat reaches."""
    return round(math.sqrt(CUT[precision.tag] + 2 * culling.log_bound), 9)


NONE = """
/* Nothing bounds what a far splat adds on this manifold: all are near. */
static void splat_reach@(
    const vector@ *mu, const vector@ *amplitude, const T_*width, size_t splat_count, size_t start, vector@ *splats) {
    (void)mu, (void)amplitude, (void)width, (void)splat_count, (void)start, (void)splats;
}
static void block_place@(const T_*x, size_t count, size_t start, T_*place) {
    (void)x, (void)count, (void)start, (void)place;
}
static size_t splats_near@(const T_*place, const vector@ *splats, size_t first, size_t end, uint32_t *near) {
    (void)place, (void)splats;
    for (size_t k = first; k < end; ++k) near[k - first] = (uint32_t)k;
    return end - first;
}
static size_t blocks_near@(
    const T_*mu, const T_*reach, const vector@ *blocks, size_t first, size_t end, uint32_t *near) {
    (void)mu, (void)reach, (void)blocks;
    for (size_t b = first; b < end; ++b) near[b - first] = (uint32_t)(b - first);
    return end - first;
}"""

NEAR = """
/* Zero, or NaN where a number is not finite: what has one is near everything. */
INLINE vector@ vector_spoilt@(const vector@ *x, size_t size) {
    vector@ sum = ZERO;
    for (size_t i = 0; i < size; ++i) sum += x[i] - x[i];
    return sum;
}

/* mu and reach of LANES splats, side by side. */
OUTLINE void splat_reach@(
    const vector@ *mu, const vector@ *amplitude, const T_*width, size_t splat_count, size_t start, vector@ *splats) {
    vector@ *own = splats + start / LANES@ * ($nx + 1);
    vector_rows@(width, splat_count, start, 1, own + $nx);
    own[$nx] = own[$nx] * $REACH + vector_spoilt@(mu, $nx) + vector_spoilt@(amplitude, 1);
    for (int i = 0; i < $nx; ++i) own[i] = mu[i];
}

/* The middle of a block of points and its radius; of some points that could be the middle, the one with the smallest. */
OUTLINE void block_place@(const T_*x, size_t count, size_t start, T_*place) {
    const size_t size = count - start < $BLOCK * LANES@ ? count - start : $BLOCK * LANES@;
    vector@ at[$BLOCK][$nx], spoilt = ZERO;
    for (size_t b = 0; b < $BLOCK; ++b) {
        vector_rows@(x, count, start + b * LANES@, $nx, at[b]);
        spoilt += vector_spoilt@(at[b], $nx);
    }
    for (size_t i = 1; i < 8; i += 2) {
        const T_*middle = x + $nx * (start + i * size / 8);
        T_radius = 0, column[LANES@];
        for (size_t b = 0; b < $BLOCK; ++b) {
            vector@ distance[1];
            pair_distances@(middle, at[b], distance);
            vector_store@(column, distance[0]);
            for (size_t lane = 0; lane < LANES@; ++lane) radius = column[lane] > radius ? column[lane] : radius;
        }
        if (i == 1 || radius < place[$nx]) {
            for (int j = 0; j < $nx; ++j) place[j] = middle[j];
            place[$nx] = radius;
        }
    }
    place[$nx] = place[$nx] * $MARGIN + vector_sum@(spoilt);
}

/* Where a splat is too far from all of a block; never where a distance is not a number. */
INLINE vector_mask@ vector_far@(vector@ distance, vector@ reach, vector@ radius) {
    return (distance > reach + radius)$WITHIN;
}

/* The splats from `first` (a multiple of LANES) to `end` that are near a block, all if there is none; how many. */
OUTLINE size_t splats_near@(const T_*place, const vector@ *splats, size_t first, size_t end, uint32_t *near) {
    size_t size = 0;
    if (!place) {
        for (size_t k = first; k < end; ++k) near[size++] = (uint32_t)k;
        return size;
    }
    for (size_t start = first; start < end; start += LANES@) {
        const vector@ *own = splats + start / LANES@ * ($nx + 1);
        vector@ distance[1];
        pair_distances@(place, own, distance);
        const vector_mask@ far = vector_far@(distance[0], own[$nx], vector_of@(place[$nx]));
        const size_t lanes = end - start < LANES@ ? end - start : LANES@;
        for (size_t lane = 0; lane < lanes; ++lane) {
            near[size] = (uint32_t)(start + lane);
            size += !LANE(far, lane);
        }
    }
    return size;
}

/* The vectors of points from `first` to `end` whose blocks are near a splat, all if there are none, less `first`. */
OUTLINE size_t blocks_near@(
    const T_*mu, const T_*reach, const vector@ *blocks, size_t first, size_t end, uint32_t *near) {
    const size_t group = $BLOCK * LANES@;  // vectors of points whose middles are one vector
    size_t size = 0;
    if (!reach) {
        for (size_t b = first; b < end; ++b) near[size++] = (uint32_t)(b - first);
        return size;
    }
    for (size_t start = first / group * group; start < end; start += group) {
        const vector@ *own = blocks + start / group * ($nx + 1);
        vector@ distance[1];
        pair_distances@(mu, own, distance);
        const vector_mask@ far = vector_far@(distance[0], vector_of@(*reach), own[$nx]);
        for (size_t lane = 0; lane < group; ++lane) {
            const size_t b = start + lane;
            near[size] = (uint32_t)(b - first);
            size += b >= first && b < end && !LANE(far, lane / $BLOCK);
        }
    }
    return size;
}"""

ORDER_NONE = """
$SIGNATURE_splats_order$ {
    (void)x, (void)mu, (void)amplitude, (void)width, (void)limit, (void)work;
    (void)splat_count;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    return 1;
}"""

ORDER = """
/* A coordinate to sort by. */
INLINE T_order_key@(const T_*x, size_t row, size_t axis) {
    const T_key = x[$nx * row + axis];
    return key == key ? key : 0;
}

/* The coordinate that differs most among some points. */
static size_t widest@(const T_*x, const size_t *order, size_t count) {
    T_low[$nx], high[$nx];
    size_t widest = 0;
    for (size_t axis = 0; axis < $nx; ++axis) low[axis] = high[axis] = order_key@(x, order[0], axis);
    for (size_t i = 1; i < count; ++i)
        for (size_t axis = 0; axis < $nx; ++axis) {
            const T_key = order_key@(x, order[i], axis);
            low[axis] = key < low[axis] ? key : low[axis];
            high[axis] = key > high[axis] ? key : high[axis];
        }
    for (size_t axis = 1; axis < $nx; ++axis)
        if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
    return widest;
}

/* Order points and their keys such that none of the first `part` has a larger key than one of the others. */
static void split_at@(T_*keys, size_t *order, size_t count, size_t part) {
    size_t low = 0, high = count;  // the part-th smallest key is in [low, high)
    while (high - low > 1) {
        const T_a = keys[low], b = keys[low + (high - low) / 2], c = keys[high - 1];
        const T_least = a < b ? a : b, most = a < b ? b : a, pivot = c < least ? least : c > most ? most : c;
        size_t less = low, equal = low;
        for (int inclusive = 0; inclusive < 2; ++inclusive) {  // without branches, which nobody can foresee
            size_t end = equal = less;
            for (; end < high; ++end) {
                const T_key = keys[end];
                const size_t row = order[end];
                keys[end] = keys[equal], order[end] = order[equal];
                keys[equal] = key, order[equal] = row;
                equal += inclusive ? key <= pivot : key < pivot;
            }
            if (!inclusive) less = equal;
            if (part < less) break;
        }
        if (part < less)
            high = less;
        else if (part < equal)
            return;
        else
            low = equal;
    }
}

/* Halve points at their medians until they are blocks. */
static void sorted_blocks@(const T_*x, size_t *order, size_t count, T_*keys) {
    const size_t block = $BLOCK * LANES@;
    while (count > block) {
        const size_t part = ((count + block - 1) / block + 1) / 2 * block, axis = widest@(x, order, count);
        for (size_t i = 0; i < count; ++i) keys[i] = order_key@(x, order[i], axis);
        split_at@(keys, order, count, part);
        sorted_blocks@(x, order + part, count - part, keys);
        count = part;
    }
}

$SIGNATURE_splats_order$ {
    const size_t block = $BLOCK * LANES@;
    vector@ *splats = work_reaches@(work, 0);
    uint32_t near[$PART];
    double share = 0;
    for (size_t n = 0; n < count; ++n) order[n] = n;
    if (!count || !splat_count) return 1;
    for (size_t start = 0; start < splat_count; start += LANES@) {
        vector@ own_mu[$nx], own_amplitude[1];
        vector_rows@(mu, splat_count, start, $nx, own_mu);
        vector_rows@(amplitude, splat_count, start, 1, own_amplitude);
        splat_reach@(own_mu, own_amplitude, width, splat_count, start, splats);
    }
    for (int sorted = 0; sorted < 2; ++sorted) {
        size_t pairs = 0;
        if (sorted) sorted_blocks@(x, order, count, (T_*)work_blocks@(work, 0, splat_count));
        for (size_t i = 1; i < 2 * $PLACES; i += 2) {
            T_rows[$BLOCK * LANES@ * $nx], place[$nx + 1];
            const size_t some = i * count / (2 * $PLACES), start = sorted ? some / block * block : some;
            const size_t size = !sorted ? 1 : count - start < block ? count - start : block;
            for (size_t n = 0; n < size; ++n)
                for (int j = 0; j < $nx; ++j) rows[$nx * n + j] = x[$nx * order[start + n] + j];
            block_place@(rows, size, 0, place);
            for (size_t first = 0; first < splat_count; first += $PART) {
                const size_t end = splat_count - first < $PART ? splat_count : first + $PART;
                pairs += splats_near@(place, splats, first, end, near);
            }
        }
        share = (double)pairs / ((double)splat_count * $PLACES);
        if (share > limit) return share;
    }
    return share;
}"""
