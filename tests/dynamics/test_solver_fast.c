/* The fast solver's own matters: who shares a batch, the same bits for any threads and instruction set, what it leaves
   undone on packed fields, and how it treats heavy and light bodies. */
#include "base/hash.h"
#include "base/pool.h"
#include "dynamics/solver_batch.h"
#include "packed.h"

static rig packed_fast(int columns, int rows, double friction, uint64_t seed)
{
    rig r = packed_rig(columns, rows, friction, seed);
    r.settings.kind = SOLVER_FAST;
    r.settings.position_iterations = 10;
    return r;
}

/* ---- regions ---- */

/* A long field makes more strips than are cut at once: every body has its region, all regions are about equally large
   and none reaches into another strip. */
START_TEST(regions_of_a_long_field_are_equally_large)
{
    enum { BODIES = 40000, STRIPS = 32, PIECES = 2 };
    const double length = 1600, width = 97;
    rig r = rig_make(0.01);
    random_stream random = random_begin(11, 0, 0);
    int32_array slots = {0}, region = {0};
    ck_assert(table_resize(&r.ctx, &r.bodies, &body_table_info, BODIES) && array_resize(&r.ctx, &slots, BODIES) &&
              array_resize(&r.ctx, &region, BODIES));
    for (int32_t i = 0; i < BODIES; i++) {
        double x = random_uniform(&random, 0, width), y = random_uniform(&random, 0, length);
        r.bodies.position[i] = vec3_make(x, y, 0);
        slots.data[i] = i;
    }
    int32_t chunks, size[PARTITION_MOST] = {0};
    double lo[PARTITION_MOST], hi[PARTITION_MOST];
    bodies_partition(&r.bodies, slots.data, BODIES, BODIES, region.data, &chunks);
    ck_assert_int_eq(chunks, STRIPS * PIECES);
    for (int32_t c = 0; c < chunks; c++)
        lo[c] = length, hi[c] = 0;
    for (int32_t i = 0; i < BODIES; i++) {
        int32_t c = region.data[i];
        ck_assert(c >= 0 && c < chunks);
        size[c]++;
        lo[c] = fmin(lo[c], r.bodies.position[i].y);
        hi[c] = fmax(hi[c], r.bodies.position[i].y);
    }
    for (int32_t c = 0; c < chunks; c++) {
        ck_assert(size[c] > 0.85 * BODIES / chunks && size[c] < 1.15 * BODIES / chunks);
        ck_assert(c < PIECES || lo[c] > hi[c - PIECES]);
    }
    array_free(&r.ctx, &slots);
    array_free(&r.ctx, &region);
    rig_free(&r);
}
END_TEST

/* ---- plan ---- */

/* Every lane's bodies, once each, as slots; hubs left out. */
static void mark_batch(const batch_plan *plan, const contact_batch *batch, const body_table *bodies, int32_t *mark,
                       int32_t by)
{
    for (int lane = 0; lane < BATCH_LANES; lane++) {
        int32_t rows[2] = {batch->a[lane], batch->b[lane]};
        for (int k = 0; k < 2; k++) {
            int32_t slot = plan->slot.data[rows[k]];
            if (slot < 0 || !body_is_dynamic(bodies, slot))
                continue;
            ck_assert_msg(mark[slot] != by, "body %d twice in %d", (int)slot, (int)by);
            mark[slot] = by;
        }
    }
}

START_TEST(batches_share_no_body)
{
    rig r = packed_fast(40, 34, 0.3, 3);
    int32_t ship = packed_vessel(&r, 34, 1e8, 0.5);
    rig_detect(&r);
    batch_plan plan = {0};
    ck_assert(batch_plan_make(&r.ctx, &plan, &r.bodies, &r.contacts));
    int32_t slots = r.bodies.count, *mark = memory_array(&r.ctx, (size_t)slots, sizeof *mark);
    int32_t *seen = memory_array(&r.ctx, (size_t)r.contacts.count, sizeof *seen);
    int32_t lanes = 0, batch_number = 0;
    for (int32_t i = 0; i < plan.batches.count; i++) {
        const contact_batch *batch = &plan.batches.data[i];
        mark_batch(&plan, batch, &r.bodies, mark, ++batch_number);
        for (int lane = 0; lane < BATCH_LANES; lane++) {
            lanes += batch->contact[0][lane] >= 0;
            for (int k = 0; k < batch->points; k++)
                if (batch->contact[k][lane] >= 0)
                    seen[batch->contact[k][lane]]++;
        }
    }
    for (int32_t i = 0; i < r.contacts.count; i++)
        ck_assert_int_eq(seen[i], 1);
    ck_assert_int_eq(lanes, plan.groups.count);
    ck_assert_msg(lanes > 0.85 * BATCH_LANES * plan.batches.count, "%d lanes in %d batches", lanes, plan.batches.count);
    ck_assert_int_gt(plan.chunks, 1);
    /* Tasks of a colour share no body either. */
    int32_t *owner = memory_array(&r.ctx, (size_t)slots, sizeof *owner);
    for (int32_t t = 0; t < plan.tasks.count; t++) {
        for (int32_t i = plan.tasks.data[t].first; i < plan.tasks.data[t].end; i++) {
            const contact_batch *batch = &plan.batches.data[i];
            for (int lane = 0; lane < 2 * BATCH_LANES; lane++) {
                int32_t slot = plan.slot.data[lane < BATCH_LANES ? batch->a[lane] : batch->b[lane - BATCH_LANES]];
                if (slot < 0 || !body_is_dynamic(&r.bodies, slot))
                    continue;
                int32_t last = owner[slot] - 1;
                ck_assert(last < 0 || last == t || plan.tasks.data[last].colour != plan.tasks.data[t].colour);
                owner[slot] = t + 1;
            }
        }
    }
    ck_assert_int_eq(plan.hubs.count, 0);
    (void)ship;
    memory_free(&r.ctx, owner);
    memory_free(&r.ctx, mark);
    memory_free(&r.ctx, seen);
    batch_plan_free(&r.ctx, &plan);
    rig_free(&r);
}
END_TEST

/* Groups told one contact after the other. */
static void assert_groups(const rig *r, const batch_plan *plan)
{
    int32_t group = -1, size = 0, movable = 0, grouped = 0;
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        if (!body_is_dynamic(&r->bodies, c->a) && !body_is_dynamic(&r->bodies, c->b)) {
            size = 0;
            continue;
        }
        movable++;
        bool more = size > 0 && size < BATCH_MOST_POINTS && contact_same_group(c - 1, c);
        size = more ? size + 1 : 1;
        group += !more;
        ck_assert_int_lt(group, plan->groups.count);
        ck_assert_int_eq(plan->groups.data[group].first, i + 1 - size);
        ck_assert_int_ge(plan->groups.data[group].count, size);
    }
    ck_assert_int_eq(group + 1, plan->groups.count);
    for (int32_t i = 0; i < plan->groups.count; i++)
        grouped += plan->groups.data[i].count;
    ck_assert_int_eq(grouped, movable);
}

/* Runs of up to eleven contacts with one normal, of which blocks are full at any of them; some of two walls. */
START_TEST(groups_do_not_depend_on_threads)
{
    rig r = packed_fast(6, 6, 0.3, 3);
    r.ctx.threads = pool_create(&r.ctx, 3);
    random_stream random = random_begin(5, 0, 0);
    batch_plan plan = {0};
    for (int round = 0; round < 40; round++) {
        array_clear(&r.contacts);
        while (r.contacts.count < 2300) {
            int32_t a = (int32_t)(random_unit(&random) * r.bodies.count);
            int32_t b = (a + 1 + (int32_t)(random_unit(&random) * 3)) % r.bodies.count;
            contact c = {.a = a, .b = b, .normal = {1, 0, 0}, .friction_static = random_unit(&random)};
            for (int32_t k = (int32_t)(random_unit(&random) * 11); k >= 0; k--)
                ck_assert(array_push(&r.ctx, &r.contacts, c));
        }
        ck_assert(batch_plan_make(&r.ctx, &plan, &r.bodies, &r.contacts));
        assert_groups(&r, &plan);
    }
    batch_plan_free(&r.ctx, &plan);
    pool_free(&r.ctx, r.ctx.threads);
    r.ctx.threads = NULL;
    rig_free(&r);
}
END_TEST

/* What is remembered: contacts that carry something, by ascending keys, equal ones in their order. */
START_TEST(memory_does_not_depend_on_threads)
{
    rig r = packed_fast(30, 30, 0.3, 3);
    r.ctx.threads = pool_create(&r.ctx, 3);
    for (int i = 0; i < 20; i++)
        rig_step(&r);
    ck_assert_int_gt(r.contacts.count, 2000);
    int32_t carriers = 0;
    for (int32_t i = 0; i < r.contacts.count; i++) {
        const contact *c = &r.contacts.data[i];
        int32_t place = 0;
        int32_t row = contact_memory_find(&r.memory, c->key, &place);
        bool carries = c->impulse[0] > 0 && (body_is_dynamic(&r.bodies, c->a) || body_is_dynamic(&r.bodies, c->b));
        ck_assert_msg((row >= 0) == carries, "contact %d", (int)i);
        carriers += carries;
        vec3 impulse = contact_impulse(c);
        if (carries)
            assert_vec3_close(r.memory.on_lower[row], c->a < c->b ? impulse : vec3_neg(impulse), 0);
    }
    ck_assert_int_gt(carriers, 1000);
    ck_assert_int_eq(r.memory.count, carriers);
    for (int32_t i = 1; i < r.memory.count; i++)
        ck_assert(r.memory.key[i - 1] < r.memory.key[i]);
    pool_free(&r.ctx, r.ctx.threads);
    r.ctx.threads = NULL;
    rig_free(&r);
}
END_TEST

/* ---- hubs ---- */

/* Caps that some contacts of plates reach and others do not [N s]. */
static void cap_by_number(rig *r)
{
    int32_t plates = r->bodies.count - 3;
    for (int32_t i = 0; i < r->contacts.count; i++) {
        contact *c = &r->contacts.data[i];
        bool capped = i % 3 == 0 && (c->a >= plates || c->b >= plates);
        c->impulse_limit = capped ? 20 : HUGE_VAL;
    }
}

/* A packed field under two plates side by side, each far beyond a hub's degree: one is free, the other hangs on a
   carriage that drags it along and lets it heave, and touches the first.  Their slots are the last but one, and the one
   before that. */
static rig field_with_hubs(int columns, int rows)
{
    rig r = packed_fast(columns, rows, 0.1, 11);
    int32_t driven = packed_plate(&r, 0, 6, rows, 1e6), loose = packed_plate(&r, 6, 12, rows, 2e6);
    r.bodies.position[driven].x += 0.01; /* into the other */
    r.bodies.added_mass[driven] = vec3_make(1e5, 8e5, 9e5);
    for (int32_t b = 3; b < driven; b++) { /* floes rise against the plates, whose weights hold them down */
        r.bodies.position[b].z = 0;
        r.loads.data[b].force.z = 2000;
    }
    r.loads.data[driven].force = vec3_make(0, 0, -2000.0 * 6 * rows);
    r.loads.data[loose].force = vec3_make(-3e4, 0, -2000.0 * 6 * rows);
    vec3 place = r.bodies.position[driven];
    int32_t carriage = rig_point(&r, MOTION_PRESCRIBED, 1, (sym3){.xx = 1, .yy = 1, .zz = 1}, place);
    r.bodies.velocity[carriage].x = r.bodies.velocity[driven].x = 0.02;
    joint_create(&r.ctx, &r.joints, &r.bodies, carriage, driven, JOINT_PRISMATIC_Z, place, quat_identity());
    r.cap = cap_by_number;
    return r;
}

static void assert_two_hubs(rig *r)
{
    batch_plan plan = {0};
    int32_t capped = 0;
    ck_assert(batch_plan_make(&r->ctx, &plan, &r->bodies, &r->contacts));
    ck_assert_int_eq(plan.hubs.count, 2);
    /* Tasks of each hub, and of what joins them. */
    ck_assert(plan.tasks.count >= 4 && plan.tasks.data[plan.tasks.count - 2].hub == 1);
    ck_assert_int_eq(plan.tasks.data[plan.tasks.count - 1].hub, -1);
    for (int32_t i = 0; i < r->contacts.count; i++)
        capped += r->contacts.data[i].impulse[0] >= r->contacts.data[i].impulse_limit;
    ck_assert_msg(capped > 10 && capped < r->contacts.count / 2, "%d of %d at their cap", capped, r->contacts.count);
    batch_plan_free(&r->ctx, &plan);
}

/* Impulses on a body [N s]. */
static vec3 impulse_on(const rig *r, int32_t slot)
{
    vec3 sum = vec3_make(0, 0, 0);
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        if (c->a == slot || c->b == slot)
            sum = vec3_mad(sum, contact_impulse(c), c->a == slot ? 1 : -1);
    }
    return sum;
}

/* Regions of a packed field. */
static int32_t regions_of(int columns, int rows)
{
    rig r = packed_fast(columns, rows, 0.3, 3);
    rig_detect(&r);
    batch_plan plan = {0};
    ck_assert(batch_plan_make(&r.ctx, &plan, &r.bodies, &r.contacts));
    int32_t chunks = plan.chunks;
    batch_plan_free(&r.ctx, &plan);
    rig_free(&r);
    return chunks;
}

/* A field that is too small for regions of their own, and yet long to sweep, is halved for two threads. */
START_TEST(a_field_that_is_long_to_sweep_is_halved)
{
    ck_assert_int_eq(regions_of(12, 10), 1);
    ck_assert_int_eq(regions_of(20, 17), 2);
}
END_TEST

START_TEST(hubs_move_as_their_contacts_push)
{
    rig r = field_with_hubs(12, 6), s = field_with_hubs(12, 6);
    int32_t carriage = r.bodies.count - 1, loose = carriage - 1, driven = carriage - 2;
    vec3 push = vec3_scale(r.loads.data[loose].force, r.dt);
    s.settings.kind = SOLVER_ACCURATE;
    r.settings.iterations = 2000;
    rig *both[] = {&r, &s};
    for (int i = 0; i < 2; i++) {
        rig_detect(both[i]);
        cap_by_number(both[i]);
        rig_solve(both[i]);
        vec3 gained = vec3_scale(both[i]->bodies.velocity[loose], both[i]->bodies.mass[loose]);
        assert_vec3_close(vec3_sub(gained, push), impulse_on(both[i], loose), 1e-7 * vec3_length(gained));
        double heave = both[i]->bodies.velocity[driven].z * (1e6 + 9e5);
        assert_absolute(heave, impulse_on(both[i], driven).z + r.loads.data[driven].force.z * r.dt, 1e-3);
        assert_absolute(both[i]->bodies.velocity[driven].x, 0.02, 1e-12);
    }
    assert_two_hubs(&r);
    ck_assert_msg(s.report.residual < 1e-9, "%g m/s left by the accurate solver in %d", s.report.residual,
                  s.report.iterations);
    double speed = 0, apart = 0;
    for (int32_t b = 0; b < r.bodies.count; b++) {
        speed = fmax(speed, vec3_length(s.bodies.velocity[b]));
        apart = testing_larger(apart, vec3_length(vec3_sub(r.bodies.velocity[b], s.bodies.velocity[b])));
    }
    ck_assert_msg(apart < 1e-3 * speed && r.report.residual < 1e-3 * speed, "%g of %g m/s apart, %g left", apart, speed,
                  r.report.residual);
    rig_free(&r);
    rig_free(&s);
}
END_TEST

/* ---- the same bits ---- */

/* After some steps of a packed field under two hubs, one of them on a joint.  Two hubs for two steps at least. */
static uint64_t hash_of_run(int threads, isa set, int columns, int rows, int steps)
{
    rig r = field_with_hubs(columns, rows);
    r.ctx.isa = set;
    r.ctx.threads = threads > 1 ? pool_create(&r.ctx, threads) : NULL;
    rig_run(&r, 2);
    assert_two_hubs(&r);
    rig_run(&r, steps - 2); /* the plates rise, and touch fewer */
    uint64_t hash = table_hash(&r.bodies, &body_table_info, 1);
    hash = table_hash(&r.memory, &contact_memory_table_info, hash);
    hash = table_hash(&r.joints, &joint_table_info, hash);
    pool_free(&r.ctx, r.ctx.threads);
    r.ctx.threads = NULL;
    rig_free(&r);
    return hash;
}

START_TEST(bits_do_not_depend_on_threads)
{
    const int threads[] = {2, 3, 4, 8};
    uint64_t one = hash_of_run(1, isa_best(), 40, 34, 4);
    for (int i = 0; i < 4; i++)
        ck_assert_msg(hash_of_run(threads[i], isa_best(), 40, 34, 4) == one, "%d threads", threads[i]);
}
END_TEST

START_TEST(bits_do_not_depend_on_the_instruction_set)
{
    /* The number is that of every compiler and machine; it changes when results are meant to change. */
    for (isa set = ISA_BASELINE; set <= isa_best(); set++) {
        uint64_t hash = hash_of_run(1, set, 12, 10, 20);
        ck_assert_msg(hash == 0x394079350ea009e2ULL, "%s: 0x%llxULL", isa_name(set), (unsigned long long)hash);
    }
}
END_TEST

/* ---- against the others ---- */

START_TEST(long_runs_agree_with_the_reference)
{
    /* Without friction the field is slow to settle for the reference; with it, all contacts come to stick. */
    const struct {
        double friction, tolerance;
        int32_t fast, sequential;
    } cases[] = {{0, 1e-4, 4000, 60000}, {0.3, 1e-8, 400, 40000}};
    for (int i = 0; i < 2; i++) {
        rig r = packed_fast(6, 5, cases[i].friction, 5), s = packed_fast(6, 5, cases[i].friction, 5);
        s.settings.kind = SOLVER_SEQUENTIAL;
        r.settings.iterations = cases[i].fast;
        s.settings.iterations = cases[i].sequential;
        rig_detect(&r);
        rig_detect(&s);
        rig_solve(&r);
        rig_solve(&s);
        for (int32_t b = 3; b < r.bodies.count; b++)
            assert_vec3_close(r.bodies.velocity[b], s.bodies.velocity[b], cases[i].tolerance);
        rig_free(&r);
        rig_free(&s);
    }
}
END_TEST

/* A driven wall of 200 m ploughs into floes, all in a frame that moves with `drift`; impulses on the wall [N s]. */
static vec3 ploughed(double drift, solver_kind kind, int32_t iterations, solver_report *report)
{
    rig r = packed_fast(6, 5, 0.3, 5);
    r.settings.kind = kind;
    r.settings.iterations = iterations;
    int32_t ship = packed_vessel(&r, 5, 1e8, 0.5);
    r.bodies.motion[ship] = MOTION_PRESCRIBED;
    for (int wall = 0; wall < 3; wall++) /* out of the way: driven against walls the floes could go nowhere */
        r.bodies.position[wall].x += 1000;
    for (int32_t b = 0; b < r.bodies.count; b++) {
        r.bodies.velocity[b].y += drift;
    }
    rig_detect(&r);
    rig_solve(&r);
    vec3 sum = vec3_make(0, 0, 0);
    for (int32_t i = 0; i < r.contacts.count; i++) {
        const contact *c = &r.contacts.data[i];
        vec3 t1, t2;
        contact_tangents(c->normal, &t1, &t2);
        double sign = c->a == ship ? 1 : c->b == ship ? -1 : 0;
        sum = vec3_mad(sum, c->normal, sign * c->impulse[0]);
        sum = vec3_mad(vec3_mad(sum, t1, sign * c->impulse[1]), t2, sign * c->impulse[2]);
    }
    *report = r.report;
    rig_free(&r);
    return sum;
}

/* Bodies that nothing moves bring work into the sweeps; the steps between them must know it. */
START_TEST(a_driven_body_meets_what_it_should_in_any_frame)
{
    solver_report sequential, report, other;
    vec3 right = ploughed(0, SOLVER_ACCURATE, 30, &report), slow = ploughed(0, SOLVER_SEQUENTIAL, 30, &sequential);
    vec3 still = ploughed(0, SOLVER_FAST, 30, &report), moving = ploughed(64, SOLVER_FAST, 30, &other);
    double scale = vec3_length(right), error = vec3_length(vec3_sub(still, right));
    ck_assert_msg(scale > 1e5 && fabs(still.x - right.x) < 0.02 * scale, "%g N s, %g off ahead", scale,
                  still.x - right.x);
    ck_assert_msg(error < 0.5 * vec3_length(vec3_sub(slow, right)) && report.residual < 0.5 * sequential.residual,
                  "%g N s off, residual %g m/s; in sequence %g", error, report.residual, sequential.residual);
    assert_vec3_close(moving, still, 1e-6 * scale);
    ck_assert_int_eq(report.iterations, other.iterations);
}
END_TEST

/* A box that slept between two others while velocities were solved, and was woken after that, is pushed apart from both
   as one body: it stays in the middle, as in sequence, on any number of threads. */
START_TEST(a_body_woken_after_the_solve_is_one)
{
    for (solver_kind kind = SOLVER_SEQUENTIAL; kind <= SOLVER_FAST; kind++) {
        rig r = rig_make(0.02);
        r.settings.kind = kind;
        r.gravity = vec3_make(0, 0, 0);
        int32_t slot[3];
        for (int i = 0; i < 3; i++)
            slot[i] = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 1), 900, vec3_make(1.99 * ((i + 1) % 3 - 1), 0, 0));
        r.bodies.motion[slot[0]] = MOTION_ASLEEP;
        rig_detect(&r);
        rig_solve(&r);
        r.bodies.motion[slot[0]] = MOTION_DYNAMIC;
        integrate_poses(&r.ctx, &r.bodies, r.dt);
        rig_correct(&r);
        static const double PLACE[] = {0, 1.998, -1.998};
        for (int i = 0; i < 3; i++)
            assert_absolute(r.bodies.position[slot[i]].x, PLACE[i], 1e-5);
        rig_free(&r);
    }
}
END_TEST

TEST_MAIN("solver_fast", hubs_move_as_their_contacts_push, a_driven_body_meets_what_it_should_in_any_frame,
          batches_share_no_body, regions_of_a_long_field_are_equally_large, groups_do_not_depend_on_threads,
          memory_does_not_depend_on_threads, a_field_that_is_long_to_sweep_is_halved, bits_do_not_depend_on_threads,
          bits_do_not_depend_on_the_instruction_set, a_body_woken_after_the_solve_is_one,
          long_runs_agree_with_the_reference)
