/* Conditions that are series over one key: what may be joined by a line.  Knows a study; must not know its results. */
#ifndef STUDY_STUDY_SERIES_H
#define STUDY_STUDY_SERIES_H

#include "study/study.h"

/* Groups of a chart, of as many colours. */
enum { SERIES_MOST = 7 };

/* Condition c is point c % length of group c / length: along a group the key's number rises, the same in all groups.
   Each other key is the same in all of a group, or goes with the first the same way in every group. */
typedef struct study_series {
    int32_t key, groups, length;
} study_series;

/* false: the conditions are no such series; a line through them would mean nothing. */
bool study_series_find(const study *s, study_series *out);
/* Number of a value; false: it is a word, and out is left. */
bool study_series_number(const char *value, double *out);
/* Whether the key tells the groups apart. */
bool study_series_is_group_key(const study *s, const study_series *of, int32_t key);

#endif
