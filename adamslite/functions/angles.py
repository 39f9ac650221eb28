"""Angles between the axes of two markers.

R is the attitude of marker i seen from marker j: R[a][b] = (axis a of j) . (axis b of i).  A
body-fixed sequence a-b-c turns about axis a, then about the new b, then about the new c:

    R = R_a(q1) R_b(q2) R_c(q3)

Where the middle angle lines the first axis up with the last, only their sum counts: q3 is then 0.
"""

from __future__ import annotations

import math

from adamslite.language.function import Mistake, function
from adamslite.symbolic.formulas import fn, norm, piecewise, root
from adamslite.symbolic.scope import Scope, cross, dot
from adamslite.symbolic.types import Expr, Frame

SEQUENCES = (
    *((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (1, 0, 2), (2, 1, 0)),
    *((0, 1, 0), (0, 2, 0), (1, 0, 1), (1, 2, 1), (2, 0, 2), (2, 1, 2)),
)
BODY_313 = 11
BODY_321 = 6
SPACE_FIXED, YPR, PROJECTED, EULER_PARAMETERS, COSINES = 13, 25, 26, 27, 29
# Square of the sine below which rounding, not the attitude, would decide the outer angles.
ALIGNED = 1e-20
# Systems that do not have three components.
COMPONENTS: dict[float, int] = {EULER_PARAMETERS: 4, COSINES: 9}

# Square of the sine below which rounding, not the lines, would decide their normal.
IN_LINE = 1e-12

Matrix = tuple[tuple[Expr, ...], ...]


def _attitude(scope: Scope, i: Frame, j: Frame) -> Matrix:
    return tuple(tuple(dot(a, b) for b in scope.axes(i)) for a in scope.axes(j))


def _sequence_angle(r: Matrix, sequence: tuple[int, int, int], component: int) -> Expr:
    """Angle 1, 2 or 3 of ``sequence``, from the row and the column of R that hold but two."""
    a, b, c = sequence
    other = 3 - a - b
    e = 1 if (b - a) % 3 == 1 else -1
    if a == c:
        first = (r[b][a], -e * r[other][a])
        middle = (norm((*first, 0)), r[a][a])
        last = (r[a][b], e * r[a][other])
    else:
        first = (-e * r[b][c], r[c][c])
        middle = (e * r[a][c], norm((*first, 0)))
        last = (-e * r[a][b], r[a][a])
    if component == 2:
        return fn.atan2(*middle)
    sine, cosine = first if component == 1 else last
    together = fn.atan2(e * r[other][b], r[b][b]) if component == 1 else 0
    return piecewise((fn.atan2(sine, cosine), sine**2 + cosine**2 > ALIGNED), otherwise=together)


def _euler_parameter(r: Matrix, component: int) -> Expr:
    """P0..P3 for ``component`` 1..4, from the largest of them and signed so that P0 >= 0.

    Row n of the table holds 4 P_n (P0, P1, P2, P3).
    """
    trace = r[0][0] + r[1][1] + r[2][2]
    skew = (r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1])
    table = [(1 + trace, *skew)]
    for a in range(3):
        pairs = [r[a][b] + r[b][a] for b in range(3)]
        pairs[a] += 1 - trace
        table.append((skew[a], *pairs))
    values = []
    for n, row in enumerate(table):
        value = row[component - 1] / (2 * root(row[n]))
        values.append(piecewise((value, row[0] >= 0), otherwise=-value))
    return piecewise(
        (values[0], trace >= 0),
        (values[1], fn.And(r[0][0] >= r[1][1], r[0][0] >= r[2][2])),
        (values[2], r[1][1] >= r[2][2]),
        otherwise=values[3],
    )


def _components_fit(
    system: float | None, component: float | None, *_: float | None
) -> Mistake | None:
    if system is None or component is None:
        return None
    most = COMPONENTS.get(int(system), 3)
    if component <= most:
        return None
    return 1, f"system {system:g} of ORIENT has components 1..{most} only"


@function("AX", "i:marker j:marker=0")
def ax(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Rotation of i about the x axis of j: atan2(-z_i . y_j, z_i . z_j), full turns counted.

    Unit: rad.  Meant for attitudes whose other two rotations are small.
    Source: Adams/Solver function AX.
    """
    z, (_, yj, zj) = scope.axes(i)[2], scope.axes(j)
    return scope.angle(-dot(z, yj), dot(z, zj), ("AX", i, j))


@function("AY", "i:marker j:marker=0")
def ay(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Rotation of i about the y axis of j: atan2(z_i . x_j, z_i . z_j), full turns counted.

    Unit: rad.  Meant for attitudes whose other two rotations are small.
    Source: Adams/Solver function AY.
    """
    z, (xj, _, zj) = scope.axes(i)[2], scope.axes(j)
    return scope.angle(dot(z, xj), dot(z, zj), ("AY", i, j))


@function("AZ", "i:marker j:marker=0")
def az(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Rotation of i about the z axis of j: atan2(x_i . y_j, x_i . x_j), full turns counted.

    Unit: rad.  Meant for attitudes whose other two rotations are small.
    Source: Adams/Solver function AZ.
    """
    x, (xj, yj, _) = scope.axes(i)[0], scope.axes(j)
    return scope.angle(dot(x, yj), dot(x, xj), ("AZ", i, j))


@function("INCANG", "i:marker j:marker k:marker")
def incang(scope: Scope, i: Frame, j: Frame, k: Frame) -> Expr:
    """Angle at j between the lines from j to i and from j to k, followed past 0 and pi.

    Unit: rad; 0..pi at the start.  With a, b the lines and n = a x b it is atan2(+-|n|, a . b),
    full turns counted; the sign changes where n turns over from one step to the next, as the lines
    pass through one another or through being opposite.
    Source: Adams/Solver C++ function INCANG.
    """
    a, b = scope.position(i, j), scope.position(k, j)
    normal = cross(a, b)
    clear = dot(normal, normal) > IN_LINE * dot(a, a) * dot(b, b)
    # Counted from a right angle: at the start both 0 and pi are then far from a change of turns.
    of = ("INCANG", i, j, k)
    sine = scope.side(normal, clear, of) * norm(normal)
    from_square = scope.angle(-dot(a, b), sine, of)
    return from_square + math.pi / 2


@function("PSI", "i:marker j:marker=0")
def psi(scope: Scope, i: Frame, j: Frame) -> Expr:
    """First angle of the body-fixed 3-1-3 sequence that turns j into i, in -pi..pi.

    Unit: rad.  Where THETA is 0 or pi the whole turn about z is PSI and PHI is 0.
    Source: Adams/Solver function PSI.
    """
    return orient(scope, BODY_313, 1, i, j)


@function("THETA", "i:marker j:marker=0")
def theta(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Second angle of the body-fixed 3-1-3 sequence that turns j into i, in 0..pi.

    Unit: rad.  Its derivative at 0 and pi does not exist and is taken as 0.
    Source: Adams/Solver function THETA.
    """
    return orient(scope, BODY_313, 2, i, j)


@function("PHI", "i:marker j:marker=0")
def phi(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Third angle of the body-fixed 3-1-3 sequence that turns j into i, in -pi..pi.

    Unit: rad.  Where THETA is 0 or pi it is 0.  Source: Adams/Solver function PHI.
    """
    return orient(scope, BODY_313, 3, i, j)


@function("YAW", "i:marker j:marker=0")
def yaw(scope: Scope, i: Frame, j: Frame) -> Expr:
    """First angle (about z) of the body-fixed 3-2-1 sequence that turns j into i, in -pi..pi.

    Unit: rad.  Source: Adams/Solver function YAW.
    """
    return orient(scope, BODY_321, 1, i, j)


@function("PITCH", "i:marker j:marker=0")
def pitch(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Second angle (about y) of the body-fixed 3-2-1 sequence, with its sign reversed.

    Unit: rad; positive when the x axis of i points along +z of j.
    Source: Adams/Solver function PITCH.
    """
    return -orient(scope, BODY_321, 2, i, j)


@function("ROLL", "i:marker j:marker=0")
def roll(scope: Scope, i: Frame, j: Frame) -> Expr:
    """Third angle (about x) of the body-fixed 3-2-1 sequence that turns j into i, in -pi..pi.

    Unit: rad.  Where PITCH is a quarter turn it is 0.  Source: Adams/Solver function ROLL.
    """
    return orient(scope, BODY_321, 3, i, j)


@function(
    "ORIENT",
    "system:constant{1..27,29} component:constant{1..9} i:marker j:marker=0",
    rule=_components_fit,
)
def orient(scope: Scope, system: int, component: int, i: Frame, j: Frame) -> Expr:
    """Component of the attitude of i seen from j, in a numbered system of coordinates.

    1 to 12 are the body-fixed sequences 1-2-3, 2-3-1, 3-1-2, 1-3-2, 2-1-3, 3-2-1, 1-2-1, 1-3-1,
    2-1-2, 2-3-2, 3-1-3, 3-2-3, component 1 to 3 their angles [rad].  13 to 24 are the space-fixed
    ones in the same order: a-b-c turns about axis a of j, then b of j, then c of j.  25 are YAW,
    PITCH, ROLL and 26 AX, AY, AZ, as those functions have them.  27 are the Euler parameters,
    component 1 to 4: P0 = cos(half the angle) >= 0, P1, P2, P3.  29 are the direction cosines,
    component 1 to 3 the x axis of i along the axes of j, 4 to 6 its y axis, 7 to 9 its z axis.
    Source: Adams/Solver function ORIENT.
    """
    if system == YPR:
        return (yaw, pitch, roll)[component - 1](scope, i, j)
    if system == PROJECTED:
        return (ax, ay, az)[component - 1](scope, i, j)
    r = _attitude(scope, i, j)
    if system == COSINES:
        return fn.S.Zero + r[(component - 1) % 3][(component - 1) // 3]
    if system == EULER_PARAMETERS:
        return _euler_parameter(r, component)
    if system >= SPACE_FIXED:  # R_c R_b R_a: body-fixed, the other way round
        c, b, a = SEQUENCES[system - SPACE_FIXED]
        return _sequence_angle(r, (a, b, c), 4 - component)
    return _sequence_angle(r, SEQUENCES[system - 1], component)
