"""what is kept between runs

Shows the folder that holds compiled code and parser tables, how many entries it has and how large
they are; --clear removes them. ADAMSLITE_CACHE names another folder, ADAMSLITE_CACHE_SIZE how many
megabytes it may take (512); what has not been used for longest goes first.
"""

import argparse
import sys

from adamslite.cli.commands.codes import DONE

MEGABYTE = 1e6


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite cache`."""
    parser.add_argument("--clear", action="store_true", help="remove all entries")


def run(args: argparse.Namespace) -> int:
    """Show or clear; return the exit code."""
    from adamslite.caching import contents, entries
    from adamslite.caching.folder import cache_folder

    folder = cache_folder()
    found = contents.clear(folder) if args.clear else contents.entries(folder)
    size = f"{sum(entry.size for entry in found) / MEGABYTE:.1f} MB"
    if args.clear:
        noun = "entry" if len(found) == 1 else "entries"
        sys.stdout.write(f"removed {len(found)} {noun}, {size}, from {folder}\n")
        return DONE
    most = f"{entries.bound() / MEGABYTE:g} MB at most"
    sys.stdout.write(f"folder    {folder}\nentries   {len(found)}\nsize      {size} of {most}\n")
    return DONE
