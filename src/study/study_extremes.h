/* What a study says of rare loads: extremes.csv, a row a condition and figure, and annual.csv, levels that all
   conditions together exceed once in so many years. */
#ifndef STUDY_STUDY_EXTREMES_H
#define STUDY_STUDY_EXTREMES_H

#include "io/text_buffer.h"
#include "study/conditions.h"
#include "study/extremes.h"
#include "study/run_row.h"

/* Reads the node under `extremes`. */
fram_status study_extremes_read(const study_source *r, const yaml_node *node);
/* What is asked must fit the conditions: as many hours as there are. */
fram_status study_extremes_check(const study *s, fram_error *error);

/* The greatest values of a figure in the runs of a condition, each `block` seconds long. */
typedef struct condition_maxima {
    double_array value;
    double block;
} condition_maxima;

/* Levels that are exceeded with the probabilities ask->annual in a year, where conditions last their hours in it: the
   rates of exceedance add up (Naess 1984).  Intervals by Gumbel's law are generalized confidence intervals (Weerahandi
   1993, J. Am. Stat. Assoc. 88, 899) from the exact joint law of location and scale of each condition, and so the exact
   ones where one condition alone occurs; by the generalized law they are a bootstrap over the runs.  out: ask->annuals,
   NaN when a condition that occurs has no fit: *missing is the first of them, else -1.  The values of `of` are left in
   ascending order. */
fram_status annual_levels(context *ctx, const study_extremes *ask, const condition_maxima *of, int32_t conditions,
                          level_interval *out, int32_t *missing, fram_error *error);

#endif
