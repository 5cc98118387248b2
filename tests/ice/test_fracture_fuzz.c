/* Fuzzed fracture: random, degenerate, concave and sliver-prone floes broken again and again.  FRAM_FUZZ_EVENTS sets
   the number of events; FRAM_FUZZ_SEED the seed. */
#include "fracture_rig.h"

#include <stdio.h>
#include <stdlib.h>

enum { ROOM = 4096, GENERATIONS = 5 };

static long number_from(const char *name, long otherwise)
{
    const char *text = getenv(name);
    return text && *text ? strtol(text, NULL, 10) : otherwise;
}

/* ---- floes ---- */

static int star(random_stream *s, double size, bool convex, vec2 *out)
{
    int n = 3 + (int)random_uniform(s, 0, 22);
    double inner = convex ? 1 : random_uniform(s, 0.15, 1);
    for (int i = 0; i < n; i++) {
        double angle = 2 * PI * (i + 0.8 * random_unit(s)) / n,
               radius = size * (convex ? 1 : random_uniform(s, inner, 1));
        out[i] = (vec2){radius * real_cos(angle), radius * real_sin(angle)};
    }
    return n;
}

/* A band with teeth: slivers, right angles, vertices on lines. */
static int comb(random_stream *s, double size, vec2 *out)
{
    int teeth = 1 + (int)random_uniform(s, 0, 6), n = 0;
    double width = size * random_uniform(s, 0.05, 1), depth = width * random_uniform(s, 0, 0.95);
    for (int i = 0; i < teeth; i++) {
        double x = size * i / teeth, step = size / teeth;
        out[n++] = (vec2){x, 0};
        out[n++] = (vec2){x + 0.5 * step, 0};
        out[n++] = (vec2){x + 0.5 * step, depth};
        out[n++] = (vec2){x + 0.75 * step, depth};
    }
    out[n++] = (vec2){size, 0};
    out[n++] = (vec2){size, width};
    out[n++] = (vec2){0.5 * size, width};
    out[n++] = (vec2){0, width};
    return n;
}

/* Vertices that add nothing: doubled, collinear, nearly collinear. */
static int dirty(random_stream *s, vec2 *p, int n)
{
    vec2 copy[ROOM];
    int m = 0;
    for (int i = 0; i < n; i++) {
        vec2 a = p[i], b = p[(i + 1) % n];
        copy[m++] = a;
        double u = random_unit(s);
        if (u < 0.2)
            copy[m++] = vec2_add(a, vec2_scale(vec2_sub(b, a), random_unit(s)));
        else if (u < 0.3)
            copy[m++] = vec2_add(a, vec2_scale(vec2_sub(b, a), 1e-9));
    }
    for (int i = 0; i < m; i++)
        p[i] = copy[i];
    return m;
}

static int random_outline(random_stream *s, vec2 *out)
{
    double size = random_power_law(s, 2, 200, 0);
    int kind = (int)random_uniform(s, 0, 4), n;
    if (kind == 3)
        n = comb(s, size, out);
    else
        n = star(s, size, kind == 0, out);
    if (random_unit(s) < 0.4)
        n = dirty(s, out, n);
    if (random_unit(s) < 0.3) { /* coordinates on a grid: exact ties */
        double grid = size / 64;
        for (int i = 0; i < n; i++)
            out[i] = (vec2){grid * floor(out[i].x / grid), grid * floor(out[i].y / grid)};
    }
    return n;
}

/* ---- loads ---- */

/* On a vertex, on an edge, near the boundary, or anywhere. */
static vec2 random_place(random_stream *s, polygon p)
{
    int32_t i = (int32_t)random_uniform(s, 0, p.count);
    vec2 a = p.vertex[i], b = p.vertex[(i + 1) % p.count];
    double u = random_unit(s), kind = random_unit(s);
    vec2 on = vec2_add(a, vec2_scale(vec2_sub(b, a), u < 0.2 ? 0.5 : u));
    if (kind < 0.25)
        return a;
    if (kind < 0.5)
        return on;
    if (kind < 0.9)
        return vec2_scale(on, random_uniform(s, 0.8, 1));
    return vec2_scale(on, random_unit(s));
}

/* ---- what must hold ---- */

typedef struct fuzz_books {
    double worst_lost, worst_balance, worst_overlap, area, lost;
    double worst_large; /* of parents of 1000 m2 and more */
    long events, splits, pieces;
} fuzz_books;

static void check_children(fracture_rig *r, const fracture_event *e, fuzz_books *books)
{
    double sum = 0;
    static vec2 ring[64][ROOM];
    polygon child[64];
    int count = 0;
    for (int32_t i = 0; i < r->floes.count; i++) {
        if (r->floes.body[i] < 0 || r->floes.number[i] < e->first_piece ||
            r->floes.number[i] >= e->first_piece + e->pieces)
            continue;
        polygon p = fracture_rig_outline(r, i);
        char reason[OVERLAY_REASON_SIZE];
        ck_assert_msg(overlay_is_valid(r->plane, p, reason, NULL), "%s", reason);
        ck_assert(polygon_area(p) >= r->settings.smallest_floe_area * (1 - 1e-12));
        ck_assert_int_eq(r->floes.parent[i], e->floe);
        sum += polygon_area(p);
        if (count < 64 && p.count < ROOM) {
            int32_t body = r->floes.body[i];
            for (int32_t k = 0; k < p.count; k++) {
                vec3 v = body_to_global(&r->bodies, body, (vec3){p.vertex[k].x, p.vertex[k].y, 0});
                ring[count][k] = (vec2){v.x, v.y};
            }
            child[count] = (polygon){ring[count], p.count};
            count++;
        }
    }
    double balance = fabs(e->parent_area - sum - e->area_lost + e->area_gained) / e->parent_area;
    books->worst_balance = fmax(books->worst_balance, balance);
    ck_assert_msg(balance <= 1e-9, "area balance %g of %g m2", balance, e->parent_area);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < i; k++) {
            double overlap = polygon_overlap_area(child[i], child[k]);
            double edge = overlap / (0.5 * fmin(polygon_perimeter(child[i]), polygon_perimeter(child[k])));
            books->worst_overlap = fmax(books->worst_overlap, edge);
            /* Beyond the threshold: where dust was joined, corners nearer than 1e-9 of the perimeter became one. */
            double joints = 1e-9 * fmax(polygon_perimeter(child[i]), polygon_perimeter(child[k]));
            ck_assert_msg(edge <= r->settings.edge_threshold + joints, "siblings overlap by %g m", edge);
        }
    double lost = (e->area_lost + e->area_gained) / e->parent_area;
    books->worst_lost = fmax(books->worst_lost, lost);
    if (e->parent_area > 1000)
        books->worst_large = fmax(books->worst_large, lost);
    ck_assert_msg(lost <= 1e-3, "%g of a parent of %g m2 is booked", lost, e->parent_area);
    books->area += e->parent_area;
    books->lost += e->area_lost + e->area_gained;
    books->events++;
    books->splits += e->kind == FRACTURE_SPLIT;
    books->pieces += e->pieces;
}

/* An overlay may move edges by this part of the ring's extent (the coarsest grid of src/geometry/overlay.c, 2^-38), and
   an event has up to so many. */
static const double OVERLAY_MOVES = 4e-12;
enum { OVERLAYS = 16 };

/* What moved edges may do to a floe's momentum [N s]: ice of its rim appears or goes, at the speed of the rim. */
static double momentum_slack(const fracture_rig *r, int32_t row)
{
    int32_t body = r->floes.body[row];
    double radius = r->shapes.shapes.plan_radius[r->bodies.shape[body]];
    double rim = vec3_length(r->bodies.velocity[body]) + radius * vec3_length(r->bodies.angular_velocity[body]);
    double area = OVERLAYS * OVERLAY_MOVES * radius * polygon_perimeter(fracture_rig_outline(r, row));
    return 920 * r->floes.thickness[row] * area * rim;
}

/* Mass changes by what was booked; where nothing is cleaned or lost, momentum and angular momentum stay but for what
   overlays move. */
static void check_momentum(body_books before, body_books after, const fracture_event *e, double line, double reach,
                           double slack, bool cleaned)
{
    double mass = before.mass, speed = sqrt(2 * before.kinetic_energy / mass) + 1e-9;
    ck_assert(fabs(after.mass - mass + line * (e->area_lost - e->area_gained)) <= 1e-9 * mass);
    /* What the books name as lost closes them, cleaned or not. */
    double p_open = vec3_length(vec3_sub(vec3_sub(before.momentum, after.momentum), e->momentum_lost));
    ck_assert_msg(p_open <= 1e-12 * mass * speed, "momentum books are open by %g of %g", p_open, mass * speed);
    vec3 h_change = vec3_sub(before.angular_momentum, after.angular_momentum);
    double h_open = vec3_length(vec3_sub(h_change, e->angular_momentum_lost));
    ck_assert(h_open <= 1e-12 * (vec3_length(before.angular_momentum) + mass * speed));
    if (cleaned || e->area_lost + e->area_gained > 1e-12 * e->parent_area)
        return;
    double p = vec3_length(vec3_sub(after.momentum, before.momentum));
    ck_assert_msg(p <= slack + 1e-12 * mass * speed, "momentum changes by %g of %g", p, mass * speed);
    double h = vec3_length(vec3_sub(after.angular_momentum, before.angular_momentum));
    ck_assert_msg(h <= (slack + 1e-12 * mass * speed) * reach, "angular momentum changes by %g of %g", h,
                  vec3_length(before.angular_momentum));
}

static int32_t random_floe(const fracture_rig *r, random_stream *s)
{
    int pick = (int)random_uniform(s, 0, fracture_rig_count(r));
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && pick-- == 0)
            return i;
    return -1;
}

/* One floe and its descendants, a few generations long. */
static void break_one(fracture_rig *r, random_stream *s, fuzz_books *books)
{
    vec2 outline[ROOM];
    int n = random_outline(s, outline);
    double thickness = random_power_law(s, 0.2, 2, 0);
    polygon p = {outline, n};
    if (!overlay_is_valid(r->plane, p, NULL, NULL) || polygon_area(p) < 1)
        return;
    int32_t row = fracture_rig_floe(r, p, thickness, MOTION_DYNAMIC);
    if (row < 0)
        return;
    int32_t body = r->floes.body[row];
    r->bodies.orientation[body] =
        quat_from_roll_pitch_yaw(random_uniform(s, -0.3, 0.3), random_uniform(s, -0.3, 0.3), random_uniform(s, -3, 3));
    r->bodies.velocity[body] = (vec3){random_normal(s), random_normal(s), random_normal(s)};
    r->bodies.angular_velocity[body] = (vec3){random_normal(s), random_normal(s), random_normal(s)};
    r->settings.wedges = 2 + (int32_t)random_uniform(s, 0, 4);
    r->settings.splitting_factor = random_unit(s) < 0.5 ? 3 : 1;
    r->settings.wide_contacts = random_unit(s) < 0.5;
    r->settings.joint_loads = random_unit(s) < 0.5;
    r->settings.edge_threshold = random_unit(s) < 0.2 ? 0 : 0.15;
    for (int turn = 0; turn < GENERATIONS && fracture_rig_count(r) > 0; turn++) {
        row = random_floe(r, s);
        int loads = 1 + (int)(random_unit(s) * 2.2);
        for (int i = 0; i < loads; i++) {
            vec2 place = random_place(s, fracture_rig_outline(r, row));
            ck_assert(
                fracture_rig_load(r, row, place, 1e8 * random_uniform(s, 0.5, 1), random_power_law(s, 1e-3, 8, 0)));
            vec2 half = {random_uniform(s, -8, 8), random_uniform(s, -8, 8)};
            ck_assert(!r->settings.wide_contacts || fracture_rig_widen(r, half));
        }
        body_books before = body_books_of(&r->bodies);
        double reach = 0; /* of the farthest ice from the origin [m] */
        for (int32_t i = 0; i < r->floes.count; i++)
            if (r->floes.body[i] >= 0)
                reach = fmax(reach, vec3_length(r->bodies.position[r->floes.body[i]]) +
                                        r->shapes.shapes.radius[r->bodies.shape[r->floes.body[i]]]);
        double slack = momentum_slack(r, row);
        if (fracture_rig_break(r) == 0)
            continue;
        ck_assert_int_eq(r->events.count, 1);
        check_children(r, &r->events.data[0], books);
        check_momentum(before, body_books_of(&r->bodies), &r->events.data[0], 920 * thickness, reach, slack,
                       r->settings.edge_threshold > 0);
    }
    fracture_rig_remove_all(r);
}

START_TEST(fuzzed_events)
{
    fracture_rig r;
    fracture_rig_make(&r);
    fuzz_books books = {0};
    long wanted = number_from("FRAM_FUZZ_EVENTS", getenv("FRAM_TEST_SHORT") ? 5000 : 20000);
    long seed = number_from("FRAM_FUZZ_SEED", 1);
    for (uint32_t id = 0; books.events < wanted; id++) {
        random_stream s = random_begin((uint64_t)seed, 1, id);
        break_one(&r, &s, &books);
    }
    printf(
        "%ld events, %ld splits, %ld pieces; booked %.4f %% of the area, at most %.3f %% of a parent (%.4f %% of those "
        "over 1000 m2); balance %.1e, overlap %.2e m\n",
        books.events, books.splits, books.pieces, 100 * books.lost / books.area, 100 * books.worst_lost,
        100 * books.worst_large, books.worst_balance, books.worst_overlap);
    fracture_rig_free(&r);
}
END_TEST

TEST_MAIN("fracture_fuzz", fuzzed_events)
