"""Renaming: an id where it is defined and wherever it is referred to, or a name of ADAMS/View."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from adamslite.deck.names import RESERVED
from adamslite.editing.document import Content
from adamslite.editing.rereading import Use
from adamslite.errors import UsageError
from adamslite.language.interfaces import Key, key_of
from adamslite.language.spelling import spelled
from adamslite.reading.argument_values import to_id
from adamslite.syntax.tokens import scan
from adamslite.syntax.typeset import is_typeset


def rename(texts: Sequence[Content], at: Content, offset: int, new: str) -> list[list[Use]]:
    """The places in each text that the new name replaces.

    Parameters
    ----------
    texts : sequence of Content
        A deck and the command files that belong to it.
    at : Content
        The one with the cursor, and ``offset`` in it.
    new : str

    Raises
    ------
    UsageError
        When there is nothing to rename, the name will not do, or a text cannot be read wholly.
    """
    symbol = at.symbol_at(offset)
    if symbol is None:
        raise UsageError("there is no id or name here")
    written = _canonical(at.text[symbol.start : symbol.end])
    for text in texts:
        _need_readable(text)
        if is_typeset(text.text):
            raise UsageError("names are not replaced in a text that is typeset in LaTeX")
    _need_free(at, symbol.kind, written == symbol.key, new)
    found = []
    for text in texts:
        uses = [*text.uses_of.get((symbol.kind, symbol.key), ()), *_own(text, symbol)]
        same = {use for use in uses if _canonical(text.text[use.start : use.end]) == written}
        found.append(sorted(same, key=lambda use: use.start))
    return found


def _own(text: Content, symbol: Use) -> Iterator[Use]:
    """Where the statement itself is defined and named."""
    if text.place == "command":
        return
    if definition := text.definitions.get((symbol.kind, symbol.key)):
        yield definition
    for name in text.view_names():
        if name[:2] == symbol[:2]:
            yield name


def _canonical(word: str) -> Key:
    word = spelled(word.strip() or " ").upper()
    return key_of(word)


def _need_readable(text: Content) -> None:
    """Raise an error where statements cannot be read: they may refer to what is renamed."""
    unread = text.deck.incomplete if text.deck and text.place == "deck" else set()
    wrong = text.place == "command" and any(each.is_error for each in text.diagnostics)
    if unread or wrong:
        what = f"of {', '.join(sorted(unread))} " if unread else "of the command file "
        raise UsageError(f"first correct the statements {what}that cannot be read")


def _need_free(at: Content, kind: str, is_id: bool, new: str) -> None:
    """Raise an error unless a statement of this kind may have the new id or name."""
    tokens = [token for stretch in scan(new) for token in stretch]
    key = to_id(tokens) if len(tokens) == 1 and tokens[0][1] == new else None
    if not key or (isinstance(key, int) and not is_id):
        raise UsageError(f"'{new}' is not {'an id' if is_id else 'a name'}")
    wanted = key.upper() if isinstance(key, str) else key
    if kind == "VARIABLE" and wanted in RESERVED:
        raise UsageError(f"{new} always means something else in an expression")
    if at.names.find(kind, wanted) is not None:
        raise UsageError(f"there is a {kind}/{new} already")
