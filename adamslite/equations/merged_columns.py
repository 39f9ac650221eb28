"""Results of parts that move as one body, and what the joints between them carry."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from adamslite.elements.joint import Joint
from adamslite.kernels.code.workspace import (
    ACCELERATION,
    ALPHA,
    ATTITUDE,
    OMEGA,
    POSITION,
    VELOCITY,
)

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.language.interfaces import Key
    from adamslite.model.merging import MergedModel

PartKey = tuple[str, "Key"]


class Moving(NamedTuple):
    """A frame in ground over all records: x, v, a, omega, alpha (nt, 3), attitude (nt, 3, 3)."""

    x: np.ndarray
    v: np.ndarray
    a: np.ndarray
    omega: np.ndarray
    alpha: np.ndarray
    attitude: np.ndarray


def motion_of(model: MergedModel, system: System, record: np.ndarray, part: PartKey) -> Moving:
    """The mass centre of a part with the axes of its frame."""
    centre, _ = model.mass_centre_in_part(part)
    member = model.members[part]
    p = member.p + member.axes @ centre
    if member.body < 0:
        still = np.zeros((len(record), 3))
        axes = np.broadcast_to(member.axes, (len(record), 3, 3))
        return Moving(still + p, still, still, still, still, axes)
    return _carried(system, record, member.body, p, member.axes)


def _carried(
    system: System, record: np.ndarray, body: int, p: np.ndarray, axes: np.ndarray
) -> Moving:
    """A frame at p, with axes, both in those of the body."""
    at = system.w_at["BODY", body]
    x, v, a, omega, alpha = (
        record[:, at + k : at + k + 3] for k in (POSITION, VELOCITY, ACCELERATION, OMEGA, ALPHA)
    )
    attitude = record[:, at + ATTITUDE : at + ATTITUDE + 9].reshape(-1, 3, 3)
    arm = attitude @ p
    swept = np.cross(omega, arm)
    found = a + np.cross(alpha, arm) + np.cross(omega, swept)
    return Moving(x + arm, v + swept, found, omega, alpha, attitude @ axes)


def reactions_inside(model: MergedModel, system: System, record: np.ndarray) -> np.ndarray:
    """The outputs of a record, with what joints inside bodies carry where these had the loads on
    the parts behind them.
    """
    outputs = record[:, system.nw :].copy()
    behind: dict[PartKey, Any] = {}  # sums of the parts that further joints carry
    for key, cut in model.cuts.items():
        joint = model.deck.get(Joint, key[1])
        place, at = model.marker(joint.i), system.instances.outputs[joint]
        pivot, origin = place.p, np.zeros(3)
        if place.body >= 0:
            at_body = system.w_at["BODY", place.body] + POSITION
            origin = record[:, at_body : at_body + 3]
            pivot = _carried(system, record, place.body, place.p, place.axes).x
        total = _inertia(model, system, record, cut.child, origin) + behind.pop(cut.child, 0.0)
        behind[cut.parent] = behind.get(cut.parent, 0.0) + total
        total = total.copy()
        total[:, 3:] += np.cross(origin - pivot, total[:, :3])
        loads = outputs[:, at : at + 6]
        outputs[:, at : at + 6] = cut.sign * (total - loads)
    return outputs


def _inertia(
    model: MergedModel, system: System, record: np.ndarray, part: PartKey, origin: np.ndarray
) -> np.ndarray:
    """m (a - g) of a part, and its moment with dL/dt about an origin: (nt, 6)."""
    moving, body = motion_of(model, system, record, part), model.alone[part]
    force = body.mass * (moving.a - system.gravity)
    inertia = moving.attitude @ body.inertia @ moving.attitude.transpose(0, 2, 1)
    spin = (inertia @ moving.omega[:, :, None])[:, :, 0]
    change = (inertia @ moving.alpha[:, :, None])[:, :, 0] + np.cross(moving.omega, spin)
    moment = change + np.cross(moving.x - origin, force)
    return np.concatenate([force, moment], axis=1)
