"""Decks for command files, and runs of both."""

from __future__ import annotations

from typing import Any

import adamslite
from adamslite.reading.read import read, read_commands
from adamslite.results.results import Results

FALL = """a mass that falls with 9.81 m/s2 from rest
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
REQUEST/1, F2=DY(2)
"""
PENDULUM = """a pendulum of length 1 that starts level
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=0.1,0.2,0.3, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
"""

#: A double pendulum with a motor that gets faster, a state, a friction and a counted angle.
DRIVEN = (
    PENDULUM
    + """MARKER/4, PART=2, QP=1,0,0
PART/5, MASS=1, CM=5, IP=0.1,0.1,0.1, QG=2,-1,0
MARKER/5, PART=5
MARKER/6, PART=5, QP=0,1,0
JOINT/2, REVOLUTE, I=6, J=4
DIFF/1, IC=1, FUNCTION=WZ(6,4)-DIF(1)
SFORCE/1, ROTATIONAL, I=6, J=4, FUNCTION=3*DIF(1)-0.1*AZ(6,4)
VARIABLE/1, FUNCTION=2*AZ(3,1)+DIF(1)
REQUEST/1, F1=VARVAL(1)\\F2=AZ(6,4)
"""
)
FIRST, SECOND = "SIM/DYN, END=0.5, STEPS=5", "SIM/DYN, END=1, STEPS=5"


def run(deck: str, commands: str, **options: Any) -> Results:
    scene = read(deck)
    return adamslite.simulate(scene, commands=read_commands(commands + "\n", scene), **options)
