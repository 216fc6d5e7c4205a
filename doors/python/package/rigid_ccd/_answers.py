"""Answers as frozen objects."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

Point: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Contact:
    """The first contact of two bodies. Nothing touches before its time: that is proven, in floating point.

    Attributes:
        time: no contact happens before it.
        kind: "contact", or at the start "touching" or "overlapping".
        witness_a: the point of body A nearest to B, in the world at that time.
        witness_b: the point of body B nearest to A.
        normal: the unit vector from A to B; None where one body is inside the other.
        distance: bounds of the distance at that time; negative for pieces that intersect, None like the normal.
        feature_a: the feature of A in contact, such as "v7", "e3-7", "f12" or "p0"; None like the normal.
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


    Bodies may exceed their shapes by their `excess`. Then the bounds are those of the shapes: what both bodies stick out
    by is in `upper`, and no clearance is "violated" by the bodies alone.

    Attributes:
        lower: the bodies are never nearer than this.
        upper: at `time` they are at most this far apart; infinite where no distance was measured.
        time: when they are nearest; 0 where they overlap at the start; None where no distance was measured.
        is_overlapping: whether they overlap at the start; their shapes are at most `upper` apart then.
        witness_a: the nearest point of body A, in the world at that time; None where they overlap at the start.
        witness_b: the nearest point of body B.
        clearance: whether the required clearance is "kept", "violated", or "unverified" within the bounds; None where none
            was required.
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
    """A pair of a cell that touches on a path, or is nearest there.

    Attributes:
        segment: the number of the segment between two configurations, from 0. An edge has only segment 0.
        share: the share of the segment that is passed, from 0 to 1. Nothing touches before a first contact.
        time: the segment and the share together: 1.5 is the middle of the second segment. On a curve, its own time.
        a: the name of the link, or of the body attached to one.
        b: the name of the other link, attached body or obstacle.
        witness_a: the point of `a` nearest to `b`, in the frame of the robot's base.
        witness_b: the point of `b` nearest to `a`.
        feature_a, feature_b: the vertex, edge or face of the mesh that a witness is on: "v7", "e3-4" or "f5". None for a
            convex body or a hull, and if one body is inside the other.
        tolerance: a contact is within this distance beyond the margin: the tolerance that was asked for, unless the rounding of
            positions allows only a larger one, far from the base or after thousands of turns.
    """

    segment: int
    share: float
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

    Bodies that exceed their shapes, such as hulls of meshes, may touch where the shapes do not. Then the bounds are 0 and what
    both bodies of the pair stick out by.

    Attributes:
        lower: nothing is ever nearer than this.
        upper: the nearest pair comes at least as near as this.
        nearest: the nearest pair; None if no pair was measured.
        limit: the limit that ended the search; None if there was none.
        tolerance: the bounds differ by at most this and a thousandth of it, and by what the bodies exceed their shapes by,
            unless a limit was reached: the tolerance that was asked for, unless the rounding of positions allows only a
            larger one.
        clearance: whether the required clearance is "kept", "violated", or "unverified" within the bounds; None where none
            was required.
    """

    lower: float
    upper: float
    nearest: PathContact | None
    limit: str | None
    tolerance: float
    clearance: Literal["kept", "violated", "unverified"] | None


@dataclass(frozen=True)
class PathRange:
    """A range of a path, and whether all pairs keep their distance in it.

    Attributes:
        start, end: where on the path, in segments: 1.5 is the middle of the second one. On a curve, its own times.
        clearance: "kept", if all pairs keep their distance everywhere in the range; "violated", if some pair is nearer
            everywhere in it; "unverified", if neither is proven.
    """

    start: float
    end: float
    clearance: Literal["kept", "violated", "unverified"]
