/* Conditions from a CSV file: a head row of scenario keys, then a row a condition with a text for each key.  Cells may
   stand in quotation marks ("" is one), ends of lines be those of any system; empty lines are passed over.  A head may
   have the unit of its key, as `vessel.speed[m/s]`, and no other.  A column `hours` is that of a scatter diagram: how
   long a year each condition lasts.  Knows keys by their names; whether values suit them
   is seen where scenarios are read. */
#ifndef STUDY_CONDITION_TABLE_H
#define STUDY_CONDITION_TABLE_H

#include "study/study.h"

typedef struct condition_table {
    text_list heads;     /* names of keys, without units */
    text_list cells;     /* rows x heads */
    int32_array line;    /* of each row in the file */
    ARRAY(double) hours; /* of each row; empty without such a column */
} condition_table;

/* FRAM_ERROR_INPUT with line and head; the table is empty then. */
fram_status condition_table_parse(context *ctx, const char *name, const char *data, size_t size, condition_table *out,
                                  fram_error *error);
fram_status condition_table_read(context *ctx, const char *path, condition_table *out, fram_error *error);
void condition_table_free(context *ctx, condition_table *t);

#endif
