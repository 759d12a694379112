#!/usr/bin/env bash
# Issue 16: each cycle of the library agrees with its program for every macro set and control that it converts
# to, 2,000 cases (CASES says otherwise); and the measured truth with noise, 2,000 runs of each cycle.
set -euo pipefail
# shellcheck source=tests/accept/checks.sh
source tests/accept/checks.sh

cases=${CASES:-2000}
# Codes of a probe where neither profile nor macro set has them.
codes=(--probe-on M97 --probe-off M96)

# agrees FILE FLAGS...: everything that is drawn agrees, edge cases too.
agrees() {
  timeout 600 "$DOTEK" verify "$@" --cases "$cases" >"$out" 2>"$err" </dev/null || { cat "$out" "$err"; return 1; }
  [[ $(tail -n 1 "$out") == AGREES:* ]] || { cat "$out" "$err"; return 1; }
}

# A reason of the cycle, the set or the control; not that a flag of this script is wrong.
refusedForItself() {
  says "error:" && ! grep -qF '[probe-code' "$err"
}

for file in stdlib/cycles/*.cycle; do
  grep -q '^cycle ' "$file" || continue # options do nothing
  name=$(basename "$file" .cycle)
  converted=0
  for set in easyprobe inspection-plus dotek; do
    for control in fanuc-0i-md fanuc-31i-b fanuc-6m; do
      flags=(--to fanuc --probe-macros "$set" --control "$control")
      [[ $control == fanuc-0i-md && $set != easyprobe ]] || flags+=("${codes[@]}")
      dotek convert "$file" "${flags[@]}"
      if ((status != 0)); then
        check "$name is refused for $set on $control with a reason" refusedForItself
        continue
      fi
      converted=$((converted + 1))
      check "$name agrees for $set on $control" agrees "$file" "${flags[@]}"
    done
  done
  printf '%s: %s programs\n' "$name" "$converted"
done

if [[ -x build/release/dotek_tests ]]; then
  check "results of noisy touches" env DOTEK_NOISY_RUNS=2000 build/release/dotek_tests '-tc=measured truth*'
fi
finish
