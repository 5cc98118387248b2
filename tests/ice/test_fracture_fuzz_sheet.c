/* Fuzzed level ice: sheets of random tiles, openings, thresholds and wedges, bitten at random and along channels, with
   loads on corners, seams and crossings.  FRAM_FUZZ_EVENTS sets the number of events, FRAM_FUZZ_SEED the seed. */
#include "sheet_rig.h"

#include <stdio.h>
#include <stdlib.h>

static long number_from(const char *name, long otherwise)
{
    const char *text = getenv(name);
    return text && *text ? strtol(text, NULL, 10) : otherwise;
}

static void random_openings(context *ctx, random_stream *s, box2 plan, polygon_list *out)
{
    int count = (int)random_uniform(s, 0, 3);
    polygon_list_clear(out);
    for (int i = 0; i < count; i++) {
        double x = random_uniform(s, plan.lo.x, plan.hi.x), y = random_uniform(s, plan.lo.y, plan.hi.y);
        double size = random_power_law(s, 0.5, 20, 0), turn = random_uniform(s, 0, PI);
        vec2 ring[4];
        for (int k = 0; k < 4; k++) {
            double angle = turn + PI / 2 * k + 0.5 * random_unit(s);
            ring[k] = (vec2){x + size * real_cos(angle), y + 0.3 * size * real_sin(angle)};
        }
        polygon p = {ring, 4};
        if (polygon_area(p) > 0 && !polygon_self_intersects(ctx, p, NULL, NULL))
            ck_assert(polygon_list_push(ctx, out, p));
    }
}

/* Sizes of everything beside one another: tiles of half a breaking radius to ten, least areas up to a square metre.
   false: an opening leaves a tile without a convex part of the least area, which no run begins with. */
static bool random_sheet(fracture_rig *r, random_stream *s, box2 plan)
{
    polygon_list openings = {0};
    fram_error e = {0};
    r->settings.wedges = 2 + (int32_t)random_uniform(s, 0, 6);
    r->settings.sharing = random_unit(s) < 0.5 ? SHARING_WIDTH : SHARING_EQUAL;
    r->settings.wide_contacts = random_unit(s) < 0.5;
    r->settings.joint_loads = random_unit(s) < 0.5;
    r->settings.edge_threshold = random_unit(s) < 0.2 ? 0 : random_power_law(s, 0.01, 0.3, 0);
    r->settings.smallest_floe_area = random_power_law(s, 0.02, 1, 0);
    r->settings.smallest_piece_area = r->settings.smallest_floe_area * random_power_law(s, 0.01, 1, 0);
    random_openings(&r->ctx, s, plan, &openings);
    bool good = sheet_try(r, plan, random_power_law(s, 2, 40, 0), &openings, &e);
    for (int i = 0; i < SHEET_SIDES; i++)
        r->settings.tiles.anchored[i] = random_unit(s) < 0.6;
    r->settings.radius_along = random_unit(s) < 0.7 ? RADIUS_ALONG_AXES : RADIUS_ALONG_CRACKS;
    polygon_list_free(&r->ctx, &openings);
    return good;
}

/* A corner or an edge of a tile, or anywhere. */
static vec2 random_place(const fracture_rig *r, random_stream *s, box2 plan)
{
    vec2 any = {random_uniform(s, plan.lo.x, plan.hi.x), random_uniform(s, plan.lo.y, plan.hi.y)};
    int32_t row = sheet_tile_at(r, any);
    if (row < 0 || random_unit(s) < 0.3)
        return any;
    polygon p = fracture_rig_outline(r, row);
    int32_t i = (int32_t)random_uniform(s, 0, p.count);
    vec3 at = r->bodies.position[r->floes.body[row]];
    vec2 a = p.vertex[i], b = p.vertex[(i + 1) % p.count];
    vec2 on = random_unit(s) < 0.4 ? a : vec2_add(a, vec2_scale(vec2_sub(b, a), random_unit(s)));
    return (vec2){at.x + on.x, at.y + on.y};
}

/* Corners within 1e-9 of a tile's size of a seam are put on it, which no book has: as much times the edges beside them.
 */
static void check_events(const fracture_rig *r, double before)
{
    box2 cell = tile_cell(&r->settings.tiles, 0);
    double lost = 0, snap = 1e-9 * (cell.hi.x - cell.lo.x + cell.hi.y - cell.lo.y);
    for (int32_t i = 0; i < r->events.count; i++) {
        const fracture_event *e = &r->events.data[i];
        assert_absolute(e->parent_area, e->piece_area + e->area_lost - e->area_gained,
                        1e-9 * e->parent_area + snap * sqrt(e->parent_area));
        ck_assert(e->kind == FRACTURE_RELEASE || e->area_lost + e->area_gained <= 1e-3 * e->parent_area * (1 + 1e-9));
        lost += e->area_lost - e->area_gained;
    }
    assert_absolute(fracture_rig_area(r), before - lost, 1e-7);
}

START_TEST(fuzzed_bites)
{
    const box2 plan = {{-20, -15}, {20, 15}};
    long wanted = number_from("FRAM_FUZZ_EVENTS", 4500), seed = number_from("FRAM_FUZZ_SEED", 1), events = 0,
         releases = 0, refused = 0;
    fracture_rig r;
    fracture_rig_make(&r);
    for (uint32_t id = 0; events < wanted; id++) {
        random_stream s = random_begin((uint64_t)seed, 2, id);
        fracture_rig_remove_all(&r);
        if (!random_sheet(&r, &s, plan)) {
            refused++;
            continue;
        }
        for (int turn = 0; turn < 40 && sheet_count(&r, true) > 0; turn++) {
            double before = fracture_rig_area(&r);
            int loads = 1 + (int)random_uniform(&s, 0, 2.5);
            for (int i = 0; i < loads; i++) {
                ck_assert(sheet_load(&r, random_place(&r, &s, plan), 1e7, random_power_law(&s, 1e-3, 8, 0)));
                vec2 half = {random_uniform(&s, -6, 6), random_uniform(&s, -6, 6)};
                ck_assert(!r.settings.wide_contacts || fracture_rig_widen(&r, half));
            }
            events += fracture_rig_break(&r);
            for (int32_t i = 0; i < r.events.count; i++)
                releases += r.events.data[i].kind == FRACTURE_RELEASE;
            check_events(&r, before);
            sheet_clear_pieces(&r);
        }
    }
    printf("%ld events, %ld of them releases; %ld sheets refused\n", events, releases, refused);
    ck_assert_int_le(refused, 1 + wanted / 1000);
    ck_assert_int_gt(releases, 5);
    fracture_rig_free(&r);
}
END_TEST

/* ---- the search from what changed, against that of the whole sheet ---- */

static uint64_t sheet_hash(const fracture_rig *r)
{
    uint64_t hash = table_hash(&r->bodies, &body_table_info, 1);
    hash = table_hash(&r->floes, &floe_table_info, hash);
    hash = table_hash(&r->shapes.shapes, &shape_table_info, hash);
    hash = table_hash(&r->shapes.pieces, &piece_table_info, hash);
    return table_hash(&r->shapes.vertices, &shape_vertex_table_info, hash);
}

/* The next place of a channel that goes round, or of bites anywhere. */
static vec2 next_bite(const fracture_rig *r, random_stream *s, box2 plan, bool round, vec2 centre, double radius,
                      int turn)
{
    if (!round || random_unit(s) < 0.1)
        return random_place(r, s, plan);
    double angle = turn * 1.2 / radius;
    return (vec2){centre.x + radius * real_cos(angle), centre.y + radius * real_sin(angle)};
}

/* The same bites on two sheets, of which one forgets before each that all of its tiles hung on something. */
START_TEST(a_search_from_a_change_finds_what_the_whole_one_does)
{
    const box2 plan = {{-40, -30}, {40, 30}};
    long sheets = getenv("FRAM_TEST_SHORT") ? 8 : 30, releases = 0, large = 0;
    fracture_rig r[2];
    for (int k = 0; k < 2; k++)
        fracture_rig_make(&r[k]);
    for (uint32_t id = 0; id < sheets; id++) {
        random_stream s = random_begin(7, 5, id), again = s;
        for (int k = 0; k < 2; k++)
            fracture_rig_remove_all(&r[k]);
        if (!random_sheet(&r[0], &s, plan) || !random_sheet(&r[1], &again, plan))
            continue;
        bool round = random_unit(&s) < 0.6;
        vec2 centre = {random_uniform(&s, -40, 40), random_uniform(&s, -30, 30)};
        double radius = random_uniform(&s, 5, 25);
        for (int turn = 0; turn < 150 && sheet_count(&r[0], true) > 0; turn++) {
            vec2 place = next_bite(&r[0], &s, plan, round, centre, radius, turn);
            double area = random_power_law(&s, 1e-2, 8, 0);
            fracture_scratch_forget(r[1].scratch);
            for (int k = 0; k < 2; k++) {
                ck_assert(sheet_load(&r[k], place, 1e7, area));
                fracture_rig_break(&r[k]);
            }
            ck_assert_uint_eq(sheet_hash(&r[0]), sheet_hash(&r[1]));
            for (int32_t i = 0; i < r[0].events.count; i++) {
                const fracture_event *e = &r[0].events.data[i];
                releases += e->kind == FRACTURE_RELEASE;
                large += e->kind == FRACTURE_RELEASE && e->parent_area > 100;
            }
            for (int k = 0; k < 2; k++)
                sheet_clear_pieces(&r[k]);
        }
    }
    printf("%ld releases, %ld of more than 100 m2\n", releases, large);
    ck_assert(releases > 20 && large > 2);
    for (int k = 0; k < 2; k++)
        fracture_rig_free(&r[k]);
}
END_TEST

TEST_MAIN("fracture_fuzz_sheet", fuzzed_bites, a_search_from_a_change_finds_what_the_whole_one_does)
