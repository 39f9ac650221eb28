"""The advised model of a cable for a required accuracy, and its cost.

ERROR is a length: the error e of a place makes one of EA e/H in a tension T, and an integrator gets
a third of the accuracy, e = p T H/(3 EA).

Steps of a run, at least one for every result:

    VERLET  1.2 N c/H of a second                    waves in masses that nothing ties together
    HHT     a fortieth of (A/ERROR)^(1/3) w          other waves, friction
    GSTIFF  (A/ERROR)^(1/4) w, 2.5 times that with   constraints, no waves
            several sections, which it follows all

where A sin w t is the vibration of the linear model that needs most; without one 100 a period of
2 pi sqrt((M + rho l/3) l/EA) for GSTIFF and 0.7 c/H a second for HHT. CPU of a step is a + b N, in
parts of what this machine takes for a small piece of arithmetic; a, b and the numbers of steps are
measured on random scenes (benchmarks/advice.py).
"""

from dataclasses import dataclass
from functools import cache
from math import floor, log10, pi, sqrt
from time import perf_counter

from adamslite.cables.model.demand import (
    NEGLIGIBLE,
    Demand,
    elements,
    form,
    is_lively,
    level,
    loaded,
)
from adamslite.cables.model.response import steps_of

# Of a quotient of decimal numbers.
ROUND_OFF = 1e-9
# Steps by wave and section without a linear model, and in a period.
PER_CROSSING = {"VERLET": 1.2, "HHT": 0.7}
PER_PERIOD = 100.0
# Steps for a result; order in which the error of a step falls, and the share of its steps.
PER_RESULT = {"GSTIFF": 1.02, "HHT": 1.15, "VERLET": 1.0}
ORDERS = {"GSTIFF": 4.0, "HHT": 3.0}
FOLLOWS = {"GSTIFF": 2.5, "HHT": 1 / 40}
RESULTS = 200
# CPU of a step and of a section in it, where the piece of arithmetic takes PIECE [s]: of fixed
# sections, tied ones, and growing ones.
STEP_CPU = {
    "GSTIFF": ((0.6e-6, 0.13e-6), (3e-6, 0.4e-6), (5e-6, 1.6e-6)),
    "HHT": ((0.3e-6, 0.11e-6), (2.2e-6, 0.17e-6), (4.2e-6, 0.75e-6)),
    "VERLET": ((0.3e-6, 0.005e-6), (0.3e-6, 0.005e-6), (0.3e-6, 0.005e-6)),
}  # fmt: skip
RIGID_CPU = 3e-6
# Explicit sections that pull only, in those that push too.
CORNERS = 4.0
# Iterations of a step with sections that become slack, or friction, in those of others.
ITERATED = 2.2
# Stages of a step of RADAU.
THREE = 3
# Sections of the linear model whose vibrations tell the steps.
FOLLOWED = 32
PIECE = 1.25e-3
# Of the length: below, round-off of the places is in the way.
TIGHTEST = 1e-9
# Of the accuracy: what an integrator may use.
ERROR_SHARE = 1 / 3


@dataclass(frozen=True)
class Advice:
    """Level, form of level 3, sections of the span, integrator with ERROR [length], CPU [s]."""

    accuracy: float
    level: int
    form: str
    elements: int
    integrator: str
    error: float
    cost: float


def advise(of: Demand, p: float) -> Advice:
    """The cheapest model that meets the relative accuracy `p`."""
    chosen, sections = level(of, p), elements(of, p)
    method, _ = integrator(of, p, chosen)
    sections = 0 if chosen == 1 else sections
    error = error_bound(of, p, sections)
    return Advice(
        p, chosen, form(of, p) if chosen == 3 else "", sections, method, error,
        _cost(of, method, chosen, sections, error),
    )  # fmt: skip


def error_bound(of: Demand, p: float, sections: int) -> float:
    """ERROR: the length that changes the least tension by a share of `p`."""
    left = of.left(p)
    strain = loaded(of) / of.stiffness if left is None else max(left.load, NEGLIGIBLE)
    error = ERROR_SHARE * p * strain * of.length / max(sections, 1)
    return _rounded(max(error, TIGHTEST * of.longest))


def integrator(of: Demand, p: float, chosen: int) -> tuple[str, str]:
    """Its method, and why."""
    if chosen == 1:
        return "GSTIFF", "constraints, and no fast vibration"
    if of.rubs:
        return "HHT", "friction that a small sliding speed builds up"
    if not is_lively(of, p):
        return "GSTIFF", "slow motion, which long steps of high order follow"
    damped = max((each.network.damping_time for each in of.machines), default=0.0)
    if chosen == 2 and not of.tied and 2 * damped * elements(of, p) < of.transit:
        return "VERLET", "fronts in masses that nothing ties together"
    return "HHT", "waves are followed with many small steps"


def _cost(of: Demand, method: str, chosen: int, sections: int, error: float) -> float:
    """CPU [s] of a run without set-up."""
    return expected(of, method, chosen, sections, error) * speed()


def expected(of: Demand, method: str, chosen: int, sections: int, error: float) -> float:
    """The same where costs were measured."""
    return work(of, method, chosen, _steps(of, method, chosen, sections, error), sections)


def work(of: Demand, method: str, chosen: int, steps: float, sections: int) -> float:
    """CPU [s] of so many steps where costs were measured."""
    spans = len(of.machines[0].network.bars) if of.machines else 1
    if chosen == 1:
        return steps * RIGID_CPU * spans
    if method == "RADAU":
        return THREE * work(of, "GSTIFF", chosen, steps, sections)
    base, each = STEP_CPU[method][2 if chosen == 3 else int(of.tied)]
    if of.slackens and method == "VERLET":
        each *= CORNERS
    elif of.slackens or of.rubs:
        steps *= ITERATED
    return steps * spans * (base + each * max(sections, 1))


def _steps(of: Demand, method: str, chosen: int, sections: int, error: float) -> float:
    """Steps of a run."""
    method = "GSTIFF" if method == "RADAU" else method
    results = PER_RESULT[method] * (of.results or RESULTS)
    if chosen == 1:
        return results
    if method == "VERLET" or not of.machines and method == "HHT":
        steps = PER_CROSSING[method] * of.end * of.c * sections / of.length
    elif of.machines:
        share = 1.0 if method == "GSTIFF" and sections == 1 else FOLLOWS[method]
        # The model may be in other units of length than the demand.
        bound = error * of.machines[0].longest / of.length
        steps = share * steps_of(of.machines[0], min(sections, FOLLOWED), bound, ORDERS[method])
    else:
        carried = of.moved + of.density * of.length / 3
        steps = PER_PERIOD * of.end / (2 * pi * sqrt(carried * of.length / of.stiffness))
    return max(steps, results)


@cache
def speed() -> float:
    """Time of a small piece of arithmetic, in parts of what it took where costs were measured.

    The clock of CPU ticks too slowly on some machines; the least of some times is hardly disturbed.
    """
    taken = []
    for _ in range(5):
        start = perf_counter()
        total = 0.0
        for k in range(20000):
            total += (k % 7) * 1e-3 / (1.0 + total)
        taken.append(perf_counter() - start)
    return min(taken) / PIECE


def notched(value: float, steps: int) -> float:
    """The size that comes so many steps behind one of 1, 2, 5, 10, 20 ..."""
    value = _rounded(value)
    power = floor(log10(value) + ROUND_OFF)
    at = (1, 2, 5).index(round(value / 10.0**power)) + 3 * power + steps
    return float(f"{(1, 2, 5)[at % 3]}e{at // 3}")


def _rounded(value: float) -> float:
    """The next lower of 1, 2, 5, 10, 20 ..."""
    power = 10.0 ** floor(log10(value))
    return next(k for k in (5, 2, 1) if k * power <= value * (1 + ROUND_OFF)) * power
