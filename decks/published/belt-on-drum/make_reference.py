"""Write a belt of lumps held over a drum that turns under it, and what Euler's formula becomes.

The lumps stand every d = pi/n on the rim, each in a kink of d; where all of them slip,

    T2/T1 = ((1 + mu tan(d/2))/(1 - mu tan(d/2)))^n,   exp(mu pi) as n grows
    torque = (T2 - T1) r,   r the radius of the drum
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

RADIUS, MU, SLACK, N = 0.5, 0.2, 50e3, 45
EA, RHO, NORMAL, REST = 2e7, 2.0, 5e8, 1e4
STEP = np.pi / N
RATIO = ((1 + MU * np.tan(STEP / 2)) / (1 - MU * np.tan(STEP / 2))) ** N
END = """
VARIABLE/tight, FUNCTION=SFORCE(100,0,1)
VARIABLE/torque, FUNCTION=-MOTION(1,0,8)

INTEGRATOR/HHT, ERROR=1E-5
SIMULATE/DYNAMIC, END=1, STEPS=100
END
"""


def lump(i: int, h: float, angle: float) -> str:
    """A lump on the rim: its normal force, and friction mu of it where the rim slides past."""
    place = RADIUS * np.cos(angle), RADIUS * np.sin(angle)
    slip = f"(WZ(2,1)*DM({i},1)-(DX({i},1)*VY({i},1)-DY({i},1)*VX({i},1))/DM({i},1))"
    return catenary.node(i, RHO * h, place) + (
        f"VARIABLE/N{i}, FUNCTION={NORMAL:g}*({RADIUS:g}-DM({i},1))-{REST:g}*VR({i},1)\n"
        f"VARIABLE/F{i}, FUNCTION={MU:g}*VARVAL(N{i})*STEP({slip},-0.01,-1,0.01,1)\n"
        f"MARKER/{i + 300}, PART=2, FLOATING\n"
        f"VFORCE/{i}, I={i}, JFLOAT={i + 300}, RM=1"
        f", FX=(VARVAL(N{i})*DX({i},1)-VARVAL(F{i})*DY({i},1))/DM({i},1)\\\n"
        f", FY=(VARVAL(N{i})*DY({i},1)+VARVAL(F{i})*DX({i},1))/DM({i},1)\\ FZ=0\n"
    )


def deck() -> str:
    """The belt is anchored on the left, where the rim runs up, and pulled down on the right."""
    h = 2 * RADIUS * np.sin(STEP / 2)
    belt = catenary.Cable(0.0, RHO, EA, h)
    side = RADIUS * np.cos(STEP / 2)
    text = catenary.head(
        "A belt over a drum, 180 degrees", f"{N} lumps slip on the rim.", gravity=0
    )
    text += f"MARKER/3, PART=1, QP={-side:.12g},-1,0\n"
    text += "\nPART/2, MASS=100, CM=2, IP=10,10,10\nMARKER/2, PART=2\nJOINT/1, REVOLUTE, I=2, J=1\n"
    text += "MOTION/1, JOINT=1, ROTATION, FUNCTION=-10*TIME\n"
    length = 1 + RADIUS * np.sin(STEP / 2)
    for k in range(N):
        i = 101 + k
        text += lump(i, h, np.pi - (k + 0.5) * STEP)
        free = f"{(h if k else length) / (1 + SLACK / EA):.12g}"
        damped = f"-{2e3 if k else 200:.6g}*VR({i},{i - 1 if k else 3})"
        pull = catenary.section(i - 1, i - 1 if k else 3, i, belt, free).rstrip()
        text += f"{pull}{damped}\n"
    last = 100 + N
    text += catenary.node(400, RHO * 0.5, (side, -1))
    text += (
        catenary.section(last, last, 400, belt, f"{length / (1 + SLACK / EA):.12g}").rstrip()
        + f"-200*VR({last},400)\n"
    )
    text += f"VFORCE/400, I=400, J_PART=1, RM=1, FX=0\\ FY=-{SLACK:g}\\ FZ=0\n"
    return text + END


(HERE / "belt-on-drum.adm").write_text(deck())
LINES = [
    "# Tension of the tight side and torque of the drum: see README.md",
    "# written by make_reference.py",
    f"# measure: mean VARIABLE/tight from 0.7 = {SLACK * RATIO:.3f} tol rel 1e-3",
    f"# measure: mean VARIABLE/torque from 0.7 = {SLACK * (RATIO - 1) * RADIUS:.3f} tol rel 1e-3",
]
(HERE / "belt-on-drum.reference.csv").write_text("\n".join(LINES) + "\n")
