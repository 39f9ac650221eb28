"""LALR(1) parsing of kinds of tokens by the tables that Lark makes of a grammar.

::

    grammar file --made--> tables     tables, kinds --parse--> what the builder makes of them

Lark takes some 3 us for a token, most of it for a tree and positions that nothing here needs.  Of
its tables these are kept, as JSON:

* ``actions[state][kind]``: the state to shift to, or ``~rule`` to reduce by;
* ``after[state][origin][kind]``: the state behind a nonterminal, where ``kind`` follows.  Rules
  of one child that build nothing (the ladder of precedence) are gone through when this is made;
* ``rules``: ``(origin, length, method, inlined)``.  ``method`` of the builder gets the children and
  returns the value; one without a method is a list, of which ``inlined`` rules are part.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from lark import Lark
    from lark.grammar import Rule

END = "$END"
"""The kind behind the last token."""
ACCEPT = 1 << 30
"""The action where the whole is parsed."""


class Tables(NamedTuple):
    """What the parser of a grammar goes by, and the regular expressions of its terminals."""

    start: int
    actions: list[dict[str, int]]
    after: list[dict[str, dict[str, int]]]
    rules: list[tuple[str, int, str, list[bool]]]
    terminals: dict[str, str]

    @classmethod
    def kept(cls, content: bytes) -> Tables:
        """The tables from their bytes."""
        return cls(*json.loads(content))

    @property
    def content(self) -> bytes:
        """The tables as bytes."""
        return json.dumps(self).encode()


class Unexpected(Exception):
    """The number of the token that does not fit, or how many there are where the end does not."""


def parse(tables: Tables, kinds: Sequence[str], builder: object) -> Any:
    """What the methods of a builder make of the tokens, each of which is its number.

    Raises :class:`Unexpected`.
    """
    actions, after, rules = tables.actions, tables.after, tables.rules
    states: list[int] = [tables.start]
    values: list[Any] = []
    for at, kind in enumerate((*kinds, END)):
        while (action := actions[states[-1]].get(kind)) is not None:
            if action >= 0:
                break
            origin, length, method, inlined = rules[~action]
            children = values[-length:]
            del states[-length:], values[-length:]
            if True in inlined:
                children = _inlined(children, inlined)
            values.append(getattr(builder, method)(children) if method else children)
            states.append(after[states[-1]][origin][kind])
        else:
            raise Unexpected(at)
        states.append(action)
        values.append(at)
    return values[0]


def _inlined(children: list[Any], inlined: list[bool]) -> list[Any]:
    """Children of rules that are part of the one above; the list of the first is used again."""
    first = children[0]
    found: list[Any] = first if inlined[0] and type(first) is list else []
    for child, part in zip(children, inlined, strict=True):
        if child is found:
            continue
        if part and type(child) is list:
            found += child
        else:
            found.append(child)
    return found


# ---- from Lark -----------------------------------------------------------------------------------


def made(grammar: Path, start: str) -> Tables:
    """The tables of a grammar.  No rule of it may be empty."""
    from lark import Lark

    # Tokens are matched elsewhere, and each one counts for the number of a child.
    lark = Lark.open(str(grammar), start=start, parser="lalr", keep_all_tokens=True)
    table: Any = lark.parser.parser._parse_table
    numbers = {state: number for number, state in enumerate(table.states)}
    rules = list(dict.fromkeys(lark.rules))
    actions: list[dict[str, int]] = []
    behind: list[dict[str, int]] = []
    for row in table.states.values():
        actions.append({})
        behind.append({})
        for symbol, (action, target) in row.items():
            if "Reduce" in str(action):
                actions[-1][symbol] = ~rules.index(target)
            else:
                (actions if symbol.isupper() else behind)[-1][symbol] = numbers[target]
    actions[numbers[table.end_states[start]]][END] = ACCEPT
    parts = [_part(rule) for rule in rules]
    kinds = sorted({kind for row in actions for kind in row})
    after = [_after(row, kinds, actions, parts) for row in behind]
    return Tables(numbers[table.start_states[start]], actions, after, parts, _patterns(lark))


def _part(rule: Rule) -> tuple[str, int, str, list[bool]]:
    """A rule as :class:`Tables` has it."""
    origin = str(rule.origin.name)
    inlined = [not each.is_term and each.name.startswith("_") for each in rule.expansion]
    alone = len(inlined) == 1 and rule.options.expand1 and not rule.alias
    method = "" if alone or origin.startswith("_") else rule.alias or origin
    return origin, len(inlined), method, inlined


def _after(
    row: dict[str, int],
    kinds: Iterable[str],
    actions: list[dict[str, int]],
    rules: list[tuple[str, int, str, list[bool]]],
) -> dict[str, dict[str, int]]:
    """States behind each nonterminal in a state, by what follows."""
    found: dict[str, dict[str, int]] = {}
    for origin in row:
        found[origin] = {}
        for kind in kinds:
            state = row[origin]
            while (action := actions[state].get(kind, 0)) < 0:
                above, length, method, _ = rules[~action]
                if length > 1 or method:
                    break
                state = row[above]
            found[origin][kind] = state
    return found


def _patterns(lark: Lark) -> dict[str, str]:
    """Regular expressions of the terminals, in the order of the file."""
    return {each.name: each.pattern.to_regexp() for each in lark.terminals}
