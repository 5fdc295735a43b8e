"""Prices of all moves from one set of routes to its neighbours, a neighbourhood at a time.

A leg's price is a pair: its distance, and what it adds to the weighted sum of distances and
turns. The longest route is added when a move is judged as a whole.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clearway.protocols import AssignmentProblem

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Routes = list[list[int]]


class Legs:
    """Prices of legs, ``prices[robot, from, to]``; number n is the start, and the end.

    A leg that may not be driven has a price that no sum of others reaches, in the weighted
    part only. ``evaluations`` counts the moves priced so far.
    """

    def __init__(self, problem: AssignmentProblem) -> None:
        m, n = problem.start_to_task.shape
        weights = problem.weights
        self.num_robots, self.num_tasks, self.evaluations = m, n, 0
        self.max_weight = weights.max_distance
        distance = np.zeros((m, n + 1, n + 1))
        distance[:, :n, :n] = problem.task_to_task
        distance[:, n, :n] = problem.start_to_task
        distance[:, :, :n] += problem.inner[:, None, :]
        forbidden = ~np.isfinite(distance)
        forbidden[:, :, :n] |= ~problem.allowed[:, None, :]
        distance[forbidden] = 0.0
        turn = np.zeros((m, n + 1, n + 1))
        turn[:, :n, :n] = problem.task_turn
        turn[:, n, :n] = problem.start_turn
        price = weights.total_distance * distance + weights.turning * turn
        dearest = price.max(initial=0.0) + weights.max_distance * distance.max(initial=0.0)
        price[forbidden] = 1.0 + 2.0 * n * dearest
        self.prices = np.stack([distance, price], axis=-1)


@dataclass(frozen=True)
class Move:
    """The change of value that a move brings, and the routes it leads to."""

    change: float
    apply: Callable[[], Routes]


class View:
    """Routes laid end to end, each led by its start, with all that moves are priced from.

    ``nodes`` holds the tasks (and n for starts) by position, ``owner`` the robot, ``after``
    the node that follows (n for the end) and ``rank`` the position within the route.
    """

    def __init__(self, legs: Legs, routes: Sequence[Sequence[int]], seats: int) -> None:
        n, m = legs.num_tasks, legs.num_robots
        self.legs, self.routes, self.seats = legs, routes, seats
        self.nodes = np.array([node for route in routes for node in (n, *route)], dtype=np.int64)
        self.counts = np.array([len(route) for route in routes], dtype=np.int64)
        self.owner = np.repeat(np.arange(m), self.counts + 1)
        self.first = np.cumsum(self.counts + 1) - self.counts - 1
        self.rank = np.arange(len(self.nodes)) - self.first[self.owner]
        self.after = np.append(self.nodes[1:], n)
        self.tasks = np.flatnonzero(self.rank)
        arrival = np.zeros((len(self.nodes), 2))
        here = self.tasks
        arrival[here] = legs.prices[self.owner[here], self.nodes[here - 1], self.nodes[here]]
        self.arrival = arrival
        self.driven = _sums_within(arrival, self.first[self.owner])
        self.lengths = self.driven[self.first + self.counts]
        self.longest = float(self.lengths[:, 0].max(initial=0.0))
        self.others = _longest_of_others(self.lengths[:, 0])

    @property
    def value(self) -> float:
        """The objective of the routes."""
        return float(self.lengths[:, 1].sum()) + self.legs.max_weight * self.longest

    def judged(self, longest: Floats, price: Floats, legal: Bools) -> Floats:
        """Return changes of value; infinite where not legal."""
        self.legs.evaluations += price.size
        change = price + self.legs.max_weight * (longest - self.longest)
        return np.where(legal, change, np.inf)


def insertions(view: View, tasks: Ints) -> Floats:
    """Return what it adds to put each task after each position, ``(num_tasks, num_positions)``."""
    prices, k = view.legs.prices, view.owner
    added = prices[k, view.nodes, tasks[:, None]] + prices[k, tasks[:, None], view.after]
    added -= prices[k, view.nodes, view.after]
    longest = np.maximum(view.others[k, k], view.lengths[k, 0] + added[..., 0])
    room = np.broadcast_to(view.counts[k] < view.seats, longest.shape)
    return view.judged(longest, added[..., 1], room)


def relocate(view: View, size: int, turned: bool) -> Move | None:
    """Take ``size`` tasks in a row out and put them, turned or not, after another position."""
    prices, nodes, owner = view.legs.prices, view.nodes, view.owner
    at = view.tasks[view.rank[view.tasks] + size - 1 <= view.counts[owner[view.tasks]]]
    if at.size == 0:
        return None
    row = nodes[at[:, None] + np.arange(size)]
    put = row[:, ::-1] if turned else row
    r, before, after = owner[at], nodes[at - 1], view.after[at + size - 1]
    gain = view.driven[at + size - 1] - view.driven[at - 1]
    gain = gain + prices[r, row[:, -1], after] - prices[r, before, after]
    within = prices[:, put[:, :-1], put[:, 1:]].sum(axis=2)
    head, tail = put[:, :1], put[:, -1:]
    added = prices[owner, nodes, head] + prices[owner, tail, view.after]
    added += within[owner].swapaxes(0, 1) - prices[owner, nodes, view.after]
    slot = np.arange(len(nodes))
    same = r[:, None] == owner
    apart = (slot < at[:, None] - 1) | (slot >= at[:, None] + size)
    room = same | (view.counts[owner] + size <= view.seats)
    left = (view.lengths[r] - gain)[:, None, 0]
    grown = np.maximum(left, view.lengths[owner, 0] + added[..., 0])
    longest = np.where(same, left + added[..., 0], grown)
    longest = np.maximum(longest, view.others[r[:, None], owner])
    change = view.judged(longest, added[..., 1] - gain[:, None, 1], apart & room)
    best = np.unravel_index(change.argmin(), change.shape)
    start, goal = int(at[best[0]]), int(best[1])
    moved = [int(task) for task in put[best[0]]]

    def apply() -> Routes:
        routes = [list(route) for route in view.routes]
        source, place = int(owner[start]), int(view.rank[start]) - 1
        del routes[source][place : place + size]
        target, into = int(owner[goal]), int(view.rank[goal])
        if target == source and into > place:
            into -= size
        routes[target][into:into] = moved
        return routes

    return Move(float(change[best]), apply)


def swap(view: View) -> Move | None:
    """Let two tasks that are not neighbours change places."""
    if view.tasks.size < 2:
        return None
    prices, at = view.legs.prices, view.tasks
    r, task, before, after = view.owner[at], view.nodes[at], view.nodes[at - 1], view.after[at]
    gain = view.arrival[at] + prices[r, task, after]
    # in_place[p, q]: what the task at q adds in the place of the one at p.
    in_place = prices[r[:, None], before[:, None], task] + prices[r[:, None], task, after[:, None]]
    in_place -= gain[:, None]
    both = in_place + in_place.swapaxes(0, 1)
    same = r[:, None] == r
    length = view.lengths[r, 0]
    grown = length[:, None] + in_place[..., 0]
    longest = np.where(same, length[:, None] + both[..., 0], np.maximum(grown, grown.T))
    longest = np.maximum(longest, view.others[r[:, None], r])
    legal = ~same | (np.abs(at[:, None] - at) > 1)
    change = view.judged(longest, both[..., 1], legal)
    p, q = (int(i) for i in np.unravel_index(change.argmin(), change.shape))

    def apply() -> Routes:
        routes = [list(route) for route in view.routes]
        routes[r[p]][view.rank[at[p]] - 1] = int(task[q])
        routes[r[q]][view.rank[at[q]] - 1] = int(task[p])
        return routes

    return Move(float(change[p, q]), apply)


def reverse(view: View) -> Move | None:
    """Drive a part of a route in the opposite order."""
    if view.tasks.size < 2:
        return None
    prices, at = view.legs.prices, view.tasks
    r, task, before, after = view.owner[at], view.nodes[at], view.nodes[at - 1], view.after[at]
    backward = np.zeros_like(view.arrival)
    backward[at] = prices[r, task, before]
    undone = _sums_within(backward, view.first[view.owner])[at]
    done = view.driven[at]
    # [p, q]: from the task at p to the one at q.
    added = prices[r[:, None], before[:, None], task] + prices[r[:, None], task[:, None], after]
    added += undone - undone[:, None] - (done - done[:, None])
    added -= view.arrival[at][:, None] + prices[r, task, after]
    legal = (r[:, None] == r) & (at[:, None] < at)
    longest = np.maximum(view.lengths[r, 0] + added[..., 0], view.others[r, r])
    change = view.judged(longest, added[..., 1], legal)
    p, q = (int(i) for i in np.unravel_index(change.argmin(), change.shape))

    def apply() -> Routes:
        routes = [list(route) for route in view.routes]
        first, last = int(view.rank[at[p]]) - 1, int(view.rank[at[q]])
        routes[r[p]][first:last] = routes[r[p]][first:last][::-1]
        return routes

    return Move(float(change[p, q]), apply)


def exchange_tails(view: View) -> Move | None:
    """Let two robots change what they do after some point of their routes."""
    prices, nodes, owner = view.legs.prices, view.nodes, view.owner
    m, size = view.legs.num_robots, len(nodes)
    if m < 2:
        return None
    inner = np.zeros((m, size, 2))
    at = view.tasks[view.rank[view.tasks] > 1]
    inner[:, at] = prices[:, nodes[at - 1], nodes[at]]
    sums = inner.cumsum(axis=1)
    last = (view.first + view.counts)[owner]
    # rest[k, t]: what robot k drives from the node that follows position t to the end.
    following = np.minimum(np.arange(size) + 1, last)
    rest = sums[:, last] - sums[:, following]
    # joined[s, t]: the route of s up to there, then what follows t.
    joined = view.driven[:, None] + prices[owner[:, None], nodes[:, None], view.after] + rest[owner]
    longest = np.maximum(joined[..., 0], joined[..., 0].T)
    longest = np.maximum(longest, view.others[owner[:, None], owner])
    price = joined[..., 1] + joined[..., 1].T
    price = price - view.lengths[owner, None, 1] - view.lengths[owner, 1]
    number = view.rank[:, None] + view.counts[owner] - view.rank
    fits = number <= view.seats
    legal = (owner[:, None] < owner) & fits & fits.T
    change = view.judged(longest, price, legal)
    s, t = (int(i) for i in np.unravel_index(change.argmin(), change.shape))

    def apply() -> Routes:
        routes = [list(route) for route in view.routes]
        a, b = int(owner[s]), int(owner[t])
        i, j = int(view.rank[s]), int(view.rank[t])
        routes[a], routes[b] = routes[a][:i] + routes[b][j:], routes[b][:j] + routes[a][i:]
        return routes

    return Move(float(change[s, t]), apply)


def _sums_within(arrival: Floats, first: Ints) -> Floats:
    """Return running sums of each route; ``first`` is the position of its start."""
    sums = arrival.cumsum(axis=0)
    within: Floats = sums - sums[first]
    return within


def _longest_of_others(lengths: Floats) -> Floats:
    """Return the longest route of all but robots i and j, ``(m, m)``."""
    m = len(lengths)
    ranking = np.argsort(-lengths, kind="stable")[:3]
    longest = np.zeros((m, m))
    for robot in ranking[::-1]:
        others = np.arange(m) != robot
        longest[np.ix_(others, others)] = lengths[robot]
    return longest
