"""The advised model of a cable for a required accuracy, and its cost.

ERROR is a length: the error e of a place makes one of EA e/H in a tension T, so e = p T H/EA.

    method  for                          steps in the run   CPU per step and section
    VERLET  fronts, masses nothing ties  2.5 end c/H        0.13 us
    HHT     other fronts                 0.7 end c/H        0.6 us fixed, 2.4 us growing sections
    GSTIFF  no fronts                    100 a period of the span with what it carries, as HHT

Implicit methods take 400 steps at least. The period is 2 pi sqrt((M + rho l/3) l/EA). Measured with
decks/cables: right within a factor of three or so.
"""

from dataclasses import dataclass
from math import floor, log10, pi, sqrt

from adamslite.cables.demand import (
    NEGLIGIBLE,
    Demand,
    elements,
    form,
    is_lively,
    level,
    loaded,
)

# Of a quotient of decimal numbers.
ROUND_OFF = 1e-9
PER_CROSSING = {"VERLET": 2.5, "HHT": 0.7}
PER_PERIOD, FEWEST_STEPS = 100.0, 400.0
VERLET_CPU, FIXED_CPU, GROWING_CPU = 0.13e-6, 0.6e-6, 2.4e-6
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
    return Advice(
        p, chosen, form(of, p) if chosen == 3 else "", sections, method,
        error_bound(of, p, sections), _cost(of, method, chosen, sections),
    )  # fmt: skip


def error_bound(of: Demand, p: float, sections: int) -> float:
    """ERROR: the length that changes the least tension by a share of `p`."""
    left = of.left(p)
    load = loaded(of) if left is None else max(left.load, NEGLIGIBLE)
    error = ERROR_SHARE * p * load * of.length / max(sections, 1) / of.stiffness
    return _rounded(max(error, TIGHTEST * of.longest))


def integrator(of: Demand, p: float, chosen: int) -> tuple[str, str]:
    """Its method, and why."""
    if chosen == 1:
        return "GSTIFF", "constraints, and no fast vibration"
    if of.rubs:
        return "HHT", "friction that a small sliding speed builds up"
    if not is_lively(of, p):
        return "GSTIFF", "slow motion, which long steps of high order follow"
    if chosen == 2 and not of.tied:
        return "VERLET", "fronts in masses that nothing ties together"
    return "HHT", "waves are followed with many small steps"


def _cost(of: Demand, method: str, chosen: int, sections: int) -> float:
    """CPU [s] of a run without set-up."""
    if method in PER_CROSSING:
        steps = PER_CROSSING[method] * of.end * of.c * sections / of.length
    else:
        carried = of.moved + of.density * of.length / 3
        steps = PER_PERIOD * of.end / (2 * pi * sqrt(carried * of.length / of.stiffness))
    if method == "VERLET":
        return steps * sections * VERLET_CPU
    each = GROWING_CPU if chosen == 3 else FIXED_CPU
    return max(steps, FEWEST_STEPS) * max(sections, 1) * each


def _rounded(value: float) -> float:
    """The next lower of 1, 2, 5, 10, 20 ..."""
    power = 10.0 ** floor(log10(value))
    return next(k for k in (5, 2, 1) if k * power <= value * (1 + ROUND_OFF)) * power
