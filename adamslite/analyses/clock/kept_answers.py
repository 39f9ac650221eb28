"""Answers about expressions of time that are kept: runs that differ in other numbers ask again."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

from adamslite.symbolic.interpolant import Interpolant

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Program

Answer = TypeVar("Answer")
# Answers that are kept; instructions of a program, and numbers of an answer, up to which they are.
MOST, SHORT, SMALL = 128, 500, 1000


def kept(size: Callable[[Answer], int]) -> Callable[[Callable[..., Answer]], Callable[..., Answer]]:
    """Keep what a function finds of a program and of other arguments; ``size``: its numbers.

    Nobody changes what is kept.  Programs with tables are not: those of other kernels are other
    ones.
    """

    def keeping(function: Callable[..., Answer]) -> Callable[..., Answer]:
        known: dict[tuple[Any, ...], Answer] = {}

        @wraps(function)
        def answer(program: Program, *asked: Any) -> Answer:
            if len(program) > SHORT:
                return function(program, *asked)
            found = known.get((program, *asked))
            if found is None:
                found = function(program, *asked)
                tables = any(isinstance(each, Interpolant) for line in program for each in line)
                if size(found) <= SMALL and not tables:
                    if len(known) >= MOST:
                        known.pop(next(iter(known)), None)
                    known[program, *asked] = found
            return found

        return answer

    return keeping
