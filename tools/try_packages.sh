#!/usr/bin/env bash
# Install and try the packages of `make deb` and `make archive` in empty Debian 12 roots, and write what came of it to
# bench/results/packages.md.  As root, with a network; MIRROR=http://... names another mirror of Debian.
set -euo pipefail
cd "$(dirname "$0")/.."
mirror=$(tools/mirror.sh)
here=build/trial
page=bench/results/packages.md
rows=$here/rows
scene='--set run.duration=4 --set run.transient=1 --json --quiet'

[ "$(id -u)" = 0 ] || { echo "try_packages: debootstrap and chroot need root" >&2; exit 1; }
ls build/packages/*.deb build/packages/*.tar.gz >/dev/null || { echo "first: make deb archive" >&2; exit 1; }

leave() {
    local root
    for root in $here/deb $here/archive; do umount "$root/proc" 2>/dev/null || true; done
}
trap leave EXIT

fail() {
    echo "try_packages: $*" >&2
    exit 1
}

# A root with Debian's smallest system and nothing of this machine but its package sources.
empty_root() { # NAME
    local root=$here/$1
    leave
    rm -rf "$root"
    mkdir -p "$root"
    tar -x -f $here/base.tar -C "$root"
    cp /etc/resolv.conf "$root/etc/"
    mount -t proc proc "$root/proc"
}

inside() { # ROOT COMMAND
    chroot "$here/$1" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive sh -ec "$2"
}

# One row of the page: what was done, its seconds, and the last line of what it printed.
try() { # ROOT WHAT COMMAND
    local began=$SECONDS log=$here/last.log said
    echo "  $1: $2"
    inside "$1" "$3" >"$log" 2>&1 || {
        tail -n 20 "$log" >&2
        fail "$1: $2"
    }
    said=$(tail -n 1 "$log" | cut -c 1-80 | tr '|' '/')
    echo "| $1 | $2 | $((SECONDS - began)) | ${said:+\`$said\`} |" >>$rows
}

hash_of() { sed -n 's/.*"state_hash": *"\([0-9a-f]*\)".*/\1/p' "$1"; }

mkdir -p $here
: >$rows
echo "try_packages: an empty Debian 12 (debootstrap --variant=minbase)"
if [ ! -f $here/base.tar ]; then
    rm -rf $here/base
    debootstrap --variant=minbase bookworm $here/base "$mirror" >$here/debootstrap.log
    tar -c -f $here/base.tar -C $here/base .
    rm -rf $here/base
fi

empty_root deb
mkdir -p $here/deb/packages
cp build/packages/*.deb tests/package/consumer/consumer.c $here/deb/packages
examples=/usr/share/doc/fram/examples/scenes
try deb "apt update" "apt-get -qq update && echo done"
try deb "apt install ./*.deb, with all that they need" \
    "cd /packages && apt-get -qq install -y ./*.deb && echo \$(dpkg -l | grep -c ^ii) packages in all"
try deb "fram --version" "fram --version"
try deb "four seconds of the demo" "cd /tmp && fram run $examples/demo.yaml -o demo $scene | tee demo.json"
try deb "fram view" \
    "[ ! -f /usr/share/fram/playback.html ] || { cd /tmp && fram view demo && ls demo/playback.html; }"
try deb "fram export --netcdf" "cd /tmp && fram export demo --netcdf -o demo.nc && ls -s demo.nc"
try deb "fram fmu" "cd /tmp && fram fmu $examples/free_vessel.yaml -o vessel.fmu && ls -s vessel.fmu"
try deb "python3 -c 'import fram', ten steps" "python3 -c \"
import fram
world = fram.Scenario.load('$examples/free_vessel.yaml').world()
world.step(10)
print('t =', world.time)\""
try deb "apt install gcc libc6-dev pkg-config" \
    "apt-get -qq install -y --no-install-recommends gcc libc6-dev pkg-config && echo done"
try deb "a program by libfram-dev" \
    "cd /tmp && cc /packages/consumer.c -o consumer \$(pkg-config --cflags --libs fram) && ./consumer"
try deb "apt install what libfram-dev suggests" \
    "apt-get -qq install -y --no-install-recommends \$(dpkg-query -W -f '\${Suggests}' libfram-dev | tr -d ,) &&
    echo done"
try deb "a program by the static library" "cd /tmp && archive=\$(dpkg -L libfram-dev | grep 'libfram\.a$') &&
    cc /packages/consumer.c -o static \$(pkg-config --cflags fram) \$archive \
        \$(pkg-config --static --libs fram | sed 's/-lfram //') && ./static"
try deb "apt purge, nothing left" "apt-get -qq purge -y fram libfram0 libfram-dev python3-fram &&
    ! find / -xdev -path /tmp -prune -o -path /packages -prune -o -path /var/cache -prune -o -name '*fram.h' -print \
        -o -name 'libfram*' -print -o -path '*/bin/fram' -print -o -path '*/dist-packages/fram' -print | grep . &&
    echo nothing left"

empty_root archive
archive=$(ls build/packages/*.tar.gz)
mkdir -p "$here/archive/opt/else where"
tar -x -z -f "$archive" -C "$here/archive/opt/else where" --strip-components=1
home="/opt/else where"
try archive "fram --version, by a link" "ln -s '$home/bin/fram' /usr/local/bin/fram && fram --version"
try archive "four seconds of the demo" "cd /tmp && fram run '$home/scenes/demo.yaml' -o demo $scene | tee demo.json"
# Without any font letters are boxes, and the picture is another one.
try archive "pictures have letters" "cd /tmp && echo '<fontconfig/>' >none.conf &&
    FONTCONFIG_FILE=/tmp/none.conf fram run '$home/scenes/demo.yaml' -o bare $scene &&
    ! cmp -s demo/loads.png bare/loads.png &&
    echo they do"
try archive "fram view" \
    "[ ! -f '$home/share/fram/playback.html' ] || { cd /tmp && fram view demo && ls demo/playback.html; }"
try archive "fram fmu" "cd /tmp && fram fmu '$home/scenes/free_vessel.yaml' -o vessel.fmu && ls -s vessel.fmu"

# The same state to the bit as in the tree, and letters in the pictures of a system that has no fonts.
# shellcheck disable=SC2086  # options are words
build/release/fram run scenes/demo.yaml -o $here/demo --force $scene >$here/demo.json
tree=$(hash_of $here/demo.json)
[ -n "$tree" ] || fail "no hash in $here/demo.json"
for root in deb archive; do
    [ "$(hash_of $here/$root/tmp/demo.json)" = "$tree" ] || fail "$root: another state hash than build/release"
done
{
    echo "# Packages in empty roots"
    echo
    cat <<END
Written by \`make test-packages\` on $(date -u +%F), Fram $(git --git-dir=.git log -1 --format=%h): an empty Debian 12
(\`debootstrap --variant=minbase\`) for the Debian packages and another for the archive. Times are in seconds, with
downloads, on a machine of $(nproc) cores with other work. The demo had the state hash of the tree itself in both,
\`$tree\`, and the pictures of the second root have letters, though it has no fonts.

END
    echo "| file | size |"
    echo "|---|---|"
    for file in build/packages/*; do echo "| \`${file##*/}\` | $(du -h --apparent-size "$file" | cut -f1) |"; done
    echo
    echo "| root | what | s | last line printed |"
    echo "|---|---|---|---|"
    cat $rows
} >$page
echo "try_packages: all well; $page"
