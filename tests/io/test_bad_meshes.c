/* Malformed meshes, and surfaces that are no sound solids: each is refused with its line, its element and what is
 * wrong. */
#include "io/hull_file.h"
#include "mesh_texts.h"
#include "testing.h"

#define GDF_PANEL "0 0 0 1 0 0 1 1 0 0 1 0\n"

typedef struct bad_mesh {
    const char *name, *text;
    int line;
    const char *key, *message;
} bad_mesh;

#define OBJ_CUBE                                                                                  \
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n" /* lines 1 to 8 */ \
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"                  /* 9 to 13 */
#define IGES                                                                             \
    "                                                                        S      1\n" \
    "1H,,1H;,4HSLOT,37H$1$DUA2:[IGESLIB.BDRAFT.B2I]SLOT.IGS;,17HBravo3 BravoDRAFT,G      1\n"
#define OBJ_LAST "f 4 1 5 8\n"
/* The same cube moved by half: it crosses the first. */
#define OBJ_SECOND                                                                                                 \
    "v .5 .5 .5\nv 1.5 .5 .5\nv 1.5 1.5 .5\nv .5 1.5 .5\nv .5 .5 1.5\nv 1.5 .5 1.5\nv 1.5 1.5 1.5\nv .5 1.5 1.5\n" \
    "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n"

static const bad_mesh bad[] = {
    /* any format */
    {"empty.stl", "", 0, "", "empty"},
    {"unknown.txt", "hello\n", 0, "", "expected a mesh (STL, OBJ or GDF)"},
    {"unknown.dat", "1 2 3\n", 0, "", "export the surface as STL or OBJ in the program that made the file"},
    /* Files of others, whatever they are called. */
    {"a.step", "ISO-10303-21;\nHEADER;\n", 0, "", "found a STEP file, which has curved surfaces; export"},
    {"a.stl", IGES, 0, "", "found an IGES file, which has curved surfaces; export"},
    {"a.gdf", IGES, 0, "", "found an IGES file"},
    {"a.ply", "ply\nformat ascii 1.0\n", 0, "", "found a PLY file; export"},
    {"a.obj", "ply\r\nformat ascii 1.0\r\n", 0, "", "found a PLY file; export"},
    {"a.3dm", "3D Geometry File Format        4", 0, "", "found a Rhino file (3dm); export"},
    {"a.stl.gz", "\x1f\x8b\x08", 0, "", "found a packed file (gzip); unpack it"},
    {"a.zip", "PK\3\4", 0, "", "found a packed file (ZIP); unpack it"},
    {"utf16.stl", "\xff\xfes", 0, "", "found text in UTF-16; save it as plain text"},
    {"obj.stl", OBJ_CUBE, 1, "", "or is binary, found OBJ; let its name end in .obj"},
    {"gdf.stl", GDF_BOX, 1, "", "found a GDF file; let its name end in .gdf"},
    {"text.stl", "A letter about ships, which is long enough to fill the header of a binary file: 84 bytes and more.",
     1, "", "found other text; export"},
    /* STL */
    {"short.stl", "sol", 0, "", "expected at least 84 bytes"},
    {"word.stl", "solid\nfacet normal 0 0 1\nouter lop\n", 3, "facet 1", "expected \"loop\", found \"lop\""},
    {"cut.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n", 6, "facet 1",
     "coordinate 3 of a vertex, found the end"},
    {"two_vertices.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", 6, "facet 1",
     "expected \"vertex\", found \"endloop\""},
    {"four_vertices.stl",
     "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n", 7,
     "facet 1", "expected \"endloop\", found \"vertex\""},
    {"nan.stl", "solid\n" STL_FACET("0 0 nan", STL_X, STL_Y) "endsolid\n", 4, "facet 1", "found \"nan\""},
    {"inf.stl", "solid\n" STL_FACET("0 -inf 0", STL_X, STL_Y) "endsolid\n", 4, "facet 1", "found \"-inf\""},
    {"comma.stl", "solid\n" STL_FACET("0,5 0 0", STL_X, STL_Y) "endsolid\n", 4, "facet 1", "found \"0,5\""},
    {"overflow.stl", "solid\n" STL_FACET("1e999 0 0", STL_X, STL_Y) "endsolid\n", 4, "facet 1", "too large"},
    {"far.stl", "solid\n" STL_FACET("0 0 0", "2e6 0 0", STL_Y) "endsolid\n", 5, "facet 1", "bring the mesh to metres"},
    {"no_normal.stl", "solid\nfacet\nouter loop\n", 3, "facet 1", "expected \"normal\", found \"outer\""},
    {"short_normal.stl", "solid\nfacet normal 0 1\nouter loop\n", 3, "facet 1", "three numbers of the normal, found 2"},
    {"no_end.stl", "solid\n" STL_FACET(STL_O, STL_X, STL_Y), 9, "", "\"endsolid\" after facet 1, found the end"},
    {"after_end.stl", STL_TETRAHEDRON "rubbish\n", 31, "", "expected \"solid\", found \"rubbish\""},
    {"no_facets.stl", "solid\nendsolid\n", 0, "", "no triangles"},
    {"open.stl",
     "solid\n" STL_FACET(STL_O, STL_Y, STL_X) STL_FACET(STL_O, STL_X, STL_Z)
         STL_FACET(STL_O, STL_Z, STL_Y) "endsolid\n",
     2, "facet 1", "has one triangle (0) (one of 3 open edges); have it repaired (repair)"},
    /* OBJ */
    {"short_vertex.obj", "v 0 0\n", 1, "", "three coordinates of vertex 1, found 2"},
    {"bad_vertex.obj", "v 0 0 0\nv 1 0x1 0\n", 2, "", "expected a coordinate [m], found \"0x1\""},
    {"no_such_vertex.obj", OBJ_POINTS "f 1 2 5\n", 5, "face 1", "names vertex 5, but 4 vertices are given so far"},
    {"vertex_zero.obj", OBJ_POINTS "f 1 2 0\n", 5, "face 1", "names vertex 0"},
    {"far_back.obj", OBJ_POINTS "f -1 -2 -5\n", 5, "face 1", "names vertex -5"},
    {"two_corners.obj", OBJ_POINTS "f 1 2\n", 5, "face 1", "at least 3 corners of a face, found 2"},
    {"four_slashes.obj", OBJ_POINTS "f 1/1/1/1 2 3\n", 5, "face 1", "expected a corner such as 7"},
    {"slash_at_end.obj", OBJ_POINTS "f 1/ 2 3\n", 5, "face 1", "found \"1/\""},
    {"name_as_corner.obj", OBJ_POINTS "f a b c\n", 5, "face 1", "found \"a\""},
    {"bow_tie.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 3 2 0\nf 1 2 3 4\n", 5, "face 1", "cross themselves"},
    {"collinear.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n", 5, "face 1", "lie on a line"},
    {"surface.obj", OBJ_POINTS "curv2 1 2\n", 5, "", "curves and surfaces must be made into faces first"},
    {"no_faces.obj", OBJ_POINTS, 0, "", "no triangles"},
    {"hole.obj", OBJ_CUBE, 9, "face 1", "has one triangle"},
    {"turned.obj", OBJ_CUBE "f 8 5 1 4\n", 9, "face 1", "is run along in one direction"},
    {"inside_out.obj", OBJ_POINTS "f 2 3 1\nf 4 2 1\nf 3 4 1\nf 4 3 2\n", 5, "face 1", "turned the wrong way"},
    {"flat.obj", OBJ_POINTS "v 0.5 0.5 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 2 5 3\n", 10, "face 5", "has no area"},
    {"inner_wall.obj", OBJ_CUBE OBJ_LAST "f 1 3 7 5\n", 15, "face 7", "has one triangle"},
    {"twice.obj", OBJ_CUBE OBJ_LAST OBJ_LAST, 14, "face 6", "it has the corners of face 7; leave one of the two out"},
    /* The two sides of a deck have the same corners too; to leave out one of them would leave the deck. */
    {"deck.obj", OBJ_CUBE OBJ_LAST "f 1 3 7\nf 1 7 5\nf 7 3 1\nf 5 7 1\n", 10, "face 2",
     "remove inner walls, decks and lids"},
    {"two_cubes_on_an_edge.obj",
     OBJ_CUBE OBJ_LAST "v 2 1 0\nv 2 2 0\nv 1 2 0\nv 2 1 1\nv 2 2 1\nv 1 2 1\n"
                       "f 11 10 9 3\nf 7 12 13 14\nf 3 9 12 7\nf 9 10 13 12\nf 10 11 14 13\nf 11 3 7 14\n",
     12, "face 4", "has more than two triangles (6 is the first); remove inner walls"},
    {"crossing.obj", OBJ_CUBE OBJ_LAST OBJ_SECOND, 10, "face 2", "crosses or touches triangle"},
    {"two_in_one.obj",
     OBJ_CUBE OBJ_LAST "v .2 .2 .2\nv .4 .2 .2\nv .2 .4 .2\nv .2 .2 .4\nf 9 11 10\nf 9 10 12\nf 9 12 11\nf 10 11 12\n",
     19, "face 7", "inside another part"},
    /* GDF */
    {"head.gdf", "only a title\n", 2, "", "expected ULEN, the length scale, found the end of the file"},
    {"word.gdf", "t\none 9.81\n", 2, "", "expected ULEN, the length scale, found \"one\""},
    {"control.gdf", "t\n0 9.81\n0 0\n1\n", 2, "", "expected a positive ULEN"},
    {"gravity.gdf", "t\n1 -9.81\n0 0\n1\n", 2, "", "expected a positive GRAV"},
    {"feet.gdf", "t\n1 32.174\n0 0\n1\n" GDF_PANEL, 2, "mesh", "lengths are in feet; give a scale of 0.3048"},
    {"inches.gdf", "t\n1 386.09\n0 0\n1\n" GDF_PANEL, 2, "mesh", "lengths are in inches; give a scale of 0.0254"},
    {"cm.gdf", "t\n1 980.665\n0 0\n1\n" GDF_PANEL, 2, "mesh", "lengths are in centimetres; give a scale of 0.01"},
    {"mm.gdf", "t\n1 9810\n0 0\n1\n" GDF_PANEL, 2, "mesh", "lengths are in millimetres; give a scale of 0.001"},
    {"symmetry.gdf", "t\n1 9.81\n0 2\n1\n", 3, "", "expected ISY from 0 to 1, found \"2\""},
    {"panels.gdf", "t\n1 9.81\n0 1\n-1\n", 4, "", "NPAN"},
    {"many_panels.gdf", "t\n1 9.81\n0 1\n99999999999\n", 4, "", "NPAN"},
    {"higher_order.gdf", "t\n1 9.81\n0 1\n3.5 1\n", 4, "", "found \"3.5\""},
    {"splines.gdf", "t\n1 9.81\n0 1\n3 1\n2 2\n", 4, "",
     "IGDEF 1 says that this is a higher-order GDF file (B-splines)"},
    {"shape.gdf", "t\n1 9.81\n0 1\n3 -11 IGDEF\n", 4, "", "IGDEF -11"},
    {"cut.gdf", GDF_HEAD("0", "0", "2") "0 0 0 1 0 0 1 1 0 0 1 0\n0 0 0 1 0 0 1 1 0 0 1\n", 7, "panel 2",
     "found the end of the file"},
    {"letters.gdf", GDF_HEAD("0", "0", "1") "0 0 0 1 0 0\n1 l 0 0 1 0\n", 6, "panel 1", "found \"l\""},
    {"more.gdf", GDF_HEAD("0", "0", "1") "0 0 0 1 0 0 1 1 0 0 1 0\n0 0 0 1 0 0 1 1 0 0 1 0\n", 6, "",
     "NPAN may be too small"},
    {"other_hull.gdf", GDF_HEAD("0", "0", "1") "0 0 0 1 0 0 1 1 0 0 1 0\n! 2 hulls\n 0 0 0 1 0 0 1 1 0 0 1 0\n", 7, "",
     "after 1 panels, found \"0\"; NPAN may be too small"},
    {"columns.gdf", GDF_HEAD("0", "0", "1") "0 0 0 1 0 0 1 1 0 0 1 0\n4.5\n0 7\n", 6, "", "found \"4.5\"; NPAN may be"},
    {"bow_tie.gdf", GDF_HEAD("0", "0", "1") "0 0 0 1 0 0 0 1 0 2 1 0\n", 5, "panel 1", "cross themselves"},
    {"gap.gdf", GDF_HEAD("1", "1", "2") "0 0 -1  0 1 -1  1 1 -1  1 0 -1\n1 0 -1  1 1 -1  1 1 0  1 0 0\n", 5, "panel 1",
     "has one triangle"},
    {"inside_out.gdf",
     GDF_HEAD("1", "1", "3") "1 0 -1 1 1 -1 0 1 -1 0 0 -1\n1 0 0 1 1 0 1 1 -1 1 0 -1\n1 1 0 0 1 0 0 1 -1 1 1 -1\n", 5,
     "panel 1", "turned the wrong way"},
};

START_TEST(every_bad_mesh_is_refused)
{
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const bad_mesh *b = &bad[i];
        const hull_file_options options = hull_file_defaults();
        mesh surface = {0};
        mesh_file file;
        hull_file_report report;
        fram_error error = {0};
        fram_status status = mesh_file_parse(&ctx, b->name, b->text, strlen(b->text), &file, &error);
        if (status == FRAM_OK)
            status = hull_file_finish(&ctx, b->name, &file, &options, &surface, &report, &error);
        ck_assert_msg(status == FRAM_ERROR_INPUT, "%s: %d", b->name, (int)status);
        ck_assert_msg(strstr(error.message, b->message), "%s: '%s' lacks '%s'", b->name, error.message, b->message);
        ck_assert_msg(error.line == b->line, "%s: line %d, expected %d: %s", b->name, error.line, b->line,
                      error.message);
        ck_assert_msg(strcmp(error.key, b->key) == 0, "%s: key '%s', expected '%s'", b->name, error.key, b->key);
        ck_assert_str_eq(error.file, b->name);
        ck_assert_int_eq(surface.face.count, 0);
        ck_assert_int_eq(file.surface.face.count, 0);
    }
}
END_TEST

/* Binary STL has no lines; facets are numbered. */
START_TEST(bad_binary)
{
    context ctx;
    context_init(&ctx);
    enum { FACETS = 2, SIZE = 84 + 50 * FACETS };
    static const float corner[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const struct {
        size_t at; /* byte that is changed */
        unsigned char value;
        size_t size;
        const char *key, *message;
    } cases[] = {
        {80, 3, SIZE, "", "of 3 facets is 234 bytes long, but this one is 184"},
        {83, 0xff, SIZE, "", "cut short, or no STL file"},
        {0, 0, SIZE - 1, "", "but this one is 183"},
        {84 + 50 + 12 + 3, 0x7f, SIZE, "facet 2", "coordinate 1 of corner 1 is not a finite number"},
        {84 + 12 + 7, 0xff, SIZE, "facet 1", "coordinate 2 of corner 1 is not a finite number"},
        {84 + 50 + 12 + 15, 0x7e, SIZE, "facet 2", "bring the mesh"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char data[SIZE + 1] = {0};
        data[80] = FACETS;
        for (int k = 0; k < FACETS; k++)
            memcpy(data + 84 + 50 * k + 12, corner, sizeof corner);
        /* A float's sign and exponent stand in its last two bytes. */
        data[cases[i].at] = (char)cases[i].value;
        if (strstr(cases[i].message, "finite"))
            data[cases[i].at - 1] = (char)0x80;
        mesh_file file;
        fram_error error = {0};
        assert_fails(mesh_file_parse(&ctx, "b.stl", data, cases[i].size, &file, &error), error, FRAM_ERROR_INPUT,
                     cases[i].message);
        ck_assert_str_eq(error.key, cases[i].key);
        ck_assert_int_eq(error.line, 0);
    }
}
END_TEST

START_TEST(binary_of_another_name)
{
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 2; i++) {
        static const char data[84] = "no facets";
        mesh_file file;
        fram_error error = {0};
        assert_fails(mesh_file_parse(&ctx, i == 0 ? "b.obj" : "b.gdf", data, sizeof data, &file, &error), error,
                     FRAM_ERROR_INPUT, "found a binary STL file; let its name end in .stl");
    }
}
END_TEST

TEST_MAIN("bad_meshes", every_bad_mesh_is_refused, bad_binary, binary_of_another_name)
