/* Fluid forces of a field of level floes: Fram's (src/fluid) beside the simpler water model that the peers share
   (bench/peers/scene.h, sc_water), on the same floes with the same poses and velocities, interleaved, on one thread.

       fluid_bench SCENE [ROUNDS]

   `warm` is one after the other with the caches as they come; `cold` after walking through as much other memory as the
   other stages of a step do.  `air`: with wind on the dry surfaces too, which the peers' model does not have. */
#include "base/build_parts.h"
#include "base/random.h"
#include "fluid/fluid.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include "peers/scene.h"
#pragma GCC diagnostic pop

/* Speeds and tilts of a field that a ship stirs. */
#define DRIFT 0.2      /* [m/s] */
#define HEAVE 0.02     /* [m/s] */
#define ROLL_RATE 0.01 /* [rad/s] */
#define YAW_RATE 0.03  /* [rad/s] */
#define TILT 0.003     /* [rad] */
#define WIND 8.0       /* [m/s] */
#define COLD_BYTES (16 << 20)

typedef struct pose {
    double position[3], rotation[9], velocity[3], spin[3];
} pose;

typedef struct field {
    sc_scene scene;
    body_table bodies;
    shape_store shapes;
    pose *poses;
    wrench *peer, *loads;
    double *volume;
    unsigned char *other; /* memory of other stages */
} field;

static vec3 random_vec(random_stream *r, double plane, double up)
{
    double x = random_uniform(r, -plane, plane), y = random_uniform(r, -plane, plane);
    return vec3_make(x, y, random_uniform(r, -up, up));
}

static bool add_floe(context *ctx, field *f, random_stream *r, int i)
{
    const sc_floe *floe = &f->scene.f[i];
    fram_error error = {0};
    vec2 outline[SC_MAXV];
    int32_t shape;
    for (int k = 0; k < floe->nv; k++)
        outline[k] = vec2_make(floe->v[k][0], floe->v[k][1]);
    if (shape_add_prism(ctx, &f->shapes, NULL, (polygon){outline, floe->nv}, floe->h / 2, 0, &shape, &error) != FRAM_OK)
        return false;
    int32_t slot = body_create(ctx, &f->bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    if (slot != i)
        return false;
    body_table *b = &f->bodies;
    b->shape[slot] = shape;
    b->mass[slot] = floe->mass;
    b->position[slot] = vec3_make(floe->x, floe->y, sc_z0(&f->scene, floe));
    b->velocity[slot] = random_vec(r, DRIFT, HEAVE);
    b->angular_velocity[slot] = random_vec(r, ROLL_RATE, YAW_RATE);
    vec3 turn = random_vec(r, TILT, 3);
    b->orientation[slot] = quat_from_roll_pitch_yaw(turn.x, turn.y, turn.z);
    mat3 rotation = quat_matrix(b->orientation[slot]);
    pose *p = &f->poses[i];
    memcpy(p->position, &b->position[slot], sizeof p->position);
    memcpy(p->rotation, &rotation, sizeof p->rotation);
    memcpy(p->velocity, &b->velocity[slot], sizeof p->velocity);
    memcpy(p->spin, &b->angular_velocity[slot], sizeof p->spin);
    return true;
}

static bool make_field(context *ctx, field *f)
{
    size_t n = (size_t)f->scene.n;
    f->poses = memory_array(ctx, n, sizeof *f->poses);
    f->peer = memory_array(ctx, n, sizeof *f->peer);
    f->loads = memory_array(ctx, n, sizeof *f->loads);
    f->volume = memory_array(ctx, n, sizeof *f->volume);
    f->other = memory_array(ctx, COLD_BYTES, 1);
    bool ok = f->poses && f->peer && f->loads && f->volume && f->other;
    random_stream r = random_begin(1, 0, 0);
    for (int i = 0; i < f->scene.n && ok; i++)
        ok = add_floe(ctx, f, &r, i);
    return ok;
}

static void run_peers(field *f)
{
    for (int i = 0; i < f->scene.n; i++) {
        const pose *p = &f->poses[i];
        double force[3], moment[3];
        sc_water(&f->scene, &f->scene.f[i], p->position, p->rotation, p->velocity, p->spin, force, moment);
        memcpy(&f->peer[i].force, force, sizeof force);
        memcpy(&f->peer[i].moment, moment, sizeof moment);
    }
}

/* Leaves other memory in the caches. */
static void cool(field *f)
{
    for (size_t i = 0; i < COLD_BYTES; i += 64)
        f->other[i]++;
}

typedef struct timing {
    double peers, fluid; /* medians [ms] */
} timing;

enum { MOST_ROUNDS = 1000 };

static timing measure(context *ctx, field *f, bool air, bool cold, int rounds)
{
    const sc_scene *s = &f->scene;
    const media m = {.gravity = s->g,
                     .water_density = s->rho_w,
                     .air_density = 1.225,
                     .current = {s->cur[0], s->cur[1], 0},
                     .wind = {WIND, 0, 0}};
    const drag_coefficients c[MATERIAL_COUNT] = {[MATERIAL_ICE] = {s->cform, s->cskin, air ? 1 : 0, air ? 0.003 : 0}};
    double peers[MOST_ROUNDS], fluid[MOST_ROUNDS];
    for (int i = 0; i < rounds; i++) {
        fram_error error;
        if (cold)
            cool(f);
        double start = sc_cpu();
        run_peers(f);
        peers[i] = sc_cpu() - start;
        if (cold)
            cool(f);
        start = sc_cpu();
        fluid_apply(ctx, &m, c, &f->bodies, &f->shapes, NULL, f->loads, &(fluid_details){.volume = f->volume}, &error);
        fluid[i] = sc_cpu() - start;
    }
    return (timing){sc_q(peers, rounds, 0.5), sc_q(fluid, rounds, 0.5)};
}

int main(int argc, char **argv)
{
    int rounds = argc > 2 ? atoi(argv[2]) : 200;
    if (argc < 2 || rounds < 1 || rounds > MOST_ROUNDS) {
        fprintf(stderr, "usage: fluid_bench SCENE [ROUNDS, at most %d]\n", (int)MOST_ROUNDS);
        return 2;
    }
    context ctx;
    context_init(&ctx);
    field f = {0};
    if (sc_read(argv[1], &f.scene) != 0 || !make_field(&ctx, &f)) {
        fprintf(stderr, "fluid_bench: %s gives no field\n", argv[1]);
        return 1;
    }
    printf("# compiler %s; %d floes, %d rounds, one thread, medians\n", build_compiler(), f.scene.n, rounds);
    for (int set = ISA_BASELINE; set <= (int)isa_best(); set++) {
        ctx.isa = (isa)set;
        for (int k = 0; k < 4; k++) {
            timing t = measure(&ctx, &f, k & 1, k >> 1, rounds);
            printf("%-8s %-5s %s  peers %.3f ms  fluid %.3f ms  ratio %.2f\n", isa_name(ctx.isa),
                   k & 1 ? "air" : "water", k >> 1 ? "cold" : "warm", t.peers, t.fluid, t.fluid / t.peers);
        }
    }
    return 0;
}
