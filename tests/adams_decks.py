"""Decks whose files of ADAMS are tested, and what ADAMS itself wrote of one of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

MACHINE = """\
everything that is written: ä & <b>
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, QP=0,0,0.2
! adams_view_name='arm "A"'
PART/2, MASS=2, CM=2, IP=0.1,0.2,0.3, QG=0.5,0,0.2, REULER=0.3,0.2,0.1
MARKER/2, PART=2, QP=0.1,0.2,0.3, REULER=0.1,0.7,0.2
MARKER/3, PART=2, QP=-0.5,0,0
MARKER/30, PART=1, QP=0.5,0,0.2
JOINT/1, SPHERICAL, I=32, J=33
MARKER/32, PART=2
MARKER/33, PART=1, QP=0.5,0,0.2
POINT_MASS/4, MASS=1, CM=4, QG=1,1,0
MARKER/4, POINT_MASS=4
SFORCE/1, TRANSLATION, I=4, J=1, FUNCTION=-20*DM(4,1)
SFORCE/2, ROTATION, I=2, J=1, FUNCTION=-WZ(2,1)
SFORCE/3, TRANSLATION, ACTIONONLY, I=2, J=3, FUNCTION=0.3*TIME
SPRINGDAMPER/7, TRANSLATIONAL, I=4, J=3, K=10, C=1, LENGTH=1
VARIABLE/9, FUNCTION=DM(4,1)
REQUEST/1, DISPLACEMENT, I=2, J=1, COMMENT=the arm
REQUEST/2, F2=TIME\\ F3=2*TIME, CNAMES="","zeit","doppelt", RESULTS_NAME=clock
REQUEST/3, F1=TIME\\ F6=TIME
SIMULATE/DYNAMIC, END=0.4, STEPS=4
END
"""
FREE = """\
a ball that spins freely about z of ground, off its origin
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
! adams_view_name='the ball'
PART/2, MASS=2, CM=2, IP=1,1,1, QG=1,2,3, REULER=0.3,0.8,-0.4, VX=3, WM=1, WZ=2
MARKER/2, PART=2, QP=0.5,-0.2,0.1, REULER=0.4,0.5,0.6
INTEGRATOR/GSTIFF, ERROR=1E-9
SIMULATE/DYNAMIC, END=1, STEPS=4
END
"""
OF_ADAMS = """\
<?xml version="1.0" encoding="UTF-8"?>
<Results xmlns="http://www.mscsoftware.com/:xrf10">
<Analysis name="A1" executionDate="2020-01-01 00:00:00" Solver="Adams 2017  Adams Solver (C++)">
<ModelInfo title="a falling part" creationDate="-unknown-" checksum="-unknown-" />
<Units angle="deg" length="mm" mass="kg" time="sec" />
<StepMap name="map_001">
<Entity name="time">
<Component name="TIME" unitsValue="sec" id="1" />
</Entity>
<Entity name="LOAD" entity="LOAD" entType="ADAMS_Variable" objectId="7">
<Component name="Q" id="56" />
</Entity>
<Entity name="stone_XFORM" entity="stone" entType="Part" objectId="2">
<Component name="X" unitsValue="mm" id="2" />
<Component name="Y" unitsValue="mm" id="3" />
<Component name="Z" unitsValue="mm" id="4" />
<Component name="PSI" unitsValue="deg" id="5" />
<Component name="THETA" unitsValue="deg" id="6" />
<Component name="PHI" unitsValue="deg" id="7" />
<Component name="VX" unitsValue="mm/sec" id="14" />
<Component name="VY" unitsValue="mm/sec" id="15" />
<Component name="VZ" unitsValue="mm/sec" id="16" />
<Component name="WX" unitsValue="deg/sec" id="17" />
<Component name="WY" unitsValue="deg/sec" id="18" />
<Component name="WZ" unitsValue="deg/sec" id="19" />
</Entity>
<Entity name="ctrl_poutput" entity="ctrl" entType="Plant_Output" objectId="1">
<Component name="OUT1" id="57" />
</Entity>
</StepMap>
<Data name="modelInput_001" id="1">
<Step type="input">
0
9 9 9 9 9 9
9 9 9 9 9 9
9 9 9 9 9 9 9
</Step>
</Data>
<Data name="initialConditions_001" id="2">
<Step type="initialConditions">
0
7 7 7 7 7 7
7 7 7 7 7 7 7 7
</Step>
<Step type="initialConditions">
0
{0}
</Step>
</Data>
<Data name="dynamic_001" id="3">
<Step type="dynamic">
0.25
{1}
</Step>
<Step type="dynamic">
0.5
{2}
</Step>
</Data>
<TerminationStatus runTermObject="" runStatus="Successful" />
</Analysis>
</Results>
"""
STONE = """\
a falling part
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, REULER=90D,0,0, WM=1, WZ=2
MARKER/2, PART=2, QP=0.3,0,0
VARIABLE/7, FUNCTION=2*TIME
INTEGRATOR/GSTIFF, ERROR=1E-9
SIMULATE/DYNAMIC, END=0.5, STEPS=2
END
"""


def falling(t: float) -> str:
    """What ADAMS gives of the stone in mm and degrees: its centre of mass is 300 mm from the origin
    along x of the part, which points at 90 degrees + w t; it falls, the origin circles it.
    """
    angle, arm = np.pi / 2 + 2 * t, 300.0
    x, y = -arm * np.cos(angle), arm - 5000 * t**2 - arm * np.sin(angle)
    vx, vy = arm * 2 * np.sin(angle), -10000 * t - arm * 2 * np.cos(angle)
    psi = (np.degrees(angle) + 180) % 360 - 180
    state = (x, y, 0, psi, 0, 0, vx, vy, 0, 0, 0, np.degrees(2.0), 2 * t, 1)
    return "\n".join(f"{each:.17g}" for each in state)


def stone_res(folder: Path) -> Path:
    path = folder / "adams.res"
    text = OF_ADAMS.replace("{0}", falling(0.0)).replace("{1}", falling(0.25))
    path.write_text(text.replace("{2}", falling(0.5)))
    return path


def block(title: str, *lines: str) -> str:
    return "\n".join([f"{title:40}{len(lines) + 1:8}", *lines, "!", ""])


def text_form(times: list[float]) -> str:
    """The older form: a part at (t, 0, 1) that is turned about z by 60 degrees, moving at 1."""
    turned = (np.cos(np.pi / 6), 0.0, 0.0, np.sin(np.pi / 6))
    text = block("FILE TYPE AND SOURCE", "ADAMS RESULTS FILE", "A.RE7")
    text += block("DATA SET TITLE", "a sledge", "")
    text += block("RIGID PARTS MAP", "       1YESYESNO ", f"{5:20}{5:8}{6:8}{6:8}")
    text += block("JOINTS MAP", "       0NO")
    for n, t in enumerate(times):
        place = "".join(f"{each:12.5E}" for each in (t, 0.0, -1.0, *turned))
        speed = "".join(f"{each:12.5E}" for each in (1.0, 0.0, 0.0, 0.0, 0.0, -2.0))
        head = f"{n + 1:8}DYNAMIC"
        text += block("ANALYSIS OUTPUT BLOCK", head, f"{t:12.5E}", "", "", place, speed)
    return text
