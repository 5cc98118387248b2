/* io/yaml_tree and io/utf8: structure, places, strictness. */
#include "io/text_buffer.h"
#include "io/utf8.h"
#include "io/yaml_tree.h"
#include "testing.h"
#include <stdio.h>

static context ctx;
static fram_error error;
static yaml_tree tree;

static fram_status parse(const char *text, int32_t depth)
{
    context_init(&ctx);
    memset(&error, 0, sizeof error);
    return yaml_tree_parse(&ctx, "test", text, strlen(text), depth, &tree, &error);
}

static int32_t child(int32_t node, int index)
{
    int32_t i = tree.nodes.data[node].first;
    while (index-- > 0)
        i = tree.nodes.data[i].next;
    return i;
}

START_TEST(the_tree_mirrors_the_text)
{
    assert_ok(parse("a: 1\n"
                    "b:\n"
                    "  - x\n"
                    "  - \"y\"\n"
                    "  - {c: [1, 2]}\n"
                    "d: |\n"
                    "  block\n"
                    "e:\n",
                    16),
              error);
    const yaml_node *root = &tree.nodes.data[0];
    ck_assert_int_eq(root->kind, YAML_MAPPING);
    ck_assert_int_eq(root->count, 4);
    ck_assert_int_eq(root->key, -1);
    ck_assert_int_eq(root->parent, -1);
    const yaml_node *a = &tree.nodes.data[child(0, 0)];
    ck_assert_str_eq(yaml_text(&tree, a->key), "a");
    ck_assert_str_eq(yaml_text(&tree, a->value), "1");
    ck_assert_int_eq(a->line, 1);
    ck_assert_int_eq(a->column, 4);
    ck_assert_int_eq(a->key_column, 1);
    ck_assert(!a->quoted);
    int32_t b = child(0, 1);
    ck_assert_int_eq(tree.nodes.data[b].kind, YAML_SEQUENCE);
    ck_assert_int_eq(tree.nodes.data[b].count, 3);
    ck_assert_int_eq(tree.nodes.data[b].key_line, 2);
    const yaml_node *y = &tree.nodes.data[child(b, 1)];
    ck_assert(y->quoted);
    ck_assert_str_eq(yaml_text(&tree, y->value), "y");
    ck_assert_int_eq(y->line, 4);
    ck_assert_int_eq(y->column, 5);
    ck_assert_int_eq(y->key, -1);
    int32_t c = child(child(b, 2), 0);
    ck_assert_int_eq(tree.nodes.data[c].kind, YAML_SEQUENCE);
    ck_assert_str_eq(yaml_text(&tree, tree.nodes.data[child(c, 1)].value), "2");
    const yaml_node *d = &tree.nodes.data[child(0, 2)];
    ck_assert(d->quoted);
    ck_assert_str_eq(yaml_text(&tree, d->value), "block\n");
    const yaml_node *e = &tree.nodes.data[child(0, 3)];
    ck_assert(!e->quoted);
    ck_assert_str_eq(yaml_text(&tree, e->value), "");
    ck_assert_int_eq(e->next, -1);
    yaml_tree_free(&ctx, &tree);
}
END_TEST

/* Text that libfyaml hands out in many pieces, and in none. */
START_TEST(text_arrives_whole)
{
    assert_ok(parse("\"one\\ttwo\\u00e9\\\"\n\n  three\n  four\\n\\n\\n\\n\\n\\n\\n\\n\\n\\n\\n\\n.\"", 16), error);
    ck_assert_str_eq(yaml_text(&tree, tree.nodes.data[0].value),
                     "one\ttwo\xc3\xa9\"\nthree four\n\n\n\n\n\n\n\n\n\n\n\n.");
    yaml_tree_free(&ctx, &tree);
    static const char *const empty[] = {"a: |\n", "a: |\n \n", "a: >-\n\nb: 1\n", "a: ''\n", "a: \"\"\n"};
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) {
        assert_ok(parse(empty[i], 16), error);
        ck_assert_uint_eq(strspn(yaml_text(&tree, tree.nodes.data[child(0, 0)].value), "\n"),
                          strlen(yaml_text(&tree, tree.nodes.data[child(0, 0)].value)));
        ck_assert(tree.nodes.data[child(0, 0)].quoted);
        yaml_tree_free(&ctx, &tree);
    }
}
END_TEST

START_TEST(an_empty_text_has_no_nodes)
{
    assert_ok(parse("", 16), error);
    ck_assert_int_eq(tree.nodes.count, 0);
    assert_ok(parse("# comment\n", 16), error);
    ck_assert_int_eq(tree.nodes.count, 0);
    yaml_tree_free(&ctx, &tree);
}
END_TEST

START_TEST(nesting_is_limited)
{
    assert_ok(parse("[[[]]]", 3), error);
    yaml_tree_free(&ctx, &tree);
    assert_fails(parse("[[[]]]", 2), error, FRAM_ERROR_INPUT, "less nesting");
    ck_assert_str_eq(error.key, "[0][0]");
    ck_assert_int_eq(error.column, 3);
    /* No limit of a reader is above that of the room. */
    char deep[400];
    memset(deep, '[', 200);
    memset(deep + 200, ']', 200);
    context_init(&ctx);
    ck_assert_int_eq(yaml_tree_parse(&ctx, "test", deep, 400, INT32_MAX, &tree, &error), FRAM_ERROR_INPUT);
}
END_TEST

START_TEST(duplicates_are_per_mapping)
{
    assert_ok(parse("{a: {a: 1}, b: {a: 1}, c: [{a: 1}, {a: 1}]}", 16), error);
    yaml_tree_free(&ctx, &tree);
    assert_fails(parse("{a: {b: 1}, c: 2, \"a\": 3}", 16), error, FRAM_ERROR_INPUT, "each key once");
    ck_assert_str_eq(error.key, "a");
    ck_assert_int_eq(error.column, 19);
    assert_fails(parse("- 1\n- {x: {k: 1, k: 2}}\n", 16), error, FRAM_ERROR_INPUT, "each key once");
    ck_assert_str_eq(error.key, "[1].x.k");
}
END_TEST

/* Thousands of keys: the hash table of names grows, and still finds the one that is there twice. */
START_TEST(very_many_keys_are_told_apart)
{
    context_init(&ctx);
    enum { KEYS = 20000 };
    char *text = malloc(KEYS * 16 + 20);
    size_t size = 0;
    for (int i = 0; i < KEYS; i++)
        size += (size_t)sprintf(text + size, "k%d: %d\n", i, i);
    assert_ok(yaml_tree_parse(&ctx, "test", text, size, 4, &tree, &error), error);
    ck_assert_int_eq(tree.nodes.count, KEYS + 1);
    yaml_tree_free(&ctx, &tree);
    size += (size_t)sprintf(text + size, "k777: 0\n");
    assert_fails(yaml_tree_parse(&ctx, "test", text, size, 4, &tree, &error), error, FRAM_ERROR_INPUT, "each key once");
    ck_assert_int_eq(error.line, KEYS + 1);
    ck_assert_str_eq(error.key, "k777");
    free(text);
}
END_TEST

START_TEST(syntax_errors_have_a_place_and_print_nothing)
{
    fflush(stderr);
    assert_fails(parse("a: [1, 2]]\nb: 3\n", 16), error, FRAM_ERROR_INPUT, "not valid YAML");
    ck_assert_int_eq(error.line, 1);
    assert_fails(parse("a: 'x\n", 16), error, FRAM_ERROR_INPUT, "not valid YAML");
    ck_assert_int_eq(error.line, 1);
    assert_fails(parse("a: b: c\n", 16), error, FRAM_ERROR_INPUT, "not valid YAML");
    ck_assert_int_eq(error.line, 1);
    ck_assert_str_eq(error.file, "test");
    ck_assert_int_eq(yaml_tree_parse(&ctx, "test", "[", 1, 16, &tree, NULL), FRAM_ERROR_INPUT);
}
END_TEST

START_TEST(memory_runs_out)
{
    static const char text[] = "a: {b: [1, 2, {c: d}]}\n";
    for (failing_turn turn = {0}; failing_next(&turn);) {
        turn.status = yaml_tree_parse(&turn.ctx, "test", text, strlen(text), 16, &tree, &error);
        if (turn.status == FRAM_OK)
            yaml_tree_free(&turn.ctx, &tree);
    }
}
END_TEST

static int32_t first_of(const char *bytes, size_t size, size_t *used)
{
    const char *at = bytes;
    int32_t code = utf8_next(&at, bytes + size);
    *used = (size_t)(at - bytes);
    return code;
}

START_TEST(utf8_is_decoded_strictly)
{
    static const struct {
        const char *bytes;
        int32_t code;
    } good[] = {{"A", 'A'},
                {"\x7f", 0x7f},
                {"\xc2\x80", 0x80},
                {"\xdf\xbf", 0x7ff},
                {"\xe0\xa0\x80", 0x800},
                {"\xed\x9f\xbf", 0xd7ff},
                {"\xee\x80\x80", 0xe000},
                {"\xef\xbf\xbf", 0xffff},
                {"\xf0\x90\x80\x80", 0x10000},
                {"\xf4\x8f\xbf\xbf", 0x10ffff}};
    static const char *const bad[] = {"\x80",
                                      "\xbf",
                                      "\xc0\x80",
                                      "\xc1\xbf",
                                      "\xc2",
                                      "\xc2\x41",
                                      "\xe0\x9f\xbf",
                                      "\xed\xa0\x80",
                                      "\xed\xbf\xbf",
                                      "\xe2\x82",
                                      "\xf0\x8f\xbf\xbf",
                                      "\xf4\x90\x80\x80",
                                      "\xf5\x80\x80\x80",
                                      "\xff",
                                      "\xf0\x9f\x98"};
    size_t used;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        ck_assert_int_eq(first_of(good[i].bytes, strlen(good[i].bytes), &used), good[i].code);
        ck_assert_uint_eq(used, strlen(good[i].bytes));
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ck_assert_msg(first_of(bad[i], strlen(bad[i]), &used) == -1, "case %zu", i);
        ck_assert_uint_eq(used, 0);
    }
    ck_assert(utf8_is_printable('a') && utf8_is_printable(0xe9) && utf8_is_printable(0x1f600));
    static const int32_t hidden[] = {0, 9, 10, 0x1f, 0x7f, 0x85, 0x9f, 0x2028, 0x2029, 0xfeff, 0xfffe, 0xffff};
    for (size_t i = 0; i < sizeof hidden / sizeof *hidden; i++)
        ck_assert(!utf8_is_printable(hidden[i]));
    /* Shown and quoted: what is none is one sign a byte. */
    static const char name[] = "a\xff\xc3\xa9\xe2\x82\x1b\t\xc2\x85";
    static const int32_t shown[] = {'a', 0xfffd, 0xe9, 0xfffd, 0xfffd, 0xfffd, '\t', 0xfffd};
    const char *at = name;
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        ck_assert_int_eq(utf8_shown(&at, name + sizeof name - 1), shown[i]);
    ck_assert_ptr_eq(at, name + sizeof name - 1);
    text_buffer b = {0};
    context_init(&ctx);
    text_quoted(&ctx, &b, "a\xff\xc3\xa9\x1b\"");
    ck_assert_str_eq(b.data, "\"a\\ufffd\xc3\xa9\\u001b\\\"\"");
    text_free(&ctx, &b);
}
END_TEST

/* Where a person has to look, not where a parser notices. */
START_TEST(wrong_indentation_is_blamed_on_its_line)
{
    static const struct {
        const char *text;
        int line, column;
        const char *part;
    } wrong[] = {
        {"a:\n  b:\n    c: 1\n   d: 2\n", 4, 4, "by 3 blanks, as no block above is; the last line before is line 3"},
        {"a:\n  b: 1\n\n   # note\n   c: 2\n", 5, 4, "under a key that has its value: line 2, \"b\""},
        {"a:\n  b: 1\n c: 2\n", 3, 2, "by 1 blank, as no block above is"},
        {"a: 1\nb:\nc: 3\n  d: 4\ne: 5\n", 4, 3, "line 3, \"c\""},
        {"a:\n  - b: 1\n    c: 2\n   d: 3\n", 4, 4, "as no block above is"},
        {"a:\n  - {b: 1,\n c: 2\nd:\n  e: 1\n", 2, 5, "bracket that opens here is not closed"},
        {"a: [1, 2\n", 1, 4, "bracket that opens here is not closed"},
        {"a: [1,\n  {b: 2\n", 1, 4, "bracket that opens here is not closed"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_fails(parse(wrong[i].text, 16), error, FRAM_ERROR_INPUT, wrong[i].part);
        ck_assert_int_eq(error.line, wrong[i].line);
        ck_assert_int_eq(error.column, wrong[i].column);
        ck_assert_str_eq(error.key, "");
    }
    /* Other faults keep the parser's own words, whatever stands in quotes and comments. */
    assert_fails(parse("a: \"[\"\nb: '{' # [\nc: *\n", 16), error, FRAM_ERROR_INPUT, "not valid YAML");
    ck_assert_int_eq(error.line, 3);
    /* And what is sound is not asked at all. */
    assert_ok(
        parse("a:\n- b: 1\n  c: [1,\n     2]\n-   d: {e: 1}\n    f:\n      - - 1\n        - 2\ng: |\n   x\n     y\n",
              16),
        error);
    yaml_tree_free(&ctx, &tree);
}
END_TEST

TEST_MAIN("yaml_tree", the_tree_mirrors_the_text, text_arrives_whole, an_empty_text_has_no_nodes, nesting_is_limited,
          duplicates_are_per_mapping, very_many_keys_are_told_apart, syntax_errors_have_a_place_and_print_nothing,
          wrong_indentation_is_blamed_on_its_line, memory_runs_out, utf8_is_decoded_strictly)
