"""Result columns from the record of a run: names as in the deck."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, cast

import numpy as np

from adamslite.kernels.code.workspace import (
    ACCELERATION,
    ALPHA,
    ATTITUDE,
    OMEGA,
    PART_SIZE,
    POINT_SIZE,
    POSITION,
    VELOCITY,
)
from adamslite.model.attitude_angles import angles_313
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.elements.part import Part
    from adamslite.elements.point_mass import PointMass
    from adamslite.equations.merged_columns import Moving
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels
    from adamslite.language.interfaces import Key
    from adamslite.model.merging import MergedModel
    from adamslite.model.model import Body

COLUMNS = "columns"
# Below this sine of theta the first and third angle of the 3-1-3 sequence are one angle.
ALIGNED = 1e-10

OF_PART = ".x .y .z .psi .theta .phi .vx .vy .vz .wx .wy .wz .ax .ay .az .alx .aly .alz".split()
OF_POINT = ".x .y .z .vx .vy .vz .ax .ay .az".split()


def columns(system: System, record: np.ndarray) -> tuple[tuple[str, ...], np.ndarray]:
    """Names and values (nt, nc) of every body and every statement that writes something.

    A body gives position, 3-1-3 angles, velocity, angular velocity, acceleration and angular
    acceleration of its centre-of-mass marker in ground axes; a point mass the translational ones.
    Where all bodies are point masses, and nothing stands between them and what is written, the
    values are the record itself, without a copy.
    """
    names, at = column_names(system.kernels), system.numbering.n_head
    widths = system.widths[: len(system.model.bodies)]
    if PART not in widths and at + POINT_SIZE * len(widths) == system.nw:
        return names, record[:, at:]
    if system.model.merges_parts:
        return names, _of_merged(cast("MergedModel", system.model), system, record)
    parts: list[np.ndarray] = []
    for width, bodies in groupby(system.model.bodies, key=lambda body: body.width):
        if width != PART:  # point masses stand in the record as they do here
            size = POINT_SIZE * len(list(bodies))
            parts.append(record[:, at : at + size])
            at += size
            continue
        for body in bodies:
            w = record[:, at : at + PART_SIZE]
            parts.append(_part(system, body, w) if _turns(body.statement) else _point(w))
            at += PART_SIZE
    parts.append(record[:, system.nw :])
    return names, np.concatenate(parts, axis=1)


def column_names(kernels: Kernels) -> tuple[str, ...]:
    """The names of all columns; found once."""
    if COLUMNS not in kernels.shared:
        names: list[str] = []
        for moving in kernels.model.moving:
            label = moving.label
            names += [label + each for each in (OF_PART if _turns(moving) else OF_POINT)]
        for statement, suffixes in kernels.outputs:
            names += [f"{statement.label}.{s}" if s else statement.label for s in suffixes]
        kernels.shared[COLUMNS] = tuple(names)
    found: tuple[str, ...] = kernels.shared[COLUMNS]
    return found


def _turns(statement: Part | PointMass) -> bool:
    return statement.keyword == "PART"


def _of_merged(model: MergedModel, system: System, record: np.ndarray) -> np.ndarray:
    """Values of all columns where parts of one body have columns each."""
    from adamslite.equations.merged_columns import motion_of, reactions_inside

    parts = []
    for statement in model.moving:
        key = (statement.keyword, statement.key)
        if key in model.members:
            parts.append(_member(model, motion_of(model, system, record, key), statement.cm))
            continue
        number = model.body_index[key]
        body, at = model.bodies[number], system.w_at["BODY", number]
        if body.width != PART:
            parts.append(record[:, at : at + POINT_SIZE])
            continue
        w = record[:, at : at + PART_SIZE]
        parts.append(_part(system, body, w) if _turns(statement) else _point(w))
    return np.concatenate([*parts, reactions_inside(model, system, record)], axis=1)


def _member(model: MergedModel, moving: Moving, cm: Key | None) -> np.ndarray:
    attitude = moving.attitude @ model.marker_in_body(cm)[1]
    angles = angles_313(attitude, ALIGNED)
    columns = [moving.x, angles, moving.v, moving.omega, moving.a, moving.alpha]
    return np.concatenate(columns, axis=1)


def _point(w: np.ndarray) -> np.ndarray:
    """Position, velocity and acceleration of a point mass that is solved as a part."""
    return np.concatenate([w[:, k : k + 3] for k in (POSITION, VELOCITY, ACCELERATION)], axis=1)


def _part(system: System, body: Body, w: np.ndarray) -> np.ndarray:
    attitude = w[:, ATTITUDE : ATTITUDE + 9].reshape(-1, 3, 3)
    cm = body.statement.cm
    if cm is not None:
        attitude = attitude @ system.model.marker(cm).axes
    columns = [
        w[:, POSITION : POSITION + 3],
        angles_313(attitude, ALIGNED),
        w[:, VELOCITY : VELOCITY + 3],
    ]
    columns += [w[:, OMEGA : OMEGA + 3], w[:, ACCELERATION : ACCELERATION + 3]]
    return np.concatenate([*columns, w[:, ALPHA : ALPHA + 3]], axis=1)
