/* fram bench: the speed of stepping a scenario, or a scene of other engines, without output. */
#include "cli/cli.h"

/* A number that nobody writes on a command line: -1 is one that somebody may, and must be refused. */
#define NOT_GIVEN (-1e300)

/* What a scenario is measured for unless it is said [s]; a scene has the library's defaults. */
#define SCENARIO_WARM 2
#define SCENARIO_TIME 10

typedef struct bench_words {
    common_options common;
    const char *path; /* of the scenario, or of the scene */
    bool is_scene, all_solvers, exact_water;
    double warm, time; /* NOT_GIVEN, 0: the default */
    /* Of a scene; 0, 0, NULL: the defaults. */
    double time_step;
    int iterations;
    const char *solver;
    option_list overrides;
    fram_bench_scene_definition scene;
} bench_words;

static void print_text(const fram_bench_result *r)
{
    fprintf(stderr, "%d floe%s, %lld step%s: %.3f ms CPU a step (median), %.3f ms wall, %.3f us per floe and step\n",
            r->floes, plural(r->floes), (long long)r->steps, plural(r->steps), r->ms_per_step_median, r->ms_wall_median,
            r->us_per_floe_step);
    fprintf(stderr, "collision %.3f ms, solver and integration %.3f ms, forces %.3f ms; real-time factor %.2f\n",
            r->collide_ms, r->solve_ms, r->forces_ms, r->real_time_factor);
    fprintf(stderr, "mean step %.3f ms CPU, 99 %% within %.3f, 99.9 %% within %.3f, longest %.3f (wall %.3f)\n",
            r->ms_mean, r->ms_p99, r->ms_p999, r->ms_longest, r->ms_wall_longest);
    fprintf(stderr, "shares: forces %.0f %%, collision %.0f %%, crushing %.0f %%, solver %.0f %%, fracture %.0f %%\n",
            1e2 * r->share_forces, 1e2 * r->share_collision, 1e2 * r->share_crushing, 1e2 * r->share_solver,
            1e2 * r->share_fracture);
    fprintf(stderr, "%.0f loaded pairs; %.0f overlapping points in %.0f pairs, mean %.3g m, largest %.3g m\n",
            r->loaded_pairs, r->contact_points, r->pairs, r->mean_penetration_m, r->max_penetration_m);
}

static void json_result(json *j, const fram_bench_result *r)
{
    json_integer(j, "floes", r->floes);
    json_integer(j, "steps", r->steps);
    json_real(j, "ms_per_step_median", r->ms_per_step_median);
    json_real(j, "ms_wall_median", r->ms_wall_median);
    json_real(j, "us_per_floe_step", r->us_per_floe_step);
    json_real(j, "collide_ms", r->collide_ms);
    json_real(j, "solve_ms", r->solve_ms);
    json_real(j, "forces_ms", r->forces_ms);
    json_real(j, "real_time_factor", r->real_time_factor);
    json_real(j, "contact_points", r->contact_points);
    json_real(j, "pairs", r->pairs);
    json_real(j, "loaded_pairs", r->loaded_pairs);
    json_real(j, "mean_penetration_m", r->mean_penetration_m);
    json_real(j, "max_penetration_m", r->max_penetration_m);
    json_real(j, "ship_force_kN", r->ship_force_kN);
    json_real(j, "kinetic_energy_J", r->kinetic_energy_J);
    json_real(j, "solver_residual_m_per_s", r->solver_residual);
    json_real(j, "ms_mean", r->ms_mean);
    json_real(j, "ms_p99", r->ms_p99);
    json_real(j, "ms_p999", r->ms_p999);
    json_real(j, "ms_longest", r->ms_longest);
    json_real(j, "ms_wall_p99", r->ms_wall_p99);
    json_real(j, "ms_wall_p999", r->ms_wall_p999);
    json_real(j, "ms_wall_longest", r->ms_wall_longest);
    json_real(j, "share_forces", r->share_forces);
    json_real(j, "share_collision", r->share_collision);
    json_real(j, "share_crushing", r->share_crushing);
    json_real(j, "share_solver", r->share_solver);
    json_real(j, "share_fracture", r->share_fracture);
    json_hash(j, "state_hash", r->state_hash);
}

static fram_status bench_scenario_file(fram_context *context, const bench_words *w, fram_bench_result *result,
                                       fram_error *error)
{
    fram_scenario *scenario = NULL;
    fram_status status = fram_scenario_load(context, w->path, w->overrides.value, w->overrides.count, &scenario, error);
    if (status == FRAM_OK)
        status = fram_bench(scenario, w->warm == NOT_GIVEN ? SCENARIO_WARM : w->warm,
                            w->time > 0 ? w->time : SCENARIO_TIME, result, error);
    fram_scenario_destroy(scenario);
    return status;
}

static int bench_once(fram_context *context, const bench_words *w)
{
    fram_error error = {0};
    fram_bench_result result = {0};
    fram_status status = w->is_scene ? fram_bench_scene(context, w->path, &w->scene, &result, &error)
                                     : bench_scenario_file(context, w, &result, &error);
    if (status != FRAM_OK)
        return answer_error(&w->common, &error);
    if (!w->common.quiet)
        print_text(&result);
    if (w->common.json) {
        json j = json_begin();
        json_result(&j, &result);
        json_end(&j);
    }
    return EXIT_GOOD;
}

/* Load, residual, penetration and time of each solver on one scene. */
static int bench_solvers(fram_context *context, const bench_words *w)
{
    static const char *const names[] = {"sequential", "fast", "accurate"};
    enum { SOLVERS = sizeof names / sizeof *names };
    fram_bench_result result[SOLVERS];
    fram_bench_scene_definition scene = w->scene;
    scene.dump = NULL;
    if (!w->common.quiet)
        fprintf(stderr, "%-12s %12s %14s %12s %12s %12s\n", "solver", "load kN", "residual m/s", "mean m", "largest m",
                "ms per step");
    for (int i = 0; i < SOLVERS; i++) {
        fram_error error = {0};
        scene.solver = names[i];
        fram_bench_result *r = &result[i];
        if (fram_bench_scene(context, w->path, &scene, r, &error) != FRAM_OK)
            return answer_error(&w->common, &error);
        if (!w->common.quiet)
            fprintf(stderr, "%-12s %12.1f %14.3g %12.3g %12.3g %12.3f\n", names[i], r->ship_force_kN,
                    r->solver_residual, r->mean_penetration_m, r->max_penetration_m, r->ms_per_step_median);
    }
    if (w->common.json) {
        json j = json_begin();
        for (int i = 0; i < SOLVERS; i++) {
            json_open(&j, names[i]);
            json_result(&j, &result[i]);
            json_close(&j);
        }
        json_end(&j);
    }
    return EXIT_GOOD;
}

/* The rest of what the words must fulfil; -1: good. */
static int check_bench_words(const bench_words *w, const char *scene)
{
    if (scene && w->path)
        return answer_usage(&w->common, w->path, "one scenario or one scene, not both");
    if (!scene && !w->path)
        return answer_usage(&w->common, "SCENARIO", "name a scenario file, or a scene with --scene FILE");
    const char *of_scenes = w->all_solvers      ? "--solvers"
                            : w->scene.dump     ? "--dump"
                            : w->exact_water    ? "--exact-water"
                            : w->time_step > 0  ? "--dt"
                            : w->iterations > 0 ? "--iterations"
                            : w->solver != NULL ? "--solver"
                                                : NULL;
    if (!scene && of_scenes)
        return answer_usage(&w->common, of_scenes, "is for scenes: --scene FILE");
    if (w->all_solvers && (w->solver || w->scene.dump))
        return answer_usage(&w->common, w->solver ? "--solver" : "--dump", "is of one solver, --solvers of all");
    if (scene && w->overrides.count > 0)
        return answer_usage(&w->common, "--set", "is for scenarios");
    return -1;
}

int command_bench(const command_row *self, int argc, char **argv)
{
    bench_words w = {.warm = NOT_GIVEN};
    const char *scene = NULL;
    fram_bench_scene_default(&w.scene);
    const option_row rows[] = {
        {"--warm", NULL, OPTION_REAL, &w.warm, "T", "simulated seconds before measuring (2; scene: 5)"},
        {"--time", NULL, OPTION_SIZE, &w.time, "T", "simulated seconds to measure (10); scene: total (20)"},
        {"--set", NULL, OPTION_LIST, &w.overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
        {"--scene", NULL, OPTION_TEXT, &scene, "FILE", "a scene in the format of bench/peers, instead of a scenario"},
        {"--dt", NULL, OPTION_SIZE, &w.time_step, "S", "scene: time step (0.02 s)"},
        {"--iterations", NULL, OPTION_COUNT, &w.iterations, "N", "scene: solver iterations (10)"},
        {"--solver", NULL, OPTION_TEXT, &w.solver, "NAME", "scene: sequential, fast or accurate"},
        {"--solvers", NULL, OPTION_FLAG, &w.all_solvers, NULL,
         "scene: compare load, residual, overlap and time of each solver"},
        {"--exact-water", NULL, OPTION_FLAG, &w.exact_water, NULL,
         "scene: Fram's own water in place of the scene's columns"},
        {"--dump", NULL, OPTION_TEXT, &w.scene.dump, "FILE", "scene: write the final poses as CSV"},
    };
    int code = options_read_some(self, rows, sizeof rows / sizeof *rows, &w.common, argc, argv, &w.path, 0, 1);
    if (code >= 0)
        return code;
    code = check_bench_words(&w, scene);
    const command_files files = {.inputs = {scene}, .outputs = {{"--dump", w.scene.dump, TABLE_ENDINGS}}};
    if (code < 0)
        code = refuse_outputs(&w.common, &files);
    if (code >= 0)
        return code;
    if (scene) {
        w.is_scene = true;
        w.path = scene;
        w.scene.exact_water = w.exact_water;
        w.scene.time_step = w.time_step > 0 ? w.time_step : w.scene.time_step;
        w.scene.iterations = w.iterations > 0 ? w.iterations : w.scene.iterations;
        w.scene.solver = w.solver ? w.solver : w.scene.solver;
        w.scene.warm = w.warm == NOT_GIVEN ? w.scene.warm : w.warm;
        w.scene.time = w.time > 0 ? w.time : w.scene.time;
    }
    work_view work;
    fram_context *context = NULL;
    code = session_open_making(&w.common, &work, &context);
    if (code >= 0)
        return code;
    code = w.all_solvers ? bench_solvers(context, &w) : bench_once(context, &w);
    fram_context_destroy(context);
    return code;
}
