"""MREQUEST: the same REQUEST of many parts, joints or forces.

Equations: those of a REQUEST of the kind given, see there; I and J are::

    PARTS            the mass centre, or the origin without one, and J (ground when omitted)
    JOINTS, JPRIMS   I and J of the joint
    FORCES           I and J of the force; J is ground where it acts on I only

Each is written as a REQUEST of its own, with the name of the MREQUEST and of what it measures:
``REQUEST/MREQUEST_1_PART_2.F1``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from adamslite.language.statement import (
    STATEMENTS,
    Statement,
    choice,
    flag,
    ids,
    reference,
    statement,
    text,
)

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key, Lookup

ALL = "ALL"
KINDS = {
    "parts": ("PART", "POINT_MASS"),
    "joints": ("JOINT",),
    "jprims": ("JPRIM",),
    "forces": (
        "BEAM", "BUSHING", "FIELD", "GFORCE", "NFORCE", "SFORCE", "SPRINGDAMPER", "VFORCE",
        "VTORQUE",
    ),
}  # fmt: skip
"""What the ids of a field may be; the first kind that has one of the id counts."""


class Measured(NamedTuple):
    """A statement and the two markers; ``i`` is None for a body without CM, ``j`` 0 for ground."""

    what: Any
    i: Key | None
    j: Key


def _ids(key: str, what: str, *aliases: str) -> tuple[Key, ...]:
    return ids(key, *aliases, help=f"{what}, or ALL")


@statement("MREQUEST")
class Mrequest(Statement):
    """Requests of all or some of the parts, joints and forces."""

    kind: str = choice(
        options=("DISPLACEMENT", "VELOCITY", "ACCELERATION", "FORCE"), required=True,
        help="what is written",
    )  # fmt: skip
    parts: tuple[Key, ...] = _ids("PARTS", "parts and point masses")
    joints: tuple[Key, ...] = _ids("JOINTS", "JOINTs")
    jprims: tuple[Key, ...] = _ids("JPRIMS", "JPRIMs")
    forces: tuple[Key, ...] = _ids("FORCES", "forces of any kind", "APPFORS")
    everything: bool = flag(ALL, help="all parts, joints and forces")
    j: int | str = reference(
        "J", to="MARKER", default=0, help="marker that parts are measured from"
    )
    rm: int | str = reference("RM", to="MARKER", default=0, help="marker whose axes are used")
    comment: str | None = text("COMMENT", "C", help="a title")

    def asked(self) -> Iterator[tuple[str, Key]]:
        """Field and id of what is listed; ALL stands for itself."""
        for field in KINDS:
            listed = (ALL,) if self.everything else getattr(self, field)
            yield from ((field, key) for key in listed)

    def measured(self, deck: Lookup) -> Iterator[Measured]:
        """What is measured, between which markers; ALL leaves the ground out."""
        for field, key in self.asked():
            every = [each for kind in KINDS[field] for each in deck.of(kind)]
            moving = [each for each in every if not getattr(each, "ground", False)]
            for each in moving if key == ALL else filter(None, [self.named(deck, field, key)]):
                yield from self._between(each)

    @staticmethod
    def named(deck: Lookup, field: str, key: Key) -> Statement | None:
        """The statement of this id in a field; None when there is none."""
        found = (deck.find(kind, key) for kind in KINDS[field])
        return next((each for each in found if each is not None), None)

    def _between(self, each: Any) -> Iterator[Measured]:
        if each.keyword in KINDS["parts"]:
            yield Measured(each, each.cm, self.j)
        elif each.keyword == "NFORCE":
            yield from (Measured(each, marker, each.j) for marker in each.imarkers)
        else:
            alone = getattr(each, "actiononly", False)
            other = None if alone else getattr(each, "jfloat", None) or getattr(each, "j", None)
            yield Measured(each, each.i, other or 0)

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """A REQUEST for each, and a marker at the origin of each body without CM."""
        made: dict[tuple[str, str], Statement] = {}
        for what, i, j in self.measured(deck):
            name = f"{self.keyword}_{self.key}_{what.keyword}_{what.key}"
            name += f"_{i}" * (what.keyword == "NFORCE")
            if i is None:
                owner = {what.keyword.lower(): what.key}
                made["MARKER", name] = STATEMENTS["MARKER"](id=name, spans=self.spans, **owner)
            facts = {"kind": self.kind, "i": name if i is None else i, "j": j, "rm": self.rm}
            made["REQUEST", name] = STATEMENTS["REQUEST"](id=name, spans=self.spans, **facts)
        return tuple(made.values())
