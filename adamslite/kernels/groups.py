"""Compiled kernels as a run takes them: groups of instances, entry points, facts of each shape."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from adamslite.native import compiler

if TYPE_CHECKING:  # kernels that are kept between runs were written earlier
    from adamslite.deck.python_routine import Routine
    from adamslite.kernels.code.shape import Outputs
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.model.model import MassCentre, Model, NodeKey
    from adamslite.symbolic.interpolant import Interpolant
    from adamslite.symbolic.scope import Scope


Meta: TypeAlias = dict[str, Any]
"""What an instance of a shape must provide, see :mod:`adamslite.kernels.code.module_text`."""

LEVELS = ("reactions", "position", "velocity", "acceleration")
WITH_JACOBIAN = ("loads", "equation", *LEVELS)


@dataclass
class Binding:
    """One instance: what fills the slots of its shape."""

    markers: list[Key | MassCentre] = field(default_factory=list)
    bodies: list[int] = field(default_factory=list)
    nodes: list[NodeKey] = field(default_factory=list)
    params: list[float] = field(default_factory=list)
    signals: list[Key] = field(default_factory=list)
    tables: list[Interpolant | Routine] = field(default_factory=list)


class Writer(Protocol):
    """What writes the kernels of a shape, :class:`adamslite.kernels.compile.FaceWriter`."""

    binder: Any

    @property
    def n_bodies(self) -> int: ...
    def kernels(self, name: str) -> tuple[str, Meta]: ...
    def lanes(self, name: str, mass: str) -> str: ...
    def __call__(self, scope: Scope) -> Outputs: ...


@dataclass
class ShapeGroup:
    """The instances of one shape: ``face`` names what its kernels compute.

    ``write`` writes them where their code is not there yet.
    """

    face: str
    name: str
    write: Writer | None
    instances: list[tuple[Statement, Binding]] = field(default_factory=list)
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
        return len(self.instances[0][1].bodies)

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

    ``outputs``: (statement, result names) in the order of the output rows.  ``columns``: names of
    the columns of results, once they are known.
    """

    model: Model
    groups: list[ShapeGroup]
    outputs: list[tuple[Statement, tuple[str, ...]]]
    addresses: dict[str, int]
    compiled: int
    columns: tuple[str, ...] | None = None


def linked(groups: list[ShapeGroup]) -> dict[str, int]:
    """Addresses of all native functions, by name."""
    return compiler.addresses((group.code, group.entry_points) for group in groups)
