"""Whether the equations of small motions stay constant along the motion that they are about.

The first-order system of this instant is compared with those just before and after, on the same
trajectory.  Where neither its basis nor its matrices change the state is steady for the observer:
at rest, turning with him, or turning about an axis of symmetry.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.linearization.first_order import FirstOrder, moving, still
from adamslite.analyses.linearization.instant import neighbours, present
from adamslite.analyses.linearization.observer import Observer
from adamslite.elements.marker import Marker
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.analyses.linearization.first_order import Ports
    from adamslite.equations.system import System
    from adamslite.language.interfaces import Key

# Time to the neighbours, as a share of that in which the motion turns or crosses the model.
SHARE = 1e-3
# First and second change in that time which are no change, as shares of the largest entry of a row;
# rows below the second share of the largest row are measured by that.
FIRST, SECOND = (1e-5, 1e-2), (1e-4, 1e-2)
# Of the largest eigenvalue, or the rate of the motion: smaller ones are zero.
ZERO = 1e-6
# A state at rest is an equilibrium when its accelerations move the model by less than this share of
# its size in the time of its slowest vibration: they are what the search left over.
IMBALANCE = 1e-4
# Rigid motions that differ by less than this share are the same.
SAME_MOTION = 1e-6
# Bodies of different motion that are tried as observers.
MOST_TRIED = 6


class Trajectory:
    """Three instants of a trajectory, and the first-order systems that observers see at them."""

    def __init__(self, system: System, ports: Ports) -> None:
        self.system, self.ports = system, ports
        self.now = present(system)
        self.unit = self._unit()
        moving, slowest = self._rate_of_motion(), self._slowest()
        self.rate = max(moving, slowest) or 1.0
        self.h = SHARE / self.rate
        at_rest = not self.now.u.any() and moving**2 <= IMBALANCE * slowest**2
        self.around = neighbours(system, self.h, at_rest)

    def seen(self, observer: Observer) -> tuple[FirstOrder, bool]:
        """The first-order system of this instant, and whether it stays."""
        three = self._three(observer)
        if self.around is None:
            return three[1], not self.now.u.any()
        if self._are_alike(three):
            return three[1], True
        basis = moving(*three, self.h)
        return FirstOrder(self.system, self.now, observer.view(self.now), basis, self.ports), False

    def steady_observer(self, other_than: Observer) -> str:
        """For whom everything is steady, in words of the deck; empty when for none."""
        for words, observer in self._others():
            if self.around is None:
                return ""
            if observer.body != other_than.body and self._are_alike(self._three(observer)):
                return words
        return ""

    def _resting(self, observer: Observer) -> FirstOrder:
        view = observer.view(self.now)
        basis = still(self.system, self.now, view, self.unit)
        return FirstOrder(self.system, self.now, view, basis, self.ports)

    def _three(self, observer: Observer) -> tuple[FirstOrder, FirstOrder, FirstOrder]:
        """Before, now and after, each as if its basis stood still."""
        now = self._resting(observer)
        if self.around is None:
            return now, now, now
        found = []
        for instant in self.around:
            view = observer.view(instant)
            basis = still(self.system, instant, view, self.unit, now.basis)
            found.append(FirstOrder(self.system, instant, view, basis, self.ports))
        before, here, after = found
        return before, here, after

    def _are_alike(self, three: tuple[FirstOrder, FirstOrder, FirstOrder]) -> bool:
        """Whether neither basis nor matrices change."""
        f, g = three[1].basis.speeds[0].shape
        rest, rate = np.ones(self.system.ns), self.rate
        columns = [np.ones(f), np.full(g, rate), rest, np.ones(len(self.ports.inputs))]
        states = [np.full(f, 1.0 / rate), np.full(g, rate**-2), rest / rate]
        rows = np.concatenate([*states, np.ones(len(self.ports.outputs))])
        matrices = [rows[:, None] * each.whole * np.concatenate(columns) for each in three]
        watched = [
            [each.basis.positions[0] for each in three],
            [each.basis.speeds[0] for each in three],
            [each[: f + g] for each in matrices],
            [each[f + g :] for each in matrices],
        ]
        return not any(_change(*each) for each in watched)

    def _rate_of_motion(self) -> float:
        """The largest of w, sqrt(al), v/L and sqrt(a/L) [1/time], L the size of the model."""
        system, now = self.system, self.now
        if not system.model.bodies:
            return 0.0
        at, size, rates = system.places, self._size(), [0.0]
        parts = np.array([body.width == PART for body in system.model.bodies])
        for values, power in ((now.u, 1.0), (now.a, 0.5)):
            if parts.any():
                rates.append(float(np.abs(values[at[parts] + 3]).max()) ** power)
            if size > 0.0:
                rates.append((float(np.abs(values[at]).max()) / size) ** power)
        return max(rates)

    def _size(self) -> float:
        """The largest extent of mass centres, markers and radii of gyration [length]."""
        system, now = self.system, self.now
        points = list(now.q[system.places])
        for marker in system.model.deck.of(Marker):
            place = None if marker.floating else system.model.marker(marker.key)
            if place is not None:
                i = system.starts[place.body]
                points.append(
                    place.p if place.kind == "ground"
                    else now.q[i : i + 3] + now.attitude[place.body] @ place.p
                )  # fmt: skip
        tensors = system.inertia.reshape(-1, 3, 3)
        radii = [w**-0.5 for w, tensor in zip(system.weight, tensors, strict=True) if tensor.any()]
        extent = float(np.ptp(points, axis=0).max()) if points else 0.0
        return max(extent, *radii, 0.0)

    def _unit(self) -> np.ndarray:
        """(n,): 1 for translations, 1/(size of the model) for rotations."""
        unit = np.full(self.system.n, 1.0 / (self._size() or 1.0))
        unit[self.system.places] = 1.0
        return unit

    def _slowest(self) -> float:
        """The smallest undamped frequency of this instant that is not zero [1/time]."""
        squares = np.abs(np.linalg.eigvals(self._resting(Observer(self.system)).minus_stiffness))
        return float(min(squares[squares > ZERO**2 * squares.max(initial=0.0)], default=0.0)) ** 0.5

    def _others(self) -> Iterator[tuple[str, Observer]]:
        """The ground, and the bodies that turn, one of each rigid motion, prescribed ones first."""
        yield "without RM", Observer(self.system)
        tried: list[np.ndarray] = []
        for b, marker in self._turning_bodies():
            i = self.system.starts[b]
            x, v, spin = self.now.q[i : i + 3], self.now.u[i : i + 3], self.now.u[i + 3 : i + 6]
            twist = np.concatenate([spin, v - np.cross(spin, x)])
            near = SAME_MOTION * float(np.abs(twist).max())
            if not any(np.abs(twist - each).max() <= near for each in tried):
                tried.append(twist)
                yield f"with RM={marker}", Observer(self.system, marker)
            if len(tried) == MOST_TRIED:
                return

    def _turning_bodies(self) -> list[tuple[int, Key]]:
        """Parts that turn, the least free ones first, each with a marker of its own."""
        model = self.system.model
        free = still(self.system, self.now, Observer(self.system).view(self.now), self.unit)
        found: list[tuple[float, int, Key]] = []
        for marker in model.deck.of(Marker):
            place = None if marker.floating else model.marker(marker.key)
            if place is None or place.kind != "part" or place.body in [b for _, b, _ in found]:
                continue
            i = self.system.starts[place.body]
            if np.abs(self.now.u[i + 3 : i + 6]).max() > ZERO * self.rate:
                found.append(
                    (float(np.linalg.norm(free.positions[0][i : i + 6])), place.body, marker.key)
                )
        return [(b, key) for _, b, key in sorted(found, key=lambda each: each[:2])]


def _change(before: np.ndarray, now: np.ndarray, after: np.ndarray) -> bool:
    """Whether a matrix changes from one instant to the next."""
    if not before.shape == now.shape == after.shape:
        return True
    if not now.size:
        return False
    size = np.abs(now).max(axis=1)
    first, second = (after - before) / (2.0 * SHARE), (after - 2.0 * now + before) / SHARE**2
    return any(
        not (np.abs(change).max(axis=1) <= share * np.maximum(size, floor * size.max())).all()
        for change, (share, floor) in ((first, FIRST), (second, SECOND))
    )
