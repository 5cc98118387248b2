/* The steps from a file's triangles to a sound solid; see hull_mend.h. */
#include "io/hull_mend.h"

#include "io/hull_digits.h"
#include "io/hull_lids.h"
#include "io/hull_mirror.h"
#include "io/hull_skin.h"
#include "io/hull_top.h"

#include <stdio.h>
#include <string.h>

/* Default freeboard of topsides, as a part of the depth under them. */
#define DEFAULT_FREEBOARD (1.0 / 3)
/* A surface that encloses less than this part of the cube of its longest side encloses nothing. */
#define LEAST_VOLUME 1e-12

/* A surface while it is worked on. */
typedef struct hull_reading {
    context *ctx;
    const char *name;
    mesh_file *file;
    const mesh *given; /* its surface as it was read */
    const hull_file_options *options;
    double seal_width; /* [m] */
    double level;      /* by which corners of a top may be off its plane [m] */
    bool fill;         /* holes */
    bool lids_off;     /* lids off z = 0 are left out */
    hull_outcome *out;
    int32_array source; /* face of the file that each face was cut from */
    mesh_rims rims;
    double longest, top, reach, widest; /* [m] */
} hull_reading;

/* ---- errors ---- */

enum { KEY_ROOM = 64 };

/* "facet 12": what a face of the surface as it is now is in the file; returns its line.  "" and 0: it is nothing. */
static int32_t name_face(const hull_reading *r, int32_t face, char key[KEY_ROOM])
{
    key[0] = '\0';
    if (face < 0 || face >= r->source.count || r->source.data[face] >= r->file->element.count)
        return 0;
    int32_t in_file = r->source.data[face];
    snprintf(key, KEY_ROOM, "%s %d", mesh_format_element(r->file->format), r->file->element.data[in_file]);
    return r->file->line.data[in_file];
}

/* An error at a face of the surface as it is now, named as in the file. */
static fram_status refuse_face(const hull_reading *r, int32_t face, const char *text, const char *advice)
{
    char key[KEY_ROOM];
    int32_t line = name_face(r, face, key);
    return error_set(&r->out->error, FRAM_ERROR_INPUT, r->name, line, key[0] ? key : "mesh", "%s; %s", text, advice);
}

/* What is to be done outside of Fram. */
static const char *work_for(mesh_defect defect)
{
    switch (defect) {
    case MESH_OPEN:
        return "close the gap in the program that made the file";
    case MESH_INCONSISTENT:
    case MESH_INSIDE_OUT:
        return "turn the triangles concerned in the program that made the file";
    case MESH_NOT_MANIFOLD:
        return "remove inner walls, decks and lids, and unite parts that share an edge, in the program that made the "
               "file: a hull is one closed skin";
    case MESH_SELF_INTERSECTING:
        return "unite the parts that cross or touch (a boolean union) in the program that made the file";
    default:
        return "correct it in the program that made the file";
    }
}

enum { ADVICE_ROOM = 200 };

/* false: it is not for its digits that the file is refused. */
static bool advise_digits(const hull_reading *r, int32_t face, int32_t other, char text[ADVICE_ROOM])
{
    const int32_t faces[2] = {face, other};
    return hull_lacks_digits(r->given, r->options->scale, &r->file->surface, faces, text, ADVICE_ROOM);
}

static void advise(const hull_reading *r, mesh_defect defect, char text[ADVICE_ROOM])
{
    static const char *const lines[] = {
        [HULL_WHOLE] = "", [HULL_HALF_X] = "ISX", [HULL_HALF_Y] = "ISY", [HULL_QUARTER] = "ISX and ISY"};
    const hull_half half = r->out->half;
    /* Meshes that are counted from a perpendicular have an open transom there. */
    const char *or_end = half == HULL_HALF_X ? ", or have it repaired (repair) if that is its end" : "";
    if (defect != MESH_OPEN || half == HULL_WHOLE)
        snprintf(text, ADVICE_ROOM, "%s", work_for(defect));
    else if (r->file->format == MESH_GDF)
        snprintf(text, ADVICE_ROOM, "it is %s: set %s to 1 in the third line of the file%s", hull_half_words(half),
                 lines[half], or_end);
    else
        snprintf(text, ADVICE_ROOM, "it is %s: mirror it there in the program that made the file%s",
                 hull_half_words(half), or_end);
}

/* The corner of a face that is not in its edge from a to b; -1 where the face does not run along that. */
static int32_t corner_off(const mesh *m, int32_t face, int32_t a, int32_t b)
{
    const int32_t *v = m->face.data[face].v;
    for (int k = 0; k < 3; k++)
        if (v[k] == a && v[(k + 1) % 3] == b)
            return v[(k + 2) % 3];
    return -1;
}

/* Two faces along the edge from a to b that have the same corners. */
static bool find_twins_along(const mesh *m, int32_t a, int32_t b, int32_t twin[2])
{
    for (twin[0] = 0; twin[0] < m->face.count; twin[0]++) {
        int32_t off = corner_off(m, twin[0], a, b);
        for (twin[1] = twin[0] + 1; off >= 0 && twin[1] < m->face.count; twin[1]++)
            if (corner_off(m, twin[1], a, b) == off)
                return true;
    }
    return false;
}

/* Those that turn unlike are no twins but the two sides of a wall or deck, and with one of them that would still be
   there. */
static bool find_twins(const mesh *m, const int32_t edge[2], int32_t twin[2])
{
    return find_twins_along(m, edge[0], edge[1], twin) || find_twins_along(m, edge[1], edge[0], twin);
}

static fram_status refuse_twins(const hull_reading *r, const int32_t twin[2])
{
    char one[KEY_ROOM], other[KEY_ROOM], text[128];
    name_face(r, twin[0], one);
    name_face(r, twin[1], other);
    bool image = other[0] && strcmp(one, other) == 0 && (r->file->mirror_x || r->file->mirror_y);
    snprintf(text, sizeof text, "it has the corners of %s",
             image      ? "its own mirror image"
             : other[0] ? other
                        : "another triangle");
    return refuse_face(r, twin[0], text, "leave one of the two out in the program that made the file");
}

static fram_status refuse_report(hull_reading *r, const mesh_report *report)
{
    r->out->defect = report->defect;
    int32_t twin[2];
    char text[256], advice[ADVICE_ROOM];
    if (report->defect == MESH_NOT_MANIFOLD && find_twins(&r->file->surface, report->edge, twin))
        return refuse_twins(r, twin);
    if (report->open_edges > 1)
        snprintf(text, sizeof text, "the %s (one of %d open edges)", report->text, report->open_edges);
    else
        snprintf(text, sizeof text, "the %s", report->text);
    if (report->defect != MESH_SELF_INTERSECTING || !advise_digits(r, report->face, report->other_face, advice))
        advise(r, report->defect, advice);
    return refuse_face(r, report->face, text, advice);
}

/* ---- steps ---- */

static void scale_surface(const hull_reading *r)
{
    mesh *m = &r->file->surface;
    for (int32_t i = 0; i < m->vertex.count && r->options->scale != 1; i++)
        m->vertex.data[i] = vec3_scale(m->vertex.data[i], r->options->scale);
}

bool hull_count_lids(context *ctx, const mesh *m, int32_t *count)
{
    const hull_lids lids = hull_lids_of(m);
    int32_array off = {0};
    int32_t in_plane = 0;
    for (int32_t f = 0; f < m->face.count; f++)
        in_plane += hull_is_lid(&lids, m, f);
    bool done = hull_find_lids_off(ctx, m, &off, count);
    *count = in_plane > 0 ? in_plane : *count;
    array_free(ctx, &off);
    return done;
}

/* Leave out lids in z = 0 and, where repair is asked for, triangles without area;
 * sealing closes the gaps, which have no width.
 */
static fram_status drop_triangles(hull_reading *r)
{
    mesh *m = &r->file->surface;
    int32_t kept = 0;
    const hull_lids lids = r->file->format == MESH_GDF ? hull_lids_of(m) : (hull_lids){.any = false};
    for (int32_t f = 0; f < m->face.count; f++) {
        bool lid = hull_is_lid(&lids, m, f), flat = !lid && !mesh_has_area(m, f);
        if (flat && !r->options->repair) {
            vec3 p = m->vertex.data[m->face.data[f].v[0]];
            char key[KEY_ROOM], advice[ADVICE_ROOM] = "move a corner of it, or leave it out";
            snprintf(key, sizeof key, "%s %d", mesh_format_element(r->file->format), r->file->element.data[f]);
            advise_digits(r, f, -1, advice);
            return error_set(&r->out->error, FRAM_ERROR_INPUT, r->name, r->file->line.data[f], key,
                             "a triangle at (%g, %g, %g) has no area; %s", p.x, p.y, p.z, advice);
        }
        r->out->report.lids += lid;
        r->out->report.dropped += flat;
        if (lid || flat)
            continue;
        m->face.data[kept] = m->face.data[f];
        r->file->element.data[kept] = r->file->element.data[f];
        r->file->line.data[kept++] = r->file->line.data[f];
    }
    m->face.count = r->file->element.count = r->file->line.count = kept;
    return FRAM_OK;
}

static fram_status seal(hull_reading *r)
{
    r->out->report.seal_width = r->seal_width;
    if (mesh_seal(r->ctx, &r->file->surface, r->seal_width, &r->source, &r->out->report.seal) != FRAM_OK ||
        !mesh_drop_unused_vertices(r->ctx, &r->file->surface))
        return error_memory(&r->out->error);
    return FRAM_OK;
}

static fram_status orient(hull_reading *r)
{
    int32_t flipped = 0, face = -1;
    if (!r->options->repair)
        return FRAM_OK;
    fram_status status = mesh_orient(r->ctx, &r->file->surface, &flipped, &face);
    r->out->report.flipped += flipped;
    r->out->one_sided = status == FRAM_ERROR_INPUT;
    if (r->out->one_sided)
        return refuse_face(r, face, "the surface has only one side (a Moebius band) where this triangle is",
                           "rebuild it in the program that made the file");
    return status == FRAM_ERROR_MEMORY ? error_memory(&r->out->error) : status;
}

/* Of a surface that is closed as it is: lids a little off the water plane.  What is open under them is level within
   reach then. */
static fram_status drop_lids_off(hull_reading *r)
{
    mesh *m = &r->file->surface;
    int32_array lid = {0};
    int32_t count = 0, kept = 0;
    bool done = hull_find_lids_off(r->ctx, m, &lid, &count);
    for (int32_t f = 0; f < m->face.count && done && count > 0; f++) {
        if (lid.data[f] >= 0)
            continue;
        m->face.data[kept] = m->face.data[f];
        r->source.data[kept++] = r->source.data[f];
    }
    if (done && count > 0) {
        m->face.count = r->source.count = kept;
        r->out->report.lids += count;
        r->level = r->reach;
        done = mesh_drop_unused_vertices(r->ctx, m);
    }
    array_free(r->ctx, &lid);
    r->lids_off = count > 0;
    return done ? FRAM_OK : error_memory(&r->out->error);
}

static void turn_all(hull_reading *r)
{
    mesh *m = &r->file->surface;
    for (int32_t f = 0; f < m->face.count; f++) {
        int32_t *v = m->face.data[f].v, swap = v[1];
        v[1] = v[2];
        v[2] = swap;
    }
    r->out->report.flipped += m->face.count;
}

/* By how much a top is raised [m]; 0: it is decked where it is, as hulls are that end above the water already.  NaN: it
   stays open. */
static double freeboard_of(const hull_reading *r, const hull_top *top)
{
    const hull_file_options *o = r->options;
    const bool ends_at_water = r->file->format == MESH_GDF, decides = ends_at_water || !isnan(o->usual_freeboard);
    if (!isnan(o->freeboard))
        return o->freeboard;
    if (decides && top->above)
        return 0;
    if (isnan(o->usual_freeboard) && ends_at_water)
        return DEFAULT_FREEBOARD * (r->top - mesh_bounds(&r->file->surface).lo.z);
    return o->usual_freeboard;
}

static fram_status close_top(hull_reading *r, hull_top *top, double freeboard)
{
    hull_file_report *report = &r->out->report;
    if (top->area < 0 && !r->options->repair)
        return refuse_face(r, 0, "the surface under the open top is turned the wrong way, inside out",
                           "corners run counter-clockwise seen from the water");
    if (top->area < 0) {
        turn_all(r);
        hull_turn_top(top);
    }
    hull_level_top(&r->file->surface, top, r->level);
    fram_status status = hull_close_top(r->ctx, &r->file->surface, top, freeboard, &r->out->error);
    report->freeboard = freeboard;
    report->decked = freeboard > 0 ? 0 : fabs(top->area);
    if (status == FRAM_ERROR_INPUT) {
        r->out->defect = MESH_OPEN;
        snprintf(r->out->error.file, sizeof r->out->error.file, "%s", r->name);
    }
    return status;
}

static fram_status raise_top(hull_reading *r)
{
    hull_top top = {.z = 0};
    if (!hull_find_top(r->ctx, &r->file->surface, &r->rims, r->level, &top)) {
        hull_top_free(r->ctx, &top);
        return error_memory(&r->out->error);
    }
    const bool any = mesh_rims_count(&top.rims) > 0;
    const double freeboard = any ? freeboard_of(r, &top) : (double)NAN;
    r->out->report.top = any && top.above ? top.z : 0;
    fram_status status = isnan(freeboard) ? FRAM_OK : close_top(r, &top, freeboard);
    if (status == FRAM_OK && r->lids_off && mesh_rims_count(&top.rims) < mesh_rims_count(&r->rims))
        status = refuse_face(r, 0, "the surface under its lids has no level top", work_for(MESH_OPEN));
    hull_top_free(r->ctx, &top);
    return status;
}

/* Of a sound surface. */
static fram_status keep_skin(hull_reading *r)
{
    hull_inside inside;
    if (!hull_keep_outer_skin(r->ctx, &r->file->surface, &inside))
        return error_memory(&r->out->error);
    r->out->report.inner_parts = inside.parts;
    r->out->report.inner_volume = inside.volume;
    bool found = hull_find_well(r->ctx, &r->file->surface, &r->out->report.well);
    return found ? FRAM_OK : error_memory(&r->out->error);
}

static fram_status check(hull_reading *r)
{
    mesh_report report;
    if (mesh_check(r->ctx, &r->file->surface, true, &report) != FRAM_OK)
        return error_memory(&r->out->error);
    if (report.defect != MESH_CLOSED)
        return refuse_report(r, &report);
    double box = r->longest * r->longest * r->longest, volume = mesh_solid_properties(&r->file->surface).volume;
    if (volume > LEAST_VOLUME * box)
        return keep_skin(r);
    return error_set(
        &r->out->error, FRAM_ERROR_INPUT, r->name, 0, "mesh",
        "the surface encloses no volume (%g m3); give the plate a thickness in the program that made the file", volume);
}

static fram_status find_rims(hull_reading *r)
{
    int32_t edge = -1;
    fram_status status = mesh_rims_find(r->ctx, &r->file->surface, &r->rims, &edge);
    if (status == FRAM_ERROR_INPUT) /* triangles turn unlike ways, or inner walls
                                       end here: the check says where */
        return check(r);
    return status == FRAM_ERROR_MEMORY ? error_memory(&r->out->error) : status;
}

static fram_status fill_holes(hull_reading *r)
{
    mesh *m = &r->file->surface;
    fram_status status = r->fill ? find_rims(r) : FRAM_OK;
    for (int32_t i = 0; r->fill && i < mesh_rims_count(&r->rims) && status == FRAM_OK; i++) {
        const int32_t *ring = r->rims.vertex.data + r->rims.start.data[i];
        int32_t count = r->rims.start.data[i + 1] - r->rims.start.data[i];
        if (!r->out->end)
            r->out->end = hull_ends_in(m, ring, count, r->widest);
        status = mesh_add_polygon(r->ctx, m, ring, count);
        if (status == FRAM_OK) {
            r->out->report.holes++;
            r->out->report.hole_area += vec3_length(mesh_ring_area(m, ring, count));
        } else if (status == FRAM_ERROR_MEMORY) {
            error_memory(&r->out->error);
        } else {
            vec3 p = m->vertex.data[ring[0]];
            error_set(&r->out->error, status, r->name, 0, "mesh",
                      "the hole of %d edges that begins at (%g, %g, %g) is too crooked to be filled; %s", count, p.x,
                      p.y, p.z, work_for(MESH_OPEN));
        }
    }
    return status;
}

static fram_status find_half(hull_reading *r)
{
    bool done = hull_find_half(r->ctx, &r->file->surface, r->reach, &r->out->half);
    return done ? FRAM_OK : error_memory(&r->out->error);
}

static fram_status finish_hull(hull_reading *r)
{
    scale_surface(r);
    r->longest = hull_longest_side(&r->file->surface);
    r->reach = HULL_REACH * r->longest;
    r->widest = HULL_WIDEST_SEAL * r->longest;
    const bool may_drop = r->lids_off;
    r->lids_off = false;
    fram_status status = drop_triangles(r);
    if (status == FRAM_OK)
        status = seal(r);
    if (status == FRAM_OK)
        status = orient(r);
    const bool open = r->out->report.seal.open_after > 0;
    if (status == FRAM_OK && may_drop && !open)
        status = drop_lids_off(r);
    r->top = mesh_bounds(&r->file->surface).hi.z;
    if (status == FRAM_OK && (open || r->lids_off)) {
        status = find_half(r);
        if (status == FRAM_OK)
            status = find_rims(r);
        if (status == FRAM_OK)
            status = raise_top(r);
        if (status == FRAM_OK)
            status = fill_holes(r);
        if (status == FRAM_OK)
            status = orient(r);
    }
    return status == FRAM_OK ? check(r) : status;
}

/* With or without lids off z = 0; *lids_off gets whether there were any. */
static fram_status mend_once(const hull_request *q, double seal_width, double level, bool fill, bool *lids_off,
                             hull_outcome *out)
{
    mesh_file file;
    mesh_free(q->ctx, &out->surface);
    *out = (hull_outcome){.defect = MESH_EMPTY,
                          .report = {.format = q->file->format,
                                     .elements = q->file->elements,
                                     .dropped = q->file->dropped,
                                     .mirror_x = q->file->mirror_x,
                                     .mirror_y = q->file->mirror_y}};
    hull_reading r = {.ctx = q->ctx,
                      .name = q->name,
                      .file = &file,
                      .given = &q->file->surface,
                      .options = &q->options,
                      .seal_width = seal_width,
                      .level = level,
                      .fill = fill,
                      .lids_off = *lids_off,
                      .out = out};
    fram_status status = hull_copy_file(q->ctx, q->file, &file) ? finish_hull(&r) : error_memory(&out->error);
    if (status == FRAM_OK) {
        out->surface = file.surface;
        file.surface = (mesh){0};
    }
    *lids_off = r.lids_off;
    array_free(q->ctx, &r.source);
    mesh_rims_free(q->ctx, &r.rims);
    mesh_file_free(q->ctx, &file);
    return status;
}

fram_status hull_mend(const hull_request *q, double seal_width, double level, bool fill, hull_outcome *out)
{
    bool lids_off = q->file->format == MESH_GDF;
    fram_status status = mend_once(q, seal_width, level, fill, &lids_off, out);
    if (status != FRAM_ERROR_INPUT || !lids_off)
        return status;
    lids_off = false;
    return mend_once(q, seal_width, level, fill, &lids_off, out);
}
