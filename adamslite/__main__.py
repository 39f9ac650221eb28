"""`python -m adamslite` is the command `adamslite`."""

import sys

from adamslite.cli import main

if __name__ == "__main__":
    sys.exit(main())
