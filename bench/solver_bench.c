/* What the solver costs per contact: a packed grid of floes whose contacts are given, no collision detection.

       solver_bench [FLOES...]            default: 1000 10000 100000

   Each floe meets its right, upper and upper right neighbour in three points, as in a packed field.  Two numbers of
   iterations tell the cost of one iteration and what a step costs besides; for each solver, instruction set and number
   of threads.  Best of several solves without memory of the last one; CPU time for one thread, wall time for more.
   First the bandwidth of a triad a = b + s c over as many bytes as the rows of each size take, by one thread. */
#include "base/pool.h"
#include "base/random.h"
#include "dynamics/solver.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { POINTS = 3, FEW = 10, MANY = 40 };
#define STEP 0.02

typedef struct field {
    context ctx;
    body_table bodies, start;
    contact_array contacts;
    wrench *loads;
    solver *solve;
} field;

static void fail(const char *what)
{
    fprintf(stderr, "solver_bench: %s\n", what);
    exit(1);
}

static double now(const context *ctx)
{
    struct timespec t;
    clock_gettime(context_threads(ctx) == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Points of the side between two floes: from b to a along the normal, a metre high. */
static void add_pair(field *f, int32_t a, int32_t b, random_stream *random)
{
    vec3 way = vec3_sub(f->bodies.position[a], f->bodies.position[b]), middle;
    middle = vec3_mad(f->bodies.position[b], way, 0.5);
    vec3 normal = vec3_unit(vec3_make(way.x, way.y, 0.05 * (random_unit(random) - 0.5)));
    vec3 along = vec3_make(-normal.y, normal.x, 0);
    for (int k = 0; k < POINTS; k++) {
        contact c = {.a = a, .b = b, .normal = normal, .depth = 0.01, .impulse_limit = HUGE_VAL};
        c.point = vec3_mad(middle, along, 2.5 * (k - 1));
        c.point.z += 0.4 * (k % 2 ? 1 : -1);
        c.friction_static = c.friction_kinetic = 0.3;
        c.correct = true;
        c.patch = -1;
        c.key = contact_key(&f->bodies, a, b, 0, 0, (uint32_t)k);
        if (!array_push(&f->ctx, &f->contacts, c))
            fail("no memory");
    }
}

static field field_make(int32_t side)
{
    field f = {.contacts = {0}};
    context_init(&f.ctx);
    for (int32_t i = 0; i < side * side; i++) {
        random_stream random = random_begin(1, 0, (uint32_t)i);
        int32_t slot = body_create(&f.ctx, &f.bodies, MOTION_DYNAMIC, MATERIAL_ICE);
        if (slot < 0)
            fail("no memory");
        double mass = 91000 * (0.5 + random_unit(&random));
        int32_t row = i / side;
        f.bodies.position[slot] = vec3_make(10 * (i % side), 10 * row, 0);
        f.bodies.mass[slot] = mass;
        f.bodies.inertia[slot] = (sym3){.xx = 6.3 * mass, .yy = 6.3 * mass, .zz = 12.5 * mass};
        f.bodies.velocity[slot] =
            vec3_make(random_unit(&random) - 0.5, random_unit(&random) - 0.5, 0.1 * (random_unit(&random) - 0.5));
    }
    random_stream random = random_begin(2, 0, 0);
    for (int32_t i = 0; i < side * side; i++) {
        bool right = i % side < side - 1, upper = i / side < side - 1;
        if (right)
            add_pair(&f, i, i + 1, &random);
        if (upper)
            add_pair(&f, i, i + side, &random);
        if (right && upper)
            add_pair(&f, i, i + side + 1, &random);
    }
    f.loads = memory_array(&f.ctx, (size_t)f.bodies.count, sizeof *f.loads);
    f.solve = solver_create(&f.ctx);
    if (!f.loads || !f.solve || !table_copy(&f.ctx, &f.start, &f.bodies, &body_table_info))
        fail("no memory");
    return f;
}

/* Seconds of one step with so many iterations, both of velocities and, if asked for, of positions. */
static double solve_time(field *f, solver_kind kind, int32_t iterations, bool positions, int repeats)
{
    double best = HUGE_VAL;
    solver_settings settings = {.kind = kind,
                                .iterations = iterations,
                                .position_iterations = iterations,
                                .correction_rate = 0.8,
                                .tolerance = 0,
                                .most_iterations = iterations};
    for (int k = 0; k < repeats; k++) {
        contact_memory_table memory = {0};
        joint_table joints = {0};
        fram_error error = {0};
        if (!table_copy(&f->ctx, &f->bodies, &f->start, &body_table_info))
            fail("no memory");
        double begun = now(&f->ctx);
        fram_status status = solver_solve(&f->ctx, f->solve, &settings, STEP, &f->bodies, f->loads, &joints,
                                          &f->contacts, &memory, NULL, &error);
        double solved = now(&f->ctx);
        if (status == FRAM_OK)
            status =
                solver_correct_positions(&f->ctx, f->solve, &settings, STEP, &f->bodies, &joints, &f->contacts, &error);
        if (status != FRAM_OK)
            fail(error.message);
        best = fmin(best, positions ? now(&f->ctx) - solved : solved - begun);
        table_free(&f->ctx, &memory, &contact_memory_table_info);
    }
    return best;
}

static void print_row(field *f, const char *name, solver_kind kind, bool positions)
{
    double contacts = f->contacts.count;
    int repeats = contacts > 2e5 ? 3 : contacts > 2e4 ? 7 : 25;
    double few = solve_time(f, kind, FEW, positions, repeats), many = solve_time(f, kind, MANY, positions, repeats);
    double slope = (many - few) / (MANY - FEW), rest = few - FEW * slope;
    printf("| %d | %d | %s | %s | %d | %.1f | %.0f | %.3f |\n", (int)f->bodies.count, (int)f->contacts.count, name,
           kind == SOLVER_FAST ? isa_name(f->ctx.isa) : "-", context_threads(&f->ctx), 1e9 * slope / contacts,
           1e9 * rest / contacts, 1e3 * (rest + 30 * slope));
    fflush(stdout);
}

static void measure(int32_t floes)
{
    field f = field_make((int32_t)(sqrt((double)floes) + 0.5));
    print_row(&f, "sequential", SOLVER_SEQUENTIAL, false);
    for (isa set = ISA_BASELINE; set <= isa_best(); set++) {
        f.ctx.isa = set;
        print_row(&f, "fast", SOLVER_FAST, false);
        print_row(&f, "fast, positions", SOLVER_FAST, true);
    }
    for (int threads = 2; threads <= 2; threads++) {
        f.ctx.threads = pool_create(&f.ctx, threads);
        print_row(&f, "fast", SOLVER_FAST, false);
        print_row(&f, "fast, positions", SOLVER_FAST, true);
        pool_free(&f.ctx, f.ctx.threads);
        f.ctx.threads = NULL;
    }
    solver_free(&f.ctx, f.solve);
    table_free(&f.ctx, &f.bodies, &body_table_info);
    table_free(&f.ctx, &f.start, &body_table_info);
    array_free(&f.ctx, &f.contacts);
    memory_free(&f.ctx, f.loads);
}

/* Bytes that a contact's share of a full batch takes in a sweep, read and written: its point rows, its impulses twice,
   a third of the frame, and both bodies' rows (velocity read and written, inverse masses read). */
enum { POINT_BYTES = 16 * 8, IMPULSE_BYTES = 2 * 3 * 8, FRAME_BYTES = 5 * 8, BODY_BYTES = 3 * 8 * 8 };

static double sweep_bytes(void) { return POINT_BYTES + IMPULSE_BYTES + (FRAME_BYTES + 2.0 * BODY_BYTES) / POINTS; }

/* Bytes a second of a triad over three arrays of `bytes` together; best of some. */
static double triad(double bytes)
{
    int64_t n = (int64_t)(bytes / 24) + 8;
    double *a = calloc((size_t)n, sizeof *a), *b = calloc((size_t)n, sizeof *b), *c = calloc((size_t)n, sizeof *c);
    if (!a || !b || !c)
        fail("no memory");
    double best = HUGE_VAL, sum = 0;
    int64_t turns = 1 + (int64_t)(2e8 / bytes);
    for (int k = 0; k < 5; k++) {
        context ctx;
        context_init(&ctx);
        double begun = now(&ctx);
        for (int64_t t = 0; t < turns; t++) {
            double s = (double)t + 0.5;
            for (int64_t i = 0; i < n; i++)
                a[i] = b[i] + s * c[i];
            b[t % n] += 1; /* so that no turn is the last one's */
            sum += a[t % n];
        }
        best = fmin(best, (now(&ctx) - begun) / (double)turns);
    }
    if (sum < 0)
        printf("\n");
    free(a);
    free(b);
    free(c);
    return 24.0 * (double)n / best;
}

static void print_bandwidth(double contacts)
{
    double bytes = sweep_bytes(), rate = triad(bytes * contacts);
    printf("%.0f contacts: %.0f bytes a contact and sweep, triad %.1f GB/s, floor %.1f ns\n", contacts, bytes,
           1e-9 * rate, 1e9 * bytes / rate);
}

int main(int argc, char **argv)
{
    for (int32_t contacts = 9000; contacts < 1000000; contacts *= 10)
        print_bandwidth(contacts);
    printf("\n");
    printf("| floes | contacts | solver | set | threads | ns a contact, sweep | ns a contact besides | ms at 30 |\n");
    printf("|---|---|---|---|---|---|---|---|\n");
    for (int i = 1; i < argc; i++)
        measure(atoi(argv[i]));
    if (argc == 1)
        for (int32_t floes = 1000; floes <= 100000; floes *= 10)
            measure(floes);
    return 0;
}
