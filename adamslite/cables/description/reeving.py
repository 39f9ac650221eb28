"""The order of the stations along the cable: stations that repeat, and a fall written as text.

count, pitch, stagger   station k of `count` lies at `at` + k `pitch`, every second one displaced
                        by `stagger`
fall = "d1 s1 anchor"   the names of the stations in the order in which the cable passes them
"""

import re
from collections import Counter

from adamslite.cables.description.messages import Faults, quoted
from adamslite.cables.description.toml_places import Path
from adamslite.cables.description.vocabulary import Toml
from adamslite.cables.vectors import add

MOST_STATIONS = 20000
# Keys of a table that are no fields of a station.
ORDER_KEYS = ("count", "pitch", "stagger")


def along_several(
    faults: list[Faults], tables: list[Toml], falls: list[object]
) -> list[list[Toml]]:
    """The stations of several cables, of which every fall names its own."""
    words = [fall.split() if isinstance(fall, str) else [] for fall in falls]
    _check_names(faults[0], tables, {word for each in words for word in each})
    taken: dict[str, int] = {}
    orders = []
    for k, (own, fall) in enumerate(zip(faults, falls, strict=True)):
        path = ("cable", "fall")
        orders.append([] if fall is None else _named(own, tables, fall, path))
        for word in dict.fromkeys(words[k]):
            if taken.setdefault(word, k) < k:
                own.add("in-two-falls", path, within=(word, 0), k=taken[word] + 1, word=word)
    return [_laid_out(own, tables, order) for own, order in zip(faults, orders, strict=True)]


def along_the_cable(faults: Faults, tables: list[Toml], fall: object) -> list[Toml]:
    """The stations in the order of the cable; `faults` finds the table of each by its number."""
    return _laid_out(faults, tables, _order(faults, tables, fall))


def _laid_out(faults: Faults, tables: list[Toml], order: list[int]) -> list[Toml]:
    """The stations of the tables of these numbers."""
    found: list[Toml] = []
    numbers: list[int] = []
    for i in order:
        copies = _copies(faults, tables[i], i)
        found += copies
        numbers += [i] * len(copies)
    faults.tables = numbers
    return found


def _order(faults: Faults, tables: list[Toml], fall: object) -> list[int]:
    """Numbers of the tables in the order of the fall, that of the file without one."""
    inherited = list(range(len(tables)))
    if not isinstance(fall, str):  # which has no order, and is reported with the other keys
        return inherited
    if fall.split():
        _check_names(faults, tables, set(fall.split()))
    order = _named(faults, tables, fall, ("fall",))
    return inherited if faults.found else order


def _check_names(faults: Faults, tables: list[Toml], words: set[str]) -> None:
    """Every station has a name of its own, which a fall goes to."""
    names = [each.get("name") or "" for each in tables]
    for i, name in enumerate(names):
        if name and names.index(name) < i:
            faults.add("same-name", ("route", i, "name"), name=name, i=names.index(name) + 1)
        if name not in words:
            faults.add("not-in-fall", ("route", i), label=f"station {name or i + 1}")


def _named(faults: Faults, tables: list[Toml], fall: object, path: Path) -> list[int]:
    """Numbers of the tables that a fall goes to, without words that name none."""
    if not isinstance(fall, str) or not fall.split():
        expected = "the names of stations in one text"
        faults.add("wrong-value", path, word="fall", expected=expected, text=quoted(fall))
        return []
    names = [each.get("name") or "" for each in tables]
    known = ", ".join(each for each in names if each) or "missing: name = ... in [[route]]"
    for word, times in Counter(fall.split()).items():
        if word not in names:
            faults.add("no-such-station", path, within=(word, 0), word=word, known=known)
        elif times > 1:
            faults.add("twice-in-fall", path, within=(word, 1), word=word, times=times)
    return [names.index(word) for word in fall.split() if word in names]


def _copies(faults: Faults, table: Toml, i: int) -> list[Toml]:
    """The stations of one table."""
    own = {key: value for key, value in table.items() if key not in ORDER_KEYS}
    # In the deck it stands in values of statements.
    own["name"] = re.sub(r"[^\w.+-]", "_", own.get("name") or "")
    count, pitch, stagger = (table.get(key) for key in ORDER_KEYS)
    if not (isinstance(count, int) and isinstance(own.get("at"), tuple)) or count == 1:
        return [own]
    if count > MOST_STATIONS:
        faults.add("too-many-stations", ("route", i, "count"), count=count, most=MOST_STATIONS)
        return [own]
    if not isinstance(pitch, tuple) or not any(pitch):
        faults.add("no-pitch", ("route", i, "count"), count=count)
        return [own]
    places = [add(own["at"], pitch, k) for k in range(count)]
    named = [own | {"name": own["name"] and f"{own['name']}.{k + 1}"} for k in range(count)]
    if not isinstance(stagger, tuple) or not any(stagger):
        return [each | {"at": place} for each, place in zip(named, places, strict=True)]
    turns = own.get("turn", 0), -own.get("turn", 0)
    return [
        named[k] | {"at": add(place, stagger, k % 2), "turn": turns[k % 2]}
        for k, place in enumerate(places)
    ]
