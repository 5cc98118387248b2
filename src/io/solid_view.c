#include "io/solid_view.h"

#include <string.h>

/* Nearer than this part of the distance of what is looked at nothing is drawn, of whatever size the scene is. */
static const double nearest = 1e-3;
/* Light from behind the left shoulder of who looks along Y; the rest comes from everywhere. */
static const vec3 light = {-0.2624, -0.4592, 0.8487};
static const double ambient = 0.58;

/* Across and down [fine pixels], and nearness [1/m]: all three are linear over a triangle's picture. */
typedef struct spot {
    double x, y, w;
} spot;

fram_status solid_view_begin(context *ctx, const solid_camera *camera, int width, int height, const double sky[3],
                             solid_view *v, fram_error *error)
{
    *v = (solid_view){.ctx = ctx, .width = SOLID_FINE * width, .height = SOLID_FINE * height, .eye = camera->eye};
    v->ahead = vec3_unit(vec3_sub(camera->target, camera->eye));
    v->right = vec3_unit(vec3_cross(v->ahead, vec3_make(0, 0, 1)));
    v->up = vec3_cross(v->right, v->ahead);
    v->focal = camera->zoom * v->height;
    v->nearest = nearest * vec3_length(vec3_sub(camera->target, camera->eye));
    size_t count = (size_t)v->width * (size_t)v->height;
    v->nearness = memory_array(ctx, count, sizeof *v->nearness);
    v->pixel = memory_array(ctx, count, 3);
    if (!v->nearness || !v->pixel) {
        solid_view_free(v);
        return error_memory(error);
    }
    for (size_t i = 0; i < 3 * count; i++)
        v->pixel[i] = (unsigned char)(255 * sky[i % 3]);
    return FRAM_OK;
}

void solid_view_free(solid_view *v)
{
    memory_free(v->ctx, v->nearness);
    memory_free(v->ctx, v->pixel);
    v->nearness = NULL;
    v->pixel = NULL;
}

static vec3 to_eye(const solid_view *v, vec3 p)
{
    vec3 d = vec3_sub(p, v->eye);
    return vec3_make(vec3_dot(d, v->right), vec3_dot(d, v->up), vec3_dot(d, v->ahead));
}

static spot spot_of(const solid_view *v, vec3 e)
{
    double w = 1 / e.z;
    return (spot){0.5 * v->width + v->focal * e.x * w, 0.5 * v->height - v->focal * e.y * w, w};
}

static void put_pixel(solid_view *v, int x, int y, float nearness, const unsigned char rgb[3])
{
    size_t at = (size_t)y * (size_t)v->width + (size_t)x;
    if (nearness <= v->nearness[at])
        return;
    v->nearness[at] = nearness;
    memcpy(v->pixel + 3 * at, rgb, 3);
}

static int clamped(double x, int most) { return x < 0 ? 0 : x > most ? most : (int)x; }

/* Pixels whose middle lies inside. */
static void fill(solid_view *v, const spot p[3], const unsigned char rgb[3])
{
    double twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (!(fabs(twice) > 1e-9))
        return;
    double lo_y = fmin(p[0].y, fmin(p[1].y, p[2].y)), hi_y = fmax(p[0].y, fmax(p[1].y, p[2].y));
    double wx = ((p[1].w - p[0].w) * (p[2].y - p[0].y) - (p[2].w - p[0].w) * (p[1].y - p[0].y)) / twice;
    double wy = ((p[2].w - p[0].w) * (p[1].x - p[0].x) - (p[1].w - p[0].w) * (p[2].x - p[0].x)) / twice;
    for (int y = clamped(ceil(lo_y - 0.5), v->height), end = clamped(floor(hi_y - 0.5) + 1, v->height); y < end; y++) {
        double lo = INFINITY, hi = -INFINITY, middle = y + 0.5;
        for (int i = 0; i < 3; i++) { /* where the row enters and leaves */
            const spot *a = &p[i], *b = &p[(i + 1) % 3];
            if ((a->y <= middle) == (b->y <= middle))
                continue;
            double x = a->x + (middle - a->y) / (b->y - a->y) * (b->x - a->x);
            lo = fmin(lo, x);
            hi = fmax(hi, x);
        }
        if (!(hi >= lo))
            continue;
        for (int x = clamped(ceil(lo - 0.5), v->width), last = clamped(floor(hi - 0.5) + 1, v->width); x < last; x++)
            put_pixel(v, x, y, (float)(p[0].w + (x + 0.5 - p[0].x) * wx + (middle - p[0].y) * wy), rgb);
    }
}

/* What of a triangle lies beyond z, in up to four corners; their number. */
static int clip(double z, const vec3 in[3], vec3 out[4])
{
    int count = 0;
    for (int i = 0; i < 3; i++) {
        vec3 a = in[i], b = in[(i + 1) % 3];
        bool a_in = a.z >= z, b_in = b.z >= z;
        if (a_in)
            out[count++] = a;
        if (a_in != b_in)
            out[count++] = vec3_mad(a, vec3_sub(b, a), (z - a.z) / (b.z - a.z));
    }
    return count;
}

static void shade(const double rgb[3], double part, unsigned char out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (unsigned char)(255 * fmin(1, rgb[i] * part));
}

void solid_view_triangle(solid_view *v, vec3 a, vec3 b, vec3 c, const double rgb[3])
{
    vec3 normal = vec3_unit(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
    if (!(vec3_dot(normal, vec3_sub(v->eye, a)) > 0))
        return;
    unsigned char colour[3];
    shade(rgb, ambient + (1 - ambient) * fmax(0, vec3_dot(normal, light)) * 1.15, colour);
    vec3 corner[3] = {to_eye(v, a), to_eye(v, b), to_eye(v, c)}, kept[4];
    int count = clip(v->nearest, corner, kept);
    for (int i = 2; i < count; i++) {
        spot p[3] = {spot_of(v, kept[0]), spot_of(v, kept[i - 1]), spot_of(v, kept[i])};
        fill(v, p, colour);
    }
}

void solid_view_line(solid_view *v, vec3 a, vec3 b, const double rgb[3])
{
    vec3 p = to_eye(v, a), q = to_eye(v, b);
    if (p.z < v->nearest || q.z < v->nearest)
        return;
    spot s = spot_of(v, p), t = spot_of(v, q);
    double length = fmax(fabs(t.x - s.x), fabs(t.y - s.y));
    if (!(length < 4.0 * v->width))
        return;
    unsigned char colour[3];
    shade(rgb, 1, colour);
    int steps = (int)length + 1;
    for (int i = 0; i <= steps; i++) {
        double part = (double)i / steps, x = s.x + part * (t.x - s.x), y = s.y + part * (t.y - s.y);
        if (x >= 0 && x < v->width && y >= 0 && y < v->height)
            put_pixel(v, (int)x, (int)y, (float)((s.w + part * (t.w - s.w)) * 1.0004), colour);
    }
}

void solid_view_water(solid_view *v, const double rgb[3], double cover)
{
    for (int y = 0; y < v->height; y++) {
        for (int x = 0; x < v->width; x++) {
            size_t at = (size_t)y * (size_t)v->width + (size_t)x;
            double across = (x + 0.5 - 0.5 * v->width) / v->focal, upwards = (0.5 * v->height - y - 0.5) / v->focal;
            /* The ray eye + depth (ahead + across right + upwards up) meets z = 0 at this nearness. */
            double w = -(v->ahead.z + across * v->right.z + upwards * v->up.z) / v->eye.z;
            if (!(w > (double)v->nearness[at]))
                continue;
            for (int i = 0; i < 3; i++)
                v->pixel[3 * at + (size_t)i] =
                    (unsigned char)(255 * cover * rgb[i] + (1 - cover) * v->pixel[3 * at + (size_t)i]);
        }
    }
}

bool solid_view_place(const solid_view *v, vec3 p, double *x, double *y)
{
    vec3 e = to_eye(v, p);
    if (e.z < v->nearest)
        return false;
    spot s = spot_of(v, e);
    *x = s.x / SOLID_FINE;
    *y = s.y / SOLID_FINE;
    return true;
}

void solid_view_copy(const solid_view *v, unsigned char *to, int stride)
{
    for (int y = 0; y < v->height / SOLID_FINE; y++) {
        for (int x = 0; x < v->width / SOLID_FINE; x++) {
            for (int i = 0; i < 3; i++) {
                int sum = 0;
                for (int k = 0; k < SOLID_FINE * SOLID_FINE; k++) {
                    int row = SOLID_FINE * y + k / SOLID_FINE, column = SOLID_FINE * x + k % SOLID_FINE;
                    sum += v->pixel[3 * ((size_t)row * (size_t)v->width + (size_t)column) + (size_t)i];
                }
                to[(size_t)y * (size_t)stride + 4 * (size_t)x + 2 - (size_t)i] =
                    (unsigned char)(sum / (SOLID_FINE * SOLID_FINE));
            }
        }
    }
}
