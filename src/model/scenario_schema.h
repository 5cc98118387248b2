/* The schema: scenario_keys.h as a tree of descriptors, for everything that walks a scenario (reader, printer,
   reference, checks).  A section's keys are in the order of the rows. One module with scenario: the same keys, as data.
 */
#ifndef MODEL_SCENARIO_SCHEMA_H
#define MODEL_SCENARIO_SCHEMA_H

#include "model/scenario.h"

typedef enum key_kind {
    KEY_REAL = 0,
    KEY_INTEGER,
    KEY_BOOLEAN,
    KEY_CHOICE,
    KEY_TEXT,
    KEY_PATH,
    KEY_SECTION,
    KEY_LIST
} key_kind;

typedef struct scenario_section scenario_section;

typedef struct scenario_key {
    const char *name;
    const char *unit; /* "" for what has none, "1" for pure numbers */
    const char *meaning;
    key_kind kind;
    bool automatic;                  /* real: `auto` is allowed, and the default */
    size_t offset;                   /* in the struct of its section */
    double value;                    /* default of a real (at `at`), integer, boolean or choice */
    double at, power;                /* default of a real = value * (scale / at)^power; power 0: constant */
    double lo, hi;                   /* closed range of a real or integer; hi of a list: its largest count */
    const char *text;                /* choice: the names, one blank between; text and path: the default */
    const scenario_section *section; /* of a section, of a list's elements */
} scenario_key;

struct scenario_section {
    const char *noun;
    size_t size; /* of its struct */
    int32_t key_count;
    const scenario_key *keys;
};

/* The whole scenario. */
extern const scenario_section scenario_schema;

/* The member that a key describes, inside the struct of its section. */
static inline void *key_member(const scenario_key *key, void *section) { return (char *)section + key->offset; }
static inline const void *key_member_const(const scenario_key *key, const void *section)
{
    return (const char *)section + key->offset;
}

/* Index of a key of a section, -1 when there is none. */
int32_t section_find(const scenario_section *section, const char *name);
/* A key of a section of the scenario, both of which there are: for what is no scenario and keeps to the same default or
   range. */
const scenario_key *scenario_key_find(const char *section, const char *name);
/* The key whose name is nearest to a misspelt one (base/name_search.h), or else the first that begins with it and a low
   line; NULL when none is near. */
const char *section_nearest(const scenario_section *section, const char *name);
/* The first key that is called so up to a low line, x_min for x; NULL when there is none. */
const char *section_begun(const scenario_section *section, const char *name);
/* Default of a real key. */
double key_default(const scenario_key *key, double scale);
/* Every key of a section, and of those inside it, at its default; lists empty. */
void section_defaults(const scenario_section *section, void *data, double scale);

/* A list through its member: how many elements, one of them, one more at its defaults (NULL without memory), none. */
int32_t list_count(const void *member);
void *list_element(const scenario_key *key, const void *member, int32_t index);
void *list_append(context *ctx, const scenario_key *key, void *member, double scale);
void list_free(context *ctx, void *member);

/* The value of a choice (0, 1, ...) as it stands in its member. */
int32_t choice_value(const void *member);
void choice_set(void *member, int32_t value);
/* The name of a value, which is not terminated: size gets its length.  NULL when there is no such value. */
const char *choice_name(const scenario_key *key, int32_t value, size_t *size);
/* The value of a name, -1 when there is none. */
int32_t choice_find(const scenario_key *key, const char *name);

/* Whether a key is left out where a section is written, because it says nothing: the form of vessel or vessels that is
   not used, and no name. */
bool key_is_silent(const scenario_section *section, const scenario_key *key, const void *data);

/* Value of a real, integer or boolean member, as a double (exact: integers are below 2^53); 0 for the others. */
double key_number(const scenario_key *key, const void *member);

/* A function called for every key of a scenario that is no section, in the order of the rows, for a list before its
   items; path is its full name, "ice.floes[2].x".  Walking ends with the first status that is not FRAM_OK. */
typedef fram_status (*key_visit)(void *user, const scenario_key *key, const void *member, const char *path,
                                 fram_error *error);
fram_status scenario_walk(const scenario *s, key_visit visit, void *user, fram_error *error);

#endif
