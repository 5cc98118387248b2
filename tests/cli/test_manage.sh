#!/usr/bin/env bash
# fram manage on ice of known sizes that drifts past known places.
. "$FRAM_SOURCE/tests/cli/common.sh"

# A ship of 40 x 10 m at the origin; ice comes from +x at 0.5 m/s: floes of 3 x 3 and 8 x 8 m near it, one of 30 x 8 m
# far off, one aside that counts nowhere.  A tender lies beside the corridor and touches nothing.
cat >scene.yaml <<'YAML'
title: Known ice
run: {duration: 8, time_step: 0.02}
vessels:
  - name: ship
    mode: towed
    hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  - name: tender
    mode: towed
    x: 48
    y: 14
    hull: {form: box, length: 20, beam: 4, draught: 2, freeboard: 2}
    propulsion: {bollard_pull: auto}
ice:
  source: floes
  thickness: 1
  floes:
    - {length: 3, width: 3, x: 26, velocity_x: -0.5}
    - {length: 8, width: 8, x: 38, velocity_x: -0.5}
    - {length: 30, width: 8, x: 150, velocity_x: -0.5}
    - {length: 50, width: 50, x: 100, y: 60, velocity_x: -0.5}
domain: {x_min: -100, x_max: 300, y_min: -100, y_max: 100, boundary: open}
environment: {water: false}
output: {frame_interval: 1}
YAML
"$FRAM" run scene.yaml -o both -q
"$FRAM" run scene.yaml -o alone -q --set vessels.tender.present=false

# number EXPRESSION WANTED: of the JSON object in out, to 1e-6.
number() {
    python3 - "$1" "$2" <<'PY' || fail "fram manage: a number is wrong"
import json, sys

j = json.load(open("out"))
found, wanted = eval(sys.argv[1]), float(sys.argv[2])
sys.exit(0 if abs(found - wanted) <= 1e-6 * abs(wanted) else f"{sys.argv[1]} is {found}, expected {wanted}")
PY
}

# At t the 8 m floe has 6 + t/2 of its 8 m, at most all, in the window of 20 x 10 m before the bow; the 3 m floe is all
# in it: 9 + 536/9 m2 of 200 on average of nine frames.
expect 0 "$FRAM" manage alone --limit 5 --depth 20 --json -q
number "j['run']['at_vessel']['windows']" 9
number "j['run']['at_vessel']['concentration']" "$(python3 -c 'print((9 + 536 / 9) / 200)')"
number "j['run']['at_vessel']['managed']" "$(python3 -c 'print(9 / (9 + 536 / 9))')"
number "j['run']['at_vessel']['largest']" "$(python3 -c 'from math import *; print(sqrt(256 / pi))')"
number "j['run']['unmanaged_comes_in_least']" 20
number "j['run']['unmanaged_comes_in_median']" 24
number "j['run']['largest_unmanaged_comes_in_least']" 222
# The page hides no more of it than a sixtieth.
says "<td>3 min 42 s</td>" alone/manage.html
# Nobody worked on it: upstream is the same ice at the start, where it had all that it has at the vessel.
number "j['run']['upstream']['windows']" 8
number "j['run']['behind']['windows']" 0
number "j['run']['upstream']['concentration']" "$(python3 -c 'print((9 + (52 + 56 + 60 + 5 * 64) / 8) / 200)')"

# People are told the numbers that programs are, each under its head.
cp out told.json
expect 0 "$FRAM" manage alone --limit 5 --depth 20 -q
python3 - <<'PY' || fail "the table of fram manage"
import json, re
j, text = json.load(open("told.json"))["run"], open("out").read()
for words, key in (("upstream", "upstream"), ("at the vessel", "at_vessel")):
    row = [float(x.rstrip("%")) for x in re.search(rf"^{words} +(.*)$", text, re.M)[1].split()]
    place = j[key]
    wanted = [place["windows"], place["concentration"], 100 * place["managed"], 100 * place["unbroken"],
              place["mean_size"], place["largest"]]
    assert len(row) == 6 and all(abs(a - b) <= 0.006 * max(1, b) for a, b in zip(row, wanted)), (row, wanted)
for words, key in (("nearest", "unmanaged"), ("largest", "largest_unmanaged")):
    least, median = re.search(rf"until the {words} .* median +(\S+) s +(\S+) s", text).groups()
    assert [float(least), float(median)] == [j[f"{key}_comes_in_least"], j[f"{key}_comes_in_median"]], text
assert len({place["managed"], place["unbroken"], place["concentration"]}) == 3, place
PY

# The tender is within reach of the ice until its window's middle is 2.1 m before its place at the bow (a half diagonal
# and half a length, 21.2 m, from it): ice that comes in the first 4 s it never reaches, the rest has been behind it.
expect 0 "$FRAM" manage both --vessel ship --limit 5 --depth 20 --json -q
number "j['run']['upstream']['windows']" 4
number "j['run']['behind']['windows']" 4
number "j['run']['behind']['concentration']" "$(python3 -c 'print(73 / 200)')"

# One that keeps a station beside it is no icebreaker: moored, or under positioning that leads it nowhere.
sed '/name: tender/,/propulsion:/{s/mode: towed/mode: free/;s/propulsion: .*/@/}' scene.yaml >kept.yaml
springs='mooring: {lines: [{kind: spring, count: 4, spacing_deg: 90, distance: 90, pretension: 1, stiffness: 1}]}'
units='thrusters: [{x: 9, thrust: 1}, {x: -9, thrust: 1}]'
for keeps in "$springs" "$units\n    positioning: {active: true}"; do
    sed "s/@/$keeps/" kept.yaml >beside.yaml
    expect 0 "$FRAM" run beside.yaml -o beside -q --force
    expect 0 "$FRAM" manage beside --vessel ship --limit 5 --depth 20 --json -q
    number "j['run']['upstream']['windows']" 8
    number "j['run']['behind']['windows']" 0
done

# Across the drift, with its mass 8 m aft: the window lies before the whole hull, and a floe is in it that is 12 to 20 m
# aside, forward.
expect 0 "$FRAM" run scene.yaml -o across -q --set vessels.tender.present=false --set vessels.ship.heading_deg=90 \
    --set vessels.ship.centre_of_gravity_x=-8 --set 'ice.floes[1].y=16' --set run.duration=4
expect 0 "$FRAM" manage across --limit 5 --depth 40 --json -q
number "j['run']['at_vessel']['concentration']" "$(python3 -c 'print((9 + 64) / 1600)')"
number "j['run']['unmanaged_comes_in_least']" 54

# Without a drift the ice comes by the vessel's own way: of one that positioning leads, and one whose lines are gone.
cat >led.yaml <<'YAML'
run: {duration: 2, time_step: 0.02, transient: 0.5}
vessel:
  mode: free
  speed: 1
  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  hydrodynamics: {source: estimate}
  @
ice: {source: none}
domain: {x_min: -300, x_max: 300, y_min: -300, y_max: 300, boundary: open}
output: {frame_interval: 0.5}
YAML
line="kind: spring, distance: 90, pretension: 1, stiffness: 1, release_time: 1.1"
let_go="mooring: {equilibrium: false, lines: [{$line}]}"
goes="positioning: {active: true, waypoints: [{time: 0.1, x: 50}]}"
for case in "0 $units\n  positioning: {active: true}" "3 $units\n  $goes" "2 $let_go"; do
    sed "s/@/${case#* }/" led.yaml >goes.yaml
    expect 0 "$FRAM" run goes.yaml -o goes -q --force
    expect 0 "$FRAM" manage goes --json -q
    number "j['run']['at_vessel']['windows']" "${case%% *}"
done

# A window of 2.2 m before the bow has no ice until the floe of 3 m, 4.5 m off at the start, has come into it at 4.6 s.
expect 0 "$FRAM" manage alone --limit 5 --depth 2.2 --json -q
number "j['run']['first_ice_at_time']" 5
expect 0 "$FRAM" manage alone --limit 5 --depth 2.2 -o late.html -q
says "no ice before the vessel until 5 s, which the means count: give run.transient 5" out
says "No ice was before the vessel until 5 s" late.html
if built_with cairo; then says "The field at the end" late.html; fi

# The floe of 3 m is at the bow at 9 s: the largest load of a run of 9.4 s comes after its last frame.
expect 0 "$FRAM" run alone/scenario.yaml -o behind --set run.duration=9.4 -q
expect 0 "$FRAM" manage behind --limit 5 -q
if built_with cairo; then says "The field when the ice load was largest" behind/manage.html; fi

# Floes count as managed up to the beam, which a hull from a file has of its own.
expect 0 "$FRAM" hull --box --length 40 --beam 10 --draught 4 --freeboard 2 -o ship.stl -q
expect 0 "$FRAM" run scene.yaml -o filed -q --set vessels.ship.hull.form=file \
    --set vessels.ship.hull.file="$PWD/ship.stl" --set vessels.ship.hull.beam=20
for run in both filed; do
    expect 0 "$FRAM" manage $run --vessel ship --json -q
    number "j['run']['limit']" 10
done

# A run that was stopped before its transient ended has no load to tell.
expect 0 "$FRAM" run alone/scenario.yaml -o early --set run.transient=3 --until 2 -q
expect 0 "$FRAM" manage early -q
says "ice load not known: the run ends before run.transient" out

# The page and its tables, also of two runs beside each other.
# Windows without ice have a concentration, and no shares of the ice nor sizes.
expect 0 "$FRAM" manage both --vessel tender --limit 5 --depth 2 -q
holds "at the vessel  *[0-9][0-9]*  *0.000  *-  *-  *-  *-$" out
expect 0 "$FRAM" manage both --vessel ship --limit 50 --depth 20 -o all.html
says "No unmanaged ice was on its way" all.html
python3 - <<'END' || fail "all.csv or all-sizes.csv"
import csv
for row in csv.DictReader(open("all.csv")):
    for place in ("upstream", "behind", "at_vessel"):
        ice = float(row[place + "_concentration[1]"] or "nan")
        assert not ice > 0 or float(row[place + "_managed[1]"]) == 1, ("shares are of the ice", row)
rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open("all-sizes.csv"))]
assert [row["sheet[1]"] for row in rows] == [0] * (len(rows) - 1) + [1], rows
assert abs(sum(row["at_vessel[1]"] for row in rows) - 1) < 1e-9, rows
END
expect 0 "$FRAM" manage both --vessel ship --beside alone --limit 5 --depth 20 -o page.html
says "At its nearest, unmanaged ice was" page.html
says "comparison run" out
for file in page.html page.csv page-sizes.csv; do [ -s "$file" ] || fail "$file is missing"; done
# Beside it may stand the unit alone without a name, but none that has no such vessel, or several.
sed '/name: tender/,/propulsion:/d; s/^vessels:/vessel:/; /name: ship/d; s/^    \(mode\|hull\)/  \1/' \
    scene.yaml >unnamed.yaml
expect 0 "$FRAM" run unnamed.yaml -o unnamed -q
expect 0 "$FRAM" manage both --vessel ship --beside unnamed --limit 5 --depth 20 --json -o page.html
number "j['beside']['at_vessel']['windows']" 9
expect 2 "$FRAM" manage both --vessel tender --beside alone -o page.html
says "alone: --beside: expected a run with the vessel that is protected, \"tender\", found one without it" err
expect 2 "$FRAM" manage alone --beside both -o page.html
says "both: --beside: several vessels do not drive themselves: name the one that is protected" err
expect 0 "$FRAM" run unnamed.yaml -o dry -q --set vessel.present=false --set run.duration=1
expect 2 "$FRAM" manage alone --beside dry -o page.html
says "dry: --beside: expected a run with the vessel that is protected, found one without any vessel" err
expect 2 "$FRAM" manage unnamed --vessel ship -o page.html
says "unnamed: --vessel: expected the name of a vessel" err
grep -q "Ice management for ship" page.html || fail "the page has another title"
head -1 page.csv | grep -q "at_vessel_managed\[1\],.*unmanaged_comes_in\[s\]" || fail "page.csv has other columns"
[ "$(wc -l <page-sizes.csv)" -eq 13 ] || fail "page-sizes.csv has not a row a class"

# The whole of what came is in its classes.
python3 - <<'PY' || fail "shares of the classes do not add up"
import csv
rows = list(csv.reader(open("page-sizes.csv")))[1:]
assert abs(sum(float(r[4]) for r in rows) - 1) < 1e-9
PY

# A table that finds no room is told; the page is whole by then.
ln -s /dev/full sunk.csv
expect 1 "$FRAM" manage both --vessel ship --limit 5 --depth 20 -o sunk.html -q
says "sunk.csv" err
holds "</html>" sunk.html
same "$(ls sunk*)" "sunk.csv
sunk.html" "files after a table that found no room"

# Fatigue of lines: tensions that are written by hand into a run, the second line between 0 and 1 kN from value to
# value, the first half as far; beside it a run of half the range, that is an eighth of the damage.
cat >moored.yaml <<'YAML'
run: {duration: 2, time_step: 0.02, transient: 0.5}
vessel:
  mode: free
  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
  hydrodynamics: {source: estimate}
  mooring: {lines: [{count: 2, spacing_deg: 180, distance: 200, pretension: 2.0e5}]}
ice: {source: none}
domain: {x_min: -300, x_max: 300, y_min: -300, y_max: 300, boundary: open}
output: {frame_interval: 1, csv_interval: 0.1}
YAML
for run in full half; do
    "$FRAM" run moored.yaml -o "$run" -q
    python3 - "$run" <<'PY'
import csv, sys
path = sys.argv[1] + "/series.csv"
rows = list(csv.reader(open(path)))
columns = [next(i for i, n in enumerate(rows[0]) if n.startswith(f"line_{k}_tension")) for k in (1, 2)]
columns.append(next(i for i, n in enumerate(rows[0]) if n.startswith("line_tension_max")))
for i, row in enumerate(rows[1:]):
    for part, column in zip((0.5, 1, 1), columns):
        row[column] = repr((1000.0 if sys.argv[1] == "full" else 500.0) * part * (i % 2))
csv.writer(open(path, "w"), lineterminator="\n").writerows(rows)
PY
done
expect 0 "$FRAM" manage full --json -q
# Values from 0.6 to 2 s: 15, so 14 half cycles in 1.5 s.
number "j['run']['tension_range_equivalent']" "$(python3 -c 'print(1000 * (7 / 1.5) ** (1 / 3))')"
number "j['run']['tension_line']" 2
expect 0 "$FRAM" manage full --beside half
says "fatigue of line 2" out
# Under 10 kN all is told in newtons.
says "line tension 1000 N at most" out
says '<th scope="row">largest line tension [N]</th>' full/manage.html
says '<th scope="row">mean horizontal ice load [kN]</th>' full/manage.html
grep -q "takes 8 times the damage" full/manage.html || fail "the page does not compare the damages"

# A vessel that met the sheet alone: no loose floe came.
cat >sheet.yaml <<'YAML'
run: {duration: 3, time_step: 0.05}
vessel: {mode: prescribed, hull: {length: 20, beam: 6, draught: 2}}
ice: {source: level, thickness: 0.2, level: {openings: [{x: 0, y: 0, length: 21, width: 8}]}}
domain: {boundary: feeding, drift_speed: 0.6, drift_direction_deg: 180, x_min: -30, x_max: 60, y_min: -20, y_max: 20}
output: {frame_interval: 0.5}
YAML
expect 0 "$FRAM" run sheet.yaml -o sheet -q
expect 0 "$FRAM" manage sheet -q
grep -q "No loose floe reached it" sheet/manage.html || fail "the page does not say that no floe came"
grep -qw "nan" sheet/manage.html && fail "the page tells a time of nothing"
grep -q "Managed ice at the vessel" sheet/manage.html || fail "the page does not draw what reached the vessel"
# In open water there is nothing to draw: no charts with made-up axes.
expect 0 "$FRAM" run sheet.yaml -o clear -q --set run.duration=1 --set 'ice.level.openings[0].length=50' \
    --set 'ice.level.openings[0].width=20'
expect 0 "$FRAM" manage clear -q
grep -q "No ice came to the vessel" clear/manage.html || fail "the page does not say that no ice came"
grep -qE 'Floe sizes|Managed ice at the vessel' clear/manage.html && fail "the page has charts of nothing"

# A model of 1:150 has the windows of full size, and times of its own scale: also where its ice comes at 4 mm/s, and the
# ship goes twice as fast after a minute of full size.
python3 - <<'PY'
for name, k in (("whole", 1), ("tank", 1 / 150)):
    t = k ** 0.5
    path = ", ".join(f"{{time: {60 * i * t!r}, x: {x * k!r}}}" for i, x in enumerate((0, 3, 9)))
    open(name + ".yaml", "w").write(f"""
run: {{duration: {120 * t!r}, time_step: {t / 4!r}, scale: {30 * k!r}}}
vessel:
  mode: towed
  hull: {{form: box, length: {40 * k!r}, beam: {10 * k!r}, draught: {4 * k!r}, freeboard: {2 * k!r}}}
  path: [{path}]
ice: {{source: floes, thickness: {k!r}, floes: [{{length: {30 * k!r}, width: {8 * k!r}, x: {150 * k!r}}}]}}
domain: {{x_min: {-100 * k!r}, x_max: {200 * k!r}, y_min: {-50 * k!r}, y_max: {50 * k!r}, boundary: open}}
environment: {{water: false}}
output: {{frame_interval: {10 * t!r}}}
""")
PY
for run in whole tank; do
    expect 0 "$FRAM" run $run.yaml -o $run -q
    expect 0 "$FRAM" manage $run --json -q
    mv out $run.json
done
python3 - <<'PY' || fail "a model has other results than full size"
import json
whole, tank = (json.load(open(name + ".json"))["run"] for name in ("whole", "tank"))
assert whole["at_vessel"]["windows"] == tank["at_vessel"]["windows"] == 13, (whole, tank)
for key in ("unmanaged_comes_in_least", "unmanaged_comes_in_median"):
    assert 0 < whole[key] < 3000 and abs(tank[key] * 150 ** 0.5 / whole[key] - 1) < 1e-4, (key, whole[key], tank[key])
assert f"<td>{tank['unmanaged_comes_in_least']:.3g} s</td>" in open("tank/manage.html").read(), tank
PY

# Names of tables that are longer than the file system takes are told, and no file of the three is written.
long=$(printf '%248s' '' | tr ' ' m)
expect 2 "$FRAM" manage alone -o "$long.html" --json
same "$(value 'j["error"]["file"]')" "$long.html" "the page whose table has too long a name"
says "a file named after it would have one of 258 bytes" err
same "$(compgen -G 'mmm*')" "" "files of a page with too long a name"

# What cannot be told is refused.
expect 2 "$FRAM" manage
expect 2 "$FRAM" manage nowhere
expect 2 "$FRAM" manage both
says "--vessel: several vessels do not drive themselves: name the one that is protected" err
expect 2 "$FRAM" manage both --vessel nobody
says "nobody" err
expect 2 "$FRAM" manage both --vessel ship --limit -1
expect 2 "$FRAM" manage both --vessel ship --beside nowhere
expect 2 "$FRAM" manage both --vessel ship -o both/run.json
# Tables are named after the page, and would be written over the series of either run, or over the page.
expect 2 "$FRAM" manage both --vessel ship -o both/series.html
says "both/series.csv: --output: expected a file of its own, found one that the run is made of" err
expect 2 "$FRAM" manage both --vessel ship --beside alone -o alone/fractures.html
head -1 alone/fractures.csv | grep -q '^time' || fail "a run lost its fractures"
expect 2 "$FRAM" manage both --vessel ship -o table.csv
says "--output: expected a page's name that ends in .html or .htm" err
[ ! -e table-sizes.csv ] || fail "a page that is its own table was written"
expect 0 "$FRAM" manage --help
says "Examples:" out
finish "ice management: known floes, windows and times"
