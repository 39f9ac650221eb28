"""The keys of the description of a cable scene, and what each takes."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

from adamslite.cables.description.components import Brake, Floor, Motor, Mount, Pivot, Reel, Wander
from adamslite.cables.description.vocabulary import KINDS, TRIAL
from adamslite.cables.vectors import ZERO

# What the accuracy is asked for.
QUANTITIES = ("tension", "position", "arrival")
FORMS = ("auto", "paper", "ale", "brute")

Takes: TypeAlias = "str | tuple[str | int, ...] | NestedTable"
"""What a key takes: a word for a kind of value, some words or numbers, or a table."""
Rules: TypeAlias = "dict[str, tuple[Takes, str, Any]]"
"""Of each key what it takes, what must hold, and its default: any value that it takes."""


@dataclass(frozen=True)
class NestedTable:
    """A key that takes a table of keys, which `make` puts together; None without it."""

    make: Callable[..., object]
    rules: Rules


# Key -> (what it takes, rules for its value, the value without the key; None when it is needed).
TOP: Rules = {
    "title": ("text", "", "A cable"),
    "gravity": ("vector", "", (0.0, -9.81, 0.0)),
    "end": ("number", "not-positive", None),
    "steps": ("whole", "not-positive", 200),
    "error": ("number", "not-positive", 0.0),
    "closed": ("yes or no", "", False),
    "speed": ("number", "negative", 0.0),
    "fall": ("text", "", ""),
}
CABLE: Rules = {
    "name": ("word", "", ""),
    "EA": ("number", "not-positive", None),
    "rho": ("number", "not-positive", None),
    "pretension": ("number", "negative", 0.0),
    "breaking_load": ("number", "not-positive", 0.0),
    "parts": ("yes or no", "", False),
    "damping": ("number", "not-a-share", 0.0),
    "damping_time": ("number", "negative", 0.0),
    "pulls_only": ("yes or no", "", False),
}
MODEL: Rules = {
    "level": ((1, 2, 3, "auto"), "", "auto"),
    "form": (FORMS, "", "auto"),
    "elements": ("whole or auto", "not-positive", "auto"),
    "accuracy": ("number", "not-positive not-a-share", 0.01),
    "quantities": ("quantities", "", ("tension", "position")),
    "trial": ("number", "negative", TRIAL),
}


REEL = NestedTable(
    Reel,
    {"thickness": ("number", "not-positive", None), "core": ("number", "not-positive", None)},
)
MOUNT = NestedTable(
    Mount,
    {
        "foot": ("vector", "", None),
        "mass": ("number", "not-positive", None),
        "stiffness": ("number", "not-positive", 0.0),
        "damping": ("number", "negative", 0.0),
    },
)
WANDER = NestedTable(
    Wander,
    {
        "mass": ("number", "not-positive", None),
        "stiffness": ("number", "negative", None),
        "damping": ("number", "negative", 0.0),
    },
)
MOTOR = NestedTable(Motor, {"curve": ("curve", "", None), "gain": ("number", "not-positive", 0.0)})
BRAKE = NestedTable(
    Brake, {"torque": ("number", "not-positive", None), "applied": ("text", "", "")}
)
FLOOR = NestedTable(
    Floor,
    {
        "depth": ("number", "not-positive", None),
        "stiffness": ("number", "not-positive", None),
        "damping": ("number", "negative", 0.0),
    },
)
PLACE: Rules = {
    "kind": (KINDS, "", None),
    "at": ("vector", "", None),
    "name": ("word", "", ""),
}
REPEATED: Rules = {
    "count": ("whole", "not-positive", 1),
    "pitch": ("vector", "", ZERO),
    "stagger": ("vector", "", ZERO),
}
MOVED: Rules = {"motion": ("laws", "", ("", "", ""))}
CARRIED: Rules = {
    "mass": ("number", "not-positive", 0.0),
    "slide": ("vector", "", ZERO),
    "pull": ("text", "", ""),
    "block": ("word", "", ""),
    "load": ("word", "", ""),
}
ROUND: Rules = {
    "radius": ("number", "not-positive", None),
    "axis": ("vector", "", (0.0, 0.0, 1.0)),
    "turn": ((1, -1), "", 0),
}
WHEEL: Rules = (
    REPEATED
    | MOVED
    | CARRIED
    | ROUND
    | {
        "inertia": ("number", "not-positive", None),
        "friction": ("number", "negative", 0.0),
        "mu": ("number", "negative", -1.0),
        "grip": ("number", "not-positive", 0.0),
        "mu_static": ("number", "negative", 0.0),
        "teeth": ("whole", "not-positive", 0),
        "leans": ("yes or no", "", False),
        "mount": (MOUNT, "", None),
        "wander": (WANDER, "", None),
    }
)
MASS: Rules = {
    "mass": ("number", "not-positive", None),
    "velocity": ("vector", "", ZERO),
    "slides": ("yes or no", "", False),
    "haul": ("text", "", ""),
    "floor": (FLOOR, "", None),
}
STATIONS: dict[str, Rules] = {
    "fixed": PLACE | MOVED,
    "free": PLACE,
    "run": PLACE,
    "mass": PLACE | MASS,
    "body": PLACE | MASS | {"inertia": ("number", "not-positive", None)},
    "hook": PLACE | {"load": ("word", "", "")},
    "bend": PLACE | ROUND,
    "pulley": PLACE | WHEEL | {"held": ("yes or no", "", False)},
    "winch": PLACE
    | WHEEL
    | {
        "payout": ("text", "", ""),
        "force": ("text", "", ""),
        "torque": ("text", "", ""),
        "stored": ("number", "negative", -1.0),
        "reel": (REEL, "", None),
        "speed": ("text", "", ""),
        "motor": (MOTOR, "", None),
        "brake": (BRAKE, "", None),
        "limit": ("range", "", ()),
    },
}
PIVOT = NestedTable(
    Pivot,
    {"at": ("vector", "", None), "axis": ("vector", "", (0.0, 0.0, 1.0)), "on": ("word", "", "")},
)
LOAD: Rules = {
    "name": ("word", "", ""),
    "at": ("vector", "", None),
    "mass": ("number", "not-positive", None),
    "inertia": ("inertia", "", ZERO),
    "velocity": ("vector", "", ZERO),
    "pivot": (PIVOT, "", None),
}
# Of one of several cables: the names of the stations it goes to.
OF_SEVERAL: Rules = {"fall": ("text", "", None)}
TABLES = ("cable", "model", "route", "load")
