"""Equilibria: the one that is found is stable, or the results say that it is not."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import adamslite as al
from adamslite.analyses.statics import static
from adamslite.native import worker

PENDULUM = """a pendulum of length 1 at rest at {x}, {y}
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
PART/2, MASS=1, CM=2, IP=1,1,1, QG={x},{y},0
MARKER/2, PART=2
MARKER/3, PART=2, QP={px},{py},0
JOINT/1, REVOLUTE, I=3, J=1
SIMULATE/STATICS
END
"""


def rest(angle: float) -> al.Results:
    """The equilibrium found from this angle from the upright position."""
    x, y = np.sin(angle), np.cos(angle)
    results = al.simulate(al.read(PENDULUM.format(x=x, y=y, px=-x, py=-y)))
    assert results.outcome is al.Outcome.DONE
    return results


@pytest.mark.parametrize("angle", (0.3, 1.0, 2.0, 3.1))
def test_a_pendulum_comes_to_rest_below(angle):
    results = rest(angle)
    np.testing.assert_allclose(results["PART/2.y"][-1], -1.0, rtol=0, atol=1e-9)
    assert "equilibrium" not in results.meta


@pytest.mark.parametrize("angle", (0.0, 1e-3))
def test_upright_it_stays_and_the_results_say_so(angle):
    """Who starts at an unstable equilibrium means it: for LINEAR, for instance."""
    results = rest(angle)
    np.testing.assert_allclose(results["PART/2.y"][-1], 1.0, rtol=0, atol=1e-9)
    assert "unstable in one way" in results.meta["equilibrium"]


@pytest.mark.parametrize(
    ("first", "second", "ways"), [(-1, -1, 0), (1, -1, 1), (-1, 1, 1), (1, 1, 2)]
)
def test_every_link_that_stands_upright_is_a_way_to_fall(first: int, second: int, ways: int):
    """Two links, each hanging (-1) or upright (1), in balance from the start."""
    deck = f"""\
two links
PART/1, GROUND
MARKER/1
PART/2, MASS=2, CM=20, IP=0.1,0.1,0.1, QG=0,{first},0
MARKER/20
MARKER/21, QP=0,{-first},0
MARKER/22, QP=0,{first},0
PART/3, MASS=1, CM=30, IP=0.1,0.1,0.1, QG=0,{2 * first + second},0
MARKER/30
MARKER/31, QP=0,{-second},0
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=22
ACCGRAV/JGRAV=-9.81
SIMULATE/STATICS
END
"""
    note = al.simulate(al.read(deck)).meta.get("equilibrium", "")
    assert note.split(":")[0] == ("", "unstable in one way", "unstable in 2 ways")[ways]


def test_a_slack_line_hangs_down_though_newton_ends_in_a_folded_one():
    """Ten stiff sections between points 10 m apart, 11 m of line, drawn as two straight halves."""
    n, h = 10, 1.1
    lines = ["a line", "PART/1, GROUND", "MARKER/1, PART=1", f"MARKER/{n + 1}, PART=1, QP=10,0,0"]
    depth = np.sqrt(21) / 2
    for k in range(1, n):
        y = -2 * depth * min(k, n - k) / n
        lines += [f"POINT_MASS/{k + 1}, MASS=6, CM={k + 1}, QG={10 * k / n},{y},0"]
        lines += [f"MARKER/{k + 1}, POINT_MASS={k + 1}"]
    for k in range(1, n + 1):
        i, j = (k + 1, k) if k < n else (k, k + 1)
        lines += [f"SFORCE/{k}, TRANSLATIONAL, I={i}, J={j}, FUNCTION=-6E7*(DM({i},{j})/{h}-1)"]
    lines += ["ACCGRAV/JGRAV=-9.81", "SIMULATE/STATICS", "END", ""]
    results = al.simulate(al.read("\n".join(lines)))
    assert results.outcome is al.Outcome.DONE
    assert "equilibrium" not in results.meta
    heights = [results[f"POINT_MASS/{k + 1}.y"][-1] for k in range(1, n)]
    np.testing.assert_allclose(heights, heights[::-1], rtol=0, atol=1e-6)
    assert np.all(np.diff(heights[:5]) < 0)
    pulls = [results[f"SFORCE/{k}.f"][-1] for k in range(1, n + 1)]
    assert max(pulls) < 0


@pytest.mark.parametrize("stiffness", (1e9, 1e11))
def test_forces_balance_though_places_hardly_move(stiffness):
    """100 N on a spring of force k x^3: x = (100/k)^(1/3), and the forces balance to IMBALANCE."""
    deck = (
        "a hardening spring\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "POINT_MASS/2, MASS=1, CM=2, QG=0.02,0,0\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX=100-{stiffness}*DX(2)**3\\FY=-DY(2)\\FZ=-DZ(2)\n"
        "EQUILIBRIUM/IMBALANCE=1E-4\nSIMULATE/STATICS\nEND\n"
    )
    results = al.simulate(al.read(deck))
    assert results.outcome is al.Outcome.DONE
    x = results["POINT_MASS/2.x"][-1]
    assert abs(100 - stiffness * x**3) < 1e-4


@pytest.mark.parametrize("stiffness", [1e6, 1e9, 1e12])
def test_rounding_of_the_coordinates_is_no_lack_of_balance(stiffness: float) -> None:
    """1 kg on a spring from (0, 0) to about (180, -240): no place of 64 bits balances it to 1e-9 N
    where a unit in the last place, 3e-14, is 3e-14 k = 3e-5 N and more; the place is right all
    the same.
    """
    deck = f"""\
a stiff spring
ACCGRAV/JGRAV=-8\\ IGRAV=6
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=181,-241,0
MARKER/2, POINT_MASS=2
SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-{stiffness:g}*(DM(2,1)-300)
EQUILIBRIUM/ERROR=1E-9, IMBALANCE=1E-9
SIMULATE/STATICS
END
"""
    results = al.simulate(al.read(deck.replace("\\ ", ", ")))
    assert results.outcome is al.Outcome.DONE
    place = np.array([results[f"POINT_MASS/2.{c}"][-1] for c in "xyz"])
    expected = (300 + 10 / stiffness) * np.array([0.6, -0.8, 0])
    np.testing.assert_allclose(place, expected, rtol=0, atol=1e-12 * 300)


LOOSE = """\
a falling body
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=0,0,0
MARKER/2, POINT_MASS=2
EQUILIBRIUM/ERROR=1E-9, IMBALANCE=1E-9, TLIMIT=1E-3, MAXIT={most}
SIMULATE/STATICS
END
"""
ENDLESS = LOOSE.format(most=2_000_000_000)


def test_a_body_that_nothing_holds_has_no_equilibrium() -> None:
    """However small the steps that are tried: its weight stays."""
    results = al.simulate(al.read(LOOSE.format(most=25)))
    assert results.outcome is al.Outcome.NO_EQUILIBRIUM


def test_a_push_that_nothing_balances_ends_a_series_of_equilibria() -> None:
    """sin x = t/10 has no root beyond t = 10: nothing of an earlier time takes its place."""
    found = al.simulate("""a mass in a wave, pushed ever harder
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, QG=0.1,0,0, CM=2
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, JFLOAT=3, RM=1, FX=-SIN(DX(2))+TIME/10\\FY=-DY(2)\\FZ=-DZ(2)
MARKER/3, PART=1, FLOATING
SIMULATE/STATICS, END=12, STEPS=4
END
""")
    assert found.outcome is al.Outcome.NO_EQUILIBRIUM and "at t = 12," in found.message
    np.testing.assert_allclose(found.time, (0.0, 3.0, 6.0, 9.0))
    x = found["POINT_MASS/2.x"]  # to IMBALANCE over the least stiffness, cos x = 0.44
    np.testing.assert_allclose(x, np.arcsin(found.time / 10.0), rtol=0, atol=1e-4 / 0.43)


def test_a_search_of_few_unknowns_ends_by_ctrl_c(monkeypatch) -> None:
    al.simulate(al.read(LOOSE.format(most=25)))  # nothing is compiled below

    def pressed(self: worker.Worker[int], timeout: float) -> None:
        monkeypatch.undo()
        raise KeyboardInterrupt

    monkeypatch.setattr(worker.Worker, "wait", pressed)
    with pytest.raises(KeyboardInterrupt):
        al.simulate(al.read(ENDLESS))
    assert not worker.left_working()


def test_a_search_of_few_unknowns_ends_with_its_cpu() -> None:
    results = al.simulate(al.read(ENDLESS), cpu_limit=0.3)
    assert results.outcome is al.Outcome.CPU_LIMIT


def test_a_search_begun_again_is_the_same_search(monkeypatch) -> None:
    """Of 40 links, which take more iterations than the first try has."""
    deck = al.read(cantilever(40, 20.0, 1e7))
    usual = al.simulate(deck)
    monkeypatch.setattr(static, "SOON", 10**9)
    at_once = al.simulate(deck)
    assert (usual.values == at_once.values).all()


def test_what_cannot_be_ended_is_left(monkeypatch) -> None:
    """Linear algebra and compilers: nobody waits for them, and the process knows of them."""
    done = threading.Event()
    monkeypatch.setattr(worker, "GRACE", 0.01)
    with pytest.raises(worker.Overspent):
        worker.interruptible(done.wait, over=lambda: True)
    assert worker.left_working()
    done.set()
    worker._left[-1].wait(60.0)
    assert not worker.left_working()


def test_a_search_that_is_repeated_with_pivoting_is_no_longer_than_others(monkeypatch) -> None:
    """Its iterations cost the cube of its unknowns: 300 masses that nothing holds."""
    head, body = LOOSE.format(most=5).split("POINT_MASS/2", 1)[0], []
    for i in range(2, 302):
        body += [f"POINT_MASS/{i}, MASS=1, CM={i}, QG={i},0,0", f"MARKER/{i}, POINT_MASS={i}"]
    found = []
    searched = static.searched

    def seen(system, budget):
        control = static.Control(system.control)
        found.append((system.elimination.pivoting, system.nz, control.relaxations))
        return searched(system, budget)

    monkeypatch.setattr(static, "searched", seen)
    results = al.simulate(al.read("\n".join([head, *body, "SIMULATE/STATICS", "END\n"])))
    assert results.outcome is al.Outcome.NO_EQUILIBRIUM
    assert [pivoting for pivoting, _, _ in found] == [False, False, True]
    assert [most for _, _, most in found[:2]] == [static.RELAXATIONS] * 2
    _, unknowns, most = found[2]
    assert unknowns == 900 and 0 < most * unknowns**3 <= static.REPEATED


def cantilever(count: int, force: float, stretch: float) -> str:
    """BEAMs with EI = 1 in a straight row of 1 m, of masses of almost no inertia, under a force
    across the end.
    """
    h, mass, inertia = 1 / count, 1 / count, 1e-9 / count
    lines = ["A cantilever", "UNITS/SYSTEM=MKS", "PART/1, GROUND", "MARKER/1, PART=1"]
    for i in range(2, count + 2):
        lines += [
            f"PART/{i}, MASS={mass}, CM={i}, IP={inertia},{inertia},{inertia}",
            f", QG={(i - 1) * h},0,0",
            f"MARKER/{i}, PART={i}",
            f"BEAM/{i}, I={i}, J={i - 1}, LENGTH={h}, AREA=1, EMODULUS={stretch}",
            f", IXX={2 / stretch}, GMODULUS={stretch / 2}, IYY={1 / stretch}",
            f", IZZ={1 / stretch}, ASY=0, ASZ=0",
        ]
    lines += ["MARKER/999, PART=1, FLOATING", f"VFORCE/1, I={count + 1}, JFLOAT=999, RM=1, FX=0\\"]
    return "\n".join([*lines, f", FY={force}\\ FZ=0", "SIMULATE/STATICS", "END\n"])


@pytest.mark.parametrize(
    ("count", "force", "stretch", "along", "across"),
    [
        (20, 5.0, 1e6, 0.61230, 0.71379),
        (40, 20.0, 1e7, 0.3161, 0.8686),
        (40, 2.0, 1e8, 0.8394, 0.4935),
    ],
)
def test_a_slender_cantilever_bends_far_from_a_straight_start(
    count: int, force: float, stretch: float, along: float, across: float
) -> None:
    """The end of the elastica; a chain of BEAMs is off by some (P L^2/(EI n))^2/50."""
    results = al.simulate(al.read(cantilever(count, force, stretch)))
    assert results.outcome is al.Outcome.DONE
    slack = max((force / count) ** 2 / 50, 1e-3)
    assert results[f"PART/{count + 1}.x"][-1] == pytest.approx(along, abs=slack)
    assert results[f"PART/{count + 1}.y"][-1] == pytest.approx(across, abs=slack)
