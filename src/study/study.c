#include "study/study.h"

#include "base/number_text.h"

#include <string.h>

bool text_list_add(context *ctx, text_list *list, const char *text)
{
    char *copy = memory_string(ctx, text);
    if (copy && array_push(ctx, list, copy))
        return true;
    memory_free(ctx, copy);
    return false;
}

void text_list_free(context *ctx, text_list *list)
{
    for (int32_t i = 0; i < list->count; i++)
        memory_free(ctx, list->data[i]);
    array_free(ctx, list);
}

bool study_values_same(const char *a, const char *b)
{
    double x, y;
    if (strcmp(a, b) == 0)
        return true;
    return real_from_text(a, &x) == NUMBER_GOOD && real_from_text(b, &y) == NUMBER_GOOD && x == y;
}

void study_free(context *ctx, study *s)
{
    memory_free(ctx, s->file);
    memory_free(ctx, s->scenario);
    memory_free(ctx, s->vessel);
    for (int32_t i = 0; i < s->set.count; i++) {
        memory_free(ctx, s->set.data[i].key);
        memory_free(ctx, s->set.data[i].value);
    }
    array_free(ctx, &s->set);
    text_list_free(ctx, &s->keys);
    text_list_free(ctx, &s->values);
    memory_free(ctx, s->table);
    array_free(ctx, &s->table_line);
    array_free(ctx, &s->design.range);
    array_free(ctx, &s->design.point);
    array_free(ctx, &s->extremes.hours);
    array_free(ctx, &s->table_hours);
    memset(s, 0, sizeof *s);
}
