#include "results/video_scene.h"

#include "base/load_unit.h"
#include "geometry/ear_clip.h"
#include "io/solid_view.h"

#include <stdio.h>

static const char *const camera_names[VIDEO_CAMERA_COUNT] = {"plan", "orbit", "follow"};

const char *video_camera_name(video_camera camera) { return camera_names[camera]; }

#ifdef FRAM_HAVE_CAIRO

enum { ABOVE = 60, BELOW = 40, LINE = 16, EDGE = 14 };
/* What is written under the scene is one line in pictures that are so wide, two lines in those of a middle width, else
   four. [pixels] */
enum { WIDE = 1200, MIDDLE = 680, AXES = 60 };
static const double sky[3] = {0.87, 0.91, 0.94}, water[3] = {0.18, 0.40, 0.56}, rim[3] = {0.36, 0.45, 0.53};
static const double ice[3] = {0.95, 0.97, 0.98}, hull[3] = {0.71, 0.25, 0.16}, wall[3] = {0.48, 0.45, 0.42};
static const double water_cover = 0.86;
static const image_colour ink = {0.1, 0.1, 0.1}, mark = {0.902, 0.624, 0};
/* By record_force_kind, the same as in the playback page. */
static const struct {
    image_colour colour;
    const char *name;
} forces[] = {[RECORD_FORCE_ICE] = {{0.800, 0.310, 0.592}, "ice"},
              [RECORD_FORCE_LINE] = {{0, 0.565, 0.345}, "line"},
              [RECORD_FORCE_THRUSTER] = {{0.290, 0.063, 0.706}, "thruster"},
              [RECORD_FORCE_HULL] = {{0.353, 0.227, 0}, "hull or wall"}};
enum { FORCE_KINDS = sizeof forces / sizeof *forces };

/* ---- camera ---- */

static vec3 target_of(const video_scene *s, const replay *r, const replay_moment *m)
{
    for (int32_t i = 0; i < m->poses.count && s->camera == VIDEO_FOLLOW; i++) {
        if (r->bodies.data[m->poses.data[i].body].solid)
            return vec3_make(m->poses.data[i].position.x, m->poses.data[i].position.y, 0);
    }
    return vec3_make((s->extent.lo.x + s->extent.hi.x) / 2, (s->extent.lo.y + s->extent.hi.y) / 2, 0);
}

/* Half a picture's height over that of what is in it: nothing touches the edge. */
#define BORDER 1.03

/* Back from the target until all of the field is in a picture that is so many times as high as wide: as the playback
   page does. */
static void show_whole(const video_scene *s, double upright, solid_camera *c)
{
    vec3 ahead = vec3_unit(vec3_sub(c->target, c->eye)), right = vec3_unit(vec3_cross(ahead, vec3_make(0, 0, 1)));
    vec3 up = vec3_cross(right, ahead);
    double away = vec3_length(vec3_sub(c->target, c->eye));
    for (int i = 0; i < 8; i++) {
        vec3 corner =
            vec3_make(i & 1 ? s->whole.hi.x : s->whole.lo.x, i & 2 ? s->whole.hi.y : s->whole.lo.y, i & 4 ? s->top : 0);
        vec3 p = vec3_sub(corner, c->target);
        double reach = fmax(fabs(vec3_dot(p, up)), fabs(vec3_dot(p, right)) * upright);
        away = fmax(away, BORDER * 2 * c->zoom * reach - vec3_dot(p, ahead));
    }
    c->eye = vec3_mad(c->target, ahead, -away);
}

/* upright: height of the picture over its width. */
static solid_camera camera_of(const video_scene *s, const replay *r, const replay_moment *m, double upright)
{
    solid_camera c = {.target = target_of(s, r, m), .zoom = 1.374};
    if (s->camera == VIDEO_FOLLOW) {
        c.eye = vec3_mad(c.target, vec3_make(-0.28, -0.3, 0.2), s->near * fmax(1, upright));
        return c;
    }
    double wide = fmax(s->extent.hi.x - s->extent.lo.x, s->extent.hi.y - s->extent.lo.y);
    c.eye = vec3_mad(c.target, vec3_make(-0.55, -0.75, 0.6), wide);
    show_whole(s, upright, &c);
    return c;
}

/* ---- bodies ---- */

static void colour_of(const video_scene *s, const replay_body *b, const replay_pose *p, double time, double rgb[3])
{
    const double *own = b->material == MATERIAL_ICE ? ice : b->material == MATERIAL_HULL ? hull : wall;
    double value = plan_colour_value(s->colour, b, p, time);
    for (int i = 0; i < 3; i++)
        rgb[i] = own[i];
    if (value == value)
        image_ramp(s->hi > s->lo ? fmin(fmax((value - s->lo) / (s->hi - s->lo), 0), 1) : 0, rgb);
}

static void draw_solid(solid_view *v, const replay *r, const replay_body *b, const replay_pose *p, const double rgb[3])
{
    mat3 turn = quat_matrix(p->orientation);
    for (int32_t f = 0; f < b->face_count; f++) {
        vec3 corner[3];
        for (int k = 0; k < 3; k++) {
            int32_t at = b->vertex_first + r->faces.data[3 * (b->face_first + f) + k];
            corner[k] = vec3_add(p->position, mat3_mul_vec(turn, r->points.data[at]));
        }
        solid_view_triangle(v, corner[0], corner[1], corner[2], rgb);
    }
}

/* Top, sides and, but for tiles of level ice, upper rim; what is seen from above only. */
static fram_status draw_prism(context *ctx, solid_view *v, const replay *r, const replay_body *b, const replay_pose *p,
                              const double rgb[3], index_array *corners, fram_error *error)
{
    polygon outline = replay_outline(r, b);
    mat3 turn = quat_matrix(p->orientation);
    vec3 half = vec3_scale(mat3_column(turn, 2), b->thickness / 2);
    ARRAY(vec3) top = {0};
    bool good = polygon_triangulate_ears(ctx, outline, corners) != FRAM_ERROR_MEMORY;
    for (int32_t i = 0; i < outline.count && good; i++) {
        vec3 local = vec3_make(outline.vertex[i].x, outline.vertex[i].y, 0);
        good = array_push(ctx, &top, vec3_add(vec3_add(p->position, mat3_mul_vec(turn, local)), half));
    }
    for (int32_t i = 0; i + 2 < corners->count && good && top.data; i += 3)
        solid_view_triangle(v, top.data[corners->data[i]], top.data[corners->data[i + 1]],
                            top.data[corners->data[i + 2]], rgb);
    for (int32_t i = 0; i < top.count && good; i++) {
        vec3 a = top.data[i], c = top.data[(i + 1) % top.count];
        vec3 below_a = vec3_mad(a, half, -2), below_c = vec3_mad(c, half, -2);
        solid_view_triangle(v, below_a, below_c, c, rgb);
        solid_view_triangle(v, below_a, c, a, rgb);
        if (!b->level)
            solid_view_line(v, a, c, rim);
    }
    array_free(ctx, &top);
    return good ? FRAM_OK : error_memory(error);
}

static fram_status draw_bodies(context *ctx, const video_scene *s, const replay *r, const replay_moment *m,
                               solid_view *v, fram_error *error)
{
    index_array corners = {0};
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < m->poses.count && status == FRAM_OK; i++) {
        const replay_pose *p = &m->poses.data[i];
        const replay_body *b = &r->bodies.data[p->body];
        double rgb[3];
        colour_of(s, b, p, m->time, rgb);
        if (b->solid)
            draw_solid(v, r, b, p, rgb);
        else
            status = draw_prism(ctx, v, r, b, p, rgb, &corners, error);
    }
    array_free(ctx, &corners);
    solid_view_water(v, water, water_cover);
    return status;
}

/* ---- what is drawn over it ---- */

/* [pixels] */
enum { ARROW_WIDTH = 2, ARROW_HEAD = 12 };

/* Contacts push: their arrows end where they do; lines and thrusters pull: theirs begin there. edges: what is white
   round them, under all of them. */
static void draw_forces(cairo_t *page, const video_scene *s, const replay *r, const solid_view *v, bool edges,
                        bool used[FORCE_KINDS])
{
    for (int32_t i = 0; i < r->frame.forces.count && s->arrow > 0; i++) {
        const replay_force *f = &r->frame.forces.data[i];
        vec3 way = vec3_scale(f->force, s->arrow), from = f->point, to = vec3_add(f->point, way);
        double x0, y0, x1, y1;
        if (record_force_pushes(f->kind)) {
            to = f->point;
            from = vec3_sub(f->point, way);
        }
        used[f->kind] = true;
        if (!solid_view_place(v, from, &x0, &y0) || !solid_view_place(v, to, &x1, &y1))
            continue;
        if (edges) {
            image_arrow_halo(page, x0, y0, x1, y1, ARROW_WIDTH, ARROW_HEAD);
            continue;
        }
        image_set_colour(page, forces[f->kind].colour);
        image_arrow(page, x0, y0, x1, y1, ARROW_WIDTH, ARROW_HEAD);
    }
}

static bool draw_marks(cairo_t *page, const video_scene *s, const replay *r, const replay_moment *m,
                       const solid_view *v)
{
    bool any = false;
    for (int32_t i = 0; i < r->fractures.count; i++) {
        const record_fracture *f = &r->fractures.data[i];
        double x, y;
        if (f->time > m->time || f->time <= m->time - s->mark_time || !solid_view_place(v, f->place, &x, &y))
            continue;
        image_set_colour(page, ink);
        cairo_rectangle(page, x - 4, y - 4, 8, 8);
        cairo_fill(page);
        image_set_colour(page, mark);
        cairo_rectangle(page, x - 3, y - 3, 6, 6);
        cairo_fill(page);
        any = true;
    }
    return any;
}

/* X and Y as they are seen at the target. */
static void draw_axes(cairo_t *page, const solid_view *v, const solid_camera *c, double x, double y)
{
    double distance = vec3_length(vec3_sub(c->target, c->eye)), x0, y0, x1, y1;
    static const char *const letters[] = {"X", "Y"};
    if (!solid_view_place(v, c->target, &x0, &y0))
        return;
    for (int i = 0; i < 2; i++) {
        vec3 step = i == 0 ? vec3_make(0.02 * distance, 0, 0) : vec3_make(0, 0.02 * distance, 0);
        if (!solid_view_place(v, vec3_add(c->target, step), &x1, &y1))
            continue;
        double length = sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)), k = length > 0 ? 20 / length : 0;
        image_set_colour(page, ink);
        image_arrow(page, x, y, x + k * (x1 - x0), y + k * (y1 - y0), ARROW_WIDTH, ARROW_HEAD);
        image_text(page, x + 1.5 * k * (x1 - x0), y + 1.5 * k * (y1 - y0) + 4, 12, ALIGN_CENTRE, true, letters[i]);
    }
}

/* It holds at the target. */
static double draw_scale_bar(cairo_t *page, const solid_view *v, const solid_camera *c, double arrow, double x,
                             double y)
{
    double metres = vec3_length(vec3_sub(c->target, c->eye)) / v->focal * SOLID_FINE;
    /* The force stands beside it, which in a narrow picture takes half of it. */
    double most = fmin(220, 0.35 * v->width / SOLID_FINE);
    double length = image_round_step(most * metres, 2), px = length / metres;
    char text[96];
    snprintf(text, sizeof text, arrow > 0 ? "%g m, as an arrow %s" : "%g m", length,
             load_text_of(arrow > 0 ? length / arrow : 0, 3).text);
    image_set_colour(page, ink);
    cairo_rectangle(page, x, y - 6, px, 6);
    cairo_fill(page);
    image_text(page, x + px + 8, y, 12, ALIGN_LEFT, false, text);
    return x + px + 8 + image_text_width(page, 12, false, text) + 24;
}

/* A line of keys that goes on in the next one where the picture ends. */
typedef struct key_line {
    cairo_t *page;
    double x, y, right;
} key_line;

/* A text, behind its colour where it has one. */
static void draw_key(key_line *k, const image_colour *colour, const char *name)
{
    double sign = colour ? 16 : 0, wide = sign + image_text_width(k->page, 12, false, name);
    if (k->x + wide > k->right && k->x > EDGE) {
        k->x = EDGE;
        k->y += LINE;
    }
    if (colour) {
        image_set_colour(k->page, *colour);
        cairo_rectangle(k->page, k->x, k->y - 10, 11, 11);
        cairo_fill(k->page);
    }
    image_set_colour(k->page, ink);
    image_text(k->page, k->x + sign, k->y, 12, ALIGN_LEFT, false, name);
    k->x += wide + 14;
}

static int lines_under(int width) { return width >= WIDE ? 1 : width >= MIDDLE ? 2 : 4; }

static bool has_several_vessels(const replay *r, const replay_moment *m)
{
    int32_t count = 0;
    for (int32_t i = 0; i < m->poses.count; i++)
        count += r->bodies.data[m->poses.data[i].body].material == MATERIAL_HULL;
    return count > 1;
}

/* Scale bar, colours and keys, from the line at y on. */
static void draw_under(cairo_t *page, const video_scene *s, const solid_view *v, const solid_camera *c, bool vessels,
                       const bool used[FORCE_KINDS], bool marked, int width, double y)
{
    int lines = lines_under(width), above_keys = lines / 2;
    double end = draw_scale_bar(page, v, c, s->arrow, EDGE, y);
    if (plan_colour_title(s->colour))
        plan_view_colour_scale(page, plan_colour_title(s->colour), s->lo, s->hi, lines > 2 ? EDGE : end, width - EDGE,
                               lines > 2 ? y + LINE : y);
    key_line keys = {page, lines == 1 ? end : EDGE, y + above_keys * LINE, width - EDGE};
    if (used[RECORD_FORCE_ICE] || used[RECORD_FORCE_LINE] || used[RECORD_FORCE_THRUSTER] || used[RECORD_FORCE_HULL])
        draw_key(&keys, NULL, vessels ? "forces on the vessels:" : "forces on the vessel:");
    for (int k = 0; k < FORCE_KINDS; k++)
        if (used[k])
            draw_key(&keys, &forces[k].colour, forces[k].name);
    if (marked)
        draw_key(&keys, &mark, "ice broke");
}

fram_status video_scene_draw(context *ctx, const video_scene *s, const replay *r, const replay_moment *m, cairo_t *page,
                             int width, int height, fram_error *error)
{
    solid_view v;
    int h = height - ABOVE - BELOW - (lines_under(width) - 1) * LINE;
    solid_camera camera = camera_of(s, r, m, (double)h / width);
    fram_status status = solid_view_begin(ctx, &camera, width, h, sky, &v, error);
    if (status != FRAM_OK)
        return status;
    status = draw_bodies(ctx, s, r, m, &v, error);
    cairo_surface_t *surface = cairo_get_target(page);
    cairo_surface_flush(surface);
    int stride = cairo_image_surface_get_stride(surface);
    solid_view_copy(&v, cairo_image_surface_get_data(surface) + (ptrdiff_t)ABOVE * stride, stride);
    cairo_surface_mark_dirty(surface);

    bool used[FORCE_KINDS] = {false};
    cairo_save(page);
    cairo_rectangle(page, 0, ABOVE, width, h);
    cairo_clip(page);
    cairo_translate(page, 0, ABOVE);
    draw_forces(page, s, r, &v, true, used);
    draw_forces(page, s, r, &v, false, used);
    bool marked = draw_marks(page, s, r, m, &v);
    cairo_restore(page);
    image_set_colour(page, ink);
    image_text_fitted(page, EDGE, 25, 17, true, width - AXES - 40 - EDGE, s->title);
    image_text(page, EDGE, 47, 12.5, ALIGN_LEFT, false, s->caption);
    draw_axes(page, &v, &camera, width - AXES, 34);
    draw_under(page, s, &v, &camera, has_several_vessels(r, m), used, marked, width, ABOVE + h + 24);
    solid_view_free(&v);
    return status;
}

#endif
