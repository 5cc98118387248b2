/* Another program's answer. */
#ifndef STUDY_CAPTURE_H
#define STUDY_CAPTURE_H

#include "io/text_buffer.h"

/* Runs a program of PATH to its end, and adds what it writes, on standard error too, to out.  words end with NULL.
   exit_code may be NULL. */
fram_status capture(context *ctx, const char *const *words, text_buffer *out, int *exit_code, fram_error *error);
/* What a program said on several lines, as one. */
void capture_line(text_buffer *b);

#endif
