"""The commands as functions: compare, verify, cable, fmt, help, cache, chart, check."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.cli.main import command_parsers, main
from adamslite.errors import FormatError, UsageError
from adamslite.resources import find
from adamslite.results.comparison import Mismatch, Tolerance

DECKS = find("decks")
HANGING = DECKS / "hanging-mass"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


#: The function of each command; those of editors serve and write files of editors alone.
FUNCTIONS = {
    "check": al.check, "solve": al.simulate, "diff": al.compare, "verify": al.verify,
    "linear": al.linearize, "chart": al.chart, "cable": al.cable, "cache": al.cache,
    "fit": al.fit, "fmt": al.fmt, "help": al.help, "names": al.names, "plot": al.plot,
    "sens": al.sensitivities, "sweep": al.sweep, "view": al.view, "indices": al.indices,
}  # fmt: skip


def test_every_command_has_a_function() -> None:
    assert set(command_parsers()) - {"lsp", "editors"} == set(FUNCTIONS)
    assert {each.__name__ for each in FUNCTIONS.values()} <= set(al.__all__)


def test_the_package_is_imported_without_its_functions() -> None:
    program = (
        "import sys, adamslite; dir(adamslite)\n"
        "print([m for m in sys.modules if m.startswith('adamslite.') or m == 'numpy'])"
    )
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert found.stdout.strip() == "[]", found.stderr


def test_a_check_prints_what_the_command_prints(capsys: Any) -> None:
    for deck in (HANGING / "hanging-mass.adm", DECKS / "paper-sforce" / "paper-sforce.adm"):
        assert main(["check", str(deck)]) == 0
        assert str(al.check(deck)) == capsys.readouterr().out
    Path("wrong.adm").write_text("A deck\nPART/1, GROUND\nMARKER/2, PART=3\nEND\n")
    assert main(["check", "wrong.adm"]) == 3
    found = al.check("wrong.adm")
    assert str(found) == capsys.readouterr().out
    assert [each.code for each in found.errors] == ["missing-reference"]


def test_a_check_counts_the_command_file_beside() -> None:
    deck = "A mass\nPART/1, GROUND\nPOINT_MASS/2, MASS=1\nEND\n"
    Path("mass.adm").write_text(deck)
    assert {each.code for each in al.check("mass.adm")} == {"no-run"}
    Path("mass.acf").write_text("SIMULATE/DYNAMIC, EMD=2\n")
    assert {each.code for each in al.check("mass.adm")} == {"unknown-argument"}
    assert al.check("mass.adm", commands="SIMULATE/DYNAMIC, END=2, STEPS=3") == []
    assert al.check(al.read("mass.adm")) == []
    read = al.check(al.read("mass.adm"), commands="SIMULATE/STATICS")
    assert "1 point mass" in str(read)


def test_comparisons_of_files_are_those_of_the_command(capsys: Any) -> None:
    al.simulate(HANGING / "hanging-mass.adm").save("hanging-mass.csv")
    reference = HANGING / "reference.csv"
    assert main(["diff", "hanging-mass.csv", str(reference), "--all"]) == 0
    found = al.compare("hanging-mass.csv", reference)
    assert f"{found}\n" == capsys.readouterr().out
    assert repr(found) == "<Comparison: 4 compared, all within their tolerances>"


def table(values: list[float], names: str = "a", title: str = "one") -> al.Results:
    times = np.arange(float(len(values)))
    meta = {"deck": title, "deck hash": title}
    return al.Results(time=times, names=(names,), values=np.array([values]).T, meta=meta)


@pytest.mark.parametrize(
    ("tolerance", "inside"),
    [
        (None, False), (0.2, True), (0.001, False), ("0.2", True), ("abs 0.05", False),
        ("abs 0.11", True), ("rel 0.2 abs 0.1", True), (Tolerance(abs=0.11), True),
        (lambda name: Tolerance(abs=0.05), False),
    ],
)  # fmt: skip
def test_tolerances_are_numbers_texts_or_objects(tolerance: Any, inside: bool) -> None:
    """0.1 off where the reference is 1."""
    assert al.compare(table([1.0, 1.1]), table([1.0, 1.0]), tolerance).inside is inside


def test_a_tolerance_may_depend_on_the_name() -> None:
    """Names with characters that mean something in patterns, too."""
    both = [al.Results(time=np.zeros(1), names=("VARIABLE/[x]", "b*"), values=np.array([row]))
            for row in ([1.0, 1.0], [1.1, 1.1])]  # fmt: skip
    wide = {"VARIABLE/[x]": Tolerance(abs=0.2), "b*": Tolerance(abs=0.01)}
    found = al.compare(*both, wide.__getitem__)
    assert [each.name for each in found.outside] == ["b*"]


def test_references_may_be_interpolated() -> None:
    """y = t at whole times, and at the halves between."""
    coarse, fine = table([0.0, 1.0, 2.0]), table([0.0, 0.5, 1.0])
    fine = al.Results(time=np.array([0.0, 0.5, 1.0]), names=("a",), values=fine.values)
    assert al.compare(coarse, fine, interpolate="linear").inside
    with pytest.raises(Mismatch, match="not an output time"):
        al.compare(coarse, fine)
    with pytest.raises(UsageError, match="interpolate='spline': there are linear, cubic"):
        al.compare(coarse, fine, interpolate="spline")


def test_what_cannot_be_compared_is_told() -> None:
    with pytest.raises(Mismatch, match="no channel 'b'"):
        al.compare(table([1.0]), table([1.0], "b"))
    with pytest.raises(Mismatch, match="no output time at all"):
        al.compare(table([1.0]), table([]))
    with pytest.raises(UsageError, match="^'abs' is not a tolerance; write 'abs A'"):
        al.compare(table([1.0]), table([1.0]), "abs")
    with pytest.warns(al.DeckWarning, match="different decks, 'one' and 'two'"):
        al.compare(table([1.0]), table([1.0], title="two"))
    assert not al.compare(table([np.nan]), table([1.0])).inside


def test_references_are_verified() -> None:
    (verdict,) = al.verify(HANGING)
    assert verdict.passed and 0.0 < (verdict.share or 0.0) <= 1.0
    with pytest.raises(UsageError, match=r"no deck with a reference\.csv"):
        al.verify(Path())


CABLE = """title = "A weight on a rope"
accuracy = 0.05

[rope]
mass_per_length = 1.0
EA = 1e6
"""


def test_a_description_becomes_a_deck_that_runs(capsys: Any) -> None:
    spec = DECKS / "cables" / "described" / "hanging-weight.toml"
    spec = spec if spec.is_file() else next((DECKS / "cables" / "described").rglob("*.toml"))
    assert main(["cable", str(spec)]) == 0
    printed = capsys.readouterr().out
    assert al.cable(spec) == printed
    text = al.cable(spec.read_text(encoding="utf-8"))
    assert "\nEND" in text and not al.check(text).errors
    with pytest.raises(al.DeckError):
        al.cable(CABLE)
    with pytest.raises(FileNotFoundError):
        al.cable("nothing.toml")
    Path("latin.toml").write_bytes(b'title = "Gr\xf6\xdfe"\n')
    with pytest.raises(FormatError, match=r"latin\.toml is not UTF-8"):
        al.cable("latin.toml")


def test_layouts() -> None:
    rough, layout = "A deck\npart/1,ground\nend\n", "A deck\nPART/1, GROUND\nEND\n"
    assert al.fmt(rough) == layout == al.fmt(layout)
    Path("rough.adm").write_text(rough)
    assert al.fmt("rough.adm") == layout and Path("rough.adm").read_text() == rough
    assert al.fmt(Path("rough.adm"), write=True) == layout
    assert Path("rough.adm").read_text() == layout


def test_pages_of_the_manual() -> None:
    page = al.help("step5")
    assert page.startswith("### `STEP5(x, x0, h0, x1, h1)`")
    assert page._repr_markdown_() == page == repr(page)
    assert "SFORCE" in al.help()
    assert "Run a deck" in al.help("simulate")
    with pytest.raises(UsageError, match="did you mean STEP5"):
        al.help("STEPP5")


def test_the_cache(cache: Path) -> None:
    (cache / "v1").mkdir(exist_ok=True)
    assert al.cache().folder == cache
    al.compile_model(al.assemble(al.read(HANGING / "hanging-mass.adm")))
    kept = al.cache()
    assert kept.entries > 0 and kept.size > 0
    assert al.cache(clear=True) == kept
    assert al.cache().entries == 0


def test_charts_take_what_the_command_takes() -> None:
    deck = HANGING / "hanging-mass.adm"
    chart = al.chart(
        deck, end=0.5, steps=10, integrator="gstiff", error=1e-4, channel="POINT_MASS/2.y",
        repeats=1,
    )  # fmt: skip
    assert [(each.program, each.setting) for each in chart.points] == [
        ("GSTIFF I3", "ERROR=0.0001"), ("GSTIFF SI2", "ERROR=0.0001"),
    ]  # fmt: skip
    assert chart.channels == ("POINT_MASS/2.y",)
    assert "recommended" in str(chart) or "nearest" in str(chart)
    assert repr(chart).startswith("<Chart: 2 runs against ")
    with pytest.raises(UsageError, match="integrator='EULER': there are"):
        al.chart(deck, integrator=["EULER"])
    with pytest.raises(UsageError, match="error=-1: it must be a positive number"):
        al.chart(deck, error=[1e-3, -1])
    for wrong in ({"repeats": 0}, {"patience": 0.0}):
        with pytest.raises(UsageError, match="repeats= is at least 1, patience= a positive"):
            al.chart(deck, **wrong)


def test_modes_are_a_table_in_a_terminal(capsys: Any) -> None:
    deck = HANGING / "hanging-mass.adm"
    assert main(["linear", str(deck), "--time", "0.1"]) == 0
    modes = al.linearize(deck, time=0.1)
    assert f"{modes}\n" == capsys.readouterr().out
    modes.save("modes.json")
    assert main(["linear", str(deck), "--time", "0.1", "-o", "same.json"]) == 0
    assert Path("modes.json").read_text() == Path("same.json").read_text()
    with pytest.raises(UsageError, match=r"must end with \.csv \(modes\) or \.json"):
        modes.save("modes.txt")
    assert repr(modes) == "<Linearization: 6 states, 0 inputs, 0 outputs>"
