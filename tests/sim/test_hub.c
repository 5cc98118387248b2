/* A vessel between many floes, which the solver treats as a hub: the same bits on any threads and instruction set, and
   it moves as its contacts push. */
#include "scene.h"

#include "base/pool.h"
#include "dynamics/solver_batch.h"
#include "sim/ice_loads.h"

#include <stdio.h>

enum { TEXT_SIZE = 1 << 14, FLOES_A_SIDE = 24, STEPS = 12 };

/* A free box of 100 x 20 m without water, and on each of its long sides a row of floes that run against it, those on
   one side faster, and faster towards its bow. */
static void write_scene(char text[TEXT_SIZE])
{
    int at = snprintf(text, TEXT_SIZE,
                      "run: {time_step: 0.02, duration: 10}\n"
                      "vessel:\n  mode: free\n  hull: {form: box, length: 100, beam: 20, draught: 5, freeboard: 3}\n"
                      "environment: {water: false}\n"
                      "domain: {boundary: open, x_min: -100, x_max: 100, y_min: -60, y_max: 60}\n"
                      "ice:\n  source: floes\n  thickness: 1\n  floes:\n");
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < FLOES_A_SIDE; i++) {
            double speed = (side < 0 ? 1.5 : 1) + 0.02 * i;
            at += snprintf(text + at, (size_t)(TEXT_SIZE - at),
                           "    - {x: %g, y: %g, length: 3.9, width: 6, velocity_x: %g, velocity_y: %g}\n",
                           -46.0 + 4 * i, side * 13.005, 0.1 * (i % 3), -side * speed);
            ck_assert_int_lt(at, TEXT_SIZE);
        }
}

static int touched_floes(const world *w, int32_t vessel)
{
    int count = 0;
    for (int32_t i = 0; i < w->floes.count; i++) {
        bool touches = false;
        for (int32_t k = 0; k < w->scratch.contacts.count && !touches; k++) {
            const contact *c = &w->scratch.contacts.data[k];
            touches =
                c->impulse[0] > 0 && c->a + c->b == vessel + w->floes.body[i] && (c->a == vessel || c->b == vessel);
        }
        count += touches;
    }
    return count;
}

static bool is_hub(scene *k, int32_t body)
{
    batch_plan plan = {0};
    ck_assert(batch_plan_make(&k->ctx, &plan, &k->w.bodies, &k->w.scratch.contacts));
    bool found = false;
    for (int32_t i = 0; i < plan.hubs.count; i++)
        found = found || plan.hubs.data[i] == body;
    batch_plan_free(&k->ctx, &plan);
    return found;
}

/* The state after some steps; at least 20 floes push on the vessel, and it is a hub, in the one before the last. */
static uint64_t hash_of(const char *text, int threads, isa set)
{
    scene k;
    scene_open(&k, text);
    k.ctx.isa = set;
    k.ctx.threads = threads > 1 ? pool_create(&k.ctx, threads) : NULL;
    int32_t vessel = k.w.vessels.body[0];
    scene_steps(&k, 2);
    int touched = touched_floes(&k.w, vessel);
    ck_assert_msg(touched >= 40, "%d floes touch the vessel", touched);
    ck_assert(is_hub(&k, vessel));
    scene_steps(&k, STEPS);
    uint64_t hash = world_hash(&k.w);
    pool_free(&k.ctx, k.ctx.threads);
    k.ctx.threads = NULL;
    scene_close(&k);
    return hash;
}

START_TEST(bits_depend_on_neither_threads_nor_instruction_set)
{
    char text[TEXT_SIZE];
    write_scene(text);
    uint64_t first = hash_of(text, 1, ISA_BASELINE);
    for (isa set = ISA_BASELINE; set <= isa_best(); set++)
        for (int threads = 1; threads <= 4; threads *= 2)
            ck_assert_msg(hash_of(text, threads, set) == first, "%s, %d threads", isa_name(set), threads);
}
END_TEST

/* Nothing else acts on it: the vessel's momentum changes by what is told of the ice's load, in each step. */
START_TEST(the_vessel_moves_as_its_contacts_push)
{
    char text[TEXT_SIZE];
    write_scene(text);
    scene k;
    scene_open(&k, text);
    int32_t vessel = k.w.vessels.body[0];
    double mass = k.w.bodies.mass[vessel], pushed = 0;
    vec3 added = k.w.bodies.added_mass[vessel];
    assert_vec3_close(added, vec3_make(0, 0, 0), 0);
    for (int i = 0; i < STEPS; i++) {
        vec3 before = k.w.bodies.velocity[vessel];
        scene_steps(&k, 1);
        vec3 gained = vec3_scale(vec3_sub(k.w.bodies.velocity[vessel], before), mass);
        vec3 load = vec3_scale(k.w.scratch.ice_loads.data[0].total.force, k.m.time_step);
        double scale = 0;
        for (int32_t n = 0; n < k.w.scratch.contacts.count; n++)
            scale += k.w.scratch.contacts.data[n].impulse[0];
        assert_vec3_close(gained, load, 1e-9 * scale + 1e-6);
        pushed = fmax(pushed, vec3_length(load));
    }
    ck_assert_double_gt(pushed, 1e4);
    scene_close(&k);
}
END_TEST

TEST_MAIN("hub", bits_depend_on_neither_threads_nor_instruction_set, the_vessel_moves_as_its_contacts_push)
