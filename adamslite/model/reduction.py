"""Reductions of the model to what its scene needs, each a rule with a name.

    fixed      parts that JOINT/FIXED holds together are one body (model/merging.py)
    plane      what moves in a plane is solved in the plane (analyses/dynamics/planar_reduction.py)
    points     a point mass has three unknowns and no attitude
    variables  a VARIABLE is evaluated where it is used; solved for is only what depends on itself,
               inputs and outputs of a plant, and long chains that many forces take (chains.py)

Results are the same with and without, to the accuracy of the integration. Not by rules, because
nothing is gained by doing without: ground and its markers are constants, redundant constraint rows
are no part of the matrix, requests are evaluated at output times.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from adamslite.errors import UsageError

if TYPE_CHECKING:
    from adamslite.deck.redefinition import Command

MERGED = "fixed"
RULES = (MERGED, "plane", "points", "variables")
#: Commands that ask nothing of a single part, and change none.
HARMLESS = ("EQUILIBRIUM", "FILE", "INTEGRATOR", "KINEMATICS", "SIMULATE", "STOP")


def left_off(names: Iterable[str]) -> frozenset[str]:
    """The rules not to apply.

    Raises
    ------
    UsageError
        When there is no such rule.
    """
    found = frozenset([names] if isinstance(names, str) else names)
    for name in found.difference(RULES):
        raise UsageError(f"There is no reduction {name}. There are {', '.join(RULES)}.")
    return found


def kept_apart(commands: Iterable[Command], audited: bool) -> frozenset[str]:
    """The rule, where commands change statements or look into the model, or the run is audited."""
    others = any(each.keyword not in HARMLESS for each in commands)
    return frozenset({MERGED} if others or audited else ())
