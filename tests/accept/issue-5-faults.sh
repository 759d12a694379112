#!/usr/bin/env bash
# Issue 5: 200 faults planted by seed into converted programs and into our own macros, 300 cases each
# (docs/verify-faults.md). The judge is a test, which `./dev test` runs with fewer faults.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

tests=$(dirname "$DOTEK")/dotek_tests
DOTEK_FAULTS=200 timeout 900 "$tests" -tc='verify rejects planted faults' >"$out" 2>&1 && status=0 || status=$?
sed -n '/faults by seed/,/^====/{/^====/d;/^$/d;p}' "$out"
check "98 of 100 planted faults are rejected" hasStatus 0
check "on the cycles of the corpus, too" says "corpus cases: 1 run, 0 skipped"

finish
