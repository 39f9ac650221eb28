"""Derivatives of runs by numbers of their decks, against closed forms.

Values are off by what the run itself is off by; ERROR is small where digits are asked for.
"""

from __future__ import annotations

import numpy as np
import pytest

import adamslite as al
from adamslite.errors import UsageError

SPRING = """m x'' = -k (x - 1) - c x', let go at x = 2 at rest
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, C=0.4, LENGTH=1
VARIABLE/unused, FUNCTION=3
REQUEST/1, F2=DX(2,1)**2
END
"""
MASS, STIFFNESS, DAMPING = 2.0, 8.0, 0.4
RUN = {"end": 3.0, "steps": 60, "error": 1e-10}


def motion(t: np.ndarray, m: float, k: float, c: float, x0: float = 2.0) -> np.ndarray:
    """x(t) of the deck above."""
    decay, w = c / (2 * m), np.sqrt(k / m - (c / (2 * m)) ** 2)
    return 1 + (x0 - 1) * np.exp(-decay * t) * (np.cos(w * t) + decay / w * np.sin(w * t))


def by_complex_step(function, *numbers: complex, at: int) -> np.ndarray:
    """The derivative of an analytic function by one of its numbers."""
    given = [complex(each) for each in numbers]
    given[at] += 1e-30j
    return function(*given).imag / 1e-30


def spring_slopes(t: np.ndarray) -> dict[str, np.ndarray]:
    """dx/dp of the deck above."""
    numbers = (MASS, STIFFNESS, DAMPING, 2.0)
    names = ("POINT_MASS/2.MASS", "SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C", "POINT_MASS/2.QG[0]")
    return {
        name: by_complex_step(lambda *p: motion(t, *p), *numbers, at=k)
        for k, name in enumerate(names)
    }


@pytest.mark.parametrize("form", ["I3", "SI2"])
def test_a_mass_on_a_spring_and_a_damper(form):
    found = al.sensitivities(SPRING, spring_slopes(np.zeros(1)), formulation=form, **RUN)
    for name, slopes in spring_slopes(found.time).items():
        gap = np.abs(found.curve("POINT_MASS/2.x", name) - slopes).max()
        assert gap <= 1e-6 * np.abs(slopes).max(), name


def test_measures_are_those_of_histories():
    """F2 = x^2, so that d max F2 = 2 x dx where x is largest."""
    names = ["SPRINGDAMPER/1.K", "POINT_MASS/2.QG[0]"]
    measures = ["min REQUEST/1.F2", "POINT_MASS/2.x@end", "mean POINT_MASS/2.x"]
    found = al.sensitivities(SPRING, names, measures, **RUN)
    x = motion(found.time, MASS, STIFFNESS, DAMPING)
    for name in names:
        slopes = spring_slopes(found.time)[name]
        least = (x**2).argmin()
        expected = [
            2 * x[least] * slopes[least],
            slopes[-1],
            np.trapezoid(slopes, found.time) / found.time[-1],
        ]
        assert [found[measure, name] for measure in measures] == pytest.approx(expected, rel=1e-6)


def test_a_number_that_nothing_uses_has_zeros_and_a_word():
    found = al.sensitivities(SPRING, ["unused"], ["POINT_MASS/2.x@end"], **RUN)
    assert found.gradient == [[0.0]]
    assert "no equation" in found.notes["VARIABLE/unused.FUNCTION"]


@pytest.mark.parametrize(
    ("by", "of", "options", "words"),
    [
        ("SPRINGDAMPER/1.KT", "POINT_MASS/2.x@end", {}, "there is no number"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.q@end", {}, "did you mean"),
        ("SPRINGDAMPER/1.K", "most POINT_MASS/2.x", {}, "a measure is a word"),
        ("SPRINGDAMPER/1.K", "maxtime POINT_MASS/2.x", {}, "has no derivative"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.x@soon", {}, "behind @"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.x@9", {}, "from 0 to 3"),
        ("REQUEST/1.F2", "POINT_MASS/2.x@end", {}, "form of an expression"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.x@end", {"integrator": "ABAM"}, "ABAM"),
    ],
)
def test_mistakes_are_told(by, of, options, words):
    with pytest.raises(UsageError, match=words):
        al.sensitivities(SPRING, [by], [of], **RUN, **options)
