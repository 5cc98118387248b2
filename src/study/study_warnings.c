#include "study/study_warnings.h"

#include "sim/build.h"
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

/* A key that decides nothing here may do so under another condition, which is what those are compared for. */
static void count_idle(study_warnings *w, const char *text)
{
    for (int32_t i = 0; i < w->idle.count; i++) {
        if (strcmp(w->idle.data[i], text) != 0)
            continue;
        w->idle_in.data[i] += w->idle_in.data[i] == w->condition;
        return;
    }
    if (w->condition == 0 && (!array_push(w->ctx, &w->idle_in, 1) || !text_list_add(w->ctx, &w->idle, text)))
        w->failed = true;
}

static void tell_once(void *user, log_level level, const char *text)
{
    study_warnings *w = user;
    study_condition_text name;
    if (strstr(text, SANITY_IDLE)) {
        count_idle(w, text);
        return;
    }
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
    bool when_made = scenario_tells_when_made(one);
    if (!when_made)
        scenario_log_warnings(&telling, one, NULL, NULL);
    fram_status status = build_check(&telling, one, store, when_made ? scenario_log_warnings : NULL, error);
    if (status == FRAM_ERROR_INPUT)
        study_place_error(w->s, condition, error);
    return status;
}

static void count_one(const void *to, const char *text)
{
    study_warnings *const *w = to;
    count_idle(*w, text);
}

void study_warnings_pass(study_warnings *w, int32_t condition, const scenario *one)
{
    w->condition = condition;
    if (w->idle.count > 0)
        sanity_tell_idle(one, count_one, &w);
}

static void tell_idle(const study_warnings *w)
{
    study_condition_text name;
    study_spell_condition(w->s, 0, &name);
    for (int32_t i = 0; i < w->idle.count; i++)
        if (w->idle_in.data[i] == w->s->conditions)
            log_write(w->ctx, LOG_WARNING, "%s%s", name.text, w->idle.data[i]);
}

fram_status study_warnings_end(study_warnings *w, fram_status status, fram_error *error)
{
    if (!w->failed)
        tell_idle(w);
    if (w->more > 0)
        log_write(w->ctx, LOG_WARNING, "%d more condition%s warnings like these, with other numbers", (int)w->more,
                  w->more == 1 ? " has" : "s have");
    text_list_free(w->ctx, &w->told);
    array_free(w->ctx, &w->by);
    text_list_free(w->ctx, &w->idle);
    array_free(w->ctx, &w->idle_in);
    return status == FRAM_OK && w->failed ? error_memory(error) : status;
}
