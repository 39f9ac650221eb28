"""One program, one file: how each of them is asked to solve a scene.

``PROGRAMS`` knows them all; a program that is not installed is skipped, with a word.
"""

from __future__ import annotations

from benchmarks.peers import (
    casadi_chain,
    exudyn_chain,
    exudyn_mechanism,
    exudyn_payout,
    heyoka_chain,
    limit,
    mujoco_chain,
    numba_chain,
    ode_mechanism,
    ours,
    scipy_chain,
    sundae_chain,
)
from benchmarks.peers.program import Program

PROGRAMS: dict[str, Program] = {
    program.name: program
    for module in (
        ours, exudyn_chain, exudyn_mechanism, exudyn_payout, casadi_chain, sundae_chain,
        scipy_chain, mujoco_chain, numba_chain, heyoka_chain, ode_mechanism, limit,
    )
    for program in module.PROGRAMS
} | {ours.FIXED_STEPS.name: ours.FIXED_STEPS}  # fmt: skip
