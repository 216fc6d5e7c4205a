//! Faces of a mesh that meet where they share nothing.

mod plates;

use crate::error::DecomposeError;
use crate::exact::predicates::{Projection, side};
use crate::search::Region;
use crate::solid::manifold::Manifold;
use crate::tolerance::CROSSINGS;
use crate::work::Work;
use ccd_core::glam::DVec3;
use plates::Plates;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::fmt;

/// Two faces of a mesh, by their numbers, that meet elsewhere than in a shared vertex or edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Crossing {
    /// The smaller number.
    pub face: u32,
    /// The other one.
    pub other: u32,
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "f{}-f{}", self.face, self.other)
    }
}

/// The pairs of faces that meet where they share nothing, touching or crossing: all, or as many as are
/// [counted](CROSSINGS).
///
/// # Errors
/// [`DecomposeError::TooLong`].
pub(crate) fn crossings(
    manifold: &Manifold<'_>,
    work: &Work,
) -> Result<Vec<(u32, u32)>, DecomposeError> {
    let mut found = Vec::new();
    let plates = Plates::of(manifold);
    for face in 0..manifold.faces().len() as u32 {
        let near = Region::triangle(manifold.triangle(face));
        let mut pair = |other: u32| {
            if cross(manifold, face, other) {
                found.push((face.min(other), face.max(other)));
            }
            found.len() < CROSSINGS && work.spend(PAIR)
        };
        let goes_on = match &plates {
            Some(plates) => plates.all_meeting(face, &near, work, pair),
            None => manifold
                .boxes()
                .all_meeting(&near, work, |other| other <= face || pair(other)),
        };
        if !goes_on {
            work.check()?;
            break;
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// Predicates that a pair takes, about.
const PAIR: usize = 4;

/// Whether two triangles meet elsewhere than in the corners they share.
fn cross(manifold: &Manifold<'_>, one: u32, other: u32) -> bool {
    let corners = [one, other].map(|f| manifold.faces()[f as usize]);
    meet(corners, [one, other].map(|f| manifold.triangle(f)))
}

/// The same for triangles with an area, by the numbers of their corners and by their points.
pub(crate) fn meet(corners: [[u32; 3]; 2], triangles: [[DVec3; 3]; 2]) -> bool {
    let is_shared = |which: usize, k: usize| corners[1 - which].contains(&corners[which][k]);
    let shared = (0..3).filter(|&k| is_shared(0, k)).count();
    match shared {
        0 => triangles_meet(triangles),
        // Two edges meet the other triangle in the shared corner; if they do elsewhere, too, one of
        // the far edges does as well.
        1 => [0, 1].into_iter().any(|which| {
            let k = (0..3).find(|&k| is_shared(which, k)).unwrap_or(0);
            let far = [(k + 1) % 3, (k + 2) % 3].map(|k| triangles[which][k]);
            meets(far, triangles[1 - which])
        }),
        2 => folded(corners, triangles),
        // The same triangle, from the other side.
        _ => true,
    }
}

/// Whether two triangles of non-zero area have a point in common.
pub(crate) fn triangles_meet(triangles: [[DVec3; 3]; 2]) -> bool {
    let beyond = |which: usize| {
        let sides = triangles[1 - which].map(|p| side(triangles[which], p));
        sides[0] != Ordering::Equal && sides.iter().all(|&s| s == sides[0])
    };
    !beyond(0)
        && !beyond(1)
        && (0..3).any(|k| {
            let edge = |which: usize| [triangles[which][k], triangles[which][(k + 1) % 3]];
            meets(edge(0), triangles[1]) || meets(edge(1), triangles[0])
        })
}

/// Whether two triangles that share an edge lie in one plane, on one side of it.
fn folded(corners: [[u32; 3]; 2], [one, other]: [[DVec3; 3]; 2]) -> bool {
    let far = |which: usize| (0..3).find(|&k| !corners[1 - which].contains(&corners[which][k]));
    let (Some(k), Some(l)) = (far(0), far(1)) else {
        return true;
    };
    let Some(projection) = Projection::of(one) else {
        return true;
    };
    side(one, other[l]) == Ordering::Equal
        && projection.turn(one[(k + 1) % 3], one[(k + 2) % 3], other[l]) == Ordering::Greater
}

/// Whether a segment meets a triangle; touching counts.
fn meets([p, q]: [DVec3; 2], triangle: [DVec3; 3]) -> bool {
    let [a, b, c] = triangle;
    match (side(triangle, p), side(triangle, q)) {
        (Ordering::Equal, Ordering::Equal) => meets_in_plane([p, q], triangle),
        (s, t) if s == t => false,
        _ => {
            // Of the tetrahedra of the segment with each edge: the crossing is inside of all.
            let turns = [(a, b), (b, c), (c, a)].map(|(v, w)| side([p, q, v], w));
            !(turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater))
        }
    }
}

/// The same for a segment within the triangle's plane.
fn meets_in_plane([p, q]: [DVec3; 2], triangle: [DVec3; 3]) -> bool {
    let Some(projection) = Projection::of(triangle) else {
        return true;
    };
    let outside = |k: usize| {
        let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
        [p, q].map(|x| projection.turn(a, b, x)) == [Ordering::Less; 2]
    };
    let turns = triangle.map(|x| projection.turn(p, q, x));
    let passes = turns[0] != Ordering::Equal && turns.iter().all(|&t| t == turns[0]);
    !(passes || (0..3).any(outside))
}

#[cfg(test)]
mod tests;
