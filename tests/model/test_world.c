/* model/world: the list of tables, life, hash, copy, difference. */
#include "model/world.h"
#include "testing.h"

static context ctx;
static fram_error error;
static const model no_vessels;

/* Some rows in every table, every number of them another. */
static void fill(world *w)
{
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(w, tables);
    unsigned char byte = 1;
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        const table_head *head = tables[t].table;
        ck_assert(table_resize(&ctx, tables[t].table, tables[t].info, t == 0 ? 1 : 3 + t));
        for (int f = 0; f < tables[t].info->field_count; f++) {
            const field_info *field = &tables[t].info->fields[f];
            unsigned char *data = table_field(tables[t].table, field);
            for (size_t i = 0; i < (size_t)head->count * field->size; i++)
                data[i] = byte++ & 0x3f;
        }
    }
}

START_TEST(every_table_of_the_state_is_listed_once)
{
    context_init(&ctx);
    static const char *const names[] = {
        "clock",      "body",         "shape",          "piece",        "shape_vertex",   "floe",
        "vessel",     "joint",        "pair",           "broad",        "contact_memory", "load_window",
        "recorded",   "line",         "thruster",       "waypoint",     "station",        "event",
        "feeding",    "pattern",      "pattern_vertex", "input",        "hull_contact",   "drift",
        "drift_cell", "drift_vertex", "propulsion",     "course",       "approach",       "edge_load",
        "held_drag",  "edge_support", "hull_retreat",   "pattern_copy", "flooding",       "rest"};
    ck_assert_int_eq(sizeof names / sizeof *names, WORLD_TABLE_COUNT);
    world w;
    world_table tables[WORLD_TABLE_COUNT];
    assert_ok(world_init(&ctx, &no_vessels, &w, &error), error);
    world_tables(&w, tables);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        ck_assert_str_eq(tables[t].info->name, names[t]);
        for (int u = 0; u < t; u++)
            ck_assert(tables[t].table != tables[u].table && tables[t].info != tables[u].info);
    }
    ck_assert_int_eq(w.clock.count, 1);
    ck_assert(w.clock.step[0] == 0);
    world_free(&ctx, &w);
    world_free(&ctx, &w);
}
END_TEST

START_TEST(the_hash_sees_every_byte_of_the_state)
{
    context_init(&ctx);
    world w;
    assert_ok(world_init(&ctx, &no_vessels, &w, &error), error);
    fill(&w);
    world_table tables[WORLD_TABLE_COUNT];
    world_tables(&w, tables);
    uint64_t hash = world_hash(&w);
    ck_assert(world_hash(&w) == hash);
    for (int t = 0; t < WORLD_TABLE_COUNT; t++) {
        const table_head *head = tables[t].table;
        for (int f = 0; f < tables[t].info->field_count; f++) {
            const field_info *field = &tables[t].info->fields[f];
            unsigned char *data = table_field(tables[t].table, field);
            for (size_t i = 0; i < (size_t)head->count * field->size; i++) {
                data[i] ^= 0x80;
                /* What the record knows is no part of what is simulated. */
                ck_assert_msg((world_hash(&w) == hash) == (tables[t].info == &recorded_table_info), "%s.%s byte %zu",
                              tables[t].info->name, field->name, i);
                data[i] ^= 0x80;
            }
        }
    }
    ck_assert(world_hash(&w) == hash);
    world_free(&ctx, &w);
}
END_TEST

START_TEST(a_copy_is_equal_and_apart)
{
    context_init(&ctx);
    world a, b;
    char text[WORLD_DIFFERENCE_SIZE];
    assert_ok(world_init(&ctx, &no_vessels, &a, &error), error);
    assert_ok(world_init(&ctx, &no_vessels, &b, &error), error);
    ck_assert(!world_difference(&a, &b, text));
    ck_assert_str_eq(text, "");
    fill(&a);
    ck_assert(world_difference(&a, &b, text));
    assert_ok(world_copy_state(&ctx, &b, &a, &error), error);
    ck_assert(!world_difference(&a, &b, text));
    ck_assert(world_hash(&a) == world_hash(&b));
    a.bodies.velocity[2].y = 0.125;
    ck_assert(world_hash(&a) != world_hash(&b));
    world_free(&ctx, &a);
    ck_assert(world_hash(&b) != 0);
    world_free(&ctx, &b);
}
END_TEST

START_TEST(the_first_difference_is_named)
{
    context_init(&ctx);
    world a, b;
    char text[WORLD_DIFFERENCE_SIZE];
    assert_ok(world_init(&ctx, &no_vessels, &a, &error), error);
    assert_ok(world_init(&ctx, &no_vessels, &b, &error), error);
    fill(&a);
    assert_ok(world_copy_state(&ctx, &b, &a, &error), error);
    a.bodies.velocity[2].y = 0.125;
    b.bodies.velocity[2].y = -3;
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "body[2].velocity[1]: 0.125 and -3");
    a.bodies.generation[1] = 4000000000u;
    b.bodies.velocity[2].y = 0.125;
    b.bodies.generation[1] = 7;
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "body[1].generation[0]: 4000000000 and 7");
    b.bodies.generation[1] = 4000000000u;
    a.clock.step[0] = -1;
    b.clock.step[0] = 1;
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "clock[0].step[0]: -1 and 1");
    b.clock.step[0] = -1;
    a.memory.key[0] = UINT64_MAX;
    b.memory.key[0] = 0;
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "contact_memory[0].key[0]: 18446744073709551615 and 0");
    b.memory.key[0] = UINT64_MAX;
    a.bodies.motion[0] = 1;
    b.bodies.motion[0] = 2;
    a.bodies.shape[0] = b.bodies.shape[0] = -1;
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "body[0].motion[0]: 1 and 2");
    b.bodies.motion[0] = 1;
    a.bodies.shape[0] = 5;
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "body[0].shape[0]: 5 and -1");
    b.bodies.shape[0] = 5;
    ck_assert(!world_difference(&a, &b, text));
    ck_assert(table_resize(&ctx, &a.floes, &floe_table_info, 100));
    ck_assert(world_difference(&a, &b, text));
    ck_assert_str_eq(text, "floe: 100 and 8 rows");
    world_free(&ctx, &a);
    world_free(&ctx, &b);
}
END_TEST

START_TEST(a_copied_world_stands_by_itself)
{
    context_init(&ctx);
    world a, b;
    char text[WORLD_DIFFERENCE_SIZE];
    assert_ok(world_init(&ctx, &no_vessels, &a, &error), error);
    fill(&a);
    const contact touch = {.a = 3, .b = 4, .depth = 0.5};
    ck_assert(array_push(&ctx, &a.scratch.contacts, touch));
    uint64_t hash = world_hash(&a);
    assert_ok(world_copy(&ctx, &a, &b, &error), error);
    ck_assert(!world_difference(&a, &b, text));
    ck_assert(world_hash(&b) == hash);
    ck_assert_ptr_eq(b.shapes.solids, &no_vessels.solids);
    ck_assert_int_eq(b.scratch.contacts.count, 1);
    ck_assert(memcmp(&b.scratch.contacts.data[0], &touch, sizeof touch) == 0);
    ck_assert_ptr_ne(b.scratch.solve, a.scratch.solve);
    world_free(&ctx, &a);
    ck_assert(world_hash(&b) == hash);
    world_free(&ctx, &b);
}
END_TEST

START_TEST(memory_runs_out)
{
    world source;
    context_init(&ctx);
    assert_ok(world_init(&ctx, &no_vessels, &source, &error), error);
    fill(&source);
    ck_assert(array_push(&ctx, &source.scratch.contacts, (contact){.a = 1}));
    for (failing_turn turn = {0}; failing_next(&turn);) {
        world w, copy;
        turn.status = world_init(&turn.ctx, &no_vessels, &w, &error);
        if (turn.status == FRAM_OK)
            turn.status = world_copy_state(&turn.ctx, &w, &source, &error);
        if (turn.status == FRAM_OK) {
            turn.status = world_copy(&turn.ctx, &source, &copy, &error);
            if (turn.status == FRAM_OK)
                world_free(&turn.ctx, &copy);
        }
        world_free(&turn.ctx, &w);
    }
    world_free(&ctx, &source);
}
END_TEST

TEST_MAIN("world", every_table_of_the_state_is_listed_once, the_hash_sees_every_byte_of_the_state,
          a_copy_is_equal_and_apart, a_copied_world_stands_by_itself, the_first_difference_is_named, memory_runs_out)
