//! Finds which shells of a closed mesh are wrongly oriented, by how they are nested.

mod closed_parts;

use crate::bounds::{BoundingBox, BoundingBoxTree};
use crate::disjoint_sets::members_by_set;
use crate::exact::predicates::{first_underflow_prone_point_index, is_degenerate};
use crate::exact::rays::{probe_segment, segment_crossing_sign};
use crate::exact::triangles::meet_outside_shared_corners;
use crate::exact::volume::SignedVolume;
use crate::half_edges::SortedHalfEdges;
use crate::mesh::TriangleMesh;
use crate::search::TriangleBoxes;
use crate::search::region::Region;
use crate::tally::CountWithExamples;
use crate::tolerance::{FACE_CENTER_ROUNDING, MAX_NESTING_RAYS};
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use ccd_core::vector::unit;
use closed_parts::closed_part_numbers;

/// The shells of a closed mesh whose orientation contradicts their nesting in other shells.
///
/// A shell is a closed part that is connected over edges. Among shells that do not cross, the outermost bound
/// solids, those next within bound cavities, and so on, for any orientation. Outermost shells that cross make
/// up one solid together. Within another shell, shells that cross are part of its solid where they have its
/// orientation; otherwise they are unclear.
#[derive(Debug, Default)]
pub(crate) struct MisorientedShells {
    /// The faces to reverse, so that the solid is behind all faces of the mesh or in front of all faces.
    pub(crate) faces_to_reverse: Vec<u32>,
    /// One face of each wrongly oriented shell, by the file's number; empty if all shells are wrongly oriented.
    pub(crate) wrong_shells: CountWithExamples<u32>,
    /// One face, by the file's number, of each shell for which it is unclear whether it bounds a solid or a cavity.
    pub(crate) unclear_shells: CountWithExamples<u32>,
}

impl MisorientedShells {
    /// Finds the wrongly oriented shells of a closed mesh; `edges` are its edges between welded vertices. Every edge
    /// has equally many faces in both directions. A mesh of one part needs no reversal.
    ///
    /// Exact. O(n log n) where few boxes of triangles and of shells meet those of other shells.
    pub(crate) fn new(mesh: &TriangleMesh, edges: &SortedHalfEdges) -> Self {
        let shell_of = closed_part_numbers(mesh, edges);
        let faces_of = members_by_set(&shell_of);
        match faces_of[..] {
            [] | [_] => MisorientedShells::default(),
            _ => Shells::new(mesh, shell_of, faces_of).misoriented_shells(),
        }
    }
}

/// The shells of a mesh, and search trees over its faces.
struct Shells<'m> {
    mesh: &'m TriangleMesh,
    triangle_boxes: TriangleBoxes,
    shell_of_face: Vec<u32>,
    faces_of_shell: Vec<Vec<u32>>,
    /// The bounding boxes of the shells. The winding number of a shell is 0 outside its box.
    bounds: BoundingBoxTree,
}

/// The shells that surround one shell.
#[derive(Clone, Debug, Default)]
struct SurroundingShells {
    shells: Vec<u32>,
    /// Whether another shell intersects the surrounded shell; false if no shell winds about it.
    is_shell_crossed: bool,
}

impl<'m> Shells<'m> {
    fn new(mesh: &'m TriangleMesh, shell_of: Vec<u32>, faces_of: Vec<Vec<u32>>) -> Self {
        let bounds = |faces: &Vec<u32>| {
            BoundingBox::enclosing(faces.iter().flat_map(|&face| mesh.triangle(face)))
        };
        Shells {
            bounds: BoundingBoxTree::new(faces_of.iter().map(bounds).collect()),
            triangle_boxes: TriangleBoxes::new(mesh.vertices(), &mesh.welded_faces()),
            mesh,
            shell_of_face: shell_of,
            faces_of_shell: faces_of,
        }
    }

    fn misoriented_shells(&self) -> MisorientedShells {
        let exact = first_underflow_prone_point_index(self.mesh.vertices()).is_none();
        let shells = 0..self.faces_of_shell.len() as u32;
        let found: Vec<Option<SurroundingShells>> = shells
            .map(|shell| exact.then(|| self.surrounding_shells(shell)).flatten())
            .collect();
        let is_unknown: Vec<bool> = found.iter().map(Option::is_none).collect();
        let around: Vec<SurroundingShells> =
            found.into_iter().map(Option::unwrap_or_default).collect();
        let orientations: Vec<i32> = self
            .faces_of_shell
            .iter()
            .map(|faces| self.orientation_sign(faces))
            .collect();
        // A surrounding shell has fewer shells around it.
        let mut order: Vec<usize> = (0..around.len()).collect();
        order.sort_by_key(|&shell| around[shell].shells.len());
        let mut sides = vec![1; around.len()];
        let mut nesting = MisorientedShells::default();
        for shell in order {
            let (shells, crossed) = (&around[shell].shells, around[shell].is_shell_crossed);
            let windings: i32 = shells.iter().map(|&other| sides[other as usize]).sum();
            let outermost = shells.iter().map(|&k| k as usize);
            let outermost = outermost.min_by_key(|&k| around[k].shells.len());
            let as_around = outermost.map(|k| sides[k] * orientations[k] * orientations[shell]);
            sides[shell] = if windings == 1 && !crossed { -1 } else { 1 };
            let is_unclear = is_unknown[shell] || crossed && windings > 0 && as_around != Some(1);
            if is_unclear && !self.bounds_nothing(shell) {
                let face = self.representative_face(shell);
                nesting.unclear_shells.add(face);
            }
        }
        let is_wrong = |shell: usize| orientations[shell] * sides[shell] < 0;
        let has_volume = |&shell: &usize| orientations[shell] != 0;
        // A mesh that is entirely inside out is consistent.
        if !(0..orientations.len()).filter(has_volume).all(is_wrong) {
            for shell in (0..orientations.len()).filter(|&shell| is_wrong(shell)) {
                nesting.wrong_shells.add(self.representative_face(shell));
                nesting.faces_to_reverse.extend(&self.faces_of_shell[shell]);
            }
        }
        nesting
    }

    /// Returns the first face of a shell, by the file's number. Reports name the shell by it.
    fn representative_face(&self, shell: usize) -> u32 {
        self.mesh.face_ids()[self.faces_of_shell[shell][0] as usize]
    }

    /// Returns the orientation of a shell: 1 outward, −1 inward, 0 without volume.
    fn orientation_sign(&self, faces: &[u32]) -> i32 {
        let near = self.mesh.triangle(faces[0])[0];
        let triangles = faces.iter().map(|&face| self.mesh.triangle(face));
        match SignedVolume::from_triangles(triangles, near).is_positive() {
            Some(true) => 1,
            Some(false) => -1,
            None => 0,
        }
    }

    /// Returns whether a shell has no area, and so bounds neither a solid nor a cavity: a spike, for example.
    fn bounds_nothing(&self, shell: usize) -> bool {
        let mut faces = self.faces_of_shell[shell].iter();
        faces.all(|&face| is_degenerate(self.mesh.triangle(face)))
    }

    /// Returns the shells that surround a shell; `None` if they cannot be determined.
    fn surrounding_shells(&self, shell: u32) -> Option<SurroundingShells> {
        let mut shells = self.shells_winding_about(shell)?;
        if shells.is_empty() {
            return Some(SurroundingShells::default());
        }
        let crossing = self.shells_crossing(shell);
        shells.retain(|other| !crossing.contains(other));
        Some(SurroundingShells {
            shells,
            is_shell_crossed: !crossing.is_empty(),
        })
    }

    /// Returns the other shells whose winding number about a shell is not 0; `None` if every ray meets an edge or
    /// vertex.
    fn shells_winding_about(&self, shell: u32) -> Option<Vec<u32>> {
        let faces = &self.faces_of_shell[shell as usize];
        let corner = self.mesh.triangle(faces[0])[0];
        let is_own = |other: u32| other == shell;
        let at = BoundingBox::enclosing([corner]);
        if self.bounds.all_meeting_boxes_satisfy(&at, is_own) {
            return Some(Vec::new());
        }
        let size = self.triangle_boxes.farthest_distance_bound(corner);
        let face = |k: usize| {
            self.mesh
                .triangle(faces[k * faces.len() / MAX_NESTING_RAYS])
        };
        // Shells may touch at a corner: every attempt uses another one.
        let corners = (0..MAX_NESTING_RAYS).map(|k| (k, face(k)[k % 3]));
        // Shells that share faces touch at all corners.
        let middles = (0..MAX_NESTING_RAYS)
            .filter_map(|k| Some((k, self.isolated_face_center(shell, face(k), size)?)));
        corners.chain(middles).find_map(|(k, from)| {
            self.shells_winding_about_start(shell, probe_segment(from, size, k))
        })
    }

    /// Returns the rounded center of a face; `None` if another shell is so near that rounding may move the center
    /// across it.
    fn isolated_face_center(&self, shell: u32, face: [DVec3; 3], size: f64) -> Option<DVec3> {
        let (middle, across) = center_and_points_beside(face, size)?;
        let is_of_shell = |face: u32| self.shell_of_face[face as usize] == shell;
        let misses = |face: u32| {
            is_of_shell(face) || segment_crossing_sign(across, self.mesh.triangle(face)) == Some(0)
        };
        let is_alone = self.triangle_boxes.all_near_faces_satisfy(
            &Region::segment(across),
            &WorkBudget::unbounded(),
            misses,
        );
        is_alone.then_some(middle)
    }

    /// Returns the other shells whose winding number about the start of a ray is not 0; `None` if the ray meets an
    /// edge or vertex.
    fn shells_winding_about_start(&self, shell: u32, ray: [DVec3; 2]) -> Option<Vec<u32>> {
        let mut met = Vec::new();
        let region = Region::segment(ray);
        let passes =
            self.triangle_boxes
                .all_near_faces_satisfy(&region, &WorkBudget::unbounded(), |face| {
                    let other = self.shell_of_face[face as usize];
                    let start = BoundingBox::enclosing([ray[0]]);
                    let may_wind = other != shell && self.bounds.get(other).meets(&start);
                    let found = if may_wind {
                        segment_crossing_sign(ray, self.mesh.triangle(face))
                    } else {
                        Some(0)
                    };
                    met.extend(found.filter(|&one| one != 0).map(|one| (other, one)));
                    found.is_some()
                });
        passes.then(|| {
            met.sort_unstable();
            met.chunk_by(|one, next| one.0 == next.0)
                .filter(|of_one| of_one.iter().map(|&(_, one)| one).sum::<i32>() != 0)
                .map(|of_one| of_one[0].0)
                .collect()
        })
    }

    /// Returns the other shells that intersect a shell outside shared corners and edges.
    fn shells_crossing(&self, shell: u32) -> Vec<u32> {
        let mut crossed = Vec::new();
        let flat = |face: u32| is_degenerate(self.mesh.triangle(face));
        // A degenerate face lies on an edge of its neighbours.
        let faces = self.faces_of_shell[shell as usize].iter();
        for &face in faces.filter(|&&face| !flat(face)) {
            let one = self.mesh.triangle(face);
            self.triangle_boxes.all_near_faces_satisfy(
                &Region::from_triangle(one),
                &WorkBudget::unbounded(),
                |near| {
                    let other = self.shell_of_face[near as usize];
                    if other != shell && !crossed.contains(&other) && !flat(near) {
                        let ids = [face, near].map(|f| self.mesh.welded_face(f));
                        if meet_outside_shared_corners(ids, [one, self.mesh.triangle(near)]) {
                            crossed.push(other);
                        }
                    }
                    true
                },
            );
        }
        crossed
    }
}

/// Returns the center of a face, and a nearby point on each side; `None` if the face has no normal. `size` is that of
/// the mesh.
fn center_and_points_beside([a, b, c]: [DVec3; 3], size: f64) -> Option<(DVec3, [DVec3; 2])> {
    let middle = (a + b + c) / 3.0;
    // Far from the origin, rounding exceeds that of the mesh's size.
    let size = size + middle.abs().max_element();
    let off = unit((b - a).cross(c - a))? * FACE_CENTER_ROUNDING * size;
    Some((middle, [middle - off, middle + off]))
}

#[cfg(test)]
mod tests;
