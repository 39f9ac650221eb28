"""Channels for plots: every column of the results, with its unit and the name of its statement."""

from __future__ import annotations

from typing import Any

from adamslite.deck.deck import Deck
from adamslite.drawing.arrays import Block
from adamslite.drawing.decimation import points
from adamslite.elements.units import Units
from adamslite.results.channels import describe
from adamslite.results.channels import unit_symbols as symbols_of
from adamslite.results.results import Results

EXACT = 150_000
"""Numbers of all channels up to which each has seven digits."""
LEVELS = 8191
"""Steps of the range of a channel, where there are more: no screen shows them."""
LISTED = 300
"""Channels that are listed in plain text; more are compressed."""


def unit_symbols(deck: Deck) -> dict[str, str]:
    """Symbols of length, mass, time, force and angle; empty where the deck does not name them."""
    found = symbols_of(" ".join(deck.single(Units).names or ()))
    named = {word: found.get(word, "") for word in ("length", "mass", "time", "force")}
    return {**named, "angle": "rad"}


def channels(deck: Deck, results: Results, block: Block, runs: int = 1) -> dict[str, Any]:
    """All columns over times of their own; `runs`: how many are in the page."""
    symbols = unit_symbols(deck)
    time, values = points(results.time, results.values, runs)
    exact = values.size * runs <= EXACT
    references = [block.f32(own) for own in values.T] if exact else block.columns(values, LEVELS)
    named = []
    for name, reference in zip(results.names, references, strict=True):
        channel = describe(name, symbols, deck)
        named.append({
            "name": name, "unit": channel.unit, "label": channel.title, "values": reference,
        })  # fmt: skip
    listed = block.json(named) if len(named) > LISTED else named
    return {"times": block.f32(time), "list": listed}
