"""The subject of a simulation: a deck, a model made from it, or that model's kernels."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from adamslite.analyses.setup import kept_kernels
from adamslite.deck.counted_turns import brought
from adamslite.deck.deck import Deck
from adamslite.kernels.groups import Kernels
from adamslite.model.model import Model, assemble
from adamslite.model.reduction import MERGED

if TYPE_CHECKING:
    from collections.abc import Iterable

    from adamslite.deck.redefinition import Command
    from adamslite.progress import Progress

Subject: TypeAlias = Deck | Model | Kernels


def deck_of(subject: Subject) -> Deck:
    """The deck that a subject comes from."""
    if isinstance(subject, Kernels):
        return subject.model.deck
    return subject.deck if isinstance(subject, Model) else subject


def prepared_for(subject: Subject, commands: Iterable[Command]) -> Subject:
    """A deck that counts from the start the turns of angles that commands bring into it."""
    if not isinstance(subject, Deck):
        return subject
    return subject.counting(brought(commands, subject.statements))


def kernels_of(
    subject: Subject, progress: Progress | None, without: frozenset[str], audited: bool
) -> Kernels:
    """The kernels of a subject; ``without`` and ``audited`` count where they are compiled now."""
    if isinstance(subject, Kernels):
        return subject
    if isinstance(subject, Model):
        return _compiled(subject, progress, audited)
    if subject.base is not None and (base := _varied_before(subject.base, without, audited)):
        from adamslite.variation.kernels import of_deck

        return of_deck(base, subject, merging=MERGED not in without)
    name = kept_kernels.name_of(subject, without, audited)
    kernels = kept_kernels.find(name, subject)
    if kernels is None:
        from adamslite.model.merging import merged

        kernels = _compiled(merged(assemble(subject, without)), progress, audited)
        kept_kernels.keep(name, kernels)
    return kernels


def _varied_before(base: Deck, without: frozenset[str], audited: bool) -> Kernels | None:
    """The kernels of the deck that others vary, from the second of these on."""
    asked = (Kernels, without, audited)
    if asked not in base.kept:
        base.kept[asked] = None
        return None
    if base.kept[asked] is None:
        base.kept[asked] = kernels_of(base, None, without, audited)
    kernels: Kernels = base.kept[asked]
    return kernels


def _compiled(model: Model, progress: Progress | None, audited: bool) -> Kernels:
    # Kernels that are kept need nothing that binds and writes them.
    from adamslite.kernels.compile import compile_model

    return compile_model(model, progress, audited)
