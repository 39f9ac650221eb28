"""Functions of Python that tests bind to routines of decks."""

from __future__ import annotations

import math

from adamslite.deck.python_routine import reads

Parameters = tuple[float, ...]
Three = tuple[float, float, float]


@reads("DX(2, 1)", "VX(2, 1)")
def spring(parameters: Parameters, time: float, x: float, v: float) -> float:
    """-k x - c v"""
    stiffness, damping = parameters
    return -stiffness * x - damping * v


def slopes(parameters: Parameters, time: float, x: float, v: float) -> Three:
    """Partial derivatives of :func:`spring` by time, x and v."""
    return 0.0, -parameters[0], -parameters[1]


@reads("DX(2, 1)", "VX(2, 1)", derivatives=slopes)
def exact_spring(parameters: Parameters, time: float, x: float, v: float) -> float:
    """-k x - c v, with its derivatives."""
    return -parameters[0] * x - parameters[1] * v


@reads("DX({i}, 1)", "DY({i}, 1)", "DZ({i}, 1)")
def attraction(parameters: Parameters, time: float, x: float, y: float, z: float) -> Three:
    """-k r/r^3, towards marker 1."""
    strength = -parameters[0] / math.hypot(x, y, z) ** 3
    return strength * x, strength * y, strength * z


def swing(parameters: Parameters, time: float) -> float:
    """a sin(w t)"""
    return parameters[0] * math.sin(parameters[1] * time)


def broken_later(parameters: Parameters, time: float) -> float:
    """1 until t = 0.5, then an exception."""
    if time > 0.5:
        raise ArithmeticError("the table ends here")
    return 1.0


def two_values(parameters: Parameters, time: float) -> tuple[float, float]:
    """Not one number."""
    return 1.0, 2.0


@reads("DX(2, 99)")
def reads_what_is_not_there(parameters: Parameters, time: float, x: float) -> float:
    """There is no MARKER/99."""
    return x


@reads("VARVAL({3})")
def reads_by_parameter(parameters: Parameters, time: float, x: float) -> float:
    """The VARIABLE that the third parameter names."""
    return x


def constant(parameters: Parameters, time: float) -> float:
    """1"""
    return 1.0


@reads("ARYVAL({x}, 1)", "ARYVAL({x}, 2)", "ARYVAL({u}, 1)")
def oscillator(parameters: Parameters, time: float, x: float, v: float, u: float) -> Three:
    """Rates of x1' = x2, x2' = -w^2 x1 - 2 d x2 + u, and the output 3 x1 - u/2."""
    stiffness, decay = parameters
    return v, -stiffness * x - 2.0 * decay * v + u, 3.0 * x - 0.5 * u


def circle(parameters: Parameters, alpha: float) -> Three:
    """A circle about the origin."""
    angle = 2.0 * math.pi * alpha
    return parameters[0] * math.cos(angle), parameters[0] * math.sin(angle), 0.0


@reads("DM(2, 1)")
def ring(parameters: Parameters, time: float, distance: float) -> float:
    """A point that stays at a distance."""
    return distance - parameters[0]


def quickening(parameters: Parameters, alpha: float) -> Three:
    """A curve on which equal steps of alpha are ever longer."""
    return alpha**3, math.sin(alpha), 1.0


@reads("DZ(21, 31, 31)", "AZ(22, 32)")
def screw(parameters: Parameters, time: float, travel: float, angle: float) -> float:
    """A coupling that bends: the travel is the square of the angle, times a factor."""
    return travel - parameters[0] * angle**2


@reads("DX({i}, {j}, {j})", "AZ({i}, {j})")
def hardening(parameters: Parameters, time: float, x: float, angle: float) -> list[float]:
    """A cubic spring along x and a torsional one about z."""
    soft, stiff = parameters
    return [-soft * x - stiff * x**3, 0.0, 0.0, 0.0, 0.0, -soft * angle]
