"""Writes every scene as ordinary ADAMS text.

Point mass k of a chain is POINT_MASS/k+2 with MARKER/k+2 at it; MARKER/1 is the anchor.
"""

from __future__ import annotations

from pathlib import Path

from benchmarks.scenes import CHAINS, SCALING, Chain, chain, parameters, sizes

#: Intervals of the output; the peers give the end only, so few are asked for.
OUTPUT_STEPS = 10

HEAD = """{title}
! Written by the benchmarks; the numbers are those of scenes.json.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV={gravity}

PART/1, GROUND
MARKER/1, PART=1{place}
"""

MASS = """
POINT_MASS/{i}, MASS={mass}, CM={i}, QG={place}{speed}
MARKER/{i}, POINT_MASS={i}"""

SPRING = """
SFORCE/{s}, TRANSLATIONAL, I={i}, J={j}
, FUNCTION=-{k}*(DM({i},{j})-{l0})-{d}*VR({i},{j})"""

GROWTH = """
! How many times its first length, and mass, each segment has reached.
VARIABLE/1, FUNCTION=1+{rate}*TIME
"""

GROWING_SPRING = """
SFORCE/{s}, TRANSLATIONAL, I={i}, J={j}
, FUNCTION=-{k}/VARVAL(1)*(DM({i},{j})-{l0}*VARVAL(1))-{d}/VARVAL(1)*VR({i},{j})"""

# The mass that has been added, as a force: minus its inertia, plus its weight.
GROWING_MASS = """
MARKER/{floating}, PART=1, FLOATING
VFORCE/{i}, I={i}, JFLOAT={floating}
, FX=-{mass}*(VARVAL(1)-1)*ACCX({i}) \\
, FY=-{mass}*(VARVAL(1)-1)*(ACCY({i})-JGRAV) \\
, FZ=-{mass}*(VARVAL(1)-1)*ACCZ({i})"""

SLIDER_CRANK = """
! Crank along +x, rod in line with it, slider at the rod's end; the plane of motion is xy.
PART/2, MASS={m_crank}, CM=2, IP={J_crank},{J_crank},{J_crank}, QG={crank_x},0,0
, VY={half_speed}, WZ={omega0}
MARKER/2, PART=2
MARKER/21, PART=2, QP=-{crank_x},0,0
MARKER/22, PART=2, QP={crank_x},0,0
PART/3, MASS={m_rod}, CM=3, IP={J_rod},{J_rod},{J_rod}, QG={rod_x},0,0
, VY={half_speed}, WZ={rod_rate}
MARKER/3, PART=3
MARKER/32, PART=3, QP=-{half_l},0,0
MARKER/34, PART=3, QP={half_l},0,0
POINT_MASS/4, MASS={m_slider}, CM=4, QG={slider_x},0,0
MARKER/4, POINT_MASS=4

JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=32, J=22
JOINT/3, SPHERICAL, I=34, J=4
GCON/1, FUNCTION=DY(4,1)

REQUEST/1, F2=AZ(2,1)\\ F3=DX(4,1)"""

UPRIGHT = """
PART/{i}, MASS={m}, CM={i}, IP={J},{J},{J}, QG={x},{half},0, VX={half_speed}, WZ={rate}
MARKER/{i}, PART={i}
MARKER/{foot}, PART={i}, QP=0,-{half},0
MARKER/{head}, PART={i}, QP=0,{half},0
MARKER/{pin}, PART=1, QP={x},0,0
JOINT/{i}, REVOLUTE, I={foot}, J={pin}"""

# Held by its two ends, a coupler may also spin about its length; nothing makes it do so.
COUPLER = """
PART/{i}, MASS={m}, CM={i}, IP={J},{J},{J}, QG={x},{L},0, VX={speed}
MARKER/{i}, PART={i}
MARKER/{near}, PART={i}, QP=-{half},0,0
MARKER/{far}, PART={i}, QP={half},0,0
JOINT/{near}, SPHERICAL, I={near}, J={near_head}
JOINT/{far}, SPHERICAL, I={far}, J={far_head}"""

TAIL = """

SIMULATE/DYNAMICS, END={end}, STEPS={steps}
END
"""


def number(value: float) -> str:
    """Shortest text that reads back as the same number; an integer without its point."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def numbers(**values: float) -> dict[str, str]:
    """``number`` of every value."""
    return {key: number(value) for key, value in values.items()}


def place(vector: object) -> str:
    """Three numbers with commas."""
    return ",".join(number(float(x)) for x in vector)


def deck(scene: str, n: int) -> str:
    """The deck of a scene.

    Parameters
    ----------
    scene : "S1" to "S5"
    n : masses (S1, S2, S5) or loops (S4); ignored for S3
    """
    if scene in (*CHAINS, *SCALING):
        return chain_deck(chain(scene, n))
    return slider_crank_deck() if scene == "S3" else four_bar_deck(n)


def tail(end: float) -> str:
    """The run and the end of a deck."""
    return TAIL.format(end=number(end), steps=OUTPUT_STEPS)


def chain_deck(c: Chain) -> str:
    """S1, S2, S5; SFORCE/k joins MARKER/k and the one before, the last one the right anchor."""
    head = HEAD.format(title=c.title, gravity=number(-c.gravity), place="")
    if c.right is not None:
        head += f"MARKER/{c.n + 2}, PART=1, QP={place(c.right)}\n"
    if c.rate:
        head += GROWTH.format(rate=number(c.rate))
    parts = [head]
    for i, (mass, x, v) in enumerate(zip(c.mass, c.position, c.velocity, strict=True), start=2):
        speed = "".join(f", V{a}={number(u)}" for a, u in zip("XYZ", v.tolist(), strict=True) if u)
        parts.append(MASS.format(i=i, mass=number(mass), place=place(x), speed=speed))
    parts.append("\n")
    spring = GROWING_SPRING if c.rate else SPRING
    for i in range(2, c.n_segments + 2):
        parts.append(spring.format(s=i, i=i, j=i - 1, **numbers(k=c.k, d=c.d, l0=c.l0)))
    if c.rate:
        parts.append("\n")
        parts += [
            GROWING_MASS.format(i=i, floating=10000 + i, mass=number(mass))
            for i, mass in enumerate(c.mass, start=2)
        ]
    return "".join(parts) + tail(c.end)


def slider_crank_deck() -> str:
    """S3: REQUEST/1 gives the angle of the crank (F2) and the place of the slider (F3)."""
    p = parameters()["S3"]
    r, length = p["r"], p["l"]
    head = HEAD.format(title=f"S3: {p['what']}", gravity=number(-p["g"]), place="")
    values = {key: p[key] for key in ("m_crank", "J_crank", "m_rod", "J_rod", "m_slider", "omega0")}
    body = SLIDER_CRANK.format(
        **numbers(
            **values, crank_x=r / 2, rod_x=r + length / 2, half_l=length / 2, slider_x=r + length,
            half_speed=p["omega0"] * r / 2, rod_rate=-p["omega0"] * r / length,
        )
    )  # fmt: skip
    return head + body + tail(p["T"])


def four_bar_deck(n: int) -> str:
    """S4: uprights PART/1000+i at x = i L, couplers PART/2000+i; REQUEST/1 F2 is the angle."""
    p = parameters()["S4"]
    length, m, v0 = p["L"], p["m"], p["v0"]
    common = numbers(m=m, J=m * length**2 / 12, L=length, half=length / 2, speed=v0,
                     half_speed=v0 / 2, rate=-v0 / length)  # fmt: skip
    parts = [HEAD.format(title=f"S4: {n} four-bar linkages", gravity=number(-p["g"]), place="")]
    for i in range(n + 1):
        ids = {"i": 1000 + i, "foot": 3000 + i, "head": 4000 + i, "pin": 5000 + i}
        parts.append(UPRIGHT.format(**ids, **common, x=number(i * length)))
    for i in range(n):
        ids = {"i": 2000 + i, "near": 6000 + i, "far": 7000 + i,
               "near_head": 4000 + i, "far_head": 4001 + i}  # fmt: skip
        parts.append(COUPLER.format(**ids, **common, x=number((i + 0.5) * length)))
    parts.append("\n\nREQUEST/1, F2=AZ(1000,1)")
    return "".join(parts) + tail(p["T"])


def write_all(folder: Path) -> list[Path]:
    """Write the deck of every scene at every N into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for scene in parameters():
        for n in sizes(scene):
            path = folder / f"{scene}-{n}.adm"
            path.write_text(deck(scene, n))
            written.append(path)
    return written
