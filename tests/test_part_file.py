"""The file of an unfinished run: what of it counts, whatever moment it was left at."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adamslite.analyses.dynamics.history import History, Piece
from adamslite.errors import FormatError, UsageError
from adamslite.outputs.part_file import FIRST, RECORDS, PartFile

ROWS = Piece(np.arange(5.0), ("PART/2.x", "PART/2.y"), np.arange(10.0).reshape(5, 2))


def written(path: Path, *states: int) -> PartFile:
    """A file with a state for each number, an array of it."""
    part = PartFile.create(path, {"number": -1})
    for number in states:
        part.commit(part.write_state({"number": number}, {"a": np.full(100, float(number))}))
    return part


def test_the_last_state_counts(tmp_path: Path) -> None:
    written(tmp_path / "x.part", 1, 2, 3).close()
    part = PartFile.open(tmp_path / "x.part")
    assert part.state["number"] == 3
    assert (part.arrays["a"] == 3.0).all() and part.arrays["a"].size == 100


def test_a_state_that_was_not_finished_does_not_count(tmp_path: Path) -> None:
    """The next state is written over the oldest, and the record that names it is not."""
    path = tmp_path / "x.part"
    part = written(path, 1, 2, 3, 4)
    part.write_state({"number": 5}, {"a": np.full(100, 5.0)})
    part.close()
    assert PartFile.open(path).state["number"] == 4


def test_a_record_that_was_not_finished_leaves_the_one_before(tmp_path: Path) -> None:
    path = tmp_path / "x.part"
    written(path, 1, 2, 3, 4).close()
    data = bytearray(path.read_bytes())
    for at in RECORDS:
        torn = data.copy()
        torn[at + 4] ^= 0xFF
        path.write_bytes(torn)
        part = PartFile.open(path)
        assert part.state["number"] in (3, 4)
        part.close()


def test_the_file_grows_with_rows_not_with_states(tmp_path: Path) -> None:
    path = tmp_path / "x.part"
    written(path, 1, 2, 3, 4, 5).close()
    few = path.stat().st_size
    written(path, *range(100)).close()
    assert path.stat().st_size <= few + FIRST


def test_rows_are_read_as_they_were_written(tmp_path: Path) -> None:
    part, history = written(tmp_path / "x.part"), History()
    history.extend(ROWS.until(3))
    history.file(part)
    history.extend(Piece(*[ROWS.times[3:], ROWS.names, ROWS.values[3:]]))
    assert len(history.stretches) == 1
    assert (history.whole.values == ROWS.values).all()
    blocks = [values for _, values in history.parts(2)]
    assert [len(each) for each in blocks] == [2, 2, 1]
    assert (np.concatenate(blocks) == ROWS.values).all()
    history.cut(2)
    assert history.count == 3 and (history.whole.times == ROWS.times[:3]).all()


def numbers(data: bytes, path: Path) -> int | None:
    """The state that counts in a file of these bytes; None where there is none."""
    path.write_bytes(data)
    try:
        part = PartFile.open(path)
    except FormatError:
        return None
    part.close()
    assert (part.arrays["a"] == float(part.state["number"])).all()
    return int(part.state["number"])


def test_a_file_that_ends_anywhere_has_one_of_its_states_or_none(tmp_path: Path) -> None:
    path = tmp_path / "x.part"
    written(path, *range(9)).close()
    data = path.read_bytes()
    found = {numbers(data[:end], path) for end in [*range(0, len(data), 7), len(data)]}
    assert found == {None, 7, 8}


def test_a_bit_that_is_turned_leaves_one_of_the_last_states_or_none(tmp_path: Path) -> None:
    path = tmp_path / "x.part"
    written(path, *range(9)).close()
    data, found = path.read_bytes(), set()
    for at in [*range(256), *range(FIRST, len(data), 41)]:
        for bit in (0, 7) if at >= FIRST else range(8):
            turned = bytearray(data)
            turned[at] ^= 1 << bit
            found.add(numbers(bytes(turned), path))
    assert found == {None, 7, 8}


def test_a_link_to_nothing_gives_way(tmp_path: Path) -> None:
    path = tmp_path / "x.part"
    path.symlink_to(tmp_path / "nothing")
    written(path, 1).close()
    assert PartFile.open(path).state["number"] == 1 and not path.is_symlink()
    assert (tmp_path / "x.part.old").is_symlink() and not (tmp_path / "nothing").exists()


def test_a_link_is_not_written_through(tmp_path: Path) -> None:
    path, other = tmp_path / "x.part", tmp_path / "other"
    other.write_bytes(b"of somebody else")
    path.symlink_to(other)
    written(path, 1).close()
    assert other.read_bytes() == b"of somebody else" and not path.is_symlink()


def test_rows_without_a_name_go_with_the_process(tmp_path: Path) -> None:
    part, history = PartFile.nameless(tmp_path), History()
    history.extend(ROWS)
    history.file(part)
    assert (history.whole.values == ROWS.values).all()
    part.remove()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("what", ["empty", "text", "cut", "flipped"])
def test_a_damaged_file_is_reported(tmp_path: Path, what: str) -> None:
    path = tmp_path / "x.part"
    written(path, 1, 2).close()
    data = bytearray(path.read_bytes())
    if what == "flipped":
        data[FIRST:] = bytes(each ^ 0xFF for each in data[FIRST:])
    changed = {"empty": b"", "text": b"time,x\n" * 1000, "cut": data[:FIRST], "flipped": data}
    path.write_bytes(changed[what])
    with pytest.raises(FormatError, match="is damaged"):
        PartFile.open(path)


def test_rows_that_were_changed_are_reported(tmp_path: Path) -> None:
    part, history = written(tmp_path / "x.part"), History()
    history.extend(ROWS)
    history.file(part)
    stretch = history.stretches[0]
    stretch.check()
    part._write(stretch.at, b"\1")
    with pytest.raises(FormatError, match="rows were changed"):
        stretch.check()


def test_a_file_that_is_written_is_not_taken(tmp_path: Path) -> None:
    path = tmp_path / "x.csv.part"
    part = written(path, 1)
    for take in (PartFile.open, lambda path: PartFile.create(path, {})):
        with pytest.raises(UsageError, match="another run is writing '.*x.csv'"):
            take(path)
    part.close()
    PartFile.open(path).close()


def test_what_was_left_behind_gets_the_name_of_an_older_one(tmp_path: Path) -> None:
    path = tmp_path / "x.csv.part"
    written(path, 7).close()
    written(path, 8).close()
    assert PartFile.open(path).state["number"] == 8
    assert PartFile.open(tmp_path / "x.csv.part.old").state["number"] == 7
    assert len(list(tmp_path.iterdir())) == 2
