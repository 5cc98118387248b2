/* From text to a checked scenario: a YAML tree walked along the schema.  Types and names are judged here, with the
   place at hand; ranges and rules between keys in model/scenario_check.c. */
#include "io/scenario_file.h"
#include "base/number_text.h"
#include "io/file.h"
#include "io/key_words.h"
#include "io/path.h"
#include "io/utf8.h"
#include "io/yaml_tree.h"
#include "model/scenario_schema.h"
#include <stdio.h>
#include <string.h>

typedef struct scenario_reader {
    context *ctx;
    const char *file;
    const yaml_tree *tree;
    scenario *scenario;
    double scale;
    fram_error *error;
} scenario_reader;

/* Where a value stands. */
typedef struct value_place {
    char key[KEY_SIZE];
    int32_t line, column;
    bool override;
} value_place;

static fram_status refuse(const scenario_reader *r, const value_place *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static fram_status refuse(const scenario_reader *r, const value_place *place, const char *format, ...)
{
    char message[sizeof r->error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    error_set(r->error, FRAM_ERROR_INPUT, place->override ? SCENARIO_OVERRIDE : r->file, place->line, place->key, "%s",
              message);
    if (r->error)
        r->error->column = place->column;
    return FRAM_ERROR_INPUT;
}

static fram_status remember(const scenario_reader *r, const value_place *place)
{
    scenario_place given = {.line = place->line, .column = place->column, .override = place->override};
    memcpy(given.key, place->key, sizeof given.key);
    return array_push(r->ctx, &r->scenario->places, given) ? FRAM_OK : error_memory(r->error);
}

/* ---- values ---- */

/* What was found, for messages: quoted and cut. */
typedef struct found_text {
    char text[64];
} found_text;

static found_text shown(const char *text)
{
    found_text f = {"nothing"};
    if (*text)
        snprintf(f.text, sizeof f.text, "\"%.40s\"%s", text, strlen(text) > 40 ? " ..." : "");
    return f;
}

static fram_status set_real(const scenario_reader *r, const scenario_key *key, double *member, const char *text,
                            const value_place *place)
{
    if (key->automatic && strcmp(text, "auto") == 0) {
        *member = (double)NAN;
        return FRAM_OK;
    }
    number_fault fault = real_from_text(text, member);
    if (fault == NUMBER_GOOD)
        return FRAM_OK;
    const char *unit = strcmp(key->unit, "1") == 0 ? "" : key->unit;
    return refuse(r, place, "expected a%s number%s%s%s, found %s%s", fault == NUMBER_TOO_LARGE ? " smaller" : "",
                  *unit ? " in " : "", unit, key->automatic ? " or auto" : "", shown(text).text,
                  fault == NUMBER_TOO_LARGE ? ", which is too large" : "");
}

static fram_status set_integer(const scenario_reader *r, int64_t *member, const char *text, const value_place *place)
{
    number_fault fault = whole_from_text(text, member);
    if (fault == NUMBER_GOOD)
        return FRAM_OK;
    return refuse(r, place, "expected %s integer, found %s", fault == NUMBER_TOO_LARGE ? "a smaller" : "an",
                  shown(text).text);
}

static fram_status set_boolean(const scenario_reader *r, bool *member, const char *text, const value_place *place)
{
    *member = strcmp(text, "true") == 0;
    if (*member || strcmp(text, "false") == 0)
        return FRAM_OK;
    return refuse(r, place, "expected true or false, found %s", shown(text).text);
}

static fram_status set_choice(const scenario_reader *r, const scenario_key *key, void *member, const char *text,
                              const value_place *place)
{
    int32_t value = choice_find(key, text);
    if (value < 0)
        return refuse(r, place, "expected one of: %s; found %s", key->text, shown(text).text);
    choice_set(member, value);
    return FRAM_OK;
}

/* One line of printable UTF-8, so that it can be printed back between quotes. */
static fram_status set_text(const scenario_reader *r, char *member, const char *text, const value_place *place)
{
    size_t size = strlen(text);
    if (size >= SCENARIO_TEXT_SIZE)
        return refuse(r, place, "expected at most %d bytes of text, found %zu", SCENARIO_TEXT_SIZE - 1, size);
    for (const char *at = text; *at;) {
        int32_t code = utf8_next(&at, text + size);
        if (code < 0 || !utf8_is_printable(code))
            return refuse(r, place, "expected one line of printable text, found a control character or line break");
    }
    memset(member, 0, SCENARIO_TEXT_SIZE);
    memcpy(member, text, size + 1);
    return FRAM_OK;
}

static fram_status set_value(const scenario_reader *r, const scenario_key *key, void *member, const char *text,
                             const value_place *place)
{
    switch (key->kind) {
    case KEY_REAL:
        return set_real(r, key, member, text, place);
    case KEY_INTEGER:
        return set_integer(r, member, text, place);
    case KEY_BOOLEAN:
        return set_boolean(r, member, text, place);
    case KEY_CHOICE:
        return set_choice(r, key, member, text, place);
    case KEY_TEXT:
    case KEY_PATH:
        return set_text(r, member, text, place);
    case KEY_SECTION:
        return refuse(r, place, "expected keys under %s, found %s", place->key, shown(text).text);
    case KEY_LIST:
        return refuse(r, place, "expected a list, found %s", shown(text).text);
    }
    return FRAM_ERROR_INTERNAL;
}

/* The null of YAML: nothing written, or one of its names (YAML 1.2, 10.3.2). */
static bool is_empty(const yaml_tree *tree, int32_t index)
{
    static const char *const nulls[] = {"", "~", "null", "Null", "NULL"};
    const yaml_node *node = &tree->nodes.data[index];
    if (node->kind != YAML_SCALAR || node->quoted)
        return false;
    for (size_t i = 0; i < sizeof nulls / sizeof *nulls; i++)
        if (strcmp(yaml_text(tree, node->value), nulls[i]) == 0)
            return true;
    return false;
}

/* A scalar of the file.  Quotes say that text is meant; JSON has no other way to write auto. */
static fram_status read_scalar(const scenario_reader *r, const scenario_key *key, void *member, int32_t index,
                               const value_place *place)
{
    const yaml_node *node = &r->tree->nodes.data[index];
    const char *text = yaml_text(r->tree, node->value);
    if (is_empty(r->tree, index))
        return refuse(r, place, "expected a value, found nothing: leave the key out to take its default");
    bool automatic = key->automatic && strcmp(text, "auto") == 0;
    if (node->quoted && !automatic && (key->kind == KEY_REAL || key->kind == KEY_INTEGER || key->kind == KEY_BOOLEAN))
        return refuse(r, place, "expected %s without quotes, found the text %s",
                      key->kind == KEY_BOOLEAN ? "true or false" : "a number", shown(text).text);
    return set_value(r, key, member, text, place);
}

/* ---- names ---- */

static fram_status unknown_key(const scenario_reader *r, const scenario_section *section, const char *path,
                               const char *name, const value_place *place)
{
    char other[KEY_SIZE], nested[KEY_NESTED_SIZE];
    const char *where = *path ? path : "the scenario", *meant = key_meant(section, path, name, other);
    if (key_nested(section, name, nested))
        return refuse(r, place, "expected a key of %s, found %s: write %s", where, shown(name).text, nested);
    if (key_lacks(path, name))
        return refuse(r, place, "expected a key of %s, found %s: %s", where, shown(name).text, key_lacks(path, name));
    if (meant && strcmp(meant, name) == 0)
        return refuse(r, place, "expected a key of %s, found %s, which is a key of the whole scenario", where,
                      shown(name).text);
    if (meant)
        return refuse(r, place, "expected a key of %s, found %s; did you mean %s?", where, shown(name).text, meant);
    return refuse(r, place, "expected a key of %s, found %s", where, shown(name).text);
}

/* ---- the file ---- */

static fram_status read_section(const scenario_reader *r, const scenario_section *section, void *data, int32_t index,
                                const value_place *place);

static const char *kind_text(const yaml_node *node)
{
    return node->kind == YAML_SCALAR ? "a single value" : node->kind == YAML_MAPPING ? "a mapping" : "a list";
}

static fram_status read_list(const scenario_reader *r, const scenario_key *key, void *member, const yaml_node *node,
                             const value_place *place)
{
    if (node->kind != YAML_SEQUENCE)
        return refuse(r, place, "expected a list, every item begun by \"- \", found %s", kind_text(node));
    if (node->count > (int32_t)key->hi) /* before memory is spent on them */
        return refuse(r, place, "expected at most %d items, found %d", (int)key->hi, (int)node->count);
    int32_t index = 0;
    fram_status status = FRAM_OK;
    for (int32_t i = node->first; i >= 0 && status == FRAM_OK; i = r->tree->nodes.data[i].next) {
        const yaml_node *item = &r->tree->nodes.data[i];
        value_place at = {.line = item->line, .column = item->column};
        snprintf(at.key, sizeof at.key, "%.80s[%d]", place->key, (int)index++);
        void *element = list_append(r->ctx, key, member, r->scale);
        status = element ? read_section(r, key->section, element, i, &at) : error_memory(r->error);
    }
    return status;
}

static fram_status read_value(const scenario_reader *r, const scenario_key *key, void *member, int32_t index,
                              const value_place *place)
{
    const yaml_node *node = &r->tree->nodes.data[index];
    if (key->kind == KEY_SECTION)
        return read_section(r, key->section, member, index, place);
    fram_status status = remember(r, place);
    if (status != FRAM_OK)
        return status;
    if (key->kind == KEY_LIST)
        return read_list(r, key, member, node, place);
    if (node->kind != YAML_SCALAR)
        return refuse(r, place, "expected a single value, found %s", kind_text(node));
    return read_scalar(r, key, member, index, place);
}

static fram_status read_section(const scenario_reader *r, const scenario_section *section, void *data, int32_t index,
                                const value_place *place)
{
    const yaml_node *node = &r->tree->nodes.data[index];
    if (node->kind != YAML_MAPPING)
        return refuse(r, place, "expected keys, each on its own line with \": \" and a value, found %s",
                      is_empty(r->tree, index) ? "nothing" : kind_text(node));
    fram_status status = *place->key ? remember(r, place) : FRAM_OK;
    for (int32_t i = node->first; i >= 0 && status == FRAM_OK; i = r->tree->nodes.data[i].next) {
        const yaml_node *child = &r->tree->nodes.data[i];
        const char *name = yaml_text(r->tree, child->key);
        value_place at = {.line = child->key_line, .column = child->key_column};
        key_join(at.key, place->key, name);
        int32_t k = section_find(section, name);
        if (k < 0)
            return unknown_key(r, section, place->key, name, &at);
        if (child->kind == YAML_SCALAR) {
            at.line = child->line;
            at.column = child->column;
        }
        status = read_value(r, &section->keys[k], key_member(&section->keys[k], data), i, &at);
    }
    return status;
}

/* ---- overrides ---- */

/* A word that is neither a number nor a name.  path: of the list, from the top. */
static fram_status refuse_item(const scenario_reader *r, const scenario_key *key, const void *member, const char *path,
                               const char *word, const value_place *place)
{
    char names[ITEM_NAMES_SIZE];
    const char *meant = item_meant(key, member, word, names);
    return refuse(r, place, "expected the number of an item, %s[0], %s[1], ...%s%s%s%s%s%s", path, path, names,
                  *word ? "; found " : "", *word ? shown(word).text : "", meant ? "; did you mean " : "",
                  meant ? meant : "", meant ? "?" : "");
}

/* Of vessels the short form may be meant, whose key is called otherwise.  rest: of the key, behind the item. */
static fram_status refuse_empty(const scenario_reader *r, const scenario_key *key, const void *member, const char *path,
                                const char *rest, const value_place *place)
{
    if (member == &r->scenario->vessels && !scenario_given(r->scenario, key->name))
        return refuse(r, place, "the file lists no vessels; the key of its one vessel is vessel%s",
                      *rest == '.' ? rest : ".NAME");
    return refuse(r, place, "expected an item of %s, and the file lists none", path);
}

/* The item of a list that the file has: "[3]" or ".3", where items have names "[NAME]" or ".NAME"; moves *at behind
   it.  path: of the list, from the top, as in all that is refused here: its last key alone is none that --set takes. */
static fram_status step_into_list(const scenario_reader *r, const scenario_key *key, void *member, const char *path,
                                  const char **at, const value_place *place, int32_t *item)
{
    const char *text = *at;
    bool bracket = *text == '[', point = *text == '.';
    size_t length = bracket ? strcspn(text, "]") : point ? 1 + strcspn(text + 1, ".[") : 0;
    char word[KEY_SIZE] = "";
    if (length > 1)
        memcpy(word, text + 1, length - 1);
    int64_t index = item_find(key, member, word);
    int32_t count = list_count(member);
    *at = text + length + (bracket && text[length]);
    *item = (int32_t)index;
    if (index >= 0)
        return FRAM_OK;
    if (count == 0)
        return refuse_empty(r, key, member, path, *at, place);
    bool number = strlen(word) < 12 && *word != '+' && integer_from_text(word, &index) == NUMBER_GOOD;
    if (!number || (bracket && text[length] != ']'))
        return refuse_item(r, key, member, path, word, place);
    if (index < 0 || index >= count)
        return refuse(r, place, "expected an item below %s[%d], since the file lists %d, found [%s]", path, (int)count,
                      (int)count, word);
    *item = (int32_t)index;
    return FRAM_OK;
}

/* Follow the dotted name of place along the schema, then set the value.  place gets the name as the file would give it:
   items of lists by number. */
static fram_status set_path(const scenario_reader *r, value_place *place, const char *text)
{
    const scenario_section *section = &scenario_schema;
    void *data = r->scenario;
    const char *at = place->key;
    char path[KEY_SIZE] = "";
    for (;;) {
        char name[KEY_SIZE] = "", full[KEY_SIZE];
        size_t size = strcspn(at, ".[");
        memcpy(name, at, size);
        int32_t k = section_find(section, name);
        if (k < 0)
            return unknown_key(r, section, path, name, place);
        const scenario_key *key = &section->keys[k];
        void *member = key_member(key, data);
        at += size;
        key_join(full, path, name);
        memcpy(path, full, sizeof path);
        if (key->kind == KEY_LIST) {
            int32_t item;
            fram_status status = step_into_list(r, key, member, path, &at, place, &item);
            if (status != FRAM_OK)
                return status;
            data = list_element(key, member, item);
            snprintf(path, sizeof path, "%.80s[%d]", full, (int)item);
        } else if (key->kind == KEY_SECTION) {
            data = member;
        } else if (*at == '\0') {
            memcpy(place->key, path, sizeof path);
            return set_value(r, key, member, text, place);
        } else {
            return refuse(r, place, "expected nothing after %s, found %s", path, shown(at).text);
        }
        if (*at != '.')
            return refuse(r, place, "expected a key inside %s, as in %s.NAME=VALUE", path, path);
        section = key->section;
        at++;
    }
}

static fram_status apply_override(const scenario_reader *r, const char *item)
{
    value_place place = {.override = true};
    const char *equals = strchr(item, '=');
    if (!equals || equals == item)
        return refuse(r, &place, "expected key=value, as in run.seed=7, found %s", shown(item).text);
    size_t size = (size_t)(equals - item);
    if (size >= sizeof place.key)
        return refuse(r, &place, "expected a key, found %s", shown(item).text);
    memcpy(place.key, item, size);
    fram_status status = set_path(r, &place, equals + 1);
    return status == FRAM_OK ? remember(r, &place) : status;
}

/* ---- the whole ---- */

/* File and overrides over the defaults of a scale. */
static fram_status read_all(scenario_reader *r, const scenario_overrides *overrides)
{
    scenario_defaults(r->scenario, r->scale);
    snprintf(r->scenario->file, sizeof r->scenario->file, "%s", r->file);
    value_place root = {.line = 1, .column = 1};
    fram_status status = FRAM_OK;
    if (r->tree->nodes.count == 0 || is_empty(r->tree, 0))
        status = refuse(r, &root,
                        "expected keys, found an empty file, as is left of one that was cut off; {} alone asks "
                        "for the default of every key");
    else
        status = read_section(r, &scenario_schema, r->scenario, 0, &root);
    for (int32_t i = 0; overrides && i < overrides->count && status == FRAM_OK; i++)
        status = apply_override(r, overrides->items[i]);
    if (status != FRAM_OK)
        scenario_free(r->ctx, r->scenario);
    return status;
}

fram_status scenario_parse(context *ctx, const char *name, const char *text, size_t size,
                           const scenario_overrides *overrides, scenario *s, fram_error *error)
{
    if (size > SCENARIO_FILE_LIMIT)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL, "expected at most %d bytes, found %zu",
                         SCENARIO_FILE_LIMIT, size);
    if (strlen(name) >= SCENARIO_TEXT_SIZE)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL, "expected a path of at most %d bytes, found %zu",
                         SCENARIO_TEXT_SIZE - 1, strlen(name));
    yaml_tree tree;
    fram_status status = yaml_brackets_check(name, text, size, SCENARIO_BRACKET_LIMIT, error);
    if (status == FRAM_OK)
        status = yaml_tree_parse(ctx, name, text, size, SCENARIO_DEPTH_LIMIT, &tree, error);
    if (status != FRAM_OK)
        return status;
    scenario_reader r = {ctx, name, &tree, s, scenario_default_scale(), error};
    status = read_all(&r, overrides);
    /* Defaults follow the scale, which is known only now. */
    if (status == FRAM_OK && s->run.scale > 0 && s->run.scale != r.scale) {
        r.scale = s->run.scale;
        scenario_free(ctx, s);
        status = read_all(&r, overrides);
    }
    yaml_tree_free(ctx, &tree);
    fram_status checked = status == FRAM_OK ? scenario_check(s, error) : status;
    if (status == FRAM_OK && checked != FRAM_OK)
        scenario_free(ctx, s);
    return checked;
}

/* Every file that is named must be there: better told here, with the key, than by whoever reads it. */
static fram_status look_for_file(void *user, const scenario_key *key, const void *member, const char *name,
                                 fram_error *error)
{
    const scenario *s = user;
    const char *given = member;
    if (key->kind != KEY_PATH || !*given)
        return FRAM_OK;
    char path[SCENARIO_PATH_ROOM];
    fram_error reason = {0};
    if (!scenario_resolve_path(s, given, path, sizeof path))
        return scenario_fault(s, error, name, "expected a shorter path");
    if (file_check(path, &reason) != FRAM_OK)
        return scenario_fault(s, error, name, "expected a file that can be read at %.300s: %s", path, reason.message);
    return FRAM_OK;
}

fram_status scenario_find_files(context *ctx, scenario *s, fram_error *error)
{
    fram_status status = scenario_walk(s, look_for_file, s, error);
    if (status != FRAM_OK)
        scenario_free(ctx, s);
    else /* they stay the same ones when the program changes it */
        (void)path_absolute("", s->folder, sizeof s->folder);
    return status;
}

fram_status scenario_read_alone(context *ctx, const char *path, const scenario_overrides *overrides, scenario *s,
                                fram_error *error)
{
    char *text;
    size_t size;
    fram_status status = file_read(ctx, path, SCENARIO_FILE_LIMIT, &text, &size, error);
    if (status != FRAM_OK)
        return status;
    status = scenario_parse(ctx, path, text, size, overrides, s, error);
    memory_free(ctx, text);
    return status;
}

fram_status scenario_read(context *ctx, const char *path, const scenario_overrides *overrides, scenario *s,
                          fram_error *error)
{
    fram_status status = scenario_read_alone(ctx, path, overrides, s, error);
    return status == FRAM_OK ? scenario_find_files(ctx, s, error) : status;
}
