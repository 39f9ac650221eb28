"""What the BDF remembers from step to step."""

from __future__ import annotations

from adamslite.integrators.bdf.order_cap import OrderCap
from adamslite.integrators.implicit.control import ImplicitControl


class Control(ImplicitControl):
    """The numbers of the BDF.

    width                numbers of a row of the history: q, u and s
    cu                   gamma_k / h: how y' follows from y
    caution              what the next step aims at is divided by this
    cap                  on the order
    """

    width: int
    cu: float
    caution: float
    cap: OrderCap
