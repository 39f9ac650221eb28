"""ABAM, RKF45: an explicit Runge-Kutta formula of order 8, or for point masses of order 4."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.method import Equations, Method, Settings, register

if TYPE_CHECKING:  # methods are declared without numpy
    import numpy as np

NO_CORRECTOR = "-an explicit formula has no corrector"


def prepare(system: Equations, settings: Settings) -> None:
    """Coefficients, room for the numbers of the method, for the stages and for inverse inertias,
    factors of ERROR.
    """
    from adamslite.integrators.explicit.control import HISTORY_ROWS, LINE, SCALES, TABLES, Control
    from adamslite.integrators.explicit.dop853 import tableau

    scales, bodies = error_scales(system, settings.scale), len(system.model.bodies)
    inverse = 9 * bodies
    if system.by_component:
        row = LINE * -(-bodies // LINE)
        scales, inverse = by_component(scales, row), TABLES * row
    w = len(scales)
    system.tableau = tableau()
    system.make_room(control=Control.slots, history=HISTORY_ROWS * w + inverse, trial=w)
    system.history[SCALES * w : (SCALES + 1) * w] = scales


def by_component(values: np.ndarray, row: int) -> np.ndarray:
    """Numbers of bodies (2, bodies, 3) as those of each component (2, 3, row), ones behind."""
    import numpy as np

    found = np.ones((2, 3, row))
    table = values.reshape(2, -1, 3)
    found[:, :, : table.shape[1]] = table.transpose(0, 2, 1)
    return found.ravel()


def error_scales(system: Equations, scale: tuple[float, ...]) -> np.ndarray:
    """Factors of ERROR (2 n + ns,): SCALE for bodies, 1 for states and what is not given."""
    import numpy as np

    place, angle, _, speed, spin, _ = (*scale, *(6 - len(scale)) * (1.0,))
    factors = np.ones(2 * system.n + system.ns)
    for first, width in zip(system.starts, system.widths[: len(system.model.bodies)], strict=False):
        for start, shift, turn in ((first, place, angle), (system.n + first, speed, spin)):
            factors[start : start + 3] = shift
            factors[start + 3 : start + width] = turn
    return factors


register(
    Method(
        names=("ABAM", "RKF45"),
        what="the explicit Runge-Kutta pair of order 8(5,3) of Dormand and Prince with variable "
        "step, on accelerations that satisfy the constraints; for chains and nets of point masses, "
        "where that gets further, a formula of order 4 whose steps stay stable for longer",
        suited="scenes that are not stiff, to any ERROR",
        entry="adamslite.integrators.explicit.method.explicit",
        order=8,
        family="Runge-Kutta",
        explicit=True,
        pauses=True,
        by_component=True,
        in_blocks=True,
        prepare=prepare,
        arguments={
            "ERROR": "local error of q, u and states",
            "HMAX": "largest step",
            "HMIN": "as with GSTIFF",
            "HINIT": "first step, also after a jump",
            "KMAX": "-its order is 8",
            "MAXIT": NO_CORRECTOR,
            "PATTERN": NO_CORRECTOR,
            "INTERPOLATE": "OFF: equal steps onto every output time; unless given, ON",
            "ADAPTIVITY": NO_CORRECTOR,
            "CORRECTOR": NO_CORRECTOR,
            "SCALE": "factors of ERROR for displacements, angles, modal coordinates, their rates",
            "ALPHA": "-it belongs to HHT",
            "BETA": "-it belongs to NEWMARK",
            "GAMMA": "-it belongs to NEWMARK",
        },
    )
)
