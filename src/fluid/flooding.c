#include "fluid/flooding.h"

#include "fluid/facet.h"

#define TABLE_SELF flooding_table
TABLE_DEFINE(flooding, FLOODING_FIELDS)
#undef TABLE_SELF

/* The level is found when the volume under it is right to this part of the room; Newton's steps go down from above, the
   volume being convex in the level, and near a deepest corner each takes a third of what is left. */
#define CLOSE_VOLUME 1e-12
enum { MOST_STEPS = 100 };

/* The cap that looks up. */
typedef struct upper_face {
    polygon outline;
    mat3 rotation;
    vec3 offset;   /* from the middle plane to the face, global axes [m] */
    vec3 centre;   /* of its fans, relative to the centre of mass [m] */
    double height; /* of the centre of mass over still water [m] */
    bool bottom;   /* of a floe that lies upside down */
} upper_face;

/* What is under a level. */
typedef struct pool {
    pressure_sum pressure; /* heights are those over the level */
    double volume;         /* between face and level [m3] */
    double area;           /* of the level over the face [m2] */
} pool;

static vec3 on_face(const upper_face *f, vec2 p)
{
    return vec3_add(mat3_mul_vec(f->rotation, vec3_make(p.x, p.y, 0)), f->offset);
}

static upper_face find_upper_face(polygon outline, double half_height, const mat3 *rotation, double height)
{
    vec3 axis = mat3_column(*rotation, 2);
    bool bottom = axis.z < 0;
    upper_face f = {.outline = outline,
                    .rotation = *rotation,
                    .offset = vec3_scale(axis, bottom ? -half_height : half_height),
                    .height = height,
                    .bottom = bottom};
    f.centre = on_face(&f, polygon_moments_of(outline).centroid);
    return f;
}

static pool pool_under(const upper_face *f, double level)
{
    pool out = {{{0, 0, 0}, {0, 0, 0}}, 0, 0};
    vec3 a = on_face(f, f->outline.vertex[f->outline.count - 1]);
    for (int32_t i = 0; i < f->outline.count; i++) {
        vec3 b = on_face(f, f->outline.vertex[i]), part[FACET_VERTICES];
        const vec3 corner[3] = {f->centre, f->bottom ? b : a, f->bottom ? a : b};
        int n = facet_clip(corner, 3, vec3_make(0, 0, 1), level - f->height, part);
        facet_add_pressure(&out.pressure, part, n, f->height - level);
        for (int k = 1; k + 1 < n; k++)
            out.area += 0.5 * vec3_cross(vec3_sub(part[k], part[0]), vec3_sub(part[k + 1], part[0])).z;
        a = b;
    }
    out.volume = -out.pressure.force.z;
    return out;
}

/* The pool of a volume of water, less than the room's, which is that under the water plane. */
static pool pool_of(const upper_face *f, const pool *room, double water)
{
    pool p = *room;
    double level = 0;
    if (!(water > 0))
        return (pool){{{0, 0, 0}, {0, 0, 0}}, 0, 0};
    for (int i = 0; i < MOST_STEPS && p.area > 0 && p.volume - water > CLOSE_VOLUME * room->volume; i++) {
        level -= (p.volume - water) / p.area;
        p = pool_under(f, level);
    }
    return p;
}

double flooding_discharge(double gravity, double depth_a, double depth_b, double width)
{
    /* int d^1.5 over a linear d: (2/5) (b^5 - a^5)/(b^2 - a^2) of the roots a and b, without the difference. */
    double a = sqrt(depth_a), b = sqrt(depth_b), sum = a + b;
    if (!(sum > 0))
        return 0;
    double quartic = a * a * (a * a + a * b + b * b) + b * b * b * sum;
    return (8.0 / 27) * sqrt(gravity) * width * (2.0 / 5) * quartic / sum;
}

/* Over all edges as far as they are under the water plane. */
static double inflow(const upper_face *f, double gravity)
{
    double sum = 0;
    vec3 a = on_face(f, f->outline.vertex[f->outline.count - 1]);
    for (int32_t i = 0; i < f->outline.count; i++) {
        vec3 b = on_face(f, f->outline.vertex[i]);
        double depth_a = -(a.z + f->height), depth_b = -(b.z + f->height), along_x = b.x - a.x, along_y = b.y - a.y;
        double width = sqrt(along_x * along_x + along_y * along_y);
        double deep = fmax(depth_a, depth_b), high = fmin(depth_a, depth_b);
        if (high < 0 && deep > 0)
            width *= deep / (deep - high);
        sum += flooding_discharge(gravity, fmax(depth_a, 0), fmax(depth_b, 0), width);
        a = b;
    }
    return sum;
}

static bool is_above(const upper_face *f, vec2 p) { return on_face(f, p).z + f->height >= 0; }

/* Corners of the face that are not under the water plane. */
static int32_t corners_above(const upper_face *f)
{
    int32_t count = 0;
    for (int32_t i = 0; i < f->outline.count; i++)
        count += is_above(f, f->outline.vertex[i]);
    return count;
}

/* The water over a face with this room now; what was over the other face, or before the body was seen, is not known. */
static double water_now(const flooding_state *s, flooding_face face, double room)
{
    if (s->face != face || s->drowned || !(s->water < room))
        return room;
    return s->water > 0 ? s->water : 0;
}

wrench flooding_advance(const media *m, polygon outline, double half_height, const mat3 *rotation, double height,
                        double time_step, flooding_state *state)
{
    wrench missing = {{0, 0, 0}, {0, 0, 0}};
    upper_face f = find_upper_face(outline, half_height, rotation, height);
    flooding_face face = f.bottom ? FLOODING_BOTTOM : FLOODING_TOP;
    int32_t above = corners_above(&f);
    if (above == outline.count || (above == 0 && state->drowned)) {
        *state = (flooding_state){0, face, above == 0};
        return missing;
    }
    pool room = pool_under(&f, 0);
    double water = water_now(state, face, room.volume);
    bool flooded = !(water < room.volume);
    if (!flooded) {
        pool p = pool_of(&f, &room, water);
        double weight = m->water_density * m->gravity;
        missing.force = vec3_scale(vec3_sub(p.pressure.force, room.pressure.force), weight);
        missing.moment = vec3_scale(vec3_sub(p.pressure.moment, room.pressure.moment), weight);
    }
    bool drowned = flooded && above == 0;
    *state = (flooding_state){drowned ? 0 : water + time_step * inflow(&f, m->gravity), face, drowned};
    return missing;
}
