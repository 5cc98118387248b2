#include "base/name_search.h"

#include <stdbool.h>
#include <string.h>

/* In every locale, as names are of letters a to z. */
static char small_letter(char c) { return (char)(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c); }

static bool same_letters(const char *a, const char *b)
{
    while (*a && small_letter(*a) == small_letter(*b))
        a++, b++;
    return small_letter(*a) == small_letter(*b);
}

/* Number of insertions, deletions, changes and swaps of neighbours between two names (restricted Damerau-Levenshtein
   distance, Damerau 1964; dynamic programming over three rows); 0 where only small and capital letters differ. */
static int name_distance(const char *a, const char *b)
{
    int length_a = (int)strlen(a), length_b = (int)strlen(b);
    if (length_a > NAME_LENGTH_MOST || length_b > NAME_LENGTH_MOST)
        return 2 * NAME_LENGTH_MOST;
    if (same_letters(a, b))
        return 0;
    int rows[3][NAME_LENGTH_MOST + 1];
    int *before = rows[0], *last = rows[1], *now = rows[2];
    for (int j = 0; j <= length_b; j++) {
        last[j] = j;
        before[j] = 0;
    }
    for (int i = 1; i <= length_a; i++) {
        now[0] = i;
        for (int j = 1; j <= length_b; j++) {
            int best = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            if (last[j] + 1 < best)
                best = last[j] + 1;
            if (now[j - 1] + 1 < best)
                best = now[j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && before[j - 2] + 1 < best)
                best = before[j - 2] + 1;
            now[j] = best;
        }
        int *oldest = before;
        before = last;
        last = now;
        now = oldest;
    }
    return last[length_b];
}

name_search name_search_begin(const char *wrong)
{
    size_t length = strlen(wrong);
    return (name_search){wrong, NULL, 2 + (int)((length < NAME_LENGTH_MOST ? length : NAME_LENGTH_MOST) / 3)};
}

void name_try(name_search *s, const char *name)
{
    int distance = name_distance(name, s->wrong);
    if (distance > s->least || (s->found && strcmp(name, s->found) == 0))
        return;
    s->found = distance < s->least ? name : NULL;
    s->least = distance;
}
