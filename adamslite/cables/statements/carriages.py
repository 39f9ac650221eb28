"""What the half section beside a wheel whose axle moves does to it.

e points from the wheel at x_0 along the cable, H is a section, S the cable that the wheel brings:

    T       = T_section + rho H/2 (e.g - S" - e.x_0")              at the rim
    force   = T_section e - rho H/2 (x_0" + S" e - g) - rho S'^2 e          on the carriage

The paper's form has no S". With form ale the cable also has the accelerations of what flows, as
beside a weight that slides.
"""

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements import sliders
from adamslite.cables.statements.capstan import half_section
from adamslite.cables.statements.forms import AXES, gravity, number, vforce
from adamslite.cables.statements.pieces import Piece, feed


def along_axle(spec: Spec, wheel: int, i: int, j: int) -> str:
    """e.x_0" of the axle of a wheel whose cable goes from MARKER/i to MARKER/j [m/s^2]."""
    axle = spec.marker(wheel)
    parts = "+".join(f"ACC{a}({axle})*D{a}({j},{i})" for a in AXES)
    return f"({parts})/DM({j},{i})"


def carried_half(spec: Spec, model: CableModel, piece: Piece, j: int, axes: str) -> str:
    """VFORCE of the half section of a piece that goes from its wheel to MARKER/j."""
    root, i, p = spec.route[piece.root], piece.first, piece.number
    if root.leans:
        return ""
    comment = "! Mass of the half section beside the wheel.\n"
    if model.level == 3 and model.form != "paper":
        return comment + sliders.through(p, i, j, axes)
    half, flow = half_section(model, piece, spec), f"({feed(spec, piece, 1)})**2"
    if model.level < 3:
        flow += f"+{half}*({feed(spec, piece, 2)})"
    light = spec.lightness(piece.place)
    share = "" if light == 1.0 else f"{number(light)}*"
    components = [
        f"-rho*({half}*(ACC{a}({i})-{share}{gravity(a)})+({flow})*D{a}({j},{i})/DM({j},{i}))"
        for a in axes
    ]
    return comment + vforce(i, i, axes, components)
