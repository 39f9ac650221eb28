"""Names as ADAMS/View spells them, in plain letters."""

from __future__ import annotations

from functools import lru_cache

_SIGNS = str.maketrans("", "", "\\{} \t")


def spelled(name: str) -> str:
    """A name in plain letters: ``\\Delta L`` and a Greek letter followed by L are ``DeltaL``,
    ``L\\_0`` and ``L_{0}`` are ``L_0``.
    """
    if name.isascii() and "\\" not in name and "{" not in name:
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

    return "".join(map(plain, name.translate(_SIGNS)))
