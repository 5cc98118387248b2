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
/* What is asked must fit the conditions: as many hours as there are, and seeds that can end by it. */
fram_status study_extremes_check(context *ctx, study *s, fram_error *error);

/* The greatest values of a figure in the runs of a condition, each `block` seconds long. */
typedef struct condition_maxima {
    double_array value;
    double block;
    bool idle; /* none of the runs saw any ice load */
} condition_maxima;

/* Why there is no level: a condition has no fit, or by gev fewer runs than the level takes; of one that there is, on
   which condition it rests most. */
typedef struct annual_lack {
    int32_t condition;   /* from 0; -1: the level is there */
    int32_t runs, there; /* that it takes and has; 0: no fit at all */
    int32_t tied;        /* of those without a fit: how many are equal, the least, which is too many */
    bool same;           /* of those without a fit: all values are, under ice */
    int32_t carrier;     /* of a level: the condition that most of its exceedances are of, from 0; -1: there is none */
    double share;        /* the part of them that are */
    double duration;     /* in that condition that the level is one of: its time in a year over the probability [s] */
    extreme_law law;     /* of its largest values */
} annual_lack;

/* Levels that are exceeded with the probabilities ask->annual in a year, where conditions last their hours in it: the
   rates of exceedance add up (Naess 1984).  Intervals by Gumbel's law are generalized confidence intervals (Weerahandi
   1993, J. Am. Stat. Assoc. 88, 899) from the exact joint law of location and scale of each condition, widened to what
   a studentized bootstrap from the fits allows (Davison and Hinkley 1997, 5.2.1), and the exact ones where one
   condition alone occurs; by the generalized law they are a bootstrap over the runs, of those levels that enough runs
   carry.  An idle condition whose runs all came out the same meets that value and never exceeds it: it adds no rate,
   and no level or end of an interval is lower; under ice runs that are all the same carry no fit.  Conditions of the
   same values and block are one of all their hours, others independent samples.  out and lack: ask->annuals each; NaN
   where lack says why, or where nothing is left to chance.  The values of `of` are left in ascending order. */
fram_status annual_levels(context *ctx, const study_extremes *ask, const condition_maxima *of, int32_t conditions,
                          level_interval *out, annual_lack *lack, fram_error *error);

#endif
