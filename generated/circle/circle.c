/*
 * circle: The unit circle in R^2; tangent vectors are one number, the angle in radians, counterclockwise.
 *
 * See the header for what the functions promise.
 */

#include "circle.h"

#include <float.h>

/* p / norm(p) */
void circle_project(const double *CIRCLE_RESTRICT x, double *CIRCLE_RESTRICT p_out) {
    const double norm_p_squared = x[0] * x[0] + x[1] * x[1];
    const double norm_p = sqrt(norm_p_squared);
    const double scale = 1.0 / norm_p;
    const double p0 = x[0] * scale;
    const double p1 = x[1] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
}

void circle_project_batch(size_t count, const double *CIRCLE_RESTRICT x, double *CIRCLE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) circle_project(x + 2 * i, p_out + 2 * i);
}

/* (E E^T)^-1 E x */
void circle_to_tangent(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT x,
    double *CIRCLE_RESTRICT v_out) {
    const double v0 = p[0] * x[1] - p[1] * x[0];
    v_out[0] = v0;
}

void circle_to_tangent_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT x,
    double *CIRCLE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) circle_to_tangent(p + 2 * i, x + 2 * i, v_out + 1 * i);
}

/* dot(u, v) */
double circle_inner(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT u,
    const double *CIRCLE_RESTRICT v) {
    (void)p;
    return u[0] * v[0];
}

void circle_inner_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT u,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = circle_inner(p + 2 * i, u + 1 * i, v + 1 * i);
}

/* sqrt(<v, v>_p) */
double circle_norm(const double *CIRCLE_RESTRICT p, const double *CIRCLE_RESTRICT v) {
    (void)p;
    return fabs(v[0]);
}

void circle_norm_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = circle_norm(p + 2 * i, v + 1 * i);
}

/* G(p) v */
void circle_flat(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
}

void circle_flat_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) circle_flat(p + 2 * i, v + 1 * i, covector_out + 1 * i);
}

/* [cos(v[0]) * p[0] - sin(v[0]) * p[1], sin(v[0]) * p[0] + cos(v[0]) * p[1]] */
void circle_exp(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT q_out) {
    const double cos_v0 = cos(v[0]);
    const double sin_v0 = sin(v[0]);
    const double q0 = p[0] * cos_v0 - p[1] * sin_v0;
    const double q1 = p[1] * cos_v0 + p[0] * sin_v0;
    q_out[0] = q0;
    q_out[1] = q1;
}

void circle_exp_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) circle_exp(p + 2 * i, v + 1 * i, q_out + 2 * i);
}

/* [t] */
void circle_log(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT q,
    double *CIRCLE_RESTRICT v_out) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double s = p[0] * d1 - p[1] * d0;
    const double dot_p_q = p[0] * q[0] + p[1] * q[1];
    const double t = atan2(s, dot_p_q);
    v_out[0] = t;
}

void circle_log_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT q,
    double *CIRCLE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) circle_log(p + 2 * i, q + 2 * i, v_out + 1 * i);
}

/* abs(t) */
double circle_distance(const double *CIRCLE_RESTRICT p, const double *CIRCLE_RESTRICT q) {
    const double d0 = q[0] - p[0];
    const double d1 = q[1] - p[1];
    const double s = p[0] * d1 - p[1] * d0;
    const double dot_p_q = p[0] * q[0] + p[1] * q[1];
    const double t = atan2(s, dot_p_q);
    const double abs_t = fabs(t);
    return abs_t;
}

void circle_distance_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT q,
    double *CIRCLE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = circle_distance(p + 2 * i, q + 2 * i);
}

/* 0 */
double circle_log_abs_det(const double *CIRCLE_RESTRICT p, const double *CIRCLE_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0;
}

void circle_log_abs_det_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT q,
    double *CIRCLE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = circle_log_abs_det(p + 2 * i, q + 2 * i);
}

/* G^-1 E df */
void circle_riemannian_gradient(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT df,
    double *CIRCLE_RESTRICT gradient_out) {
    const double gradient0 = p[0] * df[1] - p[1] * df[0];
    gradient_out[0] = gradient0;
}

void circle_riemannian_gradient_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT df,
    double *CIRCLE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) circle_riemannian_gradient(p + 2 * i, df + 2 * i, gradient_out + 1 * i);
}

/* |grad f|_p */
double circle_gradient_norm(const double *CIRCLE_RESTRICT p, const double *CIRCLE_RESTRICT df) {
    const double gradient0 = p[0] * df[1] - p[1] * df[0];
    return fabs(gradient0);
}

void circle_gradient_norm_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT df,
    double *CIRCLE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = circle_gradient_norm(p + 2 * i, df + 2 * i);
}

/* v */
void circle_transport(
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT q,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
}

void circle_transport_batch(
    size_t count,
    const double *CIRCLE_RESTRICT p,
    const double *CIRCLE_RESTRICT q,
    const double *CIRCLE_RESTRICT v,
    double *CIRCLE_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) circle_transport(p + 2 * i, q + 2 * i, v + 1 * i, w_out + 1 * i);
}

/* normal / norm(normal) */
void circle_sample(
    const double *CIRCLE_RESTRICT normal,
    const double *CIRCLE_RESTRICT uniform,
    double *CIRCLE_RESTRICT p_out) {
    (void)uniform;
    const double norm_normal_squared = normal[0] * normal[0] + normal[1] * normal[1];
    const double norm_normal = sqrt(norm_normal_squared);
    const double scale = 1.0 / norm_normal;
    const double p0 = normal[0] * scale;
    const double p1 = normal[1] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
}

void circle_sample_batch(
    size_t count,
    const double *CIRCLE_RESTRICT normal,
    const double *CIRCLE_RESTRICT uniform,
    double *CIRCLE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) circle_sample(normal + 2 * i, uniform + 2 * i, p_out + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void circle_splat(
    const double *CIRCLE_RESTRICT x,
    const double *CIRCLE_RESTRICT mu,
    const double *CIRCLE_RESTRICT W,
    double amplitude,
    double *CIRCLE_RESTRICT value_out,
    double *CIRCLE_RESTRICT gradient_out) {
    const double d0 = x[0] - mu[0];
    const double d1 = x[1] - mu[1];
    const double s = mu[0] * d1 - mu[1] * d0;
    const double dot_p_q = x[0] * mu[0] + x[1] * mu[1];
    const double t = atan2(s, dot_p_q);
    const double z0 = W[0] * t;
    const double phi = amplitude * exp(-(0.5 * (z0 * z0)));
    const double ratio = W[0] * z0 / (dot_p_q * dot_p_q + s * s);
    const double dot_p_q_product = dot_p_q * ratio;
    const double by_dot_p_q = s * ratio;
    const double by_d0 = mu[1] * dot_p_q_product;
    const double exponent_by_x1 = mu[1] * by_dot_p_q - mu[0] * dot_p_q_product;
    const double exponent_by_x0 = mu[0] * by_dot_p_q + by_d0;
    const double df0 = phi * exponent_by_x0;
    const double df1 = phi * exponent_by_x1;
    const double gradient0 = x[0] * df1 - x[1] * df0;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
}

void circle_splat_batch(
    size_t count,
    const double *CIRCLE_RESTRICT x,
    const double *CIRCLE_RESTRICT mu,
    const double *CIRCLE_RESTRICT W,
    const double *CIRCLE_RESTRICT amplitude,
    double *CIRCLE_RESTRICT value_out,
    double *CIRCLE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) circle_splat(x + 2 * i, mu + 2 * i, W + 1 * i, amplitude[i], value_out + i, gradient_out + 1 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void circle_frame(const double *CIRCLE_RESTRICT p, double *CIRCLE_RESTRICT frame) {
    double left[2][1];
    for (int i = 0; i < 2; ++i) {
        double axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0 : 0.0;
        circle_to_tangent(p, axis, left[i]);
    }
    for (int row = 0; row < 1; ++row) {
        double *e = frame + 1 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (circle_norm(p, left[i]) > circle_norm(p, left[longest])) longest = i;
        const double length = circle_norm(p, left[longest]);
        for (int j = 0; j < 1; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            double *rest = left[i % 2];
            const double part = circle_inner(p, e, rest);
            for (int j = 0; j < 1; ++j) rest[j] -= part * e[j];
        }
    }
}

/* p / norm(p) */
void circle_project_f(const float *CIRCLE_RESTRICT x, float *CIRCLE_RESTRICT p_out) {
    const float norm_p_squared = x[0] * x[0] + x[1] * x[1];
    const float norm_p = sqrtf(norm_p_squared);
    const float scale = 1.0f / norm_p;
    const float p0 = x[0] * scale;
    const float p1 = x[1] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
}

void circle_project_batch_f(size_t count, const float *CIRCLE_RESTRICT x, float *CIRCLE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) circle_project_f(x + 2 * i, p_out + 2 * i);
}

/* (E E^T)^-1 E x */
void circle_to_tangent_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT x,
    float *CIRCLE_RESTRICT v_out) {
    const float v0 = p[0] * x[1] - p[1] * x[0];
    v_out[0] = v0;
}

void circle_to_tangent_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT x,
    float *CIRCLE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) circle_to_tangent_f(p + 2 * i, x + 2 * i, v_out + 1 * i);
}

/* dot(u, v) */
float circle_inner_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT u,
    const float *CIRCLE_RESTRICT v) {
    (void)p;
    return u[0] * v[0];
}

void circle_inner_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT u,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT inner_out) {
    for (size_t i = 0; i < count; ++i) inner_out[i] = circle_inner_f(p + 2 * i, u + 1 * i, v + 1 * i);
}

/* sqrt(<v, v>_p) */
float circle_norm_f(const float *CIRCLE_RESTRICT p, const float *CIRCLE_RESTRICT v) {
    (void)p;
    return fabsf(v[0]);
}

void circle_norm_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT norm_out) {
    for (size_t i = 0; i < count; ++i) norm_out[i] = circle_norm_f(p + 2 * i, v + 1 * i);
}

/* G(p) v */
void circle_flat_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT covector_out) {
    (void)p;
    covector_out[0] = v[0];
}

void circle_flat_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT covector_out) {
    for (size_t i = 0; i < count; ++i) circle_flat_f(p + 2 * i, v + 1 * i, covector_out + 1 * i);
}

/* [cos(v[0]) * p[0] - sin(v[0]) * p[1], sin(v[0]) * p[0] + cos(v[0]) * p[1]] */
void circle_exp_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT q_out) {
    const float cos_v0 = cosf(v[0]);
    const float sin_v0 = sinf(v[0]);
    const float q0 = p[0] * cos_v0 - p[1] * sin_v0;
    const float q1 = p[1] * cos_v0 + p[0] * sin_v0;
    q_out[0] = q0;
    q_out[1] = q1;
}

void circle_exp_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT q_out) {
    for (size_t i = 0; i < count; ++i) circle_exp_f(p + 2 * i, v + 1 * i, q_out + 2 * i);
}

/* [t] */
void circle_log_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT q,
    float *CIRCLE_RESTRICT v_out) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float s = p[0] * d1 - p[1] * d0;
    const float dot_p_q = p[0] * q[0] + p[1] * q[1];
    const float t = atan2f(s, dot_p_q);
    v_out[0] = t;
}

void circle_log_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT q,
    float *CIRCLE_RESTRICT v_out) {
    for (size_t i = 0; i < count; ++i) circle_log_f(p + 2 * i, q + 2 * i, v_out + 1 * i);
}

/* abs(t) */
float circle_distance_f(const float *CIRCLE_RESTRICT p, const float *CIRCLE_RESTRICT q) {
    const float d0 = q[0] - p[0];
    const float d1 = q[1] - p[1];
    const float s = p[0] * d1 - p[1] * d0;
    const float dot_p_q = p[0] * q[0] + p[1] * q[1];
    const float t = atan2f(s, dot_p_q);
    const float abs_t = fabsf(t);
    return abs_t;
}

void circle_distance_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT q,
    float *CIRCLE_RESTRICT distance_out) {
    for (size_t i = 0; i < count; ++i) distance_out[i] = circle_distance_f(p + 2 * i, q + 2 * i);
}

/* 0 */
float circle_log_abs_det_f(const float *CIRCLE_RESTRICT p, const float *CIRCLE_RESTRICT q) {
    (void)p;
    (void)q;
    return 0.0f;
}

void circle_log_abs_det_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT q,
    float *CIRCLE_RESTRICT log_abs_det_out) {
    for (size_t i = 0; i < count; ++i) log_abs_det_out[i] = circle_log_abs_det_f(p + 2 * i, q + 2 * i);
}

/* G^-1 E df */
void circle_riemannian_gradient_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT df,
    float *CIRCLE_RESTRICT gradient_out) {
    const float gradient0 = p[0] * df[1] - p[1] * df[0];
    gradient_out[0] = gradient0;
}

void circle_riemannian_gradient_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT df,
    float *CIRCLE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) circle_riemannian_gradient_f(p + 2 * i, df + 2 * i, gradient_out + 1 * i);
}

/* |grad f|_p */
float circle_gradient_norm_f(const float *CIRCLE_RESTRICT p, const float *CIRCLE_RESTRICT df) {
    const float gradient0 = p[0] * df[1] - p[1] * df[0];
    return fabsf(gradient0);
}

void circle_gradient_norm_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT df,
    float *CIRCLE_RESTRICT gradient_norm_out) {
    for (size_t i = 0; i < count; ++i) gradient_norm_out[i] = circle_gradient_norm_f(p + 2 * i, df + 2 * i);
}

/* v */
void circle_transport_f(
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT q,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT w_out) {
    (void)p;
    (void)q;
    w_out[0] = v[0];
}

void circle_transport_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT p,
    const float *CIRCLE_RESTRICT q,
    const float *CIRCLE_RESTRICT v,
    float *CIRCLE_RESTRICT w_out) {
    for (size_t i = 0; i < count; ++i) circle_transport_f(p + 2 * i, q + 2 * i, v + 1 * i, w_out + 1 * i);
}

/* normal / norm(normal) */
void circle_sample_f(
    const float *CIRCLE_RESTRICT normal,
    const float *CIRCLE_RESTRICT uniform,
    float *CIRCLE_RESTRICT p_out) {
    (void)uniform;
    const float norm_normal_squared = normal[0] * normal[0] + normal[1] * normal[1];
    const float norm_normal = sqrtf(norm_normal_squared);
    const float scale = 1.0f / norm_normal;
    const float p0 = normal[0] * scale;
    const float p1 = normal[1] * scale;
    p_out[0] = p0;
    p_out[1] = p1;
}

void circle_sample_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT normal,
    const float *CIRCLE_RESTRICT uniform,
    float *CIRCLE_RESTRICT p_out) {
    for (size_t i = 0; i < count; ++i) circle_sample_f(normal + 2 * i, uniform + 2 * i, p_out + 2 * i);
}

/* amplitude * exp(-|W Log_mu(x)|^2 / 2) * |det D Log_mu(x)| */
void circle_splat_f(
    const float *CIRCLE_RESTRICT x,
    const float *CIRCLE_RESTRICT mu,
    const float *CIRCLE_RESTRICT W,
    float amplitude,
    float *CIRCLE_RESTRICT value_out,
    float *CIRCLE_RESTRICT gradient_out) {
    const float d0 = x[0] - mu[0];
    const float d1 = x[1] - mu[1];
    const float s = mu[0] * d1 - mu[1] * d0;
    const float dot_p_q = x[0] * mu[0] + x[1] * mu[1];
    const float t = atan2f(s, dot_p_q);
    const float z0 = W[0] * t;
    const float phi = amplitude * expf(-(0.5f * (z0 * z0)));
    const float ratio = W[0] * z0 / (dot_p_q * dot_p_q + s * s);
    const float dot_p_q_product = dot_p_q * ratio;
    const float by_dot_p_q = s * ratio;
    const float by_d0 = mu[1] * dot_p_q_product;
    const float exponent_by_x1 = mu[1] * by_dot_p_q - mu[0] * dot_p_q_product;
    const float exponent_by_x0 = mu[0] * by_dot_p_q + by_d0;
    const float df0 = phi * exponent_by_x0;
    const float df1 = phi * exponent_by_x1;
    const float gradient0 = x[0] * df1 - x[1] * df0;
    value_out[0] = phi;
    gradient_out[0] = gradient0;
}

void circle_splat_batch_f(
    size_t count,
    const float *CIRCLE_RESTRICT x,
    const float *CIRCLE_RESTRICT mu,
    const float *CIRCLE_RESTRICT W,
    const float *CIRCLE_RESTRICT amplitude,
    float *CIRCLE_RESTRICT value_out,
    float *CIRCLE_RESTRICT gradient_out) {
    for (size_t i = 0; i < count; ++i) circle_splat_f(x + 2 * i, mu + 2 * i, W + 1 * i, amplitude[i], value_out + i, gradient_out + 1 * i);
}

/* Gram-Schmidt in the metric, always on the longest of what is left of the projected axes. */
void circle_frame_f(const float *CIRCLE_RESTRICT p, float *CIRCLE_RESTRICT frame) {
    float left[2][1];
    for (int i = 0; i < 2; ++i) {
        float axis[2];
        for (int j = 0; j < 2; ++j) axis[j] = i == j ? 1.0f : 0.0f;
        circle_to_tangent_f(p, axis, left[i]);
    }
    for (int row = 0; row < 1; ++row) {
        float *e = frame + 1 * row;
        int longest = 0;
        for (int i = 1; i < 2; ++i)
            if (circle_norm_f(p, left[i]) > circle_norm_f(p, left[longest])) longest = i;
        const float length = circle_norm_f(p, left[longest]);
        for (int j = 0; j < 1; ++j) e[j] = left[longest][j] / length;
        for (int i = 0; i < 2 * 2; ++i) { /* twice, for what rounding leaves of the first subtraction */
            float *rest = left[i % 2];
            const float part = circle_inner_f(p, e, rest);
            for (int j = 0; j < 1; ++j) rest[j] -= part * e[j];
        }
    }
}
