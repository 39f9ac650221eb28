"""`html`: what a notebook shows of an object of this package."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from adamslite.api.checks import Check, check
from adamslite.deck.deck import Deck
from adamslite.results.comparison import Comparison
from adamslite.results.linearization import Linearization
from adamslite.results.results import Results
from adamslite.verification.work_precision import Chart


def html(shown: Deck | Check | Results | Linearization | Comparison | Chart) -> str:
    """HTML of a deck (its check), results (with the page that moves), a linearised model, a
    comparison or a chart, as notebooks show it.

    Raises
    ------
    TypeError
        For anything else.
    """
    for kind, write in WRITERS.items():
        if isinstance(shown, kind):
            return write(shown)
    raise TypeError(f"nothing shows a {type(shown).__name__}")


def _check(shown: Check) -> str:
    from adamslite.notebooks.checks import check_html

    return check_html(shown)


def _deck(shown: Deck) -> str:
    return _check(check(shown))


def _results(shown: Results) -> str:
    from adamslite.notebooks.results import results_html

    return results_html(shown)


def _linearization(shown: Linearization) -> str:
    from adamslite.notebooks.linearization import linearization_html

    return linearization_html(shown)


def _comparison(shown: Comparison) -> str:
    from adamslite.notebooks.comparison import comparison_html

    return comparison_html(shown)


def _chart(shown: Chart) -> str:
    from adamslite.notebooks.chart import chart_html

    return chart_html(shown)


WRITERS: dict[type, Callable[[Any], str]] = {
    Check: _check,
    Deck: _deck,
    Results: _results,
    Linearization: _linearization,
    Comparison: _comparison,
    Chart: _chart,
}
