"""Measures a check of edges: CPU time on one core, and what it says about each."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from data import Bools, Floats

Configuration = Floats
IsFree = Callable[[Configuration, Configuration], bool]


@dataclass(frozen=True)
class Measured:
    micros: float  # an edge, the median of the rounds
    free: Bools


Measure = Callable[[Floats, int], Measured]  # of edges (edges, 2, joints), and a number of rounds


def together(check: Callable[[Floats], Bools]) -> Measure:
    """Measures a check that is asked all edges in one call."""

    def measure(edges: Floats, rounds: int) -> Measured:
        times = []
        for _ in range(rounds):
            began = time.process_time()
            free = check(edges)
            times.append(time.process_time() - began)
        return Measured(1e6 * statistics.median(times) / len(edges), free)

    return measure


def one_by_one(is_free: IsFree) -> Measure:
    """Measures a check that is asked one edge in a call."""

    def measure(edges: Floats, rounds: int) -> Measured:
        ends = [(start.copy(), end.copy()) for start, end in edges]
        return together(lambda _: np.array([is_free(start, end) for start, end in ends], dtype=bool))(edges, rounds)

    return measure


def halving_order(steps: int) -> list[int]:
    """Returns steps 1 to `steps`: the end first, then the middle, then the middles of the halves, and so on."""
    order, parts = [steps], [(0, steps)]
    for low, high in parts:
        middle = (low + high) // 2
        if low < middle:
            order.append(middle)
            parts += [(low, middle), (middle, high)]
    return order


def at_steps(is_free: Callable[[Configuration], bool], steps: int) -> Measure:
    """Measures tests of configurations at equal steps of an edge, without its start, which is known to be free."""
    fractions = [step / steps for step in halving_order(steps)]

    def edge_is_free(start: Configuration, end: Configuration) -> bool:
        way = end - start
        return all(is_free(start + fraction * way) for fraction in fractions)

    return one_by_one(edge_is_free)
