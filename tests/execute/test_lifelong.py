"""Robots that get new trips while others are late, at times that are told anew."""

import random

import pytest
from tests.execute.lanes import BOX, driven, hall, soonest, through
from tests.execute.late import Late

from clearway.execute import CellConflicts, RightOfWay

WIDTH, LOOK_AHEAD = 12, 1500


class Shuttles:
    """Robots of a hall that go from bay to bay for ever; there are more bays than robots."""

    def __init__(self, seed, num_robots=12, **how):
        self.rng = random.Random(seed)
        self.grid = hall(WIDTH, 8)
        self.check = CellConflicts(self.grid)
        bays = [(x, y) for x in range(WIDTH) for y in (0, 7)]
        self.rng.shuffle(bays)
        self.at = {f"r{k}": bays.pop() for k in range(num_robots)}
        self.free = bays
        self.trips = 0
        standing = {r: driven(self.grid, r, [bay], []) for r, bay in self.at.items()}
        self.ledger = RightOfWay(self.check, LOOK_AHEAD)
        self.fleet = Late(standing, self.ledger, seed, **how)

    def send(self):
        """Tell all times anew, then give robots at rest new trips among the others' motions."""
        fleet = self.fleet
        fleet.retime()
        for robot, commitment in list(fleet.commitments.items()):
            if fleet.progress[robot] < commitment.trajectory.end or self.rng.random() < 0.5:
                continue
            goal = self.free.pop(self.rng.randrange(len(self.free)))
            cells = through(self.at[robot], goal, self.rng.randrange(1, 7))
            others = [c for r, c in fleet.commitments.items() if r != robot]
            begin, done = fleet.now + LOOK_AHEAD, (fleet.now, fleet.now)
            mine = soonest(self.grid, self.check, robot, cells, begin, others, done)
            fleet.renew({robot: mine})
            self.free.append(self.at[robot])
            self.at[robot] = goal
            self.trips += 1


@pytest.mark.parametrize("seed", range(4))
def test_trips_never_end_and_nobody_is_touched(seed):
    """In 300 s twelve robots make three trips each and more, stops of up to 15 s and all."""
    shuttles = Shuttles(seed, lost=0.0)
    fleet = shuttles.fleet
    while fleet.now < 300_000:
        if fleet.now % 3000 == 0:
            shuttles.send()
        fleet.step()
        assert shuttles.ledger.overlapping(shuttles.check.overlap) == ()
    while not fleet.is_done:
        fleet.step()
        assert fleet.now < 600_000
    assert shuttles.trips > 36
    assert fleet.overlaps(dict.fromkeys(fleet.commitments, BOX)) == []
