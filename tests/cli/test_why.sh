#!/usr/bin/env bash
# fram why: a ship that is driven by thrusters and current against three floes and a wall has a chain of three floes to
# the wall, which the command finds; moments and refusals; JSON; nothing in the folder changes.
. "$FRAM_SOURCE/tests/cli/common.sh"
printf 'time[s],x[m/s],y[m/s]\n20,0,0\n' >calm.csv
cat >chain.yaml <<'YAML'
run: {duration: 12, time_step: 0.02, transient: 2}
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}
  hydrodynamics: {source: none}
environment: {current_speed: 2, wind_file: calm.csv}
domain: {boundary: walls, x_min: -60, x_max: 44.02, y_min: -40, y_max: 40}
ice:
  source: floes
  crushing_strength: 1.0e9
  floes:
    - {x: 24.005, y: 0, length: 8, width: 8}
    - {x: 32.005, y: 0, length: 8, width: 8}
    - {x: 40.005, y: 0, length: 8, width: 8}
output: {checkpoint_interval: 4, frame_interval: 1}
YAML
expect 0 "$FRAM" run chain.yaml -o run --quiet
find run -type f -exec cksum {} + | sort >before
picture=()
! built_with cairo || picture=(-o peak.png)
expect 0 "$FRAM" why run --peak 1 "${picture[@]}"
same "$(grep -c "the first row of" err)" 1 "warnings of a run that is computed four times"
find run -type f -exec cksum {} + | sort >after
cmp -s before after || fail "fram why changes the run's folder"
says "Peak 1 of" out
says "a chain of floes against" out
holds 'hull -> floe 0 (.*) -> floe 1 (.*) -> floe 2 (.*) -> wall (.*); the end: it is a wall' out
says "half the time step" out
says "the accurate solver" out
! built_with cairo || [ "$(head -c 4 peak.png | tail -c 3)" = PNG ] || fail "peak.png is no picture"
if built_with cairo; then
    expect 0 "$FRAM" why run --peak 1 --no-rerun -o peak.svg
    says "<svg " peak.svg
    holds "</svg>" peak.svg
    # The same hull from a file makes the same picture: it shows the hull as long as it is, whatever its keys say.
    expect 0 "$FRAM" hull --box --length 40 --beam 20 --draught 4 --freeboard 3 -o box.stl -q
    sed 's/hull: {form: box.*/hull: {form: file, file: box.stl}/' chain.yaml >filed.yaml
    expect 0 "$FRAM" run filed.yaml -o filed --quiet
    expect 0 "$FRAM" why filed --peak 1 --no-rerun -o filed.svg
    cmp -s peak.svg filed.svg || fail "the picture of a peak goes by the default length of a hull from a file"
fi

# As JSON: the parts sum to the load, by zone too; computed again by the same method it is the same.
expect 0 "$FRAM" why run --peak 1 --json
same "$(value "abs(sum(j['mechanisms'].values()) / j['load'] - 1) < 1e-5")" True "sum of the mechanisms"
same "$(value "abs(sum(sum(z.values()) for z in j['zones'].values()) / j['load'] - 1) < 1e-5")" True "sum of the zones"
same "$(value "[l['floe'] for l in j['floes'][0]['chain']]")" "[0, 1, 2, -1]" "chain"
same "$(value "j['floes'][0]['end']")" wall "end of the chain"
same "$(value "abs(j['computed_again']['same'] / j['load'] - 1) < 1e-6")" True "load computed again"
same "$(value "j['computed_again']['from'] > 0 or j['time'] < 6")" True "nearest checkpoint"
time=$(value "j['time']")
load=$(value "j['load']")

# A window that is no whole number of steps is as long with half the step: a blow of less than that has the same mean.
cat >blow.yaml <<'YAML'
run: {duration: 12, time_step: 0.1, transient: 0}
vessel: {mode: prescribed, x: -20, speed: 1, hull: {form: box, length: 30, beam: 10, draught: 3, freeboard: 3}}
domain: {x_min: -60, x_max: 100, y_min: -40, y_max: 40, boundary: open}
ice:
  source: floes
  thickness: 0.8
  crushing_strength: 5.0e7
  floes: [{x: 5.23, length: 10, width: 10}]
output: {averaging_window: 0.25}
YAML
expect 0 "$FRAM" run blow.yaml -o blow --quiet
expect 0 "$FRAM" why blow --peak 1 --json
same "$(value "abs(j['computed_again']['half_step'] / j['load'] - 1) < 0.05")" True "a blow with half the step"

# A larger peak of the transient, less than four windows before, takes no place.
cat >settled.yaml <<'YAML'
run: {duration: 3, time_step: 0.02, transient: 1}
vessel: {mode: prescribed, x: -20, speed: 1, hull: {form: box, length: 30, beam: 10, draught: 3, freeboard: 3}}
domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40, boundary: open}
ice:
  source: floes
  floes: [{x: -2.5, y: 2.5, length: 4, width: 4}, {x: -2.2, y: -3, length: 2, width: 2}]
YAML
expect 0 "$FRAM" run settled.yaml -o settled --quiet
expect 0 "$FRAM" why settled --peak 1 --no-rerun --json
same "$(value "1.7 < j['time'] < 2.5 and j['floes'][0]['floe'] == 1")" True "a peak beside one of the transient"
expect 2 "$FRAM" why settled --time 2.9 --no-rerun
says "contacts are kept of the largest peak, and 2.9 s is not at it; name that peak, or let the moment" err

# A moment: at the peak it is the recorded one; elsewhere it is computed again, or refused.
expect 0 "$FRAM" why run --time "$time" --json
same "$(value "j['peak']")" 1 "peak at its time"
expect 0 "$FRAM" why run --time 3.5 --json
same "$(value "j['peak'] == 0 and abs(j['time'] - 3.5) < 1e-9 and abs(j['load']) < 2 * $load")" True "moment"
expect 2 "$FRAM" why run --time 3.5 --no-rerun
says "computed again" err
expect 0 "$FRAM" why run --peak 1 --no-rerun --json
same "$(value "j['computed_again']")" None "not computed again"

# Refusals.
expect 2 "$FRAM" why run
says "--peak: is missing" err
expect 2 "$FRAM" why run --peak 1 --time 3
says "--time: does not go with --peak" err
expect 2 "$FRAM" why run --peak 0
says "--peak: needs a whole number above zero" err
expect 2 "$FRAM" why run --peak -2147483648
says "--peak: needs a whole number above zero" err
expect 2 "$FRAM" why run --peak 99999999999
says "--peak: needs a whole number from 1 to 2147483647" err
expect 2 "$FRAM" why run --peak 1 -o peak.pdf
says "ends in .png or .svg" err
[ ! -e peak.pdf ] || fail "a refused picture is there"
expect 2 "$FRAM" why run --peak -1
expect 2 "$FRAM" why run --peak 11
says "expected 1, the largest" err
expect 2 "$FRAM" why run --time 100
says "up to 12 s" err
expect 2 "$FRAM" why run --time 0
expect 2 "$FRAM" why run --time -1
expect 2 "$FRAM" why run --peak 1 --vessel ship
says "the only one has none; found \"ship\"" err
expect 2 "$FRAM" why nowhere --peak 1
expect 2 "$FRAM" why chain.yaml --peak 1
expect 2 "$FRAM" why run --peak 1 -o run/series.csv

# Results that were cut short are told; a damaged checkpoint is passed over for the one before, or for the start.
cp -r run cut
for checkpoint in cut/checkpoint-*.fram; do head -c 3000 "$checkpoint" >short && mv short "$checkpoint"; done
head -n 3 run/series.csv >cut/series.csv
expect 0 "$FRAM" why cut --time 11
says "trying the one before" err
says "computing again from t = 0 s" err
says "series.csv holds no rows of that time" out
rm -r cut
# One that was killed has come as far as its series.
cp -r run killed
as_killed killed
expect 2 "$FRAM" why killed --time 3.5 --no-rerun
says "contacts are kept of the" err
expect 2 "$FRAM" why killed --time 100
says "up to 12 s, found 100" err
rm -r killed
# A run that is resumed at its end keeps the peaks that it has.
cp run/peaks.fram before.fram
expect 0 "$FRAM" resume run -q
cmp run/peaks.fram before.fram || fail "peaks of a finished run after a resume"
rm run/peaks.fram
expect 2 "$FRAM" why run --peak 1 --no-rerun
says "keeps no peaks" err
expect 2 "$FRAM" why run --time 3.5 --no-rerun
says "time: the run keeps no peaks of this vessel: let the moment be computed again" err
expect 0 "$FRAM" why run --time "$time" --json
same "$(value "abs(j['load'] / $load - 1) < 1e-6")" True "peak computed again without the file"
printf 'not peaks at all' >run/peaks.fram
for words in "--peak 1" "--time $time --no-rerun"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" why run $words
    says "peaks.fram: expected a record" err
done
expect 0 "$FRAM" why run --time "$time" --json
same "$(value "abs(j['load'] / $load - 1) < 1e-6")" True "peak computed again where the file is none"
expect 0 "$FRAM" run chain.yaml -o bare --quiet --set vessel.present=false
expect 2 "$FRAM" why bare --peak 1
says "no vessel" err

# Of several vessels the one that is named.
cat >two.yaml <<'END'
run: {duration: 4, time_step: 0.02, transient: 0}
vessels:
  - {name: tug, mode: towed, x: -10, speed: 1, hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}}
  - {name: barge, mode: towed, x: -10, y: 30, speed: 2,
     hull: {form: box, length: 20, beam: 8, draught: 3, freeboard: 2}}
ice:
  source: floes
  thickness: 0.5
  floes: [{length: 6, width: 6, x: 4}, {length: 6, width: 6, x: 4, y: 30}]
domain: {x_min: -60, x_max: 60, y_min: -60, y_max: 60, boundary: open}
END
expect 0 "$FRAM" run two.yaml -o two --quiet
expect 0 "$FRAM" why two --peak 1 --no-rerun --json
same "$(value "j['vessel'], j['floes'][0]['floe']")" "tug 0" "the first vessel and its floe"
expect 0 "$FRAM" why two --peak 1 --no-rerun --json --vessel barge
same "$(value "j['vessel'], j['floes'][0]['floe']")" "barge 1" "the named vessel and its floe"
expect 0 "$FRAM" why two --time 1 --vessel barge
says "Vessel barge. " out
# What broke is counted in the span before that five seconds of full size are.
says "In the 5 s before" out
expect 0 "$FRAM" run two.yaml -o tank --quiet --set run.scale=1
expect 0 "$FRAM" why tank --peak 1 --no-rerun
says "In the 0.913 s before" out
expect 2 "$FRAM" why two --peak 1 --vessel 2
says '--vessel: expected the name of a vessel, "tug", "barge"; found "2"' err
# A picture that cannot be is told before a moment is computed again.
expect 0 "$FRAM" run two.yaml -o frameless --quiet --set output.frame_interval=0
for words in "why frameless --time 1 -o moment.svg" "why two --time 1 -o nowhere/moment.svg"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words
    grep -q "computing again" err && fail "$words: computed again for a picture that cannot be: $(cat err)"
done
says "nowhere/moment.svg: cannot open for writing" err
# Nothing touched.
expect 0 "$FRAM" why two --time 0.1
says "No ice touched the vessel in the 0.5 s up to then." out
grep -q "no chain to follow" out && fail "nothing is told at length: $(cat out)"
# What the run was made of was changed: nothing is computed from something else.
cp two/scenario.yaml kept.yaml
sed 's/seed: 1 /seed: 7 /' kept.yaml >two/scenario.yaml
cmp -s kept.yaml two/scenario.yaml && fail "the scenario was not changed"
expect 2 "$FRAM" why two --time 1
says "was changed since the run was made" err
cp kept.yaml two/scenario.yaml
expect 0 "$FRAM" why two --time 1
printf '30 40\n36 40\n36 46\n30 46\n' >floes.txt
sed -e 's/source: floes/source: file/' -e 's/^  floes: .*/  file: floes.txt/' two.yaml >outlined.yaml
expect 0 "$FRAM" run outlined.yaml -o outlined --quiet
expect 0 "$FRAM" why outlined --time 1
printf '30 40\n36 40\n36 45\n30 45\n' >floes.txt
for words in "why outlined --time 1" "pressure outlined -o pressed"; do
    # shellcheck disable=SC2086
    expect 2 "$FRAM" $words
    says "floes.txt was changed since the run was made" err
done
finish "peaks explained, computed again, refused"
