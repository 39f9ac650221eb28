"""Laws of forces with six components: exact Newton matrix, balance, values in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from constraint_decks import BODIES
from newton_matrix import matrix_error
from scenes import compiled

from adamslite.analyses.simulation import simulate
from adamslite.model.geometry import rotation_313
from adamslite.model.model import Model
from adamslite.reading.read import read
from adamslite.results.results import Results

FLOATING = "MARKER/39, PART=3, FLOATING\n"
SECTION = "IXX=1, IYY=2, IZZ=3, AREA=4, EMODULUS=2, GMODULUS=1, ASY=1.2, ASZ=1.1"
LOWER = ",".join(map(str, range(1, 22)))
FULL = ",".join(map(str, range(1, 37)))
# Function that measures it -> statements; the element is always number 1, I on PART/2.
DECKS = {
    "GFORCE": FLOATING + "GFORCE/1, I=21, JFLOAT=39, RM=31, FX=3*DX(21,31)\\ FY=VY(21,31,1)-2\\"
    " TX=AX(21,31)\\ TZ=3*WX(21,1)",
    "VTORQ": FLOATING + "VTORQUE/1, I=21, JFLOAT=39, RM=31, TX=DX(21,31)\\ TY=VX(21,31,1)+1",
    "BUSH": "BUSHING/1, I=21, J=31, K=10,20,30, C=1,2,3, KT=3,4,5, CT=0.1,0.2,0.3"
    ", FORCE=1,2,3, TORQUE=4,5,6",
    "FIELD": f"FIELD/1, I=21, J=31, KMATRIX={FULL}, CMATRIX={FULL}"
    ", LENGTH=0.1,0.2,0.3,0.4,0.5,0.6, FORCE=1,2,3,4,5,6",
    "BEAM": f"BEAM/1, I=21, J=31, LENGTH=0.8, {SECTION}, CRATIO=0.1",
    "FIELD BY": "MARKER/29, PART=2, QP=1,2,0\n"
    f"FIELD/1, I=21, J=31, BY=29, KMATRIX={FULL}, CRATIO=0.1",
    "BEAM STRING": f"BEAM/1, I=21, J=31, LENGTH=0.8, {SECTION}, CRATIO=0.1, FORMULATION=STRING",
    "BEAM with CMATRIX": f"BEAM/1, I=21, J=31, LENGTH=0.8, {SECTION}, CMATRIX={LOWER}",
    **{
        f"FRICTION {kind} {effect} {edge}": f"JOINT/1, {kind}, I=21, J=31\nFRICTION/1, JOINT=1"
        f", EFFECT={effect}, PIN_RADIUS=0.3, MAX_STICTION_DEFORMATION=0.5"
        ", FRICTION_FORCE_PRELOAD=1, FRICTION_TORQUE_PRELOAD=1"
        f", INITIAL_OVERLAP=0.4, STICTION_TRANSITION_VELOCITY={edge}"
        for kind, effect, edge in (
            ("TRANSLATIONAL", "ALL", 9),
            ("TRANSLATIONAL", "ALL", 0.3),
            ("REVOLUTE", "ALL", 0.3),
            ("REVOLUTE", "SLIDING", 0.01),
            ("CYLINDRICAL", "STICTION", 0.3),
            ("SPHERICAL", "ALL", 0.3),
            ("SPHERICAL", "ALL", 9),
            ("HOOKE", "ALL", 0.3),
            ("UNIVERSAL", "ALL", 9),
        )
    },
}  # fmt: skip


MOVING = BODIES.replace("PART/2, ", "PART/2, VX=0.3, VZ=-0.2, WZ=0.5, WY=0.2, ")
SEEN = {
    **{f"x{n}": f"D{axis}(21,31,31)" for n, axis in enumerate("XYZ")},
    **{f"x{n}": f"A{axis}(21,31)" for n, axis in enumerate("XYZ", 3)},
    **{f"v{n}": f"V{axis}(21,31,31,31)" for n, axis in enumerate("XYZ")},
    **{f"v{n}": f"W{axis}(21,31,31)" for n, axis in enumerate("XYZ", 3)},
}
STATE = "".join(f"VARIABLE/{name}, FUNCTION={function}\n" for name, function in SEEN.items())
COMPONENTS = (2, 3, 4, 6, 7, 8)
# Statement -> function, stiffness, damping, rest, preload; a plain matrix is diagonal.
LAWS = {
    "BUSHING/1, I=21, J=31, K=10,20,30, C=1,2,3, KT=3,4,5, CT=0.1,0.2,0.3, FORCE=1,2,3"
    ", TORQUE=4,5,6": ("BUSH", [10, 20, 30, 3, 4, 5], [1, 2, 3, 0.1, 0.2, 0.3], 0, range(1, 7)),
    "BUSHING/1, I=21, J=31, K=0,7,1, KT=0,0,2, TORQUE=-1,0,0": (
        "BUSH", [0, 7, 1, 0, 0, 2], 0, 0, [0, 0, 0, -1, 0, 0],
    ),
    f"FIELD/1, I=21, J=31, KMATRIX={FULL}, CMATRIX={FULL}, LENGTH=0.1,0.2,0.3,0.4,0.5,0.6": (
        "FIELD", np.arange(1, 37).reshape(6, 6).T, np.arange(1, 37).reshape(6, 6).T,
        np.arange(1, 7) / 10, 0,
    ),
    f"FIELD/1, I=21, J=31, KMATRIX={FULL}, CRATIO=0.5, FORCE=-1,-2,-3,4,5,6": (
        "FIELD", np.arange(1, 37).reshape(6, 6).T, np.arange(1, 37).reshape(6, 6).T / 2,
        0, [-1, -2, -3, 4, 5, 6],
    ),
}  # fmt: skip


def start_of(statements: str) -> tuple[Model, Results]:
    """Two skew bodies in motion with these statements: the model and its state at t = 0."""
    kernels = compiled(f"{MOVING}{statements}\nEND\n")
    return kernels.model, simulate(kernels, end=1e-4, steps=1)


def vector(found: Results, *names: str) -> np.ndarray:
    return np.array([found[name][0] for name in names])


def unexplained(model: Model, found: Results, body: int) -> np.ndarray:
    """Rates of momentum and of angular momentum about the origin that are not from the weight."""
    part = model.bodies[body]
    label = part.statement.label
    x, a, w, al = (
        vector(found, *(f"{label}.{stem}{axis}" for axis in "xyz")) for stem in ("", "a", "w", "al")
    )
    attitude = rotation_313(vector(found, *(f"{label}.{n}" for n in ("psi", "theta", "phi"))))
    inertia = attitude @ part.inertia @ attitude.T
    force = part.mass * (a - [0.0, -9.81, 0.0])
    torque = inertia @ al + np.cross(w, inertia @ w)
    return np.concatenate([force, np.cross(x, force) + torque])


@pytest.mark.parametrize("name", DECKS)
def test_the_newton_matrix_agrees_with_differences(name: str) -> None:
    assert matrix_error(f"{BODIES}{DECKS[name]}\nEND\n", stabilised=True) < 1e-6


@pytest.mark.parametrize("name", DECKS)
def test_momentum_balances(name: str) -> None:
    model, found = start_of(DECKS[name])
    first, second = (unexplained(model, found, body) for body in (0, 1))
    assert first == pytest.approx(-second, abs=1e-9)
    assert np.abs(first).max() > 1e-3


@pytest.mark.parametrize("name", DECKS)
def test_measures_on_i_and_j_are_opposite(name: str) -> None:
    """-force, and -torque less the moment of the force unless the reaction sits at I itself."""
    function = name.split()[0]
    measures = "".join(
        f"VARIABLE/{end}{n}, FUNCTION={function}(1,{jflag},{component},0)\n"
        for jflag, end in enumerate("ij")
        for n, component in enumerate(COMPONENTS)
    )
    place = "".join(f"VARIABLE/d{n}, FUNCTION=D{axis}(21,31)\n" for n, axis in enumerate("XYZ"))
    _, found = start_of(f"{DECKS[name]}\n{measures}{place}")
    on_i, on_j = (vector(found, *(f"VARIABLE/{end}{n}" for n in range(6))) for end in "ij")
    moment = np.cross(vector(found, *(f"VARIABLE/d{n}" for n in range(3))), on_i[:3])
    follows = function in ("GFORCE", "VTORQ", "FRICTION")
    assert on_j[:3] == pytest.approx(-on_i[:3], abs=1e-10)
    assert on_j[3:] == pytest.approx(-on_i[3:] - (0 if follows else moment), abs=1e-10)
    assert np.abs(on_i).max() > 1e-3


@pytest.mark.parametrize("statement", LAWS)
def test_force_follows_from_displacement_and_rate(statement: str) -> None:
    function, *law = LAWS[statement]
    stiffness, damping = (np.diag(m) if np.ndim(m) == 1 else m * np.ones((6, 6)) for m in law[:2])
    measures = "".join(
        f"VARIABLE/f{n}, FUNCTION={function}(1,0,{component},31)\n"
        for n, component in enumerate(COMPONENTS)
    )
    _, found = start_of(f"{statement}\n{measures}{STATE}")
    f, x, v = (vector(found, *(f"VARIABLE/{q}{n}" for n in range(6))) for q in "fxv")
    rest, preload = (np.ones(6) * np.array(values) for values in law[2:])
    assert f == pytest.approx(preload - stiffness @ (x - rest) - damping @ v, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize(("e", "g", "length"), [(2.0, 1.0, 0.8), (2.1e5, 8e4, 3.0)])
def test_flexibility_of_a_beam_is_that_of_a_cantilever(e: float, g: float, length: float) -> None:
    """Tip deflection F L^3/3EI + F L AS/GA, slope F L^2/2EI, and those of a moment."""
    section = SECTION.replace("EMODULUS=2", f"EMODULUS={e}").replace("GMODULUS=1", f"GMODULUS={g}")
    text = f"{BODIES}BEAM/1, I=21, J=31, LENGTH={length}, {section}\nEND\n"
    flexibility = np.linalg.inv(np.array(read(text).find("BEAM", 1).matrix))
    a, ixx, iyy, izz, asy, asz = 4, 1, 2, 3, 1.2, 1.1
    expected = np.diag([length / (e * a), 0, 0, length / (g * ixx), 0, 0])
    for turn, push, inertia, ratio, sign in ((5, 1, izz, asy, 1), (4, 2, iyy, asz, -1)):
        expected[push, push] = length**3 / (3 * e * inertia) + length * ratio / (g * a)
        expected[push, turn] = expected[turn, push] = sign * length**2 / (2 * e * inertia)
        expected[turn, turn] = length / (e * inertia)
    assert flexibility == pytest.approx(expected, rel=1e-10, abs=1e-15)
