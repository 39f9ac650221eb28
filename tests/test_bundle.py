"""The page's program is what its sources make."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import adamslite

PAGE = Path(adamslite.__file__).parent / "page"
MADE = ("bundle.js", "licenses.txt")


def test_the_bundle_was_built_from_these_sources() -> None:
    """`npm run build` in adamslite/page writes the sum of the sources into the bundle."""
    sources = [*sorted((PAGE / "src").iterdir()), PAGE / "package-lock.json", PAGE / "build.mjs"]
    total = hashlib.sha256()
    for source in sources:
        total.update(source.read_text(encoding="utf-8").encode())
    said = re.search(r"SHA-256 of the sources: (\w+)", (PAGE / "bundle.js").read_text()[:200])
    assert said and said[1] == total.hexdigest(), "run npm run build in adamslite/page"


def test_the_lock_file_names_no_registry_and_every_licence_is_kept() -> None:
    lock = (PAGE / "package-lock.json").read_text(encoding="utf-8")
    assert "http" not in lock
    used = json.loads((PAGE / "package.json").read_text(encoding="utf-8"))["dependencies"]
    licences = (PAGE / "licenses.txt").read_text(encoding="utf-8")
    assert all(f"{name} {version}\n" in licences for name, version in used.items())


@pytest.mark.slow
def test_building_again_gives_the_same_bundle(tmp_path: Path) -> None:
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("there is no npm")
    copy = tmp_path / "page"
    shutil.copytree(PAGE, copy, ignore=shutil.ignore_patterns("node_modules", *MADE))
    install = [npm, "ci", "--no-audit", "--no-fund", "--prefer-offline"]
    if subprocess.run(install, cwd=copy, capture_output=True, check=False).returncode:
        pytest.skip("npm does not reach its registry")
    subprocess.run([npm, "run", "build"], cwd=copy, capture_output=True, check=True)
    for name in MADE:
        assert (copy / name).read_bytes() == (PAGE / name).read_bytes(), name


@pytest.mark.parametrize("source", sorted((PAGE / "src").iterdir()), ids=lambda path: path.name)
def test_sources_are_short_and_have_a_head(source: Path) -> None:
    lines = source.read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("// ")
    assert len(lines) <= 400
