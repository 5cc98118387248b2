/* An endless field that drifts through the domain: hours of it, turning and reversing, its books, its refusals. */
#include "scene.h"

#include "base/transcendental.h"
#include "sim/build_feeding.h"

#include <stdio.h>
#include <unistd.h>

/* Ice alone, at rest in the water that carries it; air would hold it back. */
static const char alone[] = "run:\n  duration: 7200\n  time_step: 0.2\n  seed: 5\n"
                            "vessel:\n  present: false\n"
                            "ice:\n  concentration: 0.8\n  mean_floe_area: 40\n  size_deviation: 0.8\n"
                            "domain:\n  x_min: -40\n  x_max: 40\n  y_min: -25\n  y_max: 25\n  boundary: feeding\n"
                            "environment:\n  current_speed: 0.5\n  current_direction_deg: 160\n  air_density: 0\n";

/* A box at rest in the middle of the drift. */
static const char around[] = "run:\n  duration: 600\n  time_step: 0.05\n  seed: 5\n"
                             "vessel:\n  mode: prescribed\n  hull:\n    form: box\n    length: 24\n    beam: 10\n"
                             "    draught: 4\n    freeboard: 3\n"
                             "ice:\n  concentration: 0.85\n  mean_floe_area: 40\n  size_deviation: 0.8\n"
                             "domain:\n  x_min: -50\n  x_max: 50\n  y_min: -40\n  y_max: 40\n  boundary: feeding\n"
                             "environment:\n  current_speed: 0.6\n  current_direction_deg: 180\n";

/* Without its ice. */
static const char channel[] = "run:\n  duration: 600\n  time_step: 0.05\n  seed: 5\n"
                              "vessel:\n  mode: prescribed\n  hull:\n    form: box\n    length: 24\n    beam: 10\n"
                              "    draught: 4\n    freeboard: 3\n"
                              "domain:\n  x_min: -50\n  x_max: 50\n  y_min: -40\n  y_max: 40\n";

/* ---- the field by itself ---- */

static int32_t living_floes(const world *w)
{
    int32_t count = 0;
    for (int32_t i = 0; i < w->floes.count; i++)
        count += w->floes.body[i] >= 0;
    return count;
}

/* Mass of all floes [kg]. */
static double floes_mass(const world *w)
{
    double sum = 0;
    for (int32_t i = 0; i < w->floes.count; i++)
        sum += w->floes.body[i] >= 0 ? w->bodies.mass[w->floes.body[i]] : 0;
    return sum;
}

static double pattern_area(const world *w)
{
    double area = 0;
    for (int32_t i = 0; i < w->pattern.count; i++)
        area += w->pattern.area[i];
    return area;
}

/* What was there, entered, was crushed and left is what is there now. */
static void check_books(const scene *k, double mass_at_start)
{
    const world *w = &k->w;
    double now = floes_mass(w);
    double booked = mass_at_start + w->feeding.entered[0] + w->clock.ice_gained[0] - w->clock.ice_left[0] -
                    w->clock.ice_lost[0] - w->clock.ice_crushed[0];
    assert_relative(now, booked, 1e-11);
}

START_TEST(the_pattern_has_the_concentration_and_no_seam)
{
    scene k;
    scene_open(&k, alone);
    const world *w = &k.w;
    vec2 tile = w->feeding.tile[0];
    assert_relative(pattern_area(w), 0.8 * tile.x * tile.y, 1e-9);
    ck_assert(tile.x > 80 + 2 * feeding_band(0) && tile.y > 50);
    /* Every floe against every copy of every other: neighbours across the seam stand as far apart as any. */
    double nearest = HUGE_VAL;
    for (int32_t a = 0; a < w->pattern.count; a++)
        for (int32_t b = 0; b < w->pattern.count; b++)
            for (int copy = 0; copy < 9; copy++) {
                vec2 shift = {(copy % 3 - 1) * tile.x, (copy / 3 - 1) * tile.y};
                vec2 apart = vec2_sub(vec2_add(w->pattern.place[b], shift), w->pattern.place[a]);
                if (a == b || vec2_length(apart) > w->pattern.radius[a] + w->pattern.radius[b])
                    continue;
                vec2 one[64], two[64];
                int32_t n = w->pattern.size[a], m = w->pattern.size[b];
                ck_assert(n <= 64 && m <= 64);
                for (int32_t i = 0; i < n; i++)
                    one[i] = w->pattern_vertices.point[w->pattern.first[a] + i];
                for (int32_t i = 0; i < m; i++)
                    two[i] = vec2_add(w->pattern_vertices.point[w->pattern.first[b] + i], apart);
                nearest = testing_smaller(nearest, -polygon_convex_depth((polygon){one, n}, (polygon){two, m}, NULL));
            }
    ck_assert_msg(nearest > 0.3 && nearest < 2, "neighbours are %g m apart", nearest);
    scene_close(&k);
}
END_TEST

/* Six floes of 20 and 4 m, three quarters of the ice and one, are longer than a quarter of the window, and so are those
   of a histogram. */
START_TEST(the_tile_is_longer_by_floes_of_the_populations)
{
    static const char packed[] = "run:\n  duration: 1\nvessel:\n  present: false\n"
                                 "ice:\n  source: packed\n  concentration: 0.4\n  populations:\n"
                                 "    - {share: 3, size: constant, diameter: 20}\n"
                                 "    - {size: constant, diameter: 4}\n"
                                 "domain:\n  x_min: -40\n  x_max: 40\n  y_min: -25\n  y_max: 25\n  boundary: feeding\n";
    static const char *const other[] = {"ice.mean_floe_area=9000", "domain.tile_y=99"};
    const double spare = 6 * sqrt(PI / 4 * (0.75 * 400 + 0.25 * 16));
    scene k;
    scene_open_with(&k, packed, other, 2);
    assert_relative(k.w.feeding.tile[0].x, 80 + spare, 1e-12);
    assert_bits(k.w.feeding.tile[0].y, 99);
    char path[] = "/tmp/fram-sizes-XXXXXX";
    int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    static const char text[] = "diameter_min[m],diameter_max[m],floes\n19.999,20.001,7\n";
    ck_assert_int_eq(write(file, text, sizeof text - 1), (int)sizeof text - 1);
    close(file);
    scenario_population *p = &k.s.ice.populations.data[0];
    p->size = SIZE_HISTOGRAM;
    snprintf(p->histogram, sizeof p->histogram, "%s", path);
    double area;
    fram_error error = {0};
    assert_ok(feeding_floe_area(&k.ctx, &k.s, &area, &error), error);
    assert_relative(6 * sqrt(area), spare, 1e-6);
    unlink(path);
    scene_close(&k);
}
END_TEST

/* Two hours of drift.  Nothing disturbs the field, so that every floe stays at its place in the sheet; what has entered
   is the ice of the area that was swept. */
START_TEST(hours_of_drift_keep_the_field)
{
    scene k;
    scene_open(&k, alone);
    double start = floes_mass(&k.w);
    int32_t most = 0, slots = k.w.bodies.count;
    int64_t steps = getenv("FRAM_TEST_SHORT") ? 3600 : 36000;
    for (int64_t i = 0; i < steps; i += 100) {
        scene_steps(&k, 100);
        int32_t floes = living_floes(&k.w);
        most = floes > most ? floes : most;
    }
    const world *w = &k.w;
    ck_assert_msg(most <= w->pattern.count && w->bodies.count <= slots + 1, "%d floes, %d slots", most,
                  w->bodies.count);
    ck_assert_int_eq(w->feeding.held_back_floes[0], 0);
    check_books(&k, start);

    double angle = radians(160), time = w->clock.time[0], vx = 0.5 * real_cos(angle), vy = 0.5 * real_sin(angle);
    /* A floe enters when it reaches the window: the window is, on average, larger by the floes' radius all around. */
    double swept = (fabs(vx) * 50 + fabs(vy) * 80) * time, reach = 0;
    for (int32_t i = 0; i < w->pattern.count; i++)
        reach += 2 * w->pattern.radius[i] * w->pattern.area[i] / pattern_area(w);
    swept += (fabs(vx) + fabs(vy)) * reach * time;
    ck_assert_msg(fabs(w->feeding.entered_area[0] / swept - 0.8) < 0.8 * (steps < 36000 ? 0.1 : 0.01),
                  "the ice that entered has a concentration of %g", w->feeding.entered_area[0] / swept);

    int32_t seen = 0;
    for (int32_t row = 0; row < w->pattern.count; row++) {
        int32_t body = w->pattern.body[row];
        if (w->pattern.state[row] != PATTERN_INSIDE || w->bodies.generation[body] != w->pattern.generation[row])
            continue;
        vec2 stood = w->floes.ice_origin[w->bodies.owner[body]];
        assert_absolute(vec2_length(vec2_sub(stood, w->pattern.place[row])), 0, 1e-9);
        vec2 off = vec2_sub(vec2_add(w->pattern.place[row], w->feeding.displacement[0]),
                            vec2_make(w->bodies.position[body].x, w->bodies.position[body].y));
        vec2 tile = w->feeding.tile[0];
        off = vec2_make(off.x - tile.x * floor(off.x / tile.x + 0.5), off.y - tile.y * floor(off.y / tile.y + 0.5));
        ck_assert_msg(vec2_length(off) < 1e-6, "floe %d is %g m from its place", row, vec2_length(off));
        seen++;
    }
    ck_assert_int_eq(seen, living_floes(w));
    scene_close(&k);
}
END_TEST

/* ---- floes that linger ---- */

/* So long a tile that all floes about the middle change to their next copy before the first of these enters. */
static const char *const long_tile[] = {"domain.tile_x=160"};

/* Pins the floes about the middle of the window, as a vessel would that holds them up. */
static int pin_floes(world *w, int32_t rows[], int most)
{
    int count = 0;
    for (int32_t row = 0; row < w->pattern.count && count < most; row++) {
        int32_t body = w->pattern.state[row] == PATTERN_INSIDE ? w->pattern.body[row] : -1;
        if (body < 0 || fabs(w->bodies.position[body].x) > 15 || fabs(w->bodies.position[body].y) > 10)
            continue;
        w->bodies.motion[body] = MOTION_STATIC;
        w->bodies.velocity[body] = w->bodies.angular_velocity[body] = vec3_make(0, 0, 0);
        rows[count++] = row;
    }
    return count;
}

/* How many of these rows have a body of the copy that is shown. */
static int shown(const world *w, const int32_t rows[], int count)
{
    int living = 0;
    for (int i = 0; i < count; i++) {
        int32_t body = w->pattern.body[rows[i]];
        living += body >= 0 && body_is_alive(&w->bodies, body) &&
                  w->bodies.generation[body] == w->pattern.generation[rows[i]];
    }
    return living;
}

/* How many of these rows have a body of a copy that is no longer shown, or not yet again. */
static int left_behind(const world *w, const int32_t rows[], int count)
{
    int found = 0;
    for (int32_t i = 0; i < w->pattern_copies.count; i++)
        for (int k = 0; k < count; k++)
            found += w->pattern_copies.row[i] == rows[k];
    return found;
}

/* Steps until the sheet has gone on by `way` metres along x. */
static void drift_by(scene *k, double way, double speed)
{
    k->m.drift_given = true;
    k->m.drift = vec2_make(way > 0 ? speed : -speed, 0);
    scene_steps(k, (int64_t)(fabs(way) / speed / k->m.time_step + 0.5));
}

/* Floes that are held up leave no hole where the pattern comes again, and are themselves when the sheet comes back. */
START_TEST(floes_that_linger_leave_no_holes)
{
    enum { MOST = 32 };
    scene k;
    scene_open_with(&k, alone, long_tile, 1);
    double start = floes_mass(&k.w), tile = k.w.feeding.tile[0].x;
    int32_t rows[MOST];
    int pinned = pin_floes(&k.w, rows, MOST);
    ck_assert_int_gt(pinned, 8);

    /* By half a tile and a tenth: another copy of each floe is nearest, and none of them has come. */
    drift_by(&k, -0.6 * tile, 2);
    ck_assert_int_eq(left_behind(&k.w, rows, pinned), pinned);
    ck_assert_int_eq(shown(&k.w, rows, pinned), 0);

    /* Back: each is the floe that it was, and no second one came. */
    drift_by(&k, 0.6 * tile, 2);
    ck_assert_int_eq(left_behind(&k.w, rows, pinned), 0);
    ck_assert_int_eq(shown(&k.w, rows, pinned), pinned);

    /* Nearly a tile on: the next copies stand updrift of those that are pinned, but for those that were held back. */
    drift_by(&k, -0.85 * tile, 2);
    int second = shown(&k.w, rows, pinned), waiting = 0;
    for (int i = 0; i < pinned; i++)
        waiting += k.w.pattern.state[rows[i]] == PATTERN_WAITING || k.w.pattern.state[rows[i]] == PATTERN_HELD_BACK;
    ck_assert_int_eq(left_behind(&k.w, rows, pinned), pinned);
    ck_assert_msg(second + waiting == pinned && waiting <= 3, "%d of %d floes came again, %d have no room", second,
                  pinned, waiting);
    check_books(&k, start);

    /* Another tile on the third copies come as well, and all that are left behind are counted from there. */
    drift_by(&k, -1.0 * tile, 2);
    ck_assert_int_ge(left_behind(&k.w, rows, pinned), pinned);
    ck_assert_int_gt(shown(&k.w, rows, pinned), pinned / 2);
    for (int32_t i = 0; i < k.w.pattern_copies.count; i++)
        ck_assert(k.w.pattern_copies.tiles_x[i] < 0 && k.w.pattern_copies.tiles_y[i] == 0);
    check_books(&k, start);
    scene_close(&k);
}
END_TEST

/* A copy of a world that has such floes goes on to the same bits. */
START_TEST(copies_of_floes_are_state)
{
    scene k;
    fram_error error = {0};
    int32_t rows[32];
    scene_open_with(&k, alone, long_tile, 1);
    pin_floes(&k.w, rows, 32);
    drift_by(&k, -0.6 * k.w.feeding.tile[0].x, 2);
    ck_assert_int_gt(k.w.pattern_copies.count, 0);
    world other = {0};
    assert_ok(world_copy(&k.ctx, &k.w, &other, &error), error);
    ck_assert_uint_eq(world_hash(&k.w), world_hash(&other));
    other.pattern_copies.tiles_x[0]++;
    ck_assert_uint_ne(world_hash(&k.w), world_hash(&other));
    other.pattern_copies.tiles_x[0]--;
    for (int i = 0; i < 100; i++) {
        scene_steps(&k, 1);
        assert_ok(world_step(&k.ctx, &k.m, &other, &error), error);
    }
    ck_assert_uint_eq(world_hash(&k.w), world_hash(&other));
    world_free(&k.ctx, &other);
    scene_close(&k);
}
END_TEST

/* Floes enter, leave, linger and are found again to the same bits where all of the pattern is looked at in each step.
 */
START_TEST(what_is_near_is_all_that_matters)
{
    scene k;
    fram_error error = {0};
    int32_t rows[32], most = 0;
    const bool is_short = getenv("FRAM_TEST_SHORT");
    int lingered = 0, returned = 0, steps = is_short ? 1500 : 4000;
    scene_open_with(&k, alone, long_tile, 1);
    pin_floes(&k.w, rows, 32);
    world all = {0};
    assert_ok(world_copy(&k.ctx, &k.w, &all, &error), error);
    k.m.drift_given = true;
    for (int i = 0; i < steps; i++) {
        double t = (double)i / steps, along = real_sin(6 * PI * t);
        k.m.drift = vec2_make(1.5 * along, t < 0.5 ? 0 : 0.4 * real_cos(9 * PI * t));
        k.m.media.current = vec3_make(k.m.drift.x, k.m.drift.y, 0);
        int32_t copies = k.w.pattern_copies.count;
        all.scratch.feeding_near.is_known = false;
        scene_steps(&k, 1);
        assert_ok(world_step(&k.ctx, &k.m, &all, &error), error);
        ck_assert_uint_eq(world_hash(&k.w), world_hash(&all));
        lingered += k.w.pattern_copies.count > copies;
        returned += k.w.pattern_copies.count < copies;
        most = k.w.scratch.feeding_near.row.count > most ? k.w.scratch.feeding_near.row.count : most;
    }
    ck_assert_msg(is_short || (lingered > 0 && returned > 0 && k.w.feeding.entered_floes[0] > 100),
                  "%d lingered, %d returned", lingered, returned);
    ck_assert(k.w.feeding.entered_floes[0] > 0);
    ck_assert_int_lt(most, k.w.pattern.count);
    world_free(&k.ctx, &all);
    scene_close(&k);
}
END_TEST

/* ---- around a vessel ---- */

static void outline_of(const world *w, int32_t body, vec2 out[64], polygon *p)
{
    polygon own = shape_outline(&w->shapes, w->bodies.shape[body]);
    ck_assert_int_le(own.count, 64);
    for (int32_t i = 0; i < own.count; i++) {
        vec3 g = body_to_global(&w->bodies, body, vec3_make(own.vertex[i].x, own.vertex[i].y, 0));
        out[i] = vec2_make(g.x, g.y);
    }
    *p = (polygon){out, own.count};
}

/* Floes that entered overlap nothing; what a notch left of a floe is new too, and stays where that had been crushed. */
static void check_newcomers(const world *w, int32_t first_number)
{
    vec2 one[64], two[64];
    polygon a, b;
    for (int32_t i = 0; i < w->floes.count; i++) {
        if (w->floes.body[i] < 0 || w->floes.number[i] < first_number || w->floes.parent[i] >= 0)
            continue;
        outline_of(w, w->floes.body[i], one, &a);
        for (int32_t j = 0; j < w->floes.count; j++) {
            if (j == i || w->floes.body[j] < 0)
                continue;
            outline_of(w, w->floes.body[j], two, &b);
            double depth = polygon_convex_depth(a, b, NULL);
            ck_assert_msg(depth < 1e-2, "floe %d entered %g m into floe %d", w->floes.number[i], depth,
                          w->floes.number[j]);
        }
    }
}

/* Floes in the band go with the sheet, those inside are free, and all reach into the window. */
static void check_band(const world *w)
{
    double band = w->feeding.band[0];
    vec2 lo = w->feeding.lo[0], hi = w->feeding.hi[0], v = w->feeding.velocity[0];
    for (int32_t i = 0; i < w->floes.count; i++) {
        int32_t body = w->floes.body[i];
        if (body < 0)
            continue;
        vec3 r = w->bodies.position[body];
        double depth = fmin(fmin(r.x - lo.x, hi.x - r.x), fmin(r.y - lo.y, hi.y - r.y));
        ck_assert_int_eq(w->bodies.motion[body], depth < band ? MOTION_PRESCRIBED : MOTION_DYNAMIC);
        if (depth < band)
            ck_assert(w->bodies.velocity[body].x == v.x && w->bodies.velocity[body].y == v.y);
        ck_assert(depth + w->shapes.shapes.radius[w->bodies.shape[body]] > -0.1 * band);
    }
}

/* Drift that turns once around, then to and fro, past a vessel that stirs the ice. */
START_TEST(drift_turns_and_reverses)
{
    scene k;
    scene_open(&k, around);
    double start = floes_mass(&k.w), reached = 0;
    int32_t most = 0;
    int steps = getenv("FRAM_TEST_SHORT") ? 1500 : 4000;
    k.m.drift_given = true;
    for (int i = 0; i < steps; i++) {
        double t = (double)i / steps, angle = t < 0.6 ? 2 * PI * t / 0.6 : 0;
        double speed = t < 0.6 ? 0.6 : 0.6 * real_sin(12 * PI * t);
        k.m.drift = vec2_make(speed * real_cos(angle), speed * real_sin(angle));
        k.m.media.current = vec3_make(k.m.drift.x, k.m.drift.y, 0);
        int32_t next = k.w.clock.next_floe[0];
        scene_steps(&k, 1);
        check_newcomers(&k.w, next);
        if (i % 50 == 0)
            check_band(&k.w);
        if (k.w.scratch.ice_loads.count > 0)
            reached = fmax(reached, vec3_length(k.w.scratch.ice_loads.data[0].total.force));
        int32_t floes = living_floes(&k.w);
        most = floes > most ? floes : most;
    }
    check_books(&k, start);
    ck_assert_int_eq(k.w.events.count, 0);
    ck_assert_msg(reached > 1e4, "the vessel met %g N", reached);
    ck_assert_int_le(most, k.w.pattern.count + k.w.pattern.count / 8);
    /* To and fro neither pumps ice in nor loses it. */
    double mass = floes_mass(&k.w);
    ck_assert_msg(mass > 0.85 * start && mass < 1.15 * start, "%g t at the start, %g t at the end", start * 1e-3,
                  mass * 1e-3);
    scene_close(&k);
}
END_TEST

/* Mean load along the drift on the vessel. */
static double mean_load(const char *const *overrides, int count)
{
    scene k;
    scene_open_with(&k, around, overrides, count);
    double sum = 0;
    int steps = 2000;
    for (int i = 0; i < steps; i++) {
        scene_steps(&k, 1);
        if (i >= steps / 4)
            sum -= k.w.scratch.ice_loads.data[0].total.force.x;
    }
    scene_close(&k);
    return sum / (0.75 * steps);
}

/* Ice that is driven presses harder than ice that the water alone moves. */
START_TEST(driven_ice_presses)
{
    if (getenv("FRAM_TEST_SHORT"))
        return; /* ten thousand steps of code that the other tests walk too */
    static const char *const open[] = {"domain.boundary=open"};
    static const char *const against[] = {"domain.drift_speed=0.6", "domain.drift_direction_deg=180",
                                          "environment.current_speed=0"};
    double driven = mean_load(NULL, 0), loose = mean_load(open, 1), still = mean_load(against, 3);
    ck_assert_msg(driven > 1.5 * loose && loose > 0, "driven %g kN, loose %g kN", driven * 1e-3, loose * 1e-3);
    /* Without the help of the water the sheet still drives it. */
    ck_assert_msg(still > 0.3 * driven, "without a current %g kN", still * 1e-3);
}
END_TEST

/* Nothing moves floes of the band: that a hull meets them is told once, driven or by its own way, and that it comes
   into the band where there are none. */
START_TEST(a_hull_that_meets_the_band_is_told)
{
    static const char *const ways[][4] = {
        {"vessel.mode=prescribed", "vessel.x=20", "vessel.speed=3", "ice.concentration=0.85"},
        {"vessel.mode=free", "vessel.x=28.9", "vessel.speed=0", "ice.concentration=0.85"},
        {"vessel.x=17.95", "vessel.speed=3", "ice.concentration=0.01", "domain.band=20"}};
    for (int i = 0; i < 3; i++) {
        scene k;
        scene_open_with(&k, around, ways[i], 4);
        double band = k.w.feeding.band[0], at = k.w.bodies.position[k.w.vessels.body[0]].x;
        for (int step = 0; step < 120 && k.w.events.count == 0; step++) {
            at = k.w.bodies.position[k.w.vessels.body[0]].x;
            scene_steps(&k, 1);
        }
        scene_steps(&k, 10);
        ck_assert_int_eq(k.w.events.count, 1);
        ck_assert_int_eq(k.w.events.kind[0], EVENT_BAND);
        /* From 12 m behind its bow to the edge. */
        double room = 50 - 12 - at;
        ck_assert_msg(room < 2 * band && room > band - 0.2, "told %g m from the edge with a band of %g m", room, band);
        ck_assert_msg(i < 2 ? k.w.events.value[0] > 0 : k.w.events.value[0] == 0, "case %d: %g N, %g m", i,
                      k.w.events.value[0], room);
        scene_close(&k);
    }
}
END_TEST

START_TEST(cut_at_the_vessel)
{
    scene k;
    scene_open(&k, around);
    vec2 one[64];
    polygon p;
    const vec2 ship[4] = {{-12, -5}, {12, -5}, {12, 5}, {-12, 5}};
    for (int32_t i = 0; i < k.w.floes.count; i++) {
        if (k.w.floes.body[i] < 0)
            continue;
        outline_of(&k.w, k.w.floes.body[i], one, &p);
        /* keep_out_margin is 1 m at this scale */
        ck_assert(polygon_convex_depth(p, (polygon){ship, 4}, NULL) < -1 + 1e-9);
    }
    scene_close(&k);
}
END_TEST

/* A channel across the field, and a triangle from a file: no ice there at the start, with feeding and without. */
START_TEST(open_water_is_clear)
{
    char path[] = "/tmp/fram-zones-XXXXXX", zones[128];
    int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    static const char text[] = "POLYGON ((20 20, 40 20, 28 24, 30 35, 20 20))\n";
    ck_assert_int_eq(write(file, text, sizeof text - 1), (int)sizeof text - 1);
    close(file);
    snprintf(zones, sizeof zones, "ice.open_water_file=%s", path);
    static const char *const boundary[] = {"domain.boundary=feeding", "domain.boundary=walls"};
    for (int i = 0; i < 2; i++) {
        char scene_text[1024];
        snprintf(scene_text, sizeof scene_text,
                 "%sice:\n  concentration: 0.85\n  mean_floe_area: 40\n  open_water:\n    - {x: -5, "
                 "y: -25, length: 90, width: 12, angle_deg: 10}\n",
                 channel);
        const char *const overrides[] = {boundary[i], zones};
        scene k;
        scene_open_with(&k, scene_text, overrides, 2);
        vec2 one[64];
        polygon p;
        /* the corners of the rectangle, and one of the two convex halves of the arrow head */
        const double c = real_cos(radians(10)), sn = real_sin(radians(10));
        vec2 lane[4] = {{-45, -6}, {45, -6}, {45, 6}, {-45, 6}};
        const vec2 head[3] = {{20, 20}, {28, 24}, {30, 35}};
        for (int n = 0; n < 4; n++)
            lane[n] = vec2_make(-5 + c * lane[n].x - sn * lane[n].y, -25 + sn * lane[n].x + c * lane[n].y);
        for (int32_t n = 0; n < k.w.floes.count; n++) {
            if (k.w.floes.body[n] < 0)
                continue;
            outline_of(&k.w, k.w.floes.body[n], one, &p);
            ck_assert(polygon_overlap_area(p, (polygon){lane, 4}) < 1e-9);
            ck_assert(polygon_overlap_area(p, (polygon){head, 3}) < 1e-9);
        }
        ck_assert_int_gt(living_floes(&k.w), 80);
        scene_close(&k);
    }
    unlink(path);
}
END_TEST

/* A concave floe 28 m from a hull that lies across: it is there with feeding as without. */
START_TEST(concave_floes_beside_a_vessel_stay)
{
    char path[] = "/tmp/fram-floe-XXXXXX", floe[128];
    int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    static const char text[] = "POLYGON ((30 -30, 50 -30, 50 -10, 44 -10, 44 -24, 30 -24, 30 -30))\n";
    ck_assert_int_eq(write(file, text, sizeof text - 1), (int)sizeof text - 1);
    close(file);
    snprintf(floe, sizeof floe, "ice.file=%s", path);
    static const char across[] = "vessel: {mode: towed, heading_deg: 57, hull: {form: box, length: 100, beam: 20, "
                                 "draught: 6}}\nice: {source: file}\n"
                                 "domain: {x_min: -150, x_max: 150, y_min: -150, y_max: 150}\n";
    static const char *const boundary[] = {"domain.boundary=open", "domain.boundary=feeding"};
    for (int i = 0; i < 2; i++) {
        const char *const overrides[] = {floe, boundary[i], "domain.tile_x=400", "domain.tile_y=400"};
        scene k;
        scene_open_with(&k, across, overrides, 4);
        ck_assert_int_eq(living_floes(&k.w), 1);
        scene_close(&k);
    }
    unlink(path);
}
END_TEST

/* ---- what is refused ---- */

START_TEST(refusals_name_their_key)
{
    static const char *const small_tile[] = {"domain.tile_x=82"}, *const thin[] = {"domain.band=1"},
                             *const wide[] = {"domain.band=30"}, *const none[] = {"ice.source=none"},
                             *const walls[] = {"domain.boundary=walls", "domain.drift_speed=1"},
                             *const file[] = {"domain.boundary=open", "domain.drift_file=drift.csv"},
                             *const both[] = {"domain.drift_speed=0.3", "domain.drift_file=drift.csv"};
    check_refusal(alone, small_tile, 1, "domain.tile_x");
    check_refusal(alone, thin, 1, "domain.band");
    check_refusal(alone, wide, 1, "domain.band");
    check_refusal(alone, none, 1, "ice.source");
    check_refusal(alone, walls, 2, "domain.drift_speed");
    check_refusal(alone, file, 2, "domain.drift_file");
    check_refusal(alone, both, 2, "domain.drift_speed");
    static const char *const aside[] = {"vessel.x=35"};
    check_refusal(around, aside, 1, "domain.band");
    /* The hull is 35 m from the edge; water that is kept clear around it counts for nothing. */
    static const char *const clear[] = {"domain.band=20", "ice.keep_out_margin=30"};
    scene k;
    scene_open_with(&k, around, clear, 2);
    scene_close(&k);
    static const char *const large[] = {"ice.mean_floe_area=6000", "vessel.present=false"};
    check_refusal(around, large, 2, "domain");
}
END_TEST

/* Which of the vessels, and on which side; without ice where the band is given. */
START_TEST(a_vessel_in_the_band_is_named)
{
    static const char two[] =
        "vessels:\n  - {name: a, mode: prescribed, y: 15, hull: {form: box, length: 24, beam: 10}}\n"
        "  - {name: b, mode: prescribed, y: -15, hull: {form: box, length: 24, beam: 10}}\n"
        "ice: {concentration: 0.8, mean_floe_area: 40}\n"
        "domain: {x_min: -50, x_max: 50, y_min: -40, y_max: 40, boundary: feeding}\n";
    static const struct {
        const char *override[2], *vessel, *words;
    } cases[] = {{{"vessels.b.y=-30", "domain.band=8"},
                  "vessel b inside the band of 8 m",
                  "found 5 m between it and domain.y_min"},
                 {{"vessels.a.y=30", "domain.band=8"},
                  "vessel a inside the band of 8 m",
                  "found 5 m between it and domain.y_max"},
                 {{"vessels.b.x=-35", "domain.band=8"},
                  "vessel b inside the band of 8 m",
                  "found 3 m between it and domain.x_min"},
                 {{"vessels.b.x=35", "domain.band=auto"},
                  "vessel b inside the band of",
                  "found 3 m between it and domain.x_max"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const scenario_overrides list = {cases[i].override, 2};
        fram_error error = {0};
        context ctx;
        scenario s;
        world w;
        model m;
        context_init(&ctx);
        assert_ok(scenario_parse(&ctx, "scene.yaml", two, strlen(two), &list, &s, &error), error);
        fram_status status = build_check(&ctx, &s, NULL, NULL, &error);
        ck_assert_int_eq(status, is_automatic(s.domain.band) ? FRAM_OK : FRAM_ERROR_INPUT);
        status = status == FRAM_OK ? scene_build(&ctx, &s, &m, &w, &error) : status;
        assert_fails(status, error, FRAM_ERROR_INPUT, cases[i].vessel);
        ck_assert_msg(strstr(error.message, cases[i].words), "%s", error.message);
        ck_assert_str_eq(error.key, "domain.band");
        scenario_free(&ctx, &s);
    }
}
END_TEST

TEST_MAIN("feeding", the_pattern_has_the_concentration_and_no_seam, the_tile_is_longer_by_floes_of_the_populations,
          hours_of_drift_keep_the_field, floes_that_linger_leave_no_holes, copies_of_floes_are_state,
          what_is_near_is_all_that_matters, drift_turns_and_reverses, driven_ice_presses,
          a_hull_that_meets_the_band_is_told, cut_at_the_vessel, open_water_is_clear,
          concave_floes_beside_a_vessel_stay, refusals_name_their_key, a_vessel_in_the_band_is_named)
