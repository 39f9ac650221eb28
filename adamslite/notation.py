"""How messages are written: options as `--end T` on the command line and `end=T` in Python, and
control characters as their pictures.

Messages are written as the command line has them.  Shown to a user of Python they are translated:

    use the flags --end T --steps N       use the arguments end=T, steps=N
    --integrator EULER: there are ...     integrator='EULER': there are ...
    --user VARIABLE/1=0                   user={'VARIABLE/1': 0}
    `adamslite check` prints ...          `adamslite.check` prints ...

An option that a message names alone is followed by nothing, or by a value that is a word in
capitals or ends with a colon.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

PYTHON, COMMAND_LINE = "Python", "command line"
#: The file that is standard output.
STDOUT = "-"

#: What Python calls otherwise than by an option.
PHRASES = {
    "the flags --": "the arguments --",
    "(second argument, or ": "(commands=, or ",
    "name the command file on the command line: `adamslite solve DECK FILE.acf`":
        "give the command file to the run: `adamslite.simulate(DECK, commands=FILE)`",
    "`adamslite solve -o FILE`": "`Results.save`",
    "give -o another name": "choose another name",
    "a table (-o NAME.csv)": "a table of the command line",
    "or -o FILE.csv": "or a table",
    "nor in one that --allow-path opens": "nor in one that adamslite.allow_path opens",
    "`solve`": "`simulate`",
}  # fmt: skip
#: Functions of Python whose names are not those of their commands.
FUNCTIONS = {"solve": "simulate", "linear": "linearize"}
#: Arguments of Python whose names are not those of their options.
ARGUMENTS = {"tol": "tolerance", "from": "start", "to": "until"}
#: Values of `--user` that stand for others.
FORMS = {"module:function": "function", "number": "number"}

#: What a terminal obeys instead of showing it: controls, marks that turn the direction of writing,
#: characters without width, separators that some programs take for the end of a line, and halves
#: of letters that cannot be written (bytes of file names that are no text can).
OBEYED = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\xad\u061c\u180e\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f"
    "\ufeff\ufff9-\ufffb\ufffe\uffff\ud800-\udc7f\udd00-\udfff]"
)
PICTURES, DELETE, UNKNOWN = 0x2400, 0x7F, "\ufffd"

_notation = PYTHON


@contextmanager
def notation(name: str) -> Iterator[None]:
    """Meanwhile messages are written for the command line, or for Python."""
    before = current()
    use(name)
    try:
        yield
    finally:
        use(before)


def use(name: str) -> None:
    """Write messages for the command line, or for Python, from now on."""
    global _notation
    _notation = name


def current() -> str:
    """For whom messages are written: ``PYTHON`` unless the command line runs."""
    return _notation


def shown(text: str) -> str:
    """A message as its reader writes options."""
    return text if _notation == COMMAND_LINE else in_python(text)


def in_python(text: str) -> str:
    """A message in the notation of Python; see the module."""
    if "-" not in text and "`" not in text:
        return text
    for phrase, other in PHRASES.items():
        text = text.replace(phrase, other)
    binding, option, command, several = _patterns()
    text = several.sub(r"\1, \2", text)
    text = binding.sub(_binding, text)
    text = option.sub(_option, text)
    return command.sub(_command, text)


@cache
def _patterns() -> tuple[re.Pattern[str], ...]:
    """Bindings, options, commands in backticks, and options that follow each other."""
    name = r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)"
    value = r"(?: ([A-Z]+\b(?![a-z/=])|[^\s:]+(?=: )))?"
    return (
        re.compile(r"(?<![\w-])--user ([^\s=:]+)=([^\s;]*[^\s;:,])"),
        re.compile(name + value),
        re.compile(r"`adamslite ([a-z]+)(?: ([^`]+))?`"),
        re.compile(r"(--[a-z]+ [A-Z]+) (--[a-z])"),
    )


def _binding(found: re.Match[str]) -> str:
    name, value = found.groups()
    return f"user={{{name!r}: {_literal(value)}}}"


def _literal(value: str) -> str:
    if value in FORMS:
        return FORMS[value]
    try:
        float(value)
    except ValueError:
        return repr(value)
    return value


def _option(found: re.Match[str]) -> str:
    name, value = ARGUMENTS.get(found[1], found[1].replace("-", "_")), found[2]
    if value is None:
        return f"{name}="
    if name == "user":
        return f"user={{{value!r}: ...}}"
    return f"{name}={value if value.isupper() and len(value) == 1 else _literal(value)}"


def _command(found: re.Match[str]) -> str:
    name, given = FUNCTIONS.get(found[1], found[1]), found[2]
    return f"`adamslite.{name}{f'({given!r})' if given else ''}`"


def visible(text: str) -> str:
    """A text as it may be shown: each control character is one that looks like its name.

    Escape becomes ``\u241b``; what has no picture, as a mark that turns the direction of writing,
    becomes ``\ufffd``. Tabs and ends of lines stay. Characters keep their places.
    """
    return OBEYED.sub(picture, text) if OBEYED.search(text) else text


def picture(found: re.Match[str]) -> str:
    """What is shown instead of a control character."""
    code = ord(found[0])
    if code < ord(" "):
        return chr(PICTURES + code)
    return chr(PICTURES + ord("!")) if code == DELETE else UNKNOWN
