/* io/json_walk: texts mean what was written, whatever room there is, and what is no text is refused. */
#include "io/json_walk.h"
#include "io/text_buffer.h"
#include "testing.h"

#include <string.h>

enum { ROOM = 64 };

static fram_status read_text(const char *json, char *text, size_t room, fram_error *error)
{
    json_walk w = json_walk_begin("run.json", json, strlen(json), 8);
    fram_status status = json_walk_text(&w, text, room, error);
    return status == FRAM_OK ? json_walk_end(&w, error) : status;
}

START_TEST(escapes_are_what_they_mean)
{
    static const struct {
        const char *json, *text;
    } cases[] = {{"\"\"", ""},
                 {"\"plain \xc3\xa4\"", "plain \xc3\xa4"},
                 {"\"a \\\"b\\\" \\\\ \\/ \\b\\f\\n\\r\\t.\"", "a \"b\" \\ / \b\f\n\r\t."},
                 {"\"\\u0041\\u00e4\\u20AC\\uFFFD\"", "A\xc3\xa4\xe2\x82\xac\xef\xbf\xbd"},
                 {"\"\\ud83e\\uddca \\uDBFF\\uDFFF\"", "\xf0\x9f\xa7\x8a \xf4\x8f\xbf\xbf"},
                 /* Half a pair, pairs the wrong way round, and NUL. */
                 {"\"\\ud83e\"", "\xef\xbf\xbd"},
                 {"\"\\ud83ex\\uddca\"", "\xef\xbf\xbdx\xef\xbf\xbd"},
                 {"\"\\uddca\\ud83e\\u0041\"", "\xef\xbf\xbd\xef\xbf\xbd"
                                               "A"},
                 {"\"\\ud83e\\ud83e\\uddca\"", "\xef\xbf\xbd\xf0\x9f\xa7\x8a"},
                 {"\"a\\u0000b\"", "a\xef\xbf\xbd"
                                   "b"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fram_error error = {0};
        char text[ROOM];
        assert_ok(read_text(cases[i].json, text, sizeof text, &error), error);
        ck_assert_str_eq(text, cases[i].text);
    }
}
END_TEST

/* What text_quoted writes, whatever it is given. */
START_TEST(what_is_written_comes_back)
{
    static const char *const texts[] = {"tow \"A\" \\ B / C", "tab\tand\nline\x01\x1f", "\xf0\x9f\xa7\x8a \xc3\xa9",
                                        ""};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        fram_error error = {0};
        char text[ROOM];
        text_buffer json = {0};
        text_quoted(&ctx, &json, texts[i]);
        assert_ok(read_text(json.data, text, sizeof text, &error), error);
        ck_assert_str_eq(text, texts[i]);
        text_free(&ctx, &json);
    }
}
END_TEST

/* A text is cut between characters, and nothing stands beyond its room. */
START_TEST(a_long_text_is_cut)
{
    static const char json[] = "\"ab\\u20ac\\ud83e\\uddcac\"";
    static const char *const cut[] = {"", "a", "ab", "ab", "ab", "ab\xe2\x82\xac", "ab\xe2\x82\xac"};
    for (size_t room = 1; room <= sizeof cut / sizeof *cut; room++) {
        fram_error error = {0};
        char text[ROOM];
        memset(text, '#', sizeof text);
        assert_ok(read_text(json, text, room, &error), error);
        ck_assert_str_eq(text, cut[room - 1]);
        for (size_t k = room; k < sizeof text; k++)
            ck_assert_int_eq(text[k], '#');
    }
}
END_TEST

START_TEST(what_is_no_text_is_refused)
{
    static const struct {
        const char *json, *words;
    } cases[] = {{"\"\\x\"", "an escape of JSON"},
                 {"\"\\", "an escape of JSON"},
                 {"\"\\u12g4\"", "four hexadecimal digits"},
                 {"\"\\u12", "four hexadecimal digits"},
                 {"\"\\ud83e\\u\"", "four hexadecimal digits"},
                 {"\"\\ud83e\\udd", "four hexadecimal digits"},
                 {"\"\\ud83e", "at the end of a string"},
                 {"\"a\nb\"", "no control character"},
                 {"\"\xc3\"", "UTF-8"},
                 {"\"\xed\xa0\xbe\"", "UTF-8"},
                 {"\"open", "at the end of a string"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fram_error error = {0};
        char text[ROOM];
        assert_fails(read_text(cases[i].json, text, sizeof text, &error), error, FRAM_ERROR_INPUT, cases[i].words);
    }
}
END_TEST

/* What a run did not measure is null in its notes. */
START_TEST(numbers_may_be_missing)
{
    fram_error error = {0};
    context ctx;
    text_buffer json = {0};
    context_init(&ctx);
    text_add(&ctx, &json, "[");
    text_real_or_null(&ctx, &json, (double)NAN);
    text_add(&ctx, &json, ",");
    text_real_or_null(&ctx, &json, -HUGE_VAL);
    text_add(&ctx, &json, ",");
    text_digits_or_null(&ctx, &json, HUGE_VAL, 3);
    text_add(&ctx, &json, ",");
    text_digits_or_null(&ctx, &json, 1.23456, 3);
    text_add(&ctx, &json, ",");
    text_real_or_null(&ctx, &json, 0.1);
    text_add(&ctx, &json, "]");
    ck_assert_str_eq(json.data, "[null,null,null,1.23,0.1]");
    json_walk w = json_walk_begin("run.json", json.data, (size_t)json.count, 8);
    json_loop loop = json_walk_into(&w, JSON_ARRAY, &error);
    int count = 0;
    for (; json_walk_next(&w, &loop, &error); count++) {
        double value = 7;
        loop.status = json_walk_number_or_null(&w, &value, &error);
        ck_assert(count < 3 ? isnan(value) : value == (count == 3 ? 1.23 : 0.1));
    }
    assert_ok(loop.status, error);
    ck_assert_int_eq(count, 5);
    assert_ok(json_walk_end(&w, &error), error);
    w = json_walk_begin("run.json", "nan", 3, 8);
    double value = 7;
    assert_fails(json_walk_number_or_null(&w, &value, &error), error, FRAM_ERROR_INPUT, "expected");
    text_free(&ctx, &json);
}
END_TEST

/* Of arrays and objects, whatever is met in them, and what its user makes of it. */
START_TEST(loops_end)
{
    static const struct {
        const char *json, *words;
        int items;
        json_kind kind;
    } cases[] = {{"[]", NULL, 0, JSON_ARRAY},
                 {" { } ", NULL, 0, JSON_OBJECT},
                 {"[1, [2], {\"a\": 3}]", NULL, 3, JSON_ARRAY},
                 {"{\"a\": [1, 2], \"b\": null}", NULL, 2, JSON_OBJECT},
                 {"{}", "an array, '['", 0, JSON_ARRAY},
                 {"[[[[]]]]", "nested more than 3 deep", 1, JSON_ARRAY},
                 {"[1 2]", "',' or ']'", 1, JSON_ARRAY},
                 {"{\"a\": 1; \"b\": 2}", "',' or '}'", 1, JSON_OBJECT},
                 {"{\"a\": 1, 2}", "the name of a member in quotes", 1, JSON_OBJECT},
                 {"{\"a\" 1}", "':'", 0, JSON_OBJECT},
                 {"[1,", "expected", 2, JSON_ARRAY}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fram_error error = {0};
        char key[8];
        int items = 0;
        json_walk w = json_walk_begin("run.json", cases[i].json, strlen(cases[i].json), 3);
        json_loop loop = json_walk_into(&w, cases[i].kind, &error);
        while (cases[i].kind == JSON_ARRAY ? json_walk_next(&w, &loop, &error)
                                           : json_walk_next_member(&w, &loop, key, sizeof key, &error)) {
            loop.status = json_walk_skip(&w, &error);
            items++;
        }
        ck_assert_int_eq(items, cases[i].items);
        if (cases[i].words) {
            assert_fails(loop.status, error, FRAM_ERROR_INPUT, cases[i].words);
        } else {
            assert_ok(loop.status, error);
            assert_ok(json_walk_end(&w, &error), error);
        }
    }
    fram_error error = {0};
    json_walk w = json_walk_begin("run.json", "[1, 2]", 6, 3);
    json_loop loop = json_walk_into(&w, JSON_ARRAY, &error);
    ck_assert(json_walk_next(&w, &loop, &error));
    loop.status = FRAM_ERROR_MEMORY;
    ck_assert(!json_walk_next(&w, &loop, &error));
    ck_assert_int_eq(loop.status, FRAM_ERROR_MEMORY);
}
END_TEST

TEST_MAIN("json_walk", escapes_are_what_they_mean, what_is_written_comes_back, a_long_text_is_cut,
          what_is_no_text_is_refused, numbers_may_be_missing, loops_end)
