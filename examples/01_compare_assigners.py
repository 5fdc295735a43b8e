"""Compare three assigners on your own site: python 01_compare_assigners.py SCENARIO.toml."""

import sys
from dataclasses import replace

import clearway
from clearway.assign import Apsga, AutomaticAssigner, RandomAssigner, build
from clearway.protocols import objective
from clearway.systems import choose_system

scenario = clearway.read_scenario(sys.argv[1])
system, problem = choose_system(scenario), build(scenario)
print(
    f"{'assigner':20}{'fitness':>10}{'longest m':>11}{'all m':>9}{'last arrival s':>16}{'wrong':>7}"
)
for assign in (RandomAssigner(), Apsga(), AutomaticAssigner()):
    name = type(assign).__name__
    if reasons := assign.unsupported(problem):
        print(f"{name:20} does not take it: {reasons[0]}")
        continue
    worth = objective(problem, assign(problem, scenario.seed))
    run = clearway.solve(scenario, system=replace(system, assign=assign))
    print(
        f"{name:20}{worth.value:10.1f}{worth.max_distance:11.1f}{worth.total_distance:9.1f}"
        f"{run.record.makespan:11.1f}{len(run.violations):7}"
    )
