/* Meshes in files: STL (text and binary), Wavefront OBJ and WAMIT GDF, to triangles and back.  Readers take any bytes:
   every count is checked against the size of the file before memory is asked for, every number must be finite and at
   most MESH_FILE_REACH.  They join equal points and drop triangles that name a point twice; what the surface is worth
   (mesh_check, mesh_repair.h) is the caller's business.  Errors name file, line and element. */
#ifndef IO_MESH_FILE_H
#define IO_MESH_FILE_H

#include "geometry/mesh.h"

typedef enum mesh_format { MESH_STL_TEXT = 0, MESH_STL_BINARY, MESH_OBJ, MESH_GDF, MESH_FORMAT_COUNT } mesh_format;

/* Largest file [bytes], most triangles and vertices that a file may hold, and the largest coordinate [m]. */
#define MESH_FILE_BYTES (UINT64_C(1) << 30)
enum { MESH_FILE_TRIANGLES = 10000000 };
#define MESH_FILE_REACH 1e6

/* A unit of lengths other than the metre, and where a file says so. */
typedef struct mesh_file_unit {
    const char *name; /* "feet" */
    double metres;    /* one of it */
    double gravity;   /* that of the earth in it, as the file has it */
    int32_t line;
} mesh_file_unit;

/* A surface and where in the file each of its triangles stands. */
typedef struct mesh_file {
    mesh_format format;
    mesh surface;
    int32_array element;     /* of each triangle: number of its facet, face or panel in the file, from 1 */
    int32_array line;        /* of each triangle, from 1; 0 in a binary file */
    int32_t elements;        /* facets, faces or panels in the file */
    int32_t dropped;         /* triangles without area because they name a point twice */
    bool mirror_x, mirror_y; /* GDF: mirrored in the plane x = 0 (y = 0), as the file's ISX (ISY) says */
    mesh_file_unit unit;     /* GDF: of its lengths, as the file's GRAV says; name NULL: metres */
} mesh_file;

/* "STL (text)" */
const char *mesh_format_name(mesh_format f);
/* What the format calls an element: "facet", "face", "panel". */
const char *mesh_format_element(mesh_format f);

/* Whether a file is of the format of an ending (".gdf"), in any case of letters, by its name. */
bool mesh_file_ends_with(const char *name, const char *ending);

/* The file's surface, coordinates as they stand in it.  The format is that of the file's ending (.stl, .obj, .gdf), or
   that which its content looks like.  FRAM_ERROR_INPUT with line and key ("panel 12"), FRAM_ERROR_IO,
   FRAM_ERROR_MEMORY; out is then empty. */
fram_status mesh_file_read(context *ctx, const char *path, mesh_file *out, fram_error *error);
/* The same for bytes in memory, which are followed by a NUL; `name` stands for the path. */
fram_status mesh_file_parse(context *ctx, const char *name, const char *data, size_t size, mesh_file *out,
                            fram_error *error);
/* The same in a format that is known. */
fram_status mesh_file_parse_as(context *ctx, const char *name, mesh_format format, const char *data, size_t size,
                               mesh_file *out, fram_error *error);
void mesh_file_free(context *ctx, mesh_file *f);

/* Write a surface; the format is that of the ending: .stl (binary: coordinates rounded to 4-byte floats), .obj (exact),
   or .gdf (exact, triangles as panels with a corner twice, no symmetry).  FRAM_ERROR_USAGE for another ending. */
fram_status mesh_file_write(context *ctx, const char *path, const mesh *m, fram_error *error);
/* The same in a format of choice. */
fram_status mesh_file_write_as(context *ctx, const char *path, mesh_format format, const mesh *m, fram_error *error);

#endif
