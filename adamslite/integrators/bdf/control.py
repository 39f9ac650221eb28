"""What the BDF remembers from step to step."""

from __future__ import annotations

from adamslite.integrators.bdf.order_cap import OrderCap
from adamslite.integrators.implicit.control import ImplicitControl


class Control(ImplicitControl):
    """The numbers of the BDF: with the cap on its order."""

    cap: OrderCap
