"""Slopes of functions by each of their arguments, as sympy forms them.

Written by :mod:`adamslite.symbolic.by_sympy`.
"""

from __future__ import annotations

from typing import Any

from adamslite.symbolic.algebra import cos, cosh, exp, log, sin, sinh, sqrt, tan, tanh

SLOPES: dict[str, Any] = {
    "sin": lambda x: (cos(x),),
    "cos": lambda x: (-sin(x),),
    "tan": lambda x: (tan(x) ** 2 + 1,),
    "asin": lambda x: (1 / sqrt(1 - x**2),),
    "acos": lambda x: (-1 / sqrt(1 - x**2),),
    "atan": lambda x: (1 / (x**2 + 1),),
    "sinh": lambda x: (cosh(x),),
    "cosh": lambda x: (sinh(x),),
    "tanh": lambda x: (1 - tanh(x) ** 2,),
    "exp": lambda x: (exp(x),),
    "log": lambda x: (1 / x,),
    "atan2": lambda y, x: (x / (x**2 + y**2), -y / (x**2 + y**2)),
    "**": lambda x, y: (x ** (y - 1) * y, x**y * log(x)),
}
