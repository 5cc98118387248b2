#!/usr/bin/env bash
# `fram check` and the report tell the scenario as it is computed: who keeps a vessel, histories, populations, arrows.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >ship.yaml <<'YAML'
run: {duration: 600, time_step: 0.05, transient: 60}
vessel:
  mode: free
  heading_deg: 90
  hull: {form: ship, length: 76, beam: 19, draught: 6.5, freeboard: 3.5, block_coefficient: 0.75}
  mooring:
    depth: 120
    turret: true
    equilibrium: false
    lines:
      - {count: 4, spacing_deg: 90, distance: 900, pretension: 8.0e5, weight: 1500, stiffness: 8.0e8}
      - {kind: spring, direction_deg: 0, distance: 300, pretension: 1.0e5, stiffness: 1.0e6}
  thrusters: [{x: 30, thrust: 2.0e5}]
  positioning: {active: true, control: heading}
ice:
  source: packed
  concentration: 0.7
  thickness: 0.7
  breakable: true
  populations:
    - {share: 3, size: constant, diameter: 20}
    - {share: 1, size: power, diameter_min: 5, diameter_max: 12, thickness: 0.4, flexural_strength: 3.0e5,
       breakable: false}
domain:
  {x_min: -200, x_max: 200, y_min: -200, y_max: 200, boundary: feeding, drift_speed: 0.3, drift_direction_deg: 45}
environment: {current_file: current.csv, wind_speed: 9, wind_direction_deg: -80}
YAML
# 0.3 m/s to the left at first, downward at the end; halfway between the rows at 300 s.
printf 'time[s],x[m/s],y[m/s]\n0,-0.3,0\n400,0,-0.5\n' >current.csv

told() { says "$1" err; }
expect 0 "$FRAM" check ship.yaml
told "vessel: free, bow towards 90 deg ↑, 0 m/s at the start, 5 mooring lines on a turret in 120 m of water, \
1 thruster, dynamic positioning of the heading alone"
expect 0 "$FRAM" check ship.yaml --set vessel.positioning.active=false
told "of water, 1 thruster at setting 0"
expect 0 "$FRAM" check ship.yaml --set vessel.positioning.active=false --set "vessel.thrusters[0].setting=0.5"
holds "of water, 1 thruster\$" err
expect 0 "$FRAM" check ship.yaml
told "ice: population 1 of 2: 75 % of the ice area, diameter 20 m; 0.7 m thick, crushing strength 2000 \
kPa, flexural strength 500 kPa, breaks"
told "ice: population 2 of 2: 25 % of the ice area, diameters 5 to 12 m, N(>D) as D^-1.7; 0.4 m thick, crushing \
strength 2000 kPa, flexural strength 300 kPa, does not break"
# The bow points up: what goes up and to the right comes from the lower left, which is the port quarter.
told "drift of the ice: 0.3 m/s towards 45 deg ↗, from the port quarter"
told "current: by current.csv, 0.3 to 0.5 m/s in 2 rows to 400 s: 0.3 m/s towards 180 deg ←, from the starboard beam \
at the start, 0.5 m/s towards -90 deg ↓ at the end of the run"
told "current: its last row, of 400 s, holds until the end of the run at 600 s"
told "wind: 9 m/s towards -80 deg ↓, from ahead"
printf 'depth[m],x[m/s],y[m/s]\n2,0.3,0.4\n30,0.1,0\n' >deep.csv
expect 0 "$FRAM" check ship.yaml --set environment.current_profile_file=deep.csv
told "current: on top of that up to 0.5 m/s at depths of 2 to 30 m, by deep.csv"
expect 0 "$FRAM" check ship.yaml
told "drift of the ice ↗ and wind ↓ are 125 deg apart"

# All eight arrows, and the sides from which a ship with its bow to the right is met.
side() {
    expect 0 "$FRAM" check ship.yaml --set vessel.heading_deg=0 --set "domain.drift_direction_deg=$1"
    told "drift of the ice: 0.3 m/s towards $1 deg $2, from $3"
}
side 0 → astern
side 45 ↗ "the starboard quarter"
side 90 ↑ "the starboard beam"
side 135 ↖ "the starboard bow"
side 180 ← ahead
side 225 ↙ "the port bow"
side 270 ↓ "the port beam"
side 315 ↘ "the port quarter"
side -45 ↘ "the port quarter"

# No ice, nothing that drifts.
sed '/^ice:/,/^environment:/d' ship.yaml >open.yaml
printf 'ice: {source: none}\ndomain: {boundary: open}\nenvironment: {wind_speed: 9}\n' >>open.yaml
expect 0 "$FRAM" check open.yaml
grep -q 'drift of the ice' err && fail "open water drifts as ice"
told "wind: 9 m/s"

# Where a moored vessel begins is found as its world is made; until then no side is met.
cat >tanker.yaml <<'YAML'
run: {duration: 0.1, time_step: 0.05}
vessel:
  mode: free
  hull: {form: ship, length: 180, beam: 30, draught: 10, freeboard: 5}
  mooring: {depth: 80, lines: [{count: 8, spacing_deg: 45, distance: 600, pretension: 5.0e5}]}
ice: {source: none}
domain: {boundary: open}
environment: {current_speed: 0.4, current_direction_deg: 150}
YAML
expect 0 "$FRAM" check tanker.yaml
told "bow towards 0 deg →, from which it begins at the equilibrium of its mooring, 0 m/s at the start, 8 mooring lines"
holds "current: 0.4 m/s towards 150 deg ↖\$" err
grep 'comes across' err && fail "a current across a hull is told, and how it lies is not known"
expect 0 "$FRAM" check tanker.yaml --build
told "bow towards 59.36 deg ↗ at the equilibrium of its mooring, 0 m/s at the start, 8 mooring lines"
told "current: 0.4 m/s towards 150 deg ↖, from the starboard beam"
told "a current of 0.4 m/s comes across the hull"
expect 0 "$FRAM" run tanker.yaml -o tanker
told "a current of 0.4 m/s comes across the hull"
# One that weathervanes to its current.
sed 's/depth: 80,/& turret: true, x: 60,/; s/mode: free/&\n  heading_deg: 90/' tanker.yaml >vane.yaml
for how in "check vane.yaml" "check vane.yaml --build" "run vane.yaml -o vane"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" $how --set environment.current_direction_deg=180
    grep 'comes across' err && fail "$how tells of a current across a hull that lies along it"
done
# A boat lies as far downstream of its anchor, 100 m ahead, as its line reaches: there the edge of the domain is near.
cat >boat.yaml <<'YAML'
run: {duration: 0.05, time_step: 0.05}
vessel:
  mode: free
  heading_deg: 90
  hull: {length: 20, beam: 6, draught: 2, freeboard: 1}
  mooring: {depth: 50, lines: [{kind: spring, distance: 100, pretension: 1e4, stiffness: 1e5, fairlead_distance: 0}]}
ice: {mean_floe_area: 100, thickness: 0.3, concentration: 0.1}
domain: {x_min: -100, x_max: 211, y_min: -100, y_max: 100, boundary: feeding}
environment: {current_speed: 0.5}
YAML
for how in "check boat.yaml --build" "run boat.yaml -o boat"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" $how
    told "domain: its edge with the band is"
    cp err "said.${how%% *}"
done
# Its ice is a tile that repeats, larger than the domain: the floes that are there are counted alike wherever they are.
floes=$(sed -n 's/^built: \([0-9]*\) floes.*/\1/p' said.check)
says "finished at t = 0.05 s after 1 step: $floes floes" said.run
holds "^$floes floes ([0-9]* in the tile that repeats, concentration 0.1000 of it)" said.run

# On a carriage.
cat >tow.yaml <<'YAML'
run: {duration: 60, time_step: 0.02}
vessel: {mode: towed, speed: 1.5, course_deg: 180, hull: {length: 60, beam: 14, draught: 5}}
ice: {source: none}
domain: {boundary: open}
YAML
expect 0 "$FRAM" check tow.yaml
told "vessel: moves 0.03 m in a step, 90 m in the run, towards 180 deg ←, bow towards 0 deg →"
told "wind: none"
# Over a ramp of 20 s it comes 15 m less far, and stays within a domain of 80 m.
expect 0 "$FRAM" check tow.yaml --set vessel.ramp=20 --set domain.x_min=-80
told "vessel: moves 0.03 m in a step, 75 m in the run, towards 180 deg ←, bow towards 0 deg →"
grep -q 'leaves the domain' err && fail "a vessel that has not come to the edge is told to leave"
expect 0 "$FRAM" check tow.yaml --set domain.x_min=-80
told "the vessel leaves the domain before the end, at (-90, "
expect 0 "$FRAM" check tow.yaml --set vessel.x=-1400000 --set vessel.y=2000000.5 --set domain.x_min=-1400080 \
    --set domain.x_max=-1399900 --set domain.y_min=1999900 --set domain.y_max=2000100
told "the vessel leaves the domain before the end, at (-1400090, 2000000.5) m"
# So does one that begins outside of the domain, unless it is told that there is no ice so far out.
leaves=("the vessel leaves the domain before the end, at (190, 0) m" --set vessel.x=100 --set domain.x_max=80)
for ice in none voronoi; do
    expect 0 "$FRAM" check tow.yaml --set ice.source=$ice --set vessel.course_deg=0 "${leaves[@]:1}"
    told "${leaves[0]}"
done
far=(--set vessel.course_deg=0 --set vessel.x=140 --set domain.x_max=80)
expect 0 "$FRAM" check tow.yaml "${far[@]}"
told "the vessel leaves the domain before the end, at (230, 0) m"
expect 0 "$FRAM" check tow.yaml --set ice.source=voronoi "${far[@]}"
told "(140, 0) m lies outside of the domain"
grep -q 'leaves the domain' err && fail "a vessel that lies outside is told to leave"

# On a path the bow is that of its first point.
path='path: [{time: 0, heading_deg: 90}, {time: 60, y: 30, heading_deg: 90}]'
sed "s/speed: 1.5, course_deg: 180/$path/" tow.yaml >path.yaml
printf 'environment: {current_speed: 0.5, current_direction_deg: 270}\n' >>path.yaml
expect 0 "$FRAM" check path.yaml
told "current: 0.5 m/s towards 270 deg ↓, from ahead"

# The report says the same, and that a history is not what it was where it is not.
expect 0 "$FRAM" run tow.yaml -o towed --quiet --set run.duration=2 --set environment.current_file=current.csv
echo nothing >current.csv
expect 0 "$FRAM" report towed --quiet
says "current: by current.csv, which cannot be read here" towed/report.html
says "bow towards 0 deg →" towed/report.html

# A wall that a ship under its own power drives into: said before, when it happens, and first in the report.
cat >wall.yaml <<'YAML'
run: {duration: 40, time_step: 0.02}
vessel:
  mode: free
  speed: 3
  hull: {form: ship, length: 80, beam: 18, draught: 6}
  propulsion: {bollard_pull: 8.0e5, open_water_speed: 6, speed: 4}
ice: {source: none}
domain: {x_min: -60, x_max: 100, y_min: -60, y_max: 60, boundary: walls}
YAML
expect 0 "$FRAM" check wall.yaml --build
# 100 - 40 m to the stem at 4 m/s; the freeboard of the raked stem takes a little of it.
python3 - err <<'PY' || fail "the wall ahead is not told: $(grep wall err)"
import re, sys
way, time = map(float, re.search(r"can reach a wall of the domain, ([\d.]+) m ahead of the hull, at t = ([\d.]+) s",
                                 open(sys.argv[1]).read()).groups())
assert 55 < way <= 60 and abs(time - way / 4) < 0.01 * time, (way, time)
PY
expect 0 "$FRAM" check wall.yaml --build --set run.duration=10
grep -q 'wall' err && fail "a wall out of reach is told: $(grep wall err)"
expect 0 "$FRAM" check wall.yaml --build --set domain.boundary=open
told "the vessel can leave the domain before the end"
# Where there is ice, the end tells who has left it; 130 m from the middle are 30 m beyond the edge.
sed 's/^ice:.*/ice: {mean_floe_area: 100, thickness: 0.5, concentration: 0.1}/' wall.yaml >left.yaml
expect 0 "$FRAM" run left.yaml -o left --set domain.boundary=open --set vessel.mode=towed \
    --set vessel.propulsion.bollard_pull=auto --set vessel.speed=10 --set run.duration=13 --set vessel.ramp=0
says "the vessel lies outside of the domain in the end, at (1" err
expect 0 "$FRAM" run left.yaml -o left --force --set domain.boundary=open --set run.duration=2
grep -q 'outside of the domain' err && fail "a vessel inside of the domain is told as one that left it"
expect 0 "$FRAM" run wall.yaml -o hit
same "$(grep -c 'the hull runs into a wall of the domain' err)" 1 "walls are told once"
expect 0 "$FRAM" report hit --quiet
says "The vessel ran into a wall of the domain at" hit/report.html
python3 - <<'PY' || fail "the run does not name the wall"
import csv, json, math, re
at = [e["time_s"] for e in json.load(open("hit/run.json"))["events"] if e["kind"] == "wall"]
# It begins at 3 m/s and never exceeds 4: 55 to 60 m take 13.7 to 20 s.
assert len(at) == 1 and 13.7 < at[0] < 20, at
# The report tells the load that is none of the ice, as the series has it.
told = re.search(r"nother hull or a wall touched it, first at ([\d.]+) s: largest horizontal force ([\d.]+) (\wN), at "
                 r"([\d.]+) s", open("hit/report.html").read())
rows = list(csv.DictReader(open("hit/series.csv")))
force = [math.hypot(*(float(r[f"hull_contact_force_{a}[N]"]) for a in "xy")) for r in rows]
first = next(float(r["time[s]"]) for r, f in zip(rows, force) if f > 0)
newton = float(told[2]) * {"kN": 1e3, "MN": 1e6}[told[3]]
assert abs(float(told[1]) - first) < 1e-3 and abs(newton / max(force) - 1) < 0.01, (told[0], first, max(force))
assert abs(float(told[4]) - float(rows[force.index(max(force))]["time[s]"])) < 1e-3, told[0]
PY
expect 0 "$FRAM" run wall.yaml -o clear --quiet --set run.duration=10
expect 0 "$FRAM" report clear --quiet
grep -q 'a wall touched it' clear/report.html && fail "a ship that met nothing is said to have been touched"
grep -q 'a wall of the domain at' clear/report.html && fail "a ship that is clear is said to be at a wall"

# Motion that is given goes on through a wall: said before with the time, by whatever way it is given, when it happens,
# at the end and first in the report.  The bow of 80 m reaches x = 100 after 60 m less the rake of the stem.
driven() { # MODE EDITS WORDS LEAST MOST
    local mode=$1 edits=$2 words=$3 least=$4 most=$5
    sed "/propulsion:/d; s/mode: free/mode: $mode/; $edits" wall.yaml >driven.yaml
    expect 0 "$FRAM" check driven.yaml
    told "$words"
    cp err said
    expect 0 "$FRAM" run driven.yaml -o driven --force
    says "the hull is driven into a wall of the domain by the motion that is given to it" err
    grep -v -e '%' -e 'is skipped' err | tail -n 3 | grep -q 'the vessel reached a wall of the domain at t = ' ||
        fail "the end of a $mode run does not name the wall"
    expect 0 "$FRAM" report driven --quiet
    says "The vessel ran into a wall of the domain at" driven/report.html
    python3 - "$least" "$most" <<'PY' || fail "a $mode vessel meets the wall at another time than was said"
import json, re, sys
at = [e["time_s"] for e in json.load(open("driven/run.json"))["events"] if e["kind"] == "wall"]
said = float(re.search(r"reaches a wall of the domain at t = ([\d.]+) s", open("said").read()).group(1))
assert len(at) == 1 and float(sys.argv[1]) < at[0] <= float(sys.argv[2]), at
assert abs(at[0] - said) < 0.05, (at, said)
PY
}
for mode in towed prescribed; do
    driven $mode "" "vessel.speed: the hull reaches a wall of the domain at t = " 18 20.02
    # 30 m in ten seconds, the other 30 at 9 m/s.
    driven $mode 's/^  speed: 3/  path: [{time: 0}, {time: 10, x: 30}, {time: 20, x: 120}, {time: 30, x: 0}]/' \
        "vessel.path[2]: the hull reaches a wall of the domain at t = " 12.5 13.36
done

# Waypoints in a wall.
cp wall.yaml course.yaml
sed -i 's/speed: 4}/speed: 4, waypoints: [{x: 50, y: 0}, {x: 50, y: 70}]}/' course.yaml
expect 0 "$FRAM" check course.yaml --build
told "vessel.propulsion.waypoints[1]: at (50, 70) m the hull stands in a wall of the domain"
finish "the scenario is told as it is computed"
