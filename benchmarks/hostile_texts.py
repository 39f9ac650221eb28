"""Texts that no author writes and a reader has to survive: one thing again and again.

Every kind comes in one line and in many lines, in any size.
"""

from __future__ import annotations

from codecs import BOM_UTF8
from collections.abc import Callable, Iterator
from itertools import count
from typing import NamedTuple

BODIES = """hostile
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
"""


class Kind(NamedTuple):
    """A text: ``head``, pieces with ``line`` or ``lines`` between them, ``tail``.

    ``piece``: the text of a piece, or of the piece with a number.
    """

    head: str
    piece: str | Callable[[int], str]
    line: str = ""
    lines: str = "\n"
    tail: str = "\nEND\n"
    encoding: str = "utf-8"

    def text(self, size: int, many: bool) -> str:
        """So many characters, in many lines or in one."""
        between, pieces, length = self.lines if many else self.line, [], len(self.head)
        for piece in self._pieces():
            pieces.append(piece)
            length += len(piece) + len(between)
            if length >= size:
                break
        return f"{BODIES}{self.head}{between.join(pieces)}{self.tail}"

    def data(self, size: int, many: bool) -> bytes:
        """The same as the bytes of a file."""
        return self.text(size, many).encode(self.encoding, "surrogatepass")

    def _pieces(self) -> Iterator[str]:
        piece = self.piece
        return (piece if isinstance(piece, str) else piece(n) for n in count())


def _again(piece: str | Callable[[int], str], head: str = "") -> Kind:
    return Kind(head, piece)


def _argument(piece: str | Callable[[int], str], tail: str = "\nEND\n") -> Kind:
    """What continues a statement, on the same line or as lines that begin with a comma."""
    return Kind("MARKER/3, PART=2", piece, tail=tail)


def _expression(piece: str | Callable[[int], str], head: str = "1", tail: str = "\nEND\n") -> Kind:
    return Kind(f"VARIABLE/1, FUNCTION={head}", piece, lines="\n, ", tail=tail)


def _statements(piece: str | Callable[[int], str], head: str = "", tail: str = "\nEND\n") -> Kind:
    return Kind(head, piece, line=";", tail=tail)


def _words(*words: str) -> Callable[[int], str]:
    """These by turns, with a number where they have a place for it."""
    return lambda n: words[n % len(words)].format(n)


def _chain(step: str) -> Kind:
    """VARIABLEs each of which takes the value of the one before it twice."""
    return _statements(
        lambda n: f"VARIABLE/{n + 2}, FUNCTION={step.format(n + 1)}",
        head="VARIABLE/1, FUNCTION=TIME\n",
    )


#: Characters and words, as they come.
CHARACTERS = {
    "commas": _again(","),
    "backslashes": _again("\\"),
    "opening brackets": _again("("),
    "closing brackets": _again(")"),
    "square brackets": _again("["),
    "empty brackets": _again("()"),
    "letters": _again("a"),
    "words": _again("ab "),
    "digits": _again("9"),
    "numbers": _again("1 "),
    "semicolons": _again(";"),
    "quotes": _again('"'),
    "exclamation marks": _again("!"),
    "equal signs": _again("="),
    "slashes": _again("/"),
    "stars": _again("*"),
    "colons": _again(":"),
    "ampersands": _again("&"),
    "blanks": _again(" "),
    "tabs": _again("\t"),
    "NULs": _again("\0"),
    "control characters": _again("\x1b[31m\x07\x01"),
    "lone returns": _again("a\r"),
    "vertical tabs": _again("\v\f\x85\u2028"),
    "letters with accents": _again("\u00e9"),
    "deltas": _again("\u0394"),
    "increments": _again("\u2206"),
    "emoji": _again("\U0001f600"),
    "surrogates": _again("\ud800", "! "),
    "dollars": _again("$"),
    "pairs of dollars": _again("$$"),
    "dollars and letters": _again("$a"),
    "indices": _again("a_{"),
    "fractions": _again("\\frac{"),
    "fractions that close": _again("\\frac{1}{2}"),
    "fonts": _again("\\text{"),
    "brackets of LaTeX": _again("\\["),
    "carets": _again("^"),
    "Greek of LaTeX": _again("\\Delta "),
    "marks of byte order": _again("\ufeff"),
    "UTF-16": Kind("", "MARKER/3, PART=2, ZZZ=1 ", encoding="utf-16"),
    "letters and slashes": _again("A/"),
    "returns and ends of lines": _again(_words("a,", "b\r", "c\r\n", "d\n\r")),
    "quotes that do not close": _again(_words('"a b\n', "c", '"')),
    "commas and blanks": _again(", ,\t,"),
    "all signs": _again(_words(*",\\()[]=/:;*&!\"$^+-", "a", "1", "{{", "}}")),
}  # fmt: skip

#: One statement.
ARGUMENTS = {
    "unknown arguments": _argument(", ZZZ=3"),
    "unknown arguments of one name each": _argument(lambda n: f", ZZZ{n}=3"),
    "the same argument": _argument(", QP=1"),
    "arguments without values": _argument(", QP="),
    "values": _argument(", 1"),
    "words as values": _argument(", abc"),
    "references": Kind("ARRAY/1, IC, NUMBERS=1", ", 1"),
    "splines": Kind("SPLINE/1, X=0", ", 1", tail=", Y=1,2\nEND\n"),
    "empty items": _argument(", ,"),
    "separators": _argument("\\"),
    "open brackets": _argument(", QP=("),
    "closed brackets": _argument(", QP=)"),
    "closed and open brackets": _argument(", QP=]("),
    "equal signs in arguments": _argument(", =QP"),
    "numbers of many digits": _argument("9", ),
    "names of many letters": Kind("MARKER/3, PART=", "a"),
    "a keyword of many letters": Kind("MARKER/3, ", "a", tail="=1\nEND\n"),
    "a statement of many letters": Kind("", "a", tail="/1, PART=1\nEND\n"),
    "an id of many letters": Kind("MARKER/", "a", tail=", PART=1\nEND\n"),
    "ids of many words": Kind("MARKER/", "a ", tail=", PART=1\nEND\n"),
    "text in quotes": Kind('STRING/1, STRING="', "a", tail='"\nEND\n'),
    "titles of a request": Kind("REQUEST/1, CNAMES=a", ", a"),
    "components of a request": Kind("REQUEST/1, F1=1", _words("\\ F{0}=TIME")),
    "comments in a statement": Kind("MARKER/3, PART=2", " ! comment\n", lines=" ! other\n, "),
    "continued by ampersands": Kind("MARKER/3, PART=2", " &\n"),
    "continued by ampersands and commas": _argument(" &\n, QP=1"),
    "tabs between words": _argument(",\tQP\t=\t1"),
    "NULs in a statement": _argument(", QP=\0"),
    "long names of arguments": _argument(lambda n: f", {'Z' * 1000}{n}=3"),
    "numbers with signs": Kind("ARRAY/1, IC, NUMBERS=1", ", -1D-3"),
    "brackets in values": _argument(", QP=((1, 2), [3])"),
    "a list of markers that are missing": Kind(
        "COUPLER/1, JOINTS=1", lambda n: f", {n + 5000}"
    ),
    "a matrix": Kind("MATRIX/1, FULL, ROWS=1, COLUMNS=100, VALUES=1", ", 1"),
}  # fmt: skip

#: One expression.
EXPRESSIONS = {
    "sums": _expression("+1"),
    "sums of TIME": _expression("+TIME"),
    "sums of measures": _expression("+DX(2, 1)"),
    "sums of unknown names": _expression(lambda n: f"+nothing{n}"),
    "sums of unknown markers": _expression(lambda n: f"+DX({n + 9}, 1)"),
    "sums of unknown functions": _expression(lambda n: f"+NOTHING{n}(1)"),
    "differences": _expression("-TIME"),
    "products": _expression("*TIME"),
    "quotients": _expression("/TIME"),
    "powers": _expression("**9"),
    "powers of TIME": _expression("**TIME"),
    "minus signs": _expression("-", head=""),
    "plus signs": _expression("+", head="", tail="1\nEND\n"),
    "sums in brackets": _expression("(1+", head=""),
    "brackets": _expression("(", head=""),
    "sines": _expression("SIN(", head=""),
    "branches": _expression("IF(TIME: 1, 2, ", head=""),
    "maxima": Kind("VARIABLE/1, FUNCTION=MAX(1", ", TIME", tail=")\nEND\n"),
    "polynomials": Kind("VARIABLE/1, FUNCTION=POLY(TIME, 0, 1", ", 1.5", tail=")\nEND\n"),
    "colons in a function": Kind("VARIABLE/1, FUNCTION=POLY(TIME: 1", ":1", tail=")\nEND\n"),
    "numbers side by side": _expression(" 1"),
    "closing brackets in an expression": _expression(")"),
    "signs of other languages": _expression("^2"),
    "commas in an expression": _expression(",+1"),
    "a long number": _expression("1"),
    "a long exponent": _expression("1", head="1E"),
    "a derivative of a name": _expression("+VARVAL(d(x)/dt)"),
    "numbers in degrees": _expression("+9D"),
    "exponents or degrees": _expression("+9D+2"),
    "brackets inside brackets": _expression("+((((((1))))))"),
    "brackets of other kinds inside each other": _expression("+([(a)])"),
    "branches of branches": _expression("IF(", head=""),
    "calls of calls": _expression("+SIN(SIN(SIN(TIME)))"),
    "quotes in an expression": _expression('+"a"'),
    "names of many letters in an expression": _expression("a", head="1+"),
    "unlike brackets": _expression("+(1]"),
}  # fmt: skip

#: Many statements.
STATEMENTS = {
    "unknown statements": _statements("ZZZ/1, A=2"),
    "unknown statements of one name each": _statements(lambda n: f"ZZ{n}Z/1, A=2"),
    "misspelt statements": _statements(lambda n: f"MARKRE/{n + 9}, PART=2"),
    "statements of other names": _statements(_words("MARKE{0}R/1, PART=1", "PA{0}RT/1")),
    "letters alone": _statements("a"),
    "statements without id": _statements("MARKER/, PART=2"),
    "statements without slash": _statements("MARKER, PART=2"),
    "statements of the same id": _statements("MARKER/3, PART=2"),
    "statements of the same name": Kind(
        "", lambda n: f"! adams_view_name='a'\nMARKER/{n + 9}, PART=2"
    ),
    "references to one name": Kind(
        "", lambda n: f"! adams_view_name='a'\nMARKER/{n + 9}, PART=a"
    ),
    "missing references": _statements(lambda n: f"MARKER/{n + 9}, PART={n + 1009}"),
    "missing names": _statements(lambda n: f"MARKER/m{n}, PART=part{n}"),
    "missing markers": _statements(lambda n: f"REQUEST/{n + 9}, F2=DX({n + 5000}, 1)"),
    "missing names of markers": _statements(
        _words("MARKER/some{0}name, PART=2", "REQUEST/{0}9, F2=DX(some{0}nam, 1)")
    ),
    "unknown names": _statements(
        _words("VARIABLE/name{0}, FUNCTION=1", "VARIABLE/other{0}, FUNCTION=nam{0}")
    ),
    "unknown functions": _statements(lambda n: f"VARIABLE/{n + 9}, FUNCTION=SINN{n}(1)"),
    "statements not supported": _statements(lambda n: f"PFORCE/{n + 9}, I=1, J=2"),
    "statements passed over": _statements(lambda n: f"OUTPUT/{n}, NOPRINT"),
    "wrong arguments": _statements(lambda n: f"MARKER/{n + 9}, PRT=2, XP=1"),
    "wrong values": _statements(lambda n: f"MARKER/{n + 9}, PART=2, QP=1,a,2"),
    "wrong rules": _statements(lambda n: f"PART/{n + 9}, MASS=-1"),
    "parts without marker": _statements(lambda n: f"PART/{n + 9}, MASS=1, CM=2"),
    "markers": _statements(lambda n: f"MARKER/{n + 9}, PART=2, QP={n},0,0"),
    "point masses": _statements(lambda n: f"POINT_MASS/{n + 9}, MASS=1"),
    "joints of one marker": _statements(lambda n: f"JOINT/{n + 9}, FIXED, I=1, J=2"),
    "springs": _statements(
        lambda n: f"SPRINGDAMPER/{n + 9}, TRANSLATIONAL, I=1, J=2, K=1, C=1, LENGTH=1"
    ),
    "expressions of their own shape": _statements(
        lambda n: f"VARIABLE/{n + 9}, FUNCTION=" + "TIME".join("+-"[n >> k & 1] for k in range(20))
    ),
    "variables of variables": _chain("VARVAL({0})+1"),
    "doubled variables": _chain("VARVAL({0})*VARVAL({0})+VARVAL({0})*VARVAL({0})"),
    "variables in a circle": _statements(
        lambda n: f"VARIABLE/{n + 1}, FUNCTION=VARVAL({n + 2})",
        tail="\nVARIABLE/1000001, FUNCTION=1\nEND\n",
    ),
    "arrays": _statements(lambda n: f"ARRAY/{n + 9}, IC, NUMBERS=1,2,3"),
    "comments": Kind("", "! a comment ", line="", lines="\n"),
    "comments that name": Kind("", "! adams_view_name='x' ", line="", lines="\n"),
    "comments that ignore": Kind("", "! adamslite: ignore no-run ", line="", lines="\n"),
    "comments that ignore nothing": _statements(
        lambda n: f"MARKER/{n + 9}, PART=2 ! adamslite: ignore wrong-{n}\n"
    ),
    "lines behind the end": Kind("END\n", "MARKRE/1, PART=2 ", lines="\n"),
    "commands": _statements(lambda n: f"SIMULATE/DYNAMIC, END={n + 1}, STEPS=10"),
    "commands in a deck": _statements("LIST"),
    "names of other kinds": _statements(
        _words("PART/{0}00, MASS=1", "MARKER/{0}00, POINT_MASS={0}00")
    ),
    "sensors": _statements(
        lambda n: f"SENSOR/{n + 9}, FUNCTION=TIME, EQ, VALUE=1, HALT"
    ),
    "requests": _statements(lambda n: f"REQUEST/{n + 9}, DISPLACEMENT, I=1, J=2"),
    "motions": _statements(lambda n: f"MOTION/{n + 9}, JOINT=9, FUNCTION=TIME"),
    "couplers": _statements(lambda n: f"COUPLER/{n + 9}, JOINTS=1,2, TYPE=T:T, SCALES=1,2"),
    "differences of time": _statements(lambda n: f"VARIABLE/{n + 9}, FUNCTION=DELAY(TIME, 1, 0)"),
    "parts of the same id": _statements("PART/9, MASS=1"),
    "strings": _statements(lambda n: f'STRING/{n + 9}, STRING="text {n}"'),
    "strings that do not end": _statements(lambda n: f'STRING/{n + 9}, STRING="text'),
    "names of nearly one spelling": _statements(
        _words("MARKER/aaaa{0}bbbb, PART=2", "REQUEST/{0}9, F2=DX(aaaa{0}bbbc, 1)")
    ),
    "variables of nearly one spelling": _statements(
        _words("VARIABLE/aaaa{0}bbbb, FUNCTION=1", "VARIABLE/c{0}, FUNCTION=aaaa{0}bbbc")
    ),
    "arguments of nearly one spelling": _statements(lambda n: f"MARKER/{n + 9}, PAART{n}=2"),
    "joints of markers that are missing": _statements(
        lambda n: f"JOINT/{n + 9}, FIXED, I={n + 5000}, J={n + 5001}"
    ),
    "long names": _statements(lambda n: f"MARKER/{'m' * 1000}{n}, PART={'p' * 1000}{n}"),
    "splines of one point": _statements(lambda n: f"SPLINE/{n + 9}, X=1, Y=1"),
    "exponents in many statements": _statements(lambda n: f"VARIABLE/{n + 9}, FUNCTION=9D+2"),
    "states": _statements(lambda n: f"DIFF/{n + 9}, IC=1, FUNCTION=DIF({n + 9})"),
    "ends": Kind("", "END", lines="\n"),
    "graphics": _statements(lambda n: f"GRAPHICS/{n + 9}, CYLINDER, CM=2, LENGTH=1, RADIUS=1"),
}  # fmt: skip

KINDS: dict[str, Kind] = CHARACTERS | ARGUMENTS | EXPRESSIONS | STATEMENTS
BYTES: dict[str, Callable[[int], bytes]] = {
    "mark and nothing": lambda size: BOM_UTF8 * (size // len(BOM_UTF8)),
    "every byte": lambda size: bytes(range(256)) * (size // 256),
    "half a UTF-16 text": lambda size: b"\xff\xfe" + b"\0\xd8" * (size // 2),
    "UTF-16 and a byte": lambda size: (
        KINDS["markers"].text(size // 2, True).encode("utf-16") + b"a"
    ),
    "a mark behind marks": lambda size: BOM_UTF8 * 3 + KINDS["markers"].data(size, True),
    "Latin-1": lambda size: b"\xe4\xf6 \n" * (size // 4),
    "odd UTF-16": lambda size: b"\xff\xfe" + b"a" * (size // 2 * 2 + 1),
}
"""Files that are no text."""
