"""The time histories of a session: what its analyses wrote, one after the other."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Piece(NamedTuple):
    """Times (nt,), names of columns, values (nt, nc)."""

    times: np.ndarray
    names: tuple[str, ...]
    values: np.ndarray


class History:
    """Pieces of one table; commands between them may have changed the columns."""

    def __init__(self) -> None:
        self.pieces: list[Piece] = []
        self._whole: Piece | None = None

    def append(self, piece: Piece, static: bool, after_rest: bool) -> None:
        """Add what an analysis wrote; a state both ends and begins two analyses only once.

        An equilibrium (``static``) is another state at the same time, which takes the place of the
        last one where the analysis begins ``after_rest``.
        """
        self._whole = None
        last = self.pieces[-1] if self.pieces else None
        if last and len(piece.times) and len(last.times) and last.times[-1] == piece.times[0]:
            if after_rest:
                self.pieces[-1] = Piece(last.times[:-1], last.names, last.values[:-1])
            elif not static:
                piece = Piece(piece.times[1:], piece.names, piece.values[1:])
        if len(piece.times) or not last:
            self.pieces.append(piece)

    @property
    def whole(self) -> Piece:
        """All pieces in one; a column that a piece does not have holds no number there."""
        if self._whole is None:
            self._whole = self._joined()
        return self._whole

    def _joined(self) -> Piece:
        if not self.pieces:
            return Piece(np.zeros(0), (), np.zeros((0, 0)))
        if len(self.pieces) == 1:
            return self.pieces[0]
        names = tuple(dict.fromkeys(name for each in self.pieces for name in each.names))
        values = [each.values if each.names == names else _spread(each, names)
                  for each in self.pieces]  # fmt: skip
        times = np.concatenate([each.times for each in self.pieces])
        return Piece(times, names, np.concatenate(values))


def _spread(piece: Piece, names: tuple[str, ...]) -> np.ndarray:
    """The values of a piece under more names (nt, nc)."""
    column = {name: k for k, name in enumerate(names)}
    values = np.full((len(piece.times), len(names)), np.nan)
    values[:, [column[name] for name in piece.names]] = piece.values
    return values
