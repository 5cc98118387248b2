/* Keys that were set and decide nothing, since another key leaves them without a meaning; see sim/sanity.h. */
#include "sim/idle_rules.h"
#include "sim/sanity_parts.h"

#include <stdio.h>
#include <string.h>

/* Whether a key says something else than when it is left out. */
static bool is_set(const scenario_key *key, const void *member, double scale)
{
    double value;
    switch (key->kind) {
    case KEY_REAL:
        value = key_number(key, member);
        return is_automatic(value) ? !key->automatic : key->automatic || value != key_default(key, scale);
    case KEY_INTEGER:
    case KEY_BOOLEAN:
        return key_number(key, member) != key->value;
    case KEY_CHOICE:
        return choice_value(member) != (int32_t)key->value;
    case KEY_TEXT:
    case KEY_PATH:
        return strcmp((const char *)member, key->text) != 0;
    default:
        return list_count(member) > 0;
    }
}

/* The keys of one rule that stand one after the other, told in one sentence. */
typedef struct idle_group {
    teller *t;
    const idle_rule *rule;
    char first[SANITY_SENTENCE]; /* path */
    int32_t more;
} idle_group;

static void tell_group(idle_group *g)
{
    char others[32] = "";
    if (g->rule && g->more > 0)
        snprintf(others, sizeof others, " and %d more", (int)g->more);
    if (g->rule)
        sanity_say(g->t->tell, g->t->to, "%s%s" SANITY_IDLE "%s", g->first, others, g->rule->why);
    g->rule = NULL;
}

/* The vessel of a path: of the list, or the one. */
static const scenario_vessel *vessel_at(const scenario *s, const char *path)
{
    int item = 0;
    if (sscanf(path, "vessels[%d]", &item) == 1 && item >= 0 && item < s->vessels.count)
        return &s->vessels.data[item];
    return &s->vessel;
}

/* The item of a key of a vessel or of the ice; false: a key of another item.  What an item of any other list says is
   idle with its list, as is what an item of an item says. */
static bool find_item(const char *key, idle_question *q)
{
    const scenario_mooring_line_list *lines = &q->v->mooring.lines;
    const scenario_thruster_list *thrusters = &q->v->thrusters;
    const scenario_population_list *populations = &q->s->ice.populations;
    const scenario_floe_list *floes = &q->s->ice.floes;
    bool point = strncmp(key, "positioning.waypoints[", 22) == 0;
    const char *item = strchr(key, '[');
    int i = -1;
    if (!item || strchr(item + 1, '['))
        return !item;
    if (sscanf(key, "mooring.lines[%d]", &i) == 1 && i >= 0 && i < lines->count)
        q->line = &lines->data[i];
    else if (sscanf(key, "thrusters[%d]", &i) == 1 && i >= 0 && i < thrusters->count)
        q->thruster = &thrusters->data[i];
    else if (sscanf(key, "ice.populations[%d]", &i) == 1 && i >= 0 && i < populations->count)
        q->population = &populations->data[i];
    else if (sscanf(key, "ice.floes[%d]", &i) == 1 && i >= 0 && i < floes->count)
        q->floe = &floes->data[i];
    return point || q->line || q->thruster || q->population || q->floe;
}

static fram_status look_at_key(void *user, const scenario_key *key, const void *member, const char *path,
                               fram_error *error)
{
    (void)error;
    idle_group *g = user;
    const scenario *s = g->t->s;
    idle_question q = {.s = s, .v = vessel_at(s, path)};
    bool of_vessel = strncmp(path, "vessel", 6) == 0;
    const char *own = of_vessel ? strchr(path, '.') : NULL; /* the key within its vessel */
    bool absent = of_vessel && !q.v->present;
    if (absent || !find_item(own ? own + 1 : path, &q) || !is_set(key, member, s->run.scale))
        return FRAM_OK;
    char pattern[SANITY_PATTERN];
    sanity_pattern(path, pattern);
    const idle_rule *rule = idle_rule_of(pattern, &q);
    if (!rule)
        return FRAM_OK;
    if (g->rule == rule && idle_rule_is_of_many(rule) && vessel_at(s, g->first) == q.v) {
        g->more++;
        return FRAM_OK;
    }
    tell_group(g);
    g->rule = rule;
    g->more = 0;
    snprintf(g->first, sizeof g->first, "%s", path);
    return FRAM_OK;
}

void sanity_tell_idle(const scenario *s, sanity_teller tell, const void *to)
{
    teller t = {s, tell, to, NULL, NULL, NULL};
    idle_group group = {.t = &t};
    (void)scenario_walk(s, look_at_key, &group, NULL);
    tell_group(&group);
}
