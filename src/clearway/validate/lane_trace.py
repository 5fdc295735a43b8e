"""A trace of robots on lanes, judged cell by cell (paper B; R-B46)."""

from clearway.model import Pose, Trace, tracks_of
from clearway.validate.cell_list import cells_of
from clearway.validate.lane_rules import judge_lanes
from clearway.validate.violation import Violation
from clearway.world.lane_grid import LaneGrid


def validate_on_lanes(trace: Trace, grid: LaneGrid) -> list[Violation]:
    """Return what is wrong by the rules of lanes with robots that are on time.

    Late robots may follow each other more closely than a cell; judge their bodies only.
    """
    tracks = tracks_of(trace)
    lists = {name: cells_of(k.t, k.x, k.y, grid.cell) for name, k in tracks.items()}
    own = {robot.id: {grid.cell_at(robot.start)} for robot in trace.robots}
    for event in trace.of("visit"):
        if event["state"] == "arrived":
            own[event["robot"]].add(grid.cell_at(Pose(*event["pose"])))
    for name, track in tracks.items():
        own[name].add(grid.cell_at(Pose(float(track.x[-1]), float(track.y[-1]), 0.0)))
    return judge_lanes(grid, lists, own)
