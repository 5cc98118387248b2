/* What was meant by names that no key or item of a scenario has: words of the field, keys of other sections, slips. */
#ifndef IO_KEY_WORDS_H
#define IO_KEY_WORDS_H

#include "model/scenario_schema.h"

#include <stdint.h>

/* Room for the name of a key with those of its sections: "vessel.hull.draught". */
enum { KEY_SIZE = sizeof((scenario_place *)0)->key };
/* "path.name", cut to size: the names of the schema are short, only unknown ones are cut. */
void key_join(char out[KEY_SIZE], const char *path, const char *name);

/* The key that was meant by a name that is none of a section, which stands at `path`: "draught" for "draft", another
   word of the field; what is called so exactly elsewhere; what is merely near in the section.  Of another section with
   its path, in `out`.  NULL: nothing is like it. */
const char *key_meant(const scenario_section *section, const char *path, const char *name, char out[KEY_SIZE]);

/* What is said of a name that stands for what Fram does not have, as a tow line between vessels; NULL: of none. */
const char *key_lacks(const char *path, const char *name);

/* How a key is written in a file whose name has points in it, as --set wants it: "run: {duration: ...}" of
   "run.duration" in the whole scenario.  false: it is none of the section. */
enum { KEY_NESTED_SIZE = 160 };
bool key_nested(const scenario_section *section, const char *name, char out[KEY_NESTED_SIZE]);

/* The item of a list that is called so; -1 when none is. */
int32_t item_find(const scenario_key *key, const void *member, const char *name);
/* The name in a list that was meant by a word that none of its items is called; NULL: none is like it, or several are
   equally.  names: the first few that there are, ", or the name, tug, tanker", "" where items have none. */
enum { ITEM_NAMES_MOST = 4, ITEM_NAMES_SIZE = 160 };
const char *item_meant(const scenario_key *key, const void *member, const char *word, char names[ITEM_NAMES_SIZE]);

#endif
