"""Signatures of deck functions and what they say about a call."""

from __future__ import annotations

import pytest

import adamslite.functions  # noqa: F401  fills the registry
from adamslite.language.function import FUNCTIONS, Parameter, function


@pytest.fixture
def declare():
    """Registers a function for the length of one test."""
    made = []

    def register(signature: str, **options):
        function("SAMPLE", signature, **options)(lambda scope, *args: 0)
        made.append("SAMPLE")
        return FUNCTIONS["SAMPLE"]

    yield register
    for name in made:
        del FUNCTIONS[name]


def test_words_of_a_signature(declare):
    f = declare("id:sforce c:constant{1..3,27} i:marker j:marker=0 b:number=2.5")
    assert f.parameters == (
        Parameter("id", "sforce"),
        Parameter("c", "constant", allowed=(1, 2, 3, 27)),
        Parameter("i", "marker"),
        Parameter("j", "marker", 0.0),
        Parameter("b", "number", 2.5),
    )
    assert [p.statement for p in f.parameters] == ["SFORCE", None, "MARKER", "MARKER", None]
    assert (f.minimum, f.maximum, f.usage) == (3, 5, "SAMPLE(id, c, i[, j][, b])")


def test_repeated_arguments(declare):
    f = declare("x:number *a0:number[1..31]")
    assert (f.minimum, f.maximum, f.usage) == (2, 32, "SAMPLE(x, a0, ...)")
    assert f.parameter(20).name == "a0"


def test_arguments_without_limit(declare):
    f = declare("*x1:number[2..]")
    assert (f.minimum, f.maximum) == (2, None)


def test_colon_after_the_first_argument(declare):
    f = declare("e:number: a:number b:number")
    assert f.colon
    assert f.usage == "SAMPLE(e: a, b)"


@pytest.mark.parametrize("signature", ["x", "x:number y"])
def test_a_word_without_a_kind_is_refused(declare, signature):
    with pytest.raises(ValueError, match="no kind"):
        declare(signature)


def test_a_name_is_registered_once(declare):
    declare("x:number")
    with pytest.raises(ValueError, match="twice"):
        function("SAMPLE", "x:number")(lambda scope, x: x)


@pytest.mark.parametrize(
    ("name", "values", "index", "words"),
    [
        ("ORIENT", (28, 1, None, None), 0, "1..27 or 29"),
        ("ORIENT", (14, 4, None, None), 1, "system 14 of ORIENT has components 1..3"),
        ("ORIENT", (27, 5, None, None), 1, "system 27 of ORIENT has components 1..4"),
        ("JOINT", (None, 2, 1, None), 1, "0 or 1"),
        ("JOINT", (None, 0, 1.5, None), 2, "1..8"),
        ("STEP", (None, 2, 0, 2, 1), 3, "differ"),
        ("STEP5", (None, 2, 0, 1, 1), 3, "x0 < x1"),
        ("SWEEP", (None, 1, 3, 1, 2, 5, 0.1), 4, "x0 < x1"),
        ("BISTOP", (None, None, 2, 1, 1, 1, 1, 1), 3, "x1 < x2"),
    ],
)
def test_numbers_that_cannot_be(name, values, index, words):
    ((where, sentence),) = FUNCTIONS[name].mistakes(values)
    assert where == index
    assert words in sentence


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("ORIENT", (27, 4, None, None)),
        ("ORIENT", (29, 9, None, None)),
        ("STEP", (None, 2, 0, 1, 1)),
        ("STEP5", (None, None, 0, 1, 1)),
        ("MAX", (1, 2, 3)),
    ],
)
def test_numbers_that_can_be(name, values):
    assert FUNCTIONS[name].mistakes(values) == []


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_every_function_has_a_manual_page(name):
    doc = FUNCTIONS[name].doc
    first = doc.splitlines()[0]
    assert first.endswith((".", ":"))
    assert "Source: " in doc
    assert all(len(line) <= 96 for line in doc.splitlines())


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_edges_and_their_order_come_together(name):
    f = FUNCTIONS[name]
    assert f.smooth == (f.order is None)
