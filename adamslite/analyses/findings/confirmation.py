"""`--confirm`: the same deck again, with a smaller ERROR and with an unrelated method.

With r the run, s the same method at ERROR/100 and w a method of another family at ERROR/100, both
with a balance of energy, steps of a fifth of the output step at most and at least ``LEAST_STEPS``
of them, which end at different times, a channel c is within

    bound_c = SAFETY max_t max(|r - s|, |r - w|, |s - w|) + ROUND_OFF max_t |c|

of the exact value: s and w err much less than r unless something is wrong with them, and then they
hardly err alike.  Angles are compared without whole turns.

The verdict is *confirmed* when both witnesses end as the run does, the balance of one closes, and
every bound is below ``AGREED`` of the largest value of its quantity (x, y and z of a body are one),
or round-off; psi and phi do not count where they are one angle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import inf, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.errors import UsageError
from adamslite.language.method import FIXED, declared, method_of
from adamslite.results.confirmation import Channel, Confirmation
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings

# Both witnesses are taken at ERROR over this, but not below what round-off leaves of a test.
TIGHTER, TIGHTEST = 100.0, 1e-12
# Steps of the witnesses: their length in output steps, and how many at least, a number that no
# multiple of usual output steps meets: what is shorter than a thousandth of a run and has no guard
# that leads to it (a narrow Gaussian) may be missed by all.
LARGEST_STEP, LEAST_STEPS = 0.25, 1013
# Parts of that step for the same method and for another one: no two of the three runs pass
# something between the same places.
OWN_PART, OTHER_PART = 0.755, 0.570
SAFETY, ROUND_OFF = 2.0, 1e-13
# Round-off: this share of the largest number of a run; sine of theta of no account.
NEGLIGIBLE, ALIGNED = 1e-12, 1e-6
# What is tried as a witness, in this order.
WITNESSES = ("RADAU", "ABAM", "GSTIFF")
# Columns that are one quantity, of which one may be zero.
TRIPLES = ("x y z", "psi theta phi", "vx vy vz", "wx wy wz", "ax ay az", "alx aly alz",
           "fx fy fz", "tx ty tz", "F2 F3 F4", "F6 F7 F8")  # fmt: skip
KIND = {word: triple for triple in TRIPLES for word in triple.split()}
ANGLES = ("psi", "theta", "phi")
#: A witness that was interrupted before it had anything.
EARLY = "interrupted"


def confirmation(
    results: Results, settings: Settings, again: Callable[..., Results]
) -> Confirmation:
    """Ask the witnesses of a run with these settings of its integrator.

    ``again(**options)`` runs the same deck with these options of `simulate` instead of its own.
    """
    options: dict[str, Any] = {"error": max(settings.error / TIGHTER, TIGHTEST), "audit": True}
    if len(results.time) > 1:
        longest = LARGEST_STEP * float(np.diff(results.time).max())
        longest = min(longest, float(np.ptp(results.time)) / LEAST_STEPS)
        options["hmax"] = OWN_PART * min(longest, settings.hmax or longest)
    formula, method = method_of(settings.method), settings.method
    family = formula.family
    if formula.steps == FIXED:  # knows no ERROR: its formula with variable steps does
        related = (m.name for m in declared() if m.family == family and m.steps != FIXED)
        method = next(related, method)
    own = _run(again, integrator=method, formulation=settings.formulation, **options)
    asked = [own]
    if "hmax" in options:
        options["hmax"] *= OTHER_PART / OWN_PART

    def others() -> Iterator[Results | str]:
        for each in WITNESSES:
            if method_of(each).family != family and not _is_interrupted(asked[-1]):
                asked.append(_run(again, integrator=each, **options))
                yield asked[-1]

    other = next(_tried(others(), results), None)
    witnesses = [w for w in (own, other) if isinstance(w, Results)]
    objections = [
        _fault("the same method", own, results),
        _fault("another method", other, results) if other or not _is_interrupted(own) else "",
        _unbalanced(witnesses),
    ]
    return Confirmation(
        channels=tuple(_channels(results, witnesses)),
        witnesses=tuple(w.meta["integrator"] for w in witnesses),
        objections=tuple(filter(None, objections)),
        interrupted=_is_interrupted(asked[-1]),
    )


def _is_interrupted(found: Results | str) -> bool:
    return found == EARLY or isinstance(found, Results) and found.outcome is Outcome.INTERRUPTED


def _run(again: Callable[..., Results], **options: Any) -> Results | str:
    """The results, or why the method cannot run the scene."""
    try:
        return again(**options)
    except UsageError as fault:
        return str(fault)
    except KeyboardInterrupt:
        return EARLY


def _tried(runs: Iterable[Results | str], results: Results) -> Iterator[Results | str]:
    """Those that end as the run does, then the first of the others."""
    failed: list[Results | str] = []
    for found in runs:
        if isinstance(found, Results) and found.outcome is results.outcome:
            yield found
        failed.append(found)
    yield from failed


def _fault(who: str, found: Results | str | None, results: Results) -> str:
    """Why a witness is none; empty when it is one."""
    if found == EARLY:
        return f"{who} was interrupted"
    if not isinstance(found, Results):
        return f"{who} cannot run this scene: {found}"
    if found.outcome is not results.outcome or len(found.time) != len(results.time):
        name, end = found.outcome.name, found.summary["t_end"]
        return f"{found.meta['integrator']} ends with {name} at t = {end:.6g}"
    return ""


def _unbalanced(witnesses: list[Results]) -> str:
    """What no witness's balance explains: one that does not close may have a coarse formula."""
    if not witnesses or any(all(b.closes for b in each.balances) for each in witnesses):
        return ""
    return witnesses[-1].meta["energy"].removeprefix("WARNING: ")


def _channels(results: Results, witnesses: list[Results]) -> Iterable[Channel]:
    """Bounds and sizes of every column; a witness that ends earlier says nothing of the rest."""
    whole = [each for each in witnesses if len(each.time) == len(results.time)]
    values = [each.values for each in (results, *whole)]
    apart = np.zeros(len(results.names))
    for k, one in enumerate(values):
        for other in values[:k]:
            apart = np.maximum(apart, _largest(_difference(results.names, one, other)))
    if not whole:
        apart[:] = inf
    largest = _largest(np.abs(results.values))
    sizes: dict[str, float] = {}
    keys = [_quantity(name) for name in results.names]
    for key, size in zip(keys, largest, strict=True):
        sizes[key] = max(sizes.get(key, 0.0), float(size))
    aligned, loose = _aligned(results), NEGLIGIBLE * max(sizes.values(), default=0.0)
    for name, key, gap in zip(results.names, keys, apart, strict=True):
        bound = SAFETY * float(gap) + ROUND_OFF * sizes[key]
        yield Channel(name, bound, sizes[key], inf if name in aligned else loose)


def _aligned(results: Results) -> set[str]:
    """psi and phi of parts whose theta comes to where the two are one angle: their sum or their
    difference says where the part stands, and neither of them does.
    """
    found = set()
    for name in results.names:
        label, _, component = name.rpartition(".")
        if component == "theta" and np.abs(np.sin(results[name])).min(initial=1.0) < ALIGNED:
            found |= {f"{label}.psi", f"{label}.phi"}
    return found


def _largest(values: np.ndarray) -> np.ndarray:
    """Of every column; not-a-number counts as infinite."""
    return np.where(np.isnan(values), inf, values).max(axis=0, initial=0.0)


def _difference(names: tuple[str, ...], one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """|one - other|, angles without whole turns."""
    apart = one - other
    turns = [k for k, name in enumerate(names) if name.rpartition(".")[2] in ANGLES]
    apart[:, turns] -= 2.0 * pi * np.round(apart[:, turns] / (2.0 * pi))
    return np.abs(apart)


def _quantity(name: str) -> str:
    """What a column is a component of."""
    label, _, component = name.rpartition(".")
    return f"{label} {KIND.get(component, component)}"
