#!/usr/bin/env bash
# Issue 6, Mikroprog: the five cycles become programs for a Mikroprog mill, equal to the sketches of the reference.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/accept/checks.sh

cycles=$DOTEK_CORPUS/gibbs
prog=$DOTEK_CORPUS/compost/probe-routines.txt
job=tests/accept/mikroprog/job.toml
hosts=(--clearance 5 --host tool_radius=3 --host overtravel=5 --host return_feed=1000)

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
  dotek convert "$cycles/$cycle" --prog "$prog" --recover --to mikroprog $(mappingOf "$cycle") "$@"
}

# blocks FILE: words of each block up to M30; comments, N and file names aside. A jump says how many blocks on its
# target is, or that it is the end, a subprogram, or which tail.
blocks() {
  tr -d '\r' <"$1" | awk '
    { sub(/ *;.*/, ""); if ($1 !~ /^N[0-9]+$/) next
      n = substr($1, 2) + 0; $1 = ""; sub(/^ /, ""); gsub(/@[^ ]*/, "@"); line[++k] = $0; at[n] = k; if ($0 == "M30") last = k }
    END { for (i = 1; i <= last; ++i) {
      text = line[i]
      if (match(text, /L[0-9]+/)) {
        to = substr(text, RSTART + 1, RLENGTH - 1) + 0
        kind = !(to in at) ? "nowhere" : at[to] > last ? "subprogram" : line[at[to]] == "M30" ? "end" : line[at[to]] == "M0" ? "tail" (at[to] - last) : at[to] - i
        text = substr(text, 1, RSTART) kind substr(text, RSTART + RLENGTH)
      }
      print text } }'
}

equalsSketch() {
  diff <(blocks "tests/accept/mikroprog/$1.suf") <(blocks "$out")
}

file=$scratch/crlf
onlyCrLf() { tr -d '\n' <"$out" | tr '\r' '\n' >"$file"; [[ $(wc -l <"$out") == $(wc -l <"$file") ]]; }
onlyAscii() { ! LC_ALL=C grep -q '[^ -~[:cntrl:]]' "$out"; }

declare -A points=([X]="-10 10" [Y]="10 -10" [Z]="10 10" [XYZ]="-10 10")
for axis in X Y Z XYZ; do
  sets=()
  [[ $axis != XYZ ]] || sets=(--set IB=10 --set JB=-10 --set IC=10 --set JC=10)
  read -r x y <<<"${points[$axis]}"
  for how in flags job; do
    if [[ $how == flags ]]; then
      convert "MERENI.OSA.$axis" --control mikroprog-mill "${hosts[@]}" --host "start_x=$x" --host "start_y=$y" "${sets[@]}"
    else
      convert "MERENI.OSA.$axis" --control mikroprog-mill --job "$job"
    fi
    check "$axis by $how converts" hasStatus 0
    check "$axis by $how equals its sketch" equalsSketch "$axis"
    check "$axis by $how: CR LF" onlyCrLf
    check "$axis by $how: ASCII" onlyAscii
    for code in moved-before guard-once offset-number-dropped feed-dropped questions-assumed; do
      check "$axis by $how: a note $code" says "[$code]"
    done
  done
  for host in tool_radius clearance overtravel return_feed start_x start_y; do
    given=()
    for each in tool_radius=3 clearance=5 overtravel=5 return_feed=1000 "start_x=$x" "start_y=$y"; do
      [[ $each == "$host="* ]] || given+=(--host "$each")
    done
    convert "MERENI.OSA.$axis" --control mikroprog-mill "${given[@]}"
    check "$axis without $host is refused" hasStatus 1
    check "$axis without $host: the flag is named" says "--host $host=VALUE"
    check "$axis without $host: nothing is written" printsNothing
  done
done

bore=("${hosts[@]}" --host start_x=30 --host start_y=30 --set D=30 --set X=30 --set Y=30 --set Zb=50)
convert MERENI.STRED.OTVOR "${bore[@]}"
check "the circle is refused" hasStatus 1
check "with the numbers of the questions" says Q10 Q13 Q7
convert MERENI.STRED.OTVOR "${bore[@]}" --assume Q10 --assume Q13 --assume Q7
check "--assume opens it" hasStatus 0
check "the circle equals its sketch" equalsSketch circle
convert MERENI.STRED.OTVOR "${bore[@]}" --datum operator
check "the operator's way needs no assumption" hasStatus 0
check "and sets nothing" bash -c '! grep -q "^N[0-9]* G92" "$1"' _ "$out"

convert MERENI.OSA.X "${hosts[@]}" --host start_x=-10 --host start_y=10
check "a cycle without Y: no control is guessed" says control-not-chosen
convert MERENI.OSA.Y "${hosts[@]}" --host start_x=10 --control mikroprog-s280
check "the lathe has no Y" says axis-missing
convert MERENI.OSA.X "${hosts[@]}" --host start_x=-10 --host start_y=10 --control mikroprog-mill --datum operator
check "--datum operator stops at the contact" says "M0 ;ZAPIS"
check "--datum operator sets nothing" bash -c '! grep -q "^N[0-9]* G92" "$1"' _ "$out"

for figures in "$DOTEK_CORPUS/mikroprog/figures.suf"; do
  dotek lint "$figures" --fail-on never
  check "lint reads the figures" hasStatus 0
  check "lint: the condition in a comment" says suf-condition-in-comment
  check "lint: the wrapped comment" says suf-word
  dotek dump "$figures"
  check "dump prints them" says "M=6" "T=2" "F=P6"
done
finish
