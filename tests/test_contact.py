"""CONTACT against plain formulas: accelerations at random postures, in any units."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from constraint_decks import BODIES
from newton_matrix import matrix_error
from oracle import Flight, Marker, reported

Array = np.ndarray
SEEDS = (0, 1, 3)
NORMAL = {"IMPACT": (3.0, 1.7, 0.9, 0.4), "POISSON": (3.0, 0.6)}
MU = (0.5, 0.3)
Touch = tuple[float, Array, Array]
"""Depth, normal from J to I, common point in ground."""


# ------------------------------------------------------------------------------------- geometry


def ball(centre: Array, radius: float, depth: float, normal: Array) -> Touch:
    return depth, normal, centre - (radius - depth / 2) * normal


def on_plane(centre: Array, radius: float, j: Marker) -> Touch:
    normal = j.A[:, 2]
    return ball(centre, radius, radius - (centre - j.r) @ normal, normal)


def on_body(centre: Array, radius: float, nearest: Array) -> Touch:
    away = centre - nearest
    distance = np.linalg.norm(away)
    return ball(centre, radius, radius - distance, away / distance)


def on_box(centre: Array, radius: float, j: Marker, edges: Array) -> Touch:
    at = j.A.T @ (centre - j.r)
    return on_body(
        centre, radius, j.r + j.A @ np.clip(at, np.minimum(edges, 0), np.maximum(edges, 0))
    )


def on_cylinder(centre: Array, radius: float, j: Marker, length: float, thick: float) -> Touch:
    at = j.A.T @ (centre - j.r)
    aside = at[:2] * min(1.0, thick / np.linalg.norm(at[:2]))
    along = np.clip(at[2], min(length, 0), max(length, 0))
    return on_body(centre, radius, j.r + j.A @ np.array([*aside, along]))


def rim(i: Marker, along: float, radius: float, j: Marker) -> Touch:
    """The lowest point of an edge, further inside where its end is nearly level: at R f'(s) from
    the centre, f = sqrt(s^2 + a^2) - a (1 - s^2)^2, s: sine of the slant, a: 0.001.
    """
    normal, axis = j.A[:, 2], i.A[:, 2]
    slant = normal - (normal @ axis) * axis
    s, a = np.linalg.norm(slant), 1e-3
    centre = i.r + along * axis
    reach = np.hypot(s, a) - a * (1 - s**2) ** 2
    slope = s / np.hypot(s, a) + 4 * a * s * (1 - s**2)
    depth = radius * reach - (centre - j.r) @ normal
    return depth, normal, centre - radius * slope * slant / s + depth / 2 * normal


# -------------------------------------------------------------------------------------- the law


def push(law: str, depth: float, rate: float) -> float:
    if depth <= 0:
        return 0.0
    if law == "IMPACT":
        k, e, c, d = NORMAL[law]
        share = min(depth / d, 1.0)
        return max(0.0, k * depth**e + c * share**2 * (3 - 2 * share) * rate)
    k, e = NORMAL[law]
    return k * depth * (1.0 if rate >= 0 else e**2)


def grip(speed: float, vs: float, vd: float) -> float:
    u = speed / vs
    if u <= 1:
        return MU[0] * u * (3 - u * u) / 2
    share = min((speed - vs) / (vd - vs), 1.0)
    return MU[0] + (MU[1] - MU[0]) * share**2 * (3 - 2 * share)


def loads(i: Marker, j: Marker, touch: Touch, law: str, slow: tuple[float, float]) -> list:
    """Both sides' load at the common point."""
    depth, normal, point = touch
    v = i.v + np.cross(i.w, point - i.r) - j.v - np.cross(j.w, point - j.r)
    load = push(law, depth, -v @ normal)
    slip = v - (v @ normal) * normal
    speed = np.linalg.norm(slip)
    force = load * (normal - grip(speed, *slow) * slip / speed)
    zero = np.zeros(3)
    return [(i.body, point, force, zero), (j.body, point, -force, zero)]


# ----------------------------------------------------------------------------------- the shapes

Shapes = tuple[str, str, Callable[[Marker, Marker], list[Touch]]]


def shapes(name: str, i: int, j: int, a: float) -> Shapes:
    """Statements of both shapes and their touches; a: a length at which they overlap."""
    sphere = f"GRAPHICS/1, ELLIPSOID, CM={i}, XS={2 * a!r}, YS={2 * a!r}, ZS={2 * a!r}"
    box = np.array([0.4, -0.3, 0.5]) * a
    edges = ", ".join(f"{axis}={float(v)!r}" for axis, v in zip("XYZ", box, strict=True))
    corners = [box * np.array(s) for s in np.ndindex(2, 2, 2)]
    long, thick = -0.6 * a, 0.3 * a
    plane = f"GRAPHICS/2, PLANE, RM={j}"
    return {
        "ball on plane": (sphere, plane, lambda p, q: [on_plane(p.r, a, q)]),
        "point on plane": (
            f"GRAPHICS/1, POINT, RM={i}", plane, lambda p, q: [on_plane(p.r, 0.0, q)],
        ),
        "ball on ball": (
            sphere, f"GRAPHICS/2, ELLIPSOID, CM={j}, XS={a!r}, YS={a!r}, ZS={a!r}",
            lambda p, q: [
                ball(p.r, a, 1.5 * a - np.linalg.norm(p.r - q.r),
                     (p.r - q.r) / np.linalg.norm(p.r - q.r))
            ],
        ),
        "ball on box": (
            sphere, f"GRAPHICS/2, BOX, CORNER={j}, {edges}",
            lambda p, q: [on_box(p.r, a, q, box)],
        ),
        "ball on cylinder": (
            sphere, f"GRAPHICS/2, CYLINDER, CM={j}, LENGTH={long!r}, RADIUS={thick!r}",
            lambda p, q: [on_cylinder(p.r, a, q, long, thick)],
        ),
        "box on plane": (
            f"GRAPHICS/1, BOX, CORNER={i}, {edges}", plane,
            lambda p, q: [on_plane(p.r + p.A @ c, 0.0, q) for c in corners],
        ),
        "cylinder on plane": (
            f"GRAPHICS/1, CYLINDER, CM={i}, LENGTH={long!r}, RADIUS={thick!r}", plane,
            lambda p, q: [rim(p, z, thick, q) for z in (0.0, long)],
        ),
        "frustum on plane": (
            f"GRAPHICS/1, FRUSTUM, CM={i}, LENGTH={long!r}, BOTTOM={thick!r}, TOP={a!r}", plane,
            lambda p, q: [rim(p, z, r, q) for z, r in ((0.0, thick), (long, a))],
        ),
    }[name]  # fmt: skip


# Their kernels take several seconds to compile.
LONG = {"ball on box": pytest.mark.slow}
NAMES = (
    "ball on plane", "point on plane", "ball on ball", "ball on box", "ball on cylinder",
    "box on plane", "cylinder on plane", "frustum on plane",
)  # fmt: skip


def statement(law: str, slow: tuple[float, float], sides: str) -> str:
    words = {
        "IMPACT": "STIFFNESS={}, EXPONENT={}, DAMPING={}, DMAX={}",
        "POISSON": "PENALTY={}, RESTITUTION_COEFFICIENT={}",
    }[law].format(*NORMAL[law])
    return (
        f"CONTACT/1, {sides}, {law}, {words}, COULOMB_FRICTION=ON, MU_STATIC={MU[0]}"
        f", MU_DYNAMIC={MU[1]}, STICTION_TRANSITION_VELOCITY={slow[0]!r}"
        f", FRICTION_TRANSITION_VELOCITY={slow[1]!r}"
    )


@pytest.mark.parametrize("name", [pytest.param(each, marks=LONG.get(each, ())) for each in NAMES])
@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_of_touching_bodies(name: str, seed: int) -> None:
    """The slip is below, between and above the transition velocities by the seed."""
    law, swapped = ("POISSON", True) if seed == 1 else ("IMPACT", False)
    flight = Flight(seed)
    i, j = flight.pick(2)
    p, q = flight[i], flight[j]
    a = 1.3 * float(np.linalg.norm(p.r - q.r))
    first, second, touches = shapes(name, i, j, a)
    speed = float(np.linalg.norm(p.v - q.v)) + 1e-3 * a
    slow = ((9 * speed, 10 * speed), (0.3 * speed, 3 * speed), (0.01 * speed, 0.02 * speed))
    edge = slow[SEEDS.index(seed)]
    sides = "IGEOM=2, JGEOM=1" if swapped else "IGEOM=1, JGEOM=2"
    found = touches(p, q)
    expected = [each for touch in found for each in loads(p, q, touch, law, edge)]
    depths = [touch[0] for touch in found]
    results = flight.run(first, second, statement(law, edge, sides))
    bodies = flight.accelerations(expected)
    for part in (slice(0, 3), slice(3, 6)):
        size = np.abs(bodies[:, part]).max()
        got = reported(results)[:, part]
        assert got == pytest.approx(bodies[:, part], abs=1e-6 * size)
    on_i = sum(load[2] for load in expected if load[0] == p.body) * (-1 if swapped else 1)
    measured = [results[f"CONTACT/1.f{axis}"][0] for axis in "xyz"]
    assert measured == pytest.approx(on_i, rel=1e-6, abs=1e-9)
    assert results["CONTACT/1.incidents"][0] == sum(depth > 0 for depth in depths)
    assert results["CONTACT/1.depth"][0] == pytest.approx(max(0.0, *depths), rel=1e-6)


# ------------------------------------------------------------------------------- exact derivatives


@pytest.mark.parametrize("slow", [0.05, 1.0, 30.0])
@pytest.mark.parametrize(
    "name", ["ball on ball", pytest.param("box on plane", marks=pytest.mark.slow)]
)
def test_the_newton_matrix_agrees_with_differences(name: str, slow: float) -> None:
    """With friction that sticks, and transition velocities below, at and beyond the slip."""
    first, second, _ = shapes(name, 21, 31, 1.5)
    law = statement("IMPACT", (slow, 2 * slow), "IGEOM=1, JGEOM=2")
    held = f"{law}, STICTION=ON, MAX_STICTION_DEFORMATION=2"
    assert matrix_error(f"{BODIES}{first}\n{second}\n{held}\nEND\n", False) < 1e-6
