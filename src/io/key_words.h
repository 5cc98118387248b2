/* Words of the field for keys that have another name in a scenario. */
#ifndef IO_KEY_WORDS_H
#define IO_KEY_WORDS_H

#include "model/scenario_schema.h"

#include <stdint.h>

/* "draught" for "draft", "time_step" for "dt"; a word may stand for several keys, of which nth counts from 0.  NULL
   past the last, and for a word that is not known. */
const char *key_other_name(const char *word, int32_t nth);

/* How a key is written in a file whose name has points in it, as --set wants it: "run: {duration: ...}" of
   "run.duration" in the whole scenario.  false: it is none of the section. */
enum { KEY_NESTED_SIZE = 160 };
bool key_nested(const scenario_section *section, const char *name, char out[KEY_NESTED_SIZE]);

#endif
