"""DEACTIVATE: switches elements off.

Equation (a the switch of an element, 0 from here on)::

    load = a * load,    a * constraint rows = 0
"""

from __future__ import annotations

from adamslite.deck.element_switch import Switch, element_ids, element_kind, element_range
from adamslite.language.statement import Statement, statement


@statement("DEACTIVATE", singleton=True, repeatable=True, place="command")
class Deactivate(Switch, Statement):
    """Switches elements off until ACTIVATE, from the next SIMULATE on.

    The result columns of an element that is off are filled with zeros.
    """

    on = False

    kind: str = element_kind()
    ids: tuple[int | str, ...] = element_ids()
    range: tuple[float, float] | None = element_range()
