"""The definition of a statement: a frozen dataclass whose fields declare its arguments.

>>> @statement("SFORCE")
... class Sforce(Statement):
...     i: int | str = reference("I", to="MARKER", required=True, help="marker the force acts on")
...     function: Node = expression("FUNCTION", required=True, help="size of the force")

Nothing else describes or validates the arguments; readers, checkers and manuals ask the class.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import FrozenInstanceError, dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar, TypeAlias, TypedDict, TypeVar, Unpack

from adamslite.language.diagnostics import Span, Spans
from adamslite.language.expression import Node, names_called
from adamslite.language.interfaces import DrawnModel, Key, Lookup
from adamslite.language.register import Register

STATEMENTS: Register[type[Statement]] = Register("adamslite.elements")
INTERNAL: dict[str, type[Statement]] = {}
"""Statements that only others bring with them: no deck has them."""
NO_SPANS = Spans()
S = TypeVar("S", bound="Statement")
Field: TypeAlias = Any
"""What declares a field in the body of a class stands for the value that the field will have."""


@dataclass(frozen=True, slots=True)
class Argument:
    """How one field of a statement is written in a deck.

    Parameters
    ----------
    kind : str
        ``number vector vectors integer flag choice reference references ids expression text texts
        words``.
    keys : tuple of str
        The keyword and its aliases, in capitals.
    help, unit : str
        Meaning and physical unit, for the manual.
    default : object
        Value of the field when the argument is omitted.
    required : bool
        Whether omitting it is a mistake.
    sizes : tuple of int
        Least and greatest number of values of a vector, of each one where there are several.
    to : str
        Keyword of the statement a reference names.
    options : tuple of str
        Words a choice may take.
    discontinued : tuple of pairs
        Options that ADAMS has discontinued, and what to write instead of each.
    supported : tuple of str
        Those options the program can run; empty means all.
    bare : bool
        A choice whose options are written as flags, without ``KEY=``.
    start : bool
        A value that counts only where a model starts from.
    inert : bool
        It does not change the motion: it is read, and one note reports that it is passed over.
    fills : tuple of str
        Fields of the components of a vector, which are given by it; its own stays empty.
    name : str
        Name of the field.
    """

    kind: str
    keys: tuple[str, ...]
    help: str
    unit: str = ""
    default: object = None
    required: bool = False
    sizes: tuple[int, int] = (1, 1)
    to: str = ""
    options: Sequence[str] = ()
    supported: Sequence[str] = ()
    discontinued: tuple[tuple[str, str], ...] = ()
    bare: bool = False
    start: bool = False
    inert: bool = False
    fills: tuple[str, ...] = ()
    name: str = ""

    @property
    def key(self) -> str:
        """The keyword to show to people."""
        return self.keys[0] if self.keys else " | ".join(self.options)


class ListFacts(TypedDict, total=False):
    """What any argument may have, see :class:`Argument`."""

    required: bool
    supported: Sequence[str]
    discontinued: tuple[tuple[str, str], ...]
    start: bool
    inert: bool


class Facts(ListFacts, total=False):
    """The same of those that are not empty lists where they are omitted."""

    default: object
    fills: tuple[str, ...]


def _declare(argument: Argument) -> Field:
    return field(default=argument.default, metadata={"argument": argument})


def number(*keys: str, help: str, unit: str, **facts: Unpack[Facts]) -> Field:
    """One real number (a constant expression is evaluated)."""
    return _declare(Argument("number", keys, help=help, unit=unit, **facts))


def vector(
    *keys: str, size: int, help: str, unit: str, most: int = 0, **facts: Unpack[Facts]
) -> Field:
    """``size`` real numbers, or from ``size`` to ``most``."""
    sizes = (size, most or size)
    return _declare(Argument("vector", keys, help=help, unit=unit, sizes=sizes, **facts))


def vectors(*keys: str, size: int, most: int, help: str, unit: str) -> Field:
    """Lists of ``size`` to ``most`` real numbers, ``KEY=`` once for each."""
    sizes = (size, most)
    return _declare(Argument("vectors", keys, help=help, unit=unit, sizes=sizes, default=()))


def integer(*keys: str, help: str, unit: str = "", **facts: Unpack[Facts]) -> Field:
    """One whole number."""
    return _declare(Argument("integer", keys, help=help, unit=unit, **facts))


def flag(*keys: str, help: str, inert: bool = False) -> Field:
    """A word without a value."""
    return _declare(Argument("flag", keys, help=help, default=False, inert=inert))


def choice(*keys: str, options: Sequence[str], help: str, **facts: Unpack[Facts]) -> Field:
    """One word of several: ``KEY=WORD``, or just ``WORD`` when no key is given."""
    return _declare(Argument("choice", keys, help=help, options=options, bare=not keys, **facts))


def reference(*keys: str, to: str, help: str, **facts: Unpack[Facts]) -> Field:
    """The id or name of another statement; a marker may also be written ``KEY_MARKER=``."""
    if to == "MARKER":
        keys += tuple(f"{key}_MARKER" for key in keys if not key.endswith("MARKER"))
    return _declare(Argument("reference", keys, help=help, to=to, **facts))


def references(*keys: str, to: str, help: str, **facts: Unpack[ListFacts]) -> Field:
    """Ids or names of several statements."""
    return _declare(Argument("references", keys, help=help, to=to, default=(), **facts))


def ids(*keys: str, help: str, **facts: Unpack[ListFacts]) -> Field:
    """Ids or names of several statements, of a kind that another argument gives."""
    return _declare(Argument("ids", keys, help=help, default=(), **facts))


def expression(*keys: str, help: str, unit: str = "", **facts: Unpack[Facts]) -> Field:
    """A function expression; the last argument, or closed by a backslash."""
    return _declare(Argument("expression", keys, help=help, unit=unit, **facts))


def text(*keys: str, help: str, **facts: Unpack[Facts]) -> Field:
    """Free text up to the next comma."""
    return _declare(Argument("text", keys, help=help, **facts))


def texts(*keys: str, help: str, **facts: Unpack[ListFacts]) -> Field:
    """Several texts, separated by commas."""
    return _declare(Argument("texts", keys, help=help, default=(), **facts))


def words(*keys: str, options: tuple[str, ...], help: str, **facts: Unpack[ListFacts]) -> Field:
    """Words separated by colons, as in ``X:Y:PSI``."""
    return _declare(Argument("words", keys, help=help, options=options, default=(), **facts))


@dataclass(init=False, repr=False, eq=False)
class Statement:
    """A statement of the deck as data; frozen, all fields by keyword.

    Parameters
    ----------
    id : int or str
        A number (leading zeros dropped) or the name as written; 0 for statements without id.
    name : str or None
        The name from the ``! adams_view_name='...'`` comment before the statement.
    spans : Spans
        Places of the arguments that were given, by field name.
    """

    keyword: ClassVar[str] = ""
    arguments: ClassVar[Mapping[str, Argument]] = {}
    field_names: ClassVar[frozenset[str]] = frozenset()
    singleton: ClassVar[bool] = False
    repeatable: ClassVar[bool] = False
    place: ClassVar[str] = "deck"
    ends: ClassVar[bool] = False
    ignored: ClassVar[bool] = False
    inert: ClassVar[bool] = False
    inert_fields: ClassVar[tuple[str, ...]] = ()
    planned: ClassVar[tuple[str, ...]] = ()
    body: ClassVar[bool] = False
    data: ClassVar[bool] = False
    acts_with: ClassVar[str] = ""
    """The field that names the statement without which this one does nothing."""
    alternatives: ClassVar[tuple[tuple[tuple[str, ...], ...], ...]] = ()
    """Groups of fields that exclude each other: giving one in a command drops the other groups."""

    id: Key = 0
    name: str | None = None
    spans: Spans = field(default_factory=Spans)

    @property
    def span(self) -> Span:
        """The place of the whole statement."""
        return self.spans.whole

    @property
    def label(self) -> str:
        """What results and messages call it: ``SFORCE/5``, ``VARIABLE/Dm``."""
        return self.keyword if self.singleton else f"{self.keyword}/{self.id}"

    @property
    def key(self) -> Key:
        """The id as references to this statement hold it: a number or a name in capitals."""
        return self.id.upper() if isinstance(self.id, str) else self.id

    def __init__(self, **values: object) -> None:
        # One initialiser for all classes, and the dictionary directly: generated ones cost more
        # than reading the deck.  Defaults stay with the class.
        known = self.field_names
        if not values.keys() <= known:
            unknown = ", ".join(sorted(values.keys() - known))
            raise TypeError(f"{type(self).__name__} has no field {unknown}")
        self.__dict__.update(values)
        self.__dict__.setdefault("spans", NO_SPANS)

    def __setattr__(self, name: str, value: object) -> None:
        raise FrozenInstanceError(f"cannot assign to field {name!r}")

    def __repr__(self) -> str:
        given = ", ".join(f"{n}={getattr(self, n)!r}" for n in self.spans if n in self.field_names)
        return f"<{self.label} {given}>"

    @cached_property
    def called(self) -> frozenset[str]:
        """Names of the functions that its expressions call."""
        return names_called(expressions(self))

    @classmethod
    def completed(
        cls, values: dict[str, object], body: tuple[str, Key | None] | None
    ) -> dict[str, object]:
        """Values that follow from keyword and id of the nearest body before the statement."""
        return {}

    def companions(self, deck: Lookup) -> tuple[Statement, ...]:
        """Statements this one brings with it; ``deck`` finds those it refers to."""
        return ()

    def loaded(self, folder: Path) -> Statement:
        """The statement with what its file holds, which is in the folder of the deck."""
        return self

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """Further values its physics need, from the model as drawn.

        Numbers and expressions become symbols; words decide the form; tuples may hold either.  An
        :class:`~adamslite.symbolic.interpolant.Interpolant` becomes a number that stands for the
        table.
        """
        return {}

    @property
    def result_names(self) -> tuple[str, ...]:
        """Names of the values it writes at output times."""
        return ()

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``, as expressions."""
        return []

    def routine_count(self, fields: int) -> int:
        """How many numbers a routine of the user returns for it, where so many fields call it."""
        return fields

    @property
    def numbers_only(self) -> bool:
        """Whether only numbers can stand for a routine of the user, no function."""
        return False

    def of_routine(self, fields: Sequence[str], values: Sequence[Node | None]) -> dict[str, object]:
        """What fields become where they call a routine of the user that returns these values."""
        return dict(zip(fields, values, strict=True))

    def constants(self) -> dict[str, float]:
        """Numbers this statement gives a name that expressions may use, names in capitals."""
        return {}

    def numbered(self) -> Sequence[Node]:
        """Values that expressions take by their number, counted from 1 (ARYVAL)."""
        return ()

    def given(self, field_name: str) -> bool:
        """Whether the deck has this argument."""
        return field_name in self.spans


def class_of(keyword: str) -> type[Statement]:
    """The class of a statement, internal or not."""
    return INTERNAL.get(keyword) or STATEMENTS[keyword]


def expressions(statement: Statement) -> list[Node]:
    """The expressions among a statement's arguments."""
    values = (
        getattr(statement, name)
        for name, argument in statement.arguments.items()
        if argument.kind == "expression"
    )
    return [value for value in values if value is not None]


def _with_fields(cls: type[S]) -> type[S]:
    """A class as a dataclass, with what is known of its fields."""
    made = dataclass(init=False, repr=False, eq=False)(cls)
    made.arguments = {
        f.name: replace(f.metadata["argument"], name=f.name)
        for f in fields(made)
        if "argument" in f.metadata
    }
    made.field_names = frozenset(f.name for f in fields(made))
    made.inert_fields = tuple(name for name, each in made.arguments.items() if each.inert)
    return made


def statement(
    keyword: str,
    *,
    singleton: bool = False,
    repeatable: bool = False,
    place: str = "deck",
    ends: bool = False,
    ignored: bool = False,
    inert: bool = False,
    planned: tuple[str, ...] = (),
    body: bool = False,
    data: bool = False,
    internal: bool = False,
) -> Callable[[type[S]], type[S]]:
    """Register a class as the statement ``keyword``.

    Parameters
    ----------
    keyword : str
        In capitals.
    singleton : bool
        Written without id (``UNITS/...``), so the first item is an argument already.
    repeatable : bool
        A singleton that may stand more than once.
    place : str
        Where it may stand: ``"deck"``, ``"command"`` or ``"both"``.
    ends : bool
        Reading stops after it.
    ignored : bool
        Its arguments are not read, at most kept as written.
    inert : bool
        It does not change the motion: one note reports that it is passed over.
    planned : tuple of str
        Keywords that are part of the language and cannot be run yet.
    body : bool
        Markers without an owner behind it belong to it.
    data : bool
        Its arguments are seen by no kernel, only what it derives from them: tables.
    internal : bool
        No deck has it: another statement brings it with it.
    """

    def register(cls: type[S]) -> type[S]:
        made = _with_fields(cls)
        made.keyword, made.place, made.data, made.inert = keyword, place, data, inert
        made.singleton, made.repeatable = singleton, repeatable
        made.ends, made.ignored, made.planned, made.body = ends, ignored, planned, body
        if internal:
            INTERNAL[keyword] = made
        else:
            STATEMENTS.enter(keyword, made, cls.__module__)
        return made

    return register
