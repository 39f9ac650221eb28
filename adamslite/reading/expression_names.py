"""Names in expressions: what each stands for, and messages about those without a meaning.

A name is a constant, a number that a statement of the deck names, or a VARIABLE; as an argument of
a function it is the name of a statement, which an id is as well.
"""

from __future__ import annotations

from typing import NoReturn

from adamslite import functions  # noqa: F401  registers the functions
from adamslite.deck.names import RESERVED, Names
from adamslite.language.expression import Call, Node, Num, Ref
from adamslite.language.function import FUNCTIONS, Function
from adamslite.language.interfaces import ID_DIGITS, Key
from adamslite.language.messages import Log
from adamslite.language.not_supported import FUNCTIONS as PLANNED
from adamslite.language.spelling import spelled
from adamslite.syntax.forms import Tree
from adamslite.syntax.tokens import Lexeme, Tokens, end_of


class Unresolved(Exception):
    """An expression could not be resolved; the reason has been logged."""


class ExpressionNames:
    """The names of one expression after the other, by the place of their token.

    Parameters
    ----------
    names : Names
    log : Log
    """

    def __init__(self, names: Names, log: Log) -> None:
        self.names = names
        self.log = log
        self.constants: dict[str, float] = {}
        """Numbers that statements of the deck give a name, unless a VARIABLE has it."""
        self.tokens: Tokens = []
        """Of the expression at hand."""

    def _name(self, at: int) -> Node:
        word = spelled(self.tokens[at][1]).upper()
        if word in RESERVED:
            return RESERVED[word]
        found = self.names.find("VARIABLE", word)
        if isinstance(found, list):
            self._ambiguous("VARIABLE", at, found)
        if found is not None:
            self._used("VARIABLE", found, at)
            return Call("VARVAL", (Ref("VARIABLE", found),))
        if word in self.constants:
            return Num(self.constants[word], word)
        self._unknown_name(word, at)

    def _unknown_name(self, word: str, at: int) -> NoReturn:
        if word in FUNCTIONS:
            hint = f"{word} is a function: write {FUNCTIONS[word].usage}"
        else:
            hint = self.log.guesses.meant(word, "value", self._known_names)
        self._refuse("unknown-name", self.tokens[at], word=self.tokens[at][1], hint=hint)

    def _known_names(self) -> list[str]:
        return [*RESERVED, *self.constants, *self.names.known("VARIABLE")]

    def _reference(self, function: Function, kind: str, branch: Tree) -> Ref:
        rule, first = branch[0], branch[1]
        text = self.tokens[first][1]
        if rule == "number" and text.isdecimal() and len(text) <= ID_DIGITS:
            key: Key = int(text)
            if key == 0 and kind == "MARKER":
                return Ref(kind, 0)
        elif rule == "name":
            key = spelled(text).upper()
        else:
            self._refuse("not-an-id", self.tokens[first], word=function.name, kind=kind)
        return Ref(kind, self._find(kind, key, first))

    def _find(self, kind: str, key: Key, at: int) -> Key:
        found = self.names.find(kind, key)
        if isinstance(found, list):
            self._ambiguous(kind, at, found)
        if found is None:
            self.log.missing(self.names, kind, key, self.tokens[at][2], end_of(self.tokens[at]))
            raise Unresolved
        self._used(kind, found, at)
        return found

    def _used(self, kind: str, key: Key, at: int) -> None:
        token = self.tokens[at]
        self.names.used(kind, key, token[2], end_of(token))

    def _unknown_function(self, name: str, at: int) -> NoReturn:
        token = self.tokens[at]
        if name in PLANNED:
            self.log.tally("planned-function", name, token[2], end_of(token), word=name)
            raise Unresolved
        if self.names.find("VARIABLE", name) is not None:
            hint = f"{token[1]} is a VARIABLE: an operator is missing before the bracket"
        elif name in RESERVED:
            hint = f"{name} takes no arguments: write {name}"
        elif name == "D":
            hint = "the time derivative of a VARIABLE is written VARVAL(d(name)/dt)"
        else:
            hint = self.log.guesses.meant(name, "function", lambda: [*FUNCTIONS, *PLANNED])
        self._refuse("unknown-function", token, word=token[1], hint=hint)

    def _ambiguous(self, kind: str, at: int, found: list[Key]) -> NoReturn:
        labels = ", ".join(f"{kind}/{key}" for key in found[:5])
        self._refuse("ambiguous-name", self.tokens[at], word=self.tokens[at][1], labels=labels)

    def _log(self, code: str, first: Lexeme, last: Lexeme, hint: str = "", **words: object) -> None:
        self.log.add(code, first[2], end_of(last), hint, **words)

    def _refuse(
        self, code: str, first: Lexeme, last: Lexeme | None = None, hint: str = "", **words: object
    ) -> NoReturn:
        self._log(code, first, last or first, hint, **words)
        raise Unresolved
