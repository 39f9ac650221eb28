"""Initial conditions of joints, motions and curves: IC, ICTRAN, ICROT, ICDISP, VELOCITY.

A requested displacement is what a MOTION with FUNCTION = d demands of the positions, a speed what a
MOTION/VELOCITY with FUNCTION = v demands of the velocities.  The model with these motions added is
assembled once, and its state handed on.  What is not requested stays as the bodies say: the speed
of a freedom with a displacement alone, and of a MOTION/ACCELERATION without ICVEL.  VELOCITY of a
PTCV is such a motion of the point that carries its parameter.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.analyses.initial.conditions import initial_conditions, speed_defects
from adamslite.assembly.start import conditions, speed_on_curve
from adamslite.elements.joint import Joint
from adamslite.elements.motion import Motion
from adamslite.elements.ptcv import Ptcv
from adamslite.equations.system import System
from adamslite.kernels.compile import compile_model
from adamslite.model.model import assemble

if TYPE_CHECKING:
    from adamslite.analyses.initial.conditions import Unclosed
    from adamslite.progress import Progress

# The speed of a path that a closed posture has moved is found again there.
PASSES = 3


def start_of_joints(system: System, progress: Progress | None) -> Unclosed | None:
    """Put the state that satisfies all constraints and initial conditions into ``system``."""
    deck = system.model.deck
    active = [s for s in deck.statements if isinstance(s, Joint | Motion) and deck.is_active(s)]
    extra = [condition for s in active for condition in conditions(s)]
    on_curves = [s for s in deck.of(Ptcv) if s.velocity is not None and deck.is_active(s)]
    coasting = [s for s in active if isinstance(s, Motion) and _coasts(s)]
    if not extra and not coasting and not on_curves:
        return None
    free: list[Motion] = [c for c in extra if c.level == "DISPLACEMENT"] + coasting
    paths = [0.0] * len(on_curves)
    for _ in range(PASSES):
        rates = [s.rate(system.model, p) for s, p in zip(on_curves, paths, strict=True)]
        pairs = zip(on_curves, rates, strict=True)
        speeds = [made for s, rate in pairs for made in speed_on_curve(deck, s, rate)]
        model = assemble(deck.with_more([*extra, *speeds]))
        held = System(compile_model(model, progress), system.numbering.stabilised)
        unclosed = initial_conditions(held, free)
        before, paths = paths, [_path(held, s) for s in on_curves]
        if unclosed or before == paths:
            break
    if unclosed is None:
        _take_speeds(held, coasting)
        system.adopt(held)
    return unclosed


def _path(system: System, constraint: Ptcv) -> float:
    """How far the point has moved along the curve while the posture was closed."""
    labels = [body.statement.key for body in system.model.bodies]
    return float(system.q[system.starts[labels.index(constraint.slider.upper())]])


def _coasts(motion: Motion) -> bool:
    """Whether a motion begins with the speed that the bodies have."""
    return motion.level == "ACCELERATION" and motion.icvel is None


def _take_speeds(system: System, motions: list[Motion]) -> None:
    """Let the states s of accelerations start at the speeds there are: their rows are dq/dt - s."""
    for motion, (defect,) in zip(motions, speed_defects(system, motions), strict=True):
        place = system.starts[system.node_at["DIFF", motion.state.upper()]] - system.n
        system.z[place] += defect
