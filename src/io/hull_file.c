/* Hulls from mesh files; see hull_file.h.  As little is sealed as makes the
   surface sound; a refusal names what was tried on this very file and makes it
   sound, or says that nothing of that helps. */
#include "io/hull_file.h"

#include "io/hull_mend.h"
#include "io/hull_mirror.h"
#include "io/hull_top.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Default width of cracks to seal, as a part of the longest side. */
#define DEFAULT_SEAL HULL_REACH
/* Seals that are tried before the default one, as parts of the longest side:
   none, and the rounding of 4-byte floats and of six printed digits. */
static const double narrow_seals[] = {0, 1e-6};
enum { NARROW_SEALS = sizeof narrow_seals / sizeof *narrow_seals };
/* Seals that are tried for a remedy, as multiples of the default one. */
static const double wide_seals[] = {2, 5, 10, HULL_WIDEST_SEAL / DEFAULT_SEAL};
enum { WIDE_SEALS = sizeof wide_seals / sizeof *wide_seals };
/* Freeboard that is tried for a remedy, as a part of the longest side. */
#define REMEDY_FREEBOARD (1.0 / 20)

hull_file_options hull_file_defaults(void)
{
    return (hull_file_options){
        .scale = 1, .seal_width = (double)NAN, .freeboard = (double)NAN, .usual_freeboard = (double)NAN};
}

static fram_status check_options(const hull_file_options *o, fram_error *error)
{
    if (!(o->scale > 0 && o->scale < HUGE_VAL))
        return error_value(error, "scale", "a positive scale", o->scale);
    if (!isnan(o->seal_width) && !(o->seal_width >= 0 && o->seal_width < HUGE_VAL))
        return error_value(error, "seal_width", "a width in metres", o->seal_width);
    if (!isnan(o->freeboard) && !(o->freeboard > 0 && o->freeboard < HUGE_VAL))
        return error_value(error, "freeboard", "a positive height in metres", o->freeboard);
    return FRAM_OK;
}

/* By which part a scale may be off the unit that a file says it is in. */
#define OFF_UNIT 1e-3

/* Lengths that are no metres are scaled to metres, as whoever asks for the hull says too. */
static fram_status check_file_unit(const hull_request *q, fram_error *error)
{
    const mesh_file_unit *u = &q->file->unit;
    if (!u->name || fabs(q->options.scale / u->metres - 1) <= OFF_UNIT)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, q->name, u->line, "mesh",
                     "GRAV %g says that lengths are in %s; give a scale of %g, or convert the file to metres (times "
                     "%g), GRAV to 9.80665",
                     u->gravity, u->name, u->metres, u->metres);
}

/* ---- attempts ---- */

static double length_of(const hull_request *q) { return q->options.scale * hull_longest_side(&q->file->surface); }

static bool may_go_on(fram_status status) { return status != FRAM_OK && status != FRAM_ERROR_MEMORY; }

/* A wider seal may spoil what was sound: what is wrong with a file is told as
 * it is without one, unless it is open. */
static bool tells_more(const hull_outcome *narrow, const hull_outcome *wide)
{
    bool spoilt = wide->one_sided || (wide->defect != MESH_OPEN && wide->defect != MESH_EMPTY);
    return narrow->one_sided || narrow->defect != MESH_OPEN || spoilt;
}

/* As little sealing as makes the surface sound; a width that is given is taken as it is.  Tops that are level to the
   digits of files come first, those that are level within reach then.  Holes are filled when no seal alone helps, after
   the widest one. */
static fram_status attempt_all(const hull_request *q, hull_outcome *out)
{
    bool given = !isnan(q->options.seal_width);
    double length = length_of(q), widest = given ? q->options.seal_width : DEFAULT_SEAL * length;
    double exact = HULL_LEVEL_TOLERANCE * length, reach = HULL_REACH * length;
    hull_outcome narrow = {.defect = MESH_OPEN};
    fram_status status = FRAM_ERROR_INPUT;
    for (int i = 0; i < NARROW_SEALS && !given && may_go_on(status); i++) {
        status = hull_mend(q, narrow_seals[i] * length, exact, false, out);
        narrow = *out;
        narrow.surface = (mesh){0};
    }
    if (may_go_on(status))
        status = hull_mend(q, widest, exact, false, out);
    if (may_go_on(status) && out->defect == MESH_OPEN)
        status = hull_mend(q, widest, reach, false, out);
    if (may_go_on(status) && q->options.repair)
        status = hull_mend(q, widest, reach, true, out);
    for (int i = NARROW_SEALS; i-- > 0 && !given && q->options.repair && may_go_on(status);)
        status = hull_mend(q, narrow_seals[i] * length, reach, true, out);
    if (may_go_on(status) && !given && tells_more(&narrow, out)) {
        out->error = narrow.error;
        out->half = narrow.half;
    }
    out->report.half = status == FRAM_OK ? out->half : HULL_WHOLE;
    return status;
}

/* ---- remedies ---- */

enum { REMEDY_ROOM = 240 };

typedef struct remedy {
    hull_file_options options;
    hull_half unmirrored; /* planes in which the file is not mirrored then */
    bool raises;          /* an open top, which may have been drawn up to the deck already */
    bool walled;          /* not mirrored in x = 0, it ends there: found when it is tried */
    char words[REMEDY_ROOM];
} remedy;

enum { MOST_REMEDIES = WIDE_SEALS + 7 };

/* A file that has both sides already, and is mirrored all the same. */
static int list_unmirrored(const hull_request *q, remedy list[MOST_REMEDIES])
{
    static const char *const names[] = {[HULL_HALF_X] = "ISX", [HULL_HALF_Y] = "ISY", [HULL_QUARTER] = "ISX and ISY"};
    const int mirrored = (q->file->mirror_x ? HULL_HALF_X : 0) | (q->file->mirror_y ? HULL_HALF_Y : 0);
    int n = 0;
    for (int planes = HULL_HALF_X; planes <= HULL_QUARTER; planes++) {
        if ((planes & mirrored) != planes)
            continue;
        list[n].options = q->options;
        list[n].unmirrored = (hull_half)planes;
        snprintf(list[n++].words, sizeof list->words, "the file has both halves already: set %s to 0 in its third line",
                 names[planes]);
    }
    return n;
}

/* What may help, the least first. */
static int list_remedies(const hull_request *q, remedy list[MOST_REMEDIES])
{
    const hull_file_options given = q->options;
    double length = length_of(q), freeboard = REMEDY_FREEBOARD * length;
    int n = list_unmirrored(q, list);
    if (!isnan(given.seal_width)) {
        list[n].options = given;
        list[n].options.seal_width = (double)NAN;
        snprintf(list[n++].words, sizeof list->words, "it is sound when the seal width is left to Fram");
    }
    if (isnan(given.freeboard)) {
        list[n].options = given;
        list[n].raises = true;
        list[n].options.freeboard = freeboard;
        snprintf(list[n++].words, sizeof list->words,
                 "its top is open: give a freeboard, and it is raised and decked "
                 "(it is sound with %.3g m)",
                 freeboard);
    }
    for (int i = 0; i < WIDE_SEALS; i++) {
        double width = wide_seals[i] * DEFAULT_SEAL * length;
        list[n].options = given;
        list[n].options.seal_width = width;
        snprintf(list[n++].words, sizeof list->words, "it is sound with a seal width of %.3g m", width);
    }
    if (!given.repair) {
        list[n].options = given;
        list[n].options.repair = true;
        snprintf(list[n++].words, sizeof list->words, "have it repaired (repair): it is sound then");
    }
    if (!given.repair && isnan(given.freeboard)) {
        list[n].options = given;
        list[n].options.repair = true;
        list[n].options.freeboard = freeboard;
        snprintf(list[n++].words, sizeof list->words, "it is sound with repair and a freeboard of %.3g m together",
                 freeboard);
    }
    return n;
}

static fram_status try_remedy(const hull_request *q, remedy *with, hull_outcome *trial)
{
    hull_request other = *q;
    mesh_file file = {.elements = 0};
    other.options = with->options;
    fram_status status = FRAM_OK;
    if (with->unmirrored != HULL_WHOLE) {
        status = hull_unmirror(q->ctx, q->file, with->unmirrored, &file) ? FRAM_OK : FRAM_ERROR_MEMORY;
        if (status == FRAM_OK && (with->unmirrored & HULL_HALF_Y) && !hull_lies_about_centre(&file.surface))
            status = FRAM_ERROR_INPUT;
        with->walled = (with->unmirrored & HULL_HALF_X) && hull_begins_at_x(&file.surface);
        other.file = &file;
    }
    if (status == FRAM_OK)
        status = attempt_all(&other, trial);
    /* Whatever closes half a hull makes half a ship of it, and a hull that is closed in its water plane is awash. */
    if (status == FRAM_OK && trial->end)
        status = FRAM_ERROR_INPUT;
    else
        trial->end = HULL_ENDS_NOWHERE;
    mesh_free(q->ctx, &trial->surface);
    mesh_file_free(q->ctx, &file);
    return status;
}

/* Where a top that is raised stood above the water before, it may be the deck that is missing there. */
static fram_status add_repair(const hull_request *q, const hull_outcome *raised, char words[REMEDY_ROOM])
{
    remedy closed = {.options = q->options};
    hull_outcome trial = {.defect = MESH_EMPTY};
    closed.options.repair = true;
    if (!(raised->report.top > 0) || q->options.repair)
        return FRAM_OK;
    fram_status status = try_remedy(q, &closed, &trial);
    size_t length = strlen(words);
    if (status == FRAM_OK)
        snprintf(words + length, REMEDY_ROOM - length,
                 "; as it ends %.3g m above the water, have it repaired (repair) if its deck is to be there",
                 raised->report.top);
    return status == FRAM_ERROR_MEMORY ? status : FRAM_OK;
}

/* Half a hull with a wall where the other half begins is as sound as a whole one that is counted from a perpendicular.
 */
static void add_wall(char words[REMEDY_ROOM])
{
    size_t length = strlen(words);
    snprintf(words + length, REMEDY_ROOM - length, "; if it is half a hull instead, leave out its wall in x = 0");
}

static void put_advice(fram_error *error, const char *words)
{
    const char *advice = strrchr(error->message, ';');
    size_t length = advice ? (size_t)(advice - error->message) : strlen(error->message);
    snprintf(error->message + length, sizeof error->message - length, "; %s", words);
}

/* What to do elsewhere where repair would close the end of a hull. */
static const char *const end_words[] = {
    [HULL_ENDS_AT_X] =
        "it ends in x = 0, or near it: lay its corners there into that plane and mirror it in the program "
        "that made the file, or have it repaired (repair) if that is its end",
    [HULL_ENDS_AT_Y] =
        "it ends in its centre plane y = 0, or near it: lay its corners there into that plane and mirror "
        "it in the program that made the file",
    [HULL_ENDS_AT_WATER] = "it ends in the water plane z = 0, or near it: draw it up to its deck, or lay its open top "
                           "into one plane, in the program that made the file",
};

/* Put the first remedy that makes the file sound in the place of the advice
 * what to do elsewhere. */
static fram_status name_remedy(const hull_request *q, fram_error *error)
{
    remedy list[MOST_REMEDIES] = {{.unmirrored = HULL_WHOLE}};
    hull_ending end = HULL_ENDS_NOWHERE;
    hull_outcome trial = {.defect = MESH_EMPTY};
    int count = list_remedies(q, list);
    for (int i = 0; i < count; i++) {
        fram_status status = try_remedy(q, &list[i], &trial);
        if (status == FRAM_OK && list[i].raises)
            status = add_repair(q, &trial, list[i].words);
        if (status == FRAM_OK && list[i].walled)
            add_wall(list[i].words);
        if (status == FRAM_ERROR_MEMORY)
            return error_memory(error);
        if (status == FRAM_OK) {
            put_advice(error, list[i].words);
            return FRAM_ERROR_INPUT;
        }
        end = end ? end : trial.end;
    }
    if (end)
        put_advice(error, end_words[end]);
    return FRAM_ERROR_INPUT;
}

fram_status hull_file_finish(context *ctx, const char *name, mesh_file *file, const hull_file_options *options,
                             mesh *surface, hull_file_report *report, fram_error *error)
{
    const hull_request q = {.ctx = ctx, .name = name, .file = file, .options = *options};
    hull_outcome out = {.defect = MESH_EMPTY};
    fram_status status = check_options(options, &out.error);
    if (status == FRAM_OK)
        status = check_file_unit(&q, &out.error);
    if (status == FRAM_OK) {
        status = attempt_all(&q, &out);
        /* Whatever closes half a hull makes half a ship of it. */
        if (status == FRAM_ERROR_INPUT && !out.half)
            status = name_remedy(&q, &out.error);
    }
    *report = out.report;
    *surface = out.surface;
    if (status != FRAM_OK && error)
        *error = out.error;
    mesh_file_free(ctx, file);
    return status;
}

fram_status hull_file_read(context *ctx, const char *path, const hull_file_options *options, mesh *surface,
                           hull_file_report *report, fram_error *error)
{
    mesh_file file;
    fram_status status = mesh_file_read(ctx, path, &file, error);
    return status == FRAM_OK ? hull_file_finish(ctx, path, &file, options, surface, report, error) : status;
}

static int32_t count_panels_above(const mesh *m, double tolerance)
{
    int32_t count = 0;
    for (int32_t f = 0; f < m->face.count; f++) {
        vec3 p[3];
        mesh_face_points(m, f, p);
        count += fmax(p[0].z, fmax(p[1].z, p[2].z)) > tolerance;
    }
    return count;
}

fram_status hull_file_write(context *ctx, const char *path, const mesh *surface, fram_error *error)
{
    fram_status status = mesh_file_write(ctx, path, surface, error);
    if (status != FRAM_OK || !mesh_file_ends_with(path, ".gdf"))
        return status;
    double tolerance = HULL_LEVEL_TOLERANCE * hull_longest_side(surface);
    int32_t lids = 0, above = count_panels_above(surface, tolerance);
    if (!hull_count_lids(ctx, surface, &lids))
        return error_memory(error);
    if (lids > 0)
        log_write(
            ctx, LOG_WARNING,
            "%.200s: %d triangles lie in z = 0, or are level near to it, where panels are lids of the water plane, "
            "which are left out when the file is read: move the hull, or write .stl or .obj",
            path, (int)lids);
    if (mesh_bounds(surface).lo.z >= -tolerance)
        log_write(
            ctx, LOG_WARNING,
            "%.200s: no panel reaches under z = 0, which is the waterline for programs of panel methods: move the "
            "hull down",
            path);
    else if (above > 0)
        log_write(ctx, LOG_WARNING,
                  "%.200s: %d panels reach above z = 0; programs of panel methods take those under water alone: cut "
                  "them off there",
                  path, (int)above);
    return status;
}
