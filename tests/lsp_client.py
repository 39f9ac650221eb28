"""A client of the language server: JSON-RPC over the pipes of a process."""

from __future__ import annotations

import json
import subprocess
import sys
from queue import Queue
from threading import Thread
from types import TracebackType
from typing import Any

LONGEST = 60
"""Seconds after which an answer is not waited for any more."""


class Client:
    """Starts `adamslite lsp` and talks to it; what the server sends by itself is collected."""

    def __init__(self) -> None:
        command = [sys.executable, "-m", "adamslite", "lsp", "--stdio"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL)
        self.received: Queue[dict[str, Any]] = Queue()
        self.listener = Thread(target=self._listen, daemon=True)
        self.listener.start()
        self.number = 0
        self.notes: list[dict[str, Any]] = []

    def __enter__(self) -> Client:
        found = self.request("initialize", processId=None, rootUri=None, capabilities={})
        self.capabilities: dict[str, Any] = found["capabilities"]
        self.notify("initialized")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: object, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.request("shutdown")
            self.notify("exit")
            assert self.process.wait(LONGEST) == 0
        else:
            self.process.kill()
            self.process.wait()
        self.listener.join()
        for stream in (self.process.stdin, self.process.stdout):
            assert stream
            stream.close()

    def _send(self, **message: Any) -> None:
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        assert self.process.stdin
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
        self.process.stdin.flush()

    def _listen(self) -> None:
        """Collect what the server sends, until it has gone."""
        stream = self.process.stdout
        assert stream
        while True:
            length = 0
            while line := stream.readline().strip():
                name, _, value = line.partition(b":")
                length = int(value) if name.lower() == b"content-length" else length
            if not length:
                return
            self.received.put(json.loads(stream.read(length)))

    def _receive(self) -> dict[str, Any]:
        return self.received.get(timeout=LONGEST)

    def request(self, method: str, **params: Any) -> Any:
        """The result of a request; an error of the server is raised as one."""
        self.number += 1
        self._send(id=self.number, method=method, params=params or None)
        while True:
            message = self._receive()
            if message.get("id") == self.number and "method" not in message:
                if "error" in message:
                    raise RuntimeError(message["error"]["message"])
                return message["result"]
            self.notes.append(message)

    def notify(self, method: str, **params: Any) -> None:
        self._send(method=method, params=params)

    def open(self, uri: str, text: str) -> list[dict[str, Any]]:
        """Open a text; the messages about it."""
        document = {"uri": uri, "languageId": "adams", "version": 1, "text": text}
        self.notify("textDocument/didOpen", textDocument=document)
        return self.messages(uri, 1)

    def edit(self, uri: str, version: int, *changes: tuple[int, int, int, int, str]) -> None:
        """Replace stretches, given by line and column of both ends counted from 0."""
        found = [
            {"range": {"start": place(*each[:2]), "end": place(*each[2:4])}, "text": each[4]}
            for each in changes
        ]
        document = {"uri": uri, "version": version}
        self.notify("textDocument/didChange", textDocument=document, contentChanges=found)

    def messages(self, uri: str, version: int) -> list[dict[str, Any]]:
        """The messages about a version of a text, once they come."""
        while True:
            for note in self.notes:
                params = note.get("params") or {}
                if note.get("method") == "textDocument/publishDiagnostics" and (
                    params["uri"] == uri and params.get("version") == version
                ):
                    self.notes.remove(note)
                    return params["diagnostics"]
            self.notes.append(self._receive())

    def at(self, method: str, uri: str, line: int, column: int, **params: Any) -> Any:
        """A request about a place in a text."""
        params |= {"textDocument": {"uri": uri}, "position": place(line, column)}
        return self.request(f"textDocument/{method}", **params)


def place(line: int, column: int) -> dict[str, int]:
    return {"line": line, "character": column}
