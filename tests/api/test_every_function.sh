#!/usr/bin/env bash
# Every function of include/fram is called by a C test.
set -euo pipefail
cd "$FRAM_SOURCE"
missing=0 count=0
for name in $(grep -ho 'fram_[a-z0-9_]*(' include/fram/*.h | tr -d '(' | sort -u); do
    count=$((count + 1))
    grep -q "\b$name(" tests/api/*.c || { echo "FAILED: no C test calls $name" && missing=1; }
done
[ "$count" -ge 50 ] || { echo "FAILED: found $count functions in include/fram" && exit 1; }
[ $missing = 0 ] && echo "$count functions of include/fram are called by C tests"
