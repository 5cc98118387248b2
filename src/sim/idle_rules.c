#include "sim/idle_rules.h"

#include "sim/ice_kinds.h"
#include "sim/sanity_parts.h"

#include <string.h>

static bool is_no_sheet(const idle_question *q) { return q->s->ice.source != ICE_LEVEL; }
static bool is_no_file(const idle_question *q) { return q->s->ice.source != ICE_FILE; }
static bool is_no_list(const idle_question *q) { return q->s->ice.source != ICE_FLOES; }
static bool is_no_voronoi(const idle_question *q) { return q->s->ice.source != ICE_VORONOI; }
/* Whether the length after which a field of a file comes again is found by the mean floe. */
static bool asks_for_mean_floe(const idle_question *q)
{
    const scenario_domain *d = &q->s->domain;
    return !is_no_file(q) && d->boundary == DOMAIN_FEEDING && (is_automatic(d->tile_x) || is_automatic(d->tile_y));
}
static bool is_of_cells(const idle_question *q)
{
    return q->s->ice.populations.count > 0 || (is_no_voronoi(q) && !asks_for_mean_floe(q));
}
static bool is_no_field(const idle_question *q) { return !scenario_ice_is_field(&q->s->ice); }
static bool draws_nothing(const idle_question *q) { return !scenario_ice_is_drawn(&q->s->ice); }
static bool is_unbreakable(const idle_question *q) { return !q->s->ice.breakable; }
static bool has_no_breakable(const idle_question *q) { return !ice_may_break(&q->s->ice); }
static bool has_only_breakable(const idle_question *q) { return ice_all_breaks(&q->s->ice); }
static bool cuts_top_plane(const idle_question *q) { return q->s->ice.top_plane_area; }
static bool has_rigid_edges(const idle_question *q) { return !q->s->ice.fracture.edge_compliance; }
static bool bends_no_edge(const idle_question *q) { return !q->s->ice.fracture.edge_elastic; }
/* All ice floats freely. */
static bool holds_no_ice(const idle_question *q)
{
    const scenario_ice *i = &q->s->ice;
    bool held = i->source == ICE_LEVEL;
    for (int32_t k = 0; i->source == ICE_FLOES && k < i->floes.count; k++)
        held = held || i->floes.data[k].fixed;
    return !held;
}
/* Rafting asks whether floes bend out of the way, a sheet how large its tiles are. */
static bool never_bends(const idle_question *q) { return is_unbreakable(q) && q->s->ice.rafting_edge_angle_deg == 0; }
static bool is_rigid(const idle_question *q) { return never_bends(q) && is_no_sheet(q); }
static bool splits_not_by_length(const idle_question *q) { return q->s->ice.fracture.splitting != SPLITTING_LENGTH; }
static bool splits_not_by_load(const idle_question *q) { return q->s->ice.fracture.splitting != SPLITTING_TOUGHNESS; }
static bool splits_not(const idle_question *q) { return q->s->ice.fracture.splitting == SPLITTING_NONE; }
static bool is_even(const idle_question *q)
{
    return q->s->ice.strength.flexural_variation == 0 && q->s->ice.strength.crushing_variation == 0;
}
static bool is_awake(const idle_question *q) { return q->s->ice.sleep_speed == 0; }
static bool never_yields(const idle_question *q) { return !q->s->ice.cap_ice_ice; }

static bool is_unfed(const idle_question *q) { return q->s->domain.boundary != DOMAIN_FEEDING; }
static bool is_no_endless_field(const idle_question *q) { return is_unfed(q) || !is_no_sheet(q); }
static bool has_own_drift(const idle_question *q) { return scenario_drift(q->s).own; }
static bool has_no_drift(const idle_question *q) { return !has_own_drift(q) || scenario_drift(q->s).file[0]; }
static bool has_no_walls(const idle_question *q) { return q->s->domain.boundary != DOMAIN_WALLS; }

static bool is_alone(const idle_question *q) { return scenario_vessel_count(q->s) < 2; }
static bool is_ice_alone(const idle_question *q) { return scenario_vessel_count(q->s) == 0; }
static bool clears_nothing(const idle_question *q) { return is_ice_alone(q) || !is_no_list(q); }
static bool meets_nothing(const idle_question *q) { return is_alone(q) && has_no_walls(q); }

static bool has_no_diameter(const idle_question *q)
{
    return q->population->size != SIZE_CONSTANT && q->population->size != SIZE_LOGNORMAL;
}
static bool has_no_range(const idle_question *q)
{
    return q->population->size == SIZE_CONSTANT || q->population->size == SIZE_HISTOGRAM;
}
static bool is_no_lognormal(const idle_question *q) { return q->population->size != SIZE_LOGNORMAL; }
static bool is_no_power(const idle_question *q) { return q->population->size != SIZE_POWER; }
static bool has_templates(const idle_question *q) { return q->population->shape == POPULATION_TEMPLATES; }
static bool is_voronoi(const idle_question *q) { return !is_no_voronoi(q); }
static bool is_rectangle(const idle_question *q) { return q->floe->shape == FLOE_RECTANGLE; }
static bool is_regular(const idle_question *q) { return !is_rectangle(q); }
static bool is_fixed(const idle_question *q) { return q->floe->fixed; }

static bool is_dry(const idle_question *q) { return !q->s->environment.water; }
/* The current is the drift of an endless field that has none of its own. */
static bool is_dry_and_still(const idle_question *q) { return is_dry(q) && (is_unfed(q) || has_own_drift(q)); }
static bool cuts_no_floe(const idle_question *q) { return has_no_breakable(q) && is_unfed(q); }
static bool keeps_packed_floes(const idle_question *q) { return q->s->ice.source == ICE_PACKED && cuts_no_floe(q); }
static bool keeps_listed_floes(const idle_question *q) { return !is_no_list(q) && cuts_no_floe(q); }
static bool has_no_current(const idle_question *q) { return q->s->environment.current_speed == 0; }
static bool has_no_wind(const idle_question *q) { return q->s->environment.wind_speed == 0; }
static bool wets_no_hull(const idle_question *q)
{
    bool wet = false;
    for (int32_t i = 0; i < scenario_vessel_count(q->s); i++)
        wet = wet || scenario_vessel_entry(q->s, i).keys->mode != VESSEL_PRESCRIBED;
    return !wet;
}

static bool is_accurate(const idle_question *q) { return q->s->run.solver.kind == SOLVER_ACCURATE; }
static bool corrects_velocities(const idle_question *q) { return q->s->run.solver.baumgarte; }
static bool is_sequential(const idle_question *q) { return q->s->run.solver.kind == SOLVER_SEQUENTIAL; }
static bool is_not_accurate(const idle_question *q) { return q->s->run.solver.kind != SOLVER_ACCURATE; }

static bool is_own_hull(const idle_question *q) { return sanity_own_hull(q->v); }
static bool is_mesh(const idle_question *q) { return !sanity_own_hull(q->v); }
static bool is_no_ship(const idle_question *q) { return q->v->hull.form != HULL_SHIP; }
static bool is_box(const idle_question *q) { return q->v->hull.form == HULL_BOX; }
static bool is_cone(const idle_question *q) { return q->v->hull.form == HULL_CONE; }
static bool has_path(const idle_question *q) { return q->v->path.count > 0; }
static bool is_free(const idle_question *q) { return q->v->mode == VESSEL_FREE; }
static bool is_moved(const idle_question *q) { return !is_free(q); }
static bool is_prescribed(const idle_question *q) { return q->v->mode == VESSEL_PRESCRIBED; }
static bool has_no_way(const idle_question *q) { return q->v->speed == 0; }
static bool has_no_lines(const idle_question *q) { return q->v->mooring.lines.count == 0; }
static bool is_hung(const idle_question *q) { return q->line->kind == LINE_CATENARY; }
static bool is_not_hung(const idle_question *q) { return !is_hung(q); }
static bool is_by_table(const idle_question *q) { return q->line->kind == LINE_TABLE; }
static bool has_length(const idle_question *q) { return !is_automatic(q->line->length); }
static bool is_one_line(const idle_question *q) { return q->line->count == 1; }
static bool is_tunnel(const idle_question *q) { return q->thruster->kind == THRUSTER_TUNNEL; }
static bool is_azimuth(const idle_question *q) { return q->thruster->kind == THRUSTER_AZIMUTH; }
static bool is_no_azimuth(const idle_question *q) { return !is_azimuth(q); }
static bool is_no_main(const idle_question *q) { return q->thruster->kind != THRUSTER_MAIN; }
static bool is_not_positioned(const idle_question *q) { return !q->v->positioning.active; }
static bool is_positioned(const idle_question *q) { return !is_not_positioned(q); }
/* The place is left to lines, and offsets count from where those hold it. */
static bool holds_heading_alone(const idle_question *q)
{
    return is_free(q) && q->v->positioning.control == CONTROL_HEADING;
}
static bool is_any(const idle_question *q) { return q->v != NULL; }
static bool has_points(const idle_question *q) { return is_free(q) && q->v->positioning.waypoints.count > 0; }
static bool is_passive(const idle_question *q) { return q->v->positioning.observer != OBSERVER_KALMAN; }
static bool is_kalman(const idle_question *q) { return !is_passive(q); }
static bool feeds_nothing(const idle_question *q) { return q->v->positioning.feed_forward == FEED_NONE; }
static bool feeds_no_measured(const idle_question *q) { return q->v->positioning.feed_forward != FEED_MEASURED; }
static bool keeps_heading(const idle_question *q) { return q->v->positioning.heading != HEADING_VANING; }
static bool drives_not(const idle_question *q) { return !vessel_drives_itself(q->v); }
static bool has_no_pattern(const idle_question *q) { return q->v->propulsion.pattern.kind == PATTERN_NONE; }
static bool goes_ahead(const idle_question *q) { return q->v->propulsion.pattern.kind == PATTERN_AHEAD; }
static bool has_period(const idle_question *q)
{
    return !has_no_pattern(q) && !is_automatic(q->v->propulsion.pattern.period);
}
static bool watches_not(const idle_question *q) { return is_automatic(q->v->approach.limit); }
static bool has_no_wash(const idle_question *q) { return !q->v->wash.active; }
static bool has_one_propeller(const idle_question *q) { return q->v->propulsion.propellers == 1; }
static bool has_no_table(const scenario_flow *c) { return c->table.count == 0 && !c->table_file[0]; }
static bool has_no_current_table(const idle_question *q) { return has_no_table(&q->v->current_coefficients); }
static bool has_no_wind_table(const idle_question *q) { return has_no_table(&q->v->wind_coefficients); }
static bool has_drift_file(const idle_question *q) { return q->s->domain.drift_file[0] != '\0'; }
static bool has_current_file(const idle_question *q) { return q->s->environment.current_file[0] != '\0'; }
static bool has_wind_file(const idle_question *q) { return q->s->environment.wind_file[0] != '\0'; }
static bool is_no_estimate(const idle_question *q) { return q->v->hydrodynamics.source != HYDRODYNAMICS_ESTIMATE; }
static bool is_not_given(const idle_question *q) { return q->v->hydrodynamics.source != HYDRODYNAMICS_GIVEN; }

static bool slides_freely(const idle_question *q) { return q->s->ice.friction.ice_hull_kinetic == 0; }
static bool melts_nothing(const idle_question *q)
{
    return !q->s->ice.fracture.edge_melts || idle_rule_of("ice.fracture.edge_melts", q);
}

static const char OWN_FORM[] = "hull.form is not file", MESH[] = "with hull.form file the mesh has its own";
static const char UNBREAKABLE[] = "ice.breakable is false";
static const char FREE_ICE[] = "there is neither level ice nor a fixed floe";
static const char CELLS[] = "with ice.source voronoi the cells are the shapes";
static const char NO_WALLS[] = "domain.boundary is not walls";
static const char ALONE[] = "there is no other vessel", NO_WASH[] = "wash.active is false";
static const char TOLD_HULLS[] = "there is no vessel of mode towed or free";
static const char DRY[] = "environment.water is false", PRESCRIBED[] = "mode is prescribed";
static const char HEADING[] = "positioning.control heading leaves the place to lines";
static const char BOX[] = "hull.form is box", CONE[] = "hull.form is cone";
static const char TUNNEL[] = "kind is tunnel", NO_AZIMUTH[] = "kind is not azimuth";
static const char PATH[] = "the vessel goes along its path", NO_VANING[] = "positioning.heading is not vaning";

static const idle_rule rules[] = {
    {"run.solver.iterations", is_accurate, "run.solver.kind is accurate"},
    {"run.solver.position_iterations", corrects_velocities, "run.solver.baumgarte is true"},
    {"run.solver.tolerance", is_sequential, "run.solver.kind is sequential"},
    {"run.solver.most_iterations", is_not_accurate, "run.solver.kind is not accurate"},
    {"ice.level.", is_no_sheet, "ice.source is not level"},
    {"ice.file_coordinates", is_no_file, "ice.source is not file"},
    {"ice.file_scale", is_no_file, "ice.source is not file"},
    {"ice.file_x", is_no_file, "ice.source is not file"},
    {"ice.file_y", is_no_file, "ice.source is not file"},
    {"ice.file_centre", is_no_file, "ice.source is not file"},
    {"ice.simplify", is_no_file, "ice.source is not file"},
    {"ice.bad_rings", is_no_file, "ice.source is not file"},
    {"ice.concentration", draws_nothing, "no floes are drawn (ice.source voronoi or packed, or ice.populations)"},
    {"ice.mean_floe_area", is_of_cells, "floes are not cells of ice.source voronoi without populations"},
    {"ice.size_deviation", is_no_voronoi, "ice.source is not voronoi"},
    {"ice.roundness", is_no_voronoi, "ice.source is not voronoi"},
    {"ice.smallest_floe_area", keeps_packed_floes, "packed floes are made as drawn, and none may break"},
    {"ice.smallest_floe_area", keeps_listed_floes, "listed floes are made as given, and none may break"},
    {"ice.open_water", is_no_field, "ice.source is neither voronoi nor file nor packed"},
    {"ice.populations", is_no_field, "ice.source is neither voronoi nor file nor packed"},
    {"ice.floes", is_no_list, "ice.source is not floes"},
    {"ice.populations[].diameter", has_no_diameter, "size is neither constant nor lognormal"},
    {"ice.populations[].diameter_deviation", is_no_lognormal, "size is not lognormal"},
    {"ice.populations[].diameter_min", has_no_range, "size is neither uniform nor lognormal nor power"},
    {"ice.populations[].diameter_max", has_no_range, "size is neither uniform nor lognormal nor power"},
    {"ice.populations[].exponent", is_no_power, "size is not power"},
    {"ice.populations[].vertices_min", is_voronoi, CELLS},
    {"ice.populations[].vertices_max", is_voronoi, CELLS},
    {"ice.populations[].elongation", is_voronoi, CELLS},
    {"ice.populations[].vertices_min", has_templates, "shape is templates"},
    {"ice.populations[].vertices_max", has_templates, "shape is templates"},
    {"ice.populations[].elongation", has_templates, "shape is templates"},
    {"ice.populations[].breakable", is_unbreakable, UNBREAKABLE},
    {"ice.populations[].flexural_strength", never_bends, UNBREAKABLE},
    {"ice.populations[].flexural_deviation", never_bends, UNBREAKABLE},
    {"ice.floes[].sides", is_rectangle, "shape is rectangle"},
    {"ice.floes[].radius", is_rectangle, "shape is rectangle"},
    {"ice.floes[].length", is_regular, "shape is regular"},
    {"ice.floes[].width", is_regular, "shape is regular"},
    {"ice.floes[].velocity_", is_fixed, "fixed is true"},
    {"ice.floes[].spin", is_fixed, "fixed is true"},
    {"ice.keep_out_margin", clears_nothing, "no field is laid round a vessel"},
    {"ice.flexural_strength", never_bends, UNBREAKABLE},
    {"ice.elastic_modulus", is_rigid, UNBREAKABLE},
    {"ice.poisson_ratio", is_rigid, UNBREAKABLE},
    {"ice.strength.flexural_variation", never_bends, UNBREAKABLE},
    {"ice.cap_ice_wall", has_no_walls, NO_WALLS},
    {"ice.friction.ice_wall_static", has_no_walls, NO_WALLS},
    {"ice.friction.ice_wall_kinetic", has_no_walls, NO_WALLS},
    {"ice.friction.hull_wall_static", has_no_walls, NO_WALLS},
    {"ice.friction.hull_wall_kinetic", has_no_walls, NO_WALLS},
    {"ice.friction.hull_hull_static", is_alone, ALONE},
    {"ice.friction.hull_hull_kinetic", is_alone, ALONE},
    {"ice.friction.ice_hull_static", is_ice_alone, "there is no vessel"},
    {"ice.friction.ice_hull_kinetic", is_ice_alone, "there is no vessel"},
    {"ice.strength.correlation_length", is_even, "neither strength varies (ice.strength)"},
    {"ice.strength.common", is_even, "neither strength varies (ice.strength)"},
    {"ice.ridging_resistance", never_yields, "ice.cap_ice_ice is false"},
    {"ice.rafting_edge_angle_deg", never_yields, "ice.cap_ice_ice is false"},
    {"ice.sleep_time", is_awake, "ice.sleep_speed is 0: nothing sleeps"},
    {"ice.fracture.", is_unbreakable, UNBREAKABLE},
    {"ice.fracture.", has_no_breakable, "no population of the ice is breakable"},
    {"ice.fracture.edge_", holds_no_ice, FREE_ICE},
    {"ice.fracture.edge_", cuts_top_plane, "edges do not give with ice.top_plane_area"},
    {"ice.fracture.edge_compliance", has_rigid_edges, NULL},
    {"ice.fracture.edge_", has_rigid_edges, "ice.fracture.edge_compliance is false"},
    {"ice.fracture.edge_melts", bends_no_edge, "ice.fracture.edge_elastic is false"},
    {"ice.fracture.edge_melts", wets_no_hull, TOLD_HULLS}, /* nothing is bent under those that move as they are told */
    {"ice.fracture.edge_melts", slides_freely, "ice.friction.ice_hull_kinetic is 0"},
    {"ice.fracture.latent_heat", melts_nothing, "friction melts no edge (ice.fracture.edge_melts)"},
    {"ice.fracture.under_pieces", holds_no_ice, FREE_ICE},
    {"ice.crush_trims", holds_no_ice, FREE_ICE},
    {"ice.correct_unbreakable", has_only_breakable, "all ice may break (ice.breakable)"},
    {"ice.fracture.under_ice_contacts", never_yields, "ice.cap_ice_ice is false"},
    {"ice.fracture.splitting_factor", splits_not_by_length, "ice.fracture.splitting is not length"},
    {"ice.fracture.toughness", splits_not_by_load, "ice.fracture.splitting is not toughness"},
    {"ice.fracture.narrowness", splits_not, "ice.fracture.splitting is none"},
    {"domain.band", is_no_endless_field, "no field of floes is fed (domain.boundary feeding)"},
    {"domain.tile_x", is_no_endless_field, "no field of floes is fed (domain.boundary feeding)"},
    {"domain.tile_y", is_no_endless_field, "no field of floes is fed (domain.boundary feeding)"},
    {"domain.drift_direction_deg", has_drift_file, "domain.drift_file tells the drift"},
    {"domain.drift_direction_deg", has_no_drift, "there is no domain.drift_speed"},
    {"domain.wall_height", has_no_walls, NO_WALLS},
    {"domain.wall_thickness", has_no_walls, NO_WALLS},
    {"vessel.x", has_path, PATH},
    {"vessel.y", has_path, PATH},
    {"vessel.heading_deg", has_path, PATH},
    {"vessel.speed", has_path, PATH},
    {"vessel.course_deg", has_path, PATH},
    {"vessel.ramp", has_path, PATH},
    {"vessel.ramp", is_free, "mode is free"},
    {"vessel.course_deg", has_no_way, "speed is 0"},
    {"vessel.mass", is_prescribed, PRESCRIBED},
    {"vessel.gyration_roll", is_moved, "mode is not free"},
    {"vessel.gyration_pitch", is_moved, "mode is not free"},
    {"vessel.gyration_yaw", is_moved, "mode is not free"},
    {"vessel.fender_stiffness", meets_nothing, "there is neither another vessel nor a wall"},
    {"vessel.hydrodynamics.", is_prescribed, PRESCRIBED},
    {"vessel.hydrodynamics.", is_dry, DRY},
    {"vessel.current_coefficients.", is_prescribed, PRESCRIBED},
    {"vessel.current_coefficients.", is_dry, DRY},
    {"vessel.wind_coefficients.", is_prescribed, PRESCRIBED},
    {"vessel.wind_coefficients.", is_dry, DRY},
    {"vessel.hull.file_scale", is_own_hull, OWN_FORM},
    {"vessel.hull.seal_width", is_own_hull, OWN_FORM},
    {"vessel.hull.repair", is_own_hull, OWN_FORM},
    {"vessel.hull.piece_distance", is_own_hull, OWN_FORM},
    {"vessel.hull.most_pieces", is_own_hull, OWN_FORM},
    {"vessel.hull.length", is_mesh, MESH},
    {"vessel.hull.beam", is_mesh, MESH},
    {"vessel.hull.draught", is_mesh, MESH},
    {"vessel.hull.stem_angle_deg", is_mesh, MESH},
    {"vessel.hull.entrance_angle_deg", is_mesh, MESH},
    {"vessel.hull.flare_angle_deg", is_mesh, MESH},
    {"vessel.hull.stern_angle_deg", is_mesh, MESH},
    {"vessel.hull.parallel_midbody", is_mesh, MESH},
    {"vessel.hull.block_coefficient", is_mesh, MESH},
    {"vessel.hull.stem_angle_deg", is_box, BOX},
    {"vessel.hull.entrance_angle_deg", is_box, BOX},
    {"vessel.hull.flare_angle_deg", is_box, BOX},
    {"vessel.hull.stern_angle_deg", is_box, BOX},
    {"vessel.hull.parallel_midbody", is_box, BOX},
    {"vessel.hull.stem_angle_deg", is_cone, CONE},
    {"vessel.hull.entrance_angle_deg", is_cone, CONE},
    {"vessel.hull.stern_angle_deg", is_cone, CONE},
    {"vessel.hull.parallel_midbody", is_cone, CONE},
    {"vessel.hull.block_coefficient", is_cone, CONE},
    {"vessel.hull.bilge_radius", is_no_ship, "hull.form is not ship"},
    {"vessel.hull.transom", is_no_ship, "hull.form is not ship"},
    {"vessel.mooring.depth", has_no_lines, "there are no mooring.lines"},
    {"vessel.mooring.turret", has_no_lines, "there are no mooring.lines"},
    {"vessel.mooring.equilibrium", has_no_lines, "there are no mooring.lines"},
    {"vessel.mooring.lines[].weight", is_not_hung, "kind is not catenary"},
    {"vessel.mooring.lines[].stiffness", is_by_table, "kind is table"},
    {"vessel.mooring.lines[].length", is_by_table, "kind is table"},
    {"vessel.mooring.lines[].pretension", is_by_table, "kind is table"},
    {"vessel.mooring.lines[].pretension", has_length, "there is a length"},
    {"vessel.mooring.lines[].spacing_deg", is_one_line, "count is 1"},
    {"vessel.thrusters[].thrust_astern", is_azimuth, "kind is azimuth"},
    {"vessel.thrusters[].turn_rate_deg", is_tunnel, TUNNEL},
    {"vessel.thrusters[].rudder_deg", is_no_main, "kind is not main"},
    {"vessel.thrusters[].forbidden_deg", is_no_azimuth, NO_AZIMUTH},
    {"vessel.thrusters[].forbidden_width_deg", is_no_azimuth, NO_AZIMUTH},
    {"vessel.thrusters[].cost", is_not_positioned, "positioning.active is false"},
    {"vessel.thrusters[].setting", is_positioned, "positioning.active is true"},
    {"vessel.thrusters[].diameter", has_no_wash, NO_WASH},
    {"vessel.thrusters[].direction_deg", is_tunnel, TUNNEL},
    {"vessel.station.", is_moved, "mode is not free"},
    {"vessel.positioning.waypoints", is_free, NULL},  /* its offset counts from them, whoever steers */
    {"vessel.positioning.control", has_points, NULL}, /* by which it is the heading's deviation alone */
    {"vessel.positioning.waypoints[].time", is_any, NULL},
    {"vessel.positioning.waypoints[].heading_deg", is_any, NULL},
    {"vessel.positioning.waypoints[].", holds_heading_alone, HEADING}, /* x and y */
    {"vessel.positioning.waypoints[].", is_any, NULL},                 /* else told with their list */
    {"vessel.positioning.", is_not_positioned, "positioning.active is false"},
    {"vessel.positioning.bias_rate", is_passive, "positioning.observer is not kalman"},
    {"vessel.positioning.force_noise", is_passive, "positioning.observer is not kalman"},
    {"vessel.positioning.observer_bandwidth", is_kalman, "positioning.observer is not passive"},
    {"vessel.positioning.feed_forward_gain", feeds_nothing, "positioning.feed_forward is none"},
    {"vessel.positioning.feed_forward_time", feeds_no_measured, "positioning.feed_forward is not measured"},
    {"vessel.positioning.vaning_rate_deg", keeps_heading, NO_VANING},
    {"vessel.positioning.vaning_time", keeps_heading, NO_VANING},
    {"vessel.positioning.vaning_load", keeps_heading, NO_VANING},
    {"vessel.propulsion.", drives_not, "there is no propulsion.bollard_pull"},
    {"vessel.propulsion.speed", has_period, "propulsion.pattern.period gives the speed"},
    {"vessel.propulsion.propeller_z", is_dry, DRY},
    {"vessel.propulsion.propeller_spacing", has_no_wash, NO_WASH},
    {"vessel.propulsion.propeller_spacing", has_one_propeller, "propulsion.propellers is 1"},
    {"vessel.propulsion.pattern.", has_no_pattern, "propulsion.pattern.kind is none"},
    {"vessel.propulsion.pattern.distance", goes_ahead, "the way ahead has none (propulsion.pattern.kind)"},
    {"vessel.propulsion.pattern.width", goes_ahead, "the way ahead has none (propulsion.pattern.kind)"},
    {"vessel.approach.", is_alone, ALONE},
    {"vessel.approach.look_ahead", watches_not, "there is no approach.limit"},
    {"vessel.wash.", has_no_wash, NO_WASH},
    {"vessel.hydrodynamics.heave_damping", is_no_estimate, "hydrodynamics.source is not estimate"},
    {"vessel.hydrodynamics.roll_damping", is_no_estimate, "hydrodynamics.source is not estimate"},
    {"vessel.hydrodynamics.pitch_damping", is_no_estimate, "hydrodynamics.source is not estimate"},
    {"vessel.hydrodynamics.axes", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.x", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.y", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.z", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.added_mass", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.hydrodynamics.damping", is_not_given, "hydrodynamics.source is not given"},
    {"vessel.current_coefficients.", has_no_current_table, "current_coefficients has no table"},
    {"vessel.wind_coefficients.", has_no_wind_table, "wind_coefficients has no table"},
    {"environment.current_speed", is_dry_and_still, DRY},
    {"environment.current_file", is_dry_and_still, DRY},
    {"environment.current_profile_file", is_dry_and_still, DRY},
    {"environment.current_direction_deg", is_dry_and_still, DRY},
    {"environment.wind_speed", is_dry, DRY},
    {"environment.wind_direction_deg", is_dry, DRY},
    {"environment.wind_file", is_dry, DRY},
    {"environment.air_density", is_dry, DRY},
    {"environment.floe_added_mass", is_dry, DRY},
    {"environment.floe_damping", is_dry, DRY},
    {"environment.ice_drag.", is_dry, DRY},
    {"environment.hull_drag.", is_dry, DRY},
    {"environment.hull_drag.", wets_no_hull, TOLD_HULLS},
    {"environment.current_speed", has_current_file, "environment.current_file tells the current"},
    {"environment.current_direction_deg", has_current_file, "environment.current_file tells the current"},
    {"environment.current_direction_deg", has_no_current, "there is no environment.current_speed"},
    {"environment.wind_speed", has_wind_file, "environment.wind_file tells the wind"},
    {"environment.wind_direction_deg", has_wind_file, "environment.wind_file tells the wind"},
    {"environment.wind_direction_deg", has_no_wind, "there is no environment.wind_speed"},
};

bool idle_rule_is_of_many(const idle_rule *r)
{
    char last = r->key[strlen(r->key) - 1];
    return last == '.' || last == '_';
}

static bool fits(const idle_rule *r, const char *key)
{
    return idle_rule_is_of_many(r) ? strncmp(r->key, key, strlen(r->key)) == 0 : strcmp(r->key, key) == 0;
}

const idle_rule *idle_rule_of(const char *pattern, const idle_question *q)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (fits(&rules[i], pattern) && rules[i].idle(q))
            return rules[i].why ? &rules[i] : NULL;
    return NULL;
}
