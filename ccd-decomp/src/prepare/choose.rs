//! The least model that is exact for a mesh.

use super::parts::Parts;
use super::report::{Estimate, Why};
use crate::mesh::TriangleMesh;
use crate::pieces::convex::as_polytope;
use crate::pieces::patches::{Order, decompose_flats};
use crate::solid::check_solid;
use crate::solid::error::DecomposeError;
use crate::solid::flats::Flats;
use crate::solid::manifold::{Bend, Manifold};
use crate::solid::topology::Topology;
use crate::tolerance::{AUTO_WORK, FLAT_SHARE, PATCHES, PieceCost, TRIANGLES};
use crate::work::Work;

/// One hull where the solid is convex; else patches or triangles, whichever is estimated to be faster.
///
/// What takes long, looking for intersections and decomposing, is only done once it is known to be
/// worth it, and only for [so long](AUTO_WORK).
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
    let estimate = Plane::largest(&manifold, &flats).estimate();
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

/// A plane part of the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Plane {
    triangles: usize,
    /// Convex ones, with coplanar triangles merged: at least as many as there are patches in it.
    polygons: usize,
}

impl Plane {
    /// The one of most triangles.
    fn largest(manifold: &Manifold<'_>, flats: &Flats) -> Plane {
        let mut seen = vec![false; flats.len()];
        let mut largest = Plane::default();
        let mut stack = Vec::new();
        for seed in 0..flats.len() as u32 {
            let mut plane = Plane::default();
            stack.push(seed);
            while let Some(flat) = stack.pop() {
                if std::mem::replace(&mut seen[flat as usize], true) {
                    continue;
                }
                let flat = flats.get(flat);
                plane.triangles += flat.faces.len();
                plane.polygons += 1;
                let level = flat.rim.iter().filter(|&&h| manifold.bend(h) == Bend::Flat);
                stack.extend(level.map(|&h| flats.of_face(manifold.twin(h) / 3)));
            }
            largest = largest.max(plane);
        }
        largest
    }

    /// What a query costs where the plane is what rests on another body in some of them.
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
