"""Results files of ADAMS (`.res`) in XML, its XRF 2.0, as RESULTS/XRF asks for.

Written are, of each moving PART, position, 3-1-3 angles, velocities and accelerations of its origin
and axes (QG, REULER; not of its centre of mass), of each force or joint the vector on I in ground
axes, of a REQUEST its components by CNAMES, and VARIABLEs. The first output time is the step of the
initial conditions, the others are those of the dynamic analysis. RESULTS decides which groups are
left out (NOVELOCITIES, ...) and DECIMALPLACES how many digits follow the point; without it numbers
have all their digits. A comment after the last element keeps the texts of the run, by which
this program reads back what it wrote; other programs pass over it.

Read are the files of ADAMS as well, of which those in XML (RESULTS/XRF) and those in the older text
form (RESULTS/FORMATTED; parts alone) are known, the binary form is not. Positions of parts are
``PART/2.bcs_x``, of the origin (BCS), until the deck tells where the centre of mass is:
`adamslite diff` takes it from the other side or from --deck.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

import adamslite
from adamslite.errors import UsageError
from adamslite.language.interfaces import key_of
from adamslite.outputs import row_by_row
from adamslite.outputs.adams.xrf_layout import (
    ALL_DIGITS,
    COMPONENTS_LEFT_OUT,
    KINDS,
    LEFT_OUT,
    MOTION_WORDS,
    NAMESPACE,
    NUMBERS_PER_LINE,
    REQUEST_NAMES,
    UNITS,
    packed,
)
from adamslite.outputs.number_text import lines
from adamslite.results.formats import register_format
from adamslite.results.run_texts import attributes, need_rows, printable

if TYPE_CHECKING:
    from adamslite.deck.commands import Commands
    from adamslite.deck.deck import Deck
    from adamslite.results.adams_options import AdamsOptions
    from adamslite.results.adams_terms import Groups
    from adamslite.results.results import Results


#: How the steps of the first time begin, and those of the others behind them.
INITIAL = b'<Data name="initialConditions_001" id="1">\n'
DYNAMIC = b'</Data>\n<Data name="dynamic_001" id="2">\n'
ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


class _Empty(UsageError):
    """There is nothing to be written."""


class Entity(NamedTuple):
    """An element with the histories of its components: (name, unit, values (nt,))."""

    name: str
    entity: str
    kind: str
    id: str
    components: list[tuple[str, str, np.ndarray]]


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all.

    Raises
    ------
    UsageError
        When the deck of the results is not known, or columns are missing that parts take.
    """
    need_rows(results)
    try:
        row_by_row.write(LAYOUT, results, path)
    except _Empty as fault:
        raise UsageError(f"{path} {fault}") from None


def read(path: str | Path) -> Results:
    """Read a results file of ADAMS, or what :func:`write` wrote.

    Raises
    ------
    FormatError
        When it is damaged, cut off, of a form that cannot be read, or no such file.
    """
    from adamslite.outputs.adams.xrf_reader import read_file

    return read_file(path)


def source_of(results: Results) -> tuple[Deck, Commands]:
    """Deck and commands that results come from."""
    if results.source is None:
        raise UsageError(
            "a file of ADAMS is written of results that know their deck: those of a run, or of a "
            ".nc, .mat or .parquet"
        )
    return results.source.read()


class _Terms:
    """Results of some columns in the terms of ADAMS."""

    def __init__(self, results: Results) -> None:
        from adamslite.model.model import assemble
        from adamslite.results.adams_options import adams_options

        self.results = results
        self.deck, commands = source_of(results)
        self.options, self.model = adams_options(self.deck, commands), assemble(self.deck)

    def of(self, time: np.ndarray, values: np.ndarray) -> tuple[list[Entity], list[str]]:
        """The entities of some rows, and the statements that are left out for want of columns."""
        from adamslite.results.adams_terms import to_adams

        here = replace(self.results, time=time, values=np.asfortranarray(values))
        groups, left_out = to_adams(here, self.model)
        return list(_entities(here, groups, self.deck, self.options)), left_out


# ---- entities --------------------------------------------------------------------------------


def _entities(
    results: Results, groups: Groups, deck: Deck, options: AdamsOptions
) -> Iterator[Entity]:
    out = {word for name in options.without for word in LEFT_OUT.get(name, ())}
    dropped = {word for name in options.without for word in COMPONENTS_LEFT_OUT.get(name, ())}
    for label, columns in groups.items():
        keyword, _, id = label.partition("/")
        if keyword in out:
            continue
        statement = deck.find(keyword, key_of(id)) if id else None
        name = getattr(statement, "name", None) or f"{keyword}_{id}"
        body = keyword in ("PART", "POINT_MASS")
        if keyword == "REQUEST":
            name = statement.results_name or statement.name or f"REQUST_{id}" if statement else name
        components = [
            (word, unit, values)
            for (word, unit), values in zip(
                _words(results, keyword, label, columns, statement), columns.values(), strict=True
            )
            if word and not (body and word in dropped)
        ]
        if components:
            shown = f"{name}_XFORM" if body else name
            yield Entity(shown, name, KINDS.get(keyword, keyword), id, components)


def _words(
    results: Results, keyword: str, label: str, names: Iterable[str], statement: Any
) -> Iterator[tuple[str, str]]:
    """What ADAMS calls the components, and their units; no name for one that is left out."""
    for name in names:
        unit = _unit(results, label, name)
        if keyword in ("PART", "POINT_MASS"):
            yield MOTION_WORDS.get(name, name.upper()), unit
        elif keyword == "REQUEST":
            yield _request_word(name, statement), unit
        else:
            yield name.upper() or "Q", unit


def _request_word(component: str, request: Any) -> str:
    """The name of F1 ... F8; CNAMES of the deck leaves out those without one."""
    number = int(component[1:]) - 1 if component[1:].isdecimal() else len(REQUEST_NAMES)
    named = request.cnames if request else ()
    if named:
        return named[number] if number < len(named) else ""
    return REQUEST_NAMES[number] if number < len(REQUEST_NAMES) else component


def _unit(results: Results, label: str, component: str) -> str:
    """The unit of a component in the words of ADAMS; empty where it is not known."""
    from adamslite.results.channels import QUANTITIES, in_units

    name = f"{label}.{component}" if component else label
    if name in results:
        return _respelled(results, results.channel(name).unit)
    dimension = QUANTITIES.get(component.removeprefix("bcs_"), ("", ""))[1]
    return _respelled(results, in_units(dimension, results.unit_symbols))


def _respelled(results: Results, unit: str) -> str:
    """``N m`` as ``newton-meter``, ``m/s^2`` as ``meter/sec**2``."""
    words = _unit_words(results)
    spelled = {symbol: words[kind] for kind, symbol in results.unit_symbols.items()}
    top, _, bottom = unit.partition("/")
    base, power, exponent = bottom.partition("^")
    above = "-".join(spelled.get(each, each) for each in top.split(" "))
    below = f"/{spelled.get(base, base)}" if bottom else ""
    return f"{above}{below}{power and '**'}{exponent}"


def _unit_words(results: Results) -> dict[str, str]:
    """The units in the words of ADAMS; empty where the deck names none."""
    names = results.meta.get("units", "").split() if results.unit_symbols else []
    kinds = ("force", "mass", "length", "time")
    return dict(zip(kinds, (UNITS.get(name, name.lower()) for name in names), strict=False))


# ---- the document ------------------------------------------------------------------------------


def _head(results: Results, long: bool) -> bytes:
    terms = _Terms(results)
    entities, left_out = terms.of(np.zeros(0), np.zeros((0, len(results.names))))
    remarks = [terms.options.comment] if terms.options.comment else []
    if left_out:
        listed = ", ".join(left_out)
        if not entities:
            raise _Empty(f"would be empty: {listed} need more columns; write all of a statement")
        remarks.append(f"left out, as the results are limited to a few columns: {listed}")
    return "".join(_opening(results, terms.deck, entities, remarks)).encode()


def _opening(
    results: Results, deck: Deck, entities: Sequence[Entity], remarks: Iterable[str]
) -> Iterator[str]:
    words = _unit_words(results)
    title = quoted(deck.title)
    remark = "".join(f"\n{escaped(each)}" for each in remarks)
    yield f"""<?xml version="1.0" encoding="UTF-8"?>
<Results xmlns="{NAMESPACE}">
<Bibliography>
<File URI="-unknown-" schema="xrf" version="2.0.0.0" publicationDate="-unknown-" />
<Revision version="1" derivedFrom="-unknown-">
<Comment>{remark}
</Comment>
</Revision>
</Bibliography>
<Analysis name="run" executionDate="-unknown-" Solver="adamslite {adamslite.__version__}" \
script="-unknown-">
<Bibliography>
<Application name="adamslite" version="{adamslite.__version__}" />
</Bibliography>
<ModelInfo title={title} creationDate="-unknown-" checksum="-unknown-" />
<Units angle="rad" length="{words.get("length", "")}" mass="{words.get("mass", "")}" \
time="{words.get("time", "")}" />
<StepMap name="map_001">
<Entity name="time">
{_component("TIME", words.get("time", ""), 1)}
</Entity>
"""
    number = 2
    for each in entities:
        yield _heading(each)
        for word, unit, _ in each.components:
            yield f"{_component(word, unit, number)}\n"
            number += 1
        yield "</Entity>\n"
    yield "</StepMap>\n"


def _tail(results: Results, long: bool) -> bytes:
    ended = "Successful" if results.outcome.is_requested else "Failed"
    texts = {**attributes(results), "channels": json.dumps(results.names)}
    data = "</Data>\n" if results.count else ""
    status = f'<TerminationStatus runTermObject="" runStatus="{ended}" />'
    return f"{data}{status}\n</Analysis>\n</Results>\n<!-- {packed(texts)} -->\n".encode()


def _heading(each: Entity) -> str:
    facts = {"name": each.name, "entity": each.entity, "entType": each.kind, "objectId": each.id}
    return f"<Entity {' '.join(f'{key}={quoted(text)}' for key, text in facts.items())}>\n"


def escaped(text: str) -> str:
    """A text as content of an element.  (The module of the library loads the network as well.)"""
    return printable(text).translate(ENTITIES)


def quoted(text: str) -> str:
    """A text as an attribute."""
    return f'"{escaped(text)}"'


def _component(word: str, unit: str, number: int) -> str:
    shown = f" unitsValue={quoted(unit)}" if unit else ""
    return f'<Component name={quoted(word)}{shown} id="{number}" />'


def _rows(results: Results) -> row_by_row.Writer:
    """The steps: those of the first time are the initial conditions."""
    terms = _Terms(results)

    def written(time: np.ndarray, values: np.ndarray, before: row_by_row.Before) -> Iterator[bytes]:
        entities, _ = terms.of(time, values)
        columns = (each for entity in entities for *_, each in entity.components)
        table = rounded(np.column_stack([time, *columns]), terms.options.decimals)
        start, moved = before or (float(time[0]), False)
        at_first = 0 if moved else _count_of(start, time)
        if before is None:
            yield INITIAL
        yield from _steps("initialConditions", table[:at_first])
        if len(time) > at_first and not moved:
            yield DYNAMIC
        yield from _steps("dynamic", table[at_first:])

    return written


def _count_of(start: float, time: np.ndarray) -> int:
    """How many of the first times are the same."""
    other = time != start
    return int(np.argmax(other)) if other.any() else len(time)


def _steps(kind: str, table: np.ndarray) -> Iterator[bytes]:
    for text in lines(table):
        steps = (_broken(line.split(",")) for line in text.splitlines())
        yield "".join(f'<Step type="{kind}">\n{each}</Step>\n' for each in steps).encode()


def _broken(cells: list[str]) -> str:
    """The time on a line of its own, then six numbers on each."""
    starts = range(1, len(cells), NUMBERS_PER_LINE)
    rows = [cells[:1], *(cells[k : k + NUMBERS_PER_LINE] for k in starts)]
    return "".join(" ".join(row) + "\n" for row in rows)


def rounded(values: np.ndarray, decimals: int) -> np.ndarray:
    """Numbers with so many digits after the point, small ones after that of their mantissa."""
    if decimals >= ALL_DIGITS:
        return values
    found = np.round(values, decimals)
    small = (np.abs(values) < 1e-4) & (values != 0.0)
    found[small] = [float(f"{each:.{decimals}e}") for each in values[small].tolist()]
    return found


LAYOUT = row_by_row.Layout(_head, _rows, _tail)
register_format(
    ".res",
    "results file of ADAMS in XML: parts by their origin and axes, forces, requests",
    write,
    read,
    exact=False,
    growing=partial(row_by_row.GrowingFile, LAYOUT),
)
