"""The stream of messages from an editor: headers, and bodies of JSON-RPC.

Language Server Protocol 3.17, base protocol.  pygls answers the messages; its own reader takes a
body of any length that a header announces, and leaves requests that it cannot understand without an
answer.
"""

from __future__ import annotations

import asyncio
import json
import logging
import sys
from _thread import start_new_thread
from contextlib import suppress
from typing import Any, BinaryIO

from pygls.exceptions import JsonRpcException, JsonRpcInvalidRequest, JsonRpcParseError
from pygls.io_ import StdoutWriter
from pygls.lsp.server import LanguageServer

from adamslite.language.text import MOST, PIECE

LOG = logging.getLogger("pygls.stream")
#: Longest line of a header, and digits of the length that it announces.
LINE, DIGITS = 4096, 12
LENGTH = b"content-length"


def serve(server: LanguageServer) -> None:
    """Answer what comes over standard input until the client leaves."""
    server.protocol.set_writer(StdoutWriter(sys.stdout.buffer))
    # One of its own: Python closes that of the process, which a thread may be reading, at the end.
    stream = open(sys.stdin.fileno(), "rb", closefd=False)
    try:
        asyncio.run(_answered(server, stream))
    except BrokenPipeError:
        LOG.error("the editor has gone")
    except (KeyboardInterrupt, SystemExit):
        pass
    finally:
        server.shutdown()


async def _answered(server: LanguageServer, stream: BinaryIO) -> None:
    asyncio.get_running_loop().set_exception_handler(_report)
    while (data := await _next(stream)) is not None:
        answer(server, data)


def _report(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """What goes wrong beside the answers; that the end cancels what is worked on is no fault."""
    fault = context.get("exception")
    if not isinstance(fault, asyncio.CancelledError | SystemExit):
        LOG.error("%s: %s", context["message"], fault)


def _next(stream: BinaryIO) -> asyncio.Future[bytes | None]:
    """What :func:`body` reads in a thread, for which nobody waits when the process is to end."""
    loop = asyncio.get_running_loop()
    found: asyncio.Future[bytes | None] = loop.create_future()

    def settle(data: bytes | None) -> None:
        if not found.done():
            found.set_result(data)

    def read() -> None:
        data = None
        with suppress(OSError, MemoryError):
            data = body(stream)
        with suppress(RuntimeError):  # the loop has ended
            loop.call_soon_threadsafe(settle, data)

    start_new_thread(read, ())
    return found


def body(stream: BinaryIO) -> bytes | None:
    """The bytes of the next message that can be read; None when the stream has ended."""
    length: int | None = None
    while line := stream.readline(LINE):
        name, _, value = line.partition(b":")
        if line.strip():
            if name.strip().lower() == LENGTH and length is None:
                length = _number(value)
        elif length is not None:
            if length <= MOST:
                data = stream.read(length)
                return data if len(data) == length else None
            _skip(stream, length)
            length = None
    return None


def _number(text: bytes) -> int | None:
    """The length that a header announces."""
    digits = text.strip()
    if digits.isdigit() and len(digits) <= DIGITS:
        return int(digits)
    LOG.error("a Content-Length of other than 1 to %d digits: its message is lost", DIGITS)
    return None


def _skip(stream: BinaryIO, length: int) -> None:
    """Read over a body, in pieces."""
    LOG.error("a message of %d MB is not read: the longest has %d", length // 10**6, MOST // 10**6)
    while length and (piece := stream.read(min(length, PIECE))):
        length -= len(piece)


def answer(server: LanguageServer, data: bytes) -> None:
    """Answer a message; one that cannot be understood with an error, if it is a request."""
    request: Any = None
    try:
        message = _decoded(data)
        request = message.get("id") if "method" in message else None
        server.protocol.handle_message(_structured(server, message))
    except JsonRpcException as fault:
        LOG.error("%s", fault)
        if request is not None or isinstance(fault, JsonRpcParseError | JsonRpcInvalidRequest):
            server.protocol._send_response(request, error=fault.to_response_error())
    except (TypeError, ValueError, RecursionError) as fault:  # of the library, at odd parameters
        LOG.error("what was sent cannot be answered: %s", fault)


def _decoded(data: bytes) -> dict[str, Any]:
    """A message as JSON, as far as every message is alike."""
    try:
        found = json.loads(data)
    except (ValueError, RecursionError) as fault:
        raise JsonRpcParseError(f"what was sent is no JSON: {fault}") from None
    if not isinstance(found, dict) or found.get("jsonrpc") != "2.0":
        raise JsonRpcInvalidRequest("what was sent is no message of JSON-RPC 2.0")
    number = found.get("id", 0)
    if isinstance(number, bool) or not isinstance(number, int | str):
        raise JsonRpcInvalidRequest("the id of a message is an integer or a text")
    if not isinstance(found.get("method", ""), str):
        raise JsonRpcInvalidRequest("the method of a message is a text")
    return found


def _structured(server: LanguageServer, message: dict[str, Any]) -> Any:
    """A message of its type; raises JsonRpcException where its parameters are not those."""
    try:
        return server.protocol.structure_message(message)
    except JsonRpcException as fault:
        name = str(message.get("method", "an answer"))
        raise type(fault)(f"{name}: not the parameters of that method") from None
