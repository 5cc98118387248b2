/* The ice that a load stands on (docs/decisions/0044): what of the sectors of its stencil is ice, out to about
   R_bending, or to where the floe ends along the first crack if that is nearer. */
#include "ice/fracture_parts.h"

#include "ice/wedge.h"

/* The sectors of a straight edge's N wedges around a start, one after the other. */
typedef struct sectors {
    vec2 corner[3 * MOST_STENCIL];
    int32_t size[MOST_STENCIL];
    int count;
} sectors;

static void make_sectors(const fracture_job *j, const crack_start *start, double radius, sectors *out)
{
    vec2 stencil[MOST_STENCIL];
    out->count = fracture_stencil(j->settings->wedges, radius, start, stencil);
    for (int i = 0; i < out->count; i++) {
        out->size[i] = 3;
        out->corner[3 * i] = start->point;
        out->corner[3 * i + 1] = stencil[i];
        out->corner[3 * i + 2] = stencil[i + 1 < out->count ? i + 1 : 0];
    }
}

/* Ice in the sectors over that of the N whole ones that a straight edge has. */
static double part_of(const sectors *s, const double *area)
{
    double sum = 0, whole = 0;
    for (int i = 0; i < s->count; i++) {
        sum += area[i];
        whole += polygon_area((polygon){s->corner + 3 * i, 3});
    }
    return whole > 0 ? 2 * sum / whole : 0;
}

static fram_status ice_of_floe(const fracture_job *j, const fracture_load *l, double radius, edge_ice *edge)
{
    polygon outline = shape_outline(j->state->shapes, j->state->bodies->shape[l->body]);
    crack_start start = crack_start_of(outline, l->place, CRACK_CORNER_REACH * radius);
    int32_t end;
    double area[MOST_STENCIL] = {0};
    sectors s;
    make_sectors(j, &start, fmin(radius, crack_length(outline, &start, &end)), &s);
    for (int i = 0; i < s.count; i++)
        area[i] = polygon_overlap_area(outline, (polygon){s.corner + 3 * i, 3});
    edge->wedges = part_of(&s, area);
    return FRAM_OK;
}

static fram_status ice_of_sheet(const fracture_job *j, const fracture_load *l, double radius, edge_ice *edge)
{
    crack_start start;
    bool found;
    fram_status status =
        fracture_sheet_start(j, l->place, fracture_sheet_reach(&j->settings->tiles), radius, &start, &found);
    if (status != FRAM_OK || !found)
        return status;
    double area[MOST_STENCIL] = {0};
    sectors s;
    make_sectors(j, &start, fmin(radius, fracture_sheet_crack_length(j, &start, CRACK_CORNER_REACH * radius)), &s);
    status = fracture_sheet_areas(j, s.corner, s.size, s.count, area);
    edge->wedges = part_of(&s, area);
    return status;
}

double fracture_edge_reach(const fracture_settings *f, const ice_material *ice, double thickness, double area)
{
    double length = ice_characteristic_length(ice, thickness, f->water_density, f->gravity);
    double share = f->wedges * fracture_wedge_width(f->wedges) / 2;
    double radius = fracture_loaded_radius(area, share, thickness, f->thick_plate_radius);
    return length * wedge_breaking_estimate(radius / length);
}

fram_status fracture_find_ice(const fracture_job *j, const fracture_load *l, edge_ice *edge)
{
    *edge = EDGE_STRAIGHT;
    if (j->settings->sharing == SHARING_EQUAL)
        return FRAM_OK;
    double radius = fracture_edge_reach(j->settings, &l->ice, l->thickness, l->horizontal_area);
    return l->tile ? ice_of_sheet(j, l, radius, edge) : ice_of_floe(j, l, radius, edge);
}
