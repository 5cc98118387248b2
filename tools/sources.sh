#!/bin/sh
# Print Fram's own files, one a line:  tools/sources.sh [PATTERN...]   ('*.c', 'src/*.h'; all without a pattern)
# Those git knows or would add; without git, all but what is built.
set -eu
cd "$(dirname "$0")/.."
if git rev-parse --git-dir >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard -- "$@" | sort -u | while read -r file; do
        [ ! -f "$file" ] || echo "$file"
    done
else
    find . -path ./build -prune -o -path ./out -prune -o -name node_modules -prune -o -type f -print | sed 's,^\./,,' |
        sort | while read -r file; do
        [ $# -gt 0 ] || echo "$file"
        for pattern; do
            # shellcheck disable=SC2254  # the pattern is meant as one
            case $file in $pattern) echo "$file" ;; esac
        done
    done
fi
