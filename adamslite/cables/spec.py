"""The description of a cable scene: what its keys are, and what they hold."""

import tomllib
from dataclasses import dataclass
from math import sqrt
from typing import Any

from adamslite.cables.messages import Faults
from adamslite.cables.places import Path, Places
from adamslite.diagnostics import DeckError, Source

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Cable:
    """A cable in SI units: stiffness EA [N], density rho [kg/m] of the unstretched cable."""

    stiffness: float
    density: float
    pretension: float = 0.0
    breaking: float = 0.0
    damping: float = 0.0

    @property
    def speed(self) -> float:
        """Axial wave speed c = sqrt(EA/rho) [m/s]."""
        return sqrt(self.stiffness / self.density)


@dataclass(frozen=True)
class Station:
    """A point of the route: an end, or a pulley the cable goes over."""

    kind: str
    at: Vector
    radius: float = 0.0
    axis: Vector = (0.0, 0.0, 1.0)
    turn: int = 0
    inertia: float = 0.0
    friction: float = 0.0
    payout: str = ""
    force: str = ""
    mass: float = 0.0
    velocity: Vector = (0.0, 0.0, 0.0)

    @property
    def is_wheel(self) -> bool:
        """Whether the cable lies on it."""
        return self.kind in WHEELS

    @property
    def is_free(self) -> bool:
        """Whether it moves through space."""
        return self.kind in ("mass", "body")


@dataclass(frozen=True)
class Spec:
    """All of it; `elements` is 0 and `level` too for "auto", `form` is "auto" then."""

    title: str
    gravity: Vector
    end: float
    steps: int
    error: float
    cable: Cable
    route: tuple[Station, ...]
    level: int
    form: str
    elements: int
    accuracy: float


WHEELS = ("pulley", "winch")
KINDS = ("fixed", "mass", "body", *WHEELS)
FORMS = ("auto", "paper", "ale")

# Key -> (what it takes, a rule for its value, the value without the key; None when it is needed).
TOP = {
    "title": ("text", "", "A cable"),
    "gravity": ("vector", "", (0.0, -9.81, 0.0)),
    "end": ("number", "not-positive", None),
    "steps": ("whole", "not-positive", 200),
    "error": ("number", "not-positive", 1e-6),
}
CABLE = {
    "EA": ("number", "not-positive", None),
    "rho": ("number", "not-positive", None),
    "pretension": ("number", "negative", 0.0),
    "breaking_load": ("number", "not-positive", 0.0),
    "damping": ("number", "not-a-share", 0.0),
}
MODEL = {
    "level": ((1, 2, 3, "auto"), "", "auto"),
    "form": (FORMS, "", "auto"),
    "elements": ("whole or auto", "not-positive", "auto"),
    "accuracy": ("number", "not-a-share", 0.01),
}
PLACE = {"kind": (KINDS, "", None), "at": ("vector", "", None)}
WHEEL = {
    "radius": ("number", "not-positive", None),
    "axis": ("vector", "", (0.0, 0.0, 1.0)),
    "turn": ((1, -1), "", 0),
    "inertia": ("number", "not-positive", None),
    "friction": ("number", "negative", 0.0),
}
MASS = {"mass": ("number", "not-positive", None), "velocity": ("vector", "", (0.0, 0.0, 0.0))}
STATIONS = {
    "fixed": PLACE,
    "mass": PLACE | MASS,
    "body": PLACE | MASS | {"inertia": ("number", "not-positive", None)},
    "pulley": PLACE | WHEEL,
    "winch": PLACE | WHEEL | {"payout": ("text", "", ""), "force": ("text", "", "")},
}
TABLES = ("cable", "model", "route")


def read(text: str, file: str = "<text>") -> tuple[Spec, Faults]:
    """The description in `text`; raises :class:`DeckError` with everything that is wrong."""
    places = Places(Source(text, file))
    faults = Faults(places)
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as fault:
        faults.add("toml", _line_of(str(fault), places), why=str(fault))
        raise DeckError(faults.found) from None
    top = _table(faults, {k: v for k, v in data.items() if k not in TABLES}, TOP, (), TABLES)
    cable = _table(faults, _part(faults, data, "cable"), CABLE, ("cable",))
    model = _table(faults, _part(faults, data, "model"), MODEL, ("model",))
    route = _stations(faults, data.get("route", []))
    if faults.found:
        raise DeckError(faults.found)
    names = dict(zip(CABLE, ("stiffness", "density", "pretension", "breaking", "damping"),
                     strict=True))  # fmt: skip
    numbers = {k: 0 if v == "auto" else v for k, v in model.items() if k != "form"}
    spec = Spec(
        **top, cable=Cable(**{names[k]: v for k, v in cable.items()}),
        route=tuple(Station(**each) for each in route), form=model["form"], **numbers,
    )  # fmt: skip
    return spec, faults


def _line_of(said: str, places: Places) -> Path:
    """The key a message of tomllib, "... (at line 3, column 1)", is about, as far as known."""
    _, _, rest = said.partition("at line ")
    number = rest.split(",")[0]
    if number.isdigit():
        for path in places.paths():
            if places.span(path).line == int(number):
                return path
    return ()


def _part(faults: Faults, data: dict[str, Any], name: str) -> dict[str, Any]:
    found = data.get(name, {})
    if isinstance(found, dict):
        return found
    faults.add("wrong-value", (name,), word=name, expected="a table", text=repr(found))
    return {}


def _stations(faults: Faults, route: Any) -> list[dict[str, Any]]:
    if not isinstance(route, list) or not all(isinstance(each, dict) for each in route):
        faults.add("wrong-value", ("route",), word="route", expected="tables [[route]]", text=route)
        return []
    if len(route) < 2:
        faults.add("short-route", ("route",), count=len(route))
    found = []
    for i, each in enumerate(route):
        kind = each.get("kind")
        rules = STATIONS.get(kind, PLACE) if isinstance(kind, str) else PLACE
        known = rules if rules is not PLACE or kind == "fixed" else {k: None for k in each}
        checked = {k: v for k, v in each.items() if k in rules or k not in known or rules is known}
        found.append(_table(faults, checked, rules, ("route", i)))
        _place_in_route(faults, each, i, len(route))
    if sum(each.get("kind") == "winch" for each in route) > 1:
        faults.add("two-winches", ("route", len(route) - 1, "kind"))
    return found


def _place_in_route(faults: Faults, each: dict[str, Any], i: int, count: int) -> None:
    kind, inside = each.get("kind"), 0 < i < count - 1
    if kind in KINDS and inside != (kind == "pulley"):
        where = "between the ends" if inside else "an end of the route"
        faults.add("wrong-end", ("route", i, "kind"), kind=kind, where=where)
    if kind == "winch" and ("payout" in each) == ("force" in each):
        faults.add("drive", ("route", i))


def _table(
    faults: Faults, data: dict[str, Any], rules: dict[str, Any], path: Path, also: Any = ()
) -> dict[str, Any]:
    """The values of a table, checked; those of keys that are not written."""
    from adamslite.messages import did_you_mean

    for key in data:
        if key not in rules:
            known = [*rules, *also]
            close = did_you_mean(key, known)
            for name in known:
                close = close.replace(name.upper(), name)
            faults.add("unknown-key", (*path, key), word=key, known=", ".join(known), hint=close)
    values = {}
    for key, (takes, rule, default) in rules.items():
        if key in data:
            values[key] = _value(faults, data[key], takes, rule, (*path, key))
        elif default is None:
            label = f"station {path[1] + 1}" if len(path) > 1 else "".join(path) or "the file"
            faults.add("missing-key", path, label=label, word=key)
        else:
            values[key] = default
    return values


def _value(faults: Faults, value: Any, takes: Any, rule: str, path: Path) -> Any:
    word = path[-1]
    if isinstance(takes, tuple):
        if value not in takes or isinstance(value, (bool, float)):
            expected = "one of " + ", ".join(map(str, takes))
            faults.add("wrong-value", path, word=word, expected=expected, text=repr(value))
        return value
    if takes == "whole or auto" and value == "auto":
        return value
    good, expected = {
        "text": (isinstance(value, str), "a text in quotes"),
        "number": (_is_number(value), "a number"),
        "vector": (_is_vector(value), "three numbers [x, y, z]"),
    }.get(takes, (_is_number(value) and isinstance(value, int), "a whole number"))
    if not good:
        faults.add("wrong-value", path, word=word, expected=expected, text=repr(value))
        return value
    broken = {
        "not-positive": lambda: value <= 0,
        "negative": lambda: value < 0,
        "not-a-share": lambda: not 0 <= value < 1,
    }
    if rule and broken[rule]():
        faults.add(rule, path, word=word, text=repr(value))
    return tuple(map(float, value)) if takes == "vector" else value


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300


def _is_vector(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(_is_number, value))
