/* io/template_file: shapes of floes; faulty outlines are left out, a file of nothing else is named. */
#include "io/template_file.h"
#include "scratch.h"

static fram_status read_text(const char *text, polygon_list *out, fram_error *error)
{
    context ctx;
    context_init(&ctx);
    scratch s = scratch_make();
    scratch_text(scratch_path(&s, "shapes.txt"), text);
    overlay *plane = overlay_create(&ctx);
    ck_assert_ptr_nonnull(plane);
    *error = (fram_error){0};
    fram_status status = template_file_read(&ctx, plane, s.path, out, error);
    overlay_free(plane);
    scratch_remove(&s, "shapes.txt");
    return status;
}

START_TEST(sound_outlines_are_shapes)
{
    context ctx;
    context_init(&ctx);
    polygon_list out = {0};
    fram_error e;
    /* A square that is not closed, a bow tie, a clockwise triangle. */
    assert_ok(read_text("0 0\n2 0\n2 2\n0 2\n\n0 0\n1 1\n1 0\n0 1\n\n0 0\n0 3\n3 0\n0 0\n", &out, &e), e);
    ck_assert_int_eq(polygon_list_count(&out), 2);
    assert_absolute(polygon_area(polygon_list_get(&out, 0)), 4, 1e-12);
    assert_absolute(polygon_area(polygon_list_get(&out, 1)), 4.5, 1e-12);
    polygon_list_free(&ctx, &out);
}
END_TEST

START_TEST(a_file_without_shapes_is_named)
{
    context ctx;
    context_init(&ctx);
    polygon_list out = {0};
    fram_error e;
    assert_fails(read_text("0 0\n1 1\n1 0\n0 1\n\n0 0\n1 0\n", &out, &e), e, FRAM_ERROR_INPUT,
                 "none of its 2 outlines");
    ck_assert_msg(strstr(e.file, "shapes.txt") != NULL, "%s", e.file);
    assert_fails(read_text("POLYGON ((0 0, 1 0", &out, &e), e, FRAM_ERROR_INPUT, "");
    ck_assert_msg(strstr(e.file, "shapes.txt") != NULL && e.line == 1, "%s:%d", e.file, e.line);
    polygon_list_free(&ctx, &out);
}
END_TEST

TEST_MAIN("template_file", sound_outlines_are_shapes, a_file_without_shapes_is_named)
