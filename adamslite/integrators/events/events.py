"""Events: where an expression changes its branch, and how an integrator meets them.

Within a step every guard (:mod:`adamslite.symbolic.guards`) keeps the branch it had, so that the
equations are smooth.  Branches stand behind the state in the workspace: first those of the clock,
then those of the watch; 0 stands for a guard that is evaluated as it is.

*Stops* are the times at which a branch of the clock changes.  They are known before the run and
stand in ``P.stops``, the end of the run last.  *Crossings* are sign changes of watched guards; they
are seen from the values and rates of every guard at the two ends of a step, and located on the
dense output.  *Zones* are where smooth steps of the state rise: they are no events, but a step that
would cross more than a share of one is taken again, shorter.

Guards and branches are in :mod:`adamslite.integrators.events.guards`, stops in ``event_stops``, the
location of crossings in ``event_search``, what lies between the ends of a step in ``event_dips``,
changes that need no location in ``event_harmless``.

An integrator

1. calls :func:`start_events` before it solves for the first accelerations and :func:`hold_watch`
   behind that, with the accelerations in the workspace;
2. never steps beyond :func:`horizon`, and ends a step exactly there;
3. looks for a crossing when a step has passed its error test, with the end of the step in the
   workspace::

       open_search(P, t, h)
       while P.search.open:
           (the state at the share P.search.share of the step into the workspace)
           judge(P)

   and afterwards puts the end back.  Above 1, ``P.search.found`` says that there was none.  Where
   ``ends_beyond(P)`` right after ``open_search``, branches differ at the end; when they make no
   difference there (:func:`take_harmless`) they are changed without a search;
   A try that fails because nothing is defined behind a branch is done again after
   :func:`let_go`;
   A try after which it :func:`crawls` ends the run as CHATTERING;
4. does nothing more when :func:`ends_there`; otherwise takes the step again with the size
   :func:`shorter`, or, when :func:`starts_there`, changes branches where it stands;
5. accepts the step, writes the records of the time until then, and calls :func:`keep_margins`
   unless something :func:`happened`, else :func:`pass_event`; that leaves accelerations of the new
   branches, and in ``P.search.jump`` how much they changed.  After a jump what is remembered of
   the past is worthless: it restarts.  After the end of a STEP in time it may continue.

Reference: Shampine, Thompson, Appl. Math. Comput. 2000, "Event location for ODEs"; Oliveira,
Takahashi, ACM Trans. Math. Softw. 47 (2021) 5 (ITP, the bracketing).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.audit.balance import audit_from
from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import CHANGES, CLOSEST, END, HIGH_ROW, HUGE, LOW_ROW, NONE
from adamslite.integrators.events.dips import share_of_zone
from adamslite.integrators.events.guards import (
    CHATTER,
    HARMLESS,
    MOST_CRAWLED,
    branch_of,
    hold_watch,
    is_relation,
    look_at_start,
    note_changes,
    release_watch,
    remember_branches,
    turn_back,
    turn_over,
)
from adamslite.integrators.events.sensors import sense, start_sensors
from adamslite.integrators.events.stops import is_stop, next_stop, set_clock, set_pace
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import WATCH, guard_values, track
from adamslite.native.translate import native, rare, seldom


@native
@rare
def start_events(P: Problem, located: bool, tested: bool) -> None:
    """Nothing has happened yet; branches of the clock for the time until the first stop.

    ``located``: crossings are looked for; else watched guards are evaluated as they are.
    ``tested``: so are errors of velocities.
    """
    P.search[:] = 0
    P.search.found, P.search.loose = NONE, not (located)
    P.search.span = share_of_zone(P, tested)
    for k in range(P.margin.size):
        if k // max(P.sizes.watched, 1) != CLOSEST:
            P.margin[k] = 0.0
    start_sensors(P)
    if P.search.loose and P.sensors.size > 0:
        P.settings.stop = True  # they cannot be watched
    release_watch(P)
    set_clock(P, P.settings.t)
    set_pace(P, P.settings.t)


@native
def happened(P: Problem, t: float) -> bool:
    """Whether the accepted step to ``t`` ends at a stop or a crossing."""
    return met(P) or is_stop(P, t)


@native
def met(P: Problem) -> bool:
    """Whether the accepted step ends at a crossing."""
    return P.search.found <= 1.0


@native
def change_here(P: Problem, L: Plan, t: float) -> bool:
    """Change the branches that break at the start of the step; q, u and states are where they
    were, a and z those of the new branches.  False when the equations have no solution, as where a
    root of the new branch has no value until the step has crossed: branches are the old ones then.
    """
    remember_branches(P)
    turn_over(P, HIGH_ROW, 1.0)
    note_branches(P, L, t, HIGH_ROW)
    P.count.events += 1
    P.search.hunt = False
    end_where_nothing_turns(P)
    if not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        turn_back(P)
        return False
    look_at_start(P)
    sense(P)
    audit_from(P, t)
    return True


@native
def end_where_nothing_turns(P: Problem) -> None:
    """End the run as CHATTERING after more changes at one time than all guards may have before
    they are let go: what is looked for then changes no guard.
    """
    S = P.search
    S.turned += 1
    if S.turned > (CHATTER + 2.0) * (P.sizes.watched + 1):
        S.freed, S.crawl = max(S.freed, 1), MOST_CRAWLED + 1


@native
def note_branches(P: Problem, L: Plan, t: float, row: int) -> None:
    """Count changes of branches; guards that chatter and decide nothing are only let go, and do not
    end the run: IF(ABS(x): 0, 0, -c*v) of a joint that is held at 0 follows round-off.
    """
    S, freed = P.search, P.search.freed
    note_changes(P, t, row)
    if S.freed > freed and decides_nothing(P, L, t):
        S.crawl, S.freed = 0, freed


@native
def decides_nothing(P: Problem, L: Plan, t: float) -> bool:
    """Whether the branches of guards that were let go give the same accelerations: those of the
    present state, each of them changed alone, and all of them changed, with other guards evaluated
    as they are.  Guards of one jump change together (``e < 0`` and ``e > 0`` of IF): other
    combinations mean nothing.
    """
    n, first, count = P.sizes.n, P.sizes.nw + P.sizes.clocks, P.sizes.watched
    for k in range(count):
        P.margin[LOW_ROW * count + k] = P.W[first + k]
    release_watch(P)
    known, largest = accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd), 0.0
    guard_values(P, WATCH)
    for i in range(n):
        P.trial[i] = P.a[i]
    for k in range(count):
        if is_free(P, k):
            P.W[first + k] = branch_of(P.kind[P.sizes.clocks + k], P.guard[first + k])
    for k in range(count + 1):
        if flip_free(P, k) > 0:
            known = accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd) and known
            for i in range(n):
                largest = max(largest, abs(P.a[i] - P.trial[i]) / max(1.0, abs(P.u[i])))
            flip_free(P, k)
    for k in range(count):
        P.W[first + k] = P.margin[LOW_ROW * count + k]
    return known and largest * P.settings.h_max <= HARMLESS * P.settings.error


@native
def is_free(P: Problem, k: int) -> bool:
    """Whether a relation was let go because it kept changing."""
    free = P.margin[CHANGES * P.sizes.watched + k] < 0.0
    return free and is_relation(P.kind[P.sizes.clocks + k])


@native
def flip_free(P: Problem, alone: int) -> int:
    """Change the branch of one relation that was let go, or of all; returns how many changed."""
    first, count, changed = P.sizes.nw + P.sizes.clocks, P.sizes.watched, 0
    for k in range(count):
        if (k == alone or alone == count) and is_free(P, k):
            P.W[first + k] = 0.0 - P.W[first + k]
            changed += 1
    return changed


@native
@seldom
def pass_event(P: Problem, L: Plan, t: float) -> bool:
    """Behind a stop or a crossing at ``t``: branches and accelerations of the other side.

    The state stands in q, u, z, rd and P.a and in the workspace; ``P.search.jump``: the largest
    change at a stop of an acceleration or of the rate of a state, against max(1, |u|) or
    max(1, |s|); at a crossing it is beyond all bounds.  False when the equations have no solution.
    """
    P.search.turned = 0
    n, ns, S, old = P.sizes.n, P.sizes.ns, P.search, P.trial
    P.count.events += 1
    S.hunt, S.jump = False, 0.0
    if met(P):
        note_branches(P, L, t, END)
        S.jump = HUGE
    elif not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return False
    for i in range(n):
        old[i] = P.a[i]
    for k in range(ns):
        old[n + k] = P.rd[k]
    if is_stop(P, t):
        next_stop(P, t)
    release_watch(P)
    if not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return False
    hold_watch(P)
    if met(P) and ns > 0:
        track(P)
        hold_watch(P)
    for i in range(n):
        S.jump = max(S.jump, abs(P.a[i] - old[i]) / max(1.0, abs(P.u[i])))
    for k in range(ns):
        size = max(1.0, abs(P.z[P.z.size - 1 - ns + k]))
        S.jump = max(S.jump, abs(P.rd[k] - old[n + k]) / size)
    audit_from(P, t)
    return True
