"""The command `adamslite`.

    adamslite check  DECK                   what is wrong with a deck, and what it contains
    adamslite solve  DECK [COMMANDS.acf]    run it and write the results
    adamslite view   DECK|RESULT            write a page that shows how it moves, and open it
    adamslite plot   RESULT [CHANNEL ...]   draw channels of results, or the runs of a sweep
    adamslite diff   A B                    compare two result files
    adamslite verify [DIR|DECK ...]         run reference decks and compare
    adamslite linear DECK [COMMANDS.acf]    eigenvalues and modes of small motions
    adamslite names  DECK [PATTERN ...]     numbers of a deck by name, for --set
    adamslite sweep  DECK NAME=VALUES ...   run it many times with other numbers
    adamslite indices RUNS [MEASURE ...]    Sobol indices of a sweep
    adamslite sens   DECK --of MEASURE --by NAME  derivatives of a run by numbers of its deck
    adamslite fit    DECK MEASURED --by NAME ...  fit numbers of a deck to a measurement
    adamslite chart  DECK [COMMANDS.acf]    what accuracy costs with each integrator
    adamslite cable  SPEC.toml              write the deck of a cable scene from a short description
    adamslite cache  [--clear]              what is kept between runs
    adamslite fmt    FILE ...               put decks and command files into the canonical layout
    adamslite lsp                           serve editors (Language Server Protocol)
    adamslite editors DIR                   write colours, snippets and a folder for VS Code
    adamslite help   [NAME]                 print the page of a statement, a function, ...

Exit codes: 0 done or equal, 1 outside tolerance or not in the canonical layout, 2 usage,
3 the deck has errors, 4 the solver stopped early (results so far are written), 5 reading or
writing failed, 70 a fault of the program itself.

Only argparse and its like are imported here: everything else, the other commands too, waits until
a command needs it.
"""

import argparse
import atexit
import gc
import os
import sys
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from errno import ENOMEM
from importlib import import_module
from io import BufferedWriter, FileIO, TextIOWrapper
from typing import Any, NoReturn

from adamslite import __version__
from adamslite.cli.commands.codes import BROKEN, DECK_ERRORS, DONE, IO_FAILED, STOPPED_EARLY, USAGE
from adamslite.notation import COMMAND_LINE, notation

#: The first line of the docstring of each command: only the one that is called is imported.
COMMANDS = {
    "check": "what is wrong with a deck, and what it contains",
    "solve": "run a deck and write the results",
    "view": "write a page that shows how it moves, and open it in the browser",
    "plot": "plot channels of results, or the runs of a sweep",
    "diff": "compare two result files",
    "verify": "run reference decks and compare",
    "linear": "eigenvalues and modes of small motions",
    "chart": "what accuracy costs with each integrator",
    "cable": "write the deck of a cable scene from a short description",
    "cache": "what is kept between runs",
    "names": "numbers of a deck by name, with their values and places",
    "sweep": "run a deck many times with other numbers",
    "indices": "Sobol indices of a sweep: which number is behind the variance of a measure",
    "sens": "derivatives of a run by numbers of its deck",
    "fit": "fit numbers of a deck to a measurement",
    "fmt": "put decks and command files into the canonical layout",
    "lsp": (
        "serve editors: messages while typing, pages, completion, renaming (Language Server "
        "Protocol)"
    ),
    "editors": "write what editors need: colours, snippets, a folder for VS Code",
    "help": "print the page of a name",
}
EXIT_CODES = """exit codes:
  0 done, or equal        1 outside tolerance, or not in the canonical layout
  2 usage                 3 the deck has errors
  4 solver stopped early, results so far are written
  5 reading or writing failed"""

#: How many threads linear algebra takes: variables of the libraries that numpy is built with,
#: and one that other programs follow, too.
THREADS = (
    "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "VECLIB_MAXIMUM_THREADS",
)  # fmt: skip
ALL_THREADS = "OMP_NUM_THREADS"


class Parser(argparse.ArgumentParser):
    """Says what is wrong with a word without giving the terminal its commands."""

    def error(self, message: str) -> NoReturn:
        """Print usage and message; end the process."""
        from adamslite.notation import visible

        super().error(visible(message))


class Shown:
    """A stream that shows control characters; ``obeyed`` is the same stream for those by which this
    program itself draws.
    """

    def __init__(self, stream: TextIOWrapper) -> None:
        from adamslite.notation import visible

        self.obeyed, self._visible = stream, visible

    def __getattr__(self, name: str) -> Any:
        return getattr(self.obeyed, name)

    def write(self, text: str) -> int:
        return self.obeyed.write(self._visible(text))

    def writelines(self, lines: Iterable[str]) -> None:
        self.obeyed.writelines(map(self._visible, lines))


#: Objects that are made before those are looked for that nothing refers to: a run makes few such,
#: and what a large deck is made of would be looked through again and again.
GARBAGE = 1_000_000

NOT_PIPED = "; here that is no standard input, as a deck or a description of a cable may be"
NO_MEMORY = "there is not enough memory for that; no file was changed"
REPORT = (
    "adamslite: a fault in the program, not in your deck: {fault}\n"
    "Please report it with the deck and the output of the same command with --debug."
)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line `argv` (default: of the process) and return the exit code."""
    own, argv = argv is None, sys.argv[1:] if argv is None else argv
    if own:
        _open_streams()
        _write_every_letter()
        _take_one_thread()
        _close_folder()
        gc.set_threshold(GARBAGE)
    with notation(COMMAND_LINE):
        code = _run(argv, own)
    if own:
        code = _end_output(code)
        leave(code)
        gc.freeze()  # nothing is looked through while the process ends
    return code


OUTPUT = "standard output"


class _Output(FileIO):
    """Standard output: a fault of the system names it."""

    def write(self, data: Any) -> int:
        """Write what can be written."""
        try:
            return super().write(data) or 0
        except OSError as fault:
            fault.filename = OUTPUT
            raise


class _Messages(FileIO):
    """Standard error: a reader that has gone, or a disk that is full, ends no run."""

    def write(self, data: Any) -> int:
        """Write what can be written; the rest is lost."""
        try:
            return super().write(data) or 0
        except OSError:
            return len(data)


def _open_streams() -> None:
    """Let standard streams fail in a sentence, and those that were closed be there: a file opened
    later would take their numbers, and get what is written to them.
    """
    if os.name != "posix":  # the console of Windows has a class of its own
        return
    # Writing to a closed standard output is reported; a closed standard error leaves no way to.
    for number, mode in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, mode)  # takes the first number that is free
    if sys.stdout is None or isinstance(sys.stdout, TextIOWrapper):
        sys.stdout = _stream(_Output(1, "w", closefd=False), sys.stdout, os.isatty(1))
    if sys.stderr is None or isinstance(sys.stderr, TextIOWrapper):
        sys.stderr = _stream(_Messages(2, "w", closefd=False), sys.stderr, True)


def _stream(raw: FileIO, old: Any, by_line: bool) -> TextIOWrapper:
    """A stream of text in the encoding of the old one, if there was one, whose text comes first."""
    with suppress(OSError, ValueError):
        if old:
            old.flush()
    encoding = old.encoding if old else "utf-8"
    return TextIOWrapper(BufferedWriter(raw), encoding, line_buffering=by_line)


def _end_output(code: int) -> int:
    """Write what waits, so that a fault is noticed here and not while the process ends."""
    try:
        if sys.stdout is not None and not sys.stdout.closed:  # by a server that has served
            sys.stdout.flush()
        return code
    except OSError as fault:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        if code == DONE and not isinstance(fault, BrokenPipeError):
            _explain(fault)
        return code or IO_FAILED


def leave(code: int) -> None:
    """End the process where it cannot be taken down: where a call still works that nobody waits
    for, in libraries, and where an interruption may have met one that was being loaded.
    """
    worker = sys.modules.get("adamslite.native.worker")
    if _cut_short or (worker is not None and worker.left_working()):
        atexit._run_exitfuncs()  # temporary folders
        with suppress(OSError):
            sys.stderr.flush()
        os._exit(code)


def _write_every_letter() -> None:
    """Let standard output be UTF-8, as all files of the program are, where it goes to a file or to
    another program, unless the user has chosen an encoding.  Letters that a stream lacks are
    written as their numbers, names of files that are no text byte by byte.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            chosen = stream.isatty() or "PYTHONIOENCODING" in os.environ
            encoding = stream.encoding if chosen else "utf-8"
            complete = encoding.lower().replace("_", "-") in ("utf-8", "utf8")
            as_bytes = complete and not stream.isatty()  # which may take them for commands
            errors = "surrogateescape" if as_bytes else "backslashreplace"
            stream.reconfigure(encoding=encoding, errors=errors)


def _show_controls() -> None:
    """From here on both streams show control characters, which decks and files of results may hold,
    instead of passing them to a terminal.
    """
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if isinstance(stream, TextIOWrapper):
            setattr(sys, name, Shown(stream))


def _close_folder() -> None:
    """Let processes of workers find modules where this one does, and not in the current folder,
    which may have come with a deck.
    """
    os.environ["PYTHONSAFEPATH"] = "1"


def _take_one_thread() -> None:
    """Let linear algebra use one thread, unless the user has said how many.

    A run computes in a thread of its own; those of the library would only wait for work, and
    waiting takes as much CPU.  A process that imports the package keeps its own setting.
    """
    if not any(name in os.environ for name in (*THREADS, ALL_THREADS)):
        os.environ.update(dict.fromkeys(THREADS, "1"))


def _run(argv: Sequence[str], own: bool) -> int:
    word = next((word for word in argv if not word.startswith("-")), "")
    try:
        args = _with_commands([word] if word in COMMANDS else [])[0].parse_args(argv)
    except SystemExit as leaving:
        return int(leaving.code or DONE)
    except KeyboardInterrupt:
        return interrupted()
    if own:
        _show_controls()
    if getattr(args, "allow_path", None):
        from adamslite.language.file_name import open_folders

        open_folders(args.allow_path)
    if args.debug:
        return args.run(args)
    try:
        with _kept_modules(word) if own else nullcontext():
            return int(args.run(args))
    except BrokenPipeError:
        return IO_FAILED
    except KeyboardInterrupt:
        return interrupted()
    except Exception as fault:
        return interrupted() if _is_interruption(fault) else _explain(fault)


def _is_interruption(fault: BaseException | None) -> bool:
    """Whether a fault was made of Ctrl-C, by what was being imported or made then."""
    while fault is not None:
        if isinstance(fault, KeyboardInterrupt):
            return True
        fault = fault.__cause__ or fault.__context__
    return False


#: Whether Ctrl-C has ended the command, wherever it was.
_cut_short = False


def interrupted() -> int:
    """Report that Ctrl-C has ended a command; return the exit code."""
    global _cut_short
    _cut_short = True
    _tell("adamslite: interrupted")
    return STOPPED_EARLY


def _kept_modules(command: str) -> AbstractContextManager[None]:
    from adamslite.caching.modules import kept_modules

    return kept_modules(command)


def command_parsers() -> Mapping[str, Parser]:
    """The parser of each command, by its name."""
    return dict(_with_commands(COMMANDS)[1])


def _with_commands(called: Collection[str]) -> tuple[Parser, Mapping[str, Parser]]:
    """The parser of the program, and those of the commands that are called; without any, it lists
    all of them.
    """
    parser = Parser(
        prog="adamslite",
        description="Solve ADAMS/Solver-like decks of cables, pulleys and mechanisms.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"adamslite {__version__}")
    shared = Parser(add_help=False)
    shared.add_argument(
        "--debug", action="store_true", help="show the traceback of a program fault"
    )
    # With a name of its own argparse does not look for the width of the terminal.
    commands = parser.add_subparsers(prog="adamslite", metavar="COMMAND", required=True)
    for name in called:
        module = import_module(f"adamslite.cli.commands.{name}")
        command = commands.add_parser(
            name,
            parents=[shared],
            help=COMMANDS[name],
            description=module.__doc__,
            epilog=EXIT_CODES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(command)
        command.set_defaults(run=module.run)
    if not called:
        for name, summary in COMMANDS.items():
            commands.add_parser(name, help=summary)
    parser.set_defaults(parsers=command_parsers)
    return parser, commands.choices


def _explain(fault: Exception) -> int:
    """Tell the user what went wrong, in sentences, and return the exit code for it."""
    from adamslite.errors import FormatError, RunFailed, UsageError
    from adamslite.language.diagnostics import DeckError

    if isinstance(fault, DeckError):
        _tell(str(fault))
        return DECK_ERRORS
    if isinstance(fault, UsageError):
        _tell(f"adamslite: {fault}")
        return USAGE
    if isinstance(fault, RunFailed):
        _tell(f"adamslite: {fault}")
        return STOPPED_EARLY
    if _is_of_memory(fault):
        _tell(f"adamslite: {NO_MEMORY}")
        return STOPPED_EARLY
    if isinstance(fault, FormatError):
        _tell(f"adamslite: {fault}")
        return IO_FAILED
    if isinstance(fault, OSError):
        name = fault.filename if fault.filename == OUTPUT else f"'{fault.filename}'"
        where = f"{name}: " if fault.filename else ""
        piped = NOT_PIPED if str(fault.filename) == "-" else ""
        _tell(f"adamslite: {where}{fault.strerror or fault}{piped}")
        return IO_FAILED
    cause = " ".join(f"{type(fault).__name__}: {fault}".split())
    _tell(REPORT.format(fault=cause))
    return BROKEN


def _is_of_memory(fault: Exception) -> bool:
    """Whether there was no memory: for an object, for the system, for a library to be loaded."""
    unloaded = isinstance(fault, ImportError) and "failed to map segment" in str(fault)
    return unloaded or isinstance(fault, MemoryError) or getattr(fault, "errno", None) == ENOMEM


def _tell(text: str) -> None:
    sys.stderr.write(text + "\n")
