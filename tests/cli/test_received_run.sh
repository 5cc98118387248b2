#!/usr/bin/env bash
# A run's folder that somebody sent is looked at: nothing outside of it is written, removed or shown.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
title: Received
run: {duration: 2, time_step: 0.02}
vessel:
  mode: towed
  x: -40
  speed: 2
  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}
ice:
  source: floes
  thickness: 1
  floes:
    - {length: 8, width: 8, x: -10}
domain: {x_min: -80, x_max: 80, y_min: -60, y_max: 60, boundary: walls}
environment: {water: false}
output: {frame_interval: 0.5, checkpoint_interval: 1, picture_interval: 1}
YAML
"$FRAM" run scene.yaml -o demo -q
echo "<html><!--BESIDE--><!--RECORD-->" >viewer.html

echo precious >notes.txt
cp notes.txt kept.txt
# received NAME...: a copy of the run in g, where each name is a link to the file outside.
received() {
    rm -rf g
    cp -r demo g
    for name; do ln -sfn "$PWD/notes.txt" "g/$name"; done
}
# untouched NAME...: the file outside is as it was, and no link is left of these names.
untouched() {
    cmp -s notes.txt kept.txt || fail "what a link led to was written over: $*"
    cp kept.txt notes.txt
    for name; do { [ -f "g/$name" ] && [ ! -L "g/$name" ]; } || fail "g/$name is no file of its own"; done
}

received report.html
expect 0 "$FRAM" report g -q
untouched report.html
received report.html
expect 0 "$FRAM" report g -o g/report.html -q
untouched report.html
received
ln -s nowhere/x.html g/report.html
expect 0 "$FRAM" report g -o g/report.html -q
untouched report.html
received playback.html
expect 0 "$FRAM" view g --page viewer.html -q
untouched playback.html
received manage.html manage.csv manage-sizes.csv
expect 0 "$FRAM" manage g -q
untouched manage.html manage.csv manage-sizes.csv
received two.html
expect 0 "$FRAM" compare g demo -o g/two.html -q
untouched two.html
if built_with cairo; then
    received x.svg
    expect 0 "$FRAM" plot g ice_force_x -o g/x.svg -q
    untouched x.svg
fi
# A pipe is nobody's page either: nothing waits for its other end.
received
mkfifo g/report.html
expect 0 timeout 20 "$FRAM" report g -q
untouched report.html

# A run that was stopped, and goes on here: what it writes in one go is new.
received
"$FRAM" run scene.yaml -o g --force -q --set run.duration=1
sed 's/duration: 1,*$/duration: 2/' g/scenario.yaml >longer && cp longer g/scenario.yaml
as_killed g
for name in run.json loads.png plan.png peaks.fram; do
    if [ -e "g/$name" ] && [ "$name" != run.json ]; then ln -sf "$PWD/notes.txt" "g/$name"; fi
done
"$FRAM" resume g -q >out 2>err || true
untouched run.json

# Folders of its own that are links: nothing is listed, written or removed behind them.
mkdir far far/data
for file in 0001.js run.pvd data/floes_000001.vtp plan-000001.00.png frame-000001.png; do echo mine >"far/$file"; done
(cd far && find . -type f | sort) >before
all_there() {
    (cd far && find . | sort && [ "$(cat run.pvd)" = mine ]) >after
    while read -r file; do [ -f "far/$file" ] || fail "$1: $file is gone from behind the link"; done <before
    [ "$(find far -type f | wc -l)" = "$(wc -l <before)" ] || fail "$1: files were written behind the link"
}
received
ln -s "$PWD/far" g/playback-frames
expect 2 "$FRAM" view g --page viewer.html --page-limit 0.0001 -q
says "expected a folder to write into, found a link" err
all_there view
received
ln -s "$PWD/far" g/vtk
expect 2 "$FRAM" export g --vtk -q
says "g/vtk" err
all_there "export into a link"
received
mkdir g/vtk
ln -s "$PWD/far/data" g/vtk/data
expect 2 "$FRAM" export g --vtk -q
says "g/vtk/data" err
all_there "export beside a link"
received
rm -rf g/pictures
ln -s "$PWD/far" g/pictures
ln -s "$PWD/far" g/vtk
ln -s "$PWD/far" g/video
ln -s "$PWD/far" g/playback-frames
expect 2 "$FRAM" run scene.yaml -o g --force -q
says "g/pictures" err
all_there "run --force"

# A study that goes on in a folder that was sent: tables, pages, rows and logs.
cat >study.yaml <<'YAML'
scenario: scene.yaml
seeds: {least: 1, most: 1}
vary: {grid: {vessel.speed: [1, 2]}}
keep: summary
YAML
expect 0 "$FRAM" study study.yaml -o st -q
rm st/runs/*/1.row
(cd st && ls summary.csv conditions.csv study.html conditions/*) >names
for folder in st/runs/*; do echo "runs/${folder##*/}/1.log"; done >>names
while read -r name; do ln -sf "$PWD/notes.txt" "st/$name"; done <names
expect 0 "$FRAM" study study.yaml -o st -q
cmp -s notes.txt kept.txt || fail "a study went through a link"
# Its folders are no links, nor the folders of its runs in them; its own may be one.
id=$(basename "$(echo st/runs/* | cut -d' ' -f1)")
for folder in runs conditions "runs/$id" "runs/$id/1"; do
    rm -rf away sent
    cp -r st sent
    if [ -e "sent/$folder" ]; then mv "sent/$folder" away; else mkdir away; fi
    touch away/mine.0123456789abcdef.new
    rm -f sent/runs/*/1.row
    ln -s "$PWD/away" "sent/$folder"
    find away >before
    expect 2 "$FRAM" study study.yaml -o sent -q
    says "sent/$folder: expected a folder to write into, found a link: remove it, or move it away" err
    find away | cmp -s - before || fail "a study wrote or removed through $folder"
done
rm -rf sent away
ln -s st sent
expect 0 "$FRAM" study study.yaml -o sent -q

# A link that a user names outside of the run is gone through, as ever.
received
ln -sf notes.txt mine.html
expect 0 "$FRAM" report g -o mine.html -q
[ -L mine.html ] || fail "the link that was named is no link any more"
holds "</html>" notes.txt
cp kept.txt notes.txt

# The picture of a page is one that the run drew: nobody's file goes with the page to others.
if built_with cairo; then
    mooring='  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}'
    sed -e 's/towed/free/; /speed: 2/d' -e "/^  hull:/a\\$mooring" scene.yaml >moored.yaml
    "$FRAM" run moored.yaml -o moored -q
    expect 0 "$FRAM" report moored -o shown.html -q
    pictures() { grep -o "data:image/png" shown.html | wc -l; }
    all=$(pictures)
    cp moored/station.png mine.png
    ln -sf "$PWD/mine.png" moored/station.png
    expect 0 "$FRAM" report moored -o shown.html
    says "moored/station.png: expected a picture" err
    [ "$(pictures)" = $((all - 1)) ] || fail "the page shows what a link leads to"
    rm moored/station.png
    { cat mine.png && cat notes.txt; } >moored/station.png
    expect 0 "$FRAM" report moored -o shown.html
    says "moored/station.png: expected a picture" err
    [ "$(pictures)" = $((all - 1)) ] || fail "the page has what is no picture"
fi

finish "links in a run's folder lead nothing out of it"
