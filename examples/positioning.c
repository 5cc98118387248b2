/* A positioning system of one's own: it reads channels, gives orders to thrusters, and later hands the vessel back to
   its own controller with another set point.   cc positioning.c $(pkg-config --cflags --libs fram) -o positioning
   usage: positioning SCENARIO SECONDS [KEY=VALUE]...      (scenes/supply_ship.yaml fits)
   Prints a row of outputs a step, in hexadecimal so that no bit is lost, then the state hash.  tests/fmi/test_supply.py
   holds it against the same controller outside a co-simulation unit. */
#include <fram/live.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum { TUNNELS = 4, MAINS = 2, OUTPUTS = 8 };
static const char *const outputs[OUTPUTS] = {"offset_x",    "offset_y",    "heading_deviation", "velocity_x",
                                             "ice_force_x", "ice_force_y", "contacts",          "kinetic_energy"};

/* A limit that keeps every bit of what is within it. */
static double within(double value, double most) { return value > most ? most : value < -most ? -most : value; }

static int fail(const fram_error *error)
{
    fprintf(stderr, "%s:%d: %s: %s\n", error->file, error->line, error->key, error->message);
    return EXIT_FAILURE;
}

static double channel(const fram_world *world, const char *name)
{
    return fram_world_value(world, fram_world_find_channel(world, name));
}

static fram_status tell(fram_world *world, const char *name, double value, fram_error *error)
{
    return fram_world_set_input(world, fram_world_find_input(world, name), value, error);
}

/* Springs and dampers in surge, sway and yaw [N/m, N s/m, N m/deg], given to the main propellers and to the tunnel
   thrusters fore and aft, which are 26 m from amidships on the average. */
static fram_status steer(fram_world *world, fram_error *error)
{
    double surge = -6e4 * channel(world, "offset_x") - 9e5 * channel(world, "velocity_x");
    double sway = -6e4 * channel(world, "offset_y") - 9e5 * channel(world, "velocity_y");
    double yaw = -1.5e6 * channel(world, "heading_deviation");
    char name[32];
    for (int i = 1; i <= TUNNELS; i++) {
        double order = 0.25 * sway + (i <= TUNNELS / 2 ? 1 : -1) * 0.25 * yaw / 26;
        snprintf(name, sizeof name, "thruster_%d_order", i);
        fram_status status = tell(world, name, within(order, 2e5), error);
        if (status != FRAM_OK)
            return status;
    }
    for (int i = TUNNELS + 1; i <= TUNNELS + MAINS; i++) {
        snprintf(name, sizeof name, "thruster_%d_order", i);
        fram_status status = tell(world, name, within(0.5 * surge, 7e5), error);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

/* The first half by the controller of this program; the second by the vessel's own, 2 m to port. */
static fram_status control(fram_world *world, int step, int steps, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (step == 0)
        status = tell(world, "positioning", 0, error);
    if (step == steps / 2) {
        status = tell(world, "positioning", 1, error);
        if (status == FRAM_OK)
            status = tell(world, "set_point_y", 2, error);
    }
    if (status == FRAM_OK && step < steps / 2)
        status = steer(world, error);
    return status;
}

int main(int argc, char **argv)
{
    if (argc < 3)
        return fprintf(stderr, "usage: positioning SCENARIO SECONDS [KEY=VALUE]...\n"), EXIT_FAILURE;
    fram_context *context = NULL;
    fram_scenario *scenario = NULL;
    fram_world *world = NULL;
    fram_error error;
    if (fram_context_create(NULL, &context, &error) ||
        fram_scenario_load(context, argv[1], (const char *const *)argv + 3, argc - 3, &scenario, &error) ||
        fram_world_create(scenario, &world, &error))
        return fail(&error);
    int steps = (int)(strtod(argv[2], NULL) / fram_scenario_time_step(scenario) + 0.5);
    for (int step = 0; step < steps; step++) {
        if (control(world, step, steps, &error) || fram_world_step(world, &error))
            return fail(&error);
        for (int i = 0; i < OUTPUTS; i++)
            printf("%a%c", channel(world, outputs[i]), i + 1 < OUTPUTS ? ' ' : '\n');
    }
    printf("%016" PRIx64 "\n", fram_world_hash(world));
    fram_world_destroy(world);
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return EXIT_SUCCESS;
}
