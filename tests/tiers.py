"""Which cases of a test are in the fast tier."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def fast(cases: Iterable[Any], *names: Any) -> list[Any]:
    """All cases, of which only these are in the fast tier."""
    return [case if case in names else slow(case) for case in cases]


def slow(*values: Any, id: str | None = None) -> Any:
    """A case that is left out of the fast tier."""
    return pytest.param(*values, marks=pytest.mark.slow, id=id)


def every(step: int, cases: Iterable[Any]) -> list[Any]:
    """All cases, of which every so many is in the fast tier; tuples are several arguments."""
    given = (case if isinstance(case, tuple) else (case,) for case in cases)
    return [pytest.param(*case) if k % step == 0 else slow(*case) for k, case in enumerate(given)]
