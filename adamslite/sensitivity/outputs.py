"""Derivatives of the record of a run: of the workspace and of all that is written."""

from __future__ import annotations

from adamslite.integrators.contract import OUTPUTS, Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.rates import sensitive_accelerations
from adamslite.sensitivity.tangents import by_number, directed


@native
def write_outputs(P: Problem, L: Plan, D: Tangents, S: Forward, number: int, y: Reals) -> None:
    """The derivative of the next row of the record by a number, from the sensitivities ``y`` of
    the workspace's state; the matrix of accelerations is factored.
    """
    nw, n_out = P.sizes.nw, P.sizes.n_out
    sensitive_accelerations(P, L, D, S, number, y, 0.0)
    out = S.record[(number * P.times.size + S.row) * (nw + n_out) :]
    copy(out, D.dW, nw)
    written = out[nw:]
    for k in range(n_out):
        written[k] = 0.0
    directed(P, D, OUTPUTS, written)
    by_number(P, D, number, OUTPUTS, written)
