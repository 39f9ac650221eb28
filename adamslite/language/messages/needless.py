"""Messages about what a scene does not need."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE
from adamslite.language.messages.entry import Message

TWO = """title
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
MARKER/3, PART=2, QP=1,0,0
PART/4, MASS=1, CM=4, IP=1,1,1, QG=1,0,0
MARKER/4, PART=4
"""
RUN = "\nSIMULATE/DYNAMICS, END=1, STEPS=10"

STIFF = (
    "{joint} in its place needs no steps for these; lost is what it gives way: up to "
    "{deflection}, ten times that under the loads known before the run"
)

NEEDLESS: dict[str, Message] = {
    "one-body": Message(
        "{listed} never move against each other",
        "as one PART, with the mass, the mass centre and the inertia of all, they have {fewer} "
        "unknowns less, and no motion changes; what {joints} hold is then inside that part and no "
        "longer written",
        (
            TWO + "MARKER/5, PART=4, QP=0,0,1\nMARKER/6, PART=2, QP=1,0,1\nMARKER/7, PART=4, "
            "QP=0,1,0\nMARKER/8, PART=2, QP=1,1,0\nJOINT/1, SPHERICAL, I=4, J=3\nJOINT/2, "
            "SPHERICAL, I=5, J=6\nJOINT/3, SPHERICAL, I=7, J=8" + RUN,
            TWO + "JOINT/1, FIXED, I=4, J=3\nDIFF/1, IC=0, FUNCTION=JOINT(1,0,2,0)" + RUN,
        ),
        severity=NOTE,
    ),
    "planar-motion": Message(
        "the joints let all parts move in the {plane} plane alone",
        "{needless} of {unknowns} unknowns are not needed, {lost}",
        (
            TWO + "JOINT/1, REVOLUTE, I=2, J=1\nJOINT/2, REVOLUTE, I=4, J=3\nMARKER/5, PART=1\n"
            "REQUEST/1, F1=AZ(4,5)" + RUN,
        ),
        severity=NOTE,
    ),
    "light-link": Message(
        "{label} between two joints has at most {share} of the inertia of any motion",
        "GCON/..., FUNCTION=DM({i},{j})-{length} does the same with one equation instead of six "
        "unknowns and six equations; lost are that share, and its weight ({weight} of all)",
        (
            TWO.replace("MASS=1, CM=4, IP=1,1,1", "MASS=1E-5, CM=4, IP=1E-6,1E-6,1E-6")
            + "MARKER/5, PART=4, QP=1,0,0\nPART/6, MASS=1, CM=6, IP=1,1,1, QG=2,0,0\n"
            "MARKER/6, PART=6\nJOINT/1, SPHERICAL, I=4, J=3\nJOINT/2, SPHERICAL, I=5, J=6" + RUN,
        ),
        severity=NOTE,
    ),
    "stiff-bushing": Message(
        "{label} is nearly a joint: {frequency} Hz, {count} periods within the run",
        STIFF,
        (
            "title\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nPART/2, MASS=1, CM=2, QG=1,0,0, "
            "IP=1,1,1\nMARKER/2, PART=2\nMARKER/3, PART=2, "
            "QP=1,0,0\nMARKER/4, PART=1, QP=2,0,0\nBUSHING/1, I=3, J=4, K=1E9,1E9,1E9, "
            "KT=1E9,1E9,1E9" + RUN,
        ),
        severity=NOTE,
    ),
    "stiff-spring": Message(
        "{label} is nearly a rod: {frequency} Hz, {count} periods within the run",
        STIFF,
        (
            "title\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/4, PART=1, "
            "QP=1,1,0\nPART/2, MASS=1, CM=2, QG=1,0,0, IP=1,1,1\nMARKER/2, PART=2\nMARKER/3, "
            "PART=2, QP=-1,0,0\nJOINT/1, SPHERICAL, I=3, J=1\nSPRINGDAMPER/1, I=2, J=4, K=1E9, "
            "LENGTH=1" + RUN,
        ),
        severity=NOTE,
    ),
    "out-of-reach": Message(
        "{what} is never reached: the joints keep its sides at least {gap} apart",
        "nothing changes without it",
        (
            "title\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=2, "
            "QG=1,0,0, IP=1,1,1\nMARKER/2, PART=2\nMARKER/3, PART=2, QP=-1,0,0\nJOINT/1, "
            "SPHERICAL, I=3, J=1\nSFORCE/1, ACTIONONLY, I=2, J=1, FUNCTION=IMPACT(DX(2,1),"
            "VX(2,1),-1.5,1E5,1.5,10,0.01)" + RUN,
        ),
        severity=NOTE,
    ),
}  # fmt: skip
