"""Peak of the resident memory of this process, which Linux can be told to forget."""

from __future__ import annotations

import resource
from pathlib import Path

STATUS, FORGET = Path("/proc/self/status"), Path("/proc/self/clear_refs")
#: What ``clear_refs`` takes for "the peak".
PEAK = "5"


def forget_peak() -> None:
    """Count the peak from here on; where that is not possible it stays that of the process."""
    try:
        FORGET.write_text(PEAK)
    except OSError:
        return


def peak() -> float:
    """Peak [MB].

    Not ``ru_maxrss`` where it can be helped: a new process inherits that of its parent.
    """
    if STATUS.exists():
        lines = STATUS.read_text().splitlines()
        known = next((line for line in lines if line.startswith("VmHWM")), None)
        if known:
            return float(known.split()[1]) / 1024.0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
