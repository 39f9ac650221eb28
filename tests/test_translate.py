"""Native functions against the same functions run by Python, and what is refused."""

from __future__ import annotations

import math
import re
from math import floor, sqrt

import numpy as np
import pytest
from scenes import native_call

from adamslite.integrators.linalg import blocks
from adamslite.native.translate import (
    Ints,
    Reals,
    Record,
    Untranslatable,
    native,
)
from adamslite.native.translate.statements import Translator

LIMIT = 3


class Small(Record):
    reals: Reals
    ints: Ints


@native
def sample_helper(a: Reals, k: int) -> float:
    a[k] *= 2.0
    return a[k] if k > 0 else -1


@native
def sample_everything(P: Small, r: Reals, n: Ints) -> float:
    """One of each construction."""
    total, count = 0.0, 0
    for i in range(LIMIT):
        if i == 1:
            continue
        total += sample_helper(r, i)
    for i in range(6, 0, -2):
        total -= i
        if total < -100.0 or not i > 2:
            break
    while count < 5 and total > -1e9:
        count += 1
        total = max(total, float(count), 0.5) - min(r[0], 2)
    n[0], n[1] = n[1] // 3 + n[0] % 2, n[0] & 6
    shifted = r[1:]
    shifted[0] = abs(shifted[0]) ** 0.5 + shifted[1] ** 3 + sqrt(4.0) + floor(2.7)
    P.reals[0] = P.reals.size + int(2.9) - (-n[0])
    pass
    return total / 3 + P.ints[0] * 0.25


def test_every_construction_means_what_it_means_in_python():
    arrays = [np.array([0.5, 0.1]), np.array([7, 3]), np.array([0.3, -1.2, 2.0]), np.array([5, 8])]
    there, here = ([a.copy() for a in arrays] for _ in range(2))
    expected, found = (Small.zeros() for _ in range(2))
    for P, (reals, ints, *_) in ((expected, here), (found, there)):
        P.reals, P.ints = reals, ints
    expected = sample_everything(expected, here[2], here[3])
    found = native_call(sample_everything, [found, there[2], there[3]])
    assert found == pytest.approx(expected, rel=1e-14)
    for a, b in zip(there, here, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-14)


# ---- what is refused -----------------------------------------------------------------------------


def chained(a: float) -> bool:
    return 0.0 < a < 1.0


def unknown(a: float) -> float:
    return a + nowhere  # noqa: F821


def listed(a: float) -> float:
    return [a][0]


def foreign(a: float) -> float:
    return math.sin(a)


def outsider(a: float) -> float:
    return chained(a)


def float_as_condition(a: float) -> float:
    return 1.0 if a else 2.0


def changes_type(a: float) -> float:
    n = 1
    n = a
    return n


def remainder_of_floats(a: float) -> float:
    return a % 2.0


def unpacks(a: float) -> float:
    b, c = a
    return b + c


def loops_over_an_array(a: Reals) -> float:
    for b in a:
        return b


def slices_between(a: Reals) -> float:
    return a[1:2][0]


def plus(a: float) -> float:
    return +a


def member(a: int) -> bool:
    return a in (1, 2)


def named(a: float) -> float:
    return float(x=a)


def text(a: float) -> float:
    b = "text"
    return b


def raises(a: float) -> float:
    raise ValueError(a)


REFUSED = {
    chained: "chained comparisons", unknown: "nowhere is not known", listed: "List is not",
    foreign: "only calls by name", outsider: "chained is not a native function",
    float_as_condition: "a condition must be", changes_type: "n is i64, not double",
    remainder_of_floats: "Mod needs integers", unpacks: "several names need as many values",
    loops_over_an_array: "only a range", slices_between: "a slice has a start only",
    plus: "UAdd is not translated", member: "not translated", named: "by position",
    text: "'text' is not a number", raises: "Raise is not translated",
}  # fmt: skip


@pytest.mark.parametrize("function", REFUSED, ids=lambda f: f.__name__)
def test_unsupported_python_is_refused_by_name(function):
    """The message names the function and, where there is one, the line and the reason."""
    with pytest.raises(Untranslatable, match=REFUSED[function]) as caught:
        Translator(function).translate()
    line = function.__code__.co_firstlineno
    place = rf"^test_translate.py:({line}|{line + 1}|{line + 2}), {function.__name__}: "
    assert re.match(place, str(caught.value))


def test_a_name_is_registered_once():
    with pytest.raises(Untranslatable, match=r"two native functions are called .*\.factor"):
        native(blocks.factor)
