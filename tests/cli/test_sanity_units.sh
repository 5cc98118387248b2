#!/usr/bin/env bash
# Sixty more slips of a pen, in the ice, the controller, the gear and the files: each is told with key and remedy.
. "$FRAM_SOURCE/tests/cli/slips.sh"

cat >towed.yaml <<'YAML'
run: {duration: 60, time_step: 0.01}
vessel: {mode: towed, speed: 1, hull: {form: icebreaker, length: 60, beam: 14, draught: 4}}
ice: {mean_floe_area: 200, thickness: 0.7, concentration: 0.5}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: open}
YAML
sed 's/speed: 1, /path: [{time: 0, x: 0}, {time: 60, x: 60}], /' towed.yaml >path.yaml
sed 's/towed, speed: 1,/free, propulsion: {bollard_pull: 8.0e5, speed: 1},/' towed.yaml >drive.yaml
sed 's/^ice:.*/ice: {source: floes, floes: [{x: 50, length: 20, width: 20}]}/' towed.yaml >floes.yaml
sed 's/^ice:.*/ice: {source: packed, populations: [{size: lognormal, diameter: 20}]}/' towed.yaml >packed.yaml
sed 's/^ice: {.*thickness/ice: {source: level, breakable: true, thickness/' ship.yaml >level.yaml
sed 's/^vessel:/&\n  positioning: {active: true}\n  station: {offset_limit: 5}/' ship.yaml >held.yaml
for scene in towed path drive floes packed level held; do
    expect 0 "$FRAM" check $scene.yaml
    grep '^warning' err && fail "a warning without reason of $scene"
done

# all_told SCENE OPTIONS... -- WORDS...: each slip of the options has its warning, with the words between the bars
all_told() {
    local scene=$1 words options=()
    shift
    while [ "$1" != -- ]; do
        options+=(--set "$1")
        shift
    done
    shift
    expect 0 "$FRAM" check "$scene" "${options[@]}"
    same "$(grep -c '^warning' err)" "$#" "warnings of ${options[*]}: $(grep '^warning' err)"
    for words in "$@"; do
        grep '^warning' err | grep -F -- "${words%%|*}" | grep -qF -- "${words##*|}" ||
            fail "not told \"$words\" of ${options[*]}: $(grep '^warning' err)"
    done
}

# Ice: sizes that are left out, the material, the sheet.
all_told ship.yaml run.scale=1000 -- "run.scale: 1000 is outside|30 for full size" \
    "ice.smallest_floe_area: 200 m2 is 1 of the mean floe|run.scale (1000)" "ice.edge_threshold: edges under 5 m"
all_told ship.yaml ice.smallest_floe_area=100 ice.smallest_piece_area=50 ice.edge_threshold=2 domain.band=0.2 \
    domain.tile_x=100 domain.tile_y=200 ice.keep_out_margin=200 -- \
    "smallest_floe_area: 100 m2 is 0.5 of the mean floe" "smallest_piece_area: 50 m2" \
    "edge_threshold: edges under 2 m" \
    "domain.band: 0.2 m is narrower than the mean floe's radius" "domain.tile_x: the field repeats itself after 100 m" \
    "domain.tile_y: the field repeats itself after 200 m" "keep_out_margin: 200 m round the vessel"
all_told ship.yaml ice.poisson_ratio=0.03 ice.crushing_exponent=0.5 ice.friction.ice_hull_static=6 \
    ice.friction.ice_hull_kinetic=6 ice.crushing_strength=4e5 ice.strength.correlation_length=0.01 \
    ice.strength.flexural_variation=1.5 ice.ridging_resistance=400 ice.breakable=true -- \
    "poisson_ratio: 0.03 is outside|about 0.3" \
    "crushing_exponent: 0.5|falls with the area" "ice_hull_static: 6 is|not an angle" "ice_hull_kinetic: 6 is" \
    "crushing_strength: 4e+05 Pa on 1 m2|is less than the flexural strength, 5e+05 Pa" "correlation_length: 0.01 m" \
    "flexural_variation: 1.5|not per cent" "ridging_resistance: 400 MN/m|R is 2 to 10"
all_told ship.yaml ice.poisson_ratio=0 ice.ridging_resistance=0 ice.breakable=true -- \
    "poisson_ratio: 0 is outside of 0.2 to 0.45|about 0.3"
# A pressure that goes with the area is that on the thickness squared: 0.49 m2 here, 9 cm2 of a tank.
all_told ship.yaml ice.crushing_exponent=-0.5 ice.crushing_strength=2e5 ice.breakable=true -- \
    "crushing_strength: 2e+05 Pa on 1 m2, 2.857e+05 Pa on the thickness squared, 0.49 m2, is less than|swapped"
all_told ship.yaml ice.crushing_exponent=-0.5 ice.crushing_strength=4e5 ice.breakable=true --
all_told ship.yaml ice.crushing_exponent=-0.5 ice.crushing_strength=2e5 --
all_told ship.yaml ice.crushing_exponent=-0.5 ice.crushing_strength=2e4 ice.breakable=true -- \
    "crushing_strength: 20000 Pa on 1 m2, 2.857e+04 Pa on the thickness squared, 0.49 m2, is outside of 5e+04|kPa" \
    "crushing_strength: 2e+04 Pa on 1 m2|is less than the flexural strength, 5e+05 Pa"
cat >tank.yaml <<'YAML'
run: {duration: 2, time_step: 0.002, scale: 1}
vessel: {mode: towed, x: -1.5, speed: 0.4, hull: {length: 3, beam: 0.7, draught: 0.25, freeboard: 0.15}}
ice: {thickness: 0.03, crushing_strength: 2.0e+4, crushing_exponent: -0.5, mean_floe_area: 0.2, concentration: 0.8}
domain: {x_min: -4, x_max: 5, y_min: -2, y_max: 2}
YAML
all_told tank.yaml --
floe='{x: 3, length: 0.5, width: 0.5, velocity_y: -0.5, spin: -4}'
sed "s/mean_floe_area.*/source: floes, floes: [$floe]}/" tank.yaml >turning.yaml
all_told turning.yaml --
all_told tank.yaml ice.crushing_strength=500 ice.breakable=true -- "is less than the flexural strength"
all_told level.yaml ice.breakable=false ice.level.x_min=5000 ice.level.line_load=100 ice.level.mass=1000 -- \
    "ice.breakable: false makes a wall" "sheet begins 4840 m outside of the domain|no ice" \
    "line_load: 100 N/m|not kN/m" "level.mass: 1000 kg is less than that of the ice in the domain"
# Away from the domain, and past it; across its corner it comes in.
none="ice.level: the sheet begins 10 m outside of the domain, and drifts 240 m towards 180 degrees|will be no ice"
all_told level.yaml ice.level.x_max=-170 -- "$none"
all_told level.yaml ice.level.x_min=170 ice.level.y_min=170 -- "$none"
all_told level.yaml ice.level.x_min=170 ice.level.y_min=170 environment.current_direction_deg=225 --
# Whatever moves the vessel.
sed 's/propulsion: {[^}]*}/thrusters: [{x: -25, thrust: 2.0e5, setting: 1}]/' drive.yaml >thrust.yaml
for scene in path drive thrust; do
    sed 's/^ice:.*/ice: {source: level}/' $scene.yaml >wall.yaml
    told wall.yaml "ice.breakable: false makes a wall of level ice"
done
sed 's/^ice:.*/ice: {source: level}/' towed.yaml >wall.yaml
expect 0 "$FRAM" check wall.yaml --set vessel.speed=0
grep 'makes a wall' err && fail "a vessel that rests is told of a wall"
# Thrusters that are not set push nothing, but to way points.
sed 's/^ice:.*/ice: {source: level}/; s/, setting: 1//' thrust.yaml >wall.yaml
all_told wall.yaml -- "vessel.speed: neither vessel nor ice, water or wind moves"
sed 's/^vessel: {/&positioning: {active: true, waypoints: [{time: 0, x: 30}]}, /' wall.yaml >goes.yaml
told goes.yaml "ice.breakable: false makes a wall of level ice"
grep 'neither vessel nor ice' err && fail "a vessel that goes to way points is told to rest"
all_told level.yaml ice.level.line_load=2e5 ice.level.x_min=140 ice.level.mass=5e6 --
all_told level.yaml ice.level.line_load=2e5 ice.level.x_min=170 ice.level.x_max=190 ice.level.y_min=0 \
    ice.level.y_max=20 ice.level.mass=3e5 --
all_told level.yaml ice.level.line_load=2e5 ice.level.x_min=140 ice.level.mass=1e6 -- \
    "level.mass: 1e+06 kg is less than that of the ice in the domain"
law='{size: power, diameter_min: 2, diameter_max: 20, exponent: 1.7}'
sed "s/^ice:.*/ice: {source: voronoi, populations: [$law]}/" towed.yaml >cells.yaml
all_told cells.yaml ice.smallest_floe_area=8 -- \
    "smallest_floe_area: 8 m2, 3.19 m across, leaves out 0.56 of the floes|ice.populations[0]"
all_told cells.yaml ice.smallest_floe_area=3.3 --
all_told level.yaml ice.smallest_floe_area=1e-6 -- "smallest_floe_area: 1e-06 m2 keeps specks"
all_told level.yaml ice.smallest_floe_area=11 -- \
    "smallest_floe_area: 11 m2 is more than the pieces that break off|wedges of about 10.2 m2"
all_told level.yaml ice.smallest_floe_area=9 -- \
    "smallest_floe_area: 9 m2 is 0.88 of the pieces that break off|wedges of about 10.2 m2|take 1 m2 or less"
all_told level.yaml ice.smallest_floe_area=2.5 --
all_told level.yaml output.frame_interval=0 --
all_told floes.yaml "ice.floes[0].x=19" "ice.floes[0].velocity_y=20" "ice.floes[0].velocity_z=-20" \
    "ice.floes[0].spin=5" -- "ice.floes[0]: 211.1 m2 of the floe|inside the hull" "velocity_y: 20 m/s" \
    "velocity_z: -20 m/s" "spin: 5 rad/s|not deg/s"
# Over run.speed_limit, of 100 m/s, a run would end at once: the whole way counts, and the rim, 14.1 m off.
# too_fast KEY SPEED OPTIONS...
too_fast() {
    local key=$1 speed=$2 options=()
    for words in "${@:3}"; do options+=(--set "ice.floes[0].$words"); done
    expect 2 "$FRAM" check floes.yaml "${options[@]}"
    says "ice.floes[0].$key: expected a" err
    says "less than run.speed_limit, at which a run ends, 100 m/s, found $speed m/s" err
}
too_fast velocity_z 100 velocity_z=-100
too_fast velocity_y 103.923 velocity_x=60 velocity_y=-60.0001 velocity_z=60
too_fast spin 106.066 spin=-7.5
expect 0 "$FRAM" check floes.yaml --set "ice.floes[0].velocity_z=200" --set "ice.floes[0].fixed=true"
all_told floes.yaml "ice.floes[0].elevation=20" "ice.floes[0].length=0.02" -- \
    "elevation: its centre is 20 m above still water" "ice.floes[0]: 0.02 m is less than it is thick"
all_told floes.yaml "ice.floes[0].width=0.5" -- "ice.floes[0]: 0.5 m is less than it is thick, 1 m"
sed 's/{x: 50,[^}]*}/&, {x: 55, length: 20, width: 20}/' floes.yaml >heap.yaml
all_told heap.yaml -- "pairs of floes overlap at the start, as ice.floes[0] and ice.floes[1], by 300 m2"
all_told packed.yaml "ice.populations[0].diameter=90" "ice.populations[0].diameter_max=2000" \
    "ice.populations[0].thickness_deviation=20" "ice.populations[0].flexural_deviation=8e5" \
    "ice.populations[0].crushing_deviation=9e6" domain.y_max=-20 domain.y_min=-100 vessel.y=-60 \
    ice.breakable=true -- \
    "diameter: floes of 90 m do not fit" "thickness_deviation: 20 m is more than the mean" \
    "flexural_deviation: 8e+05 Pa" "crushing_deviation: 9e+06 Pa"
all_told packed.yaml "ice.populations[0].diameter=150" -- \
    "populations[0].diameter: the mean, 150 m, is outside of the sizes that are drawn|10 to 100 m"

# Of populations with strengths of their own those are judged, and ice.* where some floe takes it.
kinds='{size: constant, thickness: 0.2, flexural_strength: 3e5, crushing_strength: 5e5}'
sed "s/^ice:.*/ice: {source: packed, thickness: 3, breakable: true, populations: [$kinds]}/" towed.yaml >kinds.yaml
all_told kinds.yaml ice.flexural_strength=2e8 ice.crushing_strength=5 vessel.speed=0.01 \
    ice.strength.flexural_variation=0.1 ice.strength.correlation_length=0.5 --
own="ice.populations[0].crushing_strength: 2e+05 Pa"
all_told kinds.yaml "ice.populations[0].crushing_strength=2e5" ice.strength.flexural_variation=0.1 \
    ice.strength.correlation_length=0.1 -- "$own is less than the flexural strength, 3e+05 Pa" \
    "correlation_length: 0.1 m is less than the ice is thick, 0.2 m"
all_told kinds.yaml "ice.populations[0].crushing_strength=2e5" ice.crushing_exponent=-0.5 run.time_step=0.001 --
all_told kinds.yaml "ice.populations[0].crushing_strength=auto" ice.crushing_strength=2e5 -- \
    "ice.crushing_strength: 2e+05 Pa is less than the flexural strength of ice.populations[0], 3e+05 Pa"
sed 's/populations: \[/&{size: constant}, /' kinds.yaml >both.yaml
all_told both.yaml ice.crushing_strength=4e5 -- \
    "ice.crushing_strength: 4e+05 Pa is less than the flexural strength, 5e+05 Pa"
all_told both.yaml ice.crushing_strength=5 ice.flexural_strength=1 -- "crushing_strength: 5 Pa|not kPa" \
    "flexural_strength: 1 Pa|not kPa"
# What cannot break is not bent.
all_told kinds.yaml "ice.populations[0].crushing_strength=2e5" "ice.populations[0].breakable=false" --
all_told kinds.yaml "ice.populations[0].crushing_strength=2e5" ice.breakable=false -- \
    "ice.populations[0].flexural_strength: without effect"

# No water is left: the key that took it is named.
sed 's/^ice: {/&open_water: [{length: 900, width: 900}], /' towed.yaml >bare.yaml
expect 2 "$FRAM" run bare.yaml -o bare
says "bare.yaml:3:7: ice.open_water: no water is left for ice beside the vessels and the zones without ice" err
expect 2 "$FRAM" run towed.yaml -o bare --set ice.keep_out_margin=400
says "ice.keep_out_margin: no water is left for ice" err

# Control, thrusters, station.
all_told held.yaml vessel.positioning.interval=1000 vessel.positioning.sample_interval=0.001 \
    vessel.positioning.damping=0 vessel.positioning.mass_surge=5000 vessel.positioning.bias_time=1 \
    vessel.positioning.noise_position=20 -- "positioning.interval: 1000 s is longer than the run" \
    "sample_interval: 0.001 s is shorter than run.time_step" "damping: a controlled vessel of relative damping 0" \
    "mass_surge: 5000 kg is|about 6.73e+06 kg" "bias_time: 1 s|give seconds" "noise_position: 20 m is outside|metres" \
    "noise_position: a standard deviation of 20 m is more than station.offset_limit, 5 m"
all_told held.yaml vessel.positioning.interval=8 vessel.positioning.sample_interval=7 \
    vessel.positioning.mass_sway=6e9 \
    vessel.positioning.observer_bandwidth=20 vessel.positioning.noise_heading_deg=30 vessel.station.watch_x=500 \
    vessel.station.heading_limit_deg=0.26 vessel.station.offset_limit=150 -- \
    "positioning.interval: once in 8 s is too seldom|62.8 s" "positioning.sample_interval: once in 7 s is too seldom" \
    "mass_sway: 6e+09 kg is 891" "observer_bandwidth: 20 rad/s" "noise_heading_deg: 30 deg" \
    "watch_x: (500, 0) m is outside of a hull" "heading_limit_deg: 0.26 deg|not radians" \
    "offset_limit: 150 m is more than the depth|not a percentage"
all_told held.yaml vessel.positioning.frequency=0.001 -- "frequency: 0.001 rad/s is outside" \
    "run.duration: 600 s is less than one period of the controlled vessel"
# The slower the control is against its observer, the sooner calls are too seldom, and samples that are held.
all_told held.yaml vessel.positioning.frequency=0.0125 vessel.positioning.interval=22 \
    vessel.positioning.sample_interval=22 -- "positioning.interval: once in 22 s|an observer of 0.2 rad/s: take 8 s"
all_told held.yaml vessel.positioning.frequency=0.0125 vessel.positioning.interval=30 \
    vessel.positioning.sample_interval=30 vessel.positioning.observer=kalman -- "positioning.interval: once in 30 s"
all_told held.yaml vessel.positioning.frequency=0.0125 vessel.positioning.sample_interval=12 -- \
    "positioning.sample_interval: once in 12 s|take 5 s or less"
all_told ship.yaml "vessel.thrusters[0].power=1250" "vessel.thrusters[0].z=6" "vessel.thrusters[1].z=-60" \
    "vessel.thrusters[1].turn_rate_deg=0.1" "vessel.thrusters[0].time_constant=100" \
    "vessel.thrusters[1].failure_time=0.5" -- "power: 1250 W is 0.00625 W for each newton|not kW" \
    "thrusters[0].z: 6 m is above the water" "thrusters[1].z: -60 m is far below the hull" \
    "turn_rate_deg: 0.1 deg/s|not rad/s" "time_constant: 100 s" \
    "failure_time: it fails at 0.5 s, in the transient of 60 s"

# Mooring, hull, propulsion, motion.
all_told ship.yaml "vessel.mooring.lines[0].release_time=0.1" "vessel.mooring.lines[0].spacing_deg=0" \
    vessel.mooring.z=50 vessel.hull.freeboard=0.1 vessel.centre_of_gravity_z=0.5 -- \
    "release_time: it is let go at 0.1 s, in the transient of 60 s" "8 lines lie one upon another" \
    "mooring.z: fairleads 50 m above" "hull.freeboard: 0.1 m is outside" \
    "centre_of_gravity_z: 0.5 m is above the deck" "mooring.lines: the vessel capsizes unless their stiffness holds it"
all_told ship.yaml "vessel.mooring.lines[0].weight=5000" "vessel.mooring.lines[0].breaking_load=4e6" -- \
    "lines[0].weight: a line of 5000 N/m parts under 800 m of itself" "mooring.lines: they pull the vessel down"
# Power is that at the larger thrust of both.
all_told ship.yaml "vessel.thrusters[1].kind=tunnel" "vessel.thrusters[1].thrust=2.0e4" \
    "vessel.thrusters[1].thrust_astern=2.0e5" "vessel.thrusters[1].power=1.25e6" --
# A line of a model of 1:30 carries as many metres of itself as are 30 times as long at full size.
expect 0 "$FRAM" check ship.yaml --set run.scale=1 --set "vessel.mooring.lines[0].weight=5000" \
    --set "vessel.mooring.lines[0].breaking_load=1e6"
grep 'of itself' err && fail "the line of a model is told"
all_told towed.yaml vessel.hull.draught=0.5 vessel.speed=0.001 vessel.course_deg=120 vessel.x=500 \
    vessel.current_coefficients.frontal_area=0.01 -- "hull.draught: 0.5 m is 0.0357 of the beam" \
    "ice.thickness: 0.7 m is more than the draught" "vessel.speed: the vessel moves 0.06 m in the run" \
    "course_deg: the vessel is moved at 120 degrees to its bow" "(500, 0) m lies outside of the domain, 400 m" \
    "current_coefficients.frontal_area: 0.01 m2" \
    "current_coefficients.frontal_area: without effect"
all_told path.yaml "vessel.path[1].time=1" -- "vessel.path[1]: (60, 0) m is reached with 60 m/s" \
    "the vessel and the ice move 0.86 of its thickness past each other in a step at 60 m/s"
all_told path.yaml "vessel.path[1].time=3600" -- "vessel.path: it goes on to 3600 s, and the run ends at 60 s"
all_told path.yaml "vessel.path[1].heading_deg=3600" -- \
    "heading_deg: from 0 to 3600 degrees it turns with 60 deg/s, faster than vessels do"
all_told drive.yaml vessel.propulsion.steering_angle_deg=0.61 vessel.propulsion.steering_rate_deg=0.04 \
    vessel.propulsion.steering_x=27 vessel.propulsion.lookahead=0.1 vessel.propulsion.ram_distance=5000 \
    vessel.propulsion.beset_speed=5 vessel.propulsion.propeller_diameter=0.03 vessel.propulsion.propeller_z=-50 \
    vessel.propulsion.propeller_spacing=100 vessel.propulsion.propellers=2 vessel.wash.active=true -- \
    "steering_angle_deg: 0.61 deg|not radians" "steering_rate_deg: 0.04" \
    "steering_x: 27 m is ahead of the centre of mass" "lookahead: 0.1 m is 0.00167 lengths" \
    "ram_distance: 5000 m is 83.3 lengths" "beset_speed: the ship never makes more than 1 m/s" \
    "propeller_diameter: 0.03 m leaves|metres" "propeller_z: -50 m is far below the hull" \
    "propeller_spacing: 100 m is more than the beam"

# Ice in a basin does not drift past; words of the field that stand for several keys.
all_told ship.yaml vessel.speed=1 output.csv_interval=0.001 -- \
    "vessel.speed: a vessel on station begins with 1 m/s|domain.drift_speed" "csv_interval: 0.001 s is shorter than"
all_told ship.yaml domain.boundary=walls -- \
    "domain.boundary: walls keep the ice in a basin|past the vessel take feeding"
# meant SCENE KEY: the key that is asked for
meant() {
    expect 2 "$FRAM" check "$1" --set "$2=1"
    says "did you mean $3?" err
}
meant ship.yaml vessel.type mode
meant ship.yaml vessel.hull.type form
meant ship.yaml ice.type source
meant ship.yaml "vessel.thrusters[0].type" kind
meant ship.yaml "vessel.mooring.lines[0].n" count
meant ship.yaml "vessel.mooring.lines[0].radius" distance
meant ship.yaml "vessel.mooring.lines[0].spacing" spacing_deg
meant ship.yaml ice.floe_diameter mean_floe_area
expect 2 "$FRAM" check ship.yaml --set vessel.mode=towed
says "a moored vessel needs mode: free" err

# Times of output; a medium without weight.
all_told ship.yaml output.averaging_window=0.001 output.picture_interval=5000 output.checkpoint_interval=5000 \
    output.record_limit=0.01 environment.air_density=0 environment.floe_damping=5 \
    environment.ice_drag.water_skin=5 -- "averaging_window: 0.001 s is" \
    "picture_interval: 5000 s is longer than the run" "checkpoint_interval: 5000 s is longer than the run" \
    "record_limit: 0.01 MB" "air_density: 0 kg/m3 leaves a wind without" "floe_damping: 5 is" "water_skin: 5 is"

all_told ship.yaml output.csv_interval=0.12 output.frame_interval=0.131 output.checkpoint_interval=0.23 \
    output.picture_interval=0.18 output.averaging_window=0.125 -- \
    "csv_interval: 0.12 s is 2.4 steps of run.time_step, 0.05 s, and counts as 2: 0.1 s" \
    "frame_interval: 0.131 s is 2.62 steps" "checkpoint_interval: 0.23 s is 4.6" "picture_interval: 0.18 s is 3.6" \
    "averaging_window: 0.125 s is 2.5 steps of run.time_step, 0.05 s, and counts as 3: 0.15 s"
all_told towed.yaml output.averaging_window=20000 -- \
    "averaging_window: 20000 s is longer than run.transient, 0 s: statistics|before the start no load" \
    "averaging_window: 20000 s is 2e+06 steps of run.time_step, 0.01 s, and counts as 1000000: 10000 s; no more are"
all_told ship.yaml run.transient=320 output.averaging_window=310 -- "averaging_window: 310 s is more than half"
all_told ship.yaml run.transient=5 output.averaging_window=59 --
all_told ship.yaml run.transient=5 output.averaging_window=60 -- "averaging_window: 60 s is longer than run.tran"
# The first row that counts is the first one after the transient: at 150 s here, at 101 s there.
all_told ship.yaml run.transient=110 output.csv_interval=50 output.averaging_window=150 --
all_told ship.yaml run.transient=110 output.csv_interval=50 output.averaging_window=150.05 -- \
    "averaging_window: 150.05 s is longer than run.tran"
all_told ship.yaml run.transient=100 output.csv_interval=1 output.averaging_window=101 --
all_told ship.yaml output.csv_interval=5.02 output.frame_interval=0.15 output.averaging_window=0 --

# Histories in minutes, in knots, of a date; hulls in millimetres, athwartships, from the keel or the stern up.
printf 'time [s],x [m/s],y [m/s]\n0,-0.4,0\n10,-0.3,0.3\n' >minutes.csv
printf 'time [s],x [m/s],y [m/s]\n0,-80,0\n600,-5,0.2\n' >knots.csv
printf 'time [s],x [m/s],y [m/s]\n100000,-0.4,0\n100600,-0.4,0.2\n' >date.csv
printf 'depth [m],x [m/s],y [m/s]\n0,-30,40\n20,-12,3\n' >adcp.csv
all_told ship.yaml domain.drift_file=minutes.csv environment.wind_file=knots.csv environment.current_file=date.csv \
    environment.current_profile_file=adcp.csv -- \
    "environment.current_profile_file: adcp.csv goes up to 50 m/s, more than 4|cm/s" \
    "domain.drift_file: the last row of minutes.csv is of 10 s|not minutes" \
    "environment.wind_file: knots.csv goes up to 80 m/s|not knots" \
    "environment.current_file: the first row of date.csv is of 100000 s, after the end of the run" \
    "environment.wind_speed: without effect" "environment.current_speed: without effect" \
    "environment.wind_direction_deg: without effect" "environment.current_direction_deg: without effect"
# box NAME X0 X1 Y0 Y1 Z0 Z1: a closed mesh
box() {
    {
        for z in "$6" "$7"; do printf 'v %s %s %s\n' "$2" "$4" "$z" "$3" "$4" "$z" "$3" "$5" "$z" "$2" "$5" "$z"; done
        printf 'f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n'
    } >"$1.obj"
}
box good -30 30 -7 7 -4 3
box large -30000 30000 -7000 7000 -4000 3000
box athwart -7 7 -30 30 -4 3
box stern 0 60 -7 7 -4 3
box aside -30 30 6 20 -4 3
box shallow -30 30 -7 7 -0.1 6.9
box keel -30 30 -7 7 0 7
box awash -30 30 -7 7 -4 0.1
box open -30 30 -7 7 -4 3
sed -i '/f 5 6 7 8/d' open.obj
box cut -30 30 -7 7 -4 0
sed -i '/f 5 6 7 8/d' cut.obj
for hull in good large athwart stern aside shallow awash open cut; do
    sed "s/hull: {.*}}/hull: {form: file, file: $hull.obj}}/" towed.yaml >"$hull.yaml"
done
all_told good.yaml --
all_told large.yaml -- "vessel.hull.file: the waterline is 6e+04 m long|hull.file_scale 0.001"
all_told athwart.yaml -- "vessel.hull.file: the hull is 60 m wide along y and 14 m long along x"
all_told stern.yaml -- "the waterline of 60 m lies about x = 30 m, not about x = 0"
all_told aside.yaml -- "the hull lies about y = 13 m, not about y = 0, the centre line"
all_told shallow.yaml -- "the mesh reaches 0.1 m under its z = 0|move it down by the draught"
all_told awash.yaml -- "vessel.hull.file: the hull ends 0.1 m above its z = 0|no deck is lower than 0.2 m"
all_told cut.yaml --
all_told cut.yaml vessel.hull.freeboard=400 -- "the hull ends 400 m above its z = 0|no higher than 60 m"
all_told cut.yaml vessel.hull.freeboard=0.1 -- "vessel.hull.file: the hull ends 0.1 m above its z = 0|no deck is lower"
# It is the deck's height that is judged, not what is added to it; what is added to a hull with topsides is told.
all_told open.yaml --
all_told open.yaml vessel.hull.freeboard=0.1 -- "is 3 m above the water already, and is raised by 0.1 m|leave freeboard"
# A hull of a file outside of the domain is told as others are; how far it reaches is known when it is read.
outside=(--set vessel.speed=0 --set vessel.y=0 --set ice.source=voronoi)
box ship -30 30 -7 7 -4 3
sed "s/hull: {.*}}/hull: {form: file, file: ship.obj}}/" towed.yaml >beyond.yaml
edge=$(sed -n 's/.*x_max: \([0-9]*\).*/\1/p' beyond.yaml)
expect 0 "$FRAM" check beyond.yaml "${outside[@]}" --set "vessel.x=$((edge + 20))"
says "m lies outside of the domain, 20 m from its edge: there is no ice, unless the hull of its file reaches in" err
expect 0 "$FRAM" check beyond.yaml --build "${outside[@]}" --set "vessel.x=$((edge + 20))"
grep 'lies outside' err && fail "a hull that reaches in is told to lie outside"
for words in "check beyond.yaml --build" "run beyond.yaml -o beyond --set run.duration=0.1"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" $words "${outside[@]}" --set "vessel.x=$((edge + 40))"
    grep -q 'm lies outside of the domain, 40 m from its edge: there is no ice$' err || fail "$words: $(cat err)"
done
sed "s/hull: {.*}}/hull: {form: file, file: keel.obj}}/" towed.yaml >keel.yaml
expect 2 "$FRAM" check keel.yaml
says "the design waterline of a hull's file is its z = 0, but the mesh reaches from z = 0 to 7 m" err
finish "slips in ice, control, gear and files are told with key and remedy"
