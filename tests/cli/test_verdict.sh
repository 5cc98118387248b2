#!/usr/bin/env bash
# The verdict on top of a report: held or not, lines, limits, enough time or not; and the scenario as it was computed.
. "$FRAM_SOURCE/tests/cli/common.sh"
. "$FRAM_SOURCE/tests/cli/verdict_box.sh"

cat >ship.yaml <<'YAML'
run: {duration: 16, time_step: 0.05, transient: 4}
vessel:
  mode: free
  hull: {form: ship, length: 76, beam: 19, draught: 6.5, freeboard: 3.5, block_coefficient: 0.75}
  mooring:
    depth: 120
    lines:
      - {count: 4, spacing_deg: 90, distance: 900, pretension: 8.0e5, weight: 1500, stiffness: 8.0e8,
         breaking_load: 8.0e6}
      - {kind: spring, direction_deg: 0, distance: 300, pretension: 1.0e5, stiffness: 1.0e6, breaking_load: 5.0e6}
  station: {offset_limit: 20}
ice: {concentration: 0.7, mean_floe_area: 400, thickness: 0.7}
domain: {x_min: -120, x_max: 120, y_min: -100, y_max: 100, boundary: walls}
environment: {current_speed: 1.5, current_direction_deg: 180, wind_file: wind.csv}
output: {averaging_window: 0.5}
YAML
printf 'time[s],x[m/s],y[m/s]\n0,-8,0\n20,-6,3\n' >wind.csv

expect 0 "$FRAM" run ship.yaml -o held --quiet
verdict held
says "The vessel held its station. No line of 5 parted." verdict.txt
says "within its limit of 20 m" verdict.txt
says "% of its breaking load; 5 lines" verdict.txt
says "too short for a mean" verdict.txt
grep -q '^bad' verdict.txt && fail "a vessel that held is blamed"
says "5 mooring lines in 120 m of water, no thrusters" held/report.html
says "time history wind.csv" held/report.html
says "free in six degrees of freedom" held/report.html
says "was requested of the area free for ice" held/report.html
says "ship of full form" held/report.html

# The largest load and the largest tension that the box tells are those after the transient.
python3 - <<'PY' || fail "the largest load or tension of the box is not that after the transient"
import csv, json, re
rows = list(csv.reader(open("held/series.csv")))
name = [c.split("[")[0] for c in rows[0]]
t, x, y = (name.index(n) for n in ("time", "ice_force_averaged_x", "ice_force_averaged_y"))
most = max((float(r[x]) ** 2 + float(r[y]) ** 2) ** 0.5 for r in rows[1:] if float(r[t]) > 4)
told = re.search(r"largest ice load ([\d.e+]+) (k?M?)N", open("verdict.txt").read(), re.I)
value = float(told[1]) * {"": 1, "k": 1e3, "M": 1e6}[told[2]]
assert abs(value / most - 1) < 0.006, (value, most)
told = re.search(r"most used line (\d): ([\d.]+) kN, (\d+) % of its", open("verdict.txt").read(), re.I)
used = max(json.load(open("held/station.json"))["lines"], key=lambda line: line["utilisation"])
assert int(told[1]) == used["number"] and abs(float(told[3]) - 100 * used["utilisation"]) < 0.6, (told[0], used)
assert abs(float(told[2]) * 1e3 / used["greatest"] - 1) < 7e-4, (told[0], used)  # at the start it was 0.14 % larger
PY

# One value has the same digits in its tile and in the box: all those before the point, three at least.
cp -r held large
cat >largest.py <<'PY'
import csv, sys
rows = list(csv.reader(open("large/series.csv")))
name = [c.split("[")[0] for c in rows[0]]
t, x, y = (name.index(n) for n in ("time", "ice_force_averaged_x", "ice_force_averaged_y"))
loads = [(float(r[x]) ** 2 + float(r[y]) ** 2) ** 0.5 for r in rows[1:] if float(r[t]) > 4]
most = max(loads) if sys.argv[2] == "largest" else sum(loads) / len(loads)
for r in rows[1:]:
    for k in (x, y):
        r[k] = repr(float(r[k]) * float(sys.argv[1]) / most)
csv.writer(open("large/series.csv", "w"), lineterminator="\n").writerows(rows)
PY
python3 largest.py 1211.4e3 largest
verdict large
says "argest ice load 1211 kN, averaged" verdict.txt
says '<b>1211 <small>kN</small></b><span>largest ice load, averaged over 0.5 s' large/report.html
# The same unit, also beside a largest one in kN.
python3 largest.py 7203.1 mean
verdict large
says "ean ice load 7203 N, known" verdict.txt
says '<b>7203 <small>N</small></b><span>mean ice load' large/report.html
grep -q 'argest ice load [0-9.]* kN, averaged' verdict.txt || fail "the largest load is not in kN: $(cat verdict.txt)"

# Averages over half of what is left after the transient are two values; here they reach back to before the start.
grep -q 'averaging window' verdict.txt && fail "a window that is shorter than the transient is told"
cp -r held wide
sed -i 's/averaging_window: 0.5/averaging_window: 6/' wide/scenario.yaml
verdict wide
says "2 independent values in 12 s): too short for a mean" verdict.txt
says "The averaging window of 6 s is longer than the transient of 4 s: the mean contains what was before it" verdict.txt
says "Make output.averaging_window shorter, or run.transient longer" verdict.txt
# Of n values the mean is known by Student's t of n - 1 degrees; two have 12.7062.  Here of a load that is never small.
cat >raise.py <<'PY'
import csv, math, re, sys
rows = list(csv.reader(open("wide/series.csv")))
name = [c.split("[")[0] for c in rows[0]]
t, x, y = (name.index(n) for n in ("time", "ice_force_averaged_x", "ice_force_averaged_y"))
if sys.argv[1:] == ["raise"]:
    for row in rows[1:]:
        row[x] = float(row[x]) - 2e5
    csv.writer(open("wide/series.csv", "w"), lineterminator="\n").writerows(rows)
    sys.exit()
load = [math.hypot(float(r[x]), float(r[y])) for r in rows[1:] if float(r[t]) > 4]
mean = sum(load) / len(load)
within = 100 * 12.7062 / 2**0.5 * (sum((v - mean) ** 2 for v in load) / len(load)) ** 0.5 / mean
told = float(re.search(r"known within (\d+) % \(95 % confidence, 2 indep", open("verdict.txt").read())[1])
assert 50 < within < 500 and abs(told - within) < 1, (told, within)
PY
python3 raise.py raise
verdict wide
python3 raise.py || fail "the mean of two values is not known by Student's t"

# A limit of 0 is one that a vessel keeps which does not move that way.
cp -r held still
sed -i 's/^\(  *heading_limit_deg: \).*/\10/' still/scenario.yaml
python3 - <<'PY'
import csv
rows = list(csv.reader(open("still/series.csv")))
turn = [c.split("[")[0] for c in rows[0]].index("heading_deviation")
for row in rows[1:]:
    row[turn] = "0"
csv.writer(open("still/series.csv", "w"), lineterminator="\n").writerows(rows)
PY
verdict still
says "Largest heading deviation 0 deg, within its limit of 0 deg (0 %)" verdict.txt

# One line is told in the singular.
sed '/count: 4/d; s/^         breaking_load.*//' ship.yaml >hawser.yaml
expect 0 "$FRAM" run hawser.yaml -o hawser --quiet --set run.duration=4.1
verdict hawser
says "The vessel held its station. The line did not part." verdict.txt
says "% of its breaking load; 1 line." verdict.txt

# A limit that is passed and a line that parts are told with their time, and what to do.
expect 0 "$FRAM" run ship.yaml -o lost --quiet --set vessel.station.offset_limit=0.01 \
    --set "vessel.mooring.lines[1].breaking_load=90000"
verdict lost
says "bad" verdict.txt
says "The vessel did not hold its station. 1 of 5 lines parted" verdict.txt
says "was beyond its limit of 0.01 m already at the end of the transient (since" verdict.txt
says "damaged mooring" verdict.txt
says "of which those that parted went beyond" verdict.txt
python3 - <<'PY' || fail "station.json or the box does not tell the line that parted, the largest tension or since when"
import json, re
lines = json.load(open("lost/station.json"))["lines"]
gone = [l for l in lines if l["parted"]]
assert len(lines) == 5 and len(gone) == 1 and gone[0]["number"] == 5
assert gone[0]["utilisation"] >= 1 and gone[0]["tension_then"] >= 9e4 and 4 < gone[0]["parted_at_s"] < 16
assert all(l["parted_at_s"] is None and 0 < l["utilisation"] < 1 for l in lines if not l["parted"])
# The line that is used most has not the largest tension.
told = re.search(r"Most used line 5: .*; largest tension (\d+) kN in line (\d)\.", open("verdict.txt").read())
most = max(lines, key=lambda line: line["greatest"])
assert int(told[2]) == most["number"] and abs(float(told[1]) * 1e3 / most["greatest"] - 1) < 1e-3, (told[0], most)
since = float(re.search(r"\(since ([\d.]+) s\)", open("verdict.txt").read())[1])
passed = [e["time_s"] for e in json.load(open("lost/run.json"))["events"] if e["kind"] == "position_lost"]
assert abs(since - max(t for t in passed if t <= 4)) < 1e-5, (since, passed)
PY

fewer="lines parted or were let go in 1 of 1 runs: cycles from there on are those of a mooring with fewer lines"
expect 0 "$FRAM" fatigue lost --channel line_tension_max
says "warning: $fewer" err

# Steps that the series leaves out count: a limit that is passed between two rows, and when a line parted.
# It is 0.07 m off at 4 s, 0.04 m at 8 s, and comes nearer: what was lost in the transient may have been regained there.
expect 0 "$FRAM" run ship.yaml -o between --quiet --set output.csv_interval=8 --set vessel.station.offset_limit=0.05 \
    --set "vessel.mooring.lines[1].release_time=15" --set "vessel.mooring.lines[0].breaking_load=auto"
expect 0 "$FRAM" fatigue between --channel offset_x
says "$fewer" err
expect 0 "$FRAM" fatigue between --channel load
grep "fewer lines" err && fail "a load is told to be of a mooring with fewer lines"
verdict between
says "The vessel may not have held its station. 1 of 5 lines parted or were released." verdict.txt
says "may have been beyond its limit of 0.05 m from 4 s on, between two rows of the series; the rows reach" verdict.txt
says "the first at 15 s" verdict.txt
says "of its breaking load; 5 lines; 4 lines without a breaking load are not judged; largest tension" verdict.txt
grep -q "went beyond" verdict.txt && fail "a line that was let go is told to have gone beyond its breaking load"
sed -i 's/transient: 4/transient: 0/' between/scenario.yaml
verdict between
says "The vessel did not hold its station." verdict.txt
holds "passed its limit of 0.05 m at [0-3][.0-9]* s, between two rows of the series" verdict.txt
# Of one that was killed no events are known.
as_killed between
verdict between
says "The vessel may not have held its station." verdict.txt
says "may have been beyond its limit of 0.05 m from 0 s on, between two rows of the series" verdict.txt

# Of a fleet each vessel is judged, the last as the first, and what is said of the run comes behind them all.
{
    echo "run: {duration: 1, time_step: 0.05}"
    echo "environment: {wind_speed: 20}"
    echo "ice: {source: none}"
    echo "domain: {x_min: -300, x_max: 300, y_min: -300, y_max: 300, boundary: open}"
    echo "vessels:"
    for i in $(seq 30); do
        row=$((i / 6))
        echo "  - {name: v$i, mode: free, x: $((i % 6 * 60)), y: $((row * 60)), hull: {form: box, length: 20,"
        echo "     beam: 8, draught: 3, freeboard: 2}, mooring: {lines: [{kind: spring, stiffness: 1.0e4, count: 4,"
        echo "     spacing_deg: 90}]}, station: {offset_limit: $([ "$i" = 30 ] && echo 1.0e-6 || echo 5)}}"
    done
} >fleet.yaml
expect 0 "$FRAM" run fleet.yaml -o fleet --quiet
verdict fleet
says "A vessel did not hold its station. No line of 120 parted." verdict.txt
says "Vessel v30: the offset passed its limit of 1e-06 m, first at 0.05 s" verdict.txt
says "contact solver" verdict.txt
[ "$(head -1 verdict.txt)" = bad ] || fail "the last of 30 vessels is not judged"
[ "$(grep -c 'within its limit of 5 m' verdict.txt)" = 29 ] || fail "a vessel of 30 is not judged"

# A run that was stopped is no finished one.  Where every step has a row, rows tell whether a limit that was passed in
# the transient was so after it: it ends here between the limit and 0.9 of it, from where station is regained.
expect 0 "$FRAM" run ship.yaml -o half --quiet --until 8 --set vessel.station.offset_limit=0.05
verdict half
says "The vessel did not hold its station." verdict.txt
python3 - <<'PY' || fail "the offset does not come back within its limit"
import csv
rows = list(csv.reader(open("half/series.csv")))
t, x, y = ([c.split("[")[0] for c in rows[0]].index(n) for n in ("time", "offset_x", "offset_y"))
off = [((float(r[x]) ** 2 + float(r[y]) ** 2) ** 0.5, float(r[t])) for r in rows[1:]]
began = next(time for size, time in reversed(off) if size > 0.049)
assert 4 < began < 8 and all(0.045 < s < 0.05 for s, time in off if began <= time < began + 0.05), (began, off[-1])
text = open("half/scenario.yaml").read()
open("half/scenario.yaml", "w").write(text.replace("transient: 4", f"transient: {began}"))
PY
verdict half
says "held its station as far as the run went" verdict.txt
says "fram resume" verdict.txt

# A run that ends with its transient has no statistics, and says so; the step that ends with it is the last of it.
expect 0 "$FRAM" run ship.yaml -o brief --quiet --set run.duration=4.05
verdict brief
says "1 of 81 rows of the run are after the transient of 4 s" verdict.txt
grep -q 'mean ice load' verdict.txt && fail "one row has a mean"
expect 0 "$FRAM" run ship.yaml -o before --quiet --set run.duration=4 --set run.transient=4 \
    --set output.csv_interval=0.3
verdict before
says "0 of 13 rows of the run are after the transient of 4 s" verdict.txt
says "Whether it kept its station was not measured" verdict.txt
grep -q 'held its station\|nan' verdict.txt before/station.json && fail "a station that was not measured was held"
grep -q '>-*nan' before/report.html && fail "the report tells no numbers"

# Open water, towed: nothing to hold, no ice to speak of.
grep -v -e mooring -e depth -e lines -e count -e breaking -e spring -e station ship.yaml >tow.yaml
expect 0 "$FRAM" run tow.yaml -o tow --quiet --set vessel.mode=towed --set vessel.speed=1 --set ice.source=none
verdict tow
says "The run finished." verdict.txt
grep -q 'ice load' verdict.txt && fail "open water has an ice load"
# Floes that hardly crush, jammed between a bow and the driven edge of a field: the load is one of the domain's size.
cat >edge.yaml <<'YAML'
run: {duration: 110, time_step: 0.05, transient: 60, seed: 2}
vessel:
  mode: free
  hull: {form: ship, length: 180, beam: 32, draught: 11, block_coefficient: 0.82}
  mooring:
    depth: 80
    lines: [{count: 8, spacing_deg: 45, distance: 700, pretension: 8.0e5, breaking_load: 8.0e6}]
ice: {concentration: 0.9, mean_floe_area: 700, thickness: 0.8, crushing_strength: 2.0e7}
domain: {x_min: -130, x_max: 130, y_min: -130, y_max: 130, boundary: feeding}
environment: {current_speed: 0.5, current_direction_deg: 180}
output: {csv_interval: 0.5}
YAML
expect 0 "$FRAM" run edge.yaml -o edge --quiet
verdict edge
says "comes through chains of floes that end at the driven edge of the domain." verdict.txt
says "Enlarge the domain" verdict.txt
grep -q 'towing carriage' edge/report.html && fail "a moored vessel has a towing carriage"
# Without the row at the end of the transient, as in all other figures: here the last is the only one, in which a chain
# pushes.
cp -r edge brim
sed -i 's/transient: 60/transient: 109.5/' brim/scenario.yaml
expect 0 "$FRAM" report brim
verdict brim
says "1 of 220 rows of the run are after the transient of 109.5 s" verdict.txt
says "comes through chains of floes that end at the driven edge of the domain." verdict.txt
for run in held tow; do
    grep -q 'driven edge' $run/report.html && fail "a run without a driven edge is told of one: $run"
done

# Ice that a ship does not meet is told of when the run ends; not where one meets it, nor where there is none.
cat >far.yaml <<'YAML'
run: {duration: 3, time_step: 0.02}
vessel: {mode: towed, x: -60, speed: 2, ramp: 0.5, hull: {length: 60, beam: 12, draught: 4, freeboard: 3}}
ice: {source: floes, floes: [{length: 10, width: 10, x: 50}]}
domain: {x_min: -200, x_max: 200, y_min: -50, y_max: 50, boundary: open}
output: {csv_interval: 0.5}
YAML
met() {
    expect 0 "$FRAM" run far.yaml -o far --force "$@"
    cp err met.txt
}
met
grep -q "the vessel met no ice until t = 3 s" met.txt || fail "a ship that met no ice is not told of it: $(cat met.txt)"
met --set vessel.x=16
grep -q "met no ice" met.txt && fail "a ship that met ice is told that it met none: $(cat met.txt)"
# A touch between two rows of the series is told of too.
sed 's|x: -60, speed: 2, ramp: 0.5|path: [{time: 0, x: 8}, {time: 1, x: 16}, {time: 3, x: 0}]|
     s|csv_interval: .*|csv_interval: 1.5}|' far.yaml >touch.yaml
expect 0 "$FRAM" run touch.yaml -o touch
grep -q "met no ice" err && fail "a ship that met ice between rows is told that it met none: $(cat err)"
verdict touch
says "but one of" verdict.txt
says "of the approach speed of 8 m/s" verdict.txt # that of the path, which the series tells
grep -q "no ice load occurred" verdict.txt && fail "the report knows nothing of a load between rows"

# A current that files tell is the approach speed, with what the keys say only where no file stands in their place.
cat >walls.yaml <<'YAML'
run: {duration: 4, time_step: 0.05, transient: 2}
domain: {boundary: walls, x_min: -60, x_max: 60, y_min: -60, y_max: 60}
ice: {source: voronoi, concentration: 0.6, mean_floe_area: 200, thickness: 0.4}
vessel: {mode: prescribed, hull: {form: ship, length: 40, beam: 10, draught: 4}}
YAML
printf 'time[s],x[m/s],y[m/s]\n0,0,0\n1,0,0.4\n' >walls.csv
printf 'depth[m],x[m/s],y[m/s]\n0,0.3,0\n5,2,0\n' >deep.csv
# approached SPEED KEYS...
approached() {
    local speed=$1
    shift
    expect 0 "$FRAM" run walls.yaml -o walls --force -q "${@/#/--set=environment.}"
    verdict walls
    says "of the approach speed of $speed m/s" verdict.txt
}
approached 1.5 current_speed=1.5
approached 0.4 current_file=walls.csv
approached 0.4 current_file=walls.csv current_speed=3
approached 0.3 current_profile_file=deep.csv
approached 0.5 current_profile_file=deep.csv current_file=walls.csv
approached 1.3 current_profile_file=deep.csv current_speed=1
sed -i "s|source: floes.*|source: none}|" far.yaml
met
grep -q "met no ice" met.txt && fail "a ship in open water is told that it met no ice: $(cat met.txt)"

# What was kept free of ice is told of the vessels that there are.  One frame is one.
cat >bare.yaml <<'YAML'
run: {duration: 0.01, time_step: 0.01}
vessel: {present: false}
ice: {mean_floe_area: 400}
domain: {x_min: -50, x_max: 50, y_min: -50, y_max: 50}
YAML
sed 's|^vessel: .*|vessels: [{name: a, hull: {length: 20, beam: 6, draught: 2}, x: -20}, {name: b, x: 20,|
     s|^ice: {|  hull: {length: 20, beam: 6, draught: 2}}]\nice: {open_water: [{length: 9, width: 9}], |' \
    bare.yaml >pair.yaml
for run in bare pair; do
    expect 0 "$FRAM" run $run.yaml -o $run -q
    expect 0 "$FRAM" report $run -q
done
says "free for ice: the domain. The table" bare/report.html
says "the domain without the vessels and 1 m around them and the open water. The table" pair/report.html
echo "<!--BESIDE--><!--RECORD-->" >page.html
expect 0 "$FRAM" view bare --page page.html
says "playback.html: 1 frame; open it" err
# One step, one floe, one break.
sed 's|^ice: .*|ice: {source: floes, breakable: true, floes: [{length: 9, width: 9}]}|' bare.yaml >alone.yaml
expect 0 "$FRAM" run alone.yaml -o alone
says "after 1 step: 1 floe," err
grep -q "1 floes" err && fail "one floe is told in the plural: $(cat err)"
printf '0.01,2,1,2,5%s\n' "$(printf ',0%.0s' {1..19})" >>alone/fractures.csv
expect 0 "$FRAM" report alone -q
says "1 floe broke: 1 in bending" alone/report.html
# Which load is told of a break: of floes that split by toughness another one.
says "The load is along the floe's own vertical." alone/report.html
sed -i 's/splitting: length/splitting: toughness/' alone/scenario.yaml
expect 0 "$FRAM" report alone -q
says "vertical; of floes that split by their toughness it is that in their plane." alone/report.html
finish "a report begins with its verdict"
