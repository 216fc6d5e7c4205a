//! The transition of the march from a corner against a face `[VCLIP98 §3.2]`.

use crate::feature::Certainty::{Sure, Tied};
use crate::feature::{Behind, Feature, Next, Which};
use crate::placed::{Placed, Scale};
use crate::tolerance::PRODUCT_ERROR;

/// Tests the corner against all face-edge planes, and continues with the edge of the most violated one. Above the face,
/// it continues with the corner's edge that falls towards the face most steeply.
///
/// The nearest violated plane would be wrong: its edge need not be nearer.
#[inline]
pub(crate) fn next<X: Placed, Y: Placed>(x: &X, v: u32, y: &Y, f: u32, scale: Scale) -> Next {
    let corner = x.vertex(v);
    let (mut least, mut outside) = (0.0, None);
    let mut height = 0.0;
    let normal = y.vector(y.shape().face(f).normal);
    for side in y.shape().sides_of(f) {
        let from = corner - y.point(side.start);
        let inside = y.vector(side.inward).dot(from);
        if inside < least {
            (least, outside) = (inside, Some(side.edge));
        }
        height = normal.dot(from);
    }
    if let Some(edge) = outside {
        return Next::To(Feature::Vertex(v), Feature::Edge(edge));
    }
    let rounding = scale.rounding();
    if height < -rounding {
        return Next::Behind(
            Which::X,
            Behind {
                feature: Feature::Vertex(v),
                point: corner,
                face: f,
            },
        );
    }
    if height <= rounding {
        return Next::Stop(Tied);
    }
    let (mut lowest, mut falling) = (-PRODUCT_ERROR, None);
    for spoke in x.shape().spokes_of(v) {
        let slope = x.vector(spoke.along).dot(normal);
        if slope < lowest {
            (lowest, falling) = (slope, Some(spoke.edge));
        }
    }
    match falling {
        Some(edge) => Next::To(Feature::Edge(edge), Feature::Face(f)),
        // The face's normal is accurate up to rounding, however near the corner is.
        None => Next::Stop(Sure),
    }
}

#[cfg(test)]
mod tests;
