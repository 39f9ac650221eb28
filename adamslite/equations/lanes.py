"""Runs of instances whose bodies follow each other, for loads that are evaluated by component.

The bodies of instance k of a run stand k places behind those of its first instance, as
:mod:`adamslite.kernels.code.lane_writer` needs them: the sections of a cable are one run, a net has
one for each row and each column.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.equations.engine import distinct
from adamslite.integrators.contract import LaneRun
from adamslite.kernels.code.workspace import POINT_SIZE
from adamslite.native.translate import Rows

if TYPE_CHECKING:
    from adamslite.equations.instances import Instances
    from adamslite.kernels.groups import ShapeGroup

#: Instances per run, and per body with other loads, from which runs pay.
WORTH = 4


@dataclass
class Runs:
    """``rows`` for native code, which reads the arrays that are ``kept`` here; ``groups``: the
    numbers of the groups that they are of, ``bodies``: with loads of other groups.
    """

    rows: Rows[LaneRun]
    kept: list[np.ndarray]
    groups: list[int]
    bodies: np.ndarray


def runs(instances: Instances) -> Runs | None:
    """Loads as runs; None where they would be too short, or others too many or of added mass."""
    numbering, kernels = instances.numbering, instances.kernels
    bodies = kernels.model.bodies
    if numbering.n != numbering.nz or numbering.n != 3 * len(bodies):
        return None
    if not all(body.mass > 0.0 for body in bodies):
        return None
    rows, kept, total, groups = [], [], 0, []
    others = [np.zeros(0, dtype=np.int64)]
    for k, group in enumerate(kernels.groups):
        if group.face != "loads":
            continue
        n, count = group.n_bodies, len(group.instances)
        ints = instances.keep[2 * k].reshape(count, -1)[:, : n + _signals(group)].copy()
        ints[:, :n] = (ints[:, :n] - numbering.n_head) // POINT_SIZE
        if not _is_plain(group):
            others.append(ints[:, :n].ravel())
            if group.meta["mass"]:
                return None
            continue
        groups.append(k)
        order = _as_bodies_follow(ints, n)
        ints, reals = ints[order], instances.keep[2 * k + 1][:-1].reshape(count, -1)
        reals = np.ascontiguousarray(reals[order].T)
        kept += [ints, reals]
        total += count
        for first, end in _spans(ints, n):
            rows.append((k, first, end - first, ints[first:], reals[:, first:]))
    beside = distinct(np.concatenate(others))
    if not rows or WORTH * (len(rows) + len(beside)) > total:
        return None
    # Only methods that evaluate by component need it.
    from adamslite.kernels.compile import lanes

    made = Rows(LaneRun, len(rows))
    for run, (k, _, count, ints, reals) in zip(made, rows, strict=True):
        group = kernels.groups[k]
        run.function, run.mass = lanes(kernels, group)
        run.count, run.of = count, len(group.instances)
        run.ints, run.reals = ints.ctypes.data, reals.ctypes.data
    return Runs(made, kept, groups, beside)


def _is_plain(group: ShapeGroup) -> bool:
    """Loads that depend on time, places and velocities alone, always by the same law, but for added
    mass.
    """
    meta, binding = group.meta, group.instances[0][1]
    remembers = meta["angles"] or meta["limits"] or any(meta["guards"].values())
    solved = meta["mass"] and not meta["added_mass"]
    return not (remembers or solved or binding.tables or binding.nodes)


def _signals(group: ShapeGroup) -> int:
    return len(group.instances[0][1].signals)


def _as_bodies_follow(ints: np.ndarray, n_bodies: int) -> np.ndarray:
    """The order of instances in which those of a run follow each other."""
    if not n_bodies:
        return np.arange(len(ints))
    apart = ints[:, 1:].copy()
    apart[:, : n_bodies - 1] -= ints[:, :1]
    return np.lexsort((ints[:, 0], *apart.T))


def _spans(ints: np.ndarray, n_bodies: int) -> Iterator[tuple[int, int]]:
    """First instance and end of every run: ``n_bodies`` columns count up, the others are equal."""
    steps = np.diff(ints, axis=0)
    steps[:, :n_bodies] -= 1
    breaks = np.flatnonzero(steps.any(axis=1)) + 1
    return zip([0, *breaks.tolist()], [*breaks.tolist(), len(ints)], strict=True)
