"""`python -m adamslite` is the command `adamslite`."""

import sys

from adamslite.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
