"""The formula of four stages that ABAM and RKF45 take for point masses by component."""

from __future__ import annotations

import numpy as np
import pytest

from adamslite import read, simulate
from adamslite.analyses.dynamics import dynamic
from adamslite.equations import system as equations
from adamslite.integrators.explicit.nystrom import NODES, Q_SCALE, STAGES, U_SCALE
from tests.test_lanes import BY_COMPONENT, chain, growing

C = np.array(NODES)
A, B = (np.array([[STAGES[i].get(j, (0, 0))[k] for j in range(4)] for i in range(4)])
        for k in (0, 1))  # fmt: skip
WEIGHTS, TWICE = A[3], B[3]
A, B = (np.vstack((np.zeros(4), of[:3])) for of in (A, B))

#: Hairer, Norsett, Wanner, Solving ODE I, section II.14: trees up to order 4, of u and of q.
CONDITIONS = {
    "rows of A": (A.sum(1), C),
    "rows of B": (B.sum(1), C**2 / 2),
    "u, powers": (WEIGHTS @ np.vander(C, 4, increasing=True), 1 / np.arange(1, 5)),
    "u, A": (WEIGHTS @ A @ C, 1 / 6),
    "u, c A": ((WEIGHTS * C) @ A @ C, 1 / 8),
    "u, A c^2": (WEIGHTS @ A @ C**2, 1 / 12),
    "u, A A": (WEIGHTS @ A @ A @ C, 1 / 24),
    "u, B": (WEIGHTS @ B @ C, 1 / 24),
    "q, powers": (TWICE @ np.vander(C, 3, increasing=True), [1 / 2, 1 / 6, 1 / 12]),
    "q, A": (TWICE @ A @ C, 1 / 24),
}


@pytest.mark.parametrize("what", CONDITIONS)
def test_the_conditions_of_order_four(what):
    found, needed = CONDITIONS[what]
    np.testing.assert_allclose(found, needed, rtol=0, atol=1e-15)


def step(w: float, damping: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """q, u after a step of one of q" = -w^2 q - 2 damping w q', and the error estimate."""
    rate = np.array([-w * w, -2 * damping * w])
    k: list[float] = []
    for i in range(4):
        q = y[0] + C[i] * y[1] + sum(B[i, j] * each for j, each in enumerate(k))
        u = y[1] + sum(A[i, j] * each for j, each in enumerate(k))
        k.append(rate @ (q, u))
    end = np.array([y[0] + y[1] + TWICE @ k, y[1] + WEIGHTS @ k])
    last = rate @ end
    of_q, of_u = 2 * k[1] - k[0] - k[2], 4 * last - k[0] + 3 * (k[1] - k[2] - k[3])
    return end, np.abs((of_q / Q_SCALE, of_u / U_SCALE))


@pytest.mark.parametrize(("damping", "bound"), [(0.0, 4.99), (0.05, 4.46), (0.3, 2.8)])
def test_vibrations_are_stable_as_far_as_is_said(damping: float, bound: float):
    def growth(w: float) -> float:
        columns = [step(w, damping, e)[0] for e in np.eye(2)]
        return np.abs(np.linalg.eigvals(np.transpose(columns))).max()

    assert max(growth(w) for w in np.linspace(0.01, bound, 2000)) <= 1 + 1e-6
    assert growth(1.02 * bound) > 1


@pytest.mark.parametrize("w", [0.1, 0.3, 1.0, 2.0, 3.0, 4.0])
def test_the_estimate_is_ten_times_above_the_error_of_a_vibration(w: float):
    worst = np.zeros((2, 2))
    for angle in np.linspace(0, np.pi, 50):
        end, estimate = step(w, 0.0, np.array([np.cos(angle), -w * np.sin(angle)]))
        error = np.abs(end - [np.cos(angle + w), -w * np.sin(angle + w)])
        worst = np.maximum(worst, (error, estimate))
    assert (10 * worst[0] < worst[1]).all()


def run(text: str, settings: str, end: float = 0.5):
    return simulate(read(f"{text}INTEGRATOR/ABAM, {settings}\nEND\n"), end=end, steps=10)


@pytest.mark.parametrize("scene", [each for each in BY_COMPONENT if each != "net"])
def test_the_error_follows_the_tolerance(scene):
    """... at every record, most of which lie within a step.  The net is chaotic."""
    known = run(BY_COMPONENT[scene], "ERROR=1E-11").values
    size = np.maximum(1.0, np.abs(known).max(axis=0))
    off = {error: (np.abs(run(BY_COMPONENT[scene], f"ERROR={error}").values - known) / size).max()
           for error in (1e-3, 1e-5, 1e-7)}  # fmt: skip
    assert off[1e-3] < 2e-2
    assert off[1e-5] < 5e-4
    assert off[1e-7] < 1e-5


def test_light_demands_take_as_many_evaluations_as_stability_needs(monkeypatch):
    """The fastest of 40 equal masses and springs turns 2 sqrt(k/m) = 200 rad in a unit of time."""
    text = "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\n"
    for i in range(2, 42):
        text += f"POINT_MASS/{i}, MASS=1, CM={i}, QG={i - 1},0,0\nMARKER/{i}, POINT_MASS={i}\n"
        law = f"-10000*(DM({i},{i - 1})-1)-0.1*VR({i},{i - 1})"
        text += f"SFORCE/{i}, TRANSLATIONAL, I={i}, J={i - 1}, FUNCTION={law}\n"
    found = run(text, "ERROR=1", end=4.0)
    assert 800 / 4.99 < found.summary["steps"] < 800 / 4.2
    assert found.summary["rejected"] < 5
    monkeypatch.setattr(equations, "runs", lambda instances: None)  # order 8, of twelve stages
    assert run(text, "ERROR=1E-2", end=2.0).summary["steps"] > 400 / 6.5


def test_high_demands_take_order_eight(monkeypatch):
    """... but for the first steps; with order 4 they would be twice as many."""
    found = run(chain(20), "ERROR=1E-6").summary["steps"]
    monkeypatch.setattr(equations, "runs", lambda instances: None)
    assert found < 1.4 * run(chain(20), "ERROR=1E-6").summary["steps"]


def test_equal_steps_are_of_order_eight():
    """A step whose size is given keeps it and its order, at any ERROR."""
    known = run(chain(20), "ERROR=1E-11")
    found = run(chain(20), "ERROR=1E-2, HINIT=0.01, HMIN=0.01, HMAX=0.01")
    assert found.summary["steps"] == 50
    np.testing.assert_allclose(found["POINT_MASS/9.x"], known["POINT_MASS/9.x"], atol=1e-7)


@pytest.mark.parametrize("full", [False, True])
def test_a_mass_that_vanishes_is_not_passed(full, monkeypatch):
    """1 + 0.1 k - 4 t of mass k, of which the lightest is 1; with ``full`` along x alone."""
    laws = "FX=4*TIME*ACCX({i})\\, FY=4*TIME*(ACCY({i})-JGRAV)\\, FZ=4*TIME*ACCZ({i})\n"
    if full:
        laws = "FX=4*TIME*ACCX({i})+0.1*ACCZ({i})\\, FY=0\\, FZ=0\n"
    text = chain(20) + "".join(
        f"MARKER/{i + 5000}, PART=1, FLOATING\n"
        f"VFORCE/{i}, I={i}, JFLOAT={i + 5000}, " + laws.format(i=i)
        for i in range(2, 22)
    )
    ends = []
    for error in ("1E-3", "1E-9"):
        found = run(text, f"ERROR={error}")
        ends.append((found.outcome.name, found.summary["t_end"]))
    monkeypatch.setattr(equations, "runs", lambda instances: None)
    ends.append((run(text, "ERROR=1E-9").outcome.name, 0.25))
    assert {name for name, _ in ends} == {"SINGULAR_ACCELERATION"}
    np.testing.assert_allclose([t for _, t in ends], 0.25, atol=2e-3)


@pytest.mark.parametrize("unwatched", [0.0, 600.0, 3000.0])
def test_a_run_that_pauses_continues_as_if_it_had_not(unwatched: float, monkeypatch):
    known = run(chain(20), "ERROR=1E-4")
    monkeypatch.setattr(dynamic, "UNWATCHED", unwatched)
    found = run(chain(20), "ERROR=1E-4")
    np.testing.assert_array_equal(found.values, known.values)
    assert found.summary["steps"] == known.summary["steps"] > 20


def test_an_audit_follows_the_same_steps():
    """Without it the workspace is written at records alone."""
    one = run(growing(20), "ERROR=1E-4")
    two = simulate(read(f"{growing(20)}INTEGRATOR/ABAM, ERROR=1E-4\nEND\n"), 0.5, 10, audit=True)
    np.testing.assert_array_equal(one.values, two.values)
