/* The known word that one of the same meaning, or a misspelt one, stands for; for messages. */
#ifndef STUDY_MEANINGS_H
#define STUDY_MEANINGS_H

#include <stddef.h>

/* More than the longest of such words. */
enum { WORD_ROOM = 64 };
/* A word of the same meaning (largest for extreme), or else the one that is nearest (base/name_search.h); NULL when
   none is near. */
const char *word_nearest(const char *const *words, size_t count, const char *wrong);

#endif
