"""The subject of a simulation: a deck, a model made from it, or that model's kernels."""

from __future__ import annotations

from typing import TypeAlias

from adamslite.deck.deck import Deck
from adamslite.kernels.compile import Kernels, compile_model
from adamslite.model.model import Model, assemble
from adamslite.progress import Progress

Subject: TypeAlias = Deck | Model | Kernels


def deck_of(subject: Subject) -> Deck:
    """The deck that a subject comes from."""
    if isinstance(subject, Kernels):
        return subject.model.deck
    return subject.deck if isinstance(subject, Model) else subject


def kernels_of(
    subject: Subject, progress: Progress | None, without: frozenset[str], audited: bool
) -> Kernels:
    """The kernels of a subject; ``without`` and ``audited`` count where they are compiled now."""
    if isinstance(subject, Kernels):
        return subject
    model = subject if isinstance(subject, Model) else assemble(subject, without)
    return compile_model(model, progress, audited)
