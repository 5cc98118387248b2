/* realpath is not in every standard's stdlib.h. */
#define _GNU_SOURCE
#include "study/study_record.h"

#include "base/build_parts.h"
#include "base/hash.h"
#include "base/number_text.h"
#include "fram/version.h"
#include "io/file.h"
#include "io/folder.h"
#include "sim/run_inputs.h"
#include "study/study_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- index.csv ---- */

#define INDEX_HEADS "condition,id,scenario_sha256,inputs_sha256\n"

void study_index_heads(study_folder *f) { text_add(f->ctx, &f->index, INDEX_HEADS); }

void study_index_row(study_folder *f, int32_t condition, const char *scenario_hash, const char *inputs)
{
    text_format(f->ctx, &f->index, "%d,%s,%s,", (int)condition + 1, f->id[condition], scenario_hash);
    const char *blank = "";
    run_input file;
    for (const char *end = inputs + strlen(inputs); run_inputs_next(&inputs, end, &file); blank = " ")
        text_format(f->ctx, &f->index, "%s%s", blank, file.digest);
    text_add(f->ctx, &f->index, "\n");
}

static int by_id(const void *a, const void *b) { return memcmp(a, b, CONDITION_ID); }

/* Whether every row of an index, after its heads, has one of these names, which are sorted, in its second column. */
static bool has_only(const char *row, char (*id)[CONDITION_ID], int32_t count)
{
    while (row && *row) {
        char found[CONDITION_ID];
        const char *cell = strchr(row, ',');
        snprintf(found, sizeof found, "%.*s", CONDITION_ID - 1, cell ? cell + 1 : "");
        if (!bsearch(found, id, (size_t)count, sizeof *id, by_id))
            return false;
        row = strchr(row, '\n');
        row = row ? row + 1 : NULL;
    }
    return true;
}

bool study_index_is_within(const study_folder *f)
{
    static const char heads[] = INDEX_HEADS;
    char *data = NULL;
    size_t size = 0, count = (size_t)f->s->conditions;
    text_buffer path = {0};
    text_format(f->ctx, &path, "%s/index.csv", f->path);
    char(*id)[CONDITION_ID] = memory_array(f->ctx, count, sizeof *id);
    bool within = id && !path.failed && file_is_readable(path.data) &&
                  file_read(f->ctx, path.data, STUDY_FILE_LIMIT, &data, &size, NULL) == FRAM_OK &&
                  strncmp(data, heads, sizeof heads - 1) == 0;
    if (within) {
        memcpy(id, f->id, count * sizeof *id);
        qsort(id, count, sizeof *id, by_id);
        within = has_only(data + sizeof heads - 1, id, f->s->conditions);
    }
    memory_free(f->ctx, id);
    memory_free(f->ctx, data);
    text_free(f->ctx, &path);
    return within;
}

/* ---- effective.yaml ---- */

#define RECORD_BEGINS "# A study with every key and condition, as Fram "

/* The name of a file that was read and the hash of what is in it now. */
static fram_status add_file(context *ctx, text_buffer *b, const char *what, const char *path, fram_error *error)
{
    char *data = NULL, digest[SHA256_TEXT_SIZE];
    size_t size = 0;
    fram_status status = file_read(ctx, path, STUDY_FILE_LIMIT, &data, &size, error);
    if (status != FRAM_OK)
        return status;
    sha256_text(data, size, digest);
    memory_free(ctx, data);
    text_format(ctx, b, "# %s ", what);
    text_add_utf8(ctx, b, path);
    text_format(ctx, b, ", sha256 %s\n", digest);
    return FRAM_OK;
}

static void add_number(context *ctx, text_buffer *b, const char *key, double value)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_pointed_text(value, text);
    text_format(ctx, b, "%s%s", key, text);
}

static void add_numbers(context *ctx, text_buffer *b, const char *key, const double *value, int32_t count)
{
    if (count == 0)
        return;
    text_add(ctx, b, key);
    for (int32_t i = 0; i < count; i++)
        add_number(ctx, b, i > 0 ? ", " : "[", value[i]);
    text_add(ctx, b, "]");
}

static void add_seeds(context *ctx, text_buffer *b, const study_seeds *s)
{
    text_format(ctx, b, "seeds: {first: %lld, least: %d", (long long)s->first, (int)s->least);
    if (s->most > s->least)
        text_format(ctx, b, ", most: %d", (int)s->most);
    if (s->mean_within > 0)
        add_number(ctx, b, ", mean_within: ", s->mean_within);
    if (s->largest_within > 0)
        add_number(ctx, b, ", largest_within: ", s->largest_within);
    if (s->extreme_within > 0)
        add_number(ctx, b, ", extreme_within: ", s->extreme_within);
    add_number(ctx, b, ", confidence: ", s->confidence);
    text_add(ctx, b, "}\n");
}

static void add_extremes(context *ctx, text_buffer *b, const study_extremes *x)
{
    if (!x->asked)
        return;
    add_number(ctx, b, "extremes: {duration: ", x->duration);
    text_format(ctx, b, ", method: %s", x->gev ? "gev" : "gumbel");
    add_number(ctx, b, ", confidence: ", x->confidence);
    add_numbers(ctx, b, ", levels: ", x->level, x->levels);
    add_numbers(ctx, b, ", hours: ", x->hours.data, x->hours.count);
    add_numbers(ctx, b, ", annual: ", x->annual, x->annuals);
    text_add(ctx, b, "}\n");
}

static void add_record_value(context *ctx, text_buffer *b, const char *before, const char *key, const char *value)
{
    text_add(ctx, b, before);
    text_quoted(ctx, b, key);
    text_add(ctx, b, ": ");
    text_quoted(ctx, b, value);
}

/* What a design is made of, as the study file has it: of its points alone nobody could tell a sensitivity. */
static void add_design(context *ctx, text_buffer *b, const study *s)
{
    const study_design *d = &s->design;
    text_format(ctx, b, "vary:\n  %s: {count: %d, seed: %lld", d->kind == DESIGN_SOBOL ? "sobol" : "morris",
                (int)d->count, (long long)d->seed);
    if (d->kind == DESIGN_MORRIS)
        text_format(ctx, b, ", levels: %d", (int)d->levels);
    for (int32_t k = 0; k < s->keys.count; k++) {
        text_add(ctx, b, k > 0 ? ", " : ", keys: {");
        text_quoted(ctx, b, s->keys.data[k]);
        add_number(ctx, b, ": [", d->range.data[k].lo);
        add_number(ctx, b, ", ", d->range.data[k].hi);
        text_add(ctx, b, "]");
    }
    text_add(ctx, b, "}}\n# Its points, which are the conditions:\n");
}

static void add_conditions(context *ctx, text_buffer *b, const study *s)
{
    bool design = s->design.kind != DESIGN_NONE;
    if (design)
        add_design(ctx, b, s);
    else if (s->keys.count > 0)
        text_add(ctx, b, "vary:\n  list:\n");
    for (int32_t c = 0; c < s->conditions && s->keys.count > 0; c++) {
        text_add(ctx, b, design ? "#   " : "    ");
        for (int32_t k = 0; k < s->keys.count; k++)
            add_record_value(ctx, b, k > 0 ? ", " : "- {", s->keys.data[k], study_value(s, c, k));
        text_add(ctx, b, "}\n");
    }
}

char *study_scenario_whole(context *ctx, const study *s)
{
    text_buffer shown = {0};
    char *whole = realpath(s->scenario, NULL);
    text_add_utf8(ctx, &shown, whole ? whole : s->scenario);
    char *out = shown.failed ? NULL : memory_string(ctx, shown.data);
    text_free(ctx, &shown);
    free(whole);
    return out;
}

static fram_status add_study(const study_folder *f, text_buffer *b, fram_error *error)
{
    static const char *const keeps[] = {[KEEP_SUMMARY] = "summary", [KEEP_SERIES] = "series", [KEEP_ALL] = "all"};
    const study *s = f->s;
    context *ctx = f->ctx;
    text_format(ctx, b, RECORD_BEGINS "%s (%s; %s) read it.\n", FRAM_VERSION, build_compiler(), build_parts());
    fram_status status = add_file(ctx, b, "study file", s->file, error);
    if (status == FRAM_OK)
        status = add_file(ctx, b, "scenario", s->scenario, error);
    if (status == FRAM_OK && s->table)
        status = add_file(ctx, b, "conditions", s->table, error);
    char *whole = study_scenario_whole(ctx, s);
    if (!whole)
        return error_memory(error);
    text_add(ctx, b, "scenario: ");
    text_quoted(ctx, b, whole);
    memory_free(ctx, whole);
    if (s->vessel)
        add_record_value(ctx, b, "\n", "vessel", s->vessel);
    for (int32_t i = 0; i < s->set.count; i++)
        add_record_value(ctx, b, i > 0 ? ", " : "\nset: {", s->set.data[i].key, s->set.data[i].value);
    text_add(ctx, b, s->set.count > 0 ? "}\n" : "\n");
    add_seeds(ctx, b, &s->seeds);
    if (s->worst.count > 0)
        text_format(ctx, b, "keep: {each: %s, record_of_worst: %d, by: %s}\n", keeps[s->keep], (int)s->worst.count,
                    run_figure_name((run_figure)s->worst.figure));
    else
        text_format(ctx, b, "keep: %s\n", keeps[s->keep]);
    add_extremes(ctx, b, &s->extremes);
    add_conditions(ctx, b, s);
    return status;
}

fram_status study_record_write(const study_folder *f, fram_error *error)
{
    text_buffer b = {0};
    fram_status status = add_study(f, &b, error);
    if (status == FRAM_OK)
        status = study_table_write(f, "effective.yaml", &b, error);
    if (status == FRAM_OK)
        status = study_table_write(f, "index.csv", &f->index, error);
    text_free(f->ctx, &b);
    return status;
}

bool study_record_is_there(const char *folder)
{
    return folder_file_begins(folder, "study.yaml", "") &&
           (folder_file_begins(folder, "effective.yaml", RECORD_BEGINS) ||
            folder_file_begins(folder, "index.csv", INDEX_HEADS));
}
