"""Exudyn on S3 and S4: planar rigid bodies with planar revolute joints."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from benchmarks.peers.exudyn_chain import load, quiet_settings
from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found
from benchmarks.scenes import parameters


class Plane:
    """A planar system in the making; gravity pulls along -y."""

    def __init__(self, exu: Any, items: Any, gravity: float) -> None:
        self.system = exu.SystemContainer().AddSystem()
        self.items, self.gravity = items, gravity
        self.ground = self.system.AddObject(items.ObjectGround())

    def marker(self, body: int, x: float, y: float = 0.0) -> int:
        """A point of a body, in body axes."""
        return self.system.AddMarker(
            self.items.MarkerBodyPosition(bodyNumber=body, localPosition=[x, y, 0])
        )

    def weigh(self, body: int, mass: float) -> None:
        """Add the weight of a body."""
        load = [0, -mass * self.gravity, 0]
        self.system.AddLoad(
            self.items.LoadForceVector(markerNumber=self.marker(body, 0), loadVector=load)
        )

    def body(self, mass: float, inertia: float, place: list, speed: list) -> tuple[int, int]:
        """A rigid body; place and speed are those of x, y and the angle."""
        node = self.system.AddNode(
            self.items.NodeRigidBody2D(referenceCoordinates=place, initialVelocities=speed)
        )
        body = self.system.AddObject(
            self.items.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=node)
        )
        self.weigh(body, mass)
        return node, body

    def pin(self, *markers: int) -> None:
        """A revolute joint of two markers."""
        self.system.AddObject(self.items.ObjectJointRevolute2D(markerNumbers=list(markers)))


def slider_crank(exu: Any, items: Any) -> tuple[Any, Any]:
    """S3, and what reads the angle of the crank and the place of the slider."""
    p = parameters()["S3"]
    r, length, w = p["r"], p["l"], p["omega0"]
    plane = Plane(exu, items, p["g"])
    crank_node, crank = plane.body(p["m_crank"], p["J_crank"], [r / 2, 0, 0], [0, w * r / 2, w])
    start = [r + length / 2, 0, 0]
    _, rod = plane.body(p["m_rod"], p["J_rod"], start, [0, w * r / 2, -w * r / length])
    system = plane.system
    slider_node = system.AddNode(items.NodePoint2D(referenceCoordinates=[r + length, 0]))
    mass = p["m_slider"]
    slider = system.AddObject(items.ObjectMassPoint2D(mass=mass, nodeNumber=slider_node))
    plane.weigh(slider, mass)
    plane.pin(plane.marker(plane.ground, 0), plane.marker(crank, -r / 2))
    plane.pin(plane.marker(crank, r / 2), plane.marker(rod, -length / 2))
    plane.pin(plane.marker(rod, length / 2), plane.marker(slider, 0))
    height = items.MarkerNodeCoordinate(nodeNumber=slider_node, coordinate=1)
    fixed = system.AddNode(items.NodePointGround())
    zero = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=fixed, coordinate=0))
    guide = [zero, system.AddMarker(height)]
    system.AddObject(items.ObjectConnectorCoordinate(markerNumbers=guide))

    def read() -> list[float]:
        kind = exu.OutputVariableType.Coordinates
        angle = system.GetNodeOutput(crank_node, kind)[2]
        return [angle, r + length + system.GetNodeOutput(slider_node, kind)[0]]

    return system, read


def four_bar(exu: Any, items: Any, n: int) -> tuple[Any, Any]:
    """S4, and what reads the angle of the first upright and the energy."""
    p = parameters()["S4"]
    length, m, v = p["L"], p["m"], p["v0"]
    inertia = m * length**2 / 12
    plane = Plane(exu, items, p["g"])
    half = length / 2
    uprights = [
        plane.body(m, inertia, [i * length, half, np.pi / 2], [v / 2, 0, -v / length])
        for i in range(n + 1)
    ]
    couplers = [
        plane.body(m, inertia, [(i + 0.5) * length, length, 0], [v, 0, 0]) for i in range(n)
    ]
    for i, (_, upright) in enumerate(uprights):
        plane.pin(plane.marker(plane.ground, i * length), plane.marker(upright, -half))
    for i, (_, coupler) in enumerate(couplers):
        for side, (_, upright) in zip((-half, half), uprights[i : i + 2], strict=True):
            plane.pin(plane.marker(upright, half), plane.marker(coupler, side))

    def read() -> list[float]:
        kind, energy = exu.OutputVariableType, 0.0
        for node, _ in uprights + couplers:
            y = plane.system.GetNodeOutput(node, kind.Position)[1]
            rate = plane.system.GetNodeOutput(node, kind.Coordinates_t)
            energy += 0.5 * m * (rate[0] ** 2 + rate[1] ** 2) + 0.5 * inertia * rate[2] ** 2
            energy += m * p["g"] * y
        turned = plane.system.GetNodeOutput(uprights[0][0], kind.Coordinates)[2]
        return [np.pi / 2 + turned, energy]

    return plane.system, read


def solve(solver: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with generalised alpha (index 3) or the index-2 trapezoidal rule."""
    exu, items = load()
    laps = Laps()
    system, read = slider_crank(exu, items) if scene == "S3" else four_bar(exu, items, n)
    system.Assemble()
    options = quiet_settings(exu, parameters()[scene]["T"], settings)
    options.timeIntegration.newton.relativeTolerance = 1e-8
    kind = getattr(exu.DynamicSolverType, solver)
    setup = laps.lap()
    ok = system.SolveDynamic(options, solverType=kind, storeSolver=True)
    took = laps.lap()
    values = np.array(read())
    return Solution(values, setup, took, settings["steps"], bool(ok) and np.isfinite(values).all())


def ladder(scene: str, n: int) -> list[Settings]:
    """Its second order needs many steps for ten turns."""
    return [{"steps": steps} for steps in (1000, 10000, 50000, 200000, 500000)]


PROGRAMS = [
    Program(
        f"Exudyn {solver}, planar", "implicit", ("S3", "S4"), ladder, partial(solve, solver),
        module_found("exudyn"), order=2,
    )
    for solver in ("GeneralizedAlpha", "TrapezoidalIndex2")
]  # fmt: skip
