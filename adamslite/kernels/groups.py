"""Compiled kernels as a run takes them: groups of instances, entry points, facts of each shape."""

from __future__ import annotations

from array import array
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

import adamslite
from adamslite.native import compiler, processor

if TYPE_CHECKING:  # kernels that are kept between runs were written earlier
    from adamslite.kernels.code.shape import Outputs
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model
    from adamslite.symbolic.scope import Scope


Meta: TypeAlias = dict[str, Any]
"""What an instance of a shape must provide, see :mod:`adamslite.kernels.code.module_text`."""

LEVELS = ("reactions", "position", "velocity", "acceleration")
WITH_JACOBIAN = ("loads", "equation", *LEVELS)


@dataclass(slots=True)
class Binding:
    """What fills the slots of a shape: of one instance, or of all of them, column by column."""

    markers: list[Any] = field(default_factory=list)
    """Markers, ``("PART", id)`` for a mass centre: :data:`Key` or :data:`MassCentre`."""
    bodies: list[Any] = field(default_factory=list)
    """Numbers of bodies."""
    nodes: list[Any] = field(default_factory=list)
    """:data:`NodeKey`"""
    params: list[Any] = field(default_factory=list)
    """Numbers."""
    signals: list[Any] = field(default_factory=list)
    """Ids of VARIABLEs."""
    tables: list[Any] = field(default_factory=list)
    """:class:`Interpolant` or :class:`Routine`"""

    def fields(self) -> Iterator[list[Any]]:
        """Its lists of slots."""
        return (getattr(self, name) for name in self.__slots__)

    def row(self, number: int | slice) -> Binding:
        """One instance of many, or some."""
        return Binding(*([column[number] for column in columns] for columns in self.fields()))


@dataclass(frozen=True, eq=False)
class Bundle:
    """Statements whose results one kernel writes; it goes by the name of the first one."""

    members: tuple[Statement, ...]

    def parted(self, number: int) -> tuple[Writing, Writing]:
        """The members before that of a number, at least one, and the others."""
        at = max(number, 1)
        return _together(self.members[:at]), _together(self.members[at:])


Writing: TypeAlias = "Statement | Bundle"


def members_of(writing: Writing) -> tuple[Statement, ...]:
    """The statements of a bundle; of a statement itself."""
    return writing.members if isinstance(writing, Bundle) else (writing,)


def replaced(writing: Writing, changed: Mapping[int, Statement]) -> Writing:
    """A statement, or a bundle, with those that changed; ``changed``: by ``id`` of the old ones."""
    if not isinstance(writing, Bundle):
        return changed.get(id(writing), writing)
    if not any(id(each) in changed for each in writing.members):
        return writing
    return Bundle(tuple([changed.get(id(each), each) for each in writing.members]))


def _together(members: tuple[Statement, ...]) -> Writing:
    return Bundle(members) if len(members) > 1 else members[0]


class Instances(Sequence[tuple["Statement", Binding]]):
    """The instances of a shape: statements, and in ``columns`` what fills each slot in all of them.

    Numbers and ids are arrays: objects for each instance would take ten times the memory.
    """

    def __init__(self, writing: Sequence[Writing], columns: Binding) -> None:
        self._enter(writing)
        self.columns = Binding(*([*map(compact, found)] for found in columns.fields()))

    def _enter(self, writing: Sequence[Writing]) -> None:
        self.bundles = [each for each in writing if isinstance(each, Bundle)]
        """What writes together; the statements are the first ones then."""
        self.statements: Sequence[Statement] = [members_of(each)[0] for each in writing]

    @property
    def writing(self) -> Sequence[Writing]:
        """The bundles, or the statements."""
        return self.bundles or self.statements

    def but(self, writing: Sequence[Writing], columns: Binding) -> Instances:
        """The same instances with other statements and columns, which are compact."""
        made = Instances.__new__(Instances)
        made._enter(writing)
        made.columns = columns
        return made

    def __len__(self) -> int:
        return len(self.statements)

    def __getitem__(self, number: Any) -> Any:
        return self.statements[number], self.columns.row(number)


def compact(column: Sequence[Any]) -> Sequence[Any]:
    """A column as an array where it has nothing but whole numbers, or nothing but reals."""
    kinds = set(map(type, column))
    with suppress(OverflowError):
        if kinds == {int}:
            return array("q", column)
    return array("d", column) if all(issubclass(kind, float) for kind in kinds) else column


class Writer(Protocol):
    """What writes the kernels of a shape, :class:`adamslite.kernels.face_writer.FaceWriter`."""

    binder: Any

    @property
    def n_bodies(self) -> int: ...
    def kernels(self, name: str) -> tuple[str, Meta]: ...
    def lanes(self, name: str, mass: str) -> str: ...
    def tangents(self, name: str, n_ints: int) -> str: ...
    def pullback(self, name: str, n_ints: int) -> str: ...
    def __call__(self, scope: Scope) -> Outputs: ...


@dataclass
class ShapeGroup:
    """The instances of one shape: ``face`` names what its kernels compute.

    ``write`` writes them where their code is not there yet.
    """

    face: str
    name: str
    write: Writer | None
    instances: Instances
    code: bytes = b""
    meta: Meta = field(default_factory=dict)

    @property
    def writer(self) -> Writer:
        """``write`` of kernels that are new."""
        assert self.write is not None
        return self.write

    @property
    def n_bodies(self) -> int:
        """Bodies of each instance."""
        return len(self.instances.columns.bodies)

    @property
    def entry(self) -> str:
        """The entry of the cache with its object code."""
        return f"{self.name}.o"

    @property
    def entry_points(self) -> list[str]:
        """Names of its native functions."""
        names = [f"{self.name}_residual"]
        if self.face in WITH_JACOBIAN:
            names.append(f"{self.name}_jacobian")
        if self.meta["tracks"]:
            names.append(f"{self.name}_track")
        kinds = self.meta["guards"]
        names += [f"{self.name}_clock"] if kinds["clock"] else []
        names += [f"{self.name}_watch"] if kinds["watch"] or kinds["zone"] else []
        return names


@dataclass
class Kernels:
    """A model with its compiled groups and the values it writes.

    ``outputs``: (statement, result names) in the order of the output rows.
    """

    model: Model
    groups: list[ShapeGroup]
    outputs: list[tuple[Statement, tuple[str, ...]]]
    addresses: dict[str, int]
    compiled: int
    shared: dict[Hashable, Any] = field(default_factory=dict, compare=False, repr=False)
    """What is made of them whatever the numbers are: layouts by formulation, names of columns."""
    refill: Any = field(default=None, compare=False, repr=False)
    """What puts other numbers into these kernels, once it has been asked for."""

    @property
    def audited(self) -> bool:
        """Whether they follow what elements store."""
        return any(group.face == "stored" for group in self.groups)

    def __getstate__(self) -> dict[str, Any]:
        """Object code and the processor that it is for; addresses are those of this process."""
        groups = [replace(group, write=None) for group in self.groups]
        own = {"groups": groups, "addresses": {}, "compiled": 0, "shared": {}, "refill": None}
        return {**vars(self), **own, "processor": processor.identity()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        made_for = state.pop("processor")
        vars(self).update(state)
        if made_for != processor.identity():
            # Code for another processor is made again, which few who unpickle need.
            compiling = import_module("adamslite.kernels.compile")
            made = compiling.compile_model(self.model, audited=self.audited)
            vars(self).update(vars(made))
        elif all(group.code for group in self.groups):
            self.addresses = linked(self.groups)

    def with_values(self, values: Mapping[str, float] | Iterable[str]) -> Kernels:
        """Kernels of the deck with other numbers, ``{"SPRINGDAMPER/1.K": 90}``.

        Raises
        ------
        DeckError
            With the mistakes that the deck then has.
        UsageError
            When there is no number of a name, or a value is no finite number.
        """
        made: Kernels = adamslite.with_values(self, values)
        return made


def linked(groups: list[ShapeGroup]) -> dict[str, int]:
    """Addresses of all native functions, by name."""
    return compiler.addresses((group.code, group.entry_points) for group in groups)
