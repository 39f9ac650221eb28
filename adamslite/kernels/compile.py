"""From a model to native kernels: statements grouped by shape, each shape compiled once.

A statement shows several *faces*: the loads it exerts, its constraint rows at position, velocity
and acceleration level, its algebraic or differential equation, the values it writes.  All
instances of one face with one shape form a :class:`ShapeGroup`, run by one kernel in one call.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from adamslite.caching.entries import recall, recall_json
from adamslite.deck.statement_diagnostics import diagnose_inside
from adamslite.kernels.collecting import Groups, add, bound, faces, output_face
from adamslite.kernels.groups import Bundle, Kernels, Meta, ShapeGroup, Writer, linked, members_of
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.statement import Statement
from adamslite.model.model import Model
from adamslite.native import compiler
from adamslite.progress import Progress
from adamslite.symbolic.scope import Scope, UndefinedRate

LONG_TEXT = 1_000_000
"""Characters of LLVM assembly; a force that is a sum of 1000 sines has as many."""
LONG_RESULTS = 200_000
"""The same of results, which are evaluated at output times alone; a chain of 200 to 400 VARIABLEs
has as many.
"""


def compile_model(model: Model, progress: Progress | None = None, audited: bool = False) -> Kernels:
    """Bind every statement, compile the shapes not seen before, link all of them.

    ``audited``: what elastic elements store too.
    """
    groups, outputs = bound(model, audited)
    made = groups.made(model.deck)
    fresh = sum(_compile(group, progress) for group in made)
    return Kernels(model, made, outputs, linked(made), fresh)


def _compile(group: ShapeGroup, progress: Progress | None) -> bool:
    """Fetch or make the object code; True when it was made."""
    made: list[tuple[str, Meta]] = []

    def text_and_meta() -> tuple[str, Meta]:
        if not made:
            if progress is not None and group.face == "loads":
                label = group.instances.statements[0].label
                progress.say(f"compiling the expressions of {label} (kept for later)")
            made.append(_kernels(group))
        return made[0]

    group.meta = recall_json(f"{group.name}.json", lambda: text_and_meta()[1])
    longest = LONG_RESULTS if group.face == "output" else LONG_TEXT
    group.code = recall(group.entry, lambda: _code(text_and_meta()[0], longest))
    return bool(made)


def writer_of(kernels: Kernels, group: ShapeGroup) -> Writer:
    """The writer of a group; of kernels that were kept between runs one instance is bound again."""
    if group.write is None:
        made = Groups()
        add(made, kernels.model, group.face, [(0, group.instances.writing[0])])
        (group.write,) = (each.write for each in made.values() if each.name == group.name)
    return group.writer


def lanes(kernels: Kernels, group: ShapeGroup) -> tuple[int, int]:
    """Addresses of the residual for runs of instances and of their added mass, 0 without any; made
    when they are first asked for.
    """
    symbol, mass = f"{group.name}_lanes", f"{group.name}_mass" if group.meta["mass"] else ""

    def compiled() -> bytes:
        return compiler.object_code(writer_of(kernels, group).lanes(symbol, mass))

    if symbol not in kernels.addresses:
        code = recall(f"{symbol}.o", compiled)
        names = [symbol, mass] if mass else [symbol]
        kernels.addresses.update(compiler.addresses([(code, names)]))
    return kernels.addresses[symbol], kernels.addresses[mass] if mass else 0


def tangents(kernels: Kernels, group: ShapeGroup) -> tuple[int, ...]:
    """Addresses of the tangents of the residual and of guards of the clock and of the state, 0
    where there are none; made when they are first asked for.
    """
    found, name = group.meta["guards"], f"{group.name}_tangent"
    names = [name, f"{name}_clock", f"{name}_watch"]
    there = [True, bool(found["clock"]), bool(found["watch"] or found["zone"])]

    def compiled() -> bytes:
        text = writer_of(kernels, group).tangents(group.name, group.meta["n_ints"])
        return compiler.straight_code(text)

    if name not in kernels.addresses:
        code = recall(f"{name}.o", compiled)
        known = [each for each, is_there in zip(names, there, strict=True) if is_there]
        kernels.addresses.update(compiler.addresses([(code, known)]))
    return tuple(kernels.addresses.get(each, 0) for each in names)


def _code(text: str, longest: int) -> bytes:
    """Object code: of very long bodies in an eighth of the time, by passes that do not grow faster
    than the body.
    """
    make = compiler.quick_code if len(text) > longest else compiler.straight_code
    return make(text)


def _kernels(group: ShapeGroup) -> tuple[str, Meta]:
    try:
        return group.writer.kernels(group.name)
    except UndefinedRate as fault:
        model, first = group.writer.binder.model, group.instances.writing[0]
        own = unformed(model, members_of(first)) if isinstance(first, Bundle) else ()
        raise DeckError([*own] or [_no_rate(group, fault)], model.deck) from None


def unformed(model: Model, statements: Iterable[Statement]) -> Iterator[Diagnostic]:
    """What there is to say of statements whose equations cannot be formed; nothing is compiled."""
    groups = Groups()
    for statement in statements:
        for face in (*faces(statement, model), *output_face(statement)):
            add(groups, model, face, [(0, statement)])
            if groups.loops:
                yield groups.loops.pop(0)
                break
    for found in groups.values():
        group = found.group()
        try:
            group.writer(Scope(group.writer.binder.slots))
        except UndefinedRate as fault:
            yield _no_rate(group, fault)


def _no_rate(group: ShapeGroup, fault: UndefinedRate) -> Diagnostic:
    """What the equations would need the rate of."""
    kind, at, *_ = fault.leaf
    what = {"a": "an acceleration", "al": "an angular acceleration"}.get(kind, "a second rate")
    label = ""
    if kind in ("z", "dif1"):
        binder = group.writer.binder
        label = binder.model.element(*binder.instance.nodes[at - group.writer.n_bodies]).label
        circular = label.startswith("VARIABLE")
        what = f"{label}, which depends on itself" if circular else f"a reaction of {label}"
        what = f"the rate of {label}" if kind == "dif1" else what
    return diagnose_inside(group.instances.statements[0], label, "no-rate", what=what)
