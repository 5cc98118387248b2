#include "study/study_file.h"

#include "base/number_text.h"
#include "io/file.h"
#include "io/scenario_file.h"
#include "study/conditions.h"
#include "study/meanings.h"
#include "study/run_row.h"
#include "study/study_extremes.h"

#include <stdio.h>
#include <string.h>

static bool set_text(context *ctx, char **out, const char *text)
{
    memory_free(ctx, *out);
    *out = memory_string(ctx, text);
    return *out != NULL;
}

/* ---- single keys ---- */

static fram_status read_scenario(const study_source *r, const yaml_node *node)
{
    if (node->kind != YAML_SCALAR || !*yaml_text(r->tree, node->value))
        return study_refuse(r, node, "expected the name of a scenario file");
    text_buffer path = {0};
    study_beside(r, yaml_text(r->tree, node->value), &path);
    bool good = !path.failed && set_text(r->ctx, &r->out->scenario, path.data);
    text_free(r->ctx, &path);
    /* What a study that ran was made of may be gone by now. */
    return !good ? error_memory(r->error) : r->recorded ? FRAM_OK : study_find_file(r, node, r->out->scenario);
}

/* That there is such a vessel is seen to with the conditions. */
static fram_status read_vessel(const study_source *r, const yaml_node *node)
{
    if (node->kind != YAML_SCALAR || !*yaml_text(r->tree, node->value))
        return study_refuse(r, node, "expected the name of a vessel of the scenario");
    r->out->vessel_line = node->line;
    return set_text(r->ctx, &r->out->vessel, yaml_text(r->tree, node->value)) ? FRAM_OK : error_memory(r->error);
}

static fram_status read_set(const study_source *r, const yaml_node *node)
{
    if (node->kind != YAML_MAPPING)
        return study_refuse(r, node, "expected scenario keys with a value each, as {run.duration: 60}");
    for (const yaml_node *k = study_child(r, node); k; k = study_next(r, k)) {
        if (k->kind != YAML_SCALAR)
            return study_refuse_kind(r, k, YAML_SCALAR, false, "one value of the key");
        if (strcmp(study_key(r, k), "run.seed") == 0)
            return study_refuse(r, k, "seeds are given by `seeds`");
        study_assignment a = {memory_string(r->ctx, study_key(r, k)),
                              memory_string(r->ctx, yaml_text(r->tree, k->value)), k->line};
        if (!a.key || !a.value || !array_push(r->ctx, &r->out->set, a)) {
            memory_free(r->ctx, a.key);
            memory_free(r->ctx, a.value);
            return error_memory(r->error);
        }
    }
    return FRAM_OK;
}

/* Half an interval over its mean: what is over 1 was meant as per cent. */
static fram_status read_within(const study_source *r, const yaml_node *k, double *out)
{
    const char *text = k->kind == YAML_SCALAR ? yaml_text(r->tree, k->value) : "";
    size_t length = strcspn(text, " %");
    char number[32];
    double value = 0;
    snprintf(number, sizeof number, "%.*s", (int)length, text);
    bool per_cent = strchr(text + length, '%') != NULL;
    if (!r->recorded && real_from_text(number, &value) == NUMBER_GOOD && (value > 1 || (per_cent && value > 0)))
        return study_refuse(r, k, "expected a part of the mean, 1 at most, found %s: %g per cent are %g",
                            study_found(r, k).text, value, value / 100);
    return study_number(r, k, 1e-6, r->recorded ? 1e9 : 1, out);
}

static fram_status read_seeds_member(const study_source *r, const yaml_node *k, bool *most_given)
{
    static const char *const names[] = {"least",          "most",       "mean_within", "largest_within",
                                        "extreme_within", "confidence", "first"};
    study_seeds *s = &r->out->seeds;
    const char *name = study_key(r, k);
    int64_t whole = 0;
    if (strcmp(name, "mean_within") == 0)
        return read_within(r, k, &s->mean_within);
    if (strcmp(name, "largest_within") == 0)
        return read_within(r, k, &s->largest_within);
    if (strcmp(name, "extreme_within") == 0) {
        s->extreme_line = k->line;
        return read_within(r, k, &s->extreme_within);
    }
    if (strcmp(name, "confidence") == 0)
        return study_number(r, k, 0.01, 0.9999, &s->confidence);
    if (strcmp(name, "first") == 0)
        return study_whole(r, k, 0, (double)SCENARIO_SEED_MOST, &s->first);
    bool least = strcmp(name, "least") == 0, most = strcmp(name, "most") == 0;
    if (!least && !most)
        return study_unknown(r, k, names, sizeof names / sizeof *names);
    fram_status status = study_whole(r, k, 1, STUDY_SEEDS_MOST, &whole);
    *most_given = *most_given || most;
    *(least ? &s->least : &s->most) = (int32_t)whole;
    return status;
}

static fram_status read_seeds(const study_source *r, const yaml_node *node)
{
    study_seeds *s = &r->out->seeds;
    if (node->kind == YAML_SCALAR) {
        int64_t count = 0;
        fram_status status = study_whole(r, node, 1, STUDY_SEEDS_MOST, &count);
        s->least = s->most = (int32_t)count;
        return status;
    }
    if (node->kind != YAML_MAPPING)
        return study_refuse(r, node, "expected a number, or least, most, mean_within, ...");
    bool most_given = false;
    for (const yaml_node *k = study_child(r, node); k; k = study_next(r, k)) {
        fram_status status = read_seeds_member(r, k, &most_given);
        if (status != FRAM_OK)
            return status;
    }
    bool until = s->mean_within > 0 || s->largest_within > 0 || s->extreme_within > 0;
    if (!most_given)
        s->most = s->least;
    if (until && s->least < 2)
        return study_refuse(r, node, "an interval takes two seeds: expected least from 2 on, found %d", (int)s->least);
    if (until != (s->most > s->least))
        return study_refuse(r, node,
                            until ? "mean_within, largest_within and extreme_within take `most`, larger than least"
                                  : "more than `least` seeds take mean_within, largest_within or extreme_within");
    if (s->most < s->least)
        return study_refuse(r, node, "expected most from least on, found %d and %d", (int)s->most, (int)s->least);
    if (s->first > SCENARIO_SEED_MOST - (s->most - 1))
        return study_refuse(r, node,
                            "expected first up to %lld, so that the last of %d seeds is at most %lld, found %lld",
                            (long long)SCENARIO_SEED_MOST - (s->most - 1), (int)s->most, (long long)SCENARIO_SEED_MOST,
                            (long long)s->first);
    return FRAM_OK;
}

static fram_status read_kept(const study_source *r, const yaml_node *node)
{
    static const char *const names[] = {[KEEP_SUMMARY] = "summary", [KEEP_SERIES] = "series", [KEEP_ALL] = "all"};
    for (int i = 0; node->kind == YAML_SCALAR && i < (int)(sizeof names / sizeof *names); i++) {
        if (strcmp(yaml_text(r->tree, node->value), names[i]) == 0) {
            r->out->keep = (study_keep)i;
            return FRAM_OK;
        }
    }
    return study_refuse(r, node, "expected summary, series or all");
}

static fram_status read_worst_by(const study_source *r, const yaml_node *k)
{
    const char *names[ROW_FIGURES], *text = k->kind == YAML_SCALAR ? yaml_text(r->tree, k->value) : "";
    for (int i = 0; i < ROW_FIGURES; i++)
        names[i] = run_figure_name((run_figure)i);
    r->out->worst.line = k->line;
    r->out->worst.figure = (int)run_figure_find(text);
    if (r->out->worst.figure < ROW_FIGURES)
        return FRAM_OK;
    const char *near = word_nearest(names, ROW_FIGURES, text);
    return study_refuse(r, k, "expected a column of summary.csv, as load_largest or line_tension_largest%s%s%s",
                        near ? "; did you mean " : "", near ? near : "", near ? "?" : "");
}

static fram_status read_keep(const study_source *r, const yaml_node *node)
{
    static const char *const names[] = {"each", "record_of_worst", "by"};
    bool by = false;
    if (node->kind != YAML_MAPPING)
        return read_kept(r, node);
    for (const yaml_node *k = study_child(r, node); k; k = study_next(r, k)) {
        fram_status status = FRAM_OK;
        int64_t count = 0;
        if (strcmp(study_key(r, k), "each") == 0) {
            status = read_kept(r, k);
        } else if (strcmp(study_key(r, k), "record_of_worst") == 0) {
            status = study_whole(r, k, 0, STUDY_WORST_MOST, &count);
            r->out->worst.count = (int32_t)count;
        } else if (strcmp(study_key(r, k), "by") == 0) {
            status = read_worst_by(r, k);
            by = true;
        } else {
            status = study_unknown(r, k, names, sizeof names / sizeof *names);
        }
        if (status != FRAM_OK)
            return status;
    }
    if (by && r->out->worst.count == 0)
        return study_refuse(r, node, "by takes record_of_worst: of how many runs the record is kept");
    return FRAM_OK;
}

/* "=" ends a key where keys and values stand together: what has one would be another key, with the rest in its value.
 */
static fram_status check_key(const char *file, int line, const char *key, fram_error *error)
{
    if (!strchr(key, '='))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, file, line, key, "expected a key of the scenario, found a text with =");
}

/* A key has one place: `set` is for all runs, `vary` for one condition. */
static fram_status check_keys(const study *s, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < s->set.count && status == FRAM_OK; i++)
        status = check_key(s->file, s->set.data[i].line, s->set.data[i].key, error);
    for (int32_t k = 0; k < s->keys.count && status == FRAM_OK; k++)
        status = check_key(s->table ? s->table : s->file, s->table ? 0 : s->keys_line, s->keys.data[k], error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < s->set.count; i++)
        for (int32_t k = 0; k < s->keys.count; k++)
            if (strcmp(s->set.data[i].key, s->keys.data[k]) == 0)
                return error_set(error, FRAM_ERROR_INPUT, s->file, s->set.data[i].line, s->set.data[i].key,
                                 "stands in `set` and in `vary`%s%s: a key that the conditions vary has no value for "
                                 "all runs; remove it from one of them",
                                 s->table ? ", in " : "", s->table ? s->table : "");
    return FRAM_OK;
}

static fram_status read_root(const study_source *r)
{
    static const struct {
        const char *name;
        fram_status (*read)(const study_source *, const yaml_node *);
    } keys[] = {{"scenario", read_scenario},     {"set", read_set},   {"seeds", read_seeds},
                {"vary", study_conditions_read}, {"keep", read_keep}, {"extremes", study_extremes_read},
                {"vessel", read_vessel}};
    static const char *const names[] = {"scenario", "set", "seeds", "vary", "keep", "extremes", "vessel"};
    if (r->tree->nodes.count == 0 || r->tree->nodes.data[0].kind != YAML_MAPPING)
        return error_set(r->error, FRAM_ERROR_INPUT, r->out->file, 1, NULL,
                         "the file is no study: expected keys as `scenario: FILE` and `seeds: 20`");
    for (const yaml_node *k = study_child(r, &r->tree->nodes.data[0]); k; k = study_next(r, k)) {
        fram_status status = FRAM_OK;
        bool known = false;
        for (size_t i = 0; i < sizeof keys / sizeof *keys && !known; i++) {
            known = strcmp(study_key(r, k), keys[i].name) == 0;
            if (known)
                status = keys[i].read(r, k);
        }
        if (!known)
            status = study_unknown(r, k, names, sizeof names / sizeof *names);
        if (status != FRAM_OK)
            return status;
    }
    if (!r->out->scenario)
        return error_set(r->error, FRAM_ERROR_INPUT, r->out->file, 1, "scenario", "is missing: name a scenario file");
    int64_t runs = (int64_t)r->out->conditions * r->out->seeds.most;
    if (runs > STUDY_RUNS_MOST)
        return error_set(r->error, FRAM_ERROR_INPUT, r->out->file, 1, "seeds",
                         "found %lld runs, %d conditions with up to %d seeds each: expected at most %d",
                         (long long)runs, (int)r->out->conditions, (int)r->out->seeds.most, STUDY_RUNS_MOST);
    fram_status keys_good = check_keys(r->out, r->error);
    return keys_good == FRAM_OK ? study_extremes_check(r->ctx, r->out, r->error) : keys_good;
}

/* ---- checks of all conditions ---- */

static bool is_varied(const study *s, const char *key)
{
    for (int32_t k = 0; k < s->keys.count; k++)
        if (strcmp(s->keys.data[k], key) == 0)
            return true;
    return false;
}

void study_spell_condition(const study *s, int32_t condition, study_condition_text *out)
{
    enum { ROOM = sizeof out->text };
    size_t used = 0;
    out->text[0] = '\0';
    if (s->keys.count == 0)
        return;
    used += (size_t)snprintf(out->text, ROOM, "condition %d (", (int)condition + 1);
    for (int32_t k = 0; k < s->keys.count; k++) {
        char one[ROOM];
        int length = snprintf(one, sizeof one, "%s%.60s=%.60s", k > 0 ? ", " : "", s->keys.data[k],
                              study_value(s, condition, k));
        /* What has no room is told by conditions.csv. */
        bool fits = used + (size_t)length + sizeof ", ...): " <= ROOM;
        used += (size_t)snprintf(out->text + used, ROOM - used, "%s", fits ? one : ", ...");
        if (!fits)
            break;
    }
    snprintf(out->text + used, ROOM - used, "): ");
}

/* A value that the study gave has its place in the study file or in the table of conditions. */
void study_place_error(const study *s, int32_t condition, fram_error *error)
{
    if (!error)
        return;
    char file[sizeof error->file], message[sizeof error->message], key[sizeof error->key];
    study_condition_text name;
    int line = error->line, column = error->column;
    memcpy(file, error->file, sizeof file);
    memcpy(message, error->message, sizeof message);
    memcpy(key, error->key, sizeof key);
    if (strcmp(file, SCENARIO_OVERRIDE) == 0) {
        bool set = false;
        line = s->table ? s->table_line.data[condition] : s->keys_line;
        for (int32_t i = 0; i < s->set.count; i++) {
            if (strcmp(s->set.data[i].key, key) != 0 || is_varied(s, key))
                continue;
            line = s->set.data[i].line;
            set = true;
        }
        snprintf(file, sizeof file, "%s", s->table && !set ? s->table : s->file);
    }
    study_spell_condition(s, condition, &name);
    error_set(error, FRAM_ERROR_INPUT, file, line, key, "%s%s", name.text, message);
    error->column = column;
}

fram_status study_scenario(context *ctx, const study *s, int32_t condition, int64_t seed, scenario *out,
                           fram_error *error)
{
    text_list items = {0};
    text_buffer text = {0};
    bool good = true;
    for (int32_t i = 0; i <= s->set.count + s->keys.count && good; i++) {
        text.count = 0;
        if (i < s->set.count)
            text_format(ctx, &text, "%s=%s", s->set.data[i].key, s->set.data[i].value);
        else if (i < s->set.count + s->keys.count)
            text_format(ctx, &text, "%s=%s", s->keys.data[i - s->set.count],
                        study_value(s, condition, i - s->set.count));
        else
            text_format(ctx, &text, "run.seed=%lld", (long long)seed);
        good = !text.failed && text_list_add(ctx, &items, text.data);
    }
    const scenario_overrides overrides = {(const char *const *)items.data, items.count};
    fram_status status = good ? scenario_read(ctx, s->scenario, &overrides, out, error) : error_memory(error);
    if (status == FRAM_ERROR_INPUT)
        study_place_error(s, condition, error);
    text_list_free(ctx, &items);
    text_free(ctx, &text);
    return status;
}

static fram_status parse(context *ctx, const char *name, const char *data, size_t size, bool recorded, study *s,
                         fram_error *error)
{
    yaml_tree tree = {0};
    *s = (study){.conditions = 1,
                 .worst = {.figure = ROW_load_largest},
                 .seeds = {.first = 1, .least = 1, .most = 1, .confidence = 0.95}};
    fram_status status = set_text(ctx, &s->file, name) ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK)
        status = yaml_tree_parse(ctx, name, data, size, STUDY_DEPTH_LIMIT, &tree, error);
    const study_source source = {ctx, &tree, s, error, recorded};
    if (status == FRAM_OK)
        status = read_root(&source);
    yaml_tree_free(ctx, &tree);
    if (status != FRAM_OK)
        study_free(ctx, s);
    return status;
}

fram_status study_parse(context *ctx, const char *name, const char *data, size_t size, study *s, fram_error *error)
{
    return parse(ctx, name, data, size, true, s, error);
}

fram_status study_read(context *ctx, const char *path, study *s, fram_error *error)
{
    char *data = NULL;
    size_t size = 0;
    fram_status status = file_read(ctx, path, STUDY_FILE_LIMIT, &data, &size, error);
    if (status == FRAM_OK)
        status = parse(ctx, path, data, size, false, s, error);
    memory_free(ctx, data);
    if (status != FRAM_OK)
        return status;
    status = study_conditions_check(ctx, s, error);
    if (status != FRAM_OK)
        study_free(ctx, s);
    return status;
}
