/* box3d_floes - the peer: Box3D (32-bit floats, soft contacts, substeps), plain C; built from its sources.
   usage: box3d_floes SCENE [--dt 0.02] [--iters 4] [--time 20] [--warm 5] [--dump out.csv]    iters: substeps */
#include "scene.h"
#include <box3d/box3d.h>

typedef struct { double dt, T, warm; int sub; const char *scene, *dump; } options;

static b3Vec3 vec(double x, double y, double z) { b3Vec3 v = {(float)x, (float)y, (float)z}; return v; }

static int read_options(int argc, char **argv, options *o)
{
    options d = {0.02, 20, 5, 4, argc > 1 ? argv[1] : NULL, NULL};
    *o = d;
    for (int i = 2; i + 1 < argc; i += 2) {
        const char *value = argv[i + 1];
        if (!strcmp(argv[i], "--dt")) o->dt = atof(value);
        else if (!strcmp(argv[i], "--iters")) o->sub = atoi(value);
        else if (!strcmp(argv[i], "--time")) o->T = atof(value);
        else if (!strcmp(argv[i], "--warm")) o->warm = atof(value);
        else if (!strcmp(argv[i], "--dump")) o->dump = value;
        else return -1;
    }
    return o->scene && argc % 2 == 0 ? 0 : -1;
}

static b3BodyId make_body(b3WorldId w, const sc_scene *s, b3BodyType type, double x, double y, double z, const b3HullData *hull)
{
    b3BodyDef bd = b3DefaultBodyDef();
    bd.type = type;
    bd.position.x = (float)x;
    bd.position.y = (float)y;
    bd.position.z = (float)z;
    b3BodyId body = b3CreateBody(w, &bd);
    b3ShapeDef sd = b3DefaultShapeDef();
    sd.baseMaterial.friction = (float)s->mu;
    sd.baseMaterial.restitution = (float)s->rest;
    b3CreateHullShape(body, &sd, hull);
    return body;
}

/* A prism of the scene's mass and inertia about its centroid. */
static b3BodyId make_floe(b3WorldId w, const sc_scene *s, const sc_floe *f)
{
    b3Vec3 corner[2 * SC_MAXV];
    for (int k = 0; k < f->nv; k++) {
        corner[2 * k] = vec(f->v[k][0], f->v[k][1], -0.5 * f->h);
        corner[2 * k + 1] = vec(f->v[k][0], f->v[k][1], 0.5 * f->h);
    }
    b3HullData *hull = b3CreateHull(corner, 2 * f->nv, 2 * f->nv);
    if (!hull) { fprintf(stderr, "Box3D makes no hull of a floe\n"); exit(1); }
    b3BodyId body = make_body(w, s, b3_dynamicBody, f->x, f->y, sc_z0(s, f), hull);
    b3DestroyHull(hull);
    b3MassData m;
    memset(&m, 0, sizeof m);
    m.mass = (float)f->mass;
    m.inertia.cx.x = (float)f->ixx;
    m.inertia.cy.y = (float)f->iyy;
    m.inertia.cz.z = (float)f->izz;
    b3Body_SetMassData(body, m);
    return body;
}

static void make_walls(b3WorldId w, const sc_scene *s)
{
    double lx = s->dom[2] - s->dom[0], ly = s->dom[3] - s->dom[1], mx = s->dom[0] + lx / 2, my = s->dom[1] + ly / 2, t = 10;
    b3BoxHull across = b3MakeBoxHull((float)t, (float)(ly / 2 + 2 * t), 20), along = b3MakeBoxHull((float)(lx / 2 + 2 * t), (float)t, 20);
    make_body(w, s, b3_staticBody, s->dom[0] - t, my, 0, &across.base);
    make_body(w, s, b3_staticBody, s->dom[2] + t, my, 0, &across.base);
    make_body(w, s, b3_staticBody, mx, s->dom[1] - t, 0, &along.base);
    make_body(w, s, b3_staticBody, mx, s->dom[3] + t, 0, &along.base);
}

static void rotation_of(b3Quat q, double R[9])
{
    double x = q.v.x, y = q.v.y, z = q.v.z, w = q.s;
    double m[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
                   2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                   2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)};
    memcpy(R, m, sizeof m);
}

static void push_by_water(const sc_scene *s, const b3BodyId *body)
{
    for (int i = 0; i < s->n; i++) {
        b3WorldTransform t = b3Body_GetTransform(body[i]);
        b3Vec3 lv = b3Body_GetLinearVelocity(body[i]), av = b3Body_GetAngularVelocity(body[i]);
        double p[3] = {t.p.x, t.p.y, t.p.z}, v[3] = {lv.x, lv.y, lv.z}, o[3] = {av.x, av.y, av.z}, R[9], F[3], Q[3];
        rotation_of(t.q, R);
        sc_water(s, &s->f[i], p, R, v, o, F, Q);
        b3Body_ApplyForceToCenter(body[i], vec(F[0], F[1], F[2]), true);
        b3Body_ApplyTorque(body[i], vec(Q[0], Q[1], Q[2]), true);
    }
}

/* Mean force on the ship against +x.  A point's totalNormalImpulse counts the biased and the relaxed pass of every substep,
   about twice what acts; the impulses of the last substep stand for all. */
static double load_of(b3BodyId ship, const options *o, b3ContactData *room, int most)
{
    double sum = 0;
    int n = b3Body_GetContactData(ship, room, most);
    for (int i = 0; i < n; i++) {
        double sign = B3_ID_EQUALS(b3Shape_GetBody(room[i].shapeIdA), ship) ? 1 : -1; /* the normal goes from A to B */
        for (int k = 0; k < room[i].manifoldCount; k++) {
            const b3Manifold *m = &room[i].manifolds[k];
            double impulse = m->frictionImpulse.x;
            for (int j = 0; j < m->pointCount; j++) impulse += (double)m->points[j].normalImpulse * m->normal.x;
            sum += sign * impulse;
        }
    }
    return sum * o->sub / o->dt;
}

static void dump_poses(const char *path, const sc_scene *s, const b3BodyId *body)
{
    FILE *fp = fopen(path, "w");
    if (!fp) { perror(path); exit(1); }
    fprintf(fp, "id,x,y,z,qx,qy,qz,qw,tilt_deg\n");
    for (int i = 0; i < s->n; i++) {
        b3WorldTransform t = b3Body_GetTransform(body[i]);
        double R[9];
        rotation_of(t.q, R);
        fprintf(fp, "%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.3f\n", i, (double)t.p.x, (double)t.p.y, (double)t.p.z,
                (double)t.q.v.x, (double)t.q.v.y, (double)t.q.v.z, (double)t.q.s, acos(fmin(1, fabs(R[8]))) * 57.29578);
    }
    fclose(fp);
}

int main(int argc, char **argv)
{
    options o;
    sc_scene s;
    if (read_options(argc, argv, &o)) { fprintf(stderr, "usage: box3d_floes SCENE [--dt s] [--iters substeps] [--time s] [--warm s] [--dump csv]\n"); return 2; }
    if (sc_read(o.scene, &s)) return 1;
    b3WorldDef wd = b3DefaultWorldDef();
    wd.gravity = vec(0, 0, -s.g);
    wd.enableSleep = false;
    wd.enableContinuous = false;
    wd.workerCount = 1;
    b3WorldId w = b3CreateWorld(&wd);
    b3BodyId *body = malloc((size_t)s.n * sizeof *body);
    for (int i = 0; i < s.n; i++) body[i] = make_floe(w, &s, &s.f[i]);
    make_walls(w, &s);
    b3BoxHull box = b3MakeBoxHull((float)s.ship[0] / 2, (float)s.ship[1] / 2, (float)s.ship[2] / 2);
    b3BodyId ship = make_body(w, &s, b3_kinematicBody, s.ship[4], s.ship[5], 0.5 * s.ship[2] - s.ship[3], &box.base);
    b3Body_SetLinearVelocity(ship, vec(s.ship_v[0], s.ship_v[1], 0));
    enum { MOST = 4096 };
    b3ContactData *room = malloc(MOST * sizeof *room);
    int nw = (int)(o.warm / o.dt + 0.5), ns = (int)(o.T / o.dt + 0.5) - nw;
    double *cpu = calloc(8 * (size_t)ns, sizeof *cpu);
    double *wall = cpu + ns, *col = wall + ns, *so = col + ns, *fr = so + ns, *ct = fr + ns, *pr = ct + ns, *sf = pr + ns, deepest = 0;
    for (int k = -nw; k < ns; k++) {
        double tw = sc_wall(), tc = sc_cpu();
        push_by_water(&s, body);
        double tf = sc_cpu();
        b3World_Step(w, (float)o.dt, o.sub);
        double te = sc_cpu(), we = sc_wall();
        if (k < 0) continue;
        b3Profile profile = b3World_GetProfile(w);
        b3Counters counters = b3World_GetCounters(w);
        cpu[k] = te - tc; wall[k] = we - tw; fr[k] = tf - tc;
        col[k] = (double)profile.pairs + (double)profile.collide; so[k] = profile.solve;
        for (int c = 0; c < 24; c++) pr[k] += counters.colorCounts[c];
        sf[k] = load_of(ship, &o, room, MOST);
    }
    sc_report("box3d", o.scene, s.n, o.dt, o.sub, ns, cpu, wall, col, so, fr, ct, pr, sf, deepest);
    if (o.dump) dump_poses(o.dump, &s, body);
    return 0;
}
