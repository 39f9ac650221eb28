"""Random decks with closed forms: what a bound can be held against.

Each family draws its parameters from a generator of random numbers and gives a deck, the columns
whose exact values are known, and how long to run.  Lengths in m, masses in kg, times in s.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import asin, atan2, cos, cosh, exp, pi, sin, sinh, sqrt, tanh

import numpy as np
from scipy.special import ellipj, ellipk

Random = np.random.Generator
Exact = Callable[[float], float]

GROUND = "closed form\nPART/1, GROUND\nMARKER/1, PART=1\n"
MASS = GROUND + "POINT_MASS/2, MASS={m!r}, CM=2, QG={x!r},0,0, VX={v!r}\nMARKER/2, POINT_MASS=2\n"


@dataclass(frozen=True)
class Known:
    """A deck, the exact values of some columns as functions of time, the end and the steps."""

    deck: str
    exact: dict[str, Exact]
    end: float
    steps: int = 50


FAMILIES: list[Callable[[Random], Known]] = []


def family(make: Callable[[Random], Known]) -> Callable[[Random], Known]:
    """Add a family to the list."""
    FAMILIES.append(make)
    return make


def spread(rng: Random, low: float, high: float) -> float:
    """A number between two others, even in its logarithm."""
    return float(low * (high / low) ** rng.random())


def mass(rng: Random, force: str, x: float = 0.0, v: float = 0.0, m: float = 1.0) -> str:
    """A point mass under a force along x."""
    return MASS.format(m=m, x=x, v=v) + f"VFORCE/1, I=2, J_PART=1, FX={force}\nEND\n"


def along_x(x: Exact, v: Exact) -> dict[str, Exact]:
    """Position and velocity of that mass."""
    return {"POINT_MASS/2.x": x, "POINT_MASS/2.vx": v}


def damped(t: float, x0: float, v0: float, w: float, z: float) -> tuple[float, float]:
    """x and v of x'' + 2 z w x' + w^2 x = 0, z < 1."""
    d = w * sqrt(1.0 - z * z)
    c, s, e = cos(d * t), sin(d * t), exp(-z * w * t)
    b = (v0 + z * w * x0) / d
    return e * (x0 * c + b * s), e * ((b * d - z * w * x0) * c - (x0 * d + z * w * b) * s)


@family
def oscillator(rng: Random) -> Known:
    """Spring and damper."""
    w, z, m = spread(rng, 0.5, 200.0), float(rng.uniform(0.0, 0.7)), spread(rng, 0.1, 100.0)
    x0, v0 = float(rng.uniform(-1, 1)), float(rng.uniform(-1, 1)) * w
    force = f"-{m * w * w!r}*DX(2)-{2 * z * w * m!r}*VX(2)"
    return Known(
        mass(rng, force, x0, v0, m),
        along_x(lambda t: damped(t, x0, v0, w, z)[0], lambda t: damped(t, x0, v0, w, z)[1]),
        spread(rng, 2.0, 60.0) / w,
    )


@family
def driven(rng: Random) -> Known:
    """Spring, damper and a force A cos(p t)."""
    w, z, p = spread(rng, 0.5, 50.0), float(rng.uniform(0.02, 0.7)), spread(rng, 0.3, 80.0)
    A = float(rng.uniform(-5, 5)) * w * w
    gap, loss = w * w - p * p, 2.0 * z * w * p
    size, lag = A / sqrt(gap * gap + loss * loss), atan2(loss, gap)

    def state(t: float) -> tuple[float, float]:
        x, v = damped(t, -size * cos(lag), -size * p * sin(lag), w, z)
        return x + size * cos(p * t - lag), v - size * p * sin(p * t - lag)

    force = f"-{w * w!r}*DX(2)-{2 * z * w!r}*VX(2)+({A!r})*COS({p!r}*TIME)"
    exact = along_x(lambda t: state(t)[0], lambda t: state(t)[1])
    return Known(mass(rng, force), exact, spread(rng, 2.0, 40.0) / w)


@family
def fall(rng: Random) -> Known:
    """Free fall against a drag of c v^2."""
    g, c = spread(rng, 1.0, 20.0), spread(rng, 0.01, 2.0)
    v, k = sqrt(g / c), sqrt(g * c)
    force = f"{g!r}-{c!r}*VX(2)*ABS(VX(2))"
    return Known(
        mass(rng, force),
        along_x(lambda t: float(np.log(cosh(k * t))) / c, lambda t: v * tanh(k * t)),
        spread(rng, 0.5, 8.0) / k,
    )


@family
def pendulum(rng: Random) -> Known:
    """A rod on a pivot, let go at an angle: sin(a/2) = k sn(K - w t)."""
    length, m, top = spread(rng, 0.1, 10.0), spread(rng, 0.1, 10.0), float(rng.uniform(0.2, 2.9))
    inertia = m * length**2 * float(rng.uniform(0.01, 1.0))
    w, k = sqrt(m * 9.81 * length / (inertia + m * length**2)), sin(top / 2)
    quarter = ellipk(k * k)

    def angle(t: float) -> float:
        return 2.0 * asin(k * float(ellipj(quarter - w * t, k * k)[0]))

    x, y = length * sin(top), -length * cos(top)
    deck = (
        GROUND + f"ACCGRAV/JGRAV=-9.81\nPART/2, MASS={m!r}, CM=2, QG={x!r},{y!r},0, "
        f"IP={inertia!r},{inertia!r},{inertia!r}\nMARKER/2, PART=2\n"
        f"MARKER/3, PART=2, QP={-x!r},{-y!r},0\nJOINT/1, REVOLUTE, I=3, J=1\nEND\n"
    )
    exact = {
        "PART/2.x": lambda t: length * sin(angle(t)),
        "PART/2.y": lambda t: -length * cos(angle(t)),
        "JOINT/1.fz": lambda t: 0.0,
    }
    return Known(deck, exact, spread(rng, 1.0, 20.0) / w)


@family
def rotor(rng: Random) -> Known:
    """A symmetric rotor without torque: its w turns about the angular momentum H at |H|/A."""
    a, c = spread(rng, 0.01, 1.0), spread(rng, 0.01, 1.0)
    wx, wz = float(rng.uniform(-3, 3)), spread(rng, 1.0, 60.0)
    h = np.array([a * wx, 0.0, c * wz])
    size = float(np.linalg.norm(h))
    axis, turn = h / size, size / a

    def spin(t: float) -> np.ndarray:
        r, k, angle = np.array([wx, 0.0, wz]), axis, turn * t
        return r * cos(angle) + np.cross(k, r) * sin(angle) + k * (k @ r) * (1.0 - cos(angle))

    deck = (
        GROUND + f"PART/2, MASS=1, CM=2, IP={a!r},{a!r},{c!r}, WX={wx!r}, WZ={wz!r}\n"
        "MARKER/2, PART=2\nEND\n"
    )
    exact = {f"PART/2.w{n}": lambda t, k=k: float(spin(t)[k]) for k, n in enumerate("xyz")}
    return Known(deck, exact, spread(rng, 3.0, 60.0) / turn)


@family
def rheonomic(rng: Random) -> Known:
    """A pivot that is driven."""
    size, p, length = float(rng.uniform(-2, 2)), spread(rng, 0.3, 20.0), spread(rng, 0.1, 3.0)
    inertia = spread(rng, 0.01, 1.0)

    def angle(t: float) -> float:
        return size * sin(p * t)

    deck = (
        GROUND + f"ACCGRAV/JGRAV=-9.81\nPART/2, MASS=2, CM=2, QG={length!r},0,0, "
        f"IP={inertia!r},{inertia!r},{inertia!r}\nMARKER/2, PART=2\n"
        f"MARKER/3, PART=2, QP={-length!r},0,0\nJOINT/1, REVOLUTE, I=3, J=1\n"
        f"MOTION/1, JOINT=1, ROTATION, FUNCTION=({size!r})*SIN({p!r}*TIME)\nEND\n"
    )
    exact = {
        "PART/2.x": lambda t: length * cos(angle(t)),
        "PART/2.vy": lambda t: length * cos(angle(t)) * size * p * cos(p * t),
        "PART/2.alz": lambda t: -size * p * p * sin(p * t),
    }
    return Known(deck, exact, spread(rng, 3.0, 60.0) / p)


def bouncing(t: float, period: float, touch: float, w: float, v: float) -> tuple[float, float]:
    """A mass thrown up with v under 9.81 onto a spring m w^2 without loss, from the contact."""
    t = t % (period + touch)
    if t <= period:
        return v * t - 0.5 * 9.81 * t * t, v - 9.81 * t
    s, g = t - period, 9.81 / w**2
    return -g + g * cos(w * s) - v / w * sin(w * s), -g * w * sin(w * s) - v * cos(w * s)


@family
def bounce(rng: Random) -> Known:
    """Impacts on a linear spring without loss."""
    w, v = spread(rng, 30.0, 2000.0), spread(rng, 0.5, 5.0)
    period = 2.0 * v / 9.81
    touch = 2.0 * (pi - atan2(v / w, 9.81 / w**2)) / w
    force = f"-9.81-{w * w!r}*MIN(DX(2),0)"
    return Known(
        mass(rng, force, 0.0, v),
        along_x(
            lambda t: bouncing(t, period, touch, w, v)[0],
            lambda t: bouncing(t, period, touch, w, v)[1],
        ),
        float(rng.uniform(1.0, 6.0)) * (period + touch),
    )


@family
def added(rng: Random) -> Known:
    """A force -d a beside a spring: w^2 = k/(m + d)."""
    m, d, w = spread(rng, 0.2, 5.0), spread(rng, 0.01, 5.0), spread(rng, 0.5, 50.0)
    x0 = float(rng.uniform(-2, 2))
    force = f"-{d!r}*ACCX(2)-{(m + d) * w * w!r}*DX(2)"
    return Known(
        mass(rng, force, x0, 0.0, m),
        along_x(lambda t: x0 * cos(w * t), lambda t: -x0 * w * sin(w * t)),
        spread(rng, 2.0, 40.0) / w,
    )


@family
def window(rng: Random) -> Known:
    """A short stretch of the way in which a force acts; outside none."""
    v, at, half = spread(rng, 2.0, 20.0), float(rng.uniform(1, 9)), spread(rng, 0.01, 0.3)
    a = float(rng.uniform(-0.4, 1.0)) * v * v / (4.0 * half)
    start, late = (at - half) / v, sqrt(v * v + 4.0 * a * half)
    stay = (late - v) / a

    def state(t: float) -> tuple[float, float]:
        s = t - start
        if s <= 0.0:
            return v * t, v
        if s <= stay:
            return at - half + v * s + 0.5 * a * s * s, v + a * s
        return at + half + late * (s - stay), late

    exact = along_x(lambda t: state(t)[0], lambda t: state(t)[1])
    return Known(
        mass(rng, f"IF(ABS(DX(2)-{at!r})-{half!r}:{a!r},0,0)", 0.0, v), exact, 10.0 / v, 10
    )


@family
def unstable(rng: Random) -> Known:
    """x'' = k^2 x: what is a little off at the start grows a thousandfold and more."""
    k, x0, v0 = spread(rng, 0.5, 5.0), float(rng.uniform(-1, 1)), float(rng.uniform(-1, 1))
    return Known(
        mass(rng, f"{k * k!r}*DX(2)", x0, v0),
        along_x(
            lambda t: x0 * cosh(k * t) + v0 / k * sinh(k * t),
            lambda t: x0 * k * sinh(k * t) + v0 * cosh(k * t),
        ),
        float(rng.uniform(3.0, 15.0)) / k,
    )


@family
def orbit(rng: Random) -> Known:
    """Kepler's ellipse, from its nearest point."""
    e = float(rng.uniform(0.0, 0.9))
    v = sqrt((1.0 + e) / (1.0 - e))

    def anomaly(t: float) -> float:
        x = t + e * sin(t)
        for _ in range(60):
            x -= (x - e * sin(x) - t) / (1.0 - e * cos(x))
        return x

    pull = "-DX(2)/DM(2,1)**3\\FY=-DY(2)/DM(2,1)**3\\FZ=0"
    deck = mass(rng, pull, 1.0 - e).replace("VX=0.0", f"VY={v!r}")
    exact = {
        "POINT_MASS/2.x": lambda t: cos(anomaly(t)) - e,
        "POINT_MASS/2.y": lambda t: sqrt(1.0 - e * e) * sin(anomaly(t)),
    }
    return Known(deck, exact, float(rng.uniform(2.0, 30.0)))


@family
def pulse(rng: Random) -> Known:
    """A force between two times."""
    on, width = float(rng.uniform(0.5, 8.0)), spread(rng, 0.002, 1.0)
    f = float(rng.uniform(-1, 1)) / width
    off = on + width
    return Known(
        mass(rng, f"IF(TIME-{on!r}:0,0,IF(TIME-{off!r}:{f!r},0,0))"),
        along_x(
            lambda t: 0.5 * f * (max(0.0, t - on) ** 2 - max(0.0, t - off) ** 2),
            lambda t: f * (max(0.0, t - on) - max(0.0, t - off)),
        ),
        10.0,
    )


@family
def decay(rng: Random) -> Known:
    """Two states of DIFF, one behind the other."""
    a, b = spread(rng, 0.1, 20.0), spread(rng, 21.0, 500.0)
    deck = (
        GROUND + "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
        f"DIFF/1, IC=1, FUNCTION=-{a!r}*DIF(1)\n"
        f"DIFF/2, IC=0, FUNCTION={b!r}*(DIF(1)-DIF(2))\nEND\n"
    )
    exact = {
        "DIFF/1": lambda t: exp(-a * t),
        "DIFF/2": lambda t: b / (b - a) * (exp(-a * t) - exp(-b * t)),
    }
    return Known(deck, exact, spread(rng, 0.5, 10.0) / a)


@family
def dead_zone(rng: Random) -> Known:
    """Springs on both sides of a gap: half a vibration there, straight in between."""
    w, gap, reach = spread(rng, 5.0, 200.0), spread(rng, 0.01, 0.3), spread(rng, 0.05, 1.0)
    v, swing = w * reach, pi / w
    across = 2.0 * gap / v

    def state(t: float) -> tuple[float, float]:
        t += 0.5 * swing
        half, s = divmod(t, swing + across)
        side = -1.0 if int(half) % 2 else 1.0
        if s <= swing:
            return side * (gap + reach * sin(w * s)), side * v * cos(w * s)
        return side * (gap - v * (s - swing)), -side * v

    force = f"-{w * w!r}*MAX(ABS(DX(2))-{gap!r},0)*SIGN(1,DX(2))"
    exact = along_x(lambda t: state(t)[0], lambda t: state(t)[1])
    return Known(mass(rng, force, gap + reach), exact, float(rng.uniform(1, 12)) * (swing + across))


@family
def coupled(rng: Random) -> Known:
    """Two masses between three springs: in phase at w, against each other at w sqrt(1 + 2 r)."""
    w, r, x = spread(rng, 0.5, 30.0), spread(rng, 0.1, 500.0), float(rng.uniform(-1, 1))
    p, k = w * sqrt(1.0 + 2.0 * r), w * w
    deck = (
        MASS.format(m=1.0, x=x, v=0.0) + "POINT_MASS/3, MASS=1, CM=3\nMARKER/3, POINT_MASS=3\n"
        f"VFORCE/1, I=2, J_PART=1, FX=-{k!r}*DX(2)-{k * r!r}*DX(2,3)\n"
        f"VFORCE/2, I=3, J_PART=1, FX=-{k!r}*DX(3)-{k * r!r}*DX(3,2)\nEND\n"
    )
    exact = {
        "POINT_MASS/2.x": lambda t: 0.5 * x * (cos(w * t) + cos(p * t)),
        "POINT_MASS/3.x": lambda t: 0.5 * x * (cos(w * t) - cos(p * t)),
    }
    return Known(deck, exact, spread(rng, 2.0, 40.0) / w)
