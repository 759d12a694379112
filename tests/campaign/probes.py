"""Files, streams, limits and signals: what is written is whole or absent, what fails says so."""

import os
import pathlib
import re
import shutil
import subprocess

from judge import ROOT

POST = f"{ROOT}/tests/golden/run-post/formats/post.cps"
JOB = f"{ROOT}/tests/golden/run-post/formats/job.toml"
CYCLE = f"{ROOT}/examples/surface-x --prog {ROOT}/examples/post.txt --form thesis-a"
COMMANDS = {
    "version": "--version", "help": "convert --help", "limits": "list limits", "rules": "list rules", "explain": "explain jump-to-itself",
    "lint": "lint p.nc", "sarif": "lint p.nc --format sarif", "sim": "sim p.nc", "json": "sim --json p.nc", "dump": "dump p.nc",
    "post": f"post {CYCLE} --clearance 5", "convert": f"convert {CYCLE} --to fanuc", "fusion": f"convert {CYCLE} --to fusion",
    "verify": f"verify {CYCLE} --to fusion --assume probe-on --cases 5", "new": f"new form shop --prog {ROOT}/examples/post.txt",
    "fanuc": f"verify {CYCLE} --to fanuc --assume probe-on --cases 100", "check": f"check {ROOT}/examples/cycles/bore.cycle --format json",
    "fmt": f"fmt {ROOT}/examples/cycles/bore.cycle", "doc": "doc", "preview": f"preview {ROOT}/examples/surface-x", "new cycle": "new cycle spare",
    "new control": "new control shop --from fanuc-31i-b", "cycles": "list cycles", "cycle": f"convert {ROOT}/examples/cycles/bore.cycle --to fanuc",
    "run-post": f"run-post {POST} {JOB}", "matrix": f"run-post {ROOT}/tests/golden/run-post/matrix/mill.cps --matrix drilling", "new job": f"new job --from {POST}",
    "outline": "outline p.nc", "outline json": "outline --json p.nc", "renumber": "renumber p.nc -o -", "fmt nc": "fmt p.nc", "fmt diff": "fmt --diff p.nc",
    "to cycle": f"convert {CYCLE} --to cycle",
    "statistics": "lint --statistics p.nc", "github": "lint --format github p.nc", "gitlab": "lint --format gitlab p.nc", "lsp": "lsp < talk",
    "gibbs": f"convert {ROOT}/examples/cycles/bore.cycle --to gibbs --probe-macros dotek --host approach_feed=1000 --default diameter=30 -d made",
}
# Put before the command: a limit that may or may not be enough.
LIMITS = [
    "ulimit -v 20000", "ulimit -v 40000", "ulimit -v 80000", "ulimit -v 200000", "ulimit -n 3", "ulimit -n 4", "ulimit -n 8", "ulimit -u 1",
    "ulimit -s 64", "ulimit -s 200", "ulimit -Ss 64", "ulimit -s unlimited", "ulimit -f 0", "ulimit -f 1", "ulimit -c 0", "ulimit -l 0",
]


def bearable(limit, program):
    """Of memory at least what the program itself takes in it: with less the system ends the process before it begins."""
    if not limit.startswith("ulimit -v "):
        return limit
    return f"ulimit -v {max(int(limit.split()[-1]), pathlib.Path(program).stat().st_size // 1024 + 1024)}"


STREAMS = {"> /dev/full": 2, ">&-": 2, "<&-": None, "2>&-": None, "2> /dev/full": None, "<&- 2>&-": None, "| head -c 1 > /dev/null": None}
# Files that a command writes, and how it writes them.
WRITERS = {
    "-o": f"convert {CYCLE} --to fanuc -o OUT", "--map": f"convert {CYCLE} --to fanuc -o o.nc --map OUT", "--trace": "sim big.nc --trace OUT",
    "--svg": "sim p.nc --quiet --svg OUT", "--html": "sim p.nc --quiet --html OUT", "new": f"new form shop --prog {ROOT}/examples/post.txt -o OUT --force",
    "--fix": "lint OUT --fix", "preview": f"preview {ROOT}/examples/surface-x -o OUT", "fmt": f"fmt {ROOT}/examples/cycles/bore.cycle -o OUT",
    "report": f"verify {CYCLE} --to fanuc --assume probe-on --cases 20 -o OUT", "new control": "new control shop --from fanuc-31i-b -o OUT",
    "run-post": f"run-post {POST} {JOB} -o OUT", "post map": f"run-post {POST} {JOB} -o o.nc --map OUT", "new job": f"new job --from {POST} -o OUT",
    "renumber": "renumber p.nc -o OUT", "fmt nc": "fmt p.nc -o OUT", "in place": "renumber --all OUT", "write": "fmt --write OUT",
    "to cycle": f"convert {CYCLE} --to cycle -o OUT",
}
NAMES = ["a\x1b[2Jb.nc", "a\nb.nc", "a\u202eb.nc", "a\u009bb.nc", "-a.nc", " .nc", "a'b.nc", "a\"b.nc", "a%sb.nc", "\u00e9.nc", "a\x7f.nc", "x" * 250 + ".nc"]
# Files that hold nothing, or next to nothing, as each kind of input.
EMPTY = ["", "\n", "\n\n", "%", "%\n%\n", "(C)\n", "O1\n", " ", "\0", "\ufeff"]
EMPTY_NAMES = {
    "e.nc": ["lint", "flatten", "sim", "sim --programs .", f"sim --json --device {ROOT}/examples/ram-compensation/device.toml", "sim --call D1.", "dump",
             "dump --stage ir", "convert --to fanuc", "verify --to fanuc --cases 2", "verify p.nc --to fanuc --cases 2 --translation", "renumber -o -", "fmt",
             "outline", "outline --json", "sim --svg s --quiet"],
    "e.SUF": ["lint", "sim", "dump", "dump --stage ir", "convert --to fanuc"], "e.mac": ["lint", "dump"], "e.dlg": ["lint", "dump"],
    "e.txt": ["lint --from prog", "dump --from prog", f"post {ROOT}/examples/surface-x --prog", "new form f --prog"],
    "e.cycle": ["check", "fmt", "sim", "dump", "dump --stage ir", "doc", "convert --to fanuc", "verify --to fanuc --cases 2"],
    "e.cps": ["lint", "dump", "new job --from", "run-post --matrix probing"],
    "e.toml": ["lint", "sim p.nc --part", "sim p.nc --machine", "sim p.nc --device", "sim p.nc --job", "lint p.nc --baseline", f"run-post {POST}", "lint p.nc --control"],
    "e.stl": ["lint"],
}
# An error that ends a command before it has a result; what it was to write stays.
EARLY = ["--job bad.toml", "--part bad.toml", "--machine bad.toml", "--translation nosuch", "--routine nosuch", "--limit steps=1", "--data nosuch", "--baseline nosuch",
         "--device bad.toml", "--prog nosuch", "--form nosuch", "--control nosuch", ""]
# Pairs of a flag and what is wrong with it, of commands that print a document.
WRONG = ["--nosuch", "--encoding x", "--control x", "--data nosuch", "--limit x", "--select nosuch", "--set x", "--statistics", "--write-baseline p.nc", "-o p.nc", "--svg p.nc",
         "--baseline nosuch", "nosuch", "- --stdin-filename x.nc <&-"]
DOCUMENTS = {"sim --json": "sim", "outline --json": "outline", "lint --format json": "findings", "lint --format sarif": "sarif", "lint --format gitlab": "gitlab",
             "check --format json": "findings"}
# Commands, of which each flag that takes a value gets one that names nothing.
FLAGS = ["lint p.nc", "sim p.nc", "dump p.nc", "dump sx", "dump sx --stage path", "dump sx --stage ir --prog post.txt", "convert p.nc --to fanuc", "verify p.nc --to fanuc --cases 2",
         "flatten p.nc", "renumber p.nc -o -", "outline p.nc", "fmt p.nc", "check bore.cycle", "sim bore.cycle", "doc bore.cycle", "preview sx", f"run-post {POST} {JOB}",
         "post sx --prog post.txt --form thesis-a --clearance 5", "convert sx --prog post.txt --form thesis-a --to fanuc"]
# What takes any text, writes a file of that name, or looks for nothing where nothing is missing.
ANY = ["--remark", "--date", "--stdin-filename", "--map", "--trace", "--svg", "--html", "--report", "--helpers", "--write-baseline", "--help"]
TALK = b"".join(b"Content-Length: %d\r\n\r\n%s" % (len(body), body) for body in (
    b'{"id":1,"method":"initialize","params":{"capabilities":{}}}', b'{"id":2,"method":"shutdown"}', b'{"method":"exit"}'))
OLD = "%\nO1\nN1 GO X1.\nM30\n%\n"


class Probe:
    def __init__(self, judge, folder):
        self.judge, self.folder = judge, folder
        self.count = 0

    def bash(self, script):
        try:
            done = subprocess.run(["bash", "-c", f"dotek() {{ '{self.judge.dotek}' \"$@\"; }}\n{script}"], cwd=self.here, timeout=self.judge.limit,
                                  stdin=subprocess.DEVNULL, capture_output=True)
        except subprocess.TimeoutExpired:
            return None
        self.judge.exits[done.returncode] = self.judge.exits.get(done.returncode, 0) + 1
        return done

    def fresh(self):
        self.count += 1
        self.here = self.folder / str(self.count)
        self.here.mkdir()
        (self.here / "p.nc").write_text(OLD)
        (self.here / "talk").write_bytes(TALK)
        (self.here / "big.nc").write_text("%\nO1\n" + "G1 X1. F100.\nX2.\n" * 60_000 + "M30\n%\n")

    def fault(self, script, statuses, more=lambda done: None):
        """`statuses` that are right, and `more` that has to hold of the run."""
        done = self.bash(script)
        if done is None:
            return f"does not end within {self.judge.limit:g} s"
        if done.returncode not in statuses:
            return f"exit status {done.returncode}: {done.stderr[-200:].decode('latin1')}"
        for word in (b"Sanitizer", b"runtime error", b"terminate called", b"defect of Dotek"):
            if word in done.stderr:
                return "defect: " + done.stderr[-300:].decode("latin1")
        left = [p.name for p in self.here.iterdir() if p.name.startswith(".dotek")]
        if left:
            return f"leaves {left}"
        return more(done)


def whole(probe, command):
    """What OUT is after the command without any hindrance."""
    probe.fresh()
    (probe.here / "OUT").write_text(OLD)
    probe.bash("dotek " + command + " --force")
    return (probe.here / "OUT").read_bytes()


def kept(probe, new, name="OUT"):
    def check(done):
        path = probe.here / name
        if not path.exists():
            return f"{name} is gone"
        data = path.read_bytes()
        if data not in (OLD.encode(), new):
            return f"{name} is neither what it was nor complete ({len(data)} bytes)"
        if done.returncode == 0 and data != new:
            return f"says that it wrote {name} and did not"
        return None

    return check


def quiet_names(done):
    """No byte of a file's name that acts on a terminal."""
    text = (done.stdout + done.stderr).decode("utf-8", "replace").replace("\n", " ")
    bad = [c for c in text if ord(c) < 32 or 127 <= ord(c) < 160 or c in "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u200e\u200f\u061c"]
    return f"prints {bad[0]!r} of a name" if bad else None


FORGED = "a\x1b[31m\u202e\nfake"  # as a name and as a text


def quiet_texts(done):
    """The same, and no line of its own."""
    return quiet_names(done) or ("a name begins a line" if b"\nfake" in done.stdout + done.stderr else None)


def texts(probe):
    """Names and texts of inputs and flags, in lists, tables, dumps and files that are begun."""
    quoted = "'" + FORGED + "'"
    for folder in ("list", "forms", "posts"):
        (probe.here / folder).mkdir()
    (probe.here / "list" / (FORGED + ".xyz")).write_bytes(b"\1\2")
    (probe.here / "list" / "p.nc").write_text("%\nO1\nG0 X1. (A\x1b[31m\u202e)\n#500=1.\n#3006=1(A\x1b[31mB)\nM30\n%\n")
    (probe.here / "forms" / (FORGED + ".txt")).write_text("progStart:\n SeqC SpinOff EOL\nRETURN\n")
    text = "a\\u001b[31m\\u202e\\nfake"
    post = (f"properties = {{a: {{title: '{text}', type: 'boolean', value: true}}}};\n"
            f"function onOpen() {{ warning('{text}'); writeln('{text}'); }}\nfunction onCyclePoint() {{ error('{text}'); }}\n")
    for name in ("post", "posts/" + FORGED):
        (probe.here / (name + ".cps")).write_text(post)
    return ["lint list", "lint --list-skipped list", "lint --format sarif list", "lint --format github list", "lint --quiet list", "dump --stage tokens list/p.nc",
            "dump --stage ast list/p.nc", "dump --stage ir list/p.nc", f"sim --show 500={quoted} list/p.nc", f"sim --json --show 500={quoted} list/p.nc",
            f"sim --html o.html --quiet --show 500={quoted} list/p.nc", f"new form f --prog forms/{quoted}.txt", f"new job --from posts/{quoted}.cps",
            "run-post post.cps --matrix probing", "run-post post.cps --matrix drilling", f"convert --keep-going --to fanuc -d o list/p.nc {quoted}", "lint post.cps",
            f"lint list --data {quoted}", f"lint list/p.nc --control {quoted}", f"lint {quoted}", f"verify list/p.nc --to fanuc --cases 2 --remark {quoted}"]


def project(probe):
    """A folder with a cycle, a Prog and a cycle of the language, and what is broken."""
    shutil.copytree(f"{ROOT}/examples/surface-x", probe.here / "sx")
    shutil.copy(f"{ROOT}/examples/post.txt", probe.here / "post.txt")
    shutil.copy(f"{ROOT}/examples/cycles/bore.cycle", probe.here / "bore.cycle")
    (probe.here / "bad.toml").write_text("x\n")
    (probe.here / "soft").symlink_to("sx/ToolPath.mac")
    (probe.here / "self.nc").symlink_to("self.nc")


def state(probe):
    return {str(p.relative_to(probe.here)): p.read_bytes() for p in sorted(probe.here.rglob("*")) if p.is_file()}


def flags_of(probe, command):
    """Flags of a command that take a value, as its help lists them."""
    text = probe.bash(f"dotek {command.split()[0]} --help").stdout.decode("utf-8", "replace")
    return [m[1] for m in re.finditer(r"^\s+(--[a-z-]+)[ ,](?=\s*[A-Z])", text, re.M) if m[1] not in ANY]


DRAWN = 150


def drawn(probe, random):
    """A command below limits, with streams and signals as they come; a file that it writes is old or complete."""
    if random.random() < 0.5:
        limits = random.sample([bearable(f"ulimit -v {random.randrange(20_000, 250_000)}", probe.judge.dotek), f"ulimit -n {random.randrange(3, 12)}",
                                f"ulimit -s {random.choice([64, 100, 300, 1000, 8000])}", f"ulimit -f {random.randrange(0, 40)}",
                                f"ulimit -t {random.randrange(1, 3)}", f"ulimit -u {random.randrange(1, 4)}"], random.choice([1, 1, 2, 3]))
        command = random.choice(list(COMMANDS.values()))
        stream = random.choice(["> out", "> /dev/null", "> /dev/full", ">&-", "2> /dev/full", "<&-", "| head -c 100 > /dev/null"])
        probe.fresh()
        script = f"({'; '.join(limits)}; dotek {command}) {stream}"  # the shell itself opens pipes
        # The limits may end the loader (127; below the size of the program the system, with SIGSEGV), and the system may end the process by SIGXCPU or SIGXFSZ; `head` may go first.
        return script, (0, 1, 2, 127, 141, 152, 153), lambda done: None
    flag = random.choice(list(WRITERS))
    new = whole(probe, WRITERS[flag])
    probe.fresh()
    (probe.here / "OUT").write_text(OLD)
    if random.random() < 0.4:
        script = f"ulimit -f {random.randrange(0, 8)}; ulimit -v {random.randrange(30_000, 250_000)}; dotek {WRITERS[flag]} --force"
        return script, (0, 1, 2, 127), kept(probe, new)
    signal = random.choice(["INT", "TERM", "HUP", "QUIT", "PIPE", "KILL", "XCPU", "USR1", "ALRM"])
    # What cannot be caught, or is not, may leave the unfinished file behind.
    left = "; rm -f .dotek*" if signal not in ("INT", "TERM", "HUP") else ""
    script = (f"set -m; '{probe.judge.dotek}' {WRITERS[flag]} --force > /dev/null 2>&1 & sleep {random.random() * 0.08:.4f}; "
              f"kill -{signal} $! 2> /dev/null; wait $!; s=$?; [ $s -le 2 ] || [ $s -gt 128 ] || exit 99{left}; exit 0")
    return script, (0,), lambda done: kept(probe, new)(subprocess.CompletedProcess([], 1))


def named(probe, told):
    """Inputs of nothing, errors before the run, texts of others, documents, pipes that nobody named, flags that nothing reads."""
    for name, commands in EMPTY_NAMES.items():
        for text in EMPTY:
            for command in commands:
                probe.fresh()
                (probe.here / name).write_text(text)
                yield told(f"dotek {command} {name}", (0, 1, 2), lambda done: None if done.returncode == 0 or done.stderr + done.stdout else "fails without a word")
    for flag, command in WRITERS.items():
        if flag in ("--fix", "in place", "write"):  # change their inputs
            continue
        inputs = ["sx/ToolPath.mac", "soft"] if "surface-x" in command else []
        for early in EARLY:
            for output in ["OUT", *inputs]:
                probe.fresh()
                project(probe)
                (probe.here / "OUT").write_text(OLD)
                if not early:
                    (probe.here / "dotek.toml").write_text("x\n")
                before = state(probe)
                told_of = command.replace(f"{ROOT}/examples/surface-x", "sx").replace(f"{ROOT}/examples/post.txt", "post.txt")

                def untouched(done, before=before):
                    now = state(probe)
                    changed = [name for name, bytes in before.items() if now.get(name) != bytes and (name != "OUT" or not now.get(name))]
                    return f"status {done.returncode}, and {changed} changed" if changed else None

                yield told(f"dotek {told_of.replace('OUT', output)} {early}", (0, 1, 2), untouched)
    probe.fresh()
    for command in texts(probe):
        yield told("dotek " + command, (0, 1, 2), quiet_texts)
    for command, schema in DOCUMENTS.items():
        for wrong in WRONG:
            probe.fresh()
            project(probe)
            name = "bore.cycle" if command.startswith("check") else "p.nc"

            def document(done, schema=schema):
                return probe.judge.document(schema, done.stdout)

            yield told(f"dotek {command} {name} {wrong}", (0, 1, 2), document)
    pipes = ["mkfifo pf; printf 'schema = 1\\nprog = \"pf\"\\n' > dotek.toml; dotek convert sx --to fanuc", "mkfifo pf; printf 'schema = 1\\ncontrol = \"./pf\"\\n' > dotek.toml; dotek lint p.nc",
             "rm sx/ToolPath.mac; mkfifo sx/ToolPath.mac; dotek dump sx", "rm sx/CycleData.dlg; mkfifo sx/CycleData.dlg; dotek preview sx", "mkfifo lib.js; echo 'include(\"lib.js\");' > a.cps; dotek new job --from a.cps",
             "mkfifo lib.js; echo 'include(\"lib.js\");' > a.cps; dotek lint a.cps", "mkdir pr; mkfifo pr/O9.nc; printf 'O1\\nM98P9\\nM30\\n' > c.nc; dotek sim c.nc --programs pr",
             "mkfifo f; dotek renumber --all f", "mkfifo f; timeout 5 sh -c 'cat p.nc > f' > /dev/null 2>&1 & dotek fmt --write f", "mkfifo f; timeout 5 sh -c 'cat p.nc > f' > /dev/null 2>&1 & dotek lint --fix f",
             "mkfifo sx/x.mac; echo '#include \"x.mac\"' >> sx/ToolPath.mac; dotek lint sx", "echo 'include(\"a.cps\");' > a.cps; dotek new job --from a.cps"]
    for script in pipes:
        probe.fresh()
        project(probe)
        yield told(script, (0, 1, 2))
    for command in FLAGS:
        for flag in flags_of(probe, command):
            probe.fresh()
            project(probe)
            yield told(f"dotek {command} {flag} ./self.nc", (1, 2), lambda done: None if done.returncode else f"takes {flag} ./self.nc")


def run(judge, folder, random):
    probe = Probe(judge, pathlib.Path(folder))

    def told(script, statuses, more=lambda done: None):
        return probe.fault(script, statuses, more), [script], probe.here

    for command in COMMANDS.values():
        for stream, status in STREAMS.items():
            probe.fresh()
            right = (status,) if status is not None else (0, 1, 2)
            if stream == ">&-" or stream == "> /dev/full":
                probe.bash(f"dotek {command} > plain")  # nothing to print is no failure
                if (probe.here / "plain").stat().st_size == 0:
                    right = (0, 1, 2)
            yield told(f"set -o pipefail; dotek {command} {stream}", right + ((141,) if "|" in stream else ()))
    for name in ("lint", "json", "post", "fusion", "verify", "fanuc", "check", "fmt", "doc", "preview", "cycle", "run-post", "new job", "outline", "renumber", "to cycle", "lsp"):
        for limit in (bearable(one, judge.dotek) for one in LIMITS):
            probe.fresh()
            # The loader may be refused the memory for a library: 127, before Dotek runs.
            yield told(f"{limit}; dotek {COMMANDS[name]} > out", (0, 1, 2) + ((127,) if "-v" in limit or "-n 3" in limit else ()))
    for flag, command in WRITERS.items():
        new = whole(probe, command)
        hindrances = {
            "folder": ("rm -f OUT; mkdir OUT", None), "file size": ("ulimit -f 1", new), "no descriptors": ("ulimit -n 4", new),
            "read only": ("chmod a-w OUT", new), "full": ("rm OUT; ln -s /dev/full OUT", None), "link": ("mv OUT real; ln -s real OUT", new),
            "loop": ("rm OUT; ln -s OUT OUT", None), "hard link": ("ln OUT other", new), "planted": ("for i in $(seq 50); do ln -s /etc/passwd .dotek-$i; done; "
            "trap 'rm -f .dotek-*' EXIT", new), "gone": ("cd ..", None),
        }
        for before, after in hindrances.values():
            probe.fresh()
            (probe.here / "OUT").write_text(OLD)
            more = kept(probe, after) if after is not None else lambda done: None
            yield told(f"{before}; dotek {command}", (0, 1, 2), more)
        for signal in ("INT", "TERM", "HUP", "KILL"):
            probe.fresh()
            (probe.here / "OUT").write_text(OLD)
            script = (f"set -m; '{judge.dotek}' {command} --force > /dev/null 2>&1 & sleep 0.0{probe.count % 10}; kill -{signal} $! 2> /dev/null; "
                      "wait $!; s=$?; [ $s -le 2 ] || [ $s -gt 128 ] || exit 99" + ("; rm -f .dotek*" if signal == "KILL" else "") + "; exit 0")
            yield told(script, (0,), lambda done: kept(probe, new)(subprocess.CompletedProcess([], 1)))
    for name in NAMES:
        for command in ("lint", "sim", "sim --json", "lint --format sarif", "dump", "convert --to fanuc --control fanuc-31i-b", "sim --quiet --svg o.svg",
                        "outline", "outline --json", "renumber", "fmt --diff", "fmt --check", "lint --format github", "lint --format gitlab", "lint --statistics"):
            probe.fresh()
            path = probe.here / name
            path.write_text(OLD)
            script = f"dotek {command} -- \"$(cat name)\""
            (probe.here / "name").write_text(name + "\n")
            yield told(script.replace('"$(cat name)"', "'" + name.replace("'", "'\\''") + "'"), (0, 1, 2), quiet_names)
    pairs = [f"convert {CYCLE} --to fanuc -d . --map O8000.nc", "lint p.nc p.nc", "lint p.nc ./p.nc", f"convert {CYCLE} --to fanuc -o F --map F", "sim p.nc --svg F --html F", "sim p.nc --trace F --html F",
             "sim p.nc --trace p.nc", "sim p.nc --svg p.nc", "convert p.nc --to fanuc --control fanuc-31i-b -o p.nc", "convert p.nc --to fanuc --control fanuc-31i-b -o -",
             "fmt p.nc -o p.nc", "fmt p.nc --diff -o p.nc", f"run-post {POST} {JOB} -o p.nc --map p.nc", "lint p.nc --write-baseline p.nc", f"run-post {POST} {JOB} --expect p.nc -o p.nc",
             "lint p.nc --baseline p.nc", "renumber p.nc p.nc -o F", f"run-post {POST} {JOB} -o F --map F"]
    for command in pairs:
        probe.fresh()
        yield told("dotek " + command, (0, 1, 2), lambda done: None if (probe.here / "p.nc").read_text() == OLD else "writes over its input")
    others = ["mkfifo f.cycle; dotek doc .", "mkdir -p data/forms; mkfifo data/forms/x.toml; dotek list forms --data data", "mkfifo dotek.toml; dotek lint p.nc",
              "mkfifo dotek.toml; dotek list forms", "ln -s dotek.toml dotek.toml; dotek sim p.nc", "mkfifo f.nc; dotek lint .", "mkfifo f.nc; (printf '%s' 'O1' > f.nc &) ; dotek lint f.nc", "ln -s . d; ln -s .. e; dotek lint .", "dotek lint /dev/null",
              "dotek lint /dev/stdin < p.nc", "mkdir x.nc; dotek lint x.nc", "dotek lint nowhere", "dotek sim -", "dotek lint ''", "dotek lint /proc/self/mem",
              "ln -s x.nc x.nc; dotek lint x.nc", "chmod 0 p.nc; dotek lint p.nc", "dotek lint p.nc/x", "rm -f p.nc; mkdir gone; cd gone; rmdir ../gone; dotek lint ."]
    for script in others:
        probe.fresh()
        yield told(script, (0, 1, 2))
    yield from named(probe, told)
    for _ in range(DRAWN):
        script, statuses, more = drawn(probe, random)
        yield told(script, statuses, more)
