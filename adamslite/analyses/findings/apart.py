"""Contacts and stops that a run never reached.

The guards of a contact are followed within steps, so that a touch is not missed.  How near it came
is that at the ends of steps and, by values and rates, between them; what came nearer than some
times ERROR may have been touched.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, sqrt
from typing import TYPE_CHECKING

import numpy as np

from adamslite.integrators.event_rows import CLOSEST

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.language.statement import Statement

#: So many are named, the nearest first.
MOST_NAMED = 5
REACHED = -1.0
#: What is missed by less than so many times ERROR may have been touched.
SURE = 10.0


class Apart:
    """The least distance of every contact and stop so far, ``REACHED`` of those that were touched
    or are not known of.
    """

    def __init__(self) -> None:
        self.closest: dict[str, float] = {}

    def look(self, system: System) -> None:
        """Take over what an analysis has seen."""
        here: dict[str, float] = {}
        size = max(1.0, float(np.abs(system.q).max(initial=0.0)))
        near = SURE * float(system.settings.error) * size
        for label, distance in _distances(system):
            known = distance if distance > near else REACHED
            here[label] = min(here.get(label, inf), known)
        for label, distance in here.items():
            self.closest[label] = min(self.closest.get(label, inf), distance)

    @property
    def meta(self) -> dict[str, str]:
        """Those that were never reached, in a sentence; IMPACT and BISTOP by their statement."""
        found = sorted((d, label) for label, d in self.closest.items() if d != REACHED)
        if not found:
            return {}
        named = [f"{label} by {distance:.3g}" for distance, label in found[:MOST_NAMED]]
        more = [f"{len(found) - MOST_NAMED} more"] if len(found) > MOST_NAMED else []
        listed = ", ".join([*named, *more])
        return {"not reached": f"missed {listed}; these contacts and stops were zero throughout"}


def _distances(system: System) -> Iterator[tuple[str, float]]:
    count, numbering = len(system.guarded["watch"]), system.numbering
    first = CLOSEST * count - system.nw - len(system.guarded["clock"])
    for group in system.kernels.groups:
        kinds = group.meta["guards"]["watch"]
        for n, (statement, _) in enumerate(group.instances if kinds else ()):
            at = first + numbering.first_branch["watch", group.name] + n * len(kinds)
            for number, in_length in group.meta["touches"] if group.face == "loads" else ():
                distance = float(system.margin[at + number])
                yield statement.label, _length(statement, distance, in_length)


def _length(statement: Statement, gap: float, in_length: bool) -> float:
    """A distance from a gap; ``r**2 - distance**2`` where balls are near to something."""
    if in_length or gap <= 0.0:
        return gap
    from adamslite.elements.bases.contact_point import ContactPoint

    if not isinstance(statement, ContactPoint):
        return gap
    forms = (statement.first, statement.second)
    near = sum(float(form.sizes[0]) for form in forms if form.kind == "BALL")
    return sqrt(near * near + gap) - near
