#!/usr/bin/env bash
# Issue 5: whether a translation does what its source does, on the cycles of the corpus.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

cases=${DOTEK_ACCEPT_CASES:-10000}
gibbs=$DOTEK_CORPUS/gibbs prog=$DOTEK_CORPUS/compost/probe-routines.txt

# longDotek ARGS...: as dotek, for runs of many cases.
longDotek() {
  status=0
  timeout 300 "$DOTEK" "$@" >"$out" 2>"$err" </dev/null || status=$?
}
# verify CYCLE ARGS...
verify() {
  local cycle=$1 field=()
  shift
  case $cycle in
    *.X) field=(--field X=a) ;;
    *.Y) field=(--field Y=b) ;;
    *.Z) field=(--field Z=d) ;;
  esac
  longDotek verify "$gibbs/$cycle" --prog "$prog" --recover "${field[@]}" "$@"
}
# lastIs VERDICT: of the drawn cases.
lastIs() { local last; last=$(tail -n 1 "$out"); [[ ${last%%; edge cases:*} == "$1" ]] || { printf 'last line: %s\n' "$(tail -n 1 "$out")"; head -n 20 "$err"; return 1; }; }
# at CODE LINE: one finding of the code, at this line of the Prog.
at() {
  grep -E ":$2:[0-9]+: (error|warning): .*\[$1\]$" "$err" >/dev/null || { printf 'nowhere: %s at %s\n' "$1" "$2"; head -n 20 "$err"; return 1; }
}

# ---- all macro sets: agrees, or refused by convert for the reason that convert tells
for set in easyprobe inspection-plus dotek; do
  for cycle in MERENI.OSA.X MERENI.OSA.Y MERENI.STRED.OTVOR; do
    verify "$cycle" --to fanuc --probe-macros "$set" --cases "$cases"
    check "$cycle, $set: all agree" lastIs "AGREES: $cases of $cases drawn cases"
    check "$cycle, $set: exit 0" hasStatus 0
    check "$cycle, $set: the move before the probe is on" saysOnce protected-while-off
  done
  for cycle in MERENI.OSA.Z MERENI.OSA.XYZ; do
    verify "$cycle" --to fanuc --probe-macros "$set" --cases 500
    check "$cycle, $set: the probe is never on" lastIs "UNDECIDED: 500 of 500 drawn cases"
    check "$cycle, $set: said once" saysOnce probe-never-on
    check "$cycle, $set: the move before the probe is on" saysOnce protected-while-off
    check "$cycle, $set: exit 1" hasStatus 1
    verify "$cycle" --to fanuc --probe-macros "$set" --cases "$cases" --assume probe-on
    check "$cycle, $set: all agree with the probe on" lastIs "AGREES: $cases of $cases drawn cases"
    check "$cycle, $set: exit 0" hasStatus 0
  done
done
verify MERENI.OSA.Z --to fanuc --cases 50
check "OSA.Z: at its first measure" at probe-never-on 49
verify MERENI.OSA.XYZ --to fanuc --cases 50
check "OSA.XYZ: at its first measure" at probe-never-on 61
check "OSA.XYZ: its first protected move" at protected-while-off 55
verify MERENI.OSA.X --to fanuc --cases 50
check "OSA.X: its first protected move" at protected-while-off 20
check "a finer value than the picture prints is reported" says "picture drops digits of Zb, Z, a, I:"

# ---- what the programmer saw against what the post prints
for cycle in MERENI.OSA.X MERENI.OSA.Y; do
  verify "$cycle" --cases 2000
  check "$cycle: the path is what is posted" lastIs "AGREES: 2000 of 2000 drawn cases"
done
verify MERENI.OSA.Z --cases 2000 --assume probe-on
check "OSA.Z: the path is what is posted" lastIs "AGREES: 2000 of 2000 drawn cases"
verify MERENI.OSA.XYZ --cases 500 --assume probe-on
check "OSA.XYZ: the path goes back to the start point, the post does not" says "ToolPath.mac:28:1: error: path differs" "against the end"
verify MERENI.STRED.OTVOR --cases 500
check "the hole cycle: differs" hasStatus 1
check "the hole cycle: retracts to a fixed height" says "ToolPath.mac:13:1: error: path differs" "probe-routines.txt:16:2: note: the post prints this here"
replay=$(sed -n 's/^dotek: note: replay: dotek //p' "$err" | head -n 1)
eval "longDotek $replay"
check "the command that is printed shows it again" lastIs "DIFFERS: 1 of 1 drawn cases"

# ---- without a Prog
longDotek verify "$gibbs/MERENI.OSA.X" --to fanuc --cases 200 --min-agreed 0
check "a path alone decides nothing" says "measurement not stated by the source"
# At edges the part may stop the probe where the path, which knows of no part, goes on.
check "a path alone: geometry agrees" says "it is the same in 200 of 200 cases"

# ---- speed: the XYZ cycle
begin=${EPOCHREALTIME/[.,]/}
verify MERENI.OSA.XYZ --to fanuc --cases 10000 --assume probe-on
took=$(((${EPOCHREALTIME/[.,]/} - begin) / 1000))
printf '10,000 cases of the XYZ cycle: %s ms (required under 5000 ms)\n' "$took"
check "10,000 cases of the XYZ cycle in 5 s" test "$took" -lt 5000

finish
