"""The same second-order method with the same number of steps, next to hand-coded C.

Ours is HHT with equal steps, the C limit and Exudyn generalised alpha with the same damping of the
highest frequencies: the errors agree, so it is the same numerical work.
"""

from __future__ import annotations

from benchmarks.measure import Crew, Point, first_run, point, repeat_in_turns, warm_up
from benchmarks.peers import PROGRAMS
from benchmarks.peers.ours import FIXED_STEPS
from benchmarks.scenes import sizes

STEPS = {"S1": 1000, "S2": 500}
NAMES = (FIXED_STEPS.name, "C generalised alpha", "Exudyn GeneralizedAlpha")
#: How the points are told from those of the ladders.
SUFFIX = ", equal steps"


def same_method(crew: Crew, largest: int) -> list[Point]:
    """Measure the installed ones of ``NAMES``, taking turns."""
    made: list[Point] = []
    for scene, steps in STEPS.items():
        for n in (n for n in sizes(scene) if n <= largest):
            if crew.effort.over:
                return made
            made += _one(scene, n, steps, crew)
    return made


def _one(scene: str, n: int, steps: int, crew: Crew) -> list[Point]:
    names = [name for name in NAMES if PROGRAMS[name].installed()]
    points = [point(name, scene, n, {"steps": steps}) for name in names]
    for p in points:
        warm_up(crew[p.program], PROGRAMS[p.program], p)
        first_run(crew[p.program], p)
    repeat_in_turns(crew, points, crew.effort)
    for p in points:
        p.scene += SUFFIX
    return points
