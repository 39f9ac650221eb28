"""The language server: the texts that are open, and what is said about them.

Language Server Protocol 3.17, by pygls.  Only `adamslite lsp` imports this module.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lsprotocol import types as lsp
from pygls import uris
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer

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


def _is_beside(path: Path) -> bool:
    """Whether a file is there, and is no link to one elsewhere, which would be quoted."""
    return path.is_file() and not leads_out(path)


def _text_of(document: Document, uri: str) -> str:
    """The text of a file that is not open."""
    try:
        return read_text(Path(document.file)).text
    except (OSError, ValueError) as fault:  # no file at all, or no name of one
        raise JsonRpcInvalidParams(f"{uri} is not open and cannot be read: {fault}") from None


class Server(LanguageServer):
    """The texts that are open, and those that belong to them."""

    def __init__(self) -> None:
        super().__init__("adamslite", __version__)
        self.documents: dict[str, tuple[int | None, Document]] = {}

    def content(self, uri: str) -> Content:
        """A text as it is now; a command file with its deck."""
        open_one = self.workspace.text_documents.get(uri)
        version, document = self.documents.get(uri, (-1, None))
        if document is None:
            path = uris.to_fs_path(uri)
            document = Document(Path(path) if path else uri, place_of(uri))
        if open_one is None:
            document.update(_text_of(document, uri), self._deck_of(uri, document))
        elif version != open_one.version or document.place == "command":
            document.update(open_one.source, self._deck_of(uri, document))
        self.documents[uri] = (open_one.version if open_one else None, document)
        return document.content

    def version_of(self, uri: str) -> int | None:
        """The version of a text that is open; None of others."""
        found = self.workspace.text_documents.get(uri)
        return found.version if found else None

    def _deck_of(self, uri: str, document: Document) -> Content | None:
        beside = self.beside(uri, DECK_SUFFIXES) if document.place == "command" else []
        return self.content(beside[0]) if beside else None

    def beside(self, uri: str, suffixes: Sequence[str]) -> list[str]:
        """Texts with the same name and another suffix that are open or exist."""
        stem = uri.rpartition(".")[0]
        found = []
        for other in (stem + suffix for suffix in suffixes):
            path = uris.to_fs_path(other)
            if other in self.workspace.text_documents or (path and _is_beside(Path(path))):
                found.append(other)
        return found

    def family(self, uri: str) -> dict[str, Content]:
        """A deck and its command file, with the one that is asked for."""
        others = self.beside(uri, (*DECK_SUFFIXES, *COMMAND_SUFFIXES))
        known = {uri: self.content(uri)}
        return known | {other: self.content(other) for other in others if other != uri}

    def publish(self, uri: str) -> None:
        """Send the messages about a text."""
        open_one = self.workspace.text_documents.get(uri)
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
