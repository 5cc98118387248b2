/* The known word that a misspelt one is nearest to, for messages. */
#ifndef STUDY_WORDS_H
#define STUDY_WORDS_H

#include <stddef.h>

/* More than the longest of such words. */
enum { WORD_ROOM = 64 };
/* A word of the same meaning (largest for extreme), or else the one that is nearest (base/words.h); NULL when none is
 * near. */
const char *word_nearest(const char *const *words, size_t count, const char *wrong);

#endif
