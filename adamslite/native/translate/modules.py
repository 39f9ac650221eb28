"""LLVM assembly of native functions that are compiled together.

A module is either whole, or it calls long functions of another one, which is compiled before::

    shared    run, residual, factor, ...   what all methods of integration call
    method    hht, advance, correct, ...   calls those, and has short ones of its own
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from adamslite.native.translate.language import INLINE, SELDOM, Native, Untranslatable, symbol
from adamslite.native.translate.statements import Translator
from adamslite.native.translate.writer import module_text

LONG = 70
"""Lines of assembly from which on a function that other modules of Python call is a function in
native code, too. LLVM would put it into its caller if there is one only, and its passes take more
than in proportion to the length of a function."""


def definitions(functions: Iterable[Native]) -> tuple[set[str], list[str]]:
    """Declarations of the library functions and definitions of all native functions that
    ``functions`` reach, internal to the module they become part of.
    """
    found = _reached(functions).values()
    declared = {line for work in found for line in work.declared}
    return declared, [work.define("internal ") for work in found]


def method_text(entry: Native, shared: Collection[str] = ()) -> str:
    """LLVM assembly of ``entry`` and of every native function that it reaches, each under its
    :func:`symbol`; all but the entry are internal. The symbols in ``shared`` are in another module.
    """
    found = _reached([entry], shared)
    if any(entry in work.called for work in found.values()):
        raise Untranslatable(f"{symbol(entry)} calls itself")
    there = {function for function in found if symbol(function) in shared}
    declared = {work.declare() for function, work in found.items() if function in there}
    here = {function: work for function, work in found.items() if function not in there}
    return _text(here, [entry], [entry], declared)


def shared_text(functions: Collection[Native]) -> tuple[str, list[str]]:
    """LLVM assembly of all that ``functions`` reach, and the symbols that others may call: the
    functions given and those that are apart.
    """
    found = _reached(functions)
    public = {*functions, *_apart(found)}
    return _text(found, functions, public), sorted(symbol(function) for function in public)


def _text(
    found: dict[Native, Translator],
    entries: Collection[Native],
    public: Collection[Native],
    declared: Iterable[str] = (),
) -> str:
    attributes = {
        "cold optsize": _seldom(found, entries),
        "noinline": _apart(found),
        "alwaysinline": INLINE,
    }
    texts = []
    for function, work in found.items():
        linkage = "" if function in public else "internal "
        given = (words for words, functions in attributes.items() if function in functions)
        texts.append(work.define(linkage, " ".join(["nounwind", *given])))
    needed = {line for work in found.values() for line in work.declared}
    return module_text({*declared, *needed}, texts)


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


def _seldom(found: dict[Native, Translator], entries: Iterable[Native]) -> set[Native]:
    """Functions of which a step does not wait: all that entries reach only through those marked."""
    pending, often = list(entries), set[Native]()
    while pending:
        function = pending.pop()
        if function in found.keys() - often - SELDOM:
            often.add(function)
            pending.extend(found[function].called)
    return found.keys() - often
