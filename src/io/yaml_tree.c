/* The events of libfyaml strung into a tree.  libfyaml scans; what is allowed is decided here. */
#include "io/yaml_tree.h"
#include "base/hash.h"
#include "io/utf8.h"
#include "io/yaml_indent.h"
#include <libfyaml.h>
#include <stdio.h>
#include <string.h>

/* Deeper nesting than any reader asks for. */
enum { STACK_SIZE = 64 };

/* An open mapping or sequence. */
typedef struct open_node {
    int32_t node;
    int32_t last; /* its latest child, -1 */
    int32_t key;  /* in the text: the key that waits for its value, -1 */
    int32_t name; /* the key of its latest child */
    int32_t key_line, key_column;
} open_node;

typedef struct yaml_builder {
    context *ctx;
    const char *name, *data;
    size_t size;
    fram_error *error;
    yaml_tree *tree;
    int32_t depth, depth_limit;
    open_node open[STACK_SIZE];
    int32_t documents;
    int32_t line, column; /* of the latest event that has a place */
    ARRAY(int32_t) names; /* hash table of the nodes that have a key, -1: free slot; the size is a power of two */
    int32_t name_count;
} yaml_builder;

/* Full name of what is being read, "ice.floes[2].x": the keys of the open nodes and the key that waits. */
static void current_path(const yaml_builder *b, char out[128])
{
    size_t used = 0;
    out[0] = '\0';
    for (int32_t i = 0; i < b->depth && used < 127; i++) {
        const open_node *open = &b->open[i];
        const yaml_node *node = &b->tree->nodes.data[open->node];
        int length = 0;
        if (node->kind == YAML_SEQUENCE)
            length = snprintf(out + used, 128 - used, "[%d]", (int)node->count - (i + 1 < b->depth ? 1 : 0));
        else if (open->key >= 0 || i + 1 < b->depth)
            length = snprintf(out + used, 128 - used, "%s%s", used > 0 ? "." : "",
                              yaml_text(b->tree, open->key >= 0 ? open->key : open->name));
        used += length > 0 ? (size_t)length : 0;
    }
}

static fram_status refuse_here(yaml_builder *b, const char *message)
{
    char path[128];
    current_path(b, path);
    error_set(b->error, FRAM_ERROR_INPUT, b->name, b->line, path, "%s", message);
    if (b->error)
        b->error->column = b->column;
    return FRAM_ERROR_INPUT;
}

static void move_to(yaml_builder *b, const struct fy_mark *mark)
{
    if (!mark)
        return;
    b->line = mark->line + 1;
    b->column = mark->column + 1;
}

/* ---- duplicate keys: a hash table, since a file may hold very many keys ---- */

/* Slot of the node with this parent and key, or the free one where it belongs. */
static int32_t name_slot(const yaml_builder *b, int32_t parent, const char *key)
{
    const yaml_tree *tree = b->tree;
    uint32_t mask = (uint32_t)b->names.count - 1;
    uint32_t slot = (uint32_t)hash_bytes(key, strlen(key), (uint64_t)parent) & mask;
    for (;; slot = (slot + 1) & mask) {
        int32_t i = b->names.data[slot];
        if (i < 0 ||
            (tree->nodes.data[i].parent == parent && strcmp(yaml_text(tree, tree->nodes.data[i].key), key) == 0))
            return (int32_t)slot;
    }
}

/* Twice the room when the table is half full. */
static bool names_grow(yaml_builder *b)
{
    if (b->name_count < b->names.count / 2)
        return true;
    int32_t count = b->names.count ? 2 * b->names.count : 256;
    if (!array_resize(b->ctx, &b->names, count))
        return false;
    memset(b->names.data, 0xff, (size_t)count * sizeof *b->names.data);
    b->name_count = 0;
    for (int32_t i = 0; i < b->tree->nodes.count; i++) {
        const yaml_node *node = &b->tree->nodes.data[i];
        if (node->key < 0)
            continue;
        b->names.data[name_slot(b, node->parent, yaml_text(b->tree, node->key))] = i;
        b->name_count++;
    }
    return true;
}

/* ---- building ---- */

static fram_status keep_text(yaml_builder *b, const char *data, size_t size)
{
    yaml_tree *tree = b->tree;
    if (size >= (size_t)(INT32_MAX - tree->text.count) ||
        !array_reserve(b->ctx, &tree->text, tree->text.count + (int32_t)size))
        return error_memory(b->error);
    memcpy(tree->text.data + tree->text.count, data, size);
    tree->text.count += (int32_t)size;
    return FRAM_OK;
}

/* Text of a scalar, appended with a NUL; its offset goes to *at.  Chunk by chunk: fy_token_get_text of libfyaml 0.7.12
   leaks memory on text of many lines or escapes. */
static fram_status add_text(yaml_builder *b, struct fy_token *token, int32_t *at)
{
    fram_status status = FRAM_OK;
    *at = b->tree->text.count;
    struct fy_token_iter *iterator = token ? fy_token_iter_create(token) : NULL;
    if (token && !iterator)
        return error_memory(b->error);
    const struct fy_iter_chunk *chunk = NULL;
    int failed = 0;
    while (iterator && status == FRAM_OK && (chunk = fy_token_iter_chunk_next(iterator, chunk, &failed)) != NULL)
        status = memchr(chunk->str, '\0', chunk->len) ? refuse_here(b, "expected text, found a NUL character in it")
                                                      : keep_text(b, chunk->str, chunk->len);
    if (iterator)
        fy_token_iter_destroy(iterator);
    /* An empty block scalar is reported as a failure too. */
    bool empty = b->tree->text.count == *at && token && fy_token_get_text0(token) && !*fy_token_get_text0(token);
    if (status == FRAM_OK && failed && !empty)
        status = error_memory(b->error);
    return status == FRAM_OK ? keep_text(b, "", 1) : status;
}

/* A new node under the innermost open one, with the key that waits there. */
static fram_status add_node(yaml_builder *b, yaml_node node, int32_t *index)
{
    yaml_tree *tree = b->tree;
    open_node *open = b->depth > 0 ? &b->open[b->depth - 1] : NULL;
    node.key = open ? open->key : -1;
    node.key_line = open ? open->key_line : 0;
    node.key_column = open ? open->key_column : 0;
    node.line = b->line;
    node.column = b->column;
    node.parent = open ? open->node : -1;
    node.first = node.next = -1;
    if (!names_grow(b))
        return error_memory(b->error);
    int32_t slot = -1;
    if (node.key >= 0) {
        const char *key = yaml_text(tree, node.key);
        slot = name_slot(b, node.parent, key);
        if (b->names.data[slot] >= 0) {
            b->line = node.key_line;
            b->column = node.key_column;
            return refuse_here(b, "expected each key once, found it again");
        }
    }
    if (!array_push(b->ctx, &tree->nodes, node))
        return error_memory(b->error);
    *index = tree->nodes.count - 1;
    if (slot >= 0) {
        b->names.data[slot] = *index;
        b->name_count++;
    }
    if (open) {
        if (open->last >= 0)
            tree->nodes.data[open->last].next = *index;
        else
            tree->nodes.data[open->node].first = *index;
        tree->nodes.data[open->node].count++;
        open->last = *index;
        open->key = -1;
    }
    return FRAM_OK;
}

/* Whether the next event is a key: in a mapping that has none waiting. */
static bool awaits_key(const yaml_builder *b)
{
    if (b->depth == 0)
        return false;
    const open_node *open = &b->open[b->depth - 1];
    return b->tree->nodes.data[open->node].kind == YAML_MAPPING && open->key < 0;
}

static fram_status open_container(yaml_builder *b, yaml_kind kind)
{
    if (awaits_key(b))
        return refuse_here(b, "expected a name as key, found a mapping or list");
    if (b->depth >= b->depth_limit || b->depth >= STACK_SIZE)
        return refuse_here(b, "expected less nesting");
    int32_t index;
    fram_status status = add_node(b, (yaml_node){.kind = kind, .value = -1}, &index);
    if (status == FRAM_OK)
        b->open[b->depth++] = (open_node){.node = index, .last = -1, .key = -1, .name = -1};
    return status;
}

static fram_status take_key(yaml_builder *b, int32_t text, bool quoted)
{
    if (!quoted && strcmp(yaml_text(b->tree, text), "<<") == 0)
        return refuse_here(b, "expected a key, found a merge key (<<), which is not allowed");
    if (*yaml_text(b->tree, text) == '\0')
        return refuse_here(b, "expected a name as key, found nothing");
    open_node *open = &b->open[b->depth - 1];
    open->key = open->name = text;
    open->key_line = b->line;
    open->key_column = b->column;
    return FRAM_OK;
}

static fram_status add_scalar(yaml_builder *b, struct fy_token *token)
{
    enum fy_scalar_style style = token ? fy_token_scalar_style(token) : FYSS_PLAIN;
    bool quoted = style != FYSS_PLAIN;
    if (style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED)
        b->column--; /* libfyaml's mark stands behind the quote */
    int32_t text = -1, index;
    fram_status status = add_text(b, token, &text);
    if (status != FRAM_OK)
        return status;
    if (awaits_key(b))
        return take_key(b, text, quoted);
    return add_node(b, (yaml_node){.kind = YAML_SCALAR, .quoted = quoted, .value = text}, &index);
}

/* Anchors and tags stand before the value they belong to. */
static fram_status check_decoration(yaml_builder *b, struct fy_event *event)
{
    if (event->type != FYET_SCALAR && event->type != FYET_MAPPING_START && event->type != FYET_SEQUENCE_START)
        return FRAM_OK;
    struct fy_token *anchor = fy_event_get_anchor_token(event), *tag = fy_event_get_tag_token(event);
    if (!anchor && !tag)
        return FRAM_OK;
    move_to(b, fy_token_start_mark(anchor ? anchor : tag));
    return refuse_here(b, anchor ? "expected a plain value, found an anchor (&), which is not allowed"
                                 : "expected a plain value, found a tag (!), which is not allowed");
}

static fram_status take_event(yaml_builder *b, struct fy_event *event)
{
    move_to(b, fy_event_start_mark(event));
    fram_status status = check_decoration(b, event);
    if (status != FRAM_OK)
        return status;
    switch (event->type) {
    case FYET_DOCUMENT_START:
        return b->documents++ == 0 ? FRAM_OK : refuse_here(b, "expected one document, found a second one");
    case FYET_ALIAS:
        return refuse_here(b, "expected a plain value, found an alias (*), which is not allowed");
    case FYET_SCALAR:
        return add_scalar(b, event->scalar.value);
    case FYET_MAPPING_START:
        return open_container(b, YAML_MAPPING);
    case FYET_SEQUENCE_START:
        return open_container(b, YAML_SEQUENCE);
    case FYET_MAPPING_END:
    case FYET_SEQUENCE_END:
        b->depth--;
        return FRAM_OK;
    default:
        return FRAM_OK;
    }
}

/* Why the parser gave no event: the end of the text, or the first error it collected. */
static fram_status parser_end(yaml_builder *b, struct fy_parser *parser, struct fy_diag *diagnosis)
{
    if (!fy_parser_get_stream_error(parser))
        return FRAM_OK;
    void *previous = NULL;
    const struct fy_diag_error *first = fy_diag_errors_iterate(diagnosis, &previous);
    if (!first || !first->msg)
        return refuse_here(b, "not valid YAML");
    yaml_blame blame;
    if (yaml_indent_blame(b->data, b->size, &blame)) {
        b->line = blame.line;
        b->column = blame.column;
        b->depth = 0; /* what was read by then is not where the fault is */
        return refuse_here(b, blame.message);
    }
    char message[200];
    snprintf(message, sizeof message, "not valid YAML: %s", first->msg);
    b->line = first->line;
    b->column = first->column;
    return refuse_here(b, message);
}

static fram_status build(yaml_builder *b, struct fy_parser *parser, struct fy_diag *diagnosis)
{
    for (;;) {
        struct fy_event *event = fy_parser_parse(parser);
        if (!event)
            return parser_end(b, parser, diagnosis);
        bool last = event->type == FYET_STREAM_END;
        fram_status status = take_event(b, event);
        fy_parser_event_free(parser, event);
        if (status != FRAM_OK || last)
            return status;
    }
}

/* UTF-8 and no control characters but tab and line ends, before any scanner sees it. */
static fram_status check_text(yaml_builder *b, const char *data, size_t size)
{
    const char *at = data, *end = data + size, *line_start = data;
    b->line = 1;
    while (at < end) {
        const char *here = at;
        int32_t code = utf8_next(&at, end);
        b->column = (int32_t)(here - line_start) + 1;
        if (code < 0)
            return refuse_here(b, "expected UTF-8 text, found other bytes");
        if ((code < 0x20 && code != '\t' && code != '\n' && code != '\r') || code == 0x7f)
            return refuse_here(b, "expected text, found a control character");
        if (code == '\n') {
            b->line++;
            line_start = at;
        }
    }
    b->line = b->column = 1;
    return FRAM_OK;
}

/* libfyaml would print its messages; they are collected instead. */
static void print_nothing(struct fy_diag *diagnosis, void *user, const char *text, size_t size)
{
    (void)diagnosis;
    (void)user;
    (void)text;
    (void)size;
}

static fram_status parse(yaml_builder *b, const char *data, size_t size)
{
    struct fy_diag_cfg quiet;
    fy_diag_cfg_default(&quiet);
    quiet.fp = NULL;
    quiet.output_fn = print_nothing;
    quiet.colorize = false;
    struct fy_diag *diagnosis = fy_diag_create(&quiet);
    if (!diagnosis)
        return error_memory(b->error);
    fy_diag_set_collect_errors(diagnosis, true);
    struct fy_parse_cfg configuration = {
        .search_path = "", .flags = FYPCF_QUIET | FYPCF_DEFAULT_VERSION_1_2 | FYPCF_JSON_NONE, .diag = diagnosis};
    struct fy_parser *parser = fy_parser_create(&configuration);
    fram_status status = FRAM_OK;
    if (!parser || fy_parser_set_string(parser, data, size) != 0)
        status = error_memory(b->error);
    else
        status = build(b, parser, diagnosis);
    if (parser)
        fy_parser_destroy(parser);
    fy_diag_destroy(diagnosis);
    return status;
}

fram_status yaml_tree_parse(context *ctx, const char *name, const char *data, size_t size, int32_t depth_limit,
                            yaml_tree *tree, fram_error *error)
{
    memset(tree, 0, sizeof *tree);
    yaml_builder b = {
        .ctx = ctx, .name = name, .data = data, .size = size, .error = error, .tree = tree, .depth_limit = depth_limit};
    fram_status status = check_text(&b, data, size);
    if (status == FRAM_OK && size > 0)
        status = parse(&b, data, size);
    array_free(ctx, &b.names);
    if (status != FRAM_OK)
        yaml_tree_free(ctx, tree);
    return status;
}

fram_status yaml_brackets_check(const char *name, const char *data, size_t size, size_t most, fram_error *error)
{
    yaml_blame blame;
    if (size <= most || !yaml_indent_brackets(data, size, most, &blame))
        return FRAM_OK;
    error_set(error, FRAM_ERROR_INPUT, name, blame.line, NULL, "%s", blame.message);
    if (error)
        error->column = blame.column;
    return FRAM_ERROR_INPUT;
}

void yaml_tree_free(context *ctx, yaml_tree *tree)
{
    array_free(ctx, &tree->nodes);
    array_free(ctx, &tree->text);
}
