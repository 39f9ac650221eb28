"""Measures of a run as weights of what was written: their derivatives by the values of a column."""

from __future__ import annotations

import numpy as np

from adamslite.equations.result_columns import ALIGNED, OF_PART, OF_POINT, column_names, columns
from adamslite.equations.system import System
from adamslite.errors import UsageError
from adamslite.kernels.code.workspace import (
    ACCELERATION,
    ALPHA,
    ATTITUDE,
    OMEGA,
    POSITION,
    VELOCITY,
)
from adamslite.model.attitude_angles import angles_313

PLACES = {
    **dict(zip(".x .y .z".split(), range(POSITION, POSITION + 3), strict=True)),
    **dict(zip(".vx .vy .vz".split(), range(VELOCITY, VELOCITY + 3), strict=True)),
    **dict(zip(".ax .ay .az".split(), range(ACCELERATION, ACCELERATION + 3), strict=True)),
    **dict(zip(".wx .wy .wz".split(), range(OMEGA, OMEGA + 3), strict=True)),
    **dict(zip(".alx .aly .alz".split(), range(ALPHA, ALPHA + 3), strict=True)),
}
ANGLES = (".psi", ".theta", ".phi")
# Turns of a part by which its angles are differentiated.
TURN = 1e-5


class Seed:
    """Weights of what was written at one output time.

    ``out`` (n_out,): of values that statements write; ``places``: of entries of the workspace, of
    rotations by the first three places of the attitude.  ``state``: the row of the record.
    """

    def __init__(self, state: np.ndarray) -> None:
        self.state = state
        self.out = np.zeros(0)
        self.places: dict[int, float] = {}


class Columns:
    """Where the columns of results come from."""

    def __init__(self, system: System) -> None:
        self.system = system
        self.names = column_names(system.kernels)
        self.at: dict[str, tuple[str, int]] = {}
        model = system.model
        for moving in model.moving:
            at = system.w_at["BODY", model.body_index[moving.keyword, moving.key]]
            for suffix in OF_PART if moving.keyword == "PART" else OF_POINT:
                kind = "angle" if suffix in ANGLES else "state"
                place = ANGLES.index(suffix) if kind == "angle" else PLACES[suffix]
                self.at[moving.label + suffix] = (
                    kind,
                    100 * at + place if kind == "angle" else at + place,
                )
        written = self.names[len(self.at) :]
        self.at |= {name: ("written", k) for k, name in enumerate(written)}

    def weigh(self, seed: Seed, name: str, weight: float) -> None:
        """Add the weight of a column."""
        kind, place = self.at[name]
        if kind == "written":
            if not seed.out.size:
                seed.out = np.zeros(self.system.sizes.n_out + 1)
            seed.out[place] += weight
        elif kind == "state":
            seed.places[place] = seed.places.get(place, 0.0) + weight
        else:
            at, which = divmod(place, 100)
            for c, value in enumerate(self._turning(seed.state, at, which, name)):
                o = at + ATTITUDE + c
                seed.places[o] = seed.places.get(o, 0.0) + weight * value

    def _turning(self, state: np.ndarray, at: int, which: int, name: str) -> np.ndarray:
        """The derivative of a 3-1-3 angle by a rotation in ground axes."""
        number = next(
            m
            for m in self.system.model.moving
            if self.system.w_at["BODY", self.system.model.body_index[m.keyword, m.key]] == at
        )
        attitude = state[at + ATTITUDE : at + ATTITUDE + 9].reshape(3, 3)
        cm = getattr(number, "cm", None)
        if cm is not None:
            attitude = attitude @ self.system.model.marker(cm).axes
        psi, theta, _ = angles_313(attitude[None], ALIGNED)[0]
        if abs(np.sin(theta)) <= ALIGNED:  # psi and phi are one angle, about z
            if which == 1:
                raise UsageError(f"{name} has no derivative where it is 0 or 180 degrees")
            return np.array([0.0, 0.0, float(which == 0)])
        c, s, cot = np.cos(psi), np.sin(psi), np.cos(theta) / np.sin(theta)
        rows = ((-s * cot, c * cot, 1.0), (c, s, 0.0), (s / np.sin(theta), -c / np.sin(theta), 0.0))
        return np.array(rows[which])


def column_slopes(system: System, record: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Derivatives of the columns (nt, nc) from those of the record: all but angles are linear.

    A part turns by ``TURN`` to both sides, however little its number turns it: d(angle) is the
    difference of the ends, times |dR| / (2 TURN).  A division by |dR| alone stays finite down to
    the least number, and a part that hardly turns loses no digits beside one that does.
    """
    names, found = columns(system, slopes)
    at = {name: k for k, name in enumerate(names)}
    found, turned = found.copy(), np.zeros_like(slopes)
    angles: list[int] = []
    sizes: list[np.ndarray] = []
    for b, body in enumerate(system.model.bodies):
        own = [at[name] for each in ANGLES if (name := body.statement.label + each) in at]
        if not own:
            continue
        place = slice((o := system.w_at["BODY", b] + ATTITUDE), o + 9)
        slope = slopes[:, place]
        size = np.abs(slope).max(axis=1, keepdims=True)
        turned[:, place] = TURN * np.divide(slope, size, out=np.zeros_like(slope), where=size > 0.0)
        angles, sizes = angles + own, [*sizes, *[size] * len(own)]
    if angles:
        ends = [columns(system, record + sign * turned)[1][:, angles] for sign in (1.0, -1.0)]
        gap = ends[0] - ends[1]
        rest = (gap - 2.0 * np.pi * np.round(gap / (2.0 * np.pi))) / (2.0 * TURN)
        found[:, angles] = rest * np.concatenate(sizes, axis=1)
    return found
