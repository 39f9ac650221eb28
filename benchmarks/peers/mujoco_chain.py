"""MuJoCo on a chain: bodies on three slides, segments as spatial tendons; fixed-step RK4.

Its implicit integrators are implicit in the velocity only, so stiffness bounds their step as well.
"""

from __future__ import annotations

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, step_counts
from benchmarks.scenes import Chain, chain

MODEL = """<mujoco>
<option timestep="{h!r}" integrator="RK4" gravity="0 {g!r} 0">
<flag contact="disable" constraint="disable"/></option>
<worldbody>{anchors}{bodies}</worldbody><tendon>{tendons}</tendon></mujoco>"""

BODY = """<body pos="{0!r} {1!r} {2!r}"><joint type="slide" axis="1 0 0"/>
<joint type="slide" axis="0 1 0"/><joint type="slide" axis="0 0 1"/>
<inertial pos="0 0 0" mass="{mass!r}" diaginertia="1 1 1"/><site name="{name}"/></body>"""

TENDON = """<spatial stiffness="{k!r}" damping="{d!r}" springlength="{l0!r}">
<site site="{near}"/><site site="{far}"/></spatial>"""


def text(c: Chain, h: float) -> str:
    """The model in MuJoCo's XML."""
    anchors = '<site name="left" pos="{} {} {}"/>'.format(*c.left)
    names = ["left", *(f"s{i}" for i in range(c.n))]
    if c.right is not None:
        anchors += '<site name="right" pos="{} {} {}"/>'.format(*c.right)
        names.append("right")
    bodies = "".join(
        BODY.format(*x.tolist(), mass=float(m), name=name)
        for x, m, name in zip(c.position, c.mass, names[1:], strict=False)
    )
    tendons = "".join(
        TENDON.format(k=float(c.k), d=float(c.d), l0=float(c.l0), near=near, far=far)
        for near, far in zip(names, names[1:], strict=False)
    )
    return MODEL.format(h=h, g=-c.gravity, anchors=anchors, bodies=bodies, tendons=tendons)


def solve(scene: str, n: int, settings: Settings) -> Solution:
    """Solve with a fixed number of steps."""
    import mujoco

    laps = Laps()
    c = chain(scene, n)
    model = mujoco.MjModel.from_xml_string(text(c, c.end / settings["steps"]))
    data = mujoco.MjData(model)
    data.qvel[:] = c.velocity.ravel()
    setup = laps.lap()
    mujoco.mj_step(model, data, nstep=settings["steps"])
    took = laps.lap()
    values = c.position + np.array(data.qpos).reshape(n, 3)
    return Solution(values, setup, took, settings["steps"], bool(np.isfinite(values).all()))


def ladder(scene: str, n: int) -> list[Settings]:
    """Steps from the bound of stability of RK4 on; at N = 1000 one run takes minutes."""
    if n > 400:
        return []
    c = chain(scene, n)
    first = c.end * c.top_frequency / 2.6
    return [{"steps": count} for count in step_counts(int(first) + 1, int(16 * first))]


PROGRAMS = [
    Program("MuJoCo RK4", "explicit", ("S1", "S2"), ladder, solve, module_found("mujoco"), order=4)
]
