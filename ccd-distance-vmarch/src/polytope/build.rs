//! Prepares pieces for marching: merges their facets into faces, and checks that they are convex.

use super::facets::{Facets, distance_from_line};
use super::support::StartVertexTable;
use super::{Polytope, assemble, convex, merge};
use crate::tolerance::{COPLANARITY_TOLERANCE, MAX_SCANNED_CORNERS};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::{GiveUpReason, Piece};

impl Polytope {
    /// Makes the polytope of a piece: merges coplanar facets into faces, and checks that the piece is convex.
    ///
    /// # Errors
    /// [`GiveUpReason::BadFacets`] for a piece without points, or with points that are not finite. Also
    /// for a piece of more than three points, not all on a line, whose facets are missing, do not
    /// close a surface, or are not those of a convex polytope.
    ///
    /// # Complexity
    /// n log n of the corners of all facets.
    pub(crate) fn new(piece: &Piece<'_>) -> Result<Self, GiveUpReason> {
        let points = piece.points;
        let finite = points.iter().all(|p| p.is_finite());
        if points.is_empty() || !finite || u32::try_from(points.len()).is_err() {
            return Err(GiveUpReason::BadFacets);
        }
        let largest = points.iter().map(|p| p.abs().max_element());
        let rounding = COPLANARITY_TOLERANCE * largest.fold(0.0, greater);
        let ends = distant_point_indices(points);
        let line = ends.map(|v| points[v as usize]);
        if !(line[0].distance(line[1]) > rounding) {
            return Ok(Self::from_outlines(points, &[0], &[]));
        }
        if points
            .iter()
            .all(|&p| distance_from_line(p, line) <= rounding)
        {
            return Ok(Self::from_outlines(points, &ends, &[]));
        }
        let facets = match points.len() {
            // Front and back of a triangle without thickness.
            3 => Facets::from_loops(points, vec![vec![0, 1, 2], vec![0, 2, 1]]),
            _ => Facets::new(points, piece.facets.iter()),
        };
        let facets = facets.ok_or(GiveUpReason::BadFacets)?;
        // For needles thinner than 1e-10, facets within rounding of one plane need not form a convex polygon; they are
        // then separate faces.
        let merged = [rounding, 0.0].into_iter().find_map(|coplanar| {
            let loops = merge::merge(points, &facets, coplanar)?;
            let polytope = Self::from_outlines(points, &ends, &loops);
            convex::is_convex(points, &polytope, rounding).then_some(polytope)
        });
        merged.ok_or(GiveUpReason::BadFacets)
    }

    fn from_outlines(points: &[DVec3], ends: &[u32], loops: &[Vec<u32>]) -> Self {
        let mut polytope = assemble::assemble_polytope(points, ends, loops);
        if polytope.vertices.len() > MAX_SCANNED_CORNERS {
            polytope.start_vertex_table = Some(Box::new(StartVertexTable::new(&polytope)));
        }
        polytope
    }
}

/// Returns the indices of two points that are far apart: a point farthest from the first one, and a point farthest from
/// that.
fn distant_point_indices(points: &[DVec3]) -> [u32; 2] {
    let farthest = |from: DVec3| {
        let distances = points.iter().map(|p| p.distance(from)).zip(0..);
        let none = (0.0, 0);
        distances
            .fold(none, |best, here| if here.0 > best.0 { here } else { best })
            .1
    };
    let one = farthest(points[0]);
    [one, farthest(points[one as usize])]
}
