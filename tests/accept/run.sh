#!/usr/bin/env bash
# Runs every tests/accept/issue-*.sh. DOTEK is the program, DOTEK_CORPUS the corpus, both absolute paths.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
status=0
for script in tests/accept/issue-*.sh; do
  printf '== %s\n' "$(basename "$script" .sh)"
  bash "$script" || status=1
done
exit "$status"
