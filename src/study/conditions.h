/* The conditions of a study, from a grid, a list, a table, a Latin hypercube or a design of sensitivity. */
#ifndef STUDY_CONDITIONS_H
#define STUDY_CONDITIONS_H

#include "io/text_buffer.h"
#include "io/yaml_tree.h"
#include "study/study.h"

/* Where a study is read from. */
typedef struct study_source {
    context *ctx;
    const yaml_tree *tree;
    study *out;
    fram_error *error;
    bool recorded; /* as a study that ran was read: what was taken then is taken */
} study_source;

/* A refusal at a node's value: file, line, key. */
fram_status study_refuse(const study_source *r, const yaml_node *node, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same of what is not of the kind that is taken: what was expected there, what was found, and where that is a
   mapping with a key of the scenario below it whose value would be taken, how that is written.  or_values: so would
   `{values: [...]}`. */
fram_status study_refuse_kind(const study_source *r, const yaml_node *node, yaml_kind taken, bool or_values,
                              const char *expected);
/* What was found in place of a number or a name, for messages: cut; a text in quotes is told as that. */
typedef struct study_found_text {
    char text[80];
} study_found_text;
study_found_text study_found(const study_source *r, const yaml_node *node);
/* The key a node stands under, of an element of a list that of the list; "" for none. */
const char *study_key(const study_source *r, const yaml_node *node);
/* The path of a file that the study names, which is relative to the study's own folder; path.failed: no memory. */
void study_beside(const study_source *r, const char *name, text_buffer *path);
/* FRAM_ERROR_INPUT, at the node, when there is no such file. */
fram_status study_find_file(const study_source *r, const yaml_node *node, const char *path);
/* Whether it is a number, without quotes. */
bool study_number_is(const study_source *r, const yaml_node *node, double *out);
/* A scalar as a number within a range. */
fram_status study_number(const study_source *r, const yaml_node *node, double lo, double hi, double *out);
/* The same, whole. */
fram_status study_whole(const study_source *r, const yaml_node *node, double lo, double hi, int64_t *out);
/* A time in seconds, or with a unit: 90min, 3h, 20d, 1a. */
fram_status study_time(const study_source *r, const yaml_node *node, double lo, double hi, double *out);
/* The refusal of a key that is none of the names, with the nearest one. */
fram_status study_unknown(const study_source *r, const yaml_node *node, const char *const *names, size_t count);
/* Children of a mapping or sequence. */
const yaml_node *study_child(const study_source *r, const yaml_node *node);
const yaml_node *study_next(const study_source *r, const yaml_node *node);

/* A key that conditions vary, at whose values or range the node is; run.seed is refused. */
fram_status study_add_key(const study_source *r, const yaml_node *node);
/* The next value of the conditions, as it stands in the file. */
fram_status study_add_value(const study_source *r, const yaml_node *node);
/* FRAM_ERROR_INPUT where a node is not of that kind, or empty. */
fram_status study_expect(const study_source *r, const yaml_node *node, yaml_kind kind, const char *what);
/* Two numbers, the second no less than the first, for a key that has a range: of one that is whole the whole numbers
   between them. */
fram_status study_range(const study_source *r, const yaml_node *node, key_range *out);
/* The next value of the conditions: that part of the way, 0 to 1, from the lower end of a range to the upper one. */
fram_status study_add_part(const study_source *r, key_range range, double part);

/* What is drawn at random is told alike: how many points, by which seed, of which keys. */
typedef struct drawn_head {
    int64_t count, seed; /* seed: 1 where none is given */
    int64_t levels;      /* unchanged where none are given */
    const yaml_node *keys;
} drawn_head;
/* count: from count_least on.  levels: from 2 to levels_most; 0: there are none. */
fram_status study_drawn_read(const study_source *r, const yaml_node *node, int32_t count_least, int32_t levels_most,
                             drawn_head *out);

/* Designs of sensitivity: `vary: {sobol: ...}` and `vary: {morris: ...}`. */
fram_status study_sobol_read(const study_source *r, const yaml_node *node);
fram_status study_morris_read(const study_source *r, const yaml_node *node);

/* A Latin hypercube: `vary: {latin: ...}`. */
fram_status study_latin_read(const study_source *r, const yaml_node *node);

/* Reads the node under `vary` into keys, values and conditions. */
fram_status study_conditions_read(const study_source *r, const yaml_node *node);

#endif
