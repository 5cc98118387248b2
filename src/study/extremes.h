/* The greatest value in a wanted time, told from time series or from maxima, by the methods of the field, each with its
   assumptions, its interval, and a sentence where the data do not carry the answer.  Knows numbers and laws; must not
   know a run.  The same to the bit everywhere.

     acer        average conditional exceedance rates (Naess and Gaidai 2009), interval by bootstrap over batches
     upcrossing  the same of crossings upwards, order 2 (Naess and Gaidai 2008)
     gumbel      block maxima, Gumbel's law, the exact interval conditional on the sample (Lawless 1978), of a series
                 averaged over this law and the generalized one (study/averaged.h)
     gev         block maxima, generalized extreme value law (Coles 2001), profile likelihood, of a series widened by
                 what a slow limit leaves out
     pot         declustered peaks over a threshold, generalized Pareto law (Davison and Smith 1990), the same
     weibull     all peaks between crossings of the mean, from the mean on, Weibull's law: for comparison; its interval
                 holds only if all peaks follow one law and are independent */
#ifndef STUDY_EXTREMES_H
#define STUDY_EXTREMES_H

#include "study/acer.h"

#define EXTREME_HOUR 3600.0 /* [s] */

typedef enum extreme_method {
    EXTREME_ACER = 0,
    EXTREME_UPCROSSING,
    EXTREME_GUMBEL,
    EXTREME_GEV,
    EXTREME_POT,
    EXTREME_WEIBULL,
    EXTREME_METHODS
} extreme_method;

const char *extreme_method_name(extreme_method m);
/* EXTREME_METHODS: no such name. */
extreme_method extreme_method_find(const char *name);

enum { EXTREME_LEVELS_MOST = 12, EXTREME_NOTE = 600, STABILITY_MOST = 20, BOOTSTRAP_REPLICATES = 499 };
/* Points of a probability plot: the greatest values, and as many of the others, evenly. */
enum { EXTREME_POINTS_MOST = 96 };

/* What is asked.  0 or NaN: chosen from the series, as extreme_request_default says. */
typedef struct extreme_request {
    double duration;                         /* of which the greatest value is asked [s] */
    double confidence;                       /* 0.95 */
    double block;                            /* of block maxima [s]: a fiftieth of the data, at least 20 time scales */
    double threshold;                        /* of peaks, and first level of rates: NaN: the lowest from the 0.95
                          quantile on whose clusters keep apart, and the 0.9 quantile */
    double separation;                       /* of clusters [s]: 4 integral time scales */
    int order;                               /* of acer: separation/step + 1 */
    law_fit fit;                             /* of gumbel, gev, pot; with moments the interval is a bootstrap's */
    double probability[EXTREME_LEVELS_MOST]; /* that the greatest value stays below the level */
    int levels;
    bool stability; /* fits at twenty thresholds too, which take most of the time of pot */
} extreme_request;
void extreme_request_default(extreme_request *r);

/* Threshold stability (Coles 2001, 4.3.1): shape and scale - shape x threshold do not change where the law holds.
   shape_half: half the 95 % interval of the shape, whatever the confidence of the levels. */
typedef struct threshold_row {
    double threshold, shape, shape_half, scale_star;
    int32_t peaks;
} threshold_row;

/* What the data say: a level, and the mean time between exceedances of it [s]. */
typedef struct extreme_point {
    double period, level;
} extreme_point;

typedef struct extreme_result {
    extreme_method method;
    bool answered; /* otherwise the levels are NaN, and the note says why */
    extreme_law law;
    acer_tail tail;
    int32_t order, sample; /* sample: maxima, peaks, or exceedances of the first level */
    double block, threshold, separation;
    double time, step; /* of all data, between values [s] */
    extreme_point point[EXTREME_POINTS_MOST];
    int32_t points;
    level_interval most_probable; /* exceeded once on the average in the duration: probability exp(-1) */
    level_interval level[EXTREME_LEVELS_MOST];
    const char *interval;    /* how it was found */
    char note[EXTREME_NOTE]; /* sentences; "" when there is nothing to say */
    threshold_row stability[STABILITY_MOST];
    int32_t stability_rows;
    bool too_few_scales; /* without an answer, since the data are too few time scales long */
} extreme_result;

/* Of one or several realizations of a stationary process.  FRAM_ERROR_MEMORY; FRAM_INTERRUPTED while a bootstrap draws
   its samples, which takes longest. */
fram_status extremes_of_series(context *ctx, const series_set *s, extreme_method method, const extreme_request *ask,
                               extreme_result *out, fram_error *error);
/* Of maxima of blocks of equal length `block` [s]: gumbel or gev.  Errors as above. */
fram_status extremes_of_maxima(context *ctx, const double *maxima, int32_t count, double block, extreme_method method,
                               const extreme_request *ask, extreme_result *out, fram_error *error);

/* The fitted law's level whose exceedances are a time [s] apart in the mean, of an answered result. */
double extreme_level_of_period(const extreme_result *r, double period);

#endif
