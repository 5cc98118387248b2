/* The input reference, written from the schema. */
#include "base/number_text.h"
#include "io/scenario_file.h"
#include "model/scenario_schema.h"
#include <stdio.h>
#include <string.h>

typedef struct reference {
    context *ctx;
    text_buffer *out;
} reference;

static void add_words(const reference *r, const char *text) { text_add(r->ctx, r->out, text); }

static void add_real(const reference *r, double value)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_text(value, text);
    add_words(r, text);
}

/* "sequential, fast or accurate" */
static void add_choices(const reference *r, const scenario_key *key)
{
    size_t size, ignored;
    const char *name;
    for (int32_t i = 0; (name = choice_name(key, i, &size)) != NULL; i++) {
        bool last = !choice_name(key, i + 1, &ignored);
        add_words(r, i == 0 ? "`" : last ? " or `" : ", `");
        text_add_bytes(r->ctx, r->out, name, size);
        add_words(r, "`");
    }
}

static void add_type(const reference *r, const scenario_key *key)
{
    switch (key->kind) {
    case KEY_REAL:
        add_words(r, key->automatic ? "number or `auto`" : "number");
        break;
    case KEY_INTEGER:
        add_words(r, "integer");
        break;
    case KEY_BOOLEAN:
        add_words(r, "`true` or `false`");
        break;
    case KEY_CHOICE:
        add_choices(r, key);
        break;
    case KEY_TEXT:
        add_words(r, "text");
        break;
    case KEY_PATH:
        add_words(r, "path");
        break;
    case KEY_SECTION:
        add_words(r, "section");
        break;
    case KEY_LIST:
        add_words(r, "list");
        break;
    }
}

static void add_default(const reference *r, const scenario_key *key)
{
    size_t size;
    if (key->kind == KEY_TEXT || key->kind == KEY_PATH) {
        text_format(r->ctx, r->out, "`\"%s\"`", key->text);
    } else if (key->kind == KEY_CHOICE) {
        const char *name = choice_name(key, (int32_t)key->value, &size);
        text_format(r->ctx, r->out, "`%.*s`", (int)size, name);
    } else if (key->kind == KEY_BOOLEAN) {
        add_words(r, key->value != 0 ? "`true`" : "`false`");
    } else if (key->automatic) {
        add_words(r, "`auto`");
    } else {
        add_real(r, key->value);
        if (key->power == 0)
            return;
        add_words(r, key->at == 1 ? " scale" : " (scale / ");
        if (key->at != 1) {
            add_real(r, key->at);
            add_words(r, ")");
        }
        if (key->power != 1) {
            add_words(r, "^");
            add_real(r, key->power);
        }
    }
}

static void add_range(const reference *r, const scenario_key *key)
{
    if (key->kind != KEY_REAL && key->kind != KEY_INTEGER)
        return;
    add_real(r, key->lo);
    add_words(r, " to ");
    add_real(r, key->hi);
}

static void add_row(const reference *r, const scenario_key *key)
{
    text_format(r->ctx, r->out, "| `%s` | ", key->name);
    add_type(r, key);
    text_format(r->ctx, r->out, " | %s | ", strcmp(key->unit, "1") == 0 ? "" : key->unit);
    add_default(r, key);
    add_words(r, " | ");
    add_range(r, key);
    text_format(r->ctx, r->out, " | %s |\n", key->meaning);
}

/* The key before this one whose section has the same keys; NULL when there is none. */
static const scenario_key *shown_before(const scenario_section *section, int32_t key)
{
    for (int32_t k = 0; k < key; k++)
        if (section->keys[k].section == section->keys[key].section)
            return &section->keys[k];
    return NULL;
}

/* The keys of a section as one table, then the sections inside it. */
static void add_section(const reference *r, const scenario_section *section, const char *path)
{
    add_words(r, "| key | type | unit | default | range | meaning |\n| --- | --- | --- | --- | --- | --- |\n");
    for (int32_t k = 0; k < section->key_count; k++)
        if (!section->keys[k].section)
            add_row(r, &section->keys[k]);
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        if (!key->section)
            continue;
        char name[sizeof((scenario_place *)0)->key];
        snprintf(name, sizeof name, "%s%s%s%s", path, *path ? "." : "", key->name, key->kind == KEY_LIST ? "[]" : "");
        text_format(r->ctx, r->out, "\n## %s\n\n%c%s", name, key->meaning[0] - ('a' <= key->meaning[0] ? 32 : 0),
                    key->meaning + 1);
        if (key->kind == KEY_LIST)
            text_format(r->ctx, r->out, "; a list of at most %d mappings", (int)key->hi);
        add_words(r, ".\n\n");
        const scenario_key *same = *path ? NULL : shown_before(section, k);
        if (same)
            text_format(r->ctx, r->out, "Each has the keys of [%s](#%s).\n", same->name, same->name);
        else
            add_section(r, key->section, name);
    }
}

fram_status scenario_reference(context *ctx, text_buffer *out, fram_error *error)
{
    reference r = {ctx, out};
    add_words(
        &r,
        "# Input reference\n\n"
        "Every key that a scenario file may hold. This page is written from the table that the reader itself uses.\n\n"
        "A scenario is YAML, a value a line or in braces (`hull: {length: 90, beam: 20}`); JSON is YAML too, with\n"
        "`auto` as `\"auto\"`. Units are SI unless the column says otherwise (MB, GB, MN/m); only keys that end in\n"
        "`_deg` hold degrees. Directions are towards, counter-clockwise from X. A key that is left out takes its\n"
        "default. Paths are relative to the folder of the scenario. Where a default holds `scale`, that is\n"
        "`run.scale`. `--set run.seed=7` or `--set ice.floes[0].x=3` on the command line overrides a value,\n"
        "`--set vessels.NAME.x=3` one of the vessel of that name. An integer may have a point and zeros behind it:\n"
        "3.0 is 3.\n\n"
        "Anchors, aliases, tags, merge keys and duplicate keys are refused, and so is every key that is not listed\n"
        "here.\n\n"
        "## Top level\n\n");
    add_section(&r, &scenario_schema, "");
    return out->failed ? error_memory(error) : FRAM_OK;
}
