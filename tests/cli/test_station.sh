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
  station: {offset_limit: 0.5, heading_limit_deg: 3}
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
python3 - "$scratch/run" <<'END' || fail "station.json"
import json, sys
j = json.load(open(sys.argv[1] + "/station.json"))
kinds = [e["kind"] for e in j["events"]]
for kind in ("line_break", "line_release", "thruster_failure", "position_lost"):
    assert kind in kinds, (kind, kinds)
assert j["offset_m"]["exceedance"] > 0, "time beyond the limit"
assert max(j["offset_envelope_m"]) <= j["offset_m"]["peak"] + 1e-9, "envelope"
for key in ("mean", "significant", "peak"):
    assert key in j["line_tension_largest_N"] and key in j["ice_load_N"], key
# Beside the series itself, from the end of the transient on.
import csv
rows = [r for r in csv.DictReader(open(sys.argv[1] + "/series.csv")) if float(r["time[s]"]) >= 20]
turned = [float(r["heading_deviation[deg]"]) for r in rows]
share = sum(abs(d) > 3 for d in turned) / len(turned)
assert share > sum(d > 3 for d in turned) / len(turned), "nothing to tell the sides apart"
assert abs(j["heading_deviation_deg"]["exceedance"] - share) < 1e-12, (j["heading_deviation_deg"], share)
use = max(float(r["line_4_tension[N]"]) for r in rows) / 9.0e5
assert abs(j["lines"][3]["utilisation"] - use) < 1e-9, (j["lines"][3], use)
assert j["lines"][3]["mean"] < 0.99 * j["lines"][3]["peak"], "nothing to tell mean and peak apart"
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
printf 'offset[m],tension[N]\n-20,1e5\n0,3e5\n-1,6e5\n' >line.csv
expect 2 "$FRAM" run "$scratch/scene.yaml" -o refused
says 'line.csv:4: offset: expected more metres than in the point before, found -1' err

finish "events on station are named"
