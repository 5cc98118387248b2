/* Making and removing floes; see floe.h. */
#include "ice/floe.h"

#include "base/transcendental.h"

#include <string.h>

#define TABLE_SELF floe_table
TABLE_DEFINE(floe, FLOE_FIELDS)
#undef TABLE_SELF

double floe_floating_elevation(double thickness, double density, double water_density)
{
    return thickness / 2 - thickness * density / water_density;
}

/* What is wrong with a definition, NULL when nothing is.  Comparisons are written so that NaN fails them. */
static const char *definition_fault(const floe_definition *d, double area)
{
    if (!(area > 0 && area < HUGE_VAL))
        return "the outline must have an area and turn counter-clockwise";
    if (!(d->thickness > 0 && d->thickness < HUGE_VAL))
        return "the thickness must be positive";
    if (!(d->material.density > 0 && d->material.density < HUGE_VAL))
        return "the density must be positive";
    if (!(fabs(d->elevation) < HUGE_VAL && fabs(d->yaw) < HUGE_VAL))
        return "elevation and yaw must be finite";
    if (d->motion < MOTION_STATIC || d->motion > MOTION_CARRIED)
        return "the motion must be static, prescribed, dynamic or carried";
    return NULL;
}

/* The outline about its centroid, turned by -yaw. */
static bool outline_to_body(context *ctx, polygon outline, vec2 centroid, mat3 orientation, vec2_array *out)
{
    if (!array_resize(ctx, out, outline.count))
        return false;
    for (int32_t i = 0; i < outline.count; i++) {
        vec2 r = vec2_sub(outline.vertex[i], centroid);
        vec3 turned = mat3_tmul_vec(orientation, (vec3){r.x, r.y, 0});
        out->data[i] = (vec2){turned.x, turned.y};
    }
    return true;
}

/* Inertia tensor of a prism about its centroid, from the second moments of its outline. */
static sym3 prism_inertia(polygon_moments p, double thickness, double density)
{
    double line = density * thickness; /* mass per area of outline */
    double across = line * p.area * thickness * thickness / 12;
    return (sym3){line * p.xx + across, line * p.yy + across, line * (p.xx + p.yy), -line * p.xy, 0, 0};
}

/* The lowest free row, or a new one at the end; -1 without memory.  Rows are looked at by the block, without leaving it
   early, which compilers turn into a few wide instructions. */
static int32_t free_row(context *ctx, floe_table *floes)
{
    enum { BLOCK = 64 };
    int32_t first = floes->taken;
    for (; first + BLOCK <= floes->count; first += BLOCK) {
        int32_t sign = 0;
        for (int32_t i = 0; i < BLOCK; i++)
            sign |= floes->body[first + i];
        if (sign < 0)
            break;
    }
    for (int32_t i = first; i < floes->count; i++)
        if (floes->body[i] < 0)
            return i;
    int32_t row = floes->count;
    if (!table_resize(ctx, floes, &floe_table_info, row + 1))
        return -1;
    floes->body[row] = -1;
    return row;
}

/* Turned by yaw [rad]. */
static vec2 turned_by(double yaw, vec2 p)
{
    if (yaw == 0)
        return p;
    double c = real_cos(yaw), s = real_sin(yaw);
    return (vec2){c * p.x - s * p.y, s * p.x + c * p.y};
}

fram_status floe_create(context *ctx, const floe_definition *d, double piece_area_limit, overlay *o, body_table *bodies,
                        shape_store *shapes, floe_table *floes, int32_t *next_number, int32_t *row, fram_error *error)
{
    polygon_moments plan = polygon_moments_of(d->outline);
    const char *fault = definition_fault(d, plan.area);
    if (fault)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "floe", "%s (area %g m2, thickness %g m)", fault, plan.area,
                         d->thickness);
    quat orientation = quat_from_roll_pitch_yaw(0, 0, d->yaw);
    int32_t shape = -1, slot = -1, at = free_row(ctx, floes);
    vec2_array outline = {0};
    fram_status status = FRAM_ERROR_MEMORY;
    if (at >= 0 && outline_to_body(ctx, d->outline, plan.centroid, quat_matrix(orientation), &outline))
        status = shape_add_prism(ctx, shapes, o, (polygon){outline.data, outline.count}, d->thickness / 2,
                                 piece_area_limit, &shape, error);
    else
        error_memory(error);
    polygon_moments body = polygon_moments_of((polygon){outline.data, outline.count});
    array_free(ctx, &outline);
    if (status != FRAM_OK)
        return status;
    slot = body_create(ctx, bodies, d->motion, MATERIAL_ICE);
    if (slot < 0) {
        shape_remove(shapes, shape);
        return error_memory(error);
    }
    bodies->position[slot] = (vec3){plan.centroid.x, plan.centroid.y, d->elevation};
    bodies->orientation[slot] = orientation;
    bodies->mass[slot] = d->material.density * plan.area * d->thickness;
    bodies->inertia[slot] = prism_inertia(body, d->thickness, d->material.density);
    bodies->shape[slot] = shape;
    bodies->owner[slot] = at;
    floes->body[at] = slot;
    table_row_taken(floes, at);
    floes->thickness[at] = d->thickness;
    floes->area[at] = plan.area;
    floes->material[at] = d->material;
    floes->breakable[at] = d->breakable;
    floes->parent[at] = d->parent;
    floes->tile[at] = d->tile;
    floes->retreat[at] = (vec3){0, 0, 0};
    floes->ice_origin[at] = vec2_add(d->ice_origin, turned_by(d->ice_yaw, plan.centroid));
    floes->ice_yaw[at] = d->ice_yaw + d->yaw;
    floes->number[at] = (*next_number)++;
    *row = at;
    return FRAM_OK;
}

void floe_remove(body_table *bodies, shape_store *shapes, floe_table *floes, int32_t row)
{
    int32_t slot = floes->body[row];
    shape_remove(shapes, bodies->shape[slot]);
    body_remove(bodies, slot);
    /* A free row is the same to the bit however it came to be free: the state's hash sees it. */
    floes->body[row] = -1;
    floes->thickness[row] = floes->area[row] = 0;
    floes->retreat[row] = (vec3){0, 0, 0};
    floes->ice_origin[row] = (vec2){0, 0};
    floes->ice_yaw[row] = 0;
    floes->material[row] = (ice_material){0};
    floes->breakable[row] = 0;
    floes->parent[row] = floes->number[row] = floes->tile[row] = 0;
    table_row_freed(floes, row);
}
