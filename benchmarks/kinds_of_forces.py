"""Random problems of forces that a step may miss: stiffness histories, tables, poles, bumps."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import cos, exp, inf, pi, sqrt

import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline

from benchmarks.posed import LENGTH, RELATIVE, SPEED, STATE, Draw, Pace, Posed, Values, family

#: Steps of a truth within the shortest event of a force, on the way to it, and in the run at least.
WITHIN, TOWARDS, LEAST = 0.05, 0.3, 200.0


def step(kind: str, x: float, a: float, b: float) -> float:
    """STEP, STEP5 or HAVSIN from 0 at a to 1 at b."""
    s = (x - a) / (b - a)
    if s <= 0.0 or s >= 1.0:
        return 0.0 if s <= 0.0 else 1.0
    if kind == "STEP":
        return s * s * (3.0 - 2.0 * s)
    if kind == "STEP5":
        return s**3 * (10.0 - 15.0 * s + 6.0 * s * s)
    return 0.5 - 0.5 * cos(pi * s)


def impact(x: float, v: float, edge: float, k: float, e: float, c: float, d: float) -> float:
    """IMPACT."""
    if x >= edge:
        return 0.0
    return max(0.0, k * (edge - x) ** e - v * c * (1.0 - step("STEP", x, edge - d, edge)))


def near(zones: list[tuple[float, float]], end: float, x: int = 0, v: int = 1) -> Pace:
    """Bound steps of y[x] with speed y[v] by the distance to zones (first, last), and by each.

    A zone passed in one step would be missed by scipy as well.
    """

    def pace(_: float, y: np.ndarray) -> float:
        most, speed = end / LEAST, abs(y[v]) + 1e-30
        for first, last in zones:
            away = max(first - y[x], y[x] - last, 0.0)
            most = min(most, max(TOWARDS * away, WITHIN * (last - first)) / speed)
        return most

    return pace


def mass_on_a_way(draw: Draw, force: str, mass: float, v: float) -> None:
    """A point mass along x under a force; its channels are place and speed."""
    draw.mass(2, mass, speeds=f", VX={v!r}")
    draw.add(f"VFORCE/1, I=2, J_PART=1, FX={force}")
    draw.measure(LENGTH, "DX(2)", sharp=True)
    draw.measure(SPEED, "VX(2)", sharp=True)


def along(draw: Draw, end: float, force: Callable[[float], float], mass: float, v: float,
          pace: Pace) -> Posed:  # fmt: skip
    """The problem of that mass."""
    return draw.integrated(
        end, lambda _, y: (y[1], force(y[0]) / mass), (0.0, v), lambda _, y: (y[0], y[1]), pace
    )


@family("stiffness")
def window(draw: Draw) -> Posed:
    """A force within a short part of the way, with ramps; it takes or gives energy."""
    kind, mass, v = draw.pick("STEP", "STEP5", "HAVSIN"), draw.decade(-1, 1), draw.decade(0.7, 2.2)
    way, a = v, draw.between(0.2, 0.8) * v
    up, flat, down = (draw.decade(-6, -2.5) * way for _ in range(3))
    b, c, d = a + up, a + up + flat, a + up + flat + down
    share = draw.between(-0.9, 0.9)
    height = float(f"{0.5 * mass * v * v * share / (flat + (up + down) / 2):.6g}")
    force = f"{height!r}*({kind}(DX(2),{a!r},0,{b!r},1)-{kind}(DX(2),{c!r},0,{d!r},1))"
    mass_on_a_way(draw, force, mass, v)
    pace = near([(a, b), (b, c), (c, d)], 1.0)
    return along(
        draw, 1.0, lambda x: height * (step(kind, x, a, b) - step(kind, x, c, d)), mass, v, pace
    )


def releasing(draw: Draw, sign: float) -> Posed:
    """A stiff damped spring of a mass that vanishes, or appears, within a STEP of time."""
    kind, mass = draw.pick("STEP", "STEP5", "HAVSIN"), draw.decade(-1, 1)
    stiff, soft = mass * draw.decade(4, 8), mass * draw.decade(0, 2)
    damp = float(f"{2 * sqrt(stiff * mass) * draw.between(0.3, 2.0):.4g}")
    at, wide, load = draw.between(0.1, 0.6), draw.decade(-4, -1), mass * draw.between(2, 20)
    end = draw.between(1.0, 3.0)
    first, last = (1, 0) if sign > 0 else (0, 1)
    on = f"{kind}(TIME,{at!r},{first},{at + wide!r},{last})"
    draw.mass(2, mass)
    draw.add(
        f"VFORCE/1, I=2, J_PART=1, FX=-{on}*({stiff!r}*DX(2)+{damp!r}*VX(2))"
        f"-{soft!r}*DX(2)+{load!r}*COS(3*TIME)"
    )
    draw.measure(LENGTH, "DX(2)")

    def law(t: float, y: np.ndarray) -> Values:
        s = step(kind, t, at, at + wide)
        k = 1.0 - s if sign > 0 else s
        force = -k * (stiff * y[0] + damp * y[1]) - soft * y[0] + load * cos(3.0 * t)
        return y[1], force / mass

    def pace(t: float, _: np.ndarray) -> float:
        return max(0.3 * max(at - t, t - at - wide, 0.0), 0.02 * wide)

    return draw.integrated(end, law, (0.0, 0.0), lambda _, y: (y[0],), pace, stiff=True)


@family("stiffness")
def spring_vanishes(draw: Draw) -> Posed:
    return releasing(draw, 1.0)


@family("stiffness")
def spring_appears(draw: Draw) -> Posed:
    return releasing(draw, -1.0)


@family("stiffness")
def rate_decays(draw: Draw) -> Posed:
    """A DIFF whose rate decays from a large one to nothing."""
    rate, time, power = draw.decade(4, 9), draw.decade(-2, -0.3), draw.whole(1, 4)
    gain, end = draw.between(1, 5), draw.between(1.0, 3.0)
    draw.mass(2, 1.0, speeds=", VX=1")
    law = f"-{rate!r}*(DIF(1)-1)*EXP(-(TIME/{time!r})**{power})+{gain!r}"
    draw.add(f"DIFF/1, IC=1, FUNCTION={law}")
    draw.measure(STATE, "DIF(1)")

    def slope(t: float, y: np.ndarray) -> Values:
        return (-rate * (y[0] - 1.0) * exp(-min((t / time) ** power, 700.0)) + gain,)

    return draw.integrated(
        end, slope, (1.0,), lambda _, y: (y[0],), lambda t, _: 0.02 * max(t, time), stiff=True
    )


@family("stiffness")
def contact_let_go(draw: Draw) -> Posed:
    """A mass pressed against a stiff IMPACT, then pulled away from it."""
    mass = draw.decade(-1, 1)
    stiff, power = mass * draw.decade(5, 8), draw.between(1.0, 1.6)
    damp = float(f"{2 * sqrt(stiff * mass) * draw.between(0.1, 1.5):.4g}")
    zone, load = draw.decade(-5, -3), mass * draw.between(5, 50)
    at, wide, end = draw.between(0.2, 0.5), draw.decade(-4, -1), draw.between(1.0, 2.0)
    kind = draw.pick("STEP", "STEP5", "HAVSIN")
    draw.mass(2, mass)
    draw.add(
        f"VFORCE/1, I=2, J_PART=1, FX=IMPACT(DX(2),VX(2),0,{stiff!r},{power!r},{damp!r},{zone!r})"
        f"+{kind}(TIME,{at!r},{-load!r},{at + wide!r},{load!r})"
    )
    draw.measure(LENGTH, "DX(2)")
    draw.measure(SPEED, "VX(2)")

    def law(t: float, y: np.ndarray) -> Values:
        pull = load * (2.0 * step(kind, t, at, at + wide) - 1.0)
        return y[1], (impact(y[0], y[1], 0.0, stiff, power, damp, zone) + pull) / mass

    def pace(t: float, y: np.ndarray) -> float:
        return max(0.2 * max(at - t, t - at - wide, 0.0), 0.02 * wide, 1e-5 if t < at else 0.0)

    return draw.integrated(end, law, (0.0, 0.0), lambda _, y: (y[0], y[1]), pace, stiff=True)


@family("stiffness")
def wall_of_exp(draw: Draw) -> Posed:
    """A mass runs against a force EXP(x/l): stiff for a moment, then let go."""
    mass, v = draw.decade(-1, 1), draw.decade(0, 1.5)
    length, far = draw.decade(-3, -1), draw.between(0.2, 0.7) * v
    turn = 0.5 * mass * v * v / length
    height = float(f"{turn:.4g}")
    mass_on_a_way(draw, f"-{height!r}*EXP((DX(2)-{far!r})/{length!r})", mass, v)
    zone = (far - 12.0 * length, far + length)
    pace = near([zone], 1.0)
    return along(
        draw, 1.0, lambda x: -height * exp(min((x - far) / length, 50.0)), mass, v,
        lambda t, y: min(pace(t, y), 0.2 * max(abs(y[0] - far) / (abs(y[1]) + 1e-30),
                                               length / v)),
    )  # fmt: skip


Curve = Callable[[float], float]


def knots(draw: Draw, way: float, height: float) -> tuple[list[float], list[float]]:
    """A table that is flat but for a hump of uneven knots."""
    width = draw.decade(-3, -1) * way
    first = draw.between(0.25, 0.7) * way
    inner = sorted({draw.between(0.05, 0.95) for _ in range(draw.whole(1, 7))})
    hump = [first, *(first + width * s for s in inner), first + width]
    heights = [0.0, *(height * draw.between(0.2, 1.0) for _ in inner), 0.0]
    before = sorted({round(draw.between(0.02, 0.98) * first, 3) for _ in range(draw.whole(1, 6))})
    after = sorted({round(first + width + draw.between(0.05, 1.0) * way, 3) for _ in range(4)})
    x = [-way, *before, *hump, *after, 4.0 * way]
    y = [0.0] * (1 + len(before)) + heights + [0.0] * (len(after) + 1)
    return [float(f"{each:.8g}") for each in x], [float(f"{each:.5g}") for each in y]


def curve_of(how: str, x: list[float], y: list[float]) -> Curve:
    """A table read by scipy as a function of decks reads it."""
    if how == "AKISPL":
        akima = Akima1DInterpolator(x, y)
        return lambda s: float(akima(s))
    if how == "CUBSPL":
        cubic = CubicSpline(x, y, bc_type="natural")
        return lambda s: float(cubic(s))
    return lambda s: float(np.interp(s, x, y))


def table(draw: Draw, how: str, x: list[float], y: list[float], at: str) -> tuple[str, Curve]:
    """A SPLINE, the expression that reads it, and its curve by scipy."""
    places, values = (",".join(f"{each!r}" for each in some) for some in (x, y))
    draw.add(f"SPLINE/1, X={places}\n, Y={values}")
    middle = 1 if how == "INTERP" else 0
    return f"{how}({at},{middle},1)", curve_of(how, x, y)


@family("tables")
def hump_in_the_road(draw: Draw) -> Posed:
    """A quarter car at constant speed over a hump of a table of uneven knots."""
    v, end = draw.between(5, 40), draw.between(2, 5)
    x, y = knots(draw, v * end, draw.between(0.02, 0.1))
    body, axle = draw.between(200, 400), draw.between(20, 60)
    k, c, tyre = draw.between(1e4, 4e4), draw.between(500, 3000), draw.between(1e5, 3e5)
    draw.mass(2, body, "0,.8,0", f", VX={v!r}")
    draw.mass(3, axle, "0,.3,0", f", VX={v!r}")
    draw.add("MARKER/30, POINT_MASS=3, FLOATING")
    how = draw.pick("AKISPL", "CUBSPL", "INTERP")
    road, curve = table(draw, how, x, y, "DX(3)")
    draw.add(
        f"VFORCE/1, I=2, JFLOAT=30, FY=-{k!r}*(DY(2,3)-.5)-{c!r}*VY(2,3)\\FX=-1E5*DX(2,3)",
        f"VFORCE/2, I=3, J_PART=1, FY=-{tyre!r}*(DY(3)-.3-{road})",
    )
    draw.measure(LENGTH, "DY(2)-.8")
    draw.measure(LENGTH, "DY(3)-.3")
    draw.measure(RELATIVE, "DY(2,3)-.5")
    corners = [each for each in x if 0.0 < each < v * end]

    def law(t: float, s: np.ndarray) -> Values:
        push = -k * (s[0] - s[1]) - c * (s[2] - s[3])
        return s[2], s[3], push / body, (-push - tyre * (s[1] - curve(v * t))) / axle

    def pace(t: float, _: np.ndarray) -> float:
        ahead = [each for each in corners if each > v * t + 1e-9]
        behind = [each for each in (0.0, *corners) if each <= v * t + 1e-9]
        gap = (ahead[0] - behind[-1]) / v if ahead else end
        to = (ahead[0] - v * t) / v if ahead else end
        return min(max(min(0.2 * gap, to), 1e-6 * end), end / LEAST)

    return draw.integrated(
        end, law, (0.0, 0.0, 0.0, 0.0), lambda _, s: (s[0], s[1], s[0] - s[1]), pace,
        steps=draw.whole(20, 100),
    )  # fmt: skip


@family("tables")
def spike_of_a_table(draw: Draw) -> Posed:
    """A force from a table of the place: a spike on a long way."""
    mass, v = draw.decade(-1, 1), draw.decade(0.7, 2.2)
    x, y = knots(draw, v, 1.0)
    how = draw.pick("AKISPL", "CUBSPL", "INTERP")
    # The work of the force, on whose way there may be more of it than at its end.
    fine = np.unique(np.concatenate([np.linspace(a, b, 50) for a, b in pairwise(x)]))
    read = curve_of(how, x, y)
    values = np.array([read(each) for each in fine])
    work = np.concatenate([[0.0], np.cumsum(np.diff(fine) * (values[1:] + values[:-1]) / 2)])
    scale = 0.5 * mass * v * v * draw.between(-0.85, 0.85) / np.abs(work).max()
    y = [float(f"{scale * each:.5g}") for each in y]
    force, curve = table(draw, how, x, y, "DX(2)")
    mass_on_a_way(draw, force, mass, v)
    inside = [each for each in x if 0.0 < each < 3.0 * v]
    pace = near(list(pairwise([0.0, *inside])), 1.0)
    return along(draw, 1.0, curve, mass, v, pace)


@family("singular")
def wall_of_powers(draw: Draw) -> Posed:
    """A mass runs against (a/x)**n, which it cannot pass."""
    mass, v, n = draw.decade(-1, 1), draw.decade(0, 1.7), draw.whole(1, 12)
    start = draw.between(0.3, 0.7) * v
    # It turns at the place at which the energy is spent.
    turn = start * draw.decade(-3, -1)
    share = n - 1 if n > 1 else 1.0 / np.log(start / turn)
    height = float(f"{0.5 * mass * v * v * share / turn:.4g}")
    sign = -1 if draw.chance(0.5) else 1
    draw.mass(2, mass, f"{sign * start!r},0,0", f", VX={-sign * v!r}")
    law = draw.pick(
        f"({turn!r}/{{x}})**{n}", f"{turn**n!r}/{{x}}**{n}", f"({{x}}/{turn!r})**(-{n})"
    )
    x = "DX(2)" if sign > 0 else "(-DX(2))"
    draw.add(f"VFORCE/1, I=2, J_PART=1, FX={sign * height!r}*{law.format(x=x)}")
    draw.measure(LENGTH, "DX(2)", sharp=True)
    draw.measure(SPEED, "VX(2)", sharp=True)

    def slope(_: float, y: np.ndarray) -> Values:
        return y[1], (height * (turn / y[0]) ** n / mass if y[0] > 0.0 else inf)

    return draw.integrated(
        1.0, slope, (start, -v), lambda _, y: (sign * y[0], sign * y[1]),
        lambda _, y: 0.05 * y[0] / v,
    )  # fmt: skip


@family("singular")
def distance_of_two(draw: Draw) -> Posed:
    """Two charges that repel, past each other with a small offset: DM**-2."""
    mass, v = draw.decade(-1, 1), draw.decade(0, 1.5)
    start, offset = draw.between(0.3, 0.7) * v, draw.decade(-4, -1) * v
    k = float(f"{0.5 * mass * v * v * draw.decade(-3, -0.5) * start:.4g}")
    draw.mass(2, mass, f"{-start!r},{offset!r},0", f", VX={v!r}")
    draw.add(f"SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION={k!r}*DM(2,1)**(-2)")
    draw.measure(LENGTH, "DX(2)")
    draw.measure(LENGTH, "DY(2)")

    def slope(_: float, y: np.ndarray) -> Values:
        push = k / mass / (y[0] * y[0] + y[1] * y[1]) ** 1.5
        return y[2], y[3], push * y[0], push * y[1]

    return draw.integrated(
        1.0, slope, (-start, offset, v, 0.0), lambda _, y: (y[0], y[1]),
        lambda _, y: 0.05 * sqrt(y[0] ** 2 + y[1] ** 2) / v,
    )  # fmt: skip


@family("singular")
def wall_of_log(draw: Draw) -> Posed:
    """A mass runs against -LOG(x) or 1/SQRT(x), which end at 0."""
    mass, v = draw.decade(-1, 1), draw.decade(0, 1.5)
    start, far = draw.between(0.3, 0.7) * v, draw.decade(-3, -1)
    how = draw.pick("LOG", "SQRT")
    k = float(f"{0.5 * mass * v * v / far * draw.between(1.0, 3.0):.4g}")
    draw.mass(2, mass, f"{start!r},0,0", f", VX={-v!r}")
    # Acts within 0 < x < far: the mass turns there.
    law = f"-LOG(DX(2)/{far!r})" if how == "LOG" else f"1/SQRT(DX(2)/{far!r})-1"
    draw.add(f"VFORCE/1, I=2, J_PART=1, FX={k!r}*MAX(0,{law})")
    draw.measure(LENGTH, "DX(2)", sharp=True)
    draw.measure(SPEED, "VX(2)", sharp=True)

    def slope(_: float, y: np.ndarray) -> Values:
        s = max(y[0] / far, 1e-300)
        return y[1], k / mass * max(0.0, -np.log(s) if how == "LOG" else 1.0 / sqrt(s) - 1.0)

    return draw.integrated(
        1.0, slope, (start, -v), lambda _, y: (y[0], y[1]),
        lambda _, y: min(0.05 * max(abs(y[0] - far), 0.1 * y[0], 1e-6) / v, 0.02),
    )  # fmt: skip


@family("bumps")
def bump_on_a_long_way(draw: Draw) -> Posed:
    """A narrow bell of the place, or a change of level of a force, without a guard."""
    mass, v, way = draw.decade(-1, 1), draw.decade(0.7, 2.2), 1.0
    place, width = draw.between(0.2, 0.8) * v, draw.decade(-6, -2) * v
    how = draw.pick("EXP", "1/", "TANH", "ATAN", "COSH")
    s = f"((DX(2)-{place!r})/{width!r})"
    area = {"EXP": sqrt(pi), "1/": pi, "COSH": 2.0}.get(how)
    energy = 0.5 * mass * v * v * draw.between(-0.85, 0.85)
    height = float(f"{energy / (area * width if area else v):.5g}")
    words, curve = {
        "EXP": (f"EXP(-{s}**2)", lambda s: exp(-min(s * s, 700.0))),
        "1/": (f"/(1+{s}**2)", lambda s: 1.0 / (1.0 + s * s)),
        "TANH": (f"(1+TANH({s}))", lambda s: 1.0 + np.tanh(s)),
        "ATAN": (f"(1+2/PI*ATAN({s}))", lambda s: 1.0 + 2.0 / pi * np.arctan(s)),
        "COSH": (f"/COSH(MIN(MAX({s},-50),50))**2",
                 lambda s: 1.0 / np.cosh(min(max(s, -50.0), 50.0)) ** 2),
    }[how]  # fmt: skip
    law = f"{height!r}{words}" if words[0] == "/" else f"{height!r}*{words}"
    mass_on_a_way(draw, law, mass, v)
    pace = near([(place - width, place), (place, place + width)], way)
    return along(draw, way, lambda x: height * curve((x - place) / width), mass, v, pace)


@family("bumps")
def bump_of_a_distance(draw: Draw) -> Posed:
    """A shell about the origin in which a mass is pushed: a bell of DM."""
    mass, v = draw.decade(-1, 1), draw.decade(0.7, 1.7)
    radius, width = draw.between(0.2, 0.4) * v, draw.decade(-5, -2) * v
    start, offset = 0.5 * v, draw.between(0.0, 0.15) * v
    height = float(f"{0.5 * mass * v * v * draw.between(-0.6, 0.6) / (sqrt(pi) * width):.5g}")
    draw.mass(2, mass, f"{-start!r},{offset!r},0", f", VX={v!r}")
    s = f"((DM(2,1)-{radius!r})/{width!r})"
    draw.add(f"SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION={height!r}*EXP(-{s}**2)")
    draw.measure(LENGTH, "DX(2)")
    draw.measure(LENGTH, "DY(2)")

    def slope(_: float, y: np.ndarray) -> Values:
        r = sqrt(y[0] * y[0] + y[1] * y[1])
        push = height / mass / r * exp(-min(((r - radius) / width) ** 2, 700.0))
        return y[2], y[3], push * y[0], push * y[1]

    def pace(_: float, y: np.ndarray) -> float:
        r, speed = sqrt(y[0] ** 2 + y[1] ** 2), sqrt(y[2] ** 2 + y[3] ** 2) + 1e-30
        return min(max(TOWARDS * (abs(r - radius) - width), WITHIN * width) / speed, 1 / LEAST)

    return draw.integrated(1.0, slope, (-start, offset, v, 0.0), lambda _, y: (y[0], y[1]), pace)
