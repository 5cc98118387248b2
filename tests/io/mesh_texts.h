/* Small meshes as texts, for the tests of their readers. */
#ifndef TESTS_IO_MESH_TEXTS_H
#define TESTS_IO_MESH_TEXTS_H

/* The tetrahedron of the origin and the unit points, volume 1/6. */
#define STL_FACET(a, b, c) \
    "facet normal 0 0 0\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c "\n endloop\nendfacet\n"
#define STL_O "0 0 0"
#define STL_X "1 0 0"
#define STL_Y "0 1 0"
#define STL_Z "0 0 1"
#define STL_TETRAHEDRON                                                                                      \
    "solid t\n" STL_FACET(STL_O, STL_Y, STL_X) STL_FACET(STL_O, STL_X, STL_Z) STL_FACET(STL_O, STL_Z, STL_Y) \
        STL_FACET(STL_X, STL_Y, STL_Z) "endsolid t\n"
#define OBJ_POINTS "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
#define OBJ_TETRAHEDRON OBJ_POINTS "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
/* A box of 2 x 2 x 1 under water, open at z = 0: one quarter, to be mirrored in x = 0 and y = 0. */
#define GDF_HEAD(x, y, n) "a quarter box\n1.0 9.80665\n" x " " y "\n" n "\n"
#define GDF_QUARTER                                     \
    "0 0 -1  0 1 -1  1 1 -1  1 0 -1\n" /* bottom */     \
    "1 0 -1  1 1 -1  1 1 0  1 0 0\n"   /* side x = 1 */ \
    "1 1 -1  0 1 -1  0 1 0  1 1 0\n"   /* side y = 1 */
#define GDF_BOX GDF_HEAD("1", "1", "3") GDF_QUARTER

#endif
