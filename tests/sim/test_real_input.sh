#!/usr/bin/env bash
# Input that was not made for Fram: 462 observed floes and the hull of an FPSO, for 120 s (scenes/real_input.yaml).
# Both files stand beside the sources, not in them; without them the test is skipped.
set -euo pipefail
data=$FRAM_SOURCE/../shared/data
for file in "$data/observed_floes.geojson" "$data/hulls/fpso_low.gdf"; do
    if [ ! -f "$file" ]; then
        echo "skipped: there is no $file"
        exit 77
    fi
done
duration=120
transient=20
if [ -n "${FRAM_TEST_SHORT:-}" ]; then
    duration=2
    transient=0
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The field by itself: every ring is open, and many overlap.
code=0
"$FRAM" field "$data/observed_floes.geojson" --scale 0.01 --json >"$scratch/refused" 2>/dev/null || code=$?
[ "$code" = 2 ] || {
    echo "FAILED: open rings are not refused"
    exit 1
}
"$FRAM" field "$data/observed_floes.geojson" --scale 0.01 --bad repair --smallest 5 --simplify 1 \
    -o "$scratch/field.geojson" --json >"$scratch/field"
"$FRAM" field "$scratch/field.geojson" -o "$scratch/again.geojson" --json >"$scratch/again"
cmp "$scratch/field.geojson" "$scratch/again.geojson"

"$FRAM" run "$FRAM_SOURCE/scenes/real_input.yaml" -o "$scratch/run" --set run.duration=$duration \
    --set run.transient=$transient --threads 2 --quiet --json >"$scratch/answer"

python3 - "$scratch" "$duration" <<'PYTHON'
import csv, json, math, os, sys
scratch, duration = sys.argv[1], float(sys.argv[2])
failures = []
def check(good, what):
    if not good:
        failures.append(what)
def last_line(name):
    with open(os.path.join(scratch, name)) as file:
        return json.loads(file.read().splitlines()[-1])

error = last_line('refused')['error']
check(error['key'] == 'feature 1, polygon 1, ring 1' and error['line'] == 1, f'the place of the refusal: {error}')
field, again, run = last_line('field'), last_line('again'), last_line('answer')
check(field['rings'] == 462, f'{field["rings"]} rings instead of 462')
check(len({d['feature'] for d in field['repaired'] if 'closed' in d['reason']}) == 462, 'not every ring was closed')
whole_lost = 462 - len({d['feature'] for d in field['repaired']})
check(whole_lost == 0 and field['floes'] >= 462, f'{field["floes"]} floes of 462 rings')
check(field['overlap']['pairs'] == 0, f'{field["overlap"]} after the repair')
check(again['floes'] == field['floes'] and again['area_m2'] == field['area_m2'] and not again['repaired'],
      'the written field is another one')
check(abs(field['area_m2'] / 1168741 - 1) < 0.005, f'ice of {field["area_m2"]} m2')
check(sum(field['histogram']['floes']) == field['floes'], 'the histogram has lost floes')

check(run['finished'] and run['time_s'] == duration, f'the run ended at {run["time_s"]} s')
check(run['floes'] == field['floes'], f'{run["floes"]} floes in the run, {field["floes"]} in the field')
with open(os.path.join(scratch, 'run', 'series.csv'), newline='') as file:
    rows = list(csv.DictReader(file))
check(len(rows) > 4 * duration, f'{len(rows)} rows')
values = [float(v) for row in rows for v in row.values()]
check(all(math.isfinite(v) for v in values), 'a value of the series is not finite')
load = min(float(row['ice_force_x[N]']) for row in rows)
check(duration < 20 or load < -1e5, f'no ice was met: the largest resistance is {-load} N')
for failure in failures:
    print('FAILED:', failure)
sys.exit(bool(failures))
PYTHON
