/* Cells of the CSV tables that a study leaves: each begins with its comma. */
#ifndef STUDY_CELLS_H
#define STUDY_CELLS_H

#include "io/text_buffer.h"

/* In all its digits; empty where it is not finite. */
void cell_number(context *ctx, text_buffer *b, double value);
/* An end of an interval, which may be infinite ("inf"); empty for NaN. */
void cell_end(context *ctx, text_buffer *b, double value);
/* In quotation marks, those in it doubled (RFC 4180). */
void cell_quoted(context *ctx, text_buffer *b, const char *text);
/* The same where a comma or a quotation mark would divide it; as it is otherwise. */
void cell_text(context *ctx, text_buffer *b, const char *text);

#endif
