/* Every key of a scenario file, once.  The members of `scenario` (scenario.h), the schema that drives reading,
   defaults, checks and printing (scenario_schema.h) and the input reference are all made from these rows: to add a key,
   add a row.

   A row is X(name, SPEC, unit, meaning), where SPEC is one of
       REAL(value, lo, hi)                      double; default value, closed range
       SCALED(value, at, power, lo, hi)         double; default value * (run.scale / at)^power: a length of the ice tank
                                                grows with the scale, an area with its square
       AUTOMATIC(lo, hi)                        double; default `auto`, which is a NaN here: Fram finds the value
       INTEGER(value, lo, hi)                   int64_t
       BOOLEAN(value)                           bool
       CHOICE(type, value, "name name ...")     an enum whose values 0, 1, ... are written as these names
       TEXT(value)                              scenario_text
       PATH(value)                              scenario_text, a file relative to the scenario's folder
       SECTION(noun)                            a nested scenario_<noun>, one key of a mapping
       LIST(noun, most)                         an ARRAY of at most so many scenario_<noun>, a list of mappings

   Units are SI; only keys that end in _deg hold degrees.  Directions are towards, counter-clockwise from X.

   Knows the enums of lower rooms; must not know files. */
#ifndef MODEL_SCENARIO_KEYS_H
#define MODEL_SCENARIO_KEYS_H

#include "model/scenario_propulsion_keys.h"
#include "model/scenario_station_keys.h"
#include "model/scenario_wash_keys.h"

#include "model/scenario_water_keys.h"

#define SCENARIO_KEYS(X)                                                                             \
    X(title, TEXT(""), "", "what the scenario shows; goes into reports")                             \
    X(run, SECTION(run), "", "time, randomness and numerical method")                                \
    X(vessel, SECTION(vessel), "", "the vessel, and how it is held or moved")                        \
    X(vessels, LIST(vessel, 32), "", "several vessels, in place of vessel, each with name and hull") \
    X(ice, SECTION(ice), "", "the ice field and its material")                                       \
    X(domain, SECTION(domain), "", "the part of the sea that is simulated")                          \
    X(environment, SECTION(environment), "", "water, air and gravity")                               \
    X(output, SECTION(output), "", "what a run writes and how often, in simulated time")

#define SCENARIO_RUN_KEYS(X)                                                                                         \
    X(duration, REAL(60, 0, 1e7), "s", "simulated time")                                                             \
    X(time_step, REAL(0.01, 1e-7, 10), "s", "fixed time step")                                                       \
    X(seed, INTEGER(1, 0, SCENARIO_SEED_MOST), "1", "seed of everything random; same scenario and seed, same bits")  \
    X(scale, REAL(30, 0.01, 1e3), "1",                                                                               \
      "scaling factor lambda of full size to ice tank; 1 is tank size. Sets the defaults of thresholds")             \
    X(transient, REAL(0, 0, 1e7), "s", "time at the start that statistics leave out")                                \
    X(collision_margin, SCALED(0.3, 30, 1, 0, 1e3), "m",                                                             \
      "margin by which bounding boxes are enlarged so that pairs last for several steps; changes speed only, and "   \
      "with ice.sleep_speed from how far off a hull wakes what sleeps")                                              \
    X(speed_limit, SCALED(100, 30, 0.5, 1e-6, 1e9), "m/s", "a body that moves faster means that the run went wrong") \
    X(memory_limit, REAL(16, 0.01, 1e6), "GB",                                                                       \
      "a scenario that is estimated to take more memory is refused before it is built")                              \
    X(solver, SECTION(solver), "", "the multibody solver")

#define SCENARIO_SOLVER_KEYS(X)                                                                                   \
    X(kind, CHOICE(solver_kind, SOLVER_FAST, "sequential fast accurate"), "",                                     \
      "fast: batched and accelerated; sequential: projected Gauss-Seidel in contact order, the reference; "       \
      "accurate: run to the tolerance, to judge the others by")                                                   \
    X(iterations, INTEGER(30, 1, 1000000), "1", "fast, sequential: velocity sweeps of a step")                    \
    X(position_iterations, INTEGER(10, 0, 1000000), "1", "position correction sweeps of a step")                  \
    X(warm_start, BOOLEAN(true), "", "begin from the impulses of the last step")                                  \
    X(correction_rate, REAL(0.8, 0, 1), "1", "largest part of an overlap that a step corrects")                   \
    X(contact_skin, SCALED(1e-4, 30, 1, 0, 1), "m",                                                               \
      "bodies nearer than this touch: gaps close down to it, no more, so that packed ice rests")                  \
    X(baumgarte, BOOLEAN(false), "", "comparison switch: correct overlaps through velocities; makes ice explode") \
    X(tolerance, SCALED(1e-6, 30, 0.5, 0, 1e3), "m/s",                                                            \
      "accurate: largest residual to stop at; "                                                                   \
      "fast: sweeps that change no velocity by more are the last")                                                \
    X(most_iterations, INTEGER(10000, 1, 100000000), "1", "accurate: upper bound of the sweeps of a step")

#define SCENARIO_VESSEL_KEYS(X)                                                                                      \
    X(name, TEXT(""), "", "letters, digits, - and _; in a list columns and results begin with it, NAME.ice_force_x") \
    X(present, BOOLEAN(true), "", "false: ice alone")                                                                \
    X(mode, CHOICE(vessel_mode, VESSEL_TOWED, "prescribed towed free"), "",                                          \
      "prescribed: all motions given; towed: by a carriage, free to heave; free: six degrees of freedom")            \
    X(x, REAL(0, -1e7, 1e7), "m", "place of the ship's origin, amidships on the centre line")                        \
    X(y, REAL(0, -1e7, 1e7), "m", "place of the ship's origin")                                                      \
    X(heading_deg, REAL(0, -360, 360), "deg", "direction of the bow")                                                \
    X(speed, REAL(0, 0, 100), "m/s", "speed of towing, of prescribed motion, or at the start of free motion")        \
    X(course_deg, AUTOMATIC(-360, 360), "deg", "direction of the speed; auto: the heading")                          \
    X(ramp, REAL(0, 0, 1e6), "s", "time over which the speed of towing grows from zero")                             \
    X(path, LIST(path_point, 1000), "",                                                                              \
      "modes prescribed and towed: where the hull or its carriage goes, linear in time; in place of x, y, "          \
      "heading_deg, speed, course_deg and ramp")                                                                     \
    X(mass, AUTOMATIC(1e-9, 1e12), "kg", "auto: the mass displaced at the draught")                                  \
    X(centre_of_gravity_x, AUTOMATIC(-1e4, 1e4), "m", "forward of amidships; auto: over the centre of buoyancy")     \
    X(centre_of_gravity_y, AUTOMATIC(-1e4, 1e4), "m", "to port; auto: over the centre of buoyancy")                  \
    X(centre_of_gravity_z, AUTOMATIC(-1e4, 1e4), "m", "above the design waterline; auto: in it")                     \
    X(gyration_roll, AUTOMATIC(1e-9, 1e4), "m",                                                                      \
      "radius of gyration about x; auto: 0.35 beam, at most what the other two allow")                               \
    X(gyration_pitch, AUTOMATIC(1e-9, 1e4), "m", "radius of gyration about y; auto: 0.25 length")                    \
    X(gyration_yaw, AUTOMATIC(1e-9, 1e4), "m",                                                                       \
      "radius of gyration about z; auto: 0.25 of the longer of length and beam")                                     \
    X(fender_stiffness, AUTOMATIC(1, 1e15), "N/m",                                                                   \
      "where another vessel or a wall meets it: force per depth at which it yields and stays so; auto: rigid")       \
    X(hull, SECTION(hull), "", "the form of the hull")                                                               \
    X(mooring, SECTION(mooring), "", "mode free: lines to the bottom")                                               \
    X(thrusters, LIST(thruster, VESSEL_THRUSTERS_MOST), "", "mode free: thrusters")                                  \
    X(positioning, SECTION(positioning), "", "mode free: dynamic positioning")                                       \
    X(station, SECTION(station), "", "what counts as being on station")                                              \
    X(propulsion, SECTION(propulsion), "", "mode free: a ship that drives itself through the ice")                   \
    X(approach, SECTION(approach), "", "when another vessel is going to come too close")                             \
    X(wash, SECTION(wash), "", "what the water that its propellers throw back does to floes")                        \
    X(hydrodynamics, SECTION(hydrodynamics), "", "added mass and linear damping")                                    \
    X(current_coefficients, SECTION(flow), "", "force coefficients of the current over its direction")               \
    X(wind_coefficients, SECTION(flow), "", "force coefficients of the wind over its direction")

#define SCENARIO_HULL_KEYS(X)                                                                                        \
    X(form, CHOICE(hull_form, HULL_ICEBREAKER, "box icebreaker file cone ship"), "",                                 \
      "box; icebreaker: wedge bow, flared midbody and raked stern; file: a mesh, which has its own length, beam, "   \
      "draught and angles; cone: inverted, of 24 facets, length and beam its diameter, sides at the flare angle; "   \
      "ship: tanker, FPSO or drillship, flat of side and bottom, without bulb, block coefficient 0.64 to some 0.93") \
    X(file, PATH(""), "",                                                                                            \
      "form file: mesh (STL, OBJ, GDF) in ship coordinates, x forward, z = 0 in the design waterline")               \
    X(file_scale, REAL(1, 1e-6, 1e6), "1", "form file: lengths of the file times this are metres")                   \
    X(seal_width, AUTOMATIC(0, 1e3), "m",                                                                            \
      "form file: cracks up to this width are sealed; auto: a two-thousandth of the length")                         \
    X(repair, BOOLEAN(false), "", "form file: fill holes and turn triangles instead of refusing the mesh")           \
    X(length, REAL(100, 1e-3, 1e4), "m", "waterline length")                                                         \
    X(beam, REAL(20, 1e-3, 1e4), "m", "waterline beam")                                                              \
    X(draught, REAL(7, 1e-3, 1e3), "m", "draught")                                                                   \
    X(freeboard, AUTOMATIC(1e-4, 1e3), "m",                                                                          \
      "height of the deck above the waterline; form file: a level open top is raised by this and decked; auto: 4 "   \
      "(scale / 30), and a file's top that ends above the water is decked where it is")                              \
    X(stem_angle_deg, AUTOMATIC(5, 90), "deg", "stem against the water plane, at the waterline; auto: 30, ship: 75") \
    X(entrance_angle_deg, AUTOMATIC(5, 90), "deg",                                                                   \
      "half entrance angle of the waterline; auto: 30, ship: of a parabola as long as the entrance")                 \
    X(flare_angle_deg, AUTOMATIC(0, 80), "deg", "sides against the vertical; auto: 8, ship: 0, and nothing else")    \
    X(stern_angle_deg, AUTOMATIC(5, 90), "deg",                                                                      \
      "run of the stern, of a ship its transom, against the water plane; auto: 30, ship: 45")                        \
    X(parallel_midbody, AUTOMATIC(0, 1), "1",                                                                        \
      "length of the parallel middle body over the waterline length; auto: 0.4, ship: by the block coefficient")     \
    X(block_coefficient, AUTOMATIC(0.01, 1), "1",                                                                    \
      "displaced volume over length, beam and draught; icebreaker: met by the bilge; ship: by the lengths of "       \
      "entrance and run, or with parallel_midbody by their fullness; auto: sharp bilges, ship: 0.8, or what "        \
      "parallel_midbody leaves")                                                                                     \
    X(bilge_radius, AUTOMATIC(0, 1e3), "m",                                                                          \
      "ship: radius of the bilge; auto: a tenth of the root of beam times draught, a tenth of the beam or half the " \
      "draught, whatever is least")                                                                                  \
    X(transom, AUTOMATIC(0, 0.95), "1",                                                                              \
      "ship: breadth of the transom at the waterline over the beam, 0: a pointed stern; auto: 0.5")                  \
    X(piece_distance, AUTOMATIC(1e-6, 1e3), "m",                                                                     \
      "form file: largest distance of the convex pieces for contact to the mesh; auto: a hundredth of the beam")     \
    X(most_pieces, INTEGER(64, 1, 4096), "1", "form file: most convex pieces; no fewer than closed parts")

#define SCENARIO_ICE_KEYS(X)                                                                                           \
    X(source, CHOICE(ice_source, ICE_VORONOI, "voronoi floes none file level packed"), "",                             \
      "voronoi: managed ice, Voronoi cells; floes: those listed under ice.floes; none: open water; file: observed "    \
      "floes, cut at the edge of the domain; level: an intact sheet, held by its sides or drifting; packed: "          \
      "floes drawn from ice.populations, then brought to places where none overlap")                                   \
    X(level, SECTION(level), "", "the sheet, for source level")                                                        \
    X(file, PATH(""), "",                                                                                              \
      "file: floes in planar lengths, as GeoJSON, WKT or lines of x and y with a blank line between outlines; a "      \
      "thickness property of GeoJSON goes before ice.thickness")                                                       \
    X(file_coordinates, CHOICE(file_coordinates, FILE_PLANAR, "planar degrees"), "",                                   \
      "file: planar: lengths; degrees: longitude and latitude (WGS 84), laid flat about the centre of all "            \
      "floes, which goes to file_x, file_y, with y to the north")                                                      \
    X(file_scale, REAL(1, 1e-9, 1e9), "1", "file: lengths of the file times this are metres")                          \
    X(file_x, REAL(0, -1e9, 1e9), "m", "file: where its origin goes")                                                  \
    X(file_y, REAL(0, -1e9, 1e9), "m", "file: where its origin goes")                                                  \
    X(file_centre, BOOLEAN(false), "", "file: the centre of all floes goes there instead of its origin")               \
    X(simplify, REAL(0, 0, 1e6), "m", "file: vertices are left out, moving no edge by more")                           \
    X(bad_rings, CHOICE(import_bad, IMPORT_REFUSE, "refuse drop repair"), "",                                          \
      "file: what is done with rings that are open, cross themselves, have no area or are holes; repair also cuts "    \
      "overlapping floes apart")                                                                                       \
    X(concentration, REAL(0.8, 0.01, 1), "1",                                                                          \
      "voronoi, packed, file with populations: ice area over the area free for ice, under 1")                          \
    X(mean_floe_area, REAL(400, 1e-9, 1e8), "m2", "voronoi: mean area of the cells the floes are cut from")            \
    X(size_deviation, REAL(0.5, 0, 1), "1", "voronoi: scatter of the cells, 0 regular to 1 random")                    \
    X(roundness, REAL(0, 0, 1), "1", "voronoi: 0 sharp corners to 1 rounded as far as the concentration allows")       \
    X(keep_out_margin, SCALED(1, 30, 1, 0, 1e4), "m",                                                                  \
      "clear distance between the vessel, as seen from above with its deck, or its parts in the ice where water is "   \
      "between them, and the field or level ice")                                                                      \
    X(thickness, REAL(1, 1e-6, 100), "m", "thickness")                                                                 \
    X(density, REAL(920, 1, 2000), "kg/m3", "density")                                                                 \
    X(elastic_modulus, REAL(5e9, 1, 1e12), "Pa", "elastic modulus E")                                                  \
    X(poisson_ratio, REAL(0.3, 0, 0.499), "1", "Poisson's ratio")                                                      \
    X(flexural_strength, REAL(5e5, 1e-3, 1e9), "Pa", "flexural strength")                                              \
    X(crushing_strength, REAL(2e6, 1e-3, 1e10), "Pa",                                                                  \
      "crushing pressure; with an exponent e that on 1 m2, which goes with lambda^(1 - 2 e) in a scenario that is "    \
      "scaled")                                                                                                        \
    X(strength, SECTION(strength), "", "scatter of both strengths over the ice, drawn by run.seed")                    \
    X(crushing_exponent, REAL(0, -1, 1), "1", "e of the crushing pressure strength * (area / 1 m2)^e; 0 constant")     \
    X(breakable, BOOLEAN(false), "", "floes may break under the vessel")                                               \
    X(cap_ice_ice, BOOLEAN(true), "",                                                                                  \
      "crushing limits contacts between floes too; false: as if none could be crushed")                                \
    X(cap_ice_wall, BOOLEAN(false), "", "crushing limits contacts with walls too")                                     \
    X(ridging_resistance, REAL(0, 0, 1e3), "MN/m",                                                                     \
      "R of the line load R h^1.25 D^-0.54 at which floes build a ridge, which goes with lambda^1.29 in a scenario "   \
      "that is scaled; bounds contacts between them; 0: none")                                                         \
    X(rafting_edge_angle_deg, REAL(0, 0, 85), "deg",                                                                   \
      "slope of broken edges, on which floes thin enough to bend out of the way slide over each other; bounds "        \
      "contacts between them; 0: none")                                                                                \
    X(correct_unbreakable, BOOLEAN(false), "",                                                                         \
      "comparison switch: crushed overlap pushes a hull and unbreakable floes apart again")                            \
    X(crush_trims, BOOLEAN(true), "",                                                                                  \
      "level and fixed ice: where the hull has been there is no ice any more; what is cut away is booked as crushed")  \
    X(crush_notches, BOOLEAN(true), "",                                                                                \
      "floes that float: when a hull draws back, what it had filled over the whole thickness is cut away; deeper "     \
      "than edge_threshold; booked as crushed")                                                                        \
    X(parts_by_motion, BOOLEAN(true), "",                                                                              \
      "where a hull slides along ice and where it moves into it are two contacts; false: one, with one normal, whose " \
      "friction counts the whole of its area")                                                                         \
    X(small_patch, REAL(0.01, 0, 0.1), "1",                                                                            \
      "where two floes touch over less than this part of the smaller one's radius (length of gyration), in one "       \
      "direction or in both, they touch in two points or in one, without a moment there, not in four; 0: always four") \
    X(top_plane_area, BOOLEAN(false), "",                                                                              \
      "comparison switch: contact area from the cut with the floe's top plane; edges of level and fixed ice do not "   \
      "give then, whatever ice.fracture.edge_* say")                                                                   \
    X(sleep_speed, REAL(0, 0, 10), "m/s",                                                                              \
      "floes that were slower than this for sleep_time, centre and rim together, are put to sleep until something "    \
      "wakes them: they cost nothing, as in the channel behind a ship; where level ice drifts, slower past "           \
      "the sheet, which carries them along; 0: none")                                                                  \
    X(sleep_time, SCALED(5, 30, 0.5, 1e-3, 1e6), "s", "how long a floe must have been slow before it sleeps")          \
    X(smallest_floe_area, SCALED(2e-4, 1, 2, 0, 1e8), "m2",                                                            \
      "smaller floes are not made or are removed, but packed and listed ones, which are made as they were given; "     \
      "smaller pieces of ice that breaks stay with a neighbour, and loads grow from a tenth of the wedges on that "    \
      "fram check tells")                                                                                              \
    X(smallest_piece_area, SCALED(1e-5, 1, 2, 0, 1e8), "m2", "smaller triangles of a concave floe are dropped")        \
    X(edge_threshold, SCALED(5e-3, 1, 1, 0, 1e3), "m", "shorter edges of a new floe are removed")                      \
    X(open_water, LIST(opening, 100), "", "voronoi, file, packed: zones without ice at the start")                     \
    X(open_water_file, PATH(""), "",                                                                                   \
      "as open_water, polygons of any shape from a file as ice.file, in metres; one round an island is cut in two, "   \
      "for it must have no hole")                                                                                      \
    X(friction, SECTION(friction), "", "Coulomb friction of the pairs of materials")                                   \
    X(fracture, SECTION(fracture), "", "how breakable floes break")                                                    \
    X(populations, LIST(population, 16), "",                                                                           \
      "packed: the kinds of floes; file: with them, the water that the file leaves is filled to ice.concentration; "   \
      "voronoi: one, whose laws of size, thickness and strength the floes follow instead of ice.mean_floe_area")       \
    X(floes, LIST(floe, 1000), "", "single floes, for source floes")

#define SCENARIO_FRICTION_KEYS(X)                                                 \
    X(ice_ice_static, REAL(0.3, 0, 10), "1", "ice on ice, sticking")              \
    X(ice_ice_kinetic, REAL(0.3, 0, 10), "1", "ice on ice, sliding")              \
    X(ice_hull_static, REAL(0.1, 0, 10), "1", "ice on hull, sticking")            \
    X(ice_hull_kinetic, REAL(0.1, 0, 10), "1", "ice on hull, sliding")            \
    X(ice_wall_static, REAL(0.3, 0, 10), "1", "ice on basin wall, sticking")      \
    X(ice_wall_kinetic, REAL(0.3, 0, 10), "1", "ice on basin wall, sliding")      \
    X(hull_hull_static, REAL(0.25, 0, 10), "1", "vessel on vessel, sticking")     \
    X(hull_hull_kinetic, REAL(0.25, 0, 10), "1", "vessel on vessel, sliding")     \
    X(hull_wall_static, REAL(0.25, 0, 10), "1", "vessel on basin wall, sticking") \
    X(hull_wall_kinetic, REAL(0.25, 0, 10), "1", "vessel on basin wall, sliding")

#define SCENARIO_FRACTURE_KEYS(X)                                                                                     \
    X(wedges, INTEGER(3, 2, 32), "1", "N of the N wedges that share a load; the stencil has twice as many")           \
    X(sharing, CHOICE(wedge_sharing, SHARING_WIDTH, "width equal"), "",                                               \
      "width: each wedge carries by the width of the ice in its sector, a corner less than an edge; equal: N "        \
      "whole wedges whatever ice is there")                                                                           \
    X(radius_along, CHOICE(wedge_radius, RADIUS_ALONG_AXES, "axes cracks"), "",                                       \
      "where wedges break off: axes: straight across, the breaking radius R away along their axes, as Nevel's "       \
      "beams do; cracks: R away along the cracks between them, R cos(pi/(2N)) along the axes")                        \
    X(load_over, CHOICE(edge_load_rule, EDGE_LOAD_RESPONSE, "step response"), "",                                     \
      "what breaks floes that float: step: the impulse of a time step over the step; response: the load as a mean "   \
      "over the time in which the edge responds; level and fixed ice: always step")                                   \
    X(edge_compliance, BOOLEAN(true), "",                                                                             \
      "level and fixed ice: a loaded edge goes down or up under its load before it breaks, as Nevel's wedges do on "  \
      "water; false: it is rigid until it breaks")                                                                    \
    X(edge_elastic, BOOLEAN(true), "",                                                                                \
      "level and fixed ice, with edge_compliance: loads that crush nothing, of hulls and of free pieces, bend an "    \
      "edge too as they come and go; false: it is rigid under them")                                                  \
    X(edge_gaps, BOOLEAN(true), "",                                                                                   \
      "level and fixed ice, with edge_compliance: a hull that has drawn back from the ice, by less than "             \
      "edge_threshold, meets it where it left it; false: as soon as it turns")                                        \
    X(edge_melts, BOOLEAN(true), "",                                                                                  \
      "level and fixed ice, with edge_elastic: where a hull slides along a bent edge friction's heat melts its face") \
    X(latent_heat, REAL(334e3, 1e-3, 1e12), "J/kg",                                                                   \
      "edge_melts: heat that melts ice; goes with lambda, as the square of a speed, in a scenario that is scaled")    \
    X(edge_inertia, BOOLEAN(true), "",                                                                                \
      "level and fixed ice, with edge_compliance: ice and the water that moves with it have mass as an edge bends, "  \
      "so that breaking loads rise and pieces shorten with speed; false: both are those of a load at rest")           \
    X(splitting, CHOICE(splitting_rule, SPLITTING_LENGTH, "length toughness none"), "",                               \
      "what lets a radial crack run through: length: it is longer than the breaking radius R and shorter than "       \
      "splitting_factor R; toughness: fracture mechanics, by the load in the floe's plane; none: floes do not split") \
    X(splitting_factor, REAL(3, 0, 1e6), "1", "length: S_k; 1 or less produces no splitting")                         \
    X(toughness, REAL(150e3, 1e-3, 1e12), "Pa m^0.5",                                                                 \
      "toughness: fracture toughness K_IC; goes with lambda^1.5 in a scenario that is scaled")                        \
    X(narrowness, REAL(4, 1, 1e6), "1",                                                                               \
      "R_size: a floe does not split into one whose box is longer than this many "                                    \
      "widths, by length or by toughness and whatever the load: a square one that is hit a quarter of its side off "  \
      "the middle needs more than 4")                                                                                 \
    X(thick_plate_radius, BOOLEAN(true), "", "small loads act as on a radius that grows with the thickness")          \
    X(wide_contacts, BOOLEAN(true), "",                                                                               \
      "a load that is wider along the edge than the ice is thick, and four times as wide as it is deep, breaks a "    \
      "strip off between its wedges; false: it acts as a narrow one")                                                 \
    X(joint_loads, BOOLEAN(true), "",                                                                                 \
      "loads near each other along an edge bend it together, so that two halves of a load break what the whole "      \
      "does; false: each breaks the ice as if it were alone")                                                         \
    X(wedge_room, BOOLEAN(false), "", "floes that end within the breaking radius do not break in bending")            \
    X(under_pieces, BOOLEAN(true), "",                                                                                \
      "level and fixed ice breaks under pieces of ice too, where they press with more than breaks an eighth of a "    \
      "straight edge; false: under hulls alone")                                                                      \
    X(under_ice_contacts, BOOLEAN(false), "",                                                                         \
      "with cap_ice_ice: floes that may break do so under other floes too, whose contacts are measured as patches "   \
      "then")                                                                                                         \
    X(brash, BOOLEAN(false), "",                                                                                      \
      "pieces under smallest_floe_area are booked as brash, with their momentum, not as lost")

#define SCENARIO_POPULATION_KEYS(X)                                                                        \
    X(share, REAL(1, 1e-9, 1e9), "1", "of the ice area, in proportion to the other populations")           \
    X(size, CHOICE(size_law_kind, SIZE_POWER, "constant uniform lognormal power histogram"), "",           \
      "law of the diameters, by number; a floe's diameter is that of the disc of its area")                \
    X(diameter, REAL(20, 1e-6, 1e6), "m", "constant: of all; lognormal: the mean")                         \
    X(diameter_deviation, REAL(8, 1e-9, 1e6), "m", "lognormal: standard deviation")                        \
    X(diameter_min, REAL(10, 1e-6, 1e6), "m", "uniform, lognormal, power: the smallest")                   \
    X(diameter_max, REAL(100, 1e-6, 1e6), "m", "uniform, lognormal, power: the largest")                   \
    X(exponent, REAL(1.7, 0.01, 20), "1", "power: b of N(>D) ~ D^-b")                                      \
    X(histogram, PATH(""), "", "histogram: CSV of the columns diameter_min[m], diameter_max[m], floes[1]") \
    X(shape, CHOICE(population_shape, POPULATION_CONVEX, "convex templates"), "",                          \
      "convex: random polygons; templates: outlines of a file, at the sizes of the law")                   \
    X(templates, PATH(""), "", "templates: file of outlines, at any scale; faulty ones are left out")      \
    X(vertices_min, INTEGER(5, 3, 64), "1", "convex: fewest corners")                                      \
    X(vertices_max, INTEGER(9, 3, 64), "1", "convex: most corners")                                        \
    X(elongation, REAL(1.5, 1, 10), "1", "convex: longest axis ratio, drawn from 1 on")                    \
    X(thickness, AUTOMATIC(1e-6, 100), "m", "mean; auto: ice.thickness")                                   \
    X(thickness_deviation, REAL(0, 0, 100), "m", "lognormal scatter from floe to floe")                    \
    X(flexural_strength, AUTOMATIC(1e-3, 1e9), "Pa", "mean; auto: ice.flexural_strength")                  \
    X(flexural_deviation, REAL(0, 0, 1e9), "Pa", "lognormal scatter from floe to floe")                    \
    X(crushing_strength, AUTOMATIC(1e-3, 1e10), "Pa", "mean; auto: ice.crushing_strength")                 \
    X(crushing_deviation, REAL(0, 0, 1e10), "Pa", "lognormal scatter from floe to floe")                   \
    X(breakable, BOOLEAN(true), "", "its floes may break, where ice.breakable is true")

#define SCENARIO_STRENGTH_KEYS(X)                                                                                   \
    X(flexural_variation, REAL(0, 0, 2), "1",                                                                       \
      "coefficient of variation of the flexural strength from place to place, lognormal about the floe's; 0: none") \
    X(crushing_variation, REAL(0, 0, 2), "1",                                                                       \
      "coefficient of variation of the crushing strength from place to place, lognormal about the floe's; 0: none") \
    X(correlation_length, SCALED(10, 30, 1, 1e-3, 1e7), "m",                                                        \
      "distance at which the correlation of the strengths' logarithms has fallen to 1/e")                           \
    X(common, REAL(0, 0, 1), "1",                                                                                   \
      "correlation of the logarithms of both strengths at one place: 0 they vary apart, 1 together")

#define SCENARIO_LEVEL_KEYS(X)                                                                                   \
    X(x_min, AUTOMATIC(-1e7, 1e7), "m",                                                                          \
      "edge of the sheet; auto: that of the domain; feeding: where it is at the start, auto: none")              \
    X(x_max, AUTOMATIC(-1e7, 1e7), "m",                                                                          \
      "edge of the sheet; auto: that of the domain; feeding: where it is at the start, auto: none")              \
    X(y_min, AUTOMATIC(-1e7, 1e7), "m",                                                                          \
      "edge of the sheet; auto: that of the domain; feeding: where it is at the start, auto: none")              \
    X(y_max, AUTOMATIC(-1e7, 1e7), "m",                                                                          \
      "edge of the sheet; auto: that of the domain; feeding: where it is at the start, auto: none")              \
    X(anchored_x_min, BOOLEAN(true), "", "the sheet is held at this edge; what hangs on no held edge drifts")    \
    X(anchored_x_max, BOOLEAN(true), "", "the sheet is held at this edge")                                       \
    X(anchored_y_min, BOOLEAN(true), "", "the sheet is held at this edge")                                       \
    X(anchored_y_max, BOOLEAN(true), "", "the sheet is held at this edge")                                       \
    X(tile_size, AUTOMATIC(1e-6, 1e7), "m",                                                                      \
      "the sheet is held in square tiles of about this size, and an event touches only those it reaches; "       \
      "auto: twice the characteristic length, five to ten breaking radii")                                       \
    X(line_load, AUTOMATIC(0, 1e12), "N/m",                                                                      \
      "feeding: most that the ice far away drives the sheet with, per metre of the domain across; a sheet that " \
      "meets more slows down by its mass; 0: a floe with nothing behind it; auto: it drifts whatever it meets")  \
    X(mass, AUTOMATIC(1, 1e18), "kg",                                                                            \
      "feeding, with a line_load: all that slows down together; auto: of the sheet between its edges where "     \
      "all four are given, less its openings, else of a domain full of ice")                                     \
    X(openings, LIST(opening, 100), "", "open water in the sheet at the start: channels, leads, basins")

#define SCENARIO_OPENING_KEYS(X)                           \
    X(x, REAL(0, -1e7, 1e7), "m", "centre")                \
    X(y, REAL(0, -1e7, 1e7), "m", "centre")                \
    X(length, REAL(10, 1e-6, 1e7), "m", "along its own x") \
    X(width, REAL(10, 1e-6, 1e7), "m", "along its own y")  \
    X(angle_deg, REAL(0, -360, 360), "deg", "of its own x, counter-clockwise from X")

#define SCENARIO_FLOE_KEYS(X)                                                                              \
    X(shape, CHOICE(floe_shape, FLOE_RECTANGLE, "rectangle regular"), "", "rectangle, or regular polygon") \
    X(length, REAL(10, 1e-6, 1e6), "m", "rectangle: along the floe's x")                                   \
    X(width, REAL(10, 1e-6, 1e6), "m", "rectangle: along the floe's y")                                    \
    X(sides, INTEGER(6, 3, 64), "1", "regular: number of sides")                                           \
    X(radius, REAL(5, 1e-6, 1e6), "m", "regular: of the circle through the corners")                       \
    X(thickness, AUTOMATIC(1e-6, 100), "m", "auto: ice.thickness")                                         \
    X(x, REAL(0, -1e7, 1e7), "m", "centre")                                                                \
    X(y, REAL(0, -1e7, 1e7), "m", "centre")                                                                \
    X(elevation, AUTOMATIC(-1e4, 1e4), "m", "centre above still water; auto: as it floats")                \
    X(yaw_deg, REAL(0, -360, 360), "deg", "turn about the vertical, done first")                           \
    X(pitch_deg, REAL(0, -90, 90), "deg", "then about the floe's y, positive nose down")                   \
    X(roll_deg, REAL(0, -180, 180), "deg", "then about the floe's x")                                      \
    X(velocity_x, REAL(0, -1e3, 1e3), "m/s", "at the start")                                               \
    X(velocity_y, REAL(0, -1e3, 1e3), "m/s", "at the start")                                               \
    X(velocity_z, REAL(0, -1e3, 1e3), "m/s", "at the start")                                               \
    X(spin, REAL(0, -1e3, 1e3), "rad/s", "about the vertical, at the start")                               \
    X(fixed, BOOLEAN(false), "", "never moves")

#define SCENARIO_DOMAIN_KEYS(X)                                                                                     \
    X(x_min, REAL(-100, -1e7, 1e7), "m", "edge")                                                                    \
    X(x_max, REAL(300, -1e7, 1e7), "m", "edge")                                                                     \
    X(y_min, REAL(-100, -1e7, 1e7), "m", "edge")                                                                    \
    X(y_max, REAL(100, -1e7, 1e7), "m", "edge")                                                                     \
    X(boundary, CHOICE(domain_boundary, DOMAIN_WALLS, "walls open feeding"), "",                                    \
      "walls: a basin; open: ice that leaves is removed; feeding: an endless field, or a sheet of level ice, "      \
      "drifts through")                                                                                             \
    X(drift_speed, AUTOMATIC(0, 100), "m/s", "feeding: of the field; auto: that of the current at the surface")     \
    X(drift_direction_deg, REAL(0, -360, 360), "deg", "feeding: direction the field drifts to, with a drift_speed") \
    X(drift_file, PATH(""), "",                                                                                     \
      "feeding: CSV of a drift that changes with time: time [s], x, y [m/s]; instead of drift_speed")               \
    X(band, AUTOMATIC(1e-3, 1e6), "m",                                                                              \
      "feeding: width of the outer band whose floes go with the field, whatever pushes; auto: 1.5 times the "       \
      "radius of the largest floe")                                                                                 \
    X(tile_x, AUTOMATIC(1e-3, 1e7), "m",                                                                            \
      "feeding: the field repeats itself after this length along x; auto: 1.25 times the domain, and six mean "     \
      "floes more than it at least, those of ice.populations or else of ice.mean_floe_area")                        \
    X(tile_y, AUTOMATIC(1e-3, 1e7), "m", "feeding: and after this length along y")                                  \
    X(wall_height, SCALED(20, 30, 1, 1e-6, 1e4), "m", "height of the walls, half of it under water")                \
    X(wall_thickness, SCALED(10, 30, 1, 1e-6, 1e4), "m", "thickness of the walls, outside the domain")

#define SCENARIO_ENVIRONMENT_KEYS(X)                                                                                \
    X(water, BOOLEAN(true), "", "false: neither fluid nor gravity, for tests of pure dynamics")                     \
    X(gravity, REAL(9.81, 1e-3, 1e3), "m/s2", "acceleration of gravity, down")                                      \
    X(water_density, REAL(1025, 1, 1e4), "kg/m3", "density of water")                                               \
    X(air_density, REAL(1.225, 0, 1e3), "kg/m3", "density of air")                                                  \
    X(current_speed, REAL(0, 0, 100), "m/s", "uniform current")                                                     \
    X(current_direction_deg, REAL(0, -360, 360), "deg", "direction the current flows to")                           \
    X(wind_speed, REAL(0, 0, 200), "m/s", "uniform wind")                                                           \
    X(wind_direction_deg, REAL(0, -360, 360), "deg", "direction the wind blows to")                                 \
    X(current_file, PATH(""), "",                                                                                   \
      "CSV of a current that changes with time: time [s], x, y [m/s]; instead of the uniform one")                  \
    X(current_profile_file, PATH(""), "", "CSV of what the current has on top at a depth: depth [m], x, y [m/s]")   \
    X(wind_file, PATH(""), "",                                                                                      \
      "CSV of a wind that changes with time: time [s], x, y [m/s]; instead of the uniform one")                     \
    X(floe_added_mass, BOOLEAN(false), "", "floes have the added mass of thin plates in heave, roll and pitch")     \
    X(floe_damping, REAL(0, 0, 10), "1", "linear damping of floes in heave, roll and pitch, over the critical one") \
    X(floe_ventilation, BOOLEAN(false), "",                                                                         \
      "upper faces of floes that go under are dry until water has run over their edges; false: at once wet")        \
    X(ice_drag, SECTION(ice_drag), "", "drag coefficients of the floes")                                            \
    X(hull_drag, SECTION(hull_drag), "", "drag coefficients of the vessel")

#define SCENARIO_ICE_DRAG_KEYS(X)                                                          \
    X(water_form, REAL(1, 0, 100), "1", "form drag of wet faces that move into the water") \
    X(water_skin, REAL(0.01, 0, 100), "1", "skin drag of wet faces")                       \
    X(air_form, REAL(1, 0, 100), "1", "form drag of dry faces that move into the air")     \
    X(air_skin, REAL(0.003, 0, 100), "1", "skin drag of dry faces")

#define SCENARIO_HULL_DRAG_KEYS(X)                                                           \
    X(water_form, REAL(0.1, 0, 100), "1", "form drag of wet faces that move into the water") \
    X(water_skin, REAL(0.003, 0, 100), "1", "skin drag of wet faces")                        \
    X(air_form, REAL(0.8, 0, 100), "1", "form drag of dry faces that move into the air")     \
    X(air_skin, REAL(0.003, 0, 100), "1", "skin drag of dry faces")

#define SCENARIO_OUTPUT_KEYS(X)                                                                                 \
    X(csv_interval, REAL(0, 0, 1e7), "s", "between rows of the CSV file, in whole steps; 0: every step")        \
    X(frame_interval, REAL(1, 0, 1e7), "s", "between frames of the record, in whole steps; 0: none")            \
    X(record_limit, REAL(360, 0, 1e9), "MB",                                                                    \
      "frames come at 2, 4, 8 ... times the interval to keep the record under this; 0: no limit")               \
    X(checkpoint_interval, REAL(60, 0, 1e7), "s", "between checkpoints, in whole steps; 0: only at the end")    \
    X(picture_interval, REAL(0, 0, 1e7), "s", "between plan-view pictures, in whole steps; 0: only at the end") \
    X(averaging_window, SCALED(0.5, 30, 0.5, 0, 1e5), "s",                                                      \
      "window over which loads are averaged for statistics, in whole steps, a million at most; longer than "    \
      "run.transient it takes in the time before the start, without load")

/* Every section, inner ones before those that hold them: S(noun, rows). */
#define SCENARIO_SECTIONS(S)                  \
    S(solver, SCENARIO_SOLVER_KEYS)           \
    S(run, SCENARIO_RUN_KEYS)                 \
    S(hull, SCENARIO_HULL_KEYS)               \
    SCENARIO_STATION_SECTIONS(S)              \
    SCENARIO_PROPULSION_SECTIONS(S)           \
    SCENARIO_WASH_SECTIONS(S)                 \
    SCENARIO_WATER_SECTIONS(S)                \
    S(vessel, SCENARIO_VESSEL_KEYS)           \
    S(friction, SCENARIO_FRICTION_KEYS)       \
    S(fracture, SCENARIO_FRACTURE_KEYS)       \
    S(floe, SCENARIO_FLOE_KEYS)               \
    S(opening, SCENARIO_OPENING_KEYS)         \
    S(population, SCENARIO_POPULATION_KEYS)   \
    S(level, SCENARIO_LEVEL_KEYS)             \
    S(strength, SCENARIO_STRENGTH_KEYS)       \
    S(ice, SCENARIO_ICE_KEYS)                 \
    S(domain, SCENARIO_DOMAIN_KEYS)           \
    S(ice_drag, SCENARIO_ICE_DRAG_KEYS)       \
    S(hull_drag, SCENARIO_HULL_DRAG_KEYS)     \
    S(environment, SCENARIO_ENVIRONMENT_KEYS) \
    S(output, SCENARIO_OUTPUT_KEYS)

#endif
