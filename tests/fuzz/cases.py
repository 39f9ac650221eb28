"""A case: files, and what is called with them.  Those that were found once are kept in a folder.

A kept case is a folder of its files and of ``case.toml``::

    kind = "diff"                       which program meets the files
    arguments = ["a.csv", "b.csv"]      what it is called with
    found = "a traceback: ..."          what it did before it was mended
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

FACTS = "case.toml"
KEPT = Path(__file__).parent / "cases"


@dataclass(frozen=True)
class Case:
    """``files`` by their names, and the words that a program is called with."""

    files: Mapping[str, bytes]
    arguments: tuple[str, ...] = ()

    def put_into(self, folder: Path) -> None:
        """Write the files; others that are there go."""
        for each in folder.iterdir():
            if each.name not in self.files and each.is_file():
                each.unlink()
        for name, data in self.files.items():
            (folder / name).write_bytes(data)

    def with_file(self, name: str, data: bytes) -> Case:
        """With another content of a file."""
        return replace(self, files={**self.files, name: data})

    @property
    def size(self) -> int:
        """Bytes in all files."""
        return sum(map(len, self.files.values()))


def keep(case: Case, kind: str, folder: Path, found: str) -> None:
    """Write a case as a folder; a text of JSON is a text of TOML."""
    folder.mkdir(parents=True)
    case.put_into(folder)
    facts = {"kind": kind, "arguments": list(case.arguments), "found": found}
    lines = (f"{name} = {json.dumps(value)}\n" for name, value in facts.items())
    (folder / FACTS).write_text("".join(lines), "utf-8")


def kept(folder: Path) -> tuple[str, Case]:
    """Kind and case of a folder."""
    facts = tomllib.loads((folder / FACTS).read_text("utf-8"))
    files = {each.name: each.read_bytes() for each in folder.iterdir() if each.name != FACTS}
    return facts["kind"], Case(files, tuple(facts["arguments"]))
