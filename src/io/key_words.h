/* Words of the field for keys that have another name in a scenario. */
#ifndef IO_KEY_WORDS_H
#define IO_KEY_WORDS_H

#include <stdint.h>

/* "draught" for "draft", "time_step" for "dt"; a word may stand for several keys, of which nth counts from 0.  NULL
   past the last, and for a word that is not known. */
const char *key_other_name(const char *word, int32_t nth);

#endif
