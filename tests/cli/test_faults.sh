#!/usr/bin/env bash
# What a shell, a disk or another program does to the command: nothing is mixed, lost without a word, or left behind.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
run: {duration: 4, time_step: 0.02}
vessel:
  mode: towed
  x: -30
  speed: 2
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
ice: {mean_floe_area: 64}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
output: {checkpoint_interval: 1}
YAML
status_of() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["status"])' "$1/run.json"; }

# Standard streams that are closed at the start: no result has a line of progress in it, and lost answers are told.
expect 0 "$FRAM" run scene.yaml -o open
for streams in '<&-' '>&-' '2>&-' '<&- >&-' '<&- 2>&-' '<&- >&- 2>&-'; do
    rm -rf closed
    code=0
    eval "\"\$FRAM\" run scene.yaml -o closed $streams" || code=$?
    same "$code" 0 "exit code of a run with $streams"
    for file in record.fram fractures.csv scenario.yaml; do
        cmp -s open/$file closed/$file || fail "$file is another one with $streams"
    done
    same "$(wc -l <closed/series.csv)" "$(wc -l <open/series.csv)" "rows with $streams"
done
code=0
"$FRAM" check scene.yaml --json >&- 2>err || code=$?
same "$code" 1 "exit code of an answer to a stream that is closed"
says "standard output: cannot be written" err
# A pipe that its owner has set not to wait is full at first, and takes the whole answer then; it stays as it was set.
expect 0 "$FRAM" keys
python3 -S - <<'PY' || fail "an answer to a full pipe that does not wait"
import os, subprocess
to_read, to = os.pipe()
os.set_blocking(to, False)
before = 0
try:
    while True:
        before += os.write(to, bytes(4096))
except BlockingIOError:
    pass
fram = subprocess.Popen([os.environ["FRAM"], "keys"], stdout=to)
try:
    raise SystemExit(f"ended with {fram.wait(0.1)} before anything was read")
except subprocess.TimeoutExpired:
    pass
assert not os.get_blocking(to)
os.close(to)
assert open(to_read, "rb").read()[before:] == open("out", "rb").read() and fram.wait() == 0
PY
# So does a terminal's end, and its master, which opened once more would be that of a new terminal.
python3 -S - <<'PY' || fail "an answer to a terminal that does not wait"
import os, pty, subprocess, tty
for waits in (0, 1):
    for master in (0, 1):
        ends = pty.openpty()
        tty.setraw(ends[1])
        os.set_blocking(ends[1 - master], bool(waits))
        subprocess.run([os.environ["FRAM"], "--version"], stdout=ends[1 - master], check=True)
        os.set_blocking(ends[master], False)
        assert os.read(ends[master], 5) == b"fram ", (waits, master)
PY

# A folder that is taken away in the middle is a failed run, and so is one whose end cannot be written.
sed 's/duration: 4/duration: 4000/' scene.yaml >long.yaml
"$FRAM" run long.yaml -o gone -q >out 2>err &
run=$!
for _ in $(seq 300); do
    if ls gone/checkpoint-* >/dev/null 2>&1; then break; fi
    sleep 0.1
done
# The run writes into it meanwhile.
until rm -rf gone 2>/dev/null; do sleep 0.01; done
code=0
wait $run || code=$?
same "$code" 1 "exit code of a run whose folder was taken away"
grep -q "gone" err || fail "the run does not name the folder that was taken away: $(cat err)"
# One without checkpoints on the way notices at its end.
"$FRAM" run scene.yaml -o moved -q --set output.checkpoint_interval=0 --set run.duration=20 >out 2>err &
run=$!
for _ in $(seq 300); do
    if [ -s moved/run.json ]; then break; fi
    sleep 0.02
done
mv moved elsewhere
mkdir moved
code=0
wait $run || code=$?
same "$code" 1 "exit code of a run whose folder was replaced"
says "was removed or replaced" err
same "$(status_of moved)" failed "status of a run whose folder was replaced"
holds '"message": "moved/series.csv: the file was removed' moved/run.json

# run.json does not stay at "running" when the end fails.
if "$FRAM" --version | grep -q cairo; then
    expect 0 "$FRAM" run scene.yaml -o blocked -q --until 1
    rm -f blocked/loads.png
    mkdir blocked/loads.png
    expect 1 "$FRAM" resume blocked -q
    same "$(status_of blocked)" failed "status of a run whose picture cannot be written"
fi

# A run over another one that cannot begin leaves nothing of that one which would be taken for its own.
expect 0 "$FRAM" run scene.yaml -o over -q --set run.duration=0.1
rm over/record.fram
mkdir over/record.fram
expect 2 "$FRAM" run scene.yaml -o over -q --force --set run.duration=0.2 --set title=second
says "over/record.fram: cannot open for writing" err
[ ! -e over/run.json ] || fail "a run that did not begin has the end of the one before: $(status_of over)"
expect 2 "$FRAM" report over -q
says "run.json: cannot read" err

# A simulation that goes wrong is a failed run, and what it says is about what happened.
expect 1 "$FRAM" run scene.yaml -o fast --set run.speed_limit=0.05 --set vessel.mode=free --set vessel.speed=0 \
    --set vessel.mass=1e6 --json
same "$(value 'j["error"]["status"]')" simulation "status of a run that went wrong"
says "run.speed_limit is 0.05 m/s; nothing touches it" err
grep -q "rad/s" err && fail "a vessel that rises is told to turn"
same "$(status_of fast)" failed "status of a run that went wrong"
# A carriage leaves heave to the water: a towed vessel that rises does not move as the scenario says.
expect 1 "$FRAM" run scene.yaml -o rises -q --set run.speed_limit=0.05 --set vessel.mode=towed --set vessel.speed=0 \
    --set vessel.mass=1e6
says "run.speed_limit is 0.05 m/s; nothing touches it" err

# Two programs that write one output: each ends well, and the file is whole.
for _ in 1 2 3 4; do
    "$FRAM" report open -o same.html -q 2>>errors &
    "$FRAM" export open --geojson --time 1 -o same.geojson -q 2>>errors &
done
for job in $(jobs -p); do wait "$job" || fail "a command beside others failed: $(cat errors)"; done
tail -c 16 same.html | grep -q '</html>' || fail "same.html is not whole"
python3 -c 'import json; json.load(open("same.geojson"))' || fail "same.geojson is not whole"

# What a run that was killed left behind goes with the next one, and the state as it went wrong with one that goes on;
# what others are writing stays.
touch open/failed.fram open/run.json.0123456789abcdef.new open/checkpoint-000000000050.fram.0123456789abcdef.new
touch open/peaks.fram.0123456789abcdef.new open/peaks.fram.new
touch open/report.html.0123456789abcdef.new open/mine.new
expect 0 "$FRAM" resume open -q
if [ ! -e open/report.html.0123456789abcdef.new ] || [ ! -e open/mine.new ]; then
    fail "a run took files that are not its own"
fi
[ ! -e open/failed.fram ] || fail "a run that finished keeps the state as it went wrong before"
rm open/report.html.0123456789abcdef.new open/mine.new
[ -z "$(find . -name '*.new')" ] || fail "temporary files are left: $(find . -name '*.new')"

# A wish to stop is heard by whoever writes a file: no half of one stays.
mkfifo pipe.stl pipe.svg
printf 'top[m]\n%s\n' "$(awk 'BEGIN {for (i = 1; i < 200; i++) print (i * i * i) % 401}' | tr ' ' '\n')" >tops.csv
hull=(hull --box --length 40 --beam 10 --draught 4)
hears_in_time() {
    local mask
    for _ in $(seq 400); do
        mask=$(awk '/^SigCgt/ {print $2}' "/proc/$1/status" 2>/dev/null)
        if [ -n "$mask" ] && ((16#$mask >> 14 & 1)); then return 0; fi
        sleep 0.01
    done
    return 1
}
stops() {
    "$FRAM" "$@" -q >out 2>err &
    hears_in_time $! || fail "SIGTERM is not heard by $*: $(cat err)"
    code=0
    kill -TERM $! && wait $! || code=$?
    same "$code" 130 "exit code of $* after SIGTERM"
    [ -z "$(find . -name '*.new')" ] || fail "$* leaves $(find . -name '*.new')"
}
stops "${hull[@]}" -o pipe.stl
if built_with cairo; then
    stops "${hull[@]}" --draw pipe.svg
    stops extremes tops.csv --channel top --maxima --block 1min --method gumbel --draw pipe.svg
fi

# What finds no room is told by the name that was given, not by that of the file which would have taken its place.
limited() { bash -c 'ulimit -f 4 && exec "$@"' - "$@"; }
expect 1 limited "$FRAM" report open -o small.html -q
says "fram: small.html: cannot write: File too large" err
expect 1 limited "$FRAM" report open -o ./small.html --json
same "$(value 'j["error"]["file"]')" ./small.html "the file that found no room"
echo "<html><!--BESIDE--><!--RECORD-->" >viewer.html
expect 1 limited "$FRAM" view open --page viewer.html -o page.html --page-limit 0.01 -q
says "fram: page-frames/0000.js: cannot write: File too large" err
[ -z "$(find . -name '*.new')" ] || fail "temporary files are left: $(find . -name '*.new')"

# Names that look like options or addresses reach ffmpeg as files.
mkdir bin
cat >bin/ffmpeg <<'END'
#!/bin/bash
cat >/dev/null
printf '%s\n' "$@" >"$ARGUMENTS"
last=${!#}
echo video >"${last#file:}"
END
chmod +x bin/ffmpeg
case $("$FRAM" --version) in
*cairo*)
    for name in -y.mp4 pipe:1.mp4 http:x.mp4 'a b.mp4'; do
        ARGUMENTS=$scratch/arguments PATH="$scratch/bin:$PATH" "$FRAM" video open --fps 1 --speed 2 --width 640 \
            --height 480 "--output=$name" -q 2>err || fail "video to $name: $(cat err)"
        [ -s "./$name" ] || fail "$name is missing"
        tail -n 1 arguments | grep -q '^file:\./' || fail "ffmpeg is given $(tail -n 1 arguments)"
    done
    # What it says of its file is told with the name that was asked for, and so is where it goes away in between.
    for end in 'cat >/dev/null' 'head -c 1000 >/dev/null'; do
        cat >bin/ffmpeg <<END
#!/bin/bash
$end
printf '%s\n' "Error writing trailer of \${!#}: no room" "\${!#}: \$0 gives up" >&2
exit 1
END
        expect 1 env PATH="$scratch/bin:$PATH" "$FRAM" video open --fps 1 --speed 2 -o lost.mp4 -q
        says "ffmpeg" err
        says ": Error writing trailer of lost.mp4: no room; lost.mp4: $scratch/bin/ffmpeg gives up" err
        grep -q '\.new\|file:' err && fail "a file that the user does not know is named: $(cat err)"
        same "$(grep -c . err)" 1 "lines about a video that was not made"
        [ -z "$(ls lost.mp4* 2>/dev/null)" ] || fail "a video that failed left $(ls lost.mp4*)"
    done
    ;;
esac

# Names are looked at before the work: of the page's folder of frames too, and the folder that a file goes into.
long=$(printf '%250s' '' | tr ' ' n)
expect 2 "$FRAM" view open --page viewer.html -o "$long.html"
says "--output: expected a shorter name: a file named after it would have one of 257 bytes" err
same "$(grep -c . err)" 1 "lines about a page with too long a name"
echo nothing >plain.txt
for words in "view absent --page viewer.html -o none/x.html" "report absent -o none/x.html" \
    "compare absent open -o none/x.html" "manage absent -o none/x.html" "export absent --netcdf -o none/x.nc" \
    "export absent --geojson --time 1 -o none/x.geojson" "export absent --vtk -o none/x" "video absent -o none/x.mp4" \
    "video absent --pictures -o none/x" "plot absent time -o none/x.png" "why absent --time 1 -o none/x.svg" \
    "field absent.yaml --table none/x.csv" "report absent -o plain.txt/x.html"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words
    says "/x" err
    [[ $words = *plain.txt* ]] || says "the folder none is not there; make it, or give another name" err
    same "$(grep -c . err)" 1 "lines about $words"
done

# So are links that lead nowhere; of one to a file that is not there yet the file is made, as the shell makes it.
mkdir -p behind
for name in x x.html x.nc x.geojson x.mp4 x.png x.svg x.csv; do
    ln -s "behind/none/$name" "$name"
done
for words in "view absent --page viewer.html -o x.html" "report absent -o x.html" "compare absent open -o x.html" \
    "manage absent -o x.html" "export absent --netcdf -o x.nc" "export absent --geojson --time 1 -o x.geojson" \
    "export absent --vtk -o x" "export absent --vtk -o x/" "video absent -o x.mp4" "video absent --pictures -o x" \
    "plot absent time -o x.png" "why absent --time 1 -o x.svg" "field absent.yaml --table x.csv" \
    "run scene.yaml -o x" "run scene.yaml -o x/deep" "run scene.yaml --force -o x/"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words -q
    says "the link x" err
    says " leads nowhere; remove it, or give another name" err
    same "$(grep -c . err)" 1 "lines about $words"
done
ln -s behind/new.html new.html
expect 0 "$FRAM" report open -o new.html -q
{ [ -L new.html ] && grep -q "<html" behind/new.html; } || fail "a link to a file that is not there is not gone through"
if built_with netcdf; then
    ln -s behind/new.nc new.nc
    expect 2 "$FRAM" export open --netcdf -o new.nc -q
    says "new.nc: expected a regular file, found a device or a link" err
    [ ! -e behind/new.nc ] || fail "a link in the place of a NetCDF file was gone through"
fi

finish "what the world does to the command is told"
