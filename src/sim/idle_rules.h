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

/* Takes a key that was set, of a vessel that is there, and the rule by which it decides nothing; NULL: it has an
   effect. path: stays as long as the call. */
typedef void (*idle_taker)(void *to, const char *path, const idle_rule *rule);
/* All such keys of a scenario, each once, in their order (sanity_idle.c). */
void idle_look(const scenario *s, idle_taker take, void *to);

/* Keys of one rule that stand one after the other, told in one sentence. */
enum { IDLE_PATH = 380 };
typedef struct idle_group {
    const idle_rule *rule; /* NULL: no keys */
    int32_t more;          /* than the first */
    char first[IDLE_PATH]; /* path */
} idle_group;
/* Whether the next key belongs to the group, which counts it then. */
bool idle_group_takes(idle_group *g, const char *path, const idle_rule *rule);
void idle_group_begin(idle_group *g, const char *path, const idle_rule *rule);
/* " and 3 more", or nothing. */
enum { IDLE_MORE = 32 };
void idle_group_more(const idle_group *g, char out[IDLE_MORE]);

#endif
