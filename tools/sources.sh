#!/bin/sh
# Print Fram's own files, one a line:  tools/sources.sh [PATTERN...]   ('*.c', 'src/*.h'; all without a pattern)
# Those git knows or would add; where this folder is not the top of git's tree, all but what is built: a tree around it
# may ignore or leave out all of it.
set -eu
cd "$(dirname "$0")/.."
if git --git-dir=.git rev-parse >/dev/null 2>&1; then
    files=$(git --git-dir=.git ls-files --cached --others --exclude-standard -- "$@" | sort -u |
        while read -r file; do
            [ ! -f "$file" ] || echo "$file"
        done)
else
    files=$(find . \( -path ./build -o -path ./out -o -name node_modules -o -name __pycache__ -o -name .git \) -prune \
        -o -type f ! -name '*.o' -print | sed 's,^\./,,' | sort | while read -r file; do
            [ $# -gt 0 ] || echo "$file"
            for pattern; do
                # shellcheck disable=SC2254  # the pattern is meant as one
                case $file in $pattern) echo "$file" ;; esac
            done
        done)
fi
# Who looks at no file finds all of them good.
[ -n "$files" ] || { echo "sources: no file of $PWD fits${*:+ $*}" >&2; exit 1; }
printf '%s\n' "$files"
