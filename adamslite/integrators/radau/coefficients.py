"""Coefficients of the three-stage Radau IIA formula of order 5.

    Y_i = y_0 + h sum_j a_ij Y'_j,    c = (4 - sqrt 6)/10, (4 + sqrt 6)/10, 1

A is that of collocation, sum_j a_ij c_j^(k-1) = c_i^k / k; its inverse has one real eigenvalue g
and a pair alpha +- i beta:  T^-1 A^-1 T = [g, 0, 0; 0, alpha, -beta; 0, beta, alpha].
Source: Hairer, Wanner, Solving ODE II, 1996, sections IV.5 and IV.8 (error: eq. 8.19 and 8.20).
"""

from __future__ import annotations

from functools import cache

import numpy as np

# Places in the table of coefficients, row by row.
NODE, INVERSE, TO_STAGES, TO_MODES, REAL, ALPHA_MODE, BETA_MODE, WEIGHT = (
    0, 3, 12, 21, 30, 31, 32, 33,
)  # fmt: skip


@cache
def coefficients() -> np.ndarray:
    """c, A^-1, T, T^-1, g, alpha, beta and the weights of the error estimate."""
    root = np.sqrt(6.0)
    c = np.array([(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0])
    powers = np.arange(3)
    a = (c[:, None] ** (powers + 1) / (powers + 1)) @ np.linalg.inv(c[:, None] ** powers)
    inverse = np.linalg.inv(a)
    values, vectors = np.linalg.eig(inverse)
    one, two = int(np.argmin(abs(values.imag))), int(np.argmax(values.imag))
    to_stages = np.column_stack([vectors[:, one].real, vectors[:, two].real, -vectors[:, two].imag])
    weights = np.array([-13.0 - 7.0 * root, -13.0 + 7.0 * root, -1.0]) / 3.0
    modes = [values[one].real, values[two].real, values[two].imag]
    return np.concatenate(
        [c, inverse.ravel(), to_stages.ravel(), np.linalg.inv(to_stages).ravel(), modes, weights]
    )
