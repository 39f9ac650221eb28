"""The files that LINEAR, SAVE and RELOAD commands of a scene write and read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.deck.statement_diagnostics import diagnose, place_of
from adamslite.elements.linear import Linear
from adamslite.elements.reload import Reload
from adamslite.elements.save import Save
from adamslite.errors import UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.language.text import contents
from adamslite.outputs.modes import files_beside
from adamslite.outputs.saved_files import missing
from adamslite.outputs.whole_files import same_file

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Diagnostic
    from adamslite.scene import Scene

READ = "read by this run"
KINDS = {
    "EIGENSOL": "modes.csv", "STATEMAT": "states.json", "MATLAB": "states.", "MKB": "mkb.json",
}  # fmt: skip


def files_of_commands(
    scene: Scene, output: Path, beside: Sequence[Path]
) -> tuple[list[Path], list[Path]]:
    """The files that LINEAR commands will fill, in their order, and all that commands write.

    ``output`` is the file of the time histories, ``beside`` are other files of the results. What is
    raised is what :func:`adamslite.result_files.plan` raises.
    """
    commands = [each for each in scene.commands if isinstance(each, Linear)]
    paths = list(_places(commands, output))
    kept = [each for each in scene.commands if isinstance(each, Save | Reload) and each.file]
    saved = [output.with_name(each.file or "") for each in kept]
    made = list(_all_files(commands, paths))
    results = (output, *beside)
    named_by = [each for each, _ in made], [path for _, path in made]
    wrong = list(_taken(*named_by, results, scene.read))
    wrong += _written_twice(made)
    wrong += _taken(kept, saved, results, scene.read)
    wrong += _written_over(kept, saved)
    if wrong:
        raise DeckError(wrong)
    return paths, [*(path for _, path in made), *saved]


def reloaded(scene: Scene, output: Path) -> dict[str, str]:
    """Digests of the files that RELOAD takes from earlier runs, by name."""
    found, written = {}, set()
    for each in scene.commands:
        if isinstance(each, Save):
            written.add(each.file)
        elif isinstance(each, Reload) and each.file and each.file not in written:
            found[each.file] = sha256(contents(output.with_name(each.file))).hexdigest()
    return found


def _file(command: Linear | Save | Reload) -> str:
    """The FILE of a command that has an effect."""
    return command.file or "" if command.kind in ("STATEMAT", "MKB", "SYSTEM") else ""


def _all_files(commands: Sequence[Linear], paths: Sequence[Path]) -> Iterator[tuple[Linear, Path]]:
    """Every file that LINEAR commands write, with its command."""
    for command, path in zip(commands, paths, strict=True):
        yield from ((command, path.with_name(path.name + part)) for part in command.parts)
        yield from ((command, other) for other in files_beside(path, command).values())


def _written_twice(made: Iterable[tuple[Linear, Path]]) -> Iterator[Diagnostic]:
    known: dict[str, Linear] = {}
    for command, path in made:
        other = known.setdefault(path.name.casefold(), command)
        if other is not command:
            what = "that of an earlier LINEAR"
            yield diagnose(command, "file-taken", "file", word=path.name, what=what)


def _written_over(commands: Sequence[Save | Reload], paths: Sequence[Path]) -> Iterator[Diagnostic]:
    """A SAVE to a file that a RELOAD before it has read; the files of an earlier run must exist."""
    written: set[Path] = set()
    read: set[Path] = set()
    for command, path in zip(commands, paths, strict=True):
        if isinstance(command, Save):
            written.add(path)
            if path in read:
                yield diagnose(command, "file-taken", "file", word=path.name, what=READ)
        elif path not in written:
            read.add(path)
            if not path.is_file():
                raise UsageError(f"{place_of(command, 'file')}: {missing(path)}")


def _places(commands: Sequence[Linear], output: Path) -> Iterator[Path]:
    stem = output.with_suffix("").name
    made = {output.name, *map(_file, commands)}
    for each in commands:
        plain = each.kind == "STATEMAT" and each.format == "MATLAB"
        kind, number = KINDS["MATLAB" if plain else each.kind], 2
        name = _file(each) or f"{stem}.{kind}"
        while not _file(each) and name in made:
            name, number = f"{stem}.{number}.{kind}", number + 1
        made.add(name)
        yield output.with_name(name)


def _taken(
    commands: Sequence[Linear | Save | Reload],
    paths: Sequence[Path],
    results: Iterable[str | Path],
    read: Iterable[Path],
) -> Iterator[Diagnostic]:
    for command, path in zip(commands, paths, strict=True):
        word = _file(command)
        if word and any(same_file(path, each) for each in results):
            yield diagnose(command, "file-taken", "file", word=word, what="that of the results")
        elif word and any(same_file(path, each) for each in read):
            yield diagnose(command, "file-taken", "file", word=word, what=READ)
