"""Attacks on the promises of docs/security.md: a deck, and what lies beside it, runs no code and
reads nothing outside its folder.
"""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from decklets import told
from scenes import SPRING

import adamslite as al
from adamslite.cables.description.toml_places import MOST_OPENED, excess_of
from adamslite.language.file_name import OPENED, inside

UNIX = pytest.mark.skipif(os.name == "nt", reason="links and pipes of Unix")
COMMAND = "import sys; from adamslite.cli.main import main; sys.exit(main())"
TABLE = "0, 0\n1, 1\n2, 4\n3, 9\n"


def command(folder: Path, *words: str, code: str = COMMAND) -> subprocess.CompletedProcess[str]:
    """The command line in a folder, as an installed program, which finds no modules there."""
    return subprocess.run(
        [sys.executable, "-P", "-c", code, *words], cwd=folder, capture_output=True, text=True,
        encoding="utf-8", timeout=300,
        env={**os.environ, "PYTHONPATH": str(Path(al.__file__).parents[1])},
    )  # fmt: skip


def spline(name: str) -> str:
    """A deck that takes a table from a file."""
    law = f'SPLINE/1, FILE="{name}"\nVARIABLE/1, FUNCTION=AKISPL(TIME, 0, 1)\n'
    return SPRING.replace("END\n", f"{law}END\n")


# ---- files outside of the folder ----------------------------------------------------------------


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder beside that of the deck, with a table that nobody may learn of."""
    folder = tmp_path / "secret"
    folder.mkdir()
    (folder / "table.csv").write_text(TABLE)
    (tmp_path / "deck").mkdir()
    return folder


def messages(folder: Path, text: str) -> str:
    """What is said about a deck in a folder."""
    path = folder / "deck.adm"
    path.write_text(text)
    return str(al.check(path))


@pytest.mark.parametrize("way", ["../secret/table.csv", "x/../../secret/table.csv", "absolute"])
def test_a_table_elsewhere_is_not_read(way: str, elsewhere: Path) -> None:
    name = str(elsewhere / "table.csv") if way == "absolute" else way
    assert "not in the folder of the deck" in messages(elsewhere.parent / "deck", spline(name))


@UNIX
@pytest.mark.parametrize("link", ["file", "folder"])
def test_a_link_to_a_table_elsewhere_is_not_followed(link: str, elsewhere: Path) -> None:
    folder = elsewhere.parent / "deck"
    if link == "file":
        (folder / "table.csv").symlink_to(elsewhere / "table.csv")
    else:
        (folder / "tables").symlink_to(elsewhere)
    name = "table.csv" if link == "file" else "tables/table.csv"
    assert "not in the folder of the deck" in messages(folder, spline(name))


@UNIX
@pytest.mark.parametrize("trap", ["pipe", "zeros", "itself"])
def test_what_has_no_end_beside_a_deck_is_not_read(trap: str, tmp_path: Path) -> None:
    """A pipe that nobody writes to, a device, a link to itself."""
    place = tmp_path / "table.csv"
    if trap == "pipe":
        os.mkfifo(place)
    else:
        place.symlink_to("/dev/zero" if trap == "zeros" else place)
    assert "SPLINE/1 cannot use table.csv" in messages(tmp_path, spline("table.csv"))


@pytest.mark.parametrize("name", [r"\\host\share\table.csv", "//host/share/table.csv"])
def test_no_other_machine_is_asked(name: str, tmp_path: Path, monkeypatch) -> None:
    """Windows would send it the name of the user: such a name is refused before any look at it."""
    asked: list[Path] = []
    resolve = Path.resolve
    monkeypatch.setattr(Path, "resolve", lambda path: asked.append(path) or resolve(path))
    found = inside(tmp_path, name)
    assert found is None or found.is_relative_to(tmp_path.resolve())
    assert all("host" not in path.parts for path in asked)


def test_the_user_opens_another_folder(elsewhere: Path) -> None:
    folder = elsewhere.parent / "deck"
    (folder / "deck.adm").write_text(spline("../secret/table.csv"))
    closed = command(folder, "check", "deck.adm")
    assert closed.returncode == 3 and "nor in one that --allow-path opens" in closed.stdout
    opened = command(folder, "check", "deck.adm", "--allow-path", "../secret")
    assert opened.returncode == 0
    other = command(folder, "check", "deck.adm", "--allow-path", ".")
    assert other.returncode == 3


def test_python_opens_another_folder(elsewhere: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(OPENED, "")
    folder = elsewhere.parent / "deck"
    assert "adamslite.allow_path" in messages(folder, spline("../secret/table.csv"))
    al.allow_path(elsewhere)
    assert "cannot use" not in messages(folder, spline("../secret/table.csv"))


@UNIX
def test_a_command_file_that_is_a_link_to_elsewhere_is_not_taken_by_itself(elsewhere: Path) -> None:
    (elsewhere / "notes").write_text("the password is sesame\n")
    folder = elsewhere.parent / "deck"
    (folder / "deck.adm").write_text(SPRING)
    (folder / "deck.acf").symlink_to(elsewhere / "notes")
    for verb in ("check", "solve"):
        ran = command(folder, verb, "deck.adm")
        assert ran.returncode == 2 and "leads out of its folder; name it" in ran.stderr
        assert "sesame" not in ran.stdout + ran.stderr


def test_results_of_others_keep_no_place_for_their_deck(elsewhere: Path) -> None:
    """The name of a deck in a file of results leads nowhere, nor do names of tables in it."""
    from adamslite.results.run_texts import restored

    told_of = {"deck": spline("table.csv"), "deck_name": str(elsewhere / "deck.adm")}
    source = restored(told_of)["source"]
    assert source.name == "deck.adm"
    with pytest.raises(al.DeckError, match="SPLINE/1 cannot use table.csv"):
        source.read()
    tables = {"deck_name": "..", "tables": '{"../../../escaped.csv": "0,0", "table.csv": "0,0"}'}
    source = restored({**told_of, **tables})["source"]
    assert source.stem == "results"
    with pytest.raises(al.DeckError):
        source.read()
    assert not [*elsewhere.parent.rglob("escaped.csv")]


# ---- code ---------------------------------------------------------------------------------------

MARK = "open('ran', 'w', encoding='utf-8').close()\n"
CALLS = SPRING.replace("END\n", "VARIABLE/1, FUNCTION=USER(1)\nEND\n")


def test_no_module_beside_a_deck_is_loaded(tmp_path: Path) -> None:
    """Under the names of what the program imports, and of what the deck calls."""
    (tmp_path / "deck.adm").write_text(CALLS)
    for name in ("numpy", "scipy", "lark", "json", "typing", "VARSUB", "user", "rich", "orjson"):
        (tmp_path / f"{name}.py").write_text(MARK)
    assert command(tmp_path, "check", "deck.adm").returncode == 3
    assert command(tmp_path, "check", "deck.adm", "--user", "VARSUB=0").returncode == 0
    assert not (tmp_path / "ran").exists()


def test_no_package_is_loaded_unless_the_user_says_so(tmp_path: Path) -> None:
    """An installed package offers what the deck calls."""
    folder = tmp_path / "installed"
    (folder / "offer-1.dist-info").mkdir(parents=True)
    (folder / "offer-1.dist-info" / "entry_points.txt").write_text(
        "[adamslite.user]\nVARSUB = offer:one\n"
    )
    (folder / "offer-1.dist-info" / "METADATA").write_text("Name: offer\nVersion: 1\n")
    (folder / "offer.py").write_text(MARK + "def one(parameters, time):\n    return 1.0\n")
    (tmp_path / "deck.adm").write_text(CALLS)
    code = f"import sys; sys.path.append({str(folder)!r})\n{COMMAND}"
    alone = command(tmp_path, "check", "deck.adm", code=code)
    assert alone.returncode == 3 and "--user VARSUB=installed" in alone.stdout
    assert not (tmp_path / "ran").exists()
    said = command(tmp_path, "check", "deck.adm", "--user", "VARSUB=installed", code=code)
    assert said.returncode == 0 and (tmp_path / "ran").exists()


def test_a_reference_beside_a_deck_binds_numbers_only(tmp_path: Path) -> None:
    (tmp_path / "deck.adm").write_text(CALLS)
    (tmp_path / "reference.csv").write_text(
        "# tolerance: abs 1\n# solve: --end 0.1 --user VARSUB=trap:law\ntime,VARIABLE/1\n0,1\n"
    )
    (tmp_path / "trap.py").write_text(MARK + "def law(parameters, time):\n    return 1.0\n")
    ran = command(tmp_path, "verify", ".")
    assert ran.returncode == 1 and "a reference binds numbers only" in ran.stdout
    assert not (tmp_path / "ran").exists()


def test_results_of_others_bind_numbers_only() -> None:
    from adamslite.results.run_texts import restored

    bound = '["VARSUB=trap:law", "VARSUB=installed", "VARIABLE/1=2"]'
    assert restored({"deck": CALLS, "user": bound})["source"].user == ("VARIABLE/1=2",)


@pytest.mark.slow  # it starts processes anew
def test_processes_of_workers_load_no_module_beside_a_deck(tmp_path: Path) -> None:
    """As they are started where processes are not forked."""
    (tmp_path / "deck.adm").write_text(SPRING)
    for name in ("multiprocessing", "pickle", "runpy", "struct"):
        (tmp_path / f"{name}.py").write_text(MARK)
    code = textwrap.dedent("""\
        import multiprocessing, sys
        from adamslite.sweeps import workers
        workers._context = lambda: multiprocessing.get_context("spawn")
        workers.LOT = workers.SHORT = 0.0
        from adamslite.cli.main import main
        if __name__ == "__main__":
            sys.exit(main())
        """)
    program = tmp_path.parent / "program.py"
    program.write_text(code)
    words = ["sweep", "deck.adm", "SPRINGDAMPER/1.K=50:100:40", "--end", "0.1", "--steps", "2",
             "--measure", "max POINT_MASS/2.z", "--workers", "2"]  # fmt: skip
    ran = subprocess.run(
        [sys.executable, str(program), *words], cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(Path(al.__file__).parents[1])},
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    assert not (tmp_path / "ran").exists()


@pytest.mark.slow  # it draws
def test_settings_of_matplotlib_beside_results_are_not_taken(tmp_path: Path) -> None:
    """Older ones are evaluated, `text.usetex` would have titles run by TeX."""
    (tmp_path / "a.csv").write_text("time,x\n0,0\n1,1\n")
    (tmp_path / "matplotlibrc").write_text(
        "text.usetex: True\nlines.linewidth: 77\nno.such.setting: 1\n"
    )
    ran = command(tmp_path, "plot", "a.csv", "x", "-o", "a.png")
    assert ran.returncode == 0 and "no.such.setting" not in ran.stderr


# ---- terminals ----------------------------------------------------------------------------------

ESCAPE, TITLE, TURN, CSI = "\x1b[2J", "\x1b]0;owned\x07", "\u202e", "\x9b31m"
EVERY = ESCAPE + TITLE + TURN + CSI
PLACES = {
    "title": f"{EVERY}\n{SPRING.partition(chr(10))[2]}",
    "comment": SPRING.replace("END\n", f"! {EVERY}\nEND {EVERY}\n"),
    "statement": SPRING.replace("END\n", f"{EVERY}/1, X={EVERY}\nEND\n"),
    "id": SPRING.replace("END\n", f'PART/"{EVERY}", MASS=1\nEND\n'),
    "function": SPRING.replace("END\n", f"VARIABLE/1, FUNCTION={EVERY}(1)+{EVERY}\nEND\n"),
    "file": spline(f"{EVERY}.csv"),
    "text": SPRING.replace(
        "END\n", f'REQUEST/1, F2=TIME, TITLE="{EVERY}", CNAMES="{EVERY}"\nEND\n'
    ),
}


def obeyed(text: str) -> list[str]:
    """What a terminal would take for a command."""
    return [each for each in text if not each.isprintable() and each not in "\n\t "]


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("form", ["text", "gcc", "json", "sarif"])
def test_a_terminal_gets_no_command_of_a_deck(place: str, form: str, tmp_path: Path) -> None:
    (tmp_path / "deck.adm").write_text(PLACES[place], encoding="utf-8")
    ran = command(tmp_path, "check", "deck.adm", "--format", form)
    assert ran.returncode in (0, 3)
    assert obeyed(ran.stdout + ran.stderr) == []


@pytest.mark.parametrize("place", PLACES)
def test_messages_in_python_hold_no_command_for_a_terminal(place: str) -> None:
    for each in told(PLACES[place]):
        texts = (each.render(), each.message, each.hint, each.source_line)
        assert obeyed("".join(texts)) == []


def test_a_message_keeps_its_places() -> None:
    """Each character that is shown stands for one of the deck."""
    message = next(each for each in told(PLACES["id"]) if each.code == "bad-id")
    line, carets = message.render().splitlines()[1:3]
    assert carets.index("^") == line.index('"') and carets.count("^") == len(EVERY) + 2


@UNIX
def test_names_of_files_give_a_terminal_no_command(tmp_path: Path) -> None:
    name = f"{ESCAPE}.adm"
    (tmp_path / name).write_text(PLACES["id"], encoding="utf-8")
    for words in (["check", name], ["solve", name], ["check", f"{TURN}.adm"], ["view", name]):
        ran = command(tmp_path, *words)
        assert obeyed(ran.stdout + ran.stderr) == []


@UNIX
@pytest.mark.parametrize("words", [["solve", "--{}"], ["cache", "{}"], ["{}"], ["diff", "--to={}"]])
def test_words_of_a_command_line_give_a_terminal_no_command(tmp_path: Path, words) -> None:
    """A script may take them from the names of files that somebody else has made."""
    ran = command(tmp_path, *(word.format(EVERY) for word in words))
    assert ran.returncode == 2 and obeyed(ran.stdout + ran.stderr) == []


def test_tables_and_summaries_give_a_terminal_no_command(tmp_path: Path) -> None:
    (tmp_path / "deck.adm").write_text(PLACES["text"], encoding="utf-8")
    header = (
        f"# deck: {EVERY}\n# outcome: STALLED {EVERY}\ntime,{EVERY},b [{EVERY}]\n0,1,2\n1,2,3\n"
    )
    (tmp_path / "a.csv").write_text(header, encoding="utf-8")
    (tmp_path / "b.csv").write_text(header.replace("1,2,3", "1,3,3"), encoding="utf-8")
    for words in (
        ["solve", "deck.adm", "--end", "0.1", "--steps", "2"], ["names", "deck.adm"],
        ["diff", "a.csv", "b.csv"], ["plot", "a.csv", "nothing"],
        ["solve", "deck.adm", "--end", "0.1", "--steps", "1", "-o", "-"],
    ):  # fmt: skip
        ran = command(tmp_path, *words)
        assert "fault in the program" not in ran.stderr
        assert obeyed(ran.stdout + ran.stderr) == []


# ---- descriptions -------------------------------------------------------------------------------

DESCRIPTIONS = {
    "arrays in arrays": "a = " + "[" * 100_000,
    "tables in tables": "a = " + "{b=" * 20_000,
    "a key of many parts": "a." * 50_000 + "b = 1",
    "a table of many parts": "[a" + ".a" * 50_000 + "]",
    "quoted parts": '"a" . ' * 50_000 + "b = 1",
    "a long key": "x" * 1_000_000 + " = 1",
    "digits": "length = " + "9" * 5000,
    "infinity": "length = 1e999",
    "controls": r'title = "\u001b[2J\u202e"' + "\n[cable]\n" + r'EA = "\u001b[2J\u202e"',
}


@pytest.mark.parametrize("case", DESCRIPTIONS)
def test_a_description_of_others_ends_in_a_sentence(case: str) -> None:
    """Reading some of them took a time that grew with the square of their length: hours."""
    text = f"{DESCRIPTIONS[case]}\n"
    with pytest.raises(al.DeckError) as told_of:
        al.cable(text)
    assert obeyed(str(told_of.value)) == []


@pytest.mark.parametrize("line", ["[[cable]]", "[t{}]", "  [a.b{}.c]", "[['a,{}']] # ,"])
def test_a_description_opens_a_largest_number_of_tables(line: str) -> None:
    """Those that are one too many are not given to the parser, whatever else is wrong with them."""
    lines = [line.format(n) for n in range(MOST_OPENED + 1)]
    assert "more than 10000 tables" in excess_of("\n".join(lines))
    assert not excess_of("\n".join([*lines[1:], "a = [1]", "# ["]))
    with pytest.raises(al.DeckError) as told_of:
        al.cable("\n".join(lines))
    assert "more than 10000 tables" in str(told_of.value)


def test_a_law_may_have_any_number_of_rows() -> None:
    assert not excess_of("law = [\n" + "  [0.5, 1.0],\n" * 2 * MOST_OPENED + "]\n")


@pytest.mark.parametrize("case", DESCRIPTIONS)
def test_a_description_in_comments_of_a_deck_stops_nothing(case: str) -> None:
    lines = (f"!# {line}\n" for line in f"cable\n{DESCRIPTIONS[case]}".split("\n"))
    assert not al.check(SPRING.replace("END\n", f"{''.join(lines)}END\n")).errors


# ---- editors ------------------------------------------------------------------------------------


def test_a_hover_holds_no_markdown_of_a_deck() -> None:
    """An image in it would be fetched, and tell its server who reads."""
    from adamslite.editing.document import Document
    from adamslite.editing.hover import hover

    image = "![x](http://host/x.png)"
    text = (
        f"t\nPART/1, GROUND\n! adams_view_name='{image}`{image}'\n"
        f"PART/2, MASS=1,\n! ```\n! {image}\n"
        ", CM=2, IP=1,1,1\nMARKER/2, PART=2\nEND\n"
    )
    content = Document("t.adm", "deck").update(text)
    found = hover(content, text.index("PART=2") + len("PART="))
    assert found is not None
    name, _, shown = found[0].partition("\n\n")
    assert name == f"PART/2 is called `{image}'{image}`"
    fence = shown.partition("adams")[0]
    assert fence == "````" and shown.count(fence) == 2


@UNIX
def test_an_editor_reads_no_deck_behind_a_link(elsewhere: Path) -> None:
    """That of a command file is quoted in its messages."""
    pytest.importorskip("pygls.lsp.server", reason="the extra [lsp] is not installed")
    from adamslite.editing.server import _is_beside

    folder = elsewhere.parent / "deck"
    (folder / "a.adm").symlink_to(elsewhere / "table.csv")
    (folder / "b.adm").write_text(SPRING)
    assert not _is_beside(folder / "a.adm") and _is_beside(folder / "b.adm")
