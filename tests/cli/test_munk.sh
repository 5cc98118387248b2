#!/usr/bin/env bash
# A table of current coefficients stands for Munk's moment too: one without it lets a moored ship swing itself up, and
# is told of.
. "$FRAM_SOURCE/tests/cli/slips.sh"

# ship NAME CN [COLUMNS]: a turret ship with a table of cn = CN sin 2a.
ship() {
    python3 - "$2" >"$1.csv" <<'PY'
import math, sys
print("angle[deg],cx[1],cy[1],cn[1]")
for a in range(0, 181, 15):
    r = math.radians(a)
    print(f"{a},{0.04 * math.cos(r):.6f},{0.75 * math.sin(r):.6f},{float(sys.argv[1]) * math.sin(2 * r):.6f}")
PY
    cat >"$1.yaml" <<YAML
run: {duration: 60, time_step: 0.1}
vessel:
  mode: free
  hull: {form: ship, length: 200, beam: 36, draught: 12, freeboard: 8}
  hydrodynamics: {source: estimate}
  current_coefficients: {table_file: $1.csv}
  mooring: {turret: true, x: 70, depth: 120, lines: [{count: 8, spacing_deg: 45, pretension: 1.0e6, distance: 1200}]}
ice: {source: none}
domain: {boundary: open}
environment: {current_speed: 1, current_direction_deg: 180}
YAML
}
ship none 0
ship against 0.08
ship with -0.08
ship little -0.02
ship half -0.042
ship most -0.075
words="vessel.current_coefficients: near a current from ahead the moment is"
untold() {
    local scene=$1
    shift
    expect 0 "$FRAM" check "$scene" "$@"
    grep 'of Munk' err && fail "told of $scene $*"
    return 0
}
# The ellipsoid of the estimate has k = (a22 - a11) / (rho A L) = 0.0843: cn = k sin 20 = 0.0288 at 170 degrees.
told none.yaml "$words 0 of Munk's, cn = 0.0288 at 170 degrees|give cn of the bare hull, or hydrodynamics.source: given"
told against.yaml "$words -0.9|hydrodynamics.source: given with a damping of"
told little.yaml "$words 0.2|may swing ever wider in a steady current"
untold with.yaml
told half.yaml "$words 0.49 of Munk's|may swing ever wider in a steady current"
untold most.yaml
# A table of all directions is judged on both sides.
awk -F, 'NR == 1 {print} NR > 1 {print; if ($1 < 180) row[++n] = (360 - $1) "," $2 "," (-$3) ",0"}
         END {while (n) print row[n--]}' with.csv >round.csv
told with.yaml "$words 0 of Munk's|bare hull" --set vessel.current_coefficients.table_file=round.csv
# Nothing of it without a flow, matrices or a table; where a helm or thrusters hold the heading; on a carriage; on a
# hull as broad as long, which has no such moment.
untold none.yaml --set environment.current_speed=0
untold none.yaml --set vessel.hydrodynamics.source=none
untold none.yaml --set vessel.current_coefficients.table_file=
untold none.yaml --set vessel.propulsion.bollard_pull=1e6 --set vessel.propulsion.open_water_speed=7
sed 's|mooring: .*|positioning: {active: true}\n  thrusters: [{x: 80, thrust: 1.0e6}, {x: -80, thrust: 1.0e6}]|' \
    none.yaml >positioned.yaml
untold positioned.yaml
untold none.yaml --set vessel.hull.form=box --set vessel.hull.length=40 --set vessel.hull.beam=40 \
    --set vessel.mooring.x=0
# Nor of a spread of lines, which holds the heading, and without lines.
untold none.yaml --set vessel.mooring.turret=false --set vessel.mooring.x=0
sed '/mooring:/d' none.yaml >loose.yaml
untold loose.yaml
untold loose.yaml --set environment.current_speed=0 --set vessel.speed=2
# Damping that is enough is heard of.
cat >rows.txt <<'YAML'
  hydrodynamics:
    source: given
    added_mass: [{surge: 2.1e6}, {sway: 5.3e7}, {heave: 7.1e7}, {roll: 2.0e9}, {pitch: 1.8e11}, {yaw: 1.2e11}]
    damping: [{surge: 1}, {sway: 1}, {heave: 3.0e7}, {roll: 5.0e8}, {pitch: 7.0e10}, {yaw: 1.0e9}]
YAML
sed -e '/hydrodynamics:/r rows.txt' -e '/hydrodynamics:/d' none.yaml >damped.yaml
told damped.yaml "$words 0 of Munk's|with a damping of 1.27e+09 N m s or more in yaw"
untold damped.yaml --set vessel.hydrodynamics.damping[5].yaw=1.28e9
finish "a table of the current without Munk's moment is told of"
