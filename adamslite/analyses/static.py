"""Static equilibrium of the model from its present state."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from math import pi

import numpy as np

from adamslite.equations.system import System
from adamslite.integrators import contract
from adamslite.integrators.contract import EQUILIBRIUM
from adamslite.integrators.equilibrium_control import Control
from adamslite.results.outcomes import Outcome


@dataclass(frozen=True)
class StaticSettings:
    """Settings of the EQUILIBRIUM statement with their defaults.

    ``alimit`` [rad] and ``tlimit`` [length] limit the increments of an iteration; ``error`` is the
    relative correction and ``imbalance`` [force] the residual at which it is done; ``stability``
    is added times the mass matrix to the stiffness.
    """

    alimit: float = 10.0 * pi / 180.0
    tlimit: float = 20.0
    error: float = 1e-4
    imbalance: float = 1e-4
    stability: float = 1e-5
    maxit: int = 25


def run_static(system: System, settings: StaticSettings) -> Outcome:
    """Move ``system`` to an equilibrium at its present time."""
    system.make_room(control=Control.slots)
    C = Control(system.control)
    C[:] = 0
    for name, value in asdict(settings).items():
        setattr(C, name, value)
    C.length = model_size(system)
    outcome = system.run(EQUILIBRIUM)
    return Outcome.DONE if outcome == contract.DONE else Outcome.NO_EQUILIBRIUM


def model_size(system: System) -> float:
    """Largest extent of the bodies' positions [length], at least the smallest positive number
    used.
    """
    centres = [system.q[system.starts[b] : system.starts[b] + 3] for b in range(len(system.mass))]
    if not centres:
        return 1.0
    reach = float(np.abs(np.array(centres)).max())
    return reach if reach > 0.0 else 1.0
