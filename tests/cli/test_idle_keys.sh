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
idle field.yaml vessel.approach.look_ahead=20 "there is no approach.limit"
idle field.yaml vessel.wash.reach=20 "wash.active is false"
idle field.yaml vessel.hydrodynamics.roll_damping=0.9 "hydrodynamics.source is not estimate"
idle field.yaml vessel.hydrodynamics.axes=down "hydrodynamics.source is not given"

before=$(hash_of level.yaml)
idle level.yaml ice.concentration=0.3 "no floes are drawn"
idle level.yaml ice.mean_floe_area=30 "floes are not cells of ice.source voronoi"
idle level.yaml ice.roundness=0.5 "ice.source is not voronoi"

sed 's/form: icebreaker/form: box/; s/^domain/environment: {current_file: drift.csv}\n&/' field.yaml >box.yaml
printf 'time[s],x[m/s],y[m/s]\n0,0.4,0\n' >drift.csv
before=$(hash_of box.yaml)
for key in stem_angle_deg=40 entrance_angle_deg=40 flare_angle_deg=20 stern_angle_deg=40 parallel_midbody=0.3; do
    idle box.yaml vessel.hull.$key "hull.form is box"
done
idle box.yaml environment.current_speed=3 "environment.current_file tells the current"
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
told ship.yaml "vessel.thrusters[1].setting: without effect, since positioning.active is true" \
    --set "vessel.thrusters[1].setting=0.5" --set vessel.positioning.active=true
told fleet.yaml "vessels[1].propulsion.pattern.distance: without effect, since the way ahead has none" \
    --set vessels.two.propulsion.bollard_pull=5e5 --set vessels.two.propulsion.pattern.kind=ahead \
    --set vessels.two.propulsion.pattern.distance=90 --set vessels.two.positioning.frequency=0.1 \
    --set vessels.two.positioning.damping=1

# Some of one section in one sentence, of each vessel by itself.
told field.yaml "vessel.positioning.frequency and 1 more: without effect" \
    --set vessel.positioning.frequency=0.2 --set vessel.positioning.damping=0.7
told fleet.yaml "vessels[0].positioning.frequency: without effect"
told fleet.yaml "vessels[1].positioning.frequency and 1 more: without effect"
told fleet.yaml "vessels[1].approach.look_ahead: without effect"

# What has an effect, and what says no more than its default.
silent field.yaml --set ice.fracture.under_ice_contacts=true
silent field.yaml --set vessel.mooring.z=-3
silent ship.yaml --set "vessel.mooring.lines[0].kind=spring" --set "vessel.mooring.lines[0].weight=1000" \
    --set "vessel.mooring.lines[0].stiffness=5e4"
silent ship.yaml --set "vessel.thrusters[0].kind=main" --set "vessel.thrusters[0].rudder_deg=30" \
    --set "vessel.thrusters[0].direction_deg=20" --set "vessel.thrusters[0].setting=0.5"
silent ship.yaml --set vessel.positioning.active=true --set "vessel.thrusters[0].direction_deg=20" \
    --set "vessel.thrusters[0].cost=2" --set vessel.station.offset_limit=5
silent box.yaml --set vessel.hull.form=cone --set vessel.hull.length=14 --set vessel.hull.flare_angle_deg=45
silent field.yaml --set ice.sleep_speed=0.1 --set ice.sleep_time=1
silent field.yaml --set ice.strength.flexural_variation=0.2 --set ice.strength.correlation_length=3
silent field.yaml --set domain.boundary=feeding --set domain.band=20
silent field.yaml --set vessel.approach.limit=50 --set vessel.approach.look_ahead=20
silent field.yaml --set vessel.mode=prescribed --set vessel.ramp=1
silent field.yaml --set ice.sleep_time=5 --set vessel.wash.reach=50 --set run.solver.most_iterations=10000
silent field.yaml --set vessel.present=false --set vessel.wash.reach=20
told field.yaml "ice.sleep_time: without effect" --set vessel.present=false --set ice.sleep_time=1
told field.yaml "vessel.ramp: without effect, since mode is free" --set vessel.mode=free --set vessel.ramp=1
