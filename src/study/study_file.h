/* Study files: YAML to a checked study.

       scenario: demo.yaml                        relative to the study file
       set: {run.duration: 60, run.transient: 15} for all runs
       vessel: drillship                          whose figures the tables tell; default: the first one
       seeds: 20                                  or {least: 6, most: 60, mean_within: 0.05, largest_within: 0.1,
                                                  extreme_within: 0.1,
                                                      confidence: 0.95, first: 1}
       vary:                                      one of
         grid: {ice.thickness: [0.6, 1.1], vessel.speed: [1, 2]}
         list: [{ice.thickness: 0.6, vessel.speed: 1}, ...]
         table: conditions.csv                    a column a key
         latin: {count: 50, seed: 1, keys: {ice.thickness: [0.5, 1.5]}}
       keep: summary                              or series, all; or {each: series, record_of_worst: 3,
                                                      by: line_tension_largest}

   Every condition is checked as a scenario; an error names file, line and key. */
#ifndef STUDY_STUDY_FILE_H
#define STUDY_STUDY_FILE_H

#include "model/scenario.h"
#include "study/study.h"

/* The most bytes of a study file and of what its conditions come from: the most conditions with tens of keys each are a
   study file of that size when they are written out one by one. */
enum { STUDY_FILE_LIMIT = 1 << 28, STUDY_DEPTH_LIMIT = 8 };

/* On success free with study_free; on failure nothing is left to free. */
fram_status study_read(context *ctx, const char *path, study *s, fram_error *error);

/* The record of a study that ran, from memory, and without the check of the conditions: intervals wider than their
   means (seeds.mean_within over 1), which older versions took, are taken.  `name` stands for the file in errors and for
   relative paths. */
fram_status study_parse(context *ctx, const char *name, const char *data, size_t size, study *s, fram_error *error);
/* Looks at the scenarios of all conditions, in study_conditions_check.c; where all of them have one first vessel, it
   becomes the study's. */
fram_status study_conditions_check(context *ctx, study *s, fram_error *error);
/* The scenario of one run; on success free with scenario_free. */
fram_status study_scenario(context *ctx, const study *s, int32_t condition, int64_t seed, scenario *out,
                           fram_error *error);
/* "condition 3 (ice.thickness=1, vessel.speed=2): "; nothing where there is but one way to run. */
typedef struct study_condition_text {
    char text[160];
} study_condition_text;
void study_spell_condition(const study *s, int32_t condition, study_condition_text *out);
/* An error of a condition's scenario, or of the run that is made of it: tells the condition and its values, and, where
   the study gave the value, the place in the study file or its table. */
void study_place_error(const study *s, int32_t condition, fram_error *error);

#endif
