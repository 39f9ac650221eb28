"""A run that is confirmed by two others: verdict, bounds, exit code."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from scenes import GROUND, PENDULUM, SPRING, run

from adamslite.analyses import simulation
from adamslite.analyses.findings.confirmation import confirmation
from adamslite.cli.main import main
from adamslite.resources import find
from adamslite.results.confirmation import Channel, Confirmation
from adamslite.results.outcomes import Outcome
from adamslite.scene import load_scene, run_scene
from benchmarks.bounds import judge, known
from benchmarks.closed_forms import FAMILIES

FALL = PENDULUM.replace("JOINT/1, REVOLUTE, I=3, J=1\n", "")


@pytest.mark.parametrize("error", (1e-3, 1e-6))
@pytest.mark.parametrize("method", ("GSTIFF", "RADAU", "HHT", "RKF45", "VERLET"))
def test_the_bounds_of_a_vibration_hold_its_closed_form(method, error):
    """x = 1 + cos 2t."""
    results = run(SPRING, 5.0, 50, integrator=method, error=error, confirm=True)
    found, t = results.confirmation, results.time
    assert found.confirmed or error > 1e-6, found.verdict
    for name, exact in (("x", 1.0 + np.cos(2 * t)), ("vx", -2 * np.sin(2 * t))):
        channel = found[f"POINT_MASS/2.{name}"]
        off = np.abs(results[channel.name] - exact).max()
        assert off <= channel.bound <= 100.0 * max(off, error)
    assert results.summary["confirmed"] is found.confirmed
    assert len({each.split()[0] for each in found.witnesses}) == 2


@pytest.mark.parametrize("number", range(len(FAMILIES)))
def test_bounds_contain_the_exact_value(number):
    """One deck of each family; all 300 by `python -m benchmarks.bounds`."""
    found = judge(number, 7)
    assert found.channels and not found.missed, (known(number, 7), found)


@pytest.mark.parametrize(("width", "force"), [(0.2, 50), (0.4, -40)])
def test_what_a_run_missed_is_not_confirmed(width, force):
    """A Gaussian of the place on a way of 100 m has no guard that leads to it; witnesses take
    shorter steps.  v^2 = 100 + 2 force width sqrt(pi) behind it.
    """
    deck = (
        GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=10\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX={force}*EXP(-((DX(2)-5)/{width})**2)\nEND\n"
    )
    results = run(deck, 10.0, 10, integrator="GSTIFF", error=1e-3, confirm=True)
    exact = np.sqrt(100.0 + 2.0 * force * width * np.sqrt(np.pi))
    channel, found = results.confirmation["POINT_MASS/2.vx"], results["POINT_MASS/2.vx"][-1]
    assert abs(found - exact) <= channel.bound
    assert results.confirmation.confirmed == channel.agrees


def test_a_run_that_differs_from_its_witnesses_says_by_how_much():
    """A falling mass against the same with a weight that is 2 % off."""
    results = run(FALL, 1.0, 10)
    light = FALL.replace("9.81", "9.6138")

    def again(**options):
        return run(light, 1.0, 10, **options)

    found = confirmation(results, Settings(), again)
    channel = found["PART/2.y"]
    assert not found.confirmed and channel.bound == pytest.approx(2 * 0.5 * 9.81 * 0.02, rel=1e-3)
    assert channel.digits == pytest.approx(-np.log10(channel.bound / channel.size))
    assert "NOT CONFIRMED" in found.verdict and "PART/2.y may be off by" in found.verdict


def test_witnesses_end_their_steps_at_times_of_their_own():
    """What is passed between the same places three times is not confirmed by that."""
    results, longest = run(FALL, 1.0, 10), []

    def again(**options):
        longest.append(options["hmax"])
        return run(FALL, 1.0, 10, **options)

    confirmation(results, Settings(), again)
    own, other = longest
    assert other < own < 0.9e-3
    assert min(abs(own / other * k - round(own / other * k)) for k in range(1, 6)) > 0.02


confirmed = simulation._confirmed


class Settings:
    """What a run asked for."""

    method, formulation, error, hmax = "GSTIFF", "SI2", 1e-3, None


def test_witnesses_that_end_otherwise_confirm_nothing():
    results = run(FALL, 1.0, 10)

    def again(**options):
        return run(FALL, 0.5, 10, **options).__class__(
            time=np.zeros(1), names=results.names, values=results.values[:1],
            meta=results.meta, outcome=results.outcome, summary={"t_end": 0.5},
        )  # fmt: skip

    found = confirmation(results, Settings(), again)
    assert not found.confirmed and "ends with DONE at t = 0.5" in found.verdict
    assert found["PART/2.y"].bound == np.inf


@pytest.mark.parametrize("early", [False, True])
def test_an_interrupted_witness_is_the_last_one(early, tmp_path, monkeypatch, capsys):
    """The results are written, and the command ends as one that was interrupted."""
    asked = []

    def interrupted(call, **options):
        asked.append(options)
        if early:
            raise KeyboardInterrupt
        return replace(call(**options), outcome=Outcome.INTERRUPTED)

    monkeypatch.setattr(
        simulation, "_confirmed",
        lambda results, session, again: confirmed(results, session, partial(interrupted, again)),
    )  # fmt: skip
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(FALL)
    assert main(["solve", "a.adm", "--end", "1", "--steps", "10", "--confirm"]) == 4
    assert len(asked) == 1 and Path("a.csv").read_text().count("\n1.0,1.0,-4.9") == 1
    assert "interrupted" in (told := capsys.readouterr().err.casefold()), told


@pytest.mark.parametrize(("shown", "code"), [("9.81", 0), ("chaos", 1)])
def test_the_exit_code_is_that_of_the_verdict(shown, code, tmp_path, monkeypatch, capsys):
    """A fall is confirmed; x'' = 25 x, off by e^25 of a digit at the end, is not."""
    deck = FALL
    if shown == "chaos":
        deck = (
            GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0, VX=-5\nMARKER/2, POINT_MASS=2\n"
            "VFORCE/1, I=2, J_PART=1, FX=25*DX(2)\nEND\n"
        )
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(deck)
    assert main(["solve", "a.adm", "--end", "5", "--steps", "10", "--confirm"]) == code
    told = capsys.readouterr().err
    assert "digits  +-" in told and ("NOT CONFIRMED" in told) == bool(code)


@pytest.mark.parametrize("name", ("screw-jack/screw-jack", "atwood/atwood-coupler"))
@pytest.mark.slow
def test_round_off_and_angles_that_mean_nothing_are_no_objections(name):
    """theta = 0; places of 1e-28."""
    deck = find("decks") / name.split("/")[0] / f"{name.split('/')[-1]}.adm"
    found = run_scene(load_scene(deck), {"error": 1e-8, "confirm": True}).confirmation
    assert found.confirmed, found.verdict


def test_the_verdict_leaves_out_what_is_zero_but_for_rounding() -> None:
    """2.5 digits of a position; a velocity of 1e-32 that is off by as much has none, and may."""
    channels = (
        Channel("PART/2.x", bound=10**-2.5, size=1.0, loose=1e-9),
        Channel("PART/2.vy", bound=1e-32, size=1e-32, loose=1e-9),
    )
    found = Confirmation(channels, ("RADAU SI2 ERROR=1e-08",), ())
    assert found.verdict == "confirmed by RADAU SI2 ERROR=1e-08: 2.5 digits or more agree"
