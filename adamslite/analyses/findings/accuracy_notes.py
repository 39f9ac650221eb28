"""What a run reports of its own accuracy where ERROR, which bounds a step, does not cover it.

Every method adds up the errors that it estimated for its accepted steps.  Where nothing amplifies
or damps them, their sum bounds what the end is off by; it is compared with the longest way of a
body.  An oscillation between events (contacts, dead zones) amplifies them: its period depends on
its speed, so that an error of one pass shifts every later event; n events make 1 + n/``SHIFTED`` of
a sum.  Sums are of what is propagated: RADAU's estimate e, of order 3, stands for one of order 5
and counts as e^(3/2).
"""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from adamslite.integrators import contract
from adamslite.integrators.jolts import JOLT
from adamslite.language.method import FIXED, FIXED_BY_HINIT

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings
    from adamslite.analyses.dynamics.history import History
    from adamslite.equations.system import System

# ERROR up to which a user means digits that methods of order 2, or without a test of velocities, do
# not have to offer.
FINE = 1e-6
# Share of rough steps that is reported.
OFTEN = 0.05
# Share of the longest way that added errors may come to untold. Stiff contacts turn errors of
# places into errors of speeds, and sums of backward differences came out up to 12 times short of
# the error of 1830 random decks: with half the share none of those off by 1e-3 is left untold.
FELT, FELT_BY_BDF = 1e-3, 5e-4
FIRST_ORDER = 1e-9
# Events after which a sum counts twice: an error r of the speed in cycle i of N shifts the end by
# 2 pi r (N - i) dlog(frequency)/dlog(speed) amplitudes. Dead zones with 85, 108, 123 events ended
# 4, 3.5 and 3.6 times their sums off (GSTIFF, ERROR of 1e-5 to 1e-8), one on a trolley that carries
# a pendulum, with 38 events, 9 times.
SHIFTED = 15.0
# Coordinates that go less than this share of the longest way say nothing about its weight.
MOVING = 0.1
# A way below this share of a coordinate is its rounding: the body is at rest.
ROUNDING = 1e-12
# Columns of results that are evaluated together.
COLUMNS = 1024
# So many of the states that are small against ERROR are named, the worst first.
WORST_STATES = 3


def accuracy_notes(
    system: System,
    settings: Settings,
    counts: contract.Counts,
    history: History,
) -> str:
    """What ERROR does not say about the accuracy of a run, in sentences; empty when it does.

    Parameters
    ----------
    system : System
        Behind the run.
    counts : Counts
        Steps, restarts and the like of all of it.
    history : History
        The records of it.
    """
    if settings.formula.steps == FIXED:
        return "equal steps without error test: compare a run with half of HINIT"
    report, steps = system.report, counts.steps
    shifted = 1.0 + float(counts.restarts) / SHIFTED
    way, reach = longest_way(history)
    spent = float(report.spent) * settings.error * shifted
    off = spent * max(1.0, reach)
    found = [*_of_method(settings, steps, report, off), *_added_up(settings, steps, off, way)]
    found += _of_small_states(settings, spent, history)
    if settings.form != settings.formula.formulations[0] and system.sizes.holonomic:
        found.append("I3 does not test velocities, so that their errors add up; SI2 does")
    return "; ".join(found)


def longest_way(history: History) -> tuple[float, float]:
    """The longest way of a body along an axis, and the largest coordinate of those that move.

    The way is 0 where nothing moves.
    """
    places = [k for k, name in enumerate(history.names) if name.endswith((".x", ".y", ".z"))
              and name.startswith(("PART/", "POINT_MASS/"))]  # fmt: skip
    if not places or not history.count:
        return 0.0, 0.0
    least, most = _extremes(history, places)
    if not (np.isfinite(least).all() and np.isfinite(most).all()):
        return 0.0, 0.0
    ways = most - least
    way, moving = float(ways.max()), ways >= MOVING * ways.max()
    sizes = np.maximum(np.abs(least), np.abs(most))
    # In a model of bodies that only turn, ways are the rounding of the places of any of them.
    return (way if way > ROUNDING * float(sizes.max()) else 0.0), float(sizes[moving].max())


def _extremes(history: History, places: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """The least and the largest values of some columns; not-a-number where there is one."""
    least, most = np.full(len(places), np.inf), np.full(len(places), -np.inf)
    for _, values in history.blocks():
        for first in range(0, len(places), COLUMNS):
            some = slice(first, first + COLUMNS)
            columns = values[:, places[some]]
            least[some] = np.minimum(least[some], columns.min(axis=0))
            most[some] = np.maximum(most[some], columns.max(axis=0))
    return least, most


def _of_method(
    settings: Settings, steps: int, report: contract.Report, off: float
) -> Iterator[str]:
    """What belongs to a formula."""
    method, (alpha, _, gamma) = settings.formula, settings.damping
    rough, divided = report.rough_steps, report.divided
    damps_more = bool(method.damping) and abs(gamma + alpha - 0.5) > FIRST_ORDER
    if damps_more:
        yield (
            f"with GAMMA={gamma:g} the formula is of order 1, and a run is off by the root of ERROR"
            " rather than by ERROR; HHT damps as well and is of order 2"
        )
    if method.damping and rough > OFTEN * steps:
        yield (
            f"accelerations changed by more than half in {rough} of {steps} steps: vibrations "
            "faster than the steps were damped, not followed; where they matter, GSTIFF or RADAU "
            "follow them"
        )
    if report.jolts > 0 or report.jolt > JOLT * report.speed > 0.0:
        yield (
            f"a velocity changed by about {report.jolt:.2g} within a step in a way that its ends "
            "do not show: impacts shorter than the steps were not followed; a smaller ERROR or "
            "HMAX follows them"
        )
    if method.damping and divided:
        yield (
            f"steps were divided {divided} times, because the corrector did not converge with the "
            f"requested {settings.hinit:g}: a shorter HINIT, or none, for an error test"
        )
    most = contract.STABLE * report.stable_step
    if method.steps == FIXED_BY_HINIT and settings.hinit and settings.hinit > most > 0.0:
        yield (
            f"HINIT={settings.hinit:g} is close to the longest stable step, "
            f"{report.stable_step:.3g} by estimate: above it vibrations grow without "
            f"bound; stay below {most:.3g}"
        )
    if method.order <= 2 and settings.error <= FINE and not damps_more:
        yield (
            f"the formula is of order {method.order}: {steps} steps of ERROR={settings.error:g} "
            f"add up to {off:.1e}; GSTIFF, RADAU or RKF45 get further with fewer"
        )


def _added_up(settings: Settings, steps: int, off: float, way: float) -> Iterator[str]:
    """What belongs to every method."""
    by_hinit = settings.formula.steps == FIXED_BY_HINIT
    fixed = settings.hinit and (by_hinit or settings.hinit == settings.hmin)
    remedy = "a shorter step" if fixed else f"a smaller ERROR than {settings.error:g}"
    felt = FELT_BY_BDF if settings.formula.family == "differences" else FELT
    if off > way > 0.0:
        yield (
            f"the estimated errors of {steps} steps add up to more than the longest way of a body, "
            "a bound that says nothing where forces damp them, as friction and contacts do: "
            f"a run with {remedy} shows what they come to"
        )
    elif off > felt * way > 0.0:
        yield (
            f"the estimated errors of {steps} steps add up to {off:.1e}, {off / way:.2%} of the "
            f"longest way of a body: {remedy} keeps more digits"
        )


def _of_small_states(settings: Settings, spent: float, history: History) -> Iterator[str]:
    """DIFF states so small that ERROR, which is absolute below 1, is a share of them: the worst."""
    found = []
    places = [k for k, name in enumerate(history.names) if name.startswith("DIFF/")]
    least, most = _extremes(history, places) if places else (np.zeros(0), np.zeros(0))
    for k, size in zip(places, np.maximum(-least, most).tolist(), strict=True):
        off = spent * max(1.0, size)
        if isfinite(size) and off > FELT * size > 0.0:
            found.append((off / size, off, history.names[k]))
    if not found:
        return
    found.sort(key=lambda state: -state[0])
    share, off, name = found[0]
    others = ", ".join(f"{each} {_share(part)}" for part, _, each in found[1:WORST_STATES])
    worst = f" ({others}, {len(found)} states in all)" if others else ""
    amount = f"{off:.1e}, {share:.1%} of" if share < 1.0 else "more than"
    yield (
        f"the estimated errors add up to {amount} the largest {name}{worst}: "
        f"a smaller ERROR than {settings.error:g}, or another unit of the state"
    )


def _share(part: float) -> str:
    """A share of a state; more than all of it is no share."""
    return f"{part:.1%}" if part < 1.0 else "too"
