"""How large the loads of a model are, as far as its deck shows before a run.

The sum of the sizes of all weights, of all forces in the posture as drawn, at some times of the
run, and of what the speeds at the start and the MOTIONs ask for:

    sum m (g + v^2/L)  +  sum |F| + |T|/L  +  M max(|a|, L (|al| + w^2))        L: size of the model

What moves may pull some times as hard.  Nothing is known of blows, and of forces that something
else decides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.assembly.reader import NumberReader
from adamslite.assembly.scope import Posture, Unmeasured
from adamslite.language.expression import Call, Ref, Time, walk
from adamslite.language.statement import expressions
from adamslite.symbolic.duals import Dual
from adamslite.symbolic.formulas import with_numbers

if TYPE_CHECKING:
    from collections.abc import Collection

    from adamslite.elements.motion import Motion
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model

# So many times at which forces that change, and motions, are looked at; of the forces together.
TIMES, MOMENTS, MOST = 401, 401, 4000
# Times are this share of the run apart, around its end: no period has all of them at its zeros.
GOLDEN = 0.6180339887498949
#: They push when something is reached, by how much nobody knows.
BLOWS = frozenset({"BISTOP", "IMPACT"})
#: They are a share of what joints carry.
SHARES = frozenset({"FRICTION"})


def load_scale(
    model: Model, posture: Posture, size: float, until: float, without: Collection[Statement]
) -> float | None:
    """The sum of the sizes of the loads, those of some elements left out; None where it is not
    known.
    """
    if any(map(_strikes, model.deck.statements)):
        return None
    reader = NumberReader(model, posture, False)
    total = _of_bodies(model, size)
    acting = [
        each
        for each in model.deck.statements
        if hasattr(each, "loads") and model.acts(each) and each not in without
        and each.keyword not in SHARES
    ]  # fmt: skip
    changing = [each for each in acting if _changes(model, each)]
    count = min(TIMES, MOST // max(len(changing), 1) + 1)
    times = until * ((GOLDEN * np.arange(count)) % 1.0)
    try:
        forces = _of_elements([e for e in acting if e not in changing], reader, 0.0, size)
        forces += max(_of_elements(changing, reader, float(t), size) for t in times)
        driven = [
            _of_motion(each, reader, until, size) * float(sum(b.mass for b in model.bodies))
            for each in model.deck.of("MOTION")
            if model.acts(each)
        ]
    except (Unmeasured, ArithmeticError, LookupError):
        return None
    found = total + forces + sum(driven)
    return found if np.isfinite(found) else None


def _changes(model: Model, statement: Statement) -> bool:
    """Whether a force may depend on TIME, itself or through VARIABLEs."""
    pending, seen = list(expressions(statement)), set[Ref]()
    while pending:
        for each in walk(pending.pop()):
            if isinstance(each, Time):
                return True
            if isinstance(each, Ref) and each.kind == "VARIABLE" and each not in seen:
                seen.add(each)
                pending += expressions(model.element(each.kind, each.id))
    return False


def _strikes(statement: Statement) -> bool:
    if statement.keyword == "CONTACT":
        return True
    nodes = (each for node in expressions(statement) for each in walk(node))
    return any(isinstance(each, Call) and each.name in BLOWS for each in nodes)


def _of_bodies(model: Model, size: float) -> float:
    g = float(np.linalg.norm(model.deck.gravity))
    total = 0.0
    for body in model.bodies:
        turning = float(body.w @ body.inertia @ body.w)
        total += body.mass * (g + float(body.v @ body.v) / size) + turning / size
    return total


def _of_elements(acting: list[Statement], reader: NumberReader, t: float, size: float) -> float:
    reader.now, total = t, 0.0
    for each in acting:
        with with_numbers():
            loads = type(each).loads(reader.seen(each), reader)  # type: ignore[attr-defined]
        for load in loads:
            total += _length(load.force) + _length(load.torque) / size
    return total


def _length(vector: tuple[Any, ...]) -> float:
    return float(np.linalg.norm([_number(each) for each in vector]))


def _number(value: Any) -> float:
    return float(value.value if isinstance(value, Dual) else value)


def _of_motion(motion: Motion, reader: NumberReader, until: float, size: float) -> float:
    """The largest acceleration that a MOTION asks of what it drives."""
    times = np.linspace(0.0, until, MOMENTS)
    values = []
    for t in times:
        reader.now = float(t)
        with with_numbers():
            found = reader.value(motion.function)
        values.append(_number(found))
    step = until / (MOMENTS - 1)
    order = {"DISPLACEMENT": 0, "VELOCITY": 1, "ACCELERATION": 2}[motion.level]
    rates = [np.array(values)]
    for _ in range(2 - order):
        rates.append(np.gradient(rates[-1], step))
    a = float(np.abs(rates[2 - order]).max())
    if order == 2:
        v = float(np.abs(np.cumsum(rates[0])).max()) * step
    else:
        v = float(np.abs(rates[1 - order]).max())
    joint = None if motion.joint is None else reader.model.element("JOINT", motion.joint)
    along = motion.driven(joint) in ("TRANSLATION", "X", "Y", "Z")
    return a if along else size * (a + v * v)
