"""Settings of analyses after a command that changes some of them."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TypeVar

from adamslite.analyses.dynamic import Settings
from adamslite.analyses.static import StaticSettings
from adamslite.elements.equilibrium import Equilibrium
from adamslite.elements.integrator import Integrator

S = TypeVar("S", Settings, StaticSettings)


def updated(settings: S, command: Integrator | Equilibrium) -> S:
    """Settings with what the command gives."""
    given = {
        each.name: getattr(command, each.name)
        for each in fields(settings)
        if command.given(each.name) and getattr(command, each.name) is not None
    }
    return replace(settings, **given)
