#!/usr/bin/env bash
# Input as somebody might bring it: open rings, some turned the wrong way, crossing themselves, overlapping; repaired,
# written, read again, and a run through them (scenes/real_input.yaml).  With the repository's own floes and hull of
# panels; with FRAM_TEST_LONG, and where they stand beside the sources, also with 462 observed floes and the hull of an
# FPSO.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
duration=60
transient=20
if [ -n "${FRAM_TEST_SHORT:-}" ]; then
    duration=2
    transient=0
fi

# try NAME FLOES RINGS WHOLE AREA [WORDS of fram run...]: rings of the file, those that stay whole at least, ice [m2].
try() {
    local name=$1 floes=$2 rings=$3 whole=$4 area=$5 code=0
    shift 5
    local out=$scratch/$name
    mkdir "$out"
    # Every ring is open.
    "$FRAM" field "$floes" --scale 0.01 --json >"$out/refused" 2>/dev/null || code=$?
    [ "$code" = 2 ] || {
        echo "FAILED: $name: open rings are not refused"
        exit 1
    }
    "$FRAM" field "$floes" --scale 0.01 --bad repair --smallest 5 --simplify 1 \
        -o "$out/field.geojson" --json >"$out/field"
    "$FRAM" field "$out/field.geojson" -o "$out/again.geojson" --json >"$out/again"
    cmp "$out/field.geojson" "$out/again.geojson"
    "$FRAM" run "$FRAM_SOURCE/scenes/real_input.yaml" -o "$out/run" --set run.duration=$duration \
        --set run.transient=$transient --set "ice.file=$floes" --threads 2 --quiet --json "$@" >"$out/answer"
    check "$out" "$rings" "$whole" "$area"
}

check() {
    python3 - "$@" "$duration" <<'PYTHON'
import csv, json, math, os, sys
scratch = sys.argv[1]
rings, whole, area, duration = int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]), float(sys.argv[5])
failures = []
def check(good, what):
    if not good:
        failures.append(what)
def last_line(name):
    with open(os.path.join(scratch, name)) as file:
        return json.loads(file.read().splitlines()[-1])

error = last_line('refused')['error']
check(error['key'] == 'feature 1, polygon 1, ring 1' and error['line'] in (1, 2), f'the place of the refusal: {error}')
field, again, run = last_line('field'), last_line('again'), last_line('answer')
check(field['rings'] == rings, f'{field["rings"]} rings instead of {rings}')
check(len({d['feature'] for d in field['repaired'] if 'closed' in d['reason']}) == rings, 'not every ring was closed')
check(field['floes'] >= whole, f'{field["floes"]} floes of {rings} rings')
check(field['overlap']['pairs'] == 0, f'{field["overlap"]} after the repair')
check(again['floes'] == field['floes'] and again['area_m2'] == field['area_m2'] and not again['repaired'],
      'the written field is another one')
check(abs(field['area_m2'] / area - 1) < 0.005, f'ice of {field["area_m2"]} m2')
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
}

try own "$FRAM_SOURCE/tests/data/floes.geojson" 72 72 487062
data=$FRAM_SOURCE/../shared/data
if [ -z "${FRAM_TEST_LONG:-}" ]; then
    echo "without the observed floes: they are for FRAM_TEST_LONG"
elif [ -f "$data/observed_floes.geojson" ] && [ -f "$data/hulls/fpso_low.gdf" ]; then
    try observed "$data/observed_floes.geojson" 462 462 1168741 --set "vessel.hull.file=$data/hulls/fpso_low.gdf" \
        --set vessel.x=-760 --set vessel.y=0 --set domain.x_min=-880
else
    echo "without the observed floes: there is no $data/observed_floes.geojson"
fi
