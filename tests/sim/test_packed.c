/* Fields drawn from populations: what the scenario asks for is what the floes of the world are. */
#include "base/transcendental.h"
#include "scene.h"
#include "scratch.h"

#include <stdio.h>

enum { TEXT_SIZE = 4096, PATH_SIZE = 256 };

static const char plain[] = "run: {duration: 1, seed: 4}\nvessel: {present: false}\n"
                            "domain: {x_min: -60, x_max: 60, y_min: -60, y_max: 60}\n";

/* A text as a file beside the test's own temporary folder. */
static void write_file(char path[PATH_SIZE], const char *name, const char *text)
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, PATH_SIZE, "%s/fram_%ld_%s", folder ? folder : "/tmp", (long)getpid(), name);
    scratch_text(path, text);
}

static double plan_area(const world *w, int32_t floe) { return w->floes.area[floe]; }

static double total_area(const world *w)
{
    double area = 0;
    for (int32_t i = 0; i < w->floes.count; i++)
        area += plan_area(w, i);
    return area;
}

START_TEST(populations_have_their_shares_thickness_and_strength)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof text,
             "%sice:\n  source: packed\n  concentration: 0.8\n  breakable: true\n  thickness: 1.25\n  populations:\n"
             "    - {share: 3, size: uniform, diameter_min: 8, diameter_max: 12}\n"
             "    - {share: 1, size: constant, diameter: 3, thickness: 0.5, thickness_deviation: 0.1, "
             "flexural_strength: 3e5, crushing_strength: 1e6, crushing_deviation: 2e5, breakable: false}\n",
             plain);
    scene k;
    scene_open(&k, text);
    double area[2] = {0}, thickness = 0, square = 0, crushing = 0;
    int count[2] = {0};
    for (int32_t i = 0; i < k.w.floes.count; i++) {
        double d = sqrt(4 / PI * plan_area(&k.w, i));
        int p = d < 5;
        count[p]++;
        area[p] += plan_area(&k.w, i);
        ck_assert_int_eq(k.w.floes.breakable[i] != 0, p == 0);
        ck_assert(p == 1 || k.w.floes.thickness[i] == 1.25);
        assert_relative(k.w.floes.material[i].flexural_strength, p ? 3e5 : 5e5, 1e-12);
        if (p == 0)
            continue;
        assert_relative(d, 3, 1e-9);
        thickness += k.w.floes.thickness[i];
        square += k.w.floes.thickness[i] * k.w.floes.thickness[i];
        crushing += k.w.floes.material[i].crushing_strength;
    }
    ck_assert_int_gt(count[1], 300);
    assert_relative(total_area(&k.w), 0.8 * 120 * 120, 0.005);
    assert_relative(area[0] / area[1], 3, 0.02);
    double mean = thickness / count[1];
    assert_relative(mean, 0.5, 0.05);
    assert_relative(sqrt(square / count[1] - mean * mean), 0.1, 0.15);
    assert_relative(crushing / count[1], 1e6, 0.05);
    scene_close(&k);
}
END_TEST

/* Strengths scatter each by itself: two of the same scatter are not those of one draw. */
START_TEST(strengths_are_drawn_apart)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof text,
             "%sice:\n  source: packed\n  concentration: 0.5\n  populations:\n"
             "    - {size: constant, diameter: 8, thickness: 1, thickness_deviation: 0.3, flexural_strength: 1e6, "
             "flexural_deviation: 3e5, crushing_strength: 1e6, crushing_deviation: 3e5}\n",
             plain);
    scene k;
    scene_open(&k, text);
    int32_t n = k.w.floes.count;
    ck_assert_int_gt(n, 100);
    double sum[3] = {0}, product[3][3] = {{0}};
    for (int32_t i = 0; i < n; i++) {
        const ice_material *m = &k.w.floes.material[i];
        double x[3] = {k.w.floes.thickness[i] - 1, m->flexural_strength * 1e-6 - 1, m->crushing_strength * 1e-6 - 1};
        for (int a = 0; a < 3; a++) {
            sum[a] += x[a];
            for (int b = 0; b < 3; b++)
                product[a][b] += x[a] * x[b];
        }
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < a; b++) {
            double covariance = product[a][b] / n - sum[a] * sum[b] / n / n;
            /* Four standard errors of the correlation of independent ones. */
            ck_assert_msg(fabs(covariance) < 4 * 0.09 / sqrt(n), "covariance %g of %d and %d", covariance, a, b);
        }
    scene_close(&k);
}
END_TEST

/* As many corners as the population's keys allow, and both ends of what they allow. */
START_TEST(floes_have_the_corners_that_are_asked_for)
{
    static const int asked[][2] = {{3, 3}, {11, 12}};
    for (int n = 0; n < 2; n++) {
        char text[TEXT_SIZE];
        snprintf(text, sizeof text,
                 "%sice:\n  source: packed\n  concentration: 0.3\n  populations:\n"
                 "    - {size: constant, diameter: 10, vertices_min: %d, vertices_max: %d}\n",
                 plain, asked[n][0], asked[n][1]);
        scene k;
        scene_open(&k, text);
        ck_assert_int_gt(k.w.floes.count, 40);
        int least = 99, most = 0;
        for (int32_t i = 0; i < k.w.floes.count; i++) {
            int corners = shape_outline(&k.w.shapes, k.w.bodies.shape[scene_floe(&k, i)]).count;
            least = corners < least ? corners : least;
            most = corners > most ? corners : most;
        }
        ck_assert_msg(least == asked[n][0] && most == asked[n][1], "%d to %d corners", least, most);
        scene_close(&k);
    }
}
END_TEST

static void refuse_histogram(const char *sizes, const char *why)
{
    char histogram[PATH_SIZE], text[TEXT_SIZE];
    write_file(histogram, "bins.csv", sizes);
    snprintf(text, sizeof text,
             "%sice:\n  source: packed\n  concentration: 0.5\n  populations:\n    - {size: histogram, histogram: %s}\n",
             plain, histogram);
    scene k;
    fram_error error = {0};
    context_init(&k.ctx);
    assert_ok(scenario_parse(&k.ctx, "scene.yaml", text, strlen(text), NULL, &k.s, &error), error);
    ck_assert_int_eq(scene_build(&k.ctx, &k.s, &k.m, &k.w, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.file, histogram);
    ck_assert_int_eq(error.line, 3);
    ck_assert_msg(strstr(error.message, why) != NULL, "%s", error.message);
    scenario_free(&k.ctx, &k.s);
    remove(histogram);
}

START_TEST(bins_of_a_histogram_follow_one_another)
{
    refuse_histogram("diameter_min[m],diameter_max[m],floes[1]\n4,6,10\n7,12,5\n", "at 6 m, found 7 m");
    refuse_histogram("diameter_min[m],diameter_max[m],floes[1]\n4,6,10\n5,12,5\n", "at 6 m, found 5 m");
    refuse_histogram("diameter_min[m],diameter_max[m],floes[1]\n4,6,10\n6.0000001,12,5\n", "found 6.0000001 m");
    refuse_histogram("diameter_min[m],diameter_max[m],floes[1]\n4,6,10\n6,12,nan\n", "must be finite numbers");
    refuse_histogram("diameter_min[m],diameter_max[m],floes[1]\n0,4,0\n4,6,-1\n", "must not be negative");
    refuse_histogram("diameter_min[m],diameter_max[m],floes[1]\n-4,0,0\n0,4,5\n4,6,10\n", "begins at 0 m: give");
}
END_TEST

START_TEST(shapes_come_from_templates_and_sizes_from_a_histogram)
{
    static const char shapes[] = "{\"type\": \"Polygon\", \"coordinates\": [[[0,0],[3,-1],[2.2,1],[3,3],[0,0]]]}";
    /* Bins from 0 on, and 6 as programs come to it in two ways. */
    static const char sizes[] = "diameter_min[m],diameter_max[m],floes[1]\n0,4,0\n4,6,10\n6.000000000000001,12,5\n";
    char templates[PATH_SIZE], histogram[PATH_SIZE], text[TEXT_SIZE];
    write_file(templates, "shapes.geojson", shapes);
    write_file(histogram, "sizes.csv", sizes);
    snprintf(text, sizeof text,
             "%sice:\n  source: packed\n  concentration: 0.7\n  populations:\n"
             "    - {size: histogram, histogram: %s, shape: templates, templates: %s}\n",
             plain, histogram, templates);
    scene k;
    scene_open(&k, text);
    int small = 0;
    for (int32_t i = 0; i < k.w.floes.count; i++) {
        double d = sqrt(4 / PI * plan_area(&k.w, i));
        ck_assert_msg(d >= 4 && d <= 12, "a floe of %g m", d);
        small += d < 6;
        double bound = k.w.shapes.shapes.radius[k.w.bodies.shape[scene_floe(&k, i)]];
        ck_assert_msg(bound > 0.7 * d, "an arrow reaches farther than a disc: %g m, %g m", bound, d);
    }
    assert_relative((double)small / k.w.floes.count, 2.0 / 3, 0.05);
    scene_close(&k);
    remove(templates);
    remove(histogram);
}
END_TEST

START_TEST(water_that_a_file_leaves_is_filled)
{
    static const char floe[] =
        "{\"type\": \"Polygon\", \"coordinates\": [[[-30,-30],[30,-30],[30,30],[-30,30],[-30,-30]]]}";
    char file[PATH_SIZE], text[TEXT_SIZE];
    write_file(file, "floe.geojson", floe);
    snprintf(text, sizeof text,
             "%sice:\n  source: file\n  file: %s\n  concentration: 0.75\n  populations:\n"
             "    - {size: constant, diameter: 5}\n",
             plain, file);
    scene k;
    scene_open(&k, text);
    int large = 0;
    for (int32_t i = 0; i < k.w.floes.count; i++)
        large += fabs(plan_area(&k.w, i) - 3600) < 1e-9;
    ck_assert_int_eq(large, 1);
    assert_relative(total_area(&k.w), 0.75 * 120 * 120, 0.005);
    scene_close(&k);
    remove(file);
}
END_TEST

/* Nothing overlaps, so nothing is pushed: floes stay where they were put. */
START_TEST(a_packed_field_rests)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof text,
             "%sice:\n  source: packed\n  concentration: 0.85\n  populations:\n"
             "    - {size: power, diameter_min: 5, diameter_max: 40}\n",
             plain);
    scene k;
    scene_open(&k, text);
    int32_t count = k.w.floes.count;
    vec3 *start = calloc((size_t)count, sizeof *start);
    ck_assert_ptr_nonnull(start);
    for (int32_t i = 0; i < count; i++)
        start[i] = k.w.bodies.position[scene_floe(&k, i)];
    scene_steps(&k, getenv("FRAM_TEST_SHORT") ? 500 : 30000);
    for (int32_t i = 0; i < count; i++) {
        double way = vec3_length(vec3_sub(k.w.bodies.position[scene_floe(&k, i)], start[i]));
        ck_assert_msg(way < 1e-3, "floe %d moved by %g m", (int)i, way);
    }
    free(start);
    scene_close(&k);
}
END_TEST

START_TEST(what_cannot_be_packed_is_told)
{
    static const char text[] = "run: {duration: 1}\nvessel: {present: false}\n"
                               "domain: {x_min: -30, x_max: 30, y_min: -30, y_max: 30}\nice:\n  source: packed\n"
                               "  concentration: 0.99\n  populations:\n    - {size: constant, diameter: 8}\n";
    scene k;
    fram_error error = {0};
    context_init(&k.ctx);
    const scenario_overrides none = {NULL, 0};
    assert_ok(scenario_parse(&k.ctx, "scene.yaml", text, strlen(text), &none, &k.s, &error), error);
    ck_assert_int_eq(scene_build(&k.ctx, &k.s, &k.m, &k.w, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "ice.concentration");
    ck_assert_int_eq(error.line, 6);
    ck_assert_msg(strstr(error.message, "was reached") != NULL, "%s", error.message);
    scenario_free(&k.ctx, &k.s);
}
END_TEST

enum { WARNING_SIZE = 240 };

/* user: WARNING_SIZE characters, for the last warning. */
static void keep_warning(void *user, log_level level, const char *text)
{
    if (level == LOG_WARNING)
        snprintf(user, WARNING_SIZE, "%s", text);
}

/* A floe of 60 m is 0.196 of the domain. */
START_TEST(a_concentration_that_whole_floes_miss_is_told)
{
    static const struct {
        double concentration;
        const char *populations, *told;
    } cases[] = {
        {0.3, "{size: constant, diameter: 60}", "0.3 lies between 1 and 2 floes of 60 m; it is 0.3927 with 2."},
        {0.28, "{size: uniform, diameter_min: 60, diameter_max: 60}", "between 1 and 2 floes of 60 m; it is 0.1963"},
        {0.1, "{size: constant, diameter: 60}", "between 0 and 1 floes of 60 m"},
        {0.1, "{size: constant, diameter: 60}, {size: constant, diameter: 8}", "0.1 was asked and 0.1998 reached"},
        {0.196, "{size: constant, diameter: 60}", NULL},
        {0.5, "{size: constant, diameter: 60}, {size: uniform, diameter_min: 6, diameter_max: 8}", NULL}};
    char text[TEXT_SIZE], told[WARNING_SIZE];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text, "%sice: {source: packed, concentration: %g, populations: [%s]}\n", plain,
                 cases[i].concentration, cases[i].populations);
        scene k;
        fram_error error = {0};
        told[0] = '\0';
        context_init(&k.ctx);
        k.ctx.log = keep_warning;
        k.ctx.log_user = told;
        assert_ok(scenario_parse(&k.ctx, "scene.yaml", text, strlen(text), NULL, &k.s, &error), error);
        assert_ok(scene_build(&k.ctx, &k.s, &k.m, &k.w, &error), error);
        ck_assert_msg(cases[i].told ? strstr(told, cases[i].told) != NULL : !told[0], "%zu: %s", i, told);
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("packed", strengths_are_drawn_apart, floes_have_the_corners_that_are_asked_for,
          bins_of_a_histogram_follow_one_another, populations_have_their_shares_thickness_and_strength,
          shapes_come_from_templates_and_sizes_from_a_histogram, water_that_a_file_leaves_is_filled,
          a_packed_field_rests, what_cannot_be_packed_is_told, a_concentration_that_whole_floes_miss_is_told)
