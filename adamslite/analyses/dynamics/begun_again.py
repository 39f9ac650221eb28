"""The state with which a run began, so that it can begin again in another way."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from adamslite.equations.system import System

STATE = ("q", "u", "a", "z", "rd", "mu", "ra", "rz", "base", "W")


class Beginning:
    """A copy of the present state, of the memories of statements and of the time."""

    def __init__(self, system: System) -> None:
        self.system, self.time = system, float(system.settings.t)
        self.values = {name: getattr(system, name).copy() for name in STATE}
        self.memories = [(whose, v.copy()) for whose, v in system.instances.memories()]

    def return_to(self) -> None:
        """Put it back, out of the plane in which the run was."""
        for name, values in self.values.items():
            getattr(self.system, name)[:] = values
        self.system.settings.t = self.time
        self.system.instances.remember(self.memories)
        self.system.elimination.unfold()
