"""Which robots may do a task, and how they are loaded on the way."""

from clearway.model import LOAD_CHANGE, Robot, Scenario, Task


def load_states(task: Task) -> list[tuple[bool, bool]]:
    """Return, for each visit, whether the robot is loaded on arrival and on leaving."""
    carried, states = 0, []
    for visit in task.visits:
        before = carried
        carried += LOAD_CHANGE[visit.load]
        states.append((before > 0, carried > 0))
    return states


def able_robots(scenario: Scenario, task: Task) -> tuple[Robot, ...]:
    """Return the robots that have the capabilities and the capacity, and are not shut out."""
    needs = {visit.needs for visit in task.visits if visit.needs is not None}
    carried = peak = 0 if task.fetches is None else 1
    for visit in task.visits:
        carried += LOAD_CHANGE[visit.load]
        peak = max(peak, carried)
    kinds = {
        name
        for name, kind in scenario.robot_types.items()
        if needs <= kind.capabilities and peak <= kind.capacity
    }
    return tuple(
        robot for robot in scenario.robots if robot.type in kinds and task.robot in (None, robot.id)
    )


def visit_key(scenario: Scenario, order: int, visit: int) -> str:
    """Return the key path of a visit's pose, as a scenario is written."""
    if len(scenario.orders[order].task.visits) == 1:
        return f"tasks[{order}].pose"
    return f"tasks[{order}].visits[{visit}].pose"
