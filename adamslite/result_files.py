"""The files that a run writes, determined and checked before it starts, and written.

A name in a deck or command file is a bare file name, and that file lies beside the results. Nothing
that was read is written, neither by its name nor through a link.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.outputs.whole_files import need_writable, same_file
from adamslite.results.adams_options import adams_options
from adamslite.results.formats import format_of

if TYPE_CHECKING:
    from adamslite.outputs.row_by_row import Growing
    from adamslite.results.results import Results
    from adamslite.scene import Scene

#: Commands that write or read files.
FILED = ("LINEAR", "SAVE", "RELOAD")


def plan(scene: Scene, output: str | Path, named: bool) -> list[Path]:
    """The files that the LINEAR commands of a scene will fill, in their order.

    EIGENSOL goes to ``<output>.modes.csv``, STATEMAT to its FILE or ``<output>.states.json``, MKB
    to its FILE or ``<output>.mkb.json``; a second one of a kind is numbered.

    Parameters
    ----------
    output : str or Path
        The file of the time histories.
    named : bool
        Whether the user gave that name.

    Raises
    ------
    DeckError
        When a FILE is a file of this run already.
    UsageError
        When the FILE of a RELOAD does not exist.
    OSError, UsageError
        As :func:`~adamslite.outputs.whole_files.need_writable`, for the results and for each of
        them.
    """
    need_writable(output, scene.read, named)
    beside = adams_files(scene, output)
    paths: list[Path] = []
    written: list[Path] = []
    if any(each.keyword in FILED for each in scene.commands):
        # Few runs have such commands, and their messages take a while to load.
        from adamslite.command_files import files_of_commands

        paths, written = files_of_commands(scene, Path(output), beside)
    for path in (*written, *beside):
        need_writable(path, scene.read, named=False)
    return paths


def adams_files(scene: Scene, output: str | Path) -> list[Path]:
    """The files .req and .res that OUTPUT/REQSAVE and RESULTS/XRF request, beside the results.

    None beside what is no file (`/dev/null`), and none that the results themselves are.
    """
    options, place = adams_options(scene.deck, scene.commands), Path(output)
    if place.exists() and not place.is_file():
        return []
    wanted = ((".req", options.requests), (".res", options.results))
    paths = [place.with_suffix(suffix) for suffix, given in wanted if given]
    return [path for path in paths if not same_file(path, place)]


def growing_files(scene: Scene, output: Path, patterns: Sequence[str]) -> dict[Path, Growing]:
    """The results, and the files .req and .res beside them, as far as they can be written while
    the run lasts, with the columns that any of the ``patterns`` means.
    """
    found = {}
    for path in (output, *adams_files(scene, output)):
        begin = format_of(path).growing
        if begin and not (path.exists() and not path.is_file()):
            found[path] = begin(path, patterns)
    return found


def save(results: Results, path: Path, growing: Mapping[Path, Growing]) -> None:
    """Write results to a file, or what is missing in one that has grown."""
    if path not in growing or not growing[path].finish(results):
        results.save(path)
