#!/bin/sh
# Say which of Fram's needs are missing on this machine and, with --install, install them from Debian's packages.
#   tools/deps.sh [--install] [GROUP...]     groups: core (default), dev, viewer, views, peers, validate, slurm,
#                                             statistics, python, deb, trial, live, wasm, site
# Sizes are told first, and a person at a terminal is asked (FRAM_YES=1: not).
# Exit code 0: all there (or not Debian: the list is printed and the build goes on to find out itself);
# 1: something is missing and was not installed.
#
# A line is: group, Debian package, how to see that it is there (a command, a pkg-config module, or a file).
set -eu

needs() {
    cat <<'END'
core gcc                cmd:cc
core libc6-dev          file:/usr/include/stdio.h
core binutils           cmd:objcopy
core cmake              cmd:cmake
core ninja-build        cmd:ninja
core pkg-config         cmd:pkg-config
core python3            cmd:python3
core libgeos-dev        pc:geos
core libfyaml-dev       pc:libfyaml
core libcairo2-dev      pc:cairo
core libnetcdf-dev      pc:netcdf
core libpng-dev         pc:libpng
core zlib1g-dev         pc:zlib
core nettle-dev         pc:nettle
core check              pc:check
dev  clang              cmd:clang
dev  clang-format       cmd:clang-format
dev  clang-tidy         cmd:clang-tidy
dev  libclang-rt-14-dev deb:libclang-rt-14-dev
dev  llvm               cmd:llvm-symbolizer
dev  libasan8           deb:libasan8
dev  libubsan1          deb:libubsan1
dev  libtsan2           deb:libtsan2
dev  shellcheck         cmd:shellcheck
dev  pyflakes3          cmd:pyflakes3
dev  gcovr              cmd:gcovr
dev  valgrind           cmd:valgrind
dev  util-linux         cmd:setarch
dev  g++                cmd:g++
dev  python3-markdown   deb:python3-markdown
site python3-markdown   deb:python3-markdown
viewer nodejs           cmd:node
viewer npm              cmd:npm
views  chromium         cmd:chromium
views  ffmpeg           cmd:ffmpeg
views  python3-vtk9     deb:python3-vtk9
views  python3-h5py     deb:python3-h5py
views  python3-pandas   deb:python3-pandas
views  python3-xarray   deb:python3-xarray
views  python3-netcdf4  deb:python3-netcdf4
live   libmicrohttpd-dev pc:libmicrohttpd
wasm   emscripten       cmd:emcc
wasm   dpkg-dev         cmd:dpkg-source
peers g++               cmd:g++
peers libbullet-dev     pc:bullet-float64
peers libode-dev        pc:ode
validate python3-matplotlib deb:python3-matplotlib
validate python3-cffi     deb:python3-cffi
slurm  slurmctld        cmd:slurmctld
slurm  slurmd           cmd:slurmd
slurm  slurm-client     cmd:sbatch
slurm  munge            cmd:munged
statistics python3-scipy deb:python3-scipy
statistics r-base-core  cmd:Rscript
statistics r-cran-evd   deb:r-cran-evd
python python3-numpy    deb:python3-numpy
python python3-cffi     deb:python3-cffi
python python3-pip      deb:python3-pip
deb    build-essential  deb:build-essential
deb    debhelper        cmd:dh
deb    dh-python        cmd:dh_python3
deb    libmicrohttpd-dev pc:libmicrohttpd
deb    lintian          cmd:lintian
deb    fonts-dejavu-core file:/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
trial  debootstrap      cmd:debootstrap
END
}

have_dpkg() { command -v dpkg-query >/dev/null 2>&1 && command -v apt-get >/dev/null 2>&1; }

is_there() {
    case $1 in
    cmd:*) command -v "${1#cmd:}" >/dev/null 2>&1 ;;
    pc:*) command -v pkg-config >/dev/null 2>&1 && pkg-config --exists "${1#pc:}" ;;
    file:*) [ -e "${1#file:}" ] ;;
    deb:*) ! have_dpkg || dpkg-query -W -f='${db:Status-Status}' "${1#deb:}" 2>/dev/null | grep -qx installed ;;
    esac
}

# The packages of the groups that are missing, one a line.
missing() {
    needs | while read -r group package sign; do
        case " $groups " in *" $group "*) is_there "$sign" || echo "$package" ;; esac
    done | sort -u
}

install=no
groups=""
for word; do
    case $word in
    --install) install=yes ;;
    core | dev | viewer | views | peers | validate | slurm | statistics | python | deb | trial | live | wasm | site)
        groups="$groups $word"
        ;;
    *)
        echo "usage: tools/deps.sh [--install] [core] [dev] [viewer] [views] [peers] [validate] [slurm] [statistics] \
[python] [deb] [trial] [live] [wasm] [site]" >&2
        exit 2
        ;;
    esac
done
groups=${groups:-core}

packages=$(missing | tr '\n' ' ')
packages=${packages% }
[ -n "$packages" ] || exit 0
echo "deps: missing (Debian's names): $packages"

if ! have_dpkg; then
    echo "deps: this is not Debian; install the like of these with your own package manager. Carrying on."
    exit 0
fi
[ $install = yes ] || exit 1

as_root=""
if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
        echo "deps: installing needs root, and there is no sudo. As root, run:" >&2
        echo "    apt-get install -y --no-install-recommends $packages" >&2
        exit 1
    fi
    as_root=sudo
fi

# What apt says of the sizes: "Need to get 12.3 MB of archives." and "After this operation, 45 MB ... will be used."
sizes() {
    # shellcheck disable=SC2086  # packages is a list of words
    LC_ALL=C apt-get install --assume-no --no-install-recommends $packages 2>/dev/null |
        sed -n 's/^Need to get /deps: to download: /p; s/^After this operation, /deps: on disk: /p'
}

# Whoever sits at a terminal is asked; FRAM_YES=1 answers yes.
agreed() {
    if [ -n "${FRAM_YES:-}" ] || [ ! -t 0 ] || [ ! -t 1 ]; then return 0; fi
    printf 'deps: install them with apt-get now? [Y/n] '
    read -r answer || return 1
    case $answer in "" | [Yy]*) return 0 ;; *) return 1 ;; esac
}

apt_install() {
    # shellcheck disable=SC2086  # packages is a list of words
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $packages
}

told=$(sizes || true)
if [ -z "$told" ]; then
    # Lists of packages that are old or absent know no sizes.
    $as_root apt-get -qq update || echo "deps: apt-get update failed; trying with the lists that are here" >&2
    told=$(sizes || true)
fi
echo "${told:-deps: apt-get does not tell their size}"
if ! agreed; then
    echo "deps: nothing was installed. The same by hand: apt-get install --no-install-recommends $packages" >&2
    exit 1
fi
echo "deps: installing them with apt-get"
if ! apt_install >/dev/null 2>&1; then
    # Package lists may be old or absent.
    $as_root apt-get -qq update || echo "deps: apt-get update failed; trying with the lists that are here" >&2
    if ! apt_install; then
        echo "deps: apt-get could not install: $packages" >&2
        echo "deps: see its message above; is the network there, and is Debian 12's 'main' in the sources?" >&2
        exit 1
    fi
fi

packages=$(missing | tr '\n' ' ')
if [ -n "$packages" ]; then
    echo "deps: installed, but still not found: $packages" >&2
    exit 1
fi
echo "deps: all there"
