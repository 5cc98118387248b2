#include "results/video.h"

#include "base/load_unit.h"
#include "base/number_text.h"
#include "io/csv_read.h"
#include "io/folder.h"
#include "io/image.h"
#include "io/path.h"
#include "io/plan_flows.h"
#include "io/scenario_file.h"
#include "io/video_file.h"
#include "model/scenario_vessel.h"
#include "results/thinned.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef FRAM_HAVE_CAIRO

enum { CURVE_HEIGHT = 120, CURVE_TOP = 18, FRAMES_MOST = 100000, LONGEST_VIDEO = 30, MARKED = 3 };

typedef struct video {
    context *ctx;
    const video_options *options;
    scenario s;
    double_array time, load; /* of the frames of the record [s], [N] */
    double lo, hi;           /* of the colours */
    double arrow;            /* of the whole video [m/N]; 0: none */
    double most;             /* load [N] */
    double step;             /* between pictures [s] */
    int64_t count;           /* of pictures */
    box2 extent;             /* of the places of the first frame's bodies but walls; without ice of the domain [m] */
    box2 whole;              /* of all its bodies [m] */
    double top;              /* of those, over still water [m] */
    double near;             /* what `follow` sees across [m] */
    replay r;
    replay_moment moment;
    replay_plan plan;
    char path[PATH_ROOM];
} video;

static double widest(box2 box) { return fmax(box.hi.x - box.lo.x, box.hi.y - box.lo.y); }

static void find_extent(video *v)
{
    bool ice = false;
    vec2 lo = {HUGE_VAL, HUGE_VAL}, hi = {-HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < v->r.frame.poses.count; i++) {
        const replay_pose *p = &v->r.frame.poses.data[i];
        int kind = v->r.bodies.data[p->body].material;
        if (kind == MATERIAL_WALL)
            continue;
        ice = ice || kind == MATERIAL_ICE;
        lo = vec2_make(fmin(lo.x, p->position.x), fmin(lo.y, p->position.y));
        hi = vec2_make(fmax(hi.x, p->position.x), fmax(hi.y, p->position.y));
    }
    /* Vessels without ice sail wherever the domain has water. */
    v->extent = ice && lo.x < hi.x ? (box2){lo, hi} : domain_box(&v->s.domain);
    /* Beside one it is the ice that counts, not where others sail.  A ship is seen whole, however small the field is
       beside it. */
    v->near = fmax(ice ? widest((box2){lo, hi}) : 0, 3.5 * replay_hull_size(&v->r, 0).x);
    if (!(v->near > 0))
        v->near = widest(v->extent);
}

static void find_whole(video *v)
{
    const replay *r = &v->r;
    v->whole = v->extent;
    v->top = 0;
    for (int32_t i = 0; i < r->frame.poses.count; i++) {
        const replay_pose *p = &r->frame.poses.data[i];
        const replay_body *b = &r->bodies.data[p->body];
        mat3 turn = quat_matrix(p->orientation);
        for (int32_t k = b->vertex_first; k < b->vertex_first + b->vertex_count; k++) {
            vec3 local = b->solid ? r->points.data[k]
                                  : vec3_make(r->outlines.data[k].x, r->outlines.data[k].y, b->thickness / 2);
            vec3 g = vec3_add(p->position, mat3_mul_vec(turn, local));
            v->whole.lo = vec2_make(fmin(v->whole.lo.x, g.x), fmin(v->whole.lo.y, g.y));
            v->whole.hi = vec2_make(fmax(v->whole.hi.x, g.x), fmax(v->whole.hi.y, g.y));
            v->top = fmax(v->top, g.z);
        }
    }
}

/* Of an arrow of the strongest forces but a few, over the width of what is seen. */
#define ARROW_LENGTH 0.12

/* [m] */
static double seen_across(const video *v)
{
    if (v->options->camera == VIDEO_FOLLOW)
        return v->near;
    if (v->options->camera == VIDEO_ORBIT)
        return widest(v->extent);
    return v->options->span > 0 ? v->options->span : v->s.domain.x_max - v->s.domain.x_min;
}

/* Times, loads, the range of what is shown (its 98th percentile) and the scale of the arrows, from a first reading. */
static fram_status look_ahead(video *v, const char *folder, fram_error *error)
{
    thinned values = {0}, forces = {0};
    bool found = true;
    fram_status status = replay_open(v->ctx, folder, &v->r, error);
    if (status != FRAM_OK)
        return status;
    while (status == FRAM_OK) {
        status = replay_next(&v->r, &found, error);
        if (status != FRAM_OK || !found)
            break;
        const replay_frame *f = &v->r.frame;
        if (v->time.count == 0) {
            find_extent(v);
            find_whole(v);
        }
        double load = sqrt(f->ice_force.x * f->ice_force.x + f->ice_force.y * f->ice_force.y);
        bool good = array_push(v->ctx, &v->time, f->time) && array_push(v->ctx, &v->load, load);
        v->most = fmax(v->most, load);
        for (int32_t i = 0; i < f->forces.count && good; i++)
            good = thinned_add(v->ctx, &forces, vec3_length(f->forces.data[i].force));
        for (int32_t i = 0; i < f->poses.count && good; i++) {
            const replay_pose *p = &f->poses.data[i];
            double value = plan_colour_value(v->options->colour, &v->r.bodies.data[p->body], p, f->time);
            good = !(value > 0) || thinned_add(v->ctx, &values, value);
        }
        if (!good)
            status = error_memory(error);
    }
    v->hi = thinned_percentile(&values, 98);
    if (!(v->hi > 0))
        v->hi = 1;
    /* As on the playback page, a few arrows may be longer: one hard blow must not make all others vanish. */
    double strong = thinned_percentile(&forces, 99);
    v->arrow = strong > 0 ? ARROW_LENGTH * seen_across(v) / strong : 0;
    array_free(v->ctx, &values.value);
    array_free(v->ctx, &forces.value);
    replay_close(&v->r);
    return status;
}

/* ---- one picture ---- */

static void curve_caption(const video *v, char *text, size_t room)
{
    if (scenario_vessel_count(&v->s) == 0) {
        snprintf(text, room, "no vessel");
        return;
    }
    vessel_entry first = scenario_vessel_entry(&v->s, 0);
    snprintf(text, room, "horizontal ice load on %s, averaged, at the frames; largest of them %s",
             vessel_title_of(&first).text, load_text_of(v->most, 4).text);
}

static void draw_curve(const video *v, cairo_t *page, double now)
{
    double left = 14, right = v->options->width - 14, top = v->options->height - CURVE_HEIGHT + CURVE_TOP;
    double bottom = v->options->height - 10, begin = v->time.data[0], end = v->time.data[v->time.count - 1];
    double span = end > begin ? end - begin : 1, most = v->most > 0 ? v->most : 1;
    char text[192];
    cairo_move_to(page, left, bottom);
    for (int32_t i = 0; i < v->time.count; i++)
        cairo_line_to(page, left + (v->time.data[i] - begin) / span * (right - left),
                      bottom - v->load.data[i] / most * (bottom - top));
    cairo_line_to(page, right, bottom);
    cairo_close_path(page);
    cairo_set_source_rgb(page, 0.79, 0.85, 0.90);
    cairo_fill(page);
    double x = left + (now - begin) / span * (right - left);
    cairo_set_source_rgb(page, 0.69, 0.19, 0.13);
    cairo_rectangle(page, x - 1, top - 4, 2, bottom - top + 4);
    cairo_fill(page);
    image_set_colour(page, (image_colour){0.1, 0.1, 0.1});
    curve_caption(v, text, sizeof text);
    image_text_fitted(page, left, top - 5, 12, false, right - left, text);
}

static box2 shown_window(const video *v, int width, int height)
{
    if (!(v->options->span > 0) || !v->plan.has_vessel)
        return plan_window(domain_with_walls(&v->s.domain), v->plan.shapes.data, v->plan.shapes.count);
    double half = v->options->span / 2, upright = half * height / width;
    vec2 c = v->plan.vessel;
    return (box2){{c.x - half, c.y - upright}, {c.x + half, c.y + upright}};
}

static fram_status draw_space(const video *v, double time, const char *caption, cairo_t **page, fram_error *error)
{
    int width = v->options->width, height = v->options->height;
    const video_scene scene = {.camera = v->options->camera,
                               .extent = v->extent,
                               .whole = v->whole,
                               .top = v->top,
                               .near = v->near,
                               .colour = v->options->colour,
                               .lo = v->lo,
                               .hi = v->hi,
                               .arrow = v->arrow,
                               .mark_time = MARKED,
                               .title = v->s.title[0] ? v->s.title : "Fram",
                               .caption = caption};
    fram_status status = image_begin(width, height, page, error);
    if (status != FRAM_OK)
        return status;
    status = video_scene_draw(v->ctx, &scene, &v->r, &v->moment, *page, width, height - CURVE_HEIGHT, error);
    if (status == FRAM_OK)
        draw_curve(v, *page, time);
    else
        cairo_destroy(*page);
    return status;
}

static fram_status draw_picture(video *v, double time, cairo_t **page, fram_error *error)
{
    int width = v->options->width, height = v->options->height - CURVE_HEIGHT;
    char caption[128];
    fram_status status = replay_moment_at(&v->r, time, &v->moment, error);
    int digits = clock_digits(v->step);
    snprintf(caption, sizeof caption, "t = %.*f s of %.*f s", digits, time, digits, v->time.data[v->time.count - 1]);
    if (v->options->camera != VIDEO_PLAN)
        return status == FRAM_OK ? draw_space(v, time, caption, page, error) : status;
    if (status == FRAM_OK)
        status =
            replay_plan_make(&v->r, &v->moment, v->options->colour, v->lo, v->hi, v->arrow, MARKED, &v->plan, error);
    if (status == FRAM_OK)
        status = replay_plan_lines(&v->r, &v->s, &v->plan, error);
    if (status == FRAM_OK)
        status = image_begin(width, v->options->height, page, error);
    if (status != FRAM_OK)
        return status;
    plan_flows flows = plan_flows_at(v->ctx, &v->s, time);
    plan_view view = {.window = shown_window(v, width - 28, height - 108),
                      .title = v->s.title[0] ? v->s.title : "Fram",
                      .caption = caption,
                      .shapes = v->plan.shapes.data,
                      .shape_count = v->plan.shapes.count,
                      .marks = v->plan.marks.data,
                      .mark_count = v->plan.marks.count,
                      .arrows = v->plan.arrows.data,
                      .arrow_count = v->plan.arrows.count,
                      .arrow_scale = v->arrow,
                      .lines = v->plan.lines.data,
                      .line_count = v->plan.lines.count,
                      .flows = flows.flow,
                      .flow_count = flows.count,
                      .scale_name = plan_colour_title(v->options->colour),
                      .scale_lo = v->lo,
                      .scale_hi = v->hi};
    plan_view_draw(*page, &view, width, height);
    draw_curve(v, *page, time);
    return FRAM_OK;
}

/* ---- all pictures ---- */

static fram_status name_picture(const video *v, int64_t number, char path[PATH_ROOM], fram_error *error)
{
    char name[32];
    snprintf(name, sizeof name, "frame-%06lld.png", (long long)number);
    return path_join(v->path, name, path, error);
}

static fram_status keep_picture(video *v, video_file *file, cairo_t *page, int64_t number, fram_error *error)
{
    if (v->options->pictures) {
        char path[PATH_ROOM];
        fram_status status = name_picture(v, number, path, error);
        if (status == FRAM_OK)
            return image_write(v->ctx, page, path, error);
        cairo_destroy(page);
        return status;
    }
    cairo_surface_t *surface = cairo_get_target(page);
    cairo_surface_flush(surface);
    /* Rows of an RGB24 image lie without gaps when the width is that of the stride. */
    size_t size = (size_t)cairo_image_surface_get_stride(surface) * (size_t)v->options->height;
    fram_status status = video_frame(file, cairo_image_surface_get_data(surface), size, error);
    cairo_destroy(page);
    return status;
}

static fram_status find_frames(video *v, fram_error *error)
{
    double span = v->time.data[v->time.count - 1] - v->time.data[0], speed = v->options->speed;
    if (!(speed > 0))
        speed = fmax(1, span / LONGEST_VIDEO);
    v->step = speed / v->options->frames_per_second;
    double frames = floor(span / v->step + 1e-9) + 1;
    if (!(frames <= FRAMES_MOST))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "speed",
                         "expected at least %.2g, or fewer frames a second, for %d frames at most, found %g",
                         span * v->options->frames_per_second / (FRAMES_MOST - 1), (int)FRAMES_MOST, speed);
    v->count = (int64_t)frames;
    return FRAM_OK;
}

static fram_status write_pictures(video *v, const char *folder, video_file *file, int64_t *frames, fram_error *error)
{
    double begin = v->time.data[0], end = v->time.data[v->time.count - 1];
    /* Pictures are counted, not also what is read for them. */
    context silent = *v->ctx;
    silent.work = NULL;
    fram_status status = replay_open(&silent, folder, &v->r, error);
    for (int64_t i = 0; i < v->count && status == FRAM_OK; i++) {
        cairo_t *page = NULL;
        status = work_continue(v->ctx, "drawing frames", (double)i, (double)v->count, error);
        if (status != FRAM_OK)
            break;
        status = draw_picture(v, fmin(begin + (double)i * v->step, end), &page, error);
        if (status == FRAM_OK)
            status = keep_picture(v, file, page, i, error);
        *frames = i + 1;
    }
    replay_close(&v->r);
    return status;
}

static fram_status make_video(video *v, const char *folder, int64_t *frames, fram_error *error)
{
    video_file file;
    fram_status status = video_begin(v->ctx, v->path, v->options->width, v->options->height,
                                     v->options->frames_per_second, &file, error);
    if (status != FRAM_OK)
        return status;
    status = write_pictures(v, folder, &file, frames, error);
    if (status == FRAM_OK)
        return video_end(&file, error);
    video_abandon(&file);
    return status;
}

/* A program that makes a film of the folder would take what a longer series left for the end of this one. */
static fram_status remove_later_pictures(const video *v, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = FRAM_OK;
    for (int64_t i = v->count; i < FRAMES_MOST && status == FRAM_OK; i++) {
        status = name_picture(v, i, path, error);
        if (status == FRAM_OK && unlink(path) != 0)
            break;
    }
    return status;
}

static fram_status make_pictures(video *v, const char *folder, int64_t *frames, fram_error *error)
{
    bool empty = true;
    fram_status status = folder_is_empty(v->path, &empty, error);
    if (status == FRAM_OK && !empty && !v->options->force)
        status = folder_refuse(v->path, error);
    if (status == FRAM_OK && mkdir(v->path, 0777) != 0 && errno != EEXIST)
        status = file_place_error(error, v->path, "make the folder", errno);
    if (status == FRAM_OK && !empty)
        status = remove_later_pictures(v, error);
    if (status == FRAM_OK)
        status = write_pictures(v, folder, NULL, frames, error);
    if (status == FRAM_INTERRUPTED)
        status = error_set(error, FRAM_INTERRUPTED, v->path, 0, NULL, "interrupted; %lld of %lld pictures are there",
                           (long long)*frames, (long long)v->count);
    return status;
}

fram_status video_write(context *ctx, const char *folder, const video_options *options, int64_t *frames, char *path,
                        fram_error *error)
{
    video v = {.ctx = ctx, .options = options};
    char scene[PATH_ROOM];
    *frames = 0;
    fram_status status = path_given_or(options->output, folder, options->pictures ? "video" : "run.mp4", v.path, error);
    if (status == FRAM_OK)
        status = path_join(folder, "scenario.yaml", scene, error);
    if (status == FRAM_OK)
        status = scenario_read_alone(ctx, scene, NULL, &v.s, error);
    if (status != FRAM_OK)
        return status;
    status = look_ahead(&v, folder, error);
    if (status == FRAM_OK)
        status = find_frames(&v, error);
    if (status == FRAM_OK)
        status = (options->pictures ? make_pictures : make_video)(&v, folder, frames, error);
    memcpy(path, v.path, sizeof v.path);
    replay_moment_free(ctx, &v.moment);
    replay_plan_free(ctx, &v.plan);
    array_free(ctx, &v.time);
    array_free(ctx, &v.load);
    scenario_free(ctx, &v.s);
    return status;
}

#else

fram_status video_write(context *ctx, const char *folder, const video_options *options, int64_t *frames, char *path,
                        fram_error *error)
{
    (void)ctx, (void)options, (void)frames, (void)path;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, folder, 0, NULL, "this build has no cairo, so it draws no videos");
}

#endif
