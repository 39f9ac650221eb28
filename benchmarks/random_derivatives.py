"""Derivatives of random runs by random numbers: how often the estimated error contains the truth.

`python -m benchmarks.random_derivatives [--count N] [--seed S] [--kinds KIND ...]` draws decks of
five kinds (a switching time, an impact, two events at a time, friction that sticks again, smooth
motion), takes derivatives of a place and a velocity at the end by one number each, forwards by
GSTIFF and RADAU and by the adjoint of both, at ERROR 1e-3, 1e-6 and 1e-9, and compares them with
central differences of runs by RADAU at ERROR 1e-12 with three steps, which must agree.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import adamslite as al
from adamslite.errors import RunFailed

Random = np.random.Generator
HEAD = "random\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\n"
AXES = "MARKER/8, PART=1, REULER=90D,90D,0\nMARKER/9, PART=1\n"
TIGHT, STEPS, AGREE, NOISE = 1e-12, (1e-5, 3e-5, 1e-4), 3e-3, 2e-7
ERRORS, METHODS = (1e-3, 1e-6, 1e-9), ("GSTIFF", "RADAU")


@dataclass
class Case:
    """A deck, the body whose place and velocity are looked at, a number, and its end."""

    kind: str
    text: str
    of: tuple[str, str]
    by: str
    end: float
    steps: int = 40


@dataclass
class Found:
    """Derivatives of a case: truth (2,), what the differences leave open (2,), the largest of both
    along the motion (2,), results by method, direction and ERROR.
    """

    case: Case
    truth: np.ndarray
    open: np.ndarray
    top: np.ndarray
    rows: list[dict[str, Any]] = field(default_factory=list)


KINDS: dict[str, Callable[[Random], Case]] = {}


def kind(make: Callable[[Random], Case]) -> Callable[[Random], Case]:
    """Add a kind to the table."""
    KINDS[make.__name__] = make
    return make


def number(value: float) -> str:
    return f"{value:.8g}"


def ball(rng: Random, of: int = 2, axis: int = 0) -> str:
    """A point mass somewhere, at some speed along an axis."""
    place, speed = [0.0, 0.0, 0.0], float(rng.uniform(-1.0, 1.0))
    place[axis] = float(rng.uniform(0.6, 1.4))
    text = f"POINT_MASS/{of}, MASS={number(rng.uniform(0.5, 2.0))}, CM={of}, "
    text += f"QG={','.join(map(number, place))}, V{'XYZ'[axis]}={number(speed)}\n"
    return text + f"MARKER/{of}, POINT_MASS={of}\n"


def force(of: int, law: str, axis: int = 0, name: int = 0) -> str:
    return f"SFORCE/{name or of}, I={of}, J={'8 9'.split()[axis > 0]}, ACTIONONLY, FUNCTION={law}\n"


def spring(rng: Random, of: int = 2) -> str:
    w = float(rng.uniform(1.5, 8.0))
    cubic = f"-{number(rng.uniform(0.5, 20))}*DX({of})**3" if rng.random() < 0.5 else ""
    damper = number(rng.uniform(0.02, 0.3) * w)
    return f"-{number(w * w)}*DX({of})-{damper}*VX({of}){cubic}"


@kind
def switch(rng: Random) -> Case:
    """A force that begins, ends or changes at a time or a place, abruptly or within a window."""
    t, end = float(rng.uniform(0.3, 1.2)), float(rng.uniform(1.3, 3.0))
    a, b = (number(rng.uniform(-20, 20)) for _ in range(2))
    wide = number(t + rng.choice([0.003, 0.05, 0.3]))
    law = [
        f"IF(TIME-{number(t)}:{a},{b},{b})",
        f"STEP(TIME,{number(t)},{a},{wide},{b})",
        f"IF(DX(2)-{number(rng.uniform(-0.3, 0.5))}:{a},{b},{b})",
        f"IF(VX(2)-{number(rng.uniform(-0.5, 0.5))}:{number(abs(float(a)))},0,0)",
        f"IF(TIME-{number(t)}:{a},{b},{b})*DX(2)",
    ][int(rng.integers(5))]
    text = HEAD + AXES + ball(rng) + force(2, law + spring(rng))
    return Case("switch", text, ("POINT_MASS/2.x", "POINT_MASS/2.vx"), "SFORCE/2.FUNCTION[0]", end)


@kind
def impact(rng: Random) -> Case:
    """A ball that falls on a floor by IMPACT, or swings between two by BISTOP."""
    k, c = 10 ** float(rng.uniform(2.5, 5)), float(rng.uniform(0, 30))
    e = number(rng.uniform(1.1, 2.2))
    d = number(10 ** float(rng.uniform(-4, -2)))
    by = ["POINT_MASS/2.MASS", "POINT_MASS/2.QG[{axis}]", "SFORCE/2.FUNCTION[{k}]"]
    if rng.random() < 0.5:
        law, axis, k_at = f"IMPACT(DZ(2),VZ(2),0.1,{number(k)},{e},{number(c)},{d})", 2, 1
        text = HEAD + "ACCGRAV/KGRAV=-9.81\n" + AXES + ball(rng, axis=2) + force(2, law, 2)
        text = text.replace("VZ=-", "VZ=")
    else:
        law = f"BISTOP(DX(2),VX(2),0.2,1.6,{number(k)},{e},{number(c)},{d})"
        text, axis, k_at = HEAD + AXES + ball(rng) + force(2, f"{law}-3"), 0, 2
    name = by[int(rng.integers(3))].format(axis=axis, k=k_at)
    of = (f"POINT_MASS/2.{'xyz'[axis]}", f"POINT_MASS/2.v{'xyz'[axis]}")
    return Case("impact", text, of, name, float(rng.uniform(0.5, 1.5)))


@kind
def two(rng: Random) -> Case:
    """Two balls that meet changes of force at one time, apart or tied by a spring."""
    t, end = number(rng.uniform(0.2, 0.8)), float(rng.uniform(1.0, 1.6))
    a, b, c, d = (number(rng.uniform(-20, 20)) for _ in range(4))
    one = ball(rng)
    other = one.replace("/2", "/3").replace("CM=2", "CM=3").replace("=2\n", "=3\n")
    law = spring(rng)
    if rng.random() < 0.5:
        laws = [f"IF(TIME-{t}:{a},{b},{b})", f"IF(TIME-{t}:{c},{d},{d})"]
        law3 = law.replace("(2)", "(3)")
        names = ["SFORCE/2.FUNCTION[0]", "SFORCE/3.FUNCTION[0]"]
    else:
        x = number(rng.uniform(-0.2, 0.4))
        drop = f"IF(DX(2)-{x}:{number(abs(float(a)))},0,0)"
        laws, law3 = [drop, drop.replace("(2)", "(3)")], law.replace("(2)", "(3)")
        names = [
            "SFORCE/2.FUNCTION[0]", "SFORCE/3.FUNCTION[0]", "POINT_MASS/2.QG[0]",
            "POINT_MASS/3.QG[0]",
        ]  # fmt: skip
    text = HEAD + AXES + one + other + force(2, laws[0] + law) + force(3, laws[1] + law3)
    if "TIME" in laws[0] and rng.random() < 0.5:
        stiff = number(rng.uniform(1, 30))
        text += f"SFORCE/9, I=2, J=8, ACTIONONLY, FUNCTION={stiff}*(DX(3)-DX(2))\n"
    of = f"POINT_MASS/{rng.integers(2, 4)}"
    return Case("two", text, (f"{of}.x", f"{of}.vx"), names[int(rng.integers(len(names)))], end)


@kind
def friction(rng: Random) -> Case:
    """A slider or a wheel with FRICTION, driven to and fro, that comes to rest in between."""
    vs, dm = number(rng.uniform(0.01, 0.1)), number(10 ** float(rng.uniform(-3, -1.7)))
    mu = rng.uniform(0.2, 0.5)
    w, end = float(rng.uniform(2.0, 5.0)), float(rng.uniform(1.0, 3.0))
    rest = f"MU_STATIC={number(mu * rng.uniform(1.0, 1.4))}, MU_DYNAMIC={number(mu)}"
    rest += f", STICTION_TRANSITION_VELOCITY={vs}, MAX_STICTION_DEFORMATION={dm}"
    body = "ACCGRAV/KGRAV=-9.81\nPART/2, MASS=2, CM=2, IP=.1,.12,.15\n"
    if rng.random() < 0.6:
        law = f"{number(2 * 9.81 * mu * rng.uniform(1.4, 2.5))}*SIN({number(w)}*TIME)"
        text = HEAD + body + AXES + "MARKER/2, PART=2, REULER=90D,90D,0\n"
        text += f"JOINT/1, TRANSLATIONAL, I=2, J=8\nFRICTION/1, JOINT=1, {rest}\n"
        text += f"SFORCE/1, TRANSLATIONAL, I=2, J=8, ACTIONONLY, FUNCTION={law}\n"
        of = ("PART/2.x", "PART/2.vx")
    else:
        law = f"{number(0.2 * 9.81 * mu * rng.uniform(1.4, 2.5))}*SIN({number(w)}*TIME)"
        text = HEAD + body + AXES + "MARKER/2, PART=2, REULER=0,90D,0\nMARKER/7, PART=2\n"
        text += "MARKER/6, PART=1, REULER=0,90D,0\n"
        text += f"JOINT/1, REVOLUTE, I=2, J=6\nFRICTION/1, JOINT=1, PIN_RADIUS=0.1, {rest}\n"
        text += f"SFORCE/1, ROTATION, I=2, J=6, ACTIONONLY, FUNCTION={law}\n"
        text += "REQUEST/1, F2=AZ(2,6), F3=WZ(2,6,6)\n"
        of = ("REQUEST/1.F2", "REQUEST/1.F3")
    names = ["STICTION_TRANSITION_VELOCITY", "MAX_STICTION_DEFORMATION", "MU_STATIC", "MU_DYNAMIC"]
    by = [*(f"FRICTION/1.{name}" for name in names), "SFORCE/1.FUNCTION[0]", "PART/2.MASS"]
    return Case("friction", text, of, by[int(rng.integers(len(by)))], end)


@kind
def smooth(rng: Random) -> Case:
    """A vibration, a pendulum, a double pendulum or a turning body."""
    end, form = float(rng.uniform(1.0, 3.0)), int(rng.integers(3))
    if form == 0:
        text = HEAD + AXES + ball(rng) + force(2, spring(rng)[1:].join(["-", ""]))
        by = ["POINT_MASS/2.MASS", "POINT_MASS/2.QG[0]", "SFORCE/2.FUNCTION[0]"]
        return Case("smooth", text, ("POINT_MASS/2.x", "POINT_MASS/2.vx"),
                    by[int(rng.integers(3))], end)  # fmt: skip
    r = number(rng.uniform(0.2, 0.8))
    text = HEAD + "ACCGRAV/JGRAV=-9.81\n" + AXES
    text += f"PART/2, MASS=1, CM=22, IP=0.01,0.09,0.09, WZ={number(rng.uniform(-3, 3))}\n"
    text += f"MARKER/20, PART=2\nMARKER/21, PART=2, QP=0.5,0,0\nMARKER/22, PART=2, QP={r},0,0\n"
    text += "JOINT/1, REVOLUTE, I=20, J=1\n"
    by, of = ["PART/2.MASS", "PART/2.IP[2]", "ACCGRAV.JGRAV", "PART/2.WZ"], "PART/2"
    if form == 2:
        text += "PART/3, MASS=0.8, CM=32, IP=0.01,0.08,0.08, QG=0.5,0,0\nMARKER/30, PART=3\n"
        text += "MARKER/32, PART=3, QP=0.25,0,0\nJOINT/2, REVOLUTE, I=30, J=21\n"
        text += (
            f"SFORCE/1, ROTATION, I=20, J=1, FUNCTION=0-{number(rng.uniform(0, 0.5))}*WZ(20,1)\n"
        )
        of, by = "PART/3", [*by, "PART/3.MASS", "PART/3.IP[2]"]
    return Case("smooth", text, (f"{of}.x", f"{of}.vx"), by[int(rng.integers(len(by)))], end)


def truth(case: Case) -> Found | None:
    """Differences of runs with three steps, where these agree."""
    deck = al.read(case.text + "END\n")
    value = next(each.value for each in al.names(deck) if each.name == case.by)

    def run(at: float) -> np.ndarray:
        made = al.simulate(
            al.with_values(deck, {case.by: at}), end=case.end, steps=case.steps, error=TIGHT,
            integrator="RADAU",
        )  # fmt: skip
        if made.outcome.name != "DONE":
            raise RunFailed(made.message)
        return np.stack([made[name] for name in case.of])

    found = []
    for share in STEPS:
        h = share * (abs(value) or 1.0)
        found.append((run(value + h) - run(value - h)) / (2 * h))
    top = np.abs(found[0]).max(axis=1)
    ends = np.array([each[:, -1] for each in found])
    left = np.abs(ends - ends[1]).max(axis=0)
    if (left > AGREE * top).any() or not top.all():
        return None
    best = ends[0] + (ends[0] - ends[2]) * STEPS[0] ** 2 / (STEPS[2] ** 2 - STEPS[0] ** 2)
    return Found(case, best, np.maximum(np.abs(best - ends[1]), NOISE * top), top)


def look(found: Found, errors: tuple[float, ...], methods: tuple[str, ...]) -> None:
    """Derivatives by all ways."""
    case = found.case
    deck, of = al.read(case.text + "END\n"), [f"{each}@end" for each in case.of]
    for method in methods:
        for error in errors:
            run = {"end": case.end, "steps": case.steps, "error": error, "integrator": method}
            for way in ("forward", "adjoint"):
                row: dict[str, Any] = {"way": way, "method": method, "error": error}
                try:
                    made = (
                        al.sensitivities(deck, [case.by], of, **run)
                        if way == "forward"
                        else al.gradient(deck, of, [case.by], **run)
                    )
                except (RunFailed, al.UsageError) as fault:
                    row["fault"] = str(fault)
                else:
                    off = np.maximum(np.abs(made.gradient[:, 0] - found.truth) - found.open, 0.0)
                    row["off"] = float((off / found.top).max())
                    row["estimate"] = float(made.errors[0]) if made.errors.size else None
                    row["notes"] = " | ".join(made.notes.values())
                    row["values"] = made.gradient[:, 0].tolist()
                found.rows.append(row)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", nargs="*", default=list(KINDS))
    parser.add_argument("--errors", type=float, nargs="*", default=list(ERRORS))
    parser.add_argument("--methods", nargs="*", default=list(METHODS))
    parser.add_argument("--file", default="", help="write everything there, a case a line")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    rows: list[dict[str, Any]] = []
    with open(args.file or "/dev/null", "w", encoding="utf-8") as kept:
        for k in range(args.count):
            name = args.kinds[k % len(args.kinds)]
            case = KINDS[name](np.random.default_rng([args.seed, k]))
            try:
                found = truth(case)
            except RunFailed as fault:
                sys.stderr.write(f"{k} {name}: {fault}\n")
                continue
            if found is None:
                continue
            look(found, tuple(args.errors), tuple(args.methods))
            for row in found.rows:
                row |= {"k": k, "kind": name, "by": case.by, "truth": found.truth.tolist()}
                kept.write(json.dumps(row) + "\n")
            kept.flush()
            rows += found.rows
    print(table(rows))


def table(rows: list[dict[str, Any]]) -> str:
    """How often the estimate contains the truth, and how often a note is false or missing."""
    lines = [
        "| kind, method, way, ERROR | cases | contained | over 1 % untold | told, right to 1e-3 |"
    ]
    lines.append("|---|---|---|---|---|")
    keys = sorted({(r["kind"], r["method"], r["way"], r["error"]) for r in rows})
    for key in keys + [("all", m, w, e) for _, m, w, e in
                       sorted({("", *key[1:]) for key in keys})]:  # fmt: skip
        own = [r for r in rows if "off" in r and r["way"] == key[2] and r["method"] == key[1]
               and r["error"] == key[3] and key[0] in ("all", r["kind"])]  # fmt: skip
        inside = [r["off"] <= (r["estimate"] or 0.0) for r in own]
        silent = [r["off"] > 0.01 and not r["notes"] for r in own]
        false = [r["off"] < 1e-3 and bool(r["notes"]) for r in own]
        lines.append(
            f"| {', '.join(map(str, key))} | {len(own)} | {sum(inside)} | {sum(silent)} | "
            f"{sum(false)} |"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    main()
