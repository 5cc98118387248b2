/* The known word that a misspelt one is nearest to, for messages. */
#ifndef STUDY_WORDS_H
#define STUDY_WORDS_H

#include <stddef.h>

enum { WORD_ROOM = 64 };
/* Number of letters to insert, delete or change (Levenshtein 1966); words longer than WORD_ROOM are far from all. */
int word_distance(const char *a, const char *b);
/* A word of the same meaning (largest for extreme), or else the one whose letters are nearest; NULL when none is near:
   a third of the letters may be wrong, at least one. */
const char *word_nearest(const char *const *words, size_t count, const char *wrong);

#endif
