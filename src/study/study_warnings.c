#include "study/study_warnings.h"

#include "sim/notes.h"
#include "sim/sanity.h"
#include "study/study_file.h"

#include <ctype.h>
#include <string.h>

/* Conditions of which sentences are told that differ in their numbers alone, as where conditions vary what is told. */
enum { LIKE_MOST = 3 };

static const char *skip_number(const char *at)
{
    at += *at == '-';
    while (isdigit((unsigned char)*at) || *at == '.')
        at++;
    const char *power = at + 1 + (at[0] == 'e' && (at[1] == '+' || at[1] == '-'));
    if (*at == 'e' && isdigit((unsigned char)*power))
        for (at = power; isdigit((unsigned char)*at);)
            at++;
    return at;
}

static bool begins_number(const char *at)
{
    return isdigit((unsigned char)at[0]) || (at[0] == '-' && isdigit((unsigned char)at[1]));
}

static bool is_like(const char *a, const char *b)
{
    while (*a && *b) {
        bool number = begins_number(a);
        if (number != begins_number(b) || (!number && *a != *b))
            return false;
        a = number ? skip_number(a) : a + 1;
        b = number ? skip_number(b) : b + 1;
    }
    return *a == *b;
}

/* The first condition has no key twice. */
static int32_t idle_key(study_warnings *w, const char *path)
{
    for (int32_t k = 0; w->looked > 0 && k < w->keys.count; k++) {
        int32_t i = (w->next + k) % w->keys.count;
        if (strcmp(w->keys.data[i], path) != 0)
            continue;
        w->next = i + 1;
        return i;
    }
    return -1;
}

static void take_key(void *to, const char *path, const idle_rule *rule)
{
    study_warnings *w = to;
    int32_t i = w->failed ? -1 : idle_key(w, path);
    if (i < 0) {
        i = w->set.count;
        if (w->failed || !array_push(w->ctx, &w->set, (study_set_key){0}) || !text_list_add(w->ctx, &w->keys, path)) {
            w->failed = true;
            return;
        }
    }
    study_set_key *k = &w->set.data[i];
    k->acts = k->acts || !rule;
    if (rule && !k->rule)
        *k = (study_set_key){rule, w->condition, k->acts};
}

/* A key that decides nothing here may do so under another condition, which is what those are compared for. */
static void look_at_keys(study_warnings *w, const scenario *one)
{
    idle_look(one, take_key, w);
    w->looked++;
}

static void tell_once(void *user, log_level level, const char *text)
{
    study_warnings *w = user;
    study_condition_text name;
    if (strstr(text, SANITY_IDLE))
        return;
    int like = 0;
    int32_t last = w->condition;
    for (int32_t i = 0; i < w->told.count; i++) {
        if (strcmp(w->told.data[i], text) == 0)
            return;
        if (w->by.data[i] == last || w->by.data[i] == w->condition || !is_like(w->told.data[i], text))
            continue;
        like++;
        last = w->by.data[i];
    }
    if (like >= LIKE_MOST) {
        w->more += w->other != w->condition + 1;
        w->other = w->condition + 1;
        return;
    }
    if (!array_push(w->ctx, &w->by, w->condition) || !text_list_add(w->ctx, &w->told, text))
        w->failed = true;
    study_spell_condition(w->s, w->condition, &name);
    log_write(w->ctx, level, "%s%s", name.text, text);
}

context study_warnings_of(study_warnings *w, int32_t condition)
{
    context telling = *w->ctx;
    w->condition = condition;
    telling.log = w->ctx->log ? tell_once : NULL;
    telling.log_user = w;
    telling.verbosity = telling.verbosity < LOG_WARNING ? telling.verbosity : LOG_WARNING;
    return telling;
}

fram_status study_build_check(study_warnings *w, int32_t condition, const scenario *one, hull_store *store,
                              fram_error *error)
{
    context telling = study_warnings_of(w, condition);
    w->fresh = true;
    look_at_keys(w, one);
    fram_status status = notes_build_check(&telling, one, store, error);
    if (status == FRAM_ERROR_INPUT)
        study_place_error(w->s, condition, error);
    return status;
}

void study_warnings_pass(study_warnings *w, int32_t condition, const scenario *one)
{
    w->condition = condition;
    look_at_keys(w, one);
}

static void tell_idle_group(const study_warnings *w, const idle_group *g, int32_t condition)
{
    study_condition_text name;
    char others[IDLE_MORE];
    if (!g->rule)
        return;
    study_spell_condition(w->s, condition, &name);
    idle_group_more(g, others);
    log_write(w->ctx, LOG_WARNING, "%s%s%s" SANITY_IDLE "%s", name.text, g->first, others, g->rule->why);
}

static void tell_idle(const study_warnings *w)
{
    idle_group group = {.rule = NULL};
    int32_t condition = 0;
    for (int32_t i = 0; i < w->set.count; i++) {
        const study_set_key *k = &w->set.data[i];
        if (!k->rule || k->acts)
            continue;
        if (condition == k->condition && idle_group_takes(&group, w->keys.data[i], k->rule))
            continue;
        tell_idle_group(w, &group, condition);
        idle_group_begin(&group, w->keys.data[i], k->rule);
        condition = k->condition;
    }
    tell_idle_group(w, &group, condition);
}

fram_status study_warnings_end(study_warnings *w, fram_status status, fram_error *error)
{
    if (!w->failed && w->fresh && w->looked == w->s->conditions)
        tell_idle(w);
    if (w->more > 0)
        log_write(w->ctx, LOG_WARNING, "%d more condition%s warnings like these, with other numbers", (int)w->more,
                  w->more == 1 ? " has" : "s have");
    text_list_free(w->ctx, &w->told);
    array_free(w->ctx, &w->by);
    text_list_free(w->ctx, &w->keys);
    array_free(w->ctx, &w->set);
    return status == FRAM_OK && w->failed ? error_memory(error) : status;
}
