#!/usr/bin/env bash
# Issue 6, verify: the corpus cycles agree on Mikroprog and Fusion, the examples as well.
set -euo pipefail
# shellcheck source=tests/accept/checks.sh
source tests/accept/checks.sh

cycles=$DOTEK_CORPUS/gibbs
prog=$DOTEK_CORPUS/compost/probe-routines.txt

# What the source of a cycle needs: mapping of fields, who switches the probe on.
needsOf() {
  case $1 in
    MERENI.OSA.X) echo --field X=a ;;
    MERENI.OSA.Y) echo --field Y=b ;;
    MERENI.OSA.Z) echo --field Z=d --assume probe-on ;;
    MERENI.OSA.XYZ) echo --assume probe-on ;;
  esac
}

# verify CYCLE FLAGS...
verify() {
  local cycle=$1
  shift
  # shellcheck disable=SC2046
  dotek verify "$cycles/$cycle" --prog "$prog" --recover $(needsOf "$cycle") "$@"
}

# agrees N LEAST: nothing differs of N, edges neither, and LEAST at least agree.
agrees() {
  local last
  last=$(tail -n 1 "$out")
  [[ $last =~ ^AGREES:\ ([0-9]+)\ of\ $1\ drawn\ cases ]] && ((BASH_REMATCH[1] >= $2)) &&
    [[ $last == *"; edge cases: "*" of $(($1 / 10))"* && $last != *differ* ]] && hasStatus 0 || { cat "$out" "$err"; return 1; }
}

measured() { # WHAT CASES
  local begin=${EPOCHREALTIME/[.,]/}
  "${@:3}"
  printf '%s: %s cases a second\n' "$1" $(($2 * 1000000 / (${EPOCHREALTIME/[.,]/} - begin)))
}

for axis in X Y Z XYZ; do
  measured "MERENI.OSA.$axis on Mikroprog" 2000 verify "MERENI.OSA.$axis" --to mikroprog --control mikroprog-mill --cases 2000
  # Two cases of thousand may lie where the corrected path of XYZ meets the part.
  check "MERENI.OSA.$axis agrees on Mikroprog" agrees 2000 1995
  verify "MERENI.OSA.$axis" --to mikroprog --control mikroprog-mill --cases 500 --datum operator --seed 2
  check "MERENI.OSA.$axis agrees with an operator's datum" agrees 500 500
done
for axis in X Z; do
  verify "MERENI.OSA.$axis" --to mikroprog --control mikroprog-s280 --cases 500
  check "MERENI.OSA.$axis agrees on the lathe" agrees 500 500
done
verify MERENI.STRED.OTVOR --to mikroprog --cases 20
check "the bore is refused" hasStatus 1
check "the bore is refused with its questions" says "--assume Q7" "--assume Q10" "--assume Q13"
questions=(--assume Q7 --assume Q10 --assume Q13)
verify MERENI.STRED.OTVOR --to mikroprog "${questions[@]}" --cases 2000
check "the bore agrees with its questions assumed" agrees 2000 2000
verify MERENI.STRED.OTVOR --to mikroprog --datum operator --cases 500
check "the bore agrees with an operator's datum" agrees 500 500
verify MERENI.OSA.X --to mikroprog --cases 20
check "a cycle without Y names the two controls" says "mikroprog-mill" "mikroprog-s280"
verify MERENI.OSA.XYZ --to mikroprog --cases 300 --job tests/accept/mikroprog/job.toml
check "a job is taken" agrees 300 285

for cycle in MERENI.OSA.X MERENI.OSA.Y MERENI.OSA.Z MERENI.OSA.XYZ MERENI.STRED.OTVOR; do
  measured "$cycle on Fusion" 1000 verify "$cycle" --to fusion --cases 1000
  check "$cycle agrees on Fusion" agrees 1000 1000
  for set in inspection-plus dotek; do
    verify "$cycle" --to fusion --probe-macros "$set" --cases 300
    check "$cycle agrees on Fusion with $set" agrees 300 300
  done
done

while read -r cycle x y; do
  dotek verify "examples/$cycle" --prog examples/mill-post.txt --to fusion --host "start_x=$x" --host "start_y=$y" --cases 200
  check "examples/$cycle agrees on Fusion" agrees 200 200
done <<'EXAMPLES'
surface-x -15 10
surface-y 10 15
surface-z 20 20
corner-xyz -15 10
bore 50 40
EXAMPLES
dotek verify examples/surface-x --prog examples/post.txt --to mikroprog --control mikroprog-mill --cases 500
check "examples/surface-x agrees on Mikroprog" agrees 500 500
finish
