"""Messages about what is legal and probably not meant."""

from __future__ import annotations

from adamslite.language.diagnostics import WARNING
from adamslite.language.messages.entry import Message

LINTS: dict[str, Message] = {
    "starts-apart": Message(
        "MARKER/{i} and MARKER/{j} of {label} start {how}",
        "a run first moves the bodies until the joint closes; where that is not wanted, correct "
        "the places of the markers or of their bodies",
        ("MARKER/4, PART=1, QP=0.1,0,0\nJOINT/1, SPHERICAL, I=2, J=4",
         "MARKER/4, PART=1, QP=0,0.1,0, REULER=10D,0,0\nJOINT/1, FIXED, I=2, J=4",
         "MARKER/4, PART=1, REULER=0,5D,0\nJOINT/1, REVOLUTE, I=2, J=4",
         "MARKER/4, PART=1, QP=0,0,0.1\nJPRIM/1, INPLANE, I=2, J=4"),
        severity=WARNING,
    ),
    "stays-open": Message(
        "no start satisfies all constraints: {row} of {label} stays off by {size}{also}",
        "a run ends before its first step; compare the lengths and places of these statements",
        ("MARKER/4, PART=1\nJPRIM/1, INPLANE, I=2, J=4\n"
         "GCON/1, FUNCTION=DZ(2)-0.1",),
        severity=WARNING,
    ),
}  # fmt: skip
