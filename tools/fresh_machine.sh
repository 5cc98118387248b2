#!/usr/bin/env bash
# Follow the README's two commands on a machine that has nothing, and write docs/fresh-machine.md:
#   tools/fresh_machine.sh            as root, with a network; an empty Debian 12 root under build/fresh
#   FRESH="demo"                      the first command alone; default: "demo test"
#   MIRROR=http://...                 another mirror of Debian
# The root gets a clone of this repository as it is committed, and nothing else of this machine but its package sources.
set -euo pipefail
cd "$(dirname "$0")/.."
here=$PWD/build/fresh
root=$here/root
page=docs/fresh-machine.md
parts=${FRESH:-demo test}
commit=$(git log -1 --format=%h)
mirror=$(tools/mirror.sh)

[ "$(id -u)" = 0 ] || { echo "fresh_machine: debootstrap and chroot need root" >&2; exit 1; }

leave() { umount "$root/proc" "$root/dev/pts" "$root/dev" 2>/dev/null || true; }
trap leave EXIT

inside() { # COMMAND
    chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive FRAM_YES=1 sh -ec "$1"
}

# Seconds of the clock and of the processors that a command in the root took, its output to a log.
timed() { # NAME COMMAND
    local began=$SECONDS
    echo "fresh_machine: $1"
    ( # A shell of its own, whose children are this command's alone.
        status=0
        inside "$2" >"$here/$1.log" 2>&1 || status=$?
        times >"$here/$1.times"
        tail -n 1 "$here/$1.times" | awk -F '[ms ]+' '{ printf "%.0f\n", 60 * ($1 + $3) + $2 + $4 }' >"$here/$1.cpu"
        exit "$status"
    ) || { tail -n 30 "$here/$1.log" >&2; echo "fresh_machine: $1 failed; see $here/$1.log" >&2; exit 1; }
    echo $((SECONDS - began)) >"$here/$1.wall"
}

minutes() { awk -v s="$1" 'BEGIN { printf "%d min %02d s", s / 60, s % 60 }'; }
took() {
    local cpu
    cpu=$(cat "$here/$1.cpu")
    [ "$cpu" -eq 0 ] || cpu=", of which $(minutes "$cpu") of processor time"
    echo "$(minutes "$(cat "$here/$1.wall")")${cpu#0}"
}
indented() { sed -e 's/\x1b\[[0-9;]*[A-Za-z]//g' | fold -s -w 112 | sed -e 's/[[:space:]]*$//' -e 's/^/    /'; }
size_of() { du -s -x --block-size=1M "$1" | cut -f1; }

leave
rm -rf --one-file-system "$root"
mkdir -p "$root"
if [ ! -f "$here/base.tar" ]; then
    debootstrap --variant=minbase --include=ca-certificates,make,git bookworm "$here/base" "$mirror" \
        >"$here/debootstrap.log"
    tar -c -f "$here/base.tar" -C "$here/base" .
    rm -rf "$here/base"
fi
tar -x -f "$here/base.tar" -C "$root"
cp /etc/resolv.conf "$root/etc/"
# Certificates of a network's own authority, where this machine trusts one.
cp -r /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/" 2>/dev/null || true
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount --bind /dev/pts "$root/dev/pts"
git clone --quiet --bare . "$here/source.git" 2>/dev/null || git -C "$here/source.git" fetch --quiet "$PWD" HEAD
git -C "$here/source.git" update-ref refs/heads/main "$(git rev-parse HEAD)"
git -C "$here/source.git" symbolic-ref HEAD refs/heads/main
rm -rf "$root/srv/fram.git" && cp -r "$here/source.git" "$root/srv/fram.git"

packages=$(inside "dpkg -l | grep -c ^ii")
before=$(size_of "$root")
timed prepare "update-ca-certificates && apt-get -qq update"
timed clone "git -c safe.directory='*' clone --quiet /srv/fram.git /opt/fram"
clone=$(size_of "$root/opt/fram")
for part in $parts; do timed "$part" "cd /opt/fram && make $part"; done
after=$(size_of "$root")

{
    cat <<END
# On a machine that has nothing

Written by \`tools/fresh_machine.sh\` on $(date -u +%F), Fram $commit: the README's commands in an empty Debian 12 root
(\`debootstrap --variant=minbase --include=ca-certificates,make,git\`, $packages packages: no compiler, no CMake, no
Python), as root in a \`chroot\`, with an environment of nothing but \`PATH\`, \`HOME\` and \`LANG\`. The machine had
$(nproc) cores, which other work kept busy, so that times of the clock are upper bounds.

| what | size or time |
|---|---|
| the root before, and after all of it | $before MB, $after MB |
| the clone | $clone MB, $(cat "$here/clone.wall") s from the same disk |
END
    for part in $parts; do echo "| \`make $part\` | $(took "$part") |"; done
    echo
    echo "## make demo"
    echo
    grep -v '^\[[0-9]*/[0-9]*\]' "$here/demo.log" |
        grep -E '^deps|^viewer|^The |^Open|^finished|^results|^  out/|floes, conc|open it' | head -n 40 | indented
    case " $parts " in
    *" test "*)
        echo
        echo "## make test"
        echo
        sed -n '/tests passed/,$p' "$here/test.log" | grep -v '^$' | indented
        ;;
    *)
        echo
        echo "\`make test\` was not run this time."
        ;;
    esac
    cat <<'END'

## When something is in the way

- **No root and no sudo**: `tools/deps.sh` stops with exit code 1 and prints the `apt-get` line that somebody else
  must run.
- **No network, or other package sources**: it stops with apt's own message, the packages that it wanted and a hint; the
  build is not begun.
- **npm does not reach its registry**: its reason is printed, the playback page is skipped by name, and the report is
  what to open first; exit code 0.
- **Not Debian**: it prints Debian's names of what it could not find, and the build carries on; CMake then says which
  library is really missing.

The first, second and last were tried by hand in such a root on 2026-11-21: as an unprivileged user, with the sources
taken away, and with a `PATH` that has no `dpkg`.
END
} >"$page"
echo "fresh_machine: all well; $page"
