"""What a user binds to routines that are no part of a deck: numbers or functions of Python.

====================  ===================================  ========================================
name                  value                                binds
====================  ===================================  ========================================
``VARIABLE/1``        ``0``                                this statement, to a number
``GFORCE/12``         ``0,0,-9.81,0,0,0``                  the same, a number for each component
``VARSUB``            ``pitch:demand``                     all that call the routine, to the
                                                           function ``demand`` of module ``pitch``
``lib::BitForces``    ``0``                                all that name it in ROUTINE
``VARSUB``            ``installed``                        the same, to the function that an
                                                           installed package offers by this name
====================  ===================================  ========================================

What binds a statement wins over what binds its routine.  Packages offer functions as entry points
of the group ``adamslite.user``; no deck gets them without such a word of the user.
"""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite.deck.names import to_number
from adamslite.errors import UsageError
from adamslite.language.interfaces import key_of
from adamslite.language.routines import short_name
from adamslite.language.statement import STATEMENTS

if TYPE_CHECKING:  # few decks call routines, and numpy takes a while to load
    from importlib.metadata import EntryPoint

    from adamslite.deck.names import Names
    from adamslite.deck.python_routine import Routine
    from adamslite.language.interfaces import Key

GROUP = "adamslite.user"
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eEdD][-+]?\d+)?[dD]?")
FUNCTION = re.compile(r"([A-Za-z_][\w.]*):([A-Za-z_][\w.]*)")

INSTALLED = "installed"
"""Binds a routine to what an installed package offers by its name."""

WANTED = "write a number, numbers separated by commas, or a function of Python as module:function"

Given = float | Sequence[float] | str | Callable[..., Any]


@dataclass(frozen=True)
class Binding:
    """Numbers, or a function of Python; ``text``: as the user wrote it."""

    text: str
    numbers: tuple[float, ...] = ()
    function: Callable[..., Any] | None = None


@dataclass
class Bindings:
    """All bindings of a user.

    ``statements``: by keyword and id as written in capitals; ``routines``: by name in capitals.
    ``used``: what each statement runs with instead of its routine; ``found``: bindings with a use;
    ``called``: names of all routines, in capitals; ``made``: functions of Python, by the numbers
    that expressions have of them.
    """

    statements: dict[tuple[str, str], Binding] = field(default_factory=dict)
    routines: dict[str, Binding] = field(default_factory=dict)
    used: dict[str, Binding] = field(default_factory=dict)
    found: set[int] = field(default_factory=set)
    called: set[str] = field(default_factory=set)
    made: list[Routine] = field(default_factory=list)

    def find(
        self, names: Names, place: tuple[str, Key], label: str, routine: str
    ) -> Binding | None:
        """What is bound to a statement (keyword, id) or to the routine that it calls."""
        self.called.add(routine.upper())
        binding = self._of_statement(names, *place) or self._of_routine(routine)
        if binding is not None:
            self.found.add(id(binding))
            self.used[label] = binding
        return binding

    def _of_statement(self, names: Names, keyword: str, key: Key) -> Binding | None:
        for (kind, word), binding in self.statements.items():
            if kind == keyword and names.find(kind, _key(word)) == key:
                return binding
        return None

    def _of_routine(self, routine: str) -> Binding | None:
        for name in (routine.upper(), short_name(routine).upper()):
            if name in self.routines:
                return self.routines[name]
        return None

    @property
    def calls_python(self) -> bool:
        """Whether functions of Python run in place of routines."""
        return any(each.function is not None for each in self.used.values())

    @property
    def failed(self) -> Routine | None:
        """A routine that raised an exception, the first one."""
        return next((each for each in self.made if each.fault is not None), None)

    def start(self) -> None:
        """A run begins: what earlier ones left in routines is forgotten."""
        for each in self.made:
            each.forget()

    def unused(self) -> list[str]:
        """Names of bindings that nothing has taken."""
        given = [(f"{kind}/{word}", each) for (kind, word), each in self.statements.items()]
        return [
            name for name, each in (*given, *self.routines.items()) if id(each) not in self.found
        ]

    def summary(self, labels: Iterable[str] = ()) -> str:
        """What runs in place of routines: ``VARIABLE/1 = 0; VARIABLE/8, VARIABLE/9 = 0.1``.

        ``labels``: of these statements alone.
        """
        joined: dict[str, list[str]] = {}
        for label in labels or self.used:
            joined.setdefault(self.used[label].text, []).append(label)
        return "; ".join(f"{', '.join(names)} = {text}" for text, names in joined.items())


def bindings(given: Mapping[str, Given] | Iterable[str] | None) -> Bindings:
    """The bindings that a user gives, as a mapping or as texts ``NAME=VALUE``.

    Raises
    ------
    UsageError
        When one of them cannot be understood.
    """
    found = Bindings()
    texts = [given] if isinstance(given, str) else given or ()
    pairs = given.items() if isinstance(given, Mapping) else map(_pair, texts)
    for name, value in pairs:
        _enter(found, name.strip(), _binding(name, value))
    return found


def _pair(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (equals and name.strip() and value.strip()):
        raise UsageError(f"--user {text}: write KIND/ID=VALUE or ROUTINE=VALUE, as in VARIABLE/1=0")
    return name, value


def _enter(found: Bindings, name: str, binding: Binding) -> None:
    kind, slash, word = name.partition("/")
    if not slash:
        if name.upper() in found.routines:
            raise UsageError(f"--user {name}: it is bound twice")
        found.routines[name.upper()] = binding
        return
    from adamslite.language.abbreviations import match

    cls = match(kind.strip().upper(), STATEMENTS)
    if not isinstance(cls, type):
        from adamslite.language.likeness import did_you_mean

        hint = did_you_mean(kind, STATEMENTS)
        raise UsageError(f"--user {name}: there is no statement {kind}" + f"; {hint}" * bool(hint))
    place = cls.keyword, word.strip().upper()
    if place in found.statements:
        raise UsageError(f"--user {name}: it is bound twice")
    found.statements[place] = binding


def _binding(name: str, value: Given) -> Binding:
    if callable(value):
        return Binding(_spelled(value), function=value)
    if isinstance(value, str):
        return _from_text(name, value.strip())
    try:
        numbers = tuple(map(float, value)) if isinstance(value, Iterable) else (float(value),)
    except (TypeError, ValueError):
        raise UsageError(f"--user {name}={value!r}: {WANTED}") from None
    return _numbers(name, ", ".join(f"{each:.12g}" for each in numbers), numbers)


def _numbers(name: str, text: str, numbers: tuple[float, ...]) -> Binding:
    if not all(map(isfinite, numbers)):
        raise UsageError(f"--user {name}={text}: a number is finite")
    return Binding(text, numbers)


def _spelled(function: Callable[..., Any]) -> str:
    module, name = (getattr(function, each, "") for each in ("__module__", "__qualname__"))
    return f"{module}:{name}" if name else repr(function)


def _from_text(name: str, value: str) -> Binding:
    pieces = [piece.strip() for piece in value.split(",")]
    if all(NUMBER.fullmatch(piece) for piece in pieces):
        return _numbers(name, ", ".join(pieces), tuple(map(_number, pieces)))
    if value == INSTALLED:
        return _installed(name)
    found = FUNCTION.fullmatch(value)
    if found is None:
        raise UsageError(f"--user {name}={value}: {WANTED}")
    return Binding(value, function=_imported(name, found[1], found[2]))


def _number(text: str) -> float:
    sign = -1.0 if text.startswith("-") else 1.0
    return sign * to_number(text.lstrip("+-"))


def _imported(name: str, module_name: str, path: str) -> Callable[..., Any]:
    """The function of a module, which may lie in the current folder."""
    said = f"--user {name}={module_name}:{path}"
    here = str(Path.cwd())
    sys.path.insert(0, here)
    try:
        value: Any = importlib.import_module(module_name)
    except Exception as fault:
        raise UsageError(f"{said}: importing {module_name} failed: {fault!r}") from fault
    finally:
        sys.path.remove(here)
    for word in path.split("."):
        if not hasattr(value, word):
            from adamslite.language.likeness import did_you_mean

            hint = did_you_mean(word, [each for each in vars(value) if not each.startswith("_")])
            raise UsageError(f"{said}: there is no {word}" + f"; {hint.lower()}" * bool(hint))
        value = getattr(value, word)
    if not callable(value):
        raise UsageError(f"{said}: {path} is no function")
    return value


def is_installed(routine: str) -> bool:
    """Whether a package offers a function by the name of a routine; nothing of it is loaded."""
    return _offered_as(routine) is not None


def _installed(name: str) -> Binding:
    """The function that an installed package offers by a name."""
    entry = _offered_as(name)
    if entry is None:
        said = f"--user {name}={INSTALLED}: no installed package offers {name} in the group {GROUP}"
        known = ", ".join(sorted({each.name for each in offered()}))
        raise UsageError(said + f", which has {known}" * bool(known))
    return Binding(f"{entry.value} ({GROUP} {entry.name})", function=_loaded(entry))


def _offered_as(routine: str) -> EntryPoint | None:
    wanted = {routine.upper(), short_name(routine).upper()}
    return next((each for each in offered() if each.name.upper() in wanted), None)


@cache
def offered() -> tuple[EntryPoint, ...]:
    """All entry points of the group."""
    from importlib.metadata import entry_points

    return tuple(entry_points(group=GROUP))


def _loaded(entry: EntryPoint) -> Callable[..., Any]:
    try:
        return entry.load()
    except Exception as fault:
        said = f"entry point {entry.name} = {entry.value} of {GROUP}"
        raise UsageError(f"{said}: it cannot be loaded: {fault!r}") from fault


def _key(word: str) -> Key:
    return key_of(word)
