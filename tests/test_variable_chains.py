"""VARIABLEs that are made of VARIABLEs: each is evaluated once, however often it is used.

    v_1 = 1.3 + 0.2 x        v_i = v_(i-1) sin v_(i-1)

As a tree v_n has 2^n leaves.  Values and rates are compared with the recursion in numpy, rates by a
complex step.
"""

from __future__ import annotations

import numpy as np
import pytest
from scenes import compiled, run

DECK = """Chain of variables
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1,0,0, VX=0.5
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=10, C=0.1, LENGTH=0.5
{chain}
VFORCE/1, I=2, J_PART=1, FY=VARVAL({n})
REQUEST/1, F2=VARVAL({n}), F3=VARVAL(d({n})/dt)
INTEGRATOR/GSTIFF, ERROR=1E-6
END
"""
OF_STATE, OF_TIME, CONSTANT = "1.3+0.2*DX(2,1)", "1.3+0.2*TIME", "1.3"


def deck(n: int, first: str, backwards: bool = False) -> str:
    """A chain of n variables."""
    rule = "VARIABLE/{i}, FUNCTION=VARVAL({j})*SIN(VARVAL({j}))"
    chain = [f"VARIABLE/1, FUNCTION={first}"]
    chain += [rule.format(i=i, j=i - 1) for i in range(2, n + 1)]
    return DECK.format(chain="\n".join(chain[::-1] if backwards else chain), n=n)


def last_of(n: int, first: np.ndarray) -> np.ndarray:
    """v_n from v_1."""
    v = first
    for _ in range(n - 1):
        v = v * np.sin(v)
    return v


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("n", [2, 14, 100])
@pytest.mark.parametrize("first", [OF_STATE, OF_TIME])
def test_value_and_rate_of_the_last_of_a_chain(n: int, first: str, backwards: bool) -> None:
    found = run(deck(n, first, backwards), 0.5, 10)
    step = 1e-30
    x, v = found["POINT_MASS/2.x"], found["POINT_MASS/2.vx"]
    of = (x, v) if first == OF_STATE else (found.time, np.ones(len(x)))
    along = last_of(n, 1.3 + 0.2 * (of[0] + 1j * step * of[1]))
    np.testing.assert_allclose(found["REQUEST/1.F2"], along.real, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(found["REQUEST/1.F3"], along.imag / step, rtol=1e-8, atol=1e-14)


def test_a_chain_of_constants_is_a_number() -> None:
    found = run(deck(100, CONSTANT), 0.1, 1)
    np.testing.assert_allclose(found["REQUEST/1.F2"], last_of(100, np.array(1.3)), rtol=1e-12)


@pytest.mark.parametrize("first", [OF_STATE, OF_TIME])
def test_native_code_grows_as_the_chain(first: str) -> None:
    """The force of twice as many variables is no more than twice the code and a little."""
    size = {}
    for n in (20, 40):
        groups = compiled(deck(n, first)).groups
        size[n] = max(len(group.code) for group in groups if group.face == "loads")
    assert size[40] < 2.2 * size[20]


def test_a_variable_of_a_measured_force_that_takes_a_variable() -> None:
    """A VARIABLE of the force of a VFORCE whose VARIABLE is made of another one: F = 3 a^2."""
    chain = (
        "VARIABLE/1, FUNCTION=1+TIME\nVARIABLE/2, FUNCTION=VARVAL(1)**2\n"
        "VFORCE/2, I=2, J_PART=1, FZ=3*VARVAL(2)\nVARIABLE/3, FUNCTION=VFORCE(2,0,4,1)"
    )
    text = DECK.format(chain=chain, n=3)
    found = run(text, 0.5, 5)
    np.testing.assert_allclose(found["REQUEST/1.F2"], 3.0 * (1.0 + found.time) ** 2, rtol=1e-12)
    np.testing.assert_allclose(found["VFORCE/1.fy"], found["REQUEST/1.F2"], rtol=1e-12)


def test_signals_are_evaluated_behind_those_that_they_take() -> None:
    """Shapes in turn: squares (1, 3) and sines (2, 4), each of the one before.  VARIABLE/3 has the
    shape of 1, and is evaluated behind 2.
    """
    chain = (
        "VARIABLE/4, FUNCTION=SIN(VARVAL(3))\nVARIABLE/3, FUNCTION=VARVAL(2)**2\n"
        "VARIABLE/2, FUNCTION=SIN(VARVAL(1))\nVARIABLE/1, FUNCTION=VARVAL(9)**2\n"
        "VARIABLE/9, FUNCTION=0.3+TIME"
    )
    found = run(DECK.format(chain=chain, n=4), 0.5, 5)
    step = 1e-30
    value = np.sin(np.sin((0.3 + found.time + 1j * step) ** 2) ** 2)
    np.testing.assert_allclose(found["REQUEST/1.F2"], value.real, rtol=1e-12)
    np.testing.assert_allclose(found["REQUEST/1.F3"], value.imag / step, rtol=1e-12)


def test_a_jump_in_a_chain_is_a_stop() -> None:
    """v_1 = IF(t - 0.3), v_2 = 2 v_1 + 1, v_3 = v_2 + v_1 v_2: 1 before, 28 from 0.3 on."""
    chain = (
        "VARIABLE/1, FUNCTION=IF(TIME-0.3: 0, 3, 3)\nVARIABLE/2, FUNCTION=2*VARVAL(1)+1\n"
        "VARIABLE/3, FUNCTION=VARVAL(2)+VARVAL(1)*VARVAL(2)\nDIFF/1, IC=0, FUNCTION=VARVAL(3)"
    )
    found = run(DECK.format(chain=chain, n=3), 1.0, 4)
    assert found["REQUEST/1.F2"] == pytest.approx([1, 1, 28, 28, 28])
    late = np.maximum(found.time - 0.3, 0.0)
    np.testing.assert_allclose(found["DIFF/1"], found.time + 27.0 * late, atol=1e-5)
