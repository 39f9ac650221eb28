"""A reference file: a table of results and the tolerances that a run has to meet.

    # tolerance: abs 1e-7
    # tolerance PART/2.vx: rel 1e-5 abs 1e-8
    # solve: --error 1e-8 --hmax 0.01
    # expect: SINGULAR_ACCELERATION at 1.0 within 1e-3
    # interpolate: cubic
    # measure: mean SFORCE/5.f from 0.1 to 0.2 = 214302 tol rel 1e-3

decks/README.md describes each line. A comment that looks like none of them is free text.
"""

import re
import shlex
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from difflib import get_close_matches
from math import isfinite
from pathlib import Path
from typing import Any

from adamslite.errors import FormatError, UsageError
from adamslite.outputs import csv
from adamslite.results.comparison import (
    INTERPOLATIONS,
    Comparison,
    Mismatch,
    Tolerance,
    compare,
    fits,
)
from adamslite.results.formats import format_of
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.run_texts import NUMBERS
from adamslite.run_flags import parse_flags
from adamslite.verification.measures import ARRIVAL, KINDS, VALUE, Measure

# The options of a measure, each followed by a number.
_WORDS = ("at", "from", "to", "through", "smoothed")

#: So many significant digits no double goes beyond.
MOST_DIGITS = 17


@dataclass(kw_only=True)
class Reference:
    """What a run must give, and how close.

    Parameters
    ----------
    path : Path
        The file.
    table : Results
        Its channels; may be empty.
    tolerances : list of (pattern, Tolerance)
        The last pattern that fits a channel counts.
    options : dict
        Flags of `adamslite solve` for this reference.
    outcome : Outcome
        How the run must end.
    stop : (float, float) or None
        When it must end, and how far off that time may be [time].
    interpolate : str or None
        How to get values between output times; None means reference times are output times.
    measures : list of Measure
        Numbers made from single channels.
    """

    path: Path
    table: Results
    tolerances: list[tuple[str, Tolerance]] = field(default_factory=list)
    options: dict[str, Any] = field(default_factory=dict)
    outcome: Outcome = Outcome.DONE
    stop: tuple[float, float] | None = None
    interpolate: str | None = None
    measures: list[Measure] = field(default_factory=list)

    def tolerance_of(self, name: str) -> Tolerance | None:
        """Return what the last line that fits channel `name` allows, or None."""
        allowed = [tolerance for pattern, tolerance in self.tolerances if fits(pattern, name)]
        return allowed[-1] if allowed else None

    def without_tolerance(self) -> list[str]:
        """Return the channels of the table that no tolerance line fits."""
        return [name for name in self.table.names if self.tolerance_of(name) is None]

    def judge(self, results: Results, usual: Tolerance | None = None) -> Comparison:
        """Compare `results` with the table and the measures.

        Parameters
        ----------
        results : Results
            What a run gave.
        usual : Tolerance, optional
            For channels that no tolerance line fits.
        """

        def allowed(name: str) -> Tolerance:
            found = self.tolerance_of(name) or usual
            if found is None:
                raise Mismatch(f"no tolerance is given for '{name}'")
            return found

        channels = compare(results, self.table, allowed, self.interpolate)
        measured = [measure.difference(results, self.interpolate) for measure in self.measures]
        return Comparison((*channels.differences, *measured))


def read_reference(path: str | Path) -> Reference:
    """Read a reference, or any result file; only tables (.csv) contain instructions.

    Raises
    ------
    FormatError
        When the table or an instruction cannot be understood; says file, line and why.
    """
    if format_of(path, to_read=True).suffix != ".csv":
        return Reference(path=Path(path), table=Results.load(path))
    table = csv.read_table(path)
    reference = Reference(path=Path(path), table=table.results)
    for line, comment in table.comments:
        try:
            _follow(reference, comment)
        except ValueError as fault:
            raise FormatError(f"{path}:{line}: {fault}") from None
    return reference


def parse_tolerance(text: str) -> Tolerance:
    """Read `abs 1e-6 rel 1e-5 peak 1e-4 digits 6`: any one or more of the four."""
    words = text.split()
    names, values = words[::2], words[1::2]
    if not words or len(words) % 2 or not set(names) <= set(_TOLERANCES):
        raise ValueError(
            f"'{text}' is not a tolerance; write 'abs A', 'rel R', 'peak P', 'digits N' or several"
        )
    given = zip(names, values, strict=True)
    return Tolerance(**{name: _TOLERANCES[name](value) for name, value in given})


def tolerance_of(given: float | str) -> Tolerance:
    """What a user means by a tolerance: ``X`` is ``abs X peak X``.

    Raises
    ------
    UsageError
        When it is none.
    """
    try:
        return Tolerance(abs=float(given), peak=float(given))
    except ValueError:
        pass  # not a lone number: a tolerance in words
    try:
        return parse_tolerance(str(given))
    except ValueError as fault:
        raise UsageError(str(fault)) from None


def _follow(reference: Reference, comment: str) -> None:
    """Enter the instruction in `comment` into `reference`, if there is one."""
    match = re.fullmatch(r"(\w+)(?:\s+(\S+))?\s*:(?:\s+(.*))?", comment)
    if not match:
        return
    word, subject, text = match[1].lower(), match[2], (match[3] or "").strip()
    if word in _INSTRUCTIONS:
        _INSTRUCTIONS[word](reference, subject, text)
    elif close := get_close_matches(word, _INSTRUCTIONS, n=1, cutoff=0.8):
        raise ValueError(f"'{word}:' is no instruction; did you mean '{close[0]}:'?")


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"'{text}' is not a number") from None


def _size(text: str) -> float:
    found = _number(text)
    if not isfinite(found):
        raise ValueError(f"'{text}' is no finite number")
    return found


def _digits(text: str) -> int:
    if not (text.isdecimal() and len(text) <= 2 and 0 < int(text) <= MOST_DIGITS):
        raise ValueError(
            f"'digits {text}': write how many significant digits are printed, 1 to {MOST_DIGITS}"
        )
    return int(text)


def _tolerance(reference: Reference, subject: str | None, text: str) -> None:
    reference.tolerances.append((subject or "*", parse_tolerance(text)))


def _solve(reference: Reference, subject: str | None, text: str) -> None:
    try:
        reference.options = parse_flags(shlex.split(text))
        _need_numbers(reference.options.get("user", ()))
    except UsageError as fault:
        # The line holds flags, whoever reads it.
        raise ValueError(f"in 'solve: {text}': {fault.args[0]}") from None


def _need_numbers(bindings: Collection[str]) -> None:
    """A reference may come from others: only the user can have a function of Python loaded."""
    for text in bindings:
        if not NUMBERS.fullmatch(text):
            raise UsageError(f"--user {text}: a reference binds numbers only")


def _expect(reference: Reference, subject: str | None, text: str) -> None:
    match = re.fullmatch(r"(\w+)(?:\s+at\s+(\S+)\s+within\s+(\S+))?", text)
    if not match:
        raise ValueError("write 'expect: OUTCOME' or 'expect: OUTCOME at T within DT'")
    if match[1] not in Outcome.__members__:
        close = get_close_matches(match[1], Outcome.__members__, n=1, cutoff=0.0)
        raise ValueError(f"no run ends with '{match[1]}'; did you mean {close[0]}?")
    reference.outcome = Outcome[match[1]]
    reference.stop = (_number(match[2]), _number(match[3])) if match[2] else None


def _interpolate(reference: Reference, subject: str | None, text: str) -> None:
    if text not in INTERPOLATIONS:
        raise ValueError(f"'{text}' is no interpolation; there are {', '.join(INTERPOLATIONS)}")
    reference.interpolate = text


def _measure(reference: Reference, subject: str | None, text: str) -> None:
    reference.measures.append(parse_measure(text))


def parse_measure(text: str) -> Measure:
    """Read ``mean NAME from T0 to T1 = VALUE tol rel R`` and the like; ValueError with the form."""
    match = re.fullmatch(
        rf"(\w+)\s+(\S+)((?:\s+(?:{'|'.join(_WORDS)})\s+\S+)*)\s*=\s*(\S+)\s+tol\s+(.+)",
        text,
    )
    if not match:
        raise ValueError(
            "write 'measure: mean NAME from T0 to T1 = VALUE tol rel R', "
            "'measure: value NAME at T = VALUE tol abs A' or "
            "'measure: arrival NAME through LEVEL = T tol rel R'"
        )
    kind, channel, words, value, tolerance = match.groups()
    pairs = words.split()
    given = dict(zip(pairs[::2], map(_number, pairs[1::2]), strict=True))
    _need_kind(kind, given)
    return Measure(
        kind=kind,
        channel=channel,
        start=given.get("at", given.get("from")),
        end=given.get("at", given.get("to")),
        level=given.get("through"),
        smoothed=given.get("smoothed", 0.0),
        value=_number(value),
        tolerance=parse_tolerance(tolerance),
    )


def _need_kind(kind: str, given: Collection[str]) -> None:
    known = (*KINDS, ARRIVAL, VALUE)
    if kind not in known:
        raise ValueError(f"'{kind}' is no measure; there are {', '.join(known)}")
    if (kind == VALUE) != ("at" in given) or ("at" in given and {"from", "to"} & set(given)):
        raise ValueError(f"'{VALUE} NAME at T' takes one time, the other measures 'from T0 to T1'")
    if (kind == ARRIVAL) != ("through" in given):
        raise ValueError(f"'{ARRIVAL} NAME through LEVEL' takes a level, the other measures do not")


_TOLERANCES: dict[str, Callable[[str], Any]] = {
    "abs": _size,
    "rel": _size,
    "peak": _size,
    "digits": _digits,
}
_INSTRUCTIONS: dict[str, Callable[[Reference, str | None, str], None]] = {
    "tolerance": _tolerance,
    "solve": _solve,
    "expect": _expect,
    "interpolate": _interpolate,
    "measure": _measure,
}
