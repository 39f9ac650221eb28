"""Words that may have been meant by one that is not known."""

from __future__ import annotations

from collections.abc import Iterable

# Likeness at least (1: equal), and by how much less than the first one's.
LIKENESS, SPREAD = 0.6, 0.1


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """A hint naming the closest candidates; empty when none is close."""
    from difflib import SequenceMatcher, get_close_matches

    word = word.upper()
    close = get_close_matches(word, dict.fromkeys(c.upper() for c in candidates), 3, LIKENESS)
    likeness = [SequenceMatcher(None, each, word).ratio() for each in close]
    found = [
        each for each, ratio in zip(close, likeness, strict=True) if ratio > likeness[0] - SPREAD
    ]
    return f"did you mean {' or '.join(found)}?" if found else ""
