"""How CPU per step grows with the number of masses: CPU/step ~ N^exponent, N = 10 to 10000.

The start of S1: for as long as a wave takes through the same number of segments at every N, or, for
programs that do that in a few steps, for the same time: their first steps all have new matrices,
and cost several times the later ones. Every program runs one setting: what a step costs hardly
depends on how accurate it is.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from benchmarks.measure import Crew, Point, first_run, point, repeat_in_turns, warm_up
from benchmarks.peers import PROGRAMS
from benchmarks.peers.program import Program, Settings
from benchmarks.points import Row
from benchmarks.scenes import FALLING, SCALING_SIZES, STARTING

#: Enough for the explicit methods at every N, see ``SEGMENTS_PASSED``.
STEPS = 600
SETTINGS: tuple[Settings, ...] = (
    {"error": 1e-4}, {"steps": STEPS}, {"rtol": 1e-5, "atol": 1e-7},
)  # fmt: skip
#: The exponent counts from here on: below, what a step costs anyway shows.
FROM = 50
#: Fewer steps than this in ``STARTING`` at ``PROBE`` masses are mostly first steps.
LEAST_STEPS = 60
PROBE = 1000


def setting(program: Program) -> Settings | None:
    """The setting of ``SETTINGS`` that a program understands."""
    ladder = program.ladder("S1", 10)
    return next((s for s in SETTINGS if ladder and set(s) == set(ladder[0])), None)


def growth(names: Iterable[str], crew: Crew, largest: int) -> list[Point]:
    """Measure every program that can do S1, N by N, until a run is too dear."""
    made: list[Point] = []
    for name in names:
        program = PROGRAMS[name]
        settings = setting(program) if "S1" in program.scenes else None
        if settings is None or crew.effort.over:
            continue
        scene = worth_measuring(name, settings, crew, min(PROBE, largest))
        points: list[Point] = []
        for n in (n for n in SCALING_SIZES if n <= largest):
            if points and cost_at(points[-1], n) > crew.effort.budget:
                break
            first = point(name, scene, n, settings)
            warm_up(crew[name], program, first)
            points.append(first_run(crew[name], first))
            if not points[-1].ok:
                break
        repeat_in_turns(crew, points, crew.effort)
        made += points
        if not crew.effort.lasting:
            crew.close()
    return made


def worth_measuring(name: str, settings: Settings, crew: Crew, n: int) -> str:
    """The start of S1 in which a program takes more than its first steps."""
    probe = point(name, STARTING, n, settings)
    warm_up(crew[name], PROGRAMS[name], probe)
    probe = first_run(crew[name], probe)
    return FALLING if probe.ok and probe.steps < LEAST_STEPS else STARTING


def cost_at(last: Point, n: int) -> float:
    """CPU [s] to expect at another N, set-up and a little more than linear growth included."""
    return (last.median + (last.setup or 0.0)) * (n / last.n) ** 1.3


def exponent(rows: Iterable[Row]) -> float | None:
    """Of CPU per step from ``FROM`` to the largest N."""
    costs = {r.n: r.cpu_median / r.steps for r in rows if r.ok and r.steps and r.n >= FROM}
    if len(costs) < 2:
        return None
    first, last = min(costs), max(costs)
    return math.log(costs[last] / costs[first]) / math.log(last / first)
