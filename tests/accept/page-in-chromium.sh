#!/usr/bin/env bash
# page-in-chromium.sh PAGE: loads a page of `--html` in headless Chromium and uses it as page-in-chromium.js says, in a
# narrow window, a dark one, and one of a desk. Prints what it found in the last as JSON, or in the first that fails. Exit status: 0 all holds, 1 something does not, 77 there is no Chromium.
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
# No window is narrower than 500: a frame is.
cat >"$scratch/narrow.html" <<'HTML'
<!DOCTYPE html><body><iframe src="page.html" style="width: 400px; height: 900px; border: 0"></iframe><script>
addEventListener("message", (event) => {
  const result = document.createElement("pre");
  result.id = "result";
  result.textContent = event.data;
  document.body.append(result);
});
</script></body>
HTML
look() { # WIDTH,HEIGHT FILE FLAG ..
  local size=$1 file=$2 status=0
  shift 2
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --no-first-run --user-data-dir="$scratch/profile" \
    --window-size="$size" --virtual-time-budget=60000 "$@" --dump-dom "file://$scratch/$file" \
    >"$scratch/dom" 2>"$scratch/log" </dev/null || status=$?
  result=$(sed -n 's|.*<pre id="result">\(.*\)</pre>.*|\1|p' "$scratch/dom")
  if ((status != 0)) || [[ -z $result ]]; then
    printf '%s gave no result in a window of %s (status %s)\n' "$browser" "$size" "$status"
    tail -n 5 "$scratch/log"
    exit 1
  fi
  if [[ $result != '{"faults":[],'* ]]; then
    printf '%s\n' "$result"
    exit 1
  fi
}
look 900,1000 narrow.html
[[ $result == *'"width":400,'* ]] || {
  echo "the narrow window is not 400 px wide: ${result:0:60}"
  exit 1
}
look 1280,800 page.html --blink-settings=preferredColorScheme=0
look 1280,800 page.html
printf '%s\n' "$result"
