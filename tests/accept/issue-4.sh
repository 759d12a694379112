#!/usr/bin/env bash
# Issue 4: Macro B is read, checked, run and written again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

ram=$DOTEK_CORPUS/ram
pocket=$DOTEK_CORPUS/pocket

# findings: `file:line severity code` of each finding in $out, sorted.
findings() {
  sed -nE 's#^(.*/)?([^/:]+):([0-9]+):[0-9]+: (error|warning|note): .* \[([a-z0-9-]+)\]$#\2:\3 \4 \5#p' "$out" | sort
}
# exactly LINE...: these findings and no other.
exactly() { diff <(printf '%s\n' "$@" | sort) <(findings); }

# ---- the programs of a 31i-B: the real errors, nothing else
dotek lint --control fanuc-31i-b "$ram"/*.nc
check "ram: the real errors and nothing else" exactly \
  "HLAVNI_PROGRAM_MERENI.nc:11 warning block-never-runs" \
  "HLAVNI_PROGRAM_MERENI.nc:14 error condition-bracket-missing" \
  "HLAVNI_PROGRAM_MERENI.nc:15 error condition-bracket-missing" \
  "HLAVNI_PROGRAM_MERENI.nc:15 warning constant-condition" \
  "HLAVNI_PROGRAM_MERENI.nc:26 error do-without-number" \
  "O9052-excerpt.nc:10 warning subscript-as-value"
check "ram: lint fails" hasStatus 1

# ---- the programs of a 6M: a misprint is one finding, a bad block has one error
dotek lint --control fanuc-6m --max-errors 0 "$pocket"/*.ocr.nc
check "pocket: at most one error a block" bash -c '! grep " error " | cut -d" " -f1 | uniq -d | grep .' < <(findings)
oneOf() { findings | grep -qx -- "$1" || { printf 'nowhere: %s\n' "$1"; findings; return 1; }; }
for expected in \
  "O20.ocr.nc:3 error decimal-comma" "O20.ocr.nc:27 error do-as-offset" "O20.ocr.nc:44 error do-as-offset" \
  "O80.ocr.nc:24 error do-as-offset" "O20.ocr.nc:41 error second-equals" "O110.ocr.nc:16 error letter-o-for-zero" \
  "O70.ocr.nc:41 error bracketed-assignment" "O40.ocr.nc:41 error assignment-target"; do
  check "pocket: $expected" oneOf "$expected"
done
check "pocket: a legend is one note" oneOf "O20.ocr.nc:20 note legend-line"
for file in O10 O30 O50 O500; do
  check "pocket: $file is right" bash -c '! grep -q "$1.ocr.nc:[0-9]* \(error\|warning\)"' _ "$file" < <(findings)
done
dotek lint "$pocket"/*.ocr.nc
check "without a control nothing is said of points" bash -c '! grep -q without-point' < <(findings)
