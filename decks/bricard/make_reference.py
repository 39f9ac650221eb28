"""Write the references of Bricard's mechanism: a chain of five rods, closed by its sixth hinge.

The hinge angles phi (5) move the rods; the closure G phi' = 0 of the last hinge (5 rows, rank 4)
leaves one direction n. With phi" = n s + m, G m = - G' phi':

    (n.M n) s = n.(Q - M m)
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

HINGES = np.array([[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]], float)
AXES = np.eye(3)[[1, 2, 0, 1, 2, 0]]
ALONG, ACROSS, WEIGHT = 0.02 / 12, 1.01 / 12, np.array([0.0, -9.81, 0.0])
LINES = """
Bricard's mechanism, one freedom, DOP853 at rtol 1e-12: see README.md
solve: --error {error:g}
tolerance: abs {band:g}
"""


def turned(axis, angle):
    """Rotation matrix about a unit axis."""
    x, y, z = axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def chain(phi, rates):
    """Of each rod attitude, spin, centre with Jacobians, and accelerations at phi" = 0."""
    attitude, place = np.eye(3), HINGES[0]
    spin, turning, speed, push = (np.zeros(3) for _ in range(4))
    jspin, jspeed = np.zeros((3, 5)), np.zeros((3, 5))
    rods = []
    for k in range(5):
        axis = attitude @ AXES[k]
        turning = turning + np.cross(spin, axis) * rates[k]
        spin = spin + axis * rates[k]
        jspin = jspin.copy()
        jspin[:, k] = axis
        attitude = attitude @ turned(AXES[k], phi[k])
        arm = attitude @ (HINGES[k + 1] - HINGES[k])

        def at(part, arm=arm, base=(place, speed, push, jspeed), w=(spin, turning, jspin)):
            """Place, velocity, acceleration and Jacobian of the velocity on this rod."""
            (p, v, a, jv), (o, da, jo) = base, w
            x = part * arm
            return (p + x, v + np.cross(o, x), a + np.cross(da, x) + np.cross(o, np.cross(o, x)),
                    jv + np.cross(jo.T, x).T)  # fmt: skip

        rods.append((attitude, spin, turning, jspin, at(0.5)))
        place, speed, push, jspeed = at(1.0)
    return rods, (place, push, jspeed)


def acceleration(phi, rates):
    """phi" (5,)."""
    rods, (_, push, jspeed) = chain(phi, rates)
    mass, load = np.zeros((5, 5)), np.zeros(5)
    for k, (attitude, spin, turning, jspin, (_, _, a, jv)) in enumerate(rods):
        along = attitude @ (HINGES[k + 1] - HINGES[k])
        inertia = ACROSS * np.eye(3) + (ALONG - ACROSS) * np.outer(along, along)
        mass += jv.T @ jv + jspin.T @ inertia @ jspin
        twist = inertia @ turning + np.cross(spin, inertia @ spin)
        load += jv.T @ (WEIGHT - a) - jspin.T @ twist
    attitude, spin, turning, jspin, _ = rods[-1]
    hinge = attitude @ AXES[5]
    across = AXES[[3, 4]]  # y and z, which the last hinge has to stay square to
    slope = np.vstack([jspeed, across @ np.cross(jspin.T, hinge).T])
    bias = np.cross(turning, hinge) + np.cross(spin, np.cross(spin, hinge))
    u, s, vt = np.linalg.svd(slope)
    assert s[4] < 1e-6 < 0.05 < s[3]
    m = -vt[:4].T @ ((u.T @ np.concatenate([push, across @ bias]))[:4] / s[:4])
    n = vt[4]
    return n * (n @ (load - mass @ m)) / (n @ mass @ n) + m


def rhs(_, y):
    return np.concatenate([y[5:], acceleration(y[:5], y[5:])])


def check(t, y, point, band):
    """Closure, energy and places known from two other ways of elimination."""
    published = {
        1: (0.510501461, -1.649167599, 0.140123115),
        2: (-0.969340345, -1.221246895, 0.754278011),
        5: (0.999999998, -1.000067258, 0.999932740),
        10: (0.999999964, -1.000269013, 0.999730951),
    }
    for time, place in published.items():
        assert np.allclose(point[np.argmin(np.abs(t - time))], place, rtol=0, atol=band), time
    for state in y:
        rods, (last, _, _) = chain(state[:5], state[5:])
        assert np.allclose(last, HINGES[5], rtol=0, atol=1e-8)
        assert np.isclose(rods[-1][0][0, 0], 1, atol=1e-12)
        energy = 0.0
        for k, (attitude, spin, _, _, (p, v, _, _)) in enumerate(rods):
            along = attitude @ (HINGES[k + 1] - HINGES[k])
            twist = spin @ along
            energy += (v @ v + ACROSS * (spin @ spin - twist**2) + ALONG * twist**2) / 2
            energy -= WEIGHT @ p
        assert np.isclose(energy, -3 * 9.81, rtol=0, atol=1e-8)


def main():
    t = np.linspace(0, 10, 201)
    y = solve(rhs, np.zeros(10), t)
    rods = [chain(s[:5], s[5:])[0] for s in y]
    # Hinge 4 is the end of rod 3: twice the centre of rod 3 less its start (the end of rod 2).
    middle, ends = np.array([r[2][4][0] for r in rods]), np.array([second_end(r) for r in rods])
    point = 2 * middle - ends
    check(t, y, point, 1e-7)
    columns = {f"REQUEST/1.F{c}": point[:, c - 2] for c in (2, 3, 4)}
    for tag, error, band in (("", 1e-6, 1e-3), ("-tight", 1e-8, 1e-5)):
        lines = LINES.format(error=error, band=band)
        write(HERE / f"reference{tag}.csv", lines, list(columns), [t, *columns.values()])


def second_end(rods):
    """End of the second rod."""
    attitude, centre = rods[1][0], rods[1][4][0]
    return centre + attitude @ (HINGES[2] - HINGES[1]) / 2


if __name__ == "__main__":
    main()
