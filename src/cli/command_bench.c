/* fram bench: the speed of stepping a scenario, without output. */
#include "cli.h"

static void print_result(const common_options *common, const fram_bench_result *r)
{
    if (!common->quiet) {
        fprintf(stderr, "%d floes, %lld steps: %.3f ms CPU a step (median), %.3f ms wall, %.3f us per floe and step\n",
                r->floes, (long long)r->steps, r->ms_per_step_median, r->ms_wall_median, r->us_per_floe_step);
        fprintf(stderr,
                "real-time factor %.2f; %.0f contact points in %.0f pairs; overlap mean %.3g m, largest %.3g m\n",
                r->real_time_factor, r->contact_points, r->pairs, r->mean_penetration_m, r->max_penetration_m);
    }
    if (!common->json)
        return;
    json j = json_begin();
    json_integer(&j, "floes", r->floes);
    json_integer(&j, "steps", r->steps);
    json_real(&j, "ms_per_step_median", r->ms_per_step_median);
    json_real(&j, "ms_wall_median", r->ms_wall_median);
    json_real(&j, "us_per_floe_step", r->us_per_floe_step);
    json_real(&j, "real_time_factor", r->real_time_factor);
    json_real(&j, "contact_points", r->contact_points);
    json_real(&j, "pairs", r->pairs);
    json_real(&j, "mean_penetration_m", r->mean_penetration_m);
    json_real(&j, "max_penetration_m", r->max_penetration_m);
    json_real(&j, "ship_force_kN", r->ship_force_kN);
    json_real(&j, "kinetic_energy_J", r->kinetic_energy_J);
    json_real(&j, "solver_residual_m_per_s", r->solver_residual);
    json_hash(&j, "state_hash", r->state_hash);
    json_end(&j);
}

int command_bench(const command_row *self, int argc, char **argv)
{
    common_options common;
    option_list overrides = {0};
    const char *path = NULL;
    double warm = 2, time = 10;
    const option_row rows[] = {
        {"--warm", NULL, OPTION_REAL, &warm, "T", "simulated seconds before measuring (2)"},
        {"--time", NULL, OPTION_REAL, &time, "T", "simulated seconds to measure (10)"},
        {"--set", NULL, OPTION_LIST, &overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &path, 1);
    if (code >= 0)
        return code;
    if (!(warm >= 0 && warm <= 1e6))
        return answer_usage(&common, "--warm", "must lie between 0 and 1e6 s");
    if (!(time > 0 && time <= 1e6))
        return answer_usage(&common, "--time", "must be positive and at most 1e6 s");
    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;

    fram_scenario *scenario = NULL;
    fram_error error = {0};
    fram_bench_result result = {0};
    fram_status status = fram_scenario_load(context, path, overrides.value, overrides.count, &scenario, &error);
    if (status == FRAM_OK)
        status = fram_bench(scenario, warm, time, &result, &error);
    if (status != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        print_result(&common, &result);
    }
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return code;
}
