"""What holds the steps of a run that was ended: who, why, and the force that changes most there.

Asked when a run has spent its budget; :mod:`adamslite.analyses.dynamics.step_limits` answers the
same of a run that goes on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.dynamics.step_limits import START, Seen, StepLimits
from adamslite.equations.unknown_names import placed, unknown
from adamslite.integrators.contract import ACCELERATION, RESIDUAL

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.language.statement import Statement

# Models of more statements are not searched for the force that changes most.
MOST_SEARCHED = 5000
# A change below this share of the force is round-off.
ROUND_OFF = 1e-12


def what_holds(system: System) -> str:
    """Words for ``held by ...``; empty where steps are as long as was requested."""
    lent, report = system.budget, system.report
    if system.settings.fixed_step > 0.0 or not report.h:
        return ""
    if system.model.deck.delays and system.settings.t_end - system.settings.t < lent.short:
        return "its shortest DELAY: no step reaches further than that"
    if not lent.seen:  # steps that are counted by the interval are equal ones, without notes
        return "" if system.settings.h_init > 0.0 else _changing(system)
    count = system.count
    since = Seen(int(count.steps - lent.crept), int(lent.events), int(lent.failures))
    limits = StepLimits(system, since if 0 < lent.crept <= count.steps else START)
    limits.look()
    reason = limits.reason()
    where = int(report.where)
    if not reason.startswith("the error") or where >= 2 * system.n:
        return reason
    found = _most_changed(system, where % system.n)
    return reason + (f"; of the forces there {placed(found)} changes most" if found else "")


def _changing(system: System) -> str:
    """The body whose acceleration would change most within a step, and the force that does."""
    change = _forces(system, 1.0) - _forces(system, 0.0)
    masses = np.ones(system.n)
    for b in range(len(system.model.bodies)):
        i = system.starts[b]
        masses[i : i + 3] = system.mass[b]
    row = int(np.abs(change / masses).argmax())
    found = _most_changed(system, row)
    named = f", where {placed(found)} changes most" if found else ""
    return f"the vibration of {unknown(system, row)}{named}"


def _forces(system: System, ahead: float) -> np.ndarray:
    """Forces on the bodies (n,) where the run stands, or by ``ahead`` of a step further on."""
    n, h = system.n, ahead * float(system.report.h)
    q, a, t = system.q.copy(), system.a.copy(), float(system.report.t)
    system.q[:n] += h * (system.u[:n] + 0.5 * h * system.a[:n])
    system.a[:], system.settings.t = 0.0, t + h
    system.run(RESIDUAL, ACCELERATION)
    system.q[:], system.a[:], system.settings.t = q, a, t
    return np.array(system.F[:n])


def _most_changed(system: System, row: int) -> Statement | None:
    """The force whose part in a row changes most within a step, if any does."""
    groups, count = system.group, system.sizes.ng
    instances = [
        (k, instance, statement)
        for k, group in enumerate(system.kernels.groups)
        if group.face == "loads"
        for instance, (statement, _) in enumerate(group.instances)
    ]
    if len(instances) > MOST_SEARCHED:
        return None
    found, top = None, 0.0
    system.sizes.ng = 0
    others = _forces(system, 0.0)[row], _forces(system, 1.0)[row]
    system.sizes.ng = 1
    for k, instance, statement in instances:
        system.group = system.instances.one_instance(groups, k, instance)
        now, later = _forces(system, 0.0)[row] - others[0], _forces(system, 1.0)[row] - others[1]
        change = abs(later - now)
        if change > max(top, ROUND_OFF * abs(now)):
            found, top = statement, change
    system.group, system.sizes.ng = groups, count
    return found
