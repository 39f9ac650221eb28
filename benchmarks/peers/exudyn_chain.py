"""Exudyn on S1 and S2: mass points and spring-dampers; generalised alpha, and its explicit types.

Tuned as far as it goes: its fast module, modified Newton, a Newton tolerance at which the error no
longer changes, the sparse pattern kept.
"""

from __future__ import annotations

import sys
from functools import partial
from typing import Any

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, step_counts
from benchmarks.scenes import Array, Chain, chain


def load() -> tuple[Any, Any]:
    """Exudyn and its items, in the version compiled for AVX2."""
    sys.exudynFast = True
    import exudyn
    import exudyn.itemInterface as items

    return exudyn, items


def quiet_settings(exu: Any, end: float, settings: Settings) -> Any:
    """Simulation settings that write nothing and keep what can be kept."""
    s = exu.SimulationSettings()
    s.solution.file.write = False
    s.solution.sensors.active = False
    s.solution.file.writePeriod = end
    s.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    s.linearSolver.reuseAnalyzedPattern = True
    time = s.timeIntegration
    time.endTime, time.verboseMode = end, 0
    time.numberOfSteps = settings["steps"]
    time.newton.useModifiedNewton = settings.get("newton", "modified") == "modified"
    time.newton.relativeTolerance = settings.get("tolerance", 1e-6)
    time.newton.absoluteTolerance = 1e-10
    time.generalizedAlpha.spectralRadius = 0.9
    return s


def build(exu: Any, items: Any, c: Chain) -> tuple[Any, list[int]]:
    """The assembled system and its nodes."""
    system = exu.SystemContainer().AddSystem()
    ground = system.AddObject(items.ObjectGround())

    def anchor(point: Array) -> int:
        return system.AddMarker(
            items.MarkerBodyPosition(bodyNumber=ground, localPosition=list(point))
        )

    nodes, markers = [], [anchor(c.left)]
    for mass, x, v in zip(c.mass.tolist(), c.position, c.velocity, strict=True):
        node = items.NodePoint(referenceCoordinates=list(x), initialVelocities=list(v))
        nodes.append(system.AddNode(node))
        system.AddObject(items.ObjectMassPoint(mass=mass, nodeNumber=nodes[-1]))
        markers.append(system.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[-1])))
        weight = [0, -mass * c.gravity, 0]
        system.AddLoad(items.LoadForceVector(markerNumber=markers[-1], loadVector=weight))
    if c.right is not None:
        markers.append(anchor(c.right))
    for pair in zip(markers, markers[1:], strict=False):
        system.AddObject(
            items.ObjectConnectorSpringDamper(
                markerNumbers=list(pair), stiffness=c.k, damping=c.d, referenceLength=c.l0
            )
        )
    system.Assemble()
    return system, nodes


def solve(solver: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with one of Exudyn's ``DynamicSolverType``."""
    exu, items = load()
    laps = Laps()
    c = chain(scene, n)
    system, nodes = build(exu, items, c)
    options = quiet_settings(exu, c.end, settings)
    kind = getattr(exu.DynamicSolverType, solver)
    setup = laps.lap()
    ok = system.SolveDynamic(options, solverType=kind, storeSolver=True)
    took = laps.lap()
    position = exu.OutputVariableType.Position
    values = np.array([system.GetNodeOutput(node, position) for node in nodes])
    return Solution(values, setup, took, settings["steps"], bool(ok) and np.isfinite(values).all())


def implicit_ladder(scene: str, n: int) -> list[Settings]:
    """Steps from loose to 16 times as fine as the finest scene needs for 1e-5."""
    return [{"steps": count} for count in step_counts(250, 16000)]


def explicit_ladder(stage_bound: float, scene: str, n: int) -> list[Settings]:
    """Steps from the bound of stability on: bound / top frequency."""
    c = chain(scene, n)
    first = c.end * c.top_frequency / stage_bound
    return [{"steps": count} for count in step_counts(int(first) + 1, int(32 * first))]


def program(solver: str, kind: str, ladder: Any, order: int) -> Program:
    """One solver type as a program."""
    return Program(
        f"Exudyn {solver}", kind, ("S1", "S2"), ladder, partial(solve, solver),
        module_found("exudyn"), order,
    )  # fmt: skip


PROGRAMS = [
    program("GeneralizedAlpha", "implicit", implicit_ladder, 2),
    program("RK44", "explicit", partial(explicit_ladder, 2.6), 4),
    program("VelocityVerlet", "explicit", partial(explicit_ladder, 1.8), 2),
]
