#include "base/random.h"
#include "bodies/energy.h"
#include "books.h"
#include "testing.h"

START_TEST(slots_are_used_again_lowest_first)
{
    context ctx;
    context_init(&ctx);
    body_table b = {0};
    for (int32_t i = 0; i < 20; i++)
        ck_assert_int_eq(body_create(&ctx, &b, MOTION_DYNAMIC, MATERIAL_ICE), i);
    ck_assert_uint_eq(b.generation[5], 1);
    b.mass[5] = 7;
    body_remove(&b, 11);
    body_remove(&b, 5);
    ck_assert(!body_is_alive(&b, 5) && body_is_alive(&b, 6));
    assert_bits(b.mass[5], 0);
    ck_assert_int_eq(body_create(&ctx, &b, MOTION_STATIC, MATERIAL_WALL), 5);
    ck_assert_int_eq(body_create(&ctx, &b, MOTION_PRESCRIBED, MATERIAL_HULL), 11);
    ck_assert_int_eq(body_create(&ctx, &b, MOTION_DYNAMIC, MATERIAL_ICE), 20);
    ck_assert_uint_eq(b.generation[5], 2);
    ck_assert_int_eq(b.material[5], MATERIAL_WALL);
    ck_assert_int_eq(b.shape[5], -1);
    ck_assert_int_eq(b.owner[5], -1);
    assert_bits(b.orientation[5].w, 1);
    ck_assert(!body_is_dynamic(&b, 5) && !body_is_dynamic(&b, 11) && body_is_dynamic(&b, 20));
    table_free(&ctx, &b, &body_table_info);
}
END_TEST

/* Against a look at each, over parts of all lengths. */
START_TEST(what_moves_is_found_among_what_rests)
{
    enum { SLOTS = 300 };
    context ctx;
    context_init(&ctx);
    body_table b = {0};
    random_stream draw = random_begin(11, 0, 0);
    static const motion kinds[] = {MOTION_STATIC,     MOTION_ASLEEP,  MOTION_NONE,
                                   MOTION_PRESCRIBED, MOTION_DYNAMIC, MOTION_CARRIED};
    ck_assert(table_resize(&ctx, &b, &body_table_info, SLOTS));
    for (int round = 0; round < 40; round++) {
        /* From hardly any that moves to many. */
        double moving = 0.001 * (1 << round % 10);
        for (int32_t i = 0; i < SLOTS; i++) {
            bool moves = random_uniform(&draw, 0, 1) < moving;
            b.motion[i] = (uint8_t)kinds[(moves ? 3 : 0) + (int)random_uniform(&draw, 0, 2.999)];
        }
        for (int32_t first = 0; first <= SLOTS; first++) {
            int32_t end = (int32_t)random_uniform(&draw, first, SLOTS + 0.999), next = first;
            bool taken = true;
            while (next < end && (b.motion[next] == MOTION_NONE || b.motion[next] == MOTION_STATIC ||
                                  b.motion[next] == MOTION_ASLEEP))
                next++;
            for (int32_t i = first; i < end; i++)
                taken = taken && body_is_alive(&b, i);
            ck_assert_int_eq(body_next_moving(&b, first, end), next);
            ck_assert_int_eq(body_slots_are_taken(&b, first, end), taken);
            ck_assert_int_eq(body_slots_stand(&b, first, end), next == end);
        }
    }
    memset(b.motion, MOTION_ASLEEP, SLOTS);
    for (int32_t i = 0; i < SLOTS; i += 37) { /* one of them on ice that drifts */
        b.velocity[i].y = 1e-300;
        ck_assert(!body_slots_stand(&b, 0, SLOTS) && body_slots_stand(&b, 0, i) && body_slots_stand(&b, i + 1, SLOTS));
        b.velocity[i].y = 0;
    }
    table_free(&ctx, &b, &body_table_info);
}
END_TEST

START_TEST(a_removed_body_leaves_no_trace_but_its_generation)
{
    context ctx;
    context_init(&ctx);
    body_table a = {0}, b = {0};
    for (int i = 0; i < 2; i++) {
        body_create(&ctx, &a, MOTION_DYNAMIC, MATERIAL_ICE);
        body_create(&ctx, &b, MOTION_DYNAMIC, MATERIAL_ICE);
    }
    a.velocity[1] = vec3_make(1, 2, 3);
    a.inertia[1].xy = 4;
    body_remove(&a, 1);
    body_remove(&b, 1);
    ck_assert(table_hash(&a, &body_table_info, 1) == table_hash(&b, &body_table_info, 1));
    table_free(&ctx, &a, &body_table_info);
    table_free(&ctx, &b, &body_table_info);
}
END_TEST

START_TEST(frames_and_velocities)
{
    context ctx;
    context_init(&ctx);
    body_table b = {0};
    int32_t s = body_create(&ctx, &b, MOTION_DYNAMIC, MATERIAL_ICE);
    b.position[s] = vec3_make(10, 20, 30);
    b.orientation[s] = quat_from_roll_pitch_yaw(0, 0, 1.5707963267948966);
    vec3 p = body_to_global(&b, s, vec3_make(1, 2, 3));
    assert_vec3_close(p, vec3_make(8, 21, 33), 1e-14);
    assert_vec3_close(body_to_local(&b, s, p), vec3_make(1, 2, 3), 1e-14);
    b.velocity[s] = vec3_make(1, 0, 0);
    b.angular_velocity[s] = vec3_make(0, 0, 2);
    assert_vec3_close(body_point_velocity(&b, s, vec3_make(10, 21, 30)), vec3_make(-1, 0, 0), 1e-15);
    wrench w = {{0, 0, 0}, {0, 0, 0}};
    wrench_add(&w, b.position[s], vec3_make(0, 5, 0), vec3_make(12, 20, 30));
    assert_vec3_close(w.moment, vec3_make(0, 0, 10), 1e-14);
    table_free(&ctx, &b, &body_table_info);
}
END_TEST

START_TEST(books_add_up)
{
    context ctx;
    context_init(&ctx);
    body_table b = {0};
    for (int i = 0; i < 3; i++) {
        int32_t s = body_create(&ctx, &b, i < 2 ? MOTION_DYNAMIC : MOTION_PRESCRIBED, MATERIAL_ICE);
        b.mass[s] = 2 + i;
        b.velocity[s] = vec3_make(3, 0, 0);
    }
    b.position[1] = vec3_make(0, 4, 0);
    b.inertia[1] = (sym3){.xx = 1, .yy = 2, .zz = 5};
    b.orientation[1] = quat_from_roll_pitch_yaw(1.5707963267948966, 0, 0); /* body z lies along -y */
    b.angular_velocity[1] = vec3_make(0, 2, 0);
    body_books sum = body_books_of(&b);
    assert_absolute(sum.mass, 5, 0);
    assert_absolute(sum.kinetic_energy, 0.5 * 5 * 9 + 0.5 * 5 * 4, 1e-13);
    assert_vec3_close(sum.momentum, vec3_make(15, 0, 0), 1e-14);
    assert_vec3_close(sum.angular_momentum, vec3_make(0, 10, -36), 1e-13);
    table_free(&ctx, &b, &body_table_info);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        body_table b = {0};
        int32_t slot = 0;
        for (int i = 0; i < 100 && slot >= 0; i++)
            slot = body_create(&turn.ctx, &b, MOTION_DYNAMIC, MATERIAL_ICE);
        table_free(&turn.ctx, &b, &body_table_info);
        ck_assert(slot == 99 || slot == -1);
        turn.status = slot == 99 ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

/* By each kernel, of bodies that turn, with a group that is not full, a static body and a slot that was left. */
START_TEST(kinetic_energy_is_that_of_the_books)
{
    context ctx;
    context_init(&ctx);
    body_table b = {0};
    random_stream random = random_begin(3, 0, 0);
    for (int32_t i = 0; i < 21; i++) {
        int32_t s = body_create(&ctx, &b, i % 5 == 3 ? MOTION_STATIC : MOTION_DYNAMIC, MATERIAL_ICE);
        double draw[16];
        for (int k = 0; k < 16; k++)
            draw[k] = random_uniform(&random, -0.5, 0.5);
        b.mass[s] = 1e5 * (1 + draw[0]);
        b.inertia[s] = (sym3){1e6 * (2 + draw[1]), 1e6 * (2 + draw[2]), 1e6 * (2 + draw[3]),
                              1e5 * draw[4],       1e5 * draw[5],       1e5 * draw[6]};
        b.velocity[s] = vec3_make(draw[7], draw[8], draw[9]);
        b.angular_velocity[s] = vec3_make(draw[10], draw[11], draw[12]);
        b.orientation[s] = quat_from_roll_pitch_yaw(draw[13], draw[14], 6 * draw[15]);
    }
    body_remove(&b, 9);
    /* A group of eight that sleeps on ice that drifts, and one that stands. */
    for (int32_t i = 8; i < b.count; i++) {
        if (!body_is_alive(&b, i))
            continue;
        b.motion[i] = MOTION_ASLEEP;
        b.angular_velocity[i] = vec3_make(0, 0, 0);
        b.velocity[i] = vec3_make(i < 16 ? 0.5 : 0, 0, 0);
    }
    double energy = body_books_of(&b).kinetic_energy;
    ck_assert(energy > 1e5);
    for (isa i = ISA_BASELINE; i <= isa_best(); i++) {
        ctx.isa = i;
        assert_bits(body_kinetic_energy(&ctx, &b), energy);
    }
    table_free(&ctx, &b, &body_table_info);
}
END_TEST

TEST_MAIN("body", slots_are_used_again_lowest_first, what_moves_is_found_among_what_rests,
          a_removed_body_leaves_no_trace_but_its_generation, frames_and_velocities, books_add_up,
          kinetic_energy_is_that_of_the_books, memory_runs_out)
