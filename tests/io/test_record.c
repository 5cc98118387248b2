/* io/record: framing, continuing, and that nothing damaged is ever given out. */
#include "io/record.h"
#include "scratch.h"

#include <sys/random.h>

static context ctx;
static fram_error error;

/* In place of the C library's: the names of temporary files can be foreseen here, one after the other from 0. */
static uint64_t drawn;
/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): its own names are reserved */
ssize_t getrandom(void *out, size_t size, unsigned flags)
{
    (void)flags;
    memcpy(out, &drawn, size < sizeof drawn ? size : sizeof drawn);
    drawn++;
    return (ssize_t)size;
}

enum { BLOCK_COUNT = 5 };
static const char *const payloads[BLOCK_COUNT] = {"", "a", "12345678", "a longer payload of some bytes", "end"};

/* A record of the blocks above, block i of type 10 + i; offsets[i] is where block i begins. */
static void write_example(const char *path, uint64_t offsets[BLOCK_COUNT + 1])
{
    record_writer w;
    assert_ok(record_create(&ctx, path, &w, &error), error);
    for (int i = 0; i < BLOCK_COUNT; i++) {
        offsets[i] = record_length(&w);
        size_t half = strlen(payloads[i]) / 2;
        const record_part parts[2] = {{payloads[i], half}, {payloads[i] + half, strlen(payloads[i]) - half}};
        assert_ok(record_append(&w, 10 + (uint32_t)i, parts, 2, &error), error);
    }
    offsets[BLOCK_COUNT] = record_length(&w);
    assert_ok(record_flush(&w, true, &error), error);
    assert_ok(record_close(&w, &error), error);
}

/* Blocks that are given out before the end or the damage; each is checked against what was written. */
static int read_all(const char *path, char damage[160])
{
    record_reader r;
    int count = 0;
    damage[0] = '\0';
    fram_status status = record_open(&ctx, path, &r, &error);
    if (status != FRAM_OK) {
        ck_assert_int_eq(status, FRAM_ERROR_INPUT);
        return -1;
    }
    for (;; count++) {
        record_block block;
        bool found;
        assert_ok(record_next(&r, &block, &found, &error), error);
        if (!found)
            break;
        ck_assert_int_lt(count, BLOCK_COUNT);
        ck_assert_uint_eq(block.type, 10 + (uint32_t)count);
        ck_assert_uint_eq(block.size, strlen(payloads[count]));
        ck_assert(block.size == 0 || memcmp(block.data, payloads[count], block.size) == 0);
    }
    memcpy(damage, r.damage, 160);
    record_reader_close(&r);
    record_reader_close(&r);
    return count;
}

START_TEST(blocks_come_back_in_order)
{
    context_init(&ctx);
    scratch s = scratch_make();
    uint64_t offsets[BLOCK_COUNT + 1];
    char damage[160];
    write_example(scratch_path(&s, "r"), offsets);
    ck_assert_uint_eq(offsets[0], 24);
    for (int i = 0; i <= BLOCK_COUNT; i++)
        ck_assert_uint_eq(offsets[i] % 8, 0);
    ck_assert_int_eq(read_all(s.path, damage), BLOCK_COUNT);
    ck_assert_str_eq(damage, "");
    scratch_remove(&s, "r");
}
END_TEST

START_TEST(blocks_are_found_by_offset)
{
    context_init(&ctx);
    scratch s = scratch_make();
    uint64_t offsets[BLOCK_COUNT + 1];
    record_reader r;
    record_block block;
    bool found;
    write_example(scratch_path(&s, "r"), offsets);
    assert_ok(record_open(&ctx, s.path, &r, &error), error);
    for (int i = BLOCK_COUNT - 1; i >= 0; i--) {
        record_seek(&r, offsets[i]);
        assert_ok(record_next(&r, &block, &found, &error), error);
        ck_assert(found);
        ck_assert_uint_eq(block.type, 10 + (uint32_t)i);
        ck_assert_uint_eq(block.offset, offsets[i]);
    }
    static const uint64_t wild[] = {0, 1, 25, 1u << 30, UINT64_MAX, UINT64_MAX - 8};
    for (size_t i = 0; i < sizeof wild / sizeof *wild; i++) {
        record_seek(&r, wild[i]);
        assert_ok(record_next(&r, &block, &found, &error), error);
        ck_assert(!found && r.damage[0]);
    }
    record_reader_close(&r);
    scratch_remove(&s, "r");
}
END_TEST

/* A reader may follow a record that is still being written. */
START_TEST(a_growing_record_can_be_followed)
{
    context_init(&ctx);
    scratch s = scratch_make();
    record_writer w;
    record_reader r;
    record_block block;
    bool found;
    const record_part part = {"payload", 7};
    assert_ok(record_create(&ctx, scratch_path(&s, "r"), &w, &error), error);
    assert_ok(record_flush(&w, false, &error), error);
    assert_ok(record_open(&ctx, s.path, &r, &error), error);
    assert_ok(record_next(&r, &block, &found, &error), error);
    ck_assert(!found && !r.damage[0]);
    assert_ok(record_append(&w, 3, &part, 1, &error), error);
    assert_ok(record_flush(&w, false, &error), error);
    assert_ok(record_next(&r, &block, &found, &error), error);
    ck_assert(found);
    ck_assert_uint_eq(block.size, 7);
    record_reader_close(&r);
    assert_ok(record_close(&w, &error), error);
    scratch_remove(&s, "r");
}
END_TEST

/* A record cut anywhere gives all whole blocks and says what is wrong with the rest. */
START_TEST(a_cut_record_gives_its_whole_blocks)
{
    context_init(&ctx);
    scratch s = scratch_make();
    uint64_t offsets[BLOCK_COUNT + 1];
    char damage[160];
    size_t size;
    write_example(scratch_path(&s, "r"), offsets);
    char *data = scratch_read(s.path, &size);
    ck_assert_uint_eq(size, offsets[BLOCK_COUNT]);
    for (size_t cut = 0; cut < size; cut++) {
        scratch_write(s.path, data, cut);
        int whole = -1;
        for (int i = 0; i <= BLOCK_COUNT; i++)
            whole = offsets[i] <= cut ? i : whole;
        int count = read_all(s.path, damage);
        ck_assert_int_eq(count, whole);
        if (whole >= 0)
            ck_assert_int_eq(damage[0] == '\0', cut == offsets[whole]);
    }
    free(data);
    scratch_remove(&s, "r");
}
END_TEST

/* Every flipped bit is seen: the head refuses, or reading stops at the block that was hit. */
START_TEST(every_flipped_bit_is_seen)
{
    context_init(&ctx);
    scratch s = scratch_make();
    uint64_t offsets[BLOCK_COUNT + 1];
    char damage[160];
    size_t size;
    write_example(scratch_path(&s, "r"), offsets);
    char *data = scratch_read(s.path, &size);
    for (size_t bit = 0; bit < 8 * size; bit++) {
        data[bit / 8] ^= (char)(1 << bit % 8);
        scratch_write(s.path, data, size);
        int hit = -1;
        for (int i = 0; i < BLOCK_COUNT; i++)
            hit = offsets[i] <= bit / 8 ? i : hit;
        ck_assert_int_eq(read_all(s.path, damage), hit);
        ck_assert(hit < 0 || damage[0]);
        data[bit / 8] ^= (char)(1 << bit % 8);
    }
    free(data);
    scratch_remove(&s, "r");
}
END_TEST

START_TEST(a_record_is_continued_after_any_block)
{
    context_init(&ctx);
    scratch s = scratch_make();
    uint64_t offsets[BLOCK_COUNT + 1];
    char damage[160];
    record_writer w;
    for (int keep = 0; keep <= BLOCK_COUNT; keep++) {
        write_example(scratch_path(&s, "r"), offsets);
        assert_ok(record_continue(&ctx, s.path, offsets[keep], &w, &error), error);
        assert_ok(file_cut(&w.file.writer, offsets[keep], &error), error);
        ck_assert_uint_eq(record_length(&w), offsets[keep]);
        for (int i = keep; i < BLOCK_COUNT; i++) {
            const record_part part = {payloads[i], strlen(payloads[i])};
            assert_ok(record_append(&w, 10 + (uint32_t)i, &part, 1, &error), error);
        }
        ck_assert_uint_eq(record_length(&w), offsets[BLOCK_COUNT]);
        assert_ok(record_close(&w, &error), error);
        ck_assert_int_eq(read_all(s.path, damage), BLOCK_COUNT);
    }
    for (uint64_t length = 0; length <= offsets[BLOCK_COUNT] + 8; length++) {
        bool end = false;
        for (int i = 0; i <= BLOCK_COUNT; i++)
            end = end || offsets[i] == length;
        if (end)
            continue;
        ck_assert_int_eq(record_continue(&ctx, s.path, length, &w, &error), FRAM_ERROR_INPUT);
        ck_assert_int_eq(read_all(s.path, damage), BLOCK_COUNT);
    }
    scratch_remove(&s, "r");
}
END_TEST

START_TEST(other_files_are_refused)
{
    context_init(&ctx);
    scratch s = scratch_make();
    record_reader r;
    record_writer w;
    uint64_t offsets[BLOCK_COUNT + 1];
    size_t size;
    assert_fails(record_open(&ctx, "/no/such/record", &r, &error), error, FRAM_ERROR_INPUT, "No such file");
    assert_fails(record_open(&ctx, "/tmp", &r, &error), error, FRAM_ERROR_INPUT, "folder");
    scratch_write(scratch_path(&s, "r"), "title: a scenario, and no record\n", 33);
    assert_fails(record_open(&ctx, s.path, &r, &error), error, FRAM_ERROR_INPUT, "another kind");
    assert_fails(record_continue(&ctx, s.path, 24, &w, &error), error, FRAM_ERROR_INPUT, "another kind");
    scratch_write(s.path, "", 0);
    assert_fails(record_open(&ctx, s.path, &r, &error), error, FRAM_ERROR_INPUT, "too short");
    write_example(s.path, offsets);
    char *data = scratch_read(s.path, &size);
    char swapped[4] = {data[15], data[14], data[13], data[12]};
    memcpy(data + 12, swapped, 4);
    scratch_write(s.path, data, size);
    assert_fails(record_open(&ctx, s.path, &r, &error), error, FRAM_ERROR_INPUT, "byte order");
    free(data);
    scratch_remove(&s, "r");
}
END_TEST

/* Until it is placed what was there stays, and a writing that failed leaves nothing; no link of a name is followed. */
START_TEST(a_record_is_placed_in_one_go)
{
    context_init(&ctx);
    scratch s = scratch_make();
    char other[300], path[300], link[320];
    snprintf(other, sizeof other, "%s", scratch_path(&s, "other"));
    snprintf(path, sizeof path, "%s", scratch_path(&s, "r"));
    snprintf(link, sizeof link, "%s.0000000000000000.new", path);
    scratch_write(other, "mine", 4);
    ck_assert_int_eq(symlink(other, link), 0);
    ck_assert_int_eq(symlink(other, path), 0);
    for (int bad = 1; bad >= 0; bad--) {
        record_writer w;
        drawn = 0;
        assert_ok(record_create_beside(&ctx, path, &w, &error), error);
        ck_assert_uint_eq(drawn, 2); /* the first name is taken */
        fram_status written = bad ? FRAM_ERROR_MEMORY : record_append(&w, 7, NULL, 0, &error);
        ck_assert_int_eq(record_place(&w, written, &error), written);
        size_t size;
        char *data = scratch_read(path, &size);
        ck_assert_uint_eq(size, bad ? 4 : 24 + RECORD_BLOCK_HEAD);
        free(data);
        data = scratch_read(other, &size);
        ck_assert_uint_eq(size, 4);
        free(data);
    }
    ck_assert_int_eq(unlink(other), 0);
    ck_assert_int_eq(unlink(link), 0);
    scratch_remove(&s, "r");
}
END_TEST

START_TEST(memory_runs_out)
{
    scratch s = scratch_make();
    for (failing_turn turn = {0}; failing_next(&turn);) {
        record_writer w = {0};
        record_reader r = {0};
        const record_part part = {"payload", 7};
        turn.status = record_create_beside(&turn.ctx, scratch_path(&s, "r"), &w, &error);
        if (turn.status == FRAM_OK)
            turn.status = record_place(&w, record_append(&w, 1, &part, 1, &error), &error);
        if (turn.status == FRAM_OK)
            turn.status = record_open(&turn.ctx, s.path, &r, &error);
        if (turn.status == FRAM_OK) {
            record_block block;
            bool found;
            turn.status = record_next(&r, &block, &found, &error);
            ck_assert(turn.status != FRAM_OK || found);
        }
        record_reader_close(&r);
    }
    scratch_remove(&s, "r");
}
END_TEST

TEST_MAIN("record", blocks_come_back_in_order, blocks_are_found_by_offset, a_growing_record_can_be_followed,
          a_cut_record_gives_its_whole_blocks, every_flipped_bit_is_seen, a_record_is_continued_after_any_block,
          other_files_are_refused, a_record_is_placed_in_one_go, memory_runs_out)
