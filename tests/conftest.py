"""What all tests share: two tiers, one folder of compiled code, so that a shape is compiled only
once, and the closed forms and decks of cables, which are modules in decks/cables.

Tests marked `slow` are left out unless they are asked for (``-m ""``, ``-m slow``, or by name); the
others are the fast tier, in which no test may need more than ``MOST`` seconds of CPU.  Tests marked
`numerical` may depend on how a processor rounds, and are run for several; the others read, check,
write texts, and end processes.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, settings

from adamslite.caching import entries, folder
from adamslite.resources import find

if TYPE_CHECKING:
    from fakes import Pipeline

sys.path.append(str(find("decks") / "cables"))
# Tests run side by side, one on a processor; numpy reads this when it is first imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Elapsed time is not compared with anything: a machine may be busy.
settings.register_profile("busy", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("busy")

#: Modules of tests in which no number is computed that a processor could round otherwise.
TEXTUAL = {
    "test_accuracy_notes", "test_browser", "test_browser_plots", "test_bundle",
    "test_cable_messages", "test_chart", "test_commands", "test_compare",
    "test_deck", "test_fuzz",
    "test_lexical", "test_manual", "test_messages", "test_pages", "test_reference",
    "test_results", "test_statement", "test_style", "test_graph_to_llvm", "test_sweep_cluster",
}  # fmt: skip


#: CPU that a test of the fast tier may need, from an empty cache and without the engine, which is
#: compiled once for all [s], on a processor that sums a million squares in ``SQUARES`` [s].
MOST, SQUARES = 5.0, 0.038


def _nothing(number: int, frame: object) -> None:
    """Takes a signal."""


def pytest_configure(config: pytest.Config) -> None:
    """A test that is named is run in whatever tier it is."""
    if config.option.markexpr == "not slow" and all("::" in name for name in config.args):
        config.option.markexpr = ""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # as nohup has it: tests press Ctrl-C
        signal.signal(signal.SIGINT, signal.default_int_handler)
    hung_up = getattr(signal, "SIGHUP", None)
    if hung_up and signal.getsignal(hung_up) is signal.SIG_IGN:  # so that programs do not inherit
        signal.signal(hung_up, _nothing)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """One file is run in this process: starting others takes longer than most files do."""
    alone = len(config.args) == 1 and config.args[0].partition("::")[0].endswith(".py")
    return 0 if alone else None


class Engine:
    """CPU that compiling the engine has taken in this process [s]."""

    spent = 0.0


def cpu() -> float:
    """CPU of this process and of those it has waited for, without compiling the engine [s]."""
    return sum(os.times()[:4]) - Engine.spent


def slowness() -> float:
    """How much slower than that processor this one is now, at least 1."""
    taken = []
    for _ in range(5):
        start = time.process_time()
        sum(k * k for k in range(1_000_000))
        taken.append(time.process_time() - start)
    return max(1.0, median(taken) / SQUARES)


STARTED = pytest.StashKey[float]()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Note when a test starts."""
    item.stash[STARTED] = cpu()


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """Judge what a test has used since its set-up began."""
    result = yield
    judge(item, cpu() - item.stash[STARTED])
    return result


def judge(item: pytest.Item, used: float) -> None:
    """Fail a test of the fast tier that is not fast, on a processor that is."""
    if item.get_closest_marker("slow") or used <= MOST:
        return
    if used > MOST * slowness():
        pytest.fail(
            f"{used:.1f} s of CPU, more than {MOST:g} s: mark it with @pytest.mark.slow", False
        )


@pytest.fixture(scope="session", autouse=True)
def engine_apart() -> Iterator[None]:
    """Compiling the engine is not counted as CPU of the test that is the first to use it."""
    from adamslite.equations import engine

    build = engine._build

    def counted(name: str, progress: object) -> object:
        start = cpu()
        built = build(name, progress)
        Engine.spent += cpu() - start
        return built

    engine._build = counted
    yield
    engine._build = build


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests that are run for several processors."""
    for item in items:
        if item.path.stem not in TEXTUAL:
            item.add_marker("numerical")


@pytest.fixture(scope="session", autouse=True)
def compiled_code(
    pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Path]:
    """The cache folder of the tests; the user's own is neither read nor written.

    It is kept between runs. Workers of one session share it: an entry is written whole and then
    renamed.
    """
    given = os.environ.get("ADAMSLITE_CACHE")
    folder = Path(given) if given else _own_folder(pytestconfig, tmp_path_factory)
    os.environ["ADAMSLITE_CACHE"] = str(folder)
    yield folder
    if given is None:
        del os.environ["ADAMSLITE_CACHE"]


def _own_folder(config: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Path:
    try:
        folder = config.cache.mkdir("compiled")
        folder.chmod(0o700)
    except (AttributeError, OSError):  # pytest keeps nothing, or must not write here
        base = tmp_path_factory.getbasetemp()
        folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "compiled"
        folder.mkdir(mode=0o700, exist_ok=True)
    return folder


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """An installed browser. Not for longer: it has a loop of asyncio, which others start too."""
    from browsing import started

    with started() as found:
        yield found


@pytest.fixture
def show(browser: Any, tmp_path: Path) -> Any:
    """Opens a page in it."""
    from browsing import opened

    return partial(opened, browser, folder=tmp_path)


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty cache folder for one test."""
    chosen = tmp_path / "cache"
    chosen.mkdir(mode=0o700)
    monkeypatch.setenv("ADAMSLITE_CACHE", str(chosen))
    folder._settled.cache_clear()
    folder._private.cache_clear()
    entries._totals.clear()
    yield chosen.resolve()
    folder._settled.cache_clear()
    folder._private.cache_clear()


@pytest.fixture
def pipeline(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Pipeline:
    """An empty folder with cable.adm as current directory, and a pipeline that solves nothing."""
    import fakes

    monkeypatch.chdir(tmp_path)
    Path("cable.adm").write_text("a cable\nEND\n")
    parts = (fakes.Named("PART"), fakes.Named("PART"))
    fake = fakes.Pipeline(statements=(*parts, fakes.SIMULATE))
    fakes.install(monkeypatch, fake)
    return fake
