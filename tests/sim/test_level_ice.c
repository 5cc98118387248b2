/* Level ice in whole scenes: channels, ramming, crushed ice, brash, islands. */
#include "scene.h"

#include "base/pool.h"
#include "base/transcendental.h"

#include <stdio.h>
#include <stdlib.h>

enum { TEXT_SIZE = 4096 };

/* A driven icebreaker in front of a sheet that begins at x = 0. */
static const char *const SHIP = "run: {duration: 100, time_step: 0.02, scale: 30}\n"
                                "vessel:\n  mode: prescribed\n  x: -22\n  speed: 1\n"
                                "  hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3,\n"
                                "         stem_angle_deg: 30, entrance_angle_deg: 35, flare_angle_deg: 12,\n"
                                "         stern_angle_deg: 35, parallel_midbody: 0.4}\n"
                                "ice: {source: level, thickness: 0.5, breakable: true, level: {x_min: 0}}\n"
                                "domain: {x_min: -60, x_max: 90, y_min: -40, y_max: 40, boundary: open}\n";

static double ice_force(const scene *k) { return vec3_length(k->w.scratch.ice_loads.data[0].total.force); }

static double booked_mass(const scene *k)
{
    const clock_table *c = &k->w.clock;
    return c->ice_left[0] + c->ice_lost[0] - c->ice_gained[0] + c->ice_crushed[0] + c->brash_mass[0];
}

/* Plan extent across of the water that was cut out of the sheet at x. */
static double channel_width(const scene *k, double x)
{
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (double y = -39.95; y < 40; y += 0.1) {
        bool ice = false;
        for (int32_t i = 0; i < k->w.floes.count && !ice; i++) {
            int32_t body = k->w.floes.body[i];
            if (body < 0 || k->w.floes.tile[i] == 0)
                continue;
            vec3 at = k->w.bodies.position[body];
            polygon p = shape_outline(&k->w.shapes, k->w.bodies.shape[body]);
            ice = polygon_contains(p, (vec2){x - at.x, y - at.y});
        }
        if (ice)
            continue;
        lo = fmin(lo, y);
        hi = fmax(hi, y);
    }
    return hi - lo + 0.1;
}

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Median area of the floes that move. */
static double median_piece(const scene *k)
{
    static double area[4096];
    int count = 0;
    for (int32_t i = 0; i < k->w.floes.count && count < 4096; i++)
        if (k->w.floes.body[i] >= 0 && k->w.bodies.motion[k->w.floes.body[i]] == MOTION_DYNAMIC)
            area[count++] = k->w.floes.area[i];
    qsort(area, (size_t)count, sizeof *area, compare_numbers);
    return count > 0 ? area[count / 2] : 0;
}

/* The channel is as wide as the hull, and wider by less than a wedge is long on each side; pieces have the size of
   the wedges of that radius; the books close. */
START_TEST(a_channel_as_wide_as_the_hull)
{
    scene k;
    scene_open(&k, SHIP);
    double before = scene_ice_mass(&k), side = 0, sum = 0;
    int64_t breaks = 0;
    int steps = getenv("FRAM_TEST_SHORT") ? 1000 : 1500;
    for (int i = 0; i < steps; i++) {
        scene_steps(&k, 1);
        for (int32_t e = 0; e < k.w.scratch.fractures.count; e++) {
            const fracture_event *f = &k.w.scratch.fractures.data[e];
            if (f->kind != FRACTURE_BENDING || f->parent_area < 100)
                continue;
            side = fmax(side, f->crack_length / real_cos(PI / 6));
            sum += f->crack_length;
            breaks++;
        }
        assert_relative(scene_ice_mass(&k) + booked_mass(&k), before, 1e-12);
    }
    ck_assert_int_gt(breaks, 20);
    double end = k.w.bodies.position[k.w.vessels.body[0]].x;
    for (double x = 2; x < end - 12; x += 1) {
        double width = channel_width(&k, x);
        ck_assert_msg(width >= 10 - 2 * 0.15 && width <= 10 + 2 * side, "the channel is %g m wide at x = %g", width, x);
    }
    ck_assert(k.w.clock.ice_lost[0] < 0.005 * before);
    /* N = 3: triangles of 60 degrees and height R_bending, halves of them at the sides of a straight edge. */
    double mean = sum / (double)breaks, wedge = mean * mean * real_tan(PI / 6), piece = median_piece(&k);
    ck_assert_msg(piece > wedge / 4 && piece < 1.5 * wedge, "pieces of %g m2, wedges of %g m2", piece, wedge);
    scene_close(&k);
}
END_TEST

/* Ram, back off, return: nothing before the old face, and ice again at it. */
START_TEST(ram_back_off_return)
{
    for (int trims = getenv("FRAM_TEST_SHORT") ? 1 : 0; trims < 2; trims++) {
        const char *strong[] = {"ice.flexural_strength=1e9", trims ? "ice.crush_trims=true" : "ice.crush_trims=false",
                                "vessel.ramp=0"};
        scene k;
        scene_open_with(&k, SHIP, strong, 3);
        double before = scene_ice_mass(&k);
        int32_t hull = k.w.vessels.body[0];
        /* Into the edge by a few metres: the ice crushes and does not bend. */
        scene_steps(&k, 500);
        double face = k.w.bodies.position[hull].x;
        ck_assert(ice_force(&k) > 1e5);
        /* Back by 4 m, then forth again. */
        k.w.vessels.tow_velocity[0] = vec3_make(-1, 0, 0);
        scene_steps(&k, 200);
        ck_assert(ice_force(&k) < 1);
        k.w.vessels.tow_velocity[0] = vec3_make(1, 0, 0);
        double least = HUGE_VAL;
        for (int i = 0; i < 210; i++) {
            scene_steps(&k, 1);
            double way = k.w.bodies.position[hull].x - face;
            if (ice_force(&k) > 1 && way < least)
                least = way;
        }
        if (trims) {
            ck_assert_msg(fabs(least) < 0.15 + 0.04, "ice %g m from the old face", least);
            ck_assert(k.w.clock.ice_crushed[0] > 0);
        } else {
            ck_assert(least < -0.5);
        }
        assert_relative(scene_ice_mass(&k) + booked_mass(&k), before, 1e-12);
        scene_close(&k);
    }
}
END_TEST

/* A box that runs into a wall of ice and draws back slowly: cleaning gives nothing back of what was crushed, since it
   adds no more than a part of what was cut away. */
START_TEST(crushed_ice_is_never_less)
{
    scene k;
    scene_open(&k, "run: {duration: 10, time_step: 0.091287093, scale: 100}\n"
                   "vessel: {mode: free, speed: 3.832034, hull: {form: box, length: 160, beam: 40}}\n"
                   "ice: {source: level, mean_floe_area: 1197.660818713, thickness: 3.841864, level: {x_min: 100}}\n"
                   "domain: {x_min: -213.33333333333334, x_max: 213.33333333333334, y_min: -106.66666666666667,\n"
                   "         y_max: 106.66666666666667}\n");
    double mass = scene_ice_mass(&k), before = 0;
    for (int i = 0; i < 100; i++) {
        scene_steps(&k, 1);
        double crushed = k.w.clock.ice_crushed[0];
        ck_assert_msg(crushed >= before, "%.9g kg are crushed in step %d, %.9g before it", crushed, i, before);
        before = crushed;
    }
    ck_assert(before > 1e4);
    assert_absolute(k.w.clock.ice_gained[0], 0, 0.1 * before);
    assert_relative(scene_ice_mass(&k) + booked_mass(&k), mass, 1e-12);
    scene_close(&k);
}
END_TEST

/* What a pressing hull trims is nothing that carries: the load is the same with and without. */
START_TEST(trimming_keeps_the_load)
{
    scene k[2];
    const char *options[2][2] = {{"ice.flexural_strength=1e9", "ice.crush_trims=false"},
                                 {"ice.flexural_strength=1e9", "ice.crush_trims=true"}};
    for (int i = 0; i < 2; i++)
        scene_open_with(&k[i], SHIP, options[i], 2);
    double most = 0;
    for (int step = 0; step < 700; step++) {
        for (int i = 0; i < 2; i++)
            scene_steps(&k[i], 1);
        most = fmax(most, ice_force(&k[0]));
        if (ice_force(&k[0]) > 1e5)
            assert_relative(ice_force(&k[1]), ice_force(&k[0]), 0.01);
    }
    ck_assert_double_gt(most, 5e5);
    ck_assert(k[1].w.clock.ice_crushed[0] > 0);
    for (int i = 0; i < 2; i++)
        scene_close(&k[i]);
}
END_TEST

/* Vertices of the shapes that bodies have. */
static int32_t living_vertices(const scene *k)
{
    const shape_store *s = &k->w.shapes;
    int32_t sum = 0;
    for (int32_t i = 0; i < s->shapes.count; i++) {
        if (s->shapes.kind[i] != SHAPE_PRISM)
            continue;
        sum += s->shapes.outline_count[i];
        for (int32_t p = 0; p < s->shapes.piece_count[i] && s->shapes.piece_count[i] > 1; p++)
            sum += shape_piece(s, i, p).count;
    }
    return sum;
}

/* What breaking leaves behind in the shape store is squeezed out, in an open domain and between walls. */
START_TEST(dead_shapes_go)
{
    for (int walls = getenv("FRAM_TEST_SHORT") ? 1 : 0; walls < 2; walls++) {
        const char *options[] = {walls ? "domain.boundary=walls" : "domain.boundary=open", "vessel.speed=2"};
        scene k;
        scene_open_with(&k, SHIP, options, 2);
        for (int i = 0; i < 700; i++) {
            scene_steps(&k, 1);
            ck_assert_int_le(k.w.shapes.vertices.count, living_vertices(&k) + living_vertices(&k) / 4);
        }
        ck_assert_int_gt(k.w.clock.bendings[0], 20);
        scene_close(&k);
    }
}
END_TEST

/* The same bits on any number of threads: sheet, pieces, books and all. */
START_TEST(the_same_bits_on_any_threads)
{
    uint64_t first = 0;
    const int threads[] = {1, 2, 4};
    for (int i = 0; i < 3; i++) {
        scene k;
        scene_open_with(&k, SHIP, (const char *[]){"vessel.speed=2"}, 1);
        k.ctx.threads = pool_create(&k.ctx, threads[i]);
        ck_assert_ptr_nonnull(k.ctx.threads);
        scene_steps(&k, 500);
        ck_assert_int_gt(k.w.clock.bendings[0], 10);
        uint64_t hash = world_hash(&k.w);
        first = i == 0 ? hash : first;
        ck_assert_uint_eq(hash, first);
        pool_free(&k.ctx, k.ctx.threads);
        k.ctx.threads = NULL;
        scene_close(&k);
    }
}
END_TEST

/* Small pieces become brash: their mass and momentum are kept, nothing is lost. */
START_TEST(brash)
{
    scene k[2];
    const char *options[2][2] = {{"ice.smallest_floe_area=1.5", "ice.fracture.brash=false"},
                                 {"ice.smallest_floe_area=1.5", "ice.fracture.brash=true"}};
    for (int i = 0; i < 2; i++) {
        scene_open_with(&k[i], SHIP, options[i], 2);
        scene_steps(&k[i], 700);
    }
    ck_assert(k[0].w.clock.ice_lost[0] > 0);
    assert_bits(k[1].w.clock.brash_mass[0], k[0].w.clock.ice_lost[0]);
    assert_bits(k[1].w.clock.ice_lost[0], 0);
    assert_bits(k[0].w.clock.brash_mass[0], 0);
    for (int i = 0; i < 2; i++)
        scene_close(&k[i]);
}
END_TEST

/* Row of the floe that was this number, or of the largest that broke off it since; -1: there is none. */
static int32_t floe_or_largest_piece(const scene *k, int32_t number)
{
    int32_t best = -1;
    for (int32_t i = 0; i < k->w.floes.count; i++) {
        if (k->w.floes.body[i] < 0)
            continue;
        if (k->w.floes.number[i] == number)
            return i;
        if (k->w.floes.parent[i] == number && (best < 0 || k->w.floes.area[i] > k->w.floes.area[best]))
            best = i;
    }
    return best;
}

/* Two open channels and the ship's own cut a block out of the sheet: it drifts with the current, up to its speed and
   what pieces add that the ship presses aside (2 kN), until it meets the sheet on the other side of the channel.  The
   ship breaks more off it meanwhile. */
START_TEST(an_island_drifts)
{
    if (getenv("FRAM_TEST_SHORT"))
        return; /* thousands of steps of code that the other tests walk too */
    const char *text = "run: {duration: 100, time_step: 0.02, scale: 30}\n"
                       "vessel:\n  mode: prescribed\n  x: -22\n  speed: 2\n"
                       "  hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3,\n"
                       "         stem_angle_deg: 30, entrance_angle_deg: 35, flare_angle_deg: 12,\n"
                       "         stern_angle_deg: 35, parallel_midbody: 0.4}\n"
                       "environment: {current_speed: 0.5, current_direction_deg: 90}\n"
                       "ice:\n  source: level\n  thickness: 0.5\n  breakable: true\n"
                       "  level:\n    x_min: 0\n    anchored_x_min: false\n    openings:\n"
                       "      - {x: 20, y: 22, length: 50, width: 8}\n"
                       "      - {x: 40, y: 5, length: 8, width: 42}\n"
                       "domain: {x_min: -60, x_max: 90, y_min: -40, y_max: 40, boundary: open}\n";
    const double current = 0.5;
    scene k;
    scene_open(&k, text);
    int32_t island = -1;
    for (int i = 0; i < 2000 && island < 0; i++) {
        scene_steps(&k, 1);
        for (int32_t e = 0; e < k.w.scratch.fractures.count; e++)
            if (k.w.scratch.fractures.data[e].kind == FRACTURE_RELEASE &&
                k.w.scratch.fractures.data[e].parent_area > 100)
                island = k.w.scratch.fractures.data[e].first_piece;
    }
    ck_assert_int_ge(island, 0);
    double way = 0, most = 0;
    for (int i = 0; i < 650; i++) {
        int32_t row = floe_or_largest_piece(&k, island);
        ck_assert_int_ge(row, 0);
        island = k.w.floes.number[row];
        ck_assert(k.w.floes.area[row] > 300);
        int32_t body = k.w.floes.body[row];
        ck_assert_int_eq(k.w.bodies.motion[body], MOTION_DYNAMIC);
        double speed = k.w.bodies.velocity[body].y;
        ck_assert_msg(speed >= 0 && speed <= 1.1 * current, "it drifts at %g m/s after %d steps", speed, i);
        way += speed * 0.02;
        most = fmax(most, speed);
        scene_steps(&k, 1);
    }
    ck_assert_msg(most >= 0.85 * current, "it drifts at %g m/s at most", most);
    ck_assert_msg(way > 0.6 * current * 650 * 0.02, "it drifted by %g m", way);
    scene_close(&k);
}
END_TEST

/* The fixed cone of docs/oracles.md, 8: the horizontal load at which the sheet breaks first, and in the mean, 0.4
   to 1.2 times Croasdale's breaking term; pieces of the size of R_bending.  Pieces that lie on the sheet beside the
   cone press down what it lifts: of six starts one has a single load of 1.8 times that. */
START_TEST(fixed_cone)
{
    const char *text = "run: {duration: 100, time_step: 0.01, scale: 30}\n"
                       "vessel:\n  mode: prescribed\n  x: -4\n  speed: 0.5\n"
                       "  hull: {form: file, file: scenes/fixed_cone.obj}\n"
                       "ice:\n  source: level\n  thickness: 1\n  breakable: true\n  flexural_strength: 0.7e6\n"
                       "  elastic_modulus: 8e9\n  crushing_strength: 2e6\n  level: {x_min: 0}\n"
                       "  friction: {ice_hull_static: 0.15, ice_hull_kinetic: 0.15}\n"
                       "domain: {x_min: -30, x_max: 60, y_min: -40, y_max: 40, boundary: open}\n";
    const double breaking_term = 1.84414e6, slope = 2.5427; /* H_B [N]; F_H over F_V at 60 degrees and mu 0.15 */
    scene k;
    scene_open(&k, text);
    int breaks = 0, enough = getenv("FRAM_TEST_SHORT") ? 2 : 1000;
    double first = 0, sum = 0;
    for (int i = 0; i < 3500 && breaks < enough; i++) {
        scene_steps(&k, 1);
        for (int32_t n = 0; n < k.w.scratch.fractures.count; n++) {
            const fracture_event *e = &k.w.scratch.fractures.data[n];
            if (e->kind != FRACTURE_BENDING || e->parent_area < 200)
                continue;
            first = breaks++ > 0 ? first : slope * e->load;
            sum += slope * e->load;
            ck_assert(e->crack_length > 3 && e->crack_length < 9);
        }
    }
    ck_assert_int_ge(breaks, 2);
    ck_assert_msg(fmin(first, sum / breaks) > 0.4 * breaking_term &&
                      testing_larger(first, sum / breaks) < 1.2 * breaking_term,
                  "the sheet breaks at %g N first, at %g N in the mean", first, sum / breaks);
    scene_close(&k);
}
END_TEST

/* A sheet that nothing holds would stand where it is for ever: it is refused. */
START_TEST(a_sheet_is_held_somewhere)
{
    static const char *const none[] = {"ice.level.anchored_x_min=false", "ice.level.anchored_x_max=false",
                                       "ice.level.anchored_y_min=false", "ice.level.anchored_y_max=false"};
    check_refusal(SHIP, none, 4, "ice.level.anchored_x_min");
}
END_TEST

/* A sheet goes on beyond an open domain, and is held there: its tiles are no floes that have left. */
START_TEST(a_sheet_goes_on_beyond_the_domain)
{
    static const char *const wide[] = {"ice.level.x_max=300", "ice.level.y_min=-150", "ice.level.y_max=150",
                                       "ice.level.anchored_x_min=false"};
    scene k;
    scene_open_with(&k, SHIP, wide, 4);
    assert_relative(scene_ice_mass(&k), 300.0 * 300 * 0.5 * k.s.ice.density, 1e-3);
    double mass = scene_ice_mass(&k);
    scene_steps(&k, 2);
    ck_assert_double_eq(k.w.clock.ice_left[0], 0);
    ck_assert_double_eq(scene_ice_mass(&k), mass);
    scene_close(&k);
}
END_TEST

/* The sheet is open as far from a hull as the margin says, whichever way that heads, held or drifting. */
START_TEST(a_margin_is_as_wide_at_every_heading)
{
    static const char *const text = "run: {duration: 1}\n"
                                    "vessel: {mode: towed, hull: {form: box, length: 20, beam: 10, draught: 3}}\n"
                                    "ice: {source: level, thickness: 1, keep_out_margin: 2}\n"
                                    "domain: {x_min: -40, x_max: 40, y_min: -40, y_max: 40}\n";
    static const char *const boundary[] = {"domain.boundary=open", "domain.boundary=feeding"};
    static const char *const heading[] = {"vessel.heading_deg=0", "vessel.heading_deg=30", "vessel.heading_deg=45",
                                          "vessel.heading_deg=90"};
    const double straight = 20 * 10 + 2 * 60, arcs = 4 * PI, tangents = 4 * 8 * real_tan(PI / 8);
    for (int i = 0; i < 8; i++) {
        scene with, without;
        scene_open_with(&with, text, (const char *[]){boundary[i / 4], heading[i % 4]}, 2);
        scene_open_with(&without, text, (const char *[]){boundary[i / 4], "vessel.present=false"}, 2);
        double corners = (scene_ice_mass(&without) - scene_ice_mass(&with)) / with.s.ice.density - straight;
        /* For the arc round a corner stand two tangents at least. */
        ck_assert_msg(corners >= arcs - 1e-6 && corners <= tangents + 1e-6,
                      "%g m2 are open round the corners with %s, %g within arcs", corners, heading[i % 4], arcs);
        scene_close(&with);
        scene_close(&without);
    }
}
END_TEST

/* A seam of tiles leaves slivers of contact that give way until rounding is left of them: with them this solver's
   velocities were no numbers, at which a step fails. */
START_TEST(slivers_on_seams_carry_nothing)
{
    const char *text = "run: {duration: 11, time_step: 0.02, solver: {kind: sequential}}\n"
                       "vessel: {mode: towed, y: -512, speed: 1, hull: {length: 40, beam: 12, draught: 4}}\n"
                       "ice:\n  source: level\n  thickness: 0.4\n  breakable: true\n"
                       "  level: {openings: [{x: 0, y: -512, length: 50, width: 20}]}\n"
                       "domain: {boundary: walls, x_min: -60, x_max: 80, y_min: -600, y_max: 600}\n";
    scene k;
    scene_open(&k, text);
    scene_steps(&k, 550);
    ck_assert(ice_force(&k) > 0);
    scene_close(&k);
}
END_TEST

TEST_MAIN("level_ice", a_sheet_is_held_somewhere, a_sheet_goes_on_beyond_the_domain,
          a_margin_is_as_wide_at_every_heading, slivers_on_seams_carry_nothing, a_channel_as_wide_as_the_hull,
          ram_back_off_return, crushed_ice_is_never_less, trimming_keeps_the_load, dead_shapes_go,
          the_same_bits_on_any_threads, brash, an_island_drifts, fixed_cone)
