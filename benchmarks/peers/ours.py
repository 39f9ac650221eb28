"""adamslite itself, through its Python API, from the text of the scene's deck."""

from __future__ import annotations

import importlib.util
from functools import partial
from typing import Any

import numpy as np

from benchmarks.decks import OUTPUT_STEPS, deck
from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found
from benchmarks.scenes import CHAINS, chain, parameters


def installed() -> bool:
    """Whether this checkout can simulate."""
    return module_found("adamslite")() and bool(importlib.util.find_spec("adamslite.simulate"))


def solve(options: Settings, scene: str, n: int, settings: Settings) -> Solution:
    """Read, assemble, compile, simulate; the solver tells its own CPU time."""
    from adamslite import assemble, compile_model, read, simulate

    text = deck(scene, n)
    end = parameters()[scene]["T"]
    laps = Laps()
    model = compile_model(assemble(read(text)))
    setup = laps.lap()
    results = simulate(model, end=end, steps=OUTPUT_STEPS, **options, **settings)
    took = results.summary["solve_cpu_s"]
    setup += laps.lap() - took
    ok = results.outcome.name == "DONE"
    values = end_values(results, scene, n)
    return Solution(values, setup, took, results.summary["steps"], ok)


def end_values(results: Any, scene: str, n: int) -> np.ndarray:
    """The end state, in the form of ``reference``."""
    if scene in CHAINS:
        ids = range(2, chain(scene, n).n + 2)
        return np.array([[results[f"POINT_MASS/{i}.{a}"][-1] for a in "xyz"] for i in ids])
    if scene == "S3":
        return np.array([results["REQUEST/1.F2"][-1], results["REQUEST/1.F3"][-1]])
    return np.array([np.pi / 2 + results["REQUEST/1.F2"][-1], four_bar_energy(results, n)])


def four_bar_energy(results: Any, n: int) -> float:
    """Kinetic and potential energy [J] at the end of S4."""
    p = parameters()["S4"]
    m, inertia, energy = p["m"], p["m"] * p["L"] ** 2 / 12, 0.0
    for i in (*range(1000, 1001 + n), *range(2000, 2000 + n)):
        speed = [results[f"PART/{i}.{a}"][-1] for a in ("vx", "vy", "vz")]
        spin = [results[f"PART/{i}.{a}"][-1] for a in ("wx", "wy", "wz")]
        energy += 0.5 * m * np.dot(speed, speed) + 0.5 * inertia * np.dot(spin, spin)
        energy += m * p["g"] * results[f"PART/{i}.y"][-1]
    return energy


def ladder(scene: str, n: int) -> list[Settings]:
    """ERROR from 1e-2 to 1e-11, two a decade."""
    return [{"error": float(f"{x:.2g}")} for x in np.geomspace(1e-2, 1e-11, 19)]


def program(title: str, **options: Any) -> Program:
    """One integrator of ours."""
    scenes = (*CHAINS, "S3", "S4")
    run = partial(solve, options)
    return Program(f"adamslite {title}", "ours", scenes, ladder, run, installed, compiles=True)


PROGRAMS = [
    program("GSTIFF SI2", integrator="GSTIFF", formulation="SI2"),
    program("GSTIFF I3", integrator="GSTIFF", formulation="I3"),
]
