/* A scenario back to text: every key with its value, in the order of the schema. */
#include "base/hash.h"
#include "base/number_text.h"
#include "io/path.h"
#include "io/scenario_file.h"
#include "io/utf8.h"
#include "model/scenario_schema.h"
#include <string.h>

/* How paths are written: as given; so that they hold in any folder; or without folders, for the hash, which must be the
   same wherever the files lie (their contents are hashed on their own). */
typedef enum path_style { PATH_GIVEN, PATH_ABSOLUTE, PATH_NAME } path_style;

typedef struct printer {
    context *ctx;
    text_buffer *out;
    const scenario *scenario;
    bool comments;
    bool hashed; /* numbers as they were always written, so that hashes stay */
    path_style paths;
    const scenario_print_options *options; /* NULL: none */
    fram_status status;
    fram_error *error;
} printer;

/* Between double quotes.  The text is printable (io/scenario_file.c): only the quote and the backslash need an escape.
 */
static void print_quoted(printer *p, const char *text)
{
    text_add(p->ctx, p->out, "\"");
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            text_add(p->ctx, p->out, "\\");
        text_add_bytes(p->ctx, p->out, text, 1);
    }
    text_add(p->ctx, p->out, "\"");
}

/* One line of printable UTF-8, as the reader of scenarios asks for it. */
static bool is_printable(const char *text)
{
    for (const char *end = text + strlen(text); text < end;) {
        if (!utf8_is_printable(utf8_next(&text, end)))
            return false;
    }
    return true;
}

fram_status scenario_absolute_path(const scenario *s, const char *key, const char *path, char out[SCENARIO_TEXT_SIZE],
                                   fram_error *error)
{
    char inside[SCENARIO_PATH_ROOM], absolute[SCENARIO_TEXT_SIZE];
    if (!scenario_resolve_path(s, path, inside, sizeof inside) || !path_absolute(inside, absolute, sizeof absolute))
        return error_set(error, FRAM_ERROR_INPUT, s->file, 0, key,
                         "expected a path of at most %d bytes together with its folder", SCENARIO_TEXT_SIZE - 1);
    if (!is_printable(absolute))
        return error_set(error, FRAM_ERROR_INPUT, s->file, 0, key,
                         "expected the folder of the file to have a name in printable UTF-8, found other bytes");
    memcpy(out, absolute, strlen(absolute) + 1);
    return FRAM_OK;
}

static void print_absolute(printer *p, const char *key, const char *path)
{
    char absolute[SCENARIO_TEXT_SIZE];
    if (p->status == FRAM_OK)
        p->status = scenario_absolute_path(p->scenario, key, path, absolute, p->error);
    if (p->status == FRAM_OK)
        print_quoted(p, p->options && p->options->file_name ? p->options->file_name(p->options->file_user, absolute)
                                                            : absolute);
}

static void print_path(printer *p, const char *key, const char *path)
{
    const char *slash = strrchr(path, '/');
    if (p->paths == PATH_ABSOLUTE && *path)
        print_absolute(p, key, path);
    else
        print_quoted(p, p->paths == PATH_NAME && slash ? slash + 1 : path);
}

static void print_value(printer *p, const scenario_key *key, const void *member)
{
    char number[NUMBER_TEXT_SIZE];
    size_t size;
    switch (key->kind) {
    case KEY_REAL:
        (p->hashed ? real_to_text : real_to_pointed_text)(*(const double *)member, number);
        text_add(p->ctx, p->out, key->automatic && is_automatic(*(const double *)member) ? "auto" : number);
        break;
    case KEY_INTEGER:
        text_format(p->ctx, p->out, "%lld", (long long)*(const int64_t *)member);
        break;
    case KEY_BOOLEAN:
        text_add(p->ctx, p->out, *(const bool *)member ? "true" : "false");
        break;
    case KEY_CHOICE: {
        const char *name = choice_name(key, choice_value(member), &size);
        if (name)
            text_add_bytes(p->ctx, p->out, name, size);
        break;
    }
    case KEY_TEXT:
        print_quoted(p, member);
        break;
    case KEY_PATH:
        print_path(p, key->name, member);
        break;
    case KEY_SECTION:
    case KEY_LIST:
        break;
    }
}

/* Two blanks a level. */
static void print_indent(printer *p, int depth)
{
    for (int i = 0; i < depth; i++)
        text_add(p->ctx, p->out, "  ");
}

static void print_comment(printer *p, const scenario_key *key)
{
    if (!p->comments)
        return;
    bool bare = !*key->unit || strcmp(key->unit, "1") == 0;
    text_format(p->ctx, p->out, "  # %s%s%s%s", bare ? "" : "[", bare ? "" : key->unit, bare ? "" : "] ", key->meaning);
}

static void print_section(printer *p, const scenario_section *section, const void *data, int depth, const char *first);

static void print_list(printer *p, const scenario_key *key, const void *member, int depth)
{
    int32_t count = list_count(member);
    if (count == 0)
        text_add(p->ctx, p->out, " []");
    print_comment(p, key);
    text_add(p->ctx, p->out, "\n");
    bool comments = p->comments;
    for (int32_t i = 0; i < count; i++) {
        print_section(p, key->section, list_element(key, member, i), depth + 2, "- ");
        p->comments = false; /* the first item explains them all */
    }
    p->comments = comments;
}

/* first, when it is not NULL, takes the place of the last two blanks before the first key that is written. */
static void print_section(printer *p, const scenario_section *section, const void *data, int depth, const char *first)
{
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        const void *member = key_member_const(key, data);
        if (key_is_silent(section, key, data))
            continue;
        print_indent(p, first ? depth - 1 : depth);
        if (first)
            text_add(p->ctx, p->out, first);
        first = NULL;
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

static fram_status print(printer *p)
{
    p->status = FRAM_OK;
    print_section(p, &scenario_schema, p->scenario, 0, NULL);
    return p->out->failed ? error_memory(p->error) : p->status;
}

fram_status scenario_print(context *ctx, const scenario *s, const scenario_print_options *options, text_buffer *out,
                           fram_error *error)
{
    printer p = {.ctx = ctx,
                 .out = out,
                 .scenario = s,
                 .comments = !options || options->comments,
                 .paths = options && (options->absolute_paths || options->file_name) ? PATH_ABSOLUTE
                          : options && options->names_only                           ? PATH_NAME
                                                                                     : PATH_GIVEN,
                 .options = options,
                 .error = error};
    return print(&p);
}

fram_status scenario_hash(context *ctx, const scenario *s, char out[SHA256_TEXT_SIZE], fram_error *error)
{
    text_buffer text = {0};
    printer p = {.ctx = ctx, .out = &text, .scenario = s, .hashed = true, .paths = PATH_NAME, .error = error};
    fram_status status = print(&p);
    if (status == FRAM_OK)
        sha256_text(text.data, (size_t)text.count, out);
    text_free(ctx, &text);
    return status;
}
