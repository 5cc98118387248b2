#include "sim/usual.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Thickness of floes and sheets of full size [m]. */
#define THICKNESS_LEAST 0.02
#define THICKNESS_MOST 6

/* Sea ice: Timco and Weeks (2010), Cold Regions Science and Technology 60: flexural strength 0.1 to 1.8 MPa, fresh ice
   up to 3, modulus 1 to 10 GPa; Timco and Frederking (1996): density 720 to 940 kg/m3; Dempsey, Adamson and Mulmule
   (1999): toughness 0.05 to 0.3 MPa m^0.5; friction: Sukhorukov and Loset (2013), 0.02 to 1. */
static const usual_value usual_values[] = {
    {"ice.thickness", THICKNESS_LEAST, THICKNESS_MOST, 1, "what floes and sheets measure", "give metres"},
    {"ice.populations[].thickness", THICKNESS_LEAST, THICKNESS_MOST, 1, "what floes measure", "give metres"},
    {"ice.floes[].thickness", THICKNESS_LEAST, THICKNESS_MOST, 1, "what floes measure", "give metres"},
    {"ice.flexural_strength", 3e4, 4e6, 1, "what was measured on ice", "give pascal, not kPa or MPa"},
    {"ice.populations[].flexural_strength", 3e4, 4e6, 1, "what was measured on ice", "give pascal, not kPa or MPa"},
    {"ice.elastic_modulus", 1e8, 1.5e10, 1, "what was measured on ice", "give pascal, not GPa"},
    {"ice.crushing_strength", 5e4, 5e7, 1, "what was measured on ice", "give pascal, not kPa or MPa"},
    {"ice.populations[].crushing_strength", 5e4, 5e7, 1, "what was measured on ice", "give pascal, not kPa or MPa"},
    {"ice.fracture.toughness", 1e4, 1e6, 1.5, "what was measured on ice", "give Pa m^0.5, not kPa m^0.5"},
    {"ice.fracture.latent_heat", 2e4, 2e7, 1, "what ice takes to melt", "give J/kg, not kJ/kg"},
    {"ice.density", 650, 960, 0, "what was measured on ice", "give kg/m3"},
    {"ice.friction.ice_ice_static", 0, 1.5, 0, "what was measured", "it is a coefficient, not an angle"},
    {"ice.friction.ice_ice_kinetic", 0, 1.5, 0, "what was measured", "it is a coefficient, not an angle"},
    {"ice.friction.ice_hull_static", 0, 1, 0, "what was measured", "it is a coefficient, not an angle"},
    {"ice.friction.ice_hull_kinetic", 0, 1, 0, "what was measured", "it is a coefficient, not an angle"},
    {"ice.friction.ice_wall_static", 0, 1.5, 0, "what was measured", "it is a coefficient, not an angle"},
    {"ice.friction.ice_wall_kinetic", 0, 1.5, 0, "what was measured", "it is a coefficient, not an angle"},
    {"ice.poisson_ratio", 0.2, 0.45, 0, "what was measured on ice", "about 0.3"},
    {"ice.crushing_exponent", -0.8, 0, 0, "what was measured", "the pressure falls with the area"},
    {"ice.ridging_resistance", 0.1, 20, 0, "what was measured of ridges", "R is 2 to 10"},
    {"ice.strength.flexural_variation", 0, 1, 0, "what was measured on ice", "give a part of the mean, not per cent"},
    {"ice.strength.crushing_variation", 0, 1, 0, "what was measured on ice", "give a part of the mean, not per cent"},
    {"ice.level.line_load", 1e3, 1e7, 2, "what drifting ice drives with", "give N/m, not kN/m or MN/m"},
    {"ice.floes[].velocity_x", -5, 5, 0.5, "what floes move with", "give m/s"},
    {"ice.floes[].velocity_y", -5, 5, 0.5, "what floes move with", "give m/s"},
    {"ice.floes[].velocity_z", -5, 5, 0.5, "what floes move with", "give m/s"},
    {"ice.floes[].spin", -1, 1, -0.5, "what floes turn with", "give rad/s, not deg/s"},
    {"run.solver.contact_skin", 0, 0.01, 1, "what lets packed ice rest", "give metres"},
    {"run.solver.tolerance", 0, 0.01, 0.5, "what residuals are worth", "give m/s"},
    {"run.scale", 0.5, 200, 0, "what ice is tested at", "give lambda, 30 for full size, 1 for the size of a tank"},
    {"environment.water_density", 980, 1100, 0, "fresh water to brine", "give kg/m3"},
    {"output.record_limit", 0.1, 1e6, 0, "what disks hold", "give MB"},
    {"environment.air_density", 1, 1.7, 0, "air at sea level", "give kg/m3"},
    {"environment.gravity", 9.7, 9.9, 0, "that of the Earth", "give m/s2"},
    {"environment.wind_speed", 0, 50, 0.5, "a hurricane", "give m/s, a knot is 0.514 of it"},
    {"environment.current_speed", 0, 4, 0.5, "a strong tidal stream", "give m/s, not cm/s"},
    {"domain.drift_speed", 0, 3, 0.5, "fast drift", "give m/s, not km/h or cm/s"},
    {"vessel.speed", 0, 12, 0.5, "what ships do in ice", "give m/s, a knot is 0.514 of it"},
    {"environment.floe_damping", 0, 2, 0, "what floats", "give a part of the critical damping"},
    {"environment.ice_drag.water_form", 0, 3, 0, "what was measured", "it is a coefficient"},
    {"environment.ice_drag.water_skin", 0, 0.1, 0, "what was measured", "it is a coefficient"},
    {"environment.ice_drag.air_form", 0, 3, 0, "what was measured", "it is a coefficient"},
    {"environment.ice_drag.air_skin", 0, 0.1, 0, "what was measured", "it is a coefficient"},
    {"environment.hull_drag.water_form", 0, 3, 0, "what was measured", "it is a coefficient"},
    {"environment.hull_drag.water_skin", 0, 0.1, 0, "what was measured", "it is a coefficient"},
    {"environment.hull_drag.air_form", 0, 3, 0, "what was measured", "it is a coefficient"},
    {"environment.hull_drag.air_skin", 0, 0.1, 0, "what was measured", "it is a coefficient"},
    {"vessel.hull.length", 4, USUAL_LENGTH_MOST, 1, "what ships and structures measure", "give metres"},
    {"vessel.mooring.lines[].weight", 5, 2e4, 2, "chain and wire in water", "give N/m, not kg/m or kN/m"},
    {"vessel.mooring.lines[].pretension", 2e3, USUAL_PULL_MOST, 3, "what lines are set to",
     "give newtons, not kN or tonnes"},
    {"vessel.mooring.lines[].breaking_load", 5e4, 1e8, 3, "what lines carry", "give newtons, not kN or tonnes"},
    {"vessel.hull.freeboard", 0.2, 60, 1, "what ships have", "give metres"},
    {"vessel.hydrodynamics.heave_damping", 0, 2, 0, "what ships have", "give a part of the critical damping"},
    {"vessel.hydrodynamics.roll_damping", 0, 1, 0, "what ships have", "give a part of the critical damping"},
    {"vessel.hydrodynamics.pitch_damping", 0, 2, 0, "what ships have", "give a part of the critical damping"},
    {"vessel.positioning.noise_position", 0, 5, 1, "what position references have", "give metres"},
    {"vessel.positioning.noise_heading_deg", 0, 3, 0, "what gyrocompasses have", "give degrees"},
    {"vessel.positioning.frequency", 0.005, 0.6, -0.5, "what ships are controlled with", "give rad/s"},
    {"vessel.positioning.damping", 0.2, 3, 0, "what controllers have", "give a part of the critical damping"},
    {"vessel.positioning.observer_bandwidth", 0.01, 3, -0.5, "what observers have", "give rad/s"},
    {"vessel.positioning.bias_time", 10, 1e5, 0.5, "what observers have", "give seconds"},
    {"vessel.positioning.reference_speed", 0.01, 6, 0.5, "what ships are moved with on station", "give m/s"},
    {"vessel.station.offset_limit", 0.05, 500, 1, "what is required of a station", "give metres"},
    {"vessel.station.heading_limit_deg", 1, 180, 0, "what is required of a station", "give degrees, not radians"},
    {"vessel.wash.reach", 1, 200, 0, "how far jets are felt", "give diameters of the propeller"},
    {"vessel.fender_stiffness", 1e4, 1e11, 2, "what fenders have", "give N/m, not kN/m"},
    {"vessel.propulsion.bollard_pull", 1e4, 2e7, 3, "what ships pull", "give newtons, not kN or tonnes"},
    {"vessel.propulsion.open_water_speed", 1, 13, 0.5, "what ships make", "give m/s, a knot is 0.514 of it"},
    {"vessel.propulsion.speed", 0, 13, 0.5, "what ships make", "give m/s, a knot is 0.514 of it"},
    {"vessel.propulsion.steering_angle_deg", 3, 90, 0, "what rudders and pods do", "give degrees, not radians"},
    {"vessel.propulsion.steering_rate_deg", 0.3, 60, -0.5, "what rudders and pods do", "give deg/s, not rad/s"},
    {"vessel.thrusters[].time_constant", 0, 60, 0.5, "what shafts take", "give seconds"},
    {"vessel.thrusters[].turn_rate_deg", 0.3, 90, -0.5, "what azimuths and rudders do", "give deg/s, not rad/s"},
    {"vessel.thrusters[].speed_rate", 2e-3, 10, -0.5, "what shafts do", "give a part of the largest speed in 1/s"},
    {"vessel.thrusters[].thrust", 2e3, 1e7, 3, "what a propeller gives", "give newtons, not kN or tonnes"},
};

const usual_value *usual_value_of(const char *key)
{
    for (size_t i = 0; i < sizeof usual_values / sizeof *usual_values; i++)
        if (strcmp(usual_values[i].key, key) == 0)
            return &usual_values[i];
    return NULL;
}

/* By which part a bound is known that goes with the scale: one that would be 0.005 is 0.005000000000000001. */
#define SCALE_ROUNDED 1e-9

usual_range usual_range_at_scale(const scenario *s, double least, double most, double power)
{
    double factor = usual_at_scale(s, power), high = most * fmax(1, factor) * (1 + SCALE_ROUNDED);
    double low = least * fmin(1, factor) - SCALE_ROUNDED * fabs(least);
    return (usual_range){least == -most ? -high : low, high};
}

usual_range usual_range_of(const scenario *s, const char *key)
{
    const usual_value *u = usual_value_of(key);
    assert(u);
    return usual_range_at_scale(s, u->least, u->most, u->power);
}
