"""All mistakes of a statement are reported at once, also where one of its arguments is not read."""

from __future__ import annotations

import pytest
from decklets import told

from adamslite.language.messages import START

HEAD = """title
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
MARKER/3, PART=2
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, TRANSLATIONAL, I=3, J=1
JOINT/3, REVOLUTE, I=3, J=1
"""


@pytest.mark.parametrize(("broken", "codes"), [
    ("PART/4, MASS=-3, CM=4, IP=1,1\nMARKER/4, PART=4", {"value-count", "negative-mass"}),
    ("PART/4, MASS=-3, CM=4, IPP=1,1,1\nMARKER/4, PART=4", {"unknown-argument", "negative-mass"}),
    ("SIMULATE/DYNAMICS, END=-1, STEPS=0.5", {"end-not-later", "not-an-integer"}),
    ("COUPLER/1, JOINTS=1,2,3, SCALES=1, TYPE=R:T:Q", {"scale-count", "unknown-choice"}),
    ("SFORCE/1, TRANSLATIONAL, I=2, J=2, FUNCTION=FOO(1)", {"same-marker", "unknown-function"}),
    ("SFORCE/1, TRANSLATIONAL, I=2, J=2", {"same-marker", "missing-argument"}),
    ("SFORCE/1, TRANSLATIONAL, I=2, J=2, FUNCTION=SIN(", {"same-marker", "unclosed-bracket"}),
], ids=lambda case: case if isinstance(case, str) else "")  # fmt: skip
def test_further_mistakes_are_reported_at_once(broken: str, codes: set[str]) -> None:
    assert {each.code for each in told(HEAD + broken + "\nEND\n")} == codes


@pytest.mark.parametrize(("broken", "code"), [
    # IP is there, but not known: nothing can be said of the inertia.
    ("PART/4, MASS=3, CM=4, IP=1,1\nMARKER/4, PART=4", "value-count"),
    # J may be any marker.
    ("SFORCE/1, TRANSLATIONAL, I=2, J=77, FUNCTION=1", "missing-reference"),
    # What stands behind the comma has been lost.
    ("PART/4,", "trailing-comma"),
    ("MATRIX/4, FULL=RORDER, ROWS=1, COLUMNS=3, VALUES=1,,3", "empty-item"),
    # IP has not all that is written.
    ("PART/4, MASS=3, CM=4, IP=(1,1\nMARKER/4, PART=4", "unclosed-bracket"),
    # Any argument may be meant by a word that resembles none.
    ("PART/4, QQQQ=3, CM=4, IP=1,1,1\nMARKER/4, PART=4", "unknown-argument"),
], ids=lambda case: case if isinstance(case, str) else "")  # fmt: skip
def test_nothing_is_said_of_what_is_not_known(broken: str, code: str) -> None:
    assert {each.code for each in told(HEAD + broken + "\nEND\n")} == {code}


def test_what_is_said_of_others_is_said_once() -> None:
    """A second statement with a mistake of its own is reported for itself only."""
    broken = "PART/4, MASS=-3, CM=4, IP=1,1\nPART/5, MASS=-3, CM=5, IP=1,1\n"
    markers = "MARKER/4, PART=4\nMARKER/5, PART=5\nEND\n"
    found = [each.code for each in told(HEAD + broken + markers)]
    assert sorted(found) == ["negative-mass", "negative-mass", "value-count", "value-count"]


def test_a_shortened_flag_ends_where_it_is_written() -> None:
    """GROUN at the end of a statement that is read in part is inside of it, as GROUND is."""
    for flag in ("GROUND", "GROUN"):
        found = told(f"{START}PART/20, CM=999, {flag}\n")
        (second,) = (each for each in found if each.code == "two-grounds")
        assert second.span.end_column - second.span.column == len(flag)
