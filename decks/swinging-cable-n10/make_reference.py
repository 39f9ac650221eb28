"""Write swinging-cable-n10.adm and its reference.csv; the physics is in swinging.py."""

from pathlib import Path

from swinging import write_deck, write_reference

SPRING = """SFORCE/{i}, TRANSLATIONAL, I={i}, J={j}
, FUNCTION=-{stiffness:g}*(DM({i},{j})-{free:g})-{damping:g}*VR({i},{j})
"""

if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    write_deck(here, 10, SPRING)
    write_reference(here, 10)
