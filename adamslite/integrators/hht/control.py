"""What HHT and NEWMARK remember from step to step."""

from __future__ import annotations

from adamslite.integrators.implicit.control import ImplicitControl


class Control(ImplicitControl):
    """The numbers of HHT and NEWMARK.

    cu, ca, cs           how u and a follow from q, and s' from s
    fixed                the fixed step (0: steps vary)
    reach                the largest position, at least 1
    life, served         steps for which a factored matrix is believed to serve, and how many have
                         been since one did not
    rough                whether accelerations changed by a large share in this step
    """

    cu: float
    ca: float
    cs: float
    fixed: float
    reach: float
    life: int
    served: int
    rough: bool
