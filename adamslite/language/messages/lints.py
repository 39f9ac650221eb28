"""Messages about what is legal and probably not meant."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE, WARNING
from adamslite.language.messages.entry import Message

LINTS: dict[str, Message] = {
    "starts-apart": Message(
        "MARKER/{i} and MARKER/{j} of {label} start {how}",
        "a run first moves the bodies until the joint closes; where that is not wanted, correct "
        "the places of the markers or of their bodies",
        ("MARKER/4, PART=1, QP=0.1,0,0\nJOINT/1, SPHERICAL, I=2, J=4",
         "MARKER/4, PART=1, QP=0,0.1,0, REULER=10D,0,0\nJOINT/1, FIXED, I=2, J=4",
         "MARKER/4, PART=1, REULER=0,5D,0\nJOINT/1, REVOLUTE, I=2, J=4",
         "MARKER/4, PART=1, QP=0,0,0.1\nJPRIM/1, INPLANE, I=2, J=4"),
        severity=WARNING,
    ),
    "stays-open": Message(
        "from the posture of the deck {row} of {label} cannot be closed, by {size}{also}",
        "a run ends before its first step: no start near it satisfies all constraints",
        ("MARKER/4, PART=1\nJPRIM/1, INPLANE, I=2, J=4\n"
         "GCON/1, FUNCTION=DZ(2)-0.1",),
        severity=WARNING,
    ),
    "angle-in-radians": Message(
        "{text} in REULER of {label} is in radians: {turns} degrees",
        "degrees are written with D: 90D; an angle above a full turn is rarely meant",
        ("MARKER/4, PART=1, REULER=90,0,0\nREQUEST/1, F1=DX(4)",
         "PART/4, MASS=1, CM=4, IP=1,1,1, REULER=0,45.0,0\nMARKER/4, PART=4",
         "POINT_MASS/4, MASS=1, REULER=0,0,-9E1"),
        severity=WARNING,
    ),
    "gravity-units": Message(
        "gravity is {size} {unit}, which is that of the earth in other units; here it is {here}",
        "UNITS and ACCGRAV have to fit each other",
        ("UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\nACCGRAV/JGRAV=-9.81",
         "UNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-9806.65", "UNITS/SYSTEM=CGS\nACCGRAV/JGRAV=9.81",
         "UNITS/SYSTEM=IPS\nACCGRAV/IGRAV=-32.2", "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-386.09"),
        severity=WARNING,
    ),
    "unused": Message(
        "used by no statement: {listed}",
        "leave out what is not needed, or look for a reference that was meant",
        ("MARKER/4, PART=1, QP=1,0,0", "VARIABLE/stiffness, FUNCTION=2*1E5",
         "MARKER/4, PART=2, REULER=0,90D,0\nVARIABLE/1, FUNCTION=3"),
        severity=NOTE,
    ),
    "kink": Message(
        "FUNCTION of {label} has a corner{when}, by {word}, where velocities jump",
        "STEP, STEP5 and HAVSIN join values smoothly",
        ("MOTION/1, I=2, J=1, X, FUNCTION=MAX(0,TIME-1)",
         "MOTION/1, I=2, J=1, X, FUNCTION=IF(TIME-1: 0, 0, 0.1*(TIME-1))",
         "MOTION/1, I=2, J=1, X, VELOCITY, FUNCTION=IF(TIME-1: 0, 0, 1)",
         "VARIABLE/1, FUNCTION=ABS(TIME-1)-1\nMOTION/1, I=2, J=1, X, FUNCTION=VARVAL(1)",
         "GCON/1, FUNCTION=DX(2)-MIN(DY(2),1)",
         "MOTION/1, I=2, J=1, X, FUNCTION=ABS(TIME-1)-1\nSIMULATE/DYNAMICS, END=2, STEPS=1"),
        severity=WARNING,
    ),
    "dimensions": Message(
        "{word} of {label} combines {first} and {second} which have different dimensions",
        "a factor is missing; one that is 1 in these units is written 1*...",
        ("SFORCE/1, I=2, J=1, ROTATIONAL, FUNCTION=-DX(2,1)-VX(2,1)",
         "VARIABLE/1, FUNCTION=TIME+DM(2,1)", "VARIABLE/1, FUNCTION=MAX(AZ(2,1),WZ(2,1))",
         "VARIABLE/1, FUNCTION=2+DX(2,1)**2-DY(2,1)",
         "VARIABLE/1, FUNCTION=STEP(TIME,DX(2),0,1,1)",
         "VARIABLE/1, FUNCTION=IMPACT(DX(2,1),DX(2,1),1,1E5,1.5,10,0.1)",
         "VARIABLE/1, FUNCTION=DX(2)\nVARIABLE/2, FUNCTION=VARVAL(1)+VARVAL(d(1)/dt)"),
        severity=WARNING,
    ),
    "ends-coincide": Message(
        "MARKER/{i} and MARKER/{j} of {label} start in the same place: the force has no direction",
        "move one of them, or use ACTIONONLY, which acts along z of J, or a BUSHING",
        ("MARKER/4, PART=1\nSFORCE/1, I=2, J=4, FUNCTION=1",
         "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=1, LENGTH=1"),
        severity=WARNING,
    ),
    "massless": Message(
        "{label} has no mass, and its constraints let it move on its own",
        "its acceleration is not determined; give it a mass, or hold it by a further constraint",
        ("PART/4\nMARKER/4, PART=4\nJOINT/1, REVOLUTE, I=2, J=4",),
        severity=WARNING,
    ),
    "no-run": Message(
        "nothing ends a run: neither the deck nor a command file has a SIMULATE",
        "add SIMULATE/DYNAMICS, END=..., STEPS=..., or give `solve` --end and --steps",
        ("REQUEST/1, F1=TIME",),
        severity=NOTE,
    ),
}  # fmt: skip
