"""What keeping the order of passage costs with forty robots in one warehouse.

All are committed, one is given its motion anew, everybody is granted and heard of, times are
told anew while half the robots are late, and all reserves are checked for overlap.

    python benchmarks/right_of_way.py
"""

import time
from dataclasses import replace
from statistics import median

from clearway.coordinate import plan_once
from clearway.execute import BodyConflicts, RightOfWay
from clearway.model import Commitment, Trajectory
from clearway.protocols import Budget
from clearway.systems import HierarchicalSettings, hierarchical
from clearway.world.warehouse import random_warehouse


def timed(call, *args):
    begin = time.process_time()
    call(*args)
    return 1e3 * (time.process_time() - begin)


def main() -> None:
    site = random_warehouse(40, 160, 0, service=20.0)
    plan = plan_once(site, hierarchical(HierarchicalSettings()), Budget(), 0)
    commitments = {
        robot.id: Commitment(
            robot.id, plan.trajectories.get(robot.id, Trajectory(robot.id, robot.start))
        )
        for robot in site.robots
    }
    types = {robot.id: site.type_of(robot) for robot in site.robots}
    ends = sorted(each.trajectory.end / 1000.0 for each in commitments.values())
    print(
        f"{len(commitments)} robots, done after {median(ends):.0f} s (median) to {ends[-1]:.0f} s"
    )
    conflicts = BodyConflicts(types)
    ledger = RightOfWay(conflicts)
    whole = timed(ledger.commit, commitments, 0)
    steps = sum(len(ledger.unmet(robot)) for robot in commitments)
    print(f"all committed: {whole:.1f} ms, {steps} precedences")

    single = []
    for robot in commitments:
        others = {r: each for r, each in commitments.items() if r != robot}
        without = RightOfWay(BodyConflicts(types))
        without.commit(others, 0)
        single.append(timed(without.commit, {robot: commitments[robot]}, 0))
    print(f"one more: {median(single):.2f} ms (median), {max(single):.2f} ms at most")

    periods = []
    late = set(sorted(commitments)[::2])
    for now in range(100, 20_100, 100):
        begin = time.process_time()
        for robot in commitments:
            grant = ledger.grant(robot)
            progress = min(now // 2 if robot in late else now, grant)
            ledger.report(robot, progress)
        periods.append(1e3 * (time.process_time() - begin))
    print(f"a period of grants and reports: {median(periods):.2f} ms")
    overlaps = timed(ledger.overlapping, conflicts.overlap)
    print(f"all reserves checked: {overlaps:.1f} ms")
    expected = timed(ledger.projected, 20_000)
    paths = ledger.projected(20_000)
    renewed = {r: replace(commitments[r], trajectory=path) for r, path in paths.items()}
    taken = timed(ledger.commit, renewed, 20_000)
    print(f"times told anew: {expected:.1f} ms, and {taken:.1f} ms to take over")


if __name__ == "__main__":
    main()
