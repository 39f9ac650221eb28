"""Names for the types of the symbolic part."""

from __future__ import annotations

from typing import Any, TypeAlias

Expr: TypeAlias = Any
"""A node of :mod:`adamslite.symbolic.graph`, or a plain number in the place of one; where formulas
compute numbers, one of :mod:`adamslite.symbolic.duals`."""
Symbol: TypeAlias = Any
"""A node that is a symbol."""
Frame: TypeAlias = int
"""A marker as a scope knows it, see :mod:`adamslite.symbolic.scope`."""
Measure: TypeAlias = tuple[Any, ...]
"""What an angle is of: the name of a measure and its frames."""
Leaf: TypeAlias = tuple[Any, ...]
"""What a symbol stands for: a kind, then numbers that depend on the kind."""
Tree: TypeAlias = tuple[Any, ...]
"""A node of a bound expression, see :mod:`adamslite.kernels.binding`."""
Read: TypeAlias = Any
"""What a bound tree is read as: an ``Expr``, a frame, a statement as ``Seen``, a word, several."""
Physics: TypeAlias = Any
"""The class of a statement, for ``loads``, ``constraints``, ``equation``, ``stored``: the methods
that are called with a view of the statement.  Which of them there are depends on the statement."""
Seen: TypeAlias = Any
"""A statement as its physics sees it, :class:`adamslite.kernels.reader.View`.  Where the deck has
an id, an expression or a number, its field is a frame, another such statement, an ``Expr``; what
``derived`` returns is there too.  No class declares these types."""
