/* io/scene_file: every statement, the defaults, and what is refused, with its line. */
#include "io/scene_file.h"
#include "scratch.h"

#define BASIN "icescene 1\ndomain -10 0 100 50\n"
#define SQUARE "floe 1 910 10 20 4 -5 -5 5 -5 5 5 -5 5\n"

static fram_status parse(const char *text, size_t size, scene_text *out, fram_error *error)
{
    context ctx;
    context_init(&ctx);
    memset(error, 0, sizeof *error);
    char *copy = malloc(size + 1);
    memcpy(copy, text, size + 1);
    fram_status status = scene_text_parse(&ctx, "a.scene", copy, size, out, error);
    free(copy);
    return status;
}

static void release(scene_text *s)
{
    context ctx;
    context_init(&ctx);
    scene_text_free(&ctx, s);
}

static void assert_refused(const char *text, size_t size, int line, const char *words)
{
    scene_text s;
    fram_error error;
    ck_assert_int_eq(parse(text, size, &s, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.file, "a.scene");
    ck_assert_msg(error.line == line, "line %d instead of %d: %s", error.line, line, error.message);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    ck_assert_ptr_null(s.floes.data);
}
#define ASSERT_REFUSED(text, line, words) assert_refused((text), sizeof(text) - 1, (line), (words))

START_TEST(every_statement_is_read)
{
    static const char text[] = "icescene 1\n"
                               "# a comment\n\n"
                               "gravity 9.8\nwater_density 1000\ncurrent 0.3 -0.1\ndrag 1.2 0.02\r\n"
                               "friction 0.25\nrestitution 0\n"
                               "domain -110 0 316.228 300\n"
                               "ship 100 20 12 6 -51 158.1 2 0.5\n" SQUARE "\tfloe 0.5 900 -1e1 2 3 -5 -5 5 -5 0 10";
    scene_text s;
    fram_error error;
    assert_ok(parse(text, sizeof text - 1, &s, &error), error);
    assert_bits(s.gravity, 9.8);
    assert_bits(s.water_density, 1000);
    assert_bits(s.current.y, -0.1);
    assert_bits(s.form_drag, 1.2);
    assert_bits(s.skin_drag, 0.02);
    assert_bits(s.friction, 0.25);
    assert_bits(s.domain.hi.x, 316.228);
    ck_assert(s.ship);
    assert_bits(s.ship_draught, 6);
    assert_bits(s.ship_centre.y, 158.1);
    assert_bits(s.ship_velocity.y, 0.5);
    ck_assert_int_eq(s.floes.count, 2);
    assert_bits(s.floes.data[1].thickness, 0.5);
    assert_bits(s.floes.data[1].centre.x, -10);
    ck_assert_int_eq(scene_floe_outline(&s, 1).count, 3);
    assert_bits(scene_floe_outline(&s, 1).vertex[2].y, 10);
    release(&s);
}
END_TEST

START_TEST(left_out_statements_have_the_peers_defaults)
{
    scene_text s;
    fram_error error;
    assert_ok(parse(BASIN SQUARE, sizeof(BASIN SQUARE) - 1, &s, &error), error);
    assert_bits(s.gravity, 9.81);
    assert_bits(s.water_density, 1025);
    assert_bits(s.form_drag, 1);
    assert_bits(s.skin_drag, 0.01);
    assert_bits(s.friction, 0.1);
    ck_assert(!s.ship);
    release(&s);
}
END_TEST

START_TEST(what_is_wrong_is_refused_at_its_line)
{
    ASSERT_REFUSED("", 0, "no walls");
    ASSERT_REFUSED("gravity 9.81\n", 1, "begins with");
    ASSERT_REFUSED("icescene 2\n", 1, "version 1");
    ASSERT_REFUSED("icescene 1\nicescene 1\n", 2, "before");
    ASSERT_REFUSED("icescene 1\n" SQUARE, 2, "no walls");
    ASSERT_REFUSED(BASIN, 2, "no floes");
    ASSERT_REFUSED(BASIN "sail 1\n", 3, "unknown statement 'sail'");
    ASSERT_REFUSED(BASIN "gravity ten\n", 3, "expected a number, found 'ten'");
    ASSERT_REFUSED(BASIN "gravity nan\n", 3, "expected a number");
    ASSERT_REFUSED(BASIN "gravity\n", 3, "line ends");
    ASSERT_REFUSED(BASIN "gravity 9.81 3\n", 3, "more values");
    ASSERT_REFUSED(BASIN "gravity -1\n", 3, "expected 0 to");
    ASSERT_REFUSED(BASIN "current 1e300 0\n", 3, "found 1e+300");
    ASSERT_REFUSED(BASIN "restitution 0.5\n", 3, "only 0");
    ASSERT_REFUSED("icescene 1\ndomain 0 0 0 1\n", 2, "xmin < xmax");
    ASSERT_REFUSED(BASIN "ship 100 20 12 0 0 0 2 0\n", 3, "found 0");
    ASSERT_REFUSED(BASIN "gravity 9\0.81\n", 3, "NUL");
}
END_TEST

/* Wherever the water's density stands; 1025 kg/m3 where it does not. */
START_TEST(ice_floats)
{
    ASSERT_REFUSED(BASIN "floe 1 1025 0 0 4 -5 -5 5 -5 5 5 -5 5\n" SQUARE, 3, "found 1025");
    ASSERT_REFUSED(BASIN SQUARE "floe 1 1000 0 0 4 -5 -5 5 -5 5 5 -5 5\nwater_density 990\n", 4,
                   "less than that of the water, 990 kg/m3, so that ice floats, found 1000");
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    scene_text s;
    char text[] = BASIN "floe 1 1000 0 0 4 -5 -5 5 -5 5 5 -5 5\n";
    assert_ok(scene_text_parse(&ctx, "text", text, strlen(text), &s, &error), error);
    scene_text_free(&ctx, &s);
}
END_TEST

START_TEST(floes_must_be_convex_and_about_their_centre)
{
    ASSERT_REFUSED(BASIN "floe 1 910 0 0 2 0 0 1 1\n", 3, "expected 3 to 16");
    ASSERT_REFUSED(BASIN "floe 1 910 0 0 3.5 0 0 1 1 0 1\n", 3, "no integer");
    ASSERT_REFUSED(BASIN "floe 0 910 0 0 4 -5 -5 5 -5 5 5 -5 5\n", 3, "found 0");
    ASSERT_REFUSED(BASIN "floe 1 910 0 0 4 -5 -5 5 -5 5 5\n", 3, "line ends");
    ASSERT_REFUSED(BASIN SQUARE "floe 1 910 0 0 4 -5 -5 -5 5 5 5 5 -5\n", 4, "counter-clockwise");
    ASSERT_REFUSED(BASIN "floe 1 910 0 0 4 -5 -5 5 -5 -4 -4 -5 5\n", 3, "convex");
    ASSERT_REFUSED(BASIN "floe 1 910 0 0 3 0 0 1 0 2 0\n", 3, "convex");
    ASSERT_REFUSED(BASIN "floe 1 910 0 0 4 0 0 10 0 10 10 0 10\n", 3, "centroid");
}
END_TEST

START_TEST(files_are_read_and_missing_ones_named)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    scene_text s;
    scratch place = scratch_make();
    scratch_write(scratch_path(&place, "b.scene"), BASIN SQUARE, sizeof(BASIN SQUARE) - 1);
    assert_ok(scene_file_read(&ctx, place.path, &s, &error), error);
    ck_assert_int_eq(s.floes.count, 1);
    scene_text_free(&ctx, &s);
    scratch_remove(&place, "b.scene");
    ck_assert_int_eq(scene_file_read(&ctx, "nowhere/b.scene", &s, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.file, "nowhere/b.scene");
}
END_TEST

START_TEST(memory_runs_out)
{
    char text[2000] = BASIN;
    for (int i = 0; i < 30; i++)
        strcat(text, SQUARE);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        scene_text s;
        char copy[sizeof text];
        memcpy(copy, text, sizeof text);
        turn.status = scene_text_parse(&turn.ctx, "a.scene", copy, strlen(text), &s, &turn.error);
        scene_text_free(&turn.ctx, &s);
    }
}
END_TEST

TEST_MAIN("scene_file", every_statement_is_read, left_out_statements_have_the_peers_defaults,
          what_is_wrong_is_refused_at_its_line, floes_must_be_convex_and_about_their_centre, ice_floats,
          files_are_read_and_missing_ones_named, memory_runs_out)
