"""LLVM assembly of native functions that are compiled together.

A module is either whole, or it calls long functions of another one, which is compiled before::

    shared    run, residual, factor, ...   what all methods of integration call
    method    hht, advance, correct, ...   calls those, and has short ones of its own

Each of the two is in three parts, which call each other and are compiled with more or less effort:
what every step waits for, what is marked as seldom (events, rejected steps), and what is marked as
rare (starts, failures, statics).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import NamedTuple

from adamslite.native.translate.language import INLINE, RARE, SELDOM, Native, Untranslatable, symbol
from adamslite.native.translate.statements import Translator
from adamslite.native.translate.writer import module_text

LONG = 70
"""Lines of assembly from which on a function that other modules of Python call is a function in
native code, too. LLVM would put it into its caller if there is one only, and its passes take more
than in proportion to the length of a function."""


class Parts(NamedTuple):
    """LLVM assembly of what every step waits for, and of what is marked."""

    often: str
    seldom: str
    rare: str


def definitions(functions: Iterable[Native]) -> tuple[set[str], list[str]]:
    """Declarations of the library functions and definitions of all native functions that
    ``functions`` reach, internal to the module they become part of.
    """
    found = _reached(functions).values()
    declared = {line for work in found for line in work.declared}
    return declared, [work.define("internal ") for work in found]


def method_text(entry: Native) -> str:
    """LLVM assembly of ``entry`` and of every native function that it reaches, each under its
    :func:`symbol`; all but the entry are internal.
    """
    found = _reached([entry])
    return _text(found, found, {entry}, set())


def method_parts(entry: Native, shared: Collection[str]) -> Parts:
    """The same in parts.  The symbols in ``shared`` are in another module."""
    found = _reached([entry], shared)
    if any(entry in work.called for work in found.values()):
        raise Untranslatable(f"{symbol(entry)} calls itself")
    there = {function for function in found if symbol(function) in shared}
    return _parts(found, [entry], {entry}, there)


def shared_parts(functions: Collection[Native]) -> tuple[Parts, list[str]]:
    """LLVM assembly of all that ``functions`` reach, and the symbols that others may call: the
    functions given and those that are apart.
    """
    found = _reached(functions)
    public = {*functions, *_apart(found)}
    return _parts(found, functions, public, set()), sorted(symbol(each) for each in public)


def _parts(
    found: dict[Native, Translator],
    entries: Collection[Native],
    public: set[Native],
    there: set[Native],
) -> Parts:
    """What is found but not ``there``.  What another part calls has a name that others may call;
    what is called at every step and short is in each part that calls it.
    """
    quick, waiting = (_reached_but(marked, found, entries) for marked in (SELDOM | RARE, RARE))
    often, seldom, rare = quick - there, waiting - quick - there, found.keys() - waiting - there
    named = public | _apart(found) | there
    texts = []
    copies = [_copied(part, found, named | found.keys() - often) for part in (seldom, rare)]
    parts = [often, seldom | copies[0], rare | copies[1]]
    public = public.union(*(_called(part, found) - part for part in parts))
    for part, copied in zip(parts, [set[Native](), *copies], strict=True):
        texts.append(_text(part, found, public - copied, found.keys() - part, seldom | rare))
    return Parts(*texts)


def _called(functions: Iterable[Native], found: dict[Native, Translator]) -> set[Native]:
    return {called for function in functions for called in found[function].called}


def _copied(
    functions: set[Native], found: dict[Native, Translator], named: set[Native]
) -> set[Native]:
    """What ``functions`` need besides themselves and those that have a name elsewhere."""
    pending, copied = [*functions], set[Native]()
    while pending:
        new = {*found[pending.pop()].called} - copied - functions - named
        copied |= new
        pending.extend(new)
    return copied


def _text(
    here: Collection[Native],
    found: dict[Native, Translator],
    public: Collection[Native],
    there: set[Native],
    cold: Collection[Native] = (),
) -> str:
    """Assembly of the functions that are ``here``, with declarations of those ``there``."""
    attributes = {"noinline": _apart(found), "alwaysinline": INLINE}
    texts, needed = [], set[str]()
    for function, work in found.items():
        if function in here:
            linkage = "" if function in public else "internal "
            given = (words for words, functions in attributes.items() if function in functions)
            texts.append(work.define(linkage, " ".join(["nounwind", *given])))
            needed |= work.declared
            for each in there & {*work.called}:
                needed.add(found[each].declare() + (" cold" if each in cold else ""))
    return module_text(needed, texts)


def _reached(functions: Iterable[Native], shared: Collection[str] = ()) -> dict[Native, Translator]:
    """Every native function that ``functions`` call, translated; not what ``shared`` ones call."""
    pending, found = list(functions), dict[Native, Translator]()
    while pending:
        function = pending.pop()
        if function in found:
            continue
        found[function] = Translator(function)
        if symbol(function) not in shared:
            pending.extend(found[function].translate().called)
    return found


def _apart(found: dict[Native, Translator]) -> set[Native]:
    """Long functions that another module of Python calls."""
    return {
        called
        for function, work in found.items()
        for called in found.keys() & work.called
        if called.__module__ != function.__module__ and len(found[called].lines) > LONG
    } - INLINE


def _reached_but(
    marked: set[Native], found: dict[Native, Translator], entries: Iterable[Native]
) -> set[Native]:
    """What entries reach by way of functions that are not marked."""
    pending, reached = list(entries), set[Native]()
    while pending:
        function = pending.pop()
        if function in found.keys() - reached - marked:
            reached.add(function)
            pending.extend(found[function].called)
    return reached
