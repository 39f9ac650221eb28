"""The table of deliberate faults (tests/faults) follows the code."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent / "faults"
PROGRAM = runpy.run_path(str(FOLDER / "__main__.py"), run_name="faults")
FAULTS = PROGRAM["faults"]()


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_fault_finds_its_text_and_its_tests(fault: object) -> None:
    root = FOLDER.parent.parent
    text = (root / fault.file).read_text(encoding="utf-8")
    assert text.count(fault.old) == fault.times
    assert fault.new != fault.old
    assert fault.tests
    for test in fault.tests:
        if test.startswith("tests/"):
            assert (root / test.partition("::")[0]).is_file()


def test_the_table_is_large_and_its_names_differ() -> None:
    names = [fault.name for fault in FAULTS]
    assert len(names) == len(set(names)) >= 120


def test_a_copy_has_every_module_of_the_program(tmp_path: Path) -> None:
    """A fault in a copy that cannot be imported would be noticed by any test."""
    root = PROGRAM["copy"](tmp_path)
    package = FOLDER.parent.parent / "adamslite"
    wanted = {
        p.relative_to(package) for p in package.rglob("*.py") if "node_modules" not in p.parts
    }
    assert wanted == {p.relative_to(root / "adamslite") for p in (root / "adamslite").rglob("*.py")}
