"""Messages about lines and whole statements."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE, WARNING
from adamslite.language.messages.entry import Message

STATEMENTS: dict[str, Message] = {
    "more-messages": Message(
        "there is more to say than the {most} messages that are kept: {listed}",
        "correct what comes first, and check again",
    ),
    "changes-not-checked": Message(
        "what this change and those behind it make of the deck is not checked: there are too many",
        "check the command file in parts",
        severity=WARNING,
    ),
    "missing-title": Message(
        "the deck begins with {word} instead of a title; it is read as a statement",
        "put a title line above it: ADAMS takes the first line as the title and does not read it",
        ("PART/1, GROUND\nMARKER/1, PART=1\n", "UNITS/SYSTEM=MKS\nPART/1, GROUND\n"),
        severity=WARNING,
    ),
    "not-a-statement": Message(
        "a statement begins with its name, not with {word}",
        "a comment begins with !, a continuation line with a comma",
        ("(1)", "= 5", "12, GROUND"),
    ),
    "stray-continuation": Message(
        "this line begins with a comma but continues nothing",
        "there is no statement before it",
        ("title\n, MASS=1\nPART/1, GROUND\n",),
    ),
    "missing-leading-comma": Message(
        "{word}= cannot begin a statement",
        "a line that continues a statement begins with a comma: , {word}=...",
        ("MARKER/4, PART=1\nQP=1,2,3",),
    ),
    "missing-slash": Message(
        "a slash must follow the name {word}",
        "statements are written NAME/id, ARGUMENT=value; a continuation line begins with a comma",
        ("PART 4, MASS=1", "UNITS, FORCE=NEWTON"),
    ),
    "missing-id": Message(
        "{word} needs an id after its slash",
        "write {word}/1, or a name in place of the number",
        ("PART/", "MARKER/PART=1", "VARIABLE/, FUNCTION=1"),
    ),
    "bad-id": Message(
        "{text} is not an id",
        "an id is a number from 1 up, of 18 digits at most, or a name beginning with a letter",
        ("MARKER/1.5, PART=1", "MARKER/-1, PART=1", "MARKER/0, PART=1", "MARKER/2nd, PART=1"),
    ),
    "duplicate-id": Message(
        "{label} is defined twice",
        "the first one is in line {line}",
        ("MARKER/1, PART=1", "VARIABLE/a, FUNCTION=1\nVARIABLE/A, FUNCTION=2"),
    ),
    "duplicate-statement": Message(
        "{word} is given twice",
        "the first one is in line {line}; only one is allowed",
        ("UNITS/SYSTEM=MKS\nUNITS/SYSTEM=CGS",),
    ),
    "unknown-statement": Message(
        "there is no statement {word}",
        "names may be shortened to any beginning that fits only one statement",
        ("FORSE/1, I=1, J=2", "MARKR/5, PART=1", "RODEO/1"),
    ),
    "ambiguous-statement": Message(
        "{word} may mean {choices}", "write more letters", ("G/4, I=1", "S/1, I=1")
    ),
    "planned-statement": Message(
        "not supported yet: {word}{times}",
        "the statement exists in ADAMS; this program cannot run it",
        ("LSSMATRIX/1", "SYSVAR/1\nSYSVAR/2"),
    ),
    "command-in-deck": Message(
        "{word} is a command and does not belong in a deck",
        "put it in a command file (.acf)",
        ("STOP", "FILE/MODEL=a"),
    ),
    "after-end": Message(
        "{word} follows END and is not read",
        "put END last",
        ("END\nMARKER/9, PART=1\nMARKER/9, PART=7",),
        severity=WARNING,
    ),
    "unclosed-bracket": Message(
        "the bracket {word} is never closed",
        "",
        (
            "VARIABLE/1, FUNCTION=(1+2",
            "VFORCE/1, I=2, J_PART=1, FX=(1+2\\\n, FY=3",
            "VFORCE/1, I=2, J_PART=1, FX=(1+2\n, FY=3",
        ),
    ),
    "unopened-bracket": Message(
        "the bracket {word} closes nothing",
        "",
        ("VARIABLE/1, FUNCTION=1+2)", "VARIABLE/1, FUNCTION=MAX(1,2))*2"),
    ),
    "wrong-bracket": Message(
        "the bracket {other} is closed by {word}",
        "round brackets close round ones, square brackets square ones",
        ("VARIABLE/1, FUNCTION=[1+2)", "VARIABLE/1, FUNCTION=(1+2]"),
    ),
    "missing-value": Message(
        "{word}= has no value", "", ("VARIABLE/1, FUNCTION=", "VARIABLE/1, IC=, FUNCTION=1")
    ),
    "empty-item": Message(
        "there is nothing between two separators",
        "write a value, or leave one separator out",
        ("MARKER/4, PART=1,, QP=1,2,3", "VARIABLE/1, FUNCTION=1\\\\"),
    ),
    "trailing-comma": Message(
        "the statement ends with a comma",
        "a line that continues a statement begins with a comma itself",
        ("MARKER/4, PART=1,", "MARKER/4,\nMARKER/5, PART=1"),
    ),
    "stray-equal": Message(
        "this = sign has no argument name before it",
        "arguments are separated by commas: I=1, J=2",
        ("VARIABLE/1, FUNCTION=1=2", "MARKER/4, 5=3, PART=1"),
    ),
    "stray-ampersand": Message(
        "& does not continue a line in a deck",
        "begin the next line with a comma; & is for command files",
        ("MARKER/4, PART=1 &\n, QP=1,2,3",),
    ),
    "stray-character": Message(
        "{word} does not belong here",
        "",
        ("VARIABLE/1, FUNCTION=1 # 2", "VARIABLE/1, FUNCTION=2%"),
    ),
    "ignored-error": Message(
        "{word} is an error, and errors cannot be ignored",
        "only warnings and notes can: correct the statement and take the comment away",
        ("MARKER/4, PART=1 ! adamslite: ignore no-mass",),
        ("SIMULATE/DYNAMIC, END=1, STEPS=1 ! adamslite: ignore missing-reference",),
        severity=WARNING,
    ),
    "ignores-nothing": Message(
        "there is no {word} on this line to be ignored",
        "the comment works on the line on which it stands",
        (
            "MARKER/4, PART=1 ! adamslite: ignore no-inertia",
            "! adamslite: ignore no-inertia",
            "MARKER/4, PART=1 ! # adamslite: ignore no-such-code",
        ),
        ("SIMULATE/DYNAMIC, END=1, STEPS=1 ! adamslite: ignore passed-over",),
        severity=NOTE,
    ),
}
