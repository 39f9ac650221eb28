"""What the explicit formula remembers from step to step: control numbers, rows of its history."""

from __future__ import annotations

from adamslite.integrators.stepping.control import StepControl

# Rows of the history, of 2 n + ns numbers each: stages from 0 (those behind K_NEW are for dense
# output), the accepted state, the new one, one in between, the factors of ERROR (SCALE), the slope
# of the interpolation. Behind them are the inverse inertias, 9 of every body, or what is known of
# masses, 6 of each.
K_NEW, LATE_STAGES = 12, 3
OLD = K_NEW + LATE_STAGES + 1
NEXT_STATE, BETWEEN, SCALES, SLOPE = OLD + 1, OLD + 2, OLD + 3, OLD + 4
INVERSE = HISTORY_ROWS = SLOPE + 1

# By component: numbers that processors take at once, and rows of the tables: 1/m, accelerations of
# gravity and forces by component, masses, and the effective masses.
LINE = 4
TABLES = 3 + 3 + 3 + 1 + 9

# Kinds of scenes: bodies that something ties together, free bodies, point masses alone, and those
# by component.
TIED, BODIES, MASSES, LANES = 0, 1, 2, 3


class Control(StepControl):
    """The numbers of the explicit formula.

    kind                 of scene: TIED, BODIES, MASSES, LANES
    lane                 numbers in a row of a component
    half                 numbers in q, and in u
    size                 numbers in a state: q, u and s
    width                numbers in the rates of a stage: all, of masses accelerations alone
    last_error           of the last accepted step, against ERROR
    behind               whether the step starts at an event, or the run
    cautious             the step must not grow
    stale                the factored matrix is too old for the next stage
    tries                in vain since the last accepted step
    pulled               how often tiny steps left their branch
    firmest              the least sensitivity to constraints so far (0: none)
    quick                whether the formula of four stages is in use
    lazy                 whether the workspace follows the state at records only
    fastest, looked      circular frequency of the fastest vibration, steps since the last look
    third                the third order's error of the last step, against ERROR
    end                  where the accepted step ends whose rows are being written,
    first_row            the first of them, whether there are late stages for them, and
    late, apart          whether each takes a step of its own
    steady, patience     steps since the last change of the formula, steps before the next one
    """

    kind: int
    lane: int
    half: int
    size: int
    width: int
    last_error: float
    behind: bool
    cautious: bool
    stale: bool
    tries: int
    pulled: int
    firmest: float
    quick: bool
    lazy: bool
    fastest: float
    looked: int
    third: float
    end: float
    first_row: int
    late: bool
    apart: bool
    steady: int
    patience: int
