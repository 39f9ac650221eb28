"""Random problems of motions: bodies that only turn, errors that grow, a small scale in a large."""

from __future__ import annotations

from cmath import exp as cexp
from collections.abc import Callable
from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np

from benchmarks.posed import (
    ANGLE,
    LENGTH,
    RATE,
    RELATIVE,
    Draw,
    Posed,
    Values,
    family,
)


def rotor(draw: Draw, number: int, inertia: float, spin: float = 0.0, angle: float = 0.0) -> None:
    """A part on a revolute about z of ground."""
    turned = f", REULER={angle!r},0,0" if angle else ""
    spun = f", WZ={spin!r}" if spin else ""
    draw.add(
        f"PART/{number}, MASS=1, CM={number}, IP=1,1,{inertia!r}{turned}{spun}",
        f"MARKER/{number}, PART={number}",
        f"MARKER/{100 + number}, PART=1",
        f"JOINT/{number}, REVOLUTE, I={number}, J={100 + number}",
    )


def driven_oscillator(
    m: float, c: float, k: float, load: float, pulse: float, beat: float
) -> Callable[[float], Values]:
    """Place and speed of m x'' + c x' + k x = load + pulse sin(beat t), from rest, underdamped."""
    answer = pulse / complex(k - m * beat * beat, c * beat)
    root = complex(-c / (2 * m), sqrt(k / m - (c / (2 * m)) ** 2))
    x0, v0 = -load / k - answer.imag, -beat * answer.real
    free = complex(x0, -(v0 - root.real * x0) / root.imag)

    def show(t: float) -> Values:
        forced, fades = answer * cexp(1j * beat * t), free * cexp(root * t)
        return load / k + forced.imag + fades.real, (1j * beat * forced).imag + (root * fades).real

    return show


@family("rotating")
def drive_train(draw: Draw) -> Posed:
    """An inertia on an elastic shaft behind a motor of constant speed, under a load that pulses."""
    speed, inertia = draw.between(20, 200), draw.decade(-2.5, 0)
    rate = draw.decade(1.5, 3)
    k = float(f"{inertia * rate * rate:.4g}")
    c = float(f"{2 * inertia * rate * draw.decade(-3, -1.3):.4g}")
    load, pulse, beat = k * draw.decade(-3, -1.5), k * draw.decade(-4, -2), draw.between(0.3, 3)
    load, pulse, beat = (float(f"{each:.4g}") for each in (load, pulse, beat * rate))
    end = float(f"{2 * pi / rate * draw.between(5, 80):.4g}")
    rotor(draw, 2, 0.02, speed)
    draw.add(f"MOTION/1, JOINT=2, ROTATION, FUNCTION={speed!r}*TIME")
    rotor(draw, 3, inertia, speed)
    draw.add(
        f"SPRINGDAMPER/1, ROTATIONAL, I=3, J=2, KT={k!r}, CT={c!r}",
        f"SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=103"
        f", FUNCTION=-{load!r}-{pulse!r}*SIN({beat!r}*TIME)",
    )
    draw.measure(RELATIVE, "AZ(3,2)")
    draw.measure(RATE, "WZ(3,2)")

    return draw.closed(end, driven_oscillator(inertia, c, k, -load, -pulse, beat))


@family("rotating")
def free_body(draw: Draw) -> Posed:
    """A body without forces: Euler's equations, also about its middle axis."""
    a, b = draw.between(1, 2), draw.between(1, 2)
    inertia = [a, a + b * draw.between(0.1, 0.9), a + b * draw.between(0.1, 0.9)]
    if draw.chance(0.5):
        inertia = sorted(inertia)
    i1, i2, i3 = (float(f"{each:.4g}") for each in inertia)
    w = [draw.decade(-3, 0), draw.between(2, 10), draw.decade(-3, 0)]
    w = [w[k] for k in draw.rng.permutation(3)]
    end = draw.between(2, 15)
    draw.add(
        f"PART/2, MASS=1, CM=2, IP={i1!r},{i2!r},{i3!r}, WX={w[0]!r}, WY={w[1]!r}, WZ={w[2]!r}",
        "MARKER/2, PART=2",
    )
    for axis in "XYZ":
        draw.measure(RATE, f"W{axis}(2,1,2)")

    def law(_: float, y: np.ndarray) -> Values:
        p, q, r = y
        return (i2 - i3) / i1 * q * r, (i3 - i1) / i2 * r * p, (i1 - i2) / i3 * p * q

    return draw.integrated(end, law, w, lambda _, y: tuple(y), lambda _t, _y: 0.01)


@family("rotating")
def torsion(draw: Draw) -> Posed:
    """A rotor on a torsion spring, for many periods."""
    rate, inertia, at = draw.decade(0.5, 2.3), draw.decade(-2, 1), draw.decade(-3, 0)
    k = float(f"{inertia * rate * rate:.5g}")
    rotor(draw, 2, inertia, angle=at)
    draw.add(f"SPRINGDAMPER/1, ROTATIONAL, I=2, J=102, KT={k!r}")
    draw.measure(ANGLE, "AZ(2,1)")
    true = sqrt(k / inertia)
    end = float(f"{2 * pi / true * draw.decade(0.5, 2.3):.5g}")
    return draw.closed(end, lambda t: (at * cos(true * t),))


@family("rotating")
def three_discs(draw: Draw) -> Posed:
    """Three discs on two shafts that turn freely as a whole: modes."""
    inertia = [draw.decade(-2, 0) for _ in range(3)]
    k = [draw.decade(1, 5), draw.decade(1, 5)]
    spins = [draw.between(-20, 60) for _ in range(3)]
    for n in range(3):
        rotor(draw, 2 + n, inertia[n], spins[n])
    for n in range(2):
        draw.add(f"SPRINGDAMPER/{n + 1}, ROTATIONAL, I={n + 3}, J={n + 2}, KT={k[n]!r}")
    draw.measure(ANGLE, "AZ(2,1)")
    draw.measure(RELATIVE, "AZ(3,2)")
    draw.measure(RELATIVE, "AZ(4,3)")
    root = np.sqrt(inertia)
    stiff = np.array([[k[0], -k[0], 0], [-k[0], k[0] + k[1], -k[1]], [0, -k[1], k[1]]])
    squares, modes = np.linalg.eigh(stiff / np.outer(root, root))
    rates = np.sqrt(np.maximum(squares, 0.0))
    rates[0] = 0.0
    amounts = modes.T @ (root * np.array(spins))
    end = float(f"{2 * pi / rates[2] * draw.between(5, 60):.4g}")

    def show(t: float) -> Values:
        parts = [amounts[0] * t, *(amounts[j] * sin(rates[j] * t) / rates[j] for j in (1, 2))]
        q = (modes @ np.array(parts)) / root
        return q[0], q[1] - q[0], q[2] - q[1]

    return draw.closed(end, show)


def cardan(draw: Draw, bend: float, spin: float, lead: float) -> None:
    """Two shafts joined by a universal joint, the second bent away; axes as they start."""
    first = spin * ratio(0.0, bend)
    draw.add(
        f"PART/2, MASS=1, CM=20, IP=.01,.01,{lead!r}, WZ={spin!r}",
        "MARKER/20, PART=2",
        f"PART/3, MASS=1, CM=30, REULER=0,{bend!r},0, IP=.02,.02,.03, WZ={first!r}",
        "MARKER/30, PART=3",
        f"MARKER/31, PART=1, REULER=0,{bend!r},0",
        "MARKER/22, PART=2, REULER=0,90D,0",
        "MARKER/32, PART=3, ZP=1,0,0, XP=0,0,1",
        "JOINT/1, REVOLUTE, I=20, J=1",
        "JOINT/2, REVOLUTE, I=30, J=31",
        "JOINT/3, UNIVERSAL, I=22, J=32",
    )
    draw.measure(ANGLE, "AZ(30,31)")


def driven(angle: float, bend: float) -> float:
    """Angle of the driven shaft: tan(driven) = tan(angle) / cos(bend), with the turns."""
    turns = 2 * pi * round(angle / (2 * pi))
    return turns + atan2(sin(angle) / cos(bend), cos(angle))


def ratio(angle: float, bend: float) -> float:
    """Speed of the driven shaft by that of the first."""
    return cos(bend) / (1.0 - (sin(bend) * cos(angle)) ** 2)


@family("rotating")
def cardan_driven(draw: Draw) -> Posed:
    """A universal joint behind a MOTION of constant speed."""
    bend, spin = draw.between(0.1, 0.9), draw.between(3, 60)
    # With the first cross arm along the common normal the driven shaft leads: tan / cos.
    cardan(draw, bend, float(spin), 0.01)
    draw.add(f"MOTION/1, JOINT=1, ROTATION, FUNCTION={spin!r}*TIME")
    return draw.closed(
        float(f"{2 * pi / spin * draw.between(1, 8):.4g}"), lambda t: (driven(spin * t, bend),)
    )


@family("rotating")
def cardan_coasting(draw: Draw) -> Posed:
    """Two inertias joined by a universal joint, without a drive: energy gives the speed."""
    bend, spin, lead = draw.between(0.1, 0.9), draw.between(3, 60), draw.decade(-3, -1)
    cardan(draw, bend, spin, lead)
    draw.measure(ANGLE, "AZ(20,1)")
    end = float(f"{2 * pi / spin * draw.between(1, 8):.4g}")

    def law(_: float, y: np.ndarray) -> Values:
        carried = (lead + 0.03 * ratio(0.0, bend) ** 2) / (lead + 0.03 * ratio(y[0], bend) ** 2)
        return (spin * sqrt(carried),)

    return draw.integrated(
        end, law, (0.0,), lambda _, y: (driven(y[0], bend), y[0]),
        lambda _t, _y: 0.02 / spin,
    )  # fmt: skip


def kepler(mean: float, e: float) -> float:
    """Eccentric anomaly by Newton's iteration."""
    turns = 2 * pi * round(mean / (2 * pi))
    m, anomaly = mean - turns, pi if e > 0.8 else mean - turns
    if m < 0:
        anomaly = -abs(anomaly)
    for _ in range(100):
        change = (anomaly - e * sin(anomaly) - m) / (1.0 - e * cos(anomaly))
        anomaly -= change
        if abs(change) < 1e-15:
            break
    return turns + anomaly


@family("amplifying")
def orbit(draw: Draw) -> Posed:
    """Kepler's orbit, in a plane that leans."""
    e, a, mu = draw.between(0.2, 0.95), draw.decade(-0.5, 2), draw.decade(-1, 3)
    e = float(f"{e:.4g}")
    x, v = float(f"{a * (1 - e):.8g}"), float(f"{sqrt(mu * (1 + e) / (a * (1 - e))):.12g}")
    e, a = x * v * v / mu - 1.0, x / (2.0 - x * v * v / mu)
    rate = sqrt(mu / a**3)
    end = float(f"{2 * pi / rate * draw.between(1, 8):.5g}")
    draw.mass(2, 1.0, f"{x!r},0,0", f", VY={v!r}")
    draw.add(f"SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-{mu!r}/DM(2,1)**2")
    draw.measure(LENGTH, "DX(2)")
    draw.measure(LENGTH, "DY(2)")

    def show(t: float) -> Values:
        anomaly = kepler(rate * t, e)
        return a * (cos(anomaly) - e), a * sqrt(1.0 - e * e) * sin(anomaly)

    return draw.closed(end, show, draw.whole(20, 100))


@family("amplifying")
def chain_of_bars(draw: Draw) -> Posed:
    """One to three bars that swing, double pendulums among them; equations of Lagrange."""
    count, end = draw.whole(1, 3), draw.between(3, 12)
    mass = [draw.between(0.5, 2) for _ in range(count)]
    length = [draw.between(0.4, 1.2) for _ in range(count)]
    inertia = [m * le * le / 12 for m, le in zip(mass, length, strict=True)]
    inertia = [float(f"{each:.4g}") for each in inertia]
    angle = [draw.between(-3.0, 0.3) for _ in range(count)]
    draw.add("ACCGRAV/JGRAV=-9.81", "MARKER/10, PART=1")
    x = y = 0.0
    for n in range(count):
        moment = f"{inertia[n]!r},{inertia[n]!r},{inertia[n]!r}"
        body, k = n + 2, 10 * (n + 2)
        draw.add(
            f"PART/{body}, MASS={mass[n]!r}, CM={k + 1}, IP={moment}, QG={x!r},{y!r},0"
            f", REULER={angle[n]!r},0,0",
            f"MARKER/{k}, PART={body}",
            f"MARKER/{k + 1}, PART={body}, QP={length[n] / 2!r},0,0",
            f"MARKER/{k + 2}, PART={body}, QP={length[n]!r},0,0",
            f"JOINT/{n + 1}, REVOLUTE, I={k}, J={10 if n == 0 else k - 8}",
        )
        x, y = x + length[n] * cos(angle[n]), y + length[n] * sin(angle[n])
    last = 10 * (count + 1) + 2
    draw.measure(LENGTH, f"DX({last})")
    draw.measure(LENGTH, f"DY({last})")
    m, le, i = np.array(mass), np.array(length), np.diag(inertia)
    # Share of bar k in the place of the centre of bar j: 1 above it, 1/2 in it.
    reach = (np.tril(np.ones((count, count)), -1) + 0.5 * np.eye(count)) * le
    drag = np.einsum("j,jk,jl->kl", m, reach, reach)
    weight = -9.81 * m @ reach

    def law(_: float, s: np.ndarray) -> Values:
        q, u = s[:count], s[count:]
        apart = q[:, None] - q[None, :]
        push = weight * np.cos(q) - (drag * np.sin(apart)) @ (u * u)
        return np.concatenate([u, np.linalg.solve(drag * np.cos(apart) + i, push)])

    def show(_: float, s: np.ndarray) -> Values:
        return float(le @ np.cos(s[:count])), float(le @ np.sin(s[:count]))

    return draw.integrated(end, law, [*angle, *([0.0] * count)], show,
                           lambda _t, _y: 0.02)  # fmt: skip


@family("amplifying")
def inverted_pendulum(draw: Draw) -> Posed:
    """A bar that stands almost upright and falls, with or without damping, over and over."""
    arm, tilt, end = draw.between(0.3, 1.5), draw.decade(-6, -1), draw.between(3, 15)
    inertia, c = float(f"{arm * arm * draw.between(0.05, 0.5):.4g}"), draw.decade(-3, 0)
    c *= draw.chance(0.5)
    whole = inertia + arm * arm
    draw.add(
        "ACCGRAV/JGRAV=-9.81",
        f"PART/2, MASS=1, CM=21, IP={inertia!r},{inertia!r},{inertia!r}, REULER={-tilt!r},0,0",
        "MARKER/20, PART=2",
        f"MARKER/21, PART=2, QP=0,{arm!r},0",
        "JOINT/1, REVOLUTE, I=20, J=1",
        f"SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=-{c!r}*WZ(20,1)",
    )
    draw.measure(ANGLE, "AZ(20,1)")

    def law(_: float, y: np.ndarray) -> Values:
        return y[1], (9.81 * arm * sin(y[0]) - c * y[1]) / whole

    return draw.integrated(end, law, (-tilt, 0.0), lambda _, y: (y[0],), lambda _t, _y: 0.02)


@family("scales")
def passenger(draw: Draw) -> Posed:
    """A vibration of a millimetre on something that travels a kilometre."""
    v, amplitude, rate = draw.between(10, 100), draw.decade(-4, -2), draw.decade(0.7, 2)
    heavy, light = draw.decade(1, 4), draw.decade(-1, 1)
    k = float(f"{light * rate * rate:.5g}")
    true = sqrt(k * (1 / light + 1 / heavy))
    end = float(f"{2 * pi / true * draw.decade(0.7, 2):.4g}")
    draw.mass(2, heavy, speeds=f", VX={v!r}")
    draw.mass(3, light, f"{amplitude!r},0,0", f", VX={v!r}")
    draw.add("MARKER/20, POINT_MASS=2, FLOATING",
             f"VFORCE/1, I=3, JFLOAT=20, FX=-{k!r}*DX(3,2)")  # fmt: skip
    draw.measure(RELATIVE, "DX(3,2)")
    draw.measure(LENGTH, "DX(2)")
    share = light / (light + heavy)

    def show(t: float) -> Values:
        apart = amplitude * cos(true * t)
        return apart, v * t + share * (amplitude - apart)

    return draw.closed(end, show)


@family("scales")
def across_the_way(draw: Draw) -> Posed:
    """A mass that travels along x and vibrates a little along y, driven near resonance."""
    v, rate, mass = draw.between(10, 100), draw.decade(0.7, 2), draw.decade(-1, 2)
    beat, load = float(f"{rate * draw.between(0.7, 1.4):.4g}"), draw.decade(-4, -2)
    k, c = (float(f"{mass * x:.5g}") for x in (rate * rate, 0.04 * rate))
    force = float(f"{load * k:.4g}")
    end = float(f"{2 * pi / rate * draw.decade(0.7, 2):.4g}")
    draw.mass(2, mass, speeds=f", VX={v!r}")
    draw.add(f"VFORCE/1, I=2, J_PART=1, FY={force!r}*SIN({beat!r}*TIME)-{k!r}*DY(2)-{c!r}*VY(2)")
    draw.measure(LENGTH, "DY(2)")

    moved = driven_oscillator(mass, c, k, 0.0, force, beat)
    return draw.closed(end, lambda t: moved(t)[:1])


@family("scales")
def stiff_slack_line(draw: Draw) -> Posed:
    """A mass on a line that is slack, then stiff: a pendulum that bounces in its line."""
    mass, stiff = draw.decade(-1, 1), draw.decade(4, 6)
    angle, radius = draw.between(-2.4, -0.7), draw.between(0.6, 0.999)
    x, y = float(f"{radius * cos(angle):.5g}"), float(f"{radius * sin(angle):.5g}")
    vx, vy, damp = draw.between(-2, 2), draw.between(-1, 1), 0.0
    if draw.chance(0.5):
        damp = float(f"{2 * sqrt(stiff * mass) * draw.between(0.1, 1):.4g}")
    wide, end = draw.decade(-5, -3), draw.between(0.5, 1.5)
    draw.add("ACCGRAV/JGRAV=-9.81")
    draw.mass(2, mass, f"{x!r},{y!r},0", f", VX={vx!r}, VY={vy!r}")
    draw.add(
        f"SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-STEP(DM(2,1),1,0,{1 + wide!r},1)"
        f"*({stiff!r}*(DM(2,1)-1)+{damp!r}*VR(2,1))"
    )
    draw.measure(LENGTH, "DX(2)")
    draw.measure(LENGTH, "DY(2)")

    def law(_: float, s: np.ndarray) -> Values:
        r = hypot(s[0], s[1])
        u = min(max((r - 1.0) / wide, 0.0), 1.0)
        pull = stiff * (r - 1.0) + damp * (s[0] * s[2] + s[1] * s[3]) / r
        f = -u * u * (3.0 - 2.0 * u) * pull / (mass * r)
        return s[2], s[3], f * s[0], f * s[1] - 9.81

    def pace(_: float, s: np.ndarray) -> float:
        away = max(1.0 - hypot(s[0], s[1]), 0.1 * wide if hypot(s[0], s[1]) < 1 + wide else 1e-4)
        return min(max(0.2 * away, 0.05 * wide) / max(hypot(s[2], s[3]), 0.1), 0.01)

    return draw.integrated(end, law, (x, y, vx, vy), lambda _, s: (s[0], s[1]), pace)
