"""The numbers of the search for an equilibrium."""

from __future__ import annotations

from adamslite.native.translate import Record


class Control(Record):
    """Limits of the search, and what it has come to.

    alimit, tlimit       of the increments of an iteration [rad], [length]
    error, imbalance     relative correction, residual [force] at which it is done
    stability            times the mass matrix is added to the stiffness
    maxit                iterations of Newton
    relaxations          steps of relaxation
    most, tried          iterations before the search is given up, 0 where none are too many; so far
    length               of the model
    sigma                times the mass matrix is added now
    worst, moved         largest residual [force], relative correction of the last iteration
    shift                that correction as a share of the model, or an angle [rad]
    found                Newton settled, before anything was judged
    """

    alimit: float
    tlimit: float
    error: float
    imbalance: float
    stability: float
    maxit: int
    relaxations: int
    most: int
    tried: int
    length: float
    sigma: float
    worst: float
    moved: float
    shift: float
    found: bool
