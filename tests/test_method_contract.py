"""What every integrator promises (the rules of :mod:`adamslite.integrators.contract`), one by one.

A mass on a spring is what all of them can run, VERLET included: m x" = -k (x - l).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scenes import GROUND, run

import adamslite as al
from adamslite.errors import UsageError
from adamslite.language.method import FIXED, methods
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

END = 2.0
#: m x'' = -k (x - 3) with m = 2, k = 8, let go at x = 4.
SPRING = (
    GROUND
    + """POINT_MASS/2, MASS=2, CM=2, QG=4,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, LENGTH=3
END
"""
)
POINT = "POINT_MASS/2, MASS=2, CM=2, QG={x},0,0, VX={v}\nMARKER/2, POINT_MASS=2\n"


def exact(time: np.ndarray) -> np.ndarray:
    """x of SPRING."""
    return 3.0 + np.cos(2.0 * time)


def energy(found: Results) -> np.ndarray:
    """4 (x - 3)^2 + v^2 = 4 of SPRING, (nt,)."""
    return 4 * (found["POINT_MASS/2.x"] - 3) ** 2 + found["POINT_MASS/2.vx"] ** 2


def settings(method: str, error: float = 1e-6) -> dict[str, Any]:
    """Arguments with which a method is as exact as ERROR, to a factor."""
    formula = methods()[method]
    if formula.steps == FIXED:  # without an error test: as exact as its steps are short
        return {"integrator": method, "hmax": 0.3 * error ** (1 / max(2, formula.order))}
    return {"integrator": method, "error": error}


def solved(method: str, deck: str, end: float = END, steps: int = 20, **more: Any) -> Results:
    """A run of a method; skipped where it refuses the scene by name."""
    try:
        return run(deck, end, steps, **(settings(method) | more))
    except UsageError as refusal:
        assert method in str(refusal)
        pytest.skip(str(refusal))


def pushed(force: str, x: float = 0.0, v: float = 0.0) -> str:
    """A mass of 2 at x with a force along x."""
    return f"{GROUND}{POINT.format(x=x, v=v)}VFORCE/1, I=2, J_PART=1, FX={force}\\FY=0\\FZ=0\nEND\n"


@pytest.mark.parametrize("method", methods())
class TestContract:
    """Each test is one rule; a method that registers is tested with the others."""

    def test_it_is_as_exact_as_it_was_asked_to_be(self, method: str) -> None:
        """The error falls with ERROR, and the energy is kept."""
        runs = [run(SPRING, END, 20, **settings(method, error)) for error in (1e-4, 1e-7)]
        off = [np.abs(found["POINT_MASS/2.x"] - exact(found.time)).max() for found in runs]
        assert off[0] < 0.05 and off[1] < 5e-4
        assert off[1] < max(0.3 * off[0], 1e-11)
        assert np.abs(energy(runs[1]) - 4.0).max() < 2e-3

    @pytest.mark.parametrize("interpolate", ["ON", "OFF"])
    def test_a_record_is_written_at_every_requested_time(
        self, method: str, interpolate: str
    ) -> None:
        """The first is the start as it is; in each of them m a is the force, to round-off."""
        deck = SPRING.replace("END\n", f"INTEGRATOR/{method}, INTERPOLATE={interpolate}\nEND\n")
        found = solved(method, deck, steps=37)
        np.testing.assert_array_equal(found.time, np.linspace(0.0, END, 38))
        x, a = found["POINT_MASS/2.x"], found["POINT_MASS/2.ax"]
        assert x[0] == 4.0 and found["POINT_MASS/2.vx"][0] == 0.0
        np.testing.assert_allclose(2.0 * a, -8.0 * (x - 3.0), atol=1e-9)
        assert found.summary["steps"] > 0

    @pytest.mark.parametrize("when", [0.7, 1.234567])
    def test_a_step_ends_where_a_force_of_time_jumps(self, method: str, when: float) -> None:
        """3 N from t1 on: v = 3/m (t - t1), whose kink a step across would smear."""
        found = solved(method, pushed(f"IF(TIME-{when}:0,0,3)"))
        since = np.maximum(0.0, found.time - when)
        np.testing.assert_allclose(found["POINT_MASS/2.vx"], 1.5 * since, atol=2e-5)

    @pytest.mark.parametrize(("wall", "speed"), [(0.5, 1.0), (0.3, 2.5)])
    def test_a_step_ends_where_a_force_of_the_state_jumps(
        self, method: str, wall: float, speed: float
    ) -> None:
        """Behind the wall -4 N: the mass comes back to it with the speed it came with."""
        found = solved(method, pushed(f"IF(DX(2)-{wall}:0,0,-4)", v=speed), end=4.0)
        inside, hit = 2.0 * speed / 2.0, wall / speed
        t = found.time
        truth = np.where(t < hit, speed * t, wall + speed * (t - hit) - (t - hit) ** 2)
        back = hit + inside
        truth = np.where(t > back, wall - speed * (t - back), truth)
        np.testing.assert_allclose(found["POINT_MASS/2.x"], truth, atol=2e-3 * speed)

    def test_it_can_be_interrupted(self, method: str) -> None:
        """Records so far are kept, and the outcome is named."""

        class Impatient:
            """Interrupts at the first report."""

            def __call__(self, time: float, end: float) -> None:
                raise KeyboardInterrupt

            def say(self, sentence: str) -> None:
                pass

            def close(self) -> None:
                pass

        found = run(SPRING, 1e6, 10**6, progress=Impatient(), **settings(method) | {"hmax": 1e-3})
        assert found.outcome is Outcome.INTERRUPTED
        assert 0.0 <= found.time[-1] < 1e6
        assert np.isfinite(found.values).all()

    def test_it_goes_on_from_where_it_was(self, method: str) -> None:
        """Two analyses in a row are as good as one."""
        deck = SPRING.replace("END\n", "SIMULATE/DYNAMIC, END=0.9, STEPS=9\n")
        deck += "SIMULATE/DYNAMIC, END=2, STEPS=11\nEND\n"
        found = al.simulate(al.read(deck), **settings(method))
        assert found.outcome is Outcome.DONE
        np.testing.assert_allclose(found.time, np.linspace(0.0, 2.0, 21), atol=1e-12)
        np.testing.assert_allclose(found["POINT_MASS/2.x"], exact(found.time), atol=2e-3)

    @pytest.mark.parametrize("pole", [0.5, 1.3])
    def test_a_run_that_cannot_go_on_says_so_and_keeps_what_it_has(
        self, method: str, pole: float
    ) -> None:
        """x" = 1/(t1 - t) has no solution behind t1: a named failure before it."""
        found = solved(method, pushed(f"2/({pole}-TIME)"), end=2.0, steps=200)
        assert found.outcome is not Outcome.DONE and found.message
        assert 0.0 < found.time[-1] <= pole
        t = found.time[found.time < 0.9 * pole]
        x = (pole - t) * np.log(1.0 - t / pole) + t
        np.testing.assert_allclose(found["POINT_MASS/2.x"][: len(t)], x, atol=2e-3)

    def test_it_stops_where_a_force_cancels_the_mass(self, method: str) -> None:
        """(1 - TIME) m x" = 3: the acceleration matrix is singular at 1."""
        found = solved(method, pushed("3+TIME*2*ACCX(2)"), end=2.0, steps=100)
        assert found.outcome is Outcome.SINGULAR_ACCELERATION
        assert 0.8 < found.time[-1] <= 1.0

    def test_counts_are_of_this_run(self, method: str) -> None:
        """A second run of the same kernels counts the same."""
        kernels = al.compile_model(al.assemble(al.read(SPRING)))
        first, second = (
            al.simulate(kernels, end=END, steps=10, **settings(method)) for _ in range(2)
        )
        for word in ("steps", "rejected", "newton", "jacobians", "factorizations"):
            assert first.summary[word] == second.summary[word]
        np.testing.assert_array_equal(first.values, second.values)
