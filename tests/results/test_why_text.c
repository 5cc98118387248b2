/* How the force of a peak is told: a part of it that is what rounding leaves is 0. */
#include "results/why.h"
#include "testing.h"
#include <string.h>

START_TEST(rounding_is_no_force)
{
    const struct {
        vec3 force;
        const char *told;
    } cases[] = {{{-78.94e3, 7.636e-11, 108.6e3}, "(-78.94, 0, 108.6) kN in x, y, z"},
                 {{-78.94e3, -3e-4, 108.6e3}, "(-78.94, 0, 108.6) kN in x, y, z"},
                 {{-78.94e3, 20, 0}, "(-78.94, 0.02, 0) kN in x, y, z"}};
    context ctx;
    context_init(&ctx);
    static why y;
    y = (why){.ctx = &ctx};
    scenario_defaults(&y.run.s, scenario_default_scale());
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static peak_detail d;
        d = (peak_detail){.time = 8, .load = 134e3, .window = 1, .force = cases[i].force};
        text_buffer text = {0};
        fram_error error = {0};
        assert_ok(why_text(&y, &d, 0, NULL, &text, &error), error);
        ck_assert_msg(strstr(text.data, cases[i].told) != NULL, "%s", text.data);
        text_free(&ctx, &text);
    }
}
END_TEST

TEST_MAIN("why_text", rounding_is_no_force)
