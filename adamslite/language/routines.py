"""Routines of users: programs outside a deck whose numbers a statement takes by ``FUNCTION=USER``.

``ROUTINE=library::name`` names one; without it each kind of statement has a name of its own, the
same in every deck.
"""

from __future__ import annotations

from typing import TypeGuard

from adamslite.language.expression import Call, Num, to_text

USER = "USER"
ARGUMENT = "FUNCTION"
"""The argument whose whole value such a call may be."""

USUAL_NAMES = {
    "COUPLER": "COUSUB", "CURVE": "CURSUB", "DIFF": "DIFSUB", "FIELD": "FIESUB", "GFORCE": "GFOSUB",
    "GSE": "GSESUB",
    "MOTION": "MOTSUB", "NFORCE": "NFOSUB", "REQUEST": "REQSUB", "SENSOR": "SENSUB",
    "SFORCE": "SFOSUB", "UCON": "UCOSUB", "VARIABLE": "VARSUB", "VFORCE": "VFOSUB",
    "VTORQUE": "VTOSUB",
}  # fmt: skip


def is_user_call(value: object) -> TypeGuard[Call]:
    """Whether a value is a call ``USER(...)`` to which nothing is bound."""
    return type(value) is Call and value.name == USER and all(type(a) is Num for a in value.args)


def usual_name(keyword: str) -> str:
    """What the routine of a statement is called that has no ROUTINE."""
    return USUAL_NAMES.get(keyword, f"{keyword}_SUB")


def short_name(routine: str) -> str:
    """A routine without its library: ``BitForces`` of ``adrill_solver::BitForces``."""
    return routine.rpartition("::")[2].strip()


def written(call: Call) -> str:
    """The call as a deck has it."""
    return to_text(call)
