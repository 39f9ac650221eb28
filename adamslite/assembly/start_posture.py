"""The posture from which turns and travels count.

A RACKPIN, a SCREW, a GEAR and a COUPLER hold what has been turned and travelled since the start, so
that they allow any posture to start from.  Where a deck draws the other joints apart it is the
nearest one in which these are closed: what was turned and travelled on the way there is no motion
of the machine, and may be more than the half turn up to which an angle is known.
"""

from __future__ import annotations

from adamslite.assembly.closing import close, rows_of
from adamslite.assembly.scope import Posture
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.model.model import Model

# Joints that are apart by this share of the size of the model are drawn apart.
APART = 1e-9


def settle_start(model: Model) -> None:
    """Put into ``model.start`` where its joints are closed, if something counts from there and
    the deck draws them apart.
    """
    if model.start is not None or not any(each.counts_from_start for each in model.constraints):
        return
    joints = [
        each
        for each in model.constraints
        if isinstance(each, Joint | Jprim) and not each.counts_from_start
    ]
    drawn = Posture.start(model)
    size = max(1.0, float(abs(drawn.x).max(initial=0.0)))
    if not abs(rows_of(model, drawn, joints)).max(initial=0.0) > APART * size:
        return
    closing = close(model, joints, drawn)
    if closing.closed:
        model.start = list(zip(closing.posture.x, closing.posture.attitude, strict=True))
