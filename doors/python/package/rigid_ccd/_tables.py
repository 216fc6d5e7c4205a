"""Questions about each row of a table of motions."""

from typing import Any, Literal, TypeAlias, Unpack

from . import _rigid_ccd
from ._rigid_ccd import Body, Table
from ._settings import ContactsOfTables, DistancesOfTables, Progress

Motions: TypeAlias = Any
"""An Arrow table of any library, or a dict of arrays."""

Question: TypeAlias = Literal[
    "first-contact", "is-free", "contact-interval", "closest-approach", "distance"
]


def first_contacts(a: Body, b: Body, motions: Motions, **settings: Unpack[ContactsOfTables]) -> Table:
    """Finds the first contact in each row of a table of motions, on all cores.

    The answers are in the order of the rows, and the same bits on any number of cores and machines.

    Args:
        a, b: the bodies.
        motions: anything that speaks the Arrow PyCapsule protocol (a table or a stream of pyarrow, polars, pandas 3,
            duckdb), or a dict of arrays. Columns of float64 are not copied; do not write to them meanwhile. They go by
            name, in any order, and have defaults. A null cell or NaN is an error of its row, but a row with an end pose
            may have nulls for the velocities of that body, and the other way round. The index of a pandas frame is
            dropped unless it has a name:
            id: the name of the row, of any type; it comes back as it is, a dictionary as its values. Without it, rows
                are numbered from 0.
            a_px a_py a_pz: the position of A at the start (0).
            a_qw a_qx a_qy a_qz: its orientation (the identity).
            a_vx a_vy a_vz: the velocity of its center (0).
            a_wx a_wy a_wz: its angular velocity, world frame, in radians per unit of time (0).
            a_end_px a_end_py a_end_pz a_end_qw a_end_qx a_end_qy a_end_qz: instead of velocities, the pose at the end.
            a_cx a_cy a_cz: the center of rotation in A's frame (its origin).
            b_px ...: the same of B.
            duration: the end of the motion (1).
            With a column t, rows are poses at that time, and all rows of an id, which follow each other, are one path.
        tolerance: a contact is reported at a distance of at most margin + tolerance; 0.001 by default.
        margin: a distance to keep; 0 by default.
        budget: the work after which a row is left unresolved, of a path that between two poses; a million takes about
            a second.
        deadline: seconds after which a row is left unresolved.
        threads: one on each core by default.
        progress: a function of the number of rows answered and of all rows (None if it is not known, or if rows make
            paths), called up to fifty times a second; or a bar of tqdm; or True for one.
        micros: False leaves the column empty, so that equal answers are equal tables.

    Returns:
        A `Table` with the columns of ``ccd query``: id, status, time, distance_lower, distance_upper, normal_x ...,
        witness_a_x ..., witness_b_x ..., feature_a, feature_b, iterations, oracle_calls, micros, reason. Status is
        contact, free, touching or overlapping (at the start), unresolved (a limit was reached: nothing touches before
        `time`), or error: the row is not a valid motion, with its reason. Of free rows no distance is known: they are
        proven to stay farther apart than the margin, and `closest_approaches` measures them.

    Raises:
        InputError: a column is unknown, missing, or not numeric; or a stream failed: then it has `results`, too.
        Interrupted: Ctrl-C; its `results` has the rows answered by then, from the first on. A stream that waits for its
            next batch is waited for.

    Warns:
        UserWarning: a tolerance of more than a tenth of the smaller body, angular velocities that are round numbers of
            degrees and make many turns, or a quaternion whose length is not within a tenth of 1. They change no answer.

    >>> import numpy as np
    >>> from rigid_ccd import Body, first_contacts
    >>> ball, wall = Body.sphere(0.5), Body.box(0.1, 5, 5)
    >>> found = first_contacts(ball, wall, {"a_px": [-3, -3, np.nan], "a_vx": [4, 1, 1]})
    >>> found
    Table(3 rows, 20 columns, 1 contact, 1 free, 1 error)
    >>> found["time"].round(2)
    array([0.6, 1. , nan])
    >>> found["reason"][2]
    'column a_px: `NaN` is not a finite number'
    """
    return answer("first-contact", a, b, motions, **settings)


def are_free(a: Body, b: Body, motions: Motions, **settings: Unpack[ContactsOfTables]) -> Table:
    """Finds the rows in which two bodies stay apart by more than the margin.

    Rows with a contact are faster than with `first_contacts`: time and status are those of any contact, perhaps not the
    first one.
    """
    return answer("is-free", a, b, motions, **settings)


def contact_intervals(a: Body, b: Body, motions: Motions, **settings: Unpack[ContactsOfTables]) -> Table:
    """Finds the first and the last contact in each row: columns `time` and `last_time`.

    Arguments and exceptions are those of `first_contacts`.
    """
    return answer("contact-interval", a, b, motions, **settings)


def closest_approaches(a: Body, b: Body, motions: Motions, **settings: Unpack[DistancesOfTables]) -> Table:
    """Brackets the least distance in each row, to within the tolerance: columns `distance_lower` and `distance_upper`.

    Arguments and exceptions are those of `first_contacts`, without a margin. With a `clearance`, the status says whether
    the distance is at least that: kept, violated, or unverified. What bodies exceed their shapes by, their `excess`, is
    in `distance_upper`.
    """
    return answer("closest-approach", a, b, motions, **settings)


def distances(a: Body, b: Body, motions: Motions, **settings: Unpack[DistancesOfTables]) -> Table:
    """Brackets the distance at the start of each row; for paths, in each of their rows.

    Arguments and exceptions are those of `closest_approaches`.
    """
    return answer("distance", a, b, motions, **settings)


def answer(ask: Question, a: Body, b: Body, motions: Motions, *, progress: Progress = None, **settings: Any) -> Table:
    """Answers a question about each row."""
    return _rigid_ccd.answer_table(ask, a, b, motions, progress=progress, **settings)
