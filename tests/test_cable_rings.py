"""`adamslite cable`: rings that spin, loops that run along themselves, folded chains."""

import numpy as np
import pytest
from descriptions import G, folded, solve

RING = """
title = "Spinning ring"
gravity = [0, 0, 0]
end = {end}
steps = 50
closed = true
speed = {speed}
[cable]
EA = {stiffness}
rho = {density}
[[route]]
kind = "bend"
at = [0, 0, 0]
radius = {radius}
axis = {axis}
[model]
elements = {count}
"""


@pytest.mark.parametrize(("count", "axis"), [(12, [0, 0, 1]), (40, [0, 0, 1]), (40, [0, 0.6, 0.8])])
def test_a_ring_keeps_its_circle_and_its_tension(count: int, axis: list[float]) -> None:
    """T = m v^2/R (pi/N)/sin(pi/N)/(2 pi), m the mass of all nodes: rho w^2 R^2 times the factor.

    VERLET starts (w h)^2/4 too tight and swings by as much; its steps h are at most L/c: relative
    (w L/c)^2/2, and half of it in the radius' share T/EA of that.
    """
    stiffness, density, radius, speed = 2.0e6, 1.2, 0.4, 60.0
    results = solve(
        RING.format(
            end=2 * np.pi * radius / speed, speed=speed, stiffness=stiffness, density=density,
            radius=radius, axis=axis, count=count,
        )
    )  # fmt: skip
    masses = [c for c in results if c.startswith("POINT_MASS/") and c.endswith(".x")]
    assert len(masses) == count
    tension = results["REQUEST/1.F2"]
    free = 2 * radius * np.sin(np.pi / count) / (1 + tension[0] / stiffness)
    mass = density * count * free / (2 * np.pi * radius)
    exact = mass * speed**2 * (np.pi / count) / np.sin(np.pi / count)
    step = free * np.sqrt(density / stiffness)
    np.testing.assert_allclose(tension, exact, rtol=(speed / radius * step) ** 2 / 2 + 1e-9)
    place = np.array([results[f"POINT_MASS/1000.{x}"] for x in "xyz"])
    np.testing.assert_allclose(np.linalg.norm(place, axis=0), radius, rtol=1e-5)
    assert np.abs(np.array(axis) @ place).max() < 1e-12
    np.testing.assert_allclose(place[:, -1], place[:, 0], atol=1e-3 * radius)


def lost(count: int) -> float:
    """How far a loop of two bends and two straight sides is off its outline after a round [m]."""
    half, radius, speed = 0.4, 0.3, 50.0
    spec = f"""
        gravity = [0, 0, 0]
        end = {(4 * half + 2 * np.pi * radius) / speed}
        steps = 10
        closed = true
        speed = {speed}
        [cable]
        EA = 2e6
        rho = 1
        [[route]]
        kind = "bend"
        at = [{-half}, 0, 0]
        radius = {radius}
        [[route]]
        kind = "bend"
        at = [{half}, 0, 0]
        radius = {radius}
        [model]
        elements = {count}
        """
    results = solve(spec)
    off = []
    for k in range(count):
        x, y = (results[f"POINT_MASS/{1000 + k}.{a}"][-1] for a in "xy")
        off.append(np.hypot(max(abs(x) - half, 0.0), y) - radius)
    return float(np.abs(off).max())


def test_a_loop_that_runs_along_itself_keeps_any_outline() -> None:
    """T = rho v^2 whatever the curvature: what is lost to the corners of a polygon, where straight
    sides meet arcs, is less than half with twice the sections."""
    coarse, fine = lost(48), lost(96)
    assert fine < coarse / 2
    assert fine < 0.02 * 0.3


def test_a_folded_chain_falls_faster_than_a_stone() -> None:
    """v^2 = g x (2 l - x)/(l - x): energy of an ideal chain of the length l, the fall x.

    51 sections as lumps: the last link of an arm turns over as a lump, which carries 1/51 of the
    chain and leaves it 3 % slow half way.  4 % of the speed there, and faster than a stone.
    """
    results = solve(folded(0.49, 0.01, "free", end=0.33))
    fall, speed = -results["POINT_MASS/30.y"], -results["POINT_MASS/30.vy"]
    half = np.searchsorted(fall, 0.5)
    length = 2 * 0.49 + np.pi * 0.01
    ideal = np.sqrt(G * fall[half] * (2 * length - fall[half]) / (length - fall[half]))
    assert speed[half] == pytest.approx(ideal, rel=0.04)
    assert speed[half] > 1.1 * np.sqrt(2 * G * fall[half])


def test_a_chain_in_a_fold_hangs_from_both_its_ends() -> None:
    """Both ends held: nothing falls, and an end carries the weight of its arm, rho g l/2.

    The fold of one link settles by less than the radius of its bend, 0.02 m, and with it less than
    rho g times that goes to and fro; the first section counts from its middle, h/2.
    """
    results = solve(folded(0.48, 0.02, "fixed", end=0.5))
    length = 2 * 0.48 + np.pi * 0.02
    mean = np.mean(results["REQUEST/1.F2"] + results["REQUEST/1.F3"]) / 2
    assert mean == pytest.approx(G * length / 2, abs=G * (0.02 + length / 102))
