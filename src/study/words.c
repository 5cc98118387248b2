#include "study/words.h"

#include <string.h>

static int least(int a, int b) { return a < b ? a : b; }

int word_distance(const char *a, const char *b)
{
    int row[WORD_ROOM + 1], length = (int)strlen(b);
    if (strlen(a) > WORD_ROOM || length > WORD_ROOM)
        return 2 * WORD_ROOM;
    for (int j = 0; j <= length; j++)
        row[j] = j;
    for (int i = 1; a[i - 1]; i++) {
        int corner = row[0];
        row[0] = i;
        for (int j = 1; j <= length; j++) {
            int change = corner + (a[i - 1] != b[j - 1]);
            corner = row[j];
            row[j] = least(change, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[length];
}

const char *word_nearest(const char *const *words, size_t count, const char *wrong)
{
    int nearest = 2 + (int)(strlen(wrong) / 3);
    const char *found = NULL;
    for (size_t i = 0; i < count; i++) {
        int distance = word_distance(words[i], wrong);
        if (distance < nearest) {
            nearest = distance;
            found = words[i];
        }
    }
    return found;
}
