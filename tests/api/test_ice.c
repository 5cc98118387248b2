/* Breaking ice through the public interface. */
#include "fram/ice.h"
#include "model/scenario.h"
#include "testing.h"

START_TEST(wedge)
{
    fram_ice_wedge_result r;
    fram_error e = {0};
    assert_ok(fram_ice_wedge(0.1, &r, &e), e);
    assert_relative(r.capacity_C, 1.255469567682, 1e-11);
    assert_relative(r.x_max, 0.5114858883249, 1e-11);
    assert_relative(r.eta0, 2.067333645437, 1e-11);
    assert_fails(fram_ice_wedge(0, &r, &e), e, FRAM_ERROR_INPUT, "0.001 to 3");
    assert_fails(fram_ice_wedge((double)NAN, &r, &e), e, FRAM_ERROR_INPUT, "0.001 to 3");
    ck_assert_str_eq(e.key, "a_over_l");
}
END_TEST

START_TEST(sheet)
{
    fram_ice_sheet_result r;
    fram_error e = {0};
    assert_ok(fram_ice_sheet(0.1, 0.3, &r, &e), e);
    assert_relative(r.sigma_h2_over_P, 3.95955, 0.01);
    assert_absolute(r.exact_sigma_h2_over_P, 3.95955, 1e-5);
    assert_bits(r.sigma_h2_over_P, r.closed_form_sigma_h2_over_P);
    assert_ok(fram_ice_sheet(2, 0.3, &r, &e), e);
    assert_relative(r.sigma_h2_over_P, r.exact_sigma_h2_over_P, 1e-4);
    assert_fails(fram_ice_sheet(0.1, 0.7, &r, &e), e, FRAM_ERROR_INPUT, "0 to 0.5");
    ck_assert_str_eq(e.key, "poisson_ratio");
    assert_fails(fram_ice_sheet(4, 0.3, &r, &e), e, FRAM_ERROR_INPUT, "a number");
}
END_TEST

/* The state at the break of docs/oracles.md, section 1. */
START_TEST(load_on_an_edge)
{
    fram_ice_edge load;
    fram_ice_breaking b;
    fram_error e = {0};
    fram_ice_edge_default(&load);
    load.force = 311.743e3;
    load.contact_area = 0.155871;
    load.thick_plate_radius = false;
    assert_ok(fram_ice_break(&load, &b, &e), e);
    assert_absolute(b.characteristic_length, 14.6079, 5e-5);
    assert_relative(b.wedge_stress, 0.5e6, 1e-5);
    assert_relative(b.wedge_capacity, 311.743e3, 1e-5);
    assert_relative(b.breaking_radius, 4.14196, 2e-6);
    assert_relative(b.wedge_radius, 0.299987, 1e-5);
    assert_relative(b.crushing_force, 311.742e3, 1e-12);
    ck_assert(b.radial_stress > b.wedge_stress && b.radial_capacity < b.wedge_capacity);
    load.thick_plate_radius = true;
    double thin = b.wedge_radius;
    assert_ok(fram_ice_break(&load, &b, &e), e);
    ck_assert(b.wedge_radius > thin);
}
END_TEST

START_TEST(wrong_loads)
{
    fram_ice_edge load;
    fram_ice_breaking b;
    fram_error e = {0};
    fram_ice_edge_default(&load);
    load.thickness = 0;
    assert_fails(fram_ice_break(&load, &b, &e), e, FRAM_ERROR_INPUT, "positive");
    ck_assert_str_eq(e.key, "thickness");
    fram_ice_edge_default(&load);
    load.contact_area = -1;
    assert_fails(fram_ice_break(&load, &b, &e), e, FRAM_ERROR_INPUT, "not below 0");
    fram_ice_edge_default(&load);
    load.wedges = 1;
    assert_fails(fram_ice_break(&load, &b, &e), e, FRAM_ERROR_INPUT, "2 to 32");
    load.size = 0;
    assert_fails(fram_ice_break(&load, &b, &e), e, FRAM_ERROR_USAGE, "default");
}
END_TEST

/* A corner carries in proportion to its angle, when the load stands on the same tip. */
START_TEST(corners)
{
    fram_ice_edge load;
    fram_ice_breaking b;
    fram_error e = {0};
    fram_ice_edge_default(&load);
    assert_ok(fram_ice_break(&load, &b, &e), e);
    double edge = b.wedge_capacity, pi = load.included_angle;
    for (int i = 1; i < 9; i++) {
        load.included_angle = i * pi / 6;
        assert_ok(fram_ice_break(&load, &b, &e), e);
        assert_relative(b.wedge_capacity, edge * i / 6, 1e-12);
    }
    load.included_angle = 7;
    assert_fails(fram_ice_break(&load, &b, &e), e, FRAM_ERROR_INPUT, "2 pi");
    ck_assert_str_eq(e.key, "included_angle");
    load.included_angle = 0;
    assert_fails(fram_ice_break(&load, &b, &e), e, FRAM_ERROR_INPUT, "positive");
    /* The wedges at the ends of a strip are as many whole ones. */
    load.included_angle = pi / 3;
    load.contact_width = 10;
    assert_ok(fram_ice_break(&load, &b, &e), e);
    assert_relative(b.wedge_capacity - b.strip_capacity, edge / 3, 1e-12);
}
END_TEST

/* Plates of 0, 2, 10, 20 and 50 m at 45 degrees, frictionless: the load at which the area that it crushes breaks off
   (docs/oracles.md, section 1). */
START_TEST(wide_contacts)
{
    static const double WIDTHS[] = {0, 2, 10, 20, 50}, LOADS[] = {311.743e3, 337e3, 437e3, 562e3, 937e3};
    for (int i = 0; i < 5; i++) {
        fram_ice_edge load;
        fram_ice_breaking b = {0};
        fram_error e = {0};
        fram_ice_edge_default(&load);
        load.thick_plate_radius = false;
        load.contact_width = WIDTHS[i];
        b.wedge_capacity = 300e3;
        for (int turn = 0; turn < 30; turn++) {
            load.contact_area = b.wedge_capacity / load.crushing_strength;
            assert_ok(fram_ice_break(&load, &b, &e), e);
        }
        assert_relative(b.wedge_capacity, LOADS[i], i ? 1.2e-3 : 1e-5);
        assert_relative(b.wedge_radius, 0.299987, 1e-5); /* the end wedges stand on what they would crush alone */
        assert_relative(b.strip_capacity, 0.5e6 / 6 * WIDTHS[i] / (0.455938127766 * b.characteristic_length), 1e-9);
        assert_absolute(b.strip_length, i ? 1.110720734540 * b.characteristic_length : 0, 1e-8);
        load.ice_length = 1;
        assert_ok(fram_ice_break(&load, &b, &e), e);
        assert_relative(b.strip_capacity, 0.5e6 / 6 * WIDTHS[i] * 27 / 4, 1e-5);
        load.force = b.wedge_capacity;
        assert_ok(fram_ice_break(&load, &b, &e), e);
        assert_relative(b.wedge_stress, load.flexural_strength, 1e-12);
    }
}
END_TEST

/* Along an edge loaded over 2 c no stress is left beyond c/l of about 3.5, where the table of half discs ends: the
   plate's integral is 0.1 at 3 and 0.025 at 4. */
START_TEST(no_radial_crack_under_very_wide_contacts)
{
    fram_ice_edge load;
    fram_ice_breaking b;
    fram_error e = {0};
    fram_ice_edge_default(&load);
    load.force = 1e6;
    load.contact_area = 5;
    load.thickness = 0.5;
    load.contact_width = 50;
    assert_ok(fram_ice_break(&load, &b, &e), e);
    double l = b.characteristic_length, most = 3 / 0.85 * l;
    load.contact_width = 6 * l;
    assert_ok(fram_ice_break(&load, &b, &e), e);
    assert_relative(b.radial_capacity, 0.5e6 * 0.25 / 0.104, 0.08);
    load.contact_width = 2 * 0.999 * most;
    assert_ok(fram_ice_break(&load, &b, &e), e);
    ck_assert(b.radial_stress > 0 && b.radial_capacity > b.wedge_capacity && b.radial_capacity < 3e6);
    for (int k = 0; k < 2; k++) {
        load.contact_width = k ? 400 : 2 * 1.001 * most;
        assert_ok(fram_ice_break(&load, &b, &e), e);
        ck_assert(b.radial_stress == 0 && isinf(b.radial_capacity) && b.wedge_capacity > 0 && b.wedge_stress > 0);
    }
}
END_TEST

START_TEST(splitting)
{
    fram_ice_floe floe;
    fram_ice_splitting s;
    fram_error e = {0};
    scenario usual;
    scenario_defaults(&usual, scenario_default_scale());
    fram_ice_floe_default(&floe);
    ck_assert(floe.thickness == usual.ice.thickness && floe.toughness == usual.ice.fracture.toughness);
    assert_ok(fram_ice_split(&floe, &s, &e), e);
    assert_absolute(s.splitting_load, 198e3, 500);
    double middle = s.splitting_load;
    floe.place = 12.5;
    assert_ok(fram_ice_split(&floe, &s, &e), e);
    assert_relative(s.smaller_side, 12.5, 1e-15);
    assert_relative(s.larger_side, 37.5, 1e-15);
    ck_assert(s.splitting_load < 0.85 * middle && s.splitting_load > 0.75 * middle);
    double beside = s.splitting_load;
    floe.place = -12.5;
    assert_ok(fram_ice_split(&floe, &s, &e), e);
    assert_bits(s.splitting_load, beside);
    floe.place = 25;
    assert_fails(fram_ice_split(&floe, &s, &e), e, FRAM_ERROR_INPUT, "half the width");
    ck_assert_str_eq(e.key, "place");
    fram_ice_floe_default(&floe);
    floe.toughness = (double)NAN;
    assert_fails(fram_ice_split(&floe, &s, &e), e, FRAM_ERROR_INPUT, "positive");
    ck_assert_str_eq(e.key, "toughness");
    floe.size = 0;
    assert_fails(fram_ice_split(&floe, &s, &e), e, FRAM_ERROR_USAGE, "default");
}
END_TEST

TEST_MAIN("api_ice", corners, wide_contacts, no_radial_crack_under_very_wide_contacts, splitting, wedge, sheet,
          load_on_an_edge, wrong_loads)
