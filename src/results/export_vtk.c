#include "results/export.h"

#include "io/folder.h"
#include "io/vtk_file.h"
#include "results/replay.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIELDS_MOST = 12, PARTS = 3 };
enum { PART_FLOES, PART_HULL, PART_FORCES };
static const char *const part_names[PARTS] = {"floes", "hull", "forces"};

/* One data set under construction: points, cells, a column per field. */
typedef struct sheet {
    ARRAY(vec3) point;
    int32_array connectivity, offset;
    float_array column[FIELDS_MOST];
    vtk_field field[FIELDS_MOST];
    int32_t fields, cells;
    bool failed; /* no memory */
} sheet;

typedef struct vtk_export {
    context *ctx;
    replay r;
    sheet part[PARTS];
    vtk_step_array steps[PARTS + 1]; /* the last: all together */
    const char *folder;
} vtk_export;

static void sheet_clear(sheet *s)
{
    array_clear(&s->point);
    array_clear(&s->connectivity);
    array_clear(&s->offset);
    for (int i = 0; i < FIELDS_MOST; i++)
        array_clear(&s->column[i]);
    s->cells = 0;
}

static void sheet_free(context *ctx, sheet *s)
{
    array_free(ctx, &s->point);
    array_free(ctx, &s->connectivity);
    array_free(ctx, &s->offset);
    for (int i = 0; i < FIELDS_MOST; i++)
        array_free(ctx, &s->column[i]);
}

static int32_t add_point(context *ctx, sheet *s, vec3 p)
{
    s->failed = s->failed || !array_push(ctx, &s->point, p);
    return s->point.count - 1;
}

static void add_corner(context *ctx, sheet *s, int32_t point)
{
    s->failed = s->failed || !array_push(ctx, &s->connectivity, point);
}

static void end_cell(context *ctx, sheet *s)
{
    s->failed = s->failed || !array_push(ctx, &s->offset, s->connectivity.count);
    s->cells++;
}

/* The value of the `field`-th field for the cells added since the last one was given. */
static void fill(context *ctx, sheet *s, int32_t field, const char *name, int components, const double *value)
{
    s->field[field] = (vtk_field){.name = name, .components = components};
    s->fields = field + 1 > s->fields ? field + 1 : s->fields;
    while (s->column[field].count < s->cells * components && !s->failed) {
        for (int k = 0; k < components; k++)
            s->failed = s->failed || !array_push(ctx, &s->column[field], (float)value[k]);
    }
}

static void fill_real(context *ctx, sheet *s, int32_t field, const char *name, double value)
{
    fill(ctx, s, field, name, 1, &value);
}

static void fill_vec3(context *ctx, sheet *s, int32_t field, const char *name, vec3 v)
{
    const double value[3] = {v.x, v.y, v.z};
    fill(ctx, s, field, name, 3, value);
}

/* ---- the three data sets ---- */

/* A closed prism: top, bottom and sides. */
static void add_prism(vtk_export *e, const replay_body *b, const replay_pose *p)
{
    sheet *s = &e->part[PART_FLOES];
    polygon ring = replay_outline(&e->r, b);
    mat3 turn = quat_matrix(p->orientation);
    int32_t first = s->point.count, n = ring.count;
    for (int top = 0; top < 2; top++) {
        for (int32_t i = 0; i < n; i++) {
            vec3 local = vec3_make(ring.vertex[i].x, ring.vertex[i].y, (top - 0.5) * b->thickness);
            add_point(e->ctx, s, vec3_add(p->position, mat3_mul_vec(turn, local)));
        }
    }
    for (int top = 1; top >= 0; top--) {
        for (int32_t i = 0; i < n; i++)
            add_corner(e->ctx, s, first + (top ? n + i : n - 1 - i));
        end_cell(e->ctx, s);
    }
    for (int32_t i = 0; i < n; i++) {
        int32_t j = (i + 1) % n;
        add_corner(e->ctx, s, first + i);
        add_corner(e->ctx, s, first + j);
        add_corner(e->ctx, s, first + n + j);
        add_corner(e->ctx, s, first + n + i);
        end_cell(e->ctx, s);
    }
}

static void fill_floe(vtk_export *e, const replay_body *b, const replay_pose *p)
{
    sheet *s = &e->part[PART_FLOES];
    int32_t f = 0;
    fill_vec3(e->ctx, s, f++, "velocity [m/s]", p->velocity);
    fill_real(e->ctx, s, f++, "speed [m/s]", vec3_length(p->velocity));
    fill_real(e->ctx, s, f++, "contact force [N]", p->contact_force);
    fill_real(e->ctx, s, f++, "thickness [m]", b->thickness);
    fill_real(e->ctx, s, f++, "area [m2]", b->area);
    fill_real(e->ctx, s, f++, "mass [kg]", b->area * b->thickness * b->density);
    fill_real(e->ctx, s, f++, "age [s]", e->r.frame.time - b->birth);
    fill_real(e->ctx, s, f++, "floe", b->number);
    fill_real(e->ctx, s, f++, "parent", b->parent);
    fill_real(e->ctx, s, f++, "material", b->material);
    fill_real(e->ctx, s, f++, "moves", b->moves);
}

static void add_hull(vtk_export *e, const replay_body *b, const replay_pose *p)
{
    sheet *s = &e->part[PART_HULL];
    mat3 turn = quat_matrix(p->orientation);
    int32_t first = s->point.count;
    for (int32_t i = 0; i < b->vertex_count; i++)
        add_point(e->ctx, s, vec3_add(p->position, mat3_mul_vec(turn, e->r.points.data[b->vertex_first + i])));
    for (int32_t i = 0; i < b->face_count; i++) {
        for (int k = 0; k < 3; k++)
            add_corner(e->ctx, s, first + e->r.faces.data[3 * (b->face_first + i) + k]);
        end_cell(e->ctx, s);
    }
    fill_vec3(e->ctx, s, 0, "velocity [m/s]", p->velocity);
    /* A frame has that of the first vessel alone. */
    bool is_first = first == 0;
    const double none = (double)NAN;
    fill_vec3(e->ctx, s, 1, "ice force, averaged [N]", is_first ? e->r.frame.ice_force : vec3_make(none, none, none));
    /* From 1 on, in the order of the scenario's list. */
    fill_real(e->ctx, s, 2, "vessel", b->vessel + 1);
}

/* A vertex at the point of each force on the vessel. */
static void add_forces(vtk_export *e)
{
    sheet *s = &e->part[PART_FORCES];
    for (int32_t i = 0; i < e->r.frame.forces.count; i++) {
        const replay_force *force = &e->r.frame.forces.data[i];
        bool body = record_force_pushes(force->kind) && force->which >= 0;
        add_corner(e->ctx, s, add_point(e->ctx, s, force->point));
        end_cell(e->ctx, s);
        fill_vec3(e->ctx, s, 0, "force [N]", force->force);
        fill_real(e->ctx, s, 1, "magnitude [N]", vec3_length(force->force));
        fill_real(e->ctx, s, 2, "kind", force->kind);
        fill_real(e->ctx, s, 3, "number", body ? e->r.bodies.data[force->which].number : force->which);
        fill_real(e->ctx, s, 4, "vessel", force->vessel + 1);
    }
    /* A frame without forces has the fields too. */
    if (s->cells == 0) {
        fill_vec3(e->ctx, s, 0, "force [N]", vec3_make(0, 0, 0));
        fill_real(e->ctx, s, 1, "magnitude [N]", 0);
        fill_real(e->ctx, s, 2, "kind", 0);
        fill_real(e->ctx, s, 3, "number", 0);
        fill_real(e->ctx, s, 4, "vessel", 0);
    }
}

static fram_status write_part(vtk_export *e, int part, int64_t number, fram_error *error)
{
    sheet *s = &e->part[part];
    vtk_step step = {.time = e->r.frame.time};
    char path[PATH_ROOM];
    snprintf(step.name, sizeof step.name, "data/%s_%06lld.vtp", part_names[part], (long long)number);
    if (path_join(e->folder, step.name, path, error) != FRAM_OK)
        return FRAM_ERROR_INPUT;
    if (s->failed)
        return error_memory(error);
    for (int32_t i = 0; i < s->fields; i++)
        s->field[i].value = s->column[i].data;
    vtk_data data = {.point = s->point.data,
                     .point_count = s->point.count,
                     .kind = part == PART_FORCES ? VTK_VERTICES : VTK_POLYGONS,
                     .connectivity = s->connectivity.data,
                     .offset = s->offset.data,
                     .cell_count = s->cells,
                     .fields = s->field,
                     .field_count = s->fields,
                     .time = step.time};
    fram_status status = vtk_write(e->ctx, path, &data, error);
    bool good = array_push(e->ctx, &e->steps[part], step);
    step.part = part;
    good = good && array_push(e->ctx, &e->steps[PARTS], step);
    return status == FRAM_OK && !good ? error_memory(error) : status;
}

static fram_status write_frame(vtk_export *e, int64_t number, fram_error *error)
{
    for (int k = 0; k < PARTS; k++)
        sheet_clear(&e->part[k]);
    for (int32_t i = 0; i < e->r.frame.poses.count; i++) {
        const replay_pose *p = &e->r.frame.poses.data[i];
        const replay_body *b = &e->r.bodies.data[p->body];
        if (b->solid) {
            add_hull(e, b, p);
        } else {
            add_prism(e, b, p);
            fill_floe(e, b, p);
        }
    }
    add_forces(e);
    fram_status status = FRAM_OK;
    for (int k = 0; k < PARTS && status == FRAM_OK; k++)
        status = write_part(e, k, number, error);
    return status;
}

/* The list of a part's files, or of all. */
static fram_status name_list(const vtk_export *e, int part, char path[PATH_ROOM], fram_error *error)
{
    char name[32];
    snprintf(name, sizeof name, "%s.pvd", part < PARTS ? part_names[part] : "run");
    return path_join(e->folder, name, path, error);
}

static fram_status write_series(vtk_export *e, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int k = 0; k <= PARTS && status == FRAM_OK; k++) {
        char path[PATH_ROOM];
        status = name_list(e, k, path, error);
        if (status == FRAM_OK)
            status = vtk_series_write(e->ctx, path, e->steps[k].data, e->steps[k].count, error);
    }
    return status;
}

static fram_status write_frames(vtk_export *e, int64_t every, export_report *report, fram_error *error)
{
    bool found = true;
    fram_status status = FRAM_OK;
    while (status == FRAM_OK) {
        status = replay_next(&e->r, &found, error);
        if (status != FRAM_OK || !found)
            break;
        if (e->r.frame.number % every != 0)
            continue;
        if (report->frames == 0)
            report->time = e->r.frame.time;
        status = write_frame(e, report->frames++, error);
    }
    if (status == FRAM_INTERRUPTED)
        return error_set(error, status, e->folder, 0, NULL, "interrupted; %lld frames are there, without their list",
                         (long long)report->frames);
    return status == FRAM_OK ? write_series(e, error) : status;
}

/* The one that a caller names may be a link. */
static fram_status make_folder(const char *path, bool own, fram_error *error)
{
    if (own)
        return folder_make_own(path, error);
    return mkdir(path, 0777) != 0 && errno != EEXIST ? file_place_error(error, path, "make the folder", errno)
                                                     : FRAM_OK;
}

/* "floes_000012.vtp" */
static bool is_of_frame(const char *name)
{
    bool found = false;
    for (int k = 0; k < PARTS; k++) {
        size_t length = strlen(part_names[k]);
        found = found || (strncmp(name, part_names[k], length) == 0 && name_is_numbered(name + length, "_", 6, ".vtp"));
    }
    return found;
}

/* What an earlier export left would be taken for more of this one, and its lists for those of frames that are not all
   there yet. */
static fram_status remove_earlier(const vtk_export *e, const char *data, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int k = 0; k <= PARTS && status == FRAM_OK; k++) {
        char path[PATH_ROOM];
        status = name_list(e, k, path, error);
        if (status == FRAM_OK)
            (void)unlink(path);
    }
    folder_remove_files(data, is_of_frame);
    return status;
}

fram_status export_vtk(context *ctx, const char *folder, const char *output, int64_t every, export_report *report,
                       fram_error *error)
{
    char to[PATH_ROOM], data[PATH_ROOM];
    vtk_export e = {.ctx = ctx, .folder = to};
    *report = (export_report){0};
    fram_status status = path_given_or(output, folder, "vtk", to, error);
    if (status == FRAM_OK)
        status = path_join(to, "data", data, error);
    if (status == FRAM_OK)
        status = path_join(to, "run.pvd", report->path, error);
    if (status == FRAM_OK)
        status = replay_open(ctx, folder, &e.r, error);
    if (status != FRAM_OK)
        return status;
    status = make_folder(e.folder, !output, error);
    if (status == FRAM_OK)
        status = make_folder(data, true, error);
    if (status == FRAM_OK)
        status = remove_earlier(&e, data, error);
    if (status == FRAM_OK)
        status = write_frames(&e, every < 1 ? 1 : every, report, error);
    replay_close(&e.r);
    for (int k = 0; k < PARTS; k++)
        sheet_free(ctx, &e.part[k]);
    for (int k = 0; k <= PARTS; k++)
        array_free(ctx, &e.steps[k]);
    return status;
}
