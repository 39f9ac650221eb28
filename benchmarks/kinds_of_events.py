"""Random problems of events and analyses: SENSORs near peaks, several statics, pulleys."""

from __future__ import annotations

from dataclasses import replace
from math import acos, cos, inf, pi, sin, sqrt

import numpy as np

from benchmarks.posed import (
    ANGLE,
    LENGTH,
    RELATIVE,
    SPEED,
    STATIC,
    Channel,
    Draw,
    Posed,
    Truth,
    Values,
    family,
)

#: Tolerance of the SENSORs.
SENSOR = 1e-6


@family("sensors")
def near_a_peak(draw: Draw) -> Posed:
    """A SENSOR at almost the peak of a vibration, or just above it."""
    rate, size = draw.decade(0.3, 1.7), draw.decade(-1, 1)
    k, peaks = float(f"{rate * rate:.6g}"), draw.between(0.6, 4)
    rate = sqrt(k)
    short = draw.decade(-5, -1) * (-1 if draw.chance(0.15) else 1)
    way, sign = draw.pick("DX", "VX", "ACCX"), -1 if draw.chance(0.5) else 1
    top = size * {"DX": 1.0, "VX": rate, "ACCX": k}[way]
    value = float(f"{sign * top * (1.0 - short):.9g}")
    end = float(f"{2 * pi / rate * peaks:.5g}")
    how = "GE" if sign > 0 else "LE"
    how = "EQ" if draw.chance(0.2) else how
    draw.mass(2, 1.0, f"{size!r},0,0")
    # Two thirds of a period or more between outputs: no row shows the peak.
    draw.add(
        f"VFORCE/1, I=2, J_PART=1, FX=-{k!r}*DX(2)",
        f"SENSOR/1, FUNCTION={way}(2)\\, VALUE={value!r}, ERROR={SENSOR * top!r}, {how}, HALT",
    )
    draw.measure(LENGTH, "DX(2)")
    draw.measure(SPEED, "VX(2)")
    lag = {"DX": 0.0, "VX": 0.5 * pi, "ACCX": pi}[way]

    def first(level: float) -> float:
        """First time behind the start at which sign cos(rate t + lag) reaches a level."""
        if level > 1.0:
            return inf
        half = acos(max(level, -1.0))
        phase = lag if sign > 0 else lag + pi
        if cos(phase) >= level and how == "EQ":  # from beyond the value it is met on the way back
            return float((half - phase) % (2 * pi)) / rate
        if cos(phase) >= level:
            return 0.0
        return float((-half - phase) % (2 * pi)) / rate

    def halts(off: float) -> tuple[float, float]:
        room = 3.0 * off + 4.0 * SENSOR
        met, above = 1.0 - short, 1.0 - short + room
        # It may start at the peak: EQ is met soon after.
        times = [first(level) for level in (met - room, max(met, min(above, 1.0)), above)]
        return min(times), max(times) if max(times) <= end else inf

    posed = draw.closed(
        end, lambda t: (size * cos(rate * t), -size * rate * sin(rate * t)), draw.whole(3, 20)
    )
    return replace(posed, halts=halts)


@family("statics")
def hung_masses(draw: Draw) -> Posed:
    """Several statics behind one another, with other masses and stiffnesses: each has a row."""
    mass, k, length = draw.decade(-1, 2), draw.decade(2, 4), draw.between(0.5, 2)
    gravity = draw.between(5, 15)
    draw.add(f"ACCGRAV/JGRAV=-{gravity!r}")
    draw.mass(2, mass, f"0,-{length!r},0")
    draw.add(f"SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K={k!r}, C=1, LENGTH={length!r}")
    places = []
    commands = []
    for n in range(draw.whole(2, 5)):
        if n and draw.chance(0.8):
            if draw.chance(0.5):
                mass = draw.decade(-1, 2)
                commands.append(f"POINT_MASS/2, MASS={mass!r}")
            else:
                k = draw.decade(2, 4)
                commands.append(f"SPRINGDAMPER/1, K={k!r}")
        commands.append("SIMULATE/STATIC")
        places.append(-length - mass * gravity / k)
    rows = np.array(places)[:, None]
    text = "\n".join(["PART/1, GROUND", "MARKER/1, PART=1", "UNITS/SYSTEM=MKS", *draw.lines,
                      "REQUEST/1, F2=DY(2)", "END", ""])  # fmt: skip
    truth = Truth(rows, rows, np.array([length]))
    channel = Channel("REQUEST/1.F2", STATIC)
    return Posed("", text, 0.0, len(places) - 1, (channel,), lambda: truth, tuple(commands))


@family("statics")
def moved_foot(draw: Draw) -> Posed:
    """Statics of a lever on a torsion spring, with other loads between."""
    kt, load = draw.decade(0, 3), 0.0
    draw.add(
        "PART/2, MASS=1, CM=2, IP=1,1,1", "MARKER/2, PART=2", "JOINT/1, REVOLUTE, I=2, J=1",
        f"SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT={kt!r}, CT=1",
        "VARIABLE/1, FUNCTION=0",
        "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=VARVAL(1)",
    )  # fmt: skip
    commands, angles = [], []
    for _ in range(draw.whole(2, 6)):
        if draw.chance(0.8):
            load = float(f"{kt * draw.between(-1, 1):.4g}")
            commands.append(f"VARIABLE/1, FUNCTION={load!r}")
        commands.append("SIMULATE/STATIC")
        angles.append(load / kt)
    rows = np.array(angles)[:, None]
    text = "\n".join(["PART/1, GROUND", "MARKER/1, PART=1", "UNITS/SYSTEM=MKS", *draw.lines,
                      "REQUEST/1, F2=AZ(2,1)", "END", ""])  # fmt: skip
    channel = Channel("REQUEST/1.F2", STATIC)
    truth = Truth(rows, rows, np.array([1.0]))
    return Posed("", text, 0.0, len(angles) - 1, (channel,), lambda: truth, tuple(commands))


def taut(stretch: float, speed: float, k: float, c: float, wide: float) -> float:
    """Tension of a run of cable: none when it is slack."""
    u = min(max(stretch / wide, 0.0), 1.0)
    return u * u * (3.0 - 2.0 * u) * (k * stretch + c * speed)


@family("pulleys")
def two_weights(draw: Draw) -> Posed:
    """Two weights on elastic runs of cable over a heavy pulley that a torque turns."""
    radius, inertia = draw.between(0.1, 0.5), draw.decade(-2, 0.5)
    mass = [draw.decade(0, 2) for _ in range(2)]
    k = [float(f"{m * draw.decade(2, 6):.4g}") for m in mass]
    c = [float(f"{2 * sqrt(m * s) * draw.decade(-3, -0.7):.4g}")
         for m, s in zip(mass, k, strict=True)]  # fmt: skip
    torque, beat = draw.between(-2, 2) * radius * mass[0] * 9.81, draw.between(1, 30)
    torque, wide, end = float(f"{torque:.4g}"), draw.decade(-5, -3), draw.between(0.5, 2)
    draw.add("ACCGRAV/JGRAV=-9.81", f"PART/4, MASS=1, CM=4, IP=1,1,{inertia!r}",
             "MARKER/4, PART=4", "JOINT/1, REVOLUTE, I=4, J=1")  # fmt: skip
    for n, side in enumerate((1, -1)):
        draw.mass(2 + n, mass[n], f"{side * radius!r},-1,0")
        s, v = (
            f"({side * radius!r}*AZ(4,1)-DY({2 + n})-1)",
            f"({side * radius!r}*WZ(4,1)-VY({2 + n}))",
        )
        draw.add(
            f"VARIABLE/{n + 1}, FUNCTION=STEP({s},0,0,{wide!r},1)*({k[n]!r}*{s}+{c[n]!r}*{v})",
            f"VFORCE/{n + 1}, I={2 + n}, J_PART=1, FY=VARVAL({n + 1})",
        )
    draw.add(
        f"SFORCE/1, ROTATIONAL, I=4, J=1, FUNCTION={torque!r}*SIN({beat!r}*TIME)"
        f"-{radius!r}*(VARVAL(1)-VARVAL(2))"
    )
    draw.measure(ANGLE, "AZ(4,1)")
    draw.measure(RELATIVE, f"{radius!r}*AZ(4,1)-DY(2)-1")
    draw.measure(LENGTH, "DY(3)")

    def law(t: float, y: np.ndarray) -> Values:
        a, y1, y2, w, v1, v2 = y
        t1 = taut(radius * a - y1 - 1, radius * w - v1, k[0], c[0], wide)
        t2 = taut(-radius * a - y2 - 1, -radius * w - v2, k[1], c[1], wide)
        turn = (torque * sin(beat * t) - radius * (t1 - t2)) / inertia
        return w, v1, v2, turn, t1 / mass[0] - 9.81, t2 / mass[1] - 9.81

    def show(_: float, y: np.ndarray) -> Values:
        return y[0], radius * y[0] - y[1] - 1, y[2]

    soft = sqrt(max(s * (1 / m + radius**2 / inertia) for s, m in zip(k, mass, strict=True)))
    return draw.integrated(
        end, law, (0.0, -1.0, -1.0, 0.0, 0.0, 0.0), show, lambda *_: min(0.4 / soft, 0.01)
    )


@family("pulleys")
def hoist(draw: Draw) -> Posed:
    """A load hung from a drum by an elastic cable; the drum is wound by a MOTION of STEPs."""
    radius, mass = draw.between(0.1, 0.5), draw.decade(0, 3)
    k = float(f"{mass * draw.decade(2, 5):.4g}")
    c = float(f"{2 * sqrt(mass * k) * draw.decade(-3, -0.7):.4g}")
    turns, at, wide = draw.between(1, 40), draw.between(0.05, 0.5), draw.decade(-2, 0)
    end = float(f"{at + wide + draw.between(0.3, 2):.4g}")
    slack = draw.decade(-5, -3)
    draw.add(
        "ACCGRAV/JGRAV=-9.81", "PART/4, MASS=1, CM=4, IP=1,1,1", "MARKER/4, PART=4",
        "JOINT/1, REVOLUTE, I=4, J=1",
        f"MOTION/1, JOINT=1, ROTATION, FUNCTION=STEP5(TIME,{at!r},0,{at + wide!r},{turns!r})",
    )  # fmt: skip
    hang = mass * 9.81 / k
    draw.mass(2, mass, f"{radius!r},{-1 - hang!r},0")
    s, v = f"({radius!r}*AZ(4,1)-DY(2)-1)", f"({radius!r}*WZ(4,1)-VY(2))"
    draw.add(f"VFORCE/1, I=2, J_PART=1, FY=STEP({s},0,0,{slack!r},1)*({k!r}*{s}+{c!r}*{v})")
    draw.measure(LENGTH, "DY(2)+1")
    draw.measure(RELATIVE, f"{radius!r}*AZ(4,1)-DY(2)-1")

    def law(t: float, y: np.ndarray) -> Values:
        u = min(max((t - at) / wide, 0.0), 1.0)
        wound = radius * turns * u**3 * (10 - 15 * u + 6 * u * u)
        pace = radius * turns * 30 * u * u * (1 - u) ** 2 / wide
        return y[1], taut(wound - y[0] - 1, pace - y[1], k, c, slack) / mass - 9.81

    def show(t: float, y: np.ndarray) -> Values:
        u = min(max((t - at) / wide, 0.0), 1.0)
        return y[0] + 1, radius * turns * u**3 * (10 - 15 * u + 6 * u * u) - y[0] - 1

    return draw.integrated(
        end, law, (-1 - hang, 0.0), show, lambda *_: min(0.4 / sqrt(k / mass), 0.02 * wide)
    )
