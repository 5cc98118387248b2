/* Breaking ice of the public API. */
#include "fram/ice.h"

#include "api/arguments.h"
#include "base/transcendental.h"
#include "ice/fracture.h"
#include "ice/sheet.h"
#include "ice/wedge.h"
#include "model/scenario_schema.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static fram_status need(bool good, const char *key, const char *range, double found, fram_error *error)
{
    return good ? FRAM_OK : error_value(error, key, range, found);
}

static fram_status need_load_length(double a_over_l, fram_error *error)
{
    return need(a_over_l >= WEDGE_LEAST_LOAD && a_over_l <= WEDGE_MOST_LOAD, "a_over_l", "a number from 0.001 to 3",
                a_over_l, error);
}

static fram_status need_ratio(double poisson_ratio, fram_error *error)
{
    return need(poisson_ratio >= 0 && poisson_ratio <= 0.5, "poisson_ratio", "a number from 0 to 0.5", poisson_ratio,
                error);
}

fram_status(fram_ice_wedge)(double a_over_l, fram_ice_wedge_result *result, fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"result", result});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_ice_wedge_result, error);
    if (status == FRAM_OK)
        status = need_load_length(a_over_l, error);
    if (status != FRAM_OK)
        return status;
    wedge w = wedge_solve(a_over_l);
    const fram_ice_wedge_result full = {w.capacity, w.x_max, w.tip_deflection};
    result_give(result, size, &full);
    return FRAM_OK;
}

fram_status(fram_ice_sheet)(double a_over_l, double poisson_ratio, fram_ice_sheet_result *result, fram_error *error,
                            size_t size)
{
    fram_status status = REFUSE_NULL(error, {"result", result});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_ice_sheet_result, error);
    if (status == FRAM_OK)
        status = need_load_length(a_over_l, error);
    if (status == FRAM_OK)
        status = need_ratio(poisson_ratio, error);
    if (status != FRAM_OK)
        return status;
    const fram_ice_sheet_result full = {sheet_stress(a_over_l, poisson_ratio),
                                        sheet_stress_integral(a_over_l, poisson_ratio),
                                        sheet_stress_closed_form(a_over_l, poisson_ratio)};
    result_give(result, size, &full);
    return FRAM_OK;
}

/* Ice and water of a scenario that says nothing of them. */
static void fram_ice_edge_fill(fram_ice_edge *load)
{
    scenario usual;
    scenario_defaults(&usual, scenario_default_scale());
    *load = (fram_ice_edge){.size = sizeof *load,
                            .thickness = usual.ice.thickness,
                            .elastic_modulus = usual.ice.elastic_modulus,
                            .poisson_ratio = usual.ice.poisson_ratio,
                            .flexural_strength = usual.ice.flexural_strength,
                            .crushing_strength = usual.ice.crushing_strength,
                            .water_density = usual.environment.water_density,
                            .gravity = usual.environment.gravity,
                            .wedges = (int)usual.ice.fracture.wedges,
                            .thick_plate_radius = usual.ice.fracture.thick_plate_radius,
                            .included_angle = PI,
                            .ice_density = usual.ice.density};
}
DEFINITION_DEFAULT(fram_ice_edge, fram_ice_edge)

/* As a scenario's key has it. */
static fram_status need_thickness(double thickness, fram_error *error)
{
    const scenario_key *key = scenario_key_find("ice", "thickness");
    char range[48];
    snprintf(range, sizeof range, "%g to %g m", key->lo, key->hi);
    return need(thickness >= key->lo && thickness <= key->hi, "thickness", range, thickness, error);
}

/* Of the two densities the one that was given is named; the other one may be the usual one.  That of the ice counts by
   its inertia alone. */
static fram_status check_densities(const fram_ice_edge *l, fram_error *error)
{
    fram_ice_edge usual;
    char range[64];
    if (l->rise_time == 0 || l->ice_density < l->water_density)
        return FRAM_OK;
    fram_ice_edge_fill(&usual);
    bool of_water = l->ice_density == usual.ice_density;
    snprintf(range, sizeof range,
             of_water ? "more than the density of the ice, %g" : "less than the density of the water, %g",
             of_water ? l->ice_density : l->water_density);
    return error_value(error, of_water ? "water_density" : "ice_density", range,
                       of_water ? l->water_density : l->ice_density);
}

static fram_status check_load(const fram_ice_edge *l, fram_error *error)
{
    const struct {
        const char *key;
        double value;
        bool positive;
    } row[] = {{"force", l->force, false},
               {"contact_area", l->contact_area, false},
               {"thickness", l->thickness, true},
               {"elastic_modulus", l->elastic_modulus, true},
               {"flexural_strength", l->flexural_strength, true},
               {"crushing_strength", l->crushing_strength, true},
               {"water_density", l->water_density, true},
               {"gravity", l->gravity, true},
               {"included_angle", l->included_angle, true},
               {"contact_width", l->contact_width, false},
               {"ice_length", l->ice_length, false},
               {"rise_time", l->rise_time, false},
               {"ice_density", l->ice_density, true}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        bool good = (row[i].positive ? row[i].value > 0 : row[i].value >= 0) && isfinite(row[i].value);
        fram_status status =
            need(good, row[i].key, row[i].positive ? "a positive number" : "a number not below 0", row[i].value, error);
        if (status != FRAM_OK)
            return status;
    }
    fram_status status = need_ratio(l->poisson_ratio, error);
    if (status == FRAM_OK)
        status = need(l->included_angle <= radians(360), "included_angle", "at most 2 pi radians (360 degrees)",
                      l->included_angle, error);
    if (status == FRAM_OK)
        status = need_thickness(l->thickness, error);
    if (status == FRAM_OK)
        status = check_densities(l, error);
    return status == FRAM_OK ? need(l->wedges >= 2 && l->wedges <= 32, "wedges", "2 to 32", l->wedges, error) : status;
}

/* Theory, and its tables, end where the load is as wide as some characteristic lengths. */
static fram_status check_area(const fram_ice_edge *l, const edge_stress *e, fram_error *error)
{
    char range[96];
    double h = l->thickness, radius = fracture_loaded_radius(l->contact_area, PI / 2, h, l->thick_plate_radius);
    snprintf(range, sizeof range, "an area whose half disc is no larger than %g characteristic lengths, %.4g m",
             WEDGE_MOST_LOAD, WEDGE_MOST_LOAD * e->length);
    return need(fmax(radius, e->wedge_radius) <= WEDGE_MOST_LOAD * e->length, "contact_area", range, l->contact_area,
                error);
}

/* The half disc that stands for a wide contact in the radial crack's stress may go beyond the table too.  Next to
   nothing of that stress is left there: the sheet bends as a beam, whose strip breaks first. */
static void drop_radial_crack(edge_stress *e)
{
    if (e->radial_radius <= WEDGE_MOST_LOAD * e->length)
        return;
    e->radial_stress = 0;
    e->radial_capacity = HUGE_VAL;
}

fram_status(fram_ice_break)(const fram_ice_edge *given, fram_ice_breaking *breaking, fram_error *error, size_t size)
{
    fram_ice_edge taken, *load = &taken;
    fram_ice_edge_fill(load);
    fram_status status = REFUSE_NULL(error, {"breaking", breaking});
    if (status == FRAM_OK)
        status = RESULT_CHECK(breaking, size, fram_ice_breaking, error);
    if (status == FRAM_OK)
        status = definition_take(load, given, sizeof *load, DEFINITION_LEAST, "fram_ice_edge", error);
    if (status != FRAM_OK)
        return status;
    status = check_load(load, error);
    if (status != FRAM_OK)
        return status;
    ice_material m = {.density = load->ice_density,
                      .elastic_modulus = load->elastic_modulus,
                      .poisson_ratio = load->poisson_ratio,
                      .flexural_strength = load->flexural_strength,
                      .crushing_strength = load->crushing_strength};
    fracture_settings s = {.water_density = load->water_density,
                           .gravity = load->gravity,
                           .wedges = load->wedges,
                           .thick_plate_radius = load->thick_plate_radius,
                           .edges_give = true,
                           .edge_inertia = true};
    edge_ice edge = {.wedges = load->included_angle / PI,
                     .strip = load->contact_width,
                     .length = load->ice_length > 0 ? load->ice_length : HUGE_VAL,
                     .rise = load->rise_time > 0 ? load->rise_time : HUGE_VAL};
    edge_stress e = fracture_edge_stress(&s, &m, load->thickness, load->force, load->contact_area, edge);
    status = check_area(load, &e, error);
    if (status != FRAM_OK)
        return status;
    drop_radial_crack(&e);
    const fram_ice_breaking full = {.characteristic_length = e.length,
                                    .radial_radius = e.radial_radius,
                                    .wedge_radius = e.wedge_radius,
                                    .radial_stress = e.radial_stress,
                                    .wedge_stress = e.wedge_stress,
                                    .radial_capacity = e.radial_capacity,
                                    .wedge_capacity = e.wedge_capacity,
                                    .breaking_radius = e.breaking_radius,
                                    .crushing_force = load->contact_area * load->crushing_strength,
                                    .strip_capacity = e.strip_capacity,
                                    .strip_length = e.strip_length};
    result_give(breaking, size, &full);
    return FRAM_OK;
}

static void fram_ice_floe_fill(fram_ice_floe *floe)
{
    scenario usual;
    scenario_defaults(&usual, scenario_default_scale());
    *floe = (fram_ice_floe){.size = sizeof *floe,
                            .thickness = usual.ice.thickness,
                            .toughness = usual.ice.fracture.toughness,
                            .length = 50,
                            .width = 50};
}
DEFINITION_DEFAULT(fram_ice_floe, fram_ice_floe)

static fram_status check_floe(const fram_ice_floe *f, fram_error *error)
{
    const struct {
        const char *key;
        double value;
    } row[] = {{"thickness", f->thickness}, {"toughness", f->toughness}, {"length", f->length}, {"width", f->width}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        bool good = row[i].value > 0 && isfinite(row[i].value);
        fram_status status = need(good, row[i].key, "a positive number", row[i].value, error);
        if (status != FRAM_OK)
            return status;
    }
    return need(fabs(f->place) < f->width / 2, "place", "less than half the width to either side of the middle",
                f->place, error);
}

fram_status(fram_ice_split)(const fram_ice_floe *given, fram_ice_splitting *splitting, fram_error *error, size_t size)
{
    fram_ice_floe taken, *floe = &taken;
    fram_ice_floe_fill(floe);
    fram_status status = REFUSE_NULL(error, {"splitting", splitting});
    if (status == FRAM_OK)
        status = RESULT_CHECK(splitting, size, fram_ice_splitting, error);
    if (status == FRAM_OK)
        status = definition_take(floe, given, sizeof *floe, DEFINITION_LEAST, "fram_ice_floe", error);
    if (status == FRAM_OK)
        status = check_floe(floe, error);
    if (status != FRAM_OK)
        return status;
    double far = floe->width / 2 + fabs(floe->place), near = floe->width - far;
    double slender = fmax(floe->length / near, fmax(far / floe->length, near / floe->length));
    const fram_ice_splitting full = {
        .smaller_side = near,
        .larger_side = far,
        .factor = fracture_splitting_factor(floe->length, near, far),
        .splitting_load = fracture_splitting_force(floe->thickness, floe->toughness, floe->length, near, far),
        .slenderness = slender,
    };
    result_give(splitting, size, &full);
    return FRAM_OK;
}
