/* Warnings of the scenarios of a study: each is told once, with the first condition that has it.  That a key is without
   effect is told in the end, where it is under every condition that sets it. */
#ifndef STUDY_STUDY_WARNINGS_H
#define STUDY_STUDY_WARNINGS_H

#include "model/scenario.h"
#include "sim/build_hull.h"
#include "sim/idle_rules.h"
#include "study/study.h"

/* A key that some condition sets, and that decides nothing in one. */
typedef struct study_set_key {
    const idle_rule *rule; /* why, in the first condition where it does not; NULL: it decides something in all */
    int32_t condition;     /* that first one */
    bool acts;             /* it decides something in one, too */
} study_set_key;

/* Begins with ctx and s alone. */
typedef struct study_warnings {
    context *ctx; /* into whose log they go */
    const study *s;
    int32_t condition;        /* that is looked at */
    text_list told;           /* sentences, without their conditions */
    int32_array by;           /* the condition of each */
    text_list keys;           /* paths of all that were set so far */
    ARRAY(study_set_key) set; /* what is known of each */
    int32_t next;             /* the key that likely comes next: conditions have theirs in one order */
    int32_t looked;           /* conditions whose keys were looked at */
    bool fresh;               /* one of them was not looked at before */
    int32_t more, other;      /* conditions with others like those, and the number of the last of them */
    bool failed;              /* no memory */
} study_warnings;

/* A context that tells warnings as those of a condition; stays good as long as w. */
context study_warnings_of(study_warnings *w, int32_t condition);
/* Warns of a condition's scenario by its keys, or, as before a run, by what was made of them, and looks whether its
   vessels can be built, for what only shows then: a hull that closes nowhere, a mass that sinks.  store: for those of
   the next condition.  Makes no ice: what goes by the floes of a file is not told. */
fram_status study_build_check(study_warnings *w, int32_t condition, const scenario *one, hull_store *store,
                              fram_error *error);
/* A condition that was looked at before: its keys count with those of conditions that are looked at now. */
void study_warnings_pass(study_warnings *w, int32_t condition, const scenario *one);
/* Tells which keys are without effect, where a condition was not looked at before, and how many conditions have others
   like those that were told, and frees what w holds.  status: of the looking, which it returns, or that there was no
   memory for what was told. */
fram_status study_warnings_end(study_warnings *w, fram_status status, fram_error *error);

#endif
