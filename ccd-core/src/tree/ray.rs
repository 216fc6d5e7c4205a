//! How often a ray passes out of the surface of a body.

use super::{Below, Node, Tree};
use crate::order::{greater, lesser};
use crate::pieces::Pieces;
use crate::tolerance::GRAZING;
use glam::DVec3;

/// How often a ray leaves the body's surface less how often it enters it, by the normals of its
/// triangles: the winding number of a closed mesh about the ray's start. None when the ray passes too
/// near to an edge, or starts too near to a triangle, to tell.
///
/// The surface of pieces that are no triangles is the mesh's faces on them.
pub(crate) fn crossings(tree: &Tree, pieces: &Pieces, from: DVec3, along: DVec3) -> Option<i32> {
    let mut total = 0;
    let mut stack = vec![0u32];
    while let Some(id) = stack.pop() {
        let node = &tree.nodes[id as usize];
        if !meets(node, from, along) {
            continue;
        }
        match node.below {
            Below::Boxes(group) => {
                let members = &tree.boxes[group as usize].members;
                stack.extend(members.first..members.first + members.count);
            }
            Below::Triangles(group) => {
                let members = &tree.triangles[group as usize].members;
                let first = members.first - tree.nodes.len() as u32;
                for piece in first..first + members.count {
                    total += crossing(pieces.triangle(piece as usize), from, along)?;
                }
            }
            Below::Piece(piece) => {
                for (_, triangle) in pieces.get(piece as usize).mesh_triangles() {
                    total += crossing(triangle, from, along)?;
                }
            }
        }
    }
    Some(total)
}

/// Whether a ray may meet a node's box.
fn meets(node: &Node, from: DVec3, along: DVec3) -> bool {
    let way = from - node.centre;
    let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
    for k in 0..3 {
        let axis = node.axes[k].as_dvec3();
        let half = node.reach_f64(k);
        let (start, speed) = (axis.dot(way), axis.dot(along));
        let (near, far) = ((-half - start) / speed, (half - start) / speed);
        // A ray within a slab, parallel to it, gives an infinity on either side; NaN counts as met.
        enter = greater(enter, lesser(near, far));
        leave = lesser(leave, greater(near, far));
    }
    !(enter > leave)
}

/// 1 when the ray leaves through the triangle, −1 when it enters, 0 when it passes by.
fn crossing(triangle: [DVec3; 3], from: DVec3, along: DVec3) -> Option<i32> {
    let [a, b, c] = triangle.map(|p| p - from);
    // Volumes of the ray with each edge: all of one sign where the line passes inside.
    let sides = [(a, b), (b, c), (c, a)].map(|(p, q)| {
        let volume = along.dot(p.cross(q));
        let clear = volume.abs() > GRAZING * p.length() * q.length();
        (volume, clear)
    });
    let positive = |&(volume, clear): &(f64, bool)| clear && volume > 0.0;
    let negative = |&(volume, clear): &(f64, bool)| clear && volume < 0.0;
    if sides.iter().any(positive) && sides.iter().any(negative) {
        return Some(0);
    }
    let sign = match () {
        () if sides.iter().all(positive) => 1.0,
        () if sides.iter().all(negative) => -1.0,
        () => return None,
    };
    let height = sign * a.dot((b - a).cross(c - a));
    let scale = a.length() * (b - a).length() * (c - a).length();
    match () {
        () if height > GRAZING * scale => Some(sign as i32),
        () if height < -GRAZING * scale => Some(0),
        () => None,
    }
}
