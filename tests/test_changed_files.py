"""Files that a run reads are changed before it is resumed, or while it lasts: it is not gone on
with to other numbers.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from unfinished_runs import command, solved, until_there_is_a_state
from unfinished_scenes import pendulum, written

from adamslite.cli.main import main
from adamslite.results.results import Results

#: It runs for some seconds, pushed by a table.
END, STEPS = 2000, 20000
PUSHED = (
    pendulum(END, STEPS)
    .replace("MASS=1", "MASS={mass}", 1)
    .replace(
        "SIMULATE",
        "SPLINE/1, FILE=push.csv\n"
        "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=CUBSPL(MOD(TIME,3),0,1)\nSIMULATE",
    )
)
TABLE = "0,0\n1,{value}\n2,-1\n3,0\n"
COMMANDS = f"""\
deck.adm

RELOAD/FILE=halfway
SIMULATE/DYNAMIC, END={END + 1}, STEPS={STEPS}
STOP
"""
SAVED = "deck.adm\nother\nSIMULATE/DYNAMIC, END={end}, STEPS=2\nSAVE/FILE=halfway\nSTOP\n"


def table(folder: Path, value: float) -> None:
    (folder / "push.csv").write_text(TABLE.format(value=value))


def deck(folder: Path, mass: float) -> None:
    written(folder, PUSHED.format(mass=mass))


def saved(folder: Path, end: float) -> None:
    """What SAVE has left at another time."""
    commands = folder / "deck.acf"
    commands.write_text(SAVED.format(end=end))
    assert main(["solve", str(folder / "deck.adm"), "-o", str(folder / "y.csv"), "--quiet"]) == 0
    commands.write_text(COMMANDS)


def commands(folder: Path, end: float) -> None:
    text = f"deck.adm\nx\nSIMULATE/DYNAMIC, END={END}, STEPS={STEPS + int(end)}\n"
    (folder / "deck.acf").write_text(text)


CHANGED = {
    "a table": table,
    "the deck": deck,
    "the command file": commands,
    "the file of RELOAD": saved,
}


@pytest.mark.slow
@pytest.mark.parametrize("when", ["while it runs", "after it"])
@pytest.mark.parametrize("what", CHANGED)
def test_what_has_changed_is_not_gone_on_with(
    tmp_path: Path, what: str, when: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Put back as it was, it is: to the bytes of a run that has seen no change."""
    change = CHANGED[what]
    deck(tmp_path, 1.0)
    table(tmp_path, 1.0)
    change(tmp_path, 1.0)
    whole = solved(tmp_path / "deck.adm")
    output = tmp_path / "x.csv"
    part = Path(f"{output}.part")
    process = subprocess.Popen(
        command(str(tmp_path / "deck.adm"), "-o", str(output)),
        stderr=subprocess.PIPE, cwd=tmp_path,
    )  # fmt: skip
    states = until_there_is_a_state(process, part)
    if when == "while it runs":
        change(tmp_path, 2.0)
        until_there_is_a_state(process, part, states + 3)
    process.kill()
    process.communicate()
    change(tmp_path, 2.0)
    kept = part.read_bytes()
    capsys.readouterr()
    assert main(["solve", "--resume", str(part), "--quiet"]) == 2
    told = capsys.readouterr().err
    assert "deck, commands, tables or what RELOAD reads have changed since" in told
    assert part.read_bytes() == kept and not output.exists()
    change(tmp_path, 1.0)
    done = subprocess.run(command("--resume", str(part)), cwd=tmp_path, capture_output=True)
    assert done.returncode == 0, done.stderr
    assert output.read_bytes() == whole and not part.exists()


def test_results_hold_no_table_that_was_changed_while_they_were_computed(tmp_path: Path) -> None:
    """A page or another run that is made from them would take numbers for theirs that are not."""
    import adamslite

    deck(tmp_path, 1.0)
    table(tmp_path, 1.0)
    found = adamslite.simulate(adamslite.read(tmp_path / "deck.adm"), end=0.1, steps=2)
    found.save(tmp_path / "before.nc")
    table(tmp_path, 22.0)
    found.save(tmp_path / "after.nc")
    kept = [Results.load(tmp_path / f"{name}.nc").source for name in ("before", "after")]
    assert [source and source.tables for source in kept] == [
        (("push.csv", TABLE.format(value=1.0)),), ()
    ]  # fmt: skip
