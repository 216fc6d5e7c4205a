//! Children in groups of eight, one array per coordinate, for eight bounds at once.

use super::node::{Below, Node};
use crate::math::order::greater;
use crate::math::vector::{length, normal};
use crate::tolerance::SQUARES;
use glam::{DVec3, Vec3};

/// The number of children in a group.
pub(crate) const LANES: usize = 8;

/// Three coordinates, eight each.
pub(crate) type Rows3 = [[f32; LANES]; 3];

/// Up to eight nodes, relative to an origin; unused lanes repeat the last child.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(crate) struct BoxGroup {
    pub(crate) centre: Rows3,
    pub(crate) axes: [Rows3; 3],
    pub(crate) half: Rows3,
    pub(crate) rounding: [f32; LANES],
    pub(crate) radius: [f32; LANES],
    pub(crate) members: Members,
    /// The lanes that hold a single piece.
    pub(crate) leaves: u8,
}

/// Up to eight triangles, relative to an origin; unused lanes repeat the last one.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(crate) struct TriangleGroup {
    pub(crate) corners: [Rows3; 3],
    /// Unit normals; zero for a triangle without one.
    pub(crate) normal: Rows3,
    /// The radius about the mean of the corners.
    pub(crate) radius: [f32; LANES],
    pub(crate) members: Members,
}

/// The fields that every group has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Members {
    /// The origin in the body's frame; rows are relative to it.
    pub(crate) origin: DVec3,
    /// An upper bound of the children's reach from the origin.
    pub(crate) reach: f32,
    /// The id of the first child; the others follow.
    pub(crate) first: u32,
    pub(crate) count: u32,
}

impl BoxGroup {
    /// A place for a group.
    pub(super) const EMPTY: BoxGroup = BoxGroup {
        centre: [[0.0; LANES]; 3],
        axes: [[[0.0; LANES]; 3]; 3],
        half: [[0.0; LANES]; 3],
        rounding: [0.0; LANES],
        radius: [0.0; LANES],
        members: Members::NONE,
        leaves: 0,
    };

    /// Lays out consecutive nodes; `first` is the id of the first one.
    pub(crate) fn new(nodes: &[Node], first: u32, origin: DVec3) -> Self {
        let mut group = BoxGroup {
            members: Members {
                origin,
                reach: 0.0,
                first,
                count: nodes.len() as u32,
            },
            ..BoxGroup::EMPTY
        };
        for lane in 0..LANES {
            let node = &nodes[lane.min(nodes.len() - 1)];
            let way = node.centre - origin;
            let centre = way.as_vec3();
            // The rounded centre is off by this much: box and ball grow by it.
            let off = up(length(way - centre.as_dvec3()));
            set(&mut group.centre, lane, centre);
            for (rows, axis) in group.axes.iter_mut().zip(node.axes) {
                set(rows, lane, axis);
            }
            for (row, half) in group.half.iter_mut().zip(node.half) {
                row[lane] = (half + off).next_up();
            }
            group.rounding[lane] = node.rounding;
            group.radius[lane] = (node.radius + off).next_up();
            let reach = up(length(way) + f64::from(node.radius));
            group.members.reach = greater(group.members.reach, reach);
            if matches!(node.below, Below::Piece(_)) {
                group.leaves |= 1 << lane;
            }
        }
        group
    }
}

impl Members {
    const NONE: Members = Members {
        origin: DVec3::ZERO,
        reach: 0.0,
        first: 0,
        count: 0,
    };
}

impl TriangleGroup {
    /// A place for a group.
    pub(super) const EMPTY: TriangleGroup = TriangleGroup {
        corners: [[[0.0; LANES]; 3]; 3],
        normal: [[0.0; LANES]; 3],
        radius: [0.0; LANES],
        members: Members::NONE,
    };

    /// Lays out consecutive triangles; `first` is the id of the first one.
    pub(crate) fn new(triangles: &[[DVec3; 3]], first: u32, origin: DVec3) -> Self {
        let mut group = TriangleGroup {
            members: Members {
                origin,
                reach: 0.0,
                first,
                count: triangles.len() as u32,
            },
            ..TriangleGroup::EMPTY
        };
        for lane in 0..LANES {
            let corners = triangles[lane.min(triangles.len() - 1)].map(|p| p - origin);
            let mean = (corners[0] + corners[1] + corners[2]) / 3.0;
            for (rows, corner) in group.corners.iter_mut().zip(corners) {
                set(rows, lane, corner.as_vec3());
                let reach = up(length(corner));
                group.members.reach = greater(group.members.reach, reach);
                group.radius[lane] = greater(group.radius[lane], up(length(corner - mean)));
            }
            set(&mut group.normal, lane, unit_normal(corners));
        }
        group
    }
}

/// Returns the unit normal of a triangle, or zero when it has none.
pub(crate) fn unit_normal(corners: [DVec3; 3]) -> Vec3 {
    let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let square = across.length_squared();
    match SQUARES.contains(&square) {
        // In f32 a reciprocal is accurate enough.
        true => (across * square.sqrt().recip()).as_vec3(),
        false => normal(corners).unwrap_or(DVec3::ZERO).as_vec3(),
    }
}

/// Returns the nearest f32 that is not below.
pub(crate) fn up(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) < x {
        near.next_up()
    } else {
        near
    }
}

fn set(rows: &mut Rows3, lane: usize, v: Vec3) {
    for (row, value) in rows.iter_mut().zip(v.to_array()) {
        row[lane] = value;
    }
}
