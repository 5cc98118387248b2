/* How far the edge of level or fixed ice gives under a load before it breaks (docs/decisions/0220): Nevel's wedges, and
   the strip under a wide contact, have one tip deflection in common,
       P = k (l^2 sum b0 / eta(0) + strip) w,   k = rho_w g,
   with eta(0) of ice/wedge.h and the strip of ice/strip.h; and what the inertia of ice and water makes of an edge whose
   load rises (docs/decisions/0320).  Knows loads and ice, not whose surface pushes. */
#ifndef ICE_EDGE_GIVE_H
#define ICE_EDGE_GIVE_H

#include "base/table.h"
#include "base/vec.h"
#include "bodies/body.h"
#include "ice/material.h"
#include "ice/wedge_ramp.h"

/* What a patch on level or fixed ice stood on in the last step; rows are made anew in each, and found again by the
   nearest place on the surface.  State. */
#define EDGE_SUPPORT_FIELDS(X)                                                                                    \
    X(surface, int32_t, FIELD_I32, 1, "1", "slot of the body that pushes")                                        \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of that body")                                                    \
    X(place, vec3, FIELD_F64, 3, "m", "middle of the patch, frame of that body")                                  \
    X(wedges, double, FIELD_F64, 1, "1", "ice of the wedges over that of N whole ones")                           \
    X(part, double, FIELD_F64, 1, "1", "horizontal area of the patch over that of the load, in all of its tiles") \
    X(strip, double, FIELD_F64, 1, "m2", "load over deflection of the strip under a wide contact, over rho_w g")  \
    X(strip_bears, double, FIELD_F64, 1, "m2", "load at which that strip breaks, over the flexural strength")     \
    X(load, double, FIELD_F64, 1, "N", "vertical load of the last step, of the whole load")                       \
    X(impulse, double, FIELD_F64, 1, "N s", "of that load since the first touch")                                 \
    X(own, double, FIELD_F64, 1, "N", "vertical load of this patch on the ice in the last step, up")              \
    X(rise, double, FIELD_F64, 1, "m", "of the edge under the whole load in the last step, up")                   \
    X(gap, double, FIELD_F64, 1, "m", "by which the surface stands off the ice, along the normal of the patch")   \
    X(known, int32_t, FIELD_I32, 1, "1", "1: the ice was looked at, 0: the load is so small that it was not")     \
    X(over, int32_t, FIELD_I32, 1, "1", "1: the patch was over what breaks known ice in the last step, 0: not")
TABLE_DECLARE(edge_support, EDGE_SUPPORT_FIELDS)

typedef struct edge_compliance {
    bool gives;           /* false: an edge is rigid until it breaks */
    bool inertia;         /* false: ice and water have no mass as an edge bends */
    double water_density; /* [kg/m3] */
    double gravity;       /* [m/s2] */
    int32_t wedges;       /* N_wedges */
    bool thick_plate_radius;
    bool elastic; /* edges give below the crushing limit and under free pieces too: ice/edge_rows.h */
} edge_compliance;

/* One row of the table, without its place. */
typedef struct edge_stand {
    double wedges, part, strip, strip_bears, impulse;
    double rise; /* for how long the load has risen [s] */
    double up;   /* how far the edge stood up in the last step [m] */
    bool known;  /* false: a straight edge is assumed */
    bool over;   /* it was over what breaks ice that is known */
} edge_stand;
/* An edge gives by this part of the thickness at most: ice that is farther down is out of the hull that loads it.
   Plates that are held all round stretch from half the thickness on (Timoshenko and Woinowsky-Krieger 1959); beams and
   wedges with free ends draw in instead. */
#define EDGE_MOST_DEFLECTION 1
/* Less ice than this part of a straight edge's is rounding. */
#define EDGE_LEAST_ICE 1e-6

/* A straight edge under a narrow load that no seam divides. */
#define EDGE_STAND_STRAIGHT ((edge_stand){.wedges = 1, .part = 1})

/* The row of what stood under a patch with this middle (global [m]) of the surface's body: the nearest within `reach`
   [m], -1 without one. */
int32_t edge_support_nearest(const edge_support_table *supports, const body_table *bodies, int32_t surface, vec3 place,
                             double reach);
/* What stands under a patch with this middle (global [m]) of the surface's body: the nearest row within `reach` [m], a
   straight edge without one. */
edge_stand edge_stand_find(const edge_support_table *supports, const body_table *bodies, int32_t surface, vec3 place,
                           double reach);

/* b0 of a wedge of angle pi/N: 2 tan(pi/(2 N)). */
double fracture_wedge_width(int32_t wedges);
/* Radius of a load of this area [m2]: the area as a part of a disc, area = share a^2; where a < 1.724 h and thick is
   set, a_eff = sqrt(1.6 a^2 + h^2) - 0.675 h (Westergaard 1926) [m]. */
double fracture_loaded_radius(double area, double share, double thickness, bool thick);

/* R_bending of a straight edge under a narrow load on a horizontal area [m2], within 5 % [m]. */
double edge_reach(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area);

/* A load that has risen by as much in each second as its impulse says would have risen for this time [s]: 2 J/P,
   endless without a load. */
double edge_rise_time(double impulse, double load);

/* What inertia makes of an edge whose load has risen for this time [s] on a radius [m]; 1 without inertia.  M is the
   ice's mass and the water's rho_w/k under waves of the wave number k = pi/(4 R), R the distance to the largest moment.
 */
wedge_ramp edge_rise(const edge_compliance *e, const ice_material *ice, double thickness, double radius, double time);

/* Load over deflection of the edge under a load on a horizontal area [m2], of the whole load [N/m]. */
double edge_stiffness(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area,
                      edge_stand stand);

/* What a strip of this width bears over its flexural strength [m2], of the largest moment `arm` a load of 1 N/m [m]. */
double edge_strip_bears(double width, double arm, double thickness);

/* What the wedges bear beside a strip that bears this much [N], and what they stand on: each stands on the contact area
   that crushes at its share of the load (docs/decisions/0128). */
typedef struct edge_bearing {
    double radius; /* loaded, of the wedges [m] */
    double place;  /* where they break, over the characteristic length */
    double load;   /* under which all break, at rest [N] */
} edge_bearing;
edge_bearing edge_bears(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area,
                        double wedges, double strip);

/* The load on a horizontal area [m2] under which what stands there breaks, both of the whole load [N]; infinite where
   this load surely does not break it. */
double edge_breaking_load(const edge_compliance *e, const ice_material *ice, double thickness, double horizontal_area,
                          edge_stand stand, double load);

#endif
