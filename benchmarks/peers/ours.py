"""adamslite itself, through its Python API, from the text of the scene's deck.

The integrators are those of the INTEGRATOR statement: a new one joins by itself.
"""

from __future__ import annotations

import importlib.util
from functools import partial
from typing import Any

import numpy as np

from benchmarks import mechanisms
from benchmarks.decks import OUTPUT_STEPS
from benchmarks.mechanisms import PLANAR, SPATIAL, WATCHED
from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found
from benchmarks.scenes import CHAINS, SCALING, chain, parameters

MECHANISMS = (*PLANAR, *SPATIAL)
#: A fixed step of HHT needs its corrector as exact as that of the hand-coded limit (1e-8 m), whose
#: spectral radius of 0.9 is this ALPHA.
FIXED = "INTEGRATOR/HHT, ALPHA=-0.0526, ERROR=1.0E-5, HINIT={h!r}, HMAX={h!r}, HMIN={h!r}\nSIMULATE"


def installed() -> bool:
    """Whether this checkout can simulate."""
    return module_found("adamslite")() and bool(
        importlib.util.find_spec("adamslite.analyses.simulation")
    )


def solve(options: Settings, scene: str, n: int, settings: Settings) -> Solution:
    """Read, assemble, compile, simulate; the solver measures its own CPU time.

    ``settings`` with "steps" ask for that many equal ones.
    """
    from adamslite import assemble, compile_model, read, simulate

    text = mechanisms.text(scene, n)
    end = chain(scene, n).end if scene in (*CHAINS, *SCALING) else mechanisms.end_time(scene)
    if "steps" in settings:
        text = text.replace("SIMULATE", FIXED.format(h=end / settings["steps"]))
    else:
        options = {**options, **settings}
    laps = Laps()
    model = compile_model(assemble(read(text)))
    setup = laps.lap()
    results = simulate(model, end=end, steps=OUTPUT_STEPS, **options)
    took = results.summary["solve_cpu_s"]
    setup += laps.lap() - took
    ok = results.outcome.name == "DONE"
    values = end_values(results, scene, n) if ok else np.full(1, np.nan)
    why = "" if ok else " ".join((results.message or results.outcome.value).split())[:300]
    return Solution(values, setup, took, results.summary["steps"], ok, why)


def end_values(results: Any, scene: str, n: int) -> np.ndarray:
    """The end state, in the form of ``reference`` or ``mechanisms.truth``."""
    if scene in WATCHED:
        return np.array([results[name][-1] for name in WATCHED[scene].channels])
    if scene == "S3":
        return np.array([results["REQUEST/1.F2"][-1], results["REQUEST/1.F3"][-1]])
    if scene == "S4":
        return np.array([np.pi / 2 + results["REQUEST/1.F2"][-1], four_bar_energy(results, n)])
    ids = range(2, chain(scene, n).n + 2)
    return np.array([[results[f"POINT_MASS/{i}.{a}"][-1] for a in "xyz"] for i in ids])


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


def programs() -> list[Program]:
    """One for every integrator and formulation."""
    if not installed():
        return []
    from adamslite.language.method import AUTO
    from adamslite.verification.variants import Variant, variants

    return [
        Program(
            f"adamslite {variant.label}", "ours", (*CHAINS, *MECHANISMS), ladder,
            partial(solve, variant.options), installed, compiles=True,
        )
        for variant in [*variants(), Variant(AUTO)]
    ]  # fmt: skip


PROGRAMS = programs()
#: The method of the hand-coded limit, for ``same_method``.
FIXED_STEPS = Program(
    "adamslite HHT, equal steps", "ours", ("S1", "S2"), lambda scene, n: [],
    partial(solve, {}), installed, order=2, compiles=True,
)  # fmt: skip
