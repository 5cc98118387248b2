/* The bytes of an explained peak: what goes in comes out, and nothing else is taken. */
#include "testing.h"

#include "io/peak_block.h"

static const vec2 near = {0, 0};

static peak_detail sample(void)
{
    peak_detail d = {.time = 12.345678901234, .load = 1.5e6, .window = 0.5, .vessel = 1, .bodies = 7};
    d.force = vec3_make(-1, 2, -3);
    d.floe_count = 2;
    d.link_count = 3;
    d.floe[0] = (peak_floe){.number = 5, .slot = 9, .mechanism = MECHANISM_CHAIN, .zone = 4, .links = 3};
    d.floe[0].end = CHAIN_WALL;
    d.floe[0].part[MECHANISM_FRICTION] = 0.25;
    d.floe[0].end_vessel = -1;
    d.floe[1].number = -1;
    d.link[2] = (peak_link){3, -1, {1, 2, 3}, {4, 5, 6}, 7, 8, 9};
    d.zone[4][MECHANISM_IMPACT] = 42;
    d.mechanism[MECHANISM_BENDING] = 43;
    return d;
}

START_TEST(there_and_back)
{
    static unsigned char room[PEAK_BLOCK_ROOM];
    peak_detail d = sample(), back;
    size_t size = peak_block_pack(&d, near, room);
    ck_assert(peak_block_unpack(room, size, near, &back));
    ck_assert(back.time == d.time && back.load == d.load && back.vessel == 1 && back.bodies == 7);
    ck_assert(back.floe[0].number == 5 && back.floe[0].part[MECHANISM_FRICTION] == 0.25);
    ck_assert(back.link[2].push.z == 6 && back.link[2].inertia == 9 && back.zone[4][MECHANISM_IMPACT] == 42);
    ck_assert(memcmp(&back, &d, sizeof d) == 0);
    /* The largest one fits into the room. */
    d.floe_count = PEAK_FLOES;
    d.link_count = 0;
    for (int i = 0; i < PEAK_FLOES; i++) {
        d.floe[i].links = i < PEAK_CHAINS ? PEAK_CHAIN_LINKS : 0;
        d.link_count += d.floe[i].links;
    }
    d.floe[7].left_out = 232;
    d.floe[7].end = CHAIN_VESSEL;
    d.floe[7].end_vessel = 3;
    size = peak_block_pack(&d, near, room);
    ck_assert(size < PEAK_BLOCK_ROOM && peak_block_unpack(room, size, near, &back));
    ck_assert(back.floe[7].left_out == 232 && back.floe[7].end_vessel == 3);
    ck_assert(peak_chain_jumps_to(&back.floe[7], PEAK_CHAIN_FIRST) && !peak_chain_jumps_to(&back.floe[7], 1));
    ck_assert(!peak_chain_jumps_to(&back.floe[6], PEAK_CHAIN_FIRST));
}
END_TEST

/* What each floe has at the end of a block since links are left out; blocks of before lack it. */
enum { TAIL = 4 };

/* A block of before is read: twelve links that came back to themselves were mostly the first of a longer chain. */
START_TEST(earlier_blocks)
{
    static unsigned char room[PEAK_BLOCK_ROOM];
    peak_detail d = sample(), back;
    size_t size = peak_block_pack(&d, near, room) - (size_t)d.floe_count * TAIL;
    ck_assert(peak_block_unpack(room, size, near, &back));
    ck_assert(back.link_count == 3 && back.link[2].inertia == 9 && back.floe[0].end == CHAIN_WALL);
    ck_assert(back.floe[0].left_out == 0 && back.floe[0].end_vessel == -1);
    for (int links = 3; links <= 12; links += 9) {
        d.floe[0].end = CHAIN_LOOP;
        d.floe[0].links = (uint8_t)links;
        d.link_count = links;
        size = peak_block_pack(&d, near, room);
        ck_assert(peak_block_unpack(room, size, near, &back));
        ck_assert_int_eq(back.floe[0].end, CHAIN_LOOP);
        ck_assert(peak_block_unpack(room, size - (size_t)d.floe_count * TAIL, near, &back));
        ck_assert_int_eq(back.floe[0].end, links == 12 ? CHAIN_LONG : CHAIN_LOOP);
    }
}
END_TEST

/* In coordinates of a map, where floats are a decimetre apart; what was read is written again with the same bytes. */
START_TEST(places_far_from_zero)
{
    static unsigned char room[PEAK_BLOCK_ROOM], again[PEAK_BLOCK_ROOM];
    const vec2 far = {-1400000, 2000000};
    const vec3 point = {-1400012.34, 2000056.78, -0.5};
    peak_detail d = sample(), back;
    d.floe[1].point = d.link[0].place = point;
    size_t size = peak_block_pack(&d, far, room);
    ck_assert(peak_block_unpack(room, size, far, &back));
    ck_assert_double_le(vec3_length(vec3_sub(back.floe[1].point, point)), 1e-5);
    ck_assert_double_le(vec3_length(vec3_sub(back.link[0].place, point)), 1e-5);
    ck_assert_uint_eq(peak_block_pack(&back, far, again), size);
    ck_assert_mem_eq(again, room, size);
}
END_TEST

START_TEST(other_bytes)
{
    static unsigned char room[PEAK_BLOCK_ROOM];
    peak_detail d = sample(), back;
    size_t size = peak_block_pack(&d, near, room);
    for (size_t cut = 0; cut < size; cut++)
        ck_assert(cut == size - (size_t)d.floe_count * TAIL || !peak_block_unpack(room, cut, near, &back));
    ck_assert(!peak_block_unpack(room, size + 1, near, &back));
    d.floe[0].mechanism = MECHANISM_COUNT;
    ck_assert(!peak_block_unpack(room, peak_block_pack(&d, near, room), near, &back));
    d = sample();
    d.floe[0].links = 4;
    ck_assert(!peak_block_unpack(room, peak_block_pack(&d, near, room), near, &back));
    d = sample();
    d.floe[0].left_out = 1; /* of a chain that has room */
    ck_assert(!peak_block_unpack(room, peak_block_pack(&d, near, room), near, &back));
    d = sample();
    d.vessel = -1;
    ck_assert(!peak_block_unpack(room, peak_block_pack(&d, near, room), near, &back));
    d = sample();
    d.load = (double)NAN;
    ck_assert(!peak_block_unpack(room, peak_block_pack(&d, near, room), near, &back));
}
END_TEST

TEST_MAIN("peak_block", there_and_back, earlier_blocks, places_far_from_zero, other_bytes)
