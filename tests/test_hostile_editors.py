"""Attacks on the promises of docs/security.md: what an editor, or who speaks for it, may send."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("pygls.lsp.server", reason="the extra [lsp] is not installed")

from adamslite.editing import stream

DECK = "a\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\nEND\n"
URI, AT = "file:///nowhere/a.adm", {"line": 2, "character": 2}
ALIVE, WAIT = 99, 60


def message(content: Any) -> bytes:
    data = content if isinstance(content, bytes) else json.dumps(content).encode()
    return b"Content-Length: %d\r\n\r\n" % len(data) + data


def sent(method: str, number: Any = None, **params: Any) -> bytes:
    found = {"jsonrpc": "2.0", "method": method, "params": params}
    return message(found if number is None else found | {"id": number})


def opened(uri: str) -> bytes:
    document = {"uri": uri, "languageId": "adams", "version": 1, "text": DECK}
    return sent("textDocument/didOpen", textDocument=document)


def hover(number: Any, uri: str = URI, position: Any = AT) -> bytes:
    return sent("textDocument/hover", number, textDocument={"uri": uri}, position=position)


START = (
    sent("initialize", 1, processId=None, rootUri=None, capabilities={})
    + sent("initialized")
    + opened(URI)
)


def received(data: bytes) -> Iterator[dict[str, Any]]:
    reader = BytesIO(data)
    while (body := stream.body(reader)) is not None:
        yield json.loads(body)


def answers(content: bytes) -> dict[Any, dict[str, Any]]:
    """What a server replies to each request, behind what an editor sends at first and before a
    harmless request, which is answered whatever came before; nothing of it is a traceback.
    """
    end = sent("shutdown", 100) + sent("exit")
    done = subprocess.run(
        [sys.executable, "-m", "adamslite", "lsp"], input=START + content + hover(ALIVE) + end,
        capture_output=True, timeout=WAIT, check=False,
    )  # fmt: skip
    assert done.returncode == 0 and b"Traceback" not in done.stderr + done.stdout, done.stderr
    assert all(line.startswith(b"adamslite: ") for line in done.stderr.splitlines()), done.stderr
    found = {each.get("id"): each for each in received(done.stdout) if "method" not in each}
    assert "PART" in found[ALIVE]["result"]["contents"]["value"]
    return found


# ---- headers and bodies --------------------------------------------------------------------------

GOOD = message(b"{}")
HEADERS = [
    b"Content-Length: -5\r\n\r\n", b"Content-Length: 1e3\r\n\r\n", b"Content-Length:\r\n\r\n",
    b"Content-Type: x\r\n\r\n", b"\r\n\r\n\n", b"A" * 100_000 + b"\r\n\r\n",
    b"Content-Length: " + b"9" * 5000 + b"\r\n\r\n", b"\x00\xff:\r\n", b":::\r\n\r\n",
]  # fmt: skip


@pytest.mark.parametrize("header", HEADERS, ids=lambda header: repr(header[:18]))
def test_the_message_behind_a_header_without_a_length_is_read(header: bytes) -> None:
    reader = BytesIO(header + GOOD)
    assert stream.body(reader) == b"{}" and stream.body(reader) is None


@pytest.mark.parametrize(
    "header",
    [b"content-length:2\n\n", b"X: 1\r\nCONTENT-LENGTH : 2\r\nContent-Length: 900\r\n\r\n"],
)
def test_a_header_is_known_however_it_is_written(header: bytes) -> None:
    assert stream.body(BytesIO(header + b"{}")) == b"{}"


def test_a_message_that_is_too_long_is_read_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """In pieces: it takes no memory, however much is announced."""
    monkeypatch.setattr(stream, "MOST", 100)
    monkeypatch.setattr(stream, "PIECE", 7)
    reader = BytesIO(message(b"x" * 101) + GOOD)
    assert stream.body(reader) == b"{}"
    for length in (10**9, 10**12):
        assert stream.body(BytesIO(b"Content-Length: %d\r\n\r\n{}" % length)) is None


@pytest.mark.parametrize("rest", [b"", b"Content-Le", b"Content-Length: 5\r\n\r\n{"])
def test_an_editor_that_goes_in_the_middle_ends_the_server(rest: bytes) -> None:
    assert stream.body(BytesIO(rest)) is None


# ---- the server answers whatever came before -----------------------------------------------------


def test_wrong_requests_are_answered_with_their_error() -> None:
    """The client would wait for ever for the answer to a request that is passed over."""
    wrong = [-1, 1e300, 1.5e10, None, [], {}, 2**64]
    places = [{"line": each, "character": 0} for each in wrong]
    requests = [hover(number, position=place) for number, place in enumerate(places, 2)]
    odd = [message({"jsonrpc": "2.0", "id": 50, "method": 7}), sent("no/such", 51)]
    deep = b'{"jsonrpc": "2.0", "id": 52, "method": "textDocument/hover", "params": %s1%s}'
    odd.append(message(deep % (b"[" * 400, b"]" * 400)))
    found = answers(b"".join([*requests, *odd]))
    numbers = [*range(2, 2 + len(wrong)), 52]
    assert {found[number]["error"]["code"] for number in numbers} == {-32602}
    assert found[51]["error"]["code"] == -32601 and found[None]["error"]["code"] == -32600


@pytest.mark.parametrize(
    "content",
    [b"[" * 200_000, b'{"a":' * 100_000, b"5", b"[]", b"\xff", b'{"jsonrpc": 7}', b"9" * 10_000],
    ids=["list", "object", "number", "batch", "bytes", "version", "digits"],
)
def test_what_is_no_message_has_the_answer_that_json_rpc_demands(content: bytes) -> None:
    replies: list[Any] = []

    class Server:
        class protocol:  # noqa: N801
            @staticmethod
            def _send_response(number: Any, error: Any) -> None:
                replies.append((number, error.code))

    stream.answer(Server, content)  # type: ignore[arg-type]
    assert replies in ([(None, -32700)], [(None, -32600)])


def test_ids_and_odd_notifications_do_no_harm() -> None:
    ids = [None, True, 1.5, [], {}, float("nan"), "\ud800", "x" * 10_000, -1, 10**400]
    odd = [
        message({"jsonrpc": "2.0", "method": "textDocument/hover", "id": each, "params": {}})
        for each in ids
    ]
    odd += [sent("$/cancelRequest", id=[]), sent("$/cancelRequest", id=7), sent("x/y\x1b[2J")]
    document = {"uri": URI, "version": 2}
    far = {"start": {"line": 9, "character": 10**9}, "end": {"line": 0, "character": 0}}
    for text, place in (("\udfff", far), ("! \ud83d\x00", far)):
        change = {"range": place, "text": text}
        odd.append(sent("textDocument/didChange", textDocument=document, contentChanges=[change]))
    found = answers(b"".join(odd) + opened(URI))
    assert found["x" * 10_000]["error"]["code"] == found[-1]["error"]["code"] == -32602


def test_an_editor_that_leaves_early_is_no_fault() -> None:
    for end in (b"", sent("exit"), b"Content-Length: 500\r\n\r\n{"):
        done = subprocess.run(
            [sys.executable, "-m", "adamslite", "lsp"], input=START + end,
            capture_output=True, timeout=WAIT, check=False,
        )  # fmt: skip
        assert (done.returncode, done.stderr) == (0, b"")


# ---- files ---------------------------------------------------------------------------------------

PLACES = [
    "file:///etc/passwd", "file:///../../etc/passwd", "file:///%2e%2e/%2e%2e/etc/passwd", "",
    "file://server/share/x.adm", "file:////server/share/x.adm", "file:///dev/zero", "x",
    "file:///proc/self/environ", "http://x/y.adm", "file://[::1/x.adm", "file:///a%00b.adm",
    f"file:///{'a' * 5000}.adm", "\ud800", "file:///nowhere/b.acf",
]  # fmt: skip


def test_a_file_that_is_not_open_is_not_read(tmp_path: Path) -> None:
    """Unless it is the deck of an open command file, or the other way round."""
    (tmp_path / "other.adm").write_text(DECK)
    (tmp_path / "c.adm").write_text(DECK)
    places = [*PLACES, (tmp_path / "other.adm").as_uri()]
    requests = [hover(number, uri) for number, uri in enumerate(places, 2)]
    beside = opened((tmp_path / "c.acf").as_uri()) + hover(200, (tmp_path / "c.adm").as_uri())
    found = answers(b"".join(requests) + beside)
    for number in range(2, 2 + len(places)):
        assert re.search("is not open$", found[number]["error"]["message"])
    assert found[200]["result"]["contents"]["value"]


def test_texts_may_be_open_under_any_name() -> None:
    names = [uri for uri in PLACES if not re.search("%00|\\[", uri)]  # which are none
    found = answers(b"".join(opened(uri) + hover(n, uri) for n, uri in enumerate(names, 2)))
    references = {n: found[n] for n in range(2, 2 + len(names))}
    assert all("result" in each for each in references.values()), references
