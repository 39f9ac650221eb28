"""Scales of the coordinates of bodies: what makes a rotation comparable with a translation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.model.model import Model

# Share of a lever that a radius of gyration counts at least.
LEVER = 0.1
# Weight of a coordinate that the deck calls EXACT.
EXACT = 1e4
# A radian counts as this share of the model's size: what is drawn roughly is off by a tenth of that
# and by 20 degrees.
ROUGH = 0.1 / np.deg2rad(20.0)
# Passes over constraints in which masses that are tied become known; mobility of what is not held.
SWEEPS, UNTIED = 2, 1e300
# What has no mass follows what has: it carries no state of its own worth keeping.
MASSLESS = 1e-4
# A moment of inertia below this share of the largest of its part is none.
THIN = 1e-3


def rotation_weights(model: Model) -> np.ndarray:
    """1/(radius of gyration)^2 of each body: puts rotations on the scale of translations in
    W G^T mu; 1 for a body without mass or inertia.

    At least ``LEVER`` of the way from the mass centre to a marker that is held: a part whose mass
    is all but a point turns about such a marker, and a weight of its inertia alone would make
    G W G^T, and what round-off does to mu, as large as the ratio of the two is small.
    """
    mass = np.array([body.mass for body in model.bodies], dtype=float)
    inertia = np.array([body.inertia for body in model.bodies], dtype=float).reshape(-1, 3, 3)
    trace = np.trace(inertia, axis1=1, axis2=2)
    known = (trace > 0.0) & (mass > 0.0)
    square = np.divide(trace, mass, out=np.ones(mass.size), where=known)
    square[known] = np.maximum(square[known], (LEVER * _held(model)[0][known]) ** 2)
    return 1.0 / square


def _held(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Of each body, the farthest of its markers that a constraint holds, from the mass centre, and
    the largest mass of all bodies that constraints tie to it.
    """
    lever, mass = np.zeros(len(model.bodies)), np.array([body.mass for body in model.bodies])
    tied = []
    for each in model.constraints:
        ends = (getattr(each, name, None) for name in ("i", "j"))
        places = [model.marker(end) for end in ends if end is not None]
        bodies = [place.body for place in places if place is not None and place.body >= 0]
        for place in places:
            if place is not None and place.body >= 0:
                lever[place.body] = max(lever[place.body], float(np.sqrt(place.p @ place.p)))
        tied += [bodies] if len(bodies) > 1 else []
    for some in (tied, reversed(tied)) * SWEEPS:
        for bodies in some:
            mass[bodies] = mass[bodies].max()
    return lever, mass


def mobilities(model: Model) -> np.ndarray:
    """(2 n,) largest acceleration that a unit load gives each unknown of a body: 1/mass, 1/least
    moment of inertia; 0 without mass.  Then that of the same load by all bodies that are tied to
    it, which round-off of their places makes felt: 1/mass, 1/(mass lever).
    """
    width = np.array([body.width for body in model.bodies], dtype=int)
    lever, heaviest = _held(model)
    own, tied = np.zeros((width.size, 6)), np.zeros((width.size, 6))
    own[:, :3] = np.array([body.mass for body in model.bodies])[:, None]
    parts = [body.inertia for body in model.bodies if body.width == PART]
    principal = np.linalg.eigvalsh(np.array(parts).reshape(-1, 3, 3))
    own[width == PART, 3:] = np.maximum(principal[:, :1], THIN * principal[:, 2:])
    tied[:, :3], tied[:, 3:] = heaviest[:, None], (heaviest * lever)[:, None]
    used = np.arange(6) < width[:, None]
    own = np.divide(1.0, own, out=np.zeros_like(own), where=own > 0.0)[used]
    tied = np.divide(1.0, tied, out=np.full_like(tied, UNTIED), where=tied > 0.0)[used]
    return np.concatenate([own, tied])


def coordinate_weights(model: Model, speeds: bool = False) -> np.ndarray:
    """(n, 6) weights w of place and rotation of each body in sum w^2 (change)^2.

    That of an EXACT coordinate is ``EXACT``, that of a rotation the part's radius of gyration, or a
    share of the model: or else small parts would be turned right round to close a gap.
    ``speeds``: of changes of velocities, which what has no mass does not resist in any case, and
    which are kinetic energy.
    """
    table = np.ones((len(model.bodies), 6))
    lever = 0.0 if speeds else ROUGH * extent(model)
    for w, body, rotation in zip(table, model.bodies, rotation_weights(model), strict=True):
        if body.width == PART:
            w[3:] = max(rotation**-0.5, lever)
        if body.mass == 0.0:
            w *= MASSLESS
        exact = () if speeds and body.mass == 0.0 else body.statement.exact
        kept = EXACT if body.mass else EXACT / MASSLESS
        for c, words in enumerate((("X",), ("Y",), ("Z",), ("PSI", "THETA", "PHI"))):
            if any(word in exact for word in words):
                w[c if c < 3 else slice(3, 6)] *= kept
    return table


def extent(model: Model) -> float:
    """The largest distance along an axis between bodies."""
    places = np.array([body.x for body in model.bodies]).reshape(-1, 3)
    return float(np.ptp(places, axis=0).max()) if len(places) else 0.0


def turned(attitude: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """An attitude (3, 3) after a small rotation (3,) in ground axes, by Cayley's formula."""
    a, b, c = rotation
    skew = np.array([[0.0, -c, b], [c, 0.0, -a], [-b, a, 0.0]])
    cayley = np.eye(3) + (skew + 0.5 * skew @ skew) / (1.0 + 0.25 * rotation @ rotation)
    return cayley @ attitude
