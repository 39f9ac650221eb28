"""What an integrator is: its names and arguments in INTEGRATOR, its native code, what it can do.

A method is declared once, by a module of :mod:`adamslite.integrators.methods`::

    register(
        Method(
            names=("RADAU",),
            what="three-stage Radau IIA formula of order 5 with variable step",
            suited="small ERROR",
            entry="adamslite.integrators.radau.method.radau",
            ...
        )
    )

Statements, checks, manual, AUTO, the numbered equations and the reports of a run ask it; nothing
else lists methods.  ``entry`` names native code that keeps the rules of
:mod:`adamslite.integrators.contract`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Protocol, overload

from adamslite.language.abbreviations import forget_vocabularies
from adamslite.language.interfaces import DrawnModel

if TYPE_CHECKING:  # the modules that read a deck do without numpy
    import numpy as np

#: The arguments of INTEGRATOR that a method may use, in the order of their table.
ARGUMENTS = (
    "ERROR", "HMAX", "HMIN", "HINIT", "KMAX", "MAXIT", "PATTERN", "INTERPOLATE", "ADAPTIVITY",
    "CORRECTOR", "SCALE", "ALPHA", "BETA", "GAMMA",
)  # fmt: skip
#: The method of a deck that names none.
USUAL = "GSTIFF"
#: The name that leaves the choice to the program.
AUTO = "AUTO"
#: How long steps are: as the error test says; equal in any case; equal where HINIT is given.
VARIABLE, FIXED, FIXED_BY_HINIT = "variable", "fixed", "fixed by HINIT"
#: What of a scene a method may be unable to follow.
CONSTRAINTS, ROTATIONS, STATE_JUMPS = "constraints", "rotations", "jumps with the state"
UNUSED = "its formula does not use it"

NUMBERS = {
    "HSIZE": ("Size of the step that the output time lies in; 0 at the start.", "time"),
    "ORDER": ("Order of the formula of the step that the output time lies in.", "none"),
    "NJAC": ("How many Jacobians this analysis has evaluated up to the output time.", "none"),
    "NRHS": ("How many residuals this analysis has evaluated up to the output time.", "none"),
}
"""What each is and its unit, in the order in which the workspace has them, behind time and MODE."""


class Settings(Protocol):
    """What a method may ask of the settings of a run: arguments of INTEGRATOR, or their defaults;
    ``damping``: alpha, beta and gamma that hold with them.
    """

    @property
    def alpha(self) -> float: ...
    @property
    def beta(self) -> float: ...
    @property
    def gamma(self) -> float: ...
    @property
    def scale(self) -> tuple[float, ...]: ...
    @property
    def damping(self) -> tuple[float, float, float]: ...


class Factors(Protocol):
    """The elimination of the matrix of Newton: the factors, and how many numbers its workspace
    has.
    """

    LV: np.ndarray
    room: int


class Equations(Protocol):
    """What a method may ask of the numbered equations,
    :class:`adamslite.equations.system.System`.
    """

    n: int
    m: int
    nv: int
    ns: int
    holonomic: int
    nz: int
    starts: list[int]
    widths: list[int]
    history: np.ndarray
    tableau: np.ndarray
    J: np.ndarray

    @property
    def model(self) -> DrawnModel: ...

    @property
    def elimination(self) -> Factors: ...

    @property
    def by_component(self) -> bool: ...

    def make_room(self, **sizes: int) -> None:
        """Have arrays of at least these sizes."""


@dataclass(frozen=True, eq=False)
class Method:
    """An integrator.

    Parameters
    ----------
    names : tuple of str
        What INTEGRATOR calls it, in capitals; the first is its own, the others mean the same.
    what, suited : str
        The formula, and the scenes it is meant for, each in a sentence without a full stop.
    entry : str
        Module and name of the native function ``f(P: Problem, L: Plan) -> int``.
    order : int
        The highest order of the formula.
    family : str
        Formulas that are related to each other have the same.
    explicit : bool
        Whether a step solves no equations for the coordinates.
    arguments : mapping
        What each argument of INTEGRATOR does with it; the reason behind a "-" where it does
        nothing. Arguments that are left out do nothing, because the formula does not use them.
    formulations : tuple of str
        Those of SI2 (stabilised index 2) and I3 (index 3) it is written for; the first unless the
        deck asks for another.
    cannot : tuple of str
        What it is unable to follow, of ``CONSTRAINTS``, ``ROTATIONS``, ``STATE_JUMPS``.
    tests_velocities : bool
        Whether its error test sees velocities wherever the formulation determines them.
    steps : str
        ``VARIABLE``, ``FIXED`` or ``FIXED_BY_HINIT``.
    interpolates : bool
        Whether steps pass output times when INTERPOLATE does not say.
    pauses : bool
        Whether it pauses after ``settings.pause`` tries of a step, and continues when called again.
    in_blocks : bool
        Whether it returns where the record is full, or when it is asked to, and continues when
        called again (rule 10 of :mod:`adamslite.integrators.contract`).
    least_step : float
        The least step without HMIN, in longest steps.
    by_component : bool
        Whether it evaluates loads of many bodies by component where it can.
    damping : callable, optional
        ``damping(settings)`` gives alpha, beta and gamma of a formula of Newmark's kind.
    unfit : callable, optional
        ``unfit(settings, tied)`` says in words why it cannot run a scene with these settings, and
        what can; ``tied`` is a sentence about what ties the masses together, empty when nothing
        does.
    prepare : callable
        ``prepare(system, settings)`` comes before every run: it makes the arrays of the numbered
        equations as long as the formula needs (``system.make_room``), among them ``control`` for
        its numbers from step to step, and fills in coefficients.
    """

    names: tuple[str, ...]
    what: str
    suited: str
    entry: str
    order: int
    family: str
    explicit: bool
    arguments: Mapping[str, str] = field(default_factory=dict)
    formulations: tuple[str, ...] = ("I3",)
    cannot: tuple[str, ...] = ()
    tests_velocities: bool = True
    steps: str = VARIABLE
    interpolates: bool = True
    pauses: bool = False
    in_blocks: bool = False
    least_step: float = 1e-14
    by_component: bool = False
    damping: Callable[[Settings], tuple[float, float, float]] | None = None
    unfit: Callable[[Settings, str], str] | None = None
    prepare: Callable[[Equations, Settings], None] = lambda system, settings: None

    @property
    def name(self) -> str:
        """Its own name."""
        return self.names[0]

    def use(self, word: str) -> str:
        """What an argument does with it, or "-" and the reason why it does nothing."""
        return self.arguments.get(word, "-" + UNUSED)

    def uses(self, word: str) -> bool:
        """Whether an argument has an effect."""
        return not self.use(word).startswith("-")


_METHODS: dict[str, Method] = {}


def register(method: Method) -> None:
    """Enter a method under all of its names.

    Raises
    ------
    ValueError
        When one of the names is another method's, or an argument is none of INTEGRATOR.
    """
    for name in method.names:
        if name in _METHODS or name == AUTO:
            raise ValueError(f"integrator {name} is registered twice")
    if unknown := method.arguments.keys() - set(ARGUMENTS):
        raise ValueError(f"{method.name}: INTEGRATOR has no {', '.join(sorted(unknown))}")
    _METHODS.update(dict.fromkeys(method.names, method))
    forget_vocabularies()


def unregister(method: Method) -> None:
    """Take a method out again."""
    for name in method.names:
        del _METHODS[name]
    forget_vocabularies()


@cache
def _discover() -> None:
    import_module("adamslite.integrators.methods")


def methods() -> Mapping[str, Method]:
    """Every method by each of its names."""
    _discover()
    return _METHODS


def declared() -> list[Method]:
    """Every method once."""
    return [*dict.fromkeys(methods().values())]


def method_of(name: str) -> Method:
    """The method of a name; the usual one for AUTO, and for a name that is none."""
    return methods().get(name) or methods()[USUAL]


def without_effect(name: str, words: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Those of the arguments that do nothing with a method, each with the reason."""
    method = methods().get(name)
    if method is None:
        return
    for word in words:
        if word in ARGUMENTS and not method.uses(word):
            yield word, method.use(word)[1:]


class MethodNames(Sequence[str]):
    """The names of all methods, present and to come, and some ``more``, by the alphabet."""

    def __init__(self, *more: str) -> None:
        self.more = more

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> list[str]: ...
    def __getitem__(self, index: int | slice) -> str | list[str]:
        return sorted({*methods(), *self.more})[index]

    def __len__(self) -> int:
        return len({*methods(), *self.more})
