#include "results/replay.h"

#include "io/record_pose.h"
#include "results/run_record.h"

#include <math.h>
#include <string.h>

/* ---- a block, read from front to back ---- */

/* A payload is sound to its checksum, yet lengths in it are believed only as far as it reaches. */
typedef struct cursor {
    const unsigned char *at, *end;
    bool unsound; /* something beyond the end was asked for (zeros were given), or what was read cannot be */
} cursor;

static void take(cursor *c, void *out, size_t size)
{
    if ((size_t)(c->end - c->at) < size) {
        c->unsound = true;
        memset(out, 0, size);
        return;
    }
    memcpy(out, c->at, size);
    c->at += size;
}
static int32_t take_i32(cursor *c)
{
    int32_t v;
    take(c, &v, sizeof v);
    return v;
}
/* Numbers of a record are finite: a run that is not stops before it writes. */
static double finite(cursor *c, double v)
{
    c->unsound = c->unsound || !isfinite(v);
    return v;
}
static double take_f32(cursor *c)
{
    float v;
    take(c, &v, sizeof v);
    return finite(c, (double)v);
}
static double take_f64(cursor *c)
{
    double v;
    take(c, &v, sizeof v);
    return finite(c, v);
}
static vec3 take_vec3(cursor *c)
{
    double x = take_f32(c), y = take_f32(c), z = take_f32(c);
    return vec3_make(x, y, z);
}
static vec3 at_origin(const replay *r, vec3 place)
{
    return vec3_make(place.x + r->origin.x, place.y + r->origin.y, place.z);
}
/* Whether the pose is marked. */
static bool take_pose(const replay *r, cursor *c, vec3 *position, quat *orientation)
{
    unsigned char packed[RECORD_POSE_SIZE];
    take(c, packed, sizeof packed);
    record_pose_unpack(packed, position, orientation);
    *position = at_origin(r, *position);
    return record_pose_is_marked(packed);
}
/* Room for `count` things of `size` bytes each is left. */
static bool reaches(cursor *c, int32_t count, size_t size)
{
    if (count < 0 || (size_t)count > (size_t)(c->end - c->at) / size)
        c->unsound = true;
    return !c->unsound;
}

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

static replay_body new_body(const replay *r, cursor *c)
{
    replay_body b = {.slot = take_i32(c), .born = r->frames_read};
    b.number = b.parent = b.vessel = -1;
    (void)take_i32(c); /* generation */
    if (b.slot < 0 || b.slot >= SLOTS_MOST)
        c->unsound = true;
    return b;
}

static bool read_solid(replay *r, cursor *c)
{
    replay_body b = new_body(r, c);
    b.material = MATERIAL_HULL;
    b.moves = b.solid = true;
    b.vessel = r->vessels++;
    b.vertex_count = take_i32(c);
    b.face_count = take_i32(c);
    b.vertex_first = r->points.count;
    b.face_first = r->faces.count / 3;
    if (!reaches(c, b.vertex_count, 12))
        return true;
    for (int32_t i = 0; i < b.vertex_count; i++) {
        if (!array_push(r->ctx, &r->points, take_vec3(c)))
            return false;
    }
    if (!reaches(c, b.face_count, 12))
        return true;
    for (int32_t i = 0; i < 3 * b.face_count; i++) {
        int32_t v = take_i32(c);
        c->unsound = c->unsound || v < 0 || v >= b.vertex_count;
        if (!array_push(r->ctx, &r->faces, v))
            return false;
    }
    return c->unsound || add_body(r, &b);
}

static bool read_birth(replay *r, cursor *c)
{
    unsigned char kind[4];
    replay_body b = new_body(r, c);
    take(c, kind, sizeof kind);
    b.material = kind[0] < MATERIALS ? kind[0] : MATERIAL_WALL;
    b.moves = kind[1] != 0;
    b.breakable = kind[2] != 0;
    b.level = kind[3] != 0;
    b.thickness = take_f32(c);
    b.density = take_f32(c);
    b.number = take_i32(c);
    b.parent = take_i32(c);
    b.vertex_count = take_i32(c);
    b.vertex_first = r->outlines.count;
    c->unsound = c->unsound || b.vertex_count < 3;
    if (!reaches(c, b.vertex_count, 8))
        return true;
    for (int32_t i = 0; i < b.vertex_count; i++) {
        double x = take_f32(c), y = take_f32(c);
        if (!array_push(r->ctx, &r->outlines, vec2_make(x, y)))
            return false;
    }
    if (!b.moves)
        (void)take_pose(r, c, &b.position, &b.orientation);
    b.area = polygon_area(replay_outline(r, &b));
    return c->unsound || add_body(r, &b);
}

static bool read_births(replay *r, cursor *c)
{
    bool good = true;
    for (int32_t n = take_i32(c); n > 0 && good && !c->unsound; n--)
        good = read_birth(r, c);
    return good;
}

/* ---- frames ---- */

static bool read_fractures(replay *r, cursor *c)
{
    int32_t count = take_i32(c);
    (void)take_i32(c);
    for (int32_t i = 0; i < count && !c->unsound; i++) {
        replay_fracture f = {.time = take_f64(c)};
        f.kind = take_i32(c);
        f.floe = take_i32(c);
        f.pieces = take_i32(c);
        (void)take_i32(c);
        f.place = at_origin(r, take_vec3(c));
        f.load = take_f32(c);
        f.crack_length = take_f32(c);
        f.area = take_f32(c);
        if (!c->unsound && !array_push(r->ctx, &r->fractures, f))
            return false;
    }
    return true;
}

static bool read_forces(replay *r, cursor *c)
{
    int32_t count = take_i32(c);
    (void)take_i32(c);
    array_clear(&r->next.forces);
    for (int32_t i = 0; i < count && !c->unsound; i++) {
        int32_t kind = take_i32(c), which = take_i32(c);
        vec3 point = at_origin(r, take_vec3(c)), force = take_vec3(c);
        c->unsound = c->unsound || kind < RECORD_FORCE_ICE || kind > RECORD_FORCE_HULL;
        if (record_force_pushes((record_force_kind)kind))
            which = which >= 0 && which < r->at_slot.count ? r->at_slot.data[which] : -1;
        if (!c->unsound &&
            !array_push(r->ctx, &r->next.forces, (replay_force){(record_force_kind)kind, which, point, force}))
            return false;
    }
    return true;
}

/* A piece is as old as the break that made it, which the blocks since the frame before tell; numbers of floes are used
   once. */
static double birth_of(const replay *r, const replay_body *b, const replay_frame *f)
{
    for (int32_t i = r->fractures.count - 1; i >= 0 && f->number > 0 && b->parent >= 0; i--) {
        const replay_fracture *broke = &r->fractures.data[i];
        if (!(broke->time > r->frame.time))
            break;
        if (broke->floe == b->parent)
            return fmin(broke->time, f->time);
    }
    return f->time;
}

/* Poses come by ascending slot of the bodies that move; those that stand still are added.  halves: contact forces are
   those of an earlier layout. */
static bool read_frame(replay *r, cursor *c, bool halves)
{
    replay_frame *f = &r->next;
    take(c, &f->step, sizeof f->step);
    f->time = take_f64(c);
    double x = take_f64(c), y = take_f64(c), z = take_f64(c);
    f->ice_force = vec3_make(x, y, z);
    f->number = r->frames_read++;
    int32_t count = take_i32(c), found = 0;
    (void)take_i32(c);
    array_clear(&f->poses);
    for (int moving = 1; moving >= 0; moving--) {
        for (int32_t slot = 0; slot < r->at_slot.count && !c->unsound; slot++) {
            int32_t body = r->at_slot.data[slot];
            if (body < 0 || r->bodies.data[body].moves != (moving == 1))
                continue;
            replay_body *b = &r->bodies.data[body];
            replay_pose p = {.body = body, .position = b->position, .orientation = b->orientation};
            uint16_t touched = 0;
            if (moving) {
                if (take_pose(r, c, &p.position, &p.orientation))
                    take(c, &touched, sizeof touched);
                p.contact_force = halves ? real_from_half(touched) * 1e3 : record_force_unpack(touched);
                found++;
            }
            if (b->born == f->number)
                b->birth = birth_of(r, b, f);
            if (!array_push(r->ctx, &f->poses, p))
                return false;
        }
    }
    c->unsound = c->unsound || found != count;
    return true;
}

static fram_status wrong(const replay *r, const char *reason, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, r->reader.path, 0, NULL, "%s", reason);
}

static fram_status read_block(replay *r, const record_block *block, fram_error *error)
{
    static const unsigned char nothing[1]; /* an empty block has no data */
    const unsigned char *data = block->size > 0 ? block->data : nothing;
    cursor c = {data, data + block->size, false};
    bool good = true;
    switch (block->type) {
    case BLOCK_SCENARIO:
        memory_free(r->ctx, r->scenario);
        r->scenario = memory_array(r->ctx, block->size + 1, 1);
        good = r->scenario != NULL;
        if (good)
            take(&c, r->scenario, block->size);
        break;
    case BLOCK_ORIGIN:
        return record_take_origin(r->reader.path, block, &r->origin, error);
    case BLOCK_SOLID:
        good = read_solid(r, &c);
        break;
    case BLOCK_BIRTHS:
        good = read_births(r, &c);
        break;
    case BLOCK_DEATHS:
        for (int32_t n = take_i32(&c); n > 0 && !c.unsound; n--)
            remove_slot(r, take_i32(&c));
        break;
    case BLOCK_FRACTURES:
        good = read_fractures(r, &c);
        break;
    case BLOCK_FORCES:
        good = read_forces(r, &c);
        break;
    case BLOCK_FRAME:
    case BLOCK_HALF_FRAME:
        good = read_frame(r, &c, block->type == BLOCK_HALF_FRAME);
        break;
    default: /* of another version: of an earlier one it is refused, of a later one passed over */
        return record_check_block(r->reader.path, block->type, error);
    }
    if (!good)
        return error_memory(error);
    return c.unsound ? wrong(r, "a block of the record contradicts itself", error) : FRAM_OK;
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
