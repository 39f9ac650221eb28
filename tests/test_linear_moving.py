"""Small motions about moving states against closed forms."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest

import adamslite
from adamslite.cli.main import main
from adamslite.reading.read import read_commands


def linearized(text: str, *arguments: str) -> list:
    """What LINEAR commands with these arguments find at the start of a deck."""
    deck = adamslite.read(text)
    lines = [f"LINEAR/{each}" for each in arguments or ["EIGENSOL"]]
    commands = read_commands("\n".join(["SIMULATE/INITIAL", *lines, "STOP", ""]), deck)
    return [each.model for each in adamslite.simulate(deck, commands=commands).linearizations]


def spectrum(model) -> np.ndarray:
    """Imaginary parts of a spectrum without real part, from the smallest on."""
    assert np.abs(model.eigenvalues.real).max() < 1e-8 * np.abs(model.eigenvalues).max()
    return np.sort(model.eigenvalues.imag)


def rotor(across: float, along: float, spin: float, scale: float = 1.0) -> str:
    return f"""\
a symmetric rotor held at its mass centre
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=3, CM=21, IP={across * scale**2},{across * scale**2},{along * scale**2}, WZ={spin}
MARKER/21, PART=2
JOINT/1, SPHERICAL, I=21, J=1
END
"""


@pytest.mark.parametrize("scale", [1.0, 1000.0])
@pytest.mark.parametrize(
    ("across", "along", "spin"), [(0.02, 0.01, 60.0), (0.03, 0.05, -35.0), (0.02, 0.02, 7.0)]
)
def test_a_free_symmetric_rotor(across: float, along: float, spin: float, scale: float) -> None:
    """Ground sees the axis nutate at W Ia/It; the rotor sees that less its own turning, the
    precession (Ia - It)/It W of Euler's equations, and tilts that rest in space turn at -W.
    """
    ground, own = linearized(rotor(across, along, spin, scale), "EIGENSOL", "EIGENSOL, RM=21")
    nutation, precession = abs(spin * along / across), abs(spin * (along - across) / across)
    assert spectrum(ground) == pytest.approx([-nutation, *4 * [0.0], nutation], rel=1e-8, abs=1e-8)
    seen = sorted([0.0, 0.0, precession, -precession, spin, -spin])
    assert spectrum(own) == pytest.approx(seen, rel=1e-8, abs=1e-8)
    assert ground.steady and own.steady and not ground.note


@pytest.mark.parametrize(
    ("mass", "height", "across", "along", "spin", "gravity"),
    [(1.0, 0.1, 0.02, 0.01, 60.0, 9.81), (2.5, 70.0, 4000.0, 5500.0, -90.0, 9810.0)],
)
@pytest.mark.parametrize("marker", [None, 1, 22])
def test_a_sleeping_top(mass, height, across, along, spin, gravity, marker) -> None:
    """It z'' - i Ia W z' - m g h z = 0 for the tilt z = x + i y, It about the tip; whoever turns
    with the top sees exp(-i W t) z.  With the first numbers 2.897 and 0.286 Hz.
    """
    text = f"""\
a sleeping top
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS={mass}, CM=21, IP={across},{across},{along}, WZ={spin}, QG=0,0,{height}
MARKER/21, PART=2
MARKER/22, PART=2, QP=0,0,{-height}
JOINT/1, SPHERICAL, I=22, J=1
ACCGRAV/KGRAV={-gravity}
END
"""
    (model,) = linearized(text, "EIGENSOL" if marker is None else f"EIGENSOL, RM={marker}")
    tip = across + mass * height**2
    root = sqrt((along * spin) ** 2 - 4 * tip * mass * gravity * height)
    turned = spin if marker == 22 else 0.0
    rates = [(along * spin + sign * root) / (2 * tip) - turned for sign in (1, -1)]
    exact = sorted([0.0, 0.0, *rates, *(-rate for rate in rates)])
    assert spectrum(model) == pytest.approx(exact, rel=1e-9, abs=1e-9)
    if marker is None and mass == 1.0:
        assert model.frequencies[[2, 4]] == pytest.approx([0.286, 2.897], abs=5e-4)


def turntable(length: float, spin: float, gravity: float, drive: str) -> str:
    return f"""\
a pendulum on a shaft
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1,1,1, WZ={spin}
MARKER/20, PART=2
MARKER/21, PART=2, REULER=30D,90D,0
JOINT/1, REVOLUTE, I=20, J=1
{drive}
PART/3, MASS=2, CM=30, IP=1E-12,1E-12,1E-12, QG=0,0,{-length}, WZ={spin}
MARKER/30, PART=3
MARKER/31, PART=3, QP=0,0,{length}, REULER=30D,90D,0
JOINT/2, REVOLUTE, I=31, J=21
ACCGRAV/KGRAV={-gravity}
END
"""


@pytest.mark.parametrize(
    ("length", "spin", "gravity"), [(1.0, 2.0, 9.81), (1.0, -2.0, 9.81), (250.0, 4.0, 9810.0)]
)
@pytest.mark.parametrize("level", ["DISPLACEMENT", "VELOCITY"])
def test_a_pendulum_on_a_driven_shaft(length, spin, gravity, level, tmp_path, capsys) -> None:
    """sqrt(g/l - W^2)/(2 pi), with the first numbers 0.38363 Hz; the ground is told who sees a
    steady state.  A shaft driven by its speed may stand at any angle: one eigenvalue 0 more.
    """
    function = f"{spin}*TIME" if level == "DISPLACEMENT" else str(spin)
    text = turntable(length, spin, gravity, f"MOTION/1, JOINT=1, {level}, FUNCTION={function}")
    exact = sqrt(gravity / length - spin**2) / (2 * pi)
    ground, seen, bob = linearized(text, "EIGENSOL", "EIGENSOL, RM=21", "EIGENSOL, RM=30")
    for model in (ground, seen, bob):
        assert model.frequencies[-1] == pytest.approx(exact, rel=1e-6)
        assert len(model.eigenvalues) == (2 if level == "DISPLACEMENT" else 3)
    assert seen.steady and bob.steady
    assert ground.note.endswith("it is steady with RM=20")
    deck = tmp_path / "shaft.adm"
    deck.write_text(text)
    assert main(["linear", str(deck)]) == 0
    assert "the linear system varies with time" in capsys.readouterr().out
    assert main(["linear", str(deck), "--rm", "21"]) == 0
    assert "varies" not in capsys.readouterr().out
    assert main(["linear", str(deck), "--rm", "24"]) == 2
    assert "there is no MARKER/24" in capsys.readouterr().err


@pytest.mark.parametrize("turn", [0.0, 30.0])
def test_modes_seen_from_a_body_that_sways(turn: float) -> None:
    """A table sways by p about z of the ground; a mass 2 m out along x and a block stand still.
    From the table the mass moves by -p z x (2, 0, 0) and the block turns by -p, along the axes of
    the marker, which are turned by 30 degrees; the table itself does not move.
    """
    text = f"""\
a swaying table, other things at rest
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, QP=2,0,0
MARKER/4, PART=1, QP=0,1,0
PART/2, MASS=1, CM=20, IP=1,1,2
MARKER/20, PART=2
MARKER/21, PART=2, REULER={turn}D,0,0
JOINT/1, REVOLUTE, I=20, J=1
SPRINGDAMPER/1, ROTATION, I=20, J=1, KT=18
POINT_MASS/3, MASS=1, CM=30, QG=2,0,0
MARKER/30, POINT_MASS=3
MARKER/11, FLOATING, PART=1
VFORCE/3, I=30, JFLOAT=11, RM=1, FX=-100*DX(30,3)\\ FY=-100*DY(30,3)\\ FZ=-100*DZ(30,3)
PART/4, MASS=1, CM=40, IP=1,1,1, QG=0,1,0
MARKER/40, PART=4
JOINT/4, REVOLUTE, I=40, J=4
SPRINGDAMPER/4, ROTATION, I=40, J=4, KT=50
END
"""
    (model,) = linearized(text, "EIGENSOL, RM=21")
    (k,) = np.flatnonzero(np.abs(model.eigenvalues - 3j) < 1e-9)
    mode = dict(zip(model.coordinates, model.modes[:, k], strict=True))
    assert all(abs(value) < 1e-12 for name, value in mode.items() if name.startswith("PART/2."))
    p = -mode["PART/4.rz"]
    assert abs(p) > 0.1 and abs(mode["PART/4.rx"]) < 1e-12
    angle = np.radians(turn)
    seen = -2 * p * np.array([np.sin(angle), np.cos(angle), 0.0])
    found = [mode[f"POINT_MASS/3.{axis}"] for axis in "xyz"]
    assert found == pytest.approx(seen, rel=1e-9, abs=1e-12)


def turning_table(spin: float, faster: float = 0.0) -> str:
    """PART/2, driven about z at `spin` + `faster` t, and a mass of 2 at its middle."""
    return f"""\
a mass and a table that turns
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1,1,2, WZ={spin}
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, FUNCTION={spin}*TIME+{faster / 2}*TIME**2
POINT_MASS/3, MASS=2, CM=30
MARKER/30, POINT_MASS=3
"""


@pytest.mark.parametrize("spin", [3.0, -1.5])
def test_modes_seen_from_a_turning_table(spin: float) -> None:
    """A mass on radial and tangential springs at the middle of a driven table, K = m k for both:
    x'' - 2 W y' + (k - W^2) x = 0 and so on.  On the table it circles at sqrt(k) -+ W.
    """
    text = (
        turning_table(spin)
        + """\
MARKER/22, FLOATING, PART=2
VFORCE/3, I=30, JFLOAT=22, RM=20
, FX=VARVAL(1)-50*DX(30,20,20)\\ FY=-50*DY(30,20,20)\\ FZ=-50*DZ(30,20,20)
VARIABLE/1, FUNCTION=0
VARIABLE/2, FUNCTION=DX(30,20,20)
PINPUT/1, VARIABLES=1
POUTPUT/1, VARIABLES=2
END
"""
    )
    modes, states = linearized(text, "EIGENSOL, RM=20", "STATEMAT, RM=20, PINPUT=1, POUTPUT=1")
    rates = sorted(sign * abs(5 + turn) for sign in (1, -1) for turn in (spin, -spin))
    assert spectrum(modes) == pytest.approx(sorted([*rates, 5.0, -5.0]), rel=1e-9)
    for rate, mode in zip(modes.eigenvalues, modes.modes.T, strict=True):
        if abs(abs(rate) - 5.0) > 1e-6:
            circles = -1j if abs(rate.imag) > 5.0 else 1j
            factor = circles * np.sign(rate.imag) * np.sign(spin)
            assert mode[6:8] == pytest.approx(mode[6] * np.array([1.0, -factor]), rel=1e-9)
    s = 1.3j
    inertia = s**2 + 25 - spin**2
    exact = 0.5 * inertia / (inertia**2 + (2 * spin * s) ** 2)
    inside = np.linalg.solve(
        s * np.eye(len(states.state_matrix)) - states.state_matrix, states.input_matrix
    )
    answer = states.output_matrix @ inside + states.feedthrough
    assert answer[0, 0] == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize(("spin", "faster"), [(3.0, 2.0), (0.0, -6.0), (-1.5, 4.0)])
def test_a_table_that_turns_faster_and_faster(spin: float, faster: float) -> None:
    """z = x + i y of a mass on springs k, seen from a table of W and W' = A at this moment:
    z" + 2 i W z' + (k - W^2 + i A) z = 0, so that s = -i W +- i sqrt(k + i A).
    """
    text = (
        turning_table(spin, faster)
        + """\
VFORCE/3, I=30, J_PART=1, FX=-50*DX(30)\\ FY=-50*DY(30)\\ FZ=-50*DZ(30)
END
"""
    )
    ground, table = linearized(text, "EIGENSOL", "EIGENSOL, RM=20")
    assert ground.steady and not table.steady
    assert spectrum(ground) == pytest.approx([-5.0] * 3 + [5.0] * 3, rel=1e-9)
    root = np.sqrt(25 + 1j * faster)
    seen = [1j * (sign * root - spin) for sign in (1, -1)]
    seen = np.sort_complex([5j, -5j, *seen, *np.conj(seen)])
    found = np.sort_complex(np.round(table.eigenvalues, 9))
    assert found == pytest.approx(np.sort_complex(np.round(seen, 9)), abs=1e-6)


@pytest.mark.parametrize(("radius", "gravity"), [(0.3, 9.81), (200.0, 9810.0)])
@pytest.mark.parametrize("share", [0.7, 1.5, -1.5])
def test_a_rolling_disc(radius: float, gravity: float, share: float) -> None:
    """A thin disc that rolls upright at W leans as s^2 = (4 g/r - 12 W^2)/5: upright only above
    W^2 = g/(3 r).  What else may change (place, heading, speed, yaw) stays or drifts.

    e the axis, c = -r (k - e_z e)/n with n^2 = 1 - e_z^2 the lever of the lowest point: it does not
    slide, v + w x c = 0 in the plane, and the centre is r n above it.
    Reference: J. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972.
    """
    w = share * sqrt(gravity / (3 * radius))
    mass, inertia = 2.0, 2.0 * radius**2 / 4
    text = f"""\
a rolling disc
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS={mass}, CM=20, IP={inertia},{2 * inertia},{inertia}, QG=0,0,{radius}
, VX={w * radius}, WY={w}
MARKER/20, PART=2
MARKER/21, PART=2, QP=0,1,0
VARIABLE/n, FUNCTION=SQRT(1-DZ(21,20)**2)
GCON/1, FUNCTION=DZ(20)-{radius}*VARVAL(n)
GCON/2, FUNCTION=VX(20)-{radius}*(WY(20)*VARVAL(n)+WZ(20)*DZ(21,20)*DY(21,20)/VARVAL(n))
GCON/3, FUNCTION=VY(20)+{radius}*(WX(20)*VARVAL(n)+WZ(20)*DZ(21,20)*DX(21,20)/VARVAL(n))
ACCGRAV/KGRAV={-gravity}
END
"""
    (model,) = linearized(text)
    squared = (4 * gravity / radius - 12 * w**2) / 5
    assert model.steady and len(model.eigenvalues) == 8
    assert np.abs(model.eigenvalues[:6]).max() < 1e-9 * sqrt(abs(squared))
    assert model.eigenvalues[6:] ** 2 == pytest.approx([squared, squared], rel=1e-9)


@pytest.mark.parametrize(("k", "c", "length"), [(3.0, 2.0, 0.5), (7.0, -4.0, 1.5)])
def test_a_cart_whose_speed_is_a_state(k: float, c: float, length: float) -> None:
    """x' = s by a constraint, s' = -k x - c l z of a regulator, z the angle of a pendulum below the
    cart: z'' = -g z/l - s'/l.  The cart's acceleration is the state's rate.
    """
    text = f"""\
a pendulum below a cart with a given speed
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
MARKER/2, PART=1, REULER=0,90D,0
POINT_MASS/2, MASS=4, CM=20
MARKER/20, POINT_MASS=2
JPRIM/2, INLINE, I=20, J=1
PART/3, MASS=1, CM=30, IP=1E-9,1E-9,1E-9, QG=0,0,{-length}
MARKER/30, PART=3
MARKER/31, PART=3, QP=0,0,{length}
MARKER/32, PART=3, REULER=0,90D,0
JPRIM/3, ATPOINT, I=31, J=20
JPRIM/4, PARALLEL_AXES, I=32, J=2
GCON/2, FUNCTION=VX(20)-DIF(1)
DIFF/1, IC=0, FUNCTION=-{k}*DX(20)-{c}*(DX(30)-DX(20))
ACCGRAV/KGRAV=-9.81
END
"""
    (model,) = linearized(text)
    stiffness = [[k, c * length], [-k / length, (9.81 - c * length) / length]]
    exact = -np.linalg.eigvals(stiffness)
    found = sorted(model.eigenvalues**2, key=lambda s: s.real)
    assert found == pytest.approx(sorted(np.repeat(exact, 2), key=lambda s: s.real), rel=1e-8)


@pytest.mark.parametrize("spin", [2.0, -1.2])
def test_a_driven_shaft_turns_again_after_statics(spin: float) -> None:
    """Statics bring everything to rest; what follows moves as the MOTION asks."""
    deck = adamslite.read(turntable(1.0, spin, 9.81, f"MOTION/1, JOINT=1, FUNCTION={spin}*TIME"))
    lines = "SIMULATE/STATICS\nLINEAR/EIGENSOL, RM=20\nSIMULATE/DYNAMICS, END=1, STEPS=2\nSTOP\n"
    results = adamslite.simulate(deck, commands=read_commands(lines, deck))
    (found,) = results.linearizations
    exact = sqrt(9.81 - spin**2) / (2 * pi)
    assert found.model.frequencies == pytest.approx([exact, exact], rel=1e-6)
    assert results["PART/2.wz"] == pytest.approx(np.full(3, spin), rel=1e-6)


def test_where_a_run_says_that_a_linear_system_varies(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    text = turntable(1.0, 2.0, 9.81, "MOTION/1, JOINT=1, FUNCTION=2*TIME")
    (tmp_path / "s.adm").write_text(text)
    (tmp_path / "s.acf").write_text("SIMULATE/INITIAL\nLINEAR/EIGENSOL\nSTOP\n")
    assert main(["solve", "s.adm"]) == 0
    told = capsys.readouterr().err
    assert "linear               t = 0: the linear system varies with time" in told
    assert "it is steady with RM=20" in told


GROUND = "nothing or little moves\nPART/1, GROUND\n"
WHEEL = """\
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1,1,1, WZ=2
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
"""
BEAD = """\
MARKER/1, PART=1, REULER=90D,90D,0
POINT_MASS/3, MASS=1, CM=30
MARKER/30, POINT_MASS=3
JPRIM/1, INLINE, I=30, J=1
"""


@pytest.mark.parametrize(
    ("text", "exact"),
    [
        ("DIFF/1, IC=1, FUNCTION=-3*DIF(1)\n", [-3.0]),
        (BEAD + "GCON/1, FUNCTION=VX(30)+3*DX(30)\n", [-3.0]),
        (WHEEL, [0.0, 0.0]),
        (WHEEL + "MOTION/1, JOINT=1, FUNCTION=2*TIME\n", []),
        (WHEEL + "MOTION/1, JOINT=1, VELOCITY, FUNCTION=2\n", [0.0]),
        (WHEEL + "MOTION/1, JOINT=1, ACCELERATION, ICVEL=2, FUNCTION=0\n", [0.0, 0.0]),
    ],
)
def test_little_that_is_free(text: str, exact: list[float]) -> None:
    """A motion at a given speed may be shifted, one of a given acceleration has a speed as well."""
    (model,) = linearized(f"{GROUND}{text}END\n")
    assert model.steady
    assert model.eigenvalues == pytest.approx(exact, abs=1e-12)


@pytest.mark.parametrize("end", [0.3, 0.7])
def test_a_pendulum_in_full_swing(end: float) -> None:
    """z'' = -(g/l) cos(a) z about the angle a of the moment, which varies; released level."""
    text = """\
a falling pendulum
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1E-9,1E-9,1E-9, QG=1.2,0,0
MARKER/20, PART=2
MARKER/21, PART=2, QP=-1.2,0,0
JOINT/1, REVOLUTE, I=21, J=1
ACCGRAV/JGRAV=-9.81
END
"""
    deck = adamslite.read(text)
    lines = f"SIMULATE/DYNAMICS, END={end}, STEPS=1\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, RM=20\n"
    results = adamslite.simulate(deck, commands=read_commands(lines, deck), error=1e-8)
    cosine = -results["PART/2.y"][-1] / 1.2
    for each in results.linearizations:
        assert not each.model.steady and not each.model.steady_for
        assert each.model.eigenvalues**2 == pytest.approx(-9.81 / 1.2 * cosine, rel=1e-5)
    assert results.meta["linear"].startswith(f"t = {end}: the linear system varies")
