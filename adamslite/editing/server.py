"""The language server: the texts that are open, and what is said about them.

Language Server Protocol 3.17, by pygls.  Only `adamslite lsp` imports this module.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from urllib.parse import unquote

from lsprotocol import types as lsp
from pygls import uris
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer
from pygls.workspace import TextDocument

from adamslite import __version__
from adamslite.editing.document import Content, Document
from adamslite.editing.positions import Positions
from adamslite.editing.text_file import place_of, read_text
from adamslite.language.diagnostics import Diagnostic, Span
from adamslite.language.file_name import leads_out

SEVERITY = {
    "error": lsp.DiagnosticSeverity.Error,
    "warning": lsp.DiagnosticSeverity.Warning,
    "note": lsp.DiagnosticSeverity.Information,
}


DECK_SUFFIXES = (".adm", ".ADM")
COMMAND_SUFFIXES = (".acf", ".ACF")


SUFFIXES = (*DECK_SUFFIXES, *COMMAND_SUFFIXES)


def _path(uri: str) -> Path | None:
    """The file that a URI names; None for what is no name of a file."""
    try:
        found = uris.to_fs_path(uri)
    except ValueError:
        return None
    return Path(found) if found else None


def _is_beside(path: Path | None) -> bool:
    """Whether a file is there, and is no link to one elsewhere, which would be quoted."""
    try:
        return path is not None and path.is_file() and not leads_out(path)
    except (OSError, ValueError):  # a name that no file can have
        return False


def _text_of(document: Document, uri: str) -> str:
    """The text of a file that is not open."""
    try:
        return read_text(Path(document.file)).text
    except (OSError, ValueError) as fault:
        raise JsonRpcInvalidParams(f"{uri} is not open and cannot be read: {fault}") from None


class Server(LanguageServer):
    """The texts that are open, and those that belong to them."""

    def __init__(self) -> None:
        super().__init__("adamslite", __version__)
        self.documents: dict[str, tuple[int | None, Document]] = {}

    def content(self, uri: str) -> Content:
        """A text as it is now; a command file with its deck."""
        open_one = self.opened(uri)
        if open_one is None and not self._is_of_family(uri):
            raise JsonRpcInvalidParams(f"{uri} is not open")
        version, document = self.documents.get(uri, (-1, None))
        if document is None:
            document = Document(_path(uri) or uri, place_of(uri))
        if open_one is None:
            document.update(_text_of(document, uri), self._deck_of(uri, document))
        elif version != open_one.version or document.place == "command":
            document.update(open_one.source, self._deck_of(uri, document))
        self.documents[uri] = (open_one.version if open_one else None, document)
        return document.content

    def opened(self, uri: str) -> TextDocument | None:
        """The text that is open under a URI; pygls 2.1 has them without escapes such as %20."""
        texts = self.workspace.text_documents
        return texts.get(uri) or texts.get(unquote(uri))

    def version_of(self, uri: str) -> int | None:
        """The version of a text that is open; None of others."""
        found = self.opened(uri)
        return found.version if found else None

    def _deck_of(self, uri: str, document: Document) -> Content | None:
        beside = self.beside(uri, DECK_SUFFIXES) if document.place == "command" else []
        return self.content(beside[0]) if beside else None

    def beside(self, uri: str, suffixes: Sequence[str]) -> list[str]:
        """Texts with the same name and another suffix that are open or exist."""
        stem = uri.rpartition(".")[0]
        found = []
        for other in (stem + suffix for suffix in suffixes):
            if self.opened(other) or _is_beside(_path(other)):
                found.append(other)
        return found

    def _is_of_family(self, uri: str) -> bool:
        """Whether a text that is not open lies beside one that is: no other file is read."""
        stem, _, suffix = uri.rpartition(".")
        others = (stem + each for each in SUFFIXES)
        is_one = f".{suffix}" in SUFFIXES and _is_beside(_path(uri))
        return is_one and any(map(self.opened, others))

    def family(self, uri: str) -> dict[str, Content]:
        """A deck and its command file, with the one that is asked for."""
        others = self.beside(uri, SUFFIXES)
        known = {uri: self.content(uri)}
        return known | {other: self.content(other) for other in others if other != uri}

    def publish(self, uri: str) -> None:
        """Send the messages about a text."""
        open_one = self.opened(uri)
        if open_one is None:
            return
        content = self.content(uri)
        positions = self.positions(content)
        found = [
            each for diagnostic in content.diagnostics
            for each in self._translated(uri, content, positions, diagnostic)
        ]  # fmt: skip
        params = lsp.PublishDiagnosticsParams(uri, found, open_one.version)
        self.text_document_publish_diagnostics(params)

    def positions(self, content: Content) -> Positions:
        """Places of a text as the client counts them."""
        encoding = self.workspace.position_encoding
        return Positions(content, str(getattr(encoding, "value", encoding)))

    def _translated(
        self, uri: str, content: Content, positions: Positions, each: Diagnostic
    ) -> list[lsp.Diagnostic]:
        """One for each of its places."""
        related = [
            lsp.DiagnosticRelatedInformation(self._location(uri, content, positions, span), text)
            for span, text in each.related
        ]
        return [
            lsp.Diagnostic(
                range=positions.range_of(span),
                message=f"{each.message}\n{each.hint}" if each.hint else each.message,
                severity=SEVERITY[each.severity],
                code=each.code,
                source="adamslite",
                related_information=related or None,
            )
            for span in each.everywhere
        ]

    def _location(
        self, uri: str, content: Content, positions: Positions, span: Span
    ) -> lsp.Location:
        deck = content.deck
        if deck and content.place == "command" and span.file == deck.source.file:
            return lsp.Location(self.beside(uri, DECK_SUFFIXES)[0], positions.plain(span))
        return lsp.Location(uri, positions.range_of(span))
