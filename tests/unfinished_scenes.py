"""Decks of runs that are killed and resumed: every method, and what it meets on its way."""

from __future__ import annotations

from pathlib import Path

from adamslite.resources import find

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


#: A block on a slide with dry friction, which sticks and slips.
SLIDE = """\
a block that is pulled to and fro, and sticks at both ends
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
PART/2, MASS=2, CM=2, IP=0.01,0.01,0.01
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2
SFORCE/1, TRANSLATION, I=2, J=1, ACTIONONLY, FUNCTION=9*SIN(TIME)+COS(3*TIME)
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
#: Shapes that touch: forces of CONTACT, with events.
BALL = """\
a ball on a floor that goes up and down
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
GRAPHICS/1, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1
PART/2, MASS=1, CM=2, IP=0.004,0.004,0.004, QG=0,0,0.3
MARKER/2, PART=2
GRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2
VFORCE/1, I=2, JFLOAT=3, RM=1, FX=-4*DX(2,1)\\FY=SIN(TIME)-4*DY(2,1)\\FZ=4*SIN(2*TIME)
MARKER/3, PART=1, FLOATING
CONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=1E5, EXPONENT=2.2, DAMPING=100, DMAX=1E-3
, COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2
, STICTION_TRANSITION_VELOCITY=0.01, FRICTION_TRANSITION_VELOCITY=0.1
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
#: Every kind of REQUEST, curves from statements and from a file, states, a transfer function.
MEASURED = """\
the swing, driven by tables, with all kinds of results
{swing}
SPLINE/1, X=0,1,2,3,5,6, Y=0,1,-1,2,-2,0
SPLINE/2, FILE=road.csv, BLOCK=left
VFORCE/1, I=4, JFLOAT=9, RM=1, FX=AKISPL(MOD(TIME,6),0,1)\\FY=CUBSPL(MOD(TIME,4),0,2)\\FZ=0
MARKER/9, PART=1, FLOATING
VARIABLE/1, FUNCTION=DX(4,1)
ARRAY/1, U, SIZE=1, VARIABLES=1
ARRAY/2, X
ARRAY/3, Y
TFSISO/1, U=1, X=2, Y=3, NUMERATOR=1, 2, DENOMINATOR=1, 0.2
DIFF/1, IC=1, FUNCTION=ARYVAL(3,1)-DIF(1)
REQUEST/2, VELOCITY, I=4, J=1, RM=2
REQUEST/3, ACCELERATION, I=4, J=1
REQUEST/4, FORCE, I=3, J=1
REQUEST/5, F1=DIF(1)\\F2=AZ(5,6)\\F8=SFORCE(1,0,2,1)
REQUEST/6, VARIABLES=1
SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=-0.1*WZ(3,1)
MREQUEST/1, DISPLACEMENT, PARTS=ALL
OUTPUT/REQSAVE
RESULTS/XRF
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""
ROAD = "time,left,right\n0,0,1\n1,1,0\n2,-0.5,0\n3,0.3,1\n4,0,0\n"
#: What a deck does that a command file leads through analyses of all kinds.
COMMANDS = """\
deck.adm

SIMULATE/STATICS
SIMULATE/DYNAMIC, END=250, STEPS=2000
DEACTIVATE/SFORCE, ID=1
SIMULATE/DYNAMIC, END=500, STEPS=2000
SAVE/FILE=halfway
ACTIVATE/SFORCE, ID=1
SFORCE/1, FUNCTION=2*COS(TIME)
INTEGRATOR/HHT, ERROR=1E-5
SIMULATE/DYNAMIC, END=650, STEPS=2000
LINEAR/EIGENSOL
RELOAD/FILE=halfway
INTEGRATOR/RADAU, ERROR=1E-6
SIMULATE/DYNAMIC, END=600, STEPS=1000
STOP
"""


def slide(end: float, steps: int) -> str:
    return SLIDE.format(end=end, steps=steps)


def ball(end: float, steps: int) -> str:
    return BALL.format(end=end, steps=steps)


def measured(end: float, steps: int) -> str:
    first, *lines = pendulum(1, 1).partition("SIMULATE")[0].splitlines()
    return MEASURED.format(swing="\n".join(lines), end=end, steps=steps)


def commanded() -> str:
    """The swing that :data:`COMMANDS` are for, pushed by a force."""
    return between_equilibria(1, 2).partition("SIMULATE")[0] + "END\n"


def lowered(steps: int) -> str:
    """The chain, which moves for a while, and then its equilibria, pushed to and fro at its end."""
    push = "VFORCE/1, I=11, JFLOAT=99, RM=1, FX=0\\FY=SIN(TIME)\\FZ=COS(TIME)\n"
    first = f"{push}MARKER/99, PART=1, FLOATING\nSIMULATE/DYNAMIC, END=1, STEPS=20\n"
    return chain(60, steps).replace("SIMULATE/DYNAMIC", f"{first}SIMULATE/STATICS")


def cranked(end: float, steps: int) -> str:
    """The swing, both of whose joints follow time, and which then goes on by itself."""
    driven = "MOTION/{n}, JOINT={n}, ROTATION, FUNCTION={n}*SIN(TIME)\n"
    motions = driven.format(n=1) + driven.format(n=2)
    return pendulum(end, steps).replace("SIMULATE/DYNAMIC", f"{motions}SIMULATE/KINEMATIC")


def drawn_by(name: str, end: float, steps: int) -> str:
    """A deck that `adamslite cable` has written, for longer."""
    text = (find("decks") / "cables" / name).read_text()
    return f"{text.rpartition('SIMULATE')[0]}SIMULATE/DYNAMIC, END={end}, STEPS={steps}\nEND\n"


def routine(end: float, steps: int) -> str:
    """The swing with a VARIABLE whose routine the command line replaces by a number."""
    pushed = (
        "VARIABLE/7, FUNCTION=USER(3, 4.5)\n"
        "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=VARVAL(7)*SIN(TIME)\n"
    )
    return pendulum(end, steps).replace("SIMULATE", f"{pushed}SIMULATE")


def written(folder: Path, text: str) -> Path:
    deck = folder / "deck.adm"
    deck.write_text(text)
    return deck


def prepared(folder: Path, case: str) -> Path:
    """The deck of a case in a folder, with the files that it reads."""
    for name, text in FILES.get(case, {}).items():
        (folder / name).write_text(text)
    return written(folder, CASES[case][0])


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
    "one equilibrium after the other": (lowered(4000),),
    "motions that decide everything": (cranked(60, 3000),),
    "motions between output times": (cranked(3000, 300),),
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
    "friction by GSTIFF": (slide(600, 3000), "--integrator", "GSTIFF", "--error", "1e-5"),
    "friction by HHT": (slide(1500, 8000), "--integrator", "HHT", "--error", "1e-5"),
    "CONTACT by GSTIFF": (ball(1000, 20000), "--integrator", "GSTIFF", "--error", "1e-5"),
    "CONTACT by RADAU": (ball(1000, 20000), "--integrator", "RADAU", "--error", "1e-5"),
    "CONTACT by AUTO": (ball(1000, 20000), "--integrator", "AUTO", "--error", "1e-5"),
    "tables, states and all requests": (measured(150, 1500), "--error", "1e-5"),
    "a command file": (commanded(), "--error", "1e-6"),
    "a cable over wheels": (drawn_by("described/crane.adm", 60, 3000),),
    "a winch": (drawn_by("winches/hoist.adm", 60, 3000),),
    "a routine that is a number": (routine(1000, 6000), "--user", "VARIABLE/7=0.5"),
    "other numbers": (pendulum(1000, 6000), "--set", "PART/2.MASS=2.5", "--no-reduction", "plane"),
    "written as res": (measured(150, 1000), "--error", "1e-5"),
    "written as req": (measured(150, 1000), "--error", "1e-5"),
    "written as mat": (measured(150, 1000), "--error", "1e-5"),
    "written as parquet": (measured(150, 1000), "--error", "1e-5"),
    "a page": (pendulum(700, 3000), "--page"),
}
#: Files beside the deck.
FILES: dict[str, dict[str, str]] = {
    "tables, states and all requests": {"road.csv": ROAD},
    "a command file": {"deck.acf": COMMANDS},
    **{f"written as {name}": {"road.csv": ROAD} for name in ("res", "req", "mat", "parquet")},
}
#: Formats other than CSV.
SUFFIXES = {
    "NetCDF": ".nc",
    **{f"written as {name}": f".{name}" for name in ("res", "req", "mat", "parquet")},
}
