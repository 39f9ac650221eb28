"""Sessions of an editor with the language server, which is called in this process.

A session is a file of messages, one a line.  The server answers each with a result, or with the
error of a request that is wrong; an internal error is a fault.
"""

from __future__ import annotations

import asyncio
import json
import logging
import traceback
from pathlib import Path
from random import Random
from typing import Any

from . import material, text_changes
from .cases import Case

MESSAGES = "messages.jsonl"
URIS = ("file:///deck.adm", "file:///deck.acf", "untitled:deck", "file:///other.adm", "x")
#: Error codes of JSON-RPC: a method that is not known, parameters that are wrong.
REJECTED = (-32601, -32602)
INITIALIZE = {"processId": None, "rootUri": None, "capabilities": {}}
AT = ("hover", "completion", "definition", "references", "rename", "prepareRename")
OF = ("documentSymbol", "formatting", "codeAction")
ODD_NUMBERS = (-1, 0, 1, 2**31 - 1, 2**31, 10**30, 0.5, None, "1", True, [], {})


def session(random: Random) -> Case:
    """Messages of an editor: texts are opened, edited and asked about, some beyond their ends."""
    decks = material.decks()
    texts = {uri: text_changes.changed(random, decks.any(random), decks.texts) for uri in URIS}
    messages = [_message(1, "initialize", INITIALIZE), _message(None, "initialized", {})]
    messages.append(_opened(URIS[0], texts[URIS[0]]))
    for number in range(2, 2 + random.randint(5, 20)):
        uri = random.choice(URIS) if random.random() < 0.2 else URIS[0]
        messages.append(_any_message(random, number, uri, texts))
    lines = (json.dumps(each) for each in messages)
    return Case({MESSAGES: "".join(f"{line}\n" for line in lines).encode()})


def _message(number: Any, method: str, params: Any) -> dict[str, Any]:
    found = {"jsonrpc": "2.0", "method": method, "params": params}
    return found if number is None else found | {"id": number}


def _opened(uri: str, text: str) -> dict[str, Any]:
    document = {"uri": uri, "languageId": "adams", "version": 1, "text": text}
    return _message(None, "textDocument/didOpen", {"textDocument": document})


def _any_message(random: Random, number: int, uri: str, texts: dict[str, str]) -> dict[str, Any]:
    """A message, of which a few are damaged."""
    form = random.random()
    if form < 0.1:
        found = _opened(uri, texts[uri])
    elif form < 0.15:
        found = _message(None, "textDocument/didClose", {"textDocument": {"uri": uri}})
    elif form < 0.5:
        found = _edit(random, number, uri, texts)
    elif form < 0.9:
        params = {"textDocument": {"uri": uri}, "position": _position(random, texts[uri]),
                  "context": {"includeDeclaration": True}}  # fmt: skip
        method = random.choice(AT)
        if method == "rename":
            params["newName"] = random.choice(["9", "", "a b", "x" * 1000, "1.5", "NEW", "é", "-1"])
        found = _message(number, f"textDocument/{method}", params)
    else:
        params = {"textDocument": {"uri": uri}, "range": _range(random, texts[uri]),
                  "options": {"tabSize": 4, "insertSpaces": True},
                  "context": {"diagnostics": []}}  # fmt: skip
        found = _message(number, f"textDocument/{random.choice(OF)}", params)
    return _damaged(random, found) if random.random() < 0.1 else found


def _edit(random: Random, number: int, uri: str, texts: dict[str, str]) -> dict[str, Any]:
    piece = text_changes.changed(random, random.choice(["", "PART/3\n", "1"]), [texts[uri]], 2)
    whole = random.random() < 0.2
    change = {"text": texts[uri] + piece if whole else piece[:500]}
    if not whole:
        change["range"] = _range(random, texts[uri])
    document = {"uri": uri, "version": number}
    return _message(
        None, "textDocument/didChange", {"textDocument": document, "contentChanges": [change]}
    )


def _position(random: Random, text: str) -> dict[str, int]:
    if random.random() < 0.05:
        return {"line": random.choice([0, 10**6]), "character": random.choice([0, 10**6])}
    lines = text.split("\n")
    line = random.randrange(len(lines) + 1)
    width = len(lines[line]) if line < len(lines) else 0
    return {"line": line, "character": random.randrange(width + 3)}


def _range(random: Random, text: str) -> dict[str, Any]:
    return {"start": _position(random, text), "end": _position(random, text)}


def _damaged(random: Random, message: dict[str, Any]) -> dict[str, Any]:
    """With a value exchanged, or left out, somewhere in its parameters."""
    at: Any = message["params"]
    while True:
        keys = [*at] if isinstance(at, dict) else [*range(len(at))]
        if not keys:
            return message
        key = random.choice(keys)
        if isinstance(at[key], dict | list) and at[key] and random.random() < 0.7:
            at = at[key]
            continue
        if isinstance(at, dict) and random.random() < 0.3:
            del at[key]
        else:
            at[key] = random.choice(ODD_NUMBERS)
        return message


# ---- the server ----------------------------------------------------------------------------------


class Unanswered(Exception):
    """A fault in the server, with its trace."""


class _Writer:
    """Collects what the server sends."""

    def __init__(self) -> None:
        self.sent: list[dict[str, Any]] = []

    def write(self, data: bytes) -> None:
        self.sent.append(json.loads(data.decode("utf-8", "surrogatepass")))

    def close(self) -> None:
        """Nothing is open."""


def serve(case: Case, folder: Path) -> str:
    """Let a server answer all messages of a session."""
    messages = [json.loads(line) for line in case.files[MESSAGES].decode().splitlines()]
    writer, silenced = _Writer(), logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        asyncio.run(_served(messages, writer))
    finally:
        logging.disable(silenced)
    errors = any("error" in each for each in writer.sent)
    answered = {each["id"] for each in writer.sent if "id" in each and "method" not in each}
    assert answered <= {each.get("id") for each in messages}
    return "rejected" if errors else "answered"


async def _served(messages: list[dict[str, Any]], writer: _Writer) -> None:
    from adamslite.editing import handlers
    from adamslite.editing.server import Server

    handlers.PAUSE = handlers.REST = 0.0
    server = Server()
    for method, handler in handlers.FEATURES.items():
        server.feature(method, handlers.TRIGGERS if handler is handlers.completed else None)(
            handler
        )
    faults: list[Exception] = []
    server.report_server_error = lambda fault, source: faults.append(fault)
    server.protocol.set_writer(writer, include_headers=False)
    for message in messages:
        _deliver(server, message)
        await asyncio.sleep(0)
    while waiting := asyncio.all_tasks() - {asyncio.current_task()}:
        await asyncio.wait(waiting)
    server.shutdown()
    for fault in faults:
        trace = _trace(fault)
        ours = "adamslite" in trace.partition("Traceback")[2]  # else of messages in a wrong order
        if getattr(fault, "code", None) not in REJECTED and ours:
            raise Unanswered(trace) from fault


def _trace(fault: Exception) -> str:
    """Where it was raised, as far as the server reports it."""
    found = getattr(fault, "data", None) or {}
    return "".join(["Traceback ", *found.get("traceback", traceback.format_exception(fault))])


def _deliver(server: Any, message: dict[str, Any]) -> None:
    """As the reader of the protocol does: what cannot be understood is left out."""
    from pygls.exceptions import JsonRpcException

    try:
        structured = server.protocol.structure_message(message)
    except JsonRpcException:
        return
    server.protocol.handle_message(structured)
