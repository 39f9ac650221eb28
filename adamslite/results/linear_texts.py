"""What LINEAR commands found, as a text that keeps every bit."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from adamslite.results.linearization import Linearization, SecondOrder
from adamslite.results.results import Linearized
from adamslite.results.untrusted import from_json, inflated


def to_text(found: Sequence[Linearized]) -> str:
    """JSON; arrays are objects with ``shape``, ``type`` and ``data``, compressed in base64."""
    return json.dumps([{**each._asdict(), "model": vars(each.model)} for each in found],
                      default=_array)  # fmt: skip


def _array(value: Any) -> Any:
    if isinstance(value, Linearization):
        return vars(value)
    if isinstance(value, np.generic):
        return value.item()
    data = base64.b64encode(zlib.compress(np.ascontiguousarray(value).tobytes())).decode()
    return {"shape": value.shape, "type": value.dtype.str, "data": data}


def from_text(text: str) -> tuple[Linearized, ...]:
    """What :func:`to_text` was given.

    Raises
    ------
    ValueError, KeyError, TypeError
        When it is another text.
    """
    return tuple(_linearized(each) for each in from_json(text, _value))


def _value(found: dict[str, Any]) -> Any:
    if found.keys() != {"shape", "type", "data"}:
        return found
    data = inflated(base64.b64decode(found["data"]))
    return np.frombuffer(data, dtype=found["type"]).reshape(found["shape"]).copy()


def _linearized(found: dict[str, Any]) -> Linearized:
    facts = {name: _plain(value) for name, value in found["model"].items()}
    second = facts.get("second_order")
    facts["second_order"] = SecondOrder(*second) if second else None
    rest = {name: _plain(value) for name, value in found.items() if name != "model"}
    return Linearized(model=Linearization(**facts), **rest)


def _plain(value: Any) -> Any:
    """Lists of JSON are tuples here."""
    return tuple(value) if isinstance(value, list) else value
