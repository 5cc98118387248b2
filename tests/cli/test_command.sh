#!/usr/bin/env bash
# The command as a user meets it: exit codes, JSON, folders, stopping and resuming.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
title: A small field
run:
  duration: 2
  time_step: 0.02
vessel:
  mode: towed
  x: -30
  speed: 2
  hull:
    length: 48
    beam: 12
    draught: 4
    freeboard: 2
ice:
  mean_floe_area: 64
domain:
  x_min: -64
  x_max: 64
  y_min: -40
  y_max: 40
YAML

# Help and version.
expect 0 "$FRAM" --help
grep -q "fram run scenes/demo.yaml" out || fail "--help shows no example"
expect 0 "$FRAM" --version
grep -qE '^fram [0-9]+\.[0-9]+\.[0-9]+' out || fail "--version prints no version"
commands=$("$FRAM" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(echo "$commands" | wc -l)" -gt 15 ] || fail "--help names only: $commands"
for command in $commands; do
    expect 0 "$FRAM" "$command" --help
    [ "$command" = keys ] || grep -q "Examples:" out || fail "$command --help shows no example"
    twice=$(sed -n 's/^  \(-., \)\{0,1\}\(--[a-z-]*\).*/\2/p' out | sort | uniq -d)
    [ -z "$twice" ] || fail "$command --help tells $twice twice"
done
expect 2 "$FRAM"
expect 2 "$FRAM" sail --json
same "$(value 'j["error"]["key"]')" sail "key of an unknown command"

# --json ends with one object whatever is asked, and is UTF-8 whatever the words are.
for words in "--help" "--version" "run --help" "keys" "check scene.yaml"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" $words --json
    value j >/dev/null || fail "$words --json ends with no JSON object"
done
expect 2 "$FRAM" --json
value 'j["error"]["message"]' >/dev/null || fail "a missing command is no JSON error"
expect 2 "$FRAM" check $'\xff\xc3\xa9.yaml' --json
same "$(value 'j["error"]["file"]')" $'\xef\xbf\xbd\xc3\xa9.yaml' "a file name that is no UTF-8"

# An answer that cannot be written is a failure.
if [ -c /dev/full ]; then
    for words in "--version" "keys" "check scene.yaml --json"; do
        # shellcheck disable=SC2086
        code=0 && "$FRAM" $words >/dev/full 2>err || code=$?
        same "$code" 1 "exit code of $words on a full disk"
    done
fi

# Usage errors.
expect 2 "$FRAM" run scene.yaml --json
same "$(value 'j["error"]["key"]')" --output "missing -o"
expect 2 "$FRAM" run scene.yaml -o a --wrong
expect 2 "$FRAM" run scene.yaml -o a --until soon
expect 2 "$FRAM" run scene.yaml -o a --until 0
expect 2 "$FRAM" run scene.yaml -o a --until -1 --json
same "$(value 'j["error"]["key"]')" --until "key of a time before the start"
expect 2 "$FRAM" run scene.yaml more words -o a
expect 2 "$FRAM" run -o a
expect 2 "$FRAM" run scene.yaml -o a --threads 0
expect 2 "$FRAM" run scene.yaml -o a --isa sse9
[ ! -e a ] || fail "a refused run left a folder"

# Input errors name file, line and key.
sed 's/speed: 2/sped: 2/' scene.yaml >wrong.yaml
expect 2 "$FRAM" run wrong.yaml -o a --json
same "$(value 'j["error"]["file"]')" wrong.yaml "file of an input error"
same "$(value 'j["error"]["line"]')" 8 "line of an input error"
same "$(value 'j["error"]["key"]')" vessel.sped "key of an input error"
says "wrong.yaml:8" err
expect 2 "$FRAM" check missing.yaml
sed 's/    length: 48/    form: file\n    file: hull.stl/; /beam:/d; /draught:/d; /freeboard:/d' scene.yaml >hull.yaml
expect 2 "$FRAM" check hull.yaml --json
same "$(value 'j["error"]["line"]')" 11 "line of a missing file"
same "$(value 'j["error"]["key"]')" vessel.hull.file "key of a missing file"
expect 2 "$FRAM" check scene.yaml --set ice.thickness=-1 --json
same "$(value 'j["error"]["key"]')" ice.thickness "key of a bad override"
[ ! -e a ] || fail "a refused scenario left a folder"
expect 2 "$FRAM" check scene.yaml --build --set ice.concentration=0.99999 --json
same "$(value 'j["error"]["key"], j["error"]["file"]')" "ice.concentration --set" "place of what cannot be reached"
expect 2 "$FRAM" check scene.yaml --build --set domain.x_min=-1e7 --set domain.x_max=1e7 --json
same "$(value 'j["error"]["key"], j["error"]["line"]')" "ice.mean_floe_area 15" "place of too many cells"
expect 2 "$FRAM" run scene.yaml -o a --set vessel.x=-40 --json
same "$(value 'j["error"]["key"]')" vessel.x "key of a hull inside a wall"
same "$(value 'j["error"]["file"]')" --set "place of a hull inside a wall"

printf 'angle[deg],cx,cy,cn\n0,1,0,0\n90,0,101,0\n180,-1,0,0\n' >wind.csv
expect 2 "$FRAM" check scene.yaml --build --set vessel.wind_coefficients.table_file=wind.csv --json
same "$(value 'j["error"]["file"], j["error"]["line"]')" "wind.csv 3" "place of a coefficient that cannot be"
says "from -100 to 100" err

# check prints a scenario that reads back as itself.
expect 0 "$FRAM" check scene.yaml --set run.seed=7
cp out full.yaml
expect 0 "$FRAM" check full.yaml
cmp -s out full.yaml || fail "check is not its own fixed point"
grep -q "seed: 7" out || fail "--set is not in what check prints"
expect 0 "$FRAM" check scene.yaml --build --json
[ "$(value 'j["floes"]')" -gt 20 ] || fail "check --build counted $(value 'j["floes"]') floes"
expect 2 "$FRAM" check scene.yaml --build --set vessel.x=-60 --json
same "$(value 'j["error"]["key"]')" vessel.x "key of a hull inside a wall, told by check --build"

# A run, its files and its JSON.
expect 0 "$FRAM" run scene.yaml -o straight --json
hash=$(value 'j["state_hash"]')
same "$(value 'j["steps"]')" 100 "steps"
same "$(wc -l <out)" 1 "lines on standard output with --json"
for key in wall_s real_time_factor; do value "j[\"$key\"]" >/dev/null || fail "no $key"; done
for file in scenario.yaml run.json series.csv record.fram; do [ -s "straight/$file" ] || fail "no $file"; done
same "$(wc -l <straight/series.csv)" 101 "rows of the time series"
head -n 1 straight/series.csv | grep -q '^time\[s\],position_x\[m\],' || fail "header of the time series"
python3 -c 'import json; json.load(open("straight/run.json"))' || fail "run.json is no JSON"
python3 - <<'PYTHON' || fail "run.json does not tell how long steps took"
import json
note = json.load(open("straight/run.json"))
times = [note[f"step_wall_{rank}_ms"] for rank in ("median", "p99", "p999", "longest")]
assert times == sorted(times) and times[0] > 0, times
assert times[-1] / 1e3 <= note["wall_s"], (times, note["wall_s"])
PYTHON
expect 0 "$FRAM" check straight/scenario.yaml

# A folder that is not empty.
expect 2 "$FRAM" run scene.yaml -o straight
says "--force" err
expect 2 "$FRAM" run scene.yaml -o scene.yaml
# A forgotten name asks for no folder called --force.
expect 2 "$FRAM" run scene.yaml -o --force
says "--output: needs a value" err
[ ! -e ./--force ] || fail "a folder called --force"
# A new one in the root folder, for those who may.
if [ -w / ]; then
    root=/fram-$$-${RANDOM}
    trap 'rm -rf "$root"; leave' EXIT
    expect 0 "$FRAM" run scene.yaml -o "$root" -q --until 0.02
    [ -s "$root/run.json" ] || fail "no run in $root"
    rm -rf "$root"
    trap leave EXIT
fi
touch straight/failed.fram straight/station.json
expect 0 "$FRAM" run scene.yaml -o straight --force --json
same "$(value 'j["state_hash"]')" "$hash" "hash of the second run"
for file in failed.fram station.json; do
    [ ! -e "straight/$file" ] || fail "--force leaves $file of the run before"
done

# What never was a run's stays in a folder without one, and what the scenario names anywhere; it is not written over.
mkdir mine
for file in loads-2019.png station-A.png station.json report.html run.nc run.json; do echo mine >mine/$file; done
expect 0 "$FRAM" run scene.yaml -o mine --force -q --until 0.02
for file in loads-2019.png station-A.png station.json report.html run.nc; do
    same "$(cat mine/$file)" mine "a user's $file"
done
printf 'time[s],x[m/s],y[m/s]\n0,0,0\n' >mine/manage.csv
for _ in 1 2; do
    expect 0 "$FRAM" run scene.yaml -o mine --force -q --until 0.02 --set environment.current_file=mine/manage.csv
done
[ -s mine/manage.csv ] || fail "--force removes a file that the scenario names"
[ ! -e mine/loads-2019.png ] || fail "--force leaves loads-2019.png of the run before"
cp mine/manage.csv mine/loads.png
expect 2 "$FRAM" run scene.yaml -o mine --force --set environment.current_file=mine/loads.png --json
same "$(value 'j["error"]["file"]')" mine/loads.png "a file that the scenario names and the run writes"

cp straight/scenario.yaml kept.yaml
expect 2 "$FRAM" run straight/scenario.yaml -o straight --force --set run.seed=3
says "write over the scenario" err
cmp -s straight/scenario.yaml kept.yaml || fail "a run wrote over the scenario that it read"

# Stop half way, resume, resume again; threads and instruction sets change nothing.
expect 0 "$FRAM" run scene.yaml -o halves --until 1 --json
same "$(value 'j["steps"]')" 50 "steps until 1 s"
same "$(value 'j["finished"]')" False "finished at half time"
expect 0 "$FRAM" resume halves --until 1.5 --threads 2 --json
expect 0 "$FRAM" resume halves --json --isa baseline
same "$(value 'j["state_hash"]')" "$hash" "hash of the resumed run"
same "$(value 'j["finished"]')" True "finished"
cmp -s straight/record.fram halves/record.fram || fail "the records of a straight and a resumed run differ"
same "$(cut -d, -f1-70 straight/series.csv | md5sum)" "$(cut -d, -f1-70 halves/series.csv | md5sum)" "time series"

# Going back is refused; far behind the end is the end.
expect 2 "$FRAM" resume halves --until 1.5 --json
same "$(value 'j["error"]["key"]')" --until "key of a time before the checkpoint"
expect 0 "$FRAM" resume halves --until 1e200 --json
says "warning: until 1e+200 s: the run ends at run.duration, 2 s; a longer one is a run of its own" err
same "$(value 'j["state_hash"]')" "$hash" "hash of a run that was finished before"

# A scenario and its files are found from any folder, and a run that used them resumes from any.
mkdir -p "files/the \"hull\""
expect 0 "$FRAM" hull --length 48 --beam 12 --draught 4 -o "files/the \"hull\"/hull.stl"
cp hull.yaml "files/the \"hull\""
expect 0 "$FRAM" run "files/the \"hull\"/hull.yaml" -o files/straight --json
hull_hash=$(value 'j["state_hash"]')
(cd files && expect 0 "$FRAM" run "the \"hull\"/hull.yaml" -o halves --until 1)
mv files/halves moved
(cd / && "$FRAM" resume "$scratch/moved" --json) >out 2>err || fail "a run with files was not resumed: $(cat err)"
same "$(value 'j["state_hash"]')" "$hull_hash" "hash of a resumed run with files"
printf 'x' >>"files/the \"hull\"/hull.stl"
expect 2 "$FRAM" resume moved

# Resuming what cannot be resumed.
expect 2 "$FRAM" resume nowhere
mkdir empty
expect 2 "$FRAM" resume empty
cp -r halves changed
sed -i 's/thickness: 1/thickness: 2/' changed/scenario.yaml
expect 2 "$FRAM" resume changed
says "another scenario" err
cp -r halves damaged
for file in damaged/checkpoint-*.fram; do printf 'x' | dd of="$file" bs=1 seek=100 conv=notrunc status=none; done
expect 2 "$FRAM" resume damaged

# Ctrl-C leaves a checkpoint.
wait_for_start() {
    for _ in $(seq 100); do
        [ -s "$1/run.json" ] && break
        sleep 0.1
    done
}
"$FRAM" run scene.yaml -o "it's long" --set run.duration=10000 --set vessel.speed=0 --json >out 2>err &
pid=$!
wait_for_start "it's long"
sleep 0.5
kill -INT $pid
code=0
wait $pid || code=$?
same "$code" 130 "exit code after Ctrl-C"
says "continue with: fram resume 'it'\\''s long'" err
ls "it's long"/checkpoint-*.fram >/dev/null || fail "no checkpoint after Ctrl-C"
now=$(python3 -c 'import json; print(json.load(open("it\x27s long/run.json"))["time_s"] + 0.1)')
expect 0 "$FRAM" resume "it's long" --until "$now"

# So does a terminal that closes, unless nohup says otherwise; a closed pipe costs the progress lines only.  While a
# run writes, no other one does.
"$FRAM" run scene.yaml -o hung --set run.duration=10000 --set vessel.speed=0 -q 2>err &
pid=$!
wait_for_start hung
for words in "resume hung" "run scene.yaml -o hung --force"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words --json
    same "$(value 'j["error"]["file"]')" hung "folder of a run that goes on"
    says "another run is writing" err
done
# The shell's hangup and the kernel's, and a SIGTERM that comes with the first, are one wish: as the run goes on again,
# it has both at once.
kill -STOP $pid
kill -HUP $pid
kill -TERM $pid
kill -CONT $pid
kill -HUP $pid 2>/dev/null || true
code=0
wait $pid || code=$?
same "$code" 130 "exit code after a hangup"
now=$(python3 -c 'import json; print(json.load(open("hung/run.json"))["time_s"] + 0.1)')
expect 0 "$FRAM" resume hung --until "$now"
nohup "$FRAM" run scene.yaml -o kept --set run.duration=100 --set vessel.speed=0 -q >out 2>err &
pid=$!
wait_for_start kept
kill -HUP $pid || true
code=0
wait $pid || code=$?
same "$code" 0 "exit code of a run under nohup"
{ "$FRAM" run scene.yaml -o piped --json && echo good >how || echo ended >how; } 2>&1 >out | true
same "$(cat how) $(value 'j["state_hash"]')" "good $hash" "a run whose log is closed"

# What check warns of, a run warns of too.
expect 0 "$FRAM" run scene.yaml -o warned --set run.duration=60 --until 0.1
says "warning: vessel.speed: the hull reaches a wall of the domain" err

# A run that goes wrong says so, and leaves its state.
expect 1 "$FRAM" run scene.yaml -o broken --set run.speed_limit=0.05 --set vessel.mode=free --set vessel.speed=0 \
    --set vessel.mass=1e6 --json
same "$(value 'j["error"]["status"]')" simulation "status of a run that went wrong"
[ -s broken/failed.fram ] || fail "no state of the run that went wrong"
grep -q '"status": "failed"' broken/run.json || fail "run.json does not say that the run failed"

# The benchmark.
expect 0 "$FRAM" bench scene.yaml --warm 0.1 --time 0.2 --json
for key in ms_per_step_median us_per_floe_step contact_points state_hash; do
    value "j[\"$key\"]" >/dev/null || fail "bench prints no $key"
done
expect 2 "$FRAM" bench scene.yaml --time -1

finish "the command behaves"
