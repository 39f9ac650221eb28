"""Fits: the measured file, what is refused, and the fitted deck."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fit_scenes import (
    LONG,
    MASS,
    SWINGS,
    THROWN,
    C,
    K,
    X,
    noisy,
    swinging,
    table,
)

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import FormatError, UsageError


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "thrown.adm").write_text(THROWN)
    (tmp_path / "swings.adm").write_text(SWINGS)
    return tmp_path


# ---- the measured file ---------------------------------------------------------------------------


def test_units_are_those_of_the_header() -> None:
    named = {"POINT_MASS/2.x [mm]": 1e3 * swinging(LONG)}
    file = table(1e3 * LONG, **named)
    file.write_text(file.read_text().replace("time", "time [ms]"))
    found = al.fit("swings.adm", file, by=[K, C], bounds={K: (1, None)})
    assert found.values == pytest.approx([200, 2], rel=1e-5)
    assert any("mm to m" in note and "ms to s" in note for note in found.notes)


def test_values_that_are_missing_are_left_out_and_told() -> None:
    x = swinging(LONG)
    x[[3, 40, 41]] = np.nan
    whole = table(np.delete(LONG, range(60, 80)), x=np.delete(x, range(60, 80)))
    found = al.fit("swings.adm", whole, by=[K, C])
    assert found.values == pytest.approx([200, 2], rel=1e-5)
    assert any("3 of 81 values are no number" in note for note in found.notes)
    assert any("nothing was measured from t = 1.18 to 1.6" in note for note in found.notes)


@pytest.mark.parametrize("unit", ["", " [m]"])
@pytest.mark.parametrize("band", ["# tolerance: abs 1e-3", "# no band"])
def test_a_file_in_another_unit_than_it_says_is_doubted(unit: str, band: str, capsys: Any) -> None:
    """Millimetres, with a wrong heading or without; the exit code is not that of a fit."""
    table(LONG, band, **{f"{X}{unit}": 1e3 * swinging(LONG)})
    assert main(["fit", "swings.adm", "measured.csv", "--quiet", "--by", C]) == 1
    said = capsys.readouterr().out
    assert "the deck does not do what was measured" in said
    assert "about 0.001 times what was measured: is the file in another unit?" in said


def test_a_poor_fit_in_the_right_unit_is_not_doubted_so(capsys: Any) -> None:
    table(LONG, "# tolerance: abs 1e-3", x=swinging(LONG, k=300.0))
    assert main(["fit", "swings.adm", "measured.csv", "--quiet", "--by", C]) == 1
    said = capsys.readouterr().out
    assert "the deck does not do what was measured" in said and "another unit" not in said


def test_flags_of_a_reference_file_are_those_of_the_runs() -> None:
    lines = ["# solve: --error 1e-6", f"# measure: max {X} = 1.2 tol abs 1"]
    found = al.fit("swings.adm", table(LONG, *lines, x=swinging(LONG)), by=[K])
    assert "ERROR=1e-06" in found.results.meta["integrator"]
    assert {"runs have error = 1e-06, as the file says",
            "lines '# measure:' of the file are not fitted"} <= set(found.notes)  # fmt: skip
    found = al.fit("swings.adm", table(LONG, *lines, x=swinging(LONG)), by=[K], error=1e-7)
    assert "ERROR=1e-07" in found.results.meta["integrator"]


BAD: list[tuple[dict[str, Any], str]] = [
    ({"by": ["SPRINGDAMPER/1.D"]}, "there is no number SPRINGDAMPER/1.D; SPRINGDAMPER/1 has K"),
    ({"by": []}, "nothing is fitted"),
    ({"by": [K, K]}, "twice"),
    ({"by": ["SIMULATE.STEPS"]}, "SIMULATE.STEPS takes whole numbers"),
    ({"by": [K], "bounds": {K: (300, 400)}}, "starts at 200, outside of its bounds 300 to 400"),
    ({"by": [K], "bounds": [f"{K}=5"]}, "for bounds write NAME=LOW:HIGH"),
    ({"by": [K], "bounds": {K: (3, 2)}}, "nothing is between"),
    ({"by": [K], "bounds": {C: (0, 9)}}, "has bounds and is not fitted"),
    ({"by": ["POINT_MASS/2.QG[1]"]}, "starts at zero"),
    ({"by": [K], "of": ["PART/*"]}, "no result is called 'PART/\\*'"),
    ({"by": [K], "start": 5}, "nothing was measured from t = 5"),
    ({"by": [K], "end": 1}, "measured from t = 0 to 2, and the run goes from 0 to 1"),
    ({"by": [K, C], "until": 0.01}, "1 values do not determine 2 numbers"),
]


@pytest.mark.parametrize(("given", "message"), BAD)
def test_what_cannot_be_fitted_is_a_sentence(given: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        al.fit("swings.adm", table(LONG, x=swinging(LONG)), **given)


FILES: list[tuple[str, str]] = [
    ("time,POINT_MASS/3.x\n0,1\n", "no result 'POINT_MASS/3.x'; did you mean POINT_MASS/2"),
    (f"time,{X} [N]\n0,1\n", f"'{X}' is in N, in the deck it is in m"),
    (f"time [m],{X}\n0,1\n", "'time' is in m, in the deck it is in s"),
    (f"time,{X}\n0,1\n0.5,1\n0.5,1\n", "t = 0.5 is there twice"),
    (f"time,{X}\n0,1\n0.5,1\n0.4,1\n", "t = 0.4 follows 0.5"),
    (f"time,{X}\n0,nan\n1,nan\n", "has no number at any time"),
    (f"time,{X}\nnan,1\n1,1\n", "row 1 has no time"),
    (f"# tolerance: rel 0.1\ntime,{X}\n0,1\n1,0\n", "is zero at t = 1; add 'abs A'"),
    (f"time,{X}\n", "nothing was measured"),
]


@pytest.mark.parametrize(("text", "message"), FILES)
def test_a_measurement_that_does_not_go_with_the_deck_is_a_sentence(
    text: str, message: str
) -> None:
    Path("measured.csv").write_text(text)
    with pytest.raises(UsageError, match=message):
        al.fit("swings.adm", "measured.csv", by=[K])


def test_an_empty_cell_is_named_with_its_line() -> None:
    Path("measured.csv").write_text(f"time,{X}\n0,1\n1,\n")
    with pytest.raises(FormatError, match="csv:3: a cell is empty; write nan"):
        al.fit("swings.adm", "measured.csv", by=[K])


# ---- the fitted deck ----------------------------------------------------------------------------


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_of_the_fitted_deck_only_numbers_and_the_comment_differ(encoding: str, ending: str) -> None:
    table(LONG, x=swinging(LONG) + noisy(101, 1e-3))
    text = SWINGS.replace("K=200, C=2", "K=1.5E2 , C=+2").replace("damper\n", "d\u00e4mper \n")
    data = text.replace("\n", ending).encode(encoding)
    Path("guess.adm").write_bytes(data)
    assert main(["fit", "guess.adm", "measured.csv", "--by", K, C, "--quiet"]) == 0
    made = Path("guess.fitted.adm").read_bytes()
    fit = al.fit("guess.adm", "measured.csv", by=[K, C])
    lines = made.decode(encoding).split(ending)
    comments = [line for line in lines[1:4] if line.startswith("!")]
    assert len(comments) == 3 and "measured.csv" in comments[0] and "+-" in comments[1]
    rest = ending.join([lines[0], *lines[4:]])
    own = data.decode(encoding).replace("1.5E2", repr(fit[K])).replace("+2", repr(fit[C]))
    assert rest == own
    assert al.read("guess.fitted.adm").statements[5].k == fit[K]
    assert np.array_equal(al.simulate("guess.fitted.adm")[X], fit.results[X])


def test_the_command_says_what_it_found(capsys: Any) -> None:
    table(LONG, "# tolerance: abs 1e-3", x=swinging(LONG) + noisy(101, 1e-3))
    command = ["fit", "swings.adm", "measured.csv", "--quiet", "--by"]
    assert main([*command, K, C, MASS, "-o", "out.adm"]) == 1
    said = capsys.readouterr()
    assert "cannot separate" in said.out and "out.adm" in said.err
    assert "cannot separate" in Path("out.adm").read_text()
    assert main([*command, K, "--set", f"{K}=250", "--plot", "fit.svg"]) == 0
    assert "250" in capsys.readouterr().out and Path("fit.svg").stat().st_size > 1000
    for wrong in (["-o", "swings.adm"], ["-o", "measured.csv"], ["--plot", "fit.doc"]):
        assert main([*command, K, *wrong]) == 2
    assert Path("swings.adm").read_text() == SWINGS
    assert main([*command, "K"]) == 2
    assert not [*Path().glob("*.part")]
