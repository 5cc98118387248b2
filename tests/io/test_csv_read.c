/* io/csv_read: columns by name, in their unit, and what is refused, with its line. */
#include "io/csv_read.h"
#include "scratch.h"

#include <stdlib.h>

enum { COLUMNS = 2 };
static const char *const names[COLUMNS] = {"time", "force[N]"};

static fram_status read_text(const char *text, size_t size, double_array *columns, fram_error *error)
{
    context ctx;
    context_init(&ctx);
    memset(error, 0, sizeof *error);
    scratch place = scratch_make();
    FILE *file = fopen(scratch_path(&place, "table.csv"), "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(text, 1, size, file), size);
    ck_assert_int_eq(fclose(file), 0);
    fram_status status = csv_read(&ctx, place.path, names, COLUMNS, columns, error);
    scratch_remove(&place, "table.csv");
    return status;
}

static void free_columns(double_array *columns)
{
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < COLUMNS; i++)
        array_free(&ctx, &columns[i]);
}

/* The text is refused, at this line, with these words. */
static void assert_refused(const char *text, size_t size, int line, const char *words)
{
    double_array columns[COLUMNS] = {0};
    fram_error error;
    ck_assert_int_eq(read_text(text, size, columns, &error), FRAM_ERROR_INPUT);
    ck_assert_int_eq(error.line, line);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    free_columns(columns);
}
#define ASSERT_REFUSED(text, line, words) assert_refused((text), sizeof(text) - 1, (line), (words))

/* The text is taken: at 0.25 s there is 1 N, at 0.5 s -2500. */
static void assert_two_rows(const char *text, size_t size)
{
    double_array columns[COLUMNS] = {0};
    fram_error error;
    ck_assert_msg(read_text(text, size, columns, &error) == FRAM_OK, "%s", error.message);
    ck_assert_int_eq(columns[0].count, 2);
    ck_assert_int_eq(columns[1].count, 2);
    assert_bits(columns[0].data[0], 0.25);
    assert_bits(columns[0].data[1], 0.5);
    assert_bits(columns[1].data[0], 1);
    assert_bits(columns[1].data[1], -2500);
    free_columns(columns);
}

START_TEST(columns_are_found_by_name_in_any_order)
{
    static const char text[] = "force[N],x[m],time[s]\n-2.5e3,7,0.25\n4,7,0.5,\n"; /* a comma at the end is none */
    double_array columns[COLUMNS] = {0};
    fram_error error;
    ck_assert_int_eq(read_text(text, sizeof text - 1, columns, &error), FRAM_OK);
    ck_assert_int_eq(columns[0].count, 2);
    ck_assert_int_eq(columns[1].count, 2);
    assert_bits(columns[0].data[1], 0.5);
    assert_bits(columns[1].data[0], -2500);
    free_columns(columns);
}
END_TEST

/* As spreadsheets and editors leave it: a mark in front, ends of two characters, none at the end. */
START_TEST(ends_of_lines_do_not_matter)
{
    static const char text[] = "\xef\xbb\xbftime,force [N]\r\n0.25,1\r\n0.5,-2500";
    assert_two_rows(text, sizeof text - 1);
}
END_TEST

/* As people type and spreadsheets pad: blanks about numbers, lines with nothing in them, at the end too. */
START_TEST(blanks_do_not_matter)
{
    static const char text[] = "time[s] , force[N]\n 0.25 ,\t1 \n\n0.5\t, -2500\n  \r\n\n";
    assert_two_rows(text, sizeof text - 1);
}
END_TEST

/* Dates, words with commas and gaps of columns that nobody asks for, in the header too. */
START_TEST(other_columns_may_hold_anything)
{
    static const char text[] = "date,\"note, by hand\",time[s],gust,force[N],end\n"
                               "2026-01-01 00:00,\"calm, 1\"\" of ice\" ,0.25,,1,\n"
                               "2026-01-01 00:15,5\" of ice,0.5,nan,-2500,x\n";
    assert_two_rows(text, sizeof text - 1);
    ASSERT_REFUSED("time[s],note,force[N]\n1,\"a,2\n", 2, "column 2: expected a quotation mark at the end");
    ASSERT_REFUSED("time[s],note,force[N]\n1,\"a\"b,2\n", 2, "column 2: expected a quotation mark at the end");
    ASSERT_REFUSED("time[s],note,force[N]\n1,,\n", 2, "has 2 values");
    ASSERT_REFUSED("time[s],note,force[N]\n1,a,b,2\n", 2, "column 3: expected a number, found \"b\"");
}
END_TEST

START_TEST(what_is_wrong_is_refused_at_its_line)
{
    ASSERT_REFUSED("", 1, "no header");
    ASSERT_REFUSED("time[s],x[m]\n", 1, "no column");
    ASSERT_REFUSED("time[s],force[N],y,force [N]\n1,2,3,4\n", 1, "one column of this name, found columns 2 and 4");
    ASSERT_REFUSED("time[s],force[N]\n1,2\n1,two\n", 3, "expected a number");
    ASSERT_REFUSED("time[s],force[kN]\n1,2\n", 1, "expected the unit [N], found [kN]");
    ASSERT_REFUSED("time[s],force[N]\n1\n1,2\n", 2, "has 1 values");
    ASSERT_REFUSED("time[s],force[N]\n1,2\n1", 3, "has 1 values");
    ASSERT_REFUSED("time[s],force[N]\n1,2\n,\n", 3, "expected a number");
    ASSERT_REFUSED("time[s],force[N]\n1 1,2\n", 2, "expected a number");
    ASSERT_REFUSED("time[s],force[N]\n1,-0x10\n", 2, "column 2: expected a number, found \"-0x10\"");
    ASSERT_REFUSED("time[s],force[N]\n1,2\0,3\n", 2, "NUL");
    /* 1000 and 0.25 of people who write 1,000 and 0,25: never one column for another. */
    ASSERT_REFUSED("time[s],force[N]\n1,000,2\n", 2, "the row has 3 values, the header 2 columns");
    ASSERT_REFUSED("time[s],x[m],force[N]\n0,0,7,2\n0,25,7,2\n", 2, "is one of the commas a decimal");
    ASSERT_REFUSED("\"time[s]\",\"force[N]\"\n1,2\n", 1, "no column of this name; names stand without quotation marks");
    ASSERT_REFUSED("time[s],Force[N]\n1,2\n", 1, "no column of this name; capital and small letters");
    ASSERT_REFUSED("FORCE,time\n1,2\n", 1, "no column of this name; capital and small letters");
    ASSERT_REFUSED("time[s],forces[N]\n1,2\n", 1, "no column of this name");
    ASSERT_REFUSED("time[s];force[N]\n1;2\n", 1, "columns are divided by commas");
    ASSERT_REFUSED("time[s],force[N]\r1,2\r", 1, "not with carriage returns alone");
    ASSERT_REFUSED("# of a tank\ntime[s],force[N]\n1,2\n", 1, "comments are not read");
}
END_TEST

/* As many columns as a vessel of 64 lines and 32 thrusters asks for, and more. */
START_TEST(hundreds_of_columns_are_read)
{
    enum { MANY = 300, ROOM = 16 };
    static char name[MANY][ROOM], text[2 * MANY * ROOM];
    static const char *asked[MANY];
    static double_array columns[MANY];
    size_t length = 0;
    for (int k = 0; k < MANY; k++) {
        snprintf(name[k], ROOM, "c%d", k);
        asked[MANY - 1 - k] = name[k];
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s", k > 0 ? "," : "", name[k]);
    }
    text[length++] = '\n';
    for (int k = 0; k < MANY; k++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%d%c", k, k + 1 < MANY ? ',' : '\n');
    context ctx;
    fram_error error = {0};
    context_init(&ctx);
    scratch place = scratch_make();
    scratch_write(scratch_path(&place, "wide.csv"), text, length);
    ck_assert_msg(csv_read(&ctx, place.path, asked, MANY, columns, &error) == FRAM_OK, "%s", error.message);
    for (int k = 0; k < MANY; k++) {
        ck_assert_int_eq(columns[k].count, 1);
        assert_bits(columns[k].data[0], MANY - 1 - k);
        array_free(&ctx, &columns[k]);
    }
    scratch_remove(&place, "wide.csv");
}
END_TEST

/* Rows of all lengths over several parts of a buffer, with zeros and texts that a skipped cell may be; a line that is
   as long as one may be but for a character, and one that is not. */
START_TEST(rows_go_over_the_parts_of_a_buffer)
{
    enum { ROWS = 3000, ROOM = ROWS * 200 + 3 * CSV_LINE_MOST };
    char *text = malloc(ROOM);
    ck_assert_ptr_nonnull(text);
    size_t length = (size_t)snprintf(text, ROOM, "time[s],x[m],force[N]\n");
    for (int i = 0; i < ROWS; i++)
        length += (size_t)snprintf(text + length, ROOM - length, "%d,%s%0*d,%d\n", i, i % 3 ? "-1." : "", 1 + i % 150,
                                   i % 2, -i);
    double_array columns[COLUMNS] = {0};
    fram_error error;
    ck_assert_msg(read_text(text, length, columns, &error) == FRAM_OK, "%s", error.message);
    ck_assert_int_eq(columns[0].count, ROWS);
    for (int i = 0; i < ROWS; i++) {
        assert_bits(columns[0].data[i], i);
        assert_absolute(columns[1].data[i], -i, 0);
    }
    free_columns(columns);
    for (int more = 0; more < 2; more++) {
        double_array wide[COLUMNS] = {0};
        size_t row = CSV_LINE_MOST - 2 + (size_t)more; /* and the end of the line */
        memset(text + length, '0', row);
        memcpy(text + length + 4, ",0,", 3);
        text[length + row] = '\n';
        memcpy(text + length + row + 1, "7,0,8", 5);
        fram_status status = read_text(text, length + row + 6, wide, &error);
        ck_assert_int_eq(status, more ? FRAM_ERROR_INPUT : FRAM_OK);
        ck_assert_int_eq(wide[0].count, ROWS + (more ? 0 : 2));
        ck_assert(!more || (error.line == ROWS + 2 && strstr(error.message, "characters in a line")));
        free_columns(wide);
    }
    free(text);
}
END_TEST

/* Names as they are, and behind that of a vessel; all others are looked at and not kept, but told. */
START_TEST(columns_that_nobody_wishes_for_are_left_out)
{
    static const char text[] = "time[s],tug.yaw[deg],yaw[deg],draw[m]\n1,2,3,4\n5,6,7,8\n";
    static const char *const wished[] = {"time", "yaw", "none"};
    const csv_wish wish = {wished, 3};
    context ctx;
    fram_error error;
    csv_table t;
    scratch place = scratch_make();
    const char *path = scratch_path(&place, "a.csv");
    context_init(&ctx);
    scratch_write(path, text, sizeof text - 1);
    assert_ok(csv_table_read(&ctx, path, &wish, &t, &error), error);
    ck_assert_int_eq(t.rows, 2);
    ck_assert_int_eq(t.columns.count, 4);
    ck_assert_str_eq(t.columns.data[3].name, "draw");
    ck_assert_int_eq(t.columns.data[3].value.count, 0);
    ck_assert_ptr_null(csv_table_find(&t, "draw"));
    ck_assert_ptr_null(csv_table_find(&t, "none"));
    assert_bits(csv_table_find(&t, "yaw")->value.data[1], 7);
    assert_bits(csv_table_find(&t, "tug.yaw")->value.data[0], 2);
    csv_table_free(&ctx, &t);
    static const char wrong[] = "time[s],draw[m]\n1,x\n";
    scratch_write(path, wrong, sizeof wrong - 1);
    assert_fails(csv_table_read(&ctx, path, &wish, &t, &error), error, FRAM_ERROR_INPUT,
                 "expected a number and then the end");
    scratch_remove(&place, "a.csv");
}
END_TEST

TEST_MAIN("csv_read", columns_are_found_by_name_in_any_order, ends_of_lines_do_not_matter, blanks_do_not_matter,
          other_columns_may_hold_anything, what_is_wrong_is_refused_at_its_line, hundreds_of_columns_are_read,
          rows_go_over_the_parts_of_a_buffer, columns_that_nobody_wishes_for_are_left_out)
