"""How a run can end: each outcome's value is the sentence shown to the user, with the remedy."""

from enum import Enum

from adamslite.notation import shown

#: Of a run that a limit ends early.
KEPT = "; everything computed until then is kept"


class Outcome(Enum):
    """The ways a run ends; the value says what happened and what to do about it.

    It is written for the command line; ``sentence`` for whoever reads it.
    """

    DONE = "The run reached its end."
    HALTED = "A SENSOR with HALT ended the run."
    SINGULAR_ACCELERATION = (
        "A force that depends on an acceleration cancels the mass: the effective mass is zero and "
        "the equations no longer determine the motion. Look at the sign of that force "
        "(`adamslite check` prints the effective mass) or end the run before this time."
    )
    STEP_TOO_SMALL = (
        "The steps needed to meet ERROR became too small to advance the time. Look for a jump in "
        "a force or a motion (use STEP instead of IF), a motion that grows without bound or a "
        "stiffness that is far too large, or allow a larger ERROR."
    )
    NEWTON_FAILED = (
        "The corrector did not converge even with the smallest step. Look for a jump or a pole in "
        "the named force, or for a mechanism that locks; a smaller HMAX may help."
    )
    INITIAL_CONDITIONS_FAILED = (
        "No starting state satisfies all constraints. Look at the positions of the named joint's "
        "markers, at initial velocities that contradict a constraint, and at EXACT."
    )
    NOT_KINEMATIC = (
        "A kinematic analysis needs a model without degrees of freedom. Add MOTION statements, or "
        "use SIMULATE/DYNAMIC."
    )
    UNDETERMINED = (
        "The equations do not determine the accelerations. Look for a part without mass or inertia "
        "that no constraint carries, a posture in which a mechanism can move two ways, or a "
        "VARIABLE that refers to itself."
    )
    TORN = (
        "A constraint that followed from the others in one posture, and was left out there, opens "
        "in another. Look for a mechanism that locks (a MOTION or a force drives it where its "
        "joints cannot follow), or start it away from a posture in which it can move two ways."
    )
    NO_EQUILIBRIUM = (
        "No static equilibrium was found. Look for a body that nothing holds against gravity, "
        "start nearer to the equilibrium, or use a larger IMBALANCE or MAXIT in EQUILIBRIUM."
    )
    NOT_FINITE = (
        "An expression gave infinity or not-a-number. Look for a division by zero, the root or the "
        "logarithm of a negative number, or DM of coinciding markers in the named statement."
    )
    BROKEN_MOTION = (
        "A motion that jumps needs an unbounded force. Let it rise over some time: STEP "
        "instead of IF, powers of TIME from 2 on (of a velocity, from 1 on)."
    )
    ROUTINE_FAILED = (
        "A function of Python that --user binds to a routine of the deck raised an exception, or "
        "returned something other than the numbers it has to. Mend that function."
    )
    INTERRUPTED = "The run was interrupted; everything computed until then is kept."
    UNSTABLE = (
        "The steps requested with HINIT are longer than an explicit integrator can take in this "
        "scene. Give a smaller HINIT or none, or use an implicit integrator (GSTIFF)."
    )
    CHATTERING = (
        "An expression keeps changing its branch: on both sides of the change the motion leads "
        "back to it, as with dry friction written with SIGN or IF, or with sensors whose SENVAL "
        "turns the motion round. Replace the jump by a STEP of some width, use FRICTION, or set "
        "VALUE of such sensors further apart."
    )
    CREEPING = (
        "The run creeps: ten thousand steps or more were shorter than 1e-10 of the analysis, with "
        "hardly one between them that was not, and became no longer, which at this rate would "
        "never end. Take what keeps the steps short out of the scene (a vibration far too fast: a "
        "stiffness too large or a mass too small; an expression of TIME that changes too often; a "
        "branch that changes to and fro), use another integrator (`adamslite chart` compares them; "
        "an explicit one keeps to steps that are stable), allow a larger ERROR, or give an earlier "
        "END. With --max-steps N it goes on for so many steps, however short."
    )
    STEP_LIMIT = (
        f"The run has taken as many steps as --max-steps allows{KEPT}. Allow more steps, a larger "
        "ERROR or a longer HMAX, or request fewer outputs."
    )
    CPU_LIMIT = (
        f"The run has used the CPU time that --cpu-limit allows{KEPT}. Allow more time, or let "
        "the run need less: an earlier END, fewer outputs, a larger ERROR, another integrator "
        "(`adamslite chart` compares them)."
    )
    MEMORY_LIMIT = (
        f"The run needs more memory than there is, or than --memory-limit allows{KEPT}. Allow "
        "more, or request fewer outputs (fewer STEPS, a longer DTOUT)."
    )
    NO_END_TIME = (
        "There is no end time. Give SIMULATE/DYNAMIC, END=..., STEPS=... in a command file "
        "(second argument, or a .acf of the deck's name beside it), or in the deck itself, "
        "or use the flags --end T --steps N."
    )

    @property
    def sentence(self) -> str:
        """What happened and what to do about it, with options as the reader writes them."""
        return shown(self.value)

    @property
    def is_requested(self) -> bool:
        """Whether the run ended as the deck requests."""
        return self in (Outcome.DONE, Outcome.HALTED)
