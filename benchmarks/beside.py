"""Ropes beside a mooring program and beside reeving springs: error against closed forms, and CPU.

    python -m benchmarks.beside           # a table; programs that are not installed are left out
    python -m benchmarks.beside --docs    # into docs/background/ropes-beside.md

The scenes are in `rope_cases.py`, the programs in `peers/`. Every run has a process of its own, and
counts with the least CPU of some; imports are left out.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import adamslite
from benchmarks.measure import ONE_THREAD
from benchmarks.peers import exudyn_reeving, moordyn_rope, moorpy_rope, our_ropes
from benchmarks.rope_cases import SHAKEN, TITLES, Answer, RopeRun, closed_form

RUNS: list[RopeRun] = sorted(
    (
        run
        for module in (our_ropes, exudyn_reeving, moordyn_rope, moorpy_rope)
        for run in module.runs()
    ),
    key=lambda run: list(TITLES).index(run.scene),
)
PAGE = Path(__file__).resolve().parent.parent / "docs" / "background" / "ropes-beside.md"
MARK = "ANSWER "
HEAD = """<!-- Written by benchmarks/beside.py: do not edit. -->
# Ropes beside other programs

Scenes with closed forms, and one with a published curve, solved by a program for moorings (MoorDyn:
lumped masses, explicit steps), by one for their equilibria (MoorPy: elastic catenary), by the
reeving springs of a multibody program (Exudyn: one spring without mass over all sheaves), and by
this one; `benchmarks/rope_cases.py` has the equations. CPU is that of one core, without imports,
the least of {repeats} runs.

{versions}

A reeving spring has no mass: at the top of the rope its force lacks the weight of the rope, 28 % in
this scene, and it is exact where the rope has none. MoorDyn's line with the damping that its manual
recommends loses the payout: its damper acts on the rate of the stretched length, and the weight
hangs on the dampers; without damping the same line is right. In its own scenes all agree.

| scene | program | setting | value | exact | error | set-up [s] | solution [s] |
|---|---|---|---|---|---|---|---|
"""


def installed(run: RopeRun) -> str:
    """The version of its program, or nothing; ours is in this checkout."""
    if run.package == "adamslite":
        return adamslite.__version__
    try:
        return version(run.package)
    except PackageNotFoundError:
        return ""


def answer(index: int) -> Answer | None:
    """Solve a run in a process of its own; None where it ends without an answer."""
    command = [sys.executable, "-m", "benchmarks.beside", "--one", str(index)]
    environment = {**os.environ, **ONE_THREAD}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    told = [line for line in done.stdout.splitlines() if line.startswith(MARK)]
    return Answer(**json.loads(told[-1].removeprefix(MARK))) if told else None


def row(run: RopeRun, found: Answer) -> str:
    """A line of the table."""
    exact = closed_form(run.scene)
    error = found.value if run.scene == SHAKEN else found.value / exact - 1
    cells = [TITLES[run.scene], run.package, run.setting, f"{found.value:.7g}"]
    cells += ["" if run.scene == SHAKEN else f"{exact:.7g}", f"{error:.1e}"]
    cells += [f"{found.setup:.2g}", f"{found.solve:.2g}"]
    return "| " + " | ".join(cells) + " |"


def table(repeats: int) -> list[str]:
    """Lines of all runs whose program is installed."""
    lines = []
    for index, run in enumerate(RUNS):
        if not installed(run):
            print(f"{run.package} is left out: it is not installed.", file=sys.stderr)
            continue
        found = [each for each in (answer(index) for _ in range(repeats)) if each]
        if not found:
            print(f"{run.package}, {run.setting}: no answer", file=sys.stderr)
            continue
        lines.append(row(run, min(found, key=lambda each: each.setup + each.solve)))
        print(lines[-1], flush=True)
    return lines


def main() -> None:
    """Measure and print, or write the page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.beside")
    parser.add_argument("--docs", action="store_true", help="write the page")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each setting (3)")
    parser.add_argument("--one", type=int, help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.one is not None:
        print(f"\n{MARK}{json.dumps(asdict(RUNS[args.one].solve()))}", flush=True)
        os._exit(0)  # bindings that count references wrongly end with a crash otherwise
    lines = table(args.repeats)
    if args.docs:
        known = {run.package: installed(run) for run in RUNS if installed(run)}
        versions = ", ".join(f"{name} {number}" for name, number in known.items())
        head = HEAD.format(repeats=args.repeats, versions=f"Versions: {versions}.")
        PAGE.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
