"""Forces that are linear in the acceleration of their own body: it moves with an effective mass."""

import numpy as np
import pytest
from scenes import GROUND, run

import adamslite as al
from adamslite.equations.system import System
from adamslite.results.outcomes import Outcome

POINT = GROUND + "POINT_MASS/2, MASS=2, CM=2, QG=1,0,0, VY=1\nMARKER/2, POINT_MASS=2\n"
#: Two masses, a part whose marker 31 is not at its mass centre.
TWO = (
    POINT
    + """POINT_MASS/4, MASS=1, CM=4, QG=0,2,0
MARKER/4, POINT_MASS=4
PART/3, MASS=3, CM=3, QG=0,0,1, IP=2,3,4, WX=1, WY=0.3, VX=1
MARKER/3, PART=3
MARKER/31, PART=3, QP=0.2,0.1,-0.3
"""
)


def push(fx: str = "0", fy: str = "0", fz: str = "0", on: str = "2") -> str:
    """A VFORCE between a marker and ground."""
    return f"VFORCE/1, I={on}, J_PART=1, FX={fx}\\FY={fy}\\FZ={fz}\n"


def is_added(deck: str) -> bool:
    """Whether the program takes the forces of a deck for added mass."""
    system = System(al.compile_model(al.assemble(al.read(deck + "END\n"))), True)
    assert system.sizes.implicit_mass
    return bool(system.sizes.added_mass)


@pytest.mark.parametrize(
    "force",
    [
        push("-3*ACCX(2)"),
        push("-TIME*ACCX(2)-0.1*ACCY(2)", "-DX(2)*ACCX(2)", "5-ACCZ(2)*VM(2)"),
        push("(TIME-2)*(ACCX(2)-JGRAV)/(1+DX(2)**2)"),
        push("-IF(TIME-1: 1, 1, 2)*ACCX(2)"),
        push("-ACCX(31)", "-2*ACCY(31)", "-ACCZ(31)*DX(31)", on="31"),
        "VTORQUE/1, I=3, J_PART=1, TX=-WDTX(3)\\TY=-0.5*WDTX(3)\\TZ=0\n",
    ],
)
def test_a_force_linear_in_the_own_acceleration_is_added_mass(force: str) -> None:
    assert is_added(TWO + force)


@pytest.mark.parametrize(
    "force",
    [
        push("-ACCX(4)"),
        push("-ACCX(2,4)"),
        push("-ACCX(2)**2"),
        push("-ACCX(2)*ACCY(2)"),
        push("-ACCM(2)"),
        push("IF(ACCX(2): 1, 0, -1)"),
        push("MAX(ACCX(2), 0)"),
        "SFORCE/1, TRANSLATIONAL, I=2, J=4, FUNCTION=-0.1*ACCX(2)\n",
        push("-3*ACCX(2)") + "VFORCE/2, I=4, J_PART=1, FX=-ACCX(2)\\FY=0\\FZ=0\n",
        push("-VARVAL(1)*ACCX(2)") + "VARIABLE/1, FUNCTION=ACCX(2)*0.1\n",
    ],
)
def test_any_other_acceleration_is_solved_for(force: str) -> None:
    assert not is_added(TWO + force)


@pytest.mark.parametrize("method", ["ABAM", "RKF45", "AUTO", "GSTIFF", "RADAU"])
def test_a_mass_that_grows_with_time(method: str) -> None:
    """(2 + 3 t) x" = 6:  v = 2 ln w,  x = 1 + 4/3 (w ln w - w + 1),  w = 1 + 3/2 t."""
    found = run(POINT + push("6-3*TIME*ACCX(2)") + "END\n", 2.0, 8, integrator=method, error=1e-8)
    w = 1.0 + 1.5 * found.time
    np.testing.assert_allclose(found["POINT_MASS/2.vx"], 2.0 * np.log(w), atol=1e-6)
    place = 1.0 + 4.0 / 3.0 * (w * np.log(w) - w + 1.0)
    np.testing.assert_allclose(found["POINT_MASS/2.x"], place, atol=1e-6)
    np.testing.assert_allclose(found["POINT_MASS/2.ax"], 3.0 / w, atol=1e-6)


@pytest.mark.parametrize(
    "force",
    [
        push("-10*DX(2)-TIME*ACCX(2)-0.3*ACCY(2)", "-DY(2)-0.2*DX(2)*ACCX(2)", "5-ACCZ(2)*VM(2)"),
        push("-DX(31)-0.7*ACCX(31)", "-DY(31)-2*ACCY(31)", "-3*DZ(31)-ACCZ(31)*DX(31)", on="31"),
        "VTORQUE/1, I=3, J_PART=1, TX=-WDTX(3)-WY(3)\\TY=-0.5*WDTX(3)\\TZ=-WZ(3)\n",
    ],
)
def test_explicit_and_implicit_agree_on_full_matrices(force: str) -> None:
    """The explicit formula with effective masses against RADAU, which solves for accelerations."""
    deck = TWO + force + "SPRINGDAMPER/1, TRANSLATIONAL, I=4, J=3, K=30, C=1, LENGTH=1\nEND\n"
    found, known = (
        run(deck, 1.0, 10, integrator=method, error=1e-9) for method in ("ABAM", "RADAU")
    )
    for name in known:
        if name.partition(".")[2] in ("x", "vy", "az", "wx", "wy"):
            np.testing.assert_allclose(found[name], known[name], atol=2e-6)


@pytest.mark.parametrize("method", ["ABAM", "RADAU"])
def test_a_point_whose_effective_mass_is_a_full_matrix(method: str) -> None:
    """(2 - C) a = f for a C without symmetry: x = x0 + v0 t + a t^2/2 along every axis."""
    coefficients = np.array([[0.5, 0.2, -0.3], [0.4, -0.6, 0.1], [-0.7, 0.9, 0.8]])
    force = np.array([3.0, -2.0, 5.0])
    parts = [f"{f}" + "".join(f"{c:+}*ACC{axis}(2)" for c, axis in zip(row, "XYZ", strict=True))
             for f, row in zip(force, coefficients, strict=True)]  # fmt: skip
    found = run(POINT + push(*parts) + "END\n", 1.0, 4, integrator=method, error=1e-9)
    a = np.linalg.solve(2 * np.eye(3) - coefficients, force)
    t = found.time[:, None]
    expected = [1, 0, 0] + np.array([0, 1, 0]) * t + a * t**2 / 2
    places = np.column_stack([found[f"POINT_MASS/2.{axis}"] for axis in "xyz"])
    np.testing.assert_allclose(places, expected, atol=1e-8)


@pytest.mark.parametrize("method", ["ABAM", "GSTIFF", "RADAU"])
def test_a_mass_that_vanishes_along_a_diagonal_ends_the_run(method: str) -> None:
    """[2, -2 t; -2 t, 2] of y and z is singular at t = 1; neither of its diagonal elements is."""
    found = run(
        POINT + push("0", "2*TIME*ACCZ(2)", "1+2*TIME*ACCY(2)") + "END\n",
        2.0, 100, integrator=method, error=1e-6,
    )  # fmt: skip
    assert found.outcome is Outcome.SINGULAR_ACCELERATION
    assert found.time[-1] == pytest.approx(1.0, abs=0.03)


def test_no_matrix_is_formed_for_a_stage() -> None:
    """One effective mass for each step is compared with that at the start, and none solved for."""
    found = run(POINT + push("-10*DX(2)-TIME*ACCX(2)") + "END\n", 2.0, 8, integrator="ABAM")
    assert found.summary["factorizations"] <= found.summary["steps"] + 2


@pytest.mark.parametrize("method", ["ABAM", "AUTO", "RADAU"])
def test_a_mass_that_vanishes_with_the_place_ends_the_run(method: str) -> None:
    """(2 - x) x" = 1 from x = 1 at rest: v^2/2 = -ln(2 - x); the mass vanishes at x = 2."""
    start = POINT.replace(", VY=1", "")
    deck = start + push("1+DX(2)*ACCX(2)") + "END\n"
    found = run(deck, 3.0, 300, integrator=method, error=1e-6)
    assert found.outcome is Outcome.SINGULAR_ACCELERATION
    x, v = found["POINT_MASS/2.x"][:100], found["POINT_MASS/2.vx"][:100]
    np.testing.assert_allclose(0.5 * v**2, -np.log(2.0 - x), atol=1e-4)


@pytest.mark.parametrize("method", ["ABAM", "RADAU"])
def test_a_mass_that_is_zero_at_the_start_is_reported(method: str) -> None:
    found = run(POINT + push("1+2*ACCX(2)") + "END\n", 1.0, 10, integrator=method)
    assert found.outcome is Outcome.SINGULAR_ACCELERATION


def test_auto_takes_added_mass_for_mass() -> None:
    """A net that is not stiff is explicit; with the force of another's acceleration implicit."""
    chosen = [
        run(TWO + force + "END\n", 1.0, 10, integrator="AUTO", error=error).meta["integrator"]
        for force in (push("-DX(2)-3*ACCX(2)"), push("-DX(2)-0.3*ACCX(4)"))
        for error in (1e-3, 1e-6)
    ]
    assert [name.partition(" ")[0] for name in chosen] == ["RKF45", "RKF45", "GSTIFF", "RADAU"]


def test_auto_judges_stiffness_by_the_effective_mass() -> None:
    """k = 1e12: with 1e12 of added mass 1 rad/s, without it 7e5 rad/s, too fast for explicit."""
    force = "VFORCE/{}, I=2, J_PART=1, FX=-1E12*(DX(2){})\\FY=0\\FZ=0\n"
    reasons = [
        run(POINT + force.format(1, acc) + "END\n", 1.0, 10, integrator="AUTO").meta
        for acc in ("+ACCX(2)", "")
    ]
    assert [meta["integrator"].partition(" ")[0] for meta in reasons] == ["RKF45", "HHT"]
