"""The page of a run in a real browser: it says what the trace says, at every moment."""

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.plot.made_run import made_run
from tests.plot.visitor import DESK, HOSTILE, PHONE, Visitor

from clearway.metrics import trace_metrics
from clearway.model import Trace
from clearway.plot.chronicle import chronicle
from clearway.plot.explain import as_json, explain
from clearway.plot.trace_report import write_trace_report

if TYPE_CHECKING:
    from playwright.sync_api import Browser

SECONDS = 600.0


def waiting_for_places(trace: Trace) -> Trace:
    """Return the run with a third of its waits for whatever place the robot goes to next."""
    events = []
    for number, event in enumerate(trace.events):
        if event["event"] == "wait" and number % 3 == 0 and event["for"][0].startswith("agv"):
            event = {**event, "for": [f"station:p{1 + number % 30}", *event["for"]]}
        events.append(event)
    return replace(trace, events=tuple(events))


def written(trace: Trace, path: Path, violations: int = 0) -> Path:
    write_trace_report(trace, trace_metrics(trace), path, violations)
    return path


@pytest.fixture(scope="module")
def run() -> Trace:
    return waiting_for_places(made_run(robots=12, seconds=SECONDS))


@pytest.fixture(scope="module")
def report(run: Trace, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(run, tmp_path_factory.mktemp("run") / "report.html")


@pytest.fixture
def desk(browser: "Browser", report: Path) -> Iterator[Visitor]:
    visitor = Visitor(browser, report, DESK)
    yield visitor
    visitor.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("size", [PHONE, {"width": 820, "height": 900}, DESK])
def test_the_page_fits_and_asks_for_nothing(
    browser: "Browser", report: Path, size: dict[str, int], theme: str
) -> None:
    """On a phone and on a desk, by day and by night, nothing overflows, complains or phones."""
    visitor = Visitor(browser, report, size, color_scheme=theme)
    visitor.run("clearway.seek(300)")
    visitor.press("]", "+", "f")
    visitor.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    assert visitor.page.evaluate("document.documentElement.scrollWidth - innerWidth") == 0
    assert visitor.complaints == []
    assert visitor.requests == [report.as_uri()]
    visitor.close()


def test_the_chain_is_the_one_that_explain_gives(desk: Visitor, run: Trace) -> None:
    """Of every robot, at 200 moments: the same links, sentences and ends."""
    happened = chronicle(run)
    keys = ("robot", "depth", "state", "for", "ends", "sentences")
    seen: set[tuple[str, str]] = set()
    script = "([time, ids]) => { clearway.seek(time); return ids.map((id) => clearway.chain(id)); }"
    for time in np.random.default_rng(3).uniform(0.0, happened.duration, 200).round(3).tolist():
        shown = desk.page.evaluate(script, [time, list(happened.diaries)])
        for robot, chain in zip(happened.diaries, shown, strict=True):
            links = as_json(explain(happened, robot, time), time)["chain"]
            assert chain == [{key: link[key] for key in keys} for link in links]
            seen |= {(link["state"], link["ends"]) for link in links}
    # All of it was tried: roots of several kinds, cycles, and robots told elsewhere.
    assert {state for state, ends in seen if ends == "root"} >= {"moving", "at work"}
    assert {ends for _, ends in seen} == {"", "root", "cycle", "told"}


def test_robots_are_where_the_trace_has_them(desk: Visitor, run: Trace) -> None:
    """At any moment each pose shown is the trace's to 1 cm."""
    tracks = {name: diary.track for name, diary in chronicle(run).diaries.items()}
    for time in np.linspace(0.0, SECONDS, 30).tolist():
        desk.page.evaluate(f"clearway.seek({time})")
        for robot, (x, y, _) in desk.page.evaluate("clearway.poses()").items():
            track = tracks[robot]
            there = np.interp(time, track.t, track.x), np.interp(time, track.t, track.y)
            assert math.hypot(x - there[0], y - there[1]) < 0.01


def test_a_click_on_a_bar_tells_why(desk: Visitor) -> None:
    """The timeline's third row is the third robot's: the click shows that moment and its chain."""
    canvas = desk.page.locator("#timeline canvas")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    assert box is not None
    canvas.click(position={"x": box["width"] / 2, "y": 24 + 22 * 2.5})
    desk.settle()
    assert desk.page.evaluate("clearway.view().chosen") == "agv-3"
    assert desk.time == pytest.approx(SECONDS / 2, rel=0.1)
    first = desk.page.evaluate("clearway.chain('agv-3')")[0]
    why = desk.page.locator("#why").inner_text()
    assert all(sentence in why for sentence in first["sentences"])
    assert (
        desk.page.evaluate("clearway.chain('agv-3').length")
        == desk.page.locator(".link-of").count()
    )


def test_the_timeline_tells_what_is_under_the_pointer(desk: Visitor, run: Trace) -> None:
    """Over a robot's first service: its id, where it is at work, and for which order."""
    first = next(e for e in run.of("visit") if e["robot"] == "agv-2" and e["state"] == "arrived")
    canvas = desk.page.locator("#timeline canvas")
    desk.run(f"clearway.seek({first['t'] + 1.0})")
    desk.page.locator("#span").select_option("60")
    canvas.scroll_into_view_if_needed()
    desk.settle()
    box = canvas.bounding_box()
    assert box is not None
    # The cursor lies over the moment shown, unless the minute begins with the run.
    left = 24 + 7.6 * len("agv-12")
    share = min(0.4, (first["t"] + 1.0) / 60.0)
    x = left + share * (box["width"] - left - 12)
    desk.page.mouse.move(box["x"] + x, box["y"] + 24 + 22 * 1.5)
    tip = desk.page.locator("#timeline .tip").inner_text()
    assert "agv-2" in tip and f"at work, {first['place']}" in tip
    assert f"order {first['order']}" in tip


def test_some_minutes_of_the_timeline_follow_the_replay(desk: Visitor) -> None:
    """With one minute shown, a click right of the cursor leads less than a minute on."""
    desk.page.locator("#span").select_option("60")
    desk.run("clearway.seek(300)")
    canvas = desk.page.locator("#timeline canvas")
    box = canvas.bounding_box()
    assert box is not None
    canvas.click(position={"x": box["width"] - 20, "y": 60})
    assert 330.0 < desk.time < 340.0


def test_shelves_leave_their_places_and_come_back(desk: Visitor, run: Trace) -> None:
    """A shelf's place is vacant from the end of its fetch to the end of its storing."""
    loads = [event for event in run.of("load") if event["robot"] == "agv-1"]
    taken, stored = loads[0], loads[1]
    (shelf,) = taken["objects"]
    times = (taken["t"] - 1.0, taken["t"] + 1.0, stored["t"] - 1.0, stored["t"] + 1.0)
    shown = []
    for time in times:
        desk.page.evaluate(f"clearway.seek({time})")
        shown.append(desk.page.evaluate("(name) => clearway.shelf(name)", shelf))
    assert shown == [shelf, None, None, shelf]


def test_orders_are_found(desk: Visitor, run: Trace) -> None:
    """Twenty until asked for all; by state, and by what they fetch; choosing one goes there."""
    orders = {event["order"]: event for event in run.of("order")}
    rows = desk.page.locator("#orders tbody tr")
    assert rows.count() == 20
    desk.page.get_by_role("button", name=f"Show all {len(orders)}").click()
    assert rows.count() == len(orders)
    desk.page.get_by_label("Which orders").select_option("open")
    still = sum(event["state"] != "done" for event in orders.values())
    assert f"of {still} shown" in desk.page.locator("#orders [role=status]").inner_text()
    desk.page.get_by_label("Which orders").select_option("all")
    started = next(e for e in run.of("order") if e["state"] == "started")
    fetched = next(e for e in run.of("order") if e["order"] == started["order"])["fetches"]
    desk.page.get_by_label("Find orders").fill(fetched)
    assert started["order"] in desk.page.locator("#orders tbody").inner_text()
    desk.page.get_by_role("button", name=started["order"], exact=True).click()
    assert desk.time == pytest.approx(started["t"], abs=0.01)
    assert desk.page.evaluate("clearway.view().chosen") == started["robot"]


def test_a_run_says_how_it_ended(browser: "Browser", run: Trace, tmp_path: Path) -> None:
    """One that was cut short, and one that the judge condemned, say so above everything else."""
    cut = replace(run, events=run.events[:-1], is_whole=False)
    visitor = Visitor(browser, written(cut, tmp_path / "cut.html", violations=2), PHONE)
    assert visitor.page.locator(".badge").inner_text() == "Cut short"
    assert "ends in the middle" in visitor.page.locator(".banner.stop").inner_text()
    assert "2 violations" in visitor.page.locator(".banner.fault").inner_text()
    visitor.close()


def test_a_run_in_which_nothing_happens_is_shown(
    browser: "Browser", run: Trace, tmp_path: Path
) -> None:
    """No events at all, and no robots: the page opens and complains of nothing."""
    for robots in (run.robots, ()):
        empty = replace(run, events=(), is_whole=False, robots=robots)
        visitor = Visitor(browser, written(empty, tmp_path / "empty.html"), DESK)
        visitor.press("]")
        assert visitor.complaints == []
        visitor.close()


def test_names_are_never_markup(browser: "Browser", run: Trace, tmp_path: Path) -> None:
    """Ids, orders and reasons may hold what they like: they are shown, and do nothing."""
    names = {robot.id: name for robot, name in zip(run.robots, HOSTILE, strict=False)}

    def renamed(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: renamed(inner) for key, inner in value.items()}
        if isinstance(value, list):
            return [renamed(inner) for inner in value]
        if isinstance(value, str):
            return names.get(value, HOSTILE[1] if value.startswith("it enters") else value)
        return value

    robots = tuple(replace(robot, id=names.get(robot.id, robot.id)) for robot in run.robots)
    events = tuple(renamed(dict(event)) for event in run.events)
    hostile = replace(run, robots=robots, events=events, scenario=HOSTILE[0])
    visitor = Visitor(browser, written(hostile, tmp_path / "hostile.html"), DESK)
    for name in HOSTILE:
        visitor.run(f"clearway.choose({json.dumps(name)})")
        for time in (100, 250, 400):
            visitor.run(f"clearway.seek({time})")
            assert name in visitor.page.locator("#why").evaluate("(e) => e.textContent")
    assert visitor.page.locator("img, #why b, #why script").count() == 0
    assert visitor.complaints == []
    visitor.close()
