"""Hostile command files, descriptions and files of results: one thing again and again, in any size.

They are read by the way that their kind names, whatever their texts in decks would be.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from io import BytesIO
from typing import NamedTuple

import numpy as np

SPACE = 'xmlns="http://www.mscsoftware.com/:xrf10"'
CABLE = "# a cable\n"


class File(NamedTuple):
    """How it is read, the suffix of its name, and its bytes in about a size."""

    way: str
    suffix: str
    data: Callable[[int], bytes]


def again(
    piece: str | Callable[[int], str], head: str = "", tail: str = ""
) -> Callable[[int], bytes]:
    """A text of one piece, or of one that depends on its number."""

    def data(size: int) -> bytes:
        if isinstance(piece, str):
            return (head + piece * (size // len(piece)) + tail).encode()
        pieces, length = [head], 0
        while length < size:
            pieces.append(piece(len(pieces)))
            length += len(pieces[-1])
        return "".join([*pieces, tail]).encode()

    return data


def _commands(piece: str | Callable[[int], str], head: str = "hostile\n") -> File:
    return File("commands", ".acf", again(piece, head))


def _toml(piece: str | Callable[[int], str], head: str = CABLE, tail: str = "\n") -> File:
    return File("cable", ".toml", again(piece, head, tail))


def _csv(piece: str | Callable[[int], str], head: str = "time,x\n") -> File:
    return File("results", ".csv", again(piece, head))


def _req(piece: str | Callable[[int], str], head: str) -> File:
    return File("results", ".req", again(piece, head))


def _req_head(count: int) -> str:
    """The first lines of a request file with so many REQUESTs."""
    first = " REQF    01/01/2001 00:00:00               0         0  3D"
    return f"{first}\nhostile\n{count:5d}     MMKGS_N_RACA 1.0\n"


def _res(
    piece: str | Callable[[int], str], head: str = f"<Results {SPACE}>", tail: str = ""
) -> File:
    return File("results", ".res", again(piece, head, tail))


def _netcdf(size: int, columns: int) -> bytes:
    """NetCDF-3 with so many columns, each of them a variable."""
    from scipy.io import netcdf_file

    memory = BytesIO()
    with netcdf_file(memory, "w") as file:
        rows = max(1, size // (8 * columns + 80 * columns))
        file.createDimension("time", rows)
        for name in ("time", *(f"v{n}" for n in range(columns))):
            file.createVariable(name, "d", ("time",))[:] = np.arange(rows)
        file.flush()
        return memory.getvalue()


def _matlab(size: int, columns: int) -> bytes:
    """Level 5 of MATLAB with so many variables."""
    from scipy.io import savemat

    memory = BytesIO()
    rows = max(1, size // (8 * columns + 56 * columns))
    savemat(memory, {f"v{n}": np.arange(rows, dtype=float) for n in range(columns)})
    return memory.getvalue()


def _parquet(size: int) -> bytes:
    """A table of many columns."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    memory = BytesIO()
    columns = size // 500
    pq.write_table(
        pa.table({n: [0.0] for n in ("time", *(f"v{k}" for k in range(columns)))}), memory
    )
    return memory.getvalue()


MATLAB = b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM"
FILES: dict[str, File] = {
    "acf: changes, each before a run": _commands(
        lambda n: f"MARKER/2, QP={n},0,0\nSIMULATE/DYNAMIC, END={n}, STEPS=1\n"
    ),
    "acf: changes": _commands(lambda n: f"MARKER/2, QP={n},0,0\n"),
    "acf: runs": _commands(lambda n: f"SIMULATE/DYNAMIC, END={n}, STEPS=1\n"),
    "acf: switched elements": _commands("DEACTIVATE/SFORCE, ID=1\nACTIVATE/SFORCE, ID=1\n"),
    "acf: continued": _commands(", &\n", head="hostile\nMARKER/2, QP=1"),
    "acf: words": _commands("LIST/ALL\n"),
    "toml: tables": _toml(lambda n: f"[t{n}]\n"),
    "toml: tables in tables": _toml(lambda n: f"[a.b{n}.c]\n"),
    "toml: tables of a list": _toml("[[cable]]\n"),
    "toml: cables": _toml(lambda n: f'[[cable]]\nname="c{n}"\nlength=1\n'),
    "toml: keys": _toml(lambda n: f"k{n} = 1\n"),
    "toml: keys with dots": _toml(lambda n: f"a{n}.b.c = 1\n"),
    "toml: a key of many dots": _toml("a.", tail="a = 1\n"),
    "toml: a list of numbers": _toml("1, ", head="length = [", tail="]\n"),
    "toml: lists in lists": _toml("[", head="length = "),
    "toml: tables in a line": _toml("{a=", head="length = "),
    "toml: a number of many digits": _toml("9", head="length = "),
    "toml: a text of many letters": _toml("a", head='name = "', tail='"\n'),
    "toml: escapes": _toml("\\n", head='name = "', tail='"\n'),
    "toml: a text that does not end": _toml("a\n", head='name = """'),
    "toml: comments": _toml("# a comment\n"),
    "toml: what is no TOML": _toml("MARKER/3, PART=2\n"),
    "csv: rows": _csv(lambda n: f"{n},1\n"),
    "csv: one row": _csv("1,"),
    "csv: columns": _csv(lambda n: f",v{n}", head="time"),
    "csv: columns of one name": _csv(",v", head="time"),
    "csv: words": _csv("a,b\n"),
    "csv: quotes": _csv('"'),
    "csv: quotes in the header": _csv('"', head="time,"),
    "csv: comments": _csv("# a: b\n", head=""),
    "csv: units": _csv(lambda n: f",v{n} [m]", head="time"),
    "csv: blank lines": _csv("\n"),
    "csv: a number of many digits": _csv("9", head="time,x\n1,"),
    "req: entries": _req(lambda n: f"{n:8d}       1       0       0       0\n", _req_head(20_000)),
    "req: numbers": _req("  1.00000E+00", _req_head(0)),
    "req: words": _req("a ", _req_head(0)),
    "res: elements": _res("<a/>"),
    "res: elements in elements": _res("<a>"),
    "res: comments": _res("<!-- adamslite texts of the run: eJwDAAAAAAE= -->"),
    "res: text": _res("a "),
    "res: attributes": _res(lambda n: f' a{n}="1"', head=f"<Results {SPACE}", tail="/>"),
    "res: steps": _res(
        lambda n: f'<Step type="dynamic">{n} 1</Step>\n',
        head=f'<Results {SPACE}><Analysis name="a"><StepMap name="m"><Entity name="E" entity="T">'
        '<Component name="TIME" unitsValue="sec" id="1"/></Entity></StepMap><Data>',
        tail="</Data></Analysis></Results>",
    ),
    "res: components": _res(
        lambda n: f'<Component name="x{n}" unitsValue="mm" id="{n}"/>',
        head=f'<Results {SPACE}><Analysis name="a"><StepMap name="m"><Entity name="E" entity="T">',
        tail="</Entity></StepMap></Analysis></Results>",
    ),
    "res: entities": _res(
        lambda n: f'<Entity name="e{n}" entity="T"/>',
        head=f'<Results {SPACE}><Analysis name="a"><StepMap name="m">',
        tail="</StepMap></Analysis></Results>",
    ),
    "res: old blocks": _res("A  1 2 3\n", head="A/VIEW results\n"),
    "nc: columns": File("results", ".nc", lambda size: _netcdf(size, size // 200)),
    "nc: rows": File("results", ".nc", lambda size: _netcdf(size, 2)),
    "nc: zeros": File("results", ".nc", lambda size: b"CDF\1" + b"\0" * size),
    "nc: counts that are too large": File(
        "results", ".nc",
        lambda size: b"CDF\1" + struct.pack(">5i", 7, 10, 2**31 - 1, 0, 0) + b"\7" * size,
    ),
    "mat: variables": File("results", ".mat", lambda size: _matlab(size, size // 200)),
    "mat: numbers": File("results", ".mat", lambda size: _matlab(size, 1)),
    "mat: zeros": File("results", ".mat", lambda size: MATLAB + b"\0" * size),
    "parquet: columns": File("results", ".parquet", _parquet),
    "parquet: zeros": File("results", ".parquet", lambda size: b"PAR1" + b"\0" * size + b"PAR1"),
}  # fmt: skip
"""By the name of their kind."""
