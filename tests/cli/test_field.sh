#!/usr/bin/env bash
# fram field as a user meets it: what a field is, mending, cutting, drawing, out and back, errors with their place.
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
failures=0
fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
# expect CODE COMMAND...: runs it, keeps its output in out and err.
expect() {
    local wanted=$1 code=0
    shift
    "$@" >out 2>err || code=$?
    [ "$code" = "$wanted" ] || fail "exit code $code instead of $wanted: $*: $(tail -n 2 err)"
}
# The value of an expression of the JSON object j on the last line of out.
value() { tail -n 1 out | python3 -c 'import json, sys; j = json.load(sys.stdin); print('"$1"')'; }
same() { [ "$1" = "$2" ] || fail "$3: '$1' instead of '$2'"; }
says() { grep -qF -- "$1" "$2" || fail "$2 lacks '$1': $(cat "$2")"; }

# Two squares, one of them with a thickness, and a bow tie of two triangles of 25 m2.
cat >floes.geojson <<'JSON'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"thickness":0.7},"geometry":{"type":"Polygon",
"coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[20,0],[30,10],[30,0],[20,10],[20,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[40.1,0],[40.1,10],[50.1,10],[50.1,0],[40.1,0]]]}}
]}
JSON

# The bow tie is refused with its place, dropped, mended.
expect 2 "$FRAM" field floes.geojson --json
same "$(value 'j["error"]["file"], j["error"]["line"], j["error"]["column"], j["error"]["key"]')" \
    "floes.geojson 5 16 feature 2, polygon 1, ring 1" "place of the bow tie"
says "floes.geojson:5:16: feature 2, polygon 1, ring 1: the ring crosses or touches itself" err
expect 0 "$FRAM" field floes.geojson --bad drop --json
same "$(wc -l <out)" 1 "lines of JSON"
same "$(value 'j["rings"], j["floes"], j["area_m2"], len(j["dropped"]), len(j["repaired"])')" "3 2 200 1 0" dropped
same "$(value 'j["dropped"][0]["feature"], j["dropped"][0]["line"]')" "2 5" "what was dropped"
expect 0 "$FRAM" field floes.geojson --bad repair --json
same "$(value 'j["floes"], j["area_m2"], len(j["repaired"]), sum(j["histogram"]["floes"])')" "4 250 1 4" repaired
expect 0 "$FRAM" field floes.geojson --bad drop
says "2 floes of 3 rings" out
says "left out: feature 2" out

# Scaled, moved, cut at a window.
expect 0 "$FRAM" field floes.geojson --bad drop --scale 0.5 --x 100 --y -7 --json
same "$(value 'j["area_m2"], j["bounds_m"]')" "50 [100, -7, 125.05, -2]" "scaled and moved"
expect 0 "$FRAM" field floes.geojson --bad drop --centre --json
same "$(value 'max(abs(a - b) for a, b in zip(j["bounds_m"], (-25.05, -5, 25.05, 5))) < 1e-12')" True "in the centre"
expect 0 "$FRAM" field floes.geojson --bad drop --crop 5,0,25,10 --json
same "$(value 'j["floes"], j["area_m2"], j["concentration"]')" "1 50 0.25" "cut at a window"
expect 0 "$FRAM" field floes.geojson --bad repair --smallest 30 --json
same "$(value 'j["floes"], len(j["dropped"])')" "2 2" "without small floes"

# Out and back to the bit, thickness included; through a link or a device, which stay what they are.
expect 0 "$FRAM" field floes.geojson --bad repair --scale 0.3333333333333333 -o once.geojson --json
expect 0 "$FRAM" field once.geojson -o twice.geojson --json
cmp -s once.geojson twice.geojson || fail "a written field reads back as another one"
grep -qF '"thickness":0.7' once.geojson || fail "the thickness is lost"
ln -s /dev/full full
if [ -w /dev/full ]; then
    expect 1 "$FRAM" field once.geojson -o full --json
    same "$(value 'j["error"]["file"], j["error"]["status"]')" "full io" "a full disk"
    [ -L full ] || fail "the link to a device was replaced"
fi
if "$FRAM" --version | grep -q pictures; then
    expect 0 "$FRAM" field once.geojson --draw field.png
    head -c 8 field.png | od -An -tx1 | grep -q "89 50 4e 47" || fail "field.png is no PNG"
    expect 2 "$FRAM" field once.geojson --draw no/such/folder/field.png
fi

# Words and files that are wrong.
expect 2 "$FRAM" field
expect 2 "$FRAM" field missing.geojson
says "missing.geojson" err
expect 2 "$FRAM" field . --json
same "$(value 'j["error"]["file"]')" . "a folder as a file"
expect 2 "$FRAM" field once.geojson -o .
says "found a folder" err
: >empty.geojson
expect 2 "$FRAM" field empty.geojson
says "empty.geojson:1:1" err
printf '\xff\xfe{' >other.geojson
expect 2 "$FRAM" field other.geojson
says "other.geojson:1:1: expected" err
for words in "--scale 0" "--scale nan" "--scale -1" "--scale 1e300" "--crop 1,2,3" "--crop 3,0,1,1" "--crop 0,0,1,nan" \
    "--simplify -1" "--smallest -1" "--bad mend" "--smallest 1e9" "--x 1e400" "--wrong"; do
    # shellcheck disable=SC2086  # an option and its value
    expect 2 "$FRAM" field once.geojson $words --json
    value 'j["error"]["message"]' >/dev/null || fail "no JSON error after $words"
done

[ "$failures" = 0 ] || exit 1
