"""Write decks and references of steady and accelerated payout: closed forms of two elements.

With l = l0 + s and N sections, nodes 1 .. N-1 between sheave and tip, all of the mass rho l/N:

    fixed share (the paper's)   T_tip - T_sheave = rho/2 (l s" + s'^2) (N - 1)/N
    flowing (ALE)               T_tip - T_sheave = rho l s" (N - 1)/N

and below a sheave, with a weight M at the tip and gravity,

    fixed share                 T_top = M (g - s") + (rho l g - rho/2 (l s" + s'^2)) (N - 1)/N
    flowing (ALE)               T_top = M (g - s") + rho l (g - s") (N - 1)/N
"""

import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

G, L0 = 9.81, 20.0


@dataclass(frozen=True)
class Scene:
    """A cable that leaves the sheave at the origin along +x, or down with a weight at its end."""

    name: str
    title: str
    down: bool
    n: int
    ea: float
    rho: float
    speed: float
    rise: float
    end: float
    weight: float = 0.0
    pretension: float = 0.0

    def payout(self, t):
        """s, s', s" for s' = U (1 - exp(-x) (1 + x + .. + x^4/24)), x = t/rise."""
        x, fade = t / self.rise, np.exp(-t / self.rise)
        s = self.speed * self.rise * (x - 5 + fade * np.polyval([1 / 24, 1 / 3, 1.5, 4, 5], x))
        rate = self.speed * (1 - fade * np.polyval([1 / 24, 1 / 6, 1 / 2, 1, 1], x))
        return s, rate, self.speed / self.rise * x**4 / 24 * fade

    def start(self):
        """Distances from the sheave of nodes 1 .. N in the steady state at the start."""
        mass = self.rho * L0 / self.n
        below = self.weight + mass * np.arange(self.n - 1, -1, -1)
        pull = below * G if self.down else np.full(self.n, self.pretension)
        return np.cumsum(L0 / self.n * (1 + pull / self.ea))

    def expected(self, t, flowing):
        """Closed form of the measured tension, or of the difference of tensions."""
        s, rate, acceleration = self.payout(t)
        length, inner = L0 + s, (self.n - 1) / self.n
        drag = self.rho * (
            length * acceleration if flowing else (length * acceleration + rate**2) / 2
        )
        if not self.down:
            return drag * inner
        return self.weight * (G - acceleration) + (self.rho * length * G - drag) * inner


SCENES = (
    Scene("level", "level", False, 10, 6e7, 5.536, 30.0, 0.05, 1.2, pretension=13345.0),
    Scene("lowering", "lowering a weight", True, 20, 2e7, 4.0, 20.0, 0.6, 7.0, weight=1000.0),
)
TOP = """Cable payout, {title}: {n} sections, {element}
! Written by make_reference.py. The pulley (PART/901) runs up smoothly to {speed:g} m/s; with
! x = TIME/{rise:g} its speed is {speed:g} (1 - exp(-x) (1 + x + x**2/2 + x**3/6 + x**4/24)).

UNITS/SYSTEM=MKS
{gravity}
! Payout, its speed and acceleration; length of the cable, of a section; mass of a node.
VARIABLE/S, FUNCTION=0.5*AZ(901,902)
VARIABLE/SD, FUNCTION=0.5*WZ(901,902)
VARIABLE/SDD, FUNCTION=0.5*WDTZ(901,902)
VARIABLE/LT, FUNCTION=20+VARVAL(S)
VARIABLE/H, FUNCTION=VARVAL(LT)/{n}
VARIABLE/DM, FUNCTION={rho:g}*VARVAL(S)/{n}

PART/1, GROUND
MARKER/100, PART=1               ! the cable leaves the pulley here
MARKER/902, PART=1, QP=0,0.5,0

PART/901, MASS=100, CM=901, IP=7,7,12.5, QG=0,0.5,0
MARKER/901, PART=901
JOINT/1, REVOLUTE, I=901, J=902
GCON/1, FUNCTION=0.5*AZ(901,902)-{feed:g}*(TIME/{rise:g}-5
, +EXP(-TIME/{rise:g})*(5+4*TIME/{rise:g}+1.5*(TIME/{rise:g})**2
, +(TIME/{rise:g})**3/3+(TIME/{rise:g})**4/24))
"""
NODE = """
POINT_MASS/{k}, MASS={mass:.16g}, CM={k}, QG={x:.16g},{y:.16g},0
MARKER/{k}, POINT_MASS={k}
VFORCE/{k}, I={k}, J_PART=1
"""
FIXED = ", F{axis}=-VARVAL(DM)*(ACC{axis}({k})-{grav}GRAV)-{rho:g}/{n}*VARVAL(SD)*V{axis}({k})"
FLOWING = """, F{axis}=-VARVAL(DM)*(ACC{axis}({k})-{grav}GRAV)
, -({mass:.16g}+VARVAL(DM))*(
, {two_w:g}*VARVAL(SD)*(V{axis}({up},{low})-VARVAL(SD)/VARVAL(LT)*D{axis}({up},{low}))/(2*VARVAL(H))
, +({w:g}*VARVAL(SD))**2*(D{axis}({up},{k})-D{axis}({k},{low}))/VARVAL(H)**2
, +{w:g}*VARVAL(SDD)*D{axis}({up},{low})/(2*VARVAL(H)))"""
SECTION = "SFORCE/{i}, TRANSLATIONAL, I={i}, J={j}, FUNCTION=-{ea:g}*(DM({i},{j})/VARVAL(H)-1)\n"
LEVEL_TIP = """
! The tip moves so that the cable as a whole keeps its pretension.
POINT_MASS/{tip}, MASS=50, CM={tip}, QG={x:.16g},0,0
MARKER/{tip}, POINT_MASS={tip}
GCON/2, FUNCTION=DX({tip},100)-{stretch:.16g}*VARVAL(LT)

"""
LOWERING_TIP = """
POINT_MASS/{tip}, MASS=1000, CM={tip}, QG=0,{y:.16g},0
MARKER/{tip}, POINT_MASS={tip}

"""
BOTTOM = """
VARIABLE/measured, FUNCTION={measured}

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-7
SIMULATE/DYNAMIC, END={end:g}, STEPS=280
END
"""


def node(scene, k, flowing):
    """The statements of node k, counted from the sheave."""
    place, mass = scene.start()[k - 1], scene.rho * L0 / scene.n
    x, y = (0.0, -place) if scene.down else (place, 0.0)
    w = 1 - k / scene.n
    facts = {
        "k": 100 + k, "low": 99 + k, "up": 101 + k, "mass": mass, "w": w, "two_w": 2 * w,
        "n": scene.n, "rho": scene.rho,
    }  # fmt: skip
    form = FLOWING if flowing else FIXED
    parts = [form.format(axis=a, grav=g, **facts) for a, g in zip("XYZ", "IJK", strict=True)]
    return NODE.format(x=x, y=y, **facts) + "\\\n".join(parts) + "\n"


def deck(scene, flowing):
    tip, last = 100 + scene.n, scene.start()[-1]
    text = TOP.format(
        title=scene.title, n=scene.n, element="flowing nodes (ALE)" if flowing else "fixed shares",
        speed=scene.speed, rise=scene.rise, feed=scene.speed * scene.rise, rho=scene.rho,
        gravity="ACCGRAV/JGRAV=-9.81\n" if scene.down else "",
    )  # fmt: skip
    text += "".join(node(scene, k, flowing) for k in range(1, scene.n))
    if scene.down:
        text += LOWERING_TIP.format(tip=tip, y=-last)
    else:
        text += LEVEL_TIP.format(tip=tip, x=last, stretch=last / L0)
    text += "".join(SECTION.format(i=100 + k, j=99 + k, ea=scene.ea) for k in range(1, scene.n + 1))
    top = "SFORCE(101,0,1)"
    measured = top if scene.down else f"SFORCE({tip},0,1)-{top}"
    return text + BOTTOM.format(measured=measured, end=scene.end)


def reference(scene, flowing):
    """Instructions, names and columns of the reference."""
    t = np.linspace(0, scene.end, 281)
    value, rate = scene.expected(t, flowing), scene.payout(t)[1]
    share = "1e-3" if flowing else "2e-3"
    lines = [
        "Closed form of the element: see README.md",
        "tolerance: abs 1e-5",
        f"tolerance VARIABLE/measured: peak {share}",
    ]
    if not scene.down:
        late = np.linspace(1.1, 1.2, 1001)
        band = float(share) * scene.rho * scene.speed**2
        mean = np.trapezoid(scene.expected(late, flowing), late) / 0.1
        lines.append(
            f"measure: mean VARIABLE/measured from 1.1 to 1.2 = {mean:.8g} tol abs {band:.3g}"
        )
    return "\n".join(lines), ["VARIABLE/measured", "VARIABLE/SD"], [t, value, rate]


def main():
    for scene in SCENES:
        for flowing, kind in ((False, "fixed"), (True, "flowing")):
            name = f"{scene.name}-{kind}"
            (HERE / f"{name}.adm").write_text(deck(scene, flowing))
            write(HERE / f"{name}.reference.csv", *reference(scene, flowing))
    level, lowering = SCENES
    assert np.isclose(level.expected(np.array([1.2]), False)[0], 2242.08, rtol=1e-4)
    t = np.array([7.0])
    s, rate, acceleration = lowering.payout(t)
    rigid = (1000 + 4 * (L0 + s)) * (G - acceleration)
    paper = rigid + 4 / 2 * ((L0 + s) * acceleration - rate**2)
    fine = replace(lowering, n=10**9)
    assert np.allclose(fine.expected(t, True), rigid)
    assert np.allclose(fine.expected(t, False), paper)


if __name__ == "__main__":
    main()
