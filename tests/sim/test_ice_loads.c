/* Loads of ice from contacts whose impulses are set by hand: who gets what, work at the cap, the window of the last
   steps. */
#include "scene.h"

#include "base/pool.h"
#include "sim/contact_sums.h"
#include "sim/ice_loads.h"
#include "sim/steady_load.h"

static const char still[] = "run: {duration: 1, time_step: 0.1}\n"
                            "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice:\n  source: floes\n  floes:\n    - {x: 40, y: 0}\n    - {x: 40, y: 20}\n"
                            "domain: {x_min: -100, x_max: 100, y_min: -60, y_max: 60, boundary: open}\n"
                            "output: {averaging_window: 0.3}\n";

static contact contact_of(int32_t a, int32_t b, double impulse, double limit)
{
    return (contact){.a = a,
                     .b = b,
                     .point = {30, 2, -1},
                     .normal = {-1, 0, 0},
                     .impulse = {impulse, 0, 0},
                     .impulse_limit = limit,
                     .patch = -1};
}

/* The loads of one contact alone, on the first vessel. */
static ice_load load_of(scene *k, contact c)
{
    fram_error error = {0};
    array_clear(&k->w.scratch.contacts);
    ck_assert(array_push(&k->ctx, &k->w.scratch.contacts, c));
    assert_ok(sum_ice_loads(&k->ctx, &k->m, &k->w, &error), error);
    return k->w.scratch.ice_loads.data[0];
}

/* A contact pushes its first body along the normal and the second one against it; the load is impulse over time. */
START_TEST(either_side_of_a_contact)
{
    scene k;
    scene_open(&k, still);
    int32_t hull = k.w.vessels.body[0], floe = scene_floe(&k, 0);
    vec3 centre = k.w.bodies.position[hull];
    ice_load first = load_of(&k, contact_of(hull, floe, 50, HUGE_VAL));
    assert_absolute(first.total.force.x, -500, 1e-9);
    ice_load second = load_of(&k, contact_of(floe, hull, 50, HUGE_VAL));
    assert_absolute(second.total.force.x, 500, 1e-9);
    /* About the centre of mass. */
    assert_absolute(second.total.moment.z, -500 * (2 - centre.y), 1e-9);
    assert_absolute(second.total.moment.y, 500 * (-1 - centre.z), 1e-9);
    ck_assert_int_eq(second.contacts, 1);
    /* Not of two floes. */
    ck_assert(vec3_length(load_of(&k, contact_of(floe, scene_floe(&k, 1), 50, HUGE_VAL)).total.force) == 0);
    scene_close(&k);
}
END_TEST

/* Normal part at the limit, normal part below it, and friction sum to the load. */
START_TEST(parts_of_the_load)
{
    scene k;
    scene_open(&k, still);
    int32_t hull = k.w.vessels.body[0], floe = scene_floe(&k, 0);
    for (int capped = 0; capped < 2; capped++) {
        contact c = contact_of(floe, hull, 50, capped ? 50 : 51);
        c.impulse[1] = 3;
        c.impulse[2] = -4;
        ice_load l = load_of(&k, c);
        assert_absolute(vec3_length(l.capped.force), capped ? 500 : 0, 1e-9);
        assert_absolute(vec3_length(l.below_cap.force), capped ? 0 : 500, 1e-9);
        assert_absolute(vec3_length(l.friction.force), 50, 1e-9);
        vec3 sum = vec3_add(vec3_add(l.capped.force, l.below_cap.force), l.friction.force);
        assert_absolute(vec3_length(vec3_sub(sum, l.total.force)), 0, 1e-9);
        /* All of it on one part of the hull: where the contact is. */
        int zones = 0;
        for (int z = 0; z < ZONE_COUNT; z++)
            zones += vec3_length(l.zone[z].force) > 0;
        ck_assert_int_eq(zones, 1);
        assert_absolute(vec3_length(l.zone[ZONE_BOW].force), vec3_length(l.total.force), 1e-9);
    }
    contact c = contact_of(floe, hull, 50, HUGE_VAL);
    c.point.x = -20;
    assert_absolute(vec3_length(load_of(&k, c).zone[ZONE_STERN].force), 500, 1e-9);
    scene_close(&k);
}
END_TEST

/* A patch that reaches over zones: a rectangle along the side from x = -18 to 18, 1 m high, of which all four points,
   then only the two fore ones, carry. Each zone bears its length of it; shares add up to the load by zone. */
START_TEST(a_wide_patch_loads_zones_by_their_length)
{
    const double half = 18, reach = half / sqrt(3), high = 0.5 / sqrt(3);
    fram_error error = {0};
    scene k;
    scene_open(&k, still);
    const hull_zones z = k.w.vessels.zones[0];
    ck_assert(z.bow < half && z.shoulder > 0 && z.stern < 0 && z.stern > -half);
    const crushing_patch patch = {.contact_count = 4};
    ck_assert(array_push(&k.ctx, &k.w.scratch.patches, patch));
    for (int carry = 2; carry <= 4; carry += 2) {
        array_clear(&k.w.scratch.contacts);
        for (int i = 0; i < 4; i++) {
            contact c = contact_of(k.w.vessels.body[0], scene_floe(&k, 0), i < carry ? 100 : 0, HUGE_VAL);
            c.point = vec3_make(i & 2 ? -reach : reach, 6, i & 1 ? -high : high);
            c.normal = vec3_make(0, -1, 0);
            c.patch = 0;
            ck_assert(array_push(&k.ctx, &k.w.scratch.contacts, c));
        }
        assert_ok(sum_ice_loads(&k.ctx, &k.m, &k.w, &error), error);
        ice_load l = k.w.scratch.ice_loads.data[0];
        const double line = 4000 / (2 * half), aft = carry == 4 ? -half : 0;
        const double wanted[ZONE_COUNT] = {line * (half - z.bow), line * (z.bow - z.shoulder),
                                           line * (z.shoulder - fmax(z.stern, aft)), line * fmax(z.stern - aft, 0), 0};
        double sum = 0, shares[ZONE_COUNT] = {0};
        for (int32_t i = 0; i < k.w.scratch.shares.count; i++)
            shares[k.w.scratch.shares.data[i].zone] += k.w.scratch.shares.data[i].normal.y;
        for (int i = 0; i < ZONE_COUNT; i++) {
            assert_absolute(l.zone[i].force.y, -wanted[i], 1e-6);
            assert_absolute(shares[i], -wanted[i], 1e-6);
            sum += l.zone[i].force.y;
        }
        assert_absolute(sum, l.total.force.y, 1e-9);
    }
    scene_close(&k);
}
END_TEST

/* Ice that is crushed at its limit takes impulse times approach, and nothing while the bodies part or below the limit.
 */
START_TEST(work_at_the_cap)
{
    scene k;
    scene_open(&k, still);
    int32_t hull = k.w.vessels.body[0], floe = scene_floe(&k, 0);
    double *work = &k.w.clock.work_crushed[0];
    k.w.bodies.velocity[floe] = vec3_make(0.75, 0, 0); /* against the normal, into the hull */
    k.w.bodies.velocity[hull] = vec3_make(0.25, 0, 0);
    load_of(&k, contact_of(floe, hull, 60, 60));
    assert_absolute(*work, 60 * 0.5, 1e-9);
    load_of(&k, contact_of(floe, hull, 60, 60));
    assert_absolute(*work, 2 * 60 * 0.5, 1e-9);
    load_of(&k, contact_of(floe, hull, 59, 60));
    load_of(&k, contact_of(floe, hull, 60, HUGE_VAL));
    k.w.bodies.velocity[floe].x = 0;
    load_of(&k, contact_of(floe, hull, 60, 60));
    assert_absolute(*work, 2 * 60 * 0.5, 1e-9);
    scene_close(&k);
}
END_TEST

/* The window holds the load of each of the last steps; the newest is that of the step before, whichever row it is in.
   Its average is over its length from the first step on: a blow at the start is as large as any other. */
START_TEST(the_window_of_loads)
{
    scene k;
    scene_open(&k, still);
    ck_assert_int_eq(k.w.load_window.count, 3);
    ck_assert(vec3_length(last_ice_load(&k.w, 0).force) == 0);
    for (int step = 0; step < 8; step++) {
        k.w.clock.step[0] = step;
        load_of(&k, contact_of(scene_floe(&k, 0), k.w.vessels.body[0], 10 * (step + 1), HUGE_VAL));
        k.w.clock.step[0] = step + 1;
        wrench last = last_ice_load(&k.w, 0), mean = load_window_average(&k.w, 0);
        assert_absolute(last.force.x, 100 * (step + 1), 1e-9);
        double expected = step == 0 ? 100.0 / 3 : 100.0 * step;
        assert_absolute(mean.force.x, expected, 1e-9);
        /* Moments are kept with the forces. */
        assert_absolute(last.moment.z / last.force.x, mean.moment.z / mean.force.x, 1e-12);
        ck_assert(fabs(last.moment.z) > 0);
        ck_assert(vec3_length(last_ice_load(&k.w, 1).force) == 0);
    }
    scene_close(&k);
}
END_TEST

/* What each floe does to the vessel, whichever side of the contact it is on, and what all its contacts come to. */
START_TEST(sums_of_a_floes_contacts)
{
    scene k;
    contact_sum_array sums = {0};
    scene_open(&k, still);
    int32_t hull = k.w.vessels.body[0], one = scene_floe(&k, 0), two = scene_floe(&k, 1);
    array_clear(&k.w.scratch.contacts);
    const contact all[3] = {contact_of(hull, one, 5, HUGE_VAL), contact_of(one, hull, 2, HUGE_VAL),
                            contact_of(one, two, 4, HUGE_VAL)};
    for (int i = 0; i < 3; i++)
        ck_assert(array_push(&k.ctx, &k.w.scratch.contacts, all[i]));
    ck_assert(contact_sums_of(&k.ctx, &k.w, k.m.time_step, 0, &sums));
    /* Normals are -x: the first contact pushes the hull back by 50 N, the second one ahead by 20 N. */
    assert_vec3_close(sums.data[one].on_vessel, vec3_make(-50 + 20, 0, 0), 1e-12);
    assert_vec3_close(sums.data[two].on_vessel, vec3_make(0, 0, 0), 0);
    assert_absolute(sums.data[one].magnitude, 50 + 20 + 40, 1e-12);
    assert_absolute(sums.data[two].magnitude, 40, 1e-12);
    assert_absolute(sums.data[one].weight, 70, 1e-12);
    array_free(&k.ctx, &sums);
    scene_close(&k);
}
END_TEST

/* The steady load of wind and current together is the sum of both alone, in force and moment. */
START_TEST(steady_loads_add_up)
{
    scene k;
    scene_open(&k, still);
    media both = k.m.media, wind, current, none;
    both.current = vec3_make(0.6, -0.8, 0);
    both.wind = vec3_make(12, 9, 0);
    wind = current = none = both;
    wind.current = none.current = current.wind = none.wind = vec3_make(0, 0, 0);
    const double heading = 0.4;
    vec3 all = steady_media_load(&k.m, &k.w, 0, &both, heading);
    vec3 of_wind = steady_media_load(&k.m, &k.w, 0, &wind, heading);
    vec3 of_current = steady_media_load(&k.m, &k.w, 0, &current, heading);
    assert_vec3_close(steady_media_load(&k.m, &k.w, 0, &none, heading), vec3_make(0, 0, 0), 1e-6);
    assert_vec3_close(all, vec3_add(of_wind, of_current), 1e-6 * vec3_length(all));
    ck_assert_msg(fabs(of_wind.z) > 1e3 && fabs(of_current.z) > 1e3, "%g N m of wind, %g N m of current", of_wind.z,
                  of_current.z);
    ck_assert(of_wind.x > 0 && of_wind.y > 0 && of_current.x > 0 && of_current.y < 0);
    /* Damping of surge, by hand: the water goes past at 0.6 m/s. */
    k.m.vessels.data[0].has_hydrodynamics = true;
    k.m.vessels.data[0].hydrodynamics.damping = (matrix6){{{[0] = 1e6}}};
    vec3 damped = steady_media_load(&k.m, &k.w, 0, &current, 0), plain = steady_drag_load(&k.m, &k.w, 0, &current, 0);
    assert_vec3_close(vec3_sub(damped, plain), vec3_make(0.6e6, 0, 0), 1e-3);
    scene_close(&k);
}
END_TEST

/* Contacts of a hull are found among many others, on any number of threads. */
START_TEST(many_contacts)
{
    enum { COUNT = 9000, EVERY = 7 };
    for (int threads = 1; threads <= 3; threads += 2) {
        scene k;
        scene_open(&k, still);
        k.ctx.threads = threads > 1 ? pool_create(&k.ctx, threads) : NULL;
        int32_t hull = k.w.vessels.body[0], floe = scene_floe(&k, 0), other = scene_floe(&k, 1);
        fram_error error = {0};
        array_clear(&k.w.scratch.contacts);
        for (int i = 0; i < COUNT; i++) {
            contact c = contact_of(i % EVERY == 3 ? hull : other, floe, 1 + i, HUGE_VAL);
            ck_assert(array_push(&k.ctx, &k.w.scratch.contacts, c));
        }
        assert_ok(sum_ice_loads(&k.ctx, &k.m, &k.w, &error), error);
        double sum = 0;
        for (int i = 3; i < COUNT; i += EVERY)
            sum -= (1 + i) / k.m.time_step;
        assert_relative(k.w.scratch.ice_loads.data[0].total.force.x, sum, 1e-12);
        ck_assert_int_eq(k.w.scratch.ice_loads.data[0].contacts, (COUNT - 3 + EVERY - 1) / EVERY);
        pool_free(&k.ctx, k.ctx.threads);
        k.ctx.threads = NULL;
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("ice_loads", many_contacts, sums_of_a_floes_contacts, steady_loads_add_up, either_side_of_a_contact,
          parts_of_the_load, a_wide_patch_loads_zones_by_their_length, work_at_the_cap, the_window_of_loads)
