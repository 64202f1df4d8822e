/* What gauss_newton.py leaves to C: compiled for REAL, float or double. */
#include <stddef.h>

/* matrix[i][j] += block[a][b] for the a-th and b-th of `count` columns i and j: the lower triangle, columns rising. */
void add_block(size_t size, size_t count, const long long *restrict columns, const REAL *restrict block,
               REAL *restrict matrix) {
    for (size_t a = 0; a < count; ++a) {
        REAL *restrict row = matrix + (size_t)columns[a] * size;
        for (size_t b = 0; b <= a; ++b) row[columns[b]] += block[a * count + b];
    }
}
