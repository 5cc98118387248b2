/* Fram: how floating ice breaks under a load at its edge; the formulas that a run uses, for quick calculations.

       fram_ice_edge load;
       fram_ice_breaking breaking;
       fram_ice_edge_default(&load);
       load.force = 300e3;
       load.contact_area = 0.2;
       fram_ice_break(&load, &breaking, &error);
       printf("breaks %g m from the load at %g N\n", breaking.breaking_radius, breaking.wedge_capacity);

   Units are SI.  Symbols: h thickness, l characteristic length, a radius of the loaded area, P load, sigma_f flexural
   strength, N wedges that share the load, b0 = 2 tan(pi/(2 N)).  Rules about statuses and errors stand in fram.h. */
#ifndef FRAM_ICE_H
#define FRAM_ICE_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- Dimensionless --- */

/* A wedge-shaped beam on water, loaded evenly over the length a at its tip (Nevel 1961). */
typedef struct fram_ice_wedge_result {
    double capacity_C; /* one wedge carries sigma_f b0 h^2/6 C */
    double x_max;      /* where it breaks, over l */
    double eta0;       /* deflection of the tip, w k b0 l^2/P */
} fram_ice_wedge_result;
/* FRAM_ERROR_INPUT unless 0.001 <= a/l <= 3. */
FRAM_API fram_status fram_ice_wedge(double a_over_l, fram_ice_wedge_result *result, fram_error *error, size_t size);
#define fram_ice_wedge(...) fram_ice_wedge(__VA_ARGS__, sizeof(fram_ice_wedge_result))

/* A sheet with a straight edge, loaded evenly on a half disk of radius a there: stress along the edge. */
typedef struct fram_ice_sheet_result {
    double sigma_h2_over_P;       /* as a run takes it: closed form up to a/l = 0.3, the plate's integral beyond */
    double exact_sigma_h2_over_P; /* the plate's integral, to about 1e-6 */
    double closed_form_sigma_h2_over_P; /* Westergaard */
} fram_ice_sheet_result;
/* FRAM_ERROR_INPUT unless 0.001 <= a/l <= 3 and 0 <= poisson_ratio <= 0.5. */
FRAM_API fram_status fram_ice_sheet(double a_over_l, double poisson_ratio, fram_ice_sheet_result *result,
                                    fram_error *error, size_t size);
#define fram_ice_sheet(...) fram_ice_sheet(__VA_ARGS__, sizeof(fram_ice_sheet_result))

/* --- A load on an ice edge --- */

/* Beside the strip under a contact_width stand whole wedges, as many as under a narrow load, included_angle/pi times N:
   together they carry what they do alone, however wide the strip.  ice_length is that of the strip alone. */
typedef struct fram_ice_edge {
    size_t size;              /* of this struct, set by fram_ice_edge_default */
    double force;             /* P, across the ice [N]; default 0 */
    double contact_area;      /* horizontal area of the contact [m2]; default 0: a point */
    double thickness;         /* [m]; default 1 */
    double elastic_modulus;   /* [Pa]; default 5e9 */
    double poisson_ratio;     /* default 0.3 */
    double flexural_strength; /* [Pa]; default 0.5e6 */
    double crushing_strength; /* [Pa]; default 2e6 */
    double water_density;     /* [kg/m3]; default 1025 */
    double gravity;           /* [m/s2]; default 9.81 */
    int wedges;               /* N; default 3 */
    bool thick_plate_radius;  /* small loads act as on a radius that grows with the thickness; default true */
    double included_angle; /* of the ice at the contact, up to 2 pi: a corner carries less [rad]; default pi, an edge */
    double contact_width;  /* along the edge: a strip breaks off between the end wedges [m]; default 0: wedges alone */
    double ice_length;     /* of the ice behind a wide contact [m]; default 0: so long that its end does not matter */
    double
        rise_time; /* in which the load has risen evenly, so that ice and water must follow [s]; default 0: at rest */
    double ice_density; /* for rise_time [kg/m3]; default 920 */
} fram_ice_edge;
FRAM_API void fram_ice_edge_default(fram_ice_edge *load, size_t size);
#define fram_ice_edge_default(load) fram_ice_edge_default((load), sizeof *(load))

typedef struct fram_ice_breaking {
    double characteristic_length; /* l [m] */
    double radial_radius;         /* a of the half disk, which may stand for contact_width [m] */
    double wedge_radius;          /* a of the wedges [m] */
    double radial_stress;         /* sigma_yy: the first, radial crack opens when it meets sigma_f; 0: none [Pa] */
    double wedge_stress;          /* sigma_wedge_max: the wedges break off when it meets sigma_f [Pa] */
    double radial_capacity;       /* P at which the radial crack opens; infinite: none, radial_radius over 3 l [N] */
    double wedge_capacity;        /* P at which the wedges break off, with the strip between them [N] */
    double breaking_radius;       /* R_bending [m] */
    double crushing_force;        /* the contact area at the crushing strength [N] */
    double strip_capacity;        /* what of wedge_capacity the strip carries [N] */
    double strip_length;          /* from the edge to where the strip breaks [m]; 0 without contact_width */
} fram_ice_breaking;
/* FRAM_ERROR_INPUT, with the member's name as key, for a value out of range. */
FRAM_API fram_status fram_ice_break(const fram_ice_edge *load, fram_ice_breaking *breaking, fram_error *error,
                                    size_t size);
#define fram_ice_break(...) fram_ice_break(__VA_ARGS__, sizeof(fram_ice_breaking))

/* --- A floe that splits --- */

/* A rectangular floe whose radial crack starts at a point of one side and runs straight across. */
typedef struct fram_ice_floe {
    size_t size;      /* of this struct, set by fram_ice_floe_default */
    double thickness; /* [m]; default 1 */
    double toughness; /* K_IC [Pa m^0.5]; default 150e3 */
    double length;    /* along the crack [m]; default 50 */
    double width;     /* across it [m]; default 50 */
    double place;     /* of the load along the side, from its middle: -width/2 to width/2 [m]; default 0 */
} fram_ice_floe;
FRAM_API void fram_ice_floe_default(fram_ice_floe *floe, size_t size);
#define fram_ice_floe_default(floe) fram_ice_floe_default((floe), sizeof *(floe))

typedef struct fram_ice_splitting {
    double smaller_side, larger_side; /* of the floe, to both sides of the crack [m] */
    double factor;                    /* F */
    double splitting_load;            /* largest opening force of the crack, F h K_IC sqrt(length) [N] */
    double slenderness;               /* of the narrower piece, longer over shorter side; a run splits no floe where
                                         it is over ice.fracture.narrowness (4), whatever the load */
} fram_ice_splitting;
/* FRAM_ERROR_INPUT, with the member's name as key, for a value out of range. */
FRAM_API fram_status fram_ice_split(const fram_ice_floe *floe, fram_ice_splitting *splitting, fram_error *error,
                                    size_t size);
#define fram_ice_split(...) fram_ice_split(__VA_ARGS__, sizeof(fram_ice_splitting))

#ifdef __cplusplus
}
#endif
#endif
