/* YAML (and JSON, which is YAML) as a flat tree of plain data with the place of every node, for readers that check what
   they read.  Strict: one document, UTF-8 without control characters, no anchors, aliases, tags, merge keys or
   duplicate keys, bounded depth. */
#ifndef IO_YAML_TREE_H
#define IO_YAML_TREE_H

#include "base/array.h"

typedef enum yaml_kind { YAML_SCALAR = 0, YAML_MAPPING, YAML_SEQUENCE } yaml_kind;

/* Children of a node are a chain: first, then next until -1. */
typedef struct yaml_node {
    yaml_kind kind;
    bool quoted;          /* scalar: written in quotes or as a block */
    int32_t line, column; /* from 1; of the value */
    int32_t key;          /* in `text`: the key it stands under, -1 in a sequence and at the root */
    int32_t key_line, key_column;
    int32_t value;               /* scalar: in `text` */
    int32_t parent, first, next; /* -1: none */
    int32_t count;               /* children */
} yaml_node;

typedef struct yaml_tree {
    ARRAY(yaml_node) nodes; /* 0 is the root; empty for an empty document */
    ARRAY(char) text;       /* all keys and scalars, each ended by a NUL */
} yaml_tree;

/* name stands for the file in errors. */
fram_status yaml_tree_parse(context *ctx, const char *name, const char *data, size_t size, int32_t depth_limit,
                            yaml_tree *tree, fram_error *error);
/* Refuses a text with more than `most` bytes between brackets: the parser holds all that stands there, 340 times its
   size, before the first of it is known. */
fram_status yaml_brackets_check(const char *name, const char *data, size_t size, size_t most, fram_error *error);
void yaml_tree_free(context *ctx, yaml_tree *tree);
/* NUL-terminated text at an offset of a node. */
static inline const char *yaml_text(const yaml_tree *tree, int32_t offset) { return tree->text.data + offset; }

#endif
