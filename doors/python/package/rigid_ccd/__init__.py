"""Certified continuous collision detection: when do two moving rigid bodies first touch?

>>> from rigid_ccd import Body, Motion, first_contact
>>> ball, wall = Body.sphere(0.5), Body.box(0.1, 5, 5)
>>> hit = first_contact(ball, wall, Motion([-3, 0, 0], velocity=[4, 0, 0]))
>>> hit.kind, round(hit.time, 2)
('contact', 0.6)

Nothing touches before the time of a contact. If the result is None, nothing touches at all. Both are proven, in
floating point.

A table of motions is answered on all cores:

>>> import numpy as np
>>> from rigid_ccd import first_contacts
>>> speeds = np.linspace(1, 4, 4)
>>> first_contacts(ball, wall, {"a_px": np.full(4, -3.0), "a_vx": speeds})["status"]
array(['free', 'free', 'contact', 'contact'], dtype=object)

Lengths are in any one unit, times in the motions' unit, angles in radians. Quaternions are (x, y, z, w), as in scipy
and ROS.
"""

from ._answers import Contact, Distance, PathContact, PathDistance, PathRange
from ._edges_query import EdgesQuery
from ._errors import InputError, InterruptError, UnresolvedError
from ._proofs import Proof, check_folder
from ._query import TableQuery
from ._rigid_ccd import (
    Body,
    Cell,
    Joint,
    LinkTrajectory,
    Motion,
    PosePath,
    Robot,
    Table,
    check_proof,
    closest_approach,
    distance,
    first_contact,
    is_free,
    prove,
)
from ._tables import (
    are_free,
    closest_approaches,
    contact_intervals,
    distances,
    first_contacts,
)

__all__ = [
    "Body",
    "Cell",
    "Contact",
    "Distance",
    "InputError",
    "InterruptError",
    "Joint",
    "LinkTrajectory",
    "Motion",
    "PosePath",
    "PathContact",
    "PathDistance",
    "PathRange",
    "Proof",
    "Robot",
    "Table",
    "EdgesQuery",
    "TableQuery",
    "UnresolvedError",
    "are_free",
    "check_folder",
    "check_proof",
    "closest_approach",
    "closest_approaches",
    "contact_intervals",
    "distance",
    "distances",
    "first_contact",
    "first_contacts",
    "is_free",
    "prove",
]
