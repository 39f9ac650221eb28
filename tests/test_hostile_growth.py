"""A short text does not become a large deck, nor a long sum many sets of symbols."""

from __future__ import annotations

import tracemalloc

import pytest

import adamslite as al
from adamslite.deck.brought import MOST
from adamslite.elements import matrix
from adamslite.symbolic.derivatives import Derivatives
from adamslite.symbolic.graph import add, mul, symbol

HEAD = """a few lines
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
GRAPHICS/1, ELLIPSOID, CM=2, XSCALE=1, YSCALE=1, ZSCALE=1
GRAPHICS/2, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1
ARRAY/1, X
ARRAY/2, X
ARRAY/3, U, VARIABLES=1
VARIABLE/1, FUNCTION=1
"""
LAW = "IMPACT, STIFFNESS=1, EXPONENT=2, DAMPING=1, DMAX=1"


def touching(count: int) -> str:
    """A CONTACT of so many shapes with so many others."""
    first, second = (",".join([each] * count) for each in "12")
    return f"CONTACT/1, IGEOM={first}, JGEOM={second}, {LAW}\n"


def states(first: int, second: int) -> str:
    return (
        f"GSE/1, XD=1, ND={first}, FUNCTION=USER(1)\nGSE/2, XD=2, ND={second}, FUNCTION=USER(1)\n"
    )


def most_memory(text: str) -> tuple[list[str], int]:
    """Codes of messages about a deck, and the bytes that checking it takes at most."""
    al.check(HEAD + "END\n")  # what all decks need
    tracemalloc.start()
    try:
        found = al.check(f"{HEAD}{text}END\n")
        return [each.code for each in found], tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (touching(400), "brings-too-much"),
        (states(10**9, 1), "brings-too-much"),
        ("MATRIX/1, SPARSE, ROWS=1000000000, COLUMNS=1000000000, VALUES=1,1,-1\n"
         "LSE/1, X=1, A=1\n", "matrix-too-large"),
        ("MATRIX/1, SPARSE, ROWS=1, COLUMNS=1, VALUES=1,1,-1\n"
         "MATRIX/2, SPARSE, ROWS=1000000, COLUMNS=1, VALUES=1,1,1\n"
         "LSE/1, X=1, U=3, A=1, B=2\n", "brings-too-much"),
    ],
    ids=["pairs of shapes", "states of a GSE", "zeros of a matrix", "rows of a matrix"],
)  # fmt: skip
def test_a_short_text_does_not_become_a_large_deck(text: str, code: str) -> None:
    codes, memory = most_memory(text)
    assert codes.count(code) == 1
    assert memory < 20e6


def test_all_statements_of_a_deck_share_the_room() -> None:
    """The first of two takes so much that the second one finds none."""
    (first,) = (each for each in al.check(HEAD + states(MOST - 1, 2) + "END\n")
                if each.code == "brings-too-much")  # fmt: skip
    assert first.message.startswith("GSE/2 makes too many")


def test_what_has_room_is_made() -> None:
    deck = al.read(f"{HEAD}{touching(20)}END\n")
    assert len(deck.of("CONTACT_POINT")) == 400 and not deck.overfull


def test_a_matrix_is_as_large_as_its_values_can_be(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(matrix, "MOST", 6)
    for rows, codes in ((2, []), (3, ["matrix-too-large"])):
        text = f"MATRIX/1, SPARSE, ROWS={rows}, COLUMNS=3, VALUES=1,1,4\n"
        found = [each.code for each in al.check(f"{HEAD}{text}END\n")]
        assert [each for each in found if each == "matrix-too-large"] == codes


#: Each VARIABLE takes the one before twice: the last one is written with 2^300 of them.
DOUBLED = "VARIABLE/1, FUNCTION=MAX(TIME,1)\n" + "".join(
    f"VARIABLE/{k}, FUNCTION=0.5*VARVAL({k - 1})+0.4*VARVAL({k - 1})\n" for k in range(2, 301)
)


@pytest.mark.parametrize(
    "held",
    [
        "MOTION/1, I=2, J=1, X, FUNCTION=VARVAL(300)",
        "GCON/1, FUNCTION=DX(2)-VARVAL(300)",
        "GCON/1, FUNCTION=DX(2)-VARVAL(300)\nDIFF/1, IC=0, FUNCTION=DELAY(DIF(1),1,0)",
    ],
)
def test_a_chain_of_doublings_is_checked_link_by_link(held: str) -> None:
    """In a MOTION and in constraints: when they hold, where they jump, how the deck starts."""
    head = HEAD.replace("VARIABLE/1, FUNCTION=1\n", "").replace("ARRAY/3, U, VARIABLES=1\n", "")
    found = al.check(f"{head}{DOUBLED}{held}\nSIMULATE/DYNAMIC, END=2, STEPS=10\nEND\n")
    assert not [each for each in found if each.severity == "error"]


def test_symbols_of_a_long_sum_take_little_memory() -> None:
    """Each of its partial sums has one more than the one before."""
    count = 1500
    terms = [symbol(f"k{n}") for n in range(count)]
    total = terms[0]
    for each in terms[1:]:
        total = add(mul(total, terms[0]), each)
    slope = Derivatives()
    tracemalloc.start()
    try:
        assert slope.symbols(total) == set(terms)
        assert slope.symbols(mul(terms[3], terms[2])) == {terms[2], terms[3]}
        assert tracemalloc.get_traced_memory()[1] < 3e6
    finally:
        tracemalloc.stop()
