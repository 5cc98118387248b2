/* Statistics of series: the greatest value in a wanted time by the methods of the field, and fatigue.  Series are
   channels of runs or columns of anybody's CSV files.  What is told has a method, assumptions and an interval, or it is
   not told, with a sentence that says why. */
#ifndef FRAM_STATISTICS_H
#define FRAM_STATISTICS_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A time as studies and the command take it, in seconds: a decimal number, and behind it, without a blank, s, min, h,
   d, or a or y (a year of 365.25 days): "10800", "90min", "3h".  FRAM_ERROR_INPUT, with the key "text", for any other;
   seconds is then as it was. */
FRAM_API fram_status fram_time_read(const char *text, double *seconds, fram_error *error);
/* A decimal number that fills the text, as scenarios take it: "1e3", "-0.5", not "0x10", "inf", "nan", "1 ".
   FRAM_ERROR_INPUT, with the key "text", for any other; value is then as it was. */
FRAM_API fram_status fram_number_read(const char *text, double *value, fram_error *error);
/* As the library's pages tell them, cut to `size` bytes with the NUL; without a text or room nothing is done.
   A duration [s]: "0.123 s", "85.7 s", "2 min 05 s", "3 h 12 min", "4 days 07 h". */
FRAM_API void fram_duration_text(double seconds, char *text, size_t size);
/* A load [N] in N, kN or MN by its size, and half its interval (NaN: none): "9.64 N", "739 +- 169 kN", "26.1 MN".
   largest: of the loads of its column, whose unit it is to have: "0.003 MN"; NaN: it stands alone. */
FRAM_API void fram_load_text(double newton, double half, double largest, char *text, size_t size);
/* Significant digits with which a number of this size tells so small a part of it to `digits` digits, as those of axes
   tell their ticks: beside a northing the first five are the same for all.  From `least` to 15. */
FRAM_API int fram_digits_beside(double size, double part, int digits, int least);

enum { FRAM_SERIES_FILES = 4096 }; /* the most files of a series */

/* Where a series is read.  Several files are realizations of one process, as seeds of one condition are.  What is
   written beside the answer is none of them, nor one that a run is made of: FRAM_ERROR_USAGE, key "draw" or "cycles".
 */
typedef struct fram_series_source {
    const char *const *files; /* folders of runs, or CSV files with a row of heads, "name" or "name[unit]" */
    int file_count;           /* 1 to FRAM_SERIES_FILES */
    const char *channel;      /* NULL: "load" of runs, the magnitude of the horizontal averaged ice force */
    double from; /* leave out what is not after it [s], of 0 what is before; NaN: the transient of a run, nothing of a
                    CSV file */
    double step; /* between rows of a file without a column `time` [s]; 0: there is one */
    bool minima; /* the least value is asked: all is told of the negative values */
} fram_series_source;

/* What a series is. */
typedef struct fram_series_facts {
    int64_t values;
    double time, step; /* [s] */
    double mean, deviation, least, greatest;
    double time_scale; /* integral of the autocorrelation up to its first zero [s] (Bartlett 1946) */
    char unit[16];
} fram_series_facts;

/* ---- Extremes ---- */

enum { FRAM_EXTREME_LEVELS = 12, FRAM_EXTREME_METHODS = 6, FRAM_EXTREME_STABILITY = 20 };

typedef struct fram_extremes_definition {
    size_t size; /* of this struct, set by fram_extremes_default */
    fram_series_source source;
    const char *method; /* "acer", "upcrossing", "gumbel", "gev", "pot", "weibull", or "all" (NULL) */
    bool maxima;        /* the values are maxima of blocks of `block` seconds each, not a series: gumbel, gev */
    double duration;    /* of which the greatest value is asked, 10800 [s] */
    double confidence;  /* of the intervals, 0.95 */
    double block;       /* of block maxima [s]; 0: a fiftieth of the data, at least 20 time scales */
    double threshold;   /* of peaks and of the first level of rates; NaN: from the 0.95 quantile of the values on,
                           until clusters keep apart; and the 0.9 quantile */
    double separation;  /* of independent peaks [s]; 0: 4 time scales */
    int order;          /* of acer, in values; 0: as many as the separation takes */
    bool moments;       /* fit by L-moments (Hosking 1990) with a bootstrap, not by likelihood with its profile */
    double probability[FRAM_EXTREME_LEVELS]; /* that the greatest value stays below a level; 0.5, 0.9, 0.99 */
    int levels;
    const char *draw; /* write a probability plot of each method that answers to this file, .png or .svg; or NULL */
} fram_extremes_definition;
FRAM_API void fram_extremes_default(fram_extremes_definition *definition, size_t size);
#define fram_extremes_default(definition) fram_extremes_default((definition), sizeof *(definition))

typedef struct fram_level {
    double level, low, high; /* low and high: its interval; high may be infinite.  NaN: not told, see the note */
} fram_level;

typedef struct fram_threshold_fit {
    /* shape_half: half the 95 % interval of the shape, at any confidence; scale_star: scale - shape x threshold */
    double threshold, shape, shape_half, scale_star;
    int peaks;
} fram_threshold_fit;

typedef struct fram_extreme {
    const char *method, *interval; /* how the intervals were found */
    bool answered;                 /* otherwise all levels are NaN, and the note says why */
    int sample;                    /* maxima, peaks, or exceedances of the first level */
    int order;
    double block, threshold, separation;            /* as used; 0 where the method has none */
    double location, scale, shape;                  /* of the law; the shape is positive for a heavy tail */
    double tail_q, tail_a, tail_b, tail_c;          /* rate a value = q exp(-a (x - b)^c), of acer and upcrossing */
    fram_level most_probable;                       /* exceeded once on the average: probability exp(-1) */
    fram_level level[FRAM_EXTREME_LEVELS];          /* of the probabilities that were asked */
    fram_threshold_fit fit[FRAM_EXTREME_STABILITY]; /* of pot: what other thresholds say */
    int fits;
    char note[600]; /* what speaks against the answer, in sentences; may be "" */
} fram_extreme;

typedef struct fram_extremes {
    fram_series_facts series; /* of maxima: of them; time is their number times the block */
    fram_extreme method[FRAM_EXTREME_METHODS];
    int methods;
} fram_extremes;
/* FRAM_ERROR_INPUT with file, line and channel for what cannot be read.  Data that carry no answer are no error. */
FRAM_API fram_status fram_extremes_find(fram_context *context, const fram_extremes_definition *definition,
                                        fram_extremes *result, fram_error *error, size_t size);
#define fram_extremes_find(...) fram_extremes_find(__VA_ARGS__, sizeof(fram_extremes))

/* ---- Fatigue ---- */

enum { FRAM_SLOPES = 8 };

typedef struct fram_fatigue_definition {
    size_t size; /* of this struct, set by fram_fatigue_default */
    fram_series_source source;
    double slope[FRAM_SLOPES]; /* m of S-N lines; 3, 5 */
    int slopes;
    double frequency;   /* of the equivalent cycles, 1 [Hz] */
    const char *cycles; /* write all cycles there, CSV with a row each; NULL */
} fram_fatigue_definition;
FRAM_API void fram_fatigue_default(fram_fatigue_definition *definition, size_t size);
#define fram_fatigue_default(definition) fram_fatigue_default((definition), sizeof *(definition))

typedef struct fram_cycle {
    double range, mean, count; /* count: 1, or 0.5 of a half cycle */
} fram_cycle;
typedef struct fram_fatigue {
    fram_series_facts series;
    double cycles;                  /* sum of their counts */
    double greatest;                /* range */
    double equivalent[FRAM_SLOPES]; /* range that does the same damage in cycles of the given frequency (Miner 1945) */
    fram_cycle *list;               /* by rainflow counting, ASTM E1049-85; freed by fram_fatigue_free */
    int64_t count;
} fram_fatigue;
FRAM_API fram_status fram_fatigue_find(fram_context *context, const fram_fatigue_definition *definition,
                                       fram_fatigue *result, fram_error *error, size_t size);
#define fram_fatigue_find(...) fram_fatigue_find(__VA_ARGS__, sizeof(fram_fatigue))
FRAM_API void fram_fatigue_free(fram_context *context, fram_fatigue *result, size_t size);
#define fram_fatigue_free(...) fram_fatigue_free(__VA_ARGS__, sizeof(fram_fatigue))

#ifdef __cplusplus
}
#endif

#endif
