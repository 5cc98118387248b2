/* Assertions about slots and shapes stop a build that has them. */
#include "bodies/body.h"
#include "bodies/shape.h"
#include "testing.h"

typedef struct broken {
    context ctx;
    body_table bodies;
    shape_store shapes;
    int32_t number;
} broken;

static void make(void *user)
{
    broken *b = user;
    (void)body_create(&b->ctx, &b->bodies, (motion)b->number, MATERIAL_ICE);
}

static void remove_body(void *user) { body_remove(&((broken *)user)->bodies, ((broken *)user)->number); }

static void remove_shape(void *user) { shape_remove(&((broken *)user)->shapes, ((broken *)user)->number); }

static void piece(void *user) { (void)shape_piece(&((broken *)user)->shapes, 0, ((broken *)user)->number); }

START_TEST(what_is_not_there_stops_the_program)
{
    broken b = {.number = MOTION_DYNAMIC};
    fram_error error = {0};
    context_init(&b.ctx);
    make(&b);
    ck_assert(!testing_aborts(make, &b));
    b.number = MOTION_NONE;
    assert_aborts(make, &b);
    b.number = 1;
    assert_aborts(remove_body, &b);
    b.number = -1;
    assert_aborts(remove_body, &b);
    b.number = 0;
    ck_assert(!testing_aborts(remove_body, &b));
    remove_body(&b);
    assert_aborts(remove_body, &b); /* twice */

    const vec2 corner[4] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
    overlay *plane = overlay_create(&b.ctx);
    int32_t row = -1;
    ck_assert_ptr_nonnull(plane);
    assert_ok(shape_add_prism(&b.ctx, &b.shapes, plane, (polygon){corner, 4}, 0.5, 0, &row, &error), error);
    ck_assert_int_eq(row, 0);
    ck_assert(!testing_aborts(piece, &b) && !testing_aborts(remove_shape, &b));
    b.number = 1;
    assert_aborts(piece, &b);
    assert_aborts(remove_shape, &b);
    b.number = -1;
    assert_aborts(piece, &b);
    assert_aborts(remove_shape, &b);
    overlay_free(plane);
    table_free(&b.ctx, &b.bodies, &body_table_info);
    shape_store_free(&b.ctx, &b.shapes);
}
END_TEST

TEST_MAIN_OF_ASSERTIONS("assertions", what_is_not_there_stops_the_program)
