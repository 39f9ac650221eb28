"""The order of the stations along the cable: stations that repeat, and a fall written as text.

count, pitch, stagger   station k of `count` lies at `at` + k `pitch`, every second one displaced
                        by `stagger`
fall = "d1 s1 anchor"   the names of the stations in the order in which the cable passes them
"""

from collections import Counter

from adamslite.cables.messages import Faults
from adamslite.cables.vectors import add
from adamslite.cables.vocabulary import Toml

MOST_STATIONS = 20000
# Keys of a table that are no fields of a station.
ORDER_KEYS = ("name", "count", "pitch", "stagger")


def along_the_cable(faults: Faults, tables: list[Toml], fall: object) -> list[Toml]:
    """The stations in the order of the cable; `faults` finds the table of each by its number."""
    order = _order(faults, tables, fall)
    found, numbers = [], []
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
    if not fall.split():
        expected = "the names of stations in one text"
        faults.add("wrong-value", ("fall",), word="fall", expected=expected, text=repr(fall))
        return inherited
    names = [each.get("name") or "" for each in tables]
    words = fall.split()
    for i, name in enumerate(names):
        if name and names.index(name) < i:
            faults.add("same-name", ("route", i, "name"), name=name, i=names.index(name) + 1)
        if name not in words:
            faults.add("not-in-fall", ("route", i), label=f"station {name or i + 1}")
    known = ", ".join(each for each in names if each) or "missing: name = ... in [[route]]"
    for word, times in Counter(words).items():
        if word not in names:
            faults.add("no-such-station", ("fall",), word=word, known=known)
        elif times > 1:
            faults.add("twice-in-fall", ("fall",), word=word, times=times)
    return inherited if faults.found else [names.index(word) for word in words]


def _copies(faults: Faults, table: Toml, i: int) -> list[Toml]:
    """The stations of one table."""
    own = {key: value for key, value in table.items() if key not in ORDER_KEYS}
    count, pitch, stagger = (table.get(key) for key in ORDER_KEYS[1:])
    if not (isinstance(count, int) and isinstance(own.get("at"), tuple)) or count == 1:
        return [own]
    if count > MOST_STATIONS:
        faults.add("too-many-stations", ("route", i, "count"), count=count, most=MOST_STATIONS)
        return [own]
    if not isinstance(pitch, tuple) or not any(pitch):
        faults.add("no-pitch", ("route", i, "count"), count=count)
        return [own]
    places = [add(own["at"], pitch, k) for k in range(count)]
    if not isinstance(stagger, tuple) or not any(stagger):
        return [own | {"at": place} for place in places]
    turns = own.get("turn", 0), -own.get("turn", 0)
    return [
        own | {"at": add(place, stagger, k % 2), "turn": turns[k % 2]}
        for k, place in enumerate(places)
    ]
