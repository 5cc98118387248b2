/* Reading whole worlds without copies: views that stay readable, outlines in the axes of their bodies.  Vessels by
   their numbers and names, floes of a field by their corners. */
#include "fram/field.h"
#include "fram/live.h"
#include "testing.h"

#include <string.h>
#include <unistd.h>

enum { POINTS = 4000, SLOTS = 400 };

static fram_error e;
static fram_context *ctx;
static fram_scenario *s;
static fram_world *w;
static failing_memory memory_of_test;

static const char scene[] = "run: {duration: 4, time_step: 0.02}\n"
                            "vessel:\n  mode: towed\n  x: -26\n  speed: 3\n  ramp: 0.1\n"
                            "  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice:\n  source: floes\n  thickness: 0.5\n  breakable: true\n  floes:\n"
                            "    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}\n"
                            "    - {length: 40, width: 20, x: 20.5, y: -11}\n"
                            "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}\n";

static const char company[] = "run: {duration: 1, time_step: 0.02}\nvessels:\n"
                              "  - {name: first, mode: free, x: -40, y: 5, hull: {form: box, length: 28, beam: 12}}\n"
                              "  - {name: left_out, present: false, hull: {form: box, length: 48, beam: 12}}\n"
                              "  - {name: second, mode: free, y: -7, hull: {form: box, length: 26, beam: 12}}\n"
                              "  - {name: third, mode: free, x: 40, y: 9, hull: {form: box, length: 30, beam: 8}}\n"
                              "ice: {source: none}\n";

static void open_text(const char *text)
{
    fram_context_definition d;
    fram_context_default(&d);
    (void)failing_context(&memory_of_test, 0);
    d.memory = failing_memory_resize;
    d.memory_user = &memory_of_test;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
}

static void open_world(void) { open_text(scene); }

static void close_world(void)
{
    fram_world_destroy(w);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
    ck_assert_int_eq(memory_of_test.live, 0);
}

static fram_body_view look(const fram_world *from)
{
    fram_body_view v;
    assert_ok(fram_world_view(from, &v, &e), e);
    return v;
}

/* Reads all of a view: what is freed is found by sanitizers. */
static double read_view(const fram_body_view *v)
{
    double sum = 0;
    for (int i = 0; i < 3 * v->slots; i++)
        sum += v->position[i] + v->velocity[i] + v->angular_velocity[i];
    for (int i = 0; i < v->slots; i++)
        sum += v->mass[i] + v->orientation[4 * i] + v->generation[i] + v->lives[i];
    return sum;
}

static bool is_same_view(const fram_body_view *a, const fram_body_view *b)
{
    return a->slots == b->slots && a->position == b->position && a->orientation == b->orientation &&
           a->velocity == b->velocity && a->angular_velocity == b->angular_velocity && a->mass == b->mass &&
           a->generation == b->generation && a->lives == b->lives && a->changes == b->changes;
}

START_TEST(views_are_readable_as_long_as_their_world)
{
    open_world();
    fram_body_view first = look(w), last = first;
    double x = first.position[3];
    int moved = 0, stayed = 0;
    for (int i = 0; i < 120; i++) {
        uint64_t before = *last.changes;
        assert_ok(fram_world_step(w, &e), e);
        bool stays = *last.changes == before; /* as a program tells that need not ask */
        fram_body_view now = look(w);
        ck_assert(now.changes == first.changes && *now.changes == fram_world_shape_changes(w));
        ck_assert(!stays || is_same_view(&now, &last));
        moved += now.position != last.position;
        stayed += stays;
        last = now;
        ck_assert(isfinite(read_view(&first)) && isfinite(read_view(&last)));
    }
    ck_assert_int_gt(stayed, 60);
    ck_assert_int_gt(moved, 0); /* pieces needed more room than the first block had */
    ck_assert_int_gt(last.slots, first.slots);
    fram_body_id vessel;
    fram_body_state state;
    ck_assert(fram_world_vessel(w, &vessel));
    assert_ok(fram_body_state_get(w, vessel, &state, &e), e);
    assert_array_bits(&last.position[3 * vessel.slot], state.position, 3);
    /* A state that is loaded into a world takes the place of the one that was shown, where it has the room. */
    fram_world *fresh;
    void *data;
    size_t size;
    assert_ok(fram_world_create(s, &fresh, &e), e);
    assert_ok(fram_world_save_memory(fresh, &data, &size, &e), e);
    uint64_t hash = fram_world_hash(fresh);
    for (int i = 0; i < 3; i++) {
        assert_ok(fram_world_load_memory(w, data, size, &e), e);
        ck_assert(fram_world_hash(w) == hash && look(w).position == last.position);
        assert_bits(look(w).position[3], x);
        assert_ok(fram_world_step(w, &e), e);
    }
    /* One that needs more room than what was shown. */
    fram_data_free(ctx, data);
    first = look(fresh);
    for (int i = 0; i < 120; i++)
        assert_ok(fram_world_step(w, &e), e);
    assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
    assert_ok(fram_world_load_memory(fresh, data, size, &e), e);
    ck_assert(fram_world_hash(w) == fram_world_hash(fresh));
    ck_assert(look(fresh).position != first.position && isfinite(read_view(&first)));
    assert_ok(fram_world_step(w, &e), e);
    assert_ok(fram_world_step(fresh, &e), e);
    ck_assert(fram_world_hash(w) == fram_world_hash(fresh));
    fram_data_free(ctx, data);
    fram_world_destroy(fresh);
    close_world();
}
END_TEST

static int32_t offset[SLOTS + 1], before[SLOTS + 1];
static double xy[2 * POINTS], old[2 * POINTS], outline[2 * POINTS];

/* What fram_world_shapes gives, turned and moved by the view, is what fram_body_outline gives. */
static void assert_shapes_are_outlines(int points)
{
    fram_body_view v = look(w);
    for (int i = 0; i < v.slots; i++) {
        fram_body_id id;
        int count = offset[i + 1] - offset[i];
        ck_assert(fram_world_body(w, i, &id) || count == 0);
        ck_assert_int_eq(v.lives[i] ? fram_body_outline(w, id, outline, POINTS) : 0, count);
        const double *q = &v.orientation[4 * i], *p = &v.position[3 * i];
        double r[2][2] = {{1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3])},
                          {2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3])}};
        for (int k = 0; k < count; k++) {
            const double *at = &xy[2 * (offset[i] + k)];
            for (int axis = 0; axis < 2; axis++)
                assert_absolute(p[axis] + r[axis][0] * at[0] + r[axis][1] * at[1], outline[2 * k + axis], 1e-9);
        }
    }
    ck_assert_int_eq(offset[v.slots], points);
}

START_TEST(shapes_stay_until_their_number_changes)
{
    open_world();
    int changed = 0, broke = 0, points = fram_world_shapes(w, offset, SLOTS + 1, xy, POINTS);
    uint64_t number = fram_world_shape_changes(w);
    for (int i = 0; i < 120; i++) {
        assert_ok(fram_world_step(w, &e), e);
        memcpy(before, offset, sizeof before);
        memcpy(old, xy, sizeof old);
        int now = fram_world_shapes(w, offset, SLOTS + 1, xy, POINTS), slots = fram_world_slots(w);
        ck_assert(now < POINTS && slots < SLOTS);
        if (fram_world_shape_changes(w) == number) {
            ck_assert(now == points && fram_world_fractures(w, NULL, 0) == 0);
            ck_assert_int_eq(memcmp(before, offset, ((size_t)slots + 1) * sizeof *offset), 0);
            ck_assert_int_eq(memcmp(old, xy, 2 * (size_t)now * sizeof *xy), 0);
        }
        changed += fram_world_shape_changes(w) != number;
        broke += fram_world_fractures(w, NULL, 0) > 0;
        number = fram_world_shape_changes(w);
        points = now;
    }
    ck_assert(broke > 0 && changed >= broke && changed < 120);
    assert_shapes_are_outlines(points);
    /* Rooms that are too small, and none. */
    xy[6] = -77;
    offset[2] = -77;
    ck_assert_int_eq(fram_world_shapes(w, offset, 2, xy, 3), points);
    ck_assert(offset[2] == -77);
    assert_bits(xy[6], -77);
    ck_assert_int_eq(fram_world_shapes(w, NULL, INT32_MAX, NULL, INT32_MAX), points);
    ck_assert_int_eq(fram_world_shapes(w, offset, -1, xy, -1), points);
    ck_assert(fram_world_shapes(NULL, offset, 2, xy, 3) == 0 && fram_world_shape_changes(NULL) == 0);
    /* A state that is loaded is another one, even when it is the same. */
    void *data;
    size_t size;
    assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
    for (int i = 0; i < 2; i++) {
        assert_ok(fram_world_load_memory(w, data, size, &e), e);
        ck_assert(fram_world_shape_changes(w) > number);
        number = fram_world_shape_changes(w);
    }
    fram_data_free(ctx, data);
    close_world();
}
END_TEST

/* Those that are present, in the order of the scenario. */
START_TEST(vessels_are_found_by_number_and_name)
{
    static const char *const names[3] = {"first", "second", "third"};
    static const double place[3][2] = {{-40, 5}, {0, -7}, {40, 9}};
    open_text(company);
    ck_assert_int_eq(fram_world_vessels(w), 3);
    for (int i = 0; i < 3; i++) {
        fram_body_id id, named;
        fram_body_state state;
        ck_assert_str_eq(fram_world_vessel_name(w, i), names[i]);
        ck_assert(fram_world_vessel_at(w, i, &id) && fram_world_vessel_named(w, names[i], &named));
        ck_assert(id.slot == named.slot && id.generation == named.generation);
        assert_ok(fram_body_state_get(w, id, &state, &e), e);
        assert_array_absolute(state.position, place[i], 2, 1e-9);
    }
    fram_body_id none;
    ck_assert(!fram_world_vessel_named(w, "left_out", &none) && !fram_world_vessel_at(w, 3, &none));
    ck_assert_ptr_null(fram_world_vessel_name(w, 3));
    close_world();
}
END_TEST

/* Every corner of a rectangle once, counterclockwise. */
START_TEST(a_floe_of_a_field_has_its_corners)
{
    static const double corner[8] = {3, 4, 13, 4, 13, 9, 3, 9};
    char path[] = "/tmp/fram_outline_XXXXXX";
    FILE *file = fdopen(mkstemp(path), "w");
    ck_assert_ptr_nonnull(file);
    fputs("3 4\n13 4\n13 9\n3 9\n\n30 4\n35 4\n30 8\n\n", file);
    ck_assert_int_eq(fclose(file), 0);
    fram_field *f;
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    assert_ok(fram_field_load(ctx, path, NULL, &f, &e), e);
    double found[10];
    found[4] = -77;
    ck_assert(fram_field_outline(f, 0, found, 2) == 4 && fram_field_outline(f, 1, NULL, 0) == 3);
    assert_bits(found[4], -77);
    ck_assert_int_eq(fram_field_outline(f, 0, found, 5), 4);
    int first = 0;
    while (first < 3 && (found[0] != corner[2 * first] || found[1] != corner[2 * first + 1]))
        first++;
    for (int i = 0; i < 4; i++)
        assert_array_absolute(&found[2 * i], &corner[2 * ((first + i) % 4)], 2, 1e-12);
    fram_field_destroy(f);
    fram_context_destroy(ctx);
    unlink(path);
}
END_TEST

TEST_MAIN("views", views_are_readable_as_long_as_their_world, shapes_stay_until_their_number_changes,
          vessels_are_found_by_number_and_name, a_floe_of_a_field_has_its_corners)
