"""Scenario files for the command line."""

from tests.plan.rooms import swapping_corridor

from clearway.formats.scenario_file import dump_scenario
from clearway.model import Order, Scenario, Task

HALL = """\
format = "clearway.scenario/1"
name = "hall"
seed = 1
robots = [
  {id = "a", type = "carrier", start = [3.0, 3.0, 0.0]},
  {id = "b", type = "carrier", start = [3.0, 9.0, 0.0]},
]
tasks = [
  {id = "t1", pose = [16.0, 3.0, 0.0], service = 1.0},
  {id = "t2", pose = [16.0, 9.0, 0.0], service = 1.0},
]

[site]
bounds = [[0, 0], [20, 0], [20, 12], [0, 12]]
obstacles = [{polygon = [[8, 5], [10, 5], [10, 7], [8, 7]]}]

[robot_types.carrier]
kinematics = "four_wheel"
footprint = [[1.5, 1], [-1.5, 1], [-1.5, -1], [1.5, -1]]
limits = {speed = 2.5, yaw_rate = 0.57, turning_radius = 3.0}

[system]
name = "hierarchical"
"""


def altered(old: str, new: str) -> str:
    """The hall with something else in the place of ``old``."""
    if old not in HALL:
        raise ValueError(f"the hall has no {old!r}")
    return HALL.replace(old, new, 1)


def endless_corridor() -> str:
    """Two robots that have to swap in one lane: legal, never solved, never proven."""
    problem = swapping_corridor()
    orders = tuple(
        Order(Task(visit.task, (visit,), robot))
        for robot, tour in problem.tours.items()
        for visit in tour
    )
    return dump_scenario(
        Scenario(
            "corridor",
            problem.site,
            problem.robot_types,
            problem.robots,
            orders,
            settings={"park": "never"},
        )
    )
