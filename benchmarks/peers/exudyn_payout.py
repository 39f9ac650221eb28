"""Exudyn on S5: spring law as a compiled symbolic function, masses and weights reset every step.

Unless ``reuseConstantMassMatrix`` is switched off, the inertia silently stays what it was.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from benchmarks.peers.exudyn_chain import build, load, quiet_settings
from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, step_counts
from benchmarks.scenes import Chain, chain


def let_springs_grow(system: Any, c: Chain) -> Any:
    """Give every spring its law; the caller must keep what is returned."""
    from exudyn import ObjectIndex
    from exudyn.advancedUtilities import CreateSymbolicUserFunction

    l0, rate = c.l0, c.rate

    def force(mbs: Any, t: Any, item: Any, u: Any, v: Any, k: Any, d: Any, f0: Any) -> Any:
        return (k * (u - l0 * rate * t) + d * v) / (1 + rate * t)

    objects = range(system.systemData.NumberOfObjects())
    springs = [i for i in objects if "SpringDamper" in system.GetObject(i)["objectType"]]
    first = ObjectIndex(springs[0])
    law = CreateSymbolicUserFunction(system, force, "springForceUserFunction", first)
    for spring in springs:
        system.SetObjectParameter(spring, "springForceUserFunction", law)
    return law


def let_masses_grow(system: Any, c: Chain) -> None:
    """Have masses and weights reset before every step."""
    objects = range(system.systemData.NumberOfObjects())
    bodies = [i for i in objects if system.GetObject(i)["objectType"] == "MassPoint"]
    masses = c.mass.tolist()

    def reset(mbs: Any, t: float) -> bool:
        grown = 1 + c.rate * t
        for i, (body, mass) in enumerate(zip(bodies, masses, strict=True)):
            mbs.SetObjectParameter(body, "physicsMass", mass * grown)
            mbs.SetLoadParameter(i, "loadVector", [0, -mass * grown * c.gravity, 0])
        return True

    system.SetPreStepUserFunction(reset)


def solve(solver: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with one of Exudyn's ``DynamicSolverType``."""
    exu, items = load()
    laps = Laps()
    c = chain(scene, n)
    system, nodes = build(exu, items, c)
    law = let_springs_grow(system, c)
    let_masses_grow(system, c)
    system.Assemble()
    options = quiet_settings(exu, c.end, settings)
    options.timeIntegration.reuseConstantMassMatrix = False
    kind = getattr(exu.DynamicSolverType, solver)
    setup = laps.lap()
    ok = system.SolveDynamic(options, solverType=kind, storeSolver=True)
    took = laps.lap()
    del law
    position = exu.OutputVariableType.Position
    values = np.array([system.GetNodeOutput(node, position) for node in nodes])
    return Solution(values, setup, took, settings["steps"], bool(ok) and np.isfinite(values).all())


def ladder(scene: str, n: int) -> list[Settings]:
    """Finer than S1 needs: the scene amplifies errors."""
    return [{"steps": count} for count in step_counts(500, 64000)]


PROGRAMS = [
    Program(
        "Exudyn GeneralizedAlpha, growing", "implicit", ("S5",), ladder,
        partial(solve, "GeneralizedAlpha"), module_found("exudyn"), order=2,
    )
]  # fmt: skip
