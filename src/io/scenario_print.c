/* A scenario back to text: every key with its value, in the order of the schema. */
#include "base/hash.h"
#include "base/number_text.h"
#include "io/scenario_file.h"
#include "model/scenario_schema.h"
#include <stdio.h>
#include <string.h>

typedef struct printer {
    context *ctx;
    text_buffer *out;
    const scenario *scenario;
    scenario_print_options options;
} printer;

/* Between double quotes.  The text is printable (io/scenario_file.c): only the quote and the backslash need an escape. */
static void print_quoted(const printer *p, const char *text)
{
    text_add(p->ctx, p->out, "\"");
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            text_add(p->ctx, p->out, "\\");
        text_add_bytes(p->ctx, p->out, text, 1);
    }
    text_add(p->ctx, p->out, "\"");
}

static void print_path(const printer *p, const char *path)
{
    char absolute[4 * SCENARIO_TEXT_SIZE];
    bool fits = p->options.absolute_paths && *path && scenario_resolve_path(p->scenario, path, absolute, sizeof absolute);
    print_quoted(p, fits ? absolute : path);
}

static void print_value(const printer *p, const scenario_key *key, const void *member)
{
    char number[NUMBER_TEXT_SIZE];
    size_t size;
    switch (key->kind) {
    case KEY_REAL:
        real_to_text(*(const double *)member, number);
        text_add(p->ctx, p->out, key->automatic && is_automatic(*(const double *)member) ? "auto" : number);
        break;
    case KEY_INTEGER: text_format(p->ctx, p->out, "%lld", (long long)*(const int64_t *)member); break;
    case KEY_BOOLEAN: text_add(p->ctx, p->out, *(const bool *)member ? "true" : "false"); break;
    case KEY_CHOICE: {
        const char *name = choice_name(key, choice_value(member), &size);
        if (name)
            text_add_bytes(p->ctx, p->out, name, size);
        break;
    }
    case KEY_TEXT: print_quoted(p, member); break;
    case KEY_PATH: print_path(p, member); break;
    case KEY_SECTION:
    case KEY_LIST: break;
    }
}

/* Two blanks a level. */
static void print_indent(const printer *p, int depth)
{
    for (int i = 0; i < depth; i++)
        text_add(p->ctx, p->out, "  ");
}

static void print_comment(const printer *p, const scenario_key *key)
{
    if (!p->options.comments)
        return;
    bool bare = !*key->unit || strcmp(key->unit, "1") == 0;
    text_format(p->ctx, p->out, "  # %s%s%s%s", bare ? "" : "[", bare ? "" : key->unit, bare ? "" : "] ", key->meaning);
}

static void print_section(const printer *p, const scenario_section *section, const void *data, int depth,
                          const char *first);

static void print_list(const printer *p, const scenario_key *key, const void *member, int depth)
{
    int32_t count = list_count(member);
    if (count == 0)
        text_add(p->ctx, p->out, " []");
    print_comment(p, key);
    text_add(p->ctx, p->out, "\n");
    for (int32_t i = 0; i < count; i++)
        print_section(p, key->section, list_element(key, member, i), depth + 2, "- ");
}

/* first, when it is not NULL, takes the place of the first key's last two blanks. */
static void print_section(const printer *p, const scenario_section *section, const void *data, int depth,
                          const char *first)
{
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        const void *member = key_member_const(key, data);
        print_indent(p, first && k == 0 ? depth - 1 : depth);
        if (first && k == 0)
            text_add(p->ctx, p->out, first);
        text_format(p->ctx, p->out, "%s:", key->name);
        if (key->kind == KEY_SECTION) {
            print_comment(p, key);
            text_add(p->ctx, p->out, "\n");
            print_section(p, key->section, member, depth + 1, NULL);
        } else if (key->kind == KEY_LIST) {
            print_list(p, key, member, depth);
        } else {
            text_add(p->ctx, p->out, " ");
            print_value(p, key, member);
            print_comment(p, key);
            text_add(p->ctx, p->out, "\n");
        }
    }
}

fram_status scenario_print(context *ctx, const scenario *s, const scenario_print_options *options, text_buffer *out,
                           fram_error *error)
{
    printer p = {ctx, out, s, options ? *options : (scenario_print_options){.comments = true}};
    print_section(&p, &scenario_schema, s, 0, NULL);
    return out->failed ? error_memory(error) : FRAM_OK;
}

fram_status scenario_hash(context *ctx, const scenario *s, char out[65], fram_error *error)
{
    static const scenario_print_options bare = {0};
    text_buffer text = {0};
    fram_status status = scenario_print(ctx, s, &bare, &text, error);
    if (status == FRAM_OK)
        sha256_text(text.data, (size_t)text.count, out);
    text_free(ctx, &text);
    return status;
}
