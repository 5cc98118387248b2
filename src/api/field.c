/* Ice fields of the public API. */
#include "fram/field.h"

#include "api/arguments.h"
#include "api/field_handle.h"
#include "io/geojson.h"
#include "io/outline_file.h"

#include <math.h>

_Static_assert((int)FRAM_FIELD_BINS == (int)IMPORT_HISTOGRAM_BINS, "one number of bins");
_Static_assert((int)FRAM_FIELD_REPAIR == (int)IMPORT_REPAIR, "the same order of choices");

static void fram_field_fill(fram_field_definition *d) { *d = (fram_field_definition){.size = sizeof *d, .scale = 1}; }
DEFINITION_DEFAULT(fram_field, fram_field_definition)

/* ---- making ---- */

static fram_status check(const fram_field_definition *d, fram_error *error)
{
    if (!(d->scale > 0 && d->scale < HUGE_VAL))
        return error_value(error, "scale", "a number over 0", d->scale);
    if (!(d->simplify >= 0 && d->simplify < HUGE_VAL))
        return error_value(error, "simplify", "a distance of 0 m or more", d->simplify);
    if (!(d->smallest_area >= 0 && d->smallest_area < HUGE_VAL))
        return error_value(error, "smallest_area", "an area of 0 m2 or more", d->smallest_area);
    if ((int)d->bad < FRAM_FIELD_REFUSE || d->bad > FRAM_FIELD_REPAIR)
        return error_value(error, "bad", "one of fram_field_bad", (double)(int)d->bad);
    for (int k = 0; k < 2; k++) {
        if (!isfinite(d->offset[k]))
            return error_value(error, "offset", "finite lengths", d->offset[k]);
        if (d->crop && !(isfinite(d->crop_lo[k]) && isfinite(d->crop_hi[k]) && d->crop_lo[k] < d->crop_hi[k]))
            return error_value(error, "crop", "a window whose lower corner is below its upper one", d->crop_lo[k]);
    }
    return FRAM_OK;
}

static box2 window_of(const fram_field_definition *d)
{
    return (box2){{d->crop_lo[0], d->crop_lo[1]}, {d->crop_hi[0], d->crop_hi[1]}};
}

static double box_area(box2 b) { return (b.hi.x - b.lo.x) * (b.hi.y - b.lo.y); }

/* Of the file that the floes are of or, where there is none, of one that is written. */
static import_place place_of(const fram_field *f, int32_t floe)
{
    if (f->source.place.count == 0)
        return (import_place){.feature = floe + 1, .polygon = floe >= 0};
    bool drawn = floe < 0 || floe >= f->floes.ring.count;
    return drawn ? (import_place){0} : f->source.place.data[f->floes.ring.data[floe]];
}

fram_status field_describe(fram_field *f, overlay *plane, const char *name, fram_error *error)
{
    import_measure measure;
    const import_measure *m = &measure;
    fram_status status = import_field_measure(&f->context->inner, plane, name, &f->floes.outlines, &measure, error);
    if (status != FRAM_OK)
        return status;
    f->window = f->made.crop ? window_of(&f->made) : f->generated ? f->window : m->bounds;
    double window = box_area(f->window);
    const import_place a = place_of(f, m->overlap_pair[0]), b = place_of(f, m->overlap_pair[1]);
    f->about = (fram_field_summary){
        .rings = f->source.place.count,
        .floes = m->floes,
        .vertices = m->vertices,
        .concave = m->concave,
        .lo = {m->bounds.lo.x, m->bounds.lo.y},
        .hi = {m->bounds.hi.x, m->bounds.hi.y},
        .area = m->area,
        .concentration = m->area / window,
        .largest_diameter = m->largest_diameter,
        .smallest_area = m->smallest_area,
        .largest_area = m->largest_area,
        .overlaps = m->overlaps,
        .overlap_area = m->overlap_area,
        .overlap_width = m->overlap_width,
        .passed_over = f->source.passed_over,
        .overlap_features = {a.feature, b.feature},
        .overlap_polygons = {a.polygon, b.polygon},
    };
    for (int32_t i = 0; i < f->floes.notes.count; i++)
        *(f->floes.notes.data[i].dropped ? &f->about.dropped : &f->about.repaired) += 1;
    for (int i = 0; i <= FRAM_FIELD_BINS; i++)
        f->about.bin_edge[i] = m->edge[i];
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        f->about.bin[i] = m->bin[i];
    return FRAM_OK;
}

static fram_status make(fram_field *f, overlay *plane, const char *path, fram_error *error)
{
    context *ctx = &f->context->inner;
    const fram_field_definition *d = &f->made;
    const import_options options = {.name = path,
                                    .degrees = d->degrees,
                                    .scale = d->scale,
                                    .lengths = d->lengths,
                                    .centre = d->centre,
                                    .offset = {d->offset[0], d->offset[1]},
                                    .crop = d->crop,
                                    .domain = window_of(d),
                                    .window = true,
                                    .simplify = d->simplify,
                                    .bad = (import_bad)d->bad,
                                    .smallest_area = d->smallest_area};
    char read[PATH_ROOM];
    if (path_absolute(path, read, sizeof read))
        text_add_bytes(ctx, &f->read, read, strlen(read) + 1);
    fram_status status = f->read.failed ? error_memory(error) : FRAM_OK;
    if (status == FRAM_OK)
        status = outline_file_read(ctx, path, &f->source, error);
    if (status == FRAM_OK)
        status = import_field_make(ctx, plane, &f->source, &options, &f->floes, error);
    return status == FRAM_OK ? field_describe(f, plane, path, error) : status;
}

fram_status fram_field_load(fram_context *c, const char *path, const fram_field_definition *definition,
                            fram_field **out, fram_error *error)
{
    fram_field_definition d;
    fram_field_fill(&d);
    fram_status status = REFUSE_NULL(error, {"context", c}, {"path", path}, {"field", out});
    if (status == FRAM_OK && definition)
        status = definition_take(&d, definition, sizeof d, DEFINITION_LEAST, "fram_field", error);
    if (status != FRAM_OK)
        return status;
    status = check(&d, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &c->inner;
    fram_field *f = memory_array(ctx, 1, sizeof *f);
    overlay *plane = f ? overlay_create(ctx) : NULL;
    if (f) {
        f->context = c;
        f->made = d;
    }
    status = plane ? make(f, plane, path, error) : error_memory(error);
    if (plane)
        overlay_free(plane);
    if (status == FRAM_OK)
        *out = f;
    else
        fram_field_destroy(f);
    return status;
}

void fram_field_destroy(fram_field *f)
{
    if (!f)
        return;
    context *ctx = &f->context->inner;
    import_rings_free(ctx, &f->source);
    import_field_free(ctx, &f->floes);
    drawn_ice_free(ctx, &f->drawn);
    text_free(ctx, &f->read);
    memory_free(ctx, f);
}

/* ---- what it is ---- */

void(fram_field_summary_get)(const fram_field *f, fram_field_summary *summary, size_t size)
{
    static const fram_field_summary none = {0};
    if (RESULT_CHECK(summary, size, fram_field_summary, NULL) == FRAM_OK)
        result_give(summary, size, f ? &f->about : &none);
}

int(fram_field_notes)(const fram_field *f, fram_field_note *notes, int room, size_t size)
{
    if (!f || RESULT_CHECK(notes, size, fram_field_note, NULL) != FRAM_OK)
        return 0;
    for (int32_t i = 0; notes && i < f->floes.notes.count && i < room; i++) {
        const import_note *note = &f->floes.notes.data[i];
        const import_place *place = &f->source.place.data[note->ring];
        const fram_field_note full = {.feature = place->feature,
                                      .polygon = place->polygon,
                                      .ring = place->ring,
                                      .line = place->line,
                                      .dropped = note->dropped,
                                      .reason = import_event_text(note->event, f->made.crop),
                                      .outside = note->event == IMPORT_NOTE_OUTSIDE};
        result_give(result_row(notes, size, i), size, &full);
    }
    return f->floes.notes.count;
}

int fram_field_outline(const fram_field *f, int floe, double *vertices, int room)
{
    if (!f || floe < 0 || floe >= polygon_list_count(&f->floes.outlines))
        return 0;
    polygon p = polygon_list_get(&f->floes.outlines, floe);
    for (int32_t i = 0; vertices && i < p.count && i < room; i++) {
        vertices[2 * (size_t)i] = p.vertex[i].x;
        vertices[2 * (size_t)i + 1] = p.vertex[i].y;
    }
    return p.count;
}

/* ---- drawings, files ---- */

fram_status field_check_output(const fram_field *f, const char *path, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"field", f}, {"path", path});
    return status == FRAM_OK ? list_refuse_read(&f->read, path, "path", error) : status;
}

fram_status fram_field_save(const fram_field *f, const char *path, fram_error *error)
{
    fram_status status = field_check_output(f, path, error);
    if (status != FRAM_OK)
        return status;
    context *ctx = &f->context->inner;
    status = geojson_write(ctx, path, &f->floes.outlines, f->floes.thickness.data, error);
    if (status == FRAM_OK && f->other_ice)
        log_write(ctx, LOG_WARNING,
                  "%s: the file keeps outlines and thickness, not the strengths of ice.populations nor which floes "
                  "break: a scenario that reads it gives all floes its own ice.flexural_strength, "
                  "ice.crushing_strength and ice.breakable",
                  path);
    return status;
}
