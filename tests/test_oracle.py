"""Every force element against plain formulas: accelerations of all bodies, in ground axes.

Two seeds are two postures, two sets of rates and two systems of units.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest
from oracle import Flight, Marker, pair, projected_angles, reported, seen, velocity
from scenes import compiled

import adamslite as al
from adamslite.elements.bases.wrench import Wrench
from adamslite.elements.friction import Friction
from adamslite.language.statement import STATEMENTS

Array = np.ndarray
ZERO = np.zeros(3)
SEEDS = (0, 1, 3)


def agree(flight: Flight, statements: list[str], loads: list) -> None:
    """The program's accelerations at the start are those of the loads."""
    found, expected = reported(flight.run(*statements)), flight.accelerations(loads)
    for part in (slice(0, 3), slice(3, 6)):
        size = np.abs(expected[:, part]).max()
        assert found[:, part] == pytest.approx(expected[:, part], abs=1e-9 * size)


def numbers(rng: np.random.Generator, count: int, size: float = 1.0) -> list[float]:
    return [float(f"{v:.6g}") for v in rng.uniform(0.3, 2, count) * size]


def listed(values: Iterable[float]) -> str:
    return ",".join(repr(float(value)) for value in values)


# ---------------------------------------------------------------------------------- elements


def sforce(f: Flight, action_only: bool, turning: bool) -> tuple[list[str], list]:
    i, j = f.pick(2)
    e = 3.7 * f.made.length
    words = "ROTATIONAL" if turning else "TRANSLATIONAL"
    line = f"SFORCE/1, {words}{', ACTIONONLY' if action_only else ''}, I={i}, J={j}, FUNCTION={e!r}"
    mi, mj = f[i], f[j]
    if turning:
        loads = pair(mi, mj, ZERO, e * mj.A[:, 2])
    elif action_only:
        loads = pair(mi, mj, e * mj.A[:, 2], ZERO)
    else:
        u = (mi.r - mj.r) / np.linalg.norm(mi.r - mj.r)
        loads = pair(mi, mj, e * u, ZERO)
    return [line], loads[:1] if action_only else loads


def components(f: Flight, word: str, force: bool, torque: bool) -> tuple[list[str], list]:
    i, j, rm = f.pick(3)
    F = [2.5, -1.5, 0.7] if force else [0.0, 0.0, 0.0]
    T = [0.4, 1.1, -2.2] if torque else [0.0, 0.0, 0.0]
    given = [f"F{a}={v}" for a, v in zip("XYZ", F, strict=True) if force]
    given += [f"T{a}={v}" for a, v in zip("XYZ", T, strict=True) if torque]
    mi, mj, RM = f[i], f[j], f[rm]
    body = "GROUND" if mj.body < 0 else mj.body + 2
    floating = f"MARKER/50, PART={1 if body == 'GROUND' else body}, FLOATING"
    line = f"{word}/1, I={i}, JFLOAT=50, RM={rm}, " + ", ".join(given)
    return [floating, line], pair(mi, mj, RM.A @ F, RM.A @ T)


def spring(f: Flight, turning: bool) -> tuple[list[str], list]:
    i, j = f.pick(2)
    mi, mj = f[i], f[j]
    k, c, preload, rest = numbers(f.rng, 4)
    if turning:
        line = f"ROTATIONAL, I={i}, J={j}, KT={k}, CT={c}, TORQUE={preload}, ANGLE={rest}"
        angle = projected_angles(mi, mj)[2]
        torque = preload - k * (angle - rest) - c * (mi.w - mj.w) @ mj.A[:, 2]
        loads = pair(mi, mj, ZERO, torque * mj.A[:, 2])
    else:
        line = f"TRANSLATIONAL, I={i}, J={j}, K={k}, C={c}, FORCE={preload}, LENGTH={rest}"
        d = mi.r - mj.r
        u = d / np.linalg.norm(d)
        force = preload - k * (np.linalg.norm(d) - rest) - c * (mi.v - mj.v) @ u
        loads = pair(mi, mj, force * u, ZERO)
    return [f"SPRINGDAMPER/1, {line}"], loads


def six(mi: Marker, mj: Marker) -> tuple[Array, Array]:
    """Displacements and velocities of I along and about the axes of J, seen from J."""
    x = np.concatenate([seen(mi, mj, mj), projected_angles(mi, mj)])
    v = np.concatenate([velocity(mi, mj, mj, mj), mj.A.T @ (mi.w - mj.w)])
    return x, v


def from_six(mi: Marker, mj: Marker, load: Array) -> list:
    return pair(mi, mj, mj.A @ load[:3], mj.A @ load[3:])


def bushing(f: Flight) -> tuple[list[str], list]:
    i, j = f.pick(2)
    k, c, kt, ct, force, torque = (numbers(f.rng, 3) for _ in range(6))
    x, v = six(f[i], f[j])
    load = np.array(force + torque) - np.array(k + kt) * x - np.array(c + ct) * v
    line = f"BUSHING/1, I={i}, J={j}, K={listed(k)}, C={listed(c)}, KT={listed(kt)}"
    line += f", CT={listed(ct)}, FORCE={listed(force)}, TORQUE={listed(torque)}"
    return [line], from_six(f[i], f[j], load)


def field(f: Flight, ratio: bool) -> tuple[list[str], list]:
    i, j = f.pick(2)
    k, c = np.array(numbers(f.rng, 36)).reshape(6, 6), np.array(numbers(f.rng, 36)).reshape(6, 6)
    rest, force = numbers(f.rng, 6), numbers(f.rng, 6)
    x, v = six(f[i], f[j])
    damping = 0.3 * k if ratio else c
    load = np.array(force) - k @ (x - rest) - damping @ v
    how = "CRATIO=0.3" if ratio else f"CMATRIX={listed(c.T.ravel().tolist())}"
    line = f"FIELD/1, I={i}, J={j}, KMATRIX={listed(k.T.ravel().tolist())}, {how}"
    return [f"{line}, LENGTH={listed(rest)}, FORCE={listed(force)}"], from_six(f[i], f[j], load)


def stiffening(rigidity: float, L: float, x: Array) -> Array:
    """By the energy rigidity/2 (x1 + g)^2, g from the cubics with the slopes of I by quadrature."""
    s, weights = np.polynomial.legendre.leggauss(4)
    s, weights = (s + 1) / 2, weights / 2
    by_v, by_p = 6 * (s - s**2) / L, 3 * s**2 - 2 * s
    slope = {1: by_v * x[1] + by_p * x[5], 2: by_v * x[2] - by_p * x[4]}
    g = L * weights @ (slope[1] ** 2 + slope[2] ** 2) / 2
    N = rigidity * (x[0] + g)
    across = [L * weights @ (slope[n] * by_v) for n in (1, 2)]
    about = [-L * weights @ (slope[2] * by_p), L * weights @ (slope[1] * by_p)]
    return np.array([-rigidity * g, *(-N * np.array([*across, 0, *about]))])


def beam(f: Flight, ratio: bool, string: bool = False) -> tuple[list[str], list]:
    i, j = f.pick(2)
    L, ixx, iyy, izz, area, asy, asz, E, G = numbers(f.rng, 9)
    py, pz = 12 * E * izz * asy / (G * area * L**2), 12 * E * iyy * asz / (G * area * L**2)
    k = np.diag([E * area / L, 12 * E * izz / (L**3 * (1 + py)), 12 * E * iyy / (L**3 * (1 + pz)),
                 G * ixx / L, (4 + pz) * E * iyy / (L * (1 + pz)),
                 (4 + py) * E * izz / (L * (1 + py))])  # fmt: skip
    k[1, 5] = k[5, 1] = -6 * E * izz / (L**2 * (1 + py))
    k[2, 4] = k[4, 2] = 6 * E * iyy / (L**2 * (1 + pz))
    lower = numbers(f.rng, 21)
    c = np.zeros((6, 6))
    rows, columns = np.triu_indices(6)  # column by column of the lower triangle
    c[columns, rows] = c[rows, columns] = lower
    x, v = six(f[i], f[j])
    x[0] -= L
    load = -k @ x - (0.2 * k if ratio else c) @ v
    if string:
        load += stiffening(E * area / L, L, x)
    how = "CRATIO=0.2" if ratio else f"CMATRIX={listed(lower)}"
    line = f"BEAM/1, I={i}, J={j}, LENGTH={L}, IXX={ixx}, IYY={iyy}, IZZ={izz}, AREA={area}"
    line += f", ASY={asy}, ASZ={asz}, EMODULUS={E}, GMODULUS={G}, {how}"
    line += ", FORMULATION=STRING" * string
    return [line], from_six(f[i], f[j], load)


def nforce(f: Flight) -> tuple[list[str], list]:
    """Two markers on one J: their twelve displacements, damping and preload, a full matrix."""
    *markers, j = f.pick(3)
    k, c = (np.array(numbers(f.rng, 144)).reshape(12, 12) for _ in range(2))
    rest, force = np.array(numbers(f.rng, 12)), np.array(numbers(f.rng, 12))
    states = [six(f[i], f[j]) for i in markers]
    x, v = (np.concatenate([state[n] for state in states]) for n in (0, 1))
    load = force - k @ (x - rest) - c @ v
    lines = [
        f"MATRIX/{n}, FULL=RORDER, ROWS=12, COLUMNS={m.size // 12}, VALUES={listed(m.ravel())}"
        for n, m in enumerate((k, c, rest, force), 1)
    ]
    ends = ",".join(map(str, markers))
    lines += [f"NFORCE/1, IMARKERS={ends}, J={j}, KMATRIX=1, CMATRIX=2, LENGTH=3, FORCE=4"]
    first, second = markers
    return lines, from_six(f[first], f[j], load[:6]) + from_six(f[second], f[j], load[6:])


ELEMENTS = {
    "SFORCE along": lambda f: sforce(f, False, False),
    "SFORCE along z only on I": lambda f: sforce(f, True, False),
    "SFORCE about": lambda f: sforce(f, False, True),
    "SFORCE about only on I": lambda f: sforce(f, True, True),
    "VFORCE": lambda f: components(f, "VFORCE", True, False),
    "VTORQUE": lambda f: components(f, "VTORQUE", False, True),
    "GFORCE": lambda f: components(f, "GFORCE", True, True),
    "SPRINGDAMPER along": lambda f: spring(f, False),
    "SPRINGDAMPER about": lambda f: spring(f, True),
    "BUSHING": bushing,
    "FIELD": lambda f: field(f, False),
    "FIELD with CRATIO": lambda f: field(f, True),
    "NFORCE": nforce,
    "BEAM": lambda f: beam(f, False),
    "BEAM with CRATIO": lambda f: beam(f, True),
    "BEAM as a STRING": lambda f: beam(f, True, string=True),
}


@pytest.mark.parametrize("name", ELEMENTS)
@pytest.mark.parametrize("seed", SEEDS)
def test_loads_of_an_element(name: str, seed: int) -> None:
    flight = Flight(seed)
    agree(flight, *ELEMENTS[name](flight))


def test_every_force_element_has_a_formula() -> None:
    words = {name.split()[0] for name in ELEMENTS}
    forces = {key for key, kind in STATEMENTS.items() if hasattr(kind, "loads")}
    assert forces - {Friction.keyword} == words - {"NFORCE"}
    assert issubclass(Friction, Wrench)


# ---------------------------------------------------------------------------------- friction

JOINT_OF = {"TRANSLATIONAL": "VZ=0.7", "REVOLUTE": "WZ=2.3", "CYLINDRICAL": "VZ=0.7, WZ=2.3",
            "SPHERICAL": "WX=1.1, WY=-0.6, WZ=2.3", "HOOKE I_YOKE": "WX=2.3, WY=-1.9",
            "HOOKE J_YOKE": "WX=2.3, WY=-1.9", "UNIVERSAL I_YOKE": "WZ=2.3, WY=-1.9",
            "UNIVERSAL J_YOKE": "WZ=2.3, WY=-1.9"}  # fmt: skip
AXIS_OF = {"HOOKE I_YOKE": [1.0, 0, 0], "HOOKE J_YOKE": [0, 1.0, 0],
           "UNIVERSAL I_YOKE": [0, 0, 1.0], "UNIVERSAL J_YOKE": [0, 1.0, 0]}  # fmt: skip
RUBBING = """A part on a joint that rubs, its mass centre beside the joint: all reactions are there
UNITS/SYSTEM=MKS
ACCGRAV/IGRAV=3, JGRAV=-7, KGRAV={kgrav}
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=22, IP=0.3,0.4,0.5,0.05,-0.03,0.02, {start}
MARKER/2, PART=2
MARKER/4, PART=1, REULER=0,-90D,0
MARKER/22, PART=2, QP=0.2,0.3,-0.4
JOINT/1, {kind}, I=2, J={j}
GFORCE/1, I=2, JFLOAT=3, TX=2, TY=-3, TZ=1.5
MARKER/3, PART=1, FLOATING
FRICTION/1, JOINT=1, MU_STATIC=0.45, MU_DYNAMIC=0.25, STICTION_TRANSITION_VELOCITY={vs}
, PIN_RADIUS=0.3, BALL_RADIUS=0.35, FRICTION_ARM=0.15, BENDING_REACTION_ARM=0.4
, REACTION_ARM=0.6, INITIAL_OVERLAP=0.8, FRICTION_FORCE_PRELOAD=0.9
, FRICTION_TORQUE_PRELOAD=0.7{more}
SIMULATE/DYNAMIC, END=1E-6, STEPS=1
INTEGRATOR/RADAU, ERROR=1E-10
END
"""


def step5(x: float, x0: float, h0: float, x1: float, h1: float) -> float:
    d = min(max((x - x0) / (x1 - x0), 0), 1)
    return h0 + (h1 - h0) * d**3 * (10 - 15 * d + 6 * d * d)


def rubbed(
    joint: str, reaction: Array, slide: float, w: Array, vs: float, effect: str, used: set[str]
) -> tuple[Array, Array]:
    """Friction force and torque on I, from the table of the statement's page; no creep yet."""
    kind = joint.split(" ")[0]
    axis = np.array(AXIS_OF.get(joint, [0, 0, 1.0]))
    F, T = reaction[:3], reaction[3:]
    if "REACTION_FORCE" not in used:
        F = ZERO
    bending = np.linalg.norm(T - (T @ axis) * axis) * ("BENDING_MOMENT" in used)
    twist = abs(T @ axis) * ("TORSIONAL_MOMENT" in used)
    across = np.linalg.norm(F - (F @ axis) * axis)
    pin = across + abs(F @ axis) * 0.15 / 0.3 + bending / 0.4
    load = {
        "TRANSLATIONAL": across + bending / 0.8 + twist / 0.6,
        "CYLINDRICAL": across + bending / 0.8,
        "SPHERICAL": float(np.linalg.norm(F)),
    }.get(kind, pin)
    radius = 0.35 if kind == "SPHERICAL" else 0.3
    along = np.array([0, 0, slide]) if kind in ("TRANSLATIONAL", "CYLINDRICAL") else ZERO
    around = radius * (w if kind == "SPHERICAL" else (w @ axis) * axis)
    around = ZERO if kind == "TRANSLATIONAL" else around
    slip = np.concatenate([along, around])
    speed = float(np.linalg.norm(slip))
    rest, moving = {"ALL": (0.45, 0.25), "SLIDING": (0.25, 0.25), "STICTION": (0.45, 0.0)}[effect]
    share = step5(speed, -vs, -1, vs, 1) * slip / speed
    mu = step5(speed, vs, rest, 1.5 * vs, moving) * share
    fade = step5(speed, vs, 1, 1.5 * vs, 0) if effect == "STICTION" else 1
    own = ("PRELOAD" in used) * fade * share
    return -(mu[:3] * load + 0.9 * own[:3]), -(radius * mu[3:] * load + 0.7 * own[3:])


INPUTS = {"PRELOAD", "REACTION_FORCE", "BENDING_MOMENT", "TORSIONAL_MOMENT"}


@pytest.mark.parametrize("kind", JOINT_OF)
@pytest.mark.parametrize("effect", ["ALL", "SLIDING", "STICTION"])
@pytest.mark.parametrize("vs", [2.0, 0.55, 0.01])
def test_friction_of_a_joint(kind: str, effect: str, vs: float) -> None:
    """Sticking, between and sliding: the friction that the reaction of the same instant asks for,
    and accelerations that reaction, friction, torque and weight explain.
    """
    check_friction(kind, effect, vs, "", INPUTS)


@pytest.mark.parametrize("kind", JOINT_OF)
@pytest.mark.parametrize("left", sorted(INPUTS))
def test_friction_of_a_joint_with_one_input(kind: str, left: str) -> None:
    check_friction(kind, "ALL", 0.01, f", INPUTS={left}", {left})


def check_friction(kind: str, effect: str, vs: float, more: str, used: set[str]) -> None:
    kgrav = 0.0 if kind == "TRANSLATIONAL" else 5.0
    start = start_of(kind)
    joint, _, yoke = kind.partition(" ")
    across = joint == "UNIVERSAL"
    more = f", EFFECT={effect}{more}" + (f", YOKE={yoke}" if yoke else "")
    deck = RUBBING.format(
        kind=joint, j=4 if across else 1, vs=vs, more=more, start=start, kgrav=kgrav
    )
    results = al.simulate(compiled(deck))

    def six_of(name: str) -> Array:
        return np.array([results[f"{name}.{c}"][0] for c in ("fx", "fy", "fz", "tx", "ty", "tz")])

    w = np.array([results[f"PART/2.w{a}"][0] for a in "xyz"])
    arm = np.array([0.2, 0.3, -0.4])
    slide = results["PART/2.vz"][0] - np.cross(w, arm)[2]
    reaction, friction = six_of("JOINT/1"), six_of("FRICTION/1")
    if across:  # friction is written along the axes of J
        friction = np.concatenate([(f[0], f[2], -f[1]) for f in (friction[:3], friction[3:])])
    force, torque = rubbed(kind, reaction, slide, w, vs, effect, used)
    size = np.abs(friction).max() + 1e-3
    assert friction == pytest.approx(np.concatenate([force, torque]), abs=1e-9 * size)
    a, alpha = (np.array([results[f"PART/2.{n}{c}"][0] for c in "xyz"]) for n in ("a", "al"))
    total = reaction + friction + [0, 0, 0, 2, -3, 1.5]
    inertia = np.array([[0.3, -0.05, 0.03], [-0.05, 0.4, -0.02], [0.03, -0.02, 0.5]])
    assert 2 * (a - [3, -7, kgrav]) == pytest.approx(total[:3], abs=1e-8)
    moment = total[3:] - np.cross(arm, total[:3])
    assert inertia @ alpha + np.cross(w, inertia @ w) == pytest.approx(moment, abs=1e-8)


def start_of(kind: str) -> str:
    """Speeds of the mass centre that the joint allows."""
    given = dict(pair.split("=") for pair in JOINT_OF[kind].split(", "))
    w = np.array([float(given.get(f"W{a}", 0)) for a in "XYZ"])
    v = np.cross(w, [0.2, 0.3, -0.4]) + [0, 0, float(given.get("VZ", 0))]
    words = [f"V{a}={float(x)!r}" for a, x in zip("XYZ", v, strict=True)]
    return ", ".join(words + [f"W{a}={float(x)!r}" for a, x in zip("XYZ", w, strict=True)])
