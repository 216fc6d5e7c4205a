//! Finds axes whose support gap certifies that two features are nearest, if the march ends in a tie.

use crate::feature::{Feature, Pair};
use crate::placed::{PlacedPair, PlacedPolytope};
use crate::polytope::{Polytope, unit_or_zero};
use crate::tolerance::{
    MAX_AXIS_EDGES, MAX_CERTIFIED_GAP_DEFICIT, MAX_RELATIVE_CERTIFIED_GAP_DEFICIT,
};
use crate::witness::{Witness, perpendicular_part};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// A unit vector, and the support gap along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) direction: DVec3,
    pub(crate) gap: f64,
}

impl Axis {
    /// Creates the axis along a direction of any length, with its support gap; −∞ for a zero direction.
    pub(crate) fn from_direction(placed: &PlacedPair<'_>, direction: DVec3) -> Self {
        let direction = unit_or_zero(direction);
        let gap = if direction == DVec3::ZERO {
            f64::NEG_INFINITY
        } else {
            gap(placed, direction)
        };
        Axis { direction, gap }
    }

    /// Returns whether the support gap along the axis equals the given distance, up to rounding.
    ///
    /// Written so that NaN is not certified.
    pub(crate) fn certifies(&self, distance: f64, placed: &PlacedPair<'_>) -> bool {
        let slack = MAX_CERTIFIED_GAP_DEFICIT * placed.scale.size
            + MAX_RELATIVE_CERTIFIED_GAP_DEFICIT * distance;
        self.direction != DVec3::ZERO && distance - self.gap <= slack
    }
}

/// Returns the support gap `min_B n·y − max_A n·x` along a unit vector.
pub(crate) fn gap(placed: &PlacedPair<'_>, n: DVec3) -> f64 {
    let highest = placed.a.0.vertices.iter().map(|v| n.dot(v.point));
    let own = placed.b.to_a.inverse_transform_vector(n);
    let lowest = placed.b.shape().vertices.iter().map(|v| own.dot(v.point));
    lowest.fold(f64::INFINITY, lesser) + n.dot(placed.b.to_a.translation)
        - highest.fold(f64::NEG_INFINITY, greater)
}

/// Returns an upper bound of the gap along a direction, from two corners that are extremal up to rounding.
fn gap_upper_bound(placed: &PlacedPair<'_>, direction: DVec3) -> f64 {
    let n = unit_or_zero(direction);
    let highest = placed.a.0.vertex(placed.a.0.extremal_vertex(n)).point;
    let shape = placed.b.shape();
    let own = -placed.b.to_a.inverse_transform_vector(n);
    let lowest = placed.b.vertex(shape.extremal_vertex(own));
    // The axis of a zero direction separates nothing.
    let known = n != DVec3::ZERO;
    if known {
        n.dot(lowest - highest) + placed.scale.rounding()
    } else {
        f64::NEG_INFINITY
    }
}

/// Returns the axis with the largest support gap among directions that the features around the nearest points span.
///
/// The directions along which features are extremal form a cone; a rounded vector may fall out of it. Its borders are
/// also tried: the normals of adjacent faces, cross products of edges, the vector across each edge; and for coplanar or
/// collinear features, directions within the plane or line.
pub(crate) fn best_axis(placed: &PlacedPair<'_>, pair: Pair, witness: &Witness) -> Axis {
    let (distance, offset) = (witness.distance(), witness.separation_vector());
    let mut best = Axis::from_direction(placed, witness.claim.axis);
    if best.certifies(distance, placed) {
        return best;
    }
    let mut offer = |direction: DVec3| {
        for direction in [direction, -direction] {
            // Written so that NaN is not better.
            if !(gap_upper_bound(placed, direction) > best.gap) {
                continue;
            }
            let axis = Axis::from_direction(placed, direction);
            if axis.gap > best.gap {
                best = axis;
            }
        }
    };
    let around_a = FeatureDirections::new(&placed.a, pair.a, offset);
    let around_b = FeatureDirections::new(&placed.b, pair.b, offset);
    for around in [&around_a, &around_b] {
        around.perpendiculars.iter().copied().for_each(&mut offer);
        for &edge in &around.edges {
            offer(perpendicular_part(offset, edge));
            offer(edge);
        }
    }
    for one in &around_a.edges {
        for other in &around_b.edges {
            offer(perpendicular_part(
                perpendicular_part(one.cross(*other), *one),
                *other,
            ));
        }
    }
    best
}

/// The directions of the edges and faces at a feature, in A's frame.
struct FeatureDirections {
    edges: Vec<DVec3>,
    /// The normals of the faces, then the directions perpendicular to an edge, in the plane of each face.
    perpendiculars: Vec<DVec3>,
}

impl FeatureDirections {
    fn new<P: PlacedPolytope>(polytope: &P, feature: Feature, offset: DVec3) -> Self {
        let shape: &Polytope = polytope.shape();
        let mut edges = shape.edges_containing(feature);
        let slope = |e: u32| polytope.vector(shape.edge(e).direction).dot(offset).abs();
        edges.sort_by(|&e, &f| slope(e).total_cmp(&slope(f)));
        edges.truncate(MAX_AXIS_EDGES);
        let faces = shape.faces_containing(feature, &edges);
        let normals = faces.iter().map(|&f| shape.face(f).normal);
        let within = edges.iter().flat_map(|&e| shape.edge(e).inward_directions);
        let along = edges.iter().map(|&e| shape.edge(e).direction);
        let turned = |local| polytope.vector(local);
        FeatureDirections {
            perpendiculars: normals.chain(within).map(turned).collect(),
            edges: along.map(turned).collect(),
        }
    }
}

#[cfg(test)]
mod tests;
