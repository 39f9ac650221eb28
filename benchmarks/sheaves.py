"""Ropes over 10 to 1000 sheaves: the capstan's ratios, and CPU against the number of sheaves.

    python -m benchmarks.sheaves [--counts 10 30 100 300 1000] [--scene held turning] [--out FILE]

A winch pulls 50 m of rope with mass by 0.25 m over bars, lets 0.2 m back and ends with a slack
rope; mu times all wraps is 2 for any count. `held`: bars that do not turn. `turning`: sheaves with
friction in their bearings, on which the rope grips. Both are descriptions for `adamslite cable`,
solved as it advises; the times are CPU of the whole command, cold kernels included, and of the
solution alone.

Columns: count; CPU of the command and of the solution [s]; steps; the largest difference of a
ratio over a bar that slips, T2/T1, from exp(mu wrap), in the pull; the part of the bars that slips
then. The last line has the exponent of CPU over count.
"""

import argparse
import csv
import re
import sys
from itertools import pairwise
from math import cos, exp, log, tan
from time import process_time

import numpy as np

import adamslite as al
from adamslite.cables.deck.scene import deck

LENGTH, MU, WRAPS = 50.0, 0.2, 10.0
#: A time of the pull [s].
PULLS = 3.0
#: Share of the friction from which a bar slips.
SLIPS = 1 - 1e-6
SCENES = {"held": "held = true", "turning": "inertia = {inertia}\nfriction = {friction}"}
LAW = "-0.25*STEP5(TIME,0,0,4,1)+0.2*STEP5(TIME,5,0,9,1)+0.051*STEP5(TIME,9,0,9.5,1)"


def describe(count: int, scene: str) -> str:
    """The description: over the first bar, under the second, ..., all wraps together WRAPS."""
    spacing, slope = LENGTH / count, WRAPS / count / 2
    radius = min(0.1, spacing / 4)
    dip = 2 * radius / cos(slope) - spacing * tan(slope)
    kind = SCENES[scene].format(inertia=radius**2, friction=200 / count * radius)
    end, turn = (-radius, -1) if count % 2 else (radius, 1)
    return f"""\
title = "A rope over {count} bars"
end = 9.5
steps = 190
error = 2e-6
gravity = [0, 0, 0]
[cable]
EA = 1e6
rho = 0.5
pretension = 1000
damping = 0.3
pulls_only = true
[[route]]
kind = "fixed"
at = [-5, 0, 0]
[[route]]
kind = "pulley"
at = [0, {-radius}, 0]
turn = -1
count = {count}
pitch = [{spacing}, 0, 0]
stagger = [0, {dip}, 0]
radius = {radius}
{kind}
mu = {MU}
grip = 2e-5
[[route]]
kind = "winch"
at = [{LENGTH}, {end}, 0]
turn = {turn}
radius = {radius}
inertia = 1
payout = "{LAW}"
[model]
level = 3
elements = 1
"""


def measure(count: int, scene: str) -> dict[str, float]:
    """One line of the table."""
    start = process_time()
    text, _ = deck(describe(count, scene))
    kernels = al.compile_model(al.assemble(al.read(text)))
    begin = process_time()
    found = al.simulate(kernels)
    now = process_time()
    assert found.outcome.name == "DONE", found.outcome
    halves = re.findall(r"VARIABLE/h_(\d+), FUNCTION=TANH\(([\d.e-]+)\*", text)
    row = int(np.argmin(abs(found.time - PULLS)))
    ratios = [(found[f"REQUEST/{n}.F8"][row], 2 * float(half)) for n, half in halves]
    shares = [found[f"DIFF/grip_{n}"][row] / 2e-5 for n, _ in halves]
    slipping = [abs(ratio / exp(most) - 1)
                for (ratio, most), k in zip(ratios, shares, strict=True) if k > SLIPS]  # fmt: skip
    return {
        "count": count, "cpu": now - start, "solution": now - begin,
        "steps": found.summary["steps"], "ratio": max(slipping, default=0.0),
        "slipping": len(slipping) / count,
    }  # fmt: skip


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--counts", type=int, nargs="+", default=[10, 30, 100, 300, 1000])
    parser.add_argument("--scene", nargs="+", choices=SCENES, default=["held"])
    parser.add_argument("--out", help="a file for the table")
    args = parser.parse_args()
    rows = []
    for scene in args.scene:
        measure(min(args.counts), scene)  # compiles the integrator
        own = [{"scene": scene} | measure(count, scene) for count in args.counts]
        for row in own:
            print(*(f"{v:.4g}" if isinstance(v, float) else v for v in row.values()), sep="\t")
        for a, b in pairwise(own):
            growth = log(b["solution"] / a["solution"]) / log(b["count"] / a["count"])
            print(f"{scene}: from {a['count']} to {b['count']} sheaves CPU ~ count^{growth:.2f}")
        rows += own
    if args.out:
        with open(args.out, "w", newline="", encoding="utf-8") as file:
            table = csv.DictWriter(file, rows[0])
            table.writeheader()
            table.writerows(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
