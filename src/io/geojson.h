/* GeoJSON (RFC 7946) as rings with their places, and floes as GeoJSON.  Coordinates are planar lengths, not degrees.
   Read are FeatureCollection, Feature, GeometryCollection, Polygon and MultiPolygon; of the properties only `thickness`
   [m], which may be null, and `kind`: features of kind "vessel" or "wall", as an export writes them, are no ice and
   passed over; heights (third coordinates) and all other members are passed over.  Knows the format; whether
   a ring is sound is asked of ice/import.h. */
#ifndef IO_GEOJSON_H
#define IO_GEOJSON_H

#include "ice/import.h"

/* What a file may hold. */
enum {
    GEOJSON_BYTES_MOST = 256 << 20,
    GEOJSON_DEPTH_MOST = 32,
    GEOJSON_FEATURES_MOST = 1000000,
    GEOJSON_RINGS_MOST = 1000000,
    GEOJSON_RING_VERTICES_MOST = 100000,
    GEOJSON_VERTICES_MOST = 10000000
};

/* FRAM_ERROR_INPUT with line, column and, inside a feature, "feature 17" or "feature 17, polygon 2, ring 1" as key:
   for anything that is no JSON, no GeoJSON of these kinds, or over the limits.  name stands for the file in errors; out
   must be empty, and on failure it still is. */
fram_status geojson_parse(context *ctx, const char *name, const char *data, size_t size, import_rings *out,
                          fram_error *error);

/* A FeatureCollection of Polygons with properties id (from 0) and, where given and not NaN, thickness.  Numbers are the
   shortest that read back to the bit.  thickness may be NULL. */
fram_status geojson_write(context *ctx, const char *path, const polygon_list *outlines, const double *thickness,
                          fram_error *error);

/* A property of every feature: numbers (a NaN leaves it out) or, when `text` is not NULL, texts (so does a NULL)
   without characters that JSON escapes. */
typedef struct geojson_property {
    const char *name;
    const double *value;
    const char *const *text;
} geojson_property;
/* The last `count` outlines are no features but parts of some, in whose place they make a MultiPolygon: the first of
   them of feature[0]. */
typedef struct geojson_parts {
    const int32_t *feature;
    int32_t count;
} geojson_parts;
/* The same with any properties, and a member "time" of the collection when time is not NaN [s]. */
fram_status geojson_write_properties(context *ctx, const char *path, const polygon_list *outlines, geojson_parts parts,
                                     const geojson_property *properties, int32_t property_count, double time,
                                     fram_error *error);

#endif
