"""The warehouse in which orders never end."""

import itertools

import pytest

from clearway.validate.legality import check_scenario
from clearway.world.lifelong import lifelong_warehouse
from clearway.world.shapes import body_shape, obstacle_shape


@pytest.mark.parametrize("fleet", ["cars", "carriers"])
def test_a_body_fits_at_every_place(fleet):
    """At 40 bays, 16 stations and 100 pick places a body touches nothing, and no other body at
    another place of the same kind; picks are 0.3 m apart."""
    scenario = lifelong_warehouse(40, 3, fleet=fleet)
    kind = scenario.type_of(scenario.robots[0])
    bodies = {
        what: [body_shape(kind.footprint, zone.pose) for zone in scenario.site.zones_of(what)]
        for what in ("parking", "station", "shelf")
    }
    assert {what: len(shapes) for what, shapes in bodies.items()} == {
        "parking": 40,
        "station": 16,
        "shelf": 100,
    }
    shelves = [obstacle_shape(obstacle) for obstacle in scenario.site.obstacles]
    for body in itertools.chain(*bodies.values()):
        assert min(body.gap(shelf) for shelf in shelves) > 0.1
    standing = bodies["parking"] + bodies["station"]
    assert min(a.gap(b) for a, b in itertools.combinations(standing, 2)) > 0.3
    assert min(a.gap(b) for a, b in itertools.combinations(bodies["shelf"], 2)) > 0.3 - 1e-9


def test_every_robot_starts_in_its_bay():
    """As many bays as robots, and the scenario is legal."""
    scenario = lifelong_warehouse(20, 1)
    bays = [zone.pose for zone in scenario.site.zones_of("parking")]
    assert [robot.start for robot in scenario.robots] == bays
    assert check_scenario(scenario)


def test_the_seed_draws_the_pick_places():
    assert lifelong_warehouse(5, 4) == lifelong_warehouse(5, 4)
    assert lifelong_warehouse(5, 4).site != lifelong_warehouse(5, 5).site


def test_what_does_not_fit_is_named():
    with pytest.raises(ValueError, match="robots: 1 to 61"):
        lifelong_warehouse(62, 1)
    with pytest.raises(ValueError, match="picks: only"):
        lifelong_warehouse(5, 1, picks=1000)
    with pytest.raises(ValueError, match="cars or carriers"):
        lifelong_warehouse(5, 1, fleet="boats")
