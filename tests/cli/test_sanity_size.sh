#!/usr/bin/env bash
# A ship in the scale of its model, and a model with the numbers of a ship: each is told with key and remedy.
. "$FRAM_SOURCE/tests/cli/slips.sh"

# A ship of 1:30 in a tank; half a newton is 13.5 kN.
cat >moored.yaml <<'YAML'
run: {duration: 100, time_step: 0.005, scale: 1}
vessel:
  mode: free
  hull: {form: icebreaker, length: 2.53, beam: 0.63, draught: 0.22, freeboard: 0.12}
  mooring: {depth: 4, lines: [{kind: spring, count: 4, spacing_deg: 90, distance: 30, stiffness: 5, pretension: 30}]}
  thrusters: [{x: 1, thrust: 7.4}, {x: -1, thrust: 7.4}]
  positioning: {active: true, control: heading}
ice: {concentration: 0.5, mean_floe_area: 0.2, thickness: 0.023}
domain: {x_min: -6, x_max: 6, y_min: -6, y_max: 6, boundary: feeding, drift_speed: 0.05}
YAML
own='propulsion: {bollard_pull: 40, open_water_speed: 1.4, speed: 0.05}'
sed -e '/mooring/d; /thrusters/d; /positioning/d' -e "s/^  hull.*/&\n  $own/" \
    -e 's/feeding, drift_speed: 0.05/open/' moored.yaml >drive.yaml
sed -e 's/^  mode: free/  mode: towed\n  speed: 0.05/; /propulsion/d' drive.yaml >towed.yaml
for scene in moored drive towed; do
    expect 0 "$FRAM" check $scene.yaml
    grep '^warning' err && fail "a warning without reason of $scene"
done

# The scale of a tank with a ship in it; at one that takes models as long nothing is told.
told ship.yaml "run.scale: 1 is that of a tank, where hulls measure up to 16.7 m, and the vessel is 76 m long|give 30" \
    --set run.scale=1
told ship.yaml "run.scale: 4 is that of a tank, where hulls measure up to 66.7 m|defaults of a model" --set run.scale=4
for options in run.scale=5 run.scale=60; do
    expect 0 "$FRAM" check ship.yaml --set $options
    grep 'is that of a tank' err && fail "told of $options"
done

# Defaults and numbers of full size beside a model.
sed 's/, freeboard: 0.12/, freeboard: 4/' moored.yaml >deck.yaml
told deck.yaml "vessel.hull.freeboard: the deck is 4 m above the water, more than the beam of 0.63 m|of a model too"
# What is left to Fram goes with the scale.
sed 's/, freeboard: 0.12//' moored.yaml >deck.yaml
expect 0 "$FRAM" check deck.yaml
! grep -q "vessel.hull.freeboard" err || fail "the usual deck is that of a ship: $(cat err)"
told moored.yaml "vessel.thrusters: 100 kN is 40.5 of the vessel's weight, about 2468 N|give newtons" \
    --set "vessel.thrusters[0].thrust=1e5"
# Thrusters together, and the line that is pulled the most.
told moored.yaml "vessel.thrusters: 1400 N is 0.567 of the vessel's weight" \
    --set "vessel.thrusters[0].thrust=700" --set "vessel.thrusters[1].thrust=700"
sed -e 's/lines: \[\(.*\)pretension: 30}/lines: [\1pretension: 2000}, \1pretension: 30}/' \
    -e 's/stiffness: 5/stiffness: 1e5/g' moored.yaml >lines.yaml
told lines.yaml "vessel.mooring.lines: 2000 N is 0.81 of the vessel's weight"
told moored.yaml "vessel.mooring.lines: 1000 kN is 405 of the vessel's weight" \
    --set "vessel.mooring.lines[0].pretension=1e6" --set "vessel.mooring.lines[0].stiffness=1e6"
told drive.yaml "vessel.propulsion.bollard_pull: 1000 kN is 405 of the vessel's weight" \
    --set vessel.propulsion.bollard_pull=1e6
told drive.yaml "vessel.propulsion.open_water_speed: 8 m/s is 1.61 times the root of gravity and length|2.53 m" \
    --set vessel.propulsion.open_water_speed=8
told towed.yaml "vessel.speed: 6 m/s is 1.2 times the root" --set vessel.speed=6

# A hull's file in millimetres reaches into the walls, and no mass fits it: its unit is told before that is refused.
"$FRAM" hull --length 40 --beam 10 --draught 4 --box -o metres.obj >told
awk '$1 == "v" { print "v", 1000 * $2, 1000 * $3, 1000 * $4; next } 1' metres.obj >mm.obj
printf '%s\n' 'vessel: {hull: {form: file, file: mm.obj}}' >mm.yaml
for options in domain.boundary=walls vessel.mass=1.6e6; do
    expect 2 "$FRAM" check mm.yaml --set $options
    says "vessel.hull.file: the waterline is 4e+04 m long, outside of 4 to 500: a file in millimetres wants" err
done
expect 0 "$FRAM" check mm.yaml --set vessel.hull.file_scale=0.001 --set domain.boundary=open
# One in metres that is read as if in millimetres, or a model.
sed 's/mm.obj/metres.obj/' mm.yaml >metres.yaml
told metres.yaml "hull.file: the waterline is 2 m long|hull.file_scale, now 0.05, is too small, or give run.scale of" \
    --set vessel.hull.file_scale=0.05
grep 'millimetres' err && fail "a hull that is too short is told to be in millimetres"
finish "ships in the scale of a model, and models with numbers of ships, are told with key and remedy"
