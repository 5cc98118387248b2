#include "io/key_words.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Word and key, by the word; of several keys for one word in the order in which they are tried. */
static const char *const other_words[][2] = {
    {"anchor_distance", "distance"},
    {"anchor_radius", "distance"},
    {"anchors", "lines"},
    {"angle", "direction_deg"},
    {"azimuth", "direction_deg"},
    {"azimuths", "thrusters"},
    {"B", "beam"},
    {"bending_strength", "flexural_strength"},
    {"bollard", "bollard_pull"},
    {"boundaries", "boundary"},
    {"bow_angle", "stem_angle_deg"},
    {"breadth", "beam"},
    {"Cb", "block_coefficient"},
    {"cb", "block_coefficient"},
    {"center_of_gravity_x", "centre_of_gravity_x"},
    {"center_of_gravity_y", "centre_of_gravity_y"},
    {"center_of_gravity_z", "centre_of_gravity_z"},
    {"cog_x", "centre_of_gravity_x"},
    {"cog_y", "centre_of_gravity_y"},
    {"cog_z", "centre_of_gravity_z"},
    {"compressive_strength", "crushing_strength"},
    {"course", "course_deg"},
    {"coverage", "concentration"},
    {"current", "current_speed"},
    {"current_dir", "current_direction_deg"},
    {"current_direction", "current_direction_deg"},
    {"current_velocity", "current_speed"},
    {"diameter", "mean_floe_area"},
    {"direction", "direction_deg"},
    {"displacement", "mass"},
    {"dp", "positioning"},
    {"draft", "draught"},
    {"drift", "drift_speed"},
    {"drift_dir", "drift_direction_deg"},
    {"drift_direction", "drift_direction_deg"},
    {"drift_velocity", "drift_speed"},
    {"dt", "time_step"},
    {"E", "elastic_modulus"},
    {"EA", "stiffness"},
    {"end_time", "duration"},
    {"flare_angle", "flare_angle_deg"},
    {"floe_area", "mean_floe_area"},
    {"floe_diameter", "mean_floe_area"},
    {"floe_size", "mean_floe_area"},
    {"fracture_toughness", "toughness"},
    {"friction_coefficient", "ice_hull_kinetic"},
    {"h", "thickness"},
    {"heading", "heading_deg"},
    {"hull_type", "form"},
    {"ice_concentration", "concentration"},
    {"ice_thickness", "thickness"},
    {"KG", "centre_of_gravity_z"},
    {"kg", "centre_of_gravity_z"},
    {"kxx", "gyration_roll"},
    {"kyy", "gyration_pitch"},
    {"kzz", "gyration_yaw"},
    {"L", "length"},
    {"lcg", "centre_of_gravity_x"},
    {"loa", "length"},
    {"lpp", "length"},
    {"lwl", "length"},
    {"max_thrust", "thrust"},
    {"MBL", "breaking_load"},
    {"mbl", "breaking_load"},
    {"mu", "ice_hull_kinetic"},
    {"n", "count"},
    {"nu", "poisson_ratio"},
    {"number", "count"},
    {"number_of_lines", "count"},
    {"poisson", "poisson_ratio"},
    {"pre_tension", "pretension"},
    {"propellers", "thrusters"},
    {"radius", "distance"},
    {"random_seed", "seed"},
    {"rho_ice", "density"},
    {"rho_water", "water_density"},
    {"roll_radius", "gyration_roll"},
    {"sigma_c", "crushing_strength"},
    {"sigma_f", "flexural_strength"},
    {"simulation_time", "duration"},
    {"spacing", "spacing_deg"},
    {"stem_angle", "stem_angle_deg"},
    {"step", "time_step"},
    {"strength", "flexural_strength"},
    {"submerged_weight", "weight"},
    {"T", "draught"},
    {"t_end", "duration"},
    {"tension", "pretension"},
    {"time", "duration"},
    {"timestep", "time_step"},
    {"type", "form"},
    {"type", "kind"},
    {"type", "source"},
    {"type", "mode"},
    {"vcg", "centre_of_gravity_z"},
    {"velocity", "speed"},
    {"water_depth", "depth"},
    {"water_line_length", "length"},
    {"waterline_angle", "entrance_angle_deg"},
    {"weathervaning", "heading"},
    {"width", "beam"},
    {"wind", "wind_speed"},
    {"wind_dir", "wind_direction_deg"},
    {"wind_direction", "wind_direction_deg"},
    {"wind_velocity", "wind_speed"},
    {"yaw", "heading_deg"},
    {"young_modulus", "elastic_modulus"},
    {"youngs_modulus", "elastic_modulus"},
};

const char *key_other_name(const char *word, int32_t nth)
{
    for (size_t i = 0; i < sizeof other_words / sizeof *other_words; i++)
        if (strcmp(word, other_words[i][0]) == 0 && nth-- == 0)
            return other_words[i][1];
    return NULL;
}

bool key_nested(const scenario_section *section, const char *name, char out[KEY_NESTED_SIZE])
{
    char word[KEY_NESTED_SIZE];
    size_t used = 0, depth = 0;
    out[0] = '\0';
    for (const char *point; (point = strchr(name, '.')) != NULL; name = point + 1, depth++) {
        snprintf(word, sizeof word, "%.*s", (int)(point - name), name);
        int32_t k = section_find(section, word);
        if (k < 0 || section->keys[k].kind != KEY_SECTION)
            return false;
        section = section->keys[k].section;
        used += (size_t)snprintf(out + used, KEY_NESTED_SIZE - used, "%s: {", word);
    }
    if (depth == 0 || section_find(section, name) < 0)
        return false;
    /* The names of the schema are short, and nested a few deep. */
    used += (size_t)snprintf(out + used, KEY_NESTED_SIZE - used, "%s: ...", name);
    for (; depth > 0 && used + 1 < KEY_NESTED_SIZE; depth--)
        used += (size_t)snprintf(out + used, KEY_NESTED_SIZE - used, "}");
    return true;
}
