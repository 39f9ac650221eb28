"""The part that ACTIVATE and DEACTIVATE share: the selection of elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.statement import choice, ids, vector

if TYPE_CHECKING:
    from adamslite.deck.names import Names
    from adamslite.language.interfaces import Key

SWITCHABLE = (
    "BEAM", "BUSHING", "CONTACT", "COUPLER", "CVCV", "FIELD", "FRICTION", "GCON", "GEAR", "GFORCE",
    "JOINT", "JPRIM", "MOTION", "NFORCE", "PTCV", "SENSOR", "SFORCE", "SPRINGDAMPER", "VFORCE",
    "VTORQUE",
)  # fmt: skip


def element_kind() -> str:
    """The keyword of the elements."""
    return choice(options=SWITCHABLE, required=True, help="a kind of element")


def element_ids() -> tuple[Key, ...]:
    """The elements one by one."""
    return ids("ID", help="ids or names of the elements")


def element_range() -> tuple[float, float] | None:
    """The elements between two ids."""
    return vector("RANGE", size=2, unit="1", help="first and last id of a range of elements")


class Switch:
    """A command that switches elements.

    Attributes
    ----------
    on : bool
        Whether they are to act from now on.
    """

    on: bool
    kind: str
    ids: tuple[Key, ...]
    range: tuple[float, float] | None

    def elements(self, names: Names) -> tuple[Key, ...]:
        """Keys of the elements that are meant and exist, by the names of the deck."""
        listed = [names.find(self.kind, key) for key in self.ids]
        keys = [key for key in listed if isinstance(key, int | str)]
        if self.range:
            low, high = self.range
            known = names.ids.get(self.kind, ())
            keys += [key for key in known if isinstance(key, int) and low <= key <= high]
        return tuple(dict.fromkeys(keys))
