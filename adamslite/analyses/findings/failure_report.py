"""The report of an early end: statement, equation, time, step, iteration, cause and remedy."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import isnan
from typing import TYPE_CHECKING

import numpy as np

from adamslite.assembly.reader import NumberReader
from adamslite.assembly.scope import Posture, Unmeasured
from adamslite.equations.unknown_names import equation, placed, tested, unknown
from adamslite.integrators import contract
from adamslite.integrators.contract import JACOBIAN, RESIDUAL
from adamslite.integrators.verlet.control import Control
from adamslite.language.expression import Num, Ref, to_text
from adamslite.results.outcomes import Outcome
from adamslite.symbolic.formulas import with_numbers

if TYPE_CHECKING:
    from adamslite.analyses.initial.conditions import Unclosed
    from adamslite.equations.system import System
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement

# A step below this multiple of HMIN is HMIN.
NEARLY = 1.01
# Models up to this many unknowns are searched for what leaves their accelerations open.
MOST_SEARCHED = 1500
# Singular values below this share of the largest are zero.
RANK = 1e-12
# The search ahead for an expression without a value doubles its way so often at most.
DOUBLINGS = 40
# Statements of a deck that are searched for an expression without a value.
MOST_LISTED = 300
# Contradicting statements named.
MOST_NAMED = 4
# Least steps below this share of the run are its own.
ROUND_OFF = 1e-12


def explain(system: System, outcome: Outcome, unclosed: Unclosed | None) -> str:
    """One paragraph for the user: where, when, what, and the outcome's own remedy."""
    failed = system.model.deck.user.failed
    if failed:
        return f"{failed.report()}. {Outcome.ROUTINE_FAILED.sentence}"
    if unclosed:
        return f"{_contradiction(unclosed)} {outcome.sentence}"
    text = REASONS.get(outcome, _when)(system)
    return f"{text[:1].upper()}{text[1:]}. {outcome.sentence}"


def _contradiction(unclosed: Unclosed) -> str:
    """The constraint that stays open at the start, and those that keep it from closing."""
    found = f"{placed(unclosed.statement)}, {unclosed.equation},"
    if isnan(unclosed.size):
        return f"{found} has no value at the start."
    text = f"{found} stays open by {unclosed.size:.3g} at {unclosed.level} level"
    others = unclosed.others[:MOST_NAMED]
    return f"{text}{', against ' * bool(others)}{' and '.join(map(placed, others))}."


def _when(system: System) -> str:
    """Time, number and size of the last step tried, its order."""
    report = system.report
    if not report.h:
        return _where(system)
    step = system.count.steps + 1
    text = f"at t = {report.t:.9g}, in step {step} of size {report.h:.3g}"
    text += " (HMIN)" if _is_least(system) else ""
    return text + (f" and order {report.order:.0f}" if report.order else "")


def _is_least(system: System) -> bool:
    """Whether the last step tried was as small as a requested HMIN."""
    step, least = system.report.h, system.settings.h_min
    return 0.0 < step <= NEARLY * least and least > ROUND_OFF * system.settings.t_end


def _where(system: System) -> str:
    """Only the time, for analyses without steps."""
    return f"at t = {system.report.t:.9g}"


def _error(system: System) -> str:
    """What the error test fails for, and by how much."""
    report = system.report
    if not report.h:
        return f"{_where(system)}, HMAX is too short a step to change the time"
    found = f"{tested(system, report.where)}: {_when(system)}"
    text = f"{found}, the estimated error is {report.error:.3g} times ERROR"
    return text + _held_up(system)


def _corrector(system: System) -> str:
    """The equation that stays open, the unknown that moves most."""
    report = system.report
    if not report.iteration:
        where = tested(system, report.where)
        return f"{where}: {_when(system)}, no accelerations found"
    open_row = equation(system, report.open_row)
    opening = f"{open_row}: {_when(system)}, this equation is off by {report.open_by:.3g} "
    opening += f"after iteration {report.iteration}, more than all"
    moving = unknown(system, report.changed)
    text = f"{opening} others. {moving}, changes most, by {report.change:.3g}"
    return text + _held_up(system)


def _held_up(system: System) -> str:
    """What there is to say when HMIN kept the step from being shorter."""
    return (
        ". HMIN allows no shorter step; a smaller one, or none, would" if _is_least(system) else ""
    )


def _singular_mass(system: System) -> str:
    """The forces that depend on accelerations, and the coordinate without inertia."""
    found = [
        s
        for group in system.kernels.groups
        if group.face in ("loads", "equation") and group.meta["mass"]
        for s, _ in group.instances
    ]
    named = ", ".join(placed(s) for s in found[:3])
    text = f"{named}: {_when(system)}" if named else _when(system)
    if system.nz > MOST_SEARCHED:
        return text
    matrix, kept = _acceleration_matrix(system)
    if not np.isfinite(matrix).all():
        return text
    scale = _inertias(system)[kept] ** -0.5
    loosest = np.linalg.svd(scale[:, None] * matrix * scale)[2][-1]
    inert = kept[int(np.abs(np.where(np.array(kept) < system.n, loosest, 0.0)).argmax())]
    return f"{text}. {unknown(system, inert)}, loses its inertia"


def _inertias(system: System) -> np.ndarray:
    """Masses and moments of inertia of the coordinates as the deck gives them, 1 for other
    unknowns; so that a small mass is not mistaken for one that vanishes.
    """
    sizes = np.ones(system.nz)
    for b, body in enumerate(system.model.bodies):
        i = system.starts[b]
        sizes[i : i + 3] = body.mass
        if system.widths[b] > 3:
            sizes[i + 3 : i + 6] = np.diag(body.inertia)
    return np.where(sizes > 0.0, sizes, 1.0)


def _acceleration_matrix(system: System) -> tuple[np.ndarray, list[int]]:
    """The matrix of accelerations, multipliers and variables where the run stands, and the numbers
    of its unknowns.
    """
    system.coef[:5], system.settings.t = (0.0, 0.0, 1.0, 1.0, 1.0), system.report.t
    system.run(JACOBIAN, contract.ACCELERATION)
    count = system.n + system.m + system.nv + system.ns
    kept = [k for k in range(count) if k - system.n not in system.elimination.dropped]
    return system.dense_jacobian()[np.ix_(kept, kept)], kept


def _undetermined(system: System) -> str:
    """The unknown that the equations leave open most: largest in the null vector of the matrix of
    accelerations, multipliers and variables; when it has none, the equation that stays open.
    """
    if system.nz > MOST_SEARCHED:
        return _where(system)
    matrix, kept = _acceleration_matrix(system)
    if not np.isfinite(matrix).all():
        return _open(system, kept)
    _, sizes, rows = np.linalg.svd(matrix)
    if sizes[-1] > RANK * sizes[0]:
        return _open(system, kept)
    free = kept[int(np.abs(rows[-1]).argmax())]
    why = "it is free" if free < system.n + system.m else "every value of it would do, or none"
    return f"{unknown(system, free)}: {_where(system)}, {why}"


def _open(system: System, rows: list[int]) -> str:
    """The equation of accelerations that is farthest from being solved."""
    system.run(RESIDUAL, contract.ACCELERATION)
    sizes = np.abs(system.F[rows])
    worst = int(np.argmax(np.where(np.isfinite(sizes), sizes, np.inf)))
    return f"{equation(system, rows[worst])}: {_where(system)}, it stays open by {sizes[worst]:.3g}"


def _not_finite(system: System) -> str:
    """The statement whose expression has no value where the run stands, or further ahead: as far
    as an output step of VERLET, which stands still at the last output time.
    """
    start, report, deck = system.q.copy(), system.report, system.model.deck.statements
    system.a[:], system.z[:] = 0.0, np.nan_to_num(system.z)
    ahead = [0.0, *(report.h * np.exp2(range(DOUBLINGS)))]
    far = float(np.diff(system.times).max(initial=0.0))
    before: set[str] = set()

    def new_in_deck() -> Statement | None:
        """A statement whose expression loses its value here, though it has no equation."""
        lost = (each for each in deck if each.label not in before and _undefined(system, each))
        return next(lost, None)

    for find in (partial(_without_value, system), new_in_deck)[: 1 + (len(deck) < MOST_LISTED)]:
        for way in (each for each in ahead if each <= max(far, report.h)):
            system.settings.t = report.t + way
            system.q[: system.n] = start[: system.n] + way * system.u[: system.n]
            if find is new_in_deck and not way:
                before |= {each.label for each in deck if _undefined(system, each)}
            if (guilty := find()) is not None:
                cause = _undefined(system, guilty)
                system.q[:] = start
                return f"{placed(guilty)}: {_when(system)}{cause}"
    system.q[:] = start
    guilty = _without_derivative(system)
    if guilty is not None:
        return f"{placed(guilty)}: {_when(system)}, a derivative has no value"
    text = f"{tested(system, report.where)}: {_when(system)}"
    return f"{text}, though no statement by itself lacks a value. Look at END, HMAX and ERROR too"


def _undefined(system: System, statement: Statement) -> str:
    """The innermost part of the statement's expressions without a finite value, in words, with the
    values of what it is made of; empty where no posture alone gives one.
    """
    bodies, start = system.model.bodies, Posture.start(system.model)
    for b, i in enumerate(system.starts[: len(bodies)]):
        width = int(system.widths[b])
        start.x[b], start.speed[b, :width] = system.q[i : i + 3], system.u[i : i + width]
    start.attitude[:] = system.base[: 9 * len(bodies)].reshape(-1, 3, 3)
    reader = NumberReader(system.model, start, False)
    reader.now = float(system.settings.t)
    fields = (getattr(statement, name) for name, each in statement.arguments.items()
              if each.kind == "expression")  # fmt: skip
    pending = [each for each in fields if each is not None]
    seen: set[Key] = set()
    while pending:
        node = pending.pop()
        parts = [each for each in getattr(node, "args", ()) if not isinstance(each, Ref)]
        refs = [each for each in getattr(node, "args", ()) if isinstance(each, Ref)]
        named = [each.id for each in refs if each.kind == "VARIABLE"]
        named, seen = [each for each in named if each not in seen], {*seen, *named}
        pending += [*(system.model.variable(each).function for each in named), *parts]
        try:
            with with_numbers():
                values = [float(reader.value(each).value) for each in parts]
                whole = float(reader.value(node).value)
        except (Unmeasured, TypeError, AttributeError):
            continue
        if not np.isfinite(whole) and not named and np.isfinite(values).all():
            pairs = zip(parts, values, strict=True)
            given = [f"{to_text(p)} = {x:.6g}" for p, x in pairs if not isinstance(p, Num)]
            return f", {to_text(node)} has no finite value{' at ' * bool(given)}{', '.join(given)}"
    return ""


def _without_value(system: System) -> Statement | None:
    """The first statement that brings not-a-number or infinity into the equations."""

    def fails() -> bool:
        system.run(RESIDUAL, contract.ACCELERATION)
        return not np.isfinite(system.F[: system.nz]).all()

    return _first(system, fails)


def _without_derivative(system: System) -> Statement | None:
    """The same of their derivatives."""

    def fails() -> bool:
        system.coef[:5] = 1.0
        system.run(JACOBIAN, contract.ACCELERATION)
        return not np.isfinite(system.sparse_jacobian().data).all()

    return _first(system, fails)


def _first(system: System, fails: Callable[[], bool]) -> Statement | None:
    """The first statement for which something is true of the equations with that one alone."""
    groups, count = system.group, system.sizes.ng
    system.sizes.ng = 1
    guilty = None
    for k, group in enumerate(system.kernels.groups):
        for instance, (statement, _) in enumerate(group.instances):
            system.group = system.instances.one_instance(groups, k, instance)
            if guilty is None and fails():
                guilty = statement
    system.group, system.sizes.ng = groups, count
    return guilty


def _static(system: System) -> str:
    """What is out of balance."""
    system.u[:], system.a[:] = 0.0, 0.0
    system.run(RESIDUAL, contract.STATIC)
    rows = np.abs(system.F[: system.nz])
    worst = int(np.argmax(np.where(np.isfinite(rows), rows, np.inf)))
    return f"{equation(system, worst)}: {_where(system)}, out of balance by {rows[worst]:.3g}"


def _chattering(system: System) -> str:
    if system.triggered:
        return f"{' and '.join(map(placed, system.triggered))} acts again at once: {_when(system)}"
    guilty = system.guarded["watch"][system.search.culprit][0]
    return f"{placed(guilty)}: {_when(system)}"


def _torn(system: System) -> str:
    """The row that was left out and opens."""
    return f"{equation(system, system.report.torn)}: {_where(system)}, it opens"


def _broken_motion(system: System) -> str:
    """What drives a constraint and cannot be followed."""
    found = system.broken
    assert found is not None
    return f"{placed(found.statement)}: at t = {found.time:.9g}, the {found.quantity} {found.how}"


def _unstable(system: System) -> str:
    return f"{_when(system)}; stable are steps up to {Control(system.control).limit:.3g}"


def _overspent(system: System) -> str:
    """Where the run was when its budget was spent, and what held its steps."""
    # Few runs have one.
    from adamslite.analyses.findings.held_steps import what_holds

    reason = what_holds(system) if system.report.h else ""
    return _when(system) + (f", held by {reason}" if reason else "")


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
    Outcome.BROKEN_MOTION: _broken_motion,
    Outcome.TORN: _torn,
    Outcome.CREEPING: _overspent,
    Outcome.STEP_LIMIT: _overspent,
    Outcome.CPU_LIMIT: _overspent,
    Outcome.MEMORY_LIMIT: _where,
    Outcome.NOT_KINEMATIC: _not_kinematic,
    Outcome.INITIAL_CONDITIONS_FAILED: _where,
}
