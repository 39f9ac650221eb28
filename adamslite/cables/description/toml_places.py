"""Line and column of the keys of a TOML file, which tomllib does not report."""

import re

from adamslite.language.diagnostics import Source, Span

Path = tuple[str | int, ...]

#: A key of fifty parts: reading one takes a time that grows with the square of their number.
LONG = re.compile(r"""(?<![\w."'-])(?:(?:"[^"\n]*+"|'[^'\n]*+'|[\w-]++)[ \t]*+\.[ \t]*+){50}""")

# A row of a list has a comma; that in a name is in quotes, that of a comment is behind a "#".
OPENED = re.compile(r"""^[ \t]*\[(?![^"'#\n]*,)""", re.MULTILINE)
MOST_OPENED = 10_000
"""Lines that open a table."""


def has_long_key(text: str) -> bool:
    """Whether a key has more parts than any description needs."""
    return bool(LONG.search(text))


def excess_of(text: str) -> str:
    """What a text has more of than any description needs; empty where there is nothing.

    Tables take tomllib some ten times as long as other lines, and much memory.
    """
    if has_long_key(text):
        return "a key of more than 50 parts"
    many = any(number == MOST_OPENED for number, _ in enumerate(OPENED.finditer(text)))
    return f"more than {MOST_OPENED} tables" if many else ""


class Places:
    """Places of tables and of keys at the beginning of a line.

    Parameters
    ----------
    source : Source
        The text of the file.
    """

    def __init__(self, source: Source) -> None:
        self.source = source
        self._ranges: dict[Path, tuple[int, int]] = {}
        self._read()

    def _read(self) -> None:
        table: Path = ()
        counted: dict[str, int] = {}
        offset = 0
        for line in self.source.text.splitlines(keepends=True):
            words = line.split("#")[0].strip()
            start = offset + len(line) - len(line.lstrip())
            if words.startswith("[") and words.endswith("]"):
                name = words.strip("[] ")
                table = (name,)
                if words.startswith("[["):
                    table = (name, counted.get(name, 0))
                    counted[name] = counted.get(name, 0) + 1
                self._ranges[table] = start, start + len(words)
            elif "=" in words:
                key = words.partition("=")[0].strip().strip("\"'")
                self._ranges[*table, key] = start, start + len(words)
            offset += len(line)

    def paths(self) -> list[Path]:
        """Of everything that has a place."""
        return list(self._ranges)

    def span(self, path: Path, within: tuple[str, int] = ("", 0)) -> Span:
        """Of a key; of its table where the key does not stand; else of the first line. `within` is
        a word of the value, and the number of the time that it stands there."""
        while path and path not in self._ranges:
            path = path[:-1]
        start, end = self._ranges.get(path, (0, 1))
        word, time = within
        if word:
            value = self.source.text.find("=", start, end)
            found = re.finditer(rf"(?<![^\s\"']){re.escape(word)}(?![^\s\"'])",
                                self.source.text[value + 1 : end])  # fmt: skip
            spans = [each.span() for each in found]
            if value >= 0 and time < len(spans):
                start, end = (value + 1 + at for at in spans[time])
        return self.source.span(start, end)
