"""Line and column of the keys of a TOML file, which tomllib does not report."""

from adamslite.language.diagnostics import Source, Span

Path = tuple[str | int, ...]


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

    def span(self, path: Path) -> Span:
        """Of a key; of its table where the key does not stand; else of the first line."""
        while path and path not in self._ranges:
            path = path[:-1]
        return self.source.span(*self._ranges.get(path, (0, 1)))
