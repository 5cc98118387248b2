/* Hulls of the public API. */
#include "fram/hull.h"

#include "api/arguments.h"
#include "api/handles.h"
#include "base/transcendental.h"
#include "io/hull_file.h"
#include "io/hull_view.h"
#include "io/path.h"
#include "model/scenario_schema.h"
#include "vessel/hull_axes.h"
#include "vessel/hydrostatics.h"

#include <stddef.h>
#include <stdio.h>

struct fram_hull {
    fram_context *context;
    char path[PATH_ROOM]; /* from the root, of the file that it is of; empty: none */
    mesh surface;
    polyhedron_array pieces;
    double concavity;
    fram_hull_surface about;
};

/* ---- making ---- */

static void describe(fram_hull *h)
{
    fram_hull_surface *a = &h->about;
    box3 box = mesh_bounds(&h->surface);
    solid_properties whole = mesh_solid_properties(&h->surface);
    a->triangles = h->surface.face.count;
    a->vertices = h->surface.vertex.count;
    copy3(a->lo, box.lo);
    copy3(a->hi, box.hi);
    a->enclosed_volume = whole.volume;
    copy3(a->centroid, whole.centre);
}

static void describe_file(fram_hull *h, const hull_file_report *r)
{
    h->about = (fram_hull_surface){
        .format = mesh_format_name(r->format),
        .elements = r->elements,
        .dropped = r->dropped,
        .mirrored_x = r->mirror_x,
        .mirrored_y = r->mirror_y,
        .seal_width = r->seal_width,
        .open_edges_before = r->seal.open_before,
        .joined = r->seal.joined,
        .splits = r->seal.splits,
        .crack_width = r->seal.width,
        .crack_area = r->seal.area,
        .topsides = r->freeboard,
        .decked = r->decked,
        .lids = r->lids,
        .holes_filled = r->holes,
        .hole_area = r->hole_area,
        .flipped = r->flipped,
        .inner_parts = r->inner_parts,
        .inner_volume = r->inner_volume,
        .half = r->half != HULL_WHOLE,
        .well = r->well,
        .open_boat = r->well > OPEN_BOAT,
    };
    copy3(h->about.crack_vector, r->seal.area_vector);
    copy3(h->about.crack_volume, r->seal.volume);
}

static fram_hull *hull_begin(fram_context *c)
{
    fram_hull *h = memory_array(&c->inner, 1, sizeof *h);
    if (h)
        h->context = c;
    return h;
}

/* Hand a hull out, or destroy it. */
static fram_status hull_end(fram_hull *h, fram_status status, fram_hull **out)
{
    if (status != FRAM_OK) {
        fram_hull_destroy(h);
        return status;
    }
    describe(h);
    *out = h;
    return FRAM_OK;
}

static void fram_hull_file_fill(fram_hull_file_definition *d)
{
    hull_file_options o = hull_file_defaults();
    *d = (fram_hull_file_definition){sizeof *d, o.scale, o.seal_width, o.repair, o.freeboard};
}
DEFINITION_DEFAULT(fram_hull_file, fram_hull_file_definition)

fram_status fram_hull_load(fram_context *c, const char *path, const fram_hull_file_definition *definition,
                           fram_hull **out, fram_error *error)
{
    fram_hull_file_definition d;
    fram_hull_file_fill(&d);
    fram_status status = REFUSE_NULL(error, {"context", c}, {"path", path}, {"hull", out});
    if (status == FRAM_OK && definition)
        status = definition_take(&d, definition, sizeof d, DEFINITION_LEAST, "fram_hull_file", error);
    if (status != FRAM_OK)
        return status;
    const hull_file_options options = {d.scale, d.seal_width, d.repair, d.freeboard, (double)NAN};
    fram_hull *h = hull_begin(c);
    if (!h)
        return error_memory(error);
    (void)path_absolute(path, h->path, sizeof h->path);
    hull_file_report report;
    status = hull_file_read(&c->inner, path, &options, &h->surface, &report, error);
    if (status == FRAM_OK)
        describe_file(h, &report);
    return hull_end(h, status, out);
}

/* What is usual for the form, which is not known yet, is left to vessel/hull.c. */
static void fram_hull_particulars_fill(fram_hull_particulars *p)
{
    const double usual = (double)NAN;
    *p = (fram_hull_particulars){.size = sizeof *p,
                                 .length = 100,
                                 .beam = 20,
                                 .draught = 7,
                                 .freeboard = 4,
                                 .stem_angle = usual,
                                 .entrance_angle = usual,
                                 .flare_angle = usual,
                                 .stern_angle = usual,
                                 .parallel_midbody = usual,
                                 .bilge_radius = usual,
                                 .transom = usual};
}
DEFINITION_DEFAULT(fram_hull_particulars, fram_hull_particulars)

static fram_status particulars_of(const fram_hull_particulars *given, hull_particulars *out, fram_error *error)
{
    fram_hull_particulars p;
    fram_hull_particulars_fill(&p);
    fram_status status =
        definition_take(&p, given, sizeof p, offsetof(fram_hull_particulars, ship), "fram_hull_particulars", error);
    if (status != FRAM_OK)
        return status;
    if (p.box && p.ship)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "ship", "a hull is either a box or a ship");
    *out = (hull_particulars){.form = p.box    ? HULL_BOX
                                      : p.ship ? HULL_SHIP
                                               : HULL_ICEBREAKER,
                              .length = p.length,
                              .beam = p.beam,
                              .draught = p.draught,
                              .freeboard = p.freeboard,
                              .stem_angle = p.stem_angle,
                              .entrance_angle = p.entrance_angle,
                              .flare_angle = p.flare_angle,
                              .stern_angle = p.stern_angle,
                              .parallel_midbody = p.parallel_midbody,
                              .block_coefficient = p.block_coefficient,
                              .bilge_radius = p.bilge_radius,
                              .transom = p.transom};
    hull_particulars_fill(out);
    return FRAM_OK;
}

fram_status fram_hull_make(fram_context *c, const fram_hull_particulars *p, fram_hull **out, fram_error *error)
{
    hull_particulars particulars;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"hull", out});
    if (status == FRAM_OK)
        status = particulars_of(p, &particulars, error);
    if (status != FRAM_OK)
        return status;
    fram_hull *h = hull_begin(c);
    if (!h)
        return error_memory(error);
    status = hull_make(&c->inner, &particulars, &h->surface, &h->pieces, error);
    h->about.format = "particulars";
    return hull_end(h, status, out);
}

void fram_hull_destroy(fram_hull *h)
{
    if (!h)
        return;
    context *ctx = &h->context->inner;
    mesh_free(ctx, &h->surface);
    polyhedron_array_free(ctx, &h->pieces);
    memory_free(ctx, h);
}

void(fram_hull_surface_get)(const fram_hull *h, fram_hull_surface *surface, size_t size)
{
    static const fram_hull_surface none = {.format = ""};
    if (RESULT_CHECK(surface, size, fram_hull_surface, NULL) == FRAM_OK)
        result_give(surface, size, h ? &h->about : &none);
}

void fram_hull_triangles(const fram_hull *h, double *vertices, int vertex_room, int *triangles, int triangle_room)
{
    if (!h)
        return;
    const mesh *m = &h->surface;
    for (int32_t i = 0; vertices && i < m->vertex.count && i < vertex_room; i++)
        copy3(vertices + 3 * (size_t)i, m->vertex.data[i]);
    for (int32_t i = 0; triangles && i < m->face.count && i < triangle_room; i++)
        for (int k = 0; k < 3; k++)
            triangles[3 * (size_t)i + (size_t)k] = m->face.data[i].v[k];
}

/* ---- floating ---- */

static void fram_hull_condition_fill(fram_hull_condition *c)
{
    *c = (fram_hull_condition){sizeof *c,
                               (double)NAN,
                               (double)NAN,
                               {(double)NAN, (double)NAN, (double)NAN},
                               scenario_key_find("environment", "water_density")->value,
                               scenario_key_find("environment", "gravity")->value};
}
DEFINITION_DEFAULT(fram_hull_condition, fram_hull_condition)

/* No hull reaches so far [m], and stiffness about what lies farther away would be no number. */
#define CENTRE_MOST 1e9

static fram_status check_condition(const fram_hull_condition *c, fram_error *error)
{
    if (!isnan(c->draught) && !isnan(c->mass))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "mass",
                         "a draught and a mass together say too much; give one of them");
    if (!(c->water_density > 0 && c->water_density < HUGE_VAL))
        return error_value(error, "water_density", "a positive density", c->water_density);
    if (!(c->gravity > 0 && c->gravity < HUGE_VAL))
        return error_value(error, "gravity", "a positive acceleration", c->gravity);
    if (!isnan(c->draught) && !(c->draught > 0 && c->draught < HUGE_VAL))
        return error_value(error, "draught", "a positive draught", c->draught);
    if (!isnan(c->mass) && !(c->mass > 0 && c->mass < HUGE_VAL))
        return error_value(error, "mass", "a positive mass", c->mass);
    for (int i = 0; i < 3; i++) {
        if (fabs(c->centre[i]) > CENTRE_MOST)
            return error_value(error, "centre", "coordinates within 1e9 m", c->centre[i]);
    }
    return FRAM_OK;
}

/* Says by what was given, if something was, that the water misses the hull or only touches it. */
static fram_status check_cut(const fram_hull *h, const fram_hull_condition *c, const hull_attitude *a,
                             fram_error *error)
{
    if ((isnan(c->draught) && isnan(c->mass)) || hull_is_cut(&h->surface, a))
        return FRAM_OK;
    double depth = h->about.hi[2] - h->about.lo[2], enclosed = mesh_solid_properties(&h->surface).volume;
    if (!isnan(c->draught))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "draught",
                         "the water at a draught of %.8g m does not cut the hull, which is %.8g m deep; give a %s one",
                         c->draught, depth, c->draught > 0.5 * depth ? "smaller" : "larger");
    if (c->mass > 0.5 * enclosed * c->water_density)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "mass",
                         "the mass of %.9g kg is all that the hull, which encloses %.9g m3, can displace: give less",
                         c->mass, enclosed);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "mass",
                     "the mass of %.9g kg is next to nothing for a hull that encloses %.9g m3: give kilograms", c->mass,
                     enclosed);
}

/* Upright level, then the centre of mass, then equilibrium where a mass is given. */
static fram_status find_attitude(const fram_hull *h, const fram_hull_condition *c, hull_attitude *a, vec3 *centre,
                                 fram_error *error)
{
    context *ctx = &h->context->inner;
    *a = (hull_attitude){isnan(c->draught) ? 0 : h->about.lo[2] + c->draught, 0, 0};
    fram_status status = check_condition(c, error);
    double volume = status == FRAM_OK ? c->mass / c->water_density : 0;
    if (status == FRAM_OK && !isnan(c->mass))
        status = hull_level_of(ctx, &h->surface, volume, &a->level, error);
    if (status == FRAM_OK)
        status = check_cut(h, c, a, error);
    hull_hydrostatics upright;
    if (status == FRAM_OK)
        status = hull_hydrostatics_at(ctx, &h->surface, a->level, &upright, error);
    if (status != FRAM_OK)
        return status;
    *centre = vec3_make(isnan(c->centre[0]) ? upright.centre_of_buoyancy.x : c->centre[0],
                        isnan(c->centre[1]) ? upright.centre_of_buoyancy.y : c->centre[1],
                        isnan(c->centre[2]) ? a->level : c->centre[2]);
    if (!isnan(c->mass))
        status = hull_float(ctx, &h->surface, volume, *centre, a, error);
    return status == FRAM_OK ? check_cut(h, c, a, error) : status;
}

static fram_status find_stability(const fram_hull *h, const fram_hull_condition *condition, fram_hull_condition *c,
                                  hull_attitude *a, hull_stability *s, fram_error *error)
{
    vec3 centre;
    fram_status status = REFUSE_NULL(error, {"hull", h});
    fram_hull_condition_fill(c);
    if (status == FRAM_OK && condition)
        status = definition_take(c, condition, sizeof *c, DEFINITION_LEAST, "fram_hull_condition", error);
    if (status != FRAM_OK)
        return status;
    status = find_attitude(h, c, a, &centre, error);
    return status == FRAM_OK ? hull_stability_of(&h->context->inner, &h->surface, a, centre, s, error) : status;
}

fram_status(fram_hull_float)(const fram_hull *h, const fram_hull_condition *condition, fram_hull_floating *out,
                             fram_error *error, size_t size)
{
    fram_hull_condition c;
    hull_attitude a;
    hull_stability s;
    fram_status status = REFUSE_NULL(error, {"floating", out});
    if (status == FRAM_OK)
        status = RESULT_CHECK(out, size, fram_hull_floating, error);
    if (status == FRAM_OK)
        status = find_stability(h, condition, &c, &a, &s, error);
    if (status != FRAM_OK)
        return status;
    double k = c.water_density * c.gravity;
    fram_hull_floating full = {
        .level = a.level,
        .heel = a.heel,
        .trim = a.trim,
        .stable = s.stable,
        .volume = s.at.volume,
        .mass = s.at.volume * c.water_density,
        .enclosed_volume = s.enclosed_volume,
        .waterplane_area = s.at.waterplane_area,
        .second_moment_transverse = s.at.waterplane_xx,
        .second_moment_longitudinal = s.at.waterplane_yy,
        .wetted_area = s.at.wetted_area,
        .kb = s.kb,
        .kg = s.kg,
        .bm_transverse = s.bm_transverse,
        .bm_longitudinal = s.bm_longitudinal,
        .gm_transverse = s.gm_transverse,
        .gm_longitudinal = s.gm_longitudinal,
        .c33 = k * s.c33,
        .c34 = k * s.c34,
        .c35 = k * s.c35,
        .c44 = k * s.c44,
        .c45 = k * s.c45,
        .c55 = k * s.c55,
        .length_overall = s.length_overall,
        .breadth_overall = s.breadth_overall,
        .depth = s.depth,
        .length_waterline = s.length_waterline,
        .breadth_waterline = s.breadth_waterline,
        .draught = s.draught,
        .draught_fore = s.draught_fore,
        .draught_aft = s.draught_aft,
        .midship_area = s.midship_area,
        .block = s.block,
        .waterplane = s.waterplane,
        .midship = s.midship,
        .prismatic = s.prismatic,
        .axes = (int)hull_axes_of(&h->surface, (vec3){0, 0, 0}, s.length_waterline, s.breadth_waterline),
    };
    copy3(full.volume_integrals, s.at.volume_integrals);
    copy3(full.centre, s.centre);
    copy3(full.centre_of_buoyancy, s.centre_of_buoyancy);
    copy3(full.centre_of_flotation, s.centre_of_flotation);
    result_give(out, size, &full);
    return FRAM_OK;
}

/* ---- pieces, drawings, files ---- */

fram_status(fram_hull_cut)(fram_hull *h, double tolerance, int most, fram_hull_pieces *out, fram_error *error,
                           size_t size)
{
    fram_status status = REFUSE_NULL(error, {"hull", h}, {"pieces", out});
    if (status == FRAM_OK)
        status = RESULT_CHECK(out, size, fram_hull_pieces, error);
    if (status != FRAM_OK)
        return status;
    if (most < 1 || most > FRAM_HULL_PIECES)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "most", "expected 1 to %d pieces, found %d",
                         FRAM_HULL_PIECES, most);
    if (!isnan(tolerance) && !(tolerance > 0 && tolerance < HUGE_VAL))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "tolerance", "expected a positive distance, found %g",
                         tolerance);
    polyhedron_array pieces = {0};
    double concavity = 0;
    status = hull_cut(&h->context->inner, &h->surface, &tolerance, most, &pieces, &concavity, error);
    if (status != FRAM_OK)
        return status;
    polyhedron_array_free(&h->context->inner, &h->pieces);
    h->pieces = pieces;
    h->concavity = concavity;
    fram_hull_pieces full = {pieces.count, tolerance, concavity, 0};
    for (int32_t i = 0; i < pieces.count; i++)
        full.volume += polyhedron_volume(&pieces.data[i]);
    result_give(out, size, &full);
    return FRAM_OK;
}

/* Rows of the table of a drawing. */
typedef struct view_table {
    const char *names[HULL_VIEW_LINES], *values[HULL_VIEW_LINES];
    char text[HULL_VIEW_LINES][48];
    int count;
} view_table;

static void add_row(view_table *t, const char *name, double value, const char *unit)
{
    if (t->count == HULL_VIEW_LINES)
        return;
    snprintf(t->text[t->count], sizeof t->text[0], "%.6g%s%s", value, *unit ? " " : "", unit);
    t->names[t->count] = name;
    t->values[t->count] = t->text[t->count];
    t->count++;
}

/* 0 for what is that of something of so large a size but for rounding. */
static double but_rounding(double value, double size) { return fabs(value) < 1e-9 * size ? 0 : value; }

static void fill_table(view_table *t, const hull_stability *s, const hull_attitude *a, double density)
{
    add_row(t, "Length overall", s->length_overall, "m");
    add_row(t, "Length of the waterline", s->length_waterline, "m");
    add_row(t, "Breadth of the waterline", s->breadth_waterline, "m");
    add_row(t, "Draught amidships", s->draught, "m");
    add_row(t, "Heel, to starboard", but_rounding(degrees(a->heel), 1), "deg");
    add_row(t, "Trim, by the bow", but_rounding(degrees(a->trim), 1), "deg");
    add_row(t, "Displaced volume", s->at.volume, "m\302\263");
    add_row(t, "Displacement", s->at.volume * density / 1000, "t");
    add_row(t, "Centre of buoyancy B, x", but_rounding(s->centre_of_buoyancy.x, s->length_overall), "m");
    add_row(t, "KB", s->kb, "m");
    add_row(t, "Water plane", s->at.waterplane_area, "m\302\262");
    add_row(t, "Centre of flotation F, x", but_rounding(s->centre_of_flotation.x, s->length_overall), "m");
    add_row(t, "Wetted surface", s->at.wetted_area, "m\302\262");
    add_row(t, "KG", s->kg, "m");
    add_row(t, "BM transverse", s->bm_transverse, "m");
    add_row(t, "GM transverse", s->gm_transverse, "m");
    add_row(t, "BM longitudinal", s->bm_longitudinal, "m");
    add_row(t, "GM longitudinal", s->gm_longitudinal, "m");
    add_row(t, "Block coefficient", s->block, "");
    add_row(t, "Waterplane coefficient", s->waterplane, "");
    add_row(t, "Midship coefficient", s->midship, "");
    add_row(t, "Prismatic coefficient", s->prismatic, "");
}

fram_status fram_hull_draw(const fram_hull *h, const fram_hull_condition *condition, const char *title,
                           const char *path, fram_error *error)
{
    fram_hull_condition c;
    hull_attitude a;
    hull_stability s;
    fram_status status = REFUSE_NULL(error, {"path", path});
    if (status == FRAM_OK)
        status = find_stability(h, condition, &c, &a, &s, error);
    if (status == FRAM_OK)
        status = path_refuse_read(h->path, path, "path", error);
    if (status != FRAM_OK)
        return status;
    view_table table = {.count = 0};
    fill_table(&table, &s, &a, c.water_density);
    char caption[200];
    int at = snprintf(caption, sizeof caption, "%s, %d triangles; water of %g kg/m\302\263 at z = %.4g m",
                      h->about.format, h->about.triangles, c.water_density, a.level);
    if (h->pieces.count && at > 0 && (size_t)at < sizeof caption)
        snprintf(caption + at, sizeof caption - (size_t)at, "; %d convex piece%s within %.3g m of the surface",
                 (int)h->pieces.count, h->pieces.count == 1 ? "" : "s", h->concavity);
    const hull_view view = {.surface = &h->surface,
                            .pieces = &h->pieces,
                            .attitude = a,
                            .stability = &s,
                            .title = title ? title : "Hull",
                            .caption = caption,
                            .names = table.names,
                            .values = table.values,
                            .lines = table.count};
    return hull_view_write(&h->context->inner, &view, path, error);
}

fram_status fram_hull_save(const fram_hull *h, const char *path, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"hull", h}, {"path", path});
    if (status == FRAM_OK)
        status = path_refuse_read(h->path, path, "path", error);
    if (status != FRAM_OK)
        return status;
    return hull_file_write(&h->context->inner, path, &h->surface, error);
}
