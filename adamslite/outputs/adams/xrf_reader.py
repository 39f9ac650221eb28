"""Reading results files of ADAMS in XML, and telling them from the other forms of `.res`."""

from __future__ import annotations

import zlib
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, cast
from xml.etree.ElementTree import Element, ParseError, XMLPullParser
from xml.parsers.expat import ExpatError, ParserCreate

import numpy as np

from adamslite.errors import FormatError
from adamslite.language.diagnostics import DeckError
from adamslite.language.text import contents
from adamslite.outputs.adams.res_text import START, read_text
from adamslite.outputs.adams.xrf_layout import KINDS, MOTION_WORDS, NAMESPACE, SYMBOL_OF, unpacked
from adamslite.results.adams_terms import REQUEST_WORDS, from_adams
from adamslite.results.channels import describe
from adamslite.results.printed import Printed
from adamslite.results.results import Results
from adamslite.results.run_texts import restored
from adamslite.results.untrusted import from_json

if TYPE_CHECKING:
    from adamslite.results.channels import Channel

KEYWORDS = {kind: keyword for keyword, kind in KINDS.items()} | {
    "Plant_Input": "PINPUT", "Plant_Output": "POUTPUT",
}  # fmt: skip
BODY_COMPONENTS = {word: name for name, word in MOTION_WORDS.items()}
#: The raw state of a model: it has other numbers than the map names.
INPUT = "input"
#: Kinds of steps that give the motion.
MOTION = ("initialConditions", "dynamic", "kinematic", "static", "quasiStatic", None)
HEAD = 4096
#: Bytes given to the parser at once, which begins again with what is longer.
CHUNK = 1 << 18
#: Results are four elements deep.
DEEPEST = 20


@dataclass
class _File:
    """What has been read of a document."""

    names: list[str] = field(default_factory=list)
    ids: list[int] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    rows: list[np.ndarray] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)
    title: str = ""
    program: str = ""
    texts: dict[str, str] = field(default_factory=dict)
    decimals: int = 0


def read_file(path: str | Path) -> Results:
    """Read a results file of ADAMS; see :func:`adamslite.outputs.xrf.read`."""
    data = contents(path)
    head = data[:HEAD]
    if head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        return _read_xml(path, data)
    if head.startswith(START):
        return read_text(path, data.decode("latin-1"))
    if b"\0" in head:
        raise FormatError(
            f"{path} is a results file in the binary form of ADAMS, which is not published; "
            "with RESULTS/FORMATTED, XRF in the deck ADAMS writes XML"
        )
    raise FormatError(f"{path} is no results file of ADAMS")


def _read_xml(path: str | Path, data: bytes) -> Results:
    if _declares_type(data):
        raise FormatError(f"{path} declares a document type, which results files of ADAMS do not")
    found = _File()
    try:
        for event, element in _elements(data):
            _take(found, event, element)
        return _results(found)
    except ParseError as fault:
        raise FormatError(f"{path} is damaged or cut off: {fault}") from None
    except FormatError as fault:
        raise FormatError(f"{path}: {fault}") from None
    except (ValueError, LookupError, zlib.error) as fault:  # a code of letters that is none
        raise FormatError(f"{path} is damaged: {fault}") from None


class _Begun(Exception):
    """The first element begins."""


def _declares_type(data: bytes) -> bool:
    """Whether there is a document type, by whose entities a small file becomes a large one, or
    names another file; in any encoding, behind any comment.
    """
    found: list[str] = []

    def begin(*_: object) -> None:
        raise _Begun

    parser = ParserCreate()
    parser.StartDoctypeDeclHandler = lambda name, *_: found.append(name)
    parser.EntityDeclHandler = parser.StartElementHandler = begin
    # A code of letters that is none is a LookupError, one of several bytes a ValueError; the reader
    # reports it.
    with suppress(_Begun, ExpatError, LookupError, ValueError):
        parser.Parse(data, True)
    return bool(found)


def _elements(data: bytes) -> Iterator[tuple[str, Element]]:
    """``end`` and complete elements in their order, ``comment``, and ``start`` of those that begin.

    What is complete is taken out of what it lies in, except components.
    """
    parser: XMLPullParser[Element] = XMLPullParser(("start", "end", "comment"))
    inside: list[Element] = []
    for first in range(0, len(data) + 1, CHUNK):
        parser.feed(data[first : first + CHUNK])
        events = cast("Iterator[tuple[str, Element]]", parser.read_events())
        for event, element in events:
            if event == "start":
                inside.append(element)
            elif event == "end":
                inside.pop()
                if inside and _tag(inside[-1]) != "Entity":
                    del inside[-1][:]
            if len(inside) > DEEPEST:
                raise FormatError(f"its elements lie more than {DEEPEST} deep in each other")
            yield event, element
    parser.close()


def _tag(element: Element) -> str:
    return str(element.tag).removeprefix(f"{{{NAMESPACE}}}")


def _take(found: _File, event: str, element: Element) -> None:
    if event == "comment":
        found.texts |= unpacked(element.text or "")
        return
    tag = _tag(element)
    if event == "start":
        if tag == "StepMap":  # of several analyses the last one counts
            found.names, found.ids, found.units, found.rows, found.kinds = [], [], [], [], []
    elif tag == "Entity":
        _take_entity(found, element)
    elif tag == "Step":
        _take_step(found, element)
    elif tag == "ModelInfo":
        found.title = element.get("title", "")
    elif tag == "Analysis":
        found.program = " ".join(element.get("Solver", "").split())
    elif tag == "Results":
        if element.tag == tag:
            raise FormatError("it is not in the namespace of results files of ADAMS")


def _take_entity(found: _File, entity: Element) -> None:
    for component in entity:
        number = component.get("id", "")
        if not number.isdecimal():
            raise FormatError(f"a component of '{entity.get('name')}' has no number")
        found.names.append(_name(entity, component.get("name", "")))
        found.ids.append(int(number))
        found.units.append(component.get("unitsValue", ""))


def _name(entity: Element, component: str) -> str:
    """What this program calls a component: ``PART/2.bcs_x``, ``VARIABLE/7``."""
    kind = entity.get("entType", "")
    if not kind or component == "TIME":
        return component.lower() if component == "TIME" else f"{entity.get('name')}.{component}"
    keyword = KEYWORDS.get(kind, kind.upper())
    label = f"{keyword}/{entity.get('objectId') or entity.get('entity') or entity.get('name')}"
    if keyword in ("PART", "POINT_MASS"):
        return f"{label}.{BODY_COMPONENTS.get(component, component.lower())}"
    if keyword == "REQUEST":
        return f"{label}.{REQUEST_WORDS.get(component.lower(), component)}"
    return label if component == "Q" else f"{label}.{component.lower()}"


def _take_step(found: _File, step: Element) -> None:
    if step.get("type") == INPUT or not found.names:
        return
    words = (step.text or "").split()
    if len(words) != len(found.names):
        if step.get("type") not in MOTION:
            return  # eigenvalues and the like have maps of their own
        raise FormatError(
            f"a step of it has {len(words)} numbers where {len(found.names)} are named"
        )
    if len(found.rows) < 2:
        found.decimals = max(found.decimals, *map(_decimals, words))
    found.kinds.append(step.get("type", ""))
    found.rows.append(np.array(words, dtype=float))


def _decimals(word: str) -> int:
    """Digits after the point."""
    mantissa = word.upper().partition("E")[0]
    return len(mantissa.partition(".")[2])


def _results(found: _File) -> Results:
    if "time" not in found.names:
        raise FormatError("it names no TIME")
    repeated = [name for name, count in Counter(found.names).items() if count > 1]
    if repeated:
        raise FormatError(f"'{min(repeated)}' is there twice")
    order = np.argsort(np.argsort(found.ids, kind="stable"))  # numbers are in the order of the ids
    table = np.array(found.rows).reshape(len(found.rows), len(found.names))[:, order]
    if not found.texts:
        table = _without_repeated_times(table, found.names.index("time"), found.kinds)
    channels = {}
    for column, (name, unit) in enumerate(zip(found.names, found.units, strict=True)):
        symbol, factor = _symbol(unit)
        table[:, column] *= factor
        channels[name] = describe(name, {})._replace(unit=symbol)
    return _with_run(found, table, channels)


def _with_run(found: _File, table: np.ndarray, channels: dict[str, Channel]) -> Results:
    """Results of this program in its own terms; those of ADAMS as they are."""
    at = found.names.index("time")
    names = tuple(name for name in found.names if name != "time")
    values = np.delete(table, at, axis=1)
    run = restored(found.texts)
    plain = Results(time=table[:, at].copy(), names=names, values=values, **run)
    if plain.source is None:
        meta = {"deck": found.title, "written by": found.program}
        printed = Printed(decimals=found.decimals)
        return replace(plain, meta=meta, channels=channels, printed=printed)
    try:
        deck = plain.source.read()[0]
    except DeckError:  # a table that it names is not here
        return replace(plain, channels=channels)
    own = from_adams(plain, deck)
    listed = from_json(found.texts.get("channels", "[]"))
    kept = [name for name in listed if name in own]
    ordered = np.column_stack([own[name] for name in kept]) if kept else own.values[:, :0]
    return replace(own, names=tuple(kept), values=ordered, printed=Printed(found.decimals))


def _without_repeated_times(table: np.ndarray, at: int, kinds: list[str]) -> np.ndarray:
    """Of steps at one time that follow each other the last, which is what the next analysis has,
    and equilibria that another one follows.
    """
    time, static = table[:, at], np.array(kinds) == "static"
    last = np.append((time[1:] != time[:-1]) | (static[1:] & static[:-1]), True)[: len(time)]
    return table[last]


def _symbol(unit: str) -> tuple[str, float]:
    """``meter/sec**2`` as ``m/s^2``; degrees become radians, by the factor."""
    top, _, bottom = unit.strip().partition("/")
    base, power, exponent = bottom.replace("**", "^").partition("^")
    words = [SYMBOL_OF.get(each.lower(), each) for each in top.replace("*", "-").split("-")]
    below = f"/{SYMBOL_OF.get(base.lower(), base)}{power}{exponent}" if bottom else ""
    if words == ["deg"]:
        return f"rad{below}", radians(1.0)
    return f"{' '.join(words)}{below}", 1.0
