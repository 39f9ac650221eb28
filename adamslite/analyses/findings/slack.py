"""Detects cable sections that were pushed, which a real cable does not support."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import History
    from adamslite.deck.deck import Deck

FORCES = ("SFORCE", "SPRINGDAMPER")
# Fewer are no cable; one VFORCE may be several.
FEWEST = 3
# Pushes below this share of the largest pull are those of waves that sections cannot follow.
FELT = 0.02
REMEDY = "a slack cable carries nothing: write its pull as MAX(0, pull); described: pulls_only"


def compressed(deck: Deck, history: History) -> str:
    """The sections of cables that pushed, how hard and since when; empty when none did."""
    column = {name: k for k, name in enumerate(history.names)}
    places = {
        each.label: column[f"{each.label}.f"]
        for word in FORCES
        for each in deck.of(word)
        if f"{each.label}.f" in column
    }
    pushing = _pushing(places, history)
    cable = deck.of("VFORCE") or sum(len(deck.of(word)) for word in FORCES) >= FEWEST
    labels = _sections(deck) & pushing.keys() if pushing and cable else set()
    if not labels:
        return ""
    hardest = max(labels, key=lambda label: (pushing[label], label))
    since = _since(history, [places[label] for label in labels], FELT * pushing[hardest])
    more = f" and {len(labels) - 1} more sections" if len(labels) > 1 else ""
    return (
        f"{hardest}{more} of a cable pushed, by up to {pushing[hardest]:.3g}, first at "
        f"t = {since:.6g}; {REMEDY}"
    )


def _since(history: History, places: list[int], push: float) -> float:
    """When one of the forces first exceeds ``push``; the start where none does."""
    start = None
    for time, values in history.blocks():
        start = time[0] if start is None else start
        felt = values[:, places].max(axis=1) > push
        if felt.any():
            return float(time[np.argmax(felt)])
    return float(start or 0.0)


def _pushing(places: dict[str, int], history: History) -> dict[str, float]:
    """The largest push of each force that pulls and pushes too."""
    columns, most, least = list(places.values()), np.zeros(len(places)), np.zeros(len(places))
    for _, values in history.blocks() if columns else ():
        forces = values[:, columns]
        most = np.maximum(most, np.nanmax(forces, 0, initial=0.0))
        least = np.minimum(least, np.nanmin(forces, 0, initial=0.0))
    pushing = ((most > -FELT * least) & (most > 0.0)).tolist()
    sections = zip(places, most.tolist(), pushing, strict=True)
    return {label: push for label, push, is_one in sections if is_one}


def _sections(deck: Deck) -> set[str]:
    """Labels of the forces that are sections of cables."""
    from adamslite.cables.recognition.chain_finder import chains
    from adamslite.cables.recognition.posture import Posture

    return {link.statement.label for chain in chains(deck, Posture(deck)) for link in chain.links}
