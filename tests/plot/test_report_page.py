"""The report's page in a real browser, without a network."""

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.plot.visitor import DESK, HOSTILE, PHONE, Visitor

from clearway.metrics import plan_metrics
from clearway.model import PlanRecord, Pose, Status
from clearway.plot.report import write_report

if TYPE_CHECKING:
    from playwright.sync_api import Browser


@pytest.fixture(scope="session")
def report(warehouse_record: PlanRecord, tmp_path_factory: pytest.TempPathFactory) -> Path:
    ids = [robot.id for robot in warehouse_record.robots]
    pairs = [(a, b, 0.5 + i, 10.0 * i) for i, a in enumerate(ids) for b in ids[i + 1 :]]
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_report(warehouse_record, plan_metrics(warehouse_record, pairs, 0), path)
    return path


@pytest.fixture
def desk(browser: "Browser", report: Path) -> Iterator[Visitor]:
    visitor = Visitor(browser, report, DESK)
    yield visitor
    visitor.close()


def pose_of(record: PlanRecord, robot: str, time: float) -> Pose:
    track = record.tracks[robot]
    x, y, theta = (
        float(np.interp(time, track.t, values))
        for values in (track.x, track.y, np.unwrap(track.theta))
    )
    return Pose(x, y, theta)


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("size", [PHONE, DESK, {"width": 2560, "height": 1440}])
def test_the_page_fits_and_asks_for_nothing(
    browser: "Browser", report: Path, size: dict[str, int], theme: str
) -> None:
    """On a phone and on a desk, by day and by night, nothing overflows, complains or phones."""
    visitor = Visitor(browser, report, size, color_scheme=theme)
    visitor.run("clearway.seek(30)")
    visitor.press("]", "+", "+", "f")
    visitor.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    assert visitor.page.evaluate("document.documentElement.dataset.theme") == theme
    wide = visitor.page.evaluate("document.documentElement.scrollWidth - innerWidth")
    inner = visitor.page.evaluate(
        "(() => { const box = document.querySelector('.transport').getBoundingClientRect();"
        " return [...document.querySelectorAll('.transport *')].filter((e) =>"
        " e.getBoundingClientRect().right > box.right + 1).map((e) => e.id); })()"
    )
    assert (wide, inner) == (0, [])
    assert visitor.complaints == []
    assert visitor.requests == [report.as_uri()]
    visitor.close()


def test_robots_are_where_the_plan_has_them(desk: Visitor, warehouse_record: PlanRecord) -> None:
    """At any moment each pose shown is the plan's to 1 cm and 1 degree."""
    for time in np.linspace(0.0, warehouse_record.makespan + 5.0, 60).tolist():
        desk.page.evaluate(f"clearway.seek({time})")
        moment = desk.time
        for robot, (x, y, theta) in desk.page.evaluate("clearway.poses()").items():
            pose = pose_of(warehouse_record, robot, moment)
            assert math.hypot(x - pose.x, y - pose.y) < 0.01
            assert abs(math.remainder(theta - pose.theta, 2 * math.pi)) < math.radians(1.0)


def test_playing_moves_time_and_robots(desk: Visitor) -> None:
    """Play lets time pass and robots move; pause stops both."""
    before = desk.page.evaluate("clearway.poses()")
    desk.page.get_by_role("button", name="Play", exact=True).click()
    desk.wait("clearway.time() > 0.5")
    desk.page.get_by_role("button", name="Pause", exact=True).click()
    desk.settle()
    moment, after = desk.time, desk.page.evaluate("clearway.poses()")
    assert before["R1"] != after["R1"]
    desk.settle()
    assert desk.time == moment


def test_the_slider_and_the_timeline_seek(desk: Visitor) -> None:
    """Setting the slider, or clicking the timeline, shows that moment."""
    desk.page.get_by_label("Time in the plan").fill("42")
    assert desk.time == pytest.approx(42.0)
    box = desk.page.locator("#gantt svg").bounding_box()
    assert box is not None
    desk.page.locator("#gantt svg").click(position={"x": box["width"] - 12, "y": 60})
    duration = desk.page.evaluate("clearway.view().duration")
    assert desk.time == pytest.approx(duration, rel=0.01)


def test_speed_is_chosen_from_a_list(desk: Visitor) -> None:
    """From a quarter of real time to 32 times."""
    for value in ("0.25", "32"):
        desk.page.get_by_label("Speed").select_option(value)
        assert desk.page.evaluate("clearway.view().speed") == float(value)


def test_all_of_it_works_from_the_keyboard(desk: Visitor, warehouse_record: PlanRecord) -> None:
    """Space plays, arrows and Home and End seek, plus and minus zoom, brackets choose."""
    assert desk.press("Space")["playing"]
    assert not desk.press("Space")["playing"]
    end = desk.press("End")["duration"]
    assert desk.time == pytest.approx(end)
    desk.press("Home")
    assert desk.time == 0.0
    desk.press("ArrowRight", "ArrowRight", "Shift+ArrowRight", "ArrowLeft", ".")
    assert desk.time == pytest.approx(11.1)
    assert desk.press("+")["zoom"] == pytest.approx(1.5)
    assert desk.press("-")["zoom"] == pytest.approx(1.0)
    assert desk.press("]")["chosen"] == "R1"
    assert desk.press("]", "]")["chosen"] == "R3"
    assert desk.press("[")["chosen"] == "R2"
    slow = desk.press("<")["speed"]
    assert desk.press(">")["speed"] == 2 * slow
    view = desk.press("f")
    pose = pose_of(warehouse_record, "R2", desk.time)
    assert math.hypot(view["x"] - pose.x, view["y"] - pose.y) < 0.02
    assert desk.press("Escape")["chosen"] is None
    assert desk.complaints == []


def test_space_on_a_button_presses_that_button_only(desk: Visitor) -> None:
    """With the focus on a button, space is the button's."""
    desk.page.get_by_role("button", name="Zoom in").focus()
    view = desk.press("Space")
    assert (view["zoom"], view["playing"]) == (pytest.approx(1.5), False)


def test_wheel_and_drag_move_the_view(desk: Visitor) -> None:
    """The wheel zooms about the pointer, a drag pans, and a fitted site lets the page scroll."""
    box = desk.page.locator("#floor").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    desk.page.mouse.move(x, y)
    desk.page.mouse.wheel(0, -240)
    desk.wait("clearway.view().zoom > 1.2")
    before = desk.page.evaluate("clearway.view()")
    desk.page.mouse.down()
    desk.page.mouse.move(x + 60, y, steps=4)
    desk.page.mouse.up()
    desk.settle()
    assert desk.page.evaluate("clearway.view().x") < before["x"]
    assert desk.page.evaluate("clearway.view().chosen") is None
    desk.page.get_by_role("button", name="Fit the whole site").click()
    desk.page.mouse.wheel(0, 300)
    desk.wait("scrollY > 100")
    assert desk.page.evaluate("clearway.view().zoom") == pytest.approx(1.0)


def test_two_fingers_zoom(browser: "Browser", report: Path) -> None:
    """Two fingers that move apart to twice their distance zoom in twofold."""
    visitor = Visitor(browser, report, PHONE, has_touch=True)
    visitor.page.locator("#floor").scroll_into_view_if_needed()
    box = visitor.page.locator("#floor").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    session = visitor.page.context.new_cdp_session(visitor.page)

    def touch(kind: str, gap: float) -> None:
        fingers = [{"x": x - gap, "y": y, "id": 0}, {"x": x + gap, "y": y, "id": 1}]
        points = fingers if kind != "touchEnd" else []
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", 40)
    for gap in (50, 60, 70, 80):
        touch("touchMove", gap)
    touch("touchEnd", 80)
    visitor.settle()
    assert visitor.page.evaluate("clearway.view().zoom") == pytest.approx(2.0, rel=0.05)
    visitor.close()


def test_a_click_on_a_body_tells_about_its_robot(desk: Visitor) -> None:
    """Who clicks on a body reads its id, mode, speed, task and nearest neighbour."""
    desk.run("clearway.seek(30)")
    (x, y, _), view = desk.page.evaluate("[clearway.poses().R3, clearway.view()]")
    desk.press("+", "+")
    view = desk.page.evaluate("clearway.view()")
    box = desk.page.locator("#floor").bounding_box()
    assert box is not None
    # Metres per pixel from the fitted site: 60 m of height, 24 pixels above and below, or
    # 100 m of width, 14 pixels left and right.
    fit = min((box["height"] - 48) / 60, (box["width"] - 28) / 100)
    scale = fit * view["zoom"]
    px = box["width"] / 2 + (x - view["x"]) * scale
    py = box["height"] / 2 - (y - view["y"]) * scale
    desk.page.mouse.move(box["x"] + px, box["y"] + py)
    desk.settle()
    tip = desk.page.locator("#tip").inner_text()
    assert "R3" in tip and "1.50 m/s" in tip and "task T5" in tip
    desk.page.mouse.click(box["x"] + px, box["y"] + py)
    desk.settle()
    card = desk.page.locator("#card").inner_text()
    assert all(word in card for word in ("R3", "forward", "1.50 m/s", "T5", "carrying"))


def test_the_theme_button_turns_day_into_night(desk: Visitor) -> None:
    """The button says what it will do, and does it."""
    day = desk.page.evaluate("getComputedStyle(document.body).backgroundColor")
    desk.page.get_by_role("button", name="Switch to dark colours").click()
    assert desk.page.evaluate("getComputedStyle(document.body).backgroundColor") != day
    desk.page.get_by_role("button", name="Switch to light colours").click()
    assert desk.page.evaluate("getComputedStyle(document.body).backgroundColor") == day


def test_the_closest_pairs_are_listed_first(desk: Visitor) -> None:
    """Eight of 28 pairs until asked for all; choosing a time shows that moment."""
    rows = desk.page.locator("#apart tbody tr")
    assert rows.count() == 8
    desk.page.get_by_role("button", name="Show all 28 pairs").click()
    assert rows.count() == 28
    desk.page.get_by_role("button", name="See R2 and R3").click()
    assert desk.time == pytest.approx(10.0)


def test_it_starts_by_itself_unless_motion_is_unwelcome(
    browser: "Browser", report: Path, desk: Visitor
) -> None:
    """Who prefers reduced motion finds the replay at rest."""
    assert not desk.page.evaluate("clearway.view().playing")
    eager = Visitor(browser, report, DESK, reduced_motion="no-preference")
    eager.wait("clearway.view().playing && clearway.time() > 0")
    eager.close()


def test_ids_are_never_markup(
    browser: "Browser", warehouse_record: PlanRecord, tmp_path: Path
) -> None:
    """An id may hold what it likes: it is shown as it is, and does nothing."""
    names = dict(zip([r.id for r in warehouse_record.robots], HOSTILE, strict=False))
    record = rename(warehouse_record, names)
    path = tmp_path / "hostile.html"
    pairs = [(HOSTILE[0], HOSTILE[1], 0.1, 2.0)]
    write_report(record, plan_metrics(record, pairs, 2), path)
    visitor = Visitor(browser, path, DESK)
    for name in HOSTILE:
        visitor.run(f"clearway.choose({json.dumps(name)})")
        assert visitor.page.evaluate("clearway.view().chosen") == name
        assert visitor.page.locator("#card h2").evaluate("(e) => e.textContent") == name
    tasks = visitor.page.locator("#work ol").first.inner_text()
    assert HOSTILE[0] in tasks
    assert visitor.page.locator("main b:not(#tip b), img").count() == 0
    assert visitor.page.title().startswith(HOSTILE[0])
    assert "2 violations" in visitor.page.locator(".banner.fault").inner_text()
    assert HOSTILE[0] in visitor.page.locator(".banner.stop").inner_text()
    assert visitor.complaints == []
    visitor.close()


def rename(record: PlanRecord, names: dict[str, str]) -> PlanRecord:
    """Return an unfinished plan whose robots, tasks, zones and scenario bear other names."""

    def new(old: str) -> str:
        return names.get(old, old)

    tours = {
        new(k): tuple(replace(v, task=HOSTILE[0] if v.task else None) for v in tour)
        for k, tour in record.tours.items()
    }
    zones = tuple(replace(zone, name=HOSTILE[0]) for zone in record.site.zones)
    return replace(
        record,
        scenario=HOSTILE[0],
        status=Status.STOPPED,
        reason=f"{HOSTILE[0]} found no way",
        site=replace(record.site, zones=zones),
        robots=tuple(replace(robot, id=new(robot.id)) for robot in record.robots),
        tours=tours,
        tracks={new(k): v for k, v in record.tracks.items()},
        paths={},
        assignment={new(k): (HOSTILE[0],) for k in record.assignment},
        parameters={HOSTILE[0]: HOSTILE[1]},
    )
