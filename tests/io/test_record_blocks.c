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

    record_force force = {RECORD_FORCE_THRUSTER, 3, 4, {499999.5, 7000001.25, -6}, {8e5, -2.5e5, 125}}, again = {0};
    s = record_packer(&ctx, &bytes, origin);
    record_stream_padded_count(&s, &count);
    record_stream_force(&s, &force);
    ck_assert_int_eq(bytes.count, FORCES_HEAD_SIZE + RECORD_FORCE_SIZE);
    s = unpacker(&bytes, (size_t)bytes.count);
    record_stream_padded_count(&s, &count);
    record_stream_force(&s, &again);
    assert_at_end(&s);
    ck_assert(again.kind == RECORD_FORCE_THRUSTER && again.vessel == 3 && again.which == 4);
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

/* ---- the bytes themselves: written out by hand, as io/record_layout.h tells them ---- */

typedef struct bytes_by_hand {
    unsigned char data[128];
    size_t count;
} bytes_by_hand;

static void put_u8(bytes_by_hand *b, unsigned value)
{
    ck_assert_uint_lt(b->count, sizeof b->data);
    b->data[b->count++] = (unsigned char)value;
}

/* Little endian. */
static void put_bits(bytes_by_hand *b, uint64_t bits, int bytes)
{
    for (int i = 0; i < bytes; i++)
        put_u8(b, (unsigned)(bits >> 8 * i & 0xff));
}
static void put_i32(bytes_by_hand *b, int32_t value) { put_bits(b, (uint32_t)value, 4); }
static void put_f32(bytes_by_hand *b, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bits(b, bits, 4);
}
static void put_f64(bytes_by_hand *b, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bits(b, bits, 8);
}

static void assert_bytes(const byte_array *packed, const bytes_by_hand *told)
{
    ck_assert_uint_eq((size_t)packed->count, told->count);
    for (size_t i = 0; i < told->count; i++)
        ck_assert_msg(packed->data[i] == told->data[i], "byte %zu: %u in place of %u", i, packed->data[i],
                      told->data[i]);
}

START_TEST(bodies_are_laid_out_as_told)
{
    context_init(&ctx);
    byte_array bytes = {0};
    record_solid ship = {7, 3, 12, 20};
    vec3 at = {2.5, 0.25, -1};
    int32_t corners[3] = {4, 9, 6}, slot = 17, count = 0;
    record_stream s = record_packer(&ctx, &bytes, origin);
    record_stream_solid(&s, &ship);
    record_stream_point(&s, &at);
    record_stream_face(&s, corners);
    bytes_by_hand hand = {0};
    put_i32(&hand, 7);  /* slot */
    put_i32(&hand, 3);  /* generation */
    put_i32(&hand, 12); /* vertices */
    put_i32(&hand, 20); /* triangles */
    put_f32(&hand, 2.5F);
    put_f32(&hand, 0.25F);
    put_f32(&hand, -1);
    put_i32(&hand, 4);
    put_i32(&hand, 9);
    put_i32(&hand, 6);
    assert_bytes(&bytes, &hand);

    s = record_packer(&ctx, &bytes, origin);
    record_stream_count(&s, &count);
    record_stream_slot(&s, &slot);
    record_stream_set_count(&s, BLOCK_DEATHS, 1);
    hand = (bytes_by_hand){0};
    put_i32(&hand, 1);
    put_i32(&hand, 17);
    assert_bytes(&bytes, &hand);

    /* Each flag by itself. */
    for (int flag = 0; flag < 3; flag++) {
        record_birth b = {5, 2, 1, flag == 0, flag == 1, flag == 2, 0.75, 910, 41, 12, 6};
        vec2 corner = {-2, 1.5};
        s = record_packer(&ctx, &bytes, origin);
        record_stream_count(&s, &count);
        record_stream_birth(&s, &b);
        record_stream_corner(&s, &corner);
        record_stream_set_count(&s, BLOCK_BIRTHS, 1);
        hand = (bytes_by_hand){0};
        put_i32(&hand, 1);
        put_i32(&hand, 5);        /* slot */
        put_i32(&hand, 2);        /* generation */
        put_u8(&hand, 1);         /* material */
        put_u8(&hand, flag == 0); /* moves */
        put_u8(&hand, flag == 1); /* breakable */
        put_u8(&hand, flag == 2); /* level ice */
        put_f32(&hand, 0.75F);    /* thickness */
        put_f32(&hand, 910);      /* density */
        put_i32(&hand, 41);       /* number of the floe */
        put_i32(&hand, 12);       /* of the one it broke from */
        put_i32(&hand, 6);        /* vertices */
        put_f32(&hand, -2);
        put_f32(&hand, 1.5F);
        assert_bytes(&bytes, &hand);
    }
    array_free(&ctx, &bytes);
}
END_TEST

START_TEST(events_and_forces_are_laid_out_as_told)
{
    context_init(&ctx);
    byte_array bytes = {0};
    int32_t count = 0;
    record_fracture f = {12.1, 2, 41, 3, {500010.5, 7000020.25, -0.5}, 1.5e6, 12.25, 320.5};
    record_stream s = record_packer(&ctx, &bytes, origin);
    record_stream_padded_count(&s, &count);
    record_stream_fracture(&s, &f);
    record_stream_set_count(&s, BLOCK_FRACTURES, 1);
    bytes_by_hand hand = {0};
    put_i32(&hand, 1);
    put_i32(&hand, 0);
    put_f64(&hand, 12.1); /* time */
    put_i32(&hand, 2);    /* bending */
    put_i32(&hand, 41);   /* number of the floe */
    put_i32(&hand, 3);    /* pieces */
    put_i32(&hand, 0);
    put_f32(&hand, 10.5F); /* place, from the origin */
    put_f32(&hand, 20.25F);
    put_f32(&hand, -0.5F);
    put_f32(&hand, 1.5e6F); /* load */
    put_f32(&hand, 12.25F); /* length of the crack */
    put_f32(&hand, 320.5F); /* area of the floe */
    assert_bytes(&bytes, &hand);

    for (int kind = 1; kind <= 4; kind++) { /* ice, line, thruster, hull */
        const int32_t vessel = kind == RECORD_FORCE_LINE ? 2 : 0;
        record_force force = {(record_force_kind)kind, vessel, 9, {499999.5, 7000001.25, -6}, {8e5, -2.5e5, 125}};
        s = record_packer(&ctx, &bytes, origin);
        record_stream_padded_count(&s, &count);
        record_stream_force(&s, &force);
        record_stream_set_count(&s, BLOCK_FORCES, 1);
        hand = (bytes_by_hand){0};
        put_i32(&hand, 1);
        put_i32(&hand, 0);
        put_i32(&hand, kind + 256 * vessel);
        put_i32(&hand, 9);     /* slot, or number of a line or thruster */
        put_f32(&hand, -0.5F); /* point, from the origin */
        put_f32(&hand, 1.25F);
        put_f32(&hand, -6);
        put_f32(&hand, 8e5F); /* force */
        put_f32(&hand, -2.5e5F);
        put_f32(&hand, 125);
        assert_bytes(&bytes, &hand);
    }
    array_free(&ctx, &bytes);
}
END_TEST

/* An upright pose from the origin: x, y, half float z, three words of 0 of the small components; the part left out is
   w, the first, of number 0. */
static void put_pose(bytes_by_hand *b, float x, float y, unsigned half_of_z, bool marked)
{
    enum { MIDDLE = 0x3fff, MARK = 0x8000 }; /* 0 of 15 bits over -1/sqrt(2) .. 1/sqrt(2) */
    put_f32(b, x);
    put_f32(b, y);
    put_bits(b, half_of_z, 2);
    put_bits(b, MIDDLE, 2);
    put_bits(b, MIDDLE, 2);
    put_bits(b, marked ? MIDDLE | MARK : MIDDLE, 2);
}

START_TEST(frames_are_laid_out_as_told)
{
    enum { HALF_OF_MINUS_EIGHTH = 0xb000, FORCE_OF_1_KN = 31 << 10 }; /* the exponent of 1 is the 31st of 64 */
    context_init(&ctx);
    byte_array bytes = {0};
    record_frame_head head = {(int64_t)1 << 33 | 120, 12.05, {1.1e6, -3, 0.5}, 0};
    record_moving still = {pose_of_floe, quat_identity(), 0}, touched = {pose_of_floe, quat_identity(), 1e3};
    record_stream s = record_packer(&ctx, &bytes, origin);
    record_stream_frame(&s, &head);
    record_stream_moving(&s, BLOCK_FRAME, &still);
    record_stream_moving(&s, BLOCK_FRAME, &touched);
    record_stream_set_count(&s, BLOCK_FRAME, 2);
    bytes_by_hand hand = {0};
    put_bits(&hand, (uint64_t)1 << 33 | 120, 8); /* step */
    put_f64(&hand, 12.05);                       /* time */
    put_f64(&hand, 1.1e6);                       /* averaged ice force */
    put_f64(&hand, -3);
    put_f64(&hand, 0.5);
    put_i32(&hand, 2);
    put_i32(&hand, 0);
    put_pose(&hand, 321.5F, -129.75F, HALF_OF_MINUS_EIGHTH, false);
    put_pose(&hand, 321.5F, -129.75F, HALF_OF_MINUS_EIGHTH, true);
    put_bits(&hand, FORCE_OF_1_KN, 2);
    assert_bytes(&bytes, &hand);
    array_free(&ctx, &bytes);
}
END_TEST

/* What no recorder writes: kinds that are none, and numbers that are none. */
START_TEST(blocks_of_no_record_are_unsound)
{
    context_init(&ctx);
    for (int kind = 0; kind <= RECORD_FORCE_HULL + 1; kind++) {
        bytes_by_hand hand = {0};
        put_i32(&hand, kind);
        for (int i = 0; i < 7; i++)
            put_i32(&hand, 0);
        record_block block = {.size = hand.count, .data = hand.data};
        record_stream s = record_unpacker(&block, origin);
        record_force force;
        record_stream_force(&s, &force);
        ck_assert_msg(s.unsound == (kind == 0 || kind > 4), "a force of kind %d", kind);
    }
    for (int field = 0; field < 5; field++) {
        bytes_by_hand hand = {0};
        put_bits(&hand, 120, 8);
        for (int i = 1; i < 5; i++)
            put_f64(&hand, i == field ? (double)NAN : 1);
        put_bits(&hand, 0, 8);
        record_block block = {.size = hand.count, .data = hand.data};
        record_stream s = record_unpacker(&block, origin);
        record_frame_head head;
        record_stream_frame(&s, &head);
        ck_assert_msg(s.unsound == (field > 0), "number %d of the head of a frame", field);
    }
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
          bodies_are_laid_out_as_told, events_and_forces_are_laid_out_as_told, frames_are_laid_out_as_told,
          what_a_block_does_not_hold_is_unsound, blocks_of_no_record_are_unsound, a_block_without_memory_is_told)
