#!/usr/bin/env bash
# The tutorials of the manual: every command, as it is written, in the order of the page, but that runs are cut to six
# seconds unless FRAM_TEST_LONG is set.
. "$FRAM_SOURCE/tests/cli/common.sh"
if ! "$FRAM" --version | grep -q cairo; then
    echo "skipped: this build draws no pictures, and later commands go on with what is made beside them"
    exit 77
fi
cp -r "$FRAM_SOURCE/scenes" "$scratch/"
mkdir -p "$scratch/build/release" "$scratch/out"
ln -s "$FRAM" "$scratch/build/release/fram"
export FRAM_LIBRARY=$FRAM_BUILD/libfram.so PYTHONPATH=$FRAM_SOURCE/bindings/python code python
# shellcheck disable=SC2016  # the shell that runs it knows it
python_runs='"$python" -c "$code"' python=
for each in python3 /usr/bin/python3; do
    # Debian's packages are those of Debian's own Python, and under sanitizers none loads the library.
    [ -n "$python" ] || [ -n "${FRAM_TEST_SANITIZE:-}" ] || ! "$each" -c 'import fram' 2>/dev/null || python=$each
done
if [ -z "$python" ]; then
    echo "skipped: no Python that can load the library"
    python_runs=:
fi
count=0 inside='' code=''
while IFS= read -r line; do
    # Lines of Python that stand between two fences are one command.
    case $inside$line in
    '```python') inside=yes code='' ;;
    'yes```') inside='' line='    '$python_runs ;;
    yes*) code+=$line$'\n' ;;
    esac
    [[ $line = '    '* && ! $inside ]] || continue
    command=${line#    }
    count=$((count + 1))
    if [ -z "${FRAM_TEST_LONG:-}" ]; then
        # shellcheck disable=SC2016  # the arithmetic is text of the page
        command=$(sed 's/run\.duration=[0-9]*/run.duration=6/; s/run\.transient=[0-9]*/run.transient=0/
            s/\$((30 \/ 2))/0/' <<<"$command")
    fi
    # Parts that this build lacks are no fault of the page.
    if ! bash -c "set -e; $command" >out/log 2>&1; then
        if grep -qi "this build" out/log; then
            echo "skipped, this build lacks a part: $command"
            continue
        fi
        echo "FAILED: $command"
        tail -n 5 out/log
        exit 1
    fi
done <"$FRAM_SOURCE/docs/tutorials.md"
echo "$count commands of docs/tutorials.md"
[ "$count" -ge 15 ]

# "Your own vessel and ice" of the README, which takes the floes of its first run: the last one meets ice.
sed -e ':a;/\\$/{N;s/\\\n *//;ba}' "$FRAM_SOURCE/README.md" >readme
count=0
while IFS= read -r line; do
    count=$((count + 1))
    bash -c "set -e; $line" >out/log 2>&1 || fail "README: $line: $(tail -n 3 out/log)"
done < <(grep -E '^    build.* (-o out/(thick|ship.stl|mine)|--geojson|out/floes.geojson)' readme)
[ "$count" = 5 ] || fail "$count commands of the README instead of 5"
awk -F, 'NR == 1 { while ($++c != "ice_force_x[N]"); } NR > 1 && $c != 0 { met++ } END { exit !(met > 100) }' \
    out/mine/series.csv || fail "the run in own ice meets none"
finish "the README's own vessel meets its own ice"
