#!/usr/bin/env bash
# Try the wheel of `make python` in an empty Debian 12 root that has python3-numpy and python3-cffi and no compiler, and
# write what came of it to bench/results/wheel.md.  As root, with a network; MIRROR=http://... is another mirror, BASE
# a tar file of debootstrap --variant=minbase, where there is one.
set -euo pipefail
cd "$(dirname "$0")/.."
mirror=$(tools/mirror.sh)
here=build/trial-wheel
root=$here/root
page=bench/results/wheel.md
wheel=$(ls build/python/fram-*.whl)

[ "$(id -u)" = 0 ] || { echo "try_wheel: debootstrap and chroot need root" >&2; exit 1; }
leave() { umount "$root/proc" 2>/dev/null || true; }
trap leave EXIT
leave
rm -rf "$root"
mkdir -p "$root"
if [ -n "${BASE:-}" ]; then
    tar -x -f "$BASE" -C "$root"
else
    debootstrap --variant=minbase bookworm "$root" "$mirror" >"$here/debootstrap.log"
fi
cp /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"
cp "$wheel" "$root/tmp/"
cp scenes/free_vessel.yaml "$root/tmp/scene.yaml"

inside() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        sh -ec "$1"
}

inside "apt-get -qq update && apt-get -qq install -y --no-install-recommends python3-numpy python3-cffi" \
    >"$here/install.log" 2>&1 || { tail -n 5 "$here/install.log" >&2; exit 1; }
# A wheel is an archive: Python's own library unpacks it, pip is not asked for.
inside "python3 -m zipfile -e /tmp/$(basename "$wheel") /usr/lib/python3/dist-packages"
cat >"$root/tmp/try.py" <<'END_OF_TRIAL'
import fram, pathlib
world = fram.Scenario.load("/tmp/scene.yaml", {"run.duration": 4, "run.transient": 1}).world()
with world.record("/tmp/run") as recording:
    while world.time < 4 - 1e-9:
        world.step()
print(f"{world.hash:016x}" if isinstance(world.hash, int) else world.hash)
END_OF_TRIAL
there=$(inside "cd /tmp && python3 try.py" | tail -n 1)
here_hash=$(build/release/fram run scenes/free_vessel.yaml -o "$here/run" --force --quiet --json --set run.duration=4 \
    --set run.transient=1 | sed -n 's/.*"state_hash": *"\([0-9a-f]*\)".*/\1/p')
packages=$(inside "dpkg -l | grep -c ^ii")
! inside "command -v cc || command -v gcc" >/dev/null || { echo "try_wheel: there is a compiler" >&2; exit 1; }
[ "$there" = "$here_hash" ] || { echo "try_wheel: hash $there there, $here_hash here" >&2; exit 1; }

megabytes=$(stat -c %s "$wheel" | awk '{printf "%.1f", $1 / 1e6}')
cat >"$page" <<END_OF_PAGE
# The wheel in an empty Debian 12

\`tools/try_wheel.sh\`, $(date +%F), Fram $(git --git-dir=.git log -1 --format=%h): debootstrap's minbase of
bookworm, then python3-numpy and python3-cffi without what they recommend; $packages packages in all, no compiler, no
pip. The wheel ($megabytes MB) was unpacked by \`python3 -m zipfile\`.

\`import fram\`, four seconds of \`scenes/free_vessel.yaml\` stepped and recorded: state hash \`$there\`, as
\`fram run\` has on the machine that built it.
END_OF_PAGE
echo "try_wheel: hash $there, as here; $page"
