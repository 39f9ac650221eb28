"""The cases of the matrix: reference decks that methods are known to fail on."""

from __future__ import annotations

from dataclasses import dataclass

from adamslite.verification.verification import Case as Told
from adamslite.verification.verification import find_cases
from benchmarks.mechanisms import DECKS


@dataclass(frozen=True)
class Case:
    """A reference file below decks/, and what makes it hard."""

    reference: str
    why: str

    @property
    def told(self) -> Told:
        """The reference with its deck."""
        path = DECKS / self.reference
        return next(each for each in find_cases([path.parent]) if each.reference == path)

    @property
    def name(self) -> str:
        """Folder, deck if it is called otherwise, and what follows ``reference``."""
        return self.told.name


def _in(folder: str, why: str, *decks: str) -> list[Case]:
    names = [d if d.endswith(".csv") else f"{d}.reference.csv" for d in decks]
    names = names or ["reference.csv"]
    return [Case(f"{folder}/{name}", why) for name in names]


CASES = [
    *_in("torture/stiff-axial", "stiff along, slow across", "axial", "transverse"),
    *_in("torture/ringing", "axial waves, all of them", "waves"),
    *_in("torture/massless-node", "a microgram between springs", "massless-node"),
    *_in("growing-mass-spring", "mass that grows", "growing-mass-spring"),
    *_in("growing-mass-singular", "effective mass through zero", "growing-mass-singular",
         "growing-mass-singular-spring"),
    *_in("torture/added-mass", "forces of accelerations"),
    *_in("torture/snatch", "slack and taut", "sharp", "impact", "smooth"),
    *_in("torture/contact", "elastic contact"),
    *_in("torture/pulse", "edges in time", "pulse", "square-wave"),
    *_in("bricard", "redundant constraints"),
    *_in("four-bar", "redundant constraints"),
    *_in("torture/flattened", "constraints lose rank", "parallelogram", "driven-equal-arms"),
    *_in("slider-crank", "dead centres", "driven", "slider-crank", "equal-arms"),
    *_in("a02-n2", "constraints lose rank"),
    *_in("a02-n40", "constraints lose rank, 40 loops"),
    *_in("pendulum-gcon", "index 3"),
    *_in("pendulum-revolute", "index 3"),
    *_in("torture/long-pendulum", "drift of constraints"),
    *_in("torture/near-separatrix", "near the upright"),
    *_in("torture/gimbal-lock", "singular angles"),
    *_in("torture/intermediate-axis", "near a separatrix, spin"),
    *_in("torture/fast-top", "fast spin", "fast-top-slow", "fast-top-fast"),
    *_in("heavy-top", "fast spin"),
    *_in("torture/spinning-ring", "stiff, fast spin"),
    *_in("torture/falling-chain", "51 rods, crack of a whip"),
    *_in("torture/payout", "growing masses, transport", "level-fixed", "level-flowing",
         "lowering-fixed", "lowering-flowing"),
    *_in("torture/folding", "pushed along itself: grown round-off", "folding"),
    *_in("torture/supercritical", "transport near wave speed", "below", "above"),
    *_in("pulley-one-sided", "rigid wind-up", "free", "windup-coupler", "windup-rackpin"),
    *_in("torture/inconsistent-start", "velocity along a rod"),
    *_in("andrews", "tiny masses", "reference.csv", "reference-micro.csv", "reference-nano.csv"),
    *_in("car-axis", "stiff springs on constraints"),
    *_in("spring-pendulum", "stiff spring", "spring-pendulum-stiff"),
]  # fmt: skip
