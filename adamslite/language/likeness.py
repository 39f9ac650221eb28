"""Words that may have been meant by one that is not known."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

# Likeness at least (1: equal), and by how much less than the first one's.
LIKENESS, SPREAD = 0.6, 0.1

LONGEST = 100
"""Characters of a word that may be meant to be another one."""
ONE_BY_ONE = 1000
"""More words than this are not compared: those that differ in one letter are looked up."""
BUDGET = 30_000
"""Comparisons for the guesses about one text; one takes some ten microseconds."""
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_."


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """A hint naming the closest candidates; empty when none is close."""
    from difflib import SequenceMatcher, get_close_matches

    word = word.upper()
    if len(word) > LONGEST:
        return ""
    known = dict.fromkeys(c.upper() for c in candidates)
    if len(known) > ONE_BY_ONE:
        known = dict.fromkeys(each for each in _one_letter_off(word) if each in known)
    close = get_close_matches(word, known, 3, LIKENESS)
    likeness = [SequenceMatcher(None, each, word).ratio() for each in close]
    found = [
        each for each, ratio in zip(close, likeness, strict=True) if ratio > likeness[0] - SPREAD
    ]
    return f"did you mean {' or '.join(found)}?" if found else ""


def _one_letter_off(word: str) -> Iterator[str]:
    """A word with one letter more, less or changed, or two of them in turn."""
    for at in range(len(word) + 1):
        before, behind = word[:at], word[at:]
        yield before + behind[1:]
        if len(behind) > 1:
            yield before + behind[1] + behind[0] + behind[2:]
        for letter in LETTERS:
            yield before + letter + behind
            yield before + letter + behind[1:]


class Guesses:
    """Guesses about the words of one text, as long as they take no longer than reading it."""

    def __init__(self) -> None:
        self._left = float(BUDGET)
        self._known: dict[tuple[str, str], str] = {}

    def meant(self, word: str, what: str, candidates: Callable[[], Iterable[str]]) -> str:
        """A hint as :func:`did_you_mean` gives it; ``what`` tells sets of candidates apart."""
        if (word, what) in self._known:
            return self._known[word, what]
        if self._left <= 0:
            return ""
        listed = list(candidates())
        self._left -= len(listed) if len(listed) <= ONE_BY_ONE else ONE_BY_ONE + len(listed) / 50
        hint = self._known[word, what] = did_you_mean(word, listed)
        return hint
