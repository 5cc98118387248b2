#include "study/study_series.h"

#include "base/number_text.h"

bool study_series_number(const char *value, double *out) { return real_from_text(value, out) == NUMBER_GOOD; }

/* Conditions from the first on along which the key's number rises. */
static int32_t rising(const study *s, int32_t key)
{
    double last = 0, next = 0;
    int32_t n = 1;
    if (!study_series_number(study_value(s, 0, key), &last))
        return 0;
    for (; n < s->conditions && study_series_number(study_value(s, n, key), &next) && next > last; n++)
        last = next;
    return n;
}

static bool goes_with(const study *s, const study_series *of, int32_t key)
{
    for (int32_t c = of->length; c < s->conditions; c++)
        if (!study_values_same(study_value(s, c, key), study_value(s, c % of->length, key)))
            return false;
    return true;
}

static bool is_constant(const study *s, const study_series *of, int32_t key)
{
    for (int32_t c = 0; c < s->conditions; c++)
        if (!study_values_same(study_value(s, c, key), study_value(s, c - c % of->length, key)))
            return false;
    return true;
}

bool study_series_is_group_key(const study *s, const study_series *of, int32_t key)
{
    return is_constant(s, of, key) && !goes_with(s, of, key);
}

bool study_series_find(const study *s, study_series *out)
{
    for (int32_t k = 0; k < s->keys.count; k++) {
        *out = (study_series){.key = k, .length = rising(s, k)};
        if (out->length < 2 || s->conditions % out->length != 0 || s->conditions / out->length > SERIES_MOST)
            continue;
        out->groups = s->conditions / out->length;
        bool good = goes_with(s, out, k);
        for (int32_t j = 0; j < s->keys.count && good; j++)
            good = goes_with(s, out, j) || is_constant(s, out, j);
        if (good)
            return true;
    }
    return false;
}
