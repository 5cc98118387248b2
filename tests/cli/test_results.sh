#!/usr/bin/env bash
# export, report, plot, compare and video as a user meets them; what other programs read is looked at in tests/views.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
title: A <short> run & its results
run: {duration: 3, time_step: 0.02}
vessel:
  mode: towed
  x: -26
  speed: 3
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
ice:
  source: floes
  thickness: 0.5
  breakable: true
  floes:
    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}
    - {length: 40, width: 20, x: 20.5, y: -11}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}
output: {frame_interval: 0.5}
YAML
"$FRAM" run scene.yaml -o run -q
"$FRAM" run scene.yaml -o thin -q --set ice.thickness=0.4
pictures=no
! built_with cairo || pictures=yes

# Help, and words that do not fit.
for command in export report plot compare video; do
    expect 0 "$FRAM" $command --help
    grep -q "Examples:" out || fail "$command --help shows no example"
    expect 2 "$FRAM" $command
    expect 2 "$FRAM" $command nowhere thin -o "$scratch/x.html" --vtk
done
expect 2 "$FRAM" export run
says "name one format" err
expect 2 "$FRAM" export run --geojson
says "--time T" err
cp run/run.json kept.json
for words in "report run" "plot run roll" "compare thin run" "video run" "export run --netcdf"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words -o ./run/run.json
    says "--output" err
done
cmp -s run/run.json kept.json || fail "a part of the run was written over"
# One rule for all commands: what is read is never written over, --force or not; what is there and of another kind only
# with --force.
echo "<html>" >page.html
"$FRAM" hull --length 40 --beam 10 --draught 4 --box -o b.stl >/dev/null
cp b.stl kept.stl
for words in "view run --page page.html -o page.html" "hull b.stl -o ./b.stl" "hull b.stl --draw b.stl --force" \
    "hull b.stl --draw two.png -o two.png" "hull b.stl --draw two.png -o ./two.png" \
    "run scene.yaml -o thin --force --set environment.current_file=thin/series.csv" \
    "fmu scene.yaml -o b.stl --force --binary page.html --set environment.current_file=b.stl" \
    "bench --scene b.stl --dump b.stl"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words
    says "of its own" err
done
cmp -s b.stl kept.stl || fail "a hull was written over by itself"
[ -e thin/run.json ] || fail "a refused run took away another one's"
for words in "export run --netcdf -o" "export run --geojson --time 1 -o"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words b.stl
    says "--force" err
done
# What an earlier run left is not taken for the new one's.
expect 0 "$FRAM" run scene.yaml -o old --quiet --set run.duration=0.4 --set output.picture_interval=0.1
expect 0 "$FRAM" report old -q
drawn=$(find old -name "plan-*.png" | wc -l)
expect 0 "$FRAM" export old --vtk -q
expect 0 "$FRAM" export old --geojson --time 0 -q
mkdir old/video old/playback-frames
(cd old && touch manage.csv manage-sizes.csv video/frame-000000.png playback-frames/0000.js vtk/mine field-mine.geojson)
expect 0 "$FRAM" run scene.yaml -o old --force --quiet --set run.duration=0.2 --set output.picture_interval=0.1
[ ! -e old/report.html ] || fail "the report of an earlier run stays beside a new one"
same "$(cd old && find vtk video playback-frames ./*.geojson manage* 2>/dev/null | sort | xargs)" \
    "./field-mine.geojson vtk vtk/mine" "what stays of an earlier run and by it"
# But for the ice that the new run begins from.
expect 0 "$FRAM" export old --geojson --time 0 -q
printf 'run: {duration: 0.1, time_step: 0.02}\nvessel: {present: false}\n%s\n' \
    'ice: {source: file, file: old/field-0.geojson}' >next.yaml
expect 0 "$FRAM" run next.yaml -o old --force --quiet
[ -e old/field-0.geojson ] || fail "the ice that a run was made of was removed"
[ "$drawn" = 0 ] || [ "$(find old -name "plan-*.png" | wc -l)" -lt "$drawn" ] || fail "pictures of an earlier run stay"
# What a run does not have is a dash in a comparison.
expect 0 "$FRAM" run scene.yaml -o brief --quiet --set output.csv_interval=1 --until 0.5
expect 0 "$FRAM" compare run brief
grep -q nan out && fail "a comparison tells nan: $(grep nan out)"
grep -E "e-(1[3-9]|[2-9][0-9])" out && fail "a comparison tells rounding"
# Times are seconds, and say so.
printf 'time[ms],T[kN]\n0,1\n20,2\n40,3\n60,1\n80,4\n' >history.csv
expect 2 "$FRAM" extremes history.csv --channel T
says "expected the unit [s], found [ms]" err
printf '\357\273\277T,time\n1,0\n2,1\n3,2\n1,3\n' >marked.csv
"$FRAM" extremes marked.csv --channel T >out 2>err
grep -q "no column" err && fail "a byte order mark hides a column: $(cat err)"
# What a run found out is there without the files that it was made of.
printf 'time,x,y\n0,0.1,0\n' >flow.csv
expect 0 "$FRAM" run scene.yaml -o gone --quiet --until 1.5 --set environment.current_file=flow.csv
rm flow.csv
for words in "report gone" "compare run gone" "fatigue gone" "plot gone" "why gone --peak 1 --no-rerun"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" $words
done
expect 2 "$FRAM" resume gone
says "environment.current_file: expected a file that can be read" err
# What a spreadsheet writes is read for what it is, or refused.
printf 'time,T\r0,1\r20,"2"\r40,"3" \r60,1\r80,4' >mac.csv
expect 0 "$FRAM" fatigue mac.csv --channel T
says "5 values" out
printf 'T\n1\r2\r\n3\r\r\n1\n4\n' >mixed.csv
expect 0 "$FRAM" fatigue mixed.csv --channel T --step 20
says "5 values" out
printf 'T\n3\r\r\n1\nx\n4\n' >mixed.csv
expect 2 "$FRAM" fatigue mixed.csv --channel T --step 20
says "mixed.csv:4: " err
printf 'time;T\n0;1\n20;2\n' >history.csv
expect 2 "$FRAM" fatigue history.csv --channel T
says "columns are divided by commas" err
for cell in '"3' '"3"1' '"3"1"'; do
    printf 'time,T\n0,1\n20,%s\n40,1\n' "$cell" >history.csv
    expect 2 "$FRAM" fatigue history.csv --channel T
    says "history.csv:3: column 2: " err
    says "quotation mark" err
done
printf 'time,T\n0,1\n20,%0200d1\n40,1\n' 0 >history.csv
expect 0 "$FRAM" fatigue history.csv --channel T
says "3 values" out
# What the help tells as defaults, given by hand, changes nothing.
unchanged() {
    local number=$1 pattern=$2 told
    shift 2
    expect 0 "$FRAM" "$1" --help
    told=$(told_defaults "$pattern" '\(')
    same "$(wc -l <<<"$told")" "$number" "defaults that the help of $1 tells: $told"
    expect 0 "$FRAM" "$@" --json
    mv out bare.out
    # shellcheck disable=SC2086
    expect 0 "$FRAM" "$@" $told --json --force
    cmp bare.out out || fail "$1 with the defaults of the help: $told"
}
unchanged 3 "duration|probabilities|confidence" extremes mac.csv --channel T
unchanged 2 "slopes|frequency" fatigue mac.csv --channel T
if [ $pictures = yes ]; then
    expect 0 "$FRAM" video run --pictures --speed 30 -o bare.video -q
    unchanged 3 "frames|width|height" video run --pictures --speed 30 -o told.video
    diff -r bare.video told.video || fail "a video with the defaults of the help is another one"
    rm -r bare.video told.video
fi
# A picture's kind is that of its name.
for words in "plot run roll" "hull kept.stl" "why run --peak 1"; do
    option=-o
    [ "$words" = "hull kept.stl" ] && option=--draw
    for file in b.stl new.pdf none; do
        # shellcheck disable=SC2086
        expect 2 "$FRAM" $words $option $file --force
        says "ends in .png or .svg" err
    done
    # shellcheck disable=SC2086
    ! built_with cairo || expect 0 "$FRAM" $words $option new.SVG
done
[ ! -e new.pdf ] || fail "a picture of no kind was made"
cmp -s b.stl kept.stl || fail "a file of another kind was written over"
# A page's too; a device has no kind.
for words in "report run" "compare run thin" "view run --page page.html"; do
    for file in b.stl new.txt none; do
        # shellcheck disable=SC2086
        expect 2 "$FRAM" $words -o $file --force
        says "--output: expected a page's name that ends in .html or .htm" err
    done
done
[ ! -e new.txt ] || fail "a page of no kind was made"
cmp -s b.stl kept.stl || fail "a page was written over a file of another kind"
# Of other files a name with another ending is taken when it is asked for, or when nothing is in the file.
: >empty
expect 0 "$FRAM" export run --geojson --time 1 -o b.stl --force -q
expect 0 "$FRAM" export run --geojson --time 1 -o empty -q
holds "Feature" b.stl
for _ in 1 2; do
    expect 0 "$FRAM" report run -o again.HTML -q
    expect 0 "$FRAM" report run -o /dev/null -q
done
# The command's own streams are gone on with, wherever the shell leads them: into a file too.
expect 2 "$FRAM" fatigue run -o cycles.txt
says "--output: expected a table's name that ends in .csv" err
expect 0 "$FRAM" fatigue run -o cycles.csv
cat cycles.csv out >wanted
"$FRAM" fatigue run -o /dev/stdout >found
cmp wanted found || fail "an output and the answer behind it write over each other"
expect 0 "$FRAM" export run --geojson --time 1 -o one.geojson -q
{ echo mine && cat one.geojson one.geojson; } >wanted
echo mine >found
for name in /dev/stdout /dev/fd/1; do
    "$FRAM" export run --geojson --time 1 -o $name -q >>found || fail "nothing more goes to $name"
done
cmp wanted found || fail "what stood in a file is lost to /dev/stdout"
"$FRAM" report run -o /dev/stdout -q >streamed || fail "a page for /dev/stdout has no kind"
holds "<html" streamed
# Values far from zero, as a northing, have the digits that tell them apart, in the text and in a file of cycles.
python3 -c 'import random; random.seed(4)
print("time[s],y[m]\n" + "\n".join(f"{i},{6534201 + 0.002 * random.gauss(0, 1):.12g}" for i in range(2000)))' >north.csv
expect 0 "$FRAM" extremes north.csv --channel y
cp out north.txt
expect 0 "$FRAM" fatigue north.csv --channel y -o north_cycles.csv
python3 - <<'PY' || fail "digits of values far from zero: $(cat north.txt out)"
import re
told, counted = open("north.txt").read(), open("out").read()
levels = re.findall(r"^  \S.* ([\d.]+)  \(([\d.]+) to ([\d.]+)\) m$", told, re.M)
assert len(levels) == 24 and all(float(low) < float(level) < float(high) for level, low, high in levels), levels
for text in told, counted:
    mean, least, most = (float(re.search(name + r" ([\d.]+)", text)[1]) for name in ("mean", "minimum", "maximum"))
    assert least < mean < most, text
places = re.findall(r"(?:location|\(x -|peaks over) ([\d.]+)", told)
assert len(places) == 8 and all(6534200.99 < float(x) < 6534201.02 for x in places), places
means = [line.split(",")[1] for line in open("north_cycles.csv").read().split()[1:]]
assert len(set(means)) > 50, len(set(means))
PY
# A way through /proc to a file is one to a file.
echo mine >notes.txt
expect 2 "$FRAM" report run -o /proc/self/cwd/notes.txt -q
expect 2 "$FRAM" export run --geojson --time 1 -o /proc/self/cwd/notes.txt -q
same "$(cat notes.txt)" mine "a file behind /proc"
# A stream that is not open is refused as that, not for the ending of its name.
expect 2 "$FRAM" report run -o /dev/fd/9 -q
says "/dev/fd/9: cannot open for writing" err
# Nothing stands beside a page that goes into a stream.
ln -s /dev/stdout out.html
"$FRAM" manage run -o out.html >streamed 2>err || fail "ice management does not go to a stream: $(cat err)"
holds "<html" streamed
says "out.html: a page that goes into a stream has no tables beside it" err
mkfifo pipe.html
echo "<html><!--BESIDE--><!--RECORD-->" >viewer.html
expect 2 timeout 5 "$FRAM" view run --page viewer.html -o pipe.html --page-limit 0.0001
says "the frames are too many for one page" err
"$FRAM" view run --page viewer.html -o out.html -q >streamed || fail "a page for playback does not go to a stream"
holds "^<html>." streamed
same "$(compgen -G 'out?*'; compgen -G 'pipe*')" "$(printf 'out.html\npipe.html')" "files beside a stream"
# A pipe that nobody reads is waited for until the first wish to stop.
expect 130 timeout --preserve-status -s INT -k 5 0.3 "$FRAM" report run -q -o pipe.html
expect 2 "$FRAM" view run --page-limit -3
says "--page-limit" err
expect 2 "$FRAM" view run --total-limit 1e300
says "--total-limit" err
expect 2 "$FRAM" export run --vtk --time 3
# In definitions zero means the default; who writes it means zero, and hears of it.
refuse_zero() {
    local option=$1
    shift
    expect 2 "$FRAM" "$@" "$option" 0
    says "$option: needs" err
    says "above zero" err
    expect 2 "$FRAM" "$@" "$option" -3
    says "$option: needs a" err
    says "above zero" err
}
refuse_zero --limit manage run
refuse_zero --depth manage run
refuse_zero --order extremes run
refuse_zero --speed video run
refuse_zero --span video run --camera plan
refuse_zero --to pressure run
refuse_zero --window capability scene.yaml -o none
refuse_zero --unbroken-as capability scene.yaml -o none
refuse_zero --cell field --cover run
refuse_zero --separation extremes run
refuse_zero --block extremes run
# Numbers of options are those of scenarios: decimal, finite, and nothing before or behind them.
for text in 0x1 0x1p3 inf -infinity nan "1 " " 1" 1s 1e999; do
    for words in "run scene.yaml -o none --until" "field run --cell" "capability scene.yaml -o none --window"; do
        # shellcheck disable=SC2086
        expect 2 "$FRAM" $words "$text"
        says "${words##* }: expected a decimal number, as 0.5 or 1e3, found " err
        says "\"$text\"" err
    done
    [[ $text != *" "* ]] || continue
    expect 2 "$FRAM" field run --window "0,0,$text,5"
    says "--window: expected X0,Y0,X1,Y1" err
    expect 2 "$FRAM" extremes run --level "0.5,$text"
    says "--level: expected numbers, separated by commas" err
    expect 2 "$FRAM" pressure run -o none --frames "$text:2:20"
    says "--frames: expected coordinates like" err
done
expect 2 "$FRAM" run scene.yaml -o none --until 1e999
says "--until: expected a decimal number, as 0.5 or 1e3, found one that is too large, \"1e999\"" err
# Blanks about the commas and colons of a list are none of its numbers.
printf '{"type": "Polygon", "coordinates": [[[1, 1], [4, 1], [4, 4], [1, 4], [1, 1]]]}' >square.geojson
expect 0 "$FRAM" field square.geojson --window "0, 0 ,	10, 10 " --json
says '"concentration":0.09' out
for text in "0, 0, 1 0, 10" "0, 0, 10," "0, 0,, 10" "0, 0, 10, 1 0"; do
    expect 2 "$FRAM" field square.geojson --window "$text"
done
for text in 0x1 "1 " " 1" 1.0 1e3 ""; do
    expect 2 "$FRAM" export run --vtk --every "$text"
    says "--every: needs a" err
done
[ ! -e none ] || fail "a refused number leaves a folder"
# What is left of a run is an estimate: of whole seconds.
expect 0 "$FRAM" run scene.yaml -o estimated --set run.time_step=0.004
says "  left " err
grep -E 'left [0-9.]*[.e]' err && fail "hundredths of an estimate"
# What a command would not look at is refused, not passed over.
expect 2 "$FRAM" bench scene.yaml --iterations 5
says "--iterations: is for scenes" err
expect 2 "$FRAM" bench scene.yaml --dt 0.01
says "--dt: is for scenes" err
expect 2 "$FRAM" bench scene.yaml --solver fast
says "--solver: is for scenes" err
expect 2 "$FRAM" extremes maxima.csv --channel x --maxima --block 1h --from 3
says "--from: is for a series" err
expect 2 "$FRAM" extremes maxima.csv --channel x --maxima --block 1h --step 3
says "--step: is for a series" err
expect 2 "$FRAM" bench --scene none --solvers --solver fast
says "--solver: is of one solver" err
expect 2 "$FRAM" export run --vtk --every 0
expect 2 "$FRAM" export run --vtk --every -2147483648
says "--every: needs a whole number above zero" err
for words in --netcdf "--geojson --time 1"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" export run $words --every 2
    says "--every: goes with --vtk only" err
done
expect 2 "$FRAM" export scene.yaml --vtk

# What needs the record that a study did not keep tells how to have it.
mkdir series
cp thin/{scenario.yaml,run.json,series.csv,fractures.csv} series
for words in "video series --pictures" "view series --page page.html" "manage series" "export series --vtk" \
    "export series --geojson --time 1" "why series --time 1 -o new.svg"; do
    [[ $pictures = yes || $words != video* ]] || continue
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words
    says "series: the run has no record, as a study keeps with \`series\`: make it again with" err
    says "\`fram run series/scenario.yaml -o DIR\`" err
done
expect 2 "$FRAM" why series --peak 1
says "a study kept its series alone" err
expect 2 "$FRAM" export nowhere --vtk
says "record.fram: cannot read" err

# Export.
expect 0 "$FRAM" export run --vtk --json
holds '"frames":7' out
holds 'data/hull_000006.vtp' run/vtk/run.pvd
# A folder with something in it is left alone; by force, a shorter export leaves nothing of a longer.
mkdir theirs
touch theirs/mine
expect 2 "$FRAM" export run --vtk -o theirs
says "--output: names a folder that is not empty" err
same "$(ls theirs)" mine "a folder with something in it"
expect 0 "$FRAM" export run --vtk -o theirs --force -q
for words in "-o theirs --force" ""; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" export run --vtk --every 3 -q $words
done
for folder in theirs run/vtk; do same "$(find $folder/data -type f | wc -l)" 9 "files of three frames in $folder"; done
[ -e theirs/mine ] || fail "an export took a file that is not its own"
expect 0 "$FRAM" export run --geojson --time 1.25 -o half.geojson
says "metres in the scenario's plane, so give a GIS a plane system (ogr2ogr -a_srs), not degrees" err
python3 - <<'PY' || fail "half.geojson is not the field at 1.25 s"
import json
field = json.load(open("half.geojson"))
assert abs(field["time"] - 1.25) < 1e-9 and len(field["features"]) > 3
PY
if "$FRAM" --version | grep -q netcdf; then
    expect 0 "$FRAM" export run --netcdf -q
    [ "$(head -c 4 run/run.nc | tail -c 3)" = HDF ] || fail "run.nc is no HDF5 file"
    # In a name a backslash is a letter.
    expect 0 "$FRAM" export run --netcdf -q -o 'run/a\b.nc'
    [ -s 'run/a\b.nc' ] || fail "no file is named with a backslash"
    # A run without frames has its columns; so has one without a record, of which a study kept the series.
    # Many columns, as of a list of vessels, take each their room and no more.
    expect 0 "$FRAM" run scene.yaml -o bare --quiet --until 0.1 --set output.frame_interval=0
    awk '{ for (i = 1; i <= 600; i++) $0 = $0 (NR == 1 ? ",more_" i "[N]" : "," i); print }' \
        bare/series.csv >wide.csv
    mv wide.csv bare/series.csv
    expect 0 "$FRAM" export bare --netcdf --json
    same "$(value 'j["frames"], j["time_s"]')" "0 0" "frames of a run without"
    [ "$(wc -c <bare/run.nc)" -lt 2500000 ] || fail "600 columns made run.nc of $(wc -c <bare/run.nc) bytes"
    grep -q fracture_pieces bare/run.nc || fail "run.nc of a run without frames has no columns of its fractures"
    grep -q floe_thickness bare/run.nc && fail "run.nc of a run without frames has floes"
    rm bare/run.nc bare/record.fram
    sed -i 3d bare/series.csv
    expect 0 "$FRAM" export bare --netcdf --json
    says "bare/series.csv:3: time: there are no rows from" err
    says "bare: the run has no record, as a study keeps with \`series\`: no floes are written" err
    same "$(value 'j["frames"]')" 0 "frames of a run without a record"
    rm bare/run.nc bare/run.json
    expect 0 "$FRAM" export bare --netcdf --json
    grep -q fracture_pieces bare/run.nc || fail "run.nc of a run without a record has no columns of its fractures"
    # SIGTERM, as Ctrl-C, as soon as the file has begun leaves nothing half-written; where it is whole by then, that.
    "$FRAM" export run --netcdf -o stopped.nc 2>err >out &
    until compgen -G 'stopped.nc*' >found || ! kill -0 $!; do :; done 2>kills
    kill -TERM $! 2>kills
    code=0
    wait $! || code=$?
    case $code in
    0) [ "$(compgen -G 'stopped.nc*')" = stopped.nc ] || fail "an export left $(compgen -G 'stopped.nc*')" ;;
    130) [ -z "$(compgen -G 'stopped.nc*')" ] || fail "an interrupted export left $(compgen -G 'stopped.nc*')" ;;
    *) fail "an interrupted export has exit code $code: $(cat err)" ;;
    esac
    expect 2 "$FRAM" export no_run --netcdf
    says "no_run/series.csv: cannot read" err
    expect 2 "$FRAM" export run --netcdf -o no/such/run.nc
    says "cannot open for writing" err
    expect 1 bash -c 'ulimit -f 20 && exec "$@"' - "$FRAM" export run --netcdf -o full.nc --json
    same "$(value 'j["error"]["status"], j["error"]["file"], "full disk" in j["error"]["message"]')" \
        "io full.nc True" "an export that finds no room"
    # No room at all, so that the words go into a pipe.
    code=0
    told=$(bash -c 'ulimit -f 0 && exec "$@"' - "$FRAM" export run --netcdf -o full.nc 2>&1) || code=$?
    same "$code $told" "1 fram: full.nc: cannot write the beginning of the file: File too large" \
        "an export without room"
    [ -z "$(ls full.nc* 2>/dev/null)" ] || fail "an export that found no room left $(ls full.nc*)"
    # The library is opened for a .nc file alone, and may be gone by then; one that has a place of its own is not looked
    # for by its name.
    library=$(sed -n 's/^FRAM_NETCDF_LIBRARY:.*=//p' "$FRAM_BUILD/CMakeCache.txt")
    if [[ $library != */* ]]; then
        mkdir broken
        echo "no library" >"broken/$library"
        LD_LIBRARY_PATH=broken expect 1 "$FRAM" export run --netcdf -o gone.nc --json
        same "$(value 'j["error"]["status"], j["error"]["file"]')" "unsupported gone.nc" "an export without its library"
        says "NetCDF library" err
        [ ! -e gone.nc ] || fail "an export without its library left a file"
        LD_LIBRARY_PATH=broken expect 0 "$FRAM" export run --geojson --time 1 -q -o early.geojson
    fi
else
    expect 1 "$FRAM" export run --netcdf -q
fi

# A report says all that it should, holds all that it shows, and fetches nothing.
expect 0 "$FRAM" report run
for part in "A &lt;short&gt; run &amp; its results" ">Scenario</h2>" ">Ice load</h2>" ">Ice field</h2>" \
    ">Fracture</h2>" ">Mass and energy</h2>" \
    ">Quality of the solution</h2>" ">Origin</h2>" "not accounted for" "SHA-256"; do
    holds "$part" run/report.html
done
grep -oE '(src|href)="[^"]{0,20}' run/report.html | grep -v '"data:image' && fail "the report fetches something"
! grep -q '<script' run/report.html || fail "the report has a script"
[ $pictures = no ] || holds 'data:image/svg+xml;base64' run/report.html
[ $pictures = no ] || holds 'crosses: where floes broke' run/report.html
python3 - <<'PY' || fail "the report's HTML does not nest"
from html.parser import HTMLParser
class Nest(HTMLParser):
    stack = []
    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "img"): self.stack.append(tag)
    def handle_endtag(self, tag):
        assert self.stack.pop() == tag, tag
n = Nest()
n.feed(open("run/report.html").read())
assert not n.stack
PY

# Plots.
expect 2 "$FRAM" plot run -o none.png
says "CHANNEL: is missing: name what to draw" err
expect 0 "$FRAM" plot run
holds '^position_x \[m\]$' out
if [ $pictures = yes ]; then
    expect 0 "$FRAM" plot run roll ice_force_averaged_x -o two.png --from 1 --to 2
    [ "$(head -c 4 two.png | tail -c 3)" = PNG ] || fail "two.png is no PNG"
    expect 0 "$FRAM" plot run roll -o one.svg
    holds "<svg" one.svg
    for wrong in rolll orll; do
        expect 2 "$FRAM" plot run $wrong -o no.png
        says "did you mean roll?" err
    done
    expect 2 "$FRAM" plot run averaged_x -o no.png
    says "did you mean ice_force_averaged_x?" err
    expect 2 "$FRAM" plot run roll -o no.png --from 9
    # Headings about 180 degrees are drawn next to each other, whichever side of it they are on.
    for case in jumps goes_on; do
        cp -r run $case
        python3 - $case <<'PY'
import csv, sys
head, *rows = csv.reader(open("run/series.csv"))
other = -179.9 if sys.argv[1] == "jumps" else 180.1
yaw, estimated = head.index("yaw[deg]"), head.index("estimated_heading[deg]")
for k, row in enumerate(rows):
    row[yaw], row[estimated] = (179.9, other) if k % 2 == 0 else (other, 179.9)
csv.writer(open(sys.argv[1] + "/series.csv", "w"), lineterminator="\n").writerows([head, *rows])
PY
        expect 0 "$FRAM" plot $case yaw estimated_heading roll -o $case.svg
    done
    cmp jumps.svg goes_on.svg || fail "headings jump across the plot at 180 degrees"
    rm -r jumps goes_on
fi
expect 2 "$FRAM" plot run roll
says "--output" err

cp -r run rare
head -n 1 run/series.csv >rare/series.csv
expect 2 "$FRAM" plot rare roll -o none.png
says "no rows" err

sed -i '1s/ice_force_averaged_x/another_x/' rare/series.csv
sed -n '2,$p' run/series.csv >>rare/series.csv
expect 2 "$FRAM" extremes rare
says "the load is made of ice_force_averaged_x and ice_force_averaged_y" err
grep -q "did you mean load" err && fail "the name that was asked for is offered: $(cat err)"

# A record that is cut in its first frame is not one without frames, which a shorter interval would have.
cp -r run cut
head -c 2000 run/record.fram >cut/record.fram
expect 2 "$FRAM" export cut --vtk -o cut/shown
says "holds no whole frame before what is damaged or unfinished: wait where the run goes on, or run the scenario" err

# Two runs.
expect 0 "$FRAM" compare run run --json
holds '"same_state":true' out
expect 0 "$FRAM" compare run thin -o both.html
holds "scenarios: different" out
holds "ice load along X, mean" out
holds "Comparison of two runs" both.html
# Of a scenario that was changed since, and is not that of the run, who tells something of it says so.
cp -r thin edited
sed -i 's/thickness: 0.4 /thickness: 1.4 /' edited/scenario.yaml
for words in "compare thin edited -o both.html" "manage edited" "why edited --peak 1 --no-rerun" "extremes edited" \
    "fatigue edited"; do
    # shellcheck disable=SC2086
    expect 0 "$FRAM" $words
    says "warning: edited: scenario.yaml was changed since the run was made" err
    same "$(grep -c "warning" err)" 1 "warnings of $words"
done
holds "of B.*scenario.yaml was changed" both.html
grep -q "of A" both.html && fail "a scenario that was not changed is told as changed"
# Plans show the whole domain with its walls.
[ $pictures = no ] || python3 "$FRAM_SOURCE/tests/cli/pixels.py" walls run/report.html edited/manage.html ||
    fail "a plan leaves walls out"
# One of a Fram that lacked a key has another hash, and is read as the same.
cp -r run older
sed -i 's/"scenario_hash": "......../"scenario_hash": "01234567/' older/run.json
expect 0 "$FRAM" compare run older -o both.html
for file in out both.html; do holds "the same, as this Fram reads them" $file; done
expect 0 "$FRAM" compare older run --json
same "$(value 'j["same_scenario"], j["same_as_read"]')" "False True" "scenarios that are read as the same"
# So is one that was made that of another run, which says nothing of what was run.
cp -r run made
cp thin/scenario.yaml made/scenario.yaml
expect 0 "$FRAM" compare thin made -o both.html
for file in out both.html; do holds "the same, as this Fram reads them, or scenario.yaml was changed since" $file; done
expect 0 "$FRAM" compare made thin --json
same "$(value 'j["same_as_read"], j["changed_a"], j["changed_b"]')" "True True False" "a scenario that was changed"
expect 0 "$FRAM" compare run edited --json
same "$(value 'j["same_scenario"], j["same_as_read"]')" "False False" "scenarios that are not"

# Of several runs it is told once.
expect 0 "$FRAM" extremes edited made
says "warning: edited and 1 more: scenario.yaml was changed since" err
same "$(grep -c "was changed" err)" 1 "warnings of two runs that were changed"

# A run that was killed has come as far as its series; of its track and its state nothing is known.
cp -r run killed
as_killed killed
expect 0 "$FRAM" report killed -q
for part in "The run has not finished." "The run goes on, or was killed: it came to 3 s of 3 s." ", 3 s simulated;" \
    "150 of 0.02 s"; do
    holds "$part" killed/report.html
done
grep -q "did not come to its track" killed/report.html && fail "the track of a killed run is judged"
expect 0 "$FRAM" compare killed killed
holds "^simulated time \[s\]  *3  *3  *0$" out
holds "final states: different" out

# Video: frames without ffmpeg; with ffmpeg the file; without it a clear word.
if [ $pictures = yes ]; then
    expect 0 "$FRAM" video run --pictures --fps 2 --colour force --width 640 --height 480 -o frames
    [ "$(find frames -name 'frame-*.png' | wc -l)" = 7 ] || fail "not 7 frames: $(ls frames)"
    expect 2 "$FRAM" video run --colour red
    expect 2 "$FRAM" video run --width 641
    says "width" err
    expect 2 "$FRAM" video run --height 200
    says "height" err
    expect 2 "$FRAM" video run --camera nowhere
    expect 2 "$FRAM" video run --camera follow --span 80
    expect 2 "$FRAM" video run --speed 1e-9 --pictures -o endless
    says "100000 frames" err
    [ ! -e endless ] || fail "a refused video left a folder"
    expect 0 "$FRAM" video run --pictures --fps 1 --camera follow --width 480 --height 360 -o near
    cmp -s near/frame-000000.png near/frame-000002.png && fail "frames of the video in space are all the same"
    # A model looks as it does in full size.  Pictures go into the folder that the help tells.
    expect 0 "$FRAM" video --help
    says "the folder of --pictures (RUN/video)" out
    for scale in 30 0.2; do
        python3 -S - $scale >model.yaml <<'PY'
import sys
k = float(sys.argv[1])
print(f"""run: {{duration: 0.01, time_step: 0.01, scale: {k}}}
vessel: {{mode: prescribed, hull: {{form: box, length: {k}, beam: {k / 3}, draught: {k / 9}, freeboard: {k / 9}}}}}
ice: {{source: none}}
domain: {{x_min: {-2 * k}, x_max: {2 * k}, y_min: {-1.5 * k}, y_max: {1.5 * k}}}""")
PY
        expect 0 "$FRAM" run model.yaml -o model$scale -q
        expect 0 "$FRAM" video model$scale --pictures --camera follow --width 480 --height 360
    done
    expect 0 python3 "$FRAM_SOURCE/tests/cli/pixels.py" hulls model*/video/frame-000000.png
    # A folder with something in it is left alone; by force a shorter series leaves nothing of a longer one.
    expect 2 "$FRAM" video run --pictures --fps 1 --width 480 --height 360 -o frames
    says "names a folder that is not empty" err
    [ "$(find frames -type f | wc -l)" = 7 ] || fail "the folder was written into: $(ls frames)"
    touch frames/mine
    expect 0 "$FRAM" video run --pictures --fps 1 --width 480 --height 360 -o frames --force
    [ "$(find frames -type f | wc -l)" = 5 ] || fail "a shorter series leaves pictures of a longer one: $(ls frames)"
    # What cannot be the name of a video is told before anything is drawn.
    mkdir folder.mp4
    for name in run.avi film folder.mp4; do
        expect 2 "$FRAM" video run -o $name
        [ ! -f $name ] || fail "a video is called $name"
    done
    says "found a folder" err
    ! grep -q drawing err || fail "a video that has no place is drawn"
    # In narrow pictures the texts stand side by side, or one below the other.
    for camera in orbit plan; do
        for size in 320x360 700x480; do
            expect 0 "$FRAM" video run --pictures --fps 1 --speed 3 --colour force --camera $camera \
                --width "${size%x*}" --height "${size#*x}" -o "$camera-$size"
        done
    done
    python3 "$FRAM_SOURCE/tests/cli/pixels.py" scales {orbit,plan}-* || fail "texts cover each other"
    expect 0 "$FRAM" video run --pictures --fps 1 --speed 3 --width 320 --height 700 -o upright
    python3 "$FRAM_SOURCE/tests/cli/pixels.py" whole upright || fail "a picture cuts the field off"
    python3 "$FRAM_SOURCE/tests/cli/pixels.py" walls plan-700x480/frame-000000.png || fail "a plan leaves walls out"
    expect 2 "$FRAM" video run -o no/such/run.mp4
    says "cannot open for writing" err
    expect 1 env PATH=/nonexistent "$FRAM" video run -o none.mp4
    says "needs ffmpeg" err
    [ -z "$(ls none.mp4* 2>/dev/null)" ] || fail "a video without ffmpeg left $(ls none.mp4*)"
    # Ctrl-C, here by who is given the frames, leaves nothing; it does not reach ffmpeg by itself.
    mkdir bin
    cat >bin/ffmpeg <<'END'
#!/bin/sh
head -c 1000 >/dev/null
ps -o pgid= -p $$ -p $PPID | sort -u | wc -l >groups
kill -INT $PPID
exec cat >/dev/null
END
    chmod +x bin/ffmpeg
    expect 130 env PATH="$scratch/bin:$PATH" "$FRAM" video run --fps 100 --speed 1 -o stopped.mp4
    says "interrupted" err
    [ -z "$(ls stopped.mp4* 2>/dev/null)" ] || fail "an interrupted video left $(ls stopped.mp4*)"
    [ "$(cat groups)" = 2 ] || fail "ffmpeg is in the process group of the command"
    if command -v ffmpeg >/dev/null; then
        expect 0 "$FRAM" video run --fps 4 --width 640 --height 480 --camera plan --span 80 -o run.mp4
        [ "$(head -c 8 run.mp4 | tail -c 4)" = ftyp ] || fail "run.mp4 is no MP4"
    fi
fi
[ -z "$(find . -name '*.new')" ] || fail "half-written files are left: $(find . -name '*.new')"

finish "results are as a user expects them"
