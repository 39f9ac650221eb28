"""Whether what `check` says of parts and joints that a scene does not need is true.

    python -m benchmarks.rigid_advice --scenes 80 --seed 1

Random mechanisms (:mod:`benchmarks.rigid_scenes`): the change that a note advises is made in the
deck, and made as well where nothing is reported.  True is a note where the places of parts change
by no more than it says; left out without need is one where they would have changed by next to
nothing.
"""

from __future__ import annotations

import argparse
import re
from collections import defaultdict
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

import adamslite
from adamslite.checks.rules import needless
from benchmarks.rigid_scenes import KINDS, Scene

#: Of the size: what integration leaves, and what nobody would miss.
NOISE, NOTHING = 1e-7, 1e-4
ERROR = 1e-9


class Tried(NamedTuple):
    """A scene, what is said to be lost (None: nothing is reported) and what is, both of the size,
    and CPU as it is over that of the advised deck.
    """

    kind: str
    told: float | None
    lost: float
    saved: float

    @property
    def verdict(self) -> str:
        """Whether the note, or that there is none, is right."""
        if self.told is None:
            return "needed" if self.lost > NOTHING else "kept without need"
        return "true" if self.lost <= self.told + NOISE else "false"


def tried(scene: Scene) -> Tried | None:
    """None where a run ends early."""
    deck = adamslite.read(scene.text)
    notes = [each for each in needless(deck) if each.code == scene.code]
    runs = [
        adamslite.simulate(each, error=ERROR * scene.size, integrator="RADAU")
        for each in (deck, adamslite.read(scene.advised(scene.text)))
    ]
    if any(run.outcome.name != "DONE" for run in runs):
        return None
    one, other = runs
    names = [f"{part}.{axis}" for part in scene.parts for axis in "xyz"]
    lost = max(float(np.abs(one[name] - other[name]).max()) for name in names) / scene.size
    way = max(float(np.ptp(other[name])) for name in names) / scene.size
    told = _told(notes[0], scene, way) if notes else None
    saved = one.summary["solve_cpu_s"] / max(other.summary["solve_cpu_s"], 1e-9)
    return Tried(scene.kind, told, lost, saved)


def _told(note: adamslite.Diagnostic, scene: Scene, way: float) -> float:
    """What a note says is lost, of the size."""
    if note.code == "light-link":
        found = re.search(r"at most (\S+) of", note.message)
        return float(found[1]) * way if found else 0.0
    found = re.search(r"up to (\S+),", note.hint or "")
    return float(found[1]) / scene.size if found else 0.0


def figures(results: Iterable[Tried]) -> str:
    """A row for each kind of scene."""
    kinds: dict[str, list[Tried]] = defaultdict(list)
    for each in results:
        kinds[each.kind].append(each)
    rows = [
        "| scene | reported | true | largest lost/reported | CPU saved | not reported | needed |",
        "|---|---|---|---|---|---|---|",
    ]
    for kind, found in sorted(kinds.items()):
        told = [each for each in found if each.told is not None]
        rest = [each for each in found if each.told is None]
        shares = [each.lost / (each.told or NOISE) for each in told]
        saved = f"{np.median([each.saved for each in told]):.3g} times" if told else ""
        rows.append(
            f"| {kind} | {len(told)} | {sum(e.verdict == 'true' for e in told)} "
            f"| {max(shares, default=0.0):.2g} | {saved} | {len(rest)} "
            f"| {sum(e.verdict == 'needed' for e in rest)} |"
        )
    return "\n".join(rows)


def main() -> None:
    """Print the rows, and scenes that are not as reported."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    results = []
    for number in range(args.scenes):
        seed = 1000 * args.seed + number
        scene = KINDS[number % len(KINDS)](seed)
        found = tried(scene)
        if found is None:
            print(f"{scene.kind} {seed}: a run ended early", flush=True)
            continue
        results.append(found)
        if found.verdict in ("false", "kept without need"):
            print(f"{scene.kind} {seed}: {found}", flush=True)
    print(figures(results))


if __name__ == "__main__":
    main()
