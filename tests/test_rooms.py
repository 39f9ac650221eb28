"""The order of the stages: a module imports from its own room and from those below it."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

import adamslite

PACKAGE = Path(adamslite.__file__).parent

#: Rooms and single modules from the ground up. A room in the same line as another neither imports
#: it nor is imported by it.
FLOORS = """
notation resources gc_pause machine
errors
caching
native
native.translate symbolic
language
language.messages progress
syntax
deck
functions
elements.bases
elements
model
assembly
kernels.code
kernels
checks
reading
variation
cables
cables.description
cables.layout
cables.model
cables.statements
cables.deck
cables.trials cables.recognition
integrators.linalg
integrators
integrators.audit
integrators.events
integrators.stepping
integrators.implicit
integrators.bdf integrators.radau integrators.hht integrators.explicit integrators.verlet
integrators.methods
equations
results
outputs.adams
outputs
drawing
drawing.gltf
page
analyses.clock analyses.initial
analyses.linearization
analyses.setup
analyses.dynamics
analyses.statics
analyses.findings
analyses.session
analyses
run_flags
kept_scene
scene
command_files
result_files
sweeps
sensitivity
verification
fitting
plots
manual
editing
api
notebooks
cli.commands
cli
__main__
"""
FLOOR = {room: number for number, line in enumerate(FLOORS.split("\n")) for room in line.split()}
MODULES = sorted(
    ".".join(file.relative_to(PACKAGE).with_suffix("").parts)
    for file in PACKAGE.rglob("*.py")
    if file != PACKAGE / "__init__.py" and "decks" not in file.parts
)
ON_THE_GROUND = 12


def room_of(module: str) -> str:
    """The room of a module: its folder, or itself where it lies directly in the package."""
    parts = module.split(".")
    return ".".join(parts[:-1]) if len(parts) > 1 else module


def is_room(name: str) -> bool:
    return (PACKAGE.joinpath(*name.split(".")) / "__init__.py").is_file()


def is_module(name: str) -> bool:
    return PACKAGE.joinpath(*name.split(".")).with_suffix(".py").is_file() or is_room(name)


@cache
def imported(module: str) -> set[str]:
    """Modules of the package that a module imports, anywhere in its text."""
    file = PACKAGE.joinpath(*module.split(".")).with_suffix(".py")
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("adamslite."):
            base = node.module.removeprefix("adamslite.")
            names = {f"{base}.{each.name}" for each in node.names}
            found |= {name if is_module(name) else base for name in names}
        elif isinstance(node, ast.ImportFrom) and node.module == "adamslite":
            found |= {each.name for each in node.names if is_module(each.name)}
    return {
        f"{name}.__init__"
        if (PACKAGE.joinpath(*name.split(".")) / "__init__.py").is_file()
        else name
        for name in found
    }


def test_no_import_goes_up_or_across() -> None:
    """Rooms below, and the own one, are all that a module may know."""
    for module in MODULES:
        room = room_of(module)
        for name in imported(module):
            other = room_of(name)
            assert other == room or FLOOR[other] < FLOOR[room], f"{module} imports {name}"


def test_modules_of_a_room_do_not_import_each_other_in_a_circle() -> None:
    left = {module: imported(module) for module in MODULES}
    while left:
        ready = [
            module
            for module, names in left.items()
            if not any(room_of(name) == room_of(module) for name in names & left.keys() - {module})
        ]
        assert ready, f"a circle among {', '.join(left)}"
        for module in ready:
            del left[module]


def test_every_room_has_a_floor_and_every_floor_a_room() -> None:
    assert {room_of(module) for module in MODULES} == set(FLOOR)


def test_few_modules_lie_directly_in_the_package() -> None:
    assert len([*PACKAGE.glob("*.py")]) <= ON_THE_GROUND


@pytest.mark.parametrize("room", [room for room in FLOOR if not (PACKAGE / f"{room}.py").is_file()])
def test_every_room_says_what_it_holds(room: str) -> None:
    start = PACKAGE.joinpath(*room.split(".")) / "__init__.py"
    assert ast.get_docstring(ast.parse(start.read_text(encoding="utf-8")))


def test_a_room_names_the_rooms_within_it() -> None:
    """Its docstring is their table of contents."""
    for room in FLOOR:
        start = PACKAGE.joinpath(*room.split(".")) / "__init__.py"
        within = [name.rpartition(".")[2] for name in FLOOR if name.rpartition(".")[0] == room]
        if within:
            said = ast.get_docstring(ast.parse(start.read_text(encoding="utf-8"))) or ""
            missing = [name for name in within if not re.search(rf"\b{name}\b", said)]
            assert not missing, f"{room}/__init__.py does not name {', '.join(missing)}"


def test_the_map_of_the_folders_is_true() -> None:
    """The table of docs/contributing.md has every folder, in the order of the floors."""
    page = (PACKAGE.parent / "docs" / "contributing.md").read_text(encoding="utf-8")
    table = page[page.index("| folder | stage |") :].split("\n\n")[0]
    folders = [room.split(".")[0] for room in FLOOR if (PACKAGE / room.split(".")[0]).is_dir()]
    assert re.findall(r"^\| `(\w+)` \|", table, re.M) == list(dict.fromkeys(folders))
