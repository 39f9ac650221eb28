"""The text of a file, whatever its encoding and its line ends."""

from __future__ import annotations

from codecs import BOM_UTF16_BE, BOM_UTF16_LE


def decoded(data: bytes) -> str:
    """The text of a file: UTF-16 where it begins as such, else UTF-8, else Latin-1."""
    wide = data[:2] in (BOM_UTF16_LE, BOM_UTF16_BE)
    try:
        return data.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def text_of(source: str) -> str:
    """A text with ``\\n`` line ends."""
    return source.replace("\r\n", "\n").replace("\r", "\n")
