#!/usr/bin/env bash
# Every function of include/fram is called by a C test, and docs/api.md says by which.
set -euo pipefail
cd "$FRAM_SOURCE"
python3 tools/list_api.py --check
