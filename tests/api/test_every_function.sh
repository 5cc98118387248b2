#!/usr/bin/env bash
# Every function of include/fram is held by a C test that reads its answer or by the command, and docs/api.md says by
# which.
set -euo pipefail
cd "$FRAM_SOURCE"
python3 tools/list_api.py --check
