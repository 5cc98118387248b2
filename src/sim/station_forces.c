#include "sim/station_forces.h"

#include "sim/ice_loads.h"

#include <string.h>

fram_status station_forces(context *ctx, const model *m, world *w, fram_error *error)
{
    station_table *stations = &w->stations;
    if (stations->count == 0)
        return FRAM_OK;
    double time = w->clock.time[0], dt = m->time_step;
    fram_status status = FRAM_OK;
    size_t size = (size_t)stations->count * sizeof(wrench);
    for (int32_t i = 0; i < stations->count && status == FRAM_OK; i++) {
        if (!station_is_kept(stations, &w->vessels, i))
            continue;
        const int64_t step = w->clock.step[0];
        const station_moment now = {step, step / m->step_parts, time, dt, last_ice_load(w, i)};
        status = station_step(ctx, stations, i, &now, &w->vessels, &w->bodies, &w->waypoints, &w->thrusters, &w->events,
                              error);
    }
    /* Controllers go by the loads of the step before. */
    memset(stations->mooring_load, 0, size);
    memset(stations->thruster_load, 0, size);
    wrench *loads = w->scratch.loads.data;
    if (status == FRAM_OK)
        status = thruster_step(ctx, &w->thrusters, &w->vessels, &w->bodies, time, dt, loads, stations->thruster_load,
                               &w->events, error);
    if (status == FRAM_OK)
        status = mooring_step(ctx, &w->lines, &w->vessels, &w->bodies, time, loads, stations->mooring_load, &w->events,
                              error);
    return status;
}
