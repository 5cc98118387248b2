/* Seams, boundary and anchored sides of a sheet of tiles, counted by hand. */
#include "sheet_rig.h"

static const double LOAD = 1e7, AREA = 1;

static void push_box(fracture_rig *r, polygon_list *openings, vec2 lo, vec2 hi)
{
    const vec2 corner[4] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
    ck_assert(polygon_list_push(&r->ctx, openings, (polygon){corner, 4}));
}

/* Two tiles share what both have of the line between them: the left one lacks its lowest 5 m there, the right one its
   highest 7 m of 20. */
START_TEST(tiles_share_what_both_have_of_a_line)
{
    fracture_rig r;
    fracture_rig_make(&r);
    polygon_list openings = {0};
    push_box(&r, &openings, (vec2){15, -1}, (vec2){20, 5});
    push_box(&r, &openings, (vec2){20, 13}, (vec2){25, 21});
    sheet_make(&r, (box2){{0, 0}, {60, 20}}, 20, &openings);
    tile_index index = sheet_index(&r);
    tile_sheet_view v = sheet_view(&r, &index);
    int32_t left = sheet_tile_at(&r, (vec2){5, 10}), middle = sheet_tile_at(&r, (vec2){30, 10}),
            right = sheet_tile_at(&r, (vec2){55, 10});
    assert_absolute(tile_seam(&v, left, middle), 20 - 5 - 7, 1e-12);
    assert_absolute(tile_seam(&v, middle, left), 20 - 5 - 7, 1e-12);
    assert_absolute(tile_seam(&v, middle, right), 20, 1e-12);
    assert_absolute(tile_seam(&v, left, right), 0, 0);
    tile_index_free(&r.ctx, &index);
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
}
END_TEST

static bool is_ice(const fracture_rig *r, vec2 place)
{
    bool inside = false;
    for (int32_t i = 0; i < r->floes.count; i++) {
        vec3 at = r->bodies.position[r->floes.body[i]];
        inside = inside || polygon_contains(fracture_rig_outline(r, i), (vec2){place.x - at.x, place.y - at.y});
    }
    return inside;
}

/* On the left of each part of the boundary is ice, on its right is none; its normal points into the ice. */
START_TEST(the_boundary_faces_the_ice)
{
    const double near = 0.01;
    fracture_rig r;
    fracture_rig_make(&r);
    polygon_list openings = {0};
    const vec2 hole[3] = {{11, 12}, {49, 17}, {30, 34}};
    ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){hole, 3}));
    sheet_make(&r, (box2){{0, 0}, {60, 45}}, 15, &openings);
    tile_index index = sheet_index(&r);
    tile_sheet_view v = sheet_view(&r, &index);
    tile_segment_array segments = {0};
    ck_assert(tile_boundary(&r.ctx, &v, (tile_range){0, 3, 0, 2}, &segments));
    ck_assert_int_ge(segments.count, 14 + 3);
    for (int32_t i = 0; i < segments.count; i++) {
        const tile_segment *s = &segments.data[i];
        vec2 way = vec2_sub(s->b, s->a), middle = vec2_scale(vec2_add(s->a, s->b), 0.5);
        assert_absolute(vec2_length(s->normal), 1, 1e-14);
        assert_absolute(vec2_cross(way, s->normal), vec2_length(way), 1e-12);
        ck_assert(is_ice(&r, vec2_add(middle, vec2_scale(s->normal, near))));
        ck_assert(!is_ice(&r, vec2_sub(middle, vec2_scale(s->normal, near))));
    }
    array_free(&r.ctx, &segments);
    tile_index_free(&r.ctx, &index);
    polygon_list_free(&r.ctx, &openings);
    fracture_rig_free(&r);
}
END_TEST

/* Seams and the cuts by which tiles are divided around holes are none of it, whatever the tiles. */
START_TEST(the_boundary_is_as_long_as_it_is)
{
    static const double SIZES[] = {100, 50, 26, 15};
    for (int i = 0; i < 4; i++) {
        fracture_rig r;
        fracture_rig_make(&r);
        polygon_list openings = {0};
        const vec2 hole[3] = {{11, 12}, {49, 17}, {30, 34}};
        ck_assert(polygon_list_push(&r.ctx, &openings, (polygon){hole, 3}));
        push_box(&r, &openings, (vec2){50, 30}, (vec2){55, 40});
        sheet_make(&r, (box2){{0, 0}, {60, 45}}, SIZES[i], &openings);
        tile_index index = sheet_index(&r);
        tile_sheet_view v = sheet_view(&r, &index);
        tile_segment_array segments = {0};
        const tile_grid *g = &r.settings.tiles;
        ck_assert(tile_boundary(&r.ctx, &v, (tile_range){0, g->columns - 1, 0, g->rows - 1}, &segments));
        double length = 2 * (60 + 45) + 30, sum = 0;
        for (int k = 0; k < 3; k++)
            length += vec2_length(vec2_sub(hole[(k + 1) % 3], hole[k]));
        for (int32_t k = 0; k < segments.count; k++)
            sum += vec2_length(vec2_sub(segments.data[k].b, segments.data[k].a));
        assert_relative(sum, length, 1e-9);
        array_free(&r.ctx, &segments);
        tile_index_free(&r.ctx, &index);
        polygon_list_free(&r.ctx, &openings);
        fracture_rig_free(&r);
    }
}
END_TEST

static vec2 turned(vec2 v, int quarters)
{
    for (int i = 0; i < quarters; i++)
        v = (vec2){-v.y, v.x};
    return v;
}

static void push_turned_box(fracture_rig *r, polygon_list *openings, box2 box, int quarters)
{
    vec2 a = turned(box.lo, quarters), b = turned(box.hi, quarters);
    push_box(r, openings, (vec2){fmin(a.x, b.x), fmin(a.y, b.y)}, (vec2){fmax(a.x, b.x), fmax(a.y, b.y)});
}

/* A sheet that hangs on one side by a neck of 3 m drifts once the neck is bitten off, whichever side that is, though
   all that is left of it holds together; held on the other sides too, it stays. */
START_TEST(what_hung_on_a_neck_drifts)
{
    static const sheet_side HELD[4] = {SHEET_Y_MAX, SHEET_X_MIN, SHEET_Y_MIN, SHEET_X_MAX};
    for (int i = 0; i < 8; i++) {
        int quarters = i % 4;
        fracture_rig r;
        fracture_rig_make(&r);
        polygon_list openings = {0};
        push_turned_box(&r, &openings, (box2){{-21, 18}, {-1.5, 21}}, quarters);
        push_turned_box(&r, &openings, (box2){{1.5, 18}, {21, 21}}, quarters);
        sheet_make(&r, (box2){{-20, -20}, {20, 20}}, 40, &openings);
        for (int k = 0; k < SHEET_SIDES; k++)
            r.settings.tiles.anchored[k] = i >= 4 || k == (int)HELD[quarters];
        ck_assert_int_eq(sheet_count(&r, true), 1);
        ck_assert(sheet_load(&r, turned((vec2){-1.5, 19}, quarters), LOAD, AREA));
        ck_assert_int_eq(fracture_rig_break(&r), i < 4 ? 2 : 1);
        ck_assert_int_eq(r.events.data[0].kind, FRACTURE_BENDING);
        if (i < 4)
            ck_assert_int_eq(r.events.data[1].kind, FRACTURE_RELEASE);
        ck_assert_int_eq(sheet_count(&r, true), i < 4 ? 0 : 1);
        polygon_list_free(&r.ctx, &openings);
        fracture_rig_free(&r);
    }
}
END_TEST

TEST_MAIN("tiles", tiles_share_what_both_have_of_a_line, the_boundary_faces_the_ice, the_boundary_is_as_long_as_it_is,
          what_hung_on_a_neck_drifts)
