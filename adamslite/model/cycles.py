"""What depends on itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key


def in_loops(uses: dict[Key, set[Key]]) -> set[Key]:
    """Members of dependency cycles."""
    reach = {key: set(direct) for key, direct in uses.items()}
    changed = True
    while changed:
        changed = False
        for direct in reach.values():
            more = set().union(*(reach.get(k, set()) for k in direct)) - direct
            if more:
                direct |= more
                changed = True
    return {key for key, all_used in reach.items() if key in all_used}
