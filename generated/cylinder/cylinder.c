/*
 * cylinder: The flat cylinder of a radius, as (angle, height); the angle in radians modulo 2 pi, the height in
 *
 * See the header for what the functions promise.
 */

#include "cylinder.h"

#include <float.h>

/* x, periodic coordinates wrapped */
void cylinder_project(const double *CYLINDER_RESTRICT x, double *CYLINDER_RESTRICT p_out) {
    const double round_2 = rint(0.15915494309189535 * x[0]);
    const double p0 = x[0] - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    p_out[0] = p0;
    p_out[1] = x[1];
}

void cylinder_project_batch(size_t count, const double *CYLINDER_RESTRICT x, double *CYLINDER_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) cylinder_project(x + 2 * i, p_out + 2 * i);
}

/* x */
void cylinder_to_tangent(
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT x,
    double *CYLINDER_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void cylinder_to_tangent_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT x,
    double *CYLINDER_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) cylinder_to_tangent(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* radius^2 * u[0] * v[0] + u[1] * v[1] */
double cylinder_inner(
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT u,
    const double *CYLINDER_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1];
}

void cylinder_inner_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT u,
    const double *CYLINDER_RESTRICT v,
    double *CYLINDER_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = cylinder_inner(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
double cylinder_norm(const double *CYLINDER_RESTRICT p, const double *CYLINDER_RESTRICT v) {
    (void)p;
    return sqrt(v[0] * v[0] + v[1] * v[1]);
}

void cylinder_norm_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT v,
    double *CYLINDER_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = cylinder_norm(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void cylinder_flat(
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT v,
    double *CYLINDER_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
}

void cylinder_flat_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT v,
    double *CYLINDER_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) cylinder_flat(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* [wrap(p[0] + v[0]), p[1] + v[1]] */
void cylinder_exp(
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT v,
    double *CYLINDER_RESTRICT q_out) {
    const double total_2 = p[0] + v[0];
    const double round_2 = rint(0.15915494309189535 * total_2);
    const double q0 = total_2 - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double q1 = p[1] + v[1];
    q_out[0] = q0;
    q_out[1] = q1;
}

void cylinder_exp_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT v,
    double *CYLINDER_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) cylinder_exp(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* [wrap(q[0] - p[0]), q[1] - p[1]] */
void cylinder_log(
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT q,
    double *CYLINDER_RESTRICT v_out) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double v1 = q[1] - p[1];
    v_out[0] = v0;
    v_out[1] = v1;
}

void cylinder_log_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT q,
    double *CYLINDER_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) cylinder_log(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* |Log_p(q)|_p */
double cylinder_distance(const double *CYLINDER_RESTRICT p, const double *CYLINDER_RESTRICT q) {
    const double gap = q[0] - p[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double log0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double log1 = q[1] - p[1];
    return sqrt(log0 * log0 + log1 * log1);
}

void cylinder_distance_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT q,
    double *CYLINDER_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = cylinder_distance(p + 2 * i, q + 2 * i);
}

/* 0 */
double cylinder_log_abs_det(const double *CYLINDER_RESTRICT p, const double *CYLINDER_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void cylinder_log_abs_det_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT q,
    double *CYLINDER_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = cylinder_log_abs_det(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void cylinder_riemannian_gradient(
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT df,
    double *CYLINDER_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
}

void cylinder_riemannian_gradient_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT df,
    double *CYLINDER_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) cylinder_riemannian_gradient(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
double cylinder_gradient_norm(const double *CYLINDER_RESTRICT p, const double *CYLINDER_RESTRICT df) {
    (void)p;
    return sqrt(df[0] * df[0] + df[1] * df[1]);
}

void cylinder_gradient_norm_batch(
    size_t count,
    const double *CYLINDER_RESTRICT p,
    const double *CYLINDER_RESTRICT df,
    double *CYLINDER_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = cylinder_gradient_norm(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void cylinder_splat(
    const double *CYLINDER_RESTRICT x,
    const double *CYLINDER_RESTRICT mu,
    const double *CYLINDER_RESTRICT W,
    double amplitude,
    double *CYLINDER_RESTRICT value_out,
    double *CYLINDER_RESTRICT gradient_out) {
    const double gap = x[0] - mu[0];
    const double round_2 = rint(0.15915494309189535 * gap);
    const double v0 = gap - 6.28125 * round_2 - 0.001935307179586477 * round_2;
    const double v1 = x[1] - mu[1];
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

void cylinder_splat_batch(
    size_t count,
    const double *CYLINDER_RESTRICT x,
    const double *CYLINDER_RESTRICT mu,
    const double *CYLINDER_RESTRICT W,
    const double *CYLINDER_RESTRICT amplitude,
    double *CYLINDER_RESTRICT value_out,
    double *CYLINDER_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) cylinder_splat(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void cylinder_frame(const double *CYLINDER_RESTRICT p, double *CYLINDER_RESTRICT frame) {
    double left[2][2];
    for (int i = 0; i < 2; ++i) {
        double axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0 : 0.0;
        cylinder_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        double *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (cylinder_norm(p, left[i]) > cylinder_norm(p, left[longest])) longest = i;
        const double length = cylinder_norm(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 2];
            const double part = cylinder_inner(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}

/* x, periodic coordinates wrapped */
void cylinder_project_f(const float *CYLINDER_RESTRICT x, float *CYLINDER_RESTRICT p_out) {
    const float round_2 = rintf(0.15915494309189535f * x[0]);
    const float p0 = x[0] - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    p_out[0] = p0;
    p_out[1] = x[1];
}

void cylinder_project_batch_f(size_t count, const float *CYLINDER_RESTRICT x, float *CYLINDER_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) cylinder_project_f(x + 2 * i, p_out + 2 * i);
}

/* x */
void cylinder_to_tangent_f(
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT x,
    float *CYLINDER_RESTRICT v_out) {
    (void)p;
    v_out[0] = x[0];
    v_out[1] = x[1];
}

void cylinder_to_tangent_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT x,
    float *CYLINDER_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) cylinder_to_tangent_f(p + 2 * i, x + 2 * i, v_out + 2 * i);
}

/* radius^2 * u[0] * v[0] + u[1] * v[1] */
float cylinder_inner_f(
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT u,
    const float *CYLINDER_RESTRICT v) {
    (void)p;
    return u[0] * v[0] + u[1] * v[1];
}

void cylinder_inner_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT u,
    const float *CYLINDER_RESTRICT v,
    float *CYLINDER_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = cylinder_inner_f(p + 2 * i, u + 2 * i, v + 2 * i);
}

/* sqrt(<v, v>_p) */
float cylinder_norm_f(const float *CYLINDER_RESTRICT p, const float *CYLINDER_RESTRICT v) {
    (void)p;
    return sqrtf(v[0] * v[0] + v[1] * v[1]);
}

void cylinder_norm_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT v,
    float *CYLINDER_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = cylinder_norm_f(p + 2 * i, v + 2 * i);
}

/* G(p) v */
void cylinder_flat_f(
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT v,
    float *CYLINDER_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
    covector_out[1] = v[1];
}

void cylinder_flat_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT v,
    float *CYLINDER_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) cylinder_flat_f(p + 2 * i, v + 2 * i, covector_out + 2 * i);
}

/* [wrap(p[0] + v[0]), p[1] + v[1]] */
void cylinder_exp_f(
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT v,
    float *CYLINDER_RESTRICT q_out) {
    const float total_2 = p[0] + v[0];
    const float round_2 = rintf(0.15915494309189535f * total_2);
    const float q0 = total_2 - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float q1 = p[1] + v[1];
    q_out[0] = q0;
    q_out[1] = q1;
}

void cylinder_exp_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT v,
    float *CYLINDER_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) cylinder_exp_f(p + 2 * i, v + 2 * i, q_out + 2 * i);
}

/* [wrap(q[0] - p[0]), q[1] - p[1]] */
void cylinder_log_f(
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT q,
    float *CYLINDER_RESTRICT v_out) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float v1 = q[1] - p[1];
    v_out[0] = v0;
    v_out[1] = v1;
}

void cylinder_log_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT q,
    float *CYLINDER_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) cylinder_log_f(p + 2 * i, q + 2 * i, v_out + 2 * i);
}

/* |Log_p(q)|_p */
float cylinder_distance_f(const float *CYLINDER_RESTRICT p, const float *CYLINDER_RESTRICT q) {
    const float gap = q[0] - p[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float log0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float log1 = q[1] - p[1];
    return sqrtf(log0 * log0 + log1 * log1);
}

void cylinder_distance_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT q,
    float *CYLINDER_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = cylinder_distance_f(p + 2 * i, q + 2 * i);
}

/* 0 */
float cylinder_log_abs_det_f(const float *CYLINDER_RESTRICT p, const float *CYLINDER_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void cylinder_log_abs_det_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT q,
    float *CYLINDER_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = cylinder_log_abs_det_f(p + 2 * i, q + 2 * i);
}

/* G(p)^-1 df */
void cylinder_riemannian_gradient_f(
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT df,
    float *CYLINDER_RESTRICT gradient_out) {
    (void)p;
    gradient_out[0] = df[0];
    gradient_out[1] = df[1];
}

void cylinder_riemannian_gradient_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT df,
    float *CYLINDER_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) cylinder_riemannian_gradient_f(p + 2 * i, df + 2 * i, gradient_out + 2 * i);
}

/* |grad f|_p */
float cylinder_gradient_norm_f(const float *CYLINDER_RESTRICT p, const float *CYLINDER_RESTRICT df) {
    (void)p;
    return sqrtf(df[0] * df[0] + df[1] * df[1]);
}

void cylinder_gradient_norm_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT p,
    const float *CYLINDER_RESTRICT df,
    float *CYLINDER_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = cylinder_gradient_norm_f(p + 2 * i, df + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void cylinder_splat_f(
    const float *CYLINDER_RESTRICT x,
    const float *CYLINDER_RESTRICT mu,
    const float *CYLINDER_RESTRICT W,
    float amplitude,
    float *CYLINDER_RESTRICT value_out,
    float *CYLINDER_RESTRICT gradient_out) {
    const float gap = x[0] - mu[0];
    const float round_2 = rintf(0.15915494309189535f * gap);
    const float v0 = gap - 6.28125f * round_2 - 0.001935307179586477f * round_2;
    const float v1 = x[1] - mu[1];
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

void cylinder_splat_batch_f(
    size_t count,
    const float *CYLINDER_RESTRICT x,
    const float *CYLINDER_RESTRICT mu,
    const float *CYLINDER_RESTRICT W,
    const float *CYLINDER_RESTRICT amplitude,
    float *CYLINDER_RESTRICT value_out,
    float *CYLINDER_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) cylinder_splat_f(x + 2 * i, mu + 2 * i, W + 4 * i, amplitude[i], value_out + i, gradient_out + 2 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void cylinder_frame_f(const float *CYLINDER_RESTRICT p, float *CYLINDER_RESTRICT frame) {
    float left[2][2];
    for (int i = 0; i < 2; ++i) {
        float axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        cylinder_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 2; ++row) {
        float *e = frame + 2 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (cylinder_norm_f(p, left[i]) > cylinder_norm_f(p, left[longest])) longest = i;
        const float length = cylinder_norm_f(p, left[longest]);
        for (int j = 0; j < 2; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 2];
            const float part = cylinder_inner_f(p, e, rest);
            for (int j = 0; j < 2; ++j) rest[j] -= part * e[j];
        }
    }
}
