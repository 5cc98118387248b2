/* Pairs of boxes: all that overlap, once, in an order of their own; refusals end the search. */
#include "base/random.h"
#include "geometry/box_pairs.h"
#include "testing.h"

enum { BOXES = 200 };

typedef struct found {
    bool pair[BOXES][BOXES];
    int32_t count, end_at;
} found;

static fram_status note(void *user, int32_t a, int32_t b, fram_error *error)
{
    found *f = user;
    if (++f->count == f->end_at)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "enough");
    ck_assert_msg(!f->pair[a][b] && !f->pair[b][a], "boxes %d and %d came twice", (int)a, (int)b);
    f->pair[a][b] = true;
    return FRAM_OK;
}

/* Of a field that is `tall` times as high as wide. */
static void draw_boxes(box2 *box, double tall)
{
    for (uint32_t i = 0; i < BOXES; i++) {
        random_stream r = random_begin(1, 2, i);
        double x = floor(random_uniform(&r, 0, 40)), y = floor(random_uniform(&r, 0, 40 * tall));
        box[i] = (box2){{x, y}, {x + floor(random_uniform(&r, 0, 12)), y + floor(random_uniform(&r, 0, 12))}};
    }
    box[7] = (box2){{5, 5}, {4, 50}}; /* turned inside out */
    box[8] = tall > 1 ? (box2){{3, -HUGE_VAL}, {4, HUGE_VAL}} : (box2){{-HUGE_VAL, 3}, {HUGE_VAL, 4}};
}

static bool has_area(box2 b) { return b.lo.x < b.hi.x && b.lo.y < b.hi.y; }

/* By the definition, pair by pair; edges that touch are no overlap. */
START_TEST(all_that_overlap)
{
    context ctx;
    context_init(&ctx);
    fram_error e = {0};
    static box2 box[BOXES];
    static found f;
    for (double tall = 1; tall <= 3; tall += 2) {
        draw_boxes(box, tall);
        f = (found){0};
        assert_ok(box_pairs(&ctx, box, BOXES, "looking", note, &f, &e), e);
        int32_t expected = 0;
        for (int32_t a = 0; a < BOXES; a++)
            for (int32_t b = a + 1; b < BOXES; b++) {
                bool overlap = has_area(box[a]) && has_area(box[b]) && box[a].lo.x < box[b].hi.x &&
                               box[b].lo.x < box[a].hi.x && box[a].lo.y < box[b].hi.y && box[b].lo.y < box[a].hi.y;
                expected += overlap;
                ck_assert_msg((f.pair[a][b] || f.pair[b][a]) == overlap, "boxes %d and %d", (int)a, (int)b);
            }
        ck_assert_int_eq(f.count, expected);
        ck_assert_int_gt(expected, 100);
    }
    assert_ok(box_pairs(&ctx, NULL, 0, "looking", note, &f, &e), e);
}
END_TEST

START_TEST(a_refusal_and_a_stop_end_the_search)
{
    context ctx;
    context_init(&ctx);
    fram_error e = {0};
    static box2 box[BOXES];
    static found f;
    draw_boxes(box, 1);
    f = (found){.end_at = 10};
    assert_fails(box_pairs(&ctx, box, BOXES, "looking", note, &f, &e), e, FRAM_ERROR_INPUT, "enough");
    ck_assert_int_eq(f.count, 10);
    const volatile int stop = 1;
    ctx.stop = &stop;
    f = (found){0};
    assert_fails(box_pairs(&ctx, box, BOXES, "looking at boxes", note, &f, &e), e, FRAM_INTERRUPTED,
                 "interrupted while looking at boxes");
    ck_assert_int_eq(f.count, 0);
}
END_TEST

TEST_MAIN("box_pairs", all_that_overlap, a_refusal_and_a_stop_end_the_search)
