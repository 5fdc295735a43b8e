"""Which shelf goes to which place."""

import numpy as np

from clearway.assign.place_matching import match_places

# Endpoints on a line at 0 to 5 m; station at 0, places at 1, 3 and 5.
FAR = np.abs(np.subtract.outer(np.arange(6.0), np.arange(6.0)))
NOWHERE = np.zeros(3)


def test_nobody_takes_the_place_that_another_needs_more() -> None:
    """A's next shelf is at 0, b's at 2: alone both want 1, in sum a had better take it.

    A at 1 and b at 3 drive 1 + 1 + 3 + 1 s; the other way round it were 1 + 1 + 3 + 3 s.
    """
    bring = {"b": (0, [0]), "a": (0, [0])}
    places = [1, 3, 5]
    onward = {"a": FAR[places, 0], "b": FAR[places, 2]}
    assert match_places(FAR, bring, places, onward, None, 3) == {"a": 1, "b": 3}


def test_who_stores_now_needs_a_place_that_is_vacant_now() -> None:
    bring = {"a": (0, [0])}
    onward = {"a": NOWHERE}
    assert match_places(FAR, bring, [5, 3, 1], onward, None, 1) == {"a": 1}
    assert match_places(FAR, bring, [5, 3, 1], onward, "a", 1) == {"a": 5}


def test_the_best_station_counts() -> None:
    """From 2, place 5 is 3 m away by the station at 4, and place 1 is 3 m by the one at 0."""
    onward = {"a": np.array([0.0, 0.5])}
    assert match_places(FAR, {"a": (2, [0, 4])}, [1, 5], onward, None, 2) == {"a": 1}
    assert match_places(FAR, {"a": (2, [4])}, [1, 5], onward, None, 2) == {"a": 5}
