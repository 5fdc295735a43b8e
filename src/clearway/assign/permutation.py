"""Permutations that encode an even split, bred and mended a whole population at a time.

A population is an array of shape ``(N, length)``, where the length is the number of robots
times the seats of each. Numbers beyond the last task are padding: tasks of no cost.
"""

import numpy as np
from numpy.typing import NDArray

from clearway.protocols import Routes

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


def decode(permutation: Ints, num_robots: int, num_tasks: int) -> Routes:
    """Return the routes that a permutation stands for: equal parts, without the padding (A-8)."""
    parts = permutation.reshape(num_robots, -1) if num_robots else ()
    return tuple(tuple(int(task) for task in part if task < num_tasks) for part in parts)


def random_population(rng: np.random.Generator, count: int, length: int) -> Ints:
    """Return permutations drawn evenly from all, ``(count, length)``."""
    return rng.permuted(np.tile(np.arange(length), (count, 1)), axis=1)


def round_randomly(rng: np.random.Generator, x: Floats) -> Ints:
    """Round each number up with the probability of its fraction, down otherwise (A-10)."""
    down = np.floor(x)
    up: Ints = (down + (rng.random(x.shape) < x - down)).astype(np.int64)
    return up


def repair(rng: np.random.Generator, values: Ints) -> Ints:
    """Make rows of numbers in [0, length) permutations with as few changes as possible (A-12).

    Of the holders of a number one, drawn evenly, keeps it; the others take the missing numbers
    in random order.
    """
    length = values.shape[1]
    # Half a random number keeps equal numbers together, however it is rounded.
    order = np.argsort(values + 0.5 * rng.random(values.shape), axis=1)
    in_order = np.take_along_axis(values, order, axis=1)
    is_first = np.ones(values.shape, dtype=np.bool_)
    is_first[:, 1:] = in_order[:, 1:] != in_order[:, :-1]
    keeps = np.empty_like(is_first)
    np.put_along_axis(keeps, order, is_first, axis=1)
    is_missing = np.ones(values.shape, dtype=np.bool_)
    np.put_along_axis(is_missing, values, False, axis=1)
    shuffled = np.argsort(np.where(is_missing, rng.random(values.shape), 1.0), axis=1)
    wanted = np.arange(length) < is_missing.sum(axis=1)[:, None]
    mended = values.copy()
    mended[~keeps] = shuffled[wanted]
    return mended


def fragments(rng: np.random.Generator, count: int, length: int) -> Bools:
    """Return what two random index ranges cover for each of ``count`` pairs, as masks.

    Ranges are exchanged one after the other, so what both cover is back where it was.
    """
    ends = np.sort(rng.integers(length, size=(count, 2, 2)), axis=-1)
    index = np.arange(length)
    inside: Bools = (ends[..., :1] <= index) & (index <= ends[..., 1:])
    return inside[:, 0] ^ inside[:, 1]


def exchange(first: Ints, second: Ints, mask: Bools) -> tuple[Ints, Ints]:
    """Return both rows with what the mask covers exchanged, which may hold numbers twice."""
    return np.where(mask, second, first), np.where(mask, first, second)


def crossover(rng: np.random.Generator, parents: Ints, probability: float) -> Ints:
    """Pair all parents by chance; pairs exchange two fragments with a probability (A-13).

    A child has the number of the parent that it takes after. Of an odd number of parents one
    is left as it is.
    """
    children = parents.copy()
    count, length = parents.shape
    if length == 0:
        return children
    order, half = rng.permutation(count), count // 2
    first, second = order[:half], order[half : 2 * half]
    mask = fragments(rng, half, length) & (rng.random((half, 1)) < probability)
    children[first], children[second] = exchange(parents[first], parents[second], mask)
    return repair(rng, children)


def mutate(rng: np.random.Generator, population: Ints, probability: float) -> Ints:
    """Swap two random coordinates of each row with a probability (A-14)."""
    mutants = population.copy()
    count, length = population.shape
    if length < 2:
        return mutants
    rows = np.flatnonzero(rng.random(count) < probability)
    here = rng.integers(length, size=rows.size)
    there = (here + rng.integers(1, length, size=rows.size)) % length
    mutants[rows, here], mutants[rows, there] = population[rows, there], population[rows, here]
    return mutants
