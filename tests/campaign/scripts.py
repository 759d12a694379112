"""Fusion fragments that were edited by hand, badly: verify says so, soon, and never that they agree."""

import pathlib
import re

from judge import ROOT

CALL = ["verify", str(ROOT / "examples/surface-x"), "--prog", str(ROOT / "examples/post.txt"), "--form", "thesis-a", "--to", "fusion",
        "--assume", "probe-on", "--cases", "20", "--limit", "script-seconds=2", "--limit", "script-memory=64", "--translation", "edited.js"]
ENTRY = "function surfaceX_write(x, y, z) {\n"

# Code at the beginning of the function that writes the cycle, and code after all of the fragment.
WITHIN = [
    "for (;;) {}", "while (true) { x += 1; }", "do {} while (true);", "var s = 'a'; for (;;) { s += s; }", "var a = []; for (;;) { a.push(a); }",
    "for (;;) { writeBlock('G0'); }", "for (;;) { writeln(x); }", "return null;", "throw 1;", "throw null;", "throw {toString: function () { throw 1; }};",
    "throw {get message() { for (;;) {} }};", "(function f() { f(); })();", "(function f() { return [f()]; })();", "writeBlock = null;",
    "var p = {get a() { throw new Error('x'); }}; p.a;", "/(a+)+$/.test(Array(40).join('a') + 'b');", "JSON.parse(Array(100000).join('['));",
    "eval('for (;;) {}');", "new Function('for (;;) {}')();", "x = undefined;", "y = {valueOf: function () { throw 2; }}; writeBlock('X' + y);",
    "writeBlock('X' + String.fromCharCode(0, 27, 0x202e, 0xd800));", "Array.prototype.push = function () { for (;;) {} };",
    "Object.defineProperty(this, 'writeBlock', {get: function () { throw 3; }});", "xOutput.format = function () { return {}; };", "let a = 1;",
    "const b = 2;", "var f = () => 1;", "class A {}", "var s = `a`;", "if (x > 0 {",
]
AFTER = [
    "surfaceX_write = null;", "surfaceX_write = function () { return null; };", "surfaceX_write = 5;", "surfaceX_write = {};",
    "function surfaceX_write() { surfaceX_write(); }", "properties = null;", "for (;;) {}", "throw 'end';", "surfaceX_dispatch = function () { for (;;) {} };",
    "function surfaceX_write() { return Object.create(null); }", "}", "\0", "delete surfaceX_write; var surfaceX_write;", "/*", "'use strict'; with (Math) {}",
]

# Changes nothing of what the fragment writes: `const` and `delete` as the engine takes them, what this fragment does
# not use.
HARMLESS = {
    "/(a+)+$/.test(Array(40).join('a') + 'b');", "x = undefined;", "xOutput.format = function () { return {}; };", "const b = 2;",
    "delete surfaceX_write; var surfaceX_write;", "'use strict'; with (Math) {}",
}


DRAWN = 30


def drawn(random, base):
    """The fragment with lines of its own moved, lost, doubled or damaged, and code of the lists in any place."""
    lines = base.split("\n")
    what = []
    for _ in range(random.choice([1, 2, 4])):
        at = random.randrange(len(lines))
        kind = random.choice(["swap", "lose", "double", "cut", "code", "number"])
        what.append(f"{kind} {at + 1}")
        if kind == "swap":
            other = random.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        elif kind == "lose":
            del lines[at]
        elif kind == "double":
            lines.insert(at, lines[at])
        elif kind == "cut":
            lines[at] = lines[at][: random.randrange(len(lines[at]) + 1)]
        elif kind == "code":
            lines.insert(at, random.choice(WITHIN + AFTER))
        else:
            lines[at] = re.sub(r"\d+", lambda found: random.choice([found[0], "0", "1e9", "-1", "NaN"]), lines[at])
        lines = lines or [""]
    return "\n".join(lines), ", ".join(what)


def run(judge, folder, random):
    folder = pathlib.Path(folder)
    made = [*CALL[1:6], "--to", "fusion", "--assume", "probe-on", "-o", "base.js"]
    fault = judge.run(["convert", *made], folder)
    base = (folder / "base.js").read_text() if fault is None else ""
    if ENTRY not in base:
        yield fault or "the fragment has no surfaceX_write", ["convert", *made], folder
        return
    texts = [base.replace(ENTRY, ENTRY + code + "\n") for code in WITHIN] + [base + "\n" + code + "\n" for code in AFTER]
    for code, text in zip(WITHIN + AFTER, texts):
        (folder / "edited.js").write_text(text, encoding="utf-8")
        before = judge.exits.get(0, 0)
        fault = judge.run(CALL, folder)
        harmless = code in HARMLESS
        if fault is None and not harmless and judge.exits.get(0, 0) > before:
            fault = "agrees"
        yield fault and f"{fault} ({code})", CALL, folder
    # Whether a drawn one still writes the same is not known here: it ends, and well.
    for _ in range(DRAWN):
        text, what = drawn(random, base)
        (folder / "edited.js").write_text(text, encoding="utf-8")
        fault = judge.run(CALL, folder)
        yield fault and f"{fault} ({what})", CALL, folder
