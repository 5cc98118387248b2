#!/usr/bin/env bash
# Keys that were set and decide nothing: each is told with its reason, and changes nothing indeed; others are not told.
. "$FRAM_SOURCE/tests/cli/slips.sh"

cat >field.yaml <<'YAML'
run: {duration: 0.2, time_step: 0.02}
vessel: {mode: towed, x: -60, speed: 2, hull: {form: icebreaker, length: 60, beam: 14, draught: 4}}
ice: {mean_floe_area: 200, thickness: 0.7, concentration: 0.7}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: open}
output: {frame_interval: 0}
YAML
sed 's/^ice.*/ice: {source: level, breakable: true, level: {x_min: -29}}/' field.yaml >level.yaml
cat >fleet.yaml <<'YAML'
run: {duration: 0.2, time_step: 0.02}
vessels:
  - {name: one, mode: free, hull: {length: 60, beam: 14, draught: 4}, positioning: {frequency: 0.2}}
  - {name: two, mode: free, x: 90, hull: {length: 60, beam: 14, draught: 4}, approach: {look_ahead: 20},
     positioning: {frequency: 0.2, damping: 0.7}}
ice: {source: none}
domain: {x_min: -200, x_max: 200, y_min: -100, y_max: 100, boundary: open}
environment: {current_speed: 0.5}
YAML

hash_of() { # SCENE OPTIONS...
    "$FRAM" run "$@" -o of_it --force --quiet 2>err || fail "run of $*: $(cat err)"
    grep -o '"state_hash": *"[0-9a-f]*"' of_it/run.json
}
# idle SCENE KEY=VALUE WORDS: told so, with these words, and the same bits as without
idle() {
    told "$1" "${2%%=*}|: without effect, since $3" --set "$2"
    same "$(hash_of "$1" --set "$2")" "$before" "state after $2"
}
silent() { # SCENE OPTIONS...
    expect 0 "$FRAM" check "$@"
    grep 'without effect' err && fail "told of $*"
    return 0
}

silent field.yaml
before=$(hash_of field.yaml)
idle field.yaml run.solver.most_iterations=7 "run.solver.kind is not accurate"
before=$(hash_of field.yaml --set run.solver.kind=accurate)
told field.yaml "run.solver.iterations|: without effect, since run.solver.kind is accurate" \
    --set run.solver.kind=accurate --set run.solver.iterations=7
same "$(hash_of field.yaml --set run.solver.kind=accurate --set run.solver.iterations=7)" "$before" "sweeps"
before=$(hash_of field.yaml)
idle field.yaml ice.level.tile_size=9 "ice.source is not level"
idle field.yaml ice.file_scale=2 "ice.source is not file"
idle field.yaml ice.strength.correlation_length=3 "neither strength varies"
idle field.yaml ice.sleep_time=1 "ice.sleep_speed is 0"
idle field.yaml ice.fracture.wedges=5 "ice.breakable is false"
idle field.yaml domain.band=20 "no field of floes is fed"
idle field.yaml domain.tile_x=500 "no field of floes is fed"
idle field.yaml domain.drift_direction_deg=30 "there is no domain.drift_speed"
idle field.yaml domain.wall_height=5 "domain.boundary is not walls"
idle field.yaml vessel.hull.piece_distance=0.3 "hull.form is not file"
idle field.yaml vessel.hull.transom=0.2 "hull.form is not ship"
idle field.yaml vessel.mooring.turret=true "there are no mooring.lines"
idle field.yaml vessel.positioning.observer=kalman "positioning.active is false"
idle field.yaml vessel.propulsion.astern=0.3 "there is no propulsion.bollard_pull"
idle field.yaml vessel.propulsion.pattern.forecast=true "there is no propulsion.bollard_pull"
idle field.yaml vessel.approach.limit=20 "there is no other vessel"
idle field.yaml vessel.fender_stiffness=1e7 "there is neither another vessel nor a wall"
idle field.yaml vessel.wash.reach=20 "wash.active is false"
idle field.yaml vessel.hydrodynamics.roll_damping=0.9 "hydrodynamics.source is not estimate"
idle field.yaml vessel.hydrodynamics.axes=down "hydrodynamics.source is not given"
idle field.yaml vessel.hydrodynamics.z=-2 "hydrodynamics.source is not given"
idle field.yaml ice.cap_ice_wall=true "domain.boundary is not walls"
idle field.yaml ice.friction.ice_wall_static=0.9 "domain.boundary is not walls"
idle field.yaml ice.friction.hull_wall_static=0.9 "domain.boundary is not walls"
idle field.yaml ice.friction.hull_hull_static=0.9 "there is no other vessel"
idle field.yaml ice.fracture.brash=true "ice.breakable is false"
idle field.yaml environment.wind_direction_deg=30 "there is no environment.wind_speed"
idle field.yaml environment.current_direction_deg=30 "there is no environment.current_speed"
# These are part of the state.
for key in flexural_strength=6e5 elastic_modulus=4e9 poisson_ratio=0.33 strength.flexural_variation=0.2; do
    told field.yaml "ice.${key%=*}: without effect, since ice.breakable is false" --set ice.$key
done
told field.yaml "vessel.gyration_yaw: without effect, since mode is not free" --set vessel.gyration_yaw=16
told field.yaml "vessel.course_deg: without effect, since speed is 0" --set vessel.course_deg=20 --set vessel.speed=0
told field.yaml "run.solver.tolerance: without effect, since run.solver.kind is sequential" \
    --set run.solver.tolerance=1e-5 --set run.solver.kind=sequential

sed 's/mode: towed/mode: prescribed/' field.yaml >driven.yaml
before=$(hash_of driven.yaml)
idle driven.yaml environment.hull_drag.water_form=0.5 "there is no vessel of mode towed or free"
idle driven.yaml vessel.wind_coefficients.frontal_area=60 "mode is prescribed"
for key in mass=3e6 gyration_roll=5 hydrodynamics.source=estimate; do
    told driven.yaml "vessel.${key%=*}: without effect, since mode is" --set vessel.$key
done

# Without water nothing flows, but for a current that is the drift of an endless field.
sed 's/^domain/environment: {water: false}\n&/' field.yaml >dry.yaml
before=$(hash_of dry.yaml)
for key in current_speed=0.5 current_direction_deg=30 current_file=drift.csv wind_speed=20 wind_direction_deg=30 \
    wind_file=drift.csv air_density=1.3 floe_added_mass=true floe_damping=0.5 ice_drag.water_skin=0.05 \
    hull_drag.water_form=0.5; do
    printf 'time[s],x[m/s],y[m/s]\n0,0.4,0\n' >drift.csv
    idle dry.yaml environment.$key "environment.water is false"
done
told dry.yaml "vessel.propulsion.propeller_z: without effect, since environment.water is false" \
    --set vessel.mode=free --set vessel.propulsion.bollard_pull=5e5 --set vessel.propulsion.propeller_z=-3
silent dry.yaml --set domain.boundary=feeding --set environment.current_speed=0.5
told dry.yaml "environment.current_speed: without effect" --set domain.boundary=feeding --set domain.drift_speed=0.2 \
    --set environment.current_speed=0.5

before=$(hash_of level.yaml)
idle level.yaml ice.concentration=0.3 "no floes are drawn"
idle level.yaml ice.mean_floe_area=30 "floes are not cells of ice.source voronoi"
idle level.yaml ice.roundness=0.5 "ice.source is not voronoi"
told level.yaml "ice.fracture.splitting_factor: without effect, since ice.fracture.splitting is not length" \
    --set ice.fracture.splitting=toughness --set ice.fracture.splitting_factor=4
told level.yaml "ice.fracture.toughness: without effect, since ice.fracture.splitting is not toughness" \
    --set ice.fracture.toughness=1e5
told level.yaml "ice.fracture.narrowness: without effect, since ice.fracture.splitting is none" \
    --set ice.fracture.splitting=none --set ice.fracture.narrowness=5

# Edges that are loaded, of level ice.
cat >edges.yaml <<'YAML'
run: {duration: 2, time_step: 0.02}
vessel: {mode: towed, x: -17, speed: 2, ramp: 0, hull: {length: 30, beam: 8, draught: 3, freeboard: 1}}
ice: {source: level, thickness: 0.4, breakable: true, top_plane_area: true, level: {x_min: 0}}
domain: {x_min: -50, x_max: 40, y_min: -30, y_max: 30, boundary: open}
output: {frame_interval: 0}
YAML
before=$(hash_of edges.yaml)
for key in compliance elastic inertia; do
    idle edges.yaml ice.fracture.edge_$key=false "edges do not give with ice.top_plane_area"
done
told edges.yaml "ice.fracture.edge_gaps and 1 more: without effect, since edges do not give" \
    --set ice.fracture.edge_gaps=false --set ice.fracture.edge_melts=false

before=$(hash_of edges.yaml --set ice.top_plane_area=false --set ice.fracture.edge_compliance=false)
rigid=(--set ice.fracture.edge_compliance=false --set ice.top_plane_area=false)
for key in elastic inertia; do
    same "$(hash_of edges.yaml "${rigid[@]}" --set ice.fracture.edge_$key=false)" "$before" "state after edge_$key"
done
told edges.yaml "ice.fracture.edge_elastic and 3 more: without effect, since ice.fracture.edge_compliance is false" \
    "${rigid[@]}" --set ice.fracture.edge_elastic=false --set ice.fracture.edge_gaps=false \
    --set ice.fracture.edge_melts=false --set ice.fracture.edge_inertia=false
told edges.yaml "ice.fracture.edge_melts: without effect, since ice.fracture.edge_elastic is false" \
    --set ice.top_plane_area=false --set ice.fracture.edge_elastic=false --set ice.fracture.edge_melts=false

# Friction melts them where a hull slides along that is not led.
sed 's/top_plane_area: true, //; s/duration: 2/duration: 4/; s/hull: {/&form: icebreaker, /' edges.yaml >melting.yaml
silent melting.yaml --set ice.fracture.edge_melts=false
silent melting.yaml --set ice.fracture.latent_heat=2e5
[ "$(hash_of melting.yaml --set ice.fracture.latent_heat=2e5)" != "$(hash_of melting.yaml)" ] || fail "nothing melts"
sed 's/mode: towed/mode: prescribed/' melting.yaml >led.yaml
before=$(hash_of led.yaml)
idle led.yaml ice.fracture.edge_melts=false "there is no vessel of mode towed or free"
idle led.yaml ice.fracture.latent_heat=2e5 "friction melts no edge"
sed 's/breakable: true,/& friction: {ice_hull_static: 0, ice_hull_kinetic: 0},/' melting.yaml >slippery.yaml
before=$(hash_of slippery.yaml)
idle slippery.yaml ice.fracture.edge_melts=false "ice.friction.ice_hull_kinetic is 0"
idle slippery.yaml ice.fracture.latent_heat=2e5 "friction melts no edge"
told melting.yaml "ice.fracture.latent_heat: without effect, since friction melts no edge" \
    --set ice.fracture.edge_melts=false --set ice.fracture.latent_heat=2e5

told edges.yaml "ice.correct_unbreakable: without effect, since all ice may break" --set ice.correct_unbreakable=true
silent edges.yaml --set ice.breakable=false --set ice.correct_unbreakable=true
silent edges.yaml --set ice.top_plane_area=false --set ice.fracture.edge_elastic=false
# The same of ice that floats.
sed 's/^ice.*/ice: {concentration: 0.8, mean_floe_area: 200, thickness: 0.4, breakable: true}/' edges.yaml >afloat.yaml
before=$(hash_of afloat.yaml)
keys=(--set ice.crush_trims=false)
for key in edge_compliance edge_elastic edge_gaps edge_melts edge_inertia under_pieces; do
    keys+=(--set "ice.fracture.$key=false")
done
same "$(hash_of afloat.yaml "${keys[@]}")" "$before" "state of ice that floats"
for key in ice.crush_trims "ice.fracture.edge_compliance and 4 more" ice.fracture.under_pieces; do
    told afloat.yaml "$key: without effect, since there is neither level ice nor a fixed floe" "${keys[@]}"
done
# So does what the band of an endless field drives, with nothing but floes to break it.
printf 'time[s],x[m/s],y[m/s]\n0,2,0\n4,-1,2\n8,-2,-2\n12,2,1\n' >turn.csv
cat >fed.yaml <<'YAML'
run: {duration: 12, time_step: 0.05, seed: 5}
vessel: {present: false}
ice: {concentration: 0.85, mean_floe_area: 60, thickness: 0.2, size_deviation: 0.8, breakable: true}
domain: {x_min: -40, x_max: 40, y_min: -25, y_max: 25, boundary: feeding, drift_file: turn.csv}
YAML
before=$(hash_of fed.yaml)
same "$(wc -l <of_it/fractures.csv)" 1 "lines of breaks without a vessel"
same "$(hash_of fed.yaml "${keys[@]}")" "$before" "state of a band that floats"
told fed.yaml "ice.fracture.under_pieces: without effect, since there is neither" --set ice.fracture.under_pieces=false

# Of populations and listed floes each by itself.
cat >packed.yaml <<'YAML'
run: {duration: 0.2, time_step: 0.02}
vessel: {present: false}
ice: {source: packed, concentration: 0.3, populations: [{diameter_min: 5, diameter_max: 15}, {size: constant}]}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: open}
YAML
sed 's/^ice.*/ice: {source: floes, floes: [{}, {x: 20, shape: regular}]}/' packed.yaml >floes.yaml
silent packed.yaml
silent packed.yaml --set "ice.populations[0].exponent=2" --set "ice.populations[1].diameter=12"
silent packed.yaml --set ice.smallest_floe_area=20 --set ice.breakable=true
silent packed.yaml --set ice.smallest_floe_area=20 --set domain.boundary=feeding
before=$(hash_of packed.yaml)
idle packed.yaml ice.smallest_floe_area=20 "packed floes are made as drawn, and none may break"
before=$(hash_of floes.yaml)
idle floes.yaml ice.smallest_floe_area=2000 "listed floes are made as given, and none may break"
silent floes.yaml --set ice.smallest_floe_area=20 --set ice.breakable=true
told packed.yaml "ice.populations[0].diameter: without effect, since size is neither constant nor lognormal" \
    --set "ice.populations[0].diameter=12"
told packed.yaml "ice.populations[1].diameter_max: without effect, since size is neither uniform" \
    --set "ice.populations[1].diameter_max=30"
told packed.yaml "ice.populations[1].exponent: without effect, since size is not power" \
    --set "ice.populations[1].exponent=2"
told packed.yaml "ice.populations[1].diameter_deviation: without effect, since size is not lognormal" \
    --set "ice.populations[1].diameter_deviation=2"
told packed.yaml "ice.populations[0].flexural_strength: without effect, since ice.breakable is false" \
    --set "ice.populations[0].flexural_strength=4e5"
told packed.yaml "ice.populations[0].breakable: without effect, since ice.breakable is false" \
    --set "ice.populations[0].breakable=false"
told packed.yaml "ice.fracture.wedges and 1 more: without effect, since no population of the ice is breakable" \
    --set ice.fracture.wedges=5 --set ice.fracture.sharing=equal --set ice.breakable=true \
    --set "ice.populations[0].breakable=false" --set "ice.populations[1].breakable=false"
told packed.yaml "ice.keep_out_margin: without effect, since no field is laid round a vessel" \
    --set ice.keep_out_margin=3
told packed.yaml "ice.friction.ice_hull_static: without effect, since there is no vessel" \
    --set ice.friction.ice_hull_static=0.2
# The length of an endless field goes by the populations, of an observed one by the key.
sed 's/boundary: open/boundary: feeding, drift_speed: 0.5/' packed.yaml >fed.yaml
before=$(hash_of fed.yaml)
idle fed.yaml ice.mean_floe_area=9000 "floes are not cells"
echo 'POLYGON ((0 0, 20 0, 0 20, 0 0))' >seen.wkt
sed 's/^ice.*/ice: {source: file, file: seen.wkt}/' fed.yaml >seen.yaml
silent seen.yaml --set ice.mean_floe_area=9000
silent floes.yaml
silent floes.yaml --set "ice.floes[0].length=12" --set "ice.floes[1].sides=8"
told floes.yaml "ice.floes[0].radius: without effect, since shape is rectangle" --set "ice.floes[0].radius=6"
told floes.yaml "ice.floes[1].width: without effect, since shape is regular" --set "ice.floes[1].width=6"
sed 's/source: packed/source: voronoi/; s/, {size: constant}//' packed.yaml >cells.yaml
told cells.yaml "ice.populations[0].elongation: without effect, since with ice.source voronoi" \
    --set "ice.populations[0].elongation=2"

# Of floes that touch.
sed 's/0.2,/0.4,/; s/^ice.*/ice: {source: floes, floes: [{velocity_x: 1, spin: 0.1}, {x: 10.05, fixed: true}]}/' \
    packed.yaml >touch.yaml
before=$(hash_of touch.yaml)
idle touch.yaml ice.fracture.under_ice_contacts=true "ice.breakable is false"
told touch.yaml "ice.fracture.under_ice_contacts: without effect, since ice.cap_ice_ice is false" \
    --set ice.breakable=true --set ice.cap_ice_ice=false --set ice.fracture.under_ice_contacts=true
silent touch.yaml --set ice.breakable=true --set ice.fracture.under_ice_contacts=true \
    --set ice.fracture.edge_elastic=false
idle touch.yaml "ice.floes[1].velocity_y=2" "fixed is true"
idle touch.yaml "ice.floes[1].spin=2" "fixed is true"

sed 's/form: icebreaker/form: box/; s/^domain/environment: {current_file: drift.csv}\n&/' field.yaml >box.yaml
printf 'time[s],x[m/s],y[m/s]\n0,0.4,0\n' >drift.csv
before=$(hash_of box.yaml)
for key in stem_angle_deg=40 entrance_angle_deg=40 flare_angle_deg=20 stern_angle_deg=40 parallel_midbody=0.3; do
    idle box.yaml vessel.hull.$key "hull.form is box"
done
idle box.yaml environment.current_speed=3 "environment.current_file tells the current"
idle box.yaml environment.current_direction_deg=30 "environment.current_file tells the current"
# Beside a speed that the file replaces, too; the same of winds and of drift.
told box.yaml "environment.current_direction_deg: without effect, since environment.current_file tells" \
    --set environment.current_speed=3 --set environment.current_direction_deg=30
for speed in 0 3; do
    told box.yaml "environment.wind_direction_deg: without effect, since environment.wind_file tells the wind" \
        --set environment.wind_file=drift.csv --set environment.wind_direction_deg=30 \
        --set environment.wind_speed=$speed
done
told fed.yaml "domain.drift_direction_deg: without effect, since domain.drift_file tells the drift" \
    --set domain.drift_speed=auto --set domain.drift_file=drift.csv --set domain.drift_direction_deg=30
idle box.yaml vessel.station.offset_limit=0.1 "mode is not free"
idle box.yaml vessel.mooring.equilibrium=false "there are no mooring.lines"
idle box.yaml vessel.wind_coefficients.frontal_area=90 "wind_coefficients has no table"
idle box.yaml vessel.current_coefficients.z=-2 "current_coefficients has no table"
sed 's/form: icebreaker/form: cone/; s/length: 60/flare_angle_deg: 45, length: 14/' field.yaml >cone.yaml
before=$(hash_of cone.yaml)
for key in stem_angle_deg=40 entrance_angle_deg=40 stern_angle_deg=40 parallel_midbody=0.3 block_coefficient=0.5; do
    idle cone.yaml vessel.hull.$key "hull.form is cone"
done

# Of lines and thrusters each by itself, by its kind.
item() { # KEY WORDS OPTIONS...
    told ship.yaml "vessel.$1: without effect, since $2" --set "vessel.$1=5" "${@:3}"
}
silent ship.yaml
item "mooring.lines[0].weight" "kind is not catenary" --set "vessel.mooring.lines[0].kind=spring"
item "mooring.lines[0].spacing_deg" "count is 1" --set "vessel.mooring.lines[0].count=1"
told ship.yaml "vessel.mooring.lines[0].pretension: without effect, since there is a length" \
    --set "vessel.mooring.lines[0].length=915"
item "thrusters[1].thrust_astern" "kind is azimuth"
item "thrusters[1].rudder_deg" "kind is not main"
item "thrusters[1].forbidden_width_deg" "kind is not azimuth" --set "vessel.thrusters[1].kind=main"
item "thrusters[1].turn_rate_deg" "kind is tunnel" --set "vessel.thrusters[1].kind=tunnel"
item "thrusters[1].direction_deg" "kind is tunnel" --set "vessel.thrusters[1].kind=tunnel"
item "thrusters[1].cost" "positioning.active is false"
item "thrusters[1].diameter" "wash.active is false"
told ship.yaml "vessel.thrusters[1].setting: without effect, since positioning.active is true" \
    --set "vessel.thrusters[1].setting=0.5" --set vessel.positioning.active=true
points="waypoints: [{time: 20, x: 5, y: 2, heading_deg: 30}, {time: 40, x: 9}]"
sed "s/^  thrusters/  positioning: {active: true, control: heading, $points}\n&/" ship.yaml >points.yaml
told points.yaml "vessel.positioning.waypoints[0].x and 2 more: without effect, since positioning.control heading"
# Without lines too: no sentence says that lines hold it.
sed "/mooring:/,/breaking_load/d" points.yaml >adrift.yaml
told adrift.yaml "waypoints[0].x and 2 more: without effect|positioning.control heading leaves the place to lines"
told points.yaml "waypoints: the vessel is not steered there|its heading's deviation counts from them" \
    --set vessel.positioning.active=false
grep 'positioning.control: without effect' err && fail "what offsets count from goes by the control"
silent points.yaml --set vessel.positioning.control=all
told fleet.yaml "vessels[1].propulsion.pattern.distance: without effect, since the way ahead has none" \
    --set vessels.two.propulsion.bollard_pull=5e5 --set vessels.two.propulsion.pattern.kind=ahead \
    --set vessels.two.propulsion.pattern.distance=90 --set vessels.two.positioning.frequency=0.1 \
    --set vessels.two.positioning.damping=1

# Some of one section in one sentence, of each vessel by itself.
told field.yaml "vessel.positioning.frequency and 1 more: without effect" \
    --set vessel.positioning.frequency=0.2 --set vessel.positioning.damping=0.7
told fleet.yaml "vessels[0].positioning.frequency: without effect"
told fleet.yaml "vessels[1].positioning.frequency and 1 more: without effect"
told fleet.yaml "vessels[1].approach.look_ahead: without effect, since there is no approach.limit"
told fleet.yaml "vessels[1].propulsion.propeller_spacing: without effect, since wash.active is false" \
    --set vessels.two.propulsion.bollard_pull=5e5 --set vessels.two.propulsion.propeller_spacing=5 \
    --set vessels.two.propulsion.propellers=2 --set vessels.two.propulsion.propeller_z=-2
told fleet.yaml "vessels[1].propulsion.propeller_spacing: without effect, since propulsion.propellers is 1" \
    --set vessels.two.propulsion.bollard_pull=5e5 --set vessels.two.wash.active=true \
    --set vessels.two.propulsion.propeller_spacing=5
told fleet.yaml "vessels[1].propulsion.speed: without effect, since propulsion.pattern.period gives the speed" \
    --set vessels.two.propulsion.bollard_pull=5e5 --set vessels.two.propulsion.pattern.kind=circle \
    --set vessels.two.propulsion.pattern.period=600 --set vessels.two.propulsion.speed=3
told fleet.yaml "vessels[1].propulsion.pattern.period: without effect, since propulsion.pattern.kind is none" \
    --set vessels.two.propulsion.bollard_pull=5e5 --set vessels.two.propulsion.pattern.period=600 \
    --set vessels.two.propulsion.speed=3
grep 'propulsion.speed: without effect' err && fail "a period without a pattern gives the speed"

# What has an effect, and what says no more than its default.
silent field.yaml --set vessel.mooring.z=-3
silent ship.yaml --set "vessel.mooring.lines[0].kind=spring" --set "vessel.mooring.lines[0].weight=1000" \
    --set "vessel.mooring.lines[0].stiffness=5e4"
silent ship.yaml --set "vessel.thrusters[0].kind=main" --set "vessel.thrusters[0].rudder_deg=30" \
    --set "vessel.thrusters[0].direction_deg=20" --set "vessel.thrusters[0].setting=0.5"
silent ship.yaml --set vessel.positioning.active=true --set "vessel.thrusters[0].direction_deg=20" \
    --set "vessel.thrusters[0].cost=2" --set vessel.station.offset_limit=5
silent box.yaml --set vessel.hull.form=cone --set vessel.hull.length=14 --set vessel.hull.flare_angle_deg=45
silent field.yaml --set ice.sleep_speed=0.1 --set ice.sleep_time=1
silent field.yaml --set ice.strength.crushing_variation=0.2 --set ice.strength.correlation_length=3
silent field.yaml --set ice.breakable=true --set ice.strength.flexural_variation=0.2 --set ice.elastic_modulus=4e9
silent field.yaml --set ice.rafting_edge_angle_deg=45 --set ice.flexural_strength=4e5
silent field.yaml --set environment.current_speed=0.2 --set environment.current_direction_deg=20
silent field.yaml --set domain.boundary=walls --set ice.cap_ice_wall=true --set vessel.fender_stiffness=1e7
silent field.yaml --set domain.boundary=feeding --set domain.band=20 --set vessel.x=-40
sed 's/, positioning: {frequency: 0.2}//; s/, approach.*/}/; /^ *positioning/d' fleet.yaml >pair.yaml
silent pair.yaml --set vessels.two.approach.limit=50 --set vessels.two.approach.look_ahead=20 \
    --set ice.friction.hull_hull_static=0.3
silent field.yaml --set vessel.mode=prescribed --set vessel.ramp=1
silent field.yaml --set ice.sleep_time=5 --set vessel.wash.reach=50 --set run.solver.most_iterations=10000
silent field.yaml --set vessel.present=false --set vessel.wash.reach=20
told field.yaml "ice.sleep_time: without effect" --set vessel.present=false --set ice.sleep_time=1
told field.yaml "vessel.ramp: without effect, since mode is free" --set vessel.mode=free --set vessel.ramp=1
