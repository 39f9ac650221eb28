"""Pauses of a run: operations between two calls of a method change no number of it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
from tiers import fast, slow
from unfinished_scenes import box, chain, pendulum, walled

import adamslite as al
from adamslite.analyses.dynamics import checkpoint, dynamic, method_choice
from adamslite.equations.system import System
from adamslite.integrators import contract
from adamslite.integrators.equilibrium_control import Control as Search
from adamslite.results.results import Results
from benchmarks.random_decks import deck as random_deck

#: Every operation of :mod:`adamslite.equations.operations`.
OPERATIONS = (
    contract.RESIDUAL, contract.JACOBIAN, contract.ACCELERATIONS, contract.EQUILIBRIUM,
    contract.RECORD, contract.SPECTRUM, contract.CLOCK, contract.AUDIT, contract.RECORD_AT_REST,
    contract.RESIDUAL_AT_REST, contract.FACTOR, contract.SOLVE,
)  # fmt: skip
PHASES = {
    contract.RESIDUAL: contract.STABILISED, contract.JACOBIAN: contract.STABILISED,
    contract.RESIDUAL_AT_REST: contract.STATIC,
}  # fmt: skip
SCENES: dict[str, Callable[[float, int], str]] = {
    "tied": pendulum, "bounds": box, "free": chain, "contact": walled,
}  # fmt: skip
METHODS = ("GSTIFF", "CONSTANT_BDF", "HHT", "NEWMARK", "RADAU", "RKF45", "VERLET")
UNSUITED = {("VERLET", "tied"), ("VERLET", "bounds")}
QUICK = (("RKF45", "free"), ("VERLET", "free"))
#: Pauses of a run.
MOST = 20
#: Random scenes by AUTO, and how many of them one test runs.
SEED, COUNT, GROUP = 3, 100, 4
PLANE = """random spheres that fall onto a plane and onto each other
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
GRAPHICS/1, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1"""
SPHERE = """PART/{n}, MASS=0.2, CM={n}, QG={x},{y},{z}, VX={vx}, VY={vy}, VZ={vz}
, IP=2E-4,2E-4,2E-4
MARKER/{n}, PART={n}
GRAPHICS/{n}, ELLIPSOID, CM={n}, XSCALE=0.1, YSCALE=0.1, ZSCALE=0.1"""
MEETING = """CONTACT/{met}, IGEOM={n}, JGEOM={other}, IMPACT, STIFFNESS={k}, EXPONENT={e}
, DAMPING={c}, DMAX=1E-4"""


def memory(system: System) -> list[tuple[str, bytes]]:
    """Everything that a run continues with."""
    return [(name, each.tobytes()) for name, each in checkpoint.arrays_of(system)]


def paused_after_every_try(monkeypatch: pytest.MonkeyPatch, operation: int) -> list[int]:
    """Do an operation after every try of a step, ``MOST`` times; its outcomes."""
    native, outcomes = System.integrate, []

    def stepped(system: System, entry: str) -> int:
        run, ahead, tries = system.settings, 1, -1
        while True:
            # Equal steps between two outputs are not interrupted.
            ahead = 2 * ahead if int(system.count.tries) == tries else 1
            tries = int(system.count.tries)
            run.pause = tries + ahead if len(outcomes) < MOST else 0
            code = native(system, entry)
            if code != contract.PAUSED:
                return code
            before = memory(system)
            with checkpoint.undisturbed(system):
                if operation == contract.EQUILIBRIUM:
                    system.control[:] = 0.0
                    search = Search(system.control[: Search.slots])
                    search.maxit, search.relaxations, search.most = 3, 3, 6
                row = int(system.count.records) - 1
                outcomes.append(system.run(operation, PHASES.get(operation, row)))
            assert memory(system) == before

    monkeypatch.setattr(System, "integrate", stepped)
    return outcomes


@pytest.mark.numerical
@pytest.mark.parametrize(
    ("method", "scene"),
    [
        case if case in QUICK else slow(*case)
        for case in product(METHODS, SCENES)
        if case not in UNSUITED
    ],
)
def test_operations_in_a_pause_change_no_number(
    monkeypatch: pytest.MonkeyPatch, method: str, scene: str
) -> None:
    deck = al.read(SCENES[scene](0.3, 10))
    fixed = {"hmax": 2e-3} if method in ("CONSTANT_BDF", "VERLET") else {"error": 1e-4}

    def solved() -> Results:
        return al.simulate(deck, integrator=method, **fixed)

    plain = solved()
    for operation in OPERATIONS:
        if operation == contract.EQUILIBRIUM and method == "VERLET":
            continue  # it has no room for the numbers of the search
        with monkeypatch.context() as patch:
            outcomes = paused_after_every_try(patch, operation)
            found = solved()
        assert len(outcomes) > 2
        assert found.values.tobytes() == plain.values.tobytes(), operation
        assert found.summary["steps"] == plain.summary["steps"]


def boxed_spheres(number: int) -> str:
    """Some spheres that fall onto a plane and onto each other."""
    rng = np.random.default_rng([SEED, number])
    count, met = int(rng.integers(2, 6)), 1
    k, c = 10.0 ** rng.uniform(3, 5), 10.0 ** rng.uniform(-1, 2)
    lines = [PLANE]
    for n in range(2, count + 2):
        x, y, z = 0.12 * n + rng.uniform(-0.05, 0.05), rng.uniform(-0.02, 0.02), 0.05 + 0.02 * n
        vx, vy, vz = rng.uniform(-1, 1, 3)
        lines.append(SPHERE.format(n=n, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz))
        for other in range(1, n):
            exponent = rng.choice([1, 1.5, 2.2])
            lines.append(MEETING.format(met=met, n=n, other=other, k=k, e=exponent, c=c))
            met += 1
    return "\n".join([*lines, "SIMULATE/DYNAMIC, END=0.3, STEPS=30", "END\n"])


def scene_of(number: int) -> str:
    if number % 4:
        return boxed_spheres(number)
    drawn = random_deck(number, SEED)
    ending = f"SIMULATE/DYNAMIC, END={drawn.end}, STEPS=40\nEND\n"
    return drawn.text if "SIMULATE" in drawn.text else drawn.text.replace("END\n", ending)


@pytest.mark.numerical
@pytest.mark.parametrize("first", fast(range(0, COUNT, GROUP), 32))
def test_auto_is_the_method_that_it_chose(monkeypatch: pytest.MonkeyPatch, first: int) -> None:
    """To the bit, however often its run is judged on its way."""
    monkeypatch.setattr(dynamic, "JUDGED", 10)
    monkeypatch.setattr(dynamic, "FEW", 1)
    taken: list[method_choice.MethodChoice] = []
    choose = method_choice.choose_method

    def noted(*given: object) -> method_choice.MethodChoice:
        taken.append(choose(*given))
        return taken[-1]

    monkeypatch.setattr("adamslite.analyses.session.session.choose_method", noted)
    for number in range(first, first + GROUP):
        deck = al.read(scene_of(number))
        auto = al.simulate(deck, integrator="AUTO", error=1e-5)
        choice = taken[-1]
        chosen = choice.other if "stalled" in str(auto.meta) else choice
        named = chosen.settings
        alone = al.simulate(deck, integrator=named.method, error=named.error)
        assert auto.values.tobytes() == alone.values.tobytes(), (number, named.method)
