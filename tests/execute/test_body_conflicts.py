"""Places of conflict of true shapes, against a slow search over all pairs of ticks."""

from dataclasses import replace

import pytest
from tests.execute.rides import CART, DRUM, encounter
from tests.oracles.forbidden_ticks import allowed, touching

from clearway.execute import BodyConflicts
from clearway.model import Commitment, Footprint, Piece, Pose, Stop, Trajectory, Trip, Visit

CARRIER = replace(CART, name="carrier", loaded_footprint=Footprint.rectangle(1.2, 2.8, rear=0.3))


def straight(robot, start, length, begin, **more):
    """A commitment straight ahead at 1 m/s."""
    piece = Piece(0, None, start, (length, 0.0, 0.0))
    timing = ((begin, begin + round(1000 * length)),)
    return Commitment(robot, Trajectory(robot, start, (piece,), timing), **more)


@pytest.mark.parametrize("seed", range(40))
def test_no_conflict_is_missing(seed):
    """Whatever happens within the precedences, no two sampled ticks have bodies in each other."""
    one, other, types, (first, second) = encounter(seed)
    pairs = touching(one, other, (types["a"].footprint, types["b"].footprint))
    assert len(allowed(pairs, first, second)) == 0


def test_the_slow_search_sees_what_is_missing():
    """Without what one of both waits for, or the other way round, bodies are in each other.

    Pairs that pass each other by less than the samples' distance are left out.
    """
    missing = seen = 0
    for seed in range(20):
        one, other, types, (first, second) = encounter(seed)
        pairs = touching(one, other, (types["a"].footprint, types["b"].footprint))
        if not len(pairs):
            continue
        for kept in ((first, ()), ((), second)):
            if kept != (first, second):
                missing += 1
                seen += len(allowed(pairs, *kept)) > 0
        swapped = (second, first)
        assert len(allowed(pairs, *swapped)) > 0
    assert missing > 15
    assert seen >= missing - 1


@pytest.mark.parametrize("seed", range(40))
def test_what_the_plan_does_is_never_forbidden(seed):
    """Who waits at a tick waits for a tick that is no later."""
    *_, (first, second) = encounter(seed)
    for steps in (first, second):
        assert all(step.passed <= step.at for step in steps)
        assert [step.at for step in steps] == sorted(step.at for step in steps)
        assert [step.passed for step in steps] == sorted(step.passed for step in steps)


def test_a_crossing_is_told_to_within_a_cell():
    """Drums of radius 0.4 m cross at right angles at (0, 0), the second 6 s after the first.

    The first is clear of the second's way when it is 0.8 m beyond, at its tick 5800; the second
    may go on until it is 0.8 m before, at its tick 10200. Cells are half a metre long.
    """
    types = {"a": DRUM, "b": DRUM}
    first = straight("a", Pose(-5.0, 0.0, 0.0), 10.0, 0)
    second = straight("b", Pose(0.0, -5.0, 1.5707963267948966), 10.0, 6000)
    waits_a, waits_b = BodyConflicts(types)(first, second)
    assert waits_a == ()
    assert waits_b[0].at > 10_200 - 1000
    assert 5800 <= waits_b[-1].passed < 5800 + 1000


def test_who_follows_closely_may_stay_as_close():
    """In line 0.15 m apart: after an instant's wait each step is met by one on time."""
    types = {"a": DRUM, "b": DRUM}
    ahead = straight("a", Pose(0.95, 0.0, 0.0), 6.0, 0)
    behind = straight("b", Pose(0.0, 0.0, 0.0), 6.0, 0)
    waits_a, waits_b = BodyConflicts(types)(ahead, behind)
    assert waits_a == ()
    assert len(waits_b) > 6
    # At every tick the one ahead need not be further than it is by plan, and never as far back as
    # to be touched.
    for step in waits_b:
        assert step.at - 150 <= step.passed <= step.at


def test_what_is_driven_is_not_looked_at():
    types = {"a": DRUM, "b": DRUM}
    first = straight("a", Pose(-5.0, 0.0, 0.0), 10.0, 0)
    second = straight("b", Pose(0.0, -5.0, 1.5707963267948966), 10.0, 6000)
    conflicts = BodyConflicts(types)
    assert conflicts(first, second, (7000, 6000)) == ((), ())
    assert conflicts(first, second, (4000, 6000)) == conflicts(first, second)


def test_plans_that_collide_are_refused_by_name():
    first = straight("a", Pose(-5.0, 0.0, 0.0), 10.0, 0)
    second = straight("b", Pose(5.0, 0.0, 3.141592653589793), 10.0, 0)
    with pytest.raises(ValueError, match=r"robots a and b are in each other at tick 4\d\d\d of"):
        BodyConflicts({"a": DRUM, "b": DRUM})(first, second)


def test_too_little_clearance_is_refused_by_name():
    with pytest.raises(ValueError, match=r"robot type drum: a clearance of 0.01 m is too little"):
        BodyConflicts({"a": replace(DRUM, clearance=0.01)})
    with pytest.raises(ValueError, match=r"give it 0.12 m or more"):
        BodyConflicts({"a": DRUM}, margin=0.1)


def test_a_load_is_wider_than_the_robot():
    """The carrier stands 1 m beside another's way, which it fills when its pick ends at 4000.

    A loaded body reaches 1.4 m to the side; the drum, 0.4 m wide, has passed at 1000.
    """
    pose = Pose(0.0, 1.3, 0.0)
    visit = Visit("t", pose, service=1.0, load="pick")
    trip = Trip("b", (visit,), "order")
    standing = Commitment("b", Trajectory("b", pose, stops=(Stop(0, 3000, 4000),)), trip)
    drum = straight("a", Pose(-1.0, 0.0, 0.0), 4.0, 0)
    conflicts = BodyConflicts({"a": DRUM, "b": CARRIER})
    waits_a, waits_b = conflicts(drum, standing)
    assert waits_a == ()
    assert waits_b[0].at == 4000
    assert 2000 < waits_b[0].passed <= 3500
    late = straight("a", Pose(-1.0, 0.0, 0.0), 4.0, 4000)
    with pytest.raises(ValueError, match="in each other"):
        conflicts(late, standing)


def test_reserves_that_meet_are_seen():
    first = straight("a", Pose(-5.0, 0.0, 0.0), 10.0, 0)
    second = straight("b", Pose(0.0, -5.0, 1.5707963267948966), 10.0, 6000)
    conflicts = BodyConflicts({"a": DRUM, "b": DRUM})
    assert not conflicts.overlap(first, (0, 4000), second, (6000, 11_000))
    assert not conflicts.overlap(first, (0, 5000), second, (6000, 10_100))
    assert conflicts.overlap(first, (0, 5000), second, (6000, 10_300))
    assert conflicts.overlap(first, (5000, 5000), second, (11_000, 11_000))
