"""Random instances, planned and judged: is every plan right, and how many are solved?

Draws sites of all kinds with fleets of all kinds, eight to forty robots on 40 to 80 m, and prints
a row per kind of site. An instance's name is the call of `generate` that made it; those with a
wrong plan are named on lines of their own.

    python benchmarks/property.py [INSTANCES]
"""

import itertools
import sys
import time
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

from clearway.coordinate import plan_once
from clearway.formats.recording import record_plan
from clearway.model import Plan, Scenario
from clearway.protocols import Budget
from clearway.systems import choose_system
from clearway.validate import validate_plan
from clearway.world.fleets import FLEETS
from clearway.world.generate import generate
from clearway.world.sites import KINDS


@dataclass(frozen=True)
class Outcome:
    """What became of an instance; ``wrong`` says what the judge or the bound found."""

    name: str
    solved: bool
    wrong: tuple[str, ...]
    over_bound: float
    cpu_s: float


def draw(
    kind: str, fleet: str, seed: int, sides: Sequence[int], robots: Sequence[int]
) -> Scenario | None:
    """Return a seeded instance, or ``None`` where the site is too small for so many robots."""
    chance = Random(f"{kind} {fleet} {seed}")
    size = (float(chance.choice(sides)), float(chance.choice(sides)))
    try:
        return generate(kind, robots=chance.choice(robots), size=size, fleet=fleet, seed=seed)
    except ValueError:
        return None


def plan(scenario: Scenario, expansions: int) -> Plan:
    """Plan an instance by the system that it names."""
    return plan_once(
        scenario, choose_system(scenario), Budget(expansions=expansions), scenario.seed
    )


def examine(scenario: Scenario, expansions: int) -> Outcome:
    """Plan and judge an instance."""
    begin = time.process_time()
    planned = plan(scenario, expansions)
    cpu_s = time.process_time() - begin
    record = record_plan(scenario, planned, seed=scenario.seed, version="")
    wrong = [str(violation) for violation in validate_plan(record)]
    bound = planned.lower_bound or 0.0
    if planned and bound > record.sum_of_costs:
        wrong.append(f"lower bound {bound:.6f} above the sum of costs {record.sum_of_costs:.6f}")
    over = record.sum_of_costs / bound if planned and bound else 1.0
    return Outcome(scenario.name, bool(planned), tuple(wrong), over, cpu_s)


def _large() -> Iterator[tuple[str, Scenario | None]]:
    for seed in itertools.count():
        for kind, fleet in itertools.product(KINDS, FLEETS):
            yield kind, draw(kind, fleet, seed, range(40, 81, 5), range(8, 41))


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 70
    rows: dict[str, list[Outcome]] = defaultdict(list)
    crowded = 0
    for kind, scenario in itertools.islice(_large(), count):
        if scenario is None:
            crowded += 1
            continue
        outcome = examine(scenario, 400_000)
        rows[kind].append(outcome)
        for text in outcome.wrong:
            print(f"{outcome.name}: {text}", flush=True)
    print("| site | instances | solved | clean | most over its bound | slowest, CPU s |")
    print("|---|---|---|---|---|---|")
    for kind, seen in rows.items():
        slow, far = max(seen, key=lambda o: o.cpu_s), max(seen, key=lambda o: o.over_bound)
        print(
            f"| {kind} | {len(seen)} | {sum(o.solved for o in seen)} "
            f"| {sum(not o.wrong for o in seen)} | {far.over_bound:.2f} ({far.name}) "
            f"| {slow.cpu_s:.1f} ({slow.name}) |"
        )
    print(f"\n{crowded} of {count} draws had more robots than fit.")


if __name__ == "__main__":
    main()
