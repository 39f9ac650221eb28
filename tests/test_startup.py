"""What a run loads: nothing that only a first run needs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from scenes import SPRING

LOADED = """\
import sys
import adamslite as al
al.simulate(al.read(sys.argv[1]), end=0.1, steps=2, integrator=sys.argv[2])
print(*sorted(name.removeprefix("adamslite.") for name in sys.modules if "adamslite." in name))
"""


@pytest.mark.slow  # it may have to compile the method
@pytest.mark.parametrize("method", ["GSTIFF", "HHT", "RADAU", "ABAM", "VERLET"])
def test_a_run_whose_code_is_compiled_loads_no_translator(tmp_path: Path, method: str) -> None:
    deck = tmp_path / "spring.adm"
    deck.write_text(SPRING)
    for _ in range(2):
        run = subprocess.run(
            [sys.executable, "-c", LOADED, str(deck), method],
            capture_output=True, text=True, check=True,
        )  # fmt: skip
    loaded = run.stdout.split()
    assert "equations.system" in loaded
    assert "native.translate.statements" not in loaded
    assert not [name for name in loaded if name.endswith(".method") and "integrators" in name]
    assert not {"integrators.motion_equations", "integrators.linalg.blocks"} & set(loaded)


COMMAND = """\
import sys
from adamslite.cli.main import main
code = main()
print("loaded", *sorted(sys.modules))
sys.exit(code)
"""


def loaded(deck: Path, *words: str) -> set[str]:
    """Modules that the command line has loaded when it has done something with a deck."""
    run = subprocess.run(
        [sys.executable, "-c", COMMAND, *words, str(deck)],
        capture_output=True, text=True, check=True, cwd=deck.parent,
    )  # fmt: skip
    return set(run.stdout.splitlines()[-1].split()[1:])


@pytest.mark.slow  # it may have to compile the method
def test_a_second_solve_loads_nothing_that_reads_checks_or_binds(tmp_path: Path) -> None:
    deck = tmp_path / "spring.adm"
    deck.write_text(SPRING.replace("END\n", "SIMULATE/DYNAMIC, END=0.1, STEPS=2\nEND\n"))
    for _ in range(2):
        found = loaded(deck, "solve")
    assert not {"lark", "sympy", "scipy", "llvmlite.binding", "logging", "statistics"} & found
    own = {name.removeprefix("adamslite.") for name in found if name.startswith("adamslite.")}
    rooms = {name.partition(".")[0] for name in own}
    assert not {"reading", "checks", "syntax", "cables", "functions", "drawing"} & rooms
    assert not {"kernels.compile", "kernels.binding", "language.messages"} & own
    folders = {name.rpartition(".")[0] for name in own}  # their own files hold a docstring
    assert "analyses.session.session" in own and len(own - folders) < 167


def test_a_second_check_loads_what_finds_its_text(tmp_path: Path) -> None:
    deck = tmp_path / "spring.adm"
    deck.write_text(SPRING)
    for _ in range(2):
        found = loaded(deck, "check")
    own = {name for name in found if name.startswith("adamslite.")}
    own_only = "dataclasses" not in found or sys.version_info >= (3, 14)  # argparse takes them
    assert "numpy" not in found and own_only and len(own) < 25


def test_one_result_format_is_loaded(tmp_path: Path) -> None:
    code = "from adamslite.results.formats import format_of; format_of('a.csv')"
    code += "; import sys; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    names = {name for name in run.stdout.split() if name.startswith("adamslite.outputs.")}
    own = ("csv", "drafts", "number_text", "row_by_row", "whole_files")
    assert names == {f"adamslite.outputs.{each}" for each in own}
