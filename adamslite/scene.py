"""A scene: the files of a run, and its results; shared by `solve` and `verify`."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import adamslite
from adamslite.kept_scene import command_file_beside, find, keep, origin_of, tables_of
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.text import PIPED, STDIN, is_piped, piped
from adamslite.progress import Progress

if TYPE_CHECKING:  # numpy is not needed to check a deck
    from adamslite.analyses.dynamics.history import Journal
    from adamslite.deck.commands import Commands
    from adamslite.deck.deck import Deck
    from adamslite.deck.user_bindings import Given
    from adamslite.results.results import Results

    Values = Mapping[str, float] | Iterable[str]
    User = Mapping[str, Given] | Iterable[str] | None


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A deck and the commands of its run.

    Parameters
    ----------
    deck : Deck
        Without errors.
    commands : Commands
        What the command file says; empty when there is none.
    warnings : tuple of Diagnostic
        What `check` has to say about deck and commands.
    deck_path : Path
    commands_path : Path or None
        The command file, and
    beside : bool
        whether it was taken because it lies beside the deck.
    """

    deck: "Deck"
    commands: "Commands"
    warnings: tuple[Diagnostic, ...]
    deck_path: Path
    commands_path: Path | None
    beside: bool

    @property
    def read(self) -> tuple[Path, ...]:
        """The files that were read, with tables that statements take from files."""
        commands = [self.commands_path] if self.commands_path else []
        tables = (self.deck.folder / name for name in tables_of(self.deck, self.commands))
        return (self.deck_path, *commands, *tables)

    @property
    def stem(self) -> str:
        """The first part of the names of files: what the commands say, else that of the deck."""
        return self.commands.prefix or stem_of(self.deck_path)

    @property
    def title(self) -> str:
        """The deck, with the command file that lies beside it."""
        if self.beside:
            return f"{self.deck_path} with {self.commands_path} beside it"
        return str(self.deck_path)


def stem_of(deck_path: Path) -> str:
    """The first part of the names of files of a deck."""
    return "stdin" if str(deck_path) in (PIPED, STDIN) else deck_path.stem


def load_scene(
    deck_path: Path,
    commands_path: Path | None = None,
    user: "User" = (),
    values: "Values" = (),
) -> Scene:
    """Read and check a deck and its command file, by default the `.acf` of its name beside it; a
    deck called `-` is standard input.

    What an earlier run has kept of the same files is taken instead. `user` is what is bound to
    routines that are no part of them, `values` are numbers to put into the deck, as `read` takes
    them.

    Raises
    ------
    DeckError
        With everything that is wrong in the two files.
    """
    if is_piped(deck_path):
        deck, commands, warnings = read_together(piped(), commands_path, user, values)
        return Scene(
            deck=deck, commands=commands, warnings=warnings, deck_path=Path(STDIN),
            commands_path=commands_path, beside=False,
        )  # fmt: skip
    chosen = commands_path or command_file_beside(deck_path)
    origin = None if user or values else origin_of(deck_path, chosen)
    kept = origin and find(origin)
    read = kept or read_together(deck_path, chosen, user, values)
    if origin and not kept:
        keep(origin, read)
    deck, commands, warnings = read
    return Scene(
        deck=deck, commands=commands, warnings=warnings, deck_path=deck_path,
        commands_path=chosen, beside=commands_path is None and chosen is not None,
    )  # fmt: skip


def read_together(
    deck_source: str | Path,
    commands_source: str | Path | None,
    user: "User",
    values: "Values" = (),
) -> tuple["Deck", "Commands", tuple[Diagnostic, ...]]:
    """A deck and its commands, files or texts, and everything to say about them.

    Raises
    ------
    DeckError
        With everything that is wrong in both.
    """
    from adamslite.checks.inert import in_one_note
    from adamslite.deck.commands import Commands
    from adamslite.reading.read import read_commands
    from adamslite.reading.user_routines import unused_bindings

    found: list[Diagnostic] = []
    try:
        deck = adamslite.read(deck_source, user, values)
        found += adamslite.check(deck)
    except DeckError as fault:
        deck = fault.deck
        found += fault.diagnostics
    commands = Commands()
    if commands_source and deck:
        try:
            commands = read_commands(commands_source, deck)
            found = in_one_note([*found, *commands.warnings], deck, commands)
        except DeckError as fault:
            found += fault.diagnostics
    found += unused_bindings(deck) if deck else ()
    if any(diagnostic.is_error for diagnostic in found):
        raise DeckError(found, deck)
    return deck, commands, tuple(found)


def run_scene(
    scene: Scene,
    options: Mapping[str, Any],
    progress: Progress | None = None,
    folder: Path | None = None,
    journal: "Journal | None" = None,
    output: Path | None = None,
) -> "Results":
    """Simulate a scene; `options` are keyword arguments of `simulate`.

    The files of SAVE and RELOAD are in `folder`; without it they are in memory. `journal` keeps a
    run that takes long. `output` is the file of the results, which the disk has to have room for.

    Raises
    ------
    UsageError
        When there is no such integrator, or nothing says how long to run.
    """
    if any(command.keyword in ("SAVE", "RELOAD") for command in scene.commands):
        from adamslite.outputs.saved_files import SavedFiles

        options = {**options, "files": SavedFiles(folder)}
    options = {**options, "journal": journal} if journal else options
    options = {**options, "file": output} if output else options
    options = {**options, "strict": None}  # who asks for it reports how it ends
    return adamslite.simulate(scene.deck, commands=scene.commands, progress=progress, **options)
