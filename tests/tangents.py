"""Tangents of kernels against differences of the kernels themselves, in all that they read."""

from __future__ import annotations

import ctypes

import numpy as np

from adamslite.equations.instances import PHASES
from adamslite.equations.system import System
from adamslite.kernels.compile import tangents

POINTERS = ctypes.c_void_p
VALUE = ctypes.CFUNCTYPE(None, ctypes.c_int64, *[POINTERS] * 4)
TANGENT = ctypes.CFUNCTYPE(None, ctypes.c_int64, *[POINTERS] * 6)
STEP = 2e-4


def compare_tangents(scene: System, phases: int, tolerance: float = 1e-8) -> None:
    """Every group of the phases, in a random direction of workspace and parameters."""
    scene.records()
    some = np.random.default_rng(7)
    for k, group in enumerate(scene.kernels.groups):
        if PHASES[group.face] & phases or group.face == "output":
            _compare(scene, k, some, tolerance)


def _compare(scene: System, k: int, some: np.random.Generator, tolerance: float) -> None:
    group, row = scene.kernels.groups[k], scene.group[k]
    count, ints, numbers = (
        int(row.count),
        scene.instances.keep[2 * k],
        scene.instances.keep[2 * k + 1],
    )
    size = scene.W.size + scene.nz + scene.instances.n_out
    reals, dreals = numbers.copy(), some.standard_normal(numbers.size) * (numbers != 0.0)
    dreals[~np.isfinite(numbers)] = 0.0
    memory = reals[:-1].reshape(count, -1) if reals.size > 1 else np.zeros((count, 0))
    params = len(group.instances.columns.params)
    kept = slice(params, params + group.meta["angles"] + group.meta["limits"])
    if memory.size:
        dreals[:-1].reshape(count, -1)[:, kept] = 0.0
    W, dW = scene.W.copy(), np.zeros(scene.W.size)
    dW[6 : scene.nw] = some.standard_normal(scene.nw - 6)
    dW[0] = 1.0
    of_states = [scene.numbering.scalar[scene.m + scene.nv + j] + 2 for j in range(scene.ns)]
    dW[of_states] = 0.0

    def value(step: float) -> np.ndarray:
        found = np.zeros(size)
        w, r = W + step * dW, reals + step * np.where(np.isfinite(reals), dreals, 0.0)
        VALUE(int(row.residual))(
            count, ints.ctypes.data, r.ctypes.data, w.ctypes.data, found.ctypes.data
        )
        return found

    near, far = (value(h) - value(-h) for h in (STEP, 2.0 * STEP))
    expected = (8.0 * near - far) / (12.0 * STEP)
    made = np.zeros(size)
    TANGENT(tangents(scene.kernels, group)[0])(
        count, ints.ctypes.data, reals.ctypes.data, W.ctypes.data, dreals.ctypes.data,
        dW.ctypes.data, made.ctypes.data,
    )  # fmt: skip
    gap = np.abs(made - expected) / (1.0 + np.abs(expected) + np.abs(value(0.0)))
    at, label = gap.argmax(), group.instances.statements[0].label
    assert np.nanmax(gap, initial=0.0) < tolerance, (label, group.face, made[at], expected[at])
    assert np.isfinite(made[np.isfinite(expected)]).all(), label
