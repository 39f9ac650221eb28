"""Rules about the statements that run a deck, in decks and in command files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any

from adamslite.checks.rule import Rule, positive
from adamslite.deck.deck import ANALYSES, Deck
from adamslite.deck.redefinition import Command, Redefinition
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.activate import Activate
from adamslite.elements.deactivate import Deactivate
from adamslite.elements.equilibrium import Equilibrium
from adamslite.elements.file import File
from adamslite.elements.integrator import Integrator
from adamslite.elements.kinematics import Kinematics
from adamslite.elements.linear import Linear
from adamslite.elements.pinput import Pinput
from adamslite.elements.reload import Reload
from adamslite.elements.save import Save
from adamslite.elements.sensor import Sensor
from adamslite.elements.simulate import MOST_STEPS, Simulate, output_steps
from adamslite.elements.variable import Variable
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Node, Ref, calls, walk
from adamslite.language.file_name import is_file_name
from adamslite.language.interfaces import Key
from adamslite.language.likeness import Guesses
from adamslite.language.method import USUAL, method_of, methods, without_effect
from adamslite.language.statement import Statement, expressions

# What -0.333333333 is below -1/3.
ROUNDED = 1e-9
IDLE_IN_SENSOR = {
    "bisection": "the time is located anyway",
    "codgen": "every start analyses the matrix again",
    "restart": "the integrator restarts anyway",
}
IDLE_AT_ITS_END = {
    "stepsize": "the next SIMULATE starts as every SIMULATE does",
    "dt": "the next SIMULATE has output steps of its own",
}
TIMES = ("end", "duration", "dtout", "steps")


def integrator_values(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Integrator):
        yield from positive(each, "error", "hmax", "hmin", "hinit", "kmax", "maxit")
        if each.alpha is not None and not -1 / 3 - ROUNDED <= each.alpha <= 0:
            yield diagnose(each, "out-of-range", "alpha", word="ALPHA", low="-1/3", high="0")
        if each.hmin is not None and each.hmax is not None and each.hmin > each.hmax:
            yield diagnose(each, "steps-disordered", "hmin")
        if any(factor <= 0 for factor in each.scale):
            yield diagnose(each, "not-positive", "scale", word="SCALE")
        elif each.scale and each.method and method_of(each.method).uses("SCALE"):
            yield diagnose(each, "scale-order", "scale")
        if each.formulation == "SI1":
            yield diagnose(each, "solved-as", "formulation", word="SI1", other="SI2")


def idle_integrator_arguments(deck: Deck) -> Iterator[Diagnostic]:
    method = USUAL
    for each in deck.of(Integrator):
        method = each.method or method
        given = {
            argument.key: field for field, argument in each.arguments.items() if each.given(field)
        }
        for word, reason in without_effect(method, given):
            yield _idle(each, given[word], word, reason)
        own = methods().get(method)
        if own and own.uses("KMAX") and each.kmax is not None and each.kmax > own.order:
            yield diagnose(each, "order-limited", "kmax", word=each.kmax, highest=own.order)


def iteration_values(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Equilibrium):
        yield from positive(each, "alimit", "error", "imbalance", "maxit", "tlimit")
        if each.stability < 0:
            yield diagnose(each, "negative", "stability", word="STABILITY")
    for solver in deck.of(Kinematics):
        yield from positive(solver, "alimit", "error", "aerror", "maxit", "tlimit")


def simulation_times(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Simulate):
        yield from positive(each, "duration", "dtout", "steps")
        if each.kind == "INITIAL_CONDITIONS":
            for field in filter(each.given, TIMES):
                yield _idle(each, field, field.upper(), "initial conditions take no time")
        elif not each.at_once or each.given("steps") or each.given("dtout"):
            yield from _span_of_time(each)


def _idle(statement: Statement, field: str, word: str, reason: str) -> Diagnostic:
    return diagnose(statement, "no-effect", field, word=word, reason=reason)


def _span_of_time(run: Simulate) -> Iterator[Diagnostic]:
    if run.end is None and run.duration is None:
        yield diagnose(run, "no-end")
    elif run.end is not None and run.duration is not None:
        yield diagnose(run, "two-ends", "duration")
    elif run.steps is None and run.dtout is None:
        yield diagnose(run, "no-output-step")
    elif run.steps is not None and run.dtout is not None:
        yield diagnose(run, "two-output-steps", "dtout")
    else:
        yield from _not_too_many(run)


def _not_too_many(run: Simulate) -> Iterator[Diagnostic]:
    """Of a run that begins at 0; one that begins later is checked when it begins."""
    if run.steps is None and (run.dtout or 0) <= 0:
        return
    count = output_steps(run.until(0.0), run.steps, run.dtout)
    if count > MOST_STEPS:
        field = "dtout" if run.steps is None else "steps"
        yield diagnose(run, "too-many-steps", field, count=float(count), most=float(MOST_STEPS))


def without_run(deck: Deck, commands: Iterable[Command]) -> Iterator[Diagnostic]:
    """Whether neither deck nor commands say how long to run."""
    everything = (*deck.own, *commands)
    if everything and not any(each.keyword in ANALYSES for each in everything):
        yield diagnose(deck.own[-1] if deck.own else everything[-1], "no-run")


def late_start_values(command: Redefinition[Any]) -> Iterator[Diagnostic]:
    """Start values for a model that has already moved: it continues from its present state."""
    for field in command.changes:
        argument = command.of.arguments[field]
        if argument.start:
            reason, word = (
                "the model continues from the state that it has reached",
                argument.keys[0],
            )
            yield diagnose(command, "no-effect", field, word=word, reason=reason)


LISTS = ("ARRAY", "PINPUT", "POUTPUT")


def fixed_lists(command: Redefinition[Any]) -> Iterator[Diagnostic]:
    """What expressions have taken from a list of VARIABLEs when the deck was read."""
    for field in ("function", "ns", "no", "nd") if command.keyword == "GSE" else ():
        if field in command.changes:
            hint = "what is bound to its routine is read with the deck"
            yield diagnose(command, "array-fixed", field, hint, word=field.upper())
    for field in ("kind", "variables") if command.keyword in LISTS else ():
        if field in command.changes:
            word = "VARIABLES" if field == "variables" else "the kind"
            yield diagnose(command, "array-fixed", field, word=word)


def ends_in_order(deck: Deck) -> Iterator[Diagnostic]:
    if "SENSOR" in deck.names.ids:  # it may have ended the run before
        return
    time, kept = 0.0, dict[tuple[str, str | None], float]()
    for each in deck.statements:
        if isinstance(each, Save):
            kept[each.where] = time
        elif isinstance(each, Reload):
            time = kept.get(each.where, 0.0)
        if not isinstance(each, Simulate):
            continue
        if each.at_once or (each.end is None and each.duration is None):
            continue
        end = each.until(time)
        if each.duration is None and end <= time:
            yield diagnose(each, "end-not-later", "end", end=f"{end:g}", time=f"{time:g}")
        time = max(time, end)


def sensors(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Sensor):
        if each.error < 0:
            yield diagnose(each, "negative", "error", word="ERROR")
        for field in ("stepsize", "dt"):
            value = getattr(each, field)
            if value is not None and value <= 0:
                yield diagnose(each, "not-positive", field, word=field.upper())
        idle = IDLE_IN_SENSOR | (IDLE_AT_ITS_END if each.ends_analysis else {})
        for field in filter(each.given, idle):
            yield _idle(each, field, field.upper(), idle[field])
        if not (
            each.ends_analysis or any(map(each.given, ("prints", "evaluate", "stepsize", "dt")))
        ):
            yield diagnose(each, "sensor-idle")


def switched_elements(deck: Deck) -> Iterator[Diagnostic]:
    guesses = Guesses()
    for each in deck.statements:
        if not isinstance(each, Activate | Deactivate):
            continue
        if not each.ids and each.range is None:
            yield diagnose(each, "missing-argument", word="ID", hint="ID=1,2 or RANGE=first,last")
        for key in each.ids:
            yield from _missing(deck, each, key, guesses)
        if each.range and not each.elements(deck.names):
            low, high = map(int, each.range)
            yield diagnose(each, "empty-range", "range", kind=each.kind, low=low, high=high)


def _missing(
    deck: Deck, switch: Activate | Deactivate, key: Key, guesses: Guesses
) -> Iterator[Diagnostic]:
    found = deck.names.find(switch.kind, key)
    if isinstance(found, list):
        labels = ", ".join(f"{switch.kind}/{each}" for each in found[:5])
        yield diagnose(switch, "ambiguous-name", "ids", word=key, labels=labels)
    elif found is None:
        known = partial(deck.names.known, switch.kind)
        hint = guesses.meant(str(key), switch.kind, known)
        yield diagnose(switch, "missing-reference", "ids", kind=switch.kind, key=key, hint=hint)


NO_PORTS = "EIGENSOL has neither input nor output"
ONE_FORM = "MKB has one form, without outputs"
IDLE_IN_LINEAR = {
    "EIGENSOL": dict.fromkeys(("file", "format", "pinput", "poutput"), NO_PORTS)
    | {"pstate": "eigenvalues do not depend on the states"},
    "STATEMAT": dict.fromkeys(("coords", "kinetic"), "STATEMAT finds no modes"),
    "MKB": dict.fromkeys(("coords", "kinetic"), "MKB finds no modes")
    | dict.fromkeys(("format", "poutput"), ONE_FORM),
}


def linear_arguments(deck: Deck) -> Iterator[Diagnostic]:
    for each in deck.of(Linear):
        idle = IDLE_IN_LINEAR.get(each.kind, {})
        for field in filter(each.given, idle):
            yield _idle(each, field, field.upper(), idle[field])
        for field, modes in (("coords", each.shapes), ("kinetic", each.energies)):
            if field not in idle and modes and not 1 <= modes[0] <= modes[1]:
                yield diagnose(each, "no-such-modes", field, word=field.upper())
        if each.kind == "STATEMAT" and each.format == "MATRIXX":
            yield _idle(each, "format", "MATRIXX", "its layout is not published")
        if each.pstate is not None and "pstate" not in idle:
            yield diagnose(each, "states-chosen", "pstate", word=each.kind)


def file_names(deck: Deck) -> Iterator[Diagnostic]:
    """Files that commands name lie beside the results; one is written by one kind of command, and
    by LINEAR once.
    """
    known: dict[str, Statement] = {}
    for each in deck.statements:
        if not isinstance(each, Linear | Save | Reload) or each.file is None:
            continue
        if each.kind in ("EIGENSOL", "STATES"):
            continue
        name = each.file.casefold()
        other = known.setdefault(name, each)
        if not is_file_name(each.file):
            yield diagnose(each, "not-a-file-name", "file", word=each.file or '""')
        elif other is not each and (isinstance(each, Linear) or isinstance(other, Linear)):
            what = f"that of an earlier {other.keyword}"
            yield diagnose(each, "file-taken", "file", word=each.file, what=what)


def names_of_files(deck: Deck, commands: Iterable[Statement]) -> Iterator[Diagnostic]:
    for each in commands:
        if not isinstance(each, File):
            continue
        if each.model and not deck.is_called(each.model):
            yield diagnose(each, "other-model", "model", word=each.model)
        if each.output_prefix and not is_file_name(each.output_prefix):
            yield diagnose(each, "prefix-unused", "output_prefix", word=each.output_prefix)


def inputs_with_rates(deck: Deck, commands: Iterable[Statement]) -> Iterator[Diagnostic]:
    """Inputs of a linear model whose rates count as well: it would have no columns for these."""
    for command in commands:
        port = None
        if isinstance(command, Linear) and command.pinput is not None:
            port = deck.find(Pinput, command.pinput)
        for key in port.variables if port else ():
            user = _taker_of_rate(deck, key)
            if user is not None:
                word = f"VARIABLE/{key}"
                yield diagnose(command, "input-rate", "pinput", word=word, user=user.label)


def _taker_of_rate(deck: Deck, key: Key) -> Statement | None:
    """A MOTION, GCON or d( )/dt of an equation that depends on a VARIABLE."""
    for each in deck.statements:
        found = expressions(each)
        if each.keyword == "REQUEST":
            continue
        if each.keyword not in ("MOTION", "GCON"):
            found = [call for node in found for call in calls(node, "DDT")]
        if any(key in _variables(deck, node) for node in found):
            return each
    return None


def _variables(deck: Deck, node: Node) -> set[Key]:
    """VARIABLEs that an expression depends on, itself or through others."""
    found: set[Key] = set()
    pending = [node]
    while pending:
        for each in walk(pending.pop()):
            if isinstance(each, Ref) and each.kind == "VARIABLE" and each.id not in found:
                found.add(each.id)
                variable = deck.find(Variable, each.id)
                pending += [variable.function] if variable else []
    return found


def places_of_states(deck: Deck) -> Iterator[Diagnostic]:
    """STATES have a BUFFER, a SYSTEM has a FILE."""
    for each in deck.statements:
        if not isinstance(each, Save | Reload):
            continue
        needed, other = ("buffer", "file") if each.kind == "STATES" else ("file", "buffer")
        if not getattr(each, needed) and not _only_automatic(each):
            hint = f"{each.keyword}/STATES, BUFFER=name or {each.keyword}/SYSTEM, FILE=name"
            yield diagnose(each, "missing-argument", word=needed.upper(), hint=hint)
        if each.given(other):
            reason = f"{each.kind} goes to a {needed.upper()}"
            yield diagnose(each, "no-effect", other, word=other.upper(), reason=reason)


def _only_automatic(command: Save | Reload) -> bool:
    """Whether it is about AUTOSAVE alone, and keeps nothing at this time."""
    return isinstance(command, Save) and command.given("autosave")


def buffers_that_are_filled(deck: Deck) -> Iterator[Diagnostic]:
    filled: set[str] = set()
    for each in deck.statements:
        if isinstance(each, Save) and each.kind == "STATES" and each.buffer:
            filled.add(each.buffer)
        elif isinstance(each, Reload) and each.kind == "STATES" and each.buffer:
            if each.buffer not in filled:
                known = f"there is {', '.join(sorted(filled))}" if filled else ""
                yield diagnose(each, "nothing-saved", "buffer", known, word=each.buffer)


RUN_RULES: list[Rule] = [
    integrator_values,
    idle_integrator_arguments,
    iteration_values,
    simulation_times,
    ends_in_order,
    sensors,
    switched_elements,
    linear_arguments,
    file_names,
    places_of_states,
    buffers_that_are_filled,
]
