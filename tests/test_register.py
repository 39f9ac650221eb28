"""Registers: an entry by name imports its module; a look at all of them imports all."""

from __future__ import annotations

import subprocess
import sys

import pytest

from adamslite.language.register import Register
from adamslite.language.statement import STATEMENTS

IMPORTED = """\
import sys
from adamslite.language.statement import STATEMENTS
found = {work}
print(found, *sorted(n[19:] for n in sys.modules if n.startswith("adamslite.elements.")))
"""


def imported(work: str) -> tuple[str, list[str]]:
    """What an expression gives in a fresh process, and the modules of statements it imported."""
    code = IMPORTED.format(work=work)
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    found, *modules = run.stdout.split()
    return found, modules


def test_a_statement_that_is_named_imports_its_module_alone() -> None:
    assert imported("STATEMENTS['ACCGRAV'].keyword") == ("ACCGRAV", ["accgrav"])


@pytest.mark.parametrize(
    "look",
    [
        "'DEBUG' in STATEMENTS",
        "len(STATEMENTS) > 60",
        "bool(STATEMENTS.get('DEBUG'))",
        "STATEMENTS.get('NONE') is None",
        "'DEBUG' in {**STATEMENTS}",
        "'DEBUG' in [*STATEMENTS]",
        "'DEBUG' in STATEMENTS.keys()",
        "any(cls.keyword == 'DEBUG' for cls in STATEMENTS.values())",
        "'DEBUG' in dict(STATEMENTS.items())",
        "STATEMENTS['DEBUG'].keyword == 'DEBUG'",
    ],
)
def test_any_other_look_finds_all(look: str) -> None:
    """DEBUG is one of many in its module."""
    found, modules = imported(look)
    assert found == "True" and {"sforce", "passed_over", "vtorque"} <= {*modules}


def test_the_order_does_not_depend_on_what_was_imported_first() -> None:
    """Hints name the first of equally likely words."""
    first, _ = imported("STATEMENTS['VTORQUE'] and '-'.join(STATEMENTS)")
    assert first == "-".join(STATEMENTS)


def test_a_name_that_nobody_has_is_a_key_error() -> None:
    with pytest.raises(KeyError, match="NONE"):
        STATEMENTS["NONE"]


def test_nothing_is_entered_twice() -> None:
    register = Register[int]("adamslite.elements")
    register.enter("A", 1, "here")
    with pytest.raises(ValueError, match="A is registered twice"):
        register.enter("A", 2, "there")
