"""Reference decks that take less than a second, of every kind; `adamslite verify` solves all."""

from __future__ import annotations

import pytest
from tiers import slow

from adamslite.cli.main import main
from adamslite.resources import find

#: Largest share of a tolerance that may be used, as in .ci/run.
SHARE = 0.8
FOLDERS = (
    "andrews",
    "arrays",
    "beam-string",
    "bricard",
    "bushing",
    "cable-level3-n10",
    "cables/axial-echo",
    "cam",
    "car-axis",
    "chrono",
    "conical-pendulum",
    "contact/bouncing-ball",
    "contact/cradle",
    slow("contact/incline"),  # two contacts, whose expressions take seconds to compile
    "contact/resting",
    "contact/rolling-sphere",
    "contact/top",
    "four-bar",
    "friction-ball",
    "friction-stiction",
    "delayed-brake",
    "gforce-pair",
    "growing-mass-dalembert",
    "growing-mass-singular",
    "hanging-mass",
    "heavy-top",
    "nforce",
    "paper-sforce",
    "pendulum-gcon",
    "pid-winch",
    "replay",
    "slider-crank",
    "sliding-mass",
    "splines",
    "spring-pendulum",
    "three-joint-coupler",
    "transfer-functions",
    "user-routine",
    "view-crank",
)


@pytest.mark.parametrize("folder", FOLDERS)
def test_a_reference_is_met(folder: str, capsys: pytest.CaptureFixture[str]) -> None:
    code = main(["verify", str(find("decks") / folder), "-j", "1", "--share", str(SHARE)])
    assert code == 0, capsys.readouterr().out
