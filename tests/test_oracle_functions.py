"""What functions measure, against plain formulas on random postures, rates and loads.

Displacements, velocities, accelerations and forces between markers that turn, in axes and frames
that turn; REQUESTs of every kind; motions by the geometric condition itself.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from frame_constraints import about
from oracle import Flight, Marker, projected_angles, reported, seen, velocity
from scenes import compiled
from tiers import slow

import adamslite as al
from adamslite.language.function import FUNCTIONS
from adamslite.language.units import FORCE, LENGTH, MASS, TIME

Array = np.ndarray
SEEDS = (0, 1, 3)
DRIVE = "GFORCE/1, I=2, J_PART=1, FX=3, FY=-2, FZ=1, TX=0.4, TY=0.9, TZ=-1.3"
GROUND = Marker(-1, np.zeros(3), np.eye(3), np.zeros(3), np.zeros(3))


class Moving:
    """A flight with a load, and the accelerations of its markers."""

    def __init__(self, seed: int) -> None:
        self.flight = f = Flight(seed)
        i = f[2]
        load = (i.body, i.r, np.array([3.0, -2.0, 1.0]), np.array([0.4, 0.9, -1.3]))
        self.rates = f.accelerations([load])

    def linear(self, m: Marker) -> Array:
        """Acceleration of a marker's origin."""
        if m.body < 0:
            return np.zeros(3)
        a, alpha = self.rates[m.body, :3], self.rates[m.body, 3:]
        arm = m.r - self.flight.made.start.r[m.body]
        return a + np.cross(alpha, arm) + np.cross(m.w, np.cross(m.w, arm))

    def angular(self, m: Marker) -> Array:
        """Angular acceleration of a marker."""
        return np.zeros(3) if m.body < 0 else self.rates[m.body, 3:]

    def acceleration(self, i: Marker, j: Marker, k: Marker, frame: Marker) -> Array:
        """d2/dt2(r_i - r_j) taken in a frame, along the axes of k."""
        d, v = i.r - j.r, i.v - j.v
        w, alpha = frame.w, self.angular(frame)
        a = self.linear(i) - self.linear(j)
        inner = a - np.cross(alpha, d) - 2 * np.cross(w, v) + np.cross(w, np.cross(w, d))
        return k.A.T @ inner

    def spin_up(self, i: Marker, j: Marker, k: Marker, frame: Marker) -> Array:
        """d/dt(w_i - w_j) taken in a frame, along the axes of k."""
        return k.A.T @ (self.angular(i) - self.angular(j) - np.cross(frame.w, i.w - j.w))


def euler(R: Array, axes: str) -> Array:
    """Body-fixed angles of R = R_a(p1) R_b(p2) R_c(p3), found by a search from many starts."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(R).as_euler(axes)


def directions(i: Marker, j: Marker) -> Array:
    """Axes of I as seen from J."""
    return j.A.T @ i.A


def expected_values(m: Moving, n: list[int]) -> dict[str, float]:
    """Expression -> value, for markers i, j, k, l."""
    i, j, k, frame = (m.flight[number] for number in n)
    a, b, c, d = n
    found: dict[str, float] = {}
    vectors: dict[str, Callable[..., Array]] = {"V": velocity, "ACC": m.acceleration}
    for axis in range(3):
        x = "XYZ"[axis]
        found[f"D{x}({a},{b},{c})"] = seen(i, j, k)[axis]
        found[f"D{x}({a},{b})"] = seen(i, j, GROUND)[axis]
        found[f"D{x}({a})"] = i.r[axis]
        found[f"D{x}({a},0,{c})"] = seen(i, GROUND, k)[axis]
        found[f"W{x}({a},{b},{c})"] = (k.A.T @ (i.w - j.w))[axis]
        found[f"WDT{x}({a},{b},{c},{d})"] = m.spin_up(i, j, k, frame)[axis]
        found[f"WDT{x}({a},{b},{c})"] = m.spin_up(i, j, k, GROUND)[axis]
        found[f"A{x}({a},{b})"] = projected_angles(i, j)[axis]
        for name, law in vectors.items():
            found[f"{name}{x}({a},{b},{c},{d})"] = law(i, j, k, frame)[axis]
            found[f"{name}{x}({a},{b},{c})"] = law(i, j, k, GROUND)[axis]
            found[f"{name}{x}({a},{b})"] = law(i, j, GROUND, GROUND)[axis]
            found[f"{name}{x}({a})"] = law(i, GROUND, GROUND, GROUND)[axis]
    u = (i.r - j.r) / np.linalg.norm(i.r - j.r)
    found |= {
        f"DM({a},{b})": float(np.linalg.norm(i.r - j.r)),
        f"VR({a},{b})": float((i.v - j.v) @ u),
        f"VM({a},{b},{d})": float(np.linalg.norm(velocity(i, j, k, frame))),
        f"VM({a},{b})": float(np.linalg.norm(i.v - j.v)),
        f"ACCM({a},{b},{d})": float(np.linalg.norm(m.acceleration(i, j, k, frame))),
        f"WM({a},{b})": float(np.linalg.norm(i.w - j.w)),
        f"WDTM({a},{b},{d})": float(np.linalg.norm(m.spin_up(i, j, k, frame))),
        f"WDTM({a},{b})": float(np.linalg.norm(m.spin_up(i, j, k, GROUND))),
    }
    lines = [(m.r - j.r) / np.linalg.norm(m.r - j.r) for m in (i, k)]
    found[f"INCANG({a},{b},{c})"] = float(np.arccos(lines[0] @ lines[1]))
    for component, angle in enumerate(projected_angles(i, j), 1):
        found[f"ORIENT(26,{component},{a},{b})"] = angle
    return found | attitudes(a, b, directions(i, j))


SEQUENCES = ("XYZ", "YZX", "ZXY", "XZY", "YXZ", "ZYX", "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ")


def attitudes(a: int, b: int, R: Array) -> dict[str, float]:
    """PSI, YAW, ORIENT and their kin."""
    psi, theta, phi = euler(R, "ZXZ")
    yaw, pitch, roll = euler(R, "ZYX")
    found = {
        f"PSI({a},{b})": psi, f"THETA({a},{b})": theta, f"PHI({a},{b})": phi,
        f"YAW({a},{b})": yaw, f"PITCH({a},{b})": -pitch, f"ROLL({a},{b})": roll,
    }  # fmt: skip
    for number, axes in enumerate(SEQUENCES, 1):
        for component, angle in enumerate(euler(R, axes), 1):
            found[f"ORIENT({number},{component},{a},{b})"] = angle
    for number, axes in enumerate(SEQUENCES, 13):
        for component, angle in enumerate(euler(R, axes.lower()), 1):
            found[f"ORIENT({number},{component},{a},{b})"] = angle
    for component, value in enumerate((yaw, -pitch, roll), 1):
        found[f"ORIENT(25,{component},{a},{b})"] = value
    for component, value in enumerate(R.T.ravel(), 1):
        found[f"ORIENT(29,{component},{a},{b})"] = value
    half = np.sqrt(1 + np.trace(R)) / 2
    twist = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / (4 * half)
    for component, value in enumerate((half, *twist), 1):
        found[f"ORIENT(27,{component},{a},{b})"] = value
    return found


@pytest.mark.parametrize("seed", SEEDS)
def test_motion_between_markers(seed: int) -> None:
    m = Moving(seed)
    expected: dict[str, float] = {}
    for numbers in (m.flight.pick(4), m.flight.pick(4)):
        expected |= expected_values(m, numbers)
    lines = [f"VARIABLE/{k}, FUNCTION={e}" for k, e in enumerate(expected, 1)]
    results = m.flight.run(DRIVE, *lines)
    assert reported(results) == pytest.approx(m.rates, rel=1e-9, abs=1e-9 * np.abs(m.rates).max())
    for k, (function, value) in enumerate(expected.items(), 1):
        got = results[f"VARIABLE/{k}"][0]
        assert got == pytest.approx(value, rel=1e-9, abs=1e-9), function


def test_every_function_of_markers_is_measured() -> None:
    m = Moving(0)
    named = {e.partition("(")[0] for e in expected_values(m, m.flight.pick(4))}
    homes = ("motion", "angles")
    motion = {n for n, f in FUNCTIONS.items() if f.body.__module__.endswith(homes)}
    assert motion <= named


# ---------------------------------------------------------------------------------- forces


def test_forces_on_markers_and_of_elements() -> None:
    """SFORCE and BUSHING between the same markers: each by its own function on I and J, their sum
    by FX(i,j,k) and REQUEST/FORCE; a third force at I counts in FX(i,0) as well.
    """
    f = Flight(1)
    i, j, rm = f.pick(3)
    while -1 in (f[i].body, f[j].body):
        i, j, rm = f.pick(3)
    mi, mj, mr = f[i], f[j], f[rm]
    k, kt = np.array([10.0, 20, 30]), np.array([3.0, 4, 5])
    push = -k * seen(mi, mj, mj)
    twist = -kt * projected_angles(mi, mj)
    bush = np.concatenate([mj.A @ push, mj.A @ twist])
    u = (mi.r - mj.r) / np.linalg.norm(mi.r - mj.r)
    other = np.concatenate([2.5 * u, np.zeros(3)])
    third = np.array([1.0, -2, 3, 0, 0, 0])
    expected = {}
    d = mi.r - mj.r

    def on_j(wrench: Array) -> Array:
        """The opposite, as a force at J's origin."""
        return -np.concatenate([wrench[:3], wrench[3:] + np.cross(d, wrench[:3])])

    def note(name: str, wrench: Array) -> None:
        for c, part in ((0, wrench[:3]), (4, wrench[3:])):
            values = (np.linalg.norm(part), *(mr.A.T @ part))
            for n, value in enumerate(values, 1):
                expected[f"{name},{c + n},{rm})"] = float(value)

    both = bush + other
    note("BUSH(1,0", bush)
    note("BUSH(1,1", on_j(bush))
    note("SFORCE(1,0", other)
    note("SFORCE(1,1", on_j(other))
    for name, wrench in (
        (f"({i},{j},{rm})", both),
        (f"({i},0,{rm})", both + third),
    ):
        for c, part in (("F", wrench[:3]), ("T", wrench[3:])):
            for axis, value in zip("XYZ", mr.A.T @ part, strict=True):
                expected[f"{c}{axis}{name}"] = float(value)
    expected[f"FM({i},{j})"] = float(np.linalg.norm(both[:3]))
    expected[f"TM({i},{j})"] = float(np.linalg.norm(both[3:]))
    lines = [f"VARIABLE/{n}, FUNCTION={e}" for n, e in enumerate(expected, 1)]
    results = f.run(
        f"BUSHING/1, I={i}, J={j}, K=10,20,30, KT=3,4,5",
        f"SFORCE/1, TRANSLATIONAL, I={i}, J={j}, FUNCTION=2.5",
        f"VFORCE/1, I={i}, J_PART=1, FX=1, FY=-2, FZ=3",
        f"REQUEST/1, FORCE, I={i}, J={j}, RM={rm}",
        *lines,
    )
    for n, (function, value) in enumerate(expected.items(), 1):
        got = results[f"VARIABLE/{n}"][0]
        assert got == pytest.approx(value, rel=1e-9, abs=1e-9 * np.abs(both).max()), function
    turned = [mr.A.T @ both[:3], mr.A.T @ both[3:]]
    row = [v for part in turned for v in (np.linalg.norm(part), *part)]
    found = [results[f"REQUEST/1.F{n}"][0] for n in range(1, 9)]
    assert found == pytest.approx(row, rel=1e-9, abs=1e-9 * np.abs(both).max())


# ---------------------------------------------------------------------------------- requests


@pytest.mark.parametrize("seed", SEEDS)
def test_requests_against_differences_of_positions(seed: int) -> None:
    """VELOCITY and ACCELERATION are rates of what DISPLACEMENT writes in ground axes, turned into
    those of RM; central differences of order 4 over a short flight.
    """
    f = Flight(seed)
    i, j, rm = f.pick(3)
    step = 1e-3
    axes = [f"VARIABLE/{3 * r + c + 1}, FUNCTION={w}" for r, c, w in _axes_of(rm)]
    lines = [f"REQUEST/{n}, {kind}, I={i}, J={j}, RM={rm}" for n, kind in enumerate(KINDS, 1)]
    ground = [f"REQUEST/9, DISPLACEMENT, I={i}, J={j}"]
    seen_i = [f"VARIABLE/{20 + n}, FUNCTION={e}" for n, e in enumerate(_spins(i, j))]
    results = f.run(DRIVE, *UNIT_POINTS, *lines, *ground, *axes, *seen_i, end=4 * step, steps=4)
    R = np.array([[results[f"VARIABLE/{3 * r + c + 1}"][2] for c in range(3)] for r in range(3)])

    def rows(request: int, first: int) -> Array:
        return np.column_stack([results[f"REQUEST/{request}.F{first + n}"] for n in range(3)])

    d = rows(9, 2)
    v = (d[0] - 8 * d[1] + 8 * d[3] - d[4]) / (12 * step)
    a = (-d[0] + 16 * d[1] - 30 * d[2] + 16 * d[3] - d[4]) / (12 * step**2)
    w = np.column_stack([results[f"VARIABLE/{20 + n}"] for n in range(3)])
    alpha = (w[0] - 8 * w[1] + 8 * w[3] - w[4]) / (12 * step)
    for request, first, vector in ((1, 2, d[2]), (2, 2, v), (2, 6, w[2]), (3, 2, a), (3, 6, alpha)):
        got = np.array([results[f"REQUEST/{request}.F{first + n}"][2] for n in range(3)])
        size = np.abs(vector).max()
        assert got == pytest.approx(R.T @ vector, abs=2e-6 * size)
        length = results[f"REQUEST/{request}.F{first - 1}"][2]
        assert length == pytest.approx(np.linalg.norm(vector), abs=2e-6 * size)
    angles = [f"{n}({i},{j})" for n in ("PSI", "THETA", "PHI")]
    more = [f"VARIABLE/{n}, FUNCTION={e}" for n, e in enumerate(angles, 1)]
    start = f.run(DRIVE, lines[0], *more)
    for n in range(3):
        angle = start[f"VARIABLE/{n + 1}"][0]
        assert start[f"REQUEST/1.F{6 + n}"][0] == pytest.approx(angle, abs=1e-12)


KINDS = ("DISPLACEMENT", "VELOCITY", "ACCELERATION")


UNIT_POINTS = [
    "MARKER/61, PART=1", "MARKER/62, PART=1, QP=1,0,0", "MARKER/63, PART=1, QP=0,1,0",
    "MARKER/64, PART=1, QP=0,0,1",
]  # fmt: skip


def _axes_of(rm: int) -> list[tuple[int, int, str]]:
    """(row, column, expression) of the axes of a marker: unit vectors of ground along them."""
    axes = list(enumerate("XYZ"))
    return [(row, c, f"D{axis}({62 + row},61,{rm})") for row in range(3) for c, axis in axes]


def _spins(i: int, j: int) -> list[str]:
    return [f"W{axis}({i},{j})" for axis in "XYZ"]


# ---------------------------------------------------------------------------------- units


def test_units_by_their_definitions() -> None:
    """Every word of UNITS in SI: the agreement on yard and pound of 1959, CGPM 1901, prefixes."""
    inch, pound, g = 0.0254, 0.45359237, 9.80665
    assert FORCE == pytest.approx({
        "CENTINEWTON": 0.01, "DYNE": 1e-5, "KILOGRAM_FORCE": 9.80665, "KNEWTON": 1000,
        "KPOUND_FORCE": 4448.2216152605, "MEGANEWTON": 1e6, "MICRONEWTON": 1e-6,
        "MILLINEWTON": 1e-3, "NANONEWTON": 1e-9, "NEWTON": 1, "OUNCE_FORCE": 0.27801385095378125,
        "POUND_FORCE": 4.4482216152605, "POUNDAL": 0.138254954376,
    }, rel=1e-12)  # fmt: skip
    assert MASS == pytest.approx({
        "GRAM": 1e-3, "KILOGRAM": 1, "KPOUND_MASS": 453.59237, "MILLIGRAM": 1e-6,
        "MICROGRAM": 1e-9, "NANOGRAM": 1e-12, "OUNCE_MASS": 0.028349523125, "POUND_MASS": pound,
        "SLINCH": pound * g / inch, "SLUG": 14.593902937206364, "TONNE": 1000, "US_TON": 907.18474,
    }, rel=1e-12)  # fmt: skip
    assert LENGTH == pytest.approx({
        "ANGSTROM": 1e-10, "CENTIMETER": 0.01, "FOOT": 0.3048, "KILOMETER": 1000, "INCH": inch,
        "METER": 1, "MICROINCH": 2.54e-8, "MICROMETER": 1e-6, "MILE": 1609.344,
        "MILLIMETER": 1e-3, "MILS": 2.54e-5, "NANOMETER": 1e-9, "YARD": 0.9144,
    }, rel=1e-12)  # fmt: skip
    assert TIME == pytest.approx({
        "DAY": 86400, "HOUR": 3600, "MICROSECOND": 1e-6, "MILLISECONDS": 1e-3, "MINUTE": 60,
        "NANOSECOND": 1e-9, "SECOND": 1,
    }, rel=1e-12)  # fmt: skip


KINDS_OF_UNITS = {"FORCE": FORCE, "MASS": MASS, "LENGTH": LENGTH, "TIME": TIME}
FALLS = [(kind, word) for kind, words in KINDS_OF_UNITS.items() for word in words]


@pytest.mark.parametrize(("kind", "word"), FALLS)
def test_a_force_accelerates_as_its_units_say(kind: str, word: str) -> None:
    """F = m a in SI, whatever words the deck uses for the one and the other."""
    words = {"FORCE": "NEWTON", "MASS": "KILOGRAM", "LENGTH": "METER", "TIME": "SECOND", kind: word}
    units = ", ".join(f"{k}={v}" for k, v in words.items())
    deck = al.read(
        f"A mass that is pushed\nUNITS/{units}\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "POINT_MASS/2, MASS=3, CM=2\nMARKER/2, POINT_MASS=2\n"
        "VFORCE/1, I=2, J_PART=1, FX=6, FY=0, FZ=0\nEND\n"
    )
    found = al.simulate(deck, end=1e-9, steps=1)["POINT_MASS/2.ax"][0]
    si = 6 * FORCE[words["FORCE"]] / (3 * MASS[words["MASS"]])
    expected = si / LENGTH[words["LENGTH"]] * TIME[words["TIME"]] ** 2
    assert found == pytest.approx(expected, rel=1e-11)


# ---------------------------------------------------------------------------------- motions

HELD = """A part that six motions carry
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1, QP=0.1,-0.2,0.3, REULER=0.4,0.7,-0.3
PART/2, MASS=2, CM=2, IP=0.3,0.4,0.5
MARKER/2, PART=2
{motions}
INTEGRATOR/RADAU, ERROR=1E-10
SIMULATE/DYNAMIC, END=1, STEPS=4
END
"""


@pytest.mark.parametrize("scale", [1.0, -0.7])
@pytest.mark.parametrize(
    ("how", "off"),
    [
        ("DISPLACEMENT, FUNCTION={a!r}+{b!r}*TIME", 1e-9),
        slow("VELOCITY, ICDISP={a!r}, FUNCTION={b!r}", 1e-7),
    ],
)
def test_six_motions_carry_a_part_where_they_say(how: str, off: float, scale: float) -> None:
    """R = Rx(B1) Ry(B2) Rz(B3) and d = (X, Y, Z), both seen from J."""
    rates = {"X": 0.5, "Y": -0.8, "Z": 1.1, "B1": 0.6, "B2": -0.4, "B3": 0.9}
    law = {name: (scale * 0.3, scale * rate) for name, rate in rates.items()}
    motions = "\n".join(
        f"MOTION/{n}, I=2, J=1, {name}, " + how.format(a=a, b=b)
        for n, (name, (a, b)) in enumerate(law.items(), 1)
    )
    results = al.simulate(compiled(HELD.format(motions=motions)))
    J = about(2, 0.4) @ about(0, 0.7) @ about(2, -0.3)
    for row, t in enumerate(results.time):
        at = {name: a + b * t for name, (a, b) in law.items()}
        place = J @ [at["X"], at["Y"], at["Z"]] + [0.1, -0.2, 0.3]
        R = J @ about(0, at["B1"]) @ about(1, at["B2"]) @ about(2, at["B3"])
        angles = [results[f"PART/2.{n}"][row] for n in ("psi", "theta", "phi")]
        turned = about(2, angles[0]) @ about(0, angles[1]) @ about(2, angles[2])
        assert [results[f"PART/2.{n}"][row] for n in "xyz"] == pytest.approx(place, abs=off)
        assert turned == pytest.approx(R, abs=off)
