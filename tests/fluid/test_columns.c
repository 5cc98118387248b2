/* fluid/columns against a plain transcription of the peers' water (bench/peers/scene.h), and against Archimedes. */
#include "base/pool.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "field.h"
#include "fluid/columns.h"

static const column_medium medium = {9.81, 1025, {0.3, -0.1}, 1.0, 0.01};

/* One floe, scalar, in the peers' own order; weight added. */
static wrench plain_water(const column_medium *m, polygon p, double h, double mass, vec3 at, mat3 r, vec3 v, vec3 w)
{
    wrench sum = {{0, 0, 0}, {0, 0, 0}};
    double upright = fmax(r.m[2][2], 0.2), perimeter = polygon_perimeter(p);
    for (int32_t i = 0; i < p.count; i++) {
        vec2 a = p.vertex[i], b = p.vertex[(i + 1) % p.count];
        double area = 0.5 * vec2_cross(a, b);
        vec3 local = {(a.x + b.x) / 3, (a.y + b.y) / 3, -0.5 * h};
        double sub = -(at.z + mat3_mul_vec(r, local).z) / upright;
        if (sub <= 0)
            continue;
        sub = fmin(sub, h);
        local.z += 0.5 * sub;
        vec3 arm = mat3_mul_vec(r, local), u = vec3_add(v, vec3_cross(w, arm));
        u.x -= m->current.x;
        u.y -= m->current.y;
        double speed = sqrt(u.x * u.x + u.y * u.y), q = 0.5 * m->water_density * area;
        double drag =
            q * m->skin_drag * speed + 0.5 * m->water_density * m->form_drag * (perimeter / PI) * sub * speed / p.count;
        double lift = m->water_density * m->gravity * area * sub - q * m->form_drag * (fabs(u.z) + 1) * u.z;
        vec3 f = {-drag * u.x, -drag * u.y, lift};
        sum.force = vec3_add(sum.force, f);
        sum.moment = vec3_add(sum.moment, vec3_cross(arm, f));
    }
    sum.force.z -= m->gravity * mass;
    return sum;
}

static int32_t add_polygon(field *f, motion kind, int sides, double radius, double turn, double h)
{
    vec2 corner[16];
    for (int k = 0; k < sides; k++)
        corner[k] =
            vec2_make(radius * real_cos(turn + 2 * PI * k / sides), radius * real_sin(turn + 2 * PI * k / sides));
    fram_error e = {0};
    int32_t row, slot = body_create(&f->ctx, &f->bodies, kind, MATERIAL_ICE);
    assert_ok(shape_add_prism(&f->ctx, &f->shapes, NULL, (polygon){corner, sides}, h / 2, 0, &row, &e), e);
    f->bodies.shape[slot] = row;
    f->bodies.mass[slot] = 910 * h * f->shapes.shapes.area[row];
    return slot;
}

static vec3 random_vec3(random_stream *draw, double size)
{
    double x = random_normal(draw), y = random_normal(draw), z = random_normal(draw);
    return vec3_make(size * x, size * y, size * z);
}

/* Floes of 3 to 16 sides, some of them capsized, sunk or in the air, some static. */
static field random_field(int count)
{
    field f = {0};
    context_init(&f.ctx);
    random_stream draw = random_begin(11, 0, 0);
    for (int i = 0; i < count; i++) {
        double tilt = i % 5 == 4 ? 1.0 : 0.05;
        int32_t slot = add_polygon(&f, i % 7 == 6 ? MOTION_STATIC : MOTION_DYNAMIC, 3 + i % 14,
                                   random_uniform(&draw, 1, 9), 0.1 * i, random_uniform(&draw, 0.3, 2));
        f.bodies.position[slot] = random_vec3(&draw, i % 11 == 10 ? 5 : 0.3);
        vec3 angle = random_vec3(&draw, tilt);
        f.bodies.orientation[slot] = quat_from_roll_pitch_yaw(angle.x, angle.y, 60 * angle.z);
        f.bodies.velocity[slot] = random_vec3(&draw, 1);
        f.bodies.angular_velocity[slot] = random_vec3(&draw, 0.3);
    }
    return f;
}

START_TEST(columns_equal_the_peers_water)
{
    field f = random_field(203);
    column_water water;
    fram_error e = {0};
    assert_ok(column_water_make(&f.ctx, &medium, &f.bodies, &f.shapes, &water, &e), e);
    wrench loads[203];
    memset(loads, 0xff, sizeof loads);
    column_water_apply(&f.ctx, &water, &f.bodies, loads);
    for (int32_t i = 0; i < f.bodies.count; i++) {
        int32_t row = f.bodies.shape[i];
        double h = 2 * f.shapes.shapes.half_height[row], mass = f.bodies.mass[i];
        double scale = medium.gravity * mass * (f.shapes.shapes.radius[row] + 1);
        wrench wanted = {{0, 0, 0}, {0, 0, 0}};
        if (f.bodies.motion[i] == MOTION_DYNAMIC)
            wanted =
                plain_water(&medium, shape_outline(&f.shapes, row), h, mass, f.bodies.position[i],
                            quat_matrix(f.bodies.orientation[i]), f.bodies.velocity[i], f.bodies.angular_velocity[i]);
        assert_absolute(vec3_length(vec3_sub(loads[i].force, wanted.force)), 0, 1e-12 * scale);
        assert_absolute(vec3_length(vec3_sub(loads[i].moment, wanted.moment)), 0, 1e-12 * scale);
    }
    column_water_free(&f.ctx, &water);
    field_close(&f);
}
END_TEST

START_TEST(every_isa_and_thread_count_gives_the_same_bits)
{
    field f = random_field(301);
    column_water water;
    fram_error e = {0};
    assert_ok(column_water_make(&f.ctx, &medium, &f.bodies, &f.shapes, &water, &e), e);
    wrench first[301], other[301];
    f.ctx.isa = ISA_BASELINE;
    column_water_apply(&f.ctx, &water, &f.bodies, first);
    for (int i = ISA_BASELINE; i <= (int)isa_best(); i++) {
        f.ctx.isa = (isa)i;
        f.ctx.threads = pool_create(&f.ctx, 1 + i);
        column_water_apply(&f.ctx, &water, &f.bodies, other);
        ck_assert(memcmp(first, other, sizeof first) == 0);
        pool_free(&f.ctx, f.ctx.threads);
        f.ctx.threads = NULL;
    }
    column_water_free(&f.ctx, &water);
    field_close(&f);
}
END_TEST

START_TEST(a_floe_at_rest_floats_by_archimedes)
{
    field f = {0};
    context_init(&f.ctx);
    int32_t slot = add_polygon(&f, MOTION_DYNAMIC, 6, 5, 0, 1);
    f.bodies.position[slot].z = 0.5 - 910.0 / 1025;
    column_medium still = medium;
    still.current = vec2_make(0, 0);
    column_water water;
    fram_error e = {0};
    assert_ok(column_water_make(&f.ctx, &still, &f.bodies, &f.shapes, &water, &e), e);
    wrench load;
    column_water_apply(&f.ctx, &water, &f.bodies, &load);
    double scale = f.bodies.mass[slot] * 9.81;
    assert_absolute(vec3_length(load.force), 0, 1e-12 * scale);
    assert_absolute(vec3_length(load.moment), 0, 1e-12 * scale);
    column_water_free(&f.ctx, &water);
    field_close(&f);
}
END_TEST

START_TEST(bodies_without_a_prism_are_refused)
{
    field f = {0};
    context_init(&f.ctx);
    body_create(&f.ctx, &f.bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    column_water water;
    fram_error e = {0};
    assert_fails(column_water_make(&f.ctx, &medium, &f.bodies, &f.shapes, &water, &e), e, FRAM_ERROR_USAGE, "body 0");
    field_close(&f);
}
END_TEST

START_TEST(memory_runs_out)
{
    field f = random_field(20);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        column_water water;
        turn.status = column_water_make(&turn.ctx, &medium, &f.bodies, &f.shapes, &water, &turn.error);
        column_water_free(&turn.ctx, &water);
    }
    field_close(&f);
}
END_TEST

TEST_MAIN("columns", columns_equal_the_peers_water, every_isa_and_thread_count_gives_the_same_bits,
          a_floe_at_rest_floats_by_archimedes, bodies_without_a_prism_are_refused, memory_runs_out)
