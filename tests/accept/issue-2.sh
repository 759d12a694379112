#!/usr/bin/env bash
# Issue 2: GibbsCAM macros and ComPost rules in, the posted program out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

cycles=$DOTEK_CORPUS/gibbs
prog=$DOTEK_CORPUS/compost/probe-routines.txt
required=$DOTEK_CORPUS/fanuc
folders=(MERENI.OSA.X MERENI.OSA.Y MERENI.OSA.Z MERENI.OSA.XYZ MERENI.STRED.OTVOR)

# The values of the issue.
valuesOf() {
  case $1 in
    MERENI.OSA.X) echo X=10 ;;
    MERENI.OSA.Y) echo Y=10 ;;
    MERENI.OSA.Z) echo Z=-10 ;;
    MERENI.OSA.XYZ) echo IB=10 JB=-10 IC=10 JC=10 ;;
    MERENI.STRED.OTVOR) echo D=30 X=30 Y=30 Zb=50 ;;
  esac
}

# The recorded blocks, each after its line number in the file.
recorded() {
  case $1 in
    MERENI.OSA.X) awk 'NR >= 15 && NR <= 23 { print NR ":" $0 }' "$required/required-x.nc" ;;
    MERENI.OSA.Y) awk '{ print NR ":" $0 }' "$required/required-y.nc" ;;
    MERENI.OSA.Z) awk '{ print NR ":" $0 }' "$required/required-z.nc" ;;
    MERENI.OSA.XYZ) awk '{ print NR ":" $0 }' "$required/required-xyz.nc" ;;
    MERENI.STRED.OTVOR) awk '{ print NR ":" $0 }' "$required/required-circle.nc" ;;
  esac
}

# Without N number, blanks around, and the line that names the cycle.
normalised() { sed -E 's/\r$//; s/^ *(N[0-9]+)? *//; s/ +$//; /^\(MERENI .*\)$/d'; }

# The rows of docs/post-differences.md for one cycle: `-LINE block` and `+block`, sorted.
allowed() {
  awk -F'|' -v cycle="$1" '
    function bare(text) { gsub(/^[ `]+|[ `]+$/, "", text); return text }
    NF >= 7 && bare($2) == cycle {
      if (bare($5) != "none") print "-" bare($4) " " bare($5)
      if (bare($6) != "none") print "+" bare($6)
    }' docs/post-differences.md | LC_ALL=C sort
}

# post CYCLE FLAGS...: the command of the issue with its values.
post() {
  local cycle=$1 value set=()
  shift
  for value in $(valuesOf "$cycle"); do set+=(--set "$value"); done
  dotek post "$cycles/$cycle" --prog "$prog" --routine defProbeCycle --seq 90:10 --clearance 5 "${set[@]}" "$@"
}

# sameButForTheList CYCLE: what was posted against the record.
sameButForTheList() {
  local line block
  recorded "$1" | while IFS=: read -r line block; do
    block=$(normalised <<<"$block")
    [[ -z $block ]] || printf '%s\t%s\n' "$line" "$block"
  done >"$scratch/numbered"
  cut -f2 "$scratch/numbered" >"$scratch/recorded"
  normalised <"$out" >"$scratch/posted"
  diff --old-line-format='-%dn %L' --new-line-format='+%L' --unchanged-line-format='' \
    "$scratch/recorded" "$scratch/posted" >"$scratch/diff" || :
  # diff counts in the cut-out: put the line numbers of the file back.
  awk -F'\t' 'NR == FNR { line[FNR] = $1; next }
    /^-/ { at = substr($0, 2); sub(/ .*/, "", at); rest = $0; sub(/^-[0-9]+ /, "", rest); print "-" line[at] " " rest; next }
    { print }' "$scratch/numbered" "$scratch/diff" | LC_ALL=C sort >"$scratch/found"
  diff -u --label listed --label found <(allowed "$1") "$scratch/found"
}

# N90, N100, ... without a gap.
countsFromNinety() {
  sed -nE 's/^ *N([0-9]+).*/\1/p' "$out" | awk '$1 != 80 + 10 * NR { print "N" $1 " at place " NR; bad = 1 } END { exit bad || NR == 0 }'
}

for cycle in "${folders[@]}"; do
  post "$cycle" --recover
  check "$cycle is posted" hasStatus 0
  check "$cycle: blocks as recorded, but for the list" sameButForTheList "$cycle"
  check "$cycle: sequence numbers" countsFromNinety
  check "$cycle: the repair is reported once" saysOnce open-if-at-return
  check "$cycle: the reading that was used" says "line 75"
  cp "$out" "$scratch/posted-$cycle"

  post "$cycle"
  check "$cycle without --recover is refused" hasStatus 1
  check "$cycle without --recover prints nothing" printsNothing
  check "$cycle without --recover: one error at the open IF" saysOnce open-if-at-return
  check "$cycle without --recover: where" says "probe-routines.txt:53:"
done

samePost() { cmp "$out" "$scratch/posted-$1"; }

dotek post "$cycles/MERENI.OSA.XYZ" --prog "$prog" --routine defProbeCycle --recover --seq 90:10 --clearance 5 \
  --set IB=10 JB=-10 IC=10 JC=10
check "several values after one --set" samePost MERENI.OSA.XYZ
dotek post "$cycles/MERENI.OSA.X" --prog "$prog" --recover --seq 90:10 --clearance 5 --set X=10
check "the routine that prints is found" samePost MERENI.OSA.X
dotek post "$cycles/MERENI.OSA.X" --prog "$prog" --routine defProbeCycle --recover --seq 90:10 --clearance 5 --field X=a
check "--field gives the post the macro's value" samePost MERENI.OSA.X
cp -r "$cycles/MERENI.OSA.X" "$scratch/renamed"
dotek post "$scratch/renamed" --cycle MERENI.OSA.X --prog "$prog" --routine defProbeCycle --recover --seq 90:10 \
  --clearance 5 --set X=10
check "--cycle names the cycle of another folder" samePost MERENI.OSA.X
post MERENI.OSA.X --recover -o "$scratch/x.nc"
check "-o writes the program" cmp "$scratch/x.nc" "$scratch/posted-MERENI.OSA.X"
post MERENI.OSA.X -o "$scratch/refused.nc"
check "a refused post leaves no file" test ! -e "$scratch/refused.nc"

dotek post "$scratch/renamed" --prog "$prog" --routine defProbeCycle --recover --clearance 5 --set X=10
check "a cycle that no branch tests is refused" hasStatus 1
check "a cycle that no branch tests prints nothing" printsNothing
dotek post "$cycles/MERENI.OSA.X" --prog "$prog" --routine defProbeCycle --recover --seq 90:10 --clearance 5
check "a field that nothing supplies is refused" hasStatus 1
check "a field that nothing supplies prints nothing" printsNothing
check "a field that nothing supplies: both files and the flag" says probe-routines.txt MERENI.OSA.X "--field X=a"
dotek post "$cycles/MERENI.OSA.Z" --prog "$prog" --routine defProbeCycle --recover --seq 90:10 --clearance 5
check "the label's unit and the variable's name do not matter" says "--field Z=d"
dotek post "$cycles/MERENI.OSA.XYZ" --prog "$prog" --routine defProbeCycle --recover --seq 90:10
check "no clearance: refused, the flag is named" says --clearance
check "no clearance: refused" hasStatus 1
dotek post "$cycles/MERENI.OSA.X" --prog "$prog" --routine defProbeCycle --recover --seq 90:10 --clearance 5 \
  --assume missing-field-zero
check "--assume missing-field-zero posts" hasStatus 0
check "--assume missing-field-zero prints 0 in the picture" says "G65 P9023 S56. X0 I0" "warning:"
dotek post "$cycles/MERENI.OSA.X" --prog "$prog" --routine defProbeCycle --recover --clearance 5 --set X=10 --set Zc=1
check "a name that nothing knows, with the nearest" hasStatus 1 2
check "a name that nothing knows, with the nearest: text" says Zc Zb
for value in 53 60; do
  post MERENI.OSA.X --recover --set G=$value
  check "G=$value does not pass the dialog" hasStatus 1
  check "G=$value prints nothing" printsNothing
done
post MERENI.STRED.OTVOR --recover --host tool_radius=15
check "a bore that is too small for the tool" hasStatus 1
post MERENI.STRED.OTVOR --recover --host tool_radius=3
check "a bore that the tool fits in" samePost MERENI.STRED.OTVOR

# lint, dump, explain, list
jsonArray() { [[ $(head -c 1 "$out") == "[" && $(tail -c 2 "$out") == "]" ]] || head -c 200 "$out"; [[ $(head -c 1 "$out") == "[" ]]; }
for cycle in "${folders[@]}"; do
  dotek lint "$cycles/$cycle"
  check "lint $cycle" hasStatus 0 1
  dotek lint "$cycles/$cycle" --format json
  check "lint $cycle as JSON" jsonArray
  for file in CycleData.dlg CycleData.mac DefineData.txt ToolPath.mac; do
    for stage in tokens ast; do
      dotek dump "$cycles/$cycle/$file" --stage "$stage"
      check "dump $cycle/$file --stage $stage" hasStatus 0
      check "dump $cycle/$file --stage $stage prints" printsSomething
    done
  done
done
dotek lint "$prog"
check "lint of the post fails at the open IF" hasStatus 1
check "lint of the post: once, at its place" saysOnce open-if-at-return
dotek dump "$prog" --stage ast
check "dump of the post shows the tree all the same" printsSomething
dotek explain open-if-at-return
check "explain" printsSomething
dotek explain no-such-code
check "explain of an unknown code" hasStatus 2
for what in forms limits hosts; do
  dotek list "$what"
  check "list $what" hasStatus 0
  check "list $what prints" printsSomething
done
dotek list forms
check "the default form is listed" says thesis-a
dotek
check "no command" hasStatus 2
dotek post "$cycles/no-such-folder" --prog "$prog"
check "no such folder" hasStatus 2

. tests/accept/bad-inputs-2.sh

printf 'post of one cycle: median %s ms, /bin/true %s ms (20 runs each, required under 12 ms)\n' \
  "$(medianMilliseconds "$DOTEK" post "$cycles/MERENI.OSA.X" --prog "$prog" --routine defProbeCycle --recover \
    --seq 90:10 --clearance 5 --set X=10)" "$(medianMilliseconds /bin/true)"
finish
