/* Fram: hulls.  Read one from a mesh file or make one from main particulars, ask how it floats, cut it into convex
   pieces, draw it, write it.

       fram_hull *hull;
       fram_hull_floating floating;
       fram_hull_load(context, "ship.stl", NULL, &hull, &error);
       fram_hull_float(hull, NULL, &floating, &error);
       printf("%g m3\n", floating.volume);
       fram_hull_destroy(hull);

   Units are SI, angles are radians.  The hull's frame is that of its file: x forward, y to port, z up; a hull made from
   particulars has x = 0 amidships and z = 0 in its design waterline.  Rules about statuses, errors and threads stand in
   fram.h; a context must outlive its hulls. */
#ifndef FRAM_HULL_H
#define FRAM_HULL_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A closed surface of triangles, sound: no open edge, no crossing triangles, turned outward.  Never changes. */
typedef struct fram_hull fram_hull;

/* --- Making one --- */

/* How a mesh file is read.  A NaN leaves the number to Fram. */
typedef struct fram_hull_file_definition {
    size_t size;       /* of this struct, set by fram_hull_file_default */
    double scale;      /* lengths of the file times this are metres; > 0, default 1 */
    double seal_width; /* cracks of at most this width are sealed [m]; 0: none; NaN: a two-thousandth of the length */
    bool repair;       /* fill holes and turn triangles, instead of refusing the file */
    double freeboard;  /* a level open top is raised by this and closed by a deck [m]; NaN: a third of the depth for GDF
                          files, which end at the waterline (one that ends above it is decked there); others are then
                          refused */
} fram_hull_file_definition;
FRAM_API void fram_hull_file_default(fram_hull_file_definition *definition, size_t size);
#define fram_hull_file_default(definition) fram_hull_file_default((definition), sizeof *(definition))
/* STL (text, binary), Wavefront OBJ or WAMIT GDF (mirrored in its symmetry planes, given topsides), by ending or
   content. definition NULL: the defaults.  FRAM_ERROR_INPUT, with line and element ("panel 12"), when the surface
   cannot be read or is no sound solid: open, inside out, crossing itself; the message says what would help. */
FRAM_API fram_status fram_hull_load(fram_context *context, const char *path,
                                    const fram_hull_file_definition *definition, fram_hull **hull, fram_error *error);

/* Main particulars of a box, of an icebreaking hull (wedge bow, flared midbody, raked stern, made of planes) or of a
   ship of full form (tanker, FPSO, drillship: flat of side and bottom, without bulb).  NaN in stem_angle,
   entrance_angle, flare_angle, stern_angle, parallel_midbody, bilge_radius or transom, the default of each, takes what
   is usual for the form: of an icebreaker 30 degrees, of flare 8, and 0.4 of the length parallel; of a ship a stem of
   75 degrees, a stern of 45, no flare, and the others as the block coefficient, beam and draught have them. */
typedef struct fram_hull_particulars {
    size_t size;              /* of this struct, set by fram_hull_particulars_default */
    bool box;                 /* only length, beam, draught and freeboard matter */
    double length;            /* of the waterline [m] */
    double beam;              /* of the waterline [m] */
    double draught;           /* [m] */
    double freeboard;         /* height of the deck above the waterline [m] */
    double stem_angle;        /* stem against the water plane [rad] */
    double entrance_angle;    /* half entrance angle of the waterline [rad] */
    double flare_angle;       /* sides against the vertical [rad] */
    double stern_angle;       /* run of the stern against the water plane [rad] */
    double parallel_midbody;  /* length of the parallel middle body over the length [1] */
    double block_coefficient; /* met by the shape of the bilge, of a ship by its ends; 0: sharp bilges, default [1] */
    bool ship;                /* instead of an icebreaker; not with box */
    double bilge_radius;      /* of a ship [m]; NaN, default: as beam and draught have it */
    double transom; /* of a ship: breadth of the transom over the beam, 0 a pointed stern; NaN, default: 0.5 */
} fram_hull_particulars;
FRAM_API void fram_hull_particulars_default(fram_hull_particulars *particulars, size_t size);
#define fram_hull_particulars_default(particulars) fram_hull_particulars_default((particulars), sizeof *(particulars))
/* FRAM_ERROR_INPUT, with the member's name as key, when the particulars do not go together; a block coefficient out of
   reach is refused with the range that can be reached. */
FRAM_API fram_status fram_hull_make(fram_context *context, const fram_hull_particulars *particulars, fram_hull **hull,
                                    fram_error *error);
FRAM_API void fram_hull_destroy(fram_hull *hull);

/* --- What it is --- */

typedef struct fram_hull_surface {
    const char *format;          /* "STL (text)", "STL (binary)", "OBJ", "GDF", "particulars" */
    int elements;                /* facets, faces or panels of the file */
    int dropped;                 /* of them or their triangles, without area */
    bool mirrored_x, mirrored_y; /* in the plane x = 0 (y = 0) */
    int triangles, vertices;
    double lo[3], hi[3];    /* corners of the box around it [m] */
    double enclosed_volume; /* [m3] */
    double centroid[3];     /* of the enclosed volume [m] */
    /* Sealing: open edges before it, vertices joined, edges led over a vertex, the widest crack found [m], area that
       moved edges swept [m2], area vector by which the surface failed to close [m2], change of the volume integrals
       [m3]. */
    double seal_width;
    int open_edges_before, joined, splits;
    double crack_width, crack_area, crack_vector[3], crack_volume[3];
    double topsides;  /* freeboard that was added, 0 without [m] */
    int lids;         /* triangles in the water plane that were left out */
    int holes_filled; /* on request */
    double hole_area; /* [m2] */
    int flipped;      /* triangles turned, on request */
    /* Closed parts inside the hull (tanks, the inner face of a plating), which were left out: no water comes there; by
       how much the hull encloses more without them [m3]. */
    int inner_parts;
    double inner_volume;
    double well;    /* part of what the waterline (z = 0, or half the height) goes round that is a hole in it */
    bool open_boat; /* more than half of it: plating without a deck, and full of water */
    bool half; /* the file has half a hull or a quarter, open along y = 0 or x = 0, and was closed there on request */
    double decked; /* of a GDF's open top above the water that was closed where it is, 0 without [m2] */
} fram_hull_surface;
FRAM_API void fram_hull_surface_get(const fram_hull *hull, fram_hull_surface *surface, size_t size);
#define fram_hull_surface_get(...) fram_hull_surface_get(__VA_ARGS__, sizeof(fram_hull_surface))
/* The triangles: up to `room` vertices (x, y, z) and triangles (three vertex numbers from 0) are copied; either may be
   NULL with room 0.  Sizes stand in fram_hull_surface. */
FRAM_API void fram_hull_triangles(const fram_hull *hull, double *vertices, int vertex_room, int *triangles,
                                  int triangle_room);

/* --- How it floats --- */

/* Where the water is.  A NaN leaves the number to Fram.  Without draught and mass: at z = 0, upright. */
typedef struct fram_hull_condition {
    size_t size;          /* of this struct, set by fram_hull_condition_default */
    double draught;       /* depth of the lowest point under the water, upright [m] */
    double mass;          /* the hull takes the level, heel and trim of equilibrium [kg]; not together with draught */
    double centre[3];     /* of mass, hull's frame [m]; NaN: over the centre of buoyancy, and in the waterline */
    double water_density; /* [kg/m3], default 1025 */
    double gravity;       /* [m/s2], default 9.81 */
} fram_hull_condition;
FRAM_API void fram_hull_condition_default(fram_hull_condition *condition, size_t size);
#define fram_hull_condition_default(condition) fram_hull_condition_default((condition), sizeof *(condition))

/* The axes of a file, told by its shape: x forward, y to port and z up, as they are to be; or the waterline is longer
   along y than along x by a tenth at least; or the two sides lie about z = 0 and not about y = 0. */
enum { FRAM_HULL_AXES_OF_SHIPS = 0, FRAM_HULL_Y_FORWARD = 1, FRAM_HULL_Y_UP = 2 };

/* Places are in the hull's frame.  Second moments, lengths of the waterline and stiffness are in the water plane, with
   x and y along the hull's own. */
typedef struct fram_hull_floating {
    double level;  /* z of the water in the hull's frame, turned upright first when heeled or trimmed [m] */
    double heel;   /* positive: starboard down [rad] */
    double trim;   /* positive: bow down [rad] */
    bool stable;   /* it comes back from small heel and trim */
    double volume; /* displaced [m3] */
    double
        volume_integrals[3]; /* of x n_x, y n_y, z n_z over the wet surface: all the volume, since it is closed [m3] */
    double mass;             /* displaced [kg] */
    double enclosed_volume;  /* [m3] */
    double centre[3];        /* of mass [m] */
    double centre_of_buoyancy[3];                                /* [m] */
    double waterplane_area;                                      /* [m2] */
    double centre_of_flotation[3];                               /* [m] */
    double second_moment_transverse, second_moment_longitudinal; /* of the water plane about its centroid [m4] */
    double wetted_area;                                          /* [m2] */
    double kb, kg, bm_transverse, bm_longitudinal, gm_transverse, gm_longitudinal; /* [m] */
    /* Restoring coefficients about the centre of mass: heave [N/m], heave-roll and heave-pitch [N], roll, roll-pitch
       and pitch [N m]. */
    double c33, c34, c35, c44, c45, c55;
    double length_overall, breadth_overall, depth; /* [m] */
    double length_waterline, breadth_waterline;    /* [m] */
    double draught, draught_fore, draught_aft;    /* of the lowest point: amidships, at the ends of the waterline [m] */
    double midship_area;                          /* wet [m2] */
    double block, waterplane, midship, prismatic; /* coefficients [1] */
    int axes;                                     /* FRAM_HULL_AXES_OF_SHIPS or what they are taken for */
} fram_hull_floating;
/* condition NULL: the defaults.  FRAM_ERROR_INPUT: the water does not cut the hull, it sinks, or no equilibrium is
   found; FRAM_ERROR_USAGE: draught and mass together. */
FRAM_API fram_status fram_hull_float(const fram_hull *hull, const fram_hull_condition *condition,
                                     fram_hull_floating *floating, fram_error *error, size_t size);
#define fram_hull_float(...) fram_hull_float(__VA_ARGS__, sizeof(fram_hull_floating))

/* --- Pieces, drawings, files --- */

/* Drawings and files are not written over the file that the hull is of: FRAM_ERROR_USAGE, key "path". */

enum { FRAM_HULL_PIECES = 4096 }; /* the most pieces that may be asked for, as in a scenario */
typedef struct fram_hull_pieces {
    int count;
    double tolerance; /* distance that was allowed [m] */
    double concavity; /* largest distance of the pieces to the surface that remains [m] */
    double volume;    /* of all pieces [m3] */
} fram_hull_pieces;
/* Cut into convex pieces, as collisions use them.  tolerance: largest distance between pieces and surface [m], NaN: a
   hundredth of the breadth; most: number of pieces, 1 to FRAM_HULL_PIECES; each closed part has one at least.  The hull
   keeps them for drawings. */
FRAM_API fram_status fram_hull_cut(fram_hull *hull, double tolerance, int most, fram_hull_pieces *pieces,
                                   fram_error *error, size_t size);
#define fram_hull_cut(...) fram_hull_cut(__VA_ARGS__, sizeof(fram_hull_pieces))
/* A lines plan with the water, the surface and the pieces (if it was cut), as SVG when path ends in .svg, else as PNG;
   title may be NULL.  FRAM_ERROR_UNSUPPORTED in a build without pictures. */
FRAM_API fram_status fram_hull_draw(const fram_hull *hull, const fram_hull_condition *condition, const char *title,
                                    const char *path, fram_error *error);
/* Write the surface; the ending says how: .stl (binary), .obj, .gdf.  FRAM_ERROR_USAGE for another one. */
FRAM_API fram_status fram_hull_save(const fram_hull *hull, const char *path, fram_error *error);

#ifdef __cplusplus
}
#endif
#endif
