#include "results/replay.h"

#include "results/run_record.h"

#include <math.h>
#include <string.h>

/* ---- bodies ---- */

/* Slots of a record count from 0; this many bodies at once is more than any run has. */
enum { SLOTS_MOST = 1 << 24, MATERIALS = MATERIAL_COUNT };

static void remove_slot(replay *r, int32_t slot)
{
    if (slot >= 0 && slot < r->at_slot.count)
        r->at_slot.data[slot] = -1;
}

static bool add_body(replay *r, const replay_body *b)
{
    remove_slot(r, b->slot);
    while (r->at_slot.count <= b->slot) {
        if (!array_push(r->ctx, &r->at_slot, -1))
            return false;
    }
    r->at_slot.data[b->slot] = r->bodies.count;
    return array_push(r->ctx, &r->bodies, *b);
}

static replay_body new_body(const replay *r, record_stream *s, int32_t slot)
{
    replay_body b = {.slot = slot, .born = r->frames_read};
    b.number = b.parent = b.vessel = -1;
    s->unsound = s->unsound || slot < 0 || slot >= SLOTS_MOST;
    return b;
}

static bool read_solid(replay *r, record_stream *s)
{
    record_solid told = {0};
    record_stream_solid(s, &told);
    replay_body b = new_body(r, s, told.slot);
    b.material = MATERIAL_HULL;
    b.moves = b.solid = true;
    b.vessel = r->vessels++;
    b.vertex_count = told.vertices;
    b.face_count = told.faces;
    b.vertex_first = r->points.count;
    b.face_first = r->faces.count / 3;
    for (int32_t i = 0; i < b.vertex_count && !s->unsound; i++) {
        vec3 point = {0, 0, 0};
        record_stream_point(s, &point);
        if (!array_push(r->ctx, &r->points, point))
            return false;
    }
    for (int32_t i = 0; i < b.face_count && !s->unsound; i++) {
        int32_t corner[3] = {0, 0, 0};
        record_stream_face(s, corner);
        for (int k = 0; k < 3; k++) {
            s->unsound = s->unsound || corner[k] < 0 || corner[k] >= b.vertex_count;
            if (!array_push(r->ctx, &r->faces, corner[k]))
                return false;
        }
    }
    return s->unsound || add_body(r, &b);
}

static bool read_birth(replay *r, record_stream *s)
{
    record_birth told = {0};
    record_stream_birth(s, &told);
    replay_body b = new_body(r, s, told.slot);
    b.material = told.material < MATERIALS ? told.material : MATERIAL_WALL;
    b.moves = told.moves;
    b.breakable = told.breakable;
    b.level = told.level;
    b.thickness = told.thickness;
    b.density = told.density;
    b.number = told.number;
    b.parent = told.parent;
    b.vertex_count = told.vertices;
    b.vertex_first = r->outlines.count;
    s->unsound = s->unsound || b.vertex_count < 3;
    if (s->unsound)
        return true;
    for (int32_t i = 0; i < b.vertex_count; i++) {
        vec2 corner = {0, 0};
        record_stream_corner(s, &corner);
        if (!array_push(r->ctx, &r->outlines, corner))
            return false;
    }
    if (!b.moves)
        record_stream_pose(s, &b.position, &b.orientation);
    b.area = polygon_area(replay_outline(r, &b));
    return s->unsound || add_body(r, &b);
}

static bool read_births(replay *r, record_stream *s)
{
    int32_t count = 0;
    bool good = true;
    for (record_stream_count(s, &count); count > 0 && good && !s->unsound; count--)
        good = read_birth(r, s);
    return good;
}

static void read_deaths(replay *r, record_stream *s)
{
    int32_t count = 0;
    for (record_stream_count(s, &count); count > 0 && !s->unsound; count--) {
        int32_t slot = -1;
        record_stream_slot(s, &slot);
        remove_slot(r, slot);
    }
}

/* ---- frames ---- */

static bool read_fractures(replay *r, record_stream *s)
{
    int32_t count = 0;
    record_stream_padded_count(s, &count);
    for (int32_t i = 0; i < count && !s->unsound; i++) {
        record_fracture f = {0};
        record_stream_fracture(s, &f);
        if (!s->unsound && !array_push(r->ctx, &r->fractures, f))
            return false;
    }
    return true;
}

static bool read_forces(replay *r, record_stream *s)
{
    int32_t count = 0;
    record_stream_padded_count(s, &count);
    array_clear(&r->next.forces);
    for (int32_t i = 0; i < count && !s->unsound; i++) {
        record_force f = {.kind = RECORD_FORCE_ICE};
        record_stream_force(s, &f);
        int32_t which = f.which;
        if (record_force_pushes(f.kind))
            which = which >= 0 && which < r->at_slot.count ? r->at_slot.data[which] : -1;
        int32_t vessel = f.vessel == 0 && r->vessels == 1 ? 0 : f.vessel <= r->vessels ? f.vessel - 1 : -1;
        replay_force force = {f.kind, vessel, which, f.point, f.force};
        if (!s->unsound && !array_push(r->ctx, &r->next.forces, force))
            return false;
    }
    return true;
}

/* A piece is as old as the break that made it, which the blocks since the frame before tell; numbers of floes are used
   once. */
static double birth_of(const replay *r, const replay_body *b, const replay_frame *f)
{
    for (int32_t i = r->fractures.count - 1; i >= 0 && f->number > 0 && b->parent >= 0; i--) {
        const record_fracture *broke = &r->fractures.data[i];
        if (!(broke->time > r->frame.time))
            break;
        if (broke->floe == b->parent)
            return fmin(broke->time, f->time);
    }
    return f->time;
}

/* Poses come by ascending slot of the bodies that move; those that stand still are added. */
static bool read_frame(replay *r, record_stream *s, uint32_t type)
{
    replay_frame *f = &r->next;
    record_frame_head head = {0};
    record_stream_frame(s, &head);
    f->step = head.step;
    f->time = head.time;
    f->ice_force = head.ice_force;
    f->number = r->frames_read++;
    int32_t found = 0;
    array_clear(&f->poses);
    for (int moving = 1; moving >= 0; moving--) {
        for (int32_t slot = 0; slot < r->at_slot.count && !s->unsound; slot++) {
            int32_t body = r->at_slot.data[slot];
            if (body < 0 || r->bodies.data[body].moves != (moving == 1))
                continue;
            replay_body *b = &r->bodies.data[body];
            record_moving m = {b->position, b->orientation, 0};
            if (moving) {
                record_stream_moving(s, type, &m);
                found++;
            }
            if (b->born == f->number)
                b->birth = birth_of(r, b, f);
            replay_pose p = {body, m.position, m.orientation, {0, 0, 0}, m.contact_force};
            if (!array_push(r->ctx, &f->poses, p))
                return false;
        }
    }
    s->unsound = s->unsound || found != head.count;
    return true;
}

static fram_status wrong(const replay *r, const char *reason, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, r->reader.path, 0, NULL, "%s", reason);
}

static bool take_scenario(replay *r, const record_block *block)
{
    memory_free(r->ctx, r->scenario);
    r->scenario = memory_array(r->ctx, block->size + 1, 1);
    if (r->scenario && block->size > 0)
        memcpy(r->scenario, block->data, block->size);
    return r->scenario != NULL;
}

static fram_status read_block(replay *r, const record_block *block, fram_error *error)
{
    record_stream s = record_unpacker(block, r->origin);
    bool good = true;
    switch (block->type) {
    case BLOCK_SCENARIO:
        good = take_scenario(r, block);
        break;
    case BLOCK_ORIGIN:
        return record_take_origin(r->reader.path, block, &r->origin, error);
    case BLOCK_SOLID:
        good = read_solid(r, &s);
        break;
    case BLOCK_BIRTHS:
        good = read_births(r, &s);
        break;
    case BLOCK_DEATHS:
        read_deaths(r, &s);
        break;
    case BLOCK_FRACTURES:
        good = read_fractures(r, &s);
        break;
    case BLOCK_FORCES:
        good = read_forces(r, &s);
        break;
    case BLOCK_FRAME:
    case BLOCK_HALF_FRAME:
        good = read_frame(r, &s, block->type);
        break;
    default: /* of another version: of an earlier one it is refused, of a later one passed over */
        return record_check_block(r->reader.path, block->type, error);
    }
    if (!good)
        return error_memory(error);
    return s.unsound ? wrong(r, "a block of the record contradicts itself", error) : FRAM_OK;
}

/* The next frame of the file into r->next. */
static fram_status read_ahead(replay *r, fram_error *error)
{
    int64_t before = r->frames_read;
    bool found = true;
    array_clear(&r->next.forces);
    r->has_next = false;
    while (r->frames_read == before) {
        record_block block;
        fram_status status = record_next(&r->reader, &block, &found, error);
        if (status == FRAM_OK && !found)
            record_tell_damage(&r->reader, "what comes before it is used");
        if (status != FRAM_OK || !found)
            return status;
        status = read_block(r, &block, error);
        if (status != FRAM_OK)
            return status;
    }
    r->has_next = true;
    return FRAM_OK;
}

fram_status replay_open_any(context *ctx, const char *folder, replay *r, fram_error *error)
{
    char path[PATH_ROOM];
    memset(r, 0, sizeof *r);
    r->ctx = ctx;
    fram_status status = run_record_open(ctx, folder, path, &r->reader, error);
    if (status != FRAM_OK)
        return status;
    status = read_ahead(r, error);
    if (status != FRAM_OK)
        replay_close(r);
    return status;
}

fram_status replay_open(context *ctx, const char *folder, replay *r, fram_error *error)
{
    fram_status status = replay_open_any(ctx, folder, r, error);
    if (status != FRAM_OK || r->has_next)
        return status;
    status = record_refuse_frameless(&r->reader, error);
    replay_close(r);
    return status;
}

/* Of the tiles of level ice that drifts, which go as one and do not turn: of any that both frames have. */
static bool sheet_velocity(const replay *r, vec3 *out)
{
    for (int32_t i = 0; r->has_next && i < r->frame.poses.count; i++) {
        const replay_body *b = &r->bodies.data[r->frame.poses.data[i].body];
        if (!b->level || !b->moves || r->next_row.data[r->frame.poses.data[i].body] < 0)
            continue;
        *out = b->velocity;
        return true;
    }
    return false;
}

/* A floe that this frame alone has goes on as that did from which it broke, or as the sheet where no frame has that: it
   broke twice since the frame before.  sheet: 0 without one that drifts. */
static vec3 inherited_velocity(const replay *r, int32_t body, vec3 sheet)
{
    const replay_body *b = &r->bodies.data[body];
    for (int32_t i = body - 1; i >= 0 && b->parent >= 0; i--) {
        if (r->bodies.data[i].number == b->parent)
            return r->bodies.data[i].velocity;
    }
    return sheet;
}

/* Bodies that the next frame lacks: tiles go on with their sheet, floes as they came. */
static void carry_on(replay *r)
{
    vec3 sheet = {0, 0, 0};
    bool drifts = sheet_velocity(r, &sheet);
    for (int32_t i = 0; i < r->frame.poses.count; i++) {
        int32_t body = r->frame.poses.data[i].body;
        replay_body *b = &r->bodies.data[body];
        if (!b->moves || r->next_row.data[body] >= 0)
            continue;
        if (b->level && drifts)
            b->velocity = sheet;
        else if (b->born == r->frame.number)
            b->velocity = inherited_velocity(r, body, sheet);
        r->frame.poses.data[i].velocity = b->velocity;
    }
}

/* Velocities of the current frame from the way to the next one. */
static bool find_velocities(replay *r)
{
    if (!array_resize(r->ctx, &r->next_row, r->bodies.count))
        return false;
    for (int32_t i = 0; i < r->next_row.count; i++)
        r->next_row.data[i] = -1;
    for (int32_t i = 0; r->has_next && i < r->next.poses.count; i++)
        r->next_row.data[r->next.poses.data[i].body] = i;
    double span = r->next.time - r->frame.time;
    for (int32_t i = 0; i < r->frame.poses.count; i++) {
        replay_pose *p = &r->frame.poses.data[i];
        replay_body *b = &r->bodies.data[p->body];
        int32_t row = r->next_row.data[p->body];
        if (b->moves && row >= 0 && span > 0)
            b->velocity = vec3_scale(vec3_sub(r->next.poses.data[row].position, p->position), 1 / span);
        p->velocity = b->velocity;
    }
    carry_on(r);
    return true;
}

fram_status replay_next(replay *r, bool *found, fram_error *error)
{
    *found = r->has_next;
    if (!r->has_next)
        return FRAM_OK;
    replay_frame kept = r->frame;
    r->frame = r->next;
    r->next = kept;
    fram_status status =
        work_continue(r->ctx, "reading the record", (double)r->reader.position, (double)r->reader.file_size, error);
    if (status == FRAM_OK)
        status = read_ahead(r, error);
    if (status == FRAM_OK && !find_velocities(r))
        status = error_memory(error);
    return status;
}

void replay_close(replay *r)
{
    if (!r->ctx)
        return;
    record_reader_close(&r->reader);
    memory_free(r->ctx, r->scenario);
    array_free(r->ctx, &r->bodies);
    array_free(r->ctx, &r->outlines);
    array_free(r->ctx, &r->points);
    array_free(r->ctx, &r->faces);
    polygon_list_free(r->ctx, &r->parts);
    array_free(r->ctx, &r->fractures);
    array_free(r->ctx, &r->at_slot);
    array_free(r->ctx, &r->next_row);
    for (int k = 0; k < 2; k++) {
        replay_frame *f = k ? &r->next : &r->frame;
        array_free(r->ctx, &f->poses);
        array_free(r->ctx, &f->forces);
    }
    memset(r, 0, sizeof *r);
}

polygon replay_outline(const replay *r, const replay_body *b)
{
    /* Outlines of a record without any are nowhere. */
    return (polygon){b->vertex_count > 0 ? r->outlines.data + b->vertex_first : NULL, b->vertex_count};
}

int32_t replay_hull(const replay *r, int32_t vessel)
{
    /* Hulls are born in the order of the vessels. */
    for (int32_t i = 0; i < r->bodies.count; i++) {
        if (r->bodies.data[i].material == MATERIAL_HULL && vessel-- == 0)
            return i;
    }
    return -1;
}

vec2 replay_hull_size(const replay *r, int32_t vessel)
{
    int32_t body = replay_hull(r, vessel);
    vec2 lo = {HUGE_VAL, HUGE_VAL}, hi = {-HUGE_VAL, -HUGE_VAL};
    if (body < 0)
        return vec2_make(0, 0);
    const replay_body *b = &r->bodies.data[body];
    for (int32_t i = 0; i < b->vertex_count; i++) {
        vec3 p = r->points.data[b->vertex_first + i];
        lo = vec2_make(fmin(lo.x, p.x), fmin(lo.y, p.y));
        hi = vec2_make(fmax(hi.x, p.x), fmax(hi.y, p.y));
    }
    return b->vertex_count > 0 ? vec2_sub(hi, lo) : vec2_make(0, 0);
}
