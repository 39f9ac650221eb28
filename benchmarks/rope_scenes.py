"""Random scenes of the kinds that `adamslite cable` describes, as tables of a description."""

from __future__ import annotations

from collections.abc import Callable
from math import exp, log, pi, sqrt
from typing import Any

import numpy as np

Table = dict[str, Any]
G = 9.81
#: Radius of a wheel, as a share of the length of the cable.
WHEEL = 0.02
#: Results of a run, at most.
MOST_STEPS = 6000
#: Share of the laws that may leave the cable slack.
SLACK = 0.1


class Draw:
    """Random numbers of a scene, with four digits as somebody types them."""

    def __init__(self, seed: int, number: int) -> None:
        self.rng = np.random.default_rng([seed, number])

    def decades(self, low: float, high: float) -> float:
        """Between two sizes, all decades alike."""
        return float(f"{exp(self.rng.uniform(log(low), log(high))):.4g}")

    def between(self, low: float, high: float) -> float:
        """Between two numbers."""
        return float(f"{self.rng.uniform(low, high):.4g}")

    def one(self, *of: Any) -> Any:
        """One of them."""
        return of[int(self.rng.integers(len(of)))]


class Rope:
    """A rope under a load of `mass`: its length, EA, rho, damping, and what follows from them."""

    def __init__(self, draw: Draw, mass: float | None = None, load: float = 0.0) -> None:
        self.mass = draw.decades(5.0, 2e4) if mass is None else mass
        self.length = draw.decades(1.0, 150.0)
        pull = load or self.mass * G
        strain = draw.decades(1e-4, 5e-3)
        self.stiffness = float(f"{pull / strain:.4g}")
        speed = draw.decades(800.0, 5000.0)
        self.density = float(f"{self.stiffness / speed**2:.4g}")
        self.damping = draw.one(0.0, 0.0, 0.05, 0.2)
        self.pull = pull
        self.often = draw.one(30, 10)

    @property
    def weight(self) -> float:
        """Of all of it [kg]."""
        return self.density * self.length

    @property
    def transit(self) -> float:
        """Of an axial wave [s]."""
        return self.length * sqrt(self.density / self.stiffness)

    @property
    def bounce(self) -> float:
        """Period of the load on it [s]."""
        carried = self.mass + self.weight / 3
        return 2 * pi * sqrt(carried * self.length / self.stiffness)

    def cable(self) -> Table:
        """[cable] of a description."""
        found = {"EA": self.stiffness, "rho": self.density}
        return found | ({"damping": self.damping} if self.damping else {})

    def scene(self, end: float, route: list[Table], **top: Any) -> Table:
        """The description; results often enough to show fronts and bounces.

        A run takes a step for every result at least: with few it is ERROR that decides.
        """
        coarse = end / (self.bounce / self.often)
        fine = end / (self.transit / 6)
        steps = max(fine, coarse) if fine < MOST_STEPS else coarse
        end = float(f"{end:.4g}")
        steps = int(min(max(steps, 200), MOST_STEPS))
        return {"end": end, "steps": steps, **top, "cable": self.cable(), "route": route}


def _fixed(*at: float) -> Table:
    return {"kind": "fixed", "at": list(at)}


def _mass(mass: float, *at: float, **more: Any) -> Table:
    return {"kind": "mass", "at": list(at), "mass": mass, **more}


def _winch(draw: Draw, rope: Rope, law: Table) -> Table:
    """A winch whose cable hangs from the origin."""
    radius = float(f"{rope.length * WHEEL:.4g}")
    inertia = float(f"{draw.decades(0.01, 1.0) * rope.mass * radius**2:.4g}")
    return {"kind": "winch", "at": [-radius, 0.0, 0.0], "radius": radius, "inertia": inertia,
            "turn": -1, **law}  # fmt: skip


def _pulley(draw: Draw, rope: Rope, *at: float, **more: Any) -> Table:
    radius = float(f"{rope.length * WHEEL:.4g}")
    inertia = float(f"{draw.decades(0.003, 1.0) * rope.mass * radius**2:.4g}")
    return {"kind": "pulley", "at": list(at), "radius": radius, "inertia": inertia, **more}


# ---- laws ------------------------------------------------------------------------------------


def law(draw: Draw, rope: Rope) -> tuple[str, float]:
    """Payout of TIME, and when its run ends; lifts and lowers, slowly or at once."""
    time = float(f"{rope.bounce * draw.decades(0.3, 60.0):.4g}")
    way = min(rope.length * draw.between(0.05, 0.6), 6 * time)
    # One in ten outruns the load; the others leave the cable taut while they start and stop.
    share = 0.3 if draw.between(0.0, 1.0) < SLACK else 0.08
    way = float(f"{min(way, share * G * time**2) * draw.one(1, -1):.4g}")
    kind = draw.one("step5", "step", "ramp", "sine", "havsin", "stop", "poly", "shf")
    speed = float(f"{way / time:.4g}")
    short = float(f"{time / 5:.4g}")
    stop = float(f"{time * (1 - draw.decades(0.02, 0.3)):.4g}")
    text = {
        "step5": f"STEP5(TIME,0,0,{time},{way})",
        "step": f"STEP(TIME,0,0,{time},{way})",
        "ramp": f"{speed}*TIME",
        "sine": f"{abs(way) / 10:.4g}*SIN({2 * pi / time:.5g}*TIME)**2",
        "havsin": f"HAVSIN(TIME,0,0,{time},{way})",
        "stop": f"{speed}*(MAX(0,TIME-{short})+MIN({short},TIME)**2/{2 * short:.6g}"
        f"-MAX(0,MIN(TIME,{time})-{stop})**2/{2 * (time - stop):.6g}-MAX(0,TIME-{time}))",
        "poly": f"POLY(TIME,0,0,0,{way / time**2:.5g},{-way / (2 * time**3):.5g})",
        "shf": f"SHF(TIME,0,{abs(way) / 10:.4g},{2 * pi / time:.5g},0,0)",
    }[kind]
    return text, time * (1.3 if kind in ("step5", "step", "havsin", "stop") else 1.0)


# ---- kinds -----------------------------------------------------------------------------------


def along(draw: Draw) -> Table:
    """A weight starts up or down its cable."""
    rope = Rope(draw)
    speed = draw.decades(0.003, 1.0) * rope.pull / sqrt(rope.stiffness * rope.density)
    speed = float(f"{min(speed, 10.0) * draw.one(1, -1):.4g}")
    end = max(rope.bounce * draw.decades(0.3, 8.0), 3 * rope.transit)
    weight = _mass(rope.mass, 0.0, -rope.length, 0.0, velocity=[0.0, speed, 0.0])
    return rope.scene(end, [_fixed(0.0, 0.0, 0.0), weight])


def across(draw: Draw) -> Table:
    """A weight starts sideways."""
    rope = Rope(draw)
    wave = sqrt(rope.pull / rope.density)
    speed = float(f"{min(wave * draw.decades(1e-3, 0.5), sqrt(G * rope.length)):.4g}")
    end = min(rope.length / wave * draw.decades(1.0, 30.0), 3 * 2 * pi * sqrt(rope.length / G))
    weight = _mass(rope.mass, 0.0, -rope.length, 0.0, velocity=[speed, 0.0, 0.0])
    return rope.scene(max(end, 3 * rope.transit), [_fixed(0.0, 0.0, 0.0), weight])


def heavy(draw: Draw) -> Table:
    """A light weight under a heavy rope swings."""
    rope = Rope(draw)
    rope.mass = float(f"{rope.mass * draw.decades(0.02, 1.0):.4g}")
    speed = float(f"{draw.decades(0.1, 3.0):.4g}")
    end = 2 * pi * sqrt(rope.length / G) * draw.between(0.2, 1.0)
    weight = _mass(rope.mass, 0.0, -rope.length, 0.0, velocity=[speed, 0.0, 0.0])
    return rope.scene(end, [_fixed(0.0, 0.0, 0.0), weight])


def hoist(draw: Draw) -> Table:
    """A winch pays out, or lifts, by a law."""
    rope = Rope(draw)
    text, end = law(draw, rope)
    weight = _mass(rope.mass, 0.0, -rope.length, 0.0)
    return rope.scene(end, [_winch(draw, rope, {"payout": text}), weight])


def crane(draw: Draw) -> Table:
    """The same while the load swings."""
    found = hoist(draw)
    drop = -found["route"][-1]["at"][1]
    speed = float(f"{sqrt(G * drop) * draw.decades(0.01, 0.3):.4g}")
    found["route"][-1]["velocity"] = [speed, 0.0, 0.0]
    return found


def trolley(draw: Draw) -> Table:
    """The end of a cable moves by a law."""
    rope = Rope(draw)
    time = float(f"{2 * pi * sqrt(rope.length / G) * draw.decades(0.1, 1.0):.4g}")
    way = float(f"{rope.length * draw.decades(0.01, 0.3):.4g}")
    kind = draw.one("STEP", "STEP5")
    motion = [f"{kind}(TIME,0,0,{time},{way})", 0, 0]
    first = {**_fixed(0.0, 0.0, 0.0), "motion": motion}
    return rope.scene(1.2 * time, [first, _mass(rope.mass, 0.0, -rope.length, 0.0)])


def heave(draw: Draw) -> Table:
    """The upper end moves up and down by a law."""
    rope = Rope(draw)
    text, end = law(draw, rope)
    first = {**_fixed(0.0, 0.0, 0.0), "motion": [0, text, 0]}
    return rope.scene(end, [first, _mass(rope.mass, 0.0, -rope.length, 0.0)])


def atwood(draw: Draw) -> Table:
    """Two weights over a pulley."""
    rope = Rope(draw)
    other = float(f"{rope.mass * draw.between(0.7, 1.4):.4g}")
    rope.damping = rope.damping or 0.05
    pulley = _pulley(draw, rope, 0.0, 0.0, 0.0)
    r, drop = pulley["radius"], rope.length
    rate = abs(other - rope.mass) / (other + rope.mass) * G
    end = min(sqrt(0.6 * drop / max(rate, 0.05)), rope.bounce * draw.decades(2.0, 60.0))
    return rope.scene(end, [_mass(rope.mass, -r, -drop, 0.0), pulley, _mass(other, r, -drop, 0.0)])


def elevator(draw: Draw) -> Table:
    """A winch lifts a weight over a pulley."""
    rope = Rope(draw)
    text, end = law(draw, rope)
    pulley = _pulley(draw, rope, 0.0, 0.0, 0.0)
    r = pulley["radius"]
    winch = _winch(draw, rope, {"payout": text}) | {
        "at": [-1.5 * r, -float(f"{rope.length * draw.between(0.3, 1.0):.4g}"), 0.0],
        "radius": r / 2, "turn": -1,
    }  # fmt: skip
    return rope.scene(end, [winch, pulley, _mass(rope.mass, r, -rope.length, 0.0)])


def engine(draw: Draw) -> Table:
    """A winch brakes with a force."""
    rope = Rope(draw)
    share = draw.between(0.9, 1.1)
    weight = (rope.mass + rope.weight) * G
    force = f"{weight * share:.5g}"
    rate = G * abs(1 - share)
    end = min(sqrt(0.5 * rope.length / max(rate, 0.05)), rope.bounce * draw.decades(1.0, 20.0))
    weight = _mass(rope.mass, 0.0, -rope.length, 0.0)
    return rope.scene(end, [_winch(draw, rope, {"force": force}), weight])


def struck(draw: Draw) -> Table:
    """A weight between two points is struck across a taut cable."""
    tension = draw.decades(1e2, 5e4)
    rope = Rope(draw, draw.decades(1.0, 5e3), tension)
    half, wave = rope.length / 2, sqrt(tension / rope.density)
    speed = float(f"{min(wave * draw.decades(0.01, 0.5), 60.0):.4g}")
    weight = _mass(rope.mass, 0.0, 0.0, 0.0, velocity=[0.0, speed, 0.0])
    route = [_fixed(-half, 0.0, 0.0), weight, _fixed(half, 0.0, 0.0)]
    found = rope.scene(rope.transit * draw.decades(1.5, 12.0), route, gravity=[0, 0, 0])
    found["cable"]["pretension"] = tension
    return found


def slider(draw: Draw) -> Table:
    """A weight slides along a rope between two points."""
    rope = Rope(draw)
    span, sag = rope.length, float(f"{rope.length * draw.between(0.1, 0.3):.4g}")
    at = float(f"{span * draw.between(0.1, 0.4):.4g}")
    weight = _mass(rope.mass, at, -sag, 0.0, slides=True)
    end = sqrt(span / G) * draw.between(0.3, 2.0)
    return rope.scene(end, [_fixed(0.0, 0.0, 0.0), weight, _fixed(span, 0.0, 0.0)])


def tackle(draw: Draw) -> Table:
    """A block in the bight of the cable carries a weight."""
    rope = Rope(draw)
    block = float(f"{2 * rope.mass * draw.between(0.7, 1.4):.4g}")
    rope.damping = rope.damping or 0.05
    low = _pulley(draw, rope, 0.0, -rope.length, 0.0, mass=block, slide=[0, 1, 0])
    high, r = _pulley(draw, rope, 0.0, 0.0, 0.0), low["radius"]
    high["at"] = [2 * r, 0.0, 0.0]
    end = min(sqrt(0.2 * rope.length), rope.bounce * draw.decades(1.0, 20.0))
    weight = _mass(rope.mass, 3 * r, -rope.length, 0.0)
    return rope.scene(end, [_fixed(-r, 0.0, 0.0), low, high, weight])


def kink(draw: Draw) -> Table:
    """A hook catches a cable that a sheave feeds from a long run."""
    tension = draw.decades(5e3, 5e4)
    rope = Rope(draw, 1e9, tension)
    wave = sqrt(tension / rope.density)
    speed = float(f"{wave * draw.between(0.2, 1.0):.4g}")
    hook = _mass(1e9, -rope.length, 0.0, 0.0, velocity=[0.0, speed, 0.0])
    rope.mass = draw.decades(0.5, 50.0) * rope.weight
    rope.damping = 0.0
    pulley = _pulley(draw, rope, 0.0, 0.0, 0.0, turn=1)
    pulley["at"] = [0.0, pulley["radius"], 0.0]
    route = [hook, pulley, {"kind": "run", "at": [rope.length / 3, 0.0, 0.0]}]
    found = rope.scene(rope.length / wave * 0.5, route, gravity=[0, 0, 0])
    found["cable"]["pretension"] = tension
    return found


def mixed(draw: Draw) -> Table:
    """A weight between two winches, which pull by laws."""
    rope = Rope(draw)
    half = rope.length
    weight = _mass(rope.mass, 0.0, -float(f"{half * draw.between(0.3, 0.8):.4g}"), 0.0)
    text, end = law(draw, rope)
    first = _winch(draw, rope, {"payout": text}) | {"turn": -1}
    last = _winch(draw, rope, {"payout": "0*TIME"}) | {"turn": -1}
    first["at"], last["at"] = [-half, 0.0, 0.0], [half, 0.0, 0.0]
    return rope.scene(end, [first, weight, last])


def slip(draw: Draw) -> Table:
    """Two weights over a held pulley, on which the cable slips."""
    found = atwood(draw)
    wheel = found["route"][1]
    wheel.update(mu=draw.between(0.05, 0.25), friction=float(f"{draw.decades(1, 100):.4g}"))
    return found


KINDS: dict[str, Callable[[Draw], Table]] = {
    each.__name__: each
    for each in (
        along, across, heavy, hoist, crane, trolley, heave, atwood, elevator, engine, struck,
        slider, tackle, kink, mixed, slip,
    )
}  # fmt: skip
#: As often as users describe them: a winch with a law is the usual scene.
OFTEN = (*KINDS, "hoist", "hoist", "crane")


def scene(seed: int, number: int) -> tuple[str, Table]:
    """The kind and the description of a scene, the same on every machine."""
    draw = Draw(seed, number)
    kind = draw.one(*OFTEN)
    return kind, KINDS[kind](draw)


def toml(table: Table) -> str:
    """The text of a description."""
    top = [f"{k} = {_text(v)}" for k, v in table.items() if not _is_table(v)]
    for name in ("cable", "model"):
        if name in table:
            top += [f"[{name}]", *(f"{k} = {_text(v)}" for k, v in table[name].items())]
    for station in table["route"]:
        top += ["[[route]]", *(f"{k} = {_text(v)}" for k, v in station.items())]
    return "\n".join(top) + "\n"


def _is_table(value: object) -> bool:
    return isinstance(value, dict) or (
        isinstance(value, list) and bool(value) and isinstance(value[0], dict)
    )


def _text(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_text, value))}]"
    return repr(value)
