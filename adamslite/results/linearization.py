"""What LINEAR finds: eigenvalues, modes and matrices of the linearised model."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from math import pi
from pathlib import Path
from typing import NamedTuple

import numpy as np

import adamslite

VARIES = "the linear system varies with time: its eigenvalues are those of this moment only"


class SecondOrder(NamedTuple):
    """M y'' + B y' + K y = F w, where body coordinates move by ``basis`` (n, f) times y; M of the
    kinetic energy y' M y'/2.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    input_matrix: np.ndarray
    basis: np.ndarray


@dataclass(frozen=True, repr=False)
class Linearization:
    """The model about one state; as text the table of modes that `adamslite linear` prints.

    Parameters
    ----------
    eigenvalues : (nx,) complex array
        Of the state matrix, by frequency [1/time].
    undamped : (f,) array
        Natural frequencies without damping [1/time], imaginary parts as negative numbers for
        unstable directions (a negative stiffness gives -sqrt|k/m|).
    modes : (n, nx) complex array
        Body coordinates (translations, rotation vectors) of each eigenvector, relative to the
        observer's body and in the observer's axes.
    state_matrix : (nx, nx) array
        A of x' = A x + B w with x = (y, p, s), see
        :mod:`adamslite.analyses.linearization.first_order`.
    input_matrix, output_matrix, feedthrough : (nx, nw), (nv, nx), (nv, nw) arrays
        B, C, D; w is added to the VARIABLEs of PINPUT, v = C x + D w is those of POUTPUT.
    coordinates, inputs, outputs : tuple of str
        Names of the rows of ``modes``, of w and of v.
    kinetic : (nb, nx) array
        Share of each body in the kinetic energy of each mode; zeros where a mode has none.
    bodies : tuple of str
        Names of the rows of ``kinetic``.
    second_order : SecondOrder or None
        The same as equations of second order, where all states are motions.
    steady : bool
        Whether A to D stay constant along the motion.
    steady_for : str
        Where they do not, for which observer they would ("RM=5"); empty if for none.
    """

    eigenvalues: np.ndarray
    undamped: np.ndarray
    modes: np.ndarray
    state_matrix: np.ndarray
    coordinates: tuple[str, ...]
    input_matrix: np.ndarray
    output_matrix: np.ndarray
    feedthrough: np.ndarray
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    kinetic: np.ndarray
    bodies: tuple[str, ...]
    second_order: SecondOrder | None = None
    steady: bool = True
    steady_for: str = ""

    @property
    def frequencies(self) -> np.ndarray:
        """abs(eigenvalue)/(2 pi) [cycles per time]."""
        return np.abs(self.eigenvalues) / (2 * pi)

    @property
    def damping_ratios(self) -> np.ndarray:
        """-Re/abs(eigenvalue); zero where the eigenvalue vanishes."""
        size = np.abs(self.eigenvalues)
        shares = -self.eigenvalues.real / np.where(size > 0.0, size, 1.0)
        return np.where(np.abs(shares) > 0.0, shares, 0.0)

    @property
    def note(self) -> str:
        """What to know before the eigenvalues are used; empty for a steady state."""
        if self.steady:
            return ""
        return f"{VARIES}; it is steady {self.steady_for}" if self.steady_for else VARIES

    def save(self, path: str | Path) -> None:
        """Write the table of modes (.csv), or everything with shapes and matrices (.json).

        Raises
        ------
        UsageError
            When the name ends in neither.
        """
        modes = import_module("adamslite.outputs.modes")
        modes.need_suffix(str(path))
        modes.save(self, path)

    def __str__(self) -> str:
        return import_module("adamslite.outputs.modes").mode_table(self).rstrip()

    def __repr__(self) -> str:
        return f"<Linearization: {self.sizes}>"

    @property
    def sizes(self) -> str:
        """How many states, inputs and outputs there are."""
        states, inputs, outputs = len(self.eigenvalues), len(self.inputs), len(self.outputs)
        return f"{states} states, {inputs} inputs, {outputs} outputs"

    def _repr_html_(self) -> str:
        """The table of modes, for a notebook."""
        return adamslite.html(self)
