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
dotek lint --control fanuc-6m --from listing --max-errors 0 "$pocket"/*.ocr.nc
check "pocket: at most one error a block" bash -c '! grep " error " | cut -d" " -f1 | uniq -d | grep .' < <(findings)
oneOf() { findings | grep -x -- "$1" >/dev/null || { printf 'nowhere: %s\n' "$1"; findings; return 1; }; }
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
dotek lint --max-errors 0 "$pocket"/*.ocr.nc
check "pocket: without --from listing text of drawings is no block" oneOf "O20.ocr.nc:20 error assignment-target"
check "pocket: and the error says what reads it" says "--from listing"
dotek lint --from listing "$pocket"/*.ocr.nc
check "without a control nothing is said of points" bash -c '! grep -q without-point' < <(findings)

# ---- the machine
nc() { printf '%%\nO1\n%s\n%%\n' "$1" >"$scratch/p.nc"; }
nc $'#1=0\nWHILE[#1LT5]DO1\n#1=#1+1\nEND1\n#500=#1*2\nM30'
dotek sim "$scratch/p.nc" --control fanuc-31i-b
check "sim: a loop counts" says "variable 500 10.000000"
nc $'N1GOTO1'
dotek sim "$scratch/p.nc" --limit sim-steps=100000
check "sim: a program that never ends stops at its limit" says "sim-steps"
check "sim: and fails" hasStatus 1
nc $'#500=1/#1'
dotek sim "$scratch/p.nc"
check "sim: null divides as 0" says "112"
nc $'IF[#1EQ0]GOTO9\n#500=1\nN9IF[#1EQ#0]THEN#501=1\nM30'
dotek sim "$scratch/p.nc"
check "sim: null is not 0 for EQ" says "variable 500 1.000000" "variable 501 1.000000"
mkdir -p "$scratch/lib"
printf '%%\nO9010\n#510=#1+#4\nM99\n%%\n' >"$scratch/lib/O9010.nc"
nc $'G65P9010A1.I2.\nM30'
dotek sim "$scratch/p.nc" --programs "$scratch/lib" --json
check "sim: a call finds its program" says '"510": 3'

# ---- programs into programs
for source in "$ram"/O9050-excerpt.nc "$pocket"/O{10,30,50}.ocr.nc; do
  case $source in
    "$ram"/*) profile=fanuc-31i-b ;;
    *) profile=fanuc-6m ;;
  esac
  dotek convert "$source" --to fanuc --control "$profile"
  check "convert $(basename "$source") for its own control" hasStatus 0
  cp "$out" "$scratch/once.nc"
  dotek convert "$scratch/once.nc" --to fanuc --control "$profile"
  check "convert $(basename "$source"): the result again is the same" diff "$scratch/once.nc" "$out"
  for number in $(grep -oE '^/?N *[0-9]+' "$source" | tr -dc '0-9\n'); do
    check "convert $(basename "$source"): N$number is still there" grep -qE "^/?N0*$((10#$number))([^0-9]|\$)" "$scratch/once.nc"
  done
done
nc $'GOTO#1\nN5M30'
dotek dump "$scratch/p.nc" --stage ir
check "a computed GOTO is not structured, and says why" says "not structured"
finish
