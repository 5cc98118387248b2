#!/usr/bin/env bash
# Files that are no files, files that are too large, names that must differ, and what results tell of this machine.
. "$FRAM_SOURCE/tests/cli/common.sh"

cat >scene.yaml <<'YAML'
run: {duration: 0.4, time_step: 0.004}
vessel:
  mode: free
  hull: {form: file, file: hull.stl}
ice: {source: none}
domain: {boundary: open}
output: {frame_interval: 0.1}
YAML
expect 0 "$FRAM" hull --length 40 --beam 10 --draught 4 -o hull.stl
mkfifo pipe
mkdir folder
printf 'time[s],x[m/s],y[m/s]\n0,1,0\n10,1,0\n' >wind.csv

# Each is refused by its kind, none is waited for: as scenario, hull, outlines, table, run and record.
refuse() {
    local words=$1
    shift
    expect 2 timeout 20 "$FRAM" "$@"
    says "$words" err
}
for kind in 'pipe:found a pipe' 'folder:found a folder' '/dev/zero:found a device' \
    '/proc/self/stat:found one of the system' '/proc/self/mem:found one of the system'; do
    file=${kind%%:*} words=${kind#*:}
    [ -e "$file" ] || continue
    refuse "$words" check "$file"
    refuse "$words" run scene.yaml -o no --set vessel.hull.file="$file"
    refuse "$words" hull "$file"
    refuse "$words" field "$file"
    refuse "$words" run scene.yaml -o no --set environment.wind_file="$file"
    refuse "$words" bench --scene "$file"
    refuse "$words" fmu scene.yaml -o no.fmu --binary "$file"
done
if [ -e no ] || [ -e no.fmu ]; then fail "what was refused left results"; fi
expect 0 "$FRAM" run scene.yaml -o run -q
for file in series.csv run.json scenario.yaml record.fram; do
    cp -r run broken
    rm broken/$file
    mkfifo broken/$file
    refuse "found a pipe" report broken
    refuse "$file: expected a regular file, found a pipe" resume broken
    rm -r broken
done
# Nor is the reader of one that lies where a run which goes on will write.
cp -r run broken
mkfifo broken/checkpoint-000000000900.fram
refuse "checkpoint-000000000900.fram: expected a regular file, found a pipe" resume broken
rm broken/checkpoint-000000000900.fram
mkdir broken/pictures
mkfifo broken/pictures/plan-000000000.800.png
refuse "pictures/plan-000000000.800.png: expected a regular file, found a pipe" resume broken
rm -r broken

# A run goes on with files that lie somewhere else, if they are the same.
expect 0 "$FRAM" run scene.yaml -o moved -q --until 0.2
mkdir elsewhere
mv hull.stl elsewhere
expect 2 "$FRAM" resume moved -q
says "cannot read" err
sed -i 's#/hull.stl#/elsewhere/hull.stl#' moved/scenario.yaml
cp -r moved other
expect 0 "$FRAM" resume moved -q
same "$(grep state_hash moved/run.json)" "$(grep state_hash run/run.json)" "the state of a run whose file moved"
says "elsewhere/hull.stl" moved/run.json
expect 0 "$FRAM" hull --length 40 --beam 10 --draught 5 -o elsewhere/hull.stl --force
expect 2 "$FRAM" resume other -q
says "a file that the run was started with was changed since: $scratch/elsewhere/hull.stl; restore it" err
expect 0 "$FRAM" hull --length 40 --beam 10 --draught 4 -o hull.stl

# Sizes: a scenario of more than 32 MiB, more than one in its brackets, a line of a table without end, a table of more
# than 16 GiB (with holes).
{ cat scene.yaml && head -c 33600000 /dev/zero | tr '\0' '#'; } >large.yaml
refuse "at most 33554432 bytes" check large.yaml
head -c 2000000 /dev/zero | tr '\0' '[' >large.yaml
refuse "large.yaml:1:1: expected at most 1048576 bytes in brackets" check large.yaml
{ cat wind.csv && head -c 1100000 /dev/zero | tr '\0' '1'; } >long.csv
refuse "at most 1048576 characters in a line" run scene.yaml -o no --set environment.wind_file=long.csv
if truncate -s 17G holes.csv 2>/dev/null; then
    refuse "at most" run scene.yaml -o no --set environment.wind_file=holes.csv
fi

# Pictures that come faster than hundredths of a second, and outlines at times that differ late.
if "$FRAM" --version | grep -q cairo; then
    expect 0 "$FRAM" run scene.yaml -o fast -q --set run.duration=0.04 --set output.picture_interval=0.004
    same "$(find fast/pictures -name 'plan-*.png' | wc -l)" 10 "pictures"
    [ -e fast/pictures/plan-000000.004.png ] || fail "names of pictures: $(ls fast/pictures)"
    expect 0 "$FRAM" run scene.yaml -o slow -q --set output.picture_interval=0.2
    [ -e slow/pictures/plan-000000.20.png ] || fail "names of pictures: $(ls slow/pictures)"
fi
expect 0 "$FRAM" export run --geojson --time 0.10000001 -q
expect 0 "$FRAM" export run --geojson --time 0.10000002 -q
same "$(find run -name 'field-*.geojson' | wc -l)" 2 "files of two times"

# What others are given tells the names of input files, not where they lie; unless it is asked for.
expect 0 "$FRAM" report run -q
for file in run/record.fram run/report.html; do
    grep -q 'hull.stl' $file || fail "$file does not name its input"
    grep -qF "$PWD" $file && fail "$file tells the folder of an input"
done
expect 0 "$FRAM" report "$PWD/run" -q
grep -qF "$PWD" run/report.html && fail "report.html tells the folder of the run"
expect 0 "$FRAM" report run -q --with-paths
says "$PWD/hull.stl" run/report.html
expect 0 "$FRAM" run scene.yaml -o told -q --with-paths
grep -qF "$PWD/hull.stl" told/record.fram || fail "--with-paths does not tell the path in the record"
expect 0 "$FRAM" resume told -q

# Folders with long names: one whose scenario could not be read again is refused before the run, not after it.
deep=$(printf 'd%.0s' $(seq 200))
refuse "at most 497 bytes" run scene.yaml -o "$deep/$deep/$deep"
[ ! -e "$deep" ] || fail "a refused run left a folder"
long=$deep/$deep/$(printf 'e%.0s' $(seq 95))
same "${#long}" 497 "length of the longest name"
expect 0 "$FRAM" run scene.yaml -o "$long" -q --until 0.2
expect 0 "$FRAM" resume "$long" -q
expect 0 "$FRAM" report "$long" -q
expect 0 "$FRAM" export "$long" --vtk -q
for file in report.html vtk/run.pvd run.json record.fram; do
    [ -s "$long/$file" ] || fail "no $file in a long path"
done

finish "input files are what they are taken for"
