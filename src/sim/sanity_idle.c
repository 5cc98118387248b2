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

/* Who takes the keys of a scenario. */
typedef struct idle_walk {
    const scenario *s;
    idle_taker take;
    void *to;
} idle_walk;

static fram_status look_at_key(void *user, const scenario_key *key, const void *member, const char *path,
                               fram_error *error)
{
    (void)error;
    const idle_walk *walk = user;
    const scenario *s = walk->s;
    idle_question q = {.s = s, .v = vessel_at(s, path)};
    bool of_vessel = strncmp(path, "vessel", 6) == 0;
    const char *own = of_vessel ? strchr(path, '.') : NULL; /* the key within its vessel */
    bool absent = of_vessel && !q.v->present;
    if (absent || !find_item(own ? own + 1 : path, &q) || !is_set(key, member, s->run.scale))
        return FRAM_OK;
    char pattern[SANITY_PATTERN];
    sanity_pattern(path, pattern);
    walk->take(walk->to, path, idle_rule_of(pattern, &q));
    return FRAM_OK;
}

void idle_look(const scenario *s, idle_taker take, void *to)
{
    idle_walk walk = {s, take, to};
    (void)scenario_walk(s, look_at_key, &walk, NULL);
}

/* ---- what is told ---- */

/* Of the same vessel, or of none. */
static bool begins_alike(const char *a, const char *b)
{
    size_t n = strcspn(a, ".");
    return n == strcspn(b, ".") && strncmp(a, b, n) == 0;
}

bool idle_group_takes(idle_group *g, const char *path, const idle_rule *rule)
{
    bool takes = g->rule == rule && rule && idle_rule_is_of_many(rule) && begins_alike(path, g->first);
    g->more += takes;
    return takes;
}

void idle_group_begin(idle_group *g, const char *path, const idle_rule *rule)
{
    *g = (idle_group){.rule = rule};
    snprintf(g->first, sizeof g->first, "%s", path);
}

void idle_group_more(const idle_group *g, char out[IDLE_MORE])
{
    out[0] = '\0';
    if (g->more > 0)
        snprintf(out, IDLE_MORE, " and %d more", (int)g->more);
}

/* The keys that are to be told, and who is. */
typedef struct idle_told {
    idle_group group;
    sanity_teller tell;
    const void *to;
} idle_told;

static void tell_group(idle_told *t)
{
    char others[IDLE_MORE];
    idle_group_more(&t->group, others);
    if (t->group.rule)
        sanity_say(t->tell, t->to, "%s%s" SANITY_IDLE "%s", t->group.first, others, t->group.rule->why);
}

static void take_idle(void *to, const char *path, const idle_rule *rule)
{
    idle_told *t = to;
    if (!rule || idle_group_takes(&t->group, path, rule))
        return;
    tell_group(t);
    idle_group_begin(&t->group, path, rule);
}

void sanity_tell_idle(const scenario *s, sanity_teller tell, const void *to)
{
    idle_told told = {{0}, tell, to};
    idle_look(s, take_idle, &told);
    tell_group(&told);
}
