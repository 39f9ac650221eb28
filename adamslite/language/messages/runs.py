"""Messages about the statements that run a deck."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE, WARNING
from adamslite.language.messages.entry import Message

RUNS: dict[str, Message] = {
    "no-end": Message(
        "SIMULATE has no end time",
        "give END= or DURATION=",
        ("SIMULATE/DYNAMICS, STEPS=9",),
    ),
    "two-ends": Message(
        "SIMULATE has both END and DURATION", "", ("SIMULATE/DYNAMICS, END=1, DURATION=1, STEPS=9",)
    ),
    "no-output-step": Message(
        "SIMULATE has no output step",
        "give STEPS= or DTOUT=; without them 100 steps are written",
        ("SIMULATE/DYNAMICS, END=1",),
        severity=WARNING,
    ),
    "two-output-steps": Message(
        "SIMULATE has both STEPS and DTOUT", "", ("SIMULATE/DYNAMICS, END=1, STEPS=9, DTOUT=1",)
    ),
    "end-not-later": Message(
        "SIMULATE ends at {end}, but the time is {time} already",
        "END is a time and must grow from run to run; a time span is written DURATION=",
        ("SIMULATE/DYNAMICS, END=1, STEPS=9\nSIMULATE/DYNAMICS, END=0.5, STEPS=9",
         "SIMULATE/DYNAMICS, END=0, STEPS=9"),
        commands=("SIM/DYN, DURATION=2, STEPS=9\nSIM/STATICS\nSIM/DYN, END=2, STEPS=9",),
    ),
    "sensor-idle": Message(
        "{label} does nothing when it triggers",
        "give HALT, RETURN, PRINT, EVALUATE, DT or STEPSIZE",
        ("SENSOR/1, FUNCTION=TIME\\, VALUE=1",),
        severity=WARNING,
    ),
    "too-many-steps": Message(
        "SIMULATE requests {count:.3g} output steps; at most {most:.0e} are allowed",
        "fewer STEPS, or a longer DTOUT",
        ("SIMULATE/DYNAMICS, END=1, STEPS=1000000000000", "SIMULATE/DYNAMICS, END=1, DTOUT=1E-12"),
    ),
    "solved-as": Message(
        "{word} is solved as {other}",
        "both keep constraints on positions and velocities; results agree within ERROR",
        ("INTEGRATOR/GSTIFF, SI1",),
        severity=WARNING,
    ),
    "order-limited": Message(
        "KMAX={word} is above the highest order, {highest}",
        "order 6 is stable only where the motion is strongly damped, and is never used",
        ("INTEGRATOR/GSTIFF, KMAX=6",),
        severity=WARNING,
    ),
    "scale-order": Message(
        "SCALE is read as factors of ERROR for displacements, angles, modal coordinates, and the "
        "rates of these three",
        "the documentation of SCALE that was available does not give the order of its factors",
        ("INTEGRATOR/ABAM, SCALE=1,0.1",),
        severity=WARNING,
    ),
    "input-rate": Message(
        "{word} is an input whose rates {user} takes: a linear model has no columns for them",
        "drive it by a force, or make the rate the input: MOTION with ACCELERATION and a DIFF",
        commands=("LINEAR/STATEMAT, PINPUT=1",),
        deck="VARIABLE/1, FUNCTION=TIME\nGCON/1, FUNCTION=DX(2)-VARVAL(1)\n"
        "PINPUT/1, VARIABLES=1\n",
    ),
    "other-model": Message(
        "the command file is for a model called {word}; it is carried out on this deck",
        "the deck is the one that the command line names",
        commands=("FILE/MODEL=other", "other\nout\nSIM/STATICS"),
        severity=NOTE,
    ),
    "no-such-modes": Message(
        "{word} is not the number of a first and of a last mode",
        "modes are counted from 1: {word}=1,25",
        commands=("LINEAR/EIGENSOL, COORDS=0,4", "LINEAR/EIGENSOL, KENERGY=4,2"),
    ),
    "prefix-unused": Message(
        "{word} is not the plain name of a file: results are called as the deck",
        "`adamslite solve -o FILE` writes them elsewhere",
        commands=("FILE/OUTPUT_PREFIX=../a", "deck\nC:\\runs\\a\nSIM/STATICS"),
        severity=NOTE,
    ),
    "states-chosen": Message(
        "{word} cannot use PSTATE: this program chooses the states of the matrices",
        "leave it out: eigenvalues and transfer functions do not depend on the choice of states",
        commands=("LINEAR/STATEMAT, PSTATE=1",),
        deck="VARIABLE/1, FUNCTION=DX(2)\nPSTATE/1, VARIABLES=1\n",
    ),
    "negative": Message("{word} of {label} must not be negative", "", ("EQUILIBRIUM/STAB=-1",)),
    "not-a-file-name": Message(
        "{word} is not the plain name of a file",
        "a file named here lies beside the results: no folder, no drive, no dot in front",
        commands=("LINEAR/STATEMAT, FILE=../x.json", "LINEAR/STATEMAT, FILE=\"/tmp/x.json\"",
                  "LINEAR/STATEMAT, FILE=C:\\x.json", "LINEAR/STATEMAT, FILE=.profile",
                  "LINEAR/STATEMAT, FILE=\"\""),
    ),
    "file-taken": Message(
        "the file {word} is {what}",
        "give FILE= another name",
        commands=("LINEAR/STATEMAT, FILE=a.json\nLINEAR/STATEMAT, FILE=A.json",),
    ),
    "nothing-saved": Message(
        "no SAVE/STATES before has BUFFER={word}",
        "a buffer lasts as long as the run; a SYSTEM in a FILE can come from an earlier one",
        commands=("SAVE/STATES, BUFFER=a\nRELOAD/STATES, BUFFER=b", "RELOAD/STATES, BUFFER=a"),
    ),
    "empty-range": Message(
        "no {kind} has an id from {low} to {high}",
        "",
        commands=("DEACTIVATE/JOINT, RANGE=10,20",),
        severity=WARNING,
    ),
}  # fmt: skip
