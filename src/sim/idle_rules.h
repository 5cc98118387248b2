/* Which keys decide nothing in a scenario, since another key leaves them without a meaning. */
#ifndef FRAM_SIM_IDLE_RULES_H
#define FRAM_SIM_IDLE_RULES_H

#include "model/scenario.h"

/* What a rule asks of: the scenario, the vessel whose key it is, and the item of a list (NULL for keys of none). */
typedef struct idle_question {
    const scenario *s;
    const scenario_vessel *v;
    const scenario_mooring_line *line;
    const scenario_thruster *thruster;
    const scenario_population *population;
    const scenario_floe *floe;
} idle_question;

/* A key, or all keys of a section where it ends with a dot, or that begin so where it ends with an underscore (without
   indices, vessels in a list as the one), what leaves them idle, and the sentence about it, or none where the key has
   an effect all the same.  The first rule that fits counts. */
typedef struct idle_rule {
    const char *key;
    bool (*idle)(const idle_question *q);
    const char *why;
} idle_rule;

/* The rule by which a key decides nothing; NULL: it has an effect.  pattern: its path without indices, vessels of a
   list as the one. */
const idle_rule *idle_rule_of(const char *pattern, const idle_question *q);
/* Whether a rule is of a section, or of all keys that begin alike. */
bool idle_rule_is_of_many(const idle_rule *r);

#endif
