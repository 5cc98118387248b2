/* What the files of `fram field` share. */
#ifndef CLI_FIELD_WORDS_H
#define CLI_FIELD_WORDS_H

#include "cli/cli.h"
#include "fram/field.h"

typedef struct field_window {
    double lo[2], hi[2]; /* [m] */
} field_window;

/* What the words say. */
typedef struct field_words {
    const char *path;
    bool scenario; /* the path is one, not a file of outlines */
    option_list overrides, window_words;
    fram_field_definition field;
    const char *crop, *bad;
    field_window window[OPTION_LIST_ROOM];
    int windows;
    const char *draw, *cover, *table, *output;
    double cell;
} field_words;

/* By its ending; one of .json is a scenario where its object has no member that the objects of GeoJSON have. */
bool field_is_scenario(const char *path);

const char *field_title(const field_words *w);
/* Prints what the field is, for people or as JSON; returns the exit code. */
int field_answer(const field_words *w, const common_options *common, const fram_field *field);

#endif
