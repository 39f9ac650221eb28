"""Linearised models against closed forms."""

from __future__ import annotations

import json
import re
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest

import adamslite
from adamslite.analyses.linearization.linearization import balance
from adamslite.cli.main import main
from adamslite.errors import RunFailed
from adamslite.reading.read import read_commands

# m x'' + c x' + k x = w, tuned to omega = 10, zeta = 0.1; w is VARIABLE/1.
OSCILLATOR = """\
a mass on a spring, pushed
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
JPRIM/1, INLINE, I=2, J=9
MARKER/9, PART=1, REULER=90D,90D,0D
VARIABLE/1, FUNCTION=0
VARIABLE/2, FUNCTION=DX(2,1)
VARIABLE/3, FUNCTION=ACCX(2)
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=9, FUNCTION=VARVAL(1)-200*DX(2,1)-4*VX(2,1)
PINPUT/1, VARIABLES=1
POUTPUT/1, VARIABLES=2,3
END
"""


def found(text: str, commands: str):
    """What the LINEAR commands of a run found."""
    deck = adamslite.read(text)
    return adamslite.simulate(deck, commands=read_commands(commands, deck)).linearizations


def models(text: str, commands: str) -> list:
    return [each.model for each in found(text, commands)]


def transfer(model, s: complex) -> np.ndarray:
    """C (s - A)^-1 B + D."""
    a, b, c, d = (
        model.state_matrix, model.input_matrix, model.output_matrix, model.feedthrough,
    )  # fmt: skip
    return c @ np.linalg.solve(s * np.eye(len(a)) - a, b.astype(complex)) + d


@pytest.mark.parametrize("s", [0.3j, 10j, -2 + 25j])
def test_the_transfer_function_of_an_oscillator(s: complex) -> None:
    """x/w = 1/(m s^2 + c s + k), x''/w = s^2 x/w: the second needs D = 1/m."""
    run = "SIMULATE/STATICS\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=1\nSTOP\n"
    (model,) = models(OSCILLATOR, run)
    answer = 1.0 / (2 * s * s + 4 * s + 200)
    assert transfer(model, s)[:, 0] == pytest.approx([answer, s * s * answer], rel=1e-10)
    assert (model.inputs, model.outputs) == (("VARIABLE/1",), ("VARIABLE/2", "VARIABLE/3"))
    assert model.feedthrough == pytest.approx(np.array([[0.0], [0.5]]), abs=1e-12)


def test_eigenvalues_with_and_without_damping() -> None:
    run = "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, NODAMPING\nSTOP\n"
    damped, free = (each.model for each in found(OSCILLATOR, run))
    assert damped.eigenvalues[0] == pytest.approx(-1 + 1j * sqrt(99), rel=1e-12)
    assert free.eigenvalues[0] == pytest.approx(10j, rel=1e-12, abs=1e-10)
    assert damped.undamped == pytest.approx([10.0])


def test_a_reaction_as_output() -> None:
    """Pendulum of length l hanging at rest, pushed sideways by w: the bearing's sideways load is
    w - m x'', x/w = 1/(m (s^2 + g/l)); upwards the load changes by nothing of first order.
    """
    text = """\
a pendulum, pushed
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=3, CM=22, IP=1E-9,1E-9,1E-9, QG=0,-0.5,0
MARKER/22, PART=2
MARKER/21, PART=2, QP=0,0.5,0
JOINT/1, REVOLUTE, I=21, J=1
VARIABLE/1, FUNCTION=0
VARIABLE/2, FUNCTION=JOINT(1,0,2,0)
VARIABLE/3, FUNCTION=JOINT(1,0,3,0)
VFORCE/1, I=22, JFLOAT=10, RM=1, FX=VARVAL(1)\\ FY=0\\ FZ=0
MARKER/10, FLOATING, PART=1
ACCGRAV/JGRAV=-9.81
PINPUT/1, VARIABLES=1
POUTPUT/1, VARIABLES=2,3
END
"""
    run = "SIMULATE/STATICS\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=1\nSTOP\n"
    (model,) = models(text, run)
    s = 3j
    side = 1.0 - 3 * s * s / (3 * (s * s + 9.81 / 0.5))
    assert transfer(model, s)[:, 0] == pytest.approx([-side, 0.0], rel=1e-7, abs=1e-9)
    assert model.frequencies[0] == pytest.approx(sqrt(9.81 / 0.5) / (2 * pi), rel=1e-7)


def test_a_filter_is_a_state() -> None:
    """y' = (w - y)/T: y/w = 1/(1 + T s), the only state of a model at rest."""
    text = OSCILLATOR.replace("POUTPUT/1, VARIABLES=2,3", "POUTPUT/1, VARIABLES=4").replace(
        "END\n",
        "DIFF/1, IC=0, FUNCTION=(VARVAL(1)-DIF(1))/0.25\nVARIABLE/4, FUNCTION=DIF(1)\nEND\n",
    )
    run = "SIMULATE/STATICS\nLINEAR/STATEMAT, PINPUT=1, POUTPUT=1\nSTOP\n"
    (model,) = models(text, run)
    assert transfer(model, 5j)[0, 0] == pytest.approx(1 / (1 + 0.25 * 5j), rel=1e-10)


def test_modes_relative_to_a_body() -> None:
    """Two equal masses on a spring, free to fly: seen from one of them only the other moves."""
    text = """\
two masses
PART/1, GROUND
POINT_MASS/2, MASS=1, CM=2
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, QG=1,0,0
MARKER/3, POINT_MASS=3
SPRINGDAMPER/1, I=2, J=3, TRANSLATION, K=8, LENGTH=1
END
"""
    run = "SIMULATE/INITIAL\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, RM=2\nSTOP\n"
    absolute, relative = (each.model for each in found(text, run))
    assert absolute.frequencies[-1] == pytest.approx(4 / (2 * pi))
    a, b = absolute.modes[[0, 3], -1], relative.modes[[0, 3], -1]
    assert a[0] == pytest.approx(-a[1])
    assert b[0] == pytest.approx(0.0, abs=1e-12) and b[1] == pytest.approx(2 * a[1])


def test_solve_writes_what_linear_found(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("o.adm").write_text(OSCILLATOR)
    Path("o.acf").write_text(
        "SIMULATE/STATICS\nLINEAR/EIGENSOL\nLINEAR/EIGENSOL, NODAMPING\n"
        "LINEAR/STATEMAT, FILE=plant.mat, PINPUT=1, POUTPUT=1\nLINEAR/STATEMAT\nSTOP\n"
    )
    assert main(["solve", "o.adm", "-o", "x.csv"]) == 0
    names = sorted(each.name for each in tmp_path.iterdir())
    assert names == [
        "o.acf", "o.adm", "plant.mat", "x.2.modes.csv", "x.csv", "x.modes.csv", "x.states.json",
    ]  # fmt: skip
    feedthrough = json.loads(Path("plant.mat").read_text())["feedthrough"]
    assert np.allclose(feedthrough, [[0.0], [0.5]], rtol=1e-14, atol=0.0)
    assert json.loads(Path("x.states.json").read_text())["inputs"] == []


@pytest.mark.filterwarnings("error")
def test_scales_beyond_all_integers_raise_no_warning() -> None:
    """A column that is all but empty is scaled by more than 2^63."""
    a = np.array([[3.46e-28, 8.2e-31, 0.33], [0, 0.09, 4.5e-13], [0, 0, 3.6e-16]])
    scale = balance(a)
    assert np.isfinite(scale).all() and scale.max() / scale.min() > 2.0**63


PENDULUM = """\
a pendulum, drawn level
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=0.1,0.1,0.1
MARKER/2, PART=2
MARKER/20, PART=2, QP=1,0,0
JOINT/1, REVOLUTE, I=2, J=1
SIMULATE/STATICS
SIMULATE/DYNAMIC, END=0.1, STEPS=1
END
"""


def test_modes_without_commands_are_those_about_the_equilibrium_of_the_deck() -> None:
    """omega^2 = m g l / (J + m l^2) below the pivot, where it rests; 0 where it is drawn."""
    hanging = adamslite.linearize(adamslite.read(PENDULUM))
    assert abs(hanging.eigenvalues[0].imag) == pytest.approx(sqrt(9.81 / 1.1), rel=1e-6)
    drawn = adamslite.linearize(adamslite.read(PENDULUM), time=0)
    assert abs(drawn.eigenvalues[0]) < 1e-2
    only_moving = PENDULUM.replace("SIMULATE/STATICS\n", "")
    assert abs(adamslite.linearize(adamslite.read(only_moving)).eigenvalues[0]) < 1e-2


#: Where the mass begins, the root of its place has no slope, and the logarithm no value.
ROOT = "FUNCTION=-SQRT(ABS(DX(2,1)))"
NOWHERE = "FUNCTION=LOG(DX(2,1))"


@pytest.mark.parametrize(
    ("law", "said"), [(ROOT, "at t = 0, a derivative has no value"), (NOWHERE, "at t = 0, LOG(")]
)
def test_what_has_no_linear_part_is_named(law: str, said: str) -> None:
    """By the command of a run, which ends there, and by the function."""
    deck = re.sub(r"(SFORCE.*)FUNCTION=.*", rf"\1{law}", OSCILLATOR)
    commands = read_commands(
        "LINEAR/EIGENSOL\nSIMULATE/DYNAMIC, END=1, STEPS=1\n", adamslite.read(deck)
    )
    results = adamslite.simulate(adamslite.read(deck), commands=commands)
    assert results.outcome is adamslite.Outcome.NOT_FINITE
    assert results.message.startswith("SFORCE/1 (<text>:11:1)") and said in results.message
    with pytest.raises(RunFailed, match=r"SFORCE/1 \(<text>:11:1\)"):
        adamslite.linearize(adamslite.read(deck), time=0)
