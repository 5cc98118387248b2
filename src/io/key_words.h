/* Words of the field for keys that have another name in a scenario. */
#ifndef IO_KEY_WORDS_H
#define IO_KEY_WORDS_H

/* "draught" for "draft", "time_step" for "dt"; NULL for a word that is not known. */
const char *key_other_name(const char *word);

#endif
