/* The cost of floes of many corners:  corners_bench [MOST]

   Rings of 200, 400 ... MOST (12,800) corners, made into a floe, split, and bent at a corner: processor time of each,
   the least of a few rounds, and what it grows with (the exponent of the corners between a row and the one four times
   as fine).  `coast`: a rough shore; `teeth`: every other corner far inside, the worst that a ring can be. */
#include "base/random.h"
#include "base/transcendental.h"
#include "fracture_rig.h"

#include <time.h>

enum { FEWEST = 200, MOST = 6400, MOST_TEETH = 1600, ROUNDS = 3, HARMONICS = 40, ROWS = 16, CORNERS_TRIED = 5 };

/* Radius of the rings [m]. */
static const double RADIUS = 1000;

typedef enum ring_kind { COAST, TEETH, KINDS } ring_kind;
static const char *const KIND_NAMES[KINDS] = {"coast", "teeth"};

typedef enum part { MAKING, BENDING, SPLITTING, PARTS } part;
static const char *const PART_NAMES[PARTS] = {"made", "bent", "split"};

static double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Waves along the shore, the higher ones smaller, and the roughness of the corners. */
static double shore(double wave[HARMONICS][2], double angle)
{
    double radius = 1;
    for (int k = 0; k < HARMONICS; k++)
        radius += wave[k][0] * real_sin((k + 2) * angle + wave[k][1]);
    return radius;
}

static polygon make_ring(ring_kind kind, int32_t n, vec2 *v)
{
    random_stream s = random_begin(5, 1, (uint32_t)kind);
    double wave[HARMONICS][2];
    for (int k = 0; k < HARMONICS; k++) {
        wave[k][0] = random_uniform(&s, 0, 0.08) / (k + 2);
        wave[k][1] = random_uniform(&s, 0, 2 * PI);
    }
    for (int32_t i = 0; i < n; i++) {
        double angle = 2 * PI * (i + random_uniform(&s, 0, 0.4)) / n, rough = 10.0 / n;
        double radius = kind == TEETH ? (i % 2 ? random_uniform(&s, 0.5, 0.85) : random_uniform(&s, 0.9, 1))
                                      : shore(wave, angle) + random_uniform(&s, -rough, rough);
        v[i] = (vec2){RADIUS * radius * real_cos(angle), RADIUS * radius * real_sin(angle)};
    }
    return (polygon){v, n};
}

/* Processor time of making a floe of the ring, and of breaking it by a load at a corner [s]; false: it stays whole. */
static bool break_once(polygon ring, part p, int32_t corner, double *making, double *breaking)
{
    rig r;
    rig_make(&r);
    r.settings.edge_threshold = 0.01;
    if (p == SPLITTING) {
        r.settings.splitting = SPLITTING_LENGTH;
        r.settings.splitting_factor = r.settings.narrowness = 1e6;
    }
    double begin = processor_time();
    int32_t row = add_floe(&r, ring, MOTION_DYNAMIC, 0);
    *making = processor_time() - begin;
    add_load(&r, row, vec2_scale(ring.vertex[corner], 0.9999), 1e9, 1);
    begin = processor_time();
    break_loaded(&r);
    *breaking = processor_time() - begin;
    int32_t asked = p == SPLITTING ? FRACTURE_SPLIT : FRACTURE_BENDING;
    bool broke = r.events.count == 1 && r.events.data[0].kind == asked;
    rig_free(&r);
    return broke;
}

/* The least of some rounds, each at the first of a few corners where the ring does break as asked. */
static void measure(polygon ring, double time[PARTS])
{
    for (int p = 0; p < PARTS; p++)
        time[p] = HUGE_VAL;
    for (part p = BENDING; p < PARTS; p++) {
        int32_t corner = 0, step = ring.count / CORNERS_TRIED;
        for (int i = 0; i < ROUNDS && corner < ring.count;) {
            double making, breaking;
            bool broke = break_once(ring, p, corner, &making, &breaking);
            time[MAKING] = fmin(time[MAKING], making);
            if (broke) {
                time[p] = fmin(time[p], breaking);
                i++;
            } else {
                corner += step;
            }
        }
    }
}

static void print_time(const char *what, double time, double quarter)
{
    if (time < HUGE_VAL)
        printf(", %s %.3f ms", what, 1e3 * time);
    else
        printf(", not %s: whole", what);
    if (time < HUGE_VAL && quarter < HUGE_VAL)
        printf(" (exponent %.2f)", log(time / quarter) / log(4));
}

static void bench_kind(ring_kind kind, int32_t most, vec2 *room)
{
    double time[ROWS][PARTS];
    int row = 0;
    for (int32_t n = FEWEST; n <= most && row < ROWS; n *= 2, row++) {
        measure(make_ring(kind, n, room), time[row]);
        printf("%s of %d corners", KIND_NAMES[kind], (int)n);
        for (int p = 0; p < PARTS; p++)
            print_time(PART_NAMES[p], time[row][p], row >= 2 ? time[row - 2][p] : HUGE_VAL);
        printf("\n");
        fflush(stdout);
    }
}

int main(int count, char **value)
{
    int32_t most = count > 1 ? atoi(value[1]) : MOST;
    vec2 *room = most > 0 ? calloc((size_t)most, sizeof *room) : NULL;
    if (!room)
        stop("no memory");
    bench_kind(COAST, most, room);
    bench_kind(TEETH, most < MOST_TEETH ? most : MOST_TEETH, room);
    free(room);
    return EXIT_SUCCESS;
}
