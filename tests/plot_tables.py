"""Results that plots are made of."""

from __future__ import annotations

import numpy as np

from adamslite.results.results import Results

SPRING = """\
A mass on a spring
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=100, LENGTH=0.5
REQUEST/1, F2=DM(2,1)\\F3=2*DM(2,1)
SIMULATE/DYNAMIC, END=1, STEPS=20
END
"""
TIME = np.linspace(0.0, 2.0, 41)
UNITS = {"units": "NEWTON KILOGRAM MILLIMETER SECOND", "deck": "a test"}


def table(**columns: np.ndarray | float) -> Results:
    """Results with these columns; __ in a name is a slash, _ a dot."""
    names = tuple(name.replace("__", "/").replace("_", ".") for name in columns)
    values = np.column_stack([np.broadcast_to(v, TIME.shape) for v in columns.values()])
    return Results(time=TIME, names=names, values=values, meta=UNITS)


BODY = table(
    PART__2_x=np.sin(TIME),
    PART__2_y=0.0,
    PART__2_vx=np.cos(TIME),
    PART__2_psi=TIME,
    JOINT__3_fx=5.0,
)
