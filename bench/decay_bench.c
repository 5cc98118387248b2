/* Free decay of a box and of an FPSO in heave, roll and pitch, without and with added mass: measured periods beside
   those of the theory of small motions, as a table and as a picture.

       decay_bench PICTURE.png [HULL]        HULL: mesh of the FPSO (GDF, STL, OBJ); without it a form of its size */
#include "../tests/sim/decay.h"

#include "io/page.h"

#include <stdio.h>

#define SCENE                                                    \
    "run: {time_step: 0.02}\nice: {source: none}\n"              \
    "domain: {boundary: open}\n"                                 \
    "environment: {hull_drag: {water_form: %g, water_skin: %g, " \
    "air_form: 0, air_skin: 0}}\n"
#define BOX                                                           \
    "vessel: {mode: free, centre_of_gravity_z: 1, hull: {form: box, " \
    "length: 60, beam: 18, draught: 4, freeboard: 6}%s}\n"
#define FORM                                                  \
    "vessel: {mode: free, centre_of_gravity_z: 0, hull: "     \
    "{form: icebreaker, length: 200, beam: 44, draught: 12, " \
    "freeboard: 10, flare_angle_deg: 0, stem_angle_deg: 60, " \
    "entrance_angle_deg: 50, parallel_midbody: 0.7}%s}\n"
#define FROM_FILE "vessel: {mode: free, centre_of_gravity_z: 0, hull: {form: file, file: \"%s\", freeboard: 10}%%s}\n"

/* What the water is asked for: nothing but pressure; added mass; that with damping and drag. */
typedef struct water_case {
    const char *name, *keys;
    double form, skin;
} water_case;

static const water_case cases[] = {
    {"pressure alone", "", 0, 0},
    {"with added mass", ", hydrodynamics: {source: estimate, heave_damping: 0, roll_damping: 0, pitch_damping: 0}", 0,
     0},
    {"with damping and drag", ", hydrodynamics: {source: estimate}", 0.1, 0.003},
};
enum { CASES = sizeof cases / sizeof *cases };

static const struct {
    const char *name, *title;
    int mode;
    double amplitude;
} modes[] = {
    {"heave", "heave", DECAY_HEAVE, 0.02}, {"roll", "roll", DECAY_ROLL, 1e-3}, {"pitch", "pitch", DECAY_PITCH, 2e-4}};
enum { MODES = sizeof modes / sizeof *modes };

enum { PANEL_WIDTH = 720, PANEL_HEIGHT = 280, TOP = 40 };

/* What one panel shows. */
typedef struct picture {
    char title[40], subtitle[200];
    chart_line lines[CASES];
} picture;

/* One decay over `duration` seconds, in parts of its amplitude; false with a message. */
static bool run_case(const char *vessel, const water_case *c, int mode, double duration, chart_line *line,
                     double period[2])
{
    decay d;
    fram_error error = {0};
    char text[2000];
    *line = chart_line_make(c->name, NULL, NULL, 0, false);
    int size = snprintf(text, sizeof text, SCENE, c->form, c->skin);
    snprintf(text + size, sizeof text - (size_t)size, vessel, c->keys);
    if (decay_open(&d, text, &error) != FRAM_OK) {
        fprintf(stderr, "decay_bench: %s: %s\n", error.key, error.message);
        return false;
    }
    double dt = d.m.time_step, theory = d.period[modes[mode].mode];
    int steps = (int)(fmax(duration, 4.2 * theory) / dt);
    double *value = calloc((size_t)steps + 1, sizeof *value), *time = calloc((size_t)steps + 1, sizeof *time);
    bool ok = value && time;
    period[0] = theory;
    period[1] = ok ? decay_run(&d, modes[mode].mode, modes[mode].amplitude, steps, value, &error) : 0;
    for (int i = 0; ok && i <= steps; i++) {
        time[i] = i * dt;
        value[i] /= modes[mode].amplitude;
    }
    printf("| %-5s | %-22s | %8.4f | %8.4f | %8.2g |\n", modes[mode].name, c->name, theory, period[1],
           period[1] / theory - 1);
    *line = chart_line_make(c->name, time, value, (int32_t)(duration / dt), false);
    decay_close(&d);
    return ok && period[1] > 0;
}

static bool run_mode(const char *vessel, const char *name, int mode, picture *out)
{
    double duration = mode == 1 ? 60 : 40, period[CASES][2] = {{0}};
    bool ok = true;
    for (int i = 0; i < CASES; i++)
        ok = run_case(vessel, &cases[i], mode, duration, &out->lines[i], period[i]) && ok;
    out->lines[0].thick = true;
    snprintf(out->title, sizeof out->title, "%s, %s", name, modes[mode].title);
    snprintf(out->subtitle, sizeof out->subtitle,
             "period by theory and measured: %.4f and %.4f s; with added mass %.4f and %.4f s", period[0][0],
             period[0][1], period[1][0], period[1][1]);
    return ok;
}

static bool draw(const picture *pictures, const char *path)
{
    page_panel panels[2 * MODES];
    for (int i = 0; i < 2 * MODES; i++)
        panels[i] = (page_panel){chart_make(pictures[i].title, pictures[i].subtitle, "time [s]", "part of amplitude",
                                            pictures[i].lines, CASES),
                                 i / MODES * PANEL_WIDTH,
                                 TOP + i % MODES * PANEL_HEIGHT,
                                 PANEL_WIDTH,
                                 PANEL_HEIGHT,
                                 false};
    const page p = {.title = "Free decay from rest at a small amplitude",
                    .panels = panels,
                    .panel_count = 2 * MODES,
                    .text = "",
                    .width = 2 * PANEL_WIDTH,
                    .height = TOP + MODES * PANEL_HEIGHT};
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    if (page_write(&ctx, &p, path, &error) == FRAM_OK)
        return true;
    fprintf(stderr, "decay_bench: %s\n", error.message);
    return false;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: decay_bench PICTURE.png [HULL]\n");
        return 2;
    }
    char from_file[1000];
    snprintf(from_file, sizeof from_file, FROM_FILE, argc > 2 ? argv[2] : "");
    const struct {
        const char *name, *vessel;
    } vessels[] = {{"Box", BOX}, {"FPSO", argc > 2 ? from_file : FORM}};
    static picture pictures[2 * MODES];
    bool ok = true;
    for (int v = 0; v < 2; v++) {
        printf("%s\n| mode  | water                  | theory s | measured | apart    |\n", vessels[v].name);
        for (int m = 0; m < MODES; m++)
            ok = run_mode(vessels[v].vessel, vessels[v].name, m, &pictures[v * MODES + m]) && ok;
    }
    ok = ok && draw(pictures, argv[1]);
    for (int i = 0; i < 2 * MODES * CASES; i++) {
        const chart_line *line = &pictures[i / CASES].lines[i % CASES];
        free((void *)(uintptr_t)line->x);
        free((void *)(uintptr_t)line->y);
    }
    return ok ? 0 : 1;
}
