"""What a deck's constraints let its parts do, for rules about that."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.checks.lints import run_end
from adamslite.deck.deck import Deck
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass

if TYPE_CHECKING:
    import numpy as np

    from adamslite.assembly.mobility import Mobility

KEYWORDS = ("BUSHING", "JOINT", "SFORCE", "SPRINGDAMPER")


def looked_at(deck: Deck) -> tuple[Mobility, ...]:
    """What the constraints allow, of decks that run."""
    if not run_end(deck) or len(deck.of(Part)) < 2 or deck.user.called:
        return ()
    if not any(map(deck.of, KEYWORDS)) or deck.of(PointMass):
        return ()
    import numpy as np

    from adamslite.assembly.mobility import MOST_BODIES, mobilities

    if sum(not part.ground for part in deck.of(Part)) > MOST_BODIES:
        return ()

    with np.errstate(all="ignore"):
        found = mobilities(deck)
    return found if all(np.isfinite(each.motions).all() for each in found) else ()


def places_of(mobility: Mobility) -> list[np.ndarray]:
    """Mass centres, and markers of elements, in ground."""
    from adamslite.elements.bases.joint_coordinates import pose

    model = mobility.model
    used = [each for keyword in KEYWORDS for each in model.deck.of(keyword)]
    ends = {key for each in used for key in (each.i, each.j)}
    return [*mobility.posture.x, *(pose(model, key)[0] for key in sorted(ends, key=str))]


def size_of(mobility: Mobility) -> float:
    """The extent of these places; 0 where all are one."""
    import numpy as np

    return float(np.ptp(np.array(places_of(mobility)), axis=0).max())
