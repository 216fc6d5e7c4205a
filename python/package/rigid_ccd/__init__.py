"""Certified continuous collision detection: when do two moving rigid bodies first touch?

>>> from rigid_ccd import Body, Motion, first_contact
>>> ball, wall = Body.sphere(0.5), Body.box(0.1, 5, 5)
>>> hit = first_contact(ball, wall, Motion([-3, 0, 0], velocity=[4, 0, 0]))
>>> hit.kind, round(hit.time, 2)
('contact', 0.6)

Nothing touches before the time of a contact, and without one nothing touches at all: that is proven, in floating point.

Lengths are in any one unit, times in the motions' unit, angles in radians. Quaternions are (w, x, y, z), as in the
tables of the command ``ccd``.
"""

from ._rigid_ccd import (
    Body,
    Contact,
    Distance,
    InputError,
    Motion,
    Unresolved,
    closest_approach,
    distance,
    first_contact,
    is_free,
)

__all__ = [
    "Body",
    "Contact",
    "Distance",
    "InputError",
    "Motion",
    "Unresolved",
    "closest_approach",
    "distance",
    "first_contact",
    "is_free",
]
