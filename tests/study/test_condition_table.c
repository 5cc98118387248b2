/* Conditions from a CSV file: what programs write is read, and what is unclear is refused at its place. */
#include "scratch.h"

#include "study/condition_table.h"
#include "study/study_file.h"

#include <stdio.h>

static void parse(const char *text, fram_status expected, condition_table *t, fram_error *error)
{
    context ctx;
    context_init(&ctx);
    *error = (fram_error){0};
    ck_assert_msg(condition_table_parse(&ctx, "t.csv", text, strlen(text), t, error) == expected, "%s: %s", text,
                  error->message);
}

static void read_as(const char *text, const char *const *cells, int32_t heads, int32_t rows)
{
    condition_table t;
    fram_error error;
    context ctx;
    context_init(&ctx);
    parse(text, FRAM_OK, &t, &error);
    ck_assert_int_eq(t.heads.count, heads);
    ck_assert_int_eq(t.line.count, rows);
    for (int32_t i = 0; i < heads * (rows + 1); i++)
        ck_assert_str_eq(i < heads ? t.heads.data[i] : t.cells.data[i - heads], cells[i]);
    condition_table_free(&ctx, &t);
}

/* Reads what a study says beside its scenario; *error is left empty where it is taken. */
static fram_status parse_study(context *ctx, const char *text, study *s, fram_error *error)
{
    char whole[160];
    int length = snprintf(whole, sizeof whole, "scenario: base.yaml\n%s", text);
    ck_assert_int_lt(length, (int)sizeof whole);
    *error = (fram_error){0};
    *s = (study){0};
    context_init(ctx);
    return study_parse(ctx, "s.yaml", whole, (size_t)length, s, error);
}

START_TEST(tables_of_any_program_are_read)
{
    static const char *const cells[] = {"vessel.speed", "vessel.mode", "1.50", "towed", "2", "free"};
    read_as("vessel.speed,vessel.mode\n1.50,towed\n2,free\n", cells, 2, 2);
    char wide[400], name[200];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    snprintf(wide, sizeof wide, "vessel.name\n \"%s\" \n", name);
    const char *const longer[] = {"vessel.name", name};
    read_as(wide, longer, 1, 1);
    read_as("\xef\xbb\xbfvessel.speed[m/s] , \"vessel.mode\"\r\n\r\n 1.50 \t,\t\"towed\" \r\n2,free\r\n\r\n", cells, 2,
            2);
    static const char *const odd[] = {"vessel.name", "ice.concentration", "a, \"b\"", "0.5"};
    read_as("vessel.name,ice.concentration[1]\n\"a, \"\"b\"\"\",0.5", odd, 2, 1);
    /* As the page of a study has its heads. */
    read_as("vessel.name,ice.concentration [1]\n\"a, \"\"b\"\"\",0.5", odd, 2, 1);
    static const char *const speed[] = {"vessel.speed", "\xc3\xa9"};
    read_as("vessel.speed  [m/s]\n\xc3\xa9\n", speed, 1, 1);
    static const char *const lists[] = {"vessels[1].speed", "2"};
    read_as("vessels[1].speed[m/s]\n2\n", lists, 1, 1);
}
END_TEST

START_TEST(hours_are_no_key)
{
    static const char *const heads[] = {"hours[h],vessel.speed[m/s],ice.thickness\n120,1,0.5\n1.5e1,2,0.7\n",
                                        "vessel.speed,\"hours\",ice.thickness\n1,120,0.5\n2,15,0.7\n",
                                        "vessel.speed,ice.thickness,hours [h]\n1,0.5,120\n2,0.7,15\n"};
    static const char *const cells[] = {"vessel.speed", "ice.thickness", "1", "0.5", "2", "0.7"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        condition_table t;
        fram_error error;
        context ctx;
        context_init(&ctx);
        read_as(heads[i], cells, 2, 2);
        parse(heads[i], FRAM_OK, &t, &error);
        ck_assert_int_eq(t.hours.count, 2);
        assert_absolute(t.hours.data[0], 120, 0);
        assert_absolute(t.hours.data[1], 15, 0);
        condition_table_free(&ctx, &t);
    }
}
END_TEST

START_TEST(what_is_unclear_is_refused_at_its_place)
{
    static const struct {
        const char *text;
        int line;
        const char *key, *says;
    } bad[] = {
        {"", 1, "", "no head row"},
        {"\n \n", 3, "", "no head row"},
        {"vessel.speed\n\n", 3, "", "no rows"},
        {"vessel.speed;ice.thickness\n1;2\n", 1, "vessel.speed;ice.thickness", "divided by commas"},
        {"vessel.speed,\n1,2\n", 1, "", "empty one"},
        {"vessel.speed,vessel.speed[m/s]\n1,2\n", 1, "vessel.speed", "two columns"},
        {"vessel.speed\n1\n\xe9\n", 3, "", "UTF-8"},
        {"hours[d],vessel.speed\n1,1\n", 1, "hours", "unit h, found d"},
        {"hours,vessel.speed\n1,1\n\n-1,2\n", 4, "hours", "how long a year"},
        {"vessel.speed,hours\n1,often\n", 2, "hours", "how long a year"},
        {"hours\n1\n", 1, "hours", "another column"},
        {"vessel.speed [kn]\n1\n", 1, "vessel.speed", "unit m/s, found kn"},
        {"vessel.speed[kn]\n1\n", 1, "vessel.speed", "unit m/s, found kn"},
        {"ice.concentration[2]\n1\n", 1, "ice.concentration", "unit 1, found 2"},
        {"vessel.speed,ice.thickness\n1,2\n\n1,\n", 4, "ice.thickness", "empty cell"},
        {"vessel.speed,ice.thickness\n1\n", 2, "ice.thickness", "expected 2 cells"},
        {"vessel.speed,ice.thickness\n1,2,3\n", 2, "", "found more"},
        {"vessel.speed\n\"1\n", 2, "vessel.speed", "column 1: the quotation mark that opens here is not closed"},
        {"vessel.speed\n\"1\"2\n", 2, "vessel.speed", "comma behind"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        condition_table t;
        fram_error error;
        parse(bad[i].text, FRAM_ERROR_INPUT, &t, &error);
        ck_assert_msg(error.line == bad[i].line && strcmp(error.key, bad[i].key) == 0 &&
                          strstr(error.message, bad[i].says),
                      "%s: %d: %s: %s", bad[i].text, error.line, error.key, error.message);
        ck_assert_ptr_null(t.heads.data);
    }
    condition_table t;
    fram_error error = {0};
    context ctx;
    context_init(&ctx);
    ck_assert(condition_table_parse(&ctx, "t.csv", "a\n1\0", 4, &t, &error) == FRAM_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "NUL"));
}
END_TEST

/* A study of a table with hours: read again and again, each time with another request for memory that fails, nothing
   is lost or freed twice. */
START_TEST(memory_runs_out)
{
    char folder[SCRATCH_FOLDER], path[SCRATCH_PATH];
    scratch_folder(folder);
    scratch_put(folder, "base.yaml", "ice: {source: none}\n");
    scratch_put(folder, "t.csv", "hours,ice.thickness\n100,1\n200,2\n");
    scratch_put(folder, "s.yaml", "scenario: base.yaml\nvary: {table: t.csv}\nextremes: {annual: [0.01]}\n");
    snprintf(path, sizeof path, "%s/s.yaml", folder);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        study s = {0};
        turn.status = study_read(&turn.ctx, path, &s, &turn.error);
        if (turn.status == FRAM_OK)
            study_free(&turn.ctx, &s);
        if (!turn.memory.failed)
            ck_assert_int_gt(turn.n, 50);
    }
    scratch_remove_folder(folder);
}
END_TEST

START_TEST(hours_fill_a_leap_year_and_no_more)
{
    /* Fifteen times 585.6 is 8784, and in floating point a little more. */
    for (int more = 0; more < 2; more++) {
        char text[400] = "scenario: base.yaml\nextremes: {annual: [0.01], hours: [", last[160];
        for (int i = 0; i < 14; i++)
            strcat(text, "585.6, ");
        snprintf(last, sizeof last,
                 "%s]}\nvary: {grid: {ice.thickness: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, "
                 "14, 15]}}\n",
                 more ? "585.601" : "585.6");
        strcat(text, last);
        context ctx;
        fram_error error = {0};
        study s = {0};
        context_init(&ctx);
        fram_status status = study_parse(&ctx, "s.yaml", text, strlen(text), &s, &error);
        if (more) {
            ck_assert_int_eq(status, FRAM_ERROR_INPUT);
            ck_assert_ptr_nonnull(strstr(error.message, "at most 8784, found 8784.001"));
            continue;
        }
        assert_ok(status, error);
        study_free(&ctx, &s);
    }
}
END_TEST

/* A number in quotes is one to its writer, and a scenario has its keys one in another. */
START_TEST(slips_are_told_with_their_remedy)
{
    static const struct {
        const char *text, *key, *said;
    } cases[] = {
        {"seeds: \"2\"\n", "seeds", "expected a number from 1 to 100000 without quotes, found the text \"2\""},
        {"seeds: {least: }\n", "least", "found nothing"},
        {"seeds: {least: [2]}\n", "least", "found a list"},
        {"extremes: {levels: ['0.5']}\n", "levels", "without quotes, found the text \"0.5\""},
        {"extremes: {duration: [3h]}\n", "duration", "3h, found a list"},
        {"extremes: {method: {gumbel: 1}}\n", "method", "expected gumbel or gev, found a mapping"},
        {"set: {vessel: {speed: 2}}\n", "vessel", "one value of the key, found a mapping; write vessel.speed: 2"},
        {"set: {vessel: {hull: {length: 80}}}\n", "vessel", "write vessel.hull.length: 80"},
        {"set: {vessel: {}}\n", "vessel", "expected one value of the key, found a mapping"},
        {"vary: {list: [{vessel: {speed: 2}}]}\n", "vessel", "found a mapping; write vessel.speed: 2"},
        {"vary: {grid: {vessel: {speed: [1, 2]}}}\n", "vessel", "found a mapping; write vessel.speed: [...]"},
        {"vary: {latin: {count: 2, keys: {ice: {thickness: [1, 2]}}}}\n", "ice", "write ice.thickness: [...]"},
        {"vary: {morris: {}}\n", "morris", "expected count, keys and, if wanted, seed, which is not empty"},
        {"vary: {latin: {count: 2, keys: {ice.thickness: {values: [1, 2], seed: 2}}}}\n", "seed",
         "expected nothing beside values, as ice.thickness: {values: [1, 2]}"},
        {"vary: {latin: {count: 2, keys: {vessel.mode: {values: [towed, free], x: 1}}}}\n", "x",
         "as vessel.mode: {values: [towed, free]}"},
        {"vary: {latin: {count: 2, keys: {ice.thickness: {values: 3, x: 1}}}}\n", "x",
         "as ice.thickness: {values: [...]}"},
        {"vary: {latin: {count: 2, keys: {ice: {thickness: [0.5, 0.6], values: [1, 2]}}}}\n", "ice",
         "write ice.thickness: [...]"},
        {"vary: {latin: {count: 2, keys: {ice.thickness: {value: [1, 2]}}}}\n", "ice.thickness",
         "as [0.5, 1.5], found a mapping"},
        {"vary: {latin: {count: 2, keys: {ice: {thickness: {values: [1, 2]}}}}}\n", "ice",
         "write ice.thickness: {...}"},
        {"vary: {latin: {count: 2, levels: 4}}\n", "vary.latin.levels", "count, seed or keys"},
        {"vary: {sobol: {count: 16}}\n", "sobol", "keys is missing"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        context ctx;
        fram_error error;
        study s;
        ck_assert_int_eq(parse_study(&ctx, cases[i].text, &s, &error), FRAM_ERROR_INPUT);
        ck_assert_str_eq(error.key, cases[i].key);
        ck_assert_msg(strstr(error.message, cases[i].said) != NULL, "%s: %s", cases[i].text, error.message);
        ck_assert_msg(!strstr(error.message, "write ice.thickness."), "there is no such key: %s", error.message);
    }
}
END_TEST

/* What would be refused is no remedy. */
START_TEST(no_remedy_is_told_that_would_be_refused)
{
    static const char *const texts[] = {"set: {run: {duration: {values: 3}}}\n",
                                        "set: {run: {duration: [3]}}\n",
                                        "set: {vessel: {no: {such: 3}}}\n",
                                        "set: {vessel.mooring.lines: {value: 3}}\n",
                                        "vary: {grid: {run: {duration: {values: [3]}}}}\n",
                                        "vary: {grid: {run: {duration: 3}}}\n",
                                        "vary: {list: [{run: {duration: {values: 3}}}]}\n",
                                        "vary: {morris: {count: 2, keys: {ice: {thickness: {values: [1, 2]}}}}}\n",
                                        "vary: {latin: {count: 2, keys: {vessel.mooring.lines: {value: [1, 2]}}}}\n",
                                        "vary: {latin: {count: 2, keys: {vessel.mooring.lines: {values: [1, 2]}}}}\n",
                                        "vary: {latin: {count: 2, keys: {ice: {values: [1, 2]}}}}\n",
                                        "vary: {latin: {count: 2, keys: {ice: {thickness: {value: [1, 2]}}}}}\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        context ctx;
        fram_error error;
        study s;
        ck_assert_int_eq(parse_study(&ctx, texts[i], &s, &error), FRAM_ERROR_INPUT);
        ck_assert_msg(strstr(error.message, "found a mapping") != NULL, "%s: %s", texts[i], error.message);
        ck_assert_msg(!strstr(error.message, "write "), "%s: %s", texts[i], error.message);
    }
}
END_TEST

/* Seeds of runs and of designs are those of run.seed, whose largest is 2^53 - 1. */
START_TEST(seeds_go_as_far_as_those_of_a_scenario)
{
    static const struct {
        const char *text, *said; /* NULL: it is taken */
    } cases[] = {
        {"seeds: {least: 2, first: 9007199254740990}\n", NULL},
        {"seeds: {least: 2, first: 9007199254740991}\n", "expected first up to 9007199254740990"},
        {"seeds: {least: 1, first: 9007199254740991}\n", NULL},
        {"seeds: {least: 1, first: 9007199254740992}\n", "from 0 to 9007199254740991, found 9007199254740992"},
        {"vary: {latin: {count: 2, seed: 9007199254740991, keys: {ice.thickness: [1, 2]}}}\n", NULL},
        {"vary: {latin: {count: 2, seed: 9007199254740992, keys: {ice.thickness: [1, 2]}}}\n", "to 9007199254740991"},
        {"vary: {morris: {count: 2, seed: 9007199254740991, keys: {ice.thickness: [1, 2]}}}\n", NULL},
        {"vary: {sobol: {count: 16, seed: 9007199254740992, keys: {ice.thickness: [1, 2]}}}\n", "to 9007199254740991"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        context ctx;
        fram_error error;
        study s;
        fram_status status = parse_study(&ctx, cases[i].text, &s, &error);
        ck_assert_int_eq(status, cases[i].said ? FRAM_ERROR_INPUT : FRAM_OK);
        if (cases[i].said)
            ck_assert_msg(strstr(error.message, cases[i].said) != NULL, "%s: %s", cases[i].text, error.message);
        else
            study_free(&ctx, &s);
    }
}
END_TEST

/* What the command takes for a time, by the list that tests/study/test_statistics.py reads. */
START_TEST(times_are_those_of_the_command)
{
    FILE *file = fopen("tests/data/times.csv", "r");
    char line[80], text[120];
    int rows = 0;
    ck_assert_ptr_nonnull(file);
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    for (; fgets(line, sizeof line, file); rows++) {
        char *seconds = strchr(line, ',');
        ck_assert_ptr_nonnull(seconds);
        *seconds++ = '\0';
        bool good = *seconds != '\n';
        context ctx;
        fram_error error = {0};
        study s = {0};
        context_init(&ctx);
        int length = snprintf(text, sizeof text, "scenario: base.yaml\nextremes: {duration: %s}\n", line);
        fram_status status = study_parse(&ctx, "s.yaml", text, (size_t)length, &s, &error);
        ck_assert_msg((status == FRAM_OK) == good, "%s: %s", line, error.message);
        if (status != FRAM_OK)
            continue;
        assert_relative(s.extremes.duration, strtod(seconds, NULL), 1e-15);
        study_free(&ctx, &s);
    }
    ck_assert_int_gt(rows, 10);
    ck_assert_int_eq(fclose(file), 0);
}
END_TEST

TEST_MAIN("condition_table", times_are_those_of_the_command, tables_of_any_program_are_read, hours_are_no_key,
          what_is_unclear_is_refused_at_its_place, slips_are_told_with_their_remedy,
          no_remedy_is_told_that_would_be_refused, seeds_go_as_far_as_those_of_a_scenario, memory_runs_out,
          hours_fill_a_leap_year_and_no_more)
