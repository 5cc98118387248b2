#include "study/meanings.h"

#include "base/name_search.h"

#include <stdbool.h>
#include <string.h>

/* Parts of names that mean the same: what people write, and what a name may have. */
static const struct {
    const char *wrong, *right;
} meanings[] = {{"extreme", "largest"}, {"extreme", "worst"}, {"max", "largest"},     {"max", "most"},
                {"maximum", "largest"}, {"maximum", "most"},  {"highest", "largest"}, {"peak", "largest"},
                {"largest", "worst"},   {"average", "mean"},  {"avg", "mean"},        {"min", "least"},
                {"minimum", "least"}};

/* Whether `wrong` is the word with one part, between low lines, in another word of the same meaning. */
static bool means(const char *word, const char *wrong, size_t meaning)
{
    const char *part = meanings[meaning].wrong, *right = meanings[meaning].right;
    size_t before = 0, length = strlen(part), other = strlen(right);
    while (strncmp(wrong + before, part, length) != 0 || (wrong[before + length] && wrong[before + length] != '_')) {
        const char *next = strchr(wrong + before, '_');
        if (!next)
            return false;
        before = (size_t)(next + 1 - wrong);
    }
    return strlen(word) >= before + other && strncmp(word, wrong, before) == 0 &&
           strncmp(word + before, right, other) == 0 && strcmp(word + before + other, wrong + before + length) == 0;
}

const char *word_nearest(const char *const *words, size_t count, const char *wrong)
{
    for (size_t m = 0; m < sizeof meanings / sizeof *meanings; m++)
        for (size_t i = 0; i < count; i++)
            if (means(words[i], wrong, m))
                return words[i];
    name_search near = name_search_begin(wrong);
    for (size_t i = 0; i < count; i++)
        name_try(&near, words[i]);
    return near.found;
}
