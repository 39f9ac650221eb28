"""What `check` says of expressions that are large once the VARIABLEs in them are written out."""

from __future__ import annotations

import pytest
from scenes import compiled

import adamslite as al

DECK = """large expressions
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
VARIABLE/1, FUNCTION=DX(2,1)
{chain}
END
"""
LENGTH = 9


def doubled() -> str:
    """Eight VARIABLEs, each of which takes the one before twice: as a tree 2^8 times the first."""
    links = (f"VARIABLE/{n + 1}, FUNCTION=VARVAL({n})*VARVAL({n})+1" for n in range(1, LENGTH))
    return DECK.format(chain="\n".join(links))


def errors(text: str) -> list[str]:
    """Messages of `check` about errors."""
    return [each.message for each in al.check(al.read(text)) if each.severity == "error"]


@pytest.fixture
def limited(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """So many operations are the most."""
    for module in ("kernels.columns", "kernels.binding", "checks.expressions"):
        monkeypatch.setattr(f"adamslite.{module}.LARGEST", request.param)


@pytest.mark.parametrize("limited", [40], indirect=True)
def test_check_reports_what_compiling_refuses(limited: None) -> None:
    with pytest.raises(al.DeckError) as fault:
        compiled(doubled())
    (only,) = fault.value.errors
    assert only.code == "expression-too-large" and errors(doubled()) == [only.message]


@pytest.mark.parametrize("limited", [70], indirect=True)
def test_what_is_written_out_once_is_counted_once(limited: None) -> None:
    """As a tree it is too large, and it is not."""
    assert compiled(doubled()).groups and not errors(doubled())


@pytest.mark.parametrize("limited", [40], indirect=True)
def test_of_functions_of_time_the_values_are_taken(
    limited: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing is written out there, so that nothing has to be counted."""
    monkeypatch.setattr("adamslite.kernels.collecting.refused", None)
    assert not errors(doubled().replace("DX(2,1)", "TIME"))


@pytest.mark.parametrize("limited", [15], indirect=True)
def test_a_function_of_time_may_be_too_large(limited: None) -> None:
    text = DECK.format(chain="VARIABLE/2, FUNCTION=" + "+".join(["SIN(TIME)*VARVAL(3)"] * 9))
    (only,) = errors(text.replace("END", "VARIABLE/3, FUNCTION=TIME\nEND"))
    assert only.startswith("VARIABLE/2 has more than 15 operations")


@pytest.mark.parametrize("limited", [15], indirect=True)
def test_one_expression_may_be_too_large_by_itself(limited: None) -> None:
    text = DECK.format(chain="VARIABLE/2, FUNCTION=" + "+".join(["DX(2,1)"] * 10))
    (only,) = errors(text)
    assert only.startswith("VARIABLE/2 has more than 15 operations")


def test_check_reports_decks_that_are_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("kernels.collecting", "checks.expressions"):
        monkeypatch.setattr(f"adamslite.{module}.MOST_IN_ALL", 60)
    monkeypatch.setattr("adamslite.checks.expressions.LARGEST", 200)
    own = (f"VARIABLE/{n}, FUNCTION=DX(2,1)**{n}{'+TIME' * n}" for n in range(2, 12))
    (only,) = errors(DECK.format(chain="\n".join(own)))
    assert "60 operations" in only
