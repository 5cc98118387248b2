/* A field at rest: how far floes move in a time without wind, current and vessel, and what energy they find.

       rest_bench SCENARIO [KEY=VALUE ...] */
#include "fram/fram.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const fram_error *error)
{
    fprintf(stderr, "rest_bench: %s: %s\n", error->key, error->message);
    return EXIT_FAILURE;
}

/* State of every floe by its slot; the others have no mass. */
static int read_states(const fram_world *w, fram_body_state *state, int room)
{
    int floes = 0;
    fram_error error;
    for (int i = 0; i < fram_world_slots(w) && i < room; i++) {
        fram_body_id id;
        state[i].mass = 0;
        if (!fram_world_body(w, i, &id) || fram_body_state_get(w, id, &state[i], &error) != FRAM_OK ||
            state[i].kind != FRAM_BODY_FLOE || !state[i].dynamic)
            state[i].mass = 0;
        floes += state[i].mass > 0;
    }
    return floes;
}

static double length(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Largest way and speed, and the energy of moving without turning [J]. */
static void compare(const fram_body_state *then, const fram_body_state *now, int slots, double *way, double *speed,
                    double *energy)
{
    *way = *speed = *energy = 0;
    for (int i = 0; i < slots; i++) {
        if (!(then[i].mass > 0))
            continue;
        double d[3];
        for (int k = 0; k < 3; k++)
            d[k] = now[i].position[k] - then[i].position[k];
        double v = length(now[i].velocity);
        *way = fmax(*way, length(d));
        *speed = fmax(*speed, v);
        *energy += 0.5 * now[i].mass * v * v;
    }
}

static fram_status run(fram_world *w, double duration, fram_error *error)
{
    int slots = fram_world_slots(w);
    fram_body_state *then = calloc((size_t)slots, sizeof *then), *now = calloc((size_t)slots, sizeof *now);
    if (!then || !now) {
        free(then);
        free(now);
        return FRAM_ERROR_MEMORY;
    }
    fram_status status = FRAM_OK;
    int floes = read_states(w, then, slots);
    double most_energy = 0, way = 0, speed = 0, energy = 0;
    for (long step = 1; status == FRAM_OK && fram_world_time(w) < duration - 1e-9; step++) {
        status = fram_world_step(w, error);
        if (step > 100 && step % 500 != 0)
            continue;
        read_states(w, now, slots);
        compare(then, now, slots, &way, &speed, &energy);
        most_energy = fmax(most_energy, energy);
    }
    read_states(w, now, slots);
    compare(then, now, slots, &way, &speed, &energy);
    if (status == FRAM_OK)
        printf(
            "%d floes, %.0f s at rest: moved by at most %.3g m, at %.2g m/s in the end; energy at most %.2g J, in the "
            "end %.2g J\n",
            floes, fram_world_time(w), way, speed, most_energy, energy);
    free(then);
    free(now);
    return status;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "rest_bench SCENARIO [KEY=VALUE ...]\n");
        return EXIT_FAILURE;
    }
    fram_context_definition d;
    fram_context *context = NULL;
    fram_scenario *scenario = NULL;
    fram_world *world = NULL;
    fram_error error = {0};
    fram_context_default(&d);
    fram_status status = fram_context_create(&d, &context, &error);
    if (status == FRAM_OK)
        status = fram_scenario_load(context, argv[1], (const char *const *)(argv + 2), argc - 2, &scenario, &error);
    if (status == FRAM_OK)
        status = fram_world_create(scenario, &world, &error);
    if (status == FRAM_OK)
        status = run(world, fram_scenario_duration(scenario), &error);
    int code = status == FRAM_OK ? EXIT_SUCCESS : fail(&error);
    fram_world_destroy(world);
    fram_scenario_destroy(scenario);
    fram_context_destroy(context);
    return code;
}
