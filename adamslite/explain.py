"""Why a run ended early: statement, line, equation, time, step, iteration, cause and remedy."""

from __future__ import annotations

from typing import Any

import numpy as np

from adamslite.engine import JACOBIAN, RESIDUAL
from adamslite.integrators import base
from adamslite.integrators.event_places import CULPRIT
from adamslite.integrators.verlet import LIMIT
from adamslite.outcomes import Outcome
from adamslite.system import System
from adamslite.unknowns import equation, placed, tested, unknown

# Models up to this many unknowns are searched for what leaves their accelerations open.
MOST_SEARCHED = 1500
# Singular values below this share of the largest are zero.
RANK = 1e-12
# Least steps below this share of the run are its own.
ROUND_OFF = 1e-12


def explain(system: System, outcome: Outcome, unclosed: Any) -> str:
    """One paragraph for the user: where, when, what, and the outcome's own remedy."""
    if unclosed:
        found = f"{placed(unclosed.statement)}, {unclosed.equation}, stays open by "
        return f"{found}{unclosed.size:.3g} at {unclosed.level} level. {outcome.value}"
    told = REASONS.get(outcome, _when)(system)
    return f"{told[:1].upper()}{told[1:]}. {outcome.value}"


def _when(system: System) -> str:
    """Time, number and size of the last step tried, its order."""
    report = system.report
    step = int(system.count[base.STEPS]) + 1
    text = f"at t = {report[base.AT]:.9g}, in step {step} of size {report[base.STEP]:.3g}"
    text += " (HMIN)" if _is_least(system) else ""
    return text + (f" and order {report[base.ORDER]:.0f}" if report[base.ORDER] else "")


def _is_least(system: System) -> bool:
    """Whether the last step tried was as small as an HMIN that was asked for."""
    step, least = system.report[base.STEP], system.settings[base.H_MIN]
    return 0.0 < step <= 1.01 * least and least > ROUND_OFF * system.settings[base.T_END]


def _where(system: System) -> str:
    """Only the time, for analyses without steps."""
    return f"at t = {system.report[base.AT]:.9g}"


def _error(system: System) -> str:
    """What the error test fails for, and by how much."""
    report = system.report
    found = f"{tested(system, int(report[base.WHERE]))}: {_when(system)}"
    return f"{found}, the estimated error is {report[base.HOW_MUCH]:.3g} times ERROR"


def _corrector(system: System) -> str:
    """The equation that stays open, the unknown that moves most."""
    report = system.report
    if not report[base.ITERATION]:
        return f"{tested(system, int(report[base.WHERE]))}: {_when(system)}, no accelerations found"
    said = (
        f"{equation(system, int(report[base.OPEN_ROW]))}: {_when(system)}, this equation is off by "
    )
    said += (
        f"{report[base.OPEN_BY]:.3g} after iteration {report[base.ITERATION]:.0f}, more than all"
    )
    moving = unknown(system, int(report[base.CHANGED]))
    return f"{said} others. {moving}, changes most, by {report[base.CHANGE]:.3g}"


def _singular_mass(system: System) -> str:
    """The forces that depend on accelerations."""
    found = [
        s
        for group in system.kernels.groups
        if group.face in ("loads", "equation") and group.meta["mass"]
        for s, _ in group.instances
    ]
    named = ", ".join(placed(s) for s in found[:3])
    return f"{named}: {_when(system)}" if named else _when(system)


def _undetermined(system: System) -> str:
    """The coordinate that the equations leave open most: largest in the null vector of the
    matrix of accelerations and multipliers.
    """
    if system.nz > MOST_SEARCHED:
        return _where(system)
    system.coef[:5] = 0.0, 0.0, 1.0, 1.0, 1.0
    system.run(JACOBIAN, base.ACCELERATION)
    count = system.n + system.m + system.nv + system.ns
    matrix = system.dense_jacobian()[:count, :count]
    kept = [k for k in range(count) if k - system.n not in system.dropped]
    _, sizes, rows = np.linalg.svd(matrix[np.ix_(kept, kept)])
    if sizes[-1] > RANK * sizes[0]:
        return _where(system)
    return f"{unknown(system, kept[int(np.abs(rows[-1]).argmax())])}: {_where(system)}, it is free"


def _not_finite(system: System) -> str:
    """The statement whose expression has no value where the run stands, or a step further."""
    start, report = system.q.copy(), system.report
    system.a[:], system.z[:] = 0.0, np.nan_to_num(system.z)
    system.settings[base.T] = report[base.AT]
    guilty = _without_value(system)
    if guilty is None:
        system.settings[base.T] += report[base.STEP]
        system.q[: system.n] += report[base.STEP] * system.u[: system.n]
        guilty = _without_value(system)
        system.q[:] = start
    found = placed(guilty) if guilty else tested(system, int(report[base.WHERE]))
    return f"{found}: {_when(system)}"


def _without_value(system: System) -> Any:
    """The first statement that brings not-a-number or infinity into the equations."""
    groups, count = system.group, system.sizes[base.NG]
    system.sizes[base.NG] = 1
    guilty = None
    for k, group in enumerate(system.kernels.groups):
        for instance, (statement, _) in enumerate(group.instances):
            system.group = system.one_instance(groups, k, instance)
            system.run(RESIDUAL, base.ACCELERATION)
            if guilty is None and not np.isfinite(system.F[: system.nz]).all():
                guilty = statement
    system.group, system.sizes[base.NG] = groups, count
    return guilty


def _static(system: System) -> str:
    """What is out of balance."""
    system.u[:], system.a[:] = 0.0, 0.0
    system.run(RESIDUAL, base.STATIC)
    rows = np.abs(system.F[: system.nz])
    worst = int(np.argmax(np.where(np.isfinite(rows), rows, np.inf)))
    return f"{equation(system, worst)}: {_where(system)}, out of balance by {rows[worst]:.3g}"


def _chattering(system: System) -> str:
    guilty = system.guarded["watch"][int(system.search[CULPRIT])][0]
    return f"{placed(guilty)}: {_when(system)}"


def _unstable(system: System) -> str:
    return f"{_when(system)}; stable are steps up to {system.control[LIMIT]:.3g}"


def _not_kinematic(system: System) -> str:
    ways = "one degree" if system.dof == 1 else f"{system.dof} degrees"
    return f"{_where(system)}, the model has {ways} of freedom"


REASONS = {
    Outcome.STEP_TOO_SMALL: _error,
    Outcome.NEWTON_FAILED: _corrector,
    Outcome.SINGULAR_ACCELERATION: _singular_mass,
    Outcome.UNDETERMINED: _undetermined,
    Outcome.NOT_FINITE: _not_finite,
    Outcome.NO_EQUILIBRIUM: _static,
    Outcome.CHATTERING: _chattering,
    Outcome.UNSTABLE: _unstable,
    Outcome.NOT_KINEMATIC: _not_kinematic,
    Outcome.INITIAL_CONDITIONS_FAILED: _where,
}
