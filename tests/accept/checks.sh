# Sourced by tests/accept/issue-*.sh: runs dotek and counts what held.
# shellcheck shell=bash
: "${DOTEK:?the program}" "${DOTEK_CORPUS:?the corpus}"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0
failed=0

# check DESCRIPTION COMMAND...: the command's status decides; what it prints is shown where it fails.
check() {
  local what=$1
  shift
  if "$@" >"$scratch/check" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    printf 'FAIL %s\n' "$what"
    sed 's/^/     /' "$scratch/check" | head -n 40
  fi
}

# dotek ARGS...: standard output to $out, standard error to $err, exit status to $status (124: over 20 s).
out=$scratch/out err=$scratch/err status=0
dotek() {
  status=0
  timeout 20 "$DOTEK" "$@" >"$out" 2>"$err" </dev/null || status=$?
}

hasStatus() { # STATUS...
  local wanted
  for wanted in "$@"; do ((status != wanted)) || return 0; done
  printf 'exit status %s, not %s\n' "$status" "$*"
  cat "$err"
  return 1
}

printsNothing() { [[ ! -s $out ]] || { printf 'standard output is not empty:\n'; cat "$out"; return 1; }; }
printsSomething() { [[ -s $out ]] || { printf 'standard output is empty\n'; cat "$err"; return 1; }; }

# says TEXT...: each is in standard output or standard error.
says() {
  local text
  for text in "$@"; do
    grep -qF -- "$text" <(cat "$out" "$err") || { printf 'nowhere: %s\n' "$text"; cat "$out" "$err"; return 1; }
  done
}

# saysOnce CODE: one finding of this code, no more.
saysOnce() {
  local count
  count=$(cat "$out" "$err" | grep -cF -- "[$1]") || :
  ((count == 1)) || { printf '%s findings [%s], not 1\n' "$count" "$1"; cat "$out" "$err"; return 1; }
}

# Milliseconds of the median of 20 runs.
medianMilliseconds() {
  local begin end
  for _ in {1..20}; do
    begin=${EPOCHREALTIME/[.,]/}
    "$@" >/dev/null 2>&1 </dev/null || :
    end=${EPOCHREALTIME/[.,]/}
    printf '%d\n' $((end - begin))
  done | sort -n | awk '{ v[NR] = $1 } END { printf "%.1f", (v[10] + v[11]) / 2000 }'
}

finish() {
  printf '%d passed, %d failed\n' "$passed" "$failed"
  ((failed == 0))
}
