#!/usr/bin/env python3
"""Converts every cycle to every target, macro set and control, verifies what was converted, and writes docs/conversion-matrix.md.

Run by `./dev matrix [NAME...]`. DOTEK is the program, DOTEK_CORPUS the corpus; without it the cycles of the corpus are left out.
MATRIX_CASES is how many cases verify draws (50), MATRIX_LIST a file that gets one line a conversion, with message and flags.
With names, only cycles whose name contains one of them run, their rows are printed, and the document stays.
"""
import concurrent.futures
import fnmatch
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

root = Path(__file__).resolve().parents[2]
shops = root / "tests" / "shops"
dotek = os.environ.get("DOTEK", str(root / "build" / "release" / "dotek"))
cases = int(os.environ.get("MATRIX_CASES", "50"))
data = ["--data", "tests/shops/data"]

# shop: routine of its post. The control is the one that its form names.
routines = {"inspection": "probeOps", "easyprobe": "messen", "direct": "touch", "toolchange": "measure", "flags": "pomiar", "origins": "palper", "repeats": "messen",
            "results": "probing", "included": "antasten", "bounded": "probes", "series": "sonda", "chained": "palpage", "touches": "tasta", "zones": "taster", "classes": "matcykel", "retries": "probeIt", "loops": "sondaRen",
            "irunza": "palpador", "nordlund": "taster", "szabo": "meres", "vandoorn": "meten",
            "moreira": "medir", "yildiz": "olcum", "koskinen": "mittaus", "kobayashi": "sokutei"}

# What the thesis prints as another field than the folder declares, and an IF that it leaves open.
corpus_fields = {"MERENI.OSA.X": ["--field", "X=a"], "MERENI.OSA.Y": ["--field", "Y=b"], "MERENI.OSA.Z": ["--field", "Z=d"]}

# What the CAM knows of an operation; Mikroprog has no arguments, so a value for each is folded.
mikroprog_host = ["--host", "clearance=20", "--host", "tool_radius=3", "--host", "overtravel=5", "--host", "return_feed=1000",
                  "--host", "start_x=-15", "--host", "start_y=10", "--host", "start_z=60"]


class Cycle:
    def __init__(self, folder, prog, arguments, control):
        self.name = folder.name
        self.folder = folder
        self.control = control
        self.arguments = ["--prog", str(prog), *arguments]


def listed(what, pattern):
    text = subprocess.run([dotek, "list", what], capture_output=True, text=True, check=True).stdout
    return [line.split()[0] for line in text.splitlines() if re.search(pattern, line)]


def cycles():
    found = []
    for shop, routine in routines.items():
        forms = re.search(r'form = "(.*)"', (shops / shop / "dotek.toml").read_text())
        control = re.search(r'^control = "(.*)"', (shops / "data/forms" / f"{forms[1]}.toml").read_text(), re.M)[1]
        prog = Path("tests/shops") / shop / "post.txt"
        for folder in sorted((shops / shop).iterdir()):
            if folder.is_dir():
                found.append(Cycle(folder.relative_to(root), prog, ["--routine", routine, *data], control))
    corpus = os.environ.get("DOTEK_CORPUS", "")
    if corpus and Path(corpus).is_dir():
        prog = Path(corpus) / "compost" / "probe-routines.txt"
        for folder in sorted((Path(corpus) / "gibbs").iterdir()):
            arguments = ["--recover", *corpus_fields.get(folder.name, [])]
            found.append(Cycle(folder, prog, arguments, "fanuc-0i-md"))
    return found


def impossible_rows():
    rows = []
    for line in (shops / "impossible.tsv").read_text().splitlines():
        if line and not line.startswith("#"):
            rows.append(line.split("\t"))
    return rows


# A message may name flags that mend the refusal; what an engineer would then type. Each is tried once, and told in the table.
def remedy(message, used, control):
    codes = ["M31", "M32"] if not control.startswith("haas") else ["M61", "M62"]  # M31 is the chip conveyor there
    offers = [
        (r"--probe-on\b", ["--probe-on", codes[0], "--probe-off", codes[1]]),
        (r"--probe-power macro", ["--probe-power", "macro"]),
        (r"--assume plain-messages", ["--assume", "plain-messages"]),
        (r"--datum operator", ["--datum", "operator"]),
    ]
    for pattern, flags in offers:
        if re.search(pattern, message) and flags[0] not in used:
            return flags
    moved = re.search(r"--probe-macros (\w+@\d+)", message)
    if moved and "--probe-macros" not in used:
        return ["--probe-macros", moved[1]]
    field = re.search(r"write `--set (\w+)=VALUE`", message)
    if field and "--set" not in used:
        return ["--set", f"{field[1]}=30"]
    for question in re.findall(r"--assume (Q\d+)", message):
        if question not in used:
            return ["--assume", question]
    return None


class Cell:
    def __init__(self, cycle, target, macros, control, fact):
        self.cycle, self.target, self.macros, self.control, self.fact = cycle, target, macros, control, fact
        self.state = ""  # agrees, differs, converted (verify could not decide), refused, impossible
        self.code = self.message = self.verify = ""
        self.flags = []


def run(arguments):
    done = subprocess.run([dotek, *arguments], capture_output=True, text=True, cwd=root, errors="replace")
    return done.returncode, done.stdout, done.stderr


def first_error(text):
    for line in text.splitlines():
        found = re.match(r"(.*?): error: (.*) \[([a-z0-9-]+)\]$", line)
        if found:
            place = re.sub(r"^.*/(?=(?:tests|compost|gibbs)/)", "", found[1])
            return place, found[2], found[3]
    return "", text.strip().splitlines()[0] if text.strip() else "no message", "none"


def macros(cell):
    given = not cell.macros or "--probe-macros" in cell.flags
    return [] if given else ["--probe-macros", cell.macros]


def measure(cell):
    arguments = [str(cell.cycle.folder), *cell.cycle.arguments, "--to", cell.target, "--control", cell.control]
    if cell.target == "mikroprog":
        arguments += mikroprog_host
    with tempfile.TemporaryDirectory() as folder:
        while True:
            status, _, errors = run(["convert", *arguments, *macros(cell), *cell.flags, "-o", f"{folder}/out", "--force"])
            if status == 0:
                break
            place, cell.message, cell.code = first_error(errors)
            cell.message = f"{place}: {cell.message}" if place else cell.message
            flags = remedy(errors, cell.flags, cell.control)
            if not flags:
                cell.state = "impossible" if cell.fact else "refused"
                return cell
            cell.flags += flags
    assumed = ["--assume", "probe-on"] if "--probe-power" in cell.flags else []
    flags = [flag for flag in cell.flags if flag not in ("--probe-power", "macro")]
    arguments += macros(cell)
    status, output, errors = run(["verify", *arguments, *flags, *assumed, "--cases", str(cases), "--jobs", "1"])
    if status != 0 and "--assume probe-on" in errors and not assumed:
        # the branch leaves the probe to another routine
        cell.flags += ["--assume", "probe-on"]
        status, output, errors = run(["verify", *arguments, *flags, "--assume", "probe-on", "--cases", str(cases), "--jobs", "1"])
    verdict = re.search(r"^(AGREES|DIFFERS|.*UNDECIDED.*|INCONCLUSIVE).*$", output + errors, re.M)
    cell.verify = verdict[0] if verdict else ""
    cell.state = "agrees" if status == 0 else "differs" if cell.verify.startswith("DIFFERS") else "converted"
    if cell.state != "agrees":
        # Why cases are undecided is a warning; that too few agree is only what comes of it.
        idle = re.search(r"^(.*?): warning: (.*) \[(verify-idle)\]$", errors, re.M)
        place, cell.message, cell.code = first_error(errors)
        if cell.code == "verify-too-few" and idle:
            place, cell.message, cell.code = idle[1], idle[2], idle[3]
        cell.message = f"{place}: {cell.message}" if place else cell.message
    return cell


def matrix(chosen):
    sets = listed("macros", r"\S")
    controls = listed("controls", r"^(fanuc|haas)(?!.*\blathe\b)")
    mikroprog = listed("controls", r"^mikroprog")
    rows = impossible_rows()

    def fact(cycle, target, macros, control):
        for folder, t, m, c, text in rows:
            if all(fnmatch.fnmatchcase(value, pattern) for value, pattern in
                   ((cycle.name, folder), (target, t), (macros or "-", m), (control, c))):
                return text
        return ""

    cells = []
    for cycle in chosen:
        for macros in sets:
            for control in controls:
                cells.append(Cell(cycle, "fanuc", macros, control, fact(cycle, "fanuc", macros, control)))
            cells.append(Cell(cycle, "fusion", macros, cycle.control, fact(cycle, "fusion", macros, cycle.control)))
        for control in mikroprog:
            cells.append(Cell(cycle, "mikroprog", "", control, fact(cycle, "mikroprog", "", control)))
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        return list(pool.map(measure, cells))


def summary(cells):
    possible = [cell for cell in cells if not cell.fact]
    made = [cell for cell in possible if cell.state in ("agrees", "differs", "converted")]
    agreed = [cell for cell in possible if cell.state == "agrees"]
    share = lambda part: 100.0 * len(part) / len(possible) if possible else 0.0
    return (f"{len(made)} of {len(possible)} possible conversions made ({share(made):.1f} %), {len(agreed)} of them agree "
            f"({share(agreed):.1f} %); {len(cells) - len(possible)} are on the list of impossible ones")


def short(cell):
    if cell.state == "agrees":
        return "agrees" + (" (1)" if cell.flags else "")
    if cell.state == "impossible":
        return "-"
    if cell.fact:
        return f"{cell.state}, though listed"
    if cell.state == "refused":
        return f"`{cell.code}`"
    return f"{cell.state}: `{cell.code}`"


def heading(cell):
    control = cell.control.removeprefix("fanuc-").removeprefix("mikroprog-")
    macros = {"inspection-plus": "inspection", "easyprobe": "easyprobe"}.get(cell.macros, cell.macros)
    return f"{macros} {control}" if cell.target == "fanuc" else macros or control


def document(cells):
    lines = ["# What is converted: cycles, targets, macro sets, controls", "",
             "Written by `./dev matrix`; not edited by hand. Every cycle of [tests/shops](../tests/shops/README.md), and the five of the corpus where it is, "
             f"to every target with every macro set and control that `dotek list` shows; what is written is verified with {cases} cases.", "",
             f"**{summary(cells)}.**", "",
             "| word | meaning |", "|---|---|",
             "| agrees | converted, and `dotek verify` agrees |",
             "| agrees (1) | the same, with the flags that a first message names |",
             "| differs: `code` | converted; `verify` reports this |",
             "| converted: `code` | converted; `verify` cannot decide, for this reason |",
             "| `code` | refused, though no fact forbids it |",
             "| - | refused, and on the list of impossible ones ([impossible.tsv](../tests/shops/impossible.tsv)) |", ""]
    for target in ("fanuc", "fusion", "mikroprog"):
        part = [cell for cell in cells if cell.target == target]
        # A fragment for Fusion is written for the control of its post.
        columns = list(dict.fromkeys(heading(cell) for cell in part))
        lines += [f"## {target}", "", "| cycle | " + " | ".join(columns) + " |", "|---|" + "---|" * len(columns)]
        for name in dict.fromkeys(cell.cycle.name for cell in part):
            row = {heading(cell): short(cell) for cell in part if cell.cycle.name == name}
            lines.append(f"| {name} | " + " | ".join(row.get(column, "") for column in columns) + " |")
        lines.append("")
    refused = [cell for cell in cells if cell.state not in ("agrees", "impossible") and not cell.fact]
    if refused:
        lines += ["## Refused, or not in agreement", "", "| code | conversions | first message |", "|---|---|---|"]
        for code, count in Counter(cell.code for cell in refused).most_common():
            first = next(cell for cell in refused if cell.code == code)
            lines.append(f"| `{code}` | {count} | {first.message.replace('|', '/')} |")
        lines.append("")
    return "\n".join(lines)


def main():
    names = sys.argv[1:]
    chosen = [cycle for cycle in cycles() if not names or any(name.lower() in cycle.name.lower() for name in names)]
    if not chosen:
        sys.exit("matrix: no cycle has such a name")
    cells = matrix(chosen)
    listing = os.environ.get("MATRIX_LIST")
    if listing:
        with open(listing, "w", encoding="utf-8") as out:
            for cell in cells:
                out.write("\t".join([cell.state, cell.cycle.name, cell.target, cell.macros, cell.control, cell.code, cell.message,
                                     " ".join(cell.flags), cell.verify, cell.fact]) + "\n")
    if names:
        for cell in cells:
            print(f"{cell.cycle.name} {cell.target} {cell.macros or '-'} {cell.control}: {short(cell)}"
                  + (f"\n    {cell.message}" if cell.state not in ("agrees", "impossible") else ""))
    else:
        (root / "docs" / "conversion-matrix.md").write_text(document(cells), encoding="utf-8")
    print(summary(cells))


if __name__ == "__main__":
    main()
