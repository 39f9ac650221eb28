"""What pyproject.toml says of the package."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]


def test_the_licence_is_named_and_included() -> None:
    assert PROJECT["license"] == "MIT"
    for name in PROJECT["license-files"]:
        assert PROJECT["authors"][0]["name"] in (ROOT / name).read_text(encoding="utf-8")


def test_every_library_has_a_lower_bound_and_no_other() -> None:
    """Benchmarks compare with other programs of any version."""
    named = [*PROJECT["dependencies"], *(e for x in EXTRAS.keys() - {"bench"} for e in EXTRAS[x])]
    assert [each for each in named if not re.fullmatch(r"[a-z][\w-]*>=\d[\d.]*", each)] == []


def test_a_library_has_one_bound() -> None:
    named = {each for extra in EXTRAS.values() for each in extra if ">=" in each}
    assert len({each.partition(">=")[0] for each in named}) == len(named)


def test_the_oldest_python_is_a_classifier() -> None:
    oldest = PROJECT["requires-python"].removeprefix(">=")
    assert f"Programming Language :: Python :: {oldest}" in PROJECT["classifiers"]


def test_all_tests_with_the_oldest_libraries_are_there() -> None:
    script = (ROOT / ".ci" / "oldest").read_text(encoding="utf-8")
    names = ",".join(re.findall(r"test_\{([\w,]+)\}\.py", script)).split(",")
    missing = [n for n in names if not (ROOT / "tests" / f"test_{n}.py").is_file()]
    assert names != [""] and missing == []
