/* Generated hulls: closed, exactly of the given particulars, convex pieces that fill them, zones. */
#include "samples.h"
#include "vessel/hull_plan.h"

typedef struct hull {
    mesh surface;
    polyhedron_array pieces;
} hull;

static hull make_hull(context *ctx, const hull_particulars *p)
{
    hull h = {0};
    fram_error error = {0};
    assert_ok(hull_make(ctx, p, &h.surface, &h.pieces, &error), error);
    return h;
}

static void check_solid(context *ctx, const hull *h, double volume)
{
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, &h->surface, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "defect %d: %s", (int)report.defect, report.text);
    vec3 integrals = mesh_volume_integrals(&h->surface);
    assert_relative(integrals.x, volume, 1e-12);
    assert_relative(integrals.y, volume, 1e-12);
    assert_relative(integrals.z, volume, 1e-12);
    double pieces = 0;
    for (int32_t i = 0; i < h->pieces.count; i++)
        pieces += polyhedron_volume(&h->pieces.data[i]);
    assert_relative(pieces, volume, 1e-12);
    for (int32_t i = 0; i < h->surface.vertex.count; i++)
        ck_assert(polyhedron_contains(&h->pieces.data[0], h->surface.vertex.data[i], 1e-9));
}

START_TEST(box)
{
    context ctx;
    context_init(&ctx);
    hull h = make_hull(&ctx, &box_particulars);
    check_solid(&ctx, &h, 40 * 12 * 7);
    box3 bounds = mesh_bounds(&h.surface);
    assert_vec3_close(bounds.lo, vec3_make(-20, -6, -4), 0);
    assert_vec3_close(bounds.hi, vec3_make(20, 6, 3), 0);
    free_hull(&ctx, &h.surface, &h.pieces);
}
END_TEST

/* Area of the section at height z, a quadratic: hexagon of half beam b between stem, shoulders and stern. */
static double section_area(const hull_particulars *p, double z)
{
    double b = 0.5 * p->beam + z * real_tan(p->flare_angle), entrance = b / real_tan(p->entrance_angle);
    double run_length = p->length * (1 - p->parallel_midbody) - 0.5 * p->beam / real_tan(p->entrance_angle);
    double run = b * run_length / (0.5 * p->beam);
    double whole = p->length + z / real_tan(p->stem_angle) + z / real_tan(p->stern_angle);
    return b * (2 * whole - entrance - run);
}

/* Simpson's rule is exact. */
static double section_volume(const hull_particulars *p, double low, double high)
{
    return (high - low) / 6 * (section_area(p, low) + 4 * section_area(p, 0.5 * (low + high)) + section_area(p, high));
}

START_TEST(icebreaker)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    hull h = make_hull(&ctx, &p);
    check_solid(&ctx, &h, section_volume(&p, -p.draught, p.freeboard));
    ck_assert_int_eq(h.pieces.count, 1);
    /* Keel, deck, and port and starboard of bow, side and stern. */
    ck_assert_int_eq(h.pieces.data[0].face.count, 8);

    /* The stem at keel and deck, the flare of the sides, the rake of the stern. */
    box3 bounds = mesh_bounds(&h.surface);
    assert_absolute(bounds.hi.x, 50 + 4 / real_tan(p.stem_angle), 1e-12);
    assert_absolute(bounds.lo.x, -50 - 4 / real_tan(p.stern_angle), 1e-12);
    assert_absolute(bounds.hi.y, 10 + 4 * real_tan(p.flare_angle), 1e-12);
    assert_absolute(bounds.lo.y, -bounds.hi.y, 0);
    free_hull(&ctx, &h.surface, &h.pieces);
}
END_TEST

/* The waterline has the given length, beam, entrance and parallel body. */
START_TEST(icebreaker_waterline)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    hull h = make_hull(&ctx, &p);
    polygon_list rings = {0};
    fram_error error = {0};
    assert_ok(mesh_section(&ctx, &h.surface, 0, &rings, &error), error);
    ck_assert_int_eq(polygon_list_count(&rings), 1);
    polygon ring = polygon_list_get(&rings, 0);
    box2 bounds = polygon_bounds(ring);
    assert_absolute(bounds.lo.x, -50, 1e-12);
    assert_absolute(bounds.hi.x, 50, 1e-12);
    assert_absolute(bounds.lo.y, -10, 1e-12);
    assert_absolute(bounds.hi.y, 10, 1e-12);
    double entrance = 10 / real_tan(p.entrance_angle), widest[2] = {HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < ring.count; i++)
        if (ring.vertex[i].y > 10 - 1e-9) {
            widest[0] = fmin(widest[0], ring.vertex[i].x);
            widest[1] = fmax(widest[1], ring.vertex[i].x);
        }
    assert_absolute(widest[1], 50 - entrance, 1e-12);
    assert_absolute(widest[1] - widest[0], 45, 1e-12);
    assert_relative(polygon_area(ring), section_area(&p, 0), 1e-14);
    polygon_list_free(&ctx, &rings);
    free_hull(&ctx, &h.surface, &h.pieces);
}
END_TEST

/* Upright planes all around make a box of an icebreaker; a bow without a run has a transom. */
START_TEST(icebreaker_limits)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    p.stem_angle = p.entrance_angle = p.stern_angle = PI / 2;
    p.flare_angle = 0;
    p.parallel_midbody = 1;
    hull h = make_hull(&ctx, &p);
    check_solid(&ctx, &h, 100 * 20 * 11);
    ck_assert_int_eq(h.pieces.data[0].face.count, 6);
    free_hull(&ctx, &h.surface, &h.pieces);

    p = icebreaker_particulars();
    p.parallel_midbody = 1 - 0.1 / real_tan(p.entrance_angle);
    h = make_hull(&ctx, &p);
    check_solid(&ctx, &h, section_volume(&p, -7, 4));
    ck_assert_int_eq(h.pieces.data[0].face.count, 7);
    free_hull(&ctx, &h.surface, &h.pieces);
}
END_TEST

/* Whether triangle j is triangle i in the mirror of the centre plane, with the other turn. */
static bool mirrors(const mesh *m, int32_t i, int32_t j)
{
    for (int turn = 0; turn < 3; turn++) {
        int same = 0;
        for (int k = 0; k < 3; k++) {
            vec3 a = m->vertex.data[m->face.data[i].v[k]], b = m->vertex.data[m->face.data[j].v[(3 + turn - k) % 3]];
            same += testing_same_bits(a.x, b.x) && testing_close(a.y, -b.y, 0) && testing_same_bits(a.z, b.z);
        }
        if (same == 3)
            return true;
    }
    return false;
}

/* Every triangle to port has its mirror image to starboard, so that a symmetric load stays symmetric. */
START_TEST(port_mirrors_starboard)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = icebreaker_particulars();
    hull h = make_hull(&ctx, &p);
    for (int32_t i = 0; i < h.surface.face.count; i++) {
        int found = 0;
        for (int32_t j = 0; j < h.surface.face.count; j++)
            found += mirrors(&h.surface, i, j);
        ck_assert_int_eq(found, 1);
    }
    free_hull(&ctx, &h.surface, &h.pieces);
}
END_TEST

START_TEST(wrong_particulars)
{
    context ctx;
    context_init(&ctx);
    const struct {
        const char *key, *part;
        size_t member;
        double value;
    } cases[] = {
        {"length", "positive number of metres", offsetof(hull_particulars, length), 0},
        {"beam", "found -20", offsetof(hull_particulars, beam), -20},
        {"draught", "positive", offsetof(hull_particulars, draught), HUGE_VAL},
        {"freeboard", "positive", offsetof(hull_particulars, freeboard), 0},
        {"stem_angle", "at most 90 degrees, found 100", offsetof(hull_particulars, stem_angle), radians(100)},
        {"entrance_angle", "found 0", offsetof(hull_particulars, entrance_angle), 0},
        {"stern_angle", "over 0", offsetof(hull_particulars, stern_angle), -1},
        {"flare_angle", "between -90 and 90", offsetof(hull_particulars, flare_angle), 2},
        {"flare_angle", "no breadth is left at the keel", offsetof(hull_particulars, flare_angle), radians(60)},
        {"flare_angle", "no breadth is left at the deck", offsetof(hull_particulars, flare_angle), radians(-75)},
        {"parallel_midbody", "at most 1", offsetof(hull_particulars, parallel_midbody), 1.5},
        {"parallel_midbody", "no parallel body is left at the keel", offsetof(hull_particulars, stem_angle),
         radians(7)},
        {"entrance_angle", "do not fit into a length of 100 m", offsetof(hull_particulars, entrance_angle), radians(8)},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        hull_particulars p = icebreaker_particulars();
        memcpy((char *)&p + cases[i].member, &cases[i].value, sizeof(double));
        hull h = {0};
        fram_error error = {0};
        assert_fails(hull_make(&ctx, &p, &h.surface, &h.pieces, &error), error, FRAM_ERROR_INPUT, cases[i].part);
        ck_assert_str_eq(error.key, cases[i].key);
        ck_assert_int_eq(h.surface.vertex.count + h.pieces.count, 0);
    }
    hull_particulars p = {.form = HULL_MESH, .length = 10, .beam = 2, .draught = 1};
    hull h = {0};
    fram_error error = {0};
    assert_ok(hull_particulars_check(&p, &error), error);
    assert_fails(hull_make(&ctx, &p, &h.surface, &h.pieces, &error), error, FRAM_ERROR_INPUT, "mesh file");
    ck_assert_str_eq(error.key, "form");
}
END_TEST

START_TEST(memory_runs_out)
{
    const hull_particulars forms[2] = {box_particulars, icebreaker_particulars()};
    for (int k = 0; k < 2; k++)
        for (failing_turn turn = {0}; failing_next(&turn);) {
            hull h = {0};
            turn.status = hull_make(&turn.ctx, &forms[k], &h.surface, &h.pieces, &turn.error);
            if (turn.status != FRAM_OK)
                ck_assert_int_eq(h.surface.vertex.count + h.pieces.count, 0);
            free_hull(&turn.ctx, &h.surface, &h.pieces);
        }
}
END_TEST

START_TEST(zones)
{
    hull_particulars p = icebreaker_particulars();
    hull_zones z = hull_zones_of(&p);
    double entrance = 10 / real_tan(p.entrance_angle), run_length = 55 - entrance;
    const struct {
        vec3 point;
        hull_zone zone;
    } cases[] = {
        {{50 - entrance + 0.01, 3, 0}, ZONE_BOW},
        {{50 - entrance - 0.01, 9, 0}, ZONE_SHOULDER},
        {{40 - entrance + 0.01, 9, -1}, ZONE_SHOULDER},
        {{40 - entrance - 0.01, 9, -1}, ZONE_MIDBODY},
        {{-50 + run_length + 0.01, 9, 0}, ZONE_MIDBODY},
        {{-50 + run_length - 0.01, 9, 0}, ZONE_STERN},
        {{48, 0, -6.66}, ZONE_BOTTOM},
        {{48, 0, -6.64}, ZONE_BOW},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        ck_assert_int_eq(hull_zone_at(&z, cases[i].point), cases[i].zone);
    /* The faces of a box are its bow and stern. */
    z = hull_zones_of(&box_particulars);
    ck_assert_int_eq(hull_zone_at(&z, vec3_make(20, 1, 0)), ZONE_BOW);
    ck_assert_int_eq(hull_zone_at(&z, vec3_make(-20, 1, 0)), ZONE_STERN);
    ck_assert_int_eq(hull_zone_at(&z, vec3_make(0, 6, 0)), ZONE_MIDBODY);
    z = hull_zones_of(&(hull_particulars){.form = HULL_MESH, .length = 100, .beam = 20, .draught = 5});
    ck_assert_int_eq(hull_zone_at(&z, vec3_make(31, 0, 0)), ZONE_BOW);
}
END_TEST

/* Squares of 2 m, `apart` from each other. */
static bool add_squares(context *ctx, polygon_list *out, int across, double apart)
{
    bool good = true;
    for (int i = 0; i < across * across && good; i++) {
        double x = (2 + apart) * (i % across), y = (2 + apart) * (i / across);
        good =
            polygon_list_push(ctx, out, (polygon){(const vec2[]){{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}}, 4});
    }
    return good;
}

/* Parts of a plan that overlap, touch and stand alone, as one by one; and so many that these would take a minute. */
START_TEST(parts_of_a_plan_are_united_where_they_lie_together)
{
    enum { MANY = 60 };
    static const double apart[] = {-0.5, 0, 1e-12, 0.5};
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    overlay *plane = overlay_create(&ctx);
    for (size_t i = 0; i < sizeof apart / sizeof *apart; i++) {
        polygon_list parts = {0}, together = {0}, expected = {0};
        /* One of other parts, before and behind them in the order of places. */
        const vec2 other[3] = {{-5, 0.5}, {-4, 0.25}, {-4.5, 1}}, bridge[3] = {{1, 1}, {3.5, 1.25}, {1, 1.5}};
        ck_assert(add_squares(&ctx, &parts, 3, apart[i]) && polygon_list_push(&ctx, &parts, (polygon){other, 3}) &&
                  polygon_list_push(&ctx, &parts, (polygon){bridge, 3}));
        assert_ok(overlay_union(plane, &parts, &expected, &error), error);
        assert_ok(hull_plan_unite(&ctx, plane, &parts, &together, &error), error);
        ck_assert_int_eq(polygon_list_count(&together), apart[i] > 1e-3 ? 9 : polygon_list_count(&expected));
        ck_assert_int_eq(together.vertex.count, expected.vertex.count);
        ck_assert_mem_eq(together.vertex.data, expected.vertex.data,
                         (size_t)expected.vertex.count * sizeof *expected.vertex.data);
        polygon_list_free(&ctx, &parts);
        polygon_list_free(&ctx, &together);
        polygon_list_free(&ctx, &expected);
    }
    polygon_list parts = {0}, together = {0};
    ck_assert(add_squares(&ctx, &parts, MANY, 1));
    assert_ok(hull_plan_unite(&ctx, plane, &parts, &together, &error), error);
    ck_assert_int_eq(polygon_list_count(&together), MANY * MANY);
    polygon_list_free(&ctx, &parts);
    polygon_list_free(&ctx, &together);
    overlay_free(plane);
}
END_TEST

/* Each remedy that is named where the ends leave nothing of keel or deck makes a hull, by itself. */
START_TEST(remedies_for_lost_parallel_bodies_help)
{
    const struct {
        const char *name;
        double draught, freeboard, flare, rake;
        struct {
            const char *key;
            size_t member;
            double value;
        } remedy[5];
    } ends[2] = {{"the deck",
                  5,
                  8,
                  45,
                  60,
                  {{"reduce freeboard, ", offsetof(hull_particulars, freeboard), 4},
                   {" the flare or", offsetof(hull_particulars, flare_angle), radians(20)},
                   {"the angle of stem or", offsetof(hull_particulars, stem_angle), radians(40)},
                   {" or stern, or", offsetof(hull_particulars, stern_angle), radians(40)},
                   {"enlarge parallel_midbody (0.4)", offsetof(hull_particulars, parallel_midbody), 0.5}}},
                 {"the keel",
                  14,
                  3,
                  8,
                  45,
                  {{"the angle of stem or", offsetof(hull_particulars, stem_angle), radians(70)},
                   {" or stern, reduce", offsetof(hull_particulars, stern_angle), radians(70)},
                   {"enlarge the flare or", offsetof(hull_particulars, flare_angle), radians(25)},
                   {" reduce draught, ", offsetof(hull_particulars, draught), 10},
                   {"enlarge parallel_midbody (0.4)", offsetof(hull_particulars, parallel_midbody), 0.7}}}};
    for (int i = 0; i < 2; i++) {
        hull_particulars p = {.form = HULL_ICEBREAKER,
                              .length = i ? 40 : 60,
                              .beam = 16,
                              .draught = ends[i].draught,
                              .freeboard = ends[i].freeboard,
                              .stem_angle = radians(ends[i].rake),
                              .entrance_angle = radians(i ? 45 : 25),
                              .flare_angle = radians(ends[i].flare),
                              .stern_angle = radians(ends[i].rake),
                              .parallel_midbody = 0.4};
        fram_error error = {0}, none = {0};
        assert_fails(hull_particulars_check(&p, &error), error, FRAM_ERROR_INPUT, ends[i].name);
        for (int k = 0; k < 5; k++) {
            hull_particulars q = p;
            ck_assert_msg(strstr(error.message, ends[i].remedy[k].key) != NULL, "%s", error.message);
            memcpy((char *)&q + ends[i].remedy[k].member, &ends[i].remedy[k].value, sizeof(double));
            ck_assert_msg(hull_particulars_check(&q, &none) == FRAM_OK, "%s: %s", ends[i].remedy[k].key, none.message);
        }
    }
}
END_TEST

TEST_MAIN("hull", remedies_for_lost_parallel_bodies_help, box, icebreaker, icebreaker_waterline, icebreaker_limits,
          port_mirrors_starboard, wrong_particulars, memory_runs_out, zones,
          parts_of_a_plan_are_united_where_they_lie_together)
