"""Through postures in which constraints lose rank: a row of four parallelograms that flattens at
every half turn.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tiers import every

import adamslite
from adamslite.analyses.initial.redundancy import badly_chosen
from adamslite.analyses.session.session import Session
from adamslite.results.outcomes import Outcome
from benchmarks import decks, mechanisms
from benchmarks.peers.ours import four_bar_energy
from benchmarks.reference import four_bar


@pytest.fixture(scope="module")
def kernels():
    return adamslite.compile_model(adamslite.assemble(adamslite.read(decks.deck("S4", 4))))


@pytest.mark.parametrize(
    ("error", "allowed"),
    every(3, [(1e-4, 2.0), (1e-6, 0.08), (2e-7, 0.02), (2e-8, 0.004), (1e-8, 0.003)]),
)
def test_ninety_seven_flattened_postures(kernels, error: float, allowed: float) -> None:
    """The angle after ten seconds against a tight reference; an error of 1e-8 in a speed of 30
    grows to some 1e-3 rad on the way.
    """
    results = adamslite.simulate(kernels, end=10.0, steps=10, error=error, hmax=1.0)
    assert results.outcome is Outcome.DONE, results.message
    turned = four_bar(4)[0] - np.pi / 2  # counted from the vertical
    assert results["REQUEST/1.F2"][-1] == pytest.approx(turned, abs=allowed)


@pytest.mark.parametrize("error", every(2, [1e-3, 1e-5, 1e-7]))
def test_hht_passes_them_too(kernels, error: float) -> None:
    results = adamslite.simulate(
        kernels, end=10.0, steps=10, error=error, hmax=1.0, integrator="HHT"
    )
    assert results.outcome is Outcome.DONE, results.message


@pytest.mark.parametrize("error", every(3, [1e-4, 1e-5, 1e-6, 1e-7, 3e-8, 1.7e-8, 1e-8]))
def test_the_explicit_formula_keeps_the_energy_through_them(kernels, error: float) -> None:
    """A relative error e of the energy is e/2 of the speed and e/2 of the 300 rad turned, so the
    angle is known to 150 e: at ERROR = 1e-6 the energy has to be right within 1e-4.
    """
    results = adamslite.simulate(
        kernels, end=10.0, steps=1, error=error, hmax=1.0, integrator="RKF45"
    )
    assert results.outcome is Outcome.DONE, results.message
    energy, known = four_bar_energy(results, 4), four_bar(4)[1]
    drift = abs(energy / known - 1.0)
    assert drift < 100.0 * error
    turned = four_bar(4)[0] - np.pi / 2
    assert results["REQUEST/1.F2"][-1] == pytest.approx(turned, abs=150.0 * max(drift, error))


def parallelogram(rate: float = -1.0) -> str:
    """The deck of the flattened parallelogram, its cranks started at ``rate``."""
    deck = (mechanisms.DECKS / "torture/flattened/parallelogram.adm").read_text()
    for old, new in (("WZ=-1", rate), ("VX=0.5", -0.5 * rate), ("VX=1", -rate)):
        deck = deck.replace(old, f"{old.partition('=')[0]}={new}")
    return deck


@pytest.mark.parametrize(
    ("rate", "hmax", "error"),
    [
        (-1.0, 0.003, 1e-8),
        (-1.0, 0.005, 1e-8),
        (0.7, 0.002, 1e-8),
        (-1.3, 0.004, 1e-8),
        (-1.3, 0.006, 1e-8),
        (-1.0, 0.008, 1e-8),
        (1.1, 0.01, 1e-8),
        (1.4, 0.0015, 1e-8),
        (-1.3, 0.003, 1e-8),
        (1.1, 0.003, 1e-8),
        (2.7, 0.003, 1e-8),
        (0.9, 0.003, 1e-9),
        (1.7, 0.006, 1e-9),
        (1.4, 0.004, 1e-10),
        (0.9, 0.002, 1e-9),
        (1.1, 0.003, 1e-9),
        (2.1, 0.002, 1e-10),
    ],
)
def test_a_flattened_parallelogram_stays_one_or_stops(
    rate: float, hmax: float, error: float
) -> None:
    """ABAM: (2/3 + 1) a" = -2 g cos a, cranks parallel, or a named stop.

    Runs have left the branch in three ways: the projection moved further than a step may err; steps
    that became ever shorter walked into the posture; after a stall other rows were left out there.
    Steps of the last three runs end, unless that is forbidden, where round-off decides the branch.
    """
    results = adamslite.simulate(
        adamslite.read(parallelogram(rate)),
        end=5.0, steps=50, integrator="ABAM", error=error, hmax=hmax,
    )  # fmt: skip
    assert results.outcome in (Outcome.DONE, Outcome.NEWTON_FAILED)
    assert np.abs(results["VARIABLE/skew"]).max() < 1e-4
    assert np.ptp(results["VARIABLE/energy"]) < 1e-3


@pytest.mark.slow
def test_most_runs_pass_the_flat_posture() -> None:
    """Stages are projected there: six of eight do; with stages that drift off at most one."""
    done = 0
    for rate in (-1.0, -0.7, -1.3, 0.5, 0.7, 1.1, 1.4, 0.9):
        results = adamslite.simulate(
            adamslite.read(parallelogram(rate)),
            end=5.0, steps=50, integrator="ABAM", error=1e-8, hmax=0.004,
        )  # fmt: skip
        done += results.outcome is Outcome.DONE
    assert done >= 4


@pytest.mark.parametrize(("angle", "drop", "wrong"), [
    (1.0, 0, False), (1e-5, 0, False), (0.0, 0, False), (1.0, 1, True),
])  # fmt: skip
def test_other_rows_are_left_out_only_when_those_kept_depend(angle, drop, wrong) -> None:
    """Cranks at an angle to the base: near 0 all rows lose rank, so no other choice is better.

    12 of 20 rows are independent; with an independent one left out instead of a redundant one (1)
    those kept have 11.
    """
    c, s = np.cos(angle), np.sin(angle)
    deck = parallelogram().replace("90D", repr(float(angle))).replace("QG=0,1,0", f"QG={c},{s},0")
    session = Session(adamslite.read(deck), None, {})
    system = session.system
    kept = [row for row in range(system.m) if row not in system.elimination.dropped]
    if drop:
        system.drop([kept[0], *system.elimination.dropped[1:]])
    assert badly_chosen(system) is wrong


def row(
    spans: tuple[float, ...], length: float, angle: float, rate: float, end: str, torque: float
) -> tuple[str, float, float]:
    """A row of parallelograms: uniform cranks of 1 kg on the ground, couplers of 2 kg that join one
    to the next by a REVOLUTE and by ``end``; ``torque`` on the first.  With its inertia and the
    moment of its weight about the crank: J a" = torque - w cos a.
    """
    e = length * np.array([np.cos(angle), np.sin(angle)])
    vx, vy = -e[1] * rate, e[0] * rate
    lines = ["A row of parallelograms", "UNITS/SYSTEM=MKS", "ACCGRAV/JGRAV=-9.81", "PART/1, GROUND"]
    for k, x in enumerate([0.0, *np.cumsum(spans)]):
        inertia = length**2 / 12
        lines += [
            f"MARKER/{k + 1}, PART=1, QP={float(x)!r},0,0",
            f"PART/{10 + k}, MASS=1, CM={10 + k}2, IP=0.01,{inertia!r},{inertia!r}",
            f", QG={float(x)!r},0,0, REULER={angle!r},0,0",
            f", VX={float(vx) / 2!r}, VY={float(vy) / 2!r}, WZ={rate!r}",
            f"MARKER/{10 + k}0, PART={10 + k}\nMARKER/{10 + k}1, PART={10 + k}, QP={length!r},0,0",
            f"MARKER/{10 + k}2, PART={10 + k}, QP={length / 2!r},0,0",
            f"JOINT/{k + 1}, REVOLUTE, I={10 + k}0, J={k + 1}",
        ]
    for k, (x, span) in enumerate(zip(np.cumsum([0.0, *spans]), spans, strict=False)):
        inertia = 2 * span**2 / 12
        lines += [
            f"PART/{30 + k}, MASS=2, CM={30 + k}2, IP=0.01,{inertia!r},{inertia!r}",
            f", QG={float(x + e[0])!r},{float(e[1])!r},0, VX={float(vx)!r}, VY={float(vy)!r}",
            f"MARKER/{30 + k}0, PART={30 + k}\nMARKER/{30 + k}1, PART={30 + k}, QP={span!r},0,0",
            f"MARKER/{30 + k}2, PART={30 + k}, QP={span / 2!r},0,0",
            f"JOINT/{100 + k}, REVOLUTE, I={30 + k}0, J={10 + k}1",
            f"{end}, I={30 + k}1, J={11 + k}1".replace("/", f"/{200 + k}, "),
        ]
    lines += [
        f"SFORCE/1, ROTATIONAL, I=100, J=1, FUNCTION={torque!r}",
        f"REQUEST/1, F2=AZ(100,1)\\, F3=AZ({10 + len(spans)}0,1)",
        "END",
    ]
    cranks, couplers = len(spans) + 1, 2 * len(spans)
    weight = 9.81 * length * (cranks / 2 + couplers)
    return "\n".join(lines) + "\n", length**2 * (cranks / 3 + couplers), weight


@pytest.mark.numerical
@pytest.mark.parametrize(
    ("spans", "length", "angle", "rate", "end", "torque"),
    [
        ((0.8, 1.3), 0.6, 0.9, 7.0, "JOINT/REVOLUTE", 4.0),
        ((1.1, 0.9, 1.6, 0.7), 1.2, 2.0, -5.0, "JPRIM/INLINE", -30.0),
    ],
)
@pytest.mark.parametrize(("error", "allowed"), [(1e-4, 2e-4), (1e-6, 2e-6)])
def test_radau_passes_flattened_rows_of_parallelograms(
    spans, length, angle, rate, end, torque, error: float, allowed: float
) -> None:
    """All cranks turn as the one pendulum does, through seven and five flattened postures."""
    text, inertia, weight = row(spans, length, angle, rate, end, torque)
    known = solve_ivp(
        lambda t, y: [y[1], (torque - weight * np.cos(y[0])) / inertia],
        (0, 3.0), [angle, rate], method="DOP853", rtol=1e-12, atol=1e-12,
    ).y[0]  # fmt: skip
    assert np.ptp(np.floor(known / np.pi)) >= 4
    results = adamslite.simulate(
        adamslite.read(text), end=3.0, steps=30, error=error, integrator="RADAU"
    )
    assert results.outcome is Outcome.DONE, results.message
    assert results["REQUEST/1.F2"][-1] == pytest.approx(known[-1], abs=allowed)
    assert results["REQUEST/1.F3"][-1] == pytest.approx(known[-1], abs=allowed)


@pytest.mark.numerical
def test_radau_keeps_the_energy_of_the_flattened_parallelogram() -> None:
    """Ten seconds and its flattened postures at ERROR = 1e-6."""
    results = adamslite.simulate(
        adamslite.read(parallelogram()), end=10.0, steps=100, integrator="RADAU", error=1e-6
    )
    assert results.outcome is Outcome.DONE, results.message
    assert np.abs(results["VARIABLE/skew"]).max() < 1e-8
    assert np.ptp(results["VARIABLE/energy"]) < 1e-5
