#include "io/key_words.h"

#include <stddef.h>
#include <string.h>

const char *key_other_name(const char *word)
{
    static const char *const words[][2] = {
        {"draft", "draught"},
        {"T", "draught"},
        {"width", "beam"},
        {"breadth", "beam"},
        {"B", "beam"},
        {"loa", "length"},
        {"lpp", "length"},
        {"lwl", "length"},
        {"L", "length"},
        {"displacement", "mass"},
        {"heading", "heading_deg"},
        {"yaw", "heading_deg"},
        {"course", "course_deg"},
        {"velocity", "speed"},
        {"dt", "time_step"},
        {"timestep", "time_step"},
        {"step", "time_step"},
        {"t_end", "duration"},
        {"end_time", "duration"},
        {"cog_x", "centre_of_gravity_x"},
        {"cog_y", "centre_of_gravity_y"},
        {"cog_z", "centre_of_gravity_z"},
        {"vcg", "centre_of_gravity_z"},
        {"lcg", "centre_of_gravity_x"},
        {"kxx", "gyration_roll"},
        {"kyy", "gyration_pitch"},
        {"kzz", "gyration_yaw"},
        {"coverage", "concentration"},
        {"floe_size", "mean_floe_area"},
        {"h", "thickness"},
        {"youngs_modulus", "elastic_modulus"},
        {"E", "elastic_modulus"},
        {"bending_strength", "flexural_strength"},
        {"sigma_f", "flexural_strength"},
        {"sigma_c", "crushing_strength"},
        {"compressive_strength", "crushing_strength"},
        {"fracture_toughness", "toughness"},
        {"drift_direction", "drift_direction_deg"},
        {"wind", "wind_speed"},
        {"current", "current_speed"},
        {"wind_direction", "wind_direction_deg"},
        {"current_direction", "current_direction_deg"},
        {"rho_water", "water_density"},
        {"rho_ice", "density"},
        {"mbl", "breaking_load"},
        {"EA", "stiffness"},
        {"tension", "pretension"},
        {"anchor_distance", "distance"},
        {"weathervaning", "heading"},
        {"propellers", "thrusters"},
        {"dp", "positioning"},
        {"center_of_gravity_x", "centre_of_gravity_x"},
        {"center_of_gravity_y", "centre_of_gravity_y"},
        {"center_of_gravity_z", "centre_of_gravity_z"},
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(word, words[i][0]) == 0)
            return words[i][1];
    return NULL;
}
