"""Small mechanical scenes for tests of the numerics, and ways to look inside a run."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from pullbacks import compare_pullbacks
from scipy.special import ellipk
from tangents import compare_tangents

import adamslite as al
from adamslite.equations import operations
from adamslite.equations.system import System
from adamslite.integrators import motion_equations
from adamslite.integrators.contract import JACOBIAN, RESIDUAL
from adamslite.kernels.groups import Kernels
from adamslite.native import compiler as code
from adamslite.native import translate
from adamslite.native.translate import Record
from adamslite.native.translate.modules import method_text as assembly_of
from adamslite.results.results import Results

GROUND = "a scene\nPART/1, GROUND\nMARKER/1, PART=1\n"
PENDULUM = """a pendulum of length 1 that starts level
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
PART/2, MASS=2, CM=2, IP=0.1,0.2,0.3, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
END
"""
# A hinge that a MOTION keeps at zero, with a damper on a branch that round-off decides.
TEETER = """\
ACCGRAV/JGRAV=-9.81
PART/2, MASS=10, CM=20, IP=1,2,3
MARKER/20, PART=2, QP=0.5,0.3,0
MARKER/2, PART=2
MARKER/23, PART=2, QP=1,0,0, REULER=0.3,0,0
PART/3, MASS=10, CM=30, IP=1,2,3, QG=1,0,0, REULER=0.3,0,0
MARKER/30, PART=3, QP=0.5,0.3,0.1
MARKER/3, PART=3
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=3, J=23
MOTION/2, JOINT=2, ROTATION, FUNCTION=0.0
"""
DAMPER = "SFORCE/1, ROTATION, I=3, J=23, FUNCTION=IF(ABS(AZ(3,23)): 0, 0, -40*WZ(3,23,23))\n"
LENGTH, GRAVITY, MASS, INERTIA = 1.0, 9.81, 2.0, 0.3
# theta'' = -m g L/(m L^2 + J) cos(theta), J about z.
RATE = MASS * GRAVITY * LENGTH / (MASS * LENGTH**2 + INERTIA)
PERIOD = 4.0 * ellipk(0.5) / math.sqrt(RATE)
#: m x'' = -k (x - 1) with m = 2, k = 8, let go at x = 2.
SPRING = (
    GROUND
    + """POINT_MASS/2, MASS=2, CM=2, QG=2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, LENGTH=1
END
"""
)


def spring_energy(results: Results) -> np.ndarray:
    """4 (x - 1)^2 + v^2 = 4 of that mass, (nt,)."""
    return 4 * (results["POINT_MASS/2.x"] - 1) ** 2 + results["POINT_MASS/2.vx"] ** 2


def run(deck: str, end: float, steps: int = 10, **options: Any) -> Results:
    """Solve a deck of these lines."""
    return al.simulate(al.read(deck), end=end, steps=steps, **options)


def done(deck: str, end: float, steps: int = 10, **options: Any) -> Results:
    """Solve a deck that must reach its end."""
    results = run(deck, end, steps, **options)
    assert results.outcome is al.Outcome.DONE, results.message
    return results


def compiled(deck: str) -> Kernels:
    """The kernels of a deck, given as text."""
    return al.compile_model(al.assemble(al.read(deck)))


def system(deck: str, stabilised: bool = True) -> System:
    """The numbered equations of a deck, to look at them."""
    return System(compiled(deck), stabilised)


def added_mass(share: float) -> str:
    """A mass of 2 that falls with the force 3 along x, and F = -dm (a - g) with dm = 2 share."""
    added = 2 * share
    return (
        GROUND
        + "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=2, CM=2\nMARKER/2, POINT_MASS=2\n"
        + f"VFORCE/1, I=2, J_PART=1, FX=3\\FY=-{added}*(ACCY(2)+9.81)\\FZ=-{added}*ACCZ(2)\nEND\n"
    )


def carriage(way: str, more: str = "") -> str:
    """PART/2, moved along x of the ground by this function of time, and more statements."""
    return (
        GROUND
        + f"""PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2, REULER=90D,90D,0
MARKER/3, PART=1, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=3
MOTION/1, JOINT=1, TRANSLATION, FUNCTION={way}
{more}END
"""
    )


def options(formula: str, error: float = 1e-6) -> dict[str, Any]:
    """Arguments of a run: a method, and behind a space its formulation."""
    method, _, form = formula.partition(" ")
    return {"integrator": method, "error": error} | ({"formulation": form} if form else {})


def chain(count: int, force: str = "") -> str:
    """Point masses on springs, hanging from the ground; ``force`` with {id} acts on each."""
    lines = [GROUND, "ACCGRAV/JGRAV=-9.81"]
    for k in range(2, count + 2):
        lines += [
            f"POINT_MASS/{k}, MASS=1, CM={k}, QG={k - 1},0,0",
            f"MARKER/{k}, POINT_MASS={k}",
            f"SFORCE/{k}, TRANSLATIONAL, I={k}, J={k - 1}, FUNCTION=-200*(DM({k},{k - 1})-1)",
            force.format(id=k),
        ]
    return "\n".join([*filter(None, lines), "END\n"])


def links(count: int) -> str:
    """A chain of rods hinged to each other and to the ground."""
    lines = [GROUND, "ACCGRAV/JGRAV=-9.81"]
    for k in range(2, count + 2):
        before = 1 if k == 2 else 10 * (k - 1) + 2
        lines += [
            f"PART/{k}, MASS=1, CM={10 * k}, IP=0.1,0.1,0.1, QG={k - 1.5},0,0",
            f"MARKER/{10 * k}, PART={k}",
            f"MARKER/{10 * k + 1}, PART={k}, QP=-0.5,0,0",
            f"MARKER/{10 * k + 2}, PART={k}, QP=0.5,0,0",
            f"JOINT/{k}, REVOLUTE, I={10 * k + 1}, J={before}",
        ]
    return "\n".join([*lines, "END\n"])


# ---- plain Python in the place of native code ----------------------------------------------------


def call_address(address: int, *args: Any) -> None:
    """Call native code from Python: arrays as addresses, the rest as integers."""
    given = [
        ctypes.c_void_p(a.ctypes.data) if isinstance(a, np.ndarray) else ctypes.c_int64(int(a))
        for a in args
    ]
    ctypes.CFUNCTYPE(None, *[type(a) for a in given])(int(address))(*given)


def run_in_python(scene: System, operation: int, phases: int = 0) -> int:
    """What ``System.run`` does, interpreted; kernels stay native, overflow passes in silence."""
    with np.errstate(all="ignore"):
        return operations.run(*scene.records(), operation, phases)


def integrate_in_python(scene: System, entry: str) -> int:
    """What ``System.integrate`` does, likewise."""
    module, _, name = entry.rpartition(".")
    with np.errstate(all="ignore"):
        return getattr(import_module(module), name)(*scene.records())


def interpreted(monkeypatch: Any) -> None:
    """Let every run of this test interpret the engine."""
    monkeypatch.setattr(motion_equations, "call_address", call_address, raising=False)
    monkeypatch.setattr(System, "run", run_in_python)
    monkeypatch.setattr(System, "integrate", integrate_in_python)


def native_call(entry: Callable[..., Any], arrays: list[Any]) -> float:
    """Compile ``entry`` and call it on numpy arrays and records."""
    name = translate.symbol(entry)
    address = code.addresses([(code.object_code(assembly_of(entry)), [name])])[name]
    places = [a.address if isinstance(a, Record) else a.ctypes.data for a in arrays]
    return ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_void_p] * len(places))(address)(*places)


# ---- derivatives ---------------------------------------------------------------------------------


def random_state(scene: System, seed: int = 1) -> None:
    """Any state: equations and their derivatives hold off the constraints too."""
    some = np.random.default_rng(seed)
    n = scene.n
    scene.q[:n] += 0.3 * some.standard_normal(n)
    for array in (scene.u, scene.a, scene.z, scene.rd):
        array[:] = some.standard_normal(array.size)
    scene.settings.t = 0.3
    settle(scene)


def settle(scene: System) -> None:
    """Count rotation vectors from the present attitudes, so that increments are turns in ground."""
    scene.run(RESIDUAL, 0)
    for b, body in enumerate(scene.model.bodies):
        if body.width == 6:
            at = scene.w_at["BODY", b] + 15
            scene.base[9 * b : 9 * b + 9] = scene.W[at : at + 9]
            scene.q[scene.starts[b] + 3 : scene.starts[b] + 6] = 0.0


def rows(scene: System, phases: int) -> np.ndarray:
    """All equations at the present state, (nz,)."""
    scene.run(RESIDUAL, phases)
    return scene.F[: scene.nz].copy()


def exact(scene: System, phases: int, kind: int) -> np.ndarray:
    """dF/d(q, u, a, (lam, V) or s') of the kernels, (nz, nz) in the columns of the unknowns."""
    scene.coef[:5] = 0.0
    scene.coef[kind] = 1.0
    scene.run(JACOBIAN, phases)
    full = np.zeros((scene.nz, scene.nz))
    for (row, column), at in scene.blocks.offsets.items():
        r, c, h, w = *(scene.starts[k] for k in (row, column)), scene.widths[row], 0
        w = scene.widths[column]
        full[r : r + h, c : c + w] = scene.J[at : at + h * w].reshape(h, w)
    return full


def differences(scene: System, phases: int, kind: int) -> np.ndarray:
    """The same by central differences, where columns of that kind exist."""
    n, states = scene.n, scene.n + scene.m + scene.nv
    places = {
        0: [(scene.q, k, k) for k in range(n)]
        + [(scene.z, k - n, k) for k in range(states, states + scene.ns)],
        1: [(scene.u, k, k) for k in range(n)],
        2: [(scene.a, k, k) for k in range(n)],
        3: [(scene.z, k - n, k) for k in range(n, states)],
        4: [(scene.rd, k - states, k) for k in range(states, states + scene.ns)],
    }[kind]
    full = np.zeros((scene.nz, scene.nz))
    for array, at, column in places:
        h = 1e-5 * max(1.0, abs(array[at]))
        middle = array[at]
        found = []
        for sign in (1, -1):
            array[at] = middle + sign * h
            found.append(rows(scene, phases))
        array[at] = middle
        full[:, column] = (found[0] - found[1]) / (2 * h)
    return full


def assert_derivatives(scene: System, phases: int, tolerance: float = 2e-7) -> None:
    """Every block of the exact Jacobian against differences of the residual."""
    for kind, letter in enumerate("qua"):
        compare_derivatives(scene, phases, kind, f"d/d{letter}", tolerance)
    compare_derivatives(scene, phases, 3, "d/d(lam, V)", tolerance)
    compare_derivatives(scene, phases, 4, "d/ds'", tolerance)
    compare_tangents(scene, phases)
    compare_pullbacks(scene, phases)


def compare_derivatives(
    scene: System, phases: int, kind: int, name: str, tolerance: float = 2e-7
) -> None:
    """One kind of column, each row against its own largest entry."""
    made, found = exact(scene, phases, kind), differences(scene, phases, kind)
    scale = 1.0 + np.abs(found).max(axis=1, keepdims=True)
    gap = np.abs(made - found) / scale
    worst = np.unravel_index(gap.argmax(), gap.shape)
    assert gap.max() < tolerance, (name, worst, made[worst], found[worst], owner(scene, worst[0]))


def owner(scene: System, row: int) -> object:
    """The node that a row belongs to."""
    node = max(k for k, first in enumerate(scene.starts) if first <= row)
    return scene.nodes[node]


BALL_ON_A_FLOOR = """a ball that bounces on a floor with damping
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
POINT_MASS/2, MASS=2, CM=2, QG=0,1,0
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, JFLOAT=3, RM=1, FX=0\\FY=IMPACT(DY(2,1),VY(2,1),0.1,1E4,1.5,50,0.01)\\FZ=0
MARKER/3, PART=1, FLOATING
END
"""
