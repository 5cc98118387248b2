/* Loads of crushing patches on floes, and the stresses they make (SPEC 8.1, 8.2, 8.4). */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"
#include "ice/sheet.h"
#include "ice/wedge.h"

#include <stdlib.h>

/* Westergaard's thick-plate radius holds below this many thicknesses. */
static const double THICK_PLATE_LIMIT = 1.724;
/* A load that is a point makes infinite stress in a thin plate; this a/l is a point. */
static const double POINT_LOAD = 1e-3;

double fracture_wedge_width(int32_t wedges) { return 2 * real_tan(PI / (2.0 * wedges)); }

double fracture_loaded_radius(double area, double share, double thickness, bool thick)
{
    double a = sqrt(area / share);
    if (thick && a < THICK_PLATE_LIMIT * thickness)
        return sqrt(1.6 * a * a + thickness * thickness) - 0.675 * thickness;
    return a;
}

edge_stress fracture_edge_stress(const fracture_settings *settings, const ice_material *ice, double thickness,
                                 double load, double horizontal_area)
{
    double h = thickness, width = fracture_wedge_width(settings->wedges), count = settings->wedges;
    edge_stress s = {.length = ice_characteristic_length(ice, h, settings->water_density, settings->gravity)};
    s.radial_radius = fracture_loaded_radius(horizontal_area, PI / 2, h, settings->thick_plate_radius);
    s.wedge_radius = fracture_loaded_radius(horizontal_area, count * width / 2, h, settings->thick_plate_radius);
    double radial = sheet_stress(fmax(s.radial_radius / s.length, POINT_LOAD), ice->poisson_ratio);
    wedge w = wedge_solve(s.wedge_radius / s.length);
    s.radial_stress = radial * load / (h * h);
    s.wedge_stress = 6 * load / (count * width * h * h) * w.curvature;
    s.radial_capacity = ice->flexural_strength * h * h / radial;
    s.wedge_capacity = ice->flexural_strength * h * h * count * width / 6 * w.capacity;
    s.breaking_radius = s.length * w.x_max;
    return s;
}

static vec3 patch_impulse(const crushing_patch *p, const contact_array *contacts)
{
    vec3 sum = {0, 0, 0};
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++)
        sum = vec3_add(sum, contact_impulse(&contacts->data[i]));
    return sum;
}

/* Loads under this part of the strength fail in no way: 6/b0 eta'' and sigma_yy h^2/P are both under 12 for a/l of
   POINT_LOAD and more, and fall from there. */
static bool may_fail(const fracture_load *l, const ice_material *m, double thickness)
{
    return 12 * l->force >= m->flexural_strength * thickness * thickness;
}

/* The load of a patch on one of its two bodies. */
static bool add_load(context *ctx, fracture_scratch *s, const fracture_settings *settings,
                     const crushing_patch_array *patches, int32_t patch, const fracture_state *state, int32_t body)
{
    const crushing_patch *p = &patches->data[patch];
    int32_t floe = state->bodies->owner[body];
    if (!state->floes->breakable[floe])
        return true;
    const ice_material *ice = &state->floes->material[floe];
    double thickness = state->floes->thickness[floe];
    mat3 rotation = quat_matrix(state->bodies->orientation[body]);
    vec3 force = vec3_scale(mat3_tmul_vec(rotation, patch_impulse(p, state->contacts)), 1 / settings->time_step);
    vec3 place = body_to_local(state->bodies, body, p->centre);
    double up = fabs(mat3_tmul_vec(rotation, p->normal).z);
    double area = body == p->floe_body ? p->horizontal_area : p->area * up;
    fracture_load l = {.body = body,
                       .floe = floe,
                       .patch = patch,
                       .force = fabs(force.z),
                       .plane_force = sqrt(force.x * force.x + force.y * force.y),
                       .place = {place.x, place.y}};
    if (!may_fail(&l, ice, thickness))
        return true;
    l.stress = fracture_edge_stress(settings, ice, thickness, l.force, area);
    l.radial_ratio = l.stress.radial_stress / ice->flexural_strength;
    l.wedge_ratio = l.stress.wedge_stress / ice->flexural_strength;
    return (l.radial_ratio < 1 && l.wedge_ratio < 1) || array_push(ctx, &s->loads, l);
}

static double severity(const fracture_load *l) { return fmax(l->radial_ratio, l->wedge_ratio); }

static int compare_loads(const void *a, const void *b)
{
    const fracture_load *x = a, *y = b;
    if (x->body != y->body)
        return x->body < y->body ? -1 : 1;
    if (severity(x) != severity(y))
        return severity(x) > severity(y) ? -1 : 1;
    return x->patch < y->patch ? -1 : x->patch > y->patch ? 1 : 0;
}

bool fracture_loads(context *ctx, fracture_scratch *s, const fracture_settings *settings,
                    const crushing_patch_array *patches, const fracture_state *state)
{
    array_clear(&s->loads);
    for (int32_t i = 0; i < patches->count; i++) {
        const crushing_patch *p = &patches->data[i];
        uint8_t other = state->bodies->material[p->surface_body];
        if (other == MATERIAL_WALL || (other == MATERIAL_ICE && !settings->under_ice_contacts))
            continue;
        if (!add_load(ctx, s, settings, patches, i, state, p->floe_body))
            return false;
        if (other == MATERIAL_ICE && !add_load(ctx, s, settings, patches, i, state, p->surface_body))
            return false;
    }
    if (s->loads.count > 1)
        qsort(s->loads.data, (size_t)s->loads.count, sizeof *s->loads.data, compare_loads);
    return true;
}
