#!/usr/bin/env bash
# What befalls a vessel on station is named in the log while it runs, and in its results.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >"$scratch/scene.yaml" <<'END'
run: {duration: 60, time_step: 0.1, transient: 20}
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}
  mooring:
    depth: 60
    lines:
      - {direction_deg: 0, distance: 400, pretension: 3.0e5, release_time: 5}
      - {direction_deg: 180, distance: 400, pretension: 3.0e5, breaking_load: 2.9e5}
      - kind: table
        direction_deg: 270
        table_file: line.csv
      - {direction_deg: 90, distance: 400, pretension: 3.0e5, breaking_load: 9.0e5}
  thrusters:
    - {x: 15, thrust: 40.0e3, failure_time: 10}
    - {x: -15, thrust: 40.0e3}
  positioning: {active: true}
  station: {offset_limit: 0.5, heading_limit_deg: 0.5}
ice: {source: none}
domain: {boundary: open}
environment: {current_speed: 1.5, current_direction_deg: 20}
output: {frame_interval: 0, csv_interval: 0.5}
END
printf 'offset[m],tension[N]\n-20,1e5\n0,3e5\n20,6e5\n' >"$scratch/line.csv"
"$FRAM" run "$scratch/scene.yaml" -o "$scratch/run" 2>err || fail "the run: $(tail -n 3 err)"
for words in 'line 1 was let go' 'line 2 broke' 'thruster 1 failed' 'position lost'; do
    says "$words" err
done
expect 0 "$FRAM" run "$scratch/scene.yaml" -o "$scratch/whole" -q --set output.csv_interval=0.1
python3 - "$scratch/run" <<'END' || fail "station.json"
import json, math, sys
j = json.load(open(sys.argv[1] + "/station.json"))
kinds = [e["kind"] for e in j["events"]]
for kind in ("line_break", "line_release", "thruster_failure", "position_lost"):
    assert kind in kinds, (kind, kinds)
assert j["offset_m"]["exceedance"] > 0, "time beyond the limit"
assert max(j["offset_envelope_m"]) <= j["offset_m"]["peak"] + 1e-9, "envelope"
for key in ("mean", "significant", "peak"):
    assert key in j["line_tension_largest_N"] and key in j["ice_load_N"], key
# Beside the series itself, after the transient.
import csv
rows = [r for r in csv.DictReader(open(sys.argv[1] + "/series.csv")) if float(r["time[s]"]) > 20]
turned = [float(r["heading_deviation[deg]"]) for r in rows]
share = sum(abs(d) > 0.5 for d in turned) / len(turned)
assert share > sum(d > 0.5 for d in turned) / len(turned), "nothing to tell the sides apart"
assert abs(j["heading_deviation_deg"]["exceedance"] - share) < 1e-12, (j["heading_deviation_deg"], share)
use = max(float(r["line_4_tension[N]"]) for r in rows) / 9.0e5
assert abs(j["lines"][3]["utilisation"] - use) < 1e-9, (j["lines"][3], use)
assert j["lines"][0]["utilisation"] is j["lines"][2]["utilisation"] is None, "lines without a breaking load"
assert j["lines"][3]["mean"] < 0.99 * j["lines"][3]["peak"], "nothing to tell mean and peak apart"
def ends(key, column):
    values = [float(r[column]) for r in rows]
    side = -1 if -min(values) > max(values) else 1
    found = [j[key][k] for k in ("least", "greatest", "peak")]
    assert found == [min(values), max(values), side * max(side * v for v in values)], (key, found)
    assert side * j[key]["significant"] > 0 and abs(j[key]["significant"]) <= abs(j[key]["peak"]), (key, j[key])
    return side
# The peak is the largest in size, on either side; heading limits count both.
sides = {ends("offset_x_m", "offset_x[m]"), ends("offset_y_m", "offset_y[m]"),
         ends("heading_deviation_deg", "heading_deviation[deg]")}
assert sides == {-1, 1}, "nothing to tell the sides apart"
# Energy and mean power are of the same time, the whole one after the transient.
power = [(20, 0), *((float(r["time[s]"]), float(r["thruster_power[W]"])) for r in rows)]
energy = sum((b[0] - a[0]) * b[1] for a, b in zip(power, power[1:]))
assert abs(energy / (40 * j["thruster_power_W"]["mean"]) - 1) < 1e-9, (energy, j["thruster_power_W"])
assert abs(j["thruster_power_W"]["energy_J"] / energy - 1) < 1e-9, (j["thruster_power_W"], energy)
# A row has the deviation at its time, as the event at that time has it.
event = next(e for e in j["events"] if e["kind"] == "heading_lost")
(row,) = [r for r in csv.DictReader(open(sys.argv[1] + "/../whole/series.csv"))
          if abs(float(r["time[s]"]) - event["time_s"]) < 1e-6]
off = float(row["heading_deviation[deg]"])
assert abs(math.radians(off) - event["value"]) < 1e-11, (off, event)
assert j["thruster_power_W"]["energy_J"] > 0 and len(j["lines"]) == 4 and len(j["thrusters"]) == 2
END
head -n 1 "$scratch/run/series.csv" | grep -q 'hydrodynamic_force_x' || fail "series.csv lacks hydrodynamic_force_x"
case $("$FRAM" --version) in
*cairo*)
    [ -s "$scratch/run/station.png" ] || fail "station.png is missing"
    "$FRAM" report "$scratch/run" 2>/dev/null || fail "the report"
    says 'Station keeping' "$scratch/run/report.html"
    # A picture that is there and cannot be read is told, never left out; one that is not there is not missed.
    mv "$scratch/run/station.png" "$scratch/kept.png"
    mkdir "$scratch/run/station.png"
    expect 2 "$FRAM" report "$scratch/run"
    says 'station.png' err
    rmdir "$scratch/run/station.png"
    expect 0 "$FRAM" report "$scratch/run"
    mv "$scratch/kept.png" "$scratch/run/station.png"
    ;;
esac

# The report's significant peak is that of station.json.
expect 0 "$FRAM" report "$scratch/run" -q
python3 - "$scratch/run" <<'END' || fail "the report tells another peak than station.json"
import json, re, sys
j = json.load(open(sys.argv[1] + "/station.json"))
page = open(sys.argv[1] + "/report.html").read()
for name, key in (("along X [m]", "offset_x_m"), ("along Y [m]", "offset_y_m"),
                  ("heading [deg]", "heading_deviation_deg")):
    table = page[page.index("deviation from the set"):]
    row = re.search(r"<tr><th[^>]*>" + re.escape(name) + r"</th>(.*?)</tr>", table, re.S)
    told = [float(c) for c in re.findall(r"<td[^>]*>([^<]*)</td>", row[1])]
    wanted = [j[key][k] for k in ("mean", "deviation", "least", "greatest", "significant")]
    assert all(abs(a - b) <= 1e-3 * abs(b) for a, b in zip(told, wanted)), (name, told, wanted)
END

# A series without rows measures nothing: null, and no other channel is meant.
expect 0 "$FRAM" run "$scratch/scene.yaml" -o none -q --set output.csv_interval=100
python3 - none <<'END' || fail "station.json of a series without rows"
import json, sys
j = json.load(open(sys.argv[1] + "/station.json"))
for key in ("offset_m", "heading_deviation_deg", "ice_load_N", "thruster_power_W"):
    assert all(v is None for k, v in j[key].items() if k != "limit"), (key, j[key])
assert j["offset_m"]["limit"] == 0.5 and j["offset_envelope_m"] is None and j["thrusters_saturated"] is None
assert any(e["kind"] == "position_lost" for e in j["events"])
for line in j["lines"]:
    assert line["mean"] is line["peak"] is None
    assert (line["utilisation"] is None) == (line["number"] != 2), line
assert all(t["largest_use"] is None and t["mean"] is None for t in j["thrusters"])
END
expect 0 "$FRAM" report none -q
says "Whether it kept its station was not measured" none/report.html
grep -q "held its station\|No line of" none/report.html && fail "a station that was not measured was held"
for command in extremes fatigue; do
    expect 2 "$FRAM" $command none
    says "the run's series has no rows" err
    expect 2 "$FRAM" $command none --channel offset_x
    says "the run's series has no rows; give the scenario a shorter output.csv_interval" err
done
expect 0 "$FRAM" compare none none -o none.html -q
# One that was stopped before its first step has no rows yet, whatever the interval.
expect 0 "$FRAM" run "$scratch/scene.yaml" -o early -q --until 0.001
expect 2 "$FRAM" extremes early --channel offset_x
says "it has made no step yet that has one; \`fram resume early\` goes on with it" err

# A limit that the track came near before the transient's end is in the footprint, which shows that.
expect 0 "$FRAM" run "$scratch/scene.yaml" -o start -q --until 15
! built_with cairo || python3 "$FRAM_SOURCE/tests/cli/pixels.py" limit start/station.png || fail "start/station.png"

# What is required of a vessel that nothing holds is judged as well.
cat >adrift.yaml <<'END'
run: {duration: 4, time_step: 0.1}
vessel: {mode: free, hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}, station: {offset_limit: 1}}
ice: {source: none}
domain: {boundary: open}
END
expect 0 "$FRAM" run adrift.yaml -o adrift --set vessel.speed=1
says "position lost" err
python3 - adrift <<'END' || fail "station.json of a vessel that nothing holds"
import json, sys
j = json.load(open(sys.argv[1] + "/station.json"))
assert j["offset_m"]["limit"] == 1 and j["offset_m"]["exceedance"] > 0.5 and not j["lines"] and not j["thrusters"]
END
expect 0 "$FRAM" report adrift -q
says "did not hold its station" adrift/report.html
! built_with cairo || says "heading, loads and power" adrift/report.html
expect 0 "$FRAM" run adrift.yaml -o free -q --set vessel.station.offset_limit=auto
[ -e free/station.json ] && fail "a vessel of which nothing is required has a station"

# As many lines and thrusters as a scenario may have, to the last result; one line more is refused before the run.
{
    echo 'run: {duration: 2, time_step: 0.1}'
    echo 'vessel:'
    echo '  mode: free'
    echo '  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}'
    echo '  mooring:'
    echo '    depth: 60'
    echo '    lines: [{count: 64, direction_deg: 0, spacing_deg: 5.625, distance: 400, pretension: 1.0e5}]'
    echo '  thrusters:'
    for i in $(seq 32); do echo "    - {x: $((i - 16)), thrust: 1.0e3}"; done
    echo '  positioning: {active: true}'
    echo 'ice: {source: none}'
    echo 'domain: {boundary: open}'
} >many.yaml
expect 0 "$FRAM" run many.yaml -o many -q
python3 - many <<'END' || fail "station.json of many lines"
import json, sys
j = json.load(open(sys.argv[1] + "/station.json"))
assert len(j["lines"]) == 64 and len(j["thrusters"]) == 32, (len(j["lines"]), len(j["thrusters"]))
assert all(line["mean"] > 0 for line in j["lines"]), "tensions"
END
expect 0 "$FRAM" report many -q
sed 's/lines: \[/&{direction_deg: 3, distance: 400, pretension: 1.0e5}, /' many.yaml >more.yaml
expect 2 "$FRAM" check more.yaml --json
same "$(value 'j["error"]["key"], j["error"]["line"]')" "vessel.mooring.lines 7" "place of a line too many"

# The start at equilibrium names its vessel and tells how far it is turned; so does one that is sought in vain: lines
# that pull no harder than 2 kN.
cat >two.yaml <<'END'
run: {duration: 0.2, time_step: 0.1, scale: 30}
vessels:
  - name: box
    mode: free
    heading_deg: 40
    hull: {form: box, length: 100, beam: 20, draught: 7, freeboard: 4}
    mooring:
      depth: 100
      turret: true
      x: 30
      lines: [{count: 4, spacing_deg: 90, distance: 600, pretension: 5e5, weight: 1000}]
  - name: weak
    mode: free
    x: 400
    hull: {form: box, length: 100, beam: 20, draught: 7, freeboard: 4}
    mooring:
      depth: 100
      lines:
        - {kind: table, count: 4, spacing_deg: 90, distance: 600,
           table: [{offset: -10, tension: 1e3}, {offset: 0, tension: 2e3}, {offset: 10, tension: 2e3}]}
ice: {source: none}
domain: {boundary: open, x_min: -600, x_max: 1000, y_min: -600, y_max: 600}
environment: {current_speed: 1, current_direction_deg: 60}
END
expect 0 "$FRAM" run two.yaml -o two
# Off is the turret, which a current of 1 m/s moves by decimetres, not the origin that goes round it.
holds 'vessel box begins at the equilibrium of its mooring, (0.0[0-9]*, 0.1[0-9]*) m off and turned by -160 degrees' err
says 'warning: no equilibrium of the mooring of vessel weak was found' err
expect 0 "$FRAM" run two.yaml -o two --force --set vessels.box.heading_deg=60
holds 'vessel box begins .* m off; it is not stable: any touch turns the vessel from it, to heading -120' err
expect 0 "$FRAM" run two.yaml -o two --force --set vessels.box.heading_deg=-120
holds 'vessel box begins at the equilibrium of its mooring, .* m off$' err
# What rounding leaves of a way is no way: nothing pushes this ship in Y.
expect 0 "$FRAM" check "$FRAM_SOURCE/scenes/turret_ship.yaml"
holds 'begins at the equilibrium of its mooring, (-0.00[0-9]*, 0) m off' err
# A vessel on lines alone is not told to take more thrust.
expect 0 "$FRAM" run two.yaml -o two --force --set vessels.box.heading_deg=60 \
    --set vessels.box.station.offset_limit=1e-6
expect 0 "$FRAM" report two
says 'consider stiffer lines or ice management' two/report.html
grep -F 'more thrust' two/report.html && fail "thrust for a vessel without thrusters"
# What would hold a vessel better goes by what it has and who orders it: nobody, its own system, lines too, a program.
advice() { # SENTENCE KEYS
    cat >held.yaml <<END
run: {duration: 0.4, time_step: 0.1}
vessel:
  mode: free
  hull: {form: box, length: 60, beam: 14, draught: 4, freeboard: 3}
  station: {offset_limit: 1e-6}
  $2
ice: {source: none}
domain: {boundary: open}
environment: {current_speed: 1, current_direction_deg: 90}
END
    expect 0 "$FRAM" run held.yaml -o held --force -q
    expect 0 "$FRAM" report held -q
    says "Examine the loads at that time (fram why)$1" held/report.html
    same "$(grep -o 'Examine the loads' held/report.html | wc -l)" 1 "advice"
}
thruster='thrusters: [{kind: azimuth, x: 20, thrust: 1e5}]' ordered='positioning: {active: true}'
line='mooring:
    depth: 50
    lines: [{kind: spring, count: 2, spacing_deg: 180, distance: 99, stiffness: 1e4, pretension: 1e3}]'
advice ': nobody gives its thrusters orders (vessel.positioning).' "$thruster"
advice '; consider more thrust or ice management.' "$thruster"$'\n  '"$ordered"
advice '; consider more thrust, stiffer lines or ice management.' "$thruster"$'\n  '"$ordered"$'\n  '"$line"
advice '; consider stiffer lines or ice management.' "$thruster"$'\n  '"$line"
advice ': nothing holds the vessel there, neither lines nor thrusters.' ''
sed -i 's/"told": \[\]/"told": ["thruster_1_order"]/' held/run.json
expect 0 "$FRAM" report held -q
says 'Examine the loads at that time (fram why), and what the program that steered the run did.' held/report.html
# An event that names a vessel at length is broken before the charts.
expect 0 "$FRAM" run two.yaml -o two --force --set vessels.box.approach.limit=1e5 \
    --set vessels.weak.name=a_vessel_of_24_letters-1
says 'vessel a_vessel_of_24_letters-1 is at' err
! built_with cairo || python3 "$FRAM_SOURCE/tests/cli/pixels.py" apart two/station-box.png || fail "two/station-box.png"

# A table of a scenario in another folder is named with that folder, its line and its key.
mkdir tables
printf 'angle[deg],cx,cy,cn\n0,1,0,0\n90,0,1,0\n80,0,1,0\n180,-1,0,0\n' >tables/hull.csv
cat >tables/scene.yaml <<'END'
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 12, draught: 4, freeboard: 2}
  wind_coefficients: {table_file: hull.csv}
ice: {source: none}
domain: {boundary: open}
END
expect 2 "$FRAM" run tables/scene.yaml -o refused
says 'tables/hull.csv:4: vessel.wind_coefficients.table_file: expected a larger angle' err

# So is the table of a line.
printf 'offset[m],tension[N]\n\n-20,1e5\n0,3e5\n-1,6e5\n' >line.csv
expect 2 "$FRAM" run "$scratch/scene.yaml" -o refused
says 'line.csv:5: offset: expected more metres than in the point before, found -1' err

# Offsets are compared of who may keep a place, by a program too, and of no ship under way.
for wind in 0 10; do
    expect 0 "$FRAM" run "$FRAM_SOURCE/scenes/free_vessel.yaml" -o "free$wind" -q --set run.duration=2 \
        --set run.transient=0.5 --set environment.wind_speed=$wind
    expect 0 "$FRAM" run "$FRAM_SOURCE/scenes/demo.yaml" -o "under_way$wind" -q --set run.duration=2 \
        --set run.transient=0.5 --set ice.source=none --set environment.wind_speed=$wind
done
expect 0 "$FRAM" compare free0 free10
says 'offset along X, standard deviation' out
expect 0 "$FRAM" compare under_way0 under_way10
grep 'offset' out && fail "offsets of a ship under way"

finish "events on station are named"
