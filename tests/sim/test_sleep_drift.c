/* Floes that sleep on a sheet that drifts: they go with it, wake when it swerves, and a ship on station sleeps as one
   that is towed through ice at rest does (dynamics/rest.h). */
#include "sim/scene.h"

#include "base/pool.h"
#include "ice/drift.h"
#include "model/inputs.h"

/* A ship that stands still, and a sheet with loose floes in an opening that drifts onto it. */
static const char text[] = "run: {duration: 100, time_step: 0.02, scale: 30}\n"
                           "vessel:\n  mode: prescribed\n  speed: 0\n"
                           "  hull: {form: icebreaker, length: 40, beam: 10, draught: 4, freeboard: 3,\n"
                           "         stem_angle_deg: 30, entrance_angle_deg: 35, flare_angle_deg: 12,\n"
                           "         stern_angle_deg: 35, parallel_midbody: 0.4}\n"
                           "ice: {source: level, thickness: 0.5, breakable: true, sleep_speed: 0.1, sleep_time: 1,\n"
                           "      level: {tile_size: 20, openings: [{x: 0, length: 120, width: 36}]}}\n"
                           "domain: {x_min: -60, x_max: 70, y_min: -30, y_max: 30, boundary: feeding, drift_speed: 1,\n"
                           "         drift_direction_deg: 180}\n"
                           "environment: {current_speed: 1, current_direction_deg: 180}\n";
/* Loose floes of 4 m in rows that touch, their number, and steps after which they sleep and the first have been met. */
enum { COLUMNS = 6, ROWS = 5, UNDER_WAY = 350 };
#define SIDE 4.0

/* The same ship towed to the same ice at rest. */
static const char *const TOWED[] = {"vessel.speed=1", "domain.boundary=open", "domain.drift_speed=auto",
                                    "environment.current_speed=0"};

/* As that of the sheet that drifts. */
static ice_material ice_of_the_sheet(void)
{
    scene k;
    scene_open(&k, text);
    ice_material found = k.m.sheet.ice.material;
    scene_close(&k);
    return found;
}

static void add_floe(scene *k, ice_material ice, double x, double y, double speed)
{
    vec2 ring[4] = {{x, y}, {x + SIDE, y}, {x + SIDE, y + SIDE}, {x, y + SIDE}};
    fram_error error = {0};
    int32_t row = -1;
    floe_definition d = {.outline = {ring, 4},
                         .thickness = k->s.ice.thickness,
                         .material = ice,
                         .motion = MOTION_DYNAMIC,
                         .elevation = k->w.bodies.position[scene_floe(k, 0)].z,
                         .parent = -1};
    assert_ok(floe_create(&k->ctx, &d, k->s.ice.smallest_piece_area, k->w.scratch.plane, &k->w.bodies, &k->w.shapes,
                          &k->w.floes, k->w.clock.next_floe, &row, &error),
              error);
    k->w.bodies.velocity[k->w.floes.body[row]] = vec3_make(speed, 0, 0);
}

static void open_with_floes(scene *k, const char *const *overrides, int count)
{
    scene_open_with(k, text, overrides, count);
    double speed = k->w.drift.count > 0 ? -1 : 0;
    ice_material ice = ice_of_the_sheet();
    for (int i = 0; i < COLUMNS; i++)
        for (int j = 0; j < ROWS; j++)
            add_floe(k, ice, 24 + SIDE * i, -12 + 5 * j, speed);
}

static int asleep(const world *w)
{
    int count = 0;
    for (int32_t i = 0; i < w->bodies.count; i++)
        count += w->bodies.motion[i] == MOTION_ASLEEP;
    return count;
}

static void open_under_way(scene *k, int threads)
{
    open_with_floes(k, NULL, 0);
    k->ctx.threads = threads > 1 ? pool_create(&k->ctx, threads) : NULL;
    scene_steps(k, UNDER_WAY);
}

static void close_with_threads(scene *k)
{
    pool_free(&k->ctx, k->ctx.threads);
    k->ctx.threads = NULL;
    scene_close(k);
}

static bool sleeps_on(const world *w, const uint32_t *generation, int32_t i)
{
    return w->bodies.motion[i] == MOTION_ASLEEP && w->bodies.generation[i] == generation[i];
}

START_TEST(what_sleeps_goes_with_a_sheet_that_turns_and_wakes_when_it_swerves)
{
    enum { MOST = 4000, TURN = 40 };
    static vec3 place[MOST];
    static uint32_t generation[MOST];
    scene k;
    open_under_way(&k, 1);
    const body_table *b = &k.w.bodies;
    int before = asleep(&k.w), kept = 0;
    ck_assert_int_ge(before, 10);
    ck_assert_int_lt(b->count, MOST);
    vec2 from = k.w.drift.moved[0];
    for (int32_t i = 0; i < b->count; i++) {
        place[i] = b->position[i];
        generation[i] = b->motion[i] == MOTION_ASLEEP ? b->generation[i] : 0;
    }
    /* Half of the change that would wake in a step, and less in all than the media may change. */
    for (int s = 1; s <= TURN; s++) {
        scene_tell(&k, INPUT_DRIFT, -1, 0.002 * s);
        scene_steps(&k, 1);
    }
    vec2 way = vec2_sub(k.w.drift.moved[0], from);
    ck_assert_double_gt(way.y, 0.02);
    for (int32_t i = 0; i < b->count && i < MOST; i++) {
        if (!sleeps_on(&k.w, generation, i))
            continue;
        kept++;
        ck_assert_double_eq_tol(b->position[i].x - place[i].x, way.x, 1e-9);
        ck_assert_double_eq_tol(b->position[i].y - place[i].y, way.y, 1e-9);
        ck_assert(b->position[i].z == place[i].z);
    }
    ck_assert_int_gt(4 * kept, 3 * before);
    scene_tell(&k, INPUT_DRIFT, -1, 0.002 * TURN + 0.008);
    scene_steps(&k, 1);
    ck_assert_int_eq(asleep(&k.w), 0);
    scene_close(&k);
}
END_TEST

START_TEST(a_current_past_the_sheet_wakes)
{
    scene k;
    open_under_way(&k, 1);
    int before = asleep(&k.w);
    scene_tell(&k, INPUT_CURRENT, -0.92, 0);
    scene_steps(&k, 1);
    ck_assert_int_gt(4 * asleep(&k.w), 3 * before);
    scene_tell(&k, INPUT_CURRENT, -0.88, 0);
    scene_steps(&k, 1);
    ck_assert_int_eq(asleep(&k.w), 0);
    scene_close(&k);
}
END_TEST

/* Sum of the ice's impulse on the ship, and who sleeps at the end. */
static vec3 impulse_on_ship(const char *const *overrides, int count, int *sleepers)
{
    scene k;
    vec3 sum = {0, 0, 0};
    open_with_floes(&k, overrides, count);
    for (int s = 0; s < UNDER_WAY; s++) {
        scene_steps(&k, 1);
        sum = vec3_mad(sum, k.w.scratch.ice_loads.data[0].total.force, k.m.time_step);
    }
    *sleepers = asleep(&k.w);
    scene_close(&k);
    return sum;
}

START_TEST(a_drifting_sheet_sleeps_as_one_at_rest_does)
{
    int drifting, resting, awake;
    static const char *const off[] = {"ice.sleep_speed=0"};
    vec3 met = impulse_on_ship(NULL, 0, &drifting), towed = impulse_on_ship(TOWED, 4, &resting);
    vec3 still = impulse_on_ship(off, 1, &awake);
    ck_assert_int_eq(awake, 0);
    ck_assert_int_ge(drifting, 10);
    ck_assert_int_lt(drifting, COLUMNS * ROWS);
    ck_assert_int_eq(drifting, resting);
    double size = vec3_length(towed);
    ck_assert_double_gt(size, 0);
    ck_assert_double_le(vec3_length(vec3_sub(met, towed)), 0.02 * size);
    ck_assert_double_le(vec3_length(vec3_sub(met, still)), 0.1 * size);
}
END_TEST

START_TEST(threads_and_a_copy_in_the_midst_of_sleep_go_on_to_the_bit)
{
    scene k, other;
    world copy;
    fram_error error = {0};
    open_under_way(&k, 1);
    open_under_way(&other, 2);
    ck_assert_int_ge(asleep(&k.w), 10);
    ck_assert(world_hash(&k.w) == world_hash(&other.w));
    assert_ok(world_copy(&k.ctx, &k.w, &copy, &error), error);
    for (int s = 0; s < 100; s++)
        assert_ok(world_step(&k.ctx, &k.m, &copy, &error), error);
    scene_steps(&k, 100);
    scene_steps(&other, 100);
    ck_assert(world_hash(&k.w) == world_hash(&copy));
    ck_assert(world_hash(&k.w) == world_hash(&other.w));
    world_free(&k.ctx, &copy);
    scene_close(&k);
    close_with_threads(&other);
}
END_TEST

START_TEST(books_go_on_with_what_sleeps)
{
    scene k;
    open_under_way(&k, 1);
    body_books books = {0};
    double energy = 0, loose = 0, ice = 0;
    const body_table *b = &k.w.bodies;
    for (int32_t i = 0; i < b->count; i++) {
        body_books_add(b, i, &books);
        bool floe = b->motion[i] == MOTION_DYNAMIC || b->motion[i] == MOTION_ASLEEP;
        loose += floe ? b->mass[i] : 0;
        ice += floe || b->motion[i] == MOTION_CARRIED ? b->mass[i] : 0;
        if (b->motion[i] == MOTION_ASLEEP)
            energy += 0.5 * b->mass[i] * vec3_dot(b->velocity[i], b->velocity[i]);
    }
    ck_assert_double_gt(energy, 0);
    ck_assert_double_eq_tol(books.mass, loose, 1e-9 * loose);
    ck_assert_double_ge(books.kinetic_energy, energy);
    /* All ice that is or was there; nothing breaks off the sheet. */
    const clock_table *c = &k.w.clock;
    double all = ice + c->ice_left[0] + c->ice_lost[0] - c->ice_gained[0] + c->ice_crushed[0] + c->brash_mass[0] -
                 k.w.drift.entered[0];
    scene first;
    open_with_floes(&first, NULL, 0);
    double start = 0;
    for (int32_t i = 0; i < first.w.bodies.count; i++)
        start += first.w.bodies.material[i] == MATERIAL_ICE ? first.w.bodies.mass[i] : 0;
    ck_assert_double_eq_tol(all, start, 1e-7 * start);
    scene_close(&first);
    scene_close(&k);
}
END_TEST

START_TEST(a_sheet_with_inertia_has_no_sleepers)
{
    static const char *const loaded[] = {"ice.level.line_load=1e5"};
    check_refusal(text, loaded, 1, "ice.sleep_speed");
}
END_TEST

TEST_MAIN("sleep_drift", what_sleeps_goes_with_a_sheet_that_turns_and_wakes_when_it_swerves,
          a_current_past_the_sheet_wakes, a_drifting_sheet_sleeps_as_one_at_rest_does,
          threads_and_a_copy_in_the_midst_of_sleep_go_on_to_the_bit, books_go_on_with_what_sleeps,
          a_sheet_with_inertia_has_no_sleepers)
