#include "io/record_blocks.h"

#include <math.h>
#include <string.h>

record_stream record_packer(context *ctx, byte_array *out, vec2 origin)
{
    array_clear(out);
    return (record_stream){.ctx = ctx, .out = out, .origin = origin};
}

record_stream record_unpacker(const record_block *block, vec2 origin)
{
    static const unsigned char nothing[1]; /* an empty block has no data */
    const unsigned char *data = block->size > 0 ? block->data : nothing;
    return (record_stream){.at = data, .end = data + block->size, .origin = origin};
}

/* ---- numbers ---- */

static void pass(record_stream *s, void *value, size_t size)
{
    if (s->out) {
        int32_t at = s->out->count;
        s->full = s->full || size > (size_t)(INT32_MAX - at) || !array_resize(s->ctx, s->out, at + (int32_t)size);
        if (!s->full)
            memcpy(s->out->data + at, value, size);
        return;
    }
    if ((size_t)(s->end - s->at) < size) {
        s->unsound = true;
        memset(value, 0, size);
        return;
    }
    memcpy(value, s->at, size);
    s->at += size;
}

static void pass_i32(record_stream *s, int32_t *value) { pass(s, value, sizeof *value); }

static void pass_nothing(record_stream *s)
{
    int32_t zero = 0;
    pass_i32(s, &zero);
}

static void pass_flag(record_stream *s, bool *value)
{
    uint8_t byte = s->out && *value ? 1 : 0; /* what is yet to be read may be no bool */
    pass(s, &byte, sizeof byte);
    if (!s->out)
        *value = byte != 0;
}

/* Numbers of a record are finite: a run that is not stops before it writes. */
static void judge(record_stream *s, double value) { s->unsound = s->unsound || (!s->out && !isfinite(value)); }

static void pass_f32(record_stream *s, double *value)
{
    float f = s->out ? (float)*value : 0;
    pass(s, &f, sizeof f);
    if (!s->out)
        *value = (double)f;
    judge(s, *value);
}

static void pass_f64(record_stream *s, double *value)
{
    pass(s, value, sizeof *value);
    judge(s, *value);
}

static void pass_vec3(record_stream *s, vec3 *v)
{
    pass_f32(s, &v->x);
    pass_f32(s, &v->y);
    pass_f32(s, &v->z);
}

static vec3 near_origin(const record_stream *s, vec3 place)
{
    return vec3_make(place.x - s->origin.x, place.y - s->origin.y, place.z);
}
static vec3 from_near(const record_stream *s, vec3 near)
{
    return vec3_make(near.x + s->origin.x, near.y + s->origin.y, near.z);
}

static void pass_place(record_stream *s, vec3 *place)
{
    vec3 near = near_origin(s, *place);
    pass_vec3(s, &near);
    if (!s->out)
        *place = from_near(s, near);
}

/* Room for as many things of `size` bytes each must be left in a block that is unpacked. */
static void reach(record_stream *s, int32_t count, size_t size)
{
    if (!s->out && (count < 0 || (size_t)count > (size_t)(s->end - s->at) / size))
        s->unsound = true;
}

/* ---- heads ---- */

void record_stream_count(record_stream *s, int32_t *count) { pass_i32(s, count); }

void record_stream_padded_count(record_stream *s, int32_t *count)
{
    pass_i32(s, count);
    pass_nothing(s);
}

void record_stream_set_count(record_stream *s, uint32_t type, int32_t count)
{
    size_t at = type == BLOCK_FRAME ? FRAME_HEAD_SIZE - 2 * sizeof count : 0;
    if (!s->full)
        memcpy(s->out->data + at, &count, sizeof count);
}

/* ---- bodies ---- */

void record_stream_slot(record_stream *s, int32_t *slot) { pass_i32(s, slot); }

void record_stream_solid(record_stream *s, record_solid *b)
{
    pass_i32(s, &b->slot);
    pass(s, &b->generation, sizeof b->generation);
    pass_i32(s, &b->vertices);
    pass_i32(s, &b->faces);
    enum { POINT_SIZE = 12, FACE_SIZE = 12 };
    reach(s, b->vertices, POINT_SIZE);
    reach(s, b->faces, FACE_SIZE);
}

void record_stream_point(record_stream *s, vec3 *point) { pass_vec3(s, point); }

void record_stream_face(record_stream *s, int32_t corner[3]) { pass(s, corner, 3 * sizeof *corner); }

void record_stream_birth(record_stream *s, record_birth *b)
{
    pass_i32(s, &b->slot);
    pass(s, &b->generation, sizeof b->generation);
    pass(s, &b->material, sizeof b->material);
    pass_flag(s, &b->moves);
    pass_flag(s, &b->breakable);
    pass_flag(s, &b->level);
    pass_f32(s, &b->thickness);
    pass_f32(s, &b->density);
    pass_i32(s, &b->number);
    pass_i32(s, &b->parent);
    pass_i32(s, &b->vertices);
    enum { CORNER_SIZE = 8 };
    reach(s, b->vertices, CORNER_SIZE);
}

void record_stream_corner(record_stream *s, vec2 *corner)
{
    pass_f32(s, &corner->x);
    pass_f32(s, &corner->y);
}

void record_stream_pose(record_stream *s, vec3 *position, quat *orientation)
{
    unsigned char packed[RECORD_POSE_SIZE];
    if (s->out)
        record_pose_pack(near_origin(s, *position), *orientation, packed);
    pass(s, packed, sizeof packed);
    if (s->out)
        return;
    record_pose_unpack(packed, position, orientation);
    *position = from_near(s, *position);
}

/* ---- events and forces ---- */

void record_stream_fracture(record_stream *s, record_fracture *f)
{
    pass_f64(s, &f->time);
    pass_i32(s, &f->kind);
    pass_i32(s, &f->floe);
    pass_i32(s, &f->pieces);
    pass_nothing(s);
    pass_place(s, &f->place);
    pass_f32(s, &f->load);
    pass_f32(s, &f->crack_length);
    pass_f32(s, &f->area);
}

/* Kind and vessel are one number. */
enum { FORCE_KINDS = 256 };

void record_stream_force(record_stream *s, record_force *f)
{
    int32_t told = (int32_t)f->kind + FORCE_KINDS * f->vessel;
    pass_i32(s, &told);
    const int32_t kind = told % FORCE_KINDS;
    pass_i32(s, &f->which);
    pass_place(s, &f->point);
    pass_vec3(s, &f->force);
    s->unsound = s->unsound || kind < RECORD_FORCE_ICE || kind > RECORD_FORCE_HULL;
    if (!s->out) {
        f->kind = s->unsound ? RECORD_FORCE_ICE : (record_force_kind)kind;
        f->vessel = s->unsound ? 0 : told / FORCE_KINDS;
    }
}

/* ---- frames ---- */

void record_stream_frame(record_stream *s, record_frame_head *f)
{
    pass(s, &f->step, sizeof f->step);
    pass_f64(s, &f->time);
    pass_f64(s, &f->ice_force.x);
    pass_f64(s, &f->ice_force.y);
    pass_f64(s, &f->ice_force.z);
    record_stream_padded_count(s, &f->count);
}

static void pack_moving(record_stream *s, record_moving *m)
{
    unsigned char packed[RECORD_POSE_SIZE];
    uint16_t touched = record_force_pack(m->contact_force);
    record_pose_pack(near_origin(s, m->position), m->orientation, packed);
    if (touched)
        record_pose_mark(packed);
    pass(s, packed, sizeof packed);
    if (touched)
        pass(s, &touched, sizeof touched);
}

static void unpack_moving(record_stream *s, bool halves, record_moving *m)
{
    unsigned char packed[RECORD_POSE_SIZE];
    uint16_t touched = 0;
    pass(s, packed, sizeof packed);
    record_pose_unpack(packed, &m->position, &m->orientation);
    m->position = from_near(s, m->position);
    if (record_pose_is_marked(packed))
        pass(s, &touched, sizeof touched);
    m->contact_force = halves ? real_from_half(touched) * 1e3 : record_force_unpack(touched);
}

/* Most bodies have no contact force, and are a pose alone. */
void record_stream_moving(record_stream *s, uint32_t type, record_moving *m)
{
    if (s->out)
        pack_moving(s, m);
    else
        unpack_moving(s, type == BLOCK_HALF_FRAME, m);
}
