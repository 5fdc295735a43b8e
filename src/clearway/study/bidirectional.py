"""The experiments of system B's paper: two ways in a channel against one, and what is left."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from clearway.study.bidirectional_summary import summarise
from clearway.study.experiment import Cell, Row, Scale, Study

SEEDS, QUICK_SEEDS = 20, 2
LAYOUTS = ("bidirectional", "compact", "one_way")
# Dispatching rules and rules of traffic of each method.
METHODS: Mapping[str, Mapping[str, str]] = {
    "paper": {"dispatch": "nearest", "rules": "waiting"},
    "search": {"dispatch": "nearest", "rules": "search"},
    "ahead": {"dispatch": "ahead", "rules": "search"},
}


@dataclass(frozen=True)
class Point:
    """Robots and orders of a point of an experiment."""

    robots: int
    orders: int


E17 = tuple(Point(10, orders) for orders in (50, 100, 150, 200, 250))
E18 = tuple(Point(robots, 50) for robots in (5, 10, 15, 20))
E19 = tuple(Point(10, orders) for orders in (10, 15, 20, 25, 30, 35, 40))
EXPERIMENTS: Mapping[str, Sequence[Point]] = {"E17": E17, "E18": E18, "E19": E19}
QUICK = {"E17": (E17[0], E17[2]), "E18": (E18[0], E18[3]), "E19": (E19[0], E19[6])}

# Open points of the paper: each is turned alone, at these points of E17.
SENSITIVE = (E17[0], E17[2])
SENSITIVITY: Mapping[str, Mapping[str, Any]] = {
    "as chosen": {},
    "a turn takes 1 s": {"turn_seconds": 1.0},
    "blocks of 10, 10 and 9": {"blocks": [10, 10, 9]},
    "a shelf may be drawn again": {"repeat": True},
    "nearest by route": {"nearest": "route"},
    "literal map": {"map_mode": "literal"},
    "robots start all over the site": {"everywhere": True},
    "two cells a second": {"speed": 2.0},
    "residence of 5 s": {"residence": 5.0},
    "residence of 20 s": {"residence": 20.0},
}


def cells(scale: Scale) -> Sequence[Cell]:
    """Return all points, layouts and methods with 20 seeds; few of them in the quick version."""
    seeds = scale.seeds(SEEDS, QUICK_SEEDS)
    found = [
        Cell(
            {
                "experiment": name,
                "robots": point.robots,
                "orders": point.orders,
                "layout": layout,
                "method": method,
            },
            seed,
        )
        for name, points in (QUICK if scale.quick else EXPERIMENTS).items()
        for point in points
        for layout in LAYOUTS
        for method in METHODS
        for seed in seeds
    ]
    variants = list(SENSITIVITY)[:3] if scale.quick else list(SENSITIVITY)
    found += [
        Cell(
            {
                "experiment": "sensitivity",
                "robots": point.robots,
                "orders": point.orders,
                "layout": layout,
                "method": "paper",
                "variant": variant,
            },
            seed,
        )
        for variant in variants
        for point in (SENSITIVE[:1] if scale.quick else SENSITIVE)
        for layout in LAYOUTS[:2]
        for seed in seeds
        if (variant, layout) != ("literal map", "compact")
    ]
    return found


def row(cell: Cell) -> Row:
    """Return what came of one batch: run, judged on true bodies, and bounded from below."""
    from clearway.assign import ShelfParams
    from clearway.assign.yard_bound import makespan_bound
    from clearway.metrics.trace_metrics import trace_metrics
    from clearway.model import Layout
    from clearway.systems.simulate import run_through_time
    from clearway.validate.lane_trace import validate_on_lanes
    from clearway.validate.trace_judge import validate_trace
    from clearway.world.channels import lane_grid
    from clearway.world.shelf_batch import lower_left, shelf_batch

    settings = cell.settings
    more = dict(SENSITIVITY[settings.get("variant", "as chosen")])
    layout = Layout(settings["layout"], tuple(more.pop("blocks", (9, 9, 11))))
    scenario = shelf_batch(
        layout,
        settings["robots"],
        settings["orders"],
        cell.seed,
        zone=lower_left(layout) if settings["experiment"] == "E19" else None,
        repeat=more.pop("repeat", False),
        turn_seconds=more.pop("turn_seconds", 0.0),
        everywhere=more.pop("everywhere", False),
        speed=more.pop("speed", None),
        settings={**METHODS[settings["method"]], **more},
    )
    params = ShelfParams(residence=more.get("residence", 10.0))
    begin = time.process_time()
    run = run_through_time(scenario)
    spent = time.process_time() - begin
    violations = validate_trace(run.trace)
    if settings.get("variant") != "literal map":  # whose routes may leave the lanes
        violations += validate_on_lanes(run.trace, lane_grid(layout))
    figures = trace_metrics(run.trace)
    end = run.trace.events[-1]
    return {
        "status": run.status,
        "makespan": end["makespan"],
        "orders_done": end["orders_done"],
        "distance": end["distance"],
        "waiting": end["waiting"],
        "empty": figures.empty,
        "service": round(sum(each.service for each in figures.per_robot), 3),
        "conflicts": {k: n for k, n in run.counters.items() if " in " in k},
        "fallbacks": run.counters["fallbacks"],
        "lower_bound": makespan_bound(scenario, params),
        "violations": [str(violation) for violation in violations],
        "run_s": round(spent, 3),
    }


STUDY = Study(
    name="bidirectional",
    title="Two ways in a channel or one: Figs. 17 to 19 of system B's paper",
    version=1,
    setting=(
        "A warehouse of 406 shelves, 30 packing stations and 33 chargers on 36 x 31 cells, and two "
        "one-way counterparts: compact (34 x 23 cells) and one_way (the same floor).",
        "Robots drive a cell a second and turn in no time; a shelf stays 10 s at a station. All "
        "orders of a batch are known at 0 s; a seed draws the same shelves on all layouts.",
        "The makespan ends when the last shelf is put down. Every run is judged on true bodies and "
        "cell by cell.",
    ),
    parts={
        "paper": "the paper's dispatching and waiting rules",
        "search": "the paper's dispatching, each way searched for in space and time",
        "ahead": "orders, stations and places chosen together, ways searched for",
    },
    cells=cells,
    row=row,
    summarise=summarise,
)
