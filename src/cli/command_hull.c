/* fram hull: a hull from a file or from main particulars; how it floats, its convex pieces, a drawing, a file. */
#include "cli/cli.h"
#include "cli/hull_warnings.h"

#include "fram/hull.h"

#include <math.h>
#include <string.h>

#define DEGREE (3.14159265358979323846 / 180)

/* What the words say. */
typedef struct hull_words {
    const char *path;
    fram_hull_file_definition file;
    fram_hull_particulars particulars; /* angles in degrees until the hull is made */
    bool box, ship;
    fram_hull_condition condition;
    double kg, lcg, tcg;
    double tolerance;
    int pieces;
    const char *draw, *output;
} hull_words;

static hull_words words_default(void)
{
    hull_words w = {.kg = (double)NAN, .lcg = (double)NAN, .tcg = (double)NAN, .tolerance = (double)NAN, .pieces = 64};
    fram_hull_file_default(&w.file);
    fram_hull_particulars_default(&w.particulars);
    fram_hull_condition_default(&w.condition);
    fram_hull_particulars *p = &w.particulars;
    p->length = p->beam = p->parallel_midbody = (double)NAN;
    p->stem_angle = p->entrance_angle = p->flare_angle = p->stern_angle = (double)NAN;
    p->block_coefficient = p->bilge_radius = p->transom = (double)NAN;
    return w;
}

static int read_hull_words(const command_row *self, hull_words *w, common_options *common, int argc, char **argv)
{
    fram_hull_particulars *p = &w->particulars;
    const option_row rows[] = {
        {"--draught", NULL, OPTION_REAL, &w->condition.draught, "T",
         "draught, from the lowest point [m]; otherwise the waterline is z = 0 of the file"},
        {"--mass", NULL, OPTION_REAL, &w->condition.mass, "M", "find draught, heel and trim for this mass [kg]"},
        {"--kg", NULL, OPTION_REAL, &w->kg, "H",
         "centre of gravity above the lowest point [m]; otherwise in the waterline"},
        {"--lcg", NULL, OPTION_REAL, &w->lcg, "X", "x of the centre of gravity [m]; otherwise that of buoyancy"},
        {"--tcg", NULL, OPTION_REAL, &w->tcg, "Y", "y of the centre of gravity [m]; otherwise that of buoyancy"},
        {"--water-density", NULL, OPTION_REAL, &w->condition.water_density, "RHO",
         "density of the water [kg/m3] (1025)"},
        {"--draw", NULL, OPTION_TEXT, &w->draw, "FILE", "draw lines plan, surface and convex pieces, .png or .svg"},
        {"--output", "-o", OPTION_TEXT, &w->output, "FILE", "write the closed surface: .stl, .obj or .gdf"},
        {"--tolerance", NULL, OPTION_REAL, &w->tolerance, "D",
         "largest deviation of the convex pieces from the hull [m] (breadth/100)"},
        {"--pieces", NULL, OPTION_INTEGER, &w->pieces, "N",
         "largest number of convex pieces, 1 to 4096 (64); each closed part has one at least"},
        {"--seal", NULL, OPTION_REAL, &w->file.seal_width, "WIDTH",
         "file: seal cracks up to this width [m]; 0: none (length/2000)"},
        {"--repair", NULL, OPTION_FLAG, &w->file.repair, NULL,
         "file: fill holes and reorient triangles instead of refusing"},
        {"--freeboard", NULL, OPTION_REAL, &w->file.freeboard, "F",
         "file: extend an open top by this and close it with a deck [m]; no file: freeboard"},
        {"--scale", NULL, OPTION_REAL, &w->file.scale, "S",
         "file: factor from its lengths to metres (0.001 for millimetres)"},
        {"--length", NULL, OPTION_REAL, &p->length, "L", "no file: length on the waterline [m]"},
        {"--beam", NULL, OPTION_REAL, &p->beam, "B", "no file: beam on the waterline [m]"},
        {"--stem-angle-deg", NULL, OPTION_REAL, &p->stem_angle, "A",
         "no file: stem angle from the waterplane (30; ship 75)"},
        {"--entrance-angle-deg", NULL, OPTION_REAL, &p->entrance_angle, "A",
         "no file: half angle of entrance of the waterline (30; ship: from the block coefficient)"},
        {"--flare-angle-deg", NULL, OPTION_REAL, &p->flare_angle, "A",
         "no file: flare of the sides from the vertical (8; ship 0)"},
        {"--stern-angle-deg", NULL, OPTION_REAL, &p->stern_angle, "A",
         "no file: angle of the stern from the waterplane (30; ship 45)"},
        {"--parallel-midbody", NULL, OPTION_REAL, &p->parallel_midbody, "P",
         "no file: parallel middle body over the length (0.4; ship: from the block coefficient)"},
        {"--block-coefficient", NULL, OPTION_REAL, &p->block_coefficient, "CB",
         "no file: block coefficient, by rounding the bilge, of a ship by its ends (sharp bilges; ship 0.8)"},
        {"--bilge-radius", NULL, OPTION_REAL, &p->bilge_radius, "R", "ship: bilge radius [m]"},
        {"--transom", NULL, OPTION_REAL, &p->transom, "S", "ship: breadth of the transom over the beam (0.5)"},
        {"--box", NULL, OPTION_FLAG, &w->box, NULL, "no file: a box instead of an icebreaker"},
        {"--ship", NULL, OPTION_FLAG, &w->ship, NULL,
         "no file: a tanker, FPSO or drillship with flat sides and bottom instead of an icebreaker"},
    };
    return options_read_some(self, rows, sizeof rows / sizeof *rows, common, argc, argv, &w->path, 0, 1);
}

/* NULL, or the first particular that was given of a form other than a box. */
static const char *given_of_form(const hull_words *w)
{
    const fram_hull_particulars *p = &w->particulars;
    const struct {
        const char *name;
        double value;
    } given[] = {{"--stem-angle-deg", p->stem_angle},         {"--entrance-angle-deg", p->entrance_angle},
                 {"--flare-angle-deg", p->flare_angle},       {"--stern-angle-deg", p->stern_angle},
                 {"--parallel-midbody", p->parallel_midbody}, {"--block-coefficient", p->block_coefficient},
                 {"--bilge-radius", p->bilge_radius},         {"--transom", p->transom}};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        if (!isnan(given[i].value))
            return given[i].name;
    return NULL;
}

/* NULL, or the first particular that was given. */
static const char *given_particular(const hull_words *w)
{
    const char *of_form = given_of_form(w);
    if (!isnan(w->particulars.length) || !isnan(w->particulars.beam))
        return isnan(w->particulars.length) ? "--beam" : "--length";
    return of_form ? of_form : w->box ? "--box" : w->ship ? "--ship" : NULL;
}

/* NULL, or what was given of how a file is read. */
static const char *given_of_file(const hull_words *w)
{
    return w->file.scale != 1 ? "--scale" : !isnan(w->file.seal_width) ? "--seal" : w->file.repair ? "--repair" : NULL;
}

static void take(double *member, double given, double unit)
{
    if (!isnan(given))
        *member = given * unit;
}

static fram_status make_from_particulars(const hull_words *w, fram_context *context, fram_hull **hull,
                                         fram_error *error)
{
    const fram_hull_particulars *given = &w->particulars;
    fram_hull_particulars p;
    fram_hull_particulars_default(&p);
    p.box = w->box;
    p.ship = w->ship;
    take(&p.length, given->length, 1);
    take(&p.beam, given->beam, 1);
    take(&p.draught, w->condition.draught, 1);
    take(&p.freeboard, w->file.freeboard, 1);
    take(&p.stem_angle, given->stem_angle, DEGREE);
    take(&p.entrance_angle, given->entrance_angle, DEGREE);
    take(&p.flare_angle, given->flare_angle, DEGREE);
    take(&p.stern_angle, given->stern_angle, DEGREE);
    take(&p.parallel_midbody, given->parallel_midbody, 1);
    take(&p.block_coefficient, given->block_coefficient, 1);
    take(&p.bilge_radius, given->bilge_radius, 1);
    take(&p.transom, given->transom, 1);
    return fram_hull_make(context, &p, hull, error);
}

/* ---- answers ---- */

static const char *form_name(const hull_words *w)
{
    return w->path ? w->path : w->box ? "a box" : w->ship ? "a ship" : "an icebreaker";
}

static const char *title_of(const hull_words *w)
{
    const char *slash = w->path ? strrchr(w->path, '/') : NULL;
    return slash ? slash + 1 : form_name(w);
}

static void print_surface(const hull_words *w, const fram_hull_surface *s)
{
    tell(stdout, "%s: %s", form_name(w), s->format);
    if (w->path)
        printf(", %d %s%s%s", s->elements, strcmp(s->format, "GDF") == 0 ? "panels" : "elements",
               s->mirrored_x ? ", mirrored in x = 0" : "", s->mirrored_y ? ", mirrored in y = 0" : "");
    printf("; closed, %d triangles, %d vertices\n", s->triangles, s->vertices);
    printf("  from x = %.6g, y = %.6g, z = %.6g to x = %.6g, y = %.6g, z = %.6g m\n", s->lo[0], s->lo[1], s->lo[2],
           s->hi[0], s->hi[1], s->hi[2]);
    if (s->dropped)
        printf("  left out: %d without area\n", s->dropped);
    if (s->inner_parts)
        printf("  left out: %d closed part%s inside the hull, %.6g m3, where no water comes\n", s->inner_parts,
               s->inner_parts == 1 ? "" : "s", s->inner_volume);
    if (s->lids)
        printf("  left out: %d triangles in the waterplane\n", s->lids);
    if (s->joined || s->splits)
        printf(
            "  cracks up to %.4g m sealed: widest %.4g m, %d vertices joined, edges led over a vertex %d times; moved "
            "edges swept %.4g m2;\n    the surface failed to close by an area of (%.4g, %.4g, %.4g) m2, and its volume "
            "integrals by (%.4g, %.4g, %.4g) m3\n",
            s->seal_width, s->crack_width, s->joined, s->splits, s->crack_area, s->crack_vector[0], s->crack_vector[1],
            s->crack_vector[2], s->crack_volume[0], s->crack_volume[1], s->crack_volume[2]);
    if (s->topsides > 0)
        printf("  topsides raised by %.4g m and decked\n", s->topsides);
    if (s->decked > 0)
        printf("  open top decked where it is, %.4g m2\n", s->decked);
    if (s->holes_filled)
        printf("  holes filled: %d, %.4g m2\n", s->holes_filled, s->hole_area);
    if (s->flipped)
        printf("  triangles reoriented: %d\n", s->flipped);
}

/* Decimals that keep five digits of a number as large as this one, and four at least. */
static int decimals_for(double size)
{
    enum { LEAST = 4, MOST = 15 };
    int count = LEAST;
    for (; size > 0 && size < 1 && count < MOST; size *= 10)
        count++;
    return count;
}

/* 0, and not what rounding leaves of it [deg]. */
static double told_angle(double angle) { return fabs(angle / DEGREE) < 1e-9 ? 0 : angle / DEGREE; }

/* 0, and not what rounding leaves of it beside a number of the size that it could have. */
static double told_beside(double value, double size) { return fabs(value) <= 1e-12 * size ? 0 : value; }

/* Places and couplings that are none. */
static fram_hull_floating without_rounding(fram_hull_floating f)
{
    double *const lengths[] = {&f.level, f.centre, f.centre_of_buoyancy, f.centre_of_flotation};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < (i == 0 ? 1 : 3); k++)
            lengths[i][k] = told_beside(lengths[i][k], f.length_overall);
    f.c35 = told_beside(f.c35, f.c33 * f.length_overall);
    return f;
}

static void print_floating(const fram_hull_floating *floating)
{
    const fram_hull_floating shown = without_rounding(*floating), *const f = &shown;
    /* Of lengths, volumes, areas, and second moments of area. */
    int l = decimals_for(f->length_overall), v = decimals_for(f->volume), a = decimals_for(f->waterplane_area);
    int m = f->second_moment_transverse < 1 ? decimals_for(f->second_moment_transverse) : 1;
    printf("\nFloating at z = %.6g m, heel %.4g deg, trim %.4g deg by the bow%s\n", f->level, told_angle(f->heel),
           told_angle(f->trim), f->stable ? "" : " (UNSTABLE)");
    printf("  displaced volume        %14.*f m3    displacement %.*f t\n", v, f->volume, decimals_for(f->mass / 1000),
           f->mass / 1000);
    printf("  enclosed volume         %14.*f m3\n", decimals_for(f->enclosed_volume), f->enclosed_volume);
    printf("  draught                 %14.*f m     fore %.*f, aft %.*f\n", l, f->draught, l, f->draught_fore, l,
           f->draught_aft);
    printf("  waterline               %14.*f m     breadth %.*f\n", l, f->length_waterline, l, f->breadth_waterline);
    printf("  overall                 %14.*f m     breadth %.*f, depth %.*f\n", l, f->length_overall, l,
           f->breadth_overall, l, f->depth);
    printf("  centre of buoyancy      %14.*f m     y %.*f, z %.*f; KB %.*f\n", l, f->centre_of_buoyancy[0], l,
           f->centre_of_buoyancy[1], l, f->centre_of_buoyancy[2], l, f->kb);
    printf("  centre of flotation     %14.*f m     y %.*f\n", l, f->centre_of_flotation[0], l,
           f->centre_of_flotation[1]);
    printf("  centre of gravity       %14.*f m     y %.*f, z %.*f; KG %.*f\n", l, f->centre[0], l, f->centre[1], l,
           f->centre[2], l, f->kg);
    printf("  waterplane area         %14.*f m2    wetted surface %.*f m2\n", a, f->waterplane_area, a, f->wetted_area);
    printf("  second moments          %14.*f m4    longitudinal %.*f\n", m, f->second_moment_transverse, m,
           f->second_moment_longitudinal);
    printf("  transverse BM           %14.*f m     GM %.*f\n", l, f->bm_transverse, l, f->gm_transverse);
    printf("  longitudinal BM         %14.*f m     GM %.*f\n", l, f->bm_longitudinal, l, f->gm_longitudinal);
    printf("  stiffness heave C33     %14.6g N/m   C35 %.6g N\n", f->c33, f->c35);
    printf("  stiffness roll C44      %14.6g N m   pitch C55 %.6g N m\n", f->c44, f->c55);
    printf("  coefficients: block %.4f, waterplane %.4f, midship %.4f, prismatic %.4f\n", f->block, f->waterplane,
           f->midship, f->prismatic);
}

static void json_surface(json *j, const fram_hull_surface *s)
{
    json_text(j, "format", s->format);
    json_boolean(j, "closed", true);
    json_integer(j, "triangles", s->triangles);
    json_integer(j, "vertices", s->vertices);
    json_integer(j, "elements", s->elements);
    json_integer(j, "elements_dropped", s->dropped);
    json_boolean(j, "mirrored_x", s->mirrored_x);
    json_boolean(j, "mirrored_y", s->mirrored_y);
    json_reals(j, "box_lo_m", s->lo, 3);
    json_reals(j, "box_hi_m", s->hi, 3);
    json_open(j, "seal");
    json_real(j, "width_m", s->seal_width);
    json_integer(j, "open_edges_before", s->open_edges_before);
    json_integer(j, "vertices_joined", s->joined);
    json_integer(j, "edges_led_over_a_vertex", s->splits);
    json_real(j, "widest_crack_m", s->crack_width);
    json_real(j, "swept_area_m2", s->crack_area);
    json_reals(j, "area_vector_m2", s->crack_vector, 3);
    json_reals(j, "volume_integrals_changed_by_m3", s->crack_volume, 3);
    json_close(j);
    json_real(j, "topsides_raised_by_m", s->topsides);
    json_integer(j, "lid_triangles_left_out", s->lids);
    json_integer(j, "holes_filled", s->holes_filled);
    json_real(j, "hole_area_m2", s->hole_area);
    json_integer(j, "triangles_turned", s->flipped);
    json_integer(j, "inner_parts_left_out", s->inner_parts);
    json_real(j, "inner_volume_m3", s->inner_volume);
    json_real(j, "well", s->well);
    json_boolean(j, "open_boat", s->open_boat);
    json_boolean(j, "half", s->half);
    json_real(j, "top_decked_m2", s->decked);
}

static void json_floating(json *j, const fram_hull_floating *f, const fram_hull_condition *c)
{
    json_real(j, "level_m", f->level);
    json_real(j, "heel_deg", f->heel / DEGREE);
    json_real(j, "trim_deg", f->trim / DEGREE);
    json_boolean(j, "stable", f->stable);
    json_real(j, "volume_m3", f->volume);
    json_reals(j, "volume_integrals_m3", f->volume_integrals, 3);
    json_real(j, "enclosed_volume_m3", f->enclosed_volume);
    json_real(j, "water_density_kg_per_m3", c->water_density);
    json_real(j, "gravity_m_per_s2", c->gravity);
    json_real(j, "displacement_t", f->mass / 1000);
    json_real(j, "mass_kg", f->mass);
    json_real(j, "draught_m", f->draught);
    json_real(j, "draught_fore_m", f->draught_fore);
    json_real(j, "draught_aft_m", f->draught_aft);
    json_reals(j, "centre_of_buoyancy_m", f->centre_of_buoyancy, 3);
    json_reals(j, "centre_of_flotation_m", f->centre_of_flotation, 3);
    json_reals(j, "centre_of_mass_m", f->centre, 3);
    json_real(j, "waterplane_area_m2", f->waterplane_area);
    json_real(j, "wetted_area_m2", f->wetted_area);
    json_real(j, "second_moment_transverse_m4", f->second_moment_transverse);
    json_real(j, "second_moment_longitudinal_m4", f->second_moment_longitudinal);
    json_real(j, "kb_m", f->kb);
    json_real(j, "kg_m", f->kg);
    json_real(j, "bm_transverse_m", f->bm_transverse);
    json_real(j, "bm_longitudinal_m", f->bm_longitudinal);
    json_real(j, "gm_transverse_m", f->gm_transverse);
    json_real(j, "gm_longitudinal_m", f->gm_longitudinal);
    json_real(j, "c33_N_per_m", f->c33);
    json_real(j, "c34_N", f->c34);
    json_real(j, "c35_N", f->c35);
    json_real(j, "c44_N_m", f->c44);
    json_real(j, "c45_N_m", f->c45);
    json_real(j, "c55_N_m", f->c55);
    json_real(j, "length_overall_m", f->length_overall);
    json_real(j, "breadth_overall_m", f->breadth_overall);
    json_real(j, "depth_m", f->depth);
    json_real(j, "length_waterline_m", f->length_waterline);
    json_real(j, "breadth_waterline_m", f->breadth_waterline);
    json_real(j, "midship_area_m2", f->midship_area);
    json_real(j, "block_coefficient", f->block);
    json_real(j, "waterplane_coefficient", f->waterplane);
    json_real(j, "midship_coefficient", f->midship);
    json_real(j, "prismatic_coefficient", f->prismatic);
}

static void print_hull_json(const hull_words *w, const fram_hull_surface *s, const fram_hull_floating *f,
                            const fram_hull_pieces *p)
{
    json j = json_begin();
    json_text(&j, "hull", form_name(w));
    json_surface(&j, s);
    json_floating(&j, f, &w->condition);
    json_open(&j, "convex_pieces");
    json_integer(&j, "count", p->count);
    json_real(&j, "tolerance_m", p->tolerance);
    json_real(&j, "largest_distance_m", p->concavity);
    json_real(&j, "volume_m3", p->volume);
    json_close(&j);
    if (w->draw)
        json_text(&j, "drawing", w->draw);
    if (w->output)
        json_text(&j, "written", w->output);
    json_end(&j);
}

/* ---- the command ---- */

static fram_status work(hull_words *w, fram_context *context, fram_hull **hull, fram_hull_surface *surface,
                        fram_hull_floating *floating, fram_hull_pieces *pieces, fram_error *error)
{
    fram_status status = w->path ? fram_hull_load(context, w->path, &w->file, hull, error)
                                 : make_from_particulars(w, context, hull, error);
    if (status != FRAM_OK)
        return status;
    fram_hull_surface_get(*hull, surface);
    /* The draught of a hull made for it is that of z = 0, in which its waterline has the given length. */
    if (!w->path)
        w->condition.draught = (double)NAN;
    w->condition.centre[0] = w->lcg;
    w->condition.centre[1] = w->tcg;
    w->condition.centre[2] = surface->lo[2] + w->kg;
    status = fram_hull_float(*hull, &w->condition, floating, error);
    if (status == FRAM_OK)
        status = fram_hull_cut(*hull, w->tolerance, w->pieces, pieces, error);
    if (status == FRAM_OK && (w->draw || w->output))
        (void)session_stop_flag(); /* what comes before hears no wish to stop, and so ends by the signal */
    if (status == FRAM_OK && w->draw)
        status = fram_hull_draw(*hull, &w->condition, title_of(w), w->draw, error);
    if (status == FRAM_OK && w->output)
        status = fram_hull_save(*hull, w->output, error);
    return status;
}

static void warn_of_half(const common_options *common, const fram_hull_surface *s)
{
    if (s->half && !common->quiet)
        fprintf(stderr,
                "warning: the file has half a hull or a quarter, open along y = 0 or x = 0, and is closed there: "
                "what follows is half a ship, unless that is its end; mirror it in the program that made the file\n");
}

static void warn_of_well(const common_options *common, const fram_hull_surface *s)
{
    if (s->open_boat && !common->quiet)
        fprintf(stderr,
                "warning: the waterline goes round a hole of %.0f %% of its area: an open boat is full of water; give "
                "it a deck, or its outer face alone, in the program that made the file\n",
                100 * s->well);
}

static void warn_of_freeboard(const common_options *common, const hull_words *w, const fram_hull_surface *s)
{
    if (w->path && !isnan(w->file.freeboard) && !(s->topsides > 0) && !common->quiet)
        fprintf(stderr, "warning: --freeboard: no level open top: without effect\n");
}

/* Words that do not go together: an exit code, -1 to go on. */
static int check_hull_words(const common_options *common, const hull_words *w)
{
    const fram_hull_particulars *p = &w->particulars;
    const char *particular = given_particular(w), *of_file = given_of_file(w), *of_form = given_of_form(w);
    if (w->path)
        return particular ? answer_usage(common, particular, "applies to a hull without a file") : -1;
    if (isnan(p->length) || isnan(p->beam) || isnan(w->condition.draught))
        return answer_usage(common, "hull", "needs a mesh file, or --length, --beam and --draught; see --help");
    if (of_file)
        return answer_usage(common, of_file, "applies to a hull from a file");
    if (w->box && w->ship)
        return answer_usage(common, "--ship", "cannot be combined with --box");
    if (w->box && of_form)
        return answer_usage(common, of_form, "does not apply to a box: leave one of them out");
    if (!w->ship && !(isnan(p->bilge_radius) && isnan(p->transom)))
        return answer_usage(common, isnan(p->transom) ? "--bilge-radius" : "--transom",
                            "applies to a ship: add --ship");
    return -1;
}

int command_hull(const command_row *self, int argc, char **argv)
{
    common_options common;
    hull_words w = words_default();
    int code = read_hull_words(self, &w, &common, argc, argv);
    if (code < 0)
        code = check_hull_words(&common, &w);
    if (code >= 0)
        return code;
    const command_files files = {
        .inputs = {w.path}, .outputs = {{"--draw", w.draw, PICTURE_ENDINGS}, {"--output", w.output, "stl obj gdf"}}};
    code = refuse_outputs(&common, &files);
    if (code >= 0)
        return code;
    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;

    fram_hull *hull = NULL;
    fram_hull_surface surface;
    fram_hull_floating floating;
    fram_hull_pieces pieces;
    fram_error error = {0};
    if (work(&w, context, &hull, &surface, &floating, &pieces, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        if (w.path)
            hull_warn_of_file(&common, &floating);
        hull_warn_of_condition(&common, &w.condition, &surface, &floating);
        hull_warn_of_level(&common, &w.condition, &surface, &floating, w.output);
        warn_of_half(&common, &surface);
        warn_of_well(&common, &surface);
        warn_of_freeboard(&common, &w, &surface);
        if (common.json) {
            print_hull_json(&w, &surface, &floating, &pieces);
        } else {
            print_surface(&w, &surface);
            print_floating(&floating);
            printf("  convex pieces: %d, within %.4g m of the surface (%.4g m were allowed)\n", pieces.count,
                   pieces.concavity, pieces.tolerance);
        }
    }
    fram_hull_destroy(hull);
    fram_context_destroy(context);
    return code;
}
