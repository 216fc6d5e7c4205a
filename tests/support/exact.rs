//! Locates points relative to closed meshes in exact arithmetic, to judge decompositions.
//!
//! It shares no code with the code under test.

mod blend;
mod predicates;
mod samples;

pub use blend::ConvexCombination;
use ccd_core::order::{greater, lesser};
pub use samples::{SampleCounts, samples};

use crate::models::Mesh;
use blend::LazyPoint;
use ccd_core::glam::{DVec2, DVec3};
use predicates::{PROJECTION_AXES, side, triangle_contains_lazy_point, turn};
use std::cmp::Ordering;

/// The location of a point relative to a closed mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// The point is outside: its winding number is zero.
    Outside,
    /// The point is on a face of the mesh.
    Surface,
    /// The point is inside, with this winding number, which is negative for a mesh that is inside out.
    Inside(i32),
}

/// A closed mesh with a search structure for locating points in it.
pub struct Solid<'a> {
    mesh: &'a Mesh,
    columns: Columns,
}

/// Returns the exact side of a triangle on which a point is: above (greater), below (less) or in its plane. The
/// triangle is counter-clockwise seen from above.
pub fn side_of(triangle: [DVec3; 3], point: &ConvexCombination) -> Ordering {
    side(triangle, &LazyPoint::new(point))
}

/// Returns true, by exact arithmetic, if a triangle with its boundary contains a point.
pub fn triangle_contains_point(triangle: [DVec3; 3], point: &ConvexCombination) -> bool {
    triangle_contains_lazy_point(triangle, &LazyPoint::new(point))
}

/// Returns true, by exact arithmetic, if a triangle has no area.
pub fn is_degenerate([a, b, c]: [DVec3; 3]) -> bool {
    let point = ConvexCombination::mean([c]);
    let spot = LazyPoint::new(&point);
    let in_line = |&view: &[usize; 2]| turn(view, [a, b], &spot) == Ordering::Equal;
    PROJECTION_AXES.iter().all(in_line)
}

/// Returns true, by exact arithmetic, if a loop of coplanar points is a convex polygon, of either orientation. Corners
/// may be collinear.
pub fn is_convex_polygon(corners: &[DVec3]) -> bool {
    let spots: Vec<ConvexCombination> = corners
        .iter()
        .map(|&p| ConvexCombination::mean([p]))
        .collect();
    PROJECTION_AXES.iter().any(|&view| {
        let mut turns = (0..corners.len()).flat_map(|k| {
            let edge = [corners[k], corners[(k + 1) % corners.len()]];
            spots
                .iter()
                .map(move |p| turn(view, edge, &LazyPoint::new(p)))
        });
        let first = turns.find(|&turn| turn != Ordering::Equal);
        first.is_some_and(|first| !turns.any(|turn| turn == first.reverse()))
    })
}

impl<'a> Solid<'a> {
    /// Prepares a closed mesh for locating points. Every edge must have the same number of faces in either direction.
    pub fn new(mesh: &'a Mesh) -> Self {
        Solid {
            mesh,
            columns: Columns::new(mesh),
        }
    }

    /// Returns the exact location of a point, from the faces that an upward ray from it crosses.
    ///
    /// The ray is moved sideways by (ε, ε²), with ε smaller than any number. It therefore meets no
    /// edge and no upright face, and there are no special cases.
    pub fn locate(&self, point: &ConvexCombination) -> Location {
        let p = LazyPoint::new(point);
        let mut windings = 0;
        for &face in self.columns.candidate_faces(&p) {
            let triangle = self.mesh.triangle(face as usize);
            let top = greater(greater(triangle[0].z, triangle[1].z), triangle[2].z);
            if top < p.rounded_point.z - p.rounding()
                || is_certainly_outside_projected_box(triangle, &p)
            {
                continue;
            }
            if triangle_contains_lazy_point(triangle, &p) {
                return Location::Surface;
            }
            windings += crossing(triangle, &p);
        }
        match windings {
            0 => Location::Outside,
            _ => Location::Inside(windings),
        }
    }
}

/// Returns true if the projection of a point onto the xy-plane is certainly outside that of a triangle.
fn is_certainly_outside_projected_box([a, b, c]: [DVec3; 3], p: &LazyPoint<'_>) -> bool {
    (0..2).any(|axis| {
        let (lo, hi) = (
            lesser(lesser(a[axis], b[axis]), c[axis]),
            greater(greater(a[axis], b[axis]), c[axis]),
        );
        p.rounded_point[axis] + p.rounding() < lo || p.rounded_point[axis] - p.rounding() > hi
    })
}

/// Returns 1 if the displaced upward ray from a point leaves through a triangle, −1 if it enters, and 0 if it misses.
/// The triangle must not contain the point.
fn crossing(triangle: [DVec3; 3], p: &LazyPoint<'_>) -> i32 {
    let [a, b, c] = triangle;
    let turns = [[a, b], [b, c], [c, a]].map(|edge| match turn(PROJECTION_AXES[0], edge, p) {
        // The shift by (ε, ε²) changes (b − a) × (p − a) by ε (a − b).y + ε² (b − a).x.
        Ordering::Equal => {
            let [a, b] = edge;
            compare_finite(a.y, b.y).then(compare_finite(b.x, a.x))
        }
        turn => turn,
    });
    // An upright triangle is a segment as seen from above: its turns are never all equal.
    if turns[0] == Ordering::Equal || turns[0] != turns[1] || turns[1] != turns[2] {
        return 0;
    }
    let sign = |order: Ordering| order as i32;
    match sign(side(triangle, p)) * sign(turns[0]) {
        -1 => sign(turns[0]),
        _ => 0,
    }
}

/// Compares two finite numbers.
fn compare_finite(x: f64, y: f64) -> Ordering {
    x.partial_cmp(&y).expect("finite coordinates")
}

/// A grid in the xy-plane, with the mesh faces whose projections overlap each cell.
struct Columns {
    lo: DVec2,
    cell: DVec2,
    count: usize,
    faces: Vec<Vec<u32>>,
}

impl Columns {
    fn new(mesh: &Mesh) -> Self {
        let points = mesh.vertices.iter().map(|p| p.truncate());
        let (lo, hi) = points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(lo, hi), p| {
            (lo.min(p), hi.max(p))
        });
        let count = mesh.faces.len().isqrt().max(1);
        let mut columns = Columns {
            lo,
            cell: ((hi - lo) / count as f64).max(DVec2::splat(f64::MIN_POSITIVE)),
            count,
            faces: vec![Vec::new(); count * count],
        };
        // Far more than the rounding of points, so that a face is in the cell of every point over it.
        let spare = 1e-3 * columns.cell;
        for (k, _) in mesh.faces.iter().enumerate() {
            let [a, b, c] = mesh.triangle(k).map(DVec3::truncate);
            let (from, to) = (
                columns.cell_of(a.min(b).min(c) - spare),
                columns.cell_of(a.max(b).max(c) + spare),
            );
            for x in from[0]..=to[0] {
                for y in from[1]..=to[1] {
                    columns.faces[x * count + y].push(k as u32);
                }
            }
        }
        columns
    }

    fn cell_of(&self, p: DVec2) -> [usize; 2] {
        let cell = (p - self.lo) / self.cell;
        // The conversion clamps negative numbers to 0.
        cell.to_array().map(|x| (x as usize).min(self.count - 1))
    }

    /// Returns all faces whose projections may contain that of a point, and possibly others.
    fn candidate_faces(&self, p: &LazyPoint<'_>) -> &[u32] {
        let [x, y] = self.cell_of(p.rounded_point.truncate());
        &self.faces[x * self.count + y]
    }
}
