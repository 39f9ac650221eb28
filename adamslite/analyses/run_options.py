"""The options of a run as a caller gives them, checked: names in capitals, numbers that can be."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf, nan
from numbers import Integral, Real
from typing import Any

from adamslite.elements.integrator import Integrator
from adamslite.errors import UsageError
from adamslite.language.likeness import did_you_mean

POSITIVE = ("end", "error", "hmax", "cpu_limit")
WHOLE = ("steps", "max_steps")
FORMULATIONS = ("I3", "SI2")


def checked(options: Mapping[str, Any]) -> dict[str, Any]:
    """Those of ``end steps integrator formulation error hmax cpu_limit max_steps`` that are given.

    Raises
    ------
    UsageError
        For a number that is not positive, a name that there is not.
    """
    given = {name: value for name, value in options.items() if value is not None}
    for name in POSITIVE:
        if name in given:
            given[name] = _positive(name, given[name])
    for name in WHOLE:
        if name in given:
            given[name] = _count(name, given[name])
    names = {
        "integrator": Integrator.arguments["method"].supported,
        "formulation": FORMULATIONS,
    }
    for name, known in names.items():
        if name in given:
            given[name] = _one_of(name, given[name], known)
    return given


def _positive(name: str, value: object) -> float:
    number = float(value) if isinstance(value, Real) else nan
    if not 0.0 < number < inf:
        raise UsageError(f"{_flag(name)} {value}: it must be a positive number")
    return number


def _flag(name: str) -> str:
    """An option as the command line has it."""
    return f"--{name.replace('_', '-')}"


def _count(name: str, value: object) -> int:
    whole = isinstance(value, Integral) or (isinstance(value, float) and value.is_integer())
    if not whole or not isinstance(value, Integral | float) or value < 1:
        raise UsageError(f"{_flag(name)} {value}: it must be a whole number, at least 1")
    return int(value)


def _one_of(name: str, value: object, known: Sequence[str]) -> str:
    word = str(value).upper()
    if word not in known:
        hint = did_you_mean(word, known)
        raise UsageError(
            f"--{name} {value}: there are {', '.join(known)}" + f"; {hint}" * bool(hint)
        )
    return word
