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
