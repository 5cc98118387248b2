#!/usr/bin/env bash
# The contract of --json: whatever is asked, wherever the word stands, standard output ends with one JSON object; that
# of an error says what is wrong and where: a key (an option, a member, a word) or a file.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
run: {duration: 1, time_step: 0.1}
vessel:
  mode: towed
  x: -20
  speed: 1
  hull: {form: box, length: 20, beam: 8, draught: 2, freeboard: 2}
ice: {mean_floe_area: 64}
domain: {x_min: -40, x_max: 40, y_min: -20, y_max: 20}
output: {frame_interval: 0.1}
YAML
printf '0 0\n10 0\n10 10\n0 10\n' >outline.txt
expect 0 "$FRAM" run scene.yaml -o run -q
# object CODE WORDS...: the command ends with this code; its answer is kept for the check at the end.
object() {
    local wanted=$1
    shift
    expect "$wanted" "$FRAM" "$@"
    printf '%s\t%s\t%s\n' "$wanted" "fram $*" "$(tail -n 1 out)" >>answers
}

# Every command and form that goes well.
object 0 --json --help
object 0 --version --json
object 0 help --json
object 0 --json run scene.yaml -o first
object 0 -q --json run scene.yaml -o second
same "$(value 'j["folder"], j["finished"]')" "second True" "a run whose options stand before it"
object 0 resume run --json -q
object 0 check --json scene.yaml
object 0 --json check scene.yaml --build
object 0 keys --json
object 0 bench scene.yaml --warm 0.1 --time 0.2 -q --json
object 0 export run --vtk --json -q
object 0 export run --geojson --time 0.5 --json -q
object 0 report run --json -q
object 0 plot run --json
same "$(value 'j["channels"][0]["name"], j["channels"][0]["unit"], len(j["channels"]) > 100')" "time s True" "channels"
object 0 compare run first --json -q
object 0 field scene.yaml --json
object 0 field outline.txt --json
object 0 hull --length 50 --beam 10 --draught 3 --json
# Numbers whose names have no unit have it beside them, but for counts and pure numbers.
python3 -S - "$FRAM" <<'PY' || fail "numbers without units"
import json, subprocess, sys
PURE = {"peak", "peaks", "bodies", "floe", "bendings_before", "splits_before", "links", "after", "windows",
        "concentration", "managed", "unbroken", "tension_line", "factor", "slenderness"}
def walk(found, units, above=()):
    for name, value in found.items():
        names = (*above, name)
        for each in value if isinstance(value, list) else [value]:
            if isinstance(each, dict):
                walk(each, units, names)
            elif isinstance(each, (int, float)):
                assert name in PURE or any(n in units for n in names), (names, units)
for words in ("why run --time 1", "manage run", "manage run --beside first",
              "ice break --force 1e5", "ice split"):
    told = subprocess.run([sys.argv[1], *words.split(), "--json", "-q"], capture_output=True, text=True, check=True)
    found = json.loads(told.stdout.splitlines()[-1])
    units = found.pop("units")
    assert set(units.values()) <= {"m", "s", "N", "Pa"}, units
    walk(found, units)
PY
for what in wedge sheet; do object 0 ice $what --a-over-l 0.1 --json; done
object 0 ice break --force 1e5 --json
printf 'scenario: scene.yaml\nset: {run.duration: 0.2}\nseeds: 2\nvary: {grid: {vessel.speed: [1, 2]}}\n' >study.yaml
object 0 study check study.yaml --json
object 0 study study.yaml -o studied --json -q
object 0 study list studied --json
# People are told the loads of all conditions in one unit, that of the largest, and without exponents.
printf 'scenario: scene.yaml\nset: {run.duration: 4, vessel.speed: 5}\nseeds: 2\n' >wide.yaml
echo 'vary: {grid: {ice.crushing_strength: [1, 1e10]}}' >>wide.yaml
expect 0 "$FRAM" study wide.yaml -o wide -q
expect 0 "$FRAM" study list wide
python3 - <<'PY' || fail "loads of a list: $(cat out)"
import re
found = re.findall(r" ([0-9.]+) \+- ([0-9.]+) ([kM]?N) +([0-9.]+) ([kM]?N)  ", open("out").read())
loads = [float(f[3]) for f in found]
assert len(found) == 2 and len({f[2] for f in found} | {f[4] for f in found}) == 1, found
assert max(loads) > 1e3 * min(loads), found
PY
object 0 extremes run --json
object 0 fatigue run --json
object 0 why run --time 0.5 --json -q
object 0 pressure run -o pressed --json -q
object 0 manage run --json -q
object 0 fmu scene.yaml -o unit.fmu --json
for command in run resume check bench study extremes fatigue fmu view export report plot why pressure compare manage \
    video capability hull field ice keys; do
    object 0 --json $command --help
    object 2 $command --json --no-such-option
    object 2 $command --json ''
done
object 0 run --help --json
object 2 run scene.yaml --json --threads
object 2 run scene.yaml --json --threads=0
object 2 run --json --isa= scene.yaml
object 2 --json run one two --
if "$FRAM" --version | grep -q cairo; then
    object 0 plot run time -o time.svg --json
    object 0 video run --pictures -o frames --fps 1 --speed 1 --width 640 --height 480 --json
    object 0 hull --length 50 --beam 10 --draught 3 --draw hull.png --json
fi

# What is refused.
object 2 --json
object 2 --json ''
object 2 --json sail
object 2 run scene.yaml --json
object 2 run scene.yaml -o '' --json
object 2 run scene.yaml -o run --json
object 2 run scene.yaml --output= --json
object 2 run scene.yaml -o third --set '' --json
object 2 run scene.yaml -o third --set ice --json
object 2 run scene.yaml -o third --set =3 --json
object 2 run scene.yaml -o third --until soon --json
object 2 run no.yaml -o third --json
object 2 resume no --json
object 2 check . --json
object 2 plot run --json no_such_channel -o a.png
object 2 plot run --json time
object 2 plot run --json time -o run/series.csv
object 2 compare run no --json
object 2 export run --json
object 2 export run --json --geojson --time 99
object 2 export run --json --vtk --every 0
object 2 video run --json --colour red
object 2 video run --json --fps 0
object 2 view run --json --page scene.yaml
object 2 bench --json
for words in check list; do object 2 study $words --json; done
object 2 study scene.yaml -o no --json
object 2 extremes run --json --level 2
object 2 extremes run --json --duration nan
object 2 fatigue run --json --slope nan
object 2 why run --json --peak 0
object 2 pressure run --json -o no --panel nan
object 2 manage run --json --limit nan
object 2 fmu scene.yaml --json -o unit.fmu --binary scene.yaml
object 2 bench --json --scene scene.yaml
object 2 capability scene.yaml --json -o out.d
object 2 hull scene.yaml --json
object 2 hull --json
object 2 field outline.txt --json --cell 2
object 2 field outline.txt --json --cover a.png --cell 1e9
object 2 ice melt --json
object 2 ice wedge --json
object 2 ice wedge --a-over-l 99 --json
object 1 run scene.yaml -o third -q --set run.speed_limit=0.01 --set vessel.mode=free --set vessel.speed=0 \
    --set vessel.mass=2.5e5 --json
if [ -e '' ] || [ -e third/../=3 ]; then fail "a refused word became a file"; fi

# A word after -- is no option.
expect 2 "$FRAM" check -- --json
[ ! -s out ] || fail "a file of the name --json is taken for the option"
says '--json: cannot read' err

# Each is one object; that of bad input names its place, in members that the README tells.
python3 - "$FRAM_SOURCE/README.md" <<'END' || fail "the answers above"
import json
import sys

told = open(sys.argv[1], encoding="utf-8").read()
wrong = 0
for line in open("answers", encoding="utf-8"):
    wanted, words, answer = line.rstrip("\n").split("\t")
    try:
        answer = json.loads(answer)
        if wanted == "0":
            assert answer and "error" not in answer
            continue
        error = answer["error"]
        assert error["status"] and error["message"]
        assert wanted != "2" or error["key"] or error["file"]
        assert all(f"`{name}`" in told for name in error)
    except (ValueError, AssertionError, KeyError, TypeError):
        print(f"{words}: {answer}")
        wrong += 1
assert wrong == 0
END

finish "JSON is kept"
