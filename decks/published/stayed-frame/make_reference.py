"""Write a square of bars that is stayed by cables, and the forces in them.

A force F at the free corner: the cable to the opposite corner pulls with F sqrt(2), the bar below
carries -F, all other members are free of force. What the square gives way changes this by F/EA.
"""

from pathlib import Path

HERE = Path(__file__).resolve().parent
LOAD, WITHIN = 1000.0, 2e-6
DECK = """\
A square of bars, stayed by two cables that only pull
! Written by make_reference.py.
! Bars of 1 m, cables on both diagonals, EA = 2.1E11 N/m2 times 100 cm2; 1000 N to the right at 3.

UNITS/SYSTEM=MKS

PART/1, GROUND
MARKER/1, PART=1
MARKER/4, PART=1, QP=1,0,0

POINT_MASS/2, MASS=1, CM=2, QG=0,1,0
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, QG=1,1,0
MARKER/3, POINT_MASS=3
MARKER/5, PART=1, FLOATING

VARIABLE/EA, FUNCTION=2.1E11*1E-2

! The bars: from 1 to 2, 2 to 3, 3 to 4; from 4 to 1 is ground.
SFORCE/12, TRANSLATIONAL, I=2, J=1, FUNCTION=-VARVAL(EA)*(DM(2,1)-1)
SFORCE/23, TRANSLATIONAL, I=3, J=2, FUNCTION=-VARVAL(EA)*(DM(3,2)-1)
SFORCE/34, TRANSLATIONAL, I=3, J=4, FUNCTION=-VARVAL(EA)*(DM(3,4)-1)

! The cables: from 1 to 3, and from 2 to 4, which is slack.
SFORCE/13, TRANSLATIONAL, I=3, J=1, FUNCTION=-VARVAL(EA)*MAX(0,DM(3,1)/SQRT(2)-1)
SFORCE/24, TRANSLATIONAL, I=2, J=4, FUNCTION=-VARVAL(EA)*MAX(0,DM(2,4)/SQRT(2)-1)

VFORCE/1, I=3, JFLOAT=5, RM=1, FX=1000\\ FY=0\\ FZ=-1E6*DZ(3)
VFORCE/2, I=2, JFLOAT=5, RM=1, FX=0\\ FY=0\\ FZ=-1E6*DZ(2)

! Tension is positive.
VARIABLE/BAR34, FUNCTION=-VARVAL(EA)*(1-DM(3,4))
VARIABLE/BAR23, FUNCTION=VARVAL(EA)*(DM(3,2)-1)
VARIABLE/BAR12, FUNCTION=VARVAL(EA)*(DM(2,1)-1)
VARIABLE/CABLE13, FUNCTION=VARVAL(EA)*MAX(0,DM(3,1)/SQRT(2)-1)
VARIABLE/CABLE24, FUNCTION=VARVAL(EA)*MAX(0,DM(2,4)/SQRT(2)-1)

EQUILIBRIUM/ERROR=1.0E-12, IMBALANCE=1.0E-6, MAXIT=100
SIMULATE/STATICS
END
"""

(HERE / "stayed-frame.adm").write_text(DECK)
LINES = [
    "# Forces in the members: see README.md",
    "# written by make_reference.py",
    f"# measure: last VARIABLE/CABLE13 = {LOAD * 2**0.5:.6f} tol rel {WITHIN:g}",
    f"# measure: last VARIABLE/BAR34 = {-LOAD:.6f} tol rel {WITHIN:g}",
    *(
        f"# measure: last VARIABLE/{name} = 0 tol abs {WITHIN * LOAD:g}"
        for name in ("BAR12", "BAR23", "CABLE24")
    ),
]
(HERE / "stayed-frame.reference.csv").write_text("\n".join(LINES) + "\n")
