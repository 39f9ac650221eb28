"""What is kept of a scene between runs gives what a first run gives, and never what another would.

A deck in the folder of a test is one that nothing has been kept of: its path is part of the name.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from falling_mass import falling_mass, solve
from replacing import replaced

import adamslite
from adamslite import kept_scene, resources, scene
from adamslite.analyses.setup import kept_kernels, subject
from adamslite.api import inputs
from adamslite.caching import objects
from adamslite.caching.folder import cache_folder
from adamslite.cli.main import main
from adamslite.kept_scene import origin_of
from adamslite.native import processor
from adamslite.results.results import Results

DECKS = resources.find("decks")


class Counted:
    """How often decks were read, and kernels made."""

    def __init__(self) -> None:
        self.read = self.compiled = 0


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> Counted:
    found, read_together, compiled = Counted(), scene.read_together, subject._compiled

    def read(*words):
        found.read += 1
        return read_together(*words)

    def compile_model(*words):
        found.compiled += 1
        return compiled(*words)

    for module in (scene, inputs):
        monkeypatch.setattr(module, "read_together", read)
    monkeypatch.setattr(subject, "_compiled", compile_model)
    return found


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A deck of its own in the current folder."""
    monkeypatch.chdir(tmp_path)
    return falling_mass()


# ---- the same as a first run --------------------------------------------------------------------


#: One of each kind of what a deck may hold; those with warnings, notes and command files first.
SAMPLE = """
    growing-mass-printed/growing-mass-printed paper-sforce/paper-sforce cables/pulley-slip/heavy
    hanging-mass/hanging-mass splines/driven-slide bushing/bushing bricard/bricard
    delayed-brake/delayed-brake friction/friction arrays/arrays contact/incline/incline
    pid-winch/pid-winch transfer-functions/state-equations gear-pair/gear-pair cam/cam
    beam-string/beam-string slider-crank/slider-crank user-routine/user-routine replay/pendulum
    view-crank/generic_model tackle/hoisting heavy-top/heavy-top four-bar/four-bar nforce/nforce
""".split()


def said(capsys: pytest.CaptureFixture[str]) -> tuple[str, list[str]]:
    """What a command has printed, without CPU and progress."""
    out, err = capsys.readouterr()
    passing = ("compiling ", "  CPU ")
    lines = err.splitlines()
    return out, [e for e in lines if not e.startswith(passing) and " steps/s " not in e]


def written(folder: Path) -> dict[str, list[bytes]]:
    """The lines of files; the last one of a .res has the CPU of the run, packed."""
    files = [path for path in folder.iterdir() if path.is_file()]
    return {
        path.name: [line for line in path.read_bytes().split(b"\n") if b"<!--" not in line]
        for path in files
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", SAMPLE)
def test_results_and_messages_are_those_of_a_first_run(
    name: str, tmp_path: Path, monkeypatch, capsys, counted
) -> None:
    """Byte for byte, for files and texts; decks with tables and routines are read each time."""
    source = DECKS / f"{name}.adm"
    shutil.copytree(source.parent, tmp_path / "deck")
    monkeypatch.chdir(tmp_path / "deck")
    for command in (["solve", source.name, "-o", "../out.csv"], ["check", source.name]):
        runs = []
        for _ in range(2):
            code = main(command)
            runs.append((code, said(capsys), written(tmp_path)))
        assert runs[0] == runs[1]
    kept = name not in ("user-routine/user-routine", "replay/pendulum")
    assert counted.read == (2 if kept and runs[0][0] == 0 else 4)


def test_a_second_run_reads_and_compiles_nothing(deck: Path, counted: Counted) -> None:
    assert solve(deck) == solve(deck) == pytest.approx(-10.0)
    assert (counted.read, counted.compiled) == (1, 1)


def test_a_second_check_reads_nothing(deck: Path, counted: Counted, capsys) -> None:
    replaced(deck, "J_PART=1", "J_PART=7")  # which is not there
    assert main(["check", str(deck)]) == main(["check", str(deck)]) == 3
    assert counted.read == 2 and not kept_entries(deck)
    replaced(deck, "J_PART=7", "J_PART=1")
    capsys.readouterr()
    assert main(["check", str(deck)]) == main(["check", str(deck)]) == 0
    first, second = capsys.readouterr().out.split("fall.adm: no mistakes found")[1:]
    assert first == second and counted.read == 3


def kept_entries(deck: Path) -> list[str]:
    """Which entries there are of a deck as it is."""
    origin = origin_of(deck, None)
    assert origin
    names = kept_scene._entry(origin), kept_scene._text_entry(origin, ("check", "text", "None"))
    return [name for name in names if (cache_folder() / name).exists()]


def test_formats_of_a_check_are_kept_apart(deck: Path, capsys) -> None:
    printed = []
    for form in ("text", "gcc", "json", "text", "gcc", "json"):
        assert main(["check", str(deck), "--format", form]) == 0
        printed.append(capsys.readouterr().out)
    assert printed[:3] == printed[3:] and len(set(printed)) == 3


def test_flags_of_a_run_do_not_touch_what_is_kept(deck: Path, counted: Counted) -> None:
    """An audit has more kernels; a model without a reduction has others."""
    plain = solve(deck)
    audited = solve(deck, "--audit")
    points = solve(deck, "--no-reduction", "points")
    assert solve(deck) == plain and solve(deck, "--audit") == audited
    assert solve(deck, "--no-reduction", "points") == points
    assert (counted.read, counted.compiled) == (1, 3)
    assert solve(deck, "--confirm") == plain


def test_an_audit_finds_no_kernels_without_its_own(deck: Path, counted: Counted) -> None:
    """An audit merges no parts; a run that merges none has the same model and fewer kernels."""
    plain = solve(deck, "--no-reduction", "fixed")
    assert solve(deck, "--audit") == plain and counted.compiled == 2


# ---- never what another would -------------------------------------------------------------------


def test_a_deck_that_changes_and_keeps_size_and_time(deck: Path) -> None:
    assert solve(deck) == pytest.approx(-10.0)
    replaced(deck, "-10.0", "-30.0")
    assert solve(deck) == pytest.approx(-30.0)
    replaced(deck, "-30.0", "-10.0")
    assert solve(deck) == pytest.approx(-10.0)


def test_commands_that_come_change_and_go(deck: Path, capsys) -> None:
    """-2.5 at t = 1, -22.5 at t = 3."""
    commands = Path("fall.acf")
    assert solve(deck) == pytest.approx(-10.0)
    commands.write_text("SIMULATE/DYNAMIC, END=1, STEPS=4\nSTOP\n")
    assert solve(deck) == pytest.approx(-2.5)
    replaced(commands, "END=1", "END=3")
    assert solve(deck) == pytest.approx(-22.5)
    assert main(["check", "fall.adm"]) == 0
    assert "with fall.acf beside it" in capsys.readouterr().out
    assert main(["check", "fall.adm", "fall.acf"]) == 0
    assert "beside it" not in capsys.readouterr().out
    commands.unlink()
    assert solve(deck) == pytest.approx(-10.0)


def test_another_folder_has_other_files(deck: Path, tmp_path: Path, monkeypatch) -> None:
    """The same name and text, and other commands beside."""
    assert solve(deck) == pytest.approx(-10.0)
    other = tmp_path / "other"
    other.mkdir()
    shutil.copy(deck, other)
    (other / "fall.acf").write_text("SIMULATE/DYNAMIC, END=1, STEPS=4\nSTOP\n")
    monkeypatch.chdir(other)
    assert solve(deck) == pytest.approx(-2.5)


def test_another_folder_has_other_names(deck: Path, tmp_path: Path, monkeypatch) -> None:
    """Also where nothing lies beside: whatever is found from the current folder may differ."""
    here = origin_of(deck, None)
    (tmp_path / "other").mkdir()
    shutil.copy(deck, tmp_path / "other")
    monkeypatch.chdir(tmp_path / "other")
    there = origin_of(deck, None)
    assert here and there and here.name != there.name and here.contents == there.contents


def test_a_deck_that_is_a_link_is_what_the_link_means(deck: Path) -> None:
    shutil.copy(deck, "heavy.adm")
    replaced(Path("heavy.adm"), "-10.0", "-30.0")
    link = Path("link.adm")
    link.symlink_to(deck)
    assert solve(link) == pytest.approx(-10.0)
    link.unlink()
    link.symlink_to("heavy.adm")
    assert solve(link) == pytest.approx(-30.0)


def test_tables_from_files_are_read_each_time(deck: Path, counted: Counted) -> None:
    force = "VFORCE/1, I=2, J_PART=1, FX=0\\, FY=AKISPL(TIME,0,1)\\, FZ=0"
    old = "VFORCE/1, I=2, J_PART=1, FX=0\\, FY=-10.0\\, FZ=0"
    deck.write_text(deck.read_text().replace(old, f"{force}\nSPLINE/1, FILE=f.csv"))
    table = Path("f.csv")
    table.write_text("".join(f"{t}, -10.0\n" for t in range(6)))
    assert solve(deck) == pytest.approx(-10.0)
    replaced(table, "-10.0", "-30.0")
    elsewhere = table.stat().st_mtime + 7  # the reader knows a table by size and time
    os.utime(table, (elsewhere, elsewhere))
    assert solve(deck) == pytest.approx(-30.0)
    assert counted.read == counted.compiled == 2 and not kept_entries(deck)


def test_routines_of_the_user_are_bound_each_time(deck: Path) -> None:
    """In processes of their own, as modules of Python are imported once."""
    text = deck.read_text().replace("FY=-10.0", "FY=USER(1)")
    deck.write_text(text)
    routine = Path("pull.py")
    routine.write_text("def pull(parameters, time):\n    return 0.0, -10.0, 0.0\n")
    words = ["-m", "adamslite", "solve", "fall.adm", "-o", "out.csv", "--user", "VFOSUB=pull:pull"]
    deck.write_text(
        text.replace("FX=0\\, FY=USER(1)\\, FZ=0", "FUNCTION=USER(1)"),
    )
    path = os.pathsep.join([str(Path(adamslite.__file__).parents[1]), "."])
    env = {**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"}
    for force in ("-10.0", "-30.0"):
        replaced(routine, "-10.0", force) if force != "-10.0" else None
        run = subprocess.run([sys.executable, *words], env=env, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        found = Results.load("out.csv")["POINT_MASS/2.y"][-1]
        assert found == pytest.approx(float(force))
    assert not kept_entries(deck)


def test_numbers_of_the_user_are_part_of_no_entry(deck: Path, counted: Counted) -> None:
    text = deck.read_text().replace("FX=0\\, FY=-10.0\\, FZ=0", "FUNCTION=USER(1)")
    deck.write_text(text)
    assert solve(deck, "--user", "VFORCE/1=0,-10,0") == pytest.approx(-10.0)
    assert solve(deck, "--user", "VFORCE/1=0,-30,0") == pytest.approx(-30.0)
    assert main(["solve", str(deck)]) == 3  # no routine at all
    assert counted.read == 3 and not kept_entries(deck)


def test_a_binding_without_use_is_reported_of_a_kept_deck(deck: Path, capsys) -> None:
    assert solve(deck) == pytest.approx(-10.0)
    capsys.readouterr()
    for command in ("solve", "check"):
        main([command, str(deck), "--user", "VFORCE/1=0,-30,0"])
        assert "VFORCE/1" in "".join(capsys.readouterr())


def test_a_deck_replaced_while_it_is_read_is_not_kept(deck: Path, monkeypatch) -> None:
    """What is read is not what was digested."""
    read_together = scene.read_together

    def read(*words):
        replaced(deck, "-10.0", "-30.0")
        return read_together(*words)

    monkeypatch.setattr(scene, "read_together", read)
    assert solve(deck) == pytest.approx(-30.0)
    monkeypatch.setattr(scene, "read_together", read_together)
    replaced(deck, "-30.0", "-10.0")
    assert solve(deck) == pytest.approx(-10.0)


def test_what_can_be_read_once_is_not_read_for_its_name(deck: Path, capsys) -> None:
    """A pipe, as of ``adamslite check <(program)``."""
    os.mkfifo("pipe.adm")
    with subprocess.Popen(["cp", "fall.adm", "pipe.adm"]):
        assert main(["check", "pipe.adm"]) == 0
    assert "9 statements" in capsys.readouterr().out


def test_a_large_deck_is_not_kept(deck: Path, monkeypatch) -> None:
    monkeypatch.setattr(kept_scene, "MOST", 100)
    assert origin_of(deck, None) is None
    assert solve(deck) == pytest.approx(-10.0)


def test_a_program_replaced_while_it_runs_keeps_nothing(deck: Path, monkeypatch) -> None:
    monkeypatch.setattr(kept_scene, "is_unchanged", lambda: False)
    assert solve(deck) == pytest.approx(-10.0)
    assert not kept_entries(deck)


def test_every_processor_has_kernels_of_its_own(deck: Path, monkeypatch, counted) -> None:
    names = set()
    for name in ("host", "x86-64", "x86-64-v2"):
        monkeypatch.setenv("ADAMSLITE_CPU", name)
        origin = origin_of(deck, None)
        assert origin
        names.add(origin.name)
    assert len(names) == 3
    monkeypatch.setenv("ADAMSLITE_CPU", "host")
    monkeypatch.setattr(processor, "_told_by_system", str)  # as on a system without /proc
    origin = origin_of(deck, None)
    assert origin and origin.name not in names
    monkeypatch.setenv("ADAMSLITE_CPU", "none")
    assert origin_of(deck, None) is None
    assert main(["solve", str(deck)]) == 2


# ---- entries ------------------------------------------------------------------------------------


def test_damaged_entries_of_a_deck_are_rebuilt(deck: Path, counted, caplog) -> None:
    right = solve(deck)
    origin = origin_of(deck, None)
    assert origin
    read = kept_scene.find(origin)
    assert read
    names = kept_scene._entry(origin), kept_kernels.name_of(read[0], frozenset(), False)
    for name in names:
        file = cache_folder() / name
        content = file.read_bytes()
        file.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    assert solve(deck) == right and counted.read == counted.compiled == 2
    assert [name for name in names if name in caplog.text] == [*names]
    assert solve(deck) == right and counted.read == counted.compiled == 2


def test_kernels_whose_code_has_gone_are_made_again(deck: Path, counted) -> None:
    right = solve(deck)
    origin = origin_of(deck, None)
    assert origin
    read = kept_scene.find(origin)
    assert read
    kernels = objects.find(
        kept_kernels.name_of(read[0], frozenset(), False), kept_kernels._known(read[0])
    )
    (cache_folder() / kernels.groups[0].entry).unlink()
    assert solve(deck) == right and counted.compiled == 2


@pytest.mark.slow
def test_loads_by_component_are_written_of_kept_kernels(deck: Path, counted) -> None:
    """VERLET evaluates a row of springs by component; the kernels were kept by another method."""
    masses = 12
    lines = ["a row of springs", "UNITS/SYSTEM=MKS", "PART/1, GROUND", "MARKER/1, PART=1"]
    for k in range(2, masses + 2):
        lines.append(f"POINT_MASS/{k}, MASS=1, CM={k}, QG={k - 1},{0.1 * (k % 3)},0")
        lines.append(f"MARKER/{k}, POINT_MASS={k}")
        law = f"-{90 + time.time_ns() % 7}*(DM({k},{k - 1})-0.9)"
        lines.append(f"SFORCE/{k}, I={k}, J={k - 1}, FUNCTION={law}")
    deck.write_text("\n".join([*lines, "SIMULATE/DYNAMIC, END=0.5, STEPS=5", "END", ""]))
    solve(deck, "--integrator", "GSTIFF")
    solve(deck, "--integrator", "VERLET")
    kept = Path("out.csv").read_bytes()
    solve(deck, "--integrator", "VERLET", "--no-reduction", "plane")
    assert counted.compiled == 2
    found = adamslite.simulate(str(deck), integrator="VERLET")
    found.save("fresh.csv")
    assert Path("fresh.csv").read_bytes() == kept
