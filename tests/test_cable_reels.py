"""`adamslite cable`: reels, whose radius changes with what they hold, against closed forms."""

from math import pi

import numpy as np
import pytest
from descriptions import G, solve

import adamslite
from adamslite.cables.deck.scene import deck

HOIST = """
end = 4
steps = 80
[cable]
EA = 1e7
rho = 0.1
[[route]]
kind = "winch"
at = [-0.3, 0, 0]
radius = 0.3
inertia = 0.5
turn = -1
reel = { thickness = 0.02, core = 0.1 }
payout = "STEP5(TIME,0,0,4,6)"
[[route]]
kind = "mass"
at = [0, -4, 0]
mass = 50
[model]
level = 1
"""
CORE = "reel = { thickness = 0.02, core = 0.1 }"
BETWEEN = """
[[route]]
kind = "winch"
at = [2, 0, 0]
radius = 0.2
inertia = 1
torque = "0"
reel = { thickness = 0.02, core = 0.1 }
[[route]]
kind = "mass"
at = [2.2, -3, 0]
mass = 50
"""


def test_a_reel_turns_by_a_spiral() -> None:
    """r^2 = r0^2 - h s/pi and a = 2 pi (r0 - r)/h for the payout s; the weight goes down by s.

    The constraint holds to ERROR = 1e-7 l = 4e-7 m: of the radius h/(2 pi r) = 0.02 of that, of
    the angle 1/r = 8.5 1/m.  The winch pulls with M (g - s") besides what its own inertia takes,
    (J + J_pack) w'/r, J_pack = rho pi (r^4 - c^4)/(2 h).
    """
    results = solve(HOIST)
    x = results.time / 4
    s, speed = 6 * x**3 * (10 - 15 * x + 6 * x**2), 6 * 30 * x**2 * (1 - x) ** 2 / 4
    change = 6 * 60 * x * (1 - x) * (1 - 2 * x) / 16
    r = np.sqrt(0.3**2 - 0.02 * s / pi)
    np.testing.assert_allclose(results["REQUEST/10.F2"], s, atol=4e-7)
    np.testing.assert_allclose(results["POINT_MASS/20.y"], -4 - s, atol=8e-7)
    np.testing.assert_allclose(results["VARIABLE/R_10"], r, atol=1e-7)
    np.testing.assert_allclose(results["PART/10.wz"], -speed / r, atol=1e-4)
    spin = change / r + 0.02 / (2 * pi) * speed**2 / r**3
    pack = 0.1 * pi * (r**4 - 0.1**4) / 2 / 0.02
    pull = 50 * (G - change) - (0.5 + pack) * spin / r
    np.testing.assert_allclose(results["REQUEST/10.F6"], pull, rtol=1e-5)


def test_tape_from_reel_to_reel_takes_its_energy_along() -> None:
    """The kinetic energy of both reels is the work of the motor, M times its angle.

    With r w = v on both, d(J w^2/2)/dt = w (torque) -+ rho v^3/2: what the tape takes off one reel
    it brings to the other.  The constraint holds to ERROR = 1e-8 m over steps of some 10 ms: 1e-6
    m/s of 9 m/s at the end, twice as much of the energy.
    """
    results = solve(
        """
        gravity = [0, 0, 0]
        end = 2
        steps = 100
        error = 1e-8
        [cable]
        EA = 2e4
        rho = 0.01
        [[route]]
        kind = "winch"
        at = [0, 0, 0]
        radius = 0.2
        inertia = 0.01
        turn = 1
        reel = { thickness = 0.001, core = 0.05 }
        torque = "0"
        [[route]]
        kind = "winch"
        at = [1, 0, 0]
        radius = 0.1
        inertia = 0.01
        turn = 1
        reel = { thickness = 0.001, core = 0.05 }
        torque = "1"
        [model]
        level = 1
        """
    )
    energy = sum(
        (0.01 + results[f"VARIABLE/J_{n}"]) * results[f"PART/{n}.wz"] ** 2 / 2 for n in (10, 20)
    )
    r = results["VARIABLE/R_20"]
    work = (r - 0.1) * 2 * pi / 0.001
    np.testing.assert_allclose(energy, work, rtol=1e-6, atol=1e-6 * work[-1])


def told(spec: str) -> list[tuple[str, int, int]]:
    """Codes of all messages about a description, and where they stand."""
    with pytest.raises(adamslite.DeckError) as fault:
        deck(spec)
    for each in fault.value.diagnostics:
        assert each.source_line == spec.splitlines()[each.span.line - 1]
        assert each.hint
    return [(each.code, each.span.line, each.span.column) for each in fault.value.diagnostics]


@pytest.mark.parametrize(
    ("new", "code"),
    [
        ("reel = { thickness = 0.02, core = 0.3 }", "reel-core"),
        ("reel = { thickness = 0.02 }", "missing-key"),
        ("reel = { thickness = 0.02, core = 0.1, width = 1 }", "unknown-key"),
        ("reel = { thickness = -0.02, core = 0.1 }", "not-positive"),
        ("reel = 0.02", "wrong-value"),
        ("reel = { thickness = 0.05, core = 0.1 }", "stored-too-little"),
    ],
)
def test_a_reel_that_cannot_be(new: str, code: str) -> None:
    """The last of them holds pi (0.3^2 - 0.1^2)/0.05 = 5.03 m, and 6 m are paid out."""
    assert told(HOIST.replace(CORE, new)) == [(code, 13, 1)]


def test_a_reel_does_not_pass_cable_on() -> None:
    """It stands at an end of the route, and a winch between ends is none."""
    cut = HOIST.rindex("[[route]]")
    spec = HOIST[:cut] + BETWEEN.lstrip() + HOIST[HOIST.index("[model]") :]
    assert told(spec) == [("reel-between", 21, 1)]
