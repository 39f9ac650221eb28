"""The whole engine run by Python and as native code, and what it is made of."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import test_lanes as lanes
from scenes import DAMPER, GROUND, PENDULUM, TEETER, chain, interpreted, run
from test_large_start import ring
from test_singular import parallelogram
from tiers import every

import adamslite as al
from adamslite.equations import engine
from adamslite.equations.engine import engine_parts
from adamslite.errors import UsageError
from adamslite.kernels.code import lookup
from adamslite.language.method import AUTO, FIXED, declared
from adamslite.native.translate import REGISTERED, symbol
from adamslite.native.translate.language import RARE, SELDOM
from adamslite.native.worker import Worker

ENTRIES = sorted({method.entry for method in declared()} | {engine.OPERATIONS})
for _entry in ENTRIES:
    import_module(_entry.rpartition(".")[0])
# All of the package but what kernels call, and derivatives along a run, which have entries of their
# own (test_derivative_entries).
DERIVATIVES = (
    f"{engine.HERE}sensitivity.", f"{engine.HERE}integrators.linalg.transposed",
    f"{engine.HERE}integrators.linalg.complex_transposed",
)  # fmt: skip
ENGINE = {
    name
    for name, code in REGISTERED.items()
    if code.__module__.startswith(engine.HERE) and code.__module__ != lookup.__name__
    and not code.__module__.startswith(DERIVATIVES)
}  # fmt: skip
# What derivatives alone ask for: the tape of a run (test_derivative_entries).
TAPE = {"tape_event", "tape_row", "tape_step"}

# Newton alone would leave it upright.
UPRIGHT = PENDULUM.replace("QG=1,0,0", "QG=0.3,0.95,0").replace("QP=-1,0,0", "QP=-0.3,-0.95,0")

ADDED_MASS = "VFORCE/{id}, I={id}, J_PART=1, FX=-0.2*ACCX({id})\\FY=VARVAL(7)"
DECKS = {
    "hinged": PENDULUM,
    "loose": chain(2),
    "spins": GROUND + "PART/2, MASS=1, CM=2, IP=1,2,3, WX=1, WY=2\nMARKER/2, PART=2\nEND\n",
    "long": chain(13, ADDED_MASS).replace("END", "VARIABLE/7, FUNCTION=SIN(TIME)\nEND"),
    "states": GROUND
    + """PART/2, MASS=1, CM=2, IP=1,2,3, WX=1, WY=2
MARKER/2, PART=2
POINT_MASS/3, MASS=1, CM=3, QG=1,0,0
MARKER/3, POINT_MASS=3
DIFF/1, IC=1, FUNCTION=-DIF(1)*DX(3)+AZ(2,1)
VARIABLE/1, IC=1, FUNCTION=COS(VARVAL(1))
GCON/1, FUNCTION=VX(3)-0.3
SFORCE/1, TRANSLATIONAL, I=2, J=3, FUNCTION=-5*(DM(2,3)-1)
END
""",
    "jumps": GROUND
    + """POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=STEP(TIME,0.2,0,0.201,1000)\\FY=-1E5*MAX(0,DX(2)-1.02)**1.5*VX(2)
END
""",
    "stops": GROUND
    + """POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=10*TIME*ACCX(2)+10*VX(2)-4E5*DX(2)
END
""",
    "meets": GROUND
    + """POINT_MASS/2, MASS=1, CM=2, QG=0.04,0,0, VX=-1
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, VX=1, VY=0.3
MARKER/3, POINT_MASS=3
DIFF/1, IC=0.2, FUNCTION=-IF(DIF(1)-0.1: 1, 1, 2)
VFORCE/1, I=2, J_PART=1, FX=4E3*MAX(0,-DX(2))**1.5+IF(TIME-0.15:0,1,30)\\FY=MOD(10*DX(3),1)
VFORCE/2, I=3, J_PART=1, FX=IF(DX(3):0,0,-9)+1E-6*ABS(VX(2))\\FY=-STEP(TIME,0.1,0,0.3,2)
VFORCE/3, I=3, J_PART=1, FX=IF(ABS(DX(3)-0.2)-0.01:-5,0,0)\\FY=STEP(DX(3),0.02,0,0.03,1)
END
""",
    "meets freely": GROUND
    + """POINT_MASS/2, MASS=1, CM=2, QG=0.04,0,0, VX=-1
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, VX=1, VY=0.3
MARKER/3, POINT_MASS=3
VFORCE/1, I=2, J_PART=1, FX=4E3*MAX(0,-DX(2))**1.5+IF(TIME-0.15:0,1,30)\\FY=MOD(10*DX(3),1)
VFORCE/2, I=3, J_PART=1, FX=IF(DX(3):0,0,-9)+1E-6*ABS(VX(2))\\FY=-STEP(TIME,0.1,0,0.3,2)
VFORCE/3, I=3, J_PART=1, FX=IF(ABS(DX(3)-0.2)-0.01:-5,0,0)\\FY=STEP(DX(3),0.02,0,0.03,1)
END
""",
    "runs away": GROUND
    + """POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
GCON/1, FUNCTION=DZ(2)
DIFF/1, IC=1, FUNCTION=10*DIF(1)**2
END
""",
    "rods": GROUND
    + """PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0, WZ=2
MARKER/20, PART=2
MARKER/21, PART=2, QP=-1,0,0
"""
    + "".join(
        f"""PART/{k}, MASS=1, CM={k}0, IP=1,1,1, QG={2 * k - 3},0,0
MARKER/{k}0, PART={k}
MARKER/{k}1, PART={k}, QP=-1,0,0
JOINT/{k}, SPHERICAL, I={k}1, J={k - 1}0
"""
        for k in range(3, 10)
    )
    + "JOINT/1, REVOLUTE, I=21, J=1\nEND\n",
}


RUBS = (
    GROUND
    + """POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=-100*TANH(1000*VX(2))
END
"""
)

# Every kind of work that an audit counts, and a branch that changes.
WORKS = PENDULUM.replace(
    "END",
    """PART/3, MASS=1, CM=4, IP=1,1,1, QG=2,0,0, WX=1
MARKER/4, PART=3
BUSHING/1, I=4, J=2, K=9,9,9, KT=1,1,1
MOTION/1, JOINT=1, ROTATION, FUNCTION=-TIME**2
DIFF/1, FUNCTION=DX(4)-DIF(1), IC=0
VFORCE/1, I=4, J_PART=1, FX=IF(DY(4)+.3:DIF(1),0,2)
END""",
)


# One method for each native integrator, on every deck; and equilibria, far ones too.
INTEGRATORS = [AUTO, *{m.entry: m.name for m in declared() if m.steps != FIXED}.values()]
# A filter faster than the steps: records between their ends need steps of their own.
LAGS = f"""{GROUND}\
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
DIFF/1, FUNCTION=235*(0.5*SIN(14*TIME)-DIF(1))
END
"""
# A step would pass a zone of 1 mm as a whole.
PASSES = f"""{GROUND}\
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=STEP(DX(2),0.25,0,0.251,1)
END
"""
# A step from 0.3 to 0.4 does not see the bump, and ends where its curvature vanishes: at w/sqrt(2)
# behind its middle, 0.6 of its height off.
SKIPS = f"""{GROUND}\
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
GCON/1, FUNCTION=DY(2)-3E-4*EXP(-((DX(2)-0.39823223304703365)/0.0025)**2)
END
"""
# A sensor watches what no force does.
SENSED = f"""{GROUND}\
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
SENSOR/1, FUNCTION=DX(2,1), VALUE=0.21, ERROR=1E-6, GE, RETURN
END
"""
# A force in windows that no cubic shows.
WAVES = f"""{GROUND}\
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=IF(0.98-SIN(40*DX(2)):1,0,0)
END
"""
# A spike of a table lies within a step.
LOOKS_UP = f"""{GROUND}\
SPLINE/1, X=-2,-1,0,0.2,0.21,0.22,0.23,0.3,1,2, Y=0,0,0,0,1,3,0,0,0,0
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=AKISPL(DX(2),0,1)
END
"""
# Its steps are those of round-off, which differs from Python to native code.
TEETERS = f"{GROUND}{TEETER}{DAMPER}END\n"
#: Cranks at 5 degrees to their base, which lie flat after 0.02 s.
LEVEL = "QG=0.99619469809174555,0.087155742747658166,0"
FLATTENS = parallelogram(-4.0).replace("90D", "5D").replace("QG=0,1,0", LEVEL)
RUNS = {
    f"{name} {method}": (deck, method) for name, deck in DECKS.items() for method in INTEGRATORS
}
RUNS |= {
    "steady": (PENDULUM.replace("END", "INTEGRATOR/HINIT=0.02\nEND"), "CONSTANT_BDF"),
    "rubs": (RUBS, "RADAU"),
    "passes": (PASSES, "RADAU"),
    "looks up": (LOOKS_UP, "GSTIFF"),
    "waves": (WAVES, "RADAU"),
    "skips": (SKIPS, "ABAM"),
    "sensed": (SENSED, "GSTIFF"),
    "asked": (
        PENDULUM.replace("END", "INTEGRATOR/CORRECTOR=ORIGINAL, INTERPOLATE=OFF, PATTERN=T:F\nEND"),
        "GSTIFF",
    ),
    "hangs": (PENDULUM.replace("END", "SIMULATE/STATICS\nEND"), None),
    "leans": (UPRIGHT.replace("END", "SIMULATE/STATICS\nEND"), None),
    "lags": (LAGS, "ABAM"),
    "audited work": (WORKS, "GSTIFF"),
    "audited leaps": (DECKS["jumps"], "VERLET"),
    "falls": (PENDULUM.replace("END", "EQUILIBRIUM/MAXIT=1\nSIMULATE/STATICS\nEND"), None),
}


BODY = "PART/50, MASS=1, CM=50, IP=1,2,2, WZ=1\nMARKER/50, PART=50\n"
NOT_COMPARED = {
    "teeters": (TEETERS, "RADAU"),
    "flattens": (FLATTENS, "RADAU"),  # a posture that amplifies round-off to 6e-6
    "fine steps into a flat posture": (
        re.sub(r"\bEND\s*$", "INTEGRATOR/HMAX=0.001\nEND\n", FLATTENS),
        "ABAM",
    ),
    "in lanes": (lanes.windy(9) + "END\n", "VERLET"),
    "pushed in lanes": (lanes.pushed(20) + "END\n", "VERLET"),
    "in lanes, explicit": (lanes.windy(9) + "END\n", "ABAM"),
    "fine in lanes, explicit": (lanes.windy(9) + "END\n", "ABAM"),
    "grows": (lanes.growing(9) + "END\n", "ABAM"),
    "two grow": (lanes.growing(2, True) + "END\n", "ABAM"),
    "grows beside a body": (lanes.growing(2) + BODY + "END\n", "ABAM"),
    "many rows": (ring(30).replace("END", "SIMULATE/INITIAL\nEND"), None),
    "grows in all directions": (lanes.growing(9, True) + "END\n", "ABAM"),
}


def run_of(name: str):
    """The results, or None where the method says that it cannot run the deck."""
    deck, method = (RUNS | NOT_COMPARED)[name]
    if method is None:
        return al.simulate(al.read(deck))
    try:
        audit = name.startswith("audited")
        error = 1e-8 if name.startswith("fine") else 1e-4
        return run(deck, 0.4, 4, error=error, integrator=method, audit=audit)
    except UsageError:
        return None


# Rooms that hold native functions.
NATIVE_ROOMS = tuple(
    str(Path(al.__file__).parent / room)
    for room in ("integrators", "equations/operations.py", "kernels/code/lookup.py")
)


def interpreted_run_of(name: str):
    """The same by Python."""
    with pytest.MonkeyPatch.context() as patch, np.errstate(all="ignore"):
        interpreted(patch)
        return run_of(name)


@pytest.mark.parametrize("name", every(6, RUNS))
def test_the_engine_runs_the_same_interpreted_and_native(name):
    """Same steps, same iterations, same results to round-off."""
    by_python, native_run = interpreted_run_of(name), run_of(name)
    if by_python is None or native_run is None:
        assert by_python is native_run
        return
    assert by_python.outcome == native_run.outcome
    for count in ("steps", "rejected", "newton", "jacobians", "factorizations"):
        assert by_python.summary[count] == native_run.summary[count]
    np.testing.assert_allclose(by_python.values, native_run.values, rtol=1e-8, atol=1e-8)


def defined(text: str, internal: str = "(?:internal )?") -> set[str]:
    """Symbols of the functions in a module; without internal ones, if these are called ""."""
    return set(re.findall(rf"^define {internal}\w+ @([\w.]+)\(", text, re.MULTILINE))


def declared_in(text: str) -> set[str]:
    """Symbols of the functions of other modules that a module calls."""
    return set(re.findall(r"^declare .*@((?:integrators|equations)\S+)\(", text, re.MULTILINE))


@pytest.fixture
def called(monkeypatch: pytest.MonkeyPatch):
    """Names of the native functions that Python calls during a test."""
    names: set[str] = set()
    before = sys.getprofile()

    def watch(frame, event, argument):
        if event == "call" and frame.f_code.co_filename.startswith(NATIVE_ROOMS):
            module = frame.f_globals["__name__"].removeprefix("adamslite.")
            names.add(f"{module}.{frame.f_code.co_name}")

    def run(worker: Worker, *held: object) -> None:
        sys.setprofile(watch)
        work(worker, *held)

    work = Worker._run
    monkeypatch.setattr(Worker, "_run", run)
    sys.setprofile(watch)
    yield names
    sys.setprofile(before)


@pytest.mark.slow
def test_those_runs_reach_every_native_function(called):
    """All that the registered entries call."""
    for name in RUNS | NOT_COMPARED:
        interpreted_run_of(name)
    reached = set().union(*(defined(part) for name in ENTRIES for part in engine_parts(name)))
    assert "integrators.records.write_record" in reached
    tape = {f"integrators.audit.tape.{name}" for name in TAPE}
    kept = {"integrators.verlet.sampling.leave"}  # of runs that are kept: see test_checkpoints
    missed = reached - {name.removeprefix(engine.HERE) for name in ENTRIES} - called - tape - kept
    assert not missed, sorted(missed)


@pytest.mark.slow
def test_the_entries_are_translated_whole():
    """Every native function is part of one; a method has one name that others may call."""
    parts = {name: engine_parts(name) for name in ENTRIES}
    assert set().union(*(defined(part) for each in parts.values() for part in each)) >= ENGINE
    for name, each in parts.items():
        public = {f"adamslite.{found}" for part in each for found in defined(part, "")}
        called = {f"adamslite.{found}" for part in each for found in declared_in(part)}
        named = {f"adamslite.{found}" for found in engine._shared()[1]}
        own = named if name == engine.OPERATIONS else {name}
        assert own <= public <= own | called, name


@pytest.mark.parametrize("entry", sorted({method.entry for method in declared()}))
def test_what_methods_share_is_compiled_once(entry: str) -> None:
    """Events, audits, elimination and the equations are called, and not part of a method."""
    parts, shared = engine_parts(entry), set(engine._shared()[1])
    called = set().union(*map(declared_in, parts))
    here = set().union(*map(defined, parts))
    assert "integrators.events.stops.set_pace" in called
    assert called <= shared | here
    assert not here & shared


@pytest.mark.parametrize("entry", sorted({method.entry for method in declared()}))
def test_what_a_step_waits_for_is_compiled_with_all_effort(entry: str) -> None:
    """A shared function that a method calls at every step is among those named as shared, or is
    marked as seldom or rare.
    """
    shared = engine._shared()[0]
    marked = {symbol(function) for function in SELDOM | RARE}
    called = declared_in(engine_parts(entry).often)
    assert called & (defined(shared.seldom) | defined(shared.rare)) <= marked


def test_parts_call_each_other_by_names_that_exist() -> None:
    """Each name is defined once; a short function that parts have in common is in each of them."""
    for entry in ENTRIES:
        parts = engine_parts(entry)
        public = [found for part in parts for found in defined(part, "")]
        assert len(public) == len(set(public)), entry
        missing = set().union(*map(declared_in, parts)) - set(public)
        shared = set() if entry == engine.OPERATIONS else set(engine._shared()[1])
        assert missing <= shared, entry
