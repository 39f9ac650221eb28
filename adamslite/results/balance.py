"""The balance of energy of a run: what an audit finds."""

from __future__ import annotations

from dataclasses import dataclass

# Share of the largest energy that an elastic law may create before it is reported: such laws hold
# for small angles, and are off by the square of the angle.
CREATION = 0.01


@dataclass(frozen=True)
class Balance:
    """What the audit of a run found.

    Parameters
    ----------
    gap, time, explained : float
        The largest difference between the change of energy and the work done, the time of it, and
        how much of that ERROR explains.
    energy : float
        The largest kinetic or stored energy.
    created, created_at : float
        Energy that elastic elements gave without having taken it, and until when.
    momenta : tuple of (drift, explained)
        Largest changes of momentum and angular momentum about the origin; empty where something
        external acts.
    missed : int
        Panels of the audit's own integrals that it could not resolve.
    """

    gap: float
    time: float
    explained: float
    energy: float
    created: float
    created_at: float
    momenta: tuple[tuple[float, float], ...]
    missed: int

    @property
    def closes(self) -> bool:
        """Whether nothing is worse than ERROR explains."""
        return not self.warnings()

    def warnings(self) -> list[str]:
        """What is wrong, as sentences."""
        found = []
        if not self.gap <= self.explained:
            found.append(
                f"the balance of energy is off by {self.gap:.3g} at t = {self.time:.6g}, of which "
                f"ERROR explains {self.explained:.3g}: errors of steps add up, or steps passed "
                "over a force; compare a run with a smaller ERROR and HMAX"
            )
        for name, (drift, explained) in zip(("", "angular "), self.momenta, strict=False):
            if not drift <= explained:
                found.append(
                    f"nothing external acts, and the {name}momentum changes by {drift:.3g}, of "
                    f"which ERROR explains {explained:.3g}"
                )
        if self.created > CREATION * self.energy:
            found.append(
                f"BUSHING, FIELD or BEAM gave {self.created:.3g} more than they had taken until "
                f"t = {self.created_at:.6g}: their laws hold for small angles about two axes"
            )
        return found

    def __str__(self) -> str:
        """One line for a summary."""
        wrong = "; ".join(self.warnings())
        if wrong:
            return f"WARNING: {wrong}"
        text = f"balance closes to {self.gap:.1e} of {self.energy:.3g}"
        if self.momenta:
            text += ", momenta are kept to {:.1e} and {:.1e}".format(*(d for d, _ in self.momenta))
        return text
