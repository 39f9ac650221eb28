"""From the text of a description to a Spec, with all its mistakes."""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import pi
from typing import Any, TypeGuard

from adamslite.cables.description import surroundings_rules
from adamslite.cables.description.components import Cable, Load
from adamslite.cables.description.keys import (
    CABLE,
    LOAD,
    MODEL,
    OF_SEVERAL,
    PLACE,
    QUANTITIES,
    STATIONS,
    TABLES,
    TOP,
    NestedTable,
    Rules,
    Takes,
)
from adamslite.cables.description.messages import LARGEST, SMALLEST, Faults, quoted
from adamslite.cables.description.reeving import along_several, along_the_cable
from adamslite.cables.description.route import check_route
from adamslite.cables.description.toml_places import Path, Places, excess_of
from adamslite.cables.description.vocabulary import Spec, Station, Toml
from adamslite.language.diagnostics import DeckError, Source, sort_by_place

# The value of a fall that is not written: the order of the file.
NO_FALL = ""
NUMBER = f"0 or a number whose size is from {SMALLEST:g} to {LARGEST:g}"


@dataclass(frozen=True)
class Description:
    """Cables, each with its own diagnostics among all of them, and the loads on them."""

    cables: list[tuple[Spec, Faults]]
    loads: tuple[Load, ...]
    faults: Faults

    @property
    def is_several(self) -> bool:
        """Whether it is more than one cable, or there are loads of their own."""
        return bool(self.loads) or len(self.cables) > 1


def read(text: str, file: str = "<text>") -> tuple[Spec, Faults]:
    """The description in `text`, of one cable, and what is wrong with it: :func:`read_scene`."""
    return read_scene(text, file).cables[0]


def read_scene(text: str, file: str = "<text>") -> Description:
    """The description in `text`, and what is wrong with it.

    Where the route can be read, mistakes of other tables are left for later: a value that cannot
    be stands in the Spec as 1, so that the rest of the description can be checked too.

    Raises
    ------
    DeckError
        With everything that is wrong, when the route cannot be read.
    """
    places = Places(Source(text, file))
    faults = Faults(places)
    data = _parsed(text, places, faults)
    given = data.get("cable")
    if _is_several(data):
        return _several(faults, data)
    if isinstance(given, list) and len(given) == 1:
        data["cable"] = given[0]
    stations = _stations(faults, data.get("route", []))
    route = along_the_cable(faults, stations, data.get("fall"))
    check_route(faults, route, data.get("closed") is True)
    for i, each in enumerate(route):
        if each.get("kind") == "hook" or each.get("load"):
            faults.add("no-load", ("route", i), label=f"station {i + 1}")
    readable = not faults.found
    common = _common(faults, data)
    cable = _table(
        faults, _part(faults, data, "cable"), CABLE | surroundings_rules.CABLE, ("cable",)
    )
    model = _table(faults, _part(faults, data, "model"), MODEL, ("model",))
    _stop(faults, readable)
    return Description([(_spec(common, cable, model, route), faults)], (), faults)


def _parsed(text: str, places: Places, faults: Faults) -> Toml:
    if why := excess_of(text):
        faults.add("toml", (), why=why)
        raise DeckError(faults.found)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as fault:
        faults.add("toml", _line_of(str(fault), places), why=str(fault))
    except RecursionError:
        faults.add("toml", (), why="arrays or tables within one another, too many of them")
    except ValueError:  # of thousands of digits Python makes no number
        faults.add("toml", (), why="a whole number with too many digits")
    raise DeckError(faults.found)


def _is_several(data: Toml) -> bool:
    """Whether several cables are described, or one with loads of their own."""
    cables = data.get("cable")
    if isinstance(cables, list):
        tables = all(isinstance(each, dict) for each in cables)
        return tables and (len(cables) > 1 or bool(cables and data.get("load")))
    return isinstance(cables, dict) and bool(data.get("load"))


def _several(faults: Faults, data: Toml) -> Description:
    """Cables with a fall each, and loads."""
    given, rules = data["cable"], CABLE | surroundings_rules.CABLE | OF_SEVERAL
    if isinstance(given, dict):
        tables, own = [given], [faults]
        paths: list[Path] = [("cable",)]
    else:
        tables, own = given, [faults.of_cable(k) for k in range(len(given))]
        paths = [("cable", k) for k in range(len(given))]
    if len(tables) == 1:
        rules |= {"fall": ("text", "", data.get("fall") or NO_FALL)}
    cables = [_table(faults, each, rules, at) for each, at in zip(tables, paths, strict=True)]
    stations = _stations(faults, data.get("route", []))
    falls = [each.get("fall") for each in cables]
    if falls == [NO_FALL]:
        routes = [along_the_cable(own[0], stations, None)]
    else:
        routes = along_several(own, stations, falls)
    for mine, route in zip(own, routes, strict=True):
        check_route(mine, route, closed=False)
    for word in ("closed", "fall"):
        if data.get(word) and (word == "closed" or len(tables) > 1):
            faults.add("several-closed" if word == "closed" else "several-falls", (word,))
    loads = _loads(faults, data.get("load", []))
    readable = not faults.found
    common = _common(faults, data)
    model = _table(faults, _part(faults, data, "model"), MODEL, ("model",))
    _stop(faults, readable)
    found = [
        _spec(common, {k: v for k, v in cable.items() if k not in OF_SEVERAL}, model, route)
        for cable, route in zip(cables, routes, strict=True)
    ]
    return Description(list(zip(found, own, strict=True)), loads, faults)


def _loads(faults: Faults, tables: object) -> tuple[Load, ...]:
    if not isinstance(tables, list) or not all(isinstance(each, dict) for each in tables):
        faults.add("wrong-value", ("load",), word="load", expected="tables [[load]]",
                   text=quoted(tables))  # fmt: skip
        return ()
    read = [_table(faults, each, LOAD, ("load", k)) for k, each in enumerate(tables)]
    return tuple(Load(**each) for each in read if len(each) == len(LOAD))


def _common(faults: Faults, data: Toml) -> Toml:
    """The keys of no table."""
    own = {k: v for k, v in data.items() if k not in TABLES}
    top = _table(faults, own, TOP | surroundings_rules.TOP, (), TABLES)
    top.pop("fall")
    return top


def _stop(faults: Faults, readable: bool) -> None:
    if not readable or any(each.code == "missing-key" for each in faults.found):
        raise DeckError(sort_by_place(faults.found))


def _spec(top: Toml, cable: Toml, model: Toml, route: list[Toml]) -> Spec:
    names = {"EA": "stiffness", "rho": "density", "breaking_load": "breaking"}
    numbers: Toml = {k: 0 if v == "auto" else v for k, v in model.items() if k != "form"}
    for each in route:
        if each["kind"] == "winch" and not each["inertia"]:
            # Half a turn of cable: nothing depends on it, but a part needs mass.
            each["inertia"] = pi * cable["rho"] * each["radius"] ** 3
    return Spec(
        **top, cable=Cable(**{names.get(k, k): v for k, v in cable.items()}),
        route=tuple(Station(**each) for each in route), form=model["form"], **numbers,
    )  # fmt: skip


def _line_of(message: str, places: Places) -> Path:
    """The key a message of tomllib, "... (at line 3, column 1)", is about, as far as known."""
    _, _, rest = message.partition("at line ")
    number = rest.split(",")[0]
    if number.isdecimal():
        for path in places.paths():
            if places.span(path).line == int(number):
                return path
    return ()


def _part(faults: Faults, data: Toml, name: str) -> Toml:
    found = data.get(name, {})
    if isinstance(found, dict):
        return found
    faults.add("wrong-value", (name,), word=name, expected="a table", text=quoted(found))
    return {}


def _stations(faults: Faults, route: object) -> list[Toml]:
    if not isinstance(route, list) or not all(isinstance(each, dict) for each in route):
        faults.add("wrong-value", ("route",), word="route", expected="tables [[route]]",
                   text=quoted(route))  # fmt: skip
        return []
    found = []
    for i, each in enumerate(route):
        kind = each.get("kind")
        rules = STATIONS.get(kind) if isinstance(kind, str) else None
        # No tension depends on the inertia of a winch that a law turns and no force moves.
        driven = kind == "winch" and ("payout" in each or "speed" in each and "motor" not in each)
        driven = driven and not each.keys() & {"mass", "mount", "load"}
        if rules and (driven or each.get("held") is True):
            rules = rules | {"inertia": ("number", "not-positive", 0.0)}
        if rules and kind == "fixed":
            rules = rules | surroundings_rules.FIXED
        # What a station of no known kind may have is not known either.
        known = each if rules else {k: v for k, v in each.items() if k in PLACE}
        found.append(_table(faults, known, rules or PLACE, ("route", i)))
    return found


def _table(
    faults: Faults, data: Toml, rules: Rules, path: Path, also: tuple[str, ...] = ()
) -> Toml:
    """The values of a table, checked; those of keys that are not written."""
    for key in data:
        if key not in rules:
            known = [*rules, *also]
            close = faults.guesses.meant(key, " ".join(known), known.copy)
            for name in known:
                close = close.replace(name.upper(), name)
            faults.add("unknown-key", (*path, key), word=key, known=", ".join(known), hint=close)
    values: Toml = {}
    for key, (takes, rule, default) in rules.items():
        if key in data:
            found = _value(faults, data[key], takes, rule, (*path, key))
            values[key] = _instead(takes, default) if found is None else found
        elif isinstance(takes, NestedTable):
            values[key] = None
        elif default is None:
            faults.add("missing-key", path, label=_label(path), word=key)
        else:
            values[key] = default
    return values


def _label(path: Path) -> str:
    """What a table is called."""
    if len(path) == 2 and path[0] in ("route", "cable", "load"):
        return f"{'station' if path[0] == 'route' else path[0]} {int(path[1]) + 1}"
    return str(path[-1]) if path else "the file"


def _instead(takes: Takes, default: Any) -> Any:
    """What stands for a value that cannot be, so that the rest can be read: a default, or 1."""
    if default is not None or isinstance(takes, NestedTable):
        return default
    return {"text": "1", "vector": (1.0, 1.0, 1.0), "curve": ((0.0, 1.0), (1.0, 1.0))}.get(
        takes if isinstance(takes, str) else "", 1
    )


def _value(faults: Faults, value: Any, takes: Takes, rule: str, path: Path) -> Any:
    """The value as the Spec holds it; None after saying why it cannot be."""
    word = path[-1]
    if isinstance(takes, NestedTable):
        return _grouped(faults, value, takes, path)
    good, expected = _fits(value, takes)
    if not good:
        faults.add("wrong-value", path, word=word, expected=expected, text=quoted(value))
        return None
    broken = [each for each in rule.split() if not isinstance(value, str) and BROKEN[each](value)]
    if broken:
        faults.add(broken[0], path, word=word, text=quoted(value))
        return None
    if takes == "laws":
        return tuple("" if each in (0, "") else str(each) for each in value)
    if takes == "quantities":
        return tuple(value)
    if takes == "curve":
        return tuple((float(x), float(y)) for x, y in value)
    if takes == "inertia" and not isinstance(value, list):
        return (float(value),) * 3
    if takes == "number":
        return float(value)  # arrays of whole numbers beyond 64 bits are no arrays of numbers
    return tuple(map(float, value)) if takes in ("vector", "range", "inertia") else value


def _grouped(faults: Faults, value: Any, takes: NestedTable, path: Path) -> Any:
    """A table within a table; None where it is not whole."""
    if not isinstance(value, dict):
        wanted = f"a table of {', '.join(takes.rules)}"
        faults.add("wrong-value", path, word=path[-1], expected=wanted, text=quoted(value))
        return None
    found = _table(faults, value, takes.rules, path)
    return takes.make(**found) if len(found) == len(takes.rules) else None


BROKEN = {
    "not-positive": lambda value: value <= 0,
    "negative": lambda value: value < 0,
    "not-a-share": lambda value: not 0 <= value < 1,
}


def _fits(value: Any, takes: str | tuple[str | int, ...]) -> tuple[bool, str]:
    """Whether a value is what a key takes, and what that is."""
    if isinstance(takes, tuple):
        wanted = "one of " + ", ".join(map(str, takes))
        return value in takes and not isinstance(value, (bool, float)), wanted
    whole = _is_number(value) and isinstance(value, int)
    most = f" of at most {LARGEST:g}" if isinstance(value, int) and not whole else ""
    return {
        "text": (_is_line(value), "a text in quotes, on one line"),
        "word": (_is_line(value) and len(value.split()) == 1, "one word in quotes"),
        "number": (_is_number(value), "a number" if not _is_real(value) else NUMBER),
        "vector": (_is_three(value, _is_number), "three numbers [x, y, z]"),
        "laws": (_is_three(value, lambda x: _is_number(x) or _is_line(x)),
                 "three expressions of TIME [x, y, z]"),
        "inertia": (_is_positive(value) or _is_three(value, _is_positive),
                    "a positive number, or three [x, y, z]"),
        "quantities": (_are_quantities(value), f"a list of {', '.join(QUANTITIES)}"),
        "yes or no": (isinstance(value, bool), "true or false"),
        "curve": (_is_curve(value), "pairs [speed, torque] of rising speed, torques of 0 and more"),
        "range": (_is_range(value), "two numbers [low, high]"),
        "whole or auto": (whole or value == "auto", f"a whole number{most}, or auto"),
        "whole": (whole, f"a whole number{most}"),
    }[takes]  # fmt: skip


def _are_quantities(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(each in QUANTITIES for each in value)


def _is_number(value: object) -> bool:
    return _is_real(value) and (value == 0 or SMALLEST <= abs(value) <= LARGEST)


def _is_positive(value: object) -> bool:
    return _is_real(value) and _is_number(value) and value > 0


def _is_real(value: object) -> TypeGuard[float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_line(value: object) -> bool:
    """Whether it is a text that is one line of a deck."""
    return isinstance(value, str) and "\n" not in value and "\r" not in value


def _is_range(value: object) -> bool:
    if not isinstance(value, list) or len(value) != 2 or not all(map(_is_number, value)):
        return False
    return bool(value[0] < value[1])


def _is_curve(value: object) -> bool:
    """Whether it is a table of torque over speed from 0 on."""
    if not isinstance(value, list) or len(value) < 2:
        return False
    if not all(isinstance(e, list) and len(e) == 2 and all(map(_is_number, e)) for e in value):
        return False
    speeds, torques = zip(*value, strict=True)
    rises = all(a < b for a, b in pairwise(speeds))
    return bool(rises and speeds[0] == 0 and min(torques) >= 0)


def _is_three(value: object, fits: Callable[[object], bool]) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(fits, value))
