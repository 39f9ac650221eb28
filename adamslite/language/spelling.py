"""Names as ADAMS/View spells them, in plain letters."""

from __future__ import annotations

from functools import lru_cache


def spelled(name: str) -> str:
    """A name in plain letters: ``\\Delta L`` and a Greek letter followed by L are ``DeltaL``."""
    if name.isascii() and name[0] != "\\":
        return name
    return _spelled(name)


@lru_cache(maxsize=4096)
def _spelled(name: str) -> str:
    import unicodedata

    def plain(letter: str) -> str:
        words = unicodedata.name(letter, "").split()
        if letter == "\N{INCREMENT}":
            return "Delta"
        if words[:1] == ["MICRO"]:
            return "mu"
        if words[:1] == ["GREEK"] and "LETTER" in words:
            spelling = words[words.index("LETTER") + 1].lower()
            return spelling.capitalize() if "CAPITAL" in words else spelling
        return letter

    return "".join(map(plain, name.removeprefix("\\").replace(" ", "").replace("\t", "")))
