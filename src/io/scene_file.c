#include "io/scene_file.h"

#include "base/number_text.h"
#include "io/file.h"
#include "model/scenario_schema.h"

#include <stddef.h>
#include <string.h>

/* No length, speed or density of a scene is larger: products of a few of them stay finite. */
#define LARGEST_VALUE 1e9
/* A centre may lie this share of the floe's size beside the centroid: files carry rounded numbers. */
#define CENTRE_SLACK 0.01

/* The line that is being read. */
typedef struct scene_reader {
    context *ctx;
    const char *name;
    int line;
    char *rest; /* what stands after the last word */
    scene_text *scene;
    unsigned seen;  /* bit i: statement i of the table was met */
    double densest; /* of its floes [kg/m3] */
    int densest_line;
    fram_error *error;
} scene_reader;

static fram_status refuse_line(scene_reader *r, const char *key, const char *message)
{
    return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, key, "%s", message);
}

/* ---- words and numbers ---- */

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/* The next word of the line, cut out; NULL at its end. */
static char *next_word(scene_reader *r)
{
    char *word = r->rest;
    while (is_blank(*word))
        word++;
    if (*word == '\0')
        return NULL;
    char *end = word;
    while (*end != '\0' && !is_blank(*end))
        end++;
    r->rest = *end ? end + 1 : end;
    *end = '\0';
    return word;
}

/* One number of lo <= value <= hi. */
static fram_status read_number(scene_reader *r, const char *key, double lo, double hi, double *value)
{
    const char *word = next_word(r);
    if (!word)
        return refuse_line(r, key, "the line ends where a number is expected");
    if (real_from_text(word, value) != NUMBER_GOOD)
        return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, key, "expected a number, found '%.40s'", word);
    if (*value < lo || *value > hi)
        return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, key, "expected %g to %g, found %g", lo, hi,
                         *value);
    return FRAM_OK;
}

static fram_status read_numbers(scene_reader *r, const char *key, double lo, double hi, double *values, int count)
{
    fram_status status = FRAM_OK;
    for (int i = 0; i < count && status == FRAM_OK; i++)
        status = read_number(r, key, lo, hi, &values[i]);
    return status;
}

/* ---- statements ---- */

static fram_status read_version(scene_reader *r, const char *key)
{
    double version = 0;
    fram_status status = read_number(r, key, -LARGEST_VALUE, LARGEST_VALUE, &version);
    if (status == FRAM_OK && version != 1)
        return refuse_line(r, key, "this program reads version 1 of the format");
    return status;
}

static fram_status read_gravity(scene_reader *r, const char *key)
{
    return read_number(r, key, 0, LARGEST_VALUE, &r->scene->gravity);
}

static fram_status read_water_density(scene_reader *r, const char *key)
{
    return read_number(r, key, 1e-3, LARGEST_VALUE, &r->scene->water_density);
}

static fram_status read_current(scene_reader *r, const char *key)
{
    double v[2] = {0};
    fram_status status = read_numbers(r, key, -LARGEST_VALUE, LARGEST_VALUE, v, 2);
    if (status == FRAM_OK)
        r->scene->current = vec2_make(v[0], v[1]);
    return status;
}

static fram_status read_drag(scene_reader *r, const char *key)
{
    fram_status status = read_number(r, key, 0, LARGEST_VALUE, &r->scene->form_drag);
    return status == FRAM_OK ? read_number(r, key, 0, LARGEST_VALUE, &r->scene->skin_drag) : status;
}

static fram_status read_friction(scene_reader *r, const char *key)
{
    return read_number(r, key, 0, LARGEST_VALUE, &r->scene->friction);
}

static fram_status read_restitution(scene_reader *r, const char *key)
{
    double restitution = 0;
    fram_status status = read_number(r, key, 0, 1, &restitution);
    if (status == FRAM_OK && restitution != 0)
        return refuse_line(r, key, "ice does not rebound here: only 0 is simulated");
    return status;
}

static fram_status read_domain(scene_reader *r, const char *key)
{
    double v[4];
    fram_status status = read_numbers(r, key, -LARGEST_VALUE, LARGEST_VALUE, v, 4);
    if (status == FRAM_OK && !(v[0] < v[2] && v[1] < v[3]))
        return refuse_line(r, key, "expected xmin ymin xmax ymax with xmin < xmax and ymin < ymax");
    if (status == FRAM_OK)
        r->scene->domain = (box2){{v[0], v[1]}, {v[2], v[3]}};
    return status;
}

static fram_status read_ship(scene_reader *r, const char *key)
{
    double size[4], v[4];
    fram_status status = read_numbers(r, key, 1e-3, LARGEST_VALUE, size, 4);
    if (status == FRAM_OK)
        status = read_numbers(r, key, -LARGEST_VALUE, LARGEST_VALUE, v, 4);
    if (status != FRAM_OK)
        return status;
    scene_text *s = r->scene;
    s->ship = true;
    s->ship_length = size[0];
    s->ship_beam = size[1];
    s->ship_depth = size[2];
    s->ship_draught = size[3];
    s->ship_centre = vec2_make(v[0], v[1]);
    s->ship_velocity = vec2_make(v[2], v[3]);
    return FRAM_OK;
}

static fram_status check_outline(scene_reader *r, const char *key, polygon outline)
{
    polygon_moments m = polygon_moments_of(outline);
    if (!(m.area > 0) || !polygon_is_convex(outline))
        return refuse_line(r, key, "expected the vertices of a convex outline, counter-clockwise");
    if (vec2_length(m.centroid) > CENTRE_SLACK * sqrt(m.area))
        return refuse_line(r, key, "expected vertices relative to the floe's centroid");
    return FRAM_OK;
}

static fram_status read_floe(scene_reader *r, const char *key)
{
    scene_text *s = r->scene;
    if (s->floes.count == SCENE_MOST_FLOES)
        return refuse_line(r, key, "too many floes");
    double v[5] = {0};
    fram_status status = read_numbers(r, key, 1e-6, LARGEST_VALUE, v, 2);
    if (status == FRAM_OK)
        status = read_numbers(r, key, -LARGEST_VALUE, LARGEST_VALUE, v + 2, 2);
    if (status == FRAM_OK)
        status = read_number(r, key, 3, SCENE_MOST_SIDES, &v[4]);
    if (status == FRAM_OK && v[4] != floor(v[4]))
        status = refuse_line(r, key, "the number of vertices is no integer");
    if (status != FRAM_OK)
        return status;
    scene_floe floe = {v[0], v[1], vec2_make(v[2], v[3]), s->vertices.count, (int32_t)v[4]};
    for (int32_t i = 0; i < floe.count; i++) {
        double p[2] = {0};
        status = read_numbers(r, key, -LARGEST_VALUE, LARGEST_VALUE, p, 2);
        if (status != FRAM_OK)
            return status;
        if (!array_push(r->ctx, &s->vertices, vec2_make(p[0], p[1])))
            return error_memory(r->error);
    }
    status = check_outline(r, key, (polygon){s->vertices.data + floe.first, floe.count});
    if (status == FRAM_OK && floe.density > r->densest) {
        r->densest = floe.density;
        r->densest_line = r->line;
    }
    if (status == FRAM_OK && !array_push(r->ctx, &s->floes, floe))
        return error_memory(r->error);
    return status;
}

typedef struct statement {
    const char *word;
    fram_status (*read)(scene_reader *r, const char *key);
    bool repeats;
} statement;

enum { STATEMENT_VERSION = 0, STATEMENT_DOMAIN = 7 };
static const statement statements[] = {
    {"icescene", read_version, false},
    {"gravity", read_gravity, false},
    {"water_density", read_water_density, false},
    {"current", read_current, false},
    {"drag", read_drag, false},
    {"friction", read_friction, false},
    {"restitution", read_restitution, false},
    {"domain", read_domain, false},
    {"ship", read_ship, false},
    {"floe", read_floe, true},
};
enum { STATEMENT_COUNT = sizeof statements / sizeof *statements };

static fram_status read_statement(scene_reader *r)
{
    const char *word = next_word(r);
    if (!word || word[0] == '#')
        return FRAM_OK;
    int at = 0;
    while (at < STATEMENT_COUNT && strcmp(word, statements[at].word) != 0)
        at++;
    if (!(r->seen & 1u << STATEMENT_VERSION) && at != STATEMENT_VERSION)
        return refuse_line(r, NULL, "a scene begins with the line 'icescene 1'");
    if (at == STATEMENT_COUNT)
        return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, NULL, "unknown statement '%.40s'", word);
    const statement *s = &statements[at];
    if (!s->repeats && (r->seen & 1u << at))
        return refuse_line(r, s->word, "this statement was given before");
    r->seen |= 1u << at;
    fram_status status = s->read(r, s->word);
    if (status == FRAM_OK && next_word(r))
        return refuse_line(r, s->word, "the line has more values than the statement takes");
    return status;
}

/* ---- the whole ---- */

static fram_status read_statements(scene_reader *r, char *text, size_t size)
{
    for (char *line = text; line < text + size;) {
        char *end = memchr(line, '\n', (size_t)(text + size - line));
        if (!end)
            end = text + size;
        *end = '\0';
        r->line++;
        if (memchr(line, '\0', (size_t)(end - line)))
            return refuse_line(r, NULL, "expected text, found a NUL byte");
        r->rest = line;
        fram_status status = read_statement(r);
        if (status != FRAM_OK)
            return status;
        line = end + 1;
    }
    if (!(r->seen & 1u << STATEMENT_DOMAIN))
        return refuse_line(r, "domain", "the scene has no walls: a 'domain' statement is missing");
    if (r->scene->floes.count == 0)
        return refuse_line(r, "floe", "the scene has no floes");
    /* As of a scenario (model/scenario_check.c). */
    if (!(r->densest < r->scene->water_density))
        return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->densest_line, "floe",
                         "expected a density of less than that of the water, %g kg/m3, so that ice floats, found %g",
                         r->scene->water_density, r->densest);
    return FRAM_OK;
}

fram_status scene_text_parse(context *ctx, const char *name, char *text, size_t size, scene_text *out,
                             fram_error *error)
{
    *out = (scene_text){.gravity = scenario_key_find("environment", "gravity")->value,
                        .water_density = scenario_key_find("environment", "water_density")->value,
                        .form_drag = 1,
                        .skin_drag = 0.01,
                        .friction = 0.1};
    if (size > SCENE_MOST_BYTES)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL, "a scene has at most %d bytes", SCENE_MOST_BYTES);
    scene_reader r = {.ctx = ctx, .name = name, .scene = out, .error = error};
    fram_status status = read_statements(&r, text, size);
    if (status != FRAM_OK)
        scene_text_free(ctx, out);
    return status;
}

fram_status scene_file_read(context *ctx, const char *path, scene_text *out, fram_error *error)
{
    *out = (scene_text){0};
    char *text = NULL;
    size_t size = 0;
    fram_status status = file_read(ctx, path, SCENE_MOST_BYTES, &text, &size, error);
    if (status != FRAM_OK)
        return status;
    status = scene_text_parse(ctx, path, text, size, out, error);
    memory_free(ctx, text);
    return status;
}

void scene_text_free(context *ctx, scene_text *s)
{
    array_free(ctx, &s->floes);
    array_free(ctx, &s->vertices);
    *s = (scene_text){0};
}

polygon scene_floe_outline(const scene_text *s, int32_t floe)
{
    const scene_floe *f = &s->floes.data[floe];
    return (polygon){s->vertices.data + f->first, f->count};
}
