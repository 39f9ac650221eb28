"""What the constraints of a model let its bodies do: the motions (null space of G) in its posture.

    N = null(G),    kinetic energy of a motion N c:   c^T N^T M N c / 2

Where something holds in a posture of a dead centre it need not hold beside it: it is looked at in
postures nearby, too, to which the bodies are moved along motions at random.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from adamslite.assembly.closing import OPEN, close
from adamslite.assembly.rank import RANK, unit_rows
from adamslite.assembly.rows import gradient, values
from adamslite.assembly.scope import WIDTH, Posture
from adamslite.deck.deck import Deck
from adamslite.elements.bases.constraint import Constraint
from adamslite.language.expression import Num
from adamslite.model.model import POINT, Model
from adamslite.model.scaling import coordinate_weights, turned

#: Larger models are not looked at: the null space is that of a dense matrix.
MOST_BODIES = 60
#: Elements of a motion below this are none.
STILL = 1e-7
NEARBY, STEP = 2, 0.2
#: So many are looked at by those that ask for more; bodies times postures.
FARTHER, MOST_WORK = 24, 240
LASTING = ("COUPLER", "GEAR", "JOINT", "JPRIM", "MOTION")


@dataclass(frozen=True)
class Mobility:
    """Motions (6 n, f), their length 1 where a rotation counts by its lever (6 n,)."""

    model: Model
    posture: Posture
    motions: np.ndarray
    weights: np.ndarray
    held: tuple[Constraint, ...] = ()

    def mass(self, bodies: Sequence[int]) -> np.ndarray:
        """M of these bodies over all coordinates, (6 n, 6 n), in ground axes."""
        n = WIDTH * len(self.model.bodies)
        found = np.zeros((n, n))
        for b in bodies:
            body, i, R = self.model.bodies[b], WIDTH * b, self.posture.attitude[b]
            found[i : i + 3, i : i + 3] = body.mass * np.eye(3)
            found[i + 3 : i + 6, i + 3 : i + 6] = R @ body.inertia @ R.T
        return found

    def carried(self, body: int, place: np.ndarray) -> np.ndarray:
        """Motion of a frame of a body at a place in ground by all motions, (6, f); 0 for ground."""
        if body < 0:
            return np.zeros((WIDTH, self.motions.shape[1]))
        v, w = np.split(self.motions[WIDTH * body : WIDTH * body + WIDTH], 2)
        arm = place - self.posture.x[body]
        return np.concatenate([v + np.cross(w.T, arm).T, w])

    def moves_against(self, a: int, b: int) -> bool:
        """Whether a motion moves one body against another (-1: ground)."""
        place = self.posture.x[max(a, b)]
        apart = self.carried(a, place) - self.carried(b, place)
        lever = float(self.weights[WIDTH * max(a, b) + 3])
        apart[3:] *= lever
        return bool(np.abs(apart).max(initial=0.0) > STILL)


@lru_cache(maxsize=1)
def mobilities(deck: Deck) -> tuple[Mobility, ...]:
    """As drawn and in postures nearby; empty where the model is large, cannot be closed, or has
    constraints of another kind.
    """
    model = Model(deck)
    if not 0 < len(model.bodies) <= MOST_BODIES or any(b.width == POINT for b in model.bodies):
        return ()
    held = [each for each in model.constraints if each.keyword != "MOTION" or _stands(model, each)]
    if any(each.keyword not in LASTING or each.is_rate(model) for each in held):
        return ()
    closing = close(model, held, Posture.start(model), OPEN)
    if not closing.closed:
        return ()
    return tuple(_found(model, held, closing.posture, NEARBY))


def farther(drawn: Mobility) -> tuple[Mobility, ...]:
    """The same in more postures, one behind the other."""
    count = min(FARTHER, MOST_WORK // len(drawn.model.bodies))
    return tuple(_found(drawn.model, list(drawn.held), drawn.posture, count))


def _found(
    model: Model, held: list[Constraint], posture: Posture, count: int
) -> Iterator[Mobility]:
    rng = np.random.default_rng(0)
    weights = coordinate_weights(model).ravel()
    size = max(1e-30, float(np.ptp(posture.x, axis=0).max(initial=0.0)), float(weights.max()) / 10)
    for _ in range(1 + count):
        rows = _rows(model, held, posture, weights)
        if not (np.isfinite(rows).all() and np.isfinite(weights).all()):
            return  # a size or an inertia beyond the range of numbers, or below zero
        motions = _free(rows, weights)
        found = Mobility(model, posture, motions, weights, tuple(held))
        yield found
        free = found.motions.shape[1]
        if not free:
            return
        step = found.motions @ rng.normal(size=free)
        step *= STEP * size / max(float(np.abs(step * weights).max()), 1e-30)
        moved = Posture(
            posture.x + step.reshape(-1, WIDTH)[:, :3],
            np.array([turned(R, w) for R, w in
                      zip(posture.attitude, step.reshape(-1, WIDTH)[:, 3:], strict=True)]),
            posture.speed,
        )  # fmt: skip
        closing = close(model, held, moved, OPEN)
        if closing.closed:
            posture = closing.posture


def _motions(
    model: Model, held: Sequence[Constraint], posture: Posture, weights: np.ndarray
) -> np.ndarray:
    return _free(_rows(model, held, posture, weights), weights)


def _rows(
    model: Model, held: Sequence[Constraint], posture: Posture, weights: np.ndarray
) -> np.ndarray:
    return unit_rows(gradient(model, posture, held) / weights)


def _free(rows: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """What satisfies these rows of motions that are weighted."""
    n = len(weights)
    full = np.zeros((max(len(rows), n), n))
    full[: len(rows)] = rows
    _, sizes, motions = np.linalg.svd(full)
    return motions[sizes <= RANK].T / weights[:, None]


def _stands(model: Model, motion: Constraint) -> bool:
    """Whether a MOTION holds a joint where it is drawn."""
    if motion.is_rate(model) or not isinstance(motion.function, Num):  # type: ignore[attr-defined]
        return False
    off = values(model, Posture.start(model), motion)
    return bool(np.abs(off).max() <= STILL)


def motions_without(mobility: Mobility, body: int) -> np.ndarray:
    """The motions of the other bodies when one is taken away with all that holds it."""
    from adamslite.model.net_force import ends

    model = mobility.model
    kept = [
        each for each in mobility.held
        if body not in [model.marker(key).body for key in ends(model.deck, each) if key]
    ]  # fmt: skip
    motions = _motions(model, kept, mobility.posture, mobility.weights)
    at = slice(WIDTH * body, WIDTH * body + WIDTH)
    others = motions.copy()
    others[at] = 0.0
    left, sizes, _ = np.linalg.svd(others * mobility.weights[:, None], full_matrices=False)
    return left[:, sizes > STILL] / mobility.weights[:, None]


def is_rigid(drawn: Mobility, inside: Sequence[Constraint], group: Sequence[int]) -> bool:
    """Whether constraints between the bodies of a group (-1: ground) make it rigid by themselves,
    to first order: it is then rigid in every posture that it can be moved to.
    """
    if not inside:
        return False
    motions = _motions(drawn.model, inside, drawn.posture, drawn.weights)
    alone = replace(drawn, motions=motions)
    return not any(alone.moves_against(group[0], other) for other in group[1:])
