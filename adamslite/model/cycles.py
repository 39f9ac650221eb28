"""What depends on what, and on itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterable
    from typing import TypeVar

    from adamslite.language.interfaces import Key

    K = TypeVar("K")


def in_loops(uses: dict[Key, set[Key]]) -> set[Key]:
    """Members of dependency cycles: what uses itself, and components of more than one member that
    all use each other, directly or not.

    Two searches, the second one against the direction of use, find these in a time that grows as
    the number of uses.

    Reference: Aho, Hopcroft, Ullman, Data Structures and Algorithms, 1983, section 6.7.
    """
    users: dict[Key, list[Key]] = {key: [] for key in uses}
    for key, direct in uses.items():
        for each in direct & users.keys():
            users[each].append(key)
    found: set[Key] = set()
    seen: set[Key] = set()
    for root in reversed(behind_others(uses, lambda key: uses[key] & uses.keys())):
        component, pending = [], [root]
        while pending:
            key = pending.pop()
            if key not in seen:
                seen.add(key)
                component.append(key)
                pending += users[key]
        if len(component) > 1 or root in uses[root]:
            found.update(component)
    return found


def behind_others(
    keys: Iterable[K], used: Callable[[K], Iterable[K]], known: Container[K] = ()
) -> list[K]:
    """Keys, and all that they are made of but for what is ``known``, each behind what it uses; of
    a cycle, where a search in depth leaves it.
    """
    found: list[K] = []
    entered: set[K] = set()
    pending = [(key, False) for key in keys][::-1]
    while pending:
        key, complete = pending.pop()
        if complete:
            found.append(key)
        elif key not in entered and key not in known:
            entered.add(key)
            pending.append((key, True))
            pending += [(each, False) for each in used(key)]
    return found


def of_each_other(uses: dict[Key, set[Key]]) -> set[Key]:
    """Keys that use nothing, directly or not, but what ``uses`` has."""
    users: dict[Key, list[Key]] = {}
    for key, direct in uses.items():
        for each in direct:
            users.setdefault(each, []).append(key)
    found = set(uses)
    others = [key for key in users if key not in found]
    while others:
        for user in users.get(others.pop(), ()):
            if user in found:
                found.remove(user)
                others.append(user)
    return found
