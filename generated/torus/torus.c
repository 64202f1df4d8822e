/*
 * torus: The flat torus T^n, n angles in radians, each modulo 2 pi.
 *
 * See the header for what the functions promise.
 */

#include "torus.h"

#include <float.h>

/* x, periodic coordinates wrapped */
void torus_project(const double *TORUS_RESTRICT x, double *TORUS_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[0]);
    const double p0 = x[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double round_3 = rint(0.15915494309189535 * x[1]);
    const double p1 = x[1] - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    p_out[0] = p0;
    p_out[1] = p1;
}

void torus_project_batch(size_t count, const double *TORUS_RESTRICT x, double *TORUS_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) torus_project(x + 2 * i, p_out + 2 * i);
}

/* x */
void torus_to_tangent(
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT x,
    double *TORUS_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void torus_to_tangent_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT x,
    double *TORUS_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) torus_to_tangent(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* dot(u, v) */
double torus_inner(
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT u,
    const double *TORUS_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1];
}

void torus_inner_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT u,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = torus_inner(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
double torus_norm(const double *TORUS_RESTRICT p, const double *TORUS_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1]);
}

void torus_norm_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = torus_norm(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void torus_flat(
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
}

void torus_flat_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) torus_flat(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* wrap(p + v) */
void torus_exp(const double *TORUS_RESTRICT p, const double *TORUS_RESTRICT v, double *TORUS_RESTRICT q_out) {
    const double total_2 = p[0] + v[0];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q0 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double total_3 = p[1] + v[1];
    const double round_3 = rint(0.15915494309189535 * total_3);
    const double q1 = total_3 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    q_out[0] = q0;
    q_out[1] = q1;
}

void torus_exp_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) torus_exp(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* wrap(q - p) */
void torus_log(const double *TORUS_RESTRICT p, const double *TORUS_RESTRICT q, double *TORUS_RESTRICT v_out) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[1] - p[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    v_out[0] = v0;
    v_out[1] = v1;
}

void torus_log_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT q,
    double *TORUS_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) torus_log(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* |Log_p(q)|_p */
double torus_distance(const double *TORUS_RESTRICT p, const double *TORUS_RESTRICT q) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = q[1] - p[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double log1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    return sqrt(log0 * log0 + log1 * log1);
}

void torus_distance_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT q,
    double *TORUS_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = torus_distance(p + 2 * i, q + 2 * i);
}

/* 0 */
double torus_log_abs_det(const double *TORUS_RESTRICT p, const double *TORUS_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void torus_log_abs_det_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT q,
    double *TORUS_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = torus_log_abs_det(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void torus_riemannian_gradient(
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT df,
    double *TORUS_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
}

void torus_riemannian_gradient_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT df,
    double *TORUS_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) torus_riemannian_gradient(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
double torus_gradient_norm(const double *TORUS_RESTRICT p, const double *TORUS_RESTRICT df) {
    (void)p;
    return sqrt(df[0] * df[0] + df[1] * df[1]);
}

void torus_gradient_norm_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT df,
    double *TORUS_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = torus_gradient_norm(p + 2 * i, df + 2 * i);
}

/* v */
void torus_transport(
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT q,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
}

void torus_transport_batch(
    size_t count,
    const double *TORUS_RESTRICT p,
    const double *TORUS_RESTRICT q,
    const double *TORUS_RESTRICT v,
    double *TORUS_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) torus_transport(p + 2 * i, q + 2 * i, v + 2 * i, w_out + 2 * i);
}

/* wrap(2 * pi * uniform) */
void torus_sample(
    const double *TORUS_RESTRICT normal,
    const double *TORUS_RESTRICT uniform,
    double *TORUS_RESTRICT p_out) {
    (void)normal;
    const double round_2 = rint(uniform[0]);
    const double p0 = 6.283185307179586 * uniform[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double round_3 = rint(uniform[1]);
    const double p1 = 6.283185307179586 * uniform[1] - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    p_out[0] = p0;
    p_out[1] = p1;
}

void torus_sample_batch(
    size_t count,
    const double *TORUS_RESTRICT normal,
    const double *TORUS_RESTRICT uniform,
    double *TORUS_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) torus_sample(normal + 2 * i, uniform + 2 * i, p_out + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void torus_splat(
    const double *TORUS_RESTRICT x,
    const double *TORUS_RESTRICT mu,
    const double *TORUS_RESTRICT W,
    double amplitude,
    double *TORUS_RESTRICT value_out,
    double *TORUS_RESTRICT gradient_out) {
    const double gap = x[0] - mu[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double gap_2 = x[1] - mu[1];
    const double round_3 = rint(0.15915494309189535 * gap_2);
    const double v1 = gap_2 - 6.28125 * round_3 - 0.001935307179586477 * round_3;
    const double z0 = W[0] * v0 + W[1] * v1;
    const double z1 = W[2] * v0 + W[3] * v1;
    const double exp_2 = exp(-(0.5 * (z0 * z0 + z1 * z1)));
    const double phi = amplitude * exp_2;
    const double by_v1 = -(W[3] * z1) - W[1] * z0;
    const double by_v0 = -(W[2] * z1) - W[0] * z0;
    const double df0 = phi * by_v0;
    const double df1 = phi * by_v1;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
}

void torus_splat_batch(
    size_t count,
    const double *TORUS_RESTRICT x,
    const double *TORUS_RESTRICT mu,
    const double *TORUS_RESTRICT W,
    const double *TORUS_RESTRICT amplitude,
    double *TORUS_RESTRICT value_out,
    double *TORUS_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) torus_splat(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void torus_frame(const double *TORUS_RESTRICT p, double *TORUS_RESTRICT frame) {
    double left[2][2];
    for (int i = 0; i < 2; ++i) {
        double axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0 : 0.0;
        torus_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (torus_norm(p, left[i]) > torus_norm(p, left[longest])) longest = i;
        const double length = torus_norm(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 2];
            const double part = torus_inner(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}

/* x, periodic coordinates wrapped */
void torus_project_f(const float *TORUS_RESTRICT x, float *TORUS_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[0]);
    const float p0 = x[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float round_3 = rintf(0.15915494309189535f * x[1]);
    const float p1 = x[1] - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    p_out[0] = p0;
    p_out[1] = p1;
}

void torus_project_batch_f(size_t count, const float *TORUS_RESTRICT x, float *TORUS_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) torus_project_f(x + 2 * i, p_out + 2 * i);
}

/* x */
void torus_to_tangent_f(
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT x,
    float *TORUS_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void torus_to_tangent_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT x,
    float *TORUS_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) torus_to_tangent_f(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* dot(u, v) */
float torus_inner_f(
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT u,
    const float *TORUS_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1];
}

void torus_inner_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT u,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = torus_inner_f(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
float torus_norm_f(const float *TORUS_RESTRICT p, const float *TORUS_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1]);
}

void torus_norm_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = torus_norm_f(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void torus_flat_f(
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
}

void torus_flat_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) torus_flat_f(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* wrap(p + v) */
void torus_exp_f(const float *TORUS_RESTRICT p, const float *TORUS_RESTRICT v, float *TORUS_RESTRICT q_out) {
    const float total_2 = p[0] + v[0];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q0 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float total_3 = p[1] + v[1];
    const float round_3 = rintf(0.15915494309189535f * total_3);
    const float q1 = total_3 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    q_out[0] = q0;
    q_out[1] = q1;
}

void torus_exp_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) torus_exp_f(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* wrap(q - p) */
void torus_log_f(const float *TORUS_RESTRICT p, const float *TORUS_RESTRICT q, float *TORUS_RESTRICT v_out) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[1] - p[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    v_out[0] = v0;
    v_out[1] = v1;
}

void torus_log_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT q,
    float *TORUS_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) torus_log_f(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* |Log_p(q)|_p */
float torus_distance_f(const float *TORUS_RESTRICT p, const float *TORUS_RESTRICT q) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = q[1] - p[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float log1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    return sqrtf(log0 * log0 + log1 * log1);
}

void torus_distance_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT q,
    float *TORUS_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = torus_distance_f(p + 2 * i, q + 2 * i);
}

/* 0 */
float torus_log_abs_det_f(const float *TORUS_RESTRICT p, const float *TORUS_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void torus_log_abs_det_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT q,
    float *TORUS_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = torus_log_abs_det_f(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void torus_riemannian_gradient_f(
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT df,
    float *TORUS_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
}

void torus_riemannian_gradient_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT df,
    float *TORUS_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) torus_riemannian_gradient_f(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
float torus_gradient_norm_f(const float *TORUS_RESTRICT p, const float *TORUS_RESTRICT df) {
    (void)p;
    return sqrtf(df[0] * df[0] + df[1] * df[1]);
}

void torus_gradient_norm_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT df,
    float *TORUS_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = torus_gradient_norm_f(p + 2 * i, df + 2 * i);
}

/* v */
void torus_transport_f(
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT q,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
    w_out[1] = v[1];
}

void torus_transport_batch_f(
    size_t count,
    const float *TORUS_RESTRICT p,
    const float *TORUS_RESTRICT q,
    const float *TORUS_RESTRICT v,
    float *TORUS_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) torus_transport_f(p + 2 * i, q + 2 * i, v + 2 * i, w_out + 2 * i);
}

/* wrap(2 * pi * uniform) */
void torus_sample_f(
    const float *TORUS_RESTRICT normal,
    const float *TORUS_RESTRICT uniform,
    float *TORUS_RESTRICT p_out) {
    (void)normal;
    const float round_2 = rintf(uniform[0]);
    const float p0 = 6.283185307179586f * uniform[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float round_3 = rintf(uniform[1]);
    const float p1 = 6.283185307179586f * uniform[1] - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    p_out[0] = p0;
    p_out[1] = p1;
}

void torus_sample_batch_f(
    size_t count,
    const float *TORUS_RESTRICT normal,
    const float *TORUS_RESTRICT uniform,
    float *TORUS_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) torus_sample_f(normal + 2 * i, uniform + 2 * i, p_out + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void torus_splat_f(
    const float *TORUS_RESTRICT x,
    const float *TORUS_RESTRICT mu,
    const float *TORUS_RESTRICT W,
    float amplitude,
    float *TORUS_RESTRICT value_out,
    float *TORUS_RESTRICT gradient_out) {
    const float gap = x[0] - mu[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float gap_2 = x[1] - mu[1];
    const float round_3 = rintf(0.15915494309189535f * gap_2);
    const float v1 = gap_2 - 6.28125f * round_3 - 0.001935307179586477f * round_3;
    const float z0 = W[0] * v0 + W[1] * v1;
    const float z1 = W[2] * v0 + W[3] * v1;
    const float exp_2 = expf(-(0.5f * (z0 * z0 + z1 * z1)));
    const float phi = amplitude * exp_2;
    const float by_v1 = -(W[3] * z1) - W[1] * z0;
    const float by_v0 = -(W[2] * z1) - W[0] * z0;
    const float df0 = phi * by_v0;
    const float df1 = phi * by_v1;
    value_out[0] = phi;
    gradient_out[0] = df0;
    gradient_out[1] = df1;
}

void torus_splat_batch_f(
    size_t count,
    const float *TORUS_RESTRICT x,
    const float *TORUS_RESTRICT mu,
    const float *TORUS_RESTRICT W,
    const float *TORUS_RESTRICT amplitude,
    float *TORUS_RESTRICT value_out,
    float *TORUS_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) torus_splat_f(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void torus_frame_f(const float *TORUS_RESTRICT p, float *TORUS_RESTRICT frame) {
    float left[2][2];
    for (int i = 0; i < 2; ++i) {
        float axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        torus_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (torus_norm_f(p, left[i]) > torus_norm_f(p, left[longest])) longest = i;
        const float length = torus_norm_f(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 2];
            const float part = torus_inner_f(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}
