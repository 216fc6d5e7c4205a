//! Bodies in a cell, and the convex hulls that enclose them, in the frames to which they are fixed.

mod plane;
pub(crate) mod rounded_box;

use super::clusters::connected_clusters;
use ccd_core::fan_triangles;
use ccd_core::order::greater;
use ccd_core::{Body, Facet, FacetOrigin, Facets, Piece, Pieces, Polytope, Solidity, SupportMap};
use plane::Plane;
use rigid_ccd::glam::{DMat3, DVec3};
use rigid_ccd::oracle::Frame;
use rigid_ccd::{Pose, Remark};
use std::sync::Arc;

/// A body of a cell in the frame to which it is fixed: the frame that a joint moves, or the base for a static body.
#[derive(Clone, Debug)]
pub(crate) struct PlacedBody {
    pub(crate) body: Arc<Body>,
    /// The pose of the body in the frame.
    pub(crate) pose: Pose,
    /// The index of the frame in [`Kinematics`](crate::kinematics::Kinematics).
    pub(crate) frame: usize,
    /// The side lengths of the bounding box along the body's own axes.
    pub(super) sides: [f64; 3],
    /// For a plane, the distance from the base within which its box acts as a half-space; `None` for other bodies.
    pub(super) plane_reach: Option<f64>,
    /// Convex hulls whose union contains the body, in the body's frame.
    hulls: Vec<Arc<Hull>>,
}

/// A convex hull around some pieces of a body, in the body's frame.
#[derive(Debug)]
pub(crate) struct Hull {
    corners: Vec<DVec3>,
    support_map: SupportMap,
    /// The radius of the ball with which the hull is rounded (Minkowski sum).
    rounding_radius: f64,
}

/// A convex hull around some pieces of a body, in the frame to which the body is fixed.
#[derive(Clone, Debug)]
pub(crate) struct HullPart {
    /// The index of the body in the cell.
    pub(crate) owner: usize,
    /// The index of the frame.
    pub(crate) frame: usize,
    /// The corners of the hull in the frame.
    points: Vec<DVec3>,
    /// The hull in the body's frame, in which support points are searched, and the rotation from there to the frame of
    /// this part.
    hull: Arc<Hull>,
    rotation: DMat3,
    /// The radius of the ball with which the hull is rounded (Minkowski sum).
    pub(crate) radius: f64,
    /// Whether the rounded hull is exactly the body.
    pub(crate) is_convex: bool,
    /// For a half-space, the plane that bounds it; `None` for other bodies.
    pub(crate) plane: Option<Plane>,
    /// The excess of the body: how far it may protrude from the shape that it encloses.
    pub(crate) excess_over_shape: f64,
    /// The center and the half extents of the rounded hull's bounding box along the frame's axes.
    pub(crate) center: DVec3,
    pub(crate) half_extents: DVec3,
    /// The radius of the bounding ball of the rounded hull, about `center`.
    pub(crate) ball_radius: f64,
    /// An upper bound of the numbers from which the corners were computed, for bounds of rounding errors: the length of
    /// the body's position plus its largest coordinate. The corners may be much nearer to the frame's origin.
    pub(crate) coordinate_bound: f64,
}

impl PlacedBody {
    /// Creates a body and its enclosing hulls: one hull if `max_hulls` is 1, otherwise up to `max_hulls` for each
    /// connected component. A polytope gets surface triangles, which the engine uses against bodies of many triangles.
    pub(crate) fn new(body: Arc<Body>, pose: Pose, frame: usize, max_hulls: usize) -> Self {
        let body = match hull_surface_of_polytope(&body) {
            Some(surface) => Body::clone(&body)
                .with_surface_triangles(surface)
                .map_or(body, Arc::new),
            None => body,
        };
        let clusters = connected_clusters(&body, max_hulls);
        let hulls = clusters
            .iter()
            .map(|pieces| Arc::new(Hull::around_pieces(pieces)))
            .collect();
        PlacedBody {
            sides: Remark::sides(&body),
            body,
            pose,
            frame,
            plane_reach: None,
            hulls,
        }
    }

    /// Returns the body at another pose in its frame.
    pub(super) fn moved_to(&self, pose: Pose) -> Self {
        match self.plane_reach {
            Some(reach) => PlacedBody::for_plane(pose, reach),
            None => PlacedBody {
                pose,
                ..self.clone()
            },
        }
    }

    /// Returns the hulls as parts of a cell, in which the body has the index `owner`.
    pub(crate) fn parts(&self, owner: usize) -> Vec<HullPart> {
        let hulls = self.hulls.iter();
        hulls.map(|hull| HullPart::new(hull, self, owner)).collect()
    }
}

impl Hull {
    fn around_pieces(pieces: &[Piece<'_>]) -> Self {
        let radii = pieces.iter().map(|piece| piece.radius);
        let points = pieces.iter().flat_map(|piece| piece.points);
        let (corners, support) = corners_of_hull(points.copied().collect());
        Hull {
            corners,
            support_map: support,
            rounding_radius: radii.fold(0.0, greater),
        }
    }

    /// Returns the index of a corner that is farthest along a direction.
    #[inline(always)]
    fn extremal_corner(&self, direction: DVec3) -> u32 {
        match &self.support_map {
            // Called directly, so that it is inlined into functions that are compiled for vector instructions.
            SupportMap::Scan(scan) => scan.extremal_point(direction),
            other => other.extremal_point(direction),
        }
    }
}

/// Returns the surface triangles of a body that is one solid polytope without a surface; `None` for other bodies.
/// Computes the hull again, because the facets of a given polytope are not verified.
fn hull_surface_of_polytope(body: &Body) -> Option<Body> {
    if body.pieces().len() != 1 || body.solidity() != Solidity::Solid || body.has_surface() {
        return None;
    }
    let piece = body.pieces().get(0);
    if piece.radius > 0.0 {
        return None;
    }
    let hull = ccd_decomp::convex_hull(piece.points).ok()?;
    // A flat polygon has two facets and no volume.
    if hull.facets.iter().count() < 3 {
        return None;
    }
    let triangles: Vec<[u32; 3]> = hull.facets.iter().flat_map(fan_triangles).collect();
    let ids: Vec<u32> = (0..triangles.len() as u32).collect();
    let pieces = Pieces::from_triangles(&hull.points, &triangles, &ids).ok()?;
    let hierarchy = ccd_decomp::build_hierarchy(&pieces).ok()?;
    Body::with_hierarchy(&pieces, &hierarchy, Solidity::Solid).ok()
}

impl HullPart {
    fn new(hull: &Arc<Hull>, placed: &PlacedBody, owner: usize) -> Self {
        let corners = hull.corners.iter();
        let points: Vec<DVec3> = corners
            .map(|&corner| placed.pose.transform_point(corner))
            .collect();
        let radius = hull.rounding_radius;
        let (mut min, mut max) = (points[0], points[0]);
        for &point in &points {
            (min, max) = (min.min(point), max.max(point));
        }
        let lengths = hull.corners.iter().map(|corner| corner.length());
        let largest_length = lengths.fold(0.0, greater);
        let center = 0.5 * (min + max);
        let core_radius = points
            .iter()
            .map(|point| point.distance(center))
            .fold(0.0, greater);
        HullPart {
            owner,
            frame: placed.frame,
            points,
            hull: Arc::clone(hull),
            rotation: DMat3::from_quat(placed.pose.rotation()),
            radius,
            is_convex: placed.body.pieces().len() == 1,
            plane: placed.plane_reach.map(|_| Plane::below(&placed.pose)),
            excess_over_shape: placed.body.excess(),
            center,
            half_extents: 0.5 * (max - min) + DVec3::splat(radius),
            ball_radius: core_radius + radius,
            coordinate_bound: placed.pose.translation().length() + largest_length + radius,
        }
    }

    /// Returns the corners of the hull.
    pub(crate) fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns the corner that is farthest along a direction of the frame, with its index.
    #[inline(always)]
    pub(crate) fn extremal_corner(&self, direction: DVec3) -> (u32, DVec3) {
        let direction_in_body = self.rotation.transpose() * direction;
        let index = self.hull.extremal_corner(direction_in_body);
        (index, self.points[index as usize])
    }

    /// Returns the half extents of the bounding box along the base's axes, for a frame at `frame`.
    #[inline(always)]
    pub(crate) fn box_half_extents(&self, frame: &Frame) -> DVec3 {
        let (rotation, extents) = (&frame.rotation, self.half_extents);
        rotation.x_axis.abs() * extents.x
            + rotation.y_axis.abs() * extents.y
            + rotation.z_axis.abs() * extents.z
    }
}

/// Returns the corners of the convex hull of some points, and their support map. If the hull cannot be computed, all
/// points count as corners.
fn corners_of_hull(points: Vec<DVec3>) -> (Vec<DVec3>, SupportMap) {
    let with_facets = ccd_decomp::convex_hull(&points).ok().and_then(|hull| {
        let facets = hull.facets.iter().map(|corners| Facet {
            origin: FacetOrigin::Virtual,
            corners: corners.to_vec(),
        });
        let polytope = Polytope {
            facets: facets.collect(),
            points: hull.points,
            ..Polytope::default()
        };
        Pieces::from_polytopes(&[polytope]).ok()
    });
    match with_facets {
        Some(pieces) => {
            let Piece { points, facets, .. } = pieces.get(0);
            (points.to_vec(), SupportMap::new(points, facets))
        }
        None => {
            let support = SupportMap::new(&points, Facets::EMPTY);
            (points, support)
        }
    }
}
