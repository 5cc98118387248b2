/* fram ice: quick hand calculations of how floating ice breaks at its edge. */
#include "cli/cli.h"

#include "fram/ice.h"

#include <math.h>
#include <string.h>

typedef struct ice_words {
    const char *what; /* wedge, sheet, break or split */
    double a_over_l;
    bool thin;
    fram_ice_edge load;
    fram_ice_floe floe;
} ice_words;

/* What an option holds; of a text nothing. */
static double number_of(const option_row *row)
{
    switch (row->kind) {
    case OPTION_REAL:
        return *(const double *)row->value;
    case OPTION_INTEGER:
        return *(const int *)row->value;
    case OPTION_FLAG:
        return *(const bool *)row->value;
    default:
        return 0;
    }
}

/* What a row of the help begins with: the calculations that have a use for the option. */
static bool is_for(const option_row *row, const char *what)
{
    size_t length = strlen(what), end = strcspn(row->meaning, ":");
    for (const char *at = strstr(row->meaning, what); at; at = strstr(at + 1, what))
        if ((size_t)(at - row->meaning) + length <= end && strchr(",:", at[length]))
            return true;
    return false;
}

/* An exit code when an option that the calculation has no use for has another value than before; -1 to go on. */
static int refuse_misplaced(const common_options *common, const char *what, const option_row *rows, size_t count,
                            const double before[])
{
    for (size_t i = 0; i < count; i++) {
        double now = number_of(&rows[i]);
        if (now == before[i] || (isnan(now) && isnan(before[i])) || is_for(&rows[i], what))
            continue;
        char message[80];
        snprintf(message, sizeof message, "is for %.*s", (int)strcspn(rows[i].meaning, ":"), rows[i].meaning);
        return answer_usage(common, rows[i].name, message);
    }
    return -1;
}

/* The same of an option that counts beside another one only; density: that of no option. */
static int refuse_lonely(const common_options *common, const fram_ice_edge *load, double density)
{
    if (load->ice_length != 0 && load->contact_width == 0)
        return answer_usage(common, "--ice-length", "is for --contact-width");
    if (load->ice_density != density && load->rise_time == 0)
        return answer_usage(common, "--ice-density", "is for --rise-time");
    return -1;
}

static bool is_calculation(const char *what)
{
    return strcmp(what, "wedge") == 0 || strcmp(what, "sheet") == 0 || strcmp(what, "break") == 0 ||
           strcmp(what, "split") == 0;
}

static int read_ice_words(const command_row *self, ice_words *w, common_options *common, int argc, char **argv)
{
    double angle = 180, density = w->load.ice_density;
    const option_row rows[] = {
        {"--a-over-l", NULL, OPTION_REAL, &w->a_over_l, "X",
         "wedge, sheet: radius of the load over the characteristic length"},
        {"--nu", NULL, OPTION_REAL, &w->load.poisson_ratio, "V", "sheet, break: Poisson's ratio (0.3)"},
        {"--force", NULL, OPTION_REAL, &w->load.force, "P", "break: vertical load [N] (0)"},
        {"--contact-area", NULL, OPTION_REAL, &w->load.contact_area, "A", "break: horizontal contact area [m2] (0)"},
        {"--thickness", NULL, OPTION_REAL, &w->load.thickness, "H", "break, split: ice thickness [m] (1)"},
        {"--elastic-modulus", NULL, OPTION_REAL, &w->load.elastic_modulus, "E", "break: elastic modulus [Pa] (5e9)"},
        {"--flexural-strength", NULL, OPTION_REAL, &w->load.flexural_strength, "S",
         "break: flexural strength [Pa] (5e5)"},
        {"--crushing-strength", NULL, OPTION_REAL, &w->load.crushing_strength, "S",
         "break: crushing strength [Pa] (2e6)"},
        {"--water-density", NULL, OPTION_REAL, &w->load.water_density, "RHO",
         "break: density of the water [kg/m3] (1025)"},
        {"--gravity", NULL, OPTION_REAL, &w->load.gravity, "G", "break: gravity [m/s2] (9.81)"},
        {"--wedges", NULL, OPTION_INTEGER, &w->load.wedges, "N", "break: number of wedges that share the load (3)"},
        {"--included-angle", NULL, OPTION_REAL, &angle, "DEG",
         "break: included angle of the ice at the contact [deg] (180: a straight edge)"},
        {"--contact-width", NULL, OPTION_REAL, &w->load.contact_width, "W",
         "break: width of the contact along the edge [m] (0: narrow)"},
        {"--ice-length", NULL, OPTION_REAL, &w->load.ice_length, "L",
         "break: length of the ice behind a --contact-width [m] (0: semi-infinite)"},
        {"--rise-time", NULL, OPTION_REAL, &w->load.rise_time, "T",
         "break: time in which the load has risen evenly, with the inertia of ice and water [s] (0: at rest)"},
        {"--ice-density", NULL, OPTION_REAL, &w->load.ice_density, "RHO",
         "break: density of the ice, for --rise-time [kg/m3] (920)"},
        {"--thin-plate", NULL, OPTION_FLAG, &w->thin, NULL,
         "break: thin-plate theory also under small loads (no equivalent radius)"},
        {"--toughness", NULL, OPTION_REAL, &w->floe.toughness, "K",
         "split: fracture toughness K_IC [Pa m^0.5] (150e3)"},
        {"--length", NULL, OPTION_REAL, &w->floe.length, "L", "split: length of the floe along the crack [m] (50)"},
        {"--width", NULL, OPTION_REAL, &w->floe.width, "W", "split: width of the floe across the crack [m] (50)"},
        {"--place", NULL, OPTION_REAL, &w->floe.place, "Y",
         "split: distance of the load from the middle of the side [m] (0)"},
    };
    enum { ROWS = sizeof rows / sizeof *rows };
    double before[ROWS];
    for (size_t i = 0; i < ROWS; i++)
        before[i] = number_of(&rows[i]);
    int code = options_read(self, rows, ROWS, common, argc, argv, &w->what, 1);
    if (code < 0 && !is_calculation(w->what))
        return answer_usage(common, w->what, "is not a calculation; choose wedge, sheet, break or split");
    if (code < 0)
        code = refuse_misplaced(common, w->what, rows, ROWS, before);
    if (code < 0)
        code = refuse_lonely(common, &w->load, density);
    if (code < 0 && !(angle > 0 && angle <= 360))
        return answer_usage(common, "--included-angle", "expected more than 0 and at most 360 degrees");
    w->floe.thickness = w->load.thickness;
    w->load.included_angle = angle * (3.14159265358979323846 / 180);
    return code;
}

/* One line for people, or one member for programs. */
typedef struct answer_row {
    const char *key;
    double value;
    const char *unit, *meaning;
} answer_row;

static void print_answers(const common_options *common, const answer_row *rows, int count)
{
    json j = {0};
    if (common->json)
        j = json_begin();
    for (int i = 0; i < count; i++) {
        if (common->json)
            json_real(&j, rows[i].key, rows[i].value);
        else if (isinf(rows[i].value))
            printf("%-28s %-14s %-4s %s\n", rows[i].key, "none", "", rows[i].meaning);
        else
            printf("%-28s %-14.7g %-4s %s\n", rows[i].key, rows[i].value, rows[i].unit, rows[i].meaning);
    }
    if (!common->json)
        return;
    json_open(&j, "units");
    for (int i = 0; i < count; i++)
        if (rows[i].unit[0])
            json_text(&j, rows[i].key, rows[i].unit);
    json_close(&j);
    json_end(&j);
}
#define PRINT(common, rows) print_answers((common), (rows), (int)(sizeof(rows) / sizeof *(rows)))

static int answer_wedge(const ice_words *w, const common_options *common)
{
    fram_error error;
    fram_ice_wedge_result r;
    if (fram_ice_wedge(w->a_over_l, &r, &error) != FRAM_OK)
        return answer_error(common, &error);
    const answer_row rows[] = {
        {"a_over_l", w->a_over_l, "", "radius of the load over the characteristic length l"},
        {"capacity_C", r.capacity_C, "", "wedge capacity = flexural strength * b0 h^2/6 * C"},
        {"x_max", r.x_max, "", "breaking radius over l"},
        {"eta0", r.eta0, "", "deflection of the tip, w k b0 l^2/P"},
    };
    PRINT(common, rows);
    return EXIT_GOOD;
}

static int answer_sheet(const ice_words *w, const common_options *common)
{
    fram_error error;
    fram_ice_sheet_result r;
    if (fram_ice_sheet(w->a_over_l, w->load.poisson_ratio, &r, &error) != FRAM_OK)
        return answer_error(common, &error);
    const answer_row rows[] = {
        {"a_over_l", w->a_over_l, "", "radius of the load over the characteristic length l"},
        {"nu", w->load.poisson_ratio, "", "Poisson's ratio"},
        {"sigma_h2_over_P", r.sigma_h2_over_P, "", "stress along the edge, as used in a run"},
        {"exact_sigma_h2_over_P", r.exact_sigma_h2_over_P, "", "exact integral of the plate equation"},
        {"closed_form_sigma_h2_over_P", r.closed_form_sigma_h2_over_P, "", "Westergaard's closed form"},
    };
    PRINT(common, rows);
    return EXIT_GOOD;
}

static int answer_break(const ice_words *w, const common_options *common)
{
    fram_error error;
    fram_ice_breaking b;
    fram_ice_edge load = w->load;
    load.thick_plate_radius = !w->thin;
    if (fram_ice_break(&load, &b, &error) != FRAM_OK)
        return answer_error(common, &error);
    const answer_row rows[] = {
        {"characteristic_length", b.characteristic_length, "m", "l"},
        {"radial_radius", b.radial_radius, "m", "radius of the loaded half disc"},
        {"wedge_radius", b.wedge_radius, "m", "radius of the loaded wedge tip"},
        {"radial_stress", b.radial_stress, "Pa", "along the edge; the radial crack opens at the flexural strength"},
        {"wedge_stress", b.wedge_stress, "Pa", "in the wedges; they break off at the flexural strength"},
        {"radial_capacity", b.radial_capacity, "N", "load at which the radial crack opens"},
        {"wedge_capacity", b.wedge_capacity, "N", "load at which the wedges break off, with the strip between them"},
        {"strip_capacity", b.strip_capacity, "N", "part of it carried by the strip under a wide contact"},
        {"strip_length", b.strip_length, "m", "distance from the edge at which that strip breaks"},
        {"breaking_radius", b.breaking_radius, "m", "from the load to where the wedges break off, along their axes"},
        {"crushing_force", b.crushing_force, "N", "contact area times crushing strength"},
    };
    PRINT(common, rows);
    return EXIT_GOOD;
}

static int answer_split(const ice_words *w, const common_options *common)
{
    fram_error error;
    fram_ice_splitting s;
    if (fram_ice_split(&w->floe, &s, &error) != FRAM_OK)
        return answer_error(common, &error);
    const answer_row rows[] = {
        {"smaller_side", s.smaller_side, "m", "width of the floe on the nearer side of the crack"},
        {"larger_side", s.larger_side, "m", "width on the other side"},
        {"factor", s.factor, "", "F of the largest opening force F h K_IC sqrt(length)"},
        {"splitting_load", s.splitting_load, "N", "opening force at which the floe splits"},
        {"slenderness", s.slenderness, "",
         "of the narrower piece; over ice.fracture.narrowness (4) no run splits the floe"},
    };
    PRINT(common, rows);
    return EXIT_GOOD;
}

int command_ice(const command_row *self, int argc, char **argv)
{
    common_options common;
    ice_words w = {.a_over_l = NAN};
    fram_ice_edge_default(&w.load);
    fram_ice_floe_default(&w.floe);
    int code = read_ice_words(self, &w, &common, argc, argv);
    if (code >= 0)
        return code;
    if (strcmp(w.what, "break") == 0)
        return answer_break(&w, &common);
    if (strcmp(w.what, "split") == 0)
        return answer_split(&w, &common);
    if (isnan(w.a_over_l))
        return answer_usage(&common, "--a-over-l", "is needed");
    return strcmp(w.what, "wedge") == 0 ? answer_wedge(&w, &common) : answer_sheet(&w, &common);
}
