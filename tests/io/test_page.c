/* Pages of charts: the end of a title that is too long for its page is seen. */
#include "io/image.h"
#include "io/page.h"

#include "scratch.h"

enum { PICTURE_MOST = 1 << 18 };

static size_t picture(context *ctx, const char *folder, const char *title, size_t end, unsigned char out[PICTURE_MOST])
{
    fram_error e;
    char path[SCRATCH_PATH];
    const page p = {.title = title,
                    .title_end = end > 0 ? title + end : NULL,
                    .text = "",
                    .text_x = 40,
                    .text_y = 70,
                    .text_width = 100,
                    .width = 600,
                    .height = 100};
    snprintf(path, sizeof path, "%s/page.png", folder);
    assert_ok(page_write(ctx, &p, path, &e), e);
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    size_t size = fread(out, 1, PICTURE_MOST, file);
    ck_assert_int_eq(fclose(file), 0);
    ck_assert_uint_lt(size, PICTURE_MOST);
    return size;
}

/* Two long titles that differ in the name at their end alone. */
START_TEST(the_end_of_a_title_is_whole)
{
    static const char start[] =
        "A tanker and its escort lie at their anchors while level ice of 0.8 m drifts past them";
    static unsigned char one[PICTURE_MOST], other[PICTURE_MOST];
    char folder[SCRATCH_FOLDER], titles[2][160];
    context ctx;
    context_init(&ctx);
    scratch_folder(folder);
    snprintf(titles[0], sizeof titles[0], "%s: vessel tanker", start);
    snprintf(titles[1], sizeof titles[1], "%s: vessel escort", start);
    for (int whole = 0; whole < 2 && image_available(); whole++) {
        size_t end = whole ? sizeof start - 1 : 0;
        size_t size = picture(&ctx, folder, titles[0], end, one);
        bool same = picture(&ctx, folder, titles[1], end, other) == size && memcmp(one, other, size) == 0;
        ck_assert_int_eq(same, !whole);
    }
    scratch_remove_folder(folder);
}
END_TEST

TEST_MAIN("page", the_end_of_a_title_is_whole)
