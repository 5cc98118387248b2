/* Free decay of a box and of an FPSO in heave, roll and pitch, without and with added mass: measured periods beside
   those of the theory of small motions, as a table and as pictures.

       decay_bench FOLDER [HULL]        HULL: mesh of the FPSO (GDF, STL, OBJ); without it a form of its size */
#include "../tests/sim/decay.h"

#include "io/chart.h"

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
} modes[] = {{"heave", "Heave decay", DECAY_HEAVE, 0.02},
             {"roll", "Roll decay", DECAY_ROLL, 1e-3},
             {"pitch", "Pitch decay", DECAY_PITCH, 2e-4}};
enum { MODES = sizeof modes / sizeof *modes };

/* One decay over `duration` seconds, in parts of its amplitude; false with a message. */
static bool run_case(const char *vessel, const water_case *c, int mode, double duration, chart_line *line)
{
    decay d;
    fram_error error = {0};
    char text[2000];
    *line = (chart_line){c->name, NULL, NULL, 0, false};
    int size = snprintf(text, sizeof text, SCENE, c->form, c->skin);
    snprintf(text + size, sizeof text - (size_t)size, vessel, c->keys);
    if (decay_open(&d, text, &error) != FRAM_OK) {
        fprintf(stderr, "decay_bench: %s: %s\n", error.key, error.message);
        return false;
    }
    double dt = d.settings.time_step, theory = d.period[modes[mode].mode];
    int steps = (int)(fmax(duration, 4.2 * theory) / dt);
    double *value = calloc((size_t)steps + 1, sizeof *value), *time = calloc((size_t)steps + 1, sizeof *time);
    bool ok = value && time;
    double period = ok ? decay_run(&d, modes[mode].mode, modes[mode].amplitude, steps, value, &error) : 0;
    for (int i = 0; ok && i <= steps; i++) {
        time[i] = i * dt;
        value[i] /= modes[mode].amplitude;
    }
    printf("| %-5s | %-22s | %8.4f | %8.4f | %8.2g |\n", modes[mode].name, c->name, theory, period,
           period / theory - 1);
    *line = (chart_line){c->name, time, value, (int32_t)(duration / dt), false};
    decay_close(&d);
    return ok && period > 0;
}

static bool draw_mode(context *ctx, const char *vessel, const char *name, int mode, const char *folder)
{
    chart_line lines[CASES];
    char path[600], subtitle[200];
    double duration = mode == 1 ? 60 : 40;
    bool ok = true;
    for (int i = 0; i < CASES; i++)
        ok = run_case(vessel, &cases[i], mode, duration, &lines[i]) && ok;
    lines[0].thick = true;
    snprintf(path, sizeof path, "%s/%s_%s_decay.png", folder, name, modes[mode].name);
    snprintf(subtitle, sizeof subtitle, "%s, from rest at a small amplitude", name);
    const chart c = {modes[mode].title, subtitle, "time [s]", "part of the amplitude", lines, CASES};
    fram_error error = {0};
    if (ok && chart_write(ctx, &c, path, 800, 320, &error) != FRAM_OK) {
        fprintf(stderr, "decay_bench: %s\n", error.message);
        ok = false;
    }
    for (int i = 0; i < CASES; i++) {
        free((void *)(uintptr_t)lines[i].x);
        free((void *)(uintptr_t)lines[i].y);
    }
    return ok;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: decay_bench FOLDER [HULL]\n");
        return 2;
    }
    char from_file[1000];
    snprintf(from_file, sizeof from_file, FROM_FILE, argc > 2 ? argv[2] : "");
    const struct {
        const char *name, *vessel;
    } vessels[] = {{"box", BOX}, {"fpso", argc > 2 ? from_file : FORM}};
    context ctx;
    context_init(&ctx);
    for (int v = 0; v < 2; v++) {
        printf("%s\n| mode  | water                  | theory s | measured | apart    |\n", vessels[v].name);
        for (int m = 0; m < MODES; m++)
            if (!draw_mode(&ctx, vessels[v].vessel, vessels[v].name, m, argv[1]))
                return 1;
    }
    return 0;
}
