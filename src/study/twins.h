/* Conditions of a study that are the same scenario, as designs on few levels and lists make them: their runs are the
   same runs, and are made once.  Knows names of conditions; must not know runs. */
#ifndef STUDY_TWINS_H
#define STUDY_TWINS_H

#include "study/study_folder.h"

/* For each condition the first one with the same name, itself where there is none before it; to be freed.  NULL: no
   memory. */
int32_t *twins_find(context *ctx, char (*id)[CONDITION_ID], int32_t count);

#endif
