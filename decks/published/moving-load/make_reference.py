"""Write a taut string over which a force runs, and its deflection under the force.

rho y_tt = T y_xx + F delta(x - v t), at rest at t = 0 when the force enters at x = 0. Ahead of the
force the wave y = a (c t - x) runs, behind it the string is straight to its end, and the kink at
the force carries it, (T - rho v^2) [y_x] = -F:

    y(v t, t) = F v t/(T (1 + v/c)),  v < c,  until the wave comes back from x = L at 2 L/(c + v)

At v = c/2 and in the middle this is F L/(3 T), 4/3 of the deflection of a force at rest.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (it lies beside the folders of the cases)

LENGTH, MASS, TENSION, FORCE, SECTIONS = 1.0, 1.0, 100.0, 1.0, 200
C = (TENSION / MASS) ** 0.5
END = """
VARIABLE/under, FUNCTION=DY({middle})

INTEGRATOR/HHT, ERROR=1.0E-7
SIMULATE/DYNAMIC, END={end:.12g}, STEPS=200
END
"""


def deck(speed: float) -> str:
    """Nodes move across only; a force between two of them is shared as by a lever."""
    h = LENGTH / SECTIONS
    title = f"A force runs at {speed:g} m/s over a string"
    text = catenary.head(title, f"{SECTIONS} sections.", gravity=0)
    text += f"MARKER/{1000 + SECTIONS}, PART=1, QP={LENGTH:g},0,0\nMARKER/1000, PART=1\n"
    for k in range(1, SECTIONS):
        i = 1000 + k
        text += catenary.node(i, MASS * h, (k * h, 0))
        text += f"MARKER/{i + 1000}, PART=1, QP={k * h:.9g},0,0\n"
        bent = f"DY({i + 1})-2*DY({i})+DY({i - 1})"
        text += (
            f"VFORCE/{i}, I={i}, J_PART=1, RM=1, FX=-1E6*DX({i},{i + 1000})\\\n"
            f", FY={TENSION:g}/{h:g}*({bent})"
            f"-{FORCE:g}*MAX(0,1-ABS({speed:g}*TIME-{k * h:.9g})/{h:g})\\\n"
            f", FZ=-1E6*DZ({i})\n"
        )
    return text + END.format(middle=1000 + SECTIONS // 2, end=LENGTH / 2 / speed)


for name, share in (("half", 0.5), ("fast", 0.8)):
    speed = share * C
    (HERE / f"{name}.adm").write_text(deck(speed))
    under = -FORCE * LENGTH / 2 / (TENSION * (1 + share))
    lines = ["# Deflection under the force in the middle: see README.md"]
    lines += ["# written by make_reference.py"]
    lines += [f"# measure: last VARIABLE/under = {under:.12g} tol rel 2e-3"]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")
