#!/usr/bin/env python3
"""Hostile inputs through the built program: ./dev campaign.

    campaign.py --dotek PROGRAM [--seed N] [--count N] [--limit SECONDS] [inputs|hostile|probes|scripts]...

hostile, probes and scripts run what is listed in their files, then 100 files, 150 probes and 30 scripts that the seed draws.
Each finding is a line: what is wrong, the arguments, the folder with its inputs. Exit status 1 where there is one.
"""

import argparse
import random
import sys
import tempfile
import time

import hostile
import mutate
import probes
import scripts
from judge import Judge


def inputs(judge, options, folder):
    campaign = mutate.Campaign(judge, random.Random(options.seed), folder)
    for number in range(options.count):
        yield campaign.one(number)


PARTS = {
    "inputs": inputs,
    "hostile": lambda judge, options, folder: hostile.run(judge, folder, random.Random(options.seed)),
    "probes": lambda judge, options, folder: probes.run(judge, folder, random.Random(options.seed)),
    "scripts": lambda judge, options, folder: scripts.run(judge, folder, random.Random(options.seed)),
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--dotek", required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300, help="damaged inputs")
    parser.add_argument("--limit", type=float, default=30, help="seconds that a run may take before it is killed")
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []])
    options = parser.parse_args()
    bad = 0
    for name in options.parts or PARTS:
        judge = Judge(options.dotek, options.limit)
        begin = time.monotonic()
        runs = found = 0
        folder = tempfile.mkdtemp(prefix=f"dotek-{name}-")
        for fault, arguments, where in PARTS[name](judge, options, folder):
            runs += 1
            if fault:
                found += 1
                print(f"{fault}\n  {' '.join(map(str, arguments))}\n  {where}", flush=True)
        bad += found
        exits = ", ".join(f"{status}: {count}" for status, count in sorted(judge.exits.items()))
        print(f"{name}: {runs} runs, {found} findings, exit statuses {exits or 'none'}, "
              f"slowest {judge.slowest[0]:.1f} s ({judge.slowest[1][:80]}), {time.monotonic() - begin:.0f} s", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
