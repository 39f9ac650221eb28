"""What SAVE keeps of a session, and its text.

The text is JSON, and every number in it reads back exactly.  Of the model it holds what commands
have changed, as they were written; the deck itself must be the same.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, fields
from math import isfinite
from operator import is_
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import numpy as np

from adamslite.analyses.dynamics.dynamic import Settings
from adamslite.analyses.statics.static import StaticSettings
from adamslite.deck.redefinition import Redefinition
from adamslite.errors import UsageError
from adamslite.results.untrusted import from_json

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels
    from adamslite.language.interfaces import Key

S = TypeVar("S")
HEAD = "saved by adamslite"
VERSION = 1
ARRAYS = ("q", "u", "a", "base", "z", "mu", "ra", "rz", "rd", "pz")
Owner = tuple[Any, ...]
NONE: Mapping[Key, float] = {}


@dataclass(frozen=True)
class State:
    """Time, and the arrays of a system that the next analysis begins with.

    ``memories``: of kernels, as angles that are counted; ``dropped``: redundant rows; ``asleep``:
    sensors that have triggered, as :class:`~adamslite.analyses.dynamics.sensors.SensorLog` has
    them.
    """

    time: float
    at_rest: bool
    arrays: dict[str, np.ndarray]
    memories: dict[Owner, np.ndarray]
    dropped: list[int]
    asleep: dict[Key, float]

    @classmethod
    def of(
        cls, system: System, time: float, at_rest: bool, asleep: Mapping[Key, float] = NONE
    ) -> State:
        """A copy of the state that ``system`` holds."""
        system.count_states_from_here()
        arrays = {name: getattr(system, name).copy() for name in ARRAYS}
        memories = {whose: row.copy() for whose, row in system.instances.memories()}
        dropped = list(system.elimination.dropped)
        return cls(time, at_rest, arrays, memories, dropped, dict(asleep))

    def put_into(self, system: System) -> None:
        """Restore it, in the system that it is of or in one with the same unknowns."""
        system.count_states_from_here()
        if not self._fits(system):
            raise UsageError("RELOAD: the state is that of another model")
        for name, values in self.arrays.items():
            getattr(system, name)[:] = values
        system.instances.remember(self.memories.items())
        if list(system.elimination.dropped) != self.dropped:
            system.elimination.drop(self.dropped)
        system.settings.t = system.report.t = self.time

    def _fits(self, system: System) -> bool:
        """Whether sizes and rows are those of a system: native code takes them as they are."""
        sizes = {name: getattr(system, name).shape for name in self.arrays}
        rooms = {whose: values.shape for whose, values in system.instances.memories()}
        memories, rows = self.memories.items(), set(self.dropped)
        return (
            all(values.shape == sizes[name] for name, values in self.arrays.items())
            and all(rooms.get(whose, each.shape) == each.shape for whose, each in memories)
            and len(rows) == len(self.dropped)
            and all(0 <= row < system.m for row in rows)
        )


@dataclass(frozen=True)
class Kept:
    """A session: its state, the model in its present form, settings, what commands have changed."""

    state: State
    kernels: Kernels
    system: System
    settings: Settings
    statics: StaticSettings
    changes: tuple[Redefinition[Any], ...]

    def has_model_of(self, deck: Deck) -> bool:
        """Whether no command has changed the model since; SENVAL belongs to the state."""
        mine = self.kernels.model.deck
        same = len(deck.own) == len(mine.own) and deck.inactive == mine.inactive
        return same and all(map(is_, deck.own, mine.own))

    def text(self) -> str:
        """The session as text."""
        deck, state = self.kernels.model.deck, self.state
        whole = {
            HEAD: VERSION,
            "deck": deck.hash,
            "changes": [_source_of(each) for each in self.changes],
            "inactive": sorted(map(list, deck.inactive), key=str),
            "senvals": list(map(list, deck.senvals.items())),
            "settings": asdict(self.settings),
            "statics": asdict(self.statics),
            "time": state.time,
            "at rest": state.at_rest,
            "arrays": {name: values.tolist() for name, values in state.arrays.items()},
            "memories": [[*whose, values.tolist()] for whose, values in state.memories.items()],
            "dropped": [int(row) for row in state.dropped],
            "asleep": list(map(list, state.asleep.items())),
        }
        return json.dumps(whole, indent=1) + "\n"


@dataclass(frozen=True)
class Document:
    """A session as its text has it, for a deck."""

    state: State
    deck: Deck
    settings: Settings
    statics: StaticSettings
    changes: tuple[Redefinition[Any], ...]


def document(text: str, name: str, deck: Deck) -> Document:
    """What the text of a file says about ``deck``, which no command has changed yet.

    Raises
    ------
    UsageError
        When it is not the text of such a file, or that of another deck.
    """
    try:
        whole = from_json(text)
        if whole[HEAD] != VERSION:
            _refuse(name, "was written by another version")
        if whole["deck"] != deck.hash:
            _refuse(name, "belongs to another deck, or the deck has changed since")
        changes = tuple(_changes(whole["changes"], deck))
        for change in changes:
            deck = deck.after(change)
        for keyword, key in whole["inactive"]:
            deck = deck.with_active(keyword, [key], False)
        if whole["senvals"]:
            deck = deck.with_senvals(dict(whole["senvals"]))
        state = State(
            _finite(whole["time"]), bool(whole["at rest"]),
            {each: _numbers(whole["arrays"][each]) for each in ARRAYS},
            {tuple(whose): np.array(row, dtype=float) for *whose, row in whole["memories"]},
            [int(row) for row in whole["dropped"]],
            {key: float(until) for key, until in whole["asleep"]},
        )  # fmt: skip
        settings = _settings(Settings, whole["settings"])
        return Document(state, deck, settings, _settings(StaticSettings, whole["statics"]), changes)
    except UsageError:
        raise
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError):
        _refuse(name, "is not a file of SAVE")


def _refuse(name: str, why: str) -> NoReturn:
    raise UsageError(f"RELOAD: {name} {why}")


def _changes(texts: Iterable[str], deck: Deck) -> Iterable[Redefinition[Any]]:
    from adamslite.reading.read import read_commands  # which takes a while to load

    for text in texts:
        yield from (each for each in read_commands(text + "\n", deck)
                    if isinstance(each, Redefinition))  # fmt: skip


def _source_of(change: Redefinition[Any]) -> str:
    """A command as it was written."""
    source = change.spans.source
    if source is None:
        raise UsageError(f"SAVE/SYSTEM: {change.label} was changed without a text to keep")
    start, end = change.spans.whole_range
    return source.text[start:end]


def _finite(value: Any) -> float:
    if not isfinite(value):
        raise ValueError
    return float(value)


def _numbers(values: Any) -> np.ndarray:
    found = np.array(values, dtype=float)
    if not np.isfinite(found).all():
        raise ValueError
    return found


def _settings(kind: type[S], values: Mapping[str, Any]) -> S:
    """Settings that INTEGRATOR or EQUILIBRIUM can have; ValueError for others.

    JSON has lists for what was a tuple.
    """
    found = {}
    for each in fields(kind):  # type: ignore[arg-type]
        value = values[each.name]
        found[each.name] = tuple(value) if isinstance(value, list) else value
        if not TYPES[str(each.type)](found[each.name]):
            raise ValueError
        if each.name in POSITIVE and value is not None and value <= 0:
            raise ValueError
    return kind(**found)


def _is_number(value: Any) -> bool:
    return type(value) in (int, float) and isfinite(value)


def _is_count(value: Any) -> bool:
    return type(value) is int and value < 1 << 31


def _is_word(value: Any) -> bool:
    return type(value) is str


#: Whether a value is of the type that a setting is declared to have.
TYPES: dict[str, Callable[[Any], bool]] = {
    "int": _is_count,
    "float": _is_number,
    "str": _is_word,
    "float | None": lambda value: value is None or _is_number(value),
    "str | None": lambda value: value is None or _is_word(value),
    "tuple[str, ...]": lambda value: type(value) is tuple and all(map(_is_word, value)),
    "tuple[float, ...]": lambda value: type(value) is tuple and all(map(_is_number, value)),
}
POSITIVE = (
    "error", "hmax", "hmin", "hinit", "kmax", "maxit", "alimit", "tlimit", "imbalance",
)  # fmt: skip
