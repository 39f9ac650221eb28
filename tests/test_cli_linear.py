"""`adamslite linear`: what it prints, writes and refuses."""

import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from fakes import SIMULATE

from adamslite.cli.main import main


@dataclass(frozen=True)
class Modes:
    """What `linearize` gives: a damped pair, a creeping mode and a free motion."""

    eigenvalues: tuple[complex, ...] = (0j, -0.6 - 6j, -0.6 + 6j, -0.5 + 0j)
    frequencies: tuple[float, ...] = (0.0, 0.95967, 0.95967, 0.0795775)
    damping_ratios: tuple[float, ...] = (0.0, 0.0995037, 0.0995037, 1.0)
    undamped: tuple[float, ...] = (0.0, 0.959)
    modes: tuple[tuple[complex, ...], ...] = ((1 + 0j, 1j, -1j, 1 + 0j),)
    state_matrix: np.ndarray = field(default_factory=lambda: np.array([[0.0, 1.0], [-1.0, 0.0]]))
    coordinates: tuple[str, ...] = ("PART/2.x",)
    input_matrix: np.ndarray = field(default_factory=lambda: np.array([[0.0], [1.0]]))
    output_matrix: np.ndarray = field(default_factory=lambda: np.array([[1.0, 0.0]]))
    feedthrough: np.ndarray = field(default_factory=lambda: np.zeros((1, 1)))
    kinetic: np.ndarray = field(default_factory=lambda: np.ones((1, 4)))
    bodies: tuple[str, ...] = ("PART/2",)
    inputs: tuple[str, ...] = ("VARIABLE/1",)
    outputs: tuple[str, ...] = ("VARIABLE/2",)
    note: str = ""


def test_linear_prints_a_table_of_modes(pipeline, capsys) -> None:
    pipeline.linearization = Modes()
    assert main(["linear", "cable.adm", "--time", "2"]) == 0
    assert capsys.readouterr().out == (
        "mode    frequency [Hz]     damping ratio              real         imaginary\n"
        "   1                 0                 0                 0                 0\n"
        "   2         0.0795775                 1              -0.5                 0\n"
        "   3           0.95967         0.0995037              -0.6              +/-6\n"
    )
    assert pipeline.calls == [{"commands": (), "time": 2.0}]


def test_linear_writes_the_modes_or_everything(pipeline) -> None:
    pipeline.linearization = Modes()
    Path("cable.acf").write_text("SIMULATE/STATICS\n")
    assert main(["linear", "cable.adm", "-o", "a.csv"]) == 0
    assert main(["linear", "cable.adm", "-o", "a.json"]) == 0
    assert pipeline.calls[0] == {"commands": (SIMULATE,), "time": None}
    head, *rows = Path("a.csv").read_text().splitlines()
    assert head == "mode,frequency,damping_ratio,real,imaginary,pair"
    assert rows[2] == "3,0.95967,0.0995037,-0.6,6.0,1" and len(rows) == 3
    whole = json.loads(Path("a.json").read_text())
    assert whole["eigenvalues"][1] == [-0.6, -6.0] and whole["coordinates"] == ["PART/2.x"]
    assert whole["modes"] == [[[1, 0], [0, 1], [0, -1], [1, 0]]]
    assert whole["state_matrix"] == [[0, 1], [-1, 0]]
    assert (whole["inputs"], whole["input_matrix"]) == (["VARIABLE/1"], [[0], [1]])
    assert (whole["outputs"], whole["output_matrix"]) == (["VARIABLE/2"], [[1, 0]])
    assert whole["feedthrough"] == [[0]]


@pytest.mark.parametrize("flags", [["-o", "modes.txt"], ["--time", "-1"], ["--time", "later"]])
def test_wrong_flags_of_linear_are_usage(pipeline, flags: list[str]) -> None:
    assert main(["linear", "cable.adm", *flags]) == 2
    assert pipeline.calls == []
