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

    Answers are in the order of the rows. They have the same bits on any machine and on any number of cores.

    Args:
        a, b: the bodies.
        motions: any object that supports the Arrow PyCapsule protocol (a table or a stream of pyarrow, polars, pandas
            3, duckdb), or a dict of arrays. Columns of float64 are not copied; do not write to them during the call.
            Columns are found by name, in any order, and have the defaults in parentheses. A null cell or NaN makes its
            row an error, with one exception: for each body, a row may have an end pose with null velocities, or
            velocities with a null end pose. The index of a pandas frame is dropped unless it has a name. The columns
            are:
            id: the name of the row, of any type. Results have the same ids; dictionary encoding is removed. Without
                this column, ids are row indices from 0.
            a_px a_py a_pz: the position of A at the start (0).
            a_qw a_qx a_qy a_qz: its orientation (the identity).
            a_vx a_vy a_vz: the velocity of its center (0).
            a_wx a_wy a_wz: its angular velocity, world frame, in radians per unit of time (0).
            a_end_px a_end_py a_end_pz a_end_qw a_end_qx a_end_qy a_end_qz: the pose at the end, in place of velocities.
            a_cx a_cy a_cz: the center of rotation in A's frame (its origin).
            b_px ...: the same for B.
            duration: the end of the motion (1).
            With a column t, each row is a pose at that time. Consecutive rows with the same id are one path.
        tolerance: the accuracy of contacts, 0.001 by default. A contact is reported at a distance of at most margin +
            tolerance.
        margin: the distance at which bodies count as touching; 0 by default.
        budget: the largest amount of work for a row; a million takes about a second. Along a path it is for each
            segment between two poses. A row that needs more is unresolved.
        deadline: the seconds after which a row ends as unresolved.
        threads: the number of threads; one on each core by default.
        progress: a function, called up to fifty times a second with the number of rows answered and the number of all
            rows (None if it is unknown, or if rows make paths); a bar of tqdm; or True for a new bar.
        micros: False leaves the column `micros` empty, so that equal answers give equal tables.

    Returns:
        A `Table` with the columns of ``ccd query``: id, status, time, distance_lower, distance_upper, normal_x ...,
        witness_a_x ..., witness_b_x ..., feature_a, feature_b, iterations, oracle_calls, micros, reason. The status is
        contact, free, touching or overlapping (at the start), unresolved (a limit was reached; nothing touches before
        `time`), or error (the row is not a valid motion; see `reason`). Free rows have no distance: they are proven to
        stay farther apart than the margin. `closest_approaches` measures distances.

    Raises:
        InputError: a column is unknown, missing, or not numeric, or a stream failed. After a failed stream it has
            `results` too.
        InterruptError: Ctrl-C was pressed. `results` has the rows answered so far, from the first on. If a stream is
            waiting for its next batch, the call first waits for that batch.

    Warns:
        UserWarning: the tolerance is more than a tenth of the smaller body, angular velocities are round numbers of
            degrees and make many turns, or the length of a quaternion differs from 1 by more than a tenth. Warnings
            change no answer.

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

    Rows with a contact take less time than with `first_contacts`. Their time and status belong to some contact, not
    necessarily the first one.
    """
    return answer("is-free", a, b, motions, **settings)


def contact_intervals(a: Body, b: Body, motions: Motions, **settings: Unpack[ContactsOfTables]) -> Table:
    """Finds the first and the last contact in each row: columns `time` and `last_time`.

    Arguments and exceptions are those of `first_contacts`.
    """
    return answer("contact-interval", a, b, motions, **settings)


def closest_approaches(a: Body, b: Body, motions: Motions, **settings: Unpack[DistancesOfTables]) -> Table:
    """Computes bounds of the least distance in each row: columns `distance_lower` and `distance_upper`.

    Arguments and exceptions are those of `first_contacts`, without a margin. With a `clearance`, the status tells
    whether the distance is at least the clearance: kept, violated, or unverified. `distance_upper` includes the
    `excess` of bodies over their shapes.
    """
    return answer("closest-approach", a, b, motions, **settings)


def distances(a: Body, b: Body, motions: Motions, **settings: Unpack[DistancesOfTables]) -> Table:
    """Computes bounds of the distance at the start of each row. For paths, computes them at each pose.

    Arguments and exceptions are those of `closest_approaches`.
    """
    return answer("distance", a, b, motions, **settings)


def answer(question: Question, a: Body, b: Body, motions: Motions, *, progress: Progress = None, **settings: Any) -> Table:
    """Answers a question about each row."""
    return _rigid_ccd.answer_table(question, a, b, motions, progress=progress, **settings)
