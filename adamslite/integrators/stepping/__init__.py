"""The part that all methods share: control numbers, the end of a run, step sizes after failures.

``method.py`` of every method has its steps in this order, under these names::

    METHOD(P, L)        begin, then advance until there is an outcome
    begin               accelerations, first step, first record
    advance             one try of a step:
        end_of_run      is it over?
        limit_step      not past the next stop, output time or pace
        predict         from the past
        correct         Newton; its failure: after_failure
        local_error     the error test; its rejection: after_rejection
        passed_singularity
        crossing        a step that passes a crossing is taken again, shorter
        accept          records, the state that is kept, the next order and step
"""
