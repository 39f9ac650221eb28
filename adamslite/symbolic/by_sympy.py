"""What sympy knows of the slopes of functions, written down as a module.

``python -m adamslite.symbolic.by_sympy`` writes :mod:`adamslite.symbolic.slopes_by_sympy`, which
``ruff format`` brings into form.  Sympy takes longer to import than a deck takes to compile; the
slopes of a dozen functions of one or two arguments are all that is needed of it, and they do not
change.
"""

from __future__ import annotations

import inspect
from pathlib import Path

HEAD = '''"""Slopes of functions by each of their arguments, as sympy forms them.

Written by :mod:`adamslite.symbolic.by_sympy`.
"""

from __future__ import annotations

from typing import Any

from adamslite.symbolic.algebra import cos, cosh, exp, log, sin, sinh, sqrt, tan, tanh

SLOPES: dict[str, Any] = {
'''
ONE = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log")


def slopes_text() -> str:
    """The text of the module."""
    import sympy as sp

    x, y = sp.symbols("x y", real=True)
    lines = [_line(name, getattr(sp, name)(x), "x") for name in ONE]
    lines.append(_line("atan2", sp.atan2(y, x), "y, x"))
    lines.append(_line("**", x**y, "x, y"))
    return HEAD + "".join(lines) + "}\n"


def _line(name: str, expression, arguments: str) -> str:  # type: ignore[no-untyped-def]
    import sympy as sp

    symbols = [sp.Symbol(each, real=True) for each in arguments.split(", ")]
    slopes = [str(sp.powsimp(sp.diff(expression, each))) for each in symbols]
    several = ", ".join(slopes) + ("," if len(slopes) == 1 else "")
    return f'    "{name}": lambda {arguments}: ({several}),\n'


if __name__ == "__main__":
    from adamslite.symbolic import slopes_by_sympy

    Path(inspect.getfile(slopes_by_sympy)).write_text(slopes_text(), encoding="utf-8")
