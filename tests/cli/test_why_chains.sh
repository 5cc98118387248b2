#!/usr/bin/env bash
# fram why: chains of floes are told to what ends them, however long: a wall, another vessel by its name, the vessel
# itself; and what the largest load of a moment computed again is.
. "$FRAM_SOURCE/tests/cli/common.sh"
printf 'time[s],x[m/s],y[m/s]\n20,0,0\n' >calm.csv

# row COUNT: so many floes between a hull that a current pushes and a wall.
row() {
    cat <<YAML
run: {duration: 12, time_step: 0.02, transient: 2}
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}
  hydrodynamics: {source: none}
environment: {current_speed: 2, wind_file: calm.csv}
domain: {boundary: walls, x_min: -60, x_max: $((20 + 8 * $1)).02, y_min: -40, y_max: 40}
ice:
  source: floes
  crushing_strength: 1.0e9
  floes:
YAML
    for ((i = 0; i < $1; i++)); do echo "    - {x: $((24 + 8 * i)).005, y: 0, length: 8, width: 8}"; done
}
first="(lambda f: (len(f['chain']), f['left_out'], f['end'], f['end_vessel']))(j['floes'][0])"

row 13 >thirteen.yaml
expect 0 "$FRAM" run thirteen.yaml -o thirteen --quiet
expect 0 "$FRAM" why thirteen --peak 1 --no-rerun
says ", behind it 12 more to a wall." out
holds '-> floe 11 (.*) -> floe 12 (.*) -> wall (.*); the end: it is a wall' out
expect 0 "$FRAM" why thirteen --peak 1 --no-rerun --json
same "$(value "$first")" "(14, None, 'wall', None)" "a row of thirteen"

# Of a longer one the first links and the last ones are kept.
row 30 >thirty.yaml
expect 0 "$FRAM" run thirty.yaml -o thirty --quiet
expect 0 "$FRAM" why thirty --peak 1 --no-rerun
says ", behind it 29 more to a wall." out
holds '-> floe 15 (.*) -> ... 7 more ... -> floe 23 (.*) -> wall (.*); the end: it is a wall' out
expect 0 "$FRAM" why thirty --peak 1 --no-rerun --json
same "$(value "$first")" "(24, {'links': 7, 'after': 16}, 'wall', None)" "a row of thirty"
same "$(value "[l['floe'] for l in j['floes'][0]['chain']] == [*range(16), *range(23, 30), -1]")" True "its links"

# Between a tug and a barge.
cat >two.yaml <<'YAML'
run: {duration: 8, time_step: 0.02, transient: 1}
vessels:
  - {name: tug, mode: prescribed, speed: 0.02, hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}}
  - {name: barge, mode: prescribed, x: 56.02, hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}}
domain: {boundary: open, x_min: -60, x_max: 120, y_min: -40, y_max: 40}
ice:
  source: floes
  crushing_strength: 1.0e9
  floes: [{x: 24.005, y: 0, length: 8, width: 8}, {x: 32.005, y: 0, length: 8, width: 8}]
YAML
expect 0 "$FRAM" run two.yaml -o two --quiet
expect 0 "$FRAM" why two --peak 1 --vessel tug --no-rerun
says ", behind it 1 more to barge." out
holds 'hull -> floe 0 (.*) -> floe 1 (.*) -> barge (.*); the end: it is a vessel' out
says "a chain of floes against fixed or driven ice, a wall or another vessel" out
expect 0 "$FRAM" why two --peak 1 --vessel tug --no-rerun --json
same "$(value "$first")" "(3, None, 'vessel', 'barge')" "a row between two vessels"
same "$(value "j['mechanisms']['chain'] > 0.5 * j['load']")" True "what stands at another vessel is a chain"

# Two floes between the hulls of a catamaran that narrows towards its stern: they lean on the vessel that pushes them.
python3 - >funnel.obj <<'PY'
points, faces = [], []
for side in (1, -1):
    plan = [(20, 11), (20, 15), (-20, 15), (-20, 9)]
    plan = [(x, side * y) for x, y in plan][::-side]
    plan = plan[::-1]
    at = len(points) + 1
    points += [(x, y, -3) for x, y in plan] + [(x, y, 2) for x, y in plan]
    faces += [(at + 3, at + 2, at + 1, at), (at + 4, at + 5, at + 6, at + 7)]
    faces += [(at + i, at + (i + 1) % 4, at + 4 + (i + 1) % 4, at + 4 + i) for i in range(4)]
for point in points:
    print("v", *point)
for face in faces:
    print("f", *face)
PY
cat >funnel.yaml <<'YAML'
run: {duration: 12, time_step: 0.02, transient: 1}
vessel: {mode: towed, speed: 1, ramp: 0.1, hull: {form: file, file: funnel.obj}}
domain: {boundary: open, x_min: -60, x_max: 60, y_min: -40, y_max: 40}
ice:
  source: floes
  thickness: 0.6
  crushing_strength: 1.0e9
  floes: [{x: 16, y: 5.05, length: 10, width: 10}, {x: 16, y: -5.05, length: 10, width: 10}]
YAML
expect 0 "$FRAM" run funnel.yaml -o funnel --quiet
expect 0 "$FRAM" why funnel --peak 1 --no-rerun
says ", behind it 1 more and back to the vessel itself." out
holds 'hull -> floe . (.*) -> floe . (.*) -> hull (.*); the end: it is the vessel itself' out
expect 0 "$FRAM" why funnel --peak 1 --no-rerun --json
same "$(value "$first")" "(3, None, 'itself', None)" "a chain that comes back"
same "$(value "(j['mechanisms']['chain'], j['mechanisms']['accumulation'] > 0.1 * j['load'])")" "(0, True)" \
    "its mechanism"

# A moment behind a blow: the largest load of the span that is computed again is told as another than what is explained.
cat >blow.yaml <<'YAML'
run: {duration: 8, time_step: 0.02, transient: 0}
vessel: {mode: prescribed, x: -20, speed: 1, hull: {form: box, length: 30, beam: 10, draught: 3, freeboard: 3}}
domain: {x_min: -60, x_max: 100, y_min: -40, y_max: 40, boundary: open}
ice:
  source: floes
  thickness: 0.8
  crushing_strength: 5.0e7
  floes: [{x: 2.25, length: 10, width: 10}]
YAML
expect 0 "$FRAM" run blow.yaml -o blow --quiet
expect 0 "$FRAM" why blow --peak 1
grep -q "explained above" out && fail "the peak is explained, and told as another load: $(cat out)"
expect 0 "$FRAM" why blow --peak 1 --json
at=$(value "f\"{j['time'] + 0.6:.6g}\"")
expect 0 "$FRAM" why blow --time "$at" --json
same "$(value "j['computed_again']['same'] > 1.2 * j['load'] > 0")" True "a larger load before"
same "$(value "round(j['computed_again']['largest_from'] - j['time'], 6)")" -1.0 "since when it is looked for"
same "$(value "round(j['computed_again']['largest_to'] - j['time'], 6)")" 0.24 "until when it is looked for"
expect 0 "$FRAM" why blow --time "$at"
holds "largest averaged load from .* s to .* s:" out
holds "(as in the run, that is more than the .* [kM]\?N at $at s, which are explained above)" out
finish "chains are told to their ends"
