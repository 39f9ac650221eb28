"""The mechanisms: which deck, what is watched at its end, and bodies and joints as plain arrays.

S3 and S4 are written by ``decks``; the others are reference decks of the project, whose
reference.csv holds the truth.  Peers get bodies, joints and the assembled start from the deck, so
that nobody solves another problem.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import reference
from benchmarks.scenes import Array, parameters

DECKS = Path(__file__).parent.parent / "decks"
GROUND = -1


@dataclass(frozen=True)
class Watched:
    """A reference deck and what counts at its end.

    channels : results of ours and columns of the reference, [m] or [rad]
    marker : whose place the peers give, or part : whose angle about z they give
    springs : (I, J, stiffness, free length);  torques : (part, torque about z), as in the deck
    """

    deck: str
    what: str
    unit: str
    channels: tuple[str, ...]
    marker: int | None = None
    part: int | None = None
    springs: tuple[tuple[int, int, float, float], ...] = ()
    torques: tuple[tuple[int, float], ...] = ()


WATCHED = {
    "A01": Watched(
        "pendulum-revolute/pendulum-revolute", "pendulum, 10 s: place of the bob", "m",
        ("REQUEST/1.F2", "REQUEST/1.F3"), marker=3,
    ),
    "A02": Watched(
        "a02-n2/a02-n2", "two four-bars through flat postures, 10 s: place of a pin", "m",
        ("REQUEST/1.F2", "REQUEST/1.F3"), marker=11,
    ),
    "Andrews": Watched(
        "andrews/andrews", "Andrews' squeezer, 0.03 s: angle of the driven part", "rad",
        ("VARIABLE/1",), part=2,
        springs=((42, 103, 4530.0, 0.07785),), torques=((2, 0.033),),
    ),
    "Crank": Watched(
        "slider-crank/slider-crank", "fast slider-crank, 0.1 s: angle of the crank", "rad",
        ("VARIABLE/crank",), part=2,
    ),
    "Four-bar": Watched(
        "four-bar/four-bar", "four-bar, 1.5 s: angle of the crank", "rad",
        ("VARIABLE/crank",), part=2,
    ),
    "Bricard": Watched(
        "bricard/bricard", "Bricard's mechanism, 10 s: place of a hinge", "m",
        ("REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/1.F4"), marker=44,
    ),
    "Top": Watched(
        "heavy-top/heavy-top", "fast heavy top, 1 s: place of its centre", "m",
        ("PART/2.x", "PART/2.y", "PART/2.z"), marker=3,
    ),
}  # fmt: skip

PLANAR = ("S3", "S4", "A01", "A02", "Andrews", "Crank", "Four-bar")
SPATIAL = ("Bricard", "Top")


@dataclass(frozen=True)
class Joint:
    """Marker I on body i and J on body j (or ``GROUND``): places and axes from the mass centre."""

    kind: str
    i: int
    j: int
    p: Array
    q: Array
    axes_i: Array
    axes_j: Array


@dataclass(frozen=True)
class Mechanism:
    """Rigid bodies at the start of a run; SI units, ground axes but for the inertias.

    mass : (n,);  inertia : (n, 3, 3) in body axes;  x, v, w : (n, 3);  attitude : (n, 3, 3)
    springs : (i, p, j, q, stiffness, free length);  torque : (n,) about z;  gravity : (3,)
    """

    mass: Array
    inertia: Array
    x: Array
    attitude: Array
    v: Array
    w: Array
    joints: tuple[Joint, ...]
    springs: tuple[tuple[int, Array, int, Array, float, float], ...]
    torque: Array
    gravity: Array
    end: float
    watch: tuple[int, Array] | None

    @property
    def n(self) -> int:
        """Number of bodies."""
        return len(self.mass)


@cache
def truth(scene: str, n: int) -> Array:
    """What is watched, at the end."""
    if scene == "S3":
        return reference.slider_crank()
    if scene == "S4":
        return reference.four_bar(n)
    last = _reference_rows(scene)[-1]
    return np.array([float(last[name]) for name in WATCHED[scene].channels])


@cache
def end_time(scene: str) -> float:
    """When the run ends."""
    if scene in WATCHED:
        return float(_reference_rows(scene)[-1]["time"])
    return parameters()[scene]["T"]


def _reference_rows(scene: str) -> list[dict[str, str]]:
    deck = DECKS / WATCHED[scene].deck
    named = deck.with_name(f"{deck.name}.reference.csv")
    path = named if named.exists() else deck.with_name("reference.csv")
    with path.open() as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def text(scene: str, n: int) -> str:
    """The deck."""
    if scene in WATCHED:
        return (DECKS / f"{WATCHED[scene].deck}.adm").read_text()
    from benchmarks.decks import deck

    return deck(scene, n)


@cache
def mechanism(scene: str, n: int) -> Mechanism:
    """Bodies and joints of a deck, assembled."""
    from adamslite import assemble, read
    from adamslite.analyses.session.session import Session

    model = assemble(read(text(scene, n)))
    system = Session(model, None, {}).system
    told = WATCHED.get(scene)
    joints = [
        _joint(model, j.kind, j.i, j.j) for j in model.constraints if j.keyword == "JOINT"
    ]  # fmt: skip
    if scene == "S3":
        joints.append(_joint(model, "TRANSLATIONAL", 4, 1))
    starts = np.array(system.starts[: len(model.bodies)])
    pick = starts[:, None] + np.arange(3)
    turning = [k for k, body in enumerate(model.bodies) if body.width == 6]
    w = np.zeros((len(starts), 3))
    w[turning] = system.u[pick[turning] + 3]
    return Mechanism(
        mass=np.array([b.mass for b in model.bodies]),
        inertia=np.array([b.inertia if b.width == 6 else np.eye(3) for b in model.bodies]),
        x=system.q[pick], v=system.u[pick], w=w, attitude=system.base.reshape(-1, 3, 3).copy(),
        joints=tuple(joints), springs=_springs(model, told.springs if told else ()),
        torque=_torques(model, told.torques if told else ()),
        gravity=np.array(model.deck.gravity, dtype=float), end=end_time(scene),
        watch=_spot(model, told.marker) if told and told.marker else None,
    )  # fmt: skip


def _spot(model: Any, marker: int) -> tuple[int, Array]:
    place = model.marker(marker)
    return (GROUND, np.zeros(3)) if place is None else (place.body, place.p)


def _joint(model: Any, kind: str, i: Any, j: Any) -> Joint:
    a, b = model.marker(i), model.marker(j)
    return Joint(kind, a.body, b.body, a.p, b.p, a.axes, b.axes)


def _springs(model: Any, given: Sequence[tuple[int, int, float, float]]) -> tuple[Any, ...]:
    return tuple((*_spot(model, i), *_spot(model, j), k, l0) for i, j, k, l0 in given)


def _torques(model: Any, given: Sequence[tuple[int, float]]) -> Array:
    torque = np.zeros(len(model.bodies))
    for part, value in given:
        torque[model.body_index["PART", part]] = value
    return torque


def watched(scene: str, n: int, place: Array, speed: Array) -> Array:
    """What is watched, from the end state of a planar scene.

    place, speed : (n, 3), x, y, angle of every body; angles count from the start of the deck.
    """
    m = mechanism(scene, n)
    if scene == "S3":
        return np.array([place[0, 2], place[2, 0]])
    if scene == "S4":
        energy = 0.5 * m.mass @ (speed[:, :2] ** 2).sum(axis=1)
        energy += 0.5 * m.inertia[:, 2, 2] @ speed[:, 2] ** 2 - m.mass @ (
            place[:, :2] @ m.gravity[:2]
        )
        return np.array([np.pi / 2 + place[0, 2], energy])
    if m.watch is None:
        return place[:1, 2]
    body, p = m.watch
    c, s = np.cos(place[body, 2]), np.sin(place[body, 2])
    return place[body, :2] + np.array([c * p[0] - s * p[1], s * p[0] + c * p[1]])
