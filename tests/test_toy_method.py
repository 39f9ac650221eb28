"""A method of integration in one file: this one declares it, solves decks with it and says so.

Symplectic Euler with equal steps h for point masses without constraints:

    u+ = u + h M^-1 f(t, q, u),     q+ = q + h u+
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from math import floor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import GROUND, PENDULUM

import adamslite as al
from adamslite.caching.folder import cache_folder
from adamslite.cli.main import main
from adamslite.equations import engine
from adamslite.errors import UsageError
from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.contract import (
    BROKEN_START,
    DONE,
    INTERRUPTED,
    SINGULAR_MASS,
    STEP_TOO_SMALL,
    Problem,
)
from adamslite.integrators.events.events import start_events
from adamslite.integrators.events.stops import is_stop, next_stop, present_stop
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.records import write_record
from adamslite.language.method import (
    CONSTRAINTS,
    FIXED,
    ROTATIONS,
    Method,
    declared,
    register,
    unregister,
)
from adamslite.native.translate import native
from adamslite.results.outcomes import Outcome
from adamslite.verification.variants import variants

# ---- the method ----------------------------------------------------------------------------------


@native
def euler(P: Problem, L: Plan) -> int:
    """From one output time or stop to the next; returns an outcome."""
    start_events(P, False, False)
    row, t = 0, P.times[0]
    while True:
        P.report.t = t
        if not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
            return BROKEN_START if row == 0 else SINGULAR_MASS
        if t == P.times[row]:
            write_record(P, row)
            track(P)
            row += 1
        if row == P.times.size:
            return DONE
        end = min(P.times[row], present_stop(P))
        outcome = march(P, L, t, end)
        if outcome != DONE:
            return outcome
        t = end
        if is_stop(P, t):
            P.count.events += 1
            next_stop(P, t)


@native
def march(P: Problem, L: Plan, start: float, end: float) -> int:
    """Equal steps of at most HINIT; returns an outcome."""
    count = int(0.0 - floor(1e-9 - (end - start) / P.settings.h_max))
    h = (end - start) / count
    P.report.h, P.report.order = h, 1
    for k in range(count):
        if P.settings.stop:
            return INTERRUPTED
        if k > 0 and not accelerations(P, L, start + k * h, P.q, P.u, P.a, P.z, P.rd):
            return SINGULAR_MASS
        P.report.t = start + k * h
        for i in range(P.sizes.n):
            P.u[i] += h * P.a[i]
            P.q[i] += h * P.u[i]
            if not abs(P.q[i]) < 1e200:
                return STEP_TOO_SMALL
        P.count.steps += 1
    return DONE


TOY = Method(
    names=("TOY", "TOY_EULER"),
    what="the symplectic formula of Euler with equal steps",
    suited="a look at what a method needs",
    entry=f"{__name__}.euler",
    order=1,
    family="Euler",
    explicit=True,
    cannot=(CONSTRAINTS, ROTATIONS),
    steps=FIXED,
    tests_velocities=False,
    arguments={
        "HMAX": "the step, unless HINIT is given",
        "HINIT": "the step, shortened to fit between output times",
        "ERROR": "-there is no error test",
    },
)

# ---- what it does --------------------------------------------------------------------------------


@pytest.fixture(autouse=True)
def registered() -> Iterator[None]:
    """All that a module of adamslite/integrators/methods does at its end."""
    register(TOY)
    yield
    unregister(TOY)


SPRING = (
    GROUND
    + """POINT_MASS/2, MASS={m}, CM=2, QG={x},0,0
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=-{k}*DX(2)\\FY={force}\\FZ=0
INTEGRATOR/{name}, HINIT={h}
SIMULATE/DYNAMIC, END={end}, STEPS={rows}
END
"""
)


def spring(name: str = "TOY", h: float = 0.01, force: str = "0", **more: Any) -> str:
    facts = {"m": 2.0, "k": 8.0, "x": 1.0, "end": 1.0, "rows": 10, **more}
    return SPRING.format(name=name, h=h, force=force, **facts)


def powers(m: float, k: float, x: float, h: float, each: int, rows: int) -> np.ndarray:
    """x and u after every ``each`` steps (rows + 1, 2): powers of the formula's matrix."""
    step = np.array([[1.0 - h * h * k / m, h], [-h * k / m, 1.0]])
    return np.array([np.linalg.matrix_power(step, each * r) @ (x, 0.0) for r in range(rows + 1)])


@pytest.mark.parametrize("name", ["TOY", "TOY_EULER", "toy"])
@pytest.mark.parametrize(
    ("m", "k", "x", "h", "each"), [(2.0, 8.0, 1.0, 0.01, 10), (0.5, 3.0, -2.5, 0.025, 4)]
)
def test_a_deck_is_solved_by_its_formula(name: str, m, k, x, h, each) -> None:
    found = al.simulate(al.read(spring(name, h, m=m, k=k, x=x)))
    assert found.outcome is Outcome.DONE
    assert found.summary["steps"] == 10 * each
    expected = powers(m, k, x, h, each, 10)
    np.testing.assert_allclose(found["POINT_MASS/2.x"], expected[:, 0], rtol=1e-11)
    np.testing.assert_allclose(found["POINT_MASS/2.vx"], expected[:, 1], rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(found["POINT_MASS/2.ax"], -k / m * expected[:, 0], rtol=1e-11)


def test_its_error_falls_with_the_first_power_of_the_step() -> None:
    off = [
        np.abs(found["POINT_MASS/2.x"] - np.cos(2.0 * found.time)).max()
        for found in (al.simulate(al.read(spring(h=h))) for h in (1e-2, 1e-3))
    ]
    assert off[0] / off[1] == pytest.approx(10.0, rel=0.05)


def test_its_steps_end_where_a_force_jumps() -> None:
    """4 N on 2 kg from 0.437 on: v = 2 (t - 0.437), exactly, because every step sees one force."""
    found = al.simulate(al.read(spring(force="IF(TIME-0.437:0,0,4)")))
    expected = 2.0 * np.maximum(0.0, found.time - 0.437)
    np.testing.assert_allclose(found["POINT_MASS/2.vy"], expected, atol=1e-12)


def test_a_flag_asks_for_it(tmp_path: Path, capsys) -> None:
    deck = tmp_path / "a.adm"
    deck.write_text(spring("GSTIFF"))
    output = str(tmp_path / "a.csv")
    assert main(["solve", str(deck), "--integrator", "toy", "-o", output]) == 0
    found = al.Results.load(output)
    assert found.meta["integrator"].startswith("TOY I3")
    expected = powers(2.0, 8.0, 1.0, 0.01, 10, 10)
    np.testing.assert_allclose(found["POINT_MASS/2.x"], expected[:, 0], rtol=1e-11)


def test_what_it_cannot_follow_is_rejected() -> None:
    scene = al.read(PENDULUM.replace("END", "INTEGRATOR/TOY, HINIT=0.01\nEND"))
    with pytest.raises(UsageError, match="TOY cannot run this scene: JOINT/1 is a constraint"):
        al.simulate(scene, end=1.0, steps=10)


def test_arguments_that_it_does_not_use_are_reported() -> None:
    deck = al.read(GROUND + "INTEGRATOR/TOY, HINIT=0.1, KMAX=3, ERROR=1E-3\nEND\n")
    told = {d.message.split()[0]: d.hint for d in al.check(deck) if d.code == "no-effect"}
    assert told == {"KMAX": "its formula does not use it", "ERROR": "there is no error test"}


def test_messages_and_manual_know_it(capsys) -> None:
    with pytest.raises(al.DeckError, match="TOY"):
        al.read(GROUND + "INTEGRATOR/TOI\nEND\n")
    with pytest.raises(UsageError, match="integrator='TOI': there are .*TOY, TOY_EULER"):
        al.simulate(al.read(spring("AUTO")), integrator="TOI")
    for name in ("integrators", "toy", "INTEGRATOR"):
        assert main(["help", name]) == 0
        page = capsys.readouterr().out
        assert "TOY" in page, name
    assert "TOY" not in {variant.integrator for variant in variants()}


def test_its_code_is_kept_under_a_name_that_covers_this_file() -> None:
    """Everything that is compiled is part of the key, wherever it was written."""
    al.simulate(al.read(spring()))
    assert "test_toy_method.march" in engine.engine_parts(TOY.entry).often
    assert [*cache_folder().glob("euler*.o")]


def test_the_page_for_contributors_shows_this_method() -> None:
    page = (Path(__file__).parent.parent / "docs" / "contributing.md").read_text(encoding="utf-8")
    assert all(inspect.getsource(function) in page for function in (euler, march))


@pytest.mark.parametrize("names", [("TOY",), ("OTHER", "GSTIFF"), ("AUTO",)])
def test_a_name_belongs_to_one_method(names: tuple[str, ...]) -> None:
    before = declared()
    with pytest.raises(ValueError, match=f"integrator {names[-1]} is registered twice"):
        register(Method(names, "", "", TOY.entry, 1, "", True))
    assert declared() == before


def test_an_argument_that_there_is_not_is_a_mistake_of_the_method() -> None:
    with pytest.raises(ValueError, match="OTHER: INTEGRATOR has no HMXA"):
        register(Method(("OTHER",), "", "", TOY.entry, 1, "", True, {"HMXA": "the step"}))
