"""Exudyn's reeving system: one spring without mass, tangent to all sheaves.

Its free length grows with a coordinate, which a constraint moves as the winch does; the rate enters
the damper. The load at the end of the rope needs a marker of a rigid body.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from benchmarks import rope_cases as cases
from benchmarks.peers.exudyn_chain import load, quiet_settings
from benchmarks.peers.program import Laps
from benchmarks.rope_cases import LIGHT, LOWERED, Answer, RopeRun


def winch(system: Any, items: Any) -> Any:
    """Marker of a coordinate that is the length paid out [m]."""
    coordinate = system.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    system.AddObject(items.Mass1D(mass=1.0, nodeNumber=coordinate))
    moved = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=coordinate, coordinate=0))
    ground = system.AddNode(items.NodePointGround())
    held = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    system.AddObject(
        items.CoordinateConstraint(
            markerNumbers=[held, moved],
            offsetUserFunction=lambda mbs, t, item, offset: cases.payout(t)[0],
            offsetUserFunction_t=lambda mbs, t, item, offset: cases.payout(t)[1],
        )
    )
    return moved


def lowered(scene: str, step: float) -> Answer:
    """Mean tension of the rope, from generalised alpha with equal steps."""
    exu, items = load()
    laps = Laps()
    system = exu.SystemContainer().AddSystem()
    ground = system.AddObject(items.ObjectGround())
    top = system.AddMarker(items.MarkerBodyRigid(bodyNumber=ground))
    low = -cases.START * (1 + cases.WEIGHT * cases.G / cases.EA)
    node = system.AddNode(items.NodeRigidBodyEP(referenceCoordinates=[0, low, 0, 1, 0, 0, 0]))
    body = items.ObjectRigidBody(mass=cases.WEIGHT, inertia=[1, 1, 1, 0, 0, 0], nodeNumber=node)
    hook = system.AddMarker(items.MarkerBodyRigid(bodyNumber=system.AddObject(body)))
    weight = [0, -cases.WEIGHT * cases.G, 0]
    system.AddLoad(items.Force(markerNumber=hook, loadVector=weight))
    paid = winch(system, items)
    rope = system.AddObject(
        items.ReevingSystemSprings(
            markerNumbers=[top, hook, paid, paid], hasCoordinateMarkers=True,
            coordinateFactors=[1, 0], stiffnessPerLength=cases.EA,
            dampingPerLength=0.4 * np.sqrt(cases.EA * cases.RHO) * cases.START,
            referenceLength=cases.START, regularizationForce=-1,
            sheavesAxes=exu.Vector3DList([[0, 0, 1.0]] * 2), sheavesRadii=[0, 0],
        )
    )  # fmt: skip
    force = exu.OutputVariableType.ForceLocal
    sensor = system.AddSensor(
        items.SensorObject(objectNumber=rope, storeInternal=True, outputVariableType=force)
    )
    system.Assemble()
    options = quiet_settings(exu, cases.END, {"steps": round(cases.END / step)})
    options.solution.sensors.active, options.solution.sensors.writePeriod = True, 1e-2
    setup = laps.lap()
    system.SolveDynamic(options)
    solve = laps.lap()
    t, pull = system.GetSensorStoredData(sensor).T
    a, b = cases.WINDOWS[scene]
    inside = (t > a - 1e-9) & (t < b + 1e-9)
    return Answer(float(np.trapezoid(pull[inside], t[inside]) / (b - a)), setup, solve)


def runs() -> list[RopeRun]:
    """With the mass of the rope, which the spring leaves out, and without."""
    return [
        RopeRun(scene, "exudyn", "5000 steps", partial(lowered, scene, 1e-3))
        for scene in (LOWERED, LIGHT)
    ]
