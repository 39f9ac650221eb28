"""Write swinging-cable-n50.adm and its reference.csv; see ../swinging-cable-n10/swinging.py."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "swinging-cable-n10"))

from swinging import write_deck, write_reference  # noqa: E402  (it lies beside the other deck)

SPRING = """SPRINGDAMPER/{i}, TRANSLATIONAL, I={i}, J={j}
, K={stiffness:g}, C={damping:g}, LENGTH={free:g}
"""
ENDING = """
INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-6
SIMULATE/DYNAMIC, END=1, STEPS=100
"""

if __name__ == "__main__":
    write_deck(HERE, 50, SPRING, ENDING)
    write_reference(HERE, 50)
