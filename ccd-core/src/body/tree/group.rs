//! The nodes of the wide tree, and groups of eight children in arrays by coordinate, for vector instructions.

use crate::math::order::greater;
use crate::math::simd::PackedVector;
use crate::math::vector::{length, normal};
use crate::rounding::{
    MAX_FLAT_NODE_THICKNESS_F32, RAY_BOX_WIDENING_F64, SQUARED_LENGTH_RANGE, UNIT_ROUNDOFF_F64,
};
use crate::tuning::MIN_HEIGHT_OF_FULL_TRIANGLE;
use fearless_simd::Simd;
use glam::{DVec3, Vec3};

/// The number of children in a group.
pub(crate) const LANES: usize = 8;

/// The x, y and z coordinates of eight vectors, as one row each.
pub(crate) type Rows3 = [[f32; LANES]; 3];

/// The boxes of up to eight nodes, relative to an origin; unused lanes repeat the last child.
#[derive(Clone, Debug, Default)]
#[repr(align(32))]
pub(crate) struct BoxGroup {
    pub(crate) center: Rows3,
    pub(crate) axes: [Rows3; 3],
    pub(crate) half_extents: Rows3,
    pub(crate) rounding_radius: [f32; LANES],
    pub(crate) radius: [f32; LANES],
    pub(crate) header: GroupHeader,
    /// A bit for each lane, set if the child in that lane is a node with a single piece.
    pub(crate) leaf_mask: u8,
}

/// The stored data of a group of up to eight triangles: the common fields and the radius of each triangle's ball. The
/// corners are stored with the pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct StoredTriangleGroup {
    pub(crate) header: GroupHeader,
    /// The radius of each triangle's ball, as in [`TriangleGroup`].
    radius: [f32; LANES],
    has_thin_triangles: bool,
}

/// The corners of up to eight triangles, relative to an origin, in arrays by coordinate for vector instructions. The
/// triangles of unused lanes are points at the origin.
///
/// The layout is computed when a node is split, which takes a tenth of the time of bounding it. If stored, the groups
/// would take half of the memory of a body.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(crate) struct TriangleGroup {
    pub(crate) corners: [Rows3; 3],
    /// The radius of the ball around the mean of the corners, for each triangle.
    pub(crate) radius: [f32; LANES],
    pub(crate) header: GroupHeader,
    /// Whether one of the triangles is [thin](is_thin_triangle).
    pub(crate) has_thin_triangles: bool,
}

/// The fields that both kinds of groups have: the origin of coordinates, and the ids of the children.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GroupHeader {
    /// The origin of the group's coordinates, in the body's frame.
    pub(crate) origin: DVec3,
    /// An upper bound of the distances of the children's points from the origin.
    pub(crate) max_distance_from_origin: f32,
    /// The id of the first child; the ids of the others follow it.
    pub(crate) first_child: u32,
    pub(crate) count: u32,
}

impl GroupHeader {
    /// Returns the numbers of the children in the tree.
    pub(crate) fn children(&self) -> std::ops::Range<u32> {
        self.first_child..self.first_child + self.count
    }
}

impl BoxGroup {
    /// Creates the group of consecutive child nodes; `first` is the id of the first node.
    pub(crate) fn new(nodes: &[Node], first: u32, origin: DVec3) -> Self {
        let mut group = BoxGroup {
            header: GroupHeader {
                origin,
                max_distance_from_origin: 0.0,
                first_child: first,
                count: nodes.len() as u32,
            },
            ..BoxGroup::default()
        };
        for lane in 0..LANES {
            let node = &nodes[lane.min(nodes.len() - 1)];
            let way = node.center - origin;
            let center = way.as_vec3();
            // The rounded center is off by this much: the box and the ball grow by it.
            let off = round_up_to_f32(length(way - center.as_dvec3()));
            set_lane(&mut group.center, lane, center);
            for (rows, axis) in group.axes.iter_mut().zip(node.axes) {
                set_lane(rows, lane, axis);
            }
            for (row, half) in group.half_extents.iter_mut().zip(node.half_extents) {
                row[lane] = (half + off).next_up();
            }
            group.rounding_radius[lane] = node.rounding_radius;
            group.radius[lane] = (node.radius + off).next_up();
            let reach = round_up_to_f32(length(way) + f64::from(node.radius));
            group.header.max_distance_from_origin =
                greater(group.header.max_distance_from_origin, reach);
            if matches!(node.children, NodeChildren::Piece(_)) {
                group.leaf_mask |= 1 << lane;
            }
        }
        group
    }
}

impl StoredTriangleGroup {
    /// Creates the stored data of consecutive triangles; `first` is the id of the first triangle.
    pub(crate) fn new(triangles: &[[DVec3; 3]], first: u32, origin: DVec3) -> Self {
        let mut row = StoredTriangleGroup {
            header: GroupHeader {
                origin,
                max_distance_from_origin: 0.0,
                first_child: first,
                count: triangles.len() as u32,
            },
            radius: [0.0; LANES],
            has_thin_triangles: triangles.iter().copied().any(is_thin_triangle),
        };
        for (triangle, radius) in triangles.iter().zip(&mut row.radius) {
            let corners = triangle.map(|p| p - origin);
            let mean = (corners[0] + corners[1] + corners[2]) / 3.0;
            *radius = round_up_to_f32(longest_vector_length(
                corners.into_iter().map(|corner| corner - mean),
            ));
        }
        let corners = triangles.as_flattened().iter();
        row.header.max_distance_from_origin =
            round_up_to_f32(longest_vector_length(corners.map(|&p| p - origin)));
        row
    }
}

impl TriangleGroup {
    /// Creates the group in the layout for vector instructions, from its stored data and its triangles' corners.
    #[inline(always)]
    pub(crate) fn new<L: Simd>(
        level: L,
        row: &StoredTriangleGroup,
        triangles: &[[DVec3; 3]],
    ) -> Self {
        let mut group = TriangleGroup {
            corners: [[[0.0; LANES]; 3]; 3],
            radius: row.radius,
            header: row.header,
            has_thin_triangles: row.has_thin_triangles,
        };
        let origin = PackedVector::new(level, row.header.origin);
        for (lane, triangle) in triangles.iter().enumerate() {
            for (rows, corner) in group.corners.iter_mut().zip(triangle) {
                let way = PackedVector::new(level, *corner) - origin;
                set_lane(rows, lane, way.as_vec3());
            }
        }
        group
    }
}

/// Returns whether a triangle is a sliver: its least height is less than a [share](MIN_HEIGHT_OF_FULL_TRIANGLE) of its
/// longest edge.
#[inline(always)]
pub(crate) fn is_thin_triangle([a, b, c]: [DVec3; 3]) -> bool {
    let (p, q) = (b - a, c - a);
    let longest = greater(
        greater(p.length_squared(), q.length_squared()),
        b.distance_squared(c),
    );
    // Written so that NaN is thin.
    !(p.cross(q).length_squared() >= MIN_HEIGHT_OF_FULL_TRIANGLE.powi(2) * longest * longest)
}

/// Returns the unit normal of a triangle, or zero if it is degenerate.
pub(crate) fn unit_normal(corners: [DVec3; 3]) -> Vec3 {
    let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let square = across.length_squared();
    if SQUARED_LENGTH_RANGE.contains(&square) {
        (across * square.sqrt().recip()).as_vec3()
    } else {
        normal(corners).unwrap_or(DVec3::ZERO).as_vec3()
    }
}

/// Returns the length of the longest vector, as accurately as [`length`] computes it; 0 without vectors.
pub(super) fn longest_vector_length(vectors: impl Iterator<Item = DVec3> + Clone) -> f64 {
    let squares = vectors.clone().map(DVec3::length_squared);
    let square = squares.fold(0.0, greater);
    // The square of a longer vector is not less, so that one root suffices for all.
    if SQUARED_LENGTH_RANGE.contains(&square) {
        square.sqrt()
    } else {
        vectors.map(length).fold(0.0, greater)
    }
}

/// Rounds a number to f32, upward if f32 cannot represent it.
pub(crate) fn round_up_to_f32(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) < x {
        near.next_up()
    } else {
        near
    }
}

#[inline(always)]
fn set_lane(rows: &mut Rows3, lane: usize, v: Vec3) {
    for (row, value) in rows.iter_mut().zip(v.to_array()) {
        row[lane] = value;
    }
}

/// A node of the wide tree: an oriented box and a ball with the same center, each around all pieces below, and its
/// children.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) center: DVec3,
    /// The axes of the box as unit vectors rounded to f32; the axis of the least extent is last.
    pub(crate) axes: [Vec3; 3],
    pub(crate) half_extents: [f32; 3],
    pub(crate) radius: f32,
    /// The largest rounding radius of the pieces below, which the half extents `half` do not include.
    pub(crate) rounding_radius: f32,
    pub(crate) children: NodeChildren,
}

/// The children of a node: a group of nodes, a group of triangles, or a single piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NodeChildren {
    /// A group of nodes, by its index.
    Boxes(u32),
    /// A group of triangles, by its index.
    Triangles(u32),
    /// A single piece, by its index.
    Piece(u32),
}

impl Node {
    /// A placeholder for a node that is not fitted yet.
    pub(super) const UNFITTED: Node = Node {
        center: DVec3::ZERO,
        axes: [Vec3::ZERO; 3],
        half_extents: [0.0; 3],
        radius: 0.0,
        rounding_radius: 0.0,
        children: NodeChildren::Piece(0),
    };

    /// Returns whether the box is thin enough for the node to count as flat.
    pub(crate) fn is_thin(&self) -> bool {
        self.half_extents[2] <= MAX_FLAT_NODE_THICKNESS_F32 * self.radius
    }

    /// Returns half the extent of the box along one of its axes, rounding radius included, widened for the rounding of
    /// the axes.
    pub(super) fn widened_half_extent(&self, axis: usize) -> f64 {
        f64::from(self.half_extents[axis])
            + f64::from(self.rounding_radius)
            + RAY_BOX_WIDENING_F64 * f64::from(self.radius)
    }

    /// Returns whether a point is in the box, or within about `reach` of it.
    pub(super) fn is_near(&self, point: DVec3, reach: f64) -> bool {
        let way = point - self.center;
        let reach = reach + 8.0 * UNIT_ROUNDOFF_F64 * way.abs().element_sum();
        (0..3).all(|k| {
            way.dot(self.axes[k].as_dvec3()).abs() <= self.widened_half_extent(k) + 1.001 * reach
        })
    }
}
