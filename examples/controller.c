/* A controller of one's own in 60 lines: a free vessel is held on its station in drifting ice by a PD law on its
   position, which Fram sees as an external wrench.   cc controller.c $(pkg-config --cflags --libs fram) -o controller
   usage: controller SCENARIO [SECONDS]      (scenes/free_vessel.yaml fits) */
#include <fram/fram.h>
#include <stdio.h>
#include <stdlib.h>

enum { AXES = 3 };

/* Force [N] that pulls the vessel back to where it started; stiffness and damping by its mass [1/s2, 1/s]. */
static void station_keeping(const fram_body_state *now, const double start[AXES], double force[AXES])
{
    const double stiffness = 0.01, damping = 0.15;
    for (int i = 0; i < AXES; i++)
        force[i] = -now->mass * (stiffness * (now->position[i] - start[i]) + damping * now->velocity[i]);
    force[2] = 0; /* heave is the water's business */
}

static int fail(const fram_error *error)
{
    fprintf(stderr, "%s:%d: %s: %s\n", error->file, error->line, error->key, error->message);
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    if (argc < 2)
        return fprintf(stderr, "usage: controller SCENARIO [SECONDS]\n"), EXIT_FAILURE;
    double seconds = argc > 2 ? strtod(argv[2], NULL) : 10;
    fram_context *context = NULL;
    fram_scenario *scenario = NULL;
    fram_world *world = NULL;
    fram_error error;
    fram_body_id vessel;
    fram_body_state now;
    if (fram_context_create(NULL, &context, &error) ||
        fram_scenario_load(context, argv[1], NULL, 0, &scenario, &error) || fram_world_create(scenario, &world, &error))
        return fail(&error);
    if (!fram_world_vessel(world, &vessel))
        return fprintf(stderr, "the scenario has no vessel\n"), EXIT_FAILURE;
    if (fram_body_state_get(world, vessel, &now, &error))
        return fail(&error);
    const double start[AXES] = {now.position[0], now.position[1], now.position[2]}, no_moment[AXES] = {0};

    printf("time[s],x[m],y[m],ice_force_x[N],ice_force_y[N]\n");
    while (fram_world_time(world) < seconds) {
        double force[AXES];
        fram_ice_load ice;
        station_keeping(&now, start, force);
        if (fram_body_apply_wrench(world, vessel, force, no_moment, &error) || fram_world_step(world, &error) ||
            fram_body_state_get(world, vessel, &now, &error) || fram_world_ice_load(world, vessel, &ice, &error))
            return fail(&error);
        printf("%g,%g,%g,%g,%g\n", fram_world_time(world), now.position[0], now.position[1], ice.force[0],
               ice.force[1]);
    }
    fram_world_destroy(world);
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return EXIT_SUCCESS;
}
