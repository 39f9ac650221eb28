"""What the language server answers: one function for each request of the protocol."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from adamslite.editing import completion as complete
from adamslite.editing.document import Content
from adamslite.editing.hover import hover
from adamslite.editing.layout import formatted
from adamslite.editing.positions import changed_lines
from adamslite.editing.rename import rename
from adamslite.editing.rereading import Use
from adamslite.editing.server import COMMAND_SUFFIXES, Server
from adamslite.editing.stream import serve
from adamslite.editing.text_file import place_of
from adamslite.errors import UsageError

PAUSE = 0.02
"""Seconds without a further edit before messages are published."""
REST = 0.3
"""And before the advice is added that takes an assembly of the model."""
KINDS = {
    complete.STATEMENT: lsp.CompletionItemKind.Class,
    complete.ARGUMENT: lsp.CompletionItemKind.Field,
    complete.OPTION: lsp.CompletionItemKind.EnumMember,
    complete.ID: lsp.CompletionItemKind.Reference,
    complete.FUNCTION: lsp.CompletionItemKind.Function,
    complete.VARIABLE: lsp.CompletionItemKind.Variable,
    complete.MESSAGE: lsp.CompletionItemKind.Constant,
}
SYMBOLS = {
    "PART": lsp.SymbolKind.Class,
    "POINT_MASS": lsp.SymbolKind.Class,
    "MARKER": lsp.SymbolKind.Field,
    "VARIABLE": lsp.SymbolKind.Variable,
    "DIFF": lsp.SymbolKind.Variable,
    "ARRAY": lsp.SymbolKind.Array,
    "STRING": lsp.SymbolKind.String,
}
"""Pictures of statements in an outline; of the others, that of an object."""


def start() -> None:
    """Serve over standard input and output until the client leaves."""
    server = Server()
    for method, handler in FEATURES.items():
        options = TRIGGERS if handler is completed else None
        server.feature(method, options)(handler)
    serve(server)


# ---- texts -------------------------------------------------------------------------------------


async def opened(ls: Server, params: lsp.DidOpenTextDocumentParams) -> None:
    ls.publish(params.text_document.uri)
    await _completed(ls, params.text_document.uri)


async def changed(ls: Server, params: lsp.DidChangeTextDocumentParams) -> None:
    uri, version = params.text_document.uri, params.text_document.version
    await asyncio.sleep(PAUSE)
    if ls.version_of(uri) != version:
        return
    ls.publish(uri)
    for other in ls.beside(uri, COMMAND_SUFFIXES) if place_of(uri) == "deck" else ():
        ls.publish(other)
    await _completed(ls, uri)


async def _completed(ls: Server, uri: str) -> None:
    """Add the advice once there is no edit for a while; it may take long, so beside all else."""
    version = ls.version_of(uri)
    await asyncio.sleep(REST)
    if version is None or ls.version_of(uri) != version:
        return
    _, document = ls.documents[uri]
    if (
        await asyncio.to_thread(document.complete, document.content)
        and ls.version_of(uri) == version
    ):
        ls.publish(uri)


def closed(ls: Server, params: lsp.DidCloseTextDocumentParams) -> None:
    uri = params.text_document.uri
    ls.documents.pop(uri, None)
    ls.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))


# ---- the word under the cursor -------------------------------------------------------------------


def explained(ls: Server, params: lsp.HoverParams) -> lsp.Hover | None:
    content = ls.content(params.text_document.uri)
    positions = ls.positions(content)
    found = hover(content, positions.offset(params.position))
    if found is None:
        return None
    page, start, end = found
    text = lsp.MarkupContent(lsp.MarkupKind.Markdown, page)
    return lsp.Hover(text, positions.range_between(start, end))


def completed(ls: Server, params: lsp.CompletionParams) -> lsp.CompletionList:
    content = ls.content(params.text_document.uri)
    found = complete.completion(content, ls.positions(content).offset(params.position))
    items = [
        lsp.CompletionItem(
            label=each.word, kind=KINDS[each.kind], detail=each.detail or None,
            insert_text=each.inserted or None,
        )
        for each in found
    ]  # fmt: skip
    return lsp.CompletionList(is_incomplete=False, items=items)


# ---- places of statements ------------------------------------------------------------------------


def _symbol(ls: Server, uri: str, position: lsp.Position) -> Use | None:
    content = ls.content(uri)
    return content.symbol_at(ls.positions(content).offset(position))


def _locations(
    ls: Server, uri: str, content: Content, uses: Sequence[Use | None]
) -> list[lsp.Location]:
    positions = ls.positions(content)
    return [lsp.Location(uri, positions.range_between(use.start, use.end)) for use in uses if use]


def _defined(ls: Server, uri: str, use: Use) -> list[lsp.Location]:
    return [
        place
        for other, content in ls.family(uri).items()
        for place in _locations(ls, other, content, [content.definitions.get((use.kind, use.key))])
    ]


def definition(ls: Server, params: lsp.DefinitionParams) -> list[lsp.Location]:
    use = _symbol(ls, params.text_document.uri, params.position)
    return _defined(ls, params.text_document.uri, use) if use else []


def references(ls: Server, params: lsp.ReferenceParams) -> list[lsp.Location]:
    uri = params.text_document.uri
    use = _symbol(ls, uri, params.position)
    if use is None:
        return []
    found = _defined(ls, uri, use) if params.context.include_declaration else []
    for other, content in ls.family(uri).items():
        found += _locations(ls, other, content, content.uses_of.get((use.kind, use.key), []))
    return found


def symbols(ls: Server, params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
    content = ls.content(params.text_document.uri)
    positions = ls.positions(content)
    if content.deck is None or content.place == "command":
        return []
    found = []
    for each in content.deck.own:
        where = positions.range_of(each.span)
        kind = SYMBOLS.get(each.keyword, lsp.SymbolKind.Object)
        found.append(lsp.DocumentSymbol(each.label, kind, where, where, each.name))
    return found


# ---- changes -------------------------------------------------------------------------------------


def renamed(ls: Server, params: lsp.RenameParams) -> lsp.WorkspaceEdit:
    uri = params.text_document.uri
    texts = ls.family(uri)
    offset = ls.positions(texts[uri]).offset(params.position)
    try:
        found = rename([*texts.values()], texts[uri], offset, params.new_name)
    except UsageError as fault:
        raise JsonRpcInvalidParams(str(fault)) from None
    changes: dict[str, Sequence[lsp.TextEdit]] = {}
    for (other, content), uses in zip(texts.items(), found, strict=True):
        places = (place.range for place in _locations(ls, other, content, uses))
        if edits := [lsp.TextEdit(place, params.new_name) for place in places]:
            changes[other] = edits
    return lsp.WorkspaceEdit(changes)


def renamable(ls: Server, params: lsp.PrepareRenameParams) -> lsp.Range | None:
    content = ls.content(params.text_document.uri)
    use = _symbol(ls, params.text_document.uri, params.position)
    return ls.positions(content).range_between(use.start, use.end) if use else None


def laid_out(ls: Server, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    content = ls.content(params.text_document.uri)
    layout = formatted(content.text, content.place)
    if layout == content.text:
        return []
    start, end, text = changed_lines(content.text, layout)
    return [lsp.TextEdit(ls.positions(content).range_between(start, end), text)]


def corrected(ls: Server, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    uri = params.text_document.uri
    content = ls.content(uri)
    positions = ls.positions(content)
    found = []
    for diagnostic in content.diagnostics:
        if not _touch(positions.range_of(diagnostic.span), params.range):
            continue
        for title, edits in diagnostic.fixes:
            changes = [lsp.TextEdit(positions.range_of(span), text) for span, text in edits]
            edit = lsp.WorkspaceEdit({uri: changes})
            kind = lsp.CodeActionKind.QuickFix
            found.append(lsp.CodeAction(title=title, kind=kind, edit=edit))
    return found


def _touch(one: lsp.Range, other: lsp.Range) -> bool:
    return _pair(one.start) <= _pair(other.end) and _pair(other.start) <= _pair(one.end)


def _pair(position: lsp.Position) -> tuple[int, int]:
    return position.line, position.character


TRIGGERS = lsp.CompletionOptions(trigger_characters=["/", ",", "=", "(", " "])
FEATURES: dict[str, Callable[..., Any]] = {
    lsp.TEXT_DOCUMENT_DID_OPEN: opened,
    lsp.TEXT_DOCUMENT_DID_CHANGE: changed,
    lsp.TEXT_DOCUMENT_DID_CLOSE: closed,
    lsp.TEXT_DOCUMENT_HOVER: explained,
    lsp.TEXT_DOCUMENT_COMPLETION: completed,
    lsp.TEXT_DOCUMENT_DEFINITION: definition,
    lsp.TEXT_DOCUMENT_REFERENCES: references,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: symbols,
    lsp.TEXT_DOCUMENT_RENAME: renamed,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: renamable,
    lsp.TEXT_DOCUMENT_FORMATTING: laid_out,
    lsp.TEXT_DOCUMENT_CODE_ACTION: corrected,
}
