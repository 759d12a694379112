"""Inputs of all kinds, damaged at random, through every command that reads them."""

import json
import os
import pathlib
import re
import shutil

from judge import ROOT

TOKENS = [
    b"#", b"[", b"]", b"GOTO", b"IF", b"WHILE[1EQ1]DO1", b"END1", b"G65P9810", b"M99", b"(", b")", b'"', b"'", b"\0",
    b"\xff\xfe", b"\r", b"\n", b"9" * 30, b"-", b".", b"1e308", b"#0", b"O", b"%", b"{", b"}", b"END\n", b"CALL ",
    b"RETURN\n", b"SeqC ", b'dialog "x"', b'#INCLUDE "a.mac"', b"goto x", b"then", b"=", b"[[", b"\t", b"\xe2\x80\xae",
    b"\xc2\x9b", b"\x1b[2J", b"G31", b"DPRNT[X#1[2]]", b"NaN", b"inf", b"99999999999", b"function(){", b"while(true){",
    b"return null;", b"facet normal", b"[[lint.path]]", b"'''", b"L10", b"CC",
]
NUMBERS = [b"0", b"-1", b"1", b"54", b"9999", b"1e9", b"-0.001", b"4294967296", b".", b"1" * 400]


def damage(random, data):
    data = bytearray(data)
    for _ in range(random.choice([1, 1, 2, 3, 8, 30])):
        if not data:
            data = bytearray(b"x")
        at = random.randrange(len(data))
        kind = random.randrange(8)
        if kind == 0:
            data[at] = random.randrange(256)
        elif kind == 1:
            del data[at : at + random.choice([1, 2, 5, 40, 400])]
        elif kind == 2:
            data[at:at] = random.choice(TOKENS)
        elif kind == 3:
            other = random.randrange(len(data))
            data[at:at] = data[other : other + random.choice([3, 20, 200])]
        elif kind in (4, 5):
            lines = bytes(data).split(b"\n")
            line = random.randrange(len(lines))
            if kind == 5:
                del lines[line]
            elif random.random() < 0.1:
                random.shuffle(lines)
            else:
                lines.insert(random.randrange(len(lines) + 1), lines[line])
            data = bytearray(b"\n".join(lines))
        elif kind == 6:
            numbers = list(re.finditer(rb"-?\d+\.?\d*", bytes(data)))
            if numbers:
                one = random.choice(numbers)
                data[one.start() : one.end()] = random.choice(NUMBERS)
        else:
            data[at:at] = random.choice(TOKENS) * random.choice([1, 1, 1, 20, 300])
    return bytes(data)


def _files(folders, *endings):
    out = []
    for folder in folders:
        for ending in endings:
            out += [p for p in folder.rglob("*" + ending) if p.is_file() and p.stat().st_size < 60_000]
    return sorted(out)


PART = "material = \"block\"\n[[add]]\nshape = \"mesh\"\nfile = \"a.stl\"\nunit = \"mm\"\n"
HOSTS = ["--clearance", "5"]
for _name, _value in {"tool_radius": 3, "overtravel": 5, "return_feed": 500, "start_x": 1, "start_y": 2}.items():
    HOSTS += ["--host", f"{_name}={_value}"]


class Campaign:
    def __init__(self, judge, random, folder):
        corpus = pathlib.Path(os.environ.get("DOTEK_CORPUS", ROOT / "../shared/corpus"))
        folders = [ROOT / "examples", ROOT / "tests/golden"]
        self.judge, self.random, self.folder = judge, random, pathlib.Path(folder)
        self.nc = _files([*folders, corpus], ".nc", ".NC")
        self.suf = _files(folders, ".suf", ".SUF")
        self.toml = _files(folders, ".toml")
        self.stl = _files([ROOT / "tests"], ".stl")
        self.progs = [ROOT / "examples/post.txt", ROOT / "examples/mill-post.txt", *_files([corpus / "compost"], ".txt")]
        self.cycles = [p.parent for p in _files([*folders, corpus], "DefineData.txt")]
        self.cycle_files = _files([ROOT / "stdlib/cycles", *folders], ".cycle")
        self.posts = [p for p in _files([ROOT / "tests/golden/run-post", ROOT / "tests/fusion/posts"], ".cps")]
        self.post_jobs = _files([ROOT / "tests/golden/run-post"], "job.toml")
        self.translations = {}
        self.kinds = ([self.program] * 3 + [self.mikroprog, self.settings, self.part] + [self.cycle] * 5 +
                      [self.cycle_file] * 3 + [self.translation] * 2 + [self.post] * 2 + [self.server] * 2 + [self.baseline])

    def one(self, number):
        """Runs one damaged input; (what is wrong or None, arguments, folder)."""
        self.here = self.folder / str(number)
        self.here.mkdir()
        arguments, extra = self.random.choice(self.kinds)()
        fault = self.judge.run(arguments, self.here, **extra)
        if fault is None:
            fault = self.leftover()
        if fault is None:
            shutil.rmtree(self.here)
        return fault, arguments, self.here

    def leftover(self):
        left = [p.name for p in self.here.iterdir() if p.name.startswith(".dotek")]
        return f"leaves {left[0]}" if left else None

    def put(self, source, name, damaged=True):
        data = pathlib.Path(source).read_bytes()
        (self.here / name).write_bytes(damage(self.random, data) if damaged else data)

    def choose(self, *commands):
        command = self.random.choice(commands)
        extra = {}
        for flag, name in (("json", "findings"), ("sarif", "sarif"), ("gitlab", "gitlab"), ("--json", "outline" if "outline" in command else "sim")):
            if flag in command:
                extra["prints"] = name
        extra["files"] = [("m.json", "map"), ("r.json", "verify"), ("new.json", "baseline")]
        return command, extra

    def program(self):
        self.put(self.random.choice(self.nc), "a.nc")
        form = self.random.choice(["json", "sarif", "text"])
        return self.choose(
            ["lint", "a.nc"],
            ["lint", "--select", "all", "--format", form, "a.nc"],
            ["lint", "--fix", "a.nc"],
            ["sim", "a.nc"],
            ["sim", "--json", "a.nc", "--control", self.random.choice(["fanuc-0i-md", "fanuc-31i-b", "fanuc-6m"])],
            ["sim", "--svg", "o.svg", "--html", "o.html", "--quiet", "a.nc"],
            ["convert", "a.nc", "--to", "fanuc", "--probe-macros", "dotek"],
            ["convert", "a.nc", "--to", "fanuc", "--control", "fanuc-31i-b", "--map", "m.json", "-o", "o.nc"],
            ["verify", "a.nc", "--to", "fanuc", "--probe-macros", "dotek", "--cases", "5"],
            ["dump", "a.nc", "--stage", self.random.choice(["tokens", "ast", "ir"])],
            ["lint", "--from", "listing", "a.nc"],
            ["outline", "a.nc"],
            ["outline", "--json", "a.nc"],
            ["renumber", "a.nc"],
            ["renumber", "a.nc", "--all", "--step", self.random.choice(["1", "7", "100000"]), "-o", "-"],
            ["renumber", "a.nc", "--range", "10:100", "--start", "500", "-o", "o.nc"],
            ["fmt", "a.nc"],
            ["fmt", "--write", "a.nc"],
            ["fmt", "--diff", "a.nc"],
            ["lint", "--statistics", "a.nc"],
            ["lint", "--format", self.random.choice(["github", "gitlab"]), "a.nc"],
        )

    def mikroprog(self):
        self.put(self.random.choice(self.suf), "a.SUF")
        return self.choose(["lint", "--format", "json", "a.SUF"], ["sim", "a.SUF"], ["sim", "--json", "a.SUF"],
                           ["dump", "a.SUF", "--stage", self.random.choice(["tokens", "ast", "ir"])])

    def settings(self):
        self.put(self.random.choice(self.toml), "dotek.toml")
        self.put(self.random.choice(self.nc), "a.nc", damaged=False)
        cycle = self.random.choice(self.cycles)
        return self.choose(
            ["lint", "--format", "json", "a.nc"],
            ["sim", "a.nc", "--json", "--part", "dotek.toml", "--machine", ROOT / "examples/probe-machine.toml"],
            ["sim", "a.nc", "--json", "--machine", "dotek.toml"],
            ["sim", "--job", "dotek.toml", "--json", "a.nc"],
            ["post", cycle, "--prog", self.progs[0], "--form", "thesis-a", "--job", "dotek.toml"],
            ["check", self.cycle_files[0], "--format", "json"],
            ["list", "forms"],
            ["doc", "-o", "site"],
            ["new", "control", "shop", "--from", "fanuc-31i-b"],
            ["convert", cycle, "--prog", self.progs[0], "--form", "thesis-a", "--job", "dotek.toml", "--to", "mikroprog"],
        )

    def part(self):
        self.put(self.random.choice(self.stl), "a.stl")
        (self.here / "part.toml").write_text(PART)
        (self.here / "a.nc").write_text("%\nO1\nG90 G54 G0 X0 Y0\nG31 Z-5. F100.\nM30\n%\n")
        return self.choose(["sim", "a.nc", "--json", "--part", "part.toml", "--machine", ROOT / "examples/probe-machine.toml",
                            "--html", "o.html"])

    def cycle_base(self, damaged):
        folder = self.random.choice(self.cycles)
        shutil.copytree(folder, self.here / "c")
        prog = self.random.choice(self.progs)
        shutil.copy(prog, self.here / "p.txt")
        if damaged:
            names = ["p.txt"] + ["c/" + p.name for p in (self.here / "c").iterdir() if p.is_file()]
            target = self.here / self.random.choice(sorted(names))
            target.write_bytes(damage(self.random, target.read_bytes()))
        return folder, prog, ["c", "--prog", "p.txt", "--form", "thesis-a", "--cycle", folder.name, "--recover",
                              "--assume", "probe-on"]

    def cycle(self):
        _, _, base = self.cycle_base(True)
        form = self.random.choice(["json", "sarif", "text"])
        return self.choose(
            ["lint", "c", "p.txt", "--format", form],
            ["lint", "--select", "all", "c", "p.txt", "--format", form],
            ["post", *base, "--clearance", "5"],
            ["convert", *base, "--to", "fanuc"],
            ["convert", *base, "--to", "fanuc", "--probe-macros", "inspection-plus", "--map", "m.json", "-o", "o.nc"],
            ["convert", *base, "--to", "fusion", "--map", "m.json", "-o", "o.js"],
            ["convert", *base, "--to", "cycle"],
            ["convert", *base, "--to", "cycle", "-o", "o.cycle"],
            ["verify", *base, "--to", "cycle", "--cases", "4"],
            ["convert", *base, "--to", "mikroprog", "--control", "mikroprog-mill", *HOSTS],
            ["verify", *base, "--to", "fanuc", "--cases", "5"],
            ["verify", *base, "--to", "fusion", "--cases", "5"],
            ["verify", *base, "--to", "mikroprog", "--control", "mikroprog-mill", "--cases", "3"],
            ["verify", *base, "--cases", "5"],
            ["dump", "c", "--stage", "path"],
            ["preview", "c", "-o", "form.html"],
            ["preview", "c", *HOSTS],
            ["verify", *base, "--to", "fanuc", "--cases", "5", "-o", "r.json"],
        )

    def cycle_file(self):
        """A file of the cycle language, with the values that its parameters may get."""
        source = self.random.choice(self.cycle_files)
        self.put(source, source.name)
        name = source.name
        names = re.findall(r"^parameter ([a-z0-9_]+)", source.read_text(errors="replace"), re.M)
        sets = []
        for one in names:
            if self.random.random() < 0.8:
                sets += ["--set", f"{one}={self.random.choice(['5', '30mm', '-8', '1.2in', '45deg', 'G55', 'T5', 'yes', '1e9', 'x'])}"]
        return self.choose(
            ["check", name],
            ["check", "--format", self.random.choice(["json", "sarif"]), name],
            ["lint", "--select", "all", "--format", "json", name],
            ["fmt", name],
            ["fmt", "--write", name],
            ["verify", name, "--to", "fanuc", "--cases", "4", "-o", "r.json"],
            ["dump", name, "--stage", self.random.choice(["tokens", "ast", "ir"])],
            ["doc", name, "-o", "site"],
            ["sim", name, *sets, "--json"],
            ["sim", name, *sets, "--part", ROOT / "examples/plate-part.toml", "--json"],
            ["sim", name, *sets, "--svg", "o.svg", "--html", "o.html", "--quiet"],
            ["convert", name, "--to", "fanuc", "--probe-macros", self.random.choice(["dotek", "inspection-plus", "easyprobe"])],
            ["convert", name, "--to", "fanuc", "--control", "fanuc-0i-md", "--map", "m.json", "-o", "o.nc"],
            ["convert", name, "--to", self.random.choice(["mikroprog", "fusion"])],
            ["convert", name, "--to", "gibbs", "-d", "out", "--probe-macros", "dotek", "--host", "approach_feed=1000",
             *[word for one in names for word in ("--default", f"{one}={self.random.choice(['5', '30mm', 'G55', 'yes', '-8'])}")]],
            ["verify", name, "--to", "mikroprog", "--cases", "3"],
        )

    def translation(self):
        """A translation that is damaged after it was made."""
        folder, prog, base = self.cycle_base(False)
        to = self.random.choice(["fanuc", "fusion", "mikroprog"])
        more = ["--to", to] + (["--control", "mikroprog-mill"] if to == "mikroprog" else [])
        key = (folder, prog, to)
        if key not in self.translations:
            hosts = HOSTS if to == "mikroprog" else []
            self.judge.run(["convert", *base, *more, *hosts, "-o", "made"], self.here)
            made = self.here / "made"
            self.translations[key] = made.read_bytes() if made.exists() else b"%\nO1\nM30\n%\n"
        (self.here / "t").write_bytes(damage(self.random, self.translations[key]))
        more += HOSTS if to == "mikroprog" else []
        return self.choose(["verify", *base, *more, "--cases", "4", "--translation", "t"])

    def post(self):
        """A post of Fusion, or its job, damaged."""
        source = self.random.choice(self.posts)
        job = source.with_name("job.toml")
        broken = self.random.random() < 0.7
        self.put(source, "a.cps", damaged=broken)
        self.put(job if job in self.post_jobs else self.random.choice(self.post_jobs), "job.toml", damaged=not broken)
        limit = ["--limit", "script-seconds=2"]
        return self.choose(
            ["run-post", "a.cps", "job.toml", *limit],
            ["run-post", "a.cps", "job.toml", *limit, "--map", "m.json", "-o", "o.nc"],
            ["run-post", "a.cps", "--matrix", self.random.choice(["probing", "drilling"]), *limit],
            ["run-post", "a.cps", "job.toml", "--diff", source, *limit],
            ["new", "job", "--from", "a.cps", *limit],
            ["lint", "--select", "all", "--format", "json", "a.cps"],
            ["dump", "a.cps", "--stage", self.random.choice(["tokens", "ast"])],
        )

    def baseline(self):
        """A list of findings, damaged."""
        self.put(self.random.choice(self.nc), "a.nc", damaged=False)
        self.judge.run(["lint", "a.nc", "--select", "all", "--write-baseline", "b.json"], self.here)
        listed = self.here / "b.json"
        if listed.exists():
            listed.write_bytes(damage(self.random, listed.read_bytes()))
        return self.choose(["lint", "a.nc", "--select", "all", "--baseline", "b.json", "--format", "json"],
                           ["lint", "a.nc", "--baseline", "b.json", "--write-baseline", "new.json"])

    def server(self):
        """A conversation with the language server: a document, edits, questions; messages or the stream are damaged."""
        source = self.random.choice(self.random.choice([self.nc, self.cycle_files, self.posts, self.suf]))
        text = source.read_text(errors="replace")[:20_000]
        uri = (self.here / source.name).as_uri()
        here = {"textDocument": {"uri": uri}}

        def place():
            return {"line": self.random.randrange(60), "character": self.random.randrange(40)}

        talk = [{"id": 0, "method": "initialize", "params": {"capabilities": {}}}, {"method": "initialized", "params": {}},
                {"method": "textDocument/didOpen",
                 "params": {"textDocument": {"uri": uri, "languageId": "nc", "version": 1, "text": text}}}]
        for number in range(self.random.choice([3, 10, 30])):
            if self.random.random() < 0.5:
                begin = place()
                end = {"line": begin["line"] + self.random.randrange(3), "character": self.random.randrange(40)}
                talk.append({"method": "textDocument/didChange", "params": {
                    "textDocument": {"uri": uri, "version": number + 2},
                    "contentChanges": [{"range": {"start": begin, "end": end},
                                        "text": self.random.choice(TOKENS).decode("utf-8", "replace")}]}})
            else:
                method = self.random.choice(["hover", "definition", "references", "documentHighlight", "prepareRename", "rename",
                                             "documentSymbol", "inlayHint", "completion", "codeAction", "codeLens", "formatting"])
                talk.append({"id": number + 1, "method": "textDocument/" + method, "params": {
                    **here, "position": place(), "newName": "77", "range": {"start": place(), "end": place()},
                    "context": {"diagnostics": [], "includeDeclaration": True}, "options": {}}})
        talk += [{"id": 999, "method": "shutdown"}, {"method": "exit"}]
        bodies = [json.dumps({"jsonrpc": "2.0", **one}).encode() for one in talk]
        kind = self.random.randrange(3)
        if kind == 1:
            at = self.random.randrange(len(bodies))
            bodies[at] = damage(self.random, bodies[at])
        stream = b"".join(b"Content-Length: %d\r\n\r\n%s" % (len(body), body) for body in bodies)
        if kind == 2:
            stream = damage(self.random, stream)
        (self.here / "talk").write_bytes(stream)
        return ["lsp"], {"stdin": "talk"}
