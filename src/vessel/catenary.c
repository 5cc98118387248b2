#include "vessel/catenary.h"

#include "base/transcendental.h"

#include <math.h>

/* Iterations are bounded by bisection: 200 halvings exhaust a double. */
enum { MOST_ITERATIONS = 200 };
/* Relative change at which an iteration is done. */
#define CONVERGED 1e-14

/* log(x + sqrt(x x + 1)), exact for small x too: with s = sqrt(x x + 1), asinh x = 2 atanh(x / (s + 1)), and the series
   of atanh where its argument is small. */
static double inverse_sinh(double x)
{
    double a = fabs(x);
    if (a < 0.05) {
        double t = a / (sqrt(a * a + 1) + 1), q = t * t;
        double value = 2 * t * (1 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7 + q * (1.0 / 9 + q / 11)))));
        return x < 0 ? -value : value;
    }
    double value = real_log(a + sqrt(a * a + 1));
    return x < 0 ? -value : value;
}

static double hypotenuse(double a, double b) { return sqrt(a * a + b * b); }

double catenary_tension(catenary_pull pull) { return hypotenuse(pull.horizontal, pull.vertical); }

/* sqrt(h h + v v) - h without cancellation. */
static double excess(double h, double v)
{
    double sum = hypotenuse(h, v) + h;
    return sum > 0 ? v * v / sum : 0;
}

/* Vertical pull of a line part of which lies on the bottom: height = (T - H) / w + V V / (2 w EA).  The height is
   convex in V, and Newton's method from the inextensible answer, which is too large, falls to the root. */
static double vertical_grounded(double weight, double softness, double height, double h)
{
    double lifted = weight * height;
    double v = sqrt(lifted * (lifted + 2 * h));
    if (softness == 0)
        return v;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        double miss = excess(h, v) + 0.5 * softness * v * v - lifted;
        double step = miss / (v / hypotenuse(h, v) + softness * v);
        if (!(v > 0) || !(step > CONVERGED * v))
            break;
        v -= step;
    }
    return v;
}

/* Height of the upper end of a line that hangs free, times the weight per metre. */
static double lift_hanging(double load, double softness, double h, double v)
{
    double below = v - load;
    double rise = (v + below) * load / (hypotenuse(h, v) + hypotenuse(h, below));
    return rise + softness * load * (v - 0.5 * load);
}

/* Vertical pull of a line that hangs free: the height grows with V; Newton's method in a bracket.  load = w L. */
static double vertical_hanging(double load, double softness, double lifted, double h)
{
    double low = load, high = 2 * load + h + lifted, v = load;
    for (int i = 0; i < MOST_ITERATIONS && lift_hanging(load, softness, h, high) < lifted; i++) {
        low = high;
        high *= 2;
        if (high > CATENARY_MOST)
            return CATENARY_MOST;
    }
    v = 0.5 * (low + high);
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        double miss = lift_hanging(load, softness, h, v) - lifted, below = v - load;
        if (miss > 0)
            high = v;
        else
            low = v;
        double slope = v / hypotenuse(h, v) - (h > 0 || below > 0 ? below / hypotenuse(h, below) : 0) + softness * load;
        double next = v - miss / slope;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        double step = fabs(next - v);
        v = next;
        if (step <= CONVERGED * v)
            break;
    }
    return v;
}

double catenary_distance(const catenary_line *line, double height, double horizontal, catenary_pull *pull)
{
    double h = horizontal, w = line->weight, softness = isfinite(line->stiffness) ? 1 / line->stiffness : 0;
    double load = w * line->length, lifted = w * height;
    double stretch = h * line->length * softness;
    pull->horizontal = h;
    if (excess(h, load) + 0.5 * softness * load * load >= lifted) {
        double v = vertical_grounded(w, softness, height, h);
        pull->vertical = v;
        return line->length - v / w + (h > 0 ? h / w * inverse_sinh(v / h) : 0) + stretch;
    }
    double v = vertical_hanging(load, softness, lifted, h);
    pull->vertical = v;
    return (h > 0 ? h / w * (inverse_sinh(v / h) - inverse_sinh((v - load) / h)) : 0) + stretch;
}

/* A pull at which the line reaches farther than `distance`; more than CATENARY_MOST: none. */
static double upper_bound(const catenary_line *line, double height, double distance, double from)
{
    catenary_pull pull;
    double high = from;
    while (high <= CATENARY_MOST && catenary_distance(line, height, high, &pull) < distance)
        high *= 8;
    return high;
}

catenary_pull catenary_solve(const catenary_line *line, double height, double distance, double guess)
{
    catenary_pull pull;
    if (catenary_distance(line, height, 0, &pull) >= distance)
        return pull;
    double scale = line->weight * (height + line->length), low = 0;
    double high = upper_bound(line, height, distance, guess > 0 ? 2 * guess : scale);
    if (high > CATENARY_MOST) {
        catenary_distance(line, height, CATENARY_MOST, &pull);
        return pull;
    }
    /* The regula falsi of Illinois (Dowell and Jarratt 1971) on the distance, halved now and then by its own rule. */
    double miss_low = catenary_distance(line, height, low, &pull) - distance;
    double miss_high = catenary_distance(line, height, high, &pull) - distance;
    double h = guess > 0 && guess < high ? guess : 0.5 * high;
    int side = 0;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        double miss = catenary_distance(line, height, h, &pull) - distance;
        if (miss == 0 || high - low <= CONVERGED * high)
            break;
        if (miss > 0) {
            high = h, miss_high = miss;
            miss_low *= side > 0 ? 0.5 : 1;
            side = 1;
        } else {
            low = h, miss_low = miss;
            miss_high *= side < 0 ? 0.5 : 1;
            side = -1;
        }
        double next = (low * miss_high - high * miss_low) / (miss_high - miss_low);
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        double step = fabs(next - h);
        h = next;
        if (step <= CONVERGED * h)
            break;
    }
    catenary_distance(line, height, h, &pull);
    return pull;
}

bool catenary_length_for(catenary_line line, double height, double distance, double tension, double *length)
{
    if (!(tension > line.weight * height) || !(tension < CATENARY_MOST))
        return false;
    /* The tension falls with the length; the shortest line of all is stretched far more than it bears. */
    double straight = hypotenuse(height, distance), low = 0, high = 2 * straight;
    double softness = isfinite(line.stiffness) ? 1 / line.stiffness : 0;
    low = straight / (1 + 2 * tension * softness) * (1 - 1e-9);
    for (int i = 0; i < MOST_ITERATIONS && high - low > 1e-13 * high; i++) {
        line.length = 0.5 * (low + high);
        if (catenary_tension(catenary_solve(&line, height, distance, 0)) > tension)
            low = line.length;
        else
            high = line.length;
    }
    *length = 0.5 * (low + high);
    line.length = *length;
    double found = catenary_tension(catenary_solve(&line, height, distance, 0));
    return fabs(found - tension) <= 1e-6 * tension;
}
