/*
 * so2: Rotations of the plane by their angle in radians, modulo 2 pi.
 *
 * See the header for what the functions promise.
 */

#include "so2.h"

#include <float.h>

/* x, periodic coordinates wrapped */
void so2_project(const double *SO2_RESTRICT x, double *SO2_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[0]);
    const double p0 = x[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    p_out[0] = p0;
}

void so2_project_batch(size_t count, const double *SO2_RESTRICT x, double *SO2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so2_project(x + 1 * i, p_out + 1 * i);
}

/* x */
void so2_to_tangent(const double *SO2_RESTRICT p, const double *SO2_RESTRICT x, double *SO2_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
}

void so2_to_tangent_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT x,
    double *SO2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so2_to_tangent(p + 1 * i, x + 1 * i, v_out + 1 * i);
}

/* dot(u, v) */
double so2_inner(const double *SO2_RESTRICT p, const double *SO2_RESTRICT u, const double *SO2_RESTRICT v) {
    (void)p;
    return u[0] * v[0];
}

void so2_inner_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT u,
    const double *SO2_RESTRICT v,
    double *SO2_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = so2_inner(p + 1 * i, u + 1 * i, v + 1 * i);
}

/* sqrt(<v, v>_p) */
double so2_norm(const double *SO2_RESTRICT p, const double *SO2_RESTRICT v) {
    (void)p;
    return fabs(v[0]);
}

void so2_norm_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT v,
    double *SO2_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = so2_norm(p + 1 * i, v + 1 * i);
}

/* G(p) v */
void so2_flat(const double *SO2_RESTRICT p, const double *SO2_RESTRICT v, double *SO2_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
}

void so2_flat_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT v,
    double *SO2_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) so2_flat(p + 1 * i, v + 1 * i, covector_out + 1 * i);
}

/* wrap(p + v) */
void so2_exp(const double *SO2_RESTRICT p, const double *SO2_RESTRICT v, double *SO2_RESTRICT q_out) {
    const double total_2 = p[0] + v[0];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q0 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    q_out[0] = q0;
}

void so2_exp_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT v,
    double *SO2_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so2_exp(p + 1 * i, v + 1 * i, q_out + 1 * i);
}

/* wrap(q - p) */
void so2_log(const double *SO2_RESTRICT p, const double *SO2_RESTRICT q, double *SO2_RESTRICT v_out) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    v_out[0] = v0;
}

void so2_log_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT q,
    double *SO2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so2_log(p + 1 * i, q + 1 * i, v_out + 1 * i);
}

/* |Log_p(q)|_p */
double so2_distance(const double *SO2_RESTRICT p, const double *SO2_RESTRICT q) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    return fabs(log0);
}

void so2_distance_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT q,
    double *SO2_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = so2_distance(p + 1 * i, q + 1 * i);
}

/* 0 */
double so2_log_abs_det(const double *SO2_RESTRICT p, const double *SO2_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void so2_log_abs_det_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT q,
    double *SO2_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = so2_log_abs_det(p + 1 * i, q + 1 * i);
}

/* G(p)^-1 df */
void so2_riemannian_gradient(
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT df,
    double *SO2_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
}

void so2_riemannian_gradient_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT df,
    double *SO2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so2_riemannian_gradient(p + 1 * i, df + 1 * i, gradient_out + 1 * i);
}

/* |grad f|_p */
double so2_gradient_norm(const double *SO2_RESTRICT p, const double *SO2_RESTRICT df) {
    (void)p;
    return fabs(df[0]);
}

void so2_gradient_norm_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT df,
    double *SO2_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = so2_gradient_norm(p + 1 * i, df + 1 * i);
}

/* v */
void so2_transport(
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT q,
    const double *SO2_RESTRICT v,
    double *SO2_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
}

void so2_transport_batch(
    size_t count,
    const double *SO2_RESTRICT p,
    const double *SO2_RESTRICT q,
    const double *SO2_RESTRICT v,
    double *SO2_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) so2_transport(p + 1 * i, q + 1 * i, v + 1 * i, w_out + 1 * i);
}

/* wrap(2 * pi * uniform) */
void so2_sample(
    const double *SO2_RESTRICT normal,
    const double *SO2_RESTRICT uniform,
    double *SO2_RESTRICT p_out) {
    (void)normal;
    const double round_2 = rint(uniform[0]);
    const double p0 = 6.283185307179586 * uniform[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    p_out[0] = p0;
}

void so2_sample_batch(
    size_t count,
    const double *SO2_RESTRICT normal,
    const double *SO2_RESTRICT uniform,
    double *SO2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so2_sample(normal + 1 * i, uniform + 1 * i, p_out + 1 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void so2_splat(
    const double *SO2_RESTRICT x,
    const double *SO2_RESTRICT mu,
    const double *SO2_RESTRICT W,
    double amplitude,
    double *SO2_RESTRICT value_out,
    double *SO2_RESTRICT gradient_out) {
    const double gap = x[0] - mu[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double z0 = W[0] * v0;
    const double phi = amplitude * exp(-(0.5 * (z0 * z0)));
    const double df0 = -(phi * (W[0] * z0));
    value_out[0] = phi;
    gradient_out[0] = df0;
}

void so2_splat_batch(
    size_t count,
    const double *SO2_RESTRICT x,
    const double *SO2_RESTRICT mu,
    const double *SO2_RESTRICT W,
    const double *SO2_RESTRICT amplitude,
    double *SO2_RESTRICT value_out,
    double *SO2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so2_splat(x + 1 * i, mu + 1 * i, W + 1 * i, amplitude[i], value_out + i, gradient_out + 1 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void so2_frame(const double *SO2_RESTRICT p, double *SO2_RESTRICT frame) {
    double left[1][1];
    for (int i = 0; i < 1; ++i) {
        double axis[1];
        for (int j = 0; j < 1; ++j) axis[j] = i == j ? 1.0 : 0.0;
        so2_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 1; ++row) {
        double *e = frame + 1 * row;
        int longest = 0;
        for (int i = 1; i < 1; ++i)
            if (so2_norm(p, left[i]) > so2_norm(p, left[longest])) longest = i;
        const double length = so2_norm(p, left[longest]);
        for (int j = 0; j < 1; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 1; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 1];
            const double part = so2_inner(p, e, rest);
            for (int j = 0; j < 1; ++j) rest[j] -= part * e[j];
        }
    }
}

/* x, periodic coordinates wrapped */
void so2_project_f(const float *SO2_RESTRICT x, float *SO2_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[0]);
    const float p0 = x[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    p_out[0] = p0;
}

void so2_project_batch_f(size_t count, const float *SO2_RESTRICT x, float *SO2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so2_project_f(x + 1 * i, p_out + 1 * i);
}

/* x */
void so2_to_tangent_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT x, float *SO2_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
}

void so2_to_tangent_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT x,
    float *SO2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so2_to_tangent_f(p + 1 * i, x + 1 * i, v_out + 1 * i);
}

/* dot(u, v) */
float so2_inner_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT u, const float *SO2_RESTRICT v) {
    (void)p;
    return u[0] * v[0];
}

void so2_inner_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT u,
    const float *SO2_RESTRICT v,
    float *SO2_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = so2_inner_f(p + 1 * i, u + 1 * i, v + 1 * i);
}

/* sqrt(<v, v>_p) */
float so2_norm_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT v) {
    (void)p;
    return fabsf(v[0]);
}

void so2_norm_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT v,
    float *SO2_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = so2_norm_f(p + 1 * i, v + 1 * i);
}

/* G(p) v */
void so2_flat_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT v, float *SO2_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
}

void so2_flat_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT v,
    float *SO2_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) so2_flat_f(p + 1 * i, v + 1 * i, covector_out + 1 * i);
}

/* wrap(p + v) */
void so2_exp_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT v, float *SO2_RESTRICT q_out) {
    const float total_2 = p[0] + v[0];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q0 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    q_out[0] = q0;
}

void so2_exp_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT v,
    float *SO2_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) so2_exp_f(p + 1 * i, v + 1 * i, q_out + 1 * i);
}

/* wrap(q - p) */
void so2_log_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT q, float *SO2_RESTRICT v_out) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    v_out[0] = v0;
}

void so2_log_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT q,
    float *SO2_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) so2_log_f(p + 1 * i, q + 1 * i, v_out + 1 * i);
}

/* |Log_p(q)|_p */
float so2_distance_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT q) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    return fabsf(log0);
}

void so2_distance_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT q,
    float *SO2_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = so2_distance_f(p + 1 * i, q + 1 * i);
}

/* 0 */
float so2_log_abs_det_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void so2_log_abs_det_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT q,
    float *SO2_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = so2_log_abs_det_f(p + 1 * i, q + 1 * i);
}

/* G(p)^-1 df */
void so2_riemannian_gradient_f(
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT df,
    float *SO2_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
}

void so2_riemannian_gradient_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT df,
    float *SO2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so2_riemannian_gradient_f(p + 1 * i, df + 1 * i, gradient_out + 1 * i);
}

/* |grad f|_p */
float so2_gradient_norm_f(const float *SO2_RESTRICT p, const float *SO2_RESTRICT df) {
    (void)p;
    return fabsf(df[0]);
}

void so2_gradient_norm_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT df,
    float *SO2_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = so2_gradient_norm_f(p + 1 * i, df + 1 * i);
}

/* v */
void so2_transport_f(
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT q,
    const float *SO2_RESTRICT v,
    float *SO2_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
}

void so2_transport_batch_f(
    size_t count,
    const float *SO2_RESTRICT p,
    const float *SO2_RESTRICT q,
    const float *SO2_RESTRICT v,
    float *SO2_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) so2_transport_f(p + 1 * i, q + 1 * i, v + 1 * i, w_out + 1 * i);
}

/* wrap(2 * pi * uniform) */
void so2_sample_f(
    const float *SO2_RESTRICT normal,
    const float *SO2_RESTRICT uniform,
    float *SO2_RESTRICT p_out) {
    (void)normal;
    const float round_2 = rintf(uniform[0]);
    const float p0 = 6.283185307179586f * uniform[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    p_out[0] = p0;
}

void so2_sample_batch_f(
    size_t count,
    const float *SO2_RESTRICT normal,
    const float *SO2_RESTRICT uniform,
    float *SO2_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) so2_sample_f(normal + 1 * i, uniform + 1 * i, p_out + 1 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void so2_splat_f(
    const float *SO2_RESTRICT x,
    const float *SO2_RESTRICT mu,
    const float *SO2_RESTRICT W,
    float amplitude,
    float *SO2_RESTRICT value_out,
    float *SO2_RESTRICT gradient_out) {
    const float gap = x[0] - mu[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float z0 = W[0] * v0;
    const float phi = amplitude * expf(-(0.5f * (z0 * z0)));
    const float df0 = -(phi * (W[0] * z0));
    value_out[0] = phi;
    gradient_out[0] = df0;
}

void so2_splat_batch_f(
    size_t count,
    const float *SO2_RESTRICT x,
    const float *SO2_RESTRICT mu,
    const float *SO2_RESTRICT W,
    const float *SO2_RESTRICT amplitude,
    float *SO2_RESTRICT value_out,
    float *SO2_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) so2_splat_f(x + 1 * i, mu + 1 * i, W + 1 * i, amplitude[i], value_out + i, gradient_out + 1 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void so2_frame_f(const float *SO2_RESTRICT p, float *SO2_RESTRICT frame) {
    float left[1][1];
    for (int i = 0; i < 1; ++i) {
        float axis[1];
        for (int j = 0; j < 1; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        so2_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 1; ++row) {
        float *e = frame + 1 * row;
        int longest = 0;
        for (int i = 1; i < 1; ++i)
            if (so2_norm_f(p, left[i]) > so2_norm_f(p, left[longest])) longest = i;
        const float length = so2_norm_f(p, left[longest]);
        for (int j = 0; j < 1; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 1; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 1];
            const float part = so2_inner_f(p, e, rest);
            for (int j = 0; j < 1; ++j) rest[j] -= part * e[j];
        }
    }
}
