"""Names of unknowns and equations for messages.

PART/3 (scene.adm:12:1), x                       an unknown
JOINT/2 (scene.adm:20:1), rotation about y_J     the equation of a constraint
PART/3 (scene.adm:12:1), forces along x          the equation of a body
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.language.statement import Statement

AXES = ("x", "y", "z")
COORDINATES = (*AXES, *(f"rotation about {axis}" for axis in AXES))
SPEEDS = (
    *(f"velocity along {axis}" for axis in AXES),
    *(f"angular velocity about {axis}" for axis in AXES),
)
BALANCES = (
    *(f"forces along {axis}" for axis in AXES),
    *(f"torques about {axis}" for axis in AXES),
)


def placed(statement: Statement) -> str:
    """``PART/3 (scene.adm:12:1)``"""
    return f"{statement.label} ({statement.span})"


def unknown(system: System, k: int) -> str:
    """The unknown of column ``k`` of the Newton matrix."""
    return _named(system, k, COORDINATES, "reaction of ")


def equation(system: System, k: int) -> str:
    """The equation of row ``k`` of the Newton matrix."""
    return _named(system, k, BALANCES, "")


def tested(system: System, k: int) -> str:
    """The variable that the error test numbers ``k``: positions, velocities, states."""
    if k < system.n:
        return _named(system, k, COORDINATES, "")
    if k < 2 * system.n:
        return _named(system, k - system.n, SPEEDS, "")
    return placed(system.model.deck.of("DIFF")[k - 2 * system.n])


def _named(system: System, k: int, components: tuple[str, ...], of_row: str) -> str:
    """The statement that brought unknown ``k``, and which of its components it is."""
    place = max(node for node, start in enumerate(system.starts) if start <= k)
    kind, key = system.nodes[place]
    part = k - system.starts[place]
    if kind == "BODY":
        return f"{placed(system.model.bodies[key].statement)}, {components[part]}"
    if kind == "MU":
        statement = system.model.element(*key)
        return f"{placed(statement)}, speed of {statement.row_names[part]}"
    statement = system.model.element(kind, key)
    if hasattr(statement, "row_names"):
        return f"{placed(statement)}, {of_row}{statement.row_names[part]}"
    return placed(statement)
