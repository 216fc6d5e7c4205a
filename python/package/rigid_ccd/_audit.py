"""Certifies motions that another checker has called free."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Unpack

import numpy as np

from . import _rigid_ccd
from ._rigid_ccd import Body, InputError, Table
from ._settings import ContactsOfTables
from ._tables import Motions, first_contacts


@dataclass(frozen=True, repr=False)
class Audit:
    """The contacts that another checker has missed.

    Attributes:
        rows: the number of rows, or of paths.
        missed: the rows that are not free, with time and witnesses of the first contact: columns of `first_contacts`.
        missed_rows: their numbers in the table of motions, from 0; of paths, their numbers among the paths.
        unproven: the rows that are neither free nor missed: a limit was reached (status "unresolved"), or the row is not
            a valid motion ("error").
        pages: the files of the pages, for the first missed rows, in their order.
    """

    rows: int
    missed: Table
    missed_rows: tuple[int, ...]
    unproven: Table
    pages: tuple[Path, ...]

    @property
    def is_clean(self) -> bool:
        """Whether every row is proven free."""
        return not self.missed_rows and len(self.unproven) == 0

    def __repr__(self) -> str:
        free = self.rows - len(self.missed) - len(self.unproven)
        return f"Audit({self.rows} rows, {free} free, {len(self.missed)} missed, {len(self.unproven)} unproven)"


def audit(
    a: Body,
    b: Body,
    motions: Motions,
    *,
    pages: str | os.PathLike[str] | None = None,
    most_pages: int = 100,
    **settings: Unpack[ContactsOfTables],
) -> Audit:
    """Certifies motions that another checker, of a planner, a simulator or a CAM program, has called free.

    Args:
        a, b: the bodies.
        motions: the table that the checker has called free, as of `first_contacts`.
        pages: a folder for a page on each missed row, which shows the motion and the contact in any browser, offline.
        most_pages: the first so many missed rows have pages. Pages of earlier audits stay in the folder.
        tolerance: what comes within margin + tolerance counts as missed; `distance_upper` says how near it came. It is
            1e-6 by default: nobody is blamed for what passes closely.
        margin: the distance that the checker was to keep.
        settings: the others of `first_contacts`.

    Raises:
        InputError: a column is unknown, missing, or not numeric.
        OSError: a page cannot be written.

    >>> from rigid_ccd import Body, audit
    >>> ball, wall = Body.sphere(0.5), Body.box(0.001, 5, 5)
    >>> # Free at both ends, and at each of ten steps between them.
    >>> shots = {"id": ["slow", "fast"], "a_px": [-3, -3], "a_vx": [1, 60]}
    >>> found = audit(ball, wall, shots)
    >>> found
    Audit(2 rows, 1 free, 1 missed, 0 unproven)
    >>> found.missed["id"], found.missed["time"].round(3)
    (array(['fast'], dtype=object), array([0.042]))
    """
    if most_pages < 0:
        raise InputError(f"most_pages: {most_pages} is not at least 0")
    table = motions if isinstance(motions, Table) else Table(motions)
    contacts: dict[str, Any] = {"tolerance": 1e-6, **settings}
    results = first_contacts(a, b, table, **contacts)
    status = results["status"]
    missed = np.flatnonzero(np.isin(status, ["contact", "touching", "overlapping"])).tolist()
    unproven = np.flatnonzero(np.isin(status, ["unresolved", "error"])).tolist()
    written: list[Path] = []
    if pages is not None and missed:
        of_query = {name: value for name, value in contacts.items() if name not in ("threads", "progress", "micros")}
        shown = missed[:most_pages]
        written = _rigid_ccd.write_pages(a, b, table, set(shown), pages, **of_query)
    return Audit(
        rows=len(results),
        missed=results.take(missed),
        missed_rows=tuple(missed),
        unproven=results.take(unproven),
        pages=tuple(written),
    )
