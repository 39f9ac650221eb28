"""BEAM: a massless straight beam between two markers, by Timoshenko theory.

Equation, components along the axes of J (d = r_I - r_J, L = LENGTH)::

    x = (d, AX(I,J), AY(I,J), AZ(I,J)),    v = (velocity, angular velocity of I seen from J)

    force, torque on I = -K (x - (L,0,0,0,0,0)) - C v
    on J               = -force,  -torque - d x force

    K11 = E A/L               K44 = G IXX/L             Py = 12 E IZZ ASY/(G A L^2)
    K22 = 12 E IZZ/(L^3(1+Py))   K26 = -6 E IZZ/(L^2(1+Py))   K66 = (4+Py) E IZZ/(L(1+Py))
    K33 = 12 E IYY/(L^3(1+Pz))   K35 =  6 E IYY/(L^2(1+Pz))   K55 = (4+Pz) E IYY/(L(1+Pz))

with Pz = 12 E IYY ASZ/(G A L^2), K symmetric, and C = CRATIO K or CMATRIX.  K is the part of the
beam's stiffness of 12 freedoms that belongs to I; the part of J follows from equilibrium, and d x
force rather than L x force makes it exact for the deformed beam.  Undeformed, I lies at +x of J and
its axes are those of J::

      J o=====================o I ---> x of J          CMATRIX: its lower triangle,
                L                                      column by column

FORMULATION=STRING adds what a bent beam is longer than its chord.  Its axis is the cubic v(s), w(s)
with the deflections (y, z) and the slopes (c, -b) of I, (a, b, c) being the angles, so that it is
stretched by g besides x1 = x - L and pulled straight by its tension N::

    g = g(y, c) + g(z, -b),    g(v, p) = integral of v'^2/2 = 3/5 v^2/L - v p/10 + L p^2/15

    N = E A/L (x1 + g);    -E A/L g  along x,   -N dg/dy, ... dg/db, dg/dc  besides -K (x - L)

Tension stiffens it, compression makes it buckle.  This is the theory of moderate deflections of the
textbooks; that of ADAMS by this name is not published in full.

The deflection of I seen from J must stay small against L; a beam that bends far is made of several.
Source: Adams/Solver statement BEAM; J. S. Przemieniecki, Theory of Matrix Structural Analysis, ch.
5 and 15.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.elements.bases.wrench import (
    NOTHING,
    Compliance,
    between,
    displacement,
    symmetric,
    times,
)
from adamslite.language.statement import Statement, choice, number, reference, statement, vector

if TYPE_CHECKING:
    from adamslite.elements.bases.wrench import Row
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Load, Scope
    from adamslite.symbolic.types import Expr, Seen


# Deflections, as a share of the length, and slopes [rad] that are far outside of the linear theory.
FAR, STEEP = 0.3, 0.5


@statement("BEAM")
class Beam(Compliance, Statement):
    """A uniform beam from J to I along the x axis of J."""

    beyond = (
        f"bent by more than {FAR:g} of its length or {STEEP:g} rad, where its linear law means "
        "nothing; use more elements"
    )

    i: int | str = reference("I", to="MARKER", required=True, help="marker at the far end, +x of J")
    j: int | str = reference("J", to="MARKER", required=True, help="marker at the near end")
    length: float = number("LENGTH", unit="length", required=True, help="undeformed length")
    ixx: float = number("IXX", unit="length^4", required=True, help="torsion constant")
    iyy: float = number("IYY", unit="length^4", required=True, help="second moment of area about y")
    izz: float = number("IZZ", unit="length^4", required=True, help="second moment of area about z")
    area: float = number("AREA", unit="length^2", required=True, help="area of the cross section")
    asy: float = number(
        "ASY", unit="1", default=0.0, help="shear ratio for deflection in y: 6/5 for a rectangle"
    )
    asz: float = number("ASZ", unit="1", default=0.0, help="shear ratio for deflection in z")
    emodulus: float = number(
        "EMODULUS", unit="force/length^2", required=True, help="Young's modulus"
    )
    gmodulus: float = number("GMODULUS", unit="force/length^2", required=True, help="shear modulus")
    cratio: float | None = number("CRATIO", unit="time", help="damping over stiffness")
    cmatrix: tuple[float, ...] = vector(
        "CMATRIX", size=21, unit="force time/length, ...", default=(0.0,) * 21,
        help="damping: the lower triangle, column by column",
    )  # fmt: skip
    formulation: str = choice(
        "FORMULATION", options=("LINEAR", "STRING", "NONLINEAR"), supported=("LINEAR", "STRING"),
        default="LINEAR", help="theory of the beam: with STRING its tension acts on bending",
    )  # fmt: skip

    @property
    def matrix(self) -> tuple[Row, ...]:
        """K, six rows of six."""
        e, g, length = self.emodulus, self.gmodulus, self.length
        k22, k26, k66 = self._bending(self.izz, self.asy)
        k33, k35, k55 = self._bending(self.iyy, self.asz)
        return (
            (e * self.area / length, 0.0, 0.0, 0.0, 0.0, 0.0),
            (0.0, k22, 0.0, 0.0, 0.0, -k26),
            (0.0, 0.0, k33, 0.0, k35, 0.0),
            (0.0, 0.0, 0.0, g * self.ixx / length, 0.0, 0.0),
            (0.0, 0.0, k35, 0.0, k55, 0.0),
            (0.0, -k26, 0.0, 0.0, 0.0, k66),
        )

    def _bending(self, inertia: float, shear_ratio: float) -> tuple[float, float, float]:
        """Force by deflection, force by slope, torque by slope."""
        rigidity, length = self.emodulus * inertia, self.length
        shear = 12.0 * rigidity * shear_ratio / (self.gmodulus * self.area * length**2)
        soft = rigidity / (1.0 + shear)
        return 12.0 * soft / length**3, 6.0 * soft / length**2, (4.0 + shear) * soft / length

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The matrices of the law."""
        stiffness = self.matrix
        damping = symmetric(self.cmatrix)
        return {
            "stiffness": stiffness,
            "damping": damping if self.cratio is None else times(self.cratio, stiffness),
            "rest": (self.length, *NOTHING[1:]),
            "preload": NOTHING,
        }

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The wrench on I and what J gets."""
        found = Compliance.loads(self, scope)
        _, y, z, _, b, c = displacement(scope, self.i, self.j)
        scope.limit((FAR * self.length) ** 2 - y**2 - z**2)
        scope.limit(STEEP**2 - b**2 - c**2)
        if self.formulation != "STRING":
            return found
        stretched, x, slopes = _stretch(self, scope)
        rigidity = self.emodulus * self.area / self.length
        tension = rigidity * (x[0] + stretched)
        wrench = [-rigidity * stretched, *(-tension * slope for slope in slopes)]
        return [*found, *between(scope, self.i, self.j, wrench)]

    def stored(self: Seen, scope: Scope) -> Expr:
        """Of the linear theory, and E A/L (x1 g + g^2/2)."""
        energy = Compliance.stored(self, scope)
        if self.formulation != "STRING":
            return energy
        stretched, x, _ = _stretch(self, scope)
        rigidity = self.emodulus * self.area / self.length
        return energy + rigidity * (x[0] * stretched + stretched**2 / 2)


def _stretch(beam: Seen, scope: Scope) -> tuple[Expr, list[Expr], list[Expr]]:
    """g, (x1, y, z, a, b, c), and the derivatives of g by y, z, a, b and c."""
    x, y, z, a, b, c = displacement(scope, beam.i, beam.j)
    length = beam.length
    total, slopes = 0, []
    for v, p in ((y, c), (z, -b)):
        total = total + 3 * v**2 / (5 * length) - v * p / 10 + length * p**2 / 15
        slopes.append((6 * v / (5 * length) - p / 10, 2 * length * p / 15 - v / 10))
    (by_y, by_c), (by_z, by_minus_b) = slopes
    return total, [x - length, y, z, a, b, c], [by_y, by_z, 0, -by_minus_b, by_c]
