#!/usr/bin/env bash
# Issue 5, pictures: a program that measures a bore and then runs into the part is drawn as an SVG and as a page.
set -euo pipefail
# shellcheck source=tests/accept/checks.sh
source tests/accept/checks.sh

cat >"$scratch/probe.nc" <<'NC'
%
O1000
G90 G21 G17
G0 X-270. Y-160.
G0 Z-190.
G1 Z-228. F1000.
G31 X-240. F100.
G1 X-270. F1000.
G31 X-300. F100.
G1 X-270. F1000.
G1 Z-190. F1000.
G0 X-250.
G0 Z-225.
M30
%
NC
sed 's/^on = false/on = true/' examples/probe-machine.toml >"$scratch/machine.toml"

draw() { # OPTION FILE
  dotek sim "$scratch/probe.nc" --part examples/plate-part.toml --machine "$scratch/machine.toml" "$1" "$scratch/$2"
}

draw --svg first.svg
check "the run into the part is reported" says "[rapid-into-part]"
check "an SVG is written" test -s "$scratch/first.svg"
check "it is XML" python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$scratch/first.svg"
for text in 'id="XY"' 'id="XZ"' 'id="YZ"' 'id="legend"' 'id="scale"' 'class="rapid"' 'class="feed"' 'class="measuring"' '>E1<'; do
  check "the SVG has $text" grep -qF "$text" "$scratch/first.svg"
done
check "two contacts are numbered" grep -qF ">contact (2), numbered in order<" "$scratch/first.svg"
draw --svg second.svg
check "the same run gives the same SVG" cmp "$scratch/first.svg" "$scratch/second.svg"

draw --html page.html
cp "$out" "$scratch/trace"
check "a page is written" test -s "$scratch/page.html"
check "it needs no network" bash -c '! grep -qE "(src|href)=\"?(https?:|//)|@import|fetch\(" "$1"' - "$scratch/page.html"
used=0
bash tests/accept/page-in-chromium.sh "$scratch/page.html" >"$scratch/page.json" || used=$?
if ((used == 77)); then
  echo "skipped: the page in Chromium, which is not installed"
else
  check "the page works in Chromium" bash -c '(($1 == 0)) || { cat "$2"; exit 1; }' - "$used" "$scratch/page.json"
  check "its positions are those of the trace" python3 - "$scratch/trace" "$scratch/page.json" <<'PY'
import json, re, sys
trace = [["%.3f" % float(v) for v in re.findall(r"[XYZ](-?[\d.]+)", line)[-3:]]
         for line in open(sys.argv[1]) if re.match("rapid|feed|skip", line)]
shown = [step[4:] for step in json.load(open(sys.argv[2]))["shown"]]
if len(trace) < 10 or trace != shown:
    sys.exit(f"trace {trace}\npage  {shown}")
PY
fi
finish
