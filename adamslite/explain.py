"""Why a run ended early: statement, line, equation, time, cause."""

from __future__ import annotations

from typing import Any

from adamslite.integrators import base
from adamslite.integrators.event_places import CULPRIT
from adamslite.outcomes import Outcome
from adamslite.system import System

COORDINATES = ("x", "y", "z", "rotation about x", "rotation about y", "rotation about z")


def explain(system: System, outcome: Outcome, unclosed: Any) -> str:
    """One paragraph for the user: where, when, what, and the outcome's own remedy."""
    if unclosed:
        where = f"{unclosed.statement.label} ({_place(unclosed.statement)})"
        found = f"{where} stays open by {unclosed.size:.3g} at {unclosed.level} level."
        return f"{found} {outcome.value}"
    report = system.report
    if outcome is Outcome.CHATTERING:
        guilty = system.guarded["watch"][int(system.search[CULPRIT])][0]
        return f"{guilty.label} ({_place(guilty)}), t = {report[base.AT]:.9g}. {outcome.value}"
    facts = f"t = {report[base.AT]:.9g}, step {report[base.STEP]:.3g}"
    return f"{_culprit(system, outcome)}At {facts}. {outcome.value}"


def _culprit(system: System, outcome: Outcome) -> str:
    """The statement to look at first, when one can be named."""
    if outcome is Outcome.SINGULAR_ACCELERATION:
        found = [
            s
            for group in system.kernels.groups
            if group.face in ("loads", "equation") and group.meta["mass"]
            for s, _ in group.instances
        ]
        if found:
            return ", ".join(f"{s.label} ({_place(s)})" for s in found[:3]) + ": "
    where = int(system.report[base.WHERE])
    if where >= 2 * system.n:
        states = system.model.deck.of("DIFF")[where - 2 * system.n :]
        return "".join(f"Most critical: {s.label} ({_place(s)}). " for s in states[:1])
    where %= system.n
    for b, body in enumerate(system.model.bodies):
        i = system.starts[b]
        if i <= where < i + body.width:
            found = f"{body.statement.label} ({_place(body.statement)})"
            return f"Most critical: {found}, {COORDINATES[where - i]}. "
    return ""


def _place(statement: Any) -> str:
    """File, line and column of a statement in the deck."""
    return str(statement.span)
