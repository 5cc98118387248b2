/* Colours of a palette are told apart by who sees no red or no green: CIEDE2000 (Sharma, Wu and Dalal 2005) of what
   protanopes and deuteranopes see of them by Machado, Oliveira and Fernandes (2009), severity 1. */
#include "io/palette.h"

#include "testing.h"

/* Two colours that touch are told apart from about 2 on; small fields and thin lines ask for several times that. */
#define LEAST_APART 12

#define RADIANS (3.14159265358979323846 / 180)

/* What of linear red, green and blue each eye sees. */
enum { EYES = 3 };
static const double eyes[EYES][3][3] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}},
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};

typedef struct lab {
    double l, a, b;
} lab;

static double linear(double v) { return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4); }
static double lab_part(double t) { return t > 0.008856 ? cbrt(t) : 7.787 * t + 16.0 / 116; }

/* sRGB under D65 as an eye sees it. */
static lab seen_as(const double eye[3][3], const double rgb[3])
{
    static const double xyz[3][3] = {{0.4124564 / 0.95047, 0.3575761 / 0.95047, 0.1804375 / 0.95047},
                                     {0.2126729, 0.7151522, 0.0721750},
                                     {0.0193339 / 1.08883, 0.1191920 / 1.08883, 0.9503041 / 1.08883}};
    double left[3], f[3];
    for (int i = 0; i < 3; i++) {
        left[i] = 0;
        for (int k = 0; k < 3; k++)
            left[i] += eye[i][k] * linear(rgb[k]);
        left[i] = fmin(fmax(left[i], 0), 1);
    }
    for (int i = 0; i < 3; i++)
        f[i] = lab_part(xyz[i][0] * left[0] + xyz[i][1] * left[1] + xyz[i][2] * left[2]);
    return (lab){116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

static double hue(double a, double b)
{
    double degrees = atan2(b, a) / RADIANS;
    return degrees < 0 ? degrees + 360 : degrees;
}

static double seventh(double c) { return sqrt(pow(c, 7) / (pow(c, 7) + pow(25, 7))); }

static double ciede2000(lab p, lab q)
{
    double g = 0.5 * (1 - seventh((hypot(p.a, p.b) + hypot(q.a, q.b)) / 2));
    double pa = (1 + g) * p.a, qa = (1 + g) * q.a, pc = hypot(pa, p.b), qc = hypot(qa, q.b);
    double ph = hue(pa, p.b), qh = hue(qa, q.b), dh = qh - ph, mean_h = (ph + qh) / 2;
    if (fabs(ph - qh) > 180)
        mean_h += ph + qh < 360 ? 180 : -180;
    if (pc * qc == 0)
        dh = 0, mean_h = ph + qh;
    dh += dh > 180 ? -360 : dh < -180 ? 360 : 0;
    double dl = q.l - p.l, dc = qc - pc, dhue = 2 * sqrt(pc * qc) * sin(dh / 2 * RADIANS);
    double l = (p.l + q.l) / 2 - 50, c = (pc + qc) / 2;
    double t = 1 - 0.17 * cos((mean_h - 30) * RADIANS) + 0.24 * cos(2 * mean_h * RADIANS) +
               0.32 * cos((3 * mean_h + 6) * RADIANS) - 0.2 * cos((4 * mean_h - 63) * RADIANS);
    double turn = 30 * exp(-pow((mean_h - 275) / 25, 2));
    double sl = 1 + 0.015 * l * l / sqrt(20 + l * l), sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
    double rt = -sin(2 * turn * RADIANS) * 2 * seventh(c);
    return sqrt(pow(dl / sl, 2) + pow(dc / sc, 2) + pow(dhue / sh, 2) + rt * (dc / sc) * (dhue / sh));
}

/* Pairs 1, 7, 13, 17 and 25 of table 1 of Sharma, Wu and Dalal (2005). */
START_TEST(the_measure_is_that_of_its_authors)
{
    static const struct {
        lab p, q;
        double apart;
    } pairs[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
                 {{50, 0, 0}, {50, -1, 2}, 2.3669},
                 {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
                 {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
                 {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        assert_absolute(ciede2000(pairs[i].p, pairs[i].q), pairs[i].apart, 1e-4);
}
END_TEST

static double least_apart(const double (*colour)[3], int count)
{
    double least = HUGE_VAL;
    for (int eye = 0; eye < EYES; eye++)
        for (int i = 0; i < count; i++)
            for (int k = 0; k < i; k++)
                least = fmin(least, ciede2000(seen_as(eyes[eye], colour[i]), seen_as(eyes[eye], colour[k])));
    return least;
}

START_TEST(colours_are_told_apart_without_red_or_green)
{
    ck_assert_double_ge(least_apart(palette_lines, PALETTE_LINES), LEAST_APART);
    ck_assert_double_ge(least_apart(palette_curves, PALETTE_CURVES), LEAST_APART);
    ck_assert_double_ge(least_apart(palette_pieces, PALETTE_PIECES), LEAST_APART);
}
END_TEST

/* The palette of lines that charts had first: its first and fifth were 9 apart for deuteranopes. */
START_TEST(the_measure_finds_what_is_too_near)
{
    static const double near[2][3] = {{0.60, 0.70, 0.80}, {0.80, 0.47, 0.65}};
    assert_absolute(least_apart(near, 2), 9.3, 0.1);
}
END_TEST

TEST_MAIN("palette", the_measure_is_that_of_its_authors, colours_are_told_apart_without_red_or_green,
          the_measure_finds_what_is_too_near)
