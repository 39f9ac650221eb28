"""All rules about a deck, and `check`, which applies them."""

from __future__ import annotations

from adamslite.checks.assembly import ASSEMBLY_RULES
from adamslite.checks.bodies_and_elements import (
    a_ground,
    distinct_ends,
    ground_without_data,
    idle_arguments,
    inertia,
    markers_of_bodies,
    masses,
    reactions,
    reserved_names,
    second_grounds,
    sections,
    torques_on_points,
    unit_system,
    wrenches_on_points,
    zero_masses,
)
from adamslite.checks.constraints import CONSTRAINT_RULES
from adamslite.checks.contacts import contact_laws, contact_shapes, shapes
from adamslite.checks.dimensions import DIMENSION_RULES
from adamslite.checks.effective_mass import effective_masses
from adamslite.checks.expressions import (
    exponents_or_degrees,
    expressions_too_large,
    unformed_equations,
)
from adamslite.checks.forces import NFORCE_RULES, frictions
from adamslite.checks.inert import (
    acts_on_flexible,
    changed_requests,
    joint_friction,
    passed_over,
)
from adamslite.checks.linear_systems import SYSTEM_RULES
from adamslite.checks.lints import LINT_RULES
from adamslite.checks.markers import (
    facing_markers,
    floating_alone,
    floating_unused,
    floating_use,
    frames,
    inertia_at_mass_centre,
    orientations,
    owners,
)
from adamslite.checks.needless import NEEDLESS_RULES
from adamslite.checks.requests import REQUEST_RULES
from adamslite.checks.rule import Rule, apply
from adamslite.checks.runs import RUN_RULES, file_names
from adamslite.checks.tables import TABLE_RULES
from adamslite.deck.deck import Deck
from adamslite.deck.named_places import with_named
from adamslite.gc_pause import without_collection
from adamslite.language.diagnostics import Diagnostic, sort_by_place
from adamslite.language.messages.ignoring import judged, without_ignored


def check(deck: Deck) -> list[Diagnostic]:
    """Everything to say about a deck that could be read: warnings and advice, in deck order.

    Comments ``! adamslite: ignore CODE`` of the deck are heeded.
    """
    with without_collection():
        found = [*deck.warnings, *with_named(deck, apply(ADVICE, deck))]
        return sort_by_place(judged(deck.source, found, complete=True))


def needless(deck: Deck) -> list[Diagnostic]:
    """What the scene of a deck can do without; `check` reports it, runs do not."""
    found = [*with_named(deck, apply(NEEDLESS_RULES, deck))]
    return sort_by_place(without_ignored(deck.source, found))


RULES: list[Rule] = [
    a_ground,
    second_grounds,
    ground_without_data,
    masses,
    zero_masses,
    inertia,
    markers_of_bodies,
    owners,
    frames,
    orientations,
    floating_alone,
    floating_use,
    floating_unused,
    acts_on_flexible,
    joint_friction,
    reactions,
    distinct_ends,
    torques_on_points,
    wrenches_on_points,
    sections,
    frictions,
    idle_arguments,
    exponents_or_degrees,
    shapes,
    contact_laws,
    contact_shapes,
    reserved_names,
    *REQUEST_RULES,
    *NFORCE_RULES,
    unit_system,
    *CONSTRAINT_RULES,
    *TABLE_RULES,
    *SYSTEM_RULES,
    *RUN_RULES,
    changed_requests,
    passed_over,
]


UNNUMBERED = (
    a_ground, second_grounds, markers_of_bodies, owners, floating_alone, floating_use,
    floating_unused, acts_on_flexible, reactions, distinct_ends, torques_on_points,
    wrenches_on_points, file_names, passed_over, exponents_or_degrees,
)  # fmt: skip
"""Rules that look at no number."""
VALUE_RULES = [rule for rule in RULES if rule not in UNNUMBERED]
"""The others: those that a deck with other numbers may break."""


ADVICE: list[Rule] = [
    inertia_at_mass_centre,
    facing_markers,
    effective_masses,
    unformed_equations,
    expressions_too_large,
    *ASSEMBLY_RULES,
    *LINT_RULES,
    *DIMENSION_RULES,
]
