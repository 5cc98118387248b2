/* A scenario's hull from a mesh file: measured, cut, placed about its centre of mass; mistakes named by key or place.
 */
#include "io/scenario_file.h"
#include "scratch.h"
#include "sim/build_hull.h"
#include "sim/build_vessel.h"
#include <stdio.h>
#include <unistd.h>

/* A box of 40 x 10 x 3 m under water, x from 0 to 40, open at z = 0, in millimetres: half of it. */
static const char half_box[] = "a barge\n1 9.81\n0 1\n4\n"
                               "0 0 -3000  0 5000 -3000  40000 5000 -3000  40000 0 -3000\n"
                               "40000 0 -3000  40000 5000 -3000  40000 5000 0  40000 0 0\n"
                               "40000 5000 -3000  0 5000 -3000  0 5000 0  40000 5000 0\n"
                               "0 5000 -3000  0 0 -3000  0 0 0  0 5000 0\n";

typedef struct folder {
    char name[SCRATCH_FOLDER], mesh[SCRATCH_PATH], scene[SCRATCH_PATH];
} folder;

static folder make_folder(const char *hull_keys, const char *mesh_text)
{
    folder f;
    scratch_folder(f.name);
    snprintf(f.mesh, sizeof f.mesh, "%s/barge.gdf", f.name);
    snprintf(f.scene, sizeof f.scene, "%s/scene.yaml", f.name);
    char text[512];
    snprintf(text, sizeof text, "vessel:\n  hull:\n    form: file\n    file: barge.gdf\n%s", hull_keys);
    scratch_text(f.scene, text);
    scratch_text(f.mesh, mesh_text);
    return f;
}

static void remove_folder(const folder *f)
{
    unlink(f->mesh);
    unlink(f->scene);
    ck_assert_int_eq(rmdir(f->name), 0);
}

static fram_status build_with(context *ctx, const folder *f, const char *set, hull_store *store, vessel_model *hull,
                              solid_array *solids, fram_error *error)
{
    const char *const item[] = {set};
    const scenario_overrides overrides = {item, 1};
    scenario s;
    fram_status status = scenario_read(ctx, f->scene, set ? &overrides : NULL, &s, error);
    if (status != FRAM_OK)
        return status;
    const vessel_entry entry = scenario_vessel_entry(&s, 0);
    status = build_hull(ctx, &s, &entry, store, solids, hull, error);
    scenario_free(ctx, &s);
    return status;
}

static fram_status build(context *ctx, const folder *f, vessel_model *hull, solid_array *solids, fram_error *error)
{
    return build_with(ctx, f, NULL, NULL, hull, solids, error);
}

START_TEST(a_barge)
{
    context ctx;
    context_init(&ctx);
    folder f = make_folder("    file_scale: 0.001\n    freeboard: 2\n", half_box);
    vessel_model hull = {0};
    solid_array solids = {0};
    fram_error error = {0};
    assert_ok(build(&ctx, &f, &hull, &solids, &error), error);
    const hull_particulars *p = &hull.particulars;
    const double found[] = {p->length, p->beam, p->draught, p->freeboard, p->midships}, expected[] = {40, 10, 3, 2, 20};
    assert_array_absolute(found, expected, 5, 1e-12);
    assert_relative(hull.displaced_mass, 1025 * 1200, 1e-13);
    assert_vec3_close(hull.centre, vec3_make(20, 0, 0), 1e-12);
    const solid *s = &solids.data[hull.solid];
    ck_assert_int_eq(s->pieces.count, 1);
    box3 box = mesh_bounds(&s->surface);
    assert_vec3_close(box.lo, vec3_make(-20, -5, -3), 1e-12);
    assert_vec3_close(box.hi, vec3_make(20, 5, 2), 1e-12);
    /* Zones are about the middle of the waterline, not about x = 0. */
    hull_zones zones = hull_zones_of(p);
    ck_assert_int_eq(hull_zone_at(&zones, vec3_make(39, 0, 0)), ZONE_BOW);
    ck_assert_int_eq(hull_zone_at(&zones, vec3_make(1, 0, 0)), ZONE_STERN);
    ck_assert_int_eq(hull_zone_at(&zones, vec3_make(20, 0, 0)), ZONE_MIDBODY);
    solid_array_free(&ctx, &solids);
    remove_folder(&f);
}
END_TEST

/* A hull that was read before is not read again, wherever its centre of gravity is by then: the file may be another
   one.  What comes of it is the same to the bit.  With other keys of the file it is read. */
START_TEST(hulls_that_were_read_are_kept)
{
    context ctx;
    context_init(&ctx);
    folder f = make_folder("    file_scale: 0.001\n    freeboard: 2\n", half_box);
    hull_store store = {.next = 0};
    vessel_model hull[3] = {{0}};
    solid_array solids = {0};
    fram_error error = {0};
    assert_ok(build(&ctx, &f, &hull[0], &solids, &error), error);
    assert_ok(build_with(&ctx, &f, "vessel.centre_of_gravity_x=19", &store, &hull[1], &solids, &error), error);
    scratch_text(f.mesh, "no hull any more\n");
    assert_ok(build_with(&ctx, &f, NULL, &store, &hull[2], &solids, &error), error);
    ck_assert_int_eq(store.hulls.count, 1);
    assert_bits(hull[2].displaced_mass, hull[0].displaced_mass);
    assert_absolute(hull[0].centre.x - hull[1].centre.x, 1, 1e-12);
    const solid *fresh = &solids.data[hull[0].solid], *again = &solids.data[hull[2].solid];
    ck_assert_int_eq(again->surface.vertex.count, fresh->surface.vertex.count);
    ck_assert_int_eq(again->surface.face.count, fresh->surface.face.count);
    for (int32_t i = 0; i < fresh->surface.vertex.count; i++) {
        assert_bits(again->surface.vertex.data[i].x, fresh->surface.vertex.data[i].x);
        assert_bits(again->surface.vertex.data[i].y, fresh->surface.vertex.data[i].y);
        assert_bits(again->surface.vertex.data[i].z, fresh->surface.vertex.data[i].z);
    }
    ck_assert_int_eq(again->pieces.count, fresh->pieces.count);
    assert_bits(polyhedron_volume(&again->pieces.data[0]), polyhedron_volume(&fresh->pieces.data[0]));
    assert_fails(build_with(&ctx, &f, "vessel.hull.file_scale=0.002", &store, &hull[2], &solids, &error), error,
                 FRAM_ERROR_INPUT, "");
    hull_store_free(&ctx, &store);
    solid_array_free(&ctx, &solids);
    remove_folder(&f);
}
END_TEST

START_TEST(mistakes)
{
    context ctx;
    context_init(&ctx);
    static const char dry[] = "d\n1 9.81\n0 0\n4\n0 0 1 0 1 1 1 0 1 1 0 1\n0 0 1 1 0 1 0 0 2 0 0 2\n"
                              "0 0 1 0 0 2 0 1 1 0 1 1\n1 0 1 0 1 1 0 0 2 0 0 2\n";
    const struct {
        const char *keys, *mesh, *file, *key, *message;
        int line;
    } cases[] = {
        {"", "a barge\n1 9.81\n0 1\nfour\n", "barge.gdf", "", "NPAN", 4},
        {"", dry, "barge.gdf", "mesh", "z = 0", 0},
        {"    most_pieces: 0\n", half_box, "scene.yaml", "vessel.hull.most_pieces", "from 1 to 4096", 5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        folder f = make_folder(cases[i].keys, cases[i].mesh);
        vessel_model hull = {0};
        solid_array solids = {0};
        fram_error error = {0};
        assert_fails(build(&ctx, &f, &hull, &solids, &error), error, FRAM_ERROR_INPUT, cases[i].message);
        ck_assert_ptr_nonnull(strstr(error.file, cases[i].file));
        ck_assert_str_eq(error.key, cases[i].key);
        ck_assert_int_eq(error.line, cases[i].line);
        solid_array_free(&ctx, &solids);
        remove_folder(&f);
    }
}
END_TEST

/* Topsides of a file that ends at the water are 4 m high where no freeboard is given; one that ends above it is decked
   there, and a freeboard that is given is added. */
START_TEST(freeboards)
{
    static const char high[] = "a barge\n1 9.81\n0 1\n4\n"
                               "0 0 -3000  0 5000 -3000  40000 5000 -3000  40000 0 -3000\n"
                               "40000 0 -3000  40000 5000 -3000  40000 5000 1500  40000 0 1500\n"
                               "40000 5000 -3000  0 5000 -3000  0 5000 1500  40000 5000 1500\n"
                               "0 5000 -3000  0 0 -3000  0 0 1500  0 5000 1500\n";
    const struct {
        const char *mesh, *keys;
        double deck;
    } cases[] = {{half_box, "", 4}, {half_box, "    freeboard: 4\n", 4}, {half_box, "    freeboard: 2\n", 2},
                 {high, "", 1.5},   {high, "    repair: true\n", 1.5},   {high, "    freeboard: 4\n", 5.5}};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char keys[80];
        snprintf(keys, sizeof keys, "    file_scale: 0.001\n%s", cases[i].keys);
        folder f = make_folder(keys, cases[i].mesh);
        vessel_model hull = {0};
        solid_array solids = {0};
        fram_error error = {0};
        assert_ok(build(&ctx, &f, &hull, &solids, &error), error);
        assert_absolute(hull.particulars.freeboard, cases[i].deck, 1e-12);
        assert_relative(hull.displaced_mass, 1025 * 1200, 1e-12);
        solid_array_free(&ctx, &solids);
        remove_folder(&f);
    }
}
END_TEST

/* What is left to Fram goes with run.scale, as other lengths do, of a hull that was read for another scale too. */
START_TEST(freeboards_go_with_the_scale)
{
    static const char *const scale[] = {"run.scale=30", "run.scale=3", "run.scale=60"};
    static const double deck[] = {4, 0.4, 8};
    context ctx;
    context_init(&ctx);
    folder f = make_folder("    file_scale: 0.001\n", half_box);
    hull_store store = {.next = 0};
    solid_array solids = {0};
    for (int i = 0; i < 3; i++) {
        vessel_model hull = {0};
        fram_error error = {0};
        assert_ok(build_with(&ctx, &f, scale[i], &store, &hull, &solids, &error), error);
        assert_absolute(hull.particulars.freeboard, deck[i], 1e-12);
    }
    scratch_text(f.scene,
                 "vessel: {hull: {form: icebreaker, length: 2.5, beam: 0.6, draught: 0.2, flare_angle_deg: 20}}\n");
    vessel_model tank = {0};
    fram_error error = {0};
    assert_ok(build_with(&ctx, &f, "run.scale=1", NULL, &tank, &solids, &error), error);
    assert_absolute(tank.particulars.freeboard, 4.0 / 30, 1e-15);
    hull_store_free(&ctx, &store);
    solid_array_free(&ctx, &solids);
    remove_folder(&f);
}
END_TEST

/* Keys of particulars that do not go together are named in full, with the place in the scenario. */
START_TEST(particulars)
{
    context ctx;
    context_init(&ctx);
    const struct {
        const char *text, *key;
        int line;
    } cases[] = {
        {"vessel:\n  hull:\n    length: 100\n    flare_angle_deg: 70\n", "vessel.hull.flare_angle_deg", 4},
        {"vessel:\n  hull:\n    block_coefficient: 0.95\n", "vessel.hull.block_coefficient", 3},
        {"vessel:\n  hull:\n    entrance_angle_deg: 6\n", "vessel.hull.entrance_angle_deg", 3},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scenario s;
        solid_array solids = {0};
        vessel_model hull = {0};
        fram_error error = {0};
        assert_ok(scenario_parse(&ctx, "s.yaml", cases[i].text, strlen(cases[i].text), NULL, &s, &error), error);
        const vessel_entry entry = scenario_vessel_entry(&s, 0);
        ck_assert_int_eq(build_hull(&ctx, &s, &entry, NULL, &solids, &hull, &error), FRAM_ERROR_INPUT);
        ck_assert_str_eq(error.key, cases[i].key);
        ck_assert_str_eq(error.file, "s.yaml");
        ck_assert_int_eq(error.line, cases[i].line);
        solid_array_free(&ctx, &solids);
        scenario_free(&ctx, &s);
    }
}
END_TEST

/* Radii that are not given are those of a body, of a barge that is wider than long too. */
START_TEST(radii_of_gyration)
{
    const scenario_vessel v = {.gyration_roll = NAN, .gyration_pitch = NAN, .gyration_yaw = NAN};
    const double beams[] = {10, 20, 30, 90};
    for (size_t i = 0; i < sizeof beams / sizeof *beams; i++) {
        const hull_particulars p = {.length = 20, .beam = beams[i]};
        vec3 k = build_gyration(&v, &p);
        ck_assert(k.x * k.x <= (k.y * k.y + k.z * k.z) * (1 + 1e-12));
        ck_assert(k.y * k.y <= (k.x * k.x + k.z * k.z) * (1 + 1e-12));
        ck_assert(k.z * k.z <= (k.x * k.x + k.y * k.y) * (1 + 1e-12));
        ck_assert(k.y == 5 && (beams[i] > 20 || (k.x == 0.35 * beams[i] && k.z == 5)));
    }
    /* Beside one that is given too. */
    const hull_particulars wide = {.length = 20, .beam = 30};
    for (int i = 1; i < 8; i++) {
        const scenario_vessel given = {.gyration_roll = i, .gyration_pitch = NAN, .gyration_yaw = NAN};
        vec3 k = build_gyration(&given, &wide);
        ck_assert(k.x == i && k.z <= 7.5 && k.z * k.z <= (k.x * k.x + k.y * k.y) * (1 + 1e-12));
    }
}
END_TEST

/* All that are given are those of the body. */
START_TEST(radii_that_are_given)
{
    const scenario_vessel v = {.gyration_roll = 8, .gyration_pitch = 27, .gyration_yaw = 29};
    const hull_particulars p = {.length = 100, .beam = 20};
    assert_vec3_close(build_gyration(&v, &p), vec3_make(8, 27, 29), 0);
}
END_TEST

/* A file that is refused as it is: without its bottom it is mended on request, with a crack it is sealed up to the
   width that is given. */
START_TEST(files_are_mended_as_their_keys_say)
{
    static const char open_bottom[] = "a barge\n1 9.81\n0 1\n3\n"
                                      "40000 0 -3000  40000 5000 -3000  40000 5000 0  40000 0 0\n"
                                      "40000 5000 -3000  0 5000 -3000  0 5000 0  40000 5000 0\n"
                                      "0 5000 -3000  0 0 -3000  0 0 0  0 5000 0\n";
    static const char cracked[] = "a barge\n1 9.81\n0 1\n4\n"
                                  "0 0 -3000  0 4950 -3000  40000 4950 -3000  40000 0 -3000\n"
                                  "40000 0 -3000  40000 5000 -3000  40000 5000 0  40000 0 0\n"
                                  "40000 5000 -3000  0 5000 -3000  0 5000 0  40000 5000 0\n"
                                  "0 5000 -3000  0 0 -3000  0 0 0  0 5000 0\n";
    static const struct {
        const char *mesh, *set;
    } cases[] = {{open_bottom, "vessel.hull.repair=true"}, {cracked, "vessel.hull.seal_width=0.1"}};
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 2; i++) {
        folder f = make_folder("    file_scale: 0.001\n    freeboard: 2\n", cases[i].mesh);
        vessel_model hull = {0};
        solid_array solids = {0};
        fram_error error = {0};
        ck_assert_int_eq(build(&ctx, &f, &hull, &solids, &error), FRAM_ERROR_INPUT);
        assert_ok(build_with(&ctx, &f, cases[i].set, NULL, &hull, &solids, &error), error);
        assert_relative(hull.displaced_mass, 1025 * 1200, 0.02);
        solid_array_free(&ctx, &solids);
        remove_folder(&f);
    }
}
END_TEST

START_TEST(a_ship_has_the_bilge_that_is_given)
{
    static const char text[] = "vessel:\n  hull: {form: ship, length: 120, beam: 24, draught: 8, bilge_radius: 2.5}\n";
    context ctx;
    context_init(&ctx);
    scenario s;
    solid_array solids = {0};
    vessel_model hull = {0};
    fram_error error = {0};
    assert_ok(scenario_parse(&ctx, "s.yaml", text, strlen(text), NULL, &s, &error), error);
    const vessel_entry entry = scenario_vessel_entry(&s, 0);
    assert_ok(build_hull(&ctx, &s, &entry, NULL, &solids, &hull, &error), error);
    assert_absolute(hull.particulars.bilge_radius, 2.5, 0);
    solid_array_free(&ctx, &solids);
    scenario_free(&ctx, &s);
}
END_TEST

TEST_MAIN("build_hull", a_barge, hulls_that_were_read_are_kept, mistakes, freeboards, freeboards_go_with_the_scale,
          particulars, radii_of_gyration, radii_that_are_given, files_are_mended_as_their_keys_say,
          a_ship_has_the_bilge_that_is_given)
