//! Does a mesh bound a solid?

use super::nesting::Nesting;
use crate::mesh::TriangleMesh;
use crate::tally::Tally;
use ccd_core::glam::DVec3;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How the faces of a mesh meet at their edges. Vertices at exactly the same point count as one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Topology {
    /// Edges of one face only: the rims of holes.
    pub boundary: Tally<Edge>,
    /// Edges of two faces that run along them the same way: one of the two is the wrong way round.
    pub flipped: Tally<Edge>,
    /// Edges of more than two faces, of which not as many run one way as the other.
    pub branching: Tally<Edge>,
    /// Edges of more than two faces, of which as many run one way as the other: closed parts that
    /// touch each other along an edge.
    pub shared: Tally<Edge>,
    /// Shells that are wound the other way than is right where they are, when others are not, each by a
    /// face of it: bodies are made with them turned round.
    pub wrong_way: Tally<u32>,
    /// Shells within another one that cross a third, so that nothing tells whether they bound a solid or a
    /// cavity, each by a face of it.
    pub unclear: Tally<u32>,
    /// Volume within the faces, once shells are turned the right way; negative where all look inward.
    /// Meaningful for a closed mesh only. In the cube of the mesh's unit of length.
    pub signed_volume: f64,
}

/// An edge by the numbers of its vertices, the smaller first; of several vertices at one point, the
/// first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Edge(pub u32, pub u32);

/// Where the faces of a closed mesh look, on the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// Away from the inside.
    Outward,
    /// Into it: the mesh is inside out.
    Inward,
    /// The mesh holds no volume, or as much of either kind.
    Neither,
}

impl Topology {
    /// Looks at every edge of a mesh, and at which of its shells are within which. O(n log n) in the
    /// number of faces, where few boxes of faces of different shells meet.
    ///
    /// ```
    /// use ccd_decomp::{Format, Topology, TriangleMesh};
    /// let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
    /// let open = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    /// assert_eq!(Topology::of(&open).boundary.count(), 3);
    /// ```
    pub fn of(mesh: &TriangleMesh) -> Self {
        Topology::and_turned(mesh).0
    }

    /// The same, and the mesh with its shells turned the right way, where some are not.
    pub(crate) fn and_turned(mesh: &TriangleMesh) -> (Self, Option<TriangleMesh>) {
        let mut topology = Topology {
            signed_volume: signed_volume(mesh),
            ..Topology::default()
        };
        for (edge, forward, backward) in edge_uses(mesh) {
            let tally = match (forward + backward, forward == backward) {
                (2, true) => continue,
                (1, _) => &mut topology.boundary,
                (2, false) => &mut topology.flipped,
                (_, false) => &mut topology.branching,
                (_, true) => &mut topology.shared,
            };
            tally.add(edge);
        }
        if !topology.is_closed() {
            return (topology, None);
        }
        let nesting = Nesting::of(mesh);
        topology.wrong_way = nesting.wrong;
        topology.unclear = nesting.unclear;
        let turned = (!nesting.turned.is_empty()).then(|| mesh.turned(&nesting.turned));
        if let Some(turned) = &turned {
            topology.signed_volume = signed_volume(turned);
        }
        (topology, turned)
    }

    /// Whether it bounds a solid: it is closed, and of all its shells it is clear on which side the solid
    /// is.
    pub fn is_solid(&self) -> bool {
        self.is_closed() && self.unclear.is_empty()
    }

    /// Whether along every edge as many faces run one way as the other. The winding number of a point
    /// off the surface is then a whole number, and tells the inside from the outside.
    pub fn is_closed(&self) -> bool {
        self.boundary.is_empty() && self.flipped.is_empty() && self.branching.is_empty()
    }

    /// Whether it is closed, and no edge has more than two faces.
    pub fn is_manifold(&self) -> bool {
        self.is_closed() && self.shared.is_empty()
    }

    /// What would make it a manifold, for messages.
    pub(crate) fn advice(&self) -> &'static str {
        if !(self.boundary.is_empty() && self.branching.is_empty()) {
            "close the mesh"
        } else if !self.flipped.is_empty() {
            "turn the faces that look the other way"
        } else {
            "take the parts for themselves"
        }
    }

    /// Where the faces look, by the sign of the volume.
    pub fn orientation(&self) -> Orientation {
        if self.signed_volume > 0.0 {
            Orientation::Outward
        } else if self.signed_volume < 0.0 {
            Orientation::Inward
        } else {
            Orientation::Neither
        }
    }
}

/// Every edge with the number of faces that run from its smaller vertex to the larger, and back.
fn edge_uses(mesh: &TriangleMesh) -> impl Iterator<Item = (Edge, usize, usize)> {
    // The edge in the upper bits, the direction in the lowest; vertex numbers are below 2³¹.
    let mut uses = Vec::new();
    uses.reserve_exact(3 * mesh.faces().len());
    for [a, b, c] in mesh.welded_faces() {
        for (v, w) in [(a, b), (b, c), (c, a)] {
            // From a point to itself is no edge.
            if v != w {
                uses.push((v.min(w), v.max(w) << 1 | u32::from(v > w)));
            }
        }
    }
    uses.sort_unstable();
    let mut at = 0;
    std::iter::from_fn(move || {
        let &(v, w) = uses.get(at)?;
        let same = uses[at..]
            .iter()
            .take_while(|u| u.0 == v && u.1 >> 1 == w >> 1);
        let (mut forward, mut backward) = (0, 0);
        for (_, w) in same {
            match w & 1 {
                0 => forward += 1,
                _ => backward += 1,
            }
        }
        at += forward + backward;
        Some((Edge(v, w >> 1), forward, backward))
    })
}

/// The sum over all faces of the signed volume of the tetrahedron to a point near the mesh: the sum
/// of a closed mesh does not depend on the point, its rounding does.
fn signed_volume(mesh: &TriangleMesh) -> f64 {
    let corner = |v: u32| mesh.vertices()[v as usize];
    let near = mesh.faces().first().map_or(DVec3::ZERO, |f| corner(f[0]));
    let six: f64 = mesh
        .faces()
        .iter()
        .map(|face| {
            let [a, b, c] = face.map(|v| corner(v) - near);
            a.dot(b.cross(c))
        })
        .sum();
    six / 6.0
}

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "e{}-{}", self.0, self.1)
    }
}

impl fmt::Display for Topology {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let notes = [
            (&self.boundary, "edges with one face"),
            (&self.flipped, "edges between faces that look opposite ways"),
            (&self.branching, "unbalanced edges with more than two faces"),
            (&self.shared, "edges shared by closed parts"),
        ];
        let torn = !(self.boundary.is_empty() && self.branching.is_empty());
        write!(f, "{}", if torn { "open" } else { "closed" })?;
        if !self.flipped.is_empty() {
            write!(f, ", not all faces turned the same way")?;
        } else if self.is_closed() && self.orientation() == Orientation::Inward {
            write!(f, ", inside out")?;
        }
        let shells = [
            (&self.wrong_way, "shells wound the wrong way, turned"),
            (&self.unclear, "shells that may bound a solid or a cavity"),
        ];
        for (tally, what) in shells.iter().filter(|(tally, _)| !tally.is_empty()) {
            write!(f, "; {what}, by a face: {tally}")?;
        }
        for (tally, what) in notes.iter().filter(|(tally, _)| !tally.is_empty()) {
            write!(f, "; {what}: {tally}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
