//! Computes the topology of a mesh: irregular edges, closedness, orientation.

mod joining;

use super::nesting::MisorientedShells;
use crate::half_edges::SortedHalfEdges;
use crate::mesh::TriangleMesh;
use crate::tally::CountWithExamples;
use ccd_core::glam::DVec3;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The irregular edges of a mesh and its wrongly oriented shells. Equal points count as one vertex.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TopologyDefects {
    /// Edges with a single face, which are the boundaries of holes.
    pub boundary_edges: CountWithExamples<Edge>,
    /// Edges with two faces in the same direction. One of the two faces has the wrong orientation.
    pub flipped_edges: CountWithExamples<Edge>,
    /// Edges with more than two faces, with more in one direction than in the other.
    pub branching_edges: CountWithExamples<Edge>,
    /// Edges with more than two faces, equally many in both directions. Closed parts touch there.
    pub edges_shared_by_parts: CountWithExamples<Edge>,
    /// One face of each wrongly oriented shell. Bodies are made with these shells reversed. The list is empty if all
    /// shells are wrongly oriented: such a mesh is consistent, and `signed_volume` is negative.
    pub wrong_shells: CountWithExamples<u32>,
    /// Shells for which it is unclear whether they bound a solid or a cavity; one face of each. They are inside a shell
    /// and cross another shell, or their nesting cannot be determined.
    pub unclear_shells: CountWithExamples<u32>,
    /// The enclosed volume after wrong shells are reversed, in cubic units of length. It is negative if all normals
    /// point inward, and meaningful for closed meshes only.
    pub signed_volume: f64,
    /// The largest distance between vertices on open edges that have to be joined, so that the mesh is closed: at most a
    /// millionth of its size. `None` if that does not close it, and of a mesh from a stored body.
    #[serde(skip)]
    pub joining_distance: Option<f64>,
}

/// An edge by its vertex numbers, the smaller first. The first of several vertices at one point represents them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Edge(pub u32, pub u32);

impl TopologyDefects {
    /// Computes the topology of a mesh from its edges and the nesting of its shells. O(n log n) in the number of faces,
    /// where few boxes of faces of different shells meet.
    ///
    /// ```
    /// use ccd_decomp::{Format, TopologyDefects, TriangleMesh};
    /// let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
    /// let open = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    /// assert_eq!(TopologyDefects::of(&open).boundary_edges.count(), 3);
    /// ```
    pub fn of(mesh: &TriangleMesh) -> Self {
        TopologyDefects::with_reoriented_mesh(mesh).0
    }

    /// Computes the topology like [`TopologyDefects::of`], and the mesh with wrong shells reversed. The mesh is `None` if no
    /// shell is wrong.
    pub(crate) fn with_reoriented_mesh(mesh: &TriangleMesh) -> (Self, Option<TriangleMesh>) {
        let edges = SortedHalfEdges::new(&mesh.welded_faces());
        let mut topology = TopologyDefects {
            signed_volume: signed_volume(mesh),
            ..TopologyDefects::default()
        };
        for ([v, w], uses) in edges.iter() {
            let backward = uses.iter().filter(|of| of.is_backward).count();
            let tally = match (uses.len(), 2 * backward == uses.len()) {
                (2, true) => continue,
                (1, _) => &mut topology.boundary_edges,
                (2, false) => &mut topology.flipped_edges,
                (_, false) => &mut topology.branching_edges,
                (_, true) => &mut topology.edges_shared_by_parts,
            };
            tally.add(Edge(v, w));
        }
        if !topology.is_closed() {
            topology.joining_distance = joining::joining_distance(mesh, &edges);
            return (topology, None);
        }
        let nesting = MisorientedShells::new(mesh, &edges);
        topology.wrong_shells = nesting.wrong_shells;
        topology.unclear_shells = nesting.unclear_shells;
        let turned = (!nesting.faces_to_reverse.is_empty())
            .then(|| mesh.with_reversed_faces(&nesting.faces_to_reverse));
        if let Some(turned) = &turned {
            topology.signed_volume = signed_volume(turned);
        }
        (topology, turned)
    }

    /// Returns whether the mesh bounds a solid: it is closed, and its shells are nested unambiguously.
    pub fn is_solid(&self) -> bool {
        self.is_closed() && self.unclear_shells.is_empty()
    }

    /// Returns whether every edge has equally many faces in both directions. The winding number of a point off the
    /// surface is then a whole number, which defines the inside.
    pub fn is_closed(&self) -> bool {
        self.boundary_edges.is_empty()
            && self.flipped_edges.is_empty()
            && self.branching_edges.is_empty()
    }

    /// Returns whether the mesh is closed, and no edge has more than two faces.
    pub fn is_manifold(&self) -> bool {
        self.is_closed() && self.edges_shared_by_parts.is_empty()
    }

    /// Returns advice on how to make the mesh a manifold, as a part of error messages.
    pub(crate) fn advice(&self) -> &'static str {
        if self.joining_distance.is_some() {
            "join these vertices"
        } else if !(self.boundary_edges.is_empty() && self.branching_edges.is_empty()) {
            "close the mesh"
        } else if !self.flipped_edges.is_empty() {
            "turn the faces that look the other way"
        } else {
            "take the parts for themselves"
        }
    }

    /// Returns whether the normals of a closed mesh point into its solid, by the sign of its volume.
    pub fn is_inside_out(&self) -> bool {
        self.signed_volume < 0.0
    }
}

/// Sums the signed volumes of the tetrahedra between each face and a point near the mesh. The sum of a closed
/// mesh does not depend on the point, but its rounding does.
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

impl fmt::Display for TopologyDefects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let notes = [
            (&self.boundary_edges, "edges with one face"),
            (
                &self.flipped_edges,
                "edges between faces that look opposite ways",
            ),
            (
                &self.branching_edges,
                "unbalanced edges with more than two faces",
            ),
            (&self.edges_shared_by_parts, "edges shared by closed parts"),
        ];
        let torn = !(self.boundary_edges.is_empty() && self.branching_edges.is_empty());
        write!(f, "{}", if torn { "open" } else { "closed" })?;
        if !self.flipped_edges.is_empty() {
            write!(f, ", not all faces turned the same way")?;
        } else if self.is_closed() && self.is_inside_out() {
            write!(f, ", inside out: taken as turned outward")?;
        }
        let shells = [
            (&self.wrong_shells, "shells wound the wrong way, turned"),
            (
                &self.unclear_shells,
                "shells that may bound a solid or a cavity",
            ),
        ];
        for (tally, what) in shells.iter().filter(|(tally, _)| !tally.is_empty()) {
            write!(f, "; {what}, by a face: {tally}")?;
        }
        for (tally, what) in notes.iter().filter(|(tally, _)| !tally.is_empty()) {
            write!(f, "; {what}: {tally}")?;
        }
        if let Some(distance) = self.joining_distance {
            write!(
                f,
                "; closed if vertices up to {distance:.1e} apart are joined"
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
