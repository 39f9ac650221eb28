"""Initial conditions of joints: IC, ICTRAN, ICROT (and ICDISP of motions) as conditions at the
start only.

A freedom asked for as displacement d and velocity v is what a MOTION with FUNCTION = d + v*TIME
demands at time zero.  The model with these motions added is assembled once, and its state handed
on.
"""

from __future__ import annotations

from typing import Any

from adamslite.analyses.initial import Unclosed, initial_conditions
from adamslite.compiled import compile_model
from adamslite.deck import Deck
from adamslite.expression import TIME, Node, Num, Op
from adamslite.model import assemble
from adamslite.statement import STATEMENTS, Statement
from adamslite.system import System


def start_of_joints(system: System, progress: Any) -> Unclosed | None:
    """Put the state that satisfies all constraints and joint initial conditions into ``system``."""
    deck = system.model.deck
    extra = [m for s in deck.statements if hasattr(s, "initial") for m in _motions(s)]
    if not extra:
        return None
    with_motions = Deck(deck.source, deck.title, (*deck.statements, *extra), deck.names, deck.path)
    asked = System(compile_model(assemble(with_motions), progress), system.stabilised)
    unclosed = initial_conditions(asked)
    if unclosed is None:
        system.adopt(asked)
    return unclosed


def _motions(statement: Statement) -> list[Statement]:
    """A motion for each freedom asked for."""
    found = []
    for n, (freedom, displacement, velocity) in enumerate(statement.initial()):
        if displacement is None and velocity is None:
            continue
        where = {"joint": statement.key} if statement.keyword == "JOINT" else _markers(statement)
        found.append(
            STATEMENTS["MOTION"](
                id=f"{statement.keyword} {statement.id} start {n}",
                axis=freedom or None,
                level="VELOCITY" if displacement is None else "DISPLACEMENT",
                function=_line(displacement, velocity),
                spans=statement.spans,
                **where,
            )
        )
    return found


def _markers(motion: Statement) -> dict[str, Any]:
    return {"joint": motion.joint, "i": motion.i, "j": motion.j}


def _line(displacement: float | None, velocity: float | None) -> Node:
    """d + v*TIME, or the velocity alone."""
    if displacement is None:
        return Num(velocity)
    return Op("+", (Num(displacement), Op("*", (Num(velocity or 0.0), TIME))))
