"""Deck functions: the signature of a call, and the Python function that evaluates it.

A deck function is one Python function under a signature::

    @function("DX", "i:marker j:marker=0 k:marker=0")
    def dx(scope, i, j, k):
        \"""...\"""

Its body receives a :class:`adamslite.symbolic.scope.Scope` and one value per parameter, and returns
an expression.  Its docstring is its page in the manual.

The words of a signature are separated by blanks:

==================  ============================================================================
``x:number``        any expression; the body gets an expression
``c:constant``      a number written in the deck that decides the form of the result; the body
                    gets an ``int``
``c:constant{1..8}``  the same, with the values allowed (``{1..12,27}``)
``e:exponent``      any expression; a number of :data:`PRODUCTS` decides the form of the result
``v:vector``        a vector, see :mod:`adamslite.functions.vectors`
``e:past``          any expression; the body gets a table of its past values over TIME
``i:marker``        the id of a MARKER; the body gets a frame
``id:joint``        the id of a statement of that name (variable, diff, sforce ...); the body gets
                    what ``scope.statement(id)`` turns into that statement
``x:number=0``      optional, with its default; default 0 of a marker is the ground frame
``*a:number[1..31]``  the rest of the arguments, with how many of them there may be (``[2..]``)
``e:number:``       followed by a colon instead of a comma in a deck
==================  ============================================================================
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from inspect import cleandoc

from adamslite.language.register import Register
from adamslite.symbolic.types import Expr

NUMERIC_KINDS = ("number", "exponent", "constant", "vector", "past")
PRODUCTS = (1.0, 1.5, 2.0, 3.0)
"""Exponents for which products and a root take the place of a power."""

Mistake = tuple[int, str]
Rule = Callable[..., Mistake | None]
Body = Callable[..., Expr]
Edges = Callable[..., tuple[Expr, ...]]


@dataclass(frozen=True)
class Parameter:
    """One parameter of a deck function.

    ``default`` is ``None`` where the argument is required; ``allowed`` is empty where any value is
    legal; ``counts`` is the range of argument counts of a ``*`` parameter (no upper end: ``None``).
    """

    name: str
    kind: str
    default: float | None = None
    allowed: tuple[int, ...] = ()
    counts: tuple[int, int | None] | None = None

    @property
    def statement(self) -> str | None:
        """The statement an id refers to, such as ``"MARKER"``; ``None`` for numbers."""
        return None if self.kind in NUMERIC_KINDS else self.kind.upper()


@dataclass(frozen=True)
class Function:
    """A deck function.

    ``edges`` takes the same arguments as a call and returns the expressions that pass through zero
    where the function is not smooth; there its derivatives up to ``order`` are continuous (-1: the
    value itself jumps).  ``rule`` takes the numbers of a call (``None`` where not yet known) and
    returns (argument index, sentence) when they cannot stand together.
    """

    name: str
    parameters: tuple[Parameter, ...]
    body: Body
    doc: str
    colon: bool = False
    edges: Edges | None = None
    order: int | None = None
    rule: Rule | None = None

    @property
    def smooth(self) -> bool:
        """True when every derivative is continuous wherever the function is defined."""
        return self.edges is None

    @cached_property
    def minimum(self) -> int:
        """The least number of arguments."""
        return sum(p.counts[0] if p.counts else p.default is None for p in self.parameters)

    @cached_property
    def maximum(self) -> int | None:
        """The largest number of arguments; ``None`` when there is no limit."""
        if not self.parameters:
            return 0
        last = self.parameters[-1]
        if not last.counts:
            return len(self.parameters)
        return None if last.counts[1] is None else len(self.parameters) - 1 + last.counts[1]

    @property
    def limits(self) -> str:
        """How many arguments it takes, in words."""
        least, most = self.minimum, self.maximum
        if least == most:
            return f"{least} argument{'s' * (least != 1)}"
        return f"{least} or more arguments" if most is None else f"{least} to {most} arguments"

    @cached_property
    def ruled(self) -> bool:
        """Whether numbers of a call can be wrong."""
        return bool(self.rule) or any(parameter.allowed for parameter in self.parameters)

    @cached_property
    def takes_past(self) -> bool:
        """Whether it needs past values of an argument."""
        return any(p.kind == "past" for p in self.parameters)

    def parameter(self, index: int) -> Parameter:
        """The parameter that takes argument number ``index``, counted from 0."""
        return self.parameters[min(index, len(self.parameters) - 1)]

    @property
    def usage(self) -> str:
        """How a deck writes the call: ``DX(i[, j][, k])``."""
        text = ""
        for index, p in enumerate(self.parameters):
            comma = "" if index == 0 else ": " if index == 1 and self.colon else ", "
            word = f"{p.name}, ..." if p.counts else p.name
            text += comma + word if p.default is None else f"[{comma}{word}]"
        return f"{self.name}({text})"

    def mistakes(self, values: Sequence[float | None]) -> list[Mistake]:
        """What is wrong with the numbers of a call: (argument index, sentence).

        ``values`` has one entry per argument, ``None`` for ids and for what a run decides.
        """
        found = []
        for index, value in enumerate(values):
            p = self.parameter(index)
            if p.allowed and value is not None and value not in p.allowed:
                found.append((index, f"{p.name} of {self.name} must be {listed(p.allowed)}"))
        if self.rule and not found and len(values) >= self.minimum:
            mistake = self.rule(*values, *(p.default for p in self.parameters[len(values) :]))
            if mistake:
                found.append(mistake)
        return found


FUNCTIONS: Register[Function] = Register("adamslite.functions")
INTERNAL: dict[str, Function] = {}
"""Functions that only statements use: no deck has them."""


def find_function(name: str) -> Function:
    """The function of that name, internal or not."""
    return INTERNAL.get(name) or FUNCTIONS[name]


def function(
    name: str,
    signature: str,
    *,
    edges: Edges | None = None,
    order: int | None = None,
    rule: Rule | None = None,
    internal: bool = False,
) -> Callable[[Body], Body]:
    """Register the decorated body as deck function ``name``; see the module for the signature.

    ``internal``: no deck may use it, only statements do.
    """
    words = signature.split()
    colon = bool(words) and words[0].endswith(":")

    def register(body: Body) -> Body:
        parameters = tuple(_parameter(word.removesuffix(":")) for word in words)
        made = Function(
            name, parameters, body, cleandoc(body.__doc__ or ""), colon, edges, order, rule
        )
        if internal:
            INTERNAL[name] = made
        else:
            FUNCTIONS.enter(name, made, body.__module__)
        return body

    return register


def ascending(first: int, second: int, sentence: str) -> Rule:
    """A rule: argument ``first`` must be below argument ``second``."""

    def rule(*values: float | None) -> Mistake | None:
        low, high = values[first], values[second]
        wrong = low is not None and high is not None and low >= high
        return (second, sentence) if wrong else None

    return rule


def _parameter(word: str) -> Parameter:
    word, _, default = word.partition("=")
    word, _, counts = word.partition("[")
    word, _, allowed = word.partition("{")
    name, _, kind = word.partition(":")
    if not kind:
        raise ValueError(f"no kind in signature word {word!r}")
    return Parameter(
        name.removeprefix("*"),
        kind,
        float(default) if default else None,
        _values(allowed.removesuffix("}")) if allowed else (),
        _range(counts.removesuffix("]")) if name.startswith("*") else None,
    )


def _range(text: str) -> tuple[int, int | None]:
    low, _, high = text.partition("..")
    return int(low), int(high) if high else None


def _values(text: str) -> tuple[int, ...]:
    found: list[int] = []
    for piece in text.split(","):
        low, _, high = piece.partition("..")
        found.extend(range(int(low), int(high or low) + 1))
    return tuple(found)


def listed(allowed: tuple[int, ...]) -> str:
    """``(1, 2, 3, 27)`` as "1..3 or 27"."""
    runs: list[list[int]] = []
    for value in allowed:
        if runs and value == runs[-1][-1] + 1:
            runs[-1].append(value)
        else:
            runs.append([value])
    return " or ".join(
        f"{run[0]}..{run[-1]}" if len(run) > 2 else " or ".join(map(str, run)) for run in runs
    )
