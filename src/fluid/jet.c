#include "fluid/jet.h"

#include "base/transcendental.h"

#include <math.h>

/* The jet is looked at up to so many widths C x from its core's edge: U^2 is 0.2 % of that on the axis there. */
static const double EDGE = 2.5;
/* A mean speed under this counts as none [m/s]: close to a propeller the edges of its jet fall below all numbers. */
static const double STILL = 1e-6;

void jet_set_thrust(jet *j, double thrust, double diameter, double advance, double density)
{
    double area = 0.25 * PI * diameter * diameter;
    j->speed = sqrt(advance * advance + 2 * thrust / (density * area)) - advance;
    j->diameter = diameter * sqrt(0.5);
}

static double core_end(const jet *j) { return 0.5 * j->diameter / j->spread; }

/* Radius of the core where the jet has the width s = C x: that with which the momentum flux, U0^2 pi (a^2 + sqrt(pi) a
   s + s^2), is still the one it began with.  Within 6 % of Albertson's straight line D0 / 2 - s of the momentum. */
static double core_radius(const jet *j, double x)
{
    double s = j->spread * x, full = j->diameter * j->diameter - (4 - PI) * s * s;
    return x < core_end(j) ? 0.5 * (sqrt(full) - sqrt(PI) * s) : 0;
}

double jet_speed(const jet *j, double x, double r)
{
    if (!(x > 0))
        return 0;
    double off = fmax(r - core_radius(j, x), 0) / (j->spread * x), end = core_end(j);
    return j->speed * (x < end ? 1 : end / x) * real_exp(-0.5 * off * off);
}

/* Extent of an outline in the jet's axes. */
static box2 bounds_in(const jet *j, polygon outline, vec3 centre, mat3 rotation)
{
    box2 box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    vec2 port = vec2_perp(j->along);
    for (int32_t i = 0; i < outline.count; i++) {
        vec3 p = mat3_mul_vec(rotation, vec3_make(outline.vertex[i].x, outline.vertex[i].y, 0));
        vec2 off = {centre.x + p.x - j->origin.x, centre.y + p.y - j->origin.y};
        double x = vec2_dot(off, j->along), y = vec2_dot(off, port);
        box.lo = vec2_make(fmin(box.lo.x, x), fmin(box.lo.y, y));
        box.hi = vec2_make(fmax(box.hi.x, x), fmax(box.hi.y, y));
    }
    return box;
}

/* One plate under a jet, and the sums over it. */
typedef struct jet_sum {
    const jet *j;
    polygon outline;
    vec3 centre;
    mat3 rotation;
    box2 box;
    double height; /* over the axis [m] */
    double square; /* of U^2 [m4/s2] */
    vec3 first;    /* of U^2 times the place */
} jet_sum;

static void add_point(jet_sum *sum, double x, double y, double cell)
{
    vec2 port = vec2_perp(sum->j->along), a = sum->j->along;
    vec3 arm = {sum->j->origin.x + x * a.x + y * port.x - sum->centre.x,
                sum->j->origin.y + x * a.y + y * port.y - sum->centre.y, 0};
    vec3 own = mat3_tmul_vec(sum->rotation, arm);
    if (!polygon_contains(sum->outline, vec2_make(own.x, own.y)))
        return;
    double u = jet_speed(sum->j, x, sqrt(y * y + sum->height * sum->height)), weight = u * u * cell;
    sum->square += weight;
    sum->first = vec3_mad(sum->first, arm, weight);
}

/* Across the jet at x, where the plate and the jet are. */
static void add_row(jet_sum *sum, double x, double length)
{
    double half = core_radius(sum->j, x) + EDGE * sum->j->spread * x;
    double lo = fmax(sum->box.lo.y, -half), hi = fmin(sum->box.hi.y, half), step = (hi - lo) / JET_GRID;
    if (!(step > 0) || fabs(sum->height) > half)
        return;
    for (int i = 0; i < JET_GRID; i++)
        add_point(sum, x, lo + (i + 0.5) * step, step * length);
}

jet_share jet_over(const jet *j, polygon outline, vec3 centre, mat3 rotation, double rise)
{
    jet_sum sum = {j, outline, centre, rotation, bounds_in(j, outline, centre, rotation), 0, 0, {0, 0, 0}};
    sum.height = centre.z + rise - j->origin.z;
    /* Rows stand at equal steps of log(x + x0), in which the jet changes evenly. */
    double near = fmax(sum.box.lo.x, 0), far = fmin(sum.box.hi.x, j->length), end = core_end(j);
    if (!(near < far) || !(j->speed > 0))
        return (jet_share){0, {0, 0, 0}};
    double first = real_log(near + end), step = (real_log(far + end) - first) / JET_GRID, edge = near;
    for (int i = 0; i < JET_GRID; i++) {
        double next = i + 1 < JET_GRID ? real_exp(first + (i + 1) * step) - end : far;
        add_row(&sum, 0.5 * (edge + next), next - edge);
        edge = next;
    }
    double area = polygon_area(outline);
    if (!(sum.square > STILL * STILL * area))
        return (jet_share){0, {0, 0, 0}};
    return (jet_share){sqrt(sum.square / area), vec3_scale(sum.first, 1 / sum.square)};
}
