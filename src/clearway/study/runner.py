"""Cells in, rows out: on whatever computes them, through the death of workers."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait

from clearway.study.experiment import Cell, Row
from clearway.study.workers import Crew, Workers

# A cell whose worker died so often is told as failed.
MOST_DEATHS = 3
# Calls handed to each slot, so that none waits for the next.
AHEAD = 2
# Seconds between looks at the clock while nothing is done.
TICK = 0.5


def rows_of(
    row: Callable[[Cell], Row],
    cells: Sequence[Cell],
    workers: Workers,
    tick: Callable[[], None] = lambda: None,
) -> Iterator[tuple[Cell, Row]]:
    """Yield the row of each cell once, as they are done.

    When a worker dies, the cells at work then are done again, one by one, each with a crew of
    its own, so that the one which kills its worker is found; its row is ``{"failed": why}``
    after the third death.

    Parameters
    ----------
    tick
        Called every half second at least.

    Raises
    ------
    ValueError
        If the row function refuses its input; names the cell.
    """
    left = {cell.key: cell for cell in cells}
    deaths: Counter[str] = Counter()
    while left:
        suspects = [cell for key, cell in left.items() if deaths[key]]
        batch = suspects[:1] or list(left.values())
        with workers() as crew:
            for cell, answer in _answers(row, batch, crew, tick):
                if answer is None:
                    deaths[cell.key] += 1
                    if deaths[cell.key] < MOST_DEATHS:
                        continue
                    answer = {"failed": f"its worker died {MOST_DEATHS} times"}
                del left[cell.key]
                yield cell, answer


def _answers(
    row: Callable[[Cell], Row], cells: Sequence[Cell], crew: Crew, tick: Callable[[], None]
) -> Iterator[tuple[Cell, Row | None]]:
    """Yield rows as they are done; ``None`` for cells at work when a worker died."""
    ahead = iter(cells)
    running: dict[Future[Row], Cell] = {}
    broken = False
    while True:
        while not broken and len(running) < AHEAD * crew.slots and (cell := next(ahead, None)):
            try:
                running[crew.executor.submit(_told, row, cell)] = cell
            except crew.deaths:
                broken = True
                yield cell, None
        if not running:
            return
        done, _ = wait(running, TICK, FIRST_COMPLETED)
        for future in done:
            cell = running.pop(future)
            try:
                answer = future.result()
            except crew.deaths:
                broken = True
                yield cell, None
            else:
                yield cell, answer
        tick()


def _told(row: Callable[[Cell], Row], cell: Cell) -> Row:
    """Call a row function in a worker.

    Errors about input carry more than a message and do not survive the way between processes,
    so they are told in words, with the cell.
    """
    try:
        return row(cell)
    except (ValueError, OSError) as error:
        raise ValueError(f"cell {cell.key}: {error}") from None
