"""The choice of the integrator: from the INTEGRATOR statement and the properties of the model.

AUTO, with rho the largest circular frequency of the linearised scene and dt the output step:

1. variables that are solved for, DIFF states, forces of accelerations other than added mass, and
   bodies without inertia may be as fast as they like: implicit;
2. tied by constraints, with forces that set in or break off (contacts, stops, slack lines): RADAU,
   with ERROR of ``COARSE`` at most.  Events cut the steps of every formula, so that order 8 finds
   no use, while each of its 12 stages eliminates the constraints once; RADAU does so once in real
   and once in complex numbers.  And a stiff contact limits explicit steps only once it is closed,
   which rho does not know at the start;
3. otherwise, tied by constraints or not, explicit while rho dt stays below ``STEPS_WORTH`` radians:
   VERLET for free point masses with ERROR of ``COARSE`` and above, unless a few contacts, which it
   does not locate, decide on its error; RKF45 for the rest.  Where a contact, once closed, decays
   so fast that it holds the steps of RKF45 down, the run begins again with RADAU, as one that
   RADAU does not get through begins again with RKF45;
4. implicit: RADAU below ``COARSE``, GSTIFF for bodies without inertia; from ``COARSE`` on HHT for
   free scenes that are stiff, else GSTIFF.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.setup.output_times import largest_step
from adamslite.errors import UsageError
from adamslite.integrators import contract
from adamslite.integrators.contract import SPECTRUM
from adamslite.language.method import AUTO, CONSTRAINTS, ROTATIONS, STATE_JUMPS, methods
from adamslite.model.model import PART, NodeKey
from adamslite.symbolic.guards import FLOOR, JUMPS, POLE, ROOT

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings
    from adamslite.equations.system import System
    from adamslite.kernels.groups import ShapeGroup

# An explicit step costs a few residuals and covers a few radians of the fastest oscillation; an
# implicit one costs some ten, and motion worth recording takes some ten steps per output step.
STEPS_WORTH = 3000.0
# Formulas of second order pay from here on.
COARSE = 1e-4
# Up to so many guards of contacts RKF45, which ends a step at each change, costs some times what
# VERLET does and has a thousandth of its error; with hundreds it costs a hundred times as much.
FEW_GUARDS = 20
# A jump felt for a step too long is within ERROR from here on.
ROUGH = 1e-3
# Unknowns of their own, and what to say of them.
SOLVED = {"VARIABLE": "is solved for", "DIFF": "is a state"}


@dataclass(frozen=True)
class MethodChoice:
    """``settings`` with a method that exists; ``reason`` why, empty when it was asked for;
    ``instead``: the method that begins again where that one stalls.
    """

    settings: Settings
    reason: str = ""
    instead: str = ""

    @property
    def other(self) -> MethodChoice:
        """The choice of that method."""
        settings = replace(self.settings, method=self.instead)
        way = "explicit" if settings.formula.explicit else "implicit"
        return MethodChoice(settings, f"{way}, because {self.settings.method} stalled")


def choose_method(system: System, times: np.ndarray, settings: Settings) -> MethodChoice:
    """The integrator of a run over ``times`` (nt,).

    Raises
    ------
    UsageError
        When the method asked for does not exist or cannot run this scene.
    """
    if unfit := what_is_unfit(system, settings):
        raise UsageError(f"{settings.method} cannot run this scene: {unfit}")
    if settings.method in methods():
        return MethodChoice(settings)
    if settings.method != AUTO:
        known = ", ".join([*methods(), AUTO])
        raise UsageError(f"There is no integrator {settings.method}. Known are {known}.")
    method, reason, *instead = _picked(system, times, settings.error)
    # RKF45, whose place RADAU takes here, is far below an ERROR above that.
    error = min(settings.error, COARSE) if method == "RADAU" and instead else settings.error
    if system.model.deck.delays:
        instead = []  # their past is written for one run
    return MethodChoice(replace(settings, method=method, error=error), reason, *instead)


def what_is_unfit(system: System, settings: Settings) -> str:
    """Why the method asked for cannot run a scene, and what can; empty when it can."""
    method = methods().get(settings.method)
    if method is None:
        return ""
    for what in method.cannot:
        if obstacle := _OBSTACLES[what](system, settings.error):
            return f"{obstacle}. Use ABAM (explicit) or GSTIFF (implicit)."
    return method.unfit(settings, what_ties(system) if system.m else "") if method.unfit else ""


def what_ties(system: System) -> str:
    """What keeps accelerations from following body by body, as words; empty when nothing does."""
    for node in _beside_bodies(system):
        if node[0] not in ("MU", *SOLVED):
            return f"{node[0]}/{node[1]} is a constraint"
    return what_is_solved(system) or what_is_light(system)


def what_is_solved(system: System) -> str:
    """What has to be solved for beside motion and reactions, as words; empty when nothing has."""
    for node in _beside_bodies(system):
        if node[0] in SOLVED:
            return f"{node[0]}/{node[1]} {SOLVED[node[0]]}"
    if system.sizes.implicit_mass:
        return "a force depends on accelerations"
    return ""


def _beside_bodies(system: System) -> list[NodeKey]:
    """The nodes that are no bodies: those come first."""
    return system.nodes[len(system.model.bodies) :]


def has_effective_masses(system: System) -> bool:
    """Whether forces that depend on accelerations are added mass, and nothing else is solved for:
    accelerations then follow body by body.
    """
    return bool(system.sizes.added_mass) and system.nz == system.n


def what_is_light(system: System) -> str:
    """A body without mass or inertia in some direction, as words; empty when there is none."""
    if not _turning(system) and (system.mass > 0.0).all():
        return ""
    for body in system.model.bodies:
        if not body.mass > 0.0 or (body.width == PART and np.linalg.matrix_rank(body.inertia) < 3):
            return f"{body.statement.label} has no mass or inertia"
    return ""


def what_turns(system: System) -> str:
    """A body that turns: its inertia forces depend on velocities."""
    if not _turning(system):
        return ""
    part = next(body for body in system.model.bodies if body.width == PART)
    return f"{part.statement.label} turns, and its gyroscopic torque lags"


def _turning(system: System) -> bool:
    return PART in system.widths[: len(system.model.bodies)]


def what_changes(system: System, error: float) -> str:
    """A force that equal steps may pass without having felt it, or feel for a step too long: one
    that may jump with the state, unless ERROR is rough, or rises within a zone or a table.
    """
    jumping = [s for s, kind in system.guarded["watch"] if kind >= JUMPS and error < ROUGH]
    rising = [s for s, kind in system.guarded["zone"] if kind not in (POLE, ROOT)]
    rising += [s for s, kind in system.guarded["watch"] if kind == FLOOR]
    if jumping:
        return (
            f"{jumping[0].label} may jump with the state (IF, SIGN), and equal steps look past that"
        )
    if rising:
        return (
            f"{rising[0].label} rises within a zone (STEP, IMPACT, TANH, MOD, a table), and equal "
            "steps may skip that"
        )
    return ""


_OBSTACLES: dict[str, Callable[[System, float], str]] = {
    CONSTRAINTS: lambda system, error: what_ties(system),
    ROTATIONS: lambda system, error: what_turns(system),
    STATE_JUMPS: what_changes,
}


def what_meets(system: System) -> str:
    """A force that sets in or breaks off as bodies meet or lines come taut, without a jump of its
    value, as words; empty when there is none.
    """
    bent = next((group for group in system.kernels.groups if _bends(group)), None)
    if bent is None:
        return ""
    return f"{bent.instances[0][0].label} sets in and breaks off with the state (IMPACT, MAX)"


def _bends(group: ShapeGroup) -> bool:
    kinds = group.meta["guards"]["watch"] if group.face == "loads" else ()
    return any(kind < JUMPS for kind in kinds)


def fastest(system: System, time: float) -> float:
    """Largest circular frequency or rate [rad/time] of the linearised scene, damping included."""
    system.settings.t = time
    if system.run(SPECTRUM) != contract.DONE:
        return float("inf")
    stiff, damp = float(system.report.stiffness), float(system.report.damping)
    return max(sqrt(stiff), damp)


def _picked(system: System, times: np.ndarray, error: float) -> tuple[str, ...]:
    """Method, reason, and the method that begins again where that one stalls."""
    implicit = "GSTIFF" if error >= COARSE else "RADAU"
    obstacle = what_is_solved(system)
    if obstacle and not has_effective_masses(system):
        return implicit, f"implicit, because {obstacle}"
    if obstacle := what_is_light(system):
        return "GSTIFF", f"implicit, because {obstacle}"
    tied, meeting = what_ties(system), what_meets(system)
    if tied and meeting:
        return "RADAU", f"implicit, because {meeting}, and {tied}", "RKF45"
    pace = largest_step(times)
    radians = fastest(system, float(times[0])) * pace
    reason = f"its fastest oscillation turns {radians:.3g} rad in an output step"
    if not radians <= STEPS_WORTH:
        return "HHT" if error >= COARSE and not tied else implicit, f"implicit, because {reason}"
    unfit = tied or what_turns(system) or what_changes(system, 0.0)
    few = meeting and len(system.guarded["watch"]) <= FEW_GUARDS
    if error >= COARSE and not (unfit or few or system.numbering.sensors or system.guarded["zone"]):
        return "VERLET", f"explicit, because nothing ties the masses together and {reason}"
    return "RKF45", f"explicit, because {reason}", "RADAU" if meeting else ""
