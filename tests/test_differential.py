"""Methods against each other on random decks (`python -m benchmarks.differential`): none is off by
more than a thousandth of the travel and says nothing, and AUTO is right wherever a method is.
"""

from __future__ import annotations

import pytest
from tiers import fast

from benchmarks.differential import AUTO, RIGHT, SILENT, attempt

SEED, DECKS, GROUP = 1, 100, 4


@pytest.mark.parametrize("first", fast(range(0, DECKS, GROUP), 24))
def test_no_method_is_silently_wrong(first: int) -> None:
    reports = [attempt(number, SEED) for number in range(first, first + GROUP)]
    silent = [(r.title, j) for r in reports for j in r.judged if j.verdict == SILENT]
    assert not silent
    for report in reports:
        verdicts = {j.method: j.verdict for j in report.judged}
        others = [verdict for method, verdict in verdicts.items() if method != AUTO]
        if RIGHT in others:
            assert verdicts[AUTO] == RIGHT, report
    # Most decks have a motion that two methods agree upon.
    assert sum(bool(report.judged) for report in reports) >= GROUP // 2
