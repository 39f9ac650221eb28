"""The language server, driven by a client over standard input and output."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from lsp_client import Client, place

from adamslite.editing.completion import completion
from adamslite.editing.document import Document
from adamslite.editing.hover import hover

DECK = """\
a pendulum
PART/1, GROUND
MARKER/1, PART=1, QP=0,-1,0
!   adams_view_name='bob'
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2, QP=0,-1,0
JOINT/1, REVOLUTE, I=2, J=1
VARIABLE/Δx, FUNCTION=DX(2,1)
REQUEST/1, F2=Δx\\ F3=STEP(TIME,0,0,1,1)
END
"""
LINES = DECK.split("\n")
URI = "file:///nowhere/pendulum.adm"


def around(word: str, number: int = 0) -> tuple[int, int]:
    """Line and column, from 0, of a word in the deck."""
    before = DECK.split(word)
    start = len(word.join(before[: number + 1]))
    line = DECK.count("\n", 0, start)
    return line, start - len("\n".join(LINES[:line])) - (line > 0)


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    pytest.importorskip("pygls.lsp.server", reason="the extra [lsp] is not installed")
    with Client() as found:
        assert found.open(URI, DECK) == []
        yield found


def test_messages_come_while_typing(client: Client) -> None:
    uri = "file:///nowhere/typing.adm"
    assert client.open(uri, DECK) == []
    line, column = around("REVOLUTE")
    client.edit(uri, 2, (line, column, line, column + 8, "REVOLVE"))
    (told,) = client.messages(uri, 2)
    assert (told["code"], told["severity"], told["source"]) == ("unknown-argument", 1, "adamslite")
    assert told["range"] == {"start": place(line, column), "end": place(line, column + 7)}
    (action,) = client.request(
        "textDocument/codeAction",
        textDocument={"uri": uri}, range=told["range"], context={"diagnostics": []},
    )  # fmt: skip
    assert action["title"] == "write REVOLUTE"
    assert action["edit"]["changes"][uri] == [{"range": told["range"], "newText": "REVOLUTE"}]
    client.edit(
        uri, 3, (line, column, line, column + 7, "REVOLUTE"), (2, 0, 2, 0, "PART/1, GROUND\n")
    )
    (told,) = client.messages(uri, 3)
    assert told["code"] == "duplicate-id" and told["range"]["start"]["line"] == 2
    (first,) = told["relatedInformation"]
    assert first["location"]["range"]["start"] == place(1, 0)


def test_advice_comes_later_and_stays_where_it_is(client: Client) -> None:
    """What takes an assembly of the model is not waited for; edits elsewhere move it along."""
    uri = "file:///nowhere/advice.adm"
    apart = DECK.replace("QP=0,-1,0\nJOINT", "QP=0,-2,0\nJOINT")
    assert client.open(uri, apart) == []
    (told,) = client.messages(uri, 1)
    assert told["code"] == "starts-apart" and told["range"]["start"]["line"] == 6
    client.edit(uri, 2, (2, 0, 2, 0, "! a comment\n"))
    (told,) = client.messages(uri, 2)
    assert told["code"] == "starts-apart" and told["range"]["start"]["line"] == 7
    client.edit(uri, 3, (6, 23, 6, 25, "-1"))
    client.messages(uri, 3)
    assert client.messages(uri, 3) == []


def test_hover_is_the_page(client: Client) -> None:
    found = client.at("hover", URI, *around("JOINT"))
    assert found["contents"]["value"].startswith("## JOINT")
    line, column = around("STEP")
    found = client.at("hover", URI, line, column)
    assert "STEP(x, x0, h0, x1, h1)" in found["contents"]["value"]
    assert found["range"] == {"start": place(line, column), "end": place(line, column + 4)}


def test_completion(client: Client) -> None:
    line, column = around("2, J=1")
    found = client.at("completion", URI, line, column)
    assert {each["label"] for each in found["items"]} == {"1", "2"}


def test_definition_and_references(client: Client) -> None:
    line, column = around("I=2")
    (found,) = client.at("definition", URI, line, column + 2)
    assert found == {"uri": URI, "range": {"start": place(5, 7), "end": place(5, 8)}}
    found = client.at("references", URI, line, column + 2, context={"includeDeclaration": True})
    assert [each["range"]["start"] for each in found] == [
        place(5, 7), place(4, 19), place(6, 21 + 0), place(7, 25)
    ]  # fmt: skip


def test_rename(client: Client) -> None:
    line, column = around("Δx,")
    found = client.at("rename", URI, line, column, newName="offset")
    text = list(LINES)
    for edit in reversed(found["changes"][URI]):
        start, end = edit["range"]["start"], edit["range"]["end"]
        row = text[start["line"]]
        text[start["line"]] = row[: start["character"]] + edit["newText"] + row[end["character"] :]
    assert "\n".join(text) == DECK.replace("Δx", "offset")
    with pytest.raises(RuntimeError, match="always means something else"):
        client.at("rename", URI, line, column, newName="TIME")


def test_symbols_and_layout(client: Client) -> None:
    found = client.request("textDocument/documentSymbol", textDocument={"uri": URI})
    labels = [(each["name"], each.get("detail")) for each in found]
    assert labels[2] == ("PART/2", "bob") and len(labels) == 8
    options = {"tabSize": 2, "insertSpaces": True}
    args: dict[str, Any] = {"textDocument": {"uri": URI}, "options": options}
    assert client.request("textDocument/formatting", **args) == []
    uri = "file:///nowhere/loose.adm"
    client.open(uri, DECK.replace("I=2, J=1", "I = 2,J=1"))
    args["textDocument"] = {"uri": uri}
    (edit,) = client.request("textDocument/formatting", **args)
    assert edit["newText"] == LINES[6] + "\n"
    assert edit["range"] == {"start": place(6, 0), "end": place(7, 0)}


def test_columns_are_counted_in_units_of_utf_16(client: Client) -> None:
    uri = "file:///nowhere/wide.adm"
    (told,) = client.open(uri, DECK.replace("a pendulum\n", "a\n").replace(
        "VARIABLE/Δx, FUNCTION=DX(2,1)", 'VARIABLE/Δx, FUNCTION=DX(2,1)+"𝄞"+nobody'
    ))[:1]  # fmt: skip
    assert told["range"]["start"]["line"] == 7


@pytest.mark.parametrize("name", ["two%20words", "d%C3%A9j%C3%A0", "c%3A/Users/deck", "50%25"])
def test_an_editor_may_write_letters_of_a_name_as_numbers(client: Client, name: str) -> None:
    """As VS Code does with blanks, and with the colon of a drive of Windows."""
    uri = f"file:///nowhere/{name}.adm"
    (told,) = client.open(uri, DECK.replace("REVOLUTE", "REVOLVE"))
    assert told["code"] == "unknown-argument"
    client.edit(uri, 2, (6, 0, 7, 0, ""))
    assert client.messages(uri, 2) == []
    assert client.at("hover", uri, 4, 2)["contents"]["value"].startswith("## PART")


def test_a_command_file_knows_its_deck(client: Client, tmp_path: Path) -> None:
    (tmp_path / "run.adm").write_text(DECK, encoding="utf-8")
    deck, commands = ((tmp_path / f"run.{suffix}").as_uri() for suffix in ("adm", "acf"))
    text = "DEACTIVATE/JOINT, ID=1\nVARIABLE/Δx, FUNCTION=2\nVARIABLE/9, FUNCTION=2\n"
    told = client.open(commands, text)
    assert [(each["code"], each["range"]["start"]["line"]) for each in told] == [
        ("missing-reference", 2)
    ]
    (found,) = client.at("definition", commands, 1, 10)
    assert found["uri"] == deck and found["range"]["start"]["line"] == 7
    with pytest.raises(RuntimeError, match="first correct"):
        client.at("rename", commands, 0, 21, newName="7")
    client.edit(commands, 2, (2, 0, 3, 0, ""))
    found = client.at("rename", commands, 0, 21, newName="7")
    assert {uri: len(edits) for uri, edits in found["changes"].items()} == {deck: 1, commands: 1}


def test_without_pygls_one_sentence_says_what_is_missing(tmp_path: Path) -> None:
    hide = "import sys; sys.modules['pygls'] = None\n"
    run = "from adamslite.cli.main import main; sys.exit(main(['lsp']))"
    done = subprocess.run([sys.executable, "-c", hide + run], capture_output=True, text=True)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr == (
        "adamslite: the language server needs pygls 2: pip install 'adamslite[lsp]'\n"
    )


# ---- the same without a server -------------------------------------------------------------------

WRITTEN = [
    ("", ["PART", "JOINT", "VARIABLE", "END"], ["SAVE"]),
    ("JO", ["JOINT", "PART"], ["STEP"]),
    ("JOINT/1, ", ["REVOLUTE", "I", "J"], ["STEP", "PART"]),
    ("JOINT/1, REVOLUTE, I=", ["1", "2"], ["I", "J"]),
    ("JOINT/1, REVOLUTE, I=1, ", ["J"], ["I"]),
    ("VARIABLE/5, FUNCTION=", ["STEP", "DX", "TIME", "Δx", "PI"], ["1"]),
    ("VARIABLE/5, FUNCTION=2*DX(", ["1", "2"], ["STEP"]),
    ("VARIABLE/5, FUNCTION=2*DX(2,", ["1", "2"], ["STEP"]),
    ("VARIABLE/5, FUNCTION=VARVAL(", ["Δx"], ["1"]),
    ("VARIABLE/5, FUNCTION=STEP(", ["TIME", "DX"], ["1"]),
    ("VFORCE/5, I=2, FX=1\\ ", ["FY", "FZ"], ["FX", "STEP"]),
    ("VFORCE/5, I=2, FX=1\\\n, FY=DX(2)\\\n, ", ["FZ", "J_PART"], ["FX", "FY"]),
    ("UNITS/", ["SYSTEM", "FORCE"], ["STEP"]),
    ("UNITS/SYSTEM=", ["MKS", "CGS"], ["SYSTEM"]),
    ("REQUEST/1, VARIABLES=Δx,", ["Δx", "COMMENT"], ["1"]),
    ("PART/5 ! adamslite: ignore ", ["no-inertia"], ["missing-value"]),
    ("PART/5 ! ", [], ["MASS"]),
    ("JOINT/", [], ["REVOLUTE"]),
]


@pytest.mark.parametrize(("written", "offered", "other"), WRITTEN)
def test_what_is_offered(written: str, offered: list[str], other: list[str]) -> None:
    text = DECK.replace("END\n", written + "\nEND\n")
    content = Document("x.adm", "deck").update(text)
    words = {
        each.word for each in completion(content, text.rindex(written + "\nEND") + len(written))
    }
    assert words >= set(offered)
    assert not words & set(other)


PAGES = [
    ("MASS=1", "`MASS` (`M`, `MA`): mass"),
    ("REVOLUTE", "a type of joint"),
    ("2,1)", "MARKER/2, PART=2, QP=0,-1,0"),
    ("Δx\\", "VARIABLE/Δx, FUNCTION=DX(2,1)"),
    ("DX(", "### `DX("),
    ("PART/2", "## PART"),
]


@pytest.mark.parametrize(("word", "page"), PAGES)
def test_the_page_of_a_word(word: str, page: str) -> None:
    content = Document("x.adm", "deck").update(DECK)
    found = hover(content, DECK.index(word))
    assert found and page in found[0]


def test_the_page_of_a_message_in_a_comment() -> None:
    text = DECK.replace("IP=1,1,1", "IP=1,1,1 ! adamslite: ignore no-inertia")
    found = hover(Document("x.adm", "deck").update(text), text.index("no-inertia") + 3)
    assert found and found[0].startswith("## `no-inertia`")


@pytest.mark.parametrize(
    "sent",
    [b"[" * 200_000, b"{", b"\xff\xfe", b'{"jsonrpc": 7}'],
    ids=["deep", "open", "no text", "no version"],  # else a name is a variable of 200 kB
)
def test_what_is_no_message_is_reported_without_a_traceback(sent: bytes) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "adamslite", "lsp"], capture_output=True, check=False,
        input=b"Content-Length: %d\r\n\r\n%s" % (len(sent), sent),
    )  # fmt: skip
    assert done.returncode == 0 and b"Traceback" not in done.stderr, done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_ends_the_server_while_the_editor_is_silent(name: str) -> None:
    """It reads standard input then, which nothing else ends."""
    client = Client()
    client.request("initialize", processId=None, rootUri=None, capabilities={})
    client.process.send_signal(getattr(signal, name))
    assert client.process.wait(30) == 4
    client.listener.join()
