/* What is packed into the blocks of a record is what is unpacked, in the layout that io/record_layout.h tells. */
#include "testing.h"

#include "io/record_blocks.h"

static context ctx;

/* Of a map, where f32 alone has half metres. */
static const vec2 origin = {500000, 7000000};

static record_stream unpacker(const byte_array *bytes, size_t size)
{
    record_block block = {.size = size, .data = bytes->data};
    return record_unpacker(&block, origin);
}

/* All of it was read, and nothing beyond. */
static void assert_at_end(const record_stream *s)
{
    ck_assert(!s->unsound);
    ck_assert_ptr_eq(s->at, s->end);
}

static const record_solid solid = {7, 3, 3, 1};
static const vec3 point[3] = {{0, 0, 0}, {2.5, 0, -1}, {0, 1.25, 4}};
static const int32_t face[3] = {0, 2, 1};

static void pass_solid(record_stream *s, record_solid *b, vec3 *points, int32_t corner[3])
{
    record_stream_solid(s, b);
    for (int i = 0; i < 3; i++)
        record_stream_point(s, &points[i]);
    record_stream_face(s, corner);
}

START_TEST(solids_come_back)
{
    context_init(&ctx);
    byte_array bytes = {0};
    record_solid b = solid, back = {0};
    vec3 points[3] = {point[0], point[1], point[2]}, points_back[3] = {0};
    int32_t corner[3] = {face[0], face[1], face[2]}, corner_back[3] = {0};
    record_stream s = record_packer(&ctx, &bytes, origin);
    pass_solid(&s, &b, points, corner);
    ck_assert(!s.full);
    ck_assert_int_eq(bytes.count, 16 + 3 * 12 + 12);
    s = unpacker(&bytes, (size_t)bytes.count);
    pass_solid(&s, &back, points_back, corner_back);
    assert_at_end(&s);
    ck_assert(back.slot == 7 && back.generation == 3 && back.vertices == 3 && back.faces == 1);
    for (int i = 0; i < 3; i++) {
        assert_vec3_close(points_back[i], point[i], 0);
        ck_assert_int_eq(corner_back[i], face[i]);
    }
    array_free(&ctx, &bytes);
}
END_TEST

static const record_birth birth = {5, 2, 1, false, true, false, 0.75, 910, 41, 12, 3};
static const vec2 corner_of_floe[3] = {{-2, -1}, {2, -1}, {0, 2}};
static const vec3 pose_of_floe = {500321.5, 6999870.25, -0.125};

static void pass_birth(record_stream *s, record_birth *b, vec2 *corner, vec3 *position, quat *orientation)
{
    record_stream_birth(s, b);
    for (int i = 0; i < 3; i++)
        record_stream_corner(s, &corner[i]);
    record_stream_pose(s, position, orientation);
}

START_TEST(births_come_back)
{
    context_init(&ctx);
    byte_array bytes = {0};
    int32_t count = 0;
    record_birth b = birth, back = {0};
    vec2 corner[3] = {corner_of_floe[0], corner_of_floe[1], corner_of_floe[2]}, corner_back[3] = {0};
    vec3 position = pose_of_floe, position_back = {0, 0, 0};
    quat orientation = quat_identity(), orientation_back = {0};
    record_stream s = record_packer(&ctx, &bytes, origin);
    record_stream_count(&s, &count);
    pass_birth(&s, &b, corner, &position, &orientation);
    record_stream_set_count(&s, BLOCK_BIRTHS, 1);
    ck_assert(!s.full);
    ck_assert_int_eq(bytes.count, 4 + 32 + 3 * 8 + RECORD_POSE_SIZE);
    const unsigned char kind[4] = {1, 0, 1, 0}; /* material, moves, breakable, level ice */
    ck_assert_mem_eq(bytes.data + 4 + 8, kind, sizeof kind);

    s = unpacker(&bytes, (size_t)bytes.count);
    record_stream_count(&s, &count);
    pass_birth(&s, &back, corner_back, &position_back, &orientation_back);
    assert_at_end(&s);
    ck_assert(count == 1 && back.slot == 5 && back.generation == 2 && back.material == 1 && back.vertices == 3);
    ck_assert(!back.moves && back.breakable && !back.level && back.number == 41 && back.parent == 12);
    ck_assert(back.thickness == 0.75 && back.density == 910);
    for (int i = 0; i < 3; i++)
        assert_vec2_close(corner_back[i], corner_of_floe[i], 0);
    assert_vec3_close(position_back, pose_of_floe, 0);
    ck_assert(orientation_back.w == 1);
    array_free(&ctx, &bytes);
}
END_TEST

START_TEST(breaks_and_forces_come_back)
{
    context_init(&ctx);
    byte_array bytes = {0};
    int32_t count = 0;
    record_fracture f = {12.1, 2, 41, 3, {500010.5, 7000020.25, 0}, 1.5e6, 12.25, 320.5}, back = {0};
    record_stream s = record_packer(&ctx, &bytes, origin);
    record_stream_padded_count(&s, &count);
    record_stream_fracture(&s, &f);
    record_stream_set_count(&s, BLOCK_FRACTURES, 1);
    ck_assert_int_eq(bytes.count, 8 + 48);
    s = unpacker(&bytes, (size_t)bytes.count);
    record_stream_padded_count(&s, &count);
    record_stream_fracture(&s, &back);
    assert_at_end(&s);
    ck_assert(count == 1 && back.time == 12.1 && back.kind == 2 && back.floe == 41 && back.pieces == 3);
    assert_vec3_close(back.place, vec3_make(500010.5, 7000020.25, 0), 0);
    ck_assert(back.load == 1.5e6 && back.crack_length == 12.25 && back.area == 320.5);

    record_force force = {RECORD_FORCE_THRUSTER, 4, {499999.5, 7000001.25, -6}, {8e5, -2.5e5, 125}}, again = {0};
    s = record_packer(&ctx, &bytes, origin);
    record_stream_padded_count(&s, &count);
    record_stream_force(&s, &force);
    ck_assert_int_eq(bytes.count, FORCES_HEAD_SIZE + RECORD_FORCE_SIZE);
    s = unpacker(&bytes, (size_t)bytes.count);
    record_stream_padded_count(&s, &count);
    record_stream_force(&s, &again);
    assert_at_end(&s);
    ck_assert(again.kind == RECORD_FORCE_THRUSTER && again.which == 4);
    assert_vec3_close(again.point, force.point, 0);
    assert_vec3_close(again.force, force.force, 0);
    array_free(&ctx, &bytes);
}
END_TEST

START_TEST(frames_come_back)
{
    context_init(&ctx);
    byte_array bytes = {0};
    record_frame_head head = {120, 12.05, {1.1e6, -3, 0.5}, 0}, back = {0};
    record_moving still = {pose_of_floe, quat_identity(), 0}, touched = {pose_of_floe, quat_identity(), 2e6}, m = {0};
    record_stream s = record_packer(&ctx, &bytes, origin);
    record_stream_frame(&s, &head);
    ck_assert_int_eq(bytes.count, FRAME_HEAD_SIZE);
    record_stream_moving(&s, BLOCK_FRAME, &still);
    ck_assert_int_eq(bytes.count, FRAME_HEAD_SIZE + RECORD_POSE_SIZE);
    record_stream_moving(&s, BLOCK_FRAME, &touched);
    ck_assert_int_eq(bytes.count, FRAME_HEAD_SIZE + RECORD_POSE_SIZE + RECORD_TOUCHED_SIZE);
    record_stream_set_count(&s, BLOCK_FRAME, 2);

    s = unpacker(&bytes, (size_t)bytes.count);
    record_stream_frame(&s, &back);
    ck_assert(back.step == 120 && back.time == 12.05 && back.count == 2);
    assert_vec3_close(back.ice_force, head.ice_force, 0);
    record_stream_moving(&s, BLOCK_FRAME, &m);
    ck_assert(m.contact_force == 0);
    record_stream_moving(&s, BLOCK_FRAME, &m);
    assert_vec3_close(m.position, pose_of_floe, 0);
    assert_relative(m.contact_force, 2e6, 1.0 / 2048);
    assert_at_end(&s);
    array_free(&ctx, &bytes);
}
END_TEST

/* Whatever is asked for beyond the end of a block, and lengths that it has no room for. */
START_TEST(what_a_block_does_not_hold_is_unsound)
{
    context_init(&ctx);
    byte_array bytes = {0};
    record_birth b = birth, back;
    vec2 corner[3] = {corner_of_floe[0], corner_of_floe[1], corner_of_floe[2]};
    vec3 position = pose_of_floe;
    quat orientation = quat_identity();
    record_stream s = record_packer(&ctx, &bytes, origin);
    pass_birth(&s, &b, corner, &position, &orientation);
    for (size_t size = 0; size <= (size_t)bytes.count; size++) {
        s = unpacker(&bytes, size);
        record_stream_birth(&s, &back);
        ck_assert_msg(s.unsound == (size < 32 + 3 * 8), "%zu bytes, before the corners", size);
        s = unpacker(&bytes, size);
        pass_birth(&s, &back, corner, &position, &orientation);
        ck_assert_msg(s.unsound == (size < (size_t)bytes.count), "%zu bytes", size);
    }
    for (int wrong = 0; wrong < 4; wrong++) {
        record_solid told = solid, got;
        vec3 points[3] = {point[0], point[1], point[2]};
        int32_t one[3] = {face[0], face[1], face[2]};
        *(wrong % 2 ? &told.faces : &told.vertices) = wrong < 2 ? -1 : 1 << 28;
        s = record_packer(&ctx, &bytes, origin);
        pass_solid(&s, &told, points, one);
        s = unpacker(&bytes, (size_t)bytes.count);
        record_stream_solid(&s, &got);
        ck_assert_msg(s.unsound, "length %d", wrong);
    }
    vec3 place = {(double)NAN, 0, 0};
    s = record_packer(&ctx, &bytes, origin);
    record_stream_point(&s, &place);
    s = unpacker(&bytes, (size_t)bytes.count);
    record_stream_point(&s, &place);
    ck_assert(s.unsound);
    array_free(&ctx, &bytes);
}
END_TEST

START_TEST(a_block_without_memory_is_told)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        byte_array bytes = {0};
        record_frame_head head = {.step = 1};
        record_stream s = record_packer(&turn.ctx, &bytes, origin);
        record_stream_frame(&s, &head);
        for (int i = 0; i < 100; i++) {
            record_moving m = {pose_of_floe, quat_identity(), 0};
            record_stream_moving(&s, BLOCK_FRAME, &m);
        }
        record_stream_set_count(&s, BLOCK_FRAME, 100);
        turn.status = s.full ? FRAM_ERROR_MEMORY : FRAM_OK;
        array_free(&turn.ctx, &bytes);
    }
}
END_TEST

TEST_MAIN("record_blocks", solids_come_back, births_come_back, breaks_and_forces_come_back, frames_come_back,
          what_a_block_does_not_hold_is_unsound, a_block_without_memory_is_told)
