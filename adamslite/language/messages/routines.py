"""Messages about routines of users: calls of programs that are no part of a deck."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE, WARNING
from adamslite.language.messages.entry import Message

_GFORCE = "GFORCE/1, I=2, J_PART=1, FUNCTION=USER({})"

ROUTINES: dict[str, Message] = {
    "missing-routine": Message(
        "the routine {word} is no part of the deck",
        "bind it by --user {word}=module:function or --user KIND/ID=number",
        (
            "VARIABLE/1, FUNCTION=USER(1,2,3)\nVARIABLE/2, FUNCTION=USER()",
            _GFORCE.format("1") + "\\, ROUTINE=drill::Bit",
            "SENSOR/1, HALT, FUNCTION=USER(1.0)",
        ),
    ),
    "user-within": Message(
        "USER(...) is the whole of a FUNCTION, and nothing else",
        "give it a VARIABLE of its own, and use that",
        (
            "VARIABLE/1, FUNCTION=2*USER(1)",
            "VARIABLE/1, FUNCTION=MAX(USER(1),USER(2))",
            "VFORCE/1, I=2, J_PART=1, FX=USER(1)",
        ),
    ),
    "routine-here": Message(
        "FUNCTION is a routine of the user here: USER(...)",
        "expressions are given for single components, such as FX=",
        ("GFORCE/1, I=2, J_PART=1, FUNCTION=TIME",),
    ),
    "user-values": Message(
        "--user binds {text} to {label}, which takes {count} values and gets {given}",
        "a number for each component, separated by commas, or a single 0 for all of them",
        (_GFORCE.format("1"), "VARIABLE/1, FUNCTION=USER(1)"),
        user=("GFORCE/1=1,2", "VARIABLE/1=1,2"),
    ),
    "user-reads": Message(
        "{function}, bound to {label}, reads {text}: {reason}",
        "reads takes expressions of the deck; {{1}} is a parameter, {{id}} the id of the statement",
        ("VARIABLE/1, FUNCTION=USER(1)",),
        user=("VARSUB=user_functions:reads_what_is_not_there",),
    ),
    "unknown-user": Message(
        "--user {option}: {reason}",
        "",
        ("VARIABLE/1, FUNCTION=1",),
        user=("VARIABLE/2=0",),
    ),
    "user-bound": Message(
        "not as the deck has it, but by --user: {bound}",
        "",
        ("VARIABLE/1, FUNCTION=USER(1)\nVARIABLE/2, FUNCTION=USER(2)", _GFORCE.format("")),
        user=("VARSUB=1.5", "GFORCE/1=0"),
        severity=WARNING,
    ),
    "request-left-out": Message(
        "left out, as the routine {word} is no part of the deck: {labels}",
        "",
        ("REQUEST/1, FUNCTION=USER(1)", "REQUEST/1, FUNCTION=USER()\\, ROUTINE=a::b"),
        severity=NOTE,
    ),
}
