"""The summary of a run in rows to read: its counters, and what was done to model and method."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from adamslite.results.results import Results

#: A row of the counters, and what it shows; left out where a result file has lost a counter.
FIGURES = (
    ("reached", "t = {t_end:g}"),
    ("degrees of freedom", "{dof}"),
    ("steps", "{steps} and {rejected} rejected"),
    ("Newton iterations", "{newton}"),
    ("Jacobians", "{jacobians}, factorizations {factorizations}"),
    ("CPU", "{setup_cpu_s:.2f} s to set up, {solve_cpu_s:.2f} s to solve"),
    ("constraints", "violated by {max_violation:.1e} at most"),
)
#: Comments of the results that the summary repeats.
NOTES = (
    "user", "kinematic", "speed jumps", "analyses",
    "assembled", "start speeds", "redundant", "not reached", "not moved", "equilibrium", "order",
    "accuracy", "energy", "time", "linear", "no number", "sensor", "out of its law", "info",
    "not looked for",
)  # fmt: skip


#: The comment on units of a deck without UNITS.
AS_GIVEN = "as in the deck"
#: What the note of the accuracy says where results have lost the motion.
UNDETERMINED = "the result is not determined at this ERROR"
NO_UNITS = "the deck has no UNITS: force = mass * acceleration in whatever units its numbers have"


def ending(results: Results) -> str:
    """How the run ended, in a line."""
    if results.outcome.is_requested:
        return results.outcome.sentence
    return f"stopped early ({results.outcome.name})"


def figures(results: Results) -> list[tuple[str, str]]:
    """Counters of the run: what, and how much."""
    found = []
    for label, form in FIGURES:
        try:
            found.append((label, form.format(**results.summary)))
        except KeyError:
            continue
    return found


def notes(results: Results) -> list[tuple[str, str]]:
    """What the program did to the model on its own, and what is known of the accuracy."""
    found = [(each, results.meta[each]) for each in NOTES if each in results.meta]
    return [*found, *([("units", NO_UNITS)] if results.meta.get("units") == AS_GIVEN else [])]
