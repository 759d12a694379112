#!/usr/bin/env bash
# Issue 3: a CAM probe cycle becomes a Fanuc macro program that is on its own.
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
  dotek convert "$cycles/$cycle" --prog "$prog" --recover --to fanuc $(mappingOf "$cycle") "$@"
}

# standsAlone: what any emitted program has to show, read from its text in $out.
standsAlone() {
  awk '
    function fail(what) { printf "line %d: %s: %s\n", NR, what, $0; bad = 1 }
    { raw = $0; code = $0; gsub(/\([^()]*\)/, "", code); gsub(/ /, "", code) }
    /[^ -~]/ { fail("a character outside ASCII") }
    NR == 1 && raw != "%" { fail("does not begin with %") }
    NR == 2 && raw !~ /^O[0-9]+ *\(/ { fail("no O number with a title") }
    { last = raw }
    code ~ /[()]/ { fail("brackets do not pair") }
    { open = gsub(/\[/, "[", code); shut = gsub(/\]/, "]", code); if (open != shut) fail("brackets do not pair") }
    code ~ /^N[0-9]+/ { n = code; sub(/^N/, "", n); sub(/[^0-9].*/, "", n); if (seen[n]++) fail("N twice") }
    code ~ /GOTO[0-9]+/ { n = code; sub(/.*GOTO/, "", n); wanted[n] = NR }
    code ~ /[XYZIJKRDF]-?[0-9]+([^0-9.]|$)/ && code !~ /^(O|#)/ { fail("a length without a point") }
    code ~ /^#(1[0-4][0-9]|50[0-9]|51[0-7])=/ { fail("an own value where the macros write") }
    code ~ /^G90G94G17G40G80$/ { modes = 1 }
    code ~ /^M99$/ { done = 1 }
    /G65 P[0-9]+/ && raw ~ /^\(/ { example = 1 }
    END {
      if (last != "%") { print "does not end with %"; bad = 1 }
      if (!modes) { print "the modes are not set"; bad = 1 }
      if (!done) { print "no M99"; bad = 1 }
      if (!example) { print "no call example"; bad = 1 }
      for (n in wanted) if (!seen[n]) { print "no N" n; bad = 1 }
      exit bad
    }' "$out"
}

for cycle in MERENI.OSA.X MERENI.OSA.Y MERENI.OSA.Z MERENI.OSA.XYZ MERENI.STRED.OTVOR; do
  for macros in easyprobe inspection-plus; do
    for control in fanuc-0i-md fanuc-31i-b fanuc-6m; do
      convert "$cycle" --probe-macros "$macros" --control "$control"
      if ((status == 0)); then
        check "$cycle, $macros, $control: is alone" standsAlone
        check "$cycle, $macros, $control: nothing on standard output but the program" says "M99"
      else
        check "$cycle, $macros, $control: refused" hasStatus 1
        check "$cycle, $macros, $control: with a reason at a place" says ": error: "
        check "$cycle, $macros, $control: nothing written" printsNothing
      fi
      printf '%s %s %s: %s\n' "$cycle" "$macros" "$control" "$( ((status == 0)) && echo converted || sed -n 's/.*error: \(.*\)/refused: \1/p' "$err" | head -n 1)"
    done
  done
  convert "$cycle"
  check "$cycle converts with the macros and control of its source" hasStatus 0
  [[ $control != fanuc-6m ]] || convert "$cycle" --control fanuc-6m
  check "$cycle: no IF..THEN on the 6M" bash -c '! grep -q THEN "$1"' _ "$out"
done

convert MERENI.OSA.X --probe-macros inspection-plus --host start_x=-10 --set a=10 --set I=0
check "from X-10 with travel 10 the target is X0." says "G65 P9811 X0."
check "and never X10." bash -c '! grep -q "P9811 X10" "$1"' _ "$out"
convert MERENI.OSA.X --set G=60
check "a value that fails the check is refused" hasStatus 1
check "a value that fails the check: nothing written" printsNothing
convert MERENI.OSA.X --field X=I
check "a field mapped twice is refused" hasStatus 1 2
check "a field mapped twice: nothing written" printsNothing
convert MERENI.STRED.OTVOR
check "a default that fails the check is a warning" saysOnce default-turned-away
for letter in G L N O P 7; do
  convert MERENI.OSA.X --arg "Zb=$letter"
  check "letter $letter is refused" hasStatus 1 2
  check "letter $letter: nothing written" printsNothing
done
convert MERENI.OSA.X --set a=12345678
check "a constant that does not fit its picture is refused" hasStatus 1

dotek convert "$cycles/MERENI.OSA.X" --to fanuc
check "a path that shows its touch converts without a Prog" hasStatus 0
check "a path that shows its touch: is alone" standsAlone
dotek convert "$cycles/MERENI.OSA.Z" --to fanuc
check "a path that does not show its touch is refused" hasStatus 1
check "at its line" says "ToolPath.mac:9:"
dotek convert "$cycles/MERENI.OSA.Z" --to fanuc --assume touch=MERENI.OSA.Z/ToolPath.mac:9
check "--assume touch=FILE:LINE overrides" hasStatus 0
dotek convert "$cycles/MERENI.STRED.OTVOR" --to fanuc
check "a bore without a Prog is refused at its line" says "ToolPath.mac:7:"
dotek dump "$cycles/MERENI.OSA.X" --prog "$prog" --recover --field X=a --stage ir
check "the IR is printed" says "measure"

time=$(medianMilliseconds "$DOTEK" convert "$cycles/MERENI.OSA.XYZ" --prog "$prog" --recover --to fanuc)
printf 'convert of one cycle: median %s ms (20 runs, required under 15 ms)\n' "$time"
check "converting a cycle takes under 15 ms" awk -v t="$time" 'BEGIN { exit !(t < 15) }'
memory=$( (command -v /usr/bin/time >/dev/null && /usr/bin/time -f %M "$DOTEK" convert "$cycles/MERENI.OSA.XYZ" --prog "$prog" --recover --to fanuc 2>&1 >/dev/null | tail -n 1) || echo 0)
[[ $memory == 0 ]] || check "converting a cycle takes under 30 MB" test "$memory" -lt 30720
finish
