"""A small scene that has one of everything a page draws, with motions known in closed form, and a
scene of many masses.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from adamslite.drawing.arrays import Block
from adamslite.drawing.scene import VERSION, Scene
from adamslite.page.page import page_of_scene

UPRIGHT = [0.0, 0.0, 0.0, 1.0]
TURNS = 2 * np.pi  # angle of the crank at the end [rad]
END, FRAMES = 2.0, 201
ARM = 0.5


def crank(time: float | np.ndarray) -> np.ndarray:
    """Where the crank's mass centre is: on a circle of radius ARM about the origin."""
    angle = TURNS * np.asarray(time) / END
    return np.stack([ARM * np.cos(angle), ARM * np.sin(angle), 0 * angle], axis=-1)


def weight(time: float | np.ndarray) -> np.ndarray:
    """Where the weight is: it hangs at x = 1.25, z = 0 and goes up and down once."""
    time = np.asarray(time)
    height = -1 + 0.3 * np.sin(np.pi * time)
    return np.stack([1.25 + 0 * time, height, 0 * time], axis=-1)


def turned(angle: np.ndarray) -> np.ndarray:
    """Quaternions of turns about z."""
    zero = 0 * angle
    return np.stack([zero, zero, np.sin(angle / 2), np.cos(angle / 2)], axis=-1)


def solid(kind: str, body: int, at: tuple[float, float, float] = (0, 0, 0), **sizes: Any) -> dict:
    frame = [*map(float, at), *UPRIGHT]
    return {"kind": kind, "body": body, "frame": frame, "statement": "", **sizes}


def bodies(block: Block, time: np.ndarray, late: float = 0.0) -> list[dict[str, Any]]:
    angle = TURNS * (time - late) / END
    moving = [
        ("PART/2", "crank arm", "part", crank(time - late), turned(angle), 2.0),
        ("POINT_MASS/3", "", "point_mass", weight(time - late), None, 5.0),
        (
            "PART/4",
            "Rolle <b>\N{LATIN SMALL LETTER O WITH DIAERESIS}</b>",
            "part",
            None,
            turned(3 * angle),
            1.0,
        ),
    ]
    ground = {"name": "PART/1", "label": "ground", "kind": "ground", "position": [0, 0, 0]}
    return [
        {**ground, "attitude": None, "mass": 0.0},
        *(
            {
                "name": name,
                "label": label,
                "kind": kind,
                "mass": mass,
                "position": [1.0, 0.5, 0.0] if places is None else block.i16(places),
                "attitude": None if turns is None else block.i16(turns),
            }
            for name, label, kind, places, turns, mass in moving
        ),
    ]


def channels(block: Block, time: np.ndarray, late: float = 0.0) -> dict[str, Any]:
    x = crank(time - late)[:, 0]
    list_of = [
        ("PART/2.x", "m", "crank arm", x),
        ("PART/2.y", "m", "crank arm", crank(time - late)[:, 1]),
        ("REQUEST/1.F2", "N", "pull", 40 + 10 * np.sin(np.pi * time)),
        ("REQUEST/2.F2", "", "", np.where(time < 1, time, np.nan)),
    ]
    named = [
        {"name": name, "unit": unit, "label": label, "values": block.f32(values)}
        for name, unit, label, values in list_of
    ]
    return {"times": block.f32(time), "list": named}


KINDS = (
    "REVOLUTE", "TRANSLATIONAL", "CYLINDRICAL", "SPHERICAL", "FIXED", "UNIVERSAL", "HOOKE",
    "CONVEL", "PLANAR", "SCREW", "RACKPIN",
)  # fmt: skip


def solids() -> dict[str, Any]:
    """Shapes of every kind on the bodies, and an outline."""
    return {
        "shapes": [
            solid("rod", 1, (-ARM, 0, 0), to=[2 * ARM, 0.0, 0.0]),
            solid("sphere", 1, radius=0.08),
            solid("sphere", 2, radius=0.12),
            solid("wheel", 3, radius=0.25, width=0.1),
            solid("box", 0, (-0.2, -1.6, -0.2), x=0.4, y=0.2, z=0.4),
            solid("cylinder", 0, (1, 0.5, -0.2), length=0.4, radius=0.05, angle=0.0),
            solid("frustum", 0, (-1, -1.5, 0), length=-0.3, bottom=0.2, top=0.1, angle=3.0),
            solid("ellipsoid", 0, (-1, 0, 0), x=0.2, y=0.3, z=0.4),
            solid("torus", 0, (-1, 0.6, 0), major=0.2, minor=0.05),
            solid("circle", 0, (0, 0, 0), radius=ARM),
            solid("arc", 0, (0, 0, 0), radius=0.7, angle=1.5),
            solid("plane", 0, (0, -1.6, 0), xmin=-1.0, xmax=1.0, ymin=0.0, ymax=0.5),
            solid("point", 0, (0, 1, 0)),
            solid("inertia_box", 0, (-0.6, -1, 0), x=0.2, y=0.1, z=0.3),
        ],
        "outlines": [
            {
                "statement": "GRAPHICS/1",
                "points": [[0, -1, -1, 0], [1, 0, 0, 0], [0, 1, -1, 0]],
                "closed": True,
            }
        ],
    }


def connections() -> dict[str, Any]:
    """Springs, joints of every kind, a link."""
    return {
        "springs": [
            {
                "statement": "SPRINGDAMPER/1",
                "i": [1, 0, 0, 0],
                "j": [0, 0, -1.4, 0],
                "coils": 8,
                "diameter": 0.1,
                "force": None,
            },
            {
                "statement": "GRAPHICS/2",
                "i": [2, 0, 0, 0],
                "j": [0, 1.25, -1.6, 0],
                "coils": 0,
                "diameter": 0.1,
                "force": None,
            },
        ],
        "joints": [
            {
                "statement": f"JOINT/{k}",
                "kind": kind,
                "i": [0, -1.2 + 0.2 * k, 1.0, 0, *UPRIGHT],
                "j": [0, 0, 0, 0, *UPRIGHT],
            }
            for k, kind in enumerate(KINDS)
        ],
        "links": [{"statement": "SFORCE/2", "i": [1, -ARM, 0, 0], "j": [0, -1, 0.6, 0]}],
    }


def forces(block: Block, time: np.ndarray) -> dict[str, Any]:
    """A cable with its tensions, and arrows."""
    pull = (40 + 10 * np.sin(np.pi * time))[:, None] * np.array([[1.0, 0.9]])
    force = np.stack([0 * time, -20 + 0 * time, 0 * time], axis=-1)
    return {
        "cables": [
            {
                "name": "weight to ground",
                "nodes": [
                    {"point": [2, 0, 0, 0]},
                    {"wheel": [3, 0, 0, 0, *UPRIGHT], "radius": 0.25, "sense": 1},
                    {"point": [0, 0.75, -1.5, 0]},
                ],
                "tension": block.i16(pull),
                "range": [27.0, 50.0],
            }
        ],
        "arrows": [
            {
                "statement": "SFORCE/1",
                "label": "",
                "at": [2, 0, 0, 0],
                "vector": block.i16(force),
                "kind": "force",
            },
            {
                "statement": "SFORCE/3",
                "label": "",
                "at": [3, 0, 0, 0],
                "vector": block.i16(force),
                "kind": "torque",
            },
            {
                "statement": "JOINT/1",
                "label": "",
                "at": [3, 0, 0, 0],
                "vector": [0.0, 30.0, 0.0],
                "kind": "reaction",
            },
        ],
    }


def everything(block: Block, every: int = 1) -> dict[str, Any]:
    """Plain data of the scene; the second result has one in ``every`` times."""
    time = np.linspace(0, END, FRAMES)
    fewer = time[::every]
    return {
        "version": VERSION,
        "title": "A crank, a sheave & a <weight>",
        "name": "sample",
        "deck": "sample.adm",
        "outcome": "The run reached its end.",
        "units": {"length": "m", "mass": "kg", "time": "s", "force": "N", "angle": "rad"},
        "times": block.f32(time),
        "gravity": [0.0, -9.81, 0.0],
        "up": "y",
        "bodies": bodies(block, time),
        **solids(),
        **connections(),
        **forces(block, time),
        "channels": channels(block, time),
        "events": [{"time": 1.0, "text": "SENSOR/1: the crank is half round"}],
        "notes": ["A note."],
        "modes": [
            {
                "frequency": 1.5,
                "damping": 0.02,
                "unit": "Hz",
                "time": 0.0,
                "shape": [[2, 0, 1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]],
            }
        ],
        "against": {
            "name": "other.csv",
            "times": block.f32(fewer),
            "bodies": [None, *bodies(block, fewer, late=0.1)[1:3], None],
            "channels": channels(block, fewer, late=0.1),
        },
    }


@cache
def sample(every: int = 1) -> str:
    """The page of the scene with everything; the second result has one in ``every`` times."""
    block = Block()
    plain = everything(block, every)
    return page_of_scene(Scene(plain, block.text()))


def bare(**changed: Any) -> str:
    """A page of a scene with a ground alone, and what is said otherwise."""
    block = Block()
    plain = everything(block)
    empty = {key: [] for key, value in plain.items() if isinstance(value, list)}
    kept = {"bodies": plain["bodies"][:1], "gravity": [0.0, 0.0, 0.0], "against": None}
    none = {"times": {"at": 0, "shape": [0], "coding": "f32"}, "list": []}
    content = {**plain, **empty, **kept, "times": none["times"], "channels": none, **changed}
    return page_of_scene(Scene(content, block.text()))


@cache
def swarm(count: int) -> str:
    """A page of so many masses that all move, joined by a cable."""
    block = Block()
    time = np.linspace(0, 4, 201)
    plain = everything(block)
    side = int(np.ceil(np.sqrt(count)))
    found = [plain["bodies"][0]]
    for k in range(count):
        x, z = divmod(k, side)
        y = 0.4 * np.sin(2 * np.pi * (time / 2 + x / side))
        places = np.stack([0.2 * x + 0.05 * np.cos(time), y, 0.2 * z + 0 * time], axis=-1)
        mass = {"name": f"POINT_MASS/{k + 2}", "label": "", "kind": "point_mass", "mass": 1.0}
        found.append({**mass, "position": block.i16(places), "attitude": None})
    cable = {
        "name": "all",
        "nodes": [{"point": [k + 1, 0, 0, 0]} for k in range(count)],
        "tension": None,
        "range": [0.0, 0.0],
    }
    empty = {key: [] for key, value in plain.items() if isinstance(value, list)}
    shapes = [solid("sphere", k + 1, radius=0.06) for k in range(count)]
    content = {
        **plain,
        **empty,
        "gravity": [0, -9.81, 0],
        "times": block.f32(time),
        "bodies": found,
        "shapes": shapes,
        "cables": [cable],
        "against": None,
        "title": f"{count} masses",
    }
    return page_of_scene(Scene(content, block.text()))
