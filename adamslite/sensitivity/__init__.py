"""Derivatives of a run by numbers of its deck, forward and by adjoints.

Read study first: `sensitivities` takes a deck, numbers and measures to derivatives. Then adjoint:
`gradient` takes one measure to its derivatives by many numbers.

directions, recipes            how the arrays of a model depend on numbers of the deck
taped, record, measures        a run that keeps its tape, and what is asked of it
tangents, rates, outputs       derivatives of the equations, of accelerations, of what is written
start, begin                   at the start of a run and behind its events
differences, corrector         along the steps of backward differences; their linear systems
stages, stage_error            along the steps of Radau; what they are off by
adjoint_columns, _numbers      measures as weights of columns; numbers of equations as the deck's
adjoint_tape, _formula         the tape row by row, and the coefficients of its steps
adjoint_sweep, _stages         the same steps from the end to the beginning; those of Radau
adjoint_weights, transposed    weights carried back through equations and through their systems
contract                       records that native code is given
"""
