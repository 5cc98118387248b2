/* Outlines of floes from files of three forms, told apart by their first character: GeoJSON ({, io/geojson.h), WKT (a
   letter) and plain points (a number).  All end as rings with their places, for ice/import.h to judge.

   WKT (OGC 06-103r4): POLYGON and MULTIPOLYGON, in any case, with Z, M or ZM coordinates that are passed over, EMPTY
   too, one after another; a geometry may go over several lines.  Each geometry is a feature.
   Plain points: a line holds x and y, parted by blanks, tabs, a comma or a semicolon; a blank line, or one that begins
   with > (as GMT's segments do), ends a ring, which need not repeat its first point.  Each ring is a feature.
   In both, lines that begin with # are passed over.

   Knows the forms; whether a ring is sound is asked of ice/import.h. */
#ifndef IO_OUTLINE_FILE_H
#define IO_OUTLINE_FILE_H

#include "ice/import.h"

/* FRAM_ERROR_INPUT with line, column and the ring as key, in the manner of geojson_parse, and for files over its
   limits. out must be empty; on failure it still is. */
fram_status outline_file_read(context *ctx, const char *path, import_rings *out, fram_error *error);
/* The same for a text in memory with a NUL after it; name stands for the file in errors. */
fram_status outline_file_parse(context *ctx, const char *name, const char *data, size_t size, import_rings *out,
                               fram_error *error);

#endif
