#!/usr/bin/env bash
# Thirty-eight more slips of a pen, in the gear of a ship and in the writing: each is told or refused with key and
# remedy.
. "$FRAM_SOURCE/tests/cli/slips.sh"

cat >drive.yaml <<'YAML'
run: {duration: 60, time_step: 0.01}
vessel:
  mode: free
  hull: {form: icebreaker, length: 60, beam: 14, draught: 4}
  propulsion: {bollard_pull: 8.0e5, open_water_speed: 7, speed: 3, waypoints: [{x: 90, y: 0}]}
ice: {mean_floe_area: 200, thickness: 0.7, concentration: 0.5}
domain: {x_min: -100, x_max: 100, y_min: -100, y_max: 100, boundary: open}
YAML

# refused SCENE WORDS OPTIONS...
refused() {
    local scene=$1 words=$2
    shift 2
    expect 2 "$FRAM" check "$scene" "$@"
    says "$words" err
}
for scene in ship.yaml drive.yaml; do
    expect 0 "$FRAM" check $scene
    grep '^warning' err && fail "a warning without reason of $scene"
done

# Tonnes, kilonewtons, knots, kilometres, parts for metres.
told drive.yaml "propulsion.bollard_pull: 80 N|not kN or tonnes" --set vessel.propulsion.bollard_pull=80
told drive.yaml "propulsion.open_water_speed: 15 m/s|knot" --set vessel.propulsion.open_water_speed=15
told drive.yaml "propulsion.speed: 12 m/s is more than the ship makes|7 m/s" --set vessel.propulsion.speed=12
told drive.yaml "propulsion.steering_x: -600 m is outside of a hull of 60 m" --set vessel.propulsion.steering_x=-600
told drive.yaml "propeller_diameter: 6 m|draught, 4 m" --set vessel.propulsion.propeller_diameter=6
told drive.yaml "waypoints[0]: (150, 0) m lies outside of the domain" --set "vessel.propulsion.waypoints[0].x=150"
told ship.yaml "lines[0].stiffness: EA of 800 kN is 0.1 breaking loads|newtons" \
    --set "vessel.mooring.lines[0].stiffness=8e5"
told ship.yaml "lines[0].distance: an anchor 0.9 m off|metres" --set "vessel.mooring.lines[0].distance=0.9"
# Anchors much nearer than the bottom, here 120 m down: not of legs that pull straight down, nor of taut ones.
told ship.yaml "lines[0].distance: an anchor 83 m off and 120 m down: the line pulls|of taut legs about one depth" \
    --set "vessel.mooring.lines[0].distance=83"
grep -c 'an anchor 83' err | grep -qx 1 || fail "told twice of an anchor"
# Its stiffness is EA, in N; that of a spring is in N/m: 1e8 N over 125 m, and over 160 m.
told ship.yaml "with stiffness EA over length, 8e+05 N/m|kind: spring" --set "vessel.mooring.lines[0].distance=35" \
    --set "vessel.mooring.lines[0].stiffness=1e8"
told ship.yaml "with stiffness EA over length, 6.25e+05 N/m" --set "vessel.mooring.lines[0].distance=35" \
    --set "vessel.mooring.lines[0].stiffness=1e8" --set "vessel.mooring.lines[0].length=160"
for near in "distance=84.1" "distance=83 --set vessel.mooring.z=-3" \
    "distance=8 --set vessel.mooring.lines[0].kind=spring"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" check ship.yaml --set vessel.mooring.lines[0].$near
    grep 'an anchor' err && fail "told of an anchor with $near"
done
# A limit on a vessel that nothing holds.
limit="vessel.station.offset_limit=8"
sed '/mooring:/,/breaking_load/d' ship.yaml >adrift.yaml
told adrift.yaml "station.offset_limit: nothing holds the vessel against current, wind or ice|gives them orders" \
    --set $limit
told adrift.yaml "vessel.station.heading_limit_deg: nothing holds the vessel|positioning.active is false" \
    --set vessel.station.heading_limit_deg=10
sed '/thrusters:/d' adrift.yaml >bare.yaml
told bare.yaml "vessel.station.offset_limit: nothing holds the vessel|it has neither mooring.lines nor thrusters with" \
    --set $limit
# shellcheck disable=SC2086
for held in "ship.yaml --set $limit" "adrift.yaml" "adrift.yaml --set $limit --set vessel.positioning.active=true" \
    "bare.yaml --set $limit --set vessel.mode=towed" "bare.yaml --set $limit --set vessel.propulsion.bollard_pull=4e5" \
    "adrift.yaml --set $limit --set environment.current_speed=0 --set environment.wind_speed=0"; do
    expect 0 "$FRAM" check $held
    grep 'nothing holds the vessel' err && fail "told of $held that nothing holds it"
done
no_end="vessel.mooring.lines[0].breaking_load=auto"
told ship.yaml "lines[0].length: 870 m|is stretched by 4.36 % from the start" --set "$no_end" \
    --set "vessel.mooring.lines[0].length=870"
printf 'offset[m],tension[N]\n-10,300\n0,800\n10,1900\n' >kilo.csv
printf 'offset[m],tension[N]\n-10,300000\n0,800000\n10,1900000\n' >newtons.csv
table="vessel.mooring.lines[0].kind=table"
file="vessel.mooring.lines[0].table_file"
told ship.yaml "lines[0].table_file: the tension goes up to 1900 N, less than 10 kN|not kN" --set "$table" \
    --set "$file=kilo.csv"
expect 0 "$FRAM" check ship.yaml --set "$table" --set "$file=newtons.csv"
grep 'the tension goes up' err && fail "told of a table in newtons"
# Lines that balance in a wall or in another hull, since all of them lead one way: the ship lies well where it is put.
alone="vessel.mooring.lines[0].count=1"
refused ship.yaml "vessel.mooring.lines: where they balance current and wind, (" --set "$alone" \
    --set domain.boundary=walls
says "the hull stands in the walls of the domain: look at their count, spacing_deg" err
refused ship.yaml "vessel.x: the hull covers x from 1" --set "$alone" --set domain.boundary=walls --set vessel.x=150
expect 0 "$FRAM" check ship.yaml --set "$alone" --set domain.boundary=walls --set vessel.mooring.equilibrium=false
# Of two hulls the one is told that its lines move, whichever stands first.
cat >pair.yaml <<'END'
run: {duration: 5, time_step: 0.05}
vessels:
  - {name: ship, mode: free, hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 3},
     hydrodynamics: {source: estimate}, mooring: {depth: 80, lines: [{kind: spring, count: 4, spacing_deg: 90,
     direction_deg: 45, distance: 300, stiffness: 2.0e3, pretension: 5.0e4}]}}
  - {name: barge, mode: towed, x: 42.5, hull: {form: box, length: 20, beam: 12, draught: 4, freeboard: 3}}
ice: {source: none}
environment: {current_speed: 2}
END
awk '/name: barge/ { next } /name: ship/ { print barge } { print }' \
    barge="$(grep 'name: barge' pair.yaml)" pair.yaml >pair_turned.yaml
refused pair.yaml "vessels[0].mooring.lines: where they balance current and wind, ("
refused pair_turned.yaml "vessels[1].mooring.lines: where they balance current and wind, ("
says "the hull stands in another vessel" err
refused pair.yaml "vessels[1].x: the hull lies in that of vessel ship" --set vessels.barge.x=35
spring="vessel.mooring.lines[0].kind=spring"
told ship.yaml "lines[0].pretension: 800 kN is over the breaking load of 700 kN" --set "$spring" \
    --set "vessel.mooring.lines[0].stiffness=5e4" --set "vessel.mooring.lines[0].breaking_load=7e5"
# 908 m from fairlead to anchor: 8 m longer than the spring.
told ship.yaml "lines[0].length: 900 m|pulls with 398.2 kN from the start, more than half of the breaking load" \
    --set "$spring" --set "vessel.mooring.lines[0].length=900" --set "vessel.mooring.lines[0].stiffness=5e4" \
    --set "vessel.mooring.lines[0].breaking_load=7e5"
told ship.yaml "lines[0].length: 8 m|from the start: it is the length without tension" --set "$no_end" \
    --set "$spring" --set "vessel.mooring.lines[0].length=8" --set "vessel.mooring.lines[0].stiffness=5e4"
told ship.yaml "vessel: without water (environment.water: false) nothing holds it upright|take vessel.mode: towed" \
    --set environment.water=false
told drive.yaml "vessel: without water (environment.water: false)" --set environment.water=false
# Damping that drives: by a coupling of two motions, and of three of which no two do.  Halves that take from each other
# what they give drive nothing, nor does a force on an arm, which just damps.
damped() {
    sed "s/^  mooring:/  hydrodynamics: {source: given, z: -2, damping: [$1]}\n&/; s/icebreaker/box/" \
        ship.yaml >damped.yaml
}
turns="{roll: 1e9}, {pitch: 1e9}"
damped "{surge: 1e4}, {sway: 1e5, yaw: 5e6}, {heave: 1e6}, $turns, {sway: 5e6, yaw: 2e7}"
told damped.yaml "vessel.hydrodynamics.damping is not positive between sway and yaw|beside 1e+05 and"
three="{surge: 5, sway: 3, heave: 3}, {surge: 3, sway: 5, heave: -3}, {surge: 3, sway: -3, heave: 5}"
damped "$three, $turns, {yaw: 1e9}"
told damped.yaml "hydrodynamics.damping is not positive, by its couplings of more than two motions"
# A carriage leaves heave alone to the water, and a path nothing.
led() { # MODE DAMPING...
    damped "$2"
    sed "s/mode: free/mode: $1/; /^  mooring:/,/^[a-z]/ { /^[a-z]/!d }" damped.yaml >led.yaml
    expect 0 "$FRAM" check led.yaml
}
for mode in towed prescribed; do
    for rows in "$three, $turns, {yaw: 1e9}" "{surge: -1e4}, {}, {}, {}, {}, {}"; do
        led $mode "$rows"
        grep 'damping is' err && fail "damping of what a carriage holds is told: $mode, $rows"
    done
done
led towed "{}, {}, {heave: -1e6}, {}, {}, {}"
says "damping is negative in heave" err
for rows in "{surge: 1e4}, {sway: 1e5, yaw: 5e6}, {heave: 1e6}, $turns, {sway: -5e6, yaw: 2e7}" \
    "{surge: 1e4}, {sway: 1e5}, {}, {}, {}, {}"; do
    damped "$rows"
    expect 0 "$FRAM" check damped.yaml
    grep 'damping is' err && fail "damping that drives nothing is told: $rows"
done
# A beam current on the drag of a hull that goes ahead: not where the sides have theirs, nor for one from ahead.
across=environment.current_direction_deg as_put="--set vessel.mooring.equilibrium=false"
# shellcheck disable=SC2086
told ship.yaml "vessel: a current of 0.346 m/s comes across the hull|vessel.current_coefficients" --set $across=120 \
    $as_put
for way in "$across=160" "$across=120 --set environment.hull_drag.water_form=1" \
    "$across=120 --set environment.current_speed=0.2" "$across=120 --set vessel.heading_deg=-60"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" check ship.yaml --set $way $as_put
    grep 'comes across' err && fail "told of $way"
done
# Nor has a ship the drag of its side that is to turn as its track does.
turns=vessel.propulsion.pattern.kind sides="its track has turns, and environment.hull_drag.water_form is 0.1"
sed 's/waypoints: .*}]}/pattern: {kind: circle}}/' drive.yaml >round.yaml
for way in circle square; do
    told round.yaml "vessel.propulsion: $sides" --set $turns=$way
done
expect 0 "$FRAM" check drive.yaml
grep 'its track has turns' err && fail "told of one leg"
sed 's/{x: 90, y: 0}/&, {x: 90, y: 80}/' drive.yaml >bends.yaml
told bends.yaml "vessel.propulsion: $sides|vessel.current_coefficients" --set "vessel.propulsion.speed=auto"
# Its legs are shorter than its corner takes.
holds 'waypoints\[0\]: legs of 8.* and 80 m leave its corner 80 m of a radius of .* m, the least of 1 that has less' err
# Two corners on a leg share it: of all of them the one with the shortest is told.
sed 's/{x: 90, y: 0}/&, {x: 90, y: 80}, {x: 140, y: 80}, {x: 140, y: 200}/' drive.yaml >shares.yaml
told shares.yaml "waypoints[1]: legs of 80 and 50 m leave its corner 25 m of a radius of|the least of 3 that have less"
# Of points at the same place the one that turns about is named, and counted with those that are left out.
sed 's/{x: 90, y: 0}/{x: 0, y: 0}, &, &, {x: 90, y: 900}, {x: 900, y: 400}, &, {x: 900, y: 90}/' drive.yaml >named.yaml
expect 0 "$FRAM" check named.yaml
holds 'waypoints\[5\]: a corner of more than 135 degrees' err
# Out and back, so slowly that ice stops it for good, with more helm than its rudders can use.
told bends.yaml "vessel.propulsion.speed: at 0.1 m/s the ship, stopped by ice, pushes with 29 % of its pull|waits" \
    --set vessel.propulsion.speed=0.1 --set "vessel.propulsion.waypoints[1].x=-500" \
    --set "vessel.propulsion.waypoints[1].y=0" --set vessel.propulsion.steering_angle_deg=80
grep 'the loop on which' err && fail "told of a loop that the run does not reach"
holds '^warning: vessel.propulsion.steering_angle_deg: past 5.* degrees of helm the rudders of the vessel turn' err
holds 'vessel.propulsion.waypoints\[0\]: a corner of more than 135 degrees: the vessel turns about on a loop' err
grep 'beset_speed' err && fail "a ship that waits is told to back again and again"
# The loop reaches beyond the point, into a wall or out of the ice.
about=(--set "vessel.propulsion.waypoints[1].x=-500" --set "vessel.propulsion.waypoints[1].y=0" --set run.duration=600)
loop="waypoints[0]: the loop on which the vessel turns about there leads to"
told bends.yaml "$loop|outside of the domain" "${about[@]}"
walls=(--set ice.source=none --set domain.boundary=walls)
told bends.yaml "$loop|meets a wall" "${about[@]}" "${walls[@]}"
wide=(--set domain.x_min=-3000 --set domain.x_max=3000 --set domain.y_min=-3000 --set domain.y_max=3000)
expect 0 "$FRAM" check bends.yaml "${about[@]}" "${walls[@]}" "${wide[@]}"
grep 'the loop on which' err && fail "told of a loop with room"
for way in $turns=ahead environment.hull_drag.water_form=1 vessel.propulsion.speed=0.1; do
    expect 0 "$FRAM" check round.yaml --set "$way"
    grep 'its track has turns' err && fail "told of $way"
done
# Those of files where they are read, as they begin and at half the draught.
printf 'time,x,y\n0,0,-0.4\n600,0,0\n' >aside.csv
printf 'depth,x,y\n0,0,0\n3,0,0.5\n' >below.csv
printf 'depth,x,y\n0,0,0.5\n3,0,0.1\n' >above.csv
bare="--build --set ice.source=none --set domain.boundary=open --set environment"
# shellcheck disable=SC2086
told ship.yaml "vessel: a current of 0.4 m/s comes across the hull" $bare.current_file=aside.csv $as_put
# shellcheck disable=SC2086
told ship.yaml "vessel: a current of 0.5 m/s comes across the hull" $bare.current_profile_file=below.csv $as_put
# shellcheck disable=SC2086
expect 0 "$FRAM" check ship.yaml $bare.current_profile_file=above.csv $as_put
grep 'comes across' err && fail "told of a current at the surface alone"
# Tables whose angles are counted from ahead, or whose cy is to starboard.
flow() {
    local rows="[{angle_deg: 0, cx: $2}, {angle_deg: 90, cy: $3}, {angle_deg: 180, cx: $4}]"
    sed "s/^  thrusters.*/&\n  $1: {table: $rows}/" ship.yaml >flow.yaml
}
flow wind_coefficients 0.8 0.9 -0.9
expect 0 "$FRAM" check flow.yaml
grep '^warning' err && fail "told of a table that is right"
flow wind_coefficients -0.9 0.9 0.8
told flow.yaml "wind_coefficients: at 0 degrees cx and cy push the vessel against the motion of the wind|from astern"
flow current_coefficients 0.02 -0.7 -0.03
told flow.yaml "vessel.current_coefficients: at 90 degrees cx and cy push the vessel against|cy to port"
# A bow that turns against wind which pushes the side ten times as hard as the bow: from ahead cy grows by
# 0.8 * 10 * 2 / pi for each radian, over cx of 0.8, so that the load turns by 5.4 more than the bow.
cat >vane.yaml <<'YAML'
vessel:
  mode: free
  hull: {form: box, length: 100, beam: 20, draught: 6, freeboard: 6}
  hydrodynamics: {source: estimate}
  wind_coefficients: {table: [{angle_deg: 0, cx: 0.8}, {angle_deg: 90, cy: 0.8}, {angle_deg: 180, cx: -0.8}],
                      frontal_area: 200, lateral_area: 2000}
  thrusters: [{x: -45, y: 5, thrust: 3e5}, {x: -45, y: -5, thrust: 3e5}, {x: 45, thrust: 3e5}]
  positioning: {active: true, heading: vaning, vaning_load: 5e3}
ice: {source: none}
domain: {boundary: open}
environment: {wind_speed: 14, wind_direction_deg: -70}
YAML
vaning=vessel.positioning.vaning
told vane.yaml "$vaning""_time: as the bow turns by a degree|turns by 5.4" --build
# shellcheck disable=SC2154
time=$(sed -n 's/.*for ever; take \([0-9.e+]*\) s or more.*/\1/p' err)
for enough in ${vaning}_time="$time" ${vaning}_load=5e4 vessel.wind_coefficients.lateral_area=500 \
    vessel.positioning.feed_forward=measured vessel.positioning.heading=fixed; do
    expect 0 "$FRAM" check vane.yaml --build --set "$enough"
    grep 'swing for long' err && fail "told of a heading that comes to rest with $enough"
done
# A run tells it too, once.
expect 0 "$FRAM" run vane.yaml -o vaned --set run.duration=0.1
same "$(grep -c 'swing for long' err)" 1 "warnings of a run that swings"
# A slow controller adds its own lag to that of the set points.
slow=(--build --set "${vaning}_time=80" --set vessel.wind_coefficients.lateral_area=1250 --set "${vaning}_load=1e3")
expect 0 "$FRAM" check vane.yaml "${slow[@]}"
grep 'swing for long' err && fail "told of a heading that comes to rest at the default frequency"
told vane.yaml "it may swing for long" "${slow[@]}" --set vessel.positioning.frequency=0.04
# What is advised does not go by what was set.
advised() { sed -n 's/.*for ever; take \([0-9.e+]*\) s or more.*/\1/p' err; }
told vane.yaml "may swing" --build --set ${vaning}_time=50
same "$(advised)" "$time" "the time that is advised from 50 s"
# On a ship with propulsion it stands for the lift of a hull that slides.
drives="vessel.propulsion.bollard_pull=5e5"
flow current_coefficients 0.02 0 -0.03
told flow.yaml "vessel.current_coefficients: on a ship with propulsion|it has no cy and cn" --set $drives
expect 0 "$FRAM" check flow.yaml
grep 'with propulsion' err && fail "told of a ship without propulsion"
flow current_coefficients 0.02 0.7 -0.03
told flow.yaml "vessel.current_coefficients: on a ship with propulsion|it has no cn" --set $drives
sed -i 's/cy: 0.7}/cy: 0.7, cn: -0.05}/' flow.yaml
expect 0 "$FRAM" check flow.yaml --set $drives
grep 'for the lift' err && fail "told of a table with cy and cn"
# Of a table with unequal sides nothing is left without water, on which side a ship turns wider neither.
sed -i 's/{angle_deg: 180, cx: -0.03}/&, {angle_deg: 270, cy: -0.5}, {angle_deg: 360, cx: 0.02}/' flow.yaml
expect 0 "$FRAM" check flow.yaml --set $drives --set environment.water=false
cat out err >both
says "does not turn by its helm at" both
refused ship.yaml "hull.block_coefficient: expected 1, that of a box, or none" --set vessel.hull.form=box \
    --set vessel.hull.block_coefficient=0.6
refused ship.yaml "thrusters[0].setting: expected 0 to 1: a unit that turns pushes the other way" \
    --set "vessel.thrusters[0].setting=-0.5"
refused ship.yaml "thrusters[0].direction_deg: expected a direction outside of forbidden_deg" \
    --set "vessel.thrusters[0].setting=0.5" --set "vessel.thrusters[0].direction_deg=80" \
    --set "vessel.thrusters[0].forbidden_deg=90" --set "vessel.thrusters[0].forbidden_width_deg=60"
expect 0 "$FRAM" check ship.yaml \
    --set "vessel.thrusters[0].setting=0.5" --set "vessel.thrusters[0].direction_deg=59" \
    --set "vessel.thrusters[0].forbidden_deg=90" --set "vessel.thrusters[0].forbidden_width_deg=60"
# What positioning does not look at is refused of nobody, and told.
for setting in 0.5 -0.5; do
    told ship.yaml "thrusters[0].setting: without effect, since positioning.active is true" \
        --set vessel.positioning.active=true --set "vessel.thrusters[0].setting=$setting" \
        --set "vessel.thrusters[0].forbidden_width_deg=20"
done
refused ship.yaml "thrusters[0].direction_deg: expected 0 without rudder_deg, found 10" \
    --set "vessel.thrusters[0].kind=main" --set "vessel.thrusters[0].direction_deg=10"
refused ship.yaml "thrusters[0].direction_deg: expected -35 to 35, as far as its rudder_deg turns, found 40" \
    --set "vessel.thrusters[0].kind=main" --set "vessel.thrusters[0].rudder_deg=35" \
    --set "vessel.thrusters[0].direction_deg=40"
sed '/mooring:/,/breaking_load/d' ship.yaml >held.yaml
held() { told held.yaml "vessel.positioning: $1" --set vessel.positioning.active=true "${@:2}"; }
tunnels=(--set "vessel.thrusters[0].kind=tunnel" --set "vessel.thrusters[1].kind=tunnel")
held "no thruster pushes the vessel ahead" "${tunnels[@]}"
held "no thruster pushes the vessel aside" --set "vessel.thrusters[0].kind=main" --set "vessel.thrusters[1].kind=main"
held "the thrusters do not turn the vessel, for all of them are at one place" --set "vessel.thrusters[1].x=30"
held "the thrusters do not turn the vessel|through amidships" --set vessel.positioning.control=heading \
    --set "vessel.thrusters[0].x=0" --set "vessel.thrusters[1].x=0"
goes='positioning: {active: true, waypoints: [{time: 60, x: 5}, {time: 6000, x: 9}]}'
sed "s/^  thrusters.*/&\n  $goes/" held.yaml >late.yaml
told late.yaml "vessel.positioning.waypoints[1].time: 6000 s is after the end of the run, 600 s"
expect 0 "$FRAM" check late.yaml --set "vessel.positioning.waypoints[1].time=600"
grep 'waypoints' err && fail "a way point of the end is told"
told late.yaml "vessel.positioning.waypoints: the vessel is not steered there, since positioning.active is false" \
    --set vessel.positioning.active=false
grep 'waypoints: without effect' err && fail "way points that the offset counts from are told to be idle"
# On a turret the ship turns about that: to 70 m ahead of where it lay, 44 m long to both sides of amidships.
turns='positioning: {active: true, control: heading, waypoints: [{time: 60, heading_deg: 180}]}'
sed "s/^  thrusters.*/&\n  $turns/; s/feeding/walls/" ship.yaml >turned.yaml
forward=(--set vessel.mooring.turret=true --set vessel.mooring.x=35)
told turned.yaml "vessel.positioning.waypoints[0]: at (70, 0) m the hull stands in a wall" "${forward[@]}" \
    --set domain.x_max=112
for options in domain.x_max=116 vessel.mooring.turret=false; do
    expect 0 "$FRAM" check turned.yaml "${forward[@]}" --set domain.x_max=112 --set "$options"
    grep 'stands in a wall' err && fail "a ship that turns beside the wall is told: $options"
done
sed '/thrusters:/d' late.yaml >towed.yaml
told towed.yaml "vessel.positioning.waypoints: without effect, since positioning.active is false" \
    --set vessel.positioning.active=false --set vessel.mode=towed
for options in vessel.positioning.active=true vessel.positioning.control=heading; do
    expect 0 "$FRAM" check held.yaml --set vessel.positioning.active=true --set "$options"
    grep 'warning: vessel.positioning: ' err && fail "thrusters that do it are told: $options"
done
expect 0 "$FRAM" check ship.yaml --set vessel.positioning.active=true "${tunnels[@]}"
grep 'warning: vessel.positioning: ' err && fail "thrusters are told that assist lines"
sed 's/{x: 90, y: 0}/&, &/' drive.yaml >again.yaml
told again.yaml "vessel.propulsion.waypoints[1]: it is 0 m from the point before"
told again.yaml "waypoints[1]: it is 2.9 m from the point before|left out" --set "vessel.propulsion.waypoints[1].x=92.9"
expect 0 "$FRAM" check again.yaml --set "vessel.propulsion.waypoints[1].x=93.1"
grep 'from the point before' err && fail "a leg of more than a twentieth of the length is told"
told ship.yaml "lines[0].spacing_deg: 8 lines at 90 degrees" --set "vessel.mooring.lines[0].spacing_deg=90"
told ship.yaml "fairleads 800 m from amidships" --set "vessel.mooring.lines[0].fairlead_distance=800"
told ship.yaml "fairleads 400 m from amidships" --set vessel.mooring.x=400
told ship.yaml "fairleads 200 m to the side are outside of a hull of 19 m beam" --set vessel.mooring.y=200
told ship.yaml "fairleads 30 m to the side" --set "vessel.mooring.lines[0].fairlead_distance=30"
ends=(--set "vessel.mooring.lines[0].fairlead_distance=30" --set "vessel.mooring.lines[0].count=2"
    --set "vessel.mooring.lines[0].spacing_deg=180")
expect 0 "$FRAM" check ship.yaml "${ends[@]}"
grep 'to the side' err && fail "fairleads at bow and stern are told"
told ship.yaml "fairleads 30 m to the side" "${ends[@]}" --set vessel.heading_deg=90
told ship.yaml "fairleads 30 m to the side" "${ends[@]}" --set vessel.mooring.turret=true
told ship.yaml "station.watch_y: (0, 30) m is outside of a hull of 76 m by 19 m" --set vessel.station.watch_y=30
told ship.yaml "mooring.z: fairleads 50 m under the design waterline|keel at 6.5 m" --set vessel.mooring.z=-50
# Of several lines once, since nothing in the sentence is of one of them.
line='- {distance: 900, pretension: 8.0e5, weight: 1500, stiffness: 8.0e8, fairlead_distance: 200'
sed -e "s/- {count: 8, spacing_deg: 45.*/$line},/" -e "s/^ *breaking_load.*/      $line, direction_deg: 120}/" \
    -e 's/},$/}/' ship.yaml >lines.yaml
told lines.yaml "fairleads 200 m from amidships" --set vessel.mooring.z=-50
for words in "fairleads 200 m from amidships" "mooring.z: fairleads 50 m under"; do
    same "$(grep -c "$words" err)" 1 "warnings of both lines: $words"
done
told ship.yaml "lines[0].release_time: 3600 s is after the end" --set "vessel.mooring.lines[0].release_time=3600"
told ship.yaml "lines[0].weight: 1.5 N/m|not kg/m or kN/m" --set "vessel.mooring.lines[0].weight=1.5"
told ship.yaml "thrusters[0].failure_time: 3600 s is after the end" --set "vessel.thrusters[0].failure_time=3600"
told ship.yaml "thrusters[0]: (300, 0) m is outside of a hull" --set "vessel.thrusters[0].x=300"
told ship.yaml "thrusters[1].diameter: 28 m|draught" --set "vessel.thrusters[1].diameter=28"
told ship.yaml "gyration_roll: 0.35 m is 0.0184 of the beam|metres" --set vessel.gyration_roll=0.35
told drive.yaml "gyration_yaw: 0.5 m is 0.0333 of the beam" --set vessel.hull.length=12 --set vessel.hull.form=box \
    --set vessel.hull.beam=15 --set vessel.gyration_yaw=0.5
# Radii of a spar are those of its height.
spar="form: cone, length: 30, beam: 30, draught: 100, freeboard: 10, flare_angle_deg: 0"
sed "s/hull: {.*/hull: {$spar}/; s/depth: 120/depth: 400/" ship.yaml >spar.yaml
radii=(--set vessel.gyration_roll=33 --set vessel.gyration_pitch=33)
expect 0 "$FRAM" check spar.yaml "${radii[@]}"
grep 'gyration_' err && fail "the radii of a spar are told"
told spar.yaml "gyration_roll: 12 m is 0.109 of the height, 110 m" --set vessel.gyration_roll=12 \
    --set vessel.gyration_pitch=12
told spar.yaml "gyration_pitch: 75 m is 0.682 of the height, 110 m" --set vessel.gyration_roll=75 \
    --set vessel.gyration_pitch=75
told ship.yaml "fender_stiffness: 50 N/m|not kN/m" --set vessel.fender_stiffness=50
told ship.yaml "ice.crushing_strength: 2000 Pa|not kPa or MPa" --set ice.crushing_strength=2000
told ship.yaml "centre_of_gravity_z, 12 m" --set vessel.centre_of_gravity_z=12
told ship.yaml "centre_of_gravity_x: the vessel trims" --set vessel.centre_of_gravity_x=30
told ship.yaml "centre_of_gravity_y: the vessel heels" --set vessel.centre_of_gravity_y=5
told ship.yaml "vessel.mass is 0.106" --set vessel.mass=5.5e5

# Times; how fast vessel and ice meet, by the drift, a path, the speed that is wanted or half of what
# the ship's own power gives in open water, whatever is less.
told ship.yaml "the vessel and the ice move 0.11 of its thickness past each other in a step at 0.4 m/s" \
    --set run.time_step=0.2
told drive.yaml "the vessel and the ice move 0.21 of its thickness past each other in a step at 3 m/s" \
    --set run.time_step=0.05
told drive.yaml "the vessel and the ice move 0.25 of its thickness past each other in a step at 3.5 m/s" \
    --set run.time_step=0.05 --set vessel.propulsion.speed=5
sed 's/free/prescribed/; s/^  propulsion.*/  path: [{time: 0}, {time: 60, x: 60}]/' drive.yaml >path.yaml
told path.yaml "the vessel and the ice move 0.14 of its thickness past each other in a step at 1 m/s" \
    --set run.time_step=0.1
told path.yaml "vessel.path[1]: (150, 0) m, at t = 60 s, lies outside of the domain" --set "vessel.path[1].x=150"
for options in domain.boundary=walls ice.source=none "vessel.path[1].time=61"; do
    expect 0 "$FRAM" check path.yaml --set "vessel.path[1].x=150" --set "$options"
    grep 'outside of the domain' err && fail "no ice to leave, and told: $options"
done
# A ship keeps its heading, whatever way it has at the start; a file of current or drift stands in place of their speed.
sed 's/, waypoints: .*}]}/}/' drive.yaml >ahead.yaml
told ahead.yaml "the vessel can leave the domain before the end, at (180, 0) m" --set vessel.course_deg=90
printf 'time[s],x[m/s],y[m/s]\n0,-0.4,0\n' >calm.csv
for file in environment.current_file domain.drift_file; do
    expect 0 "$FRAM" check ship.yaml --set $file=calm.csv --set environment.current_speed=3
    grep 'past each other' err && fail "a speed is told that $file replaces"
done
told ship.yaml "run.time_step: 1e-06 s makes 6e+08 steps" --set run.time_step=1e-6
told ship.yaml "frame_interval: 0.01 s is shorter than run.time_step" --set output.frame_interval=0.01
told ship.yaml "checkpoint_interval: 0.001 s is shorter than run.time_step" --set output.checkpoint_interval=0.001
# As many rows as there are whole intervals.
told ship.yaml "csv_interval: 160 s leaves 3 rows of" --set output.csv_interval=160
told ship.yaml "csv_interval: 400 s leaves 1 row of" --set output.csv_interval=400
told ship.yaml "csv_interval: 1000 s leaves no row of" --set output.csv_interval=1000
grep -v propulsion drive.yaml >towed.yaml
told towed.yaml "vessel.ramp: 100 s is not over when the run ends" --set vessel.mode=towed --set vessel.speed=2 \
    --set vessel.ramp=100
for mode in towed prescribed; do
    refused towed.yaml "vessel.positioning.active: expected false, since vessel.mode is not free" \
        --set vessel.positioning.active=true --set vessel.mode=$mode
done

# The writing.
refused ship.yaml 'found "0.7 m"' --set "ice.thickness=0.7 m"
refused ship.yaml 'found "0,7"' --set ice.thickness=0,7
refused ship.yaml 'did you mean' --set ice.thicknes=0.7
sed 's/^  mode: free/\tmode: free/' ship.yaml >tab.yaml
refused tab.yaml "tab.yaml:3:1: the line begins with a tab"
sed 's/^  mode: free/&\n  mode: towed/' ship.yaml >twice.yaml
refused twice.yaml "twice.yaml:4:3: vessel.mode: expected each key once"

# At another scale the bounds go along.
expect 0 "$FRAM" check drive.yaml --set run.scale=1 --set vessel.propulsion.bollard_pull=500 \
    --set vessel.propulsion.open_water_speed=0.9 --set vessel.propulsion.speed=0.5
grep 'bollard_pull\|water_speed' err && fail "the propulsion of a model is told"
finish "slips in a ship's gear and in the writing are told or refused, with key and remedy"
