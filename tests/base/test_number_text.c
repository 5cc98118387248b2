/* base/number_text: round trips to the bit, strict reading, any locale; base/load_unit: units by size. */
#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/random.h"
#include "testing.h"
#include <inttypes.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

static const char *text_of(double value)
{
    static char text[NUMBER_TEXT_SIZE];
    int length = real_to_text(value, text);
    ck_assert_int_eq(length, (int)strlen(text));
    return text;
}

START_TEST(times_have_units)
{
    static const struct {
        const char *text;
        double seconds;
    } good[] = {{"10800", 10800}, {"1.5e2s", 150}, {"90min", 5400},      {"-3h", -10800},
                {"20d", 1728000}, {"1e3", 1000},   {"0.5a", 15778800.0}, {"1y", 31557600}};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        double got = 0;
        ck_assert_msg(time_from_text(good[i].text, &got) == NUMBER_GOOD, "%s", good[i].text);
        assert_relative(got, good[i].seconds, 1e-15);
    }
    static const char *const bad[] = {"", "h", "3x", "3 h", "0x10", "nan", "inf", "3hh", "1e", "3H"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double got = 7;
        ck_assert_msg(time_from_text(bad[i], &got) == NUMBER_NOT_A_NUMBER && got == 7, "%s: %g", bad[i], got);
    }
    double got = 7;
    ck_assert(time_from_text("1e308a", &got) == NUMBER_TOO_LARGE && got == 7);
}
END_TEST

/* What is told of a bound is no number outside of it, and the nearest of so many digits that is not. */
START_TEST(bounds_are_rounded_into_their_range)
{
    static const struct {
        double value;
        int digits;
        const char *least, *most;
    } cases[] = {{13.5731, 4, "13.58", "13.57"},
                 {-13.5731, 4, "-13.57", "-13.58"},
                 {5.47723, 3, "5.48", "5.47"},
                 {1.0 / 1200, 3, "0.000834", "0.000833"},
                 {0.9996, 3, "1", "0.999"},
                 {40, 4, "40", "40"},
                 {0.1, 3, "0.1", "0.1"},
                 {0, 3, "0", "0"},
                 {123456, 3, "1.24e+05", "1.23e+05"},
                 {(double)INFINITY, 3, "inf", "inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ck_assert_str_eq(least_text_of(cases[i].value, cases[i].digits).text, cases[i].least);
        ck_assert_str_eq(most_text_of(cases[i].value, cases[i].digits).text, cases[i].most);
    }
    random_stream r = random_begin(9, 0, 0);
    for (int i = 0; i < 5000; i++) {
        double value = random_uniform(&r, -1, 1) * pow(10, random_uniform(&r, -20, 20));
        int digits = (int)random_uniform(&r, 1, 17);
        double least = strtod(least_text_of(value, digits).text, NULL);
        double most = strtod(most_text_of(value, digits).text, NULL);
        ck_assert_msg(least >= value && most <= value &&
                          least - most <= 1.000001 * fabs(value) * pow(10, 1 - digits) + 4e-16 * fabs(value),
                      "%.17g with %d digits: %.17g and %.17g", value, digits, least, most);
    }
    range_text wide = range_text_of(0.61234, 0.7, 4), narrow = range_text_of(0.612341, 0.612349, 4);
    ck_assert_str_eq(wide.least.text, "0.6124");
    ck_assert_str_eq(wide.most.text, "0.7");
    ck_assert_str_eq(narrow.least.text, "0.612341");
    ck_assert_str_eq(narrow.most.text, "0.612349");
}
END_TEST

/* Frames 0.02 s apart are not both of 0.0 s. */
START_TEST(clocks_tell_their_steps_apart)
{
    static const double step[] = {60, 0.1, 1 / 30.0, 0.02, 0.01, 0.0025, 1e-12, 0};
    static const int digits[] = {1, 1, 2, 2, 2, 3, 6, 1};
    for (size_t i = 0; i < sizeof step / sizeof *step; i++)
        ck_assert_msg(clock_digits(step[i]) == digits[i], "%g s: %d digits", step[i], clock_digits(step[i]));
}
END_TEST

START_TEST(units_go_with_the_size)
{
    const struct {
        load_unit unit;
        const char *name;
        double factor;
    } cases[] = {{load_unit_for(9.9e3), "N", 1},
                 {load_unit_for(1e4), "kN", 1e-3},
                 {load_unit_for(1e7), "MN", 1e-6},
                 {load_unit_for(-3.351), "N", 1},
                 {load_unit_for(9999.6), "kN", 1e-3},
                 {load_unit_for(-9.9996e6), "MN", 1e-6},
                 {kilonewtons_or_less(9999.6), "kN", 1e-3},
                 {kilonewtons_or_less(1e8), "kN", 1e-3},
                 {kilonewtons_or_less(3.351), "N", 1},
                 {kilonewtons_or_less(0), "kN", 1e-3},
                 {load_unit_for(0), "kN", 1e-3},
                 {load_unit_for((double)NAN), "kN", 1e-3},
                 {megawatts_or_less(5.982), "W", 1},
                 {megawatts_or_less(2e4), "MW", 1e-6},
                 {power_unit_for(9999.4), "W", 1},
                 {power_unit_for(18860), "kW", 1e-3},
                 {power_unit_for(9.9996e6), "MW", 1e-6},
                 {power_unit_for(0), "kW", 1e-3},
                 {energy_unit_for(60), "J", 1},
                 {energy_unit_for(6e4), "kJ", 1e-3},
                 {energy_unit_for(9999.4e6), "MJ", 1e-6},
                 {energy_unit_for(9999.6e6), "GJ", 1e-9},
                 {energy_unit_for(3e12), "GJ", 1e-9},
                 {energy_unit_for(0), "kJ", 1e-3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ck_assert_str_eq(cases[i].unit.name, cases[i].name);
        ck_assert_double_eq(cases[i].unit.factor, cases[i].factor);
    }
}
END_TEST

/* No exponent at any size that is met, also where rounding brings a digit more, and the unit that the rounded load has.
 */
START_TEST(loads_are_told_without_exponents)
{
    static const struct {
        double newton;
        int digits;
        const char *text;
    } cases[] = {{0, 3, "0 kN"},
                 {-0.0, 4, "0 kN"},
                 {0.0335, 3, "0.0335 N"},
                 {500, 3, "500 N"},
                 {999.6, 3, "1000 N"},
                 {5e3, 3, "5000 N"},
                 {9641, 3, "9641 N"},
                 {9999.6, 4, "10 kN"},
                 {9996, 3, "10 kN"},
                 {1.2e4, 3, "12 kN"},
                 {-7.391e5, 4, "-739.1 kN"},
                 {9.996e5, 3, "1000 kN"},
                 {2.5e6, 3, "2500 kN"},
                 {5.1234e6, 3, "5123 kN"},
                 {9.99996e6, 4, "10 MN"},
                 {2.6134e7, 4, "26.13 MN"},
                 {-2.6134e7, 3, "-26.1 MN"},
                 {1.5e10, 3, "15000 MN"},
                 {123456, 2, "123 kN"},
                 {(double)NAN, 4, "nan kN"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        ck_assert_str_eq(load_text_of(cases[i].newton, cases[i].digits).text, cases[i].text);
    static const struct {
        double newton, half, largest;
        const char *text;
    } ranges[] = {{7.391e5, 1.69e5, (double)NAN, "739.1 +- 169 kN"},
                  {2.613e7, 9.996e9, (double)NAN, "26.13 +- 9996 MN"},
                  {1.2, (double)NAN, (double)NAN, "1.2 N"},
                  {5, 1e6, (double)NAN, "0.005 +- 1000 kN"},
                  {5, 1e7, (double)NAN, "0.000005 +- 10 MN"},
                  {0, (double)NAN, 2.6e7, "0 MN"},
                  {3000, 12, 2.6e7, "0.003 +- 0.000012 MN"},
                  {-2.6e7, 1.2e6, 2.6e7, "-26 +- 1.2 MN"},
                  {0, 0, 0, "0 +- 0 kN"}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        ck_assert_str_eq(load_range_text_of(ranges[i].newton, ranges[i].half, ranges[i].largest, 4).text,
                         ranges[i].text);
    for (double newton = 1e-3; newton < 1e14; newton *= 1.0173)
        for (int digits = 1; digits < 7; digits++) {
            load_text told = load_text_of(newton, digits);
            char *unit;
            double value = strtod(told.text, &unit) * (unit[1] == 'N' ? 1 : unit[1] == 'k' ? 1e3 : 1e6);
            ck_assert_msg(!strchr(told.text, 'e') && fabs(value / newton - 1) <= 0.5001 * pow(10, 1 - digits),
                          "%g N: %s", newton, told.text);
        }
    ck_assert_str_eq(plain_text_of(26105.3, 4).text, "26105");
    ck_assert_str_eq(plain_text_of(-26, 1).text, "-26");
    ck_assert_str_eq(plain_text_of(1e-7, 3).text, "1e-07");
}
END_TEST

START_TEST(durations_hide_little)
{
    static const struct {
        double seconds;
        const char *text;
    } cases[] = {
        {0, "0 s"},          {0.1234, "0.123 s"}, {85.73, "85.7 s"},       {99.96, "1 min 40 s"},      {119.6, "2 min"},
        {100, "1 min 40 s"}, {125, "2 min 05 s"}, {3599.6, "1 h"},         {3661, "1 h 01 min"},       {10800, "3 h"},
        {86399, "24 h"},     {172799, "2 days"},  {370800, "4 days 07 h"}, {31557600, "365 days 06 h"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        ck_assert_str_eq(duration_text_of(cases[i].seconds).text, cases[i].text);
    ck_assert_str_eq(duration_text_of((double)INFINITY).text, "inf s");
    for (double seconds = 1e-3; seconds < 1e10; seconds *= 1.0173) {
        double told = 0;
        char words[64], *at = words;
        snprintf(words, sizeof words, "%s", duration_text_of(seconds).text);
        while (*at) {
            double part = strtod(at, &at);
            told += part * (strncmp(at, " d", 2) == 0   ? 86400
                            : strncmp(at, " h", 2) == 0 ? 3600
                            : strncmp(at, " m", 2) == 0 ? 60
                                                        : 1);
            at += 1 + strcspn(at + 1, " ");
        }
        ck_assert_msg(fabs(told / seconds - 1) < 0.0106, "%g s: %s", seconds, words);
    }
}
END_TEST

START_TEST(reals_print_as_the_shortest_text)
{
    ck_assert_str_eq(text_of(0), "0");
    ck_assert_str_eq(text_of(-0.0), "-0");
    ck_assert_str_eq(text_of(0.1), "0.1");
    ck_assert_str_eq(text_of(1 / 3.0), "0.3333333333333333");
    ck_assert_str_eq(text_of(0.1 + 0.2), "0.30000000000000004");
    ck_assert_str_eq(text_of(1e300), "1e+300");
    ck_assert_str_eq(text_of(5e-324), "4.94065645841247e-324");
    ck_assert_str_eq(text_of(1e6), "1000000");
    ck_assert_str_eq(text_of((double)NAN), "nan");
    ck_assert_str_eq(text_of((double)INFINITY), "inf");
    ck_assert_str_eq(text_of(-(double)INFINITY), "-inf");
}
END_TEST

START_TEST(digits_are_as_many_as_asked)
{
    char text[NUMBER_TEXT_SIZE];
    ck_assert_int_eq(real_to_digits(-2 / 3.0, 12, text), 15);
    ck_assert_str_eq(text, "-0.666666666667");
    ck_assert_int_eq(real_to_digits(1e10, 3, text), 5);
    ck_assert_str_eq(text, "1e+10");
    real_to_digits((double)NAN, 12, text);
    ck_assert_str_eq(text, "nan");
}
END_TEST

START_TEST(places_have_one_last_digit)
{
    static const struct {
        double x, y, z;
        const char *text;
    } cases[] = {{-0.12106, 7.9823, -0.687, "-0.121, 7.982, -0.687"},
                 {11.451, 0.22969, -0.0001, "11.45, 0.23, 0.00"},
                 {120.48, -3.14, 0, "120.5, -3.1, 0.0"},
                 {-12345.67, 2, -1, "-12345.7, 2.0, -1.0"},
                 {0.0301, -0.25, 0.004, "0.0301, -0.2500, 0.0040"},
                 {0, 0, 0, "0.0000, 0.0000, 0.0000"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        ck_assert_str_eq(place_text_of(cases[i].x, cases[i].y, cases[i].z).text, cases[i].text);
}
END_TEST

START_TEST(coordinates_show_their_decimetre)
{
    static const struct {
        double metres;
        const char *text;
    } cases[] = {{0, "0"},
                 {-90, "-90"},
                 {12.3456, "12.346"},
                 {9876.54, "9876.5"},
                 {-12345.67, "-12345.7"},
                 {-1400000, "-1400000"},
                 {2000000.26, "2000000.3"},
                 {999999.96, "1000000"},
                 {-1e300, "-1e+300"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        ck_assert_str_eq(coordinate_text_of(cases[i].metres).text, cases[i].text);
    ck_assert_int_eq(digits_beside(-6534199.8, 0.25, 3, 4), 10);
    ck_assert_int_eq(digits_beside(12, 3, 3, 5), 5);
    ck_assert_int_eq(digits_beside(1, 1e-30, 3, 4), 15);
    ck_assert_int_eq(digits_beside(1, 0, 3, 4), 4);
    /* What rounding leaves is told as nothing, what is small by itself as it is. */
    ck_assert_double_eq(told_beside(-1.6e-10, 1.6e-10, LEAST_TOLD), 0);
    ck_assert_double_eq(told_beside(8.8e-11, 9e-11, 0), 8.8e-11);
    ck_assert_double_eq(told_beside(2e-6, 1e7, LEAST_TOLD), 0);
    ck_assert_double_eq(told_beside(-2e-5, -1e7, LEAST_TOLD), -2e-5);
    ck_assert(isnan(told_beside((double)NAN, 1, LEAST_TOLD)));
}
END_TEST

/* The fast way and printf's, digit for digit. */
static void assert_like_printf(double value, int digits)
{
    char text[NUMBER_TEXT_SIZE], expected[NUMBER_TEXT_SIZE];
    int length = real_to_digits(value, digits, text);
    snprintf(expected, sizeof expected, "%.*g", digits, value);
    ck_assert_msg(strcmp(text, expected) == 0, "%.17g to %d digits: %s, expected %s", value, digits, text, expected);
    ck_assert_int_eq(length, (int)strlen(expected));
}

START_TEST(digits_are_those_of_printf)
{
    static const double odd[] = {0.5,     2.5,          1e11,          1e12,           999999999999.5, 99999999999.95,
                                 0.1,     1e-4,         9.9999999e-5,  1e-5,           1e21,           1e22,
                                 1e23,    1e60,         1.5e99,        1e-60,          1.5e-99,        5e-324,
                                 1e100,   1e-100,       1e280,         1.0000001e280,  1e-280,         9e-281,
                                 1.7e308, 123456789012, 1234567890125, 12345678901.25, 0.000123456789, 1 / 3.0};
    random_stream random = random_begin(7, 0, 0);
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        for (int digits = 1; digits <= 17; digits++) {
            assert_like_printf(odd[i], digits);
            assert_like_printf(-odd[i], digits);
            assert_like_printf(nextafter(odd[i], 0), digits);
            assert_like_printf(nextafter(odd[i], HUGE_VAL), digits);
        }
    }
    for (int i = 0; i < 30000; i++) {
        /* Any bits, any size from 1e-66 to 1e66, and a few digits, whose halves are ties. */
        uint64_t bits = random_bits(&random);
        double any, part = (double)(bits >> 11) / 9007199254740992.0, size = part;
        memcpy(&any, &bits, sizeof any);
        int power = (int)(random_bits(&random) % 133) - 66;
        for (int k = 0; k < power; k++)
            size *= 10;
        for (int k = 0; k > power; k--)
            size /= 10;
        if (isfinite(any))
            assert_like_printf(any, 12);
        assert_like_printf(size, 12);
        assert_like_printf(-size, 1 + (int)(bits % 12));
        assert_like_printf((double)(bits % 20000001) / 16, 1 + (int)(bits % 7));
        assert_like_printf(floor(part * 1e13) / 10, 12);
        /* Twelve digits and a half, but for the last bit of the double: scaling rounds these to the wrong side. */
        char half[40];
        int any_power = (int)(bits >> 40) % 601 - 306;
        snprintf(half, sizeof half, "%" PRIu64 "5e%d", 100000000000 + bits % 900000000000,
                 i % 2 == 0 ? power : any_power);
        double middle = strtod(half, NULL);
        assert_like_printf(middle, 12);
        assert_like_printf(nextafter(middle, 0), 12);
        assert_like_printf(nextafter(middle, HUGE_VAL), 12);
    }
}
END_TEST

START_TEST(numbers_are_read_as_by_strtod)
{
    static const char *const odd[] = {"0",      "-0",   "-",     "",      ".5",    "5.",       "-.5",   "+1",
                                      " 1",     "1 ,2", "1,2",   "1e5,",  "1e+5,", "1e-5",     "1e",    "1e+",
                                      "1e+400", "nan",  "-inf",  "0x1p3", "1.2.3", "1e+22",    "1e+23", "1e-22",
                                      "1e-23",  "--1",  "1e+5x", "1e5",   "-1.5,", "1e+10000", ".",     "-."};
    random_stream random = random_begin(8, 0, 0);
    for (size_t i = 0; i < sizeof odd / sizeof *odd + 30000; i++) {
        char made[40], *end, *expected_end;
        const char *text = made;
        if (i < sizeof odd / sizeof *odd) {
            text = odd[i];
        } else {
            uint64_t bits = random_bits(&random);
            double value = (double)(int64_t)bits / 9.3e18;
            int power = (int)(random_bits(&random) % 61) - 30;
            snprintf(made, sizeof made, "%.*ge%+d%s", 1 + (int)(bits % 17), value, power, bits & 1 ? "," : "");
            if (bits & 2)
                snprintf(made, sizeof made, "%.*f", (int)(bits >> 2 & 15), value * 1e5);
        }
        double value = real_read(text, &end), expected = strtod(text, &expected_end);
        ck_assert_msg(end == expected_end, "%s", text);
        ck_assert_msg(memcmp(&value, &expected, sizeof value) == 0, "%s", text);
    }
}
END_TEST

START_TEST(reals_of_any_bits_come_back)
{
    random_stream random = random_begin(1, 0, 0);
    for (int i = 0; i < 20000; i++) {
        uint64_t bits = random_bits(&random);
        double value, again;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value))
            continue;
        ck_assert_int_eq(real_from_text(text_of(value), &again), NUMBER_GOOD);
        assert_bits(again, value);
    }
}
END_TEST

START_TEST(reals_are_read_strictly)
{
    static const char *const good[] = {"1", "+1", "-1", "1.", ".5", "1.5e3", "1E+3", "1e-3", "007", "-0", "1e-400"};
    static const double values[] = {1, 1, -1, 1, 0.5, 1500, 1000, 0.001, 7, -0.0, 0};
    static const char *const bad[] = {"",   " 1",       "1 ",   "1,5", "nan",   "inf", "-inf", "0x10", "1e",
                                      "e5", ".",        "+",    "--1", "1.2.3", "1_0", "1e+",  "true", "1d5",
                                      "1f", "infinity", "1e5x", "\t1", "1\n",   "+-1", ".e1",  "0b1",  "1 000"};
    double value;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        ck_assert_msg(real_from_text(good[i], &value) == NUMBER_GOOD, "%s", good[i]);
        assert_bits(value, values[i]);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        ck_assert_msg(real_from_text(bad[i], &value) == NUMBER_NOT_A_NUMBER, "%s", bad[i]);
    ck_assert_int_eq(real_from_text("1e400", &value), NUMBER_TOO_LARGE);
    ck_assert_int_eq(real_from_text("-1e999999999999", &value), NUMBER_TOO_LARGE);
    char long_text[600];
    memset(long_text, '1', sizeof long_text - 1);
    long_text[sizeof long_text - 1] = '\0';
    ck_assert_int_eq(real_from_text(long_text, &value), NUMBER_NOT_A_NUMBER);
}
END_TEST

START_TEST(integers_are_read_strictly)
{
    int64_t value;
    ck_assert_int_eq(integer_from_text("9223372036854775807", &value), NUMBER_GOOD);
    ck_assert(value == INT64_MAX);
    ck_assert_int_eq(integer_from_text("-9223372036854775808", &value), NUMBER_GOOD);
    ck_assert(value == INT64_MIN);
    ck_assert_int_eq(integer_from_text("+12", &value), NUMBER_GOOD);
    ck_assert(value == 12);
    ck_assert_int_eq(integer_from_text("9223372036854775808", &value), NUMBER_TOO_LARGE);
    static const char *const bad[] = {"", " 1", "1 ", "1.0", "1e3", "0x1", "-", "one", "1,000"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        ck_assert_msg(integer_from_text(bad[i], &value) == NUMBER_NOT_A_NUMBER, "%s", bad[i]);
    static const char *const good[] = {"-12", "-12.", "-12.0", "-0012.000000000000000000000000"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        ck_assert_msg(whole_from_text(good[i], &value) == NUMBER_GOOD && value == -12, "%s", good[i]);
    static const char *const broken[] = {"", ".0", "-.0", "3.5", "3.05", "3.0e0", "1e2", "3.0 ", "3.0.0", "3,0"};
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++)
        ck_assert_msg(whole_from_text(broken[i], &value) == NUMBER_NOT_A_NUMBER, "%s", broken[i]);
    ck_assert_int_eq(whole_from_text("9223372036854775808.0", &value), NUMBER_TOO_LARGE);
}
END_TEST

/* Locales with another decimal point; those that this machine lacks are passed over. */
START_TEST(locales_change_nothing)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "ps_AF.UTF-8", "C"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        double value;
        if (!setlocale(LC_ALL, names[i]))
            continue;
        ck_assert_str_eq(text_of(-1.5), "-1.5");
        ck_assert_str_eq(text_of(1.25e-30), "1.25e-30");
        ck_assert_int_eq(real_from_text("-1.5e2", &value), NUMBER_GOOD);
        assert_bits(value, -150.0);
        ck_assert_int_eq(real_from_text("1,5", &value), NUMBER_NOT_A_NUMBER);
        char *end;
        assert_bits(real_read("1234567890.1234567", &end), 1234567890.1234567); /* more digits than the fast way has */
    }
    setlocale(LC_ALL, "C");
}
END_TEST

TEST_MAIN("number_text", times_have_units, bounds_are_rounded_into_their_range, clocks_tell_their_steps_apart,
          units_go_with_the_size, loads_are_told_without_exponents, durations_hide_little,
          reals_print_as_the_shortest_text, digits_are_as_many_as_asked, coordinates_show_their_decimetre,
          places_have_one_last_digit, digits_are_those_of_printf, numbers_are_read_as_by_strtod,
          reals_of_any_bits_come_back, reals_are_read_strictly, integers_are_read_strictly, locales_change_nothing)
