/*
 * euclidean: Euclidean space R^n in Cartesian coordinates.
 *
 * See the header for what the functions promise.
 */

#include "euclidean.h"

#include <float.h>

/* x */
void euclidean_project(const double *EUCLIDEAN_RESTRICT x, double *EUCLIDEAN_RESTRICT p_out) {
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = x[2];
}

void euclidean_project_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT x,
    double *EUCLIDEAN_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) euclidean_project(x + 3 * i, p_out + 3 * i);
}

/* x */
void euclidean_to_tangent(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT x,
    double *EUCLIDEAN_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
}

void euclidean_to_tangent_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT x,
    double *EUCLIDEAN_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) euclidean_to_tangent(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* dot(u, v) */
double euclidean_inner(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT u,
    const double *EUCLIDEAN_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void euclidean_inner_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT u,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = euclidean_inner(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
double euclidean_norm(const double *EUCLIDEAN_RESTRICT p, const double *EUCLIDEAN_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void euclidean_norm_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = euclidean_norm(p + 3 * i, v + 3 * i);
}

/* G(p) v */
void euclidean_flat(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void euclidean_flat_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) euclidean_flat(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* p + v */
void euclidean_exp(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT q_out) {
    const double q0 = p[0] + v[0];
    const double q1 = p[1] + v[1];
    const double q2 = p[2] + v[2];
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void euclidean_exp_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) euclidean_exp(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* q - p */
void euclidean_log(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT q,
    double *EUCLIDEAN_RESTRICT v_out) {
    const double v0 = q[0] - p[0];
    const double v1 = q[1] - p[1];
    const double v2 = q[2] - p[2];
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void euclidean_log_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT q,
    double *EUCLIDEAN_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) euclidean_log(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* |Log_p(q)|_p */
double euclidean_distance(const double *EUCLIDEAN_RESTRICT p, const double *EUCLIDEAN_RESTRICT q) {
    const double log0 = q[0] - p[0];
    const double log1 = q[1] - p[1];
    const double log2 = q[2] - p[2];
    return sqrt(log0 * log0 + log1 * log1 + log2 * log2);
}

void euclidean_distance_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT q,
    double *EUCLIDEAN_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = euclidean_distance(p + 3 * i, q + 3 * i);
}

/* 0 */
double euclidean_log_abs_det(const double *EUCLIDEAN_RESTRICT p, const double *EUCLIDEAN_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void euclidean_log_abs_det_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT q,
    double *EUCLIDEAN_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = euclidean_log_abs_det(p + 3 * i, q + 3 * i);
}

/* G(p)^-1 df */
void euclidean_riemannian_gradient(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT df,
    double *EUCLIDEAN_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
}

void euclidean_riemannian_gradient_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT df,
    double *EUCLIDEAN_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) euclidean_riemannian_gradient(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
double euclidean_gradient_norm(const double *EUCLIDEAN_RESTRICT p, const double *EUCLIDEAN_RESTRICT df) {
    (void)p;
    return sqrt(df[0] * df[0] + df[1] * df[1] + df[2] * df[2]);
}

void euclidean_gradient_norm_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT df,
    double *EUCLIDEAN_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = euclidean_gradient_norm(p + 3 * i, df + 3 * i);
}

/* v */
void euclidean_transport(
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT q,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
}

void euclidean_transport_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT p,
    const double *EUCLIDEAN_RESTRICT q,
    const double *EUCLIDEAN_RESTRICT v,
    double *EUCLIDEAN_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) euclidean_transport(p + 3 * i, q + 3 * i, v + 3 * i, w_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void euclidean_splat(
    const double *EUCLIDEAN_RESTRICT x,
    const double *EUCLIDEAN_RESTRICT mu,
    const double *EUCLIDEAN_RESTRICT W,
    double amplitude,
    double *EUCLIDEAN_RESTRICT value_out,
    double *EUCLIDEAN_RESTRICT gradient_out) {
    const double v0 = x[0] - mu[0];
    const double v1 = x[1] - mu[1];
    const double v2 = x[2] - mu[2];
    const double z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const double z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const double z2 = W[6] * v0 + W[7] * v1 + W[8] * v2;
    const double minus = -(0.5 * (z0 * z0 + z1 * z1 + z2 * z2));
    const double phi = amplitude * exp(minus);
    const double by_v2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0;
    const double by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    const double by_v0 = -(W[6] * z2) - W[3] * z1 - W[0] * z0;
    const double df0 = phi * by_v0;
    const double df1 = phi * by_v1;
    const double df2 = phi * by_v2;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
}

void euclidean_splat_batch(
    size_t count,
    const double *EUCLIDEAN_RESTRICT x,
    const double *EUCLIDEAN_RESTRICT mu,
    const double *EUCLIDEAN_RESTRICT W,
    const double *EUCLIDEAN_RESTRICT amplitude,
    double *EUCLIDEAN_RESTRICT value_out,
    double *EUCLIDEAN_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) euclidean_splat(x + 3 * i, mu + 3 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void euclidean_frame(const double *EUCLIDEAN_RESTRICT p, double *EUCLIDEAN_RESTRICT frame) {
    double left[3][3];
    for (int i = 0; i < 3; ++i) {
        double axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0 : 0.0;
        euclidean_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        double *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (euclidean_norm(p, left[i]) > euclidean_norm(p, left[longest])) longest = i;
        const double length = euclidean_norm(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 3];
            const double part = euclidean_inner(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}

/* x */
void euclidean_project_f(const float *EUCLIDEAN_RESTRICT x, float *EUCLIDEAN_RESTRICT p_out) {
    p_out[0] = x[0];
    p_out[1] = x[1];
    p_out[2] = x[2];
}

void euclidean_project_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT x,
    float *EUCLIDEAN_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) euclidean_project_f(x + 3 * i, p_out + 3 * i);
}

/* x */
void euclidean_to_tangent_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT x,
    float *EUCLIDEAN_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
    v_out[2] = x[2];
}

void euclidean_to_tangent_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT x,
    float *EUCLIDEAN_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) euclidean_to_tangent_f(p + 3 * i, x + 3 * i, v_out + 3 * i);
}

/* dot(u, v) */
float euclidean_inner_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT u,
    const float *EUCLIDEAN_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

void euclidean_inner_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT u,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = euclidean_inner_f(p + 3 * i, u + 3 * i, v + 3 * i);
}

/* sqrt(<v, v>_p) */
float euclidean_norm_f(const float *EUCLIDEAN_RESTRICT p, const float *EUCLIDEAN_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void euclidean_norm_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = euclidean_norm_f(p + 3 * i, v + 3 * i);
}

/* G(p) v */
void euclidean_flat_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
    covector_out[2] = v[2];
}

void euclidean_flat_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) euclidean_flat_f(p + 3 * i, v + 3 * i, covector_out + 3 * i);
}

/* p + v */
void euclidean_exp_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT q_out) {
    const float q0 = p[0] + v[0];
    const float q1 = p[1] + v[1];
    const float q2 = p[2] + v[2];
    q_out[0] = q0;
    q_out[1] = q1;
    q_out[2] = q2;
}

void euclidean_exp_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) euclidean_exp_f(p + 3 * i, v + 3 * i, q_out + 3 * i);
}

/* q - p */
void euclidean_log_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT q,
    float *EUCLIDEAN_RESTRICT v_out) {
    const float v0 = q[0] - p[0];
    const float v1 = q[1] - p[1];
    const float v2 = q[2] - p[2];
    v_out[0] = v0;
    v_out[1] = v1;
    v_out[2] = v2;
}

void euclidean_log_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT q,
    float *EUCLIDEAN_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) euclidean_log_f(p + 3 * i, q + 3 * i, v_out + 3 * i);
}

/* |Log_p(q)|_p */
float euclidean_distance_f(const float *EUCLIDEAN_RESTRICT p, const float *EUCLIDEAN_RESTRICT q) {
    const float log0 = q[0] - p[0];
    const float log1 = q[1] - p[1];
    const float log2 = q[2] - p[2];
    return sqrtf(log0 * log0 + log1 * log1 + log2 * log2);
}

void euclidean_distance_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT q,
    float *EUCLIDEAN_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = euclidean_distance_f(p + 3 * i, q + 3 * i);
}

/* 0 */
float euclidean_log_abs_det_f(const float *EUCLIDEAN_RESTRICT p, const float *EUCLIDEAN_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void euclidean_log_abs_det_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT q,
    float *EUCLIDEAN_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = euclidean_log_abs_det_f(p + 3 * i, q + 3 * i);
}

/* G(p)^-1 df */
void euclidean_riemannian_gradient_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT df,
    float *EUCLIDEAN_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
    gradient_out[2] = df[2];
}

void euclidean_riemannian_gradient_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT df,
    float *EUCLIDEAN_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) euclidean_riemannian_gradient_f(p + 3 * i, df + 3 * i, gradient_out + 3 * i);
}

/* |grad f|_p */
float euclidean_gradient_norm_f(const float *EUCLIDEAN_RESTRICT p, const float *EUCLIDEAN_RESTRICT df) {
    (void)p;
    return sqrtf(df[0] * df[0] + df[1] * df[1] + df[2] * df[2]);
}

void euclidean_gradient_norm_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT df,
    float *EUCLIDEAN_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = euclidean_gradient_norm_f(p + 3 * i, df + 3 * i);
}

/* v */
void euclidean_transport_f(
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT q,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
    w_out[2] = v[2];
}

void euclidean_transport_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT p,
    const float *EUCLIDEAN_RESTRICT q,
    const float *EUCLIDEAN_RESTRICT v,
    float *EUCLIDEAN_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) euclidean_transport_f(p + 3 * i, q + 3 * i, v + 3 * i, w_out + 3 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void euclidean_splat_f(
    const float *EUCLIDEAN_RESTRICT x,
    const float *EUCLIDEAN_RESTRICT mu,
    const float *EUCLIDEAN_RESTRICT W,
    float amplitude,
    float *EUCLIDEAN_RESTRICT value_out,
    float *EUCLIDEAN_RESTRICT gradient_out) {
    const float v0 = x[0] - mu[0];
    const float v1 = x[1] - mu[1];
    const float v2 = x[2] - mu[2];
    const float z0 = W[0] * v0 + W[1] * v1 + W[2] * v2;
    const float z1 = W[3] * v0 + W[4] * v1 + W[5] * v2;
    const float z2 = W[6] * v0 + W[7] * v1 + W[8] * v2;
    const float minus = -(0.5f * (z0 * z0 + z1 * z1 + z2 * z2));
    const float phi = amplitude * expf(minus);
    const float by_v2 = -(W[8] * z2) - W[5] * z1 - W[2] * z0;
    const float by_v1 = -(W[7] * z2) - W[4] * z1 - W[1] * z0;
    const float by_v0 = -(W[6] * z2) - W[3] * z1 - W[0] * z0;
    const float df0 = phi * by_v0;
    const float df1 = phi * by_v1;
    const float df2 = phi * by_v2;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
    gradient_out[2] = df2;
}

void euclidean_splat_batch_f(
    size_t count,
    const float *EUCLIDEAN_RESTRICT x,
    const float *EUCLIDEAN_RESTRICT mu,
    const float *EUCLIDEAN_RESTRICT W,
    const float *EUCLIDEAN_RESTRICT amplitude,
    float *EUCLIDEAN_RESTRICT value_out,
    float *EUCLIDEAN_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) euclidean_splat_f(x + 3 * i, mu + 3 * i, W + 9 * i, amplitude[i], value_out + i, gradient_out + 3 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void euclidean_frame_f(const float *EUCLIDEAN_RESTRICT p, float *EUCLIDEAN_RESTRICT frame) {
    float left[3][3];
    for (int i = 0; i < 3; ++i) {
        float axis[3];
        for (int j = 0; j < 3; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        euclidean_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 3; ++row) {
        float *e = frame + 3 * row;
        int longest = 0;
        for (int i = 1; i < 3; ++i)
            if (euclidean_norm_f(p, left[i]) > euclidean_norm_f(p, left[longest])) longest = i;
        const float length = euclidean_norm_f(p, left[longest]);
        for (int j = 0; j < 3; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 3; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 3];
            const float part = euclidean_inner_f(p, e, rest);
            for (int j = 0; j < 3; ++j) rest[j] -= part * e[j];
        }
    }
}
