"""SAVE and RELOAD: states of a session that are kept, and returned to."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings
    from adamslite.analyses.dynamics.sensors import SensorLog
    from adamslite.analyses.session.saved_state import Kept, State
    from adamslite.analyses.statics.static import StaticSettings
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Redefinition
    from adamslite.elements.reload import Reload
    from adamslite.elements.save import Save
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels
    from adamslite.outputs.saved_files import SavedFiles


class Session(Protocol):
    """What SAVE and RELOAD need of a :class:`adamslite.analyses.session.session.Session`."""

    kernels: Kernels
    present: System | None
    settings: Settings
    statics: StaticSettings
    changes: tuple[Redefinition[Any], ...]
    flags: dict[str, Any]
    time: float
    began_static: bool
    outcome: Outcome
    sensors: SensorLog

    @property
    def deck(self) -> Deck: ...
    @property
    def system(self) -> System: ...
    def change(self, deck: Deck) -> None: ...
    def numbered(self, pivoting: bool) -> System: ...
    def is_driven(self, system: System) -> bool: ...
    def assembled_of(self, system: System) -> System: ...


class Saves:
    """What SAVE has kept, by buffer and file.

    Parameters
    ----------
    files : SavedFiles
    deck : Deck
        As no command has changed it.
    """

    def __init__(self, files: SavedFiles, deck: Deck) -> None:
        self.files = files
        self.deck = deck
        self._kept: dict[tuple[str, str | None], Kept] = {}

    def save(self, session: Session, command: Save) -> None:
        """Keep the present state."""
        system = session.system
        if session.outcome is not Outcome.DONE or not command.where[1]:  # AUTOSAVE alone
            return
        from adamslite.analyses.session.saved_state import Kept, State

        kept = Kept(
            State.of(system, session.time, session.began_static, session.sensors.asleep),
            session.kernels, system, session.settings, session.statics, session.changes,
        )  # fmt: skip
        self._kept[command.where] = kept
        if command.kind == "SYSTEM" and command.file is not None:
            self.files.write(command.file, kept.text())

    def reload(self, session: Session, command: Reload) -> None:
        """Return to a state that was kept, by this session or by an earlier one."""
        kept = self._kept.get(command.where)
        if kept is None:
            self._reload_file(session, str(command.file))
        elif command.kind == "STATES" and not kept.has_model_of(session.deck):
            self._reload_states(session, kept)
        else:
            session.kernels, session.present = kept.kernels, kept.system
            if command.kind == "SYSTEM":
                session.settings, session.statics = kept.settings, kept.statics
                session.changes = kept.changes
            _put(kept.state, session)

    def _reload_states(self, session: Session, kept: Kept) -> None:
        """Put states into a model that has changed since: its constraints are closed again."""
        senvals = kept.kernels.model.deck.senvals
        if session.deck.senvals != senvals:
            none = dict.fromkeys(session.deck.senvals, 0.0)
            session.change(session.deck.with_senvals(none | senvals))
        system = session.system
        kept.state.put_into(kept.system)
        _set(kept.state, session)
        system.adopt(kept.system)
        system.settings.t = session.time
        if session.is_driven(system):
            session.present = session.assembled_of(system)

    def _reload_file(self, session: Session, name: str) -> None:
        from adamslite.analyses.session.saved_state import document

        found = document(self.files.read(name), name, self.deck)
        session.settings = replace(found.settings, **session.flags)
        session.statics, session.changes = found.statics, found.changes
        session.present, session.time = None, found.state.time
        session.change(found.deck)
        system = session.numbered(False)
        found.state.put_into(system)
        if session.is_driven(system):
            # Redundant rows and the order of elimination follow from the posture; the state itself
            # stays as it was kept.
            session.present = session.assembled_of(system)
            _put(found.state, session)


def _put(state: State, session: Session) -> None:
    """Put a state into the system that it belongs to."""
    state.put_into(session.system)
    _set(state, session)


def _set(state: State, session: Session) -> None:
    """What the session itself holds of a state."""
    session.time, session.began_static = state.time, state.at_rest
    session.sensors.asleep = dict(state.asleep)
