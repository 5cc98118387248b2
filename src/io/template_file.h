/* Shapes of floes from a file of outlines (io/outline_file.h): every sound outline counts as a shape; size and place
   are of no account.  A ring that is not closed is closed, a faulty one left out. */
#ifndef IO_TEMPLATE_FILE_H
#define IO_TEMPLATE_FILE_H

#include "geometry/overlay.h"

/* Appends the shapes, counter-clockwise.  FRAM_ERROR_INPUT naming the file when it cannot be read or when none of its
   outlines is sound; out may then hold some. */
fram_status template_file_read(context *ctx, overlay *o, const char *path, polygon_list *out, fram_error *error);

#endif
