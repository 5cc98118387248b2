/* A study: one scenario under many conditions, each with several seeds.  Plain data, made from a study file
   (study/study_file.h) and never changed; what is to be run follows from it and from the results so far alone, never
   from where or in which order runs end.  Knows scenarios by their text; must not know a world. */
#ifndef STUDY_STUDY_H
#define STUDY_STUDY_H

#include "base/array.h"

/* Texts of the study's own. */
typedef ARRAY(char *) text_list;

/* A text and where the study file has it, for errors. */
typedef struct study_assignment {
    char *key, *value;
    int line; /* 0: not from a line of the study file */
} study_assignment;
typedef ARRAY(study_assignment) assignment_list;

/* How many seeds a condition gets: `least`, and then more until the confidence intervals of the mean over seeds are
   narrow enough, `most` at the end. */
typedef struct study_seeds {
    int64_t first;         /* seeds are first, first + 1, ... */
    int32_t least, most;   /* equal: a fixed number */
    double mean_within;    /* half width of the interval of the mean load over that mean; 0: not asked */
    double largest_within; /* the same for the largest load of a run; 0: not asked */
    double extreme_within; /* the same for the most probable largest load of `extremes`; 0: not asked */
    double confidence;     /* of the intervals of means, 0.95 */
    int extreme_line;      /* of extreme_within in the study file */
} study_seeds;

/* What stays of a run that ended well. */
typedef enum study_keep {
    KEEP_SUMMARY = 0, /* its figures alone */
    KEEP_SERIES,      /* the time series too */
    KEEP_ALL          /* the whole folder */
} study_keep;

/* Runs that are made again with a record and a playback when all have ended: the worst by a figure of a run. */
enum { STUDY_WORST_MOST = 100 };
typedef struct study_worst {
    int32_t count; /* 0: none */
    int figure;    /* a run_figure (study/run_row.h), by which the page has its worst runs too */
    int line;      /* in the study file */
} study_worst;

/* The ends of a range of a key, [0.5, 1.5]; whole: of whole numbers, both of which are of it. */
typedef struct key_range {
    double lo, hi;
    bool whole;
} key_range;

/* Conditions that are points of a design of sensitivity (study/sensitivity.h). */
typedef enum study_design_kind { DESIGN_NONE = 0, DESIGN_SOBOL, DESIGN_MORRIS } study_design_kind;
typedef struct study_design {
    study_design_kind kind;
    int32_t count, levels;  /* rows or paths; levels of Morris's grid */
    int64_t seed;           /* that the points are drawn with */
    ARRAY(key_range) range; /* of each key */
    ARRAY(double) point;    /* conditions x keys, in the unit cube */
} study_design;

/* What is asked of rare loads, of the largest values of the runs of each condition. */
enum { STUDY_LEVELS_MOST = 8 };
typedef struct study_extremes {
    bool asked, gev;                                            /* gev: that law, not Gumbel's */
    double duration, confidence;                                /* [s], 0.95 */
    double level[STUDY_LEVELS_MOST], annual[STUDY_LEVELS_MOST]; /* probabilities of staying below; in a year, over */
    int levels, annuals, line, hours_line;
    ARRAY(double) hours; /* a year that each condition lasts; empty: not asked */
} study_extremes;

typedef struct study {
    char *file;                /* the study file */
    char *scenario;            /* path of the scenario, to be opened from here */
    char *vessel;              /* whose figures the tables tell; NULL: the first that is present */
    int vessel_line;           /* in the study file */
    assignment_list set;       /* for all runs */
    text_list keys;            /* that the conditions vary */
    text_list values;          /* conditions x keys, one condition after the other */
    int32_t conditions;        /* at least 1 */
    int32_t keys_line;         /* in the study file */
    char *table;               /* file that the conditions are of; NULL: the study file */
    int32_array table_line;    /* of each condition there */
    ARRAY(double) table_hours; /* a year that each condition lasts, by the table; empty: not told there */
    study_seeds seeds;
    study_keep keep;
    study_worst worst;
    study_design design;
    study_extremes extremes;
} study;

/* Most conditions of a study, most seeds of a condition, and most runs of all: far beyond what anybody waits for. */
enum { STUDY_CONDITIONS_MOST = 100000, STUDY_SEEDS_MOST = 100000, STUDY_RUNS_MOST = 10000000 };

void study_free(context *ctx, study *s);
static inline const char *study_value(const study *s, int32_t condition, int32_t key)
{
    return s->values.data[condition * s->keys.count + key];
}
/* Whether two values of a key are one: of numbers, 0.5 and 0.50 are. */
bool study_values_same(const char *a, const char *b);

bool text_list_add(context *ctx, text_list *list, const char *text);
void text_list_free(context *ctx, text_list *list);

#endif
