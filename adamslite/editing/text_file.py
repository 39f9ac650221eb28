"""A text file that is written back as it was read: in its encoding, with its line ends."""

from __future__ import annotations

from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from pathlib import Path
from typing import NamedTuple

from adamslite.language.text import MOST, contents, decoded
from adamslite.outputs.whole_files import whole_file

COMMAND_SUFFIX = ".acf"


class TextFile(NamedTuple):
    """A deck or a command file; ``text`` has ``\\n`` as line ends."""

    path: Path
    text: str
    encoding: str
    line_end: str

    @property
    def place(self) -> str:
        """``"command"`` for a command file, else ``"deck"``."""
        return place_of(self.path)

    def replace(self, text: str) -> None:
        """Write another text, whole or not at all; who may read the file stays."""
        data = text.replace("\n", self.line_end).encode(self.encoding)
        mode = self.path.stat().st_mode
        with whole_file(self.path, binary=True) as stream:
            stream.write(data)
        self.path.chmod(mode)


def place_of(path: str | Path) -> str:
    """Where the statements of a file stand: in a ``"deck"`` or as a ``"command"``."""
    return "command" if str(path).lower().endswith(COMMAND_SUFFIX) else "deck"


def read_text(path: Path) -> TextFile:
    """Read a file; see :func:`adamslite.language.text.decoded` for its encodings."""
    data = contents(path, MOST)
    text = decoded(data)
    line_end = "\r\n" if "\r\n" in text else "\n"
    plain = text.replace("\r\n", "\n").replace("\r", "\n")
    return TextFile(path, plain, _encoding(data), line_end)


def _encoding(data: bytes) -> str:
    """Name of the encoding that :func:`decoded` finds."""
    if data[:2] in (BOM_UTF16_LE, BOM_UTF16_BE):
        return "utf-16"
    if data.startswith(BOM_UTF8):
        return "utf-8-sig"
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8"
