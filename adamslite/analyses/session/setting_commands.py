"""What commands change: settings of analyses, or the model."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, TypeVar

from adamslite.analyses.dynamics.dynamic import Settings
from adamslite.analyses.statics.static import StaticSettings
from adamslite.deck.redefinition import Redefinition

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.elements.equilibrium import Equilibrium
    from adamslite.elements.integrator import Integrator

# What is settled before a run: the deck, the end of its commands, settings without effect.
SETTLED = ("FILE", "END", "KINEMATICS")
S = TypeVar("S", Settings, StaticSettings)


def updated(settings: S, command: Integrator | Equilibrium) -> S:
    """Settings with what the command gives."""
    given = {
        each.name: getattr(command, each.name)
        for each in fields(settings)
        if command.given(each.name) and getattr(command, each.name) is not None
    }
    return replace(settings, **given)


def changes_the_model(command: Command, deck: Deck) -> bool:
    """Whether a command that is not an analysis changes the model or its elements."""
    if isinstance(command, Redefinition):
        # Shapes are only drawn where nothing touches.
        touches = command.keyword == "GRAPHICS" and bool(deck.of("CONTACT"))
        return bool(command.changes) and (touches or not command.of.inert)
    return not command.inert and command.keyword not in SETTLED
