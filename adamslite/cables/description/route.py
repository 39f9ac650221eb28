"""Rules about the stations of a route: their order, and which of their keys go together."""

from math import inf

from adamslite.cables.description.messages import Faults
from adamslite.cables.description.vocabulary import WHEELS, Toml

INSIDE = ("pulley", "winch", "mass", "body", "bend")
AT_ENDS = ("fixed", "free", "run", "mass", "body", "hook", "winch")
POINTS = ("fixed", "free", "mass", "body")
ON_A_LOOP = ("pulley", "winch", "mass", "bend")


def check_route(faults: Faults, route: list[Toml], closed: bool) -> None:
    """Say what is wrong with the stations as a whole."""
    ring = closed and [each.get("kind") for each in route] == ["bend"]
    if len(route) < 2 and not ring:
        faults.add("short-route", ("route", 0), count=len(route))
    if [each.get("kind") for each in route] == ["run", "run"]:
        faults.add("run-to-run", ("route", 1, "kind"))
    for i, each in enumerate(route):
        _place(faults, each, i, len(route), closed)
        if each.get("kind") == "winch":
            _winch(faults, each, i, not closed and i in (0, len(route) - 1))
        if each.get("kind") in WHEELS and "slide" in each:
            _carriage(faults, each, i)
            _rim(faults, each, i)
    _sliders(faults, route)
    _blocks(faults, route)


def _sliders(faults: Faults, route: list[Toml]) -> None:
    """A weight that slides does so between two points; only such a one is hauled."""
    for i, each in enumerate(route):
        beside = [route[k] for k in (i - 1, i + 1) if 0 <= k < len(route)]
        points = [x for x in beside if x.get("kind") in POINTS and not x.get("slides")]
        if each.get("slides") and len(points) < 2:
            faults.add("slides-between", ("route", i, "slides"))
        if each.get("haul") and not each.get("slides"):
            faults.add("no-slider", ("route", i, "haul"))


def _place(faults: Faults, each: Toml, i: int, count: int, closed: bool) -> None:
    kind, inside = each.get("kind"), 0 < i < count - 1
    if kind not in (*INSIDE, *AT_ENDS):
        return
    if closed and kind not in ON_A_LOOP:
        faults.add("wrong-end", ("route", i, "kind"), kind=kind, where="on a loop")
    elif not closed and kind not in (INSIDE if inside else AT_ENDS):
        where = "between the ends" if inside else "an end of the route"
        faults.add("wrong-end", ("route", i, "kind"), kind=kind, where=where)


def _winch(faults: Faults, each: Toml, i: int, ends: bool) -> None:
    """It has one drive; at an end of the route it may be a reel."""
    drives = [key for key in ("payout", "force", "torque", "speed") if each.get(key)]
    if len(drives) != 1:
        faults.add("drive", ("route", i))
    else:
        _engine(faults, each, i, drives[0])
    reel = each.get("reel")
    if reel and not ends:
        faults.add("reel-between", ("route", i, "reel"))
    for word in ("leans", "wander"):
        if reel and each[word]:
            faults.add("reel-leans", ("route", i, word), word=word)
    if reel and reel.core >= each.get("radius", inf):
        faults.add("reel-core", ("route", i, "reel"), core=reel.core, radius=each["radius"])


def _engine(faults: Faults, each: Toml, i: int, drive: str) -> None:
    """Which keys go with the drive of a winch."""
    motor, path = each["motor"], ("route", i)
    for word in ("motor", "brake", "limit"):
        # A speed without a motor is kept whatever acts against it.
        if each[word] and (drive == "payout" or drive == "speed" and not motor):
            faults.add("law-drives", (*path, word), word=word, drive=drive)
    if drive == "force" and motor:
        faults.add("motor-force", (*path, "motor"))
    if motor and bool(motor.gain) != (drive == "speed"):
        code = "no-gain" if drive == "speed" else "needless-gain"
        faults.add(code, (*path, "motor"))
    if (
        isinstance(each["limit"], tuple)
        and each["limit"]
        and not each["limit"][0] < 0 < each["limit"][1]
    ):
        low, high = each["limit"]
        faults.add("limit-start", (*path, "limit"), low=low, high=high)


def _rim(faults: Faults, each: Toml, i: int) -> None:
    """Which keys of friction on the rim go together; a wheel that is held has no axle."""
    if each.get("held"):
        if each["mu"] < 0:
            faults.add("held-grips", ("route", i, "held"))
        for word in ("friction", "mount", "leans", "wander", "mass", "motion"):
            if each[word] and each[word] != ("", "", ""):
                faults.add("held-turns", ("route", i, word), word=word)
    for word in ("grip", "mu_static"):
        if each[word] and each["mu"] < 0:
            faults.add("without-mu", ("route", i, word), word=word)
    if each["mu_static"] and not each["grip"]:
        faults.add("static-grip", ("route", i, "mu_static"))
    if 0 < each["mu_static"] < each["mu"]:
        faults.add("static-below", ("route", i, "mu_static"), static=each["mu_static"],
                   mu=each["mu"])  # fmt: skip


def _blocks(faults: Faults, route: list[Toml]) -> None:
    """All wheels on a block slide as its first one does, which has the pull."""
    firsts: dict[str, int] = {}
    for i, each in enumerate(route):
        name = each.get("block")
        first = firsts.setdefault(str(name), i) if name else i
        if first < i and (each["slide"] != route[first]["slide"] or each["pull"]):
            faults.add("block-ways", ("route", i, "block"), i=first + 1)


def _carriage(faults: Faults, each: Toml, i: int) -> None:
    """A wheel that moves has either a law, or a mass that forces move."""
    if each["mass"] and any(each["motion"]):
        faults.add("moved-twice", ("route", i, "motion"))
    if each["mount"] and (each["mass"] or any(each["motion"])):
        faults.add("mount-moves", ("route", i, "mount"))
    for key in ("slide", "pull", "block"):
        if not each["mass"] and any(each[key]):
            faults.add("no-carriage", ("route", i, key), word=key)
    if each["pull"] and not any(each["slide"]):
        faults.add("no-slide", ("route", i, "pull"))
