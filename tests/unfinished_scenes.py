"""Decks of runs that are killed and resumed: every method, and what it meets on its way."""

from __future__ import annotations

from pathlib import Path

PENDULUM = """\
two bars that swing, one on the other
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, QG=1,0,0, MASS=1, CM=2, IP=0.1,0.1,0.1
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
PART/3, QG=2,0,0, MASS=1, CM=4, IP=0.1,0.1,0.1
MARKER/4, PART=3
MARKER/5, PART=3, QP=-1,0,0
MARKER/6, PART=2
JOINT/2, REVOLUTE, I=5, J=6
REQUEST/1, DISPLACEMENT, I=4, J=1
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
#: A ball in a box, on walls with damping, driven by a force that jumps with time.
BOX = """\
a ball between walls
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, QG=0.3,0,0, VX=2, VY=1.5, VZ=1, CM=3
MARKER/3, POINT_MASS=2
VFORCE/1, I=3, JFLOAT=4, RM=1
, FX=BISTOP(DX(3,1), VX(3,1), -1, 1, 1E5, 1.5, 10, 1E-3) + 3*SIN(7*TIME)\\
, FY=STEP(TIME, 1, 0, 2, 1)-4*DY(3,1)-IF(DY(3,1): -1, 0, 1)\\
, FZ=-DZ(3,1)**3
MARKER/4, PART=1, FLOATING
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
#: Point masses on springs, free of all joints.
CHAIN = """\
masses in a row
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
{masses}
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
MASS = """\
POINT_MASS/{n}, MASS=0.1, QG={x},0,0, CM={n}
MARKER/{n}, POINT_MASS={n}
SPRINGDAMPER/{n}, TRANSLATION, I={n}, J={before}, K=1000, C=0.05, LENGTH=0.1"""


def pendulum(end: float, steps: int) -> str:
    return PENDULUM.format(end=end, steps=steps)


def box(end: float, steps: int) -> str:
    return BOX.format(end=end, steps=steps)


def chain(end: float, steps: int) -> str:
    masses = (MASS.format(n=n, before=n - 1, x=0.1 * n) for n in range(2, 12))
    return CHAIN.format(masses="\n".join(masses), end=end, steps=steps)


def walled(end: float, steps: int) -> str:
    """The masses in a row, whose last one meets a wall."""
    wall = "SFORCE/1, TRANSLATION, I=11, J=1, FUNCTION=-1E4*MAX(0, DM(11,1)-1.5)\n"
    return chain(end, steps).replace("SIMULATE", f"{wall}SIMULATE")


def delayed(end: float, steps: int) -> str:
    return f"""\
a state that follows its past
PART/1, GROUND
VARIABLE/1, FUNCTION=DIF(1)
DIFF/1, IC=1, FUNCTION=-1.2*DELAY(VARVAL(1), 1, 1)
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""


def spring(end: float, steps: int) -> str:
    return f"""\
a mass on a spring
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, QG=1,0,0, CM=2
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATION, I=2, J=1, K=1, LENGTH=0.5
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""


def sensed(end: float, steps: int) -> str:
    """The swing, whose SENSOR ends a run, and begins another, whenever a bar passes the line."""
    sensor = "SENSOR/1, FUNCTION=DY(4,1), VALUE=0, ERROR=1E-6, GE, PRINT\n"
    return pendulum(end, steps).replace("SIMULATE", f"{sensor}SIMULATE")


def rests(end: float, steps: int) -> str:
    """The swing from rest, in two analyses."""
    more = f"SIMULATE/DYNAMIC, END={end / 2}, STEPS={steps // 2}\nSIMULATE"
    return pendulum(end, steps).replace("QG=2,0,0", "QG=2,0,0, VY=1").replace("SIMULATE", more)


def between_equilibria(end: float, steps: int) -> str:
    """The swing, which hangs at rest before and after it has moved, and moves once more."""
    dynamic = f"SIMULATE/DYNAMIC, END={{end}}, STEPS={steps // 2}\n"
    first, last = dynamic.format(end=end / 2), dynamic.format(end=end)
    push = "SFORCE/1, TRANSLATION, I=4, J=1, FUNCTION=3*SIN(TIME)\n"
    equilibrium = "SIMULATE/STATICS\n"
    text, _ = pendulum(end, steps).replace("QG=2,0,0", "QG=1,-1,0").split("SIMULATE")
    text = text.replace("QG=1,0,0", "QG=0.2,-0.98,0").replace("QG=1,-1,0", "QG=0.5,-1.9,0")
    return f"{text}{push}{equilibrium}{first}{equilibrium}{last}END\n"


def assembled(end: float, steps: int) -> str:
    """The swing, drawn with its joints open."""
    return pendulum(end, steps).replace("QG=2,0,0", "QG=2.1,0.2,0").replace("QG=1,0,0", "QG=1,.1,0")


def written(folder: Path, text: str) -> Path:
    deck = folder / "deck.adm"
    deck.write_text(text)
    return deck


#: A deck that runs for about a second, and flags, by a word.
CASES = {
    "GSTIFF SI2": (pendulum(1000, 6000), "--integrator", "GSTIFF", "--error", "1e-6"),
    "GSTIFF I3": (chain(300, 20000), "--integrator", "GSTIFF", "--formulation", "I3"),
    "CONSTANT_BDF": (pendulum(1000, 8000), "--integrator", "CONSTANT_BDF", "--hmax", "0.004"),
    "HHT": (pendulum(700, 4000), "--integrator", "HHT", "--error", "1e-4"),
    "NEWMARK": (pendulum(1500, 8000), "--integrator", "NEWMARK", "--error", "1e-4"),
    "RADAU": (pendulum(250, 1500), "--integrator", "RADAU", "--error", "1e-6"),
    "RKF45": (pendulum(350, 2000), "--integrator", "RKF45", "--error", "1e-8"),
    "VERLET": (chain(500, 10000), "--integrator", "VERLET"),
    "VERLET between outputs": (chain(12000, 3), "--integrator", "VERLET"),
    "VERLET at a wall": (walled(6000, 3), "--integrator", "VERLET"),
    "equal steps of VERLET": (
        chain(1200, 2).replace("SIMULATE", "INTEGRATOR/VERLET, HINIT=4E-4\nSIMULATE"),
    ),
    "an audit of VERLET": (chain(800, 5), "--integrator", "VERLET", "--audit"),
    "by component": (chain(1000, 20000), "--integrator", "ABAM", "--error", "1e-6"),
    "contacts by GSTIFF": (box(4000, 20000), "--integrator", "GSTIFF", "--error", "1e-5"),
    "contacts by RADAU": (box(4000, 20000), "--integrator", "RADAU", "--error", "1e-5"),
    "contacts by RKF45": (box(4000, 20000), "--integrator", "RKF45", "--error", "1e-6"),
    "contacts by HHT": (box(4000, 20000), "--integrator", "HHT", "--error", "1e-5"),
    "contacts by AUTO": (box(4000, 20000), "--integrator", "AUTO", "--error", "1e-5"),
    "the past": (delayed(60, 8000), "--integrator", "GSTIFF", "--error", "1e-6"),
    "two analyses": (rests(900, 5000), "--integrator", "GSTIFF", "--error", "1e-6"),
    "sensors": (sensed(300, 6000), "--integrator", "GSTIFF", "--error", "1e-6"),
    "equilibria between": (between_equilibria(1500, 8000), "--error", "1e-6"),
    "joints that are drawn open": (assembled(700, 4000), "--error", "1e-6"),
    "confirmed": (spring(2000, 20000), "--error", "1e-6", "--confirm"),
    "NetCDF": (pendulum(400, 8000), "--integrator", "RKF45"),
    "some columns": (pendulum(1000, 20000), "--outputs", "REQUEST/*", "--integrator", "HHT"),
    "an audit": (pendulum(500, 8000), "--integrator", "GSTIFF", "--audit"),
    "rows within steps": (box(500, 150000), "--integrator", "GSTIFF", "--hmax", "100"),
    "rows within steps of HHT": (box(500, 150000), "--integrator", "HHT", "--hmax", "100"),
    "rows within steps of RKF45": (box(500, 150000), "--integrator", "RKF45", "--hmax", "100"),
    "rows within steps of RADAU": (
        box(500, 150000).replace(
            "SIMULATE", "INTEGRATOR/RADAU, HMAX=100, INTERPOLATE=ON\nSIMULATE"
        ),
    ),
    "rows within steps of joints": (pendulum(200, 150000), "--integrator", "HHT", "--hmax", "9"),
}
#: Formats other than CSV.
SUFFIXES = {"NetCDF": ".nc"}
