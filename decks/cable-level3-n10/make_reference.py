"""Write cable-level3-n10.adm and its reference.csv; the physics is in level3.py."""

from pathlib import Path

from level3 import write

if __name__ == "__main__":
    write(Path(__file__).resolve().parent, 10)
