"""Write cable-level3-n40.adm and its reference.csv; physics: ../cable-level3-n10/level3.py."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cable-level3-n10"))

from level3 import write  # noqa: E402  (it lies beside the other deck)

if __name__ == "__main__":
    write(HERE, 40)
