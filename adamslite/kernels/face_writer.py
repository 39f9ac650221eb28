"""What writes the kernels of one face of statements of one shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from adamslite.kernels.binding import Binder
from adamslite.kernels.groups import WITH_JACOBIAN, Meta
from adamslite.kernels.reader import ExpressionReader, reactions, symbolic_view
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr, Tree

if TYPE_CHECKING:  # a deck whose shapes are cached needs no expressions
    from adamslite.kernels.code.shape import Outputs, Shape

SCALARS = {"stored": "stored", "sensor": "relation", "equation": "equation"}
"""Faces of one number, and the method that writes it."""


@dataclass
class FaceWriter:
    """Writes loads and rows of one face with a scope; ``level``: how often they are differentiated
    by time.
    """

    binder: Binder
    keyword: str
    face: str
    fields: Tree
    own: int
    level: int

    @property
    def n_bodies(self) -> int:
        """Bodies among the nodes."""
        return len(self.binder.instance.bodies)

    def kernels(self, name: str) -> tuple[str, Meta]:
        """LLVM text of all kernels of the shape, and what an instance must provide."""
        from adamslite.kernels.code.module_text import write_kernels

        return write_kernels(self._shape(), name, self.face, self.face in WITH_JACOBIAN)

    def lanes(self, name: str, mass: str) -> str:
        """LLVM text of the residual for runs of instances, and of added mass if there is any."""
        from adamslite.kernels.code.lane_writer import write_lanes

        return write_lanes(self._shape(), name, mass)

    def tangents(self, name: str, n_ints: int) -> str:
        """LLVM text of the tangents of the shape; ``n_ints``: integers of an instance."""
        from adamslite.kernels.code.tangent_writer import write_tangents

        return write_tangents(self._shape(), name, self.face, n_ints)

    def pullback(self, name: str, n_ints: int) -> str:
        """LLVM text of what carries weights of rows back; ``n_ints``: integers of an instance."""
        from adamslite.kernels.code.pullback_writer import write_pullback

        return write_pullback(self._shape(), name, self.face, n_ints)

    def _shape(self) -> Shape:
        from adamslite.kernels.code.shape import Shape

        at, model = self.binder.instance, self.binder.model
        widths = [model.body_width(b) for b in at.bodies]
        widths += [model.node_width(n) for n in at.nodes]
        counts = (len(at.params), 0, 0, len(at.signals), len(at.tables))
        return Shape(self.binder.slots, widths, self.n_bodies, *counts, self)

    def __call__(self, scope: Scope) -> Outputs:
        from adamslite.kernels.code.shape import Outputs

        scope.read = ExpressionReader(scope, self.n_bodies)
        widths = self.binder.model.node_width
        nodes = self.binder.instance.nodes
        scope.variables = self.binder.variables
        for part in self.binder.parts:
            if part[0] == "var":
                scope.read(part)
                continue
            keyword, fields, node = self.binder.elements[part[1]]
            width = widths(nodes[node]) if node >= 0 else 0
            scope.elements.append(symbolic_view(keyword, fields, node, width, scope, self.n_bodies))
        row = self.n_bodies + self.own
        if self.face in ("output", "counted"):
            return Outputs(rows=self._results(scope))
        width = widths(nodes[self.own]) if self.own >= 0 else 0
        view = symbolic_view(self.keyword, self.fields, self.own, width, scope, self.n_bodies)
        if self.face == "loads":
            return Outputs(loads=view.cls.loads(view, scope))
        if self.face == "reactions":
            rows = view.cls.constraints(view, scope)
            return Outputs(loads=reactions(rows, view.unknowns, scope))
        if self.face in SCALARS:
            return Outputs(rows=[(row, 0, getattr(view.cls, SCALARS[self.face])(view, scope))])
        if self.face == "since start":
            view.cls.constraints(view, scope)
            return Outputs()
        if self.face == "signal":
            return Outputs(
                rows=[(row, n, e) for n, e in enumerate(_rates(scope, view.function, 2))]
            )
        rows = [_rates(scope, e, self.level)[-1] for e in view.cls.constraints(view, scope)]
        numbered = [(row, n, e) for n, e in enumerate(rows)]
        return Outputs(rows=numbered, rates_only=self.face == "acceleration")

    def _results(self, scope: Scope) -> list[tuple[int, int, Expr]]:
        """The rows of what is written; what is only counted is read and written nowhere."""
        if self.face == "counted":
            for tree in self.fields:
                scope.read(tree)
            return []
        return [
            (self.n_bodies + node, n, scope.read(tree))
            for node, trees in self.fields
            for n, tree in enumerate(trees)
        ]


def _rates(scope: Scope, expr: Expr, order: int) -> list[Expr]:
    """An expression and its total time derivatives up to ``order``."""
    found = [expr]
    for _ in range(order):
        found.append(scope.derivative(found[-1]))
    return found
