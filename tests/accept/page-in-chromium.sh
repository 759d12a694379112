#!/usr/bin/env bash
# page-in-chromium.sh PAGE: loads a page of `--html` in headless Chromium and uses it as page-in-chromium.js says.
# Prints what it found as JSON. Exit status: 0 all holds, 1 something does not, 77 there is no Chromium.
set -euo pipefail
page=${1:?the page}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
browser=""
for name in chromium chromium-browser google-chrome; do
  if command -v "$name" >/dev/null; then
    browser=$name
    break
  fi
done
if [[ -z $browser ]]; then
  echo "no Chromium is installed"
  exit 77
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
{
  # Timers run in virtual time, frames do not: a busy machine would end the run before it is done.
  sed 's|^<head>|&<script>window.requestAnimationFrame = (f) => setTimeout(f, 1);</script>|' "$page"
  printf '<script>\n'
  cat "$here/page-in-chromium.js"
  printf '</script>\n'
} >"$scratch/page.html"
status=0
timeout 120 "$browser" --headless --no-sandbox --disable-gpu --no-first-run --user-data-dir="$scratch/profile" \
  --window-size=1280,800 --virtual-time-budget=60000 --dump-dom "file://$scratch/page.html" \
  >"$scratch/dom" 2>"$scratch/log" </dev/null || status=$?
result=$(sed -n 's|.*<pre id="result">\(.*\)</pre>.*|\1|p' "$scratch/dom")
if ((status != 0)) || [[ -z $result ]]; then
  printf '%s gave no result (status %s)\n' "$browser" "$status"
  tail -n 5 "$scratch/log"
  exit 1
fi
printf '%s\n' "$result"
[[ $result == '{"faults":[],'* ]]
