"""Results in the terms of ADAMS and back.

==========================  ==================================================================
ADAMS                       this program
==========================  ==================================================================
Part X .. PHI, VX, ACCX     ``PART/2.bcs_x`` ...: of origin and axes of the part; the results
                            of a run are of its centre of mass (:mod:`.part_frames`)
Part WX, WDX                ``PART/2.wx``, ``PART/2.alx``
Joint, Motion FX .. TZ      ``JOINT/3.fx``: reaction on I, ground axes
Single_Component_Force      ``SFORCE/5.f`` along the line between the markers, or about z of J;
FX .. TZ                    ADAMS gives the vector on I in ground axes
ADAMS_Variable Q            ``VARIABLE/7``
Request                     ``REQUEST/1.F1`` .. ``F8``
==========================  ==================================================================

Angles are 3-1-3 in radians. What the deck has to say, where the centre of mass is and which way a
force points, is taken from the deck of either side of a comparison.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.language.interfaces import key_of
from adamslite.model.attitude_angles import rotations_313
from adamslite.results.part_frames import (
    ACCELERATION,
    ALPHA,
    ANGLES,
    OF_POINT,
    OMEGA,
    PLACE,
    SPEED,
    markers_in_parts,
    of_centre,
    of_origin,
    with_one_split,
)

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.interfaces import Key
    from adamslite.model.model import Model
    from adamslite.results.part_frames import MarkerInPart
    from adamslite.results.results import Results

BCS = "bcs_"
VECTOR = ("fx", "fy", "fz", "tx", "ty", "tz")
DIRECTED = ("SFORCE", "SPRINGDAMPER")
#: Components of a Request of which ADAMS lets the deck choose no names, in lower case.
REQUEST_WORDS = {
    word: f"F{n}"
    for n, words in enumerate(
        ("mag", "x", "y", "z", "amag rmag", "r1 psi", "r2 theta", "r3 phi"), start=1
    )
    for word in (*words.split(), f"u{n}", f"f{n}")
}
Groups = dict[str, dict[str, np.ndarray]]
"""Histories (nt,) by statement and component."""


def grouped(results: Results) -> Groups:
    """Columns by statement; the single one of ``VARIABLE/7`` has no name."""
    found: Groups = {}
    for column, name in enumerate(results.names):
        label, _, component = name.rpartition(".")
        if "/" not in label:
            label, component = name, ""
        found.setdefault(label, {})[component] = results.values[:, column]
    return found


class Directions:
    """Where markers are during a run, from columns of centres of mass.

    Parameters
    ----------
    groups : Groups
    model : Model

    Its methods raise KeyError where the groups lack a component.
    """

    def __init__(self, groups: Groups, model: Model) -> None:
        self.groups, self.model = groups, model

    def of(self, force: Any) -> tuple[np.ndarray, int]:
        """The direction (nt, 3) of an SFORCE or SPRINGDAMPER on I, and where its components begin:
        0 for a force, 3 for a torque.
        """
        if force.kind == "ROTATIONAL":
            return self._marker(force.j)[1][..., :, 2], 3
        if getattr(force, "actiononly", False):
            return self._marker(force.j)[1][..., :, 2], 0
        line = self._marker(force.i)[0] - self._marker(force.j)[0]
        length = np.linalg.norm(line, axis=-1, keepdims=True)
        return np.divide(line, length, out=np.zeros_like(line), where=length > 0), 0

    def _marker(self, key: Key) -> tuple[np.ndarray, np.ndarray]:
        """Position (nt, 3) and axes (nt, 3, 3) in ground; without nt on the ground."""
        place = self.model.marker(key)
        if place.kind == "ground":
            return place.p, place.axes
        body = self.model.bodies[place.body].statement
        columns = self.groups.get(body.label, {})
        centre = np.column_stack([columns[name] for name in ("x", "y", "z")])
        if place.kind == "point":
            return centre + place.p, place.axes
        angles = np.column_stack([columns[name] for name in ANGLES])
        axes = np.eye(3) if body.cm is None else self.model.marker(body.cm).axes
        attitude = rotations_313(angles) @ axes.T
        return centre + attitude @ place.p, attitude @ place.axes


def to_adams(results: Results, model: Model) -> tuple[Groups, list[str]]:
    """Groups with parts by their origin (``bcs_x``) and single-component forces as vectors; and the
    statements that are left out, as the results lack columns by which these are computed.
    """
    groups = grouped(results)
    markers = markers_in_parts(model)
    directions = Directions(groups, model)
    found: Groups = {}
    left_out = []
    for label, columns in groups.items():
        force = _directed(model.deck, label)
        try:
            if label in markers:
                found[label] = _with_origin(label, columns, markers[label])
            elif force is not None and "f" in columns:
                found[label] = _as_vector(columns["f"], *directions.of(force))
            else:
                found[label] = columns
        except KeyError:
            left_out.append(label)
    return found, left_out


def _as_vector(force: np.ndarray, along: np.ndarray, start: int) -> dict[str, np.ndarray]:
    vector = np.zeros((len(force), 6))
    vector[:, start : start + 3] = force[:, None] * along
    return dict(zip(VECTOR, vector.T, strict=True))


def _with_origin(
    label: str, columns: Mapping[str, np.ndarray], marker: MarkerInPart
) -> dict[str, np.ndarray]:
    if marker.shifted and label.startswith("PART/") and "psi" not in columns:
        raise KeyError("psi")
    moved = of_origin(columns, marker)
    return {(BCS + name if name in OF_POINT else name): each for name, each in moved.items()}


def _directed(deck: Deck, label: str) -> Any:
    """The SFORCE or SPRINGDAMPER of that name, if it is one."""
    keyword, _, id = label.partition("/")
    if keyword not in DIRECTED:
        return None
    return deck.find(keyword, key_of(id))


def from_adams(results: Results, deck: Deck) -> Results:
    """Results with columns of ADAMS as this program names them; the others stay as they are.

    A force whose direction is not known, as its markers are on parts that the results lack, stays
    a vector.
    """
    from adamslite.model.model import assemble

    model = assemble(deck)
    groups = {_own_label(label, deck): each for label, each in grouped(results).items()}
    for label, marker in markers_in_parts(model).items():
        if label in groups:
            groups[label] = _with_centre(label, groups[label], marker)
    directions: Directions | None = None
    for label, columns in groups.items():
        force = _directed(deck, label)
        if force is not None and all(name in columns for name in VECTOR):
            directions = directions or Directions(groups, model)
            groups[label] = _along(columns, force, directions)
        elif label.startswith("REQUEST/"):
            groups[label] = _by_number(columns, deck, label)
    return _joined(results, groups)


def _own_label(label: str, deck: Deck) -> str:
    """``PART/2`` for ``PART/.crane.boom`` or ``PART/boom``, where the deck has a name for it."""
    keyword, slash, name = label.partition("/")
    if not slash or name.isdigit():
        return label
    found = deck.find(keyword, name) or deck.find(keyword, name.rpartition(".")[2])
    return found.label if found else label


def _with_centre(
    label: str, columns: Mapping[str, np.ndarray], marker: MarkerInPart
) -> dict[str, np.ndarray]:
    """Columns of the centre of mass, as far as the file has what they take."""
    plain = {name.removeprefix(BCS): each for name, each in columns.items()}
    if not any(name.startswith(BCS) for name in columns):
        return plain
    needed = _needed(marker, label.startswith("PART/"))
    kept = {
        name for name in plain if any(each not in plain for each in needed.get(name, ()))
    }  # fmt: skip
    moved = of_centre({name: plain[name] for name in plain if name not in kept}, marker)
    return {
        (BCS + name if name in kept else name): plain[name] if name in kept else moved[name]
        for name in plain
    }


def _needed(marker: MarkerInPart, turns: bool) -> dict[str, tuple[str, ...]]:
    """The components that the motion of a centre of mass takes, by its own; a point mass does not
    turn.
    """
    groups: dict[tuple[str, ...], tuple[str, ...]] = {}
    if turns and (marker.turned or marker.shifted):
        groups[ANGLES] = ANGLES
    if marker.shifted:
        groups[PLACE] = PLACE + ANGLES * turns
    if turns and marker.shifted:
        groups[SPEED] = SPEED + ANGLES + OMEGA
        groups[ACCELERATION] = ACCELERATION + ANGLES + OMEGA + ALPHA
    return {name: needed for group, needed in groups.items() for name in group}


def _along(
    columns: dict[str, np.ndarray], force: Any, directions: Directions
) -> dict[str, np.ndarray]:
    try:
        along, start = directions.of(force)
    except KeyError:
        return columns
    vector = np.column_stack([columns[name] for name in VECTOR[start : start + 3]])
    return {"f": (vector * along).sum(axis=1)}


def _by_number(columns: dict[str, np.ndarray], deck: Deck, label: str) -> dict[str, np.ndarray]:
    """Components by the names that CNAMES of the deck gives them."""
    id = label.partition("/")[2]
    request = deck.find("REQUEST", key_of(id))
    named = request.cnames if request else ()
    number = {word.lower(): f"F{n}" for n, word in enumerate(named, start=1) if word}
    return {number.get(name.lower(), name): each for name, each in columns.items()}


def _joined(results: Results, groups: Groups) -> Results:
    """The groups as columns again."""
    names = [
        (f"{label}.{component}" if component else label)
        for label, columns in groups.items()
        for component in columns
    ]
    histories = [each for columns in groups.values() for each in columns.values()]
    values = np.column_stack(histories) if histories else np.zeros((len(results.time), 0))
    return replace(results, names=tuple(names), values=values)


def with_split_angles(results: Results) -> Results:
    """Results whose angles of parts are comparable: phi = 0 where it is one angle with psi."""
    groups = grouped(results)
    for label, columns in groups.items():
        if label.startswith("PART/") and all(name in columns for name in ANGLES):
            angles = with_one_split(np.column_stack([columns[name] for name in ANGLES]))
            groups[label] = {**columns, **dict(zip(ANGLES, angles.T, strict=True))}
    return _joined(results, groups)
