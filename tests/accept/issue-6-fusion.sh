#!/usr/bin/env bash
# Issue 6: a CAM probe cycle becomes a part of a Fusion post.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

cycles=$DOTEK_CORPUS/gibbs
prog=$DOTEK_CORPUS/compost/probe-routines.txt

# What the issue maps: the post's field = the macro's variable.
mappingOf() {
  case $1 in
    MERENI.OSA.X) echo --field X=a ;;
    MERENI.OSA.Y) echo --field Y=b ;;
    MERENI.OSA.Z) echo --field Z=d ;;
  esac
}

# convert CYCLE FLAGS...
convert() {
  local cycle=$1
  shift
  # shellcheck disable=SC2046
  dotek convert "$cycles/$cycle" --prog "$prog" --recover --to fusion $(mappingOf "$cycle") "$@"
}

# isEs5: nothing that older engines lack.
isEs5() {
  ! sed 's/"\([^"\\]\|\\.\)*"//g; s|//.*||' "$out" | grep -nE '=>|`|\b(let|const|class|of)\b|\.includes\(|\.\.\.'
}

for cycle in MERENI.OSA.X MERENI.OSA.Y MERENI.OSA.Z MERENI.OSA.XYZ MERENI.STRED.OTVOR; do
  for macros in easyprobe inspection-plus; do
    convert "$cycle" --probe-macros "$macros" --host overtravel=10
    if ((status == 0)); then
      check "$cycle, $macros: ES5" isEs5
      check "$cycle, $macros: properties of operations" says 'scope: "operation"' 'type: "number"' 'type: "integer"'
      check "$cycle, $macros: errors are followed by return" awk '
        /error\(localize\(/ { getline next_line; if (next_line !~ /^ *return( true)?;$/) { print NR ": " $0; bad = 1 } } END { exit bad }' "$out"
      check "$cycle, $macros: never spatial" bash -c '! grep -q spatial "$1"' _ "$out"
    else
      check "$cycle, $macros: refused with a reason at a place" says ": error: "
      check "$cycle, $macros: nothing written" printsNothing
    fi
    printf '%s %s: %s\n' "$cycle" "$macros" "$( ((status == 0)) && echo converted || sed -n 's/.*error: \(.*\)/refused: \1/p' "$err" | head -n 1)"
  done
done
dotek convert "$cycles/MERENI.OSA.X" --to fusion
check "without a Prog it is refused" hasStatus 1
check "without a Prog nothing is written" printsNothing

if ! command -v node >/dev/null; then
  echo "skipped: no node here, the fragments are run by the unit tests alone"
  finish
  exit
fi

# run PREFIX JSON: the post in $out, NC text to $scratch/nc.
run() {
  node tests/accept/fusion-run.js backends/fusion/Kernel.js "$out" "$@" >"$scratch/nc"
}
# prints CYCLE PREFIX PROPERTIES BLOCK: the measuring block of Inspection Plus from (100, 50).
prints() {
  local cycle=$1 prefix=$2 properties=$3 block=$4
  convert "$cycle" --probe-macros inspection-plus --host overtravel=10 --whole-post
  run "$prefix" "{\"properties\": {$properties}, \"points\": [[100, 50, 0]], \"tool\": {\"diameter\": 6}, \"cycle\": {\"clearance\": 5}}"
  check "$cycle prints $block" grep -qxF "$block" "$scratch/nc"
}
prints MERENI.OSA.X mereniOsaX '"mereniOsaX_a": 7, "mereniOsaX_I": 107, "mereniOsaX_G": 54' 'G65 P9811 X107. Q10. S1.'
prints MERENI.OSA.Y mereniOsaY '"mereniOsaY_b": 7, "mereniOsaY_J": 57, "mereniOsaY_G": 54' 'G65 P9811 Y57. Q10. S1.'
prints MERENI.OSA.Z mereniOsaZ '"mereniOsaZ_C": -1, "mereniOsaZ_d": -4, "mereniOsaZ_K": -5, "mereniOsaZ_G": 54' 'G65 P9811 Z-5. Q10. S1.'
prints MERENI.STRED.OTVOR mereniStredOtvor \
  '"mereniStredOtvor_D": 40, "mereniStredOtvor_X": 100, "mereniStredOtvor_Y": 50, "mereniStredOtvor_G": 54' 'G65 P9814 D40. Q10. S1.'
prints MERENI.OSA.X mereniOsaX '"mereniOsaX_a": 7, "mereniOsaX_I": 108, "mereniOsaX_G": 54' \
  'error: MERENI.OSA.X: the start and the travel do not lead to the nominal in X; the macro would set another offset'

# samePost CYCLE PREFIX FIELD=VALUE...: the blocks of EasyProbe are those of `dotek post`, N numbers aside.
samePost() {
  local cycle=$1 prefix=$2 pair properties=
  shift 2
  for pair in "$@"; do properties+="${properties:+, }\"${prefix}_${pair%%=*}\": ${pair#*=}"; done
  convert "$cycle" --whole-post
  run "$prefix" "{\"properties\": {$properties}, \"points\": [[0, 0, 0]], \"tool\": {\"diameter\": 6}, \"cycle\": {\"clearance\": 5.25}}"
  # shellcheck disable=SC2046
  dotek post "$cycles/$cycle" --prog "$prog" --recover $(mappingOf "$cycle") --host clearance=5.25 tool_radius=3 --set "$@"
  sed -E 's/^ *(N[0-9]+)? *//' "$out" >"$scratch/posted"
  sed -E 's/^ *//; /^%$/d; /^G17 G21/d; /^M30$/d' "$scratch/nc" >"$scratch/fragment"
  check "$cycle: the fragment prints what post prints" diff "$scratch/posted" "$scratch/fragment"
}
samePost MERENI.OSA.X mereniOsaX a=-10.005 I=0.5 G=57 Z=-5.25 Zb=50
samePost MERENI.OSA.Y mereniOsaY b=11.5 J=-0.004 G=54 Z=-5 Zb=120
samePost MERENI.OSA.Z mereniOsaZ d=-10 C=9.999 K=0 G=59 Zb=50
samePost MERENI.OSA.XYZ mereniOsaXyz a=10 b=-10 c=-12.5 X=1 Y=2 Z=3 KA=-5 IB=7 JB=8 KB=-6 IC=20 JC=30 KC=10 G=55 Zb=50
samePost MERENI.STRED.OTVOR mereniStredOtvor D=40 X=1.25 Y=-1.255 G=56 Z=-5 Zb=5
finish
