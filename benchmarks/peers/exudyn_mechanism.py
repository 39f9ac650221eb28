"""Exudyn on mechanisms: rigid bodies in the plane or in space, generalised alpha and index 2."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from benchmarks.mechanisms import GROUND, PLANAR, SPATIAL, Mechanism, mechanism, watched
from benchmarks.peers.exudyn_chain import load, quiet_settings
from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found
from benchmarks.planar import Planar, planar
from benchmarks.scenes import Array

Read = Callable[[], Array]


class Builder:
    """A system in the making: markers on bodies and on the ground."""

    def __init__(self, exu: Any, items: Any) -> None:
        self.items = items
        self.system = exu.SystemContainer().AddSystem()
        self.ground = self.system.AddObject(items.ObjectGround())
        self.bodies: list[int] = []

    def object(self, body: int) -> int:
        """Exudyn's number of a body."""
        return self.ground if body == GROUND else self.bodies[body]

    def marker(self, body: int, point: Array, rigid: bool = False) -> int:
        """A point of a body, in body axes; ``rigid`` when it needs an attitude."""
        kind = self.items.MarkerBodyRigid if rigid else self.items.MarkerBodyPosition
        place = np.zeros(3)
        place[: len(point)] = point
        return self.system.AddMarker(kind(bodyNumber=self.object(body), localPosition=list(place)))

    def weigh(self, body: int, mass: float, gravity: Array) -> None:
        """Add the weight of a body."""
        load = np.zeros(3)
        load[: len(gravity)] = mass * gravity
        at = self.marker(body, np.zeros(3))
        self.system.AddLoad(self.items.LoadForceVector(markerNumber=at, loadVector=list(load)))


def in_plane(exu: Any, items: Any, scene: str, n: int) -> tuple[Any, Read]:
    """A planar system, and what reads the watched values at its end."""
    m: Planar = planar(scene, n)
    builder = Builder(exu, items)
    system, nodes = builder.system, []
    for mass, inertia, place, speed in zip(m.mass, m.inertia, m.place, m.speed, strict=True):
        node = items.NodeRigidBody2D(
            referenceCoordinates=list(place), initialVelocities=list(speed)
        )
        nodes.append(system.AddNode(node))
        body = items.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=nodes[-1])
        builder.bodies.append(system.AddObject(body))
    for body in range(m.n):
        builder.weigh(body, m.mass[body], m.gravity)
        if m.torque[body]:
            turn = items.LoadTorqueVector(
                markerNumber=builder.marker(body, np.zeros(3), rigid=True),
                loadVector=[0, 0, m.torque[body]],
            )
            system.AddLoad(turn)
    for i, p, j, q in m.pins:
        pair = [builder.marker(i, p), builder.marker(j, q)]
        system.AddObject(items.ObjectJointRevolute2D(markerNumbers=pair))
    for i, p, j, q, k, l0 in m.springs:
        pair = [builder.marker(i, p), builder.marker(j, q)]
        spring = items.ObjectConnectorSpringDamper(
            markerNumbers=pair, stiffness=k, damping=0, referenceLength=l0
        )
        system.AddObject(spring)
    for body in m.guides:
        guide(system, items, nodes[body])

    def read() -> Array:
        kind = exu.OutputVariableType
        moved = [system.GetNodeOutput(node, kind.Coordinates) for node in nodes]
        speed = [system.GetNodeOutput(node, kind.Coordinates_t) for node in nodes]
        return watched(scene, n, m.place + np.array(moved), np.array(speed))

    return system, read


def guide(system: Any, items: Any, node: int) -> None:
    """Keep y and angle of a body."""
    fixed = system.AddNode(items.NodePointGround())
    for coordinate in (1, 2):
        pair = [
            system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=at, coordinate=c))
            for at, c in ((fixed, 0), (node, coordinate))
        ]
        system.AddObject(items.ObjectConnectorCoordinate(markerNumbers=pair))


def in_space(exu: Any, items: Any, scene: str, n: int) -> tuple[Any, Read]:
    """A spatial system with Euler parameters, and what reads the watched place."""
    from exudyn.rigidBodyUtilities import RotationMatrix2EulerParameters

    m: Mechanism = mechanism(scene, n)
    builder = Builder(exu, items)
    system = builder.system
    for b in range(m.n):
        start = RotationMatrix2EulerParameters(m.attitude[b])
        node = items.NodeRigidBodyEP(
            referenceCoordinates=[*m.x[b], *start],
            initialVelocities=[*m.v[b], *_quaternion_rate(start, m.w[b])],
        )
        inertia = m.inertia[b]
        six = [*np.diag(inertia), inertia[1, 2], inertia[0, 2], inertia[0, 1]]
        body = items.ObjectRigidBody(
            physicsMass=m.mass[b], physicsInertia=six, nodeNumber=system.AddNode(node)
        )
        builder.bodies.append(system.AddObject(body))
        builder.weigh(b, m.mass[b], m.gravity)
    for joint in m.joints:
        sides = ((joint.i, joint.p), (joint.j, joint.q))
        pair = [builder.marker(body, point, rigid=True) for body, point in sides]
        held = [1, 1, 1, 0, 0, 0] if joint.kind == "SPHERICAL" else [1, 1, 1, 1, 1, 0]
        hinge = items.ObjectJointGeneric(
            markerNumbers=pair, constrainedAxes=held,
            rotationMarker0=joint.axes_i, rotationMarker1=joint.axes_j,
        )  # fmt: skip
        system.AddObject(hinge)
    body, point = m.watch
    seen = builder.marker(body, point, rigid=True)

    def read() -> Array:
        return system.GetMarkerOutput(seen, exu.OutputVariableType.Position)

    return system, read


def _quaternion_rate(p: Array, w: Array) -> Array:
    """Rate of Euler parameters p for an angular velocity w in ground axes."""
    return 0.5 * np.array([-p[1:] @ w, *(p[0] * w + np.cross(w, p[1:]))])


def solve(solver: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with generalised alpha (index 3) or the index-2 trapezoidal rule."""
    exu, items = load()
    end = mechanism(scene, n).end
    laps = Laps()
    system, read = (in_space if scene in SPATIAL else in_plane)(exu, items, scene, n)
    system.Assemble()
    options = quiet_settings(exu, end, settings)
    options.timeIntegration.newton.relativeTolerance = 1e-8
    if scene == "Bricard":  # one row is redundant by the directions of the hinges
        options.linearSolver.solverType = exu.LinearSolverType.EigenDense
        options.linearSolver.ignoreSingularJacobian = True
    kind = getattr(exu.DynamicSolverType, solver)
    setup = laps.lap()
    ok = system.SolveDynamic(options, solverType=kind, storeSolver=True)
    took = laps.lap()
    values = np.array(read())
    return Solution(values, setup, took, settings["steps"], bool(ok) and np.isfinite(values).all())


def ladder(scene: str, n: int) -> list[Settings]:
    """Its second order needs many steps for ten turns."""
    return [{"steps": steps} for steps in (1000, 3000, 10000, 30000, 100000, 300000, 1000000)]


PROGRAMS = [
    Program(
        f"Exudyn {solver}, mechanism", "implicit", (*PLANAR, *SPATIAL), ladder,
        partial(solve, solver), module_found("exudyn"), order=2,
    )
    for solver in ("GeneralizedAlpha", "TrapezoidalIndex2")
]  # fmt: skip
