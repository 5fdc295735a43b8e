"""Where grid robots need the same cells."""

import math
from collections import defaultdict
from dataclasses import dataclass

from clearway.execute.course import NEVER, Course
from clearway.execute.staircase import pruned
from clearway.model import Commitment, Pose, Trajectory
from clearway.protocols import Precedence
from clearway.world.lane_grid import Cell, LaneGrid

# Lengths (m), shares and ticks this small are rounding.
NEAR = 1e-6

Box = tuple[float, float, float, float]
Found = tuple[tuple[Precedence, ...], tuple[Precedence, ...]]


@dataclass(frozen=True)
class CellHold:
    """A robot holds a cell from the beginning of its move there to the end of its move away.

    It is there at rest from tick ``there`` to ``go``; ``came`` and ``goes`` are the directions of
    the two moves.
    """

    cell: Cell
    enter: int
    there: int
    go: int = NEVER
    leave: int = NEVER
    came: Cell | None = None
    goes: Cell | None = None


class CellConflicts:
    """A cell is entered only after those planned earlier through it have left it (R-B37).

    Robots in one line may follow each other at once: while one leaves a cell, the next one comes
    in as far behind it as their bodies allow.

    Parameters
    ----------
    body
        Side of the largest body (m), or its diameter. At most the cell's side over the square
        root of 2, so that bodies turn within their cells (R-B29a).
    """

    def __init__(self, grid: LaneGrid, body: float = 0.7) -> None:
        if not 0.0 < body <= grid.cell / math.sqrt(2.0):
            raise ValueError(
                f"a body of {body} m cannot turn within a cell of {grid.cell} m; keep it to "
                f"{grid.cell / math.sqrt(2.0):.3f} m"
            )
        self.grid = grid
        self._body = body
        # So many parts of a move that one of them is less than what is free of a cell.
        self._parts = math.ceil(grid.cell / (grid.cell - body) - 1e-9)
        self._boxed: dict[str, tuple[Commitment, tuple[int, int], list[Box], Course]] = {}
        self._known: dict[str, tuple[Commitment, dict[Cell, list[CellHold]]]] = {}

    def __call__(self, one: Commitment, other: Commitment, done: tuple[int, int] = (0, 0)) -> Found:
        """Return what each of two robots must wait for; see `clearway.protocols.Conflicts`.

        Raises
        ------
        ValueError
            Both hold a cell at one planned time, one behind the other in line excepted.
        """
        a, b = self._by_cell(one), self._by_cell(other)
        first: list[Precedence] = []
        second: list[Precedence] = []
        for cell in a.keys() & b.keys():
            for mine in a[cell]:
                for its in b[cell]:
                    if mine.leave <= done[0] or its.leave <= done[1]:
                        continue
                    if its.enter <= mine.enter:
                        first += self._behind(one.robot, mine, other.robot, its)
                    else:
                        second += self._behind(other.robot, its, one.robot, mine)
        return pruned(first), pruned(second)

    def overlap(
        self, one: Commitment, ticks: tuple[int, int], other: Commitment, its: tuple[int, int]
    ) -> bool:
        """Return whether bodies are in each other for some tick of each of two stretches.

        Bodies are squares along the axes, or what these sweep when they turn.
        """
        a, b = self._boxes(one, ticks), self._boxes(other, its)
        return any(
            p[0] < q[2] - NEAR and q[0] < p[2] - NEAR and p[1] < q[3] - NEAR and q[1] < p[3] - NEAR
            for p in a
            for q in b
        )

    def _boxes(self, commitment: Commitment, ticks: tuple[int, int]) -> list[Box]:
        """Return the least and largest x and y of the floor needed within some ticks."""
        known = self._boxed.get(commitment.robot)
        if known is not None and known[0] is commitment and known[1] == ticks:
            return known[2]
        is_old = known is None or known[0] is not commitment
        course = Course(commitment.trajectory) if known is None or is_old else known[3]
        boxes: list[Box] = []
        for k in range(course.index(ticks[0]), course.index(ticks[1]) + 1):
            stretch = course.stretches[k]
            first = course.pose(max(ticks[0], stretch.begin))
            last = course.pose(min(ticks[1], stretch.end))
            turns = stretch.piece is not None and stretch.piece.length < NEAR
            half = 0.5 * self._body * (math.sqrt(2.0) if turns else 1.0)
            (x0, x1), (y0, y1) = sorted((first.x, last.x)), sorted((first.y, last.y))
            boxes.append((x0 - half, y0 - half, x1 + half, y1 + half))
        self._boxed[commitment.robot] = (commitment, ticks, boxes, course)
        return boxes

    def _behind(self, robot: str, mine: CellHold, other: str, its: CellHold) -> list[Precedence]:
        """Return what a robot waits for before it enters a cell that another entered before."""
        if its.leave <= mine.enter:
            return [Precedence(mine.enter, other, its.leave)]
        steps = []
        if _follows(mine, its):
            # Once there it may turn, so the other must have left by then.
            n = self._parts
            for k in range(n + 1):
                at = mine.enter + (mine.there - mine.enter) * k // n
                passed = its.go + -((its.go - its.leave) * k // n)
                steps.append(Precedence(at, other, passed))
            if all(step.passed <= step.at for step in steps):
                return steps
        raise ValueError(
            f"robots {robot} and {other} both hold cell {mine.cell} at tick {mine.enter}; "
            "commitments must be free of conflicts"
        )

    def _by_cell(self, commitment: Commitment) -> dict[Cell, list[CellHold]]:
        known = self._known.get(commitment.robot)
        if known is None or known[0] is not commitment:
            cells = defaultdict(list)
            for hold in holds_of(self.grid, commitment.trajectory):
                cells[hold.cell].append(hold)
            known = self._known[commitment.robot] = (commitment, dict(cells))
        return known[1]


def holds_of(grid: LaneGrid, trajectory: Trajectory) -> list[CellHold]:
    """Return the cells that a robot holds, in order, the last one for ever.

    The first piece may be what is left of a move that began before; the last one may end between
    two cells, which are then both held for ever.

    Raises
    ------
    ValueError
        A piece leads along neither axis of the grid, or not to the middle of a cell.
    """
    moves: list[tuple[int, int, Cell]] = []
    first = here = grid.cell_at(trajectory.start)
    for piece, (begin, end) in zip(trajectory.pieces, trajectory.timing, strict=True):
        cells = piece.length / grid.cell
        if cells < NEAR:
            continue
        step = _step(piece.start, piece.end)
        ahead, at = _to_middle(grid, piece.end, step)
        goal = grid.cell_at(at)
        count = math.ceil(cells + ahead - NEAR)
        origin = (goal[0] - count * step[0], goal[1] - count * step[1])
        if not moves:
            first = here = origin
        middle = at.distance(grid.centre(goal))
        if step == (0, 0) or middle > NEAR or origin != here:
            raise ValueError(
                f"robot {trajectory.robot}, piece {piece.id}: does not lead along a row or column "
                f"from cell {here} to the middle of another"
            )
        each = (end - begin) / cells
        for k in range(count, 0, -1):
            go = math.floor(end + each * (ahead - k) + NEAR)
            there = math.ceil(end + each * (ahead - k + 1) - NEAR)
            moves.append((go, there if there <= end else NEVER, step))
        here = goal
    if not moves:
        step = round(math.cos(trajectory.start.theta)), round(math.sin(trajectory.start.theta))
        ahead, at = _to_middle(grid, trajectory.start, step)
        if ahead > NEAR:  # it stands between two cells for ever
            goal = grid.cell_at(at)
            first = here = (goal[0] - step[0], goal[1] - step[1])
            moves.append((0, NEVER, step))
    holds = []
    here, enter, there, came = first, 0, 0, None
    for begin, end, step in moves:
        holds.append(CellHold(here, enter, there, begin, end, came, step))
        here = (here[0] + step[0], here[1] + step[1])
        enter, there, came = begin, end, step
    holds.append(CellHold(here, enter, there, came=came))
    return holds


def _follows(mine: CellHold, its: CellHold) -> bool:
    """Whether one comes into a cell the way that the other leaves it."""
    return mine.came is not None and mine.came == its.goes


def _to_middle(grid: LaneGrid, pose: Pose, step: Cell) -> tuple[float, Pose]:
    """Return how far (cells) the next middle of a cell is from a pose along a step, and where."""
    along = (step[0] * pose.x + step[1] * pose.y) / grid.cell - 0.5 * sum(step)
    ahead = max(0.0, math.ceil(along - NEAR) - along)
    by = ahead * grid.cell
    return ahead, Pose(pose.x + by * step[0], pose.y + by * step[1], pose.theta)


def _step(start: Pose, end: Pose) -> Cell:
    """Return the direction from one pose to another; (0, 0) where it follows no axis."""
    dx, dy = end.x - start.x, end.y - start.y
    if abs(dy) <= NEAR:
        return (1, 0) if dx > 0.0 else (-1, 0)
    if abs(dx) <= NEAR:
        return (0, 1) if dy > 0.0 else (0, -1)
    return (0, 0)
