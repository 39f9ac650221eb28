"""A guard between the ends of a step: the cubic through its values and rates.

At the share x of a step, with values a, b and rates r, s per step,

    p(x) = a + r x + c x^2 + d x^3,    c = 3 (b - a) - 2 r - s,    d = 2 (a - b) + r + s

A margin that is positive at both ends was negative in between where p dips below zero; so near to
zero that p cannot decide, the dense output is evaluated, and also where the tangents at both ends
meet below zero: a distance between markers that pass each other is almost a kink there.
Where p fails to predict what is found inside, the step is examined window by window
(:mod:`adamslite.integrators.events.windows`).
The place D within the zone of a smooth step follows the same cubic: a step that touches the zone
0 < D < 1 may change D by a share of it, or it would pass a force without having felt it.  So does
the argument of a table: a step may pass pieces that are one smooth curve, no others.
Before it is tried, D is continued by its rate at the start.
A pole, what an expression divides by, may come down to a quarter within a step at most: a step ends
where an expression that grows beyond all bounds is felt, and passes none.  A root, what SQRT takes,
only must not change its sign.

Reference: Shampine, Gladwell, Brankin, ACM Trans. Math. Softw. 17 (1991) 11, "Reliable solution of
special event location problems for ODEs".
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import (
    END,
    INSIDE,
    NARROW,
    NONE,
    POLE,
    ROOT,
    START,
    ZONE,
    ZONE_EARLY,
    ZONE_LATE,
)
from adamslite.integrators.linalg.plan import HUGE
from adamslite.kernels.code.lookup import count_up_to
from adamslite.native.translate import Reals, native

# Rates are differences over this share of the step.
LITTLE = 1e-3
# A dip is examined when it comes nearer to zero than this share of the rates at both ends.
NEAR = 0.05
# No dip is looked for where the lower end is above this share of the rates: tangents do not meet
# below zero, and no cubic dips that far (4/27).
DEEPEST = 0.25
# Share of a zone that a step may cross, and this multiple of ERROR^(1/3) where a method of order 2
# does not test velocities; what it aims at when it may not, as a part of that; how far before the
# zone it stops when it comes from outside.
SHARE_OF_ZONE, UNTESTED, AIM, BEFORE_ZONE = 0.34, 3.0, 0.7, 0.02
# As much more may be that of a narrow function.
WIDER = 1.7
# A step brings a pole down to no less than this part of its value; part that it aims at else.
NEAR_POLE, AIM_AT_POLE = 0.25, 0.35
# Shorter steps are not made for the sake of a zone, as a share of HMAX.
LEAST_CUT = 1e-10
# Poles and narrow zones need no look for so many steps, while they come nearer by no more than this
# share of the way to them.
MOST_QUIET, LITTLE_NEARER = 16.0, 0.1
# Halvings in the solution of a cubic.
HALVINGS = 50


@native
def rates(P: Problem, row: int, target: int, zone_target: int) -> None:
    """Rates between the end of the step in ``row`` and the last place examined inside, per time."""
    count, zones = P.sizes.watched, P.sizes.zones
    w = 1.0 / (LITTLE * P.search.size)
    if row == START:
        w = 0.0 - w
    for k in range(count):
        P.margin[target * count + k] = w * (
            P.margin[row * count + k] - P.margin[INSIDE * count + k]
        )
    for k in range(zones):
        P.zone[zone_target * zones + k] = w * (P.zone[row * zones + k] - P.zone[INSIDE * zones + k])


@native
def dip(a: float, b: float, r: float, s: float, behind: float) -> float:
    """The first share behind another at which a guard may be below zero, else ``NONE``."""
    low, bend = lowest(a, b, r, s), meeting(a, b, r, s)
    if not (behind < low and cubic(a, b, r, s, low) < NEAR * (abs(r) + abs(s))):
        low = NONE
    return min(low, bend) if behind < bend else low


@native
def tangent(near: float, far: float, rise: float, reach: float, other: float) -> float:
    """The slope at an end of a step of the cubic that rises by ``rise`` in it, from its difference
    quotients at this end and at the other one, which reach so far inwards, as shares of the step.

    As slopes they would be off by as much as the curve bends within their reach, which hides what
    is passed in less.
    """
    here = near - rise * reach * (3.0 - 2.0 * reach)
    there = far - rise * other * (3.0 - 2.0 * other)
    own, opposite = (1.0 - reach) * (1.0 - reach), (1.0 - other) * (1.0 - other)
    mixed = reach * (1.0 - reach) * other * (1.0 - other)
    return (opposite * here + reach * (1.0 - reach) * there) / (own * opposite - mixed)


@native
def meeting(a: float, b: float, r: float, s: float) -> float:
    """The share at which the tangents at both ends meet below zero, else ``NONE``.

    A distance that is passed bends where they meet, more sharply than a cubic may.
    """
    if not (a >= 0.0 and b >= 0.0 and r < 0.0 and s > 0.0):
        return NONE
    share = (a - b + s) / (s - r)
    return share if a + r * share < 0.0 else NONE


@native
def lowest(a: float, b: float, r: float, s: float) -> float:
    """The share at which the cubic has a minimum inside of the step, else ``NONE``."""
    c, d = 3.0 * (b - a) - 2.0 * r - s, 2.0 * (a - b) + r + s
    root = c * c - 3.0 * d * r
    if not root > 0.0:
        return NONE
    root = root**0.5
    if c > 0.0:
        share = 0.0 - r / (c + root)
    elif d != 0.0:
        share = (root - c) / (3.0 * d)
    else:
        return NONE
    return share if 0.0 < share and share < 1.0 else NONE


@native
def cubic(a: float, b: float, r: float, s: float, x: float) -> float:
    """p(x)"""
    return a + x * (r + x * (3.0 * (b - a) - 2.0 * r - s + x * (2.0 * (a - b) + r + s)))


@native
def share_of_zone(P: Problem, tested: bool) -> float:
    """Share of a zone that a step may cross; ``tested``: errors of velocities are."""
    if tested:
        return SHARE_OF_ZONE
    return min(SHARE_OF_ZONE, UNTESTED * P.settings.error ** (1.0 / 3.0))


@native
def span_of(P: Problem, kind: int) -> float:
    """Share of a zone that a step may cross; more of that of a narrow function, which may be wide
    for the motion.
    """
    return min(SHARE_OF_ZONE, WIDER * P.search.span) if kind == NARROW else P.search.span


@native
def share_into_zones(P: Problem) -> float:
    """The share of the step that crosses no zone too quickly; ``NONE`` when the whole does not."""
    count, h, least = P.sizes.zones, P.search.size, NONE
    if count == 0 or P.settings.fixed_step > 0.0:
        return NONE
    for k in range(count):
        a, b = P.zone[START * count + k], P.zone[END * count + k]
        r, s = h * P.zone[ZONE_EARLY * count + k], h * P.zone[ZONE_LATE * count + k]
        kind = P.kind[P.sizes.clocks + P.sizes.watched + k]
        if kind == POLE or kind == ROOT:
            least = min(least, share_off_pole(P, kind, a, b, r, s))
            continue
        if kind < 0:
            T = P.reach[0 - 1 - kind :]
            least = min(least, share_into_table(T, a, b, r, s, P.search.span))
            continue
        span = span_of(P, kind)
        # The cubic stays between these: most steps are outside of most zones.
        low = min(a, b) - DEEPEST * (abs(r) + abs(s))
        high = max(a, b) + DEEPEST * (abs(r) + abs(s))
        if low < 1.0 and high > 0.0 and high - low > span and high - low < HUGE:
            # Downwards is upwards in 1 - D.
            least = min(least, share_into(a, b, r, s, span))
            least = min(least, share_into(1.0 - a, 1.0 - b, 0.0 - r, 0.0 - s, span))
    return least if least * h > LEAST_CUT * P.settings.h_max else NONE


@native
def share_off_pole(P: Problem, kind: int, a: float, b: float, r: float, s: float) -> float:
    """The share of the step that ends away from a pole or a root; ``NONE`` for the whole."""
    ahead, above = P.search.ahead / P.search.size, NEAR_POLE
    if kind == ROOT:
        above = 0.0
    if a < 0.0:
        a, b, r, s = 0.0 - a, 0.0 - b, 0.0 - r, 0.0 - s
    # The cubic stays above this.
    if not (a > 0.0 and min(a, b) - DEEPEST * (abs(r) + abs(s)) < above * a and abs(b) < HUGE):
        return NONE
    slope = tangent(r, s, b - a, ahead, LITTLE)
    r, s = slope, tangent(s, r, b - a, LITTLE, ahead)
    low, place = b, 1.0
    share = lowest(a, b, r, s)
    if share < 1.0 and cubic(a, b, r, s, share) < low:
        low, place = cubic(a, b, r, s, share), share
    if not low < above * a:
        return NONE
    return share_below(a, b, r, s, place, AIM_AT_POLE * a)


@native
def share_below(a: float, b: float, r: float, s: float, end: float, level: float) -> float:
    """The share before ``end`` at which the cubic falls to a level, by halving."""
    low, high = 0.0, end
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if cubic(a, b, r, s, middle) > level:
            low = middle
        else:
            high = middle
    return low


@native
def quiet_time(P: Problem) -> float:
    """Time after the step for which poles, narrow zones and what is not smooth of a table stay far
    away, by their rates and what these changed in the step; 0 with other zones.
    """
    count, h, time = P.sizes.zones, P.search.size, MOST_QUIET * P.search.size
    for k in range(count):
        kind, b = P.kind[P.sizes.clocks + k], P.zone[END * count + k]
        if kind == ZONE:
            return 0.0
        way = LITTLE_NEARER * (max(0.0 - b, b - 1.0) if kind == NARROW else abs(b))
        if kind < 0:
            way = LITTLE_NEARER * room_in_table(P.reach[0 - 1 - kind :], b)
        rate = abs(P.zone[ZONE_LATE * count + k])
        bend = abs(P.zone[ZONE_LATE * count + k] - P.zone[ZONE_EARLY * count + k]) / h
        while time > 0.0 and time * (rate + bend * time) > way:
            time = 0.5 * time if time > h else 0.0
    return time


@native
def expected_share(P: Problem, h: float) -> float:
    """The share of the step ahead that crosses no zone too quickly at the present rates; ``NONE``
    when the whole does not, or when they are not known.
    """
    count, least = P.sizes.zones, NONE
    if count == 0 or P.settings.fixed_step > 0.0 or not P.search.known:
        return NONE
    for k in range(count):
        a, r = P.zone[START * count + k], h * P.zone[ZONE_EARLY * count + k]
        kind = P.kind[P.sizes.clocks + P.sizes.watched + k]
        if kind == POLE or kind == ROOT:
            continue
        if kind < 0:
            T = P.reach[0 - 1 - kind :]
            least = min(least, share_into_table(T, a, a + r, r, r, P.search.span))
            continue
        span = span_of(P, kind)
        if abs(r) > span and min(a, a + r) < 1.0 and max(a, a + r) > 0.0 and abs(r) < HUGE:
            least = min(least, share_into(a, a + r, r, r, span))
            least = min(least, share_into(1.0 - a, 1.0 - a - r, 0.0 - r, 0.0 - r, span))
    return least if least * h > LEAST_CUT * P.settings.h_max else NONE


@native
def share_into(a: float, b: float, r: float, s: float, span: float) -> float:
    """The share of the step that moves upwards in a zone by no more than ``span``."""
    level = a + AIM * span
    if a < 0.0 - 2.0 * BEFORE_ZONE:
        level = 0.0 - BEFORE_ZONE
    return share_up_to(a, b, r, s, level, max(0.0, a + span)) if a < 1.0 else NONE


@native
def share_into_table(T: Reals, a: float, b: float, r: float, s: float, span: float) -> float:
    """The share of the step that passes no more pieces of a table than are one smooth curve;
    ``T``: as :func:`adamslite.symbolic.interpolant.reach` has it.
    """
    n = int(T[0])
    if not abs(b - a) + abs(r) + abs(s) < HUGE:
        return NONE
    away = turns_in_table(T, a)
    a, b = a - away, b - away
    up = share_up_table(T[3:], n, a, b, r, s, span)
    return min(up, share_up_table(T[5 + 3 * n :], n, 0.0 - a, 0.0 - b, 0.0 - r, 0.0 - s, span))


@native
def turns_in_table(T: Reals, x: float) -> float:
    """Whole periods of a table up to ``x``."""
    return floor((x - T[2]) / T[1]) * T[1] if T[1] > 0.0 else 0.0


@native
def room_in_table(T: Reals, x: float) -> float:
    """How far it is from ``x`` to where a step has to end."""
    n, up, down = int(T[0]), T[3:], T[5 + 3 * int(T[0]) :]
    x -= turns_in_table(T, x)
    k, j = count_up_to(up, n, x), count_up_to(down, n, 0.0 - x)
    return max(0.0, min(up[n + k] - x, down[n + j] + x))


@native
def share_up_table(T: Reals, n: int, a: float, b: float, r: float, s: float, span: float) -> float:
    """The same for one direction; of the pieces a step passes a share: ends may hide a hump."""
    k = count_up_to(T, n, a)
    level, most = T[n + k], T[2 * n + 1 + k]
    if k > 0:
        level = min(level, a + span * (level - T[k - 1]))
        most = min(most, level)
    return share_up_to(a, b, r, s, level, most)


@native
def share_up_to(a: float, b: float, r: float, s: float, level: float, most: float) -> float:
    """The share of the step that moves upwards to ``level``, where it goes beyond ``most``."""
    top, peak = b, 1.0
    highest = lowest(0.0 - a, 0.0 - b, 0.0 - r, 0.0 - s)
    if highest < 1.0:
        inside = cubic(a, b, r, s, highest)
        if inside > top:
            top, peak = inside, highest
    if not top > most:
        return NONE
    return share_below(0.0 - a, 0.0 - b, 0.0 - r, 0.0 - s, peak, 0.0 - level)
