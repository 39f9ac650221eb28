"""Write the bicycle of Meijaard et al. at three speeds, and its eigenvalues.

    M q" + v C1 q' + (g K0 + v^2 K2) q = 0,    q = (lean, steer)

the canonical equations of their appendix A; the matrices are compared with those that they print.
Axes of the paper: x forward, y to the right, z down; those of the deck: x forward, y to the left,
z up.
"""

from dataclasses import dataclass
from math import cos, pi, sin, tan
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
G, BASE, TRAIL, TILT = 9.81, 1.02, 0.08, pi / 10
SPEEDS = {"slow": 3.0, "stable": 5.0, "fast": 8.0}


@dataclass(frozen=True)
class Body:
    """Mass, centre (x, z) and moments of inertia in the axes of the paper."""

    mass: float
    x: float
    z: float
    xx: float
    yy: float
    zz: float
    xz: float = 0.0


REAR = Body(2.0, 0.0, -0.3, 0.0603, 0.12, 0.0603)
FRAME = Body(85.0, 0.3, -0.9, 9.2, 11.0, 2.8, 2.4)
FORK = Body(4.0, 0.9, -0.7, 0.05892, 0.06, 0.00708, -0.00756)
FRONT = Body(3.0, BASE, -0.35, 0.1405, 0.28, 0.1405)
#: The matrices that the paper prints in its section 5(b), rounded.
PRINTED = {
    "M": ((80.81722, 2.31941332208709), (2.31941332208709, 0.29784188199686)),
    "K0": ((-80.95, -2.59951685249872), (-2.59951685249872, -0.80329488458618)),
    "K2": ((0.0, 76.59734589573222), (0.0, 2.65431523794604)),
    "C1": ((0.0, 33.86641391492494), (-0.85035641456978, 1.68540397397560)),
}


def matrices():
    """M, C1, K0, K2 (equations A1 to A26)."""
    bodies = (REAR, FRAME, FORK, FRONT)
    mass = sum(b.mass for b in bodies)
    x = sum(b.mass * b.x for b in bodies) / mass
    z = sum(b.mass * b.z for b in bodies) / mass
    xx = sum(b.xx + b.mass * b.z**2 for b in bodies)
    xz = sum(b.xz - b.mass * b.x * b.z for b in bodies)
    zz = sum(b.zz + b.mass * b.x**2 for b in bodies)
    # The front assembly: fork and front wheel.
    m = FORK.mass + FRONT.mass
    xa = (FORK.x * FORK.mass + BASE * FRONT.mass) / m
    za = (FORK.z * FORK.mass + FRONT.z * FRONT.mass) / m
    axx = sum(b.xx + b.mass * (b.z - za) ** 2 for b in (FORK, FRONT))
    axz = sum(b.xz - b.mass * (b.x - xa) * (b.z - za) for b in (FORK, FRONT))
    azz = sum(b.zz + b.mass * (b.x - xa) ** 2 for b in (FORK, FRONT))
    s, c = sin(TILT), cos(TILT)
    u = (xa - BASE - TRAIL) * c - za * s
    ll = m * u**2 + axx * s**2 + 2 * axz * s * c + azz * c**2
    lx = -m * u * za + axx * s + axz * c
    lz = m * u * xa + axz * s + azz * c
    mu = TRAIL / BASE * c
    sr, sf = REAR.yy / -REAR.z, FRONT.yy / -FRONT.z
    st = sr + sf
    sa = m * u + mu * mass * x
    m12 = lx + mu * xz
    return {
        "M": np.array([[xx, m12], [m12, ll + 2 * mu * lz + mu**2 * zz]]),
        "K0": np.array([[mass * z, -sa], [-sa, -sa * s]]),
        "K2": np.array([[0, (st - mass * z) / BASE * c], [0, (sa + sf * s) / BASE * c]]),
        "C1": np.array(
            [[0, mu * st + sf * c + xz / BASE * c - mu * mass * z],
             [-(mu * st + sf * c), lz / BASE * c + mu * (sa + zz / BASE * c)]]
        ),
    }  # fmt: skip


def polynomial(speed):
    """Coefficients of det(M s^2 + v C1 s + g K0 + v^2 K2), highest first."""
    found = matrices()
    entries = np.stack(
        [found["M"], speed * found["C1"], G * found["K0"] + speed**2 * found["K2"]], axis=-1
    )
    (a, b), (c, d) = entries
    return np.polysub(np.polymul(a, d), np.polymul(b, c))


def eigenvalues(speed):
    """The four of lean and steer [1/s], by rising real part."""
    return np.sort_complex(np.roots(polynomial(speed)))


def limits():
    """Speeds [m/s] at which the weave and the capsize begin and cease to be stable."""
    from scipy.optimize import brentq

    def weave(v):
        return max(s.real for s in eigenvalues(v) if s.imag > 0)

    return brentq(weave, 4, 5, xtol=1e-13), brentq(
        lambda v: polynomial(v)[-1], 5.5, 6.5, xtol=1e-13
    )


def inertia(body):
    """IP of a part in the axes of the deck: x forward, y to the left, z up."""
    return ", ".join(f"{value:.12g}" for value in (body.xx, body.yy, body.zz, 0, body.xz, 0))


def wheel(number, name, body, carrier):
    """A wheel on an axle of its carrier and the two conditions of its contact with the road."""
    radius, n = -body.z, number
    return f"""
! ---- {name}: n is its axle, e points from its centre to the contact ----
PART/{n}, MASS={body.mass:g}, CM={n}0, IP={inertia(body)}
, QG={body.x:g},0,{radius:g}, VX={{speed:.17g}}, WY={{speed:.17g}}/{radius:g}
MARKER/{n}0, PART={n}
MARKER/{n}1, PART={n}, REULER=0,-90D,0
MARKER/{n}2, PART={carrier}, QP={{x{n}}}, REULER=0,-90D,0
MARKER/{n}3, PART={carrier}, QP={{y{n}}}
JOINT/{n}, REVOLUTE, I={n}1, J={n}2
VARIABLE/{n}1, FUNCTION=DX({n}3,{n}2)
VARIABLE/{n}2, FUNCTION=DY({n}3,{n}2)
VARIABLE/{n}3, FUNCTION=DZ({n}3,{n}2)
VARIABLE/{n}4, FUNCTION=SQRT(1-VARVAL({n}3)**2)
VARIABLE/{n}5, FUNCTION={radius:g}*VARVAL({n}3)*VARVAL({n}1)/VARVAL({n}4)
VARIABLE/{n}6, FUNCTION={radius:g}*VARVAL({n}3)*VARVAL({n}2)/VARVAL({n}4)
VARIABLE/{n}7, FUNCTION=-{radius:g}*VARVAL({n}4)
GCON/{n}1, FUNCTION=DZ({n}0)+VARVAL({n}7)
GCON/{n}2, FUNCTION=VX({n}0)+WY({n}0)*VARVAL({n}7)-WZ({n}0)*VARVAL({n}6)
GCON/{n}3, FUNCTION=VY({n}0)+WZ({n}0)*VARVAL({n}5)-WX({n}0)*VARVAL({n}7)
"""


def deck(speed):
    """The bicycle upright and straight ahead at `speed` [m/s]."""
    front, rear = (
        wheel(number, name, body, carrier)
        .replace(f"{{x{number}}}", f"{body.x:g},0,{-body.z:g}")
        .replace(f"{{y{number}}}", f"{body.x:g},1,{-body.z:g}")
        .replace(f"{{speed:.17g}}/{-body.z:g}", f"{speed / -body.z:.17g}")
        .replace("{speed:.17g}", f"{speed:.17g}")
        for number, name, body, carrier in (
            (5, "Front wheel", FRONT, 3), (4, "Rear wheel", REAR, 2)
        )
    )  # fmt: skip
    return f"""Bicycle without control at {speed:g} m/s
! Parameters of Meijaard et al. 2007, table 1; x forward, y to the left, z up.
! Wheels are discs with sharp rims that roll without slip. Written by make_reference.py
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-{G:g}

PART/1, GROUND
MARKER/1, PART=1

! ---- rear frame with rider; front frame: fork and handlebar ----
PART/2, MASS={FRAME.mass:g}, CM=20, IP={inertia(FRAME)}, VX={speed:.17g}
MARKER/20, PART=2, QP={FRAME.x:g},0,{-FRAME.z:g}
PART/3, MASS={FORK.mass:g}, CM=30, IP={inertia(FORK)}, VX={speed:.17g}
MARKER/30, PART=3, QP={FORK.x:g},0,{-FORK.z:g}
! The steering axis leans back by 18 degrees and meets the road {TRAIL:g} m ahead of the contact.
MARKER/21, PART=2, QP={{head}}, REULER=90D,-18D,-90D
MARKER/31, PART=3, QP={{head}}, REULER=90D,-18D,-90D
JOINT/2, REVOLUTE, I=31, J=21
{rear}{front}
END
""".format(head=f"{BASE + TRAIL - 0.9 * tan(TILT):.15g},0,0.9")


def main():
    """Compare the matrices, write the decks."""
    for name, printed in PRINTED.items():
        assert np.allclose(matrices()[name], printed, rtol=1e-12, atol=1e-12), name
    for name, speed in SPEEDS.items():
        (HERE / f"{name}.adm").write_text(deck(speed))
        (HERE / f"{name}.acf").write_text("SIMULATE/INITIAL\nLINEAR/EIGENSOL\nSTOP\n")
    assert np.allclose(limits(), (4.292, 6.024), atol=5e-4)


if __name__ == "__main__":
    main()
