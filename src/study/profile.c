#include "study/profile.h"

#include "base/student.h"
#include "base/transcendental.h"
#include "study/minimise.h"

#include <math.h>
#include <string.h>

/* A level that is looked at, with the other parameters free. */
typedef struct profile_look {
    const profile_question *q;
    double level;
} profile_look;

/* Free parameters: the scale as log(scale/fitted), then the shape; of levels far out, in place of the scale, of LAW_GEV
   the location in fitted scales from the fitted one, of LAW_PARETO the rate of peaks as log(rate/found). */
static int free_count(law_kind kind) { return kind == LAW_GUMBEL || kind == LAW_WEIBULL ? 1 : 2; }

/* Expected exceedances a block, or a peak, under which a level is far out: about a scale and more over the location.
   There a little of the scale moves the location, or the rate, by much, and the way to the least cost along it is too
   narrow to follow. */
#define EXPONENT_FAR 0.35
static bool is_far(const profile_question *q)
{
    double exponent = q->exponent / q->exposure;
    return (q->law->kind == LAW_GEV && exponent < EXPONENT_FAR) ||
           (q->law->kind == LAW_PARETO && exponent < EXPONENT_FAR * q->count);
}

static bool is_peaks(law_kind kind) { return kind == LAW_PARETO || kind == LAW_WEIBULL; }

/* exponent = exposure x (expected exceedances a block): the law of maxima that has the level there. */
static double maxima_cost(const profile_look *at, double scale, double shape)
{
    const profile_question *q = at->q;
    extreme_law law = {q->law->kind, 0, scale, shape};
    law.location = at->level - extreme_law_level(&law, q->exponent / q->exposure);
    return extreme_law_cost(&law, q->sorted, q->count);
}

/* The rate of peaks, in peaks a sample, that makes the level the quantile; Poisson's likelihood of the number found. */
static double profile_pareto_cost(const profile_look *at, double scale, double shape)
{
    const profile_question *q = at->q;
    const extreme_law law = {LAW_PARETO, q->law->location, scale, shape};
    double rare = extreme_law_exponent(&law, at->level), rate = q->exponent / q->exposure * real_exp(rare);
    if (!isfinite(rate))
        return (double)INFINITY;
    return extreme_law_cost(&law, q->sorted, q->count) + rate - q->count * real_log(rate);
}

static double profile_weibull_cost(const profile_look *at, double shape)
{
    const profile_question *q = at->q;
    double peaks = q->exposure * q->count;
    const extreme_law unit = {LAW_WEIBULL, 0, 1, shape};
    const extreme_law law = {LAW_WEIBULL, q->law->location,
                             (at->level - q->law->location) / extreme_law_level(&unit, real_log(peaks / q->exponent)),
                             shape};
    return extreme_law_cost(&law, q->sorted, q->count);
}

/* The same of a level far out: by location and shape. */
static double far_cost(const profile_look *at, double location, double shape)
{
    const profile_question *q = at->q;
    const extreme_law unit = {LAW_GEV, 0, 1, shape};
    const extreme_law law = {LAW_GEV, location,
                             (at->level - location) / extreme_law_level(&unit, q->exponent / q->exposure), shape};
    return extreme_law_cost(&law, q->sorted, q->count);
}

/* By the rate of peaks, in those found, and the shape. */
static double far_pareto_cost(const profile_look *at, double part, double shape)
{
    const profile_question *q = at->q;
    const extreme_law unit = {LAW_PARETO, 0, 1, shape};
    double rate = part * q->count, rare = real_log(q->exposure * rate / q->exponent);
    if (!(rare > 0))
        return (double)INFINITY;
    const extreme_law law = {LAW_PARETO, q->law->location,
                             (at->level - q->law->location) / extreme_law_level(&unit, rare), shape};
    return extreme_law_cost(&law, q->sorted, q->count) + rate - q->count * real_log(rate);
}

static double profile_cost(const void *of, const double *x)
{
    const profile_look *at = of;
    const extreme_law *law = at->q->law;
    if (!(fabs(x[0]) < 50))
        return (double)INFINITY;
    if (law->kind == LAW_WEIBULL)
        return profile_weibull_cost(at, law->shape * real_exp(x[0]));
    double shape = free_count(law->kind) > 1 ? x[1] : 0;
    if (!(shape > SHAPE_LEAST && shape < PROFILE_SHAPE_MOST))
        return (double)INFINITY;
    if (is_far(at->q))
        return law->kind == LAW_PARETO ? far_pareto_cost(at, real_exp(x[0]), shape)
                                       : far_cost(at, law->location + law->scale * x[0], shape);
    double scale = law->scale * real_exp(x[0]);
    return law->kind == LAW_PARETO ? profile_pareto_cost(at, scale, shape) : maxima_cost(at, scale, shape);
}

static double level_of(const profile_question *q)
{
    const extreme_law *law = q->law;
    if (law->kind == LAW_GUMBEL || law->kind == LAW_GEV)
        return extreme_law_level(law, q->exponent / q->exposure);
    return extreme_law_level(law, real_log(q->exposure * q->count / q->exponent));
}

/* Cost at a level, the free parameters going on from x. */
static double cost_at(const profile_question *q, double level, double *x)
{
    if (stop_is_asked(q->ctx ? q->ctx->stop : NULL))
        return 0; /* all the looks that are left come to their end at once */
    const profile_look at = {q, level};
    const double step[2] = {0.05, 0.05}, shapes[] = {q->law->shape, x[1], 0, 0.2};
    double best = profile_cost(&at, x);
    /* A law that ends below one of the values, moved to a level far from its own, is none, or a bad one: where another
       shape costs less there with the fitted location (near the law: the scale), it is gone on from. */
    for (size_t i = 0; free_count(q->law->kind) > 1 && i < sizeof shapes / sizeof *shapes; i++) {
        const double start[2] = {0, shapes[i]};
        double cost = profile_cost(&at, start);
        if (!(cost < best))
            continue;
        best = cost;
        memcpy(x, start, sizeof start);
    }
    return minimise(profile_cost, &at, free_count(q->law->kind), x, step, 1e-8, 1);
}

/* Looks for an end, and how near in the root of the deviance. */
enum { LOOKS_MOST = 80 };
#define ROOT_NEAR 1e-5
/* Ends of the bracket that count as one, as a part of the last step outwards, and the part of z that the root has at an
   inner end which is the answer then. */
#define ENDS_NEAR 1e-9
#define ROOT_SHORT 0.99
/* A level that is no farther from the threshold of peaks, as a part of the fitted one's way, is at it. */
#define THRESHOLD_NEAR 1e-6

/* From the fitted level outwards to where the root of the deviance, which is nearly straight in the level, is z. */
static double end_of(const profile_question *q, double level, double first, double least, double z)
{
    double inside = level, root_inside = 0, outside = level + first, root_outside = (double)NAN, next = outside;
    double from[2] = {0, q->law->shape};
    for (int i = 0; i < LOOKS_MOST; i++) {
        /* Peaks tell nothing of levels under their threshold: it is gone to by halves, for the end may lie before. */
        if (is_peaks(q->law->kind) && next <= q->law->location) {
            if (!(inside - q->law->location > THRESHOLD_NEAR * (level - q->law->location)))
                return q->law->location;
            next = 0.5 * (inside + q->law->location);
        }
        if (q->ctx)
            work_tell(q->ctx, "finding intervals by profile likelihood", i + 1, 0);
        double x[2] = {from[0], from[1]}, root = sqrt(2 * fmax(cost_at(q, next, x) - least, 0));
        if (fabs(root - z) < ROOT_NEAR * z)
            return next;
        if (root < z) {
            inside = next;
            root_inside = root;
            from[0] = x[0];
            from[1] = x[1];
        } else {
            outside = next;
            root_outside = root;
        }
        if (isnan(root_outside)) {
            first *= 1.5;
            next = inside + first;
        } else {
            double part = (z - root_inside) / (root_outside - root_inside);
            /* Every third look halves, so that no end is crept to. */
            next = inside + (isfinite(part) && i % 3 != 2 ? part : 0.5) * (outside - inside);
        }
        if (isnan(root_outside) || !(fabs(outside - inside) < ENDS_NEAR * fabs(first)))
            continue;
        if (!(root_inside < ROOT_SHORT * z))
            return next;
        /* The least cost was not found at the outer end, where the root is said to leap: it lies further out. */
        root_outside = (double)NAN;
        next = inside + first;
    }
    return isnan(root_outside) ? first * (double)INFINITY : next;
}

/* Degrees of freedom of Student's t. */
static int freedom_of(const profile_question *q) { return q->count - (q->law->kind == LAW_GEV ? 3 : 2); }

double profile_least(const profile_question *q)
{
    double x[2] = {0, q->law->shape};
    return cost_at(q, level_of(q), x);
}

double profile_beyond(const profile_question *q, double least, double x, bool above)
{
    double from[2] = {0, q->law->shape};
    double outside = 0.5 - 0.5 * student_within(sqrt(2 * fmax(cost_at(q, x, from) - least, 0)), freedom_of(q));
    return above == (x > level_of(q)) ? outside : 1 - outside;
}

/* Bound of the root of the deviance.  For large samples that of the normal law (Wilks 1938); as the mean of a normal
   sample, where it is exact, small ones take Student's of as many degrees as values are left. */
static double root_bound(const profile_question *q) { return student_quantile(q->confidence, freedom_of(q)); }

level_interval profile_interval(const profile_question *q)
{
    level_interval out = {.level = level_of(q)};
    double z = q->bound > 0 ? q->bound : root_bound(q), least = profile_least(q);
    double first = q->law->kind == LAW_WEIBULL ? 0.02 * (out.level - q->law->location) : 0.2 * q->law->scale;
    out.low = end_of(q, out.level, -first, least, z);
    out.high = end_of(q, out.level, first, least, z);
    return out;
}
