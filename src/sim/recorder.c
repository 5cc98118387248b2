#include "sim/recorder.h"

#include "base/transcendental.h"
#include "io/path.h"
#include "io/record_blocks.h"
#include "sim/frame_size.h"
#include "sim/ice_loads.h"

#include <string.h>

/* The middle of a domain that is farther from 0 than it is long, in whole metres. */
static vec2 origin_of(const scenario_domain *d)
{
    vec2 middle = vec2_make((d->x_min + d->x_max) / 2, (d->y_min + d->y_max) / 2);
    double side = fmax(d->x_max - d->x_min, d->y_max - d->y_min);
    bool far = fmax(fabs(middle.x), fabs(middle.y)) > side;
    return far ? vec2_make(floor(middle.x), floor(middle.y)) : vec2_make(0, 0);
}

static void set_intervals(recorder *r, const scenario *s)
{
    r->series_every = scenario_interval_steps(s->output.csv_interval, s->run.time_step);
    if (r->series_every == 0)
        r->series_every = 1;
    r->frame_every = scenario_interval_steps(s->output.frame_interval, s->run.time_step);
    r->time_step = s->run.time_step;
    if (r->frame_every > 0)
        r->frames_most = s->run.duration / (r->time_step * (double)r->frame_every);
    r->record_limit = s->output.record_limit * 1e6;
    peak_watch_init(r->ctx, s->run.time_step, s->run.transient, &r->peaks);
}

static void free_scratch(recorder *r)
{
    array_free(r->ctx, &r->block);
    array_free(r->ctx, &r->sums);
    array_free(r->ctx, &r->row);
    series_layout_free(r->ctx, &r->layout);
}

/* Columns, and room for a row. */
static fram_status begin_series(recorder *r, const scenario *s, fram_error *error)
{
    fram_status status = series_columns(r->ctx, s, &r->layout, error);
    if (status == FRAM_OK && !array_resize(r->ctx, &r->row, r->layout.columns.count))
        status = error_memory(error);
    return status;
}

fram_status recorder_create(context *ctx, const scenario *s, const char *folder, const char *text, recorder *r,
                            fram_error *error)
{
    *r = (recorder){.ctx = ctx};
    set_intervals(r, s);
    char path[PATH_ROOM];
    fram_status status = begin_series(r, s, error);
    if (status == FRAM_OK)
        status = path_join(folder, "series.csv", path, error);
    if (status == FRAM_OK)
        status = csv_create(ctx, path, r->layout.columns.data, r->layout.columns.count, &r->series, error);
    if (status != FRAM_OK) {
        free_scratch(r);
        return status;
    }
    int32_t count;
    const csv_column *columns = fracture_columns(&count);
    status = path_join(folder, "fractures.csv", path, error);
    if (status == FRAM_OK)
        status = csv_create(ctx, path, columns, count, &r->fractures, error);
    if (status == FRAM_OK)
        status = path_join(folder, "record.fram", path, error);
    if (status == FRAM_OK)
        status = record_create(ctx, path, &r->record, error);
    r->origin = r->peaks.origin = origin_of(&s->domain);
    if (status == FRAM_OK)
        status = record_append_origin(&r->record, r->origin, error);
    if (status == FRAM_OK) {
        record_part part = {text, strlen(text)};
        status = record_append(&r->record, BLOCK_SCENARIO, &part, 1, error);
    }
    /* Whoever looks on from the start finds tables without rows, not empty files. */
    if (status == FRAM_OK)
        status = csv_flush(&r->series, false, error);
    if (status == FRAM_OK)
        status = csv_flush(&r->fractures, false, error);
    if (status != FRAM_OK)
        recorder_close(r, NULL);
    return status;
}

recorder_lengths recorder_lengths_of(const recorder *r)
{
    return (recorder_lengths){csv_length(&r->series), record_length(&r->record), csv_length(&r->fractures)};
}

/* All streams are sound: what stands after the checkpoint goes. */
static fram_status cut_streams(recorder *r, const recorder_lengths *lengths, fram_error *error)
{
    fram_status status = file_cut(&r->series.file, lengths->series, error);
    if (status == FRAM_OK)
        status = file_cut(&r->fractures.file, lengths->fractures, error);
    return status == FRAM_OK ? file_cut(&r->record.file.writer, lengths->record, error) : status;
}

fram_status recorder_continue(context *ctx, const scenario *s, const char *folder, const recorder_lengths *lengths,
                              recorder *r, fram_error *error)
{
    *r = (recorder){.ctx = ctx};
    set_intervals(r, s);
    char path[PATH_ROOM];
    bool lost = false;
    fram_status status = path_join(folder, "record.fram", path, error);
    if (status == FRAM_OK)
        status = record_check_layout(ctx, path, lengths->record, &r->origin, &lost, error);
    /* The peaks of the checkpoint are told from the origin that the record began with. */
    if (lost)
        r->origin = origin_of(&s->domain);
    r->peaks.origin = r->origin;
    if (status == FRAM_OK)
        status = begin_series(r, s, error);
    if (status == FRAM_OK)
        status = path_join(folder, "series.csv", path, error);
    if (status == FRAM_OK)
        status = csv_continue(ctx, path, lengths->series, r->layout.columns.data, r->layout.columns.count, &r->series,
                              error);
    if (status != FRAM_OK) {
        free_scratch(r);
        return status;
    }
    int32_t count;
    const csv_column *columns = fracture_columns(&count);
    status = path_join(folder, "fractures.csv", path, error);
    if (status == FRAM_OK)
        status = csv_continue(ctx, path, lengths->fractures, columns, count, &r->fractures, error);
    if (status == FRAM_OK)
        status = path_join(folder, "record.fram", path, error);
    if (status == FRAM_OK)
        status = record_continue(ctx, path, lengths->record, &r->record, error);
    if (status == FRAM_OK)
        status = cut_streams(r, lengths, error);
    if (status != FRAM_OK)
        recorder_close(r, NULL);
    return status;
}

/* ---- blocks ---- */

static record_stream block_packer(recorder *r) { return record_packer(r->ctx, &r->block, r->origin); }

static fram_status append(recorder *r, const record_stream *s, uint32_t type, fram_error *error)
{
    if (s->full)
        return error_memory(error);
    record_part part = {r->block.data, (size_t)r->block.count};
    return record_append(&r->record, type, &part, 1, error);
}

/* The same, with the count that its head tells; nothing without any. */
static fram_status append_counted(recorder *r, record_stream *s, uint32_t type, int32_t count, fram_error *error)
{
    record_stream_set_count(s, type, count);
    return count > 0 || s->full ? append(r, s, type, error) : FRAM_OK;
}

static bool moves(const world *w, int32_t slot)
{
    return body_is_alive(&w->bodies, slot) && w->bodies.motion[slot] != MOTION_STATIC;
}

/* The body in this slot is another one than the record knows, or the first. */
static bool is_new(const world *w, int32_t slot)
{
    return body_is_alive(&w->bodies, slot) && w->bodies.shape[slot] >= 0 &&
           w->recorded.generation[slot] != w->bodies.generation[slot];
}

static bool is_solid(const world *w, int32_t slot)
{
    return w->shapes.shapes.kind[w->bodies.shape[slot]] == SHAPE_SOLID;
}

static fram_status write_deaths(recorder *r, world *w, fram_error *error)
{
    int32_t count = 0;
    record_stream s = block_packer(r);
    record_stream_count(&s, &count);
    for (int32_t i = 0; i < w->recorded.count && !s.full; i++) {
        uint32_t known = w->recorded.generation[i];
        if (known == 0 || (body_is_alive(&w->bodies, i) && w->bodies.generation[i] == known))
            continue;
        int32_t slot = i;
        record_stream_slot(&s, &slot);
        w->recorded.generation[i] = 0;
        count++;
    }
    return append_counted(r, &s, BLOCK_DEATHS, count, error);
}

static record_birth birth_of_body(const world *w, int32_t slot)
{
    record_birth b = {.slot = slot, .generation = w->bodies.generation[slot], .number = -1, .parent = -1};
    b.material = w->bodies.material[slot];
    b.moves = moves(w, slot);
    b.thickness = 2 * w->shapes.shapes.half_height[w->bodies.shape[slot]];
    if (b.material != MATERIAL_ICE || w->bodies.owner[slot] < 0)
        return b;
    int32_t floe = w->bodies.owner[slot];
    b.breakable = w->floes.breakable[floe] != 0;
    b.level = w->floes.tile[floe] != 0;
    b.density = w->floes.material[floe].density;
    b.number = w->floes.number[floe];
    b.parent = w->floes.parent[floe];
    return b;
}

static void put_birth(record_stream *s, const world *w, int32_t slot)
{
    polygon outline = shape_outline(&w->shapes, w->bodies.shape[slot]);
    record_birth b = birth_of_body(w, slot);
    b.vertices = outline.count;
    record_stream_birth(s, &b);
    for (int32_t i = 0; i < outline.count; i++) {
        vec2 corner = outline.vertex[i];
        record_stream_corner(s, &corner);
    }
    vec3 position = w->bodies.position[slot];
    quat orientation = w->bodies.orientation[slot];
    if (!b.moves)
        record_stream_pose(s, &position, &orientation);
}

static fram_status write_births(recorder *r, world *w, fram_error *error)
{
    int32_t count = 0;
    record_stream s = block_packer(r);
    record_stream_count(&s, &count);
    for (int32_t i = 0; i < w->bodies.count && !s.full; i++) {
        if (!is_new(w, i) || is_solid(w, i))
            continue;
        put_birth(&s, w, i);
        w->recorded.generation[i] = w->bodies.generation[i];
        count++;
    }
    return append_counted(r, &s, BLOCK_BIRTHS, count, error);
}

static fram_status write_solid(recorder *r, world *w, int32_t slot, fram_error *error)
{
    const mesh *m = &shape_solid(&w->shapes, w->bodies.shape[slot])->surface;
    record_solid b = {slot, w->bodies.generation[slot], m->vertex.count, m->face.count};
    record_stream s = block_packer(r);
    record_stream_solid(&s, &b);
    for (int32_t i = 0; i < m->vertex.count; i++) {
        vec3 v = m->vertex.data[i];
        record_stream_point(&s, &v);
    }
    for (int32_t i = 0; i < m->face.count; i++) {
        triangle face = m->face.data[i];
        record_stream_face(&s, face.v);
    }
    w->recorded.generation[slot] = w->bodies.generation[slot];
    return append(r, &s, BLOCK_SOLID, error);
}

/* ---- forces on the vessels ---- */

/* As a record tells it: of one vessel alone all forces are. */
static int32_t told_vessel(const world *w, int32_t vessel) { return w->vessels.count > 1 ? vessel + 1 : 0; }

static void put_line_forces(record_stream *s, const world *w, int32_t vessel, int32_t *count)
{
    int32_t body = w->vessels.body[vessel], number = 0;
    for (int32_t i = 0; i < w->lines.count; i++) {
        number += w->lines.vessel[i] == vessel;
        if (w->lines.vessel[i] != vessel || w->lines.broken[i])
            continue;
        line_pull pull = mooring_line_pull(&w->lines, i, w->bodies.position[body], w->bodies.orientation[body]);
        record_force f = {RECORD_FORCE_LINE, told_vessel(w, vessel), number, pull.point, pull.force};
        record_stream_force(s, &f);
        ++*count;
    }
}

static void put_thruster_forces(record_stream *s, const world *w, int32_t vessel, int32_t *count)
{
    int32_t body = w->vessels.body[vessel], number = 0;
    for (int32_t i = 0; i < w->thrusters.count; i++) {
        number += w->thrusters.vessel[i] == vessel;
        if (w->thrusters.vessel[i] != vessel || w->thrusters.failed[i])
            continue;
        double thrust = w->thrusters.thrust[i], angle = thruster_push_angle(&w->thrusters, i);
        vec3 force = vec3_make(thrust * real_cos(angle), thrust * real_sin(angle), 0);
        record_force f = {RECORD_FORCE_THRUSTER, told_vessel(w, vessel), number,
                          body_to_global(&w->bodies, body, w->thrusters.place[i]),
                          mat3_mul_vec(quat_matrix(w->bodies.orientation[body]), force)};
        record_stream_force(s, &f);
        ++*count;
    }
}

/* Of floes, hulls and walls that touch it. */
static bool put_contact_forces(recorder *r, record_stream *s, const world *w, int32_t vessel, int32_t *count)
{
    if (!contact_sums_of(r->ctx, w, r->time_step, vessel, &r->sums))
        return false;
    for (int32_t i = 0; i < r->sums.count; i++) {
        const contact_sum *sum = &r->sums.data[i];
        if (sum->weight == 0)
            continue;
        record_force_kind kind = w->bodies.material[i] == MATERIAL_ICE ? RECORD_FORCE_ICE : RECORD_FORCE_HULL;
        record_force f = {kind, told_vessel(w, vessel), i, vec3_scale(sum->moment, 1 / sum->weight), sum->on_vessel};
        record_stream_force(s, &f);
        ++*count;
    }
    return true;
}

static fram_status write_forces(recorder *r, const world *w, fram_error *error)
{
    if (w->vessels.count == 0)
        return FRAM_OK;
    int32_t count = 0;
    record_stream s = block_packer(r);
    record_stream_padded_count(&s, &count);
    for (int32_t v = 0; v < w->vessels.count; v++) {
        if (!put_contact_forces(r, &s, w, v, &count))
            return error_memory(error);
        put_line_forces(&s, w, v, &count);
        put_thruster_forces(&s, w, v, &count);
    }
    return append_counted(r, &s, BLOCK_FORCES, count, error);
}

/* ---- frames ---- */

/* Deaths, births and solids since the last frame, then the poses of all that move. */
static fram_status write_frame(recorder *r, world *w, fram_error *error)
{
    if (!table_resize(r->ctx, &w->recorded, &recorded_table_info, w->bodies.count))
        return error_memory(error);
    fram_status status = write_deaths(r, w, error);
    for (int32_t i = 0; i < w->bodies.count && status == FRAM_OK; i++) {
        if (is_new(w, i) && is_solid(w, i))
            status = write_solid(r, w, i, error);
    }
    if (status == FRAM_OK)
        status = write_births(r, w, error);
    if (status == FRAM_OK && !contact_sums_of(r->ctx, w, r->time_step, -1, &r->sums))
        status = error_memory(error);
    if (status == FRAM_OK)
        status = write_forces(r, w, error);
    if (status != FRAM_OK)
        return status;

    record_frame_head head = {w->clock.step[0], w->clock.time[0], load_window_average(w, 0).force, 0};
    record_stream s = block_packer(r);
    record_stream_frame(&s, &head);
    int32_t count = 0;
    for (int32_t i = 0; i < w->bodies.count && !s.full; i++) {
        if (!body_is_alive(&w->bodies, i) || w->bodies.shape[i] < 0 || !moves(w, i))
            continue;
        bool here = !world_came_since_contacts(w, i); /* else they are those of what stood there before */
        record_moving m = {w->bodies.position[i], w->bodies.orientation[i], here ? r->sums.data[i].magnitude : 0};
        record_stream_moving(&s, BLOCK_FRAME, &m);
        count++;
    }
    record_stream_set_count(&s, BLOCK_FRAME, count);
    return append(r, &s, BLOCK_FRAME, error);
}

static bool frame_is_due(const recorder *r, const world *w)
{
    int64_t step = w->clock.step[0], every = r->frame_every;
    if (every == 0 || step % every != 0)
        return false;
    double bytes = r->record_limit > 0 ? frame_size_of_world(w) : 0;
    for (double frames = r->frames_most; bytes * frames > 0.9 * r->record_limit && frames > 1; frames /= 2)
        every *= 2;
    return step % every == 0;
}

/* The events of this step, at its end's time: rows of the table, and a block of the record. */
static fram_status write_fractures(recorder *r, const world *w, fram_error *error)
{
    const fracture_event_array *events = &w->scratch.fractures;
    if (events->count == 0)
        return FRAM_OK;
    double time = w->clock.time[0];
    int32_t count = events->count;
    record_stream s = block_packer(r);
    record_stream_padded_count(&s, &count);
    for (int32_t i = 0; i < events->count; i++) {
        const fracture_event *e = &events->data[i];
        double row[FRACTURE_ROOM];
        fracture_row(time, e, row);
        fram_status status = csv_append(&r->fractures, row, error);
        if (status != FRAM_OK)
            return status;
        record_fracture f = {time,     (int32_t)e->kind, e->floe,         e->pieces,
                             e->place, e->load,          e->crack_length, e->parent_area};
        record_stream_fracture(&s, &f);
    }
    return append(r, &s, BLOCK_FRACTURES, error);
}

fram_status recorder_step(recorder *r, world *w, double wall_time, fram_error *error)
{
    int64_t step = w->clock.step[0];
    fram_status status = FRAM_OK;
    bool known = step > 0 && w->scratch.step == step; /* a state that was loaded holds nothing of its last step */
    if (known && step % r->series_every == 0) {
        series_row(r->ctx, &r->layout, w, wall_time, r->row.data);
        status = csv_append(&r->series, r->row.data, error);
    }
    if (status == FRAM_OK && known)
        status = write_fractures(r, w, error);
    if (status == FRAM_OK && known)
        status = peak_watch_step(&r->peaks, w, error);
    if (status == FRAM_OK && frame_is_due(r, w)) {
        status = write_frame(r, w, error);
        /* Whoever looks on meanwhile sees whole frames. */
        if (status == FRAM_OK)
            status = record_flush(&r->record, false, error);
    }
    return status;
}

void recorder_streams(recorder *r, file_writer *out[RECORDER_STREAMS])
{
    out[0] = &r->series.file;
    out[1] = &r->fractures.file;
    out[2] = &r->record.file.writer;
}

fram_status recorder_flush(recorder *r, fram_error *error)
{
    fram_status status = csv_flush(&r->series, true, error);
    if (status == FRAM_OK)
        status = csv_flush(&r->fractures, true, error);
    return status == FRAM_OK ? record_flush(&r->record, true, error) : status;
}

fram_status recorder_close(recorder *r, fram_error *error)
{
    peak_watch_free(&r->peaks);
    free_scratch(r);
    fram_status series = csv_close(&r->series, error);
    fram_status fractures = csv_close(&r->fractures, series == FRAM_OK ? error : NULL);
    series = series == FRAM_OK ? fractures : series;
    fram_status record = record_close(&r->record, series == FRAM_OK ? error : NULL);
    return series != FRAM_OK ? series : record;
}
