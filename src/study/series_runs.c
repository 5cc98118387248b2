#include "study/series_runs.h"

#include "base/number_text.h"
#include "model/scenario_schema.h"

#include <string.h>

/* Realizations may differ in what chance they have, how long they are, and what is written of them; the window goes
   into the load. */
static bool tells_condition(const char *key)
{
    static const char *const others[] = {"title", "run.seed", "run.duration", "run.transient", "run.memory_limit"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(key, others[i]) == 0)
            return false;
    return strncmp(key, "output.", 7) != 0 || strcmp(key, "output.averaging_window") == 0;
}

typedef struct key_lines {
    context *ctx;
    text_buffer *out;
} key_lines;

static void add_number(const key_lines *to, const scenario_key *key, const void *member)
{
    char text[NUMBER_TEXT_SIZE];
    double value = key_number(key, member);
    real_to_text(value, text);
    if (key->kind == KEY_BOOLEAN)
        text_add(to->ctx, to->out, value != 0 ? "true" : "false");
    else
        text_add(to->ctx, to->out, key->automatic && is_automatic(value) ? "auto" : text);
}

static fram_status add_key(void *user, const scenario_key *key, const void *member, const char *path, fram_error *error)
{
    (void)error;
    const key_lines *to = user;
    const char *text = member, *slash;
    size_t size = 0;
    if (!tells_condition(path))
        return FRAM_OK;
    text_format(to->ctx, to->out, "%s: ", path);
    if (key->kind == KEY_TEXT || key->kind == KEY_PATH) {
        /* Folders say nothing of what lies in them, as in the hash of a scenario. */
        slash = key->kind == KEY_PATH ? strrchr(text, '/') : NULL;
        text_format(to->ctx, to->out, "\"%s\"", slash ? slash + 1 : text);
    } else if (key->kind == KEY_CHOICE) {
        text = choice_name(key, choice_value(member), &size);
        text_add_bytes(to->ctx, to->out, text ? text : "", text ? size : 0);
    } else if (key->kind == KEY_LIST) {
        text_format(to->ctx, to->out, "a list of %d", (int)list_count(member));
    } else {
        add_number(to, key, member);
    }
    text_add(to->ctx, to->out, "\n");
    return FRAM_OK;
}

/* The first line that differs is of one key in both: lists tell their number before their items. */
static void warn_of_other(context *ctx, series_runs *r, const char *folder, const char *keys)
{
    const char *a = r->keys.data, *b = keys;
    size_t of_a = strcspn(a, "\n"), of_b = strcspn(b, "\n");
    while (*a && of_a == of_b && memcmp(a, b, of_a) == 0) {
        a += of_a + 1, b += of_b + 1;
        of_a = strcspn(a, "\n"), of_b = strcspn(b, "\n");
    }
    const char *value = strstr(a, ": ");
    size_t key = value ? (size_t)(value - a) + 2 : 0;
    if (!*a || !value || of_b < key)
        return;
    r->told = true;
    log_write(ctx, LOG_WARNING,
              "%s and %s are taken as realizations of one condition, and differ in more than the seed: %.*s is %.*s in "
              "one, %.*s in the other",
              r->run.data[0].folder, folder, (int)(key - 2), a, (int)(of_a - key), a + key, (int)(of_b - key), b + key);
}

static fram_status compare_condition(context *ctx, series_runs *r, const run_data *d, fram_error *error)
{
    text_buffer own = {0};
    bool first = r->keys.count == 0;
    key_lines to = {ctx, first ? &r->keys : &own};
    if (r->told)
        return FRAM_OK;
    fram_status status = scenario_walk(&d->s, add_key, &to, error);
    /* In place of what the keys say. */
    char told[RUN_TOLD_SIZE];
    run_told(d, told);
    text_format(ctx, to.out, "what a program told it: %s\n", *told ? told : "nothing");
    if (status == FRAM_OK && to.out->failed)
        status = error_memory(error);
    if (status == FRAM_OK && !first)
        warn_of_other(ctx, r, r->run.data[r->run.count - 1].folder, own.data);
    text_free(ctx, &own);
    return status;
}

fram_status series_refuse_twice(const char *file, const char *same, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, file, 0, NULL,
                     "is given twice (%.200s is the same), and would count twice: each is a realization of its own",
                     same);
}

fram_status series_runs_add(context *ctx, series_runs *r, const run_data *d, const char *folder, fram_error *error)
{
    series_run own = {.folder = folder};
    memcpy(own.scenario_hash, d->note.scenario_hash, sizeof own.scenario_hash);
    memcpy(own.state_hash, d->note.state_hash, sizeof own.state_hash);
    /* A run that has no end has no hash of its state. */
    for (int32_t i = 0; i < r->run.count && own.state_hash[0]; i++) {
        const series_run *other = &r->run.data[i];
        if (strcmp(own.state_hash, other->state_hash) == 0 && strcmp(own.scenario_hash, other->scenario_hash) == 0)
            return series_refuse_twice(folder, other->folder, error);
    }
    return array_push(ctx, &r->run, own) ? compare_condition(ctx, r, d, error) : error_memory(error);
}

void series_runs_free(context *ctx, series_runs *r)
{
    array_free(ctx, &r->run);
    text_free(ctx, &r->keys);
}
