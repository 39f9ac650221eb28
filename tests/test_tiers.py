"""The fast tier stays fast, and a test that is named runs in whatever tier it is."""

from __future__ import annotations

from types import SimpleNamespace

import conftest
import pytest


def marked(mark: str | None) -> SimpleNamespace:
    """A test with this mark, as far as the judge looks at it."""
    return SimpleNamespace(get_closest_marker=lambda name: mark if name == mark else None)


@pytest.mark.parametrize(("used", "mark"), [(4.9, None), (5.1, "slow"), (500.0, "slow")])
def test_time_that_is_allowed(used, mark):
    conftest.judge(marked(mark), used)


@pytest.mark.parametrize("mark", [None, "numerical"])
def test_a_test_of_the_fast_tier_that_is_not_fast_fails(monkeypatch, mark):
    monkeypatch.setattr(conftest, "slowness", lambda: 1.0)
    with pytest.raises(pytest.fail.Exception, match=r"5\.1 s of CPU.*@pytest\.mark\.slow"):
        conftest.judge(marked(mark), 5.1)


def test_a_slow_processor_is_allowed_for(monkeypatch):
    monkeypatch.setattr(conftest, "slowness", lambda: 2.0)
    conftest.judge(marked(None), 9.9)
    with pytest.raises(pytest.fail.Exception):
        conftest.judge(marked(None), 10.1)


@pytest.mark.parametrize(
    ("asked", "names", "chosen"),
    [
        ("not slow", ["tests/test_a.py::test_b"], ""),
        ("not slow", ["tests/test_a.py", "tests/test_a.py::test_b"], "not slow"),
        ("numerical", ["tests/test_a.py::test_b"], "numerical"),
    ],
)
def test_a_test_that_is_named_runs(asked, names, chosen):
    config = SimpleNamespace(option=SimpleNamespace(markexpr=asked), args=names)
    conftest.pytest_configure(config)
    assert config.option.markexpr == chosen
