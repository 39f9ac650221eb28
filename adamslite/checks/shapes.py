"""Rules about shapes: what each kind of GRAPHICS needs, and where it cannot have it."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.checks.rule import positive
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.graphics import Graphics
from adamslite.language.diagnostics import Diagnostic

# Lengths that have no direction.
SIZES = (
    "radius", "xscale", "yscale", "zscale", "major_radius", "minor_radius", "seg", "sides",
)  # fmt: skip


def shapes(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Graphics):
        shape = each.shape
        if shape is None:
            yield diagnose(each, "no-shape", listed=", ".join(sorted(Graphics.needs)))
            continue
        if each.missing:
            listed = ", ".join(each.missing)
            yield diagnose(each, "shape-incomplete", "kind", kind=shape, listed=listed)
        for field in _idle(each, shape):
            word, reason = Graphics.arguments[field].key, f"the shape is {shape}"
            yield diagnose(each, "no-effect", field, word=word, reason=reason)
        yield from positive(each, *SIZES)
        yield from _radii(each)


def _idle(graphics: Graphics, shape: str) -> Iterator[str]:
    """Fields that are given and do not belong to the shape."""
    taken = {"kind", *Graphics.needs[shape], *Graphics.takes.get(shape, ())}
    return (field for field in Graphics.arguments if graphics.given(field) and field not in taken)


def _radii(graphics: Graphics) -> Iterator[Diagnostic]:
    """The radii of a FRUSTUM: one of them may be zero."""
    for field in ("bottom", "top"):
        if (getattr(graphics, field) or 0.0) < 0.0:
            yield diagnose(graphics, "not-positive", field, word=field.upper())
