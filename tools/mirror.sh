#!/bin/sh
# The mirror of Debian's main archive that this machine installs from; MIRROR=http://... names another one.
set -eu
release=${1:-bookworm}
# shellcheck disable=SC2016  # $(SITE) is apt's own way to write a field
mirror=${MIRROR:-$(apt-get indextargets --format '$(SITE) $(RELEASE) $(ORIGIN)' 'Created-By: Packages' |
    sed -n "s/ $release Debian\$//p" | head -n 1)}
[ -n "$mirror" ] || { echo "mirror: apt knows no mirror of $release; give one as MIRROR=http://..." >&2; exit 1; }
echo "$mirror"
