"""Kernels between runs: a deck that is known by its origin is bound and compiled once.

The entry holds the model and the instances of each shape, and refers to the statements of the deck,
which are kept with the scene.  Object code stays in the entries of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from adamslite.caching import entries, objects
from adamslite.caching.program import is_unchanged
from adamslite.kernels.groups import linked
from adamslite.model.geometry import IDENTITY
from adamslite.native import compiler

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.kernels.groups import Kernels


def name_of(deck: Deck, without: frozenset[str], audited: bool) -> str:
    """The entry of the kernels of a deck; empty where nothing made of it is kept.

    Tables of the past are filled while a run proceeds, by two who share their memory: a copy of
    both would no longer do so.
    """
    facts = (deck.origin, repr(sorted(without)), repr(audited))
    return f"kernels{compiler.digest(*facts)}.kept" if deck.origin and not deck.delays else ""


def find(name: str, deck: Deck) -> Kernels | None:
    """The kernels kept under a name, linked; None when they or their code are not there."""
    kernels: Kernels | None = objects.find(name, _known(deck)) if name else None
    if kernels is None:
        return None
    for group in kernels.groups:
        code = entries.find(group.entry)
        if code is None:
            return None
        group.code = code
    kernels.addresses = linked(kernels.groups)
    return kernels


def keep(name: str, kernels: Kernels) -> None:
    """Keep kernels that have just been made, as long as nothing has run with them."""
    if name and is_unchanged():
        groups = [replace(group, write=None, code=b"") for group in kernels.groups]
        kept = replace(kernels, groups=groups, addresses={}, compiled=0, shared={}, refill=None)
        objects.keep(name, kept, _known(kernels.model.deck))


def _known(deck: Deck) -> Sequence[object]:
    """What kernels refer to that lies outside of them."""
    return [deck, *deck.statements, IDENTITY]
