/* jolt_floes - the peer: Jolt Physics (32-bit floats), one thread; built from its sources.
   usage: jolt_floes SCENE [--dt 0.02] [--iters 10] [--time 20] [--warm 5] [--dump out.csv]    iters: of velocities */
#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>
#include <Jolt/Physics/PhysicsSettings.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/RegisterTypes.h>

#include "scene.h"

#include <vector>

namespace {

enum : JPH::ObjectLayer { FIXED, MOVING };

struct Layers final : JPH::BroadPhaseLayerInterface {
    JPH::uint GetNumBroadPhaseLayers() const override { return 2; }
    JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer layer) const override {
        return JPH::BroadPhaseLayer(static_cast<JPH::BroadPhaseLayer::Type>(layer));
    }
};
struct LayerMeets final : JPH::ObjectVsBroadPhaseLayerFilter {
    bool ShouldCollide(JPH::ObjectLayer a, JPH::BroadPhaseLayer b) const override { return a == MOVING || b == JPH::BroadPhaseLayer(MOVING); }
};
struct PairMeets final : JPH::ObjectLayerPairFilter {
    bool ShouldCollide(JPH::ObjectLayer a, JPH::ObjectLayer b) const override { return a == MOVING || b == MOVING; }
};

/* The ship is a body so heavy that ice hardly slows it within a step, and has its velocity back after each: what it lost is
   the load, which Jolt does not tell of bodies that are moved.  1e9 kg lose 2e-5 m/s to 1 MN; a float of 2 m/s tells 2e-7. */
const float SHIP_MASS = 1e9f;

struct Options {
    double dt = 0.02, T = 20, warm = 5;
    int iterations = 10;
    const char *scene = nullptr, *dump = nullptr;
};

bool read_options(int argc, char **argv, Options &o) {
    if (argc < 2 || argc % 2) return false;
    o.scene = argv[1];
    for (int i = 2; i < argc; i += 2) {
        const char *value = argv[i + 1];
        if (!strcmp(argv[i], "--dt")) o.dt = atof(value);
        else if (!strcmp(argv[i], "--iters")) o.iterations = atoi(value);
        else if (!strcmp(argv[i], "--time")) o.T = atof(value);
        else if (!strcmp(argv[i], "--warm")) o.warm = atof(value);
        else if (!strcmp(argv[i], "--dump")) o.dump = value;
        else return false;
    }
    return true;
}

JPH::Vec3 vec(double x, double y, double z) { return JPH::Vec3(float(x), float(y), float(z)); }

struct Scene {
    sc_scene s;
    Layers layers;
    LayerMeets layer_meets;
    PairMeets pair_meets;
    JPH::PhysicsSystem system;
    std::vector<JPH::Body *> floes;
    JPH::Body *ship = nullptr;

    JPH::Body *add(const JPH::Shape *shape, double x, double y, double z, JPH::EMotionType motion, float mass) {
        bool moves = motion != JPH::EMotionType::Static;
        JPH::BodyCreationSettings b(shape, vec(x, y, z), JPH::Quat::sIdentity(), motion, moves ? MOVING : FIXED);
        b.mFriction = float(s.mu);
        b.mRestitution = float(s.rest);
        b.mLinearDamping = b.mAngularDamping = 0;
        b.mAllowSleeping = false;
        if (mass > 0) { /* the ship */
            b.mOverrideMassProperties = JPH::EOverrideMassProperties::CalculateInertia;
            b.mMassPropertiesOverride.mMass = mass;
            b.mGravityFactor = 0;
            b.mAllowedDOFs = JPH::EAllowedDOFs::TranslationX | JPH::EAllowedDOFs::TranslationY;
        }
        JPH::BodyInterface &bodies = system.GetBodyInterfaceNoLock();
        JPH::Body *body = bodies.CreateBody(b);
        bodies.AddBody(body->GetID(), moves ? JPH::EActivation::Activate : JPH::EActivation::DontActivate);
        return body;
    }

    void add_floe(const sc_floe &f) {
        JPH::Array<JPH::Vec3> corner;
        for (int k = 0; k < f.nv; k++)
            for (double z : {-0.5 * f.h, 0.5 * f.h}) corner.push_back(vec(f.v[k][0], f.v[k][1], z));
        JPH::ConvexHullShapeSettings hull(corner);
        hull.SetDensity(float(f.rho));
        JPH::ShapeSettings::ShapeResult made = hull.Create();
        if (made.HasError()) {
            fprintf(stderr, "Jolt makes no hull of a floe: %s\n", made.GetError().c_str());
            exit(1);
        }
        floes.push_back(add(made.Get(), f.x, f.y, sc_z0(&s, &f), JPH::EMotionType::Dynamic, 0));
    }

    void add_walls() {
        double t = 10, lx = s.dom[2] - s.dom[0], ly = s.dom[3] - s.dom[1], mx = s.dom[0] + lx / 2, my = s.dom[1] + ly / 2;
        JPH::Ref<JPH::Shape> across = new JPH::BoxShape(vec(t, ly / 2 + 2 * t, 20)), along = new JPH::BoxShape(vec(lx / 2 + 2 * t, t, 20));
        add(across, s.dom[0] - t, my, 0, JPH::EMotionType::Static, 0);
        add(across, s.dom[2] + t, my, 0, JPH::EMotionType::Static, 0);
        add(along, mx, s.dom[1] - t, 0, JPH::EMotionType::Static, 0);
        add(along, mx, s.dom[3] + t, 0, JPH::EMotionType::Static, 0);
    }

    void build(const Options &o) {
        system.Init(65536, 0, 262144, 131072, layers, layer_meets, pair_meets);
        system.SetGravity(vec(0, 0, -s.g));
        JPH::PhysicsSettings settings = system.GetPhysicsSettings();
        settings.mNumVelocitySteps = JPH::uint(o.iterations);
        settings.mAllowSleeping = false;
        system.SetPhysicsSettings(settings);
        for (int i = 0; i < s.n; i++) add_floe(s.f[i]);
        add_walls();
        JPH::Ref<JPH::Shape> box = new JPH::BoxShape(vec(s.ship[0] / 2, s.ship[1] / 2, s.ship[2] / 2));
        ship = add(box, s.ship[4], s.ship[5], 0.5 * s.ship[2] - s.ship[3], JPH::EMotionType::Dynamic, SHIP_MASS);
        system.OptimizeBroadPhase();
    }

    void push_by_water() {
        for (int i = 0; i < s.n; i++) {
            JPH::Body *b = floes[size_t(i)];
            JPH::RMat44 m = b->GetCenterOfMassTransform();
            JPH::RVec3 c = b->GetCenterOfMassPosition();
            JPH::Vec3 lv = b->GetLinearVelocity(), av = b->GetAngularVelocity();
            double p[3], v[3], w[3], R[9], F[3], Q[3];
            for (unsigned k = 0; k < 3; k++) {
                p[k] = double(c[k]), v[k] = double(lv[k]), w[k] = double(av[k]);
                for (unsigned j = 0; j < 3; j++) R[3 * k + j] = double(m(k, j));
            }
            sc_water(&s, &s.f[i], p, R, v, w, F, Q);
            b->AddForce(vec(F[0], F[1], F[2]));
            b->AddTorque(vec(Q[0], Q[1], Q[2]));
        }
    }

    void dump(const char *path) const {
        FILE *fp = fopen(path, "w");
        if (!fp) { perror(path); exit(1); }
        fprintf(fp, "id,x,y,z,qx,qy,qz,qw,tilt_deg\n");
        for (int i = 0; i < s.n; i++) {
            JPH::RVec3 p = floes[size_t(i)]->GetCenterOfMassPosition();
            JPH::Quat q = floes[size_t(i)]->GetRotation();
            double up = 1 - 2 * (double(q.GetX()) * q.GetX() + double(q.GetY()) * q.GetY());
            fprintf(fp, "%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.3f\n", i, double(p.GetX()), double(p.GetY()), double(p.GetZ()), double(q.GetX()),
                    double(q.GetY()), double(q.GetZ()), double(q.GetW()), acos(fmin(1, fabs(up))) * 57.29578);
        }
        fclose(fp);
    }
};

} // namespace

int main(int argc, char **argv) {
    Options o;
    if (!read_options(argc, argv, o)) {
        fprintf(stderr, "usage: jolt_floes SCENE [--dt s] [--iters n] [--time s] [--warm s] [--dump csv]\n");
        return 2;
    }
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory;
    JPH::RegisterTypes();
    JPH::TempAllocatorImpl room(256 << 20);
    JPH::JobSystemSingleThreaded jobs(JPH::cMaxPhysicsJobs);
    Scene scene;
    if (sc_read(o.scene, &scene.s)) return 1;
    scene.build(o);
    const JPH::Vec3 course = vec(scene.s.ship_v[0], scene.s.ship_v[1], 0);
    int nw = int(o.warm / o.dt + 0.5), ns = int(o.T / o.dt + 0.5) - nw;
    std::vector<double> cpu(size_t(ns), 0.0), wall = cpu, none = cpu, forces = cpu, rest = cpu, load = cpu;
    for (int k = -nw; k < ns; k++) {
        double tw = sc_wall(), tc = sc_cpu();
        scene.push_by_water();
        scene.ship->SetLinearVelocity(course);
        double tf = sc_cpu();
        if (scene.system.Update(float(o.dt), 1, &room, &jobs) != JPH::EPhysicsUpdateError::None) {
            fprintf(stderr, "Jolt ran out of room for bodies or contacts\n");
            return 1;
        }
        double te = sc_cpu(), we = sc_wall();
        if (k < 0) continue;
        size_t i = size_t(k);
        cpu[i] = te - tc, wall[i] = we - tw, forces[i] = tf - tc, rest[i] = te - tf;
        load[i] = double(course.GetX() - scene.ship->GetLinearVelocity().GetX()) * double(SHIP_MASS) / o.dt;
    }
    sc_report("jolt", o.scene, scene.s.n, o.dt, o.iterations, ns, cpu.data(), wall.data(), none.data(), rest.data(), forces.data(),
              none.data(), none.data(), load.data(), 0);
    if (o.dump) scene.dump(o.dump);
    return 0;
}
