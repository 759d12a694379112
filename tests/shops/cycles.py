#!/usr/bin/env python3
"""Cycles of the library by target and macro set, as a table: cycles.py DOTEK [CASES [NAME...]]

Each is converted and verified; nothing is written beside a temporary folder. The table goes to the standard output."""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

DOTEK = sys.argv[1]
CASES = sys.argv[2] if len(sys.argv) > 2 else "200"
ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMES = sys.argv[3:]  # only these
LIBRARY = ROOT / "stdlib/cycles"
SWITCH = ["--probe-on", "M31", "--probe-off", "M32"]
COLUMNS = [
    ("Inspection Plus", "fanuc", ["--control", "fanuc-31i-b", "--probe-macros", "inspection-plus"]),
    ("easyprobe", "fanuc", ["--control", "fanuc-0i-md", "--probe-macros", "easyprobe"]),
    ("dotek", "fanuc", ["--control", "fanuc-31i-b", "--probe-macros", "dotek"] + SWITCH),
    ("Haas", "fanuc", ["--control", "haas-ngc", "--probe-macros", "inspection-plus"]),
    ("Fusion", "fusion", ["--control", "fanuc-31i-b", "--probe-macros", "inspection-plus"]),
    ("Mikroprog", "mikroprog", ["--control", "mikroprog-mill"]),
]
HOSTS = {"approach_feed": "1000", "measuring_feed": "100", "overtravel": "5", "start_x": "0", "start_y": "0",
         "start_z": "10", "retract": "20"}
# First values of a dialog that the cycle does not state; the first word that the name holds counts.
FIRST = [("system", "55"), ("diameter", "40"), ("depth", "5"), ("clearance", "8"), ("tolerance", "0.1"),
         ("pitch", "80"), ("number", "4"), ("spacing", "20"), ("width", "30"), ("length", "50"), ("size", "40"),
         ("reach", "30"), ("distance", "15"), ("direction", "30"), ("offset", "5"), ("plate", "0")]


def run(*arguments):
    done = subprocess.run([DOTEK, *arguments], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def reason(text, reasons):
    found = re.findall(r"error: (.*) \[([a-z0-9-]+)\]", text)
    if not found:
        return "?"
    message, code = found[0]
    reasons.setdefault(code, message)
    return f"`{code}`"


def judged(text, reasons):
    if re.search(r"^AGREES", text, re.M):
        count = re.search(r"^AGREES: (\d+) of (\d+)", text, re.M)
        return "agrees" if count and count[1] == count[2] else f"agrees ({count[1]} of {count[2]})"
    found = re.search(r"^DIFFERS: (\d+) of (\d+)", text, re.M)
    if found:
        return f"**differs ({found[1]} of {found[2]})**"
    few = re.search(r"(\d+) of (\d+) cases agree, fewer", text)
    return f"undecided ({few[1]} of {few[2]})" if few else reason(text, reasons)


def direct(path, target, flags, reasons):
    arguments = ["verify", str(path), "--to", target, "--cases", CASES, *flags]
    for name, value in HOSTS.items():
        if target == "mikroprog" or name in ("approach_feed", "overtravel"):
            arguments += ["--host", f"{name}={value}"]
    stored = []
    for _ in range(6):
        status, text = run(*arguments, *stored)
        wanted = re.findall(r"as `--result (\w+)=#560`", text)
        if not wanted:
            break
        for name in dict.fromkeys(wanted):  # values for a later run, each in a variable of its own
            stored += ["--result", f"{name}=#{560 + len(stored) // 2}"]
    return judged(text, reasons)


def gibbs(path, folder, reasons):
    """What is written, agrees with its own branch, and comes back: two columns."""
    defaults, hosts = {"system": "55"}, {}
    for _ in range(8):
        arguments = ["convert", str(path), "--to", "gibbs", "--control", "fanuc-31i-b", "--probe-macros",
                     "inspection-plus", "-d", folder, "--force"]
        for name, value in defaults.items():
            arguments += ["--default", f"{name}={value}"]
        for name, value in hosts.items():
            arguments += ["--host", f"{name}={value}"]
        status, text = run(*arguments)
        if status == 0:
            break
        known = len(defaults) + len(hosts)
        for name in re.findall(r"--default (\w+)=VALUE", text):
            defaults.setdefault(name, next((v for part, v in FIRST if part in name), "10"))
        for name in re.findall(r"--host (\w+)=VALUE", text):
            if name in HOSTS:
                hosts[name] = HOSTS[name]
        unknown = re.search(r"no field `(\w+)`", text)
        if unknown and defaults.pop(unknown[1], None) is None or not unknown and known == len(defaults) + len(hosts):
            break
    if status != 0:
        text = re.sub(r".*\[(cam-default-missing|cam-host-unknown|no-such-field)\].*\n", "", text)
        return reason(text, reasons), ""
    written = f"{folder}/{path.stem}"
    arguments = ["verify", *[one for one in arguments[1:] if one not in ("-d", folder, "--force")], "--cases", CASES]
    _, branch = run(*arguments)
    flags = ["--prog", f"{written}/branch.txt", "--form", "thesis-a", "--assume", "probe-on", "--cases", CASES]
    _, back = run("verify", written, "--to", "cycle", *flags)
    return judged(branch, reasons), judged(back, reasons)


def main():
    reasons = {}
    heads = [name for name, _, _ in COLUMNS] + ["GibbsCAM", "and back"]
    print("| cycle | " + " | ".join(heads) + " |")
    print("|---|" + "---|" * len(heads))
    totals = [0] * len(heads)
    cycles = 0
    paths = [
        path
        for path in sorted(LIBRARY.glob("*.cycle"))
        if not re.search(r"^options ", path.read_text(), re.M) and (not NAMES or path.stem in NAMES)
    ]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:

        def row(path):
            cells = [direct(path, target, flags, reasons) for _, target, flags in COLUMNS]
            return path, cells + list(gibbs(path, folder, reasons))

        for path, cells in pool.map(row, paths):
            cycles += 1
            for i, cell in enumerate(cells):
                totals[i] += cell.startswith("agrees")
            print(f"| `{path.stem}` | " + " | ".join(cells) + " |", flush=True)
    print("| " + f"agree, of {cycles} | " + " | ".join(str(one) for one in totals) + " |")
    print("\n| code | for instance |\n|---|---|")
    for code, message in sorted(reasons.items()):
        print(f"| `{code}` | {message} |")


main()
