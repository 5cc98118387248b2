/* io/csv: header, full precision, continuing after a cut. */
#include "base/number_text.h"
#include "io/csv.h"
#include "scratch.h"

static context ctx;
static fram_error error;
static const csv_column columns[] = {{"time", "s"}, {"x", "m"}, {"contacts", ""}, {"bare", NULL}};

static void assert_content(const char *path, const char *expected)
{
    size_t size;
    char *data = scratch_read(path, &size);
    data[size] = '\0';
    ck_assert_str_eq(data, expected);
    free(data);
}

START_TEST(rows_keep_twelve_digits)
{
    context_init(&ctx);
    scratch s = scratch_make();
    csv_writer w;
    static const double rows[2][4] = {{0, 1 / 3.0, 12, -0.0}, {0.1, 1e-300, 1e22, -123456789.0123456}};
    assert_ok(csv_create(&ctx, scratch_path(&s, "a.csv"), columns, 4, &w, &error), error);
    for (int i = 0; i < 2; i++)
        assert_ok(csv_append(&w, rows[i], &error), error);
    uint64_t length = csv_length(&w);
    assert_ok(csv_flush(&w, true, &error), error);
    ck_assert_uint_eq(csv_length(&w), length);
    assert_ok(csv_close(&w, &error), error);
    assert_content(s.path, "time[s],x[m],contacts,bare\n0,0.333333333333,12,-0\n0.1,1e-300,1e+22,-123456789.012\n");
    size_t size;
    char *data = scratch_read(s.path, &size);
    ck_assert_uint_eq(size, length);
    char *at = strchr(data, '\n') + 1;
    for (int i = 0; i < 8; i++) {
        size_t field = strcspn(at, ",\n");
        double value;
        at[field] = '\0';
        ck_assert_int_eq(real_from_text(at, &value), NUMBER_GOOD);
        double written = rows[i / 4][i % 4];
        ck_assert(fabs(value - written) <= 5e-12 * fabs(written));
        at += field + 1;
    }
    free(data);
    scratch_remove(&s, "a.csv");
}
END_TEST

START_TEST(a_file_is_continued_where_a_checkpoint_says)
{
    context_init(&ctx);
    scratch s = scratch_make();
    csv_writer w;
    const double row[4] = {1, 2, 3, 4}, other[4] = {5, 6, 7, 8};
    assert_ok(csv_create(&ctx, scratch_path(&s, "a.csv"), columns, 4, &w, &error), error);
    assert_ok(csv_append(&w, row, &error), error);
    uint64_t length = csv_length(&w);
    assert_ok(csv_append(&w, row, &error), error);
    assert_ok(csv_append(&w, row, &error), error);
    assert_ok(csv_close(&w, &error), error);

    assert_fails(csv_continue(&ctx, s.path, length - 1, columns, 4, &w, &error), error, FRAM_ERROR_INPUT,
                 "end of a row");
    assert_fails(csv_continue(&ctx, s.path, 5, columns, 4, &w, &error), error, FRAM_ERROR_INPUT, "to continue at");
    assert_fails(csv_continue(&ctx, s.path, 1000, columns, 4, &w, &error), error, FRAM_ERROR_INPUT,
                 "at least 1000 bytes");
    assert_fails(csv_continue(&ctx, s.path, length, columns, 3, &w, &error), error, FRAM_ERROR_INPUT, "columns");
    csv_column renamed[4];
    memcpy(renamed, columns, sizeof renamed);
    renamed[1].unit = "k";
    assert_fails(csv_continue(&ctx, s.path, length, renamed, 4, &w, &error), error, FRAM_ERROR_INPUT, "columns");
    assert_fails(csv_continue(&ctx, "/no/such/file", length, columns, 4, &w, &error), error, FRAM_ERROR_INPUT,
                 "No such");

    /* None of the refusals has changed it. */
    assert_content(s.path, "time[s],x[m],contacts,bare\n1,2,3,4\n1,2,3,4\n1,2,3,4\n");
    assert_ok(csv_continue(&ctx, s.path, length, columns, 4, &w, &error), error);
    assert_ok(file_cut(&w.file, length, &error), error);
    assert_ok(csv_append(&w, other, &error), error);
    assert_ok(csv_close(&w, &error), error);
    assert_content(s.path, "time[s],x[m],contacts,bare\n1,2,3,4\n5,6,7,8\n");
    scratch_remove(&s, "a.csv");
}
END_TEST

START_TEST(a_full_disk_stops_the_writer)
{
    context_init(&ctx);
    if (access("/dev/full", W_OK) != 0)
        return;
    csv_writer w;
    const double row[4] = {1 / 3.0, 1 / 3.0, 1 / 3.0, 1 / 3.0};
    assert_ok(csv_create(&ctx, "/dev/full", columns, 4, &w, &error), error);
    fram_status status = FRAM_OK;
    int rows = 0;
    for (; status == FRAM_OK && rows < 100000; rows++)
        status = csv_append(&w, row, &error);
    ck_assert_int_lt(rows, 100000);
    ck_assert_int_eq(status, FRAM_ERROR_IO);
    ck_assert_int_eq(csv_flush(&w, false, &error), FRAM_ERROR_IO);
    ck_assert_int_eq(csv_close(&w, &error), FRAM_ERROR_IO);
}
END_TEST

START_TEST(memory_runs_out)
{
    scratch s = scratch_make();
    const double row[4] = {1, 2, 3, 4};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        csv_writer w = {0};
        turn.status = csv_create(&turn.ctx, scratch_path(&s, "a.csv"), columns, 4, &w, &error);
        if (turn.status == FRAM_OK)
            turn.status = csv_append(&w, row, &error);
        uint64_t length = csv_length(&w);
        csv_close(&w, NULL);
        if (turn.status == FRAM_OK)
            turn.status = csv_continue(&turn.ctx, s.path, length, columns, 4, &w, &error);
        csv_close(&w, NULL);
    }
    scratch_remove(&s, "a.csv");
}
END_TEST

TEST_MAIN("csv", rows_keep_twelve_digits, a_file_is_continued_where_a_checkpoint_says, a_full_disk_stops_the_writer,
          memory_runs_out)
