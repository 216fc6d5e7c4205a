//! The choice of `Detail::Auto`: the fewest pieces that are exact.

use super::parts::Parts;
use super::report::{Estimate, Why};
use crate::mesh::TriangleMesh;
use crate::pieces::convex::as_polytope;
use crate::pieces::patches::{Order, decompose_flats};
use crate::solid::check_solid;
use crate::solid::error::DecomposeError;
use crate::solid::flats::Flats;
use crate::solid::manifold::{Dihedral, Manifold};
use crate::solid::topology::Topology;
use crate::tolerance::{AUTO_WORK, FLAT_SHARE, PATCHES, PieceCost, TRIANGLES};
use crate::work::Work;

/// Chooses one hull where the solid is convex, else patches or triangles, whichever is estimated to be faster.
///
/// Finding intersections and decomposing take long: they are done only where the result would be used, and
/// only within a [budget](AUTO_WORK).
pub(super) fn choose(mesh: &TriangleMesh, topology: &Topology) -> (Parts, Why) {
    within(mesh, topology, &Work::of(AUTO_WORK))
}

fn within(mesh: &TriangleMesh, topology: &Topology, work: &Work) -> (Parts, Why) {
    let manifold = match Manifold::unchecked(mesh, topology) {
        Ok(manifold) => manifold,
        Err(error) => return only_triangles(error),
    };
    let convex = as_polytope(&manifold);
    let flats = Flats::new(&manifold);
    let estimate = PlanarRegion::largest(&manifold, &flats).estimate();
    if convex.is_err() && !(estimate.patches < estimate.triangles) {
        return (Parts::Triangles, Why::TrianglesFaster(estimate));
    }
    if let Err(error) = check_solid(&manifold, work) {
        return only_triangles(error);
    }
    if let Ok(polytope) = convex {
        return (Parts::Hull(Box::new(polytope)), Why::Convex);
    }
    match decompose_flats(&manifold, &flats, Order::default(), work) {
        Ok(decomposition) => (Parts::Patches(decomposition), Why::PatchesFaster(estimate)),
        Err(error) => only_triangles(error),
    }
}

fn only_triangles(error: DecomposeError) -> (Parts, Why) {
    let why = match error {
        DecomposeError::TooLong => Why::TooLong,
        error => Why::NothingElse(error),
    };
    (Parts::Triangles, why)
}

/// The size of a plane part of the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct PlanarRegion {
    triangles: usize,
    /// The convex polygons that its triangles merge into: at least as many as there are patches in it.
    polygons: usize,
}

impl PlanarRegion {
    /// Finds the plane part of most triangles.
    fn largest(manifold: &Manifold<'_>, flats: &Flats) -> PlanarRegion {
        let mut seen = vec![false; flats.len()];
        let mut largest = PlanarRegion::default();
        let mut stack = Vec::new();
        for seed in 0..flats.len() as u32 {
            let mut plane = PlanarRegion::default();
            stack.push(seed);
            while let Some(flat) = stack.pop() {
                if std::mem::replace(&mut seen[flat as usize], true) {
                    continue;
                }
                let flat = flats.get(flat);
                plane.triangles += flat.faces.len();
                plane.polygons += 1;
                let level = flat
                    .rim
                    .iter()
                    .filter(|&&h| manifold.dihedral(h) == Dihedral::Flat);
                stack.extend(level.map(|&h| flats.of_face(manifold.twin(h) / 3)));
            }
            largest = largest.max(plane);
        }
        largest
    }

    /// Estimates the time of a query, when this part rests on another body in some of the queries.
    fn estimate(self) -> Estimate {
        let cost = |of: PieceCost, count: usize| of.usual + FLAT_SHARE * of.resting * count as f64;
        Estimate {
            triangles: cost(TRIANGLES, self.triangles),
            patches: cost(PATCHES, self.polygons),
        }
    }
}

#[cfg(test)]
mod tests;
