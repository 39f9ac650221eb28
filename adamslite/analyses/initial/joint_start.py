"""Initial conditions of joints and motions: IC, ICTRAN, ICROT, ICDISP.

A requested displacement is what a MOTION with FUNCTION = d demands of the positions, a speed what a
MOTION/VELOCITY with FUNCTION = v demands of the velocities.  The model with these motions added is
assembled once, and its state handed on.  What is not requested stays as the bodies say: the speed
of a freedom with a displacement alone, and of a MOTION/ACCELERATION without ICVEL.
"""

from __future__ import annotations

from adamslite.analyses.initial.conditions import Unclosed, initial_conditions, speed_defects
from adamslite.assembly.start_conditions import conditions
from adamslite.elements.joint import Joint
from adamslite.elements.motion import Motion
from adamslite.equations.system import System
from adamslite.kernels.compile import compile_model
from adamslite.model.model import assemble
from adamslite.progress import Progress


def start_of_joints(system: System, progress: Progress | None) -> Unclosed | None:
    """Put the state that satisfies all constraints and initial conditions into ``system``."""
    deck = system.model.deck
    active = [s for s in deck.statements if isinstance(s, Joint | Motion) and deck.is_active(s)]
    extra = [condition for s in active for condition in conditions(s)]
    coasting = [s for s in active if isinstance(s, Motion) and _coasts(s)]
    if not extra and not coasting:
        return None
    model = assemble(deck.with_more(extra))
    held = System(compile_model(model, progress), system.numbering.stabilised)
    free: list[Motion] = [c for c in extra if c.level == "DISPLACEMENT"] + coasting
    unclosed = initial_conditions(held, free)
    if unclosed is None:
        _take_speeds(held, coasting)
        system.adopt(held)
    return unclosed


def _coasts(motion: Motion) -> bool:
    """Whether a motion begins with the speed that the bodies have."""
    return motion.level == "ACCELERATION" and motion.icvel is None


def _take_speeds(system: System, motions: list[Motion]) -> None:
    """Let the states s of accelerations start at the speeds there are: their rows are dq/dt - s."""
    for motion, (defect,) in zip(motions, speed_defects(system, motions), strict=True):
        place = system.starts[system.node_at["DIFF", motion.state.upper()]] - system.n
        system.z[place] += defect
