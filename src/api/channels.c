/* Channels and inputs of a world, by number and by name. */
#include "api/arguments.h"
#include "api/handles.h"

#include "fram/live.h"
#include "model/mechanism.h"

#include <math.h>
#include <string.h>

/* ---- what channels mean ---- */

#define MECHANISM_MEANING(id, name, text) {"mechanism_" name, "part of the load of the ice: " text},

/* Names that begin so, the longer ones first (docs/channels.md tells more). */
static const struct {
    const char *stem, *meaning;
} meanings[] = {
    {"time", "end of the last step"},
    {"position", "the vessel's centre of mass, global frame"},
    {"roll", "attitude: turned by yaw, then pitch, then roll"},
    {"pitch", "attitude: turned by yaw, then pitch, then roll"},
    {"yaw", "attitude: turned by yaw, then pitch, then roll"},
    {"velocity", "of the vessel's centre of mass, global frame"},
    {"angular_velocity", "of the vessel, about global axes"},
    {"ice_force_body", "load of the ice, mean over the step, axes of the vessel"},
    {"ice_moment_body", "load of the ice about the centre of mass, axes of the vessel"},
    {"ice_force_averaged", "load of the ice, mean over the averaging window, global frame"},
    {"ice_moment_averaged", "load of the ice, mean over the averaging window, global frame"},
    {"ice_force_capped", "normal part of contacts at their crushing limit"},
    {"ice_force_below_cap", "normal part of contacts under their crushing limit"},
    {"ice_force_friction", "friction part of the load of the ice"},
    {"ice_force_bow", "load of the ice on the bow"},
    {"ice_force_shoulder", "load of the ice on the shoulders"},
    {"ice_force_midbody", "load of the ice on the midbody"},
    {"ice_force_stern", "load of the ice on the stern"},
    {"ice_force_bottom", "load of the ice on the bottom"},
    {"ice_force", "load of the ice on the vessel, mean over the step, global frame"},
    {"ice_moment", "load of the ice about the centre of mass, mean over the step, global frame"},
    {"hull_contact_force", "what other hulls and walls do to the vessel"},
    {"hull_contact_moment", "what other hulls and walls do to the vessel, about the centre of mass"},
    {"tow_force", "what the towing carriage does to the vessel"},
    {"tow_moment", "what the towing carriage does to the vessel, about the centre of mass"},
    {"fluid_force", "pressure of the water, drag of water and wind"},
    {"fluid_moment", "pressure of the water, drag of water and wind, about the centre of mass"},
    {"hydrodynamic_force", "added mass and damping"},
    {"mooring_force", "all mooring lines on the vessel"},
    {"mooring_moment", "all mooring lines on the vessel, about the centre of mass"},
    {"thruster_force", "all thrusters on the vessel"},
    {"thruster_moment", "all thrusters on the vessel, about the centre of mass"},
    {"thruster_power", "power drawn by all thrusters"},
    {"offset", "of the watched point from where it shall be, at the end of the step"},
    {"heading_deviation", "of the heading from the one that is wanted, at the end of the step"},
    ICE_MECHANISMS(MECHANISM_MEANING) /* forces, and moments about the centre of mass */
    {"thrusters_failed", "number of thrusters that have failed"},
    {"thrusters_saturated", "1 while the demand cannot be met"},
    {"thruster", "thrust and direction of each"},
    {"line_tension_max", "highest tension of a line"},
    {"lines_parted", "lines that have parted or were let go"},
    {"line", "tension of each"},
    {"estimated_load", "force (x, y) and yaw moment (z) that the observer believes in, global frame"},
    {"estimated", "what the observer believes"},
    {"demanded_force", "force (x, y) and yaw moment (z) that the controller demands, axes of the vessel"},
    {"net_thrust", "of a ship under its own power"},
    {"steering_angle", "of a ship under its own power"},
    {"besets", "number of times that the ship was beset"},
    {"rams", "number of rams"},
    {"pattern_rounds", "rounds of its pattern that the ship has done"},
    {"track_error", "how far the ship is to port of its track"},
    {"wash_force", "force of the vessel's propeller jets on all floes"},
    {"bodies", "number at the end of the step"},
    {"floes", "number at the end of the step"},
    {"contacts", "contact points of all bodies"},
    {"vessel_contacts", "contact points of ice on the vessel"},
    {"crushing_patches", "patches of crushing of all bodies"},
    {"ice_mass_left", "mass that has left through an open boundary"},
    {"ice_mass_entered", "feeding, and sheets that drift: mass that has entered"},
    {"ice_mass_held_back", "feeding: mass that did not enter for want of room"},
    {"ice_mass_lost", "mass of outlines changed by breaking and cleaning"},
    {"ice_mass_gained", "mass of outlines changed by breaking and cleaning"},
    {"ice_mass_crushed", "mass cut away where a hull has been"},
    {"brash_mass", "of pieces too small to be floes"},
    {"brash_momentum", "of pieces too small to be floes"},
    {"drift", "velocity of the ice field or the sheet"},
    {"sheet_load", "load of contacts on the drifting sheet"},
    {"sheet_drive", "driving force of the far field on the sheet"},
    {"splits", "floes that have split so far"},
    {"bendings", "floes that have broken in bending so far"},
    {"crushing_work", "energy dissipated in crushing so far"},
    {"solver_residual", "largest residual of a contact's normal condition after the last iteration"},
    {"solver_iterations", "sweeps over all contacts that the velocities of the step took"},
    {"overlap_mean", "of the contacts that overlap, crushed ice included"},
    {"overlap_max", "of the contacts that overlap, crushed ice included"},
    {"kinetic_energy", "of all bodies that move freely, and of towed vessels"},
    {"step_wall_time", "wall-clock time that the step took"},
};

const char *channel_meaning(const char *channel)
{
    const char *point = strchr(channel, '.'), *name = point ? point + 1 : channel; /* of a named vessel */
    for (size_t i = 0; i < sizeof meanings / sizeof *meanings; i++) {
        size_t length = strlen(meanings[i].stem);
        if (strncmp(name, meanings[i].stem, length) == 0 && (name[length] == '\0' || name[length] == '_'))
            return meanings[i].meaning;
    }
    return "";
}

/* ---- channels ---- */

const double *world_row(const fram_world *w)
{
    if (!w->aside->row_is_new)
        series_row(&w->scenario->context->inner, &w->base->columns, &w->inner, w->step_wall, w->row);
    w->aside->row_is_new = true;
    return w->row;
}

static fram_status refuse_index(int index, int count, fram_error *error)
{
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "index", "expected 0 to %d, found %d", count - 1, index);
}

int fram_world_channels(const fram_world *w) { return w ? w->base->columns.columns.count : 0; }

fram_status(fram_world_channel)(const fram_world *w, int index, fram_channel *channel, fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"channel", channel});
    if (status == FRAM_OK)
        status = RESULT_CHECK(channel, size, fram_channel, error);
    if (status != FRAM_OK)
        return status;
    if (index < 0 || index >= w->base->columns.columns.count)
        return refuse_index(index, w->base->columns.columns.count, error);
    const csv_column *column = &w->base->columns.columns.data[index];
    const fram_channel found = {index, column->name, column->unit, channel_meaning(column->name)};
    result_give(channel, size, &found);
    return FRAM_OK;
}

int fram_world_find_channel(const fram_world *w, const char *name)
{
    for (int i = 0; w && name && i < w->base->columns.columns.count; i++) {
        if (strcmp(w->base->columns.columns.data[i].name, name) == 0)
            return i;
    }
    return -1;
}

double fram_world_value(const fram_world *w, int index)
{
    bool there = world_can_be_read(w) && index >= 0 && index < w->base->columns.columns.count;
    return there ? world_row(w)[index] : (double)NAN;
}

int fram_world_values(const fram_world *w, double *values, int room)
{
    if (!world_can_be_read(w))
        return 0;
    int count = w->base->columns.columns.count, copied = room < count ? room : count;
    if (values && copied > 0)
        memcpy(values, world_row(w), (size_t)copied * sizeof *values);
    return count;
}

/* ---- inputs ---- */

int fram_world_inputs(const fram_world *w) { return w ? w->base->controls.count : 0; }

fram_status(fram_world_input)(const fram_world *w, int index, fram_channel *input, fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"world", w}, {"input", input});
    if (status == FRAM_OK)
        status = RESULT_CHECK(input, size, fram_channel, error);
    if (status != FRAM_OK)
        return status;
    if (index < 0 || index >= w->base->controls.count)
        return refuse_index(index, w->base->controls.count, error);
    const control *c = &w->base->controls.data[index];
    const fram_channel found = {index, c->name, c->unit, c->meaning};
    result_give(input, size, &found);
    return FRAM_OK;
}

int fram_world_find_input(const fram_world *w, const char *name)
{
    for (int i = 0; w && name && i < w->base->controls.count; i++) {
        if (strcmp(w->base->controls.data[i].name, name) == 0)
            return i;
    }
    return -1;
}

double fram_world_input_value(const fram_world *w, int index)
{
    if (!world_can_be_read(w) || index < 0 || index >= w->base->controls.count)
        return (double)NAN;
    return control_get(&w->base->model, &w->inner, &w->base->controls.data[index]);
}

fram_status fram_world_set_input(fram_world *w, int index, double value, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w});
    if (status == FRAM_OK)
        status = world_enter(w, error);
    if (status != FRAM_OK)
        return status;
    if (index < 0 || index >= w->base->controls.count) {
        status = refuse_index(index, w->base->controls.count, error);
    } else {
        world_changed(w);
        status = control_set(&w->scenario->context->inner, &w->base->model, &w->inner, &w->base->controls.data[index],
                             value, error);
    }
    world_leave(w);
    return status;
}

/* Rows of a path that are taken at a time in one call, and beyond which nobody has one. */
enum { PATH_MOST = 1000000 };

static fram_status set_path(fram_world *w, int vessel, const double *times, const double *places, int count,
                            fram_error *error)
{
    if (vessel < 0 || vessel >= w->inner.vessels.count)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "vessel",
                         "expected one of %d vessels, counted from 0; found %d", (int)w->inner.vessels.count, vessel);
    if (count < 0 || count > PATH_MOST)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "count", "expected 0 to %d, found %d", (int)PATH_MOST,
                         count);
    context *ctx = &w->scenario->context->inner;
    vec3 *list = memory_array(ctx, (size_t)count + 1, sizeof *list);
    if (!list)
        return error_memory(error);
    for (int i = 0; i < count; i++)
        list[i] = vec3_make(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    world_changed(w);
    fram_status status = control_path(ctx, &w->base->model, &w->inner, vessel, times, list, count, error);
    memory_free(ctx, list);
    return status;
}

fram_status fram_world_set_path(fram_world *w, int vessel, const double *times, const double *places, int count,
                                fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"world", w});
    if (status == FRAM_OK && count != 0)
        status = REFUSE_NULL(error, {"times", times}, {"places", places});
    if (status == FRAM_OK)
        status = world_enter(w, error);
    if (status != FRAM_OK)
        return status;
    status = set_path(w, vessel, times, places, count, error);
    world_leave(w);
    return status;
}
