"""What planners are asked: robots with tours, and what else moves."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from clearway.model.pose import Pose
from clearway.model.robot import Robot, RobotType
from clearway.model.site import Site
from clearway.model.task import Visit
from clearway.model.trajectory import Trajectory


@dataclass(frozen=True)
class RobotState:
    """Where a robot is at ``tick``, in which mode, and the trajectory prefix it is committed to."""

    pose: Pose
    mode: str | None = None
    tick: int = 0
    loaded: bool = False
    committed: Trajectory | None = None


@dataclass(frozen=True)
class Problem:
    """Robots to plan for, their tours, and the fixed trajectories of all others."""

    site: Site
    robot_types: Mapping[str, RobotType]
    robots: tuple[Robot, ...]
    tours: Mapping[str, tuple[Visit, ...]]
    states: Mapping[str, RobotState] = field(default_factory=dict)
    fixed: Mapping[str, Trajectory] = field(default_factory=dict)

    def state_of(self, robot: Robot) -> RobotState:
        """Return the robot's state; at its start, at rest, where none is given."""
        return self.states.get(robot.id, RobotState(robot.start, robot.start_mode))
