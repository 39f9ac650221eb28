"""What the reductions of a model save: CPU of a run with all of them and without one.

The decks are reference decks of the project, each with the rules that apply to it.
"""

from __future__ import annotations

from pathlib import Path
from statistics import median

import adamslite
from adamslite.scene import load_scene
from benchmarks.figures import Figure

DECKS = Path(__file__).parent.parent / "decks"
SCENES = {
    "four-bar/four-bar": ("plane",),
    "slider-crank/slider-crank": ("plane",),
    "andrews/andrews": ("plane",),
    "a02-n40/a02-n40": ("plane",),
    "cables/belt-drive/creeping": ("plane", "points"),
    "pulley-drive/pulley-drive": ("plane", "variables"),
    "cable-level3-n40/cable-level3-n40": ("plane", "points", "variables"),
    "swinging-cable-n50/swinging-cable-n50": ("points",),
}
#: One run after the other until this much CPU [s] is used, but at least this many of each.
PATIENCE, FEWEST = 10.0, 2


def reduction(repeats: int) -> list[Figure]:
    """CPU of every run, and how many times that of the reduced model it is."""
    found = []
    for path, rules in SCENES.items():
        scene = load_scene(DECKS / f"{path}.adm")
        tried = [(), *((rule,) for rule in rules)]
        cpu: dict[tuple[str, ...], list[float]] = {left_off: [] for left_off in tried}
        turns = 0
        while turns < FEWEST or (turns < repeats and sum(map(sum, cpu.values())) < PATIENCE):
            for left_off in tried:
                results = adamslite.simulate(
                    scene.deck, commands=scene.commands, no_reduction=left_off
                )
                cpu[left_off].append(results.summary["solve_cpu_s"])
            turns += 1
        name, reduced = path.rpartition("/")[2], median(cpu[()])
        found.append(Figure("reduction", name, 1e3 * reduced, "ms"))
        for rule in rules:
            factor = median(cpu[rule,]) / reduced
            found.append(Figure("reduction", f"{name} without {rule}", factor, "times that"))
    return found
