"""ACTIVATE: switches elements on again.

Equation (a the switch of an element, 1 from here on)::

    load = a * load,    a * constraint rows = 0
"""

from __future__ import annotations

from adamslite.deck.element_switch import Switch, element_ids, element_kind, element_range
from adamslite.language.statement import Statement, statement


@statement("ACTIVATE", singleton=True, repeatable=True, place="command")
class Activate(Switch, Statement):
    """Switches elements on after DEACTIVATE, from the next SIMULATE on.

    An element that is already on is not affected.
    """

    on = True

    kind: str = element_kind()
    ids: tuple[int | str, ...] = element_ids()
    range: tuple[float, float] | None = element_range()
