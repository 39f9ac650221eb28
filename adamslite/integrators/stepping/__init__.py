"""The part that all methods share: control numbers, the end of a run, step sizes after failures.

``method.py`` of every method has its steps in this order, under these names::

    METHOD(P, L)            begin, then advance until there is an outcome
    begin                   accelerations, first step, first record
    advance                 one try of a step:
        end_of_run          is it over?
        limit_step          not past the next stop, output time or pace; too small: stuck
        predict             from the past
        correct             Newton; its failure: after_failure
        local_error         the error test; its rejection: after_rejection
        passed_singularity  a step that passes a singularity: near_singularity
        passes_crossing     a step that passes a crossing is taken again: end_at_crossing
        accept              record, the state that is kept; after an event: pass_on, else the next
                            step: choose_step, choose_order

Every method has its formula in ``prediction``, ``corrector`` and ``error``, values between the ends
of a step in ``dense_output``, failed tries in ``recovery``, the accepted state in ``state``.
"""
