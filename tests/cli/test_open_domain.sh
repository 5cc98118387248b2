#!/usr/bin/env bash
# Ice drifts out of an open domain and none comes in: told before the run where a vessel stays and the current takes
# the ice past it, and in the verdict where it did; not of ships that go through their ice.
. "$FRAM_SOURCE/tests/cli/slips.sh"
. "$FRAM_SOURCE/tests/cli/verdict_box.sh"

cat >moored.yaml <<'YAML'
run: {duration: 240, time_step: 0.05, transient: 20}
vessel:
  mode: free
  hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}
  mooring:
    depth: 50
    lines: [{count: 4, spacing_deg: 90, direction_deg: 45, distance: 300, pretension: 2.0e5, weight: 600}]
  station: {offset_limit: 5}
ice: {concentration: 0.6, mean_floe_area: 100, thickness: 0.6}
domain: {x_min: -40, x_max: 40, y_min: -30, y_max: 30, boundary: open}
environment: {current_speed: 0.6, current_direction_deg: 180}
output: {csv_interval: 1, frame_interval: 0}
YAML
words="no ice comes into an open domain, and the current can take the last of it past the vessel by t = "
untold() {
    local scene=$1
    shift
    expect 0 "$FRAM" check "$scene" "$@"
    grep 'no ice comes into an open domain' err && fail "told of $scene $*"
    return 0
}
# The field is 40 m long updrift of the ship, whose hull ends at most 10.8 m from amidships: 50.8 m at 0.6 m/s.
told moored.yaml "$words|84.7 s, of 240 s: means are then of open water too; for ice that drifts past it take feeding"
told moored.yaml "$words|120 s, of 240 s" --set environment.current_direction_deg=0 --set vessel.x=21.2
untold moored.yaml --set run.duration=80
untold moored.yaml --set environment.current_speed=0.2
untold moored.yaml --set domain.boundary=feeding --set domain.x_min=-90 --set domain.x_max=90 \
    --set domain.y_min=-90 --set domain.y_max=90
untold moored.yaml --set ice.source=none
untold moored.yaml --set ice.source=level
# What stands still is passed by its ice as well; what is towed leaves it on purpose, and what drives itself or drifts.
sed '/mooring:/,/station:/d' moored.yaml >loose.yaml
told loose.yaml "$words|take feeding" --set vessel.mode=towed
told loose.yaml "walls keep the ice in a basin|take feeding" --set vessel.mode=towed --set domain.boundary=walls
untold loose.yaml --set vessel.mode=towed --set vessel.speed=0.4
untold loose.yaml
untold loose.yaml --set vessel.propulsion.bollard_pull=2e5 --set vessel.propulsion.open_water_speed=5
# A tide takes the ice 36 m away and back; one that is twice as long takes it for good when it goes.
printf '%s,0\n' 'time,x' 0,-0.6 60,-0.6 61,0.6 120,0.6 121,-0.6 180,-0.6 181,0.6 240,0.6 >tide.csv
sed -i '1s/.*/time,x,y/' tide.csv
untold moored.yaml --set environment.current_file=tide.csv
awk -F, 'NR == 1 {print; next} {print 2 * $1 "," $2 "," $3}' tide.csv >slow.csv
untold moored.yaml --set environment.current_file=slow.csv
told moored.yaml "$words|s, of 350 s" --set environment.current_file=slow.csv --set run.duration=350
# A ship that thrusters lead through its field: not in still water, nor out of the domain; no faster than it is led.
cat >led.yaml <<'YAML'
run: {duration: 300, time_step: 0.05, transient: 10}
vessel:
  mode: free
  x: -60
  hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}
  positioning: {active: true, reference_speed: 0.5, waypoints: [{time: 5, x: 75, y: 0}]}
  thrusters: [{x: 8, thrust: 6e4}, {x: -8, thrust: 6e4}]
  station: {offset_limit: 20}
ice: {concentration: 0.5, mean_floe_area: 60, thickness: 0.3}
domain: {x_min: -80, x_max: 80, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 0.2, current_direction_deg: 180}
output: {csv_interval: 1, frame_interval: 0}
YAML
# At 0.5 m/s it is at 75 m after 275 s; ice of the domain's end has come to 25 m by then.  Its hull is out at 80 s.
told led.yaml "$words|s, of 300 s"
early=$(sed -n 's/.*by t = \([0-9.]*\) s.*/\1/p' err | head -1)
told led.yaml "$words|s, of 300 s" --set vessel.positioning.reference_speed=2
python3 -c "import sys; a, b = map(float, sys.argv[1:]); sys.exit(not b < a)" "$early" \
    "$(sed -n 's/.*by t = \([0-9.]*\) s.*/\1/p' err | head -1)" || fail "how fast it is led does not count"
untold led.yaml --set environment.current_speed=0 --set vessel.positioning.waypoints[0].x=140
untold led.yaml --set vessel.positioning.waypoints[0].x=140

expect 0 "$FRAM" run moored.yaml -o moored --quiet
verdict moored
holds '^caution' verdict.txt
holds 'Ice last touched it at [0-9]* s of 240 s, and the open domain has [0-9]* of [0-9]* floes left: means' verdict.txt
python3 - <<'PY' || fail "the last contact is not that of the series"
import csv, json, re
rows = list(csv.reader(open("moored/series.csv")))
name = [c.split("[")[0] for c in rows[0]]
t, x, y = (name.index(n) for n in ("time", "ice_force_averaged_x", "ice_force_averaged_y"))
last = max(float(r[t]) for r in rows[1:] if float(r[x]) or float(r[y]))
assert json.load(open("moored/station.json"))["ice_last_contact_s"] == last
assert f"Ice last touched it at {last:.6g} s" in open("verdict.txt").read()
PY
# Ice that is there until the end, and a ship that is towed out of its ice.
expect 0 "$FRAM" run moored.yaml -o there --quiet --set run.duration=40
verdict there
grep 'open domain' verdict.txt && fail "ice that is still there is told to have left"
# The end of a long field that passes the ship to the last second, though most of its floes are gone.
expect 0 "$FRAM" run moored.yaml -o end --quiet --set run.duration=400 --set vessel.x=150 \
    --set ice.mean_floe_area=60 --set environment.current_direction_deg=0 --set domain.x_min=-180 --set domain.x_max=180
verdict end
grep 'open domain' verdict.txt && fail "a ship in ice to the end is told that ice has left"
expect 0 "$FRAM" run loose.yaml -o towed --quiet --set vessel.mode=towed --set vessel.speed=0.6 --set vessel.x=-25
verdict towed
grep 'open domain' verdict.txt && fail "a ship that leaves its ice on purpose is blamed"
expect 0 "$FRAM" run led.yaml -o led --quiet --set vessel.positioning.waypoints[0].x=140 \
    --set vessel.positioning.reference_speed=1 --set environment.current_speed=0
verdict led
grep 'open domain' verdict.txt && fail "a ship that thrusters lead out of its ice is blamed"
finish "ice that leaves an open domain is told of"
