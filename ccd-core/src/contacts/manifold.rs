//! Collects all pairs of features in contact, and chooses the pairs to report.

use super::candidate::ContactCandidate;
use super::closest::{TrianglePart, nearest_point_on_triangle, nearest_points_on_crossing_edges};
use super::measure::measure_feature_pair;
use super::skin::{NearSurface, SurfacePart, triangle_edge};
use super::surface::Surface;
use crate::answer::Contact;
use crate::motion::pose::Frame;
use crate::problem::Problem;
use glam::DVec3;
use std::cell::LazyCell;
use std::collections::{HashMap, HashSet};

/// The pairs of features in contact that are found so far, before pairs that need no report are removed.
pub(super) struct ContactManifold<'a> {
    problem: &'a Problem<'a>,
    near_surfaces: [&'a NearSurface<'a>; 2],
    found_pairs: HashMap<[SurfacePart; 2], ContactCandidate>,
}

impl<'a> ContactManifold<'a> {
    pub(super) fn new(problem: &'a Problem<'_>, skins: [&'a NearSurface<'a>; 2]) -> Self {
        ContactManifold {
            problem,
            near_surfaces: skins,
            found_pairs: HashMap::new(),
        }
    }

    /// Returns the number of pairs found so far.
    pub(super) fn len(&self) -> usize {
        self.found_pairs.len()
    }

    /// Adds the contacts between the corners, edges and interiors of a face of A and a face of B.
    pub(super) fn add_face_contacts(&mut self, faces: [u32; 2]) {
        let [a, b] = self.near_surfaces;
        let rounding = self.problem.rounding;
        for v in a.reportable_corners_of(faces[0]) {
            let (part, foot) =
                nearest_point_on_triangle(a.corner_position(v), b.triangle(faces[1]), rounding);
            let spots = [SurfacePart::Corner(v), surface_part(b, faces[1], part)];
            self.add_pair_if_near(spots, [a.corner_position(v), foot], faces);
        }
        for v in b.reportable_corners_of(faces[1]) {
            let (part, foot) =
                nearest_point_on_triangle(b.corner_position(v), a.triangle(faces[0]), rounding);
            let spots = [surface_part(a, faces[0], part), SurfacePart::Corner(v)];
            self.add_pair_if_near(spots, [foot, b.corner_position(v)], faces);
        }
        for e in a.reportable_edges_of(faces[0]) {
            for f in b.reportable_edges_of(faces[1]) {
                let ends = [
                    e.map(|end| a.corner_position(end)),
                    f.map(|end| b.corner_position(end)),
                ];
                if let Some(points) = nearest_points_on_crossing_edges(ends[0], ends[1], rounding) {
                    self.add_pair_if_near(
                        [SurfacePart::Edge(e), SurfacePart::Edge(f)],
                        points,
                        faces,
                    );
                }
            }
        }
    }

    /// Adds a pair of features if it is within margin and tolerance, up to rounding. If the pair is known already, the
    /// nearer points are kept.
    fn add_pair_if_near(&mut self, spots: [SurfacePart; 2], points: [DVec3; 2], faces: [u32; 2]) {
        let radius = |k: usize| self.near_surfaces[k].face(faces[k]).radius;
        let candidate = ContactCandidate {
            points,
            faces,
            radius_sum: radius(0) + radius(1),
        };
        if candidate.gap() - self.problem.rounding <= self.problem.contact_distance() {
            insert_if_nearer(&mut self.found_pairs, spots, candidate);
        }
    }

    /// Returns the pairs to report, nearest first; `a_to_world` is A's frame, relative to the problem's origin.
    pub(super) fn pairs(&self, a_to_world: &Frame) -> Vec<Contact> {
        let covered = self.implied_pairs();
        let mut told = HashMap::new();
        for (mut spots, mut candidate) in sorted_pairs(&self.found_pairs) {
            if covered.contains(&spots) || self.is_due_to_triangulation(spots, &candidate) {
                continue;
            }
            for (k, skin) in self.near_surfaces.iter().enumerate() {
                (spots[k], candidate.faces[k]) = skin.reported_part(spots[k], candidate.faces[k]);
            }
            insert_if_nearer(&mut told, spots, candidate);
        }
        let surfaces = LazyCell::new(|| self.near_surfaces.map(Surface::new));
        let common_normals =
            |points| Surface::common_normals(&surfaces, points, self.problem.rounding);
        let told = sorted_pairs(&told);
        let (problem, skins) = (self.problem, self.near_surfaces);
        let measured = told
            .iter()
            .map(|found| measure_feature_pair(problem, skins, a_to_world, found, common_normals));
        let mut pairs: Vec<Contact> = measured.collect();
        pairs.sort_by(|one, other| {
            let names = |pair: &Contact| (pair.feature_a, pair.feature_b);
            let upper = |pair: &Contact| pair.separation.upper;
            let nearer = upper(one).total_cmp(&upper(other));
            nearer.then_with(|| names(one).cmp(&names(other)))
        });
        pairs
    }

    /// Returns whether a contact exists only because a flat part of a surface is cut into triangles. Its point is on an
    /// edge or corner within a plane, and another triangle of that plane comes nearer elsewhere. That nearer point
    /// makes a pair of its own.
    fn is_due_to_triangulation(
        &self,
        spots: [SurfacePart; 2],
        candidate: &ContactCandidate,
    ) -> bool {
        let rounding = self.problem.rounding;
        (0..2).any(|k| {
            let (skin, from) = (self.near_surfaces[k], candidate.points[1 - k]);
            skin.coplanar_faces_around(spots[k]).iter().any(|&face| {
                let (_, nearest) = nearest_point_on_triangle(from, skin.triangle(face), rounding);
                from.distance(nearest) + rounding < candidate.distance()
            })
        })
    }

    /// Returns the pairs that need no report because another pair in contact implies them. Such a pair is a corner and
    /// a boundary part of a face or edge, if the corner's projection inside that face or edge is equally near.
    fn implied_pairs(&self) -> HashSet<[SurfacePart; 2]> {
        let [a, b] = self.near_surfaces;
        let mut covered = HashSet::new();
        for &[of_a, of_b] in self.found_pairs.keys() {
            if let SurfacePart::Corner(_) = of_a {
                covered.extend(
                    b.boundary_of_part(of_b)
                        .into_iter()
                        .map(|part| [of_a, part]),
                );
            }
            if let SurfacePart::Corner(_) = of_b {
                covered.extend(
                    a.boundary_of_part(of_a)
                        .into_iter()
                        .map(|part| [part, of_b]),
                );
            }
        }
        covered
    }
}

/// Converts a corner, edge or interior of a face's triangle to the corner, edge or face of the whole surface.
fn surface_part(skin: &NearSurface<'_>, face: u32, part: TrianglePart) -> SurfacePart {
    let corners = skin.face(face).corners;
    match part {
        TrianglePart::Corner(k) => SurfacePart::Corner(corners[k]),
        TrianglePart::Edge(k) => SurfacePart::Edge(triangle_edge(corners, k)),
        TrianglePart::Interior => SurfacePart::Face(face),
    }
}

fn insert_if_nearer(
    pairs: &mut HashMap<[SurfacePart; 2], ContactCandidate>,
    spots: [SurfacePart; 2],
    candidate: ContactCandidate,
) {
    let kept = pairs.entry(spots).or_insert(candidate);
    if candidate.gap() < kept.gap() {
        *kept = candidate;
    }
}

/// Returns the pairs sorted by their features, so that their order does not depend on the hash map.
fn sorted_pairs(
    pairs: &HashMap<[SurfacePart; 2], ContactCandidate>,
) -> Vec<([SurfacePart; 2], ContactCandidate)> {
    let mut list: Vec<_> = pairs.iter().map(|(&spots, &it)| (spots, it)).collect();
    list.sort_unstable_by_key(|&(spots, _)| spots);
    list
}
