"""A small deck for every kind of constraint: two parts and a point mass in general position."""

from __future__ import annotations

BODIES = """constraints between skew bodies
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, QP=0.3,0.1,-0.2, REULER=20D,30D,40D
MARKER/2, PART=1, QP=-0.1,0.2,0.4
PART/2, MASS=1, CM=20, IP=0.1,0.2,0.15, QG=0.4,0.1,-0.1, REULER=10D,40D,30D
MARKER/20, PART=2, QP=0.1,0,0
MARKER/21, PART=2, QP=0.1,-0.2,0.3, REULER=5D,15D,-20D
MARKER/22, PART=2, QP=-0.3,0.1,0.1, REULER=50D,5D,20D
PART/3, MASS=2, CM=30, IP=0.3,0.2,0.25, QG=-0.4,0.3,0.1, REULER=0D,20D,60D
MARKER/30, PART=3
MARKER/31, PART=3, QP=0.2,0.2,-0.1, REULER=30D,10D,0D
MARKER/32, PART=3, QP=0.2,-0.1,0.2, REULER=0D,10D,-30D
POINT_MASS/4, MASS=1, CM=40, QG=0.5,0.6,0.2
MARKER/40, POINT_MASS=4
MARKER/41, POINT_MASS=4, QP=0.1,0,0, REULER=40D,30D,20D
"""

PAIR = "JOINT/1, CYLINDRICAL, I=21, J=1\nJOINT/2, CYLINDRICAL, I=31, J=2\n"
CURVED = "VARIABLE/w, FUNCTION=0.2*TIME**2\n"

JOINTS = {
    "REVOLUTE": 5, "TRANSLATIONAL": 5, "CYLINDRICAL": 4, "SPHERICAL": 3, "PLANAR": 3,
    "UNIVERSAL": 4, "HOOKE": 4, "CONVEL": 4, "SCREW": 1, "RACKPIN": 1, "FIXED": 6,
}  # fmt: skip
PRIMITIVES = {
    "ATPOINT": 3, "INLINE": 2, "INPLANE": 1, "ORIENTATION": 3, "PARALLEL_AXES": 2,
    "PERPENDICULAR": 1,
}  # fmt: skip
TO_GROUND = {k: JOINTS[k] for k in ("REVOLUTE", "CONVEL", "SCREW", "RACKPIN")}
SIZES = {"SCREW": ", PITCH=0.1", "RACKPIN": ", PD=0.2"}


def _joint(kind: str, ends: str = "I=21, J=31") -> str:
    return f"JOINT/1, {kind}, {ends}{SIZES.get(kind, '')}"


# name -> (rows, statements)
DECKS: dict[str, tuple[int, str]] = {
    **{f"JOINT {k}": (n, _joint(k)) for k, n in JOINTS.items()},
    **{f"JOINT {k} to ground": (n, _joint(k, "I=2, J=21")) for k, n in TO_GROUND.items()},
    **{f"JPRIM {k}": (n, f"JPRIM/1, {k}, I=21, J=31") for k, n in PRIMITIVES.items()},
    "JOINT SPHERICAL of a point": (3, _joint("SPHERICAL", "I=41, J=31")),
    "JPRIM ATPOINT of a point": (3, "JPRIM/1, ATPOINT, I=21, J=41"),
    "JPRIM INLINE of a point": (2, "JPRIM/1, INLINE, I=40, J=31"),
    "JPRIM INLINE on a point": (2, "JPRIM/1, INLINE, I=31, J=41"),
    "JPRIM INPLANE of a point": (1, "JPRIM/1, INPLANE, I=40, J=1"),
    "COUPLER of two": (9, PAIR + "COUPLER/1, JOINTS=1,2, SCALES=0.2, TYPE=T:R"),
    "COUPLER of three": (
        14,
        PAIR
        + "MARKER/33, PART=3, QP=1,0,0\nPART/5, MASS=1, CM=50, IP=1,1,1\nMARKER/50, PART=5\n"
        + "JOINT/3, REVOLUTE, I=33, J=50\n"
        + "COUPLER/1, JOINTS=1,2,3, SCALES=1,0.2,-0.5, TYPE=T:R:R",
    ),
    "GEAR": (
        9,
        PAIR.replace("J=2", "J=1") + "MARKER/3, PART=1, QP=0.5,0.6,0.7\nGEAR/1, JOINTS=1,2, CV=3",
    ),
    **{
        f"MOTION {level}": (
            6,
            CURVED
            + "".join(
                f"MOTION/{n}, I=21, J=31, {axis}, {level}, FUNCTION=0.1*SIN(TIME)+VARVAL(w)\n"
                for n, axis in enumerate(("X", "Y", "Z", "B1", "B2", "B3"), 1)
            ),
        )
        for level in ("DISPLACEMENT", "VELOCITY", "ACCELERATION")
    },
    **{
        f"MOTION of a joint {level}": (
            6,
            "JOINT/1, CYLINDRICAL, I=21, J=31\n"
            f"MOTION/1, JOINT=1, TRANSLATION, {level}, FUNCTION=0.1*SIN(TIME)\n"
            f"MOTION/2, JOINT=1, ROTATION, {level}, FUNCTION=0.1*SIN(TIME)",
        )
        for level in ("DISPLACEMENT", "VELOCITY", "ACCELERATION")
    },
    "MOTION of a point": (1, "MOTION/1, I=40, J=31, X, FUNCTION=0.1*TIME"),
    "PTCV": (
        5,
        "MATRIX/1, ROWS=5, COLUMNS=3, VALUES=0,0,0, 0.2,0.1,0, 0.4,0.3,0.2, 0.5,0.1,0.3, 0.7,0,0\n"
        "CURVE/1, OPEN, MATRIX=1, CURVE_POINTS\nPTCV/1, I=21, CURVE=1, RM=31",
    ),
    "PTCV closed": (
        5,
        "MATRIX/1, ROWS=5, COLUMNS=3, VALUES=1,0,0, 0,1,0.1, -1,0,0, 0,-1,0, 1,0,0\n"
        "CURVE/1, CLOSED, MATRIX=1, CURVE_POINTS\nPTCV/1, I=40, CURVE=1, RM=1",
    ),
    "CVCV": (
        8,
        "MATRIX/1, ROWS=5, COLUMNS=3, VALUES=0,0,0, 0.2,0.1,0, 0.4,0.3,0, 0.5,0.1,0, 0.7,0,0\n"
        "MATRIX/2, ROWS=5, COLUMNS=3, VALUES=1,0,0, 0,1,0, -1,0,0, 0,-1,0, 1,0,0\n"
        "CURVE/1, OPEN, MATRIX=1\nCURVE/2, CLOSED, MATRIX=2\n"
        "CVCV/1, ICURVE=1, JCURVE=2, IRM=21, JRM=31",
    ),
    "GCON": (1, "GCON/1, FUNCTION=DM(21,31)**2-DX(40,21,31)-1"),
    "GCON of a velocity": (1, "GCON/1, FUNCTION=VX(21,31,31)-WZ(21,1,21)"),
}


def deck(name: str) -> str:
    """The whole deck of an entry."""
    return BODIES + DECKS[name][1] + "\nEND\n"
