"""References of mechanisms: equations of motion in minimal coordinates, and the files of a case.

With T(q, v) the kinetic and V(q) the potential energy, Q the generalised forces, M = T_vv:

    M a = Q + T_q - V_q - (T_v)_q v
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp


def coordinates(names: str) -> tuple[tuple[sp.Symbol, ...], tuple[sp.Symbol, ...]]:
    """Coordinates q with these names and their speeds v."""
    words = names.split()
    return sp.symbols([f"q_{w}" for w in words], real=True), sp.symbols(
        [f"v_{w}" for w in words], real=True
    )


def rate(place: Any, q: Sequence[Any], v: Sequence[Any]) -> sp.Matrix:
    """Time derivative of a place given in coordinates q."""
    return sp.Matrix(place).jacobian(list(q)) * sp.Matrix(v)


def equations(
    q: Sequence[Any], v: Sequence[Any], kinetic: Any, potential: Any = 0, forces: Any = None
) -> Callable[[float, np.ndarray], np.ndarray]:
    """The function (t, y) -> y' of the state y = (q, v), for use with :func:`solve`."""
    t = sp.Symbol("t", real=True)
    impulse = sp.Matrix([sp.diff(kinetic, s) for s in v])
    mass = impulse.jacobian(list(v))
    slopes = sp.Matrix([sp.diff(kinetic - potential, s) for s in q])
    given = sp.Matrix(forces) if forces is not None else sp.zeros(len(q), 1)
    load = given + slopes - impulse.jacobian(list(q)) * sp.Matrix(v)
    compiled = sp.lambdify((t, list(q), list(v)), (mass, load), "numpy", cse=True)
    n = len(q)

    def rhs(time: float, y: np.ndarray) -> np.ndarray:
        m, f = compiled(time, y[:n], y[n:])
        return np.concatenate([y[n:], np.linalg.solve(m, np.ravel(f))])

    return rhs


def solve(
    rhs: Callable[[float, np.ndarray], np.ndarray],
    start: Sequence[float],
    times: np.ndarray,
    rtol: float = 1e-12,
) -> np.ndarray:
    """States (nt, 2 n) at `times`, which start at 0."""
    run = solve_ivp(
        rhs, (0.0, times[-1]), start, "DOP853", times, rtol=rtol, atol=rtol * 1e-1,
    )  # fmt: skip
    assert run.success, run.message
    return run.y.T


def write(path: Path, lines: str, names: Sequence[str], columns: Sequence[Any]) -> None:
    """Write a reference: instructions, header, table; a number in `columns` is constant."""
    wide = np.broadcast_arrays(*[np.atleast_1d(np.asarray(c, float)) for c in columns])
    table = np.round(np.column_stack(wide), 13) + 0.0
    top = "\n".join(f"# {line}" for line in lines.strip().splitlines())
    header = f"{top}\n# written by make_reference.py\n{','.join(['time', *names])}"
    np.savetxt(path, table, fmt="%.13g", delimiter=",", header=header, comments="")
