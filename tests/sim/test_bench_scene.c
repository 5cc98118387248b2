/* Scenes of the benchmark: the same bits whatever runs them, poses written in the order of the scene, failures told. */
#include "base/pool.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "scratch.h"
#include "sim/bench.h"

#include <stdio.h>
#include <unistd.h>

/* A packed field like the peers': a honeycomb of shrunken cells of 5 and 6 sides in a basin, driven along it by a
   current, and a ship. */
static scene_text make_scene(context *ctx, int side)
{
    const double pitch = 10, rise = 5 * sqrt(3);
    scene_text s = {.gravity = 9.81,
                    .water_density = 1025,
                    .current = {1, 0.2},
                    .form_drag = 1,
                    .skin_drag = 0.01,
                    .friction = 0.1,
                    .domain = {{-60, 0}, {pitch * (side + 0.5), rise * (side + 0.5)}},
                    .ship = true,
                    .ship_length = 40,
                    .ship_beam = 9,
                    .ship_depth = 6,
                    .ship_draught = 3,
                    .ship_centre = {-22, rise * side / 2},
                    .ship_velocity = {2, 0}};
    random_stream draw = random_begin(31, 0, 0);
    for (int i = 0; i < side * side; i++) {
        int row = i / side, column = i % side;
        double x = pitch * (column + (row % 2 ? 1 : 0.5)), y = rise * row + 5.8;
        double radius = pitch / sqrt(3) * random_uniform(&draw, 0.95, 0.995);
        vec2 corner[6];
        for (int k = 0; k < 6; k++)
            corner[k] = vec2_make(radius * real_cos(PI / 3 * k + PI / 6), radius * real_sin(PI / 3 * k + PI / 6));
        scene_floe f = {1, 910, {x, y}, s.vertices.count, i % 3 ? 6 : 5};
        vec2 middle = polygon_moments_of((polygon){corner, f.count}).centroid;
        f.centre = vec2_add(f.centre, middle);
        for (int k = 0; k < f.count; k++)
            ck_assert(array_push(ctx, &s.vertices, vec2_sub(corner[k], middle)));
        ck_assert(array_push(ctx, &s.floes, f));
    }
    return s;
}

static const double golden_energy[] = {
    [SOLVER_SEQUENTIAL] = 0x1.0f8838f8a8221p+20, [SOLVER_FAST] = 0x1.14455d6a78e8dp+20};

static const bench_scene_options plain = {
    .time_step = 0.02, .warm = 1, .time = 3, .iterations = 10, .solver = SOLVER_FAST};

static bench_result run_with(const scene_text *s, int threads, isa set, solver_kind kind)
{
    context ctx;
    context_init(&ctx);
    ctx.isa = set;
    ctx.threads = pool_create(&ctx, threads);
    ck_assert_ptr_nonnull(ctx.threads);
    bench_scene_options o = plain;
    o.solver = kind;
    bench_result r;
    fram_error e = {0};
    assert_ok(bench_scene(&ctx, s, &o, &r, &e), e);
    ck_assert_int_eq(r.steps, 100);
    ck_assert_msg(r.loaded_pairs > 10 && r.contact_points > r.pairs && r.pairs > 0, "%g pairs, %g overlap at %g points",
                  r.loaded_pairs, r.pairs, r.contact_points);
    pool_free(&ctx, ctx.threads);
    return r;
}

static void assert_same_bits(solver_kind kind)
{
    context ctx;
    context_init(&ctx);
    scene_text s = make_scene(&ctx, 14);
    const int threads[] = {1, 2, 3, 4, 8};
    uint64_t first = run_with(&s, 1, ISA_BASELINE, kind).state_hash;
    for (int k = 1; k < 5; k++)
        ck_assert(run_with(&s, threads[k], (isa)(k % ((int)isa_best() + 1)), kind).state_hash == first);
    for (int i = ISA_BASELINE + 1; i <= (int)isa_best(); i++)
        ck_assert(run_with(&s, 1, (isa)i, kind).state_hash == first);
    scene_text_free(&ctx, &s);
}

START_TEST(the_same_bits_on_any_threads_and_instruction_set) { assert_same_bits(SOLVER_FAST); }
END_TEST
START_TEST(the_same_bits_in_sequence) { assert_same_bits(SOLVER_SEQUENTIAL); }
END_TEST

/* What a fixed scene comes to, by gcc and by clang, today and tomorrow: the kinetic energy of all floes, in which a bit
   anywhere in three seconds shows.  When a change of the arithmetic is meant, the new value stands in the message. */
START_TEST(energies_are_golden)
{
    context ctx;
    context_init(&ctx);
    scene_text s = make_scene(&ctx, 12);
    for (int kind = SOLVER_SEQUENTIAL; kind <= SOLVER_FAST; kind++) {
        bench_result r = run_with(&s, 1, isa_best(), (solver_kind)kind);
        ck_assert_msg(r.kinetic_energy == golden_energy[kind], "solver %d: the kinetic energy is %a J", kind,
                      r.kinetic_energy);
    }
    scene_text_free(&ctx, &s);
}
END_TEST

START_TEST(poses_come_in_the_order_of_the_scene)
{
    context ctx;
    context_init(&ctx);
    scene_text s = make_scene(&ctx, 6);
    char folder[SCRATCH_FOLDER], path[SCRATCH_PATH];
    scratch_folder(folder);
    snprintf(path, sizeof path, "%s/poses.csv", folder);
    bench_scene_options o = {.time_step = 0.02, .warm = 0, .time = 0.04, .iterations = 5, .dump = path};
    bench_result r;
    fram_error e = {0};
    assert_ok(bench_scene(&ctx, &s, &o, &r, &e), e);
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    char line[400];
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    ck_assert_str_eq(line, "id,x,y,z,qx,qy,qz,qw,tilt_deg\n");
    for (int i = 0; i < 36; i++) {
        int id;
        double x, y, z;
        ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
        ck_assert_int_eq(sscanf(line, "%d,%lf,%lf,%lf", &id, &x, &y, &z), 4);
        ck_assert_int_eq(id, i);
        assert_absolute(x, s.floes.data[i].centre.x, 0.1);
        assert_absolute(y, s.floes.data[i].centre.y, 0.1);
        assert_absolute(z, 0.5 - 910.0 / 1025, 0.05);
    }
    ck_assert_ptr_null(fgets(line, sizeof line, file));
    fclose(file);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(rmdir(folder), 0);
    o.dump = "/nowhere/poses.csv";
    ck_assert_int_ne(bench_scene(&ctx, &s, &o, &r, &e), FRAM_OK);
    ck_assert_str_eq(e.file, "/nowhere/poses.csv");
    scene_text_free(&ctx, &s);
}
END_TEST

START_TEST(memory_runs_out)
{
    context plenty;
    context_init(&plenty);
    scene_text s = make_scene(&plenty, 4);
    bench_scene_options o = {.time_step = 0.02, .warm = 0.02, .time = 0.06, .iterations = 5};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        bench_result r;
        turn.status = bench_scene(&turn.ctx, &s, &o, &r, &turn.error);
    }
    scene_text_free(&plenty, &s);
}
END_TEST

TEST_MAIN("bench_scene", the_same_bits_on_any_threads_and_instruction_set, the_same_bits_in_sequence,
          energies_are_golden, poses_come_in_the_order_of_the_scene, memory_runs_out)
