"""Scenes between runs: what reading and checking a deck and its commands has given.

An entry of the cache is named by everything that decides it: the program (all of its source files,
Python, libraries), the processor, the current folder, and path and content of deck and command
file.  A scene whose reading has taken anything else is not kept: tables from files, routines of the
user.  Neither is one with errors, which is about to be changed.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from adamslite.caching import entries, objects
from adamslite.caching.program import is_unchanged, program
from adamslite.errors import UsageError
from adamslite.language.text import decoded, text_of
from adamslite.native import processor

if TYPE_CHECKING:
    from adamslite.deck.commands import Commands
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.language.diagnostics import Diagnostic

    Read = tuple[Deck, Commands, tuple[Diagnostic, ...]]
    """Deck, commands, and the messages about both."""


MOST = 1 << 22
"""Texts that are kept [bytes]: of some 30 000 statements. Larger ones would fill the cache."""


class Origin(NamedTuple):
    """The name of everything that a scene is read from, and the contents of its files."""

    name: str
    contents: Sequence[bytes]


def origin_of(deck: Path, commands: Path | None) -> Origin | None:
    """What a scene is read from; None where that cannot be known."""
    try:
        facts = [program(), processor.name(), os.getcwd()]
        paths = [deck, commands] if commands else [deck]
        if not all(path.is_file() for path in paths):
            return None  # a pipe can be read once only
        contents = [path.read_bytes() for path in paths if path.stat().st_size <= MOST]
    except (OSError, UsageError):  # reported where they stand in the way
        return None
    if not facts[0] or len(contents) < len(paths) or sum(map(len, contents)) > MOST:
        return None
    found = hashlib.sha256("\0".join([*facts, *map(str, paths)]).encode(errors="surrogateescape"))
    for content in contents:
        found.update(hashlib.sha256(content).digest())
    return Origin(found.hexdigest()[:32], contents)


def command_file_beside(deck_path: Path) -> Path | None:
    """Return the command file that has the name of the deck, if there is one.

    Raises
    ------
    UsageError
        When it is a link to a file elsewhere, which the user has not named.
    """
    if not deck_path.name:  # a folder, which is no deck either
        return None
    candidates = (deck_path.with_suffix(suffix) for suffix in (".acf", ".ACF"))
    found = next((path for path in candidates if path.is_file()), None)
    if found and found.is_symlink():
        from adamslite.language.file_name import leads_out

        if not leads_out(found):
            return found
        raise UsageError(f"'{found}' is a link that leads out of its folder; name it to use it")
    return found


def find(origin: Origin) -> Read | None:
    """The scene that was read from there; None when none is kept."""
    found: Read | None = objects.find(_entry(origin))
    if found is not None:
        found[0].origin = origin.name
    return found


def keep(origin: Origin, read: Read) -> None:
    """Keep a scene that was read from there, if nothing else decided it."""
    deck, commands, _ = read
    if is_kept(origin, deck, commands):
        objects.keep(_entry(origin), read)
        deck.origin = origin.name


def is_kept(origin: Origin, deck: Deck, commands: Sequence[Command]) -> bool:
    """Whether deck and commands are decided by their origin alone."""
    written = getattr(commands, "source", None)
    sources = [deck.source, *([written] if written else [])]
    read = [source.text for source in sources]
    return (
        not (deck.user.called or deck.user.statements or deck.user.routines)
        and not any(tables_of(deck, commands))
        and read == [text_of(decoded(content)) for content in origin.contents]
        and is_unchanged()
    )


def tables_of(deck: Deck, commands: Sequence[Command]) -> list[str]:
    """Names of files in statements: what stands in them may decide the deck."""
    changes = (getattr(command, "changes", {}).get("file") for command in commands)
    named = (getattr(each, "file", None) for each in deck.statements)
    return [name for name in (*named, *changes) if name]


def find_text(origin: Origin, *about: str) -> str | None:
    """The text about a scene that :func:`keep_text` has kept; None when there is none."""
    found = entries.find(_text_entry(origin, about))
    return None if found is None else found.decode(errors="surrogatepass")


def keep_text(
    origin: Origin, text: str, deck: Deck, commands: Sequence[Command], *about: str
) -> None:
    """Keep a text that deck and commands, and ``about``, decide."""
    if is_kept(origin, deck, commands):
        entries.keep(_text_entry(origin, about), text.encode(errors="surrogatepass"))


def _text_entry(origin: Origin, about: Sequence[str]) -> str:
    found = hashlib.sha256("\0".join((origin.name, *about)).encode())
    return f"text{found.hexdigest()[:32]}.kept"


def _entry(origin: Origin) -> str:
    return f"scene{origin.name}.kept"
