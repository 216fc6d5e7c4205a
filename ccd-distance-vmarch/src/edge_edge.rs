//! An edge against an edge `[VCLIP98 §3.2]`.

use crate::clip;
use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Behind, Feature, Next, Whose};
use crate::place::{Line, Placed, Scale, clamped};
use crate::polytope::Edge;
use crate::tolerance::{LEVEL, PARALLEL};
use ccd_core::glam::DVec3;

/// The nearest points of both edges against the other edge's planes, vertex-edge planes first: on to a
/// corner where a nearest point is an end, to a face on whose side the other edge's point lies.
#[inline]
pub(crate) fn next<X: Placed, Y: Placed>(x: &X, e: u32, y: &Y, f: u32, scale: Scale) -> Next {
    let (one, other) = (x.line(e), y.line(f));
    let (edge_x, edge_y) = (x.shape().edge(e), y.shape().edge(f));
    let near = nearest(&one, &other);
    let ends = [
        end_of(edge_x, near.parameters[0]),
        end_of(edge_y, near.parameters[1]),
    ];
    match ends {
        [Some(v), Some(w)] => return Next::To(Feature::Vertex(v), Feature::Vertex(w)),
        [Some(v), None] => return Next::To(Feature::Vertex(v), Feature::Edge(f)),
        [None, Some(w)] => return Next::To(Feature::Edge(e), Feature::Vertex(w)),
        [None, None] => {}
    }
    let way = other.at(near.parameters[1]) - one.at(near.parameters[0]);
    let rounding = scale.rounding();
    let distance = way.length();
    if distance <= rounding {
        return Next::Stop(Tied);
    }
    // The way as it is, or the direction across both edges: whichever rounding turns less.
    let sine = near.across.length();
    let (axis, slack) = if sine * scale.size > distance {
        let turned = if near.across.dot(way) < 0.0 {
            -1.0
        } else {
            1.0
        };
        (near.across * turned, LEVEL)
    } else {
        (way, rounding)
    };
    let slope_x = x.inward(edge_x, axis);
    if let Some(side) = side_faced(x, edge_x, slope_x, slack, way) {
        let behind = Behind {
            feature: Feature::Edge(f),
            point: other.at(near.parameters[1]),
            face: side.face,
        };
        return match side.below {
            Below::No => Next::To(Feature::Face(side.face), Feature::Edge(f)),
            Below::Both => Next::Behind(Whose::Y, behind),
        };
    }
    let slope_y = y.inward(edge_y, -axis);
    if let Some(side) = side_faced(y, edge_y, slope_y, slack, -way) {
        let behind = Behind {
            feature: Feature::Edge(e),
            point: one.at(near.parameters[0]),
            face: side.face,
        };
        return match side.below {
            Below::No => Next::To(Feature::Edge(e), Feature::Face(side.face)),
            Below::Both => Next::Behind(Whose::X, behind),
        };
    }
    let clear = edge_x.is_clear(slope_x, slack) && edge_y.is_clear(slope_y, slack);
    Next::Stop(if clear { Sure } else { Tied })
}

/// The nearest points of two segments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    /// Where they are on either.
    pub(crate) parameters: [f64; 2],
    /// The cross product of the directions; its length is the sine of the angle between them.
    pub(crate) across: DVec3,
}

/// The nearest points, an end exactly where an end is nearest.
///
/// Where the segments are nearly parallel, the first parameter is off by rounding over the sine; as
/// the second one is found from it, the points are no farther apart for that than by rounding.
#[inline(always)]
pub(crate) fn nearest(one: &Line, other: &Line) -> Near {
    let across = one.along.cross(other.along);
    let between = other.start - one.start;
    let square = across.length_squared();
    let s = if square > PARALLEL * PARALLEL {
        clamped(between.cross(other.along).dot(across) / square, one.length)
    } else {
        clip::beside(one, other)
    };
    let free = (one.at(s) - other.start).dot(other.along);
    let t = clamped(free, other.length);
    // Where the line's point is beyond the segment's end, that end's foot is nearest.
    let s = if free == t {
        s
    } else {
        one.nearest(other.at(t))
    };
    Near {
        parameters: [s, t],
        across,
    }
}

/// The end that a parameter is at.
#[inline(always)]
fn end_of(edge: &Edge, parameter: f64) -> Option<u32> {
    if !(parameter > 0.0) {
        Some(edge.ends[0])
    } else if !(parameter < edge.length) {
        Some(edge.ends[1])
    } else {
        None
    }
}

/// The face on whose side of an edge something lies.
struct Side {
    face: u32,
    below: Below,
}

enum Below {
    No,
    /// Below the other face, too, and farther.
    Both,
}

#[inline(always)]
fn side_faced<P: Placed>(
    p: &P,
    edge: &Edge,
    slopes: [f64; 2],
    slack: f64,
    way: DVec3,
) -> Option<Side> {
    let face = match slopes.map(|slope| slope > slack) {
        [false, false] => return None,
        [true, false] => edge.faces[0],
        [false, true] => edge.faces[1],
        [true, true] => {
            let height = edge
                .faces
                .map(|f| p.vector(p.shape().face(f).normal).dot(way));
            let higher = usize::from(height[1] > height[0]);
            return Some(Side {
                face: edge.faces[higher],
                below: if height[higher] > 0.0 {
                    Below::No
                } else {
                    Below::Both
                },
            });
        }
    };
    Some(Side {
        face,
        below: Below::No,
    })
}

#[cfg(test)]
mod tests;
