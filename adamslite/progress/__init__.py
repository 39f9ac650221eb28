"""Reports of how far a run is: in a terminal, as lines of a file, in a notebook.

A run calls ``watch(state)`` about ten times a second, from another thread than the one that
integrates, and ``say(sentence)`` before something that takes long, such as compiling the engine
the first time.
"""

from adamslite.progress.analysis import AnalysisProgress
from adamslite.progress.base import Progress, RunsState, RunState
from adamslite.progress.choice import progress_of
from adamslite.progress.terminal import SentenceProgress, TalkingProgress

__all__ = [
    "AnalysisProgress",
    "Progress",
    "RunState",
    "RunsState",
    "SentenceProgress",
    "TalkingProgress",
    "progress_of",
]
