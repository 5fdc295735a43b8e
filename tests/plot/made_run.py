"""A run to look at, made without any planner: robots fetch shelves, and ignore each other."""

import itertools
import math
import random
from collections.abc import Iterator
from typing import Any

import numpy as np

from clearway.model import Battery, Footprint, Limits, Pose, Robot, RobotType, Site, Trace, Zone

Cell = tuple[int, int]
Event = dict[str, Any]

STEP = 0.1
CART = RobotType(
    "cart",
    Footprint.rectangle(0.8, 0.8),
    "holonomic",
    Limits(1.0),
    battery=Battery(5000.0),
)


def _zone(name: str, kind: str, cell: Cell) -> Zone:
    x, y = cell
    corners = ((x, y), (x + 1.0, y), (x + 1.0, y + 1.0), (x, y + 1.0))
    return Zone(name, kind, corners, Pose(x + 0.5, y + 0.5, 0.0))


def lanes() -> Site:
    """Return 36 m by 31 m with 406 shelf places, 30 stations and 33 chargers."""
    rows = [y for k in range(7) for y in (4 * k + 2, 4 * k + 3)]
    columns = [*range(3, 12), *range(14, 23), *range(25, 36)]
    shelves = [(x, y) for y in rows for x in columns]
    zones = [_zone(f"s{k + 1}", "shelf", cell) for k, cell in enumerate(shelves)]
    zones += [_zone(f"p{y + 1}", "station", (0, y)) for y in range(30)]
    zones += [_zone(f"c{x - 2}", "charger", (x, 30)) for x in range(3, 36)]
    return Site(((0.0, 0.0), (36.0, 0.0), (36.0, 31.0), (0.0, 31.0)), zones=tuple(zones))


def _corners(start: Cell, goal: Cell) -> list[Cell]:
    """Return the turning points of a way along the channels."""
    (x0, y0), (x1, y1) = start, goal
    first, last = _channel(y0), _channel(y1)
    down = min((1, 12, 23), key=lambda x: abs(x - x0) + abs(x - x1))
    way = [start, (x0, first), (down, first), (down, last), (x1, last), goal]
    return [cell for cell, _ in itertools.groupby(way)]


def _channel(y: int) -> int:
    return 4 * ((y + 1) // 4) if y < 30 else 29


class Cart:
    """One robot that writes down what it does."""

    def __init__(self, robot: Robot, cell: Cell, events: list[Event], rng: random.Random) -> None:
        self.id, self.cell, self.now, self.place = robot.id, cell, 0.0, ""
        self.events, self.rng, self.level, self.heading = events, rng, 1.0, 0.0

    def tell(self, event: str, **facts: Any) -> None:
        self.events.append({"event": event, "t": round(self.now, 6), "robot": self.id, **facts})

    def drive(self, zone: Zone, others: list[str]) -> None:
        """Drive to a zone; now and then wait for somebody, or stop for no reason."""
        assert zone.pose is not None
        way = _corners(self.cell, (int(zone.pose.x), int(zone.pose.y)))
        for (x0, y0), (x1, y1) in itertools.pairwise(way):
            if self.rng.random() < 0.25:
                self._stand(others)
            length = math.hypot(x1 - x0, y1 - y0)
            share = np.linspace(0.0, 1.0, max(2, round(length / STEP) + 1))
            x, y = x0 + 0.5 + share * (x1 - x0), y0 + 0.5 + share * (y1 - y0)
            theta = np.full(len(share) + 1, math.atan2(y1 - y0, x1 - x0))
            # A turn takes no time: two headings at one moment.
            theta[0], self.heading = self.heading, float(theta[-1])
            x, y = np.insert(x, 0, x[0]), np.insert(y, 0, y[0])
            t = np.round(self.now + np.insert(share, 0, 0.0) * length, 6)
            self.events.append(
                {"event": "motion", "robot": self.id, "t": t.tolist(), "x": x.tolist()}
                | {"y": y.tolist(), "theta": theta.tolist()}
            )
            self.now += length
            self.level -= 0.0002 * length
        self.cell, self.place = way[-1], zone.name
        self.tell("energy", level=round(self.level, 6))

    def _stand(self, others: list[str]) -> None:
        seconds = self.rng.uniform(1.0, 20.0)
        if self.rng.random() < 0.15:
            self.tell("fault", kind="stop", state="stopped")
            self.tell("wait", until=round(self.now + seconds, 6), because="", **{"for": ["stop"]})
            self.now += seconds
            self.tell("fault", kind="stop", state="moving")
            return
        names = self.rng.sample(others, self.rng.choice((1, 1, 1, 2)))
        because = "it enters the crossing at (12, 8) first: it comes from the right"
        self.tell("wait", until=round(self.now + seconds, 6), because=because, **{"for": names})
        self.now += seconds

    def serve(self, zone: Zone, order: str | None, purpose: str, service: float) -> None:
        pose, task = list(zone.pose or ()), f"{order}/{purpose}" if order else None
        place: Event = {"place": zone.name, "purpose": purpose, "pose": pose, "service": service}
        self.tell("visit", task=task, order=order, state="arrived", **place)
        self.now += service
        self.tell("visit", task=task, order=order, state="left")

    def decide(self, order: str | None, purpose: str, kind: str, zone: Zone, rest: str) -> None:
        score = self.rng.uniform(5.0, 40.0)
        others = [{"name": f"{kind}-{k}", "score": round(score + 3.7 * k, 3)} for k in range(1, 9)]
        goal = (int(zone.pose.x), int(zone.pose.y)) if zone.pose else self.cell
        self.tell(
            "decision",
            order=order,
            purpose=purpose,
            kind=kind,
            chosen=order if kind == "order" else zone.name,
            score=round(score, 3),
            alternatives=others,
            because="least way to go",
            outcome="committed",
            reason=None,
            causes=[],
            route=[[x + 0.5, y + 0.5] for x, y in _corners(self.cell, goal)],
            rest=rest,
            arrive=[round(self.now + abs(goal[0] - self.cell[0]) + abs(goal[1] - self.cell[1]), 6)],
            cpu_s=0.004,
        )


def made_run(robots: int = 20, seconds: float = 2000.0, seed: int = 1) -> Trace:
    """Return a run in which orders arrive about as fast as they are done."""
    rng = random.Random(seed)
    site = lanes()
    of = {kind: site.zones_of(kind) for kind in ("shelf", "station", "charger")}
    fleet = [Robot(f"agv-{k + 1}", "cart", of["charger"][k % 33].pose) for k in range(robots)]  # type: ignore[arg-type]
    events: list[Event] = []
    carts = [Cart(robot, (3 + k % 33, 30), events, rng) for k, robot in enumerate(fleet)]
    others = {cart.id: [other.id for other in carts if other is not cart] for cart in carts}
    for number, release in enumerate(_releases(rng, robots / 130.0, seconds)):
        order, shelf = f"o{number + 1}", of["shelf"][(7 * number) % 406]
        cart = min(carts, key=lambda each: each.now)
        due = round(release + 400.0, 6)
        told: Event = {"fetches": shelf.name, "due": due, "priority": 0.0, "visits": 3}
        told |= {"event": "order", "t": release, "order": order, "state": "released"}
        events.append(told)
        if cart.now < release:
            cart.tell("wait", until=None, because="", **{"for": ["order"]})
            cart.now = release
        _do(cart, order, shelf, of, others[cart.id])
    cut = [e for e in events if (e["t"][0] if e["event"] == "motion" else e["t"]) <= seconds]
    cut.append(_obstacle(0.3 * seconds, "closed"))
    cut.append(_obstacle(0.4 * seconds, "open"))
    cut.sort(key=lambda e: e["t"][0] if e["event"] == "motion" else e["t"])
    done = sum(1 for e in cut if e["event"] == "order" and e["state"] == "done")
    released = sum(1 for e in cut if e["event"] == "order" and e["state"] == "released")
    end: Event = {"event": "end", "t": seconds, "status": "ended", "makespan": seconds}
    end |= {"orders_done": done, "orders_open": released - done, "distance": 0.0, "waiting": 0.0}
    return Trace(
        scenario="warehouse with lanes",
        system="bidirectional",
        seed=seed,
        site=site,
        robot_types={"cart": CART},
        robots=tuple(fleet),
        events=(*cut, end),
        is_whole=True,
        parameters={"dispatch": {"look_ahead": 3}},
        version="0.1.0",
    )


def _releases(rng: random.Random, rate: float, seconds: float) -> Iterator[float]:
    now = 0.0
    while True:
        now += rng.expovariate(rate)
        if now > seconds:
            return
        yield round(now, 6)


def _do(cart: Cart, order: str, shelf: Zone, of: dict[str, Any], others: list[str]) -> None:
    station, charger = cart.rng.choice(of["station"]), cart.rng.choice(of["charger"])
    cart.decide(order, "fetch", "order", shelf, shelf.name)
    cart.tell("order", order=order, state="assigned")
    cart.drive(shelf, others)
    cart.tell("order", order=order, state="started")
    cart.serve(shelf, order, "fetch", 2.0)
    cart.tell("load", objects=[shelf.name])
    cart.decide(order, "deliver", "station", station, station.name)
    cart.drive(station, others)
    cart.serve(station, order, "deliver", 10.0)
    cart.decide(order, "store", "location", shelf, shelf.name)
    cart.drive(shelf, others)
    cart.serve(shelf, order, "store", 2.0)
    cart.tell("load", objects=[])
    cart.tell("order", order=order, state="done")
    if cart.level < 0.85:
        cart.decide(None, "charge", "charger", charger, charger.name)
        cart.drive(charger, others)
        cart.serve(charger, None, "charge", 60.0)
        cart.level = 1.0
        cart.tell("energy", level=1.0)


def _obstacle(at: float, state: str) -> Event:
    corners = [[12.0, 12.0], [14.0, 12.0], [14.0, 13.5], [12.0, 13.5]]
    return {"event": "fault", "t": round(at, 6), "kind": "obstacle", "zone": "spill"} | {
        "polygon": corners,
        "state": state,
    }
