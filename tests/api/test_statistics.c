/* Extremes and fatigue through the public API: misuse is refused, and a small file is answered. */
#include "scratch.h"

#include "fram/statistics.h"

#include <stdio.h>
#include <unistd.h>

/* What is read stays, however its name is spelt: a file, and what a run in a folder is made of. */
static void keep_what_is_read(fram_context *c, const char *file)
{
    char folder[SCRATCH_FOLDER], names[3][SCRATCH_PATH];
    fram_error error = {0};
    fram_fatigue cycles;
    fram_fatigue_definition f;
    static fram_extremes extremes;
    fram_extremes_definition d;
    scratch_folder(folder);
    snprintf(names[0], sizeof names[0], "/tmp/../%s", file);
    snprintf(names[1], sizeof names[1], "%s/series.csv", folder);
    snprintf(names[2], sizeof names[2], "%s/run.json", folder);
    for (int i = 1; i < 3; i++)
        fclose(fopen(names[i], "w"));
    fram_fatigue_default(&f);
    fram_extremes_default(&d);
    const char *sources[] = {file, folder};
    f.source.files = d.source.files = sources;
    f.source.channel = d.source.channel = "x";
    for (int i = 0; i < 3; i++) {
        f.source.file_count = d.source.file_count = i == 0 ? 1 : 2;
        f.cycles = d.draw = names[i];
        assert_fails(fram_fatigue_find(c, &f, &cycles, &error), error, FRAM_ERROR_USAGE, "a file of its own");
        ck_assert_str_eq(error.key, "cycles");
        assert_fails(fram_extremes_find(c, &d, &extremes, &error), error, FRAM_ERROR_USAGE, "a file of its own");
        ck_assert_str_eq(error.key, "draw");
    }
    f.source.file_count = 1;
    f.cycles = names[2]; /* of a run that is not read */
    assert_ok(fram_fatigue_find(c, &f, &cycles, &error), error);
    fram_fatigue_free(c, &cycles);
    for (int i = 1; i < 3; i++)
        ck_assert_int_eq(unlink(names[i]), 0);
    ck_assert_int_eq(rmdir(folder), 0);
}

/* tests/data/times.csv has more of them, for studies and the command. */
START_TEST(times_are_read_as_they_stand)
{
    fram_error error = {0};
    double got = 7;
    ck_assert_int_eq(fram_time_read(NULL, &got, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_time_read("3h", NULL, &error), FRAM_ERROR_USAGE);
    static const char *const bad[] = {"", " 3h", "3 h", "\t3h", "3h ", "0x10", "1e308a", "nan"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_fails(fram_time_read(bad[i], &got, &error), error, FRAM_ERROR_INPUT, "expected a time, as 3h");
    ck_assert_str_eq(error.key, "text");
    assert_absolute(got, 7, 0);
    assert_ok(fram_time_read("90min", &got, NULL), error);
    assert_absolute(got, 5400, 0);
}
END_TEST

START_TEST(numbers_are_read_strictly_and_told)
{
    fram_error error = {0};
    double got = 7;
    ck_assert_int_eq(fram_number_read(NULL, &got, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_number_read("3", NULL, &error), FRAM_ERROR_USAGE);
    static const char *const bad[] = {"", " 3", "3 ", "0x10", "0x1p3", "nan", "inf", "-infinity", "1e309", "3,0", "3h"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_fails(fram_number_read(bad[i], &got, &error), error, FRAM_ERROR_INPUT, "expected a decimal number");
    ck_assert_str_eq(error.key, "text");
    assert_absolute(got, 7, 0);
    assert_ok(fram_number_read("-2.5e3", &got, NULL), error);
    assert_absolute(got, -2500, 0);
    char text[64] = "as it was";
    fram_duration_text(125, NULL, sizeof text);
    fram_duration_text(125, text, 0);
    fram_load_text(125, 1, (double)NAN, NULL, sizeof text);
    fram_load_text(125, 1, (double)NAN, text, 0);
    ck_assert_str_eq(text, "as it was");
    fram_duration_text(125, text, sizeof text);
    ck_assert_str_eq(text, "2 min 05 s");
    fram_duration_text(125, text, 6);
    ck_assert_str_eq(text, "2 min");
    fram_load_text(2.61e7, (double)NAN, (double)NAN, text, sizeof text);
    ck_assert_str_eq(text, "26.1 MN");
    fram_load_text(739100, 169000, (double)NAN, text, sizeof text);
    ck_assert_str_eq(text, "739.1 +- 169 kN");
    fram_load_text(3000, (double)NAN, 2.61e7, text, sizeof text);
    ck_assert_str_eq(text, "0.003 MN");
    ck_assert_int_eq(fram_digits_beside(6534201, 0.01, 3, 5), 11);
    ck_assert_int_eq(fram_digits_beside(-3, 1, 3, 5), 5);
    ck_assert_int_eq(fram_digits_beside(3, 0, 3, 4), 4);
    ck_assert_int_eq(fram_digits_beside(1e300, 1e-300, 3, 5), 15);
}
END_TEST

START_TEST(misuse_is_refused_and_a_file_is_answered)
{
    char path[] = "/tmp/fram_statistics_XXXXXX";
    int descriptor = mkstemp(path);
    ck_assert_int_ge(descriptor, 0);
    FILE *file = fdopen(descriptor, "w");
    fputs("time,x\n", file);
    for (int i = 0; i < 400; i++)
        fprintf(file, "%d,%d\n", i, i % 2 ? 1 : -(i * 37 % 11));
    fclose(file);
    fram_context *c = NULL;
    fram_error error = {0};
    ck_assert_int_eq(fram_context_create(NULL, &c, &error), FRAM_OK);
    const char *files[] = {path};
    fram_extremes_definition d;
    fram_extremes *r = calloc(1, sizeof *r);
    fram_extremes_default(&d);
    ck_assert_int_eq(fram_extremes_find(c, &d, r, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "files");
    d.source.files = files;
    d.source.file_count = 1;
    d.source.channel = "x";
    ck_assert_int_eq(fram_extremes_find(NULL, &d, r, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_extremes_find(c, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_extremes_find(c, &d, r, &error), FRAM_OK);
    ck_assert_int_eq(r->methods, FRAM_EXTREME_METHODS);
    assert_absolute(r->series.greatest, 1, 0);
    d.duration = (double)NAN;
    ck_assert_int_eq(fram_extremes_find(c, &d, r, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "duration");
    d.size = 0;
    ck_assert_int_eq(fram_extremes_find(c, &d, r, &error), FRAM_ERROR_USAGE);
    free(r);
    fram_fatigue_definition f;
    fram_fatigue cycles;
    fram_fatigue_default(&f);
    f.source = d.source;
    ck_assert_int_eq(fram_fatigue_find(c, &f, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_fatigue_find(c, &f, &cycles, &error), FRAM_OK);
    assert_absolute(cycles.greatest, 11, 0);
    ck_assert(cycles.count > 0 && cycles.equivalent[0] > 0);
    fram_fatigue_free(c, &cycles);
    fram_fatigue_free(c, &cycles);
    fram_fatigue_free(NULL, NULL);
    (fram_extremes_default)(NULL, sizeof(size_t));
    (fram_fatigue_default)(NULL, sizeof(size_t));
    f.slope[1] = 0;
    ck_assert_int_eq(fram_fatigue_find(c, &f, &cycles, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "slope");
    keep_what_is_read(c, path);
    fram_context_destroy(c);
    unlink(path);
}
END_TEST

TEST_MAIN("statistics", times_are_read_as_they_stand, numbers_are_read_strictly_and_told,
          misuse_is_refused_and_a_file_is_answered)
