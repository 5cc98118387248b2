/* Ice measured in windows, as a law of size. */
#include "testing.h"

#include "base/transcendental.h"
#include "ice/managed_ice.h"

START_TEST(bins_are_sixteenths_of_an_octave)
{
    assert_relative(managed_edge(0), 0.25, 1e-15);
    assert_relative(managed_edge(MANAGED_OCTAVE), 0.5, 1e-14);
    assert_relative(managed_edge(MANAGED_BINS), 4096, 1e-12);
    /* What is on an edge belongs to the bin below it, what is beyond all to the outermost. */
    managed_cover c = {.sheet = 0};
    managed_cover_add(&c, 0.5, 1);
    managed_cover_add(&c, 0.5001, 2);
    managed_cover_add(&c, 0.01, 4);
    managed_cover_add(&c, 1e5, 8);
    ck_assert_double_eq(c.of_bin[MANAGED_OCTAVE - 1], 1);
    ck_assert_double_eq(c.of_bin[MANAGED_OCTAVE], 2);
    ck_assert_double_eq(c.of_bin[0], 4);
    ck_assert_double_eq(c.of_bin[MANAGED_BINS - 1], 8);
}
END_TEST

/* Two windows, half of each ice: 0.2 in floes of 3 m and 0.3 of 12 m, 0.1 unbroken, all 0.5 m thick but the floes of 3
   m, which are 1 m. */
static managed_ice known(void)
{
    managed_ice ice = {.windows = 0};
    for (int i = 0; i < 2; i++) {
        managed_cover window = {.sheet = i ? 0.2 : 0};
        managed_cover_add(&window, 3, 0.2);
        managed_cover_add(&window, 12, 0.3);
        window.volume = 0.2 * 1 + (0.3 + window.sheet) * 0.5;
        managed_ice_add(&ice, &window, 12);
    }
    return ice;
}

START_TEST(law_by_hand)
{
    managed_ice ice = known();
    managed_law law;
    fram_error error = {0};
    assert_ok(managed_law_of(&ice, (double)NAN, &law, &error), error);
    assert_relative(law.concentration, 0.6, 1e-14);
    assert_relative(law.thickness, (0.2 + 0.4 * 0.5) / 0.6, 1e-14);
    assert_relative(law.sheet, 0.1 / 0.6, 1e-14);
    assert_relative(law.mean, (0.2 * 3 + 0.3 * 12) / 0.5, 1e-14);
    ck_assert_double_eq(law.largest, 12);
    /* Ten thousand floes of the law: their mean area is that of 0.2 and 0.3 in floes of the two sizes, by number. */
    const size_law sizes = managed_size_law(&law);
    double area = 0, count = 20000, wanted = 0.5 / (0.2 / (PI / 4 * 9) + 0.3 / (PI / 4 * 144));
    for (int i = 0; i < 20000; i++) {
        double d = size_law_quantile(&sizes, (i + 0.5) / count);
        area += PI / 4 * d * d / count;
    }
    assert_relative(area, wanted, 0.05);
    double small = 0.2 / (PI / 4 * 9), large = 0.3 / (PI / 4 * 144);
    assert_relative(size_law_part(&sizes, 6), small / (small + large), 0.02);
    /* Floes of 24 m for the sheet: a sixth of the area. */
    assert_ok(managed_law_of(&ice, 24, &law, &error), error);
    assert_relative(law.mean, (0.2 * 3 + 0.3 * 12 + 0.1 * 24) / 0.6, 1e-14);
    const size_law with_sheet = managed_size_law(&law);
    double sheet = 0.1 / (PI / 4 * 24 * 24);
    assert_relative(1 - size_law_part(&with_sheet, 18), sheet / (small + large + sheet), 0.1);
}
END_TEST

START_TEST(without_ice_or_floes)
{
    managed_ice ice = {.windows = 0};
    managed_law law;
    fram_error error = {0};
    ck_assert_int_eq(managed_law_of(&ice, (double)NAN, &law, &error), FRAM_ERROR_INPUT);
    managed_cover open = {.sheet = 0}, sheet = {.sheet = 1, .volume = 0.8};
    managed_ice_add(&ice, &open, 0);
    ck_assert_int_eq(managed_law_of(&ice, (double)NAN, &law, &error), FRAM_ERROR_INPUT);
    managed_ice_add(&ice, &sheet, 0);
    ck_assert_int_eq(managed_law_of(&ice, (double)NAN, &law, &error), FRAM_ERROR_INPUT);
    assert_ok(managed_law_of(&ice, 50, &law, &error), error);
    assert_relative(law.concentration, 0.5, 1e-15);
    ck_assert_int_eq(law.bins, 1);
}
END_TEST

TEST_MAIN("managed_ice", bins_are_sixteenths_of_an_octave, law_by_hand, without_ice_or_floes)
