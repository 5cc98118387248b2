/* The reference's area of a patch, from the section with the floe's top plane; see patch.h. */
#include "ice/patch_parts.h"

/* Signed area of a simple ring inside a convex piece: clipping by half planes may leave edges that run to and fro,
   whose areas cancel. */
static bool ring_area_in_piece(context *ctx, patch_scratch *s, polygon ring, const piece_sides *piece, double *area)
{
    polygon rest = ring;
    for (int32_t k = 0; k < piece->count && rest.count > 0; k++) {
        half_space side = piece_side(piece, k);
        if (!polygon_clip_half_plane(ctx, rest, (vec2){side.n.x, side.n.y}, side.d, &s->ring_b))
            return false;
        vec2_array swap = s->ring_a;
        s->ring_a = s->ring_b;
        s->ring_b = swap;
        rest = (polygon){s->ring_a.data, s->ring_a.count};
    }
    *area = rest.count >= 3 ? polygon_area(rest) : 0;
    return true;
}

fram_status patch_top_area(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe,
                           double *area, fram_error *error)
{
    *area = 0;
    if (!mesh_copy(ctx, &s->turned, surface->surface))
        return error_memory(error);
    for (int32_t i = 0; i < s->turned.vertex.count; i++)
        s->turned.vertex.data[i] = to_floe(surface, s->turned.vertex.data[i]);
    polygon_list_clear(&s->section);
    fram_status status = mesh_section(ctx, &s->turned, half_height_of(floe), &s->section, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < polygon_list_count(&s->section); i++)
        for (int32_t p = 0; p < piece_count_of(floe); p++) {
            piece_sides piece = sides_of(floe, p);
            double inside;
            if (!ring_area_in_piece(ctx, s, polygon_list_get(&s->section, i), &piece, &inside))
                return error_memory(error);
            *area += inside;
        }
    return FRAM_OK;
}
