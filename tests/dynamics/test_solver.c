/* Caps, position correction, memory of impulses, mass ratios, agreement of the solvers, and what is refused. */
#include "base/transcendental.h"
#include "dynamics/solver_rows.h"
#include "rig.h"

/* Two equal boxes that overlap by 2 cm along x, at rest. */
static rig overlapping(double dt)
{
    rig r = rig_make(dt);
    r.gravity = vec3_make(0, 0, 0);
    r.settings.position_iterations = 400;
    rig_box(&r, MOTION_DYNAMIC, vec3_make(4, 4, 1), 900, vec3_make(-1.99, 0, 0));
    rig_box(&r, MOTION_DYNAMIC, vec3_make(4, 4, 1), 900, vec3_make(1.99, 0, 0));
    return r;
}

static double depth_of(rig *r) { return 4 - (r->bodies.position[1].x - r->bodies.position[0].x); }

START_TEST(correction_leaves_a_fifth_of_the_depth)
{
    for (int halving = 0; halving < 2; halving++) {
        rig r = overlapping(0.02 / (1 + halving));
        double expected = 0.02;
        for (int k = 0; k < 6; k++) {
            rig_step(&r);
            expected *= 0.2;
            assert_relative(depth_of(&r), expected, 1e-6);
            assert_bits(body_books_of(&r.bodies).kinetic_energy, 0);
        }
        rig_free(&r);
    }
}
END_TEST

/* Depth after one correction of contacts that carried `share` of their limit. */
static double corrected(double share, double limit, bool correct)
{
    rig r = overlapping(0.02);
    rig_detect(&r);
    ck_assert_int_eq(r.contacts.count, 4);
    for (int32_t i = 0; i < r.contacts.count; i++) {
        r.contacts.data[i].impulse_limit = limit;
        r.contacts.data[i].impulse[0] = share * limit;
        r.contacts.data[i].correct = correct;
    }
    rig_correct(&r);
    double depth = depth_of(&r);
    rig_free(&r);
    return depth;
}

START_TEST(correction_yields_to_crushing)
{
    assert_relative(corrected(0.5, 10, true), 0.5 * 0.02, 1e-9);
    assert_relative(corrected(0.1, 10, true), 0.2 * 0.02, 1e-9); /* never more than beta_0 */
    assert_relative(corrected(1, 10, true), 0.02, 1e-12);
    assert_relative(corrected(0, 0, true), 0.02, 1e-12); /* a first touch */
    assert_relative(corrected(0, 10, false), 0.02, 1e-12);
}
END_TEST

/* Gap of two boxes that are pushed together for a second, and the share of the push that the contacts pass on. */
static double gap_after_push(double gap, double *passed)
{
    const double push = 1000;
    rig r = overlapping(0.02);
    r.settings.contact_skin = 1e-3;
    r.bodies.position[1].x = 2 + gap;
    r.bodies.position[0].x = -2;
    r.loads.data[0].force.x = push;
    rig_run(&r, 50);
    *passed = 0;
    for (int32_t i = 0; i < r.contacts.count; i++)
        *passed += r.contacts.data[i].impulse[0] / r.dt / push;
    gap = -depth_of(&r);
    rig_free(&r);
    return gap;
}

START_TEST(a_gap_closes_to_the_skin)
{
    double passed;
    assert_relative(gap_after_push(5e-4, &passed), 5e-4, 1e-6);
    assert_relative(passed, 0.5, 1e-6); /* equal masses: half of it accelerates the second */
    assert_relative(gap_after_push(3e-3, &passed), 1e-3, 1e-6);
    assert_relative(passed, 0.5, 1e-6);
}
END_TEST

START_TEST(baumgarte_corrects_through_velocity)
{
    rig r = overlapping(0.02);
    r.settings.baumgarte = true;
    r.settings.iterations = 400;
    rig_step(&r);
    assert_relative(depth_of(&r), 0.2 * 0.02, 1e-6);
    ck_assert(body_books_of(&r.bodies).kinetic_energy > 1);
    rig_free(&r);
}
END_TEST

/* ---- caps ---- */

static void constant_cap(rig *r)
{
    for (int32_t i = 0; i < r->contacts.count; i++)
        r->contacts.data[i].impulse_limit = r->crushing * r->dt / r->contacts.count;
}

START_TEST(constant_cap_decelerates_as_told)
{
    /* 92 t at 0.5 m/s against 20 MN: stops in 2.3 ms after 0.575 mm. */
    double way[2], time[2];
    for (int halving = 0; halving < 2; halving++) {
        rig r = rig_make(5e-5 / (1 + halving));
        r.gravity = vec3_make(0, 0, 0);
        r.cap = constant_cap;
        r.crushing = 20e6;
        r.settings.kind = SOLVER_ACCURATE;
        rig_box(&r, MOTION_STATIC, vec3_make(2, 20, 4), 1, vec3_make(1, 0, 0));
        int32_t floe = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 10, 1), 920, vec3_make(-5, 0, 0));
        r.bodies.velocity[floe].x = 0.5;
        double energy = body_books_of(&r.bodies).kinetic_energy;
        time[halving] = 0;
        while (time[halving] < 0.01 && r.bodies.velocity[floe].x > 1e-9) {
            rig_step(&r);
            double now = body_books_of(&r.bodies).kinetic_energy;
            ck_assert(now <= energy * (1 + 1e-12));
            energy = now;
            time[halving] += r.dt;
        }
        way[halving] = r.bodies.position[floe].x + 5;
        rig_free(&r);
    }
    assert_absolute(time[0], 2.3e-3, 1.1e-4);
    assert_absolute(time[1], 2.3e-3, 5.5e-5);
    double e1 = fabs(way[0] - 0.575e-3), e2 = fabs(way[1] - 0.575e-3);
    ck_assert_msg(e1 < 3e-5 && e2 < 0.6 * e1, "penetration off by %g, %g", e1, e2);
}
END_TEST

START_TEST(friction_is_bounded_by_the_capped_force)
{
    rig r = rig_make(0.01);
    rig_friction(&r, 0.5, 0.5);
    r.cap = constant_cap;
    rig_box(&r, MOTION_STATIC, vec3_make(20, 20, 1), 1, vec3_make(0, 0, -0.5));
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 1), 250, vec3_make(0, 0, 0.499));
    r.crushing = 0.4 * 1000 * GRAVITY;
    r.bodies.velocity[box].x = 5;
    rig_step(&r);
    assert_relative(r.bodies.velocity[box].z, -0.6 * GRAVITY * r.dt, 1e-9);
    assert_relative(r.bodies.velocity[box].x, 5 - 0.5 * 0.4 * GRAVITY * r.dt, 1e-6);
    rig_free(&r);
}
END_TEST

START_TEST(driven_bodies_take_the_cap_while_approaching)
{
    for (int away = 0; away < 2; away++) {
        rig r = rig_make(0.01);
        rig_friction(&r, 0.2, 0.1);
        rig_box(&r, MOTION_STATIC, vec3_make(4, 4, 1), 900, vec3_make(-1.99, 0, 0));
        int32_t hull = rig_box(&r, MOTION_PRESCRIBED, vec3_make(4, 4, 1), 900, vec3_make(1.99, 0, 0));
        r.bodies.velocity[hull] = vec3_make(away ? 1 : -1, 0.4, -0.3);
        rig_detect(&r);
        ck_assert_int_eq(r.contacts.count, 4);
        for (int32_t i = 0; i < 4; i++) {
            r.contacts.data[i].impulse_limit = 100;
            r.contacts.data[i].crush_infinite = i > 0;
        }
        rig_solve(&r);
        for (int32_t i = 0; i < 4; i++) {
            bool loaded = !away && i > 0;
            /* a is the static sheet: pushed towards -x, dragged along with the hull. */
            vec3 p = contact_impulse(&r.contacts.data[i]);
            assert_vec3_close(p, loaded ? vec3_make(-100, 8, -6) : vec3_make(0, 0, 0), 1e-12);
        }
        assert_vec3_close(r.bodies.velocity[hull], vec3_make(away ? 1 : -1, 0.4, -0.3), 0);
        rig_free(&r);
    }
}
END_TEST

/* ---- friction ---- */

START_TEST(static_friction_holds_more_than_kinetic)
{
    /* Pushed by 0.25 m g with mu_s 0.3 and mu_k 0.2: holds from rest, goes on when moving, in any direction. */
    for (int turn = 0; turn < 8; turn++) {
        bool moving = turn > 0;
        double angle = turn * PI / 7;
        vec3 way = vec3_make(real_cos(angle), real_sin(angle), 0);
        rig r = rig_make(0.01);
        rig_friction(&r, 0.3, 0.2);
        rig_box(&r, MOTION_STATIC, vec3_make(200, 200, 1), 1, vec3_make(0, 0, -0.5));
        int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(4, 4, 0.5), 125, vec3_make(0, 0, 0.2499));
        r.loads.data[box].force = vec3_scale(way, 0.25 * 1000 * GRAVITY);
        r.bodies.velocity[box] = vec3_scale(way, moving ? 1 : 0);
        rig_run(&r, moving ? 20 : 100);
        double gained = vec3_dot(r.bodies.velocity[box], way) - (moving ? 1 : 0);
        assert_absolute(gained, moving ? 0.2 * 0.05 * GRAVITY : 0, moving ? 0.005 : 1e-9);
        rig_free(&r);
    }
}
END_TEST

/* ---- stacks, ratios, warm start ---- */

START_TEST(heavy_body_under_a_light_one)
{
    /* 100,000 t with 1 t upon it. */
    rig r = rig_make(0.01);
    rig_friction(&r, 0.3, 0.3);
    rig_box(&r, MOTION_STATIC, vec3_make(60, 60, 1), 1, vec3_make(0, 0, -0.5));
    int32_t ship = rig_box(&r, MOTION_DYNAMIC, vec3_make(40, 40, 10), 6250, vec3_make(0, 0, 5));
    int32_t floe = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 0.25), 1000, vec3_make(3, -7, 10.1249));
    assert_relative(r.bodies.mass[ship] / r.bodies.mass[floe], 1e5, 1e-9);
    rig_run(&r, 300);
    assert_vec3_close(r.bodies.position[floe], vec3_make(3, -7, 10.125), 1e-3);
    assert_vec3_close(r.bodies.velocity[floe], vec3_make(0, 0, 0), 1e-6);
    assert_vec3_close(r.bodies.velocity[ship], vec3_make(0, 0, 0), 1e-6);
    rig_free(&r);
}
END_TEST

START_TEST(heavy_body_pushes_light_ones)
{
    /* 100,000 t at 1 m/s into a row of 1 t floes with gaps: they run ahead of the ship without overlap or gain of
     * energy. */
    enum { FLOES = 10 };
    rig r = rig_make(0.02);
    r.gravity = vec3_make(0, 0, 0);
    rig_friction(&r, 0.1, 0.1);
    int32_t ship = rig_box(&r, MOTION_DYNAMIC, vec3_make(100, 20, 10), 5000, vec3_make(-50.1, 0, 0));
    for (int i = 0; i < FLOES; i++)
        rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 0.25), 1000, vec3_make(1 + 2.05 * i, 0.1 * (i % 2), 0));
    r.bodies.velocity[ship].x = 1;
    double energy = body_books_of(&r.bodies).kinetic_energy, deepest = 0;
    for (int k = 0; k < 200; k++) {
        rig_step(&r);
        double now = body_books_of(&r.bodies).kinetic_energy;
        ck_assert_msg(now <= energy * (1 + 1e-12), "energy grew in step %d", k);
        energy = now;
        deepest = testing_larger(deepest, r.report.max_depth);
    }
    ck_assert_msg(deepest < 0.02, "overlap %g m", deepest); /* less than the way of one step */
    for (int32_t i = 1; i <= FLOES; i++)
        assert_absolute(r.bodies.velocity[i].x, 1, 0.02);
    assert_absolute(r.bodies.velocity[ship].x, 1, 1e-3);
    rig_free(&r);
}
END_TEST

START_TEST(heavy_body_on_a_light_one_sinks_without_a_bang)
{
    /* The worst case of Gauss-Seidel: too few sweeps leave the contact soft, but never give energy. */
    rig r = rig_make(0.01);
    rig_friction(&r, 0.3, 0.3);
    rig_box(&r, MOTION_STATIC, vec3_make(60, 60, 1), 1, vec3_make(0, 0, -0.5));
    rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 0.25), 1000, vec3_make(0, 0, 0.125));
    int32_t ship = rig_box(&r, MOTION_DYNAMIC, vec3_make(40, 40, 10), 6250, vec3_make(0, 0, 5.25));
    double most = r.bodies.mass[ship] * GRAVITY * 0.25; /* what the fall through the floe gives */
    int steps = getenv("FRAM_TEST_SHORT") ? 100 : 300;
    for (int k = 0; k < steps; k++) {
        rig_step(&r);
        ck_assert(body_books_of(&r.bodies).kinetic_energy < most);
        ck_assert(r.bodies.position[ship].z < 5.26 && r.bodies.position[ship].z > 4.9);
    }
    rig_free(&r);
}
END_TEST

static rig pile(void)
{
    rig r = rig_make(0.01);
    rig_friction(&r, 0.4, 0.3);
    rig_box(&r, MOTION_STATIC, vec3_make(60, 60, 1), 1, vec3_make(0, 0, -0.5));
    for (int i = 0; i < 8; i++)
        rig_box(&r, MOTION_DYNAMIC, vec3_make(3 + 0.2 * (i % 3), 3, 0.5), 900,
                vec3_make(0.3 * (i % 2), 0.1 * (i % 3), 0.25 + 0.4999 * i));
    return r;
}

START_TEST(warm_start_helps)
{
    if (rig_kind == SOLVER_ACCURATE)
        return; /* that one ends at its tolerance either way */
    double residual[2];
    for (int warm = 0; warm < 2; warm++) {
        rig r = pile();
        r.settings.iterations = 20;
        r.settings.warm_start = warm;
        rig_run(&r, 100);
        residual[warm] = r.report.residual;
        rig_free(&r);
    }
    ck_assert_msg(residual[1] < 0.01 * residual[0], "residual %g cold, %g warm", residual[0], residual[1]);
}
END_TEST

START_TEST(solvers_agree)
{
    rig r = pile(), s = pile();
    s.settings.kind = SOLVER_ACCURATE;
    s.settings.tolerance = 1e-10;
    r.settings.iterations = 20000;
    rig_run(&r, 3);
    rig_run(&s, 3);
    ck_assert_msg(s.report.residual <= 1e-10, "residual %g", s.report.residual);
    ck_assert_msg(s.report.iterations < s.settings.most_iterations, "%d sweeps", s.report.iterations);
    for (int32_t i = 1; i < r.bodies.count; i++)
        assert_vec3_close(r.bodies.velocity[i], s.bodies.velocity[i], 1e-6);
    rig_free(&r);
    rig_free(&s);
}
END_TEST

START_TEST(pile_comes_to_rest)
{
    rig r = pile();
    rig_run(&r, 300);
    ck_assert(body_books_of(&r.bodies).kinetic_energy < 1e-6);
    ck_assert(r.report.max_depth < 1e-6);
    rig_free(&r);
}
END_TEST

/* Ten boxes of one size: corners upon corners, so that rounding names the points of contact.  Each step the load must
   find them again, or the stack begins to rock and to wander. */
START_TEST(a_stack_stays_where_it_stands)
{
    enum { BOXES = 10 };
    int steps = getenv("FRAM_TEST_SHORT") ? 150 : 1000;
    rig r = rig_make(0.01);
    rig_friction(&r, 0.3, 0.3);
    rig_box(&r, MOTION_STATIC, vec3_make(60, 60, 1), 1, vec3_make(0, 0, -0.5));
    for (int i = 0; i < BOXES; i++)
        rig_box(&r, MOTION_DYNAMIC, vec3_make(1, 1, 1), 1000, vec3_make(0, 0, 0.5 + i));
    double aside = 0, sunk = 0;
    for (int k = 0; k < steps; k++) {
        rig_step(&r);
        for (int i = 1; i <= BOXES; i++) {
            vec3 p = r.bodies.position[i];
            aside = testing_larger(aside, sqrt(p.x * p.x + p.y * p.y));
            sunk = testing_larger(sunk, fabs(p.z - (i - 0.5)));
        }
    }
    ck_assert_msg(aside < 1e-3 && sunk < 2e-3, "%g m aside, %g m down", aside, sunk);
    rig_free(&r);
}
END_TEST

/* What `count` points with these names recall of a memory of pair (1, 2): names 2, 4, 6 carry 1, 10, 100 N s along x;
   pairs before and after carry more. */
static double recalled_of(const uint32_t *names, int32_t count, double *each)
{
    rig r = rig_make(0.01);
    for (int i = 0; i < 4; i++)
        body_create(&r.ctx, &r.bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    uint64_t pair = contact_key_pair(contact_key(&r.bodies, 1, 2, 0, 0, 0));
    uint64_t low = contact_key_pair(contact_key(&r.bodies, 0, 2, 0, 0, 0));
    const uint64_t keys[] = {low | 4, pair | 2, pair | 4, pair | 6,
                             contact_key_pair(contact_key(&r.bodies, 1, 3, 0, 0, 0))};
    const double carried[] = {5000, 1, 10, 100, 7000};
    ck_assert(table_resize(&r.ctx, &r.memory, &contact_memory_table_info, 5));
    for (int i = 0; i < 5; i++) {
        r.memory.key[i] = keys[i];
        r.memory.on_lower[i] = vec3_make(carried[i], 0, 0);
    }
    for (int32_t i = 0; i < count; i++)
        ck_assert(array_push(&r.ctx, &r.contacts, ((contact){.a = 1, .b = 2, .key = pair | names[i]})));
    vec3 recalled[8];
    double sum = 0;
    contacts_recall(&r.memory, &r.contacts, 0, count, recalled);
    for (int32_t i = 0; i < count; i++) {
        each[i] = recalled[i].x;
        sum += recalled[i].x;
    }
    /* The pair belongs to the range that it begins in. */
    recalled[1].x = -1;
    contacts_recall(&r.memory, &r.contacts, 1, count, recalled);
    assert_bits(recalled[1].x, -1);
    rig_free(&r);
    return sum;
}

START_TEST(points_with_new_names_share_what_the_pair_carried)
{
    double each[8];
    assert_bits(recalled_of((uint32_t[]){6, 4, 2}, 3, each), 111); /* all found, in any order */
    assert_bits(each[0], 100);
    assert_bits(recalled_of((uint32_t[]){4, 9, 1}, 3, each), 111); /* 2 and 6 are gone: 9 and 1 share them */
    assert_bits(each[0], 10);
    assert_bits(each[1], 50.5);
    assert_bits(each[2], 50.5);
    assert_bits(recalled_of((uint32_t[]){4, 2}, 2, each), 11); /* one is gone, nobody came for it */
    assert_bits(recalled_of((uint32_t[]){2, 4, 6, 8}, 4, each), 111);
    assert_bits(each[3], 0); /* a point more than before starts from nothing */
}
END_TEST

/* What a pair carried is told of the body in the lower slot: it is turned for contacts that tell of the other one, and
   never by the direction of a normal, which another contact of the pair may oppose. */
START_TEST(what_a_pair_carried_goes_with_its_bodies)
{
    rig r = rig_make(0.01);
    for (int i = 0; i < 3; i++)
        body_create(&r.ctx, &r.bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    for (int from = 0; from < 2; from++) {
        contact wrote = {.a = from ? 2 : 1, .b = from ? 1 : 2, .normal = {1, 0, 0}, .impulse = {5, 0, 0}};
        wrote.key = contact_key(&r.bodies, 1, 2, 0, 0, 7);
        array_clear(&r.contacts);
        ck_assert(array_push(&r.ctx, &r.contacts, wrote));
        r.solve->ctx = &r.ctx;
        ck_assert_int_eq(contacts_remember(r.solve, &r.bodies, &r.contacts, &r.memory, NULL), FRAM_OK);
        for (int to = 0; to < 2; to++) {
            double carried = from == to ? 5 : -5;
            for (uint32_t name = 7; name < 9; name++) {
                contact reads = {.a = to ? 2 : 1, .b = to ? 1 : 2, .normal = {-1, 0, 0}};
                reads.key = contact_key(&r.bodies, 1, 2, 0, 0, name);
                vec3 recalled;
                array_clear(&r.contacts);
                ck_assert(array_push(&r.ctx, &r.contacts, reads));
                contacts_recall(&r.memory, &r.contacts, 0, 1, &recalled);
                assert_bits(recalled.x, carried);
                assert_bits(contact_memory_pair(&r.memory, &reads).x, carried);
            }
        }
    }
    rig_free(&r);
}
END_TEST

START_TEST(a_name_is_found_or_is_not)
{
    rig r = rig_make(0.01);
    enum { NAMES = 100 };
    ck_assert(table_resize(&r.ctx, &r.memory, &contact_memory_table_info, NAMES));
    for (int i = 0; i < NAMES; i++)
        r.memory.key[i] = (uint64_t)i * 3 + 1;
    int32_t hints[] = {0, 7, 50, NAMES - 1, NAMES};
    for (int h = 0; h < 5; h++) {
        for (uint64_t key = 0; key < 3 * NAMES + 3; key++) {
            int32_t place = hints[h], row = contact_memory_find(&r.memory, key, &place);
            ck_assert_int_eq(row, key % 3 == 1 && key < 3 * NAMES ? (int32_t)(key / 3) : -1);
        }
    }
    /* A name in two steps is the name in one, and its pair is named by any order of pieces. */
    for (int i = 0; i < 3; i++)
        body_create(&r.ctx, &r.bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    uint64_t key = contact_key_end(contact_key_begin(&r.bodies, 1, 2, 4, 5), 77);
    ck_assert_uint_eq(key, contact_key(&r.bodies, 1, 2, 4, 5, 77));
    ck_assert_uint_ne(key, contact_key(&r.bodies, 1, 2, 4, 5, 78));
    ck_assert_uint_ne(key, contact_key(&r.bodies, 1, 2, 5, 4, 77));
    ck_assert_uint_eq(contact_key_pair(key), contact_key_pair(contact_key(&r.bodies, 2, 1, 0, 0, 3)));
    ck_assert_uint_ne(contact_key_pair(key), contact_key_pair(contact_key(&r.bodies, 0, 2, 4, 5, 77)));
    rig_free(&r);
}
END_TEST

START_TEST(memory_is_sorted_and_matches)
{
    rig r = pile();
    rig_run(&r, 5);
    ck_assert_int_eq(r.contacts.count, 32);
    ck_assert(r.memory.count > 20);
    for (int32_t i = 1; i < r.memory.count; i++)
        ck_assert(r.memory.key[i - 1] < r.memory.key[i]);
    /* The next step finds nearly all of them again. */
    rig_detect(&r);
    int found = 0;
    for (int32_t i = 0; i < r.contacts.count; i++)
        for (int32_t k = 0; k < r.memory.count; k++)
            found += r.memory.key[k] == r.contacts.data[i].key;
    ck_assert_int_ge(found, r.memory.count - 1);
    rig_free(&r);
}
END_TEST

START_TEST(added_mass_makes_heavier_along_its_axis)
{
    rig r = rig_make(0.01);
    r.gravity = vec3_make(0, 0, 0);
    sym3 inertia = {.xx = 10, .yy = 10, .zz = 10};
    int32_t p = rig_point(&r, MOTION_DYNAMIC, 100, inertia, vec3_make(0, 0, 0));
    r.bodies.added_mass[p] = vec3_make(100, 300, 0);
    r.bodies.added_inertia[p] = vec3_make(0, 0, 30);
    r.bodies.orientation[p] = quat_from_roll_pitch_yaw(0, 0, 0.5 * 3.14159265358979323846);
    r.loads.data[p] = (wrench){{400, 400, 400}, {40, 40, 40}};
    rig_solve(&r);
    /* A quarter turn: body x is global y. */
    assert_vec3_close(r.bodies.velocity[p], vec3_make(0.01, 0.02, 0.04), 1e-15);
    assert_vec3_close(r.bodies.angular_velocity[p], vec3_make(0.04, 0.04, 0.01), 1e-15);
    rig_free(&r);
}
END_TEST

START_TEST(refusals)
{
    rig r = pile();
    fram_error e = {0};
    solver_settings settings = r.settings;
    settings.kind = (solver_kind)17;
    assert_fails(solver_solve(&r.ctx, r.solve, &settings, 0.01, &r.bodies, r.loads.data, &r.joints, &r.contacts,
                              &r.memory, NULL, &e),
                 e, FRAM_ERROR_UNSUPPORTED, "solver");
    r.bodies.mass[3] = 0;
    assert_fails(solver_solve(&r.ctx, r.solve, &r.settings, 0.01, &r.bodies, r.loads.data, &r.joints, &r.contacts,
                              &r.memory, NULL, &e),
                 e, FRAM_ERROR_USAGE, "body 3");
    rig_free(&r);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        rig r = pile();
        rig_step(&r);
        joint_create(&r.ctx, &r.joints, &r.bodies, 1, 2, JOINT_FIXED, vec3_make(0, 0, 0.5), quat_identity());
        solver *s = solver_create(&turn.ctx);
        contact_memory_table fresh = {0};
        r.settings.most_iterations = 3;
        turn.status = s ? solver_solve(&turn.ctx, s, &r.settings, r.dt, &r.bodies, r.loads.data, &r.joints, &r.contacts,
                                       &fresh, &r.report, &turn.error)
                        : FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK)
            turn.status = solver_correct_positions(&turn.ctx, s, &r.settings, r.dt, &r.bodies, &r.joints, &r.contacts,
                                                   &turn.error);
        solver_free(&turn.ctx, s);
        table_free(&turn.ctx, &fresh, &contact_memory_table_info);
        rig_free(&r);
        if (!turn.memory.failed)
            ck_assert(turn.n > 5);
    }
}
END_TEST

/* The share of last step's impulses that is taken: all where that costs energy, else the largest that gives none. */
START_TEST(a_warm_start_gives_no_energy)
{
    ck_assert(energy_share((energy_gain){0, 0}) == 1);
    ck_assert(energy_share((energy_gain){-3, 4}) == 1);
    ck_assert(energy_share((energy_gain){-2, 4}) == 1); /* nothing is gained, to the last */
    ck_assert(energy_share((energy_gain){1, 4}) == 0 && energy_share((energy_gain){0, 4}) == 0);
    for (double linear = -0.1; linear > -2; linear -= 0.1) {
        double share = energy_share((energy_gain){linear, 4});
        ck_assert(share > 0 && share < 1);
        assert_absolute(share * linear + 0.5 * share * share * 4, 0, 1e-15);
    }
}
END_TEST

RIG_MAIN("solver", a_warm_start_gives_no_energy, correction_leaves_a_fifth_of_the_depth, correction_yields_to_crushing,
         a_gap_closes_to_the_skin, baumgarte_corrects_through_velocity, constant_cap_decelerates_as_told,
         friction_is_bounded_by_the_capped_force, driven_bodies_take_the_cap_while_approaching,
         static_friction_holds_more_than_kinetic, heavy_body_under_a_light_one, heavy_body_pushes_light_ones,
         heavy_body_on_a_light_one_sinks_without_a_bang, warm_start_helps, solvers_agree, pile_comes_to_rest,
         a_stack_stays_where_it_stands, points_with_new_names_share_what_the_pair_carried,
         what_a_pair_carried_goes_with_its_bodies, a_name_is_found_or_is_not, memory_is_sorted_and_matches,
         added_mass_makes_heavier_along_its_axis, refusals, memory_runs_out)
