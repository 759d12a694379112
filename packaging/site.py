#!/usr/bin/env python3
"""The documents as a static site: site.py --dotek PROGRAM --docs docs --out FOLDER. pandoc makes the HTML of each page; navigation, search
and the generated pages (commands, controls, cycles) are made here. Works from file://."""
import argparse
import html
import json
import os
import re
import shutil
import subprocess
import sys

GROUPS = [
    ("Tutorials", ["tutorials/my-first-cycle", "tutorials/convert-a-folder", "tutorials/lint-in-ci", "tutorials/run-a-program"]),
    ("How to", ["install", "run-my-macro", "editor", "ci", "data-files", "library"]),
    ("Reference", ["cli", "commands", "controls", "cycles-library", "rules/README", "cycles", "convert", "verify", "sim", "part", "pictures", "lint",
                   "diagnostics", "conversion-matrix"]),
    ("Languages and targets", ["compost", "gibbs", "macrob", "vendor-macros", "mikroprog", "fanuc", "fusion", "fusion-kernel", "cycle"]),
]

STYLE = """body{margin:0;font:16px/1.5 sans-serif;display:flex}nav{width:17em;flex:none;padding:1em;box-sizing:border-box;height:100vh;overflow:auto;
position:sticky;top:0;background:#f3f4f6;font-size:.9em}nav a{display:block;color:#123}nav a.here{font-weight:bold}main{padding:1em 2em;max-width:60em;
min-width:0}pre{background:#f3f4f6;padding:.7em;overflow:auto}table{border-collapse:collapse;display:block;overflow:auto}td,th{border:1px solid #ccc;
padding:.25em .5em;vertical-align:top;text-align:left}nav input{width:100%;box-sizing:border-box}img{max-width:100%}"""

SCRIPT = """const field=document.getElementById('search'),found=document.getElementById('found');
field.addEventListener('input',()=>{const words=field.value.toLowerCase().split(/\\s+/).filter(Boolean);found.replaceChildren();
if(!words.length)return;const hits=PAGES.map(p=>{const title=p.title.toLowerCase(),text=p.text;let score=0;
for(const w of words){const n=text.split(w).length-1;if(!n&&!title.includes(w))return null;score+=Math.min(n,20)+(title.includes(w)?50:0);}
return{p,score};}).filter(Boolean).sort((a,b)=>b.score-a.score).slice(0,20);
for(const{p}of hits){const a=document.createElement('a');a.href=ROOT+p.name+'.html';a.textContent=p.title;found.append(a);}
if(!hits.length)found.textContent='nothing found';});"""


def run(*command, text=None):
    done = subprocess.run(command, input=text, stdout=subprocess.PIPE, encoding="utf-8")
    if done.returncode != 0:
        sys.exit(f"site.py: {' '.join(command)} ended with {done.returncode}")
    return done.stdout


def generated(dotek):
    """Pages that the program makes."""
    return {name: run(dotek, "help", name) for name in ("commands", "controls", "cycles-library")}


def title_of(text, name):
    found = re.search(r"^# (.*)$", text, re.M)
    return found.group(1).replace("`", "") if found else os.path.basename(name)


def linked(body, name, pages):
    """Links to pages of the site lead to their HTML; those to other files of the sources are words."""
    def one(match):
        target, _, anchor = html.unescape(match.group(1)).partition("#")
        if "://" in target or not target:
            return match.group(0)
        path = os.path.normpath(os.path.join(os.path.dirname(name), target))
        if path.endswith(".md") and path[:-3] in pages:
            return f'<a href="{target[:-3]}.html{"#" + anchor if anchor else ""}">{match.group(2)}</a>'
        return match.group(2)
    return re.sub(r'<a\s+href="([^"]*)"[^>]*>(.*?)</a>', one, body, flags=re.S)


def anchored(body):
    """Anchors as they are in the page alone: pandoc counts headings that several pages have."""
    seen = {}

    def one(match):
        words = html.unescape(re.sub(r"<[^>]*>", "", match.group(3)))
        slug = re.sub(r"[^\w\s-]", "", words.lower()).strip().replace(" ", "-").replace("\n", "-")
        seen[slug] = seen.get(slug, 0) + 1
        number = f"-{seen[slug] - 1}" if seen[slug] > 1 else ""
        return f'<h{match.group(1)} id="{slug}{number}">{match.group(3)}</h{match.group(1)}>'

    return re.sub(r'<h([1-6])\s+id="([^"]*)"[^>]*>(.*?)</h\1>', one, body, flags=re.S)


def main():
    parser = argparse.ArgumentParser()
    for flag in ("--dotek", "--docs", "--out"):
        parser.add_argument(flag, required=True)
    given = parser.parse_args()
    pages = {}
    for folder, _, files in os.walk(given.docs):
        for file in sorted(files):
            if file.endswith(".md"):
                path = os.path.join(folder, file)
                with open(path, encoding="utf-8") as opened:
                    pages[os.path.relpath(path, given.docs)[:-3]] = opened.read()
    pages.update(generated(given.dotek))
    titles = {name: title_of(text, name) for name, text in pages.items()}
    listed = {name for _, names in GROUPS for name in names}
    rest = sorted(name for name in pages if "/" not in name and name not in listed)
    groups = GROUPS + [("How it is built and measured", rest)]
    for _, names in groups:
        for name in names:
            if name not in pages:
                sys.exit(f"site.py: no page {name}")
    shutil.rmtree(given.out, ignore_errors=True)
    # One call of pandoc for all: a marker between the pages.
    names = sorted(pages)
    marker = "PAGEBREAKOFTHESITE"
    bodies = run("pandoc", "-f", "gfm", "-t", "html", "--wrap=preserve", text=f"\n\n{marker}\n\n".join(pages[name] for name in names)).split(f"<p>{marker}</p>")
    if len(bodies) != len(names):
        sys.exit("site.py: pages run into one another")
    for name, body in zip(names, bodies):
        up = "../" * name.count("/")
        menu = "".join(f"<h4>{group}</h4>" + "".join(
            f'<a href="{up}{one}.html"{" class=here" if one == name else ""}>{html.escape(titles[one])}</a>' for one in inside) for group, inside in groups)
        page = (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(titles[name])} - Dotek</title>'
                f'<link rel="stylesheet" href="{up}site.css"></head><body><nav><a href="{up}index.html"><b>Dotek</b></a>'
                f'<input id="search" placeholder="search" aria-label="search"><div id="found"></div>{menu}</nav><main>{linked(anchored(body), name, pages)}</main>'
                f'<script>const ROOT="{up}";</script><script src="{up}pages.js"></script><script src="{up}site.js"></script></body></html>\n')
        path = os.path.join(given.out, name + ".html")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(page)
    index = [{"name": name, "title": titles[name], "text": re.sub(r"\s+", " ", pages[name]).lower()} for name in names]
    for name, text in (("site.css", STYLE), ("site.js", SCRIPT), ("pages.js", "const PAGES=" + json.dumps(index, ensure_ascii=False) + ";")):
        with open(os.path.join(given.out, name), "w", encoding="utf-8") as file:
            file.write(text + "\n")
    shutil.copy(os.path.join(given.docs, "picture-example.svg"), given.out)
    with open(os.path.join(given.out, "index.html"), "w", encoding="utf-8") as file:
        file.write('<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Dotek</title><meta http-equiv="refresh" content="0; '
                   'url=tutorials/my-first-cycle.html"><a href="tutorials/my-first-cycle.html">Dotek</a></html>\n')
    print(f"{len(names)} pages: {os.path.join(given.out, 'index.html')}")


if __name__ == "__main__":
    main()
