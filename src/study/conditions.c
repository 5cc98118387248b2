#include "study/conditions.h"

#include "base/number_text.h"
#include "io/file.h"
#include "model/scenario.h"
#include "study/condition_table.h"
#include "study/key_names.h"
#include "study/meanings.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fram_status study_refuse(const study_source *r, const yaml_node *node, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return error_set(r->error, FRAM_ERROR_INPUT, r->out->file, node->line, study_key(r, node), "%s", text);
}

const char *study_key(const study_source *r, const yaml_node *node)
{
    /* An element of a list is told by the key of the list. */
    while (node->key < 0 && node->parent >= 0)
        node = &r->tree->nodes.data[node->parent];
    return node->key >= 0 ? yaml_text(r->tree, node->key) : "";
}

study_found_text study_found(const study_source *r, const yaml_node *node)
{
    study_found_text f = {"nothing"};
    const char *text = node->kind == YAML_SCALAR ? yaml_text(r->tree, node->value) : "";
    const char *more = strlen(text) > 40 ? " ..." : "";
    if (node->kind != YAML_SCALAR)
        snprintf(f.text, sizeof f.text, node->kind == YAML_MAPPING ? "a mapping" : "a list");
    else if (*text)
        snprintf(f.text, sizeof f.text, node->quoted ? "the text \"%.40s\"%s" : "%.40s%s", text, more);
    return f;
}

/* Whether the key of a scenario has no keys in it. */
static bool is_leaf(const char *path)
{
    const scenario_key *key = key_of_path(path);
    return key && !key_has_keys(key);
}

static bool has_values(const study_source *r, const yaml_node *node)
{
    const yaml_node *first = node->kind == YAML_MAPPING ? study_child(r, node) : NULL;
    return first && node->count == 1 && strcmp(study_key(r, first), "values") == 0;
}

fram_status study_refuse_kind(const study_source *r, const yaml_node *node, yaml_kind taken, bool or_values,
                              const char *expected)
{
    char key[160];
    const yaml_node *below = node;
    int used = snprintf(key, sizeof key, "%.60s", study_key(r, node));
    while (below->kind == YAML_MAPPING && study_child(r, below) && used < (int)sizeof key && !is_leaf(key)) {
        below = study_child(r, below);
        used += snprintf(key + used, sizeof key - (size_t)used, ".%.60s", study_key(r, below));
    }
    bool good = below->kind == taken || (or_values && has_values(r, below));
    if (below == node || !good || !is_leaf(key))
        return study_refuse(r, node, "expected %s, found %s", expected, study_found(r, node).text);
    const char *value = below->kind == YAML_SCALAR    ? yaml_text(r->tree, below->value)
                        : below->kind == YAML_MAPPING ? "{...}"
                                                      : "[...]";
    return study_refuse(r, node, "expected %s, found a mapping; write %s: %.40s", expected, key, value);
}

void study_beside(const study_source *r, const char *name, text_buffer *path)
{
    const char *slash = strrchr(r->out->file, '/');
    if (name[0] != '/' && slash)
        text_add_bytes(r->ctx, path, r->out->file, (size_t)(slash + 1 - r->out->file));
    text_add(r->ctx, path, name);
}

fram_status study_find_file(const study_source *r, const yaml_node *node, const char *path)
{
    fram_error own = {0};
    fram_status status = file_check(path, &own);
    if (status == FRAM_ERROR_INPUT)
        return study_refuse(r, node, "%s: %s", path, own.message);
    if (status != FRAM_OK && r->error)
        *r->error = own;
    return status;
}

const yaml_node *study_child(const study_source *r, const yaml_node *node)
{
    return node->first >= 0 ? &r->tree->nodes.data[node->first] : NULL;
}

const yaml_node *study_next(const study_source *r, const yaml_node *node)
{
    return node->next >= 0 ? &r->tree->nodes.data[node->next] : NULL;
}

bool study_number_is(const study_source *r, const yaml_node *node, double *out)
{
    bool plain = node->kind == YAML_SCALAR && !node->quoted;
    return real_from_text(plain ? yaml_text(r->tree, node->value) : "", out) == NUMBER_GOOD;
}

fram_status study_number(const study_source *r, const yaml_node *node, double lo, double hi, double *out)
{
    bool quoted = node->kind == YAML_SCALAR && node->quoted;
    double value = 0;
    if (!study_number_is(r, node, &value) || !(value >= lo && value <= hi)) {
        char least[NUMBER_TEXT_SIZE], most[NUMBER_TEXT_SIZE];
        real_to_text(lo, least);
        real_to_text(hi, most);
        return study_refuse(r, node, "expected a number from %s to %s%s, found %s", least, most,
                            quoted ? " without quotes" : "", study_found(r, node).text);
    }
    *out = value;
    return FRAM_OK;
}

fram_status study_whole(const study_source *r, const yaml_node *node, double lo, double hi, int64_t *out)
{
    double value = 0;
    fram_status status = study_number(r, node, lo, hi, &value);
    if (status != FRAM_OK)
        return status;
    if (value != floor(value))
        return study_refuse(r, node, "expected a whole number, found %g", value);
    *out = (int64_t)value;
    return FRAM_OK;
}

fram_status study_time(const study_source *r, const yaml_node *node, double lo, double hi, double *out)
{
    const char *text = node->kind == YAML_SCALAR ? yaml_text(r->tree, node->value) : "";
    double value = 0;
    if (time_from_text(text, &value) == NUMBER_GOOD && value >= lo && value <= hi) {
        *out = value;
        return FRAM_OK;
    }
    return study_refuse(r, node, "expected a time from %g to %g s, as 10800, 90min or 3h, found %s", lo, hi,
                        study_found(r, node).text);
}

/* From the top of the study: "vary.latin.ranges".  out: what it holds already goes before. */
static void add_path(const study_source *r, const yaml_node *node, size_t size, char *out)
{
    if (node->parent >= 0)
        add_path(r, &r->tree->nodes.data[node->parent], size, out);
    size_t used = strlen(out);
    if (node->key >= 0)
        snprintf(out + used, size - used, "%s%.60s", used > 0 ? "." : "", yaml_text(r->tree, node->key));
}

fram_status study_unknown(const study_source *r, const yaml_node *node, const char *const *names, size_t count)
{
    const char *near = word_nearest(names, count, study_key(r, node));
    char path[sizeof r->error->key] = "";
    char list[300] = "";
    size_t used = 0;
    for (size_t i = 0; i < count && used + WORD_ROOM < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s",
                                 i == 0           ? ""
                                 : i + 1 == count ? " or "
                                                  : ", ",
                                 names[i]);
    add_path(r, node, sizeof path, path);
    return error_set(r->error, FRAM_ERROR_INPUT, r->out->file, node->line, path, "unknown key: expected %s%s%s%s", list,
                     near ? "; did you mean " : "", near ? near : "", near ? "?" : "");
}

/* ---- keys and values ---- */

fram_status study_add_key(const study_source *r, const yaml_node *node)
{
    const char *key = study_key(r, node);
    if (strcmp(key, "run.seed") == 0)
        return study_refuse(r, node, "seeds are given by `seeds`, not as a condition");
    return text_list_add(r->ctx, &r->out->keys, key) ? FRAM_OK : error_memory(r->error);
}

fram_status study_add_value(const study_source *r, const yaml_node *node)
{
    if (node->kind != YAML_SCALAR)
        return study_refuse_kind(r, node, YAML_SCALAR, false, "one value of the key");
    return text_list_add(r->ctx, &r->out->values, yaml_text(r->tree, node->value)) ? FRAM_OK : error_memory(r->error);
}

/* Of keys between whose values there are no others, by the kind of key; an unknown one is told with the conditions. */
static fram_status check_rangeable(const study_source *r, const yaml_node *node, const scenario_key *key)
{
    static const char *const is[] = {
        [KEY_BOOLEAN] = "true or false", [KEY_CHOICE] = "a word",     [KEY_TEXT] = "a text",
        [KEY_PATH] = "a file",           [KEY_SECTION] = "a section", [KEY_LIST] = "a list"};
    if (!key || key->kind == KEY_REAL || key->kind == KEY_INTEGER)
        return FRAM_OK;
    return study_refuse(r, node, "is %s and has no range: %s take values of it", is[key->kind],
                        key->kind == KEY_SECTION || key->kind == KEY_LIST ? "grid, list and table"
                                                                          : "grid, list, table and latin");
}

/* The whole numbers of a range. */
static fram_status keep_whole(const study_source *r, const yaml_node *node, key_range *range)
{
    const key_range given = *range;
    *range = (key_range){ceil(given.lo), floor(given.hi), true};
    if (range->hi < range->lo)
        return study_refuse(r, node, "expected a range that holds a whole number, found [%.10g, %.10g]", given.lo,
                            given.hi);
    return FRAM_OK;
}

fram_status study_range(const study_source *r, const yaml_node *node, key_range *out)
{
    const scenario_key *key = key_of_path(study_key(r, node));
    *out = (key_range){0};
    if (node->kind != YAML_SEQUENCE || node->count != 2)
        return study_refuse_kind(r, node, YAML_SEQUENCE, false, "the ends of a range, as [0.5, 1.5]");
    fram_status status = check_rangeable(r, node, key);
    if (status != FRAM_OK)
        return status;
    const yaml_node *lo = study_child(r, node), *hi = study_next(r, lo);
    status = study_number(r, lo, -1e300, 1e300, &out->lo);
    if (status == FRAM_OK)
        status = study_number(r, hi, -1e300, 1e300, &out->hi);
    if (status == FRAM_OK && out->hi < out->lo)
        status = study_refuse(r, node, "expected the smaller end first, as [%.10g, %.10g]", out->hi, out->lo);
    return status == FRAM_OK && key && key->kind == KEY_INTEGER ? keep_whole(r, node, out) : status;
}

/* Whole numbers have an equal share of the way each. */
static double whole_part(key_range range, double part)
{
    return fmin(range.lo + floor(part * (range.hi - range.lo + 1)), range.hi);
}

/* Values of a range are written with so many digits, which are read well, or with more where those miss its width by
   more than a part of it: then they stay within a stratum of a Latin hypercube, and a step from level to level. */
enum { FEWEST_DIGITS = 9, ALL_DIGITS = 17 };
#define WIDTH_MISSED 1e-6

fram_status study_add_part(const study_source *r, key_range range, double part)
{
    char text[32];
    double width = range.hi - range.lo, value = range.lo + part * width;
    int digits = FEWEST_DIGITS;
    do
        snprintf(text, sizeof text, "%.*g", digits, value);
    while (digits++ < ALL_DIGITS && fabs(strtod(text, NULL) - value) > WIDTH_MISSED * width);
    if (range.whole)
        snprintf(text, sizeof text, "%.0f", whole_part(range, part));
    return text_list_add(r->ctx, &r->out->values, text) ? FRAM_OK : error_memory(r->error);
}

fram_status study_expect(const study_source *r, const yaml_node *node, yaml_kind kind, const char *what)
{
    if (node->kind != kind || node->count == 0)
        return study_refuse(r, node, "expected %s, which is not empty", what);
    return FRAM_OK;
}

static fram_status count_conditions(const study_source *r, const yaml_node *node, double conditions)
{
    if (conditions > STUDY_CONDITIONS_MOST)
        return study_refuse(r, node, "found %.0f conditions, expected at most %d", conditions, STUDY_CONDITIONS_MOST);
    r->out->conditions = (int32_t)conditions;
    return FRAM_OK;
}

/* ---- grid: all combinations, the last key fastest ---- */

static const yaml_node *nth_child(const study_source *r, const yaml_node *node, int32_t n)
{
    const yaml_node *child = study_child(r, node);
    while (n-- > 0)
        child = study_next(r, child);
    return child;
}

static fram_status read_grid(const study_source *r, const yaml_node *node)
{
    double conditions = 1;
    fram_status status = study_expect(r, node, YAML_MAPPING, "keys with a list of values each");
    for (const yaml_node *k = study_child(r, node); k && status == FRAM_OK; k = study_next(r, k)) {
        status = k->kind == YAML_MAPPING
                     ? study_refuse_kind(r, k, YAML_SEQUENCE, false, "a list of values, as [0.6, 1.1]")
                     : study_expect(r, k, YAML_SEQUENCE, "a list of values, as [0.6, 1.1]");
        if (status == FRAM_OK)
            status = study_add_key(r, k);
        conditions *= k->count;
    }
    if (status == FRAM_OK)
        status = count_conditions(r, node, conditions);
    for (int32_t c = 0; status == FRAM_OK && c < r->out->conditions; c++) {
        int32_t block = r->out->conditions;
        for (const yaml_node *k = study_child(r, node); k && status == FRAM_OK; k = study_next(r, k)) {
            block /= k->count;
            status = study_add_value(r, nth_child(r, k, c / block % k->count));
        }
    }
    return status;
}

/* ---- list ---- */

/* The value of a key of a condition; NULL: it has none. */
static const yaml_node *find_key(const study_source *r, const yaml_node *condition, const char *key)
{
    const yaml_node *k = study_child(r, condition);
    while (k && strcmp(study_key(r, k), key) != 0)
        k = study_next(r, k);
    return k;
}

static fram_status add_first_condition(const study_source *r, const yaml_node *condition)
{
    fram_status status = FRAM_OK;
    for (const yaml_node *k = study_child(r, condition); k && status == FRAM_OK; k = study_next(r, k)) {
        status = study_add_key(r, k);
        if (status == FRAM_OK)
            status = study_add_value(r, k);
    }
    return status;
}

/* Of the keys of the first one, which stand in any order. */
static fram_status add_later_condition(const study_source *r, const yaml_node *first, const yaml_node *condition)
{
    for (const yaml_node *k = study_child(r, condition); k; k = study_next(r, k))
        if (!find_key(r, first, study_key(r, k)))
            return study_refuse(r, k, "expected the keys of the first condition alone, as %s", r->out->keys.data[0]);
    for (int32_t i = 0; i < r->out->keys.count; i++) {
        const yaml_node *k = find_key(r, condition, r->out->keys.data[i]);
        if (!k)
            return study_refuse(r, condition, "expected the keys of the first condition: %s is missing",
                                r->out->keys.data[i]);
        fram_status status = study_add_value(r, k);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

static fram_status read_list(const study_source *r, const yaml_node *node)
{
    fram_status status = study_expect(r, node, YAML_SEQUENCE, "a list of conditions");
    if (status == FRAM_OK)
        status = count_conditions(r, node, node->count);
    for (const yaml_node *c = study_child(r, node); c && status == FRAM_OK; c = study_next(r, c)) {
        status = study_expect(r, c, YAML_MAPPING, "keys with a value each");
        const yaml_node *first = study_child(r, node);
        if (status == FRAM_OK)
            status = c == first ? add_first_condition(r, c) : add_later_condition(r, first, c);
    }
    return status;
}

/* ---- what is drawn ---- */

fram_status study_drawn_read(const study_source *r, const yaml_node *node, int32_t count_least, int32_t levels_most,
                             drawn_head *out)
{
    static const char *const names[] = {"count", "seed", "keys", "levels"};
    size_t known = sizeof names / sizeof *names - (levels_most > 0 ? 0 : 1);
    out->keys = NULL, out->count = 0, out->seed = 1;
    fram_status status = study_expect(r, node, YAML_MAPPING, "count, keys and, if wanted, seed");
    for (const yaml_node *k = study_child(r, node); k && status == FRAM_OK; k = study_next(r, k)) {
        const char *name = study_key(r, k);
        if (strcmp(name, "count") == 0)
            status = study_whole(r, k, count_least, STUDY_CONDITIONS_MOST, &out->count);
        else if (strcmp(name, "seed") == 0)
            status = study_whole(r, k, 0, (double)SCENARIO_SEED_MOST, &out->seed);
        else if (strcmp(name, "keys") == 0)
            out->keys = k;
        else if (strcmp(name, "levels") == 0 && levels_most > 0)
            status = study_whole(r, k, 2, levels_most, &out->levels);
        else
            status = study_unknown(r, k, names, known);
    }
    if (status == FRAM_OK && (!out->keys || out->count == 0))
        status = study_refuse(r, node, "%s is missing", out->keys ? "count" : "keys");
    return status;
}

/* ---- table ---- */

static fram_status add_condition_table(const study_source *r, const yaml_node *node, condition_table *t)
{
    study *s = r->out;
    for (int32_t k = 0; k < t->heads.count; k++)
        if (strcmp(t->heads.data[k], "run.seed") == 0)
            return study_refuse(r, node, "the table has a column run.seed; seeds are given by `seeds`");
    for (int32_t i = 0; i < t->hours.count; i++)
        if (!array_push(r->ctx, &s->table_hours, t->hours.data[i]))
            return error_memory(r->error);
    array_free(r->ctx, &t->hours);
    s->conditions = t->line.count;
    /* What the table has is the study's; behind this nothing may fail, or both would free it. */
    s->keys = t->heads;
    s->values = t->cells;
    s->table_line = t->line;
    *t = (condition_table){0};
    return FRAM_OK;
}

static fram_status read_table(const study_source *r, const yaml_node *node)
{
    const char *name = node->kind == YAML_SCALAR ? yaml_text(r->tree, node->value) : "";
    if (!*name)
        return study_refuse(r, node, "expected the name of a CSV file with a column for each key");
    text_buffer path = {0};
    study_beside(r, name, &path);
    condition_table t = {0};
    fram_status status = path.failed ? error_memory(r->error) : study_find_file(r, node, path.data);
    if (status == FRAM_OK)
        status = condition_table_read(r->ctx, path.data, &t, r->error);
    if (status == FRAM_OK)
        status = add_condition_table(r, node, &t);
    if (status == FRAM_OK && !(r->out->table = memory_string(r->ctx, path.data)))
        status = error_memory(r->error);
    condition_table_free(r->ctx, &t);
    text_free(r->ctx, &path);
    return status;
}

fram_status study_conditions_read(const study_source *r, const yaml_node *node)
{
    static const struct {
        const char *name;
        fram_status (*read)(const study_source *, const yaml_node *);
    } ways[] = {{"grid", read_grid},         {"list", read_list},         {"table", read_table},
                {"latin", study_latin_read}, {"sobol", study_sobol_read}, {"morris", study_morris_read}};
    if (node->kind != YAML_MAPPING || node->count != 1)
        return study_refuse(r, node, "expected one of grid, list, table, latin, sobol and morris");
    const yaml_node *way = study_child(r, node);
    r->out->keys_line = way->line;
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        if (strcmp(study_key(r, way), ways[i].name) == 0)
            return ways[i].read(r, way);
    static const char *const names[] = {"grid", "list", "table", "latin", "sobol", "morris"};
    char path[sizeof r->error->key] = "";
    add_path(r, way, sizeof path, path);
    /* Sections and keys of a scenario have a point between them. */
    if (strchr(study_key(r, way), '.'))
        return error_set(r->error, FRAM_ERROR_INPUT, r->out->file, way->line, path,
                         "expected how it varies, grid, list, table, latin, sobol or morris, with the key below it: "
                         "write vary: {grid: {%.60s: [...]}}",
                         study_key(r, way));
    return study_unknown(r, way, names, sizeof names / sizeof *names);
}
