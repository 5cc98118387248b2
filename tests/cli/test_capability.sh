#!/usr/bin/env bash
# fram capability as a user meets it: files, JSON, errors.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
expect() {
    local wanted=$1 code=0
    shift
    "$@" >"$scratch/out" 2>"$scratch/err" || code=$?
    [ "$code" = "$wanted" ] || fail "exit code $code instead of $wanted: $*: $(tail -n 2 "$scratch/err")"
}
says() { grep -qF -- "$1" "$2" || fail "$2 lacks '$1': $(cat "$2")"; }

scene=$FRAM_SOURCE/scenes/supply_ship.yaml
expect 0 "$FRAM" capability "$scene" -o "$scratch/a" --formula --directions 12 --speed-step 0.2 --json
says '"file"' "$scratch/out"
python3 - "$scratch/a" <<'END' || fail "capability.json or its tables"
import csv, json, sys
a = sys.argv[1]
j = json.load(open(a + "/capability.json"))
rows = list(csv.DictReader(open(a + "/capability.csv")))
use = list(csv.DictReader(open(a + "/capability_use.csv")))
assert j["ice_load"] == "formula" and len(j["directions"]) == len(rows) == 12 and len(use) == 60, "counts"
for d, r in zip(j["directions"], rows):
    assert d["intact"]["speed"] == float(r["speed_intact[m/s]"]), "speed"
    assert d["after_worst_failure"]["speed"] <= d["intact"]["speed"] + 1e-9, "a failure makes nothing better"
    assert len(d["use"]) == 5, "use"
assert rows[0]["speed_intact[m/s]"] > rows[3]["speed_intact[m/s]"], "the bow holds more than the side"
END
case $("$FRAM" --version) in
*cairo*) for name in capability.png capability.svg; do
    [ -s "$scratch/a/$name" ] || fail "$name is missing"
done ;;
esac
expect 2 "$FRAM" capability "$scene" -o "$scratch/a" --formula
says '--force' "$scratch/err"
expect 2 "$FRAM" capability "$scene"
says '--output' "$scratch/err"
expect 2 "$FRAM" capability "$scene" -o "$scratch/b" --set domain.boundary=open
says 'domain.boundary' "$scratch/err"
[ ! -e "$scratch/b" ] || fail "a refused plot left a folder"
expect 2 "$FRAM" capability "$FRAM_SOURCE/scenes/demo.yaml" -o "$scratch/b"
says 'mode free' "$scratch/err"
[ "$failures" = 0 ]
