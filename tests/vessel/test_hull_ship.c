/* The hull of a ship of full form: closed and convex, displacement in closed form, the block coefficient that was asked
   for, refusals. */
#include "base/transcendental.h"
#include "hull_memory.h"
#include "testing.h"
#include "vessel/hull.h"

typedef struct built {
    mesh surface;
    polyhedron_array pieces;
    hull_hydrostatics floats;
} built;

static hull_particulars ship(double block)
{
    double usual = (double)NAN;
    return (hull_particulars){.form = HULL_SHIP,
                              .length = 220,
                              .beam = 42,
                              .draught = 12,
                              .freeboard = 7,
                              .stem_angle = usual,
                              .entrance_angle = usual,
                              .flare_angle = usual,
                              .stern_angle = usual,
                              .parallel_midbody = usual,
                              .block_coefficient = block,
                              .bilge_radius = usual,
                              .transom = usual};
}

static built build(context *ctx, hull_particulars p)
{
    built h = {0};
    fram_error error = {0};
    hull_particulars_fill(&p);
    assert_ok(hull_make(ctx, &p, &h.surface, &h.pieces, &error), error);
    assert_ok(hull_hydrostatics_at(ctx, &h.surface, 0, &h.floats, &error), error);
    return h;
}

static void free_built(context *ctx, built *h)
{
    polyhedron_array_free(ctx, &h->pieces);
    mesh_free(ctx, &h->surface);
}

/* Closed, turned outward, of the waterline asked for, and as large as its one convex piece: so convex. */
static void check_sound(context *ctx, const built *h, const hull_particulars *p)
{
    mesh_report report;
    ck_assert_int_eq(mesh_check(ctx, &h->surface, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "defect %d: %s", (int)report.defect, report.text);
    vec3 whole = mesh_volume_integrals(&h->surface);
    ck_assert_int_eq(h->pieces.count, 1);
    assert_relative(polyhedron_volume(&h->pieces.data[0]), whole.x, 1e-9);
    assert_relative(whole.x, whole.z, 1e-12);
    ck_assert(whole.z > 0);
    assert_absolute(h->floats.waterline.hi.x, 0.5 * p->length, 1e-9);
    assert_absolute(h->floats.waterline.lo.x, -0.5 * p->length, 1e-9);
    assert_absolute(h->floats.waterline.hi.y, 0.5 * p->beam, 1e-9);
    assert_absolute(h->floats.waterline.lo.y, -0.5 * p->beam, 1e-9);
    assert_absolute(h->floats.centre_of_buoyancy.y, 0, 1e-9);
    ck_assert_int_le(h->surface.vertex.count, 252);
}

static double block_of(const built *h, const hull_particulars *p)
{
    return h->floats.volume / (p->length * p->beam * p->draught);
}

/* Upright ends, no bilge, half of the length parallel: the waterline's area over the draught.  Of a parabola the
   polygon through equal steps of 1/8 leaves 2/3 - 1/(6 64); the run goes from half the beam to all of it. */
START_TEST(displacement_in_closed_form)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = ship(0);
    p.stem_angle = p.stern_angle = radians(90);
    p.bilge_radius = 0;
    p.parallel_midbody = 0.5;
    built h = build(&ctx, p);
    check_sound(&ctx, &h, &p);
    double full = 2.0 / 3 - 1.0 / 384, run = 110 / 1.6, entrance = 110 - run;
    double area = 42 * (110 + full * entrance + (0.5 + 0.5 * full) * run);
    assert_relative(h.floats.waterplane_area, area, 1e-12);
    assert_relative(h.floats.volume, 12 * area, 1e-12);
    free_built(&ctx, &h);

    /* With a rake the water plane stays, and the parallel body gets shorter below. */
    p.stem_angle = radians(60);
    p.stern_angle = radians(40);
    h = build(&ctx, p);
    check_sound(&ctx, &h, &p);
    double shorter = 12 / real_tan(radians(60)) + 12 / real_tan(radians(40));
    assert_relative(h.floats.waterplane_area, area, 1e-12);
    assert_relative(h.floats.volume, 12 * area - 0.5 * 12 * 42 * shorter, 1e-12);
    free_built(&ctx, &h);
}
END_TEST

/* Amidships the bilge takes two corners, each of a square less a quarter of a polygon of twenty corners. */
START_TEST(section_amidships)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = ship(0.85);
    p.bilge_radius = 3;
    built h = build(&ctx, p);
    check_sound(&ctx, &h, &p);
    polygon_list rings = {0};
    fram_error error = {0};
    double breadth = 0;
    assert_ok(mesh_section(&ctx, &h.surface, -12 + 3 - 3 * real_cos(radians(36)), &rings, &error), error);
    box2 box = polygon_bounds(polygon_list_get(&rings, 0));
    breadth = box.hi.y - box.lo.y;
    assert_absolute(breadth, 42 - 2 * 3 * (1 - real_sin(radians(36))), 1e-9);
    polygon_list_free(&ctx, &rings);
    free_built(&ctx, &h);
}
END_TEST

/* To rounding, over the range of tankers, FPSOs and drillships, with every free choice taken once. */
START_TEST(block_coefficient_is_met)
{
    static const double size[][3] = {{220, 42, 12}, {320, 60, 21}, {180, 36, 9}, {330, 58, 24}, {120, 22, 8}};
    static const double blocks[] = {0.7, 0.75, 0.8, 0.85, 0.9};
    context ctx;
    context_init(&ctx);
    for (int k = 0; k < 5; k++)
        for (int i = 0; i < 5; i++) {
            hull_particulars p = ship(blocks[i]);
            p.length = size[k][0];
            p.beam = size[k][1];
            p.draught = size[k][2];
            p.transom = i == 2 ? 0 : p.transom;
            p.entrance_angle = i == 3 ? radians(70) : p.entrance_angle;
            built h = build(&ctx, p);
            check_sound(&ctx, &h, &p);
            assert_absolute(block_of(&h, &p), blocks[i], 1e-9);
            free_built(&ctx, &h);
        }
    hull_particulars p = ship(0.82);
    p.parallel_midbody = 0.55;
    built h = build(&ctx, p);
    assert_absolute(block_of(&h, &p), 0.82, 1e-9);
    free_built(&ctx, &h);
}
END_TEST

/* The stem stands as asked, and the waterline opens by the angle asked for. */
START_TEST(stem_and_entrance)
{
    context ctx;
    context_init(&ctx);
    hull_particulars p = ship(0.84);
    p.stem_angle = radians(50);
    p.entrance_angle = radians(65);
    built h = build(&ctx, p);
    polygon_list rings = {0};
    fram_error error = {0};
    assert_ok(mesh_section(&ctx, &h.surface, 0, &rings, &error), error);
    polygon ring = polygon_list_get(&rings, 0);
    vec2 second = {-HUGE_VAL, 0};
    for (int32_t i = 0; i < ring.count; i++)
        if (ring.vertex[i].y > 1e-6 && ring.vertex[i].x > second.x)
            second = ring.vertex[i];
    assert_relative(second.y / (110 - second.x), real_tan(radians(65)), 1e-9);
    assert_absolute(mesh_bounds(&h.surface).hi.x, 110 + 7 / real_tan(radians(50)), 1e-9);
    polygon_list_free(&ctx, &rings);
    free_built(&ctx, &h);

    /* Results split the load at the ends of the parallel body. */
    hull_particulars_fill(&p);
    p.block_coefficient = 0;
    p.parallel_midbody = 0.3;
    hull_zones zones = hull_zones_of(&p);
    assert_absolute(zones.bow, 110 - 0.7 * 220 * 0.6 / 1.6, 1e-9);
    assert_absolute(zones.stern, -110 + 0.7 * 220 / 1.6, 1e-9);
}
END_TEST

START_TEST(refusals)
{
    static const struct {
        const char *key, *words;
        double block, stem_deg, entrance_deg, flare_deg, parallel, bilge, transom;
    } bad[] = {
        {"block_coefficient", "can be 0.", 0.99, NAN, NAN, NAN, NAN, NAN, NAN},
        {"block_coefficient", "can be 0.", 0.3, NAN, NAN, NAN, NAN, NAN, NAN},
        {"block_coefficient", "parallel_midbody", 0.95, NAN, NAN, NAN, 0.5, NAN, NAN},
        {"stem_angle", "at most 90", 0.8, 95, NAN, NAN, NAN, NAN, NAN},
        {"entrance_angle", "at most 85", 0.8, NAN, 88, NAN, NAN, NAN, NAN},
        {"flare_angle", "upright", 0.8, NAN, NAN, 8, NAN, NAN, NAN},
        {"parallel_midbody", "can be", 0.8, NAN, NAN, NAN, 0.99, NAN, NAN},
        {"bilge_radius", "0.95 of the draught", 0.8, NAN, NAN, NAN, NAN, 12, NAN},
        {"transom", "narrower than the bilges", 0.8, NAN, NAN, NAN, NAN, 5, 0.1},
        {"transom", "share of the beam", 0.8, NAN, NAN, NAN, NAN, NAN, 1},
        {"length", "enlarge length, or the angle of stem or stern", 0.8, 3, NAN, NAN, NAN, NAN, NAN},
        {"length", "enlarge length or the angle of entrance", 0.8, NAN, 12, NAN, NAN, NAN, NAN},
        {"length", "the angle of stem, stern or entrance", 0.8, 10, 20, NAN, NAN, NAN, NAN},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        hull_particulars p = ship(bad[i].block);
        p.stem_angle = radians(bad[i].stem_deg);
        p.entrance_angle = radians(bad[i].entrance_deg);
        p.flare_angle = radians(bad[i].flare_deg);
        p.parallel_midbody = bad[i].parallel;
        p.bilge_radius = bad[i].bilge;
        p.transom = bad[i].transom;
        hull_particulars_fill(&p);
        fram_error error = {0};
        assert_fails(hull_particulars_check(&p, &error), error, FRAM_ERROR_INPUT, bad[i].words);
        ck_assert_str_eq(error.key, bad[i].key);
    }
}
END_TEST

START_TEST(memory_runs_out) { hull_make_without_memory(ship(0.8)); }
END_TEST

TEST_MAIN("hull_ship", displacement_in_closed_form, section_amidships, block_coefficient_is_met, stem_and_entrance,
          refusals, memory_runs_out)
