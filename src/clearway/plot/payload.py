"""What the report's page is told: site, bodies, thinned tracks, visits and figures as JSON."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from clearway.metrics import Metrics, VisitTime, activities, to_json, visit_times
from clearway.metrics.motion import track_of
from clearway.model import LOAD_CHANGE, Footprint, PlanRecord, Robot, Site, Track, Visit
from clearway.plot.palette import robot_colour
from clearway.plot.thin import thin


def payload(record: PlanRecord, metrics: Metrics) -> dict[str, Any]:
    """Return the page's data; times in ms, other lengths and angles in m and rad."""
    doings = activities(record)
    return {
        "duration": max(
            [metrics.duration, metrics.makespan, *(t.t[-1] for t in record.tracks.values())]
        ),
        "site": site_of(record.site),
        "types": {
            name: {"body": shape_of(kind.footprint), "loaded": shape_of(kind.shape(loaded=True))}
            for name, kind in record.robot_types.items()
        },
        "robots": [
            {
                **_robot(record, robot),
                "colour": robot_colour(index),
                "activities": [
                    [a.kind, round(a.start * 1000), round(a.end * 1000), a.label]
                    for a in doings[robot.id]
                ],
            }
            for index, robot in enumerate(record.robots)
        ],
        "metrics": to_json(metrics),
        "bound_on_graph": flat(record.discrete_bound or {}),
        "run": {
            "scenario": record.scenario,
            "system": record.system,
            "seed": str(record.seed),
            "clearway": record.version,
            **flat(record.parameters),
        },
    }


def as_script(content: dict[str, Any]) -> str:
    """Return JSON that may stand inside a ``<script>`` element, whatever its strings hold."""
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False)
    for sign in "<>&\u2028\u2029":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return text


def carrying(tour: tuple[Visit, ...], made: tuple[VisitTime, ...]) -> list[list[int]]:
    """Return the spans ``[from, to]`` (ms) with a load on board; the last may have no end.

    A load is taken, and put down, at the end of a service.
    """
    spans: list[list[int]] = []
    loads = 0
    for visit in made:
        load = tour[visit.visit].load
        before = loads
        loads += LOAD_CHANGE[load]
        loads = max(loads, 0)
        if loads and not before:
            spans.append([round(visit.leave * 1000)])
        elif before and not loads:
            spans[-1].append(round(visit.leave * 1000))
    return spans


def modes_of(track: Track) -> list[tuple[int, str | None]]:
    """Return ``(from, mode)`` where the mode changes (ms)."""
    changes: list[tuple[int, str | None]] = []
    for time, mode in zip(track.t.tolist(), track.mode, strict=True):
        if not changes or changes[-1][1] != mode:
            changes.append((round(time * 1000), mode))
    return changes


def flat(settings: Mapping[str, Any]) -> dict[str, str]:
    """Return nested settings as text, one line each: ``plan.weight`` -> ``1.05``."""
    lines: dict[str, str] = {}
    for name, value in settings.items():
        if isinstance(value, Mapping):
            lines |= {f"{name}.{inner}": text for inner, text in flat(value).items()}
        else:
            lines[name] = str(value)
    return lines


def shape_of(footprint: Footprint) -> dict[str, Any]:
    """Return a body's radius, or its parts."""
    if footprint.radius:
        return {"radius": footprint.radius}
    return {"parts": footprint.parts}


def site_of(site: Site) -> dict[str, Any]:
    """Return bounds, obstacles and zones."""
    return {
        "bounds": site.bounds,
        "obstacles": [
            {
                "polygon": obstacle.polygon,
                "disc": obstacle.disc,
                "wall": obstacle.wall,
                "blocks": obstacle.blocks,
            }
            for obstacle in site.obstacles
        ],
        "zones": [
            {"name": zone.name, "kind": zone.kind, "polygon": zone.polygon} for zone in site.zones
        ],
    }


def _robot(record: PlanRecord, robot: Robot) -> dict[str, Any]:
    track = track_of(record, robot)
    tour = record.tours.get(robot.id, ())
    made = visit_times(record, robot)
    times = {entry.visit: entry for entry in made}
    return {
        "id": robot.id,
        "type": robot.type,
        "start": list(robot.start),
        "track": asdict(thin(track)),
        "modes": modes_of(track),
        "carrying": carrying(tour, made),
        "visits": [
            {
                "task": visit.task,
                "pose": list(visit.pose),
                "service": visit.service,
                "arrive": round(times[index].arrive * 1000) if index in times else None,
                "leave": round(times[index].leave * 1000) if index in times else None,
            }
            for index, visit in enumerate(tour)
        ],
    }
