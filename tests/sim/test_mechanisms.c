/* The split of an ice load by mechanism (docs/theory.md): one scene for each mechanism in which the normal load must be
   its alone, chains of floes with known forces, and the sum in every scene that comes with Fram. */
#include "scene.h"

#include "sim/force_chain.h"
#include "sim/peak_watch.h"

#include <stdio.h>
#include <stdlib.h>

static const ice_load *load_of(const scene *k) { return &k->w.scratch.ice_loads.data[0]; }

/* Force and moment of the largest load so far on each vessel [N], [N m]. */
enum { VESSELS_MOST = 4 };
typedef struct peaks {
    double force[VESSELS_MOST], moment[VESSELS_MOST];
} peaks;

/* The load but for friction, as seen by its mechanisms alone. */
static double normal_load(const scene *k)
{
    double sum = 0;
    for (int i = 0; i < MECHANISM_COUNT; i++)
        sum += i == MECHANISM_FRICTION ? 0 : vec3_length(load_of(k)->mechanism[i].force);
    return sum;
}

static double share_of(const scene *k, ice_mechanism m)
{
    double all = normal_load(k);
    return all > 0 ? vec3_length(load_of(k)->mechanism[m].force) / all : 0;
}

/* The mechanisms add up to the load, force and moment apart, in each axis, to 1e-9 of its peak. */
static void assert_sum_of(const ice_load *l, double *peak_force, double *peak_moment)
{
    wrench sum = {0};
    for (int i = 0; i < MECHANISM_COUNT; i++) {
        sum.force = vec3_add(sum.force, l->mechanism[i].force);
        sum.moment = vec3_add(sum.moment, l->mechanism[i].moment);
    }
    *peak_force = fmax(*peak_force, vec3_length(l->total.force));
    *peak_moment = fmax(*peak_moment, vec3_length(l->total.moment));
    assert_vec3_close(sum.force, l->total.force, 1e-9 * *peak_force);
    assert_vec3_close(sum.moment, l->total.moment, 1e-9 * *peak_moment);
    assert_vec3_close(l->mechanism[MECHANISM_FRICTION].force, l->friction.force, 1e-9 * *peak_force);
}

/* Of every vessel. */
static void assert_sum(const scene *k, peaks *p)
{
    ck_assert(k->w.scratch.ice_loads.count <= VESSELS_MOST);
    for (int v = 0; v < k->w.scratch.ice_loads.count; v++)
        assert_sum_of(&k->w.scratch.ice_loads.data[v], &p->force[v], &p->moment[v]);
}

#define BOX "  hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}\n"
#define SEA "domain: {boundary: open, x_min: -200, x_max: 200, y_min: -100, y_max: 100}\n"

/* A floe that lies under a flat bottom presses up with its buoyancy, and rubs: nothing else. */
START_TEST(held_under_a_flat_bottom)
{
    scene k;
    scene_open(&k, "run: {duration: 100, time_step: 0.01}\nvessel:\n  mode: prescribed\n  speed: 0.2\n" BOX SEA
                   "ice:\n  source: floes\n  thickness: 0.5\n  floes: [{x: 60, y: 0, length: 6, width: 4}]\n");
    int32_t floe = scene_floe(&k, 0);
    k.w.bodies.position[floe] = vec3_make(0, 0, -4.25);
    peaks peak = {0};
    double buoyancy = (k.m.media.water_density - 920) * 9.81 * 6 * 4 * 0.5;
    double mean = 0;
    for (int i = 0; i < 500; i++) {
        scene_steps(&k, 1);
        assert_sum(&k, &peak);
        if (i < 200)
            continue;
        mean += load_of(&k)->mechanism[MECHANISM_SUBMERSION].force.z / 300;
        ck_assert_msg(share_of(&k, MECHANISM_SUBMERSION) > 1 - 1e-12 || normal_load(&k) == 0,
                      "step %d: %g of the load is of submersion", i, share_of(&k, MECHANISM_SUBMERSION));
    }
    assert_relative(mean, buoyancy, 1e-3);
    ck_assert(load_of(&k)->mechanism[MECHANISM_FRICTION].force.x < 0);
    static force_chain chain;
    ck_assert(contact_web_make(&k.ctx, &k.w));
    force_chain_follow(&k.w, k.m.time_step, k.w.vessels.body[0], floe, &chain);
    ck_assert(chain.count == 1 && chain.end == CHAIN_WATER);
    assert_relative(chain.link[0].water, vec3_length(chain.link[0].push), 0.1);
    assert_absolute(chain.link[0].others, 0, 1e-9);
    scene_close(&k);
}
END_TEST

/* A vertical plate in a sheet that does not break crushes it. */
START_TEST(plate_that_crushes)
{
    for (int breakable = 0; breakable < 2; breakable++) {
        scene k;
        const char *options[] = {breakable ? "ice.breakable=true" : "ice.breakable=false"};
        scene_open_with(&k,
                        "run: {duration: 100, time_step: 0.01}\n"
                        "vessel:\n  mode: prescribed\n  x: -21.1\n  speed: 0.5\n" BOX SEA
                        "ice: {source: level, thickness: 0.5, level: {x_min: 0}}\n",
                        options, 1);
        peaks peak = {0};
        for (int i = 0; i < 280; i++) {
            scene_steps(&k, 1);
            assert_sum(&k, &peak);
        }
        assert_relative(vec3_length(load_of(&k)->mechanism[MECHANISM_CRUSHING].force), 2e6 * 20 * 0.5, 0.02);
        assert_absolute(share_of(&k, MECHANISM_CRUSHING), 1, 1e-12);
        scene_close(&k);
    }
}
END_TEST

/* A sloping bow in a sheet: bending and friction alone until the first break, and other mechanisms after it. */
START_TEST(bow_up_to_the_break)
{
    scene k;
    scene_open(&k, "run: {duration: 100, time_step: 0.01}\nvessel:\n  mode: prescribed\n  x: -20.5\n  speed: 1\n"
                   "  hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3, stem_angle_deg: 30,\n"
                   "    entrance_angle_deg: 35, flare_angle_deg: 12, stern_angle_deg: 35, parallel_midbody: 0.4}\n" SEA
                   "ice: {source: level, thickness: 0.5, breakable: true, level: {x_min: 0}}\n");
    peaks peak = {0};
    int loaded = 0, others = 0;
    for (int i = 0; i < 1500; i++) {
        bool broken = k.w.clock.bendings[0] > 0;
        scene_steps(&k, 1);
        assert_sum(&k, &peak);
        if (!broken && normal_load(&k) > 0) {
            loaded++;
            assert_absolute(share_of(&k, MECHANISM_BENDING), 1, 1e-12);
        }
        others += broken && share_of(&k, MECHANISM_SUBMERSION) + share_of(&k, MECHANISM_CRUSHING) > 0.5;
    }
    ck_assert_msg(loaded > 5 && others > 50, "%d steps before the break, %d with other loads after", loaded, others);
    ck_assert(k.w.clock.bendings[0] > 0);
    scene_close(&k);
}
END_TEST

/* One floe that nothing holds: its momentum is the whole load. */
START_TEST(free_floe_that_is_hit)
{
    scene k;
    scene_open(&k, "run: {duration: 100, time_step: 0.01}\nvessel:\n  mode: prescribed\n  speed: 1\n" BOX SEA
                   "ice:\n  source: floes\n  thickness: 1\n  crushing_strength: 1e9\n"
                   "  floes: [{x: 25.05, y: 0, length: 10, width: 10}]\n");
    int32_t floe = scene_floe(&k, 0);
    double impulse = 0, mass = k.w.bodies.mass[floe];
    peaks peak = {0};
    for (int i = 0; i < 10; i++) {
        double before = k.w.bodies.velocity[floe].x;
        scene_steps(&k, 1);
        assert_sum(&k, &peak);
        double step = -load_of(&k)->mechanism[MECHANISM_IMPACT].force.x * 0.01;
        impulse += step;
        if (normal_load(&k) > 0 && k.w.bodies.velocity[floe].x - before > 0.5)
            assert_absolute(share_of(&k, MECHANISM_IMPACT), 1, 1e-12);
    }
    /* Of 92 t the water's response adds some; the load is not less than the floe's momentum. */
    ck_assert_msg(impulse >= 0.95 * mass && impulse < 1.6 * mass, "%g of %g", impulse, mass);
    scene_close(&k);
}
END_TEST

/* A piece that has come into the slot of the last floe since is not what was pushed. */
static void check_that_pieces_are_no_links(scene *k, int floes)
{
    static peak_detail d;
    peak_watch watch;
    fram_error error = {0};
    int32_t last = scene_floe(k, floes - 1);
    peak_watch_init(&k->ctx, k->m.time_step, 0, &watch);
    assert_ok(peak_watch_keep(&watch, &k->w, &error), error);
    for (int gone = 0; gone < 2; gone++) {
        k->w.bodies.generation[last] += (uint32_t)gone;
        assert_ok(peak_watch_explain(&watch, &k->w, 0, &d, &error), error);
        int left_out = floes + 1 > PEAK_CHAIN_LINKS ? floes + 1 - PEAK_CHAIN_LINKS : 0, end = floes - 1 - left_out;
        ck_assert_int_eq(d.link_count, floes + 1 - left_out);
        ck_assert_int_eq(d.floe[0].left_out, left_out);
        ck_assert_int_eq(d.floe[0].end, CHAIN_WALL);
        for (int i = 0; i < end; i++)
            ck_assert_int_eq(d.link[i].number, i < PEAK_CHAIN_FIRST ? i : i + left_out);
        ck_assert_int_eq(d.link[end].number, gone ? -1 : floes - 1);
        assert_absolute(d.link[end].place.x, 24 + 8 * (floes - 1) - (gone ? 4 : 0), 0.1);
    }
    k->w.bodies.generation[last]--;
    peak_watch_free(&watch);
}

/* k floes in a row between a hull that is pushed by a known force and a wall: the chain is found, each link bears that
   force, and it ends at the wall.  With open water in place of the wall they are an accumulation. */
static void push_row(int floes, bool wall)
{
    enum { TEXT = 3000 };
    char text[TEXT];
    int at = snprintf(text, TEXT,
                      "run: {duration: 100, time_step: 0.01}\nvessel:\n  mode: free\n"
                      "  hydrodynamics: {source: none}\n" BOX
                      "domain: {boundary: %s, x_min: -60, x_max: %g, y_min: -40, y_max: 40}\n"
                      "ice:\n  source: floes\n  thickness: 1\n  crushing_strength: 1e9\n  floes:\n",
                      wall ? "walls" : "open", 20 + 8 * floes + (wall ? 0.01 : 100));
    for (int i = 0; i < floes; i++)
        at += snprintf(text + at, (size_t)(TEXT - at), "    - {x: %g, y: 0, length: 8, width: 8}\n", 24.005 + 8 * i);
    scene k;
    scene_open(&k, text);
    peaks peak = {0};
    const double push = 2e5;
    fram_error error = {0};
    for (int i = 0; i < (wall ? 600 : 100); i++) {
        const wrench load = {.force = {push, 0, 0}};
        assert_ok(world_add_wrench(&k.ctx, &k.w, k.w.vessels.body[0], load, &error), error);
        scene_steps(&k, 1);
        assert_sum(&k, &peak);
    }
    ck_assert(contact_web_make(&k.ctx, &k.w));
    static force_chain chain, end;
    force_chain_follow(&k.w, k.m.time_step, k.w.vessels.body[0], scene_floe(&k, 0), &chain);
    force_chain_end(&k.w, k.m.time_step, k.w.vessels.body[0], scene_floe(&k, 0), &end);
    ck_assert(end.count == chain.count && end.end == chain.end);
    assert_vec3_close(end.link[0].push, chain.link[0].push, 0);
    if (wall) {
        ck_assert_int_eq(chain.count, floes + 1);
        ck_assert_int_eq(chain.end, CHAIN_WALL);
        for (int i = 0; i <= floes; i++) {
            ck_assert(i == floes || chain.link[i].body == scene_floe(&k, i));
            assert_relative(chain.link[i].push.x, push, 0.02);
        }
        assert_absolute(share_of(&k, MECHANISM_CHAIN), 1, 1e-12);
        /* The wall is pushed where the last floe touches it. */
        assert_absolute(chain.link[floes].point.x, 20 + 8 * floes, 0.1);
        assert_absolute(chain.link[floes].point.y, 0, 4);
        check_that_pieces_are_no_links(&k, floes);
        /* A floe of a sheet that drifts as one body holds like a wall. */
        k.w.bodies.motion[scene_floe(&k, floes - 1)] = MOTION_CARRIED;
        force_chain_follow(&k.w, k.m.time_step, k.w.vessels.body[0], scene_floe(&k, 0), &chain);
        ck_assert(chain.count == floes && chain.end == CHAIN_DRIVEN);
    } else {
        /* Each link has what is left to accelerate before it. */
        ck_assert(chain.count > 1 && (chain.end == CHAIN_INERTIA || chain.end == CHAIN_WATER));
        for (int i = 1; i < chain.count; i++)
            ck_assert(chain.link[i].push.x < chain.link[i - 1].push.x);
        assert_absolute(share_of(&k, MECHANISM_ACCUMULATION), 1, 1e-12);
    }
    scene_close(&k);
}

START_TEST(rows_of_floes)
{
    push_row(1, true);
    push_row(2, true);
    push_row(5, true);
    push_row(13, true);
    push_row(30, true);
    push_row(4, false);
}
END_TEST

/* In the step in which a floe splits, the normal load on it is of splitting. */
START_TEST(floe_that_splits)
{
    scene k;
    scene_open(&k, "run: {duration: 100, time_step: 0.01}\nvessel:\n  mode: prescribed\n  speed: 1\n  x: -26\n"
                   "  hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3, stem_angle_deg: 30,\n"
                   "    entrance_angle_deg: 35, flare_angle_deg: 12, stern_angle_deg: 35, parallel_midbody: 0.4}\n" SEA
                   "ice:\n  source: floes\n  thickness: 0.3\n  breakable: true\n"
                   "  floes: [{x: 10, y: 0, length: 4, width: 10}]\n");
    peaks peak = {0};
    int split = 0;
    for (int i = 0; i < 2000 && split < 1; i++) {
        scene_steps(&k, 1);
        assert_sum(&k, &peak);
        split = (int)k.w.clock.splits[0];
        if (split == 1)
            assert_absolute(share_of(&k, MECHANISM_SPLITTING), 1, 1e-12);
        else
            ck_assert(share_of(&k, MECHANISM_SPLITTING) == 0);
    }
    ck_assert_int_eq(split, 1);
    scene_close(&k);
}
END_TEST

/* Every scene that comes with Fram, its first steps; FRAM_TEST_LONG: far enough that all of them meet their ice. */
START_TEST(ready_scenes)
{
    static const char *const names[] = {"conical_unit",
                                        "demo",
                                        "drillship",
                                        "drillship_circle",
                                        "fixed_cone",
                                        "free_vessel",
                                        "level_ice",
                                        "managed_ice",
                                        "drillship_one_icebreaker",
                                        "drillship_two_icebreakers",
                                        "escort",
                                        "packed_field",
                                        "real_input",
                                        "supply_ship",
                                        "three_vessels",
                                        "turret_ship",
                                        "uikku_303"};
    bool all = getenv("FRAM_TEST_LONG") != NULL;
    int met = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[80];
        scene k = {0};
        fram_error error = {0};
        if (!all && strcmp(names[i], "packed_field") == 0)
            continue;
        snprintf(path, sizeof path, "scenes/%s.yaml", names[i]);
        context_init(&k.ctx);
        assert_ok(scenario_read(&k.ctx, path, NULL, &k.s, &error), error);
        assert_ok(scene_build(&k.ctx, &k.s, &k.m, &k.w, &error), error);
        peaks peak = {0};
        /* These two reach their ice soon, with few floes. */
        bool near = strcmp(names[i], "level_ice") == 0 || strcmp(names[i], "fixed_cone") == 0;
        for (int step = 0; step < (all ? 2000 : near ? 640 : 10); step++) {
            scene_steps(&k, 1);
            assert_sum(&k, &peak);
        }
        met += peak.force[0] > 0;
        scene_close(&k);
    }
    ck_assert_msg(met >= (all ? 10 : 2), "%d scenes with ice loads", met);
}
END_TEST

TEST_MAIN("mechanisms", held_under_a_flat_bottom, plate_that_crushes, bow_up_to_the_break, free_floe_that_is_hit,
          rows_of_floes, floe_that_splits, ready_scenes)
