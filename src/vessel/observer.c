#include "vessel/observer.h"

#include <string.h>

static vec3 place_error(vec3 measured, vec3 place)
{
    vec3 e = vec3_sub(measured, place);
    e.z = plane_angle(e.z);
    return e;
}

/* Part of a velocity that damping takes in a step of the model; what would take more is treated implicitly. */
#define EXPLICIT_DAMPING 0.25

/* From forces to accelerations over a step: M^-1, or (M + s D)^-1 where an explicit step of the damping would take more
   than its part of a velocity, and diverge where steps are long; s grows from 0 to the step. */
static mat3 mobility(const plane_model *m, double dt)
{
    mat3 inverse = mat3_inverse(m->mass), drag = mat3_mul(inverse, m->damping), whole = m->mass;
    double rate = drag.m[0][0] + drag.m[1][1] + drag.m[2][2]; /* the fastest is no more than the sum of all */
    if (!(dt * rate > EXPLICIT_DAMPING))
        return inverse;
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            whole.m[r][k] += (dt - EXPLICIT_DAMPING / rate) * m->damping.m[r][k];
    return mat3_inverse(whole);
}

/* A bias loses half of itself in a step at most. */
static double memory_of(double bias_time, double dt) { return fmax(bias_time, 2 * dt); }

/* What an error of the place adds to the rates of place, velocity and bias [1/s, 1/s2, 1/s3]. */
typedef struct passive_gains {
    double place, velocity, bias;
} passive_gains;

/* A triple pole at -w.  The step is explicit: it is that of the rates while w dt is small, rings as that grows, and
   diverges from 0.536 on. */
#define PASSIVE_SMALL_STEP 0.25

/* Beyond, the gains are those with which the error of the step has its triple pole at exp(-w dt): with v' = v + dt b -
   ..., x' = x + dt v' - ... it is that of q^3 + (g + dt h) q^2 + dt (h + dt k) q + dt^2 k, q = z - 1, of the gains
   g, h, k times dt. */
static passive_gains passive_gains_of(double w, double dt)
{
    if (w * dt <= PASSIVE_SMALL_STEP)
        return (passive_gains){3 * w, 3 * w * w, w * w * w};
    double a = 1 - real_exp(-w * dt);
    return (passive_gains){a * (3 - 3 * a + a * a) / dt, a * a * (3 - a) / (dt * dt), a * a * a / (dt * dt * dt)};
}

void passive_observer_step(const plane_model *m, const passive_tuning *tuning, motion_estimate *e, vec3 tau,
                           vec3 measured, double dt)
{
    const passive_gains gain = passive_gains_of(tuning->bandwidth, dt);
    double heading = e->place.z;
    vec3 error = place_error(measured, e->place), mass = plane_diagonal(m->mass);
    vec3 weighted = plane_times(mass, plane_to_vessel(heading, error));
    vec3 force = vec3_add(tau, plane_to_vessel(heading, e->bias));
    force = vec3_sub(force, mat3_mul_vec(m->damping, e->velocity));
    force = vec3_mad(force, weighted, gain.velocity);
    vec3 acceleration = mat3_mul_vec(mobility(m, dt), force);
    vec3 bias_rate = vec3_mad(plane_to_global(heading, vec3_scale(weighted, gain.bias)), e->bias,
                              -1 / memory_of(tuning->bias_time, dt));
    /* Semi-implicit: the new velocity moves the place. */
    e->bias = vec3_mad(e->bias, bias_rate, dt);
    e->velocity = vec3_mad(e->velocity, acceleration, dt);
    vec3 rate = vec3_mad(plane_to_global(heading, e->velocity), error, gain.place);
    e->place = vec3_mad(e->place, rate, dt);
}

/* ---- Kalman ---- */

enum { N = KALMAN_STATES };

static double component(vec3 v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/* `share` times the covariance of a bias that is uncertain by these standard deviations along and across the vessel,
   added in the global axes of the state: what a filter believes must not depend on where north is. */
static void add_bias(double heading, vec3 sd, double share, kalman_covariance *p)
{
    double c = real_cos(heading), s = real_sin(heading), x = sd.x * sd.x, y = sd.y * sd.y;
    const mat3 turned = {{{c * c * x + s * s * y, c * s * (x - y), 0},
                          {c * s * (x - y), s * s * x + c * c * y, 0},
                          {0, 0, sd.z * sd.z}}};
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            p->of[N * (6 + r) + 6 + k] += share * turned.m[r][k];
}

kalman_covariance kalman_begin(const kalman_tuning *tuning, double heading, vec3 speed, vec3 bias)
{
    kalman_covariance p;
    memset(&p, 0, sizeof p);
    for (int i = 0; i < 3; i++) {
        double place = component(tuning->measurement, i), rate = component(speed, i);
        p.of[N * i + i] = place * place;
        p.of[N * (3 + i) + 3 + i] = rate * rate;
    }
    add_bias(heading, bias, 1, &p);
    return p;
}

/* Jacobian of the step x -> x + dt f(x). */
static void step_jacobian(const plane_model *m, mat3 inverse, const kalman_tuning *tuning, const motion_estimate *e,
                          double dt, double f[N][N])
{
    double c = real_cos(e->place.z), s = real_sin(e->place.z);
    const mat3 rotation = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
    mat3 drag = mat3_mul(inverse, m->damping), push = mat3_mul(inverse, mat3_transpose(rotation));
    /* Derivatives by the heading of R velocity and of R^T bias. */
    vec3 v = e->velocity, b = e->bias;
    vec3 turned = vec3_make(-s * v.x - c * v.y, c * v.x - s * v.y, 0);
    vec3 pushed = mat3_mul_vec(inverse, vec3_make(-s * b.x + c * b.y, -c * b.x - s * b.y, 0));
    memset(f, 0, sizeof(double[N][N]));
    for (int r = 0; r < N; r++)
        f[r][r] = 1;
    for (int r = 0; r < 3; r++) {
        f[r][2] += dt * component(turned, r);
        f[3 + r][2] += dt * component(pushed, r);
        f[6 + r][6 + r] -= dt / memory_of(tuning->bias_time, dt);
        for (int k = 0; k < 3; k++) {
            f[r][3 + k] = dt * rotation.m[r][k];
            f[3 + r][3 + k] -= dt * drag.m[r][k];
            f[3 + r][6 + k] = dt * push.m[r][k];
        }
    }
}

/* p becomes f p f', symmetric to the bit. */
static void propagate(double f[N][N], kalman_covariance *p)
{
    double half[N][N];
    for (int r = 0; r < N; r++) {
        for (int k = 0; k < N; k++) {
            double sum = 0;
            for (int i = 0; i < N; i++)
                sum += f[r][i] * p->of[N * i + k];
            half[r][k] = sum;
        }
    }
    for (int r = 0; r < N; r++) {
        for (int k = r; k < N; k++) {
            double sum = 0;
            for (int i = 0; i < N; i++)
                sum += half[r][i] * f[k][i];
            p->of[N * r + k] = p->of[N * k + r] = sum;
        }
    }
}

/* Covariance of the velocity that white forces give in a second: M^-1 diag(force^2) M^-T, of the step's M. */
static void add_noise(mat3 inverse, const kalman_tuning *tuning, double dt, kalman_covariance *p)
{
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int i = 0; i < 3; i++) {
                double sd = component(tuning->force, i);
                sum += inverse.m[r][i] * inverse.m[k][i] * sd * sd;
            }
            p->of[N * (3 + r) + 3 + k] += dt * sum;
        }
    }
}

void kalman_predict(const plane_model *m, const kalman_tuning *tuning, motion_estimate *e, kalman_covariance *p,
                    vec3 tau, double dt)
{
    double f[N][N];
    mat3 inverse = mobility(m, dt);
    step_jacobian(m, inverse, tuning, e, dt, f);
    propagate(f, p);
    add_noise(inverse, tuning, dt, p);
    add_bias(e->place.z, tuning->bias, dt, p);
    vec3 force = vec3_add(tau, plane_to_vessel(e->place.z, e->bias));
    force = vec3_sub(force, mat3_mul_vec(m->damping, e->velocity));
    vec3 rate = plane_to_global(e->place.z, e->velocity);
    e->place = vec3_mad(e->place, rate, dt);
    e->velocity = vec3_mad(e->velocity, mat3_mul_vec(inverse, force), dt);
    e->bias = vec3_scale(e->bias, 1 - dt / memory_of(tuning->bias_time, dt));
}

void kalman_correct(const kalman_tuning *tuning, motion_estimate *e, kalman_covariance *p, vec3 measured)
{
    double x[N] = {e->place.x,    e->place.y, e->place.z, e->velocity.x, e->velocity.y,
                   e->velocity.z, e->bias.x,  e->bias.y,  e->bias.z};
    for (int i = 0; i < 3; i++) {
        double sd = component(tuning->measurement, i), variance = p->of[N * i + i] + sd * sd, gain[N], row[N];
        double miss = component(measured, i) - x[i];
        if (i == 2)
            miss = plane_angle(miss);
        if (!(variance > 0))
            continue;
        for (int k = 0; k < N; k++) {
            row[k] = p->of[N * i + k];
            gain[k] = row[k] / variance;
        }
        for (int r = 0; r < N; r++) {
            x[r] += gain[r] * miss;
            for (int k = 0; k < N; k++)
                p->of[N * r + k] -= row[r] * row[k] / variance;
        }
    }
    e->place = vec3_make(x[0], x[1], x[2]);
    e->velocity = vec3_make(x[3], x[4], x[5]);
    e->bias = vec3_make(x[6], x[7], x[8]);
}
