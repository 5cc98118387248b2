/* The events of libfyaml strung into a tree.  libfyaml scans; what is allowed is decided here. */
#include "io/yaml_tree.h"
#include "base/hash.h"
#include "io/utf8.h"
#include <libfyaml.h>
#include <string.h>

/* Deeper nesting than any reader asks for. */
enum { STACK_SIZE = 64 };

/* An open mapping or sequence. */
typedef struct open_node {
    int32_t node;
    int32_t last; /* its latest child, -1 */
    int32_t key;  /* in the text: the key that waits for its value, -1 */
    int32_t key_line, key_column;
} open_node;

typedef struct yaml_builder {
    context *ctx;
    const char *name;
    fram_error *error;
    yaml_tree *tree;
    int32_t depth, depth_limit;
    open_node open[STACK_SIZE];
    int32_t documents;
    ARRAY(int32_t) names; /* hash table of the nodes that have a key, -1: free slot; the size is a power of two */
    int32_t name_count;
} yaml_builder;

static fram_status refuse(yaml_builder *b, int32_t line, int32_t column, const char *key, const char *message)
{
    error_set(b->error, FRAM_ERROR_INPUT, b->name, line, key, "%s", message);
    if (b->error)
        b->error->column = column;
    return FRAM_ERROR_INPUT;
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
        if (i < 0 || (tree->nodes.data[i].parent == parent && strcmp(yaml_text(tree, tree->nodes.data[i].key), key) == 0))
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

/* Text of a scalar, appended; its offset goes to *at. */
static fram_status add_text(yaml_builder *b, struct fy_token *token, int32_t line, int32_t column, int32_t *at)
{
    size_t size = 0;
    const char *text = token ? fy_token_get_text(token, &size) : "";
    if (!text)
        return error_memory(b->error);
    if (size > 0 && memchr(text, '\0', size))
        return refuse(b, line, column, NULL, "expected text, found a NUL character in it");
    yaml_tree *tree = b->tree;
    if (size >= (size_t)(INT32_MAX - tree->text.count - 1) ||
        !array_reserve(b->ctx, &tree->text, tree->text.count + (int32_t)size + 1))
        return error_memory(b->error);
    *at = tree->text.count;
    if (size > 0)
        memcpy(tree->text.data + *at, text, size);
    tree->text.data[*at + (int32_t)size] = '\0';
    tree->text.count += (int32_t)size + 1;
    return FRAM_OK;
}

/* A new node under the innermost open one, with the key that waits there. */
static fram_status add_node(yaml_builder *b, yaml_node node, int32_t *index)
{
    yaml_tree *tree = b->tree;
    open_node *open = b->depth > 0 ? &b->open[b->depth - 1] : NULL;
    node.key = open ? open->key : -1;
    node.key_line = open ? open->key_line : 0;
    node.key_column = open ? open->key_column : 0;
    node.parent = open ? open->node : -1;
    node.first = node.next = -1;
    if (!names_grow(b))
        return error_memory(b->error);
    int32_t slot = -1;
    if (node.key >= 0) {
        const char *key = yaml_text(tree, node.key);
        slot = name_slot(b, node.parent, key);
        if (b->names.data[slot] >= 0)
            return refuse(b, node.key_line, node.key_column, key, "expected each key once, found it again");
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

static fram_status open_container(yaml_builder *b, yaml_kind kind, int32_t line, int32_t column)
{
    if (awaits_key(b))
        return refuse(b, line, column, NULL, "expected a name as key, found a mapping or list");
    if (b->depth >= b->depth_limit || b->depth >= STACK_SIZE)
        return refuse(b, line, column, NULL, "expected less nesting");
    int32_t index;
    fram_status status = add_node(b, (yaml_node){.kind = kind, .line = line, .column = column, .value = -1}, &index);
    if (status == FRAM_OK)
        b->open[b->depth++] = (open_node){.node = index, .last = -1, .key = -1};
    return status;
}

static fram_status add_scalar(yaml_builder *b, struct fy_token *token, int32_t line, int32_t column)
{
    bool quoted = token && fy_token_scalar_style(token) != FYSS_PLAIN;
    int32_t text = -1, index;
    fram_status status = add_text(b, token, line, column, &text);
    if (status != FRAM_OK)
        return status;
    if (!awaits_key(b))
        return add_node(
            b, (yaml_node){.kind = YAML_SCALAR, .quoted = quoted, .line = line, .column = column, .value = text}, &index);
    if (!quoted && strcmp(yaml_text(b->tree, text), "<<") == 0)
        return refuse(b, line, column, "<<", "expected a key, found a merge key, which is not allowed");
    if (*yaml_text(b->tree, text) == '\0')
        return refuse(b, line, column, NULL, "expected a name as key, found nothing");
    open_node *open = &b->open[b->depth - 1];
    open->key = text;
    open->key_line = line;
    open->key_column = column;
    return FRAM_OK;
}

static fram_status take_event(yaml_builder *b, struct fy_event *event)
{
    const struct fy_mark *mark = fy_event_start_mark(event);
    const open_node *open = b->depth > 0 ? &b->open[b->depth - 1] : NULL;
    int32_t line = mark ? mark->line + 1 : open ? open->key_line : 1;
    int32_t column = mark ? mark->column + 1 : open ? open->key_column : 1;
    bool content = event->type == FYET_SCALAR || event->type == FYET_MAPPING_START || event->type == FYET_SEQUENCE_START;
    if (content && fy_event_get_anchor_token(event))
        return refuse(b, line, column, NULL, "expected a plain value, found an anchor (&), which is not allowed");
    if (content && fy_event_get_tag_token(event))
        return refuse(b, line, column, NULL, "expected a plain value, found a tag (!), which is not allowed");
    switch (event->type) {
    case FYET_DOCUMENT_START:
        if (b->documents++ > 0)
            return refuse(b, line, column, NULL, "expected one document, found a second one");
        return FRAM_OK;
    case FYET_ALIAS: return refuse(b, line, column, NULL, "expected a plain value, found an alias (*), which is not allowed");
    case FYET_SCALAR: return add_scalar(b, event->scalar.value, line, column);
    case FYET_MAPPING_START: return open_container(b, YAML_MAPPING, line, column);
    case FYET_SEQUENCE_START: return open_container(b, YAML_SEQUENCE, line, column);
    case FYET_MAPPING_END:
    case FYET_SEQUENCE_END: b->depth--; return FRAM_OK;
    default: return FRAM_OK;
    }
}

/* Why the parser gave no event: the end of the text, or the first error it collected. */
static fram_status parser_end(yaml_builder *b, struct fy_parser *parser)
{
    if (!fy_parser_get_stream_error(parser))
        return FRAM_OK;
    void *previous = NULL;
    struct fy_diag *diagnosis = fy_parser_get_diag(parser);
    struct fy_diag_error *first = diagnosis ? fy_diag_errors_iterate(diagnosis, &previous) : NULL;
    fram_status status;
    if (first && first->msg) {
        error_set(b->error, FRAM_ERROR_INPUT, b->name, first->line, NULL, "not valid YAML: %s", first->msg);
        if (b->error)
            b->error->column = first->column;
        status = FRAM_ERROR_INPUT;
    } else {
        status = refuse(b, 0, 0, NULL, "not valid YAML");
    }
    fy_diag_unref(diagnosis);
    return status;
}

static fram_status build(yaml_builder *b, struct fy_parser *parser)
{
    for (;;) {
        struct fy_event *event = fy_parser_parse(parser);
        if (!event)
            return parser_end(b, parser);
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
    int32_t line = 1;
    while (at < end) {
        const char *here = at;
        int32_t code = utf8_next(&at, end);
        int32_t column = (int32_t)(here - line_start) + 1;
        if (code < 0)
            return refuse(b, line, column, NULL, "expected UTF-8 text, found other bytes");
        if ((code < 0x20 && code != '\t' && code != '\n' && code != '\r') || code == 0x7f)
            return refuse(b, line, column, NULL, "expected text, found a control character");
        if (code == '\n') {
            line++;
            line_start = at;
        }
    }
    return FRAM_OK;
}

fram_status yaml_tree_parse(context *ctx, const char *name, const char *data, size_t size, int32_t depth_limit,
                            yaml_tree *tree, fram_error *error)
{
    memset(tree, 0, sizeof *tree);
    yaml_builder b = {.ctx = ctx, .name = name, .error = error, .tree = tree, .depth_limit = depth_limit};
    fram_status status = check_text(&b, data, size);
    if (status != FRAM_OK || size == 0)
        return status;
    struct fy_parse_cfg configuration = {
        .search_path = "", .flags = FYPCF_QUIET | FYPCF_COLLECT_DIAG | FYPCF_DEFAULT_VERSION_1_2 | FYPCF_JSON_NONE};
    struct fy_parser *parser = fy_parser_create(&configuration);
    if (!parser)
        return error_memory(error);
    status = fy_parser_set_string(parser, data, size) == 0 ? build(&b, parser) : error_memory(error);
    fy_parser_destroy(parser);
    array_free(ctx, &b.names);
    if (status != FRAM_OK)
        yaml_tree_free(ctx, tree);
    return status;
}

void yaml_tree_free(context *ctx, yaml_tree *tree)
{
    array_free(ctx, &tree->nodes);
    array_free(ctx, &tree->text);
}
