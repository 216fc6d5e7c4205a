"""The keyword arguments of queries, with their types."""

from collections.abc import Callable
from typing import Any, Literal, Protocol, TypeAlias, TypedDict


class _Bar(Protocol):
    """A bar of tqdm."""

    def update(self, n: float | None = 1) -> Any: ...


Progress: TypeAlias = Callable[[int, int | None], object] | _Bar | bool | None
"""A function of two numbers (answered rows and all rows), a bar of tqdm, True for a new bar, or None."""


class OfDistances(TypedDict, total=False):
    """Settings of a query that measures distances."""

    tolerance: float
    budget: int | None
    deadline: float | None


class OfContacts(OfDistances, total=False):
    """Settings of a query that looks for contacts."""

    margin: float


class OfPathContacts(OfContacts, total=False):
    """Settings of a query that looks for contacts on a path."""

    start: Literal["report", "leave"]


class OfApproaches(OfDistances, total=False):
    """Settings of a query for the least distance."""

    clearance: float | None


class OfPaths(OfPathContacts, total=False):
    """Settings of `Cell.answer_edges` and `Cell.answer_paths`. Closest approaches take `clearance` in place of `margin` and `start`."""

    clearance: float | None


class OfTables(TypedDict, total=False):
    """Settings of a query about each row of a table."""

    threads: int | None
    progress: Progress
    micros: bool


class ContactsOfTables(OfContacts, OfTables, total=False):
    """Settings of a query that looks for contacts in each row of a table."""


class DistancesOfTables(OfApproaches, OfTables, total=False):
    """Settings of a query that measures distances in each row of a table."""
