"""Pullbacks of kernels against their tangents: nu . (T d) = (P nu) . d in any direction d."""

from __future__ import annotations

import ctypes

import numpy as np

from adamslite.equations.instances import PHASES
from adamslite.equations.system import System
from adamslite.kernels.compile import tangents
from adamslite.kernels.pullback import pullback
from adamslite.model.model import PART

CALL = ctypes.CFUNCTYPE(None, ctypes.c_int64, *[ctypes.c_void_p] * 6)
ATTITUDE = 15


def compare_pullbacks(scene: System, phases: int, tolerance: float = 1e-10) -> None:
    """Every group of the phases and what is written, in a direction of workspace and reals."""
    scene.records()
    some = np.random.default_rng(11)
    for k, group in enumerate(scene.kernels.groups):
        if PHASES[group.face] & phases or group.face == "output":
            _compare(scene, k, some, tolerance)


def _compare(scene: System, k: int, some: np.random.Generator, tolerance: float) -> None:
    group, W = scene.kernels.groups[k], scene.W
    count, ints, reals = len(group.instances), *scene.instances.keep[2 * k : 2 * k + 2]
    size = W.size + scene.nz + scene.instances.n_out
    dreals = some.standard_normal(reals.size) * np.isfinite(reals)
    params = len(group.instances.columns.params)
    if reals.size > 1:
        memory = slice(params, params + group.meta["angles"] + group.meta["limits"])
        dreals[:-1].reshape(count, -1)[:, memory] = 0.0
    weights, d = some.standard_normal(size), np.zeros(W.size)
    d[6 : scene.nw] = some.standard_normal(scene.nw - 6)
    d[0] = 1.0
    first = scene.m + scene.nv
    d[[scene.numbering.scalar[first + j] + 2 for j in range(scene.ns)]] = 0.0
    dW = d.copy()
    for b, body in enumerate(scene.model.bodies):
        if body.width == PART:
            o = scene.w_at["BODY", b] + ATTITUDE
            turned = np.cross(np.eye(3), d[o : o + 3]).T @ W[o : o + 9].reshape(3, 3)
            dW[o : o + 9] = -turned.ravel()
            d[o + 3 : o + 9] = 0.0
    forward, slopes, numbers = np.zeros(size), np.zeros(size), np.zeros(reals.size)

    def at(*arrays: np.ndarray) -> list[int]:
        return [each.ctypes.data for each in arrays]

    CALL(tangents(scene.kernels, group)[0])(count, *at(ints, reals, W, dreals, dW, forward))
    CALL(pullback(scene.kernels, group)[0])(count, *at(ints, reals, W, weights, slopes, numbers))
    terms = np.concatenate([weights * forward, slopes[: W.size] * d, numbers * dreals])
    gap = weights @ forward - slopes[: W.size] @ d - numbers @ dreals
    label = group.instances.statements[0].label
    assert abs(gap) <= tolerance * (1.0 + np.abs(terms).sum()), (label, group.face, gap)
