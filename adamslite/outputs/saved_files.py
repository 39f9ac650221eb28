"""The files of SAVE and RELOAD."""

from __future__ import annotations

from pathlib import Path

from adamslite.errors import UsageError
from adamslite.language.text import contents
from adamslite.outputs.whole_files import whole_file


def missing(name: str | Path) -> str:
    """That a file of RELOAD is not there."""
    return (
        f"there is no file {name}; SAVE/SYSTEM writes it, here before RELOAD or in an earlier run"
    )


class SavedFiles:
    """Texts by name: in a folder, or in memory only.

    Parameters
    ----------
    folder : Path or None
        Where the files are.
    writes : bool
        Whether files are written; one that repeats a run only reads them.
    """

    def __init__(self, folder: Path | None = None, writes: bool = True) -> None:
        self.folder = folder
        self.writes = writes
        self._texts: dict[str, str] = {}

    @property
    def to_read(self) -> SavedFiles:
        """The same files for a run that repeats another one."""
        return SavedFiles(self.folder, writes=False)

    def write(self, name: str, text: str) -> None:
        """Keep a text; a file appears whole or not at all."""
        self._texts[name] = text
        if self.folder is not None and self.writes:
            with whole_file(self.folder / name) as stream:
                stream.write(text)

    def read(self, name: str) -> str:
        """The text of that name.

        Raises
        ------
        UsageError
            When there is none.
        """
        if name in self._texts:
            return self._texts[name]
        if self.folder is None or not (self.folder / name).is_file():
            raise UsageError(f"RELOAD: {missing(name)}")
        try:
            from adamslite.language.file_name import leads_out  # few runs read any

            if leads_out(self.folder / name):
                raise UsageError(f"RELOAD: {name} is a link that leads out of its folder")
            return contents(self.folder / name).decode()
        except UnicodeDecodeError:
            raise UsageError(f"RELOAD: {name} is not a file of SAVE") from None
