"""Stand-ins for the pipeline, so that the command line is tested without solving anything."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

import adamslite
from adamslite.deck.commands import Commands
from adamslite.deck.user_bindings import Bindings
from adamslite.language.diagnostics import Diagnostic, Source, Span
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

SUMMARY: Mapping[str, Any] = {
    "outcome": "DONE",
    "t_end": 1.0,
    "dof": 6,
    "steps": 10,
    "rejected": 0,
    "newton": 20,
    "jacobians": 2,
    "factorizations": 3,
    "setup_cpu_s": 0.1,
    "solve_cpu_s": 0.2,
    "max_violation": 0.0,
}


def fall(steps: int = 10, **facts: Any) -> Results:
    """Return x = t^2 / 2 and v = t of PART/2 at `steps` + 1 times from 0 to 1."""
    time = np.linspace(0.0, 1.0, steps + 1)
    return Results(
        time=time,
        names=("PART/2.x", "PART/2.vx"),
        values=np.column_stack([time**2 / 2, time]),
        **{"summary": SUMMARY, **facts},
    )


@dataclass
class Pipeline:
    """What `read`, `check`, `read_commands` and `simulate` shall give, and what they were given."""

    statements: tuple[Any, ...] = ()
    diagnostics: tuple[Any, ...] = ()
    results: Results = field(default_factory=fall)
    linearization: Any = None
    calls: list[dict[str, Any]] = field(default_factory=list)
    commands_read: list[Any] = field(default_factory=list)

    def simulate(self, deck: Any, journal: Any = None, file: Any = None, **options: Any) -> Results:
        self.calls.append(options)
        return self.results

    def linearize(self, deck: Any, **options: Any) -> Any:
        self.calls.append(options)
        return self.linearization


@dataclass(frozen=True)
class Named:
    """A statement of which only the keyword matters."""

    keyword: str


SIMULATE = Named("SIMULATE")
ERROR = Diagnostic("E1", "error", "there is no MARKER/7", Span("cable.adm", 2, 4, 2, 5))


@dataclass(frozen=True)
class FakeDeck:
    statements: tuple[Any, ...]
    source: Source = Source("")
    incomplete: frozenset[str] = frozenset()

    @property
    def own(self) -> tuple[Any, ...]:
        """All statements."""
        return self.statements

    user: Bindings = field(default_factory=Bindings)

    def is_active(self, statement: Any) -> bool:
        return True

    def of(self, kind: Any) -> list[Any]:
        """The real ones of a class: a stand-in has no arguments to look at."""
        return [each for each in self.statements if isinstance(kind, type) and type(each) is kind]

    def find(self, kind: Any, id: int) -> SimpleNamespace:
        """Every marker is on a body of its own."""
        return SimpleNamespace(owner=("PART", id))


def stopped(outcome: Outcome, **facts: Any) -> Results:
    """Return `fall` with another end."""
    return fall(outcome=outcome, summary={**SUMMARY, "outcome": outcome.name}, **facts)


def install(monkeypatch: pytest.MonkeyPatch, pipeline: Pipeline) -> None:
    """Put `pipeline` in the place of the real one."""

    def read_commands(path: Any, deck: Any) -> Commands:
        pipeline.commands_read.append(path)
        return Commands([Named("SIMULATE")])

    fakes = {
        "read": lambda path, user, values: FakeDeck(pipeline.statements),
        "check": lambda deck: pipeline.diagnostics,
        "simulate": pipeline.simulate,
        "linearize": pipeline.linearize,
    }
    for name, fake in fakes.items():
        monkeypatch.setitem(vars(adamslite), name, fake)
    deck_module = ModuleType("adamslite.reading.read")
    deck_module.read_commands = read_commands
    deck_module.Commands = Commands
    monkeypatch.setitem(sys.modules, "adamslite.reading.read", deck_module)
