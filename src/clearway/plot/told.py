"""Sentences on what a trace tells: orders, decisions, ways and waits.

They hold for as long as what they tell of, so a page can carry them and show each in its time.
"""

from collections.abc import Sequence

from clearway.plot.chronicle import Hold
from clearway.plot.doings import Doing, Event, Span

# Beyond these many, alternatives and turning points are counted instead of named.
NAMED = 4
TURNS = 8

_TASKS = {
    "order": "serving order {}",
    "fetch": "fetching the shelf for order {}",
    "deliver": "bringing the shelf of order {} to a station",
    "store": "storing the shelf of order {}",
    "charge": "going to charge",
    "park": "going to park",
}
_CAUSES = {
    "station": "station {} to be free",
    "charger": "charger {} to be free",
    "zone": "zone {}",
    "obstacle": "the obstacle {} to go",
    "location": "a free place to store a shelf",
    "order": "an order",
}


def seconds(time: float) -> str:
    """Return a moment as ``312.0 s``."""
    return f"{time:.1f} s"


def listed(names: Sequence[str]) -> str:
    """Return ``a``, ``a and b``, or ``a, b and c``."""
    return " and ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))


def cause_of(cause: str) -> str:
    """Return a cause in words; robots are named by their ids."""
    kind, _, name = cause.partition(":")
    return (
        _CAUSES[kind].format(name) if kind in _CAUSES and kind + ":" + name != "order:" else cause
    )


def of_doing(doing: Doing) -> str:
    """Tell what a robot does, since when, and why if it stands."""
    since, event = f"since {seconds(doing.start)}", doing.event
    place = f" at {event['place']}" if event.get("place") else ""
    until = event.get("until")
    match doing.kind:
        case "drive":
            return f"Drives {since}."
        case "turn":
            return f"Turns on the spot {since}."
        case "service":
            return f"Is at work{place} {since}{_for(event)}."
        case "charge":
            return f"Charges{place} {since}{_for(event)}."
        case "stop":
            on = f"; it goes on at {seconds(doing.end)}" if doing.end > doing.start else ""
            return f"Has stopped by itself {since}{on}."
        case "wait":
            causes = listed([cause_of(cause) for cause in event["for"]])
            because = f": {event['because']}" if event.get("because") else ""
            on = f" Expects to go on at {seconds(until)}." if until is not None else ""
            return f"Waits {since} for {causes}{because}.{on}"
        case "refused":
            reason = f": {event['reason']}" if event.get("reason") else ""
            order = f" for order {event['order']}" if event.get("order") else ""
            against = listed([cause_of(cause) for cause in event.get("causes") or ()])
            against = f" Against it: {against}." if against else ""
            return f"Stands without a plan{order} {since}{reason}.{against}"
        case "idle":
            return f"Has nothing to do {since}."
    return f"Stands {since}; the trace does not say why."


def of_trip(trip: Span, order: Sequence[Event], decisions: Sequence[Event]) -> list[str]:
    """Tell what a trip is for, how it was chosen, and its way.

    Parameters
    ----------
    order, decisions
        Events of the order it serves, and the committed decisions for it.
    """
    decision = trip.event
    purpose, name = decision.get("purpose") or "order", decision.get("order")
    task = _TASKS.get(purpose, f"on a trip to {purpose}").format(name or "")
    lines = [f"Is {task}, since {seconds(trip.start)}{_order_facts(order)}."]
    if decisions and decisions[0] is not decision:
        lines.append(of_decision(decisions[0]))
    lines.append(of_decision(decision))
    way = _way(decision)
    return [*lines, way] if way else lines


def of_rest(last: Span | None) -> list[str]:
    """Tell what a robot without a trip has done last."""
    if last is None:
        return []
    rest = last.event.get("rest")
    goes = f"; it was to rest at {rest} then" if rest else ""
    return [f"Has had no trip since {seconds(last.end)}{goes}."]


def of_decision(decision: Event) -> str:
    """Tell what was chosen, why, and what the alternatives would have cost."""
    kind, chosen = decision["kind"], decision.get("chosen")
    if kind == "detour":
        return f"At {seconds(decision['t'])} it {chosen}: {decision['because']}."
    told = f"{kind.capitalize()} {chosen} was chosen at {seconds(decision['t'])}"
    if decision.get("score") is not None:
        told += f" (score {decision['score']:.4g})"
    if decision.get("because"):
        told += f": {decision['because']}"
    others = [each for each in decision.get("alternatives") or () if each["name"] != chosen]
    if not others:
        return f"{told}. There was nothing else to choose."
    others.sort(key=lambda each: each["score"])
    named = [f"{each['name']} ({each['score']:.4g})" for each in others[:NAMED]]
    more = len(others) - NAMED
    return f"{told}. Next best: {listed([*named, *([f'{more} more'] if more > 0 else [])])}."


def of_hold(place: str, hold: Hold, time: float) -> str:
    """Tell how a place is a robot's."""
    if hold.come <= time:
        return f"Has {place}, since {seconds(hold.come)}."
    return f"Has {place} promised, since {seconds(hold.promised)}."


def _for(event: Event) -> str:
    return f", for {seconds(event['service'])}" if event.get("service") else ""


def _order_facts(order: Sequence[Event]) -> str:
    released = next((event for event in order if event["state"] == "released"), None)
    if released is None:
        return ""
    told = f"; the order came at {seconds(released['t'])}"
    if released.get("due") is not None:
        told += f", is due at {seconds(released['due'])}"
    if released.get("priority"):
        told += f", has priority {released['priority']:.4g}"
    if released.get("fetches"):
        told += f" and needs shelf {released['fetches']}"
    return told


def _way(decision: Event) -> str:
    route = decision.get("route") or ()
    parts = []
    if route:
        points = [f"({x:.4g}, {y:.4g})" for x, y in route[:TURNS]]
        more = f" and {len(route) - TURNS} more turns" if len(route) > TURNS else ""
        parts.append(f"by {' - '.join(points)}{more}")
    if decision.get("arrive"):
        parts.append(f"arriving at {listed([seconds(time) for time in decision['arrive']])}")
    if decision.get("rest"):
        parts.append(f"then to rest at {decision['rest']}")
    return f"Its way as planned: {', '.join(parts)}." if parts else ""
