"""`python -m adamslite` is the command `adamslite`; its script calls the same function."""

import sys
from signal import SIG_DFL, SIGINT, default_int_handler, getsignal, signal

#: Whether Ctrl-C reaches this process; a shell may have chosen that it does not.
REACHED = getsignal(SIGINT) is default_int_handler
if REACHED:  # while modules are imported nothing is lost: the process ends at once, without a trace
    signal(SIGINT, SIG_DFL)


def main() -> int:
    """Run the command line of the process and return the exit code."""
    from adamslite.cli.main import interrupted
    from adamslite.cli.main import main as run_command

    try:
        if REACHED:
            signal(SIGINT, default_int_handler)
        return run_command()
    except KeyboardInterrupt:
        return interrupted()
    finally:
        if REACHED:
            signal(SIGINT, SIG_DFL)


if __name__ == "__main__":
    sys.exit(main())
