"""What a run may spend: CPU, steps, and that it gets on; with what it has by then."""

from __future__ import annotations

import re
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from outcome_scenes import WHEN, ended_early, reason, with_integrator
from scenes import GROUND, chain, done, run

import adamslite as al
from adamslite import Outcome
from adamslite.analyses.dynamics import dynamic
from adamslite.analyses.setup import run_options
from adamslite.analyses.setup.output_times import spread_times
from adamslite.analyses.setup.run_options import LEAST_PATIENCE
from adamslite.cli.main import main
from adamslite.equations.system import System
from adamslite.errors import UsageError
from adamslite.native.worker import Worker

POINT = GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
METHODS = ("GSTIFF", "GSTIFF, I3", "HHT", "RADAU", "ABAM", "VERLET")
# Steps that a run of one mass may waste: a second of CPU, or so.
PATIENCE = 2_000_000

# A limit cycle of 6e-12 s, followed for a second.
CYCLE = POINT + (
    "DIFF/1, IC=1, FUNCTION=1E12*DIF(2)\n"
    "DIFF/2, IC=0, FUNCTION=1E12*((1-DIF(1)**2)*DIF(2)-DIF(1))\nEND\n"
)
# A stiffness 1e20 times too large beside one that is meant: 6e-13 s.
STIFF = POINT + (
    "VFORCE/1, I=2, J_PART=1, FX=-1E6*DX(2)\nVFORCE/2, I=2, J_PART=1, FX=-1E26*DX(2)\nEND\n"
)
# Twelve days, beginning with 1e5 rad/s.
DAYS = 1e6
FORCED = POINT + "VFORCE/1, I=2, J_PART=1, FX={}\nEND\n"
# A load of an amplitude and a frequency of which steps cannot pass a period.
SHAKEN = POINT + "VFORCE/1, I=2, J_PART=1, FX=1E26*SIN(1E13*TIME)\nEND\n"
# Nothing is looked further ahead than a delay.
DELAYED = POINT + (
    "VARIABLE/1, FUNCTION=VX(2)\nVFORCE/1, I=2, J_PART=1, FX=-DELAY(VARVAL(1),1E-12,0)\nEND\n"
)


def crept(deck: str, method: str) -> str:
    """Why a run over a second is ended as one that creeps."""
    results = ended_early(with_integrator(deck, method))
    assert results.outcome is Outcome.CREEPING, results.message
    assert results.summary["t_end"] < 1e-10 * PATIENCE
    assert results.time.tolist() == [0.0] and np.isfinite(results.values).all()
    assert "--max-steps" in results.outcome.value and "ERROR" in results.outcome.value
    return reason(results)


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_a_cycle_of_picoseconds_names_its_state(method: str) -> None:
    told = crept(CYCLE, method)
    found = re.fullmatch(
        rf"A{WHEN[1:]} and order \d, held by the error of DIFF/[12] \(.*\)\.", told
    )
    assert found, told


def test_of_two_springs_the_one_too_stiff_is_named() -> None:
    told = crept(STIFF, "ABAM")
    assert "held by the error of POINT_MASS/2 (<text>:4:1), " in told
    assert told.endswith("; of the forces there VFORCE/2 (<text>:7:1) changes most.")


def test_a_load_too_fast_is_named() -> None:
    told = crept(SHAKEN, "ABAM")
    assert told.endswith("; of the forces there VFORCE/1 (<text>:6:1) changes most.")


def test_a_delay_that_is_next_to_nothing_is_named() -> None:
    assert crept(DELAYED, "VERLET").endswith("held by its shortest DELAY: no step reaches further "
                                             "than that.")  # fmt: skip


def test_equal_steps_between_outputs_creep_too() -> None:
    """VERLET knows before an interval how many steps it takes: 16 million of 1.9e-10 s, which are
    no progress in 3 s.
    """
    deck = POINT + "VFORCE/1, I=2, J_PART=1, FX=-1E20*DX(2)\nEND\n"
    results = ended_early(with_integrator(deck, "VERLET"), 3.0, 1000)
    assert results.outcome is Outcome.CREEPING
    assert reason(results).endswith(
        "held by the vibration of POINT_MASS/2 (<text>:4:1), x, where VFORCE/1 (<text>:6:1) "
        "changes most."
    )


def test_steps_that_were_requested_do_not_creep(monkeypatch: pytest.MonkeyPatch) -> None:
    """20 000 steps of 1e-11 s, the first of a run of a second that is not followed to its end."""
    deck = POINT + "END\n"
    results = ended_early(with_integrator(deck, "GSTIFF, HMAX=1E-11"), max_steps=20_000)
    assert results.outcome is Outcome.STEP_LIMIT
    monkeypatch.setattr(run_options, "PATIENCE", 0)
    short = ended_early(with_integrator(deck, "GSTIFF, HMAX=1E-11"), cpu_limit=0.3)
    assert short.outcome is Outcome.CPU_LIMIT and short.summary["steps"] > LEAST_PATIENCE


@pytest.mark.parametrize("step", ("1E-9", "1E-11"))
def test_equal_steps_of_verlet_that_were_requested_do_not_creep(step: str) -> None:
    """Nor are they too short: they are below 1e-8 of an output step."""
    deck = with_integrator(POINT + "END\n", f"VERLET, HINIT={step}")
    results = ended_early(deck, max_steps=20_000)
    assert results.outcome is Outcome.STEP_LIMIT and "held by" not in results.message


def test_short_steps_that_are_stable_are_taken() -> None:
    """A spring of 2e6 rad/s, 60 million steps on the way to the first output: no HMIN is given."""
    deck = with_integrator(FORCED.format("-4E12*DX(2)"), "VERLET")
    results = ended_early(deck, 50.0, 1, cpu_limit=0.3)
    assert results.outcome is Outcome.CPU_LIMIT, results.message


def test_a_load_that_is_known_to_calm_down_is_no_creeping(monkeypatch: pytest.MonkeyPatch) -> None:
    """It turns 20 000 rad in all, most of them in the first 10 ns, whose steps keep its pace."""
    monkeypatch.setattr(run_options, "PATIENCE", 0)
    burst = "VFORCE/1, I=2, J_PART=1, FX=SIN(2E-5/(TIME+1E-9))\nEND\n"
    results = done(POINT + burst, 1.0, 10, integrator="ABAM")
    assert results.summary["steps"] > 1.5 * LEAST_PATIENCE


@pytest.mark.slow
def test_creeping_goes_on_for_as_many_steps_as_are_allowed() -> None:
    results = ended_early(with_integrator(CYCLE, "RADAU"), max_steps=PATIENCE)
    assert results.outcome is Outcome.STEP_LIMIT and results.summary["steps"] == PATIENCE


RINGS = FORCED.format("-1E10*(DX(2)-0.999)-2E2*VX(2)")
WORKS = FORCED.format("1E5*SIN(1E5*TIME)*STEP(TIME,0.9,1,1,0)")
STRIKES = FORCED.format("1E5*SIN(1E5*TIME)*IF(TIME-9E5:0,0,1)*IF(TIME-9E5-0.1:1,0,0)")


def test_a_vibration_that_dies_out_is_no_creeping(monkeypatch: pytest.MonkeyPatch) -> None:
    """It has a damping of 0.1 %: steps get longer all the time."""
    monkeypatch.setattr(run_options, "PATIENCE", 0)
    results = done(RINGS, DAYS, 10, integrator="RADAU")
    assert results.summary["steps"] > LEAST_PATIENCE


@pytest.mark.parametrize("method", ("GSTIFF", "RADAU", "ABAM"))
def test_a_second_of_fast_work_in_a_run_of_days_is_no_creeping(method: str) -> None:
    """Some 100 000 steps of microseconds, which take less than a second."""
    results = done(WORKS, DAYS, 10, integrator=method)
    assert results.summary["steps"] > 2 * LEAST_PATIENCE


def test_short_steps_are_weighed_against_those_before(monkeypatch: pytest.MonkeyPatch) -> None:
    """Some 12 000 of them behind 180 000 longer ones; without those, the same is too much."""
    monkeypatch.setattr(run_options, "PATIENCE", 0)
    assert done(STRIKES, DAYS, 200_000, integrator="RADAU").summary["steps"] > 210_000
    results = ended_early(STRIKES, DAYS, 100, integrator="RADAU")
    assert results.outcome is Outcome.CREEPING and results.summary["t_end"] > 8.9e5


@pytest.mark.parametrize("method", ("RKF45", "ABAM"))
def test_some_longer_steps_between_do_not_hide_that_it_creeps(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An explicit formula at the border of its stability tries longer steps now and then."""
    monkeypatch.setattr(run_options, "PATIENCE", 300_000)
    results = ended_early(RINGS, DAYS, 10, integrator=method, cpu_limit=30.0)
    assert results.outcome is Outcome.CREEPING and results.summary["steps"] < 400_000


SPRING = POINT + "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=100, LENGTH=0.5\nEND\n"


@pytest.mark.parametrize("method", METHODS)
def test_no_more_steps_are_taken_than_are_allowed(method: str) -> None:
    """What there is by then is what the whole run has."""
    deck = with_integrator(SPRING, f"{method}, HMAX=0.01")
    whole = done(deck, 10.0, 1000)
    results = ended_early(deck, 10.0, 1000, max_steps=150)
    assert results.outcome is Outcome.STEP_LIMIT
    assert 140 <= results.summary["steps"] <= 150
    rows = len(results.time)
    assert 1 < rows < len(whole.time)
    np.testing.assert_array_equal(results.values, whole.values[:rows])
    assert re.match(rf"A{WHEN[1:]} and order \d", reason(results))


def test_as_many_steps_as_a_run_takes_are_enough() -> None:
    steps = done(SPRING, 1.0, 10, integrator="RADAU").summary["steps"]
    assert done(SPRING, 1.0, 10, integrator="RADAU", max_steps=steps).summary["steps"] == steps


TWICE = SPRING.replace(
    "END\n", "SIMULATE/DYNAMIC, END=1, STEPS=100\nSIMULATE/DYNAMIC, END=2, STEPS=100\nEND\n"
)


def test_steps_of_all_analyses_count() -> None:
    results = ended_early(TWICE, None, None, integrator="GSTIFF", hmax=0.01, max_steps=150)
    assert results.outcome is Outcome.STEP_LIMIT and results.summary["steps"] == 150
    assert 1.0 < results.time[-1] < 2.0


def test_a_kinematic_analysis_counts_its_outputs() -> None:
    crank = (
        GROUND + "PART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\nJOINT/1, REVOLUTE, I=2, J=1\n"
    )
    crank += (
        "MOTION/1, JOINT=1, ROTATION, FUNCTION=TIME\nSIMULATE/KINEMATIC, END=1, STEPS=100\nEND\n"
    )
    results = ended_early(crank, None, None, max_steps=30)
    assert results.outcome is Outcome.STEP_LIMIT and results.summary["steps"] == 30
    np.testing.assert_allclose(results.time, np.linspace(0.0, 0.3, 31))


# Masses on hard springs, drawn far out: a first interval is tried with ever shorter steps.
DRAWN = POINT.replace("QG=1,0,0", "QG=0,0,9") + (
    "POINT_MASS/3, MASS=1, CM=3, QG=0,1,0\nMARKER/3, POINT_MASS=3\n"
    "SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-2E7*(DM(2,1)-1)\n"
    "SFORCE/2, TRANSLATIONAL, I=3, J=2, FUNCTION=-2E7*(DM(3,2)-1)\nEND\n"
)


def test_steps_that_become_shorter_in_one_interval_are_watched() -> None:
    """Tries that are refused end the time for which a run goes unwatched."""
    deck = with_integrator(DRAWN, "VERLET, ERROR=1E-12")
    run(deck, 1e-6, 1)  # nothing is compiled below
    results = ended_early(deck, 1.0, 1, cpu_limit=0.2)
    assert results.outcome is Outcome.CPU_LIMIT and results.summary["rejected"] > 0


# A top at 1e10 times its weight, of which an ERROR of 1e10 follows nothing: its step ends in a zone
# of the friction that is somewhere else at each try.
WILD_TOP = (
    GROUND
    + """ACCGRAV/KGRAV=-9.81E10
MARKER/10, PART=1, REULER=0.3,0.5,-0.4
PART/2, MASS=2, CM=22, IP=0.05,0.06,0.02, REULER=0.4,1.0,0.2, WX=2.0, WY=-1.0, WZ=3.0
, VX=-0.024752423353393827, VY=-0.39037679200274727, VZ=-0.54497089629059858
MARKER/2, PART=2
MARKER/22, PART=2, QP=0,0,0.3
JOINT/1, SPHERICAL, I=2, J=10
FRICTION/1, JOINT=1, MU_STATIC=0.5, MU_DYNAMIC=0.3, BALL_RADIUS=0.1, FRICTION_TORQUE_PRELOAD=0
, STICTION_TRANSITION_VELOCITY=0.1, MAX_STICTION_DEFORMATION=0.01
END
"""
)


@pytest.mark.parametrize("error", [1e10, 1e300])
def test_a_step_is_not_shortened_for_ever(error: float) -> None:
    """Each try was shorter by a millionth, and none was accepted, rejected or failed.  Of what such
    an ERROR accepts a value may be infinite.
    """
    limits = {"max_steps": 3000, "cpu_limit": 60}
    results = ended_early(WILD_TOP, 0.1, 3, integrator="ABAM", error=error, **limits)
    assert results.outcome in (Outcome.STEP_LIMIT, Outcome.NOT_FINITE), results.message


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_tries_that_are_shortened_count_towards_a_pause(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They are no steps; each change of the force takes one at least."""
    deck = POINT + "VFORCE/1, I=2, J_PART=1, FX=IF(DX(2)-0.5: 0, 0, -1)-DX(2)\nEND\n"
    integrate, systems = System.integrate, []

    def noted(system: System, entry: str) -> int:
        systems.append(system)
        return integrate(system, entry)

    monkeypatch.setattr(System, "integrate", noted)
    done(deck, 10.0, integrator=method)
    count = systems[-1].count
    assert count.events > 2
    assert count.tries >= count.steps + count.rejected + count.failures + count.events


@pytest.mark.parametrize("method", ("HHT", "ABAM", "VERLET"))
def test_an_audited_run_is_watched_from_its_first_step(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A step that is audited panel by panel takes 10 ms, and 700 of them were 6 s in the thread
    in which neither Ctrl-C nor a limit is heard.
    """
    integrate, threads = System.integrate, set()

    def noted(system: System, entry: str) -> int:
        threads.add(threading.current_thread())
        return integrate(system, entry)

    monkeypatch.setattr(System, "integrate", noted)
    deck = POINT + "VFORCE/1, I=2, J_PART=1, FX=-DX(2)\nEND\n"
    done(deck, 1.0, integrator=method)
    assert threads == {threading.main_thread()}
    threads.clear()
    done(deck, 1.0, integrator=method, audit=True)
    assert threads and threading.main_thread() not in threads


def test_an_interval_that_is_paused_goes_on_as_it_would(monkeypatch: pytest.MonkeyPatch) -> None:
    deck = with_integrator(DRAWN, "VERLET, ERROR=1E-6")
    whole = run(deck, end=1e-3, steps=2)
    monkeypatch.setattr(dynamic, "UNWATCHED", 100)
    paused = run(deck, end=1e-3, steps=2)
    counts = [[each.summary[word] for word in ("steps", "rejected")] for each in (whole, paused)]
    assert counts[0] == counts[1] and counts[0][1] > 0
    assert whole.values.tobytes() == paused.values.tobytes()


@pytest.mark.parametrize("method", METHODS)
def test_the_cpu_that_is_allowed_ends_a_run(method: str) -> None:
    deck = with_integrator(chain(4), f"{method}, HMAX=1E-6")
    results = ended_early(deck, 1e4, 1_000_000, cpu_limit=0.2)
    assert results.outcome is Outcome.CPU_LIMIT
    assert results.summary["t_end"] < 1e4 and np.isfinite(results.values).all()


@pytest.mark.parametrize(
    ("name", "value"),
    [("max_steps", 0), ("max_steps", 1.5), ("max_steps", np.nan), ("max_steps", "9")]
    + [("cpu_limit", 0.0), ("cpu_limit", -1), ("cpu_limit", np.nan), ("cpu_limit", "1")],
)
def test_a_limit_that_is_none_is_rejected(name: str, value: object) -> None:
    with pytest.raises(UsageError, match=f"{name}=.*: it must be a"):
        run(SPRING, 1.0, **{name: value})


def test_the_command_line_keeps_what_there_is(tmp_path: Path, capsys: Any) -> None:
    deck, out = tmp_path / "spring.adm", tmp_path / "out.csv"
    deck.write_text(SPRING)
    flags = ["--end", "10", "--steps", "1000", "--max-steps", "200", "--integrator", "GSTIFF"]
    assert main(["solve", str(deck), "-o", str(out), *flags]) == 4
    assert "as many steps as --max-steps allows" in capsys.readouterr().err
    kept = al.Results.load(out)
    assert 100 < len(kept.time) <= 201
    assert "STEP_LIMIT" in out.read_text()


def test_every_run_of_a_sweep_has_its_limits() -> None:
    """A spring of 1e6 N/m moves the mass through 1000 rad."""
    found = al.sweep(
        al.read(SPRING), {"SPRINGDAMPER/1.K": [1.0, 1e6]}, measures=["max POINT_MASS/2.x"],
        end=1.0, steps=5, max_steps=100, integrator="RADAU", workers=1,
    )  # fmt: skip
    assert list(found.outcomes) == ["DONE", "STEP_LIMIT"]


# Masses between stiff springs that fall for ever: an equilibrium is looked for for minutes.
LOOSE = GROUND + "ACCGRAV/JGRAV=-9.81\n"
for k in range(2, 602):
    x, y, z = k * 7919 % 13 * 0.05, k * 104729 % 17 * 0.05, k * 31 % 7 * 0.03
    LOOSE += f"POINT_MASS/{k}, MASS=1, CM={k}, QG={x},{y},{z}\nMARKER/{k}, POINT_MASS={k}\n"
    LOOSE += f"SPRINGDAMPER/{k}, TRANSLATIONAL, I={k}, J={max(3, k) - 1}, K=1E7, LENGTH=0.1\n"
LOOSE = LOOSE.replace("I=2, J=2", "I=2, J=3") + (
    "SIMULATE/INITIAL_CONDITIONS\nSIMULATE/STATIC\nEND\n"
)


def test_a_search_for_an_equilibrium_keeps_within_its_cpu() -> None:
    results = al.simulate(al.read(LOOSE), cpu_limit=0.5)
    assert results.outcome is Outcome.CPU_LIMIT and results.time.tolist() == [0.0]


# A saw of 500 000 teeth beside twenty switches, all found before the first step, in some 20 s.
TEETH = POINT + "VFORCE/1, I=2, J_PART=1, FX=MOD(TIME,1E-5)" + "".join(
    f"+IF(SIN({k}*TIME):0,0,1)" for k in range(1, 21)
) + "\nEND\n"  # fmt: skip


def test_a_search_for_edges_of_time_keeps_within_its_cpu() -> None:
    results = ended_early(TEETH, 5.0, 10, cpu_limit=1.0)
    assert results.outcome is Outcome.CPU_LIMIT and results.summary["steps"] == 0


def test_a_search_for_an_equilibrium_can_be_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the command before it gave is kept."""
    wait = Worker.wait

    def asked(self: Worker, timeout: float) -> None:
        wait(self, timeout)
        raise KeyboardInterrupt

    monkeypatch.setattr(Worker, "wait", asked)
    results = al.simulate(al.read(LOOSE))
    assert results.outcome is Outcome.INTERRUPTED and results.time.tolist() == [0.0]


@pytest.mark.parametrize("steps", [1, 7, 70_000, 200_000])
def test_output_times_are_made_some_at_a_time(steps: int) -> None:
    for start, end in ((0.0, 1.0), (0.3, 7e5), (0.0, 1e-300), (2.0, 2.0)):
        made = spread_times(start, end, steps, None)
        np.testing.assert_array_equal(made, np.linspace(start, end, steps + 1))
