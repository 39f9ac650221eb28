"""Code generation for one expression shape: residual, Jacobian, angle memory, guards.

A *shape* is a statement with every id, number and marker replaced by a slot.  Its loads and
rows are differentiated once with respect to the local inputs of
:class:`~adamslite.symbolic.scope.Scope`, chained to body coordinates by
:mod:`adamslite.kernels.code.kinematics`, and written as one loop over all instances:

    residual(n, ints, reals, W, F)           F[row] -= load,  F[row] += row expression
    jacobian(n, ints, reals, W, c, J)        J[block] += c0 F_q + c1 F_u + c2 F_a + c3 F_z + c4 F_s'
    track   (n, ints, reals, W)              remembers angles at an accepted step
    clock   (n, ints, reals, W, F)           guards of time (adamslite.symbolic.guards)
    watch   (n, ints, reals, W, F)           guards of the state

q holds positions and rotations of bodies (and states s of DIFF), z multipliers and variables.
W is the workspace (:mod:`adamslite.kernels.code.kinematics`), ``c`` five coefficients.  The
integers of an instance are

    W offset of each node | W offset of each signal | row of each node | address of each table |
    W offset of the branches of clock, watch and zones, if there are guards | block offset of each
    pair

and its reals: parameters, remembered angles, times of leaving its law, marker levers and axes.
"""
