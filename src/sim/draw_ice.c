#include "sim/draw_ice.h"

#include "base/number_text.h"
#include "ice/field_cells.h"
#include "io/outline_file.h"
#include "sim/build_ice.h"
#include "sim/build_keep_out.h"
#include "sim/build_packed.h"
#include "sim/usual.h"

#include <math.h>

void drawn_ice_free(context *ctx, drawn_ice *d)
{
    polygon_list_free(ctx, &d->outlines);
    array_free(ctx, &d->traits);
    array_free(ctx, &d->shapes);
    array_free(ctx, &d->parts);
    import_rings_free(ctx, &d->source);
    import_field_free(ctx, &d->file);
}

floe_traits scenario_traits(const scenario *s, double thickness)
{
    return (floe_traits){automatic_or(thickness, s->ice.thickness), s->ice.flexural_strength, s->ice.crushing_strength,
                         s->ice.breakable};
}

/* No floe of the field is thicker; HUGE_VAL: they scatter. */
static double thickest_drawn(const scenario *s, const import_rings *file)
{
    double most = s->ice.source == ICE_FILE || s->ice.populations.count > 0 ? 0 : s->ice.thickness;
    for (int32_t i = 0; i < file->place.count; i++)
        most = fmax(most, scenario_traits(s, file->place.data[i].thickness).thickness);
    for (int32_t i = 0; i < s->ice.populations.count; i++) {
        const scenario_population *p = &s->ice.populations.data[i];
        most = p->thickness_deviation > 0 ? HUGE_VAL : fmax(most, scenario_traits(s, p->thickness).thickness);
    }
    return most;
}

/* Zones that the field is made without: an endless field is made whole, and cut where it is first seen. */
static fram_status find_keep_out(context *ctx, const scenario *s, const world *w, const import_rings *file,
                                 polygon_list *out, fram_error *error)
{
    bool whole = s->domain.boundary == DOMAIN_FEEDING;
    return whole ? FRAM_OK : build_keep_out(ctx, s, w, thickest_drawn(s, file), out, error);
}

static fram_status draw_voronoi(context *ctx, const scenario *s, world *w, const polygon_list *keep_out, drawn_ice *out,
                                fram_error *error)
{
    field_request request = {.domain = domain_box(&s->domain),
                             .concentration = s->ice.concentration,
                             .mean_area = s->ice.mean_floe_area,
                             .size_deviation = s->ice.size_deviation,
                             .roundness = s->ice.roundness,
                             .seed = (uint64_t)s->run.seed,
                             .smallest_area = s->ice.smallest_floe_area,
                             .keep_out = keep_out,
                             .periodic = s->domain.boundary == DOMAIN_FEEDING};
    if (s->ice.populations.count > 0)
        return draw_managed(ctx, s, w, request, out, error);
    fram_status status = field_voronoi(ctx, &request, &out->outlines, &out->report, error);
    if (status == FRAM_ERROR_INPUT)
        name_ice_request(s, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&out->outlines); i++)
        if (!array_push(ctx, &out->traits, scenario_traits(s, (double)NAN)))
            status = error_memory(error);
    return status;
}

/* ---- observed floes ---- */

static void log_notes(context *ctx, const scenario *s, const import_rings *rings, const import_field *field)
{
    if (rings->walls > 0 && s->domain.boundary != DOMAIN_WALLS)
        log_write(ctx, LOG_WARNING,
                  "%.200s: %d feature%s of kind wall %s no ice and %s passed over, and the domain has no walls: "
                  "domain.boundary: walls makes it a basin",
                  s->ice.file, (int)rings->walls, rings->walls == 1 ? "" : "s", rings->walls == 1 ? "is" : "are",
                  rings->walls == 1 ? "was" : "were");
    if (rings->passed_over > 0)
        log_write(ctx, LOG_INFO, "%d feature%s of kind vessel or wall %s no ice and %s passed over",
                  (int)rings->passed_over, rings->passed_over == 1 ? "" : "s", rings->passed_over == 1 ? "is" : "are",
                  rings->passed_over == 1 ? "was" : "were");
    for (int32_t i = 0; i < field->notes.count; i++) {
        const import_note *n = &field->notes.data[i];
        char name[IMPORT_NAME_SIZE];
        import_place_name(&rings->place.data[n->ring], name);
        log_write(ctx, LOG_DEBUG, "%s (%.9g, %.9g): %s; %s", name, n->at.x, n->at.y, import_event_text(n->event, false),
                  n->dropped ? "left out" : "mended");
    }
}

/* Of thicknesses that stand in the file, as of ice.thickness. */
static void tell_thickness(context *ctx, const scenario *s, const import_field *field)
{
    const usual_range usual = usual_range_of(s, "ice.thickness");
    const range_text range = range_text_of(usual.least, usual.most, 3);
    int32_t beyond = 0, first = -1;
    for (int32_t i = 0; i < field->thickness.count; i++) {
        double h = field->thickness.data[i];
        if (isnan(h) || (h >= usual.least && h <= usual.most))
            continue;
        first = beyond++ == 0 ? i : first;
    }
    if (beyond > 0)
        log_write(ctx, LOG_WARNING,
                  "%.200s: the property thickness of %d floe%s, the first %.6g m, is outside of %s to %s, what floes "
                  "measure: give metres",
                  s->ice.file, (int)beyond, beyond == 1 ? "" : "s", field->thickness.data[first], range.least.text,
                  range.most.text);
}

/* What became of the file: counts of what was left out and mended, overlaps, concentration. */
static fram_status report_import(context *ctx, const scenario *s, world *w, const char *path,
                                 const polygon_list *keep_out, const import_field *field, field_report *report,
                                 fram_error *error)
{
    import_measure m;
    fram_status status = import_field_measure(ctx, w->scratch.plane, path, &field->outlines, &m, error);
    if (status != FRAM_OK)
        return status;
    box2 d = domain_box(&s->domain);
    const vec2 corner[4] = {d.lo, {d.hi.x, d.lo.y}, d.hi, {d.lo.x, d.hi.y}};
    double free_area;
    status = cells_area_outside(ctx, (polygon){corner, 4}, keep_out, &free_area, error);
    if (status != FRAM_OK)
        return status;
    *report = (field_report){.floes = m.floes,
                             .concentration = m.area / free_area,
                             .free_area = free_area,
                             .largest_overlap = m.overlap_width};
    int32_t dropped = 0;
    for (int32_t i = 0; i < field->notes.count; i++)
        dropped += field->notes.data[i].dropped;
    log_write(ctx, LOG_INFO, "%d floe%s from %.200s, %d of them concave; %d rings or pieces left out, %d mendings",
              (int)m.floes, m.floes == 1 ? "" : "s", s->ice.file, (int)m.concave, (int)dropped,
              (int)(field->notes.count - dropped));
    /* Within the skin lies what contacts and rounding leave of floes that a run wrote. */
    if (m.overlap_width > s->run.solver.contact_skin)
        log_write(
            ctx, LOG_WARNING,
            "%d pairs of floes overlap, by %.3g m at most: they will push each other apart; ice.bad_rings: repair "
            "cuts them apart",
            (int)m.overlaps, m.overlap_width);
    else if (m.overlaps)
        log_write(ctx, LOG_INFO, "%d pairs of floes overlap, by %.3g m at most, which is less than the contact skin",
                  (int)m.overlaps, m.overlap_width);
    return FRAM_OK;
}

static fram_status read_file(context *ctx, const scenario *s, char path[SCENARIO_PATH_ROOM], import_rings *out,
                             fram_error *error)
{
    fram_status status = scenario_file_path(s, "ice.file", s->ice.file, path, error);
    return status == FRAM_OK ? outline_file_read(ctx, path, out, error) : status;
}

/* path: of the file, whose rings were read. */
static fram_status draw_file(context *ctx, const scenario *s, world *w, const char *path, const polygon_list *keep_out,
                             drawn_ice *out, fram_error *error)
{
    import_rings *rings = &out->source;
    import_field *field = &out->file;
    const import_options options = {.name = path,
                                    .degrees = s->ice.file_coordinates == FILE_DEGREES,
                                    .scale = s->ice.file_scale,
                                    .lengths = build_is_of_tank(s),
                                    .say_lengths = BUILD_SAY_TANK,
                                    .centre = s->ice.file_centre,
                                    .offset = {s->ice.file_x, s->ice.file_y},
                                    .crop = true,
                                    .tile = s->domain.boundary == DOMAIN_FEEDING,
                                    .domain = domain_box(&s->domain),
                                    .simplify = s->ice.simplify,
                                    .bad = s->ice.bad_rings,
                                    .smallest_area = s->ice.smallest_floe_area,
                                    .keep_out = keep_out};
    fram_status status = import_field_make(ctx, w->scratch.plane, rings, &options, field, error);
    polygon_list_free(ctx, &rings->rings);
    if (status == FRAM_OK) {
        log_notes(ctx, s, rings, field);
        tell_thickness(ctx, s, field);
        status = report_import(ctx, s, w, path, keep_out, field, &out->report, error);
    }
    for (int32_t i = 0; status == FRAM_OK && i < field->thickness.count; i++)
        if (!array_push(ctx, &out->traits, scenario_traits(s, field->thickness.data[i])))
            status = error_memory(error);
    out->outlines = field->outlines;
    field->outlines = (polygon_list){0};
    return status;
}

/* ---- any ---- */

fram_status draw_ice(context *ctx, const scenario *s, world *w, drawn_ice *out, fram_error *error)
{
    polygon_list keep_out = {0};
    char path[SCENARIO_PATH_ROOM];
    fram_status status = s->ice.source == ICE_FILE ? read_file(ctx, s, path, &out->source, error) : FRAM_OK;
    if (status == FRAM_OK)
        status = find_keep_out(ctx, s, w, &out->source, &keep_out, error);
    if (status == FRAM_OK && s->ice.source == ICE_VORONOI)
        status = draw_voronoi(ctx, s, w, &keep_out, out, error);
    if (status == FRAM_OK && s->ice.source == ICE_FILE)
        status = draw_file(ctx, s, w, path, &keep_out, out, error);
    out->placed = polygon_list_count(&out->outlines);
    if (status == FRAM_OK && s->ice.source != ICE_VORONOI && s->ice.populations.count > 0)
        status = draw_populations(ctx, s, w, &keep_out, out, error);
    polygon_list_free(ctx, &keep_out);
    return status;
}
