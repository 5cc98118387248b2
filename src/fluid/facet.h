/* Integrals of pressure and drag over one plane facet that lies wholly in one medium: what meshes and prisms are both
   made of. All points are relative to the body's centre of mass, axes of the global frame.  A facet is a convex polygon
   with its unit normal, outward; vertices that run clockwise about the normal make a facet of negative area, so that
   signed fans add up to concave faces.
   Knows no meshes. */
#ifndef FLUID_FACET_H
#define FLUID_FACET_H

#include "bodies/body.h"
#include "bodies/shape.h"
#include "fluid/media.h"

/* Most vertices of a facet: a quadrilateral cut by the water plane and by the line where it stops moving into the
   medium; each cut adds one, and facet_clip may write one more. */
enum { FACET_VERTICES = 8 };

/* Integrals over the wet facets: of z n dS [m3] and of r x z n dS [m4], z the height over still water. */
typedef struct pressure_sum {
    vec3 force;
    vec3 moment;
} pressure_sum;

/* One medium as a moving body meets it. */
typedef struct stream {
    vec3 velocity; /* of the centre of mass, relative to the medium [m/s] */
    vec3 spin;     /* angular velocity of the body [rad/s] */
    double form;   /* 1/2 rho Cd [kg/m3] */
    double skin;   /* 1/2 rho Cf [kg/m3] */
    vec3 shear;    /* by how much `velocity` grows with the height of a point [1/s] */
} stream;

/* The wet and the dry side of a body with that motion; the current is that at a height over still water [m]. */
stream stream_of_water(const media *m, const drag_coefficients *c, vec3 velocity, vec3 spin, double height);
stream stream_of_air(const media *m, const drag_coefficients *c, vec3 velocity, vec3 spin);
/* Where a prism as a whole meets the current: in the middle of its wet part if it lay flat; height: of its middle,
   rise: of its upper cap over that, in place. */
static inline double prism_current_height(double height, double rise)
{
    return height + fabs(rise) <= 0 ? height : 0.5 * fmin(0, height - fabs(rise));
}
/* The current there for the prism of a slot [m/s]. */
static inline vec3 prism_current(const media *m, const body_table *b, const shape_store *shapes, int32_t slot)
{
    if (m->profile.count == 0)
        return m->current;
    double rise = shapes->shapes.half_height[b->shape[slot]] * quat_matrix(b->orientation[slot]).m[2][2];
    return media_current(m, prism_current_height(b->position[slot].z, rise));
}
/* Whether the medium can exert any drag at all. */
static inline bool stream_acts(const stream *s) { return s->form > 0 || s->skin > 0; }

/* Adds a wet facet of n vertices, n <= FACET_VERTICES; height: of the centre of mass over still water.  Exact:
   int z dS = zbar N, int z r dS = (|N|/12) [sum z_i r_i + (sum z_i)(sum r_i)] per triangle (docs/oracles.md, section
   5). */
void facet_add_pressure(pressure_sum *sum, const vec3 *vertex, int n, double height);

/* Adds form and skin drag of a facet, n <= FACET_VERTICES - 1, with the velocity of each of its points (docs/theory.md,
   Water and air).
   Form drag is exact: the part that moves into the medium is cut out, and |vn| vn is a polynomial there.
   Skin drag is a quadrature: 6 points of degree 4 on a triangle (Dunavant 1985, table II, p = 4), 2 x 2 Gauss points on
   a quadrilateral, triangles about the mean vertex beyond.  It is exact while the body does not turn and the medium has
   one velocity. */
void facet_add_drag(wrench *load, const stream *s, const vec3 *vertex, int n, vec3 normal);
/* The same of a wet facet, n <= 4, in a current that may change with depth: there the facet is cut where the profile
   bends, so that form drag is exact in it too.  s: the water at the surface; height: of the centre of mass over still
   water [m]. */
void facet_add_water_drag(wrench *load, const stream *s, const media *m, double height, const vec3 *vertex, int n,
                          vec3 normal);

#endif
