"""Answers as immutable objects."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

Point: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Contact:
    """The first contact of two bodies. It is proven, in floating point, that nothing touches before `time`.

    Attributes:
        time: the time of the contact. Nothing touches before it.
        kind: "contact", or "touching" or "overlapping" for a contact at the start.
        witness_a: the point of body A nearest to B, in world coordinates at that time.
        witness_b: the point of body B nearest to A.
        normal: the unit normal from A to B; None if one body is inside the other.
        distance: bounds of the distance at that time, negative for pieces that intersect; None if `normal` is None.
        feature_a: the feature of A in contact, such as "v7", "e3-7", "f12" or "p0"; None if `normal` is None.
        feature_b: the feature of B in contact.
    """

    time: float
    kind: Literal["contact", "touching", "overlapping"]
    witness_a: Point
    witness_b: Point
    normal: Point | None
    distance: tuple[float, float] | None
    feature_a: str | None
    feature_b: str | None


@dataclass(frozen=True)
class Distance:
    """Bounds of the least distance of two bodies, to within the tolerance, or as narrow as a clearance requires.

    Bodies may extend beyond their shapes by their `excess`. The bounds hold for the shapes: `upper` includes the sum of
    both excesses, and a clearance is "violated" only if the shapes violate it.

    Attributes:
        lower: a lower bound of the distance at all times.
        upper: an upper bound of the distance at `time`; infinite if no distance was measured.
        time: the time of the least distance found; 0 if the bodies overlap at the start; None if no distance was
            measured.
        is_overlapping: whether the bodies overlap at the start. If so, their shapes are at most `upper` apart.
        witness_a: the nearest point of body A, in world coordinates at that time; None if the bodies overlap at the
            start.
        witness_b: the nearest point of body B.
        clearance: whether the required clearance is "kept", "violated", or left "unverified" by the bounds; None if
            none was required.
    """

    lower: float
    upper: float
    time: float | None
    is_overlapping: bool
    witness_a: Point | None
    witness_b: Point | None
    clearance: Literal["kept", "violated", "unverified"] | None


@dataclass(frozen=True)
class PathContact:
    """A pair of items of a cell, at the point of a path at which it touches or is nearest.

    Attributes:
        segment: the index of the segment between two configurations, from 0. An edge has only segment 0.
        fraction: the position within the segment, from 0 to 1. Nothing touches before a first contact.
        time: the sum of segment and fraction: 1.5 is the middle of the second segment. On a curve, the time of the curve.
        a: the name of the first item: a link, or an attached body.
        b: the name of the second item: a link, an attached body or an obstacle.
        witness_a: the point of `a` nearest to `b`, in the frame of the robot's base.
        witness_b: the point of `b` nearest to `a`.
        feature_a, feature_b: the vertex, edge or face of the mesh that has the witness point: "v7", "e3-4" or "f5".
            None for a convex body or a hull, and if one body is inside the other.
        tolerance: a contact is within this distance beyond the margin. It is the tolerance of the settings, or larger
            if rounding of positions requires it, far from the base or after thousands of turns.
    """

    segment: int
    fraction: float
    time: float
    a: str
    b: str
    witness_a: Point
    witness_b: Point
    feature_a: str | None
    feature_b: str | None
    tolerance: float


@dataclass(frozen=True)
class PathDistance:
    """Bounds of the least distance on a path, to within the tolerance unless a limit was reached.

    If bodies that enclose their shapes, such as hulls of meshes, overlap, `lower` is 0, and `upper` is the sum of both
    excesses, although the shapes may be apart.

    Attributes:
        lower: a lower bound of the distance of all pairs on the whole path.
        upper: an upper bound of the least distance.
        nearest: the nearest pair; None if no pair was measured.
        limit: the limit that ended the search; None if there was none.
        tolerance: unless a limit was reached, the bounds differ by at most 1.001 times this, plus the excesses of the
            bodies. It is the tolerance of the settings, or larger if rounding of positions requires it.
        clearance: whether the required clearance is "kept", "violated", or left "unverified" by the bounds; None if
            none was required.
    """

    lower: float
    upper: float
    nearest: PathContact | None
    limit: str | None
    tolerance: float
    clearance: Literal["kept", "violated", "unverified"] | None


@dataclass(frozen=True)
class PathRange:
    """A range of a path, and whether all pairs keep their required distance in it.

    Attributes:
        start, end: the ends of the range, in segments: 1.5 is the middle of the second segment. On a curve, times of
            the curve.
        clearance: "kept" if all pairs keep their distance everywhere in the range; "violated" if everywhere in it some
            pair is nearer; "unverified" if neither is proven.
    """

    start: float
    end: float
    clearance: Literal["kept", "violated", "unverified"]
