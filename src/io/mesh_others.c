/* Files that are no STL, OBJ or GDF, known by how they begin; see mesh_reader.h. */
#include "io/mesh_reader.h"

#include <string.h>

#define EXPORT "export the surface as STL or OBJ in the program that made the file"
#define UNPACK "unpack it"
#define PLAIN "save it as plain text (ASCII or UTF-8), or export binary STL"

static const struct {
    const char *begin;
    size_t length;
    const char *what, *remedy;
} other_files[] = {
    {"\x1f\x8b", 2, "a packed file (gzip)", UNPACK},
    {"PK\3\4", 4, "a packed file (ZIP)", UNPACK},
    {"\xff\xfe", 2, "text in UTF-16", PLAIN},
    {"\xfe\xff", 2, "text in UTF-16", PLAIN},
    {"ISO-10303-21", 12, "a STEP file, which has curved surfaces", EXPORT},
    {"3D Geometry File Format", 23, "a Rhino file (3dm)", EXPORT},
    {"ply\n", 4, "a PLY file", EXPORT},
    {"ply\r", 4, "a PLY file", EXPORT},
    {"OFF\n", 4, "an OFF file", EXPORT},
    {"OFF\r", 4, "an OFF file", EXPORT},
    {"$MeshFormat", 11, "a Gmsh file", EXPORT},
};

/* The first line of IGES: 80 columns, of which the last eight are the letter of the section and the line's number. */
static bool is_iges(const char *data, size_t size)
{
    enum { SECTION = 72, LINE = 80 };
    return size > LINE && data[SECTION] == 'S' && data[LINE - 1] == '1' && strchr("\r\n", data[LINE]);
}

fram_status mesh_refuse_others(const mesh_reading *r, const char *data, size_t size)
{
    static const char *const found = "expected a mesh (STL, OBJ or GDF), found %s; %s";
    for (size_t i = 0; i < sizeof other_files / sizeof *other_files; i++)
        if (size >= other_files[i].length && memcmp(data, other_files[i].begin, other_files[i].length) == 0)
            return mesh_refuse(r, 0, 0, found, other_files[i].what, other_files[i].remedy);
    return is_iges(data, size) ? mesh_refuse(r, 0, 0, found, "an IGES file, which has curved surfaces", EXPORT)
                               : FRAM_OK;
}

bool mesh_looks_like_obj(const char *data, size_t size)
{
    word_reader w = word_reader_begin(data, size);
    while (word_next(&w)) {
        if (word_is(&w, "v") || word_is(&w, "mtllib") || word_is(&w, "o") || word_is(&w, "g"))
            return true;
        if (w.word[0] != '#')
            return false;
        word_skip_line(&w);
    }
    return false;
}
