"""Exit codes, shared by all commands."""

DONE = 0
OUTSIDE_TOLERANCE = 1
USAGE = 2
DECK_ERRORS = 3
STOPPED_EARLY = 4
IO_FAILED = 5
BROKEN = 70  # EX_SOFTWARE of sysexits.h: a fault of the program itself
