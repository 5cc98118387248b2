/* Extremes and fatigue through the public API: misuse is refused, and a small file is answered. */
#include "testing.h"

#include "fram/statistics.h"

#include <stdio.h>
#include <unistd.h>

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
    fram_context_destroy(c);
    unlink(path);
}
END_TEST

TEST_MAIN("statistics", misuse_is_refused_and_a_file_is_answered)
