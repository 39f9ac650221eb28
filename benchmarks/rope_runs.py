"""Runs of cable scenes: by a model, by ever dearer ones, and how far two of them are apart.

Truth is the model with sections doubled and ERROR a third, again and again, until all figures
stand still to p/10: with d the difference of the last two and f what it is of the one before, at
least 1/4 and at most 1/2, the last is d f/(1 - f) off. A figure is the greatest, least or mean
tension at either end of a span, as a share of the greatest there, and the greatest, least or mean
place of a weight, as a share of its way. Nothing here is that of
:mod:`adamslite.cables.trials.trial`, whose choices it judges.
"""

from __future__ import annotations

import math
import re
import resource
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from benchmarks.rope_scenes import Table, toml

#: Of p: a change of all figures that small is none.
STILL = 0.1
MOST_SECTIONS = 900
#: Speeds below this share of gravity's, over the length of the cable, are round-off.
NOTHING = 1e-6
#: A run's CPU is not told from less [s].
CLOCK = 1e-3
#: ERROR of a truth, from one to the next.
FINER = 3.0
#: Work of twice the sections and a third of ERROR.
GROWTH = 4
#: Sections of the first truth, of those of the finest run that the advice rests on.
BEGIN, FEWEST = 0.75, 6
#: How much smaller a difference is than the one before it: powers 2 and 1 of the sections.
FASTEST, SLOWEST = 0.25, 0.5


@dataclass(frozen=True)
class Model:
    """What a description asks for; level 0 is auto."""

    level: int = 0
    form: str = "auto"
    elements: int = 0
    error: float = 0.0


@dataclass(frozen=True)
class Solved:
    """Figures of a run by name, with their scales, and its CPU [s]."""

    figures: dict[str, float]
    scales: dict[str, float]
    cpu: float
    model: Model


def described(table: Table, model: Model, p: float) -> str:
    """The text of a scene with a model."""
    wanted: dict[str, Any] = {"accuracy": p}
    if model.level:
        wanted["level"] = model.level
    if model.form != "auto" and model.level in (0, 3):
        wanted["form"] = model.form
    if model.elements:
        wanted["elements"] = model.elements
    top = {"error": model.error} if model.error else {}
    return toml({**top, **table, "model": wanted})


def solve(table: Table, model: Model, p: float, method: str = "") -> Solved:
    """The scene by a model."""
    from adamslite.cables.deck.scene import deck

    text, _ = deck(described(table, model, p))
    if method:
        text = re.sub(r"(?m)^INTEGRATOR/[^\n]*(, ERROR=)", f"INTEGRATOR/{method}\\1", text)
    return solved(table, text, model)


def solved(table: Table, text: str, model: Model) -> Solved:
    """The run of a deck of a scene."""
    import adamslite

    run = adamslite.simulate(adamslite.read(text))
    if run.outcome.name != "DONE":
        raise RuntimeError(f"{run.outcome.name}: {run.message}")
    figures, scales = figures_of(table, run)
    return Solved(figures, scales, max(run.summary["solve_cpu_s"], CLOCK), model)


def figures_of(table: Table, run: Any) -> tuple[dict[str, float], dict[str, float]]:
    """Greatest, least and mean of tensions and places, and the scale of each."""
    cable, route = table["cable"], table["route"]
    transit = length_of(table) * math.sqrt(cable["rho"] / cable["EA"])
    window = max(int(round(transit / 2 / (run.time[1] - run.time[0]))), 1)
    figures, scales = {}, {}

    def keep(name: str, values: np.ndarray, scale: float) -> None:
        for word in ("max", "min", "mean"):
            figures[f"{name} {word}"] = float(getattr(values, word)())
            scales[f"{name} {word}"] = scale

    for p in range(1, len(route)):
        for end in tensions(run, p):
            pull = smoothed(run[end] * (-1 if end.startswith("GCON") else 1), window)
            which = end[-1] if end.startswith("REQ") else "f"
            keep(f"T{p}.{which}", pull, float(np.abs(pull).max()))
    for i, each in enumerate(route):
        if each["kind"] == "mass":
            ways = [run[f"POINT_MASS/{10 * (i + 1)}.{a}"] for a in "XYZ"]
            moved = math.sqrt(sum((w - w[0]).max() ** 2 + (w - w[0]).min() ** 2 for w in ways))
            if moved > NOTHING * length_of(table):
                for a, w in zip("XYZ", ways, strict=True):
                    keep(f"{a}{i + 1}", w - w[0], moved)
    return figures, scales


def tensions(run: Any, p: int) -> list[str]:
    """Channels of the tension at both ends of span p."""
    names = set(run.names)
    found = [f"REQUEST/{p}.{f}" for f in ("F2", "F3")]
    found = [name for name in found if name in names and np.any(run[name])]
    return found or [name for name in (f"GCON/{p}.f",) if name in names]


def length_of(table: Table) -> float:
    """Of the longest span [m]."""
    places = [each["at"] for each in table["route"]]
    return max(math.dist(a, b) for a, b in zip(places, places[1:], strict=False))


def smoothed(values: np.ndarray, window: int) -> np.ndarray:
    """Moving mean: a front's overshoot in a chain of masses is none of the cable's."""
    if window < 2 or window >= len(values):
        return values
    return np.convolve(values, np.ones(window) / window, "valid")


def apart(one: Solved, truth: Solved, p: float) -> tuple[float, str]:
    """The largest difference of a figure in p, and its name."""
    worst, name = 0.0, ""
    for each, exact in truth.figures.items():
        found = match(one.figures, each)
        if found is None or not truth.scales[each]:
            continue
        off = abs(found - exact) / truth.scales[each] / p
        if not off <= worst:
            worst, name = off, each
    return worst, name


def match(figures: dict[str, float], name: str) -> float | None:
    """A figure of a model that may have one tension for both ends of a span."""
    both = re.sub(r"^(T\d+)\.\d", r"\1.f", name)
    return figures.get(name, figures.get(both))


def truths(
    table: Table, above: list[Model], p: float, budget: float
) -> Iterator[tuple[Solved, float]]:
    """Dearer and dearer models, at last dearer than all those `above` which they stand, each with
    how far it is from the one before, in p."""
    level = max((each.level for each in above if each.level > 1), default=3)
    finest = max(each.elements for each in above)
    count = min(max(math.ceil(BEGIN * finest), FEWEST), MOST_SECTIONS // 4)
    tightest = min(each.error for each in above if each.error)
    exact = Model(level, "ale" if level == 3 else "auto", count,
                  min(tightest, base_error(table, p, count)) / FINER)  # fmt: skip
    before: Solved | None = None
    apart_before = 0.0
    begun, cpu = resource.getrusage(resource.RUSAGE_SELF).ru_utime, 0.0
    while True:
        try:
            run = solve(table, exact, p)
        except RuntimeError:
            run = None
        if run is not None:
            cpu = run.cpu
            if before is not None:
                doubt = apart(before, run, p)[0]
                left = remaining(doubt, apart_before)
                if exact.elements > finest:
                    yield run, left
                    if left <= STILL:
                        return
                apart_before = doubt
            before = run
        left = budget + begun - resource.getrusage(resource.RUSAGE_SELF).ru_utime
        if GROWTH * cpu > left or exact.elements >= MOST_SECTIONS:
            return
        exact = replace(exact, elements=min(2 * exact.elements, MOST_SECTIONS),
                        error=exact.error / FINER)  # fmt: skip


def remaining(last: float, before: float) -> float:
    """What a run is off, by the last differences; with the first of them alone, by that one."""
    falls = min(max(last / before, FASTEST), SLOWEST) if before else SLOWEST
    return last * falls / (1 - falls)


def base_error(table: Table, p: float, sections: int) -> float:
    """p T H/EA of the lightest load."""
    cable = table["cable"]
    loads = [each["mass"] * 9.81 for each in table["route"] if each["kind"] == "mass"]
    pull = cable.get("pretension") or min(loads)
    return p * pull * length_of(table) / sections / cable["EA"] / 3
